//! Rejections: the step, the rule by its stable name, and why.

use std::fmt;

/// The rules of FORMAT.md by which a file can be rejected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The file is not of the form of section 3, or exceeds a limit.
    Format,
    /// The claim is contradictory, or the steps given cannot prove one of its kind.
    Claim,
    /// The enclosure of cos(π/n).
    Cosine,
    /// A basis, or the citation of one.
    Bases,
    /// The lower bound.
    Attained,
    /// A lemma, apart from its cells and tail.
    Lemma,
    /// The conclusion `cover`, apart from its cells and tail.
    Cover,
    /// The conclusion `apply`.
    Apply,
    /// The conclusion `differences`.
    Differences,
    /// The conclusion `weight`.
    Weight,
    /// The lower bound of the method of HW.
    AttainedTile,
    /// The conclusion `tiles`, apart from its cells and tail.
    Tiles,
    /// A cell shown by its hull.
    CellHull,
    /// A cell shown by an edge.
    CellEdge,
    /// A cell shown by concavity.
    CellConcave,
    /// A cell shown by its quarters.
    CellSplit,
    /// A cell shown by the decay of second differences.
    CellRegular,
    /// The cells do not cover what they should, or one is superfluous.
    Covering,
    /// A tail.
    Tail,
}

impl Rule {
    /// The stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Format => "format",
            Self::Claim => "claim",
            Self::Cosine => "cosine",
            Self::Bases => "bases",
            Self::Attained => "attained",
            Self::Lemma => "lemma",
            Self::Cover => "cover",
            Self::Apply => "apply",
            Self::Differences => "differences",
            Self::Weight => "weight",
            Self::AttainedTile => "attained-tile",
            Self::Tiles => "tiles",
            Self::CellHull => "cell-hull",
            Self::CellEdge => "cell-edge",
            Self::CellConcave => "cell-concave",
            Self::CellSplit => "cell-split",
            Self::CellRegular => "cell-regular",
            Self::Covering => "covering",
            Self::Tail => "tail",
        }
    }
}

/// Why a certificate is rejected.
#[derive(Clone, Debug)]
pub struct Rejection {
    /// The index of the step, from 0; none if the fault is not in a step.
    pub step: Option<usize>,
    /// The rule that fails.
    pub rule: Rule,
    /// What fails in it.
    pub why: String,
}

impl Rejection {
    /// A rejection outside of the steps, or in one not known yet.
    pub fn new(rule: Rule, why: impl Into<String>) -> Self {
        Self { step: None, rule, why: why.into() }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let step = self.step.map(|step| format!("step {step}, ")).unwrap_or_default();
        write!(f, "rejected: {step}rule {}: {}", self.rule.name(), self.why)
    }
}

/// What checking something comes to.
pub type Outcome<T> = Result<T, Rejection>;

/// Returns a rejection by the rule, with a formatted reason, unless the condition holds.
macro_rules! ensure {
    ($condition:expr, $rule:expr, $($why:tt)+) => {
        if !$condition {
            return Err($crate::reject::Rejection::new($rule, format!($($why)+)));
        }
    };
}
pub(crate) use ensure;
