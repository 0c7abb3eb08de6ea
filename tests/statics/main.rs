//! Statics: equilibria, load paths, and vibrations about equilibria.

#[path = "../common/mod.rs"]
mod common;

mod bodies;
mod buckling;
mod damped_modes;
mod elastica;
mod equilibria;
mod modes;
mod obstacles;
mod section_forces;
mod sleeves;
mod sliders;
mod springs;
mod stiff_modes;
mod tapers;
