//! The prover of one valence: floats propose bases and points, exact arithmetic accepts them.

use std::collections::HashMap;

use ethnum::I256;
use num_bigint::BigInt;
use num_traits::Zero;

use super::cell::{self, By};
use super::constant::Lemma;
use super::functional::{ExactFunctional, FloatFunctional, Integer};
use super::nets::{Against, Exact, Floats, Nets, Space, bits_needed};
use super::quartic;
use super::value::{RingWeight, Value};
use super::word::{LONGEST_WORD, Word};
use crate::lp::{Basis, Rows};
use crate::scalar::{Interval, Rational, ShortRational};
use crate::scheme::{LoopWeights, loop_scheme};

/// What is bounded over a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// S - F_k.
    Distance(Against, usize),
    /// `(t - (1 - |u|) t_0) / |u|`, t = S - F_0 against the control mesh, |u| = 2^depth (v + w).
    Linear(usize),
}

/// A basis that was proposed, with what floats need of it.
#[derive(Clone, Debug)]
pub struct Candidate {
    /// The basis.
    pub basis: Basis,
    /// Its dual net times its determinant, in integers: `|α_l| <= 1` exactly.
    pub scaled_net: Vec<i64>,
    pub(super) net: Vec<f64>,
    columns: Vec<Vec<f64>>,
}

impl Candidate {
    /// The dual net.
    pub fn net_rationals(&self) -> Vec<Rational> {
        self.basis.net(&self.scaled_net)
    }
}

/// One part, the basis its multipliers are in, and why the bound holds.
#[derive(Clone, Debug)]
pub struct CellProof {
    /// The part.
    pub word: Word,
    /// Indices of candidates: one for all 15 coefficients, or one for each.
    pub bases: Vec<usize>,
    /// The reason.
    pub by: By,
}

/// Bases for the functionals of a tail: `[corner][sign][l]`.
pub type TailProof = Vec<[Vec<usize>; 2]>;

/// A bound to prove: the number and, for floats, its size.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The number.
    pub value: Value,
    pub(super) float: f64,
}

/// Why a bound was not proved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Failure {
    /// A proposal exceeds it: the constant seems to be at least this.
    Exceeded(f64),
    /// Parts became too small.
    TooFine,
}

/// A point where a large value was found.
#[derive(Clone, Debug)]
pub struct Witness {
    /// The value in `f64`.
    pub value: f64,
    /// The part.
    pub word: Word,
    /// Parameters in the part.
    pub at: [f64; 2],
    /// The candidate whose net attains it.
    pub net: usize,
}

/// Relative slack of float comparisons: what they reject wrongly costs a split, what they accept
/// wrongly is rejected exactly.
const SLACK: f64 = 1e-12;

/// Bits that factors of fixed-size integers may have.
const WORD_BITS: u32 = 190;

/// Parts smaller than this many levels below their tile are given up.
const DEEPEST: usize = 12;

/// Bits of the denominators of parameters in proofs.
const PARAMETER_BITS: i32 = 30;

/// One basis for each coefficient is tried where c with one basis is at most so many times the bound.
const NEAR: f64 = 1.25;

/// How many of the latest bases are tried before a new one is made.
const RECENT: usize = 8;

/// The prover of one valence and weights.
#[derive(Debug)]
pub struct Prover {
    /// The ring weight.
    pub weight: RingWeight,
    /// The second differences.
    pub rows: Rows,
    pub(super) floats: Nets<Floats>,
    words: Nets<Exact<I256>>,
    big: Nets<Exact<BigInt>>,
    candidates: Vec<Candidate>,
    known: HashMap<Vec<usize>, usize>,
    float_targets: HashMap<(Word, Target), std::rc::Rc<Vec<FloatFunctional>>>,
    pub(super) main_lemma: Option<Lemma>,
}

impl Prover {
    /// For Loop's scheme at valence n >= 3.
    pub fn new(weights: LoopWeights, n: u32) -> Self {
        let rows = Rows::new(
            loop_scheme::second_differences(n),
            loop_scheme::local_net_size(n),
        );
        Prover {
            weight: RingWeight::new(weights, n),
            rows,
            floats: Nets::new(Floats::new(weights, n)),
            words: Nets::new(Exact::new(n)),
            big: Nets::new(Exact::new(n)),
            candidates: Vec::new(),
            known: HashMap::new(),
            float_targets: HashMap::new(),
            main_lemma: None,
        }
    }

    /// The valence.
    pub fn valence(&self) -> u32 {
        self.weight.n
    }

