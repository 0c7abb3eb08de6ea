"""Functions that scripts call, interrupts, and other threads of Python."""

from __future__ import annotations

import gc
import signal
import threading
import weakref

import numpy as np
import pytest
import withy


def test_functions_are_called_while_a_simulation_runs(session: withy.Session) -> None:
    scene = session["scene"]
    scene.record("height", lambda sim: sim.position("rod.end")[1])
    sim = scene.start(dt=0.01)
    times: list[float] = []
    sim.at(0.1, lambda of: times.append(of.t))
    sim.run_to(0.2)
    assert times == [0.1]
    assert sim.history["height"][-1] == sim.position("rod.end")[1]


def test_functions_of_time_are_schedules(session: withy.Session) -> None:
    def tip(schedule: object) -> np.ndarray:
        own = withy.Session(echo=None)
        own.eval(session_script())
        made = own.schedule(schedule) if callable(schedule) else own.eval(schedule)
        own["scene"].moment("rod.end", 5, made)
        sim = own["scene"].start(dt=0.01)
        sim.run_to(0.3)
        return sim.position("rod.end")

    loaded = tip(lambda t: t * t)
    assert np.array_equal(loaded, tip("schedule(|t| t * t)"))
    assert not np.allclose(loaded, tip("schedule(|t| 0.0)"))


def session_script() -> str:
    from conftest import PENDULUM

    return PENDULUM


def test_nested_scripts_are_refused_in_a_called_function(session: withy.Session) -> None:
    session["nested"] = lambda: session.eval("1")
    with pytest.raises(withy.ScriptError, match="the session is running a script"):
        session.eval("nested.call()")


def test_ctrl_c_stops_a_run_and_keeps_its_results(session: withy.Session) -> None:
    sim = session["scene"].start(dt=0.001)
    threading.Timer(0.3, lambda: signal.raise_signal(signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim.run_to(1e9)
    stopped = sim.t
    assert 0 < stopped < 1e9 and sim.history["t"][-1] == stopped
    sim.step()
    assert sim.t == pytest.approx(stopped + 0.001)


def test_other_threads_run_while_steps_are_computed(session: withy.Session) -> None:
    sim = session["scene"].start(dt=0.001)
    stopped = threading.Event()

    def stop_after_counting() -> None:
        # This loop needs the global interpreter lock in every turn. The run has no other end.
        for _ in range(1_000_000):
            pass
        session.interrupt()
        stopped.set()

    counter = threading.Thread(target=stop_after_counting)
    counter.start()
    with pytest.raises(KeyboardInterrupt):
        while not stopped.is_set():
            sim.run_to(1e9)
        pytest.fail("the run ended without an interrupt")
    counter.join()


def test_sessions_in_threads_give_the_same_bits(session: withy.Session) -> None:
    results: list[bytes] = []

    def run() -> None:
        own = withy.Session(echo=None)
        own.eval(session_script())
        results.append(own.history["rod.end.x"].tobytes())

    threads = [threading.Thread(target=run) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert set(results) == {session.history["rod.end.x"].tobytes()} and len(results) == 4


def test_objects_of_another_thread_can_be_used(session: withy.Session) -> None:
    found: list[np.ndarray] = []
    thread = threading.Thread(target=lambda: found.append(session["sim"].position("rod.end")))
    thread.start()
    thread.join()
    assert np.array_equal(found[0], session["sim"].position("rod.end"))


def test_sessions_with_functions_are_collected() -> None:
    class Marker:
        pass

    def use() -> weakref.ref[Marker]:
        marker = Marker()
        session = withy.Session(echo=None)
        scene = session.new_scene("a")
        session["function"] = lambda: (scene, marker)
        return weakref.ref(marker)

    marker = use()
    gc.collect()
    assert marker() is None
