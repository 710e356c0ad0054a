//! `subcert reproduce`.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::ValueEnum;
use subcert::depth::study::{self, Subject};
use subcert::mesh::io;
use subcert::paper::peters_wu::{self, meshes::StandIn};
use subcert::paper::{Report, cheng_yong, huang_wang_2008, lanquetin_neveu_2004};
use subcert::report::{paper, papers};
use subcert::scheme::{LoopWeights, Scheme};

use super::bound::Range;
use super::exit::Outcome;
use super::progress::Progress;

/// Judges every claim of a paper, or of all.
#[derive(clap::Args, Debug)]
#[command(after_help = "Examples:\n  subcert reproduce huang-wang\n  \
        subcert reproduce cheng-yong --valence 3..12\n  \
        subcert reproduce peters-wu --mesh examples/meshes/bumpy_torus_tri.obj\n  \
        subcert reproduce depth --mesh examples/meshes/bumpy_torus_tri.obj --out depth\n  \
        subcert reproduce all --out papers\n\n\
        Each printed number stands beside the paper's own method redone exactly and the sharp value, with\n\
        a verdict that is computed: sharp, true, loose, misprint, refuted or undecided. --out writes\n\
        DIR/PAPER.md and .json, plots as .svg, and DIR/certificates for subcert-check; for all papers also\n\
        DIR/README.md, one table over all claims, and DIR/all.json. Refuted claims are results: the exit\n\
        code is 0.")]
pub struct Reproduce {
    /// Which paper
    #[arg(value_enum)]
    paper: PaperName,
    /// Valences to decide the claims for: 7 or 3..10 (both ends included); tables show those printed
    #[arg(long, value_name = "A..B", default_value = "3..10")]
    valence: Range,
    /// Peters & Wu: a mesh of triangles to redo their Table 1 on, beside the stand-ins; depth: a mesh in
    /// place of the stand-ins (triangles: Loop, others: Catmull-Clark and Doo-Sabin); may be repeated
    #[arg(long, value_name = "FILE")]
    mesh: Vec<PathBuf>,
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
    /// Cheng & Yong, on depths of Catmull-Clark surfaces
    ChengYong,
    /// Lanquetin & Neveu 2004, on levels of three schemes
    LanquetinNeveu,
    /// Peters & Wu 2009, on distances of Loop surfaces to their polyhedra
    PetersWu,
    /// No paper: the depths that all methods ask for on meshes, beside the least by certified measurement
    Depth,
    /// All papers
    All,
}

/// Hears how many valences of how many are done.
type Tell<'a> = dyn Fn(u32, u32) + Sync + 'a;

