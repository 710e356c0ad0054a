//! The limit surface of a mesh as a set: Bézier patches and nets of each face, in one frame.
//!
//! A face's pieces are computed relative to its first corner and then moved there, which rounds once
//! more. The errors of [`crate::patch::rounding`] are charged in full when the face is opened, for
//! half of [`DEEPEST`] steps and for [`DEEPEST`] halvings; no piece goes deeper.

use rayon::prelude::*;

use super::facets::lane;
use super::metric::Aabb;
use super::shape::{Outline, Shape};
use crate::bernstein::Patch;
use crate::distance::model::{Gathered, Model};
use crate::mesh::{Point, Topology};
use crate::patch::rounding::Extent;
use crate::patch::{Corners, Float, Lane, Sink};
use crate::scalar::float::UNIT_ROUNDOFF;

/// Halvings of a piece, at most, a local step counting as two (one in each direction): parameters are
/// exact, sizes down to 1e-12.
const DEEPEST: u32 = 80;

/// A surface, face by face.
pub struct SurfaceSet<'a, M> {
    model: &'a M,
    topology: &'a Topology,
    positions: &'a [Point<f64>],
    /// Bound of the error of the positions, per coordinate.
    radius: f64,
    /// Bound of every |coordinate|.
    largest: f64,
    /// What a computed distance can be off by.
    error: f64,
}

enum Cell<B, N> {
    Patch(B),
    Net(N),
}

/// A part of the surface over a face: a polynomial patch, or the net at an irregular point.
pub struct SurfacePiece<M: Model<Float>> {
    cell: Cell<M::Patch, M::Net>,
    base: Lane,
    corners: Corners,
    /// Halvings, and twice the local steps.
    depth: u32,
    outline: Outline,
}

/// Storage of [`SurfaceSet`].
pub struct SurfaceScratch<M: Model<Float>> {
    model: M::Scratch,
    fresh: Fresh<M>,
}

struct Fresh<M: Model<Float>> {
    patches: Vec<(M::Patch, Corners, u32)>,
    nets: Vec<M::Net>,
    spare: Vec<M::Net>,
}

impl<M: Model<Float>> Default for SurfaceScratch<M> {
    fn default() -> Self {
        SurfaceScratch {
            model: M::Scratch::default(),
            fresh: Fresh {
                patches: Vec::new(),
                nets: Vec::new(),
                spare: Vec::new(),
            },
        }
    }
}

impl<M: Model<Float>> Sink<M::Patch, M::Net> for Fresh<M> {
    fn patch(&mut self, patch: &M::Patch, corners: Corners, steps: u32) {
        self.patches.push((patch.clone(), corners, steps));
    }
    fn spare(&mut self) -> M::Net {
        self.spare.pop().unwrap_or_default()
    }
    fn net(&mut self, net: M::Net) {
        self.nets.push(net);
    }
    fn discard(&mut self, net: M::Net) {
        self.spare.push(net);
    }
}

impl<'a, M: Model<Float>> SurfaceSet<'a, M> {
    /// The surface of a model whose F is the origin ([`crate::patch::Facet::Nothing`]).
    pub fn new(
        model: &'a M,
        topology: &'a Topology,
        positions: &'a [Point<f64>],
        radius: f64,
        largest: f64,
        error: f64,
    ) -> Self {
        SurfaceSet {
            model,
            topology,
            positions,
            radius,
            largest,
            error,
        }
    }

    /// Whether pieces have three corners.
    pub fn is_triangular(&self) -> bool {
        count::<M>() == 3
    }

    /// Parameters of a piece's corners in the face.
    pub fn parameters(&self, piece: &SurfacePiece<M>) -> Corners {
        piece.corners
    }

    fn slack(&self, gathered: Gathered) -> f64 {
        surface_slack(gathered, self.radius, self.largest)
    }

    fn patch(
        &self,
        patch: M::Patch,
        base: Lane,
        slack: f64,
        corners: Corners,
        depth: u32,
    ) -> SurfacePiece<M> {
        let coefficients = patch.coefficients();
        let at = |corner: usize| coefficients[M::Patch::corner_index(corner.min(count::<M>() - 1))];
        let ends = [at(0), at(1), at(2), at(3)];
        let flat = M::Patch::interpolant(&ends);
        let mut square = 0.0_f64;
        for (b, f) in coefficients.iter().zip(flat.coefficients()) {
            square = square.max((*b - f).norm_squared());
        }
        let outline = Outline {
            corners: ends.map(|c| c + base),
            count: count::<M>(),
            thickness: square.sqrt() + self.error + slack,
            slack,
        };
        SurfacePiece {
            cell: Cell::Patch(patch),
            base,
            corners,
            depth,
            outline,
        }
    }

