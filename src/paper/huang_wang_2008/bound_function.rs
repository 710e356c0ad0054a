//! Section 4.2: the distance bound function B over the tiles, its maximum β(n) by the paper's own
//! method, and where the maximum lies.
//!
//! Over the tile (k, m) the method bounds each Bernstein coefficient of S less the limit triangle by
//! its own least number δ_i ([`Constant::Coefficient`]), and B is the quartic with these
//! coefficients.
//!
//! *Rings beyond K.* Let D be the supremum of all δ_i over all rings, a_K that over the rings up to K,
//! e_K the norm of S less the limit triangle at (2^-K, 0). With A the subdivision matrix and F̄_y the
//! limit triangle of the net y, a coefficient t at the node u of a ring beyond K is
//!
//! ```text
//! t(y) = t'(A^K y) + F̄_(A^K y)(2^K u) - F̄_y(u),    t' a coefficient of a ring beyond 0.
//! ```
//!
//! The second part is affine, 0 at the extraordinary corner and at most e_K at the two others of the
//! subdomain; so |t| <= r_K D + e_K. Hence D <= max(a_K, r_K D + e_K) <= max(a_K, e_K / (1 - r_K)),
//! and **B <= r_K D + e_K on all rings beyond K**.
//!
//! *Where the maximum lies.* Over a tile (k, 1), ∂B/∂w < 0 on every piece that may hold the maximum
//! puts it on the border w = 0. A tile (k, 2) is its own mirror image and so is its B: if B is
//! strictly concave across the diagonal round about, the maximum is on the diagonal. Both are decided
//! on intervals.

use std::collections::BinaryHeap;

use crate::bernstein::Patch;
use crate::bernstein::triangle::QuarticTriangle;
use crate::bound::word::Word;
use crate::bound::{Constant, Prover};
use crate::paper::Enclosure;
use crate::scalar::{Cyclotomic, Interval};
use crate::scheme::Tile;

/// The curve of the face on which a maximum lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Curve {
    /// v = w.
    Diagonal,
    /// w = 0, and by symmetry v = 0.
    Border,
}

/// B over a tile.
#[derive(Clone, Debug)]
pub struct TileBound {
    /// The ring k, from 1.
    pub ring: usize,
    /// The first or the second tile; the third is the mirror image of the first.
    pub tile: Tile,
    /// δ_1 .. δ_15, enclosed.
    pub deltas: [Interval; 15],
    /// The same exactly, where both sides met.
    pub exact: [Option<Cyclotomic>; 15],
}

/// B and its maximum.
#[derive(Clone, Debug)]
pub struct BoundFunction {
    /// β(n).
    pub maximum: Enclosure,
    /// The tiles of the first rings.
    pub tiles: Vec<TileBound>,
    /// The tiles where B reaches the lower end of `maximum`: the maximum is in one of them.
    pub attaining: Vec<usize>,
    /// The curves on which the maximum lies if it is in an attaining tile, in their order; `None` if
    /// that was not decided.
    pub curves: Vec<Option<Curve>>,
    /// The largest B beyond ring 2, at most.
    pub beyond_ring_2: f64,
}

/// Rings that are looked at before the tail is closed, and the most.
const RINGS: std::ops::RangeInclusive<usize> = 3..=10;

/// Relative width of the enclosure of β(n).
const WIDTH: f64 = 1e-10;

/// Most halvings of a whole tile at once, into 2^10 parts.
const MOST_UNIFORM_HALVINGS: usize = 10;

/// Most halvings of a part of a tile.
const MOST_HALVINGS: usize = 40;

/// A part of a tile.
#[derive(Clone)]
struct Piece {
    tile: usize,
    sup: f64,
    halvings: usize,
    corners: [[f64; 2]; 4],
    quartic: QuarticTriangle<Interval>,
}

impl PartialEq for Piece {
    fn eq(&self, other: &Self) -> bool {
        self.sup.total_cmp(&other.sup).is_eq()
    }
}
impl Eq for Piece {}
impl PartialOrd for Piece {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Piece {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.sup.total_cmp(&other.sup)
    }
}

impl Piece {
    fn new(
        tile: usize,
        halvings: usize,
        corners: [[f64; 2]; 4],
        quartic: QuarticTriangle<Interval>,
    ) -> Self {
        let sup = hull_sup(&quartic.0);
        Piece {
            tile,
            sup,
            halvings,
            corners,
            quartic,
        }
    }

