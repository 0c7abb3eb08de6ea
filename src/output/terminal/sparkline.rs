//! A column of numbers as one line of little bars.

use super::Glyphs;
use crate::output::axis::{Axis, extent};

const BARS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];
const SIGNS: [char; 8] = ['_', '.', '-', '~', '=', '+', '*', '#'];

/// The numbers in at most `width` characters, from the least as the lowest bar to the greatest as the highest. More
/// numbers than characters are averaged; what is not finite leaves a blank; a constant stands at half height.
pub fn sparkline(values: &[f64], width: usize, glyphs: Glyphs) -> String {
    let bars = glyphs.choose(BARS, SIGNS);
    let count = width.min(values.len());
    let means: Vec<f64> = (0..count)
        .map(|index| {
            mean(&values[index * values.len() / count..(index + 1) * values.len() / count])
        })
        .collect();
    let Some((least, most)) = extent(means.iter().copied()) else { return " ".repeat(count) };
    let axis = Axis::between(least, most);
    let bar = |mean: &f64| match mean.is_finite() {
        true => bars[((axis.place(*mean) * bars.len() as f64) as usize).min(bars.len() - 1)],
        false => ' ',
    };
    means.iter().map(bar).collect()
}

/// The mean of the finite numbers, not a number if there is none.
fn mean(values: &[f64]) -> f64 {
    let finite: Vec<f64> = values.iter().copied().filter(|value| value.is_finite()).collect();
    finite.iter().map(|value| value / finite.len() as f64).sum::<f64>()
        + if finite.is_empty() { f64::NAN } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn bars_rise_with_the_numbers() {
        let ramp: Vec<f64> = (0..8).map(f64::from).collect();
        assert_eq!(sparkline(&ramp, 8, Glyphs::Braille), "▁▂▃▄▅▆▇█");
        assert_eq!(sparkline(&ramp, 4, Glyphs::Ascii), "_-+#");
        assert_eq!(sparkline(&[1.0, f64::NAN, 2.0], 80, Glyphs::Braille), "▁ █");
        assert_eq!(sparkline(&[5.0; 3], 80, Glyphs::Braille), "▅▅▅");
        assert_eq!(sparkline(&[], 80, Glyphs::Braille), "");
    }

    proptest! {
        #[test]
        fn any_numbers_make_a_line(values in prop::collection::vec(proptest::num::f64::ANY, 0..40), width in 0usize..30) {
            let line = sparkline(&values, width, Glyphs::Braille);
            prop_assert_eq!(line.chars().count(), width.min(values.len()));
        }
    }
}
