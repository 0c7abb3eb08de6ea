//! Indices of the unknowns of a slider, and the addition of its contact forces to residual and tangent.

use crate::geometry::Vec2;
use crate::joints::{CONTACT_UNKNOWNS, Contact, Equation, Unit};
use crate::linalg::{Border, BorderUnit};
use crate::system::bodies::Body;

#[derive(Debug, Clone, Copy)]
pub struct Connection {
    pub master: usize,
    /// Index of the slave body, and index of the control point of the slave.
    pub slave: (usize, usize),
    pub index: usize,
}

impl Connection {
    pub fn places(&self) -> std::ops::Range<usize> {
        let first = CONTACT_UNKNOWNS * self.index;
        first..first + CONTACT_UNKNOWNS
    }

    pub fn add_forces(
        &self,
        bodies: &[Body],
        on_slave: Vec2,
        first: usize,
        on_master: impl Iterator<Item = Vec2>,
        out: &mut [f64],
    ) {
        let (body, point) = self.slave;
        let mut add = |[x, y, _]: [usize; 3], force: Vec2| {
            out[x] += force.x;
            out[y] += force.y;
        };
        add(bodies[body].degrees_of_freedom[point], on_slave);
        let of_master = &bodies[self.master].degrees_of_freedom[first..];
        of_master.iter().zip(on_master).for_each(|(at, force)| add(*at, force));
    }

    pub fn add_values(
        &self,
        bodies: &[Body],
        contact: &Contact<'_>,
        master_forces: impl Iterator<Item = Vec2>,
        values: [f64; CONTACT_UNKNOWNS],
        movements: usize,
        out: &mut [f64],
    ) {
        let on_master = master_forces.map(|force| -force);
        self.add_forces(bodies, contact.unknowns.force, contact.first(), on_master, out);
        let rows = &mut out[movements..][self.places()];
        rows.iter_mut().zip(values).for_each(|(row, value)| *row += value);
    }

    pub fn add_derivatives(
        &self,
        bodies: &[Body],
        contact: &Contact<'_>,
        master_force_slopes: impl Iterator<Item = (f64, f64, Vec2)>,
        equations: &[Equation; CONTACT_UNKNOWNS],
        movements: usize,
        border: &mut Border,
    ) {
        let first = CONTACT_UNKNOWNS * self.index;
        for (row, equation) in self.places().zip(equations) {
            let of_row = match equation.unit {
                Unit::Length => BorderUnit::Length(1.0),
                Unit::Force => BorderUnit::Force,
            };
            let is_way = row + 1 == first + CONTACT_UNKNOWNS;
            let unknown =
                if is_way { BorderUnit::Length(contact.length) } else { BorderUnit::Force };
            border.set_units(row, of_row, unknown);
            for (unknown, slope) in self.places().zip(equation.by_unknowns.to_array()) {
                border.add_to_corner(row, unknown, slope);
            }
        }
        let mut add = |[x, y, _]: [usize; 3],
                       forces: [[f64; CONTACT_UNKNOWNS]; 2],
                       by: [Vec2; CONTACT_UNKNOWNS]| {
            let [along_x, along_y] = forces;
            if x < movements {
                border.add_couplings(x, first, &along_x, &by.map(|slope| slope.x));
            }
            if y < movements {
                border.add_couplings(y, first, &along_y, &by.map(|slope| slope.y));
            }
        };
        let (body, point) = self.slave;
        let of_slave = [[1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0, 0.0]];
        let by_slave = std::array::from_fn(|row| equations[row].by_slave);
        add(bodies[body].degrees_of_freedom[point], of_slave, by_slave);
        let of_master = bodies[self.master].degrees_of_freedom[contact.first()..].iter();
        let slopes = master_force_slopes.zip(contact.weights());
        for (degrees, ((by_force, by_couple, by_way), weights)) in of_master.zip(slopes) {
            let forces = [
                [-by_force, 0.0, -by_couple, 0.0, -by_way.x],
                [0.0, -by_force, 0.0, -by_couple, -by_way.y],
            ];
            add(*degrees, forces, std::array::from_fn(|row| equations[row].by_master(weights)));
        }
    }
}
