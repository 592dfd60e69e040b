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
}
