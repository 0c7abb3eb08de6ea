//! Boundaries between the statements of an input, found by parsing parts of its text, because the engine does not report them.

use rhai::{AST, ASTFlags, ASTNode, Engine, Scope, Stmt, Token};

use crate::script::bindings::sources::Sources;
use crate::script::dialect::reading::read;
use crate::script::source::text::Source;

/// Number of statements in a text, not counting functions; `None` if the text has a syntax error.
pub fn count(engine: &Engine, text: &str) -> Option<usize> {
    read(engine, &Scope::new(), &text.into(), 0).ok().map(|ast| ast.statements().len())
}

pub fn boundary(engine: &Engine, text: &str, first: usize) -> Option<usize> {
    Sources::of(engine).undisturbed(|| boundary_of(engine, text, first))
}

fn boundary_of(engine: &Engine, text: &str, first: usize) -> Option<usize> {
    let all = count(engine, text)?;
    let is_right = |cut: &usize| {
        let (before, after) = text.split_at(*cut);
        count(engine, before) == Some(first) && count(engine, after) == all.checked_sub(first)
    };
    let source = Source::from(text);
    let ends = source.tokens().iter().filter_map(|lexeme| {
        let ends = matches!(lexeme.0, Token::SemiColon | Token::RightBrace);
        ends.then(|| source.offset_of(lexeme) + 1)
    });
    // Positions within a character, which the engine may report, are skipped.
    let ends = ends.filter(|end| text.is_char_boundary(*end));
    let cuts: Vec<usize> = std::iter::once(0).chain(ends).collect();
    cuts.into_iter().rev().find(is_right)
}

pub fn returns(ast: &AST) -> bool {
    let mut found = false;
    for statement in ast.statements() {
        statement.walk(&mut Vec::new(), &mut |path| {
            if let Some(ASTNode::Stmt(Stmt::Return(_, flags, _))) = path.last() {
                // The engine represents `throw` as a return statement with the flag `BREAK`.
                found |= !flags.intersects(ASTFlags::BREAK);
            }
            true
        });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::script::engine::build;
    use crate::script::packages::language;
    use crate::script::state::context::Context;
    use crate::script::state::settings::{RunMode, RunSettings};

    fn engine() -> Engine {
        let context = Context::new(RunSettings::silent(RunMode::Run));
        build(&language(), &context).expect("an engine")
    }

    #[test]
    fn statement_boundary_is_found() {
        let engine = engine();
        let cut = |text: &'static str, first| {
            boundary(&engine, text, first).map(|cut| text.split_at(cut))
        };
        assert_eq!(cut("a(); (1 + 2) * 3", 1), Some(("a();", " (1 + 2) * 3")));
        assert_eq!(cut("fn f(x) { x; } f(2)", 0), Some(("fn f(x) { x; }", " f(2)")));
        assert_eq!(cut("if a { 1 } else { 2 } b", 1), Some(("if a { 1 } else { 2 }", " b")));
        assert_eq!(cut("let i = { 1 } - 2; i", 1), Some(("let i = { 1 } - 2;", " i")));
        assert_eq!(cut("{ let a = [1]; a?[0]; 3 }", 0), Some(("", "{ let a = [1]; a?[0]; 3 }")));
        assert_eq!(
            cut("// why;\nf(#{ a: 1 });\ng();", 1),
            Some(("// why;\nf(#{ a: 1 });", "\ng();"))
        );
        assert_eq!(cut("1 +", 0), None);
    }

    #[test]
    fn statement_boundary_is_found_after_an_interrupt() {
        let context = Context::new(RunSettings::silent(RunMode::Run));
        let engine = build(&language(), &context).expect("an engine");
        context.interrupt_flag().store(true, std::sync::atomic::Ordering::Relaxed);
        let text = format!("let a = [{}]; loop {{ a }}", "1, ".repeat(100));
        assert_eq!(boundary(&engine, &text, 1), text.find(" loop"));
        assert_eq!(count(&engine, &text), None, "others are stopped");
    }

    #[test]
    fn only_return_statements_outside_functions_are_found() {
        let engine = engine();
        let is_found = |text| returns(&engine.compile(text).expect("a script"));
        assert!(is_found("return 5;") && is_found("if true { return; }"));
        assert!(!is_found("fn f() { return 5; } let g = |x| { return x; }; throw 1;"));
    }
}
