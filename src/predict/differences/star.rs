//! Second differences round one vertex, under subdivision: a closed linear system for every vertex.
//!
//! **Setting.** A vertex a of any valence, interior or on the boundary, and faces at it whose other corners
//! are regular (interior of valence 6 or 4, or boundary vertices of 3 or 2 faces). M is the largest of the
//! differences of [`super`] at the corners. Each step leaves such a face at a, and regular ones beside it.
//!
//! **Loop.** α_x = a + x - y - z for the interior spokes (a, x), y and z beside x; δ = 2a - p - q on the
//! boundary, p and q the boundary neighbours. With t = a - a', a' the new vertex point,
//!
//! ```text
//! α'_x = 3/8 α_x + 1/8 (α_y + α_z) - t      (α = 0 on boundary edges),
//! interior: t = b Σ α,  t' = (5/8 - n b) t;      boundary: t = δ/8,  δ' = δ/4;      sharp corner: t = 0.
//! ```
//!
//! (For a boundary neighbour p, e_p = (a + p)/2 is the edge point with a ghost that makes α_p = 0.) The
//! other differences of a child at a are those of edges at the edge points e_x: α' seen from x, and across
//! the corner at a of a triangle (a, x, y) `τ = 1/8 α_xy - 1/8 (α_x + α_y) + t`
//! ([`crate::bound::face_rate`]).
//!
//! **Catmull-Clark.** For interior spokes ρ_i = 2a - x_(i-1) - x_(i+1) and σ_i = 2x_i - d_i - d_(i+1), d_i the
//! vertex opposite to a in the quad between x_(i-1) and x_i. Written out from the masks,
//!
//! ```text
//! σ'_i = (ρ_i + σ_i)/8,
//! ρ'_i = (8 ρ_i + ρ_(i-1) + ρ_(i+1) + σ_(i-1) + σ_(i+1))/16 - 2t      (ρ = σ = 0 on boundary edges),
//! interior: t = (7 Σ ρ + Σ σ)/(8 n^2);      boundary: t = δ/8,  δ' = δ/4;      sharp corner: t = 0.
//! ```
//!
//! The other differences of a child at a: along a spoke `2e - a' - x' = -σ' + t_a + t_x`, t_x <= 1/4 at the
//! regular x (on a boundary edge σ' = 0); across a face `2f - e - e'`, a mean of four differences over 4;
//! rows through x or the faces beyond, regular, 1/4.
//!
//! Beside a regular boundary vertex a ghost row counts too (see [`super::quads`]): 2ρ_e - σ_e at the middle e of
//! a boundary edge at a is at most 2 (t_a + 1/8) + 1/4.
//!
//! So with s_i the largest row of the i-th power of the system and o_i a bound of the others, both relative
//! to M,
//!
//! ```text
//! r_i <= max(s_i, o_i),      o_0 = 1,
//! Loop:           o_(i+1) <= max((o_i + 2 s_i)/8 + t_i, r_i/4),
//! Catmull-Clark:  o_(i+1) <= max(σ_(i+1) + t_i + r_i/4, r_i/4).
//! ```
//!
//! Faces that step i + 1 sets free have M <= r_(i+1); R = r_1.
//!
//! **Distances.** F_(i+1) - F_i is affine (bilinear) on each child, 0 at new centres of quads, so at most
//! the largest of: t_i at a; 1/8 of a difference at an edge's middle; v_i at a regular vertex. Any regular vertex
//! has v_0 = 6/16 (Loop) or 1/4 (Catmull-Clark) of M. From level 1 on those near a are middles of edges (a, x), or
//! centres of quads, and their differences, summed by the identities above, leave
//!
//! ```text
//! Loop:           16 v_(i+1) = |1/4 α_x + 1/8 (four edges) + t_a + t_x| <= 9/8 r_i + t_i,
//! Catmull-Clark: 128 v_(i+1) = |14 (t_a + t_x) + ρ'_a + ρ'_x + φ + φ'| <= 14 (t_i + r_i/4) + s_(i+1) + 3/4 r_i,
//!     at centres               |14 (φ + φ') + Σ κ| <= 7 r_i + 4 r_(i+1),
//! ```
//!
//! φ = 2f - e - e' <= r_i/4 and κ = 2e - a' - x'. So with n_i = max(t_i, r_i/8) and D the constant of regular faces
//!
//! ```text
//! |S - F_K| <= n_K + .. + n_(i-1) + max(n_i, v_i) + D r_(i+1)     where step i + 1 > K frees a face,
//! |S - F_K| <= D r_(i+1) 4^-(K-i-1)                               where step i + 1 <= K does,
//! ```
//!
//! and over the face of level s that is left, n_K + .. + n_(s-1) and r_s times the constant at K = 0, which is
//! so bounded by itself. To limit meshes: and the largest distance of a vertex of level K to its limit.
//!
//! Source: derived here. The step by formula is tested against refinement, the bounds against certified distances.

