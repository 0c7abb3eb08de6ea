//! Summary of the features that a scene uses and omits.

use crate::beams::{PointCounts, SectionVariation};
use crate::geometry::Vec2;
use crate::integrators::{Constraints, INTEGRATORS, Mechanism, Method};
use crate::joints::{
    Component, Joint, Partner, Releasable, SLIDING_RULES, Slider, SlidingRule, StartVelocities,
    Trigger,
};
use crate::system::elements::{ExternalForce, InternalForce};
use crate::system::errors::{MOST, in_words, plural};
use crate::system::{BeamDefinition, Drive, Scene, System, SystemError};

/// Feature of the mechanics, with a text on its use in a simulation or on the reason why it is omitted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SystemFeature {
    /// Description of the feature.
    pub name: String,
    /// Use of the feature.
    pub usage: Usage,
}

/// Use of a feature in a simulation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Usage {
    /// Used feature. The text describes its use.
    Used(String),
    /// Omitted feature. The text describes the computations that are not needed.
    Omitted(String),
}

impl SystemFeature {
    /// Creates the description of a feature that a simulation uses.
    pub fn used(name: impl Into<String>, how: impl Into<String>) -> Self {
        Self { name: name.into(), usage: Usage::Used(how.into()) }
    }

    /// Describes the time steps as a feature: their size, and the times at which steps must end.
    pub fn steps(size: &str, cuts: &[f64]) -> Self {
        let cut = in_words(cuts).map(|times| format!("steps will end at t = {times}"));
        Self::used(
            "steps",
            format!("{size}, {}", cut.unwrap_or("no prescribed ends of steps".to_owned())),
        )
    }

    pub(crate) fn omitted(name: impl Into<String>, saved: impl Into<String>) -> Self {
        Self { name: name.into(), usage: Usage::Omitted(saved.into()) }
    }
}

impl Scene {
    /// Features of the mechanics that simulations of this scene use and omit, for any integrator.
    ///
    /// # Errors
    /// Fails if the scene cannot be assembled.
    pub fn explain(&self) -> Result<Vec<SystemFeature>, SystemError> {
        let methods: Vec<Method> = INTEGRATORS.iter().map(|entry| entry.method).collect();
        Ok(System::assemble(self)?.explain(self, &methods))
    }
}

impl System {
    /// Features of the mechanics that this model of a scene uses and omits. `methods` are the integrators that may advance the model.
    pub fn explain(&self, scene: &Scene, methods: &[Method]) -> Vec<SystemFeature> {
        let mut parts = vec![self.explain_matrix()];
        parts.extend(self.explain_beams(scene));
        parts.push(explain_particles(scene));
        parts.extend(self.explain_bodies(scene));
        parts.push(explain_masses(scene));
        parts.extend([self.explain_joints(scene), self.explain_supports(scene)]);
        parts.extend(scene.drives.iter().map(|drive| explain_drive(scene, drive)));
        parts.extend([self.explain_sliders(scene), self.explain_gravity(methods)]);
        parts.extend(self.explain_loads(methods));
        parts.extend(self.explain_springs());
        parts.extend([self.explain_angles(), explain_start(scene)]);
        parts.extend(explain_releases(scene));
        parts
    }

    fn explain_matrix(&self) -> SystemFeature {
        let how = format!(
            "{} degrees of freedom, half-bandwidth {}",
            self.movements(),
            self.half_bandwidth()
        );
        let how = match 2 * self.links().count() {
            0 => how,
            forces => format!("{how}, including {forces} forces of rigid links"),
        };
        let how = match self.links().rollers().count() {
            0 => how,
            forces => format!("{how}, including {forces} forces of inclined rollers"),
        };
        let how = match self.constraint_shape().width {
            0 => how,
            width if self.constraint_blocks().is_some() => {
                format!("{how}; {width} contact unknowns, eliminated locally")
            }
            width => format!("{how}; {width} contact unknowns, in the border of the matrix"),
        };
        SystemFeature::used("unknowns", how)
    }

