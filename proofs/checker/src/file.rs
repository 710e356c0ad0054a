//! The certificate as it is written: section 3 of FORMAT.md, with every limit of section 5.

use num_rational::BigRational;
use serde::de::{Deserialize, Deserializer, Error};

use crate::rational;
use crate::reject::{Outcome, Rule, require};

/// The largest file, in bytes.
pub const BYTES: usize = 64 << 20;
/// The most letters of a word, steps and depth of a lemma, and their sum.
pub const LETTERS: usize = 40;
const VALENCES: std::ops::RangeInclusive<usize> = 3..=400;
const LEVEL: usize = 8;
const COEFFICIENTS: usize = 64;

/// A rational in its one written form.
#[derive(Clone, Debug)]
pub struct Number(pub BigRational);

impl<'de> Deserialize<'de> for Number {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        let text = String::deserialize(source)?;
        rational::parse(&text).map(Number).map_err(D::Error::custom)
    }
}

/// A value: a rational r, or the coefficients of a polynomial in beta that is divided by q.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Value {
    /// The rational itself.
    Rational(Number),
    /// `(c_0 + c_1 beta + ..) / q`.
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
            return Err(D::Error::custom(
                "a word has at most 40 letters, each 0, 1, 2 or 3",
            ));
        }
        Ok(Self(letters))
    }
}

/// The index of a basis.
pub type Cite = usize;

/// A whole certificate.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    format: String,
    version: u32,
    /// What is claimed.
    pub claim: Claim,
    /// The enclosure of cos(π/n), or null.
    #[serde(deserialize_with = "nullable")]
    pub cosine: Option<(Number, Number)>,
    /// The bases, each an increasing list of indices from 1.
    pub bases: Vec<Vec<usize>>,
    /// The steps.
    pub steps: Vec<Step>,
}

/// The one scheme of version 1.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Scheme {
    /// Loop's scheme.
    Loop,
}

/// The variants of Loop's vertex mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Weights {
    /// Loop 1987.
    Original,
    /// Warren's.
    Warren,
}

/// The one norm of version 1.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Norm {
    /// The largest second difference.
    Second,
}

/// The kinds of constants.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The distance to the control mesh.
    Control,
    /// The distance to the limit mesh.
    Limit,
    /// The rate at which the differences round the extraordinary vertex shrink.
    Rate,
    /// The rate at which all differences shrink.
    MeshRate,
    /// One Bernstein coefficient.
    Coefficient,
}

/// A claim.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The scheme.
    pub scheme: Scheme,
    /// The weights.
    pub weights: Weights,
    /// The valence n.
    pub valence: usize,
    /// The level k.
    pub level: usize,
    /// The kind of constant.
    pub kind: Kind,
    /// The norm.
    pub norm: Norm,
    /// The lower bound.
    pub lo: Number,
    /// The upper bound.
    pub hi: Number,
    /// The constant itself, or null.
    #[serde(deserialize_with = "nullable")]
    pub exact: Option<Value>,
    /// Which coefficient; absent for the other kinds.
    #[serde(default, deserialize_with = "present")]
    pub at: Option<Coefficient>,
}

/// A Bernstein coefficient of a word.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Coefficient {
    /// The word.
    pub word: Word,
    /// The index from 0 to 14.
    pub index: usize,
}

/// A step.
#[derive(Debug, serde::Deserialize)]
#[serde(tag = "rule", rename_all = "lowercase")]
pub enum Step {
    /// The lower bound.
    Attained(Attained),
    /// A bound near the extraordinary vertex.
    Lemma(Lemma),
    /// The upper bound by cells and a lemma.
    Cover(Cover),
    /// The upper bound by a lemma.
    Apply(Apply),
    /// The upper bound of a rate.
    Differences(Differences),
    /// The upper bound of a coefficient.
    Weight(Weight),
}

/// A net and where it attains the lower bound.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Attained {
    /// The net.
    pub net: Vec<Number>,
    /// The place; null for a coefficient.
    #[serde(deserialize_with = "nullable")]
    pub at: Option<Place>,
}

