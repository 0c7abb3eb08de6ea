//! What a configuration asks of the forces of a spring and a damper.

use super::SpringDamper;
use crate::integrators::Stage;
use crate::system::elements::damping_law::DampingLaw;
use crate::system::elements::mixed_force::ForceTarget;
use crate::system::elements::{SpringLaw, TrialState};

/// Halvings until nothing is left between two numbers, and some more.
const MOST_TRIES: usize = 120;

impl SpringDamper {
    pub(super) fn restoring_at_start(&self) -> f64 {
        self.law.as_ref().map_or(0.0, |law| law.force(self.elongation.grown()))
    }

    /// Whether its force is none in a part of its way. One that has let go is as it was: its state has the same numbers.
    pub(super) fn may_be_slack(&self) -> bool {
        let law = self.released.as_ref().map_or(&self.law, |(law, _)| law);
        law.as_ref().is_some_and(SpringLaw::may_be_slack)
    }

    /// What the configuration of an iterate asks of the spring.
    pub(super) fn restoring(&self, stage: Stage) -> ForceTarget {
        self.restoring_after(stage, self.elongation.change)
    }

    /// What the spring would be asked for after such a change of its elongation in the step [length, rad].
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
                // A law that falls would gain what one that rises loses; one component alone would turn what it damps.
                let late = match law {
                    _ if self.elongation.is_component() => 0.0,
                    SpringLaw::Linear { stiffness, .. } => 0.5 * chi * stiffness.max(0.0),
                    SpringLaw::Table { .. } | SpringLaw::Sampled { .. } => 0.0,
                };
                ForceTarget { force: mean.force + late * change, stiffness: mean.slope + late }
            }
        }
    }

    /// The same for a linearisation. Where the search goes on for long, Newton's method is told of the impedance of all that the spring acts on: at a
    /// corner of a stiff law it would go to and fro, or halve its way to it at every iteration. The line of that impedance through elongation and
    /// force meets the law at one place, as long as the law rises, and there it is linearised.
    pub(super) fn aimed_restoring(&mut self, stage: Stage) -> ForceTarget {
        let (asked, change) = (self.restoring(stage), self.elongation.change);
        let impedance = self.spring.impedance(change);
        let Some(impedance) = impedance.filter(|_| self.rises) else { return asked };
        let force = self.spring.force;
        let above = |at: f64, of: ForceTarget| of.force - force + impedance * (at - change);
        // As the law rises, it is no farther than where a law without any slope would be met.
        let reach = change - above(change, asked) / impedance;
        let (mut low, mut high) = (change.min(reach), change.max(reach));
        let (mut at, mut met) = (change, asked);
        for _ in 0..MOST_TRIES {
            let off = above(at, met);
            if off > 0.0 {
                high = at
            } else {
                low = at
            }
            let next = at - off / (met.stiffness + impedance);
            let next = if low < next && next < high { next } else { 0.5 * (low + high) };
            if off == 0.0 || next <= low || next >= high {
                break;
            }
            (at, met) = (next, self.restoring_after(stage, next));
        }
        ForceTarget { force: met.force + met.stiffness * (change - at), stiffness: met.stiffness }
    }

    /// What the configuration asks of the damper, for the whole step.
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

    /// The same for a linearisation.
    pub(super) fn aimed_damping(&mut self, at: TrialState<'_>) -> ForceTarget {
        match (&self.damping, self.lateness(at)) {
            (law @ DampingLaw::Curve(_), Some(late)) => {
                let (rate, by_change) = self.rate(late);
                let impedance = self.damper.impedance(rate);
                let (force, slope) = law.aimed(rate, self.damper.force, impedance);
                ForceTarget { force, stiffness: by_change * slope }
            }
            _ => self.damping(at),
        }
    }

    /// How much of the difference of two steps after the middle of a step its rates are met; none where they do not count.
    ///
    /// A method that takes forces at both ends balances those of one time of the step, `at.weight` of it after the start: the rate there
    /// follows from those in the middles of this step and of the last one.
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

    /// The rate that is damped, so late, and its derivative by `Δq`.
    fn rate(&self, late: f64) -> (f64, f64) {
        let rate = self.elongation.change / self.duration;
        (rate + late * (rate - self.last.1), (1.0 + late) / self.duration)
    }
}
