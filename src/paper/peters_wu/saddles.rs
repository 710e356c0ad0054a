//! Certificates of saddles: the distance from the surface to the control mesh from both sides, and a bound
//! of the distances of vertices to their limits.
//!
//! The surface is that over the faces whose corners are interior, so no boundary rule is used.

use crate::certificate::{Certificate, Claim};
use crate::distance::certify::{Boundary, CertifyError, Eigen, Flat, Request, certify};
use crate::distance::hausdorff::{Facets, Side};
use crate::mesh::{Mesh, Point, Topology};
use crate::paper::Enclosure;
use crate::scalar::{Rational, Ring};
use crate::scheme::{LoopWeights, Scheme};
use crate::spectrum::Rules;
use crate::spectrum::eigen_mesh::eigen_mesh;

/// Relative gap of the enclosures.
const GAP: f64 = 2e-3;

/// Valences of the eigensplines, Loop and Catmull-Clark.
const LOOP: [u32; 4] = [5, 7, 8, 12];
const CATMULL_CLARK: [u32; 2] = [5, 8];

/// A saddle with its certificate.
#[derive(Clone, Debug)]
pub struct Saddle {
    /// The scheme.
    pub scheme: Scheme,
    /// The valence of the inner vertex, or of all.
    pub valence: u32,
    /// Whether it is the grid z = i^2 - j^2.
    pub grid: bool,
    /// Its file.
    pub name: String,
    /// The proof.
    pub certificate: Certificate,
}

impl Saddle {
    /// The enclosure of the distance, and the bound of the distances of vertices, as certified.
    pub fn proved(&self) -> Option<(Enclosure, Rational)> {
        let Claim::Hausdorff(claim) = &self.certificate.claim else {
            return None;
        };
        let number = |text: &str| text.parse::<Rational>().ok();
        let distance = Enclosure::new(number(&claim.lo)?, number(&claim.hi)?);
        Some((distance, number(claim.vertex.as_ref()?)?))
    }
}

/// All saddles: the eigensplines of frequency 2 (ring radius and amplitude 1), and the grids.
///
/// # Errors
/// If a proof is not found.
pub fn all() -> Result<Vec<Saddle>, CertifyError> {
    let original = LoopWeights::Original;
    let loops = LOOP.map(|n| (Rules::Loop(original), n));
    let quads = CATMULL_CLARK.map(|n| (Rules::CatmullClark, n));
    let mut saddles = Vec::new();
    for (rules, n) in loops.into_iter().chain(quads) {
        let amplitude = <Rational as Ring>::from_integer(1);
        let Some(net) = eigen_mesh(rules, n, 2, &amplitude) else {
            continue;
        };
        let eigen = Eigen {
            valence: n,
            frequency: 2,
            amplitude,
            within: net.within,
        };
        // The format knows Loop's eigensplines only; for Catmull-Clark the rounded mesh is the example.
        let eigen = matches!(rules, Rules::Loop(_)).then_some(&eigen);
        saddles.push(saddle(scheme_of(rules), n, &net.mesh, eigen)?);
    }
    for (rules, n) in [(Rules::Loop(original), 6), (Rules::CatmullClark, 4)] {
        saddles.push(saddle(scheme_of(rules), n, &grid(rules), None)?);
    }
    Ok(saddles)
}

fn scheme_of(rules: Rules) -> Scheme {
    match rules {
        Rules::Loop(weights) => Scheme::Loop(weights),
        Rules::CatmullClark => Scheme::CatmullClark,
    }
}

fn saddle(
    scheme: Scheme,
    valence: u32,
    mesh: &Mesh<Rational>,
    eigen: Option<&Eigen>,
) -> Result<Saddle, CertifyError> {
    let request = Request {
        scheme,
        boundary: Boundary::None,
        level: 0,
        flat: Flat::Control,
        facets: match scheme {
            Scheme::Loop(_) => Facets::Triangles,
            _ => Facets::Bilinear,
        },
        side: Side::SurfaceToMesh,
        gap: GAP,
        vertices: true,
    };
    let weights = scheme.weights().map_or(String::new(), |w| format!("-{w}"));
    Ok(Saddle {
        scheme,
        valence,
        grid: matches!((scheme, valence), (Scheme::Loop(_), 6) | (_, 4)),
        name: format!("{}{weights}-saddle-n{valence:02}.json", scheme.name()),
        certificate: certify(mesh, &request, eigen)?,
    })
}

/// z = i^2 - j^2 on the grid -2..2, each square one quad or two triangles.
fn grid(rules: Rules) -> Mesh<Rational> {
    let points = (0..25).map(|k: i64| {
        let (i, j) = (k % 5 - 2, k / 5 - 2);
        Point([i, j, i * i - j * j].map(<Rational as Ring>::from_integer))
    });
    let squares = (0..16).map(|k| {
        let at = k % 4 + 5 * (k / 4);
        [at, at + 1, at + 6, at + 5]
    });
    let (arity, corners) = match rules {
        Rules::Loop(_) => (
            3,
            squares
                .flat_map(|[a, b, c, d]| [a, b, d, b, c, d])
                .collect(),
        ),
        Rules::CatmullClark => (4, squares.flatten().collect()),
    };
    Mesh {
        topology: Topology::from_uniform(25, arity, corners).expect("a grid"),
        positions: points.collect(),
    }
}