    fn movements(&self) -> usize {
        self.unknowns() - self.links().forces()
    }

    fn explain_bodies(&self, scene: &Scene) -> Option<SystemFeature> {
        let points = self.links().count();
        let how = match (scene.rigid_bodies.len(), points) {
            (0, _) => return None,
            (count, 0) => format!("{count}, connected at their centres only: no rigid links"),
            (count, points) => format!(
                "{count} with {}, each with a constraint force of two components; conserves energy and momenta",
                plural(points, "rigid link")
            ),
        };
        Some(SystemFeature::used("rigid bodies", how))
    }

    fn explain_beams(&self, scene: &Scene) -> Vec<SystemFeature> {
        if scene.beams.is_empty() {
            return vec![SystemFeature::omitted(
                "beams",
                "no strains, no section forces, no quadrature",
            )];
        }
        let counts: Vec<PointCounts> =
            self.meshes().iter().map(|mesh| mesh.point_counts()).collect();
        let sum = |of: fn(&PointCounts) -> usize| counts.iter().map(of).sum::<usize>();
        let beam = |(index, beam): (usize, &BeamDefinition)| {
            let PointCounts { force, moment, inertia } = counts[index];
            let mesh = self.meshes()[index].describe();
            let chosen = if beam.mesh.is_automatic() { " (chosen from the scene)" } else { "" };
            let points = self.bodies()[index].dynamics.control_points().len();
            let how = format!(
                "{mesh}{chosen}, {points} control points; points for Γ {force}, κ {moment}, mass {inertia}"
            );
            let taper = match beam.section {
                SectionVariation::Uniform(_) => "",
                SectionVariation::Numbers(_) | SectionVariation::Dimensions(_) => {
                    "; tapered: each point has its own section"
                }
            };
            SystemFeature::used(format!("beam '{}'", beam.name), format!("{how}{taper}"))
        };
        let mut parts: Vec<SystemFeature> = match scene.beams.len() {
            count if count > MOST => {
                let (force, moment) = (sum(|of| of.force), sum(|of| of.moment));
                let how = format!(
                    "{count}; points for Γ {force}, κ {moment}, mass {}",
                    sum(|of| of.inertia)
                );
                vec![SystemFeature::used("beams", how)]
            }
            _ => scene.beams.iter().enumerate().map(beam).collect(),
        };
        let inertia = "rho_I of every section";
        parts.push(SystemFeature::used("rotary inertia", inertia));
        parts
    }

    fn joints_at<'s>(&'s self, scene: &'s Scene) -> impl Iterator<Item = &'s Joint> {
        let unknowns = self.unknown_movements();
        let joints = scene.joints.iter().enumerate();
        joints
            .filter(|(at, _)| !unknowns.are_free_of(Releasable::Joint(*at)))
            .map(|(_, joint)| joint)
    }

    fn explain_joints(&self, scene: &Scene) -> SystemFeature {
        let between = |joint: &&Joint| joint.partner != Partner::Ground;
        let kinds = counted(self.joints_at(scene).filter(between));
        if kinds.is_empty() {
            return SystemFeature::omitted("joints", "no coupled movements");
        }
        let all: usize = self.bodies().iter().map(|body| 3 * body.degrees_of_freedom.len()).sum();
        let shared = all - self.supports().count() - self.movements();
        let saved = plural(shared, "unknown");
        SystemFeature::used(
            "joints",
            format!(
                "{kinds}: joined movements share unknowns, which removes {saved}; no multipliers"
            ),
        )
    }

    fn explain_supports(&self, scene: &Scene) -> SystemFeature {
        let on_ground = |joint: &&Joint| joint.partner == Partner::Ground;
        let kinds = counted(self.joints_at(scene).filter(on_ground));
        if kinds.is_empty() {
            return SystemFeature::omitted("supports", "no supports and no reactions");
        }
        let first_rigid = scene.first_rigid_body();
        let of_particles = |body: usize| (scene.beams.len()..first_rigid).contains(&body);
        let turns = |component| component == Component::Rotation;
        let held =
            self.supports().held().filter(|at| !(of_particles(at.body) && turns(at.component)));
        let held = plural(held.count(), "movement");
        let across = match self.links().rollers().count() {
            0 => String::new(),
            forces => {
                format!("; {} of inclined rollers are unknowns", plural(forces, "force"))
            }
        };
        SystemFeature::used(
            "supports",
            format!(
                "{kinds}: {held} fixed and removed from the unknowns{across}; reactions are recorded"
            ),
        )
    }

