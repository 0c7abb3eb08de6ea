"""Errors of scripts and of functions in Python that scripts call."""

from __future__ import annotations

from pathlib import Path

import pytest
import withy


def test_error_has_its_place_in_the_script(tmp_path: Path) -> None:
    path = tmp_path / "beam.rhai"
    path.write_text("let a = 1;\nlet s = section(#{ EAA: 1, GA: 1 });\n")
    with pytest.raises(withy.ScriptError) as failed:
        withy.run(path, echo=None)
    error = failed.value
    assert error.message == "section: unknown option 'EAA'"
    assert error.hint is not None and error.hint.startswith("did you mean 'EA'?")
    assert (error.file, error.line, error.column) == (str(path), 2, 20)
    assert "2 │ let s = section(#{ EAA: 1, GA: 1 });" in str(error)


def test_syntax_error_of_a_text_has_its_place() -> None:
    with pytest.raises(withy.ScriptError) as failed:
        withy.Session(echo=None).eval("let a = 1;\nlet b = a +* 2;", name="cell 3")
    assert (failed.value.file, failed.value.line, failed.value.column) == ("cell 3", 2, 12)


def test_missing_script_is_an_error() -> None:
    with pytest.raises(withy.ScriptError, match="there is no such file"):
        withy.run("none.rhai")


def test_variables_before_an_error_are_kept() -> None:
    session = withy.Session(echo=None)
    with pytest.raises(withy.ScriptError):
        session.eval("let a = 1; let b = a + unknown; let c = 3;")
    assert list(session) == ["a"]


def test_exceptions_of_called_functions_are_raised(session: withy.Session) -> None:
    def fails(sim: withy.objects.Simulation) -> None:
        raise LookupError(f"at {sim.t}")

    session["sim"].at(0.6, fails)
    with pytest.raises(LookupError, match=r"at 0\.6"):
        session["sim"].run_to(1)
    assert session["sim"].t == 0.6


def test_caught_exceptions_are_not_raised_by_later_errors(session: withy.Session) -> None:
    def fails() -> None:
        raise LookupError("no value")

    session["fails"] = fails
    with pytest.raises(withy.ScriptError, match="unknown"):
        session.eval("try { fails.call() } catch {}; unknown")


def test_exceptions_of_recorded_quantities_are_raised(session: withy.Session) -> None:
    def fails(_: object) -> float:
        raise LookupError("no value")

    session["scene"].record("failing", fails)
    with pytest.raises(LookupError, match="no value"):
        session["scene"].start(dt=0.01).run_to(0.1)


def test_exceptions_of_schedules_are_raised(session: withy.Session) -> None:
    def fails(t: float) -> float:
        if t < 0.05:
            return 1.0
        raise LookupError("no value")

    session["scene"].moment("rod.end", 5, session.schedule(fails))
    sim = session["scene"].start(dt=0.01)
    with pytest.raises(LookupError, match="no value"):
        sim.run_to(0.1)


def test_scripts_can_catch_exceptions_of_called_functions(session: withy.Session) -> None:
    def fails() -> None:
        raise LookupError("no value")

    session["fails"] = fails
    session.eval("let caught = (); try { fails.call(); } catch (error) { caught = `${error}`; }")
    assert session["caught"] == "LookupError: no value"
