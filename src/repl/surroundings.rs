//! Session data for the editor.

use rhai::{Dynamic, Map};

use super::commands::COMMANDS;
use super::editor::surroundings::{
    CommandWord, CompletionContext, ImportedModule, ScriptFunction, Variable,
};
use super::shell::Shell;
use crate::script::library::{ModuleFunction, page_of};

impl Shell {
    /// Names that the next input of the session can use.
    pub fn surroundings(&self) -> CompletionContext {
        let session = self.session();
        let variable = |(name, _, value): (&str, bool, &Dynamic)| Variable {
            name: name.to_owned(),
            of: session.engine().map_type_name(value.type_name()).to_owned(),
            keys: keys_of(value),
        };
        let function = |function: rhai::ScriptFnMetadata| ScriptFunction {
            name: function.name.to_owned(),
            parameters: function.params.iter().map(|name| (*name).to_owned()).collect(),
            summary: "a function of this session".into(),
            ..ScriptFunction::default()
        };
        let definition = |function: &rhai::Shared<rhai::ScriptFuncDef>| ScriptFunction {
            name: function.name.to_string(),
            parameters: function.params.iter().map(ToString::to_string).collect(),
            summary: "a function of an imported file".into(),
            ..ScriptFunction::default()
        };
        let of_library = |function: &ModuleFunction| ScriptFunction {
            name: function.name().to_owned(),
            parameters: function.parameters.clone(),
            summary: function.summary().replace('`', ""),
            keys: function.keys(),
        };
        let module = |(alias, module): (&str, &rhai::Module)| ImportedModule {
            alias: alias.to_owned(),
            functions: match module.id().and_then(page_of) {
                Some(page) => page.functions.iter().map(of_library).collect(),
                None => module
                    .iter_script_fn_info()
                    .map(|(.., function)| definition(function))
                    .collect(),
            },
        };
        CompletionContext {
            catalog: session.catalog().clone(),
            variables: session.variables().iter_raw().map(variable).collect(),
            functions: session.functions().map(function).collect(),
            modules: session.modules().map(module).collect(),
            commands: COMMANDS
                .iter()
                .map(|command| CommandWord {
                    name: command.name,
                    summary: command.summary,
                    operand: command.operand,
                })
                .collect(),
            columns: self.columns(),
            folder: session.folder().to_owned(),
        }
    }

    fn columns(&self) -> Vec<String> {
        self.latest().map_or_else(Vec::new, |latest| {
            let simulation = latest.simulation();
            simulation.history().columns().map(|(name, _)| name.to_owned()).collect()
        })
    }
}

fn keys_of(value: &Dynamic) -> Vec<String> {
    let map = value.read_lock::<Map>();
    map.map_or_else(Vec::new, |map| map.keys().map(ToString::to_string).collect())
}
