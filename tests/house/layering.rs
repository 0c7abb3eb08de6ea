//! Layers: the modules that each module may use.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::path::{Path, PathBuf};

/// Layers in the order of docs/architecture.md. A layer may use those of later groups and all of [`BRANCHES`].
const CHAIN: &[&[&str]] = &[
    &["cli", "playground"],
    &["repl", "exercises"],
    &["script"],
    &["output", "analysis"],
    &["simulation"],
    &["statics"],
    &["vibration"],
    &["system"],
];

/// Layers below the model that are not part of the chain, each with the layers that it may use.
const BRANCHES: &[(&str, &[&str])] = &[
    ("joints", &["beams", "geometry", "elementary"]),
    ("loads", &["beams", "geometry", "elementary"]),
    ("beams", &["geometry", "threads", "elementary"]),
    ("geometry", &["elementary"]),
    ("integrators", &["newton", "linalg", "elementary"]),
    ("newton", &["linalg", "elementary"]),
    ("linalg", &["threads", "elementary"]),
    ("sampling", &["elementary"]),
    ("fitting", &["elementary"]),
    ("elementary", &[]),
    ("threads", &[]),
    ("sandbox_fs", &[]),
    ("panics", &[]),
];

/// Layers that a layer may use, or `None` for a layer that is in no table.
fn allowed(layer: &str) -> Option<Vec<&'static str>> {
    match layer {
        "main.rs" => return Some(vec!["cli"]),
        // The root of the script crate re-exports the layers of the mechanics crate.
        "lib.rs" => return allowed("analysis"),
        // The output layer draws plain data.
        "output" => return Some(vec!["elementary", "sandbox_fs"]),
        _ => {}
    }
    if let Some((_, uses)) = BRANCHES.iter().find(|(name, _)| *name == layer) {
        return Some(uses.to_vec());
    }
    let own = CHAIN.iter().position(|group| group.contains(&layer))?;
    let right = CHAIN[own + 1..].iter().copied().flatten().copied();
    Some(right.chain(BRANCHES.iter().map(|(name, _)| *name)).collect())
}

pub fn sources() -> Vec<(PathBuf, String)> {
    fn collect(folder: &Path, files: &mut Vec<(PathBuf, String)>) {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let path = entry.path();
            if path.ends_with("mechanics/examples") {
                continue;
            }
            if path.is_dir() {
                collect(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                files.push((path, text));
            }
        }
    }
    let mut files = Vec::new();
    collect(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut files);
    assert!(files.len() > 50, "src has {} files", files.len());
    files
}

/// Source folders of the crates: mechanics, and everything else.
pub fn crates() -> [PathBuf; 2] {
    ["src/mechanics", "src"].map(|root| Path::new(env!("CARGO_MANIFEST_DIR")).join(root))
}

/// Path of a source file relative to the source folder of its crate.
pub fn in_crate(path: &Path) -> &Path {
    crates().iter().find_map(|root| path.strip_prefix(root).ok()).unwrap()
}

pub fn layer(path: &Path) -> String {
    let first = in_crate(path).components().next().unwrap();
    first.as_os_str().to_string_lossy().into_owned()
}

/// Names after a path in the code of a file, with their lines. Names in braces are listed one by one, and comments are skipped.
pub fn named_after(text: &str, path: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    for (at, _) in text.match_indices(path) {
        let is_comment = text[..at].rsplit('\n').next().unwrap().contains("//");
        let is_part = text[..at].ends_with(|c: char| c.is_alphanumeric() || c == '_');
        if !is_comment && !is_part {
            let line = text[..at].matches('\n').count() + 1;
            let names = first_names(&text[at + path.len()..]);
            found.extend(names.into_iter().map(|name| (line, name)));
        }
    }
    found
}

