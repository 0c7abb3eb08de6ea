//! Sliding joints: laws, ends, invariants and orders of convergence.

#[path = "../common/mod.rs"]
mod common;

mod blows;
mod consistency;
mod ends;
mod forces;
mod friction;
mod impact_energy;
mod impact_law;
mod invariants;
mod kink_starts;
mod kinks;
mod long_ways;
mod many;
mod moving_mass;
mod one_impact;
mod orders;
mod relaxed;
mod sleeves;
mod stick_slip;
mod together;
mod tracks;
mod unilateral;

mod wild;
