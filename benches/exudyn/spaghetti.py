"""Flying spaghetti (Simo & Vu-Quoc 1986, Part II): a free beam that is accelerated by a force and a moment at one end."""

import csv
import math

from exudyn.utilities import (CreateSymbolicUserFunction, Force, MarkerNodeRigid, ObjectBeamGeometricallyExact2D,
                              Rigid2D, Torque)
import exudyn

import pairs
from solving import Clock, positions

LENGTH, EA, GA, RHO_A, RHO_I = 10.0, 1e4, 1e4, 1.0, 10.0
START, END = (0.0, 8.0), (6.0, 0.0)
FORCE, MOMENT, T_LOAD = 8.0, -80.0, 2.5

SCRIPT = """
fn make(mesh) {{
    let slender = section(#{{ EA: {EA}, GA: {GA}, EI: {EI}, rho_A: {RHO_A}, rho_I: {RHO_I} }});
    let scene = new_scene("flying spaghetti");
    let rod = scene.beam(#{{ axis: line({START}, {END}), basis: mesh, section: slender }});
    scene.force(rod.end, [{FORCE}, 0], {pulse}({T_LOAD}));
    scene.moment(rod.end, {MOMENT}, {pulse}({T_LOAD}));
    #{{ scene: scene, points: [rod.start, rod.end] }}
}}
"""

# Number of the longest stable explicit steps until the load ends, for one element of three nodes.
STABLE = 108.7


def steps_of(first, count):
    """Increasing numbers of steps, with the ratio √2."""
    return [round(first * 2 ** (at / 2)) for at in range(count)]


class Spaghetti:
    """Problem with a given bending stiffness and given pulses of the loads."""

    LEVELS = pairs.LEVELS

    def __init__(self, title, stiffness, reference, pulse, duration):
        self.TITLE, self.stiffness, self.pulse, self.DURATION = title, stiffness, pulse, duration
        self.parts = duration / T_LOAD
        with open(pairs.ROOT / "scripts" / "studies" / "reference" / reference, newline="") as file:
            rows = csv.DictReader(line for line in file if not line.startswith("#"))
            row = next(row for row in rows if abs(float(row["t"]) - duration) < 1e-9)
        self.reference = [[float(row["x0"]), float(row["y0"])], [float(row["xL"]), float(row["yL"])]]
        names = globals() | {"START": list(START), "END": list(END)}
        self.SCRIPT = SCRIPT.format(**names, EI=stiffness, pulse=pulse) + pairs.PRINT_RUN

    def error(self, points):
        """Larger position error of the two ends, divided by the length."""
        return pairs.largest_distance(points, self.reference) / LENGTH

    def withy_runs(self):
        meshes = [f"bspline({spans})" for spans in (6, 8, 10, 12, 14, 16, 20, 24, 32, 44, 64, 96)]
        meshes += [f"bspline(#{{ spans: {spans}, degree: 5 }})" for spans in (8, 12, 16, 24, 32, 44, 64)]
        for mesh in meshes:
            for method, first in (("fourth_order", 4), ("energy_momentum", 16)):
                yield [pairs.Run(mesh, method, round(self.parts * steps)) for steps in steps_of(first, 15)]

    def exudyn_runs(self):
        for elements in (4, 6, 8, 12, 16, 24, 32, 48, 64):
            for method in ("trapezoidal", "alpha 0.9"):
                yield [pairs.Run(f"{elements} elements", method, round(self.parts * steps)) for steps in steps_of(25, 14)]
            for method, factor in (("explicit", 1.0), ("RK44", 0.8)):
                first = math.ceil(factor * STABLE * elements)
                yield [pairs.Run(f"{elements} elements", method, round(self.parts * steps)) for steps in steps_of(first, 7)]

    def run_exudyn(self, run):
        """Solves before and after the end of the load. The accelerations are computed again in between."""
        system, ends, release = self.model(int(run.mesh.split()[0]))
        clock = Clock()
        until_release = round(run.steps / self.parts)
        clock.solve(system, 0.0, T_LOAD, run.method, until_release)
        release()
        clock.solve(system, T_LOAD, self.DURATION, run.method, run.steps - until_release)
        return clock.least(), positions(system, ends)

    def model(self, elements):
        """Model with elements of three nodes. Returns the system, the nodes of its ends, and a function that removes the loads."""
        self.container = exudyn.SystemContainer()
        system = self.container.AddSystem()
        count = 2 * elements + 1
        angle = math.atan2(END[1] - START[1], END[0] - START[0])
        places = [[a + (b - a) * node / (count - 1) for a, b in zip(START, END)] for node in range(count)]
        nodes = [system.AddNode(Rigid2D(referenceCoordinates=[*place, angle])) for place in places]
        for element in range(elements):
            system.AddObject(ObjectBeamGeometricallyExact2D(
                nodeNumbers=nodes[2 * element:2 * element + 3], length=LENGTH / elements, massPerLength=RHO_A,
                crossSectionInertia=RHO_I, bendingStiffness=self.stiffness, axialStiffness=EA, shearStiffness=GA))
        end = system.AddMarker(MarkerNodeRigid(nodeNumber=nodes[-1]))
        full = [(Force, [FORCE, 0.0, 0.0]), (Torque, [0.0, 0.0, MOMENT])]
        loads = [system.AddLoad(kind(markerNumber=end, loadVector=vector)) for kind, vector in full]
        system.Assemble()
        if self.pulse == "smooth_pulse":
            # The compiled expressions must be kept alive, because the system does not own them.
            self.functions = [self.let_pulse(system, load, vector) for load, (_, vector) in zip(loads, full)]

        def release():
            for load in loads:
                system.SetLoadParameter(load, "loadVectorUserFunction", 0)
                system.SetLoadParameter(load, "loadVector", [0, 0, 0])

        return system, (nodes[0], nodes[-1]), release

    @staticmethod
    def let_pulse(system, load, vector):
        """Makes a load proportional to (16/5) sin⁶(π t/2.5)."""
        def pulse(system, t, load_vector):
            sine = exudyn.symbolic.sin(math.pi / T_LOAD * t)
            factor = 3.2 * sine * sine * sine * sine * sine * sine
            return exudyn.symbolic.Vector([vector[0] * factor, vector[1] * factor, vector[2] * factor])
        function = CreateSymbolicUserFunction(system, pulse, "loadVectorUserFunction", load)
        system.SetLoadParameter(load, "loadVectorUserFunction", function)
        return function


def FlyingSpaghetti():
    return Spaghetti("flying spaghetti, EI = 100", 100, "P1.csv", "hold_for", 7.5)


def StifferSpaghetti():
    return Spaghetti("flying spaghetti, EI = 500", 500, "P2.csv", "hold_for", 7.5)


def SmoothThrow():
    return Spaghetti("the same thrown by a smooth pulse, EI = 100", 100, "P1s.csv", "smooth_pulse", 5)
