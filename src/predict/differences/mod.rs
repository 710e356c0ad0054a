//! Upper bounds of the parametric distance between surface and level-k mesh, from second differences of the
//! control points and certified constants, without refining: for every scheme, mesh and level.
//!
//! **Ready faces.** Let all corners of a face be regular but for one (as the scheme sees it: a boundary vertex of
//! three triangles, or two quads, is regular). Then, M the largest second difference round the face,
//!
//! ```text
//! |S - F_k| <= C_k M,      |S - L_k| <= B_k M
//! ```
//!
//! over the face, with the constants of the one irregular corner ([`constants`]; proved by [`crate::bound`], or
//! from [`star`]). M is the norm of HW (1) for Loop, CY's second-order norm for Catmull-Clark, and that of
//! [`crate::scheme::doo_sabin::face_differences`] for Doo-Sabin, where faces have the vertices' part.
//!
//! **Other faces** become ready in one step (Loop, quads) or two (polygons; Doo-Sabin). The step is taken, all
//! at once with a bound on its errors, or, for Loop, spared: M(child) <= R M ([`crate::bound::face_rate`]).
//!
//! **Local subdivisions.** After j steps M is that of the children: the bound at level k >= j uses D_(k-j), and
//! is sharper. Loop's last step is a formula for the new differences ([`triangles`]). Of the bounds by 0, ..,
//! min(j, k) local steps the least counts.
//!
//! **In floats.** Lengths carry an absolute bound for all roundings and a relative one for their own; constants
//! are rounded upward. So each bound is a theorem about the coordinates as stored.
//!
//! | file | idea |
//! |---|---|
//! | [`constants`] | D_k of a vertex: table and recurrence |
//! | [`star`] | bounds for vertices that no table knows: large valences, boundaries |
//! | [`triangles`], [`quads`], [`quarters`] | M of the ready faces of a mesh, per scheme |
//! | [`levels`] | from ready faces to a bound at each level |

use std::borrow::Cow;

use rayon::prelude::*;

use crate::bound::Against;
use crate::mesh::frame::Frame;
use crate::mesh::{Mesh, Point, Topology};
use crate::refine::enclosure::largest_coordinate;
use crate::refine::{RefineError, Refiner, refine_topology};
use crate::scalar::float::gamma;
use crate::scheme::{CornerRule, Scheme};

pub mod constants;
pub mod levels;
pub mod quads;
pub mod quarters;
pub mod star;
pub mod triangles;
mod vector;

use levels::{Kinds, Largest, Lengths, Outward, Seen, Visit};
use quads::{QuadLevels, Quads};
use quarters::{QuarterLevels, Quarters};
use triangles::Triangles;

/// What is bounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Request {
    /// The scheme that defines the surface.
    pub scheme: Scheme,
    /// What one-face boundary vertices do.
    pub corner: CornerRule,
    /// Control or limit meshes. (Doo-Sabin's limit meshes have no constants: their bounds are infinite.)
    pub against: Against,
    /// Local subdivisions j before the constants are used, at most [`Bounds::MOST_STEPS`].
    pub local_steps: u32,
}

/// Upper bounds of the parametric distances between surface and level-k meshes, for all k.
#[derive(Clone, Debug)]
pub struct Bounds<'a> {
    /// By 0, 1, .., j local steps.
    stages: Vec<Stage<'a>>,
    /// Lengths in the mesh's unit are 2^exponent times those here.
    exponent: i32,
    faces: u32,
}

/// Bounds after a number of local steps.
#[derive(Clone, Debug)]
struct Stage<'a> {
    kinds: Kinds,
    outward: Outward,
    lengths: Lengths,
    faces: Faces<'a>,
    /// The children of a face of the mesh are consecutive faces here; `None`: first and number, by face.
    children: Children,
}

/// Where the visited faces below a face of the mesh are.
#[derive(Clone, Debug)]
enum Children {
    /// Face f has the faces `f << shift ..`.
    Shift(u32),
    /// Face f has the faces `start[f]..start[f + 1]`.
    Start(Vec<u32>),
    /// Face f has the faces listed.
    List(Vec<Vec<u32>>),
}

#[derive(Clone, Debug)]
enum Faces<'a> {
    Triangles(Box<Triangles<'a>>),
    Quads(QuadLevels),
    Quarters(QuarterLevels),
}

