//! Small certificates are verified; what is changed in them is rejected, by the rule that it breaks.

use std::fs;
use std::path::PathBuf;

use serde_json::{Value, json};
use subcert_check::check;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/certificates")
}

fn read(name: &str) -> String {
    fs::read_to_string(folder().join(name).with_extension("json")).unwrap()
}

fn names() -> Vec<String> {
    let entries = fs::read_dir(folder()).unwrap();
    let stem =
        |entry: fs::DirEntry| entry.path().file_stem().unwrap().to_string_lossy().into_owned();
    entries.map(|entry| stem(entry.unwrap())).collect()
}

/// "verified", or the name of the rule that rejects.
fn verdict(text: &str) -> &'static str {
    match check(text.as_bytes()).outcome {
        Ok(()) => "verified",
        Err(rejection) => rejection.rule.name(),
    }
}

fn changed(name: &str, changes: &[(&str, Value)]) -> String {
    let mut file: Value = serde_json::from_str(&read(name)).unwrap();
    for (pointer, value) in changes {
        let (parent, key) = pointer.rsplit_once('/').unwrap();
        match file.pointer_mut(parent).unwrap() {
            Value::Object(object) => drop(object.insert(key.into(), value.clone())),
            Value::Array(list) => list[key.parse::<usize>().unwrap()] = value.clone(),
            other => panic!("{pointer}: {other}"),
        }
    }
    file.to_string()
}

#[test]
fn certificates_are_verified() {
    let names = names();
    assert_eq!(names.len(), 36);
    for name in names {
        let verdict = check(read(&name).as_bytes());
        assert!(verdict.outcome.is_ok(), "{name}: {:?}", verdict.outcome);
    }
}

#[test]
fn claims_say_what_is_known_by_hand() {
    // n = 6: r_1 = 1/4; C_0 = 1/2 = the displacement of a vertex; HW's Theorem 1: 1/4, 1/3, 5/12
    // for the coefficients, 1/3 for B_0. n = 3: C_0 = 8 beta / (3 + 8 beta) = (9/2) / (15/2).
    for (name, exact) in [
        ("rate-original-6-1", "1/4"),
        ("control-original-6-0", "1/2"),
        ("coefficient-original-6-1", "1/4"),
        ("coefficient-original-6-3", "1/3"),
        ("coefficient-original-6-4", "5/12"),
        ("limit-original-6-0", "1/3"),
        ("control-original-3-0", "3/5"),
        // At valence 6 both fall by 4 per level.
        ("control-warren-6-2", "1/32"),
        ("limit-warren-6-2", "1/48"),
        // On these and on limit-original-6-0 the rule `cell-regular` rests.
        ("mesh-rate-original-6-1", "1/4"),
    ] {
        let told = [
            ("/claim/lo", json!(exact)),
            ("/claim/hi", json!(exact)),
            ("/claim/exact", json!(exact)),
        ];
        assert_eq!(verdict(&changed(name, &told)), "verified", "{name}");
        let claim = check(changed(name, &told).as_bytes()).claim.unwrap();
        assert!(claim.contains(&format!("exactly {exact}")), "{claim}");
    }
}