    fn explain_sliders(&self, scene: &Scene) -> SystemFeature {
        let width = self.constraint_shape().width;
        if width == 0 {
            let saved =
                "plain band matrix: no border, no contact forces, no detection of beam ends";
            return SystemFeature::omitted("sliders", saved);
        }
        let used = SLIDING_RULES.iter().filter_map(|entry| {
            let is_own = |slider: &&Slider| slider.rule == entry.rule && !slider.is_sleeve();
            let count = scene.sliders.iter().filter(is_own).count();
            (count > 0).then(|| format!("{count} {}", entry.name))
        });
        let sleeves = scene.sliders.iter().filter(|slider| slider.is_sleeve()).count();
        let sleeves = (sleeves > 0).then(|| plural(sleeves, "sleeve"));
        let rules = used.chain(sleeves).collect::<Vec<_>>().join(", ");
        let solved = match self.constraint_blocks() {
            None => format!("a border of {width} columns"),
            Some(blocks) => {
                let free = blocks.own.iter().filter(|own| !own.is_empty()).count();
                let all = blocks.own.len();
                format!("{all} blocks beside the band, {free} including the sliding body")
            }
        };
        let on_tracks = scene.sliders.iter().any(|slider| slider.track.is_some());
        let seams = if on_tracks { ", steps end at seams of tracks" } else { "" };
        let leaves = scene.sliders.iter().any(|slider| slider.side().is_some());
        let flights =
            if leaves { ", steps end where sliders leave beams and land on them" } else { "" };
        let may_kink = |slider: &Slider| {
            let basis = self.meshes()[slider.master].basis();
            let is_smooth = basis.breaks().len() == 2 || basis.continuity() > 0;
            let is_plain = slider.track.is_none() && !slider.is_sleeve();
            slider.rule == SlidingRule::Conserving && is_plain && is_smooth
        };
        let choice = match scene.sliders.iter().any(may_kink) {
            true => {
                "; the conserving rule is of first order in the span length, the kinked rule of second to third order"
            }
            false => "",
        };
        let how = format!(
            "{rules}: {solved}; arrivals at beam ends are detected{seams}{flights}{choice}"
        );
        SystemFeature::used("sliders", how)
    }

    fn explain_gravity(&self, methods: &[Method]) -> SystemFeature {
        match self.elements().weight() {
            Some(weight) => SystemFeature::used(weight.name(), weight.explain(methods)),
            None => SystemFeature::omitted("gravity", "no weight and no potential energy"),
        }
    }

    fn explain_loads(&self, methods: &[Method]) -> Vec<SystemFeature> {
        let all = self.elements().forces();
        let one =
            |load: &dyn ExternalForce| SystemFeature::used(load.name(), load.explain(methods));
        let mut parts: Vec<SystemFeature> = all.clone().take(MOST).map(one).collect();
        if parts.is_empty() {
            return vec![SystemFeature::omitted("loads", "no external forces")];
        }
        let rest = all.skip(MOST).map(|load| load.functions()).collect::<Vec<_>>();
        if !rest.is_empty() {
            let scripts = plural(rest.iter().sum(), "function");
            let how = format!("{} more, including {scripts} of scripts", rest.len());
            parts.push(SystemFeature::used("loads", how));
        }
        parts
    }

