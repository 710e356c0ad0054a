//! Bounds of all levels on one core, in faces per second, adjacency ready.
//!
//! The mesh is an irregular one of many valences, or the file named by `SUBCERT_BENCH_MESH`; it is taken as it
//! is, and refined once and twice. `table` uses constants alone, `prepared` the same for a connectivity that
//! has been prepared, `local step` the differences after one step; refinement with connectivity of the same mesh
//! stands beside, for ratios.

#![allow(missing_docs)] // criterion makes an undocumented function

#[path = "../tests/refinement/meshes.rs"]
mod meshes;

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use subcert::bound::Against;
use subcert::mesh::{Mesh, Point, io};
use subcert::predict::differences::{Bounds, MovingMesh, Request};
use subcert::refine::{Refiner, refine, refine_topology_into};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const SCHEME: Scheme = Scheme::Loop(LoopWeights::Original);

fn mesh() -> Mesh {
    if let Some(path) = std::env::var_os("SUBCERT_BENCH_MESH") {
        return io::read(std::path::Path::new(&path)).expect("a mesh").mesh;
    }
    let topology = meshes::topology(12_000, &meshes::irregular(12_000, 1));
    let mut random = meshes::Random(1);
    let count = topology.vertex_count();
    let positions = (0..count).map(|_| Point(std::array::from_fn(|_| random.signed())));
    Mesh {
        positions: positions.collect(),
        topology,
    }
}

fn benches(c: &mut Criterion) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .expect("one thread");
    let mut mesh = mesh();
    for _ in 0..3 {
        one(c, &mesh);
        mesh = refine(SCHEME, CornerRule::Smooth, &mesh, 1).expect("a refined mesh");
    }
}

fn one(c: &mut Criterion, mesh: &Mesh) {
    let faces = mesh.topology.face_count();
    let mut group = c.benchmark_group(format!("loop/{faces}"));
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(2))
        .warm_up_time(Duration::from_millis(500))
        .throughput(Throughput::Elements(faces.into()));
    for (name, local_steps) in [("table", 0), ("table and a local step", 1)] {
        let request = Request {
            scheme: SCHEME,
            corner: CornerRule::Smooth,
            against: Against::Control,
            local_steps,
        };
        group.bench_function(name, |b| {
            b.iter(|| {
                Bounds::new(black_box(mesh), &request)
                    .expect("bounds")
                    .at(3)
            });
        });
    }
    let request = Request {
        scheme: SCHEME,
        corner: CornerRule::Smooth,
        against: Against::Control,
        local_steps: 0,
    };
    let prepared = MovingMesh::new(&mesh.topology, &request).expect("a mesh of triangles");
    let bytes = prepared.bytes() as f64 / f64::from(faces);
    println!("prepared: {bytes:.1} bytes for each face");
    group.bench_function("table, prepared", |b| {
        b.iter(|| {
            prepared
                .bounds(black_box(&mesh.positions))
                .expect("bounds")
                .at(3)
        });
    });
    group.bench_function("to prepare", |b| {
        b.iter(|| MovingMesh::new(black_box(&mesh.topology), &request).expect("a mesh"));
    });
    let mut refiner = Refiner::new(SCHEME, CornerRule::Smooth);
    let mut fine = subcert::refine::refine_topology(SCHEME, &mesh.topology).expect("a mesh");
    let mut out = Vec::new();
    group.bench_function("refinement with connectivity", |b| {
        b.iter(|| {
            refine_topology_into(SCHEME, black_box(&mesh.topology), &mut fine).expect("a mesh");
            let found = refiner.positions_into::<f64>(&mesh.topology, &mesh.positions, &mut out);
            found.expect("positions");
        });
    });
    group.finish();
}

criterion_group!(all, benches);
criterion_main!(all);
