//! From covers and far points to a certificate.

use num_bigint::BigInt;
use num_traits::{Signed, Zero};

use super::super::hausdorff::Side;
use super::facet::{root_above, square};
use super::near::{Cell, Cover, mesh_to_surface, surface_to_mesh};
use super::part::Net;
use super::setting::Setting;
use super::{Boundary, CertifyError, Far, Flat, Request, With};
use crate::certificate::{
    Certificate, Claim, Cosines, EigenLink, FarAt, HausdorffClaim, MeshData, NearBy, NearCell, Step,
};
use crate::mesh::{Mesh, Point};
use crate::scalar::cosine::enclose_two_cos;
use crate::scalar::float::round_to_nearest;
use crate::scalar::{Field, Rational};
use crate::scheme::{LoopWeights, Scheme};

/// The eigenspline that a mesh stands for.
#[derive(Clone, Debug)]
pub struct Eigen {
    /// The valence.
    pub valence: u32,
    /// The frequency of the third coordinate.
    pub frequency: u32,
    /// Its factor.
    pub amplitude: Rational,
    /// A bound of the rounding of each coordinate.
    pub within: Rational,
}

/// Binary places of the enclosures of cosines.
const COSINE_BITS: u32 = 80;
/// What the ends are widened by.
const WIDENING: f64 = 1e-9;

/// A certificate of the distance, to the gap asked for.
///
/// `eigen` says that the mesh is the rounded net of an eigenspline: the checker compares it.
///
/// # Errors
/// If and only if the scheme does not apply to the mesh, the surface is empty, the format has no such
/// claim, or the gap is not reached with a bounded number of parts.
pub fn certify(
    mesh: &Mesh<Rational>,
    request: &Request<'_>,
    eigen: Option<&Eigen>,
) -> Result<Certificate, CertifyError> {
    let other = match request.flat {
        Flat::Other(other) => Some(other),
        _ => None,
    };
    let frame = Unit::of(&[Some(mesh), other]);
    let (framed, other) = (frame.enter(mesh), other.map(|other| frame.enter(other)));
    let in_frame = Request {
        flat: match &other {
            Some(other) => Flat::Other(other),
            None => request.flat,
        },
        ..*request
    };
    let too_many = |error| match error {
        CertifyError::TooManyParts { lo, hi } => {
            let [lo, hi] = [lo, hi].map(|x| round_to_nearest(&frame.leave(x)));
            CertifyError::TooManyParts { lo, hi }
        }
        error => error,
    };
    let setting = Setting::new(&framed, &in_frame)?;
    let near_mesh = match request.side {
        Side::MeshToSurface => None,
        _ => Some(surface_to_mesh(&setting, request.gap).map_err(too_many)?),
    };
    let near_surface = match request.side {
        Side::SurfaceToMesh => None,
        _ => Some(mesh_to_surface(&setting, request.gap).map_err(too_many)?),
    };
    let covers = || near_mesh.iter().chain(&near_surface);
    let hi = covers().map(|c| c.hi).fold(0.0, f64::max) * (1.0 + WIDENING);
    let best = covers().max_by(|x, y| x.lo.total_cmp(&y.lo));
    let Some((Some(far), lo)) = best.map(|c| (c.far.clone(), c.lo * (1.0 - WIDENING))) else {
        return Err(CertifyError::NoDistance);
    };
    let mut steps = vec![far_step(far)];
    steps.extend(near_mesh.map(|cover| Step::NearMesh {
        cells: cells(cover),
    }));
    steps.extend(near_surface.map(|cover| Step::NearSurface {
        cells: cells(cover),
    }));
    let vertex = request
        .vertices
        .then(|| vertices(&framed, &in_frame))
        .transpose()?;
    steps.extend(vertex.map(|_| Step::Vertex {}));
    let (vertices, faces) = written(mesh);
    let claim = HausdorffClaim {
        scheme: request.scheme.name().into(),
        weights: request.scheme.weights().map(|w| w.to_string()),
        kind: "hausdorff".into(),
        boundary: match request.boundary {
            Boundary::Smooth => "smooth",
            Boundary::Sharp => "sharp",
            Boundary::None => "none",
        }
        .into(),
        vertices,
        faces,
        level: request.level,
        against: match request.flat {
            Flat::Control => "control",
            Flat::Limit => "limit",
            Flat::Other(_) => "other",
        }
        .into(),
        facets: request.facets.name().into(),
        other: match request.flat {
            Flat::Other(other) => {
                let (vertices, faces) = written(other);
                Some(MeshData { vertices, faces })
            }
            _ => None,
        },
        side: match request.side {
            Side::SurfaceToMesh => "surface-to-mesh",
            Side::MeshToSurface => "mesh-to-surface",
            Side::Both => "both",
        }
        .into(),
        lo: frame.leave(lo).to_string(),
        hi: frame.leave(hi).to_string(),
        vertex: vertex.map(|x| frame.leave(x).to_string()),
        eigen: eigen.map(|e| EigenLink {
            valence: e.valence,
            frequency: e.frequency,
            amplitude: e.amplitude.to_string(),
            within: e.within.to_string(),
        }),
    };
    let mut certificate = Certificate::of_inequality(Claim::Hausdorff(claim), None, steps);
    certificate.cosine = cosines(mesh, request.scheme, eigen);
    Ok(certificate)
}

