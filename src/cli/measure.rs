//! `subcert measure`.

use std::io::Write;
use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;
use clap::ValueEnum;
use subcert::distance::measure::{Measurement, Request, measure, measure_enclosing, measure_exact};
use subcert::distance::parametric::Goal;
use subcert::mesh::io;
use subcert::report::faces;
use subcert::report::measurement::{Text, json};

use super::exit::Outcome;
use super::progress::Progress;
use super::{AgainstName, SchemeArguments};

/// Measures a mesh.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples:\n  subcert measure examples/meshes/bumpy_torus_tri.obj --scheme loop --against control\n  \
        subcert measure examples/meshes/block_with_handle.obj --scheme catmull-clark --against limit --level 2 --faces error.ply\n\n\
        The distance is sup |S(u) - F(u)| over the surface S and the mesh F at the same parameter u.\n\
        Lengths are in the mesh's own unit; both ends are rounded outward. The gap counts as met where hi\n\
        is at the level of rounding errors (`noise` in the JSON). JSON and CSV count faces from 0."
)]
pub struct Measure {
    /// Mesh file: .obj, .off or .ply
    mesh: PathBuf,
    #[command(flatten)]
    scheme: SchemeArguments,
    /// Level of the mesh that the surface is compared with
    #[arg(long, value_name = "K", default_value_t = 0)]
    level: u32,
    /// Compare with the control mesh of that level, or with the same mesh at its limit positions
    #[arg(long, value_enum, default_value = "control")]
    against: AgainstName,
    /// Relative gap (hi - lo) / hi to reach
    #[arg(long, value_name = "REL", default_value_t = 1e-6, value_parser = gap)]
    gap: f64,
    /// Write the enclosure of every face: .csv, or .ply with scalars and colours
    #[arg(long, value_name = "OUT")]
    faces: Option<PathBuf>,
    /// Relative gap for every face by itself
    #[arg(long, value_name = "REL", default_value_t = 1e-2, value_parser = gap, requires = "faces")]
    face_gap: f64,
    /// Arithmetic: f64 with a proved rounding bound, intervals throughout, or exact rationals
    #[arg(long, value_enum, default_value = "float")]
    arithmetic: Arithmetic,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

/// What a claim is about, except in exact arithmetic.
const NEAREST: &str = "the f64 nearest to the decimals in the file";

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum Arithmetic {
    Float,
    Interval,
    Exact,
}

/// A gap must be a number in [0, 1).
fn gap(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(gap) if (0.0..1.0).contains(&gap) => Ok(gap),
        _ => Err("a gap is a number from 0 to below 1, such as 1e-6".into()),
    }
}

impl Measure {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let start = Instant::now();
        let (scheme, corner) = self.scheme.resolve()?;
        let request = Request {
            scheme,
            corner,
            level: self.level,
            against: self.against.into(),
            goal: Goal {
                gap: self.gap,
                face_gap: self.faces.as_ref().map(|_| self.face_gap),
                ..Goal::default()
            },
        };
        if let Some(path) = &self.faces {
            faces::Format::of_path(path)?;
        }
        if self.arithmetic != Arithmetic::Exact && self.gap < 1e-13 {
            bail!(
                "--gap {} is below what f64 can tell: use 1e-13 or more, or --arithmetic exact",
                self.gap
            );
        }
        let mesh = super::read(&self.mesh)?;
        super::check_size(&self.mesh, &mesh, self.level)?;
        let progress = Progress::new();
        let tell = |done, count| progress.faces(done, count);
        let (measurement, claim) = match self.arithmetic {
            Arithmetic::Exact => {
                let exact = io::read_exact(&self.mesh)?;
                let found = measure_exact(&exact.mesh, &request, &tell);
                let found = found.map_err(super::about(&self.mesh))?;
                (found, "the decimals in the file")
            }
            Arithmetic::Interval => {
                let found = measure_enclosing(&mesh, &request, &tell);
                (found.map_err(super::about(&self.mesh))?, NEAREST)
            }
            Arithmetic::Float => {
                let found = measure(&mesh, &request, &tell);
                (found.map_err(super::about(&self.mesh))?, NEAREST)
            }
        };
        progress.finish();
        if let (Some(path), Some(values)) = (&self.faces, &measurement.face_enclosures) {
            faces::write(path, &mesh, values, &request)?;
        }
        self.print(&request, &measurement, claim, start.elapsed().as_secs_f64())?;
        if measurement.met {
            return Ok(Outcome::Done);
        }
        eprintln!(
            "subcert: undecided: the gap asked for was not reached, but the enclosure holds; ask for a larger --gap, or use --arithmetic interval or exact"
        );
        Ok(Outcome::Undecided)
    }

    fn print(
        &self,
        request: &Request,
        found: &Measurement,
        claim: &str,
        seconds: f64,
    ) -> anyhow::Result<()> {
        let boundary = super::boundary_rule(request.scheme, request.corner);
        let text = Text {
            mesh: &self.mesh.display().to_string(),
            request,
            boundary,
            claim,
            found,
            seconds,
        };
        let mut out = std::io::stdout().lock();
        if self.json {
            serde_json::to_writer_pretty(&mut out, &json(&text))?;
            writeln!(out)?;
        } else {
            write!(out, "{text}")?;
        }
        out.flush()?;
        Ok(())
    }
}
