//! Claims about the distances of eigensplines, as a search in floating point proposes them.

use serde_json::{Value, json};
use subcert_check::check;

#[path = "support/cosine.rs"]
mod cosine;
#[path = "support/proposal.rs"]
mod proposal;
#[path = "support/web.rs"]
mod web;

use proposal::{Case, Name, propose};

const SLACK: f64 = 1e-5;
const DEPTH: usize = 24;

fn names(n: usize) -> Vec<Name> {
    let others =
        [Name("ray", Some(0)), Name("ray", None), Name("between", None), Name("ring", Some(0))];
    others.into_iter().chain((2..=n / 2).map(|k| Name("ring", Some(k)))).collect()
}

/// "verified", or the name of the rule that rejects and the step.
fn verdict(file: &Value) -> (&'static str, Option<usize>) {
    match check(file.to_string().as_bytes()).outcome {
        Ok(()) => ("verified", None),
        Err(rejection) => (rejection.rule.name(), rejection.step),
    }
}

fn with(file: &Value, pointer: &str, value: Value) -> Value {
    let mut file = file.clone();
    *file.pointer_mut(pointer).unwrap_or_else(|| panic!("{pointer}")) = value;
    file
}

/// The number at the pointer times p/q.
fn scaled(file: &Value, pointer: &str, p: i64, q: i64) -> Value {
    let number: num_rational::BigRational =
        file.pointer(pointer).unwrap().as_str().unwrap().parse().unwrap();
    let number = number * num_rational::BigRational::new(p.into(), q.into());
    with(file, pointer, json!(number.to_string()))
}

#[test]
fn proposals_are_verified() {
    for n in [3, 4, 5, 6, 8] {
        for against in ["control", "limit"] {
            for weights in ["original", "warren"] {
                if weights == "warren" && (n == 3 || n == 6) {
                    continue;
                }
                let case = Case { n, weights, against, levels: if n == 8 { 2 } else { 3 } };
                let mut names = names(n);
                if weights == "warren" {
                    names.retain(|name| *name == Name("ring", Some(0)));
                }
                let (file, _) = propose(&case, &names, SLACK, DEPTH);
                let verdict = check(file.to_string().as_bytes());
                assert!(verdict.outcome.is_ok(), "{n} {against} {weights}: {:?}", verdict.outcome);
            }
        }
    }
}

/// Values of another program, in floating point, that knew neither this one nor the format; n = 6, k = 2: `e = conj(z)^2`
/// on the lattice of edges of length 1, so that `e - E` at the middle of an edge (a, b) is `(a - b)^2 / 4` in magnitude.
#[test]
fn distances_are_those_of_another_program() {
    for (n, against, name, distances) in [
        (3, "control", Name("ring", Some(0)), [1.958333, 0.4895833, 0.1223958]),
        (3, "limit", Name("ring", Some(0)), [0.984375, 0.2176423, 0.06544909]),
        (4, "control", Name("ring", Some(0)), [11.64931, 3.025716, 0.7675971]),
        (4, "limit", Name("ray", None), [0.04123264, 0.01548198, 0.005185397]),
        (5, "control", Name("between", None), [0.1666667, 0.04299222, 0.0109112]),
        (5, "limit", Name("ring", Some(2)), [0.4163389, 0.1088038, 0.02963017]),
        (6, "control", Name("ring", Some(2)), [0.25, 0.0625, 0.015625]),
        (8, "control", Name("ring", Some(2)), [0.2023137, 0.07586764, 0.02845036]),
        (8, "limit", Name("ring", Some(4)), [0.4325276, 0.1507157, 0.04365047]),
    ] {
        let case = Case { n, weights: "original", against, levels: 3 };
        let mut list = vec![Name("ray", Some(0)), name];
        list.retain(|other| n == 3 || *other == name);
        let (file, found) = propose(&case, &list, SLACK, DEPTH);
        assert_eq!(verdict(&file).0, "verified", "{n} {name:?}");
        // At n = 3 the chain makes the enclosure wider than the search's value.
        let slack = if n == 3 { 0.2 } else { 1e-4 };
        for (m, distance) in distances.into_iter().enumerate() {
            let pointer = format!("/claim/modes/{}/distances/{m}", list.len() - 1);
            let ends = [0, 1].map(|i| {
                let text = file.pointer(&pointer).unwrap()[i].as_str().unwrap().to_string();
                let (p, q) = text.split_once('/').unwrap_or((&text, "1"));
                p.parse::<f64>().unwrap() / q.parse::<f64>().unwrap()
            });
            assert!(
                ends[0] <= distance * (1.0 + 1e-5) && distance <= ends[1] * (1.0 + 1e-5),
                "{n} {name:?} {m}"
            );
            assert!(ends[1] - ends[0] < slack * distance, "{n} {name:?} {m}: {ends:?}");
            assert!((found[list.len() - 1][m] - distance).abs() < 1e-5 * distance);
        }
    }
}

