//! The claim and its steps as they are written, and the claim in words.

use num_rational::BigRational;
use num_traits::{Signed, Zero};
use serde::de::{Deserialize, Deserializer, Error, IgnoredAny};

use crate::claim::{SchemeName, Weights};
use crate::file::{Number, nullable, present};
use crate::rational::{decimal, ratio};
use crate::reject::{Outcome, Rule, ensure};
use crate::scheme::Mesh;

/// The most steps of refinement.
const LEVELS: usize = 8;
/// The most letters of a word.
const LETTERS: usize = 40;
/// The largest valence of an eigenspline.
const VALENCE: usize = 100;

/// The Hausdorff distance of a limit surface and a mesh is between lo and hi.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Hausdorff {
    pub scheme: SchemeName,
    /// Absent unless the scheme is Loop's.
    #[serde(default, deserialize_with = "present")]
    pub weights: Option<Weights>,
    #[serde(rename = "kind")]
    _kind: IgnoredAny,
    pub boundary: Boundary,
    pub vertices: Vec<[Number; 3]>,
    /// Vertices from 1.
    pub faces: Vec<Vec<usize>>,
    pub level: usize,
    pub against: Against,
    pub facets: Cut,
    #[serde(deserialize_with = "nullable")]
    pub other: Option<Other>,
    pub side: Side,
    pub lo: Number,
    pub hi: Number,
    #[serde(deserialize_with = "nullable")]
    pub vertex: Option<Number>,
    #[serde(deserialize_with = "nullable")]
    pub eigen: Option<Eigen>,
}

/// What is done at the boundary of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Boundary {
    Smooth,
    /// Boundary vertices of one face stay.
    Sharp,
    /// The surface has the faces whose corners are all interior.
    None,
}

/// The mesh F.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Against {
    Control,
    Limit,
    Other,
}

impl Against {
    /// The mesh of the surface itself, if it is that.
    pub fn own(self) -> Option<Mesh> {
        match self {
            Self::Control => Some(Mesh::Control),
            Self::Limit => Some(Mesh::Limit),
            Self::Other => None,
        }
    }
}

/// How polygons that are no triangles are filled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Cut {
    Triangles,
    Bilinear,
}

/// A mesh that is none of the surface's.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Other {
    pub vertices: Vec<[Number; 3]>,
    pub faces: Vec<Vec<usize>>,
}

/// From where the distance is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Side {
    SurfaceToMesh,
    MeshToSurface,
    Both,
}

/// The spline over the two-ring of a valence that the mesh is near to.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Eigen {
    pub valence: usize,
    pub frequency: usize,
    pub amplitude: Number,
    pub within: Number,
}

/// A part of a face, the letters up to the largest number of corners.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Letters(pub Vec<u8>);

impl<'de> Deserialize<'de> for Letters {
    fn deserialize<D: Deserializer<'de>>(source: D) -> Result<Self, D::Error> {
        let text = String::deserialize(source)?;
        let letters: Vec<u8> = text.bytes().map(|b| b.wrapping_sub(b'0')).collect();
        if letters.len() > LETTERS || letters.iter().any(|&letter| letter > 8) {
            return Err(D::Error::custom("a word has at most 40 letters, each a digit below 9"));
        }
        Ok(Self(letters))
    }
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Far {
    pub side: Side,
    pub at: Place,
}

/// The point that is far away.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum Place {
    Surface(Corner),
    Facet(OnFacet),
}

/// The limit of a corner of a part of a face.
#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Corner {
    pub face: usize,
    pub word: Letters,
    pub corner: usize,
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OnFacet {
    pub facet: usize,
    pub at: [Number; 2],
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearMesh {
    pub cells: Vec<(usize, Letters, NearFacet)>,
}

/// What a part of the surface is near to.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum NearFacet {
    Triangle(usize),
    Segment(usize, Box<[Number; 2]>, Box<[Number; 2]>),
    Match(Match),
}

#[derive(Debug, serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NearSurface {
    pub cells: Vec<(usize, Letters, NearPoint)>,
}

/// What a part of a facet is near to.
#[derive(Debug, serde::Deserialize)]
#[serde(untagged)]
pub enum NearPoint {
    Corner(usize, Letters, usize),
    Match(Match),
}

/// The part with the same parameters.
#[derive(Clone, Copy, Debug, serde::Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Match {
    Match,
}

impl Hausdorff {
    /// Checks that the scheme has what is claimed, and the limits; what contradicts itself is left to
    /// [`Self::check_sense`].
    ///
    /// # Errors
    ///
    /// If and only if it has not, or a limit is exceeded: rule `format`.
    pub fn check(&self) -> Outcome<()> {
        let rule = Rule::Format;
        ensure!(self.scheme != SchemeName::DooSabin, rule, "the scheme has no such kind");
        let weights = self.weights.is_some() == (self.scheme == SchemeName::Loop);
        ensure!(weights, rule, "\"weights\" are for Loop's scheme and needed there");
        ensure!(self.level <= LEVELS, rule, "the level is above {LEVELS}");
        let other = self.other.is_some() == (self.against == Against::Other);
        ensure!(other, rule, "\"other\" is for the mesh `other` and needed there");
        Ok(())
    }

