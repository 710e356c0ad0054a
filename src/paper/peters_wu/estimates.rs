//! Claims about the estimators themselves, by the tabulated distances: what holds for every net.

use super::experiment::{Experiment, Row};
use super::figure_5::Saddle;
use super::printed;
use super::redone::{Redone, WEIGHTS};
use crate::bound::Against;
use crate::paper::words::{claim, every, if_true, ranges};
use crate::paper::{Claim, Enclosure, Verdict};
use crate::predict::Estimator;
use crate::predict::eigen::inside::stays_inside;
use crate::predict::eigen::kernel::{Kernel, ModeWeights, decayed};
use crate::predict::eigen::table;

/// Levels for which a table is looked through.
const LEVELS: u32 = 4;

/// The level, valence, frequency and amplitude at which `tab-eigen` is tried on a nearly flat wave.
const WAVE: (u32, u32, u32, f64) = (1, 8, 4, 1.0 / 64.0);

fn weights_of(w: &ModeWeights) -> Vec<f64> {
    w.ring.iter().copied().chain([w.between, w.ray]).collect()
}

/// Modes of valences for which `max(λ, 1/4)^m μ(0) < μ(m)`, m >= 1: (n, mode in the order of the kernel, m).
fn exceeded(valences: &[u32]) -> Vec<(u32, usize, u32)> {
    let mut found = Vec::new();
    for &n in valences {
        let tables = |m| table::distances(WEIGHTS, n, Against::Control, m);
        let (Some(kernel), Some(start)) = (Kernel::new(WEIGHTS, n), tables(0)) else {
            continue;
        };
        for m in 1..=LEVELS {
            let Some(own) = tables(m) else { continue };
            let by_rate = decayed(kernel.eigenvalues(), &start, m);
            let pairs = weights_of(&by_rate).into_iter().zip(weights_of(&own));
            // Tables are rounded upwards: a relative 1e-4 is beyond that.
            found.extend(
                pairs
                    .enumerate()
                    .filter(|(_, (a, b))| *a * 1.0001 < *b)
                    .map(|(i, _)| (n, i, m)),
            );
        }
    }
    found
}

/// The frequency of a ring mode that counts: 0, 2, 3, ..
fn mode_name(n: u32, i: usize) -> String {
    match i {
        0 => "frequency 0".into(),
        i if (i as u32) < (n / 2).max(1) => format!("frequency {}", i + 1),
        _ => "a local mode".into(),
    }
}

/// The range of μ_limit / μ_control over modes at m = 0.
fn offsets(valences: &[u32]) -> Option<[f64; 2]> {
    let mut range: Option<[f64; 2]> = None;
    for &n in valences {
        let of = |against| table::distances(WEIGHTS, n, against, 0);
        let (Some(control), Some(limit)) = (of(Against::Control), of(Against::Limit)) else {
            continue;
        };
        for (a, b) in weights_of(&limit).into_iter().zip(weights_of(&control)) {
            let [low, high] = range.unwrap_or([a / b; 2]);
            range = Some([low.min(a / b), high.max(a / b)]);
        }
    }
    range
}

/// `tab-eigen` against a certified distance on a nearly flat wave.
fn unsafe_wave() -> Option<(f64, f64)> {
    let (m, n, frequency, amplitude) = WAVE;
    let wave = Saddle::of(n, frequency, amplitude, m)?;
    let kernel = Kernel::new(WEIGHTS, n)?;
    let start = table::distances(WEIGHTS, n, Against::Control, 0)?;
    let weights = decayed(kernel.eigenvalues(), &start, m);
    let estimate = amplitude * weights.ring[frequency as usize - 1];
    Some((wave.distance, estimate * (1.0 + 1e-9)))
}

