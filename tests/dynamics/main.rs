//! Dynamics: steps of all methods, invariants, orders of convergence, work counts, reproducibility, archives and rewinding.

#[path = "../common/mod.rs"]
mod common;

mod actuators;
mod adaptive;
mod archive;
mod bodies;
mod brakes;
mod composition;
mod consistency;
mod contact_friction;
mod contact_robustness;
mod contacts;
mod cores;
mod damping;
mod damping_laws;
mod drag;
mod drives;
mod going_back;
mod invariants;
mod kinked_laws;
mod law_ranges;
mod literature;
mod mean_forces;
mod meshes;
mod notes;
mod obstacle_friction;
mod obstacles;
mod orders;
mod releases;
mod rigid_links;
mod rollers;
mod same_bits;
mod saving;
mod schedules;
mod sensitivities;
mod sensors;
mod small_ways;
mod springs;
mod struck;
mod tapers;
mod units;
mod unresolved_damping;
mod unused_features;
mod work_counts;