    /// Checks that nothing in the claim contradicts the rest.
    ///
    /// # Errors
    ///
    /// If and only if something does: rule `claim`.
    pub fn check_sense(&self) -> Outcome<()> {
        let (rule, first) = (Rule::Claim, self.level == 0 && self.against == Against::Control);
        let ordered = !self.lo.0.is_negative() && self.lo.0 <= self.hi.0;
        ensure!(ordered, rule, "not 0 <= lo <= hi");
        let free =
            self.boundary != Boundary::None || (self.level == 0 && self.against != Against::Limit);
        ensure!(free, rule, "without boundary rule the level is 0, and there is no limit mesh");
        ensure!(
            self.vertex.is_none() || first,
            rule,
            "\"vertex\" is for the control mesh of level 0"
        );
        if let Some(eigen) = &self.eigen {
            let setting = self.scheme == SchemeName::Loop && self.boundary == Boundary::None;
            ensure!(
                setting && first,
                rule,
                "\"eigen\" is for Loop's control mesh of level 0, boundary `none`"
            );
            let (n, k) = (eigen.valence, eigen.frequency);
            ensure!(n <= VALENCE, Rule::Format, "the valence of \"eigen\" is above {VALENCE}");
            ensure!(2 <= k && 2 * k <= n, rule, "not 2 <= frequency <= n/2");
            ensure!(!eigen.within.0.is_negative(), rule, "\"within\" is below 0");
        }
        Ok(())
    }

    /// True for a side that the claim is about.
    pub fn has(&self, side: Side) -> bool {
        self.side == Side::Both || self.side == side
    }

    /// The claim in words.
    pub fn in_words(&self) -> String {
        let scheme = match self.weights {
            Some(Weights::Original) => "Loop, original weights",
            Some(Weights::Warren) => "Loop, Warren's weights",
            None => "Catmull-Clark",
        };
        let boundary = match self.boundary {
            Boundary::Smooth => "smooth boundary",
            Boundary::Sharp => "smooth boundary with sharp corners",
            Boundary::None => "over the faces with interior corners only",
        };
        let mesh = match self.against {
            Against::Control => format!("the control mesh of level {}", self.level),
            Against::Limit => format!("the limit mesh of level {}", self.level),
            Against::Other => {
                let count = self.other.as_ref().map_or(0, |other| other.faces.len());
                format!("another mesh of {count} faces")
            }
        };
        let cut = match self.facets {
            Cut::Triangles => "triangles",
            Cut::Bilinear => "bilinear patches",
        };
        let distance = match self.side {
            Side::SurfaceToMesh => "the one-sided Hausdorff distance from the limit surface to",
            Side::MeshToSurface => "the one-sided Hausdorff distance to the limit surface from",
            Side::Both => "the Hausdorff distance of the limit surface and",
        };
        let (points, faces) = (self.vertices.len(), self.faces.len());
        let (lo, hi) = (shown(&self.lo.0), shown(&self.hi.0));
        let eigen = self.eigen_in_words();
        let vertex = self.vertex_in_words();
        format!(
            "{scheme}, {boundary}, a mesh of {points} vertices, {faces} faces: {distance} {mesh}, facets {cut}, is from {lo} to {hi}{eigen}{vertex}"
        )
    }

    fn eigen_in_words(&self) -> String {
        self.eigen.as_ref().map_or_else(String::new, |eigen| {
            format!(
                "; with {} to spare, so it is for the spline over S_{} of frequency {}, amplitude {}",
                shown(&self.spare()),
                eigen.valence,
                eigen.frequency,
                shown(&eigen.amplitude.0)
            )
        })
    }

    /// What `vertex` says: only where it says something, if need be of the exact eigenspline too.
    fn vertex_in_words(&self) -> String {
        let Some(Number(vertex)) = &self.vertex else { return String::new() };
        let spare = self.spare();
        let verdict = if vertex + &spare < &self.lo.0 - &spare {
            ", below it: the vertex heuristic is no bound"
        } else {
            ""
        };
        let bound = shown(vertex);
        format!("; each vertex is within {bound} of its limit{verdict}")
    }

    /// Four times `within`: how far any of the distances can be from that of the exact eigenspline.
    fn spare(&self) -> BigRational {
        self.eigen.as_ref().map_or_else(BigRational::zero, |eigen| &eigen.within.0 * ratio(4, 1))
    }
}

/// Decimals, as many as a small number needs.
fn shown(x: &BigRational) -> String {
    let told = |text: &String| text.contains(|c: char| ('1'..='9').contains(&c));
    let places = [12, 24, 60].map(|places| decimal(x, places));
    places.iter().find(|text| told(text)).unwrap_or(&places[0]).clone()
}
