//! Axes of charts: conversion of numbers to positions, and tick labels.

use super::number::{format_number, significant};
use crate::elementary::{log10, power, whole_power};

#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum AxisScale {
    /// Linear: equal differences of numbers have equal lengths on the axis.
    #[default]
    Linear,
    /// Logarithmic: equal ratios of numbers have equal lengths on the axis. Zero and numbers up to a floor are at the bottom.
    Logarithmic,
}

/// Default floor of a logarithmic axis, far below the rounding error of a number near one.
pub const DEFAULT_FLOOR: f64 = 1e-18;

/// Magnitude to which numbers are limited, so that the length of any range is finite.
const LARGEST: f64 = 1e300;

/// Largest width of a range that is attributed to rounding and shown as a constant, as a fraction of the numbers in the range.
const ROUNDING: f64 = 1e-10;

#[derive(Clone, Debug, PartialEq)]
pub struct Tick {
    /// Position of the tick on its axis, from 0 at the low end to 1 at the high end.
    pub place: f64,
    pub label: String,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlotAxis {
    scale: AxisScale,
    /// Low end of the axis, for a logarithmic axis as the exponent of ten.
    low: f64,
    high: f64,
    cut: AxisCut,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum AxisCut {
    Nothing,
    Below,
}

impl Default for PlotAxis {
    fn default() -> Self {
        Self::between(0.0, 1.0)
    }
}

impl PlotAxis {
    /// Creates a linear axis over the finite values. The axis is extended at each end by `margin` times the range of the values.
    pub fn linear(values: impl IntoIterator<Item = f64>, margin: f64) -> Self {
        let (low, high) = extent(values).unwrap_or((0.0, 1.0));
        let size = low.abs().max(high.abs());
        let spare = if high - low > ROUNDING * size && high - low > 1e-290 {
            margin * (high - low)
        } else if size > 1e-280 {
            0.1 * size
        } else {
            1.0
        };
        Self {
            scale: AxisScale::Linear,
            low: low - spare,
            high: high + spare,
            cut: AxisCut::Nothing,
        }
    }

    pub fn between(low: f64, high: f64) -> Self {
        Self::linear([low, high], 0.0)
    }

    /// Creates a logarithmic axis between integer powers of ten.
    /// Values up to `floor` are shown at the bottom. The bottom is extended by one power of ten for them, but not below that of `floor`.
    pub fn logarithmic(values: impl IntoIterator<Item = f64>, floor: f64) -> Self {
        let floor = if floor > 0.0 && floor.is_finite() { floor } else { DEFAULT_FLOOR };
        let mut cut = AxisCut::Nothing;
        let above = values.into_iter().filter(|x| x.is_finite()).filter(|&x| {
            if x <= floor {
                cut = AxisCut::Below;
            }
            x > floor
        });
        let bottom = log10(floor).floor();
        let (least, most) = extent(above).unwrap_or((floor, floor));
        let (mut low, high) = (log10(least).floor(), log10(most).ceil());
        if cut == AxisCut::Below {
            low = (low - 1.0).max(bottom);
        }
        Self { scale: AxisScale::Logarithmic, low, high: high.max(low + 1.0), cut }
    }

    pub fn powers_between(low: f64, high: f64) -> Self {
        let (low, high) = (log10(low), log10(high));
        Self { scale: AxisScale::Logarithmic, low, high, cut: AxisCut::Nothing }
    }

    /// Position of `x` on the axis: 0 at the low end, 1 at the high end, and NaN for NaN.
    pub fn place(&self, x: f64) -> f64 {
        match self.scale {
            AxisScale::Linear => (x.clamp(-LARGEST, LARGEST) - self.low) / (self.high - self.low),
            AxisScale::Logarithmic if x.is_nan() => x,
            AxisScale::Logarithmic if x <= 0.0 => 0.0,
            AxisScale::Logarithmic => ((log10(x) - self.low) / (self.high - self.low)).max(0.0),
        }
    }

    /// About `count` ticks with labels, and the common power of ten by which the labels are divided.
    pub fn ticks(&self, count: usize) -> (Vec<Tick>, Factor) {
        let count = count.max(2) as f64;
        match self.scale {
            AxisScale::Linear => self.linear_ticks(count),
            AxisScale::Logarithmic if self.high - self.low < 1.0 => {
                self.ticks_within_a_power(count)
            }
            AxisScale::Logarithmic => (self.power_ticks(count), Factor(0)),
        }
    }

    fn linear_ticks(&self, count: f64) -> (Vec<Tick>, Factor) {
        let (lead, power) = round_step((self.high - self.low) / count);
        let step = f64::from(lead) * ten_to(power);
        let size = self.low.abs().max(self.high.abs());
        let factor = match log10(size).floor() as i32 {
            modest @ -2..=4 if power >= -5 || modest >= 0 => 0,
            other => other,
        };
        let decimals = (factor - power).max(0) as usize;
        // The tolerance keeps the ticks at the ends of the axis in spite of rounding.
        let (first, last) = ((self.low / step - 1e-6).ceil(), (self.high / step + 1e-6).floor());
        let ticks = (0..=(last - first).clamp(0.0, 100.0) as usize).map(|index| {
            let multiple = first + index as f64;
            let shown = multiple * f64::from(lead) * ten_to(power - factor);
            Tick {
                place: self.place(multiple * step).clamp(0.0, 1.0),
                label: typeset(shown, decimals),
            }
        });
        (ticks.collect(), Factor(factor))
    }

    fn power_ticks(&self, count: f64) -> Vec<Tick> {
        let stride = ((self.high - self.low) / count).ceil().max(1.0);
        let first = (self.low / stride).ceil() * stride;
        let powers = (0..200)
            .map(|index| first + f64::from(index) * stride)
            .take_while(|&power| power <= self.high);
        let bottom = (self.cut == AxisCut::Below)
            .then(|| Tick { place: 0.0, label: format!("≤ {}", power_of_ten(self.low)) });
        let tick =
            |power: f64| Tick { place: self.place_of_power(power), label: power_of_ten(power) };
        let free = powers.filter(|&power| bottom.is_none() || power >= self.low + stride / 2.0);
        let mut ticks: Vec<Tick> = free.map(tick).collect();
        ticks.splice(0..0, bottom);
        ticks
    }

    fn ticks_within_a_power(&self, count: f64) -> (Vec<Tick>, Factor) {
        let ends = [self.low, self.high].map(|exponent| power(10.0, exponent));
        let even = Self::between(ends[0], ends[1]);
        let (ticks, factor) = even.linear_ticks(count);
        let place = |tick: &Tick| self.place(ends[0] + tick.place * (ends[1] - ends[0]));
        let placed = ticks.into_iter().map(|tick| Tick { place: place(&tick).min(1.0), ..tick });
        (placed.collect(), factor)
    }

    fn place_of_power(&self, power: f64) -> f64 {
        (power - self.low) / (self.high - self.low)
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Factor(i32);

impl Factor {
    /// Label of an axis, followed by the common power of ten, if any, as in `energy [J] (×10⁻⁷)`.
    pub fn after(&self, label: &str) -> String {
        match self.0 {
            0 => label.into(),
            power => format!("{label} (×{})", power_of_ten(f64::from(power))).trim_start().into(),
        }
    }
}

/// Smallest and largest finite number; `None` if there is no finite number.
pub fn extent(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().filter(|x| x.is_finite()).map(|x| x.clamp(-LARGEST, LARGEST)).fold(
        None,
        |range, x| {
            let (low, high) = range.unwrap_or((x, x));
            Some((x.min(low), x.max(high)))
        },
    )
}

/// Digit 1, 2 or 5 and exponent of the power of ten whose product is the smallest of at least 0.8 times `step`.
fn round_step(step: f64) -> (u8, i32) {
    let power = log10(step).floor() as i32;
    match step / ten_to(power) {
        lead if lead <= 1.25 => (1, power),
        lead if lead <= 2.5 => (2, power),
        lead if lead <= 6.25 => (5, power),
        _ => (1, power + 1),
    }
}

fn ten_to(power: i32) -> f64 {
    whole_power(10.0, power)
}

fn typeset(x: f64, decimals: usize) -> String {
    let x = if x == 0.0 { 0.0 } else { x };
    format!("{x:.decimals$}").replace('-', "−")
}

pub(super) fn typeset_number(x: f64, digits: usize) -> String {
    let text = significant(x, digits);
    let plain = |text: &str| text.replace('-', "−");
    match text.split_once('e') {
        Some((mantissa, power)) => match power.parse() {
            Ok(power) => format!("{} × {}", plain(mantissa), power_of_ten(power)),
            Err(_) => plain(&text),
        },
        None => plain(&text),
    }
}

pub(super) fn power_of_ten(power: f64) -> String {
    let digits = format_number(power);
    let raised = digits.chars().map(|c| match c.to_digit(10) {
        Some(digit) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][digit as usize],
        None => '⁻',
    });
    format!("10{}", raised.collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn ends(axis: PlotAxis) -> (f64, f64) {
        (axis.low, axis.high)
    }

    fn labels(axis: PlotAxis) -> Vec<String> {
        axis.ticks(6).0.into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn axis_labels_are_round_numbers() {
        assert_eq!(labels(PlotAxis::between(0.0, 0.5)), ["0.0", "0.1", "0.2", "0.3", "0.4", "0.5"]);
        assert_eq!(labels(PlotAxis::between(-10.0, 15.0)), ["−10", "−5", "0", "5", "10", "15"]);
        assert_eq!(
            labels(PlotAxis::between(0.0, 3e-7)),
            ["0.0", "0.5", "1.0", "1.5", "2.0", "2.5", "3.0"]
        );
        assert_eq!(PlotAxis::between(0.0, 3e-7).ticks(6).1.after("drift"), "drift (×10⁻⁷)");
    }

    #[test]
    fn numbers_are_typeset_with_minus_signs_and_powers_of_ten() {
        let written = [-0.25, 4.0853e-5, -3e9, 0.0].map(|x| typeset_number(x, 3));
        assert_eq!(written, ["−0.25", "4.09 × 10⁻⁵", "−3 × 10⁹", "0"]);
    }

    #[test]
    fn zero_is_at_the_bottom_of_a_logarithmic_axis() {
        let axis = PlotAxis::logarithmic([0.0, 3e-14, 2e-12], DEFAULT_FLOOR);
        assert_eq!(ends(axis), (-15.0, -11.0));
        assert_eq!(labels(axis), ["≤ 10⁻¹⁵", "10⁻¹⁴", "10⁻¹³", "10⁻¹²", "10⁻¹¹"]);
        assert_eq!(axis.place(0.0), 0.0);
        assert_eq!(axis.place(1e-11), 1.0);
        assert_eq!(ends(PlotAxis::logarithmic([0.0, -1.0], DEFAULT_FLOOR)), (-18.0, -17.0));
    }

    #[test]
    fn a_logarithmic_axis_within_a_power_has_round_numbers() {
        assert_eq!(
            labels(PlotAxis::powers_between(2.0, 5.0)),
            ["2.0", "2.5", "3.0", "3.5", "4.0", "4.5", "5.0"]
        );
        assert_eq!(labels(PlotAxis::powers_between(1e-2, 1e1)), ["10⁻²", "10⁻¹", "10⁰", "10¹"]);
        let (ticks, _) = PlotAxis::powers_between(2.0, 8.0).ticks(4);
        let four = ticks.iter().find(|tick| tick.label == "4").unwrap();
        assert!((four.place - 0.5).abs() < 1e-12);
    }

    #[test]
    fn values_that_differ_by_rounding_get_a_wide_axis() {
        let (low, high) = ends(PlotAxis::linear([374.28285, 374.28285 + 1e-12], 0.05));
        assert!(low < 340.0 && high > 410.0, "{low} {high}");
    }

    proptest! {
        #[test]
        fn any_numbers_give_a_valid_axis(values in prop::collection::vec(proptest::num::f64::ANY, 0..6), floor in proptest::num::f64::ANY) {
            for axis in [PlotAxis::linear(values.clone(), 0.05), PlotAxis::logarithmic(values.clone(), floor)] {
                let (low, high) = ends(axis);
                prop_assert!(low < high && (high - low).is_finite());
                let (ticks, _) = axis.ticks(6);
                prop_assert!(ticks.len() <= 14, "{ticks:?}");
                prop_assert!(ticks.iter().all(|tick| (-1e-9..=1.0 + 1e-9).contains(&tick.place)), "{:?} {:?}", axis, ticks);
                for x in values.iter().filter(|x| x.is_finite()) {
                    prop_assert!((-1e-9..=1.0 + 1e-9).contains(&axis.place(*x)) || x.abs() > LARGEST);
                }
            }
        }
    }
}
