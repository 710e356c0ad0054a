//! What an examination of a paper finds, as data that knows no paper: tables, claims, plots,
//! certificates. [`crate::report::paper`] renders it.

use std::fmt;

use crate::certificate::Certificate;

/// What is found about a printed statement.
///
/// In the order of gravity: a statement about many numbers has the gravest verdict of its parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Verdict {
    /// True and best possible; a printed decimal is the constant itself, rounded.
    Sharp,
    /// True, and there is nothing to improve: an equation, an order, a count.
    True,
    /// A true bound that can be lowered to the value given.
    Loose,
    /// The computer did not decide.
    Undecided,
    /// The paper's own method gives another value.
    Misprint,
    /// False, by a net or by numbers.
    Refuted,
}

impl Verdict {
    /// All of them.
    pub const ALL: [Verdict; 6] = [
        Verdict::Sharp,
        Verdict::True,
        Verdict::Loose,
        Verdict::Undecided,
        Verdict::Misprint,
        Verdict::Refuted,
    ];

    /// The word for it.
    pub fn name(self) -> &'static str {
        match self {
            Verdict::Sharp => "sharp",
            Verdict::True => "true",
            Verdict::Loose => "loose",
            Verdict::Undecided => "undecided",
            Verdict::Misprint => "misprint",
            Verdict::Refuted => "refuted",
        }
    }

    /// What the word means.
    pub fn meaning(self) -> &'static str {
        match self {
            Verdict::Sharp => "true and best possible",
            Verdict::True => "true; no bound that could be lowered",
            Verdict::Loose => "a true bound that is not the best",
            Verdict::Undecided => "not decided by this program",
            Verdict::Misprint => "the paper's own method gives another value",
            Verdict::Refuted => "false: a counterexample or numbers are given",
        }
    }

    /// True, false or undecided, for statements without a best value.
    pub fn of(truth: Option<bool>) -> Self {
        match truth {
            Some(true) => Verdict::True,
            Some(false) => Verdict::Refuted,
            None => Verdict::Undecided,
        }
    }

    /// The gravest; `True` of none.
    pub fn gravest(verdicts: impl IntoIterator<Item = Verdict>) -> Self {
        verdicts.into_iter().max().unwrap_or(Verdict::True)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// A control net and where it does what a claim says it can't.
#[derive(Clone, Debug, PartialEq)]
pub struct Counterexample {
    /// The valence.
    pub valence: u32,
    /// The n + 6 control values, rationals, in Stam's order.
    pub net: Vec<String>,
    /// Where, and what happens there.
    pub what: String,
}

/// A statement of the paper and what became of it.
#[derive(Clone, Debug)]
pub struct Claim {
    /// A short name, unique in the paper.
    pub id: &'static str,
    /// Equation, table, theorem or section.
    pub place: &'static str,
    /// The statement in words, as printed.
    pub statement: String,
    /// What was found.
    pub verdict: Verdict,
    /// The values found, and how.
    pub found: String,
    /// What the paper's own method gives, where that differs from the print.
    pub method: Option<String>,
    /// For which valences and levels this was decided.
    pub scope: String,
    /// A net that shows it.
    pub counterexample: Option<Counterexample>,
    /// Names of certificate files.
    pub certificates: Vec<String>,
}

/// A table, already in words; every row has as many cells as there are heads.
#[derive(Clone, Debug)]
pub struct Table {
    /// A short name, unique in the paper.
    pub id: &'static str,
    /// What it shows.
    pub title: String,
    /// Heads of the columns.
    pub heads: Vec<&'static str>,
    /// Rows.
    pub rows: Vec<Vec<String>>,
    /// Remarks below it.
    pub notes: Vec<String>,
}

/// How a series of a plot is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// Points joined by lines.
    Line,
    /// Crosses: what is printed.
    Crosses,
}

/// A series of a plot.
#[derive(Clone, Debug)]
pub struct Series {
    /// Its name in the legend.
    pub name: String,
    /// How it is drawn.
    pub look: Look,
    /// Points.
    pub points: Vec<(f64, f64)>,
}

/// A plot.
#[derive(Clone, Debug)]
pub struct Plot {
    /// A short name, unique in the paper: the file's name without its ending.
    pub id: &'static str,
    /// What it shows.
    pub title: String,
    /// The axis to the right.
    pub x: &'static str,
    /// The axis upwards.
    pub y: &'static str,
    /// Whether the axis upwards is logarithmic.
    pub logarithmic: bool,
    /// What is drawn.
    pub series: Vec<Series>,
}

/// A broken line of a picture.
#[derive(Clone, Debug)]
pub struct Line {
    /// Its name in the legend, which lines share.
    pub name: &'static str,
    /// Points in the plane.
    pub points: Vec<(f64, f64)>,
}

/// A drawing to scale.
#[derive(Clone, Debug)]
pub struct Picture {
    /// A short name, unique in the paper: the file's name without its ending.
    pub id: &'static str,
    /// What it shows.
    pub title: String,
    /// What is drawn, the last on top.
    pub lines: Vec<Line>,
}

/// What an examination of a paper finds.
#[derive(Clone, Debug)]
pub struct Report {
    /// A short name, for files.
    pub id: &'static str,
    /// The paper.
    pub title: &'static str,
    /// Authors, place, year.
    pub source: &'static str,
    /// What the numbers mean, in a few sentences.
    pub preface: Vec<String>,
    /// Tables.
    pub tables: Vec<Table>,
    /// Claims.
    pub claims: Vec<Claim>,
    /// Plots.
    pub plots: Vec<Plot>,
    /// Drawings.
    pub pictures: Vec<Picture>,
    /// Certificates by file name, sorted.
    pub certificates: Vec<(String, Certificate)>,
}

impl Report {
    /// A claim by its name.
    pub fn claim(&self, id: &str) -> Option<&Claim> {
        self.claims.iter().find(|claim| claim.id == id)
    }

    /// A table by its name.
    pub fn table(&self, id: &str) -> Option<&Table> {
        self.tables.iter().find(|table| table.id == id)
    }

    /// How many claims have a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        let claims = self.claims.iter();
        claims.filter(|claim| claim.verdict == verdict).count()
    }
}
