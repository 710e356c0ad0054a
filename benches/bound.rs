//! Bound constants: one program, whole proofs. One core.
#![allow(missing_docs)] // criterion's macro makes a public function

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use subcert::bound::{Against, Constant, Family, Norm, Prover};
use subcert::lp::Rows;
use subcert::scalar::Rational;
use subcert::scheme::{LoopWeights, loop_scheme};

/// A right-hand side in the span: every second row once.
fn right_hand_side(rows: &Rows) -> (Vec<f64>, Vec<Rational>) {
    let mut t = vec![0i64; rows.size()];
    for row in rows.rows().iter().step_by(2) {
        for &(i, a) in row.terms() {
            t[i] += a;
        }
    }
    let exact = t.iter().map(|&a| Rational::from_integer(a.into()));
    (t.iter().map(|&a| a as f64).collect(), exact.collect())
}

fn programs(c: &mut Criterion) {
    let mut group = c.benchmark_group("program");
    for n in [8, 50] {
        let rows = Rows::new(
            loop_scheme::second_differences(n),
            loop_scheme::local_net_size(n),
        );
        let (float, exact) = right_hand_side(&rows);
        group.bench_with_input(BenchmarkId::new("proposed in floats", n), &n, |b, _| {
            b.iter(|| rows.propose(black_box(&float), rows.start()));
        });
        group.bench_with_input(BenchmarkId::new("exact over Q", n), &n, |b, _| {
            b.iter(|| rows.minimise(black_box(&exact), rows.start()));
        });
    }
    group.finish();
}

fn constants(c: &mut Criterion) {
    let mut group = c.benchmark_group("constant");
    group
        .sample_size(10)
        .measurement_time(Duration::from_secs(4));
    for n in [7, 50] {
        for (name, constant) in [
            ("C_0", Constant::Distance(Against::Control, 0)),
            ("C_3", Constant::Distance(Against::Control, 3)),
            ("B_3", Constant::Distance(Against::Limit, 3)),
            ("r_3", Constant::Rate(3)),
        ] {
            // A new prover each time: nothing is known beforehand.
            let prove = |family, n| Prover::new(family, n).prove(constant, 1e-6);
            group.bench_with_input(BenchmarkId::new(name, n), &n, |b, &n| {
                b.iter(|| prove(Family::Loop(LoopWeights::Original), n));
            });
            let quads = format!("{name} of Catmull-Clark");
            group.bench_with_input(BenchmarkId::new(quads, n), &n, |b, &n| {
                b.iter(|| prove(Family::CatmullClark(Norm::Second), n));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, programs, constants);
criterion_main!(benches);