#[test]
fn bounds_beyond_the_truth_are_rejected() {
    // Each constant to four places, and the rule that meets a smaller upper bound.
    for (name, below, above, rule) in [
        ("rate-original-6-1", "2499/10000", "2501/10000", "differences"),
        ("rate-warren-7-1", "6785/10000", "6786/10000", "differences"),
        ("mesh-rate-original-5-1", "5409/10000", "5410/10000", "differences"),
        ("coefficient-original-6-4", "4166/10000", "4167/10000", "weight"),
        ("coefficient-original-7-12-5", "2055/10000", "2056/10000", "weight"),
        ("control-original-6-0", "4999/10000", "5001/10000", "apply"),
        ("control-original-7-1", "1346/10000", "1347/10000", "tail"),
        ("control-original-3-0", "5999/10000", "6001/10000", "tail"),
        ("control-original-5-0", "5285/10000", "5286/10000", "tail"),
        ("limit-original-6-0", "3333/10000", "3334/10000", "cell-hull"),
        ("limit-original-8-0", "3319/10000", "3331/10000", "cell-edge"),
        ("limit-warren-8-2", "616/10000", "617/10000", "cell-edge"),
        ("control-warren-5-3", "180/10000", "181/10000", "cell-edge"),
        ("beta-warren-4", "3342/10000", "3343/10000", "cell-concave"),
        ("beta-original-7", "3295/10000", "3296/10000", "cell-concave"),
    ] {
        let number = |text: &str| {
            let (p, q) = text.split_once('/').unwrap();
            let (p, q): (u64, u64) = (p.parse().unwrap(), q.parse().unwrap());
            let common = (1..=p).rev().find(|d| p % d == 0 && q % d == 0).unwrap();
            json!(format!("{}/{}", p / common, q / common))
        };
        let (below, above) = (number(below), number(above));
        let with = |lo: &Value, hi: &Value| {
            let changes = [
                ("/claim/lo", lo.clone()),
                ("/claim/hi", hi.clone()),
                ("/claim/exact", Value::Null),
            ];
            verdict(&changed(name, &changes))
        };
        let found = (with(&json!("0"), &below), with(&above, &json!("1")));
        let attained = if name.starts_with("beta") { "attained-tile" } else { "attained" };
        assert_eq!(found, (rule, attained), "{name}");
        assert_eq!(with(&below, &json!("1")), "verified", "{name}");
    }
}

