//! Lemmas 1 to 3, Theorem 1, Corollaries 1 to 3 as executable statements, in exact arithmetic.
//!
//! Δ(m, n, Q) is the difference of the spline and its level-m polyhedron over the characteristic map. The
//! lemmas rest on three facts that can be decided exactly: `A v = λ v` for each eigenvector, that the
//! facets of the characteristic net are not degenerate and keep their orientation (so that affine
//! interpolation at them is defined and reproduces the characteristic map), and `Q = Σ p_i v_i`.

use std::cmp::Ordering;

use num_traits::Zero;

use super::redone::WEIGHTS;
use crate::bound::Against;
use crate::paper::words::{claim, every, if_true, ranges};
use crate::paper::{Claim, Verdict};
use crate::predict::eigen::kernel::{Kernel, Norms, Sum};
use crate::predict::eigen::table;
use crate::scalar::{Cyclotomic, Decide, Interval, Ring};
use crate::spectrum::loop_modes::{Family, loop_modes};
use crate::spectrum::{Member, Parity, Rules, Spectrum};

/// Levels of the expansion that are formed.
const LEVELS: u32 = 3;

/// Valences up to which every net is formed exactly; beyond, fields of high degree make it slow.
const LARGEST: u32 = 12;

/// What is found at a valence.
#[derive(Clone, Debug)]
pub struct Found {
    /// n.
    pub n: u32,
    /// Lemmas 1 and 2: the facets of the characteristic net, levels 0 and 1, are oriented alike, and the constant
    /// and the characteristic net are eigenvectors.
    pub reproduction: Option<bool>,
    /// The facets fill the convex hull of the net: Definition 2.1.
    pub convex: Option<bool>,
    /// Whether every member of the basis is an eigenvector: no generalised ones.
    pub diagonal: bool,
    /// Lemma 3: `A v = λ v`, point by point, for every eigenvector of the basis.
    pub scaling: Option<bool>,
    /// Theorem 1: `A^m Q = Σ p_i λ_i^m v_i` for a net Q.
    pub expansion: Option<bool>,
    /// Corollary 3: for a single eigenspline, Corollary 1's bound is its distance.
    pub single: Option<bool>,
}

/// A net without symmetry: values in no order.
fn sample(size: usize) -> Vec<Cyclotomic> {
    let value = |i: usize| Cyclotomic::from_integer(((i * i * 7 + 3 * i) % 23) as i64 - 11);
    (0..size).map(value).collect()
}

impl Found {
    /// At a valence.
    pub fn of(n: u32) -> Option<Self> {
        let (spectrum, modes) = loop_modes::<Cyclotomic>(WEIGHTS, n)?;
        let (_, chi) = modes
            .iter()
            .find(|(m, _)| m.family == Family::Ring && m.frequency == 1)?;
        let small = n <= LARGEST;
        let members = spectrum.members();
        let is_eigenvector = |&m: &Member| spectrum.chain(m).iter().all(Zero::is_zero);
        let kept = [Member::Constant, chi[0], chi[1]]
            .iter()
            .all(|m| acts_as_eigenvalue(&spectrum, *m));
        Some(Found {
            n,
            reproduction: oriented(n, chi).map(|oriented| kept && oriented),
            convex: convex(n, chi),
            diagonal: members.iter().all(is_eigenvector),
            // Turned and odd nets are combinations of turned even ones: in large fields one of each mode.
            scaling: Some(
                (members.iter())
                    .filter(|m| is_eigenvector(m) && (small || is_first(**m)))
                    .all(|&m| acts_as_eigenvalue(&spectrum, m)),
            ),
            expansion: small.then(|| expands(&spectrum)),
            single: single(n),
        })
    }
}

/// Whether a member stands for its mode: the even net, or that of sector 0.
fn is_first(member: Member) -> bool {
    match member {
        Member::Constant => true,
        Member::Inner { parity, .. } => parity == Parity::Even,
        Member::Outer { sector, .. } => sector == 0,
    }
}

/// Whether `A v = λ v`.
fn acts_as_eigenvalue(spectrum: &Spectrum<Cyclotomic>, member: Member) -> bool {
    let net = spectrum.net(member);
    let lambda = spectrum.eigenvalue(member);
    let image = spectrum.ring().refine(&net);
    (image.iter().zip(net)).all(|(a, v)| *a == v * &lambda)
}

