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
    doc: "A scene is started with a step size, dt: 0.1, or with a tolerance, dt: adaptive(#{ tolerance: 1e-4 }).",
    types: &[STEP_CONTROL],
    setup: super::simulations::SPINNING,
    constants: &[],
    rows: &[function("adaptive", &[options("options", ADAPTIVE).optional()], |call| {
        let options = call.options_or_defaults("options")?;
        let bound = |name| options.number_if_given(name);
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
    .summary("Steps as long as a tolerance allows, with any integrator: dt: adaptive(#{ tolerance: 1e-4 }).")
    .doc(
        "A step is two equal ones of the integrator, compared with a single one as long as both, which is thrown away: 3 solves for 2. \
         What is accepted is a plain step of the integrator, so whatever that keeps is kept. The tolerance is the error that may gather \
         while the scene moves about as far as it is long, as a part of that length (of the longest beam) and in radians, whichever is \
         the largest; 100 times smaller, it takes 10 times as many steps of a method of order 2. Steps end at times where schedules \
         jump or bend, at the end of run_to and where sim.at says; they are small again after a jump. sim.rejected counts steps that \
         erred by too much, the column dt has the sizes.",
    )
    .example(
        "let careful = scene.start(#{ dt: adaptive(#{ tolerance: 1e-5, largest: 0.2 }) });\n\
         careful.run_to(1);\n\
         check(careful.t == 1 && careful.history.largest(\"dt\") <= 0.2);\n\
         check(careful.invariants().energy < 1e-12);\n\
         print(careful.dt);",
    )
    .see(&["start", "rejected", "fourth_order"])],
};

const ADAPTIVE: &[Parameter] = &[
    number("tolerance")
        .between(StepControl::LEAST_TOLERANCE, StepControl::MOST_TOLERANCE)
        .or(Presence::Number(1e-4))
        .doc("the error that may gather, as a part of the longest beam, or without beams of the extent of what springs and joints hold together, and in rad"),
    number("first")
        .positive()
        .unit("time")
        .doc("the first step, and the first after a jump; found from the scene unless given")
        .optional(),
    number("smallest")
        .positive()
        .unit("time")
        .doc("the run stops where shorter steps are needed; a millionth of the first unless given")
        .optional(),
    number("largest")
        .positive()
        .unit("time")
        .doc("no step is longer; a million times the first unless given")
        .optional(),
];

pub const STEP_CONTROL: Type = Type::of::<StepControl>();

impl Scripted for StepControl {
    const NAME: &'static str = "step control";
    const DOC: &'static str = "How steps of varying size are found.";

    fn show(&self) -> String {
        format!("{self} steps")
    }

    fn details(&self) -> Details {
        details::of_step_control(self)
    }
}