    fn whole(tile: usize, deltas: &[Interval; 15]) -> Self {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];
        Self::new(tile, 0, corners, QuarticTriangle(*deltas))
    }

    fn halves(&self) -> [Piece; 2] {
        let halves = Patch::<Interval, Interval>::halve(&self.quartic, &self.corners);
        halves.map(|(quartic, corners)| Piece::new(self.tile, self.halvings + 1, corners, quartic))
    }

    /// A value that B takes on the piece, at least.
    fn inf_at_corners(&self) -> f64 {
        let values = [0, 10, 14].map(|i| self.quartic.0[i].inf());
        values.into_iter().fold(0.0, f64::max)
    }

    /// The tile's direction (x, y) as a combination of this piece's two edge vectors. Corners are
    /// dyadic and areas powers of two, so this is exact in `f64`.
    fn direction(&self, x: f64, y: f64) -> [Interval; 2] {
        let [p0, p1, p2, _] = self.corners;
        let (a, b) = (
            [p1[0] - p0[0], p1[1] - p0[1]],
            [p2[0] - p0[0], p2[1] - p0[1]],
        );
        let determinant = a[0] * b[1] - a[1] * b[0];
        let solve = [
            (x * b[1] - y * b[0]) / determinant,
            (a[0] * y - a[1] * x) / determinant,
        ];
        solve.map(Interval::point)
    }

    /// Whether B falls strictly towards larger w everywhere on the piece.
    fn falls_with_w(&self) -> bool {
        let [s, t] = self.direction(0.0, 1.0);
        let [dv, dw] = Patch::<Interval, Interval>::first_derivatives(&self.quartic);
        let mut pairs = dv.iter().zip(&dw);
        pairs.all(|(a, b)| (*a * s + *b * t).sup() < 0.0)
    }

    /// Whether B is strictly concave in the direction (1, -1) on the piece.
    fn is_concave_across(&self) -> bool {
        let [s, t] = self.direction(1.0, -1.0);
        let two = Interval::point(2.0);
        let [vv, vw, ww] = Patch::<Interval, Interval>::second_derivatives(&self.quartic);
        (0..vv.len()).all(|i| {
            let second = vv[i] * s.sqr() + two * vw[i] * s * t + ww[i] * t.sqr();
            second.sup() < 0.0
        })
    }
}

fn hull_sup(coefficients: &[Interval]) -> f64 {
    let sups = coefficients.iter().map(|c| c.sup());
    sups.fold(0.0, f64::max)
}

impl TileBound {
    fn prove(prover: &mut Prover, ring: usize, tile: Tile) -> Option<Self> {
        let letter = match tile {
            Tile::First => 1,
            Tile::Second => 2,
            Tile::Third => 3,
        };
        let word = Word::zeros(ring - 1).child(letter);
        let mut deltas = [Interval::ENTIRE; 15];
        let mut exact = [const { None }; 15];
        for i in 0..15 {
            let proof = prover.prove(Constant::Coefficient(word, i), WIDTH)?;
            deltas[i] = Interval::new(proof.lo, proof.hi);
            exact[i] = prover.closed_form(&proof);
        }
        Some(TileBound {
            ring,
            tile,
            deltas,
            exact,
        })
    }
}

impl BoundFunction {
    /// B of a valence, as the paper defines it; `None` if no bound of the rings near the extraordinary
    /// corner was found.
    pub fn prove(prover: &mut Prover) -> Option<Self> {
        let mut tiles = Vec::new();
        for ring in 1..=*RINGS.end() {
            for tile in [Tile::First, Tile::Second] {
                tiles.push(TileBound::prove(prover, ring, tile)?);
            }
            if ring < *RINGS.start() {
                continue;
            }
            let maximum = maximum(&tiles);
            let tail = tail(prover, ring, &tiles)?;
            if tail < maximum.0 {
                return Self::assemble(tiles, maximum, tail);
            }
        }
        None
    }

    fn assemble(tiles: Vec<TileBound>, (lo, hi): (f64, f64), tail: f64) -> Option<Self> {
        let mut attaining = Vec::new();
        let mut curves = Vec::new();
        let mut beyond_ring_2 = tail;
        for (i, tile) in tiles.iter().enumerate() {
            let whole = Piece::whole(i, &tile.deltas);
            let sup = sup_against(&whole, lo);
            if tile.ring > 2 {
                beyond_ring_2 = beyond_ring_2.max(sup);
            }
            if sup >= lo {
                attaining.push(i);
                curves.push(curve(&whole, tile.tile, lo));
            }
        }
        Some(BoundFunction {
            maximum: Enclosure::floats(lo, hi)?,
            tiles,
            attaining,
            curves,
            beyond_ring_2,
        })
    }

    /// Fact 1: the maximum lies in v + w >= 1/4, that is in the rings 1 and 2.
    pub fn fact_1(&self) -> Option<bool> {
        let lo = crate::scalar::float::round_down(&self.maximum.lo);
        (self.beyond_ring_2 < lo).then_some(true)
    }

    /// Fact 2: the maximum lies on the diagonal or on a border.
    pub fn fact_2(&self) -> Option<bool> {
        self.curves.iter().all(Option::is_some).then_some(true)
    }