/// Whether `A^m Q = Σ p_i λ_i^m v_i`.
fn expands(spectrum: &Spectrum<Cyclotomic>) -> bool {
    let mut net = sample(spectrum.ring().len());
    let mut coefficients = spectrum.coefficients(&net);
    let members = spectrum.members();
    for _ in 0..LEVELS {
        net = spectrum.ring().refine(&net);
        for (p, &member) in coefficients.iter_mut().zip(&members) {
            *p = p.clone() * &spectrum.eigenvalue(member);
        }
        if spectrum.compose(&coefficients) != net {
            return false;
        }
    }
    true
}

/// The characteristic net in intervals, by points: true coordinates up to a factor of the second.
fn net(n: u32, chi: &[Member]) -> Option<(Spectrum<Interval>, Vec<[Interval; 2]>)> {
    let spectrum = Spectrum::<Interval>::new(Rules::Loop(WEIGHTS), n)?;
    let [x, y] = [spectrum.net(chi[0]), spectrum.net(chi[1])];
    let points = x.into_iter().zip(y).map(|(x, y)| [x, y]).collect();
    Some((spectrum, points))
}

fn area(points: &[[Interval; 2]], [a, b, c]: [usize; 3]) -> Interval {
    let [p, q, r] = [a, b, c].map(|i| points[i]);
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

fn is_positive(x: Interval) -> Option<bool> {
    x.decide(&Interval::from_integer(0))
        .map(|o| o == Ordering::Greater)
}

/// Whether the facets of the two-ring are oriented alike; those of the next level over S_n are images under
/// the eigenvalue.
fn oriented(n: u32, chi: &[Member]) -> Option<bool> {
    let (_, points) = net(n, chi)?;
    let size = n as usize;
    let at = |kind: usize, j: usize| 1 + kind * size + j % size;
    every((0..size).flat_map(|j| {
        let (a, next, d) = (at(0, j), at(0, j + 1), at(1, j));
        let facets = [
            [0, a, next],
            [a, at(2, j), d],
            [a, d, next],
            [next, d, at(2, j + 1)],
        ];
        facets.map(|facet| is_positive(area(&points, facet)))
    }))
}

/// Whether the outer polygon b_0, d_0, b_1, .. of the net is convex: a turn to the left (or none) everywhere.
fn convex(n: u32, chi: &[Member]) -> Option<bool> {
    let (_, points) = net(n, chi)?;
    let size = n as usize;
    let outer = |i: usize| {
        let j = (i / 2) % size;
        if i.is_multiple_of(2) {
            1 + 2 * size + j
        } else {
            1 + size + j
        }
    };
    // By symmetry two corners: on a ray, and between two.
    let turns = [1, 2].map(|i| area(&points, [outer(i - 1), outer(i), outer(i + 1)]));
    if n == 6 {
        // A straight line at the corners between rays, exactly.
        return Some(turns.iter().all(|t| t.sup() >= 0.0));
    }
    every(turns.map(is_positive))
}

/// The bound of Corollary 1 for the net of the characteristic map and one eigenvector, over the eigenvector's
/// tabulated distance: 1 within rounding, for every frequency.
fn single(n: u32) -> Option<bool> {
    let kernel = Kernel::new(WEIGHTS, n)?;
    let spectrum = Spectrum::<f64>::new(Rules::Loop(WEIGHTS), n)?;
    let modes = loop_modes::<f64>(WEIGHTS, n)?.1;
    let chi: Vec<Vec<f64>> = modes
        .iter()
        .filter(|(m, _)| m.family == Family::Ring && m.frequency == 1)
        .flat_map(|(_, members)| members.iter().map(|&m| spectrum.net(m)))
        .collect();
    let distances = table::distances(WEIGHTS, n, Against::Control, 0)?;
    let ring = modes
        .iter()
        .filter(|(m, _)| m.family == Family::Ring && m.frequency != 1);
    let (mut norms, mut sums) = (Norms::default(), Vec::new());
    Some(ring.zip(&distances.ring).all(|((mode, members), mu)| {
        let mut z = spectrum.net(members[0]);
        if mode.generalised.is_some() {
            // The one that is tabulated.
            z[1 + 2 * n as usize..].fill(0.0);
        }
        let mut net: Vec<[f64; 3]> = (0..z.len()).map(|i| [chi[0][i], chi[1][i], z[i]]).collect();
        kernel.norms(&mut net, 0.0, &mut norms);
        kernel.sums(&norms, &distances, Sum::BySector, &mut sums);
        sums.iter().all(|sum| (sum / mu - 1.0).abs() < 1e-9)
    }))
}

/// The claims.
pub fn claims(found: &[Found]) -> Vec<Claim> {
    let scope = format!("Loop, n = {}", ranges(found.iter().map(|f| f.n)));
    let by = |part: fn(&Found) -> Option<bool>| -> Vec<(u32, Option<bool>)> {
        found.iter().map(|f| (f.n, part(f))).collect()
    };
    // The hypothesis of the theorems: no generalised eigenvectors, that is Lemma 3.
    let diagonal = |f: &&Found| f.diagonal;
    let under: Vec<(u32, Option<bool>)> = (found.iter().filter(diagonal))
        .filter_map(|f| Some((f.n, Some(f.expansion?))))
        .collect();
    let elsewhere: Vec<u32> = (found.iter())
        .filter(|f| !f.diagonal && f.expansion == Some(false))
        .map(|f| f.n)
        .collect();
    let beyond = match elsewhere.is_empty() {
        true => String::new(),
        false => format!(
            "; without the hypothesis, at n = {}, both sides differ",
            ranges(elsewhere.iter().copied())
        ),
    };
    let (reproduction, hull) = (by(|f| f.reproduction), by(|f| f.convex));
    let (scaling, single) = (by(|f| f.scaling), by(|f| f.single));
    let truth = |t: &[(u32, Option<bool>)]| every(t.iter().map(|t| t.1));
    let theorem = truth(&under);
    vec![
        claim(
            "definition-2-1",
            "Definition 2.1",
            "The control polyhedron is defined over a triangulation of the convex hull of the characteristic net: \
             the mesh's facets fill that hull.",
            Verdict::of(truth(&hull)),
            format!(
                "{}; the definition works over the facets' union, which chi(S_n) does not leave",
                if_true(&hull, "the outer polygon is convex")
            ),
            scope.clone(),
        ),
        claim(
            "lemma-1",
            "Lemma 1, (4)",
            "The control polyhedron of the characteristic net over the embedding φ is the characteristic spline if \
             and only if φ is that spline.",
            Verdict::of(truth(&reproduction)),
            if_true(
                &reproduction,
                "each facet is nondegenerate and oriented alike, so the interpolant of its own corners is the \
                 identity there, and E(φ) = φ",
            ),
            scope.clone(),
        ),
        claim(
            "lemma-2",
            "Lemma 2, (7)",
            "Δ(m, n, v_i) = 0 for i = 0, 1, 2.",
            Verdict::of(truth(&reproduction)),
            if_true(
                &reproduction,
                "the constant and the characteristic net are eigenvectors; Lemma 1",
            ),
            scope.clone(),
        ),
        claim(
            "lemma-3",
            "Lemma 3, (8)",
            "Δ(m, n, v_i)(2^-m σ) = λ_i^m Δ(0, n, v_i)(σ) for each eigenvector: its net of level m is λ_i^m times that of \
             level 0.",
            Verdict::of(truth(&scaling)),
            if_true(
                &scaling,
                "A v = λ v exactly at each point, for each of the eigenvectors; at n = 3 one vector of the basis is none: \
                 see no-generalised-eigenvectors",
            ),
            scope.clone(),
        ),
        claim(
            "theorem-1",
            "Theorem 1, (13)",
            "Without generalised eigenvectors Δ(m, n, Q)(2^-m σ) = Σ_(i>=3) p_i λ_i^m Δ(0, n, v_i)(σ).",
            Verdict::of(theorem),
            format!(
                "A^m Q = Σ p_i λ_i^m v_i exactly for a net without symmetry, m <= {LEVELS}{beyond}"
            ),
            format!("Loop, n = {}", ranges(under.iter().map(|u| u.0))),
        ),
        claim(
            "corollary-2",
            "Corollary 2, (16)",
            "Over 2^-m S_n the distance is at most Σ |p_i| |λ_i|^m ‖Δ(0, n, v_i)‖.",
            Verdict::of(theorem),
            "Theorem 1 and the triangle inequality",
            format!("Loop, n = {}", ranges(under.iter().map(|u| u.0))),
        ),
        claim(
            "corollary-3",
            "Corollary 3",
            "For Q = p_0 v_0 + p_1 v_1 + p_2 v_2 + (0, v_3) the distance over 2^-m S_n is |λ_3|^m ‖Δ(0, n, v_3)‖: the \
             bound is sharp.",
            match (theorem, truth(&single)) {
                (Some(true), Some(true)) => Verdict::Sharp,
                (a, b) => Verdict::of(every([a, b])),
            },
            if_true(
                &single,
                "the bound of Corollary 1 for the characteristic net and one eigenvector is that eigenvector's own \
                 distance, for each frequency",
            ),
            scope,
        ),
    ]
}
