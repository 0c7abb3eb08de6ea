//! Contents of pictures of arrays, of motion and of sections of beams, and refused options.
#![allow(clippy::unwrap_used)]

use std::fs;

use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

const ROD: &str = "let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 0.1 });
let scene = new_scene(\"rod\");
let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(8), section: s });
scene.clamp(rod.start);
scene.force(rod.end, [0, -3], hold_for(0.5));
";

/// Picture that a script draws as `it.svg`.
fn picture(script: &str) -> String {
    let out = tempfile::tempdir().unwrap();
    let settings = RunSettings { out: out.path().to_owned(), ..RunSettings::silent(RunMode::Run) };
    let outcome = run(&Program::named("picture", &format!("{ROD}{script}")), &language(), settings);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    fs::read_to_string(out.path().join("it.svg")).unwrap()
}

fn words(svg: &str) -> Vec<&str> {
    let text = svg.split_once("<desc>").unwrap().1.split_once("</desc>").unwrap().0;
    text.split(" | ").collect()
}

fn refusal(script: &str) -> String {
    let settings = RunSettings::silent(RunMode::Run);
    let outcome = run(&Program::named("picture", &format!("{ROD}{script}")), &language(), settings);
    format!("{:?}", outcome.ending)
}

#[test]
fn the_moment_of_a_cantilever_is_force_times_arm() {
    let script = "scene.force(rod.end, [0, -3]);\nlet rest = scene.equilibrium();\n";
    let svg = picture(&format!(
        "scene = new_scene(\"still\");
rod = scene.beam(#{{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(8), section: section(#{{ EA: 1e7, GA: 1e7, EI: 1e6, rho_A: 1, rho_I: 1 }}) }});
scene.clamp(rod.start);
{script}plot_along(rest, \"M\", \"it.svg\");"
    ));
    let words = words(&svg);
    assert!(words.contains(&"−6"), "the moment at the clamp: {words:?}");
    assert!(words.contains(&"still: bending moment"), "{words:?}");
    assert_eq!(words.iter().filter(|word| **word == "M [force·length]").count(), 1, "{words:?}");
}

#[test]
fn labels_are_rounded_and_never_cut() {
    let long = "a title that goes on and on ".repeat(9);
    let svg = picture(&format!(
        "plot([1, 2], [[1, 2], [3, 4]], \"it.svg\", #{{ labels: [0.1 + 0.2, \"b\"], title: \"{}\" }});",
        long.trim()
    ));
    let words = words(&svg);
    assert!(words.contains(&"0.3") && words.contains(&"b"), "{words:?}");
    assert!(words.join(" ").starts_with(long.trim()), "{words:?}");
    assert!(!svg.contains('…'));
}

#[test]
fn gaps_are_left_and_limits_kept() {
    let circles = |script: &str| picture(script).matches("<circle").count();
    let five = "plot([1, 2, 3, 4, 5], [1, 2, nan, 4, 5], \"it.svg\", #{ markers: \"alone\"";
    assert_eq!(circles(&format!("{five} }});")), 4);
    assert_eq!(circles(&format!("{five}, x_limits: [1.5, 4.5] }});")), 2);
    let log = picture("plot([1, 10], [1, 100], \"it.svg\", #{ x_log: true, y_log: true });");
    assert!(words(&log).contains(&"10²"));
}

#[test]
fn incompatible_arguments_are_rejected_with_a_suggestion() {
    for (script, messages) in [
        ("plot([1, 2], [1], \"a.svg\");", "x has 2 numbers, but y has 1"),
        ("plot([[1], [2]], [[1], [2], [3]], \"a.svg\");", "x holds 2 arrays, but y holds 3"),
        ("plot([1], [\"a\"], \"a.svg\");", "'y' must hold numbers"),
        ("plot([1], [1], \"a.svg\", #{ labels: [1, 2] });", "there are 1 curve, but 2 labels"),
        (
            "plot([1], [1], \"a.svg\", #{ x_limits: [2, 1] });",
            "'x_limits' must be [low, high], got [2, 1]",
        ),
        ("plot([1], [1], \"a.svg\", #{ y_log: true, y_limits: [0, 1] });", "cannot begin at 0"),
        ("plot_along(scene.start(#{ dt: 1 }), [\"M\", \"K\"], \"a.svg\");", "no quantity"),
        (
            "plot_along(scene.start(#{ dt: 1 }), \"M\", \"a.svg\", #{ beams: [1] });",
            "must hold beams",
        ),
    ] {
        assert!(refusal(script).contains(messages), "{script}: {}", refusal(script));
    }
}

#[test]
fn numerous_dots_and_ended_loads_are_omitted() {
    let drawn = |options: &str, until: &str| {
        picture(&format!(
            "let sim = scene.start(#{{ dt: 0.1 }});\nsim.run_to({until});\nplot_motion(sim, \"it.svg\", #{{ every: 10 {options} }});"
        ))
    };
    let dots = |options: &str| drawn(options, "0.4").matches("<circle").count();
    assert_eq!(dots("") - dots(", dots: false"), 18);
    let lines = |options: &str, until: &str| drawn(options, until).matches("<polyline").count();
    // Both pictures have the same view, because grid lines are polylines too.
    let view = ", x_limits: [-1, 4], y_limits: [-2, 3]";
    let bare = format!("{view}, symbols: false");
    let arrow = |until: &str| lines(view, until) - lines(&bare, until);
    assert_eq!(arrow("0.4") - arrow("0.8"), 2, "shaft and head of the arrow");
    let many = picture(
        "for i in 0..5 { scene.beam(#{ axis: line([0, 1], [2, 1]), basis: bspline(16), section: s }); }
let sim = scene.start(#{ dt: 0.1 });\nsim.run_to(0.2);\nplot_motion(sim, \"it.svg\", #{ symbols: false });",
    );
    assert_eq!(many.matches("<circle").count(), 0);
}

#[test]
fn numerous_symbols_are_omitted() {
    let marks = |count: usize, options: &str| {
        let svg = picture(&format!(
            "for n in 1..={count} {{ scene.slider(scene.particle([n / {count}.5, 0], 0.1), rod, #{{ at: n / {count}.5 / 2 }}); }}
             plot_motion(scene.start(#{{ dt: 0.1 }}), \"it.svg\", #{{ {options} }});"
        ));
        svg.matches("<poly").count()
    };
    let [all, some, none] = ["symbols: true", "", "symbols: false"].map(|how| marks(100, how));
    // The symbol of the load is still drawn.
    assert!(none < some && some + 100 < all, "{none} {some} {all}");
    assert!(marks(20, "") == marks(20, "symbols: true"));
}

#[test]
fn magnified_displacements_are_scaled_by_the_factor() {
    let axis = |magnify: &str| {
        picture(&format!(
            "let sim = scene.start(#{{ dt: 0.1 }});\nsim.run_to(0.4);\nplot_motion(sim, \"it.svg\", #{{ every: 10, symbols: false, dots: false {magnify} }});"
        ))
    };
    let plain = axis("");
    assert_eq!(plain, axis("").as_str());
    let one = axis(", magnify: 1");
    assert!(words(&one).contains(&"deformations since the start, magnified 1 times"));
    let lines = |svg: &str| svg.matches("<polyline").count();
    assert_eq!(lines(&one), lines(&plain));
    assert_ne!(axis(", magnify: 5"), one);
}

#[test]
fn rigid_motion_of_free_bodies_is_not_magnified() {
    let largest = |scene: &str, options: &str| {
        let svg = picture(&format!(
            "{scene}\nlet sim = scene.start(#{{ dt: 0.01 }});\nsim.run_to(1);\nplot_motion(sim, \"it.svg\", #{{ every: 10, {options} }});"
        ));
        let words = words(&svg);
        let frame = words.iter().take_while(|word| **word != "t");
        let numbers = frame.filter_map(|word| word.replace('\u{2212}', "-").parse::<f64>().ok());
        numbers.fold(0.0, |most: f64, number| most.max(number.abs()))
    };
    let bridge = "scene = new_scene(\"bridge\");
rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [20, 0]), basis: bspline(8), section: s });
scene.hinge(rod.start);\nscene.support(rod.end, #{ y: true });
let cart = scene.particle([2, 0], 1, #{ velocity: [10, 0] });\nscene.slider(cart, rod);\nscene.gravity([0, -1]);";
    assert_eq!(largest(bridge, "magnify: 1"), largest(bridge, ""));
    let seen = largest(bridge, "magnify: 20");
    assert!(seen <= 25.0, "{seen}");
    let pendulum = "scene = new_scene(\"pendulum\");
rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 0]), basis: bspline(8), section: s });
scene.hinge(rod.start);\nscene.gravity([0, -10]);";
    let seen = largest(pendulum, "magnify: 20");
    assert!(seen <= 2.5, "{seen}");
}