use crate::scalar::float::gamma;
use crate::scheme::{LoopWeights, Scheme, loop_scheme};

/// Steps for which rows are computed; beyond, rates multiply.
pub const STEPS: usize = 16;

/// A vertex whose second differences form a closed system.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Vertex {
    /// All vertices that behave like those of a lattice: no system is needed.
    Regular,
    /// An interior vertex of that valence.
    Interior(u32),
    /// A boundary vertex with so many faces.
    Boundary(u32),
}

/// The largest rows at one level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows {
    /// s: all differences at the vertex, δ included.
    pub all: f64,
    /// The differences σ alone (Catmull-Clark).
    pub sigma: f64,
    /// t: the distance of the vertex to its next position.
    pub step: f64,
}

/// Bounds that follow for one vertex; relative to M, rounded upward.
#[derive(Clone, Debug, PartialEq)]
pub struct Star {
    /// r_i, i = 0..[`STEPS`].
    pub rates: Vec<f64>,
    /// |S - F_K|, K = 0..[`STEPS`].
    pub control: Vec<f64>,
    /// |S - L_K|, L_K the mesh of limit positions.
    pub limit: Vec<f64>,
}

/// Room for the roundings of a whole system: absolute, all quantities being of size 1 at most 2.
///
/// A step computes each row of the new system with at most n + 16 roundings relative to sums of absolute
/// values that are below 4, and a rounding made at step j is multiplied by rows of later steps, below 2:
/// STEPS times 8 γ(n + 16) in all.
fn slack(n: u32) -> f64 {
    STEPS as f64 * 8.0 * gamma(n.saturating_add(16).min(1 << 30))
}

/// Constants of regular faces that the argument uses.
#[derive(Clone, Copy, Debug)]
pub struct Lattice {
    /// C_0: |S - F_0| over M.
    pub control: f64,
    /// The distance of a regular vertex to its next position over M: 6/16 or 1/4.
    pub step: f64,
    /// The same to its limit: 6/12 or 1/3.
    pub limit: f64,
}

