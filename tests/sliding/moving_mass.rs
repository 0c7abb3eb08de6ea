//! Contact forces of masses that cross a simply supported Timoshenko beam, compared with a modal superposition.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::simulate;
use crate::kink_starts::{Cart, LENGTH, SECTION, SPEED, WEIGHT, bridge_of_bending, rms};
use withy::integrators::Method;
use withy::joints::SlidingRule;

/// Number of modes of the deflection, and of the rotation.
const MODES: usize = 1000;

/// Amplitudes of the deflection `sin kX` and the rotation `cos kX`, and their rates.
#[derive(Clone, Copy, Default)]
struct Mode {
    amplitudes: [f64; 2],
    rates: [f64; 2],
}

/// Linear equations of a mass that slides without friction on a simply supported Timoshenko beam, in steps of the trapezoidal rule.
/// The mass is on the beam at the end of every step, so that its transverse and convective accelerations are included.
struct ModalSolution {
    modes: Vec<Mode>,
    bending: f64,
    mass: f64,
    weight: f64,
    place: f64,
    speed: f64,
    height_rate: f64,
    force: f64,
}

impl ModalSolution {
    fn new(cart: Cart, bending: f64) -> Self {
        let ratio = bending / SECTION.bending_stiffness;
        Self {
            modes: vec![Mode::default(); MODES],
            bending,
            mass: cart.mass,
            weight: WEIGHT * ratio,
            place: cart.start,
            speed: SPEED * ratio.sqrt(),
            height_rate: 0.0,
            force: WEIGHT * ratio,
        }
    }

    /// Takes a step. Returns the mean contact force divided by the weight.
    fn step(&mut self, dt: f64) -> f64 {
        let numbers = || (1..=MODES).map(|n| n as f64 * PI / LENGTH);
        let slopes = numbers().zip(&self.modes);
        let slope: f64 =
            slopes.map(|(k, mode)| k * (k * self.place).cos() * mode.amplitudes[0]).sum();
        self.speed -= dt * self.force * slope / self.mass;
        let before = self.place;
        self.place += dt * self.speed;

        // The contact force `N` changes the increments of a mode by `-N response`.
        let (mut sunk, mut compliance) = (0.0, 0.0);
        let mut increments = Vec::with_capacity(MODES);
        for (k, mode) in numbers().zip(&self.modes) {
            let [at_start, at_end] = [before, self.place].map(|x| (k * x).sin());
            let (free, response) = self.increments(k, mode, dt);
            let response = response.map(|by_force| by_force * 0.5 * (at_start + at_end));
            sunk += at_end * (mode.amplitudes[0] + free[0]) - at_start * mode.amplitudes[0];
            compliance += at_end * response[0];
            increments.push((free, response));
        }
        let own = dt * dt / (2.0 * self.mass);
        let fall = dt * self.height_rate - own * self.weight;
        self.force = (sunk - fall) / (own + compliance);
        self.height_rate = 2.0 * (fall + own * self.force) / dt - self.height_rate;
        for (mode, (free, response)) in self.modes.iter_mut().zip(increments) {
            for part in 0..2 {
                let increment = free[part] - self.force * response[part];
                mode.amplitudes[part] += increment;
                mode.rates[part] = 2.0 * increment / dt - mode.rates[part];
            }
        }
        self.force / self.weight
    }

    /// Increments of the amplitudes of a mode with the wave number `k` in a free step, and their derivatives with respect to a modal force.
    fn increments(&self, k: f64, mode: &Mode, dt: f64) -> ([f64; 2], [f64; 2]) {
        let half = LENGTH / 2.0;
        let shear = SECTION.shear_stiffness * half;
        let coupling = -shear * k;
        let stiffness = [shear * k * k, shear + self.bending * half * k * k];
        let inertia = [SECTION.mass_per_length * half, SECTION.rotary_inertia * half];
        let [first, second] = [0, 1].map(|i| 2.0 * inertia[i] / (dt * dt) + 0.5 * stiffness[i]);
        let determinant = first * second - 0.25 * coupling * coupling;
        let load = [0, 1].map(|i| {
            let elastic = stiffness[i] * mode.amplitudes[i] + coupling * mode.amplitudes[1 - i];
            2.0 * inertia[i] * mode.rates[i] / dt - elastic
        });
        let free = [
            (second * load[0] - 0.5 * coupling * load[1]) / determinant,
            (first * load[1] - 0.5 * coupling * load[0]) / determinant,
        ];
        (free, [second / determinant, -0.5 * coupling / determinant])
    }
}