    /// A candidate by its index.
    pub fn candidate(&self, index: usize) -> &Candidate {
        &self.candidates[index]
    }

    /// A rational as a bound.
    pub fn rational_bound(&self, r: &Rational) -> Bound {
        self.bound(Value::rational(self.valence(), r))
    }

    /// A value as a bound.
    pub fn bound(&self, value: Value) -> Bound {
        let float = self.weight.enclose(&value).mid();
        Bound { value, float }
    }

    /// The best basis for a float functional, and its value; starts from a known candidate.
    pub(super) fn propose(
        &mut self,
        t: &FloatFunctional,
        hint: Option<usize>,
    ) -> Option<(usize, f64)> {
        let from = match hint {
            Some(index) => &self.candidates[index].basis,
            None => self.rows.start(),
        };
        let (basis, scaled_net) = self.rows.propose(&t.0, from)?;
        let index = match self.known.get(&basis.rows()) {
            // The same rows with other signs of zeros: another net.
            Some(&known) if self.candidates[known].scaled_net == scaled_net => known,
            _ => {
                let determinant = basis.determinant() as f64;
                let float =
                    |column: &[i64]| column.iter().map(|&a| a as f64 / determinant).collect();
                let columns = basis
                    .row_columns()
                    .map(|(_, column)| float(column))
                    .collect();
                let net = float(&scaled_net);
                self.candidates.push(Candidate {
                    scaled_net,
                    net,
                    columns,
                    basis,
                });
                let index = self.candidates.len() - 1;
                self.known
                    .insert(self.candidates[index].basis.rows(), index);
                index
            }
        };
        let value = t.at(&self.candidates[index].net);
        Some((index, value))
    }

    /// `Σ |x_l|` of a functional in a candidate's basis, in `f64`.
    pub(super) fn float_weight(&self, t: &FloatFunctional, basis: usize) -> f64 {
        cell::float_weight(t, &self.candidates[basis].columns)
    }

    pub(super) fn float_target(
        &mut self,
        word: Word,
        target: Target,
    ) -> std::rc::Rc<Vec<FloatFunctional>> {
        if let Some(known) = self.float_targets.get(&(word, target)) {
            return known.clone();
        }
        let made = std::rc::Rc::new(target_of(&mut self.floats, word, target).to_vec());
        self.float_targets.insert((word, target), made.clone());
        made
    }

    /// Whether [`WORD_BITS`] suffice for the exact functionals of a word and their weights.
    fn fits(&self, word: Word) -> bool {
        self.fits_times(word, 0)
    }

    /// The same after a product with numbers of so many bits.
    fn fits_times(&self, word: Word, bits: u32) -> bool {
        // Inverses of second differences have entries below 2^8; a weight sums n + 9 multipliers.
        // (Numbers that did leave them would stop the program, not spoil the result.)
        bits_needed(self.valence(), word) + 8 + 10 + bits < WORD_BITS
    }

    /// The exact weights of a target's coefficients in a candidate's basis.
    pub(super) fn exact_weights(
        &mut self,
        word: Word,
        target: Target,
        bases: &[usize],
    ) -> Option<[Value; 15]> {
        let bases: Vec<&Basis> = bases.iter().map(|&b| &self.candidates[b].basis).collect();
        fn all<T: Integer>(
            weight: &RingWeight,
            t: &[ExactFunctional<T>; 15],
            bases: &[&Basis],
        ) -> Option<[Value; 15]> {
            let pairs = t.iter().zip(bases.iter().cycle());
            let weights: Option<Vec<Value>> = pairs
                .map(|(t, basis)| cell::exact_weight(weight, t, basis))
                .collect();
            weights?.try_into().ok()
        }
        if self.fits(word) {
            let t = target_of(&mut self.words, word, target);
            all(&self.weight, &t, &bases)
        } else {
            let t = target_of(&mut self.big, word, target);
            all(&self.weight, &t, &bases)
        }
    }

    /// Proves the bound over every part of `0^depth` but `0^(depth + steps)`, up to mirroring.
    pub(super) fn prove_rings(
        &mut self,
        target: Target,
        depth: usize,
        steps: usize,
        bound: &Bound,
    ) -> Result<Vec<CellProof>, Failure> {
        let mut cells = Vec::new();
        for ring in depth..depth + steps {
            for letter in [1, 2] {
                let word = Word::zeros(ring).child(letter);
                self.prove_part(word, target, bound, None, &mut cells)?;
            }
        }
        Ok(cells)
    }

