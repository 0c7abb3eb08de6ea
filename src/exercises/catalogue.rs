//! Catalogue of all exercises, whose files are embedded in the program.

use super::error::ExerciseError;
use super::exercise::Exercise;
use crate::script::messages::suggest::nearest;

/// Series of exercises on one subject.
#[derive(Debug, PartialEq, Eq)]
pub struct ExerciseTrack {
    /// Name of the track, which is also the name of its folder.
    pub name: &'static str,
    /// Title of the track.
    pub title: &'static str,
}

/// All tracks, in the order in which they are offered.
pub const TRACKS: &[ExerciseTrack] = &[
    ExerciseTrack { name: "beams", title: "Beams and sections" },
    ExerciseTrack { name: "splines", title: "Splines and knot vectors" },
    ExerciseTrack { name: "integrators", title: "Integrators and invariants" },
    ExerciseTrack { name: "sliding", title: "Joints and sliding" },
    ExerciseTrack { name: "contact", title: "Friction and contact" },
    ExerciseTrack { name: "studies", title: "Sweeps and fits" },
];

macro_rules! exercise {
    ($track:literal, $name:literal) => {
        Exercise {
            track: $track,
            name: $name,
            start: include_str!(concat!("../../scripts/exercises/", $track, "/", $name, ".rhai")),
            solution: include_str!(concat!(
                "../../scripts/exercises/solutions/",
                $track,
                "/",
                $name,
                ".rhai"
            )),
            judge: include_str!(concat!(
                "../../scripts/exercises/judges/",
                $track,
                "/",
                $name,
                ".rhai"
            )),
        }
    };
}

/// All exercises, grouped by track, and in each track from easy to hard.
pub const EXERCISES: &[Exercise] = &[
    exercise!("beams", "change_one_number"),
    exercise!("beams", "rectangle"),
    exercise!("beams", "circle"),
    exercise!("beams", "stocky"),
    exercise!("beams", "first_frequency"),
    exercise!("splines", "knot_vector"),
    exercise!("splines", "kink"),
    exercise!("splines", "refine"),
    exercise!("splines", "locking"),
    exercise!("splines", "unlocking"),
    exercise!("integrators", "keep_the_energy"),
    exercise!("integrators", "load_inside_a_step"),
    exercise!("integrators", "order"),
    exercise!("integrators", "decay"),
    exercise!("integrators", "budget"),
    exercise!("sliding", "pendulum"),
    exercise!("sliding", "corner"),
    exercise!("sliding", "bounces"),
    exercise!("sliding", "bead_clock"),
    exercise!("sliding", "launch"),
    exercise!("sliding", "sliding_rule"),
    exercise!("contact", "friction_angle"),
    exercise!("contact", "bounce_heights"),
    exercise!("contact", "belt"),
    exercise!("contact", "jam"),
    exercise!("contact", "take_off"),
    exercise!("studies", "best_angle"),
    exercise!("studies", "whose_stiffness"),
];

/// Finds an exercise by its name, by `track/name`, or by the path of its file.
///
/// # Errors
/// Fails if the exercise does not exist. The error suggests a similar name.
pub fn find(name: &str) -> Result<&'static Exercise, ExerciseError> {
    let wanted = name.strip_suffix(".rhai").unwrap_or(name);
    let is_meant = |exercise: &&Exercise| {
        wanted == exercise.name
            || wanted == exercise.id()
            || wanted.ends_with(&format!("/{}", exercise.id()))
    };
    EXERCISES.iter().find(is_meant).ok_or_else(|| {
        let short = wanted.rsplit('/').next().unwrap_or(wanted);
        let nearest = nearest(short, EXERCISES.iter().map(|exercise| exercise.name));
        ExerciseError::Unknown { name: name.into(), nearest: nearest.map(str::to_owned) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exercises_are_found_by_name_path_and_file_name() {
        for name in ["kink", "splines/kink", "splines/kink.rhai", "./x/splines/kink.rhai"] {
            assert_eq!(find(name).unwrap().id(), "splines/kink", "{name}");
        }
    }

    #[test]
    fn misspelled_exercise_names_get_a_suggestion() {
        let message = find("knik").unwrap_err().to_string();
        assert!(message.contains("did you mean 'kink'?"), "{message}");
        assert!(find("beams/kink").is_err());
    }

    #[test]
    fn exercise_names_are_unique_and_tracks_are_ordered() {
        let tracks: Vec<_> = EXERCISES.iter().map(|exercise| exercise.track).collect();
        let known: Vec<_> = TRACKS.iter().map(|track| track.name).collect();
        assert_eq!(tracks.chunk_by(|a, b| a == b).map(|run| run[0]).collect::<Vec<_>>(), known);
        for (index, exercise) in EXERCISES.iter().enumerate() {
            assert!(EXERCISES[..index].iter().all(|other| other.name != exercise.name));
        }
    }
}
