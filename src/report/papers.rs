//! Several examined papers: one summary, one index, one folder.

use std::fmt::Write as _;
use std::io;
use std::path::Path;

use serde_json::{Map, Value, json as object};

use super::paper;
use crate::mesh::io::write_atomically;
use crate::paper::{Claim, Report, Verdict};

/// Certificates that a row links before it counts.
const LINKED: usize = 3;

/// The reports one after the other, then how many claims have which verdict.
pub fn text(reports: &[Report]) -> String {
    let mut out = String::new();
    for report in reports {
        let _ = writeln!(out, "{}\n", paper::text(report));
    }
    let _ = writeln!(out, "Summary");
    let width = reports.iter().map(|r| r.id.len()).max().unwrap_or(0);
    for report in reports {
        let (id, count) = (report.id, report.claims.len());
        let summary = paper::summary(report);
        let _ = writeln!(out, "  {id:<width$}  {count:>3} claims: {summary}");
    }
    out
}

/// How many claims of all have which verdict.
fn counts(reports: &[Report]) -> [(Verdict, usize); 6] {
    Verdict::ALL.map(|verdict| (verdict, reports.iter().map(|r| r.count(verdict)).sum()))
}

/// One table over all claims of all papers, with links to their reports and certificates.
pub fn markdown(reports: &[Report]) -> String {
    let mut out = String::from(
        "# Papers, claim by claim\n\nEvery verdict is computed; a certificate is checked by `subcert-check`.\n\n",
    );
    let _ = writeln!(
        out,
        "| paper | claims | {} |",
        Verdict::ALL.map(Verdict::name).join(" | ")
    );
    let _ = writeln!(out, "|---|---|{}", "---|".repeat(Verdict::ALL.len()));
    for report in reports {
        let counts = Verdict::ALL.map(|verdict| report.count(verdict).to_string());
        let (id, title) = (report.id, report.title);
        let (claims, counts) = (report.claims.len(), counts.join(" | "));
        let _ = writeln!(out, "| [{id}]({id}.md): {title} | {claims} | {counts} |");
    }
    let _ = writeln!(out, "\n| verdict | meaning |\n|---|---|");
    for verdict in Verdict::ALL {
        let _ = writeln!(out, "| {verdict} | {} |", verdict.meaning());
    }
    let heads = [
        "paper",
        "claim",
        "place",
        "printed",
        "ours",
        "verdict",
        "certificates",
    ];
    let _ = writeln!(
        out,
        "\n| {} |\n|{}",
        heads.join(" | "),
        "---|".repeat(heads.len())
    );
    for report in reports {
        for claim in &report.claims {
            let _ = writeln!(out, "| {} |", row(report, claim).join(" | "));
        }
    }
    out
}

fn row(report: &Report, claim: &Claim) -> [String; 7] {
    let cell = |text: &str| text.replace('|', "\\|").replace('\n', " ");
    let links = claim.certificates.iter().take(LINKED);
    let mut certificates: Vec<String> = links.map(|file| paper::link(file)).collect();
    if let Some(more) = claim.certificates.len().checked_sub(LINKED + 1) {
        certificates.push(format!("and {} more", more + 1));
    }
    let ours = match &claim.method {
        Some(method) => format!("{}. Method: {method}", claim.found),
        None => claim.found.clone(),
    };
    [
        report.id.into(),
        claim.id.into(),
        cell(claim.place),
        cell(&claim.statement),
        cell(&ours),
        claim.verdict.to_string(),
        match certificates.is_empty() {
            true => "-".into(),
            false => certificates.join(", "),
        },
    ]
}

/// One object with the object of each paper.
pub fn json(reports: &[Report]) -> Value {
    let verdicts = counts(reports).map(|(v, count)| (v.name().to_string(), Value::from(count)));
    object!({
        "verdicts": Value::Object(verdicts.into_iter().collect::<Map<_, _>>()),
        "papers": reports.iter().map(paper::json).collect::<Vec<_>>(),
    })
}

/// Writes the files of each paper, with one folder of certificates, and `README.md` and `all.json` over all.
///
/// # Errors
/// If a folder can't be made, or a file can't be drawn or written.
pub fn write_folder(folder: &Path, reports: &[Report]) -> io::Result<()> {
    for report in reports {
        paper::write_folder(folder, report)?;
    }
    let write = |name: &str, text: String| {
        write_atomically(&folder.join(name), |out| out.write_all(text.as_bytes()))
    };
    write("README.md", markdown(reports))?;
    let mut text = serde_json::to_string_pretty(&json(reports))?;
    text.push('\n');
    write("all.json", text)
}
