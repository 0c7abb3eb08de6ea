"""Four-bar linkage with a flexible coupler. A heavy rigid crank without a motor drives a rigid rocker."""

import math

from exudyn.utilities import (MarkerBodyRigid, MarkerNodeRigid, ObjectBeamGeometricallyExact2D, ObjectGround,
                              ObjectRigidBody2D, RevoluteJoint2D, Rigid2D)
import exudyn

import pairs
from solving import Clock, positions

# Aluminium strips of Turcic, Midha & Bosnik (1984): lengths, width and thickness [m].
CRANK, COUPLER, ROCKER, GROUND = 0.108, 0.2794, 0.2705, 0.254
WIDTH, THICKNESS, E, DENSITY, POISSON = 0.0254, 0.0016, 7.1e10, 2710.0, 0.33
ANGLE, SPIN = 0.5, 340 * 2 * math.pi / 60
CRANK_MASS, CRANK_INERTIA, ROCKER_MASS, ROCKER_INERTIA = 1.0, 0.02, 0.03, 1.8e-4

AREA, SECOND_MOMENT = WIDTH * THICKNESS, WIDTH * THICKNESS**3 / 12
SECTION = {
    "EA": E * AREA, "GA": 5 / 6 * E / (2 * (1 + POISSON)) * AREA, "EI": E * SECOND_MOMENT,
    "rho_A": DENSITY * AREA, "rho_I": DENSITY * SECOND_MOMENT,
}

FIXED = (GROUND, 0.0)
KNEE = (CRANK * math.cos(ANGLE), CRANK * math.sin(ANGLE))


def elbow():
    """Position of the joint of coupler and rocker, above the line between their other ends."""
    along = (FIXED[0] - KNEE[0], FIXED[1] - KNEE[1])
    distance = math.hypot(*along)
    share = (COUPLER**2 - ROCKER**2 + distance**2) / (2 * distance)
    height = math.sqrt(COUPLER**2 - share**2)
    unit = (along[0] / distance, along[1] / distance)
    return (KNEE[0] + share * unit[0] - height * unit[1], KNEE[1] + share * unit[1] + height * unit[0])


ELBOW = elbow()
KNEE_VELOCITY = (-SPIN * KNEE[1], SPIN * KNEE[0])
ALONG_COUPLER = (ELBOW[0] - KNEE[0], ELBOW[1] - KNEE[1])
ALONG_ROCKER = (ELBOW[0] - FIXED[0], ELBOW[1] - FIXED[1])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1]


def turned(a):
    return (-a[1], a[0])


COUPLER_SPIN = -dot(KNEE_VELOCITY, ALONG_ROCKER) / dot(turned(ALONG_COUPLER), ALONG_ROCKER)
ROCKER_SPIN = dot(KNEE_VELOCITY, ALONG_COUPLER) / dot(turned(ALONG_ROCKER), ALONG_COUPLER)
ROCKER_CENTRE = ((ELBOW[0] + FIXED[0]) / 2, (ELBOW[1] + FIXED[1]) / 2)


def moved(centre, spin, place, velocity=(0.0, 0.0)):
    """Velocity of a point of a body that rotates about a centre."""
    return [velocity[0] - spin * (place[1] - centre[1]), velocity[1] + spin * (place[0] - centre[0])]


SCRIPT = f"""
fn make(mesh) {{
    let strip = section(#{{ {', '.join(f'{name}: {value!r}' for name, value in SECTION.items())} }});
    let scene = new_scene("four-bar");
    let crank = scene.body(#{{ name: "crank", at: [0, 0], mass: {CRANK_MASS}, inertia: {CRANK_INERTIA}, spin: {SPIN!r},
        points: #{{ axle: [0, 0], pin: {list(KNEE)} }} }});
    let rocker = scene.body(#{{ name: "rocker", at: {list(ROCKER_CENTRE)}, mass: {ROCKER_MASS}, inertia: {ROCKER_INERTIA},
        spin: {ROCKER_SPIN!r}, about: {list(FIXED)},
        points: #{{ axle: vec({FIXED[0]}, {FIXED[1]}) - {list(ROCKER_CENTRE)}, pin: vec({ELBOW[0]!r}, {ELBOW[1]!r}) - {list(ROCKER_CENTRE)} }} }});
    let coupler = scene.beam(#{{ name: "coupler", axis: line({list(KNEE)}, {list(ELBOW)}), basis: mesh, section: strip,
        spin: {COUPLER_SPIN!r}, about: {list(KNEE)}, velocity: {list(KNEE_VELOCITY)} }});
    scene.hinge(crank.point("axle"));
    scene.hinge(rocker.point("axle"));
    scene.hinge(crank.point("pin"), coupler.start);
    scene.hinge(coupler.end, rocker.point("pin"));
    #{{ scene: scene, points: [coupler.start, coupler.at(coupler.length / 2), coupler.end] }}
}}
"""


