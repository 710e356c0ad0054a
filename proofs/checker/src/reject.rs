//! Rejections: the step, the rule by its stable name, and why.

use std::fmt;

/// The rules of FORMAT.md by which a file can be rejected; `Display` gives their stable names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// The file is not of the form of section 3, or exceeds a limit.
    Format,
    /// The claim is contradictory, or not one that the steps given can prove.
    Claim,
    /// The enclosure of cos(π/n).
    Cosine,
    /// The bases and their citations.
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
    /// A cell shown by its hull.
    CellHull,
    /// A cell shown by an edge.
    CellEdge,
    /// A cell shown by concavity.
    CellConcave,
    /// Cells that do not cover, or more than it takes.
    Covering,
    /// A tail.
    Tail,
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
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
            Self::CellHull => "cell-hull",
            Self::CellEdge => "cell-edge",
            Self::CellConcave => "cell-concave",
            Self::Covering => "covering",
            Self::Tail => "tail",
        })
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
    /// A rejection whose step is not known yet.
    pub fn new(rule: Rule, why: impl Into<String>) -> Self {
        Self {
            step: None,
            rule,
            why: why.into(),
        }
    }
}

impl fmt::Display for Rejection {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("rejected: ")?;
        if let Some(step) = self.step {
            write!(f, "step {step}, ")?;
        }
        write!(f, "rule {}: {}", self.rule, self.why)
    }
}

/// A step's outcome.
pub type Outcome<T> = Result<T, Rejection>;

/// `Ok` if the condition holds, else a rejection.
///
/// # Errors
///
/// If and only if the condition is false.
pub fn require(condition: bool, rule: Rule, why: impl FnOnce() -> String) -> Outcome<()> {
    if condition {
        Ok(())
    } else {
        Err(Rejection::new(rule, why()))
    }
}
