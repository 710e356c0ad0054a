//! Example 1: a net whose polyhedra stay at least λ_3^m away from the surface, for every m.
//!
//! **Theorem.** Let z be the net of frequency 0 with the sign that makes the centre positive, h its value there,
//! a_j = -1, and x the spline of (Re chi, Im chi, z). If the Bernstein coefficients of z over one ring of
//! patches of a sector are at most 0, then for every m the centre of level m is at distance exactly `h λ^m` from x.
//! Proof: z is the same in all sectors and λ^r times the same over ring r, so z <= 0 on x but for the centre, which
//! is the origin. The net is an eigenvector: the centre of level m is (0, 0, h λ^m); a point with z <= 0 is at least
//! `h λ^m` away, and the origin is exactly so far.
//!
//! *Two scopes.* The facets of level m over S_n have the centre, so their distance from x is at least `h λ^m`. The
//! whole polyhedron also has facets beyond S_n, and its distance is at least that of its outermost vertex: a
//! multiple of 2^-m for n = 4, next to which `h λ^m` vanishes.

use std::cmp::Ordering;

use num_traits::One;

use super::meshes;
use super::printed;
use crate::bernstein::from_net::box_spline;
use crate::mesh::Point;
use crate::paper::proof::Named;
use crate::paper::words::{all, claim};
use crate::paper::{Claim, Enclosure, Verdict};
use crate::refine::enclose_refined;
use crate::scalar::{Cyclotomic, Field, Interval, Ring};
use crate::scheme::{CornerRule, LoopWeights, Scheme, Tile, loop_scheme};
use crate::spectrum::eigenspline::certificates::centre_distance;
use crate::spectrum::loop_modes::{Family, loop_modes};

/// Levels of the whole polyhedron that are looked at.
const LEVELS: u32 = 6;

/// The net of frequency 0, its eigenvalue, and what is known of the spline.
#[derive(Clone, Debug)]
pub struct Example {
    /// The weights.
    pub weights: LoopWeights,
    /// n.
    pub n: u32,
    /// λ, exactly.
    pub lambda: Cyclotomic,
    /// h, exactly.
    pub height: Cyclotomic,
    /// Whether the coefficients of z over the ring are at most 0, and 0 < λ < 1.
    pub holds: Option<bool>,
    /// The net z: centre, a_j, d_j, b_j.
    pub values: [Cyclotomic; 4],
}

impl Example {
    /// The example of a valence n >= 4.
    pub fn of(weights: LoopWeights, n: u32) -> Option<Self> {
        let (spectrum, modes) = loop_modes::<Cyclotomic>(weights, n)?;
        let is_ring = |family, frequency| family == Family::Ring && frequency == 0;
        let (mode, members) = modes.iter().find(|(m, _)| is_ring(m.family, m.frequency))?;
        if mode.generalised.is_some() {
            return None;
        }
        let net: Vec<Cyclotomic> = spectrum.net(members[0]).iter().map(|x| -x).collect();
        let local = spectrum.ring().local_net(0, &net);
        let extended = loop_scheme::extended_net::<Cyclotomic, Cyclotomic>(weights, n, &local)?;
        let at_most_zero = |tile: Tile| {
            let patch =
                box_spline::<Cyclotomic, Cyclotomic>(&loop_scheme::tile_net(n, tile, &extended));
            patch.0.iter().all(|c| c.signum() <= 0)
        };
        let below = mode.eigenvalue.compare(&Cyclotomic::one()) == Ordering::Less;
        let decays = mode.eigenvalue.signum() > 0 && below;
        let at = |kind: usize| net[1 + kind * n as usize].clone();
        Some(Example {
            weights,
            n,
            lambda: mode.eigenvalue.clone(),
            height: net[0].clone(),
            holds: Some(decays && Tile::ALL.into_iter().all(at_most_zero)),
            values: [net[0].clone(), at(0), at(1), at(2)],
        })
    }

    /// The certificate.
    pub fn certificate(&self) -> Option<Named> {
        let certificate = centre_distance(self.weights, self.n);
        Some((certificate.file_name()?, certificate))
    }
}

fn text(x: &Cyclotomic) -> String {
    match x.to_rational() {
        Some(x) => x.to_string(),
        None => Enclosure::algebraic(x).decimal(6),
    }
}

