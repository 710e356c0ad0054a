//! What a scheme is to the checker: sizes, masks and differences of local nets, by label.
//!
//! A local net is the net of a word: of the claim's valence if the word has zeros only, else of the scheme's regular
//! valence. A mask is a linear combination of its points.

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::Zero;

use crate::patch::Patch;
use crate::rational::ratio;
use crate::scalar::Scalar;

/// Coefficients and labels.
pub type Mask = Vec<(Scalar, usize)>;

/// A difference: labels from 0, increasing, and coefficients that are not 0.
pub type Row = Vec<(usize, BigInt)>;

/// The vertices of a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Mesh {
    /// Control points.
    Control,
    /// Points of the surface.
    Limit,
}

/// A subdivision scheme with the weights, the norm and the valence of a claim.
pub trait Scheme {
    /// The valence of regular nets.
    fn regular(&self) -> usize;

    /// The number of points of a net of valence n.
    fn size(&self, n: usize) -> usize;

    /// The surface over a regular word.
    fn patch(&self) -> Patch;

    /// The number of letters of the root, the word of zeros that the claims are about.
    fn root(&self) -> usize {
        0
    }

    /// The points of the word with one letter more, in the order of the labels of its own net.
    fn child(&self, n: usize, letter: u8) -> Vec<Mask>;

    /// q times the Bernstein coefficients of S over a regular net.
    fn surface(&self) -> Vec<Mask>;

    /// q times S at corner 0.
    fn limit(&self, n: usize) -> Mask;

    /// q times F_0 at the corners of the word that this net's word begins and `rest`, of `root` letters, ends; none
    /// if the scheme has no such mesh.
    fn mesh(&self, mesh: Mesh, n: usize, rest: &[u8]) -> Option<Vec<Mask>>;

    /// The differences of the claim's norm, in order.
    fn differences(&self, n: usize) -> Vec<Row>;

    /// The labels of the points `p_1`, `p_2`, .. of a regular net.
    fn points(&self) -> Vec<usize>;

    /// The f of the rule `regular`: over a regular net with differences of at most 1, `|S - F_0| <= f`. None if the
    /// rule is not one for the norm.
    fn bend(&self, mesh: Mesh) -> Option<BigRational>;
}

/// `Σ c y_label`, coefficients at the same label added up.
pub fn row(terms: &[(usize, i64)]) -> Row {
    let mut sums = std::collections::BTreeMap::new();
    for &(label, c) in terms {
        *sums.entry(label - 1).or_insert_with(BigInt::zero) += c;
    }
    sums.into_iter().filter(|(_, c)| !c.is_zero()).collect()
}

/// A mask with rational coefficients p/q.
pub fn mask(terms: impl IntoIterator<Item = (i64, i64, usize)>) -> Mask {
    let term = |(p, q, label)| (Scalar::constant(&ratio(p, q)), label);
    terms.into_iter().map(term).collect()
}
