//! What functions decide by parameters: where they jump depends on these then, and derivatives do not follow.

use std::collections::BTreeSet;

use rhai::{AST, ASTNode, Dynamic, Expr, FnPtr, Map, NativeCallContext, Position, Stmt};

use super::call::{body_of, definition_of};
use super::lifting::Varied;
use crate::script::source::syntax::OWN;
use crate::script::state::context::Context;

/// Operators and functions that jump where their arguments change a little.
const JUMPS: &[&str] =
    &["<", ">", "<=", ">=", "==", "!=", "%", "floor", "ceiling", "round", "int", "quotient"];

/// Tells once, with its place, of a comparison in a function among some values that holds what the function is asked at against something that depends on a
/// parameter of a scene.
pub fn tell(native: &NativeCallContext, context: &Context, given: &[Dynamic]) {
    given.iter().for_each(|value| tell_of(native, context, value));
}

fn tell_of(native: &NativeCallContext, context: &Context, value: &Dynamic) {
    if let Some(map) = value.read_lock::<Map>() {
        return map.values().for_each(|element| tell_of(native, context, element));
    }
    let Some(function) = value.read_lock::<FnPtr>() else { return };
    let family = function.curry().iter().find_map(Varied::family_of);
    let Some(family) = family else { return };
    let Some(found) = Decision::find(native, &function) else { return };
    let (line, column) = (found.at.line().unwrap_or(0), found.at.position().unwrap_or(0));
    if family.is_told_first(line, column) {
        let Decision { parameter, sign, .. } = found;
        context.tell(&format!(
            "note: line {line}, column {column}: {sign} decides by '{parameter}', which depends on a parameter: where the function jumps there, derivatives are wrong; give \
             numbers that do not, or value_of(…)"
        ));
    }
}

/// A comparison of what a function is asked at with something that depends on a parameter.
struct Decision {
    /// The variable that depends on the parameter.
    parameter: String,
    /// The operator or function.
    sign: String,
    at: Position,
}

impl Decision {
    /// The first one in a function.
    fn find(native: &NativeCallContext, function: &FnPtr) -> Option<Self> {
        let names = definition_of(native, function)?.params.clone();
        let (captured, own) = names.split_at(function.curry().len().min(names.len()));
        let is_varied = |value: &Dynamic| Varied::family_of(value).is_some();
        let pairs = captured.iter().zip(function.curry());
        let mut varied: BTreeSet<String> =
            pairs.filter(|(_, value)| is_varied(value)).map(|(name, _)| name.to_string()).collect();
        let mut asked: BTreeSet<String> = own.iter().map(ToString::to_string).collect();
        let body: AST = body_of(native, function);
        let mut found = None;
        body.walk(&mut |path: &[ASTNode]| {
            match path.last() {
                // What is made of such a value is one too.
                Some(ASTNode::Stmt(Stmt::Var(of, ..))) => {
                    for names in [&mut varied, &mut asked] {
                        if first_of(&of.1, names).is_some() {
                            names.insert(of.0.name.to_string());
                        }
                    }
                }
                Some(ASTNode::Expr(Expr::FnCall(call, at))) => {
                    let sign = call.name.trim_start_matches(OWN);
                    let one_of = |names: &BTreeSet<String>| {
                        call.args.iter().find_map(|argument| first_of(argument, names))
                    };
                    if JUMPS.contains(&sign)
                        && let (Some(parameter), Some(_)) = (one_of(&varied), one_of(&asked))
                    {
                        found = Some(Self { parameter, sign: sign.to_owned(), at: *at });
                    }
                }
                _ => {}
            }
            found.is_none()
        });
        found
    }
}

/// The first of some variables that an expression reads.
fn first_of(expression: &Expr, names: &BTreeSet<String>) -> Option<String> {
    let mut found = None;
    expression.walk(&mut Vec::new(), &mut |path: &[ASTNode]| {
        if let Some(ASTNode::Expr(Expr::Variable(variable, ..))) = path.last()
            && names.contains(variable.1.as_str())
        {
            found = Some(variable.1.to_string());
        }
        found.is_none()
    });
    found
}
