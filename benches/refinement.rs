//! Refinement on one core, in output vertices per second.
//!
//! Each name gives the scheme, what is computed, the output size and whether memory is fresh or
//! reused. The irregular mesh is a tetrahedron with random splits, refined; its valences are not
//! dyadic, so it has no exact grid. Enclosure and plain `f64` are also timed in turns, for a ratio that
//! the rest of the machine disturbs less.

#![allow(missing_docs)] // criterion makes an undocumented function

#[path = "../tests/refinement/meshes.rs"]
mod meshes;

use std::hint::black_box;
use std::time::{Duration, Instant};

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use subcert::mesh::{Point, Topology};
use subcert::refine::grid::GridRefiner;
use subcert::refine::{
    Grid, Refiner, limit_positions, refine_positions, refine_topology, refine_topology_into,
};
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

const LOOP: Scheme = Scheme::Loop(LoopWeights::Warren);

fn points(count: u32) -> Vec<Point<f64>> {
    let mut random = meshes::Random(1);
    (0..count)
        .map(|_| {
            Point(std::array::from_fn(|_| {
                (random.signed() * 1048576.0).round() / 1048576.0
            }))
        })
        .collect()
}

fn refined(scheme: Scheme, mut mesh: Topology, levels: u32) -> Topology {
    for _ in 0..levels {
        mesh = refine_topology(scheme, &mesh).unwrap();
    }
    mesh
}

fn benches(c: &mut Criterion) {
    rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build_global()
        .unwrap();
    let torus = |triangles| meshes::torus(109, 110, triangles);
    let cc = Scheme::CatmullClark;
    one(c, "loop/torus", LOOP, refined(LOOP, torus(true), 3));
    let triangles = meshes::topology(800, &meshes::irregular(800, 1));
    one(c, "loop/irregular", LOOP, refined(LOOP, triangles, 5));
    one(c, "catmull-clark/torus", cc, refined(cc, torus(false), 3));
    let triangles = meshes::topology(520, &meshes::irregular(520, 1));
    one(c, "catmull-clark/irregular", cc, refined(cc, triangles, 5));
    one(
        c,
        "doo-sabin/torus",
        Scheme::DooSabin,
        refined(Scheme::DooSabin, torus(false), 3),
    );
}

fn one(c: &mut Criterion, name: &str, scheme: Scheme, mesh: Topology) {
    let positions = points(mesh.vertex_count());
    let smooth = CornerRule::Smooth;
    let mut fine = refine_topology(scheme, &mesh).unwrap();
    let size = fine.vertex_count();
    let mut group = c.benchmark_group(format!("{name}/{size}"));
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(2));
    group
        .warm_up_time(Duration::from_millis(500))
        .throughput(Throughput::Elements(size.into()));
    let mut refiner = Refiner::new(scheme, smooth);
    let mut out = Vec::new();

    group.bench_function("connectivity and positions, reused memory", |b| {
        b.iter(|| {
            refine_topology_into(scheme, black_box(&mesh), &mut fine).unwrap();
            refiner
                .positions_into::<f64>(&mesh, black_box(&positions), &mut out)
                .unwrap();
        });
    });
    group.bench_function("connectivity and positions, fresh memory", |b| {
        b.iter(|| {
            let fine = refine_topology(scheme, black_box(&mesh)).unwrap();
            (
                fine,
                refine_positions::<f64, _>(scheme, smooth, &mesh, black_box(&positions)).unwrap(),
            )
        });
    });
    group.bench_function("positions, reused memory", |b| {
        b.iter(|| {
            refiner
                .positions_into::<f64>(&mesh, black_box(&positions), &mut out)
                .unwrap()
        });
    });
    group.bench_function("positions, fresh memory", |b| {
        b.iter(|| {
            refine_positions::<f64, _>(scheme, smooth, &mesh, black_box(&positions)).unwrap()
        });
    });
    group.bench_function("enclosure, reused memory", |b| {
        b.iter(|| {
            refiner
                .enclose_into(&mesh, black_box(&positions), 0.0, &mut out)
                .unwrap()
        });
    });
    let ratio = ratio(
        |out| drop(refiner.clone().enclose_into(&mesh, &positions, 0.0, out)),
        |out| {
            drop(
                refiner
                    .clone()
                    .positions_into::<f64>(&mesh, &positions, out),
            )
        },
        &mut out,
    );
    println!("{name}/{size}/enclosure / plain f64, reused memory: {ratio:.2}\n");
    drop(out);
    let grid = Grid::from_points(&positions).unwrap();
    let mut exact = grid.clone();
    let mut grid_refiner = GridRefiner::new(scheme, smooth);
    if grid_refiner.refine_into(&mesh, &grid, &mut exact).is_ok() {
        group.bench_function("exact grid, reused memory", |b| {
            b.iter(|| {
                grid_refiner
                    .refine_into(&mesh, black_box(&grid), &mut exact)
                    .unwrap()
            });
        });
    }
    group.throughput(Throughput::Elements(mesh.vertex_count().into()));
    group.bench_function(
        "limit positions (of the coarse vertices), fresh memory",
        |b| {
            b.iter(|| {
                limit_positions::<f64, _>(scheme, smooth, &mesh, black_box(&positions)).unwrap()
            });
        },
    );
    group.finish();
}

/// The median time of `a` over that of `b`, run in turns.
fn ratio<T>(a: impl Fn(&mut T), b: impl Fn(&mut T), state: &mut T) -> f64 {
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..15 {
        for (work, times) in [&a as &dyn Fn(&mut T), &b].into_iter().zip(&mut times) {
            let start = Instant::now();
            work(state);
            times.push(start.elapsed().as_secs_f64());
        }
    }
    let [a, b] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    a / b
}

criterion_group!(refinement, benches);
criterion_main!(refinement);
