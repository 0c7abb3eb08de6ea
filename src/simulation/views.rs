//! Looking at a simulation: places, paths and configurations to draw.

use super::{Configuration, Outline, Simulation};
use crate::beams::{Place, Station};
use crate::geometry::Vec2;
use crate::model::ModelError;

impl Simulation {
    /// The place of a station on its body.
    ///
    /// # Errors
    /// When it lies outside its beam.
    pub fn place(&self, station: &Station) -> Result<Place, ModelError> {
        self.scene.place(station, self.model.meshes())
    }

    /// Where a place was, at all times of the trajectory.
    pub fn path(&self, place: &Place) -> Vec<(f64, Vec2)> {
        let counts: Vec<usize> = self.model.control_points().map(<[Vec2]>::len).collect();
        let offset = counts[..place.body].iter().sum::<usize>();
        let at = |index: usize| -> Vec2 {
            let numbers = self.trajectory.configuration(index);
            place
                .weights()
                .map(|(point, w)| {
                    Vec2::new(numbers[2 * (offset + point)], numbers[2 * (offset + point) + 1]) * w
                })
                .sum()
        };
        self.trajectory.times().iter().enumerate().map(|(index, &time)| (time, at(index))).collect()
    }

    /// The configuration nearest to a time, as it is drawn; none before there is one.
    ///
    /// # Errors
    /// When an axis has a point without a tangent.
    pub fn configuration_near(&self, time: f64) -> Result<Option<Configuration>, ModelError> {
        let Some(index) = self.trajectory.nearest(time) else { return Ok(None) };
        let points: Vec<Vec2> = self
            .trajectory
            .configuration(index)
            .chunks_exact(2)
            .map(|xy| Vec2::new(xy[0], xy[1]))
            .collect();
        let mut rest = points.as_slice();
        let bodies: Vec<&[Vec2]> = self
            .model
            .control_points()
            .map(|body| {
                let (own, others) = rest.split_at(body.len());
                rest = others;
                own
            })
            .collect();
        let outlines = match self.outlines.get() {
            Some(outlines) => outlines,
            None => {
                let outlines = Outline::of_scene(&self.scene, self.model.meshes())?;
                self.outlines.get_or_init(|| outlines)
            }
        };
        Ok(Some(Outline::draw(outlines, self.trajectory.times()[index], &bodies)))
    }
}
