//! The distances μ at levels beyond the table, by a recurrence in the level.
//!
//! **Theorem.** Let e be the spline of a mode with eigenvalue λ, and s >= l = [`BASE`] a level. With
//!
//! ```text
//! R = max over the triangles T of level l in ring 0 of  E(β) + C M_T(z - q) + C δ_T M_T(χ),    z = y - A(X),
//! ```
//!
//! `μ(m + 1) <= max(|λ| μ(m), 4^-(m+1-l) R)` for m + 1 >= l.
//!
//! | symbol | meaning |
//! |---|---|
//! | C | C_0(6), or B_0(6) for limit meshes ([`super::regular`]) |
//! | X, y | the control points of level l of the characteristic map χ and of the mode |
//! | A | an affine function of the plane; any will do, taken is about the one with `A(X) = y` at the corners of T |
//! | N(T) | the lattice points within two steps of a corner of T, in the sector or in the rows beside its rays |
//! | M_T | the largest second difference of the 15 edges at the corners of T |
//! | q, β | a quadratic polynomial on the lattice with second differences β_k, k = 0, 1, 2, of the edges of the three directions; any will do |
//! | E(β) | how far the spline of q is from its mesh: below |
//! | a_k, f_k, k = 1, 2 | the largest steps of X and of z along edges of N(T) in the direction (1,0), (0,1) |
//! | D_T | the least determinant of a step of X in the direction (1,0) and one in the direction (0,1) |
//! | δ_T | `(f_1 a_2 + f_2 a_1) / D_T` |
//!
//! It is used where all D_T > 0 and `C M_T(χ) (a_1 + a_2) < D_T`, which is checked.
//!
//! **What is bounded** is what the table bounds: at each point σ of S_n, |e(σ) - E_m| at *one* point of
//! the level-m facets, the same for all modes, that lies over χ(σ). Only so do the distances of modes add
//! up, and only so have the constant and χ none. To compare each patch with the facet of the same
//! parameters is simpler, but there χ has a distance itself, and that falls by λ_1 from level to level, more slowly
//! than an estimate should.
//!
//! **Proof.** *Scaling* ([`crate::spectrum::eigenspline`]): over the rings r >= 1 the level-(m+1) mesh of y
//! is the level-m mesh of Ay = λy. What is left is ring 0 at a level s >= l. Let T_s be one of its triangles of
//! level s, in T.
//!
//! *Means.* The points of level s + 1 within two steps of a corner of a part of T_s are means of points of level
//! s within two steps of a corner of T_s: such a point is at most one step of level s from the corner, and a mask
//! reaches one step further. From radius 2^(s+1) + 2 masks reach 2^s + 2 at most, and from the row beside a
//! ray no further than that row. With `Δ[p,q]` the step from (p,q) in the direction (1,0), twice a step of the next
//! level is
//!
//! ```text
//! (5 Δ[0,0] + Δ[-1,0] + Δ[-1,1] + Δ[0,-1]) / 8    from a vertex (0,0) to the middle of its edge,
//! (4 Δ[0,0] + 2 Δ[0,1] + 2 Δ[-1,1]) / 8           from the middle of (0,0)(0,1) to that of (1,0)(0,1):
//! ```
//!
//! a mean of steps in the same direction; likewise in the other one, and from middles to vertices. So
//! is the step between limit points, `Δ/2 + (Σ of six)/12`. Hence 2^(s-l) times the steps of level s between control
//! points or limit points within one step of T_s lie in the hulls of the steps in N(T).
//!
//! *Facets near T_s.* Let U be the facets of the sector that have a corner in common with T_s: a
//! convex part of the lattice, on which X_s is affine by pieces. For two of its points with `b - a = (α, β)` is
//! `X_s(b) - X_s(a) = α u + β v`, u and v in those hulls up to scale, `det(u, v) > 0`: X_s is injective on U. On each
//! facet z has a gradient g with `g u = Δ_1 z`, `g v = Δ_2 z`, thus `|g| <= δ_T`: the determinant is affine in
//! each of u, v. At a ray, steps along the ray are among the u or v, so that all others point to the sector's
//! side of it: the facets of U stay in the wedge of the sector, as χ does.
//!
//! *Matching.* Let σ be in T_s and x the point of the facet T_s with the same parameters:
//! `|χ(σ) - x| <= d = C 4^-(s-l) M_T(χ)`. The function that is affine on each facet of U, 1 at the corners of
//! T_s and 0 at the other vertices, falls at most at the rate 1/h, h the least altitude of a facet;
//! `h >= 2^-(s-l) D_T / (a_1 + a_2) > d`. So the segment from x to χ(σ), followed facet by facet, ends within U, at
//! the one point of U over χ(σ): that is the point meant above. With the mesh Z of z
//!
//! ```text
//! |e(σ) - E(χ(σ))| = |z(σ) - Z(χ(σ))| <= |z(σ) - Z(x)| + |Z(x) - Z(χ(σ))|,    the latter at most δ_T d.
//! ```
//!
//! *Nearly quadratic.* z = q + (z - q), and the distance of z - q is at most `C 4^-(s-l) M_T(z - q)`. The second
//! difference of q along an edge of direction k is `-(β_i + β_j)`, {i, j, k} = {0, 1, 2}; so masks add
//! `-(β_0 + β_1 + β_2)/8` to q in the first step, at vertices and at middles of edges alike, and a quarter of that in each
//! further one: its second differences of level s are 4^-(s-l) β, and limit points are `-(β_0 + β_1 + β_2)/6`
//! off. At the barycentric coordinates t of a facet, spline less mesh is 4^-(s-l) times
//!
//! ```text
//! -Σ w(t_k) β_k,    w(t) = 1/6 - t (1 - t)/2,  without 1/6 for limit meshes.
//! ```
//!
//! E(β) is the largest magnitude at the points with multiples of 1/N, and `max |β_i + β_j| / (6 N^2)` for those
//! between: so far is a quadratic polynomial with these second differences from its linear interpolant.
//!
//! *A generalised mode* (n = 3), `Ay = λy + κf`, f = Σ of the modes Ray: its level-(m+1) distance over the rings
//! r >= 1 is at most `|λ| μ(m) + |κ| 2 μ_ray(m)`, as two of the modes Ray have values in a sector.
//!
//! Which facets may lie beyond S_n is the same question as for the table, see [`super::inside`]. Source:
//! derived here; the scaling is Peters & Wu's Lemma 3.

