//! The claim as it is written: sections 3, 7 and 8 of FORMAT.md.

use std::ops::RangeInclusive;

use num_traits::Zero;
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny};
use serde_json::value::RawValue;

use crate::file::{Number, Value, Word, nullable, present};
use crate::reject::{Outcome, Rule, ensure};
use crate::scheme::Mesh;

const VALENCES: RangeInclusive<usize> = 3..=400;
/// Of Doo-Sabin, with its n (n - 1)/2 differences and n/2 cosines.
const SIDES: RangeInclusive<usize> = 3..=64;
const LEVELS: RangeInclusive<usize> = 0..=24;
const COEFFICIENTS: RangeInclusive<usize> = 1..=64;
/// The most forms on the right of an inequality.
const FORMS: usize = 4096;

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
    Inequality(Inequality),
    Violation(Violation),
    MeshViolation(MeshViolation),
    CharacteristicMap(CharacteristicMap),
    CentreDistance(CentreDistance),
    Eigensplines(Eigensplines),
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

/// `|left_j| <= factor max |right_i|` holds.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Inequality {
    pub scheme: SchemeName,
    /// Absent unless the scheme is Loop's.
    #[serde(default, deserialize_with = "present")]
    pub weights: Option<Weights>,
    pub valence: usize,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    pub left: Vec<Functional>,
    pub factor: Number,
    pub right: Vec<Functional>,
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
    pub inequality: OfMesh,
    pub level: usize,
    pub vertices: Vec<[Number; 3]>,
    /// Vertices from 1.
    pub faces: Vec<[usize; 3]>,
}

/// The inequalities about meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum OfMesh {
    Recurrence,
    Rate,
    Distance,
}

/// The characteristic map is regular and injective.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CharacteristicMap {
    pub scheme: SchemeName,
    pub valence: usize,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
}

/// The distance of the centre of every level to the surface.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CentreDistance {
    #[serde(rename = "scheme")]
    _scheme: LoopOnly,
    pub weights: Weights,
    pub valence: usize,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
}

/// The distances of eigensplines to meshes.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Eigensplines {
    #[serde(rename = "scheme")]
    _scheme: LoopOnly,
    pub weights: Weights,
    pub valence: usize,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    pub against: Mesh,
    pub modes: Vec<ModeClaim>,
}

/// An eigenspline, and lo and hi of its distance for each level.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModeClaim {
    pub family: Family,
    #[serde(deserialize_with = "nullable")]
    pub frequency: Option<usize>,
    pub distances: Vec<(Number, Number)>,
}

/// The families of eigenvectors of the two-ring.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Family {
    Ring,
    Ray,
    Between,
}

/// A claim, with the fields of its kind.
pub fn by_kind<'de, D: Deserializer<'de>>(source: D) -> Result<Claim, D::Error> {
    #[derive(serde::Deserialize)]
    struct Named {
        kind: String,
    }
    fn read<'a, T: Deserialize<'a>>(text: &'a str) -> serde_json::Result<T> {
        serde_json::from_str(text)
    }
    let text = <&RawValue>::deserialize(source)?.get();
    let claim = read::<Named>(text).and_then(|named| match &named.kind[..] {
        "inequality" => read(text).map(Claim::Inequality),
        "violation" => read(text).map(Claim::Violation),
        "mesh-violation" => read(text).map(Claim::MeshViolation),
        "characteristic-map" => read(text).map(Claim::CharacteristicMap),
        "centre-distance" => read(text).map(Claim::CentreDistance),
        "eigensplines" => read(text).map(Claim::Eigensplines),
        _ => read(text).map(Claim::Constant),
    });
    claim.map_err(|error| D::Error::custom(format!("in the claim: {error}")))
}

impl Claim {
    /// Checks that the scheme has what is claimed, and the limits.
    ///
    /// # Errors
    ///
    /// If and only if it has not, or a limit is exceeded: rule `format`.
    pub fn check(&self) -> Outcome<()> {
        match self {
            Self::Constant(claim) => {
                claim.setting().check()?;
                ensure!(claim.fits(), Rule::Format, "the scheme has no such kind or norm");
                level(claim.level)
            }
            Self::Inequality(claim) => {
                claim.setting().check()?;
                forms(claim.scheme, claim.left.iter().chain(&claim.right))
            }
            Self::Violation(claim) => {
                claim.setting().check()?;
                forms(claim.scheme, claim.right.iter().chain([&claim.left]))
            }
            Self::MeshViolation(claim) => level(claim.level),
            Self::CharacteristicMap(claim) => valence(claim.valence, VALENCES),
            Self::CentreDistance(claim) => valence(claim.valence, 4..=*VALENCES.end()),
            Self::Eigensplines(claim) => valence(claim.valence, VALENCES),
        }
    }
}

/// Checks the number of forms, and the meshes and levels in them.
fn forms<'a>(scheme: SchemeName, all: impl Iterator<Item = &'a Functional>) -> Outcome<()> {
    for (count, form) in all.enumerate() {
        ensure!(count < FORMS, Rule::Format, "more than {FORMS} forms");
        if let Functional::Against(form) = form {
            let mesh = form.against == Mesh::Control || scheme != SchemeName::DooSabin;
            ensure!(mesh, Rule::Format, "the scheme has no such mesh");
            level(form.level)?;
        }
    }
    Ok(())
}

fn level(level: usize) -> Outcome<()> {
    ensure!(LEVELS.contains(&level), Rule::Format, "the level is not within {LEVELS:?}");
    Ok(())
}

fn valence(valence: usize, range: RangeInclusive<usize>) -> Outcome<()> {
    ensure!(range.contains(&valence), Rule::Format, "the valence is not within {range:?}");
    Ok(())
}

impl Setting {
    fn check(&self) -> Outcome<()> {
        let range = if self.scheme == SchemeName::DooSabin { SIDES } else { VALENCES };
        valence(self.valence, range)?;
        let weights = self.weights.is_some() == (self.scheme == SchemeName::Loop);
        ensure!(weights, Rule::Format, "\"weights\" are for Loop's scheme and needed there");
        Ok(())
    }
}

impl Constant {
    /// Checks the form of a value.
    ///
    /// # Errors
    ///
    /// If and only if it is a list that the format does not allow: rule `format`.
    pub fn check_value(&self, value: &Value) -> Outcome<()> {
        if let Value::OverQ(list) = value {
            let ends = list.last().is_some_and(|last| !last.0.is_zero());
            let whole = ends && COEFFICIENTS.contains(&list.len());
            ensure!(whole, Rule::Format, "a list of coefficients ends with \"0\" or is too long");
            let polynomials = self.scheme == SchemeName::Loop;
            ensure!(polynomials, Rule::Format, "the values of this scheme are rationals");
        }
        Ok(())
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

/// The claims about one scheme and valence.
macro_rules! about_a_scheme {
    ($($claim:ty),+) => {
        $(impl $claim {
            pub fn setting(&self) -> Setting {
                Setting { scheme: self.scheme, weights: self.weights, valence: self.valence }
            }
        })+
    };
}
about_a_scheme!(Constant, Inequality, Violation);
