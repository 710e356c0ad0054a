//! The rules of the schemes: how nets of functionals are refined, and what is measured on them.
//!
//! A file for each scheme, with the same verbs. A *net* is that of a word: the local net round the
//! extraordinary corner, or the regular net of a part. Regular nets can be read as local nets of the
//! scheme's regular valence.

mod catmull_clark;
mod doo_sabin;
mod loop_rules;

use std::fmt;
use std::str::FromStr;

pub use catmull_clark::CatmullClark;
pub use doo_sabin::DooSabin;
pub use loop_rules::{Loop, vertex_point};

use super::arithmetic::Arithmetic;
use super::nets::{Against, Net};
use super::shape::Shape;
use super::value::Numbers;
use super::word::{Word, tile};
use crate::scheme::{IntegerRow, LoopWeights, Scheme, Tile};

/// What constants are relative to: the largest of some differences of the local net.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Norm {
    /// Second differences: HW (1) for Loop, CY's second-order norm for Catmull-Clark.
    Second,
    /// First differences round the corners of the face: CY (17), (18).
    First,
    /// Doo-Sabin: second differences along the lines through vertices of valence 4, and the diameter
    /// of the extraordinary face.
    Face,
}

impl Norm {
    /// The name in claims and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Norm::Second => "second",
            Norm::First => "first",
            Norm::Face => "face",
        }
    }
}

impl fmt::Display for Norm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Norm {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let all = [Norm::Second, Norm::First, Norm::Face];
        let found = all.into_iter().find(|norm| norm.name() == text);
        found.ok_or_else(|| format!("no norm is called {text:?}: write second, first or face"))
    }
}

/// A scheme and a norm: what a constant of a valence belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Family {
    /// Loop's scheme; mixed second differences.
    Loop(LoopWeights),
    /// Catmull-Clark; [`Norm::Second`] or [`Norm::First`].
    CatmullClark(Norm),
    /// Doo-Sabin; [`Norm::Face`].
    DooSabin,
}

impl From<LoopWeights> for Family {
    fn from(weights: LoopWeights) -> Self {
        Family::Loop(weights)
    }
}

impl Family {
    /// The scheme.
    pub fn scheme(self) -> Scheme {
        match self {
            Family::Loop(weights) => Scheme::Loop(weights),
            Family::CatmullClark(_) => Scheme::CatmullClark,
            Family::DooSabin => Scheme::DooSabin,
        }
    }

    /// The norm.
    pub fn norm(self) -> Norm {
        match self {
            Family::Loop(_) => Norm::Second,
            Family::CatmullClark(norm) => norm,
            Family::DooSabin => Norm::Face,
        }
    }

    /// The family of a scheme with a norm; `None` if and only if the scheme has no such norm.
    pub fn new(scheme: Scheme, norm: Norm) -> Option<Self> {
        match (scheme, norm) {
            (Scheme::Loop(weights), Norm::Second) => Some(Family::Loop(weights)),
            (Scheme::CatmullClark, Norm::Second | Norm::First) => Some(Family::CatmullClark(norm)),
            (Scheme::DooSabin, Norm::Face) => Some(Family::DooSabin),
            _ => None,
        }
    }

    /// The norm that is meant if none is named.
    pub fn default_norm(scheme: Scheme) -> Norm {
        match scheme {
            Scheme::Loop(_) | Scheme::CatmullClark => Norm::Second,
            Scheme::DooSabin => Norm::Face,
        }
    }

    /// The numbers that occur at a valence.
    pub fn numbers(self, n: u32) -> Numbers {
        match self {
            Family::Loop(weights) => Numbers::of_loop(weights, n),
            Family::CatmullClark(_) => Numbers::rationals(n),
            Family::DooSabin => Numbers::cosines(n),
        }
    }

    /// The rules at a valence.
    pub fn rules<A: Arithmetic>(self, n: u32) -> Box<dyn Rules<A>> {
        match self {
            Family::Loop(_) => Box::new(Loop { n }),
            Family::CatmullClark(norm) => Box::new(CatmullClark { n, norm }),
            Family::DooSabin => Box::new(DooSabin { n }),
        }
    }
}

