//! Characteristic maps are regular and injective: section 9 of FORMAT.md.

use std::collections::BTreeMap;

use num_traits::ToPrimitive;

use crate::claim::{CharacteristicMap, SchemeName};
use crate::complex::Complex;
use crate::eigen::Angles;
use crate::file::{File, Step};
use crate::fixed::Fixed;
use crate::patch::Patch;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::sector::{Lattice, ring_zero};

/// The most quarterings of a patch.
pub const SPLITS: usize = 8;

/// A patch of the characteristic map, its Bernstein coefficients.
type Net = Vec<Complex>;

/// The characteristic map over ring 0 of a sector.
struct Map {
    kind: Patch,
    patches: Vec<Net>,
    /// Along the ray of a_0, from the centre.
    ray: Net,
    /// Along the outer boundary, from the ray of a_0 to that of a_1.
    arcs: Vec<Net>,
}

/// Shows that the characteristic map is regular and injective.
///
/// # Errors
///
/// If and only if this is not shown: rule `embedding`; `format`, `bases`, `cosine` if the file is not one for this claim.
pub fn check(file: &File, claim: &CharacteristicMap) -> Outcome<()> {
    ensure!(file.bases.is_empty(), Rule::Bases, "a characteristic map has no bases");
    let [Step::Embedding(step)] = &file.steps[..] else {
        return Err(Rejection::new(Rule::Format, "the one step is \"embedding\""));
    };
    let (rule, n) = (Rule::Embedding, claim.valence);
    ensure!(step.splits <= SPLITS, rule, "more than {SPLITS} splits");
    let angles = Angles::new(file, n)?;
    let map = match claim.scheme {
        SchemeName::Loop => of_loop(&angles),
        SchemeName::CatmullClark => of_catmull_clark(&angles),
        SchemeName::DooSabin => return Err(Rejection::new(rule, "Doo-Sabin has no such rule")),
    };
    map.check(n, &angles, step.splits)
}

/// Shows that Loop's characteristic map is regular and injective, by all splits that are allowed.
///
/// # Errors
///
/// If and only if this is not shown: rule `embedding`.
pub fn check_loop(n: usize, angles: &Angles) -> Outcome<()> {
    of_loop(angles).check(n, angles, SPLITS)
}

/// The coefficients on an edge of a patch.
fn edge(kind: Patch, net: &Net, edge: usize) -> Net {
    kind.edge(edge).unwrap_or_default().into_iter().map(|i| net[i]).collect()
}

fn of_loop(angles: &Angles) -> Map {
    let kind = Patch::Triangle;
    let chi = angles.ring(1);
    let level = Lattice::first(&chi, 0).next(chi.lambda, 3);
    // [0, 0, 1], [0, 1, 0], [1, 0, 0].
    let patches: Vec<Net> =
        ring_zero(1).into_iter().map(|triangle| level.patch(triangle).to_vec()).collect();
    let (low, high) = (&patches[2], &patches[1]);
    let arcs = [low, high].map(|net| edge(kind, net, 0)).to_vec();
    Map { kind, ray: edge(kind, low, 2), arcs, patches }
}

impl Map {
    fn check(&self, n: usize, angles: &Angles, splits: usize) -> Outcome<()> {
        let rule = Rule::Embedding;
        let halves = quarters(self.kind);
        for (i, net) in self.patches.iter().enumerate() {
            let positive = is_regular(self.kind, &halves, net, splits);
            ensure!(positive, rule, "patch {i}: the Jacobian is not shown to be positive");
        }
        let grows = self.ray.windows(2).all(|pair| pair[0].re.below(pair[1].re));
        ensure!(grows, rule, "the ray of a_0 is not shown to be run through once");
        let middle = angles.unit(2).conjugate();
        ensure!(n >= 3, rule, "the valence is below 3");
        for (i, arc) in self.arcs.iter().enumerate() {
            let turns = turning(arc).into_iter().all(Fixed::is_positive);
            ensure!(turns, rule, "arc {i} of the outer boundary is not shown to turn one way");
            let aside = arc.iter().all(|z| (*z * middle).re.is_positive());
            ensure!(aside, rule, "arc {i} of the outer boundary is not shown to turn less than π");
        }
        Ok(())
    }
}

