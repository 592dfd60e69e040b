//! The files that a scene may name: never an address, never a path out of the scene's folder.

use std::collections::HashMap;
use std::fs::File;
use std::io::Read;
use std::path::{Component, Path, PathBuf};

use crate::error::io_words;
use crate::limits::Limits;

/// Why a file that a scene names was not opened.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FileError {
    /// The path is not allowed.
    #[error("{0}: not opened")]
    Refused(&'static str),
    /// The file is not there.
    #[error("no such file")]
    Missing,
    /// The file could not be read.
    #[error("it cannot be read ({0})")]
    Unreadable(String),
}

/// Where a reader gets the other files of a scene from.
pub trait Files {
    /// The bytes of the file at a path relative to the scene's file, with `/` between its parts.
    fn open(&self, relative: &str) -> Result<Vec<u8>, FileError>;
}

/// The parts of a relative path; refuses addresses and absolute paths of any system.
fn parts(relative: &str) -> Result<Vec<&str>, FileError> {
    let bytes = relative.as_bytes();
    if relative.contains("://") || relative.starts_with("data:") {
        return Err(FileError::Refused("addresses are never followed"));
    }
    let drive = bytes.len() >= 2 && bytes[0].is_ascii_alphabetic() && bytes[1] == b':';
    if drive || matches!(bytes.first(), Some(b'/' | b'\\')) {
        return Err(FileError::Refused("the path is absolute"));
    }
    if relative.is_empty() || bytes.contains(&0) {
        return Err(FileError::Refused("this is no path"));
    }
    Ok(relative.split(['/', '\\']).filter(|p| !p.is_empty() && *p != ".").collect())
}

/// `base` followed by `parts`, or `None` where `..` climbs above everything.
fn join(base: &Path, parts: &[&str]) -> Option<PathBuf> {
    let mut path = base.to_path_buf();
    for part in parts {
        match *part {
            ".." => {
                if !path.pop() {
                    return None;
                }
            }
            name => path.push(name),
        }
    }
    Some(path)
}

/// Files below a folder.
#[derive(Clone, Debug)]
pub struct FolderFiles {
    root: PathBuf,
    base: PathBuf,
    limit: u64,
}

impl FolderFiles {
    /// Paths are relative to `base` and stay within `root`; both must exist.
    pub fn new(root: &Path, base: &Path, limits: &Limits) -> Result<FolderFiles, FileError> {
        let full = |p: &Path| {
            let p = if p.as_os_str().is_empty() { Path::new(".") } else { p };
            p.canonicalize().map_err(|e| FileError::Unreadable(io_words(&e)))
        };
        Ok(FolderFiles { root: full(root)?, base: full(base)?, limit: limits.file_bytes })
    }
}

impl Files for FolderFiles {
    fn open(&self, relative: &str) -> Result<Vec<u8>, FileError> {
        const CLIMBS: FileError = FileError::Refused("the path leaves the folder of the scene");
        let path = join(&self.base, &parts(relative)?).ok_or(CLIMBS)?;
        if !path.starts_with(&self.root) {
            return Err(CLIMBS);
        }
        // A link inside the folder may point out of it: only the resolved path counts.
        let path = path.canonicalize().map_err(|_| FileError::Missing)?;
        if !path.starts_with(&self.root) {
            return Err(CLIMBS);
        }
        read_limited(&path, self.limit).map_err(FileError::Unreadable)
    }
}

/// The bytes of a regular file of at most `limit` bytes, or why not.
pub(crate) fn read_limited(path: &Path, limit: u64) -> Result<Vec<u8>, String> {
    let about = std::fs::metadata(path).map_err(|e| io_words(&e))?;
    if !about.is_file() {
        return Err(if about.is_dir() { "it is a folder".into() } else { "it is not a regular file".into() });
    }
    let too_large = || format!("it has more than {limit} bytes");
    if about.len() > limit {
        return Err(too_large());
    }
    let mut bytes = Vec::with_capacity(about.len() as usize);
    let file = File::open(path).map_err(|e| io_words(&e))?;
    file.take(limit + 1).read_to_end(&mut bytes).map_err(|e| io_words(&e))?;
    if bytes.len() as u64 > limit { Err(too_large()) } else { Ok(bytes) }
}

/// Files in memory, by their path.
#[derive(Clone, Debug, Default)]
pub struct MemoryFiles(pub HashMap<String, Vec<u8>>);

impl Files for MemoryFiles {
    fn open(&self, relative: &str) -> Result<Vec<u8>, FileError> {
        let path = join(Path::new(""), &parts(relative)?)
            .ok_or(FileError::Refused("the path leaves the folder of the scene"))?;
        let name: Vec<_> = path
            .components()
            .filter_map(|c| match c {
                Component::Normal(part) => part.to_str(),
                _ => None,
            })
            .collect();
        self.0.get(&name.join("/")).cloned().ok_or(FileError::Missing)
    }
}
