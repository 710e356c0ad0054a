//! Catmull-Clark's local net: the 2N + 8 points that govern the patch over one quad with one
//! extraordinary vertex, in Stam's numbering, and its refinement.
//!
//! Labels are 1-based as in the papers; label `i` is element `i - 1` of a net. `V1` is the
//! extraordinary vertex, of valence N; `V(2j)` its edge neighbours and `V(2j+1)` its diagonal
//! vertices, j = 1..N, cyclic: before `V2` comes `V(2N+1)`. The face is `{V1, V4, V5, V6}`, u
//! towards `V6`, v towards `V4`. On the lattice with `V1` at (0, 0):
//!
//! ```text
//!   v
//!   2   2N+8   2N+7   2N+6   2N+2
//!   1    3      4      5     2N+3
//!   0    2      1      6     2N+4
//!  -1           8      7     2N+5
//!       -1      0      1      2    u
//! ```
//!
//! At N = 3 the vertices at (0, -1) and (-1, 0) are the same: read `V8` as `V2`.
//!
//! One refinement gives 2N + 17 points, the *extended net*. Its first 2N + 8 form the same net on
//! the halved lattice around the level-1 extraordinary vertex; labels 2N+9..2N+17 are the halved
//! lattice's (3,3), (3,2), (3,1), (3,0), (3,-1), (2,3), (1,3), (0,3), (-1,3). The tiles are the
//! 4x4 grids of level-1 points with lower left index (0,-1), (0,0), (-1,0).
//!
//! Source: Stam 1998; CY section 2.2 for labels 1..2N+8; labels 2N+9..2N+17 follow the same walk.

use nalgebra::DMatrix;

use super::{edge_point, quad_point, vertex_mask};
use crate::scalar::{Field, Module};
use crate::scheme::{IntegerRow, Tile, linear};

/// The lattice positions of the labels from 2N+2 on; the first seven belong to the local net.
const OUTER: [(i32, i32); 16] = [
    (2, 2),
    (2, 1),
    (2, 0),
    (2, -1),
    (1, 2),
    (0, 2),
    (-1, 2),
    (3, 3),
    (3, 2),
    (3, 1),
    (3, 0),
    (3, -1),
    (2, 3),
    (1, 3),
    (0, 3),
    (-1, 3),
];

/// The labels of a regular local net (N = 4) as a 4x4 grid, row by row: element `4 j + i` is i steps
/// along u and j steps along v from the lower left point, which is `V9`.
pub const REGULAR_LABELS: [usize; 16] = [9, 8, 7, 13, 2, 1, 6, 12, 3, 4, 5, 11, 16, 15, 14, 10];

/// The number of points of the local net, 2N + 8.
pub const fn local_net_size(n: u32) -> usize {
    2 * n as usize + 8
}

/// The number of points of the extended net, 2N + 17.
pub const fn extended_net_size(n: u32) -> usize {
    2 * n as usize + 17
}

/// The label of the ring vertex with cyclic index `i`, reduced to 2..=2N+1.
pub fn ring_label(n: u32, i: usize) -> usize {
    let len = 2 * n as usize;
    (i + len - 2) % len + 2
}

/// The label of the point at lattice position (i, j), in the local net (positions up to 2) or in
/// the extended net (up to 3).
///
/// `None` if and only if there is no such point: outside the square from -1 to 3, and at (-1, -1),
/// where the lattice ends (at N = 4 the vertex `V9` would lie there).
pub fn lattice_label(n: u32, i: i32, j: i32) -> Option<usize> {
    Some(match (i, j) {
        (0, 0) => 1,
        (-1, 0) => 2,
        (-1, 1) => 3,
        (0, 1) => 4,
        (1, 1) => 5,
        (1, 0) => 6,
        (1, -1) => 7,
        (0, -1) => ring_label(n, 8),
        _ => OUTER.iter().position(|&at| at == (i, j))? + 2 * n as usize + 2,
    })
}

/// The local net of the next level: 2N + 8 points over the quarter of the face at `V1`.
///
/// Guarantee: exact in exact types, an enclosure in intervals.
///
/// # Panics
/// If n < 3 or the net has not 2n + 8 points.
///
/// ```
/// use subcert::scalar::{Field, Rational};
/// use subcert::scheme::catmull_clark::refine_local_net;
/// let mut net = vec![Rational::ratio(0, 1); 14];
/// net[0] = Rational::ratio(1, 1);
/// let next = refine_local_net::<Rational, _>(3, &net);
/// assert_eq!(next[0], Rational::ratio(5, 12)); // 1 - 7/(4N)
/// ```
pub fn refine_local_net<S: Field, V: Module<S>>(n: u32, net: &[V]) -> Vec<V> {
    level_one::<S, V>(n, net, local_net_size(n))
}

