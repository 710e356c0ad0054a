//! Stand-ins for the paper's models, which are not public, authored here; and open meshes of eigensplines.
//!
//! | model | triangles | valences other than 6 |
//! |---|---|---|
//! | star | 96 | 3 (spikes), 8, 12: none isolated |
//! | knob | 512 | 4 |
//! | blob | 320 | 5 |
//! | spool | 96 | 4, 12 |
//! | braid | 288 | 5, 7 |
//!
//! Coordinates are multiples of 1/1024, so that they don't depend on the last digits of sines.

use std::collections::{BTreeMap, BTreeSet};

use crate::mesh::{Mesh, Point, Topology};
use crate::paper::lanquetin_neveu_2004::meshes::{self as solids, Authored};

/// A mesh of triangles by its name.
#[derive(Clone, Debug)]
pub struct StandIn {
    /// Its name.
    pub name: String,
    /// The mesh.
    pub mesh: Mesh,
}

/// Points and triangles under construction.
#[derive(Clone, Debug)]
struct Draft {
    points: Vec<[f64; 3]>,
    faces: Vec<[u32; 3]>,
}

impl Draft {
    fn finish(self, name: &str) -> StandIn {
        let round = |x: f64| (x * 1024.0).round() / 1024.0;
        let corners = self.faces.into_iter().flatten().collect();
        StandIn {
            name: name.into(),
            mesh: Mesh {
                topology: Topology::from_uniform(self.points.len(), 3, corners)
                    .expect("a manifold of triangles"),
                positions: self.points.iter().map(|p| Point(p.map(round))).collect(),
            },
        }
    }

    /// Each triangle cut into four at the middles of its edges.
    fn split(self) -> Draft {
        let mut points = self.points;
        let mut middles = BTreeMap::new();
        let mut faces = Vec::new();
        for face in self.faces {
            let middle = [0, 1, 2].map(|i| {
                let (a, b) = (face[i], face[(i + 1) % 3]);
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    let (p, q) = (points[a as usize], points[b as usize]);
                    points.push([0, 1, 2].map(|k| 0.5 * (p[k] + q[k])));
                    points.len() as u32 - 1
                })
            });
            for i in 0..3 {
                faces.push([face[i], middle[i], middle[(i + 2) % 3]]);
            }
            faces.push(middle);
        }
        Draft { points, faces }
    }

    /// Each point moved along its ray to the length given by its direction.
    fn radial(mut self, length: impl Fn([f64; 3]) -> f64) -> Draft {
        for p in &mut self.points {
            let size = p.iter().map(|x| x * x).sum::<f64>().sqrt();
            let direction = p.map(|x| x / size);
            *p = direction.map(|x| x * length(direction));
        }
        self
    }

    /// A spike on each triangle: a new vertex over its middle, at a distance from the origin.
    fn spiked(mut self, length: f64) -> Draft {
        let mut faces = Vec::new();
        for face in self.faces {
            let corners = face.map(|v| self.points[v as usize]);
            let sum = [0, 1, 2].map(|k| corners.iter().map(|c| c[k]).sum::<f64>());
            let size = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
            let tip = self.points.len() as u32;
            self.points.push(sum.map(|x| x * length / size));
            for i in 0..3 {
                faces.push([face[i], face[(i + 1) % 3], tip]);
            }
        }
        Draft {
            points: self.points,
            faces,
        }
    }

    /// The edge between two vertices replaced by the one between the vertices opposite to it.
    fn flipped(mut self, edges: &[(u32, u32)]) -> Draft {
        for &(a, b) in edges {
            let at: Vec<usize> = (0..self.faces.len())
                .filter(|&f| self.faces[f].contains(&a) && self.faces[f].contains(&b))
                .collect();
            // The face that runs from a to b first.
            let runs =
                |f: usize| (0..3).any(|i| self.faces[f][i] == a && self.faces[f][(i + 1) % 3] == b);
            let (first, second) = if runs(at[0]) {
                (at[0], at[1])
            } else {
                (at[1], at[0])
            };
            let other = |f: usize| self.faces[f].into_iter().find(|&v| v != a && v != b);
            let (c, d) = (
                other(first).expect("a corner"),
                other(second).expect("a corner"),
            );
            self.faces[first] = [a, d, c];
            self.faces[second] = [d, b, c];
        }
        self
    }
}

