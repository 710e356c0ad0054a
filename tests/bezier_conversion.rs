//! The Bézier conversion tables, derived from the subdivision rules alone: refine unit nets on the
//! lattice exactly, push the refined points to the limit, interpolate in Bernstein form.
//!
//! Nothing is taken from the tables or from a paper: not that the patch is a polynomial of the
//! degree in question (the interpolation is overdetermined and solved as a consistent system) and
//! not the limit masks (each is the invariant functional of its refinement, checked here).

mod exact;

use std::collections::BTreeMap;

use num_traits::{One, Zero};
use subcert::bernstein::conversion::*;
use subcert::scalar::{Field, Rational};

type Lattice = BTreeMap<(i64, i64), Rational>;

fn r(p: i64, q: i64) -> Rational {
    Rational::ratio(p, q)
}

fn power(x: &Rational, exponent: i64) -> Rational {
    (0..exponent).fold(Rational::one(), |product, _| product * x)
}

fn binomial(n: i64, k: i64) -> i64 {
    (0..k).fold(1, |b, i| b * (n - i) / (i + 1))
}

fn bernstein(degree: i64, i: i64, t: &Rational) -> Rational {
    let one = Rational::one();
    r(binomial(degree, i), 1) * power(t, i) * power(&(one - t), degree - i)
}

/// The columns of a conversion from the values of each basis function at common parameters.
fn assert_derived<const N: usize, const B: usize>(
    basis: &[Vec<Rational>],
    values: &[Vec<Rational>],
    rows: &[[i64; N]; B],
    denominator: i64,
) {
    let derived = exact::solve(basis, values);
    assert_eq!(derived.len(), B);
    for (b, row) in derived.iter().enumerate() {
        assert_eq!(row.len(), N);
        for (p, entry) in row.iter().enumerate() {
            assert_eq!(*entry, r(rows[b][p], denominator), "row {b}, column {p}");
        }
        assert_eq!(rows[b].iter().sum::<i64>(), denominator);
        assert!(rows[b].iter().all(|&weight| weight >= 0));
    }
}

/// The neighbours of a point of the triangular lattice, in cyclic order.
const RING: [(i64, i64); 6] = [(1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1)];

/// One step of Loop's scheme on the triangular lattice; points with missing ancestors are left out.
fn refine_triangular(net: &Lattice) -> Lattice {
    let mut refined = Lattice::new();
    for (&(i, j), p) in net {
        let ring = RING.map(|(a, b)| net.get(&(i + a, j + b)));
        if ring.iter().all(Option::is_some) {
            let sum: Rational = ring.iter().flatten().copied().sum();
            refined.insert((2 * i, 2 * j), r(5, 8) * p + r(1, 16) * sum);
        }
        for k in 0..3 {
            let (before, after) = (ring[(k + 5) % 6], ring[k + 1]);
            if let (Some(q), Some(c), Some(d)) = (ring[k], before, after) {
                let at = (2 * i + RING[k].0, 2 * j + RING[k].1);
                refined.insert(at, r(3, 8) * (p + q) + r(1, 8) * (c + d));
            }
        }
    }
    refined
}

fn triangular_limit(net: &Lattice, (i, j): (i64, i64)) -> Rational {
    let sum: Rational = RING.iter().map(|(a, b)| &net[&(i + a, j + b)]).sum();
    r(1, 2) * &net[&(i, j)] + r(1, 12) * sum
}

