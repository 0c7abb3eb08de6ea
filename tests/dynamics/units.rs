//! Independence of units: a scene in other units of length, mass and time takes the same steps and has the same final state.
#![allow(clippy::unwrap_used)]

use crate::common::scenes::{add_beam, line, start_of};
use crate::common::sliding::{particle, slider};
use crate::common::{Random, at, settings, wild_scenes};
use withy::beams::{Mesh, Relaxation, Section, SectionVariation, Station};
use withy::geometry::{Curve, Vec2, perpendicular};
use withy::integrators::Method;
use withy::joints::{EndAction, JointKind, Partner, Slider, SlidingRule, StartVelocities};
use withy::simulation::{NoMonitor, Simulation, WorkCounts};
use withy::system::{
    Anchor, BeamDefinition, DampingLaw, Element, Origin, ParticleDefinition, PointMass,
    RigidBodyDefinition, Scene, Spring, SpringKind, SpringLaw, StartMotion, StationVelocity,
};

/// Step of all runs in the first system of units, and number of random scenes.
const DT: f64 = 0.01;
const SEEDS: u64 = 44;

/// Factors of lengths, masses and times.
#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    mass: f64,
    time: f64,
}

impl Units {
    fn speed(self) -> f64 {
        self.length / self.time
    }

    fn force(self) -> f64 {
        self.mass * self.length / (self.time * self.time)
    }

    fn moment(self) -> f64 {
        self.force() * self.length
    }

    fn inertia(self) -> f64 {
        self.mass * self.length * self.length
    }

    fn section(self, section: &Section) -> Section {
        Section {
            axial_stiffness: self.force() * section.axial_stiffness,
            shear_stiffness: self.force() * section.shear_stiffness,
            bending_stiffness: self.moment() * self.length * section.bending_stiffness,
            mass_per_length: self.mass / self.length * section.mass_per_length,
            rotary_inertia: self.mass * self.length * section.rotary_inertia,
        }
    }

    fn curve(self, curve: &Curve) -> Curve {
        let place = |xi| curve.point(xi).unwrap();
        if !matches!(curve, Curve::Arc(_)) {
            return line(place(0.0) * self.length, place(1.0) * self.length);
        }
        let curvature = curve.curvature(0.0).unwrap();
        let tangent = curve.derivative(0.0, 1).unwrap().normalize();
        let center = place(0.0) + perpendicular(tangent) / curvature;
        let arm = place(0.0) - center;
        let (from, turn) = (arm.y.atan2(arm.x), curvature * curve.length());
        let radius = self.length / curvature.abs();
        Curve::arc(center * self.length, radius, from, from + turn).unwrap()
    }

    fn station(self, station: Station) -> Station {
        Station { arc_length: self.length * station.arc_length, ..station }
    }

    fn motion(self, motion: StartMotion) -> StartMotion {
        StartMotion {
            velocity: motion.velocity * self.speed(),
            spin: motion.spin / self.time,
            centre: motion.centre.map(|centre| centre * self.length),
        }
    }

    fn spring(self, spring: &Spring) -> Spring {
        let anchor = |anchor: &Anchor| match anchor {
            Anchor::Station(station) => Anchor::Station(self.station(*station)),
            Anchor::Ground(at) => Anchor::Ground(at * self.length),
        };
        let (kind, unit, load) = match &spring.kind {
            SpringKind::Length(anchors) => {
                let anchors = anchors.iter().map(anchor).collect();
                (SpringKind::Length(anchors), self.length, self.force())
            }
            SpringKind::Torsion(anchors) => (
                SpringKind::Torsion([anchor(&anchors[0]), anchor(&anchors[1])]),
                1.0,
                self.moment(),
            ),
            brake @ SpringKind::Brake { .. } => panic!("{brake:?}"),
        };
        let law = spring.law.as_ref().map(|law| match law {
            SpringLaw::Linear { stiffness, natural } => {
                SpringLaw::Linear { stiffness: load / unit * stiffness, natural: unit * natural }
            }
            other => panic!("{other:?}"),
        });
        let DampingLaw::Linear(damping) = spring.damping else { panic!("{:?}", spring.damping) };
        let damping = DampingLaw::Linear(load * self.time / unit * damping);
        Spring { name: spring.name.clone(), kind, law, origin: spring.origin, damping, rest: None }
    }

