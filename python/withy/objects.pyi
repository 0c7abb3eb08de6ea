# Written by stubs.py from the catalog of the language.

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _objects
from ._objects import Object

class Knots(Object):
    """The knots of a spline: ends and smoothness of its polynomial pieces."""
    @property
    def degree(self) -> int:
        """Polynomial degree."""
    @property
    def values(self) -> NDArray[np.float64]:
        """Array of all knots, repeated by their multiplicity."""
    @property
    def functions(self) -> int:
        """Number of basis functions, equal to the number of control points of a curve."""
    @property
    def spans(self) -> int:
        """Number of spans between distinct knots."""
    @property
    def continuity(self) -> int:
        """Number of continuous derivatives at the least smooth interior knot; the degree if there is
        none."""
    @property
    def domain(self) -> Any:
        """First and last knot."""
    @property
    def breaks(self) -> NDArray[np.float64]:
        """Distinct knots: the ends of the spans."""
    @property
    def greville(self) -> NDArray[np.float64]:
        """Greville abscissae, one parameter for each function. A straight line with control points at
        these places has uniform speed; they are suitable interpolation points."""
    def basis(self, xi: float, order: int = ..., /) -> NDArray[np.float64]:
        """Returns the values of all basis functions at ξ, or their derivatives of the given order. At
        most degree + 1 of them are not zero, starting at number span(xi).first. At interior knots
        derivatives are those from the right."""
    def span(self, xi: float, /) -> dict[str, Any]:
        """Returns the span that contains ξ: its ends, and the number of the first function that is not
        zero there. A knot belongs to the span on its right, the last knot to the last span."""
    def multiplicity(self, xi: float, /) -> int:
        """Returns the multiplicity of ξ among the knots."""
    def insert(self, xi: float, times: int = ..., /) -> Knots:
        """Returns the knot vector with ξ inserted once or several times."""

class Curve(Object):
    """A curve of the plane."""
    @property
    def length(self) -> float:
        """Length of the curve."""
    @property
    def start(self) -> NDArray[np.float64]:
        """Start point of the curve."""
    @property
    def end(self) -> NDArray[np.float64]:
        """End point of the curve."""
    @property
    def domain(self) -> Any:
        """Interval of the parameter ξ."""
    @property
    def knots(self) -> Knots:
        """Knots of a spline; refused with an error for lines and arcs."""
    @property
    def control_points(self) -> NDArray[np.float64]:
        """Control points of a spline; refused with an error for lines and arcs."""
    def at(self, xi: float, /) -> NDArray[np.float64]:
        """Returns the point at ξ."""
    def derivative(self, xi: float, order: int = ..., /) -> NDArray[np.float64]:
        """Returns the derivative by ξ of first or given order; at knots from the right."""
    def angle(self, xi: float, /) -> float:
        """Returns the angle of the tangent from the x axis."""
    def curvature(self, xi: float, /) -> float:
        """Returns the curvature, positive if the curve turns counter-clockwise."""
    def length_to(self, xi: float, /) -> float:
        """Returns the length from the start to ξ."""
    def parameter(self, s: float, /) -> float:
        """Returns the parameter ξ at this length from the start."""
    def insert(self, xi: float, times: int = ..., /) -> Curve:
        """Returns the same spline with a knot inserted once or several times: the curve is unchanged,
        the control points are computed."""

class Error(Object):
    """Value that `catch (problem)` receives after an error of a function of withy."""
    @property
    def message(self) -> str:
        """Description of the error."""
    @property
    def hint(self) -> str:
        """Advice on how to correct the error."""

class Section(Object):
    """A cross section, or a taper: stiffness and inertia."""
    @property
    def EA(self) -> float:
        """Axial stiffness [force]."""
    @property
    def GA(self) -> float:
        """Shear stiffness, including the shear correction factor [force]."""
    @property
    def EI(self) -> float:
        """Bending stiffness [force·length²]."""
    @property
    def rho_A(self) -> float:
        """Mass per length [mass/length]."""
    @property
    def rho_I(self) -> float:
        """Rotary inertia per length [mass·length]."""
    def at(self, part: float, /) -> Section:
        """Returns the section of a taper at a fraction of the length."""

class Mesh(Object):
    """A basis for a beam with the quadrature points of its strains."""
    @property
    def spans(self) -> int:
        """Number of spans or elements."""
    @property
    def degree(self) -> int:
        """Polynomial degree of the basis functions."""
    @property
    def functions(self) -> int:
        """Number of basis functions, equal to the number of control points or nodes."""

class Schedule(Object):
    """A function of time that multiplies a load."""
    def at(self, t: float, /) -> float:
        """Returns the factor at a time; at a jump the value just after it."""

class Integrator(Object):
    """A time integration method."""

class StepControl(Object):
    """Selection of the step sizes of a simulation."""

