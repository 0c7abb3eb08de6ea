//! Adaptive step sizes.

use rhai::Dynamic;

use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, number, options};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::presentation::details;
use crate::simulation::{StepControl, StepSize};

pub const TABLE: BindingTable = BindingTable {
    name: "step sizes",
    doc: "Fixed and adaptive step sizes. A scene is started with a step size, dt: 0.1, or with a \
        tolerance, dt: adaptive(#{ tolerance: 1e-4 }).",
    types: &[STEP_CONTROL],
    setup: super::simulations::SPINNING,
    constants: &[],
    rows: &[function("adaptive", &[options("options", ADAPTIVE).optional()], |call| {
        let options = call.options_or_defaults("options")?;
        let bound = |name| options.optional_number(name);
        let control = StepControl {
            tolerance: options.number("tolerance")?,
            first: bound("first"),
            smallest: bound("smallest"),
            largest: bound("largest"),
        };
        let checked = StepSize::from(control).check();
        checked.map_err(|error| ScriptError::from(error).at(CallPart::Argument(0)))?;
        Ok(Dynamic::from(control))
    })
    .returns(Returns::object(STEP_CONTROL))
    .summary(
        "Selects adaptive steps with an error tolerance, for any integrator: dt: adaptive(#{ \
        tolerance: 1e-4 }).",
    )
    .doc(
        "Two equal steps of the integrator are compared with a single step of the same total \
        length, which is discarded: 3 solves for 2 steps. Accepted steps keep what the \
        integrator keeps. The tolerance is the error accumulated while the scene moves by \
        about its own length, as a fraction of the length of the longest beam and in rad, \
        whichever is larger. A tolerance 100 times smaller needs 10 times as many steps with a \
        method of order 2. Steps end where schedules jump or have kinks, at the end of run_to \
        and at the times of sim.at; after a jump the steps are small again. Functions of time \
        of loads are sampled densely in long steps, so that short pulses are resolved. \
        sim.rejected counts rejected steps; the column dt has the step sizes.",
    )
    .example(
        "let careful = scene.start(#{ dt: adaptive(#{ tolerance: 1e-5, largest: 0.2 }) });\n\
         careful.run_to(1);\n\
         check(careful.t == 1 && careful.history.largest(\"dt\") <= 0.2);\n\
         check(careful.invariants().energy < 1e-12);\n\
         print(careful.dt);",
    )
    .with_related(&["start", "rejected", "fourth_order"])],
};

const ADAPTIVE: &[Parameter] = &[
    number("tolerance")
        .between(StepControl::LEAST_TOLERANCE, StepControl::MOST_TOLERANCE)
        .or(Presence::Number(1e-4))
        .doc(
            "accumulated error as a fraction of the length of the longest beam, and in rad; \
            without beams, of the extent of the parts connected by springs and joints",
        ),
    number("first")
        .positive()
        .unit("time")
        .doc("first step, also after a jump; default: computed from the scene")
        .optional(),
    number("smallest")
        .positive()
        .unit("time")
        .doc(
            "smallest step; the run stops with an error where a smaller one is needed; default: \
            1e-6 of the first step",
        )
        .optional(),
    number("largest")
        .positive()
        .unit("time")
        .doc("largest step; default: 1e6 times the first step")
        .optional(),
];

pub const STEP_CONTROL: Type = Type::of::<StepControl>();

impl Scripted for StepControl {
    const NAME: &'static str = "step control";
    const DOC: &'static str = "Selection of the step sizes of a simulation.";

    fn show(&self) -> String {
        format!("{self} steps")
    }

    fn details(&self) -> Details {
        details::of_step_control(self)
    }
}
