//! Start of a simulation from a scene, and the methods and properties of simulations.

use rhai::{Dynamic, INT};

use super::histories::HISTORY;
use super::integrators::INTEGRATOR;
use super::notes::PRINTING;
use super::recording::RECORDING;
use super::scenes::{SCENE, STATION};
use super::sliding::meant;
use super::step_sizes::STEP_CONTROL;
use super::time_travel::bytes;
use super::vectors::VECTOR;
use crate::beams::BodyPoint;
use crate::integrators::Method;
use crate::newton::Tolerance;
use crate::output::{Cell, TextTable, scientific};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Kind, NumberRange, Scripted, Type};
use crate::script::bindings::parameter::{
    Parameter, Presence, callback, choice, either, integer, name, number, object, options,
};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, FunctionBinding, method, property};
use crate::script::handles::history::HistoryHandle;
use crate::script::handles::notes::Notes;
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::{RunStart, RunTarget, SimulationHandle};
use crate::script::handles::station::StationHandle;
use crate::script::handles::step_size::step_size;
use crate::script::messages::error::ScriptError;
use crate::simulation::{
    Invariant, Recording, Simulation, SimulationError, SimulationSettings, StepControl,
};
use crate::system::Measures;

pub const TABLE: BindingTable = BindingTable {
    name: "simulations",
    doc: "A simulation advances in steps and can be read between them. All recorded steps are in \
        its history.",
    types: &[SIMULATION, INVARIANTS],
    setup: SPINNING,
    constants: &[],
    rows: &[
        method(SCENE, "start", &[options("options", START).optional()], start)
            .returns(Returns::object(SIMULATION))
            .summary("Creates a simulation of the scene at its initial state, t = 0.")
            .doc("Later changes of the scene do not affect the simulation; call start again for \
                a new one. Without `dt`, the steps adapt to a tolerance of 1e-3 of the size of \
                the scene for each step; the error of a whole run is estimated by \
                sim.error_estimate().")
            .example("let again = scene.start(#{ integrator: trapezoidal(), dt: 0.05 });\nprint(again);\n\
                      print(scene.start());")
            .with_related(&["energy_momentum", "trapezoidal", "every", "step", "run_to", "back"]),
        method(SIMULATION, "step", &[integer("count").non_negative().or(Presence::Integer(1))], |call| {
            call.receiver::<SimulationHandle>()?.advance(call, &RunTarget::Steps(call.count("count")?))?;
            Ok(Dynamic::UNIT)
        })
        .summary("Takes one step, or the given number of steps; a step is shorter where a schedule \
            requires the end of a step.")
        .example("sim.step();\nsim.step(3);\ncheck(sim.steps == 4);")
        .with_related(&["run_to"]),
        method(SIMULATION, "run_to", &[number("t").allow_non_finite().unit("time")], |call| {
            call.receiver::<SimulationHandle>()?.advance(call, &RunTarget::Time(call.number("t")?))?;
            Ok(Dynamic::UNIT)
        })
        .summary("Takes steps until a time; the last step ends exactly there.")
        .example("sim.run_to(1);\ncheck(sim.t == 1);")
        .with_related(&["step", "at"]),
        method(SIMULATION, "at", &[number("t").unit("time"), callback("function")], |call| {
            let function = call.callback("function")?;
            call.expect_arguments(&function, 1, "|sim| …, a function of the simulation")?;
            let function = call.store(function, "an event");
            call.receiver::<SimulationHandle>()?.at(call.number("t")?, function)?;
            Ok(Dynamic::UNIT)
        })
        .summary("Registers a function that is called with the simulation when a time is reached; a \
            step ends there.")
        .example("sim.at(0.25, |sim| print(`energy ${sim.energy} at t = ${sim.t}`));\nsim.run_to(0.5);"),
        property(SIMULATION, "t", |call| Ok(call.receiver::<SimulationHandle>()?.time().into()))
            .returns(Returns::NUMBER.unit("time"))
            .summary("Current time of the simulation.")
            .example("sim.run_to(0.3);\ncheck(sim.t == 0.3);"),
        measure("energy", "Sum of kinetic, strain and potential energy [energy].", |call| last(call, |m| m.energy.total()))
            .example("let turning = 1 * 2^3 / 12 + 10 * 2;\ncheck_close(sim.energy, turning / 2, 1e-12);"),
        measure("kinetic", "Kinetic energy [energy].", |call| last(call, |m| m.energy.kinetic)).example("check(sim.kinetic > 0);"),
        measure("strain", "Strain energy [energy].", |call| last(call, |m| m.energy.strain)).example("check(sim.strain == 0);"),
        measure("potential", "Potential energy of gravity, zero at the origin [energy].", |call| last(call, |m| m.energy.potential))
            .example("check(sim.potential == 0);"),
        measure("work", "Work of the loads so far [energy].", |call| last(call, |m| m.work)).example("check(sim.work == 0);"),
        measure("angular_momentum", "Angular momentum about the origin [mass·length²/time].", |call| {
            last(call, |m| m.angular_momentum)
        })
        .example("let before = sim.angular_momentum;\nsim.run_to(1);\ncheck_close(sim.angular_momentum, before, 1e-10);"),
        measure("gap", "Largest distance between the partners of a joint [length].", |call| last(call, |m| m.gap))
            .example("check(sim.gap == 0);"),
        property(SIMULATION, "momentum", |call| {
            let simulation = call.receiver::<SimulationHandle>()?;
            let momentum = measures(&simulation).momentum;
            Ok(Dynamic::from(momentum))
        })
        .returns(Returns::object(VECTOR).unit("mass·length/time"))
        .summary("Linear momentum.")
        .example("check(norm(sim.momentum) < 1e-12);"),
        property(SIMULATION, "history", |call| {
            let of = call.receiver::<SimulationHandle>()?;
            Ok(Dynamic::from(HistoryHandle { of, from: f64::NEG_INFINITY, to: f64::INFINITY }))
        })
        .returns(Returns::object(HISTORY))
        .summary("History of all recorded steps so far.")
        .example("sim.run_to(1);\ncheck(sim.history.drift(\"energy\") < 1e-12);"),
        method(SIMULATION, "invariants", &[], |call| Ok(Dynamic::from(Invariants::of(&call.receiver()?))))
            .returns(Returns::object(INVARIANTS))
            .summary("Largest errors of energy, momenta and gap so far; printed as a table.")
            .doc("The conserved values are E - W + D, p - ∫F dt and L - ∫M dt, in which the \
                contributions of loads, gravity and supports are subtracted.")
            .example("sim.run_to(1);\nprint(sim.invariants());\ncheck(sim.invariants().energy < 1e-12);")
            .with_related(&["drift"]),
        invariant("energy", |call| Ok(drift(call)?[0].into())).summary("Largest relative change of E - W + D."),
        invariant("momentum", |call| Ok(drift(call)?[1].into())).summary("Largest relative change of p - ∫F dt."),
        invariant("angular_momentum", |call| Ok(drift(call)?[2].into())).summary("Largest relative change of L - ∫M dt."),
        invariant("gap", |call| Ok(drift(call)?[3].into())).summary("Largest gap of a joint [length]."),
        method(SIMULATION, "position", &[AT], |call| {
            let (handle, place) = place(call)?;
            let position = handle.simulation().model().position(&place);
            Ok(Dynamic::from(position))
        })
        .returns(Returns::object(VECTOR).unit("length"))
        .summary("Returns the position of a station.")
        .example("check(norm(sim.position(rod.start)) < 1e-15);"),
        method(SIMULATION, "velocity", &[AT], |call| {
            let (handle, place) = place(call)?;
            let velocity = handle.simulation().model().velocity(&place);
            Ok(Dynamic::from(velocity))
        })
        .returns(Returns::object(VECTOR).unit("length/time"))
        .summary("Returns the velocity of a station.")
        .example("check_close(sim.velocity(rod.end).y, 1, 1e-12);"),
        method(SIMULATION, "angle", &[AT], angle)
            .returns(Returns::NUMBER.unit("rad"))
            .summary("Returns the angle of the section at a station, initially that of the \
                undeformed axis, counter-clockwise and not wrapped.")
            .doc("An interior station of a beam must have been created before the scene was \
                started; otherwise the angle is refused with an error.")
            .example("sim.run_to(1);\ncheck_close(sim.angle(rod.end), 1, 0.01);"),
        count("steps", |call| counted(call, |simulation| simulation.counts().steps)).summary("Number of steps taken."),
        count("newton_iterations", |call| counted(call, |simulation| simulation.counts().newton_iterations))
            .summary("Number of Newton iterations of all steps, each with a factorisation."),
        count("corrections", |call| counted(call, |simulation| simulation.counts().corrections))
            .summary("Number of corrections of all steps with existing factors: back substitutions \
                besides those of the Newton iterations."),
        count("retries", |call| counted(call, |simulation| simulation.counts().retries)).summary("Number of steps that failed and were halved."),
        count("rejected", |call| counted(call, |simulation| simulation.counts().rejected))
            .summary("Number of adaptive steps whose error exceeded the tolerance and that were \
                repeated.")
            .with_related(&["adaptive"]),
        count("unknowns", |call| counted(call, Simulation::unknowns)).summary("Number of unknowns of a step."),
        property(SIMULATION, "dt", |call| Ok(call.receiver::<SimulationHandle>()?.simulation().dt().into()))
            .returns(Returns::NUMBER.unit("time"))
            .summary("Step size of the grid; with adaptive steps the size of the next step, unless \
                it must end earlier.")
            .example("check(sim.dt == 0.1);")
            .with_related(&["adaptive"]),
        property(SIMULATION, "name", |call| Ok(call.receiver::<SimulationHandle>()?.name().into()))
            .returns(Returns::TEXT)
            .summary("Name of the simulation; default: the name of the scene.")
            .example("check(sim.name == \"example\");"),
    ],
};

