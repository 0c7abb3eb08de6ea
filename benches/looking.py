#!/usr/bin/env python3
"""Processor time of pictures, exports, the viewer and sensors: smallest time of several runs of `withy`, minus the time of the run without them.

    cargo build --release && python3 benches/looking.py [target/release/withy] [repeats]
"""

import os
import resource
import subprocess
import sys
import tempfile

WITHY = os.path.abspath(sys.argv[1] if len(sys.argv) > 1 else "target/release/withy")
REPEATS = int(sys.argv[2]) if len(sys.argv) > 2 else 7

SCENE = """
let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let scene = new_scene("throw");
let rod = scene.beam(#{ name: "rod", axis: line([0, 8], [6, 0]), basis: bspline(16), section: s });
scene.force(rod.end, [8, 0], hold_for(2.5));
scene.moment(rod.end, -80, hold_for(2.5));
"""
RUN = "let sim = scene.start(#{ dt: 0.01 OPTIONS });\nsim.run_to(10);\n"
MANY = """
let many = new_scene("many");
for row in 0..50 {
    many.beam(#{ name: `b${row}`, axis: line([0, row], [10, row]), basis: bspline(8), section: s, spin: 0.1 * row });
}
let all = many.start(#{ dt: 0.01 OPTIONS });
all.run_to(10);
"""

# Measured features: name, lines before the run, lines after the run, options of the start, scene, and feature for comparison.
CASES = [
    ("the run alone", "", "", "", RUN),
    ("6 ready sensors", "for n in [\"rod.end.x\", \"rod.end.speed\", \"rod[3].M\", \"rod[3].Q\", \"rod.energy\", \"rod.end.angle\"] { scene.record(n); }", "", "", RUN),
    ("a sensor of acceleration", 'scene.record("rod.end.ax");', "", "", RUN),
    ("a sensor that is a function", 'scene.record("tip", |q| q.position(rod.end).x);', "", "", RUN),
    ("plot_history", "", 'plot_history(sim, ["kinetic", "strain", "energy"], "a.svg");', "", RUN),
    ("plot_motion", "", 'plot_motion(sim, "a.svg", #{ every: 0.5 });', "", RUN),
    ("plot_motion as PNG", "", 'plot_motion(sim, "a.png", #{ every: 0.5 });', "", RUN),
    ("plot_along of N, Q, M", "", 'plot_along(sim, ["N", "Q", "M"], "a.svg");', "", RUN),
    ("plot_field", "", 'plot_field(sim, "M", "a.svg");', "", RUN),
    ("spectrum and statistics", "", 'sim.history.spectrum("kinetic"); sim.history.statistics("kinetic");', "", RUN),
    ("write_viewer, places alone", "", 'write_viewer(sim, "a.html", #{ fields: ["speed", "stretch", "curvature"] });', "", RUN),
    ("write_viewer", "", 'write_viewer(sim, "a.html");', "", RUN),
    ("write_viewer, states kept", "", 'write_viewer(sim, "a.html");', ", snapshots: 100", RUN),
    ("write_animation, 100 frames", "", 'write_animation(sim, "a.png");', "", RUN),
    ("write_vtk, 101 frames", "", 'write_vtk(sim, "a.pvd");', "", RUN),
    ("write_npz", "", 'write_npz(sim, "a.npz");', "", RUN),
    ("write_csv", "", 'write_csv(sim, "a.csv");', "", RUN),
    ("50 beams alone", "", "", "", MANY),
    ("50 beams, write_viewer", "", 'write_viewer(all, "a.html");', "", MANY),
    ("50 beams, write_viewer, states kept", "", 'write_viewer(all, "a.html");', ", snapshots: 2000", MANY),
]


def once(script):
    """Processor time of a run, and number of written bytes."""
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "a.rhai"), "w") as file:
            file.write(script)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([WITHY, "run", "a.rhai", "--quiet"], cwd=folder, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        written = sum(
            os.path.getsize(os.path.join(root, name))
            for root, _, names in os.walk(os.path.join(folder, "out"))
            for name in names
            if not name.startswith(".")
        )
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, written


def main():
    alone = {}
    least = {}
    for _ in range(REPEATS):
        for name, before, behind, options, run in CASES:
            time, written = once(SCENE + before + run.replace("OPTIONS", options) + behind)
            least[name] = (min(time, least.get(name, (float("inf"),))[0]), written)
    print(f"{'':38}{'run':>10}{'more':>10}{'written':>12}")
    for name, _, _, _, run in CASES:
        time, written = least[name]
        base = alone.setdefault(run, time)
        print(f"{name:38}{time * 1e3:8.0f} ms{(time - base) * 1e3:7.0f} ms{written / 1e3:9.0f} kB")


if __name__ == "__main__":
    main()
