//! The net on a closed triangle mesh that makes a functional as large as possible against the vertex
//! displacements.
//!
//! The displacement of a vertex is `d_v = g_v (P_v - mean of its ring)`, `g = 8 n β / (3 + 8 n β)`; on a
//! closed connected mesh all displacements vanish for constants only, and they satisfy one relation,
//! `Σ ν_v d_v = 0` with `ν_v = valence / g_v`, because edges are shared. So a functional t that vanishes on
//! constants is `Σ x_v d_v` for the x of a line x + c ν, and
//!
//! ```text
//! sup |t(P)| / max_v |d_v(P)| = min_c Σ |x_v + c ν_v|,
//! ```
//!
//! a weighted median. The net that attains it has `d_v = sign(x_v + c ν_v)`, and at the median vertex what
//! the relation leaves. In rationals this is the supremum; in floats it proposes nets.

use nalgebra::DMatrix;

use crate::linalg;
use crate::mesh::Topology;
use crate::refine::{RefineError, limit_positions, refine_positions, refine_topology};
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::{CornerRule, LoopWeights, Scheme, loop_scheme};

/// The scheme of Theorem 3.
pub const LOOP: Scheme = Scheme::Loop(LoopWeights::Original);

const CORNER: CornerRule = CornerRule::Smooth;

/// Numbers in which square systems are solved.
pub trait Solve: Field + PartialOrd {
    /// The x with `a x = b`.
    fn solve(a: &DMatrix<Self>, b: &DMatrix<Self>) -> Option<DMatrix<Self>>;
}

impl Solve for Rational {
    fn solve(a: &DMatrix<Self>, b: &DMatrix<Self>) -> Option<DMatrix<Self>> {
        linalg::solve(a, b)
    }
}

impl Solve for f64 {
    fn solve(a: &DMatrix<Self>, b: &DMatrix<Self>) -> Option<DMatrix<Self>> {
        a.clone().lu().solve(b)
    }
}

/// The displacements of the vertices, `P - P'` with P' the limit of P.
pub fn displacements<S: Field>(topology: &Topology, net: &[S]) -> Result<Vec<S>, RefineError> {
    let limits = limit_positions::<S, S>(LOOP, CORNER, topology, net)?;
    let pairs = net.iter().zip(&limits);
    Ok(pairs.map(|(p, limit)| p.clone() - limit).collect())
}

/// A closed triangle mesh and its refinement.
#[derive(Clone, Debug)]
pub struct Pair {
    /// Level 0.
    pub coarse: Topology,
    /// Level 1.
    pub fine: Topology,
}

/// What Theorem 3 compares on a net of numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Compared<S> {
    /// The displacements of level 0.
    pub coarse: Vec<S>,
    /// The displacements of level 1.
    pub fine: Vec<S>,
    /// S less the mesh at the middle of each edge.
    pub middles: Vec<S>,
}

impl Pair {
    /// The mesh and its refinement.
    pub fn new(coarse: Topology) -> Result<Self, RefineError> {
        let fine = refine_topology(LOOP, &coarse)?;
        Ok(Pair { coarse, fine })
    }

    /// The ends of an edge.
    pub fn ends(&self, edge: u32) -> [usize; 2] {
        let [h, _] = self.coarse.edge_halfedges(edge);
        [self.coarse.origin(h), self.coarse.target(h)].map(|v| v as usize)
    }

    /// All that is compared, on a net.
    pub fn compare<S: Field>(&self, net: &[S]) -> Result<Compared<S>, RefineError> {
        let refined = refine_positions::<S, S>(LOOP, CORNER, &self.coarse, net)?;
        let fine = displacements(&self.fine, &refined)?;
        let first = self.coarse.vertex_count() as usize;
        let middle = |edge: u32| {
            let [a, b] = self.ends(edge);
            let chord = (net[a].clone() + &net[b]) * &S::ratio(1, 2);
            let at = first + edge as usize;
            refined[at].clone() - &fine[at] - &chord
        };
        Ok(Compared {
            coarse: displacements(&self.coarse, net)?,
            middles: (0..self.coarse.edge_count()).map(middle).collect(),
            fine,
        })
    }
}

/// All functionals of a mesh that are compared, as the values at the unit nets.
#[derive(Clone, Debug)]
pub struct Functionals<S> {
    units: Vec<Compared<S>>,
    /// g_v and ν_v.
    weights: Vec<[S; 2]>,
}

