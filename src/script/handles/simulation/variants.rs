//! Access to a simulation in the variant of the present call.

use std::cell::Ref;

use super::SimulationHandle;
use crate::script::bindings::parameter_variants::{ParameterSet, present, set_unavailable};
use crate::script::messages::numbers::format_number;
use crate::simulation::{DerivativeError, History, PerturbedSide, Simulation};

pub(super) fn in_words(reason: &DerivativeError) -> String {
    match reason {
        DerivativeError::Event { time, .. } | DerivativeError::NoStep { time, .. } => {
            let time = format_number(*time);
            format!("{reason}; earlier rows have derivatives: sim.history.before({time})")
        }
        other => other.to_string(),
    }
}

impl SimulationHandle {
    pub fn simulation(&self) -> Ref<'_, Simulation> {
        Ref::map(self.0.simulation.borrow(), |run| {
            let Some((parameter, side)) = Self::present_side(run) else { return run };
            run.perturbed(parameter, side).unwrap_or_else(|reason| {
                set_unavailable(&in_words(&reason));
                run
            })
        })
    }

    pub fn read_history<T>(&self, times: (f64, f64), read: impl FnOnce(&History) -> T) -> T {
        let run = self.0.simulation.borrow();
        let beside = Self::present_side(&run);
        match beside.map(|(parameter, side)| run.perturbed_history(parameter, side, times)) {
            Some(Ok(beside)) => return read(&beside),
            Some(Err(reason)) => set_unavailable(&in_words(&reason)),
            None => {}
        }
        match times {
            (f64::NEG_INFINITY, f64::INFINITY) => read(run.history()),
            (from, to) => read(&run.history().between(from, to)),
        }
    }

    pub fn primary(&self) -> Ref<'_, Simulation> {
        self.0.simulation.borrow()
    }

    /// Perturbed parameter and sign of the perturbation in the variant of the present call; `None` in the unperturbed variant.
    pub(super) fn present_side(run: &Simulation) -> Option<(usize, PerturbedSide)> {
        let (parameter, is_plus) = ParameterSet::side_of_variant(present()?.variant)?;
        run.parameters().next()?;
        Some((parameter, if is_plus { PerturbedSide::Plus } else { PerturbedSide::Minus }))
    }
}
