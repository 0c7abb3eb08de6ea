//! What the editor may know of the session.

use std::path::PathBuf;

use crate::script::bindings::catalog::Catalog;

/// What can be completed and hinted besides the syntax of the language: a picture of the session as it was when the prompt
/// appeared. A session takes one before each line; it holds names only, so it is small however large the values are.
#[derive(Clone)]
pub struct CompletionContext {
    /// The language of the session.
    pub catalog: Catalog,
    /// The variables and constants of the session.
    pub variables: Vec<Variable>,
    /// The functions defined in the session.
    pub functions: Vec<ScriptFunction>,
    /// The modules imported into the session.
    pub modules: Vec<ImportedModule>,
    /// The commands that can be written after `:`.
    pub commands: Vec<CommandWord>,
    /// The columns of the history of the last simulation.
    pub columns: Vec<String>,
    /// The folder in which names of files begin.
    pub folder: PathBuf,
}

/// A variable of the session.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// The name of the variable.
    pub name: String,
    /// The type of the variable in the words of the language: `simulation`, `number`, `map`, …
    pub of: String,
    /// The keys of a variable that holds a map; none of anything else.
    pub keys: Vec<String>,
}

/// A script function of the session or of a module.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ScriptFunction {
    /// The name of the script function.
    pub name: String,
    /// The names of the script function's parameters.
    pub parameters: Vec<String>,
    /// One line on what the script function does; may be empty.
    pub summary: String,
    /// The keys of the script function's options, each with what is said about it.
    pub keys: Vec<(String, String)>,
}

/// A module imported into the session.
#[derive(Clone, Debug, PartialEq)]
pub struct ImportedModule {
    /// The name of the module before `::`.
    pub alias: String,
    /// The functions of the module, which are named after `::`.
    pub functions: Vec<ScriptFunction>,
}

/// A command of the prompt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandWord {
    /// The command as it is written, with its colon: `:step`.
    pub name: &'static str,
    /// One line on what the command does.
    pub summary: &'static str,
    /// What is written after the command.
    pub operand: CommandOperand,
}

/// What is written after a command of the prompt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CommandOperand {
    /// Nothing is written after the command.
    Nothing,
    /// A name of the language is written after the command.
    Name,
    /// The name of a file is written after the command.
    File,
    /// An expression is written after the command.
    Expression,
    /// Columns of the history, or expressions that make curves, are written after the command.
    Curves,
    /// A number is written after the command.
    Number,
    /// One of these words is written after the command.
    OneOf(&'static [&'static str]),
    /// An expression, or a map of the options that stand where this call, cut off, ends, is written after the command.
    OptionsOf(&'static str),
}

impl CompletionContext {
    /// The surroundings of a session in which nothing has happened.
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