impl Star {
    /// The bounds for a vertex; `None` for schemes and vertices without such a system: Doo-Sabin, and regular
    /// vertices.
    pub fn new(scheme: Scheme, vertex: Vertex, lattice: Lattice) -> Option<Self> {
        let rows = rows(scheme, vertex)?;
        let is_loop = matches!(scheme, Scheme::Loop(_));
        let mut others = 1.0_f64;
        let mut rates = vec![1.0];
        for i in 0..STEPS {
            let rate = rates[i];
            let crossing = match is_loop {
                true => (others + 2.0 * rows[i].all) / 8.0 + rows[i].step,
                false => rows[i + 1].sigma + rows[i].step + rate / 4.0,
            };
            let ghost = match vertex {
                Vertex::Boundary(_) if !is_loop => 2.0 * rows[i].step + rate / 2.0,
                _ => 0.0,
            };
            others = up(crossing.max(ghost).max(rate / 4.0));
            rates.push(rows[i + 1].all.max(others));
        }
        let moves: Vec<Moves> = (0..STEPS)
            .map(|i| {
                let near = rows[i].step.max(rates[i] / 8.0);
                let regular = match i.checked_sub(1) {
                    None => lattice.step,
                    Some(j) if is_loop => (1.125 * rates[j] + rows[j].step) / 16.0,
                    Some(j) => {
                        let spoke = 14.0 * (rows[j].step + rates[j] / 4.0);
                        let middle = spoke + rows[i].all + 0.75 * rates[j];
                        let centre = 7.0 * rates[j] + 4.0 * rates[i];
                        middle.max(centre) / 128.0
                    }
                };
                let freed = near.max(regular) + lattice.control * rates[i + 1];
                Moves {
                    near: up(near),
                    freed: up(freed),
                }
            })
            .collect();
        // From level K on: over the faces that are set free, and what is walked to the one that is left.
        let from = |k: usize| {
            let (mut walked, mut largest) = (0.0_f64, 0.0_f64);
            for step in &moves[k..] {
                largest = largest.max(walked + step.freed);
                walked += step.near;
            }
            [largest, walked].map(|x| x * (1.0 + gamma(64)))
        };
        let last = rates[STEPS];
        let [freed, walked] = from(0);
        let first = match last < 1.0 {
            true => freed.max(up(walked / (1.0 - last).next_down())),
            false => f64::INFINITY,
        };
        let lattice_at = |k: usize| {
            let freed = (1..=k).map(|i| rates[i] * 0.25f64.powi((k - i) as i32));
            freed.fold(0.0, f64::max)
        };
        let control = |k: usize| {
            let [freed, walked] = from(k);
            let left = up(walked + last * first);
            freed.max(left).max(up(lattice.control * lattice_at(k)))
        };
        let control: Vec<f64> = (0..=STEPS)
            .map(|k| if k == 0 { first } else { control(k) })
            .collect();
        let to_limit = |k: usize| {
            let regular = lattice.limit * lattice_at(k).max(rates[k]);
            (limit_step(scheme, vertex) * rates[k]).max(regular)
        };
        Some(Star {
            limit: (0..=STEPS)
                .map(|k| up(control[k] + up(to_limit(k))))
                .collect(),
            rates,
            control,
        })
    }
}

/// How far the mesh moves in a step, over the face that stays, and over those set free with all further steps.
struct Moves {
    near: f64,
    freed: f64,
}

/// Rounded upward after a few operations on numbers of size 1.
fn up(x: f64) -> f64 {
    x * (1.0 + gamma(8))
}

/// `n b` of Loop's vertex mask.
fn ring_weight_sum(weights: LoopWeights, n: u32) -> Option<f64> {
    use crate::scalar::Interval;
    Some(loop_scheme::ring_weight_sum::<Interval>(weights, n)?.sup())
}

/// The distance of the vertex to its limit over M.
///
/// Loop: `a - a∞ = w Σ α`, n w = 8 n b/(3 + 8 n b); Catmull-Clark: `(5/2 Σ ρ + 1/2 Σ σ)/(n (n + 5))`, at most
/// 3/(n + 5); boundary: δ/6.
pub(super) fn limit_step(scheme: Scheme, vertex: Vertex) -> f64 {
    match (scheme, vertex) {
        (_, Vertex::Regular) | (Scheme::DooSabin, _) => 0.0,
        (_, Vertex::Boundary(_)) => up(1.0 / 6.0),
        (Scheme::Loop(weights), Vertex::Interior(n)) => {
            let nb = ring_weight_sum(weights, n).unwrap_or(1.0);
            up(8.0 * nb / (3.0 + 8.0 * nb))
        }
        (Scheme::CatmullClark, Vertex::Interior(n)) => up(3.0 / (f64::from(n) + 5.0)),
    }
}