    /// S over the net lies in the hull of its points, so it is at most as far from a point of the
    /// corners' hull as the farthest of them from the farthest corner.
    fn net(&self, net: M::Net, base: Lane, slack: f64) -> SurfacePiece<M> {
        let mut ends = self.model.net_corners(&net);
        if count::<M>() == 3 {
            ends[3] = ends[0];
        }
        let (corners, steps) = self.model.net_place(&net);
        let mut thickness = 0.0_f64;
        for p in self.model.net_points(&net) {
            for c in &ends {
                thickness = thickness.max((*p - c).norm_squared());
            }
        }
        let outline = Outline {
            corners: ends.map(|c| c + base),
            count: count::<M>(),
            thickness: thickness.sqrt() + self.error + slack,
            slack,
        };
        SurfacePiece {
            cell: Cell::Net(net),
            base,
            corners,
            depth: 2 * steps,
            outline,
        }
    }

    /// Turns what a step yielded into pieces.
    fn settle(
        &self,
        scratch: &mut SurfaceScratch<M>,
        (base, slack): (Lane, f64),
        out: &mut Vec<SurfacePiece<M>>,
    ) {
        let SurfaceScratch { model, fresh } = scratch;
        while let Some(net) = fresh.nets.pop() {
            if self.model.splits_at_once(&net) {
                self.model.split(&net, model, fresh);
                fresh.spare.push(net);
            } else {
                out.push(self.net(net, base, slack));
            }
        }
        for (patch, corners, steps) in fresh.patches.drain(..) {
            out.push(self.patch(patch, base, slack, corners, 2 * steps));
        }
    }
}

/// Bound of the error of every point computed on a face, as a vector: of all local steps and halvings
/// there can be, and of the move to the face's place (two roundings of at most L).
pub(super) fn surface_slack(gathered: Gathered, radius: f64, largest: f64) -> f64 {
    let extent = Extent {
        size: gathered.size,
        arity: gathered.arity,
        mesh_radius: radius,
    };
    // Coefficients are within sqrt(3) of the size of the net.
    let relative = extent.radius(DEEPEST / 2 + 1, DEEPEST, 2.0 * gathered.size);
    1.7321 * (relative + 2.0 * UNIT_ROUNDOFF * largest)
}

/// Number of corners of a piece.
fn count<M: Model<Float>>() -> usize {
    <M::Patch as Patch<f64, Lane>>::CORNERS
}

