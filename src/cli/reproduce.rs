//! `subcert reproduce`.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::ValueEnum;
use subcert::paper::huang_wang_2008;
use subcert::report::paper;

use super::bound::Range;
use super::exit::Outcome;
use super::progress::Progress;

/// Judges every claim of a paper.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  subcert reproduce huang-wang\n  \
        subcert reproduce huang-wang --valence 3..10 --out huang-wang\n\n\
        Each printed number stands beside the paper's own method redone exactly and the sharp value, with\n\
        a verdict that is computed: sharp, true, loose, misprint, refuted or undecided. --out writes\n\
        DIR/huang-wang.md and .json, plots as .svg, and DIR/certificates for subcert-check. Refuted claims\n\
        are results: the exit code is 0.")]
pub struct Reproduce {
    /// Which paper
    #[arg(value_enum)]
    paper: PaperName,
    /// Valences to decide the claims for: 7 or 3..10 (both ends included); tables show those printed
    #[arg(long, value_name = "A..B", default_value = "3..10")]
    valence: Range,
    /// Write the same as Markdown, JSON, plots and certificates into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum PaperName {
    /// Huang & Wang 2008, on Loop surfaces and their limit meshes
    HuangWang,
}

/// Largest valence: the paper's own investigation ends there.
const LARGEST_VALENCE: u32 = huang_wang_2008::printed::INVESTIGATED.1;

impl Reproduce {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let PaperName::HuangWang = self.paper;
        if self.valence.first < 3 || self.valence.last > LARGEST_VALENCE {
            bail!("--valence must lie in 3..{LARGEST_VALENCE}: the paper is about these valences");
        }
        let valences: Vec<u32> = (self.valence.first..=self.valence.last).collect();
        let progress = Progress::new();
        let tell = |done, count| progress.units(done, count, "valences");
        let report = huang_wang_2008::examine(&valences, &tell)?;
        progress.finish();
        if let Some(folder) = &self.out {
            paper::write_folder(folder, &report).with_context(|| {
                format!(
                    "the report can't be written to {}: name a folder that can be written",
                    folder.display()
                )
            })?;
        }
        let mut out = std::io::stdout().lock();
        if self.json {
            serde_json::to_writer_pretty(&mut out, &paper::json(&report))?;
            writeln!(out)?;
        } else {
            write!(out, "{}", paper::text(&report))?;
        }
        out.flush()?;
        Ok(Outcome::Done)
    }
}
