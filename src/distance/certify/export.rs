//! From covers and far points to a certificate.

use super::super::hausdorff::Side;
use super::facet::{root_above, square};
use super::near::{Cell, Cover, mesh_to_surface, surface_to_mesh};
use super::part::Net;
use super::setting::Setting;
use super::{Boundary, CertifyError, Far, Flat, Request, With};
use crate::certificate::{
    Certificate, Claim, Cosines, EigenLink, FarAt, HausdorffClaim, MeshData, NearBy, NearCell, Step,
};
use crate::mesh::Mesh;
use crate::scalar::cosine::enclose_two_cos;
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
    let setting = Setting::new(mesh, request)?;
    let near_mesh = match request.side {
        Side::MeshToSurface => None,
        _ => Some(surface_to_mesh(&setting, request.gap)?),
    };
    let near_surface = match request.side {
        Side::SurfaceToMesh => None,
        _ => Some(mesh_to_surface(&setting, request.gap)?),
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
        .then(|| vertices(mesh, request))
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
        lo: number(lo),
        hi: number(hi),
        vertex: vertex.map(number),
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

/// The number itself, which is dyadic.
fn number(x: f64) -> String {
    Rational::from_float(x)
        .unwrap_or_else(<Rational as num_traits::Zero>::zero)
        .to_string()
}

fn written(mesh: &Mesh<Rational>) -> (Vec<[String; 3]>, Vec<Vec<u32>>) {
    let point = |p: &crate::mesh::Point<Rational>| p.0.each_ref().map(ToString::to_string);
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
