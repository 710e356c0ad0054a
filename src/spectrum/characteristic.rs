//! The characteristic map: a proof that it is regular and injective.
//!
//! Let v be the complex net of frequency 1 with A v = λ v, 0 < λ < 1, and χ the limit surface of the
//! control net v, a map to the plane. Away from the centre its parameters are covered by *rings*: in each
//! sector three tiles of level 1, then three of level 2, and so on. By A v = λ v the ring of
//! level m + 1 is λ^m times that of level 1, so one ring is to be looked at; by rotation, one sector.
//! Reflection in the ray 0 maps v to its conjugate, for that is also an eigenvector of λ with the
//! value 1 at a_0, and there is one only. So χ is real on the ray 0, and in ℝ w on the ray 1.
//!
//! In coordinates x + y w the sector is spanned by the axes. Checked by signs of Bernstein
//! coefficients, pieces being halved where a sign is open:
//!
//! 1. the Jacobian determinant of the three tiles is positive ([`Check::regular`]);
//! 2. on the ray 0, x > 0 and x' > 0;
//! 3. on the outer boundary p, from the ray 0 to the ray 1, det(p, p') > 0 and x + y > 0.
//!
//! **Theorem.** If 1, 2 and 3 hold and λ < 1 and the frequency is 1, then χ is a homeomorphism onto a
//! star-shaped neighbourhood of 0, and regular outside of the centre.
//!
//! *Proof.* By 3 the angle of p increases, by x + y > 0 p stays in an open half-plane about the
//! sector's bisector, and its ends lie on the rays 0 and 1, at positive distance by 2: so the angle runs
//! once from 0 to 2π/n, and p is a graph r = ρ(φ). The inner boundary is λ p by scaling. By 2 the ray 0
//! runs monotonically from λ ρ(0) to ρ(0), and by rotation the ray 1 alike. So the boundary of the
//! sector's ring, a disc, is mapped homeomorphically to the boundary Γ of D = {λ ρ(φ) <= r <= ρ(φ), 0 <= φ
//! <= 2π/n}, a Jordan curve, passed once counterclockwise. The three tiles join with continuous
//! derivatives (they are regular spline patches over one lattice), so by 1 each inner point has index +1,
//! and a point off Γ has as many preimages as Γ winds round it: one inside, none outside. No inner
//! point goes to Γ: near it points outside of D would be reached. So the sector's ring is mapped
//! homeomorphically to D. The n rotated copies of D fill the ring {λ ρ <= r <= ρ} and meet
//! on the rays only, where the maps agree; the rings scaled by λ^m fill the punctured neighbourhood, and the
//! centre goes to 0. ∎
//!
//! Loop's characteristic map doesn't depend on the vertex weights: v is 0 at the centre, and so is its
//! ring's sum.

use std::cmp::Ordering;

use super::inner::{FourierNet, InnerMode};
use super::jacobian::{PlanePatch, swept};
use super::phase::{Frequency, Phase};
use super::two_ring::{Point, Rules};
use super::{Represent, Spectrum};
use crate::bernstein::{from_net, midpoint};
use crate::scalar::Decide;
use crate::scheme::{Tile, catmull_clark, loop_scheme};

/// How often a piece is halved before its sign is called open.
const DEPTH: u32 = 12;

/// What came out of a check of signs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sign {
    /// Positive everywhere: proved.
    Positive,
    /// Certainly not positive at some point.
    Refuted,
    /// Open.
    Undecided,
}

impl Sign {
    fn and(self, other: Sign) -> Sign {
        match (self, other) {
            (Sign::Refuted, _) | (_, Sign::Refuted) => Sign::Refuted,
            (Sign::Positive, Sign::Positive) => Sign::Positive,
            _ => Sign::Undecided,
        }
    }
}

/// The checks at the head of this file.
#[derive(Clone, Debug)]
pub struct Check {
    /// The Jacobian determinant over the three tiles.
    pub regular: Sign,
    /// Together with `regular`: the rays and the outer boundary.
    pub injective: Sign,
    /// The number of pieces with positive coefficients that the tiles were cut into.
    pub pieces: usize,
}