    /// The tile and the curve of the maximum, if there is one candidate only.
    pub fn place(&self) -> Option<(&TileBound, Curve)> {
        match (&self.attaining[..], &self.curves[..]) {
            ([tile], [Some(curve)]) => Some((&self.tiles[*tile], *curve)),
            _ => None,
        }
    }
}

/// The maximum over the tiles, enclosed: best first.
fn maximum(tiles: &[TileBound]) -> (f64, f64) {
    let wholes = tiles.iter().enumerate();
    let mut queue: BinaryHeap<Piece> = wholes.map(|(i, t)| Piece::whole(i, &t.deltas)).collect();
    let mut lo = queue.iter().map(Piece::inf_at_corners).fold(0.0, f64::max);
    loop {
        let Some(piece) = queue.pop() else {
            return (lo, lo);
        };
        if piece.sup <= lo * (1.0 + WIDTH) || piece.halvings >= MOST_HALVINGS {
            return (lo, piece.sup.max(lo));
        }
        for half in piece.halves() {
            lo = lo.max(half.inf_at_corners());
            if half.sup > lo {
                queue.push(half);
            }
        }
    }
}

/// The supremum over a piece if it reaches `lo`; else some bound below `lo`.
fn sup_against(whole: &Piece, lo: f64) -> f64 {
    let mut queue = BinaryHeap::from([whole.clone()]);
    while let Some(piece) = queue.pop() {
        if piece.sup < lo || piece.inf_at_corners() >= lo || piece.halvings >= MOST_HALVINGS {
            return piece.sup;
        }
        queue.extend(piece.halves());
    }
    whole.sup
}

/// The curve on which every maximum of at least `lo` over a tile lies.
fn curve(whole: &Piece, tile: Tile, lo: f64) -> Option<Curve> {
    match tile {
        Tile::Second => is_on_diagonal(whole, lo).then_some(Curve::Diagonal),
        _ => is_on_border(whole, lo).then_some(Curve::Border),
    }
}

fn is_on_border(whole: &Piece, lo: f64) -> bool {
    let mut open = vec![whole.clone()];
    while let Some(piece) = open.pop() {
        if piece.sup < lo || piece.falls_with_w() {
            continue;
        }
        if piece.halvings >= MOST_HALVINGS {
            return false;
        }
        open.extend(piece.halves());
    }
    true
}

/// With s = v + w, t = v - w: let the parts that reach `lo` lie in s_0 <= s <= s_1, |t| <= t_1. If B
/// is strictly concave along t on every part that meets this box, its maximum has t = 0: from a
/// maximum off the diagonal the segment to its mirror image stays in the box.
fn is_on_diagonal(whole: &Piece, lo: f64) -> bool {
    let span = |piece: &Piece, of: fn([f64; 2]) -> f64| {
        let [a, b, c, _] = piece.corners.map(of);
        (a.min(b).min(c), a.max(b).max(c))
    };
    let sum = |piece: &Piece| span(piece, |[v, w]| v + w);
    let difference = |piece: &Piece| span(piece, |[v, w]| v - w);
    let mut parts = vec![whole.clone()];
    for _ in 0..=MOST_UNIFORM_HALVINGS {
        let (mut s0, mut s1, mut t1) = (f64::INFINITY, f64::NEG_INFINITY, 0.0f64);
        for part in parts.iter().filter(|part| part.sup >= lo) {
            let ((low, high), (left, right)) = (sum(part), difference(part));
            (s0, s1) = (s0.min(low), s1.max(high));
            t1 = t1.max(-left).max(right);
        }
        let mut met = parts.iter().filter(|part| {
            let ((low, high), (left, right)) = (sum(part), difference(part));
            low <= s1 && high >= s0 && left <= t1 && right >= -t1
        });
        if met.all(Piece::is_concave_across) {
            return true;
        }
        parts = parts.iter().flat_map(Piece::halves).collect();
    }
    false
}

/// A bound of B on the rings beyond the given one.
fn tail(prover: &mut Prover, ring: usize, tiles: &[TileBound]) -> Option<f64> {
    let rate = prover.prove(Constant::Rate(ring), WIDTH)?;
    let rate = Interval::new(rate.lo, rate.hi);
    // (2^-K, 0) is corner 1 of the first tile of ring K + 1: coefficient 10.
    let corner = Constant::Coefficient(Word::zeros(ring).child(1), 10);
    let corner = prover.prove(corner, WIDTH)?;
    let corner = Interval::new(corner.lo, corner.hi);
    let rest = Interval::point(1.0) - rate;
    if rest.inf() <= 0.0 {
        return None;
    }
    let largest = tiles
        .iter()
        .map(|t| hull_sup(&t.deltas))
        .fold(0.0, f64::max);
    let all = Interval::point(largest).max(corner / rest);
    Some((rate * all + corner).sup())
}
