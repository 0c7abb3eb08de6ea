//! The modules and their texts. None is parsed before a script imports it.

use crate::script::bindings::sources::FOLDER;
use crate::script::messages::error::ScriptError;
use crate::script::messages::suggest::nearest;
use crate::script::source::program::Program;

/// A module of the standard library.
#[derive(Debug)]
pub struct Module {
    /// The name of the module in an import.
    pub name: &'static str,
    /// The file of the module, as messages name it.
    pub file: &'static str,
    /// The text of the module.
    pub text: &'static str,
}

/// Names a file of `stdlib/`.
macro_rules! module {
    ($name:literal) => {
        Module {
            name: concat!("std/", $name),
            file: concat!("std/", $name, ".rhai"),
            text: include_str!(concat!("../../../stdlib/", $name, ".rhai")),
        }
    };
}

/// All modules of the standard library, in the order of their page.
pub const MODULES: &[Module] = &[
    module!("sections"),
    module!("shapes"),
    module!("schedules"),
    module!("mechanisms"),
    module!("checks"),
    module!("comparisons"),
];

impl Module {
    /// The text of the module as a program.
    pub fn program(&self) -> Program {
        Program::named(self.file, self.text)
    }
}

/// The module that an import names, with or without `.rhai`; nothing for files of the script's own folder.
///
/// # Errors
/// The name belongs to the library, but it has no such module.
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
    ScriptError::new(format!("the library has no module \"{name}\"")).hint(format!(
        "{meant}it has {}; a folder of your own cannot be called std",
        names.join(", ")
    ))
}
