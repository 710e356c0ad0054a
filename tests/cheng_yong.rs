//! The verdicts on Cheng & Yong, against what is derived here by other means: by hand, by closed forms, by sums of
//! magnitudes, by refining the nets of certificates.

mod verdicts;

use std::sync::LazyLock;

use num_traits::{One, Signed, Zero};
use proptest::prelude::*;
use subcert::certificate::{self, Certificate, Form, Step};
use subcert::paper::cheng_yong::norm::{Norm, Sup};
use subcert::paper::cheng_yong::setting::Setting;
use subcert::paper::cheng_yong::{depth, examine, examples, functional, printed};
use subcert::paper::{Claim, Report, Verdict};
use subcert::scalar::{Field, Rational, Ring};
use subcert::scheme::{IntegerRow, catmull_clark};

const VALENCES: [u32; 8] = [3, 4, 5, 6, 7, 8, 9, 10];

static REPORT: LazyLock<Report> = LazyLock::new(|| examine(&VALENCES, &|_, _| ()));

fn claim(id: &str) -> &'static Claim {
    REPORT.claim(id).unwrap_or_else(|| panic!("no claim {id}"))
}

fn r(p: i64, q: i64) -> Rational {
    Rational::ratio(p, q)
}

/// A cell of a table: the row whose first cells are these.
fn cell(table: &str, first: &[&str], column: usize) -> String {
    let table = REPORT.table(table).expect("a table");
    let row = table
        .rows
        .iter()
        .find(|row| row.iter().zip(first).all(|(a, b)| a == b));
    row.unwrap_or_else(|| panic!("no row {first:?}"))[column].clone()
}

#[test]
fn every_verdict_is_one_that_was_expected() {
    let expected = [
        (
            Verdict::Sharp,
            "lemma-1 lemma-2 eq-37 eq-38 eq-39 eq-40 lemma-3 eq-6 theorem-4",
        ),
        (
            Verdict::Sharp,
            "phi-0-ball phi-others-ball eq-45 eq-46 eq-50",
        ),
        (
            Verdict::True,
            "curve-identity not-at-corners categories matrix stochastic irreducible aperiodic",
        ),
        (
            Verdict::True,
            "deltas idempotent eigenvalues limit-point phi eq-13 largest-rate delta fastest",
        ),
        (
            Verdict::True,
            "eq-24 other-tiles appendix-d-dominate appendix-d-except appendix-d-similar",
        ),
        (
            Verdict::True,
            "appendix-d-first appendix-d-sign figure-6a counts ratios usually avoid-five",
        ),
        (
            Verdict::Loose,
            "lemma-5 eq-20 theorem-6 eq-26 eq-26-second eq-26-levels lemma-7 lemma-8",
        ),
        (Verdict::Loose, "theorem-9 appendix-d-second"),
        (
            Verdict::Misprint,
            "subpatches vectors eq-47 eq-48 eq-51 lemma-7-index figure-6-distances",
        ),
        (Verdict::Misprint, "figure-6c-depths"),
        (
            Verdict::Refuted,
            "theorem-4-strict eq-49 eq-52 eq-52-second appendix-d quads-faster",
        ),
    ];
    verdicts::are(&REPORT, &expected);
}

/// Against G_0 alone the differences V_1 - V_j are independent: the supremum of V_1' - V_j' is the sum of the
/// magnitudes of its coefficients at j > 1. From the masks of (9)-(12), by hand: for a face point
/// `|1/4 - b_N|·2 + |1/4 - c_N| + (N-2) b_N + (N-1) c_N`.
#[test]
fn equation_45_is_a_sum_of_magnitudes() {
    let found = &claim("eq-45").found;
    for n in [3u32, 5, 6, 7, 8, 9, 10] {
        let m = i64::from(n);
        let (b, c) = (r(3, 2 * m * m), r(1, 4 * m * m));
        let sum = (r(1, 4) - &b).abs() * r(2, 1)
            + (r(1, 4) - &c).abs()
            + r(m - 2, 1) * b.abs()
            + r(m - 1, 1) * c;
        assert_eq!(sum, printed::at(printed::RATE, n), "N = {n}");
        assert!(
            found.contains(&format!("{sum} at N = {n}")),
            "{sum}: {found}"
        );
    }
}

