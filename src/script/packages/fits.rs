//! Fits to data, optimisation of designs, and roots of equations.

use std::rc::Rc;
use std::time::Duration;

use rhai::{Array, Dynamic, FnPtr, Map};

use crate::fitting::RELATIVE_STEP;
use crate::script::bindings::call::Call;
use crate::script::bindings::kind::{Scripted, Type};
use crate::script::bindings::option_set::option_set;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{
    Parameter, Presence, callback, choice, integer, name, number, numbers, of_any_type, options,
    text,
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
    doc: "Fits, optimisation and roots. The functions of fit and minimise are called on all \
        cores, like those of sweeps: they may use data from outside, and each run starts with \
        its original value.",
    types: &[FIT, DESIGN],
    setup: SETUP,
    constants: &[],
    rows: &[
        function("fit", &[options("options", FIT_KEYS)], make_fit)
            .returns(Returns::object(FIT))
            .summary("Finds the parameters for which the results of a function are closest to data \
                (least squares), with their uncertainties.")
            .doc(
                "Give `residuals`, a function of a map of parameters that returns an array of \
                differences, or `model`, which returns an array to be compared with \
                `measured`, at the places `over`. `data` is passed as second argument. The \
                weighted sum of squares is minimised by the Levenberg-Marquardt method within \
                the bounds. Derivatives are computed along with the runs where possible (see \
                scene.parameter); the first ones are compared with a difference of two runs. \
                If they differ, or the function has no derivatives, central differences of \
                runs are used, and `found.derivatives` gives the reason. Their step is `step` \
                times the size of a parameter (its value, or a hundredth of its range if it is \
                near zero), default: 1e-4, which gives about eight digits for runs that repeat \
                to 1e-12; use 1e-3 with adaptive steps. They are computed at the start and at \
                the end and updated in between by Broyden's method. Errors are standard \
                errors, s² (JᵀJ)⁻¹ with s from the residuals, and intervals are those of \
                Student's distribution; a parameter at a bound counts as known. A table is \
                printed.",
            )
            .example(
                "let times = linspace(0, 4, 21);\nlet measured = times.map(|t| 3 * exp(-0.5 * t) + 0.001 * sin(50 * t));\n\
                 let found = fit(#{\n    name: \"decay\", parameters: #{ height: [1, 0, 10], rate: [1, 0, 5] },\n    \
                 model: |p| times.map(|t| p.height * exp(-p.rate * t)), measured: measured, over: times,\n});\n\
                 check_close(found.parameters.height, 3, 0.01);\ncheck_close(found.parameters.rate, 0.5, found.half_widths.rate * 2);\nfound.plot();",
            )
            .with_related(&["minimise", "find_root", "read_csv", "study_sweep"]),
        of_fit("parameters", |call| Ok(named(&*fit(call)?, |fit, at| Some(fit.fitted.parameters[at]))))
            .returns(Returns::MAP)
            .summary("Map of the fitted parameters by name.")
            .example("check_close(found.parameters.slope, 2, 1e-8);"),
        of_fit("errors", |call| {
            Ok(named(&*fit(call)?, |fit, at| fit.fitted.estimate.as_ref()?.error(at)))
        })
        .returns(Returns::MAP)
        .summary("Map of the standard errors of the parameters by name; () if the residuals do not \
            determine them, or do not depend on one of them.")
        .example("check(found.errors.slope < 1e-8);")
        .with_related(&["half_widths", "covariance"]),
        of_fit("half_widths", |call| Ok(named(&*fit(call)?, Fit::half_width)))
            .returns(Returns::MAP)
            .summary("Map of half the widths of the confidence intervals of the parameters, with the \
                option `confidence`, default: 0.95; () if they are not determined.")
            .example("let p = found.parameters;\nprint(`${p.slope} ± ${found.half_widths.slope}`);")
            .with_related(&["errors"]),
        of_fit("covariance", |call| {
            let rows = fit(call)?.fitted.estimate.as_ref().map(|of| of.covariance.clone());
            let row = |row: Vec<f64>| Dynamic::from(row.into_iter().map(Dynamic::from).collect::<Array>());
            Ok(rows.unwrap_or_default().into_iter().map(row).collect::<Array>().into())
        })
        .returns(Returns::array_of(&ValueKind::Array(&ValueKind::Number)))
        .summary("Covariance matrix of the parameters in the order of their names; empty if the \
            residuals do not determine it.")
        .example("check(found.covariance.len() == 2);"),
        of_fit("residuals", |call| {
            Ok(fit(call)?.residuals.iter().map(|x| Dynamic::from(*x)).collect::<Array>().into())
        })
        .returns(Returns::NUMBERS)
        .summary("Residuals without weights; for a model the result minus the measured value.")
        .example("check(found.residuals.len() == 3);"),
        of_fit("outcome", |call| Ok(fit(call)?.outcome().into()))
            .returns(Returns::TEXT)
            .summary("Outcome of the search: settled, or the reason of the failure.")
            .example("check(found.outcome == \"settled\");"),
        of_fit("runs", |call| Ok((fit(call)?.fitted.runs as i64).into()))
            .returns(Returns::INTEGER)
            .summary("Number of calls of the function.")
            .example("check(found.runs <= 20);"),
        of_fit("derivatives", |call| Ok(fit(call)?.derivatives().into()))
            .returns(Returns::TEXT)
            .summary("Source of the derivatives: the runs, or central differences of runs with the \
                reason.")
            .example("check(found.derivatives == \"those of the runs\");"),
        method(FIT, "plot", &[], |call| {
            let fit = fit(call)?;
            call.context().write_file(&format!("{}-fit.svg", fit.name), fit.picture()?.as_bytes())?;
            Ok(Dynamic::UNIT)
        })
        .summary("Plots the measured data with the fitted model, and the residuals below, in \
            NAME-fit.svg.")
        .example("found.plot();"),
        function("minimise", &[options("options", DESIGN_KEYS)], minimise)
            .returns(Returns::object(DESIGN))
            .summary("Finds the parameters that minimise or maximise a result, within bounds and \
                with constraints on other results.")
            .doc(
                "`run` is a function of a map of parameters that returns a map of numbers. \
                `least` or `largest` names the result to minimise or maximise; `constraints` \
                gives the limits of other results. If the runs have derivatives (as in fit), \
                Kraft's SLSQP is used: quadratic models with linearised constraints. If they \
                have none, or the first ones differ from a difference of two runs, or the \
                search is stuck, Powell's COBYLA is used: linear models over a simplex of \
                designs; `best.derivatives` gives the reason. Both methods find a local \
                optimum, not the global one. Designs with failed runs are avoided. The result \
                is the best of all tried designs that satisfy the constraints.",
            )
            .example(
                "let best = minimise(#{\n    parameters: #{ width: [1, 0.1, 4], height: [1, 0.1, 4] },\n    \
                 run: |p| #{ rim: 2 * (p.width + p.height), area: p.width * p.height },\n    least: \"rim\", constraints: #{ area: [4, ()] },\n});\n\
                 check_close(best.results.rim, 8, 1e-2);",
            )
            .with_related(&["fit", "find_root"]),
        of_design("parameters", |call| Ok(pairs(&design(call)?.parameters)))
            .returns(Returns::MAP)
            .summary("Map of the parameters of the best design by name.")
            .example("check_close(best.parameters.x, 1, 1e-3);"),
        of_design("results", |call| Ok(pairs(&design(call)?.results)))
            .returns(Returns::MAP)
            .summary("Map of the results of the best design by name.")
            .example("check(best.results.y < 1e-6);"),
        of_design("runs", |call| Ok((design(call)?.runs as i64).into()))
            .returns(Returns::INTEGER)
            .summary("Number of calls of the function, without the call that detects missing \
                derivatives.")
            .example("check(best.runs < 200);"),
        of_design("derivatives", |call| Ok(design(call)?.derivatives.clone().into()))
            .returns(Returns::TEXT)
            .summary("Source of the derivatives: the runs, or none with the reason.")
            .example("check(best.derivatives == \"those of the runs\");"),
        of_design("settled", |call| Ok(design(call)?.is_settled.into()))
            .returns(Returns::BOOLEAN)
            .summary("True if the search finished before the largest number of runs was reached.")
            .example("check(best.settled);"),
        function("find_root", &[callback("function").doc("|x| …, returns a number"), FROM, TO, PLACE_TOLERANCE], find_root)
            .returns(Returns::NUMBER)
            .summary("Finds a zero of a function of one number, between two numbers at which its \
                signs differ.")
            .doc("R. P. Brent's method (1973). The tolerance is that of the argument, default: \
                1e-9 of the interval. The function is called on this thread and may use \
                everything.")
            .example("check_close(find_root(|x| cos(x) * cosh(x) + 1, 1, 3), 1.875104068711961, 1e-8);")
            .with_related(&["fit", "minimise"]),
    ],
};

