//! Parsing of all script texts.
//! Rhai stores lines and columns in 16 bits, and loops and errors are identified by their position, so larger texts are rejected.

use rhai::{AST, Engine, EvalAltResult, Position, Scope};

use crate::script::bindings::sources::Sources;
use crate::script::messages::error::ScriptError;
use crate::script::source::syntax::mark;
use crate::script::source::text::Source;

/// Maximum number of lines of a source, and of characters in a line, slightly below the limit of Rhai.
pub const MOST: usize = 65_000;

/// Parses `source` as the text after the first `lines_before` lines of a program. It may use the constants of `scope`.
pub fn read(
    engine: &Engine,
    scope: &Scope,
    source: &Source,
    lines_before: usize,
) -> Result<AST, Box<EvalAltResult>> {
    refuse_uncountable(source).map_err(|error| error.into_engine(Position::NONE))?;
    let sources = Sources::of(engine);
    sources.begin_reading();
    let placed = format!("{}{}", "\n".repeat(lines_before), mark(source));
    let parsed = engine.compile_with_scope(scope, placed);
    match sources.reading_stopped() {
        Some(stop) => Err(ScriptError::Stopped(stop).into_engine(Position::NONE)),
        None => Ok(parsed?),
    }
}

fn refuse_uncountable(source: &str) -> Result<(), ScriptError> {
    let mut lines = 0;
    for line in source.split('\n') {
        lines += 1;
        // The number of bytes is an upper bound of the number of characters.
        let length = if line.len() > MOST { line.chars().count() } else { 0 };
        if length > MOST {
            let message =
                format!("line {lines} of the script has {length} characters; the limit is {MOST}");
            return Err(ScriptError::new(message).hint(
                "break the line: an array or a call may continue on the next line after each \
                comma",
            ));
        }
    }
    if lines > MOST {
        let message = format!("the script has {lines} lines; the limit is {MOST}");
        return Err(ScriptError::new(message).hint(
            "move parts of it to files of their own, which import \"NAME\" as name; reads, or \
            use loops for repeated lines",
        ));
    }
    Ok(())
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

    fn value(engine: &Engine, source: &str) -> Result<String, String> {
        read(engine, &Scope::new(), &source.into(), 0)
            .and_then(|ast| engine.eval_ast::<rhai::Dynamic>(&ast))
            .map(|value| value.to_string())
            .map_err(|error| match *error {
                EvalAltResult::ErrorRuntime(message, _) => message
                    .try_cast::<crate::script::messages::error::Failure>()
                    .map(|failure| failure.message)
                    .unwrap_or_default(),
                other => other.to_string(),
            })
    }

    #[test]
    fn scripts_beyond_the_position_limits_are_rejected() {
        let engine = engine();
        let long = format!("let a = [{}]; 2^3^2", "1, ".repeat(25_000));
        let message = value(&engine, &long).expect_err("a line of 75 000 characters");
        assert!(message.contains("line 1 of the script has 75017 characters"), "{message}");
        let made = "let made = []; for i in 0..3 { made.push(|| i); } made.map(|f| f.call())";
        let message = value(&engine, &format!("{}{made}", "\n".repeat(70_000)));
        assert!(message.expect_err("70 001 lines").contains("the script has 70001 lines"));
    }

    #[test]
    fn interrupted_reading_inside_an_interpolated_string_ends() {
        let settings = RunSettings::silent(RunMode::Run);
        settings.interrupt.store(true, std::sync::atomic::Ordering::Relaxed);
        let context = Context::new(settings);
        let engine = build(&language(), &context).expect("an engine");
        for before in 0..8 {
            let text = format!("{}`{}`", "-".repeat(before), "a${1}".repeat(100));
            assert!(read(&engine, &Scope::new(), &text.as_str().into(), 0).is_err(), "{before}");
        }
    }

    #[test]
    fn meaning_of_a_script_does_not_depend_on_its_position() {
        let engine = engine();
        let made = "let made = []; for i in 0..3 { made.push(|| i); } made.map(|f| f.call())";
        for before in ["\n".repeat(MOST - 1), " ".repeat(MOST - made.len())] {
            assert_eq!(value(&engine, &format!("{before}{made}")).as_deref(), Ok("[0, 1, 2]"));
            assert_eq!(value(&engine, &format!("{before}2^3^2")).as_deref(), Ok("512"));
            assert!(value(&engine, &format!("{before}-2^2")).is_err());
            assert_eq!(
                value(&engine, &format!("{before}let z = 2; z ^= 3; z")).as_deref(),
                Ok("8")
            );
        }
    }

    #[test]
    fn earlier_scripts_do_not_affect_later_ones() {
        let engine = engine();
        assert_eq!(value(&engine, "-3").as_deref(), Ok("-3"));
        assert_eq!(value(&engine, "\n\n5^2").as_deref(), Ok("25"), "no minus stands before it");
        assert!(value(&engine, "let a = [-(2").is_err());
        assert_eq!(value(&engine, "\n\n\n2^3^2").as_deref(), Ok("512"));
    }
}
