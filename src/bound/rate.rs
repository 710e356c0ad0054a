//! Constants that are finitely many programs: rates, and single coefficients.

use num_traits::{ToPrimitive, Zero};

use super::constant::{At, Conclusion, Constant, Proof};
use super::nets::Against;
use super::prover::{Prover, Target};
use super::value::Value;
use super::word::Word;
use crate::scalar::{Cyclotomic, Rational};

impl Prover {
    pub(super) fn rate(&mut self, constant: Constant, words: Vec<Word>) -> Option<Proof> {
        let mut best: Option<(Value, usize, At)> = None;
        let mut upper = Value::zero();
        let mut bases = Vec::new();
        for word in words {
            let floats = self.floats.differences(word);
            let mut list = Vec::new();
            let mut hint = None;
            for (l, t) in floats.iter().enumerate() {
                let (mut index, _) = self.propose(t, hint)?;
                let mut above = self.difference_weight(word, l, index)?;
                let known = best
                    .as_ref()
                    .map_or_else(Value::zero, |(known, ..)| known.clone());
                let below = self.difference_value(word, l, index);
                let enough = self.numbers.at_most(&above, &self.absolute(below))
                    || self.numbers.at_most(&above, &known);
                if !enough && let Some(settled) = self.settle_difference(word, l, index) {
                    index = settled;
                    above = self.difference_weight(word, l, index)?;
                }
                hint = Some(index);
                list.push(index);
                if !self.numbers.at_most(&above, &upper) {
                    upper = above;
                }
                let below = self.difference_value(word, l, index);
                let below = self.absolute(below);
                if best
                    .as_ref()
                    .is_none_or(|(known, ..)| !self.numbers.at_most(&below, known))
                {
                    best = Some((below, index, At::Difference(word, l)));
                }
            }
            bases.push((word, list));
        }
        let (lower, net, at) = best?;
        Some(Proof {
            constant,
            lo: self.numbers.enclose(&lower).inf(),
            hi: self.numbers.enclose(&upper).sup(),
            exact: self.numbers.at_most(&upper, &lower).then_some(lower),
            net,
            at,
            lemma: None,
            conclusion: Conclusion::Differences(bases),
        })
    }

    /// The optimal basis of a second difference by the exact simplex, from a candidate: for where floats
    /// leave only rounding to decide (differences of high levels are small sums of large terms).
    fn settle_difference(&mut self, word: Word, l: usize, from: usize) -> Option<usize> {
        // Positive factors do not matter: the numerators at b.
        let numerators = self.big.difference(word, l).numerators;
        let at = |point: usize| {
            let coefficients = numerators.iter().map(|row| &row[point]);
            let coefficients = coefficients.map(|c| Rational::from_integer(c.clone()));
            self.numbers.numerator(&Value::new(coefficients.collect()))
        };
        let t: Vec<Cyclotomic> = (0..self.rows.size()).map(at).collect();
        let best = self.rows.minimise(&t, &self.candidate(from).basis)?;
        let determinant = Rational::from_integer(best.basis.determinant().into());
        let scaled = |y: &Rational| (y * &determinant).to_integer().to_i64();
        let net: Option<Vec<i64>> = best.y.iter().map(scaled).collect();
        Some(self.keep(best.basis, net?))
    }

    pub(super) fn coefficient(&mut self, word: Word, index: usize) -> Option<Proof> {
        let target = Target::Distance(Against::Limit, 0);
        let t = self.float_target(word, target);
        let (net, _) = self.propose(&t[index], None)?;
        let lower = self.values_at(word, target, net)[index].clone();
        let lower = self.absolute(lower);
        let upper = self.exact_weights(word, target, &[net])?[index].clone();
        Some(Proof {
            constant: Constant::Coefficient(word, index),
            lo: self.numbers.enclose(&lower).inf(),
            hi: self.numbers.enclose(&upper).sup(),
            exact: self.numbers.at_most(&upper, &lower).then_some(lower),
            net,
            at: At::Claimed,
            lemma: None,
            conclusion: Conclusion::Weight(net),
        })
    }
}

/// All words of a level up to mirroring.
pub(super) fn words_of(level: usize) -> Vec<Word> {
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
