//! The prover of one valence: what floats propose and where exact arithmetic is asked.

use std::collections::HashMap;
use std::rc::Rc;

use ethnum::I256;
use num_bigint::BigInt;
use num_traits::Zero;

use super::arithmetic::{Arithmetic, Exact, Floats};
use super::cell;
use super::constant::Lemma;
use super::functional::{ExactFunctional, FloatFunctional, Integer};
use super::nets::{Against, Nets};
use super::rules::{Family, Rules};
use super::search::Witness;
use super::shape::Shape;
use super::value::{Numbers, Value};
use super::word::Word;
use crate::lp::{Basis, Rows};
use crate::scalar::Rational;

/// What is bounded over a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Target {
    /// S - F_k.
    Distance(Against, usize),
    /// `(t - (1 - mu) t_0) / mu`, t = S - F_0 against the control mesh, mu the ramp of the root's
    /// `0^depth`.
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
    fn new(basis: Basis, scaled_net: Vec<i64>) -> Self {
        let determinant = basis.determinant() as f64;
        let float = |column: &[i64]| -> Vec<f64> {
            let over = |&a: &i64| a as f64 / determinant;
            column.iter().map(over).collect()
        };
        Candidate {
            net: float(&scaled_net),
            columns: basis
                .row_columns()
                .map(|(_, column)| float(column))
                .collect(),
            scaled_net,
            basis,
        }
    }

    /// Whether its net is that of another basis.
    fn has_net(&self, basis: &Basis, scaled_net: &[i64]) -> bool {
        self.basis.determinant() == basis.determinant() && self.scaled_net == scaled_net
    }

    /// The dual net.
    pub fn net_rationals(&self) -> Vec<Rational> {
        self.basis.net(&self.scaled_net)
    }
}

/// A bound to prove: the number and, for floats, its size.
#[derive(Clone, Debug)]
pub struct Bound {
    /// The number.
    pub value: Value,
    pub(super) float: f64,
}

/// Why a bound was not proved.
#[derive(Clone, Debug)]
pub enum Failure {
    /// A proposal exceeds it: so, it seems, does the constant.
    Attained(Witness),
    /// No proof was found.
    Unproved,
}

/// Relative slack of float comparisons: what they reject wrongly costs a split, what they accept
/// wrongly is rejected exactly.
pub(super) const SLACK: f64 = 1e-12;

/// Bits that factors of fixed-size integers may have.
const WORD_BITS: u32 = 190;

/// The prover of one family and valence.
#[derive(Debug)]
pub struct Prover {
    /// Scheme and norm.
    pub family: Family,
    /// The numbers of the scheme.
    pub numbers: Numbers,
    /// The differences.
    pub rows: Rows,
    pub(super) floats: Nets<Floats>,
    pub(super) words: Nets<Exact<I256>>,
    pub(super) big: Nets<Exact<BigInt>>,
    pub(super) candidates: Vec<Candidate>,
    /// The candidates with the same rows.
    known: HashMap<Vec<usize>, Vec<usize>>,
    float_targets: HashMap<(Word, Target), Rc<Vec<FloatFunctional>>>,
    pub(super) main_lemma: Option<Lemma>,
}

impl Prover {
    /// For a family at a valence n >= 3; for Doo-Sabin at a face of n sides.
    pub fn new(family: impl Into<Family>, n: u32) -> Self {
        let family = family.into();
        let numbers = family.numbers(n);
        let rules: Box<dyn Rules<Floats>> = family.rules(n);
        let rows = Rows::new(rules.differences(n), rules.layout().size);
        Prover {
            family,
            rows,
            floats: Nets::new(Floats::new(&numbers), rules),
            words: Nets::new(Exact::new(), family.rules(n)),
            big: Nets::new(Exact::new(), family.rules(n)),
            numbers,
            candidates: Vec::new(),
            known: HashMap::new(),
            float_targets: HashMap::new(),
            main_lemma: None,
        }
    }

    /// The domain of patches.
    pub(super) fn shape(&self) -> Shape {
        self.floats.rules().layout().shape
    }

    /// The word that is the face.
    pub(super) fn root(&self) -> Word {
        self.floats.rules().layout().root
    }

    /// The valence.
    pub fn valence(&self) -> u32 {
        self.numbers.n
    }

    /// A candidate by its index.
    pub fn candidate(&self, index: usize) -> &Candidate {
        &self.candidates[index]
    }

    /// A rational as a bound.
    pub fn rational_bound(&self, r: &Rational) -> Bound {
        self.bound(self.numbers.constant(r))
    }

    /// A value as a bound.
    pub fn bound(&self, value: Value) -> Bound {
        let float = self.numbers.enclose(&value).mid();
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
        let index = self.keep(basis, scaled_net);
        let value = t.at(&self.candidates[index].net);
        Some((index, value))
    }

    /// The index of a candidate, new or known.
    pub(super) fn keep(&mut self, basis: Basis, scaled_net: Vec<i64>) -> usize {
        // The same rows with other signs of zeros make another net.
        let same_rows = self.known.entry(basis.rows()).or_default();
        let has_net = |&&index: &&usize| self.candidates[index].has_net(&basis, &scaled_net);
        match same_rows.iter().find(has_net) {
            Some(&index) => index,
            None => {
                same_rows.push(self.candidates.len());
                self.candidates.push(Candidate::new(basis, scaled_net));
                self.candidates.len() - 1
            }
        }
    }

