//! Natural modes of vibration.

use std::rc::Rc;

use rhai::{Array, Dynamic, INT, Map};

use super::equilibria::repeated;
use super::error_estimates::ERROR_ESTIMATE;
use super::scenes::{SCENE, STATION};
use super::simulations::SIMULATION;
use super::vectors::VECTOR;
use crate::geometry::Vec2;
use crate::output::{Cell, TextTable, significant};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, integer, object};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{
    BindingTable, FunctionBinding, NativeFunction, method, property,
};
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::studies::error_estimate::{ErrorEstimate, FREQUENCIES};
use crate::script::studies::error_on_meshes::{MeshResult, Together};
use crate::system::{DriveKind, Scene, StartMotion, System};
use crate::vibration::{DampedMode, Mode, ModeShapes, Modes, VibrationError};

pub const TABLE: BindingTable = BindingTable {
    name: "modes",
    doc: "Modes of small vibration about a configuration: natural frequencies and mode shapes, \
        in ascending order. Rigid body motions have frequency 0.",
    types: &[MODES],
    setup: EXAMPLE,
    constants: &[],
    rows: &[
        method(SCENE, "modes", &[COUNT], |call| {
            let handle = call.receiver::<SceneHandle>()?;
            let scene = handle.scene().borrow().clone();
            let model = assemble(call, &scene)?;
            expect_room(call, &model)?;
            warn_about_omissions(call, &handle, &scene);
            let modes = undamped_modes(call, |count, goes_on| Modes::of(&model, count, goes_on))?;
            Ok(Dynamic::from(ModesHandle::drawn(handle, &scene, modes)))
        })
        .returns(Returns::object(MODES))
        .summary("Computes the lowest natural frequencies and mode shapes of the undeformed scene.")
        .doc(
            "Each mode has a residual; if one is not below 1e-6, the call is refused with an \
            error. With up to 240 unknowns all modes are computed at once, with more only the \
            lowest, by the block Lanczos method (Grimes, Lewis & Simon 1994); a count of the \
            negative pivots verifies that none is missing. Sliders can move along their beams, \
            under their present contact forces. Modes are computed at rest, without controllers \
            and spins; a note names those of the scene. Loads and gravity are ignored, because the \
            scene is not deformed by them: for their effect, as on an inverted pendulum, use \
            scene.equilibrium().modes(n). For other configurations use rest.modes(n) of an \
            equilibrium or sim.modes(n) of a simulation.",
        )
        .example("let modes = scene.modes(3);\nprint(modes);\ncheck_close(modes.angular_frequencies[0], 0.35160 * 2.5^2, 0.01);")
        .with_related(&["plot_modes", "equilibrium"]),
        method(SIMULATION, "modes", &[COUNT], |call| {
            let handle = call.receiver::<SimulationHandle>()?;
            expect_room(call, handle.simulation().model())?;
            let modes = undamped_modes(call, |count, goes_on| handle.modes(count, goes_on))?;
            let simulation = handle.simulation();
            Ok(Dynamic::from(ModesHandle::new(handle.scene().clone(), simulation.scene(), modes)))
        })
        .returns(Returns::object(MODES))
        .summary("Computes the lowest natural frequencies and mode shapes about the present \
            configuration of a simulation, with velocities set to zero.")
        .doc("The present section forces of beams (zero in an undeformed beam) and the present \
            forces on points of rigid bodies are included; an inverted pendulum therefore has \
            a growing mode at the start.")
        .example("let sim = scene.start(#{ dt: 0.1 });\nlet drawn = scene.modes(1).angular_frequencies;\ncheck(sim.modes(1).angular_frequencies == drawn);"),
        method(SCENE, "damped_modes", &[COUNT], |call| {
            let handle = call.receiver::<SceneHandle>()?;
            let scene = handle.scene().borrow().clone();
            warn_about_omissions(call, &handle, &scene);
            damped_modes(call, &assemble(call, &scene)?)
        })
        .returns(Returns::ARRAY)
        .summary("Computes the lowest damped vibrations of the undeformed scene: maps of decay_rate, \
            angular_frequency and damping_ratio.")
        .doc(
            "The eigenvalues λ = -δ ± iω of λ² M + λ D + K, exact for any damping, in ascending \
            order of |λ|. An overdamped mode has ω = 0 and a damping ratio of 1, and each of \
            its two λ is one result. Only for up to 240 unknowns and without sliders. Dampers \
            with a law and drag contribute their linear damping at rest.",
        )
        .example(
            "let oscillator = new_scene(\"oscillator\");\nlet bead = oscillator.particle([1, 0], 2);\noscillator.support(bead, #{ y: true });\n\
             oscillator.spring([0, 0], bead, #{ stiffness: 18, damping: 20 });\nlet damped = oscillator.damped_modes(2);\n\
             check_close(damped[0].decay_rate, 1, 1e-12);\ncheck_close(damped[1].decay_rate, 9, 1e-12);",
        )
        .with_related(&["damping_ratios", "modes"]),
        binding("angular_frequencies", Returns::NUMBERS.unit("rad/time"), |call| list(call, Mode::angular_frequency))
            .summary("Angular frequency ω of each mode; 0 for modes that do not vibrate.")
            .example("let modes = scene.modes(2);\ncheck(modes.angular_frequencies[1] > modes.angular_frequencies[0]);")
            .with_related(&["frequencies", "periods"]),
        binding("frequencies", Returns::NUMBERS.unit("1/time"), |call| list(call, Mode::frequency))
            .summary("Frequency ω/2π of each mode, in cycles per unit of time.")
            .example("let modes = scene.modes(1);\ncheck_close(modes.frequencies[0] * modes.periods[0], 1, 1e-12);"),
        binding("periods", Returns::NUMBERS.unit("time"), |call| list(call, Mode::period))
            .summary("Period 2π/ω of each mode; infinite for modes that do not vibrate.")
            .example("let half = scene.modes(1).periods[0] / 2;\nlet sim = scene.start(#{ dt: half / 20 });\nsim.run_to(half);"),
        binding("growth_rates", Returns::NUMBERS.unit("1/time"), |call| list(call, Mode::growth_rate))
            .summary("Growth rate of each mode of an unstable configuration; 0 for modes that \
                vibrate.")
            .example("check(scene.modes(1).growth_rates == [0]);")
            .with_related(&["is_stable"]),
        binding("damping_ratios", Returns::NUMBERS.unit("-"), |call| {
            Ok(modes(call)?.0.modes.damping_ratios().map(Dynamic::from).collect::<Array>().into())
        })
        .summary("Damping ratio of each mode due to dampers, damped materials and drag, as a \
            fraction of critical damping; 0 without damping.")
        .doc(
            "φᵀ D φ/(2ω) with φᵀ M φ = 1: exact where damping does not couple modes, as for a \
            material with equal relaxation times, else to first order in the damping. The \
            frequencies are those without damping. For exact values use scene.damped_modes(n).",
        )
        .example(
            "let scene = new_scene(\"damped\");\n\
             let s = section(#{ EA: 1e6, GA: 1e6, EI: 100, rho_A: 1, rho_I: 1e-4, damping: #{ axial: 1e-3, shear: 1e-3, bending: 1e-3 } });\n\
             let arm = scene.beam(#{ axis: line([0, 0], [4, 0]), basis: bspline(8), section: s });\nscene.clamp(arm.start);\n\
             let modes = scene.modes(2);\ncheck_close(modes.damping_ratios[1], 1e-3 * modes.angular_frequencies[1] / 2, 1e-9);",
        )
        .with_related(&["section", "damper"]),
        binding("residuals", Returns::NUMBERS.unit("-"), |call| list(call, |mode| mode.residual))
            .summary("Residual of each mode: an upper bound of the relative error of ω² + σ.")
            .doc(
                "σ is about the square of the lowest bending frequency. The residual is the \
                relative change, in energy, of the shape and its section forces in the next \
                correction; the error of ω² is about its square. The discretisation error is \
                not included: compare with twice the number of spans.",
            )
            .example("check(scene.modes(3).residuals.all(|residual| residual < 1e-6));")
            .with_related(&["angular_frequencies"]),
        method(MODES, "error_estimate", &[], estimated_error)
            .returns(Returns::object(ERROR_ESTIMATE))
            .summary("Estimates the errors of the angular frequencies and growth rates due to the mesh.")
            .doc("The modes are computed again with three quarters and half of the spans, about the \
                equilibrium again if they are those of an equilibrium. Modes about the present \
                configuration of a simulation are refused.")
            .example("let error = scene.modes(2).error_estimate();\nprint(error);\n\
                check(error.verdict == \"converged\" && error.of(\"mode 1\").present < 0.1);"),
        binding("is_stable", Returns::BOOLEAN, |call| Ok(modes(call)?.0.modes.is_stable().into()))
            .summary("True if no mode grows.")
            .example("check(scene.modes(1).is_stable);"),
        binding("count", Returns::INTEGER, |call| Ok(Dynamic::from(modes(call)?.0.modes.all().len() as INT)))
            .summary("Number of modes.")
            .example("check(scene.modes(4).count == 4);"),
        method(MODES, "displacement", &[integer("mode").non_negative(), object("station", STATION)], |call| {
            let handle = modes(call)?;
            displacement_in(call, "mode", handle.0.modes.shapes(), &handle.0.of, &handle.0.scene)
        })
        .returns(Returns::object(VECTOR).unit("-"))
        .summary("Returns the displacement of a station in a mode (the first is mode 0), relative to \
            the control point with the largest displacement.")
        .example("let modes = scene.modes(2);\ncheck_close(norm(modes.displacement(0, rod.end)), 1, 1e-9);\ncheck(norm(modes.displacement(1, rod.start)) < 1e-12);"),
    ],
};

