//! Hausdorff distances on the command line: what is printed, exit codes, refusals.

use std::fs;
use std::path::PathBuf;

use assert_cmd::Command;
use serde_json::Value;

fn sample(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("examples/meshes");
    path.join(name).display().to_string()
}

fn run(arguments: &[&str], code: i32) -> (String, String) {
    let mut command = Command::cargo_bin("subcert").expect("the binary");
    let assert = command.arg("measure").args(arguments).assert().code(code);
    let output = assert.get_output();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
    (text(&output.stdout), text(&output.stderr))
}

fn json(arguments: &[&str]) -> Value {
    let arguments: Vec<&str> = arguments.iter().copied().chain(["--json"]).collect();
    serde_json::from_str(&run(&arguments, 0).0).expect("one JSON object")
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} in {value}"))
}

const DISTANCES: [&str; 3] = ["surface-to-mesh", "mesh-to-surface", "hausdorff"];
const MESHES: [(&str, &str); 4] = [
    ("bumpy_torus_tri.obj", "loop"),
    ("valences_3_to_12.obj", "loop"),
    ("block_with_handle.obj", "catmull-clark"),
    ("mixed_patch.obj", "doo-sabin"),
];

#[test]
fn enclosures_read_back_and_do_not_depend_on_threads() {
    for (name, scheme) in MESHES {
        let mesh = sample(name);
        for distance in DISTANCES {
            let mut results = Vec::new();
            for threads in ["1", "2", "5"] {
                let mut found = json(&[
                    &mesh,
                    "--scheme",
                    scheme,
                    "--distance",
                    distance,
                    "--threads",
                    threads,
                ]);
                let (lo, hi) = (number(&found, "lo"), number(&found, "hi"));
                assert!(0.0 < lo && lo <= hi, "{found}");
                assert!(hi - lo <= 1e-4 * number(&found, "diagonal"), "{found}");
                assert_eq!(found["facets"], "bilinear");
                assert!(!found["witness"]["point"].is_null(), "{found}");
                found["seconds"] = Value::Null;
                results.push(found.to_string());
            }
            let same = results.windows(2).all(|pair| pair[0] == pair[1]);
            assert!(same, "{name} {distance}: {results:?}");
        }
    }
}

/// The parametric distance pairs points; nearest points are no further.
#[test]
fn hausdorff_distances_are_below_the_parametric_one() {
    for (name, scheme) in MESHES {
        for against in ["control", "limit"] {
            for level in ["0", "2"] {
                let mesh = sample(name);
                let base = [
                    &mesh,
                    "--scheme",
                    scheme,
                    "--against",
                    against,
                    "--level",
                    level,
                ];
                let parametric = number(&json(&base), "hi");
                let mut ends = Vec::new();
                for distance in DISTANCES {
                    let mut arguments = base.to_vec();
                    arguments.extend(["--distance", distance, "--gap", "1e-3"]);
                    let found = json(&arguments);
                    let (lo, hi) = (number(&found, "lo"), number(&found, "hi"));
                    assert!(lo <= parametric, "{name} {against} {level} {found}");
                    assert!(hi - lo <= 1e-3 * hi, "{name} {against} {level} {found}");
                    ends.push((lo, hi));
                }
                let larger = (ends[0].0.max(ends[1].0), ends[0].1.max(ends[1].1));
                assert!(ends[2].0 <= larger.1 && larger.0 <= ends[2].1, "{ends:?}");
            }
        }
    }
}

