//! A function of Rhai's own that the language keeps: documented as rows are, registered by the engine.

use super::returns::Returns;

/// Functions of Rhai about one kind of value.
pub struct BuiltInTable {
    /// The kind of value in the plural, a heading in the reference.
    pub name: &'static str,
    /// A sentence or two on the functions of Rhai about this kind of value.
    pub doc: &'static str,
    /// The functions of Rhai about this kind of value.
    pub rows: &'static [BuiltIn],
}

/// One function of Rhai, with all ways to write it.
pub struct BuiltIn {
    /// How the function is written: `array.push(value)`, `parse_int(text, [radix])`, `text.len`. All forms have the same name.
    pub forms: &'static [&'static str],
    /// What the function gives back.
    pub returns: Returns,
    /// One line on what the function does.
    pub summary: &'static str,
    /// More on the function, where a line is not enough.
    pub doc: &'static str,
    /// A script that runs and shows the function at work.
    pub example: &'static str,
    /// Names that are related to the function.
    pub see: &'static [&'static str],
}

/// One way to write a function of Rhai, taken apart.
#[derive(Clone, Debug, PartialEq)]
pub struct FunctionForm {
    /// The kind of value before the dot, or nothing.
    pub receiver: Option<&'static str>,
    /// The name of the function.
    pub name: &'static str,
    /// The arguments of the function in parentheses; empty for a property.
    pub arguments: &'static str,
    /// The names of the arguments that must be given; a property has none.
    pub required: Vec<&'static str>,
    /// The names of the arguments that may be given after those that must be.
    pub optional: Vec<&'static str>,
    /// What stands after the name of the function.
    pub ending: NameSuffix,
}

/// What stands after the name of a function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameSuffix {
    /// Nothing stands after the name: it is read as a property.
    Property,
    /// The arguments stand after the name.
    Arguments,
    /// The arguments stand after the name, the last of them as often as wanted.
    Repeated,
}

/// A function of Rhai for help and reference; what it gives back follows with [`BuiltIn::returns`].
pub const fn built_in(
    forms: &'static [&'static str],
    summary: &'static str,
    example: &'static str,
) -> BuiltIn {
    BuiltIn { forms, returns: Returns::NOTHING, summary, doc: "", example, see: &[] }
}

impl BuiltIn {
    /// Says what the function gives back.
    pub const fn returns(mut self, returns: Returns) -> Self {
        self.returns = returns;
        self
    }

    /// Adds a longer explanation of the function.
    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    /// Adds names that are related to the function.
    pub const fn see(mut self, see: &'static [&'static str]) -> Self {
        self.see = see;
        self
    }

    /// The name of the function in scripts.
    pub fn name(&self) -> &'static str {
        self.forms.first().map_or("", |form| written(form).name)
    }

    /// All ways to write the function, taken apart.
    pub fn written(&self) -> impl Iterator<Item = FunctionForm> {
        self.forms.iter().map(|form| written(form))
    }

    /// Whether the function is a method or a property of values of this type.
    pub fn is_of(&self, type_name: &str) -> bool {
        self.form_of(type_name).is_some()
    }

    /// The first way to write the function after the dot of a value of this type.
    pub fn form_of(&self, type_name: &str) -> Option<FunctionForm> {
        self.written().find(|form| form.is_of(type_name))
    }

    /// The first way to write the function without a value before a dot.
    pub fn form_of_function(&self) -> Option<FunctionForm> {
        self.written().find(|form| form.receiver.is_none())
    }

    /// Whether the function is called without a value before a dot.
    pub fn is_function(&self) -> bool {
        self.form_of_function().is_some()
    }
}

impl FunctionForm {
    /// Whether the function is written after the dot of a value of this type.
    pub fn is_of(&self, type_name: &str) -> bool {
        self.receiver.is_some_and(|kind| kind_includes(kind, type_name))
    }

    /// The arguments of the function one by one, optional ones in brackets.
    pub fn listed(&self) -> Vec<String> {
        let inside = self.arguments.trim_matches(['(', ')']).split(", ");
        inside.filter(|name| !name.is_empty()).map(str::to_owned).collect()
    }

    /// Whether a call with `count` values fits this way of writing, the receiver counted as one.
    pub fn takes(&self, count: usize) -> bool {
        let receiver = usize::from(self.receiver.is_some());
        let least = self.required.len() + receiver;
        let most = least + self.optional.len();
        match self.ending {
            NameSuffix::Property => count == 1,
            NameSuffix::Arguments => (least..=most).contains(&count),
            NameSuffix::Repeated => count >= least,
        }
    }
}

/// Whether a value of the type is meant by the word that stands before a dot.
fn kind_includes(kind: &str, type_name: &str) -> bool {
    match kind {
        "value" => true,
        "number" => matches!(type_name, "number" | "whole number"),
        other => other == type_name,
    }
}

fn written(form: &'static str) -> FunctionForm {
    let (called, inside) = match form.split_once('(') {
        Some((called, rest)) => (called, Some(rest.trim_end_matches(')'))),
        None => (form, None),
    };
    let (receiver, name) = match called.split_once('.') {
        Some((receiver, name)) => (Some(receiver), name),
        None => (None, called),
    };
    let arguments = inside.unwrap_or_default().split(", ").filter(|name| !name.is_empty());
    let (repeated, single): (Vec<_>, Vec<_>) = arguments.partition(|name| name.ends_with('…'));
    let (optional, required): (Vec<_>, Vec<_>) =
        single.into_iter().partition(|name| name.starts_with('['));
    FunctionForm {
        receiver,
        name,
        arguments: &form[called.len()..],
        required,
        optional: optional.into_iter().map(|name| name.trim_matches(['[', ']'])).collect(),
        ending: match (inside, repeated.is_empty()) {
            (None, _) => NameSuffix::Property,
            (Some(_), true) => NameSuffix::Arguments,
            (Some(_), false) => NameSuffix::Repeated,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_are_taken_apart() {
        let form = written("array.extract(start, [count])");
        assert_eq!((form.receiver, form.name), (Some("array"), "extract"));
        assert_eq!(form.arguments, "(start, [count])");
        assert_eq!(
            (form.required.as_slice(), form.optional.as_slice()),
            (&["start"][..], &["count"][..])
        );
        assert!(form.takes(2) && form.takes(3) && !form.takes(1) && !form.takes(4));
        let property = written("text.len");
        assert_eq!((property.name, property.ending), ("len", NameSuffix::Property));
        let call = written("function.call(values…)");
        assert_eq!((call.ending, call.required.len()), (NameSuffix::Repeated, 0));
        assert!(call.takes(1) && call.takes(5));
    }

    #[test]
    fn a_word_before_a_dot_may_mean_several_types() {
        let sign = built_in(&["number.sign()"], "", "");
        assert!(sign.is_of("whole number") && sign.is_of("number") && !sign.is_of("text"));
        assert!(built_in(&["value.to_string()"], "", "").is_of("beam"));
        assert!(built_in(&["timestamp()"], "", "").is_function());
    }
}
