//! The program from outside: exit codes, messages, files.

use std::fs;
use std::path::{Path, PathBuf};

use assert_cmd::Command;
use serde_json::Value;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn sample(name: &str) -> String {
    root()
        .join("examples/meshes")
        .join(name)
        .display()
        .to_string()
}

fn subcert(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("subcert").expect("the binary");
    command.args(arguments);
    command
}

/// Standard output of a command that must end with the given code.
fn output(arguments: &[&str], code: i32) -> String {
    let assert = subcert(arguments).assert().code(code);
    String::from_utf8(assert.get_output().stdout.clone()).expect("text")
}

/// The one sentence of a command that must be refused.
fn refusal(arguments: &[&str]) -> String {
    let assert = subcert(arguments).assert().code(2);
    let captured = assert.get_output();
    assert!(captured.stdout.is_empty(), "{arguments:?} printed a result");
    let text = String::from_utf8(captured.stderr.clone()).expect("text");
    assert_eq!(text.trim_end().lines().count(), 1, "{arguments:?}: {text}");
    assert!(!text.contains("panicked"), "{text}");
    text
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&output(arguments, 0)).expect("one JSON object")
}

fn number(value: &Value, key: &str) -> f64 {
    value[key]
        .as_f64()
        .unwrap_or_else(|| panic!("{key} in {value}"))
}

#[test]
fn measure_prints_an_enclosure_that_reads_back() {
    let mesh = sample("bumpy_torus_tri.obj");
    for against in ["control", "limit"] {
        let found = json(&[
            "measure",
            &mesh,
            "--scheme",
            "loop",
            "--against",
            against,
            "--json",
        ]);
        let (lo, hi) = (number(&found, "lo"), number(&found, "hi"));
        assert!(0.0 < lo && lo <= hi && (hi - lo) / hi <= 1e-6, "{found}");
        assert_eq!(number(&found, "gap"), (hi - lo) / hi);
        assert_eq!(found["weights"], "original");
        assert_eq!(found["scheme"], "loop");
        for key in ["faces", "witness", "seconds", "boundary"] {
            assert!(!found[key].is_null(), "{key}");
        }
        // The witness' points are at the distance it stands for, up to its own rounding.
        let point = |key: &str| -> Vec<f64> {
            let point = found["witness"][key].as_array().expect("a point");
            point
                .iter()
                .map(|x| x.as_f64().expect("a coordinate"))
                .collect()
        };
        let (s, f) = (point("surface_point"), point("mesh_point"));
        let distance = s
            .iter()
            .zip(&f)
            .map(|(a, b)| (a - b) * (a - b))
            .sum::<f64>()
            .sqrt();
        assert!((distance - lo).abs() <= 1e-9 * lo, "{distance} {lo}");
    }
}

/// f = i^2 - j^2 on the regular triangle lattice: the surface takes these values exactly, the mesh
/// interpolates linearly, and t (1 - t) has maximum 1/4 in the middle of an edge. Derived by hand.
#[test]
fn the_saddle_is_at_distance_one_quarter_inside() {
    let folder = tempfile::tempdir().expect("a folder");
    let csv = folder.path().join("faces.csv").display().to_string();
    let mesh = sample("loop_saddle_grid.obj");
    output(
        &[
            "measure",
            &mesh,
            "--scheme",
            "loop",
            "--faces",
            &csv,
            "--face-gap",
            "1e-6",
        ],
        0,
    );
    let text = fs::read_to_string(&csv).expect("the CSV file");
    let inside = text.lines().skip(1).filter(|line| {
        let fields: Vec<f64> = line
            .split(',')
            .map(|x| x.parse().expect("a number"))
            .collect();
        assert!(fields[1] <= fields[2], "{line}");
        fields[1] <= 0.25 && 0.25 <= fields[2] && fields[2] < 0.250001
    });
    // 8 x 8 cells of two triangles; the 6 x 6 inner cells are untouched by the boundary rule.
    assert_eq!(inside.count(), 72);
    // The boundary curve of a parabola with second difference 2 is 2/6 away from its polygon.
    let found = json(&[
        "measure",
        &mesh,
        "--scheme",
        "loop",
        "--arithmetic",
        "exact",
        "--json",
    ]);
    assert_eq!(found["lo_squared"], "1/9");
    assert_eq!(found["hi_squared"], "1/9");
}

