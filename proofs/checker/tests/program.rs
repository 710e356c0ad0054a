//! The program: its arguments, what it prints, its exit codes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn run(arguments: &[&Path]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_subcert-check")).args(arguments).output().unwrap()
}

fn certificates() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/certificates")
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// An empty folder of this name for one test.
fn scratch(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn a_folder_of_certificates() {
    let output = run(&[&certificates()]);
    assert_eq!(output.status.code(), Some(0));
    let lines: Vec<String> = text(&output.stdout).lines().map(str::to_string).collect();
    assert_eq!(lines.len(), 37);
    assert!(lines[..36].iter().all(|line| line.ends_with(": verified")));
    assert!(lines[..36].is_sorted());
    assert_eq!(lines[36], "36 certificates: 36 verified, 0 rejected, 0 unreadable");
    let rate = lines.iter().find(|line| line.contains("/rate-original-6-1")).unwrap();
    for word in [
        "Loop",
        "original",
        "valence 6",
        "level 1",
        "r_1(6)",
        "second differences",
        "exactly 1/4 = 0.25",
    ] {
        assert!(rate.contains(word), "{rate}");
    }
}

#[test]
fn one_rejected_certificate() {
    let folder = scratch("rejected");
    let good = fs::read_to_string(certificates().join("rate-original-6-1.json")).unwrap();
    fs::create_dir(folder.join("below")).unwrap();
    fs::write(folder.join("below/good.json"), &good).unwrap();
    fs::write(folder.join("bad.json"), good.replace("\"1/4\"", "\"1/5\"")).unwrap();
    fs::write(folder.join("notes.txt"), "no certificate").unwrap();
    let output = run(&[&folder]);
    assert_eq!(output.status.code(), Some(1));
    let lines = text(&output.stdout);
    assert!(lines.contains("rejected: step 1, rule differences: word \"0\", difference 1: the weight: 0.25 is not shown to be at most 0.2"), "{lines}");
    assert!(lines.contains("2 certificates: 1 verified, 1 rejected, 0 unreadable"), "{lines}");
    // Rejected outweighs unreadable.
    assert_eq!(run(&[&folder, Path::new("/nowhere.json")]).status.code(), Some(1));
}

#[test]
fn nothing_to_verify() {
    let empty = scratch("empty");
    let good = certificates().join("rate-original-6-1.json");
    for arguments in [
        &[][..],
        &[&*empty],
        &[Path::new("/nowhere.json")],
        &[Path::new("--fast"), &good],
        &[&good, Path::new("/nowhere.json")],
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!output.stderr.is_empty());
    }
    let help = run(&[Path::new("--help")]);
    assert_eq!(help.status.code(), Some(0));
    assert!(text(&help.stdout).contains("Exit codes"));
}
