//! Certificates: claims and the choices that prove them, as data; `proofs/FORMAT.md` is normative.
//!
//! A certificate holds no mathematics: masks, nets, functionals and multipliers are rebuilt by the
//! checker from the claim. This module knows no algorithm; [`crate::bound`] fills it.

use std::io::{self, Write};

use serde::{Deserialize, Serialize};

mod eigenspline;
mod violation;

pub use eigenspline::{
    CentreDistanceClaim, CharacteristicMapClaim, EigensplineClaim, ModeClaim, NearStep, RingStep,
    SplineAt,
};
pub use violation::{Form, MeshViolation, NetInequality, NetViolation};

/// A certificate file.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Certificate {
    /// Always "subcert".
    pub format: String,
    /// The version of the format.
    pub version: u32,
    /// What is proved.
    pub claim: Claim,
    /// An enclosure of cos(π/n), where the ring weight is irrational; of cos(π/(4n)) for eigensplines.
    pub cosine: Option<[String; 2]>,
    /// Sets of second differences, numbered from 1.
    pub bases: Vec<Vec<usize>>,
    /// The steps.
    pub steps: Vec<Step>,
}

/// What is proved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Claim {
    /// A two-sided enclosure of a constant.
    Constant(ConstantClaim),
    /// An inequality that holds.
    Inequality(NetInequality),
    /// A net that violates an inequality.
    Net(NetViolation),
    /// A closed mesh that violates one.
    Mesh(MeshViolation),
    /// Distances of eigensplines from their polyhedra.
    Eigensplines(EigensplineClaim),
    /// A characteristic map is an embedding.
    CharacteristicMap(CharacteristicMapClaim),
    /// The distance of the centre of every level.
    CentreDistance(CentreDistanceClaim),
}

/// A constant lies between lo and hi.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ConstantClaim {
    /// "loop", "catmull-clark" or "doo-sabin".
    pub scheme: String,
    /// Loop: "original" or "warren".
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub weights: Option<String>,
    /// The valence n; for Doo-Sabin the number of sides of the face.
    pub valence: u32,
    /// The level k.
    pub level: usize,
    /// The constant: "control", "limit", "rate", "mesh-rate", "coefficient", "beta".
    pub kind: String,
    /// "second", "first" or "face".
    pub norm: String,
    /// Which coefficient, for that kind.
    #[serde(skip_serializing_if = "Option::is_none", default)]
    pub at: Option<CoefficientAt>,
    /// Lower bound.
    pub lo: String,
    /// Upper bound.
    pub hi: String,
    /// The constant itself.
    pub exact: Option<Number>,
}

impl ConstantClaim {
    /// The name of the claim's file: scheme, weights, kind, norm if it is not the scheme's only one,
    /// valence, level, coefficient.
    pub fn file_name(&self) -> String {
        let at = match &self.at {
            Some(at) if at.word.is_empty() => format!("-at-face-{}", at.index),
            Some(at) => format!("-at-{}-{}", at.word, at.index),
            None => String::new(),
        };
        let weights = self.weights.as_ref();
        let weights = weights.map_or_else(String::new, |weights| format!("-{weights}"));
        let norm = match &*self.scheme {
            "catmull-clark" => format!("-{}", self.norm),
            _ => String::new(),
        };
        format!(
            "{}{weights}-{}{norm}-n{:02}-k{}{at}.json",
            self.scheme, self.kind, self.valence, self.level
        )
    }
}

/// A Bernstein coefficient over a word.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CoefficientAt {
    /// The word.
    pub word: String,
    /// The index, from 0.
    pub index: usize,
}

/// A rational, or the coefficients of a polynomial in β over q = 3 + 8 β.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Number {
    /// "p/q".
    Rational(String),
    /// `[c_0, c_1, ..]`.
    OverQ(Vec<String>),
}

impl Number {
    /// Whether it is a rational.
    pub fn is_rational(&self) -> bool {
        matches!(self, Number::Rational(_))
    }
}