/// A solid as a draft; only its directions matter once it is made radial.
fn solid(solid: &Authored) -> Draft {
    Draft {
        points: solid.points.iter().map(|p| p.map(|x| x as f64)).collect(),
        faces: solid.faces.clone(),
    }
}

fn octahedron() -> Draft {
    solid(&solids::octahedron(1))
}

fn icosahedron() -> Draft {
    solid(&solids::icosahedron())
}

/// In the place of Star: spikes of valence 3 on a split octahedron, whose vertices get valences 8 and 12.
pub fn star() -> StandIn {
    let base = octahedron().split().radial(|_| 1.0);
    base.spiked(3.2).finish("star")
}

/// A ball with bumps over a split octahedron: valences 4 and 6.
fn knob() -> StandIn {
    let bumps = |[x, y, z]: [f64; 3]| 2.0 + 1.6 * x * y * z + 0.5 * (x * x - y * z);
    octahedron()
        .split()
        .split()
        .split()
        .radial(bumps)
        .finish("knob")
}

/// A ball with bumps over a split icosahedron: valences 5 and 6.
fn blob() -> StandIn {
    let bumps = |[x, y, z]: [f64; 3]| 2.0 + 0.6 * (x * y + z * z * z) - 0.8 * x * x * z;
    icosahedron().split().split().radial(bumps).finish("blob")
}

/// Two fans over a waisted dodecagon: valences 12, 4 and 6.
fn spool() -> StandIn {
    let n = 12;
    let angle = |i: u32| std::f64::consts::TAU * f64::from(i) / f64::from(n);
    let rim = |i| {
        [
            2.0 * angle(i).cos(),
            2.0 * angle(i).sin(),
            0.3 * angle(3 * i).cos(),
        ]
    };
    let mut points: Vec<[f64; 3]> = (0..n).map(rim).collect();
    points.extend([[0.0, 0.0, 1.5], [0.0, 0.0, -1.0]]);
    let face = |i| {
        let j = (i + 1) % n;
        [[i, j, n], [j, i, n + 1]]
    };
    let faces = (0..n).flat_map(face).collect();
    Draft { points, faces }.split().finish("spool")
}

