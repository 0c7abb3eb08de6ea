//! Fuzzing inputs for the language: the scripts and examples of the project, cut, spliced and mutated by a seed.

use std::fs;
use std::path::Path;

use withy::script::packages::TABLES;

pub struct Corpus {
    snippets: Vec<String>,
    words: Vec<String>,
}

/// Numbers at the limits of their types, and absurdly large counts.
const EXTREMES: &[&str] = &[
    "0",
    "-1",
    "1",
    "2",
    "0.0",
    "-0.0",
    "0.5",
    "1e-308",
    "1e308",
    "-1e308",
    "1e400",
    "nan",
    "inf",
    "-inf",
    "9223372036854775807",
    "-9223372036854775808",
    "9223372036854775808",
    "1000000000",
    "1e9",
    "100000",
    "65537",
    "4294967296",
    "1e16",
    "5e-324",
    "[]",
    "()",
    "\"\"",
    "true",
    "|x| x",
    "#{}",
    "[0, 0]",
    "[[]]",
];

/// Fragments of the grammar, valid and invalid.
const PIECES: &[&str] = &[
    "let a = ",
    "const B = ",
    "fn f(x) { ",
    "}",
    "{",
    "(",
    ")",
    "[",
    "]",
    "#{",
    ";",
    ",",
    ": ",
    "::",
    ".",
    "?.",
    "??",
    "|x| ",
    "|| ",
    "if ",
    " else ",
    "while ",
    "loop { ",
    "for i in 0..3 { ",
    "switch a { 1 => 2 }",
    "return ",
    "break;",
    "continue;",
    "throw ",
    "try { ",
    " catch (e) { ",
    "import \"m\" as m;",
    "export a;",
    "print(",
    "a",
    "b",
    "f(a)",
    "this",
    " + ",
    " - ",
    " * ",
    " / ",
    " % ",
    " ^ ",
    " ** ",
    " /= ",
    "^=",
    " << ",
    " == ",
    " < ",
    "!",
    " && ",
    " in ",
    "..",
    "..=",
    "`x ${",
    "`",
    "\"",
    "'",
    "\\",
    "//",
    "/*",
    "*/",
    "\n",
    "\t",
    "\r",
    "\u{0}",
    "\u{feff}",
    "λ",
    "\u{E000}",
    "𝛼",
    "é",
    ".map(|x| ",
    ".filter(",
    ".sort(",
    ".call(",
    ".curry(",
    ".len()",
    ".pad(",
    "Fn(\"f\")",
    "global::B",
    "eval(",
    "#!",
    "is_def_var(\"a\")",
    "type_of(a)",
    "debug(",
    "until",
    "private fn",
    "/**",
    "#\"raw\"#",
];

impl Corpus {
    /// Loads the scripts, the sections of the suite, and the examples of all rows of the reference.
    pub fn load() -> Self {
        let home = Path::new(env!("CARGO_MANIFEST_DIR"));
        let mut snippets = Vec::new();
        for folder in ["scripts", "tests/suite"] {
            let mut files: Vec<_> = fs::read_dir(home.join(folder))
                .unwrap()
                .map(|entry| entry.unwrap().path())
                .filter(|path| path.extension().is_some_and(|extension| extension == "rhai"))
                .collect();
            files.sort();
            for file in files {
                let text = fs::read_to_string(file).unwrap();
                snippets.extend(text.split("// --- ").map(|section| format!("// {section}")));
            }
        }
        for table in TABLES {
            let examples = table.rows.iter().map(|row| format!("{}\n{}", table.setup, row.example));
            snippets.extend(examples);
        }
        let mut words: Vec<String> = snippets.iter().flat_map(|text| split(text)).collect();
        words.sort();
        words.dedup();
        assert!(snippets.len() > 100 && words.len() > 300, "the corpus is too small");
        Self { snippets, words }
    }

    /// Returns the input of a seed, which is deterministic.
    pub fn input(&self, seed: u64) -> String {
        let mut dice = Dice(seed);
        match dice.below(10) {
            0 => noise(&mut dice),
            1 => self.thrown_together(&mut dice),
            2 => nested(&mut dice),
            3..=6 => self.twisted(&mut dice),
            _ => self.mutant(&mut dice),
        }
    }

    fn snippet(&self, dice: &mut Dice) -> &str {
        &self.snippets[dice.below(self.snippets.len())]
    }

    fn thrown_together(&self, dice: &mut Dice) -> String {
        let word = |dice: &mut Dice| match dice.below(5) {
            0 => dice.pick(&self.words).clone(),
            1 => (*dice.pick(EXTREMES)).to_owned(),
            _ => (*dice.pick(PIECES)).to_owned(),
        };
        (0..dice.below(60)).map(|_| word(dice)).collect()
    }

