//! List of the library modules with their texts.

use crate::script::bindings::sources::FOLDER;
use crate::script::messages::error::ScriptError;
use crate::script::messages::suggest::nearest;
use crate::script::source::program::Program;

/// Module of the standard library.
#[derive(Debug)]
pub struct Module {
    /// Name in an import.
    pub name: &'static str,
    /// File name in messages.
    pub file: &'static str,
    /// Source text.
    pub text: &'static str,
}

macro_rules! module {
    ($name:literal) => {
        Module {
            name: concat!("std/", $name),
            file: concat!("std/", $name, ".rhai"),
            text: include_str!(concat!("../../../stdlib/", $name, ".rhai")),
        }
    };
}

/// All modules of the standard library, in the order of the documentation.
pub const MODULES: &[Module] = &[
    module!("sections"),
    module!("shapes"),
    module!("schedules"),
    module!("mechanisms"),
    module!("checks"),
    module!("comparisons"),
];

impl Module {
    /// Source text as a program.
    pub fn program(&self) -> Program {
        Program::named(self.file, self.text)
    }
}

/// Module for an import path, with or without `.rhai`; `None` for files in the folder of the script.
///
/// # Errors
/// Fails if the path belongs to the library but the module does not exist.
pub fn find(path: &str) -> Option<Result<&'static Module, ScriptError>> {
    let name = path.strip_suffix(".rhai").unwrap_or(path);
    if !name.starts_with(FOLDER) {
        return None;
    }
    let known = MODULES.iter().find(|module| module.name == name);
    Some(known.ok_or_else(|| unknown(name)))
}

fn unknown(name: &str) -> ScriptError {
    let names: Vec<_> = MODULES.iter().map(|module| module.name).collect();
    let meant = nearest(name, names.iter().copied());
    let meant = meant.map(|near| format!("did you mean \"{near}\"? ")).unwrap_or_default();
    ScriptError::new(format!("the library has no module \"{name}\""))
        .hint(format!("{meant}it has {}; your own folder cannot be called std", names.join(", ")))
}
