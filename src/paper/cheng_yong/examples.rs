//! Section 4: the printed distances, depths and counts, as far as they can be held against each other.
//!
//! The meshes are not public, so no number can be computed anew. But for one face the paper's formulas tie its
//! distance and all its depths to two numbers, G^0 and Z^0.

use num_traits::One;

use super::functional::Functional;
use super::norm::number;
use super::setting::Setting;
use super::{depth, printed};
use crate::bernstein::from_net;
use crate::paper::words::claim;
use crate::paper::{Claim, Verdict};
use crate::scalar::{Decide, Field, Rational, Ring};
use crate::scheme::{Tile, catmull_clark};

/// Why the numbers themselves stay open; for the preface.
pub const UNAVAILABLE: &str = "The meshes of Figures 6 to 8 are not public, so their distances, depths and counts can't \
     be computed anew; they are checked against each other and against the formulas.";

fn integer(k: i64) -> Rational {
    <Rational as Ring>::from_integer(k)
}

/// An upper bound of `|S - F_0| / G^0`: hulls of the tiles of rings 1 and 2, and of the level-2 points.
pub fn distance_bound(setting: &Setting) -> Option<Rational> {
    let corners = [1, 6, 5, 4].map(|j| setting.levels[0][j - 1].clone());
    let face = |u: Rational, v: Rational| {
        let weights = [
            (Rational::one() - &u) * (Rational::one() - &v),
            &u * (Rational::one() - &v),
            &u * &v,
            (Rational::one() - &u) * &v,
        ];
        let terms = corners.iter().zip(&weights);
        terms.fold(Functional::of_nothing(), |sum, (c, w)| {
            sum + &(c.clone() * w)
        })
    };
    let mut parts = Vec::new();
    for ring in 1..=2usize {
        for tile in Tile::ALL {
            let net = catmull_clark::tile_net(setting.n, tile, &setting.levels[ring]);
            let [x, y] = catmull_clark::tile_corner(tile);
            // Coefficient (i, j) of F is its value at the thirds of the tile, whose side is 2^-ring.
            let node = |from: i64, step: usize| Rational::ratio(3 * from + step as i64, 3 << ring);
            let surface = from_net::bicubic::<Rational, _>(&net);
            let differences =
                (0..16).map(|i| surface.0[i].clone() - &face(node(x, i % 4), node(y, i / 4)));
            parts.extend(differences);
        }
    }
    for (u, v) in [(0, 0), (1, 0), (1, 1), (0, 1)] {
        let corner = face(Rational::ratio(u, 4), Rational::ratio(v, 4));
        let points = &setting.levels[2][..setting.size()];
        parts.extend(points.iter().map(|point| point.clone() - &corner));
    }
    setting.g.largest(&parts).1.value().cloned()
}

/// The claims.
pub fn claims() -> Vec<Claim> {
    vec![
        figure_6a(),
        figure_6_distances(),
        figure_6c(),
        counts(),
        ratios(),
        usually(),
    ]
}

fn figure_6a() -> Claim {
    let (_, _, distance, steps) = printed::FIGURE_6[0];
    let epsilon = Rational::ratio(1, 100);
    // (3): M^0 >= 3 times the distance; (7) for that M^0, and the largest M^0 that still gives the depth.
    let least = Rational::ratio(3 * distance, 1000);
    let largest = integer(3 << (2 * steps)) * &epsilon;
    let consistent = depth::theorem_4(&least, &epsilon).is_some_and(|k| k <= steps)
        && depth::theorem_4(&largest, &epsilon) == Some(steps)
        && least <= largest;
    claim(
        "figure-6a",
        "section 4, Figure 6(a)",
        "A regular face at the distance 0.034 has depth 1 for ε = 0.01.",
        Verdict::of(Some(consistent)),
        format!("(3) and (7) allow it: M^0 between {least} and {largest}"),
        "regular patches",
    )
}

/// With G^0 >= distance / c the least n_ε of (23); c of [`distance_bound`].
fn figure_6_distances() -> Claim {
    let epsilon = Rational::ratio(1, 100);
    let mut verdict = Verdict::True;
    let mut texts = Vec::new();
    for (figure, valence, distance, steps) in printed::FIGURE_6 {
        let Some(n) = valence else { continue };
        let Some(c) = distance_bound(&Setting::new(n)) else {
            verdict = verdict.max(Verdict::Undecided);
            continue;
        };
        let g0 = Rational::ratio(distance, 1000) / &c;
        let Some(least) = depth::n_epsilon(n, &g0, &epsilon) else {
            continue;
        };
        if least > steps {
            verdict = verdict.max(Verdict::Misprint);
        }
        texts.push(format!(
            "{figure}: G^0 >= {}, so (23) gives at least {least}, not {steps}",
            number(&g0)
        ));
    }
    Claim {
        method: Some("a larger depth, or a smaller distance, or another formula than (23)".into()),
        ..claim(
            "figure-6-distances",
            "section 4, Figure 6(b), (c)",
            "Faces at the distances 0.15 (N = 8) and 0.25 (N = 5) have the depths 22 and 24 for ε = 0.01.",
            verdict,
            format!(
                "the distance is at most c G^0, c by linear programs over hulls: {}",
                texts.join("; ")
            ),
            "N = 8, N = 5",
        )
    }
}

