//! Catmull-Clark, Doo-Sabin and violations: what is changed in a certificate is rejected by the rule that it breaks.

use std::fs;
use std::path::PathBuf;

use serde_json::{Value, json};
use subcert_check::check;

fn read(name: &str) -> Value {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/certificates");
    let text = fs::read_to_string(folder.join(name).with_extension("json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn changed(name: &str, pointer: &str, value: Value) -> Value {
    let mut file = read(name);
    let (parent, key) = pointer.rsplit_once('/').unwrap();
    match file.pointer_mut(parent).unwrap() {
        Value::Object(object) => drop(object.insert(key.into(), value)),
        Value::Array(list) => list[key.parse::<usize>().unwrap()] = value,
        other => panic!("{pointer}: {other}"),
    }
    file
}

/// "verified", or the name of the rule that rejects.
fn verdict(file: &Value) -> &'static str {
    match check(file.to_string().as_bytes()).outcome {
        Ok(()) => "verified",
        Err(rejection) => rejection.rule.name(),
    }
}

fn assert_rejected(cases: &[(&str, &str, &str, Value)]) {
    for (rule, name, pointer, value) in cases {
        let found = verdict(&changed(name, pointer, value.clone()));
        assert_eq!(found, *rule, "{name} {pointer} {value}");
    }
}

#[test]
fn constants_of_the_square() {
    let (rate, face) = ("catmull-clark-rate-second-5", "doo-sabin-rate-5");
    let (three, apply) = ("doo-sabin-rate-3", "doo-sabin-control-4-0");
    let (regular, lines) = ("catmull-clark-control-second-5-2", "doo-sabin-control-5-2");
    let (order, first) = ("catmull-clark-control-second-3-0", "catmull-clark-mesh-rate-first-3");
    let list = |count: usize| json!(vec![0; count]);
    let cell = |name: &str, word: &str| {
        let cells = read(name)["steps"][2]["cells"].as_array().unwrap().clone();
        format!("/steps/2/cells/{}", cells.iter().position(|cell| cell[0] == word).unwrap())
    };
    let (of_one, of_quarter) = (cell(regular, "1"), cell(lines, "01"));
    let bases = |cell: &str| format!("{cell}/1");
    assert_rejected(&[
        ("format", rate, "/claim/weights", json!("original")),
        ("format", rate, "/claim/weights", Value::Null),
        ("format", rate, "/claim/norm", json!("face")),
        ("format", rate, "/claim/kind", json!("beta")),
        ("format", rate, "/claim/exact", json!(["1"])),
        ("format", face, "/claim/norm", json!("second")),
        ("format", face, "/claim/kind", json!("limit")),
        ("format", face, "/claim/kind", json!("mesh-rate")),
        ("format", face, "/claim/valence", json!(65)),
        ("format", apply, "/steps/1/bound", json!(["1"])),
        ("claim", rate, "/claim/level", json!(0)),
        ("cosine", rate, "/cosine", json!(["4/5", "9/10"])),
        ("cosine", three, "/cosine", json!(["1/3", "2/3"])),
        ("cosine", face, "/cosine", Value::Null),
        ("cosine", face, "/cosine/1", json!("4/5")),
        ("differences", face, "/claim/hi", json!("108541/200000")),
        ("differences", rate, "/claim/hi", json!("7199999/10000000")),
        ("differences", first, "/steps/1/words/1/0", json!("3")),
        ("attained", face, "/claim/lo", json!("5427051/10000000")),
        ("attained", rate, "/steps/0/net/0", json!("2")),
        ("attained", rate, "/steps/0/at/difference", json!(21)),
        ("attained", face, "/steps/0/at/difference", json!(17)),
        ("attained", apply, "/steps/0/at/word", json!("")),
        ("attained", apply, "/steps/0/at/word", json!("1")),
        ("attained", apply, "/steps/0/at/word", json!("21")),
        ("attained", apply, "/steps/0/at", json!({"word": "02", "v": "1", "w": "9/8"})),
        ("attained", apply, "/steps/0/at", json!({"word": "00", "v": "1", "w": "1"})),
        ("attained", lines, "/steps/0/at/word", json!("01")),
        ("lemma", order, "/steps/1/corner", Value::Null),
        ("lemma", order, "/steps/1/order", json!(0)),
        ("lemma", order, "/steps/1/cells/0/2", json!(["edge", 0, "1/2"])),
        ("lemma", order, "/steps/1/bound", json!("1/4")),
        ("covering", apply, "/steps/1/cells/0/0", json!("1")),
        ("covering", apply, "/steps/1/cells/0/0", json!("0")),
        ("covering", apply, "/steps/1/depth", json!(1)),
        ("cell-hull", apply, "/steps/1/bound", json!("1/5")),
        ("cell-edge", apply, "/steps/1/cells/0/2", json!(["edge", 4, "1/2"])),
        ("cell-edge", apply, "/steps/1/cells/0/2", json!(["edge", 0, "-1/2"])),
        ("cell-concave", apply, "/steps/1/cells/0/2", json!(["concave", "1", "2"])),
        ("cell-regular", apply, "/steps/1/cells/0/2", json!("regular")),
        ("format", apply, "/steps/1/cells/0/1", list(8)),
        ("bases", apply, "/steps/1/cells/0/1", json!(vec![99; 9])),
        ("cell-regular", regular, &bases(&of_one), json!(0)),
        ("format", regular, &bases(&of_one), list(16)),
        ("cover", regular, &format!("{of_one}/2"), json!("hull")),
        ("covering", regular, &format!("{of_one}/0"), json!("2")),
        ("format", regular, "/claim/kind", json!("rates")),
        ("format", lines, &bases(&of_quarter), list(9)),
        ("cover", lines, &format!("{of_quarter}/2"), json!("hull")),
        ("cover", lines, "/steps/2/steps", json!(1)),
        ("tail", apply, "/steps/1/tail", json!([])),
        ("tail", order, "/steps/1/tail/0/0", list(15)),
    ]);
}

#[test]
fn a_regular_cell_reaches_one_letter_further_with_doo_sabin() {
    // The lines of level 2 are on words of three letters: those of two are regular, with 1/4 4^0; and "first" has no such rule.
    let cells = read("doo-sabin-control-5-2")["steps"][2]["cells"].as_array().unwrap().clone();
    let of = |by: &str| {
        cells
            .iter()
            .filter(|cell| cell[2] == by)
            .map(|cell| cell[0].as_str().unwrap().len())
            .collect::<Vec<_>>()
    };
    assert!(of("regular").contains(&2) && of("hull").iter().all(|&letters| letters >= 3));
    let file = changed("catmull-clark-control-second-5-2", "/claim/norm", json!("first"));
    assert_ne!(verdict(&file), "verified");
}

#[test]
fn violations_of_nets() {
    let (loops, clark, sabin) =
        ("violation-loop-5", "violation-catmull-clark-3", "violation-doo-sabin-5");
    let terms = |word: &str, terms: Value| json!({"word": word, "terms": terms});
    let against = |word: &str, mesh: &str, level: usize, at: [&str; 2]| json!({"word": word, "against": mesh, "level": level, "at": at});
    assert_rejected(&[
        ("violated", loops, "/claim/factor", json!("1")),
        ("violated", loops, "/claim/factor", json!("-1")),
        ("violated", loops, "/claim/right", json!([])),
        ("violated", loops, "/claim/left", terms("", json!([]))),
        ("violated", loops, "/claim/left", terms("", json!([[12, "1"]]))),
        ("violated", loops, "/claim/left", terms("", json!([[0, "1"]]))),
        ("violated", loops, "/claim/left", terms("", json!([[1, "0"]]))),
        ("violated", loops, "/claim/left", terms("", json!([[2, "1"], [1, "1"]]))),
        ("violated", loops, "/claim/left", terms("1", json!([[13, "1"]]))),
        ("violated", loops, "/claim/left", against("0", "control", 2, ["0", "0"])),
        ("violated", loops, "/claim/left", against("0", "control", 0, ["1/2", "0"])),
        ("violated", loops, "/claim/left", against("1", "control", 0, ["1", "1"])),
        ("violated", loops, "/steps/0/net", json!(["1"])),
        ("format", loops, "/claim/left", against("0", "control", 25, ["0", "0"])),
        ("format", loops, "/claim/left/at", Value::Null),
        ("format", loops, "/claim/left/terms", json!([[1, "1"]])),
        ("format", loops, "/claim/norm", json!("second")),
        ("format", loops, "/claim/factor", json!("9".repeat(401))),
        ("format", loops, "/claim/scheme", json!("catmull-clark")),
        ("format", loops, "/steps", json!([])),
        ("format", loops, "/steps/0/at", json!(null)),
        ("bases", loops, "/bases", json!([[1]])),
        ("cosine", loops, "/cosine", Value::Null),
        ("claim", loops, "/steps/0", json!({"rule": "rate"})),
        ("violated", clark, "/claim/factor", json!("5/8")),
        ("cosine", clark, "/cosine", json!(["1/3", "2/3"])),
        ("violated", clark, "/claim/left", terms("", json!([[15, "1"]]))),
        ("violated", sabin, "/claim/left", against("", "control", 0, ["0", "0"])),
        ("violated", sabin, "/claim/left", against("2", "control", 0, ["1/2", "1/2"])),
        ("violated", sabin, "/claim/left", against("02", "control", 2, ["1/2", "1/2"])),
        ("format", sabin, "/claim/left", against("02", "limit", 0, ["1/2", "1/2"])),
    ]);
    // Label 8 of n = 3 is y_(2n+2), not a second name of label 2.
    let mut file = changed(clark, "/claim/left", terms("", json!([[8, "1"]])));
    file["claim"]["right"] = json!([terms("", json!([[2, "1"]]))]);
    file["steps"][0]["net"] =
        json!((1..=14).map(|i| if i == 8 { "1" } else { "0" }).collect::<Vec<_>>());
    assert_eq!(verdict(&file), "verified");
}

#[test]
fn violations_of_meshes() {
    let (recurrence, rate, distance) =
        ("mesh-recurrence-loop", "mesh-rate-loop", "mesh-distance-loop");
    let faces = read(recurrence)["claim"]["faces"].as_array().unwrap().clone();
    let with = |face: Value| json!([&faces[..], &[face]].concat());
    assert_rejected(&[
        ("mesh", recurrence, "/claim/faces", json!(faces[1..])),
        ("mesh", recurrence, "/claim/faces", with(faces[0].clone())),
        ("mesh", recurrence, "/claim/faces", with(json!([1, 1, 2]))),
        ("mesh", recurrence, "/claim/faces", with(json!([0, 1, 2]))),
        ("mesh", recurrence, "/claim/faces/0", json!([2, 1, 3])),
        ("mesh", recurrence, "/claim/faces", json!([[1, 2, 3], [1, 3, 2]])),
        ("mesh", recurrence, "/claim/vertices", json!(vec![["0", "0", "1"]; 99])),
        (
            "recurrence",
            recurrence,
            "/claim/vertices",
            json!(vec![["1", "1", "1"]; faces.len() / 2 + 2]),
        ),
        ("recurrence", recurrence, "/claim/level", json!(7)),
        ("format", recurrence, "/claim/level", json!(25)),
        ("format", recurrence, "/claim/valence", json!(3)),
        ("format", recurrence, "/claim/scheme", json!("catmull-clark")),
        ("format", recurrence, "/claim/vertices/0", json!(["0", "0"])),
        ("format", recurrence, "/claim/vertices/0/0", json!(format!("1/1{}", "0".repeat(700)))),
        ("format", recurrence, "/steps/0/edge", json!([1, 2])),
        ("cosine", recurrence, "/cosine", json!(["1/3", "2/3"])),
        ("bases", recurrence, "/bases", json!([[]])),
        ("claim", recurrence, "/claim/inequality", json!("distance")),
        ("claim", recurrence, "/steps/0", json!({"rule": "violated", "net": []})),
        ("rate", rate, "/claim/level", json!(0)),
        ("distance", distance, "/claim/level", json!(1)),
        ("distance", distance, "/steps/0/edge", json!([1, 1])),
        ("distance", distance, "/steps/0/edge", json!([0, 1])),
        ("format", distance, "/steps/0", json!({"rule": "distance"})),
    ]);
}