/// V_4' - V_1' over max(G_0, G_3), by hand for N >= 5: `d - b` at V_4, `e - b` at V_2 and V_6, `e - c` at V_3 and V_5,
/// `-b`, `-c` elsewhere: 5/8 + 7/(4N) - 10/N². G_3 does not help where it is sharp: every net with y_1 = 0, y_j = ±1
/// as the coefficients' signs has V_2 .. V_6 equal to 1 = V_4, so G_3 <= 1 with zeros beyond.
#[test]
fn equation_49_fails_by_hand() {
    for n in [5u32, 6, 7, 8, 9, 10] {
        let m = i64::from(n);
        let sum = r(5, 8) + r(7, 4 * m) - r(10, m * m);
        assert!(sum > r(9, 16), "N = {n}");
        let found = &claim("eq-49").found;
        assert!(
            found.contains(&format!("{sum} (j = 1) at N = {n}")),
            "{sum}: {found}"
        );
    }
}

/// From the float programs of an audit in another language: G^1, G^2, G^3 over G^0.
#[test]
fn first_order_rates() {
    let known = [
        ("3", ["9/16", "1555/6144", "0.10757"]),
        ("4", ["43/64", "351/1024", "2783/16384"]),
        ("5", ["39/50", "3513/8000", "0.24656"]),
        ("6", ["31/36", "151/288", "265/864"]),
        ("7", ["85/98", "61/112", "0.32633"]),
        ("8", ["111/128", "2269/4096", "0.33670"]),
    ];
    for (n, rates) in known {
        for (k, rate) in rates.iter().enumerate() {
            let found = cell("first-order", &[n], 2 + 2 * k);
            let float = |text: &str| match text.split_once('/') {
                Some((p, q)) => p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap(),
                None => text.parse().unwrap(),
            };
            assert!(
                (float(&found) - float(rate)).abs() < 1e-5,
                "N = {n}: {found}, {rate}"
            );
        }
    }
    // (19) is sharp in one step from N = 6 on.
    for n in ["6", "7", "8", "9", "10"] {
        assert_eq!(cell("first-order", &[n], 1), cell("first-order", &[n], 2));
    }
}

/// From the same audit: Z_3^1 over Z_0^0 against W of (27) and Appendix D.
#[test]
fn second_order_rates() {
    let known = [
        ("3", "2/3", "2/3"),
        ("4", "-", "1/4"),
        ("5", "19/25", "18/25"),
        ("6", "19/24", "3/4"),
        ("7", "23/28", "157/196"),
        ("8", "107/128", "3/4"),
        ("9", "91/108", "269/324"),
        ("10", "169/200", "83/100"),
    ];
    for (n, w, sup) in known {
        assert_eq!(cell("second-order", &[n], 1), w);
        assert_eq!(cell("second-order", &[n], 3), sup);
        assert_eq!(cell("second-order", &[n], 4), sup);
    }
    // By hand, N = 6: 3/4 + 2/24 - 21/72 = 13/24 < 3/4.
    assert_eq!(cell("second-order", &["6"], 2), "13/24");
}

/// Violations: the net is refined here, point by point, and violates the inequality.
#[test]
fn violations_are_violations() {
    let is_violation =
        |certificate: &Certificate| matches!(certificate.claim, certificate::Claim::Net(_));
    let violations: Vec<&(String, Certificate)> = REPORT
        .certificates
        .iter()
        .filter(|(_, certificate)| is_violation(certificate))
        .collect();
    for (name, certificate) in &violations {
        assert!(violates(certificate), "{name}");
    }
    // (49) and (52) from N = 5 on, its second part and Appendix D from 6 on, two rates of Loop's scheme.
    assert_eq!(violations.len(), 6 + 6 + 5 + 5 + 2);
    // And each is named by a claim that is refuted.
    let refuted: Vec<&String> = REPORT
        .claims
        .iter()
        .filter(|claim| claim.verdict == Verdict::Refuted)
        .flat_map(|claim| &claim.certificates)
        .collect();
    for (name, _) in violations {
        assert!(refuted.contains(&name), "{name}");
    }
}

