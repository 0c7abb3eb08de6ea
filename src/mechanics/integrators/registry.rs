//! List of the integrators and their conservation properties, used by tests and help.

use serde::{Deserialize, Serialize};

use super::end_check::EndCheck;
use super::{
    EnergyDecaying, EnergyMomentum, FourthOrder, GeneralizedAlpha, Integrator, Mechanism, Stage,
    Trapezoidal,
};
use crate::newton::Tolerance;

/// Selection of a time integrator.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub enum Method {
    /// [`EnergyMomentum`], the default.
    #[default]
    EnergyMomentum,
    /// [`Trapezoidal`]: Newmark's method with β = 1/4 and γ = 1/2.
    Trapezoidal,
    /// [`EnergyDecaying`]: momenta are conserved, vibrations are damped.
    EnergyDecaying {
        /// Dissipation `χ` [-]: section forces belong to the mean strain plus `χ/2` times the change of the strain in the step.
        chi: f64,
    },
    /// [`FourthOrder`]: a composition of seven energy–momentum steps.
    FourthOrder,
    /// [`GeneralizedAlpha`] of Chung & Hulbert.
    GeneralizedAlpha {
        /// Spectral radius `ρ∞`, the factor by which the amplitude of the highest frequency changes in each step [-].
        rho_infinity: f64,
    },
}

/// Conservation of energy by an integration method.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EnergyClaim {
    /// The energy is conserved to rounding.
    Conserved,
    /// The energy never increases by more than rounding.
    NonIncreasing,
    /// The energy may increase or decrease.
    Unclaimed,
}

/// Conservation properties of a method for nonlinear problems. Energy and momentum supplied by loads and supports are subtracted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Claims {
    /// Order of convergence in time.
    pub order: u32,
    /// Conservation of energy by the method.
    pub energy: EnergyClaim,
    /// True if linear momentum is conserved to rounding.
    pub momentum: bool,
    /// True if angular momentum is conserved to rounding.
    pub angular_momentum: bool,
}

impl Claims {
    /// Largest order of convergence in time.
    /// Numerical dissipation of first order vanishes in slow motions and leaves an error of second order.
    pub fn largest_order(&self) -> u32 {
        self.order.max(2)
    }

    /// Names of the quantities that the method conserves.
    pub fn conserved_quantities(&self) -> impl Iterator<Item = &'static str> {
        let claims = [
            (self.energy == EnergyClaim::Conserved, "energy"),
            (self.momentum, "linear momentum"),
            (self.angular_momentum, "angular momentum"),
        ];
        claims.into_iter().filter(|(is_kept, _)| *is_kept).map(|(_, what)| what)
    }
}

/// Parameter of a method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MethodParameter {
    /// Name of the parameter in scripts.
    pub name: &'static str,
    /// Description of the parameter as a sentence.
    pub meaning: &'static str,
    /// Smallest allowed value of the parameter [-].
    pub least: f64,
    /// Largest allowed value of the parameter [-]; infinite without an upper limit.
    pub most: f64,
    /// Default value of the parameter [-].
    pub default: f64,
}

impl MethodParameter {
    /// Description of the range of the parameter, such as `from 0 to 1`.
    pub fn range(&self) -> String {
        match self.most {
            f64::INFINITY => format!("{} or greater", self.least),
            most => format!("from {} to {most}", self.least),
        }
    }
}

/// Method parameter outside its range.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("{method}: {name} is {value}, but must be a finite number, {allowed}")]
pub struct MethodError {
    method: &'static str,
    name: &'static str,
    value: f64,
    allowed: String,
}

/// Entry of the list [`INTEGRATORS`].
#[derive(Debug, Clone, Copy)]
pub struct IntegratorEntry {
    /// Method with the default of its parameter.
    pub method: Method,
    /// Name of the method in scripts and reports.
    pub name: &'static str,
    /// Recommended use of the method as a sentence.
    pub summary: &'static str,
    /// Conservation properties of the method.
    pub claims: Claims,
    /// Parameter of the method; `None` for methods without a parameter.
    pub parameter: Option<MethodParameter>,
    /// Reference to the literature about the method.
    pub source: &'static str,
}