    /// The same scene in other units.
    fn scene(self, scene: &Scene) -> Scene {
        let mut other = Scene::new(scene.name.clone());
        for beam in &scene.beams {
            let SectionVariation::Uniform(section) = &beam.section else { panic!("{beam:?}") };
            other.beams.push(BeamDefinition {
                axis: self.curve(&beam.axis),
                section: self.section(section).into(),
                motion: self.motion(beam.motion),
                ..beam.clone()
            });
        }
        for body in &scene.rigid_bodies {
            let scaled = |(name, at): &(String, Vec2)| (name.clone(), at * self.length);
            other.rigid_bodies.push(RigidBodyDefinition {
                position: body.position * self.length,
                points: body.points.iter().map(scaled).collect(),
                outline: body.outline.iter().map(|at| at * self.length).collect(),
                motion: self.motion(body.motion),
                ..body.clone()
            });
        }
        for particle in &scene.particles {
            let position = particle.position * self.length;
            other.particles.push(ParticleDefinition { position, ..particle.clone() });
        }
        for joint in &scene.joints {
            let partner = match joint.partner {
                Partner::Ground => Partner::Ground,
                Partner::Station(station) => Partner::Station(self.station(station)),
            };
            other.join(joint.kind, self.station(joint.station), partner).unwrap();
        }
        for element in &scene.elements {
            other.elements.push(match element {
                Element::PointMass(mass) => Element::PointMass(PointMass {
                    station: self.station(mass.station),
                    mass: self.mass * mass.mass,
                    rotary_inertia: self.inertia() * mass.rotary_inertia,
                }),
                Element::Spring(spring) => Element::Spring(self.spring(spring)),
                Element::Damping(damping) => {
                    let mut damping = damping.clone();
                    let Relaxation { axial, shear, bending } = &mut damping.relaxation;
                    [axial, shear, bending].into_iter().for_each(|time| *time *= self.time);
                    Element::Damping(damping)
                }
                other => panic!("{other:?}"),
            });
        }
        for slider in &scene.sliders {
            other.sliders.push(Slider {
                slave: self.station(slider.slave),
                arc_length: self.length * slider.arc_length,
                ..slider.clone()
            });
        }
        other.stations = scene.stations.iter().map(|station| self.station(*station)).collect();
        other.velocities.extend(scene.velocities.iter().map(|motion| StationVelocity {
            station: self.station(motion.station),
            velocity: motion.velocity * self.speed(),
            spin: motion.spin.map(|spin| spin / self.time),
        }));
        other.gravity = scene.gravity * (self.speed() / self.time);
        other
    }
}

/// Results of a run in a system of units: work counts, events and final state, scaled back.
#[derive(Debug, PartialEq)]
struct Outcome {
    has_failed: bool,
    /// Steps, iterations, retries, and attempts to locate arrivals.
    counts: [usize; 4],
    arrivals: Vec<(f64, String)>,
    end: Vec<f64>,
}

impl Outcome {
    fn of(scene: &Scene, method: Method, end: f64, units: Units) -> Self {
        let (scene, dt) = (units.scene(scene), units.time * DT);
        let mut simulation = Simulation::start(scene, settings(method, dt)).unwrap();
        let ran = simulation.run_to(units.time * end, &mut NoMonitor);
        let WorkCounts { steps, newton_iterations, retries, arrival_tries, .. } =
            *simulation.counts();
        let arrivals = simulation.arrivals().iter().map(|arrival| {
            (
                arrival.time / units.time,
                format!("{} {:?} {:?}", arrival.slider, arrival.end, arrival.kind),
            )
        });
        let points = simulation.model().control_points().flatten();
        Self {
            has_failed: ran.is_err(),
            counts: [steps, newton_iterations, retries, arrival_tries],
            arrivals: arrivals.collect(),
            end: points.flat_map(|at| [at.x, at.y]).map(|x| x / units.length).collect(),
        }
    }

    /// Largest difference of the final positions, relative to the largest coordinate.
    fn off(&self, other: &Self) -> f64 {
        let size = self.end.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
        let pairs = self.end.iter().zip(&other.end);
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / size
    }
}

/// Beads that slide along a straight unloaded beam and bounce at its ends.
fn gliding(is_held: bool, damping: f64, beads: &[(f64, f64)]) -> Scene {
    let mut scene =
        Scene::new(format!("{} beads, held: {is_held}, damping {damping}", beads.len()));
    let section = Section {
        axial_stiffness: 1e4,
        shear_stiffness: 4e3,
        bending_stiffness: 20.0,
        mass_per_length: 0.5,
        rotary_inertia: 1e-3,
    };
    let mesh = Mesh::bspline(10, 3, 2).unwrap();
    let rod = add_beam(&mut scene, line(at(0.0, 0.0), at(2.0, 0.6)), &mesh, section);
    if is_held {
        let start = start_of(&mut scene, rod);
        scene.join(JointKind::Rigid, start, Partner::Ground).unwrap();
    }
    if damping > 0.0 {
        let relaxation = Relaxation { axial: damping, shear: damping, bending: damping };
        scene.add_damping(rod, relaxation).unwrap();
    }
    let along = at(2.0, 0.6).normalize();
    for &(place, speed) in beads {
        let station = particle(&mut scene, along * place, 0.7);
        let velocity = along * speed;
        scene.velocities.push(StationVelocity { station, velocity, spin: None });
        let name = scene.free_name("slider");
        let slider = slider(station, rod, place, SlidingRule::Conserving);
        scene
            .add_slider(Slider {
                name,
                ends: EndAction::Bounce,
                velocities: StartVelocities::Project,
                ..slider
            })
            .unwrap();
    }
    scene
}

