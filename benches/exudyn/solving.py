"""Solution of a model with EXUDYN: settings, and measurement of the solver calls."""

import sys
import time

VERSION = "1.13.6"

try:
    import exudyn
except ImportError as missing:
    sys.exit(f"{missing}: pip install exudyn=={VERSION} numpy")

if exudyn.__version__ != VERSION:
    print(f"This is EXUDYN {exudyn.__version__}; the settings are those of {VERSION}.", file=sys.stderr)

# Failed steps raise exceptions, so the messages of the solver are not needed.
exudyn.config.printToConsole = False

KINDS = {
    "trapezoidal": exudyn.DynamicSolverType.TrapezoidalIndex2,
    "explicit": exudyn.DynamicSolverType.VelocityVerlet,
    "RK44": exudyn.DynamicSolverType.RK44,
}


class Clock:
    """Wall-clock and processor time of all solver calls of a run [s]."""

    def __init__(self):
        self.clock = self.processor = 0.0

    def least(self):
        return min(self.clock, self.processor)

    def solve(self, system, start, end, method, steps, *, dense=False):
        """Solves from `start` to `end`, continuing the last solution.

        The method is one of KINDS, or "alpha RHO" for generalized-alpha. Modified Newton is used unless "full" is appended.
        """
        kind, *rest = method.split()
        settings = exudyn.SimulationSettings()
        integration = settings.timeIntegration
        integration.startTime, integration.endTime, integration.numberOfSteps = start, end, steps
        integration.verboseMode = 0
        integration.newton.useModifiedNewton = "full" not in rest
        integration.newton.relativeTolerance, integration.newton.absoluteTolerance = 1e-6, 1e-8
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = 1e9
        settings.show.statistics = settings.show.computationTime = False
        types = exudyn.LinearSolverType
        settings.linearSolver.solverType = types.EigenDense if dense else types.EigenSparse
        if kind == "alpha":
            integration.generalizedAlpha.spectralRadius = float(rest[0])
        solver = KINDS.get(kind, exudyn.DynamicSolverType.GeneralizedAlpha)
        begun, worked = time.perf_counter(), time.process_time()
        solved = system.SolveDynamic(settings, solverType=solver, storeSolver=True, updateInitialValues=True,
                                     showHints=False, showCausingItems=False)
        self.clock += time.perf_counter() - begun
        self.processor += time.process_time() - worked
        if not solved:
            raise RuntimeError("the solver gave up")


def positions(system, nodes):
    """Positions of nodes, as points with two coordinates."""
    return [list(system.GetNodeOutput(node, exudyn.OutputVariableType.Position)[:2]) for node in nodes]
