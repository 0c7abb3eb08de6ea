//! All combinations of meshes, integrators and step sizes.

use super::Case;
use super::observable::Observable;
use crate::integrators::Method;
use crate::simulation::SimulationSettings;
use crate::system::Scene;

#[derive(Debug, Clone)]
pub struct ObservedScene {
    pub mesh: String,
    pub scene: Scene,
    pub observables: Vec<Observable>,
}

impl ObservedScene {
    pub fn spans(&self) -> usize {
        self.scene.beams.iter().map(|beam| beam.mesh.spans()).sum()
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    pub subject: usize,
    pub settings: SimulationSettings,
}

impl Combination {
    pub fn case(&self, subjects: &[ObservedScene], stops: &[f64]) -> Case {
        let scene = subjects[self.subject].scene.clone();
        Case { scene, settings: self.settings, stops: stops.to_vec() }
    }
}

pub fn all_combinations(
    subjects: &[ObservedScene],
    settings: &[SimulationSettings],
) -> Vec<Combination> {
    let with = |subject| settings.iter().map(move |settings| (subject, *settings));
    let pairs = (0..subjects.len()).flat_map(with);
    pairs.map(|(subject, settings)| Combination { subject, settings }).collect()
}

pub fn finest_mesh(subjects: &[ObservedScene]) -> Option<usize> {
    (0..subjects.len()).max_by_key(|index| subjects[*index].spans())
}

pub fn highest_order(methods: &[Method]) -> Option<Method> {
    methods.iter().copied().rev().max_by_key(|method| method.entry().claims.order)
}

/// Step size of the reference run, as a fraction of the smallest step size in the study.
/// With a second-order integrator, the error of the reference run is a sixteenth of the smallest error in the study.
pub const PART_OF_THE_SMALLEST_STEP: f64 = 0.25;

#[cfg(test)]
mod tests {
    use super::super::samples::spinning;
    use super::*;

    #[test]
    fn combinations_contain_all_cases_and_the_finest_is_selected() {
        let subject = |mesh: &str, spans: usize| {
            let mut scene = spinning(0.1, &[1.0]).scene;
            scene.beams[0].mesh = crate::beams::Mesh::bspline(spans, 3, 2).unwrap();
            ObservedScene { mesh: mesh.to_owned(), scene, observables: Vec::new() }
        };
        let subjects = [subject("a", 2), subject("b", 8), subject("c", 4)];
        let methods = [Method::EnergyMomentum, Method::FourthOrder, Method::Trapezoidal];
        let usual = spinning(0.1, &[1.0]).settings;
        let settings = methods.map(|method| SimulationSettings { method, ..usual });
        let all = all_combinations(&subjects, &settings);
        assert_eq!(all.len(), 9);
        assert_eq!((all[8].subject, all[8].settings), (2, settings[2]));
        assert_eq!(all[8].case(&subjects, &[3.0]).scene.beams[0].mesh.spans(), 4);
        assert_eq!(finest_mesh(&subjects), Some(1));
        assert_eq!(highest_order(&methods), Some(Method::FourthOrder));
        assert_eq!(
            highest_order(&[Method::Trapezoidal, Method::EnergyMomentum]),
            Some(Method::Trapezoidal)
        );
        assert_eq!((finest_mesh(&[]), highest_order(&[])), (None, None));
    }
}
