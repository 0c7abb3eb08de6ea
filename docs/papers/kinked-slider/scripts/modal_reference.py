#!/usr/bin/env python3
"""Contact force of a mass that crosses a simply supported Timoshenko beam, by modal superposition (reference of table 9).

    pip install numpy
    python3 scripts/modal_reference.py

Writes scripts/reference/bridge.csv: mean contact force of each step divided by the weight, in columns mMASS_START. The method is that of
tests/sliding/moving_mass.rs: 1000 deflection and 1000 rotation modes, trapezoidal rule, the mass on the beam at the end of every step.
"""

import csv
from pathlib import Path

import numpy as np

LENGTH, EI, GA, RHO_A, RHO_I, WEIGHT, SPEED = 10.0, 1e6, 3e7, 20.0, 0.2, 1000.0, 20.0
MODES, STEP, STEPS = 1000, 1e-3, 350
CASES = [(5, 0.0), (50, 0.0), (500, 0.0), (5, 2.3), (50, 2.3), (500, 2.3)]


def forces(mass, place):
    """Mean contact forces of all steps, divided by the weight."""
    k = np.arange(1, MODES + 1) * np.pi / LENGTH
    half = LENGTH / 2
    coupling = -GA * half * k
    stiffness = np.array([GA * half * k * k, GA * half + EI * half * k * k])
    inertia = np.array([RHO_A * half, RHO_I * half])[:, None]
    first, second = 2 * inertia / STEP**2 + stiffness / 2
    determinant = first * second - coupling**2 / 4
    response = np.array([second, -coupling / 2]) / determinant
    q, rates = np.zeros((2, MODES)), np.zeros((2, MODES))
    speed, fall_rate, force = SPEED, 0.0, WEIGHT
    for _ in range(STEPS):
        speed -= STEP * force / mass * np.sum(k * np.cos(k * place) * q[0])
        before, place = np.sin(k * place), place + STEP * speed
        after = np.sin(k * place)
        load = 2 * inertia * rates / STEP - (stiffness * q + coupling * q[::-1])
        free = np.array([second * load[0] - coupling / 2 * load[1], first * load[1] - coupling / 2 * load[0]]) / determinant
        modal = response * (before + after) / 2
        sunk = np.sum(after * (q[0] + free[0]) - before * q[0])
        own = STEP**2 / (2 * mass)
        fall = STEP * fall_rate - own * WEIGHT
        force = (sunk - fall) / (own + np.sum(after * modal[0]))
        fall_rate = 2 * (fall + own * force) / STEP - fall_rate
        step = free - force * modal
        q, rates = q + step, 2 * step / STEP - rates
        yield force / WEIGHT


def main():
    columns = [list(forces(mass, place)) for mass, place in CASES]
    names = [f"m{mass}_{place:g}".replace(".", "_") for mass, place in CASES]
    with open(Path(__file__).parent / "reference" / "bridge.csv", "w", newline="", encoding="utf8") as file:
        writer = csv.writer(file)
        writer.writerow(["t", *names])
        writer.writerows([f"{STEP * (row + 1):.6g}", *(f"{force:.9g}" for force in forces)] for row, forces in enumerate(zip(*columns)))


main()
