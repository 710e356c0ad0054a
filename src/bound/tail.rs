//! The upper side near the extraordinary corner, where S never becomes one polynomial.

use super::arithmetic::{Arithmetic, Exact};
use super::cell;
use super::functional::Integer;
use super::nets::{Against, Nets};
use super::prover::{Bound, Candidate, Prover, SLACK};
use super::shape::Shape;
use super::value::Numbers;
use super::word::Word;
use crate::scalar::{Rational, Ring};

/// Bases for the functionals of a tail: `[corner][sign][l]`.
pub type TailProof = Vec<[Vec<usize>; 2]>;

/// A tail: what is left of a face near its extraordinary corner, closed by a bound D of ‖S - F_0‖ over
/// the root's `0^depth`.
#[derive(Clone, Debug)]
pub struct Tail {
    /// Whose distance.
    pub kind: TailKind,
    /// Number of steps K.
    pub steps: usize,
    /// The lemma's depth J.
    pub depth: usize,
    /// The lemma's bound D.
    pub bound: Bound,
}

/// The functionals of a tail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TailKind {
    /// `F_K - F_k` at the corners of the root's `0^(K+J)`, F_K the level-K control mesh.
    Distance(Against, usize),
    /// The rule of order 1.
    Linear,
}

impl Prover {
    /// Proves the bound for `base_c + s D (α_l ∘ A^level) scale`, s = 1, -1, all l, with exact bases.
    /// `tail` says which functionals these are.
    pub(super) fn prove_tail(&mut self, tail: &Tail, bound: &Bound) -> Option<TailProof> {
        let limit = bound.float * (1.0 + SLACK);
        let (bases, differences) = tail.functionals(&mut self.floats);
        let factor = tail.bound.float;
        let mut used: Vec<usize> = Vec::new();
        let mut proof = Vec::new();
        for base in &bases {
            let mut signs: [Vec<usize>; 2] = Default::default();
            for (sign, list) in [1.0, -1.0].into_iter().zip(&mut signs) {
                for difference in &differences {
                    let t = base.plus(sign * factor, difference);
                    let fits = |&&b: &&usize| self.float_weight(&t, b) <= limit;
                    let found = used.iter().rev().find(fits).copied();
                    let index = match found {
                        Some(index) => index,
                        None => {
                            let hint = used.last().copied();
                            let (index, value) = self.propose(&t, hint)?;
                            if value > limit {
                                return None;
                            }
                            used.push(index);
                            index
                        }
                    };
                    list.push(index);
                }
            }
            proof.push(signs);
        }
        let word = Word::zeros(self.root().len() + tail.steps + tail.depth);
        let exact = if self.fits_times(word, tail.bits(self.valence())) {
            tail.holds(
                &mut self.words,
                &self.numbers,
                &self.candidates,
                &proof,
                bound,
            )
        } else {
            tail.holds(
                &mut self.big,
                &self.numbers,
                &self.candidates,
                &proof,
                bound,
            )
        };
        exact.then_some(proof)
    }
}

impl Tail {
    /// Bits that a product with D takes, D a polynomial of degree 1 in b as a rule.
    fn bits(&self, n: u32) -> u32 {
        let bits = |c: &Rational| (c.numer().bits() + c.denom().bits()) as u32;
        let coefficients = self.bound.value.coefficients();
        let largest = coefficients.iter().map(bits).max().unwrap_or(0);
        largest + (coefficients.len() as u32) * (u32::BITS - n.leading_zeros())
    }

    /// The functionals without D (times the factor of the space), by corner, and the differences
    /// (without the factor).
    fn functionals<A: Arithmetic>(&self, nets: &mut Nets<A>) -> (Vec<A::V>, Vec<A::V>) {
        let (steps, shape) = (self.steps, nets.rules().layout().shape);
        let z = nets.root_corners(steps);
        let differences = nets.differences(Word::zeros(steps));
        // F_0 at the corner c of `0^depth`; the last corner is the mirror image of corner 1.
        let (side, scale) = (1i64 << self.depth, 1i64 << steps);
        let corners = &shape.corners()[..shape.corners().len() - 1];
        let at = |mesh: &[A::V], corner: [i64; 2], side| {
            shape.interpolate::<A::S, A::V>(mesh, corner, side)
        };
        match self.kind {
            TailKind::Distance(against, level) => {
                let word = Word::zeros(nets.rules().layout().root.len() + steps + self.depth);
                let f = nets.mesh_at_corners(word, against, level);
                let pairs = corners.iter().zip(&f);
                let bases = pairs.map(|(&corner, f)| at(&z, corner, side) - f);
                (bases.collect(), differences)
            }
            TailKind::Linear => {
                let y = nets.root_corners(0);
                let t0 = nets.corner_target(Against::Control, 0);
                let times = |v: A::V, k: i64| v * &A::S::from_integer(k);
                // L_c 2^K, L_c = F_0(corner)(A^K y) - F_0(2^-K corner)(y).
                let step = |corner: [i64; 2]| {
                    times(at(&z, corner, side) - &at(&y, corner, side * scale), scale)
                };
                let rest = times(t0, scale - 1);
                let bases = match shape {
                    Shape::Triangle => vec![step(corners[1]) - &rest],
                    Shape::Bicubic | Shape::Biquadratic => vec![
                        times(step(corners[1]), 2) - &step(corners[0]) - &rest,
                        step(corners[2]) - &rest,
                    ],
                };
                let scaled = differences.into_iter().map(|d| times(d, scale));
                (bases, scaled.collect())
            }
        }
    }

    /// Whether every weight is at most the bound; exact.
    fn holds<T: Integer>(
        &self,
        nets: &mut Nets<Exact<T>>,
        numbers: &Numbers,
        candidates: &[Candidate],
        proof: &TailProof,
        bound: &Bound,
    ) -> bool {
        let (bases, differences) = self.functionals(nets);
        // D = p / q: p times a difference is q times D times it.
        let scaled: Vec<_> = (differences.iter())
            .map(|d| d.times_polynomial(self.bound.value.coefficients()))
            .collect();
        proof.iter().zip(&bases).all(|(signs, base)| {
            scaled.iter().enumerate().all(|(l, difference)| {
                let plus = base.clone() + difference;
                let minus = base.clone() - difference;
                [plus, minus].iter().zip(signs).all(|(t, list)| {
                    let basis = &candidates[list[l]].basis;
                    let value = cell::exact_weight(numbers, t, basis);
                    value.is_some_and(|value| numbers.at_most(&value, &bound.value))
                })
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bound::prover::Target;
    use crate::scalar::Field;
    use crate::scheme::LoopWeights;

    /// C_0 = 1/2 at valence 8 with Warren's weights, and it is attained in the rings as well as in the
    /// tail. A bound below it by less than floats are asked to see must be rejected, exactly.
    #[test]
    fn what_floats_let_pass_is_decided_exactly() {
        let mut prover = Prover::new(LoopWeights::Warren, 8);
        let half = Rational::ratio(1, 2);
        let below = half.clone() - Rational::ratio(1, 1 << 45);
        for (bound, holds) in [(half, true), (below, false)] {
            let bound = prover.rational_bound(&bound);
            let tail = Tail {
                kind: TailKind::Distance(Against::Control, 0),
                steps: 1,
                depth: 0,
                bound: bound.clone(),
            };
            assert_eq!(prover.prove_tail(&tail, &bound).is_some(), holds);
            let target = Target::Distance(Against::Control, 0);
            assert_eq!(prover.prove_rings(target, 0, 1, &bound).is_ok(), holds);
        }
    }
}