    /// `Σ |x_l|` of a functional in a candidate's basis, in `f64`.
    pub(super) fn float_weight(&self, t: &FloatFunctional, basis: usize) -> f64 {
        cell::float_weight(t, &self.candidates[basis].columns)
    }

    pub(super) fn float_target(&mut self, word: Word, target: Target) -> Rc<Vec<FloatFunctional>> {
        if let Some(known) = self.float_targets.get(&(word, target)) {
            return known.clone();
        }
        let made = Rc::new(target_of(&mut self.floats, word, target));
        self.float_targets.insert((word, target), made.clone());
        made
    }

    /// Whether [`WORD_BITS`] suffice for the exact functionals of a word and their weights.
    pub(super) fn fits(&self, word: Word) -> bool {
        self.fits_times(word, 0)
    }

    /// The same after a product with numbers of so many bits.
    pub(super) fn fits_times(&self, word: Word, bits: u32) -> bool {
        // A weight sums as many multipliers as there are rows. (Numbers that did leave these bits would
        // stop the program, not spoil the result.)
        let rules = self.floats.rules();
        rules.bits(word) + rules.inverse_bits() + 10 + bits < WORD_BITS
    }

    /// The exact weights of a target's coefficients in a candidate's basis.
    pub(super) fn exact_weights(
        &mut self,
        word: Word,
        target: Target,
        bases: &[usize],
    ) -> Option<Vec<Value>> {
        let bases: Vec<&Basis> = bases.iter().map(|&b| &self.candidates[b].basis).collect();
        fn all<T: Integer>(
            numbers: &Numbers,
            t: &[ExactFunctional<T>],
            bases: &[&Basis],
        ) -> Option<Vec<Value>> {
            let pairs = t.iter().zip(bases.iter().cycle());
            pairs
                .map(|(t, basis)| cell::exact_weight(numbers, t, basis))
                .collect()
        }
        if self.fits(word) {
            let t = target_of(&mut self.words, word, target);
            all(&self.numbers, &t, &bases)
        } else {
            let t = target_of(&mut self.big, word, target);
            all(&self.numbers, &t, &bases)
        }
    }

    /// The exact weight of a second difference of a word's net in a candidate's basis.
    pub(super) fn difference_weight(
        &mut self,
        word: Word,
        l: usize,
        index: usize,
    ) -> Option<Value> {
        fn scaled<A: Arithmetic>(nets: &mut Nets<A>, word: Word, l: usize) -> A::V {
            let difference = nets.difference(word, l);
            nets.scale(&difference)
        }
        let basis = &self.candidates[index].basis;
        if self.fits(word) {
            cell::exact_weight(&self.numbers, &scaled(&mut self.words, word, l), basis)
        } else {
            cell::exact_weight(&self.numbers, &scaled(&mut self.big, word, l), basis)
        }
    }

    /// The exact value of a second difference of a word's net at a candidate's net.
    pub(super) fn difference_value(&mut self, word: Word, l: usize, net: usize) -> Value {
        let difference = self.big.difference(word, l);
        let scaled = self.big.scale(&difference);
        self.value_at(&scaled, net)
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
            cell::exact_weight(&self.numbers, &small(&mut self.words), basis)
        } else {
            cell::exact_weight(&self.numbers, &large(&mut self.big), basis)
        }
    }

    /// The exact value of a functional at a candidate's net.
    pub(super) fn value_at<T: Integer>(&self, t: &ExactFunctional<T>, net: usize) -> Value {
        let candidate = &self.candidates[net];
        let dot = |row: &Vec<T>| {
            let products = row.iter().zip(&candidate.scaled_net);
            let sum: BigInt = products.map(|(a, &y)| a.to_big() * y).sum();
            let denominator = &t.denominator * candidate.basis.determinant();
            Rational::new(sum, denominator)
        };
        Value::new(t.numerators.iter().map(dot).collect())
    }

    /// The exact Bernstein coefficients of a target at a candidate's net.
    pub(super) fn values_at(&mut self, word: Word, target: Target, net: usize) -> Vec<Value> {
        if self.fits(word) {
            let t = target_of(&mut self.words, word, target);
            t.iter().map(|t| self.value_at(t, net)).collect()
        } else {
            let t = target_of(&mut self.big, word, target);
            t.iter().map(|t| self.value_at(t, net)).collect()
        }
    }

    /// The exact value of S - F_k at the extraordinary corner, at a candidate's net.
    pub(super) fn corner_value(&mut self, against: Against, k: usize, net: usize) -> Value {
        let t = self.big.corner_target(against, k);
        self.value_at(&t, net)
    }

    /// |value|, of a value whose sign is known.
    pub(super) fn absolute(&self, value: Value) -> Value {
        if self.numbers.at_most(&value, &Value::zero()) {
            Value::zero() - &value
        } else {
            value
        }
    }
}

fn target_of<A: Arithmetic>(nets: &mut Nets<A>, word: Word, target: Target) -> Vec<A::V> {
    match target {
        Target::Distance(against, k) => nets.target(word, against, k),
        Target::Linear(depth) => nets.linear_target(word, depth),
    }
}
