//! Loop: M of all faces of a mesh in one pass over clusters of faces that fit a core's cache.
//!
//! A mesh-wide bound needs the largest M of each triple of kinds only. Faces are grown into clusters of a few
//! thousand, once for a connectivity; a cluster knows its vertices and those beside them (in the mesh's order:
//! they are read forward), the edges that meet its corners, and its faces, all by 16-bit numbers of its own.
//! Then each set of positions costs a pass over clusters: points into the cache, α of its edges, the largest at
//! each vertex, the largest of each face, the largest of each triple. Edges at the rims of clusters are
//! computed twice (one in ten). What is computed is what [`super::triangles`] computes, δ of an irregular boundary
//! vertex a with neighbours p and q being that of the "edge" (a, a) with p and q across, but for the order of
//! three sums.
//!
//! **Roundings.** Those of [`super::triangles`]; the relative bound of [`super::levels::Outward`]
//! holds for any order of the sums. Maxima depend neither on clusters nor on threads.

use std::cell::RefCell;
use std::collections::{BTreeMap, VecDeque};

use rayon::prelude::*;
use wide::f64x4;

use super::levels::{Kinds, Largest};
use super::star::Vertex;
use super::triangles::Rates;
use super::vector::larger;
use crate::mesh::{NONE, Point, Topology};

/// A row in the cache: three coordinates and a zero.
const ROW: usize = 4;

/// Numbers of rows fit 16 bits after multiplication by [`ROW`].
const VERTICES: usize = (1 << 16) / ROW;

/// Larger valences could leave no room for one face.
const LARGEST_VALENCE: u32 = VERTICES as u32 / 3 - 1;

/// Faces of a cluster, at most; of all triples of kinds there are no more.
const FACES: usize = 1 << 12;

/// Edges of a vertex follow each other in a list; each waits for the one before at that vertex. So as many
/// parts of the list as this are run through side by side.
const PARTS: usize = 16;

/// The connectivity of a triangle mesh by clusters.
#[derive(Clone, Debug)]
pub(super) struct Clusters {
    /// Vertices in the mesh, ascending in each cluster.
    vertices: Vec<u32>,
    /// Ends P and Q, and R and S across, times [`ROW`]: α = (P - R) + (Q - S).
    edges: Vec<[u16; 4]>,
    /// Corners, and the number of the triple of their kinds.
    faces: Vec<[u16; 4]>,
    /// Triples of kinds, ascending.
    triples: Vec<[u16; 3]>,
    /// Where each cluster ends in the lists above; zeros first.
    ends: Vec<[usize; 4]>,
}

impl Clusters {
    /// Clusters of a mesh of triangles, in linear time; `None` if a valence is above some five thousand.
    ///
    /// `of_vertex` is the kind of each vertex.
    ///
    /// # Panics
    /// If a face is not a triangle.
    pub(super) fn of(topology: &Topology, kinds: &Kinds, of_vertex: &[u16]) -> Option<Self> {
        assert_eq!(topology.arity(), Some(3), "triangles");
        let mut valences = (0..topology.vertex_count()).map(|v| topology.valence(v));
        if valences.any(|n| n > LARGEST_VALENCE) {
            return None;
        }
        let (faces, vertices) = (topology.face_count() as usize, topology.vertex_count());
        let mut all = Clusters {
            vertices: Vec::with_capacity(faces / 2),
            edges: Vec::with_capacity(2 * faces),
            faces: Vec::with_capacity(faces),
            triples: Vec::new(),
            ends: vec![[0; 4]],
        };
        let mut growth = Growth::new(topology);
        let mut own = Own {
            met: vec![[NONE, 0]; vertices as usize],
            edges: vec![NONE; topology.edge_count() as usize],
        };
        let mut list = Vec::new();
        while growth.next(&mut list) {
            all.add(topology, kinds, of_vertex, &list, &mut own);
        }
        Some(all)
    }