class FourBar:
    """Two revolutions of the crank. The reference is the common limit of both programs."""

    TITLE, DURATION = "four-bar with a flexible coupler", 0.35
    SCRIPT = SCRIPT + pairs.PRINT_RUN
    LEVELS = pairs.LEVELS
    # Positions of start, middle and end of the coupler: withy with 32 spans, fourth_order and 3200 steps. EXUDYN with 16 elements and the trapezoidal rule,
    # extrapolated from 6400 and 12800 steps, differs by at most 2e-7.
    reference = [[0.10218258, 0.03496742], [0.1798312, 0.1510937], [0.2523350, 0.27049488]]

    def error(self, points):
        """Largest position error of start, middle and end of the coupler, divided by its length."""
        return pairs.largest_distance(points, self.reference) / COUPLER

    def withy_runs(self):
        for spans in (2, 3, 4, 6, 8, 12, 16):
            for method, first in (("fourth_order", 25), ("energy_momentum", 50)):
                yield [pairs.Run(f"bspline({spans})", method, round(first * 2 ** (at / 2))) for at in range(14)]

    def exudyn_runs(self):
        for elements in (1, 2, 3, 4, 6, 8, 16):
            for method in ("trapezoidal", "trapezoidal full", "alpha 0.9", "alpha 0.6"):
                yield [pairs.Run(f"{elements} elements", method, round(50 * 2 ** (at / 2))) for at in range(14)]

    def run_exudyn(self, run):
        elements = int(run.mesh.split()[0])
        system, nodes = self.model(elements)
        clock = Clock()
        clock.solve(system, 0.0, self.DURATION, run.method, run.steps, dense=elements <= 4)
        return clock.least(), positions(system, nodes)

    def model(self, elements):
        """Model with elements of three nodes. Returns the system, and the nodes of start, middle and end of the coupler."""
        self.container = exudyn.SystemContainer()
        system = self.container.AddSystem()
        count = 2 * elements + 1
        angle = math.atan2(ALONG_COUPLER[1], ALONG_COUPLER[0])
        places = [[KNEE[axis] + ALONG_COUPLER[axis] * node / (count - 1) for axis in (0, 1)] for node in range(count)]
        nodes = [system.AddNode(Rigid2D(referenceCoordinates=[*place, angle], initialVelocities=[
            *moved(KNEE, COUPLER_SPIN, place, KNEE_VELOCITY), COUPLER_SPIN])) for place in places]
        for element in range(elements):
            system.AddObject(ObjectBeamGeometricallyExact2D(
                nodeNumbers=nodes[2 * element:2 * element + 3], length=COUPLER / elements, massPerLength=SECTION["rho_A"],
                crossSectionInertia=SECTION["rho_I"], bendingStiffness=SECTION["EI"], axialStiffness=SECTION["EA"],
                shearStiffness=SECTION["GA"]))
        ground = system.AddObject(ObjectGround())

        def body(centre, mass, inertia, spin, about):
            node = system.AddNode(Rigid2D(referenceCoordinates=[*centre, 0.0],
                                          initialVelocities=[*moved(about, spin, centre), spin]))
            return system.AddObject(ObjectRigidBody2D(physicsMass=mass, physicsInertia=inertia, nodeNumber=node))

        def on(number, centre, place):
            return system.AddMarker(MarkerBodyRigid(bodyNumber=number, localPosition=[place[0] - centre[0], place[1] - centre[1], 0.0]))

        def hinge(one, other):
            system.AddObject(RevoluteJoint2D(markerNumbers=[one, other]))

        crank = body((0.0, 0.0), CRANK_MASS, CRANK_INERTIA, SPIN, (0.0, 0.0))
        rocker = body(ROCKER_CENTRE, ROCKER_MASS, ROCKER_INERTIA, ROCKER_SPIN, FIXED)
        hinge(on(ground, (0, 0), (0, 0)), on(crank, (0, 0), (0, 0)))
        hinge(on(ground, (0, 0), FIXED), on(rocker, ROCKER_CENTRE, FIXED))
        hinge(on(crank, (0, 0), KNEE), system.AddMarker(MarkerNodeRigid(nodeNumber=nodes[0])))
        hinge(on(rocker, ROCKER_CENTRE, ELBOW), system.AddMarker(MarkerNodeRigid(nodeNumber=nodes[-1])))
        system.Assemble()
        return system, (nodes[0], nodes[elements], nodes[-1])
