//! Sample pictures with realistic content. If `WITHY_SAMPLES` is set to a folder, the files are kept in it.

use super::*;

fn show(name: &str, panel: &impl Panel, labels: &[&str]) {
    let vanishing = tempfile::tempdir().unwrap();
    let folder =
        std::env::var_os("WITHY_SAMPLES").map_or(vanishing.path().into(), std::path::PathBuf::from);
    let [svg, png] = ["svg", "png"].map(|ending| folder.join(format!("{name}.{ending}")));
    panel.save(&svg).unwrap();
    let drawing = std::fs::read_to_string(svg).unwrap();
    let description = drawing.split_once("<desc>").unwrap().1.split_once("</desc>").unwrap().0;
    for label in labels {
        assert!(
            description.split(" | ").any(|text| text == *label),
            "{name}: {label}: {description}"
        );
    }
    panel.save(&png).unwrap();
    let file = std::io::BufReader::new(std::fs::File::open(png).unwrap());
    let mut reader = ::png::Decoder::new(file).read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!((info.width, info.height), panel.figure().unwrap().size(), "{name}");
    let pixels = &pixels[..info.buffer_size()];
    assert_eq!(pixels[..3], [255, 255, 255], "{name}: the paper is white");
    let ink = pixels.chunks_exact(3).filter(|pixel| **pixel != [255, 255, 255]).count();
    let part = ink as f64 / (pixels.len() / 3) as f64;
    assert!((0.005..0.9).contains(&part), "{name}: {part} of the pixels are drawn on");
}

fn series(name: &str, value: impl Fn(f64) -> f64) -> Series {
    Series::new(name, (0..=400).map(|i| f64::from(i) * 0.025).map(|t| (t, value(t))).collect())
}

fn tumbling(time: f64, bend: f64) -> MotionFrame {
    let place = |s: f64| {
        let angle = -0.7 - 0.9 * time + bend * (s - 0.5) * (1.3 * time).sin();
        (1.6 * time + 5.0 * (s - 0.5) * angle.cos() + 3.0, 4.0 + 5.0 * (s - 0.5) * angle.sin())
    };
    let line = (0..=60).map(|i| place(f64::from(i) / 60.0)).collect();
    MotionFrame {
        time,
        lines: vec![line],
        marks: (0..=7).map(|i| place(f64::from(i) / 7.0)).collect(),
        ..MotionFrame::default()
    }
}

fn flight(title: &str, bend: f64) -> MotionPicture {
    let times = (0..=10).map(|i| 0.5 * f64::from(i));
    let picture =
        times.map(|t| tumbling(t, bend)).fold(MotionPicture::new(title), MotionPicture::snapshot);
    let tip = (0..=200)
        .filter_map(|i| tumbling(f64::from(i) * 0.025, bend).lines[0].last().copied())
        .collect();
    picture.time_label("t [s]").trace("path of the tip", tip)
}

fn energy() -> LineChart {
    LineChart::new("Flying spaghetti: energy")
        .x_label("t [s]")
        .y_label("energy [J]")
        .series(series("kinetic", |t| 300.0 - 60.0 * (-0.2 * t).exp() * (3.0 * t).cos()))
        .series(series("strain", |t| 74.3 + 60.0 * (-0.2 * t).exp() * (3.0 * t).cos()))
        .series(series("total", |_| 374.28285))
}

fn drift() -> LineChart {
    LineChart::new("Relative drift")
        .x_label("t [s]")
        .y_label("|E − E₀| / E₀")
        .y_scale(AxisScale::Logarithmic)
        .series(series("energy", |t| (1e-15 * t * (1.0 + (17.0 * t).sin())).abs()))
        .series(series("linear momentum", |_| 0.0))
        .series(series("midpoint rule", |t| 1e-6 * t * t))
}

fn convergence() -> LineChart {
    let order = |p: i32, c: f64| {
        (0..6).map(move |i| 0.1 / 2f64.powi(i)).map(move |h| (h, c * h.powi(p))).collect()
    };
    LineChart::new("Error against step")
        .x_label("dt [s]")
        .y_label("error [m]")
        .x_scale(AxisScale::Logarithmic)
        .y_scale(AxisScale::Logarithmic)
        .series(Series::new("energy–momentum", order(2, 0.5)).stroke(Stroke::Marked))
        .series(Series::new("Gauss, two stages", order(4, 3.0)).stroke(Stroke::Marked))
        .series(Series::new("slope 2", order(2, 1.0)).stroke(Stroke::Dotted))
}