impl Faces<'_> {
    #[inline]
    fn visit(&self, face: u32, to: &mut impl Visit) {
        match self {
            Faces::Triangles(triangles) => triangles.visit(face, to),
            Faces::Quads(quads) => quads.visit(face, to),
            Faces::Quarters(quarters) => quarters.visit(face, to),
        }
    }

    /// Faces of the first level, and how many levels follow.
    fn extent(&self) -> (u32, usize) {
        match self {
            Faces::Triangles(t) => (t.face_count(), t.level() + 2),
            Faces::Quads(q) => (q.levels[0].0.face_count(), q.first + q.levels.len()),
            Faces::Quarters(q) => {
                let first = q.levels[0].topology.face_count();
                (first, q.first + q.levels.len())
            }
        }
    }
}

/// Above what underflow of squares takes from a length in a frame of size 1, or above 2^-200.
const TINY: f64 = 1e-150;

/// Faces below which one thread is faster.
const BLOCK: u32 = 1 << 13;

impl<'a> Stage<'a> {
    fn new(faces: Faces<'a>, kinds: Kinds, outward: Outward, children: Children) -> Self {
        let (count, levels) = faces.extent();
        let new = || Largest::new(levels, kinds.list.len());
        let blocks = (0..count.div_ceil(BLOCK)).into_par_iter();
        let seen = blocks
            .fold(new, |mut seen, block| {
                let end = count.min((block + 1) * BLOCK);
                match &faces {
                    // One match for many faces.
                    Faces::Triangles(t) => (block * BLOCK..end).for_each(|f| t.visit(f, &mut seen)),
                    _ => (block * BLOCK..end).for_each(|f| faces.visit(f, &mut seen)),
                }
                seen
            })
            .reduce(new, |a, b| a.join(&b));
        Stage {
            lengths: Lengths::of_mesh(&seen, &outward),
            kinds,
            outward,
            faces,
            children,
        }
    }

    fn visit(&self, face: u32, seen: &mut Seen) {
        match &self.children {
            Children::Shift(shift) => {
                for child in face << shift..(face + 1) << shift {
                    self.faces.visit(child, seen);
                }
            }
            Children::Start(start) => {
                for child in start[face as usize]..start[face as usize + 1] {
                    self.faces.visit(child, seen);
                }
            }
            Children::List(list) => {
                for &child in &list[face as usize] {
                    self.faces.visit(child, seen);
                }
            }
        }
    }
}

/// A refined mesh, known up to a radius.
struct Level<'a> {
    topology: Cow<'a, Topology>,
    positions: Cow<'a, [Point<f64>]>,
    radius: f64,
}

impl<'a> Bounds<'a> {
    /// The deepest level that is looked at.
    pub const DEEPEST: u32 = constants::DEEPEST as u32;

    /// The largest number of local steps.
    pub const MOST_STEPS: u32 = 2;

    /// Prepares the bounds of a mesh.
    ///
    /// # Errors
    /// If and only if the scheme refuses the mesh, a coordinate is not finite, or there is not one position for
    /// each vertex; or if a local step would be too large for 32-bit indices.
    ///
    /// # Panics
    /// If there are more than [`Bounds::MOST_STEPS`] local steps.
    pub fn new(mesh: &'a Mesh, request: &Request) -> Result<Self, RefineError> {
        assert!(
            request.local_steps <= Self::MOST_STEPS,
            "at most two local steps"
        );
        let scheme = request.scheme;
        crate::refine::topology::check(scheme, &mesh.topology)?;
        let (expected, found) = (mesh.topology.vertex_count() as usize, mesh.positions.len());
        if expected != found {
            return Err(RefineError::PositionCount { expected, found });
        }
        largest_coordinate(&mesh.positions)?;
        let frame = Frame::of(mesh, true);
        // Lengths far from the limits of f64 need no other unit where nothing is refined.
        let plain = matches!(scheme, Scheme::Loop(_))
            && request.local_steps < 2
            && frame.exponent.abs() <= 200;
        let (exponent, first) = match plain {
            true => (0, (Cow::Borrowed(&mesh.positions[..]), 0.0)),
            false => {
                let (positions, radius) = frame.enter(&mesh.positions);
                (frame.exponent, (Cow::Owned(positions), radius))
            }
        };
        // In the plain frame coordinates are those of the mesh.
        let extent = 2.0
            * if plain {
                2f64.powi(frame.exponent) * frame.size
            } else {
                frame.size
            };
        let mut maker = Maker {
            request: *request,
            refiner: Refiner::new(scheme, request.corner),
            extent,
            levels: vec![Level {
                topology: Cow::Borrowed(&mesh.topology),
                positions: first.0,
                radius: first.1,
            }],
        };
        let steps = 0..=request.local_steps;
        let stages: Result<Vec<_>, _> = steps.map(|j| maker.stage(j as usize)).collect();
        Ok(Bounds {
            stages: stages?,
            exponent,
            faces: mesh.topology.face_count(),
        })
    }

