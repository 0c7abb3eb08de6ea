//! Functions of Rhai that belong to the language, with their documentation.

use super::returns::Returns;

pub struct BuiltInTable {
    pub name: &'static str,
    pub doc: &'static str,
    pub rows: &'static [BuiltIn],
}

pub struct BuiltIn {
    /// Notations of the function, all with the same name: `array.push(value)`, `parse_int(text, [radix])`, `text.len`.
    pub forms: &'static [&'static str],
    pub returns: Returns,
    pub summary: &'static str,
    pub doc: &'static str,
    pub example: &'static str,
    pub related: &'static [&'static str],
}

#[derive(Clone, Debug, PartialEq)]
pub struct FunctionForm {
    /// Type of the value before the dot; `None` for a function.
    pub receiver: Option<&'static str>,
    pub name: &'static str,
    /// Arguments in parentheses; empty for a property.
    pub arguments: &'static str,
    /// Names of the required arguments; empty for a property.
    pub required: Vec<&'static str>,
    pub optional: Vec<&'static str>,
    pub ending: NameSuffix,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameSuffix {
    Property,
    Arguments,
    Repeated,
}

pub const fn built_in(
    forms: &'static [&'static str],
    summary: &'static str,
    example: &'static str,
) -> BuiltIn {
    BuiltIn { forms, returns: Returns::NOTHING, summary, doc: "", example, related: &[] }
}

impl BuiltIn {
    pub const fn returns(mut self, returns: Returns) -> Self {
        self.returns = returns;
        self
    }

    pub const fn doc(mut self, doc: &'static str) -> Self {
        self.doc = doc;
        self
    }

    pub const fn with_related(mut self, see: &'static [&'static str]) -> Self {
        self.related = see;
        self
    }

    pub fn name(&self) -> &'static str {
        self.forms.first().map_or("", |form| written(form).name)
    }

    pub fn written(&self) -> impl Iterator<Item = FunctionForm> {
        self.forms.iter().map(|form| written(form))
    }

    pub fn is_of(&self, type_name: &str) -> bool {
        self.form_of(type_name).is_some()
    }

    pub fn form_of(&self, type_name: &str) -> Option<FunctionForm> {
        self.written().find(|form| form.is_of(type_name))
    }

    pub fn form_of_function(&self) -> Option<FunctionForm> {
        self.written().find(|form| form.receiver.is_none())
    }

    pub fn is_function(&self) -> bool {
        self.form_of_function().is_some()
    }
}

impl FunctionForm {
    pub fn is_of(&self, type_name: &str) -> bool {
        self.receiver.is_some_and(|kind| kind_includes(kind, type_name))
    }

    pub fn listed(&self) -> Vec<String> {
        let inside = self.arguments.trim_matches(['(', ')']).split(", ");
        inside.filter(|name| !name.is_empty()).map(str::to_owned).collect()
    }

    /// Returns true if a call with `count` values, including the value before the dot, matches this notation.
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
    fn written_forms_are_parsed() {
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
    fn receiver_word_may_stand_for_several_types() {
        let sign = built_in(&["number.sign()"], "", "");
        assert!(sign.is_of("whole number") && sign.is_of("number") && !sign.is_of("text"));
        assert!(built_in(&["value.to_string()"], "", "").is_of("beam"));
        assert!(built_in(&["timestamp()"], "", "").is_function());
    }
}
