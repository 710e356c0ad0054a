//! C_k and B_k: a value that is attained, and a cover of the face that proves it, or a little more.

use std::cmp::Ordering;

use num_traits::Zero;

use super::constant::{At, Conclusion, Constant, Lemma, Proof};
use super::nets::Against;
use super::part::rationals_near;
use super::prover::{Bound, Failure, Prover, Target};
use super::search::Witness;
use super::tail::{Tail, TailKind};
use super::value::Value;
use super::word::LONGEST_WORD;
use crate::scalar::Rational;

/// Gaps above this are not worth a try for the exact value.
const COARSE_GAP: f64 = 1e-3;

/// Numbers of steps of a tail beyond k. Many are needed where the largest distance is at the
/// extraordinary corner itself: the excess of the tail over it falls like the second eigenvalue of
/// frequency 0 (1/2 at Catmull-Clark's N = 11) with each step.
const STEPS: [usize; 16] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 12, 15, 18, 21, 25];

/// How often the upper bound is raised, by twice as much each time.
const MOST_FAILURES: i32 = 24;

impl Prover {
    pub(super) fn distance(&mut self, against: Against, k: usize, gap: f64) -> Option<Proof> {
        let main = self.main_lemma()?;
        let mut best = self.search(against, k)?;
        let mut try_exact = gap <= COARSE_GAP;
        let mut failures = 0;
        while failures < MOST_FAILURES {
            let (lower, at, simple) = self.lower(against, k, &best);
            let lo = self.numbers.enclose(&lower);
            try_exact &= simple;
            // The value itself, if it has a chance; else above it by half the gap, later by more.
            let bound = if try_exact {
                self.bound(lower.clone())
            } else {
                let raise = gap * 0.5 * 2f64.powi(failures);
                self.rational_bound(&Rational::from_float(lo.sup() * (1.0 + raise))?)
            };
            let (lemma, conclusion) = match self.cover(against, k, &main, &bound) {
                Ok(found) => found,
                // The proof met a larger value: start again from there.
                Err(Failure::Attained(met)) if met.value > best.value * (1.0 + 1e-9) => {
                    best = self.climb(met, Target::Distance(against, k))?;
                    continue;
                }
                Err(_) => {
                    failures += i32::from(!try_exact);
                    try_exact = false;
                    continue;
                }
            };
            return Some(Proof {
                constant: Constant::Distance(against, k),
                lo: lo.inf(),
                hi: self.numbers.enclose(&bound.value).sup(),
                exact: try_exact.then_some(lower),
                net: best.net,
                at,
                lemma: Some(lemma),
                conclusion,
            });
        }
        None
    }

    /// A cover of the face by rings and a tail; for C_0 the lemma alone, if it reaches that far.
    fn cover(
        &mut self,
        against: Against,
        k: usize,
        main: &Lemma,
        bound: &Bound,
    ) -> Result<(Lemma, Conclusion), Failure> {
        let control = against == Against::Control;
        if control
            && k == 0
            && main.depth == 0
            && self.numbers.at_most(&main.bound.value, &bound.value)
        {
            return Ok((main.clone(), Conclusion::Apply));
        }
        match self.cover_by(against, k, main, bound) {
            Ok(conclusion) => return Ok((main.clone(), conclusion)),
            Err(Failure::Attained(met)) => return Err(Failure::Attained(met)),
            Err(Failure::Unproved) => (),
        }
        // The largest distance may lie at the extraordinary corner itself: there C_0 is too coarse,
        // and the distance near the corner is the vertex displacement.
        let Some(local) = self.vertex_displacement() else {
            return Err(Failure::Unproved);
        };
        let local = self.bound(local);
        let smaller = self.numbers.compare(&local.value, &main.bound.value) == Some(Ordering::Less);
        if !(control && k > 0 && smaller) {
            return Err(Failure::Unproved);
        }
        let lemma = (1..=6).find_map(|depth| self.lemma(depth, &local));
        let lemma = lemma.ok_or(Failure::Unproved)?;
        let conclusion = self.cover_by(against, k, &lemma, bound)?;
        Ok((lemma, conclusion))
    }

    /// A cover whose tail rests on a lemma, with as few steps as the tail allows.
    fn cover_by(
        &mut self,
        against: Against,
        k: usize,
        lemma: &Lemma,
        bound: &Bound,
    ) -> Result<Conclusion, Failure> {
        let room = LONGEST_WORD - 1 - self.root().len() - lemma.depth;
        for steps in STEPS.map(|more| k + more).into_iter().filter(|&k| k < room) {
            let tail = Tail {
                kind: TailKind::Distance(against, k),
                steps,
                depth: lemma.depth,
                bound: lemma.bound.clone(),
            };
            if let Some(tail) = self.prove_tail(&tail, bound) {
                let target = Target::Distance(against, k);
                let cells = self.prove_rings(target, 0, steps + lemma.depth, bound)?;
                return Ok(Conclusion::Cover { steps, cells, tail });
            }
        }
        Err(Failure::Unproved)
    }

    /// The exact value of a witness and where it is attained, at the simplest parameters near; and
    /// whether these are simple.
    pub(super) fn lower(
        &mut self,
        against: Against,
        k: usize,
        best: &Witness,
    ) -> (Value, At, bool) {
        if best.word.is_extraordinary() {
            let value = self.corner_value(against, k, best.net);
            let value = self.absolute(value);
            let at = At::Point(best.word, Rational::zero(), Rational::zero());
            return (value, at, true);
        }
        let target = Target::Distance(against, k);
        let (shape, patch) = (self.shape(), self.values_at(best.word, target, best.net));
        let [vs, ws] = best.at.map(rationals_near);
        let simple = |x: &Rational| *x.denom() <= 64.into();
        let mut found: Option<(Value, At, bool)> = None;
        for (v, w) in vs.into_iter().zip(ws) {
            if !shape.contains([&v, &w]) {
                continue;
            }
            let (value, _) = shape.evaluate(&patch, [&v, &w]);
            let value = self.absolute(value);
            let better = found.as_ref().is_none_or(|(known, ..)| {
                // The simple point wins ties.
                self.numbers.enclose(&value).inf()
                    > self.numbers.enclose(known).sup() * (1.0 + 1e-14)
            });
            if better {
                let is_simple = simple(&v) && simple(&w);
                found = Some((value, At::Point(best.word, v, w), is_simple));
            }
        }
        found.unwrap_or_else(|| {
            let at = At::Point(best.word, Rational::zero(), Rational::zero());
            (Value::zero(), at, false)
        })
    }
}
