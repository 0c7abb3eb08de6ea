//! What a scene uses, and what it therefore leaves out.

use crate::beams::PointCounts;
use crate::geometry::Vec2;
use crate::integrators::{INTEGRATORS, Mechanism, Method, Stage};
use crate::joints::{Component, Joint, Partner, SLIDING_RULES, StartVelocities};
use crate::loads::{Load, Schedule, VALUES_OF_A_MEAN};
use crate::model::elements::Action;
use crate::model::mechanism::Model;
use crate::model::{ModelError, Scene};

/// More beams or loads than this are told of together.
const MOST: usize = 6;

/// A part of the mechanics.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Part {
    /// What it is.
    pub name: String,
    /// Whether it is used.
    pub usage: Usage,
}

/// Whether a part is used.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Usage {
    /// It is: how much, or why.
    Used(String),
    /// It is not: what is saved.
    LeftOut(String),
}

impl Part {
    /// A part that is used.
    pub fn used(name: impl Into<String>, how: impl Into<String>) -> Self {
        Self { name: name.into(), usage: Usage::Used(how.into()) }
    }

    /// Steps, in words, and the times at which they are cut.
    pub fn steps(size: &str, cuts: &[f64]) -> Self {
        let cut = in_words(cuts).map(|times| format!("cut ahead at t = {times}"));
        Self::used("steps", format!("{size}, {}", cut.unwrap_or("no cuts ahead".to_owned())))
    }

    /// A part that is left out.
    pub fn left_out(name: impl Into<String>, saved: impl Into<String>) -> Self {
        Self { name: name.into(), usage: Usage::LeftOut(saved.into()) }
    }
}

impl Scene {
    /// What a simulation of this scene uses and what it leaves out, with any integrator.
    ///
    /// # Errors
    /// When the scene cannot be assembled.
    pub fn explain(&self) -> Result<Vec<Part>, ModelError> {
        let methods: Vec<Method> = INTEGRATORS.iter().map(|entry| entry.method).collect();
        Ok(Model::assemble(self)?.explain(self, &methods))
    }
}

impl Model {
    /// What this model of a scene uses and what it leaves out; `methods` are those that may advance it.
    pub fn explain(&self, scene: &Scene, methods: &[Method]) -> Vec<Part> {
        let mut parts = vec![self.explain_matrix()];
        parts.extend(self.explain_beams(scene));
        parts.extend([explain_particles(scene), explain_masses(scene)]);
        parts.extend([self.explain_joints(scene), self.explain_supports(scene)]);
        parts.extend([self.explain_sliders(scene), self.explain_gravity(scene)]);
        parts.extend(self.explain_loads(scene, methods));
        parts.extend([self.explain_angles(), explain_start(scene)]);
        parts
    }

    fn explain_matrix(&self) -> Part {
        let how = format!("{} movements, half-bandwidth {}", self.unknowns, self.half_bandwidth);
        let how = match self.constraint_shape().width {
            0 => how,
            width => format!("{how}; {width} of contacts, in the border"),
        };
        Part::used("unknowns", how)
    }

    fn explain_beams(&self, scene: &Scene) -> Vec<Part> {
        if scene.beams.is_empty() {
            return vec![Part::left_out("beams", "no strains, no section forces, no quadrature")];
        }
        let counts: Vec<PointCounts> = self.meshes.iter().map(|mesh| mesh.point_counts()).collect();
        let sum = |of: fn(&PointCounts) -> usize| counts.iter().map(of).sum::<usize>();
        let beam = |(index, beam): (usize, &crate::model::BeamDefinition)| {
            let PointCounts { force, moment, inertia } = counts[index];
            let mesh = self.meshes[index].describe();
            let points = self.bodies[index].dynamics.control_points().len();
            let how = format!(
                "{mesh}, {points} control points; points for Γ {force}, κ {moment}, mass {inertia}"
            );
            Part::used(format!("beam '{}'", beam.name), how)
        };
        let mut parts: Vec<Part> = match scene.beams.len() {
            count if count > MOST => {
                let (force, moment) = (sum(|of| of.force), sum(|of| of.moment));
                let how = format!(
                    "{count}; points for Γ {force}, κ {moment}, mass {}",
                    sum(|of| of.inertia)
                );
                vec![Part::used("beams", how)]
            }
            _ => scene.beams.iter().enumerate().map(beam).collect(),
        };
        let inertia = "rho_I of every section: rotations have an inertia of their own";
        parts.push(Part::used("rotary inertia", inertia));
        parts
    }

