//! Meshes to propose certificates for.

use super::{Example, V};

/// A closed mesh, Loop's scheme with Warren's weights, control mesh of level 0, both sides. Faces from 1.
pub fn plain(points: &[V], faces: &[&[usize]]) -> Example {
    Example {
        scheme: "loop",
        weights: Some("warren"),
        boundary: "smooth",
        points: points.to_vec(),
        faces: faces.iter().map(|f| f.iter().map(|i| i - 1).collect()).collect(),
        level: 0,
        against: "control",
        facets: "triangles",
        other: None,
        side: "both",
        depth: 5,
        slack: 0.12,
        vertex: None,
        eigen: None,
    }
}

pub fn catmull_clark(example: Example) -> Example {
    Example { scheme: "catmull-clark", weights: None, depth: 5, ..example }
}

pub fn tetrahedron() -> Example {
    plain(
        &[[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]],
        &[&[1, 2, 4], &[1, 4, 3], &[1, 3, 2], &[2, 3, 4]],
    )
}

pub fn octahedron() -> Example {
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let [u, v, w] = [x, y, z].map(|p: V| p.map(|t| -t));
    plain(
        &[x, y, z, u, v, w],
        &[
            &[1, 2, 3],
            &[2, 4, 3],
            &[4, 5, 3],
            &[5, 1, 3],
            &[2, 1, 6],
            &[4, 2, 6],
            &[5, 4, 6],
            &[1, 5, 6],
        ],
    )
}

pub fn icosahedron() -> Example {
    let g = 1.618_033_988_749_895;
    let signs = [(1.0, 1.0), (-1.0, 1.0), (1.0, -1.0), (-1.0, -1.0)];
    let mut points: Vec<V> = Vec::new();
    for turn in 0..3 {
        for (s, t) in signs {
            let mut p = [0.0, s, t * g];
            p.rotate_right(turn);
            points.push(p);
        }
    }
    // The faces are the triples at distance 2 from each other, turned outward.
    let near =
        |a: usize, b: usize| (super::len(super::sub(points[a], points[b])) - 2.0).abs() < 1e-9;
    let mut faces = Vec::new();
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(a, c) {
                    let [p, q, r] = [a, b, c].map(|i| points[i]);
                    let cross = [1, 2, 0].map(|i| q[i] * r[(i + 1) % 3] - q[(i + 1) % 3] * r[i]);
                    let out = super::dot(p, cross) > 0.0;
                    faces.push(if out { vec![a, b, c] } else { vec![a, c, b] });
                }
            }
        }
    }
    assert_eq!(faces.len(), 20);
    Example { points, faces, weights: Some("original"), depth: 4, ..plain(&[], &[]) }
}

/// A prism over a polygon of n sides: for n = 4 not a cube, its top is bent.
pub fn prism(n: usize) -> Example {
    let corner = |i: usize, z: f64| {
        let t = std::f64::consts::TAU * i as f64 / n as f64;
        // Decimals that floats have exactly.
        [(t.cos() * 64.0).round() / 64.0, (t.sin() * 64.0).round() / 64.0, z]
    };
    let points = (0..n).map(|i| corner(i, -1.0));
    let top = (0..n).map(|i| corner(i, if i == 1 { 1.25 } else { 1.0 }));
    let mut faces: Vec<Vec<usize>> = vec![(0..n).rev().collect(), (n..2 * n).collect()];
    faces.extend((0..n).map(|i| vec![i, (i + 1) % n, n + (i + 1) % n, n + i]));
    let points = points.chain(top).collect();
    catmull_clark(Example { points, faces, facets: "bilinear", ..plain(&[], &[]) })
}

/// The grid of the vertices (i, j, f(i, j)), 0 <= i, j < n, in triangles or quads.
pub fn grid(n: usize, triangles: bool, f: impl Fn(f64, f64) -> f64) -> Example {
    let at = |i: usize, j: usize| n * j + i;
    let point = |k: usize| [(k % n) as f64, (k / n) as f64, f((k % n) as f64, (k / n) as f64)];
    let mut faces = Vec::new();
    for (i, j) in (0..n - 1).flat_map(|j| (0..n - 1).map(move |i| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        if triangles {
            faces.extend([vec![a, b, d], vec![b, c, d]]);
        } else {
            faces.push(vec![a, b, c, d]);
        }
    }
    let open = Example { points: (0..n * n).map(point).collect(), faces, ..plain(&[], &[]) };
    if triangles { open } else { catmull_clark(Example { facets: "bilinear", ..open }) }
}

pub fn bump(i: f64, j: f64) -> f64 {
    if (i, j) == (1.0, 2.0) { 4.0 } else { 0.25 * i }
}

/// The two-ring of valence 8 with the mode of frequency 2, amplitude 1 (section 9).
pub fn saddle() -> Example {
    let (n, k) = (8, 2.0);
    let tau = std::f64::consts::TAU;
    let mode = |k: f64| {
        let cos = (tau * k / n as f64).cos();
        let lambda = 0.375 + cos / 4.0;
        let delta = 3.0 / (8.0 * lambda - 1.0);
        let rho = (10.0 + 2.0 * cos + delta * (2.0 + 2.0 * cos)) / (16.0 * lambda - 1.0);
        let wave = move |j: usize, f: fn(f64) -> f64| f(tau * k * j as f64 / n as f64);
        move |kind: usize, j: usize, f: fn(f64) -> f64| match kind {
            0 => wave(j, f),
            1 => rho * wave(j, f),
            _ => delta * (wave(j, f) + wave(j + 1, f)),
        }
    };
    let (chi, y) = (mode(1.0), mode(k));
    let mut points = vec![[0.0; 3]];
    for kind in 0..3 {
        points.extend(
            (0..n).map(|j| [chi(kind, j, f64::cos), chi(kind, j, f64::sin), y(kind, j, f64::cos)]),
        );
    }
    let [a, b, d] = [1, 1 + n, 1 + 2 * n].map(|first| move |j: usize| first + j % n);
    let sector = |j: usize| {
        [
            vec![0, a(j), a(j + 1)],
            vec![a(j), b(j), d(j)],
            vec![a(j), d(j), a(j + 1)],
            vec![a(j + 1), d(j), b(j + 1)],
        ]
    };
    Example {
        points,
        faces: (0..n).flat_map(sector).collect(),
        boundary: "none",
        side: "surface-to-mesh",
        vertex: Some(0.04),
        eigen: Some((n, 2, 1.0, 1e-9)),
        slack: 0.15,
        ..plain(&[], &[])
    }
}
