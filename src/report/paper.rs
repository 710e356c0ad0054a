//! An examined paper as text, Markdown and JSON, and as a folder with plots and certificates.

use std::fmt::Write as _;
use std::fs;
use std::io;
use std::path::Path;

use serde_json::{Map, Value, json as object};

use super::{picture, plots};
use crate::mesh::io::write_atomically;
use crate::paper::{Claim, Report, Table, Verdict};

/// Width of the text of claims.
const WIDTH: usize = 100;

/// Certificates that a text names before it counts.
const NAMED: usize = 3;

/// `3 sharp, 1 loose`: how many claims have which verdict.
pub fn summary(report: &Report) -> String {
    let counts = Verdict::ALL.map(|verdict| (report.count(verdict), verdict));
    let some = counts.iter().filter(|(count, _)| *count > 0);
    let texts: Vec<String> = some
        .map(|(count, verdict)| format!("{count} {verdict}"))
        .collect();
    texts.join(", ")
}

/// Aligned tables, then the claims.
pub fn text(report: &Report) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}\n{}\n", report.title, report.source);
    for paragraph in &report.preface {
        wrap(&mut out, "", "", paragraph);
    }
    for table in &report.tables {
        let _ = writeln!(out, "\n{}", table.title);
        aligned(&mut out, table);
        for note in &table.notes {
            wrap(&mut out, "  ", "  ", note);
        }
    }
    let _ = writeln!(out, "\n{} claims: {}", report.claims.len(), summary(report));
    for claim in &report.claims {
        let _ = writeln!(
            out,
            "\n{:<9} {}  ({})",
            claim.verdict, claim.id, claim.place
        );
        for (name, text) in parts(claim, NAMED) {
            wrap(&mut out, &format!("  {name:<10}"), &" ".repeat(12), &text);
        }
    }
    out
}

/// What is said of a claim, by name; at most so many certificates.
fn parts(claim: &Claim, named: usize) -> Vec<(&'static str, String)> {
    let mut parts = vec![("printed", claim.statement.clone())];
    if !claim.found.is_empty() {
        parts.push(("found", claim.found.clone()));
    }
    if let Some(method) = &claim.method {
        parts.push(("method", method.clone()));
    }
    if let Some(net) = &claim.counterexample {
        let points = net.net.join(", ");
        parts.push((
            "net",
            format!("n = {}: ({points}): {}", net.valence, net.what),
        ));
    }
    parts.push(("scope", claim.scope.clone()));
    if let Some(rest) = claim.certificates.len().checked_sub(1) {
        let shown = claim.certificates.iter().take(named);
        let shown: Vec<&str> = shown.map(String::as_str).collect();
        let more = (rest + 1).saturating_sub(named);
        let more = if more > 0 {
            format!(" and {more} more")
        } else {
            String::new()
        };
        parts.push(("proof", format!("{}{more}", shown.join(", "))));
    }
    parts
}

/// Words on lines of at most [`WIDTH`] characters.
fn wrap(out: &mut String, first: &str, rest: &str, text: &str) {
    let mut line = first.to_string();
    let mut empty = true;
    for word in text.split_whitespace() {
        let width = line.chars().count() + word.chars().count() + 1;
        if !empty && width > WIDTH {
            let _ = writeln!(out, "{line}");
            line = rest.to_string();
            empty = true;
        }
        if !empty {
            line.push(' ');
        }
        line += word;
        empty = false;
    }
    let _ = writeln!(out, "{line}");
}

/// The table in columns; numbers to the right, words to the left.
fn aligned(out: &mut String, table: &Table) {
    let cells = |column: usize| table.rows.iter().map(move |row| row[column].as_str());
    let columns = 0..table.heads.len();
    let width = |column: usize| {
        let longest = cells(column)
            .chain([table.heads[column]])
            .map(|c| c.chars().count());
        longest.max().unwrap_or(0)
    };
    let widths: Vec<usize> = columns.clone().map(width).collect();
    let numeric = |column: usize| {
        cells(column).all(|cell| !cell.chars().any(|c| c.is_alphabetic() && c != 'e'))
    };
    let right: Vec<bool> = columns.map(numeric).collect();
    let mut line = |row: &[&str]| {
        let mut text = String::new();
        for (column, cell) in row.iter().enumerate() {
            let width = widths[column];
            let _ = match right[column] {
                true => write!(text, "  {cell:>width$}"),
                false => write!(text, "  {cell:<width$}"),
            };
        }
        let _ = writeln!(out, "{}", text.trim_end());
    };
    line(&table.heads);
    for row in &table.rows {
        line(&row.iter().map(String::as_str).collect::<Vec<_>>());
    }
}

