//! Impacts of drives on beams that are at rest at the start of a simulation.

use super::System;
use crate::joints::Component;

/// Drive with a nonzero initial rate that acts on a beam whose other points are initially at rest.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StartImpact {
    /// Index of the drive.
    pub drive: usize,
    /// Index of the beam.
    pub beam: usize,
    /// Component of the motion that the drive prescribes.
    pub component: Component,
    /// Initial rate of the drive [length/time, 1/time].
    pub rate: f64,
}

impl System {
    /// Impacts of drives on beams at rest in the present state. Velocities up to `negligible` count as zero [length/time].
    pub(crate) fn start_impacts(&self, negligible: f64) -> Vec<StartImpact> {
        let rates = &self.motion.rates;
        let unknowns = self.unknowns.count();
        let rate_of = |degree: usize| rates.get(degree).copied().unwrap_or(0.0);
        let mut impacts = Vec::new();
        for (beam, body) in self.bodies.iter().enumerate().take(self.bodies.meshes().len()) {
            let degrees = body.degrees_of_freedom.as_flattened();
            let free = || degrees.iter().filter(|degree| **degree < unknowns);
            if free().next().is_none() || free().any(|degree| rate_of(*degree) != 0.0) {
                continue;
            }
            let length: f64 = body.dynamics.lumped_lengths().iter().sum();
            let driven = self.supports.prescribed().numbered();
            for (support, drive, at) in driven.filter(|(.., at)| degrees.contains(at)) {
                let (component, rate) = (support.component, rate_of(at));
                let arm = if component == Component::Rotation { length } else { 1.0 };
                if arm * rate.abs() > negligible {
                    impacts.push(StartImpact { drive, beam, component, rate });
                }
            }
        }
        impacts
    }
}