/// (i^2 + j^2)/2 on the square lattice: each direction adds 1/6 at a vertex.
#[test]
fn the_paraboloid_is_at_distance_one_third() {
    let mesh = sample("paraboloid_grid.obj");
    // Smooth corners are further off; pinned ones are at distance 0.
    let found = json(&[
        "measure",
        &mesh,
        "--scheme",
        "catmull-clark",
        "--corner",
        "sharp",
        "--arithmetic",
        "exact",
        "--json",
    ]);
    assert_eq!(found["lo_squared"], "1/9");
    assert_eq!(found["hi_squared"], "1/9");
    assert!(number(&found, "lo") <= 1.0 / 3.0 && 1.0 / 3.0 <= number(&found, "hi"));
}

#[test]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().expect("a folder");
    for (mesh, scheme) in [
        ("bumpy_torus_tri.obj", "loop"),
        ("block_with_handle.obj", "catmull-clark"),
        ("mixed_patch.obj", "doo-sabin"),
    ] {
        let mesh = sample(mesh);
        let mut results = Vec::new();
        for threads in ["1", "2", "5"] {
            let csv = folder
                .path()
                .join(format!("{scheme}-{threads}.csv"))
                .display()
                .to_string();
            let mut found = json(&[
                "measure",
                &mesh,
                "--scheme",
                scheme,
                "--level",
                "1",
                "--against",
                "limit",
                "--threads",
                threads,
                "--faces",
                &csv,
                "--json",
            ]);
            found["seconds"] = Value::Null;
            results.push((found.to_string(), fs::read(&csv).expect("the CSV file")));
        }
        assert!(
            results.windows(2).all(|pair| pair[0] == pair[1]),
            "{scheme}"
        );
    }
}

#[test]
fn ply_faces_carry_scalars_and_colours() {
    let folder = tempfile::tempdir().expect("a folder");
    let ply = folder.path().join("error.ply");
    let mesh = sample("block_with_handle.obj");
    output(
        &[
            "measure",
            &mesh,
            "--scheme",
            "catmull-clark",
            "--faces",
            &ply.display().to_string(),
        ],
        0,
    );
    let bytes = fs::read(&ply).expect("the PLY file");
    let header = String::from_utf8_lossy(&bytes[..600.min(bytes.len())]).to_string();
    for property in [
        "double distance_lo",
        "double distance_hi",
        "double quality",
        "uchar red",
    ] {
        assert!(header.contains(property), "{header}");
    }
    subcert(&["info", &ply.display().to_string()])
        .assert()
        .code(0);
}

#[test]
fn refine_writes_what_info_counts() {
    let folder = tempfile::tempdir().expect("a folder");
    for (mesh, scheme, extension, faces) in [
        ("bumpy_torus_tri.obj", "loop", "off", 16),
        ("block_with_handle.obj", "catmull-clark", "ply", 16),
    ] {
        let mesh = sample(mesh);
        let out = folder
            .path()
            .join(format!("fine.{extension}"))
            .display()
            .to_string();
        output(
            &[
                "refine", &mesh, "--scheme", scheme, "--levels", "2", "--limit", "-o", &out,
            ],
            0,
        );
        let count = |path: &str| {
            json(&["info", path, "--json"])["faces"]
                .as_u64()
                .expect("a count")
        };
        assert_eq!(count(&out), faces * count(&mesh));
    }
}

#[test]
fn flags_that_make_no_sense_are_refused() {
    let (quads, triangles) = (
        sample("block_with_handle.obj"),
        sample("bumpy_torus_tri.obj"),
    );
    let irregular = sample("valences_3_to_12.obj");
    let cases: [(&[&str], &str); 12] = [
        (&["measure", &quads, "--scheme", "loop"], "triangle"),
        (
            &[
                "measure",
                &quads,
                "--scheme",
                "catmull-clark",
                "--weights",
                "warren",
            ],
            "--weights",
        ),
        (
            &[
                "measure",
                &quads,
                "--scheme",
                "doo-sabin",
                "--corner",
                "sharp",
            ],
            "--corner",
        ),
        (
            &["measure", "no/such/file.obj", "--scheme", "loop"],
            "no/such/file.obj",
        ),
        (
            &["measure", &root().display().to_string(), "--scheme", "loop"],
            "extension",
        ),
        (
            &["measure", &triangles, "--scheme", "loop", "--gap", "1e-15"],
            "--gap",
        ),
        (
            &[
                "measure", &triangles, "--scheme", "loop", "--faces", "x.txt",
            ],
            ".csv",
        ),
        (
            &[
                "measure",
                &triangles,
                "--scheme",
                "loop",
                "--faces",
                "no/such/folder/x.csv",
            ],
            "no/such/folder",
        ),
        (
            &["measure", &triangles, "--scheme", "loop", "--level", "40"],
            "2^31",
        ),
        (
            &[
                "refine",
                &triangles,
                "--scheme",
                "loop",
                "--levels",
                "4000000000",
                "-o",
                "x.obj",
            ],
            "2^31",
        ),
        (
            &["refine", &triangles, "--scheme", "loop", "-o", "x.stl"],
            "extension",
        ),
        (
            &[
                "measure",
                &irregular,
                "--scheme",
                "loop",
                "--arithmetic",
                "exact",
            ],
            "irrational",
        ),
    ];
    for (arguments, word) in cases {
        let text = refusal(arguments);
        assert!(text.contains(word), "{arguments:?}: {text}");
    }
    for arguments in [
        &["measure", &triangles][..],
        &["measure", &triangles, "--scheme", "butterfly"],
        &["measure", &triangles, "--scheme", "loop", "--gap", "nan"],
        &["measure", &triangles, "--scheme", "loop", "--gap", "-1"],
        &["measure", &triangles, "--scheme", "loop", "--threads", "0"],
        &[],
    ] {
        subcert(arguments).assert().code(2);
    }
}

