//! The upper side near the extraordinary corner, where S never becomes one polynomial.

use super::cell;
use super::functional::Integer;
use super::nets::{Against, Exact, Nets, Space};
use super::prover::{Bound, Candidate, Prover, SLACK};
use super::value::RingWeight;
use super::word::Word;
use crate::scalar::{Rational, ShortRational};

/// Bases for the functionals of a tail: `[corner][sign][l]`.
pub type TailProof = Vec<[Vec<usize>; 2]>;

/// A tail: what is left of a face near its extraordinary corner, closed by a bound D of ‖S - F_0‖ over
/// the words `0^depth`.
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
    /// `F_K - F_k` at the corners of `0^(K+J)`, F_K the control triangle.
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
        let word = Word::zeros(tail.level() + tail.depth);
        let exact = if self.fits_times(word, tail.bits(self.valence())) {
            tail.holds(
                &mut self.words,
                &self.weight,
                &self.candidates,
                &proof,
                bound,
            )
        } else {
            tail.holds(&mut self.big, &self.weight, &self.candidates, &proof, bound)
        };
        exact.then_some(proof)
    }
}

impl Tail {
    fn level(&self) -> usize {
        self.steps
    }

    /// Bits that a product with D takes, D a polynomial of degree 1 in b as a rule.
    fn bits(&self, n: u32) -> u32 {
        let bits = |c: &Rational| (c.numer().bits() + c.denom().bits()) as u32;
        let coefficients = self.bound.value.coefficients();
        let largest = coefficients.iter().map(bits).max().unwrap_or(0);
        largest + (coefficients.len() as u32) * (u32::BITS - n.leading_zeros())
    }

    /// The functionals without D (times the factor of the space), by corner, and the differences
    /// (without the factor).
    fn functionals<A: Space>(&self, nets: &mut Nets<A>) -> (Vec<A::V>, Vec<A::V>) {
        let k = self.steps;
        let [z0, z1] = nets.leading_points(k);
        let differences = nets.differences(Word::zeros(k));
        let side = 1i64 << self.depth;
        let part = |p: i64, q: i64| <A::S as crate::scalar::Field>::ratio(p, q);
        match self.kind {
            TailKind::Distance(against, level) => {
                let [f0, f1, _] = nets.mesh_at_corners(Word::zeros(k + self.depth), against, level);
                let edge = z0.clone() * &part(side - 1, side) + &(z1 * &part(1, side));
                (vec![z0 - &f0, edge - &f1], differences)
            }
            TailKind::Linear => {
                let scale = 1i64 << k;
                let [y0, y1] = nets.leading_points(0);
                let t0 = nets.corner_target(Against::Control, 0);
                // 2^K (L_1 - (1 - 2^-K) t_0), L_1 = (1-h) z_1 + h z_2 - (1 - h 2^-K) y_1 - h 2^-K y_2.
                let edge = z0 * &part(side - 1, side) + &(z1 * &part(1, side));
                let chord = y0 * &part(side * scale - 1, side) + &(y1 * &part(1, side));
                let base = edge * &part(scale, 1) - &chord - &(t0 * &part(scale - 1, 1));
                let scaled = |d: A::V| d * &part(scale, 1);
                (vec![base], differences.into_iter().map(scaled).collect())
            }
        }
    }

    /// Whether every weight is at most the bound; exact.
    fn holds<T: Integer>(
        &self,
        nets: &mut Nets<Exact<T>>,
        weight: &RingWeight,
        candidates: &[Candidate],
        proof: &TailProof,
        bound: &Bound,
    ) -> bool {
        let (bases, differences) = self.functionals(nets);
        let short = |c: &Rational| -> Option<ShortRational> {
            let (p, q) = (
                i64::try_from(c.numer()).ok()?,
                i64::try_from(c.denom()).ok()?,
            );
            Some(ShortRational::new_raw(p, q))
        };
        // D = p(b) / q: p times a difference is q times D times it.
        let polynomial: Option<Vec<ShortRational>> =
            self.bound.value.coefficients().iter().map(short).collect();
        let Some(polynomial) = polynomial else {
            return false;
        };
        let scaled: Vec<_> = (differences.iter())
            .map(|d| d.times_polynomial(&polynomial))
            .collect();
        proof.iter().zip(&bases).all(|(signs, base)| {
            scaled.iter().enumerate().all(|(l, difference)| {
                let plus = base.clone() + difference;
                let minus = base.clone() - difference;
                [plus, minus].iter().zip(signs).all(|(t, list)| {
                    let basis = &candidates[list[l]].basis;
                    let value = cell::exact_weight(weight, t, basis);
                    value.is_some_and(|value| weight.at_most(&value, &bound.value))
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
