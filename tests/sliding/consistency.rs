//! Laws of sliding at states that are no solutions: derivatives, and the identities that the conservation properties follow from.
#![allow(clippy::unwrap_used)]

use crate::common::probe::{self, STEP, differences};
use crate::common::{Random, meshes, sleeve_scenes, sliding_scenes};
use nalgebra::{DMatrix, DVector};
use withy::beams::{Mesh, unresolved_kink};
use withy::geometry::{ContactPath, Curve, PiecewisePolynomial, Vec2, cross, interpolate};
use withy::integrators::{Constraints, Mechanism, Stage};
use withy::joints::{
    Conserving, Contact, ContactUnknowns, Exact, Frozen, HeldSlider, Kink, KinkMotion, KinkState,
    Kinked, Relaxed, Released, SLIDING_RULES, SlidingLaw, SlidingRule, Unit,
};
use withy::linalg::BorderedMatrix;
use withy::system::{MasterEnd, MasterLimit, System};

const LAWS: [(&str, &dyn SlidingLaw); 7] = [
    ("frozen", &Frozen),
    ("kinked", &Kinked),
    ("conserving", &Conserving),
    ("exact", &Exact),
    ("relaxed", &Relaxed),
    ("held", &HeldSlider),
    ("released", &Released),
];

/// Random contact: positions of the master before the step and their increments, the displacement of the slave from the origin, and the unknowns.
#[derive(Clone)]
struct State {
    name: String,
    before: Vec<Vec2>,
    moved: Vec<Vec2>,
    slave_moved: Vec2,
    unknowns: ContactUnknowns,
    from: f64,
    length: f64,
    mesh: Mesh,
    /// Kink length [length], compliance [1/force] and tangent jump (as a force) at the start of the step, for meshes with kink lengths.
    kink: Option<(PiecewisePolynomial, f64, Vec2)>,
}

/// Kink lengths of a mesh with an axis of a given length.
fn kink_of(mesh: &Mesh, length: f64) -> Option<PiecewisePolynomial> {
    let axis = Curve::line(Vec2::zeros(), Vec2::new(length, 0.0)).unwrap();
    unresolved_kink(mesh, &interpolate(&axis, mesh.basis()).unwrap())
        .unwrap()
        .map(|kink| kink.length)
}

/// Arc length along a mesh with a straight axis of a given length.
fn arc_of(mesh: &Mesh, length: f64) -> PiecewisePolynomial {
    PiecewisePolynomial::integral(&mesh.basis().spans(), 2, |_, xi| length * (1.0 + 0.2 * xi))
}

