//! What a simulation uses, and what it therefore leaves out.

use super::Simulation;
use crate::model::Part;

impl Simulation {
    /// What this simulation uses and what it leaves out: of its scene, then how it takes steps.
    pub fn explain(&self) -> Vec<Part> {
        let method = self.settings().method;
        let mut parts = self.model().explain(self.scene(), &[method]);
        let entry = method.entry();
        let claims = entry.claims;
        let kept = [
            (claims.energy, "energy"),
            (claims.momentum, "momentum"),
            (claims.angular_momentum, "angular momentum"),
        ];
        let kept: Vec<&str> =
            kept.into_iter().filter(|(keeps, _)| *keeps).map(|(_, it)| it).collect();
        let how = format!("{}, order {}; keeps {}", entry.name, claims.order, kept.join(", "));
        parts.push(Part::used("integrator", how));
        let now = self.time();
        let ahead: Vec<f64> = self.grid.cuts().iter().copied().filter(|cut| *cut > now).collect();
        parts.push(Part::steps(self.settings().dt, &ahead));
        parts
    }
}
