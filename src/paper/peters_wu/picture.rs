//! Figure 5 drawn anew: the saddle of n = 8 with the facets and patches at the edge where it is farthest, and
//! the section along that edge.

use super::figure_5::{SAMPLING, Saddle, mesh};
use super::printed;
use super::redone::WEIGHTS;
use crate::mesh::Topology;
use crate::paper::{Line, Picture};
use crate::refine::{enclose_limits, enclose_refined};
use crate::scheme::{CornerRule, Scheme};

/// Refinements of the drawn surface.
const FINE: u32 = 3;

/// Angles of the oblique view, in radians: about the third axis, and downwards.
const TURN: f64 = -0.9;
const TILT: f64 = 0.45;

/// Names in the legend.
const FACETS: &str = "control polyhedron";
const SURFACE: &str = "surface";
const VERTICES: &str = "control point to its limit";
const FARTHEST: &str = "farthest point found to its foot";

/// The pictures; none if the net can't be refined.
pub fn pictures() -> Vec<Picture> {
    drawn().unwrap_or_default()
}

fn drawn() -> Option<Vec<Picture>> {
    let (n, ..) = printed::FIGURE_5;
    let control = mesh(n, 2, 1.0)?;
    let scheme = Scheme::Loop(WEIGHTS);
    let smooth = CornerRule::Smooth;
    let limits = |m: u32| {
        let (topology, points) = enclose_refined(scheme, smooth, &control, m).ok()?;
        let limits = enclose_limits(scheme, smooth, &topology, &points).ok()?;
        Some((
            topology,
            limits.positions.iter().map(|p| p.0).collect::<Vec<_>>(),
        ))
    };
    let (fine, surface) = limits(FINE)?;
    let (_, first) = limits(0)?;
    let flat: Vec<[f64; 3]> = control.positions.iter().map(|p| p.0).collect();
    let farthest = Saddle::of_mesh(&control, 0, SAMPLING)?.farthest;
    // The sectors on both sides of the edge from the centre to a_0; their first faces carry the surface.
    let faces = |sector: u32| 4 * sector..4 * sector + 4;
    let facets: Vec<u32> = faces(0).chain(faces(n - 1)).collect();
    let patches = (0..fine.face_count()).filter(|f| {
        let face = f >> (2 * FINE);
        face == 0 || face == 4 * (n - 1)
    });
    let oblique = |p: &[f64; 3]| {
        let (s, c) = TURN.sin_cos();
        let (x, y) = (c * p[0] - s * p[1], s * p[0] + c * p[1]);
        (x, p[2] * TILT.cos() + y * TILT.sin())
    };
    let ends = [[0, 0], [1, 1]].map(|[v, l]| [flat[v], first[l]]);
    let mut view = edges(&control.topology, facets, &flat, FACETS, &oblique);
    view.extend(edges(&fine, patches, &surface, SURFACE, &oblique));
    view.extend(ends.iter().map(|line| joined(VERTICES, line, &oblique)));
    view.push(joined(FARTHEST, &farthest, &oblique));
    // The plane of the ray through a_0: the surface over it lies in it, by the mirror symmetry.
    let across = |p: &[f64; 3]| (p[0], p[2]);
    let in_plane = |p: &&[f64; 3]| p[1].abs() < 1e-6 && p[0] > -1e-6;
    let mut curve: Vec<[f64; 3]> = surface.iter().filter(in_plane).copied().collect();
    curve.retain(|p| p[0] <= first[1][0] + 1e-9);
    curve.sort_by(|p, q| p[0].total_cmp(&q[0]));
    let b_0 = flat[1 + n as usize];
    let mut section = vec![
        joined(FACETS, &[flat[0], flat[1], b_0], &across),
        joined(SURFACE, &curve, &across),
    ];
    section.extend(ends.iter().map(|line| joined(VERTICES, line, &across)));
    section.push(joined(FARTHEST, &farthest, &across));
    let title = |what: &str| format!("Figure 5, n = {n}: {what}");
    Some(vec![
        Picture {
            id: "figure-5",
            title: title("facets and patches at an edge"),
            lines: view,
        },
        Picture {
            id: "figure-5-section",
            title: title("the section along that edge"),
            lines: section,
        },
    ])
}

fn joined(
    name: &'static str,
    points: &[[f64; 3]],
    place: &dyn Fn(&[f64; 3]) -> (f64, f64),
) -> Line {
    Line {
        name,
        points: points.iter().map(place).collect(),
    }
}

/// The edges of some faces, each once.
fn edges(
    topology: &Topology,
    faces: impl IntoIterator<Item = u32>,
    points: &[[f64; 3]],
    name: &'static str,
    place: &dyn Fn(&[f64; 3]) -> (f64, f64),
) -> Vec<Line> {
    let mut seen: Vec<u32> = faces
        .into_iter()
        .flat_map(|f| topology.halfedges(f))
        .map(|h| topology.edge_of(h))
        .collect();
    seen.sort_unstable();
    seen.dedup();
    let line = |edge: u32| {
        let [h, _] = topology.edge_halfedges(edge);
        let ends = [topology.origin(h), topology.target(h)];
        joined(name, &ends.map(|v| points[v as usize]), place)
    };
    seen.into_iter().map(line).collect()
}
