//! Least sums of absolute values: duality exactly, and a second program that knows nothing of ours.

use microlp::{ComparisonOp, OptimizationDirection, Problem};
use num_traits::{One, Signed, ToPrimitive, Zero};
use proptest::prelude::*;
use subcert::lp::{Basis, Rows, Solution};
use subcert::scalar::{Cyclotomic, Decide, Field, Rational, Ring};
use subcert::scheme::{IntegerRow, loop_scheme};

fn loop_rows(n: u32) -> Rows {
    Rows::new(
        loop_scheme::second_differences(n),
        loop_scheme::local_net_size(n),
    )
}

/// t = Σ c_l α_l, in the span whatever the c_l.
fn combination(rows: &Rows, c: &[i64]) -> Vec<Rational> {
    let mut t = vec![Rational::zero(); rows.size()];
    for (row, &weight) in rows.rows().iter().zip(c) {
        for &(i, a) in row.terms() {
            t[i] += <Rational as Ring>::from_integer(a * weight);
        }
    }
    t
}

/// Both proofs, exactly: the identity, the feasibility of the net, and that the values meet.
fn assert_proved(rows: &Rows, t: &[Rational], solution: &Solution<Rational>) {
    let mut sum = vec![Rational::zero(); rows.size()];
    for (row, x) in rows.rows().iter().zip(&solution.x) {
        for &(i, a) in row.terms() {
            sum[i] += x * <Rational as Ring>::from_integer(a);
        }
    }
    assert_eq!(sum, t, "the multipliers");
    for (l, row) in rows.rows().iter().enumerate() {
        let value: Rational = row.apply::<Rational, Rational>(&solution.y);
        assert!(
            value.abs() <= Rational::one(),
            "difference {l} of the net is {value}"
        );
    }
    let primal: Rational = solution.x.iter().map(Signed::abs).sum();
    let dual: Rational = t.iter().zip(&solution.y).map(|(a, y)| a * y).sum();
    assert_eq!(primal, solution.value);
    assert_eq!(dual, solution.value);
}

/// min Σ (p_l + m_l), Σ (p_l - m_l) α_l = t, p, m >= 0, by the library `microlp`.
fn microlp_optimum(rows: &Rows, t: &[Rational]) -> f64 {
    let mut problem = Problem::new(OptimizationDirection::Minimize);
    let mut columns = vec![Vec::new(); rows.size()];
    for row in rows.rows() {
        let plus = problem.add_var(1.0, (0.0, f64::INFINITY));
        let minus = problem.add_var(1.0, (0.0, f64::INFINITY));
        for &(i, a) in row.terms() {
            columns[i].push((plus, a as f64));
            columns[i].push((minus, -a as f64));
        }
    }
    for (column, t) in columns.iter().zip(t) {
        let t = t.to_f64().expect("a small rational");
        problem.add_constraint(column.as_slice(), ComparisonOp::Eq, t);
    }
    let outcome = problem.solve().expect("feasible and bounded");
    outcome
        .into_solution()
        .expect("no limit was set")
        .objective()
}

fn floats(t: &[Rational]) -> Vec<f64> {
    t.iter()
        .map(|t| t.to_f64().expect("a small rational"))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn optima_are_proved_from_both_sides_and_agree_with_another_program(
        n in 3u32..16,
        c in prop::collection::vec(-4i64..5, 25),
    ) {
        let rows = loop_rows(n);
        let t = combination(&rows, &c);
        let from_start = rows.minimise(&t, rows.start()).expect("in the span");
        assert_proved(&rows, &t, &from_start);
        // From a proposed basis, too.
        let (basis, scaled) = rows.propose(&floats(&t), rows.start()).expect("a proposal");
        let from_proposal = rows.minimise(&t, &basis).expect("in the span");
        assert_proved(&rows, &t, &from_proposal);
        prop_assert_eq!(&from_start.value, &from_proposal.value);
        // A proposal's net is feasible, exactly, whatever the floats did.
        let net = basis.net(&scaled);
        for row in rows.rows() {
            prop_assert!(row.apply::<Rational, Rational>(&net).abs() <= Rational::one());
        }
        let other = microlp_optimum(&rows, &t);
        let ours = from_start.value.to_f64().expect("a small rational");
        prop_assert!((ours - other).abs() <= 1e-9 * (1.0 + other), "{} against {}", ours, other);
    }
}

