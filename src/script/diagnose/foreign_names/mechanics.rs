//! Terms of mechanics and of other simulation programs, with their replacements in withy.

use super::entry::{ForeignName, entry};

pub const WORDS: &[ForeignName] = &[
    entry(
        &[
            "supports",
            "fix",
            "fixed support",
            "pin",
            "pinned",
            "encastre",
            "boundary",
            "boundary conditions",
            "boundary condition",
            "degree of freedom",
            "degrees of freedom",
            "bc",
            "constraint",
            "constrain",
            "ground",
            "anchor",
        ],
        "scene.clamp(station) fixes position and angle, scene.hinge(station) fixes the \
        position, scene.support(station, #{ y: true }) fixes single components",
        &["clamp", "hinge", "support", "reaction"],
    ),
    entry(
        &["roller", "rollers", "rail", "guide", "track", "sleeve", "eyelet", "prismatic", "slide"],
        "scene.support(station, #{ y: true }) is a roller on the ground, #{ along: [1, 1] } an \
        inclined one; for a curved path use a stiff, clamped beam as rail and \
        scene.slider(station, rail)",
        &["support", "slider", "clamp"],
    ),
    entry(
        &["damping", "damp", "dashpot", "viscous", "rayleigh", "dissipation"],
        "scene.damper(from, to, #{ damping: c }) is a dashpot, damping: |rate| … one with a \
        law; scene.start(#{ integrator: energy_decaying(#{ chi: 0.1 }), dt: 0.1 }) damps \
        vibration and keeps both momenta",
        &["damper", "energy_decaying", "generalized_alpha"],
    ),
    entry(
        &["friction", "coulomb", "stick-slip", "stiction", "frictionless", "clutch"],
        "scene.slider(station, beam, #{ friction: 0.3 }) slides with Coulomb friction; \
        scene.wall, scene.disc and scene.contact have the option friction; \
        scene.brake(section, #{ moment: 2 }) is friction of a hinge, a brake or a clutch; a damper \
        with #{ damping: |rate| 5 * tanh(rate / 0.01), rates: [-1, 1] } approximates dry friction \
        along a distance",
        &["slider", "brake", "wall", "contact"],
    ),
    entry(
        &["plasticity", "plastic", "yielding", "creep", "fatigue", "fracture", "hysteresis"],
        "plastic deformation and damage are not supported: materials are elastic, with or \
        without damping",
        &["section", "damping_ratios"],
    ),
    entry(
        &["springs", "elastic", "bushing"],
        "scene.spring(from, to, #{ stiffness: k }) connects stations or points of the ground, \
        scene.torsion_spring sections",
        &["spring", "torsion_spring", "tendon"],
    ),
    entry(
        &[
            "plot",
            "draw",
            "figure",
            "chart",
            "picture",
            "graph",
            "plt",
            "matplotlib",
            "subplot",
            "axes",
            "animate",
            "animation",
        ],
        "plot_motion(sim, \"name\") plots the beams, plot_history(sim, [\"energy\"], \"name\") \
        columns over time; at the prompt use :show and :plot",
        &["plot_motion", "plot_history", "plot_drift", "plot_modes"],
    ),
    entry(
        &["movie", "video", "gif", "mp4", "apng"],
        "write_animation(sim, \"name.png\") writes an animated PNG, which browsers and \
        presentation programs play; write_viewer(sim, \"name.html\") a page with a time slider",
        &["write_animation", "write_viewer", "plot_motion"],
    ),
    entry(
        &[
            "load",
            "loads",
            "distributed load",
            "pressure",
            "traction",
            "point load",
            "add_force",
            "addForce",
        ],
        "use scene.force(station, [x, y]), scene.moment(station, m) or scene.line_load(beam, \
        [x, y])",
        &["force", "moment", "line_load", "schedule"],
    ),
    entry(&["torque"], "write scene.moment(station, m)", &["moment"]),
    entry(
        &["couple"],
        "a load is scene.moment(station, m); sim.sleeve_couple(sleeve) is the couple of a sleeve",
        &["moment", "sleeve_couple"],
    ),
    entry(&["weight", "grav"], "write scene.gravity([0, -9.81])", &["gravity"]),
    entry(
        &[
            "material",
            "young",
            "youngs_modulus",
            "modulus",
            "density",
            "poisson",
            "EIy",
            "inertia",
            "cross_section",
            "profile",
        ],
        "section(#{ EA: …, GA: …, EI: …, rho_A: …, rho_I: … }) takes stiffness and mass per \
        length; std/sections computes them from shape and material",
        &["section", "std/sections"],
    ),
    entry(
        &[
            "mesh",
            "elements",
            "element",
            "fem",
            "discretisation",
            "discretization",
            "refine",
            "nodes",
        ],
        "the option basis: bspline(16) of a beam sets the mesh and its number of spans; \
        lagrange creates Lagrange elements",
        &["bspline", "lagrange", "study_convergence"],
    ),
    entry(
        &["speed", "velocity_magnitude"],
        "sim.velocity(station).norm() is the speed of a station, sim.spin(station) the angular \
        velocity of its section",
        &["velocity", "spin"],
    ),
    entry(
        &["node", "point_at", "tip", "middle"],
        "stations of a beam are rod.start, rod.end and rod.at(s)",
        &["start", "end", "at"],
    ),
    entry(
        &[
            "eigenvalues",
            "eigenvalue",
            "eig",
            "eigenfrequency",
            "eigenfrequencies",
            "natural frequency",
            "resonance",
            "modal",
            "rigid-body mode",
            "rigid body mode",
        ],
        "scene.modes(4) computes frequencies and shapes of small vibrations",
        &["modes", "angular_frequencies"],
    ),
    entry(
        &[
            "accuracy",
            "discretisation error",
            "discretization error",
            "richardson",
            "extrapolation",
            "grid convergence",
        ],
        "sim.error_estimate() estimates the errors of a run in time and in space; scene.solve \
        refines a run until they meet a tolerance",
        &["error_estimate", "solve", "study_convergence"],
    ),
    entry(
        &["capstan", "belt", "belt friction", "bollard"],
        "scene.disc(centre, radius, #{ stiffness: k, friction: 0.3 }) is a peg with friction for a \
        rope, which is a beam with a small EI; a tendon runs over its pins without friction",
        &["disc", "beam", "tendon"],
    ),
    entry(
        &["cam", "follower", "cam follower"],
        "scene.contact([cam, follower], #{ stiffness: k }) lets a rigid body with an outline push \
        another body; scene.move prescribes the lift of a follower as a function of time",
        &["contact", "body", "move"],
    ),
    entry(
        &["restart", "checkpoint", "restart file", "resume"],
        "sim.save(\"name.withy\") writes a restart file, and load_simulation(\"name.withy\") continues it",
        &["save", "load_simulation"],
    ),
    entry(
        &["envelope", "peak value", "extreme values"],
        "max(sim.history.column(\"rod.end.y\")) is the largest value of a recorded column",
        &["column", "max", "min", "record"],
    ),
    entry(
        &["bode", "frequency response", "transfer function", "frequency sweep"],
        "there is no frequency response; scene.modes and damped_modes give the poles, and a sweep \
        over the frequency of a sine load gives the amplitudes",
        &["damped_modes", "sweep", "sine"],
    ),
    entry(
        &["static", "statics", "at rest", "balance"],
        "scene.equilibrium() computes the static equilibrium of a scene",
        &["equilibrium", "load_control"],
    ),
    entry(
        &[
            "critical load",
            "critical factor",
            "euler load",
            "euler buckling",
            "linear buckling",
            "eigenvalue buckling",
            "stability",
            "instability",
            "bifurcation",
        ],
        "scene.buckling(3) computes linear critical load factors and shapes; is_stable shows the \
        stability of an equilibrium",
        &["buckling", "is_stable", "plot_buckling"],
    ),
    entry(
        &["snap", "snap-through", "post-buckling", "imperfection", "limit load"],
        "arc_length follows a path past limit points; is_stable shows the stability of an \
        equilibrium; a perfect column needs a small imperfection, such as a lateral force",
        &["arc_length", "is_stable", "equilibrium"],
    ),
    entry(
        &["contact", "collision", "impact", "bounce", "obstacle", "collide", "bumper", "peg"],
        "scene.wall(point, normal, #{ stiffness: k }) is a floor or wall for beams, particles and \
        stations, scene.disc(centre, radius, #{ stiffness: k }) a pin or peg; a slider bounces at \
        the ends of its beam with ends: \"bounce\"; scene.contact([a, b], #{ stiffness: k, \
        radius: r }) lets bodies touch each other",
        &["contact", "wall", "disc", "slider", "spring"],
    ),
    entry(
        &["cable", "rope", "wire", "chain", "thread", "pulley", "sheave"],
        "scene.tendon(places, #{ stiffness: k, acts: \"pull\" }) is a massless rope over pulleys \
        without radius; a rope with mass is a beam with a small EI; std/mechanisms has a chain",
        &["tendon", "section", "std/mechanisms"],
    ),
    entry(
        &[
            "rest length",
            "natural length",
            "unstressed length",
            "winch",
            "cylinder",
            "hydraulic",
            "piston",
            "muscle",
            "linear actuator",
            "actuator",
            "servo",
        ],
        "the option length of a spring or tendon is its length without force, a number or a \
        function of time |t| …; length_rate is its rate, a function of time or a controller \
        |t, q| …; for a servo, use angle or angle_rate of scene.torsion_spring",
        &["spring", "tendon", "torsion_spring", "motor"],
    ),
    entry(
        &["initial velocity", "initial velocities", "initial condition", "initial conditions"],
        "the options velocity, spin and about of a beam, and velocity of a particle set the \
        initial motion; velocities: \"project\" of a slider makes it compatible",
        &["beam", "particle", "slider"],
    ),
    entry(
        &["wheel", "disc", "flywheel", "rigid body", "gear"],
        "scene.body(…) is a rigid body with mass and moment of inertia; rolling and gears are \
        not modelled",
        &["body", "motor", "torsion_spring"],
    ),
    entry(
        &["bead", "ball", "point mass", "lumped"],
        "scene.particle(point, mass) is a free point mass, scene.mass(station, m) is attached \
        to a station",
        &["particle", "mass"],
    ),
    entry(
        &["joint", "joints", "connect", "weld", "attach", "fasten", "revolute"],
        "scene.hinge(a, b) joins two stations with free rotation, scene.rigid(a, b) joins \
        position and angle, scene.slider allows sliding",
        &["hinge", "rigid", "slider"],
    ),
    entry(
        &["run", "simulate", "solve", "integrate", "odeint", "ode45", "solve_ivp", "advance"],
        "let sim = scene.start(#{ dt: 0.01 }); sim.run_to(10); runs a scene to a time",
        &["start", "run_to", "step"],
    ),
    entry(
        &["timestep", "time_step", "time step", "delta_t", "Dt"],
        "set the step size at the start: scene.start(#{ dt: 0.01 })",
        &["start", "dt", "adaptive"],
    ),
    entry(
        &["spin", "rotate", "rotation", "omega", "angular_velocity"],
        "scene.beam(#{ …, spin: 2 }) sets the initial angular velocity of a beam; \
        sim.angle(station) is the angle of a section",
        &["beam", "angle", "angular_momentum"],
    ),
    entry(
        &["bending_moment", "shear_force", "axial_force", "internal forces", "stress"],
        "reaction of an equilibrium and contact_force of a slider return forces; sim.strain is \
        the strain energy",
        &["reaction", "contact_force", "strain"],
    ),
    entry(
        &["Scene", "Model", "model", "world", "World", "make_scene"],
        "write let scene = new_scene(\"name\");",
        &["new_scene"],
    ),
    entry(
        &["Beam", "rod", "bar", "truss", "member", "add_beam", "addBeam"],
        "write let rod = scene.beam(#{ axis: line([0, 0], [2, 0]), section: s });",
        &["beam", "line"],
    ),
    entry(
        &["feedback", "control", "controller", "pid", "drive", "sampling", "latency", "dead_time"],
        "a load or a motor takes a function of time and simulation, called at the start of \
        every step: scene.force(rod.end, [0, 1], |t, q| -2 * q.velocity(rod.end).y), or with \
        sampling period and delay: #{ sample: 0.01, delay: 0.003 }",
        &["motor", "force"],
    ),
    entry(
        &["shaker", "prescribed", "imposed", "excitation", "displacement"],
        "scene.move(station, #{ y: |t| 0.01 * sin(40 * t) }) prescribes a displacement, \
        scene.motor(section, #{ angle: |t| 3 * t }) a rotation",
        &["move", "motor"],
    ),
];
