//! Target forces: the forces that the laws of a spring and a damper require in a configuration.

use super::SpringDamper;
use crate::integrators::Stage;
use crate::system::elements::damping_law::DampingLaw;
use crate::system::elements::mixed_force::ForceTarget;
use crate::system::elements::{SpringLaw, TrialState};

impl SpringDamper {
    pub(super) fn restoring_at_start(&self) -> f64 {
        self.law.as_ref().map_or(0.0, |law| law.force(self.elongation.grown()))
    }

    /// Returns true if the law has a segment with zero force. The result determines the size of saved states.
    /// Therefore the result must not change if the spring is released.
    pub(super) fn may_be_slack(&self) -> bool {
        let law = self.released.as_ref().map_or(&self.law, |(law, _)| law);
        law.as_ref().is_some_and(SpringLaw::may_be_slack)
    }

    pub(super) fn restoring(&self, stage: Stage) -> ForceTarget {
        self.restoring_after(stage, self.elongation.change)
    }

    fn restoring_after(&self, stage: Stage, change: f64) -> ForceTarget {
        let Some(law) = &self.law else { return ForceTarget::default() };
        let q = self.elongation.grown();
        match stage {
            Stage::Start => ForceTarget { force: law.force(q), stiffness: 0.0 },
            Stage::End => {
                let end = q.after(change);
                ForceTarget { force: law.force(end), stiffness: law.slope(end) }
            }
            Stage::Midpoint => {
                let mean = law.mean(q, change);
                ForceTarget { force: mean.force, stiffness: mean.slope }
            }
            Stage::DampedMidpoint(chi) => {
                let mean = law.mean(q, change);
                // Only linear laws receive numerical damping, because numerical damping adds energy where the stiffness is negative.
                // Springs with separate x and y components receive no numerical damping, which would rotate the force relative to the spring.
                let late = match law {
                    _ if self.elongation.is_component() => 0.0,
                    SpringLaw::Linear { stiffness, .. } => 0.5 * chi * stiffness.max(0.0),
                    SpringLaw::Table { .. } | SpringLaw::Sampled { .. } => 0.0,
                };
                ForceTarget { force: mean.force + late * change, stiffness: mean.slope + late }
            }
        }
    }

    /// Target force of the spring for a linearisation.
    /// After several iterations, the spring is linearised at the force that satisfies its law and the linearised response of all other objects.
    pub(super) fn spring_target(&mut self, stage: Stage) -> ForceTarget {
        let (asked, change) = (self.restoring(stage), self.elongation.change);
        let impedance = self.spring.impedance(change);
        let Some(impedance) = impedance.filter(|_| self.rises) else { return asked };
        ForceTarget::intersection(change, self.spring.force, impedance, |change| {
            self.restoring_after(stage, change)
        })
    }

    pub(super) fn damping(&self, at: TrialState<'_>) -> ForceTarget {
        let Some(late) = self.lateness(at) else { return ForceTarget::default() };
        match &self.damping {
            DampingLaw::Linear(constant) => {
                let by_change = constant / self.duration;
                let force = by_change * self.elongation.change;
                ForceTarget {
                    force: force + late * (force - constant * self.last.1),
                    stiffness: (1.0 + late) * by_change,
                }
            }
            law => {
                let (rate, by_change) = self.rate(late);
                ForceTarget { force: law.force(rate), stiffness: by_change * law.slope(rate) }
            }
        }
    }

    pub(super) fn damper_target(&mut self, at: TrialState<'_>) -> ForceTarget {
        match (&self.damping, self.lateness(at)) {
            (law @ DampingLaw::Curve(_), Some(late)) => {
                let (rate, by_change) = self.rate(late);
                let impedance = self.damper.impedance(rate);
                let (force, slope) = law.linearised_target(rate, self.damper.force, impedance);
                ForceTarget { force, stiffness: by_change * slope }
            }
            _ => self.damping(at),
        }
    }

    fn lateness(&self, at: TrialState<'_>) -> Option<f64> {
        match at.stage {
            Stage::Start => None,
            Stage::Midpoint | Stage::DampedMidpoint(_) => Some(0.0),
            Stage::End if self.duration.is_infinite() => None,
            Stage::End => {
                Some(2.0 * (at.weight - 0.5) * self.duration / (self.duration + self.last.0))
            }
        }
    }

    fn rate(&self, late: f64) -> (f64, f64) {
        let rate = self.elongation.change / self.duration;
        (rate + late * (rate - self.last.1), (1.0 + late) / self.duration)
    }
}
