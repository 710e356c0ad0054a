//! Distances, characteristic maps and centres as certificates: section 9 of `proofs/FORMAT.md`.

use super::mode::{CHAINED, Label, ModeFamily, Net, nets};
use super::{Against, Enclosed, ModeDistances, SplinePoint, distances_of};
use crate::certificate::{
    CentreDistanceClaim, Certificate, CharacteristicMapClaim, Claim, EigensplineClaim, ModeClaim,
    NearStep, RingStep, SplineAt, Step,
};
use crate::scalar::{Field, Interval, Rational, cosine};
use crate::scheme::{LoopWeights, Scheme};

/// Bits of the enclosure of cos(π/(4n)).
const COSINE_BITS: u32 = 84;

/// An enclosure of cos(π/(4n)), which the numbers of section 9 are made of.
///
/// # Panics
/// If n = 0.
pub fn cosine_of_eigensplines(n: u32) -> [String; 2] {
    // 2 cos(π/(4n)) = 2 cos(2π/(8n)), halved; irrational for n >= 1, so no end is the number itself.
    let twice = cosine::enclose_two_cos(1, 8 * n, COSINE_BITS).expect("n is positive");
    let half = |x: Rational| (x * <Rational as Field>::ratio(1, 2)).to_string();
    [half(twice.inf_rational()), half(twice.sup_rational())]
}

/// The distances μ_0 .. μ_levels as a certificate, of the modes of [`own_modes`].
///
/// `None` and panics as [`super::distances`].
pub fn eigensplines(
    weights: LoopWeights,
    n: u32,
    against: Against,
    levels: usize,
) -> Option<Certificate> {
    let found = own_modes(weights, n, against, levels)?;
    Some(certificate(weights, n, against, &found))
}

/// The distances of the modes whose certificates name these weights: all for `original`; for `warren` the
/// mode `ring` of frequency 0 (n = 3: and the one that its chain leads to), as the others are the same,
/// and at n = 3 and n = 6 that one too.
///
/// `None` and panics as [`super::distances`].
pub fn own_modes(
    weights: LoopWeights,
    n: u32,
    against: Against,
    levels: usize,
) -> Option<Vec<ModeDistances>> {
    let (chi, modes) = nets::<Interval>(weights, n)?;
    let kept = modes
        .into_iter()
        .filter(|net| is_own(weights, n, net.label));
    let kept: Vec<Net<Interval>> = kept.collect();
    distances_of(n, &chi, &kept, against, levels)
}

/// Whether the file of these weights holds a mode.
fn is_own(weights: LoopWeights, n: u32, label: Label) -> bool {
    let centre = Label {
        family: ModeFamily::Ring,
        frequency: Some(0),
    };
    weights == LoopWeights::Original || label == centre || (n == 3 && label == CHAINED)
}

/// Distances that are known as a certificate.
pub fn certificate(
    weights: LoopWeights,
    n: u32,
    against: Against,
    found: &[ModeDistances],
) -> Certificate {
    let claim = EigensplineClaim {
        scheme: "loop".into(),
        weights: weights.to_string(),
        valence: n,
        kind: "eigensplines".into(),
        against: against.to_string(),
        modes: found.iter().map(mode_claim).collect(),
    };
    let step = |mode: &ModeDistances| Step::Rings {
        rings: mode.rings.iter().map(ring_step).collect(),
        near: NearStep {
            lo: mode.near.lo.to_string(),
            hi: mode.near.hi.to_string(),
            at: mode.near.place.as_ref().map(|place| SplineAt {
                ring: Some(place.ring),
                ..spline_at(place)
            }),
            depth: mode.depth,
        },
    };
    let steps = found.iter().map(step).collect();
    Certificate::of_inequality(
        Claim::Eigensplines(claim),
        Some(cosine_of_eigensplines(n)),
        steps,
    )
}

fn mode_claim(mode: &ModeDistances) -> ModeClaim {
    let bounds = |[lo, hi]: &[Rational; 2]| [lo.to_string(), hi.to_string()];
    ModeClaim {
        family: mode.label.family.to_string(),
        frequency: mode.label.frequency,
        distances: mode.distances.iter().map(bounds).collect(),
    }
}

fn ring_step(ring: &Enclosed) -> RingStep {
    RingStep {
        lo: ring.lo.to_string(),
        hi: ring.hi.to_string(),
        at: ring.place.as_ref().map_or_else(corner, spline_at),
    }
}

/// A point for a bound of 0, which any point shows.
fn corner() -> SplineAt {
    SplineAt {
        ring: None,
        sector: 0,
        triangle: [1, 0, 0],
        point: ["0".into(), "0".into()],
    }
}

fn spline_at(place: &SplinePoint) -> SplineAt {
    let triangle = place.triangle;
    SplineAt {
        ring: None,
        sector: place.sector,
        triangle: [triangle.p, triangle.q, i32::from(triangle.down)],
        point: place.at.each_ref().map(Rational::to_string),
    }
}

/// The certificate that the characteristic map is regular and injective, with the number of quarterings
/// that its proof may use. It holds no other choice, so whether it is true is the checker's to say.
/// `None` for a scheme without one.
pub fn characteristic_map(scheme: Scheme, n: u32, splits: u32) -> Option<Certificate> {
    let scheme = match scheme {
        Scheme::Loop(_) => "loop",
        Scheme::CatmullClark => "catmull-clark",
        Scheme::DooSabin => return None,
    };
    let claim = CharacteristicMapClaim {
        scheme: scheme.into(),
        valence: n,
        kind: "characteristic-map".into(),
    };
    Some(Certificate::of_inequality(
        Claim::CharacteristicMap(claim),
        Some(cosine_of_eigensplines(n)),
        vec![Step::Embedding { splits }],
    ))
}

/// The certificate of the distance of the centre of every level (Peters & Wu, Example 1), n >= 4. It
/// holds no choice.
pub fn centre_distance(weights: LoopWeights, n: u32) -> Certificate {
    let claim = CentreDistanceClaim {
        scheme: "loop".into(),
        weights: weights.to_string(),
        valence: n,
        kind: "centre-distance".into(),
    };
    Certificate::of_inequality(
        Claim::CentreDistance(claim),
        Some(cosine_of_eigensplines(n)),
        vec![Step::Sign {}],
    )
}
