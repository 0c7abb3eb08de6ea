#!/usr/bin/env python3
"""Sets withy beside EXUDYN on the flying spaghetti: by turns, on one machine, on one core, for errors of 1e-2, 1e-3 and 1e-4.

    pip install exudyn==1.13.6 numpy
    cargo build --release
    python3 benches/compare_exudyn.py [ROUNDS]

A round runs both programs at each of the three errors, each of them for about half a second; what counts is the least time
of all rounds (10 unless given), which is that of a run that nothing else disturbed. withy's is that by the clock of its own
process, from the first step to the last, records included; EXUDYN's that of its calls of the solver, by the clock or of the
processor, whichever is less. Neither holds the start of the process or the building of the model.

The settings of EXUDYN are its cheapest of 411 runs that were measured for this project (scripts/studies/rivals/README.md);
those of withy its cheapest of which all smaller steps on the same mesh are as good (docs/studies.md, cheapest_confirmed). Both
errors are checked against scripts/studies/reference/P1.csv. The model of EXUDYN is that of the project's sweeps, from which
scripts/studies/rivals/flying_spaghetti.csv was made.
"""

import os
import sys

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import csv
import math
import platform
import re
import subprocess
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
WITHY = ROOT / "target" / "release" / "withy"
REFERENCE = ROOT / "scripts" / "studies" / "reference" / "P1.csv"
VERSION = "1.13.6"

try:
    import exudyn
    from exudyn.utilities import Force, MarkerNodeRigid, ObjectBeamGeometricallyExact2D, Rigid2D, Torque
except ImportError as missing:
    sys.exit(f"{missing}: pip install exudyn=={VERSION} numpy")

# The card: Simo & Vu-Quoc (1986), Part II, with EI = 100; as scripts/studies/flying_spaghetti.rhai.
LENGTH, EA, GA, EI, RHO_A, RHO_I = 10.0, 1e4, 1e4, 100.0, 1.0, 10.0
START, END = (0.0, 8.0), (6.0, 0.0)
FORCE, MOMENT, T_LOAD, T_END = 8.0, -80.0, 2.5, 7.5

PATIENCE = 0.5  # seconds for each program, error and round
FEWEST_REPEATS = 2

# The largest error; EXUDYN's three-node elements, method and steps until the load ends; withy's spans, integrator and dt.
POINTS = [
    (1e-2, (8, "trapezoidal", 50), (8, "fourth_order", "0.5")),
    (1e-3, (16, "VelocityVerlet", 1740), (12, "fourth_order", "2.5 / 11")),
    (1e-4, (32, "VelocityVerlet", 3479), (44, "fourth_order", "0.025")),
]

WITHY_SCRIPT = """
let slender = section(#{{ EA: {EA}, GA: {GA}, EI: {EI}, rho_A: {RHO_A}, rho_I: {RHO_I} }});
for repeat in 0..{repeats} {{
    let scene = new_scene("flying spaghetti");
    let rod = scene.beam(#{{ axis: line({START}, {END}), basis: bspline({spans}), section: slender }});
    scene.force(rod.end, [{FORCE}, 0], hold_for({T_LOAD}));
    scene.moment(rod.end, {MOMENT}, hold_for({T_LOAD}));
    let sim = scene.start(#{{ integrator: {integrator}(), dt: {dt} }});
    let begun = timestamp();
    sim.run_to({T_END});
    let elapsed = begun.elapsed;
    let a = sim.position(rod.start);
    let b = sim.position(rod.end);
    print(`run ${{elapsed}} ${{a.x}} ${{a.y}} ${{b.x}} ${{b.y}}`);
}}
"""


class Rod:
    """EXUDYN's model of the card with three-node elements."""

    def __init__(self, elements):
        self.container = exudyn.SystemContainer()
        self.system = system = self.container.AddSystem()
        nodes = 2 * elements + 1
        angle = math.atan2(END[1] - START[1], END[0] - START[0])
        share = [node / (nodes - 1) for node in range(nodes)]
        self.places = [[a + (b - a) * part for a, b in zip(START, END)] for part in share]
        numbers = [system.AddNode(Rigid2D(referenceCoordinates=[*place, angle])) for place in self.places]
        for element in range(elements):
            system.AddObject(ObjectBeamGeometricallyExact2D(
                nodeNumbers=numbers[2 * element:2 * element + 3], length=LENGTH / elements, massPerLength=RHO_A,
                crossSectionInertia=RHO_I, bendingStiffness=EI, axialStiffness=EA, shearStiffness=GA))
        end = system.AddMarker(MarkerNodeRigid(nodeNumber=numbers[-1]))
        self.loads = [system.AddLoad(Force(markerNumber=end, loadVector=[FORCE, 0, 0])),
                      system.AddLoad(Torque(markerNumber=end, loadVector=[0, 0, MOMENT]))]
        system.Assemble()

    def ends(self):
        """Where the ends are: x0, y0, xL, yL."""
        moved = list(self.system.systemData.GetODE2Coordinates())
        return [self.places[end][axis] + moved[first + axis] for end, first in ((0, 0), (-1, len(moved) - 3))
                for axis in (0, 1)]

    def release(self):
        """Takes the loads away."""
        for load in self.loads:
            self.system.SetLoadParameter(load, "loadVector", [0, 0, 0])


