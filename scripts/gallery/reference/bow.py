"""Draw of the bow of bow.rhai at 150 N, computed without withy: python3 bow.py.

Each limb is an inextensible cantilever elastica of length 0.75 m with EI = 60 N m². It starts at (0, 0.1) at an angle of 105 degrees, and the string acts on
its tip. Half of the string has the unstretched length 0.8 m and the stiffness 1e5 N/m. Shooting method from the tip, with a Runge–Kutta method of order 4.
"""

from math import cos, pi, sin

EI, LIMB, GRIP, STRING, STIFFNESS, DRAW = 60.0, 0.75, 0.1, 0.8, 1e5, 150.0
FOOT = 105 * pi / 180
STEPS = 400


def limb(tip_angle, tension, slope):
    """Position of the foot of the limb relative to its tip, and its angle at the foot. The string pulls towards (-cos slope, -sin slope)."""
    pull = (-tension * cos(slope), -tension * sin(slope))

    def rates(state):
        x, y, angle = state
        # The integration starts at the tip. EI times the curvature equals the moment of the string force about the section.
        return (-cos(angle), -sin(angle), -(-x * pull[1] + y * pull[0]) / EI)

    state, h = (0.0, 0.0, tip_angle), LIMB / STEPS
    for _ in range(STEPS):
        a = rates(state)
        b = rates([s + h / 2 * r for s, r in zip(state, a)])
        c = rates([s + h / 2 * r for s, r in zip(state, b)])
        d = rates([s + h * r for s, r in zip(state, c)])
        state = [s + h / 6 * (p + 2 * q + 2 * r + t) for s, p, q, r, t in zip(state, a, b, c, d)]
    return state


def misses(tip_angle, slope):
    tension = DRAW / 2 / cos(slope)
    x, y, angle = limb(tip_angle, tension, slope)
    tip = (-x, GRIP - y)
    string = STRING + tension / STIFFNESS
    nock = (tip[0] - string * cos(slope), tip[1] - string * sin(slope))
    return (angle - FOOT, nock[1]), nock[0], tip


def solve(tip_angle=2.4, slope=0.9):
    for _ in range(50):
        (f, g), draw, tip = misses(tip_angle, slope)
        h = 1e-6
        (fa, ga), *_ = misses(tip_angle + h, slope)
        (fs, gs), *_ = misses(tip_angle, slope + h)
        fa, ga, fs, gs = (fa - f) / h, (ga - g) / h, (fs - f) / h, (gs - g) / h
        det = fa * gs - fs * ga
        da, ds = (fs * g - f * gs) / det, (ga * f - fa * g) / det
        tip_angle, slope = tip_angle + da, slope + ds
        if abs(da) + abs(ds) < 1e-12:
            break
    return draw, tip


if __name__ == "__main__":
    draw, tip = solve()
    print(f"the nock is at x = {draw:.8f}, the tip at ({tip[0]:.8f}, {tip[1]:.8f})")
