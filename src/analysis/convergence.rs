//! Convergence study: decrease of errors with the step size or mesh size, and the observed order.

use super::observable::Observable;
use super::reference::{Deviation, ReferenceSolution};
use super::run_result::RunResult;
use crate::elementary::{ln, square};
use crate::integrators::Method;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RefinedParameter {
    Step,
    Mesh,
}

const SIGNIFICANCE: f64 = 2.0;

#[derive(Debug, Clone, PartialEq)]
pub struct Refinement {
    pub method: Method,
    pub quantity: String,
    /// Step sizes [time] or mesh sizes [-], from coarse to fine.
    pub sizes: Vec<f64>,
    /// Error at each size; `None` if the run failed.
    pub deviations: Vec<Option<Deviation>>,
}

impl Refinement {
    pub fn error(&self, rung: usize) -> Option<f64> {
        self.deviations.get(rung).copied().flatten().map(|of| of.error())
    }

    pub fn counts_for_order(&self, rung: usize) -> bool {
        let deviation = self.deviations.get(rung).copied().flatten();
        deviation.is_some_and(|of| {
            of.distance.is_finite() && of.distance > SIGNIFICANCE * of.estimated_error
        })
    }

    fn point(&self, rung: usize) -> Option<(f64, f64)> {
        let deviation = (*self.deviations.get(rung)?)?;
        self.counts_for_order(rung).then(|| (self.sizes[rung], deviation.distance))
    }

    /// Observed order `ln(e₁/e₂) / ln(h₁/h₂)` at the index `rung` of the sizes.
    /// The result is `None` if one of the errors is unknown, or at most twice the estimated error of the reference.
    /// `h₂` is the step or mesh size at `rung`, and `h₁` is the next coarser size. Their errors are `e₂` and `e₁`.
    pub fn order(&self, rung: usize) -> Option<f64> {
        let ((coarse, large), (fine, small)) =
            (self.point(rung.checked_sub(1)?)?, self.point(rung)?);
        Some(ln(large / small) / ln(coarse / fine)).filter(|order| order.is_finite())
    }

