//! Search for branches that depend on a parameter of a scene, in a function and in the functions that it calls or captures.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

use rhai::{ASTNode, BinaryExpr, Dynamic, Expr, FnCallExpr, FnPtr, NativeCallContext, Position};
use rhai::{ScriptFuncDef, Stmt};

use super::jumps::jumps_with_a_parameter;
use crate::script::bindings::call::{body_named, defined, written_within};
use crate::script::bindings::parameter_variants::VariantValue;
use crate::script::source::syntax::OWN;

const JUMPS: &[&str] = &[
    "<", ">", "<=", ">=", "==", "!=", "%", "floor", "ceiling", "round", "round_to", "int",
    "to_int", "fraction", "quotient", "sign", "is_zero",
];

const JUMPING_SCHEDULES: &[&str] = &["pulse", "hold_for", "table"];

const DEEPEST: usize = 8;

/// Maximum number of functions that are searched, because functions may be recursive.
const MOST: usize = 100;

/// Position of a branch whose condition contains the argument of its function and a variable that depends on a parameter.
/// Functions and schedules with jumps also count as branches.
pub(super) struct Decision {
    pub(super) parameter: String,
    pub(super) sign: String,
    pub(super) at: Position,
}

#[derive(Clone, Default)]
struct VariableFacts {
    varied: BTreeSet<String>,
    asked: BTreeSet<String>,
    /// Variables that contain schedules with jumps at times that depend on a parameter.
    jumping: BTreeSet<String>,
    functions: BTreeMap<String, FnPtr>,
}

#[derive(Default)]
struct Facts {
    is_varied: bool,
    is_asked: bool,
    jumps: bool,
    function: Option<FnPtr>,
}

struct BranchSearch<'s, 'n> {
    native: &'s NativeCallContext<'n>,
    depth: usize,
    left: &'s Cell<usize>,
}

impl Decision {
    pub(super) fn find(native: &NativeCallContext, function: &FnPtr) -> Option<Self> {
        let definition = defined(native, function.fn_name(), None)?;
        let (mut known, own) = VariableFacts::of(function, &definition);
        known.asked.extend(own);
        BranchSearch { native, depth: 0, left: &Cell::new(MOST) }.function(&definition, known)
    }
}

impl VariableFacts {
    fn of(function: &FnPtr, definition: &ScriptFuncDef) -> (Self, Vec<String>) {
        let names: Vec<String> = definition.params.iter().map(ToString::to_string).collect();
        let (captured, own) = names.split_at(function.curry().len().min(names.len()));
        let mut known = Self::default();
        for (name, value) in captured.iter().zip(function.curry()) {
            known.record_value(name, value);
        }
        (known, own.to_vec())
    }

    fn record_value(&mut self, name: &str, value: &Dynamic) {
        let facts = Facts {
            is_varied: VariantValue::parameter_set_of(value).is_some(),
            is_asked: false,
            jumps: jumps_with_a_parameter(value),
            function: value.read_lock::<FnPtr>().map(|function| function.clone()),
        };
        self.record_facts(name, facts);
    }

    fn expression_facts(&self, expression: &Expr) -> Facts {
        let function = match expression {
            Expr::Variable(variable, ..) => self.functions.get(variable.1.as_str()).cloned(),
            _ => None,
        };
        Facts {
            is_varied: first_of(expression, &self.varied).is_some(),
            is_asked: first_of(expression, &self.asked).is_some(),
            jumps: self.jumping_in(expression).is_some(),
            function,
        }
    }

    fn record_facts(&mut self, name: &str, facts: Facts) {
        let Facts { is_varied, is_asked, jumps, function } = facts;
        for (names, is_one) in
            [(&mut self.varied, is_varied), (&mut self.asked, is_asked), (&mut self.jumping, jumps)]
        {
            if is_one {
                names.insert(name.to_owned());
            }
        }
        if let Some(function) = function {
            self.functions.insert(name.to_owned(), function);
        }
    }

    fn jumping_in(&self, expression: &Expr) -> Option<String> {
        first_in(expression, |node| match node {
            Expr::Variable(variable, ..) => self.jumping.get(variable.1.as_str()).cloned(),
            Expr::FnCall(call, _) if JUMPING_SCHEDULES.contains(&call.name.as_str()) => {
                call.args.iter().find_map(|of| first_of(of, &self.varied))
            }
            _ => None,
        })
    }

    fn by<'e>(
        &self,
        expressions: impl Iterator<Item = &'e Expr> + Clone,
        sign: &str,
        at: Position,
    ) -> Option<Decision> {
        let parameter = expressions.clone().find_map(|of| first_of(of, &self.varied))?;
        expressions.into_iter().find_map(|of| first_of(of, &self.asked))?;
        Some(Decision { parameter, sign: sign.to_owned(), at })
    }
}

impl BranchSearch<'_, '_> {
    fn function(&self, definition: &ScriptFuncDef, mut known: VariableFacts) -> Option<Decision> {
        if self.depth == DEEPEST || self.left.get() == 0 {
            return None;
        }
        self.left.update(|left| left - 1);
        let mut found = None;
        body_named(self.native, &definition.name, definition.params.len()).walk(
            &mut |path: &[ASTNode]| {
                found = match path.last() {
                    Some(ASTNode::Stmt(statement)) => self.statement(statement, &mut known),
                    Some(ASTNode::Expr(expression)) => self.expression(expression, &known),
                    _ => None,
                };
                found.is_none()
            },
        );
        found
    }