    /// Adds a cluster of faces.
    fn add(
        &mut self,
        topology: &Topology,
        kinds: &Kinds,
        of_vertex: &[u16],
        faces: &[u32],
        own: &mut Own,
    ) {
        let id = self.ends.len() as u32;
        let [vertices, edges, first_face, triples] = self.ends[self.ends.len() - 1];
        let mut triple_numbers = BTreeMap::new();
        for &f in faces {
            let mut triple = [0; 3];
            let mut corners = [0; 4];
            for (i, &v) in topology.corners(f).iter().enumerate() {
                corners[i] = own.number(id, v, vertices, &mut self.vertices);
                triple[i] = of_vertex[v as usize];
            }
            triple.sort_unstable();
            corners[3] = *triple_numbers.entry(triple).or_insert_with(|| {
                self.triples.push(triple);
                (self.triples.len() - 1 - triples) as u16
            });
            self.faces.push(corners);
        }
        for i in vertices..self.vertices.len() {
            let v = self.vertices[i];
            let mut put = |own: &mut Own, four: [u32; 4]| {
                let four = four.map(|v| own.number(id, v, vertices, &mut self.vertices));
                self.edges.push(four);
            };
            let irregular = &kinds.list[usize::from(of_vertex[v as usize])];
            if matches!(irregular, Vertex::Boundary(_)) {
                put(own, boundary_row(topology, v));
            }
            for h in topology.fan(v) {
                let edge = topology.edge_of(h);
                if std::mem::replace(&mut own.edges[edge as usize], id) == id {
                    continue;
                }
                let [h, twin] = topology.edge_halfedges(edge);
                if twin != NONE {
                    let across = |h: u32| topology.origin(topology.prev(h));
                    let ends = [topology.origin(h), topology.origin(twin)];
                    put(own, [ends[0], ends[1], across(h), across(twin)]);
                }
            }
        }
        self.in_order(vertices, edges, first_face);
        let ends = [self.vertices.len(), self.edges.len(), self.faces.len()];
        self.ends
            .push([ends[0], ends[1], ends[2], self.triples.len()]);
    }

    /// The vertices of the last cluster ascend, and edges of a vertex part ([`PARTS`]).
    fn in_order(&mut self, vertices: usize, edges: usize, faces: usize) {
        let list = &mut self.vertices[vertices..];
        let mut pairs: Vec<(u32, u16)> = list.iter().copied().zip(0..).collect();
        pairs.sort_unstable();
        let mut rank = vec![0; pairs.len()];
        for (i, &(v, old)) in pairs.iter().enumerate() {
            rank[usize::from(old)] = i as u16;
            list[i] = v;
        }
        for face in &mut self.faces[faces..] {
            for corner in &mut face[..3] {
                *corner = rank[usize::from(*corner)];
            }
        }
        let old = self.edges.split_off(edges);
        let length = old.len().div_ceil(PARTS).max(1);
        for i in 0..length {
            let side_by_side = old.iter().skip(i).step_by(length);
            let rows = side_by_side.map(|edge| edge.map(|v| rank[usize::from(v)] * ROW as u16));
            self.edges.extend(rows);
        }
    }

    /// The largest M^2 for each triple of kinds, as levels and kinds hear of it, and where the vertices are.
    ///
    /// There is a position for each vertex. Squares are right if all coordinates are finite and below 2^300.
    pub(super) fn largest(
        &self,
        positions: &[Point<f64>],
        kinds: &Kinds,
        rates: &Rates,
    ) -> (Largest, Place) {
        let new = || (Largest::new(2, kinds.list.len()), Place::default());
        let clusters = self.ends.par_windows(2);
        let seen = clusters.fold(new, |(mut seen, mut place), ends| {
            let [from, to] = [ends[0], ends[1]];
            ROOM.with_borrow_mut(|room| {
                room.enter(&self.vertices[from[0]..to[0]], positions, &mut place);
                room.edges(&self.edges[from[1]..to[1]]);
                room.faces(&self.faces[from[2]..to[2]]);
                let triples = &self.triples[from[3]..to[3]];
                for (&triple, square) in triples.iter().zip(&mut room.triple[..]) {
                    rates.visit(triple, std::mem::take(square), &mut seen);
                }
            });
            (seen, place)
        });
        seen.reduce(new, |a, b| (a.0.join(&b.0), a.1.join(&b.1)))
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&self.vertices[..])
            + size_of_val(&self.edges[..])
            + size_of_val(&self.faces[..])
            + size_of_val(&self.triples[..])
            + size_of_val(&self.ends[..])
    }
}

