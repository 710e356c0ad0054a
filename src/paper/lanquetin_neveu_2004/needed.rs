//! The method of Tables 1 to 3 on meshes that can be had: the depth by Corollary 3 from M_0 and n, the depth
//! that is needed, certified, and on regular meshes the depth by what is true.

use super::lengths::{displacement_square, root};
use super::loop_masks::rate_enclosure;
use super::meshes::{self, Authored};
use super::nets::{integer, ratio};
use super::theorem_3::request;
use super::{depth, remedy};
use crate::distance::measure::measure;
use crate::mesh::{Mesh, Point};
use crate::paper::words::{all, claim};
use crate::paper::{Claim, Enclosure, Table, Verdict};
use crate::refine::{Enclosed, enclose_limits};
use crate::scalar::{Rational, Ring};
use crate::scheme::CornerRule;

use super::extremal::LOOP;

/// Relative gap of measured distances.
const GAP: f64 = 1e-4;

/// The deepest level that is measured.
const DEEPEST: u32 = 6;

/// M_0 / ε as fractions.
const RATIOS: [(i64, i64); 5] = [(9, 10), (5, 2), (39, 10), (31, 2), (62, 1)];

/// A depth by the paper, and what it is worth.
#[derive(Clone, Debug)]
pub struct Entry {
    /// The mesh.
    pub mesh: &'static str,
    /// n, the largest valence after all steps.
    pub n: u32,
    /// M_0 / ε.
    pub ratio: Rational,
    /// ε.
    pub epsilon: Rational,
    /// By Corollary 3.
    pub paper: Option<u32>,
    /// The first level whose distance is at most ε, certainly.
    pub needed: Option<u32>,
    /// The distance at the paper's depth over ε.
    pub distance: Option<Enclosure>,
    /// On regular meshes: by `4^-k M / 2 <= ε`.
    pub safe: Option<u32>,
}

impl Entry {
    /// Whether the paper's depth is enough.
    pub fn is_enough(&self) -> Option<bool> {
        self.distance
            .as_ref()?
            .at_most(&Enclosure::exactly(integer(1)))
    }
}

/// Entries of an authored mesh.
fn entries(authored: &Authored) -> Option<Vec<Entry>> {
    let floats = Mesh {
        topology: authored.mesh().topology,
        positions: authored
            .points
            .iter()
            .map(|p| Point(p.map(|x| x as f64)))
            .collect(),
    };
    of_mesh(authored.name, &floats, DEEPEST)
}

/// The method on a closed mesh of triangles, with levels measured up to a deepest one, each once; `None` if
/// M_0 can't be enclosed (a boundary, a valence whose rate is not known).
pub fn of_mesh(name: &'static str, floats: &Mesh, deepest: u32) -> Option<Vec<Entry>> {
    let exact = Mesh {
        topology: floats.topology.clone(),
        positions: (floats.positions.iter())
            .map(|p| Some(Point(exactly(&p.0)?)))
            .collect::<Option<Vec<_>>>()?,
    };
    let [valences, _] = exact.topology.valence_histograms();
    let n = valences.keys().copied().chain([6]).max()?;
    let regular = valences.keys().all(|&n| n == 6);
    let m_0 = m_0(&exact, floats)?;
    let rate = rate_enclosure(n)?;
    let mut levels: Vec<Enclosure> = Vec::new();
    let mut distance = |k: u32| -> Option<Enclosure> {
        while levels.len() <= k as usize {
            let found = measure(floats, &request(levels.len() as u32, GAP), &|_, _| ()).ok()?;
            levels.push(Enclosure::floats(found.lo, found.hi)?);
        }
        Some(levels[k as usize].clone())
    };
    let mut found = Vec::new();
    for (p, q) in RATIOS {
        // A decimal just below M_0 q / p, so that M_0 / ε is p/q and a little more.
        let epsilon = &m_0.lo * ratio(q, p);
        let at = Enclosure::exactly(epsilon.clone());
        let paper = depth::corollary_3(&m_0, &at, &rate);
        let needed =
            (0..=deepest).find(|&k| distance(k).is_some_and(|d| d.at_most(&at) == Some(true)));
        let over = |d: Enclosure| Enclosure::new(&d.lo / &epsilon, &d.hi / &epsilon);
        found.push(Entry {
            mesh: name,
            n,
            ratio: ratio(p, q),
            paper,
            needed,
            distance: (paper.filter(|&k| k <= deepest))
                .and_then(&mut distance)
                .map(over),
            safe: regular
                .then(|| remedy::regular_depth(&remedy::second_order_square(&exact), &epsilon))
                .flatten(),
            epsilon,
        });
    }
    Some(found)
}