/// Every file of `shared/meshes/bad` gets code 2 and one sentence that names the file; the one with
/// faces of area zero is legal, and gets finite numbers.
#[test]
fn bad_files_are_refused_in_one_sentence() {
    let folder = root().join("../shared/meshes/bad");
    if !folder.is_dir() {
        eprintln!("skipped: {} is not there", folder.display());
        return;
    }
    let mut seen = 0;
    for entry in fs::read_dir(&folder).expect("the folder") {
        let path = entry.expect("an entry").path();
        let (name, text) = (file_name(&path), path.display().to_string());
        if name == "zero_area.obj" {
            let found = json(&["measure", &text, "--scheme", "loop", "--json"]);
            assert!(number(&found, "lo") <= number(&found, "hi"));
            subcert(&["info", &text]).assert().code(0);
        } else {
            for arguments in [
                &["info", &text][..],
                &["measure", &text, "--scheme", "loop"],
                &[
                    "measure",
                    &text,
                    "--scheme",
                    "catmull-clark",
                    "--arithmetic",
                    "exact",
                ],
                &["refine", &text, "--scheme", "loop", "-o", "never.obj"],
            ] {
                let sentence = refusal(arguments);
                assert!(sentence.contains(&name), "{sentence}");
            }
        }
        seen += 1;
    }
    assert_eq!(seen, 8);
    assert!(!Path::new("never.obj").exists());
}

fn file_name(path: &Path) -> String {
    path.file_name()
        .expect("a name")
        .to_string_lossy()
        .into_owned()
}

/// Units and places: scaling by a power of two scales the enclosure exactly; far from the origin and
/// at extreme sizes the enclosures still hold and stay tight.
#[test]
fn coordinates_of_any_size_are_measured() {
    let folder = tempfile::tempdir().expect("a folder");
    let base = subcert::mesh::io::read(sample("valences_3_to_12.obj"))
        .expect("a mesh")
        .mesh;
    let write = |name: &str, change: &dyn Fn(f64) -> f64| {
        let mut mesh = base.clone();
        for p in &mut mesh.positions {
            p.0 = p.0.map(change);
        }
        let path = folder.path().join(name);
        subcert::mesh::io::write(&path, &mesh).expect("written");
        path.display().to_string()
    };
    for level in ["0", "2"] {
        let measure = |path: &str| {
            let found = json(&[
                "measure", path, "--scheme", "loop", "--level", level, "--json",
            ]);
            (number(&found, "lo"), number(&found, "hi"))
        };
        let (lo, hi) = measure(&write("base.obj", &|x| x));
        for exponent in [900, 300, -300, -900] {
            let factor = 2f64.powi(exponent);
            let scaled = measure(&write("scaled.obj", &|x| x * factor));
            // Up to the last step, which the decimals need.
            let near = |a: f64, b: f64| a == b || a == b.next_up() || a == b.next_down();
            assert!(
                near(scaled.0, lo * factor) && near(scaled.1, hi * factor),
                "2^{exponent}: {scaled:?}"
            );
        }
        // Exact shifts: coordinates are first rounded to multiples of 2^-20.
        let coarse = |x: f64| (x * 1048576.0).round() / 1048576.0;
        let (lo, hi) = measure(&write("coarse.obj", &coarse));
        let far = measure(&write("far.obj", &|x| coarse(x) + 1e9));
        assert!(far.0 <= hi && lo <= far.1, "{far:?} {lo} {hi}");
        assert!((far.1 - far.0) / far.1 <= 1e-6);
    }
}
