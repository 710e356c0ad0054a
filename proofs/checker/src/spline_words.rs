//! The claims about eigensplines in words.

use num_rational::BigRational;

use crate::claim::{CentreDistance, CharacteristicMap, Eigensplines, Family};
use crate::cosine::rational_beta;
use crate::rational::{decimal, ratio};
use crate::scheme::Mesh;
use crate::words::{scheme_name, weights};

/// The decimals shown.
const PLACES: u32 = 9;

/// The characteristic map is regular and injective.
pub fn characteristic_map(claim: &CharacteristicMap) -> String {
    let (scheme, n) = (scheme_name(claim.scheme), claim.valence);
    format!(
        "{scheme}, valence {n}: the characteristic map is injective, with a positive Jacobian but at the centre"
    )
}

/// The distance of the centre, by beta; `cosine` is near cos(π/(4n)), for reading only.
pub fn centre_distance(claim: &CentreDistance, cosine: Option<BigRational>) -> String {
    let n = claim.valence;
    let one = BigRational::from_integer(1.into());
    let double = |x: BigRational| &x * &x * ratio(2, 1) - &one;
    let irrational = || {
        let inner = ratio(3, 8) + double(double(double(cosine?))) * ratio(1, 4);
        Some(ratio(5, 8) - &inner * &inner)
    };
    let (beta, exact) = match rational_beta(claim.weights, n) {
        Some(beta) => (Some(beta), true),
        None => (irrational(), false),
    };
    let h = |beta: &BigRational| beta * ratio(8, 3);
    let numbers = beta.map_or(String::new(), |beta| match (h(&beta), ratio(5, 8) - beta) {
        (h, lambda) if exact => format!(" = {h} * ({lambda})^m"),
        (h, lambda) => format!(" = {} * ({})^m", decimal(&h, PLACES), decimal(&lambda, PLACES)),
    });
    format!(
        "Loop, {} weights, valence {n}: over the characteristic map with the eigenvector of centre h = 8 beta/3 and ring -1, for every m >= 0 the centre of the level-m control mesh is at distance exactly h lambda^m{numbers} from the surface, lambda = 5/8 - beta",
        weights(claim.weights)
    )
}

/// The distances of eigensplines, mode by mode.
pub fn eigensplines(claim: &Eigensplines) -> String {
    let mesh = match claim.against {
        Mesh::Control => "control",
        Mesh::Limit => "limit",
    };
    let modes = claim.modes.iter().map(|mode| {
        let family = match mode.family {
            Family::Ring => "ring",
            Family::Ray => "ray",
            Family::Between => "between",
        };
        let frequency = mode.frequency.map_or(String::new(), |k| format!(" {k}"));
        let each = mode
            .distances
            .iter()
            .map(|(lo, hi)| format!("{} to {}", decimal(&lo.0, PLACES), decimal(&hi.0, PLACES)));
        format!("{family}{frequency} from {}", each.collect::<Vec<_>>().join(", "))
    });
    format!(
        "Loop, {} weights, valence {}: distances of eigensplines, read over the characteristic map, to the {mesh} meshes of levels 0, 1, ..: {}",
        weights(claim.weights),
        claim.valence,
        modes.collect::<Vec<_>>().join("; ")
    )
}
