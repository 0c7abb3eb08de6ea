//! Inputs of a script, and their values given from outside, such as by `--set load=250`.

use std::str::FromStr;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use rhai::{Array, Dynamic};

use crate::output::format_number;
use crate::script::messages::error::ScriptError;
use crate::script::messages::numbers::{as_integer, as_number};
use crate::script::messages::suggest::nearest;

/// Value given from outside for an input, in the form `NAME=VALUE`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputSetting {
    /// Name of the input.
    pub name: String,
    /// Value as text. The declaration of the input determines its type.
    pub text: String,
}

impl FromStr for InputSetting {
    type Err = String;

    fn from_str(setting: &str) -> Result<Self, String> {
        match setting.split_once('=') {
            Some((name, text)) if is_input_name(name.trim()) => {
                Ok(Self { name: name.trim().to_owned(), text: text.trim().to_owned() })
            }
            Some((name, _)) => Err(format!("'{name}' is not a name: {NAMES}")),
            None => Err("write NAME=VALUE, such as load=250".to_owned()),
        }
    }
}

/// Characters allowed in the name of an input, for messages.
pub const NAMES: &str = "names have letters, digits and _, and begin with a letter";

/// Returns true if a text is allowed as the name of an input.
pub fn is_input_name(name: &str) -> bool {
    name.starts_with(char::is_alphabetic)
        && name.chars().all(|letter| letter.is_alphanumeric() || letter == '_')
}

/// Value of an input, of the same type as its default.
#[derive(Clone, Debug, PartialEq)]
pub enum InputValue {
    /// Finite number.
    Number(f64),
    /// Integer.
    Integer(i64),
    /// Boolean.
    Boolean(bool),
    /// Text.
    Text(String),
    /// Array of finite numbers.
    Numbers(Vec<f64>),
}

impl InputValue {
    /// Converts a script value to the value of an input; `None` if inputs cannot have its type, or if a number in it is not finite.
    pub fn of(value: &Dynamic) -> Option<Self> {
        if let Ok(truth) = value.as_bool() {
            return Some(Self::Boolean(truth));
        }
        if let Ok(text) = value.as_immutable_string_ref() {
            return Some(Self::Text(text.to_string()));
        }
        if let Ok(whole) = value.as_int() {
            return Some(Self::Integer(whole));
        }
        if let Some(array) = value.read_lock::<Array>() {
            return array.iter().map(finite).collect::<Option<_>>().map(Self::Numbers);
        }
        finite(value).map(Self::Number)
    }

    /// Converts a script value to the type of `self`; `None` if it has another type, or if a number in it is not finite.
    pub fn convert(&self, value: &Dynamic) -> Option<Self> {
        match self {
            Self::Number(_) => finite(value).map(Self::Number),
            Self::Integer(_) => as_integer(value).map(Self::Integer),
            _ => Self::of(value).filter(|of| of.type_words() == self.type_words()),
        }
    }

    /// Parses a text as a value of the type of `self`; `None` if the text has another form.
    fn parse(&self, text: &str) -> Option<Self> {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|x| x.is_finite());
        match self {
            Self::Number(_) => number(text).map(Self::Number),
            Self::Integer(_) => {
                let whole = text.parse().ok();
                whole.or_else(|| as_integer(&number(text)?.into())).map(Self::Integer)
            }
            Self::Boolean(_) => text.parse().ok().map(Self::Boolean),
            Self::Text(_) => Some(Self::Text(text.to_owned())),
            Self::Numbers(_) => {
                let inside = text.strip_prefix('[').and_then(|text| text.strip_suffix(']'));
                let elements = inside.unwrap_or(text).split(',').filter(|of| !of.trim().is_empty());
                elements.map(number).collect::<Option<_>>().map(Self::Numbers)
            }
        }
    }

    /// Value for the script.
    pub fn to_dynamic(&self) -> Dynamic {
        match self {
            Self::Number(x) => (*x).into(),
            Self::Integer(whole) => (*whole).into(),
            Self::Boolean(truth) => (*truth).into(),
            Self::Text(text) => text.clone().into(),
            Self::Numbers(numbers) => {
                numbers.iter().map(|x| Dynamic::from(*x)).collect::<Array>().into()
            }
        }
    }

    /// Value for a report.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            Self::Number(x) => (*x).into(),
            Self::Integer(whole) => (*whole).into(),
            Self::Boolean(truth) => (*truth).into(),
            Self::Text(text) => text.as_str().into(),
            Self::Numbers(numbers) => numbers.as_slice().into(),
        }
    }

    /// Numbers in the value, to each of which the range of the input applies.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Number(x) => vec![*x],
            Self::Integer(whole) => vec![*whole as f64],
            Self::Numbers(numbers) => numbers.clone(),
            Self::Boolean(_) | Self::Text(_) => Vec::new(),
        }
    }

    /// Name of the type with its article.
    pub fn type_words(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Integer(_) => "a whole number",
            Self::Boolean(_) => "true or false",
            Self::Text(_) => "a text",
            Self::Numbers(_) => "an array of numbers, such as [1, 2]",
        }
    }
}