/// δ = (a - p) + (a - q) as α of an edge.
fn boundary_row(topology: &Topology, v: u32) -> [u32; 4] {
    let first = topology.first_halfedge(v);
    let last = topology.fan(v).last().unwrap_or(first);
    let before = topology.origin(topology.prev(last));
    [v, v, topology.target(first), before]
}

/// What the cluster at hand knows: the last cluster that met each vertex, with its number there, and each edge.
struct Own {
    met: Vec<[u32; 2]>,
    edges: Vec<u32>,
}

impl Own {
    /// The number of a vertex in a cluster whose list starts at `first`.
    fn number(&mut self, id: u32, v: u32, first: usize, list: &mut Vec<u32>) -> u16 {
        let slot = &mut self.met[v as usize];
        if slot[0] != id {
            *slot = [id, (list.len() - first) as u32];
            list.push(v);
        }
        slot[1] as u16
    }
}

/// Clusters by breadth: from a face to those beside it.
struct Growth<'a> {
    topology: &'a Topology,
    taken: Vec<bool>,
    /// The last cluster that has each vertex for a corner.
    corner_of: Vec<u32>,
    id: u32,
    /// Beside faces of this cluster, and of earlier ones.
    near: VecDeque<u32>,
    rest: VecDeque<u32>,
    next: u32,
}

impl<'a> Growth<'a> {
    fn new(topology: &'a Topology) -> Self {
        Growth {
            topology,
            taken: vec![false; topology.face_count() as usize],
            corner_of: vec![NONE; topology.vertex_count() as usize],
            id: 0,
            near: VecDeque::new(),
            rest: VecDeque::new(),
            next: 0,
        }
    }

    /// The faces of the next cluster; whether there is one.
    fn next(&mut self, list: &mut Vec<u32>) -> bool {
        list.clear();
        let t = self.topology;
        // Each corner and all its neighbours: all that the cluster's edges touch.
        let mut room = VERTICES as u32;
        while list.len() < FACES
            && let Some(face) = self.candidate()
        {
            let new = |&v: &u32| self.corner_of[v as usize] != self.id;
            let corners = t.corners(face).iter().copied().filter(new);
            let needed: u32 = corners.map(|v| t.valence(v) + 1).sum();
            if needed > room {
                self.near.push_front(face);
                break;
            }
            room -= needed;
            self.taken[face as usize] = true;
            list.push(face);
            for h in t.halfedges(face) {
                self.corner_of[t.origin(h) as usize] = self.id;
                let twin = t.twin(h);
                if twin != NONE && !self.taken[t.face_of(twin) as usize] {
                    self.near.push_back(t.face_of(twin));
                }
            }
        }
        self.rest.append(&mut self.near);
        self.id += 1;
        !list.is_empty()
    }

    /// A face not yet taken: beside this cluster, or beside earlier ones, or any.
    fn candidate(&mut self) -> Option<u32> {
        let taken = &self.taken;
        let free = |queue: &mut VecDeque<u32>| {
            std::iter::from_fn(|| queue.pop_front()).find(|&f| !taken[f as usize])
        };
        free(&mut self.near)
            .or_else(|| free(&mut self.rest))
            .or_else(|| {
                let faces = self.next..taken.len() as u32;
                let found = faces.into_iter().find(|&f| !taken[f as usize])?;
                self.next = found;
                Some(found)
            })
    }
}

