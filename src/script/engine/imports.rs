//! Imports of library modules, named `std/…`, and of files in the folder of the script.

use std::cell::RefCell;
use std::collections::HashMap;
use std::path::{Path, PathBuf};

use rhai::{
    Engine, EvalAltResult, GlobalRuntimeState, Module, ModuleResolver, Position, Scope, Shared,
};

use super::parse::parse;
use crate::script::bindings::sources::Sources;
use crate::script::library;
use crate::script::messages::error::ScriptError;
use crate::script::source::program::{LARGEST_SCRIPT, Program};
use crate::script::state::context::Context;
use crate::script::state::files::{InputFolder, InputFolders};

const LONGEST_CHAIN: usize = 50;

/// Module resolver for the library and a folder, with a cache and detection of circular imports.
pub struct FolderResolver {
    folder: PathBuf,
    context: Context,
    inputs: InputFolders,
    being_read: RefCell<Vec<PathBuf>>,
    read: RefCell<HashMap<PathBuf, ReadModule>>,
}

/// Module with the content of its file when it was read, because files may change during a session.
struct ReadModule {
    content: Vec<u8>,
    module: Shared<Module>,
}

impl FolderResolver {
    pub fn new(folder: &Path, context: &Context) -> Self {
        let inputs = InputFolders::new([InputFolder::in_folder_of(folder)]);
        Self {
            folder: folder.to_owned(),
            context: context.clone(),
            inputs: inputs.recording(context.files_read()),
            being_read: RefCell::default(),
            read: RefCell::default(),
        }
    }

    fn find(&self, name: &str) -> Result<(PathBuf, PathBuf, Vec<u8>), ScriptError> {
        let file = if name.ends_with(".rhai") { name.to_owned() } else { format!("{name}.rhai") };
        let content = self.inputs.read(&file, LARGEST_SCRIPT).map_err(|error| {
            error.hint("import searches for NAME.rhai in the folder of the script and below")
        })?;
        let path: PathBuf = Path::new(&file).components().collect();
        let shown =
            if self.folder == Path::new(".") { file.into() } else { self.folder.join(file) };
        Ok((shown, path, content))
    }

    fn load_library(
        &self,
        engine: &Engine,
        global: &mut GlobalRuntimeState,
        of: &library::Module,
        position: Position,
    ) -> Result<Shared<Module>, Box<EvalAltResult>> {
        let file = PathBuf::from(of.file);
        if let Some(read) = self.read.borrow().get(&file) {
            return Ok(Shared::clone(&read.module));
        }
        let ast = parse(engine, &of.program())?;
        let module = Module::eval_ast_as_new_raw(engine, &mut Scope::new(), global, &ast).map_err(
            |error| Box::new(EvalAltResult::ErrorInModule(of.file.into(), error, position)),
        )?;
        let module = Shared::new(library::with_entry_wrappers(&module, &ast, of.file));
        let read = ReadModule { content: Vec::new(), module: Shared::clone(&module) };
        self.read.borrow_mut().insert(file, read);
        Ok(module)
    }

    /// Returns true if the variables of imported files depend on inputs, and may therefore differ between runs of a study.
    fn varies(&self, engine: &Engine) -> bool {
        self.context.has_parameters() && Sources::of(engine).imports_have_inputs()
    }

    fn refuse_chain(&self, name: &str, file: &PathBuf) -> Result<(), ScriptError> {
        let being_read = self.being_read.borrow();
        if being_read.contains(file) {
            return Err(ScriptError::new(format!("'{name}' imports itself"))
                .hint("move the common parts of both files to a third one"));
        }
        if being_read.len() >= LONGEST_CHAIN {
            let message = format!("more than {LONGEST_CHAIN} files import each other in a chain");
            return Err(ScriptError::new(message).hint("import them beside each other"));
        }
        Ok(())
    }

    fn load(
        &self,
        engine: &Engine,
        global: &mut GlobalRuntimeState,
        file: &Path,
        content: Vec<u8>,
        position: Position,
    ) -> Result<Shared<Module>, Box<EvalAltResult>> {
        Sources::of(engine).record_import(&file.display().to_string(), &content);
        let program = Program::from_bytes(file, content).map_err(|refused| {
            let refusal = ScriptError::new(refused.message);
            refusal.into_engine(position)
        })?;
        let module = parse(engine, &program)
            .and_then(|ast| Module::eval_ast_as_new_raw(engine, &mut Scope::new(), global, &ast))
            .map_err(|error| {
                Box::new(EvalAltResult::ErrorInModule(program.name.clone(), error, position))
            })?;
        Ok(module.into())
    }
}

impl ModuleResolver for FolderResolver {
    fn resolve(
        &self,
        engine: &Engine,
        _source: Option<&str>,
        path: &str,
        position: Position,
    ) -> Result<Shared<Module>, Box<EvalAltResult>> {
        let mut global = engine.new_global_runtime_state();
        self.resolve_raw(engine, &mut global, &mut Scope::new(), path, position)
    }

    fn resolve_raw(
        &self,
        engine: &Engine,
        global: &mut GlobalRuntimeState,
        _scope: &mut Scope,
        path: &str,
        position: Position,
    ) -> Result<Shared<Module>, Box<EvalAltResult>> {
        let refused = |error: ScriptError| error.into_engine(position);
        if let Some(module) = library::find(path) {
            return self.load_library(engine, global, module.map_err(refused)?, position);
        }
        let (shown, file, content) = self.find(path).map_err(refused)?;
        self.refuse_chain(path, &file).map_err(refused)?;
        let known = self.read.borrow();
        if let Some(read) = known.get(&file).filter(|read| read.content == content)
            && !self.varies(engine)
        {
            return Ok(Shared::clone(&read.module));
        }
        drop(known);
        self.being_read.borrow_mut().push(file.clone());
        let module = self.load(engine, global, &shown, content.clone(), position);
        self.being_read.borrow_mut().pop();
        let module = module?;
        if !self.varies(engine) {
            let read = ReadModule { content, module: Shared::clone(&module) };
            self.read.borrow_mut().insert(file, read);
        }
        Ok(module)
    }
}
