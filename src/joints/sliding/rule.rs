//! The rules by name, with what each of them claims. Tests and help read this list.

use serde::{Deserialize, Serialize};

use super::{Conserving, Exact, Relaxed, SlidingLaw};

/// A choice of how a step keeps a slider on its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum SlidingRule {
    /// [`Relaxed`].
    Relaxed,
    /// [`Exact`].
    Exact,
    /// [`Conserving`].
    #[default]
    Conserving,
}

/// What a rule keeps to rounding, with an integrator that keeps it without sliders. All keep linear momentum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RuleClaims {
    /// Whether the energy is.
    pub energy: bool,
    /// Whether the angular momentum is.
    pub angular_momentum: bool,
    /// Whether the slave is on the master at the end of every step.
    pub gap: bool,
}

/// A row of the list of rules.
#[derive(Debug, Clone, Copy)]
pub struct RuleEntry {
    /// The rule.
    pub rule: SlidingRule,
    /// Its name in scripts and reports.
    pub name: &'static str,
    /// What it is good for, in a sentence.
    pub summary: &'static str,
    /// What it promises.
    pub claims: RuleClaims,
    /// Where it comes from.
    pub source: &'static str,
}

/// All rules.
pub const SLIDING_RULES: &[RuleEntry] = &[CONSERVING, EXACT, RELAXED];

const CONSERVING: RuleEntry = RuleEntry {
    rule: SlidingRule::Conserving,
    name: "conserving",
    summary: "keeps energy, both momenta and the gap to rounding at any step; the default",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: true },
    source: "withy, docs/theory.md, section 10",
};

const EXACT: RuleEntry = RuleEntry {
    rule: SlidingRule::Exact,
    name: "exact",
    summary: "keeps energy and gap; for comparison: angular momentum is lost at second order",
    claims: RuleClaims { energy: true, angular_momentum: false, gap: true },
    source: "Sibileau & Muñoz, equations 15 and 17",
};

const RELAXED: RuleEntry = RuleEntry {
    rule: SlidingRule::Relaxed,
    name: "relaxed",
    summary: "keeps energy and both momenta; for comparison: the gap drifts, and a step may have no solution",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: false },
    source: "Sibileau & Muñoz, equations 11 to 14",
};

impl SlidingRule {
    /// Its row in [`SLIDING_RULES`].
    pub fn entry(self) -> &'static RuleEntry {
        match self {
            Self::Conserving => &CONSERVING,
            Self::Exact => &EXACT,
            Self::Relaxed => &RELAXED,
        }
    }

    /// Its law.
    pub fn law(self) -> &'static dyn SlidingLaw {
        match self {
            Self::Conserving => &Conserving,
            Self::Exact => &Exact,
            Self::Relaxed => &Relaxed,
        }
    }
}
