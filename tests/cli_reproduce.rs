//! `subcert reproduce` from outside.

use std::fs;

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

#[test]
fn bad_usage_is_refused() {
    for arguments in [
        &["reproduce", "huang-wang", "--valence", "2..4"][..],
        &["reproduce", "huang-wang", "--valence", "3..51"],
        &["reproduce", "no-such-paper"],
        &["reproduce"],
    ] {
        let assert = subcert(arguments).assert().code(2);
        assert!(assert.get_output().stdout.is_empty(), "{arguments:?}");
    }
}
