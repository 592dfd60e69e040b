//! Names that other formats take: plain letters, each once.

use std::collections::HashSet;

/// Names that were given.
#[derive(Default)]
pub(super) struct Names(HashSet<String>);

impl Names {
    /// The name as letters, digits, `-` and `_`, or `instead` if nothing of it is left; numbered where it was given before.
    pub(super) fn give(&mut self, name: &str, instead: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() || c == '-' { c } else { '_' };
        let plain: String = name.chars().map(plain).take(60).collect();
        let plain = plain.trim_matches('_');
        let base = if plain.is_empty() { instead } else { plain };
        let numbered = (2u64..).map(|n| format!("{base}-{n}"));
        let free = std::iter::once(base.to_string()).chain(numbered).find(|n| !self.0.contains(n));
        let name = free.unwrap_or_default();
        self.0.insert(name.clone());
        name
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_plain_and_each_is_given_once() {
        let mut names = Names::default();
        let given = ["Tür.1", "Tür.1", "", "$x", "..."].map(|n| names.give(n, "object"));
        assert_eq!(given, ["T_r_1", "T_r_1-2", "object", "x", "object-2"]);
    }
}
