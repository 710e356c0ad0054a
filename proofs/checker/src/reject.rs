//! Rejections: the step, the rule by its stable name, and why.

use std::fmt;

/// Defines the rules with their names.
macro_rules! rules {
    ($($(#[$doc:meta])* $rule:ident = $name:literal,)+) => {
        /// The rules of FORMAT.md by which a file can be rejected.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Rule { $($(#[$doc])* $rule,)+ }

        impl Rule {
            /// The stable name.
            pub fn name(self) -> &'static str {
                match self { $(Self::$rule => $name,)+ }
            }
        }
    };
}

rules! {
    /// The file is not of the form of section 3, or exceeds a limit.
    Format = "format",
    /// The claim is contradictory, or the steps given cannot prove one of its kind.
    Claim = "claim",
    /// The enclosure of cos(π/n).
    Cosine = "cosine",
    /// A basis, or the citation of one.
    Bases = "bases",
    /// The lower bound.
    Attained = "attained",
    /// A lemma, apart from its cells and tail.
    Lemma = "lemma",
    /// The conclusion `cover`, apart from its cells and tail.
    Cover = "cover",
    /// The conclusion `apply`.
    Apply = "apply",
    /// The conclusion `differences`.
    Differences = "differences",
    /// The conclusion `weight`.
    Weight = "weight",
    /// The lower bound of the method of HW.
    AttainedTile = "attained-tile",
    /// The conclusion `tiles`, apart from its cells and tail.
    Tiles = "tiles",
    /// A cell shown by its hull.
    CellHull = "cell-hull",
    /// A cell shown by an edge.
    CellEdge = "cell-edge",
    /// A cell shown by concavity.
    CellConcave = "cell-concave",
    /// A cell shown by its quarters.
    CellSplit = "cell-split",
    /// A cell shown by the decay of second differences.
    CellRegular = "cell-regular",
    /// The cells do not cover what they should, or one is superfluous.
    Covering = "covering",
    /// A tail.
    Tail = "tail",
    /// An inequality about nets, by multipliers.
    Combined = "combined",
    /// That no smaller factor will do.
    Reached = "reached",
    /// A violated inequality about nets.
    Violated = "violated",
    /// A mesh that is not closed, or too large.
    Mesh = "mesh",
    /// The inequality of that name about meshes holds.
    Recurrence = "recurrence",
    /// The inequality of that name about meshes holds.
    Rate = "rate",
    /// The inequality of that name about meshes holds.
    Distance = "distance",
    /// The characteristic map.
    Embedding = "embedding",
    /// The eigenvector of centre-distance.
    Sign = "sign",
    /// The distances of an eigenspline.
    Rings = "rings",
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