/// For each quarter and coefficient, the weights of the coefficients of the whole over the common denominator.
pub type Quarters = Vec<Vec<Vec<(i64, usize)>>>;

/// The denominator of the weights in [`Quarters`].
pub const WHOLE: i64 = 64;

/// The quarters of a patch.
pub fn quarters(kind: Patch) -> Quarters {
    let weight = |(i, x): (usize, &num_rational::BigRational)| {
        let x = (x * num_bigint::BigInt::from(WHOLE)).to_integer().to_i64().unwrap_or(0);
        (x != 0).then_some((x, i))
    };
    let row = |row: Vec<_>| row.iter().enumerate().filter_map(weight).collect();
    (0..4).map(|letter| kind.restricted(letter).into_iter().map(row).collect()).collect()
}

/// The Jacobian's coefficients over the patch are positive, or else those over its quarters.
fn is_regular(kind: Patch, quarters: &Quarters, net: &Net, splits: usize) -> bool {
    if jacobian(kind, net).into_values().all(Fixed::is_positive) {
        return true;
    }
    let part = |rows: &Vec<Vec<(i64, usize)>>| -> Net {
        let terms = |row: &Vec<(i64, usize)>| row.clone().into_iter().map(|(c, i)| (c, net[i]));
        rows.iter().map(|row| Complex::mean(terms(row), WHOLE)).collect()
    };
    splits > 0 && quarters.iter().all(|rows| is_regular(kind, quarters, &part(rows), splits - 1))
}

fn binomial(n: usize, k: usize) -> i64 {
    (0..k).fold(1, |c, i| c * (n - i) as i64 / (i + 1) as i64)
}

/// The Bernstein coefficients of `x_v y_w - x_w y_v`, each with a positive factor, by their exponents.
fn jacobian(kind: Patch, net: &Net) -> BTreeMap<(usize, usize), Fixed> {
    let d = kind.degree();
    let triangle = kind == Patch::Triangle;
    // The coefficient with the exponents j of v and k of w.
    let at = |j: usize, k: usize| {
        net[if triangle { (j + k) * (j + k + 1) / 2 + k } else { k * (d + 1) + j }]
    };
    // The derivatives, but for the factor d, as polynomials in v, w and what they leave of 1: coefficients times the
    // number of ways, so that products are products of polynomials.
    let slope = |[a, b]: [usize; 2]| {
        let mut terms = Vec::new();
        for j in 0..=d - a {
            for k in 0..=d - b {
                if triangle && j + k >= d {
                    continue;
                }
                let ways = if triangle {
                    binomial(d - 1, j + k) * binomial(j + k, k)
                } else {
                    binomial(d - a, j) * binomial(d - b, k)
                };
                terms.push(((j, k), (at(j + a, k + b) - at(j, k)) * Fixed::ratio(ways, 1)));
            }
        }
        terms
    };
    let (v, w) = (slope([1, 0]), slope([0, 1]));
    let mut product = BTreeMap::new();
    for ((j, k), a) in &v {
        for ((l, m), b) in &w {
            let sum = product.entry((j + l, k + m)).or_insert(Fixed::ZERO);
            *sum = *sum + a.cross(*b);
        }
    }
    product
}

/// The Bernstein coefficients of `x y' - y x'`, each with a positive factor.
fn turning(arc: &Net) -> Vec<Fixed> {
    let d = arc.len() - 1;
    let mut product = vec![Fixed::ZERO; 2 * d];
    for (i, z) in arc.iter().enumerate() {
        for (j, pair) in arc.windows(2).enumerate() {
            let ways = Fixed::ratio(binomial(d, i) * binomial(d - 1, j), 1);
            product[i + j] = product[i + j] + z.cross(pair[1] - pair[0]) * ways;
        }
    }
    product
}

