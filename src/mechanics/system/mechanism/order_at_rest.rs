//! Where unknowns stand in the matrices of small movements.

use super::System;
use crate::linalg::reverse_cuthill_mckee;

/// The order of the unknowns of small movements in their matrices: that of steps, unless something slides. Then the places of sliders on their masters are
/// unknowns too, behind the movements, and all stand so that the band is narrow.
#[derive(Debug, Clone)]
pub struct OrderAtRest {
    count: usize,
    half_bandwidth: usize,
    /// Where each unknown stands, if not in its place.
    position: Option<Vec<usize>>,
}

impl OrderAtRest {
    /// The number of unknowns of small movements.
    pub fn count(&self) -> usize {
        self.count
    }

    /// How far from the diagonal matrices have entries in this order.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Where an unknown stands; what is supported stands behind all.
    pub fn place(&self, unknown: usize) -> usize {
        let position = |position: &Vec<usize>| position.get(unknown).copied();
        match &self.position {
            None => unknown,
            Some(all) => position(all).unwrap_or(self.count),
        }
    }

    /// Whether unknowns stand in their places.
    pub fn is_given(&self) -> bool {
        self.position.is_none()
    }

    /// Values of so many unknowns in their own order, from values in this one.
    pub fn in_own_order(&self, values: Vec<f64>, unknowns: usize) -> Vec<f64> {
        match &self.position {
            None => values,
            Some(all) => all[..unknowns].iter().map(|at| values[*at]).collect(),
        }
    }
}

impl System {
    /// The order of the unknowns of small movements about the present configuration.
    pub fn order_at_rest(&self) -> OrderAtRest {
        let movements = self.unknowns.count();
        if self.sliders.is_empty() {
            let half_bandwidth = self.half_bandwidth_at_rest();
            return OrderAtRest { count: movements, half_bandwidth, position: None };
        }
        let count = movements + self.sliders.len();
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let given = OrderAtRest { count, half_bandwidth: 0, position: None };
        self.each_span_at_rest(&given, &mut |degrees, _| groups.push(degrees.to_vec()));
        self.each_tie_at_rest(&given, |_| 1.0, &mut |degrees, _| groups.push(degrees.to_vec()));
        self.inertia_entries(&mut |row, column, _| {
            if row != column {
                groups.push(vec![row, column]);
            }
        });
        groups.iter_mut().for_each(|group| group.retain(|at| *at < count));
        let order = reverse_cuthill_mckee(count, &groups);
        let half_bandwidth = order.half_bandwidth;
        OrderAtRest { count, half_bandwidth, position: Some(order.position) }
    }
}