#[test]
fn what_is_changed_is_rejected_by_its_rule() {
    let (rate, hull, edge) = ("rate-original-6-1", "control-original-6-0", "limit-original-8-0");
    let (concave, corner, tail) =
        ("limit-original-6-0", "control-original-5-0", "control-original-7-1");
    let coefficient = "coefficient-original-7-12-5";
    let cell = |name: &str, step: usize, way: &str| -> usize {
        let file: Value = serde_json::from_str(&read(name)).unwrap();
        let cells = file["steps"][step]["cells"].as_array().unwrap().clone();
        cells.iter().position(|cell| cell[2] == way || cell[2][0] == way).unwrap()
    };
    let of_edge = format!("/steps/2/cells/{}/2", cell(edge, 2, "edge"));
    let of_concave = format!("/steps/2/cells/{}/2", cell(concave, 2, "concave"));
    for (rule, name, pointer, value) in [
        ("format", rate, "/version", json!(2)),
        ("format", rate, "/format", json!("cert")),
        ("format", rate, "/extra", json!(1)),
        ("format", rate, "/claim/extra", json!(1)),
        ("format", rate, "/claim/at", Value::Null),
        ("format", rate, "/claim/scheme", json!("catmull-clark")),
        ("format", rate, "/claim/norm", json!("first")),
        ("format", rate, "/claim/valence", json!(2)),
        ("format", rate, "/claim/valence", json!(401)),
        ("format", rate, "/claim/valence", json!(6.5)),
        ("format", rate, "/claim/level", json!(25)),
        ("format", rate, "/claim/level", json!(-1)),
        ("format", rate, "/claim/lo", json!(0.25)),
        ("format", rate, "/claim/lo", json!("2/8")),
        ("format", rate, "/claim/exact", json!(["1", "0"])),
        ("format", rate, "/claim/exact", json!([])),
        ("format", rate, "/cosine", json!(["1/2"])),
        ("format", rate, "/cosine", json!(["1/2", "3/4", "4/5"])),
        ("format", rate, "/steps", json!([])),
        ("format", rate, "/steps/0/extra", json!(1)),
        ("format", rate, "/steps/0/at/extra", json!(1)),
        ("format", rate, "/steps/1/rule", json!("differ")),
        ("format", rate, "/steps/1/words/0/0", json!("4")),
        ("format", rate, "/steps/1/words/0/0", json!("0".repeat(41))),
        ("format", rate, "/bases/0/0", json!(-1)),
        ("format", hull, "/steps/2/cells", json!([])),
        ("format", hull, "/steps/1/cells/0/2", json!("edge")),
        ("format", hull, "/steps/1/cells/0/2", json!(["hull"])),
        ("format", hull, "/steps/1/cells/0/2", json!(["concave", 0, "1/2"])),
        ("format", hull, "/steps/1", json!({"rule": "apply", "lemma": 1})),
        ("format", hull, "/steps/2", json!({"rule": "attained", "net": [], "at": null})),
        ("claim", rate, "/claim/lo", json!("1/3")),
        ("claim", rate, "/claim/hi", json!("1/5")),
        ("claim", rate, "/claim/exact", json!("1/3")),
        ("claim", rate, "/claim/level", json!(0)),
        ("claim", rate, "/claim/kind", json!("coefficient")),
        ("claim", rate, "/claim/at", json!({"word": "1", "index": 0})),
        ("claim", coefficient, "/claim/level", json!(1)),
        ("claim", coefficient, "/claim/at/index", json!(15)),
        ("claim", coefficient, "/claim/at/word", json!("")),
        ("attained", hull, "/claim/kind", json!("limit")),
        ("claim", hull, "/steps/2", json!({"rule": "weight", "basis": 0})),
        ("cosine", rate, "/cosine", json!(["4/5", "9/10"])),
        ("cosine", coefficient, "/cosine", Value::Null),
        ("cosine", coefficient, "/cosine/0", json!("91/100")),
        ("cosine", coefficient, "/cosine/1", json!("9/10")),
        ("bases", rate, "/bases/3", json!([])),
        ("bases", rate, "/bases/3/0", json!(16)),
        ("bases", rate, "/steps/1/words/0/1/3", json!(99)),
        ("cosine", rate, "/claim/valence", json!(12)),
        ("attained", rate, "/steps/0/net", json!(["0"])),
        ("attained", rate, "/steps/0/net/0", json!("9")),
        ("attained", rate, "/steps/0/net", json!(vec!["0"; 12])),
        ("attained", rate, "/steps/0/at", Value::Null),
        ("attained", rate, "/steps/0/at", json!({"word": "1", "v": "0", "w": "0"})),
        ("attained", rate, "/steps/0/at/difference", json!(0)),
        ("attained", rate, "/steps/0/at/difference", json!(16)),
        ("attained", rate, "/steps/0/at/word", json!("")),
        ("attained", rate, "/steps/0/at/word", json!("1")),
        ("attained", concave, "/steps/0/at/v", json!("-1/3")),
        ("attained", concave, "/steps/0/at/v", json!("1")),
        ("attained", concave, "/steps/0/at/v", json!("1/4")),
        ("attained", concave, "/steps/0/at/word", json!("0")),
        ("attained", corner, "/steps/0/at/v", json!("1/2")),
        ("lemma", hull, "/steps/1/steps", json!(0)),
        ("lemma", hull, "/steps/1/steps", json!(41)),
        ("lemma", hull, "/steps/1/depth", json!(usize::MAX >> 12)),
        ("lemma", hull, "/steps/1/order", json!(1)),
        ("lemma", hull, "/steps/1/order", json!(2)),
        ("lemma", hull, "/steps/1/corner", json!(0)),
        ("lemma", corner, "/steps/1/corner", Value::Null),
        ("lemma", corner, "/steps/1/bound", json!("1/2")),
        ("lemma", corner, "/steps/1/cells/0/2", json!(["edge", 0, "0"])),
        ("cover", tail, "/steps/2/lemma", json!(0)),
        ("cover", tail, "/steps/2/lemma", json!(2)),
        ("cover", tail, "/steps/2/lemma", json!(7)),
        ("cover", tail, "/steps/2/steps", json!(0)),
        ("cover", tail, "/steps/2/steps", json!(41)),
        ("cover", tail, "/steps/2/cells/0/0", json!("")),
        ("apply", hull, "/steps/2/lemma", json!(0)),
        ("apply", hull, "/steps/1/bound", json!("51/100")),
        ("differences", rate, "/steps/1/words", json!([])),
        ("differences", rate, "/steps/1/words/0/0", json!("1")),
        ("differences", rate, "/steps/1/words/0/0", json!("00")),
        ("differences", rate, "/steps/1/words/0/1", json!([0])),
        ("cell-edge", edge, &of_edge[..], json!(["edge", 3, "1/2"])),
        ("cell-edge", edge, &of_edge[..], json!(["edge", 0, "1/2"])),
        ("cell-edge", edge, &of_edge[..], json!(["edge", 2, "0"])),
        ("cell-edge", edge, &of_edge[..], json!(["edge", 2, "3/2"])),
        ("cell-hull", edge, &of_edge[..], json!("hull")),
        ("cell-concave", edge, &of_edge[..], json!(["concave", "1/2", "0"])),
        ("cell-concave", concave, &of_concave[..], json!(["concave", "1/3", "1/4"])),
        ("cell-concave", concave, &of_concave[..], json!(["concave", "2/3", "2/3"])),
        ("cell-hull", concave, &of_concave[..], json!("hull")),
        ("covering", hull, "/steps/1/cells", json!([])),
        ("covering", hull, "/steps/1/cells/0/0", json!("0")),
        ("covering", hull, "/steps/1/cells/0/0", json!("2")),
        ("covering", hull, "/steps/1/cells/0/0", json!("3333")),
        ("covering", hull, "/steps/1/steps", json!(2)),
        ("covering", hull, "/steps/1/depth", json!(1)),
        ("covering", tail, "/steps/2/steps", json!(5)),
        ("tail", hull, "/steps/1/tail", json!([])),
        ("tail", hull, "/steps/1/tail/0/0", json!([])),
        ("tail", tail, "/steps/2/tail/1/1", json!([0])),
    ] {
        let found = verdict(&changed(name, &[(pointer, value.clone())]));
        assert_eq!(found, rule, "{name} {pointer} {value}");
    }
}