/// A supremum and a net that attains it, with displacements at most 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Extremal<S> {
    /// The supremum.
    pub value: S,
    /// The net.
    pub net: Vec<S>,
}

impl<S: Solve> Functionals<S> {
    /// Those of a closed triangle mesh.
    pub fn new(pair: &Pair) -> Result<Self, RefineError> {
        let count = pair.coarse.vertex_count() as usize;
        let unit = |v: usize| {
            let mut net = vec![S::zero(); count];
            net[v] = S::one();
            pair.compare(&net)
        };
        let units: Vec<Compared<S>> = (0..count).map(unit).collect::<Result<_, _>>()?;
        let weight = |v: u32| {
            let n = pair.coarse.valence(v);
            let refused = RefineError::Unrepresentable {
                what: "valence",
                size: n,
            };
            let mask = loop_scheme::limit_mask::<S>(LoopWeights::Original, n).ok_or(refused)?;
            let g = S::one() - &mask.center;
            Ok([g.clone(), <S as Ring>::from_integer(i64::from(n)) / &g])
        };
        let weights = (0..count as u32).map(weight).collect::<Result<_, _>>()?;
        Ok(Functionals { units, weights })
    }

    /// The displacement of a vertex of level 1.
    pub fn fine(&self, vertex: usize) -> Vec<S> {
        self.units.iter().map(|u| u.fine[vertex].clone()).collect()
    }

    /// S less the mesh at the middle of an edge.
    pub fn middle(&self, edge: usize) -> Vec<S> {
        self.units.iter().map(|u| u.middles[edge].clone()).collect()
    }

    /// Numbers of vertices at level 1, and of edges.
    pub fn counts(&self) -> [usize; 2] {
        [self.units[0].fine.len(), self.units[0].middles.len()]
    }

    /// The supremum of a functional that vanishes on constants; `None` if a system is singular.
    pub fn supremum(&self, t: &[S]) -> Option<Extremal<S>> {
        let n = t.len();
        let last = n - 1;
        // d_v = Σ_j units[j].coarse[v] P_j. The last equation of each system follows from the others;
        // x_last = 0 and y_last = 0 take its place.
        let pinned = |j: usize| if j == last { S::one() } else { S::zero() };
        let transposed = DMatrix::from_fn(n, n, |i, v| match i == last {
            true => pinned(v),
            false => self.units[i].coarse[v].clone(),
        });
        let mut right = DMatrix::from_fn(n, 1, |i, _| t[i].clone());
        right[(last, 0)] = S::zero();
        let x = S::solve(&transposed, &right)?;
        // The weighted median of -x_v / ν_v.
        let breaks: Vec<S> = (0..n)
            .map(|v| -x[(v, 0)].clone() / &self.weights[v][1])
            .collect();
        let mut order: Vec<usize> = (0..n).collect();
        order.sort_by(|&a, &b| {
            breaks[a]
                .partial_cmp(&breaks[b])
                .unwrap_or(std::cmp::Ordering::Equal)
        });
        let total = self.weights.iter().fold(S::zero(), |sum, w| sum + &w[1]);
        let mut below = S::zero();
        let mut median = order[last];
        for &v in &order {
            let with = below.clone() + &self.weights[v][1];
            if with.clone() + &with >= total {
                median = v;
                break;
            }
            below = with;
        }
        // Those before the median have x_v + c ν_v > 0, those after it < 0, with c = its break.
        let mut signs = vec![-S::one(); n];
        for &v in order.iter().take_while(|&&v| v != median) {
            signs[v] = S::one();
        }
        signs[median] = S::zero();
        let rest = (0..n).fold(S::zero(), |sum, v| {
            sum + &(self.weights[v][1].clone() * &signs[v])
        });
        signs[median] = -rest / &self.weights[median][1];
        let matrix = DMatrix::from_fn(n, n, |v, j| match v == last {
            true => pinned(j),
            false => self.units[j].coarse[v].clone(),
        });
        let mut right = DMatrix::from_fn(n, 1, |v, _| signs[v].clone());
        right[(last, 0)] = S::zero();
        let y = S::solve(&matrix, &right)?;
        let net: Vec<S> = (0..n).map(|j| y[(j, 0)].clone()).collect();
        let value = t
            .iter()
            .zip(&net)
            .fold(S::zero(), |sum, (a, b)| sum + &(a.clone() * b));
        Some(Extremal { value, net })
    }
}