/// The distance of the vertex to its next position over M.
pub(super) fn first_step(scheme: Scheme, vertex: Vertex) -> f64 {
    match (scheme, vertex) {
        (Scheme::DooSabin, _) => 0.0,
        (Scheme::Loop(_), Vertex::Regular) => 0.375,
        (Scheme::CatmullClark, Vertex::Regular) => 0.25,
        (_, Vertex::Boundary(_)) => 0.125,
        (Scheme::Loop(weights), Vertex::Interior(n)) => ring_weight_sum(weights, n).unwrap_or(1.0),
        (Scheme::CatmullClark, Vertex::Interior(n)) => up(1.0 / f64::from(n)),
    }
}

/// The rows of the powers 0..[`STEPS`] of the system, rounded upward.
fn rows(scheme: Scheme, vertex: Vertex) -> Option<Vec<Rows>> {
    match (scheme, vertex) {
        (Scheme::DooSabin, _) | (_, Vertex::Regular) => None,
        (Scheme::Loop(weights), Vertex::Interior(n)) => {
            let nb = ring_weight_sum(weights, n)?;
            Some(loop_interior(n, nb))
        }
        (Scheme::Loop(_), Vertex::Boundary(m)) => Some(boundary(m, loop_boundary_step)),
        (Scheme::CatmullClark, Vertex::Interior(n)) => Some(quad_interior(n)),
        (Scheme::CatmullClark, Vertex::Boundary(m)) => Some(boundary(m, quad_boundary_step)),
    }
}

/// Row i is the i-fold convolution of (1/8, 3/8, 1/8) round the ring less a constant: sums of rows are
/// (5/8)^i without and (5/8 - n b)^i with it.
fn loop_interior(n: u32, nb: f64) -> Vec<Rows> {
    let count = n as usize;
    let mut row = vec![0.0; count];
    row[0] = 1.0;
    let (mut whole, mut mean, mut step) = (1.0, 1.0, nb);
    let mut all = Vec::new();
    for _ in 0..=STEPS {
        let constant = (whole - mean) / f64::from(n);
        let sum: f64 = row.iter().map(|c| (c - constant).abs()).sum();
        let sum = sum + slack(n);
        all.push(Rows {
            all: sum,
            sigma: 0.0,
            step: up(step),
        });
        let beside = |i: usize| row[(i + 1) % count] + row[(i + count - 1) % count];
        row = (0..count)
            .map(|i| 0.375 * row[i] + 0.125 * beside(i))
            .collect();
        whole *= 0.625;
        mean *= 0.625 - nb;
        step *= (0.625 - nb).abs() + gamma(8);
    }
    all
}

/// The rows of ρ_0 and of σ_0, as functionals of (ρ, σ); the others are their rotations.
fn quad_interior(n: u32) -> Vec<Rows> {
    let count = n as usize;
    let size = f64::from(n);
    // row[0]: coefficients of ρ, row[1]: of σ; from the left, row T.
    let mut rho = [vec![0.0; count], vec![0.0; count]];
    rho[0][0] = 1.0;
    let mut sigma = [vec![0.0; count], vec![0.0; count]];
    sigma[1][0] = 1.0;
    // t at each level is that functional of level 0, over the ring: constant coefficients.
    let mut step = [7.0 / (8.0 * size * size), 1.0 / (8.0 * size * size)];
    let next = |row: &[Vec<f64>; 2]| -> [Vec<f64>; 2] {
        let [r, s] = row;
        let total: f64 = r.iter().sum();
        let beside = |i: usize| r[(i + 1) % count] + r[(i + count - 1) % count];
        let spread = 2.0 * total / (8.0 * size * size);
        [
            (0..count)
                .map(|i| 0.5 * r[i] + beside(i) / 16.0 + s[i] / 8.0 - 7.0 * spread)
                .collect(),
            (0..count)
                .map(|i| beside(i) / 16.0 + s[i] / 8.0 - spread)
                .collect(),
        ]
    };
    let weight = |row: &[Vec<f64>; 2]| -> f64 {
        row.iter().flatten().map(|x| x.abs()).sum::<f64>() + slack(n)
    };
    let mut all = Vec::new();
    for _ in 0..=STEPS {
        let sigma_row = weight(&sigma);
        all.push(Rows {
            all: weight(&rho).max(sigma_row),
            sigma: sigma_row,
            step: size * (step[0].abs() + step[1].abs()) + slack(n),
        });
        (rho, sigma) = (next(&rho), next(&sigma));
        // Σ over a constant row: the sums of the ring.
        let [r, s] = step;
        let spread = 2.0 * size * r / (8.0 * size * size);
        step = [
            0.625 * r + s / 8.0 - 7.0 * spread,
            r / 8.0 + s / 8.0 - spread,
        ];
    }
    all
}

