//! The verdicts on Huang & Wang 2008, against what is derived here by other means: by hand, by closed
//! forms, by arithmetic on the printed tables alone.

mod verdicts;

use std::sync::LazyLock;

use proptest::prelude::*;
use subcert::bound::{Constant, Prover};
use subcert::paper::huang_wang_2008::depth::{ceil_log, steps};
use subcert::paper::huang_wang_2008::{examine, nets, printed};
use subcert::paper::{Claim, Enclosure, Report, Verdict};
use subcert::scalar::{Cyclotomic, Field, Rational, Ring};
use subcert::scheme::{LoopWeights, Tile, loop_scheme};

static REPORT: LazyLock<Report> =
    LazyLock::new(|| examine(&printed::VALENCES, &|_, _| ()).expect("rates of every valence"));

fn claim(id: &str) -> &'static Claim {
    REPORT.claim(id).unwrap_or_else(|| panic!("no claim {id}"))
}

fn rational(p: i64, q: i64) -> Rational {
    Rational::ratio(p, q)
}

/// A column of a table, by the valence in column `n`, of rows that satisfy a test.
fn column(table: &str, head: &str, n: u32, also: impl Fn(&[String]) -> bool) -> Vec<String> {
    let table = REPORT.table(table).expect("a table");
    let at = |head: &str| table.heads.iter().position(|h| *h == head).expect("a head");
    let valence = n.to_string();
    let rows = table
        .rows
        .iter()
        .filter(|row| row[at("n")] == valence && also(row));
    rows.map(|row| row[at(head)].clone()).collect()
}

#[test]
fn every_verdict_is_one_that_was_expected() {
    let expected = [
        (
            Verdict::Sharp,
            "deltas theorem-1 theorem-2 beta-of-6 table-1-r1 table-1-r2 table-1-r3 lemma-1",
        ),
        (
            Verdict::Sharp,
            "regular-rate c4-of-3 regular-depth-limit regular-depth-control",
        ),
        (
            Verdict::True,
            "matrix-t three-programs bound-function fact-1 fact-2 four-functions",
        ),
        (
            Verdict::True,
            "beta-below-half c1-largest four-programs one-program submultiplicative",
        ),
        (
            Verdict::True,
            "slower-than-regular r1-quarter c3-smallest limit-better inscribed",
        ),
        (
            Verdict::Loose,
            "theorem-3 level-bound table-3-control table-3-limit",
        ),
        (
            Verdict::Misprint,
            "table-2-beta table-2-c3 theorem-4-exponent table-3-like-for-like",
        ),
        (
            Verdict::Refuted,
            "rate-quarter lemma-1-meshes theorem-4-strict improvement improvable",
        ),
        (
            Verdict::Refuted,
            "eq-15-literal eq-15-telescoping limit-better-levels",
        ),
    ];
    verdicts::are(&REPORT, &expected);
}

/// From Table 1 alone: 0.082031 < 0.437500 / 4, whatever the last digits.
#[test]
fn the_printed_rates_of_valence_3_contradict_the_printed_inequality() {
    let [r1, r2] = [0, 1].map(|k| printed::at(&printed::TABLE_1[k], 3).unwrap().range());
    assert!(r2.hi < r1.lo / rational(4, 1));
    assert!(claim("rate-quarter").found.contains("n = 3: r_2(3)"));
    assert!(!claim("rate-quarter").found.contains("n = 4"));
}

/// The radial net has M = 1; its second differences at level 2, by refining it twice in rationals.
#[test]
fn a_net_of_valence_3_beats_r_2_on_a_subpatch() {
    let net: Vec<Rational> = nets::radial(3)
        .into_iter()
        .map(Ring::from_integer)
        .collect();
    let warren = LoopWeights::Warren; // the same at valence 3
    let extended = loop_scheme::extended_net::<Rational, Rational>(warren, 3, &net).unwrap();
    let mut largest = rational(0, 1);
    for tile in Tile::ALL {
        let points = loop_scheme::tile_net(3, tile, &extended);
        let mut local = points.to_vec();
        for (point, label) in points.iter().zip(loop_scheme::REGULAR_LABELS) {
            local[label - 1] = point.clone();
        }
        let next = loop_scheme::refine_local_net::<Rational, Rational>(warren, 6, &local).unwrap();
        for row in loop_scheme::second_differences(6) {
            let value = row.apply::<Rational, Rational>(&next);
            largest = largest.max(value.clone()).max(-value);
        }
    }
    // At least 25/256 by the program over all nets; the radial net alone exceeds 21/256 = r_2(3).
    assert!(
        largest > rational(21, 256) && largest <= rational(25, 256),
        "{largest}"
    );
    let found = &claim("lemma-1-meshes").found;
    assert!(
        found.contains("25/256") && found.contains("21/256"),
        "{found}"
    );
}

