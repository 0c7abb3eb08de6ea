//! Blocks of the linear system in which the contact and the slave of each slider are eliminated independently.

use super::Numbering;
use crate::linalg::BlockLayout;
use crate::system::Scene;
use crate::system::scene::Ties;
use crate::system::sliders::SliderContact;

/// Smallest number of sliders for block-wise elimination of contacts in scenes without contact between bodies.
/// For fewer sliders, the contact unknowns in a dense border of the band matrix are faster (docs/studies.md).
const MANY: usize = 4;

/// Largest number of control points of a slave that is eliminated together with its contact.
const MOST_POINTS: usize = 4;

impl Numbering {
    /// Blocks of the sliders; `None` if a dense border of the band matrix is faster.
    /// Scenes with contact between bodies always have blocks, because contact couples distant unknowns.
    pub fn contact_blocks(&self, scene: &Scene, sliders: &[SliderContact]) -> Option<BlockLayout> {
        let touches = scene.contacts().next().is_some();
        if sliders.len() < MANY && !touches {
            return None;
        }
        let mut coupled = Ties::new(self.unknowns);
        for pair in self.groups.iter().flat_map(|group| group.windows(2)) {
            coupled.unite(pair[0], pair[1]);
        }
        let component: Vec<usize> = (0..self.unknowns).map(|at| coupled.root(at)).collect();
        let mut sizes = vec![0_usize; self.unknowns];
        component.iter().for_each(|&of| sizes[of] += 1);
        let unknown = |at: &usize| *at < self.unknowns;
        let mut sliders_on = vec![0_usize; self.unknowns];
        for slider in sliders {
            let (body, point) = slider.connection.slave;
            let [x, y, _] = self.degrees_of_freedom[body][point];
            let mut roots = [x, y].map(|at| unknown(&at).then(|| component[at]));
            if roots[0] == roots[1] {
                roots[1] = None;
            }
            roots.into_iter().flatten().for_each(|root| sliders_on[root] += 1);
        }
        // A slave can be eliminated together with its contact if its unknowns are coupled to no other body and to no other slider.
        let own = sliders.iter().map(|slider| {
            let own = self.unknowns_of_free_slave(slider);
            let root = component[*own.first()?];
            let is_one = own.iter().all(|at| component[*at] == root);
            // A contact between bodies may couple the unknowns of the slave with those of other bodies.
            let is_alone = is_one && sizes[root] == own.len() && sliders_on[root] == 1;
            (is_alone && !touches).then_some(own)
        });
        let own = own.map(Option::unwrap_or_default);
        Some(BlockLayout {
            own: own.collect(),
            groups: self.groups.clone().into(),
            block_entries: sliders.iter().map(SliderContact::usual_entries).max().unwrap_or(0),
        })
    }

    fn unknowns_of_free_slave(&self, slider: &SliderContact) -> Vec<usize> {
        let body = slider.connection.slave.0;
        if slider.couples_rotations() {
            return Vec::new();
        }
        let points = &self.degrees_of_freedom[body];
        let is_free = points.iter().all(|[x, y, _]| [x, y].iter().all(|at| **at < self.unknowns));
        if !is_free || points.len() > MOST_POINTS {
            return Vec::new();
        }
        let rotations = points.iter().map(|degrees| degrees[2]).filter(|at| *at < self.unknowns);
        let links = self.links.iter().filter(|link| link.body == body);
        let mut own: Vec<usize> = points.iter().flat_map(|[x, y, _]| [*x, *y]).collect();
        own.extend(rotations.chain(links.flat_map(|link| link.force)));
        own.sort_unstable();
        own.dedup();
        own
    }
}
