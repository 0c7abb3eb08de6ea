//! Equilibrium of a scene: solution, results, and start of a simulation from it.

use rhai::{Array, Dynamic, INT};

use super::error_estimates::ERROR_ESTIMATE;
use super::modes::MODES;
use super::modes::{
    COUNT, ModesHandle, damped_modes, expect_room, undamped_modes as look_for_modes,
};
use super::scenes::{SCENE, STATION};
use super::sensors::{force_and_moment, holds_nothing};
use super::simulations::SIMULATION;
use super::simulations::{START, begin, tracked_angle};
use super::sliding::{SliderHandle, WHICH};
use super::vectors::VECTOR;
use crate::beams::{BodyPoint, Station};
use crate::output::significant;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, integer, number, object, options};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{
    BindingTable, FunctionBinding, NativeFunction, function, method, property,
};
use crate::script::handles::captured_variables::{expect_no_side_effects, functions_of_time};
use crate::script::handles::equilibrium::EquilibriumHandle;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::RunStart;
use crate::script::handles::station::StationHandle;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::script::state::settings::RunMode;
use crate::script::studies::error_estimate::{ErrorEstimate, POSITIONS};
use crate::script::studies::error_on_meshes::{MeshResult, Together};
use crate::script::studies::plan::stations_and_middles;
use crate::simulation::Simulation;
use crate::statics::{ArcLength, Control, Equilibrium, Loading, Stability, StaticsError};
use crate::system::{Scene, System};

