"""Scripts and sessions for the tests."""

from __future__ import annotations

from pathlib import Path

import pytest
import withy

PENDULUM = """\
let length = input("length", 2, #{ min: 1, max: 3, unit: "m" });
let s = section(#{ EA: 1e4, GA: 4e3, EI: 20, rho_A: 0.5, rho_I: 1e-3 });
let scene = new_scene("pendulum");
let rod = scene.beam(#{ name: "rod", axis: line([0, 0], [length, 0]), basis: bspline(8), section: s });
scene.hinge(rod.start);
scene.gravity([0, -9.81]);
scene.record("rod.end.x");
let sim = scene.start(#{ dt: 0.01 });
sim.run_to(0.5);
print(`the end is at ${sim.position(rod.end)}`);
let names = ["a", "b"];
let options = #{ gain: 2, on: true };
"""


@pytest.fixture
def script(tmp_path: Path) -> Path:
    """File with the script of a pendulum."""
    path = tmp_path / "pendulum.rhai"
    path.write_text(PENDULUM)
    return path


@pytest.fixture
def session(tmp_path: Path) -> withy.Session:
    """Session in which the script of a pendulum has run."""
    session = withy.Session(tmp_path, tmp_path / "out", echo=None)
    session.eval(PENDULUM)
    return session
