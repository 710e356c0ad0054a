//! Mesh files: OBJ, OFF and PLY. Polygons stay polygons, and decimals are read exactly.
//!
//! | format | read | written |
//! |---|---|---|
//! | OBJ | `v` and `f`; the rest is passed over, with a warning where it is geometry | text |
//! | OFF | `OFF`, `COFF`, `NOFF`, `STOFF`, in text | text |
//! | PLY | text and binary, either byte order | binary, or text |
//!
//! `f64` coordinates are the decimals' nearest numbers, and are written with the fewest digits that
//! read back the same. Every message is one sentence: the file, the line, what is wrong, the cure.

use std::fs;
use std::io::{self, Write};
use std::path::Path;

use crate::scalar::Rational;

use super::{Mesh, Point, Topology, TopologyError};
use decimal::{Coordinate, DecimalError};
use scan::{Fault, Scanner, quote};

mod atomic;
mod decimal;
mod digits;
mod error;
mod obj;
mod off;
mod pieces;
mod plain;
mod ply;
mod ply_writer;
mod scan;

pub use atomic::remove_unfinished_files;
pub(crate) use atomic::write_atomically;
pub use error::MeshError;
pub use ply_writer::PlyWriter;

/// A mesh from a file, and what was odd about it.
#[derive(Clone, Debug)]
pub struct Loaded<S = f64> {
    /// The mesh, with vertices and faces in the file's order.
    pub mesh: Mesh<S>,
    /// Sentences for the user: geometry left out, vertices without a face.
    pub warnings: Vec<String>,
}

/// A kind of mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// Geomview's OFF.
    Off,
    /// Stanford's PLY.
    Ply,
}

impl Format {
    /// The format that a file's extension names, in upper or lower case.
    ///
    /// # Errors
    /// If and only if the extension is none of `obj`, `off`, `ply`.
    pub fn of_path(path: &Path) -> Result<Self, MeshError> {
        let extension = path
            .extension()
            .and_then(|e| e.to_str())
            .unwrap_or_default();
        match extension.to_ascii_lowercase().as_str() {
            "obj" => Ok(Self::Obj),
            "off" => Ok(Self::Off),
            "ply" => Ok(Self::Ply),
            _ => Err(MeshError::Extension {
                path: path.to_path_buf(),
            }),
        }
    }
}

/// Reads a mesh; each coordinate is the `f64` nearest to the file's number.
///
/// # Errors
/// If and only if the file can't be read, breaks its format, has a coordinate that is not finite or
/// beyond 2^1000, or its faces are no oriented 2-manifold with boundary.
pub fn read(path: impl AsRef<Path>) -> Result<Loaded, MeshError> {
    read_as(path.as_ref())
}

/// Reads a mesh; each coordinate is exactly the file's number. PLY stores `float` and `double`, so
/// its numbers are those.
///
/// # Errors
/// As [`read`]; also if a decimal has more than 4000 digits or an exponent beyond ±4000.
pub fn read_exact(path: impl AsRef<Path>) -> Result<Loaded<Rational>, MeshError> {
    read_as(path.as_ref())
}

/// Reads a mesh from memory; `name` stands for the path in errors.
///
/// # Errors
/// As [`read`].
pub fn parse(bytes: &[u8], format: Format, name: &str) -> Result<Loaded, MeshError> {
    parse_as(bytes, format, Path::new(name))
}

/// Writes a file of any content, completely or not at all.
///
/// # Errors
/// If and only if `content` or the file system fails; an existing file is then unchanged.
pub fn write_file(
    path: impl AsRef<Path>,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), MeshError> {
    let path = path.as_ref();
    write_atomically(path, content).map_err(|source| MeshError::Write {
        path: path.to_path_buf(),
        source,
    })
}

/// Writes a mesh in the format that the extension names; PLY in binary. The file is complete or
/// not there: see [`PlyWriter`] for PLY in text or with more properties.
///
/// # Errors
/// If and only if the extension is unknown or the file can't be written.
pub fn write(path: impl AsRef<Path>, mesh: &Mesh) -> Result<(), MeshError> {
    let path = path.as_ref();
    let format = Format::of_path(path)?;
    write_atomically(path, |out| format_to(out, mesh, format)).map_err(|source| MeshError::Write {
        path: path.to_path_buf(),
        source,
    })
}

/// Writes a mesh to any stream; PLY in binary.
///
/// # Errors
/// If and only if the stream fails.
pub fn format_to(out: &mut dyn Write, mesh: &Mesh, format: Format) -> io::Result<()> {
    match format {
        Format::Obj => obj::write(mesh, out),
        Format::Off => off::write(mesh, out),
        Format::Ply => PlyWriter::new(mesh).write_to(out),
    }
}

fn read_as<S: Coordinate>(path: &Path) -> Result<Loaded<S>, MeshError> {
    let format = Format::of_path(path)?;
    if format == Format::Obj
        && let Some(loaded) = pieces::read(path)
    {
        return Ok(loaded);
    }
    let bytes = fs::read(path).map_err(|source| MeshError::Read {
        path: path.to_path_buf(),
        source,
    })?;
    parse_as(&bytes, format, path)
}

