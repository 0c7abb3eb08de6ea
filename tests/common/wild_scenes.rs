//! Random scenes with bouncing sliders, including extreme parameters, from a seed.

use std::f64::consts::PI;

use super::scenes::{add_beam, end_of, line};
use super::sliding::{particle, slider};
use super::{Random, at};
use withy::beams::{Mesh, Section, Station};
use withy::geometry::{Curve, Vec2, perpendicular};
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner, Slider, SlidingRule, StartVelocities};
use withy::system::{Scene, StartMotion, StationVelocity};

/// Kind of extreme parameters of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Temper {
    Tame,
    Wild,
    Soft,
    Stiff,
    Curved,
    Chain,
}

impl Temper {
    pub const ALL: [Self; 6] =
        [Self::Tame, Self::Wild, Self::Soft, Self::Stiff, Self::Curved, Self::Chain];

    /// Temper of the scene of a seed, in cyclic order.
    pub fn of(seed: u64) -> Self {
        Self::ALL[(seed % Self::ALL.len() as u64) as usize]
    }

    /// Range of the axial stiffness, as decimal exponents.
    fn stiffness(self) -> (f64, f64) {
        match self {
            Self::Tame | Self::Curved => (3.0, 5.0),
            Self::Wild => (2.0, 8.0),
            Self::Soft => (1.0, 2.5),
            Self::Stiff => (6.0, 10.0),
            Self::Chain => (3.0, 7.0),
        }
    }

    /// Typical speed of the motion [length/time].
    fn pace(self) -> f64 {
        match self {
            Self::Tame | Self::Stiff | Self::Curved => 2.0,
            Self::Wild => 10.0,
            Self::Soft | Self::Chain => 1.0,
        }
    }
}

struct Draw(Random);

impl Draw {
    fn between(&mut self, (low, high): (f64, f64)) -> f64 {
        low + (high - low) * 0.5 * (self.0.next() + 1.0)
    }

    fn power(&mut self, exponents: (f64, f64)) -> f64 {
        10.0_f64.powf(self.between(exponents))
    }

    fn below(&mut self, count: usize) -> usize {
        (self.between((0.0, count as f64)) as usize).min(count - 1)
    }

    fn vector(&mut self, size: f64) -> Vec2 {
        at(self.0.next(), self.0.next()) * size
    }

    fn mesh(&mut self) -> Mesh {
        let spans = 2 + self.below(9);
        match self.below(6) {
            0 => Mesh::lagrange(spans, 2).unwrap(),
            1 => Mesh::bspline(spans, 3, 1).unwrap(),
            2 => Mesh::bspline(spans, 4, 3).unwrap(),
            _ => Mesh::bspline(spans, 3, 2).unwrap(),
        }
    }

    fn section(&mut self, temper: Temper) -> Section {
        let axial = self.power(temper.stiffness());
        Section {
            axial_stiffness: axial,
            shear_stiffness: axial / self.between((2.0, 4.0)),
            bending_stiffness: axial * self.power((-4.0, -1.0)),
            mass_per_length: self.power((-1.0, 0.5)),
            rotary_inertia: self.power((-4.0, -1.5)),
        }
    }
}

/// Scene of a seed and its integration method.
pub fn scene(seed: u64) -> (Scene, Method) {
    let (temper, mut draw) = (Temper::of(seed), Draw(Random(seed)));
    let mut scene = Scene::new(format!("{temper:?} {seed}"));
    match temper {
        Temper::Chain => chain(&mut scene, &mut draw),
        _ => rail(&mut scene, temper, &mut draw),
    }
    let beads = 1 + draw.below(if temper == Temper::Wild { 4 } else { 2 });
    for _ in 0..beads {
        let master = draw.below(scene.beams.len());
        bead(&mut scene, master, temper, &mut draw);
    }
    if draw.below(2) == 0 {
        scene.gravity = at(0.0, -9.81);
    }
    let method = match draw.below(8) {
        0 => Method::FourthOrder,
        1 => Method::EnergyDecaying { chi: 0.1 },
        _ => Method::EnergyMomentum,
    };
    (scene, method)
}

