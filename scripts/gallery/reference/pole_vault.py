"""Motion of the vaulter of pole_vault.rhai on a massless pole, computed without withy in a few seconds: python3 pole_vault.py.

The pole is an inextensible elastica with the initial curvature k, pinned at both ends. Its force acts along its chord. With the angle u to the
chord, EI u'² = EI k² + 2 P (cos u - cos a), where a is the angle at the ends. Length and chord are the integrals of du/u' and cos u du/u' from -a to a.
The vaulter is a point mass under this force and gravity: four ordinary differential equations, solved by a Runge–Kutta method of order 4.
"""

from math import asin, cos, hypot, pi, radians, sin, sqrt

EI, MASS, GRAVITY, CHORD, RISE = 2500.0, 75.0, 9.81, 4.5, 0.2
RADIUS = (CHORD**2 / 4 + RISE**2) / (2 * RISE)
HALF = asin(CHORD / 2 / RADIUS)
LENGTH = 2 * RADIUS * HALF
CELLS = 60
# Substitution u = a sin(v), which makes the integrand smooth. Simpson's rule in v from 0 to pi/2.
NODES = [
    (sin(pi / 2 * i / CELLS), cos(pi / 2 * i / CELLS), pi / 2 / CELLS / 3 * (1 if i in (0, CELLS) else 4 if i % 2 else 2))
    for i in range(CELLS + 1)
]


def length_and_chord(a, force):
    length = chord = 0.0
    for s, c, weight in NODES:
        u = a * s
        part = 2 * a * c * weight / sqrt(RADIUS**-2 + 2 * force / EI * (cos(u) - cos(a)))
        length += part
        chord += part * cos(u)
    return length, chord


def push(chord, guess):
    """Newton's method for the end angle and the force of a pole with a given chord."""
    a, force = guess
    for _ in range(30):
        f, g = length_and_chord(a, force)
        h, k = 1e-6, 1e-4
        fa, ga = length_and_chord(a + h, force)
        fp, gp = length_and_chord(a, force + k)
        fa, ga, fp, gp = (fa - f) / h, (ga - g) / h, (fp - f) / k, (gp - g) / k
        f, g = f - LENGTH, g - chord
        det = fa * gp - fp * ga
        da, dp = (fp * g - f * gp) / det, (ga * f - fa * g) / det
        a, force = a + da, force + dp
        if abs(da) < 1e-10 and abs(dp) < 1e-7:
            break
    return a, force


def fly(end, steps):
    start = radians(150)
    state = [CHORD * cos(start), CHORD * sin(start), 8.0, 2.5]
    guess = (HALF, 0.0)

    def rates(state):
        nonlocal guess
        x, y, vx, vy = state
        chord = hypot(x, y)
        guess = push(chord, guess)
        pull = guess[1] / chord / MASS
        return [vx, vy, pull * x, pull * y - GRAVITY]

    dt = end / steps
    for _ in range(steps):
        a = rates(state)
        b = rates([s + dt / 2 * r for s, r in zip(state, a)])
        c = rates([s + dt / 2 * r for s, r in zip(state, b)])
        d = rates([s + dt * r for s, r in zip(state, c)])
        state = [s + dt / 6 * (p + 2 * q + 2 * r + t) for s, p, q, r, t in zip(state, a, b, c, d)]
    return state


if __name__ == "__main__":
    for steps in (125, 250, 500):
        x, y, *_ = fly(0.5, steps)
        print(f"{steps} steps: x = {x:.8f}, y = {y:.8f}")
