//! The control nets of all levels over one sector, on a triangular lattice.
//!
//! ```text
//!   q                        (p, q), p, q >= 0: sector 0; (p, 0) on the ray of a_0, (0, q) on that of a_1
//!   3 .                      neighbours differ by ±(1,0), ±(0,1), ±(1,-1)
//!   2 b1  .                  halo: (p, -1) and (-1, q), points of the sectors before and behind
//!   1 a1  d0  .
//!   0 O   a0  b0  .
//!  -1     h   h   h
//!     0   1   2   3  p
//! ```
//!
//! Radius is p + q in a point's own sector; (p, -1) is the point (1, p-1) of the sector before. The
//! points O, a_j of level s are λ^s times those of level 0, for the mode is an eigenvector; all other
//! rules met are those of valence 6. Points of radius 3 are chosen so that the net on the three-ring is
//! an eigenvector too: they are the points of level 1 there, over λ.

use num_traits::Zero;

use super::complex::Complex;
use super::mode::{Link, Net};
use crate::scalar::{Field, Interval};
use crate::scheme::loop_scheme::{edge_point, limit_mask, vertex_mask};
use crate::scheme::{LoopWeights, StarMask};

/// A point (p, q).
pub type Place = [i32; 2];

/// The six neighbours, in cyclic order.
pub const NEIGHBOURS: [Place; 6] = [[1, 0], [0, 1], [-1, 1], [-1, 0], [0, -1], [1, -1]];

/// The values of one sector up to a radius, with the halo.
#[derive(Clone, Debug)]
pub struct Lattice<S> {
    radius: i32,
    values: Vec<Complex<S>>,
}

impl<S: Field> Lattice<S> {
    fn new(radius: i32) -> Self {
        let side = (radius + 2) as usize;
        Lattice {
            radius,
            values: vec![Complex::zero(); side * side],
        }
    }

    fn index(&self, [p, q]: Place) -> usize {
        let radius = p.max(0) + q.max(0);
        assert!(
            p >= -1 && q >= -1 && radius <= self.radius,
            "[{p}, {q}] is outside of radius {}",
            self.radius
        );
        ((p + 1) * (self.radius + 2) + q + 1) as usize
    }

    /// The value at a point.
    pub fn at(&self, place: Place) -> &Complex<S> {
        &self.values[self.index(place)]
    }

    fn set(&mut self, place: Place, value: Complex<S>) {
        let index = self.index(place);
        self.values[index] = value;
    }

    /// The sum over the six neighbours.
    fn ring_sum(&self, [p, q]: Place) -> Complex<S> {
        NEIGHBOURS.iter().fold(Complex::zero(), |sum, [dp, dq]| {
            sum + self.at([p + dp, q + dq])
        })
    }

    /// The limit point of a vertex other than O: `P/2 + (Σ of six)/12`.
    pub fn limit(&self, place: Place, mask: &StarMask<S>) -> Complex<S> {
        mask.apply_ring(self.at(place), &self.ring_sum(place))
    }

    /// The point of the next level at (p, q), in its own lattice; not O, a_j.
    fn refined(&self, [p, q]: Place, vertex: &StarMask<S>) -> Complex<S> {
        let low = [p.div_euclid(2), q.div_euclid(2)];
        let at = |dp: i32, dq: i32| self.at([low[0] + dp, low[1] + dq]);
        match (p.rem_euclid(2), q.rem_euclid(2)) {
            (0, 0) => vertex.apply_ring(self.at(low), &self.ring_sum(low)),
            (1, 0) => edge_point::<S, _>(at(0, 0), at(1, 0), at(0, 1), at(1, -1)),
            (0, _) => edge_point::<S, _>(at(0, 0), at(0, 1), at(1, 0), at(-1, 1)),
            (_, _) => edge_point::<S, _>(at(1, 0), at(0, 1), at(0, 0), at(1, 1)),
        }
    }