fn finite(value: &Dynamic) -> Option<f64> {
    as_number(value).filter(|x| x.is_finite())
}

impl std::fmt::Display for InputValue {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(x) => f.write_str(&format_number(*x)),
            Self::Integer(whole) => write!(f, "{whole}"),
            Self::Boolean(truth) => write!(f, "{truth}"),
            Self::Text(text) => write!(f, "\"{text}\""),
            Self::Numbers(numbers) => {
                let words: Vec<_> = numbers.iter().map(|x| format_number(*x)).collect();
                write!(f, "[{}]", words.join(", "))
            }
        }
    }
}

/// Declaration of an input by a script.
#[derive(Clone, Debug, PartialEq)]
pub struct InputDeclaration {
    /// Name.
    pub name: String,
    /// Value that is used if none is given.
    pub default: InputValue,
    /// Unit, for example `N`; may be empty.
    pub unit: String,
    /// Smallest allowed number.
    pub min: Option<f64>,
    /// Largest allowed number.
    pub max: Option<f64>,
    /// Allowed values; empty if all values in the range are allowed.
    pub choices: Vec<InputValue>,
    /// Description; may be empty.
    pub about: String,
}

impl InputDeclaration {
    /// Returns true if a value is one of the choices and in the range.
    pub fn allows(&self, value: &InputValue) -> bool {
        let in_range = |x: &f64| {
            self.min.is_none_or(|least| *x >= least) && self.max.is_none_or(|most| *x <= most)
        };
        let is_choice = self.choices.is_empty() || self.choices.contains(value);
        is_choice && value.numbers().iter().all(in_range)
    }

    /// Choices or range with the unit; empty if all values of the type are allowed.
    pub fn allowed(&self) -> String {
        let with_unit = |words: String| match self.unit.as_str() {
            "" => words,
            unit => format!("{words} {unit}"),
        };
        let choices: Vec<_> = self.choices.iter().map(ToString::to_string).collect();
        match (self.min.map(format_number), self.max.map(format_number)) {
            _ if !choices.is_empty() => with_unit(choices.join(", ")),
            (Some(least), Some(most)) => with_unit(format!("{least} to {most}")),
            (Some(least), None) => with_unit(format!("at least {least}")),
            (None, Some(most)) => with_unit(format!("at most {most}")),
            (None, None) => String::new(),
        }
    }

    /// Default with the unit.
    pub fn default_with_unit(&self) -> String {
        format!("{} {}", self.default, self.unit).trim_end().to_owned()
    }

    /// Description of the allowed values for messages, for example `a number (0 to 500 N)`.
    pub fn expectation(&self) -> String {
        match self.allowed() {
            allowed if !self.choices.is_empty() => format!("one of {allowed}"),
            allowed if allowed.is_empty() => self.default.type_words().to_owned(),
            allowed => format!("{} ({allowed})", self.default.type_words()),
        }
    }

