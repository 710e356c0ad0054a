//! Figure 5: an eigenspline whose distance from its facets is not taken at a vertex.
//!
//! The net is (Re chi, Im chi, t Re y), y the mode of a frequency (2), ring radius 1, for n = 8. The surface over S_n
//! is sampled at limit points, which lie on it; a lower bound of the distance to each facet of the two-ring is
//! certified for the best of them. The paper gives no normalisation, so its two numbers are compared as a ratio.

use super::printed;
use super::redone::WEIGHTS;
use super::saddles::Saddle as Certified;
use crate::distance::certify::{
    estimate_distance, estimate_foot, lower_bound_of_distance, upper_bound_of_distance,
};
use crate::mesh::{Mesh, Point};
use crate::paper::words::claim;
use crate::paper::{Claim, Enclosure, Verdict};
use crate::refine::{enclose_limits, enclose_refined};
use crate::scalar::float::{round_to_nearest, upper_sqrt};
use crate::scalar::{Field, Interval, Rational};
use crate::scheme::{CornerRule, Scheme};
use crate::spectrum::Rules;
use crate::spectrum::eigen_mesh::eigen_mesh;

/// Refinements, below the facets' level, whose limit points are tried.
pub(super) const SAMPLING: u32 = 4;

/// Refinements that count as "a few" ([`Saddle::coarser`]): the extremum is at none of their limit
/// points.
const FEW: u32 = 3;

/// Levels of the polyhedron: "a few steps of subdivision don't make the heuristic safe".
const LEVELS: u32 = 2;

/// The frequency of a saddle.
const FREQUENCY: u32 = 2;

/// What is found for a saddle at a level.
#[derive(Clone, Debug, PartialEq)]
pub struct Saddle {
    /// The level of the facets.
    pub level: u32,
    /// A lower bound of the distance from the surface over S_n to the facets.
    pub distance: f64,
    /// An upper bound of the distances of the vertices over S_n to their limits.
    pub heuristic: f64,
    /// An upper bound of the distances, to the facets, of the limit points of three refinements.
    pub coarser: f64,
    /// The farthest point found, and the foot point on its nearest facet; for pictures.
    pub farthest: [[f64; 3]; 2],
}

/// The open mesh of the two-ring, rounded to multiples of 2^-40: what is certified is about these
/// coordinates.
pub fn mesh(n: u32, frequency: u32, amplitude: f64) -> Option<Mesh> {
    let amplitude = Rational::from_float(amplitude)?;
    let net = eigen_mesh(Rules::Loop(WEIGHTS), n, frequency, &amplitude)?.mesh;
    let nearest = |p: &Point<Rational>| Point(p.0.each_ref().map(round_to_nearest));
    Some(Mesh {
        topology: net.topology,
        positions: net.positions.iter().map(nearest).collect(),
    })
}

impl Saddle {
    /// For a valence, a frequency, an amplitude and a level of the facets.
    pub fn of(n: u32, frequency: u32, amplitude: f64, level: u32) -> Option<Self> {
        Self::of_mesh(&mesh(n, frequency, amplitude)?, level, SAMPLING)
    }

