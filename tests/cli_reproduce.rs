//! `subcert reproduce` from outside.

use std::fs;
use std::path::Path;

use assert_cmd::Command;
use serde_json::Value;

fn subcert(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("subcert").expect("the binary");
    command.args(arguments);
    command
}

#[test]
fn a_folder_holds_what_its_text_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("hw").display().to_string();
    let arguments = [
        "reproduce",
        "huang-wang",
        "--valence",
        "3..4",
        "--out",
        &out,
    ];
    let assert = subcert(&arguments).assert().code(0);
    let text = String::from_utf8(assert.get_output().stdout.clone()).expect("text");
    for part in [
        "Table 1", "Table 2", "Table 3", "refuted", "sharp", "0.437500",
    ] {
        assert!(text.contains(part), "{part}");
    }
    let read = |name: &str| fs::read_to_string(format!("{out}/{name}")).expect(name);
    let json: Value = serde_json::from_str(&read("huang-wang.json")).expect("JSON");
    assert_eq!(json["paper"], "huang-wang");
    let claims = json["claims"].as_array().expect("claims");
    let refuted = claims
        .iter()
        .find(|c| c["id"] == "rate-quarter")
        .expect("a claim");
    assert_eq!(refuted["verdict"], "refuted");
    for claim in claims {
        for file in claim["certificates"].as_array().expect("files") {
            let name = file.as_str().expect("a name");
            let certificate: Value =
                serde_json::from_str(&read(&format!("certificates/{name}"))).expect("JSON");
            assert_eq!(certificate["format"], "subcert");
        }
    }
    let markdown = read("huang-wang.md");
    for plot in json["plots"].as_array().expect("plots") {
        let name = format!("{}.svg", plot["id"].as_str().expect("a name"));
        assert!(
            markdown.contains(&name) && read(&name).starts_with("<svg"),
            "{name}"
        );
    }
    // Every link of the text leads to a file.
    for link in markdown.split("](").skip(1) {
        let target = link.split(')').next().expect("a link");
        assert!(folder.path().join("hw").join(target).is_file(), "{target}");
    }
    // The same bytes again, and as JSON on standard output.
    let arguments = [
        "--threads",
        "1",
        "reproduce",
        "huang-wang",
        "--valence",
        "3..4",
        "--json",
    ];
    let assert = subcert(&arguments).assert().code(0);
    let output = String::from_utf8(assert.get_output().stdout.clone()).expect("text");
    assert_eq!(output, read("huang-wang.json"));
}

/// Every link of a Markdown file of a folder leads to a file.
fn assert_links(folder: &Path, name: &str) {
    let text = fs::read_to_string(folder.join(name)).expect(name);
    for link in text.split("](").skip(1) {
        let target = link.split(')').next().expect("a link");
        assert!(folder.join(target).is_file(), "{name}: {target}");
    }
}

#[test]
fn cheng_yong_is_judged() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().display().to_string();
    let arguments = [
        "reproduce",
        "cheng-yong",
        "--valence",
        "3..6",
        "--out",
        &out,
    ];
    let assert = subcert(&arguments).assert().code(0);
    let text = String::from_utf8(assert.get_output().stdout.clone()).expect("text");
    for part in ["Lemma 5", "Appendix D", "refuted", "98/85", "23/40"] {
        assert!(text.contains(part), "{part}");
    }
    assert_links(folder.path(), "cheng-yong.md");
    let json = fs::read_to_string(folder.path().join("cheng-yong.json")).expect("a file");
    let json: Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json["paper"], "cheng-yong");
    assert!(!folder.path().join("README.md").exists());
}

#[test]
fn all_papers_share_a_folder_and_an_index() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().display().to_string();
    let arguments = ["reproduce", "all", "--valence", "3..5", "--out", &out];
    let assert = subcert(&arguments).assert().code(0);
    let text = String::from_utf8(assert.get_output().stdout.clone()).expect("text");
    let summary = text.split("\nSummary\n").nth(1).expect("a summary");
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).expect(name);
    let all: Value = serde_json::from_str(&read("all.json")).expect("JSON");
    let papers = all["papers"].as_array().expect("papers");
    assert_links(folder.path(), "README.md");
    let index = read("README.md");
    let mut claims = 0;
    for paper in papers {
        let id = paper["paper"].as_str().expect("a name");
        assert!(summary.contains(id), "{id}");
        let alone: Value = serde_json::from_str(&read(&format!("{id}.json"))).expect("JSON");
        assert_eq!(&alone, paper);
        assert_links(folder.path(), &format!("{id}.md"));
        for claim in paper["claims"].as_array().expect("claims") {
            claims += 1;
            let (claim, verdict) = (&claim["id"], &claim["verdict"]);
            let row = format!("| {id} | {} |", claim.as_str().expect("a name"));
            let row = index
                .lines()
                .find(|line| line.starts_with(&row))
                .expect("a row");
            // Escaped bars aside, seven cells.
            assert_eq!(row.replace("\\|", "").matches(" | ").count(), 6, "{row}");
            assert!(row.contains(&format!("| {} |", verdict.as_str().expect("a word"))));
        }
    }
    let ids: Vec<&str> = papers.iter().filter_map(|p| p["paper"].as_str()).collect();
    assert_eq!(
        ids,
        ["huang-wang", "cheng-yong", "lanquetin-neveu", "peters-wu"]
    );
    let verdicts = all["verdicts"].as_object().expect("counts");
    let counted: u64 = verdicts.values().filter_map(Value::as_u64).sum();
    assert_eq!(counted, claims);
}

#[test]
fn bad_usage_is_refused() {
    for arguments in [
        &["reproduce", "huang-wang", "--valence", "2..4"][..],
        &["reproduce", "huang-wang", "--valence", "3..51"],
        &["reproduce", "cheng-yong", "--valence", "3..21"],
        &["reproduce", "lanquetin-neveu", "--valence", "3..21"],
        &["reproduce", "all", "--valence", "3..21"],
        &["reproduce", "no-such-paper"],
        &["reproduce"],
    ] {
        let assert = subcert(arguments).assert().code(2);
        assert!(assert.get_output().stdout.is_empty(), "{arguments:?}");
    }
}

#[test]
fn peters_wu_takes_meshes_of_triangles() {
    let refused = |arguments: &[&str], part: &str| {
        let assert = subcert(arguments).assert().code(2);
        let text = String::from_utf8(assert.get_output().stderr.clone()).expect("text");
        assert!(text.contains(part), "{text}");
        assert!(assert.get_output().stdout.is_empty());
    };
    let quads = "examples/meshes/bumpy_torus_quads.obj";
    refused(
        &["reproduce", "peters-wu", "--mesh", quads],
        "give a mesh of triangles",
    );
    refused(
        &["reproduce", "peters-wu", "--mesh", "no-such.obj"],
        "no-such.obj",
    );
    refused(
        &["reproduce", "cheng-yong", "--mesh", quads],
        "--mesh is for peters-wu",
    );
    refused(&["reproduce", "peters-wu", "--valence", "3..31"], "3..30");
}
