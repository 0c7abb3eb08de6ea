//! Session data that the editor uses.

use std::path::PathBuf;

use crate::script::bindings::catalog::Catalog;

/// Names of a session for completion and hints. They are collected before each prompt. The values of variables are not stored.
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
    /// One-line summary; may be empty.
    pub summary: String,
    /// Keys of the options with their descriptions.
    pub keys: Vec<(String, String)>,
}

/// Module that the session has imported.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedModule {
    /// Name of the module that is written before `::`.
    pub alias: String,
    /// Functions of the module.
    pub functions: Vec<ScriptFunction>,
}

/// Command of the prompt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandWord {
    /// Command in its written form with its colon, such as `:step`.
    pub name: &'static str,
    /// One-line summary.
    pub summary: &'static str,
    /// Type of the operand.
    pub operand: CommandOperand,
}

/// Type of the operand of a command.
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
    /// An expression or a map of options. A map is completed as if it were the next argument of the contained unfinished call.
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
