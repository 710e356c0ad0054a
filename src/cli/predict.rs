//! `subcert predict`.

use std::path::PathBuf;
use std::str::FromStr;
use std::time::Instant;

use anyhow::bail;
use clap::ValueEnum;
use subcert::depth::{self, Answer, Method, Metric, Request};
use subcert::mesh::Mesh;
use subcert::report::depth::{Text, json};
use subcert::report::faces;

use super::exit::Outcome;
use super::measure::NEAREST;
use super::{AgainstName, SchemeArguments};

/// Predicts subdivision depths.
#[derive(clap::Args, Debug)]
#[command(
    after_help = "Examples:\n  subcert predict examples/meshes/bumpy_torus_tri.obj --scheme loop --tolerance 1e-3 --relative\n  \
        subcert predict examples/meshes/block_with_handle.obj --scheme catmull-clark --tolerance 0.01 --method all\n  \
        subcert predict examples/meshes/mixed_patch.obj --scheme catmull-clark --tolerance 0.01 --method subcert-2 --faces depth.ply\n\n\
        The depth is a number of steps after which the distance between surface and mesh is at most EPS. It is\n\
        safe if that is proved, for the numbers in the file and the metric asked; every answer says on what it\n\
        rests. Nothing is refined but, locally, by methods whose name ends in a number of subdivisions.\n\n\
        Methods:\n  \
        heuristic            the largest distance of a vertex to its limit; no bound of anything\n  \
        lanquetin-neveu      Corollaries 2 (catmull-clark), 3 (loop) and 5 (doo-sabin), as printed\n  \
        cheng-yong           Theorem 9 (catmull-clark), as printed\n  \
        huang                (16) of Huang & Wang with C_3 (loop, control mesh), as printed\n  \
        huang-wang           (14) with beta (loop, limit mesh), as printed\n  \
        tab-approx-0, -1, -2 Peters & Wu (loop, control mesh): points of the surface to the mesh only\n  \
        tab-eigen-0, -1, -2  the same from eigenvalues\n  \
        tab-interp-0, -1, -2 the same to the limit mesh\n  \
        subcert-0, -1, -2    certified constants, any mesh and scheme\n  \
        best                 the least depth among those that are safe\n  \
        all                  a table of all\n\n\
        Claims such as `lanquetin-neveu corollary-3` are those of `subcert reproduce`."
)]
pub struct Predict {
    /// Mesh file: .obj, .off or .ply
    mesh: PathBuf,
    #[command(flatten)]
    scheme: SchemeArguments,
    /// What the distance may be at most, in the mesh's own unit
    #[arg(long, value_name = "EPS", value_parser = tolerance, allow_negative_numbers = true)]
    tolerance: f64,
    /// EPS is a part of the bounding box's diagonal
    #[arg(long)]
    relative: bool,
    /// Distance to control meshes, or to the same meshes at their limit positions
    #[arg(long, value_enum, default_value = "control")]
    to: AgainstName,
    /// The distance: over common parameters, from points of the surface to the mesh, or the larger of both
    /// one-sided Hausdorff distances
    #[arg(long, value_enum, default_value = "parametric")]
    metric: MetricName,
    /// A method, `best` or `all`
    #[arg(long, value_name = "NAME", default_value = "best")]
    method: Asked,
    /// Write how many steps every face asks for by itself, by subcert-0, -1 or -2: .csv, or .ply with
    /// colours
    #[arg(long, value_name = "OUT")]
    faces: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
enum MetricName {
    Parametric,
    SurfaceToMesh,
    Hausdorff,
}

impl From<MetricName> for Metric {
    fn from(name: MetricName) -> Self {
        match name {
            MetricName::Parametric => Metric::Parametric,
            MetricName::SurfaceToMesh => Metric::SurfaceToMesh,
            MetricName::Hausdorff => Metric::Hausdorff,
        }
    }
}

/// What `--method` asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Asked {
    Best,
    All,
    One(Method),
}

impl FromStr for Asked {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        match name {
            "best" => Ok(Asked::Best),
            "all" => Ok(Asked::All),
            _ => match name.parse() {
                Ok(method) => Ok(Asked::One(method)),
                Err(error) => Err(format!("{error}, best or all")),
            },
        }
    }
}