/// How the nets of a scheme are laid out.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// The domain of patches.
    pub shape: Shape,
    /// The word that is the face: the whole of the net's domain, or its quarter 0. F_0 is affine or
    /// bilinear on it.
    pub root: Word,
    /// The number of points of the first net.
    pub size: usize,
    /// The valence.
    pub valence: u32,
    /// The valence at which local nets are regular.
    pub regular: u32,
    /// The label in a local net of regular valence of each point of a regular net.
    pub labels: &'static [usize],
    /// The labels, among the level-1 points of a local net of a valence, of a tile's regular net.
    pub tile_labels: fn(u32, Tile) -> Vec<usize>,
}

/// The rules of a scheme at a valence, for nets of functionals in an arithmetic.
pub trait Rules<A: Arithmetic>: fmt::Debug + Send + Sync {
    /// The layout of nets.
    fn layout(&self) -> Layout;

    /// The differences of a local net of a valence, whose largest is M.
    fn differences(&self, valence: u32) -> Vec<IntegerRow>;

    /// All level-1 points that a local net determines; `extraordinary` says whether its corner has the
    /// scheme's own weights or those of the regular valence, which may be the same number.
    fn refine(
        &self,
        arithmetic: &A,
        extraordinary: bool,
        valence: u32,
        local: &[A::V],
    ) -> Vec<A::V>;

    /// A net as a local net, with its valence.
    fn local(&self, net: &Net<A::V>) -> (u32, Vec<A::V>) {
        match net {
            Net::Extraordinary(points) => (self.layout().valence, points.clone()),
            Net::Regular(points) => {
                let mut local = points.clone();
                let layout = self.layout();
                for (point, label) in points.iter().zip(layout.labels) {
                    local[label - 1] = point.clone();
                }
                (layout.regular, local)
            }
        }
    }

    /// The net of a letter, from the level-1 points of its parent.
    fn child(&self, parent: &Net<A::V>, letter: u8, refined: &[A::V]) -> Net<A::V> {
        let layout = self.layout();
        let pick = |labels: &[usize]| labels.iter().map(|l| refined[l - 1].clone()).collect();
        match (tile(letter), parent) {
            (Some(tile), Net::Extraordinary(_)) => {
                Net::Regular(pick(&(layout.tile_labels)(layout.valence, tile)))
            }
            (Some(tile), Net::Regular(_)) => {
                Net::Regular(pick(&(layout.tile_labels)(layout.regular, tile)))
            }
            (None, Net::Extraordinary(points)) => {
                Net::Extraordinary(refined[..points.len()].to_vec())
            }
            (None, Net::Regular(_)) => Net::Regular(pick(layout.labels)),
        }
    }

    /// The regular net behind a net: itself, or the extraordinary net where the valence is regular.
    fn regular(&self, net: &Net<A::V>) -> Option<Vec<A::V>> {
        let layout = self.layout();
        match net {
            Net::Regular(points) => Some(points.clone()),
            Net::Extraordinary(points) if layout.valence == layout.regular => {
                let labels = layout.labels.iter();
                Some(labels.map(|l| points[l - 1].clone()).collect())
            }
            Net::Extraordinary(_) => None,
        }
    }

    /// The Bernstein coefficients of S over a regular net.
    fn surface(&self, points: &[A::V]) -> Vec<A::V>;

    /// The factor times S at the extraordinary corner of an extraordinary net.
    fn limit(&self, arithmetic: &A, net: &[A::V]) -> A::V;

    /// The factor times the corner values of F_0 of a net on its own domain, or on the quarter `letter`
    /// of it where the root has a letter.
    fn mesh(&self, arithmetic: &A, net: &Net<A::V>, letter: u8, against: Against) -> Vec<A::V>;

    /// The factor times a functional.
    fn scale(&self, arithmetic: &A, functional: &A::V) -> A::V;

    /// Bits that exact numerators of a word take, at most, with those of its targets and their common
    /// denominators.
    fn bits(&self, word: Word) -> u32;

    /// Bits of the entries of inverses of bases, as a rule.
    fn inverse_bits(&self) -> u32;

    /// `|S - F_d| <= factor 4^-d M` over regular nets with differences at most M; `None` if there is
    /// no such rule for the norm.
    fn regular_factor(&self, against: Against) -> Option<(i64, i64)>;
}

/// Bits of a number.
fn log2(k: u64) -> u32 {
    u64::BITS - k.leading_zeros()
}
