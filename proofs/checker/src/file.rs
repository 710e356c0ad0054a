//! The certificate as it is written: section 3 of FORMAT.md.

use std::ops::RangeInclusive;

use num_rational::BigRational;
use num_traits::Zero;
use serde::de::{Deserialize, Deserializer, Error};

use crate::rational;
use crate::reject::{Outcome, Rejection, Rule, ensure};

/// The largest file, in bytes.
pub const BYTES: usize = 64 << 20;
/// The most letters of a word, and the most that the depth and the steps of a lemma come to.
pub const LETTERS: usize = 40;
const VALENCES: RangeInclusive<usize> = 3..=400;
const LEVELS: RangeInclusive<usize> = 0..=24;
const COEFFICIENTS: RangeInclusive<usize> = 1..=64;

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
    pub claim: Claim,
    #[serde(deserialize_with = "nullable")]
    pub cosine: Option<(Number, Number)>,
    /// Increasing lists of indices from 1.
    pub bases: Vec<Vec<usize>>,
    pub steps: Vec<Step>,
}

/// The one scheme of version 1.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scheme {
    Loop,
}

/// The variants of Loop's vertex mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Weights {
    Original,
    Warren,
}

/// The one norm of version 1.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Norm {
    Second,
}

/// The kinds of constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    Control,
    Limit,
    Rate,
    MeshRate,
    Beta,
    Coefficient,
}

#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    pub scheme: Scheme,
    pub weights: Weights,
    pub valence: usize,
    pub level: usize,
    pub kind: Kind,
    pub norm: Norm,
    pub lo: Number,
    pub hi: Number,
    #[serde(deserialize_with = "nullable")]
    pub exact: Option<Value>,
    /// Absent unless the kind is `coefficient`.
    #[serde(default, deserialize_with = "present")]
    pub at: Option<Coefficient>,
}

/// A Bernstein coefficient over a word.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coefficient {
    pub word: Word,
    pub index: usize,
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

/// A regular word, its bases, and how it is shown.
pub type Cell = (Word, Bases, By);

/// One basis for all fifteen functionals of a cell, or one for each.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Bases {
    One(Cite),
    Each([Cite; 15]),
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
fn nullable<'de, D: Deserializer<'de>, T: Deserialize<'de>>(source: D) -> Optional<T, D::Error> {
    Option::deserialize(source)
}

/// A field that may be absent, with null not allowed.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(source: D) -> Optional<T, D::Error> {
    T::deserialize(source).map(Some)
}

/// Reads a certificate and checks its form and sizes.
///
/// # Errors
///
/// If and only if the text is not a certificate of version 1 within the limits: rule `format`.
pub fn read(bytes: &[u8]) -> Outcome<File> {
    ensure!(bytes.len() <= BYTES, Rule::Format, "the file has more than 64 MiB");
    let wrong = |error: serde_json::Error| Rejection::new(Rule::Format, error.to_string());
    let file: File = serde_json::from_slice(bytes).map_err(wrong)?;
    let known = file.format == "subcert" && file.version == 1;
    ensure!(known, Rule::Format, "not format \"subcert\", version 1");
    let (n, level) = (file.claim.valence, file.claim.level);
    ensure!(VALENCES.contains(&n), Rule::Format, "the valence is not within {VALENCES:?}");
    ensure!(LEVELS.contains(&level), Rule::Format, "the level is not within {LEVELS:?}");
    let bounds = file.steps.iter().filter_map(|step| match step {
        Step::Lemma(lemma) => Some(&lemma.bound),
        _ => None,
    });
    for value in file.claim.exact.iter().chain(bounds) {
        if let Value::OverQ(list) = value {
            let ends = list.last().is_some_and(|last| !last.0.is_zero());
            let whole = ends && COEFFICIENTS.contains(&list.len());
            ensure!(whole, Rule::Format, "a list of coefficients ends with \"0\" or is too long");
        }
    }
    Ok(file)
}
