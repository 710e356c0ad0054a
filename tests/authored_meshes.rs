//! The sample meshes are what their program makes, and are what they are said to be.

use std::collections::BTreeMap;
use std::path::Path;

use subcert::mesh::Summary;
use subcert::mesh::io::{Format, parse};

#[allow(dead_code)] // its main
#[path = "../examples/author_meshes.rs"]
mod author_meshes;

fn summary(name: &str) -> Summary {
    let all: BTreeMap<_, _> = author_meshes::meshes().into_iter().collect();
    let loaded = parse(all[name].as_bytes(), Format::Obj, name).unwrap();
    loaded.mesh.topology.verify().unwrap();
    assert_eq!(loaded.warnings, [""; 0]);
    Summary::of(&loaded.mesh)
}

#[test]
fn files_are_what_the_program_makes() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/meshes");
    let mut total = 0;
    for (name, text) in author_meshes::meshes() {
        let file = std::fs::read_to_string(folder.join(format!("{name}.obj"))).unwrap();
        assert_eq!(
            file, text,
            "{name}: run `cargo run --example author_meshes`"
        );
        assert!(text.is_ascii());
        total += text.len();
    }
    assert!(total < 400_000, "{total} bytes");
}

#[test]
fn valences_run_from_3_to_12() {
    let s = summary("valences_3_to_12");
    assert!(
        (3..=12).all(|n| s.interior_valences.contains_key(&n)),
        "{:?}",
        s.interior_valences
    );
    assert_eq!((s.genus, s.components, s.boundary_loops.len()), (0, 1, 0));
    assert_eq!(s.face_sizes.keys().collect::<Vec<_>>(), [&3]);
}

#[test]
fn block_has_a_handle_and_extraordinary_vertices() {
    let s = summary("block_with_handle");
    assert_eq!((s.genus, s.components, s.boundary_loops.len()), (1, 1, 0));
    assert_eq!(
        s.interior_valences.keys().collect::<Vec<_>>(),
        [&3, &4, &5, &6]
    );
    assert_eq!(s.face_sizes, [(4, s.faces)].into());
}

#[test]
fn mixed_patch_has_four_kinds_of_faces_and_one_loop() {
    let s = summary("mixed_patch");
    assert_eq!(s.face_sizes, [(3, 6), (4, 6), (5, 1), (6, 1)].into());
    assert_eq!((s.boundary_loops.len(), s.euler_characteristic), (1, 1));
}

#[test]
fn lattices_and_tori_are_regular() {
    for (name, faces, genus) in [
        ("loop_saddle_grid", 128, 0),
        ("paraboloid_grid", 64, 0),
        ("bumpy_torus_tri", 2000, 1),
        ("bumpy_torus_quads", 768, 1),
    ] {
        let s = summary(name);
        assert_eq!(
            (s.faces, s.genus, s.extraordinary_vertices),
            (faces, genus, 0),
            "{name}"
        );
    }
}
