//! The certificate as it is written: sections 3 and 7 of FORMAT.md.

use std::ops::RangeInclusive;

use num_rational::BigRational;
use num_traits::Zero;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny};
use serde_json::value::RawValue;

use crate::rational;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::scheme::Mesh;

/// The largest file, in bytes.
pub const BYTES: usize = 64 << 20;
/// The most letters of a word, and the most that the depth and the steps of a lemma come to.
pub const LETTERS: usize = 40;
const VALENCES: RangeInclusive<usize> = 3..=400;
/// Of Doo-Sabin, with its n (n - 1)/2 differences and n/2 cosines.
const SIDES: RangeInclusive<usize> = 3..=64;
const LEVELS: RangeInclusive<usize> = 0..=24;
const COEFFICIENTS: RangeInclusive<usize> = 1..=64;
/// The most forms on the right of an inequality.
const FORMS: usize = 4096;

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

/// The schemes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SchemeName {
    Loop,
    CatmullClark,
    DooSabin,
}

/// The variants of Loop's vertex mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Weights {
    Original,
    Warren,
}

/// The norms; `second` is the only one of Loop's scheme, `face` that of Doo-Sabin.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Norm {
    Second,
    First,
    Face,
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

/// What a file claims, by its kind.
#[derive(Clone, Debug)]
pub enum Claim {
    Constant(Constant),
    Violation(Violation),
    MeshViolation(MeshViolation),
}

/// The scheme that a claim is about.
#[derive(Clone, Copy, Debug)]
pub struct Setting {
    pub scheme: SchemeName,
    /// For Loop's scheme.
    pub weights: Option<Weights>,
    pub valence: usize,
}

/// A constant is between lo and hi.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Constant {
    pub scheme: SchemeName,
    /// Absent unless the scheme is Loop's.
    #[serde(default, deserialize_with = "present")]
    pub weights: Option<Weights>,
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

/// `|left| <= factor max |right_i|` is false.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Violation {
    pub scheme: SchemeName,
    /// Absent unless the scheme is Loop's.
    #[serde(default, deserialize_with = "present")]
    pub weights: Option<Weights>,
    pub valence: usize,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    pub left: Functional,
    pub factor: Number,
    pub right: Vec<Functional>,
}

/// A linear functional of the first net.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Functional {
    Terms(Terms),
    Against(Against),
}

/// A combination of points of the net of a word, labels from 1.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Terms {
    pub word: Word,
    pub terms: Vec<(usize, Number)>,
}

/// The difference of the surface and a mesh at a point of a word.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Against {
    pub word: Word,
    pub against: Mesh,
    pub level: usize,
    pub at: (Number, Number),
}

/// The one scheme of [`MeshViolation`].
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LoopOnly {
    Loop,
}

/// An inequality is false for a closed mesh.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MeshViolation {
    #[serde(rename = "scheme")]
    _scheme: LoopOnly,
    pub weights: Weights,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    pub inequality: Inequality,
    pub level: usize,
    pub vertices: Vec<[Number; 3]>,
    /// Vertices from 1.
    pub faces: Vec<[usize; 3]>,
}

/// The inequalities about meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Inequality {
    Recurrence,
    Rate,
    Distance,
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
    Violated(Violated),
    Recurrence(Nothing),
    Rate(Nothing),
    Distance(Distance),
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
fn nullable<'de, D: Deserializer<'de>, T: Deserialize<'de>>(source: D) -> Optional<T, D::Error> {
    Option::deserialize(source)
}

/// A field that may be absent, with null not allowed.
fn present<'de, D: Deserializer<'de>, T: Deserialize<'de>>(source: D) -> Optional<T, D::Error> {
    T::deserialize(source).map(Some)
}

/// A claim, with the fields of its kind.
fn by_kind<'de, D: Deserializer<'de>>(source: D) -> Result<Claim, D::Error> {
    #[derive(serde::Deserialize)]
    struct Named {
        kind: String,
    }
    fn read<'a, T: Deserialize<'a>>(text: &'a str) -> serde_json::Result<T> {
        serde_json::from_str(text)
    }
    let text = <&RawValue>::deserialize(source)?.get();
    let claim = read::<Named>(text).and_then(|named| match &named.kind[..] {
        "violation" => read(text).map(Claim::Violation),
        "mesh-violation" => read(text).map(Claim::MeshViolation),
        _ => read(text).map(Claim::Constant),
    });
    claim.map_err(|error| D::Error::custom(format!("in the claim: {error}")))
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
    match &file.claim {
        Claim::Constant(claim) => {
            claim.setting().check()?;
            level(claim.level)?;
            ensure!(claim.fits(), rule, "the scheme has no such kind or norm");
            let bounds = file.steps.iter().filter_map(|step| match step {
                Step::Lemma(lemma) => Some(&lemma.bound),
                _ => None,
            });
            for value in claim.exact.iter().chain(bounds) {
                if let Value::OverQ(list) = value {
                    let ends = list.last().is_some_and(|last| !last.0.is_zero());
                    let whole = ends && COEFFICIENTS.contains(&list.len());
                    ensure!(whole, rule, "a list of coefficients ends with \"0\" or is too long");
                    let polynomials = claim.scheme == SchemeName::Loop;
                    ensure!(polynomials, rule, "the values of this scheme are rationals");
                }
            }
        }
        Claim::Violation(claim) => {
            claim.setting().check()?;
            ensure!(claim.right.len() <= FORMS, rule, "more than {FORMS} forms");
            for form in claim.right.iter().chain([&claim.left]) {
                if let Functional::Against(form) = form {
                    level(form.level)?;
                    let missing =
                        form.against == Mesh::Limit && claim.scheme == SchemeName::DooSabin;
                    ensure!(!missing, rule, "the scheme has no such mesh");
                }
            }
        }
        Claim::MeshViolation(claim) => level(claim.level)?,
    }
    Ok(file)
}

fn level(level: usize) -> Outcome<()> {
    ensure!(LEVELS.contains(&level), Rule::Format, "the level is not within {LEVELS:?}");
    Ok(())
}

impl Setting {
    fn check(&self) -> Outcome<()> {
        let range = if self.scheme == SchemeName::DooSabin { SIDES } else { VALENCES };
        let within = range.contains(&self.valence);
        ensure!(within, Rule::Format, "the valence is not within {range:?}");
        let weights = self.weights.is_some() == (self.scheme == SchemeName::Loop);
        ensure!(weights, Rule::Format, "\"weights\" are for Loop's scheme and needed there");
        Ok(())
    }
}

impl Constant {
    pub fn setting(&self) -> Setting {
        Setting { scheme: self.scheme, weights: self.weights, valence: self.valence }
    }

    /// True if the scheme has the norm and the kind.
    fn fits(&self) -> bool {
        use Kind::{Control, Limit, MeshRate, Rate};
        match (self.scheme, self.norm) {
            (SchemeName::Loop, Norm::Second) => true,
            (SchemeName::CatmullClark, Norm::Second | Norm::First) => {
                matches!(self.kind, Control | Limit | Rate | MeshRate)
            }
            (SchemeName::DooSabin, Norm::Face) => matches!(self.kind, Control | Rate),
            _ => false,
        }
    }
}

impl Violation {
    pub fn setting(&self) -> Setting {
        Setting { scheme: self.scheme, weights: self.weights, valence: self.valence }
    }
}