#[test]
fn meshes_are_compared_with_meshes() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).display().to_string();
    let (first, second) = (path("first.obj"), path("second.off"));
    fs::write(
        &first,
        "v 0 0 0\nv 1 1 0\nv 1 0 1\nv 0 1 1\nf 1 2 3\nf 1 3 4\n",
    )
    .expect("written");
    let text = "OFF\n4 2 0\n0 0 0\n1 1 0\n1 0 1\n0 1 1\n3 0 1 3\n3 1 2 3\n";
    fs::write(&second, text).expect("written");
    for distance in DISTANCES {
        let arguments = [
            first.as_str(),
            "--scheme",
            "none",
            "--other",
            &second,
            "--distance",
            distance,
            "--diagonal-gap",
            "1e-9",
        ];
        let found = json(&arguments);
        // The regular tetrahedron on four corners of the cube: see tests/hausdorff.rs.
        let exact = 1.0 / 3.0_f64.sqrt();
        assert!(number(&found, "lo") <= exact * (1.0 + 1e-15), "{found}");
        assert!(number(&found, "hi") >= exact * (1.0 - 1e-15), "{found}");
        let (text, _) = run(&arguments, 0);
        for line in [
            "scheme     none",
            "facets     bilinear",
            "witness",
            "hi held by",
        ] {
            assert!(text.contains(line), "{line} in {text}");
        }
    }
    let mesh = sample("block_with_handle.obj");
    let found = json(&[
        &mesh,
        "--scheme",
        "catmull-clark",
        "--distance",
        "hausdorff",
        "--facets",
        "triangles",
    ]);
    assert_eq!(found["facets"], "triangles");
}

#[test]
fn a_spent_budget_prints_an_enclosure_and_code_3() {
    let mesh = sample("valences_3_to_12.obj");
    let arguments = [
        mesh.as_str(),
        "--scheme",
        "loop",
        "--distance",
        "hausdorff",
        "--gap",
        "1e-9",
        "--budget",
        "0",
        "--json",
    ];
    let (text, error) = run(&arguments, 3);
    let found: Value = serde_json::from_str(&text).expect("one JSON object");
    assert!(
        number(&found, "lo") <= number(&found, "hi") && found["met"] == false,
        "{found}"
    );
    assert!(error.contains("undecided"), "{error}");
    let whole = json(&[&mesh, "--scheme", "loop", "--distance", "hausdorff"]);
    assert!(number(&whole, "lo") <= number(&found, "hi"));
    assert!(number(&found, "lo") <= number(&whole, "hi"));
}

#[test]
fn what_does_not_go_together_is_refused_in_one_sentence() {
    let (tri, polygons) = (sample("bumpy_torus_tri.obj"), sample("mixed_patch.obj"));
    let cases: [(&[&str], &str); 9] = [
        (&[&tri, "--scheme", "loop", "--other", &tri], "--distance"),
        (
            &[&tri, "--scheme", "loop", "--facets", "triangles"],
            "--distance",
        ),
        (&[&tri, "--scheme", "loop", "--budget", "1"], "--distance"),
        (&[&tri, "--scheme", "none"], "--scheme none"),
        (
            &[&tri, "--scheme", "none", "--distance", "hausdorff"],
            "--other FILE",
        ),
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--distance",
                "hausdorff",
                "--arithmetic",
                "exact",
            ],
            "--arithmetic",
        ),
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--distance",
                "hausdorff",
                "--faces",
                "x.ply",
            ],
            "--faces",
        ),
        (
            &[
                &polygons,
                "--scheme",
                "doo-sabin",
                "--distance",
                "hausdorff",
                "--facets",
                "triangles",
            ],
            "--facets bilinear",
        ),
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--distance",
                "hausdorff",
                "--gap",
                "1e-15",
            ],
            "1e-13",
        ),
    ];
    for (arguments, cure) in cases {
        let (out, error) = run(arguments, 2);
        assert!(out.is_empty(), "{arguments:?} printed {out}");
        assert_eq!(
            error.trim_end().lines().count(),
            1,
            "{arguments:?}: {error}"
        );
        assert!(error.contains(cure), "{arguments:?}: {error}");
    }
    run(
        &[
            &tri,
            "--scheme",
            "loop",
            "--distance",
            "hausdorff",
            "--other",
            &tri,
            "--level",
            "1",
        ],
        2,
    );
}