const SETUP: &str = "let found = fit(#{ parameters: #{ slope: 1, height: 0 }, model: |p| [0, 1, 2].map(|x| p.slope * x + p.height), measured: [1, 3, 5] });\n\
    let best = minimise(#{ parameters: #{ x: [0, -3, 3] }, run: |p| #{ y: (p.x - 1) ** 2 }, least: \"y\", tolerance: 1e-5 });";
const FIT: Type = Type::of::<FitHandle>();
const DESIGN: Type = Type::of::<DesignHandle>();
const FIT_KEYS: &[Parameter] = FitOptions::KEYS;
const DESIGN_KEYS: &[Parameter] = DesignOptions::KEYS;
const FROM: Parameter = number("from").doc("argument at which the function has one sign");
const TO: Parameter = number("to").doc("argument at which the function has the other sign");
const PLACE_TOLERANCE: Parameter = number("tolerance")
    .positive()
    .doc("accuracy of the argument; default: 1e-9 of the interval")
    .optional();
const RANGES: Parameter = of_any_type("parameters").doc(
    "names with initial, lowest and highest value: #{ EI: [10, 1, 100] }, or the initial \
        value alone",
);
const TIME_LIMIT: Parameter = number("time_limit")
    .positive()
    .unit("s")
    .or(Presence::Number(600.0))
    .doc("longest time of a run by the clock");

