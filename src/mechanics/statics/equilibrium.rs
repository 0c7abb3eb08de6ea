//! Equilibrium of a scene under its loads.

use super::continuation::{Continuation, InitialSupport};
use super::{Control, EquilibriumPath, InTime, Loading, PathPoint, StaticsError};
use crate::beams::{BodyPoint, Section, SectionForces, Station};
use crate::elementary::square;
use crate::geometry::{Vec2, larger};
use crate::integrators::{Constraints, Mechanism};
use crate::joints::{Slider, StartVelocities};
use crate::loads::PrescribedMotion;
use crate::system::{Drive, Element, Scene, SectionSample, System, SystemError, SystemState};
use crate::vibration::{Modes, VibrationError, loose_movements};

/// Largest unbalanced force or moment that counts as zero, as a fraction of the largest internal force or moment.
const ROUNDING: f64 = 1e-12;

/// Stability of an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// Every small disturbance of the equilibrium stays small.
    Stable,
    /// At least one small disturbance of the equilibrium grows.
    Unstable,
    /// The stability is undetermined, because the stiffness of the lowest mode is below its rounding error.
    BelowRounding,
    /// The stability is undetermined, because a load is a follower load, which has no potential.
    Follower,
}

/// Equilibrium of a scene under its loads, with the path from the unloaded scene.
///
/// Start velocities are ignored. All loads are multiplied by the same load factor.
pub struct Equilibrium {
    scene: Scene,
    loading: Loading,
    model: System,
    path: EquilibriumPath,
}

impl Equilibrium {
    /// Finds the equilibrium of a scene.
    /// Before every step and every iteration, `goes_on` is called with the load factor of the last equilibrium.
    ///
    /// # Errors
    /// Fails if the scene cannot be built, a load has no value, no load acts, no equilibrium is found, or the search is stopped.
    /// Also fails if a number in `loading` is invalid, or if the scene has a brake, a controller, a prescribed rate, or with arc-length control a drive.
    pub fn find(
        scene: Scene,
        loading: Loading,
        goes_on: &mut dyn FnMut(f64) -> bool,
    ) -> Result<Self, StaticsError> {
        let model = prepare(&scene, &loading, goes_on)?;
        let movements = loose_movements(&at_rest(&of_equal_stiffness(&scene), goes_on)?);
        let hold =
            if movements > 0 { InitialSupport::Loads(movements) } else { InitialSupport::Itself };
        let mut tracer = Continuation::new(&scene, model, loading, goes_on);
        match loading.control {
            Control::Load => tracer.load_up(hold)?,
            Control::ArcLength(arc) => tracer.trace_path(arc, hold)?,
        }
        let Continuation { model, path, .. } = tracer;
        Ok(Self { scene, loading, model, path })
    }

    /// Returns the initial configuration instead of the equilibrium, for the check of scripts (dry run).
    ///
    /// # Errors
    /// Fails in the same cases as [`find`](Self::find), except for the cases that depend on the search.
    pub fn dry_run(scene: Scene, loading: Loading) -> Result<Self, StaticsError> {
        let goes_on = &mut |_| true;
        let model = prepare(&scene, &loading, goes_on)?;
        let Continuation { model, mut path, .. } =
            Continuation::new(&scene, model, loading, goes_on);
        path.append_dry_point(loading.factor);
        Ok(Self { scene, loading, model, path })
    }

    /// Scene whose equilibrium was computed.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Loading for which the equilibrium was computed.
    pub fn loading(&self) -> &Loading {
        &self.loading
    }

    /// Model in the equilibrium configuration, or in the initial configuration after a [`dry_run`](Self::dry_run).
    pub fn model(&self) -> &System {
        &self.model
    }

    /// Path of equilibria that leads to this equilibrium.
    pub fn path(&self) -> &EquilibriumPath {
        &self.path
    }

