//! The norms of the faces of a mesh, by the valence of their extraordinary vertex.
//!
//! All norms of the papers are largest lengths at the corners of a face:
//!
//! | norm | at a vertex v, e_j its edge neighbours, d_j the diagonal vertex between e_j and e_(j+1) |
//! |---|---|
//! | M, Loop (HW (1)) | `(v + e_j) - (e_(j-1) + e_(j+1))`, and so for the other edges of the face's corners: n + 9 |
//! | Z, Catmull-Clark (CY, Lemma 7) | `2 v - e_j - e_(j+2)`, `2 e_j - d_(j-1) - d_j`: 2N + 10 |
//! | G, Catmull-Clark (CY (18)) | `e_j - v`, `d_j - v`: 2N + 18 |
//! | M, Doo-Sabin (LN, Theorem 5) | as Z |
//!
//! They are upper bounds in the mesh's own unit, for the coordinates as stored.

use std::collections::BTreeMap;

use num_bigint::BigInt;
use num_traits::One;
use rayon::prelude::*;

use crate::depth::NoDepth;
use crate::mesh::{Mesh, Point, Topology};
use crate::predict::eigen::estimators::scaled;
use crate::predict::eigen::regular::{length_above, second_differences_at};
use crate::refine::{Refiner, refine_topology};
use crate::scalar::Rational;
use crate::scheme::{CornerRule, Scheme};

/// Largest lengths.
#[derive(Clone, Debug, PartialEq)]
pub struct Norm {
    /// First differences; 0 for Loop.
    pub first: Rational,
    /// Second differences.
    pub second: Rational,
}

/// The norms of a mesh whose extraordinary vertices were separated.
#[derive(Clone, Debug, PartialEq)]
pub struct Norms {
    /// The steps that it took.
    pub steps: u32,
    /// The largest norms of the faces with an extraordinary vertex of a valence; of those without under the
    /// regular valence.
    pub by_valence: BTreeMap<u32, Norm>,
}

/// Vertices or faces of which one thread is faster.
const FEW: usize = 1 << 12;

/// The most steps that separation takes.
const MOST: u32 = 2;

impl Norms {
    /// The norms of a mesh.
    ///
    /// # Errors
    /// If and only if the mesh has a boundary, or the scheme refuses it.
    pub(crate) fn of(mesh: &Mesh, scheme: Scheme) -> Result<Self, NoDepth> {
        if !mesh.topology.is_closed() {
            return Err(NoDepth(
                "the paper has no boundary rule, and the mesh has a boundary".into(),
            ));
        }
        let (exponent, mut positions, mut radius) = scaled(mesh)?;
        let mut topology = mesh.topology.clone();
        let mut refiner = Refiner::new(scheme, CornerRule::Smooth);
        let mut steps = 0;
        while steps < MOST && !is_separated(scheme, &topology) {
            let mut next = Vec::new();
            radius = refiner.enclose_into(&topology, &positions, radius, &mut next)?;
            positions = next;
            topology = refine_topology(scheme, &topology)?;
            steps += 1;
        }
        let lengths = match scheme {
            Scheme::Loop(_) => second_differences_at(&topology, &positions, radius)
                .into_iter()
                .map(|second| [0.0, second])
                .collect(),
            _ => of_vertices(&topology, &positions, radius),
        };
        let found = largest_by_valence(scheme, &topology, &lengths);
        let norm = |[first, second]: [f64; 2]| Norm {
            first: in_mesh_unit(first, exponent),
            second: in_mesh_unit(second, exponent),
        };
        Ok(Norms {
            steps,
            by_valence: found.into_iter().map(|(n, x)| (n, norm(x))).collect(),
        })
    }

    /// The largest norms of all faces.
    pub fn largest(&self) -> Option<Norm> {
        let all = self.by_valence.values().cloned();
        all.reduce(|a, b| Norm {
            first: a.first.max(b.first),
            second: a.second.max(b.second),
        })
    }
}

/// `x 2^exponent`, exactly.
fn in_mesh_unit(x: f64, exponent: i32) -> Rational {
    let power = Rational::from_integer(BigInt::one() << exponent.unsigned_abs());
    let x = Rational::from_float(x).expect("lengths are finite");
    match exponent < 0 {
        true => x / power,
        false => x * power,
    }
}