/// The checker verifies all certificates, each is cited by a claim, and each that is cited is there.
#[test]
fn certificates_are_verified_and_cited() {
    let mut files: Vec<&String> = Vec::new();
    for (name, certificate) in &REPORT.certificates {
        assert!(name.starts_with("cheng-yong-") || name.starts_with("catmull-clark-"));
        let mut text = Vec::new();
        certificate.write(&mut text).expect("memory");
        let outcome = subcert_check::check(&text).outcome;
        assert!(outcome.is_ok(), "{name}: {outcome:?}");
        files.push(name);
    }
    let mut cited: Vec<&String> = (REPORT.claims.iter())
        .flat_map(|claim| &claim.certificates)
        .collect();
    cited.sort();
    cited.dedup();
    assert_eq!(cited, files);
    // What is sharp or loose by a supremum has a certificate of it, but for identities on curves.
    for claim in &REPORT.claims {
        let wants = matches!(claim.verdict, Verdict::Sharp | Verdict::Loose);
        assert!(
            !wants || claim.id == "lemma-1" || !claim.certificates.is_empty(),
            "{}",
            claim.id
        );
    }
}

fn violates(certificate: &Certificate) -> bool {
    let certificate::Claim::Net(claim) = &certificate.claim else {
        return false;
    };
    let [Step::Violated { net }] = &certificate.steps[..] else {
        return false;
    };
    let number = |text: &String| text.parse::<Rational>().expect("a rational");
    let net: Vec<Rational> = net.iter().map(number).collect();
    assert_eq!(net.len(), catmull_clark::local_net_size(claim.valence));
    let value = |form: &Form| {
        let Form::Points { word, terms } = form else {
            panic!("a form of points");
        };
        let points = word.chars().fold(net.clone(), |points, letter| {
            assert_eq!(letter, '0');
            catmull_clark::refine_local_net::<Rational, Rational>(claim.valence, &points)
        });
        let labels: Vec<usize> = terms.iter().map(|(label, _)| *label).collect();
        assert!(labels.is_sorted_by(|a, b| a < b));
        let terms = terms
            .iter()
            .map(|(label, a)| number(a) * &points[label - 1]);
        terms.sum::<Rational>().abs()
    };
    let left = value(&claim.left);
    let factor = number(&claim.factor);
    !claim.right.is_empty() && claim.right.iter().all(|form| left > &factor * value(form))
}

/// A sup is attained by its net, and no random net exceeds it.
#[test]
fn suprema_are_attained() {
    for n in [3, 5, 8] {
        let setting = Setting::new(n);
        for (norm, rows) in [
            (&setting.g, &setting.first[2][..]),
            (&setting.z, setting.z.rows()),
        ] {
            for t in setting.rows_of(rows, 2) {
                let Sup::Finite {
                    value,
                    net,
                    multipliers,
                } = norm.sup(&t)
                else {
                    panic!("finite");
                };
                assert_eq!(t.at(&net).abs(), value);
                let sum: Rational = multipliers.iter().map(|x| x.abs()).sum();
                assert_eq!(sum, value);
                for row in norm.rows() {
                    assert!(row.apply::<Rational, Rational>(&net).abs() <= Rational::one());
                }
            }
        }
    }
}

/// V_1 - V_2 over |V_1 - V_3| alone is unbounded; over |V_2 - V_3|, too, it is at most 2.
#[test]
fn unbounded_functionals_have_a_net() {
    let row = |a: usize, b: usize| IntegerRow::new([(a, 1), (b, -1)]);
    let t = functional::Functional::of_row(&row(0, 1), 3);
    let Sup::Unbounded { net } = Norm::new(vec![row(0, 2)], 3).sup(&t) else {
        panic!("unbounded");
    };
    assert!(net[0] == net[2] && net[0] != net[1]);
    let two = Norm::new(vec![row(0, 2), row(1, 2)], 3).sup(&t);
    assert_eq!(two.value(), Some(&r(2, 1)));
}

