//! Errors of unknown functions and properties, with suggestions.

use rhai::Position;

use super::{foreign_names, operands};
use crate::script::bindings::built_in::BuiltIn;
use crate::script::bindings::catalog::Catalog;
use crate::script::bindings::sources::{FOLDER, Sources};
use crate::script::bindings::table::{CallSyntax, FunctionBinding};
use crate::script::dialect::operators;
use crate::script::library::{ModuleFunction, page_of, pages};
use crate::script::messages::nouns::{type_word, with_article};
use crate::script::messages::suggest::{nearest, related};
use crate::script::source::outline::ScriptOutline;
use crate::script::source::program::Program;
use crate::simulation::History;
use crate::system::RECORDABLE;

pub struct UnknownName<'a> {
    pub catalog: &'a Catalog,
    pub program: &'a Program,
    pub outline: &'a ScriptOutline,
    pub sources: &'a Sources,
}

type ErrorText = (String, Option<String>);

impl UnknownName<'_> {
    /// Message for the error "Function not found: name (types)" of the engine.
    pub fn function(&self, signature: &str, at: Position) -> ErrorText {
        let (name, types) = signature.split_once(" (").unwrap_or((signature, ")"));
        let types: Vec<&str> = types
            .trim_end_matches(')')
            .split(", ")
            .filter(|t| !t.is_empty())
            .map(type_word)
            .collect();
        if name.starts_with("anon$") {
            let file = self.sources.find(name, &self.program.name);
            if let Some(file) = file.filter(|file| *file != self.program.name) {
                let message = format!("a closure of the file {file} cannot be called from here");
                let hint = "let a function of that file return it in an object, such as schedule(|t| \
                    …), or write |x| file::function(x) here";
                return (message, Some(hint.into()));
            }
            let got = types.len();
            let message = format!("the function does not accept {got}");
            return (message, Some("write |x| …, with a name for each argument".into()));
        }
        if !name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            || operators::written(name) != name
        {
            return operands::explain(operators::written(name), &types);
        }
        if let Some((module, own)) = name.rsplit_once("::") {
            return self.of_module(module, own, types.len());
        }
        let rows: Vec<_> = self.catalog.named(name).collect();
        let of_receiver = rows.iter().find(
            |row| matches!(row.form, CallSyntax::Method(of) if types.first() == Some(&of.name())),
        );
        if let Some(row) = of_receiver {
            return wrong_count(row, &[], types.len() - 1);
        }
        let functions: Vec<&FunctionBinding> =
            rows.iter().copied().filter(|row| matches!(row.form, CallSyntax::Function)).collect();
        if let Some((row, others)) = functions.split_first() {
            return wrong_count(row, others, types.len());
        }
        if let Some((_, count)) = self.outline.functions.iter().find(|(known, _)| known == name) {
            if *count == types.len() && self.is_dotted(at) {
                let owner = types.first().map(|of| with_article(of)).unwrap_or_default();
                let message = format!("'{name}' is a function, not a method of {owner}");
                return (message, Some(format!("write {name}({})", self.before_dot(at))));
            }
            return (format!("{name} takes {}, got {}", arguments(*count), types.len()), None);
        }
        if let Some(words) = self.wrong_built_in(name, &types) {
            return words;
        }
        self.unknown_name(name, &types, &rows, self.is_dotted(at))
    }

    fn of_module(&self, module: &str, name: &str, got: usize) -> ErrorText {
        let message = format!("there is no function '{name}' in '{module}'");
        let mut imports = self.outline.imports.iter().rev();
        let path = imports.find(|(known, _)| known == module).map(|(_, path)| path);
        let Some(page) = path.and_then(|path| page_of(path)) else { return (message, None) };
        let written =
            |of: &ModuleFunction| format!("{module}::{}({})", of.name(), of.parameters.join(", "));
        if let Some(known) = page.named(name) {
            let takes = arguments(known.parameters.len());
            let message = format!("{module}::{name} takes {takes}, got {got}");
            return (message, Some(format!("write {}", written(known))));
        }
        let names = || page.functions.iter().map(ModuleFunction::name);
        let hint = match nearest(name, names()).and_then(|near| page.named(near)) {
            Some(near) => format!("did you mean '{}'? {}", near.name(), written(near)),
            None => format!("available: {}", names().collect::<Vec<_>>().join(", ")),
        };
        (message, Some(hint))
    }

    pub fn module(&self, name: &str) -> ErrorText {
        let message = format!("no module was imported as '{name}'");
        let imports = || self.outline.imports.iter().map(|(known, _)| known.as_str());
        let hint = match (page_of(&format!("{FOLDER}{name}")), nearest(name, imports())) {
            (Some(page), _) => {
                format!("write import \"{}\" as {name}; before the call", page.module.name)
            }
            (None, Some(near)) => format!("did you mean '{near}'?"),
            (None, None) => format!("write import \"FILE\" as {name}; before the call"),
        };
        (message, Some(hint))
    }

    fn wrong_built_in(&self, name: &str, types: &[&str]) -> Option<ErrorText> {
        let meant: Vec<_> = self
            .catalog
            .built_ins_named(name)
            .filter(|known| known.is_function() || types.first().is_some_and(|of| known.is_of(of)))
            .collect();
        let got = types.iter().map(|name| with_article(name)).collect::<Vec<_>>().join(", ");
        let message = format!("{name} cannot be called with ({got})");
        if let Some(hint) =
            foreign_names::called_with(name, types.len()).filter(|_| !meant.is_empty())
        {
            return Some((message, Some(hint.into())));
        }
        (!meant.is_empty()).then(|| (message, Some(format!("write {}", forms(&meant)))))
    }

    fn unknown_name(
        &self,
        name: &str,
        types: &[&str],
        rows: &[&FunctionBinding],
        dotted: bool,
    ) -> ErrorText {
        let receiver = types.first().filter(|_| dotted);
        let message = match receiver {
            Some(receiver) => format!("{} has no method '{name}'", with_article(receiver)),
            None => format!("there is no function '{name}'"),
        };
        let owner = types.first();
        let is_owned = rows
            .iter()
            .any(|row| row.receiver().is_some_and(|of| owner.is_some_and(|own| of.name() == *own)));
        let own_function =
            nearest(name, self.outline.functions.iter().map(|(known, _)| known.as_str()));
        let is_variable = self.outline.variables.iter().any(|known| known == name);
        let members = receiver.map(|of| self.catalog.members(of)).unwrap_or_default();
        let is_property = |row: &&&FunctionBinding| {
            row.name == name && matches!(row.form, CallSyntax::Property(_))
        };
        if let Some(property) = members.iter().find(is_property) {
            let hint = format!("'{name}' is a property: write {} without ()", property.signature());
            return (message, Some(hint));
        }
        if !is_owned
            && !is_variable
            && own_function.is_none()
            && let Some(found) = foreign_names::find(name)
        {
            return (message, Some(found.cure.into()));
        }
        if let Some(row) = rows.first() {
            if let Some(hint) = foreign_names::called_with(name, types.len()) {
                return (message, Some(hint.into()));
            }
            let owner = row.receiver().map_or("an operand", |of| of.name());
            return (
                message,
                Some(format!("'{name}' belongs to {}: {}", with_article(owner), row.signature())),
            );
        }
        let built_ins: Vec<_> = self.catalog.built_ins_named(name).collect();
        if let Some(owner) = built_ins.iter().find_map(|known| known.written().next()?.receiver) {
            let hint =
                format!("'{name}' belongs to {}: {}", with_article(owner), forms(&built_ins));
            return (message, Some(hint));
        }
        if is_variable {
            let hint = format!(
                "'{name}' is a variable: {name}[0] is the first element of an array, and \
                {name}.call(…) calls a function"
            );
            return (message, Some(hint));
        }
        if let Some(hint) = of_library(name).filter(|_| !dotted) {
            return (message, Some(hint));
        }
        let mut known: Vec<String> = members.iter().map(|row| row.name.to_owned()).collect();
        let takes = |row: &&FunctionBinding| {
            let first = row.parameters.first();
            matches!(row.form, CallSyntax::Function)
                && receiver.is_none_or(|of| first.is_some_and(|first| first.kind.takes(of)))
        };
        known.extend(self.catalog.rows().filter(takes).map(|row| row.name.to_owned()));
        known.extend(self.outline.functions.iter().map(|(name, _)| name.clone()));
        let is_ours = !members.is_empty();
        let fits = |known: &&BuiltIn| match receiver {
            Some(of) => known.is_of(of) || (known.is_function() && !is_ours),
            None => true,
        };
        known.extend(self.catalog.built_ins().filter(fits).map(|known| known.name().to_owned()));
        let names = || known.iter().map(String::as_str);
        let hint = nearest(name, names()).map(|near| self.did_you_mean(near, receiver));
        let hint = hint.or_else(|| self.one_of(&related(name, names()), receiver));
        (message, hint.or_else(|| receiver.and_then(|of| list(&members, of))))
    }

    fn one_of(&self, names: &[&str], receiver: Option<&&str>) -> Option<String> {
        match names {
            [] => None,
            [one] => Some(self.did_you_mean(one, receiver)),
            several => Some(format!("did you mean one of {}?", several.join(", "))),
        }
    }

    fn did_you_mean(&self, near: &str, receiver: Option<&&str>) -> String {
        let mut rows = self.catalog.named(near);
        let row = match receiver {
            Some(of) => self
                .catalog
                .members(of)
                .into_iter()
                .find(|row| row.name == near)
                .or_else(|| rows.next()),
            None => rows.find(|row| matches!(row.form, CallSyntax::Function)),
        };
        match row {
            Some(row) => format!("did you mean '{near}'? {}", row.signature()),
            None => {
                let of_receiver = self.catalog.built_ins_named(near).filter(|known| {
                    receiver.is_none_or(|of| known.is_of(of) || known.is_function())
                });
                let written = forms(&of_receiver.collect::<Vec<_>>());
                format!("did you mean '{near}'? {written}").trim_end().to_owned()
            }
        }
    }

    /// Message for the errors "Unknown property 'p' - … for type 't'" and "No writable property 'p' - …" of the engine.
    pub fn property(&self, text: &str) -> ErrorText {
        let mut quoted = text.split('\'').skip(1).step_by(2);
        let (Some(name), Some(of)) = (quoted.next(), quoted.next().map(type_word)) else {
            return (text.to_owned(), None);
        };
        let owner = with_article(of);
        let members = self.catalog.members(of);
        let own = members.iter().find(|row| row.name == name);
        if let Some(own) = own.filter(|_| text.starts_with("No writable")) {
            let is_called = !matches!(own.form, CallSyntax::Property(_));
            let hint = is_called.then(|| format!("call it as: {}", own.signature()));
            return (format!("'{name}' of {owner} cannot be assigned"), hint);
        }
        let message = format!("{owner} has no property '{name}'");
        let is_own = members.iter().any(|row| row.name == name)
            || self.catalog.built_ins_named(name).any(|known| known.is_of(of));
        if let Some(hint) = recorded(of, name) {
            return (message, Some(hint));
        }
        if let Some(found) = foreign_names::find(name).filter(|_| !is_own) {
            return (message, Some(found.cure.into()));
        }
        if let Some(row) =
            members.iter().copied().chain(self.catalog.named(name)).find(|row| row.name == name)
        {
            let hint = match row.form {
                CallSyntax::Property(of) => {
                    format!("'{name}' belongs to {}: {}", with_article(of.name()), row.signature())
                }
                _ => format!("call '{name}' with parentheses: {}", row.signature()),
            };
            return (message, Some(hint));
        }
        if let Some(built_in) = self.catalog.built_ins_named(name).find(|known| known.is_of(of)) {
            return (message, Some(format!("write {}", forms(&[built_in]))));
        }
        let names = || members.iter().map(|row| row.name).chain(self.built_in_members(of));
        let hint = nearest(name, names()).map(|near| self.did_you_mean(near, Some(&of)));
        let hint = hint.or_else(|| self.one_of(&related(name, names()), Some(&of)));
        (message, hint.or_else(|| list(&members, of)))
    }

    fn built_in_members(&self, of: &str) -> impl Iterator<Item = &'static str> {
        self.catalog.built_ins().filter(move |known| known.is_of(of)).map(BuiltIn::name)
    }

    /// Text before the dot at this position; `…` unless it is a name, a number or an expression in parentheses.
    fn before_dot(&self, at: Position) -> &str {
        let (Some(line), Some(column)) = (at.line(), at.position()) else { return "…" };
        let before = self.program.text[..self.program.offset(line, column)].trim_end();
        let value = before.trim_end_matches('.');
        let is_part = |letter: char| letter.is_alphanumeric() || matches!(letter, '_' | '.');
        let in_parentheses =
            |inside: &'_ str| inside.rfind('(').filter(|open| !inside[..*open].ends_with(is_part));
        let found = match value.strip_suffix(')') {
            Some(inside) => in_parentheses(inside).map_or("", |open| &inside[open + 1..]),
            None => &value[value.trim_end_matches(is_part).len()..],
        };
        if found.is_empty() { "…" } else { found }
    }

    fn is_dotted(&self, at: Position) -> bool {
        let (Some(line), Some(column)) = (at.line(), at.position()) else { return false };
        self.program.text[..self.program.offset(line, column)].trim_end().ends_with('.')
    }
}