    fn explain_joints(&self, scene: &Scene) -> Part {
        let between = |joint: &&Joint| joint.partner != Partner::Ground;
        let kinds = counted(scene.joints.iter().filter(between));
        if kinds.is_empty() {
            return Part::left_out("joints", "no movement is shared");
        }
        let all: usize = self.bodies.iter().map(|body| 3 * body.degrees_of_freedom.len()).sum();
        let shared = all - self.supports.len() - self.unknowns;
        let saved = plural(shared, "unknown");
        Part::used(
            "joints",
            format!("{kinds}: tied movements are one, {saved} less; no multipliers"),
        )
    }

    fn explain_supports(&self, scene: &Scene) -> Part {
        let on_ground = |joint: &&Joint| joint.partner == Partner::Ground;
        let kinds = counted(scene.joints.iter().filter(on_ground));
        if kinds.is_empty() {
            return Part::left_out("supports", "everything is free: no reactions");
        }
        let of_particles = |body: usize| body >= scene.beams.len();
        let turns = |component| component == Component::Rotation;
        let held =
            self.supports.iter().filter(|at| !(of_particles(at.body) && turns(at.component)));
        let held = plural(held.count(), "movement");
        Part::used(
            "supports",
            format!("{kinds}: {held} held and no unknowns; reactions are measured"),
        )
    }

    fn explain_sliders(&self, scene: &Scene) -> Part {
        let width = self.constraint_shape().width;
        if width == 0 {
            let saved =
                "the matrix is a plain band: no border, no contact forces, no search for ends";
            return Part::left_out("sliders", saved);
        }
        let used = SLIDING_RULES.iter().filter_map(|entry| {
            let count = scene.sliders.iter().filter(|slider| slider.rule == entry.rule).count();
            (count > 0).then(|| format!("{count} {}", entry.name))
        });
        let rules = used.collect::<Vec<_>>().join(", ");
        let how = format!("{rules}: a border of {width} columns; ends of their beams are watched");
        Part::used("sliders", how)
    }

    fn explain_gravity(&self, scene: &Scene) -> Part {
        match self.gravity {
            Some(_) => {
                let (x, y) = (scene.gravity.x, scene.gravity.y);
                Part::used(
                    "gravity",
                    format!("({x}, {y}): a constant weight, and a potential energy"),
                )
            }
            None => Part::left_out("gravity", "no weight; the potential energy stays 0"),
        }
    }

    fn explain_loads(&self, scene: &Scene, methods: &[Method]) -> Vec<Part> {
        if scene.loads.is_empty() {
            return vec![Part::left_out("loads", "no schedules, no work")];
        }
        let one = |(load, applied): (&Load, &crate::model::elements::AppliedLoad)| {
            let action = match &applied.action {
                Action::Dead(_) => "dead".to_owned(),
                Action::Follower(at) => {
                    format!("follower of {}, part of the tangent", plural(at.len(), "section"))
                }
            };
            let schedule = load.schedule.describe();
            let calls = calls(&load.schedule, methods);
            let cuts = in_words(&cuts(&load.schedule)).map(|at| format!("; steps end at t = {at}"));
            Part::used(
                &load.name,
                format!("{action}, {schedule}{calls}{}", cuts.unwrap_or_default()),
            )
        };
        let all = scene.loads.iter().zip(&self.loads);
        let mut parts: Vec<Part> = all.clone().take(MOST).map(one).collect();
        let rest = all.skip(MOST).map(|(load, _)| &load.schedule).collect::<Vec<_>>();
        if !rest.is_empty() {
            let functions = rest.iter().map(|schedule| schedule.functions()).sum();
            let scripts = plural(functions, "function");
            let how = format!("{} more, {scripts} of scripts among them", rest.len());
            parts.push(Part::used("loads", how));
        }
        parts
    }

