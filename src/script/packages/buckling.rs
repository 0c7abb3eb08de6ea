//! Linear buckling: critical load factors and shapes.

use std::rc::Rc;

use rhai::{Dynamic, INT};

use super::error_estimates::ERROR_ESTIMATE;
use super::modes::{assemble, displacement_in, expect_room, numbers_of};
use super::scenes::{SCENE, STATION};
use super::vectors::VECTOR;
use crate::output::{Cell, TextTable, significant};
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::parameter::{Parameter, Presence, integer, number, object, options};
use crate::script::bindings::returns::Returns;
use crate::script::bindings::table::{
    BindingTable, FunctionBinding, NativeFunction, method, property,
};
use crate::script::handles::captured_variables::{expect_no_side_effects, functions_of_time};
use crate::script::handles::scene::SceneHandle;
use crate::script::messages::error::ScriptError;
use crate::script::state::context::Context;
use crate::script::studies::error_estimate::{CRITICAL_LOADS, ErrorEstimate};
use crate::script::studies::error_on_meshes::{MeshResult, Together};
use crate::statics::{Buckling, BucklingError, Loading, StaticsError};
use crate::system::Scene;
use crate::vibration::{CriticalLoad, VibrationError};

pub const TABLE: BindingTable = BindingTable {
    name: "buckling",
    doc: "Critical load factors and buckling shapes of a scene by linear buckling, in ascending \
        order of the factors. An example is Euler's load of a column.",
    types: &[BUCKLING],
    setup: COLUMN,
    constants: &[],
    rows: &[
        method(SCENE, "buckling", &[COUNT, options("options", LOADING).optional()], find)
            .returns(Returns::object(BUCKLING))
            .summary("Computes the smallest critical load factors and buckling shapes (linear \
                stability, eigenvalue buckling).")
            .doc(
                "At a critical factor λ the stiffness K + λ K_g of the undeformed scene is \
                singular; K_g is the geometric stiffness of the section forces that the loads \
                and gravity cause to first order. Loads and gravity are multiplied by λ; \
                prestress is not. Only positive λ are found; load_factor: -1 reverses the \
                loads. Critical loads with a strain above 0.5 are omitted. Displacements before \
                buckling are neglected, and a note reports those above 3 % of the size of the \
                scene. The factors of shallow arches, whose displacements are of the order of \
                their rise, are too high without a note: use \
                scene.equilibrium(#{ control: arc_length() }). Parts \
                that move freely without loads, follower loads, contacts, sleeves and \
                prescribed motions are refused with an error. The stiffness of a spring is its \
                stiffness in the configuration without loads. A spring with acts: \"pull\" that is \
                exactly taut counts as acting in both directions, so that the factor of a guyed \
                mast is too high: give the guys a prestress, a length below their distance. An \
                actuator has its length at the option `time`.",
            )
            .example(
                "let b = scene.buckling(3);\nprint(b);\n\
                 check_close(b.factors[0], 3.14159265358979^2 * s.EI / 4 / 4^2, 1e-3, \"Euler's load of a cantilever\");",
            )
            .with_related(&["plot_buckling", "equilibrium", "is_stable", "modes"]),
        binding("factors", Returns::NUMBERS.unit("-"), |call| list(call, |load| load.factor))
            .summary("Critical load factors: multiples of the loads at which the scene buckles.")
            .example("let b = scene.buckling(2);\ncheck_close(b.factors[1] / b.factors[0], 9, 1e-2);")
            .with_related(&["buckling"]),
        binding("residuals", Returns::NUMBERS.unit("-"), |call| list(call, |load| load.residual))
            .summary("Residual of each critical load: its square is about the relative error of the \
                factor.")
            .doc("The discretisation error is not included: see error_estimate.")
            .example("check(scene.buckling(2).residuals.all(|residual| residual < 1e-6));"),
        binding("count", Returns::INTEGER, |call| {
            Ok(Dynamic::from(buckling(call)?.0.buckling.critical().len() as INT))
        })
        .summary("Number of critical loads.")
        .example("check(scene.buckling(4).count == 4);"),
        binding("displacement_before", Returns::NUMBER.unit("-"), |call| {
            Ok(buckling(call)?.0.buckling.displacement_before().into())
        })
        .summary("Largest displacement before buckling at the lowest factor, linear in the loads, \
            relative to the size of the scene.")
        .doc("The analysis neglects these displacements. If they are not small, compare with \
            scene.equilibrium() near the critical load.")
        .example("check(scene.buckling(1).displacement_before < 1e-3);")
        .with_related(&["equilibrium"]),
        method(BUCKLING, "displacement", &[integer("shape").non_negative(), object("station", STATION)], |call| {
            let handle = buckling(call)?;
            displacement_in(call, "shape", handle.0.buckling.shapes(), &handle.0.of, handle.0.buckling.scene())
        })
        .returns(Returns::object(VECTOR).unit("-"))
        .summary("Returns the displacement of a station in a buckling shape (the first is shape 0), \
            relative to the control point with the largest displacement.")
        .example("let b = scene.buckling(1);\ncheck_close(norm(b.displacement(0, rod.end)), 1, 1e-9);"),
        method(BUCKLING, "error_estimate", &[], estimated_error)
            .returns(Returns::object(ERROR_ESTIMATE))
            .summary("Estimates the errors of the critical factors due to the mesh.")
            .doc("The analysis is repeated with three quarters and half of the spans.")
            .example("let error = scene.buckling(1).error_estimate();\nprint(error);\n\
                check(error.of(\"shape 0\").present < 0.01);"),
    ],
};

