//! Mesh files: the shared collection against its table, round trips, bad files, broken files.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use proptest::prelude::*;
use subcert::mesh::io::{Format, PlyWriter, format_to, parse, read, read_exact};
use subcert::mesh::{Mesh, Summary};

/// The collection beside the project; tests that need it say so when it is missing.
fn collection() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/meshes");
    if folder.is_dir() {
        return Some(folder);
    }
    println!("skipped: there is no {}", folder.display());
    None
}

fn bits(mesh: &Mesh) -> Vec<u64> {
    mesh.positions
        .iter()
        .flat_map(|p| p.0.map(f64::to_bits))
        .collect()
}

/// Every sample of this project and of the collection.
fn all_meshes() -> Vec<PathBuf> {
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/meshes");
    let folders = [Some(own), collection()];
    let mut paths: Vec<PathBuf> = folders
        .into_iter()
        .flatten()
        .flat_map(|folder| fs::read_dir(folder).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "obj"))
        .collect();
    paths.sort();
    paths
}

/// "3-12" or "6" as a range.
fn range(text: &str) -> (u32, u32) {
    let ends: Vec<u32> = text.split('–').map(|n| n.trim().parse().unwrap()).collect();
    (ends[0], ends[ends.len() - 1])
}

fn span(histogram: &BTreeMap<u32, u32>) -> (u32, u32) {
    let keys: Vec<u32> = histogram.keys().copied().collect();
    (keys[0], keys[keys.len() - 1])
}

#[test]
fn the_collection_is_what_its_table_says() {
    let Some(folder) = collection() else { return };
    let readme = fs::read_to_string(folder.join("README.md")).unwrap();
    let mut rows = 0;
    for row in readme
        .lines()
        .filter(|line| line.starts_with("| ") && line.contains(".obj |"))
    {
        let cells: Vec<&str> = row.split('|').map(str::trim).collect();
        // | file | source | licence | V | F | type | boundary | valence | max EV | box | notes |
        let [_, file, _, _, v, f, _, boundary, valence, most, ..] = cells[..] else {
            continue;
        };
        if file.starts_with("bad/") {
            continue;
        }
        let loaded = read(folder.join(file)).unwrap();
        assert_eq!(loaded.warnings, [""; 0], "{file}");
        loaded.mesh.topology.verify().unwrap();
        let s = Summary::of(&loaded.mesh);
        assert_eq!(
            (s.vertices.to_string(), s.faces.to_string()),
            (v.into(), f.into()),
            "{file}"
        );
        let lengths = |list: &str| -> Vec<u32> {
            list.split(", ")
                .filter(|n| *n != "…")
                .map(|n| n.parse().unwrap())
                .collect()
        };
        match boundary.split_once(" loop") {
            None => assert_eq!((boundary, s.boundary_loops.len()), ("closed", 0), "{file}"),
            Some((count, rest)) => {
                assert_eq!(s.boundary_loops.len().to_string(), count, "{file}");
                let listed = rest
                    .trim_start_matches(['s', ' ', '('])
                    .trim_end_matches(')');
                let listed = lengths(listed);
                assert_eq!(s.boundary_loops[..listed.len()], listed, "{file}");
            }
        }
        for part in valence.split(", ") {
            let (kind, values) = part.split_once(' ').unwrap();
            let of = if kind == "int" {
                &s.interior_valences
            } else {
                &s.boundary_valences
            };
            assert_eq!(span(of), range(values), "{file} {kind}");
        }
        assert_eq!(
            span(&s.extraordinary_per_face).1.to_string(),
            most,
            "{file}"
        );
        rows += 1;
    }
    assert_eq!(rows, 20);
}

#[test]
fn every_mesh_comes_back_bit_for_bit_from_every_format() {
    for path in all_meshes() {
        let mesh = read(&path).unwrap().mesh;
        let mut files = Vec::new();
        for format in [Format::Obj, Format::Off, Format::Ply] {
            let mut bytes = Vec::new();
            format_to(&mut bytes, &mesh, format).unwrap();
            files.push((format, bytes));
        }
        let mut text = Vec::new();
        PlyWriter::new(&mesh).text().write_to(&mut text).unwrap();
        files.push((Format::Ply, text));
        for (format, bytes) in files {
            let back = parse(&bytes, format, "copy").unwrap().mesh;
            assert_eq!(
                back.topology,
                mesh.topology,
                "{} {format:?}",
                path.display()
            );
            assert_eq!(bits(&back), bits(&mesh), "{} {format:?}", path.display());
        }
    }
}

