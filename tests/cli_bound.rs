//! `subcert bound` from outside.

use std::fs;

use assert_cmd::Command;
use serde_json::Value;

fn subcert(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("subcert").expect("the binary");
    command.args(arguments);
    command
}

fn output(arguments: &[&str], code: i32) -> String {
    let assert = subcert(arguments).assert().code(code);
    String::from_utf8(assert.get_output().stdout.clone()).expect("text")
}

#[test]
fn json_has_the_rows_that_the_help_promises() {
    let text = output(
        &[
            "bound",
            "control",
            "--scheme",
            "loop",
            "--valence",
            "5..7",
            "--level",
            "0..1",
            "--json",
        ],
        0,
    );
    let value: Value = serde_json::from_str(&text).expect("one JSON object");
    let rows = value["rows"].as_array().expect("rows");
    let keys: Vec<(u64, u64)> = (rows.iter())
        .map(|row| (row["n"].as_u64().unwrap(), row["level"].as_u64().unwrap()))
        .collect();
    assert_eq!(keys, [(5, 0), (5, 1), (6, 0), (6, 1), (7, 0), (7, 1)]);
    for row in rows {
        let (lo, hi) = (row["lo"].as_f64().unwrap(), row["hi"].as_f64().unwrap());
        assert!(lo <= hi && hi - lo <= 1e-6 * hi && row["seconds"].as_f64().unwrap() >= 0.0);
    }
    assert_eq!(rows[2]["exact"], "1/2");
    assert_eq!(value["norm"], "second");
}

#[test]
fn rates_default_to_level_one_and_weights_are_told_apart() {
    for (weights, exact) in [("original", "49/128"), ("warren", "7/16")] {
        let text = output(
            &[
                "bound",
                "rate",
                "--scheme",
                "loop",
                "--weights",
                weights,
                "--valence",
                "4",
                "--json",
            ],
            0,
        );
        let value: Value = serde_json::from_str(&text).expect("one JSON object");
        assert_eq!(value["rows"][0]["exact"], exact);
        assert_eq!(value["weights"], weights);
    }
}

#[test]
fn the_table_does_not_depend_on_the_number_of_threads() {
    let table = |threads: &str| {
        let text = output(
            &[
                "bound",
                "limit",
                "--scheme",
                "loop",
                "--valence",
                "3..9",
                "--json",
                "--threads",
                threads,
            ],
            0,
        );
        let mut value: Value = serde_json::from_str(&text).expect("one JSON object");
        value["seconds"] = Value::Null;
        for row in value["rows"].as_array_mut().expect("rows") {
            row["seconds"] = Value::Null;
        }
        value
    };
    assert_eq!(table("1"), table("4"));
}

#[test]
fn certificates_are_written_one_for_each_row_and_the_same_every_time() {
    let folders = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    for folder in &folders {
        let path = folder.path().display().to_string();
        output(
            &[
                "bound",
                "limit",
                "--scheme",
                "loop",
                "--valence",
                "7..8",
                "--level",
                "0..1",
                "--certificates",
                &path,
            ],
            0,
        );
    }
    let mut names: Vec<_> = fs::read_dir(folders[0].path())
        .unwrap()
        .map(|entry| entry.unwrap().file_name())
        .collect();
    names.sort();
    assert_eq!(names.len(), 4);
    for name in names {
        let read = |i: usize| fs::read(folders[i].path().join(&name)).unwrap();
        assert_eq!(read(0), read(1), "{name:?}");
        assert!(subcert_check::check(&read(0)).outcome.is_ok(), "{name:?}");
    }
}

#[test]
fn what_makes_no_sense_is_refused_in_one_sentence() {
    let loop_ = ["--scheme", "loop"];
    let quads = |constant, scheme, norm| {
        [
            "bound",
            constant,
            "--scheme",
            scheme,
            "--valence",
            "5",
            "--norm",
            norm,
        ]
    };
    let cases: [&[&str]; 15] = [
        &["bound", "control", "--scheme", "loop"],
        &quads("control", "cubic-curve", "second"),
        &["bound", "beta", "--scheme", "cubic-curve"],
        &[
            "bound",
            "rate",
            "--scheme",
            "quadratic-curve",
            "--certificates",
            "x",
        ],
        &quads("control", "doo-sabin", "second"),
        &quads("limit", "doo-sabin", "face"),
        &quads("control", "catmull-clark", "face"),
        &quads("beta", "catmull-clark", "second"),
        &quads("control", "loop", "first"),
        &["bound", "control", "--valence", "2", loop_[0], loop_[1]],
        &["bound", "control", "--valence", "500", loop_[0], loop_[1]],
        &[
            "bound",
            "rate",
            "--valence",
            "5",
            "--level",
            "0",
            loop_[0],
            loop_[1],
        ],
        &[
            "bound",
            "control",
            "--valence",
            "5",
            "--level",
            "17",
            loop_[0],
            loop_[1],
        ],
        &[
            "bound",
            "beta",
            "--valence",
            "5",
            "--level",
            "1",
            loop_[0],
            loop_[1],
        ],
        &[
            "bound",
            "limit",
            "--valence",
            "5",
            "--certificates",
            "/dev/null/no",
            loop_[0],
            loop_[1],
        ],
    ];
    for arguments in cases {
        let assert = subcert(arguments).assert().code(2);
        let captured = assert.get_output();
        assert!(captured.stdout.is_empty(), "{arguments:?}");
        let text = String::from_utf8(captured.stderr.clone()).unwrap();
        assert_eq!(text.trim_end().lines().count(), 1, "{arguments:?}: {text}");
    }
    for wrong in [
        ["--valence", "9..3"],
        ["--valence", "x"],
        ["--gap", "2"],
        ["--gap", "nan"],
        ["--level", "-1"],
        ["--corner", "sharp"],
        ["--norm", "third"],
    ] {
        let valence = if wrong[0] == "--valence" {
            vec![]
        } else {
            vec!["--valence", "5"]
        };
        let arguments = [
            vec!["bound", "limit", "--scheme", "loop"],
            valence,
            wrong.to_vec(),
        ]
        .concat();
        subcert(&arguments).assert().code(2);
    }
}

/// LN Theorems 1 and 4: 1/6 and 1/8, a quarter of it with each level.
#[test]
fn curves_have_closed_forms() {
    for (scheme, constant, rows) in [
        ("cubic-curve", "control", ["0  1/6", "1  1/24"]),
        ("quadratic-curve", "control", ["0  1/8", "1  1/32"]),
        ("cubic-curve", "limit", ["0  1/8", "1  1/32"]),
    ] {
        let arguments = ["bound", constant, "--scheme", scheme, "--level", "0..1"];
        let assert = subcert(&arguments).assert().success();
        let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        for row in rows {
            assert!(text.contains(row), "{text}");
        }
    }
}

/// Rows of Catmull-Clark are fractions; each of the two norms has its own file names.
#[test]
fn rates_of_catmull_clark_are_fractions() {
    let folder = tempfile::tempdir().unwrap();
    for norm in ["second", "first"] {
        let arguments = [
            "bound",
            "rate",
            "--scheme",
            "catmull-clark",
            "--valence",
            "3..5",
        ];
        let more = [
            "--level",
            "1..3",
            "--norm",
            norm,
            "--certificates",
            folder.path().to_str().unwrap(),
        ];
        let assert = subcert(&[&arguments[..], &more[..]].concat())
            .assert()
            .success();
        let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        let expected = if norm == "second" { "2/3" } else { "9/16" };
        assert!(text.contains(expected), "{text}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 18);
}
