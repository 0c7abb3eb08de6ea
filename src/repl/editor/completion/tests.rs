//! Tests of completion in a session. The bar `¦` marks the cursor.

use std::fs;

use super::super::samples::surroundings;
use super::*;
use proptest::prelude::*;

fn offered_in(line: &str, surroundings: &CompletionContext) -> Vec<String> {
    let (before, after) = line.split_once('¦').unwrap_or((line, ""));
    let (start, candidates) = complete(&format!("{before}{after}"), before.len(), surroundings);
    let taken = candidates
        .iter()
        .map(|candidate| format!("{}{}{after}", &before[..start], candidate.replacement));
    taken.collect()
}

fn offered(line: &str) -> Vec<String> {
    offered_in(line, &surroundings())
}

fn names(line: &str) -> Vec<String> {
    let (_, candidates) = complete(line, line.len(), &surroundings());
    candidates.into_iter().map(|candidate| candidate.replacement).collect()
}

#[test]
fn names_of_the_session_and_the_language_are_offered() {
    assert_eq!(offered("ro"), ["rod", "rod_end", "round(", "round_to("]);
    assert_eq!(offered("1 + swi"), ["1 + swing(", "1 + switch"]);
    assert_eq!(offered("plot_h"), ["plot_history("]);
    assert_eq!(offered("plot_h¦(sim)"), ["plot_history(sim)"]);
    assert_eq!(offered("ene"), ["energy_decaying(", "energy_momentum()"]);
    assert_eq!(offered("TA"), ["TAU"]);
    assert_eq!(offered("wh"), ["while"]);
    assert_eq!(offered("sha"), ["shapes::"]);
    assert_eq!(offered("shapes::"), ["shapes::arc_of()", "shapes::arch("]);
    assert!(names("").len() > 50);
}

#[test]
fn offered_members_match_the_receiver_type() {
    assert_eq!(offered("rod.e"), ["rod.end"]);
    assert_eq!(offered("sim.history.dr"), ["sim.history.drift("]);
    assert_eq!(offered("scene.slider(rod.sta"), ["scene.slider(rod.start"]);
    let curve = names("line([0,0],[1,1]).");
    assert!(curve.iter().any(|name| name == "curvature("), "{curve:?}");
    assert!(!curve.iter().any(|name| name == "step("), "{curve:?}");
    assert_eq!(offered("values.ma"), ["values.map(", "values.max()"]);
    assert_eq!(offered("sim.history.column(\"t\").fil"), ["sim.history.column(\"t\").filter("]);
    assert_eq!(offered("settings.sp"), ["settings.spans"]);
    assert!(!names("settings.").contains(&"two words".to_owned()));
    assert_eq!(offered("unknown."), Vec::<String>::new());
    assert!(names("unknown.dri").contains(&"drift(".to_owned()));
}

#[test]
fn option_keys_are_offered_only_if_unused() {
    assert_eq!(offered("scene.beam(#{ ax"), ["scene.beam(#{ axis: "]);
    assert_eq!(offered("scene.start(#{ dt: 0.1, ¦ })").len(), 5);
    assert_eq!(
        offered("scene.start(#{ in¦: trapezoidal() })"),
        ["scene.start(#{ integrator: trapezoidal() })"]
    );
    assert_eq!(offered("scene.start(#{ in¦, integrator: trapezoidal() })"), Vec::<String>::new());
    assert_eq!(
        names("scene.start(#{ dt: 0.1, name: \"a\", "),
        ["integrator: ", "notes: ", "record: ", "snapshots: "]
    );
    assert_eq!(names("let m = #{ "), Vec::<String>::new());
    assert_eq!(offered("shapes::arch(#{ ri"), ["shapes::arch(#{ rise: "]);
    assert_eq!(names("shapes::arch(#{ rise: 1, "), ["span: "]);
    assert_eq!(
        names("scene.beam(#{ axis: line([0, 0], [1, 1]), basis: lagrange(#{ elem"),
        ["elements: "]
    );
    assert_eq!(offered("scene.beam(#{ axis: rod_"), ["scene.beam(#{ axis: rod_end"]);
}

