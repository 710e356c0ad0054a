//! `subcert measure --distance surface-to-mesh | mesh-to-surface | hausdorff`.

use std::path::Path;
use std::time::{Duration, Instant};

use anyhow::bail;
use clap::ValueEnum;
use subcert::distance::certify;
use subcert::distance::hausdorff::{
    Facets, Goal, Measurement, Request, Side, measure, mesh_to_mesh,
};
use subcert::distance::model::Against;
use subcert::mesh::io;
use subcert::report::hausdorff::{First, Second, Text, json};
use subcert::scheme::{CornerRule, Scheme};

use super::SchemeArguments;
use super::exit::Outcome;
use super::progress::Progress;

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum DistanceName {
    /// sup |S(u) - F(u)|
    Parametric,
    /// The largest distance of a surface point to the mesh
    SurfaceToMesh,
    /// The largest distance of a mesh point to the surface
    MeshToSurface,
    /// The larger of both
    Hausdorff,
}

impl DistanceName {
    pub fn side(self) -> Option<Side> {
        match self {
            DistanceName::Parametric => None,
            DistanceName::SurfaceToMesh => Some(Side::SurfaceToMesh),
            DistanceName::MeshToSurface => Some(Side::MeshToSurface),
            DistanceName::Hausdorff => Some(Side::Both),
        }
    }
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum FacetsName {
    Bilinear,
    Triangles,
}

impl From<FacetsName> for Facets {
    fn from(name: FacetsName) -> Self {
        match name {
            FacetsName::Bilinear => Facets::Bilinear,
            FacetsName::Triangles => Facets::Triangles,
        }
    }
}

/// A time must be a positive number of seconds.
pub fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if (0.0..1e9).contains(&seconds) => Ok(seconds),
        _ => Err("a budget is a number of seconds below 1e9, such as 2.5".into()),
    }
}

/// Relative gap of a proof, if none is asked for.
const PROOF_GAP: f64 = 0.02;

/// What was asked.
pub struct Query<'a> {
    pub mesh: &'a Path,
    pub other: Option<&'a Path>,
    /// `None` for the mesh itself.
    pub scheme: Option<SchemeArguments>,
    /// Whether a variant of a scheme was named.
    pub variants: bool,
    pub level: u32,
    pub against: Against,
    pub side: Side,
    pub facets: Facets,
    pub gap: Option<f64>,
    pub diagonal_gap: Option<f64>,
    pub budget: Option<f64>,
    pub json: bool,
    /// Where to write a proof.
    pub certificate: Option<&'a Path>,
}

impl Query<'_> {
    fn goal(&self) -> anyhow::Result<Goal> {
        let gap = self.gap.unwrap_or(0.0);
        let absent = if self.gap.is_some() { 0.0 } else { 1e-4 };
        let diagonal_gap = self.diagonal_gap.unwrap_or(absent);
        if gap + diagonal_gap < 1e-13 {
            bail!(
                "--gap {gap} and --diagonal-gap {diagonal_gap} are below what f64 can tell: use 1e-13 or more for one of them"
            );
        }
        Ok(Goal {
            diagonal_gap,
            gap,
            budget: self.budget.map(Duration::from_secs_f64),
        })
    }

    pub fn run(&self) -> anyhow::Result<Outcome> {
        let start = Instant::now();
        let goal = self.goal()?;
        let scheme = self.scheme.map(|s| s.resolve()).transpose()?;
        if scheme.is_none() && self.variants {
            bail!("--weights and --corner belong to a scheme: leave them out with --scheme none");
        }
        if scheme.is_none() && self.certificate.is_some() {
            bail!("--certificate is about a limit surface: name a --scheme, or leave it out");
        }
        if scheme.is_none() && self.other.is_none() {
            bail!("--scheme none compares MESH with another mesh: name it with --other FILE");
        }
        let mesh = super::read(self.mesh)?;
        let other = self.other.map(super::read).transpose()?;
        if other.is_none() {
            super::check_size(self.mesh, &mesh, self.level)?;
        }
        let progress = Progress::new();
        let tell = |done, count| progress.faces(done, count);
        let found = match (scheme, &other) {
            (Some((scheme, corner)), _) => {
                let request = Request {
                    scheme,
                    corner,
                    level: self.level,
                    against: self.against,
                    side: self.side,
                    facets: self.facets,
                    goal,
                };
                measure(&mesh, other.as_ref(), &request, &tell)
            }
            (None, other) => {
                let other = other.as_ref().unwrap_or(&mesh);
                mesh_to_mesh(&mesh, other, self.side, self.facets, goal, &tell)
            }
        };
        let found = found.map_err(super::about(self.mesh))?;
        progress.finish();
        let boundary = scheme.map(|(scheme, corner)| super::boundary_rule(scheme, corner));
        let first = match (scheme, boundary) {
            (Some((scheme, _)), Some(boundary)) => First::Surface { scheme, boundary },
            _ => First::Mesh,
        };
        self.print(first, goal, &found, start.elapsed().as_secs_f64())?;
        if let (Some(path), Some((scheme, corner))) = (self.certificate, scheme) {
            self.certify(path, scheme, corner)?;
        }
        if found.met {
            return Ok(Outcome::Done);
        }
        eprintln!(
            "subcert: undecided: the gap asked for was not reached, but the enclosure holds; ask for a larger --gap or --diagonal-gap, or a longer --budget"
        );
        Ok(Outcome::Undecided)
    }

    /// Writes a proof about the decimals in the files.
    fn certify(&self, path: &Path, scheme: Scheme, corner: CornerRule) -> anyhow::Result<()> {
        let mesh = io::read_exact(self.mesh)?.mesh;
        let other = self
            .other
            .map(io::read_exact)
            .transpose()?
            .map(|loaded| loaded.mesh);
        let request = certify::Request {
            scheme,
            boundary: match corner {
                CornerRule::Smooth => certify::Boundary::Smooth,
                CornerRule::Sharp => certify::Boundary::Sharp,
            },
            level: self.level,
            flat: match (&other, self.against) {
                (Some(other), _) => certify::Flat::Other(other),
                (None, Against::Control) => certify::Flat::Control,
                (None, Against::Limit) => certify::Flat::Limit,
            },
            facets: self.facets,
            side: self.side,
            gap: self.gap.unwrap_or(PROOF_GAP),
            vertices: false,
        };
        let proof = certify::certify(&mesh, &request, None).map_err(super::about(self.mesh))?;
        io::write_file(path, |out| proof.write(out))?;
        eprintln!(
            "subcert: wrote {}; check it with: subcert-check {0}",
            path.display()
        );
        Ok(())
    }

    fn print(
        &self,
        first: First<'_>,
        goal: Goal,
        found: &Measurement,
        seconds: f64,
    ) -> anyhow::Result<()> {
        let other = self.other.map(|path| path.display().to_string());
        let second = match &other {
            Some(name) => Second::Other(name),
            None => Second::Own {
                level: self.level,
                against: self.against,
            },
        };
        let text = Text {
            mesh: &self.mesh.display().to_string(),
            first,
            second,
            side: self.side,
            facets: self.facets,
            goal,
            claim: super::measure::NEAREST,
            found,
            seconds,
        };
        super::print(self.json.then(|| json(&text)), || text.to_string())
    }
}