/// A torus of 18 x 8 vertices with some edges flipped: valences 5, 7 and 6.
fn braid() -> StandIn {
    let (m, k) = (18, 8);
    let vertex = |i: u32, j: u32| i % m + m * (j % k);
    let point = |i: u32, j: u32| {
        let (a, b) = (
            std::f64::consts::TAU * f64::from(i) / f64::from(m),
            std::f64::consts::TAU * f64::from(j) / f64::from(k),
        );
        let r = 3.0 + (1.0 + 0.2 * (3.0 * a).cos()) * b.cos();
        [
            r * a.cos(),
            r * a.sin(),
            b.sin() * (1.0 + 0.2 * (3.0 * a).sin()),
        ]
    };
    let points = (0..k)
        .flat_map(|j| (0..m).map(move |i| point(i, j)))
        .collect();
    let mut faces = Vec::new();
    for j in 0..k {
        for i in 0..m {
            let [a, b, c, d] =
                [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| vertex(i, j));
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    let edges = [(0, 0), (6, 4), (12, 2), (3, 6), (9, 0), (15, 5)];
    let edges = edges.map(|(i, j)| (vertex(i, j), vertex(i + 1, j)));
    Draft { points, faces }.flipped(&edges).finish("braid")
}

/// The stand-ins, star first.
pub fn stand_ins() -> Vec<StandIn> {
    vec![star(), knob(), blob(), spool(), braid()]
}

/// The open mesh of a two-ring net in the order of [`crate::spectrum::two_ring`]: 4n triangles, for each sector
/// (O, a_j, a_(j+1)), (a_j, b_j, d_j), (a_j, d_j, a_(j+1)), (a_(j+1), d_j, b_(j+1)).
///
/// # Panics
/// If the net has not 1 + 3n points.
pub fn two_ring(n: u32, net: &[Point<f64>]) -> Mesh {
    Mesh {
        topology: Topology::from_uniform(net.len(), 3, two_ring_faces(n))
            .expect("a disc of triangles"),
        positions: net.to_vec(),
    }
}

fn two_ring_faces(n: u32) -> Vec<u32> {
    let at = |kind: u32, j: u32| 1 + kind * n + j % n;
    let sector = |j: u32| {
        let (a, next, d) = (at(0, j), at(0, j + 1), at(1, j));
        [
            0,
            a,
            next,
            a,
            at(2, j),
            d,
            a,
            d,
            next,
            next,
            d,
            at(2, j + 1),
        ]
    };
    (0..n).flat_map(sector).collect()
}

/// A closed mesh with a given two-ring net about vertex 0: a third ring, then a cap, all of whose vertices
/// can be placed freely.
///
/// The vertices of the second ring get valence 6 where they are on rays and 6 between them; the third ring has
/// 3n vertices and the cap is a fan to one more.
///
/// # Panics
/// If the net has not 1 + 3n points, or the outer points are not 3n + 1.
pub fn closed(n: u32, net: &[Point<f64>], outer: &[Point<f64>]) -> Mesh {
    assert_eq!(outer.len(), 3 * n as usize + 1, "a third ring and an apex");
    let (size, apex) = (net.len() as u32, net.len() as u32 + 3 * n);
    let mut corners = two_ring_faces(n);
    // The second ring in order: b_0, d_0, b_1, d_1, ..; b on a ray has three neighbours beyond, d two.
    let second = |i: u32| {
        let j = (i / 2) % n;
        if i.is_multiple_of(2) {
            1 + 2 * n + j
        } else {
            1 + n + j
        }
    };
    let third = |i: u32| size + i % (3 * n);
    for j in 0..n {
        let (b, d, next) = (second(2 * j), second(2 * j + 1), second(2 * j + 2));
        let (c, e, f, g) = (
            third(3 * j),
            third(3 * j + 1),
            third(3 * j + 2),
            third(3 * j + 3),
        );
        corners.extend([b, c, e, b, e, d, d, e, f, d, f, next, next, f, g]);
        corners.extend([e, c, apex, f, e, apex, g, f, apex]);
    }
    let points: Vec<Point<f64>> = net.iter().chain(outer).copied().collect();
    let used: BTreeSet<u32> = corners.iter().copied().collect();
    assert_eq!(used.len(), points.len(), "all points are used");
    Mesh {
        topology: Topology::from_uniform(points.len(), 3, corners).expect("a sphere of triangles"),
        positions: points,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn valences(mesh: &Mesh) -> BTreeMap<u32, u32> {
        mesh.topology.valence_histograms()[0].clone()
    }

    #[test]
    fn the_stand_ins_have_the_valences_of_the_table() {
        type Row<'a> = (&'a str, u32, &'a [(u32, u32)]);
        let expected: [Row<'_>; 5] = [
            ("star", 96, &[(3, 32), (8, 6), (12, 12)]),
            ("knob", 512, &[(4, 6), (6, 252)]),
            ("blob", 320, &[(5, 12), (6, 150)]),
            ("spool", 96, &[(4, 12), (6, 36), (12, 2)]),
            ("braid", 288, &[(5, 12), (6, 120), (7, 12)]),
        ];
        for (model, (name, triangles, histogram)) in stand_ins().iter().zip(expected) {
            assert_eq!(model.name, name);
            assert_eq!(model.mesh.topology.face_count(), triangles, "{name}");
            assert!(model.mesh.topology.is_closed());
            assert_eq!(
                valences(&model.mesh),
                histogram.iter().copied().collect(),
                "{name}"
            );
        }
    }

    #[test]
    fn a_closed_mesh_has_a_regular_two_ring() {
        for n in [3, 5, 12] {
            let net = vec![Point([0.0; 3]); 3 * n as usize + 1];
            let mesh = closed(n, &net, &net);
            assert!(mesh.topology.is_closed());
            assert_eq!(mesh.topology.valence(0), n);
            for v in 1..=n {
                assert_eq!(mesh.topology.valence(v), 6);
            }
        }
    }
}
