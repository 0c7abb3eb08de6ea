//! Messages of a length that a person can read: what they quote may be of any length, and is cut in its middle.

/// Longer messages are cut to so many characters, and a few words that say so.
const MOST: usize = 1600;
/// Characters that are kept of the end, where messages say what is allowed.
const END: usize = 600;

/// The text, with its middle left out where it is longer than anybody reads.
pub fn brief(text: String) -> String {
    // Only a text of so many bytes can have so many characters.
    if text.len() <= MOST {
        return text;
    }
    let count = text.chars().count();
    if count <= MOST {
        return text;
    }
    let place = |index: usize| text.char_indices().nth(index).map_or(text.len(), |(at, _)| at);
    let begin = &text[..place(MOST - END)];
    let end: Vec<char> = text.chars().rev().take(END).collect();
    let end: String = end.into_iter().rev().collect();
    format!("{begin} […{} characters are left out here…] {end}", count - MOST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_texts_are_cut_and_only_in_the_middle() {
        assert_eq!(brief("as it is".into()), "as it is");
        let borderline = "é".repeat(MOST);
        assert_eq!(brief(borderline.clone()), borderline);
        let cut = brief(format!("unknown '{}'; allowed: a, b", "é".repeat(1 << 20)));
        assert!(cut.starts_with("unknown 'é") && cut.ends_with("é'; allowed: a, b"), "{cut}");
        assert!(cut.contains("characters are left out here") && cut.chars().count() < MOST + 60);
    }
}