    fn explain_springs(&self) -> Vec<SystemFeature> {
        let all = self.elements().resistances();
        let one = |spring: &dyn InternalForce| SystemFeature::used(spring.name(), spring.explain());
        let mut parts: Vec<SystemFeature> = all.clone().take(MOST).map(one).collect();
        if parts.is_empty() {
            return vec![SystemFeature::omitted(
                "springs",
                "no stored energy and no damping outside the beams",
            )];
        }
        let rest = all.skip(MOST).count();
        if rest > 0 {
            parts.push(SystemFeature::used("springs", format!("{rest} more")));
        }
        parts
    }

    fn explain_angles(&self) -> SystemFeature {
        match self.bodies().tracked_sections() + self.elements().tracked_sections() {
            0 => SystemFeature::omitted("followed angles", "no section angle is tracked"),
            count => {
                let how = "ends of beams, stations, and places of follower loads";
                SystemFeature::used(
                    "followed angles",
                    format!("{}: {how}", plural(count, "section")),
                )
            }
        }
    }
}

fn explain_drive(scene: &Scene, drive: &Drive) -> SystemFeature {
    let names: Vec<&str> = drive.motions().map(|(component, _)| component.name()).collect();
    let place = scene.describe(&drive.station);
    let calls: usize = drive.motions().map(|(_, motion)| motion.calls_in_step()).sum();
    let calls = match calls {
        0 => String::new(),
        count => format!("; {count} function calls per step or substep"),
    };
    let beats = drive.schedules().filter_map(|schedule| schedule.sample_clock());
    let asked: String = beats.map(|beat| format!(", sampled {beat}")).collect();
    let given = "prescribed and removed from the unknowns";
    let how = format!("{} of {place}: {given}{calls}{asked}", names.join(", "));
    SystemFeature::used(format!("{} '{}'", drive.kind.name(), drive.name), how)
}

fn explain_releases(scene: &Scene) -> Option<SystemFeature> {
    let descriptions = scene.releases.iter().map(|release| {
        let name = scene.releasable_name(release.object);
        match release.trigger {
            Trigger::Time(time) => format!("'{name}' at t = {time}"),
            Trigger::Outside => {
                format!("'{name}' when a function returns true, evaluated before every step")
            }
        }
    });
    let descriptions: Vec<String> = descriptions.collect();
    (!descriptions.is_empty()).then(|| SystemFeature::used("releases", descriptions.join("; ")))
}

fn explain_start(scene: &Scene) -> SystemFeature {
    let is_zero = |velocity: Vec2, spin: f64| velocity == Vec2::zeros() && spin == 0.0;
    let of_beams = scene.beams.iter().map(|beam| &beam.motion);
    let mut motions = of_beams.chain(scene.rigid_bodies.iter().map(|body| &body.motion));
    let bodies_rest = motions.all(|motion| is_zero(motion.velocity, motion.spin));
    let nodes_rest = scene.velocities.iter().all(|at| is_zero(at.velocity, at.spin.unwrap_or(0.0)));
    let is_projected =
        scene.sliders.iter().any(|slider| slider.velocities == StartVelocities::Project);
    let how = match (bodies_rest && nodes_rest, is_projected) {
        (_, true) => "projected onto the slider constraints with the mass matrix",
        (true, false) => {
            return SystemFeature::omitted("start velocities", "everything starts at rest");
        }
        (false, false) if scene.sliders.is_empty() => "as given",
        (false, false) => "as given; checked for compatibility with the sliders",
    };
    SystemFeature::used("start velocities", how)
}

fn explain_particles(scene: &Scene) -> SystemFeature {
    match scene.particles.len() {
        0 => SystemFeature::omitted("particles", "every unknown belongs to a beam or body"),
        count => SystemFeature::used("particles", format!("{count}, without rotation")),
    }
}

fn explain_masses(scene: &Scene) -> SystemFeature {
    match scene.masses().count().saturating_sub(scene.particles.len() + scene.rigid_bodies.len()) {
        0 => SystemFeature::omitted("point masses", "no masses added to beams or bodies"),
        count => {
            let turning = scene.masses().filter(|mass| mass.rotary_inertia > 0.0).count();
            let how = format!("{count}, {turning} with rotary inertia; part of the mass matrix");
            SystemFeature::used("point masses", how)
        }
    }
}

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
