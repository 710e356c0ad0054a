//! How tight the methods are: for meshes and tolerances, the least depth by certified measurement beside what
//! every method asks for.
//!
//! The parametric distance is enclosed at the levels 0, 1, .. of a mesh, up to [`LARGEST`] faces. The *least
//! depth* for a tolerance is the first level whose upper bound is at most the tolerance, provided that the
//! lower bounds of the levels before exceed it; otherwise it is open. The *excess* of a method is its depth
//! less the least one; below 0 the method is unsafe there.

use std::collections::BTreeMap;

use super::{Answer, Method, Metric, Request, best, predict};
use crate::bound::Against;
use crate::distance::measure::{self, MeasureError, measure};
use crate::distance::model;
use crate::distance::parametric::Goal;
use crate::mesh::Mesh;
use crate::paper::peters_wu::{self, meshes::StandIn};
use crate::paper::{Claim, Look, Plot, Report, Series, Table, Verdict};
use crate::scheme::{CornerRule, LoopWeights, Scheme};

/// Faces of the largest refined mesh that is measured.
pub const LARGEST: u64 = 2_000_000;

/// The deepest level that is measured.
const DEEPEST: u32 = 9;

/// Relative gap of the enclosures.
const GAP: f64 = 1e-4;

/// The tolerances, as parts of the bounding box's diagonal.
pub const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// A mesh by its name, and the scheme that it is refined by.
#[derive(Clone, Debug)]
pub struct Subject {
    /// The mesh's name.
    pub name: String,
    /// The mesh.
    pub mesh: Mesh,
    /// The scheme.
    pub scheme: Scheme,
}

/// Authored meshes: the stand-ins for Peters & Wu's models, refined by Loop's scheme.
pub fn stand_ins() -> Vec<Subject> {
    let loop_scheme = Scheme::Loop(LoopWeights::Original);
    let subject = |one: StandIn| Subject {
        name: one.name,
        mesh: one.mesh,
        scheme: loop_scheme,
    };
    peters_wu::meshes::stand_ins()
        .into_iter()
        .map(subject)
        .collect()
}

/// What certified measurement says of a tolerance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Least {
    /// The least depth.
    Depth(u32),
    /// More than that level, the last that was measured.
    Beyond(u32),
    /// The enclosures don't tell.
    Open,
}

/// One mesh, one tolerance.
#[derive(Clone, Debug)]
pub struct Case {
    /// The tolerance, as a part of the diagonal.
    pub relative: f64,
    /// The least depth.
    pub least: Least,
    /// What the methods say.
    pub answers: Vec<Answer>,
}

impl Case {
    /// The excess of a depth; `None` if the least depth is not known.
    pub fn excess(&self, depth: Option<u32>) -> Option<i64> {
        match (self.least, depth) {
            (Least::Depth(least), Some(depth)) => Some(i64::from(depth) - i64::from(least)),
            _ => None,
        }
    }

    /// Whether a depth is certainly too small.
    pub fn is_below(&self, depth: Option<u32>) -> bool {
        match (self.least, depth) {
            (Least::Depth(least), Some(depth)) => depth < least,
            (Least::Beyond(level), Some(depth)) => depth <= level,
            _ => false,
        }
    }
}

/// One mesh.
#[derive(Clone, Debug)]
pub struct Found {
    /// The mesh's name.
    pub name: String,
    /// The scheme.
    pub scheme: Scheme,
    /// Enclosures of the distances at the levels 0, 1, .., in the mesh's own unit.
    pub distances: Vec<[f64; 2]>,
    /// The length of the bounding box's diagonal.
    pub diagonal: f64,
    /// Tolerance by tolerance.
    pub cases: Vec<Case>,
}

