//! Faces without an extraordinary vertex: `C_0(6) 4^-m M`, and `B_0(6) 4^-m M` for limit meshes.
//!
//! M is the largest mixed second difference of the face's 12 control points: of an edge, the sum of its
//! ends less the sum of the two opposite vertices; the 15 edges are those at the corners of the face.
//! Each part of a regular face is a regular face with at most a quarter of M ([`Constant::MeshRate`]), so
//! `C_m(6) <= C_0(6) 4^-m`.
//!
//! *Boundaries.* A ghost `b_j + b_(j+1) - a_j` across each boundary edge makes the second difference of that
//! edge 0; those of the edges to ghosts equal, up to sign, those of inner edges at the same corner, as
//! `g_j - g_(j-1) = b_(j+1) - b_(j-1) - a_j + a_(j-1)`. So edges of the mesh suffice.

use std::sync::OnceLock;

use crate::bound::{Against, Constant, Prover};
use crate::mesh::{Point, Topology};
use crate::predict::parts::by_parts;
use crate::scalar::float::gamma;
use crate::scheme::LoopWeights;

/// Relative gap asked of the prover; these constants are found exactly.
const GAP: f64 = 1e-6;

/// Upper bounds of C_0(6), B_0(6) and of the rate, by the prover.
fn constants() -> [f64; 3] {
    static FOUND: OnceLock<[f64; 3]> = OnceLock::new();
    *FOUND.get_or_init(|| {
        // Valence 6: the weights don't differ.
        let mut prover = Prover::new(LoopWeights::Original, 6);
        let wanted = [
            Constant::Distance(Against::Control, 0),
            Constant::Distance(Against::Limit, 0),
            Constant::MeshRate(1),
        ];
        wanted.map(|constant| {
            let proof = prover.prove(constant, GAP);
            proof.map_or(f64::INFINITY, |proof| proof.hi)
        })
    })
}

/// `C_0(6) 4^-m` or `B_0(6) 4^-m`, rounded upwards; infinite if the prover fails.
pub fn factor(against: Against, m: u32) -> f64 {
    let [control, limit, rate] = constants();
    let start = match against {
        Against::Control => control,
        Against::Limit => limit,
    };
    // Powers of 1/4 are exact, and where the rate is another a unit for each product is added.
    (0..m).fold(start, |factor, _| match rate == 0.25 {
        true => factor * rate,
        false => (factor * rate).next_up(),
    })
}

/// An upper bound of `|(P - R) + (Q - S)|`, points off by at most `radius` per coordinate, of size about 1.
///
/// Three roundings, relative to |P - R| + |Q - S| per coordinate.
pub(crate) fn length_above([p, r]: [&[f64; 3]; 2], [q, s]: [&[f64; 3]; 2], radius: f64) -> f64 {
    const ROOT_3: f64 = 1.732_050_808;
    let (mut square, mut size) = (0.0_f64, 0.0_f64);
    for i in 0..3 {
        let (a, b) = (p[i] - r[i], q[i] - s[i]);
        square += (a + b) * (a + b);
        size = size.max(a.abs() + b.abs());
    }
    let off = ROOT_3 * (gamma(4) * size + 4.000_001 * radius);
    (square.sqrt() + off) * (1.0 + gamma(16)) + 1e-150
}

/// For each face an upper bound of its M; points off by at most `radius` per coordinate, of size about 1.
pub fn second_differences(topology: &Topology, positions: &[Point<f64>], radius: f64) -> Vec<f64> {
    let vertex = second_differences_at(topology, positions, radius);
    let of_face = |face| {
        let corners = topology.corners(face).iter();
        corners.fold(0.0_f64, |m, &v| m.max(vertex[v as usize]))
    };
    (0..topology.face_count()).map(of_face).collect()
}

/// For each vertex the largest such bound of its edges: M of a face is the largest at its corners.
pub(crate) fn second_differences_at(
    topology: &Topology,
    positions: &[Point<f64>],
    radius: f64,
) -> Vec<f64> {
    let at = |v: u32| &positions[v as usize].0;
    by_parts(topology, |edges, vertex| {
        for edge in edges
            .map(|e| e as u32)
            .filter(|&e| !topology.is_boundary_edge(e))
        {
            let [h, twin] = topology.edge_halfedges(edge);
            let ends = [topology.origin(h), topology.target(h)];
            let [r, s] = [h, twin].map(|h| at(topology.target(topology.next(h))));
            let [p, q] = ends.map(at);
            let length = length_above([p, r], [q, s], radius);
            for v in ends {
                vertex[v as usize] = vertex[v as usize].max(length);
            }
        }
    })
}
