//! Fits to data, design optimisation, and roots.

use std::rc::Rc;
use std::time::Duration;

use rhai::{Array, Dynamic, FnPtr, Map};

use crate::fitting::RELATIVE_STEP;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::option_set::option_set;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, anything, callback, choice, name, number, numbers, options, text, whole,
};
use crate::script::bindings::returns::{Returns, ValueKind};
use crate::script::bindings::table::{
    BindingTable, FunctionBinding, NativeFunction, function, method, property,
};
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::format_number;
use crate::script::state::settings::RunMode;
use crate::script::studies::calls::function::RunFunction;
use crate::script::studies::case_runner::print_table;
use crate::script::studies::fits::design::{BestDesign, DesignRequest, Limit, Objective};
use crate::script::studies::fits::fit::{Compared, Derivatives, Fit, FitRequest};
use crate::script::studies::fits::ranges::Ranges;
use crate::script::studies::fits::root::find_root;
use crate::script::studies::plan::{at_key, study_name};

pub const TABLE: BindingTable = BindingTable {
    name: "fits",
    doc: "Parameters that are found by runs. The functions of fit and minimise are called on all cores, as those of sweeps are: they may use from outside what \
          is data, and each run begins with it as it was.",
    types: &[FIT, DESIGN],
    setup: SETUP,
    constants: &[],
    rows: &[
        function("fit", &[options("options", FIT_KEYS)], make_fit)
            .returns(Returns::object(FIT))
            .summary("Finds the parameters for which what a function gives is nearest to data, and how well they are known.")
            .doc(
                "Either `residuals`, a function of a map of parameters that gives an array of differences, or `model`, which gives what should have been \
                 `measured`, at the places `over`. With `data` the function is called with that as its second argument. The sum of the squares, \
                 each times its weight, is made least by Levenberg's and Marquardt's method; bounds are kept. Derivatives are those that a run knows of itself: the parameters \
                 come as numbers that know what depends on them, as those of scene.parameter do, and a simulation finds with its steps how it changes with them. The first derivatives are held against a difference of two runs. Where these differ, or the function \
                 does what has no derivatives, `found.derivatives` says so, and they are central differences of runs, second \
                 order: `step` times the size of a parameter (its value, or a hundredth of its range where it is near zero), 1e-4 unless given, which \
                 leaves about eight digits of a run that repeats to 1e-12; with adaptive steps give 1e-3. They are found at the start and at the \
                 end and corrected by what each step shows between (Broyden). Errors are the standard ones, s² (JᵀJ)⁻¹ with s from the residuals, and \
                 intervals those of Student's distribution; a parameter at a bound counts as known. A table is printed.",
            )
            .example(
                "let times = linspace(0, 4, 21);\nlet measured = times.map(|t| 3 * exp(-0.5 * t) + 0.001 * sin(50 * t));\n\
                 let found = fit(#{\n    name: \"decay\", parameters: #{ height: [1, 0, 10], rate: [1, 0, 5] },\n    \
                 model: |p| times.map(|t| p.height * exp(-p.rate * t)), measured: measured, over: times,\n});\n\
                 check_close(found.parameters.height, 3, 0.01);\ncheck_close(found.parameters.rate, 0.5, found.half_widths.rate * 2);\nfound.plot();",
            )
            .see(&["minimise", "find_root", "read_csv", "study_sweep"]),
        of_fit("parameters", |call| Ok(named(&*fit(call)?, |fit, at| Some(fit.fitted.parameters[at]))))
            .returns(Returns::MAP)
            .summary("The parameters that were found, by their names.")
            .example("check_close(found.parameters.slope, 2, 1e-8);"),
        of_fit("errors", |call| {
            Ok(named(&*fit(call)?, |fit, at| fit.fitted.estimate.as_ref()?.error(at)))
        })
        .returns(Returns::MAP)
        .summary("The standard errors of the parameters, by their names; () where the residuals tell nothing of them, or nothing depends on one.")
        .example("check(found.errors.slope < 1e-8);")
        .see(&["half_widths", "covariance"]),
        of_fit("half_widths", |call| Ok(named(&*fit(call)?, Fit::half_width)))
            .returns(Returns::MAP)
            .summary("Half the widths of the intervals in which the parameters lie with the option `confidence`, 0.95 unless given; () where nothing tells.")
            .example("let p = found.parameters;\nprint(`${p.slope} ± ${found.half_widths.slope}`);")
            .see(&["errors"]),
        of_fit("covariance", |call| {
            let rows = fit(call)?.fitted.estimate.as_ref().map(|of| of.covariance.clone());
            let row = |row: Vec<f64>| Dynamic::from(row.into_iter().map(Dynamic::from).collect::<Array>());
            Ok(rows.unwrap_or_default().into_iter().map(row).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Array(&ValueKind::Number)))
        .summary("The covariances of the parameters, in the order of their names; empty where the residuals tell nothing of them.")
        .example("check(found.covariance.len() == 2);"),
        of_fit("residuals", |call| {
            Ok(fit(call)?.residuals.iter().map(|x| Dynamic::from(*x)).collect::<Array>().into())
        })
        .returns(Returns::NUMBERS)
        .summary("The residuals, without weights: of a model what it gives less what was measured.")
        .example("check(found.residuals.len() == 3);"),
        of_fit("outcome", |call| Ok(fit(call)?.outcome().into()))
            .returns(Returns::TEXT)
            .summary("How the search ended: settled, or why not.")
            .example("check(found.outcome == \"settled\");"),
        of_fit("runs", |call| Ok((fit(call)?.fitted.runs as i64).into()))
            .returns(Returns::WHOLE)
            .summary("How often the function was called.")
            .example("check(found.runs <= 20);"),
        of_fit("derivatives", |call| Ok(fit(call)?.derivatives().into()))
            .returns(Returns::TEXT)
            .summary("What derivatives were made of: of what the runs know of themselves, or of central differences of runs, and why.")
            .example("check(found.derivatives == \"those of the runs\");"),
        method(FIT, "plot", &[], |call| {
            let fit = fit(call)?;
            call.context().write_file(&format!("{}-fit.svg", fit.name), fit.picture()?.as_bytes())?;
            Ok(Dynamic::UNIT)
        })
        .summary("Draws what was measured with the fitted model, and the residuals below, into NAME-fit.svg.")
        .example("found.plot();"),
        function("minimise", &[options("options", DESIGN_KEYS)], minimise)
            .returns(Returns::object(DESIGN))
            .summary("Finds the parameters for which a result is least, or largest, within bounds and with constraints on others.")
            .doc(
                "`run` is a function of a map of parameters that gives a map of numbers. `least` or `largest` names the one that is wanted so, `constraints` the least \
                 and the largest that others may be. Where runs know their derivatives (the parameters \
                 come as numbers that know what depends on them, as in fit), Kraft's SLSQP follows them: quadratic models within linear ones of the constraints. Where they do not, or the first ones are not what a difference of two runs shows, or a search along them is stuck, \
                 Powell's COBYLA makes linear models over a simplex of designs; `best.derivatives` says why. Both \
                 find the nearest best, not the best of all. Runs that fail are kept away from. The best of all designs that were tried and meet the constraints is given.",
            )
            .example(
                "let best = minimise(#{\n    parameters: #{ width: [1, 0.1, 4], height: [1, 0.1, 4] },\n    \
                 run: |p| #{ rim: 2 * (p.width + p.height), area: p.width * p.height },\n    least: \"rim\", constraints: #{ area: [4, ()] },\n});\n\
                 check_close(best.results.rim, 8, 1e-2);",
            )
            .see(&["fit", "find_root"]),
        of_design("parameters", |call| Ok(pairs(&design(call)?.parameters)))
            .returns(Returns::MAP)
            .summary("The parameters of the best design, by their names.")
            .example("check_close(best.parameters.x, 1, 1e-3);"),
        of_design("results", |call| Ok(pairs(&design(call)?.results)))
            .returns(Returns::MAP)
            .summary("What the run with the best design gives, by names.")
            .example("check(best.results.y < 1e-6);"),
        of_design("runs", |call| Ok((design(call)?.runs as i64).into()))
            .returns(Returns::WHOLE)
            .summary("How often the function was called, but for the call by which it tells that it has no derivatives.")
            .example("check(best.runs < 200);"),
        of_design("derivatives", |call| Ok(design(call)?.derivatives.clone().into()))
            .returns(Returns::TEXT)
            .summary("Whether the search used derivatives: those that the runs know of themselves, or none, and why.")
            .example("check(best.derivatives == \"those of the runs\");"),
        of_design("settled", |call| Ok(design(call)?.is_settled.into()))
            .returns(Returns::TRUTH)
            .summary("Whether the search came to its end before the most runs were made.")
            .example("check(best.settled);"),
        function("find_root", &[callback("function").doc("|x| …, gives a number"), FROM, TO, PLACE_TOLERANCE], find_root)
            .returns(Returns::NUMBER)
            .summary("Finds where a function of one number is zero, between two numbers at which its signs differ.")
            .doc("R. P. Brent's method (1973). The tolerance is that of the place, a billionth of the interval unless given. The function is called on this thread and may use anything.")
            .example("check_close(find_root(|x| cos(x) * cosh(x) + 1, 1, 3), 1.875104068711961, 1e-8);")
            .see(&["fit", "minimise"]),
    ],
};

const SETUP: &str = "let found = fit(#{ parameters: #{ slope: 1, height: 0 }, model: |p| [0, 1, 2].map(|x| p.slope * x + p.height), measured: [1, 3, 5] });\n\
    let best = minimise(#{ parameters: #{ x: [0, -3, 3] }, run: |p| #{ y: (p.x - 1) ** 2 }, least: \"y\", tolerance: 1e-5 });";
const FIT: Type = Type::of::<FitHandle>();
const DESIGN: Type = Type::of::<DesignHandle>();
const FIT_KEYS: &[Parameter] = FitOptions::KEYS;
const DESIGN_KEYS: &[Parameter] = DesignOptions::KEYS;
const FROM: Parameter = number("from").doc("where one sign of the function is");
const TO: Parameter = number("to").doc("where the other sign is");
const PLACE_TOLERANCE: Parameter = number("tolerance")
    .positive()
    .doc("how well the place is to be known; a billionth of the interval unless given")
    .optional();
const RANGES: Parameter = anything("parameters")
    .doc("names with where they begin, the least and the largest value: #{ EI: [10, 1, 100] }, or the start alone");
const PATIENCE: Parameter = number("patience")
    .positive()
    .unit("s")
    .or(Presence::Number(600.0))
    .doc("the longest that a run may take by the clock");

option_set! {
    /// The options of `fit`.
    pub struct FitOptions {
        name: String = name("name").or(Presence::Text("fit")).doc("of the fit and its files"),
        parameters: Dynamic = RANGES,
        residuals: Option<FnPtr> = callback("residuals").doc("|p| …, gives an array of differences").optional(),
        model: Option<FnPtr> = callback("model").doc("|p| …, gives an array of what should have been measured").optional(),
        measured: Option<Vec<f64>> = numbers("measured").doc("what the model is compared with").optional().beside("model"),
        over: Option<Vec<f64>> = numbers("over").doc("where or when it was measured, for the picture").optional().beside("measured"),
        data: Option<Dynamic> = anything("data").doc("what the function is called with behind the parameters: read_csv(\"measured.csv\")").optional(),
        weights: Option<Vec<f64>> = numbers("weights").doc("of the squares, one for each: one over the variance of what was measured").optional(),
        confidence: f64 = number("confidence").between(0.5, 0.9999).or(Presence::Number(0.95)).doc("with which parameters lie in their intervals"),
        step: f64 = number("step").between(1e-8, 0.1).or(Presence::Number(RELATIVE_STEP)).doc("of differences, as a part of the size of a parameter"),
        derivatives: String = choice("derivatives", &["known", "differences"]).or(Presence::Text("known")).doc("those that runs know of themselves, or differences of runs always"),
        patience: f64 = PATIENCE,
    }
}

option_set! {
    /// The options of `minimise`.
    pub struct DesignOptions {
        parameters: Dynamic = RANGES,
        run: FnPtr = callback("run").doc("|p| …, gives a map of numbers"),
        least: Option<String> = text("least").doc("the name of the result that is to be least").optional(),
        largest: Option<String> = text("largest").doc("the name of the result that is to be largest").optional(),
        constraints: Option<Dynamic> = anything("constraints").doc("the least and the largest that results may be: #{ sag: [-1e-3, 1e-3], mass: [(), 5] }").optional(),
        tolerance: f64 = number("tolerance").positive().or(Presence::Number(1e-4)).doc("of parameters, as a part of their ranges"),
        most_runs: usize = whole("most_runs").positive().or(Presence::Whole(500)),
        derivatives: String = choice("derivatives", &["known", "none"]).or(Presence::Text("known")).doc("those that runs know of themselves, or none"),
        patience: f64 = PATIENCE,
    }
}

#[derive(Clone)]
struct FitHandle(Rc<Fit>);

#[derive(Clone)]
struct DesignHandle(Rc<BestDesign>);

impl Scripted for FitHandle {
    const NAME: &'static str = "fit";
    const DOC: &'static str = "Parameters that were fitted to data, and how well they are known.";

    fn show(&self) -> String {
        self.0.text()
    }
}

impl Scripted for DesignHandle {
    const NAME: &'static str = "design";
    const DOC: &'static str = "The best design that a search has found.";

    fn show(&self) -> String {
        self.0.text()
    }
}

const fn of_fit(name: &'static str, body: NativeFunction) -> FunctionBinding {
    property(FIT, name, body)
}

const fn of_design(name: &'static str, body: NativeFunction) -> FunctionBinding {
    property(DESIGN, name, body)
}

fn fit(call: &Call) -> Result<Rc<Fit>, ScriptError> {
    Ok(call.receiver::<FitHandle>()?.0)
}

fn design(call: &Call) -> Result<Rc<BestDesign>, ScriptError> {
    Ok(call.receiver::<DesignHandle>()?.0)
}

fn named(fit: &Fit, value: impl Fn(&Fit, usize) -> Option<f64>) -> Dynamic {
    let names = fit.names.iter().enumerate();
    let pair = |(at, name): (usize, &String)| {
        (name.as_str().into(), value(fit, at).map_or(Dynamic::UNIT, Dynamic::from))
    };
    names.map(pair).collect::<Map>().into()
}

fn pairs(of: &[(String, f64)]) -> Dynamic {
    of.iter()
        .map(|(name, value)| (name.as_str().into(), Dynamic::from(*value)))
        .collect::<Map>()
        .into()
}

fn wall(seconds: f64) -> Duration {
    Duration::from_secs_f64(seconds.min(1e9))
}

fn make_fit(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let given: Options = call.options("options")?;
    let options = FitOptions::of(&given)?;
    let ranges = Ranges::read(call, &options.parameters)?;
    let (key, function, compared) = match (&options.residuals, &options.model, options.measured) {
        (Some(residuals), None, None) => ("residuals", residuals, Compared::Residuals),
        (None, Some(model), Some(measured)) => {
            if let Some(over) = options.over.as_ref().filter(|over| over.len() != measured.len()) {
                let told =
                    format!("over has {} numbers and measured {}", over.len(), measured.len());
                return Err(at_key(call, "over", told, "they belong together pair by pair"));
            }
            ("model", model, Compared::Model { measured, over: options.over })
        }
        (None, Some(_), None) => {
            return Err(at_key(
                call,
                "model",
                "nothing is given to compare the model with",
                "add measured: […], an array of numbers",
            ));
        }
        _ => {
            return Err(call.error("either residuals or a model must be given").hint(
                "residuals: |p| […], differences that are to be small, or model: |p| […] with measured: […]",
            ));
        }
    };
    let count = if options.data.is_some() { 2 } else { 1 };
    let shape = if count == 2 { "|p, data| …" } else { "|p| …" };
    call.expect_arguments(function, count, shape)?;
    RunFunction::expect_read(call, (key, function), ranges.names.iter().map(String::as_str))?;
    if let (Some(weights), Compared::Model { measured, .. }) = (&options.weights, &compared)
        && weights.len() != measured.len()
    {
        let told = format!("weights has {} numbers and measured {}", weights.len(), measured.len());
        return Err(at_key(call, "weights", told, "they belong together pair by pair"));
    }
    if let Some(wrong) = options.weights.iter().flatten().find(|weight| **weight <= 0.0) {
        let told = format!("weights hold {}", format_number(*wrong));
        return Err(at_key(call, "weights", told, "they are positive: one over the variance"));
    }
    let name = study_name(call, &options.name)?;
    call.context().output().path_of(&format!("{name}-fit.svg"))?;
    let order = FitRequest {
        name,
        ranges,
        key,
        function,
        data: options.data,
        compared,
        weights: options.weights,
        confidence: options.confidence,
        step: options.step,
        derivatives: Derivatives::of(&options.derivatives),
        wall: wall(options.patience),
    };
    let fit = match call.context().mode() {
        RunMode::Run => order.make(call)?,
        RunMode::DryBuild => order.pretend(call)?,
    };
    print_table(call.context(), &fit.text());
    Ok(Dynamic::from(FitHandle(Rc::new(fit))))
}

fn minimise(call: &mut Call) -> Result<Dynamic, ScriptError> {
    let given: Options = call.options("options")?;
    let options = DesignOptions::of(&given)?;
    let goal = match (options.least, options.largest) {
        (Some(name), None) => Objective::Least(name),
        (None, Some(name)) => Objective::Largest(name),
        _ => {
            let hint = "write least: \"mass\", or largest: \"speed\", the name of a result";
            return Err(call.error("one result must be wanted least, or largest").hint(hint));
        }
    };
    call.expect_arguments(&options.run, 1, "|p| …")?;
    let limits =
        options.constraints.as_ref().map(|given| Limit::read_all(call, given)).transpose()?;
    let ranges = Ranges::read(call, &options.parameters)?;
    let names = ranges.names.iter().map(String::as_str);
    RunFunction::expect_read(call, ("run", &options.run), names)?;
    let order = DesignRequest {
        ranges,
        function: &options.run,
        goal,
        limits: limits.unwrap_or_default(),
        tolerance: options.tolerance,
        most_runs: options.most_runs,
        derivatives: match options.derivatives.as_str() {
            "none" => Derivatives::Unknown,
            _ => Derivatives::Known,
        },
        wall: wall(options.patience),
    };
    let design = match call.context().mode() {
        RunMode::Run => order.make(call)?,
        RunMode::DryBuild => order.pretend(call)?,
    };
    print_table(call.context(), &design.text());
    Ok(Dynamic::from(DesignHandle(Rc::new(design))))
}