#[test]
fn what_is_changed_in_tiles_and_cells_is_rejected_by_its_rule() {
    let (tiles, regular, rate) = ("beta-warren-4", "limit-warren-8-2", "rate-original-6-1");
    let (control, corner) = ("control-original-6-0", "control-original-5-0");
    // Cells 1 and 2 of `tiles` are the tiles 2 and 01, in four quarters and by the hull.
    let quarter = |i: usize| format!("/steps/2/cells/1/2/1/{i}");
    let (hull, concave) = (quarter(0), quarter(2));
    let nested = |splits| {
        (0..splits).fold(json!("hull"), |by, _| json!(["split", [by, "hull", "hull", "hull"]]))
    };
    let tile = json!({"rule": "attained-tile", "word": "1", "nets": [], "v": "0", "w": "0"});
    let listed = |word: &str, by: &str| json!([word, vec![5; 15], by]);
    for (rule, name, pointer, value) in [
        ("verified", tiles, "/steps/2/cells/2/2", nested(12)),
        ("cell-split", tiles, "/steps/2/cells/2/2", nested(13)),
        ("format", tiles, "/steps/2/cells/2/2", json!("split")),
        ("format", tiles, "/steps/2/cells/2/2", json!(["split", ["hull", "hull", "hull"]])),
        ("format", tiles, "/steps/2/cells/2/2", json!(["split", vec!["hull"; 5]])),
        ("format", tiles, "/steps/2/cells/2/2", json!(["split", "hull", "hull", "hull", "hull"])),
        ("format", tiles, "/steps/2/cells/2/2", json!(["hull", vec!["hull"; 4]])),
        ("format", tiles, &hull, json!(["split", 1, "1/2"])),
        ("format", tiles, "/steps/2/cells/2/1", json!(vec![4; 14])),
        ("format", tiles, "/steps/2/cells/2/1", json!(vec![4; 16])),
        ("format", tiles, "/steps/2/cells/2/1", json!(vec!["4"; 15])),
        ("format", tiles, "/steps/0/extra", json!(1)),
        ("format", tiles, "/steps/0/nets/0/0", json!(1)),
        ("format", tiles, "/steps/2/extra", json!(1)),
        ("format", tiles, "/steps/1", tile.clone()),
        ("bases", tiles, "/steps/2/cells/2/1/14", json!(99)),
        ("claim", tiles, "/claim/level", json!(1)),
        ("claim", tiles, "/claim/kind", json!("limit")),
        ("claim", tiles, "/steps/0", json!({"rule": "attained", "net": [], "at": null})),
        ("claim", tiles, "/steps/2/rule", json!("cover")),
        ("claim", control, "/steps/0", tile.clone()),
        ("claim", rate, "/steps/0", tile),
        ("attained-tile", tiles, "/steps/0/nets", json!([])),
        ("attained-tile", tiles, "/steps/0/nets/14", json!(["0"])),
        ("attained-tile", tiles, "/steps/0/nets/4", json!(vec!["0"; 10])),
        ("attained-tile", tiles, "/steps/0/nets/4/0", json!("9")),
        ("attained-tile", tiles, "/steps/0/word", json!("")),
        ("attained-tile", tiles, "/steps/0/word", json!("0")),
        ("attained-tile", tiles, "/steps/0/word", json!("22")),
        ("attained-tile", tiles, "/steps/0/word", json!("20")),
        ("attained-tile", tiles, "/steps/0/word", json!("1")),
        ("attained-tile", tiles, "/steps/0/v", json!("1")),
        ("attained-tile", tiles, "/steps/0/v", json!("-1/3")),
        ("attained-tile", tiles, "/steps/0/v", json!("1/3")),
        ("tiles", tiles, "/steps/2/lemma", json!(0)),
        ("tiles", tiles, "/steps/2/lemma", json!(2)),
        ("tiles", tiles, "/steps/2/steps", json!(41)),
        ("tiles", tiles, "/steps/2/cells/0/0", json!("12")),
        ("tiles", tiles, "/steps/2/cells/0/0", json!("")),
        ("tiles", tiles, "/steps/2/cells/0/0", json!("0")),
        ("tiles", tiles, "/steps/1/cells/0/2", nested(1)),
        ("covering", tiles, "/steps/2/steps", json!(3)),
        ("covering", tiles, "/steps/2/cells/0/0", json!("2")),
        ("covering", tiles, "/steps/2/cells/0/0", json!("0001")),
        ("tail", tiles, "/steps/2/tail/1/1", json!([0])),
        ("cell-hull", tiles, &concave, json!("hull")),
        ("cell-hull", tiles, "/steps/2/cells/1/2", json!("hull")),
        ("cell-edge", tiles, "/steps/2/cells/1/2", json!(["edge", 2, "1/2"])),
        ("cell-concave", tiles, &concave, json!(["concave", "1/2", "1/4"])),
        ("cell-regular", tiles, &hull, json!("regular")),
        ("cell-regular", tiles, "/steps/2/cells/2/2", json!("regular")),
        ("cell-regular", tiles, "/steps/1/cells/0", listed("1", "regular")),
        ("lemma", corner, "/steps/1/cells/0/2", json!("regular")),
        ("lemma", corner, "/steps/1/cells/0/2", nested(1)),
        ("cell-regular", regular, "/steps/2/cells/0/1", json!(5)),
        ("cell-regular", regular, "/steps/2/cells/3", listed("02", "regular")),
        ("cell-regular", regular, "/steps/2/cells/3/2", json!("regular")),
        ("cell-regular", regular, "/steps/2/cells/5", listed("002", "regular")),
        ("cell-regular", regular, "/steps/2/cells/0/1", json!(vec![3; 15])),
        ("cover", regular, "/steps/2/cells/0/2", json!("hull")),
        ("covering", regular, "/steps/2/cells/0/0", json!("10")),
        ("format", regular, "/steps/2/cells/0/2", json!(["regular"])),
    ] {
        let found = verdict(&changed(name, &[(pointer, value.clone())]));
        assert_eq!(found, rule, "{name} {pointer} {value}");
    }
    // The lemma's cells are hulls, but of parts of a tile.
    let file: Value = serde_json::from_str(&read(tiles)).unwrap();
    let parts = ["10", "11", "12", "13"].map(|word| json!([word, 0, "hull"]));
    let cells = [&parts[..], &file["steps"][1]["cells"].as_array().unwrap()[1..]].concat();
    assert_eq!(verdict(&changed(tiles, &[("/steps/1/cells", json!(cells))])), "tiles");
}

