//! A second, independent evaluation of the parametric distance: slow, dense, and meant to be
//! checked by eye.
//!
//! Independence: written from the definitions of the mathematics page (sections 1 and 4) alone,
//! without reading `src/`, and depending on nothing in the crate `subcert`. Keep it so: a mistake
//! shared by program and referee is a mistake nobody sees. Never call the crate from here, and do
//! not "fix" this file to agree with it without a derivation.
//!
//! Method: refine K times (the mesh F), then L times more, carrying along for every face its
//! place in the level-K face it came from; there S is exact by the limit masks. The largest
//! |S - F| over these samples is a LOWER bound of the parametric distance; it is the distance
//! itself only where a maximum sits at a dyadic parameter. A certified [lo, hi] is refuted by
//! hi < max over the samples; lo > that maximum is no contradiction.
//!
//! Parameters, all integers over 2^L:
//! - Loop: barycentric `at` = [a, b, c] for the corners of the face in order, `corner` = 0.
//! - Catmull-Clark, Doo-Sabin: the quarter of `corner` i of the face; `at` = [a, b, 0], with (0,0)
//!   the vertex v_i, (1,0) the middle of v_i v_(i+1), (0,1) that of v_(i-1) v_i, (1,1) the
//!   centroid. For a quad the quarters together are the usual bilinear quad. Doo-Sabin has
//!   samples only in quarters at interior vertices.
//!
//! Order of the refined elements ([`refine`]):
//! - Loop: vertices, then edges; face f becomes 4f+i (v_i, e(v_i v_(i+1)), e(v_i v_(i-1))),
//!   4f+3 (e01, e12, e20).
//! - Catmull-Clark: vertices, edges, faces; children of a face consecutive, child i
//!   (v_i, e_i, f', e_(i-1)).
//! - Doo-Sabin: new vertices (f, i) face by face; faces: the old ones (same corners in order),
//!   one quad per interior edge, one face per interior vertex.
//! - Edges are numbered as they are met, face by face, corner i giving v_i v_(i+1).
#![allow(dead_code, clippy::needless_range_loop, clippy::type_complexity)]

mod distance;
pub mod nets;
mod refine;

pub use distance::*;
pub use refine::*;

use num_rational::BigRational;
use std::collections::HashMap;
use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Sub};

/// A field with the cosines that masks ask for.
pub trait Number:
    Clone
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
{
    /// p / q.
    fn ratio(p: i64, q: i64) -> Self;
    /// cos(2 pi k / n); panics where it is not a number of this field.
    fn cosine(k: usize, n: usize) -> Self;
}

impl Number for f64 {
    fn ratio(p: i64, q: i64) -> f64 {
        p as f64 / q as f64
    }
    fn cosine(k: usize, n: usize) -> f64 {
        (std::f64::consts::TAU * k as f64 / n as f64).cos()
    }
}

impl Number for BigRational {
    fn ratio(p: i64, q: i64) -> BigRational {
        BigRational::new(p.into(), q.into())
    }
    fn cosine(k: usize, n: usize) -> BigRational {
        assert!(
            12 % n == 0 && n != 12 || k == 0,
            "cos(2 pi {k}/{n}) is not rational"
        );
        // The angle in twelfths of a turn.
        let doubled = match (12 * k / n.max(1)) % 12 {
            0 => 2,
            2 | 10 => 1,
            3 | 9 => 0,
            4 | 8 => -1,
            6 => -2,
            _ => unreachable!(),
        };
        Self::ratio(doubled, 2)
    }
}

/// A point, or a vector.
pub type Point<N> = [N; 3];

/// The subdivision rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Loop 1987: n b = 5/8 - (3/8 + cos(2 pi/n)/4)^2.
    LoopOriginal,
    /// Warren: b = 3/(8n) for n > 3, 3/16 for n = 3.
    LoopWarren,
    /// Catmull-Clark.
    CatmullClark,
    /// Doo-Sabin.
    DooSabin,
}

impl Scheme {
    /// All four.
    pub const ALL: [Scheme; 4] = [
        Scheme::LoopOriginal,
        Scheme::LoopWarren,
        Scheme::CatmullClark,
        Scheme::DooSabin,
    ];
    fn is_loop(self) -> bool {
        matches!(self, Scheme::LoopOriginal | Scheme::LoopWarren)
    }
}

