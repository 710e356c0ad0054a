//! Makes stages, refining where needed.

use std::borrow::Cow;

use super::Request;
use super::levels::{Kinds, Outward};
use super::quads::{self, QuadLevels, Quads};
use super::quarters::{self, QuarterLevels, Quarters};
use super::stage::{Children, Faces, Stage};
use super::triangles::Triangles;
use super::unit::Unit;
use crate::bound::Against;
use crate::mesh::{Point, Topology};
use crate::refine::{RefineError, Refiner, refine_topology};
use crate::scalar::float::gamma;
use crate::scheme::Scheme;

/// Above what underflow of squares takes from a length in a frame of size 1, or above 2^-200.
const TINY: f64 = 1e-150;

/// A refined mesh, known up to a radius.
struct Level<'a> {
    topology: Cow<'a, Topology>,
    positions: Cow<'a, [Point<f64>]>,
    radius: f64,
}

/// Makes stages, refining where needed.
pub(super) struct Maker<'a> {
    request: Request,
    refiner: Refiner<Point<f64>>,
    extent: f64,
    levels: Vec<Level<'a>>,
}

impl<'a> Maker<'a> {
    /// In the unit of a frame.
    pub(super) fn new(
        request: &Request,
        topology: &'a Topology,
        positions: &'a [Point<f64>],
        unit: &Unit,
    ) -> Self {
        let (positions, radius) = match &unit.frame {
            None => (Cow::Borrowed(positions), 0.0),
            Some(frame) => {
                let (positions, radius) = frame.enter(positions);
                (Cow::Owned(positions), radius)
            }
        };
        Maker {
            request: *request,
            refiner: Refiner::new(request.scheme, request.corner),
            extent: unit.extent,
            levels: vec![Level {
                topology: Cow::Borrowed(topology),
                positions,
                radius,
            }],
        }
    }

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

    fn outward(&self) -> Outward {
        let of = |level: usize| {
            let level = &self.levels[level.min(self.levels.len() - 1)];
            short_of(largest_valence(&level.topology), self.extent, level.radius)
        };
        Outward {
            off: [0, 1, 2, 3, 4].map(of),
        }
    }

    /// The faces after j steps.
    pub(super) fn stage(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
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
                Ok(stage(faces, kinds, outward, children))
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
        Ok(stage(Faces::Quads(first), kinds, outward, children))
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
        Ok(stage(Faces::Quarters(levels), kinds, outward, children))
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

/// What lengths are short of at most, n being the largest number of edges at a vertex, or of sides.
///
/// A coordinate of a difference, after a step or not, is a combination of coordinates with weights below 8
/// in sum and, with n the largest valence, γ(2n + 64) relative to twice the extent ([`super::triangles`]).
pub(super) fn short_of(n: u32, extent: f64, radius: f64) -> f64 {
    const ROOT_3: f64 = 1.732_050_808;
    let roundings = gamma(2 * n.min(1 << 28) + 64) * 4.0 * extent;
    ROOT_3 * (roundings + 8.0 * radius) + TINY
}

/// The largest number of edges at a vertex, or of sides of a face.
pub(super) fn largest_valence(topology: &Topology) -> u32 {
    let valences = (0..topology.vertex_count()).map(|v| topology.valence(v));
    let sizes = (0..topology.face_count()).map(|f| topology.face_size(f));
    match topology.arity() {
        Some(arity) => valences.fold(arity, u32::max),
        None => valences.chain(sizes).fold(0, u32::max),
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

fn stage(faces: Faces<'_>, kinds: Kinds, outward: Outward, children: Children) -> Stage<'_> {
    Stage {
        kinds: kinds.into(),
        outward,
        faces,
        children,
    }
}
