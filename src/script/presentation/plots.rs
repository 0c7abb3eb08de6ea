//! Charts of histories and pictures of configurations, for files and terminals.

use super::motion::{marked, placed};
use crate::geometry::Vec2;
use crate::output::{
    AxisScale, ConfigurationPicture, LineChart, PictureMark, Series, TerminalStyle, scientific,
    significant,
};
use crate::script::messages::error::ScriptError;
use crate::script::messages::suggest::nearest;
use crate::simulation::{DrawnConfiguration, History, Invariant, Simulation};

const DIGITS: usize = 6;
/// Smallest height of each chart in a stack of charts in a terminal [lines].
const LEAST_HEIGHT: usize = 9;

pub fn history_chart(
    history: &History,
    columns: &[String],
    style: &TerminalStyle,
) -> Result<String, ScriptError> {
    expect_columns(history, columns)?;
    history_charts(history, columns, style, |_, _| Ok(()))
}

pub fn history_charts(
    history: &History,
    columns: &[String],
    style: &TerminalStyle,
    add_bands: impl Fn(&mut LineChart, &[String]) -> Result<(), ScriptError>,
) -> Result<String, ScriptError> {
    let groups = by_dimension(columns, |name| history.dimension(name));
    let draw = |columns: &Vec<String>| {
        let mut chart = history_lines(history, columns);
        add_bands(&mut chart, columns)?;
        Ok(chart)
    };
    let charts = groups.iter().map(draw).collect::<Result<Vec<_>, ScriptError>>()?;
    Ok(stacked_text(&charts, style))
}

pub fn stacked_text(charts: &[LineChart], style: &TerminalStyle) -> String {
    let height = (style.height / charts.len().max(1)).max(LEAST_HEIGHT.min(style.height));
    let style = TerminalStyle { height, ..*style };
    charts.iter().map(|chart| chart.text(&style)).collect::<Vec<_>>().join("\n")
}