/// A paper that can be examined.
struct Paper {
    name: PaperName,
    /// The largest valence.
    largest: u32,
    examine: fn(&[u32], &[StandIn], &Tell<'_>) -> anyhow::Result<Report>,
}

/// The papers, in the order of `all`.
const PAPERS: [Paper; 4] = [
    Paper {
        name: PaperName::HuangWang,
        // The paper's own investigation ends there.
        largest: huang_wang_2008::printed::INVESTIGATED.1,
        examine: |valences, _, tell| Ok(huang_wang_2008::examine(valences, tell)?),
    },
    Paper {
        name: PaperName::ChengYong,
        largest: 20,
        examine: |valences, _, tell| Ok(cheng_yong::examine(valences, tell)),
    },
    Paper {
        name: PaperName::LanquetinNeveu,
        largest: 20,
        examine: |valences, _, tell| Ok(lanquetin_neveu_2004::examine(valences, tell)),
    },
    Paper {
        name: PaperName::PetersWu,
        // The paper's own tables end there.
        largest: peters_wu::printed::TABULATED.1,
        examine: |valences, meshes, tell| Ok(peters_wu::examine(valences, meshes, tell)),
    },
];

/// A mesh of triangles by its file's name.
fn load(path: &Path) -> anyhow::Result<StandIn> {
    let mesh = io::read(path)?.mesh;
    if mesh.topology.arity() != Some(3) {
        bail!(
            "{} has faces that are no triangles: Peters & Wu's estimates are for Loop's scheme, so give a mesh of triangles",
            path.display()
        );
    }
    subcert::refine::topology::check(Scheme::Loop(peters_wu::redone::WEIGHTS), &mesh.topology)
        .with_context(|| format!("{} has no Loop surface", path.display()))?;
    let name = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    Ok(StandIn { name, mesh })
}

/// A mesh with the schemes that apply to it, but for Doo-Sabin where there is no interior vertex.
fn subjects(path: &Path) -> anyhow::Result<Vec<Subject>> {
    let mesh = io::read(path)?.mesh;
    let name = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let schemes = match mesh.topology.arity() {
        Some(3) => vec![Scheme::Loop(LoopWeights::Original)],
        _ => vec![Scheme::CatmullClark, Scheme::DooSabin],
    };
    let has_surface = |scheme: &Scheme| {
        let t = &mesh.topology;
        let interior = |v| !t.is_boundary_vertex(v) && t.valence(v) > 0;
        *scheme != Scheme::DooSabin || (0..t.vertex_count()).any(interior)
    };
    let subjects = schemes
        .into_iter()
        .filter(has_surface)
        .map(|scheme| Subject {
            name: name.clone(),
            mesh: mesh.clone(),
            scheme,
        });
    Ok(subjects.collect())
}

impl Reproduce {
    pub fn run(&self) -> anyhow::Result<Outcome> {
        if self.paper == PaperName::Depth {
            return self.depth();
        }
        let all = self.paper == PaperName::All;
        let asked: Vec<&Paper> = PAPERS
            .iter()
            .filter(|paper| all || paper.name == self.paper)
            .collect();
        let largest = asked.iter().map(|paper| paper.largest).min().unwrap_or(3);
        if self.valence.first < 3 || self.valence.last > largest {
            let about = if all {
                "all papers are"
            } else {
                "the paper is"
            };
            bail!("--valence must lie in 3..{largest}: {about} examined for these valences");
        }
        let valences: Vec<u32> = (self.valence.first..=self.valence.last).collect();
        if !self.mesh.is_empty() && !asked.iter().any(|paper| paper.name == PaperName::PetersWu) {
            bail!("--mesh is for peters-wu: the other papers are judged without meshes of yours");
        }
        let meshes = self
            .mesh
            .iter()
            .map(|path| load(path))
            .collect::<Result<Vec<_>, _>>()?;
        let progress = Progress::new();
        let tell = |done, count| progress.units(done, count, "valences");
        let reports: Vec<Report> = asked
            .iter()
            .map(|paper| (paper.examine)(&valences, &meshes, &tell))
            .collect::<Result<_, _>>()?;
        progress.finish();
        self.write_folder(&reports)?;
        self.print(&reports)?;
        Ok(Outcome::Done)
    }

    /// The study of depths.
    fn depth(&self) -> anyhow::Result<Outcome> {
        let subjects = match self.mesh.is_empty() {
            true => study::stand_ins(),
            false => {
                let files = self.mesh.iter().map(|path| subjects(path));
                files.collect::<anyhow::Result<Vec<_>>>()?.concat()
            }
        };
        let progress = Progress::new();
        let mut found = Vec::new();
        for (done, subject) in (0..).zip(&subjects) {
            progress.units(done, subjects.len() as u32, "meshes");
            let name = &subject.name;
            let one = study::study(subject);
            found.push(one.with_context(|| format!("{name} can't be studied"))?);
        }
        progress.finish();
        let reports = [study::report(&found)];
        self.write_folder(&reports)?;
        self.print(&reports)?;
        Ok(Outcome::Done)
    }

    fn write_folder(&self, reports: &[Report]) -> anyhow::Result<()> {
        let Some(folder) = &self.out else {
            return Ok(());
        };
        let written = match (self.paper, reports) {
            (PaperName::All, _) => papers::write_folder(folder, reports),
            (_, reports) => reports
                .iter()
                .try_for_each(|report| paper::write_folder(folder, report)),
        };
        written.with_context(|| {
            format!(
                "the report can't be written to {}: name a folder that can be written",
                folder.display()
            )
        })
    }

    fn print(&self, reports: &[Report]) -> anyhow::Result<()> {
        let one = match (self.paper, reports) {
            (PaperName::All, _) => None,
            (_, reports) => reports.first(),
        };
        match one {
            Some(report) => super::print(self.json.then(|| paper::json(report)), || {
                paper::text(report)
            }),
            None => super::print(self.json.then(|| papers::json(reports)), || {
                papers::text(reports)
            }),
        }
    }
}