    /// An upper bound of the distance at level k, in the mesh's own unit; infinite where nothing is proved.
    /// Levels beyond [`Bounds::DEEPEST`] have the bound of that.
    pub fn at(&self, k: u32) -> f64 {
        let stages = self.stages.iter().take(k as usize + 1);
        let bounds = stages.map(|stage| stage.lengths.bound(&stage.kinds, k as usize));
        self.outward(bounds.fold(f64::INFINITY, f64::min))
    }

    /// The least k with [`Bounds::at`] at most the tolerance; `None` if there is none up to
    /// [`Bounds::DEEPEST`].
    pub fn depth(&self, tolerance: f64) -> Option<u32> {
        (0..=Self::DEEPEST).find(|&k| self.at(k) <= tolerance)
    }

    /// For each face of the mesh the least level at which its own bound is at most the tolerance; `None` if
    /// there is none up to [`Bounds::DEEPEST`]. 0 for faces without a surface.
    pub fn face_depths(&self, tolerance: f64) -> Vec<Option<u32>> {
        self.by_face(|lengths, stages| {
            let mut k = 0;
            while k <= Self::DEEPEST && self.face_bound(lengths, stages, k) > tolerance {
                k += 1;
            }
            (k <= Self::DEEPEST).then_some(k)
        })
    }

    /// For each face of the mesh an upper bound over it at level k, in the mesh's own unit.
    pub fn face_bounds(&self, k: u32) -> Vec<f64> {
        self.by_face(|lengths, stages| self.face_bound(lengths, stages, k))
    }

