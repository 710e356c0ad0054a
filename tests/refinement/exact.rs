//! Exact identities of positions and limit positions.

use num_traits::{One, Zero};
use subcert::mesh::{Mesh, Point, Topology};
use subcert::refine::{
    Grid, RefineError, limit_positions, refine, refine_positions, refine_topology,
};
use subcert::scalar::{Field, Interval, Rational};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

use crate::meshes::{Random, cube, grid, tetrahedron, topology, torus, valence_two, zoo};

pub const WARREN: Scheme = Scheme::Loop(LoopWeights::Warren);
pub const SCHEMES: [Scheme; 3] = [WARREN, Scheme::CatmullClark, Scheme::DooSabin];
const CORNERS: [CornerRule; 2] = [CornerRule::Smooth, CornerRule::Sharp];

fn q(p: i64, r: i64) -> Rational {
    Rational::ratio(p, r)
}

fn point(x: i64, y: i64, z: i64) -> Point<Rational> {
    Point([q(x, 1), q(y, 1), q(z, 1)])
}

/// Small random integers as `f64`.
fn random_points(count: u32, seed: u64) -> Vec<Point<f64>> {
    let mut random = Random(seed);
    let mut coordinate = || random.below(2001) as f64 - 1000.0;
    (0..count)
        .map(|_| Point(std::array::from_fn(|_| coordinate())))
        .collect()
}

pub fn exactly(points: &[Point<f64>]) -> Vec<Point<Rational>> {
    let exact = |x: f64| Rational::from_float(x).expect("finite");
    points.iter().map(|p| Point(p.0.map(exact))).collect()
}

/// Every scheme, corner rule and mesh of the zoo that can be refined in rationals.
fn for_each_case(mut visit: impl FnMut(Scheme, CornerRule, Topology, &str)) {
    let mut visited = [0; 3];
    for (name, vertices, faces) in zoo() {
        for (kind, scheme) in SCHEMES.into_iter().enumerate() {
            for corner in CORNERS {
                let mesh = topology(vertices, &faces);
                let zeros = vec![Rational::zero(); vertices];
                match refine_positions::<Rational, Rational>(scheme, corner, &mesh, &zeros) {
                    Ok(_) => {
                        visited[kind] += 1;
                        visit(scheme, corner, mesh, &name);
                    }
                    Err(
                        RefineError::NotATriangle { .. }
                        | RefineError::Unrepresentable { .. }
                        | RefineError::CornerRule,
                    ) => {}
                    Err(other) => panic!("{name}: {other}"),
                }
            }
        }
    }
    let mesh = topology(5, &valence_two());
    visit(Scheme::CatmullClark, CornerRule::Smooth, mesh, "valence 2");
    assert!(visited.iter().all(|&count| count > 10), "{visited:?}");
}

#[test]
fn weights_sum_to_one() {
    for_each_case(|scheme, corner, mesh, name| {
        let ones = vec![Rational::one(); mesh.vertex_count() as usize];
        let all = |points: Vec<Rational>| points.iter().all(One::is_one);
        let refined = refine_positions::<Rational, _>(scheme, corner, &mesh, &ones).unwrap();
        assert!(all(refined), "{name}, {}", scheme.name());
        let limits = limit_positions::<Rational, _>(scheme, corner, &mesh, &ones).unwrap();
        assert!(all(limits), "{name}, {}", scheme.name());
    });
}

#[test]
fn weights_are_not_negative() {
    for_each_case(|scheme, corner, mesh, name| {
        let mut unit = vec![Rational::zero(); mesh.vertex_count() as usize];
        for v in 0..unit.len() {
            unit[v] = Rational::one();
            let refined = refine_positions::<Rational, _>(scheme, corner, &mesh, &unit).unwrap();
            assert!(
                refined.iter().all(|w| *w >= Rational::zero()),
                "{name}, {}",
                scheme.name()
            );
            unit[v] = Rational::zero();
        }
    });
}