/// Where a net attains the lower bound.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Place {
    /// At a point of the surface.
    Point(Point),
    /// In a second difference.
    Difference(Difference),
}

/// A point of the surface.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// The word.
    pub word: Word,
    /// The first parameter.
    pub v: Number,
    /// The second parameter.
    pub w: Number,
}

/// A second difference of the net of a word.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Difference {
    /// The word.
    pub word: Word,
    /// The index from 1.
    pub difference: usize,
}

/// A tail: for each corner, the bases for s = +1 and for s = -1.
pub type Tail = Vec<(Vec<Cite>, Vec<Cite>)>;

/// The step `lemma`.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Lemma {
    /// J.
    pub depth: usize,
    /// K.
    pub steps: usize,
    /// 0 or 1.
    pub order: u8,
    /// D.
    pub bound: Value,
    /// The basis at the corner, for order 1.
    #[serde(deserialize_with = "nullable")]
    pub corner: Option<Cite>,
    /// The cells.
    pub cells: Vec<Cell>,
    /// The tail.
    pub tail: Tail,
}

/// The step `cover`.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cover {
    /// K.
    pub steps: usize,
    /// The index of a lemma.
    pub lemma: usize,
    /// The cells.
    pub cells: Vec<Cell>,
    /// The tail.
    pub tail: Tail,
}

/// The step `apply`.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Apply {
    /// The index of a lemma.
    pub lemma: usize,
}

/// The step `differences`.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Differences {
    /// For each word, the bases of its differences.
    pub words: Vec<(Word, Vec<Cite>)>,
}

/// The step `weight`.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Weight {
    /// The basis.
    pub basis: Cite,
}

/// A cell: word, basis, and how it is shown.
pub type Cell = (Word, Cite, By);

/// How a cell is shown.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum By {
    /// By the hull of the coefficients.
    Hull(HullName),
    /// By an edge, opposite to a corner, and a parameter on it.
    Edge(EdgeName, usize, Number),
    /// By concavity, at a point.
    Concave(ConcaveName, Number, Number),
}

/// The word "hull".
#[derive(Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum HullName {
    /// The only one.
    Hull,
}

/// The word "edge".
#[derive(Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum EdgeName {
    /// The only one.
    Edge,
}

/// The word "concave".
#[derive(Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ConcaveName {
    /// The only one.
    Concave,
}

/// A field that must be there, with null allowed.
fn nullable<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    source: D,
) -> Result<Option<T>, D::Error> {
    Option::deserialize(source)
}

/// A field that may be absent, with null not allowed.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(
    source: D,
) -> Result<Option<T>, D::Error> {
    T::deserialize(source).map(Some)
}

/// Reads a certificate and checks its form and sizes.
///
/// # Errors
///
/// If and only if the text is not a certificate of version 1 within the limits: rule `format`.
pub fn read(bytes: &[u8]) -> Outcome<File> {
    require(bytes.len() <= BYTES, Rule::Format, || {
        "the file has more than 64 MiB".into()
    })?;
    let file: File = serde_json::from_slice(bytes)
        .map_err(|error| crate::reject::Rejection::new(Rule::Format, error.to_string()))?;
    require(
        file.format == "subcert" && file.version == 1,
        Rule::Format,
        || "not format \"subcert\", version 1".into(),
    )?;
    require(VALENCES.contains(&file.claim.valence), Rule::Format, || {
        "the valence is not from 3 to 400".into()
    })?;
    require(file.claim.level <= LEVEL, Rule::Format, || {
        format!("the level is above {LEVEL}")
    })?;
    let bounds = file.steps.iter().filter_map(|step| match step {
        Step::Lemma(lemma) => Some(&lemma.bound),
        _ => None,
    });
    for value in file.claim.exact.iter().chain(bounds) {
        if let Value::OverQ(list) = value {
            let whole = list.len() <= COEFFICIENTS
                && list.last().is_some_and(|c| c.0 != BigRational::default());
            require(whole, Rule::Format, || {
                "a value's list is empty, ends with \"0\" or has more than 64 entries".into()
            })?;
        }
    }
    Ok(file)
}
