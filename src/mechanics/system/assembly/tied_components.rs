//! Components (x, y and angle) of control points that joints tie to each other. Tied components form a class and move equally.

use crate::beams::{BodyDynamics, BodyPoint, Station};
use crate::joints::{Component, Partner, Releasable};
use crate::system::SystemError;
use crate::system::scene::{Scene, Ties};

/// Index of the class of all components that are fixed to the ground.
pub const GROUND: usize = 0;

/// Classes of components tied by joints, particles and rigid bodies. Components are numbered from one in the order of the bodies.
pub struct TiedComponents {
    pub ties: Ties,
    offsets: Vec<usize>,
    pub links: Vec<(usize, usize)>,
    pub rollers: Vec<Option<(usize, usize)>>,
    pub prescribed: Vec<usize>,
}

impl TiedComponents {
    pub fn new(
        scene: &Scene,
        released: &[Releasable],
        bodies: &[&dyn BodyDynamics],
        place: &impl Fn(&Station) -> Result<BodyPoint, SystemError>,
    ) -> Result<Self, SystemError> {
        let mut offsets = vec![GROUND + 1];
        for body in bodies {
            offsets.push(offsets[offsets.len() - 1] + 3 * body.control_points().len());
        }
        let ties = Ties::new(offsets[bodies.len()]);
        let mut classes =
            Self { ties, offsets, links: Vec::new(), rollers: Vec::new(), prescribed: Vec::new() };
        classes.tie_particles(scene);
        classes.tie_rigid_bodies(scene);
        let holds = |hold: Releasable| !released.contains(&hold);
        let joints = scene.joints.iter().enumerate();
        for (at, joint) in joints {
            if !holds(Releasable::Joint(at)) {
                classes.rollers.extend(joint.kind.inclined().map(|_| None));
                continue;
            }
            // Stations of joints are breaks of the mesh, so a control point lies on the axis at the joint.
            let from = place(&joint.station)?;
            let to = match &joint.partner {
                Partner::Ground => None,
                Partner::Station(other) => Some(place(other)?),
            };
            let node = (from.body, from.nearest_control_point());
            classes.rollers.extend(joint.kind.inclined().map(|_| Some(node)));
            for &component in joint.kind.components() {
                let to = to.as_ref().map_or(GROUND, |to| classes.at(to, component));
                classes.ties.unite(classes.at(&from, component), to);
            }
        }
        let drives = scene.drives.iter().enumerate();
        for (_, drive) in drives.filter(|(at, _)| holds(Releasable::Drive(*at))) {
            let place = place(&drive.station)?;
            for (component, _) in drive.motions() {
                let at = classes.at(&place, component);
                classes.prescribed.push(classes.ties.root(at));
            }
        }
        Ok(classes)
    }

    fn tie_particles(&mut self, scene: &Scene) {
        for body in scene.beams.len()..scene.first_rigid_body() {
            self.ties.unite(GROUND, self.component((body, 0), Component::Rotation));
        }
    }

    fn tie_rigid_bodies(&mut self, scene: &Scene) {
        let first = scene.first_rigid_body();
        for (body, definition) in (first..).zip(&scene.rigid_bodies) {
            for point in 1..=definition.points.len() {
                let is_off_centre = definition.links().any(|other| other == point);
                let together =
                    if is_off_centre { &[Component::Rotation][..] } else { &Component::ALL };
                for &component in together {
                    let centre = self.component((body, 0), component);
                    self.ties.unite(centre, self.component((body, point), component));
                }
            }
            self.links.extend(definition.links().map(|point| (body, point)));
        }
    }

    pub fn count(&self) -> usize {
        self.offsets[self.offsets.len() - 1]
    }

    pub fn component(&self, (body, point): (usize, usize), component: Component) -> usize {
        self.offsets[body] + 3 * point + component as usize
    }

    fn at(&self, place: &BodyPoint, component: Component) -> usize {
        self.component((place.body, place.nearest_control_point()), component)
    }
}