fn recorded(of: &str, name: &str) -> Option<String> {
    let [(_, of_stations), ..] = RECORDABLE;
    match of {
        "history" if History::COLUMNS.iter().any(|column| column.name == name) => {
            Some(format!("columns are read by their names: history.column(\"{name}\")"))
        }
        "station" if of_stations.iter().any(|quantity| quantity.name == name) => Some(format!(
            "write the name in quotes to record it: scene.record(\"rod.end.{name}\"); \
            sim.position(rod.end) is the position in a simulation"
        )),
        _ => None,
    }
}

fn forms(built_ins: &[&BuiltIn]) -> String {
    let forms: Vec<&str> = built_ins.iter().flat_map(|known| known.forms).copied().collect();
    forms.join(" or ")
}

/// Hint that a library module has a function of this name; `None` if no module has such a function.
pub fn of_library(name: &str) -> Option<String> {
    let mut found = pages().iter().filter_map(|page| Some((page, page.named(name)?)));
    let (page, function) = found.next()?;
    let module = page.module.name;
    let short = module.rsplit('/').next().unwrap_or(module);
    let call = format!("{short}::{}({})", function.name(), function.parameters.join(", "));
    let others: Vec<_> = found.map(|(page, _)| page.module.name).collect();
    let others = match others.as_slice() {
        [] => String::new(),
        names => format!("; also in {}", names.join(", ")),
    };
    Some(format!("it is in the library: write import \"{module}\" as {short}; then {call}{others}"))
}