#[test]
fn strings_are_completed_by_the_expected_parameter() {
    assert_eq!(offered("section(#{ shape: \"rec"), ["section(#{ shape: \"rectangle\""]);
    assert_eq!(offered("section(#{ shape: \"rec¦\" })"), ["section(#{ shape: \"rectangle\" })"]);
    assert_eq!(offered("sim.history.drift(\"g"), ["sim.history.drift(\"gap\""]);
    assert_eq!(offered("sim.history.column(\"ring"), ["sim.history.column(\"ring.force\""]);
    assert_eq!(
        offered("plot_history(sim, [\"t\", \"str"),
        ["plot_history(sim, [\"t\", \"strain\""]
    );
    assert_eq!(offered("settings[\"tw"), ["settings[\"two words\"]"]);
    assert_eq!(offered("settings[\"tw¦\"]"), ["settings[\"two words\"]"]);
    assert_eq!(offered("print(\"st"), Vec::<String>::new());
}

#[test]
fn files_are_completed_for_calls_imports_and_commands() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["rods.rhai", "spin.svg"] {
        fs::write(folder.path().join(name), "").expect("a file");
    }
    let surroundings = CompletionContext { folder: folder.path().to_owned(), ..surroundings() };
    let offered = |line| offered_in(line, &surroundings);
    assert_eq!(offered("import \"ro"), ["import \"rods\""]);
    assert_eq!(offered("plot_motion(sim, \"sp"), ["plot_motion(sim, \"spin.svg\""]);
    assert_eq!(offered(":save r"), [":save rods.rhai"]);
}

#[test]
fn commands_and_their_operands_are_completed() {
    assert_eq!(offered(":st"), [":step"]);
    assert_eq!(offered(":"), [":help", ":plot", ":save", ":show", ":step", ":time"]);
    assert_eq!(offered(":help plot_histor"), [":help plot_history"]);
    assert_eq!(offered("?plot_histor"), ["?plot_history"]);
    assert_eq!(offered("?settin"), ["?settings"]);
    assert_eq!(offered(":help shap"), [":help shapes"]);
    assert_eq!(offered(":plot kin"), [":plot kinetic"]);
    assert_eq!(offered(":plot t, kin"), [":plot t, kinetic"]);
    assert_eq!(offered(":plot kinetic, sim.pos"), [":plot kinetic, sim.position("]);
    assert_eq!(offered(":plot sim.position(rod.e"), [":plot sim.position(rod.end"]);
    assert_eq!(offered(":plot st"), [":plot strain"]);
    assert_eq!(offered(":plot s"), [":plot scene", ":plot settings", ":plot sim", ":plot strain"]);
    assert_eq!(offered(":plot ene"), [":plot energy"]);
    assert_eq!(offered(":time rod.e"), [":time rod.end"]);
    assert_eq!(offered(":step "), Vec::<String>::new());
}

#[test]
fn nothing_is_offered_in_comments_strings_and_new_names() {
    for line in
        ["// ro", "/* ro", "`ro", "`${x} ro", "let ro", "fn ro", "12", "'r", "1.5e", "\"a\""]
    {
        assert_eq!(offered(line), Vec::<String>::new(), "{line}");
    }
    assert_eq!(offered("`a ${rod_"), ["`a ${rod_end"]);
}

#[test]
fn completion_at_the_start_of_a_line_indents() {
    assert_eq!(offered("fn f() {\n"), ["fn f() {\n    "]);
}

proptest! {
    #[test]
    fn completion_of_any_input_replaces_text_before_the_cursor(
        line in "([ -~ä\n]|rod|sim|\\.|\\(|#\\{|\"|::|history|:plot |`|\\$\\{){0,20}", place in 0.0..1.0
    ) {
        let surroundings = surroundings();
        let place = (line.chars().count() as f64 * place) as usize;
        let position = line.char_indices().nth(place).map_or(line.len(), |(at, _)| at);
        let (start, _) = complete(&line, position, &surroundings);
        prop_assert!(start <= position && line.is_char_boundary(start));
    }
}
