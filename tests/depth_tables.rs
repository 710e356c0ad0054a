//! The tables of `predict::differences` against the certificates, and its bounds against the tables.

use std::fs;
use std::path::Path;

use num_rational::BigRational;
use num_traits::ToPrimitive;
use subcert::bound::face_rate::face_rate;
use subcert::bound::value::Numbers;
use subcert::bound::{Against, Constant, Family, Norm, Prover};
use subcert::predict::differences::constants::{DEEPEST, beside, distances, tabulated};
use subcert::predict::differences::star::Vertex;
use subcert::scheme::{LoopWeights, Scheme};

const ORIGINAL: Scheme = Scheme::Loop(LoopWeights::Original);
const WARREN: Scheme = Scheme::Loop(LoopWeights::Warren);

/// The beginnings of the certificates' names.
const FAMILIES: [(Scheme, &str, &str); 4] = [
    (ORIGINAL, "loop-original", ""),
    (WARREN, "loop-warren", ""),
    (Scheme::CatmullClark, "catmull-clark", "-second"),
    (Scheme::DooSabin, "doo-sabin", ""),
];

fn ends(text: &serde_json::Value) -> f64 {
    let exact: BigRational = text.as_str().expect("a rational").parse().expect("p/q");
    exact.to_f64().expect("a number")
}

/// Each number of the tables that has a certificate lies where that says, and not far above.
#[test]
fn tables_agree_with_the_certificates() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("proofs/certificates");
    let mut compared = 0;
    for (scheme, name, norm) in FAMILIES {
        for n in 3..=50 {
            let Some(entry) = tabulated(scheme, n) else {
                continue;
            };
            for (kind, list) in [
                ("control", &entry.control),
                ("limit", &entry.limit),
                ("rate", &entry.rates),
            ] {
                for (k, &bound) in list.iter().enumerate() {
                    let file = folder.join(format!("{name}-{kind}{norm}-n{n:02}-k{k}.json"));
                    let Ok(text) = fs::read(&file) else { continue };
                    let file: serde_json::Value = serde_json::from_slice(&text).expect("JSON");
                    let [lo, hi] = ["lo", "hi"].map(|end| ends(&file["claim"][end]));
                    assert!(bound >= lo, "{name} {n} {kind} {k}: {bound} < {lo}");
                    assert!(bound <= hi * 1.002, "{name} {n} {kind} {k}: {bound} > {hi}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 1000, "{compared}");
}

/// Levels beyond the certificates, proved anew.
#[test]
fn deep_levels_of_the_tables_are_what_the_prover_proves() {
    let families = [
        (ORIGINAL, Family::Loop(LoopWeights::Original), 7, 8),
        (
            Scheme::CatmullClark,
            Family::CatmullClark(Norm::Second),
            5,
            7,
        ),
    ];
    for (scheme, family, n, k) in families {
        let mut prover = Prover::new(family, n);
        for against in [Against::Control, Against::Limit] {
            let proof = prover
                .prove(Constant::Distance(against, k), 1e-3)
                .expect("a proof");
            let all = distances(scheme, against, Vertex::Interior(n));
            assert!(
                (proof.lo..=proof.hi * 1.0001).contains(&all[k]),
                "{proof:?} {}",
                all[k]
            );
        }
    }
}

/// R(n) by exact programs.
#[test]
fn face_rates_are_those_of_the_programs() {
    for n in [3, 4, 5, 7, 8, 12, 24, 64] {
        let numbers = Numbers::of_loop(LoopWeights::Original, n);
        let rate = face_rate(&numbers).expect("a rate").rate;
        let (found, exact) = (
            beside(ORIGINAL, Vertex::Interior(n)),
            numbers.enclose(&rate),
        );
        assert!(
            found >= exact.inf() && found <= exact.sup() * 1.0001,
            "{n}: {found}"
        );
    }
}

/// All levels have a bound, which falls; what follows by the recurrence is not below what is proved directly.
#[test]
fn the_recurrence_continues_the_tables() {
    for (scheme, ..) in FAMILIES {
        for n in 3..=24 {
            let all = distances(scheme, Against::Control, Vertex::Interior(n));
            assert_eq!(all.len(), DEEPEST + 1);
            assert!(
                all.windows(2).all(|w| w[1] < w[0]),
                "{scheme:?} {n}: {all:?}"
            );
        }
    }
    // The recurrence from level 3 on, at n = 20, against the prover at level 5.
    let mut prover = Prover::new(LoopWeights::Original, 20);
    let proof = prover
        .prove(Constant::Distance(Against::Control, 5), 1e-3)
        .expect("a proof");
    let all = distances(ORIGINAL, Against::Control, Vertex::Interior(20));
    assert!(
        (proof.lo..proof.hi * 1.5).contains(&all[5]),
        "{proof:?} {}",
        all[5]
    );
}

/// Valences that no table knows: bounds of the star, next to those of the table's last valence, which hardly
/// differs.
#[test]
fn large_valences_have_bounds_like_the_last_of_the_table() {
    for scheme in [ORIGINAL, WARREN, Scheme::CatmullClark] {
        for against in [Against::Control, Against::Limit] {
            let [known, own] = [64, 65].map(|n| distances(scheme, against, Vertex::Interior(n)));
            for k in 0..=8 {
                let ratio = own[k] / known[k];
                assert!(
                    (0.99..12.0).contains(&ratio),
                    "{scheme:?} {against:?} {k}: {ratio}"
                );
            }
        }
        let huge = distances(scheme, Against::Control, Vertex::Interior(5000));
        assert!(huge[20] < 0.1, "{}", huge[20]);
    }
}
