//! `MovingMesh` gives the bounds of `Bounds`: other code, the same theorem.

#[path = "refinement/meshes.rs"]
mod meshes;

use meshes::Random;
use subcert::bound::Against;
use subcert::mesh::{Mesh, Point, Topology};
use subcert::predict::differences::{Bounds, LocalSteps, MovingMesh, Request};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Original);

fn placed(topology: Topology, seed: u64) -> Mesh {
    let mut random = Random(seed);
    let count = topology.vertex_count();
    Mesh {
        positions: (0..count)
            .map(|_| Point(std::array::from_fn(|_| random.signed())))
            .collect(),
        topology,
    }
}

/// The largest square counts at one face only: so each vertex in turn is moved far out.
fn moved(mesh: &Mesh, vertex: usize) -> Vec<Point<f64>> {
    let mut positions = mesh.positions.clone();
    for x in &mut positions[vertex].0 {
        *x *= 9.0;
    }
    positions
}

fn agree(name: &str, mesh: &Mesh, request: &Request, prepared: &MovingMesh<'_>) {
    let other = Bounds::new(mesh, request).expect("bounds");
    let own = prepared.bounds(&mesh.positions).expect("bounds");
    for k in [0, 1, 2, 5, 20] {
        let (a, b) = (own.at(k), other.at(k));
        assert!(
            (a - b).abs() <= 1e-14 * b || a == b,
            "{name}, {request:?}, level {k}: {a}, {b}"
        );
    }
}

fn check(name: &str, mesh: &Mesh) {
    for against in [Against::Control, Against::Limit] {
        for corner in [CornerRule::Smooth, CornerRule::Sharp] {
            let request = Request {
                scheme: LOOP,
                corner,
                against,
                local_steps: 0,
            };
            let prepared = MovingMesh::new(&mesh.topology, &request).expect("triangles");
            agree(name, mesh, &request, &prepared);
            let count = mesh.positions.len();
            for vertex in (0..count).step_by(count / 20 + 1) {
                let other = Mesh {
                    positions: moved(mesh, vertex),
                    topology: mesh.topology.clone(),
                };
                agree(name, &other, &request, &prepared);
            }
        }
    }
}

/// A disc of n triangles round a vertex.
fn fan(n: u32) -> Topology {
    let corners = (0..n).flat_map(|i| [0, 1 + i, 1 + (i + 1) % n]);
    Topology::from_uniform(n as usize + 1, 3, corners.collect()).expect("a disc")
}

#[test]
fn on_small_meshes() {
    let closed = meshes::topology(4, &meshes::tetrahedron());
    check("tetrahedron", &placed(closed, 1));
    check("grid", &placed(meshes::grid(3, 5, true), 2));
    check("torus", &placed(meshes::torus(4, 5, true), 3));
    for n in [3, 4, 5, 6, 7, 30, 100] {
        check(&format!("disc of {n}"), &placed(fan(n), n.into()));
    }
    let one = Topology::from_uniform(5, 3, vec![4, 0, 2]).expect("a face");
    check("one face, vertices without one", &placed(one, 4));
}

/// Several clusters, with rims; and clusters that end for want of room.
#[test]
fn on_large_meshes() {
    let irregular = meshes::topology(12_000, &meshes::irregular(12_000, 1));
    check("irregular", &placed(irregular, 5));
    check("grid", &placed(meshes::grid(70, 90, true), 6));
    check("disc of 4000", &placed(fan(4000), 7));
    check("disc of 6000", &placed(fan(6000), 8));
}

/// Two clusters' numbers reach 16 bits: fans of 1500 side by side have few faces and many vertices.
#[test]
fn on_many_fans() {
    let (fans, n) = (12, 1500);
    let corners = (0..fans * n).flat_map(|i| {
        let (base, i) = (i / n * (n + 1), i % n);
        [base, base + 1 + i, base + 1 + (i + 1) % n]
    });
    let topology = Topology::from_uniform((fans * (n + 1)) as usize, 3, corners.collect());
    check("fans", &placed(topology.expect("discs"), 9));
}

/// Extreme units take the other way, and scale; other requests are answered as `Bounds` answers.
#[test]
fn other_ways_agree() {
    for scale in [1e300, 1e-300, 1e-310] {
        let mut mesh = placed(meshes::torus(6, 7, true), 11);
        for p in &mut mesh.positions {
            p.0 = p.0.map(|x| x * scale);
        }
        check("a torus of another size", &mesh);
    }
    let triangles = placed(meshes::torus(6, 7, true), 12);
    let quads = placed(meshes::torus(6, 7, false), 13);
    for (mesh, scheme) in [
        (&triangles, LOOP),
        (&quads, Scheme::CatmullClark),
        (&quads, Scheme::DooSabin),
    ] {
        for local_steps in 0..=2 {
            let request = Request {
                scheme,
                corner: CornerRule::Smooth,
                against: Against::Control,
                local_steps,
            };
            let prepared = MovingMesh::new(&mesh.topology, &request).expect("a mesh");
            agree("torus", mesh, &request, &prepared);
        }
    }
}

/// Bit by bit what [`Bounds`] says of so many steps, in whatever order they are asked for.
#[test]
fn local_steps_come_in_any_order() {
    let meshes = [
        (placed(meshes::grid(6, 7, true), 16), LOOP),
        (placed(meshes::grid(6, 7, false), 17), Scheme::CatmullClark),
        (placed(meshes::grid(6, 7, false), 18), Scheme::DooSabin),
    ];
    for (mesh, scheme) in &meshes {
        let mut request = Request {
            scheme: *scheme,
            corner: CornerRule::Smooth,
            against: Against::Control,
            local_steps: 0,
        };
        let mut steps = LocalSteps::new(mesh, &request).expect("a mesh");
        for local_steps in [0, 2, 1, 0, 2] {
            request.local_steps = local_steps;
            let other = Bounds::new(mesh, &request).expect("bounds");
            let own = steps.bounds(local_steps).expect("bounds");
            for k in 0..6 {
                assert_eq!(own.at(k), other.at(k), "{request:?}, level {k}");
            }
        }
    }
}

#[test]
fn what_is_wrong_is_refused() {
    let mesh = placed(meshes::torus(6, 7, true), 14);
    let mut request = Request {
        scheme: LOOP,
        corner: CornerRule::Smooth,
        against: Against::Control,
        local_steps: 0,
    };
    let prepared = MovingMesh::new(&mesh.topology, &request).expect("triangles");
    assert!(prepared.bounds(&mesh.positions[1..]).is_err());
    let mut positions = mesh.positions.clone();
    positions[3].0[1] = f64::NAN;
    assert!(prepared.bounds(&positions).is_err());
    // A vertex without a face has a place too.
    let one = Topology::from_uniform(4, 3, vec![2, 0, 1]).expect("a face");
    let prepared = MovingMesh::new(&one, &request).expect("a triangle");
    let mut positions = placed(one.clone(), 15).positions;
    assert!(prepared.bounds(&positions).is_ok());
    positions[3].0[0] = f64::INFINITY;
    assert!(prepared.bounds(&positions).is_err());
    let quads = meshes::torus(6, 7, false);
    assert!(MovingMesh::new(&quads, &request).is_err());
    request.scheme = Scheme::CatmullClark;
    assert!(MovingMesh::new(&quads, &request).is_ok());
}