pub const TABLE: BindingTable = BindingTable {
    name: "equilibrium",
    doc: "Static equilibrium of a scene under its loads. All loads are increased together from \
        zero to their full value in load steps, independent of time. Follower loads rotate \
        with the beam. The elements are those of simulations.",
    types: &[EQUILIBRIUM, CONTROL],
    setup: BENT,
    constants: &[],
    rows: &[
        method(SCENE, "equilibrium", &[options("options", LOADING).optional()], find)
            .returns(Returns::object(EQUILIBRIUM))
            .summary("Finds the static equilibrium of the scene under its loads and gravity.")
            .doc(
                "At least one load must act. Sliders are in equilibrium without friction along \
                the beam, or in contact with an end stop. Parts held only by their loads, such \
                as a pendulum, a chain or a bead in a sag, move to the equilibrium as in a \
                viscous medium. A load step without a solution is halved, up to eight times. \
                For snap-through, or a path with decreasing load, use control: arc_length().",
            )
            .example(
                "let rest = scene.equilibrium(#{ load_steps: 4 });\n\
                 check_close(rest.angle(rod.end), 3.14159265358979 / 2, 1e-9);",
            )
            .with_related(&["load_control", "arc_length", "modes", "start", "plot_equilibrium"]),
        function("load_control", &[], |_| Ok(Dynamic::from(Control::Load)))
            .returns(Returns::object(CONTROL))
            .summary("Selects load control: the load increases by equal parts in each step.")
            .example("let rest = scene.equilibrium(#{ load_steps: 4, control: load_control() });\ncheck(rest.load_factors == [0, 0.25, 0.5, 0.75, 1]);")
            .with_related(&["arc_length", "equilibrium"]),
        function("arc_length", &[options("options", ARC_LENGTH).optional()], |call| {
            let options = call.options_or_defaults("options")?;
            let arc = ArcLength { longest: options.number("longest")?, points: options.count("points")? };
            Ok(Dynamic::from(Control::ArcLength(arc)))
        })
        .returns(Returns::object(CONTROL))
        .summary("Selects arc-length control: each step prescribes the displacement of the scene; \
            the load is computed and can decrease.")
        .doc(
            "The path of equilibria is followed through its limit points, until the full load \
            is reached for the first time. The first step applies 1/load_steps of the load. \
            Riks, Int. J. Solids Struct. 15 (1979) 529-551.",
        )
        .example(
            "let rest = scene.equilibrium(#{ load_steps: 4, control: arc_length(#{ longest: 0.1 }) });\n\
             check(rest.load_factor == 1 && rest.limit_points.len() == 0);",
        )
        .with_related(&["load_control", "equilibrium", "limit_points"]),
        method(EQUILIBRIUM, "position", &[AT], |call| {
            let (rest, place) = place(call)?;
            let position = rest.equilibrium().model().position(&place);
            Ok(Dynamic::from(position))
        })
        .returns(Returns::object(VECTOR).unit("length"))
        .summary("Returns the equilibrium position of a station.")
        .example("let rest = scene.equilibrium();\ncheck(rest.position(rod.end).y > 1);")
        .with_related(&["positions", "angle"]),
        method(EQUILIBRIUM, "positions", &[AT], |call| {
            let (rest, place) = place(call)?;
            let positions = rest.equilibrium().along_path(|model| model.position(&place))?;
            Ok(positions.into_iter().map(Dynamic::from).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Object(VECTOR)).unit("length"))
        .summary("Returns the positions of a station at all points of the path, beginning with the \
            unloaded scene.")
        .example("let rest = scene.equilibrium(#{ load_steps: 4 });\ncheck(rest.positions(rod.end).len() == 5);")
        .with_related(&["load_factors", "plot_load_path"]),
        method(EQUILIBRIUM, "angle", &[AT], angle)
            .returns(Returns::NUMBER.unit("rad"))
            .summary("Returns the angle of the section at a station, counter-clockwise and not \
                wrapped.")
            .doc("An interior station of a beam must have been created before the equilibrium \
                was found; otherwise the angle is refused with an error.")
            .example("let rest = scene.equilibrium();\ncheck_close(rest.angle(rod.start), 0, 1e-12);"),
        method(EQUILIBRIUM, "reaction", &[AT], reaction)
            .returns(Returns::MAP)
            .summary("Returns the reaction of the support at a station.")
            .doc("The map has force, a vector, and moment. Only reactions of the ground are \
                returned, not the forces of joints between beams.")
            .example("let rest = scene.equilibrium();\ncheck_close(rest.reaction(rod.start).moment, -s.EI * 3.14159265358979 / 4, 1e-6);"),
        method(EQUILIBRIUM, "slider_position", &[WHICH], |call| {
            slider_value(call, |model, slider| model.slider_position(slider).into())
        })
        .returns(Returns::NUMBER)
        .summary("Returns the equilibrium position of a slider on its beam or track, by undeformed \
            length: 0 at the start, 1 at the end.")
        .example(SLID)
        .with_related(&["slider_arc_length", "contact_force", "leans_on"]),
        method(EQUILIBRIUM, "slider_arc_length", &[WHICH], |call| {
            slider_value(call, |model, slider| model.slider_arc_length(slider).into())
        })
        .returns(Returns::NUMBER.unit("length"))
        .summary("Returns the undeformed arc length from the start of the beam or track to the \
            slider.")
        .example(SLID)
        .with_related(&["slider_position"]),
        method(EQUILIBRIUM, "contact_force", &[WHICH], |call| {
            slider_value(call, |model, slider| Dynamic::from(model.contact_force(slider)))
        })
        .returns(Returns::object(VECTOR).unit("force"))
        .summary("Returns the contact force of a slider on its beam in equilibrium; the force on its \
            station is the opposite.")
        .example(SLID)
        .with_related(&["slider_position"]),
        method(EQUILIBRIUM, "leans_on", &[WHICH], |call| {
            slider_value(call, |model, slider| model.slider_held_by(slider).unwrap_or_default().into())
        })
        .returns(Returns::TEXT.with_remark(", empty if the slider is not in contact with an end stop"))
        .summary("Returns the end of the beam or track whose stop a slider is in contact with, \
            \"start\" or \"end\", or a \"seam\" of its track.")
        .doc("A stop only pushes. Sliders with ends: \"stop\" and ends: \"bounce\" can be in \
            contact with it; one with ends: \"release\" leaves the beam there and has no \
            equilibrium. In modes about the equilibrium a slider in contact with a stop is \
            fixed.")
        .example(SLID)
        .with_related(&["slider_position"]),
        method(EQUILIBRIUM, "error_estimate", &[], |call| {
            let handle = call.receiver::<EquilibriumHandle>()?;
            Ok(Dynamic::from(estimated_error(&handle.equilibrium(), call.context())?))
        })
        .returns(Returns::object(ERROR_ESTIMATE))
        .summary("Estimates the errors of positions and strain energy due to the mesh.")
        .doc("The equilibrium is found again with three quarters and half of the spans. Verdicts \
            are those of sim.error_estimate().")
        .example("let rest = scene.equilibrium();\nprint(rest.error_estimate().summary);\n\
            check(rest.error_estimate().of(\"positions\").present < 0.01);"),
        method(EQUILIBRIUM, "modes", &[COUNT], |call| {
            let handle = call.receiver::<EquilibriumHandle>()?;
            expect_room(call, handle.equilibrium().model())?;
            let modes = look_for_modes(call, |count, goes_on| {
                handle.equilibrium_mut().modes(count, goes_on)
            })?;
            Ok(Dynamic::from(ModesHandle::at_rest(&handle, modes)))
        })
        .returns(Returns::object(MODES))
        .summary("Computes the lowest natural frequencies and mode shapes about the equilibrium.")
        .doc("An unstable equilibrium has growing modes; see growth_rates. Refused with an error \
            if a follower load acts.")
        .example("let rest = scene.equilibrium();\ncheck(rest.modes(2).is_stable);")
        .with_related(&["modes", "plot_modes"]),
        method(EQUILIBRIUM, "damped_modes", &[COUNT], |call| {
            let handle = call.receiver::<EquilibriumHandle>()?;
            damped_modes(call, handle.equilibrium().model())
        })
        .returns(Returns::ARRAY)
        .summary("Computes the lowest damped vibrations about the equilibrium: maps of decay_rate, \
            angular_frequency and damping_ratio.")
        .doc("See scene.damped_modes for accuracy and restrictions.")
        .example("let rest = scene.equilibrium();\ncheck_close(rest.damped_modes(1)[0].angular_frequency, rest.modes(1).angular_frequencies[0], 1e-6);")
        .with_related(&["modes"]),
        method(EQUILIBRIUM, "start", &[options("options", START).optional()], |call| {
            let handle = call.receiver::<EquilibriumHandle>()?;
            let from = RunStart::Equilibrium(handle.clone());
            begin(call, handle.scene().clone(), from, |settings| {
                Simulation::start_at_rest(&handle.equilibrium(), settings)
            })
        })
        .returns(Returns::object(SIMULATION))
        .summary("Starts a simulation from the equilibrium, at rest at t = 0.")
        .doc(
            "Loads follow their schedules from t = 0: a load with hold_for(1) ends at t = 1. \
            The options are those of scene.start. The full loads act, whatever load_factor and \
            time the equilibrium had. If a drive has moved the scene, simulation and loads \
            start at the time of the equilibrium instead: at t = 1 after scene.equilibrium(#{ \
            time: 1 }). With drives that are at rest by then, the scene stays at rest.",
        )
        .example(
            "let rest = scene.equilibrium();\nlet sim = rest.start(#{ dt: 0.01 });\nsim.run_to(0.1);\n\
             check(norm(sim.position(rod.end) - rest.position(rod.end)) < 1e-9);",
        )
        .with_related(&["hold_for"]),
        binding("is_stable", Returns::BOOLEAN, is_stable)
        .summary("True if the equilibrium is stable: every small disturbance increases the potential \
            energy.")
        .example("check(scene.equilibrium().is_stable);")
        .with_related(&["modes", "limit_points"]),
        binding("load_factor", Returns::NUMBER.unit("-"), |call| read(call, |of| of.path().load_factor().into()))
            .summary("Fraction of the loads that acts: the requested one, unless the path ended \
                earlier.")
            .example("check(scene.equilibrium().load_factor == 1);"),
        binding("load_factors", Returns::NUMBERS.unit("-"), |call| read(call, |of| {
            of.path().points().iter().map(|point| point.load_factor.into()).collect::<Array>().into()
        }))
        .summary("Load factors at all points of the path, beginning with 0.")
        .example("check(scene.equilibrium(#{ load_steps: 2 }).load_factors == [0, 0.5, 1]);"),
        binding("limit_points", Returns::NUMBERS.unit("-"), |call| read(call, |of| {
            of.path().limit_points().into_iter().map(Dynamic::from).collect::<Array>().into()
        }))
        .summary("Load factors at the limit points of the path, where the structure would snap \
            through.")
        .example("check(scene.equilibrium().limit_points.len() == 0);")
        .with_related(&["arc_length"]),
        binding("strain", Returns::NUMBER.unit("energy"), |call| read(call, |of| {
            of.path().points().last().map_or(0.0, |point| point.strain_energy).into()
        }))
        .summary("Strain energy of the equilibrium.")
        .example("check_close(scene.equilibrium().strain, (s.EI * 3.14159265358979 / 4)^2 * rod.length / s.EI / 2, 1e-6);"),
        binding("iterations", Returns::INTEGER, |call| read(call, |of| {
            let taken = of.path().points().iter().map(|point| point.iterations).sum::<usize>();
            Dynamic::from(taken as INT)
        }))
        .summary("Number of Newton iterations of all load steps.")
        .example("check(scene.equilibrium(#{ load_steps: 4 }).iterations <= 16);"),
    ],
};

pub(super) const BENT: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });\n\
    scene.clamp(rod.start);\n\
    scene.moment(rod.end, s.EI * 3.14159265358979 / 4);";

