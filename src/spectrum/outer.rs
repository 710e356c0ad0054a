//! The eigenvectors that vanish on the first ring: local, n for each eigenvalue.
//!
//! Nets that vanish on the centre and the first ring are an invariant subspace, for the second ring
//! never acts on the first. There the eigenspaces have bases of a few points each:
//!
//! | scheme | eigenvalue | vector at sector 0 |
//! |---|---|---|
//! | Loop | 1/8 | d_0 = 1, b_0 = b_1 = 1 |
//! | | 1/16 | b_0 = 1 |
//! | Catmull-Clark | 1/8 | ray_0 = near_0 = far_(-1) = 1, corner_0 = corner_(-1) = 1 |
//! | | 1/16 | near_0 = 1, far_(-1) = -1, corner_0 = 2, corner_(-1) = -2 |
//! | | 1/32 | ray_0 = 1, near_0 = far_(-1) = -2, corner_0 = corner_(-1) = -11 |
//! | | 1/64 | corner_0 = 1 |
//!
//! The table proposes; the masks decide: each eigenvalue is read off the image of its vector, and
//! A u = λ u is verified exactly whenever a spectrum is made. Source: derived here.

use nalgebra::DMatrix;
use num_traits::Zero;

use super::two_ring::{Point, Rules, Stencil, TwoRing};
use crate::linalg::solve_certified;
use crate::scalar::{Cyclotomic, Field, Ring};

/// A local eigenvector of the second ring, at sector 0; turned, it is one for each sector.
#[derive(Clone, Debug)]
pub struct OuterMode<S> {
    /// The eigenvalue.
    pub eigenvalue: S,
    /// The eigenvector, as a sparse net.
    pub vector: Stencil<S>,
    /// The functional that is 1 on this vector and 0 on every other local one, turned ones included,
    /// among nets that vanish on the first ring.
    pub dual: Stencil<S>,
}

impl<S: Field> OuterMode<S> {
    /// The mode in another arithmetic; `None` if some number has no image.
    pub fn map<T: Field>(&self, image: impl Fn(&S) -> Option<T>) -> Option<OuterMode<T>> {
        Some(OuterMode {
            eigenvalue: image(&self.eigenvalue)?,
            vector: self.vector.map(&image)?,
            dual: self.dual.map(&image)?,
        })
    }
}

/// (kind, sector, value).
type Term = (usize, i64, i64);

/// Vectors that are independent on the points of their group, in which no later group has values.
struct Group {
    points: &'static [(usize, i64)],
    vectors: &'static [&'static [Term]],
}

const LOOP: [Group; 2] = [
    Group {
        points: &[(1, 0)],
        vectors: &[&[(1, 0, 1), (2, 0, 1), (2, 1, 1)]],
    },
    Group {
        points: &[(2, 0)],
        vectors: &[&[(2, 0, 1)]],
    },
];

const CATMULL_CLARK: [Group; 2] = [
    Group {
        points: &[(2, 0), (3, 0), (4, -1)],
        vectors: &[
            &[(2, 0, 1), (3, 0, 1), (4, -1, 1), (5, 0, 1), (5, -1, 1)],
            &[(3, 0, 1), (4, -1, -1), (5, 0, 2), (5, -1, -2)],
            &[
                (2, 0, 1),
                (3, 0, -2),
                (4, -1, -2),
                (5, 0, -11),
                (5, -1, -11),
            ],
        ],
    },
    Group {
        points: &[(5, 0)],
        vectors: &[&[(5, 0, 1)]],
    },
];

/// The local modes, one for each outer kind of point, with their exact duals.
///
/// # Panics
/// If a vector of the table is no eigenvector of the ring's stencils.
pub fn outer_modes(ring: &TwoRing<Cyclotomic>) -> Vec<OuterMode<Cyclotomic>> {
    let n = ring.valence();
    let groups = match ring.rules() {
        Rules::Loop(_) => &LOOP,
        Rules::CatmullClark => &CATMULL_CLARK,
    };
    let mut modes: Vec<OuterMode<Cyclotomic>> = Vec::new();
    for group in groups {
        let points = group.points.iter().map(|&(kind, j)| Point::of(n, kind, j));
        let points: Vec<Point> = points.collect();
        let vectors: Vec<Stencil<Cyclotomic>> = (group.vectors.iter())
            .map(|terms| {
                let term = |&(kind, j, a): &Term| (Point::of(n, kind, j), Ring::from_integer(a));
                Stencil::new(terms.iter().map(term))
            })
            .collect();
        // What is left at the group's points when earlier groups' vectors are taken away.
        let rest = |&point: &Point| {
            let mut rest = Stencil::new([(point, Cyclotomic::from_integer(1))]);
            for mode in &modes {
                for j in 0..i64::from(n) {
                    let value = mode.vector.at(point.turned(n, -j));
                    rest = rest - &(mode.dual.turned(n, j) * &value);
                }
            }
            rest
        };
        let rests: Vec<Stencil<Cyclotomic>> = points.iter().map(rest).collect();
        let size = points.len();
        let values = DMatrix::from_fn(size, size, |p, m| vectors[m].at(points[p]));
        let identity = DMatrix::<Cyclotomic>::identity(size, size);
        let inverse =
            solve_certified(&values, &identity).expect("a group's vectors are independent");
        for (m, vector) in vectors.into_iter().enumerate() {
            let terms = rests.iter().enumerate();
            let dual = terms.fold(Stencil::zero(), |sum: Stencil<Cyclotomic>, (p, rest)| {
                sum + &(rest.clone() * &inverse[(m, p)])
            });
            modes.push(OuterMode {
                eigenvalue: eigenvalue_of(ring, &vector),
                vector,
                dual,
            });
        }
    }
    modes
}

/// The λ with A u = λ u, verified at every point.
fn eigenvalue_of(ring: &TwoRing<Cyclotomic>, vector: &Stencil<Cyclotomic>) -> Cyclotomic {
    let n = ring.valence();
    let mut net = vec![Cyclotomic::zero(); ring.len()];
    for (point, value) in vector.terms() {
        net[point.index(n)] = value.clone();
    }
    let image = ring.refine(&net);
    let (point, value) = vector.terms().next().expect("a vector of the table");
    let eigenvalue = image[point.index(n)].clone() / value;
    let same = (image.iter().zip(&net)).all(|(a, b)| *a == b.clone() * &eigenvalue);
    assert!(same, "{vector:?} is no eigenvector of the masks");
    eigenvalue
}
