//! Hints, in terms of the language, for errors of layers that do not know about scripts.

use std::error::Error;

use crate::beams::BeamError;
use crate::integrators::StepError;
use crate::loads::LoadError;
use crate::simulation::{ArchiveError, DerivativeError, SimulationError};
use crate::statics::{BucklingError, InTime, NonlinearPart, StaticsError, StepFailure};
use crate::system::{Approach, SliderError, SystemError, TrackError, Turning};

/// Hint for an error or for one of its causes; `None` if there is none.
pub fn hint_for(error: &(dyn Error + 'static)) -> Option<String> {
    let own = None
        .or_else(|| error.downcast_ref().and_then(simulation_hint))
        .or_else(|| error.downcast_ref().and_then(statics_hint))
        .or_else(|| error.downcast_ref().and_then(buckling_hint))
        .or_else(|| error.downcast_ref().and_then(system_hint))
        .or_else(|| error.downcast_ref().and_then(archive_hint))
        .or_else(|| error.downcast_ref().and_then(load_hint))
        .or_else(|| error.downcast_ref().and_then(beam_hint));
    own.or_else(|| hint_for(error.source()?))
}

fn simulation_hint(error: &SimulationError) -> Option<String> {
    Some(match error {
        SimulationError::Model(error) => return system_hint(error),
        SimulationError::End { end, .. } if !end.is_finite() => "give a finite time".into(),
        SimulationError::End { .. } => "give a later time, or go back with sim.rewind(t)".into(),
        SimulationError::Step { .. } | SimulationError::Smallest { .. } => {
            "the history up to this time is kept; try a smaller dt or a finer mesh, and check \
            loads, stiffness, units and supports".into()
        }
        SimulationError::Load { source } => {
            let own = cause_of(source).and_then(load_hint);
            own.unwrap_or_else(|| "loads and drives need a finite value at all times".into())
        }
        SimulationError::Tolerance { .. } => {
            "the history up to this time is kept; use a larger tolerance or a smaller step: \
            adaptive(#{ tolerance: …, smallest: … }); adaptive steps end at jumps of \
            schedules, but a function with jumps must declare them: schedule(|t| …, [t1, t2])"
                .into()
        }
        SimulationError::Ended { .. } => {
            "give the slider the option ends: \"bounce\" or \"release\" to continue, or test \
            sim.ended before a step".into()
        }
        SimulationError::TooManySamples { .. } => {
            "give `sample` the period of the controller, between dt/100 and 10 dt".into()
        }
        SimulationError::NoMeanForces { sensor, .. } => {
            let (joint, quantity) = sensor.rsplit_once('.').unwrap_or_default();
            format!("record \"{joint}.present_{quantity}\"")
        }
        SimulationError::StartMismatch { .. } => {
            "find the equilibrium with load_factor: 1 at a time at which the functions of drives \
            and springs have these values".into()
        }
        SimulationError::SleevesAtRest { .. } => "use more spans at the sleeves".into(),
        SimulationError::TooManyArrivals { .. } => "try ends: \"release\" or \"stop\"".into(),
        SimulationError::TooFewSteps { .. } => "sim.rewind(0) goes to the start".into(),
        SimulationError::OutsideRun { .. } => {
            "give a time in between, or use sim.run_to(t) to continue".into()
        }
        SimulationError::NoSnapshots { .. } => {
            "start with scene.start(#{ …, snapshots: 64 }), in megabytes, or call sim.keep_snapshots(64) before the steps".into()
        }
        SimulationError::BeforeFirst { .. } => {
            "earlier states are not in a file of sim.save(…), and are not stored before \
            sim.keep_snapshots(…)".into()
        }
        SimulationError::NoSnapshot { first, limit, .. } => format!(
            "sim.rewind({first}) goes there; to store more states start with scene.start(#{{ …, \
            snapshots: {} }})",
            (4.0 * limit).ceil().max(64.0)
        ),
        SimulationError::Derivative(error) => match error {
            DerivativeError::Form { .. } | DerivativeError::Times { .. } => {
                "give plain numbers in place of scene.parameter(…) and use central differences, \
                as fit does".into()
            }
            DerivativeError::Mean { sensor } => match sensor.strip_suffix(".power") {
                Some(name) => format!("use the rate of the column work.{name}"),
                None => "record the present force".into(),
            },
            DerivativeError::Adaptive => "give dt a number".into(),
            _ => return None,
        },
        SimulationError::Method(_)
        | SimulationError::StepSize(_)
        | SimulationError::EventLocation { .. }
        | SimulationError::FrictionMethod { .. }
        | SimulationError::SideMethod { .. }
        | SimulationError::Interrupted { .. } => return None,
    })
}

fn statics_hint(error: &StaticsError) -> Option<String> {
    const AT_REST: &str = "simulate a damped motion until it is at rest: scene.start(#{ integrator: \
        energy_decaying(#{ chi: 1 }), dt: … })";
    Some(match error {
        StaticsError::Model(error) => return system_hint(error),
        StaticsError::NoLoad { .. } => {
            "loads are evaluated at one time: select it with the option time; drag, wind and \
            dampers act only on motion"
                .into()
        }
        StaticsError::TimeDependent { by: InTime::Speed, .. } => {
            "give the displacement in equilibrium: x, y or angle as a function of time that \
            begins with 0, such as angle: |t| 0.5 * t, and scene.equilibrium(#{ time: 1 })"
                .into()
        }
        StaticsError::Brake { .. } => {
            "in a scene for the equilibrium, replace the brake by a clamp or a torsion spring if \
            it holds, or by scene.moment if it slips"
                .into()
        }
        StaticsError::TimeDependent { .. } => {
            "give its force or torque in equilibrium as a number, in a scene for the \
            equilibrium"
                .into()
        }
        StaticsError::NoScaledLoad { .. } | StaticsError::Driven { .. } => {
            "leave out control: arc_length()".into()
        }
        StaticsError::PathLost { points, .. } => format!(
            "to see the path, end it with arc_length(#{{ points: {points} }}); shorter steps \
            may continue it, arc_length(#{{ longest: 0.01 }})"
        ),
        StaticsError::Unrestrained { reason, .. } | StaticsError::NoEquilibrium { reason, .. }
            if matches!(**reason, StepFailure::LeavesMaster { .. }) =>
        {
            "with ends: \"stop\" it stays in contact with the end; a slider that left its beam \
            has no equilibrium"
                .into()
        }
        StaticsError::Unrestrained { .. } => {
            format!("fix it with scene.clamp(…) or scene.hinge(…), or {AT_REST}")
        }
        StaticsError::NoEquilibrium { reached: 0.0, .. } => {
            "use more load_steps; a part that is prestressed in the initial scene, such as a \
            spring of another length, acts before any load: place it closer to its \
            equilibrium, or start without prestress and move its end by scene.move; for \
            snap-through use control: arc_length()"
                .into()
        }
        StaticsError::NoEquilibrium { .. } => {
            "use more load_steps; for snap-through use control: arc_length(), or stop before it \
            with load_factor"
                .into()
        }
        StaticsError::Load { .. }
        | StaticsError::Value { .. }
        | StaticsError::Interrupted { .. } => return None,
    })
}

fn buckling_hint(error: &BucklingError) -> Option<String> {
    let advice = match error {
        BucklingError::Statics(error) => return statics_hint(error),
        BucklingError::FewCriticalLoads { available: 0, .. } => {
            "load_factor: -1 reverses the loads"
        }
        BucklingError::FewCriticalLoads { .. } => {
            "request at most the number that was found, or use a finer mesh"
        }
        BucklingError::Modes(_)
        | BucklingError::InaccurateLoad { .. }
        | BucklingError::Uncounted
        | BucklingError::NotConverged { .. } => return None,
        BucklingError::Mechanism { .. } => {
            "fix it with scene.clamp(…) or scene.hinge(…), or add a spring; for a part that is \
            held only by its loads, use scene.equilibrium().is_stable"
        }
        BucklingError::Unstable { .. } => "reduce the prestress of its springs",
        BucklingError::NoLoad { .. } => {
            "add a load or gravity, or select a time at which a load acts with the option time"
        }
        BucklingError::Follower { .. } => {
            "give the load a fixed direction, or simulate the motion after a small disturbance: \
            above the critical load the disturbance grows"
        }
        BucklingError::Unavailable { reason: NonlinearPart::Drive, .. } => {
            "replace it by a support and a load"
        }
        BucklingError::Unavailable { .. } => {
            "increase the load with scene.equilibrium(#{ load_factor: … }) until is_stable is false"
        }
    };
    Some(advice.into())
}

fn system_hint(error: &SystemError) -> Option<String> {
    let advice = match error {
        SystemError::Slider(error) => return slider_hint(error),
        SystemError::Track(error) => return track_hint(error),
        SystemError::Empty { .. } => {
            "add one with scene.beam(#{ axis: …, section: … }) or scene.particle([x, y], mass)"
        }
        SystemError::Interrupted { .. } => return None,
        SystemError::NoSection { .. } => "give a station of a beam",
        SystemError::NoPoint { .. } => {
            "add it to the points of scene.body(…); its centre is body.centre"
        }
        SystemError::StartVelocity { .. } => {
            "for a rotation about a point use spin: 2, about: [x, y]; start attached parts with \
            the velocity at their joint; where a moving body is joined to a beam at rest, give \
            the node the velocity of the joined point of the body: scene.velocity(beam.end, \
            [vx, vy])"
        }
        SystemError::NoInertia { .. } => {
            "give the body an inertia, scene.body(#{ …, inertia: 0.1 }), or fix its angle: \
            scene.support(body.centre, #{ angle: true })"
        }
        SystemError::Massless { .. } => {
            "give the body a mass, scene.body(#{ …, mass: 1 }), or join it to another part: \
            scene.hinge(body.centre)"
        }
        SystemError::PointAlone { .. } => "give velocity and spin to scene.body(#{ … })",
        SystemError::StationOutside { .. } => "use beam.end for its end",
        SystemError::ParticleTurned { by, .. } => match by {
            Turning::RigidJoint => {
                "use scene.hinge(…), or scene.mass(…) on the beam; a rigid body, scene.body(…), \
                has a rotation"
            }
            Turning::RotaryInertia => "leave out the rotary inertia",
            Turning::Load => "use a force of fixed direction",
            Turning::Spin => "leave out the spin",
            Turning::Drive => {
                "move it in x and y only; a motor rotates a section of a beam, or a body: \
                scene.motor(body.centre, …)"
            }
            Turning::TorsionSpring => {
                "use torsion springs between sections of beams or rigid bodies"
            }
        },
        _ => return None,
    };
    Some(advice.into())
}

fn slider_hint(error: &SliderError) -> Option<String> {
    let advice = match error {
        SliderError::Open { nearest: Approach::On { .. }, .. } => {
            "give this value for `at`, or omit `at`"
        }
        SliderError::Open { nearest: Approach::Distant { .. }, .. } => "move one of them",
        SliderError::LeavesMaster { .. } => {
            "start it with the velocity of the beam there plus any velocity along the beam, or \
            give the slider the option velocities: \"project\", which uses the nearest \
            compatible velocities"
        }
        SliderError::RuleOfOneBeam { .. } | SliderError::FrictionRule { .. } => "use conserving()",
        _ => return None,
    };
    Some(advice.into())
}

fn track_hint(error: &TrackError) -> Option<String> {
    let advice = match error {
        TrackError::Gap { .. } => {
            "give the beams in the order of the track, each in either direction"
        }
        TrackError::Open { .. } => "leave out closed: true, or add the beams that lead back",
        TrackError::NotJoined { .. } => {
            "join them before creating the track: scene.rigid(…) with both ends, or \
            scene.hinge(…)"
        }
        TrackError::Empty { .. } => "give at least one beam: scene.track([a, b])",
        TrackError::RepeatedBeam { .. } => return None,
    };
    Some(advice.into())
}

fn archive_hint(error: &ArchiveError) -> Option<String> {
    let advice = match error {
        ArchiveError::Function { .. } => {
            "use hold_for, ramp, pulse, smooth_pulse, sine or table, or sums and products of \
            them, and schedules of std/schedules; in place of a controller use springs and \
            dampers: scene.torsion_spring(…)"
        }
        ArchiveError::Release { .. } => {
            "save the simulation after the release, or give a time: #{ at: 0.5 }"
        }
        ArchiveError::Sensor { .. } => "record built-in sensors such as \"rod.end.x\"",
        ArchiveError::Foreign => "use files that sim.save(…) has written",
        ArchiveError::Content { .. } => {
            "the file was not written by sim.save(…), or it was written by a defective version \
            of withy"
        }
        _ => return None,
    };
    Some(advice.into())
}

const SMOOTH: &str = "reach the position in a given time: import \"std/schedules\" as schedules; #{ y: 0.1 * \
    schedules::smooth_step(0, 0.05) }; or start with a velocity: |t| 3 * t";

fn cause_of(error: &StepError) -> Option<&LoadError> {
    let StepError::Load { source, .. } = error else { return None };
    source.downcast_ref()
}

fn load_hint(error: &LoadError) -> Option<String> {
    let advice = match error {
        LoadError::TooManyParts { .. } => "write it as schedule(|t| …)",
        LoadError::ShortTable { .. } => "write [[t, factor], …]",
        LoadError::NegativeLength { .. } => {
            "let the function, or the controller of the rate, end at a length of 0 or more"
        }
        LoadError::Jump { .. } => SMOOTH,
        LoadError::InfiniteRate { .. } => SMOOTH,
        _ => return None,
    };
    Some(advice.into())
}

fn beam_hint(error: &BeamError) -> Option<String> {
    match error {
        BeamError::Quadrature { .. } => {
            Some("use quadrature: \"patch\", the default, which sets points and weights".into())
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::LinearError;

    #[test]
    fn advice_is_found_for_nested_errors() {
        let empty = || SystemError::Empty { scene: "a".into() };
        for error in [
            &empty() as &(dyn Error + 'static),
            &SimulationError::Model(empty()),
            &StaticsError::Model(empty()),
            &ArchiveError::Scene(SimulationError::Model(empty())),
        ] {
            assert!(
                hint_for(error).is_some_and(|message| message.contains("scene.beam(")),
                "{error}"
            );
        }
        assert_eq!(hint_for(&LinearError::Singular { unknown: 1, size: 2 }), None);
    }
}
