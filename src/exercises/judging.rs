//! Runs an attempt and then the script of its judge, which can access only the variables named in its header.
//! Only the calls of `check` in the script of the judge count, and names in the attempt cannot replace names in the judge.

use std::any::TypeId;
use std::time::Duration;

use rhai::{AST, Dynamic, FnPtr, NativeCallContext, Scope};

use super::exercise::Exercise;
use super::judge::Need;
use super::silenced_writer::SilenceSwitch;
use crate::script::diagnose::{Blame, Diagnostic};
use crate::script::engine::parse::parse;
use crate::script::engine::runner::SNAPSHOTS;
use crate::script::engine::script_engine::{Halt, ScriptEngine};
use crate::script::engine::stack::on_large_stack;
use crate::script::messages::nouns::with_article;
use crate::script::packages::language;
use crate::script::source::program::Program;
use crate::script::state::settings::RunSettings;

/// Default time limit, for the attempt and for its judge separately.
pub const DEFAULT_TIME_LIMIT: Duration = Duration::from_secs(20);

/// Result of judging an attempt.
#[derive(Debug)]
pub enum AttemptVerdict {
    /// All checks of the judge passed.
    Passed,
    /// Some checks of the judge failed. The variant contains their messages.
    WrongResult(Vec<String>),
    /// The attempt fails with an error.
    Error(Diagnostic),
    /// The attempt or its judge exceeded a limit.
    Stopped(Diagnostic),
    /// The judging was interrupted, for example by Ctrl-C.
    Interrupted,
}

/// Runs an attempt and its judge. Output of the attempt goes to the writers in `settings`; the judge prints nothing.
pub fn judge(exercise: &Exercise, attempt: &Program, settings: RunSettings) -> AttemptVerdict {
    let mut limits = settings.limits;
    limits.time = limits.time.or(Some(DEFAULT_TIME_LIMIT));
    let settings =
        RunSettings { limits, snapshots: SNAPSHOTS, folder: attempt.folder.clone(), ..settings };
    let hold = || match JudgingContext::open(settings)
        .and_then(|trial| trial.run_judge(exercise, attempt))
    {
        Ok(()) => AttemptVerdict::Passed,
        Err(verdict) => verdict,
    };
    on_large_stack(&limits, hold).unwrap_or_else(AttemptVerdict::Error)
}

struct JudgingContext {
    engine: ScriptEngine,
    silence: SilenceSwitch,
}

impl JudgingContext {
    fn open(settings: RunSettings) -> Result<Self, AttemptVerdict> {
        let silence = SilenceSwitch::default();
        let settings = RunSettings {
            printed: silence.wrap(settings.printed),
            diagnostics: silence.wrap(settings.diagnostics),
            ..settings
        };
        let host = ScriptEngine::open(language(), settings).map_err(AttemptVerdict::Error)?;
        Ok(Self { engine: host, silence })
    }

    fn run_judge(&self, exercise: &Exercise, attempt: &Program) -> Result<(), AttemptVerdict> {
        let mut scope = Scope::new();
        let held = self.run_judge_within(&mut scope, exercise, attempt);
        // The limits stay active while the data of the attempt are dropped, because dropping may need time and memory.
        let _limits_kept = self.engine.watch().map_err(|halt| self.verdict(halt))?;
        drop(scope);
        held
    }

    fn run_judge_within(
        &self,
        scope: &mut Scope<'static>,
        exercise: &Exercise,
        attempt: &Program,
    ) -> Result<(), AttemptVerdict> {
        let functions = self.run(attempt, scope)?.clone_functions_only();
        self.silence.begin();
        let judge = exercise.judge();
        let mut seen =
            self.show(&judge.needs, scope, &functions).map_err(AttemptVerdict::WrongResult)?;
        let (made, failed) =
            self.engine.context().with_checks(|checks| (checks.made(), checks.failed().len()));
        let program = Program::named(&format!("the judge of {}", exercise.id()), exercise.judge);
        self.run(&program, &mut seen).map_err(|verdict| match verdict {
            AttemptVerdict::Error(why) if why.blame == Blame::User => {
                AttemptVerdict::WrongResult(vec![format!("the judge failed: {}", why.message)])
            }
            other => other,
        })?;
        let found = self.engine.context().with_checks(|checks| {
            let found = checks.failed()[failed..].iter().map(|check| check.message.clone());
            (checks.made() > made).then(|| found.collect::<Vec<_>>())
        });
        match found {
            None => {
                let why = format!("{} made no check", program.name);
                Err(AttemptVerdict::Error(Diagnostic::internal_error(why)))
            }
            Some(found) if found.is_empty() => Ok(()),
            Some(found) => Err(AttemptVerdict::WrongResult(found)),
        }
    }

