//! Doo-Sabin's local net: the n + 5 points that govern the patch around one vertex of valence 4
//! whose faces are one n-gon and three quads, and its refinement.
//!
//! Labels are 1-based; label `i` is element `i - 1` of a net. The vertex is `P1`. Its faces are
//! the extraordinary face f = {P1, ..., Pn}, and the quads g = {P1, P2, P(n+1), P(n+2)},
//! h = {P1, P(n+2), P(n+3), P(n+4)} and k = {P1, P(n+4), P(n+5), Pn}. On the lattice with `P1` at
//! (0, 0):
//!
//! ```text
//!    1    n+5     n+4     n+3
//!         k       h
//!    0    n       1       n+2
//!         f       g
//!   -1    (3)     2       n+1
//!        -1       0       1
//! ```
//!
//! The patch is the part of the limit surface that belongs to `P1`, over the unit square: its
//! corners (0, 0), (1, 0), (1, 1), (0, 1) are the centroids of f, g, h, k, which lie on the
//! surface. For n = 4 the net is the 3x3 net of a biquadratic patch, and (3) is `P3`.
//!
//! One refinement gives n + 12 points, the *extended net*: the new corners of all four faces, here
//! on the halved lattice (`1f` is the corner of f at P1):
//!
//! ```text
//!    2    (n+5)k  (n+4)k  (n+4)h  (n+3)h
//!    1    (n)k    1k      1h      (n+2)h
//!    0    (n)f    1f      1g      (n+2)g
//!   -1    (3)f    2f      2g      (n+1)g
//!        -1       0       1       2
//! ```
//!
//! Its first n + 5 form the same net at `1f`, with the same n-gon round the corner (0, 0) and the
//! sides halved: an extraordinary face never goes away. Labels n+6..n+12 are the outermost points
//! anticlockwise, from (n+1)g to (n+5)k. The tiles are the 3x3 grids with lower left index
//! (0,-1), (0,0), (-1,0): the nets at `1g`, `1h`, `1k`, biquadratic patches over the quarters.
//!
//! Source: derived here from the masks; the numbering follows Stam's for the other schemes.

use nalgebra::DMatrix;

use super::{corner_mask, corner_point};
use crate::scalar::{Field, Module};
use crate::scheme::{IntegerRow, Tile, linear};

/// The lattice positions of the labels from n+1 on; the first five belong to the local net.
const OUTER: [(i32, i32); 12] = [
    (1, -1),
    (1, 0),
    (1, 1),
    (0, 1),
    (-1, 1),
    (2, -1),
    (2, 0),
    (2, 1),
    (2, 2),
    (1, 2),
    (0, 2),
    (-1, 2),
];

/// The labels of a regular local net (n = 4) as a 3x3 grid, row by row: element `3 j + i` is i
/// steps along u and j steps along v from the lower left point.
pub const REGULAR_LABELS: [usize; 9] = [3, 2, 5, 4, 1, 6, 9, 8, 7];

/// The number of points of the local net, n + 5.
pub const fn local_net_size(n: u32) -> usize {
    n as usize + 5
}

/// The number of points of the extended net, n + 12.
pub const fn extended_net_size(n: u32) -> usize {
    n as usize + 12
}

/// The label of the point at lattice position (i, j), in the local or in the extended net.
///
/// `None` if and only if there is no such point; (-1, -1) has none, as the n-gon lies there.
pub fn lattice_label(n: u32, i: i32, j: i32) -> Option<usize> {
    Some(match (i, j) {
        (0, 0) => 1,
        (0, -1) => 2,
        (-1, 0) => n as usize,
        _ => OUTER.iter().position(|&at| at == (i, j))? + n as usize + 1,
    })
}

/// The quads g, h, k at `P1`, as labels; all start at `P1` and turn as f does.
pub const fn quads(n: u32) -> [[usize; 4]; 3] {
    let n = n as usize;
    [
        [1, 2, n + 1, n + 2],
        [1, n + 2, n + 3, n + 4],
        [1, n + 4, n + 5, n],
    ]
}

/// The local net of the next level: n + 5 points over the quarter of the square at f's centroid.
///
/// `None` if and only if the type cannot represent the corner mask of the n-gon.
///
/// Guarantee: exact in exact types, an enclosure in intervals.
///
/// # Panics
/// If n < 3 or the net has not n + 5 points.
///
/// ```
/// use subcert::scalar::{Field, Rational};
/// use subcert::scheme::doo_sabin::refine_local_net;
/// let mut net = vec![Rational::ratio(0, 1); 8];
/// net[0] = Rational::ratio(1, 1);
/// let next = refine_local_net::<Rational, _>(3, &net).unwrap();
/// assert_eq!(next[0], Rational::ratio(2, 3)); // (n + 5)/(4 n)
/// ```
pub fn refine_local_net<S: Field, V: Module<S>>(n: u32, net: &[V]) -> Option<Vec<V>> {
    let mut refined = extended_net::<S, V>(n, net)?;
    refined.truncate(local_net_size(n));
    Some(refined)
}