/// Coordinates of about 1 near the origin, by an exact change of unit and origin: squares neither
/// overflow nor underflow, and intervals lose nothing where a mesh lies far away.
struct Unit {
    factor: Rational,
    origin: Point<Rational>,
}

impl Unit {
    fn of(meshes: &[Option<&Mesh<Rational>>]) -> Self {
        let all = || meshes.iter().flatten().flat_map(|mesh| &mesh.positions);
        let origin = all().next().cloned().unwrap_or_else(Point::zero);
        let apart = all().flat_map(|p| (p.clone() - &origin).0);
        let largest = apart.map(|x| x.abs()).max().unwrap_or_else(Rational::zero);
        // The exponent of a power of two within a factor of two.
        let bits = |x: &BigInt| i64::try_from(x.bits()).unwrap_or(0);
        let exponent = bits(largest.numer()) - bits(largest.denom());
        let shift = Rational::from_integer(BigInt::from(1) << exponent.unsigned_abs());
        let factor = if exponent >= 0 { shift.recip() } else { shift };
        Unit { factor, origin }
    }

    fn enter(&self, mesh: &Mesh<Rational>) -> Mesh<Rational> {
        let place = |p: &Point<Rational>| (p.clone() - &self.origin) * &self.factor;
        Mesh {
            topology: mesh.topology.clone(),
            positions: mesh.positions.iter().map(place).collect(),
        }
    }

    /// A length in the mesh's own unit, exactly.
    fn leave(&self, length: f64) -> Rational {
        Rational::from_float(length).unwrap_or_else(Rational::zero) / &self.factor
    }
}

fn written(mesh: &Mesh<Rational>) -> (Vec<[String; 3]>, Vec<Vec<u32>>) {
    let point = |p: &Point<Rational>| p.0.each_ref().map(ToString::to_string);
    let face = |f| mesh.topology.corners(f).iter().map(|v| v + 1).collect();
    (
        mesh.positions.iter().map(point).collect(),
        (0..mesh.topology.face_count()).map(face).collect(),
    )
}

fn far_step(far: Far) -> Step {
    let (side, at) = match far {
        Far::Surface { face, word, corner } => {
            ("surface-to-mesh", FarAt::Surface { face, word, corner })
        }
        Far::Mesh {
            facet,
            at: (at, scale),
        } => {
            let at = at.map(|x| Rational::ratio(x, scale).to_string());
            ("mesh-to-surface", FarAt::Mesh { facet, at })
        }
    };
    Step::Far {
        side: side.into(),
        at,
    }
}

fn cells(cover: Cover) -> Vec<NearCell> {
    let with = |with: With| match with {
        With::Match => NearBy::Plain("match".into()),
        With::Facet(i) => NearBy::Facet(i),
        With::Segment(i, ends) => {
            let [a, b] = ends.map(|end| end.map(|x| Rational::ratio(x, 4096).to_string()));
            NearBy::Segment(i, a, b)
        }
        With::Point(face, word, corner) => NearBy::Point(face as usize, word, corner),
    };
    let mut cells: Vec<Cell> = cover.cells;
    cells.sort_by(|x, y| (x.face, &x.word).cmp(&(y.face, &y.word)));
    cells
        .into_iter()
        .map(|cell| (cell.face, cell.word, with(cell.with)))
        .collect()
}

/// Not below the largest distance of a vertex to its limit, at level 0.
fn vertices(mesh: &Mesh<Rational>, request: &Request<'_>) -> Result<f64, CertifyError> {
    let request = Request {
        level: 0,
        flat: Flat::Control,
        ..*request
    };
    let setting = Setting::new(mesh, &request)?;
    let mut largest: f64 = 0.0;
    let topology = &setting.mesh.topology;
    for face in 0..topology.face_count() {
        let net = Net::of_face(&setting.mesh, face);
        let corners = net.corners();
        for (i, v) in topology.corners(face).iter().enumerate() {
            if request.boundary != Boundary::None || !topology.is_boundary_vertex(*v) {
                largest = largest.max(square(&corners[i], &net.limit(&setting.rules, i)).sup());
            }
        }
    }
    Ok(root_above(largest) * (1.0 + WIDENING))
}

/// cos(π/N) for each N that the checker needs.
fn cosines(mesh: &Mesh<Rational>, scheme: Scheme, eigen: Option<&Eigen>) -> Option<Cosines> {
    let mut needed: Vec<u32> = eigen.iter().map(|e| 4 * e.valence).collect();
    if scheme == Scheme::Loop(LoopWeights::Original) {
        let topology = &mesh.topology;
        let interior = (0..topology.vertex_count()).filter(|v| !topology.is_boundary_vertex(*v));
        needed.extend(
            interior
                .map(|v| topology.valence(v))
                .filter(|n| *n > 4 && *n != 6),
        );
    }
    needed.sort_unstable();
    needed.dedup();
    let half = Rational::ratio(1, 2);
    let enclose = |n: &u32| {
        let two_cos = enclose_two_cos(1, 2 * n, COSINE_BITS)?;
        let lo = two_cos.inf_rational() * &half;
        let hi = two_cos.sup_rational() * &half;
        Some((*n, lo.to_string(), hi.to_string()))
    };
    let all: Option<Vec<_>> = needed.iter().map(enclose).collect();
    all.filter(|all| !all.is_empty()).map(Cosines::Each)
}
