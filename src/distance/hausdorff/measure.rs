//! From meshes to an enclosure of their Hausdorff distance, in their own unit.
//!
//! Both meshes are brought into one frame (`mesh::frame`); refinement and limit positions
//! carry their error bounds. With its own mesh a surface is first matched over the same parameters
//! ([`super::own`]); what that leaves, or everything with another mesh, goes to [`super::search`].
//! [`super::sides`] puts these together.

use std::time::Instant;

use super::facets::FacetSet;
use super::metric::error_bound;
use super::search::{Closeness, Enclosure};
use super::sides::{Placed, Progress, Scene, Sides};
use super::surface::surface_slack;
use super::{Facets, Goal, HOLDERS, HausdorffError, Holder, Measurement, Request, Side, Witness};
use crate::distance::measure::{MeasureError, check_mesh};
use crate::distance::model::{
    Against, CatmullClarkModel, DooSabinModel, Gathered, LoopModel, MeshView,
};
use crate::mesh::Mesh;
use crate::mesh::frame::{Frame, printed_above, printed_below};
use crate::patch::quad_net::CatmullClarkRules;
use crate::patch::quarter_net::DooSabinRules;
use crate::patch::triangle_net::LoopRules;
use crate::patch::{Facet, Float, Lane};
use crate::refine::enclosure::largest_coordinate;
use crate::refine::{Refiner, refine_topology, topology};
use crate::scheme::Scheme;

/// Pieces of one side after which it is left undecided: many more than a gap of 1e-6 takes, unless the
/// two sets are one and the same, cut differently.
const CELLS: u64 = 1 << 20;
const CELLS_PER_FACE: u64 = 256;

/// Encloses a Hausdorff distance between the limit surface of `mesh` and its own level-K mesh, or
/// `other` if given.
///
/// The claim is about the `f64` coordinates. Without a budget the result depends on nothing but the
/// arguments; with one, the enclosure still holds, but its ends depend on the time there was.
///
/// # Errors
/// If and only if the scheme does not apply to the mesh, its surface is empty, a mesh has no face or a
/// coordinate that is not finite, or Doo-Sabin's own mesh is to be cut into triangles.
///
/// ```
/// use subcert::distance::hausdorff::{Facets, Goal, Request, Side, measure};
/// use subcert::distance::model::Against;
/// use subcert::mesh::io::{Format, parse};
/// use subcert::scheme::{CornerRule, Scheme};
///
/// // A cube under Catmull-Clark: the corner (1, 1, 1) is the furthest point of the cube, its nearest
/// // point of the surface is its limit (9 + 4 - 1)/24 (1, 1, 1): sqrt 3 / 2.
/// let text = b"v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n\
///     f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
/// let mesh = parse(text, Format::Obj, "cube")?.mesh;
/// let request = Request {
///     scheme: Scheme::CatmullClark,
///     corner: CornerRule::Smooth,
///     level: 0,
///     against: Against::Control,
///     side: Side::MeshToSurface,
///     facets: Facets::Bilinear,
///     goal: Goal::default(),
/// };
/// let found = measure(&mesh, None, &request, &|_, _| ())?;
/// let exact = 3.0_f64.sqrt() / 2.0;
/// assert!(found.met && found.lo <= exact && exact <= found.hi);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn measure(
    mesh: &Mesh,
    other: Option<&Mesh>,
    request: &Request,
    progress: Progress<'_>,
) -> Result<Measurement, HausdorffError> {
    let start = Instant::now();
    topology::check(request.scheme, &mesh.topology).map_err(MeasureError::from)?;
    check(mesh)?;
    other.map_or(Ok(()), check)?;
    let polygons = mesh.topology.arity() != Some(3);
    if request.scheme == Scheme::DooSabin
        && request.facets == Facets::Triangles
        && polygons
        && other.is_none()
    {
        return Err(HausdorffError::Quarters);
    }
    let interior = |v: u32| !mesh.topology.is_boundary_vertex(v) && mesh.topology.valence(v) > 0;
    if request.scheme == Scheme::DooSabin && !(0..mesh.topology.vertex_count()).any(interior) {
        return Err(MeasureError::EmptySurface.into());
    }
    let frame = Frame::covering(&[mesh, other.unwrap_or(mesh)], true);
    let (mut level, mut radius) = frame.enter(&mesh.positions);
    let mut refiner = Refiner::new(request.scheme, request.corner);
    let mut refined = None;
    let mut next = Vec::new();
    let levels = if other.is_some() { 0 } else { request.level };
    for _ in 0..levels {
        let coarse = refined.as_ref().unwrap_or(&mesh.topology);
        radius = refiner
            .enclose_into(coarse, &level, radius, &mut next)
            .map_err(MeasureError::from)?;
        std::mem::swap(&mut level, &mut next);
        refined = Some(refine_topology(request.scheme, coarse).map_err(MeasureError::from)?);
    }
    let topology = refined.as_ref().unwrap_or(&mesh.topology);
    let surface = Placed {
        topology,
        positions: &level,
        radius,
    };
    let mut target = Vec::new();
    let compared = match other {
        Some(other) => {
            let (positions, radius) = frame.enter(&other.positions);
            target = positions;
            Placed {
                topology: &other.topology,
                positions: &target,
                radius,
            }
        }
        None if request.against == Against::Limit => {
            let radius = refiner
                .enclose_limits_into(topology, &level, radius, &mut target)
                .map_err(MeasureError::from)?;
            Placed {
                topology,
                positions: &target,
                radius,
            }
        }
        None => Placed {
            topology,
            positions: &level,
            radius,
        },
    };
    let matched = other.is_none() && (request.facets == Facets::Bilinear || !polygons);
    let unit = Unit {
        frame: &frame,
        first: mesh,
        faces: topology.face_count(),
        mesh_faces: compared.topology.face_count(),
        start,
        goal: request.goal,
    };
    let scene = unit.scene(compared, &surface, request.facets, progress);
    let view = MeshView::<Float> {
        topology,
        positions: &level,
        compared: Facet::Nothing,
    };
    let irrational = "f64 represents every mask";
    let side = request.side;
    let found = match request.scheme {
        Scheme::Loop(weights) => {
            let rules = LoopRules::new(weights, request.corner, topology).expect(irrational);
            let model = LoopModel { mesh: view, rules };
            scene.sides(&model, &surface, side, matched)
        }
        Scheme::CatmullClark => {
            let rules = CatmullClarkRules::new(request.corner, topology);
            let model = CatmullClarkModel { mesh: view, rules };
            scene.sides(&model, &surface, side, matched)
        }
        Scheme::DooSabin => {
            let rules = DooSabinRules::new(topology).expect(irrational);
            let model = DooSabinModel { mesh: view, rules };
            scene.sides(&model, &surface, side, matched)
        }
    };
    Ok(unit.report(found, &scene))
}