/// Scene of a comparison: cart, bending stiffness, step and end.
#[derive(Debug, Clone, Copy)]
struct Crossing {
    cart: Cart,
    bending: f64,
    dt: f64,
    end: f64,
}

impl Crossing {
    /// The same crossing in periods of a beam with another bending stiffness.
    fn of_bending(mass: f64, start: f64, bending: f64, (dt, end): (f64, f64)) -> Self {
        let scale = (bending / SECTION.bending_stiffness).sqrt();
        let cart = Cart { mass, start, is_curved: false };
        Self { cart, bending, dt: dt / scale, end: end / scale }
    }

    fn new(mass: f64, start: f64, time: (f64, f64)) -> Self {
        Self::of_bending(mass, start, SECTION.bending_stiffness, time)
    }

    /// Root mean squares of the errors of `F/W` of both rules: *conserving*, *kinked*.
    fn errors(self, spans: usize) -> [f64; 2] {
        let Self { cart, bending, dt, end } = self;
        let weight = WEIGHT * bending / SECTION.bending_stiffness;
        let errors = [SlidingRule::Conserving, SlidingRule::Kinked].map(|rule| {
            let scene = bridge_of_bending(cart, bending, spans, rule);
            let ran = simulate(scene, Method::EnergyMomentum, dt, end);
            let column = ran.history().column("slider1.force_y").unwrap();
            let found: Vec<f64> = column[1..].iter().map(|force| -force / weight).collect();
            let mut modes = ModalSolution::new(cart, bending);
            let expected: Vec<f64> = found.iter().map(|_| modes.step(dt)).collect();
            rms(&found, &expected)
        });
        let Cart { mass, start, .. } = cart;
        let [smeared, kinked] = errors;
        println!(
            "{mass:5} from {start:3}, EI {bending:.0e}, {spans:3} spans, dt {dt:.0e}: {smeared:.4}, kinked {kinked:.4}"
        );
        errors
    }
}

#[test]
fn kinks_improve_contact_forces_of_heavy_masses_within_a_span() {
    for mass in [50.0, 500.0] {
        let crossing = Crossing::new(mass, 2.3, (1e-3, 0.35));
        let [coarse, fine] = [16, 64].map(|spans| crossing.errors(spans));
        assert!(fine[0] < 0.45 * coarse[0] && fine[1] < 0.15 * coarse[1], "{mass}");
        assert!(fine[1] < 0.6 * fine[0], "{mass}");
    }
}

/// The velocity of a slider that begins at an end is rotated onto the kinked axis, and the modal solution starts along the unloaded axis.
#[test]
fn kinks_worsen_contact_forces_of_entering_heavy_masses() {
    let [smeared, kinked] = Crossing::new(500.0, 0.0, (1e-3, 0.35)).errors(64);
    assert!(smeared < 0.012 && kinked > 0.015 && kinked < 0.03, "{smeared} {kinked}");
}

#[test]
fn errors_of_forces_of_both_rules_differ_little() {
    let bending = SECTION.bending_stiffness;
    let times = [(1e-2, 0.35), (1e-3, 0.35), (1e-4, 0.1), (1e-5, 0.02)];
    let (masses, meshes): (&[f64], &[usize]) = match std::env::var_os("WITHY_LONG").is_some() {
        true => (&[0.05, 0.5, 5.0, 50.0, 500.0], &[8, 16, 32, 64, 128]),
        false => (&[0.5, 50.0], &[8]),
    };
    for &mass in masses {
        for start in [0.0, 2.3] {
            let enters_heavily = mass > 100.0 && start == 0.0;
            for time in times {
                for &spans in meshes.iter().filter(|spans| time.0 > 5e-5 || **spans <= 16) {
                    let [smeared, kinked] = Crossing::new(mass, start, time).errors(spans);
                    let most = if enters_heavily || time.0 < 5e-4 { 0.035 } else { 0.02 };
                    assert!(kinked < smeared + most, "{mass} {start} {spans} {time:?}");
                }
            }
            for (ratio, most) in [(1e-3, 0.002), (1e-2, 0.002), (100.0, 0.08)] {
                for &spans in meshes.iter().filter(|spans| **spans <= 32 && mass < 100.0) {
                    let crossing = Crossing::of_bending(mass, start, ratio * bending, times[1]);
                    let [smeared, kinked] = crossing.errors(spans);
                    assert!(kinked < smeared + most, "{mass} {start} {ratio} {spans}");
                }
            }
        }
    }
}
