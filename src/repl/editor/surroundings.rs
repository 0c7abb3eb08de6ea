//! Session data that the editor uses.

use std::path::PathBuf;

use crate::script::bindings::catalog::Catalog;

/// Names of a session for completion and hints, without the values of variables.
#[derive(Clone)]
pub struct CompletionContext {
    /// Catalog of the names of the language.
    pub catalog: Catalog,
    /// Variables and constants of the session.
    pub variables: Vec<Variable>,
    /// Functions defined in the session.
    pub functions: Vec<ScriptFunction>,
    /// Modules imported into the session.
    pub modules: Vec<ImportedModule>,
    /// Commands of the prompt.
    pub commands: Vec<CommandWord>,
    /// History columns of the last simulation.
    pub columns: Vec<String>,
    /// Folder to which file names are relative.
    pub folder: PathBuf,
}

/// Variable of the session.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name of the variable.
    pub name: String,
    /// Type name in the language, such as `simulation`, `number` or `map`.
    pub of: String,
    /// Keys of a map; empty for other values.
    pub keys: Vec<String>,
}

/// Script function of the session or of a module.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScriptFunction {
    /// Name of the function.
    pub name: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// One-line summary of the function; may be empty.
    pub summary: String,
    /// Keys of the options of the function, with their descriptions.
    pub keys: Vec<(String, String)>,
}

/// Module that the session has imported.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedModule {
    /// Name of the module in scripts, before `::`.
    pub alias: String,
    /// Functions of the module.
    pub functions: Vec<ScriptFunction>,
}

/// Command of the prompt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandWord {
    /// Command as it is typed, with its colon, such as `:step`.
    pub name: &'static str,
    /// One-line summary of the command.
    pub summary: &'static str,
    /// Type of the operand.
    pub operand: CommandOperand,
}

/// Type of the operand of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOperand {
    /// No operand.
    Nothing,
    /// Name of the language, for example a function.
    Name,
    /// File name.
    File,
    /// Expression of the language.
    Expression,
    /// Columns of the history, or expressions that define curves.
    Curves,
    /// A number.
    Number,
    /// One of the given words, such as `on` and `off`.
    OneOf(&'static [&'static str]),
    /// Expression or map of options, which is completed like the next argument of the given unfinished call.
    OptionsOf(&'static str),
}

impl CompletionContext {
    /// Names in an empty session.
    pub fn of_language(catalog: Catalog) -> Self {
        Self {
            catalog,
            variables: Vec::new(),
            functions: Vec::new(),
            modules: Vec::new(),
            commands: Vec::new(),
            columns: Vec::new(),
            folder: PathBuf::from("."),
        }
    }

    /// Variable with this name.
    pub fn variable(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.name == name)
    }
}