/// A lower bound of the distance from the outermost vertex on a ray, level m, to the spline over S_n, n = 4 of
/// the characteristic map alone; `None` if refinement fails.
///
/// The vertices of level m up to the lattice radius `2^m + 1` depend on the two-ring only. The spline lies in the
/// hull of its Bernstein coefficients over ring 0 of all sectors, and of the smaller copies: within the largest
/// length of a coefficient.
pub fn overhang(n: u32) -> Option<Vec<f64>> {
    let weights = LoopWeights::Warren;
    let (spectrum, modes) = loop_modes::<Interval>(weights, n)?;
    let is_chi = |family, frequency| family == Family::Ring && frequency == 1;
    let (mode, members) = modes.iter().find(|(m, _)| is_chi(m.family, m.frequency))?;
    let sine = spectrum.sine_squared(mode.frequency).sqrt()?;
    let mut nets: Vec<Vec<Interval>> = members.iter().map(|&m| spectrum.net(m)).collect();
    nets[1].iter_mut().for_each(|y| *y *= sine);
    let mut reach = 0.0_f64;
    let patches: Option<Vec<_>> = (nets.iter())
        .map(|net| {
            let local = spectrum.ring().local_net(0, net);
            let extended = loop_scheme::extended_net::<Interval, Interval>(weights, n, &local)?;
            let patch = |tile| {
                box_spline::<Interval, Interval>(&loop_scheme::tile_net(n, tile, &extended)).0
            };
            Some(Tile::ALL.map(patch))
        })
        .collect();
    let patches = patches?;
    for (x, y) in patches[0].iter().flatten().zip(patches[1].iter().flatten()) {
        reach = reach.max((x.sqr() + y.sqr()).sqrt()?.sup());
    }
    // The mesh in floats: off by a few units, which is below the bound that is taken off again.
    let net: Vec<Point<f64>> = (nets[0].iter().zip(&nets[1]))
        .map(|(x, y)| Point([x.mid(), y.mid(), 0.0]))
        .collect();
    let width = nets.iter().flatten().fold(0.0_f64, |w, x| w.max(x.wid()));
    let scheme = Scheme::Loop(weights);
    let mesh = meshes::two_ring(n, &net);
    let mut found = Vec::new();
    for m in 0..=LEVELS {
        let (topology, level) = enclose_refined(scheme, CornerRule::Smooth, &mesh, m).ok()?;
        // From the centre straight along the ray: out by the third half-edge after the one back. On the
        // boundary of level 0 the ray ends.
        let mut h = topology.fan(0).next()?;
        for _ in 0..(1u32 << m) {
            h = (0..3).fold(topology.twin(h), |g, _| topology.rotate(g));
        }
        let Point([x, y, _]) = level.positions[topology.target(h) as usize];
        let off = 2.0 * (level.radius + width) + 1e-12;
        found.push((x.hypot(y) - off - reach).next_down());
    }
    Some(found)
}