/// What happens at a boundary vertex that has one face.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// As at any other boundary vertex.
    Smooth,
    /// It stays where it is.
    Sharp,
}

/// Which level-K mesh F is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Against {
    /// The refined control mesh.
    Control,
    /// The same faces with every vertex moved to its limit position.
    Limit,
}

/// Positions and polygons.
#[derive(Clone, Debug)]
pub struct Mesh<N> {
    /// Vertex positions.
    pub points: Vec<Point<N>>,
    /// Vertex indices of each face, in order round it.
    pub faces: Vec<Vec<usize>>,
}

/// Who meets whom. A corner is (face, place in the face).
pub struct Topology {
    /// Directed edge -> the corner it leaves from.
    pub half_edges: HashMap<(usize, usize), (usize, usize)>,
    /// Edges in the order met, as directed when met.
    pub edges: Vec<(usize, usize)>,
    edge_ids: HashMap<(usize, usize), usize>,
    /// The corners at each vertex, counterclockwise; from boundary to boundary if there is one.
    pub corners: Vec<Vec<(usize, usize)>>,
    /// The vertices joined to each vertex by an edge, in the same order.
    pub neighbours: Vec<Vec<usize>>,
    /// For a boundary vertex the two neighbours along the boundary.
    pub boundary: Vec<Option<[usize; 2]>>,
}

impl Topology {
    /// Index in `edges` of the edge between two vertices.
    pub fn edge(&self, a: usize, b: usize) -> usize {
        self.edge_ids[&(a.min(b), a.max(b))]
    }
    /// Has the vertex faces all round?
    pub fn is_interior(&self, v: usize) -> bool {
        !self.corners[v].is_empty() && self.boundary[v].is_none()
    }
    /// `Err` if and only if the faces are no oriented manifold (section 1).
    pub fn new(count: usize, faces: &[Vec<usize>]) -> Result<Topology, String> {
        let (mut half_edges, mut edge_ids, mut edges) = (HashMap::new(), HashMap::new(), vec![]);
        let mut incident = vec![vec![]; count];
        for (f, face) in faces.iter().enumerate() {
            if face.len() < 3 || (1..face.len()).any(|i| face[..i].contains(&face[i])) {
                return Err(format!("face {f} is too short or repeats a vertex"));
            }
            for (i, &v) in face.iter().enumerate() {
                let w = face[(i + 1) % face.len()];
                if half_edges.insert((v, w), (f, i)).is_some() {
                    return Err(format!("directed edge {v} {w} occurs twice"));
                }
                edge_ids.entry((v.min(w), v.max(w))).or_insert_with(|| {
                    edges.push((v, w));
                    edges.len() - 1
                });
                incident[v].push((f, i));
            }
        }
        let next = |(f, i): (usize, usize)| faces[f][(i + 1) % faces[f].len()];
        let last = |(f, i): (usize, usize)| faces[f][(i + faces[f].len() - 1) % faces[f].len()];
        let (mut corners, mut neighbours, mut boundary) = (vec![], vec![], vec![]);
        for (v, found) in incident.iter().enumerate() {
            let open = found
                .iter()
                .find(|&&c| !half_edges.contains_key(&(next(c), v)));
            let mut fan = vec![];
            // Counterclockwise over the edge v last(c): the face beyond has it directed from v.
            let mut at = open.or(found.first()).copied();
            while let Some(c) = at.filter(|c| fan.first() != Some(c)) {
                fan.push(c);
                at = half_edges.get(&(v, last(c))).copied();
            }
            if fan.len() != found.len() {
                return Err(format!("vertex {v} has more than one fan"));
            }
            let mut ring: Vec<usize> = fan.iter().map(|&c| next(c)).collect();
            if open.is_some() {
                ring.push(last(fan[fan.len() - 1]));
            }
            boundary.push(open.map(|_| [ring[0], ring[ring.len() - 1]]));
            corners.push(fan);
            neighbours.push(ring);
        }
        Ok(Topology {
            half_edges,
            edges,
            edge_ids,
            corners,
            neighbours,
            boundary,
        })
    }
}
