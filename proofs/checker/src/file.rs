//! The certificate as it is written: sections 3 and 7 of FORMAT.md.

use num_rational::BigRational;
use serde::de::{Deserialize, Deserializer, Error};

use crate::claim::{Claim, by_kind};
use crate::rational;
use crate::reject::{Outcome, Rejection, Rule, ensure};

/// The largest file, in bytes.
pub const BYTES: usize = 64 << 20;
/// The most letters of a word, and the most that the depth and the steps of a lemma come to.
pub const LETTERS: usize = 40;

/// A rational in its one written form.
#[derive(Clone, Debug)]
pub struct Number(pub BigRational);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        let text = String::deserialize(source)?;
        rational::parse(&text).map(Number).map_err(D::Error::custom)
    }
}

/// A rational, or the coefficients of a polynomial in beta that is divided by q.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Value {
    Rational(Number),
    OverQ(Vec<Number>),
}

/// A word over 0, 1, 2, 3.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Word(pub Vec<u8>);

impl<'de> Deserialize<'de> for Word {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        let text = String::deserialize(source)?;
        let letters: Vec<u8> = text.bytes().map(|b| b.wrapping_sub(b'0')).collect();
        if letters.len() > LETTERS || letters.iter().any(|&letter| letter > 3) {
            return Err(D::Error::custom("a word has at most 40 letters, each 0, 1, 2 or 3"));
        }
        Ok(Self(letters))
    }
}

/// The index of a basis, from 0.
pub type Cite = usize;

/// A whole certificate.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    format: String,
    version: u32,
    #[serde(deserialize_with = "by_kind")]
    pub claim: Claim,
    #[serde(deserialize_with = "nullable")]
    pub cosine: Option<(Number, Number)>,
    /// Increasing lists of indices from 1.
    pub bases: Vec<Vec<usize>>,
    pub steps: Vec<Step>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(tag = "rule", rename_all = "kebab-case")]
pub enum Step {
    Attained(Attained),
    AttainedTile(AttainedTile),
    Lemma(Lemma),
    Cover(Cover),
    Tiles(Cover),
    Apply(Apply),
    Differences(Differences),
    Weight(Weight),
    Combined(Combined),
    Reached(Reached),
    Violated(Violated),
    Recurrence(Nothing),
    Rate(Nothing),
    Distance(Distance),
    Embedding(Embedding),
    Sign(Nothing),
    Rings(Rings),
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Attained {
    pub net: Vec<Number>,
    #[serde(deserialize_with = "nullable")]
    pub at: Option<Place>,
}

/// Where a net attains the lower bound.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Place {
    Point(Point),
    Difference(Difference),
}

/// A point of the surface.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    pub word: Word,
    pub v: Number,
    pub w: Number,
}

/// A second difference of the net of a word, its index from 1.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Difference {
    pub word: Word,
    pub difference: usize,
}

/// A net for each Bernstein coefficient over the tile, and a point of it.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AttainedTile {
    pub word: Word,
    pub nets: Vec<Vec<Number>>,
    pub v: Number,
    pub w: Number,
}

/// For each corner, the bases for s = +1 and for s = -1.
pub type Tail = Vec<(Vec<Cite>, Vec<Cite>)>;

/// J is `depth`, K is `steps`, D is `bound`.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lemma {
    pub depth: usize,
    pub steps: usize,
    pub order: u8,
    pub bound: Value,
    #[serde(deserialize_with = "nullable")]
    pub corner: Option<Cite>,
    pub cells: Vec<Cell>,
    pub tail: Tail,
}

/// The same for the faces' parts and for whole tiles.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cover {
    pub steps: usize,
    pub lemma: usize,
    pub cells: Vec<Cell>,
    pub tail: Tail,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Apply {
    pub lemma: usize,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Differences {
    pub words: Vec<(Word, Vec<Cite>)>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Weight {
    pub basis: Cite,
}

/// For each left side, indices of right sides and what multiplies them.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Combined {
    pub multipliers: Vec<Vec<(usize, Number)>>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reached {
    pub left: usize,
    pub net: Vec<Number>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Violated {
    pub net: Vec<Number>,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Nothing {}

/// An edge, its vertices from 1.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Distance {
    pub edge: [usize; 2],
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Embedding {
    pub splits: usize,
}

/// The enclosures of D_0, .., D_M and of N.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rings {
    pub rings: Vec<Ring>,
    pub near: Near,
}

/// lo is reached at a point of ring 0.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ring {
    pub lo: Number,
    pub hi: Number,
    pub at: Spot,
}

/// lo is reached at a point of another ring, or at the centre; the rings 1..depth are looked at.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Near {
    pub lo: Number,
    pub hi: Number,
    #[serde(deserialize_with = "nullable")]
    pub at: Option<NearSpot>,
    pub depth: usize,
}

/// A point of a patch of ring 0.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Spot {
    pub sector: usize,
    pub triangle: [i64; 3],
    pub point: (Number, Number),
}

/// A point of a patch of ring 0, scaled to another ring.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearSpot {
    pub ring: usize,
    pub sector: usize,
    pub triangle: [i64; 3],
    pub point: (Number, Number),
}

/// A regular word, its bases, and how it is shown.
pub type Cell = (Word, Bases, By);

/// One basis for all functionals of a cell, or one for each.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Bases {
    One(Cite),
    Each(Vec<Cite>),
}

/// How a cell is shown; whether the name is that of the form, `cells` finds out.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum By {
    Alone(Name),
    Edge(Name, usize, Number),
    Concave(Name, Number, Number),
    Split(Name, Box<[By; 4]>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Name {
    Hull,
    Edge,
    Concave,
    Split,
    Regular,
}

type Optional<T, E> = Result<Option<T>, E>;

/// A field that must be there, with null allowed.
pub fn nullable<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    source: D,
) -> Optional<T, D::Error> {
    Option::deserialize(source)
}

/// A field that may be absent, with null not allowed.
pub fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(source: D) -> Optional<T, D::Error> {
    T::deserialize(source).map(Some)
}

/// Reads a certificate and checks its form and sizes.
///
/// # Errors
///
/// If and only if the text is not a certificate of version 1 within the limits: rule `format`.
pub fn read(bytes: &[u8]) -> Outcome<File> {
    let rule = Rule::Format;
    ensure!(bytes.len() <= BYTES, rule, "the file has more than 64 MiB");
    let wrong = |error: serde_json::Error| Rejection::new(rule, error.to_string());
    let file: File = serde_json::from_slice(bytes).map_err(wrong)?;
    let known = file.format == "subcert" && file.version == 1;
    ensure!(known, rule, "not format \"subcert\", version 1");
    file.claim.check()?;
    if let Claim::Constant(claim) = &file.claim {
        let bounds = file.steps.iter().filter_map(|step| match step {
            Step::Lemma(lemma) => Some(&lemma.bound),
            _ => None,
        });
        claim.exact.iter().chain(bounds).try_for_each(|value| claim.check_value(value))?;
    }
    Ok(file)
}
