//! Theorem 3 and Corollary 3: the three parts, each with a closed mesh that violates it.

use num_traits::Zero;

use super::extremal::Pair;
use super::lengths::{Lengths, every, root};
use super::meshes::{self, Authored};
use super::nets::ratio;
use super::smallest;
use crate::certificate::{Certificate, Claim as Statement, MeshViolation, Step};
use crate::distance::measure::{Measurement, Request, measure_exact};
use crate::distance::model::Against;
use crate::distance::parametric::Goal;
use crate::paper::words::{DIGITS, all as all_of, claim};
use crate::paper::{Claim, Counterexample, Enclosure, Table, Verdict};
use crate::scalar::{Field, Rational};
use crate::scheme::CornerRule;

use super::extremal::LOOP;

/// Levels at which the meshes are compared.
pub const LEVELS: u32 = 3;

/// Relative gap of measured distances.
const GAP: f64 = 1e-9;

/// A counterexample and what is known of it.
pub struct Examined {
    /// The mesh.
    pub authored: Authored,
    /// Its lengths.
    pub lengths: Lengths,
    /// The largest |S - F|, measured exactly; `None` where it can't be.
    pub distance: Option<Measurement>,
}

/// The control mesh of a level, to a gap.
pub fn request(level: u32, gap: f64) -> Request {
    Request {
        scheme: LOOP,
        corner: CornerRule::Smooth,
        level,
        against: Against::Control,
        goal: Goal {
            gap,
            ..Goal::default()
        },
    }
}

impl Examined {
    pub(super) fn of(authored: Authored) -> Option<Self> {
        let mesh = authored.mesh();
        Some(Examined {
            lengths: Lengths::of(&mesh, LEVELS).ok()?,
            distance: measure_exact(&mesh, &request(0, GAP), &|_, _| ()).ok(),
            authored,
        })
    }

    /// Whether the measured distance is at most M_0; `None` if neither that nor the contrary is certain.
    pub(super) fn distance_holds(&self) -> Option<bool> {
        let [lower, upper] = self.distance.as_ref()?.squares.as_ref()?;
        let m_0 = &self.lengths.displacements[0];
        match (lower > m_0, upper <= m_0) {
            (true, _) => Some(false),
            (_, true) => Some(true),
            _ => None,
        }
    }

    /// The measured distance over M_0.
    pub(super) fn distance_ratio(&self) -> Option<Enclosure> {
        let [lower, upper] = self.distance.as_ref()?.squares.as_ref()?;
        let m_0 = &self.lengths.displacements[0];
        let [lo, hi] = [lower, upper].map(|square| root(&(square / m_0)));
        Some(Enclosure::new(lo.lo, hi.hi))
    }

    fn certificate(&self, inequality: &str, level: usize, step: Step) -> (String, Certificate) {
        let violation = MeshViolation {
            scheme: "loop".into(),
            weights: "original".into(),
            kind: "mesh-violation".into(),
            inequality: inequality.into(),
            level,
            vertices: self
                .authored
                .points
                .iter()
                .map(|p| p.map(|x| x.to_string()))
                .collect(),
            faces: self
                .authored
                .faces
                .iter()
                .map(|f| f.map(|v| v as usize + 1))
                .collect(),
        };
        let short = self.authored.name.trim_start_matches("lanquetin-neveu-");
        (
            format!("lanquetin-neveu-{inequality}-{short}.json"),
            Certificate::of_violation(Statement::Mesh(violation), None, step),
        )
    }

    /// Certificates of all that the mesh violates at the first level.
    fn certificates(&self) -> Vec<(String, Certificate)> {
        let mut files = Vec::new();
        if !self.lengths.recurrence(0) {
            files.push(self.certificate("recurrence", 0, Step::Recurrence {}));
        }
        if !self.lengths.power(1) {
            files.push(self.certificate("rate", 1, Step::Rate {}));
        }
        if !self.lengths.middles() {
            let edge = self.lengths.middle.1.map(|v| v as usize + 1);
            files.push(self.certificate("distance", 0, Step::Distance { edge }));
        }
        files
    }
}

/// The counterexamples, examined.
pub fn examine() -> Vec<Examined> {
    meshes::counterexamples()
        .into_iter()
        .filter_map(Examined::of)
        .collect()
}

