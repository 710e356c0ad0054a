//! A proof as a certificate.

use std::collections::HashMap;

use super::cell::By;
use super::constant::{At, Conclusion, Constant, Lemma, Proof};
use super::nets::Against;
use super::part::CellProof;
use super::prover::Prover;
use super::rules::Family;
use super::tail::TailProof;
use super::value::Value;
use crate::certificate::{self, Certificate, Claim, CoefficientAt, ConstantClaim, Number, Step};
use crate::scalar::{Rational, cosine};
use crate::scheme::LoopWeights;

/// Bits of the enclosure of cos(π/n) in certificates.
const COSINE_BITS: u32 = 220;

impl Constant {
    /// The name in claims and on the command line.
    pub fn name(&self) -> &'static str {
        match self {
            Constant::Distance(Against::Control, _) => "control",
            Constant::Distance(Against::Limit, _) => "limit",
            Constant::Rate(_) => "rate",
            Constant::MeshRate(_) => "mesh-rate",
            Constant::Coefficient(..) => "coefficient",
            Constant::Beta => "beta",
        }
    }

    /// The level k.
    pub fn level(&self) -> usize {
        match self {
            Constant::Distance(_, k) | Constant::Rate(k) | Constant::MeshRate(k) => *k,
            Constant::Coefficient(..) | Constant::Beta => 0,
        }
    }
}

/// Collects the bases that a proof cites.
struct Bases<'a> {
    prover: &'a Prover,
    list: Vec<Vec<usize>>,
    known: HashMap<Vec<usize>, usize>,
}

impl Bases<'_> {
    fn cite(&mut self, candidate: usize) -> usize {
        let rows = self.prover.candidate(candidate).basis.rows();
        *self.known.entry(rows).or_insert_with_key(|rows| {
            self.list.push(rows.iter().map(|l| l + 1).collect());
            self.list.len() - 1
        })
    }

    fn cells(&mut self, cells: &[CellProof]) -> Vec<certificate::Cell> {
        let mut cell = |cell: &CellProof| {
            let bases = match cell.bases[..] {
                [one] => certificate::Bases::One(self.cite(one)),
                ref each => certificate::Bases::Each(each.iter().map(|&b| self.cite(b)).collect()),
            };
            (cell.word.to_string(), bases, reason(&cell.by))
        };
        cells.iter().map(&mut cell).collect()
    }

    fn tail(&mut self, tail: &TailProof) -> Vec<[Vec<usize>; 2]> {
        let mut list = |list: &Vec<usize>| list.iter().map(|&b| self.cite(b)).collect();
        tail.iter()
            .map(|[plus, minus]| [list(plus), list(minus)])
            .collect()
    }
}

fn reason(by: &By) -> certificate::By {
    match by {
        By::Hull => certificate::By::Plain("hull".into()),
        By::Regular => certificate::By::Plain("regular".into()),
        By::Edge(e, s) => certificate::By::Edge("edge".into(), *e, s.to_string()),
        By::Concave(v, w) => {
            certificate::By::Concave("concave".into(), v.to_string(), w.to_string())
        }
        By::Split(reasons) => {
            certificate::By::Split("split".into(), Box::new(reasons.each_ref().map(reason)))
        }
    }
}

/// The enclosure of cos(π/n) that a certificate about Loop's scheme needs; `None` where the ring weight
/// is rational.
pub fn cosine_of_loop(weights: LoopWeights, n: u32) -> Option<[String; 2]> {
    if weights == LoopWeights::Warren || matches!(n, 3 | 4 | 6) {
        return None;
    }
    // 2 cos(π/n) = 2 cos(2π/(2n)), halved.
    let twice = cosine::enclose_two_cos(1, 2 * n, COSINE_BITS)?;
    let half = |x: Rational| (x / Rational::from_integer(2.into())).to_string();
    Some([half(twice.inf_rational()), half(twice.sup_rational())])
}

