use super::*;
use crate::claim::{Family, Weights};
use crate::eigen::tests::{angles, float};

#[path = "../../tests/support/web.rs"]
mod web;

use web::{Web, key};

const TOLERANCE: f64 = 1e-11;

fn pair(z: Complex) -> [f64; 2] {
    [float(z.re), float(z.im)]
}

fn near(x: [f64; 2], y: [f64; 2]) -> bool {
    let scale = 1.0 + y[0].abs().max(y[1].abs());
    (0..2).all(|i| (x[i] - y[i]).abs() < TOLERANCE * scale)
}

/// Every mode of a valence.
fn modes(n: usize, weights: Weights) -> Vec<Mode> {
    let angles = angles(n);
    let rings = (0..=n / 2).map(|k| (Family::Ring, Some(k)));
    let others = [(Family::Ray, Some(0)), (Family::Ray, None), (Family::Between, None)];
    rings.chain(others).map(|(f, k)| angles.mode(weights, f, k).unwrap()).collect()
}

/// The three-ring of all sectors.
fn web(mode: &Mode, beta: f64) -> Web {
    let n = mode.a.len();
    let mut web = Web { n, beta, radius: 3, points: Default::default() };
    for j in 0..n {
        let lattice = Lattice::first(mode, j);
        for [p, q] in lattice.places().filter(|[p, q]| *p >= 0 && *q >= 0) {
            let (name, point) = (key(n, j, p, q), pair(lattice.at([p, q])));
            let before = web.points.insert(name, point);
            assert!(before.is_none_or(|before| near(before, point)), "{n}: ({j}, {p}, {q})");
        }
    }
    web
}

fn settings() -> impl Iterator<Item = (usize, Weights)> {
    let valences = [3, 4, 5, 6, 8, 12].into_iter();
    valences.flat_map(|n| [(n, Weights::Original), (n, Weights::Warren)])
}

fn beta(n: usize, weights: Weights) -> f64 {
    let c = (std::f64::consts::TAU / n as f64).cos();
    match (weights, n) {
        (Weights::Original, _) => 0.625 - (0.375 + c / 4.0f64).powi(2),
        (Weights::Warren, 3) => 9.0 / 16.0,
        (Weights::Warren, _) => 3.0 / 8.0,
    }
}

/// One step maps the three-ring to lambda times itself, and kappa times another mode for a generalised one.
#[test]
fn modes_are_eigenvectors() {
    for (n, weights) in settings() {
        let modes = modes(n, weights);
        assert_eq!(modes.iter().filter(|mode| mode.chain.is_some()).count(), usize::from(n == 3));
        for (i, mode) in modes.iter().enumerate() {
            let first = web(mode, beta(n, weights));
            let chain = mode.chain.as_ref();
            let chain = chain.map(|(kappa, f)| (float(*kappa), web(f, first.beta)));
            let next = first.refined();
            assert_eq!(first.points.len(), 1 + 6 * n);
            for (name, y) in &first.points {
                let rest = chain.as_ref().map_or([0.0; 2], |(k, f)| f.points[name].map(|x| k * x));
                let image = [0, 1].map(|i| float(mode.lambda) * y[i] + rest[i]);
                assert!(near(next.points[name], image), "{n}, {weights:?}, mode {i}: {name:?}");
            }
        }
    }
}

/// Levels, halo, limits and patches of each sector are those of the whole mesh.
#[test]
fn lattices_are_parts_of_a_mesh_of_all_sectors() {
    for (n, weights) in settings() {
        for (i, mode) in modes(n, weights).iter().enumerate() {
            let mut mesh = web(mode, beta(n, weights));
            let mut lattices: Vec<_> = (0..n).map(|j| Lattice::first(mode, j)).collect();
            for level in 1..=2usize {
                let coarse = mesh.limits();
                for (j, lattice) in lattices.iter().enumerate() {
                    let limits = lattice.limits();
                    for [p, q] in limits.places().filter(|[p, q]| *p >= 0 && *q >= 0) {
                        let found = pair(limits.at([p, q]));
                        assert!(near(found, coarse[&key(n, j, p, q)]), "{n}, mode {i}");
                    }
                }
                mesh = mesh.refined();
                let bound = (1 << level) + 2;
                lattices = lattices.iter().map(|l| l.next(mode.lambda, bound)).collect();
                for (j, lattice) in lattices.iter().enumerate() {
                    for [p, q] in lattice.places() {
                        let name = match (p, q) {
                            (p, -1) => key(n, j + n - 1, 1, p - 1),
                            (-1, q) => key(n, j + 1, q - 1, 1),
                            (p, q) => key(n, j, p, q),
                        };
                        let found = pair(lattice.at([p, q]));
                        assert!(
                            near(found, mesh.points[&name]),
                            "{n}, mode {i}, {level}: {name:?}"
                        );
                    }
                }
            }
            // The corners of each patch of level 2, and the middles of its edges and of its quarters' edges.
            let deep = mesh.refined().refined();
            let limits = deep.limits();
            let kind = crate::patch::Patch::Triangle;
            for (j, lattice) in lattices.iter().enumerate().take(2) {
                for triangle in ring_zero(2) {
                    let (patch, at) = (lattice.patch(triangle), corners(triangle));
                    for (v, w) in [(0, 0), (4, 0), (0, 4), (2, 2), (2, 0), (1, 0), (1, 1), (2, 1)] {
                        let weights = kind.value(&[v, w].map(|x| crate::rational::ratio(x, 4)));
                        let terms = weights.iter().zip(patch).map(|(c, z)| z * Fixed::of(c));
                        let found = pair(terms.fold(Complex::ZERO, |sum, z| sum + z));
                        let [p, q] =
                            [0, 1].map(|i| (4 - v - w) * at[0][i] + v * at[1][i] + w * at[2][i]);
                        let there = limits[&key(n, j, p, q)];
                        assert!(near(found, there), "{n}, mode {i}: {triangle:?} {v} {w}");
                    }
                }
            }
        }
    }
}

#[test]
fn triangles_and_their_neighbours() {
    assert_eq!(ring_zero(1), [[0, 0, 1], [0, 1, 0], [1, 0, 0]]);
    // 4^t - 4^(t-1) triangles.
    assert_eq!(ring_zero(4).len(), 192);
    for triangle in ring(0, 6) {
        for corner in 0..3 {
            let ends: Vec<_> = (1..3).map(|i| corners(triangle)[(corner + i) % 3]).collect();
            match across(triangle, corner) {
                // The same edge seen from the other side.
                Some(next) => {
                    assert!(ends.iter().all(|end| corners(next).contains(end)) && next != triangle);
                    assert!((0..3).any(|i| across(next, i) == Some(triangle)));
                }
                None => {
                    assert!(ends.iter().all(|[p, _]| *p == 0) || ends.iter().all(|[_, q]| *q == 0))
                }
            }
        }
        let near = around(triangle);
        let touches =
            |other: &Triangle| corners(*other).iter().any(|c| corners(triangle).contains(c));
        let all = ring(0, 12).into_iter().filter(touches).count();
        assert!(near[0] == triangle && near.len() == all && near.iter().all(touches));
    }
}
