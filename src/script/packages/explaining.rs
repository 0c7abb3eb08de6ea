//! Explanations: the mechanical features that a scene uses, and the properties of a value.

use rhai::Dynamic;

use super::language;
use super::scenes::SCENE;
use super::simulations::{SIMULATION, SPINNING};
use crate::output::TextTable;
use crate::script::bindings::parameter::{object, of_any_type};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{BindingTable, function, method};
use crate::script::handles::scene::SceneHandle;
use crate::script::handles::simulation::SimulationHandle;
use crate::script::presentation::present::present;
use crate::system::{SystemFeature, Usage};

const WIDTH: usize = 100;

pub const TABLE: BindingTable = BindingTable {
    name: "looking closely",
    doc: "Descriptions of values, and of the work of the simulation of a scene.",
    types: &[],
    setup: SPINNING,
    constants: &[],
    rows: &[
        function("describe", &[of_any_type("value")], |call| {
            let shown = present(&language(), &call.value("value")?, WIDTH);
            Ok(if shown.is_empty() { "nothing".into() } else { shown.into() })
        })
        .returns(Returns::TEXT)
        .summary(
            "Returns the description of a value that the prompt shows: its main properties in a \
            few aligned lines.",
        )
        .doc("Numbers have up to ten digits; long arrays and maps are shortened.")
        .example("print(describe(rod));\ncheck(describe(0.1 + 0.2) == \"0.3\");")
        .with_related(&["explain"]),
        method(SCENE, "is_like", &[object("other", SCENE)], |call| {
            let (own, other) = (call.receiver::<SceneHandle>()?, call.get::<SceneHandle>("other")?);
            let is_like = own.scene().borrow().is_like(&other.scene().borrow());
            Ok(is_like.into())
        })
        .returns(Returns::BOOLEAN)
        .summary(
            "Returns true if another scene has the same beams, joints, masses, velocities and \
            loads, in the same order.",
        )
        .doc(
            "Names and relative differences up to 1e-9 are ignored. Functions of scripts cannot \
            be compared: a scene with a load that is a function is not like any other scene.",
        )
        .example(
            "let pair = [\"a\", \"b\"].map(|name| new_scene(name));\n\
             for one in pair { one.particle([0, 0], 1); }\ncheck(pair[0].is_like(pair[1]));\n\
             pair[1].gravity([0, -9.81]);\ncheck(!pair[0].is_like(pair[1]));",
        )
        .with_related(&["beam", "start"]),
        method(SCENE, "explain", &[], |call| {
            let parts = call.receiver::<SceneHandle>()?.scene().borrow().explain()?;
            Ok(written(&parts))
        })
        .returns(Returns::TEXT)
        .summary(
            "Returns a table of the features that a simulation of the scene uses, and of the \
            work that it can therefore omit.",
        )
        .doc(
            "Features that a scene does not use have no cost. The scene is built for this table \
            in the same way as by scene.start(…).",
        )
        .example("print(scene.explain());\ncheck(scene.explain().contains(\"plain band\"));")
        .with_related(&["start", "describe"]),
        method(SIMULATION, "explain", &[], |call| {
            Ok(written(&call.receiver::<SimulationHandle>()?.simulation().explain()))
        })
        .returns(Returns::TEXT)
        .summary("Returns the same table for a simulation, with its integrator and its steps.")
        .example("print(sim.explain());\ncheck(sim.explain().contains(\"energy_momentum\"));")
        .with_related(&["invariants"]),
    ],
};

fn written(parts: &[SystemFeature]) -> Dynamic {
    let mut table = TextTable::new(&["part", "used", "how much, or what is left out"]);
    for SystemFeature { name, usage } in parts {
        table.row(match usage {
            Usage::Used(how) => [name, "yes", how],
            Usage::Omitted(saved) => [name, "no", saved],
        });
    }
    table.to_string().trim_end().into()
}