    /// p1..p12 of the patch over a triangle: its corner 0, and the steps to corners 1 and 2.
    pub fn patch_net(&self, triangle: Triangle) -> [Complex<S>; 12] {
        let [x, a, b] = triangle.corners();
        let e = [[a[0] - x[0], a[1] - x[1]], [b[0] - x[0], b[1] - x[1]]];
        let at = |i: i32, j: i32| {
            let coordinate = |c: usize| x[c] + i * e[0][c] + j * e[1][c];
            self.at([coordinate(0), coordinate(1)]).clone()
        };
        [
            at(0, -1),
            at(-1, 0),
            at(1, -1),
            at(0, 0),
            at(-1, 1),
            at(2, -1),
            at(1, 0),
            at(0, 1),
            at(-1, 2),
            at(2, 0),
            at(1, 1),
            at(0, 2),
        ]
    }
}

/// A triangle of the lattice: (p,q), (p+1,q), (p,q+1), or, `down`, (p+1,q+1), (p,q+1), (p+1,q).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Triangle {
    /// First coordinate.
    pub p: i32,
    /// Second coordinate.
    pub q: i32,
    /// Which of the two.
    pub down: bool,
}

impl Triangle {
    /// The corners, in order.
    pub fn corners(self) -> [Place; 3] {
        let Triangle { p, q, down } = self;
        if down {
            [[p + 1, q + 1], [p, q + 1], [p + 1, q]]
        } else {
            [[p, q], [p + 1, q], [p, q + 1]]
        }
    }

    /// The triangle across the edge opposite to a corner.
    pub fn across(self, corner: usize) -> Triangle {
        let Triangle { p, q, down } = self;
        let sign = if down { 1 } else { -1 };
        let [dp, dq] = [[0, 0], [sign, 0], [0, sign]][corner];
        Triangle {
            p: p + dp,
            q: q + dq,
            down: !down,
        }
    }

    /// Whether the edge opposite to a corner lies on a ray.
    pub fn edge_on_ray(self, corner: usize) -> bool {
        !self.down && ((corner == 1 && self.p == 0) || (corner == 2 && self.q == 0))
    }

    /// The triangles in p, q >= 0 that have a corner in common with this one, itself included.
    pub fn touching(self) -> Vec<Triangle> {
        let mut list: Vec<Triangle> = (self.corners().iter())
            .flat_map(|&[p, q]| {
                [
                    (p, q, false),
                    (p - 1, q, false),
                    (p, q - 1, false),
                    (p - 1, q - 1, true),
                    (p, q - 1, true),
                    (p - 1, q, true),
                ]
            })
            .filter(|&(p, q, _)| p >= 0 && q >= 0)
            .map(|(p, q, down)| Triangle { p, q, down })
            .collect();
        list.sort();
        list.dedup();
        list
    }

    /// The triangles in p, q >= 0 between two radii.
    pub fn between(inner: i32, outer: i32) -> Vec<Triangle> {
        let mut list = Vec::new();
        for p in 0..outer {
            for q in 0..outer - p {
                for down in [false, true] {
                    let triangle = Triangle { p, q, down };
                    let radii = triangle.corners().map(|[p, q]| p + q);
                    if radii.iter().all(|r| (inner..=outer).contains(r)) {
                        list.push(triangle);
                    }
                }
            }
        }
        list
    }
}

/// The nets of a mode at levels 0, 1, .., of each sector that it lists.
#[derive(Clone, Debug)]
pub struct Levels<S> {
    /// By level, by sector: level 0 up to radius 3, level s up to `2^s + 2`.
    levels: Vec<Vec<Lattice<S>>>,
    limit: StarMask<S>,
}