#[test]
fn beads_slide_alike_in_any_unit() {
    let powers = |exponents: &[i32], units: fn(f64) -> Units| {
        exponents.iter().map(|exponent| units(10.0_f64.powi(*exponent))).collect::<Vec<_>>()
    };
    let units = [
        powers(&[-9, -5, -4, 6], |length| Units { length, mass: 1.0, time: 1.0 }),
        powers(&[-15, 10], |mass| Units { length: 1.0, mass, time: 1.0 }),
        powers(&[-6, 4], |time| Units { length: 1.0, mass: 1.0, time }),
    ]
    .concat();
    for is_held in [false, true] {
        for damping in [0.0, 1e-3, 0.1] {
            for beads in [&[(0.3, 1.0)][..], &[(0.3, 1.0), (1.4, -0.6)]] {
                let scene = gliding(is_held, damping, beads);
                let run = |units| Outcome::of(&scene, Method::EnergyMomentum, 2.0, units);
                let first = run(Units { length: 1.0, mass: 1.0, time: 1.0 });
                assert!(!first.has_failed, "{}", scene.name);
                for units in &units {
                    let other = run(*units);
                    assert_eq!(first.counts, other.counts, "{}, {units:?}", scene.name);
                    assert_eq!(first.arrivals.len(), other.arrivals.len());
                    let off = first.off(&other);
                    assert!(off < 1e-6, "{}, {units:?}: {off:e}", scene.name);
                }
            }
        }
    }
}

/// Random scene of a seed with further dimensional parameters: damped materials, springs and dampers to the ground, and rigid bodies.
fn random(seed: u64) -> (Scene, Method) {
    let (mut scene, method) = wild_scenes::scene(seed);
    let mut random = Random(seed + 1000);
    for beam in 0..scene.beams.len() {
        if random.next() < 0.0 {
            let time = 1e-3 * 10.0_f64.powf(random.next());
            scene
                .add_damping(beam, Relaxation { axial: time, shear: time, bending: 2.0 * time })
                .unwrap();
        }
    }
    if random.next() < 0.0 {
        let length = scene.beams[0].axis.length();
        let station = scene.station(0, length).unwrap();
        let place = scene.drawn_at(&station).unwrap();
        let stiffness = 10.0_f64.powf(2.0 + random.next());
        let law = SpringLaw::Linear { stiffness, natural: 0.0 };
        let kind = SpringKind::Length(vec![
            Anchor::Station(station),
            Anchor::Ground(place + at(0.1, -0.5)),
        ]);
        scene
            .add_spring(Spring {
                name: "spring".into(),
                kind,
                law: Some(law),
                origin: Origin::AsBuilt,
                damping: 0.3.into(),
                rest: None,
            })
            .unwrap();
        if random.next() < 0.0 {
            let position = place + at(0.3, 0.4);
            let points = vec![("a".to_owned(), at(-0.3, -0.4)), ("b".to_owned(), at(0.2, 0.1))];
            let body = RigidBodyDefinition {
                name: "body".into(),
                position,
                angle: 0.0,
                points,
                outline: vec![],
                motion: StartMotion::default(),
            };
            let body = scene.add_rigid_body(body, 0.5, 0.02).unwrap();
            let points = [1, 2].map(|point| Station::on_rigid_body(body, point));
            let held = Anchor::Ground(position + at(0.6, 0.4));
            for (name, kind, law) in [
                (
                    "tie",
                    SpringKind::Length(vec![Anchor::Station(station), Anchor::Station(points[0])]),
                    SpringLaw::Linear { stiffness: 300.0, natural: 0.05 },
                ),
                (
                    "hold",
                    SpringKind::Length(vec![held, Anchor::Station(points[1])]),
                    SpringLaw::Linear { stiffness: 80.0, natural: 0.3 },
                ),
                (
                    "turn",
                    SpringKind::Torsion([held, Anchor::Station(Station::on_rigid_body(body, 0))]),
                    SpringLaw::Linear { stiffness: 2.0, natural: 0.1 },
                ),
            ] {
                let damping = 0.01.into();
                scene
                    .add_spring(Spring {
                        name: name.into(),
                        kind,
                        law: Some(law),
                        origin: Origin::Zero,
                        damping,
                        rest: None,
                    })
                    .unwrap();
            }
        }
    }
    (scene, method)
}

#[test]
fn random_scenes_have_the_same_digits_in_units_that_are_powers_of_two() {
    let two = |exponent: i32| 2.0_f64.powi(exponent);
    let units = [
        Units { length: two(-16), mass: 1.0, time: 1.0 },
        Units { length: two(12), mass: two(32), time: 1.0 },
        Units { length: two(16), mass: two(-48), time: two(-20) },
    ];
    for seed in 0..SEEDS {
        let (scene, method) = random(seed);
        let run = |units| Outcome::of(&scene, method, 0.5, units);
        let first = run(Units { length: 1.0, mass: 1.0, time: 1.0 });
        for units in units {
            assert_eq!(first, run(units), "{}, {units:?}", scene.name);
        }
    }
}