/// All time integrators. The first entry is the default.
pub const INTEGRATORS: &[IntegratorEntry] =
    &[ENERGY_MOMENTUM, TRAPEZOIDAL, ENERGY_DECAYING, FOURTH_ORDER, GENERALIZED_ALPHA];

const ENERGY_MOMENTUM: IntegratorEntry = IntegratorEntry {
    method: Method::EnergyMomentum,
    name: "energy_momentum",
    summary: "conserves energy and both momenta to rounding at any step size; the default",
    claims: Claims {
        order: 2,
        energy: EnergyClaim::Conserved,
        momentum: true,
        angular_momentum: true,
    },
    parameter: None,
    source: "Stander & Stein, Eng. Comput. 13 (1996) 60-85",
};

const TRAPEZOIDAL: IntegratorEntry = IntegratorEntry {
    method: Method::Trapezoidal,
    name: "trapezoidal",
    summary: "Newmark's method with β = 1/4, γ = 1/2, for comparison: energy is not conserved in nonlinear problems",
    claims: Claims {
        order: 2,
        energy: EnergyClaim::Unclaimed,
        momentum: true,
        angular_momentum: false,
    },
    parameter: None,
    source: "Newmark, J. Eng. Mech. Div. ASCE 85 (1959) 67-94",
};

const ENERGY_DECAYING: IntegratorEntry = IntegratorEntry {
    method: Method::EnergyDecaying { chi: CHI.default },
    name: "energy_decaying",
    summary: "conserves both momenta to rounding and damps vibration: the energy never increases, at any step size",
    claims: Claims {
        order: 1,
        energy: EnergyClaim::NonIncreasing,
        momentum: true,
        angular_momentum: true,
    },
    parameter: Some(CHI),
    source: "Armero & Romero, Comput. Methods Appl. Mech. Eng. 190 (2001) 2603-2649",
};

const CHI: MethodParameter = MethodParameter {
    name: "chi",
    meaning: "damping parameter χ; 0 is energy_momentum",
    least: 0.0,
    most: f64::INFINITY,
    default: 0.1,
};

const FOURTH_ORDER: IntegratorEntry = IntegratorEntry {
    method: Method::FourthOrder,
    name: "fourth_order",
    summary: "fourth order, composed of seven energy-momentum substeps: conserves energy and both momenta to rounding",
    claims: Claims {
        order: 4,
        energy: EnergyClaim::Conserved,
        momentum: true,
        angular_momentum: true,
    },
    parameter: None,
    source: "composition as in McLachlan, SIAM J. Sci. Comput. 16 (1995) 151-168",
};

const GENERALIZED_ALPHA: IntegratorEntry = IntegratorEntry {
    method: Method::GeneralizedAlpha { rho_infinity: RHO_INFINITY.default },
    name: "generalized_alpha",
    summary: "generalized-α method, for comparison: damps fast vibration, conserves nothing exactly",
    claims: Claims {
        order: 2,
        energy: EnergyClaim::Unclaimed,
        momentum: false,
        angular_momentum: false,
    },
    parameter: Some(RHO_INFINITY),
    source: "Chung & Hulbert, J. Appl. Mech. 60 (1993) 371-375",
};

const RHO_INFINITY: MethodParameter = MethodParameter {
    name: "rho_infinity",
    meaning: "ρ∞, factor per step of the amplitude of the fastest vibration; 1 is the trapezoidal rule",
    least: 0.0,
    most: 1.0,
    default: 0.8,
};