const SLID: &str = "let scene = new_scene(\"sag\");\n\
    let s = section(#{ EA: 1e6, GA: 1e6, EI: 100, rho_A: 0.1, rho_I: 1e-3 });\n\
    let wire = scene.beam(#{ axis: line([0, 0], [4, 0]), basis: bspline(8), section: s });\n\
    scene.hinge(wire.start);\nscene.hinge(wire.end);\n\
    let bead = scene.particle([1, 0], 2);\n\
    let ring = scene.slider(bead, wire);\n\
    scene.gravity([0, -9.81]);\n\
    let rest = scene.equilibrium();\n\
    check_close(rest.slider_position(ring), 0.5, 1e-9);\n\
    check_close(rest.slider_arc_length(ring), 2, 1e-9);\n\
    check_close(rest.contact_force(ring).y, -2 * 9.81, 1e-9);\n\
    check(rest.leans_on(ring) == \"\" && rest.is_stable);";

pub const EQUILIBRIUM: Type = Type::of::<EquilibriumHandle>();
const CONTROL: Type = Type::of::<Control>();

const AT: Parameter = object("station", STATION);
const LOADING: &[Parameter] = &[
    integer("load_steps").between(1.0, 100_000.0).or(Presence::Integer(10)).doc(
        "number of load steps; with arc_length() the first step applies 1/load_steps of the \
            load",
    ),
    object("control", CONTROL)
        .doc("load_control() or arc_length(); default: load_control()")
        .optional(),
    number("load_factor").or(Presence::Number(1.0)).doc("fraction of the loads at the end"),
    number("time")
        .unit("time")
        .or(Presence::Number(0.0))
        .doc("time at which schedules are evaluated, just after it"),
];
const ARC_LENGTH: &[Parameter] = &[
    number("longest").positive().or(Presence::Number(0.05)).doc(
        "largest step: root mean square of displacements divided by the length of the longest \
        beam, and of rotations in rad",
    ),
    integer("points")
        .between(3.0, 100_000.0)
        .or(Presence::Integer(1000))
        .doc("largest number of points of the path, which ends there"),
];

