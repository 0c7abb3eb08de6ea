//! Summary of the mechanical features that a simulation uses and omits.

use super::Simulation;
use crate::simulation::controller::StepController;
use crate::simulation::{Recording, WorkCounts};
use crate::system::SystemFeature;

impl Simulation {
    /// Features that this simulation uses and omits: first those of its scene, then those of its steps.
    pub fn explain(&self) -> Vec<SystemFeature> {
        let method = self.settings().method;
        let mut parts = self.model().explain(self.scene(), &[method]);
        let entry = method.entry();
        let kept = match entry.claims.conserved_quantities().collect::<Vec<_>>().join(", ") {
            none if none.is_empty() => "nothing exactly".to_owned(),
            kept => kept,
        };
        let how = format!("{}, order {}; keeps {}", entry.name, entry.claims.order, kept);
        parts.push(SystemFeature::used("integrator", how));
        let now = self.time();
        let ahead: Vec<f64> =
            self.clock.grid.cuts().iter().copied().filter(|cut| *cut > now).collect();
        parts.push(SystemFeature::steps(&self.settings().dt.to_string(), &ahead));
        parts.push(self.explain_tries());
        parts.extend([self.explain_recording(), self.explain_snapshots()]);
        parts.extend(self.explain_resolution());
        parts
    }

    fn explain_recording(&self) -> SystemFeature {
        let numbers = self.record.history.columns().count() + self.record.trajectory.stride();
        let rows = self.record.history.samples().len();
        let how = format!(
            "{}: {rows} rows with {numbers} values each so far",
            self.record.recording.describe()
        );
        match self.record.recording {
            Recording::Nothing => SystemFeature::omitted(
                "recording",
                "only the ends of a run; energies are computed on request",
            ),
            Recording::Every(_) => SystemFeature::used("recording", how),
        }
    }

    fn explain_snapshots(&self) -> SystemFeature {
        let (kept, bytes) = self.stored_snapshots();
        match self.snapshot_limit() {
            0 => SystemFeature::omitted("snapshots", "no stored states, and no stepping back"),
            limit => {
                let (used, most) = (bytes as f64 / 1e6, limit as f64 / 1e6);
                let how = format!("{kept} snapshots in {used:.1} of {most} MB; one per step");
                SystemFeature::used("snapshots", how)
            }
        }
    }

    fn explain_tries(&self) -> SystemFeature {
        let WorkCounts { rejected, retries, .. } = self.counts();
        match &self.adaptive {
            None => {
                SystemFeature::omitted("error control", "fixed step size; failed steps are halved")
            }
            Some(adaptive) => {
                let StepController { first, smallest, .. } = adaptive.controller;
                let how = format!(
                    "step doubling: two steps are compared with one of double length (3 solves instead of 2); first step {first:.3e}, smallest {smallest:.1e}; rejected {rejected}, failed {retries} so far"
                );
                SystemFeature::used("error control", how)
            }
        }
    }
}