/// The net of a claim, checked by refinement.
#[test]
fn the_counterexample_to_lemma_1_for_meshes_is_one() {
    let witness = claim("lemma-1-meshes")
        .counterexample
        .as_ref()
        .expect("a net");
    assert_eq!(witness.valence, 3);
    let net: Vec<Rational> = witness
        .net
        .iter()
        .map(|y| y.parse().expect("a rational"))
        .collect();
    let one = rational(1, 1);
    for row in loop_scheme::second_differences(3) {
        let value = row.apply::<Rational, Rational>(&net);
        assert!(value <= one && -value <= one);
    }
}

/// From α_i' = 3/8 α_i + 1/8 (α_(i-1) + α_(i+1)) - b Σ α_j, whose multipliers are unique unless 6 | n:
/// r_1(n) = 3/8 + 2/8 - 3 b + (n - 3) b = 5/8 + n b (1 - 6/n) for n >= 4.
#[test]
fn redone_rates_agree_with_a_closed_form() {
    for n in [4u32, 5, 7, 8, 9, 10] {
        let nb = loop_scheme::ring_weight_sum::<Cyclotomic>(LoopWeights::Original, n).unwrap();
        let factor = Cyclotomic::ratio(i64::from(n) - 6, i64::from(n));
        let rate = Cyclotomic::ratio(5, 8) + &(nb * &factor);
        let printed = printed::at(&printed::TABLE_1[0], n).unwrap();
        let value = Enclosure::algebraic(&rate);
        assert_eq!(
            printed.compare(&value),
            Some(std::cmp::Ordering::Equal),
            "n = {n}"
        );
        let redone = column("table-1", "redone = sharp", n, |row| row[0] == "r_1");
        assert_eq!(redone, [value.decimal(6)]);
    }
}

/// C_0 in closed form, max(1/2, 8 n b / (3 + 8 n b)), and (15) by hand at n = 6.
#[test]
fn the_control_constants() {
    for n in printed::VALENCES {
        let nb = loop_scheme::ring_weight_sum::<Cyclotomic>(LoopWeights::Original, n).unwrap();
        let eight = nb * &Cyclotomic::from_integer(8);
        let vertex = eight.clone() / &(Cyclotomic::from_integer(3) + &eight);
        let half = Enclosure::exactly(rational(1, 2));
        let sharp = Enclosure::algebraic(&vertex).max(&half);
        assert_eq!(
            column("table-2-control", "sharp C_0", n, |_| true),
            [sharp.decimal(6)]
        );
    }
    // β(6) (1 + 1/4 + 1/16) / (1 - 1/64) = (1/3) (4/3); with n b = 3/8 it is 1/2.
    let at_6 = |head| column("table-2-control", head, 6, |_| true);
    assert_eq!(at_6("(15) with β(n)"), ["0.444444"]);
    assert_eq!(at_6("(15) with n b"), ["0.500000"]);
    assert!(
        claim("eq-15-literal")
            .found
            .contains("n = 6, λ = 1: C_0 = 0.500000 > 0.444444")
    );
    // Where the symbol as printed agrees with no printed value, n b does, up to the rounding of rates.
    let method = claim("table-2-c3").method.as_ref().expect("a method");
    assert!(
        method.contains("β(n) at n = none") && method.contains("Table 1 at n = 3..10"),
        "{method}"
    );
}

/// The enclosures of section 4.2 are made twice: by intervals in `paper`, and by the prover, whose
/// proof becomes a certificate.
#[test]
fn beta_by_two_programs() {
    for n in [3, 5, 7, 10] {
        let mut prover = Prover::new(LoopWeights::Original, n);
        let proof = prover.prove(Constant::Beta, 1e-8).expect("a proof");
        let theirs = Enclosure::floats(proof.lo, proof.hi).expect("finite");
        let ours = column("table-2-limit", "redone β", n, |_| true);
        assert_eq!(theirs.decimal(7), rounded(&ours[0], 7), "n = {n}");
        let verdict = &column("table-2-limit", "verdict", n, |_| true)[0];
        assert_eq!(verdict == "misprint", n == 7 || n == 10);
    }
}

/// A decimal without brackets, to fewer digits.
fn rounded(decimal: &str, digits: u32) -> String {
    let (whole, part) = decimal.split_once('.').expect("a decimal");
    let scaled: i64 = format!("{whole}{part}").parse().expect("digits");
    let power = 10i64.pow(part.len() as u32);
    Enclosure::exactly(rational(scaled, power)).decimal(digits)
}