def exudyn_settings(start, end, method, steps):
    """What the fastest runs of the sweeps had: sparse solver, modified Newton with loose tolerances, no files."""
    settings = exudyn.SimulationSettings()
    integration = settings.timeIntegration
    integration.startTime, integration.endTime, integration.numberOfSteps = start, end, steps
    integration.verboseMode = 0
    integration.newton.useModifiedNewton = True
    integration.newton.relativeTolerance, integration.newton.absoluteTolerance = 1e-6, 1e-8
    settings.solution.file.write = False
    settings.solution.sensors.writePeriod = 1e9
    settings.show.statistics = settings.show.computationTime = False
    settings.linearSolver.solverType = exudyn.LinearSolverType.EigenSparse
    kind = exudyn.DynamicSolverType
    return settings, {"trapezoidal": kind.TrapezoidalIndex2, "VelocityVerlet": kind.VelocityVerlet}[method]


def run_exudyn(elements, method, steps):
    """The times of one run [s], by the clock and of the processor, and where the ends are.

    Two solves, with new accelerations where the load jumps.
    """
    rod = Rod(elements)
    clock = processor = 0.0
    for start, end in ((0.0, T_LOAD), (T_LOAD, T_END)):
        if start > 0.0:
            rod.release()
        settings, kind = exudyn_settings(start, end, method, round((end - start) / T_LOAD * steps))
        begun, worked = time.perf_counter(), time.process_time()
        solved = rod.system.SolveDynamic(settings, solverType=kind, storeSolver=True, updateInitialValues=start == 0.0,
                                         showHints=False, showCausingItems=False)
        clock, processor = clock + time.perf_counter() - begun, processor + time.process_time() - worked
        if not solved:
            sys.exit(f"EXUDYN failed: {elements} elements, {method}, {steps} steps")
    return clock, processor, rod.ends()


def run_withy(spans, integrator, dt, repeats):
    """The least time by the clock of several runs in one process [s], and where the ends are."""
    script = WITHY_SCRIPT.format(**globals() | {"START": list(START), "END": list(END)}, spans=spans,
                                 integrator=integrator, dt=dt, repeats=repeats)
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "spaghetti.rhai"
        file.write_text(script)
        done = subprocess.run([WITHY, "run", "--quiet", "--out", folder, file], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"withy failed:\n{done.stdout}{done.stderr}")
    runs = [[float(word) for word in line.split()[1:]] for line in done.stdout.splitlines() if line.startswith("run ")]
    return min(run[0] for run in runs), runs[-1][1:]


def reference_ends():
    """Where the ends are at the end, by an independent solution."""
    with open(REFERENCE, newline="") as file:
        rows = csv.DictReader(line for line in file if not line.startswith("#"))
        row = next(row for row in rows if abs(float(row["t"]) - T_END) < 1e-9)
    return [float(row[name]) for name in ("x0", "y0", "xL", "yL")]


def error(ends, reference):
    """The larger distance of the two ends from where they should be, by the length."""
    return max(math.dist(ends[at:at + 2], reference[at:at + 2]) for at in (0, 2)) / LENGTH


def machine():
    """What ran it: processor, cores, load."""
    try:
        names = re.findall(r"^model name\s*:\s*(.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    except OSError:
        names = []
    name = names[0] if names else platform.processor() or platform.machine()
    load = ", load {:.1f} {:.1f} {:.1f}".format(*os.getloadavg()) if hasattr(os, "getloadavg") else ""
    return f"{name}, {os.cpu_count()} cores{load}, {platform.system()}"


def compare(rounds):
    """The rows of the table: the least times of both programs, and their errors."""
    reference = reference_ends()
    rows = [{"least": least, "withy": math.inf, "exudyn": math.inf} for least, *_ in POINTS]
    for _ in range(rounds):
        for row, (_, theirs, ours) in zip(rows, POINTS):
            begun, repeats = time.perf_counter(), 0
            while repeats < FEWEST_REPEATS or time.perf_counter() - begun < PATIENCE:
                clock, processor, ends = run_exudyn(*theirs)
                row["exudyn"], repeats = min(row["exudyn"], clock, processor), repeats + 1
            row["error of EXUDYN"] = error(ends, reference)
            expected = row["withy"] if math.isfinite(row["withy"]) else run_withy(*ours, 1)[0]
            elapsed, ends = run_withy(*ours, max(FEWEST_REPEATS, round(PATIENCE / expected)))
            row["withy"], row["error of withy"] = min(row["withy"], elapsed), error(ends, reference)
    return rows


def main():
    if len(sys.argv) > 2 or not all(word.isdigit() and int(word) for word in sys.argv[1:]):
        sys.exit(__doc__)
    if not WITHY.is_file():
        sys.exit(f"{WITHY} is missing: cargo build --release")
    if exudyn.__version__ != VERSION:
        print(f"This is EXUDYN {exudyn.__version__}; the settings are those of {VERSION}.", file=sys.stderr)
    print(f"before: {machine()}")
    rows = compare(int(sys.argv[1]) if len(sys.argv) > 1 else 10)
    print(f"after:  {machine()}")
    print("least times: withy by the clock over its steps; EXUDYN over its calls of the solver, by the clock or of the processor\n")
    columns = ("error below", "withy [ms]", "its error", "EXUDYN [ms]", "its error", "ratio")
    print(" ".join(f"{column:>12}" for column in columns))
    for row in rows:
        ours, theirs = row["error of withy"], row["error of EXUDYN"]
        print(f"{row['least']:>12.0e} {row['withy'] * 1e3:>12.2f} {ours:>12.1e} {row['exudyn'] * 1e3:>12.1f} "
              f"{theirs:>12.1e} {row['exudyn'] / row['withy']:>12.1f}")
    if any(row[f"error of {name}"] > row["least"] for row in rows for name in ("withy", "EXUDYN")):
        sys.exit("an error is larger than it should be: the table does not compare like with like")


if __name__ == "__main__":
    main()
