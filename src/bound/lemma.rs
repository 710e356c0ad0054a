//! Bounds of S - F_0 at the extraordinary corner that carry themselves from ring to ring.

use num_traits::Zero;

use super::constant::Lemma;
use super::nets::Against;
use super::prover::{Bound, Prover, Target};
use super::tail::{Tail, TailKind};
use super::value::Value;
use super::word::Word;
use crate::scalar::{Field, Rational};

impl Prover {
    /// `8 n b / q`: what the extraordinary vertex moves to its limit, with M = 1.
    pub fn vertex_displacement(&self) -> Value {
        let eight_n = <Rational as Field>::ratio(8 * i64::from(self.valence()), 1);
        Value::new(vec![Rational::zero(), eight_n])
    }

    /// The bound `C_0 = max(1/2, 8 n b / q)`, proved, over the face or a part of it at the corner; or
    /// a larger one where that fails.
    pub fn main_lemma(&mut self) -> Option<Lemma> {
        if self.main_lemma.is_none() {
            self.main_lemma = self.prove_main_lemma();
        }
        self.main_lemma.clone()
    }

    pub(super) fn prove_main_lemma(&mut self) -> Option<Lemma> {
        let half = Value::rational(self.valence(), &Rational::ratio(1, 2));
        let vertex = self.vertex_displacement();
        let sharp = if self.weight.at_most(&vertex, &half) {
            half
        } else {
            vertex
        };
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
        let at_corner = self.weight_of(
            Word::EMPTY,
            corner,
            |nets| nets.corner_target(Against::Control, 0),
            |nets| nets.corner_target(Against::Control, 0),
        )?;
        if !self.weight.at_most(&at_corner, &bound.value) {
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
