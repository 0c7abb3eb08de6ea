//! Validation of sliders.

use super::ties::same_place;
use super::{RigidBodyDefinition, Scene, StartMotion};
use crate::beams::{SectionVariation, Station};
use crate::geometry::{Vec2, cross, nearest};
use crate::joints::{JointKind, Partner, Slider, SlidingRule};
use crate::system::errors::{Approach, SliderError, SliderParts, written};
use crate::system::{BeamDefinition, SystemError};

/// Largest initial distance of a slave from its master, as a fraction of the length of the master plus the distance from the origin.
/// The limit `CLOSED` allows coordinates with six digits. A slave within the limit is moved exactly onto its master.
const CLOSED: f64 = 1e-6;

struct StartGap {
    from: Vec2,
    to: Vec2,
    gap: f64,
    /// Largest initial distance for which the slave is moved onto the axis [length].
    tolerance: f64,
}

/// Reason for rejecting a sliding rule on tracks; `None` if the rule is allowed.
fn at_seams(rule: SlidingRule) -> Option<&'static str> {
    match rule {
        SlidingRule::Conserving | SlidingRule::Exact => None,
        SlidingRule::Kinked => Some(
            "there is no space for the kink of the axis, and its energy would reflect the slider",
        ),
        SlidingRule::Relaxed => Some("the gap to both beams cannot be closed"),
    }
}

/// Option that a slider does not allow: true if it is given, with its description and a remedy.
type RefusedOption = (bool, &'static str, &'static str);

/// Options that neither one-sided sliders nor sleeves allow.
fn refused_options(slider: &Slider) -> [RefusedOption; 4] {
    let is_other_rule = slider.rule != SlidingRule::Conserving;
    [
        (slider.track.is_some(), "on a track", "choose a single beam"),
        (slider.has_friction(), "with friction", "remove the friction"),
        (is_other_rule, "with a rule other than conserving", "use the conserving rule"),
        (
            slider.ends.has_stop(),
            "with ends that hold or reflect it",
            "choose ends that stop the run or release it",
        ),
    ]
}

fn check_sleeve(slider: &Slider, master: &BeamDefinition) -> Result<(), SystemError> {
    if !slider.is_sleeve() {
        return Ok(());
    }
    let of_sleeves = [
        (
            !matches!(master.section, SectionVariation::Uniform(_)),
            "on a beam with a variable section, because the force along it would not converge with the mesh",
            "use a uniform beam, or mechanisms::sleeve",
        ),
        (!slider.slave.turns(), "on a particle, which has no rotation", "use a rigid body"),
    ];
    let mut refused = of_sleeves.into_iter().chain(refused_options(slider));
    match refused.find(|(is_given, ..)| *is_given) {
        Some((_, what, remedy)) => {
            Err(SliderError::SleeveWith { slider: slider.name.clone(), what, remedy }.into())
        }
        None => Ok(()),
    }
}

impl Scene {
    /// Adds a rigid body without mass that is fixed to the ground and holds a new slider, and returns its station.
    ///
    /// # Errors
    /// Fails if the name of the slider or of the body is taken or invalid, or if the position is not finite.
    pub fn add_holder(&mut self, slider: &str, position: Vec2) -> Result<Station, SystemError> {
        self.check_name("slider", slider)?;
        let (name, motion) = (format!("{slider}_holder"), StartMotion::default());
        let (points, outline) = (Vec::new(), Vec::new());
        let body = RigidBodyDefinition { name, position, angle: 0.0, points, outline, motion };
        let station = Station::on_rigid_body(self.add_rigid_body(body, 0.0, 1.0)?, 0);
        self.join(JointKind::Rigid, station, Partner::Ground)?;
        Ok(station)
    }

    /// Initial arc length of the point of a beam that is nearest to a station [length].
    ///
    /// # Errors
    /// Fails if the station lies outside its beam.
    pub fn nearest_arc_length(&self, beam: usize, station: &Station) -> Result<f64, SystemError> {
        let definition = &self.beams[beam];
        let point = self.drawn_at(station)?;
        nearest(&definition.axis, point)
            .and_then(|xi| definition.axis.length_to(xi))
            .map_err(SystemError::geometry(&definition.name))
    }

    pub(super) fn nearest_of(
        &self,
        beams: impl Iterator<Item = usize>,
        station: &Station,
    ) -> Result<(usize, f64), SystemError> {
        let point = self.drawn_at(station)?;
        let mut best = (f64::INFINITY, (0, 0.0));
        for beam in beams {
            let along = self.nearest_arc_length(beam, station)?;
            let there = self.drawn_at(&Station::on_beam(beam, along))?;
            let distance = (there - point).norm();
            if distance < best.0 {
                best = (distance, (beam, along));
            }
        }
        Ok(best.1)
    }