/// The claims, with certificates.
pub fn claims() -> (Vec<Claim>, Vec<Named>) {
    let (n, rate, [centre, neighbour]) = printed::EXAMPLE_1;
    let rate = Cyclotomic::ratio(rate.0, rate.1);
    let examples = [LoopWeights::Warren, LoopWeights::Original].map(|w| Example::of(w, n));
    let [Some(warren), Some(original)] = examples else {
        return (Vec::new(), Vec::new());
    };
    let files: Vec<Named> = [&warren, &original]
        .into_iter()
        .filter_map(Example::certificate)
        .collect();
    let names = |i: usize| {
        files
            .get(i)
            .map(|f| f.0.clone())
            .into_iter()
            .collect::<Vec<_>>()
    };
    let as_printed = |e: &Example| {
        let equal = e.lambda == rate
            && e.height == Cyclotomic::from_integer(centre)
            && e.values[1] == Cyclotomic::from_integer(neighbour);
        e.holds.map(|holds| holds && equal)
    };
    let statement = "For Loop subdivision, n = 4 and Q = (v_1, v_2, v_3), λ_3^m = 4^-m bounds the Hausdorff distance \
                     between surface and control polyhedron from below, for every m.";
    // The step: new centre (1 - nb) q_0 + nb mean; new neighbours by frequency 1 and by z.
    let [own, mean, planar, third] = printed::EXAMPLE_1_STEP.map(|(p, q)| Cyclotomic::ratio(p, q));
    let step = |e: &Example| {
        let nb = loop_scheme::ring_weight_sum::<Cyclotomic>(e.weights, n)?;
        let planar_rate = loop_modes::<Cyclotomic>(e.weights, n)?.1;
        let (chi, _) = planar_rate
            .iter()
            .find(|(m, _)| m.family == Family::Ring && m.frequency == 1)?;
        Some(
            Cyclotomic::one() - &nb == own
                && nb == mean
                && chi.eigenvalue == planar
                && e.values[1].clone() * &e.lambda == third,
        )
    };
    let others = |e: &Example| {
        let minus_one = Cyclotomic::from_integer(neighbour);
        e.values[2..].iter().all(|v| v.compare(&minus_one).is_le())
    };
    let over = overhang(n);
    let drowned = over.as_ref().map(|found| {
        // From which level on the overhang is above the centre's distance.
        let lambda = Enclosure::algebraic(&warren.lambda).float();
        (0u32..)
            .zip(found)
            .map(|(m, d)| (m, *d, lambda.powi(m as i32)))
            .collect::<Vec<_>>()
    });
    let overhangs = drowned.as_ref().map_or("-".into(), |rows| {
        let rows: Vec<String> = rows
            .iter()
            .map(|(m, d, own)| format!("m = {m}: {d:.4} against {own:.4}"))
            .collect();
        rows.join(", ")
    });
    let larger = drowned
        .as_ref()
        .map(|rows| rows.iter().all(|(_, d, own)| d > own));
    let claims = vec![
        Claim {
            certificates: names(0),
            ..claim(
                "example-1-warren",
                "Example 1",
                statement,
                match as_printed(&warren) {
                    Some(true) => Verdict::Sharp,
                    other => Verdict::of(other),
                },
                format!(
                    "for the weights warren: λ = {}, the centre of level m is at distance exactly {} · ({})^m from the \
                     surface; the third coordinate is at most 0 on it",
                    text(&warren.lambda),
                    text(&warren.height),
                    text(&warren.lambda)
                ),
                "n = 4, all m; the centre vertex, and so the facets over S_4",
            )
        },
        Claim {
            certificates: names(1),
            ..claim(
                "example-1-original",
                "Example 1",
                statement,
                Verdict::of(as_printed(&original)),
                format!(
                    "for the weights of Loop 1987, which the paper cites, λ_3 = {} and not 1/4; the same argument gives \
                     {} · ({})^m for all m, the ring being at -1{}",
                    text(&original.lambda),
                    text(&original.height),
                    text(&original.lambda),
                    match original.holds {
                        Some(true) => "",
                        _ => " (not shown)",
                    }
                ),
                "n = 4, all m; the centre vertex, and so the facets over S_4",
            )
        },
        claim(
            "example-1-step",
            "Example 1, proof",
            "One step: the centre becomes 5/8 q_0 + 3/8 of the mean of its neighbours, these 3/8 times in the plane and \
             -1/4 in the third coordinate.",
            Verdict::of(step(&warren)),
            match step(&original) {
                Some(true) => "for both weights".into(),
                _ => format!(
                    "for the weights warren; for those of Loop 1987 the centre's own weight is {}",
                    loop_scheme::ring_weight_sum::<Cyclotomic>(original.weights, n)
                        .map_or("?".into(), |nb| text(&(Cyclotomic::one() - &nb)))
                ),
            },
            "n = 4",
        ),
        claim(
            "example-1-others",
            "Example 1, proof",
            "All other control points have a third coordinate of at most -1.",
            Verdict::of(all([Some(others(&warren)), Some(others(&original))])),
            format!(
                "between the rays and on them: {}, {} (warren), {}, {} (original)",
                text(&warren.values[2]),
                text(&warren.values[3]),
                text(&original.values[2]),
                text(&original.values[3])
            ),
            "n = 4",
        ),
        claim(
            "example-1-whole",
            "Example 1",
            "The decay λ_3^m is that of the Hausdorff distance between the surface over S_n and its control polyhedron \
             (all facets of the refined two-ring).",
            Verdict::of(larger.map(|larger| !larger)),
            format!(
                "the polyhedron overhangs the surface by a ring of facets: its outermost vertex on a ray is at least so \
                 far from the surface: {overhangs}; the lower bound is true, but the distance decays like 2^-m, not λ_3^m"
            ),
            format!("n = 4, weights warren, m = 0..{LEVELS}"),
        ),
    ];
    (claims, files)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand, n = 4: nb = 3/8 and h = 8/3 nb = 1 (warren); 31/64, 31/24 and λ = 9/64 (original).
    #[test]
    fn by_hand() {
        let of = |weights| Example::of(weights, 4).expect("an example");
        let (a, b) = (of(LoopWeights::Warren), of(LoopWeights::Original));
        assert_eq!(
            (text(&a.lambda), text(&a.height)),
            ("1/4".into(), "1".into())
        );
        assert_eq!(
            (text(&b.lambda), text(&b.height)),
            ("9/64".into(), "31/24".into())
        );
        assert_eq!((a.holds, b.holds), (Some(true), Some(true)));
    }
}