    fn read(&self, setting: &InputSetting) -> Result<InputValue, ScriptError> {
        let InputSetting { name, text } = setting;
        let value = self.default.parse(text).filter(|value| self.allows(value));
        value.ok_or_else(|| {
            let message =
                format!("the input '{name}' must be {}, got \"{text}\"", self.expectation());
            let default = self.default_with_unit();
            ScriptError::new(message)
                .hint(format!("change the value of '{name}' (--set {name}=… on the command line); the default is {default}"))
        })
    }
}

/// Inputs of a run. Clones, also in other threads, refer to the same inputs.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    settings: Arc<[InputSetting]>,
    declared: Arc<Mutex<Vec<(InputDeclaration, InputValue)>>>,
}

impl Inputs {
    /// Inputs with the given settings.
    ///
    /// # Errors
    /// Fails if a name is set twice.
    pub fn new(settings: Vec<InputSetting>) -> Result<Self, String> {
        let is_earlier =
            |at: usize| settings[..at].iter().any(|other| other.name == settings[at].name);
        if let Some(again) = (1..settings.len()).find(|at| is_earlier(*at)) {
            return Err(format!("the input '{}' is set twice", settings[again].name));
        }
        Ok(Self { settings: settings.into(), declared: Arc::default() })
    }

    /// Returns true if no value is given from outside.
    pub fn are_defaults(&self) -> bool {
        self.settings.is_empty()
    }

    /// Adds a declaration, and returns the value of the input. A repeated declaration must be equal.
    ///
    /// # Errors
    /// Fails if the input has another declaration, or if its given value is not allowed.
    pub fn declare(&self, declaration: InputDeclaration) -> Result<InputValue, ScriptError> {
        let mut declared = self.lock();
        let name = &declaration.name;
        if let Some((earlier, value)) = declared.iter().find(|(of, _)| of.name == *name) {
            if *earlier == declaration {
                return Ok(value.clone());
            }
            let (was, is) = (earlier.default_with_unit(), declaration.default_with_unit());
            let difference = match was == is {
                true => "other options".to_owned(),
                false => format!("the default {was}, and here {is}"),
            };
            let message = format!("the input '{name}' was declared before with {difference}");
            return Err(ScriptError::new(message).hint(
                "call input(…) once and pass its value on, repeat the same call, or choose \
                another name",
            ));
        }
        let setting = self.settings.iter().find(|setting| setting.name == *name);
        let value = match setting {
            Some(setting) => declaration.read(setting)?,
            None => declaration.default.clone(),
        };
        declared.push((declaration, value.clone()));
        Ok(value)
    }

    /// All declared inputs and their values, in the order of their declarations.
    pub fn declared(&self) -> Vec<(InputDeclaration, InputValue)> {
        self.lock().clone()
    }

    /// Removes the declarations, which a changed script may replace.
    pub fn forget_declarations(&self) {
        self.lock().clear();
    }

    /// Checks that the script declares every input that is set. `also` contains further names that count as declared.
    ///
    /// # Errors
    /// Fails if a name is set that is not declared.
    pub fn expect_declared(&self, also: &[String]) -> Result<(), ScriptError> {
        let declared = self.lock();
        let mut names: Vec<&str> = declared.iter().map(|(of, _)| of.name.as_str()).collect();
        for name in also {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
        let unknown = self.settings.iter().find(|of| !names.contains(&of.name.as_str()));
        let Some(InputSetting { name, text }) = unknown else { return Ok(()) };
        let meant = nearest(name, names.iter().copied());
        let meant = meant.map(|name| format!("did you mean '{name}'? ")).unwrap_or_default();
        let hint = match names.is_empty() {
            true => format!("write let {name} = input(\"{name}\", {text}) in the script"),
            false => format!("{meant}its inputs are {}", names.join(", ")),
        };
        Err(ScriptError::new(format!("the script has no input '{name}'")).hint(hint))
    }

    /// Values given from outside, as bytes for fingerprints of results; empty if there are none.
    pub fn fingerprint(&self) -> Vec<u8> {
        let of = |setting: &InputSetting| format!("{}={}\n", setting.name, setting.text);
        self.settings.iter().map(of).collect::<String>().into_bytes()
    }

    fn lock(&self) -> MutexGuard<'_, Vec<(InputDeclaration, InputValue)>> {
        self.declared.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
