//! Length limit of messages, which are shortened in the middle.

const MOST: usize = 1600;
const END: usize = 600;

pub fn brief(text: String) -> String {
    // The number of bytes is an upper bound of the number of characters.
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
    format!("{begin} […{} characters omitted…] {end}", count - MOST)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_long_texts_are_shortened_in_the_middle() {
        assert_eq!(brief("as it is".into()), "as it is");
        let borderline = "é".repeat(MOST);
        assert_eq!(brief(borderline.clone()), borderline);
        let cut = brief(format!("unknown '{}'; allowed: a, b", "é".repeat(1 << 20)));
        assert!(cut.starts_with("unknown 'é") && cut.ends_with("é'; allowed: a, b"), "{cut}");
        assert!(cut.contains("characters omitted") && cut.chars().count() < MOST + 60);
    }
}
