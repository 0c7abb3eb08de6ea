//! The numbers of the unknowns that are left where movements are tied to each other or to the ground.

use super::initial_numbering::InitialNumbering;
use super::tied_components::{GROUND, TiedComponents};
use crate::beams::{BodyDynamics, Place, Station};
use crate::joints::Component;
use crate::linalg::reverse_cuthill_mckee;
use crate::model::ModelError;
use crate::model::elements::{PrescribedMovement, PrescribedMovements, Support, Supports};
use crate::model::motion::{UnknownKind, Unknowns};
use crate::model::scene::Scene;

/// Where a rigid link is: its body, the control point that it holds to the first one, and the unknowns of its force.
#[derive(Debug, Clone, Copy)]
pub struct LinkPlace {
    pub body: usize,
    pub point: usize,
    pub force: [usize; 2],
}

/// The degree of freedom of every component of every control point of every body: the unknowns come first,
/// the supported ones last.
#[derive(Debug, Clone)]
pub struct Numbering {
    pub degrees_of_freedom: Vec<Vec<[usize; 3]>>,
    /// The two unknowns of the force of each rigid link, among those of the movements that it couples.
    pub links: Vec<LinkPlace>,
    pub unknowns: usize,
    /// Of the supported ones, those that are prescribed stand first.
    prescribed: usize,
    supported: usize,
    half_bandwidth: usize,
}

impl Numbering {
    /// Numbers the movements of bodies; `place` finds the stations of joints on their meshes. Constraints with `border`
    /// unknowns stand between the unknown and the supported movements.
    pub fn new(
        scene: &Scene,
        bodies: &[Box<dyn BodyDynamics>],
        border: usize,
        place: impl Fn(&Station) -> Result<Place, ModelError>,
    ) -> Result<Self, ModelError> {
        let mut tied = TiedComponents::new(scene, bodies, &place)?;
        let initial = InitialNumbering::new(scene, &mut tied)?;
        let groups = initial.coupled(scene, bodies, &mut tied, &place)?;
        let ordering = reverse_cuthill_mckee(initial.unknowns, &groups);
        let unknowns = initial.unknowns;

        let links = initial.forces.iter().zip(&tied.links).map(|(force, &(body, point))| {
            LinkPlace { body, point, force: force.map(|at| ordering.position[at]) }
        });
        let links = links.collect();
        let prescribed = tied.prescribed.len();
        let mut supported = prescribed;
        let mut degree_of_freedom = |tied: &mut TiedComponents, at: usize| match tied.ties.root(at)
        {
            GROUND => {
                supported += 1;
                unknowns + border + supported - 1
            }
            root => match tied.prescribed.iter().position(|other| *other == root) {
                Some(movement) => unknowns + border + movement,
                None => ordering.position[initial.number[root]],
            },
        };
        let mut degrees_of_freedom = Vec::with_capacity(bodies.len());
        for (index, body) in bodies.iter().enumerate() {
            let points = (0..body.control_points().len()).map(|point| {
                let first = tied.component((index, point), Component::X);
                [0, 1, 2].map(|component| degree_of_freedom(&mut tied, first + component))
            });
            degrees_of_freedom.push(points.collect());
        }
        let half_bandwidth = ordering.half_bandwidth;
        Ok(Self { degrees_of_freedom, links, unknowns, prescribed, supported, half_bandwidth })
    }

    /// The supports in the order of their degrees of freedom, the rates at which those begin that are prescribed, and the unknowns; constraints with `border`
    /// unknowns stand between.
    pub fn supports_and_unknowns(
        &self,
        scene: &Scene,
        border: usize,
    ) -> Result<(Supports, Vec<f64>, Unknowns), ModelError> {
        let mut kinds = vec![UnknownKind::Position; self.unknowns];
        let mut supports =
            vec![Support { body: 0, point: 0, component: Component::X }; self.supported];
        for (body, points) in self.degrees_of_freedom.iter().enumerate() {
            for (point, degrees) in points.iter().enumerate() {
                for (component, &at) in Component::ALL.into_iter().zip(degrees) {
                    match at.checked_sub(self.unknowns + border) {
                        Some(support) => supports[support] = Support { body, point, component },
                        None if component == Component::Rotation => {
                            kinds[at] = UnknownKind::Rotation;
                        }
                        None => (),
                    }
                }
            }
        }
        for at in self.links.iter().flat_map(|link| link.force) {
            kinds[at] = UnknownKind::Force;
        }
        let held = supports.split_off(self.prescribed);
        let motions = scene.drives.iter().enumerate();
        let motions = motions.flat_map(|(drive, of)| of.motions().map(move |(_, at)| (drive, at)));
        let movements = supports.into_iter().zip(motions).map(|(support, (drive, motion))| {
            PrescribedMovement { support, drive, motion: motion.clone() }
        });
        let drives = scene.drives.iter().map(|drive| drive.name.clone());
        let (movements, rates) =
            PrescribedMovements::new(movements.collect(), drives, self.unknowns, border)
                .map_err(|(drive, source)| ModelError::DriveValue { drive, source })?;
        let unknowns = Unknowns::new(kinds, self.half_bandwidth);
        Ok((Supports::new(movements, held), rates, unknowns))
    }
}