/// Encloses a Hausdorff distance between two meshes; `mesh` is in the surface's place.
///
/// # Errors
/// If and only if a mesh has no face or a coordinate that is not finite.
pub fn mesh_to_mesh(
    mesh: &Mesh,
    other: &Mesh,
    side: Side,
    facets: Facets,
    goal: Goal,
    progress: Progress<'_>,
) -> Result<Measurement, HausdorffError> {
    let start = Instant::now();
    check(mesh)?;
    check(other)?;
    let frame = Frame::covering(&[mesh, other], true);
    let (first, radius) = frame.enter(&mesh.positions);
    let (second, other_radius) = frame.enter(&other.positions);
    let surface = Placed {
        topology: &mesh.topology,
        positions: &first,
        radius,
    };
    let compared = Placed {
        topology: &other.topology,
        positions: &second,
        radius: other_radius,
    };
    let unit = Unit {
        frame: &frame,
        first: mesh,
        faces: mesh.topology.face_count(),
        mesh_faces: other.topology.face_count(),
        start,
        goal,
    };
    let scene = unit.scene(compared, &surface, facets, progress);
    let set = FacetSet::new(&mesh.topology, &first, facets, radius, scene.largest);
    let found = scene.pair(side, &set);
    Ok(unit.report(found, &scene))
}

fn check(mesh: &Mesh) -> Result<(), HausdorffError> {
    if mesh.topology.face_count() == 0 {
        return Err(HausdorffError::NoFace);
    }
    Ok(check_mesh(mesh)?)
}

fn coordinates(p: &Lane) -> [f64; 3] {
    [p.0[0], p.0[1], p.0[2]]
}

/// A bound of what every face of a mesh is gathered with: from a corner of a face to any vertex of a
/// face round another of its corners there are at most as many edges as the largest face has.
fn extent(placed: &Placed<'_>, largest: f64) -> Gathered {
    let topology = placed.topology;
    let faces = 0..topology.face_count();
    let sides = faces.map(|f| topology.face_size(f)).max().unwrap_or(3);
    let vertices = 0..topology.vertex_count();
    let valence = vertices.map(|v| topology.valence(v)).max().unwrap_or(0);
    let length = |h: u32| {
        let [a, b] = [topology.origin(h), topology.target(h)];
        let [a, b] = [a, b].map(|v| &placed.positions[v as usize].0);
        (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max)
    };
    let longest = (0..topology.halfedge_count())
        .map(length)
        .fold(0.0, f64::max);
    Gathered {
        size: (f64::from(sides) * longest).min(2.0 * largest),
        arity: valence.max(sides) + sides,
    }
}

