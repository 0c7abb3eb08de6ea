//! Suggestions for misspelt names.

/// Largest length of a misspelt name for which suggestions are searched [bytes].
const LONGEST: usize = 200;

/// Candidate that is most similar to `wrong`, but not equal; `None` if no candidate is similar enough, or if `wrong` is too long.
pub fn nearest<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    if wrong.len() > LONGEST {
        return None;
    }
    let wrong_lower = wrong.to_lowercase();
    let mistakes_allowed = (wrong.chars().count() / 3).clamp(1, 3);
    candidates
        .into_iter()
        .filter(|candidate| *candidate != wrong)
        .map(|candidate| {
            (strsim::damerau_levenshtein(&wrong_lower, &candidate.to_lowercase()), candidate)
        })
        .filter(|(distance, candidate)| {
            *distance <= mistakes_allowed && *distance < candidate.chars().count()
        })
        .min()
        .map(|(_, candidate)| candidate)
}

/// At most five candidates that contain `wrong` as a word or start with it, for example `run_to` for `run`.
/// There are none if `wrong` has fewer than three characters.
pub fn related<'a>(wrong: &str, candidates: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    const MOST: usize = 5;
    const SHORTEST: usize = 3;
    let wrong = wrong.to_lowercase();
    if wrong.chars().count() < SHORTEST {
        return Vec::new();
    }
    let mut found: Vec<&str> = Vec::new();
    for candidate in candidates {
        let mut words = candidate.split('_');
        let is_related = candidate.starts_with(&wrong) || words.any(|word| word == wrong);
        if is_related && candidate != wrong && !found.contains(&candidate) {
            found.push(candidate);
        }
    }
    found.truncate(MOST);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn suggestions_are_made_only_for_similar_names() {
        let known = ["length", "EA", "EI", "rho_A", "section"];
        assert_eq!(nearest("lenght", known), Some("length"));
        assert_eq!(nearest("ea", known), Some("EA"));
        assert_eq!(nearest("rhoA", known), Some("rho_A"));
        assert_eq!(nearest("temperature", known), None);
        assert_eq!(nearest("x", ["y"]), None);
        let long = "l".repeat(LONGEST + 2);
        assert_eq!(nearest(&long, [&long[1..]]), None, "nothing is compared");
    }

    #[test]
    fn names_are_found_by_their_parts() {
        let known = ["run_to", "plot_motion", "plot_history", "truncate"];
        assert_eq!(related("run", known), ["run_to"]);
        assert_eq!(related("plot", known), ["plot_motion", "plot_history"]);
        assert_eq!(related("motion", known), ["plot_motion"]);
        assert!(related("to", known).is_empty());
    }
}
