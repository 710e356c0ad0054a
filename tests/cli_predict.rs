//! `subcert predict` from outside.

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
    let assert = command.arg("predict").args(arguments).assert().code(code);
    let output = assert.get_output();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("text");
    (text(&output.stdout), text(&output.stderr))
}

fn json(arguments: &[&str]) -> Value {
    let arguments: Vec<&str> = arguments.iter().copied().chain(["--json"]).collect();
    serde_json::from_str(&run(&arguments, 0).0).expect("one JSON object")
}

const NAMES: [&str; 17] = [
    "heuristic",
    "lanquetin-neveu",
    "cheng-yong",
    "huang",
    "huang-wang",
    "tab-approx-0",
    "tab-approx-1",
    "tab-approx-2",
    "tab-interp-0",
    "tab-interp-1",
    "tab-interp-2",
    "tab-eigen-0",
    "tab-eigen-1",
    "tab-eigen-2",
    "subcert-0",
    "subcert-1",
    "subcert-2",
];

fn all(mesh: &str, scheme: &str, more: &[&str]) -> Value {
    let mesh = sample(mesh);
    let mut arguments = vec![
        mesh.as_str(),
        "--scheme",
        scheme,
        "--tolerance",
        "0.01",
        "--relative",
        "--method",
        "all",
    ];
    arguments.extend(more);
    json(&arguments)
}

#[test]
fn json_says_what_the_help_promises() {
    let value = all("bumpy_torus_tri.obj", "loop", &[]);
    assert_eq!(value["scheme"], "loop");
    assert_eq!(value["weights"], "original");
    assert_eq!(value["metric"], "parametric");
    assert_eq!(value["to"], "control");
    assert_eq!(value["relative"], 0.01);
    assert!(value["tolerance"].as_f64().unwrap() > 0.0);
    assert!(value["claim"].is_string() && value["seconds"].is_number());
    let methods = value["methods"].as_array().unwrap();
    let names: Vec<&str> = methods
        .iter()
        .map(|m| m["method"].as_str().unwrap())
        .collect();
    assert_eq!(names, NAMES);
    for method in methods {
        assert!(method["safe"].is_boolean(), "{method}");
        assert!(!method["why"].as_str().unwrap().is_empty(), "{method}");
        assert_eq!(
            method["depth"].is_null(),
            method["bound_at_depth"].is_null(),
            "{method}"
        );
        assert!(
            !method["depth"].is_null() || method["safe"] == false,
            "{method}"
        );
        if !method["bound_at_depth"].is_null() {
            let bound = method["bound_at_depth"].as_f64().unwrap();
            assert!(bound <= value["tolerance"].as_f64().unwrap(), "{method}");
        }
    }
    let of = |name: &str| methods.iter().find(|m| m["method"] == name).unwrap();
    assert_eq!(of("heuristic")["safe"], false);
    assert!(
        of("heuristic")["why"]
            .as_str()
            .unwrap()
            .contains("loop-original-saddle-n08")
    );
    assert!(
        of("lanquetin-neveu")["why"]
            .as_str()
            .unwrap()
            .contains("lanquetin-neveu-torus.obj")
    );
    assert!(of("cheng-yong")["depth"].is_null());
    assert!(of("huang-wang")["depth"].is_null());
}

#[test]
fn the_best_is_the_least_safe_depth() {
    for (mesh, scheme) in [
        ("bumpy_torus_tri.obj", "loop"),
        ("bumpy_torus_quads.obj", "catmull-clark"),
        ("bumpy_torus_quads.obj", "doo-sabin"),
    ] {
        for metric in ["parametric", "surface-to-mesh", "hausdorff"] {
            let value = all(mesh, scheme, &["--metric", metric]);
            let methods = value["methods"].as_array().unwrap();
            let safe = methods.iter().filter(|m| m["safe"] == true);
            let least = safe.map(|m| m["depth"].as_u64().unwrap()).min();
            assert_eq!(value["best"]["depth"].as_u64(), least, "{mesh} {metric}");
            assert!(value["best"].is_null() || methods.contains(&value["best"]));
            let tabulated = methods
                .iter()
                .any(|m| m["method"].as_str().unwrap().starts_with("tab-") && m["safe"] == true);
            assert!(!tabulated || metric == "surface-to-mesh");
        }
    }
}

#[test]
fn best_alone_prints_what_all_calls_best() {
    let value = all("bumpy_torus_quads.obj", "catmull-clark", &[]);
    let mesh = sample("bumpy_torus_quads.obj");
    let arguments = [
        &mesh,
        "--scheme",
        "catmull-clark",
        "--tolerance",
        "0.01",
        "--relative",
    ];
    let best = json(&arguments);
    assert_eq!(best["best"], value["best"]);
    assert_eq!(best["methods"], serde_json::json!([value["best"]]));
    let (text, _) = run(&arguments, 0);
    let word = |key: &str| {
        text.lines()
            .find(|line| line.starts_with(key))
            .unwrap()
            .to_string()
    };
    assert!(
        word("best").contains(value["best"]["method"].as_str().unwrap()),
        "{text}"
    );
    assert!(word("scheme").contains("catmull-clark"));
    assert!(word("tolerance").contains("0.01 of the bounding box's diagonal"));
}

