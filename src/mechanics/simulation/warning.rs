//! Warnings about steps that have converged but do not resolve the motion.

use std::f64::consts::TAU;
use std::fmt;

use super::StepControl;
use crate::elementary::rounded_to;
use crate::system::{MotionCurvature, OutsideLaw, RESOLVED_IMPACT, ShortBounce, UnsampledChange};

/// Largest rotation of a section in a step without a warning [rad]. It corresponds to ten steps per revolution.
pub(super) const LARGEST_ROTATION: f64 = 0.1 * TAU;

/// Largest number of spans of its master that a slider may pass in a step without a warning [-].
pub(super) const MOST_SPANS: f64 = 1.0;

/// Factor by which the severity of a warning must increase before the warning is repeated.
const REPEAT_FACTOR: f64 = 2.0;

/// Factor by which the warning recommends to reduce the step size or the tolerance if a bounce lasted at most three steps.
const BOUNCE: f64 = 5.0;

/// Number of steps per period of a vibration with the step size that a warning recommends.
const RESOLVED_STEPS_PER_PERIOD: f64 = 20.0;

#[derive(Debug, Clone, PartialEq)]
pub enum RateChangeCause {
    /// Name of the element that dissipated the most energy, such as a damper, a damped material, or a drag element.
    Damping(String),
    /// Description of a load or drive with a controller that is sampled once per step.
    Controller(String),
}

impl fmt::Display for RateChangeCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Damping(name) => write!(f, "damping by '{name}'"),
            Self::Controller(name) => {
                write!(f, "the controller of {name}, which is sampled once per step")
            }
        }
    }
}

