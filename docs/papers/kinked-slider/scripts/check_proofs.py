#!/usr/bin/env python3
"""Checks the identities of theorems 1 and 2 with random numbers: the largest relative residuals are printed.

    pip install numpy
    python3 scripts/check_proofs.py
"""

import numpy as np

rng = np.random.default_rng(1)
J = np.array([[0.0, -1.0], [1.0, 0.0]])


def cross(a, b):
    return (J @ a) @ b


def residuals(frozen):
    """Moment of the contact pair, and lost energy of the bodies minus the energy gained by the kink."""
    n = 4
    stiffness, mass = rng.uniform(1, 10), rng.uniform(0.01, 0.1)  # GA and mu rho_A
    mean, difference = rng.normal(size=n), rng.normal(size=n)
    mean, difference = mean - mean.mean() + 1 / n, difference - difference.mean()
    x0, moved = rng.normal(size=(n, 2)), 0.3 * rng.normal(size=(n, 2))
    dxi, stretch, dt, v0 = rng.normal(), rng.uniform(1, 2), rng.uniform(0.1, 1), rng.normal()
    g0, g1 = rng.uniform(0.1, 1, size=2)
    a0 = rng.normal(size=2)
    tau, d = difference @ (x0 + moved / 2), difference @ moved / 4
    square, rate = tau @ tau, (g1 - g0) / dxi
    b = (J @ tau) @ d / square
    e = stretch * tau / square

    def motion(a1):
        r = dxi * d + (g0 * a0 + g1 * a1) / 2
        u = dxi * tau + g1 * a1 - g0 * a0 - 4 * b * J @ r
        v1 = 2 * e @ u / dt - v0
        change = mass * (g1 * a1 @ a1 * v1 - g0 * a0 @ a0 * v0)
        return r, u, v1, change, 1 - mass / stiffness * v0 * v1

    if frozen:
        q = 2 * b
        a1 = np.linalg.solve(np.eye(2) - q * J, (np.eye(2) + q * J) @ a0)
        r, u, v1, change, kappa = motion(a1)
        w = tau - 2 * q * J @ d + rate * (np.eye(2) + q * J) @ a0
        pull = kappa * stiffness / 2 * a0 @ a0 * rate
        across = J @ w
        force = change / dt * e + pull * w / (w @ w) + rng.normal() * across
    else:
        w = tau - 4 * b * J @ d
        # Equation (14) is linear in a1; the normal component is arbitrary.
        row, value = w / 2 + rate * (a0 / 2 + b * J @ a0), -a0 @ w / 2
        a1 = np.linalg.solve([row, J @ tau], [value, rng.normal()])
        r, u, v1, change, kappa = motion(a1)
        force = kappa * stiffness * (a0 + a1) / 2 + change / dt * e
    couple = -cross(r, force) * J @ tau / square
    on_master = np.outer(mean, force) - np.outer(difference, couple)
    at_mean = x0 + moved / 2
    slave_mean = mean @ at_mean + r
    slave_moved = mean @ moved + dxi * tau + g1 * a1 - g0 * a0
    moment = -cross(slave_mean, force) + sum(cross(x, f) for x, f in zip(at_mean, on_master))
    work = -force @ slave_moved + np.sum(on_master * moved)
    energies = [stiffness / 2 * g * a @ a + mass / 2 * g * a @ a * v * v for g, a, v in ((g0, a0, v0), (g1, a1, v1))]
    total = -force + on_master.sum(axis=0)
    scale = np.abs(force).max() * (1 + np.abs(slave_moved).max()) + sum(energies)
    return abs(total).max() / scale, abs(moment) / scale, abs(work + energies[1] - energies[0]) / scale


for name, frozen in (("theorem 1", False), ("theorem 2", True)):
    worst = np.max([residuals(frozen) for _ in range(10_000)], axis=0)
    print(f"{name}: force {worst[0]:.1e}, moment {worst[1]:.1e}, energy {worst[2]:.1e}")
