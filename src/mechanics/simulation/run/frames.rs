//! Selection of configurations from the trajectory.

use super::Simulation;
use crate::geometry::Vec2;
use crate::simulation::Outline;
use crate::system::SystemError;

impl Simulation {
    /// Indices of at most `most` recorded configurations between two times, spread as evenly as possible.
    pub fn frames_between(&self, from: f64, to: f64, most: usize) -> Vec<usize> {
        let trajectory = self.trajectory();
        let first = trajectory.times().partition_point(|time| *time < from);
        let end = trajectory.times().partition_point(|time| *time <= to);
        if end.saturating_sub(first) <= most {
            return (first..end).collect();
        }
        let (start, last) = (trajectory.times()[first], trajectory.times()[end - 1]);
        let pieces = most.max(2) - 1;
        let time = |frame: usize| start + (last - start) * frame as f64 / pieces as f64;
        let near = |frame| trajectory.nearest(time(frame)).unwrap_or(first);
        let mut frames: Vec<usize> = (0..=pieces).map(near).collect();
        frames.dedup();
        frames
    }

    /// Control points of all bodies in a recorded configuration: beams, then particles, then rigid bodies [length].
    pub fn control_points_at(&self, index: usize) -> Vec<Vec<Vec2>> {
        let mut numbers = self.trajectory().configuration(index).chunks_exact(2);
        let of_body = |body: &[Vec2]| {
            numbers.by_ref().take(body.len()).map(|xy| Vec2::new(xy[0], xy[1])).collect()
        };
        self.model.control_points().map(of_body).collect()
    }

    /// Outlines of the beams, followed by the outlines of rigid bodies with points off the centre.
    ///
    /// # Errors
    /// Fails if an axis has a point without a tangent.
    pub fn outlines(&self) -> Result<&[Outline], SystemError> {
        self.initial_geometry.outlines(|| Outline::of_scene(&self.scene, self.model.meshes()))
    }
}