pub(super) const SPINNING: &str = "let scene = new_scene(\"example\");\n\
    let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s, spin: 1 });\n\
    let sim = scene.start(#{ dt: 0.1 });";

pub const SIMULATION: Type = Type::of::<SimulationHandle>();
const INVARIANTS: Type = Type::of::<Invariants>();

const AT: Parameter = object("station", STATION);
pub(super) const START: &[Parameter] = &[
    either("dt", &[Kind::Number(NumberRange::Positive), Kind::Object(STEP_CONTROL)])
        .unit("time")
        .doc("step size, or adaptive(#{ tolerance: 1e-4 }); default: adaptive steps with the tolerance 1e-3")
        .optional(),
    object("integrator", INTEGRATOR).doc("integrator; default: energy_momentum()").optional(),
    name("name").doc("name in the report; default: the name of the scene").optional(),
    object("record", RECORDING)
        .doc("recorded steps: every(n) or nothing(); default: every step")
        .optional(),
    number("snapshots")
        .non_negative()
        .unit("MB")
        .doc(
            "memory for states to go back to; default: 256 if the script contains back or rewind or imports a file, else 0",
        )
        .optional(),
    choice("notes", &[PRINTING[0].0, PRINTING[1].0])
        .doc("notes on unresolved steps: printed when a run ends, or only kept in sim.notes")
        .or(Presence::Text("print")),
];

