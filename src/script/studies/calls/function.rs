//! Function that a study calls with named values.

use std::collections::BTreeSet;

use rhai::{AST, ASTNode, Dynamic, Expr, FnPtr, Map, Position, Stmt};

use super::portable::Portable;
use crate::script::bindings::call::{Call, written_within};
use crate::script::bindings::sources::Sources;
use crate::script::engine::workers::EngineConfig;
use crate::script::messages::error::{CallPart, Failure, ScriptError};
use crate::script::messages::nouns::with_article;

#[derive(Clone, Debug)]
pub struct RunFunction {
    pub name: String,
    pub captured: Vec<(String, Portable)>,
    pub extra: Vec<Portable>,
}

pub fn changes(name: &str) -> String {
    format!(
        "it changes the variable '{name}' from outside, which is separate in every run: return \
        the value in the map"
    )
}

struct ParameterReading {
    names: BTreeSet<String>,
    /// True if the function may read any name, because it uses its map of values as a whole.
    is_whole: bool,
}

impl RunFunction {
    /// Reads the function given for an option key.
    ///
    /// # Errors
    /// Fails if the function does not belong to the script, or, at the position of its use, for a captured value that cannot be sent to other threads.
    pub fn read(call: &Call, key: &str, function: &FnPtr) -> Result<Self, ScriptError> {
        let Some(definition) = call.definition(function) else {
            let message = format!(
                "{key} is the function '{}', which is not one of this script",
                function.fn_name()
            );
            let hint = format!("write {key}: |p| …, and call the function in it");
            return Err(call.error(message).hint(hint).at(CallPart::Key(key.to_owned())));
        };
        let parameters_of = |function: &FnPtr| call.definition(function).map(|of| of.params.len());
        let named = definition.params.iter().zip(function.curry());
        let captured =
            named.map(|(name, value)| match Portable::of(call.engine(), value, &parameters_of) {
                Ok(value) => Ok((name.to_string(), value)),
                Err(immovable) => {
                    let kind = with_article(&immovable.kind);
                    let failure = Failure {
                        message: format!(
                            "the function of '{key}' uses the variable '{name}', which holds \
                            {kind} and cannot be copied to other threads"
                        ),
                        hint: Some(
                            "create it inside the function, from the values of the row; \
                            numbers, texts, arrays, maps, vectors, functions, sections, \
                            meshes, curves, integrators and schedules from outside are allowed"
                                .into(),
                        ),
                        place: CallPart::Call,
                    };
                    let at = first_use(&call.body(function), name).unwrap_or(Position::NONE);
                    Err(ScriptError::Engine(ScriptError::Failure(failure).into_engine(at)))
                }
            });
        let captured = captured.collect::<Result<_, _>>()?;
        if let Some(at) = first_print(&call.body(function)) {
            let (line, column) = (at.line().unwrap_or(0), at.position().unwrap_or(0));
            call.context().print_message(&format!(
                "note: line {line}, column {column}: runs of a study do not print: return the \
                value as a result"
            ));
        }
        Ok(Self { name: function.fn_name().to_owned(), captured, extra: Vec::new() })
    }

    pub fn with_extra_argument(
        &mut self,
        call: &Call,
        key: &str,
        value: &Dynamic,
    ) -> Result<(), ScriptError> {
        let parameters_of = |function: &FnPtr| call.definition(function).map(|of| of.params.len());
        let portable = Portable::of(call.engine(), value, &parameters_of).map_err(|immovable| {
            let kind = with_article(&immovable.kind);
            call.error(format!("{key} holds {kind}, which cannot be copied to other threads"))
                .hint("give numbers, texts, arrays and maps of them")
                .at(CallPart::Key(key.to_owned()))
        })?;
        self.extra.push(portable);
        Ok(())
    }

    /// Captured values and arguments of the function on this thread. `function_of` finds functions.
    ///
    /// The result is `None` if a function is not found.
    pub fn arguments(
        &self,
        values: Map,
        function_of: &dyn Fn(&str, usize) -> Option<FnPtr>,
    ) -> Option<(Vec<Dynamic>, Vec<Dynamic>)> {
        let shared =
            |(_, value): &(String, Portable)| Some(value.value(function_of)?.into_shared());
        let captured = self.captured.iter().map(shared).collect::<Option<_>>()?;
        let extra = self.extra.iter().map(|value| value.value(function_of));
        let given = [Some(values.into())].into_iter().chain(extra).collect::<Option<_>>()?;
        Some((captured, given))
    }

    pub fn changed(&self, captured: &[Dynamic]) -> Option<&str> {
        let pairs = self.captured.iter().zip(captured);
        pairs.into_iter().find(|((_, was), is)| !was.is(is)).map(|((name, _), _)| name.as_str())
    }

