//! The dependency graph drawn in ARCHITECTURE.md, held against the `use` lines of the source.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms that each room may use: the lines `room -> a, b, c` of ARCHITECTURE.md.
fn drawn() -> BTreeMap<String, BTreeSet<String>> {
    let text = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("ARCHITECTURE.md");
    let mut graph = BTreeMap::new();
    let block = text
        .split("```graph")
        .nth(1)
        .and_then(|t| t.split("```").next())
        .expect("a graph block");
    for line in block.lines().filter(|line| line.contains("->")) {
        let (room, used) = line.split_once("->").expect("an arrow");
        let used = used
            .split(',')
            .map(|r| r.trim().to_string())
            .filter(|r| !r.is_empty())
            .collect();
        graph.insert(room.trim().to_string(), used);
    }
    graph
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            files(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// The first part of every `crate::x` and, in the binary, `subcert::x` in a file, comments aside.
fn uses(text: &str, prefix: &str) -> BTreeSet<String> {
    let code = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or(""));
    let code: String = code.collect::<Vec<_>>().join("\n");
    let mut found = BTreeSet::new();
    let is_word = |c: char| c.is_alphanumeric() || c == '_';
    for (at, _) in code.match_indices(prefix) {
        if code[..at].chars().next_back().is_some_and(is_word) {
            continue;
        }
        let rest = &code[at + prefix.len()..];
        if let Some(list) = rest.strip_prefix('{') {
            // A grouped import: the first word after `{` and after each comma of depth 0.
            let (mut depth, mut item) = (0, String::new());
            for c in list.chars() {
                match c {
                    '{' => depth += 1,
                    '}' if depth == 0 => break,
                    '}' => depth -= 1,
                    ',' if depth == 0 => {
                        found.insert(item.trim().split("::").next().unwrap_or("").to_string());
                        item.clear();
                        continue;
                    }
                    _ => {}
                }
                item.push(c);
            }
            found.insert(item.trim().split("::").next().unwrap_or("").to_string());
        } else {
            found.insert(rest.chars().take_while(|&c| is_word(c)).collect());
        }
    }
    found.retain(|room| !room.is_empty());
    found
}

#[test]
fn every_use_line_is_an_arrow_of_the_graph() {
    let graph = drawn();
    let source = root().join("src");
    let mut paths = Vec::new();
    files(&source, &mut paths);
    let (mut arrows, mut seen) = (BTreeSet::new(), BTreeSet::new());
    for path in &paths {
        let relative = path.strip_prefix(&source).expect("below src");
        let room = relative
            .components()
            .next()
            .expect("a name")
            .as_os_str()
            .to_string_lossy();
        let room = room.trim_end_matches(".rs").to_string();
        if room == "lib" || room == "main" {
            continue;
        }
        let allowed = graph
            .get(&room)
            .unwrap_or_else(|| panic!("{room} is not in ARCHITECTURE.md"));
        seen.insert(room.clone());
        let text = fs::read_to_string(path).expect("a source file");
        let prefix = if room == "cli" {
            "subcert::"
        } else {
            "crate::"
        };
        for used in uses(&text, prefix) {
            if used != room && graph.contains_key(&used) {
                assert!(
                    allowed.contains(&used),
                    "{}: {room} uses {used}, which the graph forbids",
                    path.display()
                );
                arrows.insert((room.clone(), used));
            }
        }
    }
    // No arrow without a use, no room without a file, and no cycle.
    for (room, used) in &graph {
        assert!(seen.contains(room), "{room} is drawn but has no file");
        for other in used {
            assert!(
                arrows.contains(&(room.clone(), other.clone())),
                "{room} -> {other} is drawn but unused"
            );
        }
    }
    let mut placed: BTreeSet<&String> = BTreeSet::new();
    while placed.len() < graph.len() {
        let next = graph
            .iter()
            .find(|(room, used)| !placed.contains(room) && used.iter().all(|u| placed.contains(u)));
        placed.insert(next.expect("the graph has a cycle").0);
    }
}

#[test]
fn grouped_and_plain_uses_are_seen() {
    let text =
        "use crate::{a::b, c::{d, e}, f};\n// crate::no\nlet x = crate::g::h(); mycrate::z();";
    assert_eq!(
        uses(text, "crate::").into_iter().collect::<Vec<_>>(),
        ["a", "c", "f", "g"]
    );
}
