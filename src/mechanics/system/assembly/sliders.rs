//! Assembly of sliders.

use super::{Assembly, Numbering};
use std::sync::Arc;

use crate::beams::{MissedKink, Station, arc_lengths, unresolved_kink};
use crate::elementary::atan2;
use crate::geometry::ContactPath;
use crate::joints::{Slider, SlidingRule, StartVelocities, Track, TrackBeam};
use crate::system::elements::AssemblyContext;
use crate::system::errors::SliderError;
use crate::system::sliders::{
    Connection, ImpactBar, KinkedAxis, MasterCurve, MasterKink, Sleeve, SleevedMaster,
    SliderContact, SliderState, TrackPath, TrackPathSegment,
};
use crate::system::{BeamDefinition, Scene, System, SystemError};

/// Largest start velocity of a slave across its master that counts as zero, as a fraction of the velocity of the fastest point of the scene.
/// It exceeds the rounding errors of velocities at a dead centre of a mechanism.
const SAME_VELOCITY: f64 = 1e-9;

impl Assembly<'_> {
    pub fn sliders(&self, numbering: &Numbering) -> Result<Vec<SliderContact>, SystemError> {
        let mut sliders: Vec<SliderContact> = Vec::new();
        let mut kink_lengths = vec![None; self.scene.beams.len()];
        let mut sleeved = vec![None; self.scene.beams.len()];
        let mut passages: Vec<Option<ContactPath>> = vec![None; self.scene.beams.len()];
        let mut routes: Vec<Option<Arc<[TrackPathSegment]>>> = vec![None; self.scene.tracks.len()];
        for (index, slider) in self.scene.sliders.iter().enumerate() {
            let place = self.place(&slider.slave)?;
            let slave = (place.body, place.nearest_control_point());
            let [x, ..] = numbering.degrees_of_freedom[slave.0][slave.1];
            let masters = self.scene.masters(slider);
            let of_master = |beam: &usize| &numbering.degrees_of_freedom[*beam];
            let is_unknown = x < numbering.unknowns;
            if is_unknown && masters.iter().flat_map(of_master).any(|degrees| degrees[0] == x) {
                return Err(SliderError::AlreadyJoined(self.scene.parts(slider)).into());
            }
            let is_twice = |other: &SliderContact| {
                let Connection { index, slave: (body, point), .. } = other.connection;
                let others = self.scene.masters(&self.scene.sliders[index]);
                let is_on = others.iter().any(|master| masters.contains(master));
                is_on && numbering.degrees_of_freedom[body][point][0] == x
            };
            if is_unknown && sliders.iter().any(is_twice) {
                return Err(SliderError::Duplicate(self.scene.parts(slider)).into());
            }
            let connection = Connection { master: slider.master, slave, index };
            let beam = &self.scene.beams[slider.master];
            let bars = (bar(beam), self.scene.beams.get(slave.0).map(bar));
            let parameter = self.slider_parameter(slider)?;
            let rail = self.master_curve(slider.master);
            let passage = self.contact_path(slider.master, &mut passages);
            let axis = self.kinked_axis(slider, &mut kink_lengths)?;
            let mut new =
                SliderContact::new(slider, connection, passage, parameter, rail, bars, axis);
            if let Some(track) = slider.track {
                let Track { beams: legs, end: course, .. } = &self.scene.tracks[track];
                let route = &mut routes[track];
                let route =
                    route.get_or_insert_with(|| self.track_path(legs, &mut passages)).clone();
                let own = legs.iter().position(|leg| leg.beam == slider.master).unwrap_or(0);
                new.set_track(TrackPath::new(route, *course, own));
            }
            if slider.is_sleeve() {
                let sleeve = self.sleeve(slider, new.start_path(), &mut sleeved)?;
                new.set_sleeve(sleeve);
            }
            if self.scene.starts_apart(slider)? {
                new.state = SliderState::Separated;
            }
            sliders.push(new);
        }
        Ok(sliders)
    }

    fn master_curve(&self, beam: usize) -> MasterCurve {
        MasterCurve::new(self.scene.beams[beam].axis.clone(), self.mesh(beam).basis().domain())
    }

    fn contact_path(&self, beam: usize, found: &mut [Option<ContactPath>]) -> ContactPath {
        let basis = || ContactPath::new(self.mesh(beam).basis().clone());
        found[beam].get_or_insert_with(basis).clone()
    }

    fn track_path(
        &self,
        legs: &[TrackBeam],
        passages: &mut [Option<ContactPath>],
    ) -> Arc<[TrackPathSegment]> {
        let leg = |&TrackBeam { beam, heading }: &TrackBeam| {
            let passage = self.contact_path(beam, passages);
            TrackPathSegment::new(
                beam,
                heading,
                self.master_curve(beam),
                passage,
                bar(&self.scene.beams[beam]),
            )
        };
        legs.iter().map(leg).collect()
    }

    fn kinked_axis(
        &self,
        slider: &Slider,
        found: &mut [Option<Option<MasterKink>>],
    ) -> Result<Option<KinkedAxis>, SystemError> {
        let (master, beam) = (slider.master, &self.scene.beams[slider.master]);
        let basis = self.mesh(master).basis();
        // A mesh of continuity C⁰ represents a kink (jump of the tangent of the axis under a contact force) at its nodes exactly.
        // A kink cannot move past a node, so sliders on such meshes have no kink.
        let has_nodes = basis.breaks().len() > 2 && basis.continuity() == 0;
        if slider.rule != SlidingRule::Kinked || has_nodes {
            return Ok(None);
        }
        if found[master].is_none() {
            let points = self.bodies[master].control_points();
            let wrap = |source| SystemError::Beam { beam: beam.name.clone(), source };
            let missed = unresolved_kink(self.mesh(master), points).map_err(wrap)?;
            let of = |missed: MissedKink| MasterKink {
                length: Arc::new(missed.length),
                arc: Arc::new(arc_lengths(self.mesh(master), points)),
                inertia: missed.inertia,
            };
            found[master] = Some(missed.map(of));
        }
        let axis = |kink| KinkedAxis::new(kink, beam.axis.length(), &beam.section.mean());
        Ok(found[master].clone().flatten().map(axis))
    }

    fn sleeve(
        &self,
        slider: &Slider,
        path: &ContactPath,
        found: &mut [Option<Arc<SleevedMaster>>],
    ) -> Result<Sleeve, SystemError> {
        let (master, beam) = (slider.master, &self.scene.beams[slider.master]);
        let sleeved = match &found[master] {
            Some(sleeved) => sleeved.clone(),
            None => {
                let points = self.bodies[master].control_points();
                let wrap = |source| SystemError::Beam { beam: beam.name.clone(), source };
                let section = &beam.section.mean();
                let new = SleevedMaster::new(self.mesh(master), points, section).map_err(wrap)?;
                found[master].insert(Arc::new(new)).clone()
            }
        };
        let along = self.scene.drawn_tangent(master, slider.arc_length)?;
        Ok(Sleeve::new(sleeved, path, atan2(along.y, along.x)))
    }

    pub fn slider_parameter(&self, slider: &Slider) -> Result<f64, SystemError> {
        let beam = &self.scene.beams[slider.master];
        Station::on_beam(slider.master, slider.arc_length)
            .parameter(&beam.axis, self.mesh(slider.master))
            .map_err(|error| self.wrong(slider.master, error))
    }
}

