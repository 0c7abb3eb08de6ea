//! Expected order of convergence of a scene in the mesh (docs/theory.md, sections 5 and 10).

use super::Scene;
use super::mesh_choice::concentrated;
use crate::beams::Station;
use crate::joints::{Partner, SlidingRule};
use crate::system::elements::Element;

/// Order of convergence of positions if a force acts between the ends of a beam: the shear strain jumps at the force.
const FIRST: f64 = 1.0;

/// Order of convergence of positions with sliders whose law represents the kink (jump of the tangent of the axis under the slider).
const THIRD: f64 = 3.0;

impl Scene {
    /// Expected order of convergence of positions with respect to the span length, for smooth loads.
    ///
    /// Positions on meshes of degree `p` have the order `p + 1` if `p` is odd and `p` if it is even.
    /// The order is lower with forces that act between the ends of a beam: of sliders, contacts, joints and concentrated loads.
    pub fn mesh_order(&self) -> f64 {
        let degrees = self.beams.iter().map(|beam| beam.mesh.basis().degree());
        let smooth = degrees.min().map_or(FIRST, |degree| 2.0 * degree.div_ceil(2) as f64);
        let is_inside = |station: &Station| {
            let length = station.beam().map(|beam| self.beams[beam].axis.length());
            length.is_some_and(|length| station.arc_length > 0.0 && station.arc_length < length)
        };
        let of_joints = self.joints.iter().flat_map(|joint| match joint.partner {
            Partner::Ground => vec![joint.station],
            Partner::Station(other) => vec![joint.station, other],
        });
        let of_sliders = self.sliders.iter().map(|slider| slider.slave);
        let of_elements = self.elements.iter().flat_map(concentrated);
        let has_contacts = self
            .elements
            .iter()
            .any(|element| matches!(element, Element::Obstacle(_) | Element::Contact(_)));
        let is_kinked = self.sliders.iter().all(|slider| slider.rule == SlidingRule::Kinked);
        if has_contacts
            || !is_kinked
            || of_joints.chain(of_sliders).chain(of_elements).any(|at| is_inside(&at))
        {
            return FIRST;
        }
        if self.sliders.is_empty() { smooth } else { smooth.min(THIRD) }
    }
}
