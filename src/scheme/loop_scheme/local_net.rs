//! Loop's local net: the n + 6 points that govern the patch over one face with one extraordinary
//! vertex, in Stam's numbering, and its refinement.
//!
//! Labels are 1-based as in the papers; label `i` is element `i - 1` of a net.
//!
//! - `P1` is the extraordinary vertex, of valence n; `P2, ..., P(n+1)` its ring in order.
//! - The face is `{P1, P2, P(n+1)}`; parameters (v, w) on the unit triangle, v towards `P2`, w
//!   towards `P(n+1)`.
//! - Ring of `P2`: 1, n+1, n+2, n+3, n+4, 3. Ring of `P(n+1)`: 1, 2, n+2, n+5, n+6, n. Both have
//!   valence 6.
//!
//! One refinement gives n + 12 points, the *extended net*. Its first n + 6 form the same net
//! around the level-1 extraordinary vertex, over the quarter of the face at `P1`; twelve points
//! each form the regular nets of the other three quarters, the tiles.
//!
//! | level-1 label | point | | level-1 label | point |
//! |---|---|---|---|---|
//! | 1 | P1' | | n+6 | e(n, n+1) |
//! | i = 2..n+1 | e(1, i) | | n+7 | e(2, n+4) |
//! | n+2 | e(2, n+1) | | n+8 | e(2, n+3) |
//! | n+3 | P2' | | n+9 | e(2, n+2) |
//! | n+4 | e(2, 3) | | n+10 | e(n+1, n+2) |
//! | n+5 | P(n+1)' | | n+11, n+12 | e(n+1, n+5), e(n+1, n+6) |
//!
//! At n = 3 the ring vertex `P3 = Pn` lies in the rings of both `P2` and `P(n+1)`, and the point
//! e(1, 3) occurs twice in the second tile. Nothing here depends on labels being distinct.
//!
//! Source: Stam 1998 and HW section 2 for labels 1..n+6; the order of labels n+7..n+12 is ours.

use nalgebra::DMatrix;

use super::{LoopWeights, edge_point, vertex_mask};
use crate::scalar::{Field, Module};
use crate::scheme::{IntegerRow, Tile, linear};

/// The number of points of the local net, n + 6.
pub const fn local_net_size(n: u32) -> usize {
    n as usize + 6
}

/// The number of points of the extended net, n + 12.
pub const fn extended_net_size(n: u32) -> usize {
    n as usize + 12
}

/// The points of the local net of valence 6 in the order p1..p12 of the regular patch.
///
/// The regular patch has the rows p1 p2 / p3 p4 p5 / p6 p7 p8 p9 / p10 p11 p12 and the face
/// {p4, p7, p8}, v towards p7 and w towards p8.
pub const REGULAR_LABELS: [usize; 12] = [4, 5, 3, 1, 6, 10, 2, 7, 12, 9, 8, 11];

/// The ring of an interior vertex of the local net in cyclic order, as labels.
///
/// `None` if and only if `label` is none of 1, 2, n+1: only these have a full ring in the net.
///
/// ```
/// use subcert::scheme::loop_scheme::ring;
/// assert_eq!(ring(5, 2), Some(vec![1, 6, 7, 8, 9, 3]));
/// ```
pub fn ring(n: u32, label: usize) -> Option<Vec<usize>> {
    let n = n as usize;
    match label {
        1 => Some((2..=n + 1).collect()),
        2 => Some(vec![1, n + 1, n + 2, n + 3, n + 4, 3]),
        _ if label == n + 1 => Some(vec![1, 2, n + 2, n + 5, n + 6, n]),
        _ => None,
    }
}

/// How a point of the extended net arises from the local net; fields are labels.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum LevelOnePoint {
    /// The vertex point P'(i).
    Vertex(usize),
    /// The edge point e(a, b), `a` one of 1, 2, n+1.
    Edge(usize, usize),
}

/// The rule of the level-1 point with the given label, as tabulated in the module's head.
///
/// # Panics
/// If `label` is not in 1..=n+12.
pub fn level_one_point(n: u32, label: usize) -> LevelOnePoint {
    use LevelOnePoint::{Edge, Vertex};
    let n = n as usize;
    match label {
        1 => Vertex(1),
        i if (2..=n + 1).contains(&i) => Edge(1, i),
        _ => match label.checked_sub(n) {
            Some(2) => Edge(2, n + 1),
            Some(3) => Vertex(2),
            Some(4) => Edge(2, 3),
            Some(5) => Vertex(n + 1),
            Some(6) => Edge(n + 1, n),
            Some(7) => Edge(2, n + 4),
            Some(8) => Edge(2, n + 3),
            Some(9) => Edge(2, n + 2),
            Some(10) => Edge(n + 1, n + 2),
            Some(11) => Edge(n + 1, n + 5),
            Some(12) => Edge(n + 1, n + 6),
            _ => panic!("label {label} is not in the extended net of valence {n}"),
        },
    }
}

