//! The beam that a slider slides on, its ends, and what a slider does there.

use serde::{Deserialize, Serialize};

use crate::geometry::{Curve, corresponding};

/// How far a slider may end beside the end of its master and still be there, relative to the master's parameters [-].
pub const LANDED: f64 = 4e-15;

/// An end of the master of a slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum MasterEnd {
    /// The end where the parameter of the master starts.
    Start,
    /// The end where the parameter of the master ends.
    End,
}

impl MasterEnd {
    /// The name of the end for messages and scripts, such as `start`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Start => "start",
            Self::End => "end",
        }
    }

    /// The other end of a beam.
    pub(in crate::system) fn opposite(self) -> Self {
        match self {
            Self::Start => Self::End,
            Self::End => Self::Start,
        }
    }

    /// The sign of `dξ/dt` with which a slider reaches the end [-].
    pub(in crate::system) fn outward(self) -> f64 {
        match self {
            Self::Start => -1.0,
            Self::End => 1.0,
        }
    }
}

/// What a slider does at present.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SliderState {
    /// The slider slides along its master.
    Sliding,
    /// The slider rests against the stop at an end of its master.
    Held(MasterEnd),
    /// The slider has left its master.
    Released,
}

impl SliderState {
    /// The state of the slider in a word, for reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sliding => "sliding",
            Self::Held(_) => "held",
            Self::Released => "released",
        }
    }
}

/// The end of a master at which a slider may arrive.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct MasterLimit {
    /// The index of the slider.
    pub slider: usize,
    /// The end of the slider's master.
    pub end: MasterEnd,
}

impl MasterLimit {
    /// The ends of the master of a slider, in the order of their numbers.
    pub(in crate::system) fn both(slider: usize) -> [Self; 2] {
        [MasterEnd::Start, MasterEnd::End].map(|end| Self { slider, end })
    }

    /// The number of this limit among those of all sliders.
    pub fn number(self) -> usize {
        2 * self.slider + self.end as usize
    }

    /// The limit of a slider by its number among those of all sliders.
    pub fn of(number: usize) -> Self {
        Self::both(number / 2)[number % 2]
    }
}

/// The master of a slider: a beam as drawn, with the parameters of its mesh.
#[derive(Debug, Clone)]
pub struct MasterCurve {
    axis: Curve,
    /// The first and the last parameter of the mesh.
    domain: (f64, f64),
}

impl MasterCurve {
    /// The rail along a beam, given by its axis as drawn and the first and the last parameter of its mesh.
    pub fn new(axis: Curve, domain: (f64, f64)) -> Self {
        Self { axis, domain }
    }

    /// The first and the last parameter of the mesh of the master [-].
    pub fn domain(&self) -> (f64, f64) {
        self.domain
    }

    /// The length of the master as drawn [length].
    pub fn length(&self) -> f64 {
        self.axis.length()
    }

    /// The parameter of an end of the master [-].
    pub fn end(&self, end: MasterEnd) -> f64 {
        match end {
            MasterEnd::Start => self.domain.0,
            MasterEnd::End => self.domain.1,
        }
    }

    /// How far a parameter is from an end of the master, as a part of all parameters [-].
    pub fn distance(&self, parameter: f64, end: MasterEnd) -> f64 {
        let (first, last) = self.domain;
        (self.end(end) - parameter).abs() / (last - first)
    }

    /// How far a parameter lies beyond an end of the master, as a part of all parameters [-]; negative before it.
    pub fn beyond(&self, parameter: f64, end: MasterEnd) -> f64 {
        let (first, last) = self.domain;
        let distance = match end {
            MasterEnd::Start => first - parameter,
            MasterEnd::End => parameter - last,
        };
        distance / (last - first)
    }

    /// Whether a parameter is one of the master's mesh, or beside an end by rounding.
    pub fn has(&self, parameter: f64) -> bool {
        let (first, last) = self.domain;
        let slack = LANDED * (last - first);
        (first - slack..=last + slack).contains(&parameter)
    }

    /// The part of the master's length as drawn that lies before a parameter [-].
    pub fn part_before(&self, parameter: f64) -> f64 {
        let along = self.axis.length_to(self.drawn(parameter));
        along.map_or(f64::NAN, |along| along / self.axis.length())
    }

    /// The length of the master as drawn that belongs to a unit of the parameter there [length].
    pub fn stretch(&self, parameter: f64) -> f64 {
        let (start, end) = self.axis.domain();
        let (first, last) = self.domain;
        let drawn = self.axis.derivative(self.drawn(parameter), 1);
        drawn.map_or(f64::NAN, |drawn| drawn.norm()) * (end - start) / (last - first)
    }

    /// The parameter of the axis as drawn.
    fn drawn(&self, parameter: f64) -> f64 {
        corresponding(parameter, self.domain, self.axis.domain())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn limits_are_numbered_in_their_order() {
        let limits: Vec<MasterLimit> = (0..3).flat_map(MasterLimit::both).collect();
        for (number, limit) in limits.into_iter().enumerate() {
            assert_eq!((limit.number(), MasterLimit::of(number)), (number, limit));
        }
    }
}