impl<S: Field> Levels<S> {
    /// The levels 0..=last of a net, `A net = eigenvalue net + kappa f`; `f` is given with κ.
    pub fn new(net: &Net<S>, chain: Option<(&Levels<S>, &S)>, last: usize) -> Self {
        let regular = |mask: fn(LoopWeights, u32) -> Option<StarMask<S>>| {
            mask(LoopWeights::Warren, 6).expect("rational masks")
        };
        let (vertex, limit) = (regular(vertex_mask), regular(limit_mask));
        let two_ring: Vec<Lattice<S>> = (net.sectors.iter())
            .map(|sector| {
                let mut lattice = Lattice::new(2);
                for (place, value) in &sector.points {
                    lattice.set(*place, value.clone());
                }
                lattice
            })
            .collect();
        let two_ring = with_halos(net, two_ring);
        // The three-ring.
        let mut first: Vec<Lattice<S>> = two_ring
            .iter()
            .map(|inner| {
                let mut lattice = Lattice::new(3);
                for p in 0..=2 {
                    for q in 0..=2 - p {
                        lattice.set([p, q], inner.at([p, q]).clone());
                    }
                }
                lattice
            })
            .collect();
        let inverse = S::one() / &net.eigenvalue;
        for (j, lattice) in first.iter_mut().enumerate() {
            for q in 0..=3 {
                let place = [3 - q, q];
                let mut image = two_ring[j].refined(place, &vertex);
                if let Some((f, kappa)) = chain {
                    image = image - &(f.levels[0][j].at(place).clone() * kappa);
                }
                lattice.set(place, image * &inverse);
            }
        }
        let mut levels = vec![with_halos(net, first)];
        for s in 1..=last {
            let radius = (1 << s) + 2;
            let next = levels[s - 1].iter().map(|coarse| {
                let mut fine = Lattice::new(radius);
                for p in 0..=radius {
                    for q in 0..=radius - p {
                        let value = match p + q {
                            0 | 1 => coarse.at([p, q]).clone() * &net.eigenvalue,
                            _ => coarse.refined([p, q], &vertex),
                        };
                        fine.set([p, q], value);
                    }
                }
                fine
            });
            let next = with_halos(net, next.collect());
            levels.push(next);
        }
        Levels { levels, limit }
    }

    /// A level of a sector.
    pub fn level(&self, s: usize, sector: usize) -> &Lattice<S> {
        &self.levels[s][sector]
    }

    /// The number of sectors.
    pub fn sectors(&self) -> usize {
        self.levels[0].len()
    }

    /// The vertex of the level-s polyhedron at a point: the control point or its limit.
    pub fn vertex(&self, s: usize, sector: usize, place: Place, limit: bool) -> Complex<S> {
        let lattice = self.level(s, sector);
        match (limit, place) {
            (true, [0, 0]) => Complex::zero(),
            (true, _) => lattice.limit(place, &self.limit),
            (false, _) => lattice.at(place).clone(),
        }
    }
}

/// The points (p, -1) and (-1, q), from the neighbouring sectors.
fn with_halos<S: Field>(net: &Net<S>, lattices: Vec<Lattice<S>>) -> Vec<Lattice<S>> {
    let mut complete = lattices.clone();
    for (sector, lattice) in net.sectors.iter().zip(&mut complete) {
        let value = |link: &Link<S>, [p, q]: Place| match link {
            Link::Zero => Complex::zero(),
            Link::Turned(phase) => lattices[0].at([p, q]).times(phase),
            Link::Plain(j) => lattices[*j].at([p, q]).clone(),
            Link::Mirrored(j) => lattices[*j].at([q, p]).clone(),
        };
        for i in 1..=lattice.radius {
            lattice.set([i, -1], value(&sector.before, [1, i - 1]));
            lattice.set([-1, i], value(&sector.behind, [i - 1, 1]));
        }
    }
    complete
}

impl Complex<Interval> {
    /// The middles of the parts.
    pub fn mid(&self) -> Complex<f64> {
        Complex {
            re: self.re.mid(),
            im: self.im.mid(),
        }
    }
}
