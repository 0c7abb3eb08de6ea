//! Sleeve without length: rotations of the master since the start, and compliance of the master at the sleeve.

use std::sync::Arc;

use super::missed_compliance::MissedCompliance;
use crate::beams::{BeamError, Mesh, Section, StraightBeam, unresolved_kink};
use crate::geometry::{ContactPath, PiecewisePolynomial, Span, Vec2, cross, unit};
use crate::joints::MasterAtSleeve;

/// Number of points per span, minus the degree of the mesh, at which the curvature of the undeformed axis is interpolated.
const MORE_POINTS: usize = 4;

/// Undeformed angle of a master, and the compliance that its mesh does not represent.
#[derive(Debug)]
pub struct SleevedMaster {
    /// Angle of the undeformed axis relative to its start [rad].
    angle: PiecewisePolynomial,
    /// Missed compliance in bending and shear, kink length (length over which the mesh spreads the jump of a strain at a point force),
    /// and axial stiffness. `None` if the mesh has too few quadrature points.
    compliance: Option<(MissedCompliance, PiecewisePolynomial, f64)>,
}

/// Sleeve without length on a master.
#[derive(Debug, Clone)]
pub struct Sleeve {
    master: Arc<SleevedMaster>,
    /// Angle of the undeformed master at the initial position of the sleeve [rad].
    start: f64,
    /// Direction of the sleeve at the start [rad].
    direction: f64,
    /// Rotations of the control points of the master since the start [rad].
    turned: Vec<f64>,
    /// Rotation of the sleeve since the start [rad].
    own: f64,
}

impl SleevedMaster {
    pub fn new(mesh: &Mesh, control_points: &[Vec2], section: &Section) -> Result<Self, BeamError> {
        let basis = mesh.basis();
        let curvature = |span: &Span, xi: f64| {
            let values = basis.evaluate_in(span, xi);
            let [tangent, bend] = [1, 2].map(|order| values.combine(order, control_points));
            cross(tangent, bend) / tangent.norm_squared()
        };
        let points = basis.degree() + MORE_POINTS;
        let kink = unresolved_kink(mesh, control_points)?;
        let bending = MissedCompliance::of(&StraightBeam::new(mesh, control_points, section))?;
        let compliance = bending
            .zip(kink)
            .map(|(bending, kink)| (bending, kink.length, section.axial_stiffness));
        let angle = PiecewisePolynomial::integral(&basis.spans(), points, curvature);
        Ok(Self { angle, compliance })
    }
}

impl Sleeve {
    /// Creates a sleeve at the end of a path of zero length, with the angle of the undeformed axis there [rad].
    pub fn new(master: Arc<SleevedMaster>, path: &ContactPath, direction: f64) -> Self {
        let [start, ..] = path.at_end(&master.angle);
        Self { start, direction, turned: vec![0.0; path.basis().functions()], own: 0.0, master }
    }

    /// Angle and compliance of the master at the end of a path of zero length.
    /// The arguments are rotations since the last equilibrium: of the control points on the path, and of the sleeve [rad].
    pub fn master_at_sleeve(
        &self,
        path: &ContactPath,
        turned: impl Iterator<Item = f64>,
        own: f64,
    ) -> MasterAtSleeve {
        let [drawn, by_drawn, bend_of_drawn] = path.at_end(&self.master.angle);
        let weights = path.end().iter().zip(path.slope()).zip(path.change());
        let turned = self.turned[path.first()..].iter().zip(turned);
        let [angle, slope, half_bend] = weights.zip(turned).fold(
            [0.0; 3],
            |[angle, slope, half_bend], (((value, by), change), (before, more))| {
                let turned = before + more;
                [angle + value * turned, slope + by * turned, half_bend + change * turned]
            },
        );
        let own = self.own + own;
        let rigid = MasterAtSleeve {
            gap: own - angle - (drawn - self.start),
            slopes: [slope + by_drawn, 2.0 * half_bend + bend_of_drawn],
            along: unit(self.direction + own),
            ..MasterAtSleeve::default()
        };
        let Some((bending, kink, axial_stiffness)) = &self.master.compliance else { return rigid };
        MasterAtSleeve {
            transverse: path.at_end(&bending.transverse),
            coupling: path.at_end(&bending.coupling),
            rotation: path.at_end(&bending.rotation),
            axial: path.at_end(kink).map(|length| length / axial_stiffness),
            ..rigid
        }
    }

    pub fn is_compliant(&self) -> bool {
        self.master.compliance.is_some()
    }

    /// Adds rotations of all control points of the master, and of the sleeve [rad].
    pub fn turn(&mut self, turned: impl Iterator<Item = f64>, own: f64) {
        self.turned.iter_mut().zip(turned).for_each(|(sum, more)| *sum += more);
        self.own += own;
    }

    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        std::iter::once(self.own).chain(self.turned.iter().copied())
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.own = next();
        self.turned.iter_mut().for_each(|turned| *turned = next());
    }
}