    fn explain_angles(&self) -> Part {
        match self.all_trackers().count() {
            0 => Part::left_out("followed angles", "no section is followed"),
            count => {
                let how = "ends of beams, stations, and where loads turn";
                Part::used("followed angles", format!("{}: {how}", plural(count, "section")))
            }
        }
    }
}

fn explain_start(scene: &Scene) -> Part {
    let is_zero = |velocity: Vec2, spin: f64| velocity == Vec2::zeros() && spin == 0.0;
    let beams_rest = scene.beams.iter().all(|beam| is_zero(beam.motion.velocity, beam.motion.spin));
    let nodes_rest = scene.velocities.iter().all(|at| is_zero(at.velocity, at.spin.unwrap_or(0.0)));
    let is_projected =
        scene.sliders.iter().any(|slider| slider.velocities == StartVelocities::Project);
    let how = match (beams_rest && nodes_rest, is_projected) {
        (_, true) => "made to fit the sliders, by solving once with the mass matrix",
        (true, false) => return Part::left_out("start velocities", "everything starts at rest"),
        (false, false) if scene.sliders.is_empty() => "as given",
        (false, false) => "as given; checked to fit the sliders",
    };
    Part::used("start velocities", how)
}

fn explain_particles(scene: &Scene) -> Part {
    match scene.particles.len() {
        0 => Part::left_out("particles", "every unknown belongs to a beam"),
        count => Part::used("particles", format!("{count}, which do not turn")),
    }
}

/// Masses besides those of the particles themselves.
fn explain_masses(scene: &Scene) -> Part {
    match scene.masses.len().saturating_sub(scene.particles.len()) {
        0 => Part::left_out("point masses", "the mass matrix is that of the bodies"),
        count => {
            let turning = scene.masses.iter().filter(|mass| mass.rotary_inertia > 0.0).count();
            let how = format!("{count}, {turning} with rotary inertia; part of the mass matrix");
            Part::used("point masses", how)
        }
    }
}

/// The times after the start at which steps end because of a schedule, in their order.
fn cuts(schedule: &Schedule) -> Vec<f64> {
    let mut times = schedule.breaks();
    times.retain(|time| *time > 0.0);
    times.sort_by(f64::total_cmp);
    times.dedup();
    times
}

/// The first few of some times, none where there are none.
fn in_words(times: &[f64]) -> Option<String> {
    match times {
        [] => None,
        [first, .., last] if times.len() > MOST => {
            Some(format!("{first}, …, {last} ({} times)", times.len()))
        }
        times => Some(times.iter().map(f64::to_string).collect::<Vec<_>>().join(", ")),
    }
}

/// How often a step calls functions of scripts for a schedule.
fn calls(schedule: &Schedule, methods: &[Method]) -> String {
    let functions = schedule.functions();
    if functions == 0 {
        return String::new();
    }
    let of_method = |method: &Method| {
        let calls: usize = method.stages().iter().map(values_at).sum();
        format!("{} calls a step with {}", functions * calls, method.entry().name)
    };
    format!(": {}", methods.iter().map(of_method).collect::<Vec<_>>().join(", "))
}

/// How many values of a schedule a stage takes.
fn values_at(stage: &Stage) -> usize {
    match stage {
        Stage::Start | Stage::End => 1,
        Stage::Midpoint | Stage::DampedMidpoint(_) => VALUES_OF_A_MEAN,
    }
}

/// `2 hinges, 1 clamp`.
fn counted<'a>(joints: impl Iterator<Item = &'a Joint>) -> String {
    let mut kinds: Vec<(&str, usize)> = Vec::new();
    for joint in joints {
        let kind = joint.kind.describe(&joint.partner);
        match kinds.iter_mut().find(|(other, _)| *other == kind) {
            Some((_, count)) => *count += 1,
            None => kinds.push((kind, 1)),
        }
    }
    kinds.iter().map(|(kind, count)| plural(*count, kind)).collect::<Vec<_>>().join(", ")
}

fn plural(count: usize, noun: &str) -> String {
    format!("{count} {noun}{}", if count == 1 { "" } else { "s" })
}
