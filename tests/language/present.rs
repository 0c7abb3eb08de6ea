//! Display of values at the prompt.
#![allow(clippy::unwrap_used)]

use proptest::prelude::*;
use rhai::{Dynamic, Engine};
use withy::script::engine;
use withy::script::packages::language;
use withy::script::presentation::present::present;
use withy::script::state::context::Context;
use withy::script::state::settings::{RunMode, RunSettings};

const WIDTH: usize = 80;

fn engine() -> Engine {
    engine::build(&language(), &Context::new(RunSettings::silent(RunMode::Run))).unwrap()
}

fn shown_at(width: usize, script: &str) -> String {
    let value: Dynamic = engine().eval(script).unwrap_or_else(|error| panic!("{script}: {error}"));
    present(&language(), &value, width)
}

fn shown(script: &str) -> String {
    shown_at(WIDTH, script)
}

/// Displayed value of an expression of the example scene and its simulation, which has run for a second.
fn of_scene(expression: &str) -> String {
    shown(&format!(
        "let scene = new_scene(\"example\");
         let s = section(#{{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 }});
         let rod = scene.beam(#{{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s }});
         scene.clamp(rod.start);
         scene.gravity([0, -10]);
         let bead = scene.particle([0.5, 0], 1, #{{ name: \"bead\", velocity: [1, 0] }});
         let ring = scene.slider(bead, rod, #{{ name: \"ring\", ends: \"bounce\" }});
         scene.force(rod.end, [0, 1], hold_for(0.25));
         let sim = scene.start(#{{ dt: 0.1 }});
         sim.step(3);
         {expression}"
    ))
}

#[test]
fn numbers_are_shown_without_binary_rounding_errors() {
    let cases = [
        ("0.1 + 0.2", "0.3"),
        ("1e-17", "1e-17"),
        ("2 * 3", "6"),
        ("9007199254740993", "9007199254740993"),
        ("1/3", "0.3333333333"),
        ("1/0", "inf"),
        ("vec(1, 0.1 + 0.2).x", "1"),
    ];
    for (script, expected) in cases {
        assert_eq!(shown(script), expected, "{script}");
    }
}

#[test]
fn other_values_are_shown_in_plain_form() {
    let cases = [
        ("()", ""),
        ("true", "true"),
        ("\"a \\\"b\\\"\\tc\"", "\"a \\\"b\\\"\\tc\""),
        ("\"two\\nlines\\n\"", "two\nlines"),
        ("'x'", "'x'"),
        ("0..5", "0..5"),
        ("0..=5", "0..=5"),
        ("|x| x", "function"),
        ("Fn(\"swing\")", "function swing"),
        ("[]", "[]"),
        ("let x = 0.1 + 0.2; let f = || x; x", "0.3"),
        ("let x = \"captured\"; let f = || x; [x, f]", "[\"captured\", function]"),
        ("#{}", "#{}"),
        ("[1, 0.1 + 0.2, \"x\", vec(1, 2), ()]", "[1, 0.3, \"x\", (1, 2), ()]"),
        ("[0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1]", "[0, 0.1, 0.2, …, 1] (11)"),
        ("[[1, 0], [0, 1]]", "[[1, 0], [0, 1]]"),
        ("#{ a: 1, \"two words\": [2] }", "#{a: 1, \"two words\": [2]}"),
    ];
    for (script, expected) in cases {
        assert_eq!(shown(script), expected, "{script}");
    }
}

#[test]
fn wide_collections_take_several_lines() {
    let rows = shown_at(20, "[[1.5, 2.5, 3.5], [4.5, 5.5, 6.5]]");
    assert_eq!(rows, "[[1.5, 2.5, 3.5],\n [4.5, 5.5, 6.5]]");
    let many =
        shown_at(30, "let rows = []; for i in 0..20 { rows.push([i, i + 0.5, i * 2]); } rows");
    assert_eq!(many, "[[0, 0.5, 0],\n [1, 1.5, 2],\n [2, 2.5, 4],\n …,\n [19, 19.5, 38]] (20)");
    let map = shown_at(20, "#{ length: 12.5, name: \"beam\", list: [1, 2, 3] }");
    assert_eq!(map, "#{\n  length: 12.5,\n  list: [1, 2, 3],\n  name: \"beam\",\n}");
    let keys = shown("let map = #{}; for i in 0..30 { map[`key ${i}`] = i; } map");
    assert!(keys.ends_with("  … (30 keys)\n}") && keys.lines().count() == 15, "{keys}");
    let text = shown_at(20, "\"0123456789012345678901234567890\"");
    assert_eq!(text.chars().count(), 20);
    assert!(text.ends_with('…'), "{text}");
}

#[test]
fn values_that_contain_themselves_are_abbreviated() {
    let shown = |value: &Dynamic| present(&language(), value, WIDTH);
    let mut ring = Dynamic::from(vec![Dynamic::from(1_i64)]).into_shared();
    for _ in 0..3 {
        let itself = ring.clone();
        ring.write_lock::<rhai::Array>().unwrap().push(itself);
    }
    let text = shown(&ring);
    assert!(text.starts_with("[1,\n [1, [1, [1, […]") && text.ends_with(']'), "{text}");
    let mut map = Dynamic::from(rhai::Map::new()).into_shared();
    let itself = map.clone();
    map.write_lock::<rhai::Map>().unwrap().insert("me".into(), itself);
    assert_eq!(shown(&Dynamic::from(1_i64).into_shared()), "1");
    assert_eq!(shown(&Dynamic::UNIT.into_shared()), "");
    assert_eq!(shown(&map), "#{me: #{me: #{me: #{me: #{…}}}}}");
    // Twenty levels with eight references each to one array, too many to traverse completely.
    let mut wide = Dynamic::from(vec![Dynamic::from(1_i64)]);
    for _ in 0..20 {
        wide = Dynamic::from(vec![wide.into_shared(); 8]);
    }
    assert!(shown(&wide).lines().all(|line| line.chars().count() <= WIDTH));
}

#[test]
fn a_number_alone_is_not_a_table() {
    let lone = of_scene("describe(sim.t)");
    assert_eq!(lone, "\"0.25\"");
    assert_eq!(of_scene("print(1)"), "");
    assert_eq!(of_scene("describe(())"), "\"nothing\"");
}

#[test]
fn native_values_show_a_summary() {
    let cases: &[(&str, &[&str])] = &[
        ("scene", &["mass            3", "particles       bead", "gravity         (0, -10)"]),
        (
            "rod",
            &[
                "ends            (0, 0) … (2, 0)",
                "joints          clamp at the start of beam 'rod'",
            ],
        ),
        ("rod.at(0.5)", &["arc length  0.5 of 2, 0.25 of it", "drawn at    (0.5, 0)"]),
        ("s", &["EI [force·length²]        100", "axial wave [length/time]  100"]),
        ("line([0, 0], [3, 4])", &["ends          (0, 0) … (3, 4)", "length        5"]),
        ("knots(#{ spans: 4 })", &["functions  7", "spans      4, C2 where they meet"]),
        ("bspline(4)", &["axial, shear  6 quadrature points", "functions     7"]),
        ("hold_for(2.5)", &["at t = 0        1", "steps end at    t = 2.5", "after the last  0"]),
        ("energy_momentum()", &["order   2", "keeps   energy, linear momentum"]),
        ("relaxed()", &["keeps   energy, linear momentum, angular momentum\n"]),
        ("ring", &["on                beam 'rod', from 0.25 of its length", "bounces"]),
        (
            "sim",
            &[
                "time               t = 0.25, dt = 0.1",
                "Newton iterations  ",
                "slider 'ring'      sliding at 0.",
            ],
        ),
        (
            "sim.history",
            &[
                "rows                 4",
                "[energy]             kinetic, strain, potential, energy, work",
            ],
        ),
        ("sim.invariants()", &["gap of joints"]),
        ("vec(3, 4)", &["(3, 4)\n", "norm   5"]),
        (
            "let told = (); try { rod.at(5) } catch (problem) { told = problem; } told",
            &["station 5 is outside the length of beam"],
        ),
    ];
    for (expression, parts) in cases {
        let text = format!("{}\n", of_scene(expression));
        for part in *parts {
            assert!(text.contains(part), "{expression}: no '{part}' in\n{text}");
        }
        assert!(text.lines().count() <= 14, "{expression}:\n{text}");
        assert!(text.lines().skip(1).all(|line| line.chars().count() <= WIDTH), "{text}");
    }
}

#[test]
fn long_detail_continues_on_the_next_line() {
    let narrow = shown_at(40, "energy_momentum()");
    let expected = "  source  Stander & Stein, Eng. Comput.\n          13 (1996) 60-85";
    assert!(narrow.ends_with(expected), "{narrow}");
}

#[test]
fn details_call_no_function_of_the_script() {
    let shown = shown("let count = 0; let f = schedule(|t| { throw \"called\" }); f");
    assert_eq!(shown, "schedule(|t| …)");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]
    #[test]
    fn no_line_exceeds_the_requested_width(numbers in prop::collection::vec(proptest::num::f64::ANY, 0..30), text in ".{0,60}", width in 20usize..60) {
        let array: rhai::Array = numbers.iter().map(|x| Dynamic::from(*x)).collect();
        let mut map = rhai::Map::new();
        map.insert("numbers".into(), array.clone().into());
        map.insert(text.clone().into(), text.clone().into());
        let all = [Dynamic::from(array.clone()), Dynamic::from(map.clone()), Dynamic::from(vec![Dynamic::from(array), Dynamic::from(map)])];
        for value in all {
            let shown = present(&language(), &value, width);
            // The count of an abbreviated array follows its last line.
            prop_assert!(shown.lines().all(|line| line.chars().count() <= width + 5), "{}", shown);
        }
    }
}