/// The valences of the vertices with faces, each once, in order.
pub(super) fn valences(topology: &Topology) -> Vec<u32> {
    let mut seen = Vec::new();
    for v in 0..topology.vertex_count() {
        let n = topology.valence(v) as usize;
        if n >= seen.len() {
            seen.resize(n + 1, false);
        }
        seen[n] = true;
    }
    let all = (0..).zip(seen).skip(1);
    all.filter_map(|(n, seen)| seen.then_some(n)).collect()
}

fn regular_valence(scheme: Scheme) -> u32 {
    match scheme {
        Scheme::Loop(_) => 6,
        Scheme::CatmullClark | Scheme::DooSabin => 4,
    }
}

/// Whether the formulas are about all faces: at most one extraordinary vertex, and quads for Catmull-Clark; for
/// Doo-Sabin vertices of valence 4 (extraordinary faces stay for ever).
fn is_separated(scheme: Scheme, topology: &Topology) -> bool {
    let regular = regular_valence(scheme);
    let extraordinary = |face: u32| {
        let corners = topology.corners(face).iter();
        corners.filter(|&&v| topology.valence(v) != regular).count()
    };
    let mut faces = 0..topology.face_count();
    match scheme {
        Scheme::DooSabin => faces.all(|face| extraordinary(face) == 0),
        Scheme::CatmullClark if topology.arity() != Some(4) => false,
        _ => faces.all(|face| extraordinary(face) <= 1),
    }
}

/// The valence of the extraordinary vertex of a face, or the regular one; for Doo-Sabin the size of the face.
fn face_valence(scheme: Scheme, topology: &Topology, face: u32) -> u32 {
    let regular = regular_valence(scheme);
    if scheme == Scheme::DooSabin {
        return topology.face_size(face);
    }
    let mut valences = topology.corners(face).iter().map(|&v| topology.valence(v));
    valences.find(|&n| n != regular).unwrap_or(regular)
}

/// For each vertex upper bounds of G and Z. Where not all faces round a vertex are quads, `2 v - e_j - e_(j+2)`
/// alone counts as a second difference.
fn of_vertices(topology: &Topology, positions: &[Point<f64>], radius: f64) -> Vec<[f64; 2]> {
    const ZERO: [f64; 3] = [0.0; 3];
    let at = |v: u32| &positions[v as usize].0;
    let room = || (Vec::new(), Vec::new());
    let vertex = |(edges, diagonals): &mut (Vec<_>, Vec<_>), v: u32| {
        edges.clear();
        diagonals.clear();
        let mut quads = true;
        for h in topology.fan(v) {
            edges.push(at(topology.target(h)));
            diagonals.push(at(topology.target(topology.next(h))));
            quads &= topology.face_size(topology.face_of(h)) == 4;
        }
        let n = edges.len();
        let p = at(v);
        let (mut first, mut second) = (0.0_f64, 0.0_f64);
        for (j, &e) in edges.iter().enumerate() {
            second = second.max(length_above([p, e], [p, edges[(j + 2) % n]], radius));
            if quads {
                let [before, after] = [diagonals[(j + n - 1) % n], diagonals[j]];
                second = second.max(length_above([e, before], [e, after], radius));
            }
            for q in [e, diagonals[j]] {
                first = first.max(length_above([q, p], [&ZERO, &ZERO], radius));
            }
        }
        [first, second]
    };
    let vertices = (0..topology.vertex_count()).into_par_iter();
    vertices.with_min_len(FEW).map_init(room, vertex).collect()
}