#[test]
fn what_is_changed_is_rejected() {
    let case = Case { n: 5, weights: "original", against: "control", levels: 3 };
    let list = [Name("ray", None), Name("between", None), Name("ring", Some(2))];
    let (good, _) = propose(&case, &list, SLACK, DEPTH);
    assert_eq!(verdict(&good).0, "verified");
    for i in 0..3 {
        for s in 0..3 {
            let ring = format!("/steps/{i}/rings/{s}");
            let less = scaled(&good, &format!("{ring}/hi"), 9999, 10000);
            assert_eq!(verdict(&less), ("rings", Some(i)), "{ring}");
            // Above what is reached, but below hi.
            let more = scaled(&good, &format!("{ring}/lo"), 100_001, 100_000);
            assert_eq!(verdict(&more), ("rings", Some(i)), "{ring}");
            let other = with(&good, &format!("{ring}/at/point"), json!(["1/5", "1/7"]));
            assert_eq!(verdict(&other), ("rings", Some(i)), "{ring}");
            let claim = format!("/claim/modes/{i}/distances/{s}");
            let less = scaled(&good, &format!("{claim}/1"), 999_995, 1_000_000);
            assert_eq!(verdict(&less), ("rings", Some(i)), "{claim}");
            let more = scaled(&good, &format!("{claim}/0"), 1_000_003, 1_000_000);
            assert_eq!(verdict(&more), ("rings", Some(i)), "{claim}");
        }
        let near = format!("/steps/{i}/near");
        let less = scaled(&good, &format!("{near}/hi"), 9999, 10000);
        assert_eq!(verdict(&less), ("rings", Some(i)), "{near}");
        let more = scaled(&good, &format!("{near}/lo"), 100_001, 100_000);
        assert_eq!(verdict(&more), ("rings", Some(i)), "{near}");
        assert_eq!(verdict(&with(&good, &format!("{near}/at"), Value::Null)), ("rings", Some(i)));
        // Of the splines without frequency nothing is larger than the tail.
        let shallow = verdict(&with(&good, &format!("{near}/depth"), json!(0)));
        assert_eq!(shallow, if i < 2 { ("verified", None) } else { ("rings", Some(i)) });
        for ring in [0, 61] {
            let other = with(&good, &format!("{near}/at/ring"), json!(ring));
            assert_eq!(verdict(&other), ("rings", Some(i)), "{near}");
        }
    }
    for (pointer, value, rule, step) in [
        // Another sector: beside the ray's, and at the other side of `between`; none at all.
        ("/steps/0/rings/0/at/sector", json!(1), "rings", Some(0)),
        ("/steps/1/rings/0/at/sector", json!(2), "rings", Some(1)),
        ("/steps/2/rings/0/at/sector", json!(5), "rings", Some(2)),
        ("/steps/2/rings/1/at/triangle", json!([0, 0, 0]), "rings", Some(2)),
        ("/steps/2/rings/1/at/triangle", json!([2, 0, 0]), "rings", Some(2)),
        ("/steps/2/rings/1/at/triangle", json!([1, 0, 2]), "rings", Some(2)),
        ("/steps/2/rings/1/at/triangle", json!([i64::MAX, i64::MAX, 0]), "rings", Some(2)),
        ("/steps/2/rings/1/at/point", json!(["1", "1"]), "rings", Some(2)),
        ("/steps/2/rings/1/at/point", json!(["-1/9", "1/2"]), "rings", Some(2)),
        ("/steps/2/near/depth", json!(61), "format", None),
        ("/steps/2/near/lo", json!("-1"), "rings", Some(2)),
        ("/steps/2/near/hi", json!("0"), "rings", Some(2)),
        // Its square is large enough.
        ("/steps/2/rings/2/hi", json!("-1"), "rings", Some(2)),
        ("/steps/2/rings", json!([]), "rings", Some(2)),
        ("/claim/modes/2/frequency", json!(0), "rings", Some(2)),
        ("/claim/modes/2/frequency", json!(1), "rings", Some(2)),
        ("/claim/modes/2/frequency", json!(3), "format", None),
        ("/claim/modes/2/frequency", json!(null), "format", None),
        ("/claim/modes/1/frequency", json!(0), "format", None),
        ("/claim/modes/0/family", json!("between"), "format", None),
        ("/claim/modes/0/family", json!("star"), "format", None),
        ("/claim/modes/0/distances/0/0", json!("-1"), "claim", None),
        ("/claim/modes/0/distances/0/1", json!("0"), "claim", None),
        ("/claim/against", json!("limit"), "rings", Some(0)),
        ("/claim/valence", json!(6), "cosine", None),
        ("/cosine", json!(null), "cosine", None),
        ("/cosine", json!(["1/2", "1"]), "embedding", None),
        ("/bases", json!([[1]]), "bases", None),
        ("/steps/0", json!({"rule": "sign"}), "format", None),
        ("/steps", json!([]), "format", None),
    ] {
        let found = verdict(&with(&good, pointer, value.clone()));
        assert_eq!(found, (rule, step), "{pointer} {value}");
    }
    // Any sector will do where all have the same magnitudes.
    assert_eq!(verdict(&with(&good, "/steps/2/rings/0/at/sector", json!(4))).0, "verified");
    let claim = check(good.to_string().as_bytes()).claim.unwrap();
    for words in
        ["Loop, original weights, valence 5", "control meshes", "ray from", "ring 2 from 0.49255"]
    {
        assert!(claim.contains(words), "{claim}");
    }
}