    fn statement(&self, statement: &Stmt, known: &mut VariableFacts) -> Option<Decision> {
        match statement {
            Stmt::Var(of, ..) => {
                known.record_facts(of.0.name.as_str(), known.expression_facts(&of.1))
            }
            Stmt::Assignment(of) => {
                if let Some(name) = root_of(&of.1.lhs) {
                    known.record_facts(name, known.expression_facts(&of.1.rhs));
                }
            }
            Stmt::Switch(of, at) => return known.by([&of.0].into_iter(), "switch", *at),
            Stmt::FnCall(call, at) => return self.call(call, *at, known),
            _ => {}
        }
        None
    }

    fn expression(&self, expression: &Expr, known: &VariableFacts) -> Option<Decision> {
        match expression {
            Expr::FnCall(call, at) => self.call(call, *at, known),
            Expr::Dot(chain, ..) => self.chain(chain, known),
            _ => None,
        }
    }

    fn call(&self, call: &FnCallExpr, at: Position, known: &VariableFacts) -> Option<Decision> {
        let sign = call.name.trim_start_matches(OWN);
        if JUMPS.contains(&sign) {
            return known.by(call.args.iter(), sign, at);
        }
        if let Some((function, captured)) = written_within(call) {
            return self.within(&function, captured, known);
        }
        if let Some(function) = known.functions.get(sign) {
            return self.held(function, &call.args, known);
        }
        let definition = defined(self.native, sign, Some(call.args.len()))?;
        let mut own = VariableFacts::default();
        for (name, argument) in definition.params.iter().zip(&call.args) {
            own.record_facts(name, known.expression_facts(argument));
        }
        self.deeper().function(&definition, own)
    }

    fn chain(&self, chain: &BinaryExpr, known: &VariableFacts) -> Option<Decision> {
        let mut receivers = vec![&chain.lhs];
        let mut rest = &chain.rhs;
        loop {
            let (link, more) = match rest {
                Expr::Dot(both, ..) => (&both.lhs, Some(&both.rhs)),
                last => (last, None),
            };
            if let Expr::MethodCall(call, at) = link {
                let found = self.method(&receivers, (call, *at), known);
                if found.is_some() {
                    return found;
                }
            }
            receivers.push(link);
            rest = more?;
        }
    }

    fn method(
        &self,
        receivers: &[&Expr],
        (call, at): (&FnCallExpr, Position),
        known: &VariableFacts,
    ) -> Option<Decision> {
        let given = receivers.iter().copied().chain(&call.args);
        match call.name.as_str() {
            sign if JUMPS.contains(&sign) => known.by(given, sign, at),
            "at" => {
                let parameter = receivers.iter().find_map(|of| known.jumping_in(of))?;
                call.args.iter().find_map(|of| first_of(of, &known.asked))?;
                Some(Decision { parameter, sign: "at".into(), at })
            }
            "call" => {
                let [Expr::Variable(variable, ..)] = receivers else { return None };
                let function = known.functions.get(variable.1.as_str())?;
                self.held(function, &call.args, known)
            }
            _ => None,
        }
    }

    fn held(
        &self,
        function: &FnPtr,
        arguments: &[Expr],
        known: &VariableFacts,
    ) -> Option<Decision> {
        let definition = defined(self.native, function.fn_name(), None)?;
        let (mut own, names) = VariableFacts::of(function, &definition);
        for (name, argument) in names.iter().zip(arguments) {
            own.record_facts(name, known.expression_facts(argument));
        }
        self.deeper().function(&definition, own)
    }

    fn within(
        &self,
        function: &FnPtr,
        captured: &[Expr],
        known: &VariableFacts,
    ) -> Option<Decision> {
        let definition = defined(self.native, function.fn_name(), None)?;
        let mut own = VariableFacts::default();
        for (at, name) in definition.params.iter().enumerate() {
            match captured.get(at) {
                Some(outer) => own.record_facts(name, known.expression_facts(outer)),
                None => own.record_facts(name, Facts { is_asked: true, ..Facts::default() }),
            }
        }
        self.deeper().function(&definition, own)
    }

    fn deeper(&self) -> Self {
        Self { native: self.native, depth: self.depth + 1, left: self.left }
    }
}

fn root_of(target: &Expr) -> Option<&str> {
    match target {
        Expr::Variable(variable, ..) => Some(variable.1.as_str()),
        Expr::Dot(both, ..) | Expr::Index(both, ..) => root_of(&both.lhs),
        _ => None,
    }
}

fn first_of(expression: &Expr, names: &BTreeSet<String>) -> Option<String> {
    first_in(expression, |node| match node {
        Expr::Variable(variable, ..) => names.get(variable.1.as_str()).cloned(),
        _ => None,
    })
}

fn first_in<T>(expression: &Expr, mut what: impl FnMut(&Expr) -> Option<T>) -> Option<T> {
    let mut found = None;
    expression.walk(&mut Vec::new(), &mut |path: &[ASTNode]| {
        if let Some(ASTNode::Expr(expression)) = path.last() {
            found = what(expression);
        }
        found.is_none()
    });
    found
}
