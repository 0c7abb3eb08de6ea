//! Common options of charts.

use rhai::{Array, Dynamic};

use crate::output::{AxisLimits, AxisScale, LineChart, Marker, Series, Stroke, significant};
use crate::script::bindings::call::Call;
use crate::script::bindings::options::Options;
use crate::script::bindings::parameter::{Parameter, array, boolean, choice, numbers, text};
use crate::script::messages::error::{CallPart, ScriptError};
use crate::script::messages::numbers::{as_number, format_number};
use crate::script::presentation::motion::Visibility;

pub const TITLE: Parameter = text("title").doc("title above the picture").optional();
pub const X_LABEL: Parameter = text("x_label").doc("label of the horizontal axis").optional();
pub const Y_LABEL: Parameter = text("y_label").doc("label of the vertical axis").optional();
pub const X_LOG: Parameter =
    boolean("x_log").doc("true for a logarithmic horizontal axis").optional();
pub const Y_LOG: Parameter =
    boolean("y_log").doc("true for a logarithmic vertical axis").optional();
pub const X_LIMITS: Parameter =
    numbers("x_limits").doc("[low, high]: limits of the horizontal axis").optional();
pub const Y_LIMITS: Parameter =
    numbers("y_limits").doc("[low, high]: limits of the vertical axis").optional();
pub const MARKERS: Parameter = choice("markers", &["on_lines", "alone"])
    .doc("marks at every point, on the lines or without lines; default: no marks")
    .optional();
pub const LABELS: Parameter =
    array("labels").doc("names of the curves in the legend, texts or numbers").optional();

pub const SYMBOLS: Parameter = boolean("symbols")
    .doc(
        "true to show symbols of supports, joints, sliders, springs and loads; default: true, \
        but supports, joints and sliders are omitted if there are more than 60; obstacles are \
        always shown",
    )
    .optional();

const DIGITS: usize = 6;

pub struct OptionError {
    key: String,
    message: String,
    hint: &'static str,
}

impl OptionError {
    pub fn in_call(self, call: &Call) -> ScriptError {
        call.error(self.message).hint(self.hint).at(CallPart::Key(self.key))
    }

    pub fn in_command(self, command: &str) -> ScriptError {
        ScriptError::new(format!("{command}: {}", self.message)).hint(self.hint)
    }
}

pub fn symbols(options: &Options) -> Visibility {
    match options.boolean("symbols") {
        Ok(false) => Visibility::None,
        Ok(true) => Visibility::Yes,
        Err(_) => Visibility::IfFew,
    }
}

pub fn limits(options: &Options) -> Result<AxisLimits, OptionError> {
    let ends = |name: &str| match options.numbers(name).ok().as_deref() {
        None => Ok(None),
        Some([low, high]) if low < high => Ok(Some((*low, *high))),
        Some(other) => {
            let got: Vec<String> = other.iter().map(|end| format_number(*end)).collect();
            let message = format!("'{name}' must be [low, high], got [{}]", got.join(", "));
            Err(OptionError {
                key: name.to_owned(),
                message,
                hint: "give two numbers, the smaller one first",
            })
        }
    };
    Ok(AxisLimits { x: ends("x_limits")?, y: ends("y_limits")? })
}

pub fn expect_options_for_panels(options: &Options, panels: usize) -> Result<(), OptionError> {
    match [Y_LABEL, Y_LIMITS].into_iter().find(|option| options.has(option.name)) {
        Some(Parameter { name, .. }) if panels > 1 => Err(OptionError {
            key: name.to_owned(),
            message: format!("'{name}' is for one axis, but the columns have {panels} units"),
            hint: "remove this option, or plot the columns of each unit separately",
        }),
        _ => Ok(()),
    }
}

pub fn with_options(options: &Options, mut chart: LineChart) -> Result<LineChart, OptionError> {
    let limits = limits(options)?;
    let is_asked = |name: &str| options.boolean(name).unwrap_or(false);
    for (axis, ends) in [("x", limits.x), ("y", limits.y)] {
        if let Some((low, _)) = ends.filter(|(low, _)| *low <= 0.0)
            && is_asked(&format!("{axis}_log"))
        {
            let message = format!("a logarithmic axis cannot begin at {}", format_number(low));
            let key = format!("{axis}_limits");
            return Err(OptionError { key, message, hint: "give limits above zero" });
        }
    }
    if let Ok(label) = options.text("x_label") {
        chart = chart.x_label(label.as_str());
    }
    if let Ok(label) = options.text("y_label") {
        chart = chart.y_label(label.as_str());
    }
    if is_asked("x_log") {
        chart = chart.x_scale(AxisScale::Logarithmic);
    }
    if is_asked("y_log") {
        chart = chart.y_scale(AxisScale::Logarithmic);
    }
    Ok(chart.limits(limits))
}

pub fn marked(options: &Options, index: usize, series: Series) -> Series {
    match options.text("markers").as_deref() {
        Ok("alone") => series.stroke(Stroke::MarkersOnly).marker(Marker::of_index(index)),
        Ok(_) => series.stroke(Stroke::Marked).marker(Marker::of_index(index)),
        Err(_) => series,
    }
}

pub fn labels(options: &Options, count: usize) -> Result<Option<Vec<String>>, OptionError> {
    let Ok(given) = options.array("labels") else { return Ok(None) };
    let wrong = |message: String, hint| OptionError { key: "labels".to_owned(), message, hint };
    if given.len() != count {
        let plural = if count == 1 { "" } else { "s" };
        let message = format!("there are {count} curve{plural}, but {} labels", given.len());
        return Err(wrong(message, "give one label for each curve"));
    }
    let label = |value: &Dynamic| {
        let number = as_number(value).map(|number| significant(number, DIGITS));
        value.clone().into_string().ok().or(number)
    };
    let labels: Option<Vec<String>> = given.iter().map(label).collect();
    let message = || "the labels must be texts or numbers".to_owned();
    labels.map(Some).ok_or_else(|| wrong(message(), "for example labels: [\"first\", \"second\"]"))
}

/// Curves from an argument: an array of numbers is one curve, an array of arrays several. Values that are not finite become gaps.
pub fn curves(call: &Call, name: &str, at: usize) -> Result<Vec<Vec<f64>>, ScriptError> {
    let given = call.array(name)?;
    let is_many = !given.is_empty() && given.iter().all(Dynamic::is_array);
    let read = |array: &Array| -> Result<Vec<f64>, ScriptError> {
        let number =
            |(index, value): (usize, &Dynamic)| {
                as_number(value).ok_or_else(|| {
                    let got = call.describe(value);
                    call.error(format!("'{name}' must hold numbers, got {got} at index {index}"))
                    .hint("give an array of numbers for one curve, or an array of such arrays for \
                        several")
                    .at(CallPart::Argument(at))
                })
            };
        array.iter().enumerate().map(number).collect()
    };
    match is_many {
        true => given
            .iter()
            .map(|array| read(&array.clone().into_array().unwrap_or_default()))
            .collect(),
        false => Ok(vec![read(&given)?]),
    }
}