#[test]
fn a_regular_cell_has_the_factors_of_its_kind() {
    // In basis 0 the second difference of the word 1 has the weight 3/8; k - |w| = 1.
    for (name, shown) in [("control-warren-6-2", "0.046875"), ("limit-warren-6-2", "0.03125")] {
        let text = changed(name, &[("/steps/2/cells/0/1", json!(vec![0; 15]))]);
        let why = check(text.as_bytes()).outcome.unwrap_err().to_string();
        let expected = format!("rule cell-regular: cell \"1\": difference 2: {shown} is not");
        assert!(why.contains(&expected), "{why}");
    }
}

#[test]
fn fields_that_are_missing_or_doubled() {
    for field in ["format", "version", "claim", "cosine", "bases", "steps"] {
        let mut file: Value = serde_json::from_str(&read("rate-original-6-1")).unwrap();
        file.as_object_mut().unwrap().remove(field);
        assert_eq!(verdict(&file.to_string()), "format", "{field}");
    }
    for (pointer, field) in
        [("/claim", "exact"), ("/steps/0", "at"), ("/steps/1", "corner"), ("/steps/1", "rule")]
    {
        let mut file: Value = serde_json::from_str(&read("control-original-6-0")).unwrap();
        file.pointer_mut(pointer).unwrap().as_object_mut().unwrap().remove(field);
        assert_eq!(verdict(&file.to_string()), "format", "{pointer} {field}");
    }
    let text = read("control-original-6-0");
    for doubled in [
        "\"version\": 1",
        "\"cosine\": null",
        "\"level\": 0",
        "\"rule\": \"apply\"",
        "\"corner\": null",
        "\"order\": 0",
    ] {
        assert_eq!(text.matches(doubled).count(), 1, "{doubled}");
        let twice = text.replace(doubled, &format!("{doubled}, {doubled}"));
        assert_eq!(verdict(&twice), "format", "{doubled}");
    }
}

