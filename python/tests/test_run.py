"""Runs of scripts, their inputs, and saved simulations."""

from __future__ import annotations

import csv
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest
import withy

SCRIPTS = Path(__file__).parents[2] / "scripts"


@pytest.mark.skipif("WITHY_PROGRAM" not in os.environ, reason="WITHY_PROGRAM is not the path of the program")
@pytest.mark.parametrize("name", ["bead_on_a_beam", "flying_spaghetti", "chain_of_rings"])
def test_histories_equal_those_of_the_program_bit_for_bit(name: str, tmp_path: Path) -> None:
    text = (SCRIPTS / f"{name}.rhai").read_text()
    copy = tmp_path / f"{name}.rhai"
    copy.write_text(f'{text}\nwrite_csv(latest_simulation(), "history.csv");\n')
    program = os.environ["WITHY_PROGRAM"]
    command = [program, "run", "--quiet", "--error=never", "--out", str(tmp_path / "native"), str(copy)]
    printed = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    run = withy.run(copy, out=tmp_path / "python", echo=None)
    assert run.printed == printed
    with open(tmp_path / "native" / "history.csv", newline="") as file:
        names, *rows = csv.reader(file)
    assert list(run.history) == names
    for column, name in enumerate(names):
        expected = np.array([float(row[column]) for row in rows])
        assert run.history[name].tobytes() == expected.tobytes(), name
    for file in (tmp_path / "native").glob("*.svg"):
        assert (tmp_path / "python" / file.name).read_bytes() == file.read_bytes()


def test_printed_lines_are_kept_and_echoed(script: Path, tmp_path: Path) -> None:
    heard: list[str] = []
    run = withy.run(script, out=tmp_path / "out", echo=heard.append)
    assert len(heard) == 1 and heard[0].startswith("the end is at ")
    assert run.printed == f"{heard[0]}\n"


def test_inputs_have_the_given_values(script: Path) -> None:
    run = withy.run(script, set={"length": np.float64(1.5)}, echo=None)
    assert run["length"] == 1.5
    assert run["rod"].length == 1.5


@pytest.mark.parametrize(
    ("values", "message", "hint"),
    [
        ({"lenth": 1}, "the script has no input 'lenth'", "did you mean 'length'? its inputs are length"),
        (
            {"length": 4},
            "the input 'length' must be a number (1 to 3 m), got \"4\"",
            "change the value of 'length' (--set length=… on the command line); the default is 2 m",
        ),
    ],
)
def test_wrong_inputs_are_refused(script: Path, values: dict[str, int], message: str, hint: str) -> None:
    with pytest.raises(withy.ScriptError) as refused:
        withy.run(script, set=values, echo=None)
    assert (refused.value.message, refused.value.hint) == (message, hint)


def test_variables_become_python_values(script: Path) -> None:
    run = withy.run(script, echo=None)
    assert run["names"] == ["a", "b"]
    assert run["options"] == {"gain": 2, "on": True}
    assert list(run)[:3] == ["length", "s", "scene"]
    assert "sim" in run and "bead" not in run
    with pytest.raises(KeyError):
        run["bead"]


def test_saved_simulation_continues_like_the_original(script: Path, tmp_path: Path) -> None:
    run = withy.run(script, out=tmp_path / "out", echo=None)
    run.simulation.save("half.withy")
    assert run.files == [tmp_path / "out" / "half.withy"]
    loaded = withy.load(tmp_path / "out" / "half.withy", echo=None)
    loaded.run_to(1)
    run.simulation.run_to(1)
    assert loaded.history["energy"].tobytes() == run.history["energy"].tobytes()
    with pytest.raises(withy.ScriptError, match=r"there is no file .none\.withy"):
        withy.load(tmp_path / "none.withy", echo=None)


def test_failed_checks_are_listed(session: withy.Session) -> None:
    session.eval("check(1 == 2, \"one is two\");")
    assert session.failed_checks == ["one is two"]
    assert "one is two" in session.notes
