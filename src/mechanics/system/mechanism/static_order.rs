//! Order of unknowns in the matrices for small vibrations and static increments.

use super::System;
use crate::linalg::reverse_cuthill_mckee;

/// Order of the unknowns in static and modal matrices.
/// Without sliders and contact between bodies, this order equals the order of the unknowns in the time integration.
/// Otherwise, all unknowns are reordered for a small bandwidth. Positions of sliders are additional unknowns.
#[derive(Debug, Clone)]
pub struct StaticOrder {
    count: usize,
    half_bandwidth: usize,
    /// Index of each unknown in the static order; `None` if it equals the order of the unknowns in the time integration.
    position: Option<Vec<usize>>,
}

impl StaticOrder {
    /// Number of unknowns of static matrices, including slider positions.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Half-bandwidth of matrices whose unknowns have this order.
    pub fn half_bandwidth(&self) -> usize {
        self.half_bandwidth
    }

    /// Position of an unknown in this order. Supported degrees of freedom follow all unknowns.
    pub fn place(&self, unknown: usize) -> usize {
        let position = |position: &Vec<usize>| position.get(unknown).copied();
        match &self.position {
            None => unknown,
            Some(all) => position(all).unwrap_or(self.count),
        }
    }

    pub(crate) fn is_step_order(&self) -> bool {
        self.position.is_none()
    }

    pub(crate) fn to_step_order(&self, values: Vec<f64>, unknowns: usize) -> Vec<f64> {
        match &self.position {
            None => values,
            Some(all) => all[..unknowns].iter().map(|at| values[*at]).collect(),
        }
    }
}

impl System {
    pub(crate) fn static_order(&self) -> StaticOrder {
        let movements = self.unknowns.count();
        if self.sliders.is_empty() && self.sliders.blocks().is_none() {
            let half_bandwidth = self.half_bandwidth_at_rest();
            return StaticOrder { count: movements, half_bandwidth, position: None };
        }
        let count = movements + self.sliders.len();
        let mut groups: Vec<Vec<usize>> = Vec::new();
        let given = StaticOrder { count, half_bandwidth: 0, position: None };
        self.for_each_static_span(&given, &mut |degrees, _| groups.push(degrees.to_vec()));
        self.for_each_static_constraint(&given, |_| 1.0, &mut |degrees, _| {
            groups.push(degrees.to_vec())
        });
        self.inertia_entries(&mut |row, column, _| {
            if row != column {
                groups.push(vec![row, column]);
            }
        });
        groups.iter_mut().for_each(|group| group.retain(|at| *at < count));
        let order = reverse_cuthill_mckee(count, &groups);
        let half_bandwidth = order.half_bandwidth;
        StaticOrder { count, half_bandwidth, position: Some(order.position) }
    }
}
