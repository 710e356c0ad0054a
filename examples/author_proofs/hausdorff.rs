//! Certificates of Hausdorff distances: saddles that fool the vertex heuristic, and small closed meshes.

use std::error::Error;
use std::fs;
use std::path::Path;

use subcert::certificate::Certificate;
use subcert::distance::certify::{Boundary, Eigen, Flat, Request, certify};
use subcert::distance::hausdorff::{Facets, Side};
use subcert::mesh::{Mesh, Point, Topology};
use subcert::scalar::{Field, Rational, Ring};
use subcert::scheme::{LoopWeights, Scheme};
use subcert::spectrum::Rules;
use subcert::spectrum::eigen_mesh::eigen_mesh;

/// The name of a file, and what is in it.
type Named = (String, Certificate);

/// Relative gap of the saddles.
const GAP: f64 = 2e-3;

/// Writes all of them.
pub fn write_all(folder: &Path) -> Result<(), Box<dyn Error>> {
    for (name, certificate) in all()? {
        fs::write(folder.join(name), super::text(&certificate)?)?;
    }
    Ok(())
}

/// All of them.
pub fn all() -> Result<Vec<Named>, Box<dyn Error>> {
    let mut files = saddles()?;
    files.extend(grids()?);
    files.extend(closed()?);
    Ok(files)
}

/// The largest distance of the surface over the inner faces to the whole control mesh, and of vertices
/// to their limits.
fn of_saddle(scheme: Scheme) -> Request<'static> {
    let facets = match scheme {
        Scheme::Loop(_) => Facets::Triangles,
        _ => Facets::Bilinear,
    };
    Request {
        scheme,
        boundary: Boundary::None,
        level: 0,
        flat: Flat::Control,
        facets,
        side: Side::SurfaceToMesh,
        gap: GAP,
        vertices: true,
    }
}

/// The eigensplines of frequency 2: PW, Figure 5 (n = 8), and other valences.
fn saddles() -> Result<Vec<Named>, Box<dyn Error>> {
    let (original, amplitude) = (LoopWeights::Original, Rational::from_integer(1.into()));
    let mut files = Vec::new();
    for n in [5, 7, 8, 12] {
        let net = eigen_mesh(Rules::Loop(original), n, 2, &amplitude).ok_or("no such mode")?;
        let eigen = Eigen {
            valence: n,
            frequency: 2,
            amplitude: amplitude.clone(),
            within: net.within,
        };
        let proof = certify(&net.mesh, &of_saddle(Scheme::Loop(original)), Some(&eigen))?;
        files.push((format!("loop-original-saddle-n{n:02}.json"), proof));
    }
    for n in [5, 8] {
        let net = eigen_mesh(Rules::CatmullClark, n, 2, &amplitude).ok_or("no such mode")?;
        let proof = certify(&net.mesh, &of_saddle(Scheme::CatmullClark), None)?;
        files.push((format!("catmull-clark-saddle-n{n:02}.json"), proof));
    }
    Ok(files)
}

/// z = i^2 - j^2 on regular grids: every inner vertex is its own limit.
fn grids() -> Result<Vec<Named>, Box<dyn Error>> {
    let quads = |i: u32, j: u32| vec![[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
    let triangles = |i: u32, j: u32| {
        let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        vec![a, b, d, b, c, d]
    };
    let loop_scheme = Scheme::Loop(LoopWeights::Original);
    let loop_grid = grid(3, triangles);
    let quad_grid = grid(4, quads);
    Ok(vec![
        (
            "loop-original-saddle-n06.json".into(),
            certify(&loop_grid, &of_saddle(loop_scheme), None)?,
        ),
        (
            "catmull-clark-saddle-n04.json".into(),
            certify(&quad_grid, &of_saddle(Scheme::CatmullClark), None)?,
        ),
    ])
}

/// The grid -2..2 with the given faces of each square.
fn grid(arity: u32, faces: impl Fn(u32, u32) -> Vec<[u32; 2]>) -> Mesh<Rational> {
    let points = (0..25).map(|k: i64| {
        let (i, j) = (k % 5 - 2, k / 5 - 2);
        Point([i, j, i * i - j * j].map(<Rational as Ring>::from_integer))
    });
    let squares = (0..16).flat_map(|k| faces(k % 4, k / 4));
    let corners = squares.map(|[i, j]| 5 * j + i).collect();
    Mesh {
        topology: Topology::from_uniform(25, arity, corners).expect("a grid"),
        positions: points.collect(),
    }
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