#[test]
fn affine_maps_commute_with_refinement() {
    // A x + b with a shear, a reflection and a shift
    let map = |p: &Point<Rational>| {
        let [x, y, z] = &p.0;
        Point([
            x * q(2, 1) + y - q(7, 3),
            z * q(-1, 2),
            y * q(3, 1) + z + q(5, 1),
        ])
    };
    for_each_case(|scheme, corner, mesh, name| {
        let points = exactly(&random_points(mesh.vertex_count(), 1));
        let mapped: Vec<_> = points.iter().map(map).collect();
        let one = refine_positions::<Rational, _>(scheme, corner, &mesh, &points).unwrap();
        let two = refine_positions::<Rational, _>(scheme, corner, &mesh, &mapped).unwrap();
        assert_eq!(
            one.iter().map(map).collect::<Vec<_>>(),
            two,
            "{name}, {}",
            scheme.name()
        );
    });
}

/// The limit position of a vertex is the same one level on.
#[test]
fn limit_positions_persist() {
    for_each_case(|scheme, corner, topology, name| {
        let positions = exactly(&random_points(topology.vertex_count(), 2));
        let mesh = Mesh {
            topology,
            positions,
        };
        let limits = |mesh: &Mesh<Rational>| {
            limit_positions::<Rational, _>(scheme, corner, &mesh.topology, &mesh.positions).unwrap()
        };
        if scheme == Scheme::DooSabin {
            doo_sabin_limits_are_centroids(&mesh, name);
            return;
        }
        let fine = refine(scheme, corner, &mesh, 1).unwrap();
        let coarse_limits = limits(&mesh);
        assert_eq!(
            coarse_limits,
            limits(&fine)[..coarse_limits.len()],
            "{name}, {}",
            scheme.name()
        );
    });
}

/// Doo-Sabin: the limit position of an interior vertex is the centroid of its face at level 1, and
/// of that face's child at level 2.
fn doo_sabin_limits_are_centroids(mesh: &Mesh<Rational>, name: &str) {
    let (scheme, corner) = (Scheme::DooSabin, CornerRule::Smooth);
    let coarse = &mesh.topology;
    let limits = limit_positions::<Rational, _>(scheme, corner, coarse, &mesh.positions).unwrap();
    let first = refine(scheme, corner, mesh, 1).unwrap();
    let centroid = |mesh: &Mesh<Rational>, face: u32| {
        let corners = mesh.topology.corners(face);
        let sum = corners
            .iter()
            .fold(Point::zero(), |sum, &v| sum + &mesh.positions[v as usize]);
        sum * &q(1, corners.len() as i64)
    };
    let second = refine(scheme, corner, &first, 1).ok(); // not if a valence is 5, say
    let edges = (0..coarse.edge_count())
        .filter(|&e| !coarse.is_boundary_edge(e))
        .count();
    let mut face = coarse.face_count() + edges as u32;
    for v in 0..coarse.vertex_count() {
        if coarse.valence(v) == 0 || coarse.is_boundary_vertex(v) {
            continue;
        }
        assert_eq!(
            limits[v as usize],
            centroid(&first, face),
            "{name}, vertex {v}"
        );
        if let Some(second) = &second {
            assert_eq!(
                limits[v as usize],
                centroid(second, face),
                "{name}, vertex {v}"
            );
        }
        face += 1;
    }
    assert_eq!(face, first.topology.face_count());
}