    /// Calls a function with the model at every point of the path, in order.
    ///
    /// # Errors
    /// Fails if the scene cannot be built again, although it was built before.
    pub fn along_path<T>(&self, look: impl Fn(&System) -> T) -> Result<Vec<T>, StaticsError> {
        let mut model = at_rest(&self.scene, &mut |_| true)?;
        let at = |point: &PathPoint| {
            model.restore(&point.state);
            look(&model)
        };
        Ok(self.path.points().iter().map(at).collect())
    }

    /// State from which a motion starts in equilibrium.
    /// A sleeve in motion is on the axis of the mesh, without the compliance that the mesh does not represent. This moves the equilibrium slightly.
    ///
    /// # Errors
    /// Fails if the scene has no equilibrium near this one without the compliance of its sleeves.
    pub(crate) fn state_in_motion(&self) -> Result<SystemState, StaticsError> {
        if !self.scene.sliders.iter().any(Slider::is_sleeve) {
            return Ok(self.model.state());
        }
        let goes_on = &mut |_| true;
        let mut model = at_rest(&self.scene, goes_on)?;
        model.restore(&self.model.state());
        model
            .evaluate_loads_at(self.loading.time)
            .map_err(|(load, source)| StaticsError::Load { load, source })?;
        model.neglect_sleeve_compliance();
        let factor = self.path.load_factor();
        Continuation::new(&self.scene, model, self.loading, goes_on).solve_at(factor)
    }

    /// Reaction of the supports at a point: force [force] and moment [force·length]; `None` without a support at the point.
    pub fn reaction(&mut self, place: &BodyPoint) -> Option<(Vec2, f64)> {
        let mut forces = vec![0.0; self.model.degrees_of_freedom()];
        let contacts = self.model.constraint_shape().width;
        let mut standstill = vec![0.0; self.model.unknowns() + contacts];
        self.model.predict_unchanged(&mut standstill);
        self.model.begin_movement();
        self.model.add_static_forces(&standstill, self.path.load_factor(), &mut forces);
        self.model.support_force(place, &forces)
    }

    /// Section forces and strains at a station of a beam in equilibrium.
    ///
    /// # Errors
    /// Fails if the station lies outside its beam, or if it belongs to a particle or a rigid body.
    pub fn section_forces(&self, station: &Station) -> Result<SectionForces, SystemError> {
        let at = self.model.cross_section(&self.scene, station)?;
        Ok(self.model.section_forces(&at))
    }

    /// Section forces along a beam in equilibrium, from its start to its end.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn section_forces_along(&self, beam: usize) -> Result<Vec<SectionSample>, SystemError> {
        self.model.section_forces_along(&self.scene, beam)
    }

    /// Stability of the equilibrium, determined from the signs of the pivots of the stiffness, and from the lowest mode if a pivot is negative.
    /// If the lowest mode cannot be computed, the equilibrium counts as unstable.
    pub fn stability(&self, goes_on: &mut dyn FnMut() -> bool) -> Stability {
        if self.model.follower().is_some() {
            return Stability::Follower;
        }
        if self.model.negative_stiffness_count() == 0 {
            return Stability::Stable;
        }
        match self.modes(1, goes_on).as_ref().map(Modes::all) {
            Ok([lowest]) if lowest.square > 0.0 => Stability::Stable,
            Ok([lowest]) if lowest.square == 0.0 => Stability::BelowRounding,
            _ => Stability::Unstable,
        }
    }

    /// Lowest natural modes about the equilibrium.
    ///
    /// # Errors
    /// Fails in the same cases as [`Modes::of`].
    pub fn modes(
        &self,
        count: usize,
        goes_on: &mut dyn FnMut() -> bool,
    ) -> Result<Modes, VibrationError> {
        Modes::of(&self.model, count, goes_on)
    }
}

