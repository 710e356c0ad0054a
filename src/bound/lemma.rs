//! Bounds of S - F_0 at the extraordinary corner that carry themselves from ring to ring.

use num_traits::Zero;

use super::constant::Lemma;
use super::nets::Against;
use super::prover::{Bound, Prover, Target};
use super::rules::Family;
use super::tail::{Tail, TailKind};
use super::value::Value;
use super::word::Word;
use crate::scalar::{Field, Rational};

impl Prover {
    /// The largest displacement of the extraordinary vertex to its limit, with M = 1: `8 n b / q` for
    /// Loop.
    pub fn vertex_displacement(&mut self) -> Option<Value> {
        if let Family::Loop(_) = self.family {
            let eight_n = <Rational as Field>::ratio(8 * i64::from(self.valence()), 1);
            return Some(Value::new(vec![Rational::zero(), eight_n]));
        }
        let corner = self.floats.corner_target(Against::Control, 0);
        let (corner, _) = self.propose(&corner, None)?;
        self.corner_weight(corner)
    }

    /// The exact weight of S - F_0 at the extraordinary corner in a candidate's basis.
    fn corner_weight(&mut self, candidate: usize) -> Option<Value> {
        self.weight_of(
            Word::EMPTY,
            candidate,
            |nets| nets.corner_target(Against::Control, 0),
            |nets| nets.corner_target(Against::Control, 0),
        )
    }

    /// A value that C_0 has: `max(1/2, 8 n b / q)` for Loop, else the best that a search finds.
    fn expected_distance(&mut self) -> Option<Value> {
        if let Family::Loop(_) = self.family {
            let half = self.numbers.constant(&Rational::ratio(1, 2));
            let vertex = self.vertex_displacement()?;
            let smaller = self.numbers.at_most(&vertex, &half);
            return Some(if smaller { half } else { vertex });
        }
        let best = self.search(Against::Control, 0)?;
        let (value, ..) = self.lower(Against::Control, 0, &best);
        match self.numbers.rational(&value) {
            Some(_) => Some(value),
            // Bounds in certificates are rational but for Loop.
            None => {
                let above = Rational::from_float(self.numbers.enclose(&value).sup())?;
                Some(self.numbers.constant(&above))
            }
        }
    }

    /// The bound C_0, proved, over the face or a part of it at the corner; or a larger one where that
    /// fails.
    pub fn main_lemma(&mut self) -> Option<Lemma> {
        if self.main_lemma.is_none() {
            self.main_lemma = self.prove_main_lemma();
        }
        self.main_lemma.clone()
    }

    pub(super) fn prove_main_lemma(&mut self) -> Option<Lemma> {
        let sharp = self.expected_distance()?;
        let mut bounds = vec![sharp.clone()];
        for (p, q) in [(1, 1000), (1, 50), (1, 4), (1, 1), (4, 1)] {
            bounds.push(sharp.clone() * &(Rational::ratio(1, 1) + Rational::ratio(p, q)));
        }
        bounds.into_iter().find_map(|value| {
            let bound = self.bound(value);
            let constant = self.lemma(0, &bound);
            constant.or_else(|| (1..=5).find_map(|depth| self.linear_lemma(depth, &bound)))
        })
    }

    /// Order 0: the bound over `0^depth`.
    pub(super) fn lemma(&mut self, depth: usize, bound: &Bound) -> Option<Lemma> {
        for steps in 1..=8 {
            let tail = Tail {
                kind: TailKind::Distance(Against::Control, 0),
                steps,
                depth,
                bound: bound.clone(),
            };
            let Some(tail) = self.prove_tail(&tail, bound) else {
                continue;
            };
            let target = Target::Distance(Against::Control, 0);
            let cells = self.prove_rings(target, depth, steps, bound).ok()?;
            return Some(Lemma {
                depth,
                steps,
                order: 0,
                bound: bound.clone(),
                corner: None,
                cells,
                tail,
            });
        }
        None
    }

    /// Order 1, over `0^depth`.
    pub(super) fn linear_lemma(&mut self, depth: usize, bound: &Bound) -> Option<Lemma> {
        let corner = self.floats.corner_target(Against::Control, 0);
        let (corner, _) = self.propose(&corner, None)?;
        let at_corner = self.corner_weight(corner)?;
        if !self.numbers.at_most(&at_corner, &bound.value) {
            return None;
        }
        for steps in 1..=8 {
            let tail = Tail {
                kind: TailKind::Linear,
                steps,
                depth,
                bound: bound.clone(),
            };
            let Some(tail) = self.prove_tail(&tail, bound) else {
                continue;
            };
            let cells = self
                .prove_rings(Target::Linear(depth), depth, steps, bound)
                .ok()?;
            return Some(Lemma {
                depth,
                steps,
                order: 1,
                bound: bound.clone(),
                corner: Some(corner),
                cells,
                tail,
            });
        }
        None
    }
}