/// A step.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "rule", rename_all = "lowercase", deny_unknown_fields)]
pub enum Step {
    /// The lower bound: a net and where it attains it.
    Attained {
        /// n + 6 rationals.
        net: Vec<String>,
        /// Where.
        at: Option<At>,
    },
    /// A bound of ‖S - F_0‖ over `0^depth`.
    Lemma {
        /// The depth J.
        depth: usize,
        /// The steps K.
        steps: usize,
        /// 0 or 1.
        order: u8,
        /// The bound.
        bound: Number,
        /// Order 1: the basis at the corner.
        corner: Option<usize>,
        /// The rings.
        cells: Vec<Cell>,
        /// By corner and sign, the bases of l = 1, 2, ..
        tail: Vec<[Vec<usize>; 2]>,
    },
    /// The conclusion for distances.
    Cover {
        /// The steps K.
        steps: usize,
        /// Index of the lemma among the steps.
        lemma: usize,
        /// The rings.
        cells: Vec<Cell>,
        /// As in a lemma.
        tail: Vec<[Vec<usize>; 2]>,
    },
    /// The conclusion for C_0 where a lemma says all.
    Apply {
        /// Index of the lemma among the steps.
        lemma: usize,
    },
    /// The conclusion for rates.
    Differences {
        /// Words with the bases of their differences.
        words: Vec<(String, Vec<usize>)>,
    },
    /// The lower bound of HW's β: for each coefficient of a tile a net, and where the quartic of their
    /// values is taken.
    #[serde(rename = "attained-tile")]
    AttainedTile {
        /// The tile.
        word: String,
        /// 15 nets.
        nets: Vec<Vec<String>>,
        /// First parameter.
        v: String,
        /// Second parameter.
        w: String,
    },
    /// The conclusion for HW's β: whole tiles, and a tail.
    Tiles {
        /// The steps K.
        steps: usize,
        /// Index of the lemma among the steps.
        lemma: usize,
        /// The tiles.
        cells: Vec<Cell>,
        /// As in a lemma.
        tail: Vec<[Vec<usize>; 2]>,
    },
    /// The conclusion for coefficients.
    Weight {
        /// The basis.
        basis: usize,
    },
    /// For each left side the indices of right sides, from 0, and what multiplies them.
    Combined {
        /// By left side.
        multipliers: Vec<Vec<(usize, String)>>,
    },
    /// A net for which a left side reaches the factor.
    Reached {
        /// The left side, from 0.
        left: usize,
        /// Rationals, one for each point of the local net.
        net: Vec<String>,
    },
    /// The net that violates the claim's inequality.
    Violated {
        /// Rationals, one for each point of the local net.
        net: Vec<String>,
    },
    /// Enclosures of the suprema over one ring, and over those nearer to the centre, of an eigenspline.
    Rings {
        /// By level of the facets.
        rings: Vec<RingStep>,
        /// The others.
        near: NearStep,
    },
    /// The characteristic map is regular and injective.
    Embedding {
        /// Quarterings that the sign of the Jacobian may need.
        splits: u32,
    },
    /// The third coordinate has one sign: nothing to add.
    Sign {},
    /// The claim's mesh violates LN's recurrence: nothing to add.
    Recurrence {},
    /// The claim's mesh violates LN's rate: nothing to add.
    Rate {},
    /// The surface is farther from the mesh at the middle of an edge than any vertex from its limit.
    Distance {
        /// The edge's vertices, from 1.
        edge: [usize; 2],
    },
}

/// Where a net attains a bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum At {
    /// A point of a part.
    Point {
        /// The part.
        word: String,
        /// First parameter.
        v: String,
        /// Second parameter.
        w: String,
    },
    /// A second difference of a part's net, from 1.
    Difference {
        /// The part.
        word: String,
        /// The difference.
        difference: usize,
    },
}

/// A part, its bases, the reason.
pub type Cell = (String, Bases, By);

/// One basis for all coefficients, or one for each.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum Bases {
    /// One.
    One(usize),
    /// One for each.
    Each(Vec<usize>),
}

/// Why a quartic is below a bound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum By {
    /// `"hull"` or `"regular"`.
    Plain(String),
    /// `["split", [BY, BY, BY, BY]]`.
    Split(String, Box<[By; 4]>),
    /// `["edge", e, s]`.
    Edge(String, usize, String),
    /// `["concave", v, w]`.
    Concave(String, String, String),
}

impl Certificate {
    /// A certificate without bases.
    pub fn of_inequality(claim: Claim, cosine: Option<[String; 2]>, steps: Vec<Step>) -> Self {
        Certificate {
            format: "subcert".into(),
            version: 1,
            claim,
            cosine,
            bases: Vec::new(),
            steps,
        }
    }

    /// A certificate of a violated inequality.
    pub fn of_violation(claim: Claim, cosine: Option<[String; 2]>, step: Step) -> Self {
        Self::of_inequality(claim, cosine, vec![step])
    }

    /// The name of its file; violations are named by those who know what is violated.
    pub fn file_name(&self) -> Option<String> {
        match &self.claim {
            Claim::Constant(claim) => Some(claim.file_name()),
            Claim::Eigensplines(claim) => Some(claim.file_name()),
            Claim::CharacteristicMap(claim) => Some(claim.file_name()),
            Claim::CentreDistance(claim) => Some(claim.file_name()),
            Claim::Inequality(_) | Claim::Net(_) | Claim::Mesh(_) => None,
        }
    }

    /// Writes the file, one step or basis on a line, so that files compare line by line.
    ///
    /// # Errors
    /// If writing fails.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let format = serde_json::to_string(&self.format)?;
        writeln!(out, "{{\"format\":{format},\"version\":{},", self.version)?;
        writeln!(out, "\"claim\":{},", serde_json::to_string(&self.claim)?)?;
        writeln!(out, "\"cosine\":{},", serde_json::to_string(&self.cosine)?)?;
        write_list(out, "bases", &self.bases)?;
        writeln!(out, ",")?;
        write_list(out, "steps", &self.steps)?;
        writeln!(out, "}}")
    }
}

fn write_list<T: Serialize>(out: &mut dyn Write, name: &str, list: &[T]) -> io::Result<()> {
    writeln!(out, "\"{name}\":[")?;
    for (i, item) in list.iter().enumerate() {
        let comma = if i + 1 < list.len() { "," } else { "" };
        writeln!(out, "{}{comma}", serde_json::to_string(item)?)?;
    }
    write!(out, "]")
}