class Scene(Object):
    """A description of beams, particles, joints, masses and loads."""
    def beam(
        self,
        *,
        axis: Curve,
        basis: Mesh | Knots = ...,
        section: Section,
        name: str = ...,
        velocity: ArrayLike = ...,
        spin: float = ...,
        about: ArrayLike = ...,
    ) -> Beam:
        """Adds a beam that is free of stress in its undeformed shape. axis is a curve. basis is a mesh
        or a knot vector; default: 16 cubic C2 spans, 32 if a slider slides on the beam, up to 64 if
        a curved axis, a varying section or close forces require it. velocity and spin define the
        initial rigid body motion; spin is about the point `about`, default: the centre of mass.
        Default names: beam1, beam2, …"""
    def particle(
        self,
        position: ArrayLike,
        mass: float,
        /,
        *,
        name: str = ...,
        velocity: ArrayLike = ...,
    ) -> Station:
        """Adds a point mass with its own position and returns its only station. The station accepts
        forces, hinges, velocities and sliders. A particle has no rotation, so moments, clamps and
        rigid joints are refused with an error. Default names: particle1, particle2, …"""
    @property
    def name(self) -> str:
        """Name of the scene."""
    def clamp(self, station: Station | str, /) -> Joint:
        """Fixes the position and the angle of a station. At an interior station the mesh becomes C0,
        so that the shear force can jump there."""
    def hinge(self, station: Station | str, other: Station | str = ..., /) -> Joint:
        """Fixes the position of a station, or joins two stations so that they can rotate relative to
        each other."""
    def rigid(self, station: Station | str, other: Station | str, /) -> Joint:
        """Joins two stations rigidly: their relative position and angle stay as in the undeformed
        scene."""
    def mass(self, station: Station | str, mass: float, rotary_inertia: float = ..., /) -> None:
        """Attaches a point mass to a station."""
    def velocity(self, station: Station | str, velocity: ArrayLike, spin: float = ..., /) -> None:
        """Sets the initial velocity of the node at a station, and of no other node. Use scene.beam(#{
        …, velocity: [1, 0], spin: 2 }) for the initial velocity of a whole beam. Where a moving
        body is joined to a beam at rest, the node of the beam needs the velocity of the joined
        point of the body: set it with this function."""
    def gravity(self, acceleration: ArrayLike, /) -> None:
        """Sets the acceleration of gravity; default: none. A scene has one acceleration of gravity. A
        second call replaces the first one and prints a note."""
    def force(
        self,
        station: Station | str,
        force: ArrayLike,
        schedule: Schedule | float | Callable[..., Any] = ...,
        /,
        *,
        frame: str = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> None:
        """Adds a force at a station that keeps its direction or follows the section. With #{ frame:
        "follower" } the components are along and across the undeformed beam, or along the axes of a
        rigid body, and rotate with the section. A function |t, q| … is a sampled controller: it is
        called at the start of every step with the simulation q, and its value holds for the step.
        The mean delay of the feedback is half a step; adaptive steps also call it in their middle
        to estimate this error. Its work is counted like that of any load. With #{ sample: 0.01 }
        the controller is called at 0, 0.01, 0.02, …, and its value is held in between. Steps end at
        these times, so that the samples depend on the step size only by the error of the method.
        With #{ sample: 0.01, delay: 0.003 } the value acts 0.003 later; before the first value
        nothing acts. sim.back and sim.rewind restore the values of a controller, but not variables
        that the function itself changes: it is called again when an adaptive step is rejected,
        after going back, and when earlier states are read, and other simulations and copies of the
        scene share the variables. Let the function depend on t and q only, and model memory by a
        moving body (an integral of the error is the angle of a free body under a moment); otherwise
        use fixed steps and never go back. With a name the history has work.NAME and NAME.force."""
    def moment(
        self,
        station: Station | str,
        moment: float,
        schedule: Schedule | float | Callable[..., Any] = ...,
        /,
        *,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> None:
        """Adds a moment at a station, positive counter-clockwise."""
    def line_load(
        self,
        beam: Beam | str,
        force: ArrayLike,
        schedule: Schedule | float | Callable[..., Any] = ...,
        /,
        *,
        frame: str = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> None:
        """Adds a force per length on a whole beam that keeps its direction or follows the sections
        like a pressure."""
    def body(
        self,
        *,
        at: ArrayLike,
        mass: float = ...,
        inertia: float = ...,
        angle: float = ...,
        points: Any = ...,
        outline: ArrayLike = ...,
        name: str = ...,
        velocity: ArrayLike = ...,
        spin: float = ...,
        about: ArrayLike = ...,
    ) -> Body:
        """Adds a rigid body. points are relative to the centre of mass, in the frame of the body,
        which is rotated by angle. One of mass and inertia may be zero if other parts of the scene
        provide the inertia of that motion. spin is about the centre or the point `about`. Pictures
        show the points, or the polygon `outline`; this requires one point away from the centre.
        Default names: body1, body2, …"""
    def support(
        self,
        station: Station | str,
        /,
        *,
        x: bool = ...,
        y: bool = ...,
        angle: bool = ...,
        along: ArrayLike = ...,
    ) -> Joint:
        """Fixes some displacements of a station to the ground: x, y, angle, or the displacement normal
        to a direction. A roller on a floor is #{ y: true }. along: [1, 0] is the same, given by the
        free direction, and along: [1, 1] is an inclined roller; its reaction is normal to this
        direction. With angle: true it is a guide, which does not rotate. Use scene.clamp to fix
        everything and scene.hinge to fix the position."""
    def move(
        self,
        station: Station | str,
        /,
        *,
        x: Schedule | float | Callable[..., Any] = ...,
        y: Schedule | float | Callable[..., Any] = ...,
        angle: Schedule | float | Callable[..., Any] = ...,
        x_speed: Schedule | float | Callable[..., Any] = ...,
        y_speed: Schedule | float | Callable[..., Any] = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> None:
        """Prescribes the motion of a station: x, y and angle, or some of them, as functions of time. x
        and y are displacements from the undeformed position, angle is the rotation from the
        undeformed angle. Each must be 0 at t = 0 and must not jump; a jump is refused with an error
        when the run reaches it. schedules::smooth_step of std/schedules moves to a place in a given
        time. Steps end at kinks; a function declares them by schedule(|t| …, [times]). x_speed and
        y_speed prescribe rates instead, starting from the undeformed position: a function of time,
        or a controller |t, q| …, called at the start of every step. The initial velocity of the
        node is that of the function; for a beam at rest this is an impact. scene.equilibrium
        evaluates drives at the option `time`, in proportion to the load factor."""
    def motor(
        self,
        station: Station | str,
        /,
        *,
        angle: Schedule | float | Callable[..., Any] = ...,
        speed: Schedule | float | Callable[..., Any] = ...,
        torque: Schedule | float | Callable[..., Any] = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> None:
        """Rotates a section relative to the ground: by a prescribed angle, at a prescribed speed, or
        with a torque. angle is the rotation since the start, a function of time; it is exact at the
        end of every step. speed is a rate: a built-in schedule is integrated exactly, a function of
        time at three Gauss points of each step, and a note tells when it changes faster than that.
        torque is a moment, positive counter-clockwise. speed and torque may also be sampled
        controllers |t, q| …; see scene.force for the times of the calls and for sample and delay.
        The section can still move in x and y: add a hinge to fix it."""
    def spring(
        self,
        from_: Station | ArrayLike | str,
        to: Station | ArrayLike | str,
        /,
        *,
        stiffness: float = ...,
        length: Schedule | float | Callable[..., Any] = ...,
        length_rate: Schedule | float | Callable[..., Any] = ...,
        acts: str = ...,
        table: ArrayLike = ...,
        law: Callable[..., Any] = ...,
        range: ArrayLike = ...,
        damping: float | Callable[..., Any] | ArrayLike = ...,
        rates: ArrayLike = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> Spring:
        """Adds a spring, optionally with a parallel damper, between two stations or between a station
        and a point of the ground. The tension is stiffness · (distance - length), plus damping ·
        the rate of the distance. Very stiff springs need no more iterations than soft ones. At
        distance zero the direction is undefined and the force is zero; springs with length: 0 need
        no direction. The damper acts also where the spring is slack. A law is sampled when the
        spring is created, so that the polygon through the samples is exact to 1e-7 of the largest
        force. The stored energy is the exact integral of this polygon, which files contain. print
        shows the remaining error. A law that needs more than 20 000 samples, such as one with a
        jump, is refused with an error. If the rest length depends on time, the damper acts on the
        rate of the distance minus the rest length. The work of the actuator is the force times the
        decrease of the rest length. The function must not jump. An equilibrium uses the rest length
        at its option `time`; length_rate acts in motion only."""
    def damper(
        self,
        from_: Station | ArrayLike | str,
        to: Station | ArrayLike | str,
        /,
        *,
        damping: float | Callable[..., Any] | ArrayLike,
        rates: ArrayLike = ...,
        name: str = ...,
    ) -> Spring:
        """Adds a damper between two stations, or between a station and a point of the ground, with a
        force that depends on the rate of their distance. damping may be a constant or a law: points
        [rate, force], or a function of the rate, which is sampled over `rates` when the damper is
        created. The rate is positive while the distance grows; the force is positive in tension.
        The force must be 0 at rate 0 and have the sign of the rate, so that a damper only
        dissipates; other laws are refused with an error. A step uses the force at its mean rate.
        Springs, tendons and torsion springs accept the same laws."""
    def tendon(
        self,
        places: ArrayLike,
        /,
        *,
        stiffness: float = ...,
        length: Schedule | float | Callable[..., Any] = ...,
        length_rate: Schedule | float | Callable[..., Any] = ...,
        acts: str = ...,
        table: ArrayLike = ...,
        law: Callable[..., Any] = ...,
        range: ArrayLike = ...,
        damping: float | Callable[..., Any] | ArrayLike = ...,
        rates: ArrayLike = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> Spring:
        """Adds a rope over three or more places with uniform tension; it slides over the inner places
        without friction. The tension depends on the total length. With acts: "pull" the rope is
        slack where it is shorter than `length`. With length: |t| … or length_rate it is wound up or
        paid out, as by a winch."""
    def torsion_spring(
        self,
        from_: Station | str,
        to: Station | Mapping[str, Any] | str,
        /,
        *,
        stiffness: float = ...,
        angle: Schedule | float | Callable[..., Any] = ...,
        angle_rate: Schedule | float | Callable[..., Any] = ...,
        table: ArrayLike = ...,
        law: Callable[..., Any] = ...,
        range: ArrayLike = ...,
        damping: float | Callable[..., Any] | ArrayLike = ...,
        rates: ArrayLike = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> Spring:
        """Adds a torsion spring, optionally with a parallel damper, between two sections or between a
        section and the ground. The moment is stiffness · (angle of the second section - angle of
        the first section - angle), plus damping · the rate of that difference. Angles are counted
        over any number of turns. With angle: |t| … or angle_rate the spring is a servo with a
        finite stiffness."""
    def brake(
        self,
        from_: Station | str,
        to: Station | Mapping[str, Any] | str,
        /,
        *,
        moment: Schedule | float | Callable[..., Any],
        deflection: float = ...,
        name: str = ...,
        sample: float = ...,
        delay: float = ...,
    ) -> Spring:
        """Adds a brake or clutch: Coulomb friction between two sections, or between a section and the
        ground. The brake holds with any moment up to `moment`, and slips with this moment beyond
        it. While it holds, it deflects elastically by at most `deflection` and does not creep. The
        dissipated energy is the moment times the slip. An equilibrium with a brake is not unique
        and is refused; fourth_order() does not support brakes."""
    def drag(
        self,
        on: Beam | Station | str,
        /,
        *,
        normal: float = ...,
        tangent: float = ...,
        linear: float = ...,
        quadratic: float | Mapping[str, Any] = ...,
        wind: ArrayLike = ...,
        name: str = ...,
    ) -> None:
        """Adds a force against the velocity: per length of a beam, normal and tangential to its axis,
        or on a particle or a station, independent of direction. The force on a beam is -normal v_n
        - tangent v_t per length; quadratic: #{ normal: …, tangent: … } adds -k |v| v for each
        component. The force on a particle or a station is -linear v - quadratic |v| v. With a wind,
        v is the velocity relative to it: the energy dissipated in the medium is D, and force times
        wind is work W. Default names: drag1, drag2, … The dissipated energy is in the column
        dissipated.NAME. Equilibria ignore drag; modes use its linear part."""
    def wall(
        self,
        point: ArrayLike,
        normal: ArrayLike,
        /,
        *,
        stiffness: float,
        restitution: float = ...,
        friction: float = ...,
        radius: float = ...,
        bodies: ArrayLike = ...,
        name: str = ...,
    ) -> None:
        """Adds a wall: a straight boundary that bodies can touch from the side to which its normal
        points, such as a floor. The normal can have any length. The wall is infinite; several walls
        form a channel or a box. A beam touches it all along, at four Gauss–Lobatto points per span,
        its ends included. On a beam, stiffness is the force per length and penetration, on a point
        the force per penetration. With friction, contact sticks or slips (Coulomb); the friction
        force acts at the surface, at the distance radius from the axis, so a round body rolls. The
        contact deflects elastically along the surface before it slips and springs back, so an
        oblique impact without slip rebounds along the surface too, unlike with rigid Coulomb
        friction. Choose the stiffness so that the largest expected force gives a small penetration.
        With a restitution below 1 the contact is damped so that a resolved impact of a single mass
        rebounds with this fraction of its speed. sim.notes states impacts that the steps do not
        resolve, and bodies that start inside an obstacle. Default names: wall1, wall2, …"""
    def disc(
        self,
        centre: ArrayLike,
        radius_: float,
        /,
        *,
        stiffness: float,
        restitution: float = ...,
        friction: float = ...,
        radius: float = ...,
        bodies: ArrayLike = ...,
        name: str = ...,
    ) -> None:
        """Adds a disc that bodies can touch from outside, such as a pin or a peg. The contact force
        points from the centre to the body. Its potential is infinite at the centre, so a body that
        touches the disc cannot pass its centre. A step in which a point would pass through the disc
        is halved. A disc that is smaller than the distance of the contact points of a beam can pass
        between them: use more spans. Options and columns are those of wall. Default names: disc1,
        disc2, …"""
    def contact(
        self,
        bodies: ArrayLike,
        /,
        *,
        stiffness: float,
        radius: float | ArrayLike,
        restitution: float = ...,
        friction: float = ...,
        name: str = ...,
    ) -> None:
        """Lets bodies touch each other: beams, particles, and stations of rigid bodies. A single beam
        touches itself. Each body has a radius: half the thickness of a beam, or the radius of a
        disc around a particle or a station. A beam has the shape of its axis with this radius. Its
        contact points (four per span) touch the nearest points of the other axes. The contact is
        compliant: its potential is infinite where two axes meet, so beams that touch do not pass
        through each other, and a step in which a point would jump through an axis is halved. A body
        that fits between two contact points is not seen by them: use spans that are shorter than
        the bodies. With friction, contact sticks or slips (Coulomb), and round bodies roll on each
        other. A particle does not rotate, so friction between two particles is refused. Between two
        beams, stiffness is the force per length and penetration, otherwise the force per
        penetration. Bodies that share a joint or a slider do not touch each other. NAME.force_x and
        NAME.force_y are the force on the first body of the list; it is zero if a beam touches
        itself. NAME.friction is positive to the right of the normal that points to the first body.
        NAME.gap of bodies that do not touch is accurate to 0.1 %. Default names: contact1,
        contact2, …"""
    def equilibrium(
        self,
        *,
        load_steps: int = ...,
        control: LoadControl = ...,
        load_factor: float = ...,
        time: float = ...,
    ) -> Equilibrium:
        """Finds the static equilibrium of the scene under its loads and gravity. At least one load
        must act. Sliders are in equilibrium without friction along the beam, or in contact with an
        end stop. Parts held only by their loads, such as a pendulum, a chain or a bead in a sag,
        move to the equilibrium as in a viscous medium. A load step without a solution is halved, up
        to eight times. For snap-through, or a path with decreasing load, use control: arc_length()."""
    def modes(self, count: int = ..., /) -> Modes:
        """Computes the lowest natural frequencies and mode shapes of the undeformed scene. Each mode
        has a residual; if one is not below 1e-6, the call is refused with an error. With up to 240
        unknowns all modes are computed at once, with more only the lowest, by the block Lanczos
        method (Grimes, Lewis & Simon 1994); a count of the negative pivots verifies that none is
        missing. Sliders can move along their beams, under their present contact forces. Modes are
        computed at rest, without controllers and spins; a note names those of the scene. Loads and
        gravity are ignored, because the scene is not deformed by them: for their effect, as on an
        inverted pendulum, use scene.equilibrium().modes(n). For other configurations use
        rest.modes(n) of an equilibrium or sim.modes(n) of a simulation."""
    def damped_modes(self, count: int = ..., /) -> Any:
        """Computes the lowest damped vibrations of the undeformed scene: maps of decay_rate,
        angular_frequency and damping_ratio. The eigenvalues λ = -δ ± iω of λ² M + λ D + K, exact
        for any damping, in ascending order of |λ|. An overdamped mode has ω = 0 and a damping ratio
        of 1, and each of its two λ is one result. Only for up to 240 unknowns and without sliders.
        Dampers with a law and drag contribute their linear damping at rest."""
    def buckling(self, count: int = ..., /, *, load_factor: float = ..., time: float = ...) -> Buckling:
        """Computes the smallest critical load factors and buckling shapes (linear stability,
        eigenvalue buckling). At a critical factor λ the stiffness K + λ K_g of the undeformed scene
        is singular; K_g is the geometric stiffness of the section forces that the loads and gravity
        cause to first order. Loads and gravity are multiplied by λ; prestress is not. Only positive
        λ are found; load_factor: -1 reverses the loads. Critical loads with a strain above 0.5 are
        omitted. Displacements before buckling are neglected, and a note reports those above 3 % of
        the size of the scene. The factors of shallow arches, whose displacements are of the order
        of their rise, are too high without a note: use scene.equilibrium(#{ control: arc_length()
        }). Parts that move freely without loads, follower loads, contacts, sleeves and prescribed
        motions are refused with an error. The stiffness of a spring is its stiffness in the
        configuration without loads. A spring with acts: "pull" that is exactly taut counts as
        acting in both directions, so that the factor of a guyed mast is too high: give the guys a
        prestress, a length below their distance. An actuator has its length at the option `time`."""
    def start(
        self,
        *,
        dt: float | StepControl = ...,
        integrator: Integrator = ...,
        name: str = ...,
        record: Recording = ...,
        snapshots: float = ...,
        notes: str = ...,
    ) -> Simulation:
        """Creates a simulation of the scene at its initial state, t = 0. Later changes of the scene do
        not affect the simulation; call start again for a new one. Without `dt`, the steps adapt to
        a tolerance of 1e-3 of the size of the scene for each step; the error of a whole run is
        estimated by sim.error_estimate()."""
    def parameter(self, name: str, value: float, /, *, distance: float = ...) -> ValueWithDerivatives:
        """Declares a named number of the scene by which derivatives are computed. Sections, loads,
        springs, masses, motors and velocities of the scene accept it as a number. Declare all
        parameters of a scene before one is used. A simulation started afterwards computes in each
        step the derivatives by each parameter with the factorised equations of the step: two or
        three solves for each of two neighbouring values, no factorisation. Its own steps are
        bitwise unchanged. Values read from the simulation and its history, and values computed from
        them, have derivatives; comparisons, checks, fixed and sci ignore them. Only fixed steps of
        energy_momentum() or fourth_order() are allowed. Positions of particles, of points of the
        ground and of sliders, and whole beams may depend on a parameter; lengths of beams, places
        on them and times of jumps of loads may not, and functions |t, q| … are not allowed.
        Derivatives end where a slider arrives, a condition releases an object, or the script goes
        back; derivative_by then gives this reason."""
    def solve(
        self,
        *,
        to: float,
        error: float = ...,
        integrator: Integrator = ...,
        name: str = ...,
        max_time: float = ...,
    ) -> Refinement:
        """Runs a scene with smaller and smaller steps and finer meshes until the estimated error meets
        a tolerance. The first run has 50 steps and the meshes as given. After each run the error is
        estimated as by sim.error_estimate(), and steps and spans are refined by powers of two where
        their part of the error is too large. The result has the last run, `simulation`, and all
        runs as `rows`: the error against run time of the scene. The tolerance applies to the
        largest error of positions in the run, relative to the length of the longest beam. The
        search ends after 12 runs or after max_time; `reached` then is false."""
    def record(self, column: str, function: Callable[..., Any] = ..., /) -> None:
        """Adds a column to the histories of simulations that are started later. A function is called
        at the start and at the end of every recorded step; it must read the simulation and not
        advance it. If a step of scene.step had to be halved, it is called only after the last part.
        A simulation with a function cannot be saved, and studies ignore functions; built-in sensors
        have no such restriction."""
    def beam_named(self, name: str, /) -> Beam:
        """Returns the beam with a name."""
    def particle_named(self, name: str, /) -> Station:
        """Returns the particle with a name."""
    def station_named(self, name: str, /) -> Station:
        """Returns the station with a name as in sensors: a place on a beam, such as "rod.end" or
        "rod[0.5]", a particle, a rigid body, or a point of it."""
    def body_named(self, name: str, /) -> Body:
        """Returns the rigid body with a name."""
    def slider_named(self, name: str, /) -> Slider:
        """Returns the slider with a name."""
    def track_named(self, name: str, /) -> Track:
        """Returns the track with a name."""
    def slider(
        self,
        station: Station | str,
        beam: Beam | Track | str,
        /,
        *,
        at: float = ...,
        rule: SlidingRule = ...,
        ends: str = ...,
        restitution: float = ...,
        side: str = ...,
        friction: float = ...,
        static_friction: float = ...,
        velocities: str = ...,
        name: str = ...,
    ) -> Slider:
        """Adds a slider: a station of another beam or a particle moves along a beam or a track. The
        station must lie on the undeformed beam, at `at`, to six digits; it is then moved onto it
        exactly. On a curved beam, whose mesh differs slightly from the curve, it is moved onto the
        axis of the mesh, and velocities: "project" makes the initial velocities compatible. A
        station fixed to the ground is an eyelet through which the beam slides. Simultaneous impacts
        are one impact. With ends: "bounce" the restitution law holds at any step: beams do not
        stretch during the impact, and springs and dampers take no part; the lost energy is in the
        column dissipated.NAME. With ends: "contact" the waves in the beam determine the rebound.
        The contact time is that of a wave through the beam and back, 2 L √(rho_A/EA), or less for a
        slider lighter than the beam. In steps shorter than an eighth of it, the slider stays in
        contact with the end stop until the contact force would be tensile. In much longer steps the
        beam is treated as rigid in the impact, and sim.notes reports this. A slider that bounces
        repeatedly within few steps stays in contact with the end stop until it is pulled away. With
        `friction`, the slider sticks to the beam or slips with a force along the beam of `friction`
        times the force across it (Coulomb). A slider that sticks starts to slip at
        `static_friction` times that force. Steps end where slip starts or ends. A slider that
        sticks does not creep. The work of friction is in the column dissipated.NAME, and the
        friction force on the beam, positive towards its end, in NAME.friction. Friction needs rule:
        conserving() and the integrator energy_momentum(); equilibria, modes and impacts are without
        friction. With `side`, the slider only pushes: it leaves the beam on that side where the
        present contact force becomes tensile, flies, and lands where its distance from the axis
        vanishes. A landing has the `restitution`; the lost energy is in the column dissipated.NAME,
        and the distance in NAME.gap. The station may start at a distance from the beam on that
        side. Beyond the ends of the beam there is no landing. A side needs a single beam, rule:
        conserving() and the integrator energy_momentum(), and is not available with friction or
        with ends: "bounce" and "contact". Default names: slider1, slider2, …"""
    def sleeve(
        self,
        holder: Station | ArrayLike | str,
        beam: Beam | str,
        /,
        *,
        at: float = ...,
        ends: str = ...,
        name: str = ...,
    ) -> Slider:
        """Adds a sleeve without length, in which a beam slides without friction and keeps its angle to
        the holder. The holder is a station of a rigid body or of another beam, or a point of the
        ground. A point of the ground becomes a fixed body NAME_holder, whose joint has the same
        name; to turn a sleeve, hold it with a hinged body and scene.move(body.centre, #{ angle: …
        }). The sleeve exerts a force (contact_force) and a couple (sleeve_couple). In equilibrium a
        moment M at the mouth pushes the beam along the sleeve with M²/2EI. In an equilibrium the
        compliance of kink and jump of curvature at the sleeve, which the mesh does not represent,
        is included in positions and forces, but not in rest.strain. In motion it is not: the beam
        is as stiff at the sleeve as its mesh, results converge with the spans, and rest.start first
        solves for the equilibrium without it. Energy, both momenta and the gap are kept to rounding
        with energy_momentum(); initial velocities are made compatible. The beam must be uniform,
        and a track cannot slide in a sleeve. Default names: sleeve1, sleeve2, … docs/theory.md,
        section 14.2."""
    def track(self, beams: ArrayLike, /, *, closed: bool = ..., name: str = ...) -> Track:
        """Creates a track of beams joined end to end, on which sliders pass from one beam to the next.
        The direction along each beam follows from the ends that meet. The beams must already be
        joined there, by scene.rigid, scene.hinge or other joints, or be fixed to the ground. A
        slider passes a corner like a rounded corner of vanishing radius: its energy is kept, and
        its momentum changes by an impulse normal to the track. Where a joint of the track is
        released and the beams have separated, the track ends. A slider that starts at a corner is
        on the beam after it. A closed track of two beams has the direction of the first beam.
        Default names: track1, track2, …"""
    def release(
        self,
        what: Joint | Slider | Spring | str,
        /,
        *,
        at: float = ...,
        when: Callable[..., Any] = ...,
    ) -> None:
        """Releases a joint, slider, spring or drive at a time or by a condition. The object is the
        return value of scene.hinge, scene.clamp, scene.rigid, scene.support, scene.slider or
        scene.spring, or a name: "hinge1", "motor1". With `at` a step ends at this time, and the
        next step is without the object. `when` is a function of the simulation, |q| …, that returns
        true for the release. It is called before every step, not within steps: the release is at
        the end of the first step at which it returns true, so that shorter steps find the time more
        accurately. The state at that time still contains the object; a run that goes back to it and
        continues releases it again."""
    def is_like(self, other: Scene, /) -> bool:
        """Returns true if another scene has the same beams, joints, masses, velocities and loads, in
        the same order. Names and relative differences up to 1e-9 are ignored. Functions of scripts
        cannot be compared: a scene with a load that is a function is not like any other scene."""
    def explain(self) -> str:
        """Returns a table of the features that a simulation of the scene uses, and of the work that it
        can therefore omit. Features that a scene does not use have no cost. The scene is built for
        this table in the same way as by scene.start(…)."""

class Beam(Object):
    """A flexible beam of a scene."""
    @property
    def start(self) -> Station:
        """Start station of the beam."""
    @property
    def end(self) -> Station:
        """End station of the beam."""
    @property
    def middle(self) -> Station:
        """Station at half the undeformed length of the beam."""
    def at(self, s: float, /) -> Station:
        """Returns the station of the beam at an undeformed arc length from its start."""
    @property
    def length(self) -> float:
        """Undeformed length of the beam."""
    @property
    def name(self) -> str:
        """Name of the beam."""

class Station(Object):
    """A place on a beam, a particle, or a point of a rigid body."""

class Joint(Object):
    """A hinge, a rigid joint, a clamp or a support of a scene."""

class Body(Object):
    """A rigid body of a scene."""
    def point(self, point: str, /) -> Station:
        """Returns the station at a point of the body, by name."""
    @property
    def centre(self) -> Station:
        """Station at the centre of mass of the body."""
    @property
    def name(self) -> str:
        """Name of the body."""

class Spring(Object):
    """A spring, a damper or a tendon of a scene."""
    @property
    def name(self) -> str:
        """Name of the spring."""

class Equilibrium(Object):
    """A scene in static equilibrium, with its load path."""
    def position(self, station: Station | str, /) -> NDArray[np.float64]:
        """Returns the equilibrium position of a station."""
    def positions(self, station: Station | str, /) -> NDArray[np.float64]:
        """Returns the positions of a station at all points of the path, beginning with the unloaded
        scene."""
    def angle(self, station: Station | str, /) -> float:
        """Returns the angle of the section at a station, counter-clockwise and not wrapped. An
        interior station of a beam must have been created before the equilibrium was found;
        otherwise the angle is refused with an error."""
    def reaction(self, station: Station | str, /) -> dict[str, Any]:
        """Returns the reaction of the support at a station. The map has force, a vector, and moment.
        Only reactions of the ground are returned, not the forces of joints between beams."""
    def slider_position(self, slider: Slider | str, /) -> float:
        """Returns the equilibrium position of a slider on its beam or track, by undeformed length: 0
        at the start, 1 at the end."""
    def slider_arc_length(self, slider: Slider | str, /) -> float:
        """Returns the undeformed arc length from the start of the beam or track to the slider."""
    def contact_force(self, slider: Slider | str, /) -> NDArray[np.float64]:
        """Returns the contact force of a slider on its beam in equilibrium; the force on its station
        is the opposite."""
    def leans_on(self, slider: Slider | str, /) -> str:
        """Returns the end of the beam or track whose stop a slider is in contact with, "start" or
        "end", or a "seam" of its track. A stop only pushes. Sliders with ends: "stop" and ends:
        "bounce" can be in contact with it; one with ends: "release" leaves the beam there and has
        no equilibrium. In modes about the equilibrium a slider in contact with a stop is fixed."""
    def error_estimate(self) -> Error_estimate:
        """Estimates the errors of positions and strain energy due to the mesh. The equilibrium is
        found again with three quarters and half of the spans. Verdicts are those of
        sim.error_estimate()."""
    def modes(self, count: int = ..., /) -> Modes:
        """Computes the lowest natural frequencies and mode shapes about the equilibrium. An unstable
        equilibrium has growing modes; see growth_rates. Refused with an error if a follower load
        acts."""
    def damped_modes(self, count: int = ..., /) -> Any:
        """Computes the lowest damped vibrations about the equilibrium: maps of decay_rate,
        angular_frequency and damping_ratio. See scene.damped_modes for accuracy and restrictions."""
    def start(
        self,
        *,
        dt: float | StepControl = ...,
        integrator: Integrator = ...,
        name: str = ...,
        record: Recording = ...,
        snapshots: float = ...,
        notes: str = ...,
    ) -> Simulation:
        """Starts a simulation from the equilibrium, at rest at t = 0. Loads follow their schedules
        from t = 0: a load with hold_for(1) ends at t = 1. The options are those of scene.start. The
        full loads act, whatever load_factor and time the equilibrium had. If a drive has moved the
        scene, simulation and loads start at the time of the equilibrium instead: at t = 1 after
        scene.equilibrium(#{ time: 1 }). With drives that are at rest by then, the scene stays at
        rest."""
    @property
    def is_stable(self) -> bool:
        """True if the equilibrium is stable: every small disturbance increases the potential energy."""
    @property
    def load_factor(self) -> float:
        """Fraction of the loads that acts: the requested one, unless the path ended earlier."""
    @property
    def load_factors(self) -> NDArray[np.float64]:
        """Load factors at all points of the path, beginning with 0."""
    @property
    def limit_points(self) -> NDArray[np.float64]:
        """Load factors at the limit points of the path, where the structure would snap through."""
    @property
    def strain(self) -> float:
        """Strain energy of the equilibrium."""
    @property
    def iterations(self) -> int:
        """Number of Newton iterations of all load steps."""
    def section_forces(self, beam: Beam | str, s: float = ..., /) -> dict[str, Any]:
        """Returns axial force, shear force and moment of a beam in equilibrium at an undeformed arc
        length, or along the whole beam. See section_forces of a simulation for signs and accuracy."""
    @property
    def scene(self) -> Scene:
        """Scene of the equilibrium."""
    def sleeve_couple(self, slider: Slider | str, /) -> float:
        """Returns the couple of a sleeve on its beam in equilibrium, counter-clockwise; zero for other
        sliders. The bending moment of the beam jumps by the couple at the sleeve. The moment on the
        holder also contains that of contact_force about the holder: the kink of the axis moves its
        point of action."""

class LoadControl(Object):
    """Quantity that is prescribed in the steps of an equilibrium path."""

class Modes(Object):
    """Natural frequencies and shapes of small vibrations."""
    @property
    def angular_frequencies(self) -> NDArray[np.float64]:
        """Angular frequency ω of each mode; 0 for modes that do not vibrate."""
    @property
    def frequencies(self) -> NDArray[np.float64]:
        """Frequency ω/2π of each mode, in cycles per unit of time."""
    @property
    def periods(self) -> NDArray[np.float64]:
        """Period 2π/ω of each mode; infinite for modes that do not vibrate."""
    @property
    def growth_rates(self) -> NDArray[np.float64]:
        """Growth rate of each mode of an unstable configuration; 0 for modes that vibrate."""
    @property
    def damping_ratios(self) -> NDArray[np.float64]:
        """Damping ratio of each mode due to dampers, damped materials and drag, as a fraction of
        critical damping; 0 without damping. φᵀ D φ/(2ω) with φᵀ M φ = 1: exact where damping does
        not couple modes, as for a material with equal relaxation times, else to first order in the
        damping. The frequencies are those without damping. For exact values use
        scene.damped_modes(n)."""
    @property
    def residuals(self) -> NDArray[np.float64]:
        """Residual of each mode: an upper bound of the relative error of ω² + σ. σ is about the square
        of the lowest bending frequency. The residual is the relative change, in energy, of the
        shape and its section forces in the next correction; the error of ω² is about its square.
        The discretisation error is not included: compare with twice the number of spans."""
    def error_estimate(self) -> Error_estimate:
        """Estimates the errors of the angular frequencies and growth rates due to the mesh. The modes
        are computed again with three quarters and half of the spans, about the equilibrium again if
        they are those of an equilibrium. Modes about the present configuration of a simulation are
        refused."""
    @property
    def is_stable(self) -> bool:
        """True if no mode grows."""
    @property
    def count(self) -> int:
        """Number of modes."""
    def displacement(self, mode: int, station: Station, /) -> NDArray[np.float64]:
        """Returns the displacement of a station in a mode (the first is mode 0), relative to the
        control point with the largest displacement."""

class Buckling(Object):
    """Critical load factors and buckling shapes of a scene."""
    @property
    def factors(self) -> NDArray[np.float64]:
        """Critical load factors: multiples of the loads at which the scene buckles."""
    @property
    def residuals(self) -> NDArray[np.float64]:
        """Residual of each critical load: its square is about the relative error of the factor. The
        discretisation error is not included: see error_estimate."""
    @property
    def count(self) -> int:
        """Number of critical loads."""
    @property
    def displacement_before(self) -> float:
        """Largest displacement before buckling at the lowest factor, linear in the loads, relative to
        the size of the scene. The analysis neglects these displacements. If they are not small,
        compare with scene.equilibrium() near the critical load."""
    def displacement(self, shape: int, station: Station, /) -> NDArray[np.float64]:
        """Returns the displacement of a station in a buckling shape (the first is shape 0), relative
        to the control point with the largest displacement."""
    def error_estimate(self) -> Error_estimate:
        """Estimates the errors of the critical factors due to the mesh. The analysis is repeated with
        three quarters and half of the spans."""

class Simulation(_objects.Simulation):
    """A simulation of a scene."""
    def spring_force(self, spring: Spring, /) -> float:
        """Returns the force of a spring and its damper, positive in tension, as the mean of the last
        step; for a torsion spring the moment. trapezoidal() and generalized_alpha() evaluate forces
        at the ends of steps; with them it is the force at the end of the last step."""
    def spring_length(self, spring: Spring, /) -> float:
        """Returns the current length of a spring or tendon; for a torsion spring the angle."""
    def modes(self, count: int = ..., /) -> Modes:
        """Computes the lowest natural frequencies and mode shapes about the present configuration of a
        simulation, with velocities set to zero. The present section forces of beams (zero in an
        undeformed beam) and the present forces on points of rigid bodies are included; an inverted
        pendulum therefore has a growing mode at the start."""
    def step(self, count: int = ..., /) -> None:
        """Takes one step, or the given number of steps; a step is shorter where a schedule requires
        the end of a step."""
    def run_to(self, t: float, /) -> None:
        """Takes steps until a time; the last step ends exactly there."""
    def at(self, t: float, function: Callable[..., Any], /) -> None:
        """Registers a function that is called with the simulation when a time is reached; a step ends
        there."""
    @property
    def t(self) -> float:
        """Current time of the simulation."""
    @property
    def energy(self) -> float:
        """Sum of kinetic, strain and potential energy [energy]."""
    @property
    def kinetic(self) -> float:
        """Kinetic energy [energy]."""
    @property
    def strain(self) -> float:
        """Strain energy [energy]."""
    @property
    def potential(self) -> float:
        """Potential energy of gravity, zero at the origin [energy]."""
    @property
    def work(self) -> float:
        """Work of the loads so far [energy]."""
    @property
    def angular_momentum(self) -> float:
        """Angular momentum about the origin [mass·length²/time]."""
    @property
    def gap(self) -> float:
        """Largest distance between the partners of a joint [length]."""
    @property
    def momentum(self) -> NDArray[np.float64]:
        """Linear momentum."""
    @property
    def history(self) -> History:
        """History of all recorded steps so far."""
    def invariants(self) -> Invariants:
        """Largest errors of energy, momenta and gap so far; printed as a table. The conserved values
        are E - W + D, p - ∫F dt and L - ∫M dt, in which the contributions of loads, gravity and
        supports are subtracted."""
    def position(self, station: Station | str, /) -> NDArray[np.float64]:
        """Returns the position of a station."""
    def velocity(self, station: Station | str, /) -> NDArray[np.float64]:
        """Returns the velocity of a station."""
    def angle(self, station: Station | str, /) -> float:
        """Returns the angle of the section at a station, initially that of the undeformed axis,
        counter-clockwise and not wrapped. An interior station of a beam must have been created
        before the scene was started; otherwise the angle is refused with an error."""
    @property
    def steps(self) -> int:
        """Number of steps taken."""
    @property
    def newton_iterations(self) -> int:
        """Number of Newton iterations of all steps, each with a factorisation."""
    @property
    def corrections(self) -> int:
        """Number of corrections of all steps with existing factors: back substitutions besides those
        of the Newton iterations."""
    @property
    def retries(self) -> int:
        """Number of steps that failed and were halved."""
    @property
    def rejected(self) -> int:
        """Number of adaptive steps whose error exceeded the tolerance and that were repeated."""
    @property
    def unknowns(self) -> int:
        """Number of unknowns of a step."""
    @property
    def dt(self) -> float:
        """Step size of the grid; with adaptive steps the size of the next step, unless it must end
        earlier."""
    @property
    def name(self) -> str:
        """Name of the simulation; default: the name of the scene."""
    @property
    def notes(self) -> list[str]:
        """Notes on the steps so far that do not resolve the motion; empty if there are none. The notes
        refer to the steps that led to the present state: going back removes the notes on the
        removed steps, and forks and saved simulations keep the notes on their past. sim.run_to(…)
        prints each note once, and again only if the value has doubled."""
    def error_estimate(self, *, max_time: float = ...) -> Error_estimate:
        """Estimates the errors of positions and recorded quantities in time and in space. The
        companion runs start where the simulation was started, call its controllers, conditions and
        events again, and use all cores if there are no such functions. Their cost is about that of
        the run itself. Verdicts: 'converged' if the observed order in time is near that of the
        integrator, in space near that of the mesh, and the differences of the runs are similar
        functions of time; 'pre-asymptotic' if not, then the error may differ from the estimate by
        more than a factor of 3 and is usually smaller; 'chaotic' if nearby runs converge up to a
        time and separate afterwards; 'exact' if the runs agree to rounding. Meshes of one to three
        spans are compared with finer meshes. A function that changes variables of the script, also
        a load |t| …, cannot be repeated; the printed estimate then states the reason. Errors of the
        model itself are not included, such as unknown stiffnesses."""
    def section_forces(self, beam: Beam | str, s: float = ..., /) -> dict[str, Any]:
        """Returns axial force, shear force and moment of a beam at an undeformed arc length, or along
        the whole beam. The map has N (positive in tension), Q (positive to the left of the axis)
        and M (positive counter-clockwise) [force, force, force·length], acting from the following
        part of the beam on the preceding one, in the frame of the section; and axial_strain,
        shear_strain and curvature. Forces follow from strains by the material law; with damping
        (Kelvin–Voigt) they include the present strain rates. If the steps are too long for these
        rates, which then alternate, the rates are extrapolated from the means of the last two steps
        (not in the first step after a start or an impact). For a whole beam the result is an array
        with a map at each knot and at three points between, with the arc length s; where a joint
        divides the beam there are two with the same s. The values balance loads and inertia up to
        the ends of a beam; errors decrease with the span length to the power of the degree (N, Q),
        and of at least two (M). Linear elements have one value each. A force, moment, mass, spring
        or slider *inside* a beam causes a jump that smooth functions cannot represent: in the two
        neighbouring spans M has an error proportional to the span length, and Q oscillates by up to
        a fifth of the jump on any mesh. If such values matter, make two beams and join them there
        with scene.rigid(…)."""
    def reaction(self, station: Station | str, /) -> dict[str, Any]:
        """Returns the mean reaction of the support at a station over the last step: force, a vector,
        and moment. Means are computed only if one of the columns force, fx, fy, moment of a joint
        is recorded, as in scene.record("hinge1.force"), and then for all joints and supports;
        otherwise use the present force. Together with loads, gravity and drives they are the change
        of the momentum over the step; their moments about a point, with each force at the midpoint
        of its path, are the change of the angular momentum. This holds to rounding with
        energy_momentum() and energy_decaying(), and for the momentum also with fourth_order() and
        trapezoidal(). The means belong to the middle of the step, to second order, and include the
        impulses of bouncing sliders. Before the first step they are the present forces. Not
        available with generalized_alpha()."""
    def joint_force(self, joint: Joint | str, /) -> dict[str, Any]:
        """Returns the mean force and moment of a joint on its first station over the last step: force,
        a vector, and moment. Means are computed only if one of the columns force, fx, fy, moment of
        a joint is recorded, as in scene.record("hinge1.force"), and then for all joints and
        supports; otherwise use the present force. Together with loads, gravity and drives they are
        the change of the momentum over the step; their moments about a point, with each force at
        the midpoint of its path, are the change of the angular momentum. This holds to rounding
        with energy_momentum() and energy_decaying(), and for the momentum also with fourth_order()
        and trapezoidal(). The means belong to the middle of the step, to second order, and include
        the impulses of bouncing sliders. Before the first step they are the present forces. Not
        available with generalized_alpha()."""
    def present_reaction(self, station: Station | str, /) -> dict[str, Any]:
        """Returns the present reaction of the support at a station: force, a vector, and moment.
        Computed from the equations of motion, with loads evaluated just after the present time;
        second order in the step size with every method, like configuration and rates. The mean sum
        of the forces of loads, gravity and supports over a step is the change of the columns
        impulse_x and impulse_y divided by the step size."""
    def present_joint_force(self, joint: Joint | str, /) -> dict[str, Any]:
        """Returns the present force and moment of a joint on its first station: force, a vector, and
        moment. Computed from the equations of motion; second order in the step size, as for
        `present_reaction`. A joint with the ground is a support. The joint is given by the return
        value of scene.hinge or by its name, the kind and its number. A released joint has zero
        force."""
    def present_contact_force(self, slider: Slider | str, /) -> NDArray[np.float64]:
        """Returns the present contact force of a slider on its master. Computed from the equations of
        motion, with the order of the motion: second, fourth with fourth_order(). contact_force and
        the columns NAME.force are means of a step, which belong to its middle and may alternate
        from step to step. As a column: scene.record("NAME.present_force")."""
    def acceleration(self, station: Station | str, /) -> NDArray[np.float64]:
        """Returns the present acceleration of a station, computed from the equations of motion."""
    def spin(self, station: Station | str, /) -> float:
        """Returns the angular velocity of the section at a station, positive counter-clockwise."""
    def back(self, count: int = ..., /) -> None:
        """Goes back by one step or the given number of steps. State, time, history and counts of work
        are restored exactly. Steps are rows of the history: halves of a failed step and steps
        shortened by the arrival of a slider count as well. Functions registered with sim.at for
        later times are called again. Variables of the script do not change."""
    def rewind(self, t: float, /) -> None:
        """Goes back to a time: to the end of the last step at or before it. sim.rewind(0) goes to the
        start, at any start time; the start is always stored."""
    def fork(self, name: str = ..., /) -> Simulation:
        """Returns an independent copy of the simulation with the same past. It has its own history,
        can go back as far, and calls the functions registered with sim.at. Stations, beams and
        sliders of the scene are valid for both."""
    def keep_snapshots(self, megabytes: float, /) -> None:
        """Sets the memory limit for stored states from now on; 0 deletes all of them. A megabyte is a
        million bytes. A smaller limit deletes states at once."""
    def save(self, file: str, /) -> None:
        """Writes the simulation to a file in the output folder, completely or not at all. The file
        contains the scene, the state, the history and the configurations, with versions and a
        checksum. It does not contain earlier states to go back to, nor functions registered with
        sim.at. A scene with a schedule that is a function cannot be saved. Equal runs write equal
        files."""
    @property
    def scene(self) -> Scene:
        """Scene of the simulation; for a loaded simulation, the scene saved with it."""
    def contact_force(self, slider: Slider | str, /) -> NDArray[np.float64]:
        """Returns the contact force of a slider on its beam, as the mean of the last step; the force
        on its station is the opposite. The mean times the step size is the impulse on the beam in
        the step. The value belongs to the middle of the step, to second order. Before the first
        step it is the present force; after a release it is zero. present_contact_force has the
        order of the motion with every rule; scene.record("ring.present_force") records it. `withy
        docs sensors` has the rules for all forces. On splines with the conserving rule the force is
        smooth where the motion is. Where it alternates between steps (kinks of Lagrange elements,
        the relaxed rule), averaged("ring.force") of the history removes this; see
        scripts/contact_force.rhai. Impulses of impacts at an end, or at a corner of a track, are
        not included."""
    def slider_position(self, slider: Slider | str, /) -> float:
        """Returns the position of a slider on its beam or track, by undeformed length: 0 at the start,
        1 at the end. The product with the undeformed length of the beam is slider_arc_length; its
        rate is slider_speed. In the history NAME.speed is the rate of NAME.position times that
        length. On a closed track the turns are counted: 2.5 is half-way round for the third time,
        -0.5 half-way back."""
    def slider_arc_length(self, slider: Slider | str, /) -> float:
        """Returns the undeformed arc length from the start of the beam or track to the slider,
        including all turns of a closed track; its rate is slider_speed. As a column:
        scene.record("NAME.arc_length")."""
    def slider_speed(self, slider: Slider | str, /) -> float:
        """Returns the speed of a slider along its undeformed beam or track, positive towards the end."""
    @property
    def ended(self) -> bool:
        """True if a slider has reached the end of its beam and ended the run. After that run_to
        returns at once, step is refused with an error, and functions registered for later times are
        not called."""
    @property
    def ending(self) -> str:
        """Reason for which the run has ended."""
    @property
    def events(self) -> Any:
        """Events of sliders so far, at the ends of their beams and the seams of their tracks, and
        their take-offs and landings. slider is the name of the slider; end is "start" or "end";
        what is "stopped", "bounced", "rested" (in contact with the end stop until the contact force
        would be tensile or the slider is pulled away), "released" or, on a track, "passed" (to the
        next beam). Sliders with a side have events without end: "took off", "landed", "bounced" for
        a landing with rebound, and "passed" beyond an end of the beam. impulse is the vector of the
        total impulse of the slider on its beams in the impact with all simultaneous arrivals
        (mass·length/time), without contact forces. On a track the map also has beam, the name of
        the beam at whose end the event was."""
    def sleeve_couple(self, slider: Slider | str, /) -> float:
        """Returns the couple of a sleeve on its beam, counter-clockwise, as the mean of the last step;
        zero for other sliders. As contact_force: the mean belongs to the middle of the step, and
        before the first step it is the present couple. The column of the history is NAME.couple;
        scene.record("NAME.present_couple") records the present couple."""
    @property
    def releases(self) -> Any:
        """Releases made so far by scene.release, with their times."""
    def explain(self) -> str:
        """Returns the same table for a simulation, with its integrator and its steps."""

class Invariants(Object):
    """Largest errors of energy, momenta and gap."""
    @property
    def energy(self) -> float:
        """Largest relative change of E - W + D."""
    @property
    def momentum(self) -> float:
        """Largest relative change of p - ∫F dt."""
    @property
    def angular_momentum(self) -> float:
        """Largest relative change of L - ∫M dt."""
    @property
    def gap(self) -> float:
        """Largest gap of a joint [length]."""

class ValueWithDerivatives(Object):
    """A number, a vector or a section that depends on parameters of a scene."""

class Error_estimate(Object):
    """Estimated discretisation errors of a simulation."""
    @property
    def verdict(self) -> str:
        """Verdict on the errors of all positions together."""
    @property
    def summary(self) -> str:
        """Error of all positions together, in one line."""
    @property
    def rows(self) -> Any:
        """Errors of all quantities as maps, with the keys of error.of(…)."""
    def of(self, name: str, /) -> dict[str, Any]:
        """Errors of one quantity: "positions", a station such as "rod.end", or a column of the
        history. `present` and `largest` are the sums of the errors in time and in space at the
        present time, and their largest values of the run. Missing values are ()."""

class Refinement(Object):
    """A run that was refined until its error met a tolerance."""
    @property
    def simulation(self) -> Simulation:
        """Last run of scene.solve, at its end."""
    @property
    def reached(self) -> bool:
        """True if the tolerance of scene.solve was reached."""
    @property
    def rows(self) -> Any:
        """Runs of scene.solve with the largest errors of positions, relative to the length of the
        longest beam."""

class Recording(Object):
    """Selection of the recorded states of a run."""

class SlidingRule(Object):
    """Discretisation of the sliding constraint in a step."""

class Slider(Object):
    """A sliding joint of a scene."""
    @property
    def name(self) -> str:
        """Name of the slider."""

class Track(Object):
    """A sequence of joined beams along which sliders pass."""
    @property
    def name(self) -> str:
        """Name of the track."""
    @property
    def length(self) -> float:
        """Total undeformed length of the beams of the track."""
    @property
    def closed(self) -> bool:
        """True if the last beam leads back to the first one."""

class History(_objects.History):
    """Recorded values of a simulation by step."""
    def after(self, t: float, /) -> History:
        """Returns the rows from a time on."""
    def before(self, t: float, /) -> History:
        """Returns the rows up to a time."""
    def between(self, from_: float, to: float, /) -> History:
        """Returns the rows between two times, both included."""
    def drift(self, invariant: str, /) -> float:
        """Returns the largest change of an invariant since the first row, relative to its scale.
        energy: E - W + D relative to the largest energy; momentum: p - ∫F dt and angular_momentum:
        L - ∫M dt relative to the largest momenta that the energy allows; gap: the largest gap of a
        joint, a length."""
    def column(self, column: str, /) -> NDArray[np.float64]:
        """Returns the values of a column as an array."""
    def averaged(self, column: str, /) -> NDArray[np.float64]:
        """Returns a column in which each value is the mean of itself and the value in the row before.
        This removes alternation from step to step, as in a constraint force. Each mean belongs to
        the middle of its step. The first value and the first value after the start are unchanged,
        because values that belong to a step do not exist at the start."""
    def first(self, column: str, /) -> float:
        """Returns the value of a column in the first row."""
    def last(self, column: str, /) -> float:
        """Returns the value of a column in the last row."""
    def largest(self, column: str, /) -> float:
        """Returns the largest value of a column."""
    def smallest(self, column: str, /) -> float:
        """Returns the smallest value of a column."""
    @property
    def rows(self) -> int:
        """Number of rows, including the start."""
    @property
    def columns(self) -> Any:
        """Names of the columns: first those of every history, then those of springs, drives, sliders
        and recorded quantities of the scene."""
    def statistics(self, column: str, /) -> dict[str, Any]:
        """Returns the extremes of a column with their times, its means and its integral over time. The
        map has min, min_at, max, max_at, mean (over time), rms (root mean square) and integral."""
    def derivative(self, column: str, /) -> NDArray[np.float64]:
        """Returns the time derivative of a column at each row. Computed from the parabola through a
        row and its neighbours: second order, also with varying steps. At a jump, where two rows
        have the same time, each has the one-sided difference quotient."""
    def crossings(self, column: str, level: float = ..., /) -> NDArray[np.float64]:
        """Returns the times at which a column crosses a level, upwards or downwards."""
    def spectrum(self, column: str, most: int = ..., /) -> Any:
        """Returns frequency and amplitude of the strongest vibrations in a column, in descending order
        of amplitude. The frequency is in cycles per unit of time; multiply by 2π for the angular
        frequency. The mean is excluded. Rows must be evenly spaced: use a fixed dt, and a window
        without additional ends of steps. Two vibrations less than about four cycles over the window
        apart are not separated, and slower ones are not found. Window of Blackman and Harris; F. J.
        Harris, Proc. IEEE 66 (1978) 51-83."""

class StabilityMap(Object):
    """Outcomes of runs for every combination of parameters."""
    @property
    def cells(self) -> Any:
        """Array with a map for each cell: its values, and finished, outcome, energy_growth,
        iterations, most_iterations, retries and steps."""

class TableOfCosts(Object):
    """Cost of a step of a scene with different features."""
    @property
    def rows(self) -> Any:
        """Array with a map for each row: feature, outcome, shortest and median time of a step in
        seconds, ratio to the scene alone, iterations, factorisations, unknowns, half_bandwidth,
        border and columns."""

class PrecisionStudy(Object):
    """Error against run time of many combinations of mesh, integrator and step size."""
    @property
    def table(self) -> str:
        """Table of all combinations, mesh by mesh: errors, times, work and the drift of energy; ●
        marks those on the front."""
    @property
    def rows(self) -> Any:
        """Array with a map for each combination: mesh, integrator, dt, error, run_time, steps,
        energy_drift, outcome and more."""
    @property
    def front(self) -> Any:
        """Array of the Pareto-optimal combinations, for which no other one is both faster and more
        accurate, the fastest first."""
    @property
    def reference(self) -> str:
        """Description of the reference of the errors."""
    def cheapest(self, error: float | ArrayLike, /) -> dict[str, Any]:
        """Returns the fastest combination with at most this error; for several errors a table, with
        the other programs of the option other_programs for comparison. For one error the result is
        a map like those of rows, or () if no combination reaches the error."""
    def cheapest_confirmed(self, error: float, /) -> dict[str, Any]:
        """Returns the fastest combination with at most this error for which all smaller steps on its
        mesh have no larger error. Errors of mesh and step size can cancel; a small error that
        smaller steps do not confirm is a coincidence. The result is () if there is no such
        combination."""

class FinestRun(Object):
    """A fine run that a study uses as its reference."""

class ConvergenceStudy(Object):
    """Errors over step sizes or meshes, and their orders."""
    @property
    def table(self) -> str:
        """Table of errors and observed orders of every quantity, with the order over all sizes, by
        least squares, in the last row."""
    @property
    def rows(self) -> Any:
        """Array with a map for every integrator and quantity: sizes, errors, orders, order and
        claimed."""
    @property
    def reference(self) -> str:
        """Description of the reference of the errors."""
    def order(self, quantity: str, integrator: Integrator, /) -> float:
        """Returns the order of a quantity with an integrator, by least squares over all sizes; NaN if
        it cannot be determined."""
    def plot(self, quantity: str, file: str, /) -> None:
        """Plots the errors of a quantity over the sizes, with lines of the theoretical orders."""

class Distribution(Object):
    """Distribution of a parameter of a sweep."""

class Samples(Object):
    """Sampling plan for the parameters of a sweep."""

class Sweep(Object):
    """Results of a function for many values of its parameters."""
    @property
    def table(self) -> SweepTable:
        """Table of all rows: parameters, results, and the reasons of failed runs."""
    @property
    def failures(self) -> SweepTable:
        """Table of the failed rows, with their reasons."""
    def sensitivity(self, result: str, /) -> Any:
        """Returns the share of the variance of a result that each parameter explains (Sobol' indices),
        in descending order. An array with a map for each parameter: parameter, first (main effect:
        variance of the mean over all other parameters, as a fraction of the total variance) and
        total (including interactions; () if the points do not allow it). For a grid of equally
        likely values the indices are exact; for saltelli(…) they are estimated by the formulas of
        M. J. W. Jansen (Computer Physics Communications 117 (1999) 35-43); for other points only
        first is estimated, from groups of neighbours. Estimates from N blocks or points have an
        uncertainty of about 1/√N: at least 30 are required, and thousands resolve small shares. The
        number of rows omitted because of failed runs is reported. Parameters must be independent,
        as those of sweeps are."""
    def plot(self, x: str, y: str, z: str = ..., /) -> None:
        """Plots a column over another one, or as colours over two others. Over a parameter given by an
        array: a curve for each combination of the other parameters, or mean, minimum and maximum if
        there are more than eight. Over other columns: points, at most 2000, selected at random. The
        axis of x is logarithmic for logspace(…) and for logarithmic distributions over a decade or
        more. With z: a map with a cell for each pair of values of two such parameters, or 20 × 20
        cells for points; a cell with several runs shows their mean, and an empty cell is hatched.
        Of more than 160 values along an axis, neighbours are combined into one cell with their
        mean."""
    def plot_matrix(self) -> None:
        """Plots up to six numeric columns over each other, with their histograms. At most 500 rows are
        shown, selected at random and the same in all panels; the histograms contain all rows."""
    def plot_histogram(self, column: str, /) -> None:
        """Plots a histogram of a column. A column with at most 64 different, repeated values has a
        class for each value; otherwise classes have equal width."""

class SweepTable(Object):
    """Rows of a sweep: parameters, results, and reasons of failed runs."""
    def where(self, condition: Callable[..., Any], /) -> SweepTable:
        """Returns the rows for which a function of the row, a map, returns true; failed rows have a
        `failure` and no results."""
    def column(self, name: str, /) -> NDArray[np.float64]:
        """Returns a parameter or result of all rows as numbers; NaN in failed rows and where the value
        is not a number."""
    @property
    def rows(self) -> Any:
        """Array with a map for each row: parameters and results, or `failure` for a failed run."""
    @property
    def count(self) -> int:
        """Number of rows."""
    def plot(self, x: str, y: str, z: str = ..., /) -> None:
        """Plots a column over another one, or as colours over two others. Over a parameter given by an
        array: a curve for each combination of the other parameters, or mean, minimum and maximum if
        there are more than eight. Over other columns: points, at most 2000, selected at random. The
        axis of x is logarithmic for logspace(…) and for logarithmic distributions over a decade or
        more. With z: a map with a cell for each pair of values of two such parameters, or 20 × 20
        cells for points; a cell with several runs shows their mean, and an empty cell is hatched.
        Of more than 160 values along an axis, neighbours are combined into one cell with their
        mean."""
    def plot_matrix(self) -> None:
        """Plots up to six numeric columns over each other, with their histograms. At most 500 rows are
        shown, selected at random and the same in all panels; the histograms contain all rows."""
    def plot_histogram(self, column: str, /) -> None:
        """Plots a histogram of a column. A column with at most 64 different, repeated values has a
        class for each value; otherwise classes have equal width."""

class Fit(Object):
    """Parameters fitted to data, with their uncertainties."""
    @property
    def parameters(self) -> dict[str, Any]:
        """Map of the fitted parameters by name."""
    @property
    def errors(self) -> dict[str, Any]:
        """Map of the standard errors of the parameters by name; () if the residuals do not determine
        them, or do not depend on one of them."""
    @property
    def half_widths(self) -> dict[str, Any]:
        """Map of half the widths of the confidence intervals of the parameters, with the option
        `confidence`, default: 0.95; () if they are not determined."""
    @property
    def covariance(self) -> Any:
        """Covariance matrix of the parameters in the order of their names; empty if the residuals do
        not determine it."""
    @property
    def residuals(self) -> NDArray[np.float64]:
        """Residuals without weights; for a model the result minus the measured value."""
    @property
    def outcome(self) -> str:
        """Outcome of the search: settled, or the reason of the failure."""
    @property
    def runs(self) -> int:
        """Number of calls of the function."""
    @property
    def derivatives(self) -> str:
        """Source of the derivatives: the runs, or central differences of runs with the reason."""
    def plot(self) -> None:
        """Plots the measured data with the fitted model, and the residuals below, in NAME-fit.svg."""

class Design(Object):
    """The best design found by a search."""
    @property
    def parameters(self) -> dict[str, Any]:
        """Map of the parameters of the best design by name."""
    @property
    def results(self) -> dict[str, Any]:
        """Map of the results of the best design by name."""
    @property
    def runs(self) -> int:
        """Number of calls of the function, without the call that detects missing derivatives."""
    @property
    def derivatives(self) -> str:
        """Source of the derivatives: the runs, or none with the reason."""
    @property
    def settled(self) -> bool:
        """True if the search finished before the largest number of runs was reached."""
