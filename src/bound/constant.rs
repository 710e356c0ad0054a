//! The constants: what is sought, where it is attained, and how far up it is proved.

use num_traits::Zero;

use super::nets::Against;
use super::prover::{
    Bound, CellProof, Failure, Prover, Tail, TailKind, TailProof, Target, Witness, rationals_near,
};
use super::quartic;
use super::value::Value;
use super::word::Word;
use crate::bernstein::Patch;
use crate::bernstein::triangle::QuarticTriangle;
use crate::scalar::{Cyclotomic, Field, Rational};

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

/// Gaps above this are not worth a try for the exact value.
const COARSE_GAP: f64 = 1e-3;

/// Words of a tile that the search follows to level k.
const BEAM: usize = 16;

/// Most steps of an induction or a tail.
const MOST_STEPS: usize = 12;

/// Most rounds of raising the upper bound.
const MOST_ROUNDS: usize = 40;

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

impl Prover {
    /// Encloses a constant within the relative gap; `None` if no proof was found.
    pub fn prove(&mut self, constant: Constant, gap: f64) -> Option<Proof> {
        match constant {
            Constant::Distance(against, k) => self.distance(against, k, gap),
            Constant::Rate(k) => self.rate(constant, vec![Word::zeros(k)]),
            Constant::MeshRate(k) => self.rate(constant, words_of(k)),
            Constant::Coefficient(word, index) => self.coefficient(word, index),
            Constant::Beta => self.beta(gap),
        }
    }

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

