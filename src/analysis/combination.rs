//! Meshes, integrators and step sizes in all combinations.

use super::Case;
use super::observable::Observable;
use crate::integrators::Method;
use crate::simulation::SimulationSettings;
use crate::system::Scene;

/// A scene on a mesh, and what is looked at in it.
#[derive(Debug, Clone)]
pub struct ObservedScene {
    /// The name of the mesh.
    pub mesh: String,
    /// The scene on the mesh.
    pub scene: Scene,
    /// What is looked at in the scene.
    pub observables: Vec<Observable>,
}

impl ObservedScene {
    /// The spans of all beams together, a measure of how fine the mesh is.
    pub fn spans(&self) -> usize {
        self.scene.beams.iter().map(|beam| beam.mesh.spans()).sum()
    }
}

/// One way to compute something: a mesh, an integrator and its step size.
#[derive(Debug, Clone, PartialEq)]
pub struct Combination {
    /// The index of the subject, a scene on a mesh.
    pub subject: usize,
    /// Integrator and step size of the combination.
    pub settings: SimulationSettings,
}

impl Combination {
    /// The run that the combination asks for.
    pub fn case(&self, subjects: &[ObservedScene], stops: &[f64]) -> Case {
        let scene = subjects[self.subject].scene.clone();
        Case { scene, settings: self.settings, stops: stops.to_vec() }
    }
}

/// All combinations of subjects and settings, mesh by mesh.
pub fn all_combinations(
    subjects: &[ObservedScene],
    settings: &[SimulationSettings],
) -> Vec<Combination> {
    let with = |subject| settings.iter().map(move |settings| (subject, *settings));
    let pairs = (0..subjects.len()).flat_map(with);
    pairs.map(|(subject, settings)| Combination { subject, settings }).collect()
}

/// The index of the subject with the most spans; of equal ones the last.
pub fn finest_mesh(subjects: &[ObservedScene]) -> Option<usize> {
    (0..subjects.len()).max_by_key(|index| subjects[*index].spans())
}

/// The method of the highest order among some; of equal ones the first.
pub fn highest_order(methods: &[Method]) -> Option<Method> {
    methods.iter().copied().rev().max_by_key(|method| method.entry().claims.order)
}

/// The part of the smallest step size that a reference run of our own takes: at second order its error is a sixteenth of
/// that of the best run it judges.
pub const PART_OF_THE_SMALLEST_STEP: f64 = 0.25;

#[cfg(test)]
mod tests {
    use super::super::samples::spinning;
    use super::*;

    #[test]
    fn a_full_product_and_the_finest_of_all() {
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
