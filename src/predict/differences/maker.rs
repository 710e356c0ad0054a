//! Makes stages, refining where needed.

use std::borrow::Cow;

use super::Request;
use super::connectivity::Connectivity;
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
use crate::scheme::{LoopWeights, Scheme};

/// Above what underflow of squares takes from a length in a frame of size 1, or above 2^-200.
const TINY: f64 = 1e-150;

/// A mesh of some level in some unit, known up to a radius.
struct Level<'a> {
    topology: Connectivity<'a>,
    positions: Cow<'a, [Point<f64>]>,
    radius: f64,
}

impl Level<'_> {
    fn short_of(&self, extent: f64) -> f64 {
        short_of(largest_valence(&self.topology), extent, self.radius)
    }
}

/// Makes stages, refining where needed.
pub(super) struct Maker<'a> {
    request: Request,
    refiner: Refiner<Point<f64>>,
    unit: Unit,
    /// The mesh in its own unit.
    given: Level<'a>,
    /// It and its refinements in the frame, as far as they were needed.
    levels: Vec<Level<'a>>,
}

impl<'a> Maker<'a> {
    /// For a mesh that the scheme takes.
    ///
    /// # Errors
    /// As [`Unit::of`].
    pub(super) fn new(
        request: &Request,
        topology: &'a Topology,
        positions: &'a [Point<f64>],
    ) -> Result<Self, RefineError> {
        Ok(Maker {
            request: *request,
            refiner: Refiner::new(request.scheme, request.corner),
            unit: Unit::of(request.scheme, topology, positions)?,
            given: Level {
                topology: Connectivity::Given(topology),
                positions: Cow::Borrowed(positions),
                radius: 0.0,
            },
            levels: Vec::new(),
        })
    }

    /// Refines up to a level.
    fn reach(&mut self, level: usize) -> Result<(), RefineError> {
        if self.levels.is_empty() {
            let (positions, radius) = self.unit.frame.enter(&self.given.positions);
            self.levels.push(Level {
                topology: self.given.topology.clone(),
                positions: Cow::Owned(positions),
                radius,
            });
        }
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
                topology: Connectivity::Refined(topology.into()),
                positions: Cow::Owned(positions),
                radius,
            });
        }
        Ok(())
    }

    fn outward(&self) -> Outward {
        let extent = self.unit.extent();
        let of = |level: usize| self.levels[level.min(self.levels.len() - 1)].short_of(extent);
        Outward {
            off: [0, 1, 2, 3, 4].map(of),
        }
    }

    /// The faces after j steps.
    pub(super) fn stage(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
        match self.request.scheme {
            Scheme::Loop(weights) => self.triangles(weights, j),
            Scheme::CatmullClark => self.quads(j),
            Scheme::DooSabin => self.quarters(j),
        }
    }

    /// The last step is a formula.
    fn triangles(&mut self, weights: LoopWeights, j: usize) -> Result<Stage<'a>, RefineError> {
        let Request {
            scheme,
            corner,
            against,
            ..
        } = self.request;
        let from = j.saturating_sub(1);
        let (level, outward, exponent) = if self.unit.plain && from == 0 {
            let off = self.given.short_of(self.unit.plain_extent());
            (&self.given, Outward { off: [off; 5] }, 0)
        } else {
            self.reach(from)?;
            let outward = self.outward();
            (&self.levels[from], outward, self.unit.frame.exponent)
        };
        let (kinds, of_vertex) = Kinds::of_vertices(scheme, corner, against, &level.topology);
        let (topology, positions) = (level.topology.clone(), &level.positions);
        let triangles = match j {
            0 => Triangles::now(topology, positions, scheme, against, &kinds, of_vertex),
            _ => Triangles::after_a_step(topology, positions, weights, &kinds, of_vertex, j),
        };
        Ok(Stage {
            kinds: kinds.into(),
            outward,
            exponent,
            faces: Faces::Triangles(Box::new(triangles)),
            children: Children::Shift(2 * from as u32),
        })
    }

    fn quads(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
        let request = self.request;
        let mut all = Vec::new();
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
            all.push((level.topology.clone(), quads));
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
        Ok(self.framed(kinds, Faces::Quads(first), self.children_by_corners(j)))
    }

    fn quarters(&mut self, j: usize) -> Result<Stage<'a>, RefineError> {
        let request = self.request;
        let mut all: Vec<Quarters<'a>> = Vec::new();
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
            let quarters = Quarters::new(level.topology.clone(), &level.positions, of_face);
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
        let kinds = kinds.expect("a level");
        Ok(self.framed(kinds, Faces::Quarters(levels), self.children_by_vertices(j)))
    }

    /// A stage in the frame's unit.
    fn framed(&self, kinds: Kinds, faces: Faces<'a>, children: Children) -> Stage<'a> {
        Stage {
            kinds: kinds.into(),
            outward: self.outward(),
            exponent: self.unit.frame.exponent,
            faces,
            children,
        }
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
