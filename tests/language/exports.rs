//! Exported frames, arrays and tables, read by independent parsers and compared with the solver.
#![allow(clippy::unwrap_used)]

use std::collections::HashMap;
use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::common::notepad::Notepad;
use withy::beams::{BodyPoint, Station};
use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};
use withy::simulation::{NoMonitor, Simulation};

/// Clamped beam that falls, with a joint inside it, and a particle.
const SCENE: &str = "
let s = section(#{ EA: 1e4, GA: 4e3, EI: 20, rho_A: 1, rho_I: 1e-3 });
let scene = new_scene(\"fall\");
let rod = scene.beam(#{ name: \"rod\", axis: line([0, 0], [2, 1]), basis: bspline(4), section: s });
let arm = scene.beam(#{ name: \"arm\", axis: line([2, 1], [3, 1]), basis: lagrange(2), section: s });
scene.clamp(rod.start);
scene.hinge(rod.end, arm.start);
scene.particle([1, 5], 0.5, #{ name: \"stone\" });
scene.gravity([0, -9.81]);
";

/// Runs a script in its own folder. Returns the folder and the messages.
fn ran(text: &str) -> (TempDir, String) {
    let (folder, message) = (tempfile::tempdir().unwrap(), Notepad::default());
    let settings = RunSettings {
        out: folder.path().to_owned(),
        diagnostics: Box::new(message.clone()),
        ..RunSettings::silent(RunMode::Run)
    };
    let outcome = run(&Program::named("export", &format!("{SCENE}{text}")), &language(), settings);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    assert_eq!(outcome.checks.failed(), []);
    (folder, message.take())
}

fn attribute<'t>(tag: &'t str, name: &str) -> &'t str {
    tag.split_once(&format!(" {name}=\"")).unwrap().1.split_once('"').unwrap().0
}

fn decoded(letters: &str) -> Vec<u8> {
    let code = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => panic!("{letter} is no letter of base64"),
    };
    let mut bytes = Vec::new();
    let (mut word, mut bits) = (0_u32, 0);
    for letter in letters.trim_end_matches('=').bytes() {
        word = word << 6 | u32::from(code(letter));
        bits += 6;
        if bits >= 8 {
            bits -= 8;
            bytes.push((word >> bits & 0xff) as u8);
        }
    }
    bytes
}

/// Parsed grid.
struct Grid {
    fields: HashMap<String, Vec<f64>>,
    offsets: Vec<i64>,
    connectivity: Vec<i64>,
    bodies: Vec<i64>,
    types: Vec<u8>,
}

impl Grid {
    fn read(path: &Path) -> Self {
        let text = fs::read_to_string(path).unwrap();
        assert!(text.contains("byte_order=\"LittleEndian\" header_type=\"UInt64\""));
        let mut grid = Self {
            fields: HashMap::new(),
            offsets: Vec::new(),
            connectivity: Vec::new(),
            bodies: Vec::new(),
            types: Vec::new(),
        };
        for array in text.split("<DataArray").skip(1) {
            let (tag, rest) = array.split_once('>').unwrap();
            let bytes = decoded(rest.split_once('<').unwrap().0);
            let (count, bytes) = bytes.split_at(8);
            assert_eq!(u64::from_le_bytes(count.try_into().unwrap()), bytes.len() as u64, "{tag}");
            let eights = bytes.chunks_exact(8).map(|eight| <[u8; 8]>::try_from(eight).unwrap());
            match (attribute(tag, "Name"), attribute(tag, "type")) {
                ("offsets", _) => grid.offsets = eights.map(i64::from_le_bytes).collect(),
                ("connectivity", _) => grid.connectivity = eights.map(i64::from_le_bytes).collect(),
                ("body", _) => grid.bodies = eights.map(i64::from_le_bytes).collect(),
                ("types", _) => grid.types = bytes.to_vec(),
                (name, "Float64") => {
                    grid.fields.insert(name.to_owned(), eights.map(f64::from_le_bytes).collect());
                }
                _ => (),
            }
        }
        grid
    }

    fn vector(&self, name: &str, point: usize) -> [f64; 3] {
        self.fields[name][3 * point..][..3].try_into().unwrap()
    }
}

/// Times and paths of the frames of a collection.
fn frames(collection: &Path) -> Vec<(f64, std::path::PathBuf)> {
    let text = fs::read_to_string(collection).unwrap();
    let sets = text.split("<DataSet").skip(1);
    let folder = collection.parent().unwrap();
    sets.map(|set| {
        (attribute(set, "timestep").parse().unwrap(), folder.join(attribute(set, "file")))
    })
    .collect()
}

fn saved(folder: &Path, name: &str) -> Simulation {
    Simulation::from_bytes(&fs::read(folder.join(name)).unwrap()).unwrap().1
}

#[test]
fn frames_equal_the_solver_values_bit_for_bit() {
    let (folder, message) = ran(
        "let sim = scene.start(#{ dt: 0.01 }); sim.run_to(0.5); sim.save(\"run.withy\"); write_vtk(sim, \"run.pvd\", #{ every: 0.1 });",
    );
    assert!(!message.contains("another"), "{message}");
    let frames = frames(&folder.path().join("run.pvd"));
    let times: Vec<f64> = frames.iter().map(|frame| frame.0).collect();
    assert_eq!(times.len(), 6);
    let original = saved(folder.path(), "run.withy");
    // Repeats the run without the export functions.
    let mut again = Simulation::start(original.scene().clone(), *original.settings()).unwrap();
    for (time, path) in frames {
        again.run_to(time, &mut NoMonitor).unwrap();
        let grid = Grid::read(&path);
        // Cells: line segments, body by body, then a vertex.
        let (dot, lines) = grid.types.split_last().unwrap();
        assert!(*dot == 1 && lines.iter().all(|kind| *kind == 3));
        assert_eq!(grid.bodies.len(), grid.types.len());
        let last = |body: i64| {
            let cell = grid.bodies.iter().rposition(|of| *of == body).unwrap();
            grid.connectivity[grid.offsets[cell] as usize - 1] as usize
        };
        let ends = [(0, Station::on_beam(0, 5_f64.sqrt())), (1, Station::on_beam(1, 1.0))];
        for (cell, station) in ends {
            let place = again.place(&station).unwrap();
            let (position, velocity) =
                (again.model().position(&place), again.model().velocity(&place));
            assert_eq!(grid.vector("Points", last(cell)), [position.x, position.y, 0.0]);
            assert_eq!(grid.vector("velocity", last(cell)), [velocity.x, velocity.y, 0.0]);
        }
        let stone = BodyPoint::of_particle(2);
        let (position, velocity) = (again.model().position(&stone), again.model().velocity(&stone));
        assert_eq!(grid.vector("Points", last(2)), [position.x, position.y, 0.0]);
        assert_eq!(grid.vector("velocity", last(2)), [velocity.x, velocity.y, 0.0]);
        let clamp = again.section_forces(&Station::on_beam(0, 0.0)).unwrap();
        let message = ["N", "Q", "M"].map(|name| grid.fields[name][0]);
        assert_eq!(message, [clamp.axial, clamp.shear, clamp.moment]);
        // Exported section angles follow from normals between strain points, those of the solver from the steps. They agree approximately.
        let (start, end) = again.model().end_angles(0);
        assert!(
            (grid.fields["angle"][0] - start).abs() < 1e-2,
            "{start}, {}",
            grid.fields["angle"][0]
        );
        assert!(
            (grid.fields["angle"][last(0)] - end).abs() < 1e-2,
            "{end}, {}",
            grid.fields["angle"][last(0)]
        );
    }
}

#[test]
fn snapshots_and_repeated_run_give_the_same_bytes() {
    let run = |options: &str| {
        let start = format!("let sim = scene.start(#{{ dt: 0.01{options} }}); sim.run_to(0.3);");
        ran(&format!("{start} write_vtk(sim, \"a/run.pvd\", #{{ frames: 4 }});")).0
    };
    let (kept, again) = (run(", snapshots: 100"), run(""));
    for file in ["run.pvd", "run/run_0001.vtu", "run/run_0002.vtu", "run/run_0004.vtu"] {
        let read = |of: &TempDir| fs::read(of.path().join("a").join(file)).unwrap();
        assert_eq!(read(&kept), read(&again), "{file}");
    }
}

#[test]
fn free_ends_have_no_section_forces_and_full_turns_are_counted() {
    let (folder, _) = ran(
        "let free = new_scene(\"free\");
         let wheel = free.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(6), section: s, spin: 20 });
         let sim = free.start(#{ dt: 0.005 }); sim.run_to(1);
         write_vtk(sim, \"run.pvd\", #{ frames: 201 });",
    );
    let frames = frames(&folder.path().join("run.pvd"));
    assert_eq!(frames.len(), 201);
    let grids: Vec<Grid> = frames.iter().map(|(_, path)| Grid::read(path)).collect();
    let end = grids[0].fields["N"].len() - 1;
    // The beam rotates with ω = 20. The axial force in the middle oscillates about N = ρA ω² L²/8. The ends are free.
    let mean = |name: &str, point: usize| {
        grids.iter().map(|grid| grid.fields[name][point]).sum::<f64>() / grids.len() as f64
    };
    let middle = mean("N", end / 2);
    assert!((middle - 200.0).abs() < 20.0, "{middle}");
    for name in ["N", "Q", "M"] {
        assert!(mean(name, end).abs() < 0.05 * middle, "{name}: {}", mean(name, end));
    }
    let turned = grids[200].fields["angle"][end / 2];
    assert!((turned - 20.0).abs() < 1.0, "{turned}: three whole turns and some");
}

#[test]
fn run_that_cannot_be_repeated_exports_only_its_shape_with_a_note() {
    let script = |options: &str| {
        format!(
            "let rest = scene.equilibrium(); let sim = rest.start(#{{ dt: 0.01 }}); sim.run_to(0.1);
             write_vtk(sim, \"run.pvd\"{options});"
        )
    };
    // A separate scene, because the particle would fall.
    let scene = "let scene = new_scene(\"rest\");
        let rod = scene.beam(#{ axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });
        scene.clamp(rod.start); scene.gravity([0, -9.81]);";
    let (folder, message) = ran(&format!("{scene}{}", script("")));
    assert!(
        message.contains(
            "note: the earlier states of 'rest' are no longer stored, and the repeated run differs"
        ),
        "{message}"
    );
    let (_, path) = &frames(&folder.path().join("run.pvd"))[0];
    let grid = Grid::read(path);
    assert_eq!(
        grid.fields.keys().filter(|name| *name != "Points").collect::<Vec<_>>(),
        ["arc_length"]
    );
    let asked = script(", #{ fields: \"all\" }");
    let (_, message) = ran(&format!(
        "{scene} let refused = false; try {{ {asked} }} catch (error) {{ refused = `${{error}}`.contains(\"the repeated run differs\"); }} check(refused);"
    ));
    assert!(!message.contains("note: the states"), "{message}");
}

/// Arrays of an uncompressed archive: shapes as text, and numbers.
fn arrays(bytes: &[u8]) -> HashMap<String, (String, Vec<f64>)> {
    let mut arrays = HashMap::new();
    let mut at = 0;
    while bytes[at..].starts_with(b"PK\x03\x04") {
        let short =
            |from: usize| usize::from(u16::from_le_bytes([bytes[at + from], bytes[at + from + 1]]));
        let size = u32::from_le_bytes(bytes[at + 18..at + 22].try_into().unwrap()) as usize;
        let (name, more) = (short(26), short(28));
        let begin = at + 30 + name + more;
        let content = &bytes[begin..begin + size];
        let name = String::from_utf8(bytes[at + 30..at + 30 + name].to_vec()).unwrap();
        assert!(content.starts_with(b"\x93NUMPY\x01\x00"), "{name}");
        let header = usize::from(u16::from_le_bytes([content[8], content[9]]));
        let (header, numbers) = content[10..].split_at(header);
        let header = String::from_utf8(header.to_vec()).unwrap();
        let shape = header.split_once("'shape': (").unwrap().1.split_once(')').unwrap().0;
        let numbers =
            numbers.chunks_exact(8).map(|eight| f64::from_le_bytes(eight.try_into().unwrap()));
        arrays.insert(name, (shape.to_owned(), numbers.collect()));
        at = begin + size;
    }
    arrays
}

#[test]
fn arrays_contain_the_recorded_data() {
    let (folder, _) = ran(
        "let sim = scene.start(#{ dt: 0.01 }); sim.run_to(0.2); sim.save(\"run.withy\"); write_npz(sim, \"run.npz\");",
    );
    let simulation = saved(folder.path(), "run.withy");
    let arrays = arrays(&fs::read(folder.path().join("run.npz")).unwrap());
    let trajectory = simulation.trajectory();
    assert_eq!(arrays["t.npy"], ("21,".into(), trajectory.times().to_vec()));
    let (shape, rod) = &arrays["points.rod.npy"];
    assert_eq!(shape, "21, 7, 2,");
    assert_eq!(rod[7 * 2 * 20..], trajectory.configuration(20)[..14]);
    assert_eq!(arrays["points.stone.npy"].0, "21, 2,");
    assert_eq!(
        arrays["points.stone.npy"].1[40..],
        *trajectory.configuration(20).last_chunk::<2>().unwrap()
    );
    for (name, _) in simulation.history().columns() {
        assert_eq!(
            arrays[&format!("history.{name}.npy")].1,
            simulation.history().column(name).unwrap(),
            "{name}"
        );
    }
}

#[test]
fn tables_have_a_line_of_names_and_an_optional_line_of_units() {
    let (folder, _) = ran(
        "let sim = scene.start(#{ dt: 0.01 }); sim.run_to(0.2);
         write_csv(sim, \"plain.csv\"); write_csv(sim.history.after(0.1), \"units.csv\", #{ units: true });
         write_csv([#{ n: 8, error: 0.5, told: [1, 2] }, #{ n: 16, good: true }], \"rows.csv\");",
    );
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();
    let (plain, units) = (read("plain.csv"), read("units.csv"));
    assert!(plain.starts_with("t,kinetic,strain,potential,energy,"), "{plain}");
    assert_eq!(plain.lines().count(), 22);
    assert!(plain.lines().nth(1).unwrap().starts_with("0.0000000000000000e0,"));
    assert!(
        units
            .lines()
            .nth(1)
            .unwrap()
            .starts_with("time,energy,energy,energy,energy,energy,mass·length/time,")
    );
    assert_eq!(units.lines().count(), 13);
    assert_eq!(
        read("rows.csv"),
        "error,good,n,told\n5.0000000000000000e-1,,8,\"[1, 2]\"\n,true,16,\n"
    );
}
