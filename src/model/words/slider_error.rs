//! What can be wrong with a sliding joint.

/// The parts of a slider in words, for messages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SliderParts {
    /// The name of the slider.
    pub slider: String,
    /// The slave of the slider, the point that slides, in words.
    pub slave: String,
    /// The name of the slider's master, the beam on which it slides.
    pub beam: String,
}

/// A sliding joint that cannot be described or built.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SliderError {
    /// A slider whose slave is a part of its master.
    #[error(
        "slider '{}': {} is on the beam '{}' itself; a beam cannot slide on itself, choose another beam",
        _0.slider, _0.slave, _0.beam
    )]
    OnItself(SliderParts),
    /// A slider whose slave is not on its master.
    #[error(
        "slider '{}': {} is at {from}, {gap:.3e} from its place {to} on the beam '{}'; {advice}",
        parts.slider, parts.slave, parts.beam
    )]
    Open {
        /// The slider whose slave is not on its master.
        parts: SliderParts,
        /// The place of the slave, in words.
        from: String,
        /// The place on the master where the slave should be, in words.
        to: String,
        /// The distance of the slave from that place on the master [length].
        gap: f64,
        /// What to do about a slave that is not on its master.
        advice: String,
    },
    /// A slider whose slave slides on the same master already.
    #[error(
        "slider '{}': {} already slides on the beam '{}'; remove one of the two sliders",
        _0.slider, _0.slave, _0.beam
    )]
    Twice(SliderParts),
    /// A slider whose slave is tied to its master as well.
    #[error(
        "slider '{}': {} is also joined to the beam '{}', on which it then cannot slide; remove the joint or the slider",
        _0.slider, _0.slave, _0.beam
    )]
    Tied(SliderParts),
    /// Start velocities with which a slider would leave its master.
    #[error(
        "slider '{slider}': at the start its point moves across its beam with a speed of {speed}; start it with the velocity of the beam there and whatever it has along the beam, or give the slider the option velocities: \"project\", which takes the nearest velocities that fit"
    )]
    LeavesMaster {
        /// The name of the slider with such start velocities.
        slider: String,
        /// The speed of the slave relative to its master, across it [length/time].
        speed: f64,
    },
    /// A slider between places that are held already.
    #[error(
        "slider '{}': {} and its place on the beam '{}' are both held already, so that the contact force is not determined; remove the slider or a support",
        _0.slider, _0.slave, _0.beam
    )]
    HeldBesides(SliderParts),
    /// Sliders that do not determine their forces.
    #[error(
        "the sliders '{sliders}' hold each other: their contact forces are not determined; remove one of them, or a support"
    )]
    Overdetermined {
        /// The names of the sliders whose forces are not determined.
        sliders: String,
    },
}