    pub fn fitted_order(&self) -> Option<f64> {
        let points: Vec<(f64, f64)> = (0..self.sizes.len())
            .filter_map(|rung| self.point(rung))
            .map(|(size, error)| (ln(size), ln(error)))
            .collect();
        let count = points.len() as f64;
        let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / count;
        let (x, y) = (mean(|point| point.0), mean(|point| point.1));
        let covariance: f64 = points.iter().map(|point| (point.0 - x) * (point.1 - y)).sum();
        let variance: f64 = points.iter().map(|point| square(point.0 - x)).sum();
        (points.len() > 1 && variance > 0.0).then(|| covariance / variance)
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Convergence {
    pub name: String,
    pub refined: RefinedParameter,
    pub fixed: String,
    /// Times at which results are compared [time].
    pub times: Vec<f64>,
    /// Length by which errors of positions are divided [length].
    pub length: f64,
    pub reference: ReferenceSolution,
    pub ladders: Vec<Refinement>,
    pub failures: Vec<(f64, Method, String)>,
}

pub const ALL_POSITIONS: &str = "positions";

impl Convergence {
    pub fn ladders_of(
        method: Method,
        rungs: &[(f64, RunResult)],
        (observables, reference_solution, length): (&[Observable], &ReferenceSolution, f64),
    ) -> Vec<Refinement> {
        let ladder = |quantity: String, read: &dyn Fn(&RunResult) -> Option<Deviation>| {
            let read =
                |(_, trial): &(f64, RunResult)| read(trial).filter(|_| trial.outcome.is_finished());
            let sizes = rungs.iter().map(|(size, _)| *size).collect();
            Refinement { method, quantity, sizes, deviations: rungs.iter().map(read).collect() }
        };
        let together = ladder(ALL_POSITIONS.to_owned(), &|trial| {
            let all = reference_solution.of_positions(observables, &trial.readings);
            all.map(|all| all.divided_by(length))
        });
        let known = (0..observables.len()).filter(|index| reference_solution.knows(*index));
        let each = known.map(|index| {
            let scale = if observables[index].is_position() { length } else { 1.0 };
            ladder(observables[index].describe(), &|trial| {
                reference_solution.deviation(index, &trial.readings).map(|of| of.divided_by(scale))
            })
        });
        std::iter::once(together).chain(each).collect()
    }

    pub fn quantities(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for name in self.ladders.iter().map(|ladder| ladder.quantity.as_str()) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names
    }

    pub fn ladders_with<'s>(&'s self, quantity: &'s str) -> impl Iterator<Item = &'s Refinement> {
        self.ladders.iter().filter(move |ladder| ladder.quantity == quantity)
    }

    /// Theoretical order of an integrator; `None` if the study does not refine steps.
    pub fn claimed_order(&self, method: &Method) -> Option<u32> {
        (self.refined == RefinedParameter::Step).then(|| method.entry().claims.order)
    }
}

#[cfg(test)]
mod tests {
    use super::super::RunLimits;
    use super::super::samples::{never, spinning};
    use super::*;
    use crate::beams::Station;
    use crate::integrators::INTEGRATORS;

    fn ladder(errors: &[Option<(f64, f64)>]) -> Refinement {
        let deviation = |(distance, trusted)| Deviation {
            distance,
            estimated_error: trusted,
            is_of_own_run: false,
        };
        Refinement {
            method: Method::EnergyMomentum,
            quantity: "q".into(),
            sizes: (0..errors.len()).map(|rung| 0.5_f64.powi(rung as i32)).collect(),
            deviations: errors.iter().map(|of| of.map(deviation)).collect(),
        }
    }

    #[test]
    fn orders_are_computed_only_from_errors_above_the_reference_error() {
        let clean = ladder(&[Some((16.0, 0.0)), Some((2.0, 0.0)), Some((0.25, 0.0))]);
        assert_eq!((clean.order(0), clean.order(1), clean.order(2)), (None, Some(3.0), Some(3.0)));
        assert!((clean.fitted_order().unwrap() - 3.0).abs() < 1e-12);
        let blurred = ladder(&[Some((16.0, 0.1)), Some((4.0, 0.1)), Some((0.01, 0.1)), None]);
        assert_eq!((blurred.order(2), blurred.order(3)), (None, None));
        assert!((blurred.fitted_order().unwrap() - 2.0).abs() < 1e-12);
        assert_eq!(blurred.error(2), Some(0.11));
        let close = ladder(&[Some((0.3, 0.1)), Some((0.15, 0.1))]);
        assert_eq!((close.counts_for_order(0), close.counts_for_order(1)), (true, false));
        assert_eq!(ladder(&[Some((1.0, 0.0))]).fitted_order(), None);
        assert_eq!(ladder(&[Some((0.0, 0.0)), Some((1.0, 0.0))]).order(1), None);
    }

    #[test]
    fn integrators_converge_at_their_claimed_order() {
        let columns = ["kinetic", "strain"].map(|name| Observable::of_column(name, name, 1.0));
        let tip = Observable::of_station("tip", Station::on_beam(0, 2.0));
        let observables: Vec<_> = tip.chain(columns).collect();
        let trial = |method: Method, dt: f64| {
            let mut case = spinning(dt, &[0.5, 1.0]);
            case.settings.method = method;
            let mut section = case.scene.beams[0].section.mean();
            (section.axial_stiffness, section.shear_stiffness) = (100.0, 100.0);
            (section.bending_stiffness, section.rotary_inertia) = (10.0, 1.0);
            case.scene.beams[0].section = section.into();
            RunResult::of(&case, &observables, RunLimits::default(), &never())
        };
        let fine = trial(Method::FourthOrder, 0.000625);
        let reference_solution = ReferenceSolution::of_run("own", &fine.readings);
        for entry in INTEGRATORS.iter().filter(|entry| entry.claims.order > 1) {
            let rungs: Vec<_> =
                [0.01, 0.005, 0.0025].map(|dt| (dt, trial(entry.method, dt))).into_iter().collect();
            let ladders = Convergence::ladders_of(
                entry.method,
                &rungs,
                (&observables, &reference_solution, 2.0),
            );
            let names: Vec<_> = ladders.iter().map(|ladder| ladder.quantity.as_str()).collect();
            assert_eq!(
                names,
                ["positions", "position of tip", "angle of tip", "kinetic", "strain"]
            );
            for ladder in &ladders[..3] {
                let order = ladder.order(2).unwrap();
                let claimed = f64::from(entry.claims.order);
                assert!(
                    (order - claimed).abs() < 0.3,
                    "{} {}: {order}",
                    entry.name,
                    ladder.quantity
                );
            }
        }
    }
}
