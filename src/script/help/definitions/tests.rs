//! Tests that the definition files contain all bindings in valid syntax.

use super::types::{for_value, identifier};
use super::{DefinitionFile, definitions};
use crate::script::bindings::returns::ValueKind;
use crate::script::packages::language;
use crate::script::source::text::Source;

fn file(name: &str) -> DefinitionFile {
    let files = definitions(&language());
    files.into_iter().find(|file| file.name == name).unwrap()
}

#[test]
fn every_table_has_a_definition_file_with_all_rows() {
    let catalog = language();
    for table in catalog.tables() {
        let text = file(&format!("{}.d.rhai", identifier(table.name))).text;
        for row in table.rows {
            assert!(text.contains(&format!("/// `{}`", row.signature())), "{}", row.signature());
            assert!(text.contains(row.summary), "{}", row.signature());
            let declared = format!(" {}(", row.name);
            assert!(text.lines().any(|line| is_declaration(line) && line.contains(&declared)));
        }
    }
    for table in catalog.built_in_tables() {
        let text = file(&format!("rhai_{}.d.rhai", table.name)).text;
        for built_in in table.rows {
            let declared = format!(" {}(", built_in.name());
            assert!(text.lines().any(|line| is_declaration(line) && line.contains(&declared)));
        }
    }
}

fn is_declaration(line: &str) -> bool {
    ["fn ", "op ", "const ", "type "].iter().any(|word| line.starts_with(word))
}

#[test]
fn every_definition_line_is_a_comment_or_complete_declaration() {
    for DefinitionFile { name, text } in definitions(&language()) {
        let mut lines = text.lines().filter(|line| !line.is_empty() && !line.starts_with("///"));
        assert_eq!(lines.next(), Some("module static;"), "{name}");
        for line in lines {
            assert!(is_declaration(line) && line.ends_with(';'), "{name}: {line}");
            let count = |letter| line.matches(letter).count();
            assert_eq!(count('('), count(')'), "{name}: {line}");
            let line_of_script = Source::from(line.replace("->", "").replace('?', "unknown"));
            for (token, _) in line_of_script.tokens() {
                assert!(!matches!(token, rhai::Token::LexError(_)), "{name}: {line}: {token}");
            }
        }
    }
}

#[test]
fn every_used_type_is_declared() {
    let files = definitions(&language());
    let declared: Vec<&str> = files[0]
        .text
        .lines()
        .filter_map(|line| line.strip_prefix("type ")?.split(' ').next())
        .collect();
    for line in
        files[1..].iter().flat_map(|file| file.text.lines()).filter(|line| line.starts_with("fn "))
    {
        let types = line.split([',', ')', ';']).filter_map(|part| {
            part.split_once(": ")
                .map(|(_, of)| of)
                .or_else(|| part.split_once("-> ").map(|(_, of)| of))
        });
        for of in types.flat_map(|of| of.split(" | ")) {
            assert!(declared.contains(&of) || ["?", "()", "("].contains(&of), "{of} in {line}");
        }
    }
}

#[test]
fn each_number_of_optional_arguments_is_declared() {
    let text = file("simulations.d.rhai").text;
    assert!(text.contains("\nfn step(simulation: simulation) -> ();\n"), "{text}");
    assert!(text.contains("\nfn step(simulation: simulation, count: whole_number) -> ();\n"));
    assert!(text.contains("\nfn get t(simulation: simulation) -> number;\n"));
    let vectors = file("vectors.d.rhai").text;
    assert!(vectors.contains("\nfn set x(vector: vector, value: number);\n"), "{vectors}");
    assert!(vectors.contains("\nop +(point, point) -> vector;\n"), "{vectors}");
}

#[test]
fn return_kinds_have_declared_types() {
    for (kind, of) in [
        (ValueKind::Integer, "whole_number"),
        (ValueKind::Array(&ValueKind::Number), "array"),
        (ValueKind::OneOf(&[ValueKind::Character, ValueKind::Nothing]), "?"),
        (ValueKind::Boolean, "truth_value"),
        (ValueKind::Nothing, "()"),
    ] {
        assert_eq!(for_value(&kind), of);
    }
    let catalog = language();
    let rule = catalog.type_named("sliding rule").expect("a type");
    assert_eq!(for_value(&ValueKind::Object(rule)), "sliding_rule");
}
