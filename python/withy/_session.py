"""Sessions: variables of scripts and the functions of the language."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _native
from ._functions import Functions
from ._objects import with_options

if TYPE_CHECKING:
    from .objects import History, Simulation


class _Listener:
    """Keeps the printed lines and notes, and passes them on."""

    def __init__(self, echo: Callable[[str], object] | None) -> None:
        self.echo = echo
        self.lines: dict[str, list[str]] = {"printed": [], "notes": []}

    def __call__(self, stream: str, line: str) -> None:
        self.lines[stream].append(line)
        if self.echo is not None:
            self.echo(line)

    def text(self, stream: str) -> str:
        return "".join(f"{line}\n" for line in self.lines[stream])


class Session(Functions, Mapping[str, Any]):
    """Session of the language, which keeps the variables of scripts.

    ``session["rod"]`` is a variable, ``session.section(EA=1e4, GA=4e3)`` calls a function of the language.
    Named arguments are options. Steps are computed in a thread of the session, without the global
    interpreter lock.

    Args:
        folder: Folder of files that scripts read and import.
        out: Folder for written files. It is created with the first file.
        echo: Function that receives each printed line and note; None to print nothing.
    """

    def __init__(
        self,
        folder: str | PathLike[str] = ".",
        out: str | PathLike[str] = "out",
        echo: Callable[[str], object] | None = print,
    ) -> None:
        self._listener = _Listener(echo)
        self._native = _native.Session(folder, out, self._listener)

    def run(self, path: str | PathLike[str], set: Mapping[str, Any] | None = None) -> Any:
        """Runs the script in a file. ``set`` has values for its inputs."""
        return self._native.run_file(path, _inputs(set))

    def eval(self, text: str, set: Mapping[str, Any] | None = None, name: str = "<string>") -> Any:
        """Runs statements, and returns the value of the last one. ``name`` is the file name in errors."""
        return self._native.run_text(text, name, _inputs(set))

    def call(self, function: str, *arguments: Any, **options: Any) -> Any:
        """Calls a function of the language or of a script that has run."""
        return self._native.call(function, *with_options(arguments, options))

    def interrupt(self) -> None:
        """Stops the running script after its present step. It can be called from another thread."""
        self._native.interrupt()

    @property
    def printed(self) -> str:
        """Text printed so far."""
        return self._listener.text("printed")

    @property
    def notes(self) -> str:
        """Notes, warnings and failed checks so far."""
        return self._listener.text("notes")

    @property
    def failed_checks(self) -> list[str]:
        """Messages of the checks that have failed."""
        return self._native.failed_checks()

    @property
    def files(self) -> list[Path]:
        """Written files."""
        return [Path(file) for file in self._native.files()]

    @property
    def simulation(self) -> Simulation:
        """Most recently started, loaded or advanced simulation."""
        simulation: Simulation = self._native.call("latest_simulation")
        return simulation

    @property
    def history(self) -> History:
        """History of the most recently started, loaded or advanced simulation."""
        return self.simulation.history

    def __getitem__(self, name: str) -> Any:
        if name not in self._native.names():
            raise KeyError(name)
        return self._native.read(name)

    def __setitem__(self, name: str, value: Any) -> None:
        self._native.define(name, value)

    def __iter__(self) -> Iterator[str]:
        return iter(dict.fromkeys(self._native.names()))

    def __len__(self) -> int:
        return len(set(self._native.names()))

    def __eq__(self, other: object) -> bool:
        return self is other

    __hash__ = object.__hash__

    def __repr__(self) -> str:
        return f"<withy.Session with the variables {', '.join(self) or '(none)'}>"


def run(
    path: str | PathLike[str],
    set: Mapping[str, Any] | None = None,
    out: str | PathLike[str] = "out",
    echo: Callable[[str], object] | None = print,
) -> Session:
    """Runs the script in a file, and returns the session with its variables.

    Args:
        path: Script, a file that ends in .rhai.
        set: Values of inputs of the script, such as ``{"load": 250}``.
        out: Folder for written files.
        echo: Function that receives each printed line and note; None to print nothing.

    Raises:
        ScriptError: The script has an error, or an input is unknown or not allowed.
        KeyboardInterrupt: Ctrl-C was pressed. The run ends after its present step.
    """
    session = Session(Path(path).parent, out, echo)
    session.run(path, set)
    return session


def load(path: str | PathLike[str], echo: Callable[[str], object] | None = print) -> Simulation:
    """Loads a simulation that a script or ``simulation.save`` has written to a file.

    New files are written to the folder of the file.
    """
    path = Path(path)
    session = Session(path.parent, path.parent, echo)
    simulation: Simulation = session.call("load_simulation", path.name)
    return simulation


def _inputs(values: Mapping[str, Any] | None) -> list[tuple[str, str]]:
    return [(name, _input(value)) for name, value in (values or {}).items()]


def _input(value: Any) -> str:
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_input, value))}]"
    return str(value).lower() if isinstance(value, bool) else str(value)
