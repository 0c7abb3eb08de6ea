//! Convergence studies.

use std::rc::Rc;

use rhai::{Array, Dynamic};

use super::integrators::INTEGRATOR;
use crate::analysis::{Convergence, Refinement};
use crate::integrators::Method;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Details, Scripted, Type};
use crate::script::bindings::parameter::{Parameter, object, options, text};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{BindingTable, function, method, property};
use crate::script::messages::error::ScriptError;
use crate::script::studies::convergence::{expect_quantity, find, map_of, study};
use crate::script::studies::convergence_chart::chart;
use crate::script::studies::convergence_table::table;
use crate::script::studies::options::ErrorOptions;

pub const TABLE: BindingTable = BindingTable {
    name: "convergence",
    doc: "Errors and orders of convergence of every quantity under refinement of the step size \
        or the mesh.",
    types: &[CONVERGENCE],
    setup: SETUP_OF_LADDERS,
    constants: &[],
    rows: &[
        function("study_convergence", &[options("options", ErrorOptions::KEYS)], |call| {
            let study = study(call, &ErrorOptions::of(&call.options("options")?)?)?;
            Ok(Dynamic::from(ConvergenceStudy(Rc::new(study))))
        })
        .returns(Returns::object(CONVERGENCE))
        .summary(
            "Runs a scene with several step sizes on one mesh, or on several meshes with one \
            step size, and computes errors and orders.",
        )
        .doc(
            "scene, stations, reference and columns are those of study_work_precision. The \
            quantities are the columns of the reference table; with a fine run (default) the \
            positions and angles of the stations and all physical columns of the history. \
            Several meshes need a reference on a different mesh: finest_run(#{ mesh: … }) or a \
            table. Orders are computed only from errors above the error of the reference. The \
            size of a mesh is 1 over the number of spans of all beams. Errors of all positions \
            together and orders of the other quantities are printed; NAME.csv has everything, \
            NAME.svg shows the errors of the positions.",
        )
        .example("check_close(ladder.order(\"positions\", energy_momentum()), 2, 0.1);")
        .with_related(&["study_work_precision", "finest_run", "order"]),
        property(CONVERGENCE, "table", |call| {
            Ok(table(&call.receiver::<ConvergenceStudy>()?.0).into())
        })
        .returns(Returns::TEXT)
        .summary(
            "Table of errors and observed orders of every quantity, with the order over all \
                sizes, by least squares, in the last row.",
        )
        .example("print(ladder.table);"),
        property(CONVERGENCE, "rows", |call| {
            let ConvergenceStudy(study) = call.receiver()?;
            Ok(study.ladders.iter().map(|of| map_of(&study, of).into()).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Map))
        .summary(
            "Array with a map for every integrator and quantity: sizes, errors, orders, order \
            and claimed.",
        )
        .example(
            "for row in ladder.rows { check(row.errors.len() == 3 && row.orders.len() == 2); }",
        ),
        property(CONVERGENCE, "reference", |call| {
            Ok(call.receiver::<ConvergenceStudy>()?.0.reference.source.clone().into())
        })
        .returns(Returns::TEXT)
        .summary("Description of the reference of the errors.")
        .example("check(ladder.reference.contains(\"own finest run\"));"),
        method(CONVERGENCE, "order", &[QUANTITY, object("integrator", INTEGRATOR)], order)
            .returns(Returns::NUMBER)
            .summary(
                "Returns the order of a quantity with an integrator, by least squares over all \
                sizes; NaN if it cannot be determined.",
            )
            .example("check_close(ladder.order(\"positions\", fourth_order()), 4, 0.1);")
            .with_related(&["study_convergence"]),
        method(
            CONVERGENCE,
            "plot",
            &[QUANTITY, text("file").doc("file name in the output folder, .svg or .png")],
            plot,
        )
        .summary(
            "Plots the errors of a quantity over the sizes, with lines of the theoretical \
                orders.",
        )
        .example("ladder.plot(\"kinetic\", \"kinetic.svg\");"),
    ],
};

const SETUP_OF_LADDERS: &str = "let s = section(#{ EA: 100, GA: 100, EI: 10, rho_A: 1, rho_I: 1 });\n\
    let spinning = |mesh| {\n    let scene = new_scene(\"spinning\");\n    \
    scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: mesh, section: s, spin: 1 });\n    scene\n};\n\
    let ladder = study_convergence(#{ name: \"ladder\", scene: spinning, meshes: [bspline(2)], \
    integrators: [energy_momentum(), fourth_order()], dts: [0.005, 0.0025, 0.00125], times: [0.5] });";

const CONVERGENCE: Type = Type::of::<ConvergenceStudy>();
const QUANTITY: Parameter =
    text("quantity").doc("\"positions\" for all positions together, or a quantity of the table");

#[derive(Clone)]
struct ConvergenceStudy(Rc<Convergence>);

impl Scripted for ConvergenceStudy {
    const NAME: &'static str = "convergence study";
    const DOC: &'static str = "Errors over step sizes or meshes, and their orders.";

    fn show(&self) -> String {
        let Convergence { name, fixed, .. } = &*self.0;
        let quantities = self.0.quantities().len();
        format!("study '{name}': convergence of {quantities} quantities, {fixed}")
    }

    fn details(&self) -> Details {
        vec![("reference".to_owned(), self.0.reference.source.clone())]
    }
}

fn order(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let ConvergenceStudy(study) = call.receiver()?;
    let (quantity, method) = (call.text("quantity")?, call.get::<Method>("integrator")?);
    let order = find(call, &study, &quantity, &method)?.and_then(Refinement::fitted_order);
    Ok(order.unwrap_or(f64::NAN).into())
}

fn plot(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let ConvergenceStudy(study) = call.receiver()?;
    let quantity = call.text("quantity")?;
    expect_quantity(call, &study, &quantity)?;
    super::pictures::files::write_picture(call, &chart(&study, &quantity))
}