#[test]
fn box_spline_table_follows_from_loop_subdivision() {
    // p1..p12: p4 at the origin, p7 at (1, 0), p8 at (0, 1).
    let places: [(i64, i64); 12] = [
        (0, -1),
        (-1, 0),
        (1, -1),
        (0, 0),
        (-1, 1),
        (2, -1),
        (1, 0),
        (0, 1),
        (-1, 2),
        (2, 0),
        (1, 1),
        (0, 2),
    ];
    let level = 3;
    let size: i64 = 1 << level;
    let parameters = (0..=size).flat_map(|j| (0..=size - j).map(move |i| (i, j)));
    let parameters: Vec<(i64, i64)> = parameters.collect();
    let mut values = vec![Vec::new(); parameters.len()];
    for unit in 0..12 {
        let mut net: Lattice = places.iter().map(|&at| (at, Rational::zero())).collect();
        net.insert(places[unit], Rational::one());
        for _ in 0..level {
            let refined = refine_triangular(&net);
            // The limit mask is invariant: a vertex and its descendant have one limit.
            for corner in [(0, 0), (1, 0), (0, 1)] {
                let doubled = (2 * corner.0, 2 * corner.1);
                if net.len() == 12 {
                    assert_eq!(
                        triangular_limit(&net, corner),
                        triangular_limit(&refined, doubled)
                    );
                }
            }
            net = refined;
        }
        for (row, &at) in values.iter_mut().zip(&parameters) {
            row.push(triangular_limit(&net, at));
        }
    }
    let basis = parameters.iter().map(|&(v, w)| {
        let (v, w) = (r(v, size), r(w, size));
        let u = Rational::one() - &v - &w;
        let mut row = vec![Rational::zero(); 15];
        for (j, k) in (0..=4).flat_map(|j| (0..=4 - j).map(move |k| (j, k))) {
            let multinomial = binomial(4, j) * binomial(4 - j, k);
            let product = power(&u, 4 - j - k) * power(&v, j) * power(&w, k);
            row[((j + k) * (j + k + 1) / 2 + k) as usize] = r(multinomial, 1) * product;
        }
        row
    });
    let basis: Vec<Vec<Rational>> = basis.collect();
    assert_derived(&basis, &values, &BOX_SPLINE_ROWS, BOX_SPLINE_DENOMINATOR);
}

/// One step of Catmull-Clark on the square lattice.
fn refine_bicubic(net: &Lattice) -> Lattice {
    let mean = |points: &[(i64, i64)], net: &Lattice| -> Option<Rational> {
        let known: Option<Vec<&Rational>> = points.iter().map(|at| net.get(at)).collect();
        Some(known?.into_iter().sum::<Rational>() / r(points.len() as i64, 1))
    };
    let mut refined = Lattice::new();
    for &(i, j) in net.keys() {
        let corners = [(i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)];
        if let Some(face) = mean(&corners, net) {
            refined.insert((2 * i + 1, 2 * j + 1), face);
        }
    }
    let faces = refined.clone();
    for &(i, j) in net.keys() {
        for (a, b) in [(1, 0), (0, 1)] {
            let ends = mean(&[(i, j), (i + a, j + b)], net);
            let (x, y) = (2 * i + a, 2 * j + b);
            let sides = mean(&[(x + b, y + a), (x - b, y - a)], &faces);
            if let (Some(ends), Some(sides)) = (ends, sides) {
                refined.insert((x, y), (ends + sides) / r(2, 1));
            }
        }
        let edges = mean(&[(i + 1, j), (i - 1, j), (i, j + 1), (i, j - 1)], net);
        let (x, y) = (2 * i, 2 * j);
        let around = [
            (x + 1, y + 1),
            (x - 1, y + 1),
            (x - 1, y - 1),
            (x + 1, y - 1),
        ];
        if let (Some(edges), Some(around)) = (edges, mean(&around, &faces)) {
            let vertex = &net[&(i, j)] / r(2, 1) + (edges + around) / r(4, 1);
            refined.insert((x, y), vertex);
        }
    }
    refined
}

fn bicubic_limit(net: &Lattice, (i, j): (i64, i64)) -> Rational {
    let at = |a: i64, b: i64| &net[&(i + a, j + b)];
    let edges = at(1, 0) + at(0, 1) + at(-1, 0) + at(0, -1);
    let diagonals = at(1, 1) + at(-1, 1) + at(-1, -1) + at(1, -1);
    (r(16, 1) * at(0, 0) + r(4, 1) * edges + diagonals) / r(36, 1)
}