#[test]
fn a_generalised_mode_needs_the_other() {
    let case = Case { n: 3, weights: "warren", against: "control", levels: 3 };
    let list = [Name("ray", Some(0)), Name("ring", Some(0))];
    let (good, _) = propose(&case, &list, SLACK, DEPTH);
    assert_eq!(verdict(&good).0, "verified");
    // Alone, in the other order, with fewer levels of the other.
    let alone = |i: usize| {
        let file = with(&good, "/claim/modes", json!([good["claim"]["modes"][i]]));
        with(&file, "/steps", json!([good["steps"][i]]))
    };
    assert_eq!(verdict(&alone(0)).0, "verified");
    assert_eq!(verdict(&alone(1)), ("rings", Some(0)));
    let mut turned = good.clone();
    turned["claim"]["modes"].as_array_mut().unwrap().reverse();
    turned["steps"].as_array_mut().unwrap().reverse();
    assert_eq!(verdict(&turned), ("rings", Some(0)));
    let mut short = good.clone();
    short["claim"]["modes"][0]["distances"].as_array_mut().unwrap().pop();
    short["steps"][0]["rings"].as_array_mut().unwrap().pop();
    assert_eq!(verdict(&short), ("rings", Some(1)));
    // |kappa| times the hi of the other is part of the bound of mu_1: 100 is shown, but is too much.
    let mut large = good.clone();
    large["steps"][0]["rings"][0]["hi"] = json!("100");
    for m in 0..3 {
        large["claim"]["modes"][0]["distances"][m][1] = json!("100");
    }
    assert_eq!(verdict(&large), ("rings", Some(1)));
    large["claim"]["modes"][1]["distances"][1][1] = json!("50");
    large["claim"]["modes"][1]["distances"][2][1] = json!("50");
    assert_eq!(verdict(&large).0, "verified");
    for (m, i) in [(1, 0), (1, 1), (2, 0), (2, 1)] {
        let (p, q) = if i == 0 { (1_000_003, 1_000_000) } else { (999_995, 1_000_000) };
        let changed = scaled(&good, &format!("/claim/modes/1/distances/{m}/{i}"), p, q);
        assert_eq!(verdict(&changed), ("rings", Some(1)), "{m} {i}");
    }
}

/// Against limit meshes the largest distance of `between` is in the second sector, or its mirror image.
#[test]
fn both_sectors_of_a_mode_are_looked_at() {
    let case = Case { n: 5, weights: "original", against: "limit", levels: 1 };
    let (good, _) = propose(&case, &[Name("between", None)], SLACK, DEPTH);
    assert_eq!(verdict(&good).0, "verified");
    assert_eq!(good["steps"][0]["rings"][0]["at"]["sector"], json!(1));
    let less = scaled(&good, "/steps/0/rings/0/hi", 9999, 10000);
    let less = with(&less, "/steps/0/rings/0/lo", json!("0"));
    let less = with(&less, "/claim/modes/0/distances/0/0", json!("0"));
    assert_eq!(verdict(&less), ("rings", Some(0)));
}
