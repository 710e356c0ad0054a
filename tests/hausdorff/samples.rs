//! Brute force: dense samples of surface and mesh, all against all.

use subcert::distance::hausdorff::{Facets, Measurement, Request, measure};
use subcert::distance::model::Against;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

use super::oracle::nets::{self, Net, Random};
use super::oracle::{self, Against as OracleAgainst, Corner, Question, Scheme as OracleScheme};
use super::{SEED, SIDES, goal, of_net, quiet};

const SCHEMES: [(OracleScheme, Scheme); 4] = [
    (
        OracleScheme::LoopOriginal,
        Scheme::Loop(LoopWeights::Original),
    ),
    (OracleScheme::LoopWarren, Scheme::Loop(LoopWeights::Warren)),
    (OracleScheme::CatmullClark, Scheme::CatmullClark),
    (OracleScheme::DooSabin, Scheme::DooSabin),
];

fn distance(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// The distance from a point to a triangle: to its plane if the foot is inside, else to an edge.
fn to_triangle(p: &[f64; 3], t: &[[f64; 3]; 3]) -> f64 {
    let minus = |a: &[f64; 3], b: &[f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: &[f64; 3], b: &[f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let to_edge = |a: &[f64; 3], b: &[f64; 3]| {
        let d = minus(b, a);
        let s = (dot(&minus(p, a), &d) / dot(&d, &d)).clamp(0.0, 1.0);
        distance(p, &[a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2]])
    };
    let mut least = (0..3)
        .map(|i| to_edge(&t[i], &t[(i + 1) % 3]))
        .fold(f64::INFINITY, f64::min);
    let (u, v, w) = (minus(&t[1], &t[0]), minus(&t[2], &t[0]), minus(p, &t[0]));
    let n = [
        u[1] * v[2] - u[2] * v[1],
        u[2] * v[0] - u[0] * v[2],
        u[0] * v[1] - u[1] * v[0],
    ];
    let (uu, uv, vv, wu, wv) = (
        dot(&u, &u),
        dot(&u, &v),
        dot(&v, &v),
        dot(&w, &u),
        dot(&w, &v),
    );
    let det = uu * vv - uv * uv;
    let (s, r) = ((vv * wu - uv * wv) / det, (uu * wv - uv * wu) / det);
    if s >= 0.0 && r >= 0.0 && s + r <= 1.0 {
        least = least.min((dot(&w, &n)).abs() / dot(&n, &n).sqrt());
    }
    least
}

/// Points of one set, with a bound of how far a point of the set is from the nearest of them.
struct Cloud {
    points: Vec<[f64; 3]>,
    gap: f64,
}

/// Surface and mesh, sampled by the oracle over the same grid of parameters.
fn clouds(net: &Net, question: Question, ours: Scheme) -> [Cloud; 2] {
    let mesh = oracle::Mesh {
        points: net.points.iter().map(|p| p.map(|x| x as f64)).collect(),
        faces: net.faces.clone(),
    };
    let samples = oracle::samples(&mesh, question);
    let mut gaps = [0.0_f64; 2];
    // The first Catmull-Clark step makes the quarters, and under Doo-Sabin the samples are the corners
    // of the cells of the step before: their grids are twice as coarse.
    let step = if matches!(ours, Scheme::Loop(_)) {
        1
    } else {
        2
    };
    let key = |s: &oracle::Sample<f64>| (s.face, s.corner);
    for (i, a) in samples.iter().enumerate() {
        for b in samples[i + 1..].iter().take_while(|b| key(a) == key(b)) {
            if (0..3).all(|k| (a.at[k] - b.at[k]).abs() <= step) {
                gaps[0] = gaps[0].max(distance(&a.s, &b.s));
                gaps[1] = gaps[1].max(distance(&a.f, &b.f));
            }
        }
    }
    let [surface_gap, mesh_gap] = gaps;
    let (surface, mesh) = samples.iter().map(|s| (s.s, s.f)).unzip();
    [
        Cloud {
            points: surface,
            gap: surface_gap,
        },
        Cloud {
            points: mesh,
            gap: mesh_gap,
        },
    ]
}

/// The largest over a of the least distance to b.
fn far(a: &[[f64; 3]], b: impl Fn(&[f64; 3]) -> f64) -> f64 {
    a.iter().map(b).fold(0.0, f64::max)
}

fn nearest(points: &[[f64; 3]]) -> impl Fn(&[f64; 3]) -> f64 {
    |p| {
        points
            .iter()
            .map(|q| distance(p, q))
            .fold(f64::INFINITY, f64::min)
    }
}

/// Both sides of a net against samples. Each bound of the brute force allows for the gaps between
/// samples; on triangles the distance of a surface sample to the mesh is exact.
fn compare(net: &Net, question: Question, ours: Scheme) {
    let what = format!("{} {question:?}", net.name);
    let [surface, facets] = clouds(net, question, ours);
    let level = oracle::level_mesh(
        &oracle::Mesh {
            points: net.points.iter().map(|p| p.map(|x| x as f64)).collect(),
            faces: net.faces.clone(),
        },
        question,
    );
    let triangles: Vec<[[f64; 3]; 3]> = if matches!(ours, Scheme::Loop(_)) {
        let corner = |face: &Vec<usize>, i: usize| level.points[face[i]];
        level
            .faces
            .iter()
            .map(|f| [corner(f, 0), corner(f, 1), corner(f, 2)])
            .collect()
    } else {
        Vec::new()
    };
    let to_mesh = |p: &[f64; 3]| {
        triangles
            .iter()
            .map(|t| to_triangle(p, t))
            .fold(f64::INFINITY, f64::min)
    };
    let scale = surface
        .points
        .iter()
        .chain(&facets.points)
        .flatten()
        .fold(1.0, |m: f64, x| m.max(x.abs()));
    let noise = 1e-9 * scale;
    let mut ends = Vec::new();
    for side in SIDES {
        let request = Request {
            scheme: ours,
            corner: match question.corner {
                Corner::Sharp => CornerRule::Sharp,
                Corner::Smooth => CornerRule::Smooth,
            },
            level: question.level as u32,
            against: match question.against {
                OracleAgainst::Control => Against::Control,
                OracleAgainst::Limit => Against::Limit,
            },
            side,
            facets: Facets::Bilinear,
            goal: goal(1e-4),
        };
        let found = measure(&of_net(net), None, &request, &quiet).expect("measured");
        assert!(found.met && found.lo <= found.hi, "{what}: {found:?}");
        ends.push(found);
    }
    let forward = if triangles.is_empty() {
        let far = far(&surface.points, nearest(&facets.points));
        [far - facets.gap, far + surface.gap]
    } else {
        let far = far(&surface.points, to_mesh);
        [far, far + surface.gap]
    };
    let back = far(&facets.points, nearest(&surface.points));
    let back = [back - surface.gap, back + facets.gap];
    for (found, [least, most]) in ends.iter().zip([forward, back]) {
        assert!(
            found.hi >= least - noise,
            "{what}: {least} beyond {found:?}"
        );
        assert!(found.lo <= most + noise, "{what}: {most} below {found:?}");
    }
    let larger = |end: fn(&Measurement) -> f64| end(&ends[0]).max(end(&ends[1]));
    assert!(
        ends[2].lo <= larger(|e| e.hi) && larger(|e| e.lo) <= ends[2].hi,
        "{what}"
    );
}

fn brute_force(list: impl Iterator<Item = Net>, levels: &[usize]) -> usize {
    let mut count = 0;
    for net in list {
        for (scheme, ours) in SCHEMES {
            if !nets::applicable(&net.faces, scheme) {
                continue;
            }
            for against in [OracleAgainst::Control, OracleAgainst::Limit] {
                for &level in levels {
                    for corner in [Corner::Smooth, Corner::Sharp] {
                        if corner == Corner::Sharp && scheme == OracleScheme::DooSabin {
                            continue;
                        }
                        let question = Question {
                            scheme,
                            corner,
                            level,
                            against,
                            depth: if net.faces.len() << (2 * level) > 12 {
                                2
                            } else {
                                3
                            },
                        };
                        compare(&net, question, ours);
                        count += 1;
                    }
                }
            }
        }
    }
    count
}

#[test]
fn no_sample_is_beyond_and_samples_reach_far_enough() {
    let mut random = Random(SEED);
    let mut shapes: Vec<(&str, Vec<Vec<usize>>)> = vec![
        ("tetrahedron", nets::tetrahedron()),
        ("bipyramid", nets::bipyramid(5)),
        ("prism", nets::prism(5)),
        ("pillow", nets::pillow(5)),
        ("triangles", nets::grid(2, 3, false, false)),
        ("quads", nets::grid(3, 2, true, false)),
        ("torus", nets::grid(3, 4, false, true)),
        ("fan", nets::fan(4, false)),
        ("quad fan", nets::fan(3, true)),
    ];
    for n in [3, 7, 9] {
        shapes.push(("round", nets::round_vertex(n, 1, false).0));
        shapes.push(("quads round", nets::round_vertex(n, 1, true).0));
    }
    let list = shapes
        .into_iter()
        .map(|(name, faces)| nets::with_points(name.to_string(), faces, 99, &mut random));
    let count = brute_force(list.collect::<Vec<_>>().into_iter(), &[0, 1]);
    assert!(count > 100, "{count}");
}