    fn face_bound(&self, lengths: &[Lengths], stages: &[Stage<'a>], k: u32) -> f64 {
        let pairs = lengths.iter().zip(stages).take(k as usize + 1);
        let bounds = pairs.map(|(lengths, stage)| lengths.bound(&stage.kinds, k as usize));
        self.outward(bounds.fold(f64::INFINITY, f64::min))
    }

    fn by_face<T: Send>(&self, of: impl Fn(&[Lengths], &[Stage<'a>]) -> T + Sync) -> Vec<T> {
        let room = || (Seen::default(), vec![Lengths::default(); self.stages.len()]);
        let face = |(seen, lengths): &mut (Seen, Vec<Lengths>), face: u32| {
            for (stage, lengths) in self.stages.iter().zip(lengths.iter_mut()) {
                seen.clear();
                stage.visit(face, seen);
                lengths.set(seen, &stage.outward);
            }
            of(lengths, &self.stages)
        };
        let faces = (0..self.faces).into_par_iter().with_min_len(BLOCK as usize);
        faces.map_init(room, face).collect()
    }

    /// A length here in the mesh's own unit, rounded upward.
    fn outward(&self, x: f64) -> f64 {
        if self.exponent == 0 {
            return x;
        }
        let half = self.exponent / 2;
        let length = x * 2f64.powi(half) * 2f64.powi(self.exponent - half);
        // Exact but for underflow.
        if length < f64::MIN_POSITIVE && x > 0.0 {
            length.next_up()
        } else {
            length
        }
    }
}

/// Makes stages, refining where needed.
struct Maker<'a> {
    request: Request,
    refiner: Refiner<Point<f64>>,
    extent: f64,
    levels: Vec<Level<'a>>,
}

impl<'a> Maker<'a> {
    /// Refines up to a level.
    fn reach(&mut self, level: usize) -> Result<(), RefineError> {
        while self.levels.len() <= level {
            let last = self.levels.last().expect("there is level 0");
            let mut positions = Vec::new();
            let radius = self.refiner.enclose_into(
                &last.topology,
                &last.positions,
                last.radius,
                &mut positions,
            )?;
            let topology = refine_topology(self.request.scheme, &last.topology)?;
            self.levels.push(Level {
                topology: Cow::Owned(topology),
                positions: Cow::Owned(positions),
                radius,
            });
        }
        Ok(())
    }

    /// What lengths at each level are short of at most.
    ///
    /// A coordinate of a difference, after a step or not, is a combination of coordinates with weights below 8
    /// in sum and, with n the largest valence, γ(2n + 64) relative to twice the extent ([`triangles`]).
    fn outward(&self) -> Outward {
        const ROOT_3: f64 = 1.732_050_808;
        let of = |level: usize| {
            let level = &self.levels[level.min(self.levels.len() - 1)];
            let t = &level.topology;
            let valences = (0..t.vertex_count()).map(|v| t.valence(v));
            let sizes = (0..t.face_count()).map(|f| t.face_size(f));
            let sizes = if t.arity().is_some() {
                None
            } else {
                Some(sizes)
            };
            let n = valences
                .chain(sizes.into_iter().flatten())
                .max()
                .unwrap_or(0);
            let roundings = gamma(2 * n.min(1 << 28) + 64) * 4.0 * self.extent;
            ROOT_3 * (roundings + 8.0 * level.radius) + TINY
        };
        Outward {
            off: [0, 1, 2, 3, 4].map(of),
        }
    }

    fn stage(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
        match self.request.scheme {
            Scheme::Loop(weights) => {
                let request = self.request;
                let from = j.saturating_sub(1);
                self.reach(from)?;
                let outward = self.outward();
                let level = &self.levels[from];
                let (kinds, of_vertex) = Kinds::of_vertices(
                    request.scheme,
                    request.corner,
                    request.against,
                    &level.topology,
                );
                let triangles = match j {
                    0 => Triangles::now(
                        level.topology.clone(),
                        &level.positions,
                        request.scheme,
                        request.against,
                        &kinds,
                        of_vertex,
                    ),
                    _ => Triangles::after_a_step(
                        level.topology.clone(),
                        &level.positions,
                        weights,
                        &kinds,
                        of_vertex,
                        j,
                    ),
                };
                let children = Children::Shift(2 * from as u32);
                let faces = Faces::Triangles(Box::new(triangles));
                Ok(Stage::new(faces, kinds, outward, children))
            }
            Scheme::CatmullClark => self.quads(j),
            Scheme::DooSabin => self.quarters(j),
        }
    }

    fn quads(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
        let request = self.request;
        let mut all: Vec<(Topology, Quads)> = Vec::new();
        let (mut kinds, mut moved) = (None, Vec::new());
        self.reach(j)?;
        let mut faces: Vec<u32> = (0..self.levels[j].topology.face_count()).collect();
        loop {
            let at = j + all.len();
            self.reach(at)?;
            let level = &self.levels[at];
            let (own, of_vertex) = Kinds::of_vertices(
                request.scheme,
                request.corner,
                request.against,
                &level.topology,
            );
            // A step leaves old vertices in their order, adds regular ones and centres of polygons: later kinds
            // are seen by their own numbers.
            let (own, of_vertex) = match &kinds {
                None => (own, of_vertex),
                Some(known) => merged(known, &own, of_vertex),
            };
            let quads = Quads::new(&level.topology, &level.positions, &own, of_vertex);
            faces = quads.children_of_waiting(&level.topology, &faces);
            kinds = Some(own);
            all.push((level.topology.clone().into_owned(), quads));
            if faces.is_empty() {
                break;
            }
            self.reach(at + 1)?;
            let [coarse, fine] = [self.target(at)?, self.target(at + 1)?];
            moved.push(quads::moves(&self.levels[at].topology, &coarse, &fine));
        }
        let first = QuadLevels {
            first: j,
            levels: all,
            moved,
        };
        let kinds = kinds.expect("a level");
        let outward = self.outward();
        let children = self.children_by_corners(j);
        Ok(Stage::new(Faces::Quads(first), kinds, outward, children))
    }

    fn quarters(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
        let request = self.request;
        let mut all: Vec<Quarters> = Vec::new();
        let (mut kinds, mut moved): (Option<Kinds>, _) = (None, Vec::new());
        let mut waiting: Option<Vec<u32>> = None;
        loop {
            let at = j + all.len();
            self.reach(at)?;
            let level = &self.levels[at];
            let (own, of_face) = Kinds::of_faces(request.scheme, request.against, &level.topology);
            let (own, of_face) = match &kinds {
                None => (own, of_face),
                Some(known) => merged(known, &own, of_face),
            };
            let topology = level.topology.clone().into_owned();
            let quarters = Quarters::new(topology, &level.positions, of_face);
            // A half-edge's own vertex has the children of its quarter.
            let asked = match waiting {
                None => quarters.with_surface(),
                Some(parents) => parents
                    .iter()
                    .flat_map(|&h| quarters.topology.fan(h))
                    .collect(),
            };
            let still = quarters.waiting(&asked);
            let done = still.is_empty();
            waiting = Some(still);
            kinds = Some(own);
            if let Some(coarse) = all.last() {
                moved.push(quarters::moves(coarse, &quarters));
            }
            all.push(quarters);
            if done {
                break;
            }
        }
        let levels = QuarterLevels {
            first: j,
            levels: all,
            moved,
        };
        let children = self.children_by_vertices(j);
        let outward = self.outward();
        let kinds = kinds.expect("a level");
        Ok(Stage::new(
            Faces::Quarters(levels),
            kinds,
            outward,
            children,
        ))
    }

    /// The mesh of a level whose distance is bounded: control points or limits.
    fn target(&mut self, level: usize) -> Result<Vec<Point<f64>>, RefineError> {
        let level = &mut self.levels[level];
        match self.request.against {
            Against::Control => Ok(level.positions.to_vec()),
            Against::Limit => {
                let mut limits = Vec::new();
                let radius = self.refiner.enclose_limits_into(
                    &level.topology,
                    &level.positions,
                    level.radius,
                    &mut limits,
                )?;
                level.radius = level.radius.max(radius);
                Ok(limits)
            }
        }
    }

    /// Catmull-Clark: faces of the next level are numbered by half-edges.
    fn children_by_corners(&self, j: usize) -> Children {
        let faces = self.levels[0].topology.face_count();
        let mut start: Vec<u32> = (0..=faces).collect();
        for level in &self.levels[..j] {
            let t = &level.topology;
            let first = |f: u32| match f < t.face_count() {
                true => t.halfedges(f).start,
                false => t.halfedge_count(),
            };
            start = start.into_iter().map(first).collect();
        }
        Children::Start(start)
    }

    /// Doo-Sabin: the surface of a face is that of its corners' vertices, face by face at them.
    ///
    /// After a step the four quarters at the vertex of a corner lie in four faces; a face is given the
    /// faces round its corners' vertices, of which more than their quarters are seen: its bound is then that
    /// of a little more than the face.
    fn children_by_vertices(&self, j: usize) -> Children {
        let faces = self.levels[0].topology.face_count();
        let mut list: Vec<Vec<u32>> = (0..faces).map(|f| vec![f]).collect();
        for pair in self.levels[..=j].windows(2) {
            let (coarse, fine) = (&pair[0].topology, &pair[1].topology);
            for own in &mut list {
                let corners = own.iter().flat_map(|&f| coarse.halfedges(f));
                let mut next: Vec<u32> = corners
                    .flat_map(|h| fine.fan(h))
                    .map(|h| fine.face_of(h))
                    .collect();
                next.sort_unstable();
                next.dedup();
                *own = next;
            }
        }
        Children::List(list)
    }
}

/// The kinds of two levels under one numbering, that of the first kept.
fn merged(known: &Kinds, own: &Kinds, mut numbers: Vec<u16>) -> (Kinds, Vec<u16>) {
    let mut all = known.clone();
    let renumbered: Vec<u16> = own
        .list
        .iter()
        .zip(&own.distances)
        .map(|(vertex, distances)| {
            let found = all.list.iter().position(|other| other == vertex);
            found.unwrap_or_else(|| {
                all.list.push(*vertex);
                all.distances.push(distances.clone());
                all.list.len() - 1
            }) as u16
        })
        .collect();
    for number in &mut numbers {
        *number = renumbered[usize::from(*number)];
    }
    (all, numbers)
}