/// On a regular lattice the limit of a quadratic q is q plus a constant, at every level.
#[test]
fn quadratics_are_reproduced_on_lattices() {
    let size = 10i64;
    for (scheme, triangles) in [
        (WARREN, true),
        (Scheme::CatmullClark, false),
        (Scheme::DooSabin, false),
    ] {
        for coefficients in [[1, 0, 0], [0, 1, 0], [0, 0, 1], [3, -2, 5]] {
            let form = |x: &Rational, y: &Rational| {
                let [a, b, c] = coefficients.map(|k| q(k, 1));
                a * x * x + b * x * y + c * y * y + x * q(3, 1) - y
            };
            let topology = grid(size as u32, size as u32, triangles);
            let positions = (0..=size)
                .flat_map(|i| (0..=size).map(move |j| (q(i, 1), q(j, 1))))
                .map(|(x, y)| Point([x.clone(), y.clone(), form(&x, &y)]))
                .collect();
            let mut mesh = Mesh {
                topology,
                positions,
            };
            let mut constant = None;
            for level in 0..3 {
                let limits = limit_positions::<Rational, _>(
                    scheme,
                    CornerRule::Smooth,
                    &mesh.topology,
                    &mesh.positions,
                )
                .unwrap();
                let inside = |x: &Rational| *x >= q(3, 1) && *x <= q(size - 3, 1);
                let mut seen = 0;
                for limit in limits {
                    let [x, y, z] = limit.0;
                    if inside(&x) && inside(&y) {
                        let c = z - form(&x, &y);
                        assert_eq!(
                            *constant.get_or_insert(c.clone()),
                            c,
                            "{}, {level}",
                            scheme.name()
                        );
                        seen += 1;
                    }
                }
                assert!(seen >= 16);
                mesh = refine(scheme, CornerRule::Smooth, &mesh, 1).unwrap();
            }
        }
    }
}

#[test]
fn loop_at_valence_three() {
    let positions = vec![
        point(0, 0, 0),
        point(16, 0, 0),
        point(0, 16, 0),
        point(0, 0, 16),
    ];
    let mesh = Mesh {
        topology: topology(4, &tetrahedron()),
        positions,
    };
    for scheme in [WARREN, Scheme::Loop(LoopWeights::Original)] {
        let fine = refine(scheme, CornerRule::Smooth, &mesh, 1).unwrap();
        assert_eq!(fine.positions[0], point(3, 3, 3)); // 7/16 P + 3/16 (sum)
        let limits = limit_positions::<Rational, _>(
            scheme,
            CornerRule::Smooth,
            &mesh.topology,
            &mesh.positions,
        );
        let fifth = q(16, 5);
        assert_eq!(
            limits.unwrap()[0],
            Point([fifth.clone(), fifth.clone(), fifth])
        ); // w = 1/5
    }
}

#[test]
fn catmull_clark_at_an_interior_vertex_of_valence_two() {
    // vertex 1 between 0 and 2, in the quads (0 1 2 3) and (2 1 0 4)
    let positions = vec![
        point(0, 0, 0),
        point(8, 0, 8),
        point(16, 0, 0),
        point(8, 16, 0),
        point(8, -16, 0),
    ];
    let mesh = Mesh {
        topology: topology(5, &valence_two()),
        positions,
    };
    let fine = refine(Scheme::CatmullClark, CornerRule::Smooth, &mesh, 1).unwrap();
    // face points (8, ±4, 2); vertex point 0 P + 1/4 (0 + 2) + 1/4 (f + g)
    assert_eq!(fine.positions[1], point(8, 0, 1));
}

