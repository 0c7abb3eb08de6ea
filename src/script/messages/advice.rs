//! Hints for errors of lower layers, in terms of the language. The lower layers report errors without knowing about scripts.

use std::error::Error;

use crate::beams::BeamError;
use crate::integrators::StepError;
use crate::loads::LoadError;
use crate::simulation::{ArchiveError, DerivativeError, SimulationError};
use crate::statics::{InTime, StaticsError, StepFailure};
use crate::system::{Approach, SliderError, SystemError, TrackError, Turning};

/// Returns a hint for an error, or for the first of its causes with a known hint.
pub fn on(error: &(dyn Error + 'static)) -> Option<String> {
    let own = None
        .or_else(|| error.downcast_ref().and_then(on_simulation))
        .or_else(|| error.downcast_ref().and_then(on_statics))
        .or_else(|| error.downcast_ref().and_then(on_model))
        .or_else(|| error.downcast_ref().and_then(on_archive))
        .or_else(|| error.downcast_ref().and_then(on_load))
        .or_else(|| error.downcast_ref().and_then(on_beam));
    own.or_else(|| on(error.source()?))
}

fn on_simulation(error: &SimulationError) -> Option<String> {
    Some(match error {
        SimulationError::Model(error) => return on_model(error),
        SimulationError::End { end, .. } if !end.is_finite() => "give a finite time".into(),
        SimulationError::End { .. } => "give a later time, or go back with sim.rewind(t)".into(),
        SimulationError::Step { .. } | SimulationError::Smallest { .. } => {
            "the history up to there is kept; try a smaller dt or a finer mesh, and check loads, stiffness, units and what is held".into()
        }
        SimulationError::Load { source } => {
            let own = cause_of(source).and_then(on_load);
            own.unwrap_or_else(|| "loads and drives need a finite value at all times".into())
        }
        SimulationError::Tolerance { .. } => {
            "the history up to there is kept; give a larger tolerance or a smaller step: adaptive(#{ tolerance: …, smallest: … }); adaptive steps \
             land on jumps of schedules by themselves, but a function that jumps needs its breaks: schedule(|t| …, [t1, t2])"
                .into()
        }
        SimulationError::Ended { .. } => {
            "give the slider the option ends: \"bounce\" or \"release\" to go on, or ask sim.ended before a step".into()
        }
        SimulationError::ManySamples { .. } => {
            "give `sample` the period of the controller, a hundredth to ten times dt".into()
        }
        SimulationError::NoMean { sensor, .. } => {
            format!("record \"{}\"", sensor.replace(".mean_", "."))
        }
        SimulationError::BeginsElsewhere { .. } => {
            "take an equilibrium under the whole of its loads, load_factor: 1, where drives are where their functions have them".into()
        }
        SimulationError::Rattles { .. } => "try ends: \"release\" or \"stop\"".into(),
        SimulationError::FewerSteps { .. } => "sim.rewind(0) leads to the start".into(),
        SimulationError::NotBehind { .. } => {
            "give a time between, or use sim.run_to(t) to go on".into()
        }
        SimulationError::NoSnapshots { .. } => {
            "start with scene.start(#{ …, snapshots: 64 }), in megabytes, or call sim.keep_snapshots(64) before the steps".into()
        }
        SimulationError::BeforeFirst { .. } => {
            "earlier ones are not in a file of sim.save(…), and are not kept before sim.keep_snapshots(…)".into()
        }
        SimulationError::Forgotten { first, limit, .. } => format!(
            "sim.rewind({first}) leads there, and for more start with scene.start(#{{ …, snapshots: {} }})",
            (4.0 * limit).ceil().max(64.0)
        ),
        SimulationError::Derivative(error) => match error {
            DerivativeError::Form { .. } | DerivativeError::Times { .. } => {
                "give plain numbers in the place of scene.parameter(…) and take central differences, as fit does".into()
            }
            DerivativeError::Mean { .. } => "record the force at the present moment".into(),
            DerivativeError::Adaptive => "give dt a number".into(),
            _ => return None,
        },
        SimulationError::Method(_)
        | SimulationError::StepSize(_)
        | SimulationError::Landing { .. }
        | SimulationError::Interrupted { .. } => return None,
    })
}

fn on_statics(error: &StaticsError) -> Option<String> {
    const AT_REST: &str = "let a damped motion come to rest instead, scene.start(#{ integrator: energy_decaying(#{ chi: 1 }), dt: … })";
    Some(match error {
        StaticsError::Model(error) => return on_model(error),
        StaticsError::NoLoad { .. } => {
            "loads are taken as they are at one time: choose it with the option time; drag, wind and dampers act on motion alone".into()
        }
        StaticsError::InTime { by: InTime::Speed, .. } => {
            "give the place at rest, counted from that as drawn: x, y or angle as a function of time that begins with 0, such as angle: |t| 0.5 * t, and \
             scene.equilibrium(#{ time: 1 })"
                .into()
        }
        StaticsError::InTime { .. } => {
            "give the force or the torque that it has at rest, as a number, in the scene of which you ask the equilibrium".into()
        }
        StaticsError::NothingGrows { .. } | StaticsError::Driven { .. } => "leave out control: arc_length()".into(),
        StaticsError::PathLost { points, .. } => format!(
            "see what it has found: arc_length(#{{ points: {points} }}) ends it there; it may lead on in shorter steps, arc_length(#{{ longest: 0.01 }})"
        ),
        StaticsError::Loose { reason, .. } | StaticsError::Lost { reason, .. }
            if matches!(**reason, StepFailure::Leaves { .. }) =>
        {
            "with ends: \"stop\" it leans on the end; what has left has no rest".into()
        }
        StaticsError::Loose { .. } => {
            format!("hold it with scene.clamp(…) or scene.hinge(…), or {AT_REST}")
        }
        StaticsError::Lost { reached: 0.0, .. } => {
            "take more load_steps; what is not at ease as drawn, as a spring of another length, pulls before any load is on: draw it nearer to its rest, or let it be at ease and move \
             its end by scene.move; where the structure snaps through, follow it with control: arc_length()"
                .into()
        }
        StaticsError::Lost { .. } => {
            "take more load_steps; where the structure snaps through, follow it with control: arc_length(), or stop before with load_factor".into()
        }
        StaticsError::Load { .. }
        | StaticsError::Value { .. }
        | StaticsError::Interrupted { .. } => return None,
    })
}

fn on_model(error: &SystemError) -> Option<String> {
    let advice = match error {
        SystemError::Slider(error) => return on_slider(error),
        SystemError::Track(error) => return on_track(error),
        SystemError::Empty { .. } => {
            "add one with scene.beam(#{ axis: …, section: … }) or scene.particle([x, y], mass)"
        }
        SystemError::NoSection { .. } => "give a station of a beam",
        SystemError::NoPoint { .. } => {
            "name it in the points of scene.body(…); its centre is body.centre"
        }
        SystemError::StartVelocity { .. } => {
            "what turns about a place starts with spin: 2, about: [x, y]; what is joined to it with the velocity that it has there; where a body in motion is joined to a beam \
             at rest, give the node between them the velocity of that point of the body: scene.velocity(beam.end, [vx, vy])"
        }
        SystemError::Inertialess { .. } => {
            "give it one, scene.body(#{ …, inertia: 0.1 }), or hold its angle: scene.support(body.centre, #{ angle: true })"
        }
        SystemError::Massless { .. } => {
            "give it one, scene.body(#{ …, mass: 1 }), or join it to something: scene.hinge(body.centre)"
        }
        SystemError::PointAlone { .. } => "give velocity and spin to scene.body(#{ … })",
        SystemError::StationOutside { .. } => "use beam.end for its end",
        SystemError::ParticleTurned { by, .. } => match by {
            Turning::RigidJoint => {
                "use scene.hinge(…), or scene.mass(…) on the beam; a rigid body, scene.body(…), turns"
            }
            Turning::RotaryInertia => "leave out the rotary inertia",
            Turning::Load => "only a force of fixed direction can act on it",
            Turning::Spin => "leave out the spin",
            Turning::Drive => {
                "move it along x and y alone; a motor turns a section of a beam, or a body: scene.motor(body.centre, …)"
            }
            Turning::TorsionSpring => {
                "put a torsion spring between sections of beams or rigid bodies"
            }
        },
        _ => return None,
    };
    Some(advice.into())
}

fn on_slider(error: &SliderError) -> Option<String> {
    let advice = match error {
        SliderError::Open { nearest: Approach::On { .. }, .. } => {
            "give that as `at`, or leave `at` out"
        }
        SliderError::Open { nearest: Approach::Apart { .. }, .. } => "move one of them",
        SliderError::LeavesMaster { .. } => {
            "start it with the velocity of the beam there and whatever it has along the beam, or give the slider the option \
             velocities: \"project\", which takes the nearest velocities that fit"
        }
        SliderError::RuleOfOneBeam { .. } => "take conserving()",
        _ => return None,
    };
    Some(advice.into())
}

fn on_track(error: &TrackError) -> Option<String> {
    let advice = match error {
        TrackError::Apart { .. } => {
            "give the beams in the order in which the track leads along them; each may be drawn from either end"
        }
        TrackError::Open { .. } => "leave out closed: true, or add the beams that lead back",
        TrackError::Loose { .. } => {
            "join them before the track is made: scene.rigid(…) with both ends, or scene.hinge(…)"
        }
        TrackError::Empty { .. } => "give at least one beam: scene.track([a, b])",
        TrackError::Again { .. } => return None,
    };
    Some(advice.into())
}

fn on_archive(error: &ArchiveError) -> Option<String> {
    let advice = match error {
        ArchiveError::Function { .. } => {
            "use hold_for, ramp, pulse, smooth_pulse, sine or table, or sums and products of them, and what std/schedules makes of these; in place of a controller springs and \
             dampers: scene.torsion_spring(…)"
        }
        ArchiveError::Release { .. } => {
            "save the simulation when that has let go, or say the time: #{ at: 0.5 }"
        }
        ArchiveError::Sensor { .. } => "record ready quantities such as \"rod.end.x\"",
        ArchiveError::Foreign => "files of simulations are those that sim.save(…) has written",
        ArchiveError::Content { .. } => {
            "it was not written by sim.save(…), or by a withy with a mistake"
        }
        _ => return None,
    };
    Some(advice.into())
}

const SMOOTH: &str = "let it get there in a time: import \"std/schedules\" as schedules; #{ y: 0.1 * schedules::smooth_step(0, 0.05) }; \
                      what is to move with a speed from the start begins with it: |t| 3 * t";

fn cause_of(error: &StepError) -> Option<&LoadError> {
    let StepError::Load { source, .. } = error else { return None };
    source.downcast_ref()
}

fn on_load(error: &LoadError) -> Option<String> {
    let advice = match error {
        LoadError::ManyParts { .. } => "write it as schedule(|t| …)",
        LoadError::ShortTable { .. } => "write [[t, factor], …]",
        LoadError::Jump { .. } => SMOOTH,
        LoadError::InfiniteRate { .. } => SMOOTH,
        _ => return None,
    };
    Some(advice.into())
}

fn on_beam(error: &BeamError) -> Option<String> {
    match error {
        BeamError::Quadrature { .. } => {
            Some("quadrature: \"patch\", the default, finds points and weights by itself".into())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::LinearError;

    #[test]
    fn advice_is_found_behind_other_errors() {
        let empty = || SystemError::Empty { scene: "a".into() };
        for error in [
            &empty() as &(dyn Error + 'static),
            &SimulationError::Model(empty()),
            &StaticsError::Model(empty()),
            &ArchiveError::Scene(SimulationError::Model(empty())),
        ] {
            assert!(on(error).is_some_and(|told| told.contains("scene.beam(")), "{error}");
        }
        assert_eq!(on(&LinearError::Singular { unknown: 1, size: 2 }), None);
    }
}
