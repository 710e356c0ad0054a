//! Arguments and exit codes; the work is in the library.

use std::io::Write;
use std::path::Path;

use anyhow::{anyhow, bail};
use clap::{Parser, Subcommand, ValueEnum};
use subcert::distance::model::Against;
use subcert::mesh::Mesh;
use subcert::scalar::environment;
use subcert::scheme::{CornerRule, LoopWeights, Scheme};

use exit::Outcome;

mod bound;
pub mod exit;
mod hausdorff;
mod info;
mod measure;
mod predict;
mod progress;
mod refine;
mod reproduce;
mod spectrum;

/// Certified distances between subdivision surfaces and their meshes.
#[derive(Parser, Debug)]
#[command(
    version,
    max_term_width = 100,
    after_help = "Example:\n  subcert measure examples/meshes/bumpy_torus_tri.obj --scheme loop --against control\n\n\
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
    /// How many steps bring surface and mesh within a tolerance, by every method, without refining
    Predict(predict::Predict),
    /// Enclose bound constants, distance over the largest second difference, with certificates
    Bound(bound::Bound),
    /// Eigenvalues of a scheme at a vertex, and whether its characteristic map is injective
    Spectrum(spectrum::Spectrum),
    /// Judge every claim of a paper: printed, redone, sharp, verdict, certificate
    Reproduce(reproduce::Reproduce),
}

/// Prints one JSON object, or the text.
fn print(json: Option<impl serde::Serialize>, text: impl FnOnce() -> String) -> anyhow::Result<()> {
    let mut out = std::io::stdout().lock();
    match json {
        Some(json) => {
            serde_json::to_writer_pretty(&mut out, &json)?;
            writeln!(out)?;
        }
        None => write!(out, "{}", text())?,
    }
    out.flush()?;
    Ok(())
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
    /// No surface: the mesh itself, with `measure --other`
    None,
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

impl From<AgainstName> for subcert::bound::Against {
    fn from(name: AgainstName) -> Self {
        match name {
            AgainstName::Control => subcert::bound::Against::Control,
            AgainstName::Limit => subcert::bound::Against::Limit,
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
            (SchemeName::None, _) => {
                bail!(
                    "--scheme none has no surface: it goes with measure --other FILE and a Hausdorff distance only"
                )
            }
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
fn read(path: &Path) -> anyhow::Result<Mesh> {
    let loaded = subcert::mesh::io::read(path)?;
    warn(&loaded.warnings);
    Ok(loaded.mesh)
}

/// Bytes per corner of a face that a refined mesh takes while it is made, measured.
const BYTES_PER_CORNER: u64 = 24;

/// Refuses a level that cannot be held: each step makes four corners of one (on a closed mesh; never
/// more).
fn check_size(path: &Path, mesh: &Mesh, levels: u32) -> anyhow::Result<()> {
    let corners = u64::from(mesh.topology.halfedge_count());
    let refined = 4u64
        .checked_pow(levels)
        .and_then(|factor| factor.checked_mul(corners));
    let Some(refined) = refined.filter(|&count| count < 1 << 31) else {
        bail!(
            "{}: at level {levels} the mesh would have more than 2^31 corners of faces: ask for a lower level",
            path.display()
        );
    };
    let needed = refined * BYTES_PER_CORNER;
    if let Some(free) = free_memory().filter(|&free| needed > free) {
        bail!(
            "{}: level {levels} needs about {} MB of memory and {} MB are free: ask for a lower level",
            path.display(),
            needed >> 20,
            free >> 20
        );
    }
    Ok(())
}

/// Free memory in bytes, where the system tells (Linux).
fn free_memory() -> Option<u64> {
    let text = std::fs::read_to_string("/proc/meminfo").ok()?;
    let line = text
        .lines()
        .find_map(|line| line.strip_prefix("MemAvailable:"))?;
    let kilobytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kilobytes << 10)
}

/// Puts the mesh's name before a message about it.
fn about<E: std::fmt::Display>(path: &Path) -> impl Fn(E) -> anyhow::Error + '_ {
    move |error| anyhow!("{}: {error}", path.display())
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
            .map_err(|e| anyhow!("the threads can't be started ({e}): use a smaller --threads"))?;
    }
    match arguments.command {
        Command::Info(info) => info.run(),
        Command::Refine(refine) => refine.run(),
        Command::Measure(measure) => measure.run(),
        Command::Predict(predict) => predict.run(),
        Command::Bound(bound) => bound.run(),
        Command::Spectrum(spectrum) => spectrum.run(),
        Command::Reproduce(reproduce) => reproduce.run(),
    }
}