const EXAMPLE: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e6, GA: 1e6, EI: 100, rho_A: 1, rho_I: 1e-4 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [4, 0]), basis: bspline(8), section: s });\n\
    scene.clamp(rod.start);";

pub(super) const COUNT: Parameter = integer("count").positive().or(Presence::Integer(6));

pub const MODES: Type = Type::of::<ModesHandle>();

#[derive(Clone)]
pub struct ModesHandle(Rc<ModesData>);

struct ModesData {
    of: SceneHandle,
    scene: Scene,
    modes: Modes,
    about: ModesReference,
}

enum ModesReference {
    Drawn,
    Rest(EquilibriumHandle),
    Motion,
}

impl ModesHandle {
    pub fn new(of: SceneHandle, scene: &Scene, modes: Modes) -> Self {
        Self(Rc::new(ModesData { of, scene: scene.clone(), modes, about: ModesReference::Motion }))
    }

    fn drawn(of: SceneHandle, scene: &Scene, modes: Modes) -> Self {
        Self(Rc::new(ModesData { of, scene: scene.clone(), modes, about: ModesReference::Drawn }))
    }

    pub fn at_rest(rest: &EquilibriumHandle, modes: Modes) -> Self {
        let (of, scene) = (rest.scene().clone(), rest.equilibrium().scene().clone());
        Self(Rc::new(ModesData { of, scene, modes, about: ModesReference::Rest(rest.clone()) }))
    }

