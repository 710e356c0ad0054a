//! Closed triangle meshes with exact coordinates, authored here: the counterexamples of
//! `proofs/counterexamples`, and families for every valence.

use std::fmt::Write as _;

use crate::mesh::{Mesh, Point, Topology};
use crate::scalar::{Rational, Ring};

/// A closed triangle mesh with integer coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Authored {
    /// The name of its file, without the ending.
    pub name: &'static str,
    /// What it is.
    pub title: &'static str,
    /// Coordinates.
    pub points: Vec<[i64; 3]>,
    /// Counterclockwise from outside, from 0.
    pub faces: Vec<[u32; 3]>,
}

impl Authored {
    /// The connectivity.
    pub fn topology(&self) -> Topology {
        topology(self.points.len(), &self.faces)
    }

    /// The mesh in exact arithmetic.
    pub fn mesh(&self) -> Mesh<Rational> {
        let exact = |p: &[i64; 3]| Point(p.map(<Rational as Ring>::from_integer));
        Mesh {
            topology: self.topology(),
            positions: self.points.iter().map(exact).collect(),
        }
    }

    /// The text of its file.
    pub fn obj(&self) -> String {
        let mut text = format!(
            "# {}\n# made by examples/author_counterexamples.rs; CC0-1.0\n",
            self.title
        );
        for [x, y, z] in &self.points {
            let _ = writeln!(text, "v {x} {y} {z}");
        }
        for face in &self.faces {
            let [a, b, c] = face.map(|v| v + 1);
            let _ = writeln!(text, "f {a} {b} {c}");
        }
        text
    }
}

/// The connectivity of triangles, which must form a closed or bounded manifold.
///
/// # Panics
/// If they do not: the faces of this file do.
fn topology(points: usize, faces: &[[u32; 3]]) -> Topology {
    let corners = faces.iter().flatten().copied().collect();
    Topology::from_uniform(points, 3, corners).expect("a manifold of triangles")
}

/// Four vertices, all of valence 3: the recurrence and the rate.
///
/// In a tetrahedron with the vertices ±(1, s) and the centroid 0, the displacement of a vertex P is
/// 4/5 P, that of the level-1 vertex of an edge (a, b) is 5/48 (a + b). The ratio is largest, 25/96,
/// for a = b, that is for scalar nets (1, 1, -1, -1); here it is a little less.
pub fn tetrahedron() -> Authored {
    Authored {
        name: "lanquetin-neveu-tetrahedron",
        title: "tetrahedron, all valences 3: M_1 > M_0 / 4",
        points: vec![[4, 1, 0], [4, -1, 0], [-4, 0, 1], [-4, 0, -1]],
        faces: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
    }
}

/// Five vertices, of valences 3 and 4: the distance, near a vertex of valence 3.
pub fn bipyramid() -> Authored {
    let [a, b, c, top, bottom] = [0, 1, 2, 3, 4];
    Authored {
        name: "lanquetin-neveu-bipyramid",
        title: "triangular bipyramid, valences 3 and 4: the largest |S - F| exceeds M_0",
        points: vec![
            [44, 10, 0],
            [44, -10, 0],
            [-44, 0, 0],
            [-37, 0, 12],
            [-7, 0, -12],
        ],
        faces: vec![
            [b, a, top],
            [c, b, top],
            [a, c, top],
            [a, b, bottom],
            [b, c, bottom],
            [c, a, bottom],
        ],
    }
}

/// Seven vertices, of valences 3, 4 and 6: the distance, at the middle of an edge.
pub fn seven() -> Authored {
    Authored {
        name: "lanquetin-neveu-seven-vertices",
        title: "seven vertices, valences 3, 4 and 6: |S - F| exceeds M_0 at the middle of edge 1-6",
        points: vec![
            [-32, -12, -4],
            [31, 2, -21],
            [34, 1, 15],
            [39, -10, 5],
            [-28, 14, -6],
            [-19, -15, -2],
            [-18, 14, 31],
        ],
        faces: vec![
            [0, 1, 3],
            [1, 2, 3],
            [0, 4, 1],
            [1, 4, 2],
            [0, 5, 2],
            [2, 5, 3],
            [3, 5, 0],
            [2, 6, 0],
            [0, 6, 4],
            [4, 6, 2],
        ],
    }
}

/// A regular torus of 4 x 4 vertices: the recurrence, the rate and the distance.
///
/// The torus with radii 2 and 1, its vertices moved up and down: four vertices a ring, ring by ring
/// from the outside over the top.
pub fn torus() -> Authored {
    let heights = [
        [-3, 2, -3, -4],
        [5, 5, 5, 5],
        [4, 3, -2, 3],
        [-4, -4, -6, -6],
    ];
    let rings = heights.into_iter().zip([3, 2, 1, 2]);
    let ring = |(z, r): ([i64; 4], i64)| [[r, 0, z[0]], [0, r, z[1]], [-r, 0, z[2]], [0, -r, z[3]]];
    Authored {
        name: "lanquetin-neveu-torus",
        title: "torus of 4 x 4 vertices, all valences 6: M_1 > M_0 / 4, and |S - F| exceeds M_0",
        points: rings.flat_map(ring).collect(),
        faces: torus_faces(4, 4),
    }
}

/// The counterexamples, in the order of their sizes.
pub fn counterexamples() -> [Authored; 4] {
    [tetrahedron(), bipyramid(), seven(), torus()]
}

