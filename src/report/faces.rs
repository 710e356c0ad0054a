//! A value of every face, an enclosure or a depth: CSV for programs, PLY for eyes.

use std::io::Write;
use std::path::Path;

use crate::distance::measure::Request;
use crate::distance::model::Against;
use crate::mesh::io::{self, MeshError, PlyWriter};
use crate::mesh::{Mesh, Topology};
use crate::refine::{limit_positions, refine};

/// Why the per-face file can't be written.
#[derive(Debug, thiserror::Error)]
pub enum FacesError {
    /// The extension is neither `csv` nor `ply`.
    #[error("{0}: --faces writes .csv or .ply, so name the file accordingly")]
    Extension(String),
    /// The file system refused.
    #[error(transparent)]
    File(#[from] MeshError),
    /// The mesh can't be refined again.
    #[error(transparent)]
    Refine(#[from] crate::refine::RefineError),
}

/// A kind of per-face file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// `face,lo,hi`, faces from 0; empty fields where a face has no surface. With depths `face,depth`.
    Csv,
    /// The measured mesh (for depths: the mesh itself, with `depth`) with face properties `distance_lo`, `distance_hi` and `quality` (the same as
    /// `distance_hi`, under the name that MeshLab looks for; -1 where a face has no surface), face
    /// colours, and vertex colours (the largest `hi` round the vertex) for programs without face
    /// colours.
    Ply,
}

impl Format {
    /// The format that a file's extension names.
    ///
    /// # Errors
    /// If and only if it is neither `csv` nor `ply`.
    pub fn of_path(path: &Path) -> Result<Self, FacesError> {
        match path
            .extension()
            .and_then(|e| e.to_str())
            .map(str::to_ascii_lowercase)
            .as_deref()
        {
            Some("csv") => Ok(Format::Csv),
            Some("ply") => Ok(Format::Ply),
            _ => Err(FacesError::Extension(path.display().to_string())),
        }
    }
}

/// Writes the enclosures of the faces of the level-K mesh.
///
/// # Errors
/// If and only if the extension is unknown or the file can't be written.
pub fn write(
    path: &Path,
    mesh: &Mesh,
    values: &[Option<[f64; 2]>],
    request: &Request,
) -> Result<(), FacesError> {
    match Format::of_path(path)? {
        Format::Csv => write_csv(path, "lo,hi", ",", values, &|out, [lo, hi]| {
            write!(out, "{lo:?},{hi:?}")
        })?,
        Format::Ply => {
            let mut level = refine(request.scheme, request.corner, mesh, request.level)?;
            if request.against == Against::Limit {
                let Mesh {
                    topology,
                    positions,
                } = &level;
                level.positions =
                    limit_positions::<f64, _>(request.scheme, request.corner, topology, positions)?;
            }
            let side = |i: usize| -> Vec<f64> {
                values.iter().map(|v| v.map_or(-1.0, |v| v[i])).collect()
            };
            let (lo, hi) = (side(0), side(1));
            let comment =
                "distance_lo and distance_hi enclose the parametric distance over each face";
            let numbers: [(&str, &[f64]); 2] = [("distance_lo", &lo), ("distance_hi", &hi)];
            write_ply(path, &level, comment, &numbers, &hi)?;
        }
    }
    Ok(())
}

/// Writes the number of steps that each face asks for: `face,depth`, or the face properties `depth` and
/// `quality`; an empty field or -1 where there is none.
///
/// # Errors
/// If and only if the extension is unknown or the file can't be written.
pub fn write_depths(path: &Path, mesh: &Mesh, depths: &[Option<u32>]) -> Result<(), FacesError> {
    match Format::of_path(path)? {
        Format::Csv => write_csv(path, "depth", "", depths, &|out, depth| {
            write!(out, "{depth}")
        })?,
        Format::Ply => {
            let number = |depth: &Option<u32>| depth.map_or(-1.0, f64::from);
            let numbers: Vec<f64> = depths.iter().map(number).collect();
            let comment = "depth is the number of subdivision steps that the face asks for";
            write_ply(path, mesh, comment, &[("depth", &numbers)], &numbers)?;
        }
    }
    Ok(())
}

/// `face,HEADS`, then a row for each face; `absent` where it has no value.
fn write_csv<T>(
    path: &Path,
    heads: &str,
    absent: &str,
    values: &[Option<T>],
    cells: &dyn Fn(&mut dyn Write, &T) -> std::io::Result<()>,
) -> Result<(), MeshError> {
    io::write_file(path, |out| {
        writeln!(out, "face,{heads}")?;
        for (face, value) in values.iter().enumerate() {
            write!(out, "{face},")?;
            match value {
                Some(value) => cells(out, value)?,
                None => write!(out, "{absent}")?,
            }
            writeln!(out)?;
        }
        Ok(())
    })
}

/// A mesh with numbers of its faces; those `shown` (negative where there are none) also as `quality` and as
/// colours.
fn write_ply(
    path: &Path,
    mesh: &Mesh,
    comment: &str,
    numbers: &[(&str, &[f64])],
    shown: &[f64],
) -> Result<(), MeshError> {
    let largest = shown.iter().copied().fold(0.0, f64::max);
    let face_colors = colors(shown, largest);
    let mut around = vec![-1.0_f64; mesh.positions.len()];
    for (face, &value) in (0..).zip(shown) {
        for &vertex in mesh.topology.corners(face) {
            around[vertex as usize] = around[vertex as usize].max(value);
        }
    }
    let vertex_colors = colors(&around, largest);
    debug_assert_eq!(Topology::face_count(&mesh.topology) as usize, shown.len());
    let writer = PlyWriter::new(mesh).comment(comment);
    let writer = numbers.iter().fold(writer, |writer, (name, values)| {
        writer.face_number(name, values)
    });
    writer
        .face_number("quality", shown)
        .face_colors(&face_colors)
        .vertex_colors(&vertex_colors)
        .write(path)
}

/// Grey where there is no surface (negative values), otherwise a colour relative to the largest value.
fn colors(values: &[f64], largest: f64) -> Vec<[u8; 3]> {
    let relative = |x: f64| if largest > 0.0 { x / largest } else { 0.0 };
    let pick = |&x: &f64| {
        if x < 0.0 {
            [160; 3]
        } else {
            color(relative(x))
        }
    };
    values.iter().map(pick).collect()
}

/// A perceptually even scale from dark blue (0) over green to yellow (1).
fn color(t: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 5] = [
        [68.0, 1.0, 84.0],
        [59.0, 82.0, 139.0],
        [33.0, 145.0, 140.0],
        [94.0, 201.0, 98.0],
        [253.0, 231.0, 37.0],
    ];
    let x = t.clamp(0.0, 1.0) * 4.0;
    let i = (x as usize).min(3);
    let fraction = x - i as f64;
    std::array::from_fn(|c| {
        (STOPS[i][c] + fraction * (STOPS[i + 1][c] - STOPS[i][c])).round() as u8
    })
}