/// First name after a path, or the first names of all entries of a list in braces, which may be nested.
fn first_names(rest: &str) -> Vec<String> {
    let word = |text: &str| {
        let name = text.trim().split(|c: char| !c.is_alphanumeric() && c != '_').next();
        name.unwrap_or_default().to_owned()
    };
    let Some(list) = rest.strip_prefix('{') else { return vec![word(rest)] };
    let (mut depth, mut part, mut names) = (0_usize, String::new(), Vec::new());
    for letter in list.chars() {
        match letter {
            ',' if depth == 0 => names.push(word(&std::mem::take(&mut part))),
            '}' if depth == 0 => break,
            '{' => depth += 1,
            '}' => depth -= 1,
            _ if depth == 0 => part.push(letter),
            _ => (),
        }
    }
    names.push(word(&part));
    names.retain(|name| !name.is_empty());
    names
}

pub fn without_tests<'t>(path: &Path, text: &'t str) -> &'t str {
    match path.file_stem().is_some_and(|name| name == "tests") {
        true => "",
        false => text.split("#[cfg(test)]\nmod tests {").next().unwrap(),
    }
}

/// Relative path from a file to the module of a root folder of its crate: one `super::` for each level, or `None` at the root.
fn upwards(path: &Path, root: &str) -> Option<String> {
    let depth = in_crate(path).strip_prefix(root).ok()?.components().count()
        - usize::from(path.ends_with("mod.rs"));
    (depth > 0).then(|| "super::".repeat(depth))
}

/// Boundaries between parts of the code.
pub struct DependencyRules<'r> {
    /// Word for a part in messages.
    pub part: &'static str,
    /// Folder of the crate with the parts.
    pub root: &'static str,
    /// Part of a file, or `None` for files outside all parts.
    pub of_file: &'r dyn Fn(&Path) -> Option<String>,
    /// Paths that precede names of parts.
    pub paths: &'static [&'static str],
    /// Part that a name refers to.
    pub of_name: &'r dyn Fn(&str) -> String,
    /// Returns true if a part may use another one, or `None` for a part that is in no table.
    pub may_use: &'r dyn Fn(&str, &str) -> Option<bool>,
}

impl DependencyRules<'_> {
    /// Forbidden uses, as `file:line: part uses part`.
    pub fn violations(&self, files: &[(PathBuf, String)]) -> Vec<String> {
        let mut found = Vec::new();
        for (path, text) in files {
            let Some(own) = (self.of_file)(path) else { continue };
            if (self.may_use)(&own, &own).is_none() {
                found.push(format!("{}: no {} '{own}' in the table", path.display(), self.part));
                continue;
            }
            // Unit tests are one module level deeper.
            let code = without_tests(path, text);
            let upwards = upwards(path, self.root);
            let named = self.paths.iter().flat_map(|of| named_after(text, of));
            let named = named.chain(upwards.iter().flat_map(|of| named_after(code, of)));
            for (line, name) in named {
                let other = (self.of_name)(&name);
                if other != own && (self.may_use)(&own, &other) != Some(true) {
                    found.push(format!("{}:{line}: {own} uses {other}", path.display()));
                }
            }
        }
        found
    }
}

/// Uses of layers that the table does not allow.
fn violations_in(files: &[(PathBuf, String)]) -> Vec<String> {
    let rules = DependencyRules {
        part: "layer",
        root: "",
        of_file: &|path| Some(layer(path)),
        paths: &["crate::", "withy::", "withy_mechanics::"],
        of_name: &str::to_owned,
        may_use: &|own, other| Some(allowed(own)?.contains(&other)),
    };
    rules.violations(files)
}

