//! Small nets with random integer coordinates: every valence 2..20, several extraordinary
//! vertices on a face, open meshes of all kinds.
//!
//! Makers return faces only; [`with_points`] adds random positions, so generic that different
//! parameters practically never share a point. [`catalogue`] is the list to run everything on.

use super::{Scheme, Topology};

/// Faces of a net; vertices are numbered from 0 without gaps.
pub type Faces = Vec<Vec<usize>>;

/// SplitMix64: the same numbers on every machine.
pub struct Random(pub u64);

impl Random {
    /// The next 64 bits.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }
    /// 0 .. n-1.
    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }
    /// -span .. span.
    pub fn coordinate(&mut self, span: i64) -> i64 {
        (self.bits() % (2 * span as u64 + 1)) as i64 - span
    }
}

/// A named net.
#[derive(Clone, Debug)]
pub struct Net {
    /// What it is, with its parameters.
    pub name: String,
    /// Integer positions.
    pub points: Vec<[i64; 3]>,
    /// Faces.
    pub faces: Faces,
}

/// One more than the largest index.
pub fn vertex_count(faces: &[Vec<usize>]) -> usize {
    faces.iter().flatten().max().map_or(0, |&v| v + 1)
}

/// Random positions in the cube [-span, span]^3.
pub fn with_points(name: String, faces: Faces, span: i64, random: &mut Random) -> Net {
    let points = (0..vertex_count(&faces)).map(|_| [(); 3].map(|()| random.coordinate(span)));
    Net {
        name,
        points: points.collect(),
        faces,
    }
}

/// Sector, steps along spoke s, steps along spoke s+1: the coordinates of [`round_vertex`].
pub type Place = (usize, usize, usize);

/// `rings` rings round vertex 0 of valence n: triangles (n >= 3; rings of nr vertices) or quads
/// (n >= 2). Everything else is regular. Also the place of each vertex.
pub fn round_vertex(n: usize, rings: usize, quads: bool) -> (Faces, Vec<Place>) {
    let mut places: Vec<Place> = vec![(0, 0, 0)];
    let mut id = |s: usize, i: usize, j: usize| {
        let place = match (i, j) {
            (0, 0) => (0, 0, 0),
            (0, j) => ((s + 1) % n, j, 0),
            _ => (s, i, j),
        };
        places.iter().position(|&p| p == place).unwrap_or_else(|| {
            places.push(place);
            places.len() - 1
        })
    };
    let mut faces = vec![];
    for s in 0..n {
        for (i, j) in (0..rings * rings).map(|k| (k / rings, k % rings)) {
            if !quads && i + j >= rings {
                continue;
            }
            let [a, b, d] = [(i, j), (i + 1, j), (i, j + 1)].map(|(i, j)| id(s, i, j));
            // A triangular sector has no fourth corner at its rim.
            let fourth = (quads || i + j + 2 <= rings).then(|| id(s, i + 1, j + 1));
            match fourth {
                Some(c) if quads => faces.push(vec![a, b, c, d]),
                Some(c) => faces.extend([vec![a, b, d], vec![b, c, d]]),
                None => faces.push(vec![a, b, d]),
            }
        }
    }
    (faces, places)
}

/// Two poles of valence n over an n-gon (n = 4: octahedron).
pub fn bipyramid(n: usize) -> Faces {
    (0..n)
        .flat_map(|i| [vec![i, (i + 1) % n, n], vec![(i + 1) % n, i, n + 1]])
        .collect()
}

/// Two n-gons joined by quads (n = 4: cube).
pub fn prism(n: usize) -> Faces {
    let side = |i: usize| vec![i, (i + 1) % n, n + (i + 1) % n, n + i];
    let mut faces: Faces = (0..n).map(side).collect();
    faces.push((0..n).rev().collect());
    faces.push((n..2 * n).collect());
    faces
}

/// The tetrahedron.
pub fn tetrahedron() -> Faces {
    vec![vec![0, 1, 2], vec![0, 3, 1], vec![1, 3, 2], vec![2, 3, 0]]
}

/// Two n-gons back to back: every vertex interior of valence 2.
pub fn pillow(n: usize) -> Faces {
    vec![(0..n).collect(), (0..n).rev().collect()]
}

/// A x B cells; vertex i B' + j is at (i, j). Triangles have neighbours (1,0), (0,1), (1,1).
/// `wrap`: a torus (A, B >= 3).
pub fn grid(a: usize, b: usize, quads: bool, wrap: bool) -> Faces {
    let (p, q) = if wrap { (a, b) } else { (a + 1, b + 1) };
    let mut faces = vec![];
    for (i, j) in (0..a * b).map(|k| (k / b, k % b)) {
        let [v00, v10, v11, v01] =
            [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| (i % p) * q + j % q);
        match quads {
            true => faces.push(vec![v00, v10, v11, v01]),
            false => faces.extend([vec![v00, v10, v11], vec![v00, v11, v01]]),
        }
    }
    faces
}

/// k faces (k + 1 edges) round boundary vertex 0: triangles or quads.
pub fn fan(k: usize, quads: bool) -> Faces {
    let face = |i: usize| match quads {
        true => vec![0, 2 * i + 1, 2 * i + 2, 2 * i + 3],
        false => vec![0, i + 1, i + 2],
    };
    (0..k).map(face).collect()
}