const COLUMN: &str = "let scene = new_scene(\"column\");\n\
    let s = section(#{ EA: 1e6, GA: 1e6, EI: 100, rho_A: 1, rho_I: 1e-4 });\n\
    let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [0, 4]), basis: bspline(8), section: s });\n\
    scene.clamp(rod.start);\n\
    scene.force(rod.end, [0, -1]);";

const COUNT: Parameter = integer("count").positive().or(Presence::Integer(3));
const LOADING: &[Parameter] = &[
    number("load_factor")
        .or(Presence::Number(1.0))
        .doc("factor of the loads to which the critical factors refer; -1 reverses the loads"),
    number("time")
        .unit("time")
        .or(Presence::Number(0.0))
        .doc("time at which schedules are evaluated, just after it"),
];

/// Largest displacement before buckling without a note, as a fraction of the size of the scene.
const SMALL_DISPLACEMENT: f64 = 0.03;

pub const BUCKLING: Type = Type::of::<BucklingHandle>();

#[derive(Clone)]
pub struct BucklingHandle(Rc<BucklingData>);

struct BucklingData {
    of: SceneHandle,
    buckling: Buckling,
}

impl BucklingHandle {
    pub fn buckling(&self) -> &Buckling {
        &self.0.buckling
    }
}

impl Scripted for BucklingHandle {
    const NAME: &'static str = "buckling";
    const DOC: &'static str = "Critical load factors and buckling shapes of a scene.";

    fn show(&self) -> String {
        let buckling = &self.0.buckling;
        let mut table = TextTable::new(&["shape", "critical load factor", "moves most"]);
        for (number, load) in buckling.critical().iter().enumerate() {
            table.row([
                Cell::Number(number.to_string()),
                Cell::Number(significant(load.factor, 7)),
                Cell::Text(buckling.most_displaced_body(number)),
            ]);
        }
        table.to_string().trim_end().to_owned()
    }
}

fn find(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let handle = call.receiver::<SceneHandle>()?;
    let options = call.options_or_defaults("options")?;
    let loading = Loading {
        time: options.number("time")?,
        factor: options.number("load_factor")?,
        ..Loading::default()
    };
    let scene = handle.scene().borrow().clone();
    expect_room(call, &assemble(call, &scene)?)?;
    let context = call.context();
    let buckling = analyse(scene, loading, call.count("count")?, context)?;
    let moved = buckling.displacement_before();
    if moved > SMALL_DISPLACEMENT {
        let (name, moved) = (&buckling.scene().name, significant(moved, 2));
        context.print_message(&format!(
            "note: the buckling analysis of '{name}' neglects displacements before buckling, here \
            {moved} of the size of the scene; check with scene.equilibrium(…)"
        ));
    }
    Ok(Dynamic::from(BucklingHandle(Rc::new(BucklingData { of: handle, buckling }))))
}

fn analyse(
    scene: Scene,
    loading: Loading,
    count: usize,
    context: &Context,
) -> Result<Buckling, ScriptError> {
    match Buckling::find(scene, loading, count, &mut || !context.is_stopped()) {
        Err(
            BucklingError::Modes(VibrationError::Interrupted)
            | BucklingError::Statics(StaticsError::Interrupted { .. }),
        ) => Err(context.why_stopped("a buckling analysis")),
        found => Ok(found?),
    }
}

fn estimated_error(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let (handle, context) = (buckling(call)?, call.context());
    let own = handle.buckling();
    let results = |buckling: &Buckling| {
        let numbered = buckling.critical().iter().enumerate();
        let result = |(number, load): (usize, &CriticalLoad)| {
            MeshResult::scalar(format!("shape {number}"), "-", load.factor)
        };
        numbered.map(result).collect::<Vec<_>>()
    };
    let count = own.critical().len();
    let together = Together { name: CRITICAL_LOADS, count };
    let factors = |scene: Scene| {
        let functions = functions_of_time(own.scene());
        let found =
            expect_no_side_effects(&functions, || analyse(scene, *own.loading(), count, context))?;
        Ok(results(&found))
    };
    let estimate =
        ErrorEstimate::on_meshes(own.scene(), String::new(), together, results(own), factors)?;
    Ok(Dynamic::from(estimate))
}

const fn binding(name: &'static str, returns: Returns, body: NativeFunction) -> FunctionBinding {
    property(BUCKLING, name, body).returns(returns)
}

fn buckling(call: &Call) -> Result<BucklingHandle, ScriptError> {
    call.receiver()
}

fn list(call: &Call, read: fn(&CriticalLoad) -> f64) -> Result<Dynamic, ScriptError> {
    Ok(numbers_of(buckling(call)?.buckling().critical(), read))
}
