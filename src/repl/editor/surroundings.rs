//! What the editor may know of the session.

use std::path::PathBuf;

use crate::script::rows::catalog::Catalog;

/// What can be completed and hinted besides the syntax of the language: a picture of the session as it was when the prompt
/// appeared. A session takes one before each line; it holds names only, so it is small however large the values are.
#[derive(Clone)]
pub struct Surroundings {
    /// The language.
    pub catalog: Catalog,
    /// Variables and constants of the session.
    pub variables: Vec<Variable>,
    /// Functions defined in the session.
    pub functions: Vec<Function>,
    /// Imported modules.
    pub modules: Vec<Module>,
    /// What can be written after `:`.
    pub commands: Vec<CommandWord>,
    /// Columns of the history of the last simulation.
    pub columns: Vec<String>,
    /// The folder in which names of files begin.
    pub folder: PathBuf,
}

/// A variable of the session.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: String,
    /// Its type in the words of the language: `simulation`, `number`, `map`, …
    pub of: String,
    /// The keys of a map; none of anything else.
    pub keys: Vec<String>,
}

/// A script function.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Function {
    /// Its name.
    pub name: String,
    /// The names of its parameters.
    pub parameters: Vec<String>,
    /// One line on what it does; may be empty.
    pub summary: String,
    /// The keys of its options, each with what is said about it.
    pub keys: Vec<(String, String)>,
}

/// An imported module.
#[derive(Clone, Debug, PartialEq)]
pub struct Module {
    /// What stands before `::`.
    pub alias: String,
    /// What stands after it.
    pub functions: Vec<Function>,
}

/// A command of the prompt.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CommandWord {
    /// How it is written, with its colon: `:step`.
    pub name: &'static str,
    /// One line on what it does.
    pub summary: &'static str,
    /// What is written after it.
    pub operand: Operand,
}

/// What is written after a command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operand {
    /// Nothing.
    Nothing,
    /// A name of the language.
    Name,
    /// The name of a file.
    File,
    /// An expression.
    Expression,
    /// Columns of the history, or expressions that make curves.
    Curves,
    /// A number.
    Number,
}

impl Surroundings {
    /// Those of a session in which nothing has happened.
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