    /// The same for any mesh of a two-ring ([`meshes::two_ring`]), sampled at the limit points so many levels
    /// below that of the facets.
    ///
    /// [`meshes::two_ring`]: super::meshes::two_ring
    pub fn of_mesh(mesh: &Mesh, level: u32, sampling: u32) -> Option<Self> {
        let scheme = Scheme::Loop(WEIGHTS);
        let refined = |m| enclose_refined(scheme, CornerRule::Smooth, mesh, m).ok();
        let (coarse, facets) = refined(level)?;
        let coarse_limits = enclose_limits(scheme, CornerRule::Smooth, &coarse, &facets).ok()?;
        let (fine, points) = refined(sampling + level)?;
        let limits = enclose_limits(scheme, CornerRule::Smooth, &fine, &points).ok()?;
        // Faces of S_n: the first of the four of a sector, and its descendants.
        let of_sector = |face: u32, m: u32| (face >> (2 * m)).is_multiple_of(4);
        let vertices = |topology: &crate::mesh::Topology, m: u32| {
            let faces = (0..topology.face_count()).filter(|&f| of_sector(f, m));
            let mut found: Vec<u32> = faces.flat_map(|f| topology.corners(f).to_vec()).collect();
            found.sort_unstable();
            found.dedup();
            found
        };
        let corners: Vec<[[f64; 3]; 3]> = (0..coarse.face_count())
            .map(|f| {
                let c = coarse.corners(f);
                [0, 1, 2].map(|i| facets.positions[c[i] as usize].0)
            })
            .collect();
        let nearest = |p: &[f64; 3]| {
            let distances = corners.iter().map(|t| estimate_distance(*p, *t));
            distances.fold(f64::INFINITY, f64::min)
        };
        let sampled = vertices(&fine, sampling + level);
        let best = sampled
            .iter()
            .map(|&v| (v, nearest(&limits.positions[v as usize].0)))
            .fold((0, -1.0), |best, at| if at.1 > best.1 { at } else { best });
        let around = |p: &[f64; 3], radius: f64| {
            Point(p.map(|x| Interval::point(x) + Interval::new(-radius, radius)))
        };
        let point = around(&limits.positions[best.0 as usize].0, limits.radius);
        let farthest = limits.positions[best.0 as usize].0;
        let away = |t: &[[f64; 3]; 3]| estimate_distance(farthest, *t);
        let facet = corners.iter().min_by(|s, t| away(s).total_cmp(&away(t)))?;
        let below = |t: &[[f64; 3]; 3]| {
            lower_bound_of_distance(&point, &t.each_ref().map(|x| around(x, facets.radius)))
        };
        // Refinement keeps the numbers of vertices.
        let few = refined(level + sampling.min(FEW))?.0.vertex_count();
        let above = |v: &u32| {
            let p = around(&limits.positions[*v as usize].0, limits.radius);
            let to = |t: &[[f64; 3]; 3]| {
                upper_bound_of_distance(&p, &t.each_ref().map(|x| around(x, facets.radius)))
            };
            corners.iter().map(to).fold(f64::INFINITY, f64::min)
        };
        let coarser = sampled.iter().filter(|v| **v < few).map(above);
        let coarser = coarser.fold(0.0, f64::max);
        let mut heuristic = 0.0_f64;
        for v in vertices(&coarse, level) {
            let ends = [
                around(&facets.positions[v as usize].0, facets.radius),
                around(&coarse_limits.positions[v as usize].0, coarse_limits.radius),
            ];
            let [x, y, z] = (ends[0] - &ends[1]).0;
            let square = x.sqr() + y.sqr() + z.sqr();
            heuristic = heuristic.max(square.sup());
        }
        Some(Saddle {
            level,
            distance: corners.iter().map(below).fold(f64::INFINITY, f64::min),
            heuristic: upper_sqrt(heuristic),
            coarser,
            farthest: [farthest, estimate_foot(farthest, *facet)],
        })
    }

    /// The ratio, at least.
    pub fn ratio(&self) -> f64 {
        (self.distance / self.heuristic).next_down()
    }
}

