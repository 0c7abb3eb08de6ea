//! List of the sliding rules and their conservation properties, used by tests and help.

use serde::{Deserialize, Serialize};

use super::{Conserving, Exact, Kinked, Relaxed, SlidingLaw};

/// Sliding rule, which selects the sliding law of a slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum SlidingRule {
    /// [`Relaxed`]: the gap is closed on average over each step.
    Relaxed,
    /// [`Exact`]: the gap is closed at the end of each step; angular momentum is not conserved.
    Exact,
    /// [`Conserving`]: the gap is closed at the end of each step; energy and momenta are conserved.
    #[default]
    Conserving,
    /// [`Kinked`]: the gap to the kinked axis is closed at the end of each step; energy and momenta are conserved.
    Kinked,
}

/// Quantities that a sliding law conserves to rounding, if the integrator conserves them in scenes without sliders.
/// All sliding laws conserve linear momentum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RuleClaims {
    /// True if the energy is conserved.
    pub energy: bool,
    /// True if angular momentum is conserved.
    pub angular_momentum: bool,
    /// True if the slave is exactly on the master at the end of every step.
    pub gap: bool,
}

/// Entry of the list [`SLIDING_RULES`].
#[derive(Debug, Clone, Copy)]
pub struct RuleEntry {
    /// Sliding rule of the entry.
    pub rule: SlidingRule,
    /// Name of the sliding rule in scripts and reports.
    pub name: &'static str,
    /// Recommended use of the sliding rule as a sentence.
    pub summary: &'static str,
    /// Conservation properties of the sliding rule.
    pub claims: RuleClaims,
    /// Reference to the literature about the sliding rule.
    pub source: &'static str,
}

/// All sliding rules. The first rule is the default.
pub const SLIDING_RULES: &[RuleEntry] = &[CONSERVING, KINKED, EXACT, RELAXED];

const CONSERVING: RuleEntry = RuleEntry {
    rule: SlidingRule::Conserving,
    name: "conserving",
    summary: "conserves energy and both momenta, and keeps the gap closed, to rounding at any step size; the default",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: true },
    source: "withy, docs/theory.md, section 10",
};

const KINKED: RuleEntry = RuleEntry {
    rule: SlidingRule::Kinked,
    name: "kinked",
    summary: "conserves the same on an axis with a kink under the contact force: second order in the mesh",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: true },
    source: "withy, docs/theory.md, section 10.1",
};

const EXACT: RuleEntry = RuleEntry {
    rule: SlidingRule::Exact,
    name: "exact",
    summary: "for comparison: conserves energy and keeps the gap closed; angular momentum has an error of second order",
    claims: RuleClaims { energy: true, angular_momentum: false, gap: true },
    source: "Sibileau & Muñoz, equations 15 and 17",
};

const RELAXED: RuleEntry = RuleEntry {
    rule: SlidingRule::Relaxed,
    name: "relaxed",
    summary: "for comparison: conserves energy and both momenta; the gap drifts, and a step may have no solution",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: false },
    source: "Sibileau & Muñoz, equations 11 to 14",
};

impl SlidingRule {
    /// Entry of the sliding rule in [`SLIDING_RULES`].
    pub fn entry(self) -> &'static RuleEntry {
        match self {
            Self::Kinked => &KINKED,
            Self::Conserving => &CONSERVING,
            Self::Exact => &EXACT,
            Self::Relaxed => &RELAXED,
        }
    }

    /// Sliding law that this rule selects.
    pub fn law(self) -> &'static dyn SlidingLaw {
        match self {
            Self::Kinked => &Kinked,
            Self::Conserving => &Conserving,
            Self::Exact => &Exact,
            Self::Relaxed => &Relaxed,
        }
    }
}
