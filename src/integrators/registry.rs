//! The methods by name, with what each of them claims. Tests and help read this list.

use serde::{Deserialize, Serialize};

use super::{EnergyMomentum, Integrator, Mechanism, Stage, Trapezoidal};
use crate::newton::Tolerance;

/// A choice of method, before there is a mechanism to apply it to.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum Method {
    /// [`EnergyMomentum`].
    #[default]
    EnergyMomentum,
    /// [`Trapezoidal`].
    Trapezoidal,
}

/// What a method promises in nonlinear problems, loads and supports accounted for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Claims {
    /// Order of convergence in time.
    pub order: u32,
    /// Whether the energy is exact to rounding.
    pub energy: bool,
    /// Whether the linear momentum is exact to rounding.
    pub momentum: bool,
    /// Whether the angular momentum is exact to rounding.
    pub angular_momentum: bool,
}

/// A row of the list of methods.
#[derive(Debug, Clone, Copy)]
pub struct IntegratorEntry {
    /// The method.
    pub method: Method,
    /// Its name in scripts and reports.
    pub name: &'static str,
    /// What it is good for, in a sentence.
    pub summary: &'static str,
    /// What it promises.
    pub claims: Claims,
    /// Where it comes from.
    pub source: &'static str,
}

/// All methods.
pub const INTEGRATORS: &[IntegratorEntry] = &[ENERGY_MOMENTUM, TRAPEZOIDAL];

const ENERGY_MOMENTUM: IntegratorEntry = IntegratorEntry {
    method: Method::EnergyMomentum,
    name: "energy_momentum",
    summary: "keeps energy and both momenta to rounding at any step; the default",
    claims: Claims { order: 2, energy: true, momentum: true, angular_momentum: true },
    source: "Stander & Stein, Eng. Comput. 13 (1996) 60-85",
};

const TRAPEZOIDAL: IntegratorEntry = IntegratorEntry {
    method: Method::Trapezoidal,
    name: "trapezoidal",
    summary: "Newmark's β = 1/4, γ = 1/2; for comparison: the energy wanders in nonlinear problems",
    claims: Claims { order: 2, energy: false, momentum: true, angular_momentum: false },
    source: "Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67-94",
};

impl Method {
    /// Its row in [`INTEGRATORS`].
    pub fn entry(&self) -> &'static IntegratorEntry {
        match self {
            Self::EnergyMomentum => &ENERGY_MOMENTUM,
            Self::Trapezoidal => &TRAPEZOIDAL,
        }
    }

    /// The stages at which a step takes forces, and so asks loads for their values.
    pub fn stages(&self) -> &'static [Stage] {
        match self {
            Self::EnergyMomentum => EnergyMomentum::STAGES,
            Self::Trapezoidal => Trapezoidal::STAGES,
        }
    }

    /// The method with work space for a mechanism.
    pub fn build(&self, mechanism: &dyn Mechanism, tolerance: Tolerance) -> Box<dyn Integrator> {
        match self {
            Self::EnergyMomentum => Box::new(EnergyMomentum::new(mechanism, tolerance)),
            Self::Trapezoidal => Box::new(Trapezoidal::new(mechanism, tolerance)),
        }
    }
}
