//! Readers (bytes → scene builder), writers (checked scene → files) and pictures. Floor 9.
//!
//! Inputs are untrusted: every count is held against the size of the file before anything is allocated, paths stay in
//! the scene's folder, and what is wrong is a [`ReadError`], never a panic. Outputs appear whole or not at all.

mod error;
mod files;
mod forecast;
mod format;
mod limits;
pub mod picture;
mod read;
mod srgb;
mod write;

pub use error::{ReadError, WriteError};
pub use files::{FileError, Files, FolderFiles, MemoryFiles};
pub use forecast::size_of;
pub use format::{Format, READS, format_of};
pub use limits::Limits;
pub use read::{
    DracoAttribute, DracoDecoder, DracoError, DracoMesh, EnvironmentPicture, ReadOptions, UpAxis,
    environment_picture, read, read_environment, read_path, read_with,
};
pub use write::{WRITES, Written, is_written, write_scene};
