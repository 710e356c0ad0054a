use super::*;
use proptest::prelude::*;

fn uniform(vertices: usize, arity: u32, corners: &[u32]) -> Result<Topology, TopologyError> {
    let topology = Topology::from_uniform(vertices, arity, corners.to_vec())?;
    topology.verify().unwrap();
    Ok(topology)
}

fn polygons(vertices: usize, faces: &[&[u32]]) -> Result<Topology, TopologyError> {
    let mut start = vec![0];
    for face in faces {
        start.push(start[start.len() - 1] + face.len() as u32);
    }
    let topology = Topology::from_polygons(vertices, start, faces.concat())?;
    topology.verify().unwrap();
    Ok(topology)
}

const TETRAHEDRON: [u32; 12] = [0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3];
const CUBE: [u32; 24] = [
    0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7,
];

#[test]
fn tetrahedron_by_hand() {
    let t = uniform(4, 3, &TETRAHEDRON).unwrap();
    assert_eq!(
        (t.vertex_count(), t.edge_count(), t.face_count()),
        (4, 6, 4)
    );
    assert!(t.is_closed());
    assert_eq!((t.euler_characteristic(), t.genus()), (2, 0));
    // Edges by smaller vertex, then by first appearance: 02, 01, 03, 12, 13, 23.
    assert_eq!(t.edges, [[0, 9], [2, 3], [5, 10], [1, 6], [4, 8], [7, 11]]);
    assert_eq!(t.edge_of, [0, 3, 1, 1, 4, 2, 3, 5, 4, 0, 2, 5]);
    assert_eq!(t.first, [0, 2, 1, 5]);
    // Round vertex 0 the faces are 0 2 1, 2 0 3 and 0 1 3, the neighbours 2, 3 and 1.
    assert_eq!(t.fan(0).collect::<Vec<_>>(), [0, 3, 10]);
    assert_eq!(t.ring(0).collect::<Vec<_>>(), [2, 1, 3]);
    assert_eq!(t.valence_histograms()[0], [(3, 4)].into());
    assert!(t.is_extraordinary_vertex(0));
}

#[test]
fn cube_by_hand() {
    let t = uniform(8, 4, &CUBE).unwrap();
    assert_eq!(
        (t.vertex_count(), t.edge_count(), t.face_count()),
        (8, 12, 6)
    );
    assert_eq!((t.arity(), t.genus()), (Some(4), 0));
    assert_eq!(t.corners(1), [4, 5, 6, 7]);
    assert_eq!((t.next(7), t.prev(4), t.face_of(7)), (4, 7, 1));
    assert_eq!(t.boundary_loops(), Vec::<Vec<u32>>::new());
}

#[test]
fn polygons_of_one_size_are_uniform() {
    let faces: Vec<&[u32]> = CUBE.chunks(4).collect();
    assert_eq!(polygons(8, &faces), uniform(8, 4, &CUBE));
}

#[test]
fn open_fan_is_walked_counterclockwise_from_the_boundary() {
    // Vertex 4 with neighbours 0, 1, 2, 3 counterclockwise; a pentagon, a triangle, a quad.
    let t = polygons(8, &[&[1, 2, 4], &[4, 0, 5, 6, 1], &[2, 7, 3, 4]]).unwrap();
    assert_eq!(t.ring(4).collect::<Vec<_>>(), [0, 1, 2, 3]);
    assert_eq!(
        t.fan(4).map(|h| t.face_of(h)).collect::<Vec<_>>(),
        [1, 0, 2]
    );
    assert_eq!((t.valence(4), t.is_boundary_vertex(4)), (4, true));
    assert_eq!(
        (t.valence(5), t.ring(5).collect::<Vec<_>>()),
        (2, vec![6, 0])
    );
    let loops = t.boundary_loops();
    assert_eq!(loops.len(), 1);
    assert_eq!(loops[0].len(), 8);
    assert_eq!(t.genus(), 0);
    assert_eq!((t.face_size(0), t.face_size(1), t.face_count()), (3, 5, 3));
}

#[test]
fn isolated_vertices_are_allowed() {
    let t = uniform(6, 3, &[4, 1, 2]).unwrap();
    assert_eq!(t.isolated_vertices().collect::<Vec<_>>(), [0, 3, 5]);
    assert_eq!(
        (t.valence(0), t.fan(0).count(), t.first_halfedge(0)),
        (0, 0, NONE)
    );
    assert_eq!(t.components().of_vertex, [NONE, 0, 0, NONE, 0, NONE]);
    assert_eq!(t.euler_characteristic(), 1);
    assert!(!t.is_extraordinary_vertex(0));
}

#[test]
fn components_are_numbered_by_smallest_vertex() {
    let t = uniform(6, 3, &[5, 1, 3, 0, 4, 2]).unwrap();
    assert_eq!(
        t.components(),
        Components {
            count: 2,
            of_vertex: vec![0, 1, 0, 1, 0, 1]
        }
    );
    assert_eq!(t.boundary_loops(), [vec![0, 1, 2], vec![3, 4, 5]]);
}