pub fn by_dimension<T: Clone>(
    items: &[T],
    dimension: impl Fn(&T) -> Option<&'static str>,
) -> Vec<Vec<T>> {
    let mut groups: Vec<(Option<&str>, Vec<T>)> = Vec::new();
    for item in items {
        let of = dimension(item);
        match groups.iter_mut().find(|(other, _)| *other == of) {
            Some((_, group)) => group.push(item.clone()),
            None => groups.push((of, vec![item.clone()])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

pub fn expect_columns(history: &History, columns: &[String]) -> Result<(), ScriptError> {
    if columns.is_empty() {
        let hint = format!("columns: {}", column_names(history));
        return Err(ScriptError::new("no column is given").hint(hint));
    }
    columns.iter().try_for_each(|name| expect_column(history, name).map(|_| ()))
}

fn history_lines(history: &History, columns: &[String]) -> LineChart {
    let title = columns.iter().map(|name| series_name(name)).collect::<Vec<_>>().join(", ");
    let label = match dimension_of(history, columns) {
        "" => String::new(),
        dimension => format!("[{dimension}]"),
    };
    line_chart(title, history, columns, History::column).y_label(label)
}

pub fn drift_chart(history: &History, style: &TerminalStyle) -> String {
    drift_lines("", history).text(style)
}

pub fn drift_summary(history: &History) -> String {
    let line = |(name, of): &(&str, Invariant)| {
        format!("drift of {}: {}", name.replace('_', " "), scientific(history.drift(*of), 2))
    };
    let moving = Invariant::ALL.iter().filter(|(_, of)| *of != Invariant::Gap);
    moving.map(line).collect::<Vec<_>>().join("\n")
}

pub fn column_summary(history: &History, column: &str) -> Result<String, ScriptError> {
    let dimension = expect_column(history, column)?;
    let values = history.column(column).unwrap_or_default();
    let name = match dimension {
        "-" => column.to_owned(),
        dimension => format!("{column} [{dimension}]"),
    };
    let [Some(first), Some(least), Some(most), Some(last)] = [
        values.first().copied(),
        values.iter().copied().reduce(f64::min),
        values.iter().copied().reduce(f64::max),
        values.last().copied(),
    ]
    .map(|value| value.map(|value| significant(value, DIGITS))) else {
        return Ok(format!("{name}: no rows"));
    };
    let rows = match values.len() {
        1 => "1 row".to_owned(),
        count => format!("{count} rows"),
    };
    Ok(format!("{name}: {first} at the start, least {least}, most {most}, now {last} ({rows})"))
}

/// Picture of the present configuration, or of the recorded one nearest to a time, as text for a terminal.
/// The initial configuration is drawn dotted.
///
/// # Errors
/// Fails if the axis of a beam has a point without a tangent.
pub fn configuration_picture(
    simulation: &Simulation,
    time: Option<f64>,
    style: &TerminalStyle,
) -> Result<String, ScriptError> {
    let shown = shown_at(simulation, time)?;
    let plain = |points: &[Vec2]| points.iter().map(|point| (point.x, point.y)).collect::<Vec<_>>();
    let mut picture = ConfigurationPicture::new(&simulation.scene().name);
    let Some(shown) = shown else { return Ok(picture.text(style)) };
    if let Some(start) = simulation.configuration_near(0.0)?.filter(|start| start.time < shown.time)
    {
        let lines = start.lines.iter().chain(&start.bodies);
        picture = lines.fold(picture, |picture, line| picture.reference_beam(plain(line)));
    }
    let lines = shown.lines.iter().chain(&shown.bodies);
    picture = lines.fold(picture, |picture, line| picture.line(plain(line)));
    picture = shown.particles.iter().fold(picture.time(shown.time), |picture, at| {
        picture.mark(PictureMark::Particle, (at.x, at.y))
    });
    let symbols = placed(simulation, time.unwrap_or(simulation.time()), None)?;
    Ok(marked(picture, &symbols).text(style))
}

pub fn configuration_summary(
    simulation: &Simulation,
    time: Option<f64>,
) -> Result<String, ScriptError> {
    let Some(shown) = shown_at(simulation, time)? else { return Ok("nothing is recorded".into()) };
    let place = |at: Option<&Vec2>| {
        let number = |value: f64| significant(value, DIGITS);
        at.map_or_else(String::new, |at| format!("({}, {})", number(at.x), number(at.y)))
    };
    let scene = simulation.scene();
    let beams = scene.beams.iter().zip(&shown.lines).map(|(beam, line)| {
        format!("{}: from {} to {}", beam.name, place(line.first()), place(line.last()))
    });
    let particles = scene.particles.iter().zip(&shown.particles);
    let particles =
        particles.map(|(particle, at)| format!("{}: at {}", particle.name, place(Some(at))));
    let bodies = scene.rigid_bodies.iter().zip(&shown.particles[scene.particles.len()..]);
    let bodies = bodies.map(|(body, at)| format!("{}: at {}", body.name, place(Some(at))));
    let lines: Vec<String> = beams.chain(particles).chain(bodies).collect();
    Ok(format!("t = {}\n{}", significant(shown.time, DIGITS), lines.join("\n")))
}

fn shown_at(
    simulation: &Simulation,
    time: Option<f64>,
) -> Result<Option<DrawnConfiguration>, ScriptError> {
    Ok(match time {
        Some(time) => simulation.configuration_near(time)?,
        None => Some(simulation.configuration()?),
    })
}

pub fn line_chart(
    title: impl Into<String>,
    history: &History,
    columns: &[String],
    read: impl Fn(&History, &str) -> Option<Vec<f64>>,
) -> LineChart {
    let chart = LineChart::new(title).x_label("t").y_label(axis_label(history, columns));
    columns.iter().fold(chart, |chart, name| {
        let values = read(history, name).unwrap_or_default();
        chart.series(Series::new(series_name(name), over_time(history, values)))
    })
}

pub fn drift_lines(title: impl Into<String>, history: &History) -> LineChart {
    let chart = LineChart::new(title)
        .x_label("t")
        .y_label("relative drift")
        .y_scale(AxisScale::Logarithmic);
    let invariants = Invariant::ALL.iter().filter(|(_, of)| *of != Invariant::Gap);
    invariants.fold(chart, |chart, (name, of)| {
        let points =
            over_time(history, history.drifts(*of)).split_off(1.min(history.samples().len()));
        chart.series(Series::new(name.replace('_', " "), points))
    })
}

fn series_name(column: &str) -> String {
    match column.rsplit_once('.') {
        Some((thing, quantity)) => format!("{thing} {}", quantity.replace('_', " ")),
        None => column.replace('_', " "),
    }
}

fn axis_label(history: &History, columns: &[String]) -> String {
    match (columns, dimension_of(history, columns)) {
        ([only], "") => series_name(only),
        ([only], dimension) => format!("{} [{dimension}]", series_name(only)),
        (_, dimension) => dimension.to_owned(),
    }
}

/// Common dimension of columns; empty if they have no dimension or different dimensions.
fn dimension_of(history: &History, columns: &[String]) -> &'static str {
    let groups = by_dimension(columns, |name| history.dimension(name));
    let common = match groups.as_slice() {
        [group] => group.first().and_then(|name| history.dimension(name)),
        _ => None,
    };
    common.filter(|dimension| *dimension != "-").unwrap_or_default()
}

fn over_time(history: &History, values: Vec<f64>) -> Vec<(f64, f64)> {
    history.samples().iter().map(|row| row.measures.time).zip(values).collect()
}

fn expect_column(history: &History, name: &str) -> Result<&'static str, ScriptError> {
    history.dimension(name).ok_or_else(|| {
        ScriptError::new(format!("the history has no column {name:?}"))
            .hint(column_hint(history, name))
    })
}

pub fn column_hint(history: &History, name: &str) -> String {
    let missing = MISSING.iter().find(|(kind, _)| name.split('.').next() == Some(kind));
    let is_there = |kind: &str| history.columns().any(|(column, _)| column == kind);
    if let Some((_, why)) = missing.filter(|(kind, _)| !is_there(kind)) {
        return format!("{why}; columns: {}", column_names(history));
    }
    let meant = nearest(name, history.columns().map(|(name, _)| name));
    let suggestion = meant.map(|name| format!("did you mean \"{name}\"? ")).unwrap_or_default();
    format!("{suggestion}columns: {}", column_names(history))
}

/// Names of history columns that exist only in some scenes, with a description of these scenes.
const MISSING: [(&str, &str); 2] = [
    (
        "dissipated",
        "nothing in the scene dissipates energy: it has no damper, no damped section, no drag \
        and no slider with losses by bounces, so the column would be 0",
    ),
    (
        "stored",
        "only beams (strain) and gravity (potential) store energy in the scene: it has no \
        spring",
    ),
];

pub fn column_names(history: &History) -> String {
    history.columns().map(|(name, _)| name).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::beams::Station;
    use crate::beams::{Mesh, Section};
    use crate::geometry::Curve;
    use crate::integrators::Method;
    use crate::joints::{JointKind, Partner};
    use crate::newton::Tolerance;
    use crate::output::{Colours, Glyphs};
    use crate::simulation::{DriftScales, ExtraColumn, NoMonitor, SimulationSettings};
    use crate::system::{BeamDefinition, Scene, StartMotion};

    const STYLE: TerminalStyle =
        TerminalStyle { glyphs: Glyphs::Ascii, colours: Colours::None, width: 50, height: 14 };

    fn turning() -> Simulation {
        let mut scene = Scene::new("turning");
        let section = Section {
            axial_stiffness: 1e4,
            shear_stiffness: 1e4,
            bending_stiffness: 1e3,
            mass_per_length: 1.0,
            rotary_inertia: 1.0,
        };
        let motion =
            StartMotion { spin: 1.0, centre: Some(Vec2::zeros()), ..StartMotion::default() };
        let axis = Curve::line(Vec2::zeros(), Vec2::new(2.0, 0.0)).unwrap();
        let mesh = Mesh::bspline(4, 3, 2).unwrap();
        let beam =
            BeamDefinition { name: "rod".into(), axis, mesh, section: section.into(), motion };
        let beam = scene.add_beam(beam).unwrap();
        let start = scene.station(beam, 0.0).unwrap();
        scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
        let settings = SimulationSettings {
            method: Method::EnergyMomentum,
            dt: 0.1.into(),
            tolerance: Tolerance::default(),
        };
        let mut simulation = Simulation::start(scene, settings).unwrap();
        simulation.run_to(1.5, &mut NoMonitor).unwrap();
        simulation
    }

    fn failure(error: ScriptError) -> (String, String) {
        match error {
            ScriptError::Failure(failure) => (failure.message, failure.hint.unwrap_or_default()),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn history_columns_give_a_chart_and_a_summary() {
        let simulation = turning();
        let columns = ["kinetic", "strain"].map(str::to_owned);
        let chart = history_chart(simulation.history(), &columns, &STYLE).unwrap();
        assert!(chart.starts_with("kinetic, strain  [energy]\na kinetic   b strain\n"), "{chart}");
        let lone = history_chart(simulation.history(), &columns[..1], &STYLE).unwrap();
        assert!(lone.starts_with("kinetic  [energy]\n") && !lone.contains("a kinetic"), "{lone}");
        let counts = history_chart(simulation.history(), &["retries".to_owned()], &STYLE).unwrap();
        assert!(counts.starts_with("retries\n"), "{counts}");
        let summary = column_summary(simulation.history(), "t").unwrap();
        assert_eq!(summary, "t [time]: 0 at the start, least 0, most 1.5, now 1.5 (16 rows)");
        let drifts = drift_chart(simulation.history(), &STYLE);
        assert!(drifts.starts_with("relative drift\na energy   b momentum   c angular momentum\n"));
    }

    #[test]
    fn unknown_column_is_rejected_with_the_nearest_name() {
        let simulation = turning();
        let (message, hint) =
            failure(history_chart(simulation.history(), &["energi".into()], &STYLE).unwrap_err());
        assert_eq!(message, "the history has no column \"energi\"");
        assert!(hint.starts_with("did you mean \"energy\"? columns: t, kinetic,"), "{hint}");
        let (_, same) = failure(column_summary(simulation.history(), "energi").unwrap_err());
        assert_eq!(hint, same);
        assert!(history_chart(simulation.history(), &[], &STYLE).is_err());
    }

    #[test]
    fn empty_history_has_a_summary() {
        let history = History::new(DriftScales::default(), vec![]);
        assert_eq!(column_summary(&history, "retries").unwrap(), "retries: no rows");
        assert!(history_chart(&history, &["energy".into()], &STYLE).unwrap().contains("no data"));
    }

    #[test]
    fn configuration_picture_shows_the_start_behind_the_present() {
        let simulation = turning();
        let now = configuration_picture(&simulation, None, &STYLE).unwrap();
        assert!(now.lines().next().unwrap().contains("turning -") && now.contains("t = 1.5"));
        assert!(now.contains("^ hinge"), "{now}");
        let column = |line: &str| line.find('|').is_some_and(|_| line.contains(".. "));
        assert!(now.lines().any(column), "the ghost is a level line of dots: {now}");
        let start = configuration_picture(&simulation, Some(0.0), &STYLE).unwrap();
        assert!(start.contains("t = 0 ") && start.lines().count() < now.lines().count(), "{start}");
        assert!(!start.contains(".. .."), "nothing is behind the start: {start}");
        let middle = configuration_picture(&simulation, Some(0.72), &STYLE).unwrap();
        assert!(middle.contains("t = 0.7 "), "{middle}");
        assert_eq!(now, configuration_picture(&simulation, None, &STYLE).unwrap());
    }

    #[test]
    fn configuration_summary_states_time_and_beam_ends() {
        let start = configuration_summary(&turning(), Some(0.0)).unwrap();
        assert_eq!(start, "t = 0\nrod: from (0, 0) to (2, 0)");
        assert!(configuration_summary(&turning(), None).unwrap().starts_with("t = 1.5\nrod: from"));
    }

    #[test]
    fn station_positions_lie_on_the_drawn_lines() {
        let simulation = turning();
        let end = [Station::on_beam(0, 2.0)];
        for time in [0.0, 0.7, 1.5] {
            let line = simulation.configuration_near(time).unwrap().unwrap().lines.remove(0);
            let station = simulation.stations_near(&end, time).unwrap()[0];
            assert!((line.last().unwrap() - station).norm() < 1e-12);
        }
        let present = simulation.configuration().unwrap();
        assert_eq!(Some(present), simulation.configuration_near(1.5).unwrap());
        assert_eq!(
            simulation.stations(&end).unwrap(),
            simulation.stations_near(&end, 1.5).unwrap()
        );
    }

    #[test]
    fn axis_dimension_is_shared_by_all_columns() {
        let column = |name: &str, dimension| ExtraColumn { name: name.to_owned(), dimension };
        let extra = vec![column("my_slider.force", "force"), column("my_slider.force_x", "force")];
        let history = History::new(DriftScales::default(), extra);
        let of = |names: &[&str]| {
            dimension_of(&history, &names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>())
        };
        assert_eq!(of(&["my_slider.force", "my_slider.force_x"]), "force");
        assert_eq!(of(&["kinetic", "work"]), "energy");
        assert_eq!(of(&["my_slider.force", "energy"]), "");
    }

    #[test]
    fn legend_keeps_object_names() {
        assert_eq!(series_name("momentum_x"), "momentum x");
        assert_eq!(series_name("my_slider.force_x"), "my_slider force x");
    }
}