/// Tolerance of adaptive steps if neither step size nor tolerance is given, relative to the size of the scene.
const DEFAULT_TOLERANCE: f64 = 1e-3;

#[derive(Clone)]
struct Invariants {
    measures: Measures,
    drifts: [f64; 4],
    changes: &'static str,
}

impl Invariants {
    fn of(handle: &SimulationHandle) -> Self {
        let simulation = handle.simulation();
        let drifts = Invariant::ALL.map(|(_, invariant)| simulation.history().drift(invariant));
        let changes = match simulation.has_all_rows() {
            true => "largest change",
            false => "largest change between recorded rows",
        };
        drop(simulation);
        Self { measures: measures(handle), drifts, changes }
    }
}

impl Scripted for Invariants {
    const NAME: &'static str = "invariants";
    const DOC: &'static str = "Largest errors of energy, momenta and gap.";

    fn show(&self) -> String {
        let mut table = TextTable::new(&["invariant", "value", self.changes]);
        for ((_, invariant), drift) in Invariant::ALL.iter().zip(self.drifts) {
            let value = invariant.value(&self.measures);
            let shown = if *invariant == Invariant::Momentum { value.norm() } else { value.x };
            let cells =
                [invariant.describe().to_owned(), scientific(shown, 7), scientific(drift, 2)];
            let [name, numbers @ ..] = cells;
            table.row([Cell::Text(name)].into_iter().chain(numbers.map(Cell::Number)));
        }
        table.to_string().trim_end().to_owned()
    }
}

const fn measure(
    name: &'static str,
    summary: &'static str,
    body: crate::script::bindings::table::NativeFunction,
) -> FunctionBinding {
    property(SIMULATION, name, body).returns(Returns::NUMBER).summary(summary)
}