#[test]
fn each_fault_is_named() {
    let error = |vertices, corners: &[u32]| uniform(vertices, 3, corners).unwrap_err().to_string();
    assert_eq!(error(3, &[]), "the mesh has no face: give at least one");
    assert_eq!(
        error(3, &[0, 1, 2, 0]),
        "4 corners don't make whole faces of 3 corners each"
    );
    let few = polygons(4, &[&[0, 1, 2, 3], &[0, 1]]).unwrap_err();
    assert_eq!(
        few,
        TopologyError::FewCorners {
            face: 1,
            corners: 2
        }
    );
    assert_eq!(
        error(4, &[0, 1, 2, 1, 2, 8]),
        "face 2 names vertex 9, but there are 4 vertices: correct the index"
    );
    assert_eq!(
        error(3, &[0, 1, 1]),
        "face 1 names vertex 2 more than once: remove the repeated corner, or the face"
    );
    // A book of three pages.
    assert_eq!(
        error(5, &[0, 1, 2, 1, 0, 3, 0, 1, 4]),
        "edge 1-2 has more than two faces (1, 2 and 3): duplicate its vertices or remove faces, \
         so that at most two are left"
    );
    assert_eq!(
        error(4, &[0, 1, 2, 0, 1, 3]),
        "faces 1 and 2 both run from vertex 1 to vertex 2: reverse one of them, or cut the \
         surface there if it is one-sided"
    );
    assert_eq!(
        error(3, &[0, 1, 2, 1, 2, 0]),
        "face 2 repeats face 1: remove one of them"
    );
    // Two triangles that touch at vertex 0 only.
    assert_eq!(
        error(5, &[0, 1, 2, 0, 3, 4]),
        "the faces at vertex 1 form more than one fan (faces 2 and 1 are in different ones): \
         give each fan a vertex of its own"
    );
}

#[test]
fn closed_fans_that_share_a_vertex_are_refused() {
    // Two tetrahedra, vertex 3 in common.
    let second = TETRAHEDRON.map(|v| if v == 3 { 3 } else { v + 4 });
    let corners = [TETRAHEDRON, second].concat();
    let error = uniform(7, 3, &corners).unwrap_err();
    assert_eq!(
        error,
        TopologyError::NonManifoldVertex {
            vertex: 3,
            faces: [1, 5]
        }
    );
}

#[test]
fn a_moebius_strip_clashes_however_its_faces_are_turned() {
    // Quads i, i + 1 | i + 5, i + 6 round a strip of five, closed with a twist.
    for turned in 0..32u32 {
        let mut corners = Vec::new();
        for i in 0..5u32 {
            let (c, d) = if i == 4 { (5, 0) } else { (i + 1, i + 6) };
            let mut quad = [i, c, d, i + 5];
            if turned >> i & 1 == 1 {
                quad.reverse();
            }
            corners.extend(quad);
        }
        let error = uniform(10, 4, &corners).unwrap_err();
        assert!(
            matches!(error, TopologyError::ClashingOrientation { .. }),
            "{error}"
        );
    }
}

#[test]
fn face_starts_are_checked() {
    let entry = |start: &[u32], corners: usize| match Topology::from_polygons(
        9,
        start.to_vec(),
        vec![0; corners],
    ) {
        Err(TopologyError::FaceStart { entry }) => entry,
        other => panic!("{other:?}"),
    };
    assert_eq!(entry(&[], 0), 0);
    assert_eq!(entry(&[1, 3], 3), 0);
    assert_eq!(entry(&[0, 4, 3], 3), 2);
    assert_eq!(entry(&[0, 3], 4), 1);
    let empty = Topology::from_polygons(9, vec![0], vec![]);
    assert_eq!(empty, Err(TopologyError::NoFace));
}

/// A fan of `n` triangles round vertex 0: its bucket holds 2 n half-edges, so large n takes the
/// sorting path.
fn pole(n: u32) -> Vec<u32> {
    (0..n).flat_map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect()
}

#[test]
fn long_buckets_number_edges_like_short_ones() {
    for n in [3, 16, 17, 100] {
        let t = uniform(n as usize + 1, 3, &pole(n)).unwrap();
        assert_eq!((t.valence(0), t.is_boundary_vertex(0)), (n, false));
        // The spokes come first, by first appearance.
        let firsts: Vec<u32> = (0..n as usize).map(|e| t.edges[e][0]).collect();
        assert!(firsts.is_sorted());
    }
    let mut twice = pole(40);
    twice.extend([0, 1, 50]);
    let error = Topology::from_uniform(51, 3, twice).unwrap_err();
    assert_eq!(
        error,
        TopologyError::NonManifoldEdge {
            vertices: [0, 1],
            faces: [0, 39, 40]
        }
    );
}

proptest! {
    /// Any list of faces is either refused or passes the independent check.
    #[test]
    fn accepted_lists_verify(
        sizes in prop::collection::vec(3u32..6, 1..9),
        vertices in prop::collection::vec(0u32..12, 48),
    ) {
        let mut start = vec![0];
        for size in &sizes {
            start.push(start[start.len() - 1] + size);
        }
        let corners = vertices[..start[start.len() - 1] as usize].to_vec();
        if let Ok(t) = Topology::from_polygons(11, start, corners) {
            prop_assert_eq!(t.verify(), Ok(()));
        }
    }

    /// Renumbering and removing faces of a torus keeps it a manifold unless fans are split, and
    /// then the vertex is named.
    #[test]
    fn torus_with_holes(removed in prop::collection::vec(any::<bool>(), 32), shift in 0u32..16) {
        let mut corners = Vec::new();
        for (k, gone) in removed.iter().enumerate() {
            let (i, j, upper) = (k as u32 % 4, k as u32 / 4 % 4, k >= 16);
            let v = |i: u32, j: u32| (i % 4 + 4 * (j % 4) + shift) % 16;
            let (a, b, c, d) = (v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1));
            if !gone {
                corners.extend(if upper { [a, c, d] } else { [a, b, c] });
            }
        }
        match Topology::from_uniform(16, 3, corners) {
            Ok(t) => prop_assert_eq!(t.verify(), Ok(())),
            Err(TopologyError::NonManifoldVertex { .. } | TopologyError::NoFace) => {}
            Err(other) => prop_assert!(false, "{other}"),
        }
    }
}
