//! The two-ring of an eigenspline as a mesh: characteristic map and one eigenvector as coordinates.
//!
//! For Loop the vertices are O, a_0.., b_0.., d_0.. and the faces, for j = 0..n-1, (O, a_j, a_(j+1)),
//! (a_j, b_j, d_j), (a_j, d_j, a_(j+1)), (a_(j+1), d_j, b_(j+1)): the order of `proofs/FORMAT.md`,
//! section 10. For Catmull-Clark vertices are in the order of [`super::two_ring`], and the faces are the
//! 4 n quads, sector by sector.

use super::inner::InnerMode;
use super::two_ring::Rules;
use super::{Member, Parity, Spectrum};
use crate::mesh::{Mesh, Point, Topology};
use crate::scalar::{Interval, Rational, Ring};

/// Binary places of the coordinates.
const PLACES: i32 = 40;

/// A mesh with rational coordinates near those of an eigenspline.
#[derive(Clone, Debug)]
pub struct EigenMesh {
    /// The mesh: open, with the first ring inside.
    pub mesh: Mesh<Rational>,
    /// The third coordinate's eigenvalue.
    pub eigenvalue: Interval,
    /// No coordinate is farther from the exact one.
    pub within: Rational,
}

/// The mesh with the coordinates (Re χ, Im χ, t Re y): χ the characteristic map, y the eigenvector of the
/// given frequency with the largest eigenvalue, both of amplitude 1 on the rays of the first ring; t is
/// the amplitude.
///
/// Coordinates are rounded to multiples of 2^-40.
///
/// `None` if and only if there is no such frequency (2 <= frequency <= n/2).
///
/// # Panics
/// If n < 3.
pub fn eigen_mesh(rules: Rules, n: u32, frequency: u32, amplitude: &Rational) -> Option<EigenMesh> {
    if frequency < 2 || 2 * frequency > n {
        return None;
    }
    let spectrum = Spectrum::<Interval>::new(rules, n)?;
    // Of one frequency, the larger eigenvalue comes first.
    let first = |k: u32| {
        spectrum
            .inner()
            .iter()
            .position(|m: &InnerMode<_>| m.frequency == k)
    };
    let net = |k: u32, parity: Parity| {
        let mode = first(k)?;
        Some(spectrum.net(Member::Inner { mode, parity }))
    };
    let sine = spectrum.sine_squared(1).sqrt()?;
    let (x, y) = (net(1, Parity::Even)?, net(1, Parity::Odd)?);
    let z = net(frequency, Parity::Even)?;
    let t = Interval::from_rational(amplitude);
    let scale = 2f64.powi(PLACES);
    let mut within = 0.0_f64;
    let mut rounded = |x: Interval| {
        let near = (x.mid() * scale).round() / scale;
        within = within.max((x - Interval::point(near)).mag());
        Rational::from_float(near).unwrap_or_else(|| <Rational as Ring>::from_integer(0))
    };
    let mut points: Vec<Point<Rational>> = Vec::new();
    for ((x, y), z) in x.iter().zip(&y).zip(&z) {
        points.push(Point([*x, *y * sine, *z * t].map(&mut rounded)));
    }
    let (points, faces) = match rules {
        Rules::Loop(_) => triangles(n as usize, &points),
        Rules::CatmullClark => (points, quads(n)),
    };
    let arity = if matches!(rules, Rules::Loop(_)) {
        3
    } else {
        4
    };
    Some(EigenMesh {
        mesh: Mesh {
            topology: Topology::from_uniform(points.len(), arity, faces).ok()?,
            positions: points,
        },
        eigenvalue: spectrum.eigenvalue(Member::Inner {
            mode: first(frequency)?,
            parity: Parity::Even,
        }),
        within: Rational::from_float(within)?,
    })
}

/// Kinds are ring, between, ray; the mesh has ring, ray, between.
fn triangles(n: usize, points: &[Point<Rational>]) -> (Vec<Point<Rational>>, Vec<u32>) {
    let kind = |q: usize| points[1 + q * n..1 + (q + 1) * n].iter().cloned();
    let ordered = points[..1]
        .iter()
        .cloned()
        .chain(kind(0))
        .chain(kind(2))
        .chain(kind(1));
    let n = n as u32;
    let at = |q: u32, j: u32| 1 + q * n + j % n;
    let of_sector = |j: u32| {
        let (a, next) = (at(0, j), at(0, j + 1));
        let (b, beyond, d) = (at(1, j), at(1, j + 1), at(2, j));
        [[0, a, next], [a, b, d], [a, d, next], [next, d, beyond]]
    };
    (
        ordered.collect(),
        (0..n).flat_map(of_sector).flatten().collect(),
    )
}

/// Kinds are edge, face, ray, near, far, corner.
fn quads(n: u32) -> Vec<u32> {
    let at = |q: u32, j: u32| 1 + q * n + j % n;
    let of_sector = |j: u32| {
        let [edge, face, ray, near, far, corner] = std::array::from_fn(|q| at(q as u32, j));
        let (next, beyond) = (at(0, j + 1), at(2, j + 1));
        [
            [0, edge, face, next],
            [edge, ray, near, face],
            [face, near, corner, far],
            [next, face, far, beyond],
        ]
    };
    (0..n).flat_map(of_sector).flatten().collect()
}