/// Checks the map of an inner mode of a spectrum, as a rule the one of frequency 1 with the larger
/// eigenvalue.
///
/// `injective` is `Positive` only if all of the theorem's conditions are proved, `regular` included;
/// it is `Refuted` if one fails, which for a condition other than regularity doesn't prove that the
/// map is not injective: only that it isn't proved by this theorem.
///
/// Precondition: over intervals, `mode.right` encloses an eigenvector of the spectrum, as those of
/// [`Spectrum::inner`] do; a net that certainly is none is refuted.
///
/// ```
/// use subcert::scalar::Cyclotomic;
/// use subcert::scheme::LoopWeights;
/// use subcert::spectrum::{Rules, Spectrum, characteristic::{Sign, check}};
///
/// let rules = Rules::Loop(LoopWeights::Original);
/// let spectrum = Spectrum::<Cyclotomic>::new(rules, 5).unwrap();
/// let mode = spectrum.inner().iter().find(|mode| mode.frequency == 1).unwrap();
/// assert_eq!(check(&spectrum, mode).injective, Sign::Positive);
/// ```
///
/// # Panics
/// If S lacks 2 cos(2πk/n) of the mode.
pub fn check<S: Represent + Decide>(spectrum: &Spectrum<S>, mode: &InnerMode<S>) -> Check {
    let (rules, n) = (spectrum.ring().rules(), spectrum.ring().valence());
    let frequency = Frequency::<S>::new(n, mode.frequency).expect("the spectrum has it");
    let net = sector_net(rules, &frequency, &mode.right);
    let one = S::one();
    let contracts = mode
        .eigenvalue
        .represent::<S>()
        .map_or(Sign::Undecided, |lambda| {
            sign(&lambda).and(sign(&(one - &lambda)))
        });
    let eligible = match (mode.frequency, mode.chain.is_empty()) {
        (1, true) => contracts.and(kept(spectrum, &frequency, mode)),
        _ => Sign::Refuted,
    };
    let (tiles, ray, boundary) = match rules {
        Rules::Loop(weights) => {
            let extended = loop_scheme::extended_net::<S, _>(weights, n, &net);
            let extended = extended.expect("S has the masks");
            let patch = |tile| {
                let net = loop_scheme::tile_net(n, tile, &extended);
                from_net::box_spline::<S, _>(&net)
            };
            let patches = Tile::ALL.map(patch);
            // Here v runs towards the ray 1 and w towards the ray 0: the orientation is the other one.
            // The outer boundary is v + w = 1: tile 3 from its corner 2 to 1, then tile 1 from 2 to 1.
            let reversed = |mut edge: Vec<Phase<S>>| {
                edge.reverse();
                edge
            };
            let boundary = vec![reversed(patches[2].edge(1)), reversed(patches[0].edge(1))];
            let ray = reversed(patches[2].edge(2));
            (sign_of_jacobian(&patches, -1), ray, boundary)
        }
        Rules::CatmullClark => {
            let extended = catmull_clark::extended_net::<S, _>(n, &net);
            let patch = |tile| {
                let net = catmull_clark::tile_net(n, tile, &extended);
                from_net::bicubic::<S, _>(&net)
            };
            let patches = Tile::ALL.map(patch);
            // u = 2 upwards along tiles 1 and 2, then v = 2 back along tiles 2 and 3.
            let boundary = vec![
                patches[0].edge(1),
                patches[1].edge(1),
                patches[1].edge(2),
                patches[2].edge(2),
            ];
            let ray = patches[0].edge(0);
            (sign_of_jacobian(&patches, 1), ray, boundary)
        }
    };
    let (regular, pieces) = tiles;
    let slopes: Vec<S> = (ray.windows(2))
        .map(|ends| ends[1].x.clone() - &ends[0].x)
        .collect();
    let ray = sign(&ray[0].x).and(sign_of(&slopes, DEPTH));
    let around = boundary.iter().map(|curve| {
        let ahead: Vec<S> = curve.iter().map(|p| p.x.clone() + &p.y).collect();
        sign_of(&ahead, DEPTH).and(sign_of(&swept(curve), DEPTH))
    });
    let around = around.fold(Sign::Positive, Sign::and);
    Check {
        regular,
        injective: eligible.and(regular).and(ray).and(around),
        pieces,
    }
}

/// Whether A v = λ v: refuted where that is certainly false. Over intervals it can't be seen to be true
/// and is a property of the mode that the caller answers for.
fn kept<S: Represent + Decide>(
    spectrum: &Spectrum<S>,
    frequency: &Frequency<S>,
    mode: &InnerMode<S>,
) -> Sign {
    let Some(lambda) = mode.eigenvalue.represent::<S>() else {
        return Sign::Undecided;
    };
    let mut kinds = mode.right.kinds.iter().enumerate();
    let kept = kinds.all(|(kind, z)| {
        let image = mode.right.at(frequency, spectrum.ring().kind(kind));
        let excess = image - &(z.clone() * &lambda);
        [excess.x, excess.y]
            .iter()
            .all(|x| !matches!(x.decide(&S::zero()), Some(order) if order.is_ne()))
    });
    if kept { Sign::Positive } else { Sign::Refuted }
}

