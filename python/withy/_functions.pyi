# Written by stubs.py from the catalog of the language.

from collections.abc import Callable, Mapping
from typing import Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _native
from .objects import (
    Buckling,
    ConvergenceStudy,
    Curve,
    Design,
    Distribution,
    Equilibrium,
    FinestRun,
    Fit,
    History,
    Integrator,
    Knots,
    LoadControl,
    Mesh,
    Modes,
    PrecisionStudy,
    Recording,
    Samples,
    Scene,
    Schedule,
    Section,
    Simulation,
    SlidingRule,
    StabilityMap,
    Station,
    StepControl,
    Sweep,
    SweepTable,
    TableOfCosts,
)

class Functions:
    _native: _native.Session
    def sin(self, x: float, /) -> float:
        """Returns the sine."""
    def cos(self, x: float, /) -> float:
        """Returns the cosine."""
    def tan(self, x: float, /) -> float:
        """Returns the tangent."""
    def asin(self, x: float, /) -> float:
        """Returns the arc sine."""
    def acos(self, x: float, /) -> float:
        """Returns the arc cosine."""
    def atan(self, x: float, /) -> float:
        """Returns the arc tangent."""
    def sinh(self, x: float, /) -> float:
        """Returns the hyperbolic sine."""
    def cosh(self, x: float, /) -> float:
        """Returns the hyperbolic cosine."""
    def tanh(self, x: float, /) -> float:
        """Returns the hyperbolic tangent."""
    def asinh(self, x: float, /) -> float:
        """Returns the inverse hyperbolic sine."""
    def acosh(self, x: float, /) -> float:
        """Returns the inverse hyperbolic cosine, which is not negative."""
    def atanh(self, x: float, /) -> float:
        """Returns the inverse hyperbolic tangent."""
    def exp(self, x: float, /) -> float:
        """Returns the exponential."""
    def ln(self, x: float, /) -> float:
        """Returns the natural logarithm."""
    def log10(self, x: float, /) -> float:
        """Returns the logarithm to base 10."""
    def log2(self, x: float, /) -> float:
        """Returns the logarithm to base 2."""
    def log(self, x: float, base: float, /) -> float:
        """Returns the logarithm to a given base; the base is required."""
    def sqrt(self, x: float, /) -> float:
        """Returns the square root."""
    def radians(self, x: float, /) -> float:
        """Converts an angle from degrees to radians."""
    def degrees(self, x: float, /) -> float:
        """Converts an angle from radians to degrees."""
    def floor(self, x: float, /) -> int:
        """Returns the largest whole number not above x."""
    def ceiling(self, x: float, /) -> int:
        """Returns the smallest whole number not below x."""
    def fraction(self, x: float, /) -> float:
        """Returns the fractional part of x, x - int(x)."""
    def is_nan(self, x: float, /) -> bool:
        """Returns true if x is nan."""
    def is_finite(self, x: float, /) -> bool:
        """Returns true if x is neither infinite nor nan."""
    def is_infinite(self, x: float, /) -> bool:
        """Returns true if x is infinite."""
    def hypot(self, x: float, y: float, /) -> float:
        """Returns the length of the vector with components x and y, without overflow."""
    def atan2(self, y: float, x: float, /) -> float:
        """Returns the angle of the vector with components x and y; y is the first argument."""
    def quotient(self, n: int, d: int, /) -> int:
        """Returns the quotient n/d rounded down to a whole number, for indices."""
    def round_to(self, x: float, digits: int, /) -> float:
        """Rounds x to this many digits after the decimal point."""
    def vec(self, x: float, y: float, /) -> NDArray[np.float64]:
        """Creates a vector with components x and y. An array [x, y] is accepted wherever a point is
        required; a vector can also be added and multiplied by a number."""
    def polar(self, length: float, angle: float, /) -> NDArray[np.float64]:
        """Creates a vector from its length and its angle from the x axis."""
    def dot(self, a: ArrayLike, b: ArrayLike, /) -> float:
        """Returns the scalar product of two vectors."""
    def cross(self, a: ArrayLike, b: ArrayLike, /) -> float:
        """Returns a1 b2 - a2 b1, positive if b is counter-clockwise of a."""
    def norm(self, a: ArrayLike, /) -> float:
        """Returns the length of a vector."""
    def angle(self, a: ArrayLike, /) -> float:
        """Returns the angle of a vector from the x axis, counter-clockwise."""
    def distance(self, a: ArrayLike, b: ArrayLike, /) -> float:
        """Returns the distance of two points."""
    @overload
    def knots(self, spans: int | Mapping[str, Any], /) -> Knots:
        """Creates a knot vector with equal spans on [0, 1], from a number of spans or from options.
        knots(7) has cubic splines with two continuous derivatives; options select another degree or
        continuity."""
    @overload
    def knots(self, degree: int, values: ArrayLike, /) -> Knots:
        """Creates a knot vector from an array in which knots are repeated by their multiplicity."""
    def line(self, from_: ArrayLike, to: ArrayLike, /) -> Curve:
        """Creates a straight line between two points."""
    def arc(self, center: ArrayLike, radius: float, from_angle: float, to_angle: float, /) -> Curve:
        """Creates a circular arc between two angles, at most a full turn."""
    def through(self, points: ArrayLike, /) -> Curve:
        """Creates a smooth cubic spline through points, by local interpolation. Through n + 1 points
        it has 2 n + 2 control points, double interior knots and a continuous tangent (The NURBS
        Book, section 9.3.4)."""
    def curve(self, knots: Knots, points: ArrayLike, /) -> Curve:
        """Creates a spline with these knots and control points."""
    def gauss(self, count: int, from_: float = ..., to: float = ..., /) -> dict[str, Any]:
        """Returns the Gauss-Legendre rule with this many points, on [-1, 1] or another interval. A
        rule with n points integrates polynomials up to degree 2 n - 1 exactly."""
    def linspace(self, from_: float, to: float, count: int, /) -> NDArray[np.float64]:
        """Creates an array of equally spaced numbers, including both ends."""
    def logspace(self, from_: float, to: float, count: int, /) -> NDArray[np.float64]:
        """Creates an array of positive numbers with equal ratios, including both ends. The ends are
        values, not exponents: logspace(1, 1000, 4) is [1, 10, 100, 1000]."""
    def mean(self, values: ArrayLike, /) -> float:
        """Returns the mean of the numbers."""
    def sci(self, x: float, digits: int = ..., /) -> str:
        """Formats a number with an exponent; default: two digits after the decimal point."""
    def fixed(self, x: float, digits: int = ..., /) -> str:
        """Formats a number with a fixed number of digits after the decimal point; default: three."""
    def tabulate(self, headings: ArrayLike, rows: ArrayLike, /) -> str:
        """Formats a table with aligned columns: texts to the left, numbers to the right."""
    def check(self, condition: bool, message: str = ..., /) -> None:
        """Records a check of a condition; the message states the requirement."""
    def check_close(self, actual: float, expected: float, tolerance: float, message: str = ..., /) -> None:
        """Records a check that two numbers differ by at most a tolerance, and shows both if they
        differ more."""
    def todo(self, what: str, /) -> None:
        """Stops the script with an error at a place that is still to be written. Exercises use it in
        place of the expression to be found."""
    def section(
        self,
        *,
        EA: float = ...,
        GA: float = ...,
        EI: float = ...,
        rho_A: float = ...,
        rho_I: float = ...,
        E: float = ...,
        nu: float = ...,
        density: float = ...,
        shape: str = ...,
        width: float = ...,
        height: float = ...,
        radius: float = ...,
        outer: float = ...,
        inner: float = ...,
        damping: Mapping[str, Any] = ...,
    ) -> Section:
        """Creates a cross section from stiffness and inertia, or from a material and a shape. Give
        either EA, GA, EI, rho_A and rho_I; or E, nu, density and a shape: "rectangle" with width
        and height (height lies in the plane of motion), "circle" with radius, "tube" with outer and
        inner radius. GA includes the shear correction factor; shapes use that of Cowper (1966).
        damping sets the relaxation times of a Kelvin–Voigt material: the bending moment is EI (κ +
        bending · κ̇), and likewise for axial and shear strain. The dissipated energy is recorded in
        the columns dissipated and dissipated.NAME of the beam. At frequency ω the damping ratio in
        bending is bending · ω/2."""
    def bspline(self, spans: int | Mapping[str, Any], /) -> Mesh:
        """Creates a mesh of B-splines; default: cubic and C2. bspline(14) has 14 equal spans.
        quadrature selects the points at which axial and shear strain are sampled. "patch" (default)
        has neither locking nor zero-energy modes for any degree and continuity. A whole number
        gives that many Gauss points per span, for studies; such a mesh states when printed if it
        has too many points (locking of stiff beams) or too few (zero-energy modes)."""
    def lagrange(self, elements: int | Mapping[str, Any], /) -> Mesh:
        """Creates a mesh of Lagrange elements of degree 1 (default), 2 or 3."""
    def taper(self, places: ArrayLike, /) -> Section:
        """Creates a section that varies along a beam, interpolated between sections at given places:
        [[0, thick], [1, thin]]. Places are fractions of the undeformed length and increase from 0
        to 1. If all sections have a material and the same kind of shape, dimensions and material
        are interpolated linearly: a wedge has linear height and cubic EI. Otherwise EA, GA, EI,
        rho_A and rho_I are interpolated linearly. All sections of a taper must have the same
        damping."""
    def constant(self, factor: float = ..., /) -> Schedule:
        """Creates a schedule with the same factor at all times; constant(1) is the default of loads."""
    def hold_for(self, time: float, /) -> Schedule:
        """Creates a schedule that is 1 up to a time, then 0; a step ends there."""
    def ramp(self, from_: float, to: float, /) -> Schedule:
        """Creates a schedule that is 0 before the first time, 1 after the second, and linear between."""
    def pulse(self, from_: float, to: float, /) -> Schedule:
        """Creates a schedule that is 1 between two times, else 0."""
    def smooth_pulse(self, duration: float, /) -> Schedule:
        """Creates a schedule 16/5 sin(PI t / duration)^6 up to the duration, then 0: unit mean, five
        continuous derivatives."""
    def sine(self, amplitude: float, rate: float, phase: float = ..., /) -> Schedule:
        """Creates a schedule amplitude sin(rate t + phase)."""
    def table(self, rows: ArrayLike, /) -> Schedule:
        """Creates a piecewise linear schedule through [time, factor] points, constant before the first
        and after the last."""
    def schedule(self, function: Callable[..., Any], breaks: ArrayLike = ..., /) -> Schedule:
        """Creates a schedule from a function of time, with optional times of its jumps and kinks. The
        function is called five times per step or substep (seven times with trapezoidal() and
        generalized_alpha()), never inside the Newton iteration. A note tells when it changes faster
        than these calls can see: declare jumps and kinks, use a smaller dt, or a built-in schedule.
        Built-in schedules, their sums and their products are integrated exactly over a step, so
        that their impulse does not depend on dt."""
    def energy_momentum(self) -> Integrator:
        """Selects the energy-momentum method (default), which keeps energy and both momenta to
        rounding at any step size. Second order. Stander & Stein, Eng. Comput. 13 (1996) 60-85."""
    def trapezoidal(self) -> Integrator:
        """Selects Newmark's method with β = 1/4, γ = 1/2; its energy varies in nonlinear problems.
        Second order. Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67-94."""
    def energy_decaying(self, *, chi: float = ...) -> Integrator:
        """Selects a method that keeps both momenta to rounding and damps vibration: the energy never
        grows, at any step size. Section forces are those of the mean strain of a step plus χ/2
        times its change; a step dissipates exactly the energy χ/2 ∫ ΔΓ·C ΔΓ + EI Δκ². First order;
        second order with chi: 0. After Armero & Romero, Comput. Methods Appl. Mech. Eng. 190 (2001)
        2603-2649."""
    def fourth_order(self) -> Integrator:
        """Selects a fourth-order composition of seven energy-momentum steps, which keeps energy and
        both momenta to rounding at any step size. Fourth order where loads and motion are smooth. A
        step costs as much as seven, one of them backwards in time; this is efficient for small
        errors. Forces of springs and loads are those of the last substep; all other forces, work
        and dissipation are those of the whole step. A motion that decays at a rate near 3.557/dt
        grows in the backward substep; this is reported. The substeps are chosen so that slow loads
        do not excite vibrations much faster than a step. A composition as in McLachlan, SIAM J.
        Sci. Comput. 16 (1995) 151-168."""
    def generalized_alpha(self, *, rho_infinity: float = ...) -> Integrator:
        """Selects a method for comparison that damps fast vibration and keeps neither energy nor
        momenta exactly. Second order. First order with sliders unless rho_infinity is 1, because
        their forces act in the middle of a step and not at the point where the method balances
        forces. Chung & Hulbert, J. Appl. Mech. 60 (1993) 371-375."""
    def adaptive(
        self,
        *,
        tolerance: float = ...,
        first: float = ...,
        smallest: float = ...,
        largest: float = ...,
    ) -> StepControl:
        """Selects adaptive steps with an error tolerance, for any integrator: dt: adaptive(#{
        tolerance: 1e-4 }). Two equal steps of the integrator are compared with a single step of the
        same total length, which is discarded: 3 solves for 2 steps. Accepted steps keep what the
        integrator keeps. The tolerance is the error accumulated while the scene moves by about its
        own length, as a fraction of the length of the longest beam and in rad, whichever is larger.
        A tolerance 100 times smaller needs 10 times as many steps with a method of order 2. Steps
        end where schedules jump or have kinks, at the end of run_to and at the times of sim.at;
        after a jump the steps are small again. Functions of time of loads are sampled densely in
        long steps, so that short pulses are resolved. sim.rejected counts rejected steps; the
        column dt has the step sizes."""
    def new_scene(self, name: str = ..., /) -> Scene:
        """Creates an empty scene; its name appears in messages and reports."""
    def load_control(self) -> LoadControl:
        """Selects load control: the load increases by equal parts in each step."""
    def arc_length(self, *, longest: float = ..., points: int = ...) -> LoadControl:
        """Selects arc-length control: each step prescribes the displacement of the scene; the load is
        computed and can decrease. The path of equilibria is followed through its limit points,
        until the full load is reached for the first time. The first step applies 1/load_steps of
        the load. Riks, Int. J. Solids Struct. 15 (1979) 529-551."""
    def derivative_by(self, x: Any, parameter: str, /) -> Any:
        """Returns the derivative of a number or a vector by a parameter of a scene; for an array those
        of its elements. Zero for values that do not depend on a parameter, and for all values of a
        simulation loaded from a file. Accurate to about eight digits where the motion is smooth and
        depends on the parameter; for other cases use the option `distance` of scene.parameter.
        Refused with an error: other values than numbers, vectors and arrays of them; an unknown
        parameter; a value at a kink or a jump of a function (abs(x) at 0, max(x, y) where both are
        equal, x % y) or where its slope is infinite (sqrt(x) and 1 / x at 0); and a simulation
        after a slider has arrived, a condition has released an object, or the script has gone back
        (sim.history.before(t) has the earlier rows). A note is printed if a function |t| … compares
        its argument with a parameter, such as if t < a: if the function jumps there, derivatives
        are wrong."""
    def value_of(self, x: Any, /) -> Any:
        """Returns a number, vector, array or map without its derivatives."""
    def every(self, steps: int, /) -> Recording:
        """Records every n-th step."""
    def nothing(self) -> Recording:
        """Records only the start and the ends of runs."""
    def load_simulation(self, file: str, /) -> Simulation:
        """Loads a simulation from a file written by sim.save, in the output folder or beside the
        script. Files that are truncated, damaged, of a later version of withy or of another kind
        are refused with an error that gives the reason."""
    def simulations_among(self, values: ArrayLike, /) -> Any:
        """Returns each simulation in an array of any values, including nested arrays, once. `withy
        view` uses it to find the simulations in the variables of a script."""
    def latest_simulation(self) -> Simulation:
        """Returns the simulation that was most recently started, loaded, forked, stepped or taken
        back."""
    def conserving(self) -> SlidingRule:
        """Selects the conserving sliding rule (default), which keeps energy, momenta and gap at any
        step size. With energy_momentum(): keeps energy, linear momentum, angular momentum and the
        gap to rounding. withy, docs/theory.md, section 10."""
    def kinked(self) -> SlidingRule:
        """Selects the conserving rule with the kink of the beam at the contact force: second to third
        order in the mesh up to about 64 spans, where conserving() is first order. Requires meshes
        of smooth splines. With energy_momentum(): keeps energy, linear momentum, angular momentum
        and the gap to rounding. Only first order near the ends of the beam, and where the slider
        reaches 0.8 of the shear wave speed of the beam, sqrt(GA/rho_A). Use conserving() for
        sliders with repeated impacts on soft beams: with kinked() a step may have no solution.
        withy, docs/theory.md, section 10.1."""
    def exact(self) -> SlidingRule:
        """Selects a rule for comparison: the slave is exactly on the beam at the end of a step; the
        error of the angular momentum is of second order. With energy_momentum(): keeps energy,
        linear momentum and the gap to rounding. Sibileau & Muñoz, equations 15 and 17."""
    def relaxed(self) -> SlidingRule:
        """Selects a rule for comparison: the slave is on the beam in the mean of a step; the gap
        drifts, and a step may have no solution. With energy_momentum(): keeps energy, linear
        momentum and angular momentum to rounding. Sibileau & Muñoz, equations 11 to 14."""
    def describe(self, value: Any, /) -> str:
        """Returns the description of a value that the prompt shows: its main properties in a few
        aligned lines. Numbers have up to ten digits; long arrays and maps are shortened."""
    def plot(
        self,
        x: ArrayLike,
        y: ArrayLike,
        file: str,
        /,
        *,
        title: str = ...,
        x_label: str = ...,
        y_label: str = ...,
        x_log: bool = ...,
        y_log: bool = ...,
        x_limits: ArrayLike = ...,
        y_limits: ArrayLike = ...,
        markers: str = ...,
        labels: ArrayLike = ...,
    ) -> None:
        """Plots numbers over numbers: one curve, or several in the same axes. x and y are arrays of
        numbers, or arrays of such arrays with one for each curve; one x can be used for all y. A
        number that is not finite leaves a gap; on a logarithmic axis numbers that are not positive
        are drawn at the lower end. To plot the height of a tip and the bending moment at a clamp
        over time, record both before the start, as in the example, and plot their columns with
        `plot_history`; `plot_along` plots the moment along the beam. At the prompt, `:plot` plots
        any recorded or unrecorded quantity in the terminal: `:plot sim.position(rod.end).y`."""
    def plot_motion(
        self,
        of: Simulation | ArrayLike,
        file: str,
        /,
        *,
        every: float = ...,
        from_: float = ...,
        to: float = ...,
        trace: ArrayLike = ...,
        magnify: float = ...,
        dots: bool = ...,
        symbols: bool = ...,
        x_limits: ArrayLike = ...,
        y_limits: ArrayLike = ...,
        title: str = ...,
    ) -> None:
        """Plots snapshots of the motion in one picture with equal axes, including supports, joints,
        sliders, springs and loads. Knots or nodes are dots, particles are larger dots, rigid bodies
        are the lines around their points. The last snapshot is at `to`, default: the present;
        symbols show the state at that time. A support is a triangle, on rollers if a direction is
        free; a clamp is a wall; a motor is a circle with arrows; a drive of scene.move is a square
        with arrows; a joint is a ring, or a square if it is rigid; a slider is a diamond; a spring
        is a zigzag; a damper is a piston; a load is an arrow while it acts. The command `:show` at
        the prompt takes the same options."""
    def plot_history(
        self,
        of: Simulation | History | ArrayLike,
        columns: ArrayLike,
        file: str,
        /,
        *,
        title: str = ...,
        axes: str = ...,
        panels: str = ...,
        logarithmic: bool = ...,
        average: bool = ...,
        error: bool = ...,
        x_label: str = ...,
        y_label: str = ...,
        x_log: bool = ...,
        y_log: bool = ...,
        x_limits: ArrayLike = ...,
        y_limits: ArrayLike = ...,
        markers: str = ...,
    ) -> None:
        """Plots columns of the history over time. Columns of different units are drawn in panels below
        each other, one for each unit. Each of several histories must have the named columns. With
        `error: true`, thin lines show the values plus and minus their estimated errors. Use `plot`
        for other numbers."""
    def plot_drift(self, of: Simulation | History | ArrayLike, file: str, /) -> None:
        """Plots the drift of energy and momenta on a logarithmic axis."""
    def write_history(self, of: Simulation | History | ArrayLike, file: str, /) -> None:
        """Writes all columns of the history as CSV with all digits."""
    def write_states(self, of: Simulation, file: str, /) -> None:
        """Writes the control points (or nodes) of all beams, and the particles, over time as CSV."""
    def plot_along(
        self,
        of: Simulation | Equilibrium,
        quantity: str | ArrayLike,
        file: str,
        /,
        *,
        title: str = ...,
        beams: ArrayLike = ...,
        symbols: bool = ...,
    ) -> None:
        """Plots a quantity along beams: as strips on the beams in the present configuration, and as a
        chart over their arc length. Several quantities are plotted below each other. Positive
        values are on the left of a beam, seen from its start; positive values of M and curvature
        are on the right, the tension side. The largest and the smallest value of each beam are
        written beside it. For past times go back with `sim.back`, or plot at a time with `sim.at`.
        At the prompt `:along M` plots the chart."""
    def plot_field(
        self,
        of: Simulation | Equilibrium,
        quantity: str,
        file: str,
        /,
        *,
        title: str = ...,
        beams: ArrayLike = ...,
        symbols: bool = ...,
        x_limits: ArrayLike = ...,
        y_limits: ArrayLike = ...,
    ) -> None:
        """Plots beams coloured by the magnitude of a quantity; larger magnitudes have darker and wider
        lines. A colour bar shows the values; the place and the value of the largest magnitude are
        marked."""
    def plot_equilibrium(
        self,
        equilibrium: Equilibrium,
        file: str,
        /,
        *,
        shapes: int = ...,
        trace: ArrayLike = ...,
        title: str = ...,
    ) -> None:
        """Plots configurations along the path of equilibria over each other. Symbols of supports,
        joints, springs and loads show the last configuration. Of a long path only configurations at
        equal intervals are plotted."""
    def plot_load_path(self, equilibrium: Equilibrium, station: Station, file: str, /) -> None:
        """Plots the load factor over the displacements of a station, including limit points."""
    def write_load_path(self, equilibrium: Equilibrium, stations: ArrayLike, file: str, /) -> None:
        """Writes load factor, strain energy and the positions of stations along the path as CSV with
        all digits."""
    def plot_modes(self, modes: Modes, file: str, /, *, amplitude: float = ..., columns: int = ...) -> None:
        """Plots mode shapes side by side, each over the equilibrium configuration."""
    def plot_buckling(
        self,
        buckling: Buckling,
        file: str,
        /,
        *,
        amplitude: float = ...,
        columns: int = ...,
    ) -> None:
        """Plots buckling shapes side by side, each over the undeformed scene."""
    def write_vtk(
        self,
        of: Simulation,
        file: str,
        /,
        *,
        from_: float = ...,
        to: float = ...,
        every: float = ...,
        frames: int = ...,
        fields: str = ...,
    ) -> None:
        """Writes frames of the motion for ParaView: RUN.pvd with the times, and a grid
        RUN/RUN_0001.vtu … for each frame. A beam is a line through its knots and three points
        between each two of them, with double points where a joint divides it; particles and centres
        of rigid bodies are points. The cell field `body` numbers beams first, then particles, then
        rigid bodies. Point fields are arc_length, velocity, angle [rad], N, Q and M, zero on
        particles and rigid bodies. Velocities and section forces need complete states: stored ones
        (option `snapshots`), or those of the run repeated in a copy, which takes the time of the
        run and is compared bit for bit. If the repeated run differs, because a function had changed
        the simulation or it started from an equilibrium, only the shape is written, with a note.
        Frames are recorded configurations, without interpolation. Frames of an earlier, longer
        export are not deleted, but the .pvd does not list them."""
    def write_npz(self, of: Simulation | SweepTable, file: str, /, *, error: bool = ...) -> None:
        """Writes all recorded data as arrays for NumPy. `t` holds the times of the configurations;
        `points.NAME` the control points (or nodes) of a beam, by time, point and coordinate, or the
        positions of a particle, by time and coordinate; `history.COLUMN` each column of the
        history, whose times are `history.t`. For the table of a sweep there is an array for each
        numeric parameter and result, with NaN in failed rows. With `error: true`, `error.NAME`
        holds the estimated errors of a station or column at `history.t`. All numbers are doubles
        with full accuracy."""
    def write_csv(
        self,
        of: Simulation | History | SweepTable | ArrayLike,
        file: str,
        /,
        *,
        units: bool = ...,
        error: bool = ...,
    ) -> None:
        """Writes a table as plain CSV for other programs: column names in the first line, no comments.
        For a simulation or a history all columns are written; for an array of maps a row for each
        map and a column for each key, in alphabetical order, empty where the key is missing. With
        `error: true`, the estimated errors of each column of a simulation or history follow it in a
        column NAME.error. All digits are kept. A text that begins with = + - or @ gets an
        apostrophe, so that spreadsheets do not evaluate it. write_history adds a comment on the
        simulation and units in the column names."""
    def write_parquet(self, of: Simulation | History | SweepTable | ArrayLike, file: str, /) -> None:
        """Writes a table as Apache Parquet, if withy was built with this feature. Parquet needs many
        crates and is an optional feature of the build: `cargo install --path . --features parquet`.
        Without it the call is refused with an error, which a script can catch. Columns are doubles,
        integers, booleans or texts; `dimension.NAME` of the metadata is the dimension of a column."""
    def write_viewer(
        self,
        of: Simulation | ArrayLike,
        file: str,
        /,
        *,
        title: str = ...,
        labels: ArrayLike = ...,
        from_: float = ...,
        to: float = ...,
        frames: int = ...,
        trails: ArrayLike = ...,
        columns: ArrayLike = ...,
        fields: ArrayLike = ...,
    ) -> None:
        """Writes an HTML page that plays the motion, with zoom, colours and values, and plots the
        energies below it. An array of simulations is shown side by side with one time and one view;
        of more than four, two are shown at first. Frames are recorded configurations, without
        interpolation; positions have 16 bits, which is visible only at magnifications of several
        hundred. Colours: speed, from the configurations before and after; M, N, Q and strain_energy
        (per length), from the stored states; stretch and curvature, the change from the undeformed
        axis. States that are not stored (option `snapshots`) are computed again in a copy of the
        run, as by write_vtk; `fields: ["speed", "stretch", "curvature"]` needs no states. `?` on
        the page lists its keys."""
    def viewer_page(
        self,
        of: Simulation | ArrayLike,
        /,
        *,
        title: str = ...,
        labels: ArrayLike = ...,
        from_: float = ...,
        to: float = ...,
        frames: int = ...,
        trails: ArrayLike = ...,
        columns: ArrayLike = ...,
        fields: ArrayLike = ...,
    ) -> str:
        """Returns the page that write_viewer writes, as a text. The Python module shows it in
        notebooks."""
    def write_animation(
        self,
        of: Simulation | ArrayLike,
        file: str,
        /,
        *,
        title: str = ...,
        from_: float = ...,
        to: float = ...,
        frames: int = ...,
        fps: int = ...,
        width: int = ...,
        trace: ArrayLike = ...,
        symbols: bool = ...,
        x_limits: ArrayLike = ...,
        y_limits: ArrayLike = ...,
    ) -> None:
        """Writes the motion as an animated PNG file that repeats without end. Frames are the recorded
        configurations nearest to evenly spaced times. An array of simulations is shown side by side
        with equal views. Knots are dots if there are at most 40 spans. All frames together have at
        most 256 colours. For a long motion, or for details, use write_viewer, whose files are
        smaller."""
    def study_stability(
        self,
        *,
        name: str,
        scene: Callable[..., Any],
        rows: Any,
        columns: Any,
        maps: Any = ...,
        integrator: Integrator = ...,
        dt: float = ...,
        end: float = ...,
        show: str = ...,
        time_limit: float = ...,
    ) -> StabilityMap:
        """Runs a scene for all combinations of parameters and shows which runs finish, and in which
        the energy grows. `scene` is a function of a map with the values of a cell by name. It
        returns a scene, or a map with settings of the simulation: #{ scene: scene, dt: 0.1, end: 5,
        integrator: trapezoidal() }. Missing settings are taken from the values of the cell, then
        from the options of the study. An exception of the function is the outcome of the cell. The
        energy growth of a cell is the largest rise of E - W above an earlier value after the last
        kink or jump of the schedules, relative to the largest energy. The maps are printed, plotted
        in NAME.svg and written to NAME.csv. Labels are numbers, texts, names of integrators, or the
        key `name` of a map."""
    def study_cost(
        self,
        *,
        name: str,
        scene: Callable[..., Any],
        dt: float,
        features: Any = ...,
        integrator: Integrator = ...,
        steps: int = ...,
        repeats: int = ...,
    ) -> TableOfCosts:
        """Measures the cost of a step of a scene, alone and with features added one by one. `scene` is
        a function that creates the scene; each feature is a function that adds something to it.
        Default features: all that apply to a scene with a beam, small enough to change the motion
        little. Further rows: no recording, snapshots, and the other integrators. The scene alone is
        measured twice, which shows the accuracy of the times. Runs are timed one at a time, without
        building the scene; minimum and median are reported. The table is printed, written to
        NAME.csv and plotted in NAME.svg."""
    def study_work_precision(
        self,
        *,
        name: str,
        scene: Callable[..., Any],
        meshes: ArrayLike,
        integrators: ArrayLike,
        dts: ArrayLike,
        times: ArrayLike,
        reference: str | FinestRun = ...,
        columns: Any = ...,
        length: float = ...,
        time_limit: float = ...,
        other_programs: str = ...,
        repeats: int = ...,
    ) -> PrecisionStudy:
        """Runs a scene with all meshes, integrators and step sizes, and measures the error and the run
        time of each combination. scene is a function of a mesh that returns the scene, or #{ scene:
        scene, stations: #{ tip: rod.end } }; default stations: the ends of all beams and all
        particles. The error is the largest distance of a station from the reference at the times,
        divided by the length. The reference is the name of a table with the columns t and, for a
        station called tip, xtip, ytip and thtip, or finest_run(). All cases first run in parallel;
        then finished runs are timed one by one. Failed runs stay in the table with the reason. The
        table is printed, written to NAME.csv and plotted in NAME.svg."""
    def finest_run(self, *, mesh: Any = ..., dt: float = ..., integrator: Integrator = ...) -> FinestRun:
        """Creates a reference of a study by a fine run, which the results mark as such. Defaults: the
        finest mesh of the study, its integrator of the highest order and a quarter of its smallest
        step size. The reference must be finer than the runs it is compared with. It is also run
        with twice its step, and the difference is added to all errors: they are bounds, marked with
        ≤ where this changes their digits. Errors below twice the difference have no order. No such
        run is needed if all runs of the study have the integrator and step size of the reference,
        because the time errors are then equal. The mesh error of the reference is unknown; to
        measure mesh errors give a finer mesh here."""
    def study_convergence(
        self,
        *,
        name: str,
        scene: Callable[..., Any],
        meshes: ArrayLike,
        integrators: ArrayLike,
        dts: ArrayLike,
        times: ArrayLike,
        reference: str | FinestRun = ...,
        columns: Any = ...,
        length: float = ...,
        time_limit: float = ...,
    ) -> ConvergenceStudy:
        """Runs a scene with several step sizes on one mesh, or on several meshes with one step size,
        and computes errors and orders. scene, stations, reference and columns are those of
        study_work_precision. The quantities are the columns of the reference table; with a fine run
        (default) the positions and angles of the stations and all physical columns of the history.
        Several meshes need a reference on a different mesh: finest_run(#{ mesh: … }) or a table.
        Orders are computed only from errors above the error of the reference. The size of a mesh is
        1 over the number of spans of all beams. Errors of all positions together and orders of the
        other quantities are printed; NAME.csv has everything, NAME.svg shows the errors of the
        positions."""
    def uniform(self, from_: float, to: float, /) -> Distribution:
        """Creates a uniform distribution between two numbers, for a parameter of a sweep."""
    def log_uniform(self, from_: float, to: float, /) -> Distribution:
        """Creates a distribution with a uniform logarithm between two numbers, for a parameter of a
        sweep."""
    def normal(self, mean: float, deviation: float, /) -> Distribution:
        """Creates a normal distribution with a mean and a standard deviation, for a parameter of a
        sweep."""
    def log_normal(self, median: float, deviation: float, /) -> Distribution:
        """Creates a distribution with a normal logarithm, for a parameter of a sweep, from the median
        and the standard deviation of the logarithm."""
    def triangular(self, from_: float, likeliest: float, to: float, /) -> Distribution:
        """Creates a triangular distribution between two numbers with its maximum at the likeliest
        number, for a parameter of a sweep."""
    def latin_hypercube(self, count: int, seed: int = ..., /) -> Samples:
        """Creates a Latin hypercube plan for a sweep: each parameter range is divided into as many
        equally likely parts as there are points, with one point in each part. M. D. McKay, R. J.
        Beckman, W. J. Conover, Technometrics 21 (1979) 239-245."""
    def sobol(self, count: int, seed: int = ..., /) -> Samples:
        """Creates a plan of evenly distributed points for a sweep from a Sobol' sequence; a power of
        two of points is best. Direction numbers of S. Joe and F. Y. Kuo (SIAM J. Sci. Comput. 30
        (2008) 2635-2654), for up to 40 parameters; each coordinate is shifted by random bits of the
        seed (a digital shift)."""
    def saltelli(self, blocks: int, seed: int = ..., /) -> Samples:
        """Creates a plan for a sweep from which sensitivity() computes first-order and total Sobol'
        indices. A. Saltelli et al., Computer Physics Communications 181 (2010) 259-270; the points
        of a Sobol' sequence, in blocks of two more than the number of parameters."""
    def study_sweep(
        self,
        *,
        name: str,
        parameters: Any,
        run: Callable[..., Any],
        samples: Samples = ...,
        time_limit: float = ...,
    ) -> Sweep:
        """Calls a function with all combinations of parameters, or at sampled points, on all cores,
        and returns a table of the results. `parameters` are arrays, of which all combinations are
        used (a grid; the alphabetically last name varies fastest), or with `samples` distributions
        and arrays, whose values are equally likely. `run` is a function of a map of the values that
        returns a map of numbers and booleans (stored as 1 and 0), with the same names in all runs.
        An exception, a result that is not finite or a failed check makes a failed row with this
        reason; other rows are not affected. Runs are made in other threads, with the functions and
        imports of the script, but without its statements. The function may use numbers, texts,
        arrays, maps, vectors, functions, sections, meshes, curves, integrators and schedules from
        outside; each run starts with their original values. It prints nothing and writes no files.
        The table does not depend on the number of cores. At the prompt all runs are made on one
        core. A summary is printed, and the table is written to NAME.csv."""
    def fit(
        self,
        *,
        name: str = ...,
        parameters: Any,
        residuals: Callable[..., Any] = ...,
        model: Callable[..., Any] = ...,
        measured: ArrayLike = ...,
        over: ArrayLike = ...,
        data: Any = ...,
        weights: ArrayLike = ...,
        confidence: float = ...,
        step: float = ...,
        derivatives: str = ...,
        time_limit: float = ...,
    ) -> Fit:
        """Finds the parameters for which the results of a function are closest to data (least
        squares), with their uncertainties. Give `residuals`, a function of a map of parameters that
        returns an array of differences, or `model`, which returns an array to be compared with
        `measured`, at the places `over`. `data` is passed as second argument. The weighted sum of
        squares is minimised by the Levenberg-Marquardt method within the bounds. Derivatives are
        computed along with the runs where possible (see scene.parameter); the first ones are
        compared with a difference of two runs. If they differ, or the function has no derivatives,
        central differences of runs are used, and `found.derivatives` gives the reason. Their step
        is `step` times the size of a parameter (its value, or a hundredth of its range if it is
        near zero), default: 1e-4, which gives about eight digits for runs that repeat to 1e-12; use
        1e-3 with adaptive steps. They are computed at the start and at the end and updated in
        between by Broyden's method. Errors are standard errors, s² (JᵀJ)⁻¹ with s from the
        residuals, and intervals are those of Student's distribution; a parameter at a bound counts
        as known. A table is printed."""
    def minimise(
        self,
        *,
        parameters: Any,
        run: Callable[..., Any],
        least: str = ...,
        largest: str = ...,
        constraints: Any = ...,
        tolerance: float = ...,
        most_runs: int = ...,
        derivatives: str = ...,
        time_limit: float = ...,
    ) -> Design:
        """Finds the parameters that minimise or maximise a result, within bounds and with constraints
        on other results. `run` is a function of a map of parameters that returns a map of numbers.
        `least` or `largest` names the result to minimise or maximise; `constraints` gives the
        limits of other results. If the runs have derivatives (as in fit), Kraft's SLSQP is used:
        quadratic models with linearised constraints. If they have none, or the first ones differ
        from a difference of two runs, or the search is stuck, Powell's COBYLA is used: linear
        models over a simplex of designs; `best.derivatives` gives the reason. Both methods find a
        local optimum, not the global one. Designs with failed runs are avoided. The result is the
        best of all tried designs that satisfy the constraints."""
    def find_root(
        self,
        function: Callable[..., Any],
        from_: float,
        to: float,
        tolerance: float = ...,
        /,
    ) -> float:
        """Finds a zero of a function of one number, between two numbers at which its signs differ. R.
        P. Brent's method (1973). The tolerance is that of the argument, default: 1e-9 of the
        interval. The function is called on this thread and may use everything."""
    def read_csv(self, file: str, /) -> dict[str, Any]:
        """Reads a table of numbers and returns a map of its columns by name, each an array. The first
        line has the column names, separated by commas, or by semicolons or tabs; numbers of the
        latter may have decimal commas. Lines that begin with # and a second line of dimensions, as
        write_csv writes it, are ignored. Every cell must be a finite number."""
    def read_options(self, owner: str, options: Any, known: Any, /) -> dict[str, Any]:
        """Checks the options of a function and adds defaults; unknown or missing options and wrong
        kinds are refused with an error. Kinds are written as for read_argument. Points are returned
        as vectors. If the default is (), () may also be given."""
    def read_argument(self, owner: str, name: str, value: Any, kind: str, /) -> Any:
        """Checks an argument of a function and returns it, a point as a vector; a wrong kind is
        refused with an error. Kinds are written in words: "a number", "a positive number", "a
        number of zero or more", "any number" (including infinity and nan), "a whole number", "a
        positive whole number", "a whole number of zero or more", "a text", "true or false", "a
        point", "a vector", "an array", "an array of numbers", "an array of points", "a function",
        "a value" (anything), "nothing", or the name of a type, such as "a section". Several kinds
        are joined by "or": "a number or a schedule". A unit may follow: "a positive number
        [length]"."""
