//! Session for tests of the editor: an incomplete script of the flying spaghetti problem.

use super::surroundings::{
    CommandOperand, CommandWord, CompletionContext, ImportedModule, ScriptFunction, Variable,
};
use crate::script::packages::language;

pub fn surroundings() -> CompletionContext {
    let variable = |name: &str, of: &str, keys: &[&str]| Variable {
        name: name.into(),
        of: of.into(),
        keys: keys.iter().map(|key| (*key).to_owned()).collect(),
    };
    let function = |name: &str, parameters: &[&str]| ScriptFunction {
        name: name.into(),
        parameters: parameters.iter().map(|parameter| (*parameter).to_owned()).collect(),
        ..ScriptFunction::default()
    };
    let command = |name, summary, operand| CommandWord { name, summary, operand };
    let columns = ["t", "kinetic", "strain", "energy", "ring.force"];
    CompletionContext {
        variables: vec![
            variable("scene", "scene", &[]),
            variable("rod", "beam", &[]),
            variable("rod_end", "station", &[]),
            variable("sim", "simulation", &[]),
            variable("settings", "map", &["dt", "spans", "two words"]),
            variable("values", "array", &[]),
        ],
        functions: vec![function("swing", &["angle", "speed"])],
        modules: vec![ImportedModule {
            alias: "shapes".into(),
            functions: vec![
                ScriptFunction {
                    summary: "An arch.".into(),
                    keys: vec![("rise".into(), "its height".into()), ("span".into(), "".into())],
                    ..function("arch", &["rise"])
                },
                function("arc_of", &[]),
            ],
        }],
        commands: vec![
            command(":help", "Shows what a name does.", CommandOperand::Name),
            command(":step", "Takes steps.", CommandOperand::Number),
            command(":save", "Writes the session as a script.", CommandOperand::File),
            command(":show", "Draws the beam.", CommandOperand::Nothing),
            command(":plot", "Draws columns.", CommandOperand::Curves),
            command(":time", "Measures an expression.", CommandOperand::Expression),
        ],
        columns: columns.map(str::to_owned).into(),
        ..CompletionContext::of_language(language())
    }
}
