//! Curves that are masters of sliders, their two ends, and the states of a slider.

use serde::{Deserialize, Serialize};

use crate::geometry::{Curve, corresponding};

/// Rounding tolerance of a distance between a slider and its master, or between a slider and an end of the master [-].
/// A distance along the master is a fraction of the parameter range. A distance from the axis is a fraction of the length scale of the contact.
pub const END_TOLERANCE: f64 = 4e-15;

/// End of the master of a slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum MasterEnd {
    /// Start of the parameter range of the master.
    Start,
    /// End of the parameter range of the master.
    End,
}

impl MasterEnd {
    /// Name of the end for messages and scripts, such as `start`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::End => "end",
        }
    }

    pub(in crate::system) fn opposite(self) -> Self {
        match self {
            Self::Start => Self::End,
            Self::End => Self::Start,
        }
    }

    /// Sign of the rate of the parameter for a motion towards this end of the master [-].
    pub(in crate::system) fn outward(self) -> f64 {
        match self {
            Self::Start => -1.0,
            Self::End => 1.0,
        }
    }
}

/// State of a slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SliderState {
    /// Sliding along its master.
    Sliding,
    /// The slider is held by a stop at an end of its master.
    Held(MasterEnd),
    /// The slider is in flight: its contact is unilateral and open. The slider can land on the master again.
    Separated,
    /// Released from its master.
    Released,
}

impl SliderState {
    /// Name of the slider state for reports, such as `held`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sliding => "sliding",
            Self::Held(_) => "held",
            Self::Separated => "separated",
            Self::Released => "released",
        }
    }

    pub(in crate::system) fn has_contact(self) -> bool {
        match self {
            Self::Sliding | Self::Held(_) => true,
            Self::Separated | Self::Released => false,
        }
    }
}

/// End of a master, at which the motion of a slider along the master is limited.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct MasterLimit {
    /// Index of the slider at the limit.
    pub slider: usize,
    /// End of the master of the slider.
    pub end: MasterEnd,
}

impl MasterLimit {
    pub(in crate::system) fn both(slider: usize) -> [Self; 2] {
        [MasterEnd::Start, MasterEnd::End].map(|end| Self { slider, end })
    }
}

/// Event of a slider at which a step has to end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SliderEvent {
    /// The slider reaches a limit.
    Limit(MasterLimit),
    /// The slip of the slider with this index ends.
    SlipEnd(usize),
    /// The slip of the slider with this index starts.
    SlipStart(usize),
    /// The slider in flight with this index reaches the axis of its master.
    Landing(usize),
    /// The force of the unilateral contact of the slider with this index becomes tensile.
    TakeOff(usize),
}

const EVENTS: usize = 6;

impl SliderEvent {
    /// Index of this event among the events of all sliders.
    pub fn number(self) -> usize {
        match self {
            Self::Limit(MasterLimit { slider, end }) => EVENTS * slider + end as usize,
            Self::SlipEnd(slider) => EVENTS * slider + 2,
            Self::SlipStart(slider) => EVENTS * slider + 3,
            Self::Landing(slider) => EVENTS * slider + 4,
            Self::TakeOff(slider) => EVENTS * slider + 5,
        }
    }

    /// Event with the given index.
    pub fn of(number: usize) -> Self {
        let slider = number / EVENTS;
        match number % EVENTS {
            2 => Self::SlipEnd(slider),
            3 => Self::SlipStart(slider),
            4 => Self::Landing(slider),
            5 => Self::TakeOff(slider),
            end => Self::Limit(MasterLimit::both(slider)[end]),
        }
    }
}

/// Master of a slider: the undeformed axis of a beam as a function of the parameter of the beam's mesh.
#[derive(Debug, Clone)]
pub struct MasterCurve {
    axis: Curve,
    domain: (f64, f64),
}

impl MasterCurve {
    pub fn new(axis: Curve, domain: (f64, f64)) -> Self {
        Self { axis, domain }
    }

    /// First and last parameter of the mesh of the master [-].
    pub fn domain(&self) -> (f64, f64) {
        self.domain
    }

    pub fn length(&self) -> f64 {
        self.axis.length()
    }

    /// Parameter of the mesh at an end of the master [-].
    pub fn end(&self, end: MasterEnd) -> f64 {
        match end {
            MasterEnd::Start => self.domain.0,
            MasterEnd::End => self.domain.1,
        }
    }

    /// Distance of a parameter from an end of the master, as a fraction of the parameter range [-].
    pub fn distance(&self, parameter: f64, end: MasterEnd) -> f64 {
        let (first, last) = self.domain;
        (self.end(end) - parameter).abs() / (last - first)
    }

    /// Distance of a parameter beyond an end of the master, as a fraction of the parameter range [-]; negative inside the range.
    pub fn overshoot(&self, parameter: f64, end: MasterEnd) -> f64 {
        let (first, last) = self.domain;
        let distance = match end {
            MasterEnd::Start => first - parameter,
            MasterEnd::End => parameter - last,
        };
        distance / (last - first)
    }

    /// Returns true if a parameter is in the range of the mesh, within rounding.
    pub fn has(&self, parameter: f64) -> bool {
        let (first, last) = self.domain;
        let slack = END_TOLERANCE * (last - first);
        (first - slack..=last + slack).contains(&parameter)
    }

    /// Arc length of the undeformed master up to a parameter of its mesh, as a fraction of the whole length [-].
    pub fn part_before(&self, parameter: f64) -> f64 {
        let along = self.axis.length_to(self.drawn(parameter));
        along.map_or(f64::NAN, |along| along / self.axis.length())
    }

    /// Derivative of the arc length of the undeformed master with respect to the parameter of its mesh [length].
    pub fn stretch(&self, parameter: f64) -> f64 {
        let (start, end) = self.axis.domain();
        let (first, last) = self.domain;
        let drawn = self.axis.derivative(self.drawn(parameter), 1);
        drawn.map_or(f64::NAN, |drawn| drawn.norm()) * (end - start) / (last - first)
    }

    fn drawn(&self, parameter: f64) -> f64 {
        corresponding(parameter, self.domain, self.axis.domain())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_are_numbered_by_slider() {
        for slider in 0..3 {
            let [start, end] = MasterLimit::both(slider).map(SliderEvent::Limit);
            let friction = [SliderEvent::SlipEnd(slider), SliderEvent::SlipStart(slider)];
            let contact = [SliderEvent::Landing(slider), SliderEvent::TakeOff(slider)];
            let events = [start, end].into_iter().chain(friction).chain(contact);
            for (number, event) in (EVENTS * slider..).zip(events) {
                assert_eq!((event.number(), SliderEvent::of(number)), (number, event));
            }
        }
    }
}