/// Runs the derivation of a tensor-product table: `first` is the lattice index of the grid's lower
/// left point, `at` the limit at the lattice point of a parameter.
fn derive_tensor<const N: usize>(
    degree: i64,
    first: i64,
    level: u32,
    refine: impl Fn(&Lattice) -> Lattice,
    limit: impl Fn(&Lattice, (i64, i64)) -> Rational,
    rows: &[[i64; N]; N],
    denominator: i64,
) {
    let side = degree + 1;
    let size: i64 = 1 << level;
    let parameters = (0..=size).flat_map(|j| (0..=size).map(move |i| (i, j)));
    let parameters: Vec<(i64, i64)> = parameters.collect();
    let mut values = vec![Vec::new(); parameters.len()];
    for unit in 0..N as i64 {
        let place = |at: i64| (first + at % side, first + at / side);
        let mut net: Lattice = (0..N as i64)
            .map(|at| (place(at), Rational::zero()))
            .collect();
        net.insert(place(unit), Rational::one());
        for _ in 0..level {
            let refined = refine(&net);
            if net.len() == N {
                for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                    assert_eq!(limit(&net, (i, j)), limit(&refined, (2 * i, 2 * j)));
                }
            }
            net = refined;
        }
        for (row, &at) in values.iter_mut().zip(&parameters) {
            row.push(limit(&net, at));
        }
    }
    let basis = parameters.iter().map(|&(i, j)| {
        let (u, v) = (r(i, size), r(j, size));
        let pairs = (0..side).flat_map(|b| (0..side).map(move |a| (a, b)));
        pairs
            .map(|(a, b)| bernstein(degree, a, &u) * bernstein(degree, b, &v))
            .collect()
    });
    let basis: Vec<Vec<Rational>> = basis.collect();
    assert_derived(&basis, &values, rows, denominator);
}

#[test]
fn bicubic_table_follows_from_catmull_clark() {
    let rows = &BICUBIC_ROWS;
    derive_tensor(
        3,
        -1,
        3,
        refine_bicubic,
        bicubic_limit,
        rows,
        BICUBIC_DENOMINATOR,
    );
}

/// One step of Doo-Sabin on the square lattice, indexed by faces: the face with lower left point
/// (i, j) has its centroid at parameter (i, j) and becomes the face (2i, 2j), so its corners become
/// the points (2i, 2j), (2i+1, 2j), ...
fn refine_biquadratic(net: &Lattice) -> Lattice {
    let mut refined = Lattice::new();
    for &(i, j) in net.keys() {
        let corner = |a: i64, b: i64| net.get(&(i + a, j + b));
        let face = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
        let Some(face) = face.into_iter().collect::<Option<Vec<&Rational>>>() else {
            continue;
        };
        for (c, (a, b)) in [(0, 0), (1, 0), (1, 1), (0, 1)].into_iter().enumerate() {
            let sides = face[(c + 1) % 4] + face[(c + 3) % 4];
            let point = r(9, 1) * face[c] + r(3, 1) * sides + face[(c + 2) % 4];
            refined.insert((2 * i + a, 2 * j + b), point / r(16, 1));
        }
    }
    refined
}

fn biquadratic_limit(net: &Lattice, (i, j): (i64, i64)) -> Rational {
    let at = |a: i64, b: i64| &net[&(i + a, j + b)];
    (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / r(4, 1)
}

#[test]
fn biquadratic_table_follows_from_doo_sabin() {
    let (rows, denominator) = (&BIQUADRATIC_ROWS, BIQUADRATIC_DENOMINATOR);
    derive_tensor(
        2,
        0,
        3,
        refine_biquadratic,
        biquadratic_limit,
        rows,
        denominator,
    );
}