fn two_beams() -> MotionPicture {
    let swing = |time: f64| {
        let (a, b) = (-1.5 + 1.2 * (2.0 * time).cos(), -1.5 + 1.8 * (2.7 * time).sin());
        let elbow = (a.cos(), a.sin());
        let tip = (elbow.0 + 0.8 * b.cos(), elbow.1 + 0.8 * b.sin());
        MotionFrame {
            time,
            lines: vec![vec![(0.0, 0.0), elbow], vec![elbow, tip]],
            marks: vec![(0.0, 0.0), elbow],
            particles: vec![tip],
            bodies: Vec::new(),
        }
    };
    let times = (0..=6).map(|i| 0.25 * f64::from(i));
    times
        .map(swing)
        .fold(MotionPicture::new("Double pendulum"), MotionPicture::snapshot)
        .beams(["arm", "forearm"])
}

#[test]
fn sample_charts_are_drawn() {
    show("energy", &energy(), &["Flying spaghetti: energy", "t [s]", "kinetic", "strain", "total"]);
    show("drift", &drift(), &["Relative drift", "|E − E₀| / E₀", "midpoint rule"]);
    show("convergence", &convergence(), &["Error against step", "dt [s]", "slope 2"]);
    let many = (0..12).fold(LineChart::new("Many series").x_label("t"), |chart, i| {
        chart.series(series(&format!("station {i}"), move |t| {
            f64::from(i) * 1e-7 + 1e-7 * (t + f64::from(i)).sin()
        }))
    });
    show("many", &many, &["Many series", "station 0", "station 11"]);
}

fn stability(title: &str, growth: impl Fn(i32, f64) -> Option<f64>) -> HeatMap {
    let dts = [1e-4, 1e-3, 0.01, 0.1, 0.3, 1.0];
    let names = dts.iter().map(|dt| format_number(*dt)).collect();
    let map = HeatMap::new(title, "energy growth", (-13, 1))
        .columns("dt / first period", names)
        .rows("EA L² / EI")
        .hatched("failed");
    (2..=12).step_by(2).fold(map, |map, power| {
        let cell = |dt: &f64| {
            let value = growth(power, *dt);
            let text = value.map_or("t = 0.4\nretries".to_owned(), |value| {
                format!("{}\n{} it.", scientific(value, 1), 3 + power / 4)
            });
            HeatCell { value, text }
        };
        map.row(format!("1e{power}"), dts.iter().map(cell).collect())
    })
}

#[test]
fn sample_heat_maps_are_drawn() {
    let conserving = stability("energy_momentum", |power, _| Some(2e-16 * f64::from(power)));
    let wandering = stability("trapezoidal", |power, dt| {
        let grown = 1e-5 * 10f64.powi(power / 2) * dt * dt;
        (grown < 0.1 || dt < 0.3).then_some(grown)
    });
    show("map", &wandering, &["trapezoidal", "EA L² / EI", "failed", "1e12"]);
    let maps = Page::grid(2).title("Stability").panel(conserving).panel(wandering);
    show("maps", &maps, &["Stability", "energy_momentum", "trapezoidal"]);
}

#[test]
fn sample_motion_pictures_are_drawn() {
    show("flight", &flight("Flying spaghetti", 2.5), &["Flying spaghetti", "x", "t [s]"]);
    show("pendulum", &two_beams(), &["Double pendulum", "arm", "forearm"]);
    show("single", &MotionPicture::new("At rest").snapshot(tumbling(0.0, 0.0)), &["At rest"]);
}

#[test]
fn sample_pages_are_drawn() {
    let momenta = LineChart::new("Momenta")
        .x_label("t [s]")
        .series(series("p_x [kg m/s]", |t| (8.0 * t).min(20.0)))
        .series(series("L [kg m²/s]", |t| -(80.0 * t).min(200.0)));
    show(
        "column",
        &Page::column().title("Flying spaghetti").panel(energy()).panel(momenta).panel(drift()),
        &["Flying spaghetti", "Momenta", "p_x [kg m/s]", "Relative drift"],
    );
    let pair = [flight("energy–momentum", 2.5), flight("midpoint rule", 4.0)];
    let row = MotionPicture::side_by_side(pair).title("Two integrators");
    show("row", &row, &["Two integrators", "energy–momentum", "midpoint rule"]);
    show(
        "hostile",
        &Page::grid(2).panel(LineChart::new("empty")).panel(LineChart::new("huge").series(
            Series::new("a", vec![(-1e308, 1e308), (0.0, -1e308), (f64::NAN, 0.0), (1e308, 0.0)]),
        )),
        &["empty", "huge"],
    );
}