#[test]
fn a_functional_outside_the_span_is_refused() {
    for n in [3, 6, 7, 12] {
        let rows = loop_rows(n);
        let mut t = vec![Rational::zero(); rows.size()];
        t[0] = Rational::one(); // not 0 on constant nets
        assert!(rows.minimise(&t, rows.start()).is_none());
    }
}

#[test]
fn the_rank_is_that_of_elimination() {
    for n in 3..=24 {
        let rows = loop_rows(n);
        let size = rows.size();
        let matrix = subcert::scheme::linear::matrix_of_rows::<Rational>(rows.rows(), size);
        assert_eq!(rows.rank(), subcert::linalg::rank(&matrix), "n = {n}");
    }
}

/// Hand-made: the five arcs of a circle (rank 4). From point 3 to point 0 it is two arcs one way,
/// three the other.
#[test]
fn a_cycle_takes_its_shortest_way() {
    let arc = |a: usize, b: usize| IntegerRow::new([(a, 1), (b, -1)]);
    let rows = Rows::new(
        vec![arc(0, 1), arc(1, 2), arc(2, 3), arc(3, 4), arc(4, 0)],
        5,
    );
    assert_eq!(rows.rank(), 4);
    let integer = <Rational as Ring>::from_integer;
    let t: Vec<Rational> = [1, 0, 0, -1, 0].map(integer).to_vec();
    let best = rows.minimise(&t, rows.start()).expect("in the span");
    assert_eq!(best.value, integer(2)); // the arcs (4, 0) and (3, 4)
    assert_proved(&rows, &t, &best);
}

/// Over Q(√5): the rate of valence 5, against HW Table 1 (0.540907).
#[test]
fn optima_over_a_field_of_cosines() {
    use subcert::scheme::LoopWeights;
    let n = 5;
    let rows = loop_rows(n);
    let matrix = loop_scheme::subdivision_matrix::<Cyclotomic>(LoopWeights::Original, n).unwrap();
    let first = &rows.rows()[0];
    let t: Vec<Cyclotomic> = (0..rows.size())
        .map(|j| {
            let zero = Cyclotomic::from_integer(0);
            first.terms().iter().fold(zero, |sum, &(i, a)| {
                sum + matrix[(i, j)].clone() * Cyclotomic::from_integer(a)
            })
        })
        .collect();
    let best = rows.minimise(&t, rows.start()).expect("in the span");
    let printed = Cyclotomic::ratio(540_907, 1_000_000);
    let half_digit = Cyclotomic::ratio(1, 2_000_000);
    let difference = best.value.clone() - &printed;
    assert_eq!(
        difference.decide(&half_digit),
        Some(std::cmp::Ordering::Less)
    );
    assert_eq!(
        (-difference).decide(&half_digit),
        Some(std::cmp::Ordering::Less)
    );
    let dual = t
        .iter()
        .zip(&best.y)
        .fold(Cyclotomic::from_integer(0), |sum, (t, y)| {
            sum + t.clone() * Cyclotomic::from_rational(y)
        });
    assert_eq!(dual, best.value);
}

/// A basis rebuilt from its rows is the same map.
#[test]
fn bases_are_rebuilt_from_their_rows() {
    for n in [3, 5, 6, 12] {
        let rows = loop_rows(n);
        let t = combination(
            &rows,
            &[
                1, -2, 0, 3, 1, 1, -1, 2, 0, 1, 0, 0, 2, -1, 1, 1, 0, 0, 1, 1, 1,
            ],
        );
        let (basis, _) = rows.propose(&floats(&t), rows.start()).expect("a proposal");
        let again: Basis = rows.basis(&basis.rows()).expect("independent");
        let x = |basis: &Basis| {
            let mut x: Vec<(usize, Rational)> = basis
                .row_columns()
                .map(|(l, column)| {
                    let sum: Rational = (t.iter().zip(column))
                        .map(|(t, &a)| t * <Rational as Ring>::from_integer(a))
                        .sum();
                    (
                        l,
                        sum / <Rational as Ring>::from_integer(basis.determinant()),
                    )
                })
                .collect();
            x.sort_by_key(|(l, _)| *l);
            x
        };
        assert_eq!(x(&basis), x(&again), "n = {n}");
    }
}
