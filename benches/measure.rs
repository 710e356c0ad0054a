//! The parametric distance: faces per second in each arithmetic in one run, and whole meshes.
//!
//! Memory is reused from face to face; each whole-mesh run allocates its refinement afresh. Set
//! `RAYON_NUM_THREADS=1` for figures per core.
#![allow(missing_docs)] // criterion's macro makes a public function

use std::hint::black_box;
use std::path::PathBuf;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use subcert::distance::measure::{Measurement, Request, measure, measure_enclosing, measure_exact};
use subcert::distance::model::Against;
use subcert::distance::parametric::Goal;
use subcert::mesh::{Mesh, io};
use subcert::scalar::Rational;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

fn sample(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
        .join("examples/meshes")
        .join(name)
}

fn request(scheme: Scheme, level: u32, against: Against, face_gap: Option<f64>) -> Request {
    let goal = Goal {
        face_gap,
        ..Goal::default()
    };
    Request {
        scheme,
        corner: CornerRule::Smooth,
        level,
        against,
        goal,
    }
}

fn quiet(_: u32, _: u32) {}

/// Every face to 1e-2, in f64 with the rounding bound, in intervals, and exactly: the price of each.
fn arithmetics(c: &mut Criterion) {
    let loop_warren = Scheme::Loop(LoopWeights::Warren);
    for (name, scheme) in [
        ("valences_3_to_12.obj", loop_warren),
        ("block_with_handle.obj", Scheme::CatmullClark),
    ] {
        let mesh = io::read(sample(name)).expect("a sample").mesh;
        let exact: Mesh<Rational> = io::read_exact(sample(name)).expect("a sample").mesh;
        let request = request(scheme, 0, Against::Control, Some(1e-2));
        let mut group = c.benchmark_group(format!("arithmetic/{name}"));
        group
            .sample_size(10)
            .throughput(Throughput::Elements(u64::from(mesh.topology.face_count())));
        let check = |m: Measurement| assert!(black_box(m).met);
        group.bench_function("float", |b| {
            b.iter(|| check(measure(&mesh, &request, &quiet).expect("measured")))
        });
        group.bench_function("interval", |b| {
            b.iter(|| check(measure_enclosing(&mesh, &request, &quiet).expect("measured")));
        });
        group.bench_function("exact", |b| {
            b.iter(|| check(measure_exact(&exact, &request, &quiet).expect("measured")));
        });
        group.finish();
    }
}

/// Refined meshes: the mesh alone to 1e-6, and every face to 1e-2 as well.
fn meshes(c: &mut Criterion) {
    let cases = [
        ("bumpy_torus_tri.obj", Scheme::Loop(LoopWeights::Original)),
        ("bumpy_torus_quads.obj", Scheme::CatmullClark),
        ("bumpy_torus_quads.obj", Scheme::DooSabin),
        ("valences_3_to_12.obj", Scheme::Loop(LoopWeights::Original)),
    ];
    for (name, scheme) in cases {
        let mesh = io::read(sample(name)).expect("a sample").mesh;
        let mut group = c.benchmark_group(format!("mesh/{name}/{}", scheme.name()));
        group.sample_size(10);
        for against in [Against::Control, Against::Limit] {
            for (what, face_gap) in [("mesh", None), ("faces", Some(1e-2))] {
                let request = request(scheme, 3, against, face_gap);
                let faces = u64::from(mesh.topology.face_count()) * 64;
                group.throughput(Throughput::Elements(faces));
                group.bench_function(
                    format!("level 3, {faces} faces, {}, {what}", against.name()),
                    |b| {
                        b.iter(|| black_box(measure(&mesh, &request, &quiet).expect("measured")));
                    },
                );
            }
        }
        group.finish();
    }
}

criterion_group!(benches, arithmetics, meshes);
criterion_main!(benches);