/// The corrected lines of Appendix C, expanded by hand in the masks: at V_3 and V_4 in (47).
#[test]
fn misprints_are_put_right() {
    for id in ["eq-47", "eq-48", "eq-51"] {
        let method = claim(id).method.as_ref().expect("a correction");
        assert!(
            method.ends_with("then it is one, with the printed bound"),
            "{method}"
        );
        assert!(claim(id).counterexample.is_some());
    }
    // (47): V_4' - V_3' has e - f = -3/16 at V_3; the print has 1/16 there.
    let net = claim("eq-47").counterexample.as_ref().expect("a net");
    assert!(
        net.what.contains("is 3/16, the regrouping 1/16"),
        "{}",
        net.what
    );
}

/// Figure 6(c) by logarithms: at G^0 = 7/85, the largest with n_ε = 1 for ε = 1/4.
#[test]
fn figure_6c_by_logarithms() {
    let delta = (98f64 / 85.0).ln();
    let n = |inverse: f64| ((3.5 * (7.0 / 85.0) * inverse).ln() / delta - 1e-9).ceil() as i64;
    let expected: Vec<i64> = [4.0, 5.0, 10.0, 100.0, 1000.0, 10000.0].map(n).to_vec();
    assert_eq!(expected, [1, 3, 8, 24, 40, 56]);
    let g0 = r(7, 85);
    for ((inverse, _), steps) in printed::FIGURE_6C.iter().zip(expected) {
        assert_eq!(depth::n_epsilon(5, &g0, &r(100, *inverse)), Some(steps));
    }
    let found = claim("figure-6c-depths");
    assert_eq!(
        found.method.as_deref(),
        Some("for ε = 1/10 at most 8, not 9")
    );
    assert!(found.found.contains("5 of the six"), "{}", found.found);
}

/// The bound of the distance is no smaller than the distance at the extraordinary corner: 5/(N+5), where all ring points
/// are at distance 1 in one direction.
#[test]
fn the_distance_bound_covers_the_corner() {
    for n in [5, 8] {
        let bound = examples::distance_bound(&Setting::new(n)).expect("a bound");
        assert!(
            bound >= r(5, i64::from(n) + 5) && bound < r(7, 2),
            "N = {n}: {bound}"
        );
    }
}

/// The alternating kernel, the regular valence, a range without what the paper speaks of.
#[test]
fn other_ranges() {
    let report = examine(&[4], &|_, _| ());
    let violated = |(_, c): &(String, Certificate)| matches!(c.claim, certificate::Claim::Net(_));
    assert!(!report.certificates.iter().any(violated));
    for id in ["lemma-5", "eq-49", "theorem-9", "fastest", "avoid-five"] {
        assert!(report.claim(id).is_none(), "{id}");
    }
    assert_eq!(
        report.claim("matrix").map(|c| c.verdict),
        Some(Verdict::True)
    );
    let report = examine(&[11, 12], &|_, _| ());
    assert_eq!(
        report.claim("lemma-5").map(|c| c.verdict),
        Some(Verdict::Loose)
    );
    assert_eq!(
        report.claim("appendix-d").map(|c| c.verdict),
        Some(Verdict::Refuted)
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// Nets do not exceed the printed bounds that hold: Lemma 5 and (26), on random integers.
    #[test]
    fn random_nets_obey_what_holds(
        n in prop::sample::select(vec![3u32, 5, 6, 7, 8, 11]),
        y in prop::collection::vec(-9i64..10, 30),
    ) {
        let size = catmull_clark::local_net_size(n);
        let net: Vec<Rational> = y[..size].iter().map(|&y| <Rational as Ring>::from_integer(y)).collect();
        let next = catmull_clark::refine_local_net::<Rational, Rational>(n, &net);
        let setting = Setting::new(n);
        let size_of = |rows: &[IntegerRow], net: &[Rational]| {
            let values = rows.iter().map(|row| row.apply::<Rational, Rational>(net).abs());
            values.max().unwrap_or_else(Rational::zero)
        };
        let (g, z) = (setting.g.rows(), setting.z.rows());
        let rate = printed::rate(n).expect("printed");
        let w = depth::w(n).expect("printed");
        prop_assert!(size_of(g, &next) <= rate * size_of(g, &net));
        prop_assert!(size_of(z, &next) <= w * size_of(z, &net));
    }
}