impl<M: Model<Float>> Shape for SurfaceSet<'_, M> {
    type Piece = SurfacePiece<M>;
    type Scratch = SurfaceScratch<M>;

    fn item_count(&self) -> u32 {
        self.model.face_count()
    }

    fn face_of(&self, item: u32) -> u32 {
        item
    }

    fn open(&self, item: u32, scratch: &mut Self::Scratch, out: &mut Vec<Self::Piece>) {
        let gathered = self
            .model
            .open(item, &mut scratch.model, &mut scratch.fresh);
        let first = self.topology.corners(item)[0];
        let base = lane(&self.positions[first as usize]);
        let slack = if gathered.arity == 0 {
            0.0
        } else {
            self.slack(gathered)
        };
        self.settle(scratch, (base, slack), out);
    }

    fn split(&self, piece: &Self::Piece, scratch: &mut Self::Scratch, out: &mut Vec<Self::Piece>) {
        if piece.depth >= DEEPEST {
            return;
        }
        let slack = piece.outline.slack;
        match &piece.cell {
            Cell::Patch(patch) => {
                for (half, corners) in patch.halve(&piece.corners) {
                    out.push(self.patch(half, piece.base, slack, corners, piece.depth + 1));
                }
            }
            Cell::Net(net) => {
                self.model
                    .split(net, &mut scratch.model, &mut scratch.fresh);
                self.settle(scratch, (piece.base, slack), out);
            }
        }
    }

    fn outline<'p>(&self, piece: &'p Self::Piece) -> &'p Outline {
        &piece.outline
    }

    fn hull(&self, piece: &Self::Piece, mut visit: impl FnMut(&Lane)) {
        match &piece.cell {
            Cell::Patch(patch) => {
                for p in patch.coefficients() {
                    visit(&(*p + piece.base));
                }
            }
            Cell::Net(net) => {
                for p in self.model.net_points(net) {
                    visit(&(*p + piece.base));
                }
            }
        }
    }

    fn boxes(&self) -> Vec<Aabb> {
        (0..self.item_count())
            .into_par_iter()
            .with_min_len(64)
            .map_init(
                || (SurfaceScratch::default(), Vec::new()),
                |(scratch, pieces), item| {
                    pieces.clear();
                    self.open(item, scratch, pieces);
                    pieces
                        .iter()
                        .fold(Aabb::EMPTY, |all, piece| all.join(&self.piece_box(piece)))
                },
            )
            .collect()
    }

    fn triangle(&self, _: u32) -> Option<(&[Lane; 3], f64)> {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::distance::model::{CatmullClarkModel, DooSabinModel, LoopModel, MeshView};
    use crate::patch::Facet;
    use crate::patch::quad_net::CatmullClarkRules;
    use crate::patch::quarter_net::DooSabinRules;
    use crate::patch::triangle_net::LoopRules;
    use crate::scheme::{CornerRule, LoopWeights};

    /// A net's corners are by limit masks, a patch's are Bernstein coefficients after more steps: pieces of a face,
    /// coarse and fine, have the same point at the same parameters.
    fn corners_agree<M: Model<Float>>(
        model: &M,
        topology: &Topology,
        positions: &[Point<f64>],
    ) -> usize {
        let set = SurfaceSet::new(model, topology, positions, 0.0, 8.0, 0.0);
        let (mut scratch, mut shared) = (SurfaceScratch::default(), 0);
        for face in 0..set.item_count() {
            let (mut pieces, mut seen) = (Vec::new(), Vec::<([f64; 2], Lane)>::new());
            set.open(face, &mut scratch, &mut pieces);
            for _ in 0..4 {
                for piece in &pieces {
                    for (at, point) in set.parameters(piece).iter().zip(piece.outline.corners()) {
                        match seen.iter().find(|(known, _)| known == at) {
                            None => seen.push((*at, *point)),
                            Some((_, known)) => {
                                let apart = (*known - point).norm_squared().sqrt();
                                assert!(apart < 1e-13, "face {face}, {at:?}: {known:?}, {point:?}");
                                shared += 1;
                            }
                        }
                    }
                }
                for piece in std::mem::take(&mut pieces) {
                    set.split(&piece, &mut scratch, &mut pieces);
                }
            }
        }
        shared
    }

    #[test]
    fn pieces_agree_at_common_corners() {
        let positions = |count: u32| -> Vec<Point<f64>> {
            let mixed = |k: u32| f64::from(k.wrapping_mul(0x9e37_79b9) >> 24) / 64.0;
            let point = |k: u32| Point([1, 2, 3].map(|i| mixed(3 * k + i)));
            (0..count).map(point).collect()
        };
        // A prism over a pentagon: vertices of valence 3, faces of four and five sides.
        let mut corners = vec![0, 1, 2, 3, 4, 9, 8, 7, 6, 5];
        corners.extend((0..5).flat_map(|i| [i, 5 + i, 5 + (i + 1) % 5, (i + 1) % 5]));
        let start = [0, 5].into_iter().chain((0..=5).map(|i| 10 + 4 * i));
        let prism = Topology::from_polygons(10, start.collect(), corners).expect("a prism");
        let net = positions(10);
        let mesh = || MeshView {
            topology: &prism,
            positions: &net,
            compared: Facet::Nothing,
        };
        let rules = CatmullClarkRules::new(CornerRule::Smooth, &prism);
        let model = CatmullClarkModel {
            mesh: mesh(),
            rules,
        };
        assert!(corners_agree(&model, &prism, &net) > 100);
        let rules = DooSabinRules::new(&prism).expect("masks");
        let model = DooSabinModel {
            mesh: mesh(),
            rules,
        };
        assert!(corners_agree(&model, &prism, &net) > 100);
        // Two fans over a pentagon: valences 4 and 5.
        let fans = (0..5).flat_map(|i| [i, (i + 1) % 5, 5, (i + 1) % 5, i, 6]);
        let fans = Topology::from_uniform(7, 3, fans.collect()).expect("a bipyramid");
        let net = positions(7);
        let mesh = MeshView {
            topology: &fans,
            positions: &net,
            compared: Facet::Nothing,
        };
        let rules = LoopRules::new(LoopWeights::Original, CornerRule::Smooth, &fans);
        let rules = rules.expect("masks");
        assert!(corners_agree(&LoopModel { mesh, rules }, &fans, &net) > 100);
    }
}
