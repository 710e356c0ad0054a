//! Connectivity: the invariants, and the same faces by search.

use std::collections::{BTreeSet, HashMap};

use subcert::mesh::Topology;
use subcert::refine::{RefineError, refine_topology, refine_topology_into};
use subcert::scheme::{LoopWeights, Scheme};

use crate::meshes::{Faces, cube, grid, topology, torus, valence_two, zoo};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Original);
const SCHEMES: [Scheme; 3] = [LOOP, Scheme::CatmullClark, Scheme::DooSabin];

fn faces(topology: &Topology) -> Faces {
    (0..topology.face_count())
        .map(|f| topology.corners(f).to_vec())
        .collect()
}

/// Faces as a set, each turned so that its smallest vertex is first.
fn as_set(faces: &Faces) -> BTreeSet<Vec<u32>> {
    let turn = |face: &Vec<u32>| {
        let mut face = face.clone();
        let least = (0..face.len()).min_by_key(|&i| face[i]).unwrap();
        face.rotate_left(least);
        face
    };
    faces.iter().map(turn).collect()
}

/// The refined faces by looking edges and corners up by their vertices, in the documented order of
/// faces for Loop and Catmull-Clark.
fn by_search(scheme: Scheme, coarse: &Topology) -> Faces {
    let (v_count, e_count) = (coarse.vertex_count(), coarse.edge_count());
    let mut edge = HashMap::new();
    let mut corner = HashMap::new();
    for h in 0..coarse.halfedge_count() {
        edge.insert(
            (coarse.origin(h), coarse.target(h)),
            v_count + coarse.edge_of(h),
        );
        corner.insert((coarse.origin(h), coarse.face_of(h)), h);
    }
    let mid = |a: u32, b: u32| *edge.get(&(a, b)).or_else(|| edge.get(&(b, a))).unwrap();
    let mut fine = Vec::new();
    for f in 0..coarse.face_count() {
        let face = coarse.corners(f);
        let m = face.len();
        let middles: Vec<u32> = (0..m).map(|i| mid(face[i], face[(i + 1) % m])).collect();
        for i in 0..m {
            let before = middles[(i + m - 1) % m];
            match scheme {
                Scheme::Loop(_) => fine.push(vec![face[i], middles[i], before]),
                Scheme::CatmullClark => {
                    fine.push(vec![face[i], middles[i], v_count + e_count + f, before]);
                }
                Scheme::DooSabin => {}
            }
        }
        match scheme {
            Scheme::Loop(_) => fine.push(middles),
            Scheme::CatmullClark => {}
            Scheme::DooSabin => fine.push(face.iter().map(|&v| corner[&(v, f)]).collect()),
        }
    }
    if scheme == Scheme::DooSabin {
        let owner: HashMap<(u32, u32), u32> = (0..coarse.halfedge_count())
            .map(|h| ((coarse.origin(h), coarse.target(h)), coarse.face_of(h)))
            .collect();
        for (&(a, b), &f) in owner.iter().filter(|((a, b), _)| a < b) {
            if let Some(&g) = owner.get(&(b, a)) {
                fine.push(vec![
                    corner[&(a, f)],
                    corner[&(a, g)],
                    corner[&(b, g)],
                    corner[&(b, f)],
                ]);
            }
        }
        for v in (0..v_count).filter(|&v| coarse.valence(v) > 0 && !coarse.is_boundary_vertex(v)) {
            // From face to face: the face left of (v, w) is followed by the one left of (v, u),
            // u before v in it.
            let start = owner
                .iter()
                .find(|((a, _), _)| *a == v)
                .map(|(_, &f)| f)
                .unwrap();
            let (mut f, mut ring) = (start, Vec::new());
            loop {
                ring.push(corner[&(v, f)]);
                let face = coarse.corners(f);
                let i = face.iter().position(|&x| x == v).unwrap();
                f = owner[&(v, face[(i + face.len() - 1) % face.len()])];
                if f == start {
                    break;
                }
            }
            fine.push(ring);
        }
    }
    fine
}

fn triangles(faces: &Faces) -> bool {
    faces.iter().all(|face| face.len() == 3)
}

