//! HW's β by the paper's own method, enclosed.
//!
//! Over each tile `0^r m`, m = 1, 2, 3, the method bounds the Bernstein coefficients of S less the
//! limit triangle one by one, `δ_i = ‖t_i‖`, each by its own program, and takes
//! `B = Σ δ_i B_i`; β is the largest value of B over all tiles. (HW (6), (10), Theorem 3.)
//!
//! All tiles of the rings beyond `0^(K+J)` at once: `t_i = (b_i - F_K) + (F_K - F̄)` at the node i, F_K
//! the control triangle of level K, and the first part is bounded by the lemma, whose hull cells
//! over whole tiles bound coefficients one by one, ring after ring.

use num_bigint::BigInt;

use super::cell::{self, By};
use super::constant::{At, Conclusion, Constant, Proof};
use super::maximum;
use super::nets::Against;
use super::part::{CellProof, rationals_near, reasons};
use super::prover::{Bound, Prover, Target};
use super::shape::Shape;
use super::tail::{Tail, TailKind};
use super::value::Value;
use super::word::Word;
use crate::scalar::Rational;

const TARGET: Target = Target::Distance(Against::Limit, 0);

/// The method is about Loop's scheme.
const SHAPE: Shape = Shape::Triangle;

/// Deepest splitting of a tile's quartic.
const DEEPEST: usize = 8;

/// A tile with the best basis of each coefficient.
struct TileMethod {
    word: Word,
    bases: Vec<usize>,
    /// The δ_i.
    float: Vec<f64>,
}

impl Prover {
    /// Encloses β; `None` if no proof was found.
    pub(super) fn beta(&mut self, gap: f64) -> Option<Proof> {
        let lemma = self.main_lemma()?;
        let whole = |cell: &CellProof| cell.word.len() == cell.word.leading_zeros() + 1;
        if !lemma
            .cells
            .iter()
            .all(|cell| whole(cell) && cell.by == By::Hull)
        {
            return None;
        }
        let mut tiles = Vec::new();
        for ring in 0..4 {
            for letter in [1, 2] {
                tiles.push(self.tile(Word::zeros(ring).child(letter))?);
            }
        }
        let maxima: Vec<(f64, [f64; 2])> = tiles
            .iter()
            .map(|t| maximum::maximise(SHAPE, &t.float))
            .collect();
        let best = (0..tiles.len())
            .max_by(|&a, &b| maxima[a].0.total_cmp(&maxima[b].0).then(b.cmp(&a)))?;
        let (word, nets) = (tiles[best].word, tiles[best].bases.clone());
        let lower = self.tile_values(word, &nets);
        let [vs, ws] = maxima[best].1.map(rationals_near);
        for ((v, w), exact) in vs.into_iter().zip(ws).zip([true, false]) {
            if exact && (*v.denom() > BigInt::from(64) || *w.denom() > BigInt::from(64)) {
                continue;
            }
            let (value, _) = SHAPE.evaluate(&lower, [&v, &w]);
            let lo = self.numbers.enclose(&value);
            let bound = if exact {
                self.bound(value.clone())
            } else {
                let hi = lo.sup() * (1.0 + gap * 0.5);
                self.rational_bound(&Rational::from_float(hi)?)
            };
            let Some(conclusion) = self.tiles(&mut tiles, &lemma, &bound) else {
                continue;
            };
            return Some(Proof {
                constant: Constant::Beta,
                lo: lo.inf(),
                hi: self.numbers.enclose(&bound.value).sup(),
                exact: exact.then_some(value),
                net: nets[0],
                at: At::Tile { word, nets, v, w },
                lemma: Some(lemma),
                conclusion,
            });
        }
        None
    }

    fn tile(&mut self, word: Word) -> Option<TileMethod> {
        let t = self.float_target(word, TARGET);
        let mut bases = Vec::with_capacity(15);
        let mut float = Vec::with_capacity(15);
        for t in t.iter() {
            let (index, value) = self.propose(t, bases.last().copied())?;
            bases.push(index);
            float.push(value);
        }
        Some(TileMethod { word, bases, float })
    }

    /// The magnitudes of the coefficients, each at its own net.
    fn tile_values(&mut self, word: Word, nets: &[usize]) -> Vec<Value> {
        let at = |(i, &net): (usize, &usize)| {
            let value = self.values_at(word, TARGET, net)[i].clone();
            self.absolute(value)
        };
        nets.iter().enumerate().map(at).collect()
    }

    fn tiles(
        &mut self,
        tiles: &mut Vec<TileMethod>,
        lemma: &super::constant::Lemma,
        bound: &Bound,
    ) -> Option<Conclusion> {
        for steps in 0..=12 {
            let tail = Tail {
                kind: TailKind::Distance(Against::Limit, 0),
                steps,
                depth: lemma.depth,
                bound: lemma.bound.clone(),
            };
            let Some(tail) = self.prove_tail(&tail, bound) else {
                continue;
            };
            let mut cells = Vec::new();
            for ring in 0..steps + lemma.depth {
                for letter in [1, 2] {
                    let word = Word::zeros(ring).child(letter);
                    if !tiles.iter().any(|tile| tile.word == word) {
                        tiles.push(self.tile(word)?);
                    }
                    let tile = tiles.iter().find(|t| t.word == word)?;
                    let bases = tile.bases.clone();
                    let weights = (self.exact_weights(word, TARGET, &bases))?;
                    let by = self.reason(&tile.float, &weights, bound, DEEPEST);
                    let by = by?;
                    cells.push(CellProof { word, bases, by });
                }
            }
            return Some(Conclusion::Tiles { steps, cells, tail });
        }
        None
    }

    /// A reason why a quartic is below a bound, exact; splits it where it must.
    fn reason(&self, c: &[f64], exact: &[Value], bound: &Bound, depth: usize) -> Option<By> {
        let holds = |by: &By| cell::holds(&self.numbers, SHAPE, exact, by, &bound.value);
        if let Some(by) = reasons(SHAPE, c, bound.float).into_iter().find(holds) {
            return Some(by);
        }
        let depth = depth.checked_sub(1)?;
        let floats = SHAPE.quarters::<f64, f64>(c);
        let values = SHAPE.quarters::<Rational, Value>(exact);
        let mut found = Vec::with_capacity(4);
        for (c, exact) in floats.iter().zip(&values) {
            found.push(self.reason(c, exact, bound, depth)?);
        }
        Some(By::Split(Box::new(found.try_into().ok()?)))
    }
}
