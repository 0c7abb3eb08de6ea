//! Assembly of a model from a scene: meshes with nodes at joints, numbering, elements, sliders and start velocities.

mod assemble;
mod contact_blocks;
mod held_bodies;
mod initial_numbering;
mod links;
mod numbering;
mod redundancy;
mod release;
mod sliders;
mod start_rates;
mod tied_components;

use assemble::Assembly;
use numbering::Numbering;