    fn prove_part(
        &mut self,
        word: Word,
        target: Target,
        bound: &Bound,
        hint: Option<usize>,
        cells: &mut Vec<CellProof>,
    ) -> Result<(), Failure> {
        let level = match target {
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
            return Err(Failure::TooFine);
        }
        let symmetric = word.mirror() == word;
        for letter in 0..4 {
            if !(symmetric && letter == 3) {
                self.prove_part(word.child(letter), target, bound, hint, cells)?;
            }
        }
        Ok(())
    }

    /// Tries to close a part above level k by its second differences.
    fn close_regular(
        &mut self,
        word: Word,
        target: Target,
        bound: &Bound,
        cells: &mut Vec<CellProof>,
    ) -> Result<bool, Failure> {
        let Target::Distance(against, level) = target else {
            return Ok(false);
        };
        let factor = cell::regular_factor(against, level - word.len());
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
                    let (index, value) = self.propose(&t, hint).ok_or(Failure::TooFine)?;
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
            if !self.weight.at_most(&(value * &factor), &bound.value) {
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

    /// The exact weight of a second difference of a word's net in a candidate's basis.
    pub(super) fn difference_weight(
        &mut self,
        word: Word,
        l: usize,
        index: usize,
    ) -> Option<Value> {
        fn scaled<A: Space>(nets: &mut Nets<A>, word: Word, l: usize) -> A::V {
            let difference = nets.difference(word, l);
            nets.space_scale(&difference)
        }
        let basis = &self.candidates[index].basis;
        if self.fits(word) {
            cell::exact_weight(&self.weight, &scaled(&mut self.words, word, l), basis)
        } else {
            cell::exact_weight(&self.weight, &scaled(&mut self.big, word, l), basis)
        }
    }

    /// The exact value of a second difference of a word's net at a candidate's net.
    pub(super) fn difference_value(&mut self, word: Word, l: usize, net: usize) -> Value {
        let difference = self.big.difference(word, l);
        let scaled = self.big.space_scale(&difference);
        self.value_at(&scaled, net)
    }

    /// Tries to close one part; whether it did, and a basis to go on from.
    fn prove_cell(
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
            let c = || std::array::from_fn(|i| self.float_weight(&t[i], basis));
            if t.iter().all(below) && {
                let c = c();
                self.close_by(word, target, &c, &[basis], bound, cells)
            } {
                return Ok((true, hint));
            }
        }
        let centre = mean(&t);
        let hint = hint.or(cells.last().map(|cell| cell.bases[0]));
        let (basis, value) = self.propose(&centre, hint).ok_or(Failure::TooFine)?;
        if value > limit {
            return Err(Failure::Exceeded(value));
        }
        let closed = self.close(word, target, &t, basis, bound, cells)?;
        Ok((closed, Some(basis)))
    }

    /// Tries the three reasons, with one basis for all coefficients, then with one for each.
    fn close(
        &mut self,
        word: Word,
        target: Target,
        t: &[FloatFunctional],
        basis: usize,
        bound: &Bound,
        cells: &mut Vec<CellProof>,
    ) -> Result<bool, Failure> {
        let limit = bound.float * (1.0 + SLACK);
        let values: [f64; 15] = std::array::from_fn(|i| t[i].at(&self.candidates[basis].net));
        if !matches!(target, Target::Linear(_)) {
            // Is the basis' own net above the bound somewhere?
            let (value, _) = quartic::sample(&values);
            if value > limit {
                return Err(Failure::Exceeded(value));
            }
        }
        let c: [f64; 15] = std::array::from_fn(|i| self.float_weight(&t[i], basis));
        if self.close_by(word, target, &c, &[basis], bound, cells) {
            return Ok(true);
        }
        if quartic::sample(&c).0 > bound.float * NEAR {
            return Ok(false);
        }
        // Where the optimum is degenerate, multipliers change their signs within the part: the best
        // basis of each coefficient gives the least c.
        let mut bases = Vec::with_capacity(15);
        let mut least = [0.0; 15];
        for (i, t) in t.iter().enumerate() {
            let (index, _) = self.propose(t, Some(basis)).ok_or(Failure::TooFine)?;
            least[i] = self.float_weight(t, index);
            bases.push(index);
        }
        Ok(self.close_by(word, target, &least, &bases, bound, cells))
    }

    /// Tries the three reasons for the quartic c.
    fn close_by(
        &mut self,
        word: Word,
        target: Target,
        c: &[f64; 15],
        bases: &[usize],
        bound: &Bound,
        cells: &mut Vec<CellProof>,
    ) -> bool {
        let reasons = reasons(c, bound.float);
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
        let by =
            (reasons.into_iter()).find(|by| cell::holds(&self.weight, &weights, by, &bound.value));
        let holds = by.is_some();
        cells.extend(by.map(|by| CellProof {
            word,
            bases: bases.to_vec(),
            by,
        }));
        holds
    }

    /// Proves the bound for `base_c + s D (α_l ∘ A^level) scale`, s = 1, -1, all l, with exact bases.
    /// `tail` says which functionals these are.
    pub(super) fn prove_tail(&mut self, tail: &Tail, bound: &Bound) -> Result<TailProof, Failure> {
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
                            let (index, value) = self.propose(&t, hint).ok_or(Failure::TooFine)?;
                            if value > limit {
                                return Err(Failure::Exceeded(value));
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
        if exact {
            Ok(proof)
        } else {
            Err(Failure::TooFine)
        }
    }

    /// The exact weight of one functional in a candidate's basis, in the smallest arithmetic that
    /// holds it.
    pub(super) fn weight_of<F, G>(
        &mut self,
        word: Word,
        basis: usize,
        small: F,
        large: G,
    ) -> Option<Value>
    where
        F: Fn(&mut Nets<Exact<I256>>) -> ExactFunctional<I256>,
        G: Fn(&mut Nets<Exact<BigInt>>) -> ExactFunctional<BigInt>,
    {
        let basis = &self.candidates[basis].basis;
        if self.fits(word) {
            cell::exact_weight(&self.weight, &small(&mut self.words), basis)
        } else {
            cell::exact_weight(&self.weight, &large(&mut self.big), basis)
        }
    }

    /// The exact value of a functional at a candidate's net.
    pub(super) fn value_at<T: Integer>(&self, t: &ExactFunctional<T>, net: usize) -> Value {
        let candidate = &self.candidates[net];
        let dot = |row: &Vec<T>| {
            let products = row.iter().zip(&candidate.scaled_net);
            let sum: BigInt = products.map(|(a, &y)| a.to_big() * y).sum();
            let denominator = BigInt::from(t.denominator) * candidate.basis.determinant();
            Rational::new(sum, denominator)
        };
        Value::new(t.numerators.iter().map(dot).collect())
    }

    /// The exact Bernstein coefficients of a target at a candidate's net.
    pub(super) fn values_at(&mut self, word: Word, target: Target, net: usize) -> [Value; 15] {
        if self.fits(word) {
            let t = target_of(&mut self.words, word, target);
            t.map(|t| self.value_at(&t, net))
        } else {
            let t = target_of(&mut self.big, word, target);
            t.map(|t| self.value_at(&t, net))
        }
    }

    /// The exact value of S - F_k at the extraordinary corner, at a candidate's net.
    pub(super) fn corner_value(&mut self, against: Against, k: usize, net: usize) -> Value {
        let t = self.big.corner_target(against, k);
        self.value_at(&t, net)
    }
}

fn target_of<A: Space>(nets: &mut Nets<A>, word: Word, target: Target) -> [A::V; 15] {
    match target {
        Target::Distance(against, k) => nets.target(word, against, k),
        Target::Linear(depth) => nets.linear_target(word, depth),
    }
}

/// The reasons why a quartic could be below a bound, judged in `f64`, the simplest first.
pub(super) fn reasons(c: &[f64; 15], bound: f64) -> Vec<By> {
    let limit = bound * (1.0 + SLACK);
    if c.iter().all(|c| *c <= limit) {
        return vec![By::Hull];
    }
    let mut reasons = Vec::new();
    if quartic::sample(c).0 > limit {
        return reasons;
    }
    let (value, [v, w]) = quartic::maximise(c);
    if value > limit {
        return reasons;
    }
    for edge in 0..3 {
        let on = cell::edge_indices(edge);
        let f = on.map(|i| c[i]);
        let off_below = (0..15).all(|i| on.contains(&i) || c[i] <= limit);
        if off_below && quartic::is_concave_edge(&f) {
            let (_, s) = quartic::maximise_edge(&f);
            reasons.extend(rationals_near(s).map(|s| By::Edge(edge, s)));
        }
    }
    if quartic::is_concave(c) {
        let points = rationals_near(v).into_iter().zip(rationals_near(w));
        reasons.extend(points.map(|(v, w)| By::Concave(v, w)));
    }
    reasons
}

/// The value at the middle of the triangle.
fn mean(t: &[FloatFunctional]) -> FloatFunctional {
    let weights = quartic::basis([1.0 / 3.0, 1.0 / 3.0]);
    let terms = t.iter().zip(weights);
    terms.fold(FloatFunctional::zero(), |sum, (t, w)| sum.plus(w, t))
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
