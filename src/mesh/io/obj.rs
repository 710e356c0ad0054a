//! Wavefront OBJ: vertices and polygons; everything else is passed over.

use std::io::{self, Write};

use super::decimal::Coordinate;
use super::scan::{Fault, Scanner, integer, quote};
use super::{RawMesh, plain, read_point, write_decimal};
use crate::mesh::Mesh;

pub(super) fn read<S: Coordinate>(bytes: &[u8]) -> Result<RawMesh<S>, Fault> {
    let mut mesh = RawMesh::default();
    records(&mut Scanner::new(bytes, true), &mut mesh)?;
    Ok(mesh)
}

/// Reads all that is left into a mesh.
pub(super) fn records<S: Coordinate>(
    scanner: &mut Scanner,
    mesh: &mut RawMesh<S>,
) -> Result<(), Fault> {
    let mut dropped: Vec<(&[u8], u32, u32)> = Vec::new();
    loop {
        plain::lines(scanner, mesh)?;
        let line = scanner.line();
        match scanner.word() {
            None => {}
            Some(b"v") => vertex(scanner, mesh)?,
            Some(b"f") => face(scanner, mesh)?,
            Some(
                b"vt" | b"vn" | b"vp" | b"g" | b"o" | b"s" | b"mg" | b"usemtl" | b"mtllib"
                | b"usemap" | b"maplib" | b"bevel" | b"c_interp" | b"d_interp" | b"lod"
                | b"shadow_obj" | b"trace_obj",
            ) => {}
            Some(
                kind @ (b"p" | b"l" | b"fo" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv"
                | b"curv2" | b"surf" | b"parm" | b"trim" | b"hole" | b"scrv" | b"sp"
                | b"end" | b"con" | b"ctech" | b"stech"),
            ) => match dropped.iter_mut().find(|(other, _, _)| *other == kind) {
                Some((_, count, _)) => *count += 1,
                None => dropped.push((kind, 1, line)),
            },
            Some(other) => {
                let what = format!(
                    "{} is no OBJ record: remove or correct the line",
                    quote(other)
                );
                return Err(Fault::new(line, what));
            }
        }
        if !scanner.next_line() {
            break;
        }
    }
    for (kind, count, line) in dropped {
        let kind = String::from_utf8_lossy(kind);
        mesh.warnings.push(format!(
            "{count} records '{kind}' (the first on line {line}) are left out: only v and f are read"
        ));
    }
    Ok(())
}

#[inline]
fn vertex<S: Coordinate>(scanner: &mut Scanner, mesh: &mut RawMesh<S>) -> Result<(), Fault> {
    let line = scanner.line();
    let point = read_point(scanner, line, mesh.positions.len())?;
    mesh.positions.push(point);
    let mut extra = 0;
    while scanner.word().is_some() {
        extra += 1;
    }
    // x y z, then nothing, a weight, a colour, or both.
    if !matches!(extra, 0 | 1 | 3 | 4) {
        let what = format!(
            "vertex {} has {} numbers: give 3, or 4 with a weight, or 3 more for a colour",
            mesh.positions.len(),
            3 + extra
        );
        return Err(Fault::new(line, what));
    }
    Ok(())
}

#[inline]
fn face<S>(scanner: &mut Scanner, mesh: &mut RawMesh<S>) -> Result<(), Fault> {
    let line = scanner.line();
    while let Some(word) = scanner.word() {
        let slash = word.iter().position(|&c| c == b'/').unwrap_or(word.len());
        let rest = &word[slash..];
        let index = integer(&word[..slash]);
        let Some(index) =
            index.filter(|_| rest.iter().all(|c| matches!(c, b'/' | b'-' | b'0'..=b'9')))
        else {
            let what = format!(
                "corner {} of face {} is no vertex index: write a, a/b, a//c or a/b/c",
                quote(word),
                mesh.face_count() + 1
            );
            return Err(Fault::new(scanner.line(), what));
        };
        let known = mesh.positions.len() as i64;
        mesh.counts_backwards |= index < 0;
        let vertex = if index > 0 { index - 1 } else { known + index };
        if index == 0 || vertex < 0 {
            let what = if index == 0 {
                format!(
                    "face {} names vertex 0: count vertices from 1",
                    mesh.face_count() + 1
                )
            } else {
                format!(
                    "face {} names vertex {index}, but there are only {known} vertices above it: \
                     correct the index",
                    mesh.face_count() + 1
                )
            };
            return Err(Fault::new(scanner.line(), what));
        }
        // An index beyond all vertices is reported with the topology.
        let vertex = u32::try_from(vertex).map_err(|_| {
            let what = format!("vertex index {index} is too large: correct it");
            Fault::new(scanner.line(), what)
        })?;
        mesh.corners.push(vertex);
    }
    mesh.end_face(line)
}

pub(super) fn write(mesh: &Mesh<f64>, out: &mut dyn Write) -> io::Result<()> {
    for point in &mesh.positions {
        out.write_all(b"v")?;
        for &x in &point.0 {
            out.write_all(b" ")?;
            write_decimal(x, out)?;
        }
        out.write_all(b"\n")?;
    }
    for f in 0..mesh.topology.face_count() {
        out.write_all(b"f")?;
        for &v in mesh.topology.corners(f) {
            write!(out, " {}", u64::from(v) + 1)?;
        }
        out.write_all(b"\n")?;
    }
    Ok(())
}
