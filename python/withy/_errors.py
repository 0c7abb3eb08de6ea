"""Errors of scripts."""

from __future__ import annotations


class ScriptError(Exception):
    """Error of a script, or of a call of the language.

    The text of the error shows the line of the script, as the command ``withy`` does.
    """

    message: str
    """Error message."""
    hint: str | None
    """Suggestion, if there is one."""
    file: str | None
    """File of the error; None if it has no place in a script."""
    line: int | None
    """Line, counted from 1."""
    column: int | None
    """Column, counted from 1."""

    def __init__(
        self,
        message: str,
        hint: str | None = None,
        place: tuple[str, int, int] | None = None,
        report: str | None = None,
    ) -> None:
        super().__init__(message, hint, place, report)
        self.message = message
        self.hint = hint
        self.file, self.line, self.column = place or (None, None, None)
        self._report = report or message

    def __str__(self) -> str:
        return self._report