#[test]
fn exact_coordinates_round_to_the_nearest_ones() {
    use num_traits::ToPrimitive;
    for path in all_meshes() {
        if fs::metadata(&path).unwrap().len() > 100_000 {
            continue;
        }
        let (nearest, exact) = (read(&path).unwrap().mesh, read_exact(&path).unwrap().mesh);
        assert_eq!(nearest.topology, exact.topology);
        for (p, q) in nearest.positions.iter().zip(&exact.positions) {
            for (x, y) in p.0.iter().zip(&q.0) {
                assert_eq!(Some(*x), y.to_f64(), "{}", path.display());
            }
        }
    }
}

#[test]
fn written_files_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/meshes/mixed_patch.obj");
    let mesh = read(source).unwrap().mesh;
    for name in ["a.obj", "a.OFF", "a.ply"] {
        let path = folder.path().join(name);
        subcert::mesh::io::write(&path, &mesh).unwrap();
        assert_eq!(bits(&read(&path).unwrap().mesh), bits(&mesh));
    }
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 3);
}

#[test]
fn bad_files_are_refused_by_name_and_line() {
    let Some(folder) = collection() else { return };
    for (file, expected) in [
        (
            "nonmanifold_edge",
            Some(": edge 1-2 has more than two faces (1, 2 and 3): "),
        ),
        (
            "nan_coordinate",
            Some(":3: coordinate 'nan' of vertex 2 is no finite decimal number: "),
        ),
        (
            "index_out_of_range",
            Some(":8: face 3 names vertex 9, but there are 4 vertices: "),
        ),
        ("truncated", Some(":6: vertex 5 has 2 coordinates: ")),
        (
            "degenerate_duplicate_index",
            Some(":7: face 2 names vertex 2 more than once: "),
        ),
        ("zero_area", None),
        (
            "huge_exponent",
            Some(":2: coordinate '1e308' of vertex 1 is beyond 2^1000: "),
        ),
        ("empty", Some(": the file is empty: ")),
    ] {
        let path = folder.join(format!("bad/{file}.obj"));
        match (read(&path), expected) {
            (Ok(_), None) => {}
            (Err(error), Some(expected)) => {
                let message = error.to_string();
                let expected = format!("{}{expected}", path.display());
                assert!(message.starts_with(&expected), "{message}\n{expected}");
            }
            (result, _) => panic!("{file}: {result:?}"),
        }
    }
}

const CUBE_OFF: &str = "OFF\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n\
    4 0 3 2 1\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

/// The cube in each format, PLY both ways.
fn cubes() -> Vec<(Format, Vec<u8>)> {
    let mesh = parse(CUBE_OFF.as_bytes(), Format::Off, "cube")
        .unwrap()
        .mesh;
    let mut files: Vec<(Format, Vec<u8>)> = [Format::Obj, Format::Off, Format::Ply]
        .into_iter()
        .map(|format| {
            let mut bytes = Vec::new();
            format_to(&mut bytes, &mesh, format).unwrap();
            (format, bytes)
        })
        .collect();
    let mut text = Vec::new();
    PlyWriter::new(&mesh).text().write_to(&mut text).unwrap();
    files.push((Format::Ply, text));
    files
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// A file with some bytes changed and its end cut off is refused or is a mesh.
    #[test]
    fn broken_files_never_panic(
        which in 0usize..4,
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        cut in any::<prop::sample::Index>(),
        is_cut in any::<bool>(),
    ) {
        let (format, mut bytes) = cubes().swap_remove(which);
        for (at, byte) in changes {
            let i = at.index(bytes.len());
            bytes[i] = byte;
        }
        if is_cut {
            bytes.truncate(cut.index(bytes.len()));
        }
        match parse(&bytes, format, "broken") {
            Ok(loaded) => prop_assert_eq!(loaded.mesh.topology.verify(), Ok(())),
            Err(error) => {
                let message = error.to_string();
                prop_assert!(message.starts_with("broken"), "{}", message);
                prop_assert!(!message.contains('\n') && message.contains(": "), "{}", message);
            }
        }
    }
}
