//! Largest section forces, strain residual and rotation over quadrature points, computed in vector lanes.

use pulp::Simd;

use super::dynamics::ForceSummary;
use super::simd::{LaneChunk, Lanes, Number, Vector};

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct ForceMaxima<T> {
    pub(super) strain_mismatch: T,
    pub(super) force: T,
    pub(super) moment: T,
    pub(super) rotation: T,
}

impl ForceMaxima<Lanes> {
    #[inline(always)]
    pub(super) fn join<V: Simd>(&mut self, part: LaneChunk<V>, met: ForceMaxima<Vector<V>>) {
        self.rotation.put(part, self.rotation.get(part).larger(met.rotation));
        self.join_force(part, met.force);
        self.join_moment(part, met.strain_mismatch, met.moment);
    }

    #[inline(always)]
    fn join_force<V: Simd>(&mut self, part: LaneChunk<V>, force: Vector<V>) {
        self.force.put(part, self.force.get(part).larger(force));
    }

    #[inline(always)]
    pub(super) fn join_moment<V: Simd>(
        &mut self,
        part: LaneChunk<V>,
        strain_mismatch: Vector<V>,
        moment: Vector<V>,
    ) {
        let mismatch = self.strain_mismatch.get(part).larger(strain_mismatch);
        self.strain_mismatch.put(part, mismatch);
        self.moment.put(part, self.moment.get(part).larger(moment));
    }

    #[inline(always)]
    pub(super) fn join_to(&self, summary: &mut ForceSummary) {
        let (mismatch, force) = (self.strain_mismatch.numbers(), self.force.numbers());
        let (moment, rotation) = (self.moment.numbers(), self.rotation.numbers());
        for lane in 0..mismatch.len() {
            summary.join(&ForceSummary {
                strain_mismatch: mismatch[lane],
                force: force[lane],
                moment: moment[lane],
                rotation: rotation[lane],
            });
        }
    }
}
