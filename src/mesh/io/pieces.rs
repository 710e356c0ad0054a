//! Large OBJ files, read in pieces by all threads.
//!
//! A piece is a run of whole lines, and pieces side by side are read into one mesh: where indices count from the
//! file's first vertex, a line means the same whatever is above it. All else (indices that count backwards, faults
//! and warnings, which name lines and elements) gives up here, and the file is read as a whole.
//!
//! A piece is small enough to stay in a core's cache between the system, which writes it, and the reader.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::path::Path;

use rayon::prelude::*;

use super::decimal::Coordinate;
use super::scan::Scanner;
use super::{Loaded, RawMesh, obj};

/// Bytes of a piece, the line that it ends in apart.
const SIZE: u64 = 1 << 18;

/// Bytes of the longest line that pieces may end in.
const LONGEST_LINE: u64 = 1 << 12;

/// Pieces of which one thread is no slower.
const FEW: u64 = 4;

/// The mesh of a large file without oddities; `None` for any other.
pub(super) fn read<S: Coordinate>(path: &Path) -> Option<Loaded<S>> {
    let file = path.metadata().ok().filter(|file| file.is_file())?;
    let pieces = file.len().div_ceil(SIZE);
    if pieces <= FEW {
        return None;
    }
    read_pieces(path, file.len(), SIZE)
}

fn read_pieces<S: Coordinate>(path: &Path, length: u64, size: u64) -> Option<Loaded<S>> {
    type Run<S> = Option<(File, Vec<u8>, RawMesh<S>)>;
    let read = |run: Run<S>, piece: u64| {
        let (mut file, mut buffer, mut mesh) = match run {
            Some(run) => run,
            None => (File::open(path).ok()?, Vec::new(), RawMesh::default()),
        };
        let lines = lines(&mut file, &mut buffer, length, piece * size, size)?;
        let mut scanner = match piece {
            0 => Scanner::new(lines, true),
            _ => Scanner::inside(lines, true),
        };
        obj::records(&mut scanner, &mut mesh).ok()?;
        let odd = mesh.counts_backwards || !mesh.warnings.is_empty();
        (!odd).then_some(Some((file, buffer, mesh)))
    };
    let pieces = (0..length.div_ceil(size)).into_par_iter();
    let runs = pieces.try_fold(|| None, read);
    let meshes = runs.map(|run| Some(run?.map_or_else(RawMesh::default, |(.., mesh)| mesh)));
    let mesh = meshes.try_reduce(RawMesh::default, join)?;
    if mesh.positions.is_empty() {
        return None;
    }
    mesh.finish(path).ok()
}

/// The lines that start in `start..start + size`.
fn lines<'a>(
    file: &mut File,
    buffer: &'a mut Vec<u8>,
    length: u64,
    start: u64,
    size: u64,
) -> Option<&'a [u8]> {
    // From what tells whether the line before is joined to the first.
    let from = start.saturating_sub(3);
    let to = length.min(start + size + LONGEST_LINE);
    buffer.resize((to - from) as usize, 0);
    file.seek(SeekFrom::Start(from)).ok()?;
    file.read_exact(buffer).ok()?;
    let line_start = |place: u64| {
        if place == 0 || place >= length {
            return Some((place.min(length) - from) as usize);
        }
        // The first line end from the byte before the place on; a backslash there may join two lines.
        let least = (place - 1 - from) as usize;
        let Some(end) = buffer[least..].iter().position(|&c| c == b'\n') else {
            return (to == length).then_some((length - from) as usize);
        };
        let end = least + end;
        let line = &buffer[..end];
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        (!line.ends_with(b"\\")).then_some(end + 1)
    };
    let (first, last) = (line_start(start)?, line_start(start + size)?);
    buffer.get(first..last)
}

/// Two runs of lines, one after the other. Lines of faces are not kept: faults are another's.
fn join<S>(mut a: RawMesh<S>, mut b: RawMesh<S>) -> Option<RawMesh<S>> {
    a.face_line.clear();
    if a.positions.is_empty() && a.face_count() == 0 {
        b.face_line.clear();
        return Some(b);
    }
    let corners = u32::try_from(a.corners.len()).ok()?;
    corners.checked_add(u32::try_from(b.corners.len()).ok()?)?;
    a.positions.append(&mut b.positions);
    a.corners.append(&mut b.corners);
    a.face_start
        .extend(b.face_start[1..].iter().map(|&end| corners + end));
    Some(a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::io::{Format, parse};
    use std::fmt::Write;

    /// A strip of quads and triangles with comments, blank lines, joined lines and all ends of lines.
    fn strip(joined: bool) -> String {
        let mut text = String::from("\u{feff}# a strip\n");
        for i in 0..60 {
            let _ = writeln!(text, "v {i} 0 -{i}.5e-1\r\nv {i}. 1 0.{i}\n");
            if i > 2 && i % 3 == 0 {
                let a = 2 * i - 3;
                let _ = match i % 2 {
                    0 => writeln!(text, "f {a} {} {} {} # {a}", a + 2, a + 3, a + 1),
                    _ if joined => writeln!(text, "f {a}/1 \\\n {}/2 {}/7", a + 2, a + 3),
                    _ => writeln!(text, "f {a}/1 {}/2 {}/7 ", a + 2, a + 3),
                };
            }
        }
        text
    }

    fn in_pieces(text: &str, size: u64) -> Option<Loaded> {
        let file = tempfile::NamedTempFile::new().unwrap();
        std::fs::write(file.path(), text).unwrap();
        read_pieces(file.path(), text.len() as u64, size)
    }

    #[test]
    fn pieces_of_any_size_are_the_whole() {
        let text = strip(false);
        let whole = parse(text.as_bytes(), Format::Obj, "strip").unwrap();
        for text in [text.as_str(), text.trim_end()] {
            for size in (1..40).chain([97, 256, 1000, 10_000]) {
                let pieces = in_pieces(text, size).unwrap();
                assert_eq!(pieces.mesh.topology, whole.mesh.topology, "{size}");
                assert_eq!(pieces.mesh.positions, whole.mesh.positions, "{size}");
                assert_eq!(pieces.warnings, whole.warnings, "{size}");
            }
        }
    }

    /// A piece may not start in a joined line.
    #[test]
    fn joined_lines_are_not_parted() {
        let text = strip(true);
        let whole = parse(text.as_bytes(), Format::Obj, "strip").unwrap();
        let mut given_up = 0;
        for size in (1..40).chain([97, 256, 1000, 10_000]) {
            match in_pieces(&text, size) {
                Some(pieces) => assert_eq!(pieces.mesh.topology, whole.mesh.topology, "{size}"),
                None => given_up += 1,
            }
        }
        assert!((1..43).contains(&given_up), "{given_up}");
    }

    #[test]
    fn oddities_are_left_to_the_reader_of_whole_files() {
        let text = strip(false);
        for odd in [
            "f -1 -2 -3\n",
            "l 1 2\n",
            "v 0 0\n",
            "f 1 2 900\n",
            "f 1 2\n",
            "\u{feff}v 0 0 0\n",
        ] {
            for text in [odd.to_string() + &text, text.clone() + odd] {
                for size in [60, 300, 100_000] {
                    let whole = parse(text.as_bytes(), Format::Obj, "strip").ok();
                    match in_pieces(&text, size) {
                        None => {}
                        Some(pieces) => assert_eq!(
                            Some(pieces.mesh.topology),
                            whole.map(|whole| whole.mesh.topology)
                        ),
                    }
                }
            }
        }
        assert!(in_pieces(&(text + "f -1 -2 -3\n"), 300).is_none());
    }
}
