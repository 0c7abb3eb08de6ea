//! A session for the tests of the editor: the flying spaghetti, half built.

use super::surroundings::{CommandWord, Function, Module, Operand, Surroundings, Variable};
use crate::script::packages::language;

/// The names of a session for tests: a beam, a simulation, functions, modules.
pub fn surroundings() -> Surroundings {
    let variable = |name: &str, of: &str, keys: &[&str]| Variable {
        name: name.into(),
        of: of.into(),
        keys: keys.iter().map(|key| (*key).to_owned()).collect(),
    };
    let function = |name: &str, parameters: &[&str]| Function {
        name: name.into(),
        parameters: parameters.iter().map(|parameter| (*parameter).to_owned()).collect(),
        ..Function::default()
    };
    let command = |name, summary, operand| CommandWord { name, summary, operand };
    let columns = ["t", "kinetic", "strain", "energy", "ring.force"];
    Surroundings {
        variables: vec![
            variable("scene", "scene", &[]),
            variable("rod", "beam", &[]),
            variable("rod_end", "station", &[]),
            variable("sim", "simulation", &[]),
            variable("settings", "map", &["dt", "spans", "two words"]),
            variable("values", "array", &[]),
        ],
        functions: vec![function("swing", &["angle", "speed"])],
        modules: vec![Module {
            alias: "shapes".into(),
            functions: vec![
                Function {
                    summary: "An arch.".into(),
                    keys: vec![("rise".into(), "its height".into()), ("span".into(), "".into())],
                    ..function("arch", &["rise"])
                },
                function("arc_of", &[]),
            ],
        }],
        commands: vec![
            command(":help", "Shows what a name does.", Operand::Name),
            command(":step", "Takes steps.", Operand::Number),
            command(":save", "Writes the session as a script.", Operand::File),
            command(":show", "Draws the beam.", Operand::Nothing),
            command(":plot", "Draws columns.", Operand::Curves),
            command(":time", "Measures an expression.", Operand::Expression),
        ],
        columns: columns.map(str::to_owned).into(),
        ..Surroundings::of_language(language())
    }
}