/// What the frame's numbers mean.
struct Unit<'a> {
    frame: &'a Frame,
    first: &'a Mesh,
    faces: u32,
    mesh_faces: u32,
    start: Instant,
    goal: Goal,
}

impl Unit<'_> {
    fn scene<'s>(
        &self,
        mesh: Placed<'s>,
        surface: &Placed<'_>,
        facets: Facets,
        progress: Progress<'s>,
    ) -> Scene<'s> {
        let coordinate = |placed: &Placed<'_>| {
            largest_coordinate(placed.positions).unwrap_or(0.0) * (1.0 + 1e-9) + placed.radius
        };
        let largest = coordinate(&mesh).max(coordinate(surface));
        let error = error_bound(largest);
        let set = FacetSet::new(mesh.topology, mesh.positions, facets, mesh.radius, largest);
        // A bound at which every piece is closed sooner or later.
        let slack = surface_slack(extent(surface, largest), surface.radius, largest);
        let noise = 8.0 * (error + set.slack() + slack);
        Scene {
            mesh,
            facets: set,
            largest,
            error,
            closeness: Closeness {
                absolute: self.goal.diagonal_gap * self.diagonal(),
                relative: self.goal.gap,
                noise,
                cells: CELLS + CELLS_PER_FACE * u64::from(self.faces.max(self.mesh_faces)),
                deadline: self.goal.budget.map(|budget| self.start + budget),
            },
            progress,
        }
    }

    /// The diagonal of the first mesh's box, in the frame's unit.
    fn diagonal(&self) -> f64 {
        let (low, high) = Frame::corners(&[self.first]);
        let scaled = |i: usize| self.frame.shrink(high[i]) - self.frame.shrink(low[i]);
        (scaled(0).powi(2) + scaled(1).powi(2) + scaled(2).powi(2)).sqrt()
    }

    fn report(&self, sides: Sides, scene: &Scene<'_>) -> Measurement {
        let largest = |key: fn(&Enclosure) -> f64| {
            sides
                .iter()
                .map(|(_, found)| key(found))
                .fold(0.0, f64::max)
        };
        let [lo, hi] = [largest(|e| e.lo), largest(|e| e.hi.max(e.lo))];
        let mut witness = sides.iter().filter_map(|(side, found)| {
            let sample = found.sample.filter(|s| s.lower >= lo)?;
            Some(Witness {
                side: *side,
                point: self.frame.leave(coordinates(&sample.point)),
                foot: self.frame.leave(coordinates(&sample.foot)),
                face: sample.face,
                foot_face: sample.foot_face,
            })
        });
        let witness = witness.next_back();
        let met = hi - lo <= scene.closeness.absolute + scene.closeness.relative * hi;
        let [out_lo, out_hi] = self.frame.lengths([lo, hi]);
        let [lo_out, hi_out] = [printed_below(out_lo), printed_above(out_hi)];
        let [_, noise] = self.frame.lengths([0.0, scene.closeness.noise]);
        let rounding_level = hi <= scene.closeness.noise;
        let holders = self.holders(&sides, lo);
        Measurement {
            lo: lo_out,
            hi: hi_out,
            met: met || rounding_level,
            rounding_level,
            noise,
            diagonal: self.frame.lengths([0.0, self.diagonal()])[1],
            witness,
            holders,
            faces: self.faces,
            mesh_faces: self.mesh_faces,
            cells: sides.iter().map(|(_, found)| found.cells).sum(),
            probes: sides.iter().map(|(_, found)| found.probes).sum(),
        }
    }

    fn holders(&self, sides: &Sides, lo: f64) -> Vec<Holder> {
        let mut holders = Vec::new();
        for (side, found) in sides {
            let mut list: Vec<(u32, f64)> = found
                .holders
                .iter()
                .copied()
                .filter(|(_, hi)| *hi > lo)
                .collect();
            list.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
            list.dedup_by_key(|(face, _)| *face);
            holders.extend(list.into_iter().map(|(face, hi)| Holder {
                side: *side,
                face,
                hi: printed_above(self.frame.lengths([0.0, hi])[1]),
            }));
        }
        holders.sort_by(|a, b| b.hi.total_cmp(&a.hi));
        holders.truncate(HOLDERS);
        holders
    }
}
