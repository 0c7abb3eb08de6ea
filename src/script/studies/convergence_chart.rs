//! Chart of a convergence study.

use super::labels;
use crate::analysis::{Convergence, RefinedParameter, Refinement};
use crate::elementary::{ln, power};
use crate::output::{AxisScale, LineChart, Marker, Series, SeriesColour, Stroke};

const SAME_ORDER: f64 = 0.3;

struct SlopeLine {
    label: String,
    ends: [(f64, f64); 2],
}

pub fn chart(study: &Convergence, quantity: &str) -> LineChart {
    let relative = match quantity.starts_with("position") {
        true => " / length",
        false => "",
    };
    let mut chart = LineChart::new(format!(
        "{}: convergence of {quantity} at {}",
        study.name,
        labels::at_times(&study.times)
    ))
    .caption(study.fixed.clone())
    .caption(format!("reference: {}", study.reference.source))
    .x_label(match study.refined {
        RefinedParameter::Step => "dt",
        RefinedParameter::Mesh => "mesh size 1 / spans",
    })
    .y_label(format!("error{relative}"))
    .x_scale(AxisScale::Logarithmic)
    .y_scale(AxisScale::Logarithmic)
    .sized(900.0, 640.0);
    let mut noted: Vec<(String, f64)> = Vec::new();
    for (number, ladder) in study.ladders_with(quantity).enumerate() {
        let point =
            |rung| Some((ladder.sizes[rung], ladder.error(rung).filter(|error| *error > 0.0)?));
        let points: Vec<(f64, f64)> = (0..ladder.sizes.len()).filter_map(point).collect();
        let slope = match study.claimed_order(&ladder.method) {
            Some(order) => claimed(ladder, order, &points),
            None => observed_order_line(ladder),
        };
        let (ink, marker) = (SeriesColour::OfSeries(number), Marker::of_index(number));
        let name = labels::method(&ladder.method);
        chart =
            chart.series(Series::new(name, points).ink(ink).marker(marker).stroke(Stroke::Marked));
        let Some(SlopeLine { label, ends }) = slope else { continue };
        let [(coarse, large), (fine, small)] = ends;
        // Overlapping lines of the same order share one label.
        let is_near =
            |(other, error): &(String, f64)| *other == label && ln(error / large).abs() < 0.4;
        if !noted.iter().any(is_near) {
            noted.push((label.clone(), large));
            let middle = ((coarse * fine).sqrt(), (large * small).sqrt());
            chart = chart.annotate(middle, label);
        }
        chart = chart.series(Series::new("", ends.to_vec()).ink(ink).stroke(Stroke::Dotted).thin());
    }
    chart
}

fn usable_rungs(ladder: &Refinement) -> impl DoubleEndedIterator<Item = usize> {
    (0..ladder.sizes.len()).filter(|rung| ladder.counts_for_order(*rung))
}

fn claimed(ladder: &Refinement, order: u32, points: &[(f64, f64)]) -> Option<SlopeLine> {
    let last = usable_rungs(ladder).next_back()?;
    let line = through(ladder, last, f64::from(order));
    Some(SlopeLine {
        label: format!("order {order}"),
        ends: [line(points.first()?.0)?, line(ladder.sizes[last])?],
    })
}

/// Line whose slope is the mean of the nearly equal orders at the finest sizes; `None` if there are fewer than two.
fn observed_order_line(ladder: &Refinement) -> Option<SlopeLine> {
    let last = usable_rungs(ladder).next_back()?;
    let mut orders = vec![ladder.order(last)?];
    for rung in (1..last).rev() {
        match ladder.order(rung) {
            Some(order) if (order - orders[orders.len() - 1]).abs() < SAME_ORDER => {
                orders.push(order);
            }
            _ => break,
        }
    }
    if orders.len() < 2 {
        return None;
    }
    let order = orders.iter().sum::<f64>() / orders.len() as f64;
    let line = through(ladder, last, order);
    let coarsest = ladder.sizes[last - orders.len()];
    Some(SlopeLine {
        label: format!("order {order:.1}"),
        ends: [line(coarsest)?, line(ladder.sizes[last])?],
    })
}

fn through(ladder: &Refinement, rung: usize, order: f64) -> impl Fn(f64) -> Option<(f64, f64)> {
    let (size, error) = (ladder.sizes[rung], ladder.error(rung));
    move |other| Some((other, error? * power(other / size, order)))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::analysis::Deviation;
    use crate::integrators::Method;

    fn ladder(orders: &[f64]) -> Refinement {
        let mut errors = vec![1.0];
        for order in orders {
            errors.push(errors[errors.len() - 1] / 2_f64.powf(*order));
        }
        let deviation =
            |distance| Some(Deviation { distance, estimated_error: 0.0, is_of_own_run: false });
        Refinement {
            method: Method::default(),
            quantity: "positions".into(),
            sizes: (0..errors.len()).map(|rung| 0.5_f64.powi(rung as i32)).collect(),
            deviations: errors.into_iter().map(deviation).collect(),
        }
    }

    #[test]
    fn order_line_is_drawn_only_if_neighbouring_orders_agree() {
        assert!(observed_order_line(&ladder(&[6.8, 4.6, 3.5])).is_none(), "not yet at any order");
        assert!(observed_order_line(&ladder(&[1.0])).is_none(), "a single order agrees with none");
        let slope = observed_order_line(&ladder(&[0.71, 1.08, 0.9])).unwrap();
        assert_eq!(slope.label, "order 1.0");
        let [(coarse, large), (fine, small)] = slope.ends;
        assert_eq!((coarse, fine), (0.5, 0.125));
        assert!(((large / small).log2() - 2.0 * 0.99).abs() < 1e-12);
    }

    #[test]
    fn claimed_order_line_spans_all_sizes() {
        let ladder = ladder(&[0.3, 1.9]);
        let points = [(1.0, 1.0)];
        let slope = claimed(&ladder, 2, &points).unwrap();
        assert_eq!(
            (slope.label.as_str(), slope.ends[0].0, slope.ends[1].0),
            ("order 2", 1.0, 0.25)
        );
        assert!((slope.ends[0].1 / slope.ends[1].1 - 16.0).abs() < 1e-9);
    }
}