/// Some faces cut into triangles round a new vertex: valence 3 (4, ...), more for the corners.
pub fn split_faces(mut faces: Faces, times: usize, random: &mut Random) -> Faces {
    for _ in 0..times {
        let face = faces.swap_remove(random.below(faces.len()));
        let (new, n) = (
            vertex_count(&faces).max(vertex_count(std::slice::from_ref(&face))),
            face.len(),
        );
        faces.extend((0..n).map(|i| vec![face[i], face[(i + 1) % n], new]));
    }
    faces
}

/// Some faces cut in two along a diagonal (skipped where the two corners are joined already).
pub fn cut_faces(mut faces: Faces, times: usize, random: &mut Random) -> Faces {
    for _ in 0..times {
        let f = random.below(faces.len());
        let n = faces[f].len();
        if n > 3 {
            let mut face = faces[f].clone();
            face.rotate_left(random.below(n));
            let k = 2 + random.below(n - 3);
            let mut cut = faces.clone();
            cut[f] = face[..=k].to_vec();
            cut.push(face[k..].iter().chain(&face[..1]).copied().collect());
            if Topology::new(vertex_count(&cut), &cut).is_ok() {
                faces = cut;
            }
        }
    }
    faces
}

/// Up to `times` random faces taken away, as long as a manifold remains.
pub fn open_faces(mut faces: Faces, times: usize, random: &mut Random) -> Faces {
    for _ in 0..times {
        let mut fewer = faces.clone();
        fewer.swap_remove(random.below(faces.len()));
        if !fewer.is_empty() && Topology::new(vertex_count(&faces), &fewer).is_ok() {
            faces = fewer;
        }
    }
    // Numbers without gaps.
    let mut used: Vec<usize> = faces.iter().flatten().copied().collect();
    used.sort_unstable();
    used.dedup();
    let id = |v: &usize| used.binary_search(v).unwrap();
    faces
        .iter()
        .map(|face| face.iter().map(id).collect())
        .collect()
}

/// Does the scheme take this net, and has it a surface there?
pub fn applicable(faces: &[Vec<usize>], scheme: Scheme) -> bool {
    let t = Topology::new(vertex_count(faces), faces).unwrap();
    let interior = valences(&t);
    match scheme {
        Scheme::CatmullClark => true,
        Scheme::DooSabin => !interior.is_empty() && interior.iter().all(|&n| n > 2),
        _ => faces.iter().all(|f| f.len() == 3) && interior.iter().all(|&n| n > 2),
    }
}

/// Are all its masks rational?
pub fn is_exact(faces: &[Vec<usize>], scheme: Scheme) -> bool {
    let good = |&n: &usize| matches!(n, 3 | 4 | 6);
    let interior = valences(&Topology::new(vertex_count(faces), faces).unwrap());
    match scheme {
        Scheme::LoopWarren | Scheme::CatmullClark => true,
        Scheme::LoopOriginal => interior.iter().all(good),
        Scheme::DooSabin => interior.iter().all(good) && faces.iter().all(|f| good(&f.len())),
    }
}

/// Valences of the interior vertices.
pub fn valences(t: &Topology) -> Vec<usize> {
    let interior = (0..t.corners.len()).filter(|&v| t.is_interior(v));
    interior.map(|v| t.neighbours[v].len()).collect()
}

/// The nets to run everything on; the same for the same seed.
pub fn catalogue(seed: u64) -> Vec<Net> {
    let random = &mut Random(seed);
    let mut list: Vec<(String, Faces)> = vec![("tetrahedron".into(), tetrahedron())];
    for n in 3..=20 {
        list.push((format!("triangles round {n}"), round_vertex(n, 3, false).0));
        list.push((format!("bipyramid {n}"), bipyramid(n)));
    }
    for n in 2..=20 {
        list.push((format!("quads round {n}"), round_vertex(n, 3, true).0));
    }
    for n in 3..=8 {
        list.push((format!("prism {n}"), prism(n)));
        list.push((format!("pillow {n}"), pillow(n)));
        list.push((format!("lone {n}-gon"), vec![(0..n).collect()]));
    }
    for k in 1..=5 {
        list.push((format!("triangle fan {k}"), fan(k, false)));
        list.push((format!("quad fan {k}"), fan(k, true)));
    }
    for quads in [false, true] {
        list.push((format!("torus, quads {quads}"), grid(3, 4, quads, true)));
        list.push((format!("sheet, quads {quads}"), grid(3, 4, quads, false)));
    }
    for k in 0..6 {
        let triangles = split_faces(
            [tetrahedron(), bipyramid(5), grid(3, 3, false, true)][k % 3].clone(),
            3,
            random,
        );
        let open = open_faces(triangles.clone(), 3, random);
        list.push((format!("split triangles {k}"), triangles));
        list.push((format!("opened triangles {k}"), open));
        let base = [prism(4), prism(6), grid(3, 4, true, true)][k % 3].clone();
        let polygons = cut_faces(split_faces(base, 1 + k / 3, random), 2, random);
        let open = open_faces(polygons.clone(), 2, random);
        list.push((format!("split polygons {k}"), polygons));
        list.push((format!("opened polygons {k}"), open));
    }
    list.into_iter()
        .map(|(name, faces)| with_points(name, faces, 999, random))
        .collect()
}
