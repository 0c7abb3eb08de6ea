//! Numbering of the degrees of freedom, some of which are tied to each other or to the ground.

use super::initial_numbering::InitialNumbering;
use super::tied_components::{GROUND, TiedComponents};
use crate::beams::{BodyDynamics, BodyPoint, Station};
use crate::joints::{Component, Releasable};
use crate::linalg::reverse_cuthill_mckee;
use crate::system::SystemError;
use crate::system::elements::{PrescribedMovement, Support};
use crate::system::scene::Scene;
use crate::system::state::{UnknownKind, Unknowns};

#[derive(Debug, Clone, Copy)]
pub struct LinkPlace {
    pub body: usize,
    pub point: usize,
    pub force: [usize; 2],
}

/// Number of every degree of freedom: of each component (x, y, angle) of each control point.
/// The order of the numbers is: unknowns, contact unknowns, prescribed degrees of freedom, fixed degrees of freedom.
#[derive(Debug, Clone)]
pub struct Numbering {
    pub degrees_of_freedom: Vec<Vec<[usize; 3]>>,
    pub links: Vec<LinkPlace>,
    /// Force unknown, body and control point of each inclined roller; `None` for a released roller.
    pub rollers: Vec<Option<(usize, (usize, usize))>>,
    pub unknowns: usize,
    pub groups: Vec<Vec<usize>>,
    /// Number of prescribed degrees of freedom.
    prescribed: usize,
    supported: usize,
    half_bandwidth: usize,
}

impl Numbering {
    /// Numbers the degrees of freedom of bodies. `place` locates stations on the meshes.
    /// The `border` contact unknowns are numbered between the unknowns and the supported degrees of freedom.
    /// Joints and drives in the list `released` have no effect.
    pub fn new(
        scene: &Scene,
        released: &[Releasable],
        bodies: &[&dyn BodyDynamics],
        border: usize,
        place: impl Fn(&Station) -> Result<BodyPoint, SystemError>,
    ) -> Result<Self, SystemError> {
        let mut tied = TiedComponents::new(scene, released, bodies, &place)?;
        let initial = InitialNumbering::new(scene, &mut tied)?;
        let mut groups = initial.coupled(scene, bodies, &mut tied, &place)?;
        let ordering = reverse_cuthill_mckee(initial.unknowns, &groups);
        let unknowns = initial.unknowns;

        let links = initial.forces.iter().zip(&tied.links).map(|(force, &(body, point))| {
            LinkPlace { body, point, force: force.map(|at| ordering.position[at]) }
        });
        let links = links.collect();
        let rollers = initial.roller_forces.iter().zip(&tied.rollers);
        let rollers = rollers.map(|(force, node)| Some((ordering.position[(*force)?], (*node)?)));
        let rollers = rollers.collect();
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
        // Elements at a point, such as drag, couple the components of the point.
        // These couplings are added after the ordering and affect only the block-wise elimination of contacts.
        for (index, body) in bodies.iter().enumerate().filter(|(_, body)| body.order() == 1) {
            for point in 0..body.control_points().len() {
                groups.push(initial.numbers([(index, point)].into_iter(), &mut tied));
            }
        }
        for member in groups.iter_mut().flatten() {
            *member = ordering.position[*member];
        }
        Ok(Self {
            degrees_of_freedom,
            links,
            rollers,
            unknowns,
            groups,
            prescribed,
            supported,
            half_bandwidth: ordering.half_bandwidth,
        })
    }

    pub fn supports_and_unknowns(
        &self,
        scene: &Scene,
        released: &[Releasable],
        border: usize,
    ) -> (Vec<PrescribedMovement>, Vec<Support>, Unknowns) {
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
        let across = self.rollers.iter().flatten().map(|(force, _)| *force);
        for at in self.links.iter().flat_map(|link| link.force).chain(across) {
            kinds[at] = UnknownKind::Force;
        }
        let held = supports.split_off(self.prescribed);
        let drives = scene.drives.iter().enumerate();
        let drives = drives.filter(|(drive, _)| !released.contains(&Releasable::Drive(*drive)));
        let motions = drives.flat_map(|(drive, of)| of.motions().map(move |(_, at)| (drive, at)));
        let movements = supports.into_iter().zip(motions).map(|(support, (drive, motion))| {
            PrescribedMovement { support, drive, motion: motion.clone() }
        });
        (movements.collect(), held, Unknowns::new(kinds, self.half_bandwidth, released))
    }
}