/// The six depths of Figure 6(c) from one G^0 and one Z^0.
///
/// D >= n_ε, so each depth bounds G^0 above: `7/2 G^0 <= ε δ^D`. Let the least of these be G. Then n_ε of each ε
/// is at most that of G. Where the printed D is larger than that, some k + l_k with k <= n_ε is D, which bounds
/// Z^0 below: `W^k Z^0 > 3 ε 4^(D - k - 1)`. Where D = n_ε = 1, k = 1 bounds it above: `W Z^0 <= 3 ε`. (With n_ε < 1
/// for ε = 0.25 the formula gives no D, or 0, and not 1.)
fn figure_6c() -> Claim {
    let n = 5;
    let delta = printed::delta(n).unwrap_or_else(Rational::one);
    let w = depth::w(n).unwrap_or_else(Rational::one);
    let power = |x: &Rational, k: i64| (0..k).fold(Rational::one(), |p, _| p * x);
    let epsilon = |inverse: i64| Rational::ratio(100, inverse);
    let bounds = printed::FIGURE_6C
        .iter()
        .map(|&(inverse, d)| epsilon(inverse) * power(&delta, d) * Rational::ratio(2, 7));
    let g0 = bounds
        .reduce(|a, b| {
            if a.decide(&b) == Some(std::cmp::Ordering::Greater) {
                b
            } else {
                a
            }
        })
        .unwrap_or_else(Rational::one);
    let z_largest = integer(3) * epsilon(printed::FIGURE_6C[0].0) / &w;
    let mut texts = Vec::new();
    let mut possible = true;
    let mut agree = 0;
    for (inverse, d) in printed::FIGURE_6C {
        let epsilon = epsilon(inverse);
        let largest = depth::n_epsilon(n, &g0, &epsilon).unwrap_or(0);
        agree += usize::from(largest == d);
        if largest >= d {
            continue;
        }
        let needed = (1..=largest).map(|k| {
            let four = power(&integer(4), d - k - 1);
            integer(3) * &epsilon * four / power(&w, k)
        });
        let enough = needed
            .into_iter()
            .any(|z| z.decide(&z_largest) == Some(std::cmp::Ordering::Less));
        possible &= enough;
        if !enough {
            texts.push(format!("for ε = {epsilon} at most {largest}, not {d}"));
        }
    }
    Claim {
        method: (!possible).then(|| texts.join("; ")),
        ..claim(
            "figure-6c-depths",
            "section 4, Figure 6(c)",
            "Depths of one face of valence 5 for ε = 0.25, 0.2, 0.1, 0.01, 0.001, 0.0001: 1, 3, 9, 24, 40, 56.",
            match possible {
                true => Verdict::True,
                false => Verdict::Misprint,
            },
            format!(
                "depth 1 for ε = 0.25 means G^0 <= {} and Z^0 <= {} by (23), (32); {} by (33). {agree} of the six are n_ε of \
                 (23) for the largest such G^0",
                number(&g0),
                number(&z_largest),
                match possible {
                    true => "one G^0 and Z^0 may give all six",
                    false => "no G^0, Z^0 give all six",
                }
            ),
            "N = 5",
        )
    }
}

fn counts() -> Claim {
    let right = printed::COUNTS
        .iter()
        .all(|(_, levels, uniform, adaptive)| {
            let euler = |[v, e, f]: &printed::Counts| v - e + f;
            let closed_quads = |[_, e, f]: &printed::Counts| *e == 2 * f;
            uniform[2] % (1 << (2 * levels)) == 0
                && euler(uniform) == euler(adaptive)
                && [uniform, adaptive].iter().all(|c| closed_quads(c))
        });
    let same_mesh = {
        let [first, second, _] = printed::COUNTS;
        first.2[2] << (2 * (second.1 - first.1)) == second.2[2]
    };
    let eulers: Vec<String> = printed::COUNTS
        .iter()
        .map(|(name, _, [v, e, f], _)| format!("{name}: {}", v - e + f))
        .collect();
    claim(
        "counts",
        "section 4",
        "Counts of vertices, edges and faces of the rocker arm and the ventilation controller, uniform and adaptive.",
        Verdict::of(Some(right && same_mesh)),
        format!(
            "consistent: E = 2F (closed, quads only), faces divisible by 4^depth, the rocker arm's counts in the ratio 4² \
             between depths 2 and 4, and one Euler characteristic: {}",
            eulers.join(", ")
        ),
        "the three examples",
    )
}

/// Faces, adaptive over uniform.
fn shares() -> impl Iterator<Item = (Rational, usize)> {
    let share = |(_, _, uniform, adaptive): &(&str, u32, printed::Counts, printed::Counts)| {
        Rational::ratio(adaptive[2], uniform[2])
    };
    printed::COUNTS.iter().map(share).zip(0..)
}

fn ratios() -> Claim {
    // "3/25" and "forty times" are read to one part in twenty.
    let near = |(share, at): (Rational, usize)| {
        let (p, q) = printed::SAID[at];
        let ratio = share / Rational::ratio(p, q);
        Rational::ratio(19, 20) < ratio && ratio < Rational::ratio(21, 20)
    };
    let texts: Vec<String> = shares().map(|(share, _)| number(&share)).collect();
    claim(
        "ratios",
        "section 4",
        "Adaptive refinement takes 3/25 of the faces in the first example, a fortieth in the others.",
        Verdict::of(Some(shares().all(near))),
        format!("to one part in twenty: {}", texts.join(", ")),
        "the three examples",
    )
}

fn usually() -> Claim {
    let tenth = Rational::ratio(printed::USUALLY.0, printed::USUALLY.1);
    let below = shares().filter(|(share, _)| *share < tenth).count();
    let all = printed::COUNTS.len();
    claim(
        "usually",
        "abstract",
        "Adaptive refinement usually takes less than one-tenth of the faces.",
        Verdict::of(Some(2 * below > all)),
        format!("in {below} of the {all} examples that the paper prints"),
        "the three examples",
    )
}