/// The claims; for those that rest on them, the certificates.
pub fn claims(saddles: &[Certified]) -> Vec<Claim> {
    let (n, distance, at_vertex) = printed::FIGURE_5;
    let levels: Option<Vec<Saddle>> = (0..=LEVELS)
        .map(|m| Saddle::of(n, FREQUENCY, 1.0, m))
        .collect();
    let Some(found) = levels else {
        return Vec::new();
    };
    let printed_ratio = Enclosure::exactly(distance.exact() / at_vertex.exact());
    let describe = |s: &Saddle| {
        format!(
            "m = {}: at least {:.6} against at most {:.6}",
            s.level, s.distance, s.heuristic
        )
    };
    let texts: Vec<String> = found.iter().map(describe).collect();
    let unsafe_at = |s: &Saddle| s.distance > s.heuristic;
    let loops = |s: &&Certified| s.scheme == Scheme::Loop(WEIGHTS);
    let own = saddles.iter().filter(loops).find(|s| s.valence == n);
    let own = own.and_then(|s| Some((s.name.clone(), s.proved()?)));
    let proved = own.as_ref().map_or("-".into(), |(_, (h, vertex))| {
        let ratio = Enclosure::exactly(h.lo.clone() / vertex);
        let vertex = Enclosure::exactly(vertex.clone()).decimal(6);
        format!(
            "the distance is in {}, that of vertices at most {vertex}: {} times as much at least, {} as printed; the \
             paper's normalisation is not known. {}",
            h.decimal(5),
            ratio.decimal(2),
            printed_ratio.decimal(2),
            sentence(saddles.iter().filter(loops).filter(|s| s.valence != n))
        )
    });
    let scope = format!("Loop, n = {n}, frequency {FREQUENCY}, ring radius 1, amplitude 1");
    let quads = || saddles.iter().filter(|s| s.scheme == Scheme::CatmullClark);
    let beaten = |s: &Certified| s.proved().map(|(h, vertex)| h.lo > vertex);
    let names = |list: &mut dyn Iterator<Item = &Certified>| list.map(|s| s.name.clone()).collect();
    vec![
        Claim {
            certificates: names(&mut saddles.iter().filter(loops)),
            ..claim(
                "figure-5",
                "Figure 5; (ii)",
                format!(
                    "For the saddle of n = {n} the largest distance of a control point to its limit underestimates the \
                     distance between surface and facets: {at_vertex} against {distance}."
                ),
                Verdict::of(own.map(|(_, (h, vertex))| h.lo > vertex)),
                proved,
                scope.clone(),
            )
        },
        claim(
            "figure-5-interior",
            "Figure 5",
            "The extremum is not taken on at a vertex or some vertex after a few binary refinements.",
            Verdict::of(Some(found.iter().all(|s| s.distance > s.coarser))),
            format!(
                "a limit point of {SAMPLING} refinements is farther than those of {FEW}: {}",
                (found.iter())
                    .map(|s| format!(
                        "m = {}: at least {:.6} against at most {:.6}",
                        s.level, s.distance, s.coarser
                    ))
                    .collect::<Vec<_>>()
                    .join("; ")
            ),
            scope.clone(),
        ),
        claim(
            "figure-5-steps",
            "section 5",
            "A few steps of subdivision don't make the heuristic safe.",
            Verdict::of(Some(found.iter().all(unsafe_at))),
            texts.join("; "),
            scope,
        ),
        Claim {
            certificates: names(&mut quads()),
            ..claim(
                "figure-5-catmull-clark",
                "section 5",
                "A similar example can be constructed for Catmull-Clark subdivision.",
                Verdict::of(quads().map(beaten).collect::<Option<Vec<bool>>>().and_then(
                    |beaten| (!beaten.is_empty()).then(|| beaten.into_iter().any(|b| b)),
                )),
                sentence(quads()),
                "bilinear faces",
            )
        },
    ]
}

/// How often the bound of the vertices goes into the distance, for each saddle.
fn sentence<'a>(saddles: impl Iterator<Item = &'a Certified>) -> String {
    let one = |s: &Certified| {
        let (h, vertex) = s.proved()?;
        let what = if s.grid {
            format!("the regular grid i^2 - j^2 of valence {}", s.valence)
        } else {
            format!("n = {}", s.valence)
        };
        let tiny = Rational::ratio(1, 1 << 50);
        Some(if vertex < tiny {
            format!("{what}: {}, vertices within 2^-50", h.decimal(4))
        } else {
            let ratio = Enclosure::exactly(h.lo / &vertex);
            format!("{what}: at least {} times", ratio.decimal(2))
        })
    };
    let all: Vec<String> = saddles.filter_map(one).collect();
    format!("By certificates also {}", all.join("; "))
}
