//! The upper side over parts where S is one polynomial: bases, reasons, quartering.

use num_bigint::BigInt;
use num_traits::Zero;

use super::cell::{self, By};
use super::functional::FloatFunctional;
use super::maximum;
use super::prover::{Bound, Failure, Prover, SLACK, Target};
use super::search::Witness;
use super::shape::Shape;
use super::word::{LONGEST_WORD, Word};
use crate::scalar::{Interval, Rational};

/// One part, the basis its multipliers are in, and why the bound holds.
#[derive(Clone, Debug)]
pub struct CellProof {
    /// The part.
    pub word: Word,
    /// Indices of candidates: one for all coefficients, or one for each.
    pub bases: Vec<usize>,
    /// The reason.
    pub by: By,
}

/// Parts smaller than this many levels below their tile are given up.
const DEEPEST: usize = 12;

/// Bits of the denominators of parameters in proofs.
const PARAMETER_BITS: i32 = 30;

/// One basis for each coefficient is tried where c with one basis is at most so many times the bound.
const NEAR: f64 = 1.25;

/// How many of the latest bases are tried before a new one is made.
const RECENT: usize = 8;

impl Prover {
    /// Proves the bound over every part of the root's `0^depth` but `0^(depth + steps)`, up to mirroring.
    pub(super) fn prove_rings(
        &mut self,
        target: Target,
        depth: usize,
        steps: usize,
        bound: &Bound,
    ) -> Result<Vec<CellProof>, Failure> {
        let mut cells = Vec::new();
        let start = self.root().len() + depth;
        for ring in start..start + steps {
            for letter in [1, 2] {
                let word = Word::zeros(ring).child(letter);
                self.prove_part(word, target, bound, None, &mut cells)?;
            }
        }
        Ok(cells)
    }

    pub(super) fn prove_part(
        &mut self,
        word: Word,
        target: Target,
        bound: &Bound,
        hint: Option<usize>,
        cells: &mut Vec<CellProof>,
    ) -> Result<(), Failure> {
        let level = self.root().len()
            + match target {
                Target::Distance(_, k) => k,
                Target::Linear(_) => 0,
            };
        let mut hint = hint;
        if word.len() < level {
            if self.close_regular(word, target, bound, cells)? {
                return Ok(());
            }
        } else {
            let (accepted, best) = self.prove_cell(word, target, bound, hint, cells)?;
            if accepted {
                return Ok(());
            }
            hint = best;
        }
        let tile = word.leading_zeros() + 1;
        if word.len() >= tile.max(level) + DEEPEST || word.len() + 1 >= LONGEST_WORD {
            return Err(Failure::Unproved);
        }
        let symmetric = word.mirror() == word;
        for letter in 0..4 {
            if !(symmetric && letter == 3) {
                self.prove_part(word.child(letter), target, bound, hint, cells)?;
            }
        }
        Ok(())
    }

    /// The value in the middle of a part.
    fn middle(&self, t: &[FloatFunctional]) -> FloatFunctional {
        let weights = self.shape().basis(self.shape().middle());
        let terms = t.iter().zip(weights);
        terms.fold(FloatFunctional::zero(), |sum, (t, w)| sum.plus(w, t))
    }

    fn float_weights(&self, t: &[FloatFunctional], basis: usize) -> Vec<f64> {
        t.iter().map(|t| self.float_weight(t, basis)).collect()
    }

    /// Tries to close a part above level k by its second differences.
    pub(super) fn close_regular(
        &mut self,
        word: Word,
        target: Target,
        bound: &Bound,
        cells: &mut Vec<CellProof>,
    ) -> Result<bool, Failure> {
        let Target::Distance(against, level) = target else {
            return Ok(false);
        };
        let finer = level - word.len();
        let Some((p, q)) = self.floats.rules().regular_factor(against) else {
            return Ok(false);
        };
        let factor = Rational::new(BigInt::from(p), BigInt::from(q) << (2 * finer));
        let float = Interval::from_rational(&factor).mid();
        let limit = bound.float * (1.0 + SLACK);
        let mut bases: Vec<usize> = Vec::with_capacity(15);
        for t in self.floats.differences(word) {
            let fits = |&&b: &&usize| self.float_weight(&t, b) * float <= limit;
            let known = bases.iter().rev().find(fits).copied();
            let index = match known {
                Some(index) => index,
                None => {
                    let hint = bases.last().copied();
                    let (index, value) = self.propose(&t, hint).ok_or(Failure::Unproved)?;
                    if value * float > limit {
                        return Ok(false);
                    }
                    index
                }
            };
            bases.push(index);
        }
        for (l, &index) in bases.iter().enumerate() {
            let Some(value) = self.difference_weight(word, l, index) else {
                return Ok(false);
            };
            if !self.numbers.at_most(&(value * &factor), &bound.value) {
                return Ok(false);
            }
        }
        cells.push(CellProof {
            word,
            bases,
            by: By::Regular,
        });
        Ok(true)
    }

