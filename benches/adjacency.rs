//! Faces per second from a list of corners to connectivity, and bytes per second from a file's
//! text, on one core.
#![allow(missing_docs)] // criterion's macro makes a public function

use std::fmt::Write;
use std::hint::black_box;

use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use subcert::mesh::Topology;
use subcert::mesh::io::{Format, parse};

/// Two triangles, or one quad, on each cell of an n x n torus lattice.
fn torus(n: u32, triangles: bool) -> Vec<u32> {
    let v = |i: u32, j: u32| i % n * n + j % n;
    let cells = (0..n * n).map(|k| (k / n, k % n));
    cells
        .flat_map(|(i, j)| {
            let (a, b, c, d) = (v(i, j), v(i + 1, j), v(i + 1, j + 1), v(i, j + 1));
            if triangles {
                vec![a, b, c, a, c, d]
            } else {
                vec![a, b, c, d]
            }
        })
        .collect()
}

/// Renames vertices and reorders faces by multiplication with a unit: no order is left.
fn shuffled(corners: &[u32], arity: usize, vertices: u32) -> Vec<u32> {
    const PRIME: u64 = 2_654_435_761;
    let faces = corners.len() / arity;
    let face = |f: usize| (f as u64 * PRIME % faces as u64) as usize;
    let vertex = |v: u32| (u64::from(v) * PRIME % u64::from(vertices)) as u32;
    (0..faces)
        .flat_map(|f| &corners[face(f) * arity..][..arity])
        .map(|&v| vertex(v))
        .collect()
}

fn adjacency(c: &mut Criterion) {
    let mut group = c.benchmark_group("adjacency");
    group.sample_size(10);
    for (name, n, arity) in [
        ("triangles 100k", 224, 3),
        ("triangles 2M", 1000, 3),
        ("quads 2M", 1414, 4),
    ] {
        let corners = torus(n, arity == 3);
        let vertices = n * n;
        let lists = [
            ("", corners.clone()),
            (" shuffled", shuffled(&corners, arity, vertices)),
        ];
        for (order, list) in lists {
            group.throughput(Throughput::Elements((list.len() / arity) as u64));
            group.bench_function(format!("{name}{order}"), |b| {
                b.iter_batched(
                    || list.clone(),
                    |list| Topology::from_uniform(vertices as usize, arity as u32, list).unwrap(),
                    BatchSize::LargeInput,
                );
            });
        }
    }
    group.finish();
}

fn reading(c: &mut Criterion) {
    let n = 300;
    let mut text = String::new();
    for k in 0..n * n {
        let (x, y) = (f64::from(k / n) / 7.0, f64::from(k % n) / 11.0);
        writeln!(text, "v {x:.6} {y:.6} {:.6}", (x * y).sin()).unwrap();
    }
    for f in torus(n, true).chunks(3) {
        writeln!(text, "f {} {} {}", f[0] + 1, f[1] + 1, f[2] + 1).unwrap();
    }
    let mut group = c.benchmark_group("reading");
    group.sample_size(10);
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("OBJ with connectivity", |b| {
        b.iter(|| parse(black_box(text.as_bytes()), Format::Obj, "x.obj").unwrap());
    });
    group.finish();
}

criterion_group!(benches, adjacency, reading);
criterion_main!(benches);