/// At the boundary the coefficients of ρ, σ or α stay positive, and that of δ negative: two vectors, the sums
/// of the former and the latter's size, suffice.
///
/// `next` maps the vectors of one level, spokes with boundary zeros at both ends, to those of the next,
/// given 4^-i.
fn boundary(m: u32, next: fn(&System, f64) -> System) -> Vec<Rows> {
    let spokes = (m as usize).saturating_sub(1);
    let mut system = System::new(spokes);
    let (mut power, mut all) = (1.0, Vec::new());
    for _ in 0..=STEPS {
        let largest = |[a, d]: &[Vec<f64>; 2]| {
            let rows = a.iter().zip(d).map(|(a, d)| a + d);
            rows.fold(0.0, f64::max)
        };
        let sigma = largest(&system.sigma) * (1.0 + slack(16));
        let rho = largest(&system.rho) * (1.0 + slack(16));
        all.push(Rows {
            all: rho.max(sigma).max(power),
            sigma,
            step: power / 8.0,
        });
        system = next(&system, power);
        power /= 4.0;
    }
    all
}

/// Rows of differences at the spokes: the sum of the coefficients of all first differences but δ, and the
/// size of that of δ. Zeros at both ends stand for the boundary edges.
struct System {
    rho: [Vec<f64>; 2],
    sigma: [Vec<f64>; 2],
}

impl System {
    fn new(spokes: usize) -> Self {
        let mut ones = vec![1.0; spokes + 2];
        (ones[0], ones[spokes + 1]) = (0.0, 0.0);
        let zeros = vec![0.0; spokes + 2];
        System {
            rho: [ones.clone(), zeros.clone()],
            sigma: [ones, zeros],
        }
    }
}

/// At the inner spokes of a vector; 0 at both ends.
fn inner(size: usize, at: impl Fn(usize) -> f64) -> Vec<f64> {
    let is_inner = |i: usize| i > 0 && i + 1 < size;
    (0..size)
        .map(|i| if is_inner(i) { at(i) } else { 0.0 })
        .collect()
}

/// α (here `rho`) alone.
fn loop_boundary_step(system: &System, power: f64) -> System {
    let size = system.rho[0].len();
    let step =
        |v: &[f64], add: f64| inner(size, |i| 0.375 * v[i] + 0.125 * (v[i - 1] + v[i + 1]) + add);
    let zeros = vec![0.0; size];
    System {
        rho: [step(&system.rho[0], 0.0), step(&system.rho[1], power / 8.0)],
        sigma: [zeros.clone(), zeros],
    }
}

fn quad_boundary_step(system: &System, power: f64) -> System {
    let size = system.rho[0].len();
    let both = |k: usize, add: f64| {
        let (r, s) = (&system.rho[k], &system.sigma[k]);
        let rho = inner(size, |i| {
            0.5 * r[i] + (r[i - 1] + r[i + 1] + s[i - 1] + s[i + 1]) / 16.0 + add
        });
        (rho, inner(size, |i| (r[i] + s[i]) / 8.0))
    };
    let ((r0, s0), (r1, s1)) = (both(0, 0.0), both(1, power / 4.0));
    System {
        rho: [r0, r1],
        sigma: [s0, s1],
    }
}
