//! Meshes made by program.
#![allow(dead_code)] // shared by several test files and the benchmark

use subcert::mesh::Topology;

/// SplitMix64: small, and the same everywhere.
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    /// Uniform in [-1, 1).
    pub fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

pub type Faces = Vec<Vec<u32>>;

pub fn topology(vertices: usize, faces: &Faces) -> Topology {
    try_topology(vertices, faces).expect("a manifold")
}

fn try_topology(vertices: usize, faces: &Faces) -> Option<Topology> {
    let mut start = vec![0];
    for face in faces {
        start.push(start.last().unwrap() + face.len() as u32);
    }
    Topology::from_polygons(vertices, start, faces.concat()).ok()
}

/// a x b quads on a torus, or cut into triangles.
pub fn torus(a: u32, b: u32, triangles: bool) -> Topology {
    let at = |i: u32, j: u32| (i % a) * b + j % b;
    let mut corners = Vec::new();
    for i in 0..a {
        for j in 0..b {
            let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if triangles {
                corners.extend([p, q, r, p, r, s]);
            } else {
                corners.extend([p, q, r, s]);
            }
        }
    }
    Topology::from_uniform((a * b) as usize, if triangles { 3 } else { 4 }, corners).unwrap()
}

/// a x b quads, or cut into triangles; vertex (i, j) is i (b + 1) + j.
pub fn grid(a: u32, b: u32, triangles: bool) -> Topology {
    let at = |i: u32, j: u32| i * (b + 1) + j;
    let mut corners = Vec::new();
    for i in 0..a {
        for j in 0..b {
            let [p, q, r, s] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            if triangles {
                corners.extend([p, q, r, p, r, s]);
            } else {
                corners.extend([p, q, r, s]);
            }
        }
    }
    let vertices = ((a + 1) * (b + 1)) as usize;
    Topology::from_uniform(vertices, if triangles { 3 } else { 4 }, corners).unwrap()
}

pub fn tetrahedron() -> Faces {
    vec![vec![0, 1, 2], vec![0, 2, 3], vec![0, 3, 1], vec![1, 3, 2]]
}

pub fn cube() -> Faces {
    vec![
        vec![0, 2, 3, 1],
        vec![4, 5, 7, 6],
        vec![0, 1, 5, 4],
        vec![2, 6, 7, 3],
        vec![0, 4, 6, 2],
        vec![1, 3, 7, 5],
    ]
}

/// Two triangles glued along all edges but one, with interior vertex 1 of valence 2 on quads.
pub fn valence_two() -> Faces {
    vec![vec![0, 1, 2, 3], vec![2, 1, 0, 4]]
}

/// A closed triangle mesh with `vertices` vertices of many valences: random faces of a tetrahedron
/// are split at their centre, with random edge flips between.
pub fn irregular(vertices: usize, seed: u64) -> Faces {
    let mut random = Random(seed);
    let mut faces = tetrahedron();
    for v in 4..vertices as u32 {
        let f = random.below(faces.len());
        let [a, b, c] = [faces[f][0], faces[f][1], faces[f][2]];
        faces[f] = vec![a, b, v];
        faces.push(vec![b, c, v]);
        faces.push(vec![c, a, v]);
    }
    // Flips: edge a b of faces (a b c), (b a d) becomes c d, if c d is not an edge yet and neither
    // a nor b falls below valence 3.
    for _ in 0..4 * vertices {
        let f = random.below(faces.len());
        let [a, b, c] = [faces[f][0], faces[f][1], faces[f][2]];
        let across = |x: &Vec<u32>| (0..3).any(|i| x[i] == b && x[(i + 1) % 3] == a);
        let Some(g) = faces.iter().position(across) else {
            continue;
        };
        let d = *faces[g].iter().find(|&&x| x != a && x != b).unwrap();
        let has = |x: &Vec<u32>, u: u32| x.contains(&u);
        let valence = |u: u32| faces.iter().filter(|x| has(x, u)).count();
        if faces.iter().any(|x| has(x, c) && has(x, d)) || valence(a) < 4 || valence(b) < 4 {
            continue;
        }
        faces[f] = vec![a, d, c];
        faces[g] = vec![d, b, c];
    }
    faces
}

/// Removes random faces as long as the rest stays a manifold, at most `count` times.
pub fn puncture(vertices: usize, faces: &mut Faces, count: usize, seed: u64) {
    let mut random = Random(seed);
    for _ in 0..count {
        let f = random.below(faces.len());
        let mut fewer = faces.clone();
        fewer.swap_remove(f);
        if try_topology(vertices, &fewer).is_some() {
            *faces = fewer;
        }
    }
}

/// Merges random neighbouring faces as long as the mesh stays a manifold, at most `count` times.
pub fn merge(vertices: usize, faces: &mut Faces, count: usize, seed: u64) {
    let mut random = Random(seed);
    for _ in 0..count {
        let f = random.below(faces.len());
        let face = faces[f].clone();
        let i = random.below(face.len());
        let (a, b) = (face[i], face[(i + 1) % face.len()]);
        let across =
            |x: &Vec<u32>| (0..x.len()).position(|k| x[k] == b && x[(k + 1) % x.len()] == a);
        let Some((g, k)) = (0..faces.len()).find_map(|g| across(&faces[g]).map(|k| (g, k))) else {
            continue;
        };
        let other = faces[g].clone();
        // from b round the first face to a, then round the other face to before b
        let mut merged: Vec<u32> = (1..=face.len())
            .map(|s| face[(i + s) % face.len()])
            .collect();
        merged.extend((2..other.len()).map(|s| other[(k + s) % other.len()]));
        let mut fewer = faces.clone();
        fewer[f] = merged;
        fewer.swap_remove(g);
        let Some(topology) = try_topology(vertices, &fewer) else {
            continue;
        };
        let low = (0..topology.vertex_count()).any(|v| {
            topology.valence(v) == 0 || !topology.is_boundary_vertex(v) && topology.valence(v) < 3
        });
        if !low {
            *faces = fewer;
        }
    }
}

/// All kinds of small meshes: (name, vertices, faces).
pub fn zoo() -> Vec<(String, usize, Faces)> {
    let mut zoo = vec![
        ("tetrahedron".into(), 4, tetrahedron()),
        ("cube".into(), 8, cube()),
        ("triangle".into(), 3, vec![vec![0, 1, 2]]),
        ("quad and isolated vertex".into(), 5, vec![vec![0, 1, 2, 4]]),
        (
            "pentagon and triangle".into(),
            6,
            vec![vec![0, 1, 2, 3, 4], vec![1, 0, 5]],
        ),
    ];
    for seed in 0..12u64 {
        let vertices = 10 + 3 * seed as usize;
        let mut faces = irregular(vertices, seed);
        if seed % 2 == 1 {
            puncture(vertices, &mut faces, 8, seed + 100);
        }
        zoo.push((
            format!("irregular triangles {seed}"),
            vertices,
            faces.clone(),
        ));
        merge(vertices, &mut faces, 12, seed + 200);
        zoo.push((format!("irregular polygons {seed}"), vertices, faces));
    }
    zoo
}
