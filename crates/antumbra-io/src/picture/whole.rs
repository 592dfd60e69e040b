//! Files that appear whole or not at all: written beside under another name, then renamed.

use std::fs::{self, File, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::error::{WriteError, io_words};

/// A file of its own beside the one that is meant; removed unless it took its place.
struct Beside {
    path: PathBuf,
    file: File,
    kept: bool,
}

impl Beside {
    fn create(folder: &Path) -> std::io::Result<Beside> {
        static NEXT: AtomicU32 = AtomicU32::new(0);
        loop {
            let n = NEXT.fetch_add(1, Ordering::Relaxed);
            let path = folder.join(format!(".antumbra-{}-{n}.part", std::process::id()));
            match OpenOptions::new().write(true).create_new(true).open(&path) {
                Ok(file) => return Ok(Beside { path, file, kept: false }),
                // Left by a run that was killed and had our number.
                Err(e) if e.kind() == std::io::ErrorKind::AlreadyExists => continue,
                Err(e) => return Err(e),
            }
        }
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        if !self.kept {
            // Nothing better can be done about a file that cannot be removed.
            let _ = fs::remove_file(&self.path);
        }
    }
}

fn error(path: &Path, why: impl Into<String>) -> WriteError {
    WriteError { file: path.display().to_string(), why: why.into() }
}

/// The file that a path means, links followed, or why it cannot be written.
fn target(path: &Path) -> Result<PathBuf, WriteError> {
    if path.file_name().is_none() {
        return Err(error(path, "this names no file"));
    }
    match fs::metadata(path) {
        Ok(about) if about.is_dir() => Err(error(path, "it is a folder")),
        Ok(about) if !about.is_file() => Err(error(path, "it is not a regular file")),
        Ok(about) if about.permissions().readonly() => Err(error(path, "it is read-only")),
        Ok(_) => path.canonicalize().map_err(|e| error(path, io_words(&e))),
        Err(_) => Ok(path.to_path_buf()),
    }
}

fn beside(path: &Path, target: &Path) -> Result<Beside, WriteError> {
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if !folder.exists() {
        return Err(error(path, format!("there is no folder {}", folder.display())));
    }
    Beside::create(folder).map_err(|e| error(path, io_words(&e)))
}

/// Tries whether a file could be written, before the work is done. Leaves nothing behind.
pub fn check_writable(path: &Path) -> Result<(), WriteError> {
    beside(path, &target(path)?).map(drop)
}

/// Writes a file whole or not at all.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), WriteError> {
    let target = target(path)?;
    let mut part = beside(path, &target)?;
    let written = part.file.write_all(bytes).and_then(|()| part.file.sync_all());
    written.and_then(|()| fs::rename(&part.path, &target)).map_err(|e| error(path, io_words(&e)))?;
    part.kept = true;
    Ok(())
}

/// Writes files that belong together, each whole: none takes its place before all are on the disk. The first of the list
/// names the others and comes last; folders of the others are made.
pub fn write_together(files: &[(PathBuf, Vec<u8>)]) -> Result<(), WriteError> {
    let mut made = Folders(Vec::new());
    let mut parts = Vec::with_capacity(files.len());
    for (i, (path, bytes)) in files.iter().enumerate() {
        let folder = path.parent().filter(|p| !p.as_os_str().is_empty() && !p.exists());
        if let Some(folder) = folder.filter(|_| i > 0) {
            fs::create_dir(folder).map_err(|e| error(folder, io_words(&e)))?;
            made.0.push(folder.to_path_buf());
        }
        let target = target(path)?;
        let mut part = beside(path, &target)?;
        let written = part.file.write_all(bytes).and_then(|()| part.file.sync_all());
        written.map_err(|e| error(path, io_words(&e)))?;
        parts.push((part, target));
    }
    for ((part, target), (path, _)) in parts.iter_mut().zip(files).rev() {
        fs::rename(&part.path, &target).map_err(|e| error(path, io_words(&e)))?;
        part.kept = true;
    }
    made.0.clear();
    Ok(())
}

/// Folders that were made on the way; removed again, if they are empty, where the work does not come to its end.
struct Folders(Vec<PathBuf>);

impl Drop for Folders {
    fn drop(&mut self) {
        // Nothing better can be done about a folder that cannot be removed.
        self.0.iter().rev().for_each(|folder| drop(fs::remove_dir(folder)));
    }
}