#[test]
fn depths_of_table_3_and_the_needed_ones() {
    for (i, n) in printed::VALENCES.into_iter().enumerate() {
        let of =
            |mesh: &'static str, head| column("table-3", head, n, |row| row[0] == mesh)[0].clone();
        assert_eq!(
            of("control", "λ = 2"),
            printed::TABLE_3_CONTROL[i].to_string()
        );
        assert_eq!(of("limit", "λ = 3"), printed::TABLE_3_LIMIT[i].to_string());
        for mesh in ["control", "limit"] {
            let sharp: i64 = of(mesh, "sharp").parse().expect("a depth");
            let printed: i64 = of(mesh, "printed").parse().expect("a depth");
            // Regular parts alone need ⌈log_4 (10000 / 3)⌉ = 6 steps.
            assert!((6..=printed).contains(&sharp), "n = {n}, {mesh}: {sharp}");
        }
    }
}

/// S - F̄ of the radial net by hand: at the middle of the first edge of a regular face, where the net is
/// the quadratic |x|^2 on unit edges, S is |x|^2 + const: t (1 - t) = 1/4 below the chord.
#[test]
fn the_radial_net_is_a_quadratic() {
    let net: Vec<Rational> = nets::radial(6)
        .into_iter()
        .map(Ring::from_integer)
        .collect();
    let coefficients = nets::regular_coefficients(&net);
    // On the edge w = 0 the quartic has the coefficients 0, 1, 3, 6, 10: -t (1 - t) exactly.
    let edge = [0, 1, 3, 6, 10].map(|i| coefficients[i].clone());
    let expected = [(0, 1), (-1, 4), (-1, 3), (-1, 4), (0, 1)].map(|(p, q)| rational(p, q));
    assert_eq!(edge, expected);
}

#[test]
fn every_certificate_named_is_written() {
    let names: std::collections::BTreeSet<&String> =
        REPORT.certificates.iter().map(|(name, _)| name).collect();
    assert_eq!(names.len(), REPORT.certificates.len());
    for claim in &REPORT.claims {
        for file in &claim.certificates {
            assert!(names.contains(file), "{}: {file}", claim.id);
        }
    }
    for table in &REPORT.tables {
        for row in &table.rows {
            assert_eq!(row.len(), table.heads.len());
            let cells = row.iter().filter(|cell| cell.ends_with(".json"));
            for file in cells.flat_map(|cell| cell.split(' ')) {
                assert!(names.contains(&file.to_string()), "{}: {file}", table.id);
            }
        }
    }
}

proptest! {
    /// ⌈log_(1/r) x⌉ = l if and only if (1/r)^(l-1) < x <= (1/r)^l, in integers.
    #[test]
    fn ceilings_of_logarithms(p in 1i64..60, more in 1i64..60, a in 1i64..1_000_000, b in 1i64..1_000_000) {
        let q = p + more;
        let (r, x) = (rational(p, q), rational(a, b));
        let l = ceil_log(&Enclosure::exactly(x.clone()), &Enclosure::exactly(r)).expect("exact");
        let power = |l: i64| rational(q, p).pow(l as i32);
        prop_assert!(x <= power(l) && x > power(l - 1));
    }

    /// Exact powers are where floating point fails.
    #[test]
    fn ceilings_at_exact_powers(p in 1i64..40, more in 1i64..40, l in -12i32..25) {
        let q = p + more;
        let r = Enclosure::exactly(rational(p, q));
        let x = rational(q, p).pow(l);
        let above = &x * rational(1_000_000_001, 1_000_000_000);
        prop_assert_eq!(ceil_log(&Enclosure::exactly(x.clone()), &r), Some(i64::from(l)));
        prop_assert_eq!(ceil_log(&Enclosure::exactly(above.clone()), &r), Some(i64::from(l) + 1));
        // An enclosure that straddles the power decides nothing.
        prop_assert_eq!(ceil_log(&Enclosure::new(x, above), &r), None);
    }

    /// For exact powers of one rate, r_j = r^j, the formula is the ceiling for r itself, whatever λ.
    #[test]
    fn depths_do_not_depend_on_lambda_for_geometric_rates(
        p in 1i64..20, more in 1i64..20, a in 20i64..100_000, lambda in 1usize..5,
    ) {
        let r = rational(p, p + more);
        let rates: Vec<_> = (0..=lambda).map(|j| Enclosure::exactly(r.pow(j as i32))).collect();
        let (c, ratio) = (Enclosure::exactly(rational(1, 2)), Enclosure::exactly(rational(a, 1)));
        let one_step = ceil_log(&c.times(&ratio), &Enclosure::exactly(r.clone()));
        prop_assert_eq!(steps(&rates, &c, &ratio), one_step);
    }
}