/// Where points are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    low: f64x4,
    high: f64x4,
    /// 0, or NaN if a coordinate is not finite.
    zero: f64x4,
}

impl Default for Place {
    fn default() -> Self {
        Place {
            low: f64x4::splat(f64::INFINITY),
            high: f64x4::splat(f64::NEG_INFINITY),
            zero: f64x4::splat(0.0),
        }
    }
}

impl Place {
    #[inline]
    fn meet(&mut self, point: f64x4) {
        self.low = self.low.fast_min(point);
        self.high = self.high.fast_max(point);
        self.zero += point * f64x4::splat(0.0);
    }

    fn join(self, other: &Self) -> Self {
        Place {
            low: self.low.fast_min(other.low),
            high: self.high.fast_max(other.high),
            zero: self.zero + other.zero,
        }
    }

    /// The least and largest coordinates; `None` if one is not finite.
    pub(super) fn corners(&self) -> Option<([f64; 3], [f64; 3])> {
        let first = |lanes: f64x4| {
            let [x, y, z, _] = lanes.to_array();
            [x, y, z]
        };
        let finite = first(self.zero).iter().all(|zero| !zero.is_nan());
        finite.then(|| (first(self.low), first(self.high)))
    }
}

thread_local! {
    /// Kept: fresh memory costs more than what is done with it.
    static ROOM: RefCell<Room> = RefCell::new(Room::new());
}

/// One cluster's numbers in the cache. Arrays as long as 16-bit numbers reach need no tests of these.
struct Room {
    rows: Box<[f64; VERTICES * ROW + ROW]>,
    /// The largest square at each vertex.
    top: Box<[f64; VERTICES]>,
    /// The largest square of each triple.
    triple: Box<[f64; FACES]>,
}

impl Room {
    fn new() -> Self {
        Room {
            rows: zeros(),
            top: zeros(),
            triple: zeros(),
        }
    }

    fn enter(&mut self, vertices: &[u32], positions: &[Point<f64>], place: &mut Place) {
        let (rows, _) = self.rows.as_chunks_mut::<ROW>();
        let mut all = *place;
        for ((row, top), &v) in rows.iter_mut().zip(&mut self.top[..]).zip(vertices) {
            let [x, y, z] = positions[v as usize].0;
            let point = f64x4::new([x, y, z, 0.0]);
            // One store: reading four lanes just after other ones waits for these.
            *row = point.to_array();
            all.meet(point);
            *top = 0.0;
        }
        *place = all;
    }

    fn edges(&mut self, edges: &[[u16; 4]]) {
        let row = |i: u16| {
            let row: [f64; ROW] = *self.rows[usize::from(i)..]
                .first_chunk()
                .expect("a row more than numbers reach");
            f64x4::from(row)
        };
        for &[p, q, r, s] in edges {
            let alpha = (row(p) - row(r)) + (row(q) - row(s));
            let [x, y, z, _] = (alpha * alpha).to_array();
            let square = (x + y) + z;
            for end in [p, q] {
                let top = &mut self.top[usize::from(end) / ROW];
                *top = larger(*top, square);
            }
        }
    }

    fn faces(&mut self, faces: &[[u16; 4]]) {
        for &[a, b, c, triple] in faces {
            let [a, b, c] = [a, b, c].map(|v| self.top[usize::from(v) % VERTICES]);
            let largest = larger(a, larger(b, c));
            let slot = &mut self.triple[usize::from(triple) % FACES];
            if largest > *slot {
                *slot = largest;
            }
        }
    }
}

fn zeros<const N: usize>() -> Box<[f64; N]> {
    let boxed = vec![0.0; N].into_boxed_slice();
    boxed.try_into().expect("as many")
}