/// The local net of the next level: n + 6 points over the quarter of the face at `P1`.
///
/// `None` if and only if the type cannot represent the vertex mask of valence n.
///
/// Guarantee: exact in exact types, an enclosure in intervals.
///
/// # Panics
/// If n < 3 or the net has not n + 6 points.
///
/// ```
/// use subcert::scalar::{Field, Rational};
/// use subcert::scheme::{LoopWeights, loop_scheme::refine_local_net};
/// let mut net = vec![Rational::ratio(0, 1); 9];
/// net[0] = Rational::ratio(1, 1);
/// let next = refine_local_net::<Rational, _>(LoopWeights::Warren, 3, &net).unwrap();
/// assert_eq!(next[0], Rational::ratio(7, 16)); // 1 - 3 b, b = 3/16
/// assert_eq!(next[1], Rational::ratio(3, 8)); // e(1, 2)
/// ```
pub fn refine_local_net<S: Field, V: Module<S>>(
    weights: LoopWeights,
    n: u32,
    net: &[V],
) -> Option<Vec<V>> {
    level_one::<S, V>(weights, n, net, local_net_size(n))
}

/// All n + 12 level-1 points that the local net determines around the face.
///
/// `None` and panics as for [`refine_local_net`], whose result is the first n + 6 points.
pub fn extended_net<S: Field, V: Module<S>>(
    weights: LoopWeights,
    n: u32,
    net: &[V],
) -> Option<Vec<V>> {
    level_one::<S, V>(weights, n, net, extended_net_size(n))
}

fn level_one<S: Field, V: Module<S>>(
    weights: LoopWeights,
    n: u32,
    net: &[V],
    count: usize,
) -> Option<Vec<V>> {
    assert!(n >= 3, "Loop's local net needs a valence of at least 3");
    let mask = vertex_mask::<S>(weights, n)?;
    let rule = |center: &V, ring_sum: &V| mask.apply_ring(center, ring_sum);
    Some(level_one_by::<S, V>(n, net, count, rule))
}

/// [`extended_net`] with the rule of the extraordinary vertex given as a function of the vertex and
/// the sum over its ring: for arithmetics in which the ring weight is a variable.
///
/// # Panics
/// As [`extended_net`].
pub fn extended_net_by<S: Field, V: Module<S>>(
    n: u32,
    net: &[V],
    extraordinary: impl Fn(&V, &V) -> V,
) -> Vec<V> {
    assert!(n >= 3, "Loop's local net needs a valence of at least 3");
    level_one_by::<S, V>(n, net, extended_net_size(n), extraordinary)
}

fn level_one_by<S: Field, V: Module<S>>(
    n: u32,
    net: &[V],
    count: usize,
    extraordinary: impl Fn(&V, &V) -> V,
) -> Vec<V> {
    assert_eq!(net.len(), local_net_size(n), "a local net has n + 6 points");
    // At valence 6 both weights are 3/8; Warren's is rational, hence never refused.
    let regular = vertex_mask::<S>(LoopWeights::Warren, 6).expect("3/8 is rational");
    let point = |label: usize| &net[label - 1];
    let refined = (1..=count).map(|label| match level_one_point(n, label) {
        LevelOnePoint::Vertex(center) => {
            let ring = ring(n, center).expect("1, 2 and n+1 have rings");
            let sum = ring.iter().fold(V::zero(), |sum, &i| sum + point(i));
            if center == 1 {
                extraordinary(point(center), &sum)
            } else {
                regular.apply_ring(point(center), &sum)
            }
        }
        LevelOnePoint::Edge(a, b) => {
            let (c, d) = opposite(n, a, b);
            edge_point::<S, V>(point(a), point(b), point(c), point(d))
        }
    });
    refined.collect()
}

/// The two vertices opposite to the edge from `a`, a vertex with a ring, to its neighbour `b`.
fn opposite(n: u32, a: usize, b: usize) -> (usize, usize) {
    let ring = ring(n, a).expect("the first end of an edge has a ring");
    let at = ring
        .iter()
        .position(|&i| i == b)
        .expect("the second end lies in it");
    let len = ring.len();
    (ring[(at + len - 1) % len], ring[(at + 1) % len])
}

