//! What a proof is about: the surface of a mesh, and the facets that it is compared with.

use super::super::hausdorff::Facets;
use super::part::{Net, Rules, middle, quarters};
use super::{Boundary, CertifyError, Flat, LARGEST, Request};
use crate::bernstein::tensor::Bicubic;
use crate::bernstein::triangle::QuarticTriangle;
use crate::mesh::{Mesh, Point, Topology};
use crate::refine::{limit_positions, refine};
use crate::scalar::{Interval, Rational};
use crate::scheme::{CornerRule, Scheme};

pub(super) type P = Point<Interval>;

/// A triangle, or a bilinear quad.
#[derive(Clone, Debug)]
pub(super) struct Facet {
    /// Three or four.
    pub(super) corners: Vec<P>,
    /// The face, and for a quarter of a polygon its letter; where F and S have the same parameters.
    pub(super) own: Option<(u32, Option<u8>)>,
    /// Whether it counts for the distance from the mesh to the surface.
    pub(super) counts: bool,
}

impl Facet {
    /// Its three corners, if it is a triangle.
    pub(super) fn triangle(&self) -> Option<&[P; 3]> {
        self.corners.as_slice().try_into().ok()
    }
}

pub(super) struct Setting {
    pub(super) rules: Rules,
    /// The level-K mesh.
    pub(super) mesh: Mesh<Interval>,
    /// Faces with surface.
    pub(super) faces: Vec<u32>,
    pub(super) facets: Vec<Facet>,
    /// F at the corners of each face, if S and F can be matched.
    flat: Option<Vec<P>>,
}

fn enclosed(mesh: &Mesh<Rational>) -> Mesh<Interval> {
    let point = |p: &Point<Rational>| Point(p.0.each_ref().map(Interval::from_rational));
    Mesh {
        topology: mesh.topology.clone(),
        positions: mesh.positions.iter().map(point).collect(),
    }
}

impl Setting {
    pub(super) fn new(mesh: &Mesh<Rational>, request: &Request<'_>) -> Result<Self, CertifyError> {
        let corner = match request.boundary {
            Boundary::Sharp => CornerRule::Sharp,
            Boundary::Smooth | Boundary::None => CornerRule::Smooth,
        };
        let whole = request.boundary != Boundary::None;
        if !whole && (request.level > 0 || matches!(request.flat, Flat::Limit)) {
            return Err(CertifyError::NoBoundaryRule);
        }
        if request.scheme == Scheme::DooSabin {
            return Err(CertifyError::DooSabin);
        }
        let grown = u64::from(mesh.topology.halfedge_count()) * 4u64.pow(request.level.min(16)) / 3;
        let faces = match request.flat {
            Flat::Other(other) => grown.max(u64::from(other.topology.face_count())),
            _ => grown,
        };
        if faces > LARGEST {
            return Err(CertifyError::TooManyFaces { faces });
        }
        let first = enclosed(mesh);
        let rules = Rules::new(request.scheme, corner, &first).ok_or(CertifyError::DooSabin)?;
        let mesh = refine::<Interval>(request.scheme, corner, &first, request.level)?;
        let topology = &mesh.topology;
        let inner = |f: &u32| {
            topology
                .corners(*f)
                .iter()
                .all(|v| !topology.is_boundary_vertex(*v))
        };
        let faces: Vec<u32> = (0..topology.face_count())
            .filter(|f| whole || inner(f))
            .collect();
        if faces.is_empty() {
            return Err(CertifyError::NoSurface);
        }
        let flat = match request.flat {
            Flat::Control => Some(mesh.positions.clone()),
            Flat::Limit => Some(limit_positions::<Interval, P>(
                request.scheme,
                corner,
                topology,
                &mesh.positions,
            )?),
            Flat::Other(_) => None,
        };
        let counts = |face: u32| whole || inner(&face);
        let facets = match (&flat, request.flat) {
            (Some(flat), _) => facets_of(topology, flat, request, true, &counts),
            (None, Flat::Other(other)) => {
                let other = enclosed(other);
                facets_of(&other.topology, &other.positions, request, false, &|_| true)
            }
            (None, _) => Vec::new(),
        };
        let triangles = topology.arity() == Some(3);
        let flat = flat.filter(|_| triangles || request.facets == Facets::Bilinear);
        Ok(Setting {
            rules,
            mesh,
            faces,
            facets,
            flat,
        })
    }

