"""Objects of the language: methods, properties, options, and NumPy arrays."""

from __future__ import annotations

import numpy as np
import pytest
import withy


def test_columns_of_a_history_are_arrays(session: withy.Session) -> None:
    history = session.history
    assert isinstance(history, withy.objects.History)
    assert history["t"].dtype == np.float64 and history["t"].shape == (51,)
    assert history["t"][-1] == 0.5
    assert list(history) == history.columns and len(history) == len(history.columns)
    assert history["rod.end.x"][-1] == session["sim"].position("rod.end")[0]
    assert history.after(0.25)["t"][0] == 0.25
    with pytest.raises(KeyError, match="did you mean .energy"):
        history["enrgy"]


def test_objects_are_found_by_their_names(session: withy.Session) -> None:
    sim, rod = session["sim"], session["rod"]
    for name, station in [("rod.end", rod.end), ("rod.middle", rod.at(1)), ("rod[0.5]", rod.at(0.5))]:
        assert np.array_equal(sim.position(name), sim.position(station))
    assert sim.section_forces("rod", 1.0) == sim.section_forces(rod, 1.0)
    with pytest.raises(withy.ScriptError) as refused:
        sim.position("rod.nd")
    assert refused.value.hint is not None and refused.value.hint.startswith('did you mean "rod.end"?')
    assert refused.value.line is None


def test_names_are_accepted_in_the_place_of_several_types(session: withy.Session) -> None:
    scene = session["scene"]
    scene.particle([1, 0], 1, name="bead")
    scene.spring("rod.end", [2, -1], stiffness=10)
    scene.damper("rod.middle", [1, -1], damping=1)
    scene.torsion_spring("rod.start", stiffness=1)
    scene.drag("rod", normal=0.1)
    scene.drag("bead", linear=0.1)
    scene.slider("bead", "rod", name="ring")
    assert scene.slider_named("ring").name == "ring"
    with pytest.raises(withy.ScriptError) as refused:
        scene.slider("rod.end", "rodd")
    assert refused.value.message == "beam_named: the scene 'pendulum' has no beam \"rodd\""
    assert refused.value.hint is not None and refused.value.hint.startswith('did you mean "rod"?')


def test_energy_is_a_property_and_a_function(session: withy.Session) -> None:
    sim = session["sim"]
    assert sim.energy == session.eval("sim.energy") and isinstance(sim.energy, float)
    assert session.call("energy", sim, session["rod"]) == session.eval("sim.energy(rod)")


def test_section_forces_along_a_beam_are_a_table(session: withy.Session) -> None:
    along = session["sim"].section_forces("rod")
    assert along["s"][0] == 0 and along["s"][-1] == 2
    assert abs(along["M"][0]) < 1e-2 < abs(along["M"]).max()
    assert set(along.dtype.names) == {"s", "N", "Q", "M", "axial_strain", "shear_strain", "curvature"}


def test_scenes_are_built_in_python() -> None:
    session = withy.Session(echo=None)
    section = session.section(EA=1e4, GA=4e3, EI=20, rho_A=0.5, rho_I=1e-3)
    scene = session.new_scene("cantilever")
    axis = session.line([0, 0], np.array([2.0, 0.0]))
    scene.beam(name="rod", axis=axis, basis=session.bspline(8), section=section)
    scene.clamp("rod.start")
    scene.force("rod.end", [0, np.float64(-1)])
    rest = scene.equilibrium()
    # The deflection of a cantilever with a small force at its end: F L³ / (3 EI), and F L / GA of shear.
    assert rest.position("rod.end")[1] == pytest.approx(-(2**3) / 60 - 2 / 4e3, rel=0.01)
    assert isinstance(rest, withy.objects.Equilibrium)


def test_error_estimate_has_the_values_of_the_language(session: withy.Session) -> None:
    estimate = session["sim"].error_estimate()
    assert estimate.verdict == "converged"
    assert estimate.of("rod.end")["present"] == session.eval('sim.error_estimate().of("rod.end").present')


def test_values_pass_unchanged_in_both_directions() -> None:
    session = withy.Session(echo=None)
    for value in [None, True, 3, -2.5, "text", ["a", 1, [2.5]], {"a": {"b": 1}}, []]:
        session["value"] = value
        assert session["value"] == value and type(session["value"]) is type(value)
    for numbers in [np.array([1.5, np.nan, np.inf]), np.arange(4)]:
        session["value"] = numbers
        assert session["value"].dtype == numbers.dtype
        assert np.array_equal(session["value"], numbers, equal_nan=True)
    assert np.array_equal(session.eval("[vec(1, 2), vec(3, 4)]"), [[1.0, 2.0], [3.0, 4.0]])
    with pytest.raises(TypeError, match="'complex' cannot be passed to withy"):
        session["value"] = 1j
    with pytest.raises(OverflowError):
        session["value"] = 2**63


def test_functions_of_scripts_are_called(session: withy.Session) -> None:
    session.eval("fn twice(x) { 2 * x }")
    assert session.call("twice", 21) == 42
    assert session.eval("|x| x + 1")(2) == 3


def test_objects_of_another_session_are_refused(session: withy.Session) -> None:
    other = withy.Session(echo=None)
    with pytest.raises(ValueError, match="the section belongs to another session"):
        other.new_scene("a").beam(section=session["s"])


def test_members_are_described() -> None:
    assert "last step ends exactly there" in withy.objects.Simulation.run_to.__doc__
    assert "In the language: simulation.run_to(t)" in withy.objects.Simulation.run_to.__doc__
    assert {"run_to", "position", "history"} < set(dir(withy.objects.Simulation))
    with pytest.raises(AttributeError):
        withy.Session().sectoin  # noqa: B018


def test_simulation_is_shown_as_a_page(session: withy.Session, tmp_path) -> None:
    shown = session["sim"]._repr_html_()
    assert shown.startswith('<iframe srcdoc="&lt;!') and shown.count("<") == 2
    session["sim"].viewer(title="my run", to_=0.2).save(tmp_path / "run.html")
    session.write_viewer(session["sim"], "run.html", title="my run", to=0.2)
    assert (tmp_path / "run.html").read_bytes() == session.files[0].read_bytes()
