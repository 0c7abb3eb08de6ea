#!/usr/bin/env python3
"""Peak memory and processor time of runs of a free beam, for several numbers of spans, steps and records.

    cargo build --release
    python3 benches/memory.py target/release/withy
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

# Numbers of spans and steps, and interval of recorded steps.
RUNS = [(1000, 200, 1), (1000, 2000, 10), (1000, 2000, 1), (1000, 10_000, 1), (14, 1000, 1), (14, 20_000, 1)]

SCRIPT = """
let slender = section(#{{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 }});
let scene = new_scene("many spans");
let rod = scene.beam(#{{ axis: line([0, 0], [{x}, -{y}]), basis: bspline({spans}), section: slender }});
scene.force(rod.start, [-8, 0], hold_for(2.5));
scene.force(rod.end, [8, 0], hold_for(2.5));
let sim = scene.start(#{{ dt: 0.1, record: every({every}) }});
sim.run_to({end});
print(`${{sim.steps}} steps, ${{sim.history.rows}} records`);
"""


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    program = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        for spans, steps, every in RUNS:
            script = Path(folder) / "run.rhai"
            x, y = 6 / 14 * spans, 8 / 14 * spans
            script.write_text(SCRIPT.format(x=x, y=y, spans=spans, every=every, end=0.1 * steps))
            run = subprocess.Popen([program, "run", script], cwd=folder, stdout=subprocess.PIPE, text=True)
            said = run.stdout.read().strip().splitlines()
            _, status, usage = os.wait4(run.pid, 0)
            if status:
                sys.exit(f"{script.read_text()}\nfailed: {said}")
            print(f"{spans:>5} spans, {said[-1]}: {usage.ru_maxrss / 1000:.0f} MB, {usage.ru_utime:.2f} s")


if __name__ == "__main__":
    main()