/// One row for each mesh.
pub fn table(examined: &[Examined]) -> Table {
    let row = |e: &Examined| {
        let valences = e.authored.topology().valence_histograms()[0].clone();
        let valences: Vec<String> = valences.keys().map(u32::to_string).collect();
        vec![
            format!("{}.obj", e.authored.name),
            e.authored.points.len().to_string(),
            valences.join(", "),
            e.lengths.rate.to_string(),
            e.lengths.ratio(1).decimal(DIGITS),
            e.lengths.middle_ratio().decimal(DIGITS),
            e.distance_ratio().map_or("?".into(), |r| r.decimal(DIGITS)),
            verdict_of(e.lengths.recurrence(0) && e.lengths.power(1)),
            verdict_of(e.distance_holds() != Some(false)),
        ]
    };
    Table {
        id: "counterexamples",
        title: "Theorem 3 on closed meshes (proofs/counterexamples)".into(),
        heads: vec![
            "mesh",
            "vertices",
            "valences",
            "rate",
            "M_1 / M_0",
            "at an edge's middle / M_0",
            "largest |S - F| / M_0",
            "recurrence, rate",
            "distance",
        ],
        rows: examined.iter().map(row).collect(),
        notes: vec![
            "Exact squares of rational lengths are compared. The rate is the largest 5/8 - nβ, valence 6 \
             always included, as section 3.1 asks for: the reading most favourable to the theorem."
                .into(),
        ],
    }
}

fn verdict_of(holds: bool) -> String {
    Verdict::of(Some(holds)).to_string()
}

fn witness(e: &Examined, what: String) -> Counterexample {
    let net = e
        .authored
        .points
        .iter()
        .map(|[x, y, z]| format!("({x}, {y}, {z})"));
    let largest = e.authored.topology().valence_histograms()[0]
        .keys()
        .max()
        .copied();
    Counterexample {
        valence: largest.unwrap_or(0),
        net: net.collect(),
        what: format!("{}.obj: {what}", e.authored.name),
    }
}

/// The claims of Theorem 3 on meshes, and certificates.
pub fn claims(examined: &[Examined]) -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let certificates: Vec<_> = examined.iter().flat_map(Examined::certificates).collect();
    let names = |part: &str| -> Vec<String> {
        let prefix = format!("lanquetin-neveu-{part}-");
        let names = certificates.iter().map(|(name, _)| name);
        names
            .filter(|name| name.starts_with(&prefix))
            .cloned()
            .collect()
    };
    let list = |of: &dyn Fn(&Examined) -> Option<String>| -> String {
        let texts: Vec<String> = examined.iter().filter_map(of).collect();
        texts.join("; ")
    };
    let scope = "closed meshes of valences 3, 4, 6".to_string();
    let recurrence = every(examined.iter().map(|e| e.lengths.recurrence(0)));
    let power = every(examined.iter().map(|e| e.lengths.power(1)));
    let distance = every(examined.iter().map(|e| e.distance_holds() != Some(false)));
    let first = |fails: &dyn Fn(&Examined) -> bool| examined.iter().find(|e| fails(e));
    let ratio_text = |e: &Examined| e.lengths.ratio(1).decimal(DIGITS);
    let mut claims = vec![
        Claim {
            counterexample: first(&|e| !e.lengths.recurrence(0)).map(|e| {
                witness(
                    e,
                    format!("M_1 = {} M_0 > {} M_0", ratio_text(e), e.lengths.rate),
                )
            }),
            certificates: names("recurrence"),
            ..claim(
                "theorem-3-recurrence",
                "Theorem 3, proof",
                "M_(k+1) <= (5/8 - nβ) M_k.",
                recurrence,
                format!(
                    "true at old vertices only, with equality; not at inserted ones: {}",
                    list(&|e| (!e.lengths.recurrence(0)).then(|| format!(
                        "{}: M_1 / M_0 = {}",
                        e.authored.name,
                        ratio_text(e)
                    )))
                ),
                scope.clone(),
            )
        },
        Claim {
            counterexample: first(&|e| !e.lengths.power(1)).map(|e| {
                witness(
                    e,
                    format!("M_1 = {} M_0 > {} M_0", ratio_text(e), e.lengths.rate),
                )
            }),
            certificates: names("rate"),
            ..claim(
                "theorem-3-rate",
                "Theorem 3, (8)",
                "M_k <= (5/8 - nβ)^k M_0.",
                power,
                format!(
                    "already at k = 1: {}",
                    list(&|e| (!e.lengths.power(1)).then(|| {
                        let ratios: Vec<String> = (1..=LEVELS as usize)
                            .map(|k| e.lengths.ratio(k).decimal(DIGITS))
                            .collect();
                        format!("{}: M_k / M_0 = {}", e.authored.name, ratios.join(", "))
                    }))
                ),
                scope.clone(),
            )
        },
        Claim {
            counterexample: first(&|e| e.distance_holds() == Some(false)).map(|e| {
                witness(
                    e,
                    format!(
                        "the largest |S - F| is {} M_0",
                        e.distance_ratio().map_or("?".into(), |r| r.decimal(DIGITS))
                    ),
                )
            }),
            certificates: names("distance"),
            ..claim(
                "theorem-3-distance",
                "Theorem 3, (8)",
                "|S^k(u, v) - L^k(u, v)| <= M_k.",
                distance,
                list(&|e| {
                    let ratio = e.distance_ratio()?.decimal(DIGITS);
                    Some(match e.distance_holds() {
                        Some(false) => format!("{}: {ratio} M_0", e.authored.name),
                        _ => format!("{}: {ratio} M_0, no violation", e.authored.name),
                    })
                }),
                scope,
            )
        },
    ];
    claims.push(old_vertices(examined));
    claims.push(smallest::claim_on(examined));
    claims.push(regular_depth(examined));
    (claims, certificates)
}