/// The vertex i + m j of an m x k torus has the neighbours ±(1, 0), ±(0, 1), ±(1, 1).
fn torus_faces(m: u32, k: u32) -> Vec<[u32; 3]> {
    let v = |i: u32, j: u32| i % m + m * (j % k);
    let cells = (0..k).flat_map(|j| (0..m).map(move |i| (i, j)));
    let cell = |(i, j)| {
        let (a, b, c, d) = (v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1));
        [[a, b, c], [a, c, d]]
    };
    cells.flat_map(cell).collect()
}

/// The connectivity of the regular torus of m x m vertices, m >= 3.
pub fn regular_torus(m: u32) -> Topology {
    topology((m * m) as usize, &torus_faces(m, m))
}

/// The bipyramid over an n-gon, each triangle cut into four: the two apices, vertices n and n + 1, have
/// valence n and only neighbours of valence 6.
pub fn split_bipyramid(n: u32) -> Topology {
    let mut faces = Vec::new();
    for i in 0..n {
        let j = (i + 1) % n;
        faces.extend([[i, j, n], [j, i, n + 1]]);
    }
    split(n as usize + 2, &faces)
}

/// Each triangle cut into four at the middles of its edges, without moving anything: only the
/// connectivity.
fn split(points: usize, faces: &[[u32; 3]]) -> Topology {
    let mut middles = std::collections::BTreeMap::new();
    let mut cut = Vec::new();
    for face in faces {
        let middle = [0, 1, 2].map(|i| {
            let (a, b) = (face[i], face[(i + 1) % 3]);
            let next = points as u32 + middles.len() as u32;
            *middles.entry((a.min(b), a.max(b))).or_insert(next)
        });
        for i in 0..3 {
            cut.push([face[i], middle[i], middle[(i + 2) % 3]]);
        }
        cut.push(middle);
    }
    topology(points + middles.len(), &cut)
}

/// The octahedron with the vertices ±e_i, times `size`.
pub fn octahedron(size: i64) -> Authored {
    Authored {
        name: "octahedron",
        title: "octahedron",
        points: vec![
            [size, 0, 0],
            [-size, 0, 0],
            [0, size, 0],
            [0, -size, 0],
            [0, 0, size],
            [0, 0, -size],
        ],
        faces: vec![
            [0, 2, 4],
            [2, 1, 4],
            [1, 3, 4],
            [3, 0, 4],
            [2, 0, 5],
            [1, 2, 5],
            [3, 1, 5],
            [0, 3, 5],
        ],
    }
}

/// The icosahedron with (0, ±1, ±g) and its cyclic shifts, g = 1618 / 1000, times 1000.
pub fn icosahedron() -> Authored {
    let (p, q) = (1000, 1618);
    let mut points: Vec<[i64; 3]> = Vec::new();
    for [s, t] in [[1, 1], [-1, 1], [1, -1], [-1, -1]] {
        points.extend([[0, s * p, t * q], [s * p, t * q, 0], [t * q, 0, s * p]]);
    }
    // The faces are the triples of neighbours, all pairs at distance 2000 or nearly.
    let near = |a: usize, b: usize| {
        let d: i64 = (0..3).map(|i| (points[a][i] - points[b][i]).pow(2)).sum();
        a != b && d < 5_000_000
    };
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    let outward = determinant([points[a], points[b], points[c]]) > 0;
                    let face = if outward { [a, b, c] } else { [a, c, b] };
                    faces.push(face.map(|v| v as u32));
                }
            }
        }
    }
    Authored {
        name: "icosahedron",
        title: "icosahedron",
        points,
        faces,
    }
}

fn determinant([a, b, c]: [[i64; 3]; 3]) -> i64 {
    let cross = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
    a[0] * cross(1, 2) + a[1] * cross(2, 0) + a[2] * cross(0, 1)
}

/// A round regular torus of m x k vertices with the radii 40 000 and 20 000, rounded to integers.
pub fn round_torus(m: u32, k: u32) -> Authored {
    let circle = |i: u32, n: u32| {
        // Thousandths: the last digits of sines differ between machines.
        let turn = f64::from(i) / f64::from(n) * std::f64::consts::TAU;
        [turn.cos(), turn.sin()].map(|x| (x * 1000.0).round() as i64)
    };
    let mut points = Vec::new();
    for j in 0..k {
        for i in 0..m {
            let [c, s] = circle(i, m);
            let [tube, height] = circle(j, k);
            let radius = 40_000 + 20 * tube;
            points.push([radius * c / 1000, radius * s / 1000, 20 * height]);
        }
    }
    Authored {
        name: "round-torus",
        title: "round torus",
        points,
        faces: torus_faces(m, k),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_are_closed_and_face_outward() {
        let others = [octahedron(1), icosahedron(), round_torus(12, 8)];
        for mesh in counterexamples().into_iter().chain(others) {
            assert!(mesh.topology().is_closed(), "{}", mesh.name);
            let corners = mesh
                .faces
                .iter()
                .map(|f| f.map(|v| mesh.points[v as usize]));
            let volume: i64 = corners.map(determinant).sum();
            assert!(volume > 0, "{}", mesh.name);
        }
    }

    #[test]
    fn valences() {
        let of = |topology: &Topology| topology.valence_histograms()[0].clone();
        assert_eq!(of(&tetrahedron().topology()), [(3, 4)].into());
        assert_eq!(of(&bipyramid().topology()), [(3, 2), (4, 3)].into());
        assert_eq!(of(&seven().topology()), [(3, 2), (4, 3), (6, 2)].into());
        assert_eq!(of(&torus().topology()), [(6, 16)].into());
        assert_eq!(of(&icosahedron().topology()), [(5, 12)].into());
        assert_eq!(of(&split_bipyramid(9)), [(4, 9), (6, 27), (9, 2)].into());
    }
}
