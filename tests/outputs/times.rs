//! Removal of times, which differ between runs, from outputs.

/// Removes numbers before units of time, and after words of a report that denote times.
pub fn without_times(text: &str) -> String {
    let lines = text.lines().map(|line| {
        let words = line.split_inclusive(' ').collect::<Vec<_>>();
        let mut said = String::new();
        for (index, word) in words.iter().enumerate() {
            let unit =
                words.get(index + 1).map(|next| next.trim_matches([' ', ',', '.', ';', ')']));
            let before = index.checked_sub(1).map(|before| words[before].trim());
            let is_time = unit
                .is_some_and(|unit| ["ns", "us", "µs", "ms", "s", "min"].contains(&unit))
                || before.is_some_and(|key| key.contains("wall_s"));
            said +=
                if is_time && word.contains(|c: char| c.is_ascii_digit()) { "TIME " } else { word };
        }
        said.trim_end().to_owned()
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Keeps words only, for tables in which all numbers may be times. Removes marks of the fastest row and warnings of a busy machine.
pub fn without_numbers(text: &str) -> String {
    let lines = text.lines().filter(|line| !line.contains("warning: the same again took"));
    let words = lines.flat_map(|line| {
        let parts = line.split([' ', ',', '(', ')', '|']);
        let words = parts.filter(|word| !word.starts_with(|c: char| "0123456789+-≤─●".contains(c)));
        words.filter(|word| !word.is_empty()).chain(["\n"])
    });
    words.collect::<Vec<_>>().join(" ")
}