    fn prove_main_lemma(&mut self) -> Option<Lemma> {
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
    fn lemma(&mut self, depth: usize, bound: &Bound) -> Option<Lemma> {
        for steps in 1..=8 {
            let tail = Tail {
                kind: TailKind::Distance(Against::Control, 0),
                steps,
                depth,
                bound: bound.clone(),
            };
            let Ok(tail) = self.prove_tail(&tail, bound) else {
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
    fn linear_lemma(&mut self, depth: usize, bound: &Bound) -> Option<Lemma> {
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
            let Ok(tail) = self.prove_tail(&tail, bound) else {
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

    fn distance(&mut self, against: Against, k: usize, gap: f64) -> Option<Proof> {
        let global = self.main_lemma()?;
        let constant = Constant::Distance(against, k);
        let mut best = self.search(against, k)?;
        let mut try_exact = gap <= COARSE_GAP;
        for round in 0..MOST_ROUNDS {
            let (lower, at, simple) = self.lower(against, k, &best);
            try_exact &= simple;
            let lo = self.weight.enclose(&lower);
            if against == Against::Control
                && k == 0
                && global.depth == 0
                && self.weight.at_most(&global.bound.value, &lower)
            {
                let bound = global.bound.value.clone();
                return Some(self.finish(
                    constant,
                    Some(bound),
                    lo.inf(),
                    lo.sup(),
                    best.net,
                    at,
                    Some(global),
                    Conclusion::Apply,
                ));
            }
            // The first attempt: the value itself; then above it by half the gap, later by more.
            let bound = if try_exact {
                self.bound(lower.clone())
            } else {
                let raise = gap * 0.5 * 4f64.powi((round.saturating_sub(8) / 4) as i32);
                let hi = lo.sup() * (1.0 + raise.max(1e-13));
                self.rational_bound(&Rational::from_float(hi)?)
            };
            match self.cover(against, k, &global, &bound) {
                Ok((lemma, conclusion)) => {
                    let exact = try_exact.then(|| lower.clone());
                    let hi = self.weight.enclose(&bound.value).sup();
                    return Some(self.finish(
                        constant,
                        exact,
                        lo.inf(),
                        hi,
                        best.net,
                        at,
                        Some(lemma),
                        conclusion,
                    ));
                }
                Err(Failure::Exceeded(value)) if value > best.value * (1.0 + 1e-9) => {
                    let better = self.search(against, k)?;
                    if better.value > best.value * (1.0 + 1e-12) {
                        best = better;
                    } else if !try_exact {
                        // The search does not find what the proof met: raise the bound.
                        best.value = value;
                    } else {
                        try_exact = false;
                    }
                }
                Err(_) => try_exact = false,
            }
        }
        None
    }

    #[allow(clippy::too_many_arguments)]
    fn finish(
        &self,
        constant: Constant,
        exact: Option<Value>,
        lo: f64,
        hi: f64,
        net: usize,
        at: At,
        lemma: Option<Lemma>,
        conclusion: Conclusion,
    ) -> Proof {
        Proof {
            constant,
            lo,
            hi,
            exact,
            net,
            at,
            lemma,
            conclusion,
        }
    }

    /// A cover of the face by rings and a tail.
    fn cover(
        &mut self,
        against: Against,
        k: usize,
        global: &Lemma,
        bound: &Bound,
    ) -> Result<(Lemma, Conclusion), Failure> {
        let mut failure = Failure::TooFine;
        let mut attempt = |prover: &mut Self, lemma: &Lemma| {
            for steps in k..=k + MOST_STEPS {
                let tail = Tail {
                    kind: TailKind::Distance(against, k),
                    steps,
                    depth: lemma.depth,
                    bound: lemma.bound.clone(),
                };
                match prover.prove_tail(&tail, bound) {
                    Ok(tail) => {
                        let target = Target::Distance(against, k);
                        let cells = prover.prove_rings(target, 0, steps + lemma.depth, bound);
                        return cells.map(|cells| Conclusion::Cover { steps, cells, tail });
                    }
                    Err(Failure::Exceeded(_)) => failure = Failure::TooFine,
                    Err(other) => failure = other,
                }
            }
            Err(failure)
        };
        match attempt(self, global) {
            Ok(conclusion) => return Ok((global.clone(), conclusion)),
            Err(Failure::Exceeded(value)) => return Err(Failure::Exceeded(value)),
            Err(Failure::TooFine) => (),
        }
        // The largest distance may lie at the extraordinary corner itself: there C_0 is too coarse,
        // and the distance near the corner is the vertex displacement.
        if against == Against::Control && k > 0 {
            let local = self.bound(self.vertex_displacement());
            if self.weight.compare(&local.value, &global.bound.value)
                == Some(std::cmp::Ordering::Less)
            {
                for depth in 1..=6 {
                    if let Some(lemma) = self.lemma(depth, &local) {
                        return attempt(self, &lemma).map(|conclusion| (lemma, conclusion));
                    }
                }
            }
        }
        Err(failure)
    }

    /// The exact value of a witness and where it is attained; at the simplest parameters near.
    fn lower(&mut self, against: Against, k: usize, best: &Witness) -> (Value, At, bool) {
        if best.word.is_extraordinary() {
            let value = self.corner_value(against, k, best.net);
            let value = self.absolute(value);
            let at = At::Point(best.word, Rational::zero(), Rational::zero());
            return (value, at, true);
        }
        let target = Target::Distance(against, k);
        let patch = QuarticTriangle(self.values_at(best.word, target, best.net));
        let [vs, ws] = best.at.map(rationals_near);
        let simple = |x: &Rational| *x.denom() <= 64.into();
        let mut found: Option<(Value, At, bool)> = None;
        for (v, w) in vs.into_iter().zip(ws) {
            if &v + &w > Rational::ratio(1, 1) {
                continue;
            }
            let (value, _) = patch.evaluate([&v, &w]);
            let value = self.absolute(value);
            let better = found.as_ref().is_none_or(|(known, ..)| {
                // The simple point wins ties.
                self.weight.enclose(&value).inf() > self.weight.enclose(known).sup() * (1.0 + 1e-14)
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

    /// |value|, of a value whose sign is known.
    pub(super) fn absolute(&self, value: Value) -> Value {
        if self.weight.at_most(&value, &Value::zero()) {
            Value::zero() - &value
        } else {
            value
        }
    }

    /// A large value of |S - F_k| over all nets with M <= 1, in `f64`.
    fn search(&mut self, against: Against, k: usize) -> Option<Witness> {
        let mut best: Option<Witness> = None;
        let mut consider = |witness: Witness| {
            if best
                .as_ref()
                .is_none_or(|b| witness.value > b.value * (1.0 + 1e-12))
            {
                best = Some(witness);
            }
        };
        if against == Against::Control {
            let t = self.floats.corner_target(against, k);
            let (net, value) = self.propose(&t, None)?;
            consider(Witness {
                value,
                word: Word::zeros(k),
                at: [0.0, 0.0],
                net,
            });
        }
        let target = Target::Distance(against, k);
        let starts = [
            [0.33, 0.34],
            [0.03, 0.02],
            [0.95, 0.02],
            [0.02, 0.95],
            [0.48, 0.02],
            [0.02, 0.48],
            [0.49, 0.49],
        ];
        let mut hint = None;
        let mut found: Vec<Witness> = Vec::new();
        for ring in 0..k + 4 {
            let mut words = vec![Word::zeros(ring).child(1), Word::zeros(ring).child(2)];
            while words.first().is_some_and(|word| word.len() < k) {
                words = words
                    .iter()
                    .flat_map(|word| (0..4).map(|l| word.child(l)))
                    .collect();
                words.retain(|word| *word <= word.mirror());
                if words.len() > BEAM {
                    words = self.steepest(words, BEAM)?;
                }
            }
            for word in words {
                let t = self.float_target(word, target);
                for start in starts {
                    let (net, _) = self.propose(&at(&t, start), hint)?;
                    hint = Some(net);
                    let (value, at) = self.maximum(&t, net);
                    found.push(Witness {
                        value,
                        word,
                        at,
                        net,
                    });
                }
            }
        }
        found.sort_by(|a, b| b.value.total_cmp(&a.value));
        for witness in found.into_iter().take(12) {
            consider(self.climb(witness, target)?);
        }
        best
    }

    /// The words whose nets can have the largest second differences.
    fn steepest(&mut self, words: Vec<Word>, count: usize) -> Option<Vec<Word>> {
        let mut ranked = Vec::with_capacity(words.len());
        let mut hint = None;
        for word in words {
            let mut largest = 0f64;
            for t in self.floats.differences(word) {
                let (index, value) = self.propose(&t, hint)?;
                hint = Some(index);
                largest = largest.max(value);
            }
            ranked.push((largest, word));
        }
        // Ties stay in the order of words.
        ranked.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        Some(
            ranked
                .into_iter()
                .take(count)
                .map(|(_, word)| word)
                .collect(),
        )
    }

    /// The maximum of a net's own distance over a part, near the best grid point.
    fn maximum(&self, t: &[super::functional::FloatFunctional], net: usize) -> (f64, [f64; 2]) {
        let values: [f64; 15] = std::array::from_fn(|i| t[i].at(&self.candidate(net).net));
        let (value, at) = quartic::maximise(&values);
        let (other, there) = quartic::maximise(&values.map(|x| -x));
        if other > value {
            (other, there)
        } else {
            (value, at)
        }
    }

    /// Alternates between the best net at a point and the best point of a net.
    fn climb(&mut self, mut witness: Witness, target: Target) -> Option<Witness> {
        let t = self.float_target(witness.word, target);
        for _ in 0..20 {
            // A little inside: at borders and symmetry lines the best net is not unique.
            let inside = witness.at.map(|x| x * (1.0 - 1e-7) + 1e-8);
            let (net, _) = self.propose(&at(&t, inside), Some(witness.net))?;
            let (value, at) = self.maximum(&t, net);
            if value <= witness.value * (1.0 + 1e-13) {
                break;
            }
            witness = Witness {
                value,
                at,
                net,
                ..witness
            };
        }
        Some(witness)
    }

    fn rate(&mut self, constant: Constant, words: Vec<Word>) -> Option<Proof> {
        let mut best: Option<(Value, usize, At)> = None;
        let mut upper = Value::zero();
        let mut bases = Vec::new();
        for word in words {
            let floats = self.floats.differences(word);
            let mut list = Vec::new();
            let mut hint = None;
            for (l, t) in floats.iter().enumerate() {
                let (index, _) = self.propose(t, hint)?;
                hint = Some(index);
                list.push(index);
                let above = self.difference_weight(word, l, index)?;
                if !self.weight.at_most(&above, &upper) {
                    upper = above;
                }
                let below = self.difference_value(word, l, index);
                let below = self.absolute(below);
                if best
                    .as_ref()
                    .is_none_or(|(known, ..)| !self.weight.at_most(&below, known))
                {
                    best = Some((below, index, At::Difference(word, l)));
                }
            }
            bases.push((word, list));
        }
        let (lower, net, at) = best?;
        let (lo, hi) = (
            self.weight.enclose(&lower).inf(),
            self.weight.enclose(&upper).sup(),
        );
        let exact = self.weight.at_most(&upper, &lower).then_some(lower);
        Some(self.finish(
            constant,
            exact,
            lo,
            hi,
            net,
            at,
            None,
            Conclusion::Differences(bases),
        ))
    }

    fn coefficient(&mut self, word: Word, index: usize) -> Option<Proof> {
        let target = Target::Distance(Against::Limit, 0);
        let t = self.float_target(word, target);
        let (net, _) = self.propose(&t[index], None)?;
        let lower = self.values_at(word, target, net)[index].clone();
        let lower = self.absolute(lower);
        let upper = self.exact_weights(word, target, &[net])?[index].clone();
        let (lo, hi) = (
            self.weight.enclose(&lower).inf(),
            self.weight.enclose(&upper).sup(),
        );
        let exact = self.weight.at_most(&upper, &lower).then_some(lower);
        let constant = Constant::Coefficient(word, index);
        Some(self.finish(
            constant,
            exact,
            lo,
            hi,
            net,
            At::Claimed,
            None,
            Conclusion::Weight(net),
        ))
    }

    /// The exact constant as an algebraic number, if it was found.
    pub fn closed_form(&self, proof: &Proof) -> Option<Cyclotomic> {
        proof
            .exact
            .as_ref()
            .map(|value| self.weight.evaluate(value))
    }
}

/// The value of a quartic with functional coefficients at a point.
fn at(
    t: &[super::functional::FloatFunctional],
    point: [f64; 2],
) -> super::functional::FloatFunctional {
    let weights = quartic::basis(point);
    let terms = t.iter().zip(weights);
    let zero = super::functional::FloatFunctional::zero();
    terms.fold(zero, |sum, (t, w)| sum.plus(w, t))
}

/// All words of a level up to mirroring.
fn words_of(level: usize) -> Vec<Word> {
    let mut words = vec![Word::EMPTY];
    for _ in 0..level {
        words = words
            .iter()
            .flat_map(|word| (0..4).map(|l| word.child(l)))
            .collect();
    }
    words.retain(|word| *word <= word.mirror());
    words
}
