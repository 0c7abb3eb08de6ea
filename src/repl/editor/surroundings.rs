//! Session data that the editor uses.

use std::path::PathBuf;

use crate::script::bindings::catalog::Catalog;

/// Names of a session for completion and hints, collected before each prompt. Values are not stored, so it is small.
#[derive(Clone)]
pub struct CompletionContext {
    /// Catalog of the language.
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
    /// Folder to which relative file names refer.
    pub folder: PathBuf,
}

/// A variable of the session.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Name of the variable.
    pub name: String,
    /// Type name in the language: `simulation`, `number`, `map`, …
    pub of: String,
    /// Keys of a map; empty for other values.
    pub keys: Vec<String>,
}

/// A script function of the session or of a module.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScriptFunction {
    /// Name of the function.
    pub name: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// One-line summary; may be empty.
    pub summary: String,
    /// Keys of the options with their descriptions.
    pub keys: Vec<(String, String)>,
}

/// A module imported into the session.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedModule {
    /// Name of the module before `::`.
    pub alias: String,
    /// Functions of the module.
    pub functions: Vec<ScriptFunction>,
}

/// A command of the prompt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandWord {
    /// Command as written, with its colon: `:step`.
    pub name: &'static str,
    /// One-line summary.
    pub summary: &'static str,
    /// Kind of the operand.
    pub operand: CommandOperand,
}

/// Operand of a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOperand {
    /// No operand.
    Nothing,
    /// A name of the language.
    Name,
    /// A file name.
    File,
    /// An expression.
    Expression,
    /// Columns of the history, or expressions that give curves.
    Curves,
    /// A number.
    Number,
    /// One of these words.
    OneOf(&'static [&'static str]),
    /// An expression or a map of options. A map is completed as the next argument of this unfinished call.
    OptionsOf(&'static str),
}

impl CompletionContext {
    /// Context of an empty session.
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

    /// The variable with this name.
    pub fn variable(&self, name: &str) -> Option<&Variable> {
        self.variables.iter().find(|variable| variable.name == name)
    }
}
