//! What a simulation uses, and what it therefore leaves out.

use super::Simulation;
use crate::model::Part;

impl Simulation {
    /// What this simulation uses and what it leaves out: of its scene, then how it takes steps.
    pub fn explain(&self) -> Vec<Part> {
        let method = self.settings().method;
        let mut parts = self.model().explain(self.scene(), &[method]);
        let entry = method.entry();
        let kept = match entry.claims.kept().collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => "nothing exactly".to_owned(),
            kept => kept,
        };
        let how = format!("{}, order {}; keeps {}", entry.name, entry.claims.order, kept);
        parts.push(Part::used("integrator", how));
        let now = self.time();
        let ahead: Vec<f64> = self.grid.cuts().iter().copied().filter(|cut| *cut > now).collect();
        parts.push(Part::steps(self.settings().dt, &ahead));
        parts
    }
}
