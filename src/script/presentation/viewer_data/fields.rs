//! Quantities for the colours of beams in the viewer.

use super::FrameSelection;
use crate::geometry::Vec2;
use crate::output::viewer::ColourField;
use crate::script::presentation::quantities::BeamQuantity;
use crate::simulation::{Axes, AxisStation, Outline, Simulation};
use crate::system::{BeamPlaces, SystemError};

struct FieldKind {
    name: &'static str,
    source: FieldSource,
}

enum FieldSource {
    /// Speed of the axis [length/time], computed from the configurations of the previous and next frame.
    AdjacentFrames,
    /// Function of a point on the axis and the control points of a frame, and the dimension of its value.
    Axis(fn(&AxisStation, &[Vec2]) -> f64, &'static str),
    State,
}

const fn kind(name: &'static str, source: FieldSource) -> FieldKind {
    FieldKind { name, source }
}

/// All fields in the order of [`FIELDS`]. The stretch is the relative elongation of the axis [-].
/// The field `curvature` is the change of the axis curvature since the start [1/length].
const KINDS: [FieldKind; 7] = [
    kind("speed", FieldSource::AdjacentFrames),
    kind("M", FieldSource::State),
    kind("strain_energy", FieldSource::State),
    kind("N", FieldSource::State),
    kind("Q", FieldSource::State),
    kind("stretch", FieldSource::Axis(AxisStation::stretch, "-")),
    kind("curvature", FieldSource::Axis(AxisStation::curvature, "1/length")),
];

pub(crate) const FIELDS: [&str; 7] =
    ["speed", "M", "strain_energy", "N", "Q", "stretch", "curvature"];

/// Fields that are computed, frame by frame, from states of a simulation.
pub struct FieldReader {
    beams: Vec<BeamPlaces>,
    taken: Vec<(&'static BeamQuantity, Vec<Vec<f64>>)>,
}

impl FieldReader {
    /// Allocates the named fields for the given number of frames; `None` if none of them needs states of the simulation.
    ///
    /// # Errors
    /// Fails if the axis of a beam has a point without a tangent.
    pub fn of(
        simulation: &Simulation,
        frames: usize,
        names: &[&str],
    ) -> Result<Option<Self>, SystemError> {
        let is_wanted = |kind: &&FieldKind| {
            matches!(kind.source, FieldSource::State) && names.contains(&kind.name)
        };
        let quantities =
            KINDS.iter().filter(is_wanted).filter_map(|kind| BeamQuantity::named(kind.name));
        let taken: Vec<_> =
            quantities.map(|quantity| (quantity, vec![Vec::new(); frames])).collect();
        if taken.is_empty() {
            return Ok(None);
        }
        let places = |(beam, mesh): (usize, &crate::beams::Mesh)| {
            let within = Outline::stations_within_a_span(mesh.basis().degree());
            Ok(simulation.places_along(beam, within)?.deduplicate_places())
        };
        let meshes = simulation.model().meshes().iter().enumerate();
        Ok(Some(Self { beams: meshes.map(places).collect::<Result<_, SystemError>>()?, taken }))
    }

    /// Computes the values of a frame from a state and stores them.
    pub fn store_frame(&mut self, frame: usize, state: &Simulation) {
        for places in &self.beams {
            let samples = state.sample_along(places);
            for (quantity, frames) in &mut self.taken {
                frames[frame].extend(samples.iter().map(quantity.of));
            }
        }
    }

    /// Fields of the viewer data.
    pub fn fields(self) -> Vec<ColourField> {
        let field = |(quantity, values): (&BeamQuantity, _)| ColourField {
            name: quantity.words.to_owned(),
            unit: quantity.dimension.to_owned(),
            values,
        };
        self.taken.into_iter().map(field).collect()
    }
}

pub(super) fn fields(
    simulation: &Simulation,
    shown: &FrameSelection,
    names: &[&str],
    inside: Vec<ColourField>,
) -> Result<Vec<ColourField>, SystemError> {
    let stations = Axes::of(simulation.scene())?.stations()?;
    let mut inside = inside.into_iter();
    let field = |kind: &FieldKind| {
        let (unit, values) = match kind.source {
            FieldSource::State => return inside.next(),
            FieldSource::Axis(value, unit) => (unit, along_axes(shown, &stations, value)),
            FieldSource::AdjacentFrames => {
                let speeds = |&index: &usize| speeds(simulation, &stations, index);
                ("length/time", shown.indices.iter().map(speeds).collect())
            }
        };
        Some(ColourField { name: kind.name.to_owned(), unit: unit.to_owned(), values })
    };
    Ok(KINDS.iter().filter(|kind| names.contains(&kind.name)).filter_map(field).collect())
}

fn along_axes(
    shown: &FrameSelection,
    stations: &[Vec<AxisStation>],
    value: fn(&AxisStation, &[Vec2]) -> f64,
) -> Vec<Vec<f64>> {
    let of_beam = |(stations, points): (&Vec<AxisStation>, &Vec<Vec2>)| {
        stations.iter().map(|at| value(at, points)).collect::<Vec<_>>()
    };
    let of_frame =
        |bodies: &Vec<Vec<Vec2>>| stations.iter().zip(bodies).flat_map(of_beam).collect();
    shown.frames.iter().map(of_frame).collect()
}

fn speeds(simulation: &Simulation, stations: &[Vec<AxisStation>], index: usize) -> Vec<f64> {
    let times = simulation.trajectory().times();
    let (before, after) = (index.saturating_sub(1), (index + 1).min(times.len() - 1));
    let duration = times[after] - times[before];
    let (start, end) = (simulation.control_points_at(before), simulation.control_points_at(after));
    let of_beam = |(stations, (start, end)): (&Vec<AxisStation>, (&Vec<Vec2>, &Vec<Vec2>))| {
        let speed = |at: &AxisStation| (at.position(end) - at.position(start)).norm() / duration;
        stations.iter().map(speed).collect::<Vec<_>>()
    };
    stations.iter().zip(start.iter().zip(&end)).flat_map(of_beam).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn field_names_agree_with_their_kinds_and_quantities() {
        assert_eq!(KINDS.each_ref().map(|kind| kind.name), FIELDS);
        let of_states = KINDS.iter().filter(|kind| matches!(kind.source, FieldSource::State));
        assert!(of_states.into_iter().all(|kind| BeamQuantity::named(kind.name).is_some()));
    }
}
