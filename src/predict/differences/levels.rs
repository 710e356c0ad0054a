//! From ready faces of some levels to bounds at every level.

use std::collections::BTreeMap;

use super::constants::{self, DEEPEST};
use super::star::Vertex;
use crate::bound::Against;
use crate::mesh::Topology;
use crate::scalar::float::gamma;
use crate::scheme::{CornerRule, Scheme};

/// The kinds of vertices of a mesh, numbered; kind 0 is [`Vertex::Regular`].
#[derive(Clone, Debug)]
pub struct Kinds {
    /// The vertex of each kind.
    pub list: Vec<Vertex>,
    /// D_k of each kind, at least that of kind 0.
    pub distances: Vec<Vec<f64>>,
}

impl Kinds {
    fn new(scheme: Scheme, against: Against, list: Vec<Vertex>) -> Self {
        let all = |&vertex: &Vertex| constants::distances(scheme, against, vertex);
        let mut distances: Vec<Vec<f64>> = list.iter().map(all).collect();
        let regular = distances[0].clone();
        for one in &mut distances {
            for (d, r) in one.iter_mut().zip(&regular) {
                *d = d.max(*r);
            }
        }
        Kinds { list, distances }
    }

    /// The kinds of a mesh's vertices: the list, and the number of each vertex's.
    pub fn of_vertices(
        scheme: Scheme,
        corner: CornerRule,
        against: Against,
        topology: &Topology,
    ) -> (Self, Vec<u16>) {
        let mut numbers = Numbers::default();
        let kind = |v| numbers.of(vertex(scheme, corner, topology, v));
        let kinds = (0..topology.vertex_count()).map(kind).collect();
        (Kinds::new(scheme, against, numbers.list), kinds)
    }

    /// The kinds of a mesh's faces by their sides (Doo-Sabin).
    pub fn of_faces(scheme: Scheme, against: Against, topology: &Topology) -> (Self, Vec<u16>) {
        let mut numbers = Numbers::default();
        let kind = |f| match topology.face_size(f) {
            4 => numbers.of(Vertex::Regular),
            n => numbers.of(Vertex::Interior(n)),
        };
        let kinds = (0..topology.face_count()).map(kind).collect();
        (Kinds::new(scheme, against, numbers.list), kinds)
    }
}

/// How the scheme sees a vertex.
fn vertex(scheme: Scheme, corner: CornerRule, topology: &Topology, v: u32) -> Vertex {
    let (interior, faces) = match scheme {
        Scheme::Loop(_) => (6, 3),
        _ => (4, 2),
    };
    let n = topology.valence(v);
    if !topology.is_boundary_vertex(v) {
        // Isolated vertices have no part in anything.
        return match n == interior || n == 0 {
            true => Vertex::Regular,
            false => Vertex::Interior(n),
        };
    }
    let m = n - 1;
    match m == faces || m == 1 && corner == CornerRule::Sharp {
        true => Vertex::Regular,
        false => Vertex::Boundary(m),
    }
}

/// Numbers given in the order of first sight.
struct Numbers {
    list: Vec<Vertex>,
    /// By valence, interior and boundary: most meshes know small ones only.
    small: [[u16; 64]; 2],
    large: BTreeMap<Vertex, u16>,
}

impl Default for Numbers {
    fn default() -> Self {
        Numbers {
            list: vec![Vertex::Regular],
            small: [[0; 64]; 2],
            large: BTreeMap::new(),
        }
    }
}

impl Numbers {
    fn of(&mut self, vertex: Vertex) -> u16 {
        let (side, n) = match vertex {
            Vertex::Regular => return 0,
            Vertex::Interior(n) => (0, n as usize),
            Vertex::Boundary(m) => (1, m as usize),
        };
        let slot = match self.small[side].get_mut(n) {
            Some(slot) => slot,
            None => self.large.entry(vertex).or_default(),
        };
        if *slot == 0 {
            *slot = u16::try_from(self.list.len()).expect("different valences are few");
            self.list.push(vertex);
        }
        *slot
    }
}

/// Hears of the ready faces below a face.
pub trait Visit {
    /// A ready face of a level, the kind of its vertex, and the square of its M.
    fn ready(&mut self, level: usize, kind: u16, square: f64);
    /// F_(level+1) - F_level over a face that is not ready: the square of a bound.
    fn moved(&mut self, level: usize, square: f64);
}