/// The characteristic map of Catmull-Clark's scheme, from the two-ring of quads.
fn of_catmull_clark(angles: &Angles) -> Map {
    let (w, c) = (angles.unit(4), angles.cosine(4));
    let (one, ratio) = (Complex::real(Fixed::ONE), Fixed::ratio);
    // x^2 - (5 + c)/8 x + 1/16 = 0.
    let half = (ratio(5, 1) + c) * ratio(1, 16);
    let lambda = half + (half.square() - ratio(1, 16)).root();
    let phi = Fixed::ONE.over(lambda.doubled(2) - Fixed::ONE);
    let f = (one + w) * phi;
    // h (lambda - 1/16) = u + g/16 with u = 3/8 (1 + f) + w/16, and
    // g (lambda - 3/32) = 9/16 + 3/32 (2 Re f) + (2c + 2 Re h)/64.
    let share = Fixed::ONE.over(lambda - ratio(1, 16));
    let u = (one + f) * ratio(3, 8) + w * ratio(1, 16);
    let known = ratio(9, 16) + f.re * ratio(3, 16) + (c + u.re * share) * ratio(1, 32);
    let g = known.over(lambda - ratio(3, 32) - share * ratio(1, 512));
    let h = (u + Complex::real(g * ratio(1, 16))) * share;
    let (mirrored, far) = (w * h.conjugate(), w * g);
    let t = f * ratio(9, 16)
        + (one + w + h + mirrored) * ratio(3, 32)
        + (Complex::real(g) + far) * ratio(1, 64);
    let t = t * Fixed::ONE.over(lambda - ratio(1, 64));
    let grid = [[Complex::ZERO, one, Complex::real(g)], [w, f, h], [far, mirrored, t]];
    // The point (p, q), the halo from the sectors before and behind.
    let back = w.conjugate();
    let old = |[p, q]: [i64; 2]| match (p, q) {
        (p, -1) => grid[p as usize][1] * back,
        (-1, q) => grid[1][q as usize] * w,
        (p, q) => grid[q as usize][p as usize],
    };
    // The points of level 1 up to radius 2 are lambda times the old ones; those beyond are regular.
    let new = |[p, q]: [i64; 2]| {
        if p <= 2 && q <= 2 {
            return old([p, q]) * lambda;
        }
        let line = |p: i64| match (p.div_euclid(2), p.rem_euclid(2)) {
            (i, 0) => vec![(1, i - 1), (6, i), (1, i + 1)],
            (i, _) => vec![(4, i), (4, i + 1)],
        };
        let (u, v) = (line(p), line(q));
        let terms = u.iter().flat_map(|(a, i)| v.iter().map(move |(b, j)| (a * b, old([*i, *j]))));
        Complex::mean(terms.collect::<Vec<_>>().into_iter(), 64)
    };
    let patch = |[i, j]: [i64; 2]| -> Net {
        let points: Vec<Vec<Complex>> =
            (-1..3).map(|b| (-1..3).map(|a| new([i + a, j + b])).collect()).collect();
        let weights = [[1, 4, 1, 0], [0, 4, 2, 0], [0, 2, 4, 0], [0, 1, 4, 1]];
        let coefficient = |a: usize, b: usize| {
            let row = |r: usize| Complex::mean((0..4).map(|i| (weights[a][i], points[r][i])), 6);
            Complex::mean((0..4).map(|r| (weights[b][r], row(r))), 6)
        };
        (0..4).flat_map(|b| (0..4).map(move |a| (a, b))).map(|(a, b)| coefficient(a, b)).collect()
    };
    let kind = Patch::Square(3);
    let [low, corner, high] = [[1, 0], [1, 1], [0, 1]].map(patch);
    let arcs = vec![
        edge(kind, &low, 1),
        edge(kind, &corner, 1),
        edge(kind, &corner, 2),
        edge(kind, &high, 2),
    ];
    Map { kind, ray: edge(kind, &low, 0), arcs, patches: vec![low, corner, high] }
}

#[cfg(test)]
mod tests;
