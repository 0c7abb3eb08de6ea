//! Record of elongations or rates outside the range of a tabulated law.

use super::spring_law::SpringLaw;

/// Largest distance of a value from a range that is attributed to rounding, as a fraction of the largest magnitude of the limits of the range.
const ROUNDING: f64 = 1e-9;

/// Argument of a force law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LawArgument {
    /// Elongation of a spring.
    Elongation,
    /// Rate of the elongation, for a damping law.
    Rate,
}

/// Value outside the range of a tabulated law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OutsideLaw {
    /// Argument that left the range.
    pub argument: LawArgument,
    /// Smallest and largest argument in the table of the law [length or rad; for rates length/time or rad/time].
    /// If the force is constant at an end of the table, arguments beyond this end count as inside, and the limit is infinite.
    pub range: [f64; 2],
    /// Value of the argument that was farthest outside the range [length or rad; for rates length/time or rad/time].
    pub reached: f64,
}

#[derive(Debug, Clone, Copy)]
pub struct LawRange {
    farthest: OutsideLaw,
    beyond: f64,
}

impl LawRange {
    /// Creates the monitor of the elongations of a spring law; `None` for laws that are defined everywhere.
    pub fn of_elongations(law: &SpringLaw) -> Option<Self> {
        Self::of(law, LawArgument::Elongation)
    }

    /// Creates the monitor of the rates of a damping law; `None` for laws that are defined everywhere.
    pub fn of_rates(law: &SpringLaw) -> Option<Self> {
        Self::of(law, LawArgument::Rate)
    }

    fn of(law: &SpringLaw, argument: LawArgument) -> Option<Self> {
        let range = law.range()?;
        let farthest = OutsideLaw { argument, range, reached: 0.0 };
        Some(Self { farthest, beyond: 0.0 })
    }

    pub fn add(&mut self, value: f64) {
        let [from, to] = self.farthest.range;
        let beyond = (from - value).max(value - to);
        if beyond > self.beyond {
            (self.beyond, self.farthest.reached) = (beyond, value);
        }
    }

    /// Value farthest outside the range of the law; `None` if no value is outside by more than rounding.
    pub fn outside(&self) -> Option<OutsideLaw> {
        let [from, to] = self.farthest.range;
        let ends = [from, to].into_iter().filter(|end| end.is_finite());
        let size = ends.map(f64::abs).fold(0.0, f64::max);
        (self.beyond > ROUNDING * size).then_some(self.farthest)
    }

    pub fn save(&self, state: &mut Vec<f64>) {
        state.extend([self.farthest.reached, self.beyond]);
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        (self.farthest.reached, self.beyond) = (next(), next());
    }
}