/// Adds a translating and rotating beam, supported or free.
fn rail(scene: &mut Scene, temper: Temper, draw: &mut Draw) {
    let from = draw.vector(1.0);
    let axis = match temper {
        Temper::Curved => {
            let begin = draw.between((0.0, 2.0 * PI));
            let angle = draw.between((0.3, 1.5 * PI));
            Curve::arc(from, draw.between((0.5, 2.0)), begin, begin + angle).unwrap()
        }
        _ => line(from, from + Vec2::new(1.0, 0.0) + draw.vector(0.9)),
    };
    let start = axis.point(axis.domain().0).unwrap();
    let (mesh, section) = (draw.mesh(), draw.section(temper));
    let beam = add_beam(scene, axis, &mesh, section);
    let spin = temper.pace() * draw.0.next();
    let mut motion = StartMotion { velocity: Vec2::zeros(), spin, centre: Some(start) };
    let held = draw.below(4);
    let begin = scene.station(beam, 0.0).unwrap();
    match held {
        0 => motion.velocity = draw.vector(temper.pace()),
        1 => scene.join(JointKind::Hinge, begin, Partner::Ground).unwrap(),
        _ => {
            motion.spin = 0.0;
            scene.join(JointKind::Rigid, begin, Partner::Ground).unwrap();
            if held == 3 {
                let end = end_of(scene, beam);
                scene.join(JointKind::Rigid, end, Partner::Ground).unwrap();
            }
        }
    }
    scene.beams[beam].motion = motion;
}

/// Adds links, each of which hangs in a ring on the previous link or slides along it with its end.
fn chain(scene: &mut Scene, draw: &mut Draw) {
    let links = 2 + draw.below(4);
    for link in 0..links {
        let up = if link % 2 == 0 { 0.5 } else { -0.5 };
        let from = at(0.8 * link as f64, if up > 0.0 { 0.0 } else { 0.5 });
        let (mesh, section) = (draw.mesh(), draw.section(Temper::Chain));
        add_beam(scene, line(from, from + at(1.0, up)), &mesh, section);
    }
    let start = scene.station(0, 0.0).unwrap();
    scene.join(JointKind::Hinge, start, Partner::Ground).unwrap();
    for link in 1..links {
        let place = scene.beams[link].axis.point(0.1).unwrap();
        let ring = particle(scene, place, draw.power((-2.0, 0.0)));
        for (master, along) in [(link - 1, 0.9), (link, 0.1)] {
            slide(scene, ring, master, along, draw);
        }
    }
}

fn bead(scene: &mut Scene, master: usize, temper: Temper, draw: &mut Draw) {
    let axis = &scene.beams[master].axis;
    let along = draw.between((0.05, 0.95));
    let xi = axis.parameter_at(along * axis.length()).unwrap();
    let (place, tangent) = (axis.point(xi).unwrap(), axis.derivative(xi, 1).unwrap().normalize());
    let StartMotion { velocity, spin, centre: about } = scene.beams[master].motion;
    let arm = about.map_or(Vec2::zeros(), |about| place - about);
    let mass = draw.power(if temper == Temper::Wild { (-3.0, 3.0) } else { (-2.0, 1.0) });
    let station = particle(scene, place, mass);
    let speed = temper.pace() * draw.0.next();
    let velocity = velocity + perpendicular(arm) * spin + tangent * speed;
    scene.velocities.push(StationVelocity { station, velocity, spin: None });
    slide(scene, station, master, along, draw);
}

fn slide(scene: &mut Scene, slave: Station, master: usize, along: f64, draw: &mut Draw) {
    let arc_length = along * scene.beams[master].axis.length();
    let rule = if draw.below(4) == 0 { SlidingRule::Kinked } else { SlidingRule::Conserving };
    let ends = if draw.below(8) == 0 { EndAction::Release } else { EndAction::Bounce };
    let velocities = StartVelocities::Project;
    let name = scene.free_name("slider");
    let slider = Slider { name, ends, velocities, ..slider(slave, master, arc_length, rule) };
    scene.add_slider(slider).unwrap();
}