#[test]
fn refined_connectivity_is_right_and_found_by_search() {
    let mut reused = topology(8, &cube());
    let mut compared = 0;
    for (name, vertices, list) in zoo() {
        for scheme in SCHEMES {
            if matches!(scheme, Scheme::Loop(_)) && !triangles(&list) {
                continue;
            }
            let mut mesh = topology(vertices, &list);
            for level in 1..=3 {
                let fine = refine_topology(scheme, &mesh).unwrap();
                let context = format!("{name}, {}, level {level}", scheme.name());
                if let Err(fault) = fine.verify() {
                    panic!("{context}: {fault}");
                }
                let expected = by_search(scheme, &mesh);
                if scheme == Scheme::DooSabin {
                    assert_eq!(as_set(&faces(&fine)), as_set(&expected), "{context}");
                    assert_eq!(fine.face_count() as usize, expected.len(), "{context}");
                } else {
                    assert_eq!(faces(&fine), expected, "{context}");
                }
                let rebuilt = topology(fine.vertex_count() as usize, &faces(&fine));
                assert_eq!(rebuilt.edge_count(), fine.edge_count(), "{context}");
                assert_eq!(rebuilt.arity(), fine.arity(), "{context}");
                refine_topology_into(scheme, &mesh, &mut reused).unwrap();
                assert_eq!(reused, fine, "{context}");
                mesh = fine;
                compared += 1;
            }
        }
    }
    assert!(compared > 150);
}

#[test]
fn halves_of_an_edge_are_2e_and_2e_plus_1() {
    for (name, vertices, list) in zoo() {
        let mesh = topology(vertices, &list);
        let fine = refine_topology(Scheme::CatmullClark, &mesh).unwrap();
        for e in 0..mesh.edge_count() {
            let a = mesh.edge_halfedges(e)[0];
            for (half, end) in [(2 * e, mesh.origin(a)), (2 * e + 1, mesh.target(a))] {
                let h = fine.edge_halfedges(half)[0];
                let mut ends = [fine.origin(h), fine.target(h)];
                ends.sort_unstable();
                assert_eq!(ends, [end, mesh.vertex_count() + e], "{name}, edge {e}");
            }
        }
    }
}

#[test]
fn the_large_parallel_path_is_right() {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(3)
        .build()
        .unwrap();
    for (scheme, mesh) in [
        (LOOP, torus(90, 110, true)),
        (Scheme::CatmullClark, torus(90, 110, false)),
        (Scheme::DooSabin, grid(90, 110, false)),
    ] {
        let fine = pool.install(|| refine_topology(scheme, &mesh).unwrap());
        assert_eq!(fine.verify(), Ok(()), "{}", scheme.name());
        let single = rayon::ThreadPoolBuilder::new()
            .num_threads(1)
            .build()
            .unwrap();
        assert_eq!(
            single.install(|| refine_topology(scheme, &mesh).unwrap()),
            fine
        );
    }
}

#[test]
fn refusals_name_the_element() {
    let polygons = topology(6, &vec![vec![1, 0, 5], vec![0, 1, 2, 3, 4]]);
    let expected = RefineError::NotATriangle { face: 1, size: 5 };
    assert_eq!(refine_topology(LOOP, &polygons), Err(expected));

    let two = topology(5, &valence_two());
    let expected = RefineError::ValenceTooLow {
        vertex: 1,
        valence: 2,
        scheme: "doo-sabin",
    };
    assert_eq!(refine_topology(Scheme::DooSabin, &two), Err(expected));
    let fine = refine_topology(Scheme::CatmullClark, &two).unwrap();
    assert_eq!(fine.verify(), Ok(()));
    assert_eq!(fine.valence(1), 2);

    // Two triangles back to back: every vertex is interior of valence 2.
    let pillow = topology(3, &vec![vec![0, 1, 2], vec![0, 2, 1]]);
    let expected = RefineError::ValenceTooLow {
        vertex: 0,
        valence: 2,
        scheme: "loop",
    };
    assert_eq!(refine_topology(LOOP, &pillow), Err(expected));
    assert!(refine_topology(Scheme::CatmullClark, &pillow).is_ok());
}
