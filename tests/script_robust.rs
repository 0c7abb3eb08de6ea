//! Scripts thrown together at random: whatever they say, there is no panic and no mistake of ours.

use proptest::prelude::*;
use withy::script::catalog::Catalog;
use withy::script::context::{Mode, Settings};
use withy::script::diagnose::Blame;
use withy::script::program::Program;
use withy::script::runner::{Ending, run};

const PIECES: &[&str] = &[
    "let ",
    "a",
    "b",
    " = ",
    "1",
    "2.5",
    "-3",
    "1e400",
    "\"text\"",
    "`x ${",
    "}`",
    "[",
    "]",
    "#{",
    "}",
    "{",
    "(",
    ")",
    ", ",
    ": ",
    ";",
    "\n",
    "\t",
    ".",
    " + ",
    " - ",
    " * ",
    " / ",
    " ^ ",
    " ** ",
    " /= ",
    "^=",
    "/=",
    " < ",
    " == ",
    " != ",
    " && ",
    "!",
    "-",
    "|x| ",
    "fn f(x) ",
    "f(",
    "if ",
    "else ",
    "for i in 0..3 ",
    "switch ",
    "try ",
    "catch ",
    "throw ",
    "return ",
    "vec(",
    "norm(",
    ".x",
    ".y = ",
    ".norm()",
    "sum(",
    "linspace(0, 1, 3)",
    "check(",
    "print(",
    "sci(",
    "ä",
    "λ",
    "\u{E000}",
    "\u{E002}",
    "//",
    "/*",
    "*/",
    "nan",
    "inf",
    "PI",
    "const ",
    "import ",
    " as m",
    "in ",
    "this",
    "?.",
    "??",
    "max(",
    "quotient(1, 0)",
    "floor(",
    "'",
    "\"",
    "until",
    "#",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn no_script_makes_us_fail(pieces in prop::collection::vec(prop::sample::select(PIECES), 0..40)) {
        judge(&pieces.concat())?;
    }

    #[test]
    fn no_text_makes_us_fail(text in "\\PC{0,60}") {
        judge(&text)?;
    }
}

fn judge(script: &str) -> Result<(), TestCaseError> {
    let outcome =
        run(&Program::named("random", script), &Catalog::standard(), Settings::silent(Mode::Run));
    if let Ending::Failed(diagnostic) = outcome.ending {
        prop_assert_eq!(diagnostic.blame, Blame::User, "{}\n{}", script, diagnostic);
        prop_assert!(!diagnostic.to_string().is_empty());
    }
    Ok(())
}
