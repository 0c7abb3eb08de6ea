//! Colours for white paper that colour-blind readers can distinguish, also in black-and-white prints.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Colour(pub u8, pub u8, pub u8);

pub const WHITE: Colour = Colour(255, 255, 255);
pub const INK: Colour = Colour(38, 42, 48);
pub const GREY: Colour = Colour(110, 116, 124);
pub const AXIS: Colour = Colour(150, 156, 163);
pub const GRID: Colour = Colour(229, 232, 236);

/// Palette of Okabe and Ito (2008) without yellow, which is not visible on white paper.
const HUES: [Colour; 7] = [
    Colour(0, 114, 178),
    Colour(213, 94, 0),
    Colour(0, 158, 115),
    Colour(204, 121, 167),
    Colour(230, 159, 0),
    Colour(86, 180, 233),
    Colour(60, 60, 60),
];

/// Nine equally spaced samples of the viridis colour map (Smith and van der Walt, matplotlib), from pale to dark.
/// The palest tenth of viridis is omitted, because it is not visible on white paper.
const RAMP: [Colour; 9] = [
    Colour(189, 223, 38),
    Colour(128, 211, 75),
    Colour(74, 193, 109),
    Colour(41, 168, 126),
    Colour(33, 143, 141),
    Colour(43, 116, 142),
    Colour(56, 88, 140),
    Colour(69, 55, 129),
    Colour(68, 1, 84),
];

pub const HUE_COUNT: usize = HUES.len();

pub fn hue(index: usize) -> Colour {
    HUES[index % HUES.len()]
}

/// Colour of a ramp from pale (`part` 0) to dark (`part` 1), in which equal differences of `part` look equal.
pub fn ramp(part: f64) -> Colour {
    let place = clamp_part(part) * (RAMP.len() - 1) as f64;
    let below = (place as usize).min(RAMP.len() - 2);
    mix(RAMP[below], RAMP[below + 1], place - below as f64)
}

/// Shade of a single hue, from pale (`part` 0) to the `full` colour (`part` 1).
pub fn tint(full: Colour, part: f64) -> Colour {
    mix(WHITE, full, 0.25 + 0.75 * clamp_part(part))
}

/// Linear mixture of two colours: `from` for `part` 0, `to` for `part` 1.
pub fn mix(from: Colour, to: Colour, part: f64) -> Colour {
    let part = clamp_part(part);
    let blend = |a: u8, b: u8| (f64::from(a) + part * (f64::from(b) - f64::from(a))).round() as u8;
    Colour(blend(from.0, to.0), blend(from.1, to.1), blend(from.2, to.2))
}

fn clamp_part(part: f64) -> f64 {
    if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lightness(Colour(r, g, b): Colour) -> f64 {
        0.2126 * f64::from(r) + 0.7152 * f64::from(g) + 0.0722 * f64::from(b)
    }

    #[test]
    fn colour_ramp_darkens_monotonically() {
        let shades: Vec<f64> = (0..=100).map(|i| lightness(ramp(f64::from(i) / 100.0))).collect();
        assert!(shades.windows(2).all(|pair| pair[1] <= pair[0] + 0.5));
    }

    #[test]
    fn colour_positions_out_of_range_are_clamped() {
        assert_eq!(ramp(f64::NAN), RAMP[0]);
        assert_eq!(ramp(7.0), RAMP[8]);
        assert_eq!(mix(WHITE, INK, f64::INFINITY), INK);
        assert_eq!(hue(HUE_COUNT + 1), hue(1));
    }
}