#[test]
fn layers_use_only_layers_to_their_right() {
    let found = violations_in(&sources());
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Submodules of the model, each with the submodules that it may use.
const SUBMODULES: &[(&str, &[&str])] = &[
    (
        "queries",
        &[
            "scene",
            "sensors",
            "mechanism",
            "state",
            "links",
            "sliders",
            "elements",
            "bodies",
            "errors",
        ],
    ),
    (
        "assembly",
        &["mechanism", "state", "links", "sliders", "scene", "elements", "bodies", "errors"],
    ),
    ("scene", &["sensors", "elements", "errors"]),
    ("sensors", &["mechanism", "elements"]),
    ("mechanism", &["state", "links", "sliders", "elements", "bodies", "errors"]),
    ("state", &[]),
    ("links", &["bodies"]),
    ("sliders", &["bodies", "errors", "step_mean"]),
    ("elements", &["bodies", "errors", "step_mean"]),
    ("bodies", &[]),
    ("step_mean", &[]),
    ("errors", &[]),
];

/// Submodule of a file of the model, given by its folder, or by its name if it has the name of a folder.
fn submodule(path: &Path) -> Option<String> {
    let first = in_crate(path).strip_prefix("system").ok()?.components().next()?;
    let name = first.as_os_str().to_str()?.trim_end_matches(".rs").to_owned();
    (name != "mod").then_some(name)
}

/// Uses between submodules that the table does not allow. `exports` are the submodules of names that the model re-exports.
fn submodule_violations_in(
    files: &[(PathBuf, String)],
    exports: &[(String, String)],
) -> Vec<String> {
    let of_name = |name: &str| {
        let of = exports.iter().find(|(export, _)| export == name);
        of.map_or_else(|| name.to_owned(), |(_, submodule)| submodule.clone())
    };
    let may_use = |own: &str, other: &str| {
        let (_, allowed) = SUBMODULES.iter().find(|(name, _)| *name == own)?;
        Some(allowed.contains(&other))
    };
    let (of_name, may_use) = (&of_name, &may_use);
    let paths = &["crate::system::"];
    DependencyRules {
        part: "submodule",
        root: "system",
        of_file: &submodule,
        paths,
        of_name,
        may_use,
    }
    .violations(files)
}

/// Names that `model/mod.rs` re-exports, with their submodules.
fn exports(text: &str) -> Vec<(String, String)> {
    let of_submodule = |(submodule, _): &(&str, &[&str])| {
        let names = named_after(text, &format!("pub use {submodule}::"));
        names.into_iter().map(|(_, name)| (name, (*submodule).to_owned())).collect::<Vec<_>>()
    };
    SUBMODULES.iter().flat_map(of_submodule).collect()
}

#[test]
fn submodules_of_the_model_have_no_cyclic_dependencies() {
    let files = sources();
    let (_, handed_on) = files.iter().find(|(path, _)| path.ends_with("system/mod.rs")).unwrap();
    let exports = exports(handed_on);
    assert!(exports.contains(&("AxialImpact".to_owned(), "sliders".to_owned())), "{exports:?}");
    let found = submodule_violations_in(&files, &exports);
    assert!(found.is_empty(), "{}", found.join("\n"));
    for (at, (submodule, allowed)) in SUBMODULES.iter().enumerate() {
        let later = |name: &&str| SUBMODULES[at + 1..].iter().any(|(other, _)| other == name);
        assert!(allowed.iter().all(later), "{submodule} may use one that may use it");
    }
    let bodies = crates()[0].join("system/bodies/body.rs");
    let text =
        "// crate::system::scene\nuse crate::system::{\n    System, errors::finite};\n".to_owned();
    assert_eq!(submodule_violations_in(&[(bodies.clone(), text)], &exports).len(), 2);
    let text =
        "use super::body::Body;\nuse super::super::{\n    System, errors::finite};\n".to_owned();
    assert_eq!(submodule_violations_in(&[(bodies, text)], &exports).len(), 2);
    let beside = crates()[0].join("system/mechanism.rs");
    let text = "use super::state::MotionState;\nuse super::scene::Scene;\n".to_owned();
    let found = submodule_violations_in(&[(beside, text)], &exports);
    assert!(found.len() == 1 && found[0].ends_with("rs:2: mechanism uses scene"), "{found:?}");
}

#[test]
fn model_and_simulation_have_at_most_ten_private_fields() {
    for (file, name) in [("system/mechanism.rs", "System"), ("simulation/run.rs", "Simulation")] {
        let path = crates()[0].join(file);
        let text = fs::read_to_string(path).unwrap();
        let (_, fields) = text.split_once(&format!("pub struct {name} {{\n")).unwrap();
        let (fields, _) = fields.split_once("\n}").unwrap();
        let fields: Vec<&str> =
            fields.lines().map(str::trim).filter(|line| !line.starts_with("//")).collect();
        assert!((5..=10).contains(&fields.len()), "{name}: {fields:?}");
        assert!(!fields.iter().any(|field| field.starts_with("pub")), "{name}: {fields:?}");
    }
}

#[test]
fn forbidden_dependency_is_detected() {
    let beams = crates()[0].join("beams/mesh.rs");
    let text = "use crate::geometry::Vec2;\n// crate::system is fine here\nuse crate::integrators::Stage;\n";
    let found = violations_in(&[(beams, text.to_owned())]);
    assert!(
        found.len() == 1 && found[0].ends_with("mesh.rs:3: beams uses integrators"),
        "{found:?}"
    );
}

#[test]
fn mod_files_contain_no_code() {
    const CODE: [&str; 6] = ["fn ", "struct ", "enum ", "trait ", "impl ", "macro_rules"];
    let is_code = |line: &&str| {
        let item = line.trim_start_matches("pub ").trim_start_matches("const ");
        CODE.iter().any(|code| item.starts_with(code))
    };
    let files = sources();
    let mut folders = files.iter().filter(|(path, _)| path.ends_with("mod.rs"));
    assert!(folders.clone().count() > 30);
    let found = folders.find_map(|(path, text)| Some((path, text.lines().find(is_code)?)));
    assert_eq!(found, None, "code belongs into a file with a name");
    assert!(is_code(&"pub fn f() {") && is_code(&"trait T {") && is_code(&"pub const fn f() {"));
    assert!(!is_code(&"pub const TABLES: &[&str] = &[") && !is_code(&"pub use a::implied;"));
}

#[test]
fn names_in_nested_use_lists_are_found() {
    let text = "use crate::{\n    system::{System, errors::finite},\n    beams::Mesh,\n};\nlet a = mycrate::x;\n";
    assert_eq!(named_after(text, "crate::"), [(1, "system".to_owned()), (1, "beams".to_owned())]);
}

/// Names of beams, other than stations, that joints and loads use.
fn beam_names_used_in(files: &[(PathBuf, String)]) -> Vec<String> {
    let of_beams = |path: &Path, text: &str| -> Vec<(usize, String)> {
        let upwards = upwards(path, "").into_iter().map(|up| format!("{up}beams::"));
        let paths = upwards.chain(["crate::beams::".to_owned()]);
        paths.flat_map(|of| named_after(without_tests(path, text), &of)).collect()
    };
    let own = files.iter().filter(|(path, _)| ["joints", "loads"].contains(&&*layer(path)));
    let named = own.flat_map(|(path, text)| {
        // A list of layers would hide the names that are used from beams.
        let lists = named_after(text, "crate::{").into_iter().filter(|(_, name)| name == "beams");
        let names = of_beams(path, text).into_iter().filter(|(_, name)| name != "Station");
        names.chain(lists).map(|(line, name)| format!("{}:{line}: {name}", path.display()))
    });
    named.collect()
}

#[test]
fn joints_and_loads_use_only_the_stations_of_a_beam() {
    let found = beam_names_used_in(&sources());
    assert!(found.is_empty(), "{}", found.join("\n"));
    let joint = crates()[0].join("joints/joint.rs");
    let text = "use crate::beams::{Mesh, Station};\nuse super::super::beams::Section;\nuse crate::{beams::Mesh};\n";
    assert_eq!(beam_names_used_in(&[(joint, text.to_owned())]).len(), 3);
}