impl State {
    /// Evaluates `f` for the contact with all variables from a list of numbers: slave, master, `λ`, `η`, `Δξ`.
    fn with<T>(&self, numbers: &[f64], f: impl FnOnce(&Contact<'_>, &ContactPath) -> T) -> T {
        let vector = |at: usize| Vec2::new(numbers[at], numbers[at + 1]);
        let last = numbers.len() - 5;
        let moved: Vec<Vec2> = (2..last).step_by(2).map(vector).collect();
        let unknowns = ContactUnknowns::of(std::array::from_fn(|k| numbers[last + k]));
        let mut passage = ContactPath::new(self.mesh.basis().clone());
        passage.set_interval(self.from, self.from + unknowns.increment);
        let window = passage.first()..passage.first() + passage.end().len();
        let (before, moved) = (&self.before[window.clone()], &moved[window]);
        let kink = self.kink.as_ref().map(|(length, compliance, before)| Kink {
            along: passage.along(length),
            compliance: *compliance,
            before: *before,
            motion: KinkMotion {
                arc: passage.along(&arc_of(&self.mesh, self.length)),
                speed: 0.28 * self.length,
                inverse_square_speed: 0.6 / self.length.powi(2),
                duration: 1.3,
            },
        });
        let contact = Contact {
            path: &passage,
            master: (before, moved),
            slave_movement: vector(0),
            unknowns,
            kink,
            friction: None,
            sleeve: None,
            length: self.length,
        };
        f(&contact, &passage)
    }

    fn numbers(&self) -> Vec<f64> {
        let vectors = std::iter::once(&self.slave_moved).chain(&self.moved);
        vectors.flat_map(|v| [v.x, v.y]).chain(self.unknowns.to_array()).collect()
    }
}

/// Contacts on every mesh: within a span, across knots, for tiny and zero increments, and starting at a knot.
fn states() -> Vec<State> {
    let mut random = Random(31);
    let mut states = Vec::new();
    for (name, mesh) in meshes(4) {
        let functions = mesh.basis().functions();
        let ways = [(0.30, 0.1), (0.30, 0.55), (0.8, -0.7), (0.4, 1e-7), (0.4, 0.0), (0.5, 0.2)];
        for (from, way) in ways {
            let mut vector = |size: f64| Vec2::new(random.next(), random.next()) * size;
            states.push(State {
                name: format!("{name}, {from} + {way}"),
                before: (0..functions).map(|_| vector(3.0)).collect(),
                moved: (0..functions).map(|_| vector(1.0)).collect(),
                slave_moved: vector(1.0),
                unknowns: ContactUnknowns {
                    force: vector(5.0),
                    couple: vector(2.0),
                    increment: way,
                },
                from,
                length: 2.5,
                kink: kink_of(&mesh, 2.5).map(|length| (length, 0.03, vector(5.0))),
                mesh: mesh.clone(),
            });
        }
    }
    states
}

fn assert_close(what: &str, found: &DMatrix<f64>, expected: &DMatrix<f64>, tolerance: f64) {
    let error = (found - expected).amax() / expected.amax().max(1.0);
    assert!(error < tolerance, "{what}: off by {error:.1e} of the largest entry");
}

#[test]
fn the_derivatives_of_every_law_are_those_of_its_equations() {
    for state in states() {
        let numbers = state.numbers();
        for (law_name, law) in LAWS {
            // The relaxed rule is not differentiable at the zero increment.
            if law_name == "relaxed" && state.unknowns.increment.abs() < 1e-3 {
                continue;
            }
            let found = state.with(&numbers, |contact, passage| {
                let equations = law.equations(contact);
                let values = equations.map(|equation| equation.value.to_bits());
                let alone = law.values(contact).map(|(value, _)| value.to_bits());
                assert_eq!(alone, values, "{law_name}, {}: values without derivatives", state.name);
                let rows = equations.map(|equation| {
                    let mut row = vec![0.0; numbers.len()];
                    let last = numbers.len() - 5;
                    row[..2].copy_from_slice(equation.by_slave.as_slice());
                    for (index, weights) in contact.weights().enumerate() {
                        let at = 2 + 2 * (passage.first() + index);
                        let slope = equation.by_master(weights);
                        (row[at], row[at + 1]) = (slope.x, slope.y);
                    }
                    row[last..].copy_from_slice(&equation.by_unknowns.to_array());
                    row
                });
                DMatrix::from_fn(5, numbers.len(), |i, j| rows[i][j])
            });
            let expected = differences(&numbers, 1e-4, &mut |numbers| {
                state.with(numbers, |contact, _| law.equations(contact).map(|e| e.value).to_vec())
            });
            // Second derivatives of quadratic and linear elements jump at knots, so differences with respect to `Δξ` are wrong there.
            let smooth = state.from != 0.5 && state.unknowns.increment.abs() > 1e-3;
            let columns = if smooth { numbers.len() } else { numbers.len() - 1 };
            let label = format!("{law_name}, {}", state.name);
            let (found, expected) = (found.columns(0, columns), expected.columns(0, columns));
            assert_close(&label, &found.into_owned(), &expected.into_owned(), 1e-8);
        }
    }
}

#[test]
fn derivatives_by_the_increment_hold_near_zero() {
    for state in states().iter().filter(|state| state.unknowns.increment.abs() < 1e-3) {
        let numbers = state.numbers();
        for (law_name, law) in LAWS.into_iter().filter(|(name, _)| *name != "relaxed") {
            let found =
                state.with(&numbers, |c, _| law.equations(c).map(|e| e.by_unknowns.increment));
            let mut only_way = |way: &[f64]| {
                let mut numbers = numbers.clone();
                *numbers.last_mut().unwrap() = way[0];
                state.with(&numbers, |contact, _| law.equations(contact).map(|e| e.value).to_vec())
            };
            let expected = differences(&[state.unknowns.increment], 2e-4, &mut only_way);
            let found = DMatrix::from_column_slice(5, 1, &found);
            assert_close(&format!("{law_name}, {}", state.name), &found, &expected, 1e-8);
        }
    }
}

/// Force, moment and work of a contact on slave and master at their mean positions, without the gap.
fn balance(state: &State, contact: &Contact<'_>, passage: &ContactPath) -> (Vec2, f64, f64) {
    let force = contact.unknowns.force;
    let mean_slave = state.slave_moved * 0.5;
    let mut sum = (-force, -cross(mean_slave, force), -force.dot(&state.slave_moved));
    for (index, force) in contact.master_forces().enumerate() {
        let at = passage.first() + index;
        sum.0 += force;
        sum.1 += cross(state.before[at] + state.moved[at] * 0.5, force);
        sum.2 += force.dot(&state.moved[at]);
    }
    sum
}

#[test]
fn contact_is_balanced_up_to_the_residuals_of_its_equations() {
    for mut state in states() {
        state.kink = None;
        state.with(&state.numbers(), |contact, passage| {
            let (force, moment, work) = balance(&state, contact, passage);
            let ContactUnknowns { force: lambda, couple: eta, increment: way } = contact.unknowns;
            let (tau, d) = (contact.tangent().value, contact.tangent_change().value);
            let (gap_before, gap) =
                (-contact.start_gap(), state.slave_moved - contact.end_point().value);
            let close = |what: &str, found: f64, expected: f64| {
                let error = (found - expected).abs();
                assert!(error < 1e-11, "{what}, {}: {found} is not {expected}", state.name);
            };
            close("force along x", force.x, 0.0);
            close("force along y", force.y, 0.0);
            let turning =
                way * (cross(tau, eta) + cross(d, lambda)) + cross(gap_before + gap, lambda) * 0.5;
            close("moment", moment, -turning);
            let lost =
                way * (4.0 * eta.dot(&d) + lambda.dot(&tau)) + lambda.dot(&(gap - gap_before));
            close("work", work, -lost);

            let length = contact.length;
            let [x, y, cx, cy, sliding] = Conserving.equations(contact).map(|e| e.value);
            close("the gap along x", x, gap.x);
            close("the gap along y", y, gap.y);
            close("sliding", sliding * length, lambda.dot(&tau) + 4.0 * eta.dot(&d));
            let couple = Vec2::new(cx, cy) * length.powi(2);
            close(
                "couple",
                cross(tau, couple) / tau.norm_squared(),
                cross(tau, eta) + cross(d, lambda),
            );
            close(
                "no more couple than needed",
                couple.dot(&tau),
                eta.dot(&tau) * tau.norm_squared(),
            );

            close("exact sliding", Exact.equations(contact)[4].value * length, lambda.dot(&tau));

            // Without the couple, the balances of the relaxed rule follow from its equations.
            if way.abs() > 1e-3 {
                let [x, y, .., sliding] = Relaxed.equations(contact).map(|e| e.value);
                let mean_gap = Vec2::new(x, y);
                let no_couple = moment + way * cross(tau, eta);
                close("relaxed moment", no_couple, -cross(mean_gap, lambda));
                let no_couple = work + way * 4.0 * eta.dot(&d);
                close(
                    "relaxed work",
                    no_couple,
                    -2.0 * lambda.dot(&mean_gap) - way * sliding * length,
                );
            }
        });
    }
}

/// Changes the position of the slave, the couple and the tangential force until all equations of a law with a kink hold.
fn solve_kinked(state: &mut State, law: &dyn SlidingLaw) {
    let start_gap = |state: &State| state.with(&state.numbers(), |contact, _| contact.start_gap());
    let (length, compliance, before) = state.kink.clone().unwrap();
    let offset = state
        .with(&state.numbers(), |_, passage| before * (passage.along(&length).start * compliance));
    let shift = -offset - start_gap(state);
    state.before.iter_mut().for_each(|point| *point += shift);
    for _ in 0..30 {
        let correction = state.with(&state.numbers(), |contact, _| {
            let along = contact.tangent().value.normalize();
            let equations = law.equations(contact);
            let value = DVector::from_iterator(5, equations.iter().map(|e| e.value));
            let slope = DMatrix::from_fn(5, 5, |row, column| {
                let equation = &equations[row];
                let ContactUnknowns { force, couple, .. } = equation.by_unknowns;
                let s = equation.by_slave;
                [s.x, s.y, couple.x, couple.y, force.dot(&along)][column]
            });
            let by = slope.lu().solve(&value).unwrap();
            ([by[0], by[1], by[2], by[3]], along * by[4])
        });
        let ([x, y, couple_x, couple_y], force) = correction;
        state.slave_moved -= Vec2::new(x, y);
        state.unknowns.couple -= Vec2::new(couple_x, couple_y);
        state.unknowns.force -= force;
    }
}

#[test]
fn contact_on_a_kinked_axis_conserves_momenta_and_total_energy() {
    let laws: [&dyn SlidingLaw; 2] = [&Kinked, &Frozen];
    let states = states().into_iter().filter(|state| state.kink.is_some());
    for (mut state, law) in states.flat_map(|state| laws.map(|law| (state.clone(), law))) {
        // Scales the state to small increments and small kinks, as on realistic beams.
        let count = state.before.len();
        for (at, point) in state.before.iter_mut().enumerate() {
            *point = *point * 0.03 + Vec2::new(at as f64 / (count - 1) as f64 * 2.5, 0.0);
        }
        state.moved.iter_mut().for_each(|moved| *moved *= 0.2);
        state.unknowns.force *= 0.05;
        state.kink.iter_mut().for_each(|(.., before)| *before *= 0.05);
        solve_kinked(&mut state, law);
        state.with(&state.numbers(), |contact, passage| {
            let largest =
                law.equations(contact).map(|e| e.value.abs()).into_iter().fold(0.0, f64::max);
            assert!(largest < 1e-13, "{}: no solution, {largest:.1e}", state.name);
            let (force, moment, work) = balance(&state, contact, passage);
            let kink = contact.kink.unwrap();
            let KinkState { jump, speed } = law.kink_at_end(contact);
            let energy = |g: f64, p: Vec2, v: f64| {
                0.5 * g
                    * p.norm_squared()
                    * kink.compliance
                    * (1.0 + kink.motion.inverse_square_speed * v * v)
            };
            let gained = energy(kink.along.end, jump, speed)
                - energy(kink.along.start, kink.before, kink.motion.speed);
            println!(
                "{}: work {work:.3e}, kink gains {gained:.3e}, v {} to {speed:.3}",
                state.name, kink.motion.speed
            );
            assert!(force.norm() < 1e-14, "{}: force {force:?}", state.name);
            assert!(moment.abs() < 1e-13, "{}: moment {moment:.1e}", state.name);
            assert!((work + gained).abs() < 1e-13, "{}: energy {work:e} {gained:e}", state.name);
        });
    }
}

#[test]
fn constraint_border_of_every_scene_is_the_derivative_of_forces_and_equations() {
    let mut random = Random(77);
    for entry in SLIDING_RULES {
        for (mesh_name, mesh) in meshes(4) {
            let mut scenes = sliding_scenes::all(&mesh, entry.rule);
            if entry.rule == SlidingRule::Conserving {
                scenes.extend(sleeve_scenes::all(&mesh));
            }
            for scene in scenes {
                let mut model = System::assemble(&scene).unwrap();
                let first = random.vector(model.unknowns(), 0.05);
                probe::settle(&mut model, Stage::Midpoint, &first);
                advance_sliders(&mut model, &first, &mut random);
                for state in ["sliding", "held", "released"] {
                    for slider in 0..scene.sliders.len() {
                        match state {
                            "held" => {
                                model.hold_at_stop(MasterLimit { slider, end: MasterEnd::Start })
                            }
                            "released" => model.release_slider(slider),
                            _ => {}
                        }
                    }
                    let label = format!("{}, {}, {mesh_name}, {state}", entry.name, scene.name);
                    assert_border(&label, &mut model, &mut random);
                }
            }
        }
    }
}

/// Advances with random contact forces and increments `Δξ`.
fn advance_sliders(model: &mut System, increments: &[f64], random: &mut Random) {
    model.begin_step(STEP, &Stage::ALL).unwrap();
    let contacts = random.vector(model.constraint_shape().width, 0.1);
    let residual = vec![0.0; model.degrees_of_freedom()];
    let rates = model.rates().to_vec();
    model.advance(&withy::integrators::Solution {
        increments,
        constraints: &contacts,
        rates: &rates,
        residual: &residual,
        balanced: &[],
    });
}

fn assert_border(label: &str, model: &mut System, random: &mut Random) {
    let (movements, shape) = (model.unknowns(), model.constraint_shape());
    let mut unknowns = random.vector(movements + shape.width, 0.05);
    // Increments must be large enough for differences of the relaxed rule, and forces not too small.
    for (index, value) in unknowns[movements..].iter_mut().enumerate() {
        *value = if index % 5 == 4 { *value + 0.02 * value.signum() } else { 40.0 * *value };
    }
    model.begin_step(STEP, &Stage::ALL).unwrap();
    let mut tangent = BorderedMatrix::zeros(movements, model.half_bandwidth(), shape);
    let mut out = vec![0.0; model.degrees_of_freedom()];
    let (increments, contacts) = unknowns.split_at(movements);
    model.add_linearised_constraints(increments, contacts, &mut out, tangent.border_mut());
    let mut plain = vec![0.0; out.len()];
    model.add_constraints(increments, contacts, &mut plain);
    assert_eq!(out, plain, "{label}");
    let size = movements + shape.width;
    // Derivatives of the contact forces with respect to displacements vanish and are left out, because `λ` and `η` are unknowns.
    let found = DMatrix::from_fn(size, size, |i, j| tangent.get(i, j));
    let expected = differences(&unknowns, 1e-5, &mut |unknowns| {
        let (increments, contacts) = unknowns.split_at(movements);
        let mut out = vec![0.0; plain.len()];
        model.add_constraints(increments, contacts, &mut out);
        out.truncate(size);
        out
    });
    assert_close(label, &found, &expected, 1e-7);
}

#[test]
fn equations_of_a_law_have_their_stated_units() {
    // Doubled lengths double equations with the unit length only, and doubled forces double equations with the unit force only.
    for state in states() {
        for (name, law) in LAWS {
            if name == "relaxed" && state.unknowns.increment == 0.0 {
                continue;
            }
            let values = |lengths: f64, forces: f64| {
                let scale = |vectors: &[Vec2]| vectors.iter().map(|v| v * lengths).collect();
                let scaled = State {
                    name: String::new(),
                    before: scale(&state.before),
                    moved: scale(&state.moved),
                    slave_moved: state.slave_moved * lengths,
                    unknowns: ContactUnknowns {
                        force: state.unknowns.force * forces,
                        couple: state.unknowns.couple * forces,
                        increment: state.unknowns.increment,
                    },
                    from: state.from,
                    length: state.length * lengths,
                    mesh: state.mesh.clone(),
                    kink: state.kink.as_ref().and_then(|(_, compliance, before)| {
                        let length = kink_of(&state.mesh, state.length * lengths)?;
                        Some((length, compliance / forces, before * forces))
                    }),
                };
                scaled.with(&scaled.numbers(), |contact, _| {
                    law.equations(contact).map(|equation| (equation.value, equation.unit))
                })
            };
            let one = values(1.0, 1.0);
            for (lengths, forces) in [(2.0, 1.0), (1.0, 2.0)] {
                for ((value, unit), (other, _)) in one.iter().zip(values(lengths, forces)) {
                    let factor = if *unit == Unit::Length { lengths } else { forces };
                    let error = (other - factor * value).abs();
                    assert!(error <= 1e-9 * value.abs(), "{name}, {}: {value} {other}", state.name);
                }
            }
        }
    }
}
