//! Chart of a work-precision study.

use super::labels;
use crate::analysis::{Precision, PrecisionRow, machines};
use crate::output::{AxisScale, LineChart, Marker, Series, SeriesColour, Stroke};
use crate::simulation::StepSize;

fn series_of(row: &PrecisionRow) -> String {
    let method = labels::method(&row.settings.method);
    match row.settings.dt {
        StepSize::Fixed(_) => method,
        StepSize::Adaptive(_) => format!("{method}, adaptive"),
    }
}

pub fn chart(study: &Precision) -> LineChart {
    let mut chart = LineChart::new(format!(
        "{}: error at {} against run time",
        study.name,
        labels::at_times(&study.times)
    ))
    .caption(format!("reference: {}", study.reference.source))
    .x_label("run time [s], set-up apart")
    .y_label("error / length")
    .x_scale(AxisScale::Logarithmic)
    .y_scale(AxisScale::Logarithmic)
    .sized(900.0, 640.0);
    for machine in machines(&study.external_results) {
        chart = chart.caption(format!("other programs measured on {machine}"));
    }
    let finite = |(price, error): &(f64, f64)| price.is_finite() && error.is_finite();
    let mut methods: Vec<String> = Vec::new();
    for row in &study.rows {
        let name = series_of(row);
        if !methods.contains(&name) {
            methods.push(name);
        }
    }
    for (number, name) in methods.iter().enumerate() {
        let own = study.rows.iter().filter(|row| series_of(row) == *name);
        let look = |series: Series| {
            series.ink(SeriesColour::OfSeries(number)).marker(Marker::of_index(number))
        };
        let mut of_mesh: Vec<(&str, Vec<(f64, f64)>)> = Vec::new();
        for row in own.clone() {
            match of_mesh.last_mut() {
                Some((mesh, points)) if *mesh == row.mesh => points.push(row.cost_and_error()),
                _ => of_mesh.push((&row.mesh, vec![row.cost_and_error()])),
            }
        }
        for (_, points) in of_mesh {
            let points = points.into_iter().filter(finite).collect();
            chart = chart.series(look(Series::new("", points)).stroke(Stroke::Marked).pale());
        }
        let best = own.filter(|row| row.is_on_front).map(PrecisionRow::cost_and_error);
        chart = chart.series(look(Series::new(name, best.collect())).stroke(Stroke::MarkersOnly));
    }
    let mut series: Vec<&str> = Vec::new();
    for external_result in &study.external_results {
        if !series.contains(&external_result.series.as_str()) {
            series.push(&external_result.series);
        }
    }
    for (number, name) in series.into_iter().enumerate() {
        let own: Vec<_> = study
            .external_results
            .iter()
            .filter(|external_result| external_result.series == name)
            .collect();
        let points: Vec<(f64, f64)> = own
            .iter()
            .map(|external_result| (external_result.run_time, external_result.error))
            .collect();
        let is_best = crate::analysis::pareto_front(&points);
        let number = methods.len() + number;
        let look = |points: Vec<(f64, f64)>, name: &str| {
            Series::new(name, points)
                .ink(SeriesColour::OfSeries(number))
                .marker(Marker::of_index(number))
        };
        let mut best: Vec<(f64, f64)> =
            points.iter().zip(is_best).filter(|(_, is_best)| *is_best).map(|(at, _)| *at).collect();
        best.sort_by(|a, b| a.0.total_cmp(&b.0));
        chart = chart
            .series(look(points, "").stroke(Stroke::MarkersOnly).pale())
            .series(look(best.clone(), name).stroke(Stroke::MarkersOnly))
            .series(look(best, "").stroke(Stroke::Dashed).thin());
    }
    let front = study.front().into_iter().map(PrecisionRow::cost_and_error).collect();
    chart.series(
        Series::new("our front", front).ink(SeriesColour::Black).stroke(Stroke::Solid).thin(),
    )
}