impl Scripted for Control {
    const NAME: &'static str = "load control";
    const DOC: &'static str = "Quantity that is prescribed in the steps of an equilibrium path.";

    fn show(&self) -> String {
        match self {
            Self::Load => "load control".into(),
            Self::ArcLength(ArcLength { longest, points }) => {
                format!("arc-length control, steps of at most {longest}, {points} points")
            }
        }
    }
}

const fn binding(name: &'static str, returns: Returns, body: NativeFunction) -> FunctionBinding {
    property(EQUILIBRIUM, name, body).returns(returns)
}

fn read(call: &Call, read: fn(&Equilibrium) -> Dynamic) -> Result<Dynamic, ScriptError> {
    Ok(read(&call.receiver::<EquilibriumHandle>()?.equilibrium()))
}

fn find(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let scene = call.receiver::<SceneHandle>()?;
    let options = call.options_or_defaults("options")?;
    let loading = Loading {
        time: options.number("time")?,
        factor: options.number("load_factor")?,
        steps: options.count("load_steps")?,
        control: options.get_if::<Control>("control").unwrap_or_default(),
        ..Loading::default()
    };
    let description = scene.scene().borrow().clone();
    let context = call.context();
    let found = match context.mode() {
        RunMode::DryRun => Equilibrium::dry_run(description, loading),
        RunMode::Run => {
            let name = description.name.clone();
            context.progress().begin(&name, 0.0, loading.factor);
            let mut last = None;
            let found = Equilibrium::find(description, loading, &mut |reached| {
                if last.replace(reached) != Some(reached) {
                    context.progress().report_time(reached);
                    context.meter().count_step();
                }
                context.meter().allows_a_step() && !context.is_stopped()
            });
            context.progress().end();
            found
        }
    };
    let rest = match found {
        Err(StaticsError::Interrupted { .. }) => {
            return Err(context.why_stopped("the search for an equilibrium"));
        }
        found => found?,
    };
    print_notes(context, &rest, loading.factor);
    Ok(Dynamic::from(EquilibriumHandle::new(scene, rest)))
}