#[test]
fn simulations_share_their_axes() {
    let svg = picture(
        "let a = scene.start(#{ name: \"first\", dt: 0.1 });\nlet b = scene.start(#{ name: \"second\", dt: 0.05 });
a.run_to(0.4);\nb.run_to(0.4);\nplot_history([a, b], [\"strain\"], \"it.svg\", #{ axes: \"shared\" });",
    );
    let words = words(&svg);
    assert!(words.contains(&"first") && words.contains(&"second"), "{words:?}");
    assert_eq!(words.iter().filter(|word| **word == "strain [energy]").count(), 1, "{words:?}");
}

#[test]
fn columns_of_each_unit_have_a_panel_with_their_names() {
    let drawn = |of: &str, options: &str| {
        format!(
            "scene.record(\"rod.end.y\");
let a = scene.start(#{{ name: \"first\", dt: 0.1 }});\nlet b = scene.start(#{{ name: \"second\", dt: 0.05 }});
a.run_to(0.4);\nb.run_to(0.4);
plot_history({of}, [\"strain\", \"rod.end.y\", \"retries\", \"kinetic\"], \"it.svg\", #{{ {options} }});"
        )
    };
    let labels = ["energy", "rod.end y [length]", "retries"];
    for (of, options, copies) in
        [("a", "", 1), ("[a, b]", "", 2), ("[a, b]", "axes: \"shared\"", 1)]
    {
        let svg = picture(&drawn(of, options));
        let words = words(&svg);
        for label in labels {
            let count = words.iter().filter(|word| **word == label).count();
            assert_eq!(count, copies, "{options} {label} {words:?}");
        }
        assert!(!words.contains(&"-"), "{words:?}");
    }
    let svg = picture(&drawn("a", "panels: \"one\", y_label: \"all\""));
    assert!(words(&svg).contains(&"all") && words(&svg).contains(&"retries"));
    let message = refusal(&drawn("a", "y_limits: [0, 1]"));
    assert!(
        message.contains("'y_limits' is for one axis, but the columns have 3 units"),
        "{message}"
    );
}
