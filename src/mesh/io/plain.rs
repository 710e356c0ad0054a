//! Lines of OBJ files as nearly all of them are: `v x y z` and `f i j k ..`, read with one look at each byte.
//!
//! What is not of this form, or is wrong, is left to the general reader, which knows all of the grammar and says
//! what is the matter: so this one may give up wherever it likes.

use super::RawMesh;
use super::decimal::Coordinate;
use super::digits::digits;
use super::scan::{Fault, Scanner};
use crate::mesh::Point;

/// Reads plain lines up to one that isn't.
pub(super) fn lines<S: Coordinate>(
    scanner: &mut Scanner,
    mesh: &mut RawMesh<S>,
) -> Result<(), Fault> {
    loop {
        let mut rest = scanner.rest();
        let all = rest.len();
        let plain = match rest {
            [b'v', b' ', ..] => vertex(&mut rest, mesh),
            [b'f', b' ', ..] => face(&mut rest, mesh, scanner.line())?,
            _ => None,
        };
        if plain.is_none() {
            return Ok(());
        }
        scanner.pass_line(all - rest.len());
    }
}

/// Goes behind the spaces at the start of `rest`; whether there are any.
#[inline(always)]
fn spaces(rest: &mut &[u8]) -> bool {
    let mut any = false;
    while let Some(after) = rest.strip_prefix(b" ") {
        *rest = after;
        any = true;
    }
    any
}

/// Goes behind the end of a line, if that is next.
#[inline(always)]
fn ends(rest: &mut &[u8]) -> bool {
    *rest = match rest {
        [b'\n', after @ ..] | [b'\r', b'\n', after @ ..] => after,
        _ => return false,
    };
    true
}

#[inline(always)]
fn vertex<S: Coordinate>(rest: &mut &[u8], mesh: &mut RawMesh<S>) -> Option<()> {
    *rest = &rest[1..];
    let mut next = || {
        spaces(rest);
        let (x, length) = S::leading(rest)?;
        *rest = &rest[length..];
        Some(x)
    };
    let point = Point([next()?, next()?, next()?]);
    spaces(rest);
    if !ends(rest) {
        return None;
    }
    mesh.positions.push(point);
    Some(())
}

/// The only fault is that there are too many faces.
#[inline(always)]
fn face<S>(rest: &mut &[u8], mesh: &mut RawMesh<S>, line: u32) -> Result<Option<()>, Fault> {
    *rest = &rest[1..];
    let before = mesh.corners.len();
    if corners(rest, &mut mesh.corners).is_none() || mesh.corners.len() < before + 3 {
        mesh.corners.truncate(before);
        return Ok(None);
    }
    mesh.end_face(line)?;
    Ok(Some(()))
}

#[inline(always)]
fn corners(rest: &mut &[u8], out: &mut Vec<u32>) -> Option<()> {
    loop {
        let apart = spaces(rest);
        if ends(rest) {
            return Some(());
        }
        let (length, index) = digits(rest)?;
        *rest = &rest[length..];
        // Textures and normals are passed over.
        if rest.first() == Some(&b'/') {
            let others = |c: &u8| !matches!(c, b'/' | b'-' | b'0'..=b'9');
            *rest = &rest[rest.iter().position(others)?..];
        }
        // Of more than eight digits one is next.
        if !apart || !matches!(rest.first(), Some(b' ' | b'\r' | b'\n')) {
            return None;
        }
        // Vertices are counted from 1.
        out.push((index as u32).checked_sub(1)?);
    }
}