fn bar(beam: &BeamDefinition) -> ImpactBar {
    ImpactBar { length: beam.axis.length(), section: beam.section.mean() }
}

impl System {
    /// Checks the start velocity of each slave across its master or projects it to zero, depending on the option of the slider.
    /// Velocities and spins of sleeves are always projected.
    /// Velocities count as zero up to `SAME_VELOCITY` times the fastest speed plus the speed whose axial wave has a strain of machine precision.
    pub(super) fn project_start_velocities(&mut self, scene: &Scene) -> Result<(), SystemError> {
        let negligible = self.negligible_velocity(scene);
        self.follow_masters();
        let mut is_projected = false;
        for (index, described) in scene.sliders.iter().enumerate() {
            match described.velocities {
                StartVelocities::Check if !described.is_sleeve() => {
                    self.apply_start_velocity(index, negligible)?;
                }
                StartVelocities::Check | StartVelocities::Project => is_projected = true,
            }
        }
        self.clear_contact_events();
        if is_projected {
            self.project_velocities()?;
        }
        self.fit_links_to_drives(negligible);
        Ok(())
    }

    /// Sets the time of a model in static equilibrium. Prescribed motions receive the rates of their functions.
    ///
    /// # Errors
    /// Fails if a function has no value at the given time, or if velocities contradict the sliders.
    pub(super) fn begin_at(&mut self, time: f64, scene: &Scene) -> Result<(), SystemError> {
        self.set_time(time);
        self.set_prescribed_motion(time)
            .map_err(|(drive, source)| SystemError::DriveValue { drive, source })?;
        self.set_rest_lengths(time).map_err(|(spring, source)| SystemError::RestValue {
            spring,
            name: "length",
            source,
        })?;
        self.project_start_velocities(scene)
    }

    fn negligible_velocity(&self, scene: &Scene) -> f64 {
        SAME_VELOCITY * self.fastest_speed() + f64::EPSILON * scene.fastest_wave()
    }

    /// Checks the start velocity of the slave of a slider across its master.
    /// A slider with a unilateral contact starts in flight if its slave moves away from the axis to the side on which it can fly.
    fn apply_start_velocity(&mut self, slider: usize, negligible: f64) -> Result<(), SystemError> {
        let speed = self.speed_across(slider);
        if speed.abs() <= negligible || self.slider(slider).is_separated() {
            return Ok(());
        }
        if speed > 0.0 && self.slider(slider).may_take_off() {
            self.take_off(slider);
            return Ok(());
        }
        let speed = speed.abs();
        Err(SliderError::LeavesMaster { slider: self.slider(slider).name.clone(), speed }.into())
    }
}