/// The claims.
pub fn claims(asked: &[u32], redone: &[Redone], experiment: &Experiment) -> Vec<Claim> {
    let scope = format!("Loop, n = {}", ranges(asked.iter().copied()));
    let approx = [0, 1, 2].map(|j| Row::Estimate(Estimator::TabApprox, j));
    let mut ratios: Vec<Enclosure> = Vec::new();
    for row in approx {
        for m in 0..experiment.levels() {
            ratios.extend(experiment.ratios(row, m).into_iter().map(|(_, r)| r));
        }
    }
    let one = Enclosure::exactly(num_traits::One::one());
    let above = every(ratios.iter().map(|r| one.at_most(r)));
    let least = ratios.iter().map(|r| &r.lo).min().cloned();
    let most = ratios.iter().map(|r| &r.hi).max().cloned();
    let range = least.zip(most).map_or("-".into(), |(a, b)| {
        let show = |x| Enclosure::exactly(x).decimal(2);
        format!("{} to {}", show(a), show(b))
    });
    let beyond = exceeded(asked);
    let first: Vec<String> = (beyond.iter().filter(|(_, _, m)| *m == 1))
        .map(|(n, i, _)| format!("n = {n}, {}", mode_name(*n, *i)))
        .collect();
    let wave = unsafe_wave();
    let inside: Vec<(u32, Option<bool>)> = asked.iter().map(|&n| (n, stays_inside(n))).collect();
    let offset = offsets(asked);
    let unproved: Vec<String> = (redone.iter())
        .filter(|r| !r.unproved.is_empty())
        .map(|r| {
            let interp = r
                .unproved
                .iter()
                .filter(|u| matches!(u.0, Row::Estimate(Estimator::TabInterp, _)));
            format!("{}: {} entries of tab-interp", r.model.name, interp.count())
        })
        .collect();
    let (lowest, highest) = printed::TABULATED;
    let printed_range = asked
        .iter()
        .copied()
        .filter(|n| (lowest..=highest).contains(n));
    let tabulated: Vec<(u32, Option<bool>)> = printed_range
        .map(|n| {
            let both =
                [Against::Control, Against::Limit].map(|a| table::distances(WEIGHTS, n, a, 0));
            (n, Some(both.iter().all(Option::is_some)))
        })
        .collect();
    vec![
        claim(
            "corollary-1",
            "Corollary 1, (15)",
            "min_φ ‖x - E∘φ‖ <= ‖Δ(m, n, Q)‖ <= Σ_(i>=3) |p_i| ‖Δ(m, n, v_i)‖. \"The bound need not be sharp.\"",
            match above {
                Some(true) => Verdict::Loose,
                other => Verdict::of(other),
            },
            format!(
                "the estimates with certified distances of eigensplines are {range} times the certified one-sided \
                 distance on the models redone; for single eigensplines see corollary-3"
            ),
            "the table redone, tab-approx 0 to 2",
        ),
        claim(
            "tabulated",
            "section 5, (18)",
            format!("Distances of all eigensplines are tabulated for n = {lowest}..{highest}; none is printed."),
            Verdict::of(every(tabulated.iter().map(|t| t.1))),
            if_true(&tabulated, "certified upper bounds, against control and limit meshes"),
            scope.clone(),
        ),
        claim(
            "eigen-weaker",
            "section 5",
            "max(λ_i, 1/4)^m μ_i(0) is a weaker estimate than the upper bound of Corollary 1: it is never below μ_i(m).",
            match (beyond.is_empty(), asked.is_empty()) {
                (_, true) => Verdict::Undecided,
                (true, _) => Verdict::True,
                (false, _) => Verdict::Refuted,
            },
            match first.is_empty() {
                true => "for every eigenvector and m <= 4".into(),
                false => format!("below it at m = 1 for {}", first.join("; ")),
            },
            scope.clone(),
        ),
        claim(
            "eigen-safe",
            "introduction; section 5",
            "The tabulated predictions (here tab-eigen) are always safe.",
            match wave {
                Some((distance, estimate)) if distance > estimate => Verdict::Refuted,
                _ => Verdict::Undecided,
            },
            wave.map_or("-".into(), |(distance, estimate)| {
                let (m, n, k, t) = WAVE;
                format!(
                    "n = {n}, frequency {k}, amplitude {t}, m = {m}: the distance from the surface to the facets is at least \
                     {distance:.6e}, tab-eigen {estimate:.6e}. (13) decays with λ_i over 2^-m S_n only; outside the rate is \
                     not the eigenvalue's"
                )
            }),
            "one eigenspline and the characteristic map",
        ),
        claim(
            "interp-domain",
            "section 4, (18)",
            "The estimates transfer to the interpolating polyhedron: over chi(S_n) its facets are those between limits of \
             the control points of the two-ring.",
            Verdict::of(every(inside.iter().map(|i| i.1))),
            format!(
                "chi(S_n) stays over the facets between limit points of S_n: {}; where it leaves them the mesh's own facets \
                 depend on points beyond the two-ring, and tab-interp is a bound after one local subdivision more. Not proved \
                 bounds for that reason: {}",
                if_true(&inside, "at all these valences"),
                match unproved.is_empty() {
                    true => "none".into(),
                    false => unproved.join(", "),
                }
            ),
            scope.clone(),
        ),
        claim(
            "linear-offset",
            "section 5, (3)",
            "The interpolating triangulation is a linear offset from the control polyhedron, so that a constant factor \
             between the distances might be expected.",
            match offset {
                Some([low, high]) => Verdict::of(Some(high < 1.1 * low)),
                None => Verdict::Undecided,
            },
            offset.map_or("-".into(), |[low, high]| {
                format!(
                    "linear it is: limits are a fixed matrix times the control points; but for the eigenvectors the ratio of \
                     both distances at m = 0 runs from {low:.3} to {high:.3}"
                )
            }),
            scope,
        ),
    ]
}
