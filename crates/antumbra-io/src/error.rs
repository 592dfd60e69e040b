//! Errors at the edge: one message with file, place, what is wrong and what to do.

use antumbra::scene::SceneError;

/// Why a file could not be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file}{}{place}{}{what}", sep(file), sep(place))]
pub struct ReadError {
    /// The file as the person named it; empty for bytes from memory.
    pub file: String,
    /// Where in it ("accessor 12", "line 40"); may be empty.
    pub place: String,
    /// What is wrong, with its numbers.
    pub what: String,
    /// What to do about it; may be empty.
    pub hint: String,
}

fn sep(part: &str) -> &'static str {
    if part.is_empty() { "" } else { ": " }
}

impl ReadError {
    /// An error at a place of the file.
    pub fn new(place: impl Into<String>, what: impl Into<String>) -> ReadError {
        ReadError { file: String::new(), place: place.into(), what: what.into(), hint: String::new() }
    }

    /// The same with advice.
    pub fn hint(self, hint: impl Into<String>) -> ReadError {
        ReadError { hint: hint.into(), ..self }
    }

    /// The same with the name of the file.
    pub fn of(self, file: impl Into<String>) -> ReadError {
        ReadError { file: file.into(), ..self }
    }
}

impl From<SceneError> for ReadError {
    fn from(e: SceneError) -> ReadError {
        ReadError { file: String::new(), place: e.place, what: e.what, hint: e.hint }
    }
}

/// Why a picture could not be written. Nothing is left behind.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{file} cannot be written ({why})")]
pub struct WriteError {
    /// The file.
    pub file: String,
    /// The cause.
    pub why: String,
}

/// The words for an error of the file system.
pub(crate) fn io_words(e: &std::io::Error) -> String {
    use std::io::ErrorKind as K;
    match e.kind() {
        K::NotFound => "no such file".into(),
        K::PermissionDenied => "permission denied".into(),
        K::IsADirectory => "it is a folder".into(),
        K::NotADirectory => "a part of its path is not a folder".into(),
        K::StorageFull => "no space left".into(),
        K::ReadOnlyFilesystem => "the file system is read-only".into(),
        _ => {
            let text = e.to_string();
            text.split(" (os error").next().unwrap_or(&text).to_lowercase()
        }
    }
}