/// Returns the scene with equal axial, shear and bending stiffnesses of the beams and similar masses.
/// In the returned scene, degrees of freedom without restraint have zero stiffness.
/// With similar stiffnesses, rounding errors are so small that zero stiffness can be recognised.
fn of_equal_stiffness(scene: &Scene) -> Scene {
    let mut equal = scene.clone();
    for beam in &mut equal.beams {
        let square = square(beam.axis.length());
        beam.section = Section {
            axial_stiffness: 1.0,
            shear_stiffness: 1.0,
            bending_stiffness: square,
            mass_per_length: 1.0,
            rotary_inertia: square,
        }
        .into();
    }
    let length = scene.size().unwrap_or(1.0);
    for element in &mut equal.elements {
        if let Element::PointMass(mass) = element {
            let turns = mass.station.turns() && mass.station.beam().is_none();
            let rotary_inertia = if turns { length * square(length) } else { 0.0 };
            (mass.mass, mass.rotary_inertia) = (length, rotary_inertia);
        }
    }
    equal
}

pub(super) fn at_rest(
    scene: &Scene,
    goes_on: &mut dyn FnMut(f64) -> bool,
) -> Result<System, StaticsError> {
    let mut still = scene.clone();
    still.sliders.iter_mut().for_each(|slider| slider.velocities = StartVelocities::Project);
    System::assemble_while(&still, &mut || goes_on(0.0)).map_err(|error| match error {
        SystemError::Interrupted { .. } => StaticsError::Interrupted { reached: 0.0 },
        error => error.into(),
    })
}

fn check_needs_no_time(scene: &Scene) -> Result<(), StaticsError> {
    let is_rate = |drive: &&Drive| {
        drive.motions().any(|(_, motion)| matches!(motion, PrescribedMotion::Rate(_)))
    };
    let drive = scene.drives.iter().find(is_rate).map(|drive| (&drive.name, InTime::Speed));
    if let Some(brake) = scene.brakes().next() {
        return Err(StaticsError::Brake { brake: brake.object() });
    }
    let load = scene.loads().find(|load| load.schedule.is_sampled());
    match drive.or(load.map(|load| (load.title.as_ref().unwrap_or(&load.name), InTime::Controller)))
    {
        Some((name, by)) => Err(StaticsError::TimeDependent { name: name.clone(), by }),
        None => Ok(()),
    }
}

pub(super) fn prepare(
    scene: &Scene,
    loading: &Loading,
    goes_on: &mut dyn FnMut(f64) -> bool,
) -> Result<System, StaticsError> {
    loading.check()?;
    check_needs_no_time(scene)?;
    let mut model = at_rest(scene, goes_on)?;
    model
        .evaluate_loads_at(loading.time)
        .map_err(|(load, source)| StaticsError::Load { load, source })?;
    if let (Some(drive), Control::ArcLength(_)) = (scene.drives.first(), loading.control) {
        return Err(StaticsError::Driven { drive: drive.name.clone() });
    }
    if model.has_prescribed_positions() {
        return Ok(model);
    }
    let mut loads = vec![0.0; model.degrees_of_freedom()];
    model.subtract_static_loads(&vec![0.0; model.unknowns()], 1.0, &mut loads);
    if loads.iter().any(|load| *load != 0.0) {
        return Ok(model);
    }
    let time = loading.time;
    match (is_unloaded(&mut model), loading.control) {
        (true, _) => Err(StaticsError::NoLoad { time }),
        (false, Control::ArcLength(_)) => Err(StaticsError::NoScaledLoad { time }),
        (false, Control::Load) => Ok(model),
    }
}

fn is_unloaded(model: &mut System) -> bool {
    if !model.is_strung() {
        return true;
    }
    let (at_start, mut forces) = (model.state(), vec![0.0; model.degrees_of_freedom()]);
    let movements = model.unknowns();
    let mut standstill = vec![0.0; movements + model.constraint_shape().width];
    model.predict_unchanged(&mut standstill);
    model.begin_movement();
    let met = model.add_static_forces(&standstill, 0.0, &mut forces);
    model.restore(&at_start);
    let largest = larger(met.force, met.moment);
    forces[..movements].iter().all(|left| left.abs() <= ROUNDING * largest)
}