/// Measures a mesh and asks all methods.
///
/// # Errors
/// If and only if the scheme does not apply, or there is no surface.
pub fn study(subject: &Subject) -> Result<Found, MeasureError> {
    let mesh = &subject.mesh;
    let [low, high] = mesh.bounding_box();
    let [x, y, z] = [0, 1, 2].map(|i| high[i] - low[i]);
    let diagonal = x.hypot(y).hypot(z);
    let finest = TOLERANCES[TOLERANCES.len() - 1] * diagonal;
    let mut distances = Vec::new();
    let mut faces = u64::from(mesh.topology.halfedge_count()) / 3;
    for level in 0..=DEEPEST {
        let request = measure::Request {
            scheme: subject.scheme,
            corner: CornerRule::Smooth,
            level,
            against: model::Against::Control,
            goal: Goal {
                gap: GAP,
                ..Goal::default()
            },
        };
        let found = measure(mesh, &request, &|_, _| ())?;
        distances.push([found.lo, found.hi]);
        faces *= 4;
        if found.hi <= finest || faces > LARGEST {
            break;
        }
    }
    let case = |relative: f64| -> Result<Case, MeasureError> {
        let tolerance = relative * diagonal;
        let request = Request {
            scheme: subject.scheme,
            corner: CornerRule::Smooth,
            against: Against::Control,
            metric: Metric::Parametric,
            tolerance,
        };
        let methods: Vec<Method> = Method::all()
            .into_iter()
            .filter(|method| method.bounds(Metric::Parametric) && method.applies(&request).is_ok())
            .collect();
        Ok(Case {
            relative,
            least: least(&distances, tolerance),
            answers: predict(mesh, &request, &methods)?,
        })
    };
    let cases: Result<Vec<Case>, MeasureError> = TOLERANCES.map(case).into_iter().collect();
    Ok(Found {
        name: subject.name.clone(),
        scheme: subject.scheme,
        cases: cases?,
        distances,
        diagonal,
    })
}

fn least(distances: &[[f64; 2]], tolerance: f64) -> Least {
    let mut level = 0;
    for &[lo, hi] in distances {
        if hi <= tolerance {
            return Least::Depth(level);
        }
        if lo <= tolerance {
            return Least::Open;
        }
        level += 1;
    }
    Least::Beyond(level.saturating_sub(1))
}

/// What a method, or `best`, is worth over many cases.
#[derive(Clone, Debug, Default, PartialEq)]
struct Score {
    cases: u32,
    sum: i64,
    largest: i64,
    within_one: u32,
    below: u32,
    by_tolerance: [(u32, i64); TOLERANCES.len()],
    /// Where it asks for too little.
    where_below: Vec<String>,
}

impl Score {
    fn add(&mut self, found: &Found, place: usize, case: &Case, depth: Option<u32>) {
        if case.is_below(depth) {
            self.below += 1;
            self.where_below.push(format!(
                "{} ({}), {:.0e}",
                found.name,
                found.scheme.name(),
                case.relative
            ));
        }
        if let Some(excess) = case.excess(depth) {
            self.cases += 1;
            self.sum += excess;
            self.largest = self.largest.max(excess);
            self.within_one += u32::from((0..=1).contains(&excess));
            self.by_tolerance[place].0 += 1;
            self.by_tolerance[place].1 += excess;
        }
    }

    fn mean(&self) -> f64 {
        self.sum as f64 / f64::from(self.cases.max(1))
    }
}

/// The name under which the least safe depth stands among the methods.
const BEST: &str = "best";

fn scores(all: &[Found]) -> BTreeMap<String, Score> {
    let mut scores: BTreeMap<String, Score> = BTreeMap::new();
    for found in all {
        for (place, case) in found.cases.iter().enumerate() {
            for answer in &case.answers {
                let name = answer.method.to_string();
                scores
                    .entry(name)
                    .or_default()
                    .add(found, place, case, answer.depth);
            }
            let depth = best(&case.answers).and_then(|answer| answer.depth);
            scores
                .entry(BEST.into())
                .or_default()
                .add(found, place, case, depth);
        }
    }
    scores
}

/// The study as a report: depths, excesses, claims, plots.
pub fn report(all: &[Found]) -> Report {
    let scores = scores(all);
    Report {
        id: "depth",
        title: "Subdivision depths: needed, and asked for",
        source: "this program; Lanquetin & Neveu 2004, Huang & Wang 2008, Cheng & Yong, Peters & Wu 2009",
        preface: vec![
            "For each mesh and tolerance (a part of the bounding box's diagonal) the least depth by certified \
             measurement of the parametric distance to the control mesh, beside the depth that every method asks \
             for. A star marks an answer that is not proved; `-`: the method does not apply."
                .into(),
        ],
        tables: vec![depths(all), excesses(&scores), below(&scores)],
        claims: claims(all, &scores),
        plots: vec![plot(&scores)],
        pictures: Vec::new(),
        certificates: Vec::new(),
    }
}

/// The methods of a column.
const COLUMNS: [&str; 7] = [
    "heuristic",
    "lanquetin-neveu",
    "cheng-yong",
    "huang",
    "subcert-0",
    "subcert-1",
    "subcert-2",
];

