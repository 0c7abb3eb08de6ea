//! Native wrappers of library functions, which store the calling line to report a failed check at the user's line.

use std::any::TypeId;

use rhai::{
    AST, Dynamic, EvalAltResult, FnAccess, FnPtr, FuncRegistration, Module, NativeCallContext,
    RhaiFunc, ScriptFuncDef, Shared,
};

use crate::script::bindings::sources::Sources;
use crate::script::messages::error::BUG;

#[derive(Clone)]
struct ModuleScope {
    file: String,
    functions: Shared<Module>,
    imports: Vec<(String, Shared<Module>)>,
}

/// Wraps the public functions of `module`, which was compiled from the syntax tree `ast`.
pub fn with_entry_wrappers(module: &Module, ast: &AST, file: &str) -> Module {
    let imports = module.iter_sub_modules().map(|(name, other)| (name.to_owned(), other.clone()));
    let surroundings = ModuleScope {
        file: file.to_owned(),
        functions: ast.shared_lib().clone(),
        imports: imports.collect(),
    };
    let mut outside = Module::new();
    let functions: &Module = ast.as_ref();
    for known in ast.iter_functions().filter(|known| known.access == FnAccess::Public) {
        if let Some(function) = functions.get_script_fn(known.name, known.params.len()) {
            add(&mut outside, function.clone(), surroundings.clone());
        }
    }
    for (name, value) in module.iter_var() {
        outside.set_var(name, value.clone());
    }
    outside.set_id(file);
    outside.build_index();
    outside
}

fn add(module: &mut Module, function: Shared<ScriptFuncDef>, surroundings: ModuleScope) {
    let types = vec![TypeId::of::<Dynamic>(); function.params.len()];
    let name = function.name.clone();
    let enter = move |native: Option<NativeCallContext>, values: &mut [&mut Dynamic]| {
        let values: Vec<Dynamic> = values.iter().map(|value| (**value).clone().flatten()).collect();
        let native = native.ok_or_else(|| {
            EvalAltResult::ErrorSystem("a function was called from nowhere".into(), BUG.into())
        })?;
        surroundings.call(&native, FnPtr::from(function.clone()), values)
    };
    let native = RhaiFunc::Pure {
        func: Shared::new(enter),
        has_context: true,
        is_pure: true,
        is_volatile: true,
    };
    FuncRegistration::new(name).set_into_module_raw(module, types, native);
}

impl ModuleScope {
    fn call(
        &self,
        native: &NativeCallContext,
        function: FnPtr,
        values: Vec<Dynamic>,
    ) -> Result<Dynamic, Box<EvalAltResult>> {
        let sources = Sources::of(native.engine());
        let at = native.call_position();
        let _inside = sources.enter_library(native.global_runtime_state().source(), at.line());
        let mut inside = native.global_runtime_state().clone();
        inside.lib.insert(0, self.functions.clone());
        inside.lib.push(self.functions.clone());
        inside.source = Some(self.file.as_str().into());
        for (name, module) in &self.imports {
            inside.push_import(name.as_str(), module.clone());
        }
        let name = function.fn_name().to_owned();
        let context = (native.engine(), name.as_str(), None, &inside, at).into();
        function.call_raw(&context, None, values)
    }
}
