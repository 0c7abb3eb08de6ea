//! Search for the object with the largest residual after a failed step.

use super::System;
use crate::integrators::FailureSource;
use crate::newton::ResidualPart;
use crate::system::state::UnknownKind;

/// Index of the first NaN or, without NaN, of the largest magnitude; `None` if all values are zero.
fn worst(values: impl Iterator<Item = f64>) -> Option<usize> {
    let size = |value: f64| if value.is_nan() { f64::INFINITY } else { value.abs() };
    let largest =
        values.map(size).enumerate().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    largest.filter(|(_, size)| *size > 0.0).map(|(at, _)| at)
}

impl System {
    pub(super) fn worst_of(&self, part: ResidualPart, residual: &[f64]) -> Option<FailureSource> {
        match part {
            ResidualPart::Strain => self.worst_strain().or_else(|| self.worst_balance(residual)),
            ResidualPart::Force => self.worst_balance(residual),
            ResidualPart::Constraint => self.worst_violation(residual),
        }
    }

    fn worst_strain(&self) -> Option<FailureSource> {
        let (name, missing) = self.elements.farthest()?;
        let is_worst = missing.is_nan() || missing >= self.step.summary.strain_mismatch;
        is_worst.then(|| FailureSource::Named(format!("'{name}'")))
    }

    fn worst_balance(&self, residual: &[f64]) -> Option<FailureSource> {
        let entries = residual.iter().zip(self.unknowns.kinds());
        let relative = entries.map(|(value, kind)| match kind {
            UnknownKind::Position => self.step.relative_force(value.abs()),
            UnknownKind::Rotation => self.step.relative_moment(value.abs()),
            UnknownKind::Force => 0.0,
        });
        worst(relative).map(FailureSource::Unknown)
    }

    fn worst_violation(&self, residual: &[f64]) -> Option<FailureSource> {
        let equations = residual.get(self.unknowns.count()..)?;
        let of_sliders = self.sliders.iter().map(|slider| {
            let (length, force) = slider.violation(equations);
            length.max(self.step.relative_force(force))
        });
        if let Some(slider) = worst(of_sliders) {
            return Some(FailureSource::Named(format!("slider '{}'", self.sliders[slider].name)));
        }
        let of_links = residual.iter().zip(self.unknowns.kinds());
        let of_links =
            of_links.map(|(value, kind)| if *kind == UnknownKind::Force { *value } else { 0.0 });
        worst(of_links).map(FailureSource::Unknown)
    }
}