/// The coordinates of a float point; `None` unless finite.
fn exactly(point: &[f64; 3]) -> Option<[Rational; 3]> {
    let [x, y, z] = point.map(Rational::from_float);
    Some([x?, y?, z?])
}

/// M_0: exact squares where the weights are rational, certified enclosures else.
fn m_0(exact: &Mesh<Rational>, floats: &Mesh) -> Option<Enclosure> {
    if let Ok(square) = displacement_square(exact) {
        return Some(root(&square));
    }
    let level = Enclosed {
        positions: floats.positions.clone(),
        radius: 0.0,
    };
    let limits = enclose_limits(LOOP, CornerRule::Smooth, &floats.topology, &level).ok()?;
    let radius = Rational::from_float(limits.radius)? * <Rational as Ring>::from_integer(2);
    let mut largest = Enclosure::exactly(integer(0));
    for (p, limit) in exact.positions.iter().zip(&limits.positions) {
        let limit = Point(
            limit
                .0
                .map(|x| Rational::from_float(x).unwrap_or_else(|| integer(0))),
        );
        let length = root(&(p.clone() - &limit).norm_squared());
        // The error has a length of at most √3 times its bound per coordinate.
        let low = (&length.lo - &radius).max(integer(0));
        largest = largest.max(&Enclosure::new(low, &length.hi + &radius));
    }
    Some(largest)
}

/// All entries.
pub fn examine() -> Vec<Entry> {
    let tetrahedron = meshes::tetrahedron();
    let meshes = [
        tetrahedron,
        meshes::octahedron(1),
        meshes::icosahedron(),
        meshes::seven(),
        meshes::torus(),
        meshes::round_torus(12, 8),
    ];
    meshes.iter().filter_map(entries).flatten().collect()
}

/// The table.
pub fn table(found: &[Entry]) -> Table {
    let text = |k: Option<u32>| k.map_or("-".into(), |k| k.to_string());
    let row = |e: &Entry| {
        vec![
            e.mesh.to_string(),
            e.n.to_string(),
            Enclosure::exactly(e.ratio.clone()).decimal(1),
            Enclosure::exactly(e.epsilon.clone()).decimal(4),
            text(e.paper),
            e.distance.as_ref().map_or("-".into(), |d| d.decimal(3)),
            text(e.needed),
            text(e.safe),
            match e.is_enough() {
                Some(true) => "enough",
                Some(false) => "not enough",
                None => "?",
            }
            .into(),
        ]
    };
    Table {
        id: "depths",
        title: "The method of Tables 1 to 3 on meshes that can be had".into(),
        heads: vec![
            "mesh",
            "n",
            "M_0 / ε",
            "ε",
            "depth by Corollary 3",
            "distance there / ε",
            "needed",
            "by 4^-k M / 2",
            "verdict",
        ],
        rows: found.iter().map(row).collect(),
        notes: vec![
            "The paper's models (torus, box, spinning top, dolphin, bunny) are not public. Distances are \
             certified suprema of |S - L| at the same parameter, in the mesh's own unit; needed: the first \
             level within ε. By 4^-k M / 2: regular meshes only."
                .into(),
        ],
    }
}

/// The claims on depths.
pub fn claims(found: &[Entry]) -> Vec<Claim> {
    let short: Vec<String> = found
        .iter()
        .filter(|e| e.is_enough() == Some(false))
        .map(|e| {
            format!(
                "{}, M_0/ε = {}: {} steps leave {} ε",
                e.mesh,
                Enclosure::exactly(e.ratio.clone()).decimal(1),
                e.paper.map_or("?".into(), |k| k.to_string()),
                e.distance.as_ref().map_or("?".into(), |d| d.decimal(3))
            )
        })
        .collect();
    let truth = all(found.iter().map(Entry::is_enough));
    let safe = all(found
        .iter()
        .filter_map(|e| Some(e.safe? >= e.needed?))
        .map(Some));
    let text = format!("not enough: {}", short.join("; "));
    vec![
        claim(
            "corollary-3",
            "Corollary 3",
            "Within ε after k steps if k > ln(M_0/ε) / ln(1 / (5/8 - nβ)).",
            Verdict::of(truth),
            text.clone(),
            "the meshes of the table of depths; parametric distance, largest valence after all steps",
        ),
        claim(
            "sure-accuracy",
            "section 4",
            "The subdivision can be performed without any distance computation since we are sure of reaching \
             the desired accuracy; in Loop subdivision whatever the valences.",
            Verdict::of(truth),
            text,
            "the same meshes",
        ),
        claim(
            "depth-in-place",
            "in place of Corollary 3",
            "(Ours.) On a regular mesh k >= log_4(M / 2ε) steps suffice, M the second-order norm.",
            Verdict::of(safe),
            "at least the depth needed on every regular mesh of the table",
            "n = 6",
        ),
    ]
}