/// The labels in the extended net of a tile's twelve points p1..p12.
///
/// Corners (v, w) of the tiles, in the order p4, p7, p8: first (1/2, 0), (1, 0), (1/2, 1/2);
/// second (1/2, 1/2), (0, 1/2), (1/2, 0); third (0, 1/2), (1/2, 1/2), (0, 1).
pub fn tile_labels(n: u32, tile: Tile) -> [usize; 12] {
    let n = n as usize;
    match tile {
        Tile::First => {
            let far = [n + 7, n + 3, n + 2, n + 5, n + 8, n + 9, n + 10];
            let [e24, p2, e2n, pn, e23, e22, en2] = far;
            [3, 1, n + 4, 2, n + 1, e24, p2, e2n, pn, e23, e22, en2]
        }
        Tile::Second => {
            let far = [n + 10, n + 9, n + 5, n + 2, n + 3, n + 6];
            let [en2, e22, pn, e2n, p2, enn] = far;
            [en2, e22, pn, e2n, p2, enn, n + 1, 2, n + 4, n, 1, 3]
        }
        Tile::Third => {
            let far = [n + 6, n + 3, n + 2, n + 5, n + 12, n + 9, n + 10, n + 11];
            let [enn, p2, e2n, pn, en6, e22, en2, en5] = far;
            [1, n, 2, n + 1, enn, p2, e2n, pn, en6, e22, en2, en5]
        }
    }
}

/// The corners (v, w) of a tile in halves, in the order of p4, p7, p8.
///
/// The tile of ring k = 1, 2, ... has these corners times 2^(1-k).
pub const fn tile_corners(tile: Tile) -> [[i64; 2]; 3] {
    match tile {
        Tile::First => [[1, 0], [2, 0], [1, 1]],
        Tile::Second => [[1, 1], [0, 1], [1, 0]],
        Tile::Third => [[0, 1], [1, 1], [0, 2]],
    }
}

/// The regular net p1..p12 of a tile, picked from the extended net.
///
/// # Panics
/// If the extended net has not n + 12 points.
pub fn tile_net<V: Clone>(n: u32, tile: Tile, extended: &[V]) -> [V; 12] {
    assert_eq!(extended.len(), extended_net_size(n));
    tile_labels(n, tile).map(|label| extended[label - 1].clone())
}

/// The (n+6) x (n+6) matrix of [`refine_local_net`]; `None` under the same condition.
pub fn subdivision_matrix<S: Field>(weights: LoopWeights, n: u32) -> Option<DMatrix<S>> {
    linear::matrix_of(local_net_size(n), |net| {
        refine_local_net::<S, S>(weights, n, net)
    })
}

/// The (n+12) x (n+6) matrix of [`extended_net`].
pub fn extended_matrix<S: Field>(weights: LoopWeights, n: u32) -> Option<DMatrix<S>> {
    linear::matrix_of(local_net_size(n), |net| {
        extended_net::<S, S>(weights, n, net)
    })
}

/// The 12 x (n+6) matrix from the local net to a tile's regular net.
pub fn tile_matrix<S: Field>(weights: LoopWeights, n: u32, tile: Tile) -> Option<DMatrix<S>> {
    linear::matrix_of(local_net_size(n), |net| {
        let extended = extended_net::<S, S>(weights, n, net)?;
        Some(tile_net(n, tile, &extended).to_vec())
    })
}

/// The n + 9 mixed second differences of the local net, one per interior edge, in HW's order.
///
/// The difference of an edge is the sum of its ends minus the sum of the two opposite vertices.
/// The second-order norm M of a net is the largest norm of these.
///
/// Source: HW (1).
pub fn second_differences(n: u32) -> Vec<IntegerRow> {
    let last = n as usize + 1;
    let edges = (2..=last).map(|i| (1, i));
    let edges = edges.chain([last, last + 1, last + 2, last + 3, 3].map(|i| (2, i)));
    let edges = edges.chain([last - 1, last + 5, last + 4, last + 1].map(|i| (last, i)));
    let difference = |(a, b)| {
        let (c, d) = opposite(n, a, b);
        IntegerRow::new([(a - 1, 1), (b - 1, 1), (c - 1, -1), (d - 1, -1)])
    };
    edges.map(difference).collect()
}
