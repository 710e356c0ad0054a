//! Constants that are finitely many programs: rates, and single coefficients.

use num_traits::Zero;

use super::constant::{At, Conclusion, Constant, Proof};
use super::nets::Against;
use super::prover::{Prover, Target};
use super::value::Value;
use super::word::Word;

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
        Some(Proof {
            constant,
            lo: self.weight.enclose(&lower).inf(),
            hi: self.weight.enclose(&upper).sup(),
            exact: self.weight.at_most(&upper, &lower).then_some(lower),
            net,
            at,
            lemma: None,
            conclusion: Conclusion::Differences(bases),
        })
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
            lo: self.weight.enclose(&lower).inf(),
            hi: self.weight.enclose(&upper).sup(),
            exact: self.weight.at_most(&upper, &lower).then_some(lower),
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
