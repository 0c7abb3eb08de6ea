//! Tests of some pages, and of properties of all pages.

use super::page::wrapped_code;
use super::{WIDTH, find, names, page};
use crate::script::packages::language;
use crate::script::source::text::Source;

fn shown(name: &str) -> String {
    page(&language(), name).unwrap().plain(WIDTH)
}

#[test]
fn a_function_has_its_signature_parameters_and_example() {
    assert_eq!(
        shown("round_to"),
        "\
round_to(x, digits) → a number
Rounds x to this many digits after the decimal point.

  x: a number
  digits: a whole number from 0 to 15

Example
    check(round_to(PI, 2) == 3.14);

See also round, fixed.
"
    );
}

#[test]
fn help_on_a_rhai_function_shows_all_forms() {
    assert_eq!(
        shown("sub_string"),
        "\
text.sub_string(start, [count]) → a text
text.sub_string(range) → a text
Returns a part of the text; without a count, everything from start on.

Example
    check(\"spaghetti\".sub_string(0, 3) == \"spa\");
    check(\"spaghetti\".sub_string(3..6) == \"ghe\");

See also crop, split.
"
    );
}

#[test]
fn constants_and_options_have_pages() {
    assert!(shown("PI").starts_with("PI = 3.141592653589793\nHalf a turn"), "{}", shown("PI"));
    let density = shown("rho_A");
    assert!(density.contains("section.rho_A"), "{density}");
    assert!(
        density.contains("An option of section(options):\n  rho_A: a number [mass/length]"),
        "{density}"
    );
}

#[test]
fn help_finds_methods_by_type_variable_or_name() {
    let page = shown("simulation.run_to");
    assert!(page.starts_with("simulation.run_to(t)\n"), "{page}");
    assert_eq!(shown("run_to"), page);
    assert_eq!(shown("sim.run_to()"), page);
    let simulation = shown("simulation");
    assert!(
        simulation.contains("\n  simulation.run_to(t): Takes steps until a time"),
        "{simulation}"
    );
    assert!(simulation.contains("It comes from"), "{simulation}");
    assert!(simulation.contains("scene.start([options])"), "{simulation}");
    let end = shown("range.end");
    assert!(end.contains("range.end") && !end.contains("beam"), "{end}");
    assert!(shown("end").contains("beam.end"), "{}", shown("end"));
}

#[test]
fn help_on_a_property_states_assignable_values() {
    assert!(shown("vector.x").contains("It can be assigned: a number"), "{}", shown("vector.x"));
}

#[test]
fn domains_and_keywords_have_help_pages() {
    assert!(shown("loads").contains("\n  scene.force("), "{}", shown("loads"));
    assert!(shown("arrays").contains("array.push(value): Appends"), "{}", shown("arrays"));
    assert!(shown("while").starts_with("The language: loops\n"), "{}", shown("while"));
    assert!(shown("**").starts_with("The language: operators\n"), "{}", shown("**"));
    assert!(shown("").starts_with("Help\n"), "{}", shown(""));
    assert_eq!(shown("viewer"), shown("viewers"), "a heading, also of one");
}

#[test]
fn unknown_names_get_suggestions() {
    let unknown = |name: &str| page(&language(), name).unwrap_err();
    assert_eq!(unknown("slidr").meant, Some("slider"));
    assert_eq!(unknown("slidr").to_string(), "there is no help on 'slidr'");
    assert_eq!(unknown("slidr").hint(), "did you mean 'slider'?");
    assert!(unknown("sibileau").mentions.contains(&"relaxed"));
    assert_eq!(unknown("zzzzzz").hint(), "help() lists all topics");
}

#[test]
fn engineering_terms_have_help_pages() {
    let words = "friction pulley rope cable bifurcation actuator cylinder winch wheel gif video fft optimise random imperfection collision";
    let phrases = [
        "boundary condition",
        "rest length",
        "rigid-body mode",
        "initial velocity",
        "degree of freedom",
    ];
    for term in words.split(' ').chain(phrases) {
        let text = shown(term);
        assert!(text.split_whitespace().any(|word| word == "see"), "{term}: {text}");
    }
}

#[test]
fn every_name_has_a_help_page_within_the_width() {
    let catalog = language();
    let names = names(&catalog);
    assert!(names.len() > 300, "{}", names.len());
    for name in names {
        assert!(!find(&catalog, name).is_empty(), "{name}");
        for width in [WIDTH, 60] {
            for line in page(&catalog, name).unwrap().plain(width).lines() {
                let is_code = width < WIDTH && line.starts_with("    ");
                assert!(line.chars().count() <= width || is_code, "{name}: {line}");
            }
        }
    }
}

#[test]
fn wrapped_examples_have_the_same_tokens() {
    let catalog = language();
    let rows = catalog.tables().flat_map(|table| {
        table.rows.iter().map(|row| row.example).chain(std::iter::once(table.setup))
    });
    let examples = rows.chain(catalog.built_ins().map(|known| known.example));
    for example in examples {
        let broken: Vec<String> = example.lines().flat_map(|line| wrapped_code(line, 40)).collect();
        let words = |text: &str| {
            Source::from(text).tokens().iter().map(|(token, _)| token.clone()).collect::<Vec<_>>()
        };
        assert_eq!(words(&broken.join("\n")), words(example));
    }
}

#[test]
fn coloured_help_has_the_text_of_plain_help() {
    let page = page(&language(), "section").unwrap();
    let ansi = page.ansi(WIDTH);
    assert!(ansi.contains("\u{1b}[2m[mass/length]\u{1b}[0m"), "{ansi}");
    let bare = ["\u{1b}[0m", "\u{1b}[1m", "\u{1b}[2m"]
        .iter()
        .fold(ansi, |text, code| text.replace(code, ""));
    assert_eq!(bare, page.plain(WIDTH));
}
