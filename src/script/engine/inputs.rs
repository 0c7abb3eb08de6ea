//! Declaration of inputs before a script runs, from calls of `input` with literal arguments.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use rhai::{AST, Dynamic, Engine, EvalAltResult, FnPtr, Position};

use super::parse::parse;
use crate::script::bindings::input_calls::{INPUT, input_calls};
use crate::script::bindings::sources::FOLDER;
use crate::script::messages::error::EngineResult;
use crate::script::source::program::{LARGEST_SCRIPT, Program};
use crate::script::source::text::Source;
use crate::script::state::context::Context;
use crate::script::state::files::{InputFolder, InputFolders};

#[derive(Default)]
struct FoundInputs {
    names: Vec<String>,
    /// True if the script may have further inputs, because a name of an input or a path of an import is computed.
    are_incomplete: bool,
    imported: HashSet<PathBuf>,
}

/// Declares the inputs of a script and of its imported files that are known before it runs, and returns their names.
///
/// # Errors
/// Fails if a value is given that is not allowed, or that belongs to no input.
pub fn declare_inputs(
    engine: &Engine,
    context: &Context,
    (ast, text): (&AST, &Source),
    folder: &Path,
) -> EngineResult<Vec<String>> {
    let mut found = FoundInputs::default();
    found.declare(engine, ast)?;
    if !context.inputs().are_defaults() {
        found.declare_imported(engine, text, folder)?;
    }
    if !found.are_incomplete {
        expect_declared(context, &found.names)?;
    }
    Ok(found.names)
}

/// Checks that all inputs that are set belong to the script. `also` contains further names that count as inputs.
///
/// # Errors
/// Fails if an input is set that the script does not have.
pub fn expect_declared(context: &Context, also: &[String]) -> EngineResult<()> {
    context.inputs().expect_declared(also).map_err(|error| error.into_engine(Position::NONE))
}

impl FoundInputs {
    fn declare(&mut self, engine: &Engine, ast: &AST) -> EngineResult<()> {
        for call in input_calls(ast) {
            match call.name {
                Some(name) => self.names.push(name),
                None => self.are_incomplete = true,
            }
            if let Some(arguments) = call.arguments {
                let declare = FnPtr::new(INPUT)?;
                let declared: EngineResult<Dynamic> =
                    declare.call(engine, &AST::empty(), arguments);
                if let Err(mut error) = declared {
                    error.set_position(call.position);
                    return Err(error);
                }
            }
        }
        Ok(())
    }

    fn declare_imported(
        &mut self,
        engine: &Engine,
        text: &Source,
        folder: &Path,
    ) -> EngineResult<()> {
        for path in text.imports() {
            let Some(path) = path else {
                self.are_incomplete = true;
                continue;
            };
            // Files that cannot be read are reported when the script imports them.
            let Some(program) = imported(folder, path) else { continue };
            if !self.imported.insert(PathBuf::from(&program.name)) {
                continue;
            }
            let declared = parse(engine, &program).and_then(|ast| self.declare(engine, &ast));
            declared.map_err(|error| {
                let name = program.name.clone();
                Box::new(EvalAltResult::ErrorInModule(name, error, Position::NONE))
            })?;
            self.declare_imported(engine, &program.text, folder)?;
        }
        Ok(())
    }
}

fn imported(folder: &Path, path: &str) -> Option<Program> {
    if path.starts_with(FOLDER) {
        return None;
    }
    let file = if path.ends_with(".rhai") { path.to_owned() } else { format!("{path}.rhai") };
    let folders = InputFolders::new([InputFolder::in_folder_of(folder)]);
    let content = folders.read(&file, LARGEST_SCRIPT).ok()?;
    let shown = if folder == Path::new(".") { file.into() } else { folder.join(file) };
    Program::from_bytes(&shown, content).ok()
}