const fn invariant(
    name: &'static str,
    body: crate::script::bindings::table::NativeFunction,
) -> FunctionBinding {
    property(INVARIANTS, name, body)
        .returns(Returns::NUMBER)
        .example("sim.run_to(0.5);\nlet kept = sim.invariants();\ncheck(kept.energy < 1e-12 && kept.momentum < 1e-12);\ncheck(kept.angular_momentum < 1e-12 && kept.gap == 0);")
}

const fn count(
    name: &'static str,
    body: crate::script::bindings::table::NativeFunction,
) -> FunctionBinding {
    property(SIMULATION, name, body)
        .returns(Returns::INTEGER)
        .example("sim.step(2);\ncheck(sim.steps == 2 && sim.newton_iterations <= 8 && sim.retries == 0 && sim.rejected == 0 && sim.unknowns == 21);")
}

fn start(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SceneHandle>()?;
    let scene = handle.scene().borrow().clone();
    let variations = handle.variations()?;
    begin(call, handle, RunStart::Scene, |settings| match variations.is_empty() {
        true => Simulation::start_while(scene, settings, &mut || !call.context().is_stopped()),
        false => Simulation::start_with_derivatives(scene, settings, variations),
    })
}

pub(super) fn begin(
    call: &Call,
    of: SceneHandle,
    from: RunStart,
    start: impl FnOnce(SimulationSettings) -> Result<Simulation, SimulationError>,
) -> Result<Dynamic, ScriptError> {
    let options = call.options_or_defaults("options")?;
    let settings = SimulationSettings {
        method: options.get_if::<Method>("integrator").unwrap_or_default(),
        dt: match options.has("dt") {
            false => StepControl::to(DEFAULT_TOLERANCE).into(),
            true => step_size(&options.value("dt")?).ok_or_else(|| {
                ScriptError::internal_error("a step size is neither a number nor adaptive")
            })?,
        },
        tolerance: Tolerance::default(),
    };
    let started = start(settings);
    call.context().proceed()?;
    let mut simulation = started?;
    let name = options.optional_text("name")?;
    let name = name.unwrap_or_else(|| simulation.scene().name.clone());
    let limit = options.optional_number("snapshots").map(bytes);
    simulation.record(options.get_if::<Recording>("record").unwrap_or_default());
    simulation.enable_snapshots(limit.unwrap_or_else(|| call.context().snapshots()));
    let printing =
        options.optional_text("notes")?.map(|word| meant(&PRINTING, &word)).unwrap_or_default();
    let notes = Notes::new(printing);
    of.take_change();
    let started = SimulationHandle::new(simulation, of, name, notes, from, call.context());
    started.evaluate_columns()?;
    Ok(Dynamic::from(started))
}

fn measures(handle: &SimulationHandle) -> Measures {
    handle.simulation().history().samples().last().map(|row| row.measures).unwrap_or_default()
}

fn last(call: &Call, read: fn(&Measures) -> f64) -> Result<Dynamic, ScriptError> {
    Ok(read(&measures(&call.receiver()?)).into())
}

fn drift(call: &Call) -> Result<[f64; 4], ScriptError> {
    Ok(call.receiver::<Invariants>()?.drifts)
}

fn counted(call: &Call, read: fn(&Simulation) -> usize) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let count = read(&handle.simulation());
    Ok(Dynamic::from(count as INT))
}

fn place(call: &Call) -> Result<(SimulationHandle, BodyPoint), ScriptError> {
    let handle = call.receiver::<SimulationHandle>()?;
    let station = call.get::<StationHandle>("station")?;
    let place = station.place_in(&handle)?;
    Ok((handle, place))
}

fn angle(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, _) = place(call)?;
    let station = call.get::<StationHandle>("station")?;
    let simulation = handle.simulation();
    tracked_angle(call, &station, simulation.model().angle(simulation.scene(), &station.station))
}

/// Angle of the section at a station [rad], which must have been tracked from the start.
pub(super) fn tracked_angle(
    call: &Call,
    station: &StationHandle,
    angle: Option<f64>,
) -> Result<Dynamic, ScriptError> {
    if !station.station.turns() {
        let message =
            format!("{} has no angle, because a particle does not rotate", station.show());
        return Err(call.error(message).hint("read the angle at a station of a beam or a body"));
    }
    angle.map(Dynamic::from).ok_or_else(|| {
        call.error(format!(
            "the angle at {} is not available, because the station was created too late",
            station.show()
        ))
        .hint(
            "create the station with beam.at(s) before scene.start(…) or \
                scene.equilibrium(…)",
        )
    })
}
