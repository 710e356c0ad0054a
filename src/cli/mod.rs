//! Arguments and exit codes; the work is in the library.

use std::path::PathBuf;

use anyhow::{Context, bail};
use clap::{Parser, Subcommand, ValueEnum};
use subcert::distance::model::Against;
use subcert::scalar::environment;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

use exit::Outcome;

pub mod exit;
mod info;
mod measure;
mod progress;
mod refine;

/// Certified distances between subdivision surfaces and their meshes.
#[derive(Parser, Debug)]
#[command(
    version,
    max_term_width = 100,
    after_help = "Example:\n  subcert measure examples/meshes/bumpy_torus.obj --scheme loop --against control\n\n\
        Exit codes: 0 done, 1 refuted or rejected, 2 bad usage or input, 3 undecided."
)]
pub struct Arguments {
    /// Number of threads; results don't depend on it [default: all cores]
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Count a mesh's parts: faces, valences, boundary loops, extraordinary vertices
    Info(info::Info),
    /// Refine a mesh by subdivision and write it
    Refine(refine::Refine),
    /// Enclose the distance between the subdivision surface and its control or limit mesh
    Measure(measure::Measure),
}

/// The scheme and its variants.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct SchemeArguments {
    /// The subdivision scheme
    #[arg(long, value_enum)]
    scheme: SchemeName,
    /// Vertex weights of Loop's scheme: those of Loop 1987, or Warren's 3/(8n) [default: original]
    #[arg(long, value_enum)]
    weights: Option<WeightsName>,
    /// What boundary vertices with a single face do under Loop and Catmull-Clark: follow the
    /// boundary curve, or stay [default: smooth]
    #[arg(long, value_enum)]
    corner: Option<CornerName>,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum SchemeName {
    Loop,
    CatmullClark,
    DooSabin,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum WeightsName {
    Original,
    Warren,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum CornerName {
    Smooth,
    Sharp,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum AgainstName {
    Control,
    Limit,
}

impl From<AgainstName> for Against {
    fn from(name: AgainstName) -> Self {
        match name {
            AgainstName::Control => Against::Control,
            AgainstName::Limit => Against::Limit,
        }
    }
}

impl SchemeArguments {
    /// The scheme and corner rule, or why the flags don't go together.
    fn resolve(&self) -> anyhow::Result<(Scheme, CornerRule)> {
        if self.weights.is_some() && self.scheme != SchemeName::Loop {
            bail!("--weights belongs to Loop's scheme: leave it out, or use --scheme loop");
        }
        if self.corner.is_some() && self.scheme == SchemeName::DooSabin {
            bail!(
                "--corner has no meaning for Doo-Sabin, which has no boundary rule: leave it out"
            );
        }
        let scheme = match (self.scheme, self.weights) {
            (SchemeName::Loop, Some(WeightsName::Warren)) => Scheme::Loop(LoopWeights::Warren),
            (SchemeName::Loop, _) => Scheme::Loop(LoopWeights::Original),
            (SchemeName::CatmullClark, _) => Scheme::CatmullClark,
            (SchemeName::DooSabin, _) => Scheme::DooSabin,
        };
        let corner = match self.corner {
            Some(CornerName::Sharp) => CornerRule::Sharp,
            _ => CornerRule::Smooth,
        };
        Ok((scheme, corner))
    }
}

/// The boundary rule in force, in words.
fn boundary_rule(scheme: Scheme, corner: CornerRule) -> &'static str {
    match (scheme, corner) {
        (Scheme::DooSabin, _) => {
            "none (the surface is the union of the quarters at interior vertices)"
        }
        (_, CornerRule::Smooth) => "cubic B-spline, one-face corners smooth",
        (_, CornerRule::Sharp) => "cubic B-spline, one-face corners sharp",
    }
}

/// Reads a mesh and tells its warnings.
fn read(path: &PathBuf) -> anyhow::Result<subcert::mesh::Mesh> {
    let loaded = subcert::mesh::io::read(path)?;
    warn(&loaded.warnings);
    Ok(loaded.mesh)
}

fn warn(warnings: &[String]) {
    for warning in warnings {
        eprintln!("subcert: warning: {warning}");
    }
}

/// Runs a command.
///
/// # Errors
/// With one sentence for the user.
pub fn run(arguments: Arguments) -> anyhow::Result<Outcome> {
    environment::verify_floating_point()?;
    if let Some(threads) = arguments.threads {
        rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(threads))
            .build_global()
            .context("the threads can't be started: use a smaller --threads")?;
    }
    match arguments.command {
        Command::Info(info) => info.run(),
        Command::Refine(refine) => refine.run(),
        Command::Measure(measure) => measure.run(),
    }
}