/// The equality that the proof has computed, at old vertices.
fn old_vertices(examined: &[Examined]) -> Claim {
    let meshes = meshes::counterexamples();
    let truth = meshes.iter().map(|authored| {
        let pair = Pair::new(authored.topology()).ok()?;
        let net: Vec<Rational> = authored
            .points
            .iter()
            .map(|p| ratio(p[0] + 3 * p[1] - p[2], 1))
            .collect();
        let compared = pair.compare(&net).ok()?;
        Some((0..net.len()).all(|v| {
            let rate = super::lengths::rate::<Rational>(pair.coarse.valence(v as u32));
            rate.is_some_and(|r| compared.fine[v] == r * &compared.coarse[v])
        }))
    });
    let old = all_of(truth);
    let inserted = examined.iter().all(|e| e.lengths.recurrence(0));
    claim(
        "theorem-3-old-vertices",
        "proof of Theorem 3",
        "Replacing the points of level k+1 by their expressions at level k gives |5/8 - nβ| times the \
         displacement of level k.",
        Verdict::of(old.map(|old| old && inserted)),
        "an equality at the vertices of level k: P' - m' = (5/8 - nβ)(P - m), m the mean of the ring. For \
         vertices inserted in edges, most of level k+1, the expression is another one: see \
         theorem-3-recurrence",
        "all valences",
    )
}

/// "For a regular mesh k > log_4(M_0/ε)": an accuracy at which the torus is not near enough.
fn regular_depth(examined: &[Examined]) -> Claim {
    let torus = examined.iter().find(|e| {
        let [valences, _] = e.authored.topology().valence_histograms();
        valences.keys().all(|&n| n == 6)
    });
    let found = torus.map(|e| {
        // ε^2 between M_0^2 / 16 and M_1^2: the depth is 1, and level 1 has a vertex farther than ε.
        let [m_0, m_1] = [0, 1].map(|k: usize| e.lengths.displacements[k].clone());
        let epsilon = (&m_0 * ratio(1, 16) + &m_1) * ratio(1, 2);
        let squares = [&m_0, &epsilon].map(|x| Enclosure::exactly(x.clone()));
        let depth = super::depth::corollary_3(&squares[0], &squares[1], &Enclosure::exactly(Rational::ratio(1, 16)));
        let refuted = depth == Some(1) && m_1 > epsilon && !m_0.is_zero();
        (refuted, format!(
            "{}: M_0/ε = {} asks for {} step, after which a vertex is still {} ε from its limit",
            e.authored.name,
            root(&(&m_0 / &epsilon)).decimal(DIGITS),
            depth.map_or("?".into(), |d| d.to_string()),
            root(&(&m_1 / &epsilon)).decimal(DIGITS)
        ))
    });
    let certificates = match torus {
        Some(e) => vec![format!(
            "lanquetin-neveu-rate-{}.json",
            e.authored.name.trim_start_matches("lanquetin-neveu-")
        )],
        None => Vec::new(),
    };
    Claim {
        certificates,
        ..claim(
            "corollary-3-regular",
            "after Corollary 3",
            "For a regular mesh, n = 6, k > log_4(M_0/ε) steps suffice.",
            Verdict::of(found.as_ref().map(|f| !f.0)),
            found.map_or("no regular mesh".into(), |f| f.1),
            "n = 6",
        )
    }
}
