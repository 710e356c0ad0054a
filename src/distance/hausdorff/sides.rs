//! The sides asked for, one after the other: with matching over common parameters, or without.

use super::Side;
use super::bvh::Tree;
use super::facets::FacetSet;
use super::own::{Candidate, Leftover, OfMesh, OfSurface, OwnMesh, Role, facet_slack};
use super::search::{Closeness, Enclosure, Open, Search, Start};
use super::shape::Shape;
use super::surface::SurfaceSet;
use crate::distance::model::Model;
use crate::mesh::{Point, Topology};
use crate::patch::Float;

/// Points that are looked at first.
const FIRST_LOOK: usize = 256;
/// Points that are looked at after each block of faces.
const LOOK: usize = 32;
/// Items whose corners are looked at first where there is no matching.
const STRIDE: u32 = 4096;

/// Told how many faces of how many are done.
pub type Progress<'a> = &'a (dyn Fn(u32, u32) + Sync);

/// A mesh in the frame; the exact positions are within `radius` per coordinate.
pub struct Placed<'a> {
    pub topology: &'a Topology,
    pub positions: &'a [Point<f64>],
    pub radius: f64,
}

/// What both sides share.
pub struct Scene<'a> {
    pub mesh: Placed<'a>,
    pub facets: FacetSet,
    pub largest: f64,
    pub error: f64,
    pub closeness: Closeness,
    pub progress: Progress<'a>,
}

/// One or two sides, with what is known of each.
pub type Sides = Vec<(Side, Enclosure)>;

impl Scene<'_> {
    /// The sides asked for, one after the other: the second need not look at what is below the
    /// first's lower bound.
    fn in_turn(&self, side: Side, measure: impl Fn(Side, &mut Enclosure)) -> Sides {
        let list: &[Side] = match side {
            Side::Both => &[Side::SurfaceToMesh, Side::MeshToSurface],
            Side::SurfaceToMesh => &[Side::SurfaceToMesh],
            Side::MeshToSurface => &[Side::MeshToSurface],
        };
        let mut floor = 0.0;
        let one = |side: &Side| {
            let mut found = Enclosure {
                lo: floor,
                ..Enclosure::default()
            };
            measure(*side, &mut found);
            floor = found.lo;
            (*side, found)
        };
        list.iter().map(one).collect()
    }

    /// Surface and mesh.
    pub fn sides<M: Model<Float>>(
        &self,
        model: &M,
        surface: &Placed<'_>,
        side: Side,
        matched: bool,
    ) -> Sides {
        let set = SurfaceSet::new(
            model,
            surface.topology,
            surface.positions,
            surface.radius,
            self.largest,
            self.error,
        );
        if !matched {
            return self.pair(side, &set);
        }
        let sides = (0..self.mesh.topology.face_count())
            .map(|face| self.mesh.topology.face_size(face))
            .max()
            .unwrap_or(3);
        let own = |role: Role| OwnMesh {
            surface: &set,
            model,
            topology: self.mesh.topology,
            positions: self.mesh.positions,
            slack: facet_slack(sides, self.mesh.radius, self.largest),
            error: self.error,
            role,
        };
        self.in_turn(side, |side, found| match side {
            Side::MeshToSurface => {
                let tree = Tree::new(&set.boxes());
                let search = self.search(&self.facets, &set, &tree);
                self.matched::<M, OfMesh, _, _>(&own(Role::Mesh), &search, found);
            }
            _ => {
                let tree = Tree::new(&self.facets.boxes());
                let search = self.search(&set, &self.facets, &tree);
                self.matched::<M, OfSurface, _, _>(&own(Role::Surface), &search, found);
            }
        })
    }

    fn search<'s, A: Shape, B: Shape>(
        &self,
        source: &'s A,
        target: &'s B,
        tree: &'s Tree,
    ) -> Search<'s, A, B> {
        Search {
            source,
            target,
            tree,
            error: self.error,
            closeness: self.closeness,
        }
    }

    /// One side, with matching over the same parameters.
    fn matched<M, L, A, B>(
        &self,
        own: &OwnMesh<'_, M>,
        search: &Search<'_, A, B>,
        found: &mut Enclosure,
    ) where
        M: Model<Float>,
        L: Leftover<M>,
        A: Shape<Piece = L::Piece>,
        B: Shape,
    {
        let look = |found: &mut Enclosure, mut far: Vec<Candidate>, count: usize| {
            far.retain(|c| c.value > found.lo);
            far.sort_by(|a, b| b.value.total_cmp(&a.value));
            far.truncate(count);
            let points: Vec<_> = far.iter().map(|c| (c.point, c.slack, c.face)).collect();
            for sample in search.samples(&points, found.lo) {
                found.include(sample);
            }
        };
        look(found, own.glance::<L>(), FIRST_LOOK);
        let count = self.mesh.topology.face_count();
        let left = own.settle::<L>(
            &self.closeness,
            found,
            |found, far| look(found, far, LOOK),
            &|done| (self.progress)(done, count),
        );
        search.run(left, found, &|_| ());
    }

    /// Two sets without common parameters; `set` is in the surface's place.
    pub fn pair<A: Shape>(&self, side: Side, set: &A) -> Sides {
        self.in_turn(side, |side, found| match side {
            Side::MeshToSurface => self.unmatched(&self.facets, set, found),
            _ => self.unmatched(set, &self.facets, found),
        })
    }

    fn unmatched<A: Shape, B: Shape>(&self, source: &A, target: &B, found: &mut Enclosure) {
        let tree = Tree::new(&target.boxes());
        let search = self.search(source, target, &tree);
        let count = source.item_count();
        let step = count.div_ceil(STRIDE).max(1);
        let (mut scratch, mut pieces, mut points) = (A::Scratch::default(), Vec::new(), Vec::new());
        for item in (0..count).step_by(step as usize) {
            pieces.clear();
            source.open(item, &mut scratch, &mut pieces);
            points.extend(pieces.first().map(|piece| {
                let outline = source.outline(piece);
                (outline.corners[0], outline.slack, source.face_of(item))
            }));
        }
        for sample in search.samples(&points, found.lo) {
            found.include(sample);
        }
        // No two points of the frame are further apart than 2 sqrt(3) L < 4 L.
        let open = (0..count).map(|item| Open {
            bound: 4.0 * self.largest,
            face: source.face_of(item),
            start: Start::Item(item),
        });
        let progress = |left: usize| {
            (self.progress)(count.saturating_sub(left as u32), count);
        };
        search.run(open.collect(), found, &progress);
    }
}