/// All 2N + 17 level-1 points that the local net determines around the face.
///
/// Panics as [`refine_local_net`], whose result is the first 2N + 8 points.
pub fn extended_net<S: Field, V: Module<S>>(n: u32, net: &[V]) -> Vec<V> {
    level_one::<S, V>(n, net, extended_net_size(n))
}

fn level_one<S: Field, V: Module<S>>(n: u32, net: &[V], count: usize) -> Vec<V> {
    assert!(n >= 3, "Stam's layout needs a valence of at least 3");
    assert_eq!(
        net.len(),
        local_net_size(n),
        "a local net has 2N + 8 points"
    );
    let mut refined = ring_points::<S, V>(n, net);
    let outer = &OUTER[..count - refined.len()];
    refined.extend(
        outer
            .iter()
            .map(|&(i, j)| lattice_point::<S, V>(n, net, i, j)),
    );
    refined
}

/// The level-1 points 1..=2N+1: the vertex point of `V1`, its edge points and its face points.
fn ring_points<S: Field, V: Module<S>>(n: u32, net: &[V]) -> Vec<V> {
    let center = &net[0];
    let ring = |i: usize| &net[ring_label(n, i) - 1];
    let sectors = 1..=n as usize;
    let faces = sectors
        .clone()
        .map(|j| quad_point::<S, V>(center, ring(2 * j), ring(2 * j + 1), ring(2 * j + 2)))
        .collect::<Vec<V>>();
    let edge_sum = sectors.clone().fold(V::zero(), |sum, j| sum + ring(2 * j));
    let face_sum = faces.iter().fold(V::zero(), |sum, face| sum + face);
    let mut points = vec![vertex_mask::<S>(n).apply(center, &edge_sum, &face_sum)];
    for j in sectors {
        let before = &faces[(j + faces.len() - 2) % faces.len()];
        let after = &faces[j - 1];
        points.push(edge_point::<S, V>(center, ring(2 * j), before, after));
        points.push(after.clone());
    }
    points
}

/// The level-1 point at position (i, j) of the halved lattice, away from `V1`: its old vertices
/// lie on the lattice at (i/2, j/2).
fn lattice_point<S: Field, V: Module<S>>(n: u32, net: &[V], i: i32, j: i32) -> V {
    let p = |i, j| &net[lattice_label(n, i, j).expect("a lattice point of the local net") - 1];
    let face = |i, j| quad_point::<S, V>(p(i, j), p(i + 1, j), p(i + 1, j + 1), p(i, j + 1));
    let (x, y) = (i.div_euclid(2), j.div_euclid(2));
    match (i.rem_euclid(2), j.rem_euclid(2)) {
        (1, 1) => face(x, y),
        (1, _) => edge_point::<S, V>(p(x, y), p(x + 1, y), &face(x, y - 1), &face(x, y)),
        (_, 1) => edge_point::<S, V>(p(x, y), p(x, y + 1), &face(x - 1, y), &face(x, y)),
        _ => {
            let edges = p(x + 1, y).clone() + p(x, y + 1) + p(x - 1, y) + p(x, y - 1);
            let upper = face(x, y) + &face(x - 1, y);
            let lower = face(x - 1, y - 1) + &face(x, y - 1);
            vertex_mask::<S>(4).apply(p(x, y), &edges, &(upper + &lower))
        }
    }
}

/// The labels in the extended net of a tile's 4x4 grid, row by row: element `4 j + i` is the point
/// i steps along u and j steps along v from the lower left one.
pub fn tile_labels(n: u32, tile: Tile) -> [usize; 16] {
    let (i0, j0) = tile.lower_left();
    std::array::from_fn(|at| {
        let (i, j) = (i0 + (at % 4) as i32, j0 + (at / 4) as i32);
        lattice_label(n, i, j).expect("tiles lie in the extended net")
    })
}

/// The lower left corner (u, v) of a tile in halves; its side is one half.
///
/// The tile of ring k = 1, 2, ... has these corners, and this side, times 2^(1-k).
pub const fn tile_corner(tile: Tile) -> [i64; 2] {
    match tile {
        Tile::First => [1, 0],
        Tile::Second => [1, 1],
        Tile::Third => [0, 1],
    }
}