    fn show(
        &self,
        needs: &[Need],
        attempt: &Scope,
        functions: &AST,
    ) -> Result<Scope<'static>, Vec<String>> {
        let mut seen = Scope::new();
        let mut wrong = Vec::new();
        for Need { name, of } in needs {
            let Some(value) = attempt.get(name) else {
                wrong.push(format!(
                    "your script has no variable '{name}' at its end, which the judge needs; define it with 'let {name} = …' outside braces"
                ));
                continue;
            };
            let value = value.flatten_clone();
            // In the header of a judge's script, the type of a string is written "text", and the type of a function is written "function".
            // The script engine has other names for these types.
            let found = match value.type_id() {
                _ if value.is_string() => "text",
                function if function == TypeId::of::<FnPtr>() => "function",
                _ => self.engine.engine().map_type_name(value.type_name()),
            };
            match found {
                found if found == of => {
                    let value = callable(name, value, functions);
                    _ = seen.push_dynamic(name.as_str(), value);
                }
                // The judge accepts an integer as a number.
                "whole number" if of == "number" => {
                    let number = value.as_int().unwrap_or_default() as f64;
                    seen.push(name.as_str(), number);
                }
                found => wrong.push(format!(
                    "the variable '{name}' of your script must be {}, but is {}",
                    with_article(of),
                    with_article(found)
                )),
            }
        }
        if wrong.is_empty() { Ok(seen) } else { Err(wrong) }
    }

    fn run(&self, program: &Program, scope: &mut Scope<'static>) -> Result<AST, AttemptVerdict> {
        let ran = self.engine.watch().and_then(|guard| {
            self.engine.run(
                &guard,
                || program.clone(),
                |engine| {
                    let ast = parse(engine, program)?;
                    engine.run_ast_with_scope(scope, &ast).map(|()| ast)
                },
            )
        });
        ran.map_err(|halt| self.verdict(halt))
    }

    fn verdict(&self, halt: Halt) -> AttemptVerdict {
        match halt {
            Halt::Failed(why) | Halt::Undecided(why) if self.engine.context().is_stopped() => {
                AttemptVerdict::Stopped(why)
            }
            Halt::Failed(why) | Halt::Undecided(why) => AttemptVerdict::Error(why),
            Halt::Interrupted | Halt::PipeClosed => AttemptVerdict::Interrupted,
        }
    }
}

fn callable(name: &str, value: Dynamic, functions: &AST) -> Dynamic {
    let Some(function) = value.clone().try_cast::<FnPtr>() else { return value };
    let definition = functions.iter_functions().find(|known| known.name == function.fn_name());
    let parameters = definition.map(|known| known.params.len() - function.iter_curry().count());
    let (variable, functions) = (name.to_owned(), functions.clone());
    let call = move |native: NativeCallContext, arguments: &mut [&mut Dynamic]| {
        if let Some(has) = parameters.filter(|count| *count != arguments.len()) {
            let needed = arguments.len();
            let message =
                format!("the number of parameters of '{variable}' must be {needed}, but is {has}");
            return Err(message.into());
        }
        let mut surroundings = native.global_runtime_state().clone();
        surroundings.lib = [functions.shared_lib().clone()].into_iter().collect();
        let (engine, name) = (native.engine(), function.fn_name());
        let inner = (engine, name, None, &surroundings, native.call_position()).into();
        let arguments: Vec<Dynamic> =
            arguments.iter_mut().map(|argument| std::mem::take(*argument)).collect();
        function.call_raw(&inner, None, arguments)
    };
    // `FnPtr::from_fn` is marked as deprecated only because its interface may change.
    #[allow(deprecated)]
    FnPtr::from_fn("of_the_attempt", call).map_or(value, Dynamic::from)
}