    /// F at the corners of a face, if S and F can be matched there.
    pub(super) fn flat(&self, face: u32) -> Option<Vec<P>> {
        let flat = self.flat.as_ref()?;
        Some(
            self.mesh
                .topology
                .corners(face)
                .iter()
                .map(|v| flat[*v as usize])
                .collect(),
        )
    }

    /// The largest coordinate of a facet.
    pub(super) fn size(&self) -> f64 {
        let corners = self.facets.iter().flat_map(|facet| &facet.corners);
        let coordinates = corners.flat_map(|p| p.0.map(Interval::mag));
        coordinates.fold(0.0, f64::max)
    }

    pub(super) fn is_loop(&self) -> bool {
        matches!(self.rules.scheme, Scheme::Loop(_))
    }
}

/// F over the children of a part of a face, in the order of letters.
pub(super) fn flat_parts(corners: &[P], triangles: bool) -> Vec<Vec<P>> {
    if triangles || corners.len() == 4 {
        quarters(corners)
    } else {
        polygon_quarters(corners)
    }
}

/// The bilinear quarters of a polygon: corner, middle, centroid, middle.
fn polygon_quarters(corners: &[P]) -> Vec<Vec<P>> {
    let m = corners.len();
    let sum = corners
        .iter()
        .fold(num_traits::Zero::zero(), |sum: P, p| sum + p);
    let centroid = sum * &crate::scalar::Field::ratio(1, m as i64);
    let mid = |i: usize| middle(&corners[i % m], &corners[(i + 1) % m]);
    (0..m)
        .map(|i| vec![corners[i], mid(i), centroid, mid(i + m - 1)])
        .collect()
}

fn facets_of(
    topology: &Topology,
    points: &[P],
    request: &Request<'_>,
    own: bool,
    counts: &dyn Fn(u32) -> bool,
) -> Vec<Facet> {
    let (facets, is_loop) = (request.facets, matches!(request.scheme, Scheme::Loop(_)));
    let mut all = Vec::new();
    for face in 0..topology.face_count() {
        let corners: Vec<P> = topology
            .corners(face)
            .iter()
            .map(|v| points[*v as usize])
            .collect();
        let m = corners.len();
        let mut add = |corners: Vec<P>, letter: Option<u8>| {
            let matches = if m == 3 {
                is_loop
            } else {
                facets == Facets::Bilinear
            };
            let own = (own && matches).then_some((face, letter));
            all.push(Facet {
                corners,
                own,
                counts: counts(face),
            });
        };
        match (m, facets) {
            (3, _) | (4, Facets::Bilinear) => add(corners, None),
            (_, Facets::Triangles) => {
                for i in 2..m {
                    add(vec![corners[0], corners[i - 1], corners[i]], None);
                }
            }
            (_, Facets::Bilinear) => {
                for (i, quarter) in polygon_quarters(&corners).into_iter().enumerate() {
                    add(quarter, Some(i as u8));
                }
            }
        }
    }
    all
}

/// Not below |S - F| over a part, F having these corners on it.
pub(super) fn matched(net: &Net, rules: &Rules, flat: &[P]) -> f64 {
    use super::facet::{root_above, square, to_point};
    let zero: P = num_traits::Zero::zero();
    let largest = |s: &[P], f: &[P]| {
        root_above(
            s.iter()
                .zip(f)
                .map(|(s, f)| square(&(*s - f), &zero).sup())
                .fold(0.0, f64::max),
        )
    };
    match (net.patch(rules), flat) {
        (Some(patch), [a, b, c]) => largest(
            &patch,
            &QuarticTriangle::from_linear::<Interval>(&[*a, *b, *c]).0,
        ),
        (Some(patch), [a, b, c, d]) => largest(
            &patch,
            &Bicubic::from_bilinear::<Interval>(&[*a, *b, *c, *d]).0,
        ),
        _ => {
            let hull = net.hull(rules);
            flat.iter().map(|f| to_point(&hull, f)).fold(0.0, f64::max)
        }
    }
}

/// A number written as a short rational, as k / 4096.
pub(super) fn coarse(x: f64) -> (i64, f64) {
    let k = (x * 4096.0).round();
    (k as i64, k / 4096.0)
}
