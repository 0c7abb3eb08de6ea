#!/usr/bin/env python3
"""Compares a Newton iteration of withy with the banded solver of LAPACK for the same size and bandwidth, on one core.

    pip install numpy scipy
    cargo bench --bench step -- --csv target/step.csv
    python3 benches/compare_lapack.py target/step.csv

`dgbsv` factorises and solves an existing matrix; an iteration of withy also assembles it. The smallest of several times is
reported, in nanoseconds per unknown.
"""

import os
import sys

for variable in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"):
    os.environ[variable] = "1"

import csv
import time

import numpy
from scipy.linalg import lapack

HALF_BANDWIDTH = 11  # of a beam of cubic splines: four control points with three unknowns each
TIME_LIMIT = 1.0  # seconds for each size
FEWEST_REPEATS = 3


def least_time(unknowns):
    """Smallest time of dgbsv for a diagonally dominant matrix, per unknown [ns]."""
    b = HALF_BANDWIDTH
    random = numpy.random.default_rng(1)
    band = numpy.zeros((3 * b + 1, unknowns), order="F")
    band[b:, :] = random.uniform(-1.0, 1.0, (2 * b + 1, unknowns))
    band[2 * b, :] += 2 * b + 1
    right = random.uniform(-1.0, 1.0, (unknowns, 1))
    times = []
    begun = time.perf_counter()
    while len(times) < FEWEST_REPEATS or time.perf_counter() - begun < TIME_LIMIT:
        matrix, vector = band.copy(order="F"), right.copy(order="F")
        start = time.perf_counter()
        *_, info = lapack.dgbsv(b, b, matrix, vector, overwrite_ab=True, overwrite_b=True)
        times.append(time.perf_counter() - start)
        assert info == 0, f"dgbsv: info = {info}"
    return min(times) / unknowns * 1e9


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    with open(sys.argv[1], newline="") as file:
        rows = list(csv.DictReader(file))
    columns = ("unknowns", "assembly", "factorise", "solve", "sum", "dgbsv", "sum / dgbsv")
    print(" ".join(f"{column:>12}" for column in columns))
    for row in rows:
        parts = [float(row[name]) for name in ("assembly", "factorise", "solve")]
        unknowns, rival = int(row["unknowns"]), least_time(int(row["unknowns"]))
        numbers = [*parts, sum(parts), rival]
        cells = [f"{unknowns:>12}", *(f"{number:>12.1f}" for number in numbers)]
        print(*cells, f"{sum(parts) / rival:>12.2f}")


if __name__ == "__main__":
    main()