/// The largest lengths of the faces of each valence, from those at vertices.
fn largest_by_valence(
    scheme: Scheme,
    topology: &Topology,
    lengths: &[[f64; 2]],
) -> BTreeMap<u32, [f64; 2]> {
    let larger = |a: [f64; 2], b: [f64; 2]| [a[0].max(b[0]), a[1].max(b[1])];
    // By valence; none is told from a length of 0 by its sign.
    const NONE: [f64; 2] = [-1.0; 2];
    let see = |mut seen: Vec<[f64; 2]>, face: u32| {
        let valence = face_valence(scheme, topology, face) as usize;
        if valence >= seen.len() {
            seen.resize(valence + 1, NONE);
        }
        let corners = topology.corners(face).iter();
        seen[valence] = corners.fold(seen[valence], |m, &v| larger(m, lengths[v as usize]));
        seen
    };
    let join = |mut a: Vec<[f64; 2]>, mut b: Vec<[f64; 2]>| {
        if a.len() < b.len() {
            std::mem::swap(&mut a, &mut b);
        }
        a.iter_mut().zip(b).for_each(|(a, b)| *a = larger(*a, b));
        a
    };
    let faces = (0..topology.face_count()).into_par_iter().with_min_len(FEW);
    let seen = faces.fold(Vec::new, see).reduce(Vec::new, join);
    (0..).zip(seen).filter(|(_, m)| *m != NONE).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::predict::eigen::regular::second_differences;
    use crate::scalar::float::round_to_nearest;
    use crate::scheme::{IntegerRow, catmull_clark, loop_scheme};

    /// The net of a face in Stam's numbering, Catmull-Clark, by walking.
    fn stam_net(topology: &Topology, face: u32) -> (u32, Vec<u32>) {
        let regular = |h: &u32| topology.valence(topology.origin(*h)) == 4;
        let all = topology.halfedges(face);
        let h = all.clone().find(|h| !regular(h)).unwrap_or(all.start);
        let v1 = topology.origin(h);
        let n = topology.valence(v1);
        // The fan from h: V6 is its target (u), V5 the diagonal, V4 the next neighbour (v), V3, V2, ..
        let mut net = vec![u32::MAX; catmull_clark::local_net_size(n)];
        net[0] = v1;
        let mut outgoing = h;
        for j in 0..n as usize {
            // Edge neighbours V6, V4, V2, V(2N), ..; diagonals V5, V3, V(2N+1), ..
            let edge = catmull_clark::ring_label(n, 6 + 2 * n as usize - 2 * j);
            let diagonal = catmull_clark::ring_label(n, 5 + 2 * n as usize - 2 * j);
            net[edge - 1] = topology.target(outgoing);
            net[diagonal - 1] = topology.target(topology.next(outgoing));
            outgoing = topology.rotate(outgoing);
        }
        let far = 2 * n as usize;
        // Opposite of V1 in the face over an edge: from a half-edge a -> b of this face, the two others there.
        let across = |h: u32| {
            let twin = topology.twin(h);
            let next = topology.next(twin);
            [topology.target(next), topology.target(topology.next(next))]
        };
        // Face V1 -> V6 -> V5 -> V4. Over V6 -> V5: beside V6 lies 2N+4, beside V5 2N+3.
        let (to_v5, to_v4) = (topology.next(h), topology.next(topology.next(h)));
        let [beside_6, beside_5] = across(to_v5);
        (net[far + 3], net[far + 2]) = (beside_6, beside_5);
        // Over V5 -> V4: beside V5 lies 2N+6, beside V4 2N+7.
        let [beside_5, beside_4] = across(to_v4);
        (net[far + 5], net[far + 6]) = (beside_5, beside_4);
        // The corner faces: of V5 holds 2N+2, of V6 2N+5, of V4 2N+8.
        let corner = |vertex: u32, known: u32| {
            let fan = topology
                .fan(vertex)
                .map(|h| topology.target(topology.next(h)));
            let places: Vec<u32> = fan.collect();
            places[(places
                .iter()
                .position(|&w| w == known)
                .expect("in the ring")
                + 2)
                % 4]
        };
        net[far + 1] = corner(net[4], v1);
        net[far + 4] = corner(net[5], net[3]);
        net[far + 7] = corner(net[3], net[5]);
        (n, net)
    }

    /// The largest lengths at the corners of each face.
    fn of_faces(topology: &Topology, at: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let face = |face| {
            let corners = topology.corners(face).iter().map(|&v| at[v as usize]);
            corners.fold([0.0; 2], |a: [f64; 2], b| [a[0].max(b[0]), a[1].max(b[1])])
        };
        (0..topology.face_count()).map(face).collect()
    }

    fn largest(rows: &[IntegerRow], net: &[Point<Rational>]) -> f64 {
        let square = |row: &IntegerRow| row.apply::<Rational, _>(net).norm_squared();
        let squares = rows.iter().map(square);
        round_to_nearest(&squares.max().expect("rows")).sqrt()
    }

    fn example(name: &str) -> Mesh {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/meshes");
        crate::mesh::io::read(path.join(name)).unwrap().mesh
    }

    fn exact(p: &Point<f64>) -> Point<Rational> {
        Point(p.0.map(|x| Rational::from_float(x).unwrap()))
    }

    /// The rows of [`catmull_clark`] on nets found by walking, exactly, against the maxima at corners.
    #[test]
    fn norms_at_corners_are_those_of_the_nets() {
        let scheme = Scheme::CatmullClark;
        for (name, steps) in [("block_with_handle.obj", 1), ("bumpy_torus_quads.obj", 0)] {
            let mesh = example(name);
            let fine =
                crate::refine::refine::<f64>(scheme, CornerRule::Smooth, &mesh, steps).unwrap();
            assert!(is_separated(scheme, &fine.topology), "{name}");
            let lengths = of_vertices(&fine.topology, &fine.positions, 0.0);
            let lengths = of_faces(&fine.topology, &lengths);
            for face in 0..fine.topology.face_count() {
                let (n, net) = stam_net(&fine.topology, face);
                let net: Vec<_> = net
                    .iter()
                    .map(|&v| exact(&fine.positions[v as usize]))
                    .collect();
                let g = largest(&catmull_clark::first_differences(n), &net);
                let z = largest(&catmull_clark::second_differences(n), &net);
                for (bound, norm) in lengths[face as usize].into_iter().zip([g, z]) {
                    assert!(
                        bound >= norm && bound <= norm * (1.0 + 1e-12) + 1e-12,
                        "{name} {face}"
                    );
                }
            }
        }
    }

    /// The n + 9 rows of [`loop_scheme`] on nets found by walking.
    #[test]
    fn norms_of_triangles_are_those_of_the_nets() {
        let mesh = example("valences_3_to_12.obj");
        let scheme = Scheme::Loop(crate::scheme::LoopWeights::Original);
        let fine = crate::refine::refine::<f64>(scheme, CornerRule::Smooth, &mesh, 1).unwrap();
        let topology = &fine.topology;
        let m = second_differences(topology, &fine.positions, 0.0);
        let at: Vec<_> = second_differences_at(topology, &fine.positions, 0.0)
            .into_iter()
            .map(|m| [0.0, m])
            .collect();
        let by_valence = largest_by_valence(scheme, topology, &at);
        for (valence, largest) in by_valence {
            let faces = (0..topology.face_count())
                .filter(|&f| face_valence(scheme, topology, f) == valence);
            let expected = faces.fold(0.0_f64, |x, f| x.max(m[f as usize]));
            assert_eq!(largest, [0.0, expected], "{valence}");
        }
        for face in 0..topology.face_count() {
            let all = topology.halfedges(face);
            let h = all
                .clone()
                .find(|&h| topology.valence(topology.origin(h)) != 6);
            let Some(h) = h else {
                continue;
            };
            // P1, its ring from P2; the rings of P2 and P(n+1) hold the rest.
            let p1 = topology.origin(h);
            let n = topology.valence(p1) as usize;
            let mut net = vec![u32::MAX; n + 6];
            net[0] = p1;
            let fan: Vec<u32> = topology.fan(p1).map(|h| topology.target(h)).collect();
            let start = fan.iter().position(|&v| v == topology.target(h)).unwrap();
            // {P1, P2, P(n+1)} is the face and P3 beyond P2: the ring against the order of the fan.
            for i in 0..n {
                net[1 + i] = fan[(start + n - i) % n];
            }
            let around = |v: u32, from: u32, to: u32| -> Vec<u32> {
                let ring: Vec<u32> = topology.fan(v).map(|h| topology.target(h)).collect();
                let at = ring.iter().position(|&w| w == from).unwrap();
                let ring: Vec<u32> = (0..6).map(|i| ring[(at + i) % 6]).collect();
                if ring[1] == to {
                    ring
                } else {
                    let back: Vec<u32> = (0..6).map(|i| ring[(6 - i) % 6]).collect();
                    back
                }
            };
            // Ring of P2: 1, n+1, n+2, n+3, n+4, 3. Ring of P(n+1): 1, 2, n+2, n+5, n+6, n.
            let two = around(net[1], p1, net[n]);
            (net[n + 1], net[n + 2], net[n + 3]) = (two[2], two[3], two[4]);
            let last = around(net[n], p1, net[1]);
            (net[n + 4], net[n + 5]) = (last[3], last[4]);
            let net: Vec<_> = net
                .iter()
                .map(|&v| exact(&fine.positions[v as usize]))
                .collect();
            let norm = largest(&loop_scheme::second_differences(n as u32), &net);
            let bound = m[face as usize];
            assert!(
                bound >= norm && bound <= norm * (1.0 + 1e-12) + 1e-12,
                "{face}"
            );
        }
    }
}
