//! Sleeve without length: rotations of the master since the start, and compliance of the master at the sleeve.

use std::sync::Arc;

use super::missed_compliance::MissedCompliance;
use crate::beams::{BeamError, Mesh, RotationIncrement, Section, StraightBeam, unresolved_kink};
use crate::geometry::{ContactPath, PiecewisePolynomial, Span, Vec2, cross, unit};
use crate::joints::{MasterAtSleeve, SleeveRotations};

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
    /// Type of the rotation increments of the present step.
    rotations: RotationIncrement,
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
        let (turned, rotations) = (vec![0.0; path.basis().functions()], RotationIncrement::Angle);
        Self { master, start, direction, turned, own: 0.0, rotations }
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

    /// Selects the type of the rotation increments of the next step. A static solution has increments of angles.
    pub fn begin_step(&mut self, rotations: RotationIncrement) {
        self.rotations = rotations;
    }

    /// Rotations of sleeve and master in a step.
    /// The arguments are rotation increments: of the control points on the path, and of the sleeve [rad].
    pub fn in_step(
        &self,
        path: &ContactPath,
        turned: impl Iterator<Item = f64>,
        slave: f64,
    ) -> SleeveRotations {
        let drawn = path.along(&self.master.angle);
        let at_end = path.end().iter().zip(path.slope());
        let along = path.difference().iter().zip(path.change());
        let (mut master, mut increment_slope) = ([0.0; 2], [0.0; 2]);
        let mut angle_slope = [drawn.difference, drawn.change];
        let before = &self.turned[path.first()..];
        for (((at_end, along), turned), before) in at_end.zip(along).zip(turned).zip(before) {
            let add = |sum: &mut [f64; 2], (value, change): (&f64, &f64), by: f64| {
                *sum = [sum[0] + value * by, sum[1] + change * by];
            };
            add(&mut master, at_end, turned);
            add(&mut increment_slope, along, turned);
            add(&mut angle_slope, along, *before);
        }
        let tangent_factor = self.rotations.tangent_factor();
        SleeveRotations { tangent_factor, slave, master, increment_slope, angle_slope }
    }

    /// Adds rotation increments of all control points of the master, and of the sleeve [rad].
    pub fn rotate(&mut self, turned: impl Iterator<Item = f64>, own: f64) {
        let rotations = self.rotations;
        let sums = self.turned.iter_mut().zip(turned);
        sums.for_each(|(sum, more)| *sum += rotations.angle(more));
        self.own += rotations.angle(own);
    }

    /// First and second derivative of the angle of the master with respect to its parameter, at the end of a path of zero length [rad].
    pub fn slopes(&self, path: &ContactPath) -> [f64; 2] {
        self.master_at_sleeve(path, std::iter::repeat(0.0), 0.0).slopes
    }

    /// Angle of the sleeve minus that of the master, relative to the initial difference, at the end of a path of zero length [rad].
    /// The angle of the master is interpolated from the rotations of its control points.
    pub fn gap(&self, path: &ContactPath) -> f64 {
        self.master_at_sleeve(path, std::iter::repeat(0.0), 0.0).gap
    }

    /// Removes the compliance of the master that its mesh does not represent.
    pub fn neglect_compliance(&mut self) {
        if self.is_compliant() {
            let angle = self.master.angle.clone();
            self.master = Arc::new(SleevedMaster { angle, compliance: None });
        }
    }

    pub fn numbers(&self) -> impl Iterator<Item = f64> + '_ {
        std::iter::once(self.own).chain(self.turned.iter().copied())
    }

    pub fn restore(&mut self, next: &mut dyn FnMut() -> f64) {
        self.own = next();
        self.turned.iter_mut().for_each(|turned| *turned = next());
    }
}
