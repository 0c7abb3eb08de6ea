#!/usr/bin/env python3
"""Compares the run times of withy and EXUDYN for the same error, alternately on one core of the same machine.

    pip install exudyn==1.13.6 numpy
    cargo build --release
    python3 benches/exudyn/pairs.py [PROBLEM ...] [--rounds N]

Problems: flying_spaghetti, stiffer_spaghetti, smooth_throw, four_bar, cable_slider. Default: all problems.

First, both programs run with several meshes, methods and step sizes. A run is accepted for an error level only if all runs of the same mesh and method with
smaller steps are also below this level. This excludes runs that are accurate by chance. For each program and level, the three fastest runs are repeated
alternately in several rounds (default 5), for about a quarter of a second each. The smallest time is reported, because it is least affected by other processes.
The time of withy is measured within its process, from the first to the last step, including recording. The time of EXUDYN is the time of its solver calls: wall
clock or processor time, whichever is smaller. The start of the process and the assembly of the model are excluded.

Errors are computed from independent solutions if available (scripts/studies/reference/README.md), otherwise from the common limit of both programs.
"""

import os
import sys

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import argparse
import math
import platform
import re
import subprocess
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parents[2]
WITHY = ROOT / "target" / "release" / "withy"
VERSION = "1.13.6"
LEVELS = (1e-2, 1e-3, 1e-4, 1e-5)
CANDIDATES = 3
TIME_LIMIT = 0.25  # seconds for each run and round
LONGEST = 8.0  # seconds that a run of a sweep may take; smaller steps of the same mesh and method are then left out


class Run(NamedTuple):
    """Settings of a run: mesh, method of the program, and number of steps."""

    mesh: str
    method: str
    steps: int

    def __str__(self):
        return f"{self.mesh}, {self.method}, {self.steps} steps"


class Made(NamedTuple):
    """Completed run: settings, error, and run time [s]."""

    run: Run
    error: float
    seconds: float


def largest_distance(points, reference):
    """Largest position error of the points."""
    return max(math.dist(a, b) for a, b in zip(points, reference, strict=True))


class Exudyn:
    """Model of a problem in EXUDYN, built again for each run."""

    def __init__(self, problem):
        self.problem, self.name = problem, f"EXUDYN {VERSION}"

    def make(self, runs):
        """Executes the runs one after another. Runs without a solution are omitted."""
        for run in runs:
            try:
                seconds, points = self.problem.run_exudyn(run)
            except Exception as failure:  # EXUDYN raises exceptions of several kinds where a step fails
                print(f"  EXUDYN: {run}: {str(failure).strip().splitlines()[-1][-90:]}", file=sys.stderr)
                continue
            yield Made(run, self.problem.error(points), seconds)


class Withy:
    """Script of a problem for withy, which executes all runs."""

    def __init__(self, problem):
        self.problem, self.name = problem, "withy"

    def make(self, runs):
        script = self.problem.SCRIPT + "".join(self.call(run) for run in runs)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "pairs.rhai"
            file.write_text(script)
            command = [WITHY, "run", "--quiet", "--out", folder, file]
            done = subprocess.run(command, capture_output=True, text=True)
        lines = [line.split()[1:] for line in done.stdout.splitlines() if line.startswith("run ")]
        if done.returncode != 0:
            print(f"  withy: {runs[len(lines)]}: {done.stderr.strip().splitlines()[0][:150]}", file=sys.stderr)
        for run, line in zip(runs, lines):
            seconds, *numbers = map(float, line)
            points = [numbers[at:at + 2] for at in range(0, len(numbers), 2)]
            yield Made(run, self.problem.error(points), seconds)

    def call(self, run):
        """Statement of the script that executes a run and prints its time and its points."""
        return f"print_run(make({run.mesh}), {run.method}(), {self.problem.DURATION}, {run.steps});\n"


# Common last part of the scripts: make(mesh) returns a scene and the compared points.
PRINT_RUN = """
fn print_run(made, integrator, duration, steps) {
    let sim = made.scene.start(#{ integrator: integrator, dt: duration / steps });
    let begun = timestamp();
    sim.run_to(duration);
    let line = `run ${begun.elapsed}`;
    for point in made.points {
        let at = sim.position(point);
        line += ` ${at.x} ${at.y}`;
    }
    print(line);
}
"""