fn wrong_count(row: &FunctionBinding, others: &[&FunctionBinding], got: usize) -> ErrorText {
    let (least, most) = (row.required(), row.parameters.len());
    let takes =
        if least == most { arguments(most) } else { format!("{least} to {}", arguments(most)) };
    let parameters = row
        .parameters
        .iter()
        .map(|parameter| format!("\n{}: {}", parameter.name, parameter.expectation()));
    let others: String = others.iter().map(|row| format!(" or {}", row.signature())).collect();
    let hint = match foreign_names::called_with(row.name, got) {
        Some(hint) => hint.to_owned(),
        None => format!("write {}{others}{}", row.signature(), parameters.collect::<String>()),
    };
    (format!("{} takes {takes}, got {got}", row.name), Some(hint))
}

fn arguments(count: usize) -> String {
    match count {
        0 => "no arguments".into(),
        1 => "1 argument".into(),
        _ => format!("{count} arguments"),
    }
}

fn list(members: &[&'static FunctionBinding], of: &str) -> Option<String> {
    const MOST: usize = 12;
    let names: Vec<_> = members.iter().map(|row| row.name).collect();
    match names.len() {
        0 => None,
        1..=MOST => Some(format!("available: {}", names.join(", "))),
        count => {
            let first = names[..MOST].join(", ");
            Some(format!(
                "available: {first}, and {} more: help(\"{of}\") lists them",
                count - MOST
            ))
        }
    }
}
