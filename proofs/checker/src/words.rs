//! The claim in words.

use num_rational::BigRational;

use crate::claim::{Claim, Constant, Kind, Norm, OfMesh, SchemeName, Setting, Weights};
use crate::covering::text;
use crate::file::{File, Value};
use crate::rational::{decimal, ratio};
use crate::spline_words;

/// The claim in words: scheme, weights, valence; level, kind, norm, lo, hi, exact; or the inequality.
pub fn in_words(file: &File) -> String {
    match &file.claim {
        Claim::Constant(claim) => constant(claim),
        Claim::Inequality(claim) => {
            let (factor, left, right) =
                (number(&claim.factor.0), claim.left.len(), claim.right.len());
            let scheme = setting(&claim.setting());
            format!(
                "{scheme}: |left_j(y)| <= {factor} max |right_i(y)|, j = 1..{left}, i = 1..{right}"
            )
        }
        Claim::Violation(claim) => {
            let (factor, right) = (number(&claim.factor.0), claim.right.len());
            let scheme = setting(&claim.setting());
            format!("{scheme}: |left(y)| <= {factor} max |right_i(y)|, i = 1..{right}, is false")
        }
        Claim::MeshViolation(claim) => {
            let (k, weights) = (claim.level, weights(claim.weights));
            let inequality = match claim.inequality {
                OfMesh::Recurrence => format!("M_{} <= rho M_{k}", k + 1),
                OfMesh::Rate => format!("M_{k} <= rho^{k} M_0"),
                OfMesh::Distance => "|S - F| <= M_0".to_string(),
            };
            let (points, faces) = (claim.vertices.len(), claim.faces.len());
            format!(
                "Loop, {weights} weights: {inequality} is false for a closed mesh of {points} vertices, {faces} faces"
            )
        }
        Claim::CharacteristicMap(claim) => spline_words::characteristic_map(claim),
        Claim::CentreDistance(claim) => {
            let middle = file.cosine.as_ref().map(|(lo, hi)| (&lo.0 + &hi.0) / ratio(2, 1));
            spline_words::centre_distance(claim, middle)
        }
        Claim::Eigensplines(claim) => spline_words::eigensplines(claim),
    }
}

/// The name of a variant of Loop's weights.
pub fn weights(weights: Weights) -> &'static str {
    match weights {
        Weights::Original => "original",
        Weights::Warren => "Warren's",
    }
}

/// The name of a scheme.
pub fn scheme_name(scheme: SchemeName) -> &'static str {
    match scheme {
        SchemeName::Loop => "Loop",
        SchemeName::CatmullClark => "Catmull-Clark",
        SchemeName::DooSabin => "Doo-Sabin",
    }
}

/// The scheme, the weights, the valence.
fn setting(setting: &Setting) -> String {
    let (n, name) = (setting.valence, scheme_name(setting.scheme));
    match (setting.scheme, setting.weights) {
        (_, Some(variant)) => format!("{name}, {} weights, valence {n}", weights(variant)),
        (SchemeName::DooSabin, _) => format!("{name}, a face of {n} sides"),
        _ => format!("{name}, valence {n}"),
    }
}

fn constant(claim: &Constant) -> String {
    let (n, k, scheme) = (claim.valence, claim.level, setting(&claim.setting()));
    let norm = match claim.norm {
        Norm::Second => "second differences",
        Norm::First => "first differences",
        Norm::Face => "second differences and the diameter of the face",
    };
    let centre = if claim.scheme == SchemeName::DooSabin { "face" } else { "vertex" };
    let constant = match (claim.kind, &claim.at) {
        (Kind::Control, _) => format!("distance to the control mesh, C_{k}({n})"),
        (Kind::Limit, _) => format!("distance to the limit mesh, B_{k}({n})"),
        (Kind::Rate, _) => format!("rate round the extraordinary {centre}, r_{k}({n})"),
        (Kind::MeshRate, _) => "rate of the whole mesh".to_string(),
        (Kind::Beta, _) => format!("bound of B_0({n}) by the method of HW"),
        (Kind::Coefficient, Some(at)) => format!(
            "coefficient {} over the word {} of S - F, F the limit mesh",
            at.index,
            text(&at.word.0)
        ),
        (Kind::Coefficient, None) => "coefficient".to_string(),
    };
    let exact = match &claim.exact {
        None => String::new(),
        Some(Value::Rational(r)) => format!(", exactly {}", number(&r.0)),
        Some(Value::OverQ(list)) => {
            let terms: Vec<_> =
                list.iter().enumerate().map(|(k, c)| format!("{} beta^{k}", c.0)).collect();
            format!(", exactly ({}) / (3 + 8 beta)", terms.join(" + "))
        }
    };
    let (lo, hi) = (number(&claim.lo.0), number(&claim.hi.0));
    format!("{scheme}, level {k}: {constant}, in {norm}, is from {lo} to {hi}{exact}")
}

/// A rational, with decimals if it is not an integer.
fn number(x: &BigRational) -> String {
    let written = x.to_string();
    match (x.is_integer(), written.len() > 24) {
        (true, _) => written,
        (false, true) => decimal(x, 12),
        (false, false) => format!("{written} = {}", decimal(x, 12)),
    }
}