#[test]
fn what_is_cut_off_is_rejected() {
    for name in names() {
        let text = read(&name);
        let text = text.trim_end();
        for end in (0..text.len()).step_by(if text.len() < 1000 { 1 } else { 61 }) {
            assert_eq!(verdict(&text[..end]), "format", "{name} cut at {end}");
        }
        assert_eq!(verdict(&format!("{text}{{}}")), "format");
    }
    for text in ["", "null", "[]", "{}", "\u{0}", "[[[[[[[["] {
        assert_eq!(verdict(text), "format");
    }
    assert_eq!(verdict(&"[".repeat(1 << 20)), "format");
    assert!(check(&[0xff, 0xfe]).outcome.is_err());
}

#[test]
fn a_basis_that_serves_another_functional_is_too_heavy_somewhere() {
    // Cite each basis in turn for everything: the certificate's own choice is not idle.
    let text = read("control-original-7-1");
    let file: Value = serde_json::from_str(&text).unwrap();
    let mut rejected = 0;
    for basis in 0..file["bases"].as_array().unwrap().len() {
        let list = json!(vec![basis; 16]);
        rejected += usize::from(
            verdict(&changed("control-original-7-1", &[("/steps/2/tail/0/0", list)])) == "tail",
        );
    }
    assert!(rejected > 0);
}
