//! Claims about characteristic maps and about the distance of a centre.

use serde_json::{Value, json};
use subcert_check::check;

#[path = "support/cosine.rs"]
mod cosine;

fn file(claim: Value, step: Value, n: usize) -> Value {
    json!({
        "format": "subcert", "version": 1, "claim": claim,
        "cosine": cosine::cosine(n), "bases": [], "steps": [step],
    })
}

fn map(scheme: &str, n: usize) -> Value {
    let claim = json!({"scheme": scheme, "valence": n, "kind": "characteristic-map"});
    file(claim, json!({"rule": "embedding", "splits": 4}), n)
}

fn centre(weights: &str, n: usize) -> Value {
    let claim =
        json!({"scheme": "loop", "weights": weights, "valence": n, "kind": "centre-distance"});
    file(claim, json!({"rule": "sign"}), n)
}

/// "verified", or the name of the rule that rejects.
fn verdict(file: &Value) -> &'static str {
    match check(file.to_string().as_bytes()).outcome {
        Ok(()) => "verified",
        Err(rejection) => rejection.rule.name(),
    }
}

fn with(file: &Value, pointer: &str, value: Value) -> Value {
    let mut file = file.clone();
    *file.pointer_mut(pointer).unwrap() = value;
    file
}

#[test]
fn characteristic_maps_are_embeddings() {
    for n in (3..=12).chain([20, 30, 50, 100]) {
        for scheme in ["loop", "catmull-clark"] {
            let verdict = check(map(scheme, n).to_string().as_bytes());
            assert!(verdict.outcome.is_ok(), "{scheme} {n}: {:?}", verdict.outcome);
        }
    }
    let claim = check(map("catmull-clark", 5).to_string().as_bytes()).claim.unwrap();
    assert!(claim.starts_with("Catmull-Clark, valence 5: the characteristic map"), "{claim}");
}

#[test]
fn files_that_are_not_of_the_form() {
    let good = map("loop", 5);
    assert_eq!(verdict(&good), "verified");
    assert_eq!(verdict(&with(&good, "/claim/scheme", json!("doo-sabin"))), "embedding");
    assert_eq!(verdict(&with(&good, "/claim/valence", json!(2))), "format");
    assert_eq!(verdict(&with(&good, "/steps/0/splits", json!(9))), "embedding");
    assert_eq!(verdict(&with(&good, "/steps/0", json!({"rule": "sign"}))), "format");
    assert_eq!(verdict(&with(&good, "/steps", json!([]))), "format");
    assert_eq!(verdict(&with(&good, "/bases", json!([[1]]))), "bases");
    // The cosine is that of another valence, or missing.
    assert_eq!(verdict(&with(&good, "/claim/valence", json!(6))), "cosine");
    assert_eq!(verdict(&with(&good, "/cosine", json!(null))), "cosine");
    // An enclosure that is right but says little.
    assert_eq!(verdict(&with(&good, "/cosine", json!(["1/2", "1"]))), "embedding");
    let good = centre("warren", 4);
    assert_eq!(verdict(&with(&good, "/claim/scheme", json!("catmull-clark"))), "format");
    assert_eq!(verdict(&with(&good, "/claim/valence", json!(3))), "format");
    assert_eq!(verdict(&with(&good, "/steps/0/rule", json!("embedding"))), "format");
    assert_eq!(verdict(&with(&good, "/bases", json!([[1]]))), "bases");
    // Warren's weights ask for no cosine but its proof.
    assert_eq!(verdict(&with(&good, "/cosine", json!(["1/2", "1"]))), "verified");
    let irrational = centre("original", 5);
    assert_eq!(verdict(&with(&irrational, "/cosine", json!(["1/2", "1"]))), "sign");
}

#[test]
fn centres_stay_away() {
    for n in (4..=12).chain([30, 50]) {
        for weights in ["original", "warren"] {
            assert_eq!(verdict(&centre(weights, n)), "verified", "{weights} {n}");
        }
    }
    let claim = check(centre("warren", 4).to_string().as_bytes()).claim.unwrap();
    assert!(claim.contains("= 1 * (1/4)^m"), "{claim}");
    // 5/8 - 31/64 = 9/64, and 8/3 of 31/64.
    let claim = check(centre("original", 4).to_string().as_bytes()).claim.unwrap();
    assert!(claim.contains("= 31/24 * (9/64)^m"), "{claim}");
    // beta = 5/8 - (3/8 + cos(72 degrees)/4)^2 = 0.42046608..
    let claim = check(centre("original", 5).to_string().as_bytes()).claim.unwrap();
    assert!(claim.contains("= 1.121242"), "{claim}");
}