fn parse_as<S: Coordinate>(
    bytes: &[u8],
    format: Format,
    path: &Path,
) -> Result<Loaded<S>, MeshError> {
    let content = |fault: Fault| MeshError::Content {
        path: path.to_path_buf(),
        line: fault.line,
        what: fault.what,
    };
    let whole = |what: &str| {
        content(Fault {
            line: None,
            what: what.into(),
        })
    };
    if bytes.is_empty() {
        return Err(whole(
            "the file is empty: give a mesh with at least one face",
        ));
    }
    if bytes.starts_with(&[0xff, 0xfe]) || bytes.starts_with(&[0xfe, 0xff]) {
        return Err(whole("the text is UTF-16: save it as UTF-8"));
    }
    let raw = match format {
        Format::Obj => obj::read(bytes),
        Format::Off => off::read(bytes),
        Format::Ply => ply::read(bytes),
    };
    let raw = raw.map_err(content)?;
    if raw.positions.is_empty() {
        return Err(whole(
            "the file has no vertex: give a mesh with at least one face",
        ));
    }
    raw.finish(path)
}

/// What a reader collects.
struct RawMesh<S> {
    positions: Vec<Point<S>>,
    /// As for [`Topology::from_polygons`].
    face_start: Vec<u32>,
    corners: Vec<u32>,
    /// Line of each face; empty where lines have no meaning.
    face_line: Vec<u32>,
    /// Whether an index counts from the vertices above it backwards.
    counts_backwards: bool,
    warnings: Vec<String>,
}

impl<S> Default for RawMesh<S> {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            face_start: vec![0],
            corners: Vec::new(),
            face_line: Vec::new(),
            counts_backwards: false,
            warnings: Vec::new(),
        }
    }
}

impl<S> RawMesh<S> {
    fn face_count(&self) -> usize {
        self.face_start.len() - 1
    }

    /// Closes the face whose corners were pushed last.
    #[inline]
    fn end_face(&mut self, line: u32) -> Result<(), Fault> {
        let size = self.corners.len() - self.face_start[self.face_start.len() - 1] as usize;
        if size < 3 {
            let face = self.face_count() + 1;
            let what = format!("face {face} has {size} corners: give it at least 3, or remove it");
            return Err(Fault::new(line, what));
        }
        let Ok(end) = u32::try_from(self.corners.len()) else {
            return Err(Fault::new(
                line,
                "the mesh has too many faces: split it into parts",
            ));
        };
        self.face_start.push(end);
        self.face_line.push(line);
        Ok(())
    }

    fn finish(self, path: &Path) -> Result<Loaded<S>, MeshError> {
        let Self {
            positions,
            face_start,
            corners,
            face_line,
            mut warnings,
            ..
        } = self;
        let topology = Topology::from_polygons(positions.len(), face_start, corners);
        let topology = topology.map_err(|source| {
            let line = source
                .face()
                .and_then(|f| face_line.get(f as usize).copied());
            MeshError::Topology {
                path: path.to_path_buf(),
                line,
                source,
            }
        })?;
        let isolated = topology.isolated_vertices().count();
        if let Some(first) = topology.isolated_vertices().next() {
            warnings.push(format!(
                "{isolated} vertices have no face (the first is vertex {}): they count for nothing",
                first + 1
            ));
        }
        Ok(Loaded {
            mesh: Mesh {
                topology,
                positions,
            },
            warnings,
        })
    }
}

/// Reads the three coordinates of vertex `v`, counted from 0.
#[inline]
fn read_point<S: Coordinate>(
    scanner: &mut Scanner,
    line: u32,
    v: usize,
) -> Result<Point<S>, Fault> {
    let mut next = |known: usize| {
        let Some(word) = scanner.word() else {
            let what = format!("vertex {} has {known} coordinates: give three", v + 1);
            return Err(Fault::new(line, what));
        };
        S::parse(word).map_err(|e| Fault::new(line, coordinate_fault(e, &quote(word), v)))
    };
    Ok(Point([next(0)?, next(1)?, next(2)?]))
}

/// The sentence about a coordinate that can't be used.
#[cold]
fn coordinate_fault(error: DecimalError, shown: &str, v: usize) -> String {
    let why = match error {
        DecimalError::Syntax => "is no finite decimal number: correct it",
        DecimalError::TooLarge => "is beyond 2^1000: scale the mesh down",
        DecimalError::TooLong => "is too long to be read exactly: use at most 4000 digits",
    };
    format!("coordinate {shown} of vertex {} {why}", v + 1)
}

/// Writes the shortest decimal that reads back the same number, with an exponent if that is far
/// from the point.
fn write_decimal(x: f64, out: &mut dyn Write) -> io::Result<()> {
    if x == 0.0 || (1e-5..1e16).contains(&x.abs()) {
        write!(out, "{x}")
    } else {
        write!(out, "{x:e}")
    }
}

#[cfg(test)]
mod tests;