#[test]
fn boundaries_and_corners() {
    let positions = vec![
        point(0, 0, 0),
        point(24, 0, 0),
        point(24, 24, 0),
        point(0, 24, 0),
    ];
    let mesh = Mesh {
        topology: topology(4, &vec![vec![0, 1, 2, 3]]),
        positions,
    };
    for (corner, refined, limit) in [
        (CornerRule::Smooth, point(3, 3, 0), point(4, 4, 0)),
        (CornerRule::Sharp, point(0, 0, 0), point(0, 0, 0)),
    ] {
        let fine = refine(Scheme::CatmullClark, corner, &mesh, 1).unwrap();
        assert_eq!(fine.positions[0], refined);
        assert_eq!(fine.positions[8], point(12, 12, 0));
        let limits = limit_positions::<Rational, _>(
            Scheme::CatmullClark,
            corner,
            &mesh.topology,
            &mesh.positions,
        );
        assert_eq!(limits.unwrap()[0], limit);
    }
    // Sharp pins vertices of one face only: not vertex 0 of two triangles.
    let positions = mesh.positions;
    let mesh = Mesh {
        topology: topology(4, &vec![vec![0, 1, 2], vec![0, 2, 3]]),
        positions,
    };
    let fine = refine(WARREN, CornerRule::Sharp, &mesh, 1).unwrap();
    assert_eq!(fine.positions[0], point(3, 3, 0));
    assert_eq!(fine.positions[1], point(24, 0, 0));
}

#[test]
fn doo_sabin_on_a_cube_and_on_an_open_grid() {
    let bit = |v: i64, k: i64| 16 * (v >> k & 1);
    let positions = (0..8)
        .map(|v| point(bit(v, 0), bit(v, 1), bit(v, 2)))
        .collect();
    let mesh = Mesh {
        topology: topology(8, &cube()),
        positions,
    };
    let fine = refine(Scheme::DooSabin, CornerRule::Smooth, &mesh, 1).unwrap();
    assert_eq!(
        (
            fine.topology.vertex_count(),
            fine.topology.face_count(),
            fine.topology.edge_count()
        ),
        (24, 6 + 12 + 8, 48)
    );
    // face (0 2 3 1) at vertex 0: 9/16, 3/16, 1/16, 3/16
    assert_eq!(fine.positions[0], point(4, 4, 0));

    let topology = grid(2, 2, false);
    let positions = (0..9)
        .map(|v| point(16 * (v / 3), 16 * (v % 3), 0))
        .collect();
    let fine = refine(
        Scheme::DooSabin,
        CornerRule::Smooth,
        &Mesh {
            topology,
            positions,
        },
        1,
    )
    .unwrap();
    // 4 faces, 4 interior edges, 1 interior vertex; the surface shrinks by a quarter of an edge
    assert_eq!(fine.topology.face_count(), 9);
    assert_eq!(fine.topology.arity(), Some(4));
    assert_eq!(fine.positions[0], point(4, 4, 0));

    let sharp = refine_positions::<f64, f64>(
        Scheme::DooSabin,
        CornerRule::Sharp,
        &fine.topology,
        &[0.0; 16],
    );
    assert_eq!(sharp, Err(RefineError::CornerRule));
}

#[test]
fn intervals_contain_the_exact_positions() {
    for_each_case(|scheme, corner, mesh, name| {
        let points = random_points(mesh.vertex_count(), 3);
        let third = |p: &Point<f64>| Point(p.0.map(|x| Interval::point(x) / Interval::point(3.0)));
        let boxes: Vec<_> = points.iter().map(third).collect();
        let exact: Vec<_> = exactly(&points)
            .iter()
            .map(|p| Point(p.0.clone().map(|x| x / q(3, 1))))
            .collect();
        let contained = |boxes: Vec<Point<Interval>>, exact: Vec<Point<Rational>>| {
            assert_eq!(boxes.len(), exact.len());
            boxes
                .iter()
                .zip(&exact)
                .all(|(b, x)| (0..3).all(|i| b.0[i].contains_rational(&x.0[i])))
        };
        assert!(
            contained(
                refine_positions::<Interval, _>(scheme, corner, &mesh, &boxes).unwrap(),
                refine_positions::<Rational, _>(scheme, corner, &mesh, &exact).unwrap(),
            ),
            "{name}, {}",
            scheme.name()
        );
        assert!(
            contained(
                limit_positions::<Interval, _>(scheme, corner, &mesh, &boxes).unwrap(),
                limit_positions::<Rational, _>(scheme, corner, &mesh, &exact).unwrap(),
            ),
            "{name}, {}",
            scheme.name()
        );
    });
}

