//! Large values of |S - F_k| over all nets with M <= 1, in `f64`: where a constant may be attained.

use num_traits::Zero;

use super::functional::FloatFunctional;
use super::maximum;
use super::nets::Against;
use super::prover::{Prover, Target};
use super::shape::Shape;
use super::word::Word;

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

/// Words of a tile that the search follows to level k.
const BEAM: usize = 16;

impl Prover {
    /// A large value of |S - F_k| over all nets with M <= 1, in `f64`.
    pub(super) fn search(&mut self, against: Against, k: usize) -> Option<Witness> {
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
        let shape = self.shape();
        let starts = starts(shape);
        let mut hint = None;
        let mut found: Vec<Witness> = Vec::new();
        let root = self.root().len();
        for ring in root..root + k + 4 {
            let mut words = vec![Word::zeros(ring).child(1), Word::zeros(ring).child(2)];
            while words.first().is_some_and(|word| word.len() < k + root) {
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
                for &start in starts {
                    let (net, _) = self.propose(&at(shape, &t, start), hint)?;
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
    pub(super) fn steepest(&mut self, words: Vec<Word>, count: usize) -> Option<Vec<Word>> {
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
    pub(super) fn maximum(&self, t: &[FloatFunctional], net: usize) -> (f64, [f64; 2]) {
        let net = &self.candidate(net).net;
        let values: Vec<f64> = t.iter().map(|t| t.at(net)).collect();
        let opposite: Vec<f64> = values.iter().map(|x| -x).collect();
        let (value, at) = maximum::maximise(self.shape(), &values);
        let (other, there) = maximum::maximise(self.shape(), &opposite);
        if other > value {
            (other, there)
        } else {
            (value, at)
        }
    }

    /// Alternates between the best net at a point and the best point of a net.
    pub(super) fn climb(&mut self, mut witness: Witness, target: Target) -> Option<Witness> {
        let t = self.float_target(witness.word, target);
        for _ in 0..20 {
            // A little inside: at borders and symmetry lines the best net is not unique.
            let inside = witness.at.map(|x| x * (1.0 - 1e-7) + 1e-8);
            let (net, _) = self.propose(&at(self.shape(), &t, inside), Some(witness.net))?;
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
}

/// Where to start, a little inside: at borders and symmetry lines the best net is not unique.
fn starts(shape: Shape) -> &'static [[f64; 2]] {
    match shape {
        Shape::Triangle => &[
            [0.33, 0.34],
            [0.03, 0.02],
            [0.95, 0.02],
            [0.02, 0.95],
            [0.48, 0.02],
            [0.02, 0.48],
            [0.49, 0.49],
        ],
        Shape::Bicubic | Shape::Biquadratic => &[
            [0.49, 0.52],
            [0.03, 0.02],
            [0.97, 0.02],
            [0.96, 0.97],
            [0.03, 0.98],
            [0.48, 0.02],
            [0.02, 0.48],
            [0.97, 0.51],
            [0.51, 0.97],
        ],
    }
}

/// The value of a polynomial with functional coefficients at a point.
fn at(shape: Shape, t: &[FloatFunctional], point: [f64; 2]) -> FloatFunctional {
    let weights = shape.basis(point);
    let terms = t.iter().zip(weights);
    let zero = FloatFunctional::zero();
    terms.fold(zero, |sum, (t, w)| sum.plus(w, t))
}
