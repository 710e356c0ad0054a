//! `subcert spectrum` from outside.

use assert_cmd::Command;
use serde_json::Value;

fn subcert(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("subcert").expect("the binary");
    command.arg("spectrum").args(arguments);
    command
}

fn json(arguments: &[&str]) -> Value {
    let assert = subcert(arguments).arg("--json").assert().code(0);
    serde_json::from_slice(&assert.get_output().stdout).expect("one JSON object")
}

#[test]
fn json_says_what_the_help_promises() {
    let value = json(&["--scheme", "catmull-clark", "--valence", "3..6"]);
    assert_eq!(value["scheme"], "catmull-clark");
    assert!(value["weights"].is_null());
    let rows = value["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 4);
    for (row, n) in rows.iter().zip(3u64..) {
        assert_eq!(row["n"], n);
        assert_eq!(row["points"], 1 + 6 * n);
        assert_eq!(row["defective"], false);
        assert_eq!(row["characteristic_map"]["regular"], "proved");
        assert_eq!(row["characteristic_map"]["injective"], "proved");
        let eigenvalues = row["eigenvalues"].as_array().unwrap();
        let count =
            |key: &str| -> u64 { eigenvalues.iter().map(|e| e[key].as_u64().unwrap()).sum() };
        assert_eq!(
            (count("multiplicity"), count("eigenvectors")),
            (1 + 6 * n, 1 + 6 * n)
        );
        for pair in eigenvalues.windows(2) {
            assert!(pair[0]["lo"].as_f64().unwrap() > pair[1]["hi"].as_f64().unwrap());
        }
        for e in eigenvalues {
            assert_ne!(e["exact"].is_null(), e["quadratic"].is_null());
        }
        let subdominant = &eigenvalues[row["subdominant"].as_u64().unwrap() as usize];
        assert_eq!(subdominant["frequencies"], serde_json::json!([1, n - 1]));
    }
    // Regular valence: the powers of 1/2 with their multiplicities; 1/4 is the second derivatives'.
    let exact: Vec<_> = rows[1]["eigenvalues"].as_array().unwrap().iter().collect();
    let exact: Vec<_> = exact
        .iter()
        .map(|e| (e["exact"].as_str().unwrap(), &e["multiplicity"]))
        .collect();
    assert_eq!(
        exact[..3]
            .iter()
            .map(|(x, m)| (*x, m.as_u64().unwrap()))
            .collect::<Vec<_>>(),
        [("1", 1), ("1/2", 2), ("1/4", 3)]
    );
}

#[test]
fn the_jordan_block_of_loop_is_reported() {
    for weights in ["original", "warren"] {
        let value = json(&[
            "--scheme",
            "loop",
            "--weights",
            weights,
            "--valence",
            "3..4",
        ]);
        assert_eq!(value["weights"], weights);
        let rows = value["rows"].as_array().unwrap();
        assert_eq!(
            (&rows[0]["defective"], &rows[1]["defective"]),
            (&true.into(), &false.into())
        );
        let last = rows[0]["eigenvalues"]
            .as_array()
            .unwrap()
            .last()
            .unwrap()
            .clone();
        assert_eq!(
            (&last["exact"], &last["multiplicity"], &last["eigenvectors"]),
            (&"1/16".into(), &4.into(), &3.into())
        );
        let blocks = |row: &Value| -> usize {
            let modes = row["modes"].as_array().unwrap();
            modes
                .iter()
                .map(|m| m["generalised_by"].as_array().unwrap().len())
                .sum()
        };
        assert_eq!((blocks(&rows[0]), blocks(&rows[1])), (1, 0));
        let assert = subcert(&["--scheme", "loop", "--weights", weights, "--valence", "3"])
            .assert()
            .code(0);
        let text = String::from_utf8(assert.get_output().stdout.clone()).unwrap();
        assert!(text.contains("DEFECTIVE at 1/16: A v = λ v + "), "{text}");
    }
}

#[test]
fn the_output_does_not_depend_on_the_number_of_threads() {
    let table = |threads: &str| {
        let mut value = json(&[
            "--scheme",
            "catmull-clark",
            "--valence",
            "3..9",
            "--threads",
            threads,
        ]);
        value["seconds"] = Value::Null;
        value
    };
    assert_eq!(table("1"), table("4"));
}

#[test]
fn what_makes_no_sense_is_refused_in_one_sentence() {
    let cases: [&[&str]; 4] = [
        &["--scheme", "doo-sabin", "--valence", "5"],
        &["--scheme", "loop", "--valence", "2..5"],
        &["--scheme", "loop", "--valence", "900"],
        &[
            "--scheme",
            "catmull-clark",
            "--weights",
            "warren",
            "--valence",
            "5",
        ],
    ];
    for arguments in cases {
        let assert = subcert(arguments).assert().code(2);
        let captured = assert.get_output();
        assert!(captured.stdout.is_empty(), "{arguments:?}");
        let text = String::from_utf8(captured.stderr.clone()).unwrap();
        assert_eq!(text.trim_end().lines().count(), 1, "{arguments:?}: {text}");
    }
    for valence in ["9..3", "x", "-1", "3.."] {
        subcert(&["--scheme", "loop", "--valence", valence])
            .assert()
            .code(2);
    }
    subcert(&["--scheme", "loop"]).assert().code(2);
}