    /// Returns a script with replaced numbers and names. Most results still parse.
    fn twisted(&self, dice: &mut Dice) -> String {
        let mut tokens = split(self.snippet(dice));
        let is_name = |token: &String| token.starts_with(|c: char| c.is_alphabetic());
        for _ in 0..=dice.below(3) {
            match dice.below(4) {
                0 => {
                    let places: Vec<_> =
                        (0..tokens.len()).filter(|at| is_name(&tokens[*at])).collect();
                    let names: Vec<_> = self.words.iter().filter(|word| is_name(word)).collect();
                    if !places.is_empty() {
                        tokens[*dice.pick(&places)] = (*dice.pick(&names)).clone();
                    }
                }
                _ => extreme_number(&mut tokens, dice),
            }
        }
        tokens.concat()
    }

    fn mutant(&self, dice: &mut Dice) -> String {
        let mut tokens = split(self.snippet(dice));
        for _ in 0..=dice.below(4) {
            self.mutate(&mut tokens, dice);
        }
        let mut text = tokens.concat();
        if dice.below(8) == 0 {
            let end = dice.below(text.chars().count() + 1);
            text = text.chars().take(end).collect();
        }
        text
    }

    fn mutate(&self, tokens: &mut Vec<String>, dice: &mut Dice) {
        if tokens.is_empty() {
            return tokens.push(dice.pick(&self.words).clone());
        }
        let at = dice.below(tokens.len());
        let other = dice.below(tokens.len());
        match dice.below(10) {
            0 => _ = tokens.remove(at),
            1 => tokens.swap(at, other),
            2 => tokens.insert(at, tokens[other].clone()),
            3 => tokens[at] = dice.pick(&self.words).clone(),
            4 => tokens.insert(at, (*dice.pick(PIECES)).to_owned()),
            5 => {
                let theirs = split(self.snippet(dice));
                tokens.truncate(at);
                tokens.extend(theirs.into_iter().skip(other));
            }
            6 => {
                let (from, to) = (at.min(other), at.max(other).min(at.min(other) + 20));
                let again = tokens[from..to].to_vec();
                tokens.splice(to..to, again);
            }
            _ => extreme_number(tokens, dice),
        }
    }
}

/// Replaces a number by an extreme value, or any token if the script has no number.
fn extreme_number(tokens: &mut [String], dice: &mut Dice) {
    let is_number = |token: &String| token.starts_with(|c: char| c.is_ascii_digit());
    let numbers: Vec<_> = (0..tokens.len()).filter(|at| is_number(&tokens[*at])).collect();
    let at = if numbers.is_empty() { dice.below(tokens.len()) } else { *dice.pick(&numbers) };
    if let Some(token) = tokens.get_mut(at) {
        *token = (*dice.pick(EXTREMES)).to_owned();
    }
}

fn noise(dice: &mut Dice) -> String {
    let length = dice.below(80);
    if dice.below(2) == 0 {
        let bytes: Vec<u8> = (0..length).map(|_| dice.below(256) as u8).collect();
        return String::from_utf8_lossy(&bytes).into_owned();
    }
    let letter =
        |dice: &mut Dice| char::from_u32(dice.below(0x11_0000) as u32).unwrap_or('\u{fffd}');
    (0..length).map(|_| letter(dice)).collect()
}

fn nested(dice: &mut Dice) -> String {
    let (open, close) = *dice.pick(&[
        ("(", ")"),
        ("[", "]"),
        ("{", "}"),
        ("#{a:", "}"),
        ("`${", "}`"),
        ("-", ""),
        ("!", ""),
        ("f(", ")"),
        ("|x|", ""),
        ("if true {", "}"),
        ("1+", ""),
        ("2^", ""),
        ("a.", ""),
        ("a?.b[", "]"),
        ("/*", "*/"),
        ("fn f(){", "}"),
        ("try {", "}"),
        ("[1].map(|x| ", ")"),
        ("switch 1 { 1 => ", "}"),
        ("a = ", ""),
        ("let x = ", ""),
    ]);
    let depth = 1 << dice.below(13);
    let closed = if dice.below(3) == 0 { dice.below(depth + 1) } else { depth };
    format!("{}1{}", open.repeat(depth), close.repeat(closed))
}

/// Splits a script into words, numbers, strings, white space and operators. The concatenation is the script.
fn split(text: &str) -> Vec<String> {
    let kind = |letter: char| match letter {
        letter if letter.is_alphanumeric() || letter == '_' => 0,
        letter if letter.is_whitespace() => 1,
        _ => 2,
    };
    let mut tokens: Vec<String> = Vec::new();
    let mut before = 2;
    for letter in text.chars() {
        let now = kind(letter);
        // A point between digits belongs to the number.
        let goes_on = (now == before && now != 2)
            || (letter == '.'
                && tokens.last().is_some_and(|token| token.chars().all(|c| c.is_ascii_digit())));
        match tokens.last_mut().filter(|_| goes_on) {
            Some(token) => token.push(letter),
            None => tokens.push(letter.to_string()),
        }
        before = if letter == '.' && goes_on { 0 } else { now };
    }
    tokens
}

/// Random numbers from a seed (SplitMix64), equal on all platforms.
pub struct Dice(pub u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    pub fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }

    pub fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}