use num_traits::Zero;
use rayon::prelude::*;

use super::kernel::ModeWeights;
use super::regular;
use super::table;
use crate::bound::Against;
use crate::scalar::{Field, Interval, Ring};
use crate::scheme::LoopWeights;
use crate::spectrum::eigenspline::complex::Complex;
use crate::spectrum::eigenspline::lattice::{Lattice, Levels, NEIGHBOURS, Place, Triangle};
use crate::spectrum::eigenspline::maximum::magnitude;
use crate::spectrum::eigenspline::mode::{CHAINED, Net, nets};
use crate::spectrum::eigenspline::plane::ring;

/// The level l whose nets are looked at.
pub const BASE: usize = 6;

/// N of E(β).
const PARTS: i64 = 8;

type Value = Complex<Interval>;

/// What the recurrence of a valence needs.
#[derive(Clone, Debug)]
pub struct Recurrence {
    /// Upper bounds of |λ|.
    eigenvalues: ModeWeights,
    /// Upper bounds of R.
    outer: ModeWeights,
    /// An upper bound of |κ| of the mode of frequency 0.
    chain: f64,
}

impl Recurrence {
    /// That of a valence n >= 3, in intervals.
    ///
    /// `None` if a determinant is not shown to be large enough.
    pub fn new(weights: LoopWeights, n: u32, against: Against) -> Option<Self> {
        let constant = regular::factor(against, 0);
        if regular::factor(against, 1) != constant / 4.0 {
            return None;
        }
        let (chi, modes) = nets::<Interval>(weights, n)?;
        let chi = Levels::new(&chi, None, BASE);
        let mesh = Mesh::new(against, Interval::point(constant));
        let pieces = ring(BASE).into_par_iter();
        let pieces = pieces.map(|triangle| Piece::new(chi.level(BASE, 0), triangle, &mesh));
        let pieces = pieces.collect::<Option<Vec<_>>>()?;
        let chained = modes.iter().find(|net| net.label == CHAINED);
        let chained = chained.map(|net| Levels::new(net, None, BASE));
        let outer = modes.par_iter().map(|net| {
            let chain = chained.as_ref().zip(net.kappa.as_ref());
            (
                net.label,
                outer(net, &Levels::new(net, chain, BASE), &pieces, &mesh),
            )
        });
        let outer: Vec<_> = outer.collect();
        let eigenvalues = modes.iter().map(|net| (net.label, net.eigenvalue.mag()));
        let chain = modes.iter().filter_map(|net| net.kappa);
        Some(Recurrence {
            eigenvalues: table::complete(n, eigenvalues)?,
            outer: table::complete(n, outer.into_iter())?,
            chain: chain.fold(0.0, |most, kappa| most.max(kappa.mag())),
        })
    }

