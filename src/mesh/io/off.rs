//! OFF (Geomview's object file format), in text.

use std::io::{self, Write};

use super::decimal::Coordinate;
use super::scan::{Fault, Scanner, integer, quote};
use super::{RawMesh, read_point, write_decimal};
use crate::mesh::Mesh;

pub(super) fn read<S: Coordinate>(bytes: &[u8]) -> Result<RawMesh<S>, Fault> {
    let mut scanner = Scanner::new(bytes, false);
    let [vertices, faces] = header(&mut scanner)?;
    let mut mesh = RawMesh::default();
    // The header may lie: a vertex takes 6 bytes, a face 8.
    mesh.positions
        .reserve(vertices.min(scanner.remaining() / 6));
    mesh.face_start.reserve(faces.min(scanner.remaining() / 8));
    for v in 0..vertices {
        let line = record(&mut scanner, || {
            format!("the header announces {vertices} vertices, but the file ends after {v}")
        })?;
        let point = read_point(&mut scanner, line, v)?;
        mesh.positions.push(point);
        // What follows is a normal or a colour.
        scanner.next_line();
    }
    for f in 0..faces {
        let line = record(&mut scanner, || {
            format!("the header announces {faces} faces, but the file ends after {f}")
        })?;
        let word = scanner.word().unwrap_or_default();
        let Some(size) = integer(word).filter(|&n| n >= 0) else {
            let what = format!(
                "{} is no number of corners of face {}: correct it",
                quote(word),
                f + 1
            );
            return Err(Fault::new(line, what));
        };
        for corner in 0..size {
            let Some(word) = scanner.word() else {
                let what = format!(
                    "face {} announces {size} corners, but has {corner}: correct the count",
                    f + 1
                );
                return Err(Fault::new(line, what));
            };
            let Some(vertex) =
                integer(word).filter(|&v| 0 <= v && v < (vertices as i64).min(i64::from(u32::MAX)))
            else {
                let what = format!(
                    "corner {} of face {} is no vertex: indices run from 0 to {}",
                    quote(word),
                    f + 1,
                    vertices as i64 - 1
                );
                return Err(Fault::new(line, what));
            };
            mesh.corners.push(vertex as u32);
        }
        mesh.end_face(line)?;
        // What follows is a colour.
        scanner.next_line();
    }
    if let Some(word) = scanner.word_anywhere() {
        let what = format!(
            "{} follows the {vertices} vertices and {faces} faces of the header: correct its counts",
            quote(word)
        );
        return Err(Fault::new(scanner.line(), what));
    }
    Ok(mesh)
}

/// Reads the keyword and the counts of vertices and faces.
fn header(scanner: &mut Scanner) -> Result<[usize; 2], Fault> {
    let mut word = scanner.word_anywhere().unwrap_or_default();
    if integer(word).is_none() {
        // The prefixes say what follows a position on its line; those that change it are refused.
        let prefix = word
            .strip_suffix(b"OFF")
            .filter(|p| p.iter().all(|c| b"STCN".contains(c)));
        if prefix.is_none() {
            let what = format!(
                "{} is no OFF header: begin with OFF (or COFF, NOFF, STOFF), three coordinates a vertex",
                quote(word)
            );
            return Err(Fault::new(scanner.line(), what));
        }
        word = scanner.word_anywhere().unwrap_or_default();
    }
    if word == b"BINARY" {
        return Err(Fault::new(
            scanner.line(),
            "binary OFF is not read: save it as text",
        ));
    }
    let mut counts = [0; 2];
    for (i, what) in ["vertices", "faces"].into_iter().enumerate() {
        if i > 0 {
            word = scanner.word_anywhere().unwrap_or_default();
        }
        let count = integer(word).and_then(|n| usize::try_from(n).ok());
        counts[i] = count.ok_or_else(|| {
            let what = format!("{} is no number of {what}: correct the header", quote(word));
            Fault::new(scanner.line(), what)
        })?;
    }
    // A third count, of edges, means nothing.
    scanner.next_line();
    Ok(counts)
}

/// Goes to the next line that has words; returns its number.
fn record(scanner: &mut Scanner, missing: impl FnOnce() -> String) -> Result<u32, Fault> {
    loop {
        if scanner.at_word() {
            return Ok(scanner.line());
        }
        if !scanner.next_line() {
            return Err(Fault::new(
                scanner.line(),
                missing() + ": correct the counts",
            ));
        }
    }
}

pub(super) fn write(mesh: &Mesh<f64>, out: &mut dyn Write) -> io::Result<()> {
    let topology = &mesh.topology;
    let (v, f, e) = (
        topology.vertex_count(),
        topology.face_count(),
        topology.edge_count(),
    );
    writeln!(out, "OFF\n{v} {f} {e}")?;
    for point in &mesh.positions {
        for (i, &x) in point.0.iter().enumerate() {
            if i > 0 {
                out.write_all(b" ")?;
            }
            write_decimal(x, out)?;
        }
        out.write_all(b"\n")?;
    }
    for f in 0..topology.face_count() {
        write!(out, "{}", topology.face_size(f))?;
        for v in topology.corners(f) {
            write!(out, " {v}")?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}
