#!/usr/bin/env python3
"""Errors of EXUDYN's sliding joint on cable elements, in the mesh and in time (table 6).

    pip install exudyn==1.13.6 numpy
    python3 scripts/exudyn_slider.py --out data

The model is that of benches/exudyn/slider.py: a mass slides on a beam that turns about a hinge, t = 0.4. Its cable elements (ANCF, two nodes) have
no shear. They are compared with two solutions: of the beam without shear, extrapolated from runs of withy (file cable.csv of scripts/cable.rhai), and of the
beam with shear (reference P7c). The energy is evaluated with numpy at the end of every step.
"""

import argparse
import csv
import math
import sys
from pathlib import Path

PAPER = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PAPER.parents[2] / "benches" / "exudyn"))

import numpy as np
import exudyn
from slider import EA, EI, LENGTH, MASS, RHO_A, CableSlider
from solving import Clock, positions

AXIAL = np.polynomial.legendre.leggauss(5)
BENDING = np.polynomial.legendre.leggauss(3)


def shapes(s, h):
    x = s / h
    return np.array([1 - 3 * x**2 + 2 * x**3, s - 2 * h * x**2 + h * x**3, 3 * x**2 - 2 * x**3, h * (x**3 - x**2)])


def slopes(s, h):
    x = s / h
    return np.array([(-6 * x + 6 * x**2) / h, 1 - 4 * x + 3 * x**2, (6 * x - 6 * x**2) / h, 3 * x**2 - 2 * x])


def bends(s, h):
    x = s / h
    return np.array([(-6 + 12 * x) / h**2, (-4 + 6 * x) / h, (6 - 12 * x) / h**2, (6 * x - 2) / h])


def energy(system, elements, mass):
    """Energy of the discrete model: cable elements and the mass."""
    h, kind, at = LENGTH / elements, exudyn.OutputVariableType, exudyn.ConfigurationType.Reference
    nodes = range(elements + 1)
    q = np.array([system.GetNodeOutput(n, kind.Coordinates, at) + system.GetNodeOutput(n, kind.Coordinates) for n in nodes])
    v = np.array([system.GetNodeOutput(n, kind.Coordinates_t) for n in nodes])
    q, v = (np.concatenate([a[:-1].reshape(-1, 2, 2), a[1:].reshape(-1, 2, 2)], axis=1) for a in (q, v))
    total = 0.5 * MASS * np.sum(system.GetNodeOutput(mass, kind.Velocity) ** 2)
    for x, w in zip(*AXIAL):
        s, w = (x + 1) * h / 2, w * h / 2
        rate = np.einsum("i,eik->ek", shapes(s, h), v)
        slope = np.einsum("i,eik->ek", slopes(s, h), q)
        total += w * np.sum(0.5 * RHO_A * (rate**2).sum(1) + 0.5 * EA * (np.linalg.norm(slope, axis=1) - 1) ** 2)
    for x, w in zip(*BENDING):
        s, w = (x + 1) * h / 2, w * h / 2
        slope = np.einsum("i,eik->ek", slopes(s, h), q)
        bend = np.einsum("i,eik->ek", bends(s, h), q)
        curvature = (slope[:, 0] * bend[:, 1] - slope[:, 1] * bend[:, 0]) / (slope**2).sum(1)
        total += w * np.sum(0.5 * EI * curvature**2)
    return total


def run(elements, method, steps):
    """Positions of mass and end at t = 0.4, and the largest relative change of the energy."""
    problem = CableSlider()
    system, nodes = problem.model(elements, classical=not method.startswith("trapezoidal"))
    first = energy(system, elements, nodes[0])
    changes = [0.0]

    def after_step(system, _):
        changes.append(abs(energy(system, elements, nodes[0]) / first - 1))
        return True

    system.SetPostStepUserFunction(after_step)
    Clock().solve(system, 0.0, problem.DURATION, method, steps, dense=elements <= 8)
    return positions(system, nodes), max(changes)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=PAPER / "data")
    out = parser.parse_args().out
    with open(PAPER / "scripts" / "reference" / "P7c.csv", encoding="utf8") as file:
        table = csv.DictReader(line for line in file if not line.startswith("#"))
        row = next(row for row in table if abs(float(row["t"]) - 0.4) < 1e-9)
    with_shear = [[float(row[x]), float(row[y])] for x, y in (("xC", "yC"), ("xB", "yB"))]
    with open(out / "cable.csv", encoding="utf8") as file:
        limit = next(row for row in csv.DictReader(file) if row["rule"] == "limit")
    without_shear = [[float(limit[x]), float(limit[y])] for x, y in (("x", "y"), ("tip_x", "tip_y"))]
    rows = []
    for method in ("alpha 0.9", "trapezoidal"):
        for elements, steps in [(2, 3200), (4, 3200), (8, 3200), (16, 3200), (32, 3200), (8, 50), (8, 100), (8, 200), (8, 400), (8, 800)]:
            try:
                points, change = run(elements, method, steps)
            except RuntimeError as failure:
                print(f"{method}, {elements} elements, {steps} steps: {failure}")
                continue
            errors = {f"{name}_{what}": math.dist(points[at], solution[at]) for name, solution in
                      (("cable", without_shear), ("beam", with_shear)) for at, what in enumerate(("mass", "end"))}
            rows.append({"method": method, "elements": elements, "steps": steps, "energy": change, **errors})
            print(", ".join(f"{key} {value:.2e}" if isinstance(value, float) else f"{value}" for key, value in rows[-1].items()), flush=True)
    with open(out / "exudyn.csv", "w", newline="", encoding="utf8") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)


main()