    /// Calls the function in the engine of the script, with copies of captured values.
    ///
    /// # Errors
    /// Fails with the error of the function and its position, or if the function changes a captured variable.
    pub fn call_here(&self, call: &Call, key: &str, values: Map) -> Result<Dynamic, ScriptError> {
        let function_of = |name: &str, parameters| call.function_named(name, parameters);
        let lost = || ScriptError::internal_error("the function of a study is not found again");
        let (captured, given) = self.arguments(values.clone(), &function_of).ok_or_else(lost)?;
        let count = captured.len() + given.len();
        let mut function = function_of(&self.name, count).ok_or_else(lost)?;
        function.extend(captured.clone());
        let found = call.context().with_parameters(&values, || call.invoke(&function, given))?;
        match self.changed(&captured) {
            None => Ok(found),
            Some(name) => Err(call
                .error(format!("{key}: {}", changes(name)))
                .hint("each run starts with the original values from outside")
                .at(CallPart::Key(key.to_owned()))),
        }
    }

    /// Rejects parameters that the function never reads, as far as this can be determined.
    pub fn expect_read<'n>(
        call: &Call,
        (key, function): (&str, &FnPtr),
        names: impl IntoIterator<Item = &'n str>,
    ) -> Result<(), ScriptError> {
        let Some(unread) = Self::unread(call, function, names) else { return Ok(()) };
        let message = format!("the function of '{key}' does not use the parameter '{unread}'");
        let declared = call.context().inputs().declared();
        let hint = match declared.iter().any(|(of, _)| of.name == unread) {
            true => format!(
                "call input(\"{unread}\", …) inside the function: outside of it the input has one \
                value for all runs"
            ),
            false => format!(
                "use p.{unread} in it, or omit the parameter: all of its values would give the \
                same result"
            ),
        };
        Err(call.error(message).hint(hint).at(CallPart::Key(unread.to_owned())))
    }

    /// First of the names that the function does not read from its map of values, and that are not the names of inputs that it reads.
    /// The result is `None` if there is no such name, if the function passes its map on, or if its definition is unknown.
    fn unread<'n>(
        call: &Call,
        function: &FnPtr,
        names: impl IntoIterator<Item = &'n str>,
    ) -> Option<&'n str> {
        let definition = call.definition(function)?;
        let map = definition.params.get(function.curry().len())?;
        let reading = ParameterReading::of(call, function, map);
        let mut names = names.into_iter();
        names.find(|name| {
            !reading.is_whole && !reading.names.contains(*name) && !is_varied_input(call, name)
        })
    }
}

fn is_varied_input(call: &Call, name: &str) -> bool {
    let sources = Sources::of(call.engine());
    let has_workers = || EngineConfig::of(call.engine(), call.context(), "").is_some();
    sources.functions_have_input(name) || (sources.imports_have_input(name) && has_workers())
}

fn variable(expression: &Expr) -> Option<&str> {
    match expression {
        Expr::Variable(variable, ..) => Some(&variable.1),
        _ => None,
    }
}

fn first_print(body: &AST) -> Option<Position> {
    let mut found = None;
    body.walk(&mut |path: &[ASTNode]| {
        let called = match path.last() {
            Some(
                ASTNode::Stmt(Stmt::FnCall(called, at)) | ASTNode::Expr(Expr::FnCall(called, at)),
            ) => Some((called, *at)),
            _ => None,
        };
        let printed = called.filter(|(called, _)| PRINTING.contains(&called.name.as_str()));
        found = found.or(printed.map(|(_, at)| at));
        found.is_none()
    });
    found
}

const PRINTING: &[&str] = &["print", "debug"];

fn first_use(body: &AST, name: &str) -> Option<Position> {
    let mut found = None;
    body.walk(&mut |path: &[ASTNode]| {
        if let Some(ASTNode::Expr(expression)) = path.last()
            && variable(expression) == Some(name)
        {
            found.get_or_insert(expression.position());
        }
        found.is_none()
    });
    found
}

impl ParameterReading {
    fn of(call: &Call, function: &FnPtr, map: &str) -> Self {
        let mut reading = Self { names: BTreeSet::new(), is_whole: false };
        reading.read(call, function, map);
        reading
    }

    fn read(&mut self, call: &Call, function: &FnPtr, map: &str) {
        let is_map = |expression: &Expr| variable(expression) == Some(map);
        call.body(function).walk(&mut |path: &[ASTNode]| {
            let Some(ASTNode::Expr(expression)) = path.last() else { return true };
            if !is_map(expression) {
                return true;
            }
            let around = path.len().checked_sub(2).map(|at| &path[at]);
            let read = match around {
                Some(ASTNode::Expr(Expr::Dot(of, ..) | Expr::Index(of, ..))) if is_map(&of.lhs) => {
                    name_read(&of.rhs)
                }
                Some(ASTNode::Expr(Expr::FnCall(made, _))) => match written_within(made) {
                    Some((within, _)) => {
                        self.read(call, &within, map);
                        return true;
                    }
                    None => None,
                },
                _ => None,
            };
            match read {
                Some(name) => _ = self.names.insert(name),
                None => self.is_whole = true,
            }
            true
        });
    }
}

/// Key that an access reads from a map. For example, `.mass`, `["mass"]` and `.mass.value` read the key `mass`.
fn name_read(behind: &Expr) -> Option<String> {
    match behind {
        Expr::Property(property, _) => Some(property.2.to_string()),
        Expr::StringConstant(name, _) => Some(name.to_string()),
        Expr::Dot(of, ..) | Expr::Index(of, ..) => name_read(&of.lhs),
        _ => None,
    }
}
