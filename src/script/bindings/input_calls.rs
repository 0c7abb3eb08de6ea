//! Calls of `input` in a syntax tree, with the arguments that are known before the script runs.

use rhai::{AST, ASTNode, Dynamic, Expr, FnCallExpr, Module, Position, Stmt};

pub const INPUT: &str = "input";

pub struct InputCall {
    /// Name of the input; `None` if it is computed.
    pub name: Option<String>,
    /// Arguments; `None` if one of them is computed.
    pub arguments: Option<Vec<Dynamic>>,
    pub position: Position,
}

pub fn input_calls(ast: &AST) -> Vec<InputCall> {
    let mut found = Vec::new();
    ast.walk(&mut |path: &[ASTNode]| {
        let called = match path.last() {
            Some(
                ASTNode::Stmt(Stmt::FnCall(called, at)) | ASTNode::Expr(Expr::FnCall(called, at)),
            ) => Some((called, *at)),
            _ => None,
        };
        let is_input = |called: &FnCallExpr| {
            called.name == INPUT && !called.is_qualified() && matches!(called.args.len(), 2 | 3)
        };
        if let Some((called, position)) = called.filter(|(called, _)| is_input(called)) {
            let value = |of: &Expr| of.get_literal_value(None);
            let arguments: Option<Vec<Dynamic>> = called.args.iter().map(value).collect();
            let name = called.args.first().and_then(value);
            let name = name.and_then(|name| name.into_string().ok());
            found.push(InputCall { name, arguments, position });
        }
        true
    });
    found.sort_by_key(|call| (call.position.line(), call.position.position()));
    found
}

pub fn names_in_statements(ast: &AST) -> Vec<String> {
    let statements = AST::new(ast.statements().to_vec(), Module::new());
    names_in(&statements)
}

pub fn names_in_functions(ast: &AST) -> Vec<String> {
    names_in(&ast.clone_functions_only())
}

fn names_in(ast: &AST) -> Vec<String> {
    input_calls(ast).into_iter().filter_map(|call| call.name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn input_names_in_statements_and_functions_are_distinguished() {
        let text = "let a = input(\"a\", 1); let f = |x| x + input(\"b\", [1, -2]);
            fn g() { input(\"c\", f(1)) } input(\"one\"); m::input(\"other\", 1); input(x, 1);";
        let ast = rhai::Engine::new().compile(text).expect("a script");
        assert_eq!(names_in_statements(&ast), ["a"]);
        assert_eq!(names_in_functions(&ast), ["b", "c"]);
        let calls = input_calls(&ast);
        let known: Vec<_> = calls.iter().map(|call| call.arguments.is_some()).collect();
        assert_eq!(known, [true, true, false, false], "a, b, c, x");
        assert!(calls[3].name.is_none());
    }
}