/// Motion that the time steps do not resolve.
#[derive(Debug, Clone, PartialEq)]
pub enum Warning {
    /// Unresolved vibration with a large fraction of the kinetic energy.
    Motion {
        /// Step size [time].
        dt: f64,
        /// Unresolved fraction of the kinetic energy [-].
        unresolved_fraction: f64,
        /// Mean period of the motion, weighted by accelerations [time].
        period: f64,
        /// Period of the lowest natural mode of the initial configuration [time]; `None` if unknown.
        lowest: Option<f64>,
        /// Possible causes other than vibration.
        causes: Vec<RateChangeCause>,
        /// Name of a method that would damp the vibration; `None` if the method is in use or would have no effect.
        damping: Option<&'static str>,
    },
    /// Unresolved vibration of a damped beam whose kinetic energy is small in comparison with other bodies.
    Beam {
        /// Name of the beam.
        beam: String,
        /// Step size [time].
        dt: f64,
        /// Unresolved fraction of the kinetic energy of the beam [-].
        unresolved_fraction: f64,
        /// Mean period of the motion of the beam, weighted by accelerations [time].
        period: f64,
    },
    /// Accumulated phase error of a vibration.
    Phase {
        /// Step size [time].
        dt: f64,
        /// Period of the vibration [time].
        period: f64,
        /// Fraction of the kinetic energy in the vibration [-].
        share: f64,
        /// Accumulated phase error [rad].
        phase: f64,
        /// Recommended step size with a small phase error [time].
        advised: f64,
        /// Name of a method of higher order; `None` if a method of higher order is in use.
        method: Option<&'static str>,
    },
    /// Drive that starts with a speed at a beam at rest.
    StartImpact {
        /// Type and name of the drive.
        drive: String,
        /// Name of the beam.
        beam: String,
        /// Initial rate with its unit.
        rate: String,
    },
    /// Alternating long and short steps in a scene with rigid links or dissipation.
    Uneven {
        /// Length of the shortest recent step [time].
        shortest: f64,
        /// Length of the longest recent step [time].
        longest: f64,
    },
    /// Large number of adaptive steps, due to a method of first order or to fast vibrations of small amplitude.
    ManySteps {
        /// Number of steps so far.
        steps: usize,
        /// Mean step size [time].
        dt: f64,
        /// Tolerance [-].
        tolerance: f64,
        /// Name of the method if the method is of first order; `None` otherwise.
        method: Option<&'static str>,
        /// Time in which the scene moves by its own length [time].
        travel_time: f64,
        /// Factor by which the mean step is shorter than a step that resolves the motion of the whole scene [-].
        times: f64,
    },
    /// Large rotation of sections in a step.
    Rotation {
        /// Step size [time].
        dt: f64,
        /// Largest rotation of a section in a step [rad].
        angle: f64,
    },
    /// Slider that passes many spans in a step.
    SpansPerStep {
        /// Name of the slider.
        slider: String,
        /// Step size [time].
        dt: f64,
        /// Largest number of spans passed in a step [-].
        spans: f64,
    },
    /// Slider whose friction force was kept constant in steps that have no solution with the law of friction.
    Friction {
        /// Name of the slider.
        slider: String,
        /// Number of steps with a constant friction force.
        steps: usize,
    },
    /// Slider that only pushes, and that stayed in contact under a tensile force after too many take-offs and landings.
    KeptContact {
        /// Name of the slider.
        slider: String,
        /// Number of attempted steps in which the slider stayed in contact under a tensile force.
        steps: usize,
    },
    /// Slider that moves on its master almost as fast as the shear waves of the master.
    WaveSpeed {
        /// Name of the slider.
        slider: String,
        /// Largest recorded speed along the master [length/time].
        speed: f64,
        /// Speed of the slider up to which its kink varies with the contact force [length/time].
        limit: f64,
    },
    /// Energy drift with a method that conserves energy.
    Drift {
        /// Largest change of the energy balance (energy minus work of loads and drives plus dissipated energy), as a fraction of the largest energy [-].
        drift: f64,
        /// Name and stiffness of the stiffest spring; `None` without springs.
        stiffest: Option<(String, f64)>,
    },
    /// Step of the fourth-order method in whose backward substep dampers returned more energy than they dissipated in the whole step.
    EnergyGain {
        /// Time at the end of the step [time].
        time: f64,
        /// Length of the step [time].
        dt: f64,
        /// Energy returned in the backward substep of the fourth-order method [energy].
        returned: f64,
        /// Energy dissipated in the whole step [energy]; negative if dampers added energy.
        dissipated: f64,
    },
    /// Prescribed motion whose rate jumps within a step.
    Bend {
        /// Name of the drive.
        drive: String,
        /// Time of the step with the jump of the rate, and the rates before and after the jump.
        curvature: MotionCurvature,
    },
    /// Script function of time that changes too fast for the step size.
    Schedule {
        /// Description of the load or drive.
        owner: String,
        /// Step size [time].
        dt: f64,
        /// Step with the largest difference between two quadrature rules for the mean of the function.
        change: UnsampledChange,
    },
    /// Spring or damper beyond the range of its law.
    Range {
        /// Description of the law, including its spring or damper.
        law: String,
        /// Range of the law, and the value farthest outside the range.
        outside: OutsideLaw,
    },
    /// Contact at a spring, at an obstacle or between bodies that lasted too few steps.
    Contact {
        /// Type and name of the element with the contact.
        object: String,
        /// Tolerance of variable steps [-]; `None` for fixed steps.
        tolerance: Option<f64>,
        /// Number of steps, duration and force of the bounce.
        bounce: ShortBounce,
    },
    /// Body that starts inside an obstacle or another body.
    StartInside {
        /// Type and name of the obstacle, or of the contact between the bodies.
        obstacle: String,
        /// Type and name of the body with the largest stored energy.
        body: String,
        /// Largest penetration of the body [length].
        depth: f64,
        /// Energy that the contacts of the body store [energy].
        energy: f64,
    },
    /// Elastic impact of a slider whose duration is shorter than a step.
    Bounce {
        /// Name of the slider.
        slider: String,
        /// Step size [time].
        dt: f64,
        /// Ratio of step size to impact duration [-].
        impacts_per_step: f64,
    },
}

impl Warning {
    fn measure(&self) -> f64 {
        match self {
            Self::Motion { unresolved_fraction, .. } | Self::Beam { unresolved_fraction, .. } => {
                *unresolved_fraction
            }
            Self::Phase { share, phase, .. } => share * phase,
            Self::Uneven { shortest, longest } => longest / shortest,
            Self::ManySteps { steps, .. } => *steps as f64,
            Self::Rotation { angle, .. } => *angle,
            Self::SpansPerStep { spans, .. } => *spans,
            Self::Friction { steps, .. } | Self::KeptContact { steps, .. } => *steps as f64,
            Self::WaveSpeed { speed, .. } => *speed,
            Self::Bounce { impacts_per_step, .. } => *impacts_per_step,
            Self::Drift { drift, .. } => *drift,
            Self::EnergyGain { returned, dissipated: taken, .. } => returned - taken,
            Self::Bend { curvature: bend, .. } => bend.size(),
            Self::Schedule { .. } | Self::Range { .. } | Self::StartImpact { .. } => 1.0,
            Self::Contact { bounce, .. } => bounce.force,
            Self::StartInside { energy, .. } => *energy,
        }
    }