#[test]
fn the_grid_is_exact_or_says_why_not() {
    let mut compared = [0; 3];
    let mut cases: Vec<_> = zoo()
        .into_iter()
        .map(|(name, v, faces)| (name, topology(v, &faces)))
        .collect();
    cases.push(("torus of triangles".into(), torus(4, 5, true)));
    cases.push(("torus of quads".into(), torus(4, 5, false)));
    cases.push(("grid".into(), grid(3, 4, false)));
    cases.push(("valence 2".into(), topology(5, &valence_two())));
    cases.push((
        "cube with octagons".into(),
        refine_topology(Scheme::DooSabin, &torus(3, 3, false)).unwrap(),
    ));
    for (name, mut mesh) in cases {
        for (kind, scheme) in SCHEMES.into_iter().enumerate() {
            let points: Vec<_> = random_points(mesh.vertex_count(), 4)
                .iter()
                .map(|p| Point(p.0.map(|x| x * 0.125)))
                .collect();
            let exact = exactly(&points);
            let start = Grid::from_points(&points).unwrap();
            assert_eq!(start.to_rationals(), exact);
            match start.refine(scheme, CornerRule::Smooth, &mesh) {
                Ok(grid) => {
                    let expected =
                        refine_positions::<Rational, _>(scheme, CornerRule::Smooth, &mesh, &exact)
                            .unwrap();
                    assert_eq!(grid.to_rationals(), expected, "{name}, {}", scheme.name());
                    compared[kind] += 1;
                }
                Err(RefineError::NotDyadic {
                    what: "valence",
                    size,
                }) => {
                    assert!(
                        (0..mesh.vertex_count()).any(|v| mesh.valence(v) == size),
                        "{name}"
                    );
                    let regular = [3, 4, 6, 8, 12, 16].contains(&size);
                    assert!(
                        !regular || size % 3 == 0 && scheme == Scheme::CatmullClark,
                        "{name}, {size}"
                    );
                }
                Err(
                    RefineError::NotDyadic {
                        what: "face size", ..
                    }
                    | RefineError::Unrepresentable {
                        what: "face size", ..
                    },
                ) => assert_ne!(mesh.arity(), Some(4), "{name}"),
                Err(RefineError::NotATriangle { .. } | RefineError::ValenceTooLow { .. }) => {}
                Err(other) => panic!("{name}: {other}"),
            }
        }
        mesh = torus(3, 3, false);
        assert!(mesh.is_closed());
    }
    assert!(compared.iter().all(|&count| count >= 3), "{compared:?}");
}

#[test]
fn the_grid_refuses_what_it_cannot_hold() {
    let mesh = torus(3, 3, true);
    let mut points = random_points(9, 5);
    points[0].0[0] = 2f64.powi(100);
    points[1].0[1] = 1.0;
    let grid = Grid::from_points(&points).unwrap(); // 2^100 takes 101 bits
    let mut grid = grid.refine(WARREN, CornerRule::Smooth, &mesh).unwrap();
    let mut fine = refine_topology(WARREN, &mesh).unwrap();
    let mut levels = 1;
    let refused = loop {
        match grid.refine(WARREN, CornerRule::Smooth, &fine) {
            Ok(next) => grid = next,
            Err(error) => break error,
        }
        fine = refine_topology(WARREN, &fine).unwrap();
        levels += 1;
    };
    assert!(
        matches!(refused, RefineError::GridOverflow { bits } if bits > 127),
        "{refused}"
    );
    assert!(levels >= 5, "{levels}");
    points[0].0[0] = f64::NAN;
    assert_eq!(
        Grid::from_points(&points),
        Err(RefineError::NotFinite { vertex: 0 })
    );
    points[0].0[0] = 2f64.powi(130);
    assert_eq!(
        Grid::from_points(&points),
        Err(RefineError::GridOverflow { bits: 131 })
    );
}