/// A tolerance must be a positive, finite number.
fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(tolerance) if tolerance > 0.0 && tolerance.is_finite() => Ok(tolerance),
        _ => Err("a tolerance is a positive number, such as 1e-3".into()),
    }
}

impl Predict {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        let start = Instant::now();
        let (scheme, corner) = self.scheme.resolve()?;
        let mut request = Request {
            scheme,
            corner,
            against: self.to.into(),
            metric: self.metric.into(),
            tolerance: self.tolerance,
        };
        if let Asked::One(method) = self.method
            && let Err(why) = method.applies(&request)
        {
            bail!("--method {method} does not apply: {why}; use another one, or best");
        }
        self.check_faces()?;
        let mesh = super::read(&self.mesh)?;
        if self.relative {
            request.tolerance = self.of_diagonal(&mesh)?;
        }
        let methods = match self.method {
            Asked::Best => Method::candidates(&request, &mesh.topology),
            Asked::All => Method::all(),
            Asked::One(method) => vec![method],
        };
        let mut answers =
            depth::predict(&mesh, &request, &methods).map_err(super::about(&self.mesh))?;
        let best = depth::best(&answers).cloned();
        if let Some(path) = &self.faces {
            let steps = finest(&answers);
            let depths = depth::differences::face_depths(&mesh, &request, steps)
                .map_err(super::about(&self.mesh))?;
            faces::write_depths(path, &mesh, &depths)?;
        }
        if self.method == Asked::Best {
            answers.retain(|answer| Some(answer) == best.as_ref());
        }
        let undecided = answers.iter().all(|answer| answer.depth.is_none());
        let reason = answers.first().map(|answer| answer.why.clone());
        let text = Text {
            mesh: &self.mesh.display().to_string(),
            request: &request,
            relative: self.relative.then_some(self.tolerance),
            boundary: super::boundary_rule(scheme, corner),
            claim: NEAREST,
            best: best.as_ref(),
            answers: &answers,
            seconds: start.elapsed().as_secs_f64(),
        };
        super::print(self.json.then(|| json(&text)), || text.to_string())?;
        if !undecided {
            return Ok(Outcome::Done);
        }
        match reason {
            Some(why) => eprintln!(
                "subcert: undecided: no depth: {why}; use another --method, or a larger --tolerance"
            ),
            None => eprintln!(
                "subcert: undecided: no safe method proves a depth for this tolerance; ask for a larger --tolerance"
            ),
        }
        Ok(Outcome::Undecided)
    }

    /// The tolerance as a part of the bounding box's diagonal.
    fn of_diagonal(&self, mesh: &Mesh) -> anyhow::Result<f64> {
        let [low, high] = mesh.bounding_box();
        let [x, y, z] = [0, 1, 2].map(|i| high[i] - low[i]);
        let tolerance = self.tolerance * x.hypot(y).hypot(z);
        if tolerance > 0.0 && tolerance.is_finite() {
            return Ok(tolerance);
        }
        bail!(
            "{}: --relative gives the tolerance {tolerance}: leave it out and give --tolerance in the mesh's own unit",
            self.mesh.display()
        )
    }

    /// Whether the file for faces can be written.
    fn check_faces(&self) -> anyhow::Result<()> {
        let Some(path) = &self.faces else {
            return Ok(());
        };
        faces::Format::of_path(path)?;
        match self.method {
            Asked::One(method) if !matches!(method, Method::Differences(_)) => bail!(
                "--faces holds the depths of subcert-0, -1 or -2, and --method {method} has none: use one of them, or best"
            ),
            _ => Ok(()),
        }
    }
}

/// The local subdivisions of the best of our own answers, or none.
fn finest(answers: &[Answer]) -> u32 {
    let own = answers
        .iter()
        .filter(|answer| matches!(answer.method, Method::Differences(_)));
    let own: Vec<Answer> = own.cloned().collect();
    match depth::best(&own)
        .or(own.first())
        .map(|answer| answer.method)
    {
        Some(Method::Differences(steps)) => steps,
        _ => 0,
    }
}