    /// Tries to close one part; whether it did, and a basis to go on from.
    pub(super) fn prove_cell(
        &mut self,
        word: Word,
        target: Target,
        bound: &Bound,
        hint: Option<usize>,
        cells: &mut Vec<CellProof>,
    ) -> Result<(bool, Option<usize>), Failure> {
        let limit = bound.float * (1.0 + SLACK);
        let t = self.float_target(word, target);
        let mut recent: Vec<usize> = Vec::with_capacity(RECENT);
        for cell in cells.iter().rev() {
            let [basis] = cell.bases[..] else { continue };
            if recent.len() < RECENT && !recent.contains(&basis) {
                recent.push(basis);
            }
        }
        for basis in recent {
            let below = |t: &FloatFunctional| self.float_weight(t, basis) <= limit;
            if t.iter().all(below) {
                let c = self.float_weights(&t, basis);
                if self.close_by(word, target, &c, &[basis], bound, cells) {
                    return Ok((true, hint));
                }
            }
        }
        let centre = self.middle(&t);
        let hint = hint.or(cells.last().map(|cell| cell.bases[0]));
        let (basis, value) = self.propose(&centre, hint).ok_or(Failure::Unproved)?;
        if value > limit {
            let at = self.shape().middle();
            return Err(attained(
                target,
                Witness {
                    value,
                    word,
                    at,
                    net: basis,
                },
            ));
        }
        let closed = self.close(word, target, &t, basis, bound, cells)?;
        Ok((closed, Some(basis)))
    }

    /// Tries the three reasons, with one basis for all coefficients, then with one for each.
    pub(super) fn close(
        &mut self,
        word: Word,
        target: Target,
        t: &[FloatFunctional],
        basis: usize,
        bound: &Bound,
        cells: &mut Vec<CellProof>,
    ) -> Result<bool, Failure> {
        let limit = bound.float * (1.0 + SLACK);
        let net = &self.candidate(basis).net;
        let values: Vec<f64> = t.iter().map(|t| t.at(net)).collect();
        // Is the basis' own net above the bound somewhere?
        let (value, at) = maximum::sample(self.shape(), &values);
        if value > limit {
            return Err(attained(
                target,
                Witness {
                    value,
                    word,
                    at,
                    net: basis,
                },
            ));
        }
        let c = self.float_weights(t, basis);
        if self.close_by(word, target, &c, &[basis], bound, cells) {
            return Ok(true);
        }
        if maximum::sample(self.shape(), &c).0 > bound.float * NEAR {
            return Ok(false);
        }
        // Where the optimum is degenerate, multipliers change their signs within the part: the best
        // basis of each coefficient gives the least c.
        let mut bases = Vec::with_capacity(t.len());
        let mut least = Vec::with_capacity(t.len());
        for t in t {
            let (index, _) = self.propose(t, Some(basis)).ok_or(Failure::Unproved)?;
            least.push(self.float_weight(t, index));
            bases.push(index);
        }
        Ok(self.close_by(word, target, &least, &bases, bound, cells))
    }

    /// Tries the three reasons for the polynomial c.
    pub(super) fn close_by(
        &mut self,
        word: Word,
        target: Target,
        c: &[f64],
        bases: &[usize],
        bound: &Bound,
        cells: &mut Vec<CellProof>,
    ) -> bool {
        let shape = self.shape();
        let reasons = reasons(shape, c, bound.float);
        let linear = matches!(target, Target::Linear(_));
        let reasons: Vec<By> = (reasons.into_iter())
            .filter(|by| !linear || *by == By::Hull)
            .collect();
        if reasons.is_empty() {
            return false;
        }
        let Some(weights) = self.exact_weights(word, target, bases) else {
            return false;
        };
        let by = (reasons.into_iter())
            .find(|by| cell::holds(&self.numbers, shape, &weights, by, &bound.value));
        let holds = by.is_some();
        cells.extend(by.map(|by| CellProof {
            word,
            bases: bases.to_vec(),
            by,
        }));
        holds
    }
}

/// What it means that a net exceeds the bound: for the linear target only that this proof fails.
fn attained(target: Target, witness: Witness) -> Failure {
    match target {
        Target::Distance(..) => Failure::Attained(witness),
        Target::Linear(_) => Failure::Unproved,
    }
}

/// The reasons why a polynomial could be below a bound, judged in `f64`, the simplest first.
pub(super) fn reasons(shape: Shape, c: &[f64], bound: f64) -> Vec<By> {
    let limit = bound * (1.0 + SLACK);
    if c.iter().all(|c| *c <= limit) {
        return vec![By::Hull];
    }
    let mut reasons = Vec::new();
    if maximum::sample(shape, c).0 > limit {
        return reasons;
    }
    let (value, [v, w]) = maximum::maximise(shape, c);
    if value > limit {
        return reasons;
    }
    for edge in 0..shape.edges() {
        let on = shape.edge(edge);
        let f: Vec<f64> = on.iter().map(|&i| c[i]).collect();
        let off_below = (0..c.len()).all(|i| on.contains(&i) || c[i] <= limit);
        if off_below && maximum::is_concave_edge(&f) {
            let (_, s) = maximum::maximise_edge(&f);
            reasons.extend(rationals_near(s).map(|s| By::Edge(edge, s)));
        }
    }
    if maximum::is_concave(shape, c) {
        let points = rationals_near(v).into_iter().zip(rationals_near(w));
        reasons.extend(points.map(|(v, w)| By::Concave(v, w)));
    }
    reasons
}

/// The simplest rational near x, if there is one with a small denominator, and a dyadic one.
pub(super) fn rationals_near(x: f64) -> [Rational; 2] {
    let scale = 2f64.powi(PARAMETER_BITS);
    let dyadic = Rational::new(
        BigInt::from((x * scale).round() as i64),
        BigInt::from(1u64 << PARAMETER_BITS),
    );
    let simple = (1i64..=64).find_map(|q| {
        let p = (x * q as f64).round();
        ((x * q as f64 - p).abs() < 1e-6).then(|| Rational::new((p as i64).into(), q.into()))
    });
    [simple.unwrap_or_else(|| dyadic.clone()), dyadic]
}