    pub fn held(&self) -> (&Scene, &Modes) {
        (&self.0.scene, &self.0.modes)
    }
}

impl Scripted for ModesHandle {
    const NAME: &'static str = "modes";
    const DOC: &'static str = "Natural frequencies and shapes of small vibrations.";

    fn show(&self) -> String {
        let mut table = TextTable::new(&["mode", "ω [rad/time]", "period [time]", ""]);
        let damped = self.0.modes.damping_ratios();
        for (number, (mode, ratio)) in self.0.modes.all().iter().zip(damped).enumerate() {
            let shown = |value: f64| Cell::Number(significant(value, 7));
            let (period, remark) = match mode.square {
                0.0 => {
                    let hidden = significant(mode.rounding.sqrt(), 2);
                    (
                        Cell::Text("-".into()),
                        format!("no stiffness, or hidden by rounding errors (ω < {hidden})"),
                    )
                }
                square if square < 0.0 => {
                    let rate = significant(mode.growth_rate(), 4);
                    (Cell::Text("-".into()), format!("unstable: grows like exp({rate} t)"))
                }
                _ if ratio > 0.0 => {
                    (shown(mode.period()), format!("damping ratio {}", significant(ratio, 4)))
                }
                _ => (shown(mode.period()), String::new()),
            };
            let number = Cell::Number(number.to_string());
            table.row([number, shown(mode.angular_frequency()), period, Cell::Text(remark)]);
        }
        let mut shown = table.to_string().trim_end().to_owned();
        let ModesData { scene, about, .. } = &*self.0;
        let acts = scene.loads().next().is_some() || scene.gravity != Vec2::zeros();
        if matches!(about, ModesReference::Drawn) && acts {
            shown += "\nof the undeformed scene; scene.equilibrium().modes(n) includes the effect of \
                loads and gravity, as on a pendulum";
        }
        shown
    }
}

fn warn_about_omissions(call: &Call, handle: &SceneHandle, scene: &Scene) {
    let steered = scene.schedules().filter(|(_, schedule)| schedule.is_sampled());
    let controllers: Vec<String> = steered
        .map(|(name, _)| scene.source_of_schedule(name).trim_end_matches(',').to_owned())
        .collect();
    let spinning = |motion: &StartMotion| motion.spin != 0.0;
    let beams = scene.beams.iter().filter(|beam| spinning(&beam.motion));
    let bodies = scene.rigid_bodies.iter().filter(|body| spinning(&body.motion));
    let motors = scene.drives.iter().filter(|drive| drive.kind == DriveKind::Motor);
    let spins: Vec<String> = beams
        .map(|beam| format!("beam '{}'", beam.name))
        .chain(bodies.map(|body| format!("body '{}'", body.name)))
        .chain(motors.map(|drive| format!("motor '{}'", drive.name)))
        .collect();
    if (controllers.is_empty() && spins.is_empty()) || !handle.take_modes_note() {
        return;
    }
    if !controllers.is_empty() {
        let names = controllers.join(", ");
        call.context().print_message(&format!(
            "note: modes do not include the effect of controllers ({names}); simulate the vibration \
            to see it"
        ));
    }
    if !spins.is_empty() {
        let names = spins.join(", ");
        call.context().print_message(&format!(
            "note: modes are computed at rest, without the centrifugal and gyroscopic forces of the \
            spin of {names}"
        ));
    }
}