/// The largest squares, by level and kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Largest {
    /// M^2, `levels` times the number of kinds.
    squares: Vec<f64>,
    moved: Vec<f64>,
    kinds: usize,
}

impl Largest {
    /// Nothing seen yet.
    pub fn new(levels: usize, kinds: usize) -> Self {
        Largest {
            squares: vec![-1.0; levels * kinds],
            moved: vec![0.0; levels],
            kinds,
        }
    }

    /// Of two parts of a mesh.
    pub fn join(mut self, other: &Self) -> Self {
        for (a, b) in self.squares.iter_mut().zip(&other.squares) {
            *a = a.max(*b);
        }
        for (a, b) in self.moved.iter_mut().zip(&other.moved) {
            *a = a.max(*b);
        }
        self
    }
}

impl Visit for Largest {
    #[inline]
    fn ready(&mut self, level: usize, kind: u16, square: f64) {
        let at = level * self.kinds + usize::from(kind);
        // A store now and then is cheaper than one for each face.
        if square > self.squares[at] {
            self.squares[at] = square;
        }
    }

    #[inline]
    fn moved(&mut self, level: usize, square: f64) {
        if square > self.moved[level] {
            self.moved[level] = square;
        }
    }
}

/// What was seen of one face, item by item.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Seen {
    ready: Vec<(usize, u16, f64)>,
    moved: Vec<f64>,
}

impl Seen {
    /// Forgets everything, for the next face.
    pub fn clear(&mut self) {
        self.ready.clear();
        self.moved.clear();
    }
}

impl Visit for Seen {
    fn ready(&mut self, level: usize, kind: u16, square: f64) {
        self.ready.push((level, kind, square));
    }

    fn moved(&mut self, level: usize, square: f64) {
        self.moved.resize(self.moved.len().max(level + 1), 0.0);
        self.moved[level] = self.moved[level].max(square);
    }
}

/// The lengths behind the bounds of a mesh or a face, not below the true ones.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Lengths {
    /// Ready faces: level, kind, M.
    ready: Vec<(usize, u16, f64)>,
    /// By level: how far the mesh of that level moves in a step over faces that wait.
    moved: Vec<f64>,
}

impl Lengths {
    /// Of a whole mesh.
    pub fn of_mesh(seen: &Largest, outward: &Outward) -> Self {
        let mut lengths = Lengths::default();
        for (at, &square) in seen.squares.iter().enumerate() {
            let (level, kind) = (at / seen.kinds, at % seen.kinds);
            if square >= 0.0 {
                let length = outward.length(level, square);
                lengths.ready.push((level, kind as u16, length));
            }
        }
        let moved = seen.moved.iter().enumerate();
        lengths.moved = moved
            .map(|(q, &square)| outward.length(q, square))
            .collect();
        lengths
    }

    /// Of one face, into the memory of `self`.
    pub fn set(&mut self, seen: &Seen, outward: &Outward) {
        self.ready.clear();
        self.moved.clear();
        let lengths = |&(level, kind, square): &(usize, u16, f64)| {
            (level, kind, outward.length(level, square))
        };
        self.ready.extend(seen.ready.iter().map(lengths));
        let moved = seen.moved.iter().enumerate();
        self.moved
            .extend(moved.map(|(q, &square)| outward.length(q, square)));
    }

    /// The bound at level k.
    ///
    /// A ready face of level l <= k has D_(k-l) M. One of level l > k has D_0 M, and what the mesh moves from
    /// level k to l over the faces above it. Without any face there is no surface, and the bound is 0.
    pub fn bound(&self, kinds: &Kinds, k: usize) -> f64 {
        let of = |&(level, kind, length): &(usize, u16, f64)| {
            let way: f64 = self.moved.iter().take(level).skip(k).sum();
            let steps = k.saturating_sub(level).min(DEEPEST);
            // 0 times an infinite constant: nothing is proved.
            let there = kinds.distances[usize::from(kind)][steps] * length + way;
            if there.is_nan() {
                f64::INFINITY
            } else {
                there * (1.0 + gamma(8))
            }
        };
        self.ready.iter().map(of).fold(0.0, f64::max)
    }
}

/// What a computed length may be short of the true one: `length (1 + γ(32)) + off`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outward {
    /// An absolute bound, by level.
    pub off: [f64; 5],
}

impl Outward {
    /// A length not below the true one, from its computed square.
    #[inline]
    pub fn length(&self, level: usize, square: f64) -> f64 {
        square.sqrt() * (1.0 + gamma(32)) + self.off[level]
    }
}