    /// Upper bounds of μ(m + 1) from those of μ(m), rounded upwards.
    ///
    /// # Panics
    /// If m + 1 < [`BASE`].
    pub fn next(&self, distances: &ModeWeights, m: u32) -> ModeWeights {
        let steps = (m + 1).checked_sub(BASE as u32);
        let steps = steps.expect("a level with known triangles");
        // Exact.
        let factor = 0.25_f64.powi(steps as i32);
        let step = |lambda: f64, mu: f64, outer: f64, more: f64| {
            let inner = ((lambda * mu).next_up() + more).next_up();
            inner.max((factor * outer).next_up())
        };
        // Two rays with values in a sector; doubling is exact.
        let more = (self.chain * (2.0 * distances.ray)).next_up();
        let ring = (self.eigenvalues.ring.iter().zip(&distances.ring)).zip(&self.outer.ring);
        let ring = ring.enumerate().map(|(i, ((lambda, mu), outer))| {
            let more = if i == 0 && self.chain > 0.0 {
                more
            } else {
                0.0
            };
            step(*lambda, *mu, *outer, more)
        });
        let (lambda, outer) = (&self.eigenvalues, &self.outer);
        ModeWeights {
            ring: ring.collect(),
            between: step(lambda.between, distances.between, outer.between, 0.0),
            ray: step(lambda.ray, distances.ray, outer.ray, 0.0),
        }
    }
}

/// The mesh that distances are measured from.
#[derive(Debug)]
struct Mesh {
    /// C.
    constant: Interval,
    /// w at the three barycentric coordinates of the points of E(β).
    weights: Vec<[Interval; 3]>,
}

impl Mesh {
    fn new(against: Against, constant: Interval) -> Self {
        let corner = match against {
            Against::Control => Interval::ratio(1, 6),
            Against::Limit => Interval::from_integer(0),
        };
        let weight = |i: i64| corner - Interval::ratio(i * (PARTS - i), 2 * PARTS * PARTS);
        let points = (0..=PARTS).flat_map(|i| (0..=PARTS - i).map(move |j| [i, j, PARTS - i - j]));
        Mesh {
            constant,
            weights: points.map(|point| point.map(weight)).collect(),
        }
    }

    /// E(β).
    fn quadratic(&self, beta: &[Value; 3]) -> Interval {
        let [x, y, z] = beta;
        let at = |[u, v, w]: &[Interval; 3]| *x * u + *y * v + *z * w;
        let between = largest([*x + y, *y + z, *z + x].into_iter());
        largest(self.weights.iter().map(at)) + between * Interval::ratio(1, 6 * PARTS * PARTS)
    }
}

/// A triangle of level l and what is needed of χ near it.
#[derive(Debug)]
struct Piece {
    triangle: Triangle,
    /// Two edges of T in the plane of χ, about.
    edges: [Complex<f64>; 2],
    /// The edges of N(T) in the directions (1,0) and (0,1), and the steps of X along them.
    steps: [Vec<(Place, Value)>; 2],
    /// The edges at corners of T, by corner and direction, and the second differences of X.
    bends: Vec<(Place, usize, Value)>,
    /// a_1, a_2.
    longest: [Interval; 2],
    /// D_T, from below.
    determinant: Interval,
    /// M_T(χ).
    second_difference: Interval,
}

impl Piece {
    /// `None` if the determinant is not shown to be large enough.
    fn new(chi: &Lattice<Interval>, triangle: Triangle, mesh: &Mesh) -> Option<Self> {
        let around = around(triangle);
        let steps = [0, 1].map(|k| {
            let edges = (around.iter())
                .filter(|&&place| around.contains(&moved(place, k)))
                .map(|&place| (place, step(chi, place, k)));
            edges.collect::<Vec<_>>()
        });
        let corners = triangle.corners().into_iter();
        let bends: Vec<_> = corners
            .flat_map(|place| (0..6).map(move |k| (place, k)))
            .map(|(place, k)| (place, k, bend(chi, place, k)))
            .collect();
        let longest = [0, 1].map(|k| largest(steps[k].iter().map(|(_, u)| *u)));
        let crosses =
            (steps[0].iter()).flat_map(|(_, u)| steps[1].iter().map(|(_, v)| u.cross(v).inf()));
        let determinant = Interval::point(crosses.fold(f64::INFINITY, f64::min));
        let second_difference = largest(bends.iter().map(|(_, _, x)| *x));
        let away = mesh.constant * second_difference;
        let enough = (away * (longest[0] + longest[1])).sup() < determinant.inf();
        enough.then_some(Piece {
            triangle,
            edges: edges(chi, triangle),
            steps,
            bends,
            longest,
            determinant,
            second_difference,
        })
    }