    pub(in crate::system) fn check_slider(&self, slider: &Slider) -> Result<(), SystemError> {
        let parts = self.parts(slider);
        let masters = self.masters(slider);
        if slider.slave.beam().is_some_and(|beam| masters.contains(&beam)) {
            return Err(SliderError::SlaveOnMaster(parts).into());
        }
        if let (Some(_), Some(why)) = (slider.track, at_seams(slider.rule)) {
            let rule = slider.rule.entry().name;
            return Err(SliderError::RuleOfOneBeam { parts, rule, behaviour: why }.into());
        }
        if !(0.0..=1.0).contains(&slider.restitution) {
            let (slider, restitution) = (slider.name.clone(), slider.restitution);
            return Err(SliderError::Restitution { slider, restitution }.into());
        }
        if !(slider.friction >= 0.0 && slider.friction.is_finite()) {
            let (slider, friction) = (slider.name.clone(), slider.friction);
            return Err(SliderError::Friction { slider, friction }.into());
        }
        if let Some(static_friction) = slider.static_friction
            && !(static_friction >= slider.friction && static_friction.is_finite())
        {
            let (slider, friction) = (slider.name.clone(), slider.friction);
            return Err(SliderError::StaticFriction { slider, static_friction, friction }.into());
        }
        if slider.has_friction() && slider.rule != SlidingRule::Conserving {
            let (rule, slider) = (slider.rule.entry().name, slider.name.clone());
            return Err(SliderError::FrictionRule { slider, rule }.into());
        }
        self.check_side(slider)?;
        check_sleeve(slider, &self.beams[slider.master])?;
        let is_same = |other: &Slider| {
            let is_on = self.masters(other).iter().any(|master| masters.contains(master));
            is_on && same_place(&other.slave, &slider.slave, self)
        };
        if self.sliders.iter().any(is_same) {
            return Err(SliderError::Duplicate(parts).into());
        }
        let StartGap { from, to, gap, tolerance } = self.start_gap(slider)?;
        if gap <= tolerance {
            return Ok(());
        }
        let length = self.beams[slider.master].axis.length();
        let (master, best) = self.nearest_of(masters.into_iter(), &slider.slave)?;
        let distance = (from - self.drawn_at(&Station::on_beam(master, best))?).norm();
        if let Some(side) = slider.side()
            && gap <= distance + tolerance
        {
            let along = self.drawn_tangent(slider.master, slider.arc_length)?;
            return match side.sign() * cross(along, from - to) > 0.0 {
                true => Ok(()),
                false => Err(SliderError::OtherSide { parts, side: side.name(), gap }.into()),
            };
        }
        let (guide, place) = match slider.track {
            None => ("beam", best / length),
            Some(track) => {
                let along = self.length_along_track(track, master, best);
                ("track", along / self.track_length(track))
            }
        };
        let nearest = match distance <= tolerance {
            true => Approach::On { place, guide },
            false => Approach::Distant { place, guide, distance },
        };
        let place =
            |at: Vec2| written(at.map(|part| if part.abs() > tolerance { part } else { 0.0 }));
        Err(SliderError::Open { parts, from: place(from), to: place(to), gap, nearest }.into())
    }

    /// Returns true if a slider with a unilateral contact is initially at a distance from its master (in flight).
    pub(in crate::system) fn starts_apart(&self, slider: &Slider) -> Result<bool, SystemError> {
        if slider.side().is_none() {
            return Ok(false);
        }
        let StartGap { gap, tolerance, .. } = self.start_gap(slider)?;
        Ok(gap > tolerance)
    }

    fn start_gap(&self, slider: &Slider) -> Result<StartGap, SystemError> {
        let on_master = Station::on_beam(slider.master, slider.arc_length);
        let (from, to) = (self.drawn_at(&slider.slave)?, self.drawn_at(&on_master)?);
        let length = self.beams[slider.master].axis.length();
        let (gap, tolerance) = ((from - to).norm(), CLOSED * (length + from.norm()));
        Ok(StartGap { from, to, gap, tolerance })
    }

    /// First slider of the scene with a unilateral contact.
    pub fn slider_with_side(&self) -> Option<&Slider> {
        self.sliders.iter().find(|slider| slider.side().is_some())
    }

    /// Unit tangent of a beam at an arc length [-].
    ///
    /// # Errors
    /// Fails if the arc length is outside the beam.
    pub fn drawn_tangent(&self, beam: usize, arc_length: f64) -> Result<Vec2, SystemError> {
        let BeamDefinition { axis, name, .. } = &self.beams[beam];
        let tangent = axis.parameter_at(arc_length).and_then(|xi| axis.derivative(xi, 1));
        tangent.map(|tangent| tangent.normalize()).map_err(SystemError::geometry(name))
    }

    fn check_side(&self, slider: &Slider) -> Result<(), SystemError> {
        if slider.side().is_none() {
            return Ok(());
        }
        let mut refused = refused_options(slider).into_iter();
        let Some((_, what, remedy)) = refused.find(|(is_given, ..)| *is_given) else {
            return Ok(());
        };
        Err(SliderError::SideWith { slider: slider.name.clone(), what, remedy }.into())
    }

    pub(in crate::system) fn parts(&self, slider: &Slider) -> SliderParts {
        SliderParts {
            slider: slider.name.clone(),
            slave: self.describe(&slider.slave),
            guide: match slider.track {
                None => format!("beam '{}'", self.beams[slider.master].name),
                Some(track) => format!("track '{}'", self.tracks[track].name),
            },
        }
    }
}
