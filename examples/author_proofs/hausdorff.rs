//! Certificates of Hausdorff distances: saddles that fool the vertex heuristic, and small closed meshes.

use std::error::Error;
use std::fs;
use std::path::Path;

use subcert::certificate::Certificate;
use subcert::distance::certify::{Boundary, Flat, Request, certify};
use subcert::distance::hausdorff::{Facets, Side};
use subcert::mesh::{Mesh, Point, Topology};
use subcert::paper::peters_wu::saddles;
use subcert::scalar::{Field, Rational};
use subcert::scheme::{LoopWeights, Scheme};

/// The name of a file, and what is in it.
type Named = (String, Certificate);

/// Writes all of them.
pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    for (name, certificate) in all()? {
        fs::write(folder.join(name), super::text(&certificate)?)?;
    }
    Ok(())
}

/// All of them.
pub fn all() -> Result<Vec<Named>, Box<dyn Error>> {
    let saddles = saddles::all()?.into_iter();
    let mut files: Vec<Named> = saddles.map(|s| (s.name, s.certificate)).collect();
    files.extend(closed()?);
    Ok(files)
}

/// Small closed meshes, both sides, both kinds of facets, a level, a limit mesh, another mesh.
fn closed() -> Result<Vec<Named>, Box<dyn Error>> {
    let octahedron = closed_mesh(
        3,
        &[
            [2, 0, 0],
            [0, 3, 0],
            [-2, 0, 0],
            [0, -3, 0],
            [0, 0, 4],
            [0, 0, -4],
        ],
        &[
            0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5,
        ],
    );
    let corners: Vec<[i64; 3]> = (0..8)
        .map(|k| [1, 2, 4].map(|b| if k & b > 0 { 1 } else { -1 }))
        .collect();
    let cube = closed_mesh(
        4,
        &corners,
        &[
            0, 2, 3, 1, 4, 5, 7, 6, 0, 1, 5, 4, 2, 6, 7, 3, 0, 4, 6, 2, 1, 3, 7, 5,
        ],
    );
    let request = |scheme, side, facets| Request {
        scheme,
        boundary: Boundary::Smooth,
        level: 0,
        flat: Flat::Control,
        facets,
        side,
        gap: 0.02,
        vertices: false,
    };
    let (warren, original) = (
        Scheme::Loop(LoopWeights::Warren),
        Scheme::Loop(LoopWeights::Original),
    );
    let mut files = Vec::new();
    let mut add = |name: &str, mesh: &Mesh<Rational>, request: Request<'_>| {
        certify(mesh, &request, None)
            .map(|proof| files.push((format!("hausdorff-{name}.json"), proof)))
    };
    let both = request(original, Side::Both, Facets::Triangles);
    add("loop-octahedron-both", &octahedron, both)?;
    add(
        "loop-octahedron-level-1",
        &octahedron,
        Request {
            level: 1,
            side: Side::SurfaceToMesh,
            ..both
        },
    )?;
    let limit = Request {
        flat: Flat::Limit,
        ..request(warren, Side::SurfaceToMesh, Facets::Triangles)
    };
    add("loop-octahedron-limit", &octahedron, limit)?;
    let other = Request {
        flat: Flat::Other(&cube),
        ..both
    };
    add(
        "loop-octahedron-cube",
        &octahedron,
        Request { gap: 0.05, ..other },
    )?;
    let quads = request(Scheme::CatmullClark, Side::Both, Facets::Bilinear);
    add("catmull-clark-cube-both", &cube, quads)?;
    let cut = Request {
        facets: Facets::Triangles,
        side: Side::SurfaceToMesh,
        ..quads
    };
    add("catmull-clark-cube-triangles", &cube, cut)?;
    Ok(files)
}

fn closed_mesh(arity: u32, points: &[[i64; 3]], corners: &[u32]) -> Mesh<Rational> {
    let exact = |p: &[i64; 3]| Point(p.map(|x| Rational::ratio(x, 1)));
    Mesh {
        topology: Topology::from_uniform(points.len(), arity, corners.to_vec()).expect("a mesh"),
        positions: points.iter().map(exact).collect(),
    }
}
