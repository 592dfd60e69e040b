//! What a person is told about a scene: notes and warnings while it is built, or the error that ends it.

/// How much it matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// Something was chosen for the person ("no camera: made one").
    Note,
    /// The file asks for something that is not drawn as asked.
    Warning,
}

/// A note or warning: `level: place: what`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// Note or warning.
    pub level: Level,
    /// Where in the scene ("material \"Glass\"", "accessor 12"); may be empty.
    pub place: String,
    /// What, in one line, and what was done about it.
    pub text: String,
}

/// Why there is no scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}{}{what}", if place.is_empty() { "" } else { ": " })]
pub struct SceneError {
    /// Where in the file or scene; may be empty.
    pub place: String,
    /// What is wrong, with its numbers.
    pub what: String,
    /// What to do about it; may be empty.
    pub hint: String,
}

impl SceneError {
    /// An error with place, cause and advice.
    pub fn new(place: impl Into<String>, what: impl Into<String>, hint: impl Into<String>) -> SceneError {
        SceneError { place: place.into(), what: what.into(), hint: hint.into() }
    }

    /// There is no light or camera (`kind`) of this name; the hint says which there are.
    pub fn unknown(kind: &str, name: &str, known: &[&str]) -> SceneError {
        const LISTED: usize = 20;
        let near = nearest(name, known).map(|n| format!("; did you mean \"{n}\"?")).unwrap_or_default();
        let hint = match known {
            [] => format!("The scene has no {kind}."),
            [only] => format!("Its only {kind} is \"{only}\"."),
            _ => {
                let listed: Vec<String> = known.iter().take(LISTED).map(|n| format!("\"{n}\"")).collect();
                let more = known.len().saturating_sub(LISTED);
                let more = if more > 0 { format!(" and {more} more") } else { String::new() };
                format!("Its {kind}s are {}{more}.", listed.join(", "))
            }
        };
        SceneError::new("", format!("there is no {kind} \"{name}\"{near}"), hint)
    }
}

/// The known word nearest to `text`, if one is near: the only one that begins so, or the one at the least edit distance,
/// which is at most a third of its length and at most 3.
pub fn nearest<'a>(text: &str, known: &[&'a str]) -> Option<&'a str> {
    let mut longer = known.iter().filter(|word| text.len() > 1 && word.starts_with(text));
    if let (Some(only), None) = (longer.next(), longer.next()) {
        return Some(only);
    }
    let distance = |word: &str| {
        let (a, b): (Vec<char>, Vec<char>) = (text.to_lowercase().chars().collect(), word.chars().collect());
        let mut row: Vec<usize> = (0..=b.len()).collect();
        let mut above_left_row = row.clone();
        for i in 1..=a.len() {
            let before = row.clone();
            row[0] = i;
            for j in 1..=b.len() {
                let change = usize::from(a[i - 1] != b[j - 1]);
                row[j] = (before[j] + 1).min(row[j - 1] + 1).min(before[j - 1] + change);
                let swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
                if swapped {
                    row[j] = row[j].min(above_left_row[j - 2] + 1);
                }
            }
            above_left_row = before;
        }
        row[b.len()]
    };
    known
        .iter()
        .map(|word| (distance(word), *word))
        .filter(|(d, word)| *d <= 3.min(1 + word.len() / 3))
        .min_by_key(|(d, _)| *d)
        .map(|(_, word)| word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_word_is_the_one_that_was_meant() {
        let known = ["none", "no-cos-light", "no-distance", "no-count"];
        assert_eq!(nearest("no-cos", &known), Some("no-cos-light"));
        assert_eq!(nearest("no-cout", &known), Some("no-count"));
        assert_eq!(nearest("nno", &known), Some("none"));
        assert_eq!(nearest("wrong-measure", &known), None);
    }

    #[test]
    fn what_there_is_is_said_by_name() {
        let said = |known: &[&str]| SceneError::unknown("light", "Lmap", known);
        assert_eq!(said(&["Lamp", "light 2"]).what, "there is no light \"Lmap\"; did you mean \"Lamp\"?");
        assert_eq!(said(&["Lamp", "light 2"]).hint, "Its lights are \"Lamp\", \"light 2\".");
        assert_eq!(said(&["sun"]).hint, "Its only light is \"sun\".");
        assert_eq!(said(&[]).hint, "The scene has no light.");
        assert!(said(&["x"; 50]).hint.ends_with(" and 30 more."));
    }
}
