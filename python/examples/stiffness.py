"""Deflection of a cantilever under its weight, over its bending stiffness."""

import numpy as np
import withy


def deflection(stiffness: float) -> float:
    session = withy.Session(echo=None)
    scene = session.new_scene("cantilever")
    section = session.section(EA=1e8, GA=1e8, EI=stiffness, rho_A=0.5, rho_I=1e-3)
    axis = session.line([0, 0], [2, 0])
    scene.beam(name="rod", axis=axis, basis=session.bspline(8), section=section)
    scene.clamp("rod.start")
    scene.gravity([0, -9.81])
    return -scene.equilibrium().position("rod.end")[1]


print(" EI     deflection   small deflection q L⁴ / (8 EI)")
for stiffness in np.geomspace(1e1, 1e4, 7):
    print(f"{stiffness:7.1f}  {deflection(stiffness):9.6f}  {0.5 * 9.81 * 2**4 / (8 * stiffness):9.6f}")