fn depths(all: &[Found]) -> Table {
    let row = |found: &Found, case: &Case| {
        let least = match case.least {
            Least::Depth(depth) => depth.to_string(),
            Least::Beyond(level) => format!("> {level}"),
            Least::Open => "open".into(),
        };
        let mut row = vec![
            found.name.clone(),
            found.scheme.name().to_string(),
            format!("{:.0e}", case.relative),
            least,
        ];
        row.extend(COLUMNS.map(|name| {
            let answer = case.answers.iter().find(|a| a.method.to_string() == name);
            match answer.and_then(|a| a.depth.map(|depth| (depth, a.safe))) {
                Some((depth, true)) => depth.to_string(),
                Some((depth, false)) => format!("{depth}*"),
                None => "-".into(),
            }
        }));
        row
    };
    let rows = all
        .iter()
        .flat_map(|found| found.cases.iter().map(move |case| row(found, case)));
    Table {
        id: "depths",
        title: "Least depth and depths asked for".into(),
        heads: ["mesh", "scheme", "tolerance", "least"]
            .into_iter()
            .chain(COLUMNS)
            .collect(),
        rows: rows.collect(),
        notes: vec!["* not proved".into()],
    }
}

fn excesses(scores: &BTreeMap<String, Score>) -> Table {
    let row = |(name, score): (&String, &Score)| {
        vec![
            name.clone(),
            score.cases.to_string(),
            format!("{:.2}", score.mean()),
            score.largest.to_string(),
            score.within_one.to_string(),
            score.below.to_string(),
        ]
    };
    Table {
        id: "excess",
        title: "Steps beyond the least depth".into(),
        heads: vec!["method", "cases", "mean", "largest", "0 or 1", "too few"],
        rows: scores.iter().map(row).collect(),
        notes: vec![
            "cases: those whose least depth is known and for which the method has a depth".into(),
        ],
    }
}

fn below(scores: &BTreeMap<String, Score>) -> Table {
    let rows = scores.iter().flat_map(|(name, score)| {
        score
            .where_below
            .iter()
            .map(move |place| vec![name.clone(), place.clone()])
    });
    Table {
        id: "too-few",
        title: "Where a method asks for too few steps".into(),
        heads: vec!["method", "mesh (scheme), tolerance"],
        rows: rows.collect(),
        notes: Vec::new(),
    }
}

fn plot(scores: &BTreeMap<String, Score>) -> Plot {
    let series = scores.iter().map(|(name, score)| {
        let points = (0..)
            .zip(&score.by_tolerance)
            .filter(|(_, (count, _))| *count > 0);
        Series {
            name: name.clone(),
            look: Look::Line,
            points: points
                .map(|(place, &(count, sum))| {
                    (f64::from(place) + 1.0, sum as f64 / f64::from(count))
                })
                .collect(),
        }
    });
    Plot {
        id: "excess-by-tolerance",
        title: "Mean of the steps beyond the least depth".into(),
        x: "tolerance 10^-x of the diagonal",
        y: "steps",
        logarithmic: false,
        series: series.filter(|series| !series.points.is_empty()).collect(),
    }
}

fn claims(all: &[Found], scores: &BTreeMap<String, Score>) -> Vec<Claim> {
    let scope = format!(
        "{} meshes with a scheme, tolerances 1e-1 to 1e-5 of the diagonal, control meshes",
        all.len()
    );
    let claim = |id, statement: &str, truth, found| Claim {
        id,
        place: "this study",
        statement: statement.into(),
        verdict: Verdict::of(truth),
        found,
        method: None,
        scope: scope.clone(),
        counterexample: None,
        certificates: Vec::new(),
    };
    let cases = || all.iter().flat_map(|found| &found.cases);
    let unsound = cases().flat_map(|case| {
        case.answers
            .iter()
            .filter(|answer| answer.safe && case.is_below(answer.depth))
    });
    let unsound = unsound.count();
    let safe = cases()
        .flat_map(|case| &case.answers)
        .filter(|a| a.safe && a.depth.is_some());
    let nothing = Score::default();
    let score = |name: &str| scores.get(name).unwrap_or(&nothing);
    let (heuristic, best) = (score("heuristic"), score(BEST));
    let near = |score: &Score| 10 * score.within_one >= 9 * score.cases;
    vec![
        claim(
            "safe-methods",
            "no safe method asks for fewer steps than are needed",
            Some(unsound == 0),
            format!("{} safe answers, {unsound} too small", safe.count()),
        ),
        claim(
            "heuristic",
            "the vertex heuristic asks for enough steps",
            Some(heuristic.below == 0),
            format!("too few in {} cases", heuristic.below),
        ),
        claim(
            "best-within-one",
            "the least safe depth is within one step of the least depth in nine cases of ten",
            (best.cases > 0).then(|| near(best)),
            format!(
                "{} of {} cases, mean excess {:.2}, largest {}",
                best.within_one,
                best.cases,
                best.mean(),
                best.largest
            ),
        ),
    ]
}
