"""A mass slides along a beam that rotates about a hinge, as in scripts/studies/sliding_mass.rhai, but without shear.

The sliding joint of EXUDYN requires cable elements, which have neither shear deformation nor rotary inertia. The beam of the study has both. Here the shear
stiffness of the beam in withy is 1e4 times its axial stiffness, and its rotary inertia is so small that both programs converge to the same solution.
"""

import math

from exudyn.utilities import (Cable2D, CoordinateConstraint, MarkerBodyCable2DCoordinates, MarkerNodeCoordinate,
                              MarkerNodePosition, MassPoint2D, NodeGenericData, NodePointGround, ObjectJointSliding2D, Point2D,
                              Point2DS1)
import exudyn

import pairs
from solving import Clock, positions

END = (3.0, 1.0)
LENGTH = math.hypot(*END)
ALONG = (END[0] / LENGTH, END[1] / LENGTH)
EI, EA, RHO_A, MASS, SPEED, AT = 20.0, 100.0, 0.08, 1.0, 5.0, 0.95
GA, RHO_I = 1e6, 1e-6
PLACE = (AT * END[0], AT * END[1])
VELOCITY = (-PLACE[1] - SPEED * ALONG[0], PLACE[0] - SPEED * ALONG[1])

SCRIPT = f"""
fn make(mesh) {{
    let material = section(#{{ EI: {EI}, EA: {EA}, GA: {GA}, rho_A: {RHO_A}, rho_I: {RHO_I} }});
    let scene = new_scene("sliding mass");
    let beam = scene.beam(#{{ axis: line([0, 0], {list(END)}), basis: mesh, section: material, spin: 1, about: [0, 0] }});
    scene.hinge(beam.start);
    let mass = scene.particle({list(PLACE)}, {MASS}, #{{ velocity: {list(VELOCITY)} }});
    scene.slider(mass, beam, #{{ at: {AT} }});
    #{{ scene: scene, points: [mass, beam.end] }}
}}
"""


class CableSlider:
    """Motion until t = 0.4: the mass slides inwards and is slowed down by the rotation. The reference is the common limit of both programs."""

    TITLE, DURATION = "a mass that slides on a turning cable", 0.4
    SCRIPT = SCRIPT + pairs.PRINT_RUN
    LEVELS = pairs.LEVELS[:3]
    # Positions of the mass and the end of the beam. The results of withy with 32 and 64 spans and GA = 1e6 and 1e7, and of EXUDYN with 16 elements and
    # generalized-alpha, extrapolated from 2560 and 5120 steps, agree within 2e-5.
    reference = [[0.652261, 1.336716], [1.577236, 2.825838]]

    def error(self, points):
        """Larger position error of the mass and the end of the beam, divided by the length."""
        return pairs.largest_distance(points, self.reference) / LENGTH

    def withy_runs(self):
        for spans in (2, 3, 4, 6, 8, 12, 16, 24):
            for method, first in (("fourth_order", 4), ("energy_momentum", 5)):
                yield [pairs.Run(f"bspline({spans})", method, round(first * 2 ** (at / 2))) for at in range(13)]

    def exudyn_runs(self):
        for elements in (1, 2, 3, 4, 6, 8, 16):
            for method in ("trapezoidal", "trapezoidal full", "alpha 0.9", "alpha 0.6", "alpha 0"):
                yield [pairs.Run(f"{elements} elements", method, round(5 * 2 ** (at / 2))) for at in range(19)]

    def run_exudyn(self, run):
        elements = int(run.mesh.split()[0])
        # The index-2 method uses the joint equations for velocities, the other methods those for positions.
        system, nodes = self.model(elements, classical=not run.method.startswith("trapezoidal"))
        clock = Clock()
        clock.solve(system, 0.0, self.DURATION, run.method, run.steps, dense=elements <= 8)
        return clock.least(), positions(system, nodes)

    def model(self, elements, *, classical):
        """Model with cable elements of two nodes. Returns the system, and the nodes of the mass and of the end."""
        self.container = exudyn.SystemContainer()
        system = self.container.AddSystem()
        span = LENGTH / elements
        places = [[END[0] * at / elements, END[1] * at / elements] for at in range(elements + 1)]
        nodes = [system.AddNode(Point2DS1(referenceCoordinates=[*place, *ALONG],
                                          initialVelocities=[-place[1], place[0], -ALONG[1], ALONG[0]])) for place in places]
        cables = [system.AddObject(Cable2D(nodeNumbers=[nodes[at], nodes[at + 1]], length=span, massPerLength=RHO_A,
                                           bendingStiffness=EI, axialStiffness=EA)) for at in range(elements)]
        ground = system.AddMarker(MarkerNodeCoordinate(nodeNumber=system.AddNode(NodePointGround()), coordinate=0))
        for axis in (0, 1):
            held = system.AddMarker(MarkerNodeCoordinate(nodeNumber=nodes[0], coordinate=axis))
            system.AddObject(CoordinateConstraint(markerNumbers=[ground, held]))
        mass = system.AddNode(Point2D(referenceCoordinates=list(PLACE), initialVelocities=list(VELOCITY)))
        system.AddObject(MassPoint2D(mass=MASS, nodeNumber=mass))
        marker = system.AddMarker(MarkerNodePosition(nodeNumber=mass))
        cable_markers = [system.AddMarker(MarkerBodyCable2DCoordinates(bodyNumber=cable)) for cable in cables]
        first = min(int(AT * elements), elements - 1)
        data = system.AddNode(NodeGenericData(initialCoordinates=[first, AT * LENGTH], numberOfDataCoordinates=2))
        system.AddObject(ObjectJointSliding2D(
            markerNumbers=[marker, cable_markers[first]], slidingMarkerNumbers=cable_markers,
            slidingMarkerOffsets=[span * at for at in range(elements)], nodeNumber=data, useClassicalFormulation=classical))
        system.Assemble()
        return system, (mass, nodes[-1])