impl Prover {
    /// The certificate of a proof made by this prover.
    pub fn certificate(&self, proof: &Proof) -> Certificate {
        let mut bases = Bases {
            prover: self,
            list: Vec::new(),
            known: HashMap::new(),
        };
        let net = |index: usize| -> Vec<String> {
            let net = self.candidate(index).net_rationals();
            net.iter().map(Rational::to_string).collect()
        };
        let attained = |at| Step::Attained {
            net: net(proof.net),
            at,
        };
        let mut steps = vec![match &proof.at {
            At::Point(word, v, w) => attained(Some(certificate::At::Point {
                word: word.to_string(),
                v: v.to_string(),
                w: w.to_string(),
            })),
            At::Difference(word, l) => attained(Some(certificate::At::Difference {
                word: word.to_string(),
                difference: l + 1,
            })),
            At::Claimed => attained(None),
            At::Tile { word, nets, v, w } => Step::AttainedTile {
                word: word.to_string(),
                nets: nets.iter().map(|&index| net(index)).collect(),
                v: v.to_string(),
                w: w.to_string(),
            },
        }];
        if let Some(lemma) = &proof.lemma {
            steps.push(self.lemma_step(lemma, &mut bases));
        }
        let lemma = 1;
        steps.push(match &proof.conclusion {
            Conclusion::Apply => Step::Apply { lemma },
            Conclusion::Cover { steps, cells, tail } => Step::Cover {
                steps: *steps,
                lemma,
                cells: bases.cells(cells),
                tail: bases.tail(tail),
            },
            Conclusion::Tiles { steps, cells, tail } => Step::Tiles {
                steps: *steps,
                lemma,
                cells: bases.cells(cells),
                tail: bases.tail(tail),
            },
            Conclusion::Differences(words) => Step::Differences {
                words: words
                    .iter()
                    .map(|(word, list)| {
                        let cited = list.iter().map(|&b| bases.cite(b)).collect();
                        (word.to_string(), cited)
                    })
                    .collect(),
            },
            Conclusion::Weight(basis) => Step::Weight {
                basis: bases.cite(*basis),
            },
        });
        Certificate {
            format: "subcert".into(),
            version: 1,
            claim: Claim::Constant(self.claim(proof)),
            cosine: self.cosine().map(certificate::Cosines::One),
            bases: bases.list,
            steps,
        }
    }

    fn claim(&self, proof: &Proof) -> ConstantClaim {
        let exact_float = |x: f64| Rational::from_float(x).map_or("?".into(), |r| r.to_string());
        ConstantClaim {
            scheme: self.family.scheme().name().into(),
            weights: (self.family.scheme().weights()).map(|weights| weights.to_string()),
            valence: self.valence(),
            level: proof.constant.level(),
            kind: proof.constant.name().into(),
            norm: self.family.norm().name().into(),
            at: match proof.constant {
                Constant::Coefficient(word, index) => Some(CoefficientAt {
                    word: word.to_string(),
                    index,
                }),
                _ => None,
            },
            lo: exact_float(proof.lo),
            hi: exact_float(proof.hi),
            exact: (proof.exact.as_ref())
                .map(|value| self.number(value))
                .filter(|number| self.may_be_irrational() || number.is_rational()),
        }
    }

    /// Whether numbers of certificates may be other than rationals.
    fn may_be_irrational(&self) -> bool {
        matches!(self.family, Family::Loop(_))
    }

    fn cosine(&self) -> Option<[String; 2]> {
        match self.family {
            Family::Loop(weights) => cosine_of_loop(weights, self.valence()),
            Family::CatmullClark(_) => None,
            Family::DooSabin => cosine_of_loop(LoopWeights::Original, self.valence()),
        }
    }

    /// A rational where the value is one, else its polynomial in β, over q.
    fn number(&self, value: &Value) -> Number {
        if let Some(r) = self.numbers.rational(value) {
            return Number::Rational(r.to_string());
        }
        let coefficients = value.ring_sum_coefficients(self.valence());
        Number::OverQ(coefficients.iter().map(Rational::to_string).collect())
    }

    fn lemma_step(&self, lemma: &Lemma, bases: &mut Bases<'_>) -> Step {
        Step::Lemma {
            depth: lemma.depth,
            steps: lemma.steps,
            order: lemma.order,
            bound: self.number(&lemma.bound.value),
            corner: lemma.corner.map(|candidate| bases.cite(candidate)),
            cells: bases.cells(&lemma.cells),
            tail: bases.tail(&lemma.tail),
        }
    }
}