/// The local net of sector 0 of a Fourier net, in Stam's numbering.
fn sector_net<S: Represent>(
    rules: Rules,
    frequency: &Frequency<S>,
    net: &FourierNet<S>,
) -> Vec<Phase<S>> {
    let value = |point| match point {
        Point::Center => net.center.clone(),
        Point::Sector { kind, sector } => {
            frequency.product(&net.kinds[kind], frequency.power(sector.into()))
        }
    };
    let points = rules.local_points(frequency.valence());
    points.into_iter().map(value).collect()
}

fn sign<S: Decide>(x: &S) -> Sign {
    match x.decide(&S::zero()) {
        Some(Ordering::Greater) => Sign::Positive,
        Some(_) => Sign::Refuted,
        None => Sign::Undecided,
    }
}

/// The sign of a polynomial of one variable from its Bernstein coefficients: positive if they are;
/// refuted by a value at an end; else by halves.
fn sign_of<S: Decide>(coefficients: &[S], depth: u32) -> Sign {
    let all = coefficients
        .iter()
        .map(sign)
        .fold(Sign::Positive, Sign::and);
    let ends = sign(&coefficients[0]).and(sign(&coefficients[coefficients.len() - 1]));
    if all == Sign::Positive || ends != Sign::Positive || depth == 0 {
        return if all == Sign::Positive {
            all
        } else {
            open(ends)
        };
    }
    let (mut line, mut near, mut far) = (coefficients.to_vec(), Vec::new(), Vec::new());
    while let (Some(first), Some(last)) = (line.first(), line.last()) {
        near.push(first.clone());
        far.push(last.clone());
        line = (line.windows(2))
            .map(|w| midpoint::<S, S>(&w[0], &w[1]))
            .collect();
    }
    far.reverse();
    sign_of(&near, depth - 1).and(sign_of(&far, depth - 1))
}

/// Positive values at corners are not all of the polynomial.
fn open(corners: Sign) -> Sign {
    match corners {
        Sign::Refuted => Sign::Refuted,
        _ => Sign::Undecided,
    }
}

/// The sign of the Jacobian times `orientation` over the tiles, and the number of pieces.
fn sign_of_jacobian<S: Decide, P: PlanePatch<S>>(
    patches: &[P; 3],
    orientation: i64,
) -> (Sign, usize) {
    let orientation = S::from_integer(orientation);
    let (mut result, mut pieces) = (Sign::Positive, 0);
    let mut open_pieces: Vec<(P, u32)> = patches.iter().map(|patch| (patch.clone(), 0)).collect();
    while let Some((patch, depth)) = open_pieces.pop() {
        let jacobian = patch.jacobian();
        let oriented = |a: &S| sign(&(a.clone() * &orientation));
        if jacobian.iter().all(|a| oriented(a) == Sign::Positive) {
            pieces += 1;
            continue;
        }
        let corners = P::jacobian_corners().map(|at| oriented(&jacobian[at]));
        let corners = corners.into_iter().fold(Sign::Positive, Sign::and);
        if corners == Sign::Refuted {
            return (Sign::Refuted, pieces);
        }
        if corners == Sign::Undecided || depth == DEPTH {
            result = Sign::Undecided;
            continue;
        }
        // Halving keeps the orientation (see `Patch::halve`) and scales the Jacobian by 1/2.
        let halves = patch
            .halve(&[[0.0; 2]; 4])
            .map(|(half, _)| (half, depth + 1));
        open_pieces.extend(halves);
    }
    (result, pieces)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::{Field, Interval, Rational};

    /// (2 t - 1)^2 + e in Bernstein form: 1 + e, -1 + e, 1 + e; its least value is e, at 1/2.
    #[test]
    fn signs_hidden_by_coefficients_are_found_by_halving() {
        let parabola = |e: Rational| {
            let one = <Rational as Field>::ratio(1, 1);
            [one.clone() + &e, e.clone() - &one, one + &e]
        };
        let ratio = <Rational as Field>::ratio;
        assert_eq!(sign_of(&parabola(ratio(1, 50)), DEPTH), Sign::Positive);
        assert_eq!(sign_of(&parabola(ratio(-1, 50)), DEPTH), Sign::Refuted);
        assert_eq!(sign_of(&parabola(ratio(0, 1)), DEPTH), Sign::Refuted);
        assert_eq!(sign_of(&parabola(ratio(1, 50)), 0), Sign::Undecided);
        let wide = Interval::new(-1.0, 1.0);
        assert_eq!(sign_of(&[wide, wide], DEPTH), Sign::Undecided);
    }
}
