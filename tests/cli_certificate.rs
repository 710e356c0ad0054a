//! `subcert measure --certificate`: what it writes, the checker verifies; what it can't, it refuses.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use num_rational::BigRational;
use predicates::str::contains;
use serde_json::Value;

fn measure(arguments: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("subcert").expect("the binary");
    command.arg("measure").args(arguments).assert()
}

/// An octahedron with these coordinates: o, and a 2, 3, 4 times the unit from it.
fn octahedron(folder: &Path, origin: &str, unit: &str) -> String {
    let axes = [(0, 2), (1, 3), (0, -2), (1, -3), (2, 4), (2, -4)];
    let mut text = String::new();
    for (axis, length) in axes {
        text += "v";
        for i in 0..3 {
            let along = if i == axis { length } else { 0 };
            text += &match origin {
                "0" => format!(" {along}{unit}"),
                _ => format!(" {}", origin.parse::<i64>().expect("digits") + along),
            };
        }
        text += "\n";
    }
    text += "f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\nf 2 1 6\nf 3 2 6\nf 4 3 6\nf 1 4 6\n";
    let path = folder.join("octahedron.obj");
    fs::write(&path, text).expect("a file");
    path.display().to_string()
}

fn rational(value: &Value) -> BigRational {
    value.as_str().expect("a rational").parse().expect("p/q")
}

/// Verified, and the proved enclosure meets the measured one.
fn check(file: &Path, measured: &Value) {
    let text = fs::read(file).expect("a certificate");
    let verdict = subcert_check::check(&text);
    assert!(verdict.outcome.is_ok(), "{:?}", verdict.outcome);
    let claim = &serde_json::from_slice::<Value>(&text).expect("JSON")["claim"];
    let number = |key: &str| measured[key].as_f64().expect("a number");
    let exact = |x: f64| BigRational::from_float(x).expect("finite");
    let (lo, hi) = (rational(&claim["lo"]), rational(&claim["hi"]));
    assert!(
        exact(number("lo")) <= hi && lo <= exact(number("hi")),
        "{measured} {lo} {hi}"
    );
    let gap = BigRational::new(21.into(), 20.into());
    assert!(hi <= lo * gap, "not as near as asked for");
}

#[test]
fn coordinates_of_any_size_and_place() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("proof.json");
    let name = out.display().to_string();
    for (origin, unit) in [
        ("0", ""),
        ("0", "e300"),
        ("0", "e-300"),
        ("123456789012345", ""),
    ] {
        let mesh = octahedron(folder.path(), origin, unit);
        for side in ["surface-to-mesh", "mesh-to-surface"] {
            let arguments = [
                &mesh,
                "--scheme",
                "loop",
                "--distance",
                side,
                "--gap",
                "0.04",
                "--json",
                "--certificate",
                &name,
            ];
            let assert = measure(&arguments)
                .code(0)
                .stderr(contains("subcert-check"));
            let found = serde_json::from_slice(&assert.get_output().stdout).expect("JSON");
            check(&out, &found);
        }
    }
}

#[test]
fn levels_limits_and_quads() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("proof.json");
    let name = out.display().to_string();
    let cube = folder.path().join("cube.obj");
    let text = "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\nv -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 2\n\
        f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    fs::write(&cube, text).expect("a file");
    let cube = cube.display().to_string();
    for more in [
        &["--level", "1"][..],
        &["--level", "1", "--against", "limit"],
        &["--facets", "triangles"],
    ] {
        let arguments = [
            &cube,
            "--scheme",
            "catmull-clark",
            "--distance",
            "surface-to-mesh",
            "--gap",
            "0.04",
            "--json",
            "--certificate",
            &name,
        ];
        let arguments: Vec<&str> = arguments.into_iter().chain(more.iter().copied()).collect();
        let assert = measure(&arguments).code(0);
        let found = serde_json::from_slice(&assert.get_output().stdout).expect("JSON");
        check(&out, &found);
    }
}

#[test]
fn refusals_write_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("proof.json");
    let name = out.display().to_string();
    let mesh = octahedron(folder.path(), "0", "");
    let torus = format!(
        "{}/examples/meshes/bumpy_torus_tri.obj",
        env!("CARGO_MANIFEST_DIR")
    );
    let quads = format!(
        "{}/examples/meshes/block_with_handle.obj",
        env!("CARGO_MANIFEST_DIR")
    );
    let h = ["--distance", "surface-to-mesh"];
    for (arguments, words) in [
        (
            vec![&*mesh, "--scheme", "loop"],
            "--certificate belongs to Hausdorff distances",
        ),
        (
            vec![&*mesh, "--scheme", "none", "--other", &*mesh, h[0], h[1]],
            "limit surface",
        ),
        (
            vec![&*quads, "--scheme", "doo-sabin", h[0], h[1]],
            "Loop and Catmull-Clark",
        ),
        (
            vec![&*torus, "--scheme", "loop", "--level", "5", h[0], h[1]],
            "up to 2000 faces",
        ),
    ] {
        let arguments: Vec<&str> = arguments
            .into_iter()
            .chain(["--certificate", &name])
            .collect();
        measure(&arguments).code(2).stderr(contains(words));
        assert!(!out.exists(), "{arguments:?}");
    }
    let nowhere = folder
        .path()
        .join("no/such/folder.json")
        .display()
        .to_string();
    let arguments = [
        &*mesh,
        "--scheme",
        "loop",
        h[0],
        h[1],
        "--certificate",
        &nowhere,
    ];
    measure(&arguments).code(2);
}