/// Largest difference of positions on the meshes of an error estimate [size of the scene].
/// Larger differences indicate different equilibria.
const LARGEST_DIFFERENCE: f64 = 0.1;

fn estimated_error(rest: &Equilibrium, context: &Context) -> Result<ErrorEstimate, ScriptError> {
    let moment = format!(" at load factor {}", significant(rest.path().load_factor(), 6));
    let stations = stations_and_middles(rest.scene());
    let results = |rest: &Equilibrium| {
        let position = |(name, station): &(String, Station)| {
            let place = rest.scene().place(station, rest.model().meshes())?;
            let value = rest.model().position(&place);
            Ok(MeshResult { name: name.clone(), dimension: "length", value, scale: 0.0 })
        };
        let positions = stations.iter().map(position);
        let strain = rest.path().points().last().map_or(0.0, |point| point.strain_energy);
        let strain = MeshResult::scalar("strain".to_owned(), "energy", strain);
        positions.chain([Ok(strain)]).collect::<Result<Vec<MeshResult>, ScriptError>>()
    };
    let positions = Together { name: POSITIONS, count: stations.len() };
    let (own, size) = (results(rest)?, rest.scene().size().unwrap_or(1.0));
    let distance = |(found, own): &(&MeshResult, &MeshResult)| (found.value - own.value).norm();
    ErrorEstimate::on_meshes(rest.scene(), moment, positions, own.clone(), |scene| {
        let found = results(&repeated(rest, scene, context)?)?;
        let mut positions = found.iter().zip(&own).take(stations.len());
        match positions.find(|pair| distance(pair) > LARGEST_DIFFERENCE * size) {
            None => Ok(found),
            Some(pair) => Err(ScriptError::new(format!(
                "{} is at a distance of {} from its position on the mesh of the scene: a mesh is too coarse, or this is another equilibrium",
                pair.1.name,
                significant(distance(&pair), 3)
            ))),
        }
    })
}