/// The regular 4x4 net of a tile, picked from the extended net; order as [`tile_labels`].
///
/// # Panics
/// If the extended net has not 2N + 17 points.
pub fn tile_net<V: Clone>(n: u32, tile: Tile, extended: &[V]) -> [V; 16] {
    assert_eq!(extended.len(), extended_net_size(n));
    tile_labels(n, tile).map(|label| extended[label - 1].clone())
}

/// The (2N+8) x (2N+8) matrix of [`refine_local_net`].
///
/// Source: CY (9)-(12), for N = 3 with `V8` read as `V2`.
pub fn subdivision_matrix<S: Field>(n: u32) -> DMatrix<S> {
    matrix_of(n, |net| refine_local_net::<S, S>(n, net))
}

/// The (2N+17) x (2N+8) matrix of [`extended_net`].
pub fn extended_matrix<S: Field>(n: u32) -> DMatrix<S> {
    matrix_of(n, |net| extended_net::<S, S>(n, net))
}

/// The 16 x (2N+8) matrix from the local net to a tile's regular net.
pub fn tile_matrix<S: Field>(n: u32, tile: Tile) -> DMatrix<S> {
    matrix_of(n, |net| {
        tile_net(n, tile, &extended_net::<S, S>(n, net)).to_vec()
    })
}

fn matrix_of<S: Field>(n: u32, map: impl Fn(&[S]) -> Vec<S>) -> DMatrix<S> {
    linear::matrix_of(local_net_size(n), |net| Some(map(net))).expect("the map always answers")
}

/// The 2N + 10 second differences of the local net.
///
/// - `2 V1 - V(2j) - V(2j+4)`, j = 1..N: edge neighbours two apart;
/// - `2 V(2j) - V(2j-1) - V(2j+1)`, j = 1..N;
/// - ten lines of the lattice that don't end on the ring's far side.
///
/// The second-order norm M of a net is the largest norm of these. At N = 4 the first kind occurs
/// twice and sixteen rows are distinct.
///
/// Source: CY, the norm Z of Lemma 7 and its Appendix D. The index `2[(j+2)%N]` printed after Lemma 7
/// (it names a `V0` at j = N - 2) is a misprint for `2[(j+1)%N + 1]`, as Appendix D has it.
pub fn second_differences(n: u32) -> Vec<IntegerRow> {
    let ring = |i| ring_label(n, i);
    let difference =
        |a: usize, b: usize, c: usize| IntegerRow::new([(b - 1, 2), (a - 1, -1), (c - 1, -1)]);
    let sectors = 1..=n as usize;
    let across = sectors
        .clone()
        .map(|j| difference(ring(2 * j), 1, ring(2 * j + 4)));
    let around = sectors.map(|j| difference(ring(2 * j + 2 * n as usize - 1), 2 * j, 2 * j + 1));
    let far = 2 * n as usize;
    let outer = [
        (ring(8), 7, far + 5),
        (1, 6, far + 4),
        (4, 5, far + 3),
        (far + 8, far + 7, far + 6),
        (far + 7, far + 6, far + 2),
        (2, 3, far + 8),
        (1, 4, far + 7),
        (6, 5, far + 6),
        (far + 5, far + 4, far + 3),
        (far + 4, far + 3, far + 2),
    ];
    let outer = outer.map(|(a, b, c)| difference(a, b, c));
    across.chain(around).chain(outer).collect()
}

/// The 2N + 18 first differences of the local net, each pair of points once.
///
/// - `V_i - V1`, i = 2..2N+1: the ring of V1;
/// - from V6 to 7, 8, 2N+3, 2N+4, 2N+5, 5, 4; from V5 to 4, 2N+2, 2N+3, 2N+4, 2N+6, 2N+7; from V4 to 2, 3,
///   2N+6, 2N+7, 2N+8.
///
/// The first-order norm of a net is the largest norm of these: every point that shares a face with a
/// corner of the face, less that corner. At N = 3 V8 is V2.
///
/// Source: CY (17), (18).
pub fn first_differences(n: u32) -> Vec<IntegerRow> {
    let far = 2 * n as usize;
    let eight = ring_label(n, 8);
    let from = |center: usize, to: &[usize]| -> Vec<IntegerRow> {
        let row = |&label: &usize| IntegerRow::new([(label - 1, 1), (center - 1, -1)]);
        to.iter().map(row).collect()
    };
    let ring: Vec<usize> = (2..=far + 1).collect();
    [
        from(1, &ring),
        from(6, &[7, eight, far + 3, far + 4, far + 5, 5, 4]),
        from(5, &[4, far + 2, far + 3, far + 4, far + 6, far + 7]),
        from(4, &[2, 3, far + 6, far + 7, far + 8]),
    ]
    .concat()
}