    /// Name of the object of the warning; `None` for types of warnings that concern the whole scene.
    fn object_name(&self) -> Option<&str> {
        match self {
            Self::Motion { .. }
            | Self::Phase { .. }
            | Self::Uneven { .. }
            | Self::ManySteps { .. }
            | Self::Rotation { .. }
            | Self::Drift { .. }
            | Self::EnergyGain { .. } => None,
            Self::SpansPerStep { slider, .. }
            | Self::Friction { slider, .. }
            | Self::KeptContact { slider, .. }
            | Self::WaveSpeed { slider, .. }
            | Self::Bounce { slider, .. } => Some(slider),
            Self::Beam { beam, .. } => Some(beam),
            Self::Bend { drive, .. } | Self::StartImpact { drive, .. } => Some(drive),
            Self::Schedule { owner, .. } => Some(owner),
            Self::Range { law, .. } => Some(law),
            Self::Contact { object, .. } => Some(object),
            Self::StartInside { obstacle, .. } => Some(obstacle),
        }
    }

    /// Returns true if `reported` contains no warning of this type for this object, or if this warning is sufficiently more severe.
    pub fn is_new_or_worse(&self, reported: &[Self]) -> bool {
        !reported.iter().any(|other| {
            std::mem::discriminant(other) == std::mem::discriminant(self)
                && other.object_name() == self.object_name()
                && self.measure() < REPEAT_FACTOR * other.measure()
        })
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Motion { dt, unresolved_fraction, period, causes, .. } if !causes.is_empty() => {
                let others: Vec<String> = causes.iter().map(RateChangeCause::to_string).collect();
                write!(
                    f,
                    "steps are too long for the motion: {} % of the kinetic energy changes within a step, which does not resolve it. Possible causes: vibration, {}. dt = {} is {} times the period of the change ({}); use dt below {}",
                    short(100.0 * unresolved_fraction),
                    others.join(", "),
                    short(*dt),
                    short(dt / period),
                    short(*period),
                    short(period / RESOLVED_STEPS_PER_PERIOD)
                )
            }
            Self::Motion { dt, unresolved_fraction, period, lowest, damping, .. } => {
                write!(
                    f,
                    "steps are too long for the motion: {} % of the kinetic energy is in vibration that they do not resolve. dt = {} is ",
                    short(100.0 * unresolved_fraction),
                    short(*dt)
                )?;
                let known = lowest.filter(|lowest| lowest < dt);
                let shown = known.unwrap_or(*period);
                match known {
                    Some(lowest) => write!(
                        f,
                        "{} times the first natural period of the scene as drawn ({})",
                        short(dt / lowest),
                        short(lowest)
                    )?,
                    None => write!(
                        f,
                        "{} times the mean period of the vibration ({})",
                        short(dt / period),
                        short(*period)
                    )?,
                }
                write!(f, "; use dt below {}", short(shown / RESOLVED_STEPS_PER_PERIOD))?;
                match damping {
                    Some(method) => {
                        write!(f, ", or use the method {method} if this vibration does not matter")
                    }
                    None => Ok(()),
                }
            }
            Self::Beam { beam, dt, unresolved_fraction, period } => write!(
                f,
                "steps are too long for the motion of beam '{beam}', whose material is damped: {} % of its kinetic energy changes within a step, which does not resolve it. dt = {} is {} times the period of the change ({}); use dt below {}. Until then velocities and forces of the beam alternate from step to step: average them over two steps",
                short(100.0 * unresolved_fraction),
                short(*dt),
                short(dt / period),
                short(*period),
                short(period / RESOLVED_STEPS_PER_PERIOD)
            ),
            Self::Phase { dt, period, share, phase, advised, method } => {
                write!(
                    f,
                    "the steps (dt = {}) have shifted the phase of a vibration with a period of about {} by {} of a period so far. It carries {} % of the kinetic energy, and positions are off by about {} % of the amplitude of the motion; use dt below {}",
                    short(*dt),
                    short(*period),
                    short(phase / TAU),
                    short(100.0 * share),
                    short(100.0 * share * phase.min(2.0)),
                    short(*advised)
                )?;
                match method {
                    Some(method) => write!(f, ", or the method {method}"),
                    None => Ok(()),
                }
            }
            Self::StartImpact { drive, beam, rate } => write!(
                f,
                "{drive} starts with {rate}, but beam '{beam}' is at rest: the start is an impact that excites vibration, and its force depends on dt. Give the beam the same start velocity, or start the drive from rest, for example with smooth_step of std/schedules"
            ),
            Self::Rotation { dt, angle } => write!(
                f,
                "sections rotate by up to {} rad per step (dt = {}), which is {} steps per revolution and inaccurate; use dt below {}",
                short(*angle),
                short(*dt),
                short(TAU / angle),
                short(dt * LARGEST_ROTATION / angle)
            ),
            Self::SpansPerStep { slider, dt, spans } => write!(
                f,
                "slider '{slider}' crosses up to {} spans of its beam per step (dt = {}), and the contact force is averaged over them; use dt below {}, or longer spans",
                short(*spans),
                short(*dt),
                short(dt * MOST_SPANS / spans)
            ),
            Self::Friction { slider, steps } => write!(
                f,
                "the friction law of slider '{slider}' has no solution in {steps} {}, which used the friction force of the previous step. Energy and momenta are balanced, but the motion is inaccurate; use a smaller dt or a smoother mesh",
                if *steps == 1 { "step" } else { "steps" }
            ),
            Self::KeptContact { slider, steps } => write!(
                f,
                "slider '{slider}' left its beam and landed again several times within a step, and then stayed in contact under a tensile force, in {steps} attempted {}. Energy and momenta are balanced; use a smaller dt to resolve the contact",
                if *steps == 1 { "step" } else { "steps" }
            ),
            Self::Uneven { shortest, longest } => write!(
                f,
                "step lengths alternate between {} and {}: velocity errors at rigid joints and in strongly damped beams then accumulate, and reactions, accelerations, forces and spins are much less accurate than positions. Make the periods and delays of controllers, and the times of run_to, multiples of dt",
                short(*shortest),
                short(*longest)
            ),
            Self::ManySteps { steps, dt, tolerance, method, travel_time, times } => {
                write!(
                    f,
                    "{steps} adaptive steps of {} on average with the tolerance {}: ",
                    short(*dt),
                    short(*tolerance)
                )?;
                match method {
                    Some(method) => write!(
                        f,
                        "steps of the first-order method {method} are proportional to the tolerance; use the method energy_momentum or fourth_order, or a larger tolerance"
                    ),
                    None => write!(
                        f,
                        "the scene moves by its own length in about {}, and steps {} times as long would resolve this motion. The steps follow a small fast vibration, such as an impact or a sudden load excites. If the vibration does not matter, use fixed steps, a larger tolerance, or damping of the material",
                        short(*travel_time),
                        short(*times)
                    ),
                }
            }
            Self::WaveSpeed { slider, speed, limit } => write!(
                f,
                "slider '{slider}' moves along its beam at up to {}, close to the speed of shear waves. Above {} the kink of the axis is not adapted to the contact force, and the contact is only first-order accurate in the span length; refine the mesh",
                short(*speed),
                short(*limit)
            ),
            Self::Drift { drift, stiffest } => {
                write!(
                    f,
                    "the energy drifts by {} of its largest value (work of loads and dissipation included), although the method conserves it to rounding: numbers of very different magnitude lose digits in sums.",
                    short(*drift)
                )?;
                match stiffest {
                    Some((spring, stiffness)) => write!(
                        f,
                        " Spring '{spring}' has a stiffness of {}: replace it by a joint, or reduce the stiffness",
                        short(*stiffness)
                    ),
                    None => write!(f, " Check the stiffnesses, masses and units"),
                }
            }
            Self::EnergyGain { time, dt, returned, dissipated: taken } => {
                if *taken < 0.0 {
                    write!(f, "dampers added an energy of {}", short(-taken))?;
                } else {
                    let (taken, returned) = (short(*taken), short(*returned));
                    write!(f, "dampers dissipated only {taken} and returned {returned}")?;
                }
                write!(
                    f,
                    " in the step (dt = {}) that ends at t = {}: the method fourth_order has a backward substep. A motion with a decay rate from 3.13/dt to 3.76/dt regains more energy in it than the step dissipates, and grows near 3.557/dt. Use another dt, or the method energy_momentum",
                    short(*dt),
                    short(*time)
                )
            }
            Self::Bend { drive, curvature: MotionCurvature { time, rates: [before, after] } } => {
                write!(
                    f,
                    "the prescribed motion '{drive}' has a kink near t = {}: its rate changes from {} to {} within one step, which assumes a smooth motion. Declare the times of kinks in its schedule, so that steps end there, or use a smooth schedule such as smooth_step of std/schedules",
                    short(*time),
                    short(*before),
                    short(*after)
                )
            }
            Self::Schedule {
                owner,
                dt,
                change: UnsampledChange { time, sampling_error: missed },
            } => write!(
                f,
                "the function of time of {owner} changes faster than the steps (dt = {}) sample it: near t = {} two estimates of its mean over a step differ by {} % of its largest value. Use a smaller dt, declare the times of its jumps and kinks, or use a built-in schedule such as pulse, smooth_pulse, sine or table, which is integrated exactly",
                short(*dt),
                short(*time),
                short(100.0 * missed)
            ),
            Self::Range { law, outside: OutsideLaw { range: [from, to], reached, .. } } => write!(
                f,
                "{law} is given from {} to {}, but {} was reached: it was extrapolated by a straight line; give it over a larger range",
                short(*from),
                short(*to),
                short(*reached)
            ),
            Self::Contact { object, tolerance, bounce: ShortBounce { steps, force, duration } } => {
                let dt = duration / steps;
                write!(
                    f,
                    "an impact on {object} lasted only {steps} steps (dt = {}), with a peak force of {}: the rebound velocity depends on the step size; ",
                    short(dt),
                    short(*force)
                )?;
                match tolerance.map(|tolerance| tolerance / BOUNCE) {
                    Some(less) if less >= StepControl::LEAST_TOLERANCE => {
                        write!(f, "use a tolerance below {}, or a smaller stiffness", short(less))
                    }
                    Some(_) => write!(f, "use a smaller stiffness"),
                    None => {
                        write!(f, "use dt below {}, or a smaller stiffness", short(dt / BOUNCE))
                    }
                }
            }
            Self::StartInside { obstacle, body, depth, energy } => write!(
                f,
                "{body} starts inside {obstacle}, up to {} deep: the contact stores an energy of {} that the loads do not explain, and pushes the body out. Move the body, or start from an equilibrium",
                short(*depth),
                short(*energy)
            ),
            Self::Bounce { slider, dt, impacts_per_step } => write!(
                f,
                "slider '{slider}' bounced off an elastic beam with dt = {}, which is {} times the longest duration of such an impact ({}): the beam was treated as rigid. Use dt below {} to resolve the waves, or give the slider a restitution",
                short(*dt),
                short(*impacts_per_step),
                short(dt / impacts_per_step),
                short(RESOLVED_IMPACT * dt / impacts_per_step)
            ),
        }
    }
}

pub(super) fn short(number: f64) -> String {
    let rounded = rounded_to(3, number);
    let size = rounded.abs();
    if size == 0.0 || (1e-4..1e7).contains(&size) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn warnings_are_repeated_if_new_or_twice_as_large() {
        let spans_warning = |slider: &str, spans| Warning::SpansPerStep {
            slider: slider.to_owned(),
            dt: 1.0,
            spans,
        };
        let reported = [spans_warning("ring", 2.0)];
        assert!(!spans_warning("ring", 3.9).is_new_or_worse(&reported));
        assert!(spans_warning("ring", 4.0).is_new_or_worse(&reported));
        assert!(spans_warning("bead", 1.1).is_new_or_worse(&reported));
        let bounce = Warning::Bounce { slider: "ring".to_owned(), dt: 1.0, impacts_per_step: 1.1 };
        assert!(bounce.is_new_or_worse(&reported) && bounce.is_new_or_worse(&[]));
    }

    #[test]
    fn numbers_in_warnings_have_three_digits() {
        let shown = [0.119_37, 42.04, 5.0, 1.0 / 3.0 * 1e-7, 0.0].map(short);
        assert_eq!(shown, ["0.119", "42", "5", "3.33e-8", "0"]);
    }
}
