//! `subcert measure`.

use std::path::PathBuf;
use std::time::Instant;

use anyhow::bail;
use clap::ValueEnum;
use subcert::distance::hausdorff::{Facets, Side};
use subcert::distance::measure::{Measurement, Request, measure, measure_enclosing, measure_exact};
use subcert::distance::parametric::Goal;
use subcert::mesh::io;
use subcert::report::faces;
use subcert::report::measurement::{Text, json};

use super::exit::Outcome;
use super::progress::Progress;
use super::{AgainstName, SchemeArguments, SchemeName, hausdorff};

/// Measures a mesh.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples:\n  subcert measure examples/meshes/bumpy_torus_tri.obj --scheme loop --against control\n  \
        subcert measure examples/meshes/block_with_handle.obj --scheme catmull-clark --against limit --level 2 --faces error.ply\n  \
        subcert measure examples/meshes/bumpy_torus_tri.obj --scheme loop --distance hausdorff\n  \
        subcert measure a.obj --scheme none --other b.obj --distance surface-to-mesh --diagonal-gap 1e-6\n\n\
        The parametric distance is sup |S(u) - F(u)| over the surface S and the mesh F at the same parameter u.\n\
        One-sided Hausdorff distances are the largest distance of a point of the first set to the other\n\
        set; hausdorff is the larger of both sides. They end when hi - lo <= gap hi + diagonal-gap D,\n\
        D the diagonal of MESH's bounding box. With --other, MESH's surface (or MESH itself, with\n\
        --scheme none) is the first set and FILE the mesh.\n\
        Lengths are in the mesh's own unit; both ends are rounded outward. The gap counts as met where hi\n\
        is at the level of rounding errors (`noise` in the JSON). JSON and CSV count faces from 0."
)]
pub struct Measure {
    /// Mesh file: .obj, .off or .ply
    mesh: PathBuf,
    #[command(flatten)]
    scheme: SchemeArguments,
    /// The distance: over common parameters, or a Hausdorff distance, one-sided or symmetric
    #[arg(long, value_enum, default_value = "parametric")]
    distance: hausdorff::DistanceName,
    /// Another mesh to compare the surface with, for Hausdorff distances
    #[arg(long, value_name = "FILE", conflicts_with_all = ["level", "against"])]
    other: Option<PathBuf>,
    /// What a polygon of a mesh is for Hausdorff distances: bilinear (by quarters beyond quads), or a
    /// fan of triangles from its first corner [default: bilinear]
    #[arg(long, value_enum)]
    facets: Option<hausdorff::FacetsName>,
    /// Level of the mesh that the surface is compared with
    #[arg(long, value_name = "K", default_value_t = 0)]
    level: u32,
    /// Compare with the control mesh of that level, or with the same mesh at its limit positions
    #[arg(long, value_enum, default_value = "control")]
    against: AgainstName,
    /// Relative gap (hi - lo) / hi to reach [default: 1e-6; for Hausdorff distances 0]
    #[arg(long, value_name = "REL", value_parser = gap)]
    gap: Option<f64>,
    /// Gap to reach for Hausdorff distances, as a part of the bounding box's diagonal; it is added to
    /// that of --gap [default: 1e-4; 0 with --gap]
    #[arg(long, value_name = "REL", value_parser = gap)]
    diagonal_gap: Option<f64>,
    /// Stop a Hausdorff distance after this time, with the enclosure so far and exit code 3 if the
    /// gap is not reached. The enclosure holds, but its ends then depend on the machine
    #[arg(long, value_name = "SECONDS", value_parser = hausdorff::seconds)]
    budget: Option<f64>,
    /// Also write a proof of a Hausdorff distance for subcert-check, about the decimals in the file,
    /// with the relative gap of --gap [default: 0.02]; meshes of up to 2000 faces
    #[arg(long, value_name = "OUT.json")]
    certificate: Option<PathBuf>,
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
pub(super) const NEAREST: &str = "the f64 nearest to the decimals in the file";

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
        if let Some(side) = self.distance.side() {
            return self.hausdorff(side);
        }
        self.refuse_hausdorff_flags()?;
        let start = Instant::now();
        let gap = self.gap.unwrap_or(1e-6);
        let (scheme, corner) = self.scheme.resolve()?;
        let request = Request {
            scheme,
            corner,
            level: self.level,
            against: self.against.into(),
            goal: Goal {
                gap,
                face_gap: self.faces.as_ref().map(|_| self.face_gap),
                ..Goal::default()
            },
        };
        if let Some(path) = &self.faces {
            faces::Format::of_path(path)?;
        }
        if self.arithmetic != Arithmetic::Exact && gap < 1e-13 {
            bail!(
                "--gap {gap} is below what f64 can tell: use 1e-13 or more, or --arithmetic exact"
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

    /// Flags that the parametric distance has no use for.
    fn refuse_hausdorff_flags(&self) -> anyhow::Result<()> {
        let given = [
            ("--other", self.other.is_some()),
            ("--facets", self.facets.is_some()),
            ("--diagonal-gap", self.diagonal_gap.is_some()),
            ("--budget", self.budget.is_some()),
            ("--certificate", self.certificate.is_some()),
        ];
        if let Some((flag, _)) = given.iter().find(|(_, given)| *given) {
            bail!(
                "{flag} belongs to Hausdorff distances: leave it out, or use --distance hausdorff, surface-to-mesh or mesh-to-surface"
            );
        }
        Ok(())
    }

    fn hausdorff(&self, side: Side) -> anyhow::Result<Outcome> {
        if self.arithmetic != Arithmetic::Float {
            bail!(
                "Hausdorff distances are measured in f64 with a proved rounding bound: leave out --arithmetic"
            );
        }
        if self.faces.is_some() {
            bail!(
                "--faces holds parametric distances: leave it out; the faces that hold hi are printed"
            );
        }
        let query = hausdorff::Query {
            mesh: &self.mesh,
            other: self.other.as_deref(),
            scheme: (self.scheme.scheme != SchemeName::None).then_some(self.scheme),
            variants: self.scheme.weights.is_some() || self.scheme.corner.is_some(),
            level: self.level,
            against: self.against.into(),
            side,
            facets: self.facets.map_or(Facets::Bilinear, Into::into),
            gap: self.gap,
            diagonal_gap: self.diagonal_gap,
            budget: self.budget,
            json: self.json,
            certificate: self.certificate.as_deref(),
        };
        query.run()
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
        super::print(self.json.then(|| json(&text)), || text.to_string())
    }
}
