//! The rules by name, with what each of them claims. Tests and help read this list.

use serde::{Deserialize, Serialize};

use super::{Conserving, Exact, Kinked, Relaxed, SlidingLaw};

/// A choice of the law by which a step keeps a slider on its master.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub enum SlidingRule {
    /// The law [`Relaxed`]: the contact is closed in the mean of each step.
    Relaxed,
    /// The law [`Exact`]: the contact is closed at the end of each step; angular momentum is not kept.
    Exact,
    /// The law [`Conserving`]: the contact is closed at the end of each step; energy and momenta are kept.
    #[default]
    Conserving,
    /// The law [`Kinked`]: the contact is closed on the kinked axis at the end of each step; energy and momenta are kept.
    Kinked,
}

/// What a law of sliding keeps to rounding, with an integrator that keeps it without sliders. All laws keep linear momentum.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RuleClaims {
    /// Whether the law of sliding keeps the energy.
    pub energy: bool,
    /// Whether the law of sliding keeps the angular momentum.
    pub angular_momentum: bool,
    /// Whether the law of sliding has the slave on the master at the end of every step.
    pub gap: bool,
}

/// A law of sliding in the list [`SLIDING_RULES`].
#[derive(Debug, Clone, Copy)]
pub struct RuleEntry {
    /// The law of sliding that this row of the list describes.
    pub rule: SlidingRule,
    /// The name of the law of sliding in scripts and reports.
    pub name: &'static str,
    /// What the law of sliding is good for, in a sentence.
    pub summary: &'static str,
    /// What the law of sliding keeps.
    pub claims: RuleClaims,
    /// The source of the law of sliding in the literature.
    pub source: &'static str,
}

/// All laws of sliding, the default first.
pub const SLIDING_RULES: &[RuleEntry] = &[CONSERVING, KINKED, EXACT, RELAXED];

const CONSERVING: RuleEntry = RuleEntry {
    rule: SlidingRule::Conserving,
    name: "conserving",
    summary: "keeps energy, both momenta and the gap to rounding at any step; the default",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: true },
    source: "withy, docs/theory.md, section 10",
};

const KINKED: RuleEntry = RuleEntry {
    rule: SlidingRule::Kinked,
    name: "kinked",
    summary: "keeps energy, both momenta and the gap, on the axis as the contact force kinks it: second order in the mesh, forces at their own time",
    claims: RuleClaims { energy: true, angular_momentum: true, gap: true },
    source: "withy, docs/theory.md, section 10.1",
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
    /// The row of this law of sliding in [`SLIDING_RULES`].
    pub fn entry(self) -> &'static RuleEntry {
        match self {
            Self::Kinked => &KINKED,
            Self::Conserving => &CONSERVING,
            Self::Exact => &EXACT,
            Self::Relaxed => &RELAXED,
        }
    }

    /// The equations of this law of sliding.
    pub fn law(self) -> &'static dyn SlidingLaw {
        match self {
            Self::Kinked => &Kinked,
            Self::Conserving => &Conserving,
            Self::Exact => &Exact,
            Self::Relaxed => &Relaxed,
        }
    }
}