/// Markdown, with links to the plots and certificates of [`write_folder`].
pub fn markdown(report: &Report) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "# {}\n\n{}\n", report.title, report.source);
    for paragraph in &report.preface {
        let _ = writeln!(out, "{paragraph}\n");
    }
    let _ = writeln!(
        out,
        "{} claims: {}.\n",
        report.claims.len(),
        summary(report)
    );
    let _ = writeln!(out, "| verdict | meaning |\n|---|---|");
    for verdict in Verdict::ALL {
        let _ = writeln!(out, "| {verdict} | {} |", verdict.meaning());
    }
    let _ = writeln!(out, "\n## Tables");
    for table in &report.tables {
        let _ = writeln!(out, "\n### {}\n", table.title);
        let _ = writeln!(out, "| {} |", table.heads.join(" | "));
        let _ = writeln!(out, "|{}", "---|".repeat(table.heads.len()));
        for row in &table.rows {
            let cells: Vec<String> = row.iter().map(|cell| cell_markdown(cell)).collect();
            let _ = writeln!(out, "| {} |", cells.join(" | "));
        }
        for note in &table.notes {
            let _ = writeln!(out, "\n{note}");
        }
    }
    let _ = writeln!(out, "\n## Plots\n");
    for plot in &report.plots {
        let _ = writeln!(out, "![{}]({}.svg)\n", plot.title, plot.id);
    }
    for picture in &report.pictures {
        let _ = writeln!(out, "![{}]({}.svg)\n", picture.title, picture.id);
    }
    let _ = writeln!(out, "## Claims");
    for claim in &report.claims {
        let _ = writeln!(
            out,
            "\n### {} ({}): {}\n",
            claim.id, claim.place, claim.verdict
        );
        for (name, text) in parts(claim, 0) {
            if name != "proof" {
                let _ = writeln!(out, "- {name}: {text}");
            }
        }
        if !claim.certificates.is_empty() {
            let links: Vec<String> = claim.certificates.iter().map(|file| link(file)).collect();
            let _ = writeln!(out, "- certificates: {}", links.join(", "));
        }
    }
    out
}

/// A link to a certificate.
pub(super) fn link(file: &str) -> String {
    format!("[{}](certificates/{file})", file.trim_end_matches(".json"))
}

/// A cell: certificate files become links, bars are escaped.
fn cell_markdown(cell: &str) -> String {
    if cell.ends_with(".json") {
        return cell.split(' ').map(link).collect::<Vec<_>>().join(" ");
    }
    cell.replace('|', "\\|")
}

/// One object: tables by their heads, claims, plots.
pub fn json(report: &Report) -> Value {
    let table = |table: &Table| {
        let row = |row: &Vec<String>| {
            let cells = table.heads.iter().zip(row);
            let cells = cells.map(|(head, cell)| (head.to_string(), Value::from(cell.as_str())));
            Value::Object(cells.collect::<Map<_, _>>())
        };
        object!({
            "id": table.id,
            "title": table.title,
            "rows": table.rows.iter().map(row).collect::<Vec<_>>(),
            "notes": table.notes,
        })
    };
    let claim = |claim: &Claim| {
        let net = claim
            .counterexample
            .as_ref()
            .map(|net| object!({"valence": net.valence, "net": net.net, "what": net.what}));
        object!({
            "id": claim.id,
            "place": claim.place,
            "statement": claim.statement,
            "verdict": claim.verdict.name(),
            "found": claim.found,
            "method": claim.method,
            "scope": claim.scope,
            "counterexample": net,
            "certificates": claim.certificates,
        })
    };
    let plot = |plot: &crate::paper::Plot| {
        let series = plot
            .series
            .iter()
            .map(|s| object!({"name": s.name, "points": s.points}));
        object!({"id": plot.id, "title": plot.title, "series": series.collect::<Vec<_>>()})
    };
    let counts = Verdict::ALL.map(|v| (v.name().to_string(), Value::from(report.count(v))));
    object!({
        "paper": report.id,
        "title": report.title,
        "source": report.source,
        "verdicts": Value::Object(counts.into_iter().collect::<Map<_, _>>()),
        "tables": report.tables.iter().map(table).collect::<Vec<_>>(),
        "claims": report.claims.iter().map(claim).collect::<Vec<_>>(),
        "plots": report.plots.iter().map(plot).collect::<Vec<_>>(),
    })
}

/// Writes `ID.md`, `ID.json`, a plot `*.svg` each, and `certificates/*.json`.
///
/// # Errors
/// If a folder can't be made, or a file can't be drawn or written.
pub fn write_folder(folder: &Path, report: &Report) -> io::Result<()> {
    let certificates = folder.join("certificates");
    fs::create_dir_all(&certificates)?;
    let write = |name: String, text: String| {
        write_atomically(&folder.join(name), |out| out.write_all(text.as_bytes()))
    };
    write(format!("{}.md", report.id), markdown(report))?;
    let mut text = serde_json::to_string_pretty(&json(report))?;
    text.push('\n');
    write(format!("{}.json", report.id), text)?;
    for picture in &report.pictures {
        let drawn = picture::svg(picture).map_err(io::Error::other)?;
        write(format!("{}.svg", picture.id), drawn)?;
    }
    for plot in &report.plots {
        let drawn = plots::svg(plot).map_err(io::Error::other)?;
        write(format!("{}.svg", plot.id), drawn)?;
    }
    for (name, certificate) in &report.certificates {
        write_atomically(&certificates.join(name), |out| certificate.write(out))?;
    }
    Ok(())
}
