//! Where a step fails: what is farthest from its balance. Asked after a failure only.

use super::Model;
use crate::beams::ForceSummary;
use crate::integrators::{Culprit, Stage};
use crate::model::elements::{Iterate, collocation};
use crate::model::motion::UnknownKind;
use crate::newton::Part;

/// The number of the largest, or of the first that is not a number; none where all are zero.
fn worst(values: impl Iterator<Item = f64>) -> Option<usize> {
    let size = |value: f64| if value.is_nan() { f64::INFINITY } else { value.abs() };
    let largest =
        values.map(size).enumerate().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
    largest.filter(|(_, size)| *size > 0.0).map(|(at, _)| at)
}

impl Model {
    /// What is worst in an iterate, of that part of its imbalance which is.
    pub(super) fn worst_of(
        &mut self,
        part: Part,
        stage: Stage,
        (increments, weight): (&[f64], f64),
        residual: &[f64],
    ) -> Option<Culprit> {
        match part {
            Part::Force => self.worst_balance(residual),
            Part::Strain => self.worst_strained(stage, increments, weight),
            Part::Constraint => self.worst_violation(residual),
        }
    }

    fn worst_balance(&self, residual: &[f64]) -> Option<Culprit> {
        let entries = residual.iter().zip(self.unknowns.kinds());
        let relative = entries.map(|(value, kind)| match kind {
            UnknownKind::Position => self.step.relative_force(value.abs()),
            UnknownKind::Rotation => self.step.relative_moment(value.abs()),
            UnknownKind::Force => 0.0,
        });
        worst(relative).map(Culprit::Unknown)
    }

    fn worst_strained(&mut self, stage: Stage, increments: &[f64], weight: f64) -> Option<Culprit> {
        let mut out =
            vec![0.0; self.unknowns.count() + self.sliders.border().width + self.supports.count()];
        let collocation = collocation(stage);
        let of_bodies = self.bodies.iter_mut();
        let of_bodies: Vec<f64> = of_bodies
            .map(|body| body.add_forces(collocation, increments, weight, &mut out).strain_mismatch)
            .collect();
        let at = Iterate { bodies: &self.bodies, stage, increments, weight };
        let of_elements = self.elements.mismatches(at, &mut out);
        let all =
            of_bodies.iter().copied().chain(of_elements.iter().map(|(_, mismatch)| *mismatch));
        let at = worst(all)?;
        Some(match at.checked_sub(of_bodies.len()) {
            None => Culprit::Body(at),
            Some(element) => Culprit::Named(format!("'{}'", of_elements[element].0)),
        })
    }

    fn worst_violation(&self, residual: &[f64]) -> Option<Culprit> {
        let equations = residual.get(self.unknowns.count()..)?;
        let of_sliders = self.sliders.iter().map(|slider| {
            let (length, force) = slider.violation(equations);
            length.max(self.step.relative_force(force))
        });
        if let Some(slider) = worst(of_sliders) {
            return Some(Culprit::Named(format!("slider '{}'", self.sliders[slider].name)));
        }
        let of_links = residual.iter().zip(self.unknowns.kinds());
        let of_links =
            of_links.map(|(value, kind)| if *kind == UnknownKind::Force { *value } else { 0.0 });
        worst(of_links).map(Culprit::Unknown)
    }
}

impl crate::model::elements::Elements {
    /// How far the forces of what resists movements are from those of an iterate, each by its name.
    fn mismatches(&mut self, at: Iterate<'_>, out: &mut [f64]) -> Vec<(String, f64)> {
        self.each_resistance(|resistance| {
            let ForceSummary { strain_mismatch, .. } = resistance.add_forces(at, out);
            (resistance.name().to_owned(), strain_mismatch)
        })
    }
}
