//! The constants, and what a proof of one consists of.

use super::nets::Against;
use super::part::CellProof;
use super::prover::{Bound, Prover};
use super::rate::words_of;
use super::rules::Family;
use super::tail::TailProof;
use super::value::Value;
use super::word::Word;
use crate::scalar::{Cyclotomic, Rational};

/// A constant of one valence.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Constant {
    /// C_k or B_k: sup over the face of ‖S - F_k‖.
    Distance(Against, usize),
    /// r_k: the largest ‖α_l‖ of the level-k extraordinary net.
    Rate(usize),
    /// The largest ‖α_l‖ over the nets of all 4^k parts of level k.
    MeshRate(usize),
    /// ‖t_i‖, t_i a Bernstein coefficient of S less the level-0 limit triangle over a word.
    Coefficient(Word, usize),
    /// HW's β: the maximum over all tiles of the quartics with the coefficients ‖t_i‖, whole tiles.
    Beta,
}

/// Where a lower bound is attained.
#[derive(Clone, Debug, PartialEq)]
pub enum At {
    /// Parameters in a part; (0, 0) in an extraordinary word.
    Point(Word, Rational, Rational),
    /// A second difference of a word's net, from 0.
    Difference(Word, usize),
    /// The coefficient that the claim names.
    Claimed,
    /// A point of a tile, a net for each of its coefficients.
    Tile {
        /// The tile.
        word: Word,
        /// The candidates whose nets they are.
        nets: Vec<usize>,
        /// First parameter.
        v: Rational,
        /// Second parameter.
        w: Rational,
    },
}

/// A bound of ‖S - F_0‖ near the extraordinary corner, on which tails rest.
#[derive(Clone, Debug)]
pub struct Lemma {
    /// It holds over the words `0^depth`.
    pub depth: usize,
    /// Steps of the induction.
    pub steps: usize,
    /// 0, or 1 for the linear rule.
    pub order: u8,
    /// The bound.
    pub bound: Bound,
    /// Order 1: the candidate whose basis bounds S - F_0 at the corner.
    pub corner: Option<usize>,
    /// The rings.
    pub cells: Vec<CellProof>,
    /// The tail.
    pub tail: TailProof,
}

/// How the upper side was concluded.
#[derive(Clone, Debug)]
pub enum Conclusion {
    /// The lemma itself.
    Apply,
    /// A cover of the face by parts and a tail that rests on the lemma.
    Cover {
        /// Steps K.
        steps: usize,
        /// The parts.
        cells: Vec<CellProof>,
        /// The tail.
        tail: TailProof,
    },
    /// For HW's β: whole tiles, the best bases of their coefficients, and a tail.
    Tiles {
        /// Steps K.
        steps: usize,
        /// The tiles.
        cells: Vec<CellProof>,
        /// The tail.
        tail: TailProof,
    },
    /// For each word, the candidates of its differences.
    Differences(Vec<(Word, Vec<usize>)>),
    /// The candidate of the coefficient.
    Weight(usize),
}

/// A two-sided enclosure with its proof.
#[derive(Clone, Debug)]
pub struct Proof {
    /// What is enclosed.
    pub constant: Constant,
    /// Lower bound.
    pub lo: f64,
    /// Upper bound.
    pub hi: f64,
    /// The constant itself, where both sides meet.
    pub exact: Option<Value>,
    /// The candidate whose net attains lo.
    pub net: usize,
    /// Where it does.
    pub at: At,
    /// The lemma used, if any.
    pub lemma: Option<Lemma>,
    /// The upper side.
    pub conclusion: Conclusion,
}

impl Proof {
    /// The relative gap (hi - lo) / hi, rounded upwards; 0 where an exact value was proved.
    pub fn gap(&self) -> f64 {
        if self.exact.is_some() || self.hi == self.lo {
            0.0
        } else {
            ((self.hi - self.lo) / self.hi).next_up()
        }
    }
}

impl Family {
    /// Whether a constant is defined for the family: all for Loop; distances and rates for Catmull-Clark;
    /// for Doo-Sabin distances to control meshes and rates, as the net of a face determines no limit mesh.
    pub fn knows(self, constant: Constant) -> bool {
        match (self, constant) {
            (Family::Loop(_), _) => true,
            (_, Constant::Coefficient(..) | Constant::Beta) => false,
            (Family::CatmullClark(_), _) => true,
            (Family::DooSabin, Constant::Distance(Against::Control, _) | Constant::Rate(_)) => true,
            (Family::DooSabin, Constant::Distance(Against::Limit, _) | Constant::MeshRate(_)) => {
                false
            }
        }
    }
}

impl Prover {
    /// Encloses a constant within the relative gap; `None` if no proof was found, or if the family has no
    /// such constant ([`Family::knows`]).
    pub fn prove(&mut self, constant: Constant, gap: f64) -> Option<Proof> {
        if !self.family.knows(constant) {
            return None;
        }
        match constant {
            Constant::Distance(against, k) => self.distance(against, k, gap),
            Constant::Rate(k) => self.rate(constant, vec![Word::zeros(k)]),
            Constant::MeshRate(k) => self.rate(constant, words_of(k)),
            Constant::Coefficient(word, index) => self.coefficient(word, index),
            Constant::Beta => self.beta(gap),
        }
    }

    /// The exact constant as an algebraic number, if it was found.
    pub fn closed_form(&self, proof: &Proof) -> Option<Cyclotomic> {
        proof
            .exact
            .as_ref()
            .map(|value| self.numbers.evaluate(value))
    }
}