option_set! {
    pub struct FitOptions {
        name: String = name("name").or(Presence::Text("fit")).doc("name of the fit and its files"),
        parameters: Dynamic = RANGES,
        residuals: Option<FnPtr> = callback("residuals").doc("|p| …, returns an array of differences").optional(),
        model: Option<FnPtr> = callback("model").doc("|p| …, returns an array of values to be compared with measured").optional(),
        measured: Option<Vec<f64>> = numbers("measured").doc("measured values").optional().requires_key("model"),
        over: Option<Vec<f64>> = numbers("over").doc("places or times of the measured values, for the picture").optional().requires_key("measured"),
        data: Option<Dynamic> = of_any_type("data").doc("second argument of the function: read_csv(\"measured.csv\")").optional(),
        weights: Option<Vec<f64>> = numbers("weights").doc("weights of the squares, one for each: 1 over the variance of the measured value").optional(),
        confidence: f64 = number("confidence").between(0.5, 0.9999).or(Presence::Number(0.95)).doc("confidence of the intervals of the parameters"),
        step: f64 = number("step").between(1e-8, 0.1).or(Presence::Number(RELATIVE_STEP)).doc("step of differences, as a fraction of the size of a parameter"),
        derivatives: String = choice("derivatives", &["known", "differences"]).or(Presence::Text("known")).doc("\"known\": derivatives of the runs if available; \"differences\": always \
            differences of runs"),
        time_limit: f64 = TIME_LIMIT,
    }
}

option_set! {
    pub struct DesignOptions {
        parameters: Dynamic = RANGES,
        run: FnPtr = callback("run").doc("|p| …, returns a map of numbers"),
        least: Option<String> = text("least").doc("name of the result to minimise").optional(),
        largest: Option<String> = text("largest").doc("name of the result to maximise").optional(),
        constraints: Option<Dynamic> = of_any_type("constraints").doc("lower and upper limits of results: #{ sag: [-1e-3, 1e-3], mass: [(), 5] }").optional(),
        tolerance: f64 = number("tolerance").positive().or(Presence::Number(1e-4)).doc("accuracy of parameters, as a fraction of their ranges"),
        most_runs: usize = integer("most_runs").positive().or(Presence::Integer(500)),
        derivatives: String = choice("derivatives", &["known", "none"]).or(Presence::Text("known")).doc("\"known\": derivatives of the runs if available; \"none\": no derivatives"),
        time_limit: f64 = TIME_LIMIT,
    }
}

#[derive(Clone)]
struct FitHandle(Rc<Fit>);

#[derive(Clone)]
struct DesignHandle(Rc<BestDesign>);

impl Scripted for FitHandle {
    const NAME: &'static str = "fit";
    const DOC: &'static str = "Parameters fitted to data, with their uncertainties.";

    fn show(&self) -> String {
        self.0.text()
    }
}

impl Scripted for DesignHandle {
    const NAME: &'static str = "design";
    const DOC: &'static str = "The best design found by a search.";

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
                let message =
                    format!("over has {} numbers, but measured has {}", over.len(), measured.len());
                return Err(at_key(
                    call,
                    "over",
                    message,
                    "give one number of over for each measured value",
                ));
            }
            ("model", model, Compared::Model { measured, over: options.over })
        }
        (None, Some(_), None) => {
            return Err(at_key(
                call,
                "model",
                "the measured values for the model are missing",
                "add measured: […], an array of numbers",
            ));
        }
        _ => {
            return Err(call.error("give either residuals or a model").hint(
                "residuals: |p| […], differences to be minimised, or model: |p| […] with \
                measured: […]",
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
        let message =
            format!("weights has {} numbers, but measured has {}", weights.len(), measured.len());
        return Err(at_key(call, "weights", message, "give one weight for each measured value"));
    }
    if let Some(wrong) = options.weights.iter().flatten().find(|weight| **weight <= 0.0) {
        let message = format!("weights hold {}", format_number(*wrong));
        return Err(at_key(
            call,
            "weights",
            message,
            "weights must be positive: 1 over the variance",
        ));
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
        wall: wall(options.time_limit),
    };
    let fit = match call.context().mode() {
        RunMode::Run => order.run(call)?,
        RunMode::DryRun => order.dry_run(call)?,
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
            return Err(call.error("give one result to minimise or maximise").hint(hint));
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
        wall: wall(options.time_limit),
    };
    let design = match call.context().mode() {
        RunMode::Run => order.run(call)?,
        RunMode::DryRun => order.dry_run(call)?,
    };
    print_table(call.context(), &design.text());
    Ok(Dynamic::from(DesignHandle(Rc::new(design))))
}