/// Finds an equilibrium again for its scene with another mesh.
pub(super) fn repeated(
    rest: &Equilibrium,
    scene: Scene,
    context: &Context,
) -> Result<Equilibrium, ScriptError> {
    let found = match context.mode() {
        RunMode::DryRun => Equilibrium::dry_run(scene, *rest.loading()),
        RunMode::Run => expect_no_side_effects(&functions_of_time(rest.scene()), || {
            let found = Equilibrium::find(scene, *rest.loading(), &mut |_| !context.is_stopped());
            context.proceed()?;
            Ok(found)
        })?,
    };
    let found = found?;
    let [own, other] = [rest, &found].map(|rest| rest.path().load_factor());
    match own == other {
        true => Ok(found),
        false => Err(ScriptError::new(format!(
            "the path ends at load factor {}, not {}",
            significant(other, 6),
            significant(own, 6)
        ))),
    }
}

fn print_notes(context: &Context, rest: &Equilibrium, load_factor: f64) {
    let is_unstable = || rest.stability(&mut || !context.is_stopped()) == Stability::Unstable;
    if context.mode() == RunMode::Run && is_unstable() {
        let name = &rest.scene().name;
        context.print_message(&format!("note: the equilibrium of '{name}' is not stable"));
    }
    let sliders = rest.scene().sliders_with_friction();
    if let Some(object) = sliders.chain(rest.scene().elements_with_friction()).next() {
        let scene = &rest.scene().name;
        context.print_message(&format!(
            "note: the equilibrium of '{scene}' does not include the friction of {object}"
        ));
    }
    if let Some(slider) = rest.scene().slider_with_side() {
        let (scene, slider) = (&rest.scene().name, &slider.name);
        context.print_message(&format!(
            "note: in the equilibrium of '{scene}', slider '{slider}' does not leave its beam or land on it"
        ));
    }
    let path = rest.path();
    if path.load_factor() != load_factor {
        let (points, factor) = (path.points().len(), significant(path.load_factor(), 6));
        let name = &rest.scene().name;
        context.print_message(&format!(
            "note: the path of '{name}' ends after {points} points, at load factor {factor}"
        ));
    }
}

fn is_stable(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<EquilibriumHandle>()?;
    let context = call.context();
    let stability = handle.equilibrium_mut().stability(&mut || !context.is_stopped());
    let unknown = |why: &str| {
        let hint = "simulate it with a disturbance: rest.start(#{ dt: … })";
        Err(call.error(format!("the stability of the equilibrium is unknown: {why}")).hint(hint))
    };
    match stability {
        Stability::Stable => Ok(true.into()),
        Stability::Unstable => Ok(false.into()),
        Stability::BelowRounding => {
            unknown("the stiffnesses differ so much that rounding errors hide it")
        }
        Stability::Follower => unknown("a follower load acts, which has no potential"),
    }
}

fn slider_value(
    call: &Call,
    ask: impl FnOnce(&System, usize) -> Dynamic,
) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<EquilibriumHandle>()?;
    let rest = handle.equilibrium();
    let slider = call.get::<SliderHandle>("slider")?.among(handle.scene(), rest.scene())?;
    Ok(ask(rest.model(), slider))
}

fn place(call: &Call) -> Result<(EquilibriumHandle, BodyPoint), ScriptError> {
    let handle = call.receiver::<EquilibriumHandle>()?;
    let place = handle.place(&call.get::<StationHandle>("station")?)?;
    Ok((handle, place))
}

fn angle(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, _) = place(call)?;
    let station = call.get::<StationHandle>("station")?;
    let rest = handle.equilibrium();
    tracked_angle(call, &station, rest.model().angle(rest.scene(), &station.station))
}

fn reaction(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, place) = place(call)?;
    let reaction = handle.equilibrium_mut().reaction(&place);
    let station = call.get::<StationHandle>("station")?;
    reaction.map(force_and_moment).ok_or_else(|| holds_nothing(call, &station))
}