impl Method {
    /// Entry of the integration method in [`INTEGRATORS`].
    pub fn entry(&self) -> &'static IntegratorEntry {
        match self {
            Self::EnergyMomentum => &ENERGY_MOMENTUM,
            Self::Trapezoidal => &TRAPEZOIDAL,
            Self::EnergyDecaying { .. } => &ENERGY_DECAYING,
            Self::FourthOrder => &FOURTH_ORDER,
            Self::GeneralizedAlpha { .. } => &GENERALIZED_ALPHA,
        }
    }

    /// Step size for which the longest substep has the given duration [time]. A negative duration refers to substeps backwards in time.
    pub fn step_with_part(&self, duration: f64) -> f64 {
        let [onwards, back] = match self {
            Self::FourthOrder => FourthOrder::LONGEST,
            _ => [1.0; 2],
        };
        duration / if duration < 0.0 { back } else { onwards }
    }

    /// Value of the parameter of the method [-]; `None` if the method has no parameter.
    pub fn parameter(&self) -> Option<f64> {
        match *self {
            Self::EnergyMomentum | Self::Trapezoidal | Self::FourthOrder => None,
            Self::EnergyDecaying { chi } => Some(chi),
            Self::GeneralizedAlpha { rho_infinity } => Some(rho_infinity),
        }
    }

    /// Checks the parameter of the method.
    ///
    /// # Errors
    /// Fails if the parameter is out of range or not finite.
    pub fn check(&self) -> Result<(), MethodError> {
        let entry = self.entry();
        let Some((parameter, value)) = entry.parameter.zip(self.parameter()) else { return Ok(()) };
        if value.is_finite() && (parameter.least..=parameter.most).contains(&value) {
            return Ok(());
        }
        let (name, allowed) = (parameter.name, parameter.range());
        Err(MethodError { method: entry.name, name, value, allowed })
    }

    /// Stages of a step at which the method evaluates loads.
    pub fn stages(&self) -> &'static [Stage] {
        match self {
            Self::EnergyMomentum => EnergyMomentum::STAGES,
            Self::Trapezoidal => Trapezoidal::STAGES,
            Self::EnergyDecaying { .. } => EnergyDecaying::STAGES,
            Self::FourthOrder => FourthOrder::STAGES,
            Self::GeneralizedAlpha { .. } => GeneralizedAlpha::STAGES,
        }
    }

    /// Creates the integrator, and allocates memory for a mechanism.
    pub fn build(
        &self,
        mechanism: &mut dyn Mechanism,
        tolerance: Tolerance,
    ) -> Box<dyn Integrator> {
        let integrator: Box<dyn Integrator> = match *self {
            Self::EnergyMomentum => Box::new(EnergyMomentum::new(mechanism, tolerance)),
            Self::Trapezoidal => Box::new(Trapezoidal::new(mechanism, tolerance)),
            Self::EnergyDecaying { chi } => {
                Box::new(EnergyDecaying::new(chi, mechanism, tolerance))
            }
            Self::FourthOrder => Box::new(FourthOrder::new(mechanism, tolerance)),
            Self::GeneralizedAlpha { rho_infinity } => {
                Box::new(GeneralizedAlpha::new(rho_infinity, mechanism, tolerance))
            }
        };
        if mechanism.has_end_conditions() {
            return Box::new(EndCheck::new(integrator));
        }
        integrator
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn registered_integrator_parameters_are_valid_and_others_are_rejected() {
        for entry in INTEGRATORS {
            assert_eq!(entry.method.check(), Ok(()), "{}", entry.name);
            assert_eq!(entry.parameter.map(|of| of.default), entry.method.parameter());
        }
        for chi in [-0.1, f64::NAN, f64::INFINITY] {
            assert!(Method::EnergyDecaying { chi }.check().is_err(), "{chi}");
        }
        let message =
            Method::GeneralizedAlpha { rho_infinity: 1.5 }.check().unwrap_err().to_string();
        assert!(
            message.contains("rho_infinity is 1.5") && message.contains("from 0 to 1"),
            "{message}"
        );
    }
}