/// Assembles a scene, unless the run must end.
pub(super) fn assemble(call: &Call, scene: &Scene) -> Result<System, ScriptError> {
    let assembled = System::assemble_while(scene, &mut || !call.context().is_stopped());
    call.context().proceed()?;
    Ok(assembled?)
}

pub(super) fn expect_room(call: &Call, model: &System) -> Result<(), ScriptError> {
    let needed = Modes::memory(model, call.count("count")?);
    call.context().expect_room("so many modes of so large a scene", needed)
}

pub(super) fn undamped_modes(
    call: &Call,
    find: impl FnOnce(usize, &mut dyn FnMut() -> bool) -> Result<Modes, VibrationError>,
) -> Result<Modes, ScriptError> {
    let context = call.context();
    match find(call.count("count")?, &mut || !context.is_stopped()) {
        Err(VibrationError::Interrupted) => Err(context.why_stopped("a search for modes")),
        found => Ok(found?),
    }
}

fn estimated_error(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let ModesData { scene, modes, about, .. } = &*call.receiver::<ModesHandle>()?.0;
    if let ModesReference::Motion = about {
        let message = "the errors of modes about the present configuration of a simulation are not \
            estimated";
        return Err(call.error(message).hint("use modes of the scene or of an equilibrium"));
    }
    let (context, count) = (call.context(), modes.all().len());
    let results = |modes: &Modes| {
        let results = modes.all().iter().enumerate().map(|(number, mode)| {
            let value = Vec2::new(mode.angular_frequency(), mode.growth_rate());
            let (name, scale) = (format!("mode {number}"), value.norm());
            MeshResult { name, dimension: "1/time", value, scale }
        });
        results.collect::<Vec<_>>()
    };
    let together = Together { name: FREQUENCIES, count };
    let frequencies = |scene: Scene| {
        let goes_on = &mut || !context.is_stopped();
        let found = match about {
            ModesReference::Rest(rest) => {
                repeated(&rest.equilibrium(), scene, context)?.modes(count, goes_on)
            }
            _ => Modes::of(&System::assemble(&scene)?, count, goes_on),
        };
        context.proceed()?;
        Ok(results(&found?))
    };
    let own = results(modes);
    Ok(Dynamic::from(ErrorEstimate::on_meshes(scene, String::new(), together, own, frequencies)?))
}

/// Displacement of the station of a call in one of several shapes, whose number is the argument with the given name.
pub(super) fn displacement_in(
    call: &Call,
    argument: &str,
    shapes: &ModeShapes,
    of: &SceneHandle,
    scene: &Scene,
) -> Result<Dynamic, ScriptError> {
    let (number, count) = (call.count(argument)?, shapes.count());
    if number >= count {
        let message = format!(
            "{argument} {number} does not exist: there are {count} {argument}s, counted from 0"
        );
        return Err(call
            .error(message)
            .hint(format!("give 0 to {}", count - 1))
            .at(CallPart::Argument(0)));
    }
    let station = call.get::<StationHandle>("station")?;
    let place = station.within(of, scene, shapes.meshes())?;
    Ok(Dynamic::from(shapes.displacement(number, &place)))
}

pub(super) fn damped_modes(call: &Call, model: &System) -> Result<Dynamic, ScriptError> {
    let context = call.context();
    let found = match DampedMode::of(model, call.count("count")?, &mut || !context.is_stopped()) {
        Err(VibrationError::Interrupted) => {
            return Err(context.why_stopped("a search for damped modes"));
        }
        found => found?,
    };
    let mode_map = |mode: &DampedMode| {
        let numbers = [
            ("decay_rate", mode.decay_rate),
            ("angular_frequency", mode.angular_frequency),
            ("damping_ratio", mode.damping_ratio()),
        ];
        let map: Map = numbers.into_iter().map(|(key, value)| (key.into(), value.into())).collect();
        Dynamic::from(map)
    };
    Ok(found.iter().map(mode_map).collect::<Array>().into())
}

const fn binding(name: &'static str, returns: Returns, body: NativeFunction) -> FunctionBinding {
    property(MODES, name, body).returns(returns)
}

fn modes(call: &Call) -> Result<ModesHandle, ScriptError> {
    call.receiver()
}

fn list(call: &Call, read: fn(&Mode) -> f64) -> Result<Dynamic, ScriptError> {
    Ok(numbers_of(modes(call)?.0.modes.all(), read))
}

pub(super) fn numbers_of<T>(all: &[T], read: fn(&T) -> f64) -> Dynamic {
    all.iter().map(read).map(Dynamic::from).collect::<Array>().into()
}
