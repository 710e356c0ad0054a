//! The claims that a formula stands or falls with, and what the examinations of [`crate::paper`] say of them.

use std::fmt;

/// A printed formula and its claims.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Basis {
    /// The formula's name in the paper.
    pub formula: &'static str,
    /// The paper: the `id` of its report.
    pub paper: &'static str,
    /// Claims of that report. A misprint that leaves a true bound does no harm.
    pub claims: &'static [&'static str],
    /// Whether none of these claims is refuted or undecided.
    pub holds: bool,
    /// A mesh that shows the contrary.
    pub counterexample: Option<&'static str>,
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let claims = self.claims.join(", ");
        let verdict = match self.holds {
            true => "proved",
            false => "refuted",
        };
        write!(f, "{} {verdict}: {} {claims}", self.formula, self.paper)?;
        match self.counterexample {
            Some(file) => write!(f, ", {file}"),
            None => Ok(()),
        }
    }
}

/// Corollary 2 on regular patches.
pub const COROLLARY_2_REGULAR: Basis = Basis {
    formula: "Corollary 2",
    paper: "lanquetin-neveu",
    claims: &["theorem-2-regular", "corollary-2-regular"],
    holds: true,
    counterexample: None,
};

/// Corollary 2 near extraordinary vertices.
pub const COROLLARY_2: Basis = Basis {
    formula: "Corollary 2",
    paper: "lanquetin-neveu",
    claims: &["theorem-2", "corollary-2"],
    holds: false,
    counterexample: None,
};

/// Corollary 3.
pub const COROLLARY_3: Basis = Basis {
    formula: "Corollary 3",
    paper: "lanquetin-neveu",
    claims: &["theorem-3-rate", "theorem-3-distance", "corollary-3"],
    holds: false,
    counterexample: Some("lanquetin-neveu-torus.obj"),
};

/// Corollary 5 where all faces have four sides and all vertices valence 4.
pub const COROLLARY_5_REGULAR: Basis = Basis {
    formula: "Corollary 5",
    paper: "lanquetin-neveu",
    claims: &["theorem-5", "corollary-5"],
    holds: true,
    counterexample: None,
};

/// Corollary 5 elsewhere: the remark that this is no restriction.
pub const COROLLARY_5: Basis = Basis {
    formula: "Corollary 5 beyond regular meshes",
    paper: "lanquetin-neveu",
    claims: &["not-a-restriction"],
    holds: false,
    counterexample: None,
};

/// Theorem 4, as "at most ε".
pub const THEOREM_4: Basis = Basis {
    formula: "Theorem 4",
    paper: "cheng-yong",
    claims: &["theorem-4"],
    holds: true,
    counterexample: None,
};

/// Theorem 9, with Theorem 4 for regular faces.
pub const THEOREM_9: Basis = Basis {
    formula: "Theorem 9",
    paper: "cheng-yong",
    claims: &["theorem-4", "theorem-6", "theorem-9"],
    holds: true,
    counterexample: None,
};

/// (16) with the printed C_3.
pub const EQ_16: Basis = Basis {
    formula: "(16) with C_3",
    paper: "huang-wang",
    claims: &[
        "regular-depth-control",
        "table-1-r1",
        "table-1-r2",
        "table-1-r3",
        "table-2-c3",
    ],
    holds: true,
    counterexample: None,
};

/// (14) with the printed β.
pub const EQ_14: Basis = Basis {
    formula: "(14) with β",
    paper: "huang-wang",
    claims: &[
        "regular-depth-limit",
        "table-1-r1",
        "table-1-r2",
        "table-1-r3",
        "table-2-beta",
        "level-bound",
    ],
    holds: true,
    counterexample: None,
};

/// All of them.
pub const ALL: [Basis; 9] = [
    COROLLARY_2_REGULAR,
    COROLLARY_2,
    COROLLARY_3,
    COROLLARY_5_REGULAR,
    COROLLARY_5,
    THEOREM_4,
    THEOREM_9,
    EQ_16,
    EQ_14,
];