def sweep(side, ladders):
    """Executes all runs of the ladders. A ladder is a list of runs with one mesh and method and decreasing steps. It ends when a run takes too long."""
    made = []
    for ladder in ladders:
        rungs = []
        for run in ladder:
            rungs += list(side.make([run]))
            if rungs and rungs[-1].seconds > LONGEST:
                break
        made.append(rungs)
    return made


def cheapest_confirmed(ladders, level):
    """Fastest runs with an error below a level, for which all runs with smaller steps are also below this level."""
    confirmed = []
    for rungs in ladders:
        bad = [at for at, rung in enumerate(rungs) if not rung.error < level]
        confirmed += rungs[bad[-1] + 1 if bad else 0:]
    return sorted(confirmed, key=lambda rung: rung.seconds)[:CANDIDATES]


def race(sides, candidates, rounds):
    """Smallest time of each candidate. The candidates of both programs run alternately."""
    least = {}
    for _ in range(rounds):
        for side in sides:
            for run, seconds in candidates[side.name].items():
                repeats = max(1, min(20, round(TIME_LIMIT / seconds)))
                times = [made.seconds for made in side.make([run] * repeats)]
                key = side.name, run
                least[key] = min(times + [least.get(key, math.inf)])
    return least


def compare(problem, rounds):
    """Prints the table of a problem."""
    sides = [Withy(problem), Exudyn(problem)]
    begun = time.perf_counter()
    swept = {side.name: sweep(side, ladders) for side, ladders in zip(sides, (problem.withy_runs(), problem.exudyn_runs()))}
    count = sum(len(rungs) for ladders in swept.values() for rungs in ladders)
    print(f"\n{problem.TITLE}: {count} runs swept in {time.perf_counter() - begun:.0f} s", flush=True)
    chosen = {level: {side.name: cheapest_confirmed(swept[side.name], level) for side in sides} for level in problem.LEVELS}
    candidates = {side.name: {made.run: made.seconds for level in problem.LEVELS for made in chosen[level][side.name]} for side in sides}
    least = race(sides, candidates, rounds)
    print("| error at most | withy | with | EXUDYN | with | times faster |\n| --- | --- | --- | --- | --- | --- |")
    for level in problem.LEVELS:
        cells, times = [], []
        for side in sides:
            ranked = sorted((least[side.name, made.run], made) for made in chosen[level][side.name])
            if not ranked:
                cells += ["-", "none of its runs"]
                continue
            seconds, made = ranked[0]
            times.append(seconds)
            cells += [f"{seconds * 1e3:.3g} ms", f"{made.run} ({made.error:.1e})"]
        ratio = f"{times[1] / times[0]:.1f}" if len(times) == 2 else "-"
        print(f"| {level:.0e} | {' | '.join(cells)} | {ratio} |", flush=True)


def machine():
    """Description of the machine: processor, cores, load."""
    try:
        names = re.findall(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    except OSError:
        names = []
    name = names[0] if names else platform.processor() or platform.machine()
    load = ", load {:.1f} {:.1f} {:.1f}".format(*os.getloadavg()) if hasattr(os, "getloadavg") else ""
    return f"{name}, {os.cpu_count()} cores{load}, {platform.system()}"


def main():
    import four_bar
    import slider
    import spaghetti

    problems = {
        "flying_spaghetti": spaghetti.FlyingSpaghetti,
        "stiffer_spaghetti": spaghetti.StifferSpaghetti,
        "smooth_throw": spaghetti.SmoothThrow,
        "four_bar": four_bar.FourBar,
        "cable_slider": slider.CableSlider,
    }
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("problems", nargs="*", metavar="PROBLEM", help=", ".join(problems))
    arguments.add_argument("--rounds", type=int, default=5)
    given = arguments.parse_args()
    if unknown := [name for name in given.problems if name not in problems]:
        sys.exit(f"no problem {unknown[0]}: choose of {', '.join(problems)}")
    if not WITHY.is_file():
        sys.exit(f"{WITHY} is missing: cargo build --release")
    print(f"before: {machine()}")
    for name in given.problems or problems:
        compare(problems[name](), given.rounds)
    print(f"\nafter:  {machine()}")


if __name__ == "__main__":
    main()
