//! Viewers and animations, compared with the solver.
#![allow(clippy::unwrap_used)]

use std::fs;
use std::io::Read;

use flate2::read::ZlibDecoder;
use serde_json::Value;

use crate::common::notepad::Notepad;
use withy::script::engine::runner::{Ending, run};
use withy::script::packages::language;
use withy::script::source::program::Program;
use withy::script::state::settings::{RunMode, RunSettings};

/// Two beams and a particle under gravity, a follower load, a dead load and a slider.
const SCENE: &str = "
let s = section(#{ EA: 1e4, GA: 1e4, EI: 100, rho_A: 1, rho_I: 10 });
let scene = new_scene(\"two\");
let one = scene.beam(#{ name: \"one\", axis: line([0, 0], [2, 0]), basis: bspline(4), section: s });
let two = scene.beam(#{ name: \"two\", axis: line([2, 0], [4, 0]), basis: lagrange(#{ elements: 3, degree: 2 }), section: s });
scene.hinge(one.start);
scene.hinge(one.end, two.start);
scene.gravity([0, -9.81]);
scene.force(two.end, [0, 20], pulse(0.5, 1));
let ring = scene.particle([3, 0], 0.1, #{ name: \"ring\" });
scene.slider(ring, two, #{ name: \"slide\", at: 0.5, ends: \"bounce\" });
let sim = scene.start(#{ dt: 0.02 });
";

/// Output of a script and the content of a file that it writes.
fn written(script: &str, file: &str) -> (String, Vec<u8>) {
    written_in(SCENE, script, file)
}

/// The same for another scene.
fn written_in(scene: &str, script: &str, file: &str) -> (String, Vec<u8>) {
    let out = tempfile::tempdir().unwrap();
    let printed = Notepad::default();
    let settings = RunSettings {
        out: out.path().to_owned(),
        printed: Box::new(printed.clone()),
        ..RunSettings::silent(RunMode::Run)
    };
    let program = Program::named("viewer", &format!("{scene}{script}"));
    let outcome = run(&program, &language(), settings);
    assert!(matches!(outcome.ending, Ending::Finished), "{:?}", outcome.ending);
    (printed.take(), fs::read(out.path().join(file)).unwrap_or_default())
}

fn refused(script: &str) -> String {
    let program = Program::named("viewer", &format!("{SCENE}sim.run_to(0.1);\n{script}"));
    match run(&program, &language(), RunSettings::silent(RunMode::Run)).ending {
        Ending::Failed(diagnostic) => diagnostic.render(withy::script::diagnose::Colours::None),
        other => panic!("{other:?}"),
    }
}

fn data(page: &[u8]) -> Value {
    let page = String::from_utf8(page.to_vec()).unwrap();
    let (_, rest) = page.split_once("id=\"data\">").unwrap();
    serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap()
}

/// Decodes time series like the page does, number by number.
fn series(packed: &Value) -> Vec<Vec<f64>> {
    let whole = |name: &str| packed[name].as_u64().unwrap() as usize;
    let (numbers, frames) = (whole("numbers"), whole("frames"));
    let (origin, step) = (packed["origin"].as_f64().unwrap(), packed["step"].as_f64().unwrap());
    let mut bytes = Vec::new();
    let deflated = from_letters(packed["data"].as_str().unwrap());
    ZlibDecoder::new(deflated.as_slice()).read_to_end(&mut bytes).unwrap();
    assert_eq!(bytes.len(), 2 * numbers * frames);
    let series = |number: usize| {
        let (mut code, mut change) = (0u16, 0u16);
        let at = |frame: usize| {
            let index = number * frames + frame;
            let word = u16::from(bytes[index]) << 8 | u16::from(bytes[numbers * frames + index]);
            let difference = (word >> 1) ^ (0u16.wrapping_sub(word & 1));
            let second = whole("order") == 2;
            change = if second { change.wrapping_add(difference) } else { difference };
            code = code.wrapping_add(change);
            if code == u16::MAX { f64::NAN } else { origin + step * f64::from(code) }
        };
        (0..frames).map(at).collect()
    };
    (0..numbers).map(series).collect()
}

fn from_letters(text: &str) -> Vec<u8> {
    let value = |letter: u8| match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        other => panic!("{other}"),
    };
    let letters: Vec<u8> = text.bytes().filter(|letter| *letter != b'=').map(value).collect();
    let group = |group: &[u8]| {
        let word = group.iter().fold(0u32, |word, six| word << 6 | u32::from(*six));
        let word = word << (6 * (4 - group.len()));
        [(word >> 16) as u8, (word >> 8) as u8, word as u8][..group.len() - 1].to_vec()
    };
    letters.chunks(4).flat_map(group).collect()
}

/// Positions of a material point of a film in all frames.
fn path(viewer_data: &Value, place: &Value) -> Vec<(f64, f64)> {
    let first = place[0].as_u64().unwrap() as usize;
    let weights: Vec<f64> =
        place[1].as_array().unwrap().iter().map(|w| w.as_f64().unwrap()).collect();
    let (x, y) = (series(&viewer_data["x"]), series(&viewer_data["y"]));
    let sum = |all: &[Vec<f64>], frame: usize| {
        weights.iter().enumerate().map(|(index, w)| w * all[first + index][frame]).sum::<f64>()
    };
    (0..x[0].len()).map(|frame| (sum(&x, frame), sum(&y, frame))).collect()
}

#[test]
fn positions_agree_with_the_solver() {
    let script = "
        let told = [];
        let where_is = |sim| print(`${sim.t} ${sim.position(two.at(1.3)).x} ${sim.position(two.at(1.3)).y} ${sim.position(ring).x} ${sim.position(ring).y}`);
        for k in 1..=50 { sim.at(k * 0.04, where_is); }
        sim.run_to(2);
        write_viewer(sim, \"page.html\", #{ trails: [two.at(1.3), ring] });";
    let (printed, page) = written(script, "page.html");
    let data = data(&page);
    let viewer_data = &data["films"][0];
    let times: Vec<_> =
        viewer_data["times"].as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect();
    assert!(times.len() >= 101, "every step is a frame, and every bounce of the ring");
    let step = viewer_data["x"]["step"].as_f64().unwrap();
    let extent = step * 65534.0;
    assert!(extent > 3.0 && extent < 10.0, "{extent}");
    let paths: Vec<_> =
        (0..2).map(|trail| path(viewer_data, &viewer_data["trails"][trail]["at"])).collect();
    let mut compared = 0;
    for line in printed.lines() {
        let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
        let frame = times.iter().position(|time| (time - numbers[0]).abs() < 1e-12).unwrap();
        for (path, at) in paths.iter().zip([&numbers[1..3], &numbers[3..5]]) {
            let off = (path[frame].0 - at[0]).abs().max((path[frame].1 - at[1]).abs());
            // Half a quantisation step, and the rounding of at most three weights.
            assert!(off <= 0.51 * step * 1.3, "off by {off} at t = {}", numbers[0]);
            compared += 1;
        }
    }
    assert_eq!(compared, 100);
}

#[test]
fn columns_and_colours_are_those_of_the_run() {
    let script = "
        sim.run_to(1);
        for energy in sim.history.column(\"kinetic\") { print(energy); }
        write_viewer(sim, \"page.html\", #{ columns: [\"kinetic\", \"slide.force\"], fields: [\"speed\"] });";
    let (printed, page) = written(script, "page.html");
    let data = data(&page);
    let viewer_data = &data["films"][0];
    let column = &viewer_data["history"]["columns"][0];
    assert_eq!(
        (column["name"].as_str(), column["unit"].as_str()),
        (Some("kinetic"), Some("energy"))
    );
    let values = series(&column["values"]).remove(0);
    let step = column["values"]["step"].as_f64().unwrap();
    let known: Vec<f64> = printed.lines().map(|line| line.parse().unwrap()).collect();
    assert_eq!(known.len(), values.len());
    assert!(known.iter().zip(&values).all(|(a, b)| (a - b).abs() <= 0.51 * step));
    // The speed at the last station of the last beam is compared with the path of this point.
    let fields = viewer_data["fields"].as_array().unwrap();
    assert_eq!((fields.len(), fields[0]["name"].as_str()), (1, Some("speed")));
    let speeds = series(&fields[0]["values"]);
    let line =
        viewer_data["shapes"][viewer_data["beams"][1]["shape"].as_u64().unwrap() as usize]["line"]
            .clone();
    let mut end = line.as_array().unwrap().last().unwrap().clone();
    end[0] = (end[0].as_u64().unwrap() + viewer_data["beams"][1]["first"].as_u64().unwrap()).into();
    let way = path(viewer_data, &end);
    for frame in [10, 25, 40] {
        let (a, b) = (way[frame - 1], way[frame + 1]);
        let speed = (b.0 - a.0).hypot(b.1 - a.1) / 0.04;
        let shown = speeds.last().unwrap()[frame];
        assert!((speed - shown).abs() < 0.01 * speed + 0.02, "{speed} is shown as {shown}");
    }
}

#[test]
fn moments_and_strain_energy_agree_with_the_states_of_repeated_runs() {
    // Section forces at both ends of the first beam, then at the end of the second beam.
    let script = "
        let look = |q| { let f = [q.section_forces(one, 0), q.section_forces(one, 2), q.section_forces(two, 2)];
            for s in f { print(`${q.t} ${s.M} ${0.5 * (s.N * s.axial_strain + s.Q * s.shear_strain + s.M * s.curvature)}`); } };
        for k in 1..=24 { sim.at(k * 0.04, look); }
        sim.run_to(1);
        check(sim.events.len() > 0, \"the ring bounces\");
        write_viewer(sim, \"page.html\", #{ fields: [\"M\", \"strain_energy\"] });";
    let of_kept = SCENE.replace("dt: 0.02", "dt: 0.02, snapshots: 50");
    let both = [SCENE, of_kept.as_str()].map(|scene| written_in(scene, script, "page.html"));
    assert_eq!(both[0].1, both[1].1, "kept states are those of the run made again");
    let data = data(&both[0].1);
    let viewer_data = &data["films"][0];
    let names: Vec<_> =
        viewer_data["fields"].as_array().unwrap().iter().map(|f| &f["name"]).collect();
    assert_eq!(names, ["bending moment", "strain energy per length"]);
    let times: Vec<f64> =
        viewer_data["times"].as_array().unwrap().iter().map(|t| t.as_f64().unwrap()).collect();
    let stations = |beam: usize| {
        let shape = viewer_data["beams"][beam]["shape"].as_u64().unwrap() as usize;
        viewer_data["shapes"][shape]["stations"].as_array().unwrap().len()
    };
    let places = [0, stations(0) - 1, stations(0) + stations(1) - 1];
    let values = [0, 1].map(|field| series(&viewer_data["fields"][field]["values"]));
    let steps =
        [0, 1].map(|field| viewer_data["fields"][field]["values"]["step"].as_f64().unwrap());
    let lines: Vec<&str> = both[0].0.lines().collect();
    assert_eq!(lines.len(), 72);
    for (index, line) in lines.iter().enumerate() {
        let numbers: Vec<f64> = line.split(' ').map(|number| number.parse().unwrap()).collect();
        let frame = times.iter().position(|time| (time - numbers[0]).abs() < 1e-12).unwrap();
        for field in [0, 1] {
            let (shown, known) = (values[field][places[index % 3]][frame], numbers[1 + field]);
            assert!((shown - known).abs() <= 0.51 * steps[field], "{line}: {shown}");
        }
    }
    assert!(steps.iter().all(|step| *step > 0.0));
}

#[test]
fn springs_are_drawn_and_sliders_disappear_after_leaving() {
    let script = "
        scene.spring([0, 3], two.end, #{ name: \"hook\", stiffness: 50 });
        scene.spring(one.at(1), two.at(1), #{ name: \"brake\", damping: 2 });
        let free = scene.particle([1, 0], 0.1, #{ name: \"free\", velocity: [3, 0] });
        scene.slider(free, one, #{ name: \"leaver\", ends: \"release\" });
        let run = scene.start(#{ dt: 0.02 });
        run.run_to(1);
        for event in run.events { if event.what == \"released\" { print(event.t); } }
        write_viewer(run, \"page.html\", #{ fields: [] });";
    let (printed, page) = written(script, "page.html");
    let data = data(&page);
    let viewer_data = &data["films"][0];
    let springs = viewer_data["springs"].as_array().unwrap();
    assert_eq!(
        springs.iter().map(|one| one["kind"].as_str().unwrap()).collect::<Vec<_>>(),
        ["spring", "damper"]
    );
    assert_eq!(springs[0]["anchors"][0], serde_json::json!({ "x": 0.0, "y": 3.0 }));
    assert!(springs[1]["anchors"].as_array().unwrap().iter().all(Value::is_array));
    let symbols = viewer_data["symbols"].as_array().unwrap();
    let leaver = symbols.iter().find(|one| one["name"] == "leaver").unwrap();
    assert_eq!(leaver["until"].as_f64(), Some(printed.trim().parse().unwrap()));
    let others = symbols.iter().filter(|one| one["name"] != "leaver");
    assert!(others.into_iter().all(|one| one["until"].is_null()));
}

#[test]
fn rigid_bodies_have_outlines_and_drives_have_symbols() {
    let script = "
        let wheel = scene.body(#{ name: \"wheel\", at: [5, 0], mass: 1, inertia: 1, angle: 0.3,
                                  points: #{ e: [1, 0], n: [0, 1], w: [-1, 0] } });
        let arm = scene.body(#{ name: \"arm\", at: [8, 0], mass: 1, inertia: 1, points: #{ eye: [0.5, 0] },
                                outline: [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5]] });
        let bob = scene.body(#{ name: \"bob\", at: [9, 0], mass: 1, inertia: 1 });
        scene.hinge(wheel.centre);
        scene.motor(wheel.centre, #{ angle: |t| t * t });
        scene.move(arm.centre, #{ x: |t| 0.1 * t * t, y: 0, angle: 0 });
        scene.support(bob.centre, #{ y: true });
        let run = scene.start(#{ dt: 0.02 });
        run.run_to(0.5);
        let p = run.position(wheel.point(\"n\"));
        print(`${p.x} ${p.y}`);
        write_viewer(run, \"page.html\", #{ fields: [] });";
    let (printed, page) = written(script, "page.html");
    let data = data(&page);
    let viewer_data = &data["films"][0];
    let kinds: Vec<&str> = viewer_data["symbols"]
        .as_array()
        .unwrap()
        .iter()
        .map(|one| one["kind"].as_str().unwrap())
        .collect();
    assert_eq!(kinds, ["hinge", "joint", "hinge", "roller", "motor", "carriage", "slider"]);
    let bodies = viewer_data["bodies"].as_array().unwrap();
    let outlines: Vec<usize> =
        bodies.iter().map(|body| body["outline"].as_array().unwrap().len()).collect();
    assert_eq!(outlines, [4, 2, 0], "closed, a line from the centre, none");
    let corners = |body: usize| bodies[body]["corners"].to_string();
    assert_eq!(corners(0), "[]");
    assert_eq!(
        corners(1),
        "[[1.0,1.0],[-1.0,1.0],[-1.0,-1.0],[1.0,1.0]]",
        "in lengths from its centre to its eye"
    );
    let names: Vec<&str> = bodies[0]["points"]
        .as_array()
        .unwrap()
        .iter()
        .map(|at| at["name"].as_str().unwrap())
        .collect();
    assert_eq!(names, ["wheel.e", "wheel.n", "wheel.w"]);
    // The recorded points of a body include the point of the station, with the position of the solver in the last frame.
    let place = bodies[0]["points"][1]["at"].as_array().unwrap();
    let first = place[0].as_u64().unwrap() as usize;
    let known: Vec<f64> = printed.trim().split(' ').map(|number| number.parse().unwrap()).collect();
    for (axis, known) in ["x", "y"].into_iter().zip(known) {
        let shown = *series(&viewer_data[axis])[first].last().unwrap();
        assert!((shown - known).abs() < 1e-3, "{axis}: {shown} {known}");
    }
}

#[test]
fn symbols_and_loads_are_in_the_page() {
    let (_, page) = written("sim.run_to(1);\nwrite_viewer(sim, \"page.html\");", "page.html");
    let data = data(&page);
    let viewer_data = &data["films"][0];
    let kinds = |name: &str| -> Vec<String> {
        let all = viewer_data[name].as_array().unwrap().iter();
        all.map(|one| one["kind"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(kinds("symbols"), ["hinge", "joint", "slider"]);
    let loads = series(&viewer_data["arrows"]["values"]);
    let at = |time: f64| loads[1][(time / 0.02) as usize];
    assert_eq!((loads.len(), at(0.2)), (2, 0.0));
    assert!((at(0.7) - 1.0).abs() < 1e-3, "relative to the largest");
    let trails = viewer_data["trails"].as_array().unwrap();
    assert_eq!(trails.len(), 3, "the end of both beams and the ring: {trails:?}");
}

#[test]
fn equal_runs_give_equal_pages_and_frames_are_bounded() {
    let script = "sim.run_to(2);\nwrite_viewer([sim, sim.fork()], \"page.html\", #{ frames: 21, labels: [\"a\", \"b\"] });";
    let (one, two) = (written(script, "page.html").1, written(script, "page.html").1);
    assert_eq!(one, two);
    let data = data(&one);
    assert_eq!(data["films"].as_array().unwrap().len(), 2);
    assert_eq!(data["films"][1]["label"], "b");
    let times = data["films"][0]["times"].as_array().unwrap();
    assert_eq!((times.len(), times[20].as_f64()), (21, Some(2.0)));
    assert!((times[7].as_f64().unwrap() - 0.7).abs() < 0.011);
}

#[test]
fn fifty_beams_in_a_thousand_frames_stay_below_five_megabytes() {
    let script = "
        let many = new_scene(\"many\");
        for row in 0..50 {
            let beam = many.beam(#{ name: `b${row}`, axis: line([0, row], [10, row]), basis: bspline(8), section: s, spin: 0.1 * row });
        }
        let all = many.start(#{ dt: 0.01 });
        all.run_to(10);
        write_viewer(all, \"page.html\");";
    let (_, page) = written(script, "page.html");
    let frames = data(&page)["films"][0]["times"].as_array().unwrap().len();
    assert_eq!(frames, 1000);
    assert!(page.len() < 5_000_000, "{} bytes", page.len());
}

#[test]
fn invalid_options_are_reported() {
    let said = refused("write_viewer(sim, \"page.htm\");");
    assert!(said.contains("\"page.htm\" does not end in .html"), "{said}");
    let said = refused("write_viewer(sim, \"a.html\", #{ columns: [\"kinetc\"] });");
    assert!(
        said.contains("no column \"kinetc\"") && said.contains("did you mean \"kinetic\"?"),
        "{said}"
    );
    let said = refused("write_viewer(sim, \"a.html\", #{ fields: [\"spede\"] });");
    assert!(
        said.contains("no field \"spede\"") && said.contains("did you mean \"speed\"?"),
        "{said}"
    );
    let said = refused("write_viewer([sim, sim], \"a.html\", #{ labels: [\"a\"] });");
    assert!(said.contains("1 labels are given for 2 simulations"), "{said}");
    let said = refused("write_viewer(sim, \"a.html\", #{ from: 3 });");
    assert!(said.contains("'two' has no recorded state from t = 3"), "{said}");
    let said = refused("write_viewer([], \"a.html\");");
    assert!(said.contains("one or more simulations"), "{said}");
    let said = refused("write_animation(sim, \"a.gif\");");
    assert!(said.contains("does not end in .png"), "{said}");
}

/// Decoded frame of an animation: red, green and blue of each pixel, and the width.
struct Frame {
    pixels: Vec<u8>,
    width: usize,
}

impl Frame {
    /// Frames of an animated picture and their delays. Each frame replaces a part of the previous one.
    fn all(bytes: &[u8]) -> Vec<(Self, (u16, u16))> {
        let mut decoder = png::Decoder::new(bytes);
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().unwrap();
        let (width, height) = (reader.info().width as usize, reader.info().height as usize);
        let control = *reader.info().animation_control().unwrap();
        assert_eq!(control.num_plays, 0, "without end");
        let mut shown = vec![0; width * height * 3];
        let frame = |_| {
            let mut part = vec![0; reader.output_buffer_size()];
            reader.next_frame(&mut part).unwrap();
            let about = *reader.info().frame_control().unwrap();
            let wide = about.width as usize;
            for (row, line) in part.chunks_exact(3 * wide).take(about.height as usize).enumerate() {
                let at = (about.y_offset as usize + row) * width + about.x_offset as usize;
                shown[3 * at..3 * (at + wide)].copy_from_slice(line);
            }
            (Self { pixels: shown.clone(), width }, (about.delay_num, about.delay_den))
        };
        (0..control.num_frames).map(frame).collect()
    }

    /// Positions of all pixels of approximately this colour.
    fn places(&self, colour: [u8; 3]) -> Vec<(f64, f64)> {
        let is_it = |pixel: &[u8]| pixel.iter().zip(colour).all(|(a, b)| a.abs_diff(b) < 24);
        let all = self.pixels.chunks_exact(3).enumerate().filter(|(_, pixel)| is_it(pixel));
        all.map(|(at, _)| ((at % self.width) as f64 + 0.5, (at / self.width) as f64 + 0.5))
            .collect()
    }

    /// Brightness of the darkest pixel near a position.
    fn darkest(&self, (x, y): (f64, f64)) -> u8 {
        let near = |x: f64| (x - 1.0).floor() as usize..=(x + 1.0).floor() as usize;
        let green =
            |(column, row): (usize, usize)| self.pixels[3 * (row * self.width + column) + 1];
        near(y).flat_map(|row| near(x).map(move |column| (column, row))).map(green).min().unwrap()
    }
}

#[test]
fn animated_tip_position_agrees_with_the_solver() {
    let script = "
        for k in 0..=10 { sim.run_to(0.1 * k); let p = sim.position(two.end); print(`${p.x} ${p.y}`); }
        write_animation(sim, \"a.png\", #{ frames: 11, fps: 10, width: 400, symbols: false });";
    let (printed, bytes) = written(script, "a.png");
    assert!(bytes.len() < 200_000, "{} bytes", bytes.len());
    let frames = Frame::all(&bytes);
    assert_eq!((frames.len(), frames[0].0.width), (11, 400));
    assert!(frames.iter().all(|(_, delay)| *delay == (1, 10)));
    // At the start the second beam, drawn in the second colour, extends from x = 2 to x = 4. Dots of radius 2.4 cover its ends.
    let start: Vec<_> =
        frames[0].0.places([213, 94, 0]).into_iter().filter(|at| at.1 > 60.0).collect();
    let end = |pick: fn(f64, f64) -> f64| start.iter().map(|at| at.0).reduce(pick).unwrap();
    let (left, right) = (end(f64::min) - 2.9, end(f64::max) + 2.9);
    let scale = (right - left) / 2.0;
    let level = start.iter().map(|at| at.1).sum::<f64>() / start.len() as f64;
    assert!(scale > 20.0 && start.len() > 30, "{scale}, {}", start.len());
    let mut found = 0;
    for (line, (frame, _)) in printed.lines().zip(&frames) {
        let (x, y) = line.split_once(' ').unwrap();
        let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
        let tip = (left + (x - 2.0) * scale, level - y * scale);
        assert!(frame.darkest(tip) < 80, "at ({x}, {y}) is nothing");
        found += 1;
    }
    assert_eq!(found, 11);
}

#[test]
fn animations_are_arranged_side_by_side() {
    let script = "sim.run_to(1);\nwrite_animation([sim, sim.fork()], \"b.png\", #{ frames: 3, trace: [two.end] });";
    let frames = Frame::all(&written(script, "b.png").1);
    assert_eq!((frames.len(), frames[0].0.width, frames[0].1), (3, 960, (1, 20)));
    assert!(frames.windows(2).all(|pair| pair[0].0.pixels != pair[1].0.pixels));
}

#[test]
fn obstacles_are_in_the_page() {
    let script = "
        scene.wall([0, -1], [0, 2], #{ stiffness: 1e4, name: \"floor\" });
        scene.disc([1, -0.5], 0.2, #{ stiffness: 1e4, name: \"peg\" });
        let sim = scene.start(#{ dt: 0.02 });
        sim.run_to(0.1);
        write_viewer(sim, \"page.html\");";
    let page = data(&written(script, "page.html").1);
    let [floor, peg] = page["films"][0]["obstacles"].as_array().unwrap().as_slice() else {
        panic!()
    };
    assert_eq!((&floor["name"], &floor["direction"]), (&"floor".into(), &vec![0.0, 1.0].into()));
    assert_eq!((&peg["name"], &peg["direction"]), (&"peg".into(), &vec![0.2, 0.0].into()));
}