#[test]
fn unsafe_depths_are_marked_in_the_text() {
    let mesh = sample("bumpy_torus_tri.obj");
    let arguments = [&mesh, "--scheme", "loop", "--tolerance", "0.01", "--method"];
    for name in ["heuristic", "lanquetin-neveu"] {
        let one: Vec<&str> = arguments.iter().copied().chain([name]).collect();
        let (text, _) = run(&one, 0);
        let row = text.lines().last().unwrap();
        let cells: Vec<&str> = row.split_whitespace().collect();
        assert_eq!((cells[0], cells[3]), (name, "NO"), "{text}");
        assert!(text.contains("no safe depth"), "{text}");
        assert!(json(&one)["best"].is_null());
    }
    let huang: Vec<&str> = arguments.iter().copied().chain(["huang"]).collect();
    let (text, _) = run(&huang, 0);
    let cells: Vec<&str> = text.lines().last().unwrap().split_whitespace().collect();
    assert_eq!((cells[0], cells[3]), ("huang", "yes"), "{text}");
}

#[test]
fn depths_of_faces_are_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("depths.csv").display().to_string();
    let mesh = sample("block_with_handle.obj");
    let arguments = ["--scheme", "catmull-clark", "--tolerance", "10"];
    let arguments: Vec<&str> = std::iter::once(mesh.as_str())
        .chain(arguments)
        .chain(["--method", "subcert-1", "--faces", &out])
        .collect();
    run(&arguments, 0);
    let table = fs::read_to_string(&out).expect("the file");
    assert!(table.starts_with("face,depth\n"), "{table}");
}

#[test]
fn depths_are_written_as_table_and_as_mesh() {
    use subcert::report::faces::write_depths;
    let folder = tempfile::tempdir().expect("a folder");
    let read = subcert::mesh::io::read(sample("mixed_patch.obj"));
    let mesh = read.expect("a mesh").mesh;
    let mut depths = vec![Some(3); mesh.topology.face_count() as usize];
    depths[1] = None;
    let path = |name: &str| folder.path().join(name);
    write_depths(&path("d.csv"), &mesh, &depths).expect("a table");
    let table = fs::read_to_string(path("d.csv")).expect("the file");
    assert!(table.starts_with("face,depth\n0,3\n1,\n2,3\n"), "{table}");
    assert_eq!(table.lines().count(), 1 + depths.len());
    write_depths(&path("d.ply"), &mesh, &depths).expect("a mesh");
    let bytes = fs::read(path("d.ply")).expect("the file");
    let head = String::from_utf8_lossy(&bytes).into_owned();
    assert!(head.contains("property double depth\n"), "{head}");
    assert!(head.contains("property double quality\n"), "{head}");
    assert!(write_depths(&path("d.obj"), &mesh, &depths).is_err());
}

#[test]
fn bad_input_is_refused_in_one_sentence() {
    let tri = sample("bumpy_torus_tri.obj");
    let quads = sample("bumpy_torus_quads.obj");
    let cases: [(&[&str], &str); 6] = [
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--tolerance",
                "0.1",
                "--method",
                "cheng-yong",
            ],
            "best",
        ),
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--tolerance",
                "0.1",
                "--method",
                "huang-wang",
            ],
            "best",
        ),
        (
            &[&quads, "--scheme", "loop", "--tolerance", "0.1"],
            "triangles",
        ),
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--tolerance",
                "0.1",
                "--method",
                "huang",
                "--faces",
                "o.csv",
            ],
            "subcert-0",
        ),
        (
            &[
                &tri,
                "--scheme",
                "loop",
                "--tolerance",
                "0.1",
                "--faces",
                "o.txt",
            ],
            ".ply",
        ),
        (&[&tri, "--scheme", "none", "--tolerance", "0.1"], "surface"),
    ];
    for (arguments, part) in cases {
        let (out, error) = run(arguments, 2);
        assert!(out.is_empty(), "{arguments:?}");
        assert_eq!(
            error.trim_end().lines().count(),
            1,
            "{arguments:?}: {error}"
        );
        assert!(error.contains(part), "{arguments:?}: {error}");
    }
    for tolerance in ["0", "-1", "nan", "inf", "x", "1e999"] {
        let (_, error) = run(&[&tri, "--scheme", "loop", "--tolerance", tolerance], 2);
        assert!(
            error.contains("a tolerance is a positive number"),
            "{tolerance}: {error}"
        );
    }
    let (_, error) = run(
        &[
            &tri,
            "--scheme",
            "loop",
            "--tolerance",
            "1",
            "--method",
            "x",
        ],
        2,
    );
    assert!(error.contains("subcert-2"), "{error}");
    run(&[&tri, "--scheme", "loop"], 2);
}

#[test]
fn what_no_method_proves_is_undecided() {
    let mesh = sample("bumpy_torus_tri.obj");
    let arguments = [
        &mesh,
        "--scheme",
        "loop",
        "--tolerance",
        "1e-300",
        "--method",
        "huang",
    ];
    let (out, error) = run(&arguments, 3);
    assert!(out.contains("no safe depth"), "{out}");
    assert!(
        error.contains("undecided") && error.contains("--tolerance"),
        "{error}"
    );
    let (out, error) = run(&arguments[..5], 3);
    assert!(out.contains("no safe depth"), "{out}");
    assert!(
        error.contains("undecided") && error.contains("larger --tolerance"),
        "{error}"
    );
}

#[test]
fn the_output_does_not_depend_on_the_number_of_threads() {
    let with = |threads: &str| {
        let mut value = all("bumpy_torus_tri.obj", "loop", &["--threads", threads]);
        value["seconds"] = Value::Null;
        value
    };
    assert_eq!(with("1"), with("4"));
}
