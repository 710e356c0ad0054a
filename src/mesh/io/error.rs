//! Why a mesh file can't be read or written: one sentence each, with the cure.

use std::io;
use std::path::{Path, PathBuf};

use super::TopologyError;

/// Why a mesh file can't be read or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file can't be opened or read.
    #[error("{}: {}", path.display(), reading(source))]
    Read {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The extension names no format.
    #[error("{}: the extension names no mesh format: use .obj, .off or .ply", path.display())]
    Extension {
        /// The file.
        path: PathBuf,
    },
    /// The content breaks the format, or a coordinate can't be used.
    #[error("{}: {what}", place(path, *line))]
    Content {
        /// The file.
        path: PathBuf,
        /// The line, from 1, where there are lines.
        line: Option<u32>,
        /// What is wrong and the cure.
        what: String,
    },
    /// The faces are no oriented 2-manifold with boundary.
    #[error("{}: {source}", place(path, *line))]
    Topology {
        /// The file.
        path: PathBuf,
        /// The line of the face at fault, from 1, if it is a single face's.
        line: Option<u32>,
        /// What is wrong.
        source: TopologyError,
    },
    /// The file can't be written.
    #[error("{}: the file can't be written ({source}): nothing was changed, so free the space or choose another place", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

fn place(path: &Path, line: Option<u32>) -> String {
    match line {
        Some(line) => format!("{}:{line}", path.display()),
        None => path.display().to_string(),
    }
}

fn reading(error: &io::Error) -> String {
    match error.kind() {
        io::ErrorKind::NotFound => "there is no such file: check the path".into(),
        io::ErrorKind::IsADirectory => "this is a folder: name a file in it".into(),
        io::ErrorKind::PermissionDenied => {
            "reading is not permitted: change the file's mode".into()
        }
        _ => format!("the file can't be read ({error}): check that it is a readable file"),
    }
}