/// All n + 12 level-1 points that the local net determines.
///
/// `None` and panics as for [`refine_local_net`], whose result is the first n + 5 points.
pub fn extended_net<S: Field, V: Module<S>>(n: u32, net: &[V]) -> Option<Vec<V>> {
    let mask = corner_mask::<S>(n)?;
    let corner = |face: &[V], at: usize| corner_point(&mask, face, at);
    Some(extended_net_by::<S, V>(n, net, corner))
}

/// [`extended_net`] with the n-gon's corners made by `corner(face, index)`: the one rule of the net that
/// needs a cosine.
pub fn extended_net_by<S: Field, V: Module<S>>(
    n: u32,
    net: &[V],
    corner: impl Fn(&[V], usize) -> V,
) -> Vec<V> {
    assert!(n >= 3, "a face has at least 3 corners");
    assert_eq!(net.len(), local_net_size(n), "a local net has n + 5 points");
    let size = n as usize;
    let regular = corner_mask::<S>(4).expect("the cosines of a quad are rational");
    let face = &net[..size];
    let mut refined = Vec::with_capacity(extended_net_size(n));
    refined.extend((0..size).map(|at| corner(face, at)));
    let [g, h, k] = quads(n).map(|quad| quad.map(|label| net[label - 1].clone()));
    // (quad, corner), in the order of OUTER.
    let corners = [
        (&g, 1),
        (&g, 0),
        (&h, 0),
        (&k, 0),
        (&k, 3),
        (&g, 2),
        (&g, 3),
        (&h, 1),
        (&h, 2),
        (&h, 3),
        (&k, 1),
        (&k, 2),
    ];
    refined.extend(corners.map(|(quad, corner)| corner_point(&regular, quad, corner)));
    refined
}

/// The labels in the extended net of a tile's 3x3 grid; order as [`REGULAR_LABELS`].
pub fn tile_labels(n: u32, tile: Tile) -> [usize; 9] {
    let (i0, j0) = tile.lower_left();
    std::array::from_fn(|at| {
        let (i, j) = (i0 + (at % 3) as i32, j0 + (at / 3) as i32);
        lattice_label(n, i, j).expect("tiles lie in the extended net")
    })
}

/// The regular 3x3 net of a tile, picked from the extended net.
///
/// # Panics
/// If the extended net has not n + 12 points.
pub fn tile_net<V: Clone>(n: u32, tile: Tile, extended: &[V]) -> [V; 9] {
    assert_eq!(extended.len(), extended_net_size(n));
    tile_labels(n, tile).map(|label| extended[label - 1].clone())
}

/// The (n+5) x (n+5) matrix of [`refine_local_net`]; `None` under the same condition.
pub fn subdivision_matrix<S: Field>(n: u32) -> Option<DMatrix<S>> {
    linear::matrix_of(local_net_size(n), |net| refine_local_net::<S, S>(n, net))
}

/// The (n+12) x (n+5) matrix of [`extended_net`].
pub fn extended_matrix<S: Field>(n: u32) -> Option<DMatrix<S>> {
    linear::matrix_of(local_net_size(n), |net| extended_net::<S, S>(n, net))
}

/// The 9 x (n+5) matrix from the local net to a tile's regular net.
pub fn tile_matrix<S: Field>(n: u32, tile: Tile) -> Option<DMatrix<S>> {
    linear::matrix_of(local_net_size(n), |net| {
        let extended = extended_net::<S, S>(n, net)?;
        Some(tile_net(n, tile, &extended).to_vec())
    })
}

/// The differences of the local net whose largest is the norm M of a face:
///
/// - the six second differences `P_a - 2 P_b + P_c` along lines of the lattice, which pass straight through
///   vertices of valence 4;
/// - if n is not 4, all differences `P_j - P_i`, i < j <= n, of the extraordinary face: its diameter.
///
/// On the affine image of a regular n-gon (n not 4) S - F is not 0, so M must not be either; and no
/// integer combination of points vanishes on these nets alone unless n is 3, 4 or 6, since a conjugate
/// of cos 2π/n would do as well. At n = 4 the six second differences are LN's norm of Theorem 5.
///
/// Source: derived here.
pub fn face_differences(n: u32) -> Vec<IntegerRow> {
    let size = n as usize;
    let second =
        |a: usize, b: usize, c: usize| IntegerRow::new([(a - 1, 1), (b - 1, -2), (c - 1, 1)]);
    let mut rows = vec![
        second(2, 1, size + 4),
        second(size, 1, size + 2),
        second(3, 2, size + 1),
        second(size - 1, size, size + 5),
        second(size + 1, size + 2, size + 3),
        second(size + 5, size + 4, size + 3),
    ];
    if n != 4 {
        let pairs = (0..size).flat_map(|i| (i + 1..size).map(move |j| (i, j)));
        rows.extend(pairs.map(|(i, j)| IntegerRow::new([(j, 1), (i, -1)])));
    }
    rows
}