    /// `E(β) + C M_T(z - q) + C δ_T M_T(χ)`.
    fn outer(&self, y: &Lattice<Interval>, mesh: &Mesh) -> f64 {
        let point = |z: Complex<f64>| Complex {
            re: Interval::point(z.re),
            im: Interval::point(z.im),
        };
        let [gx, gy] = self.gradient(edges(y, self.triangle)).map(point);
        // A difference of z from those of y and X.
        let z = |y: Value, x: &Value| y - &(gx * &x.re + gy * &x.im);
        let [f, g] = [0, 1].map(|k| {
            let steps = self.steps[k].iter();
            largest(steps.map(|(place, x)| z(step(y, *place, k), x)))
        });
        let slope = (f * self.longest[1] + g * self.longest[0]) / self.determinant;
        let bends = self.bends.iter();
        let bends = bends.map(|(place, k, x)| (k % 3, z(bend(y, *place, *k), x)));
        let bends: Vec<(usize, Value)> = bends.collect();
        let beta = [0, 1, 2].map(|k| point(middle(&bends, k)));
        let rest = largest(bends.iter().map(|(k, bend)| *bend - &beta[*k]));
        let second_differences = rest + slope * self.second_difference;
        (mesh.quadratic(&beta) + mesh.constant * second_differences).sup()
    }

    /// The linear part of A along x and along y, about, from what it is along the edges u, v: p, q.
    fn gradient(&self, [p, q]: [Complex<f64>; 2]) -> [Complex<f64>; 2] {
        let [u, v] = self.edges;
        let inverse = 1.0 / u.cross(&v);
        [
            (p * &v.im - &(q * &u.im)) * &inverse,
            (q * &u.re - &(p * &v.re)) * &inverse,
        ]
    }
}

/// R.
fn outer(net: &Net<Interval>, y: &Levels<Interval>, pieces: &[Piece], mesh: &Mesh) -> f64 {
    let symmetric = net.label.is_mirror_symmetric();
    let counted = |piece: &&Piece| !symmetric || piece.triangle.p >= piece.triangle.q;
    let over = |sector: usize| {
        let y = y.level(BASE, sector);
        let values = pieces
            .iter()
            .filter(counted)
            .map(|piece| piece.outer(y, mesh));
        values.fold(0.0, f64::max)
    };
    (0..net.label.sectors()).map(over).fold(0.0, f64::max)
}

/// The middle of the smallest box around the second differences of a direction, about.
fn middle(bends: &[(usize, Value)], direction: usize) -> Complex<f64> {
    let own = bends.iter().filter(|(k, _)| *k == direction);
    let hull = own.map(|(_, z)| *z).reduce(|a, b| Complex {
        re: a.re.hull(b.re),
        im: a.im.hull(b.im),
    });
    hull.map_or_else(Complex::zero, |hull| hull.mid())
}

/// The edges from corner 0 of a triangle to the others, about.
fn edges(lattice: &Lattice<Interval>, triangle: Triangle) -> [Complex<f64>; 2] {
    let [o, a, b] = triangle.corners().map(|place| lattice.at(place).mid());
    [a - &o, b - &o]
}

/// N(T).
fn around(triangle: Triangle) -> Vec<Place> {
    let radius = (1 << BASE) + 2;
    let near = |[p, q]: Place| {
        let corners = triangle.corners();
        corners.iter().any(|c| {
            let [p, q] = [p - c[0], q - c[1]];
            p.abs().max(q.abs()).max((p + q).abs()) <= 2
        })
    };
    let Triangle { p, q, .. } = triangle;
    let places = (p - 2..=p + 3).flat_map(|p| (q - 2..=q + 3).map(move |q| [p, q]));
    places
        .filter(|&[p, q]| p >= -1 && q >= -1 && p.max(0) + q.max(0) <= radius)
        .filter(|&place| near(place))
        .collect()
}

fn moved([p, q]: Place, direction: usize) -> Place {
    let [dp, dq] = NEIGHBOURS[direction % 6];
    [p + dp, q + dq]
}

/// The step along an edge.
fn step(lattice: &Lattice<Interval>, place: Place, k: usize) -> Value {
    *lattice.at(moved(place, k)) - lattice.at(place)
}

/// The second difference of an edge: the sum of its ends less that of the vertices across it.
fn bend(lattice: &Lattice<Interval>, place: Place, k: usize) -> Value {
    let at = |k: usize| lattice.at(moved(place, k));
    *lattice.at(place) + at(k) - at(k + 1) - at(k + 5)
}

/// The largest magnitude, from above.
fn largest(values: impl Iterator<Item = Value>) -> Interval {
    Interval::point(values.map(|z| magnitude(&z).sup()).fold(0.0, f64::max))
}
