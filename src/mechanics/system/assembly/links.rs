//! Check that the forces of rigid links and inclined rollers are unique. Redundant constraints have no unique forces.

use crate::elementary::square;
use crate::geometry::larger;
use crate::linalg::BandedMatrix;
use crate::system::{Scene, System, SystemError, UnknownKind};

/// Largest constraint force that counts as unique, for gaps of about one and unit masses.
const UNDETERMINED: f64 = 1e11;

impl System {
    /// Rejects redundant constraints of rigid links and inclined rollers.
    ///
    /// The check assigns a unit mass to every position and the rotary inertia of a unit mass at the longest arm to every rotation.
    /// It computes the constraint forces that close given gaps at all constraints.
    /// A unique constraint force is at most the gap times the square of the number of bodies in a chain. Redundant forces are much larger.
    pub(super) fn check_links(&self, scene: &Scene) -> Result<(), SystemError> {
        if self.links().forces() == 0 {
            return Ok(());
        }
        let size = self.links().largest_arm();
        let size = if size > 0.0 { size } else { 1.0 };
        let unknowns = self.unknown_movements();
        let mut matrix = BandedMatrix::zeros(unknowns.count(), unknowns.half_bandwidth());
        for (at, kind) in unknowns.kinds().iter().enumerate() {
            match kind {
                UnknownKind::Position => matrix.add(at, at, 1.0),
                UnknownKind::Rotation => matrix.add(at, at, square(size)),
                UnknownKind::Force => (),
            }
        }
        self.links().add_coupling(self.bodies(), unknowns.count(), &mut matrix);
        matrix.weigh_rows();
        // All gaps are different, so that no symmetry of a scene can make redundant constraints compatible.
        let mut forces = vec![0.0; unknowns.count()];
        let across = self.links().rollers().map(|(unknown, _)| unknown);
        let of_links = self.links().iter().flat_map(|link| link.unknowns);
        for (at, unknown) in of_links.chain(across).enumerate() {
            forces[unknown] = 1.0 + (0.618_034 * at as f64).fract();
        }
        let answer = matrix.factorise().map(|factors| factors.solve(&mut forces));
        let of =
            |unknowns: [usize; 2]| larger(forces[unknowns[0]].abs(), forces[unknowns[1]].abs());
        let worst = self.links().iter().max_by(|a, b| of(a.unknowns).total_cmp(&of(b.unknowns)));
        let is_undetermined =
            |force: f64| answer.is_err() || force.is_nan() || force >= UNDETERMINED;
        let rollers = self.links().rollers().map(|(at, roller)| (forces[at].abs(), roller.joint));
        let on_line = rollers.max_by(|a, b| a.0.total_cmp(&b.0));
        match (worst, on_line) {
            (_, Some((force, joint))) if is_undetermined(force) => {
                let joint = &scene.joints[joint];
                let (place, how) = (scene.describe(&joint.station), "held".to_owned());
                Err(SystemError::AlreadyTied { joint: joint.name.clone(), place, existing: how })
            }
            (Some(worst), _) if is_undetermined(of(worst.unknowns)) => {
                let first = scene.first_rigid_body();
                let body = scene.rigid_bodies[worst.body - first].name.clone();
                Err(SystemError::HeldTwice { body })
            }
            _ => Ok(()),
        }
    }
}
