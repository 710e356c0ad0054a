//! Hausdorff distances of whole meshes, each side, to 1e-4 of the diagonal; and mesh to mesh.
//!
//! The large meshes of the collection in `../shared/meshes` are measured if they are there. Set
//! `RAYON_NUM_THREADS` for figures per number of threads.
#![allow(missing_docs)] // criterion's macro makes a public function

use std::hint::black_box;
use std::path::PathBuf;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use subcert::distance::hausdorff::{Facets, Goal, Request, Side, measure, mesh_to_mesh};
use subcert::distance::model::Against;
use subcert::mesh::{Mesh, io};
use subcert::refine::refine;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Original);
const SIDES: [Side; 3] = [Side::SurfaceToMesh, Side::MeshToSurface, Side::Both];

fn read(folder: &str, name: &str) -> Option<Mesh> {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let path = root.join(folder).join(name);
    io::read(path).ok().map(|loaded| loaded.mesh)
}

fn own_mesh(c: &mut Criterion) {
    let cases = [
        ("examples/meshes", "bumpy_torus_tri.obj", LOOP),
        (
            "examples/meshes",
            "block_with_handle.obj",
            Scheme::CatmullClark,
        ),
        ("examples/meshes", "bumpy_torus_quads.obj", Scheme::DooSabin),
        ("../shared/meshes", "spot_tri.obj", LOOP),
        ("../shared/meshes", "spot_quads.obj", Scheme::CatmullClark),
        ("../shared/meshes", "statues_94k_tri.obj", LOOP),
    ];
    for (folder, name, scheme) in cases {
        let Some(mesh) = read(folder, name) else {
            continue;
        };
        let mut group = c.benchmark_group(format!("hausdorff/{name}/{}", scheme.name()));
        group
            .sample_size(10)
            .throughput(Throughput::Elements(u64::from(mesh.topology.face_count())));
        for side in SIDES {
            let request = Request {
                scheme,
                corner: CornerRule::Smooth,
                level: 0,
                against: Against::Control,
                side,
                facets: Facets::Bilinear,
                goal: Goal::default(),
            };
            group.bench_function(side.name(), |b| {
                b.iter(|| black_box(measure(&mesh, None, &request, &|_, _| ()).expect("measured")));
            });
        }
        group.finish();
    }
}

fn two_meshes(c: &mut Criterion) {
    let mesh = read("examples/meshes", "bumpy_torus_tri.obj").expect("a sample");
    let fine = refine(LOOP, CornerRule::Smooth, &mesh, 2).expect("refined");
    let mut group = c.benchmark_group("hausdorff/meshes");
    group.sample_size(10);
    for side in SIDES {
        group.bench_function(side.name(), |b| {
            b.iter(|| {
                let found = mesh_to_mesh(
                    &fine,
                    &mesh,
                    side,
                    Facets::Bilinear,
                    Goal::default(),
                    &|_, _| (),
                );
                black_box(found.expect("measured"))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, own_mesh, two_meshes);
criterion_main!(benches);
