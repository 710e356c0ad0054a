//! What a set is to the search: items that open into pieces, and pieces that split.

use super::metric::{Aabb, foot, length};
use crate::patch::Lane;

/// A piece as seen from outside: a triangle or bilinear quad with a thickness.
///
/// The piece is a map u -> P(u); I(u) interpolates its corners linearly (three corners) or
/// bilinearly (four). With rounding already added outward, `|P(u) - I(u)| <= thickness` for all u.
#[derive(Clone, Copy, Debug)]
pub struct Outline {
    /// Points of the set, each off by at most `slack`.
    pub corners: [Lane; 4],
    /// 3 or 4.
    pub count: usize,
    /// Bound of |P(u) - I(u)|.
    pub thickness: f64,
    /// Bound of the error of each corner, as a vector.
    pub slack: f64,
}

impl Outline {
    /// The corners.
    #[inline]
    pub fn corners(&self) -> &[Lane] {
        &self.corners[..self.count]
    }

    /// Triangles of corners such that every point of one is within the returned length (beside
    /// `thickness` and `slack`) of I, and every point of I of one of them.
    ///
    /// On the half u >= v the bilinear I differs from the linear interpolant of corners 0, 1, 2 by
    /// `(1 - u) v t`, `t = c0 - c1 + c2 - c3`, hence by at most |t| / 4.
    #[inline]
    pub fn cores(&self) -> (usize, [[Lane; 3]; 2], f64) {
        let [a, b, c, d] = self.corners;
        if self.count == 3 {
            (1, [[a, b, c]; 2], 0.0)
        } else {
            let twist = (a - &b + (c - &d)).norm_squared().sqrt();
            (2, [[a, b, c], [a, c, d]], 0.25 * twist)
        }
    }

    /// The largest distance of a corner to one triangle: by convexity a bound for all of I.
    #[inline]
    pub fn reach(&self, triangle: &[Lane; 3]) -> (f64, usize) {
        let mut worst = (0.0, 0);
        for (i, c) in self.corners().iter().enumerate() {
            let d = length(c, &foot(c, triangle));
            if d > worst.0 {
                worst = (d, i);
            }
        }
        worst
    }
}

/// One of the two sets whose distance is measured.
pub trait Shape: Sync {
    /// A part of an item.
    type Piece: Send;
    /// Storage reused from call to call.
    type Scratch: Default + Send;

    /// Number of items.
    fn item_count(&self) -> u32;

    /// The face of the mesh that an item belongs to.
    fn face_of(&self, item: u32) -> u32;

    /// Pieces that cover an item; none where the item is empty.
    fn open(&self, item: u32, scratch: &mut Self::Scratch, out: &mut Vec<Self::Piece>);

    /// Smaller pieces that cover a piece; none if it can't be split any further.
    fn split(&self, piece: &Self::Piece, scratch: &mut Self::Scratch, out: &mut Vec<Self::Piece>);

    /// The piece from outside.
    fn outline<'a>(&self, piece: &'a Self::Piece) -> &'a Outline;

    /// Visits points whose hull holds the piece, each off by at most the outline's slack.
    fn hull(&self, piece: &Self::Piece, visit: impl FnMut(&Lane));

    /// The items' boxes.
    fn boxes(&self) -> Vec<Aabb>;

    /// An item that is exactly one triangle, with the error of its corners: the fast case.
    fn triangle(&self, item: u32) -> Option<(&[Lane; 3], f64)>;

    /// The box of a piece.
    fn piece_box(&self, piece: &Self::Piece) -> Aabb {
        let mut bounds = Aabb::EMPTY;
        self.hull(piece, |p| bounds.include(p));
        bounds.widen(self.outline(piece).slack);
        bounds
    }
}
