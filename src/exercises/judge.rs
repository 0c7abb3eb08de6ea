//! Parses the `//!` lines at the start of the script of a judge. They contain the required variables and the hints.
//! A line that does not begin with `needs:` or `hint:` continues the entry before it:
//!
//! ```text
//! //! needs: sim (simulation), rod (beam)
//! //! hint: The first hint may go on
//! //!   in further lines.
//! //! hint: The second one says more.
//! ```

#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Judge {
    pub needs: Vec<Need>,
    pub hints: Vec<String>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    pub name: String,
    pub of: String,
}

impl Judge {
    pub fn of(script: &str) -> Self {
        let head = script.lines().map_while(|line| line.strip_prefix("//!")).map(str::trim);
        let mut entries: Vec<String> = Vec::new();
        for line in head {
            let begins = ["needs:", "hint:"].iter().any(|key| line.starts_with(key));
            match entries.last_mut() {
                Some(last) if !begins => *last += &format!(" {line}"),
                _ => entries.push(line.to_owned()),
            }
        }
        let of_key = |key: &'static str| {
            entries.iter().filter_map(move |entry| entry.strip_prefix(key)).map(str::trim)
        };
        Self {
            needs: of_key("needs:")
                .flat_map(|list| list.split(','))
                .filter_map(parse_requirement)
                .collect(),
            hints: of_key("hint:").map(str::to_owned).collect(),
        }
    }
}

fn parse_requirement(text: &str) -> Option<Need> {
    let (name, of) = text.trim().strip_suffix(')')?.split_once(" (")?;
    Some(Need { name: name.into(), of: of.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn judge_header_lists_needs_and_hints_in_order() {
        let script = "//! needs: sim (simulation), n (whole number)\n//! hint: Look\n//!   twice.\n\
                      //! hint: Then think.\n\ncheck(true);\n//! hint: not in the head";
        let judge = Judge::of(script);
        let need = |name: &str, of: &str| Need { name: name.into(), of: of.into() };
        assert_eq!(judge.needs, [need("sim", "simulation"), need("n", "whole number")]);
        assert_eq!(judge.hints, ["Look twice.", "Then think."]);
    }

    #[test]
    fn judge_without_a_header_has_no_needs() {
        assert_eq!(Judge::of("check(true);\n//! hint: late"), Judge::default());
    }
}
