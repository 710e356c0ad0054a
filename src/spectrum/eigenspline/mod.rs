//! Distances of Loop's eigensplines from their polyhedra: Peters & Wu's constants μ(m, n, i), two-sided.
//!
//! For a mode y with eigenvalue λ and spline e over S_n, and the characteristic map χ with eigenvalue λ_1:
//!
//! ```text
//! μ_m = sup over S_n of |e(σ) - E_m(χ(σ))|
//! ```
//!
//! E_m is affine on each facet of level m, whose vertices lie at the level-m net of χ and have the values
//! of the level-m net of y; against `limit`, both nets are replaced by their limit points. For a complex
//! mode this is the supremum over all its real combinations. Source: Peters & Wu 2009, Definitions 2.1,
//! 2.2 and (18), where the constants are used and not printed; `proofs/FORMAT.md`, section 9.
//!
//! **From ring to ring.** Scaling (their Lemma 3): over ring r the distance from the facets of level m is
//! |λ|^r times that over ring 0 from the facets of level m - r. So
//!
//! ```text
//! μ_m = max( |λ|^r D_(m-r), r = 0..m;  |λ|^m N )
//! ```
//!
//! with D_s the supremum over ring 0 against the facets of level s, and N that over all rings r >= 1 and
//! the centre against the facets of level 0. These are enclosed, in intervals.
//!
//! | file | idea |
//! |---|---|
//! | [`mode`] | the modes as nets of a sector or two |
//! | [`lattice`] | their control nets of all levels |
//! | [`facets`] | which facets lie under a part of a patch |
//! | [`facet_bound`] | a bound over one facet |
//! | [`plane`] | the patches of χ, for all modes of a valence |
//! | [`maximum`], [`reach`] | the supremum over patches: from above, from below |
//! | [`near`] | the rings towards the centre |
//! | [`scaling`] | from D and N to μ |
//! | [`certificates`] | all this as certificates |
//! | [`table`] | upper bounds, for programs in a hurry |

use std::fmt;

use rayon::prelude::*;

use crate::scalar::{Interval, Rational};
use crate::scheme::LoopWeights;

pub mod certificates;
pub mod complex;
pub mod facet_bound;
pub mod facets;
pub mod lattice;
pub mod maximum;
pub mod mode;
pub mod near;
pub mod plane;
pub mod reach;
pub mod scaling;
pub mod table;

use lattice::{Levels, Triangle};
use maximum::{Start, enclose};
use mode::{Label, Net, nets};
use plane::{Plane, patch_level, spline, vertices};
use scaling::{above, below};

/// Which polyhedron an eigenspline is held against.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Against {
    /// The control polyhedron.
    Control,
    /// The polyhedron of the limit points.
    Limit,
}

impl Against {
    /// The radius that the facets of level 0 are known to.
    const fn radius(self) -> i32 {
        match self {
            Against::Control => 3,
            Against::Limit => 2,
        }
    }
}

impl fmt::Display for Against {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Against::Control => "control",
            Against::Limit => "limit",
        })
    }
}

/// The distances of one mode, with what proves them.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeDistances {
    /// Which mode.
    pub label: Label,
    /// `lo <= μ_m <= hi`, m = 0, 1, ..
    pub distances: Vec<[Rational; 2]>,
    /// D_s, s = 0, 1, ..
    pub rings: Vec<Enclosed>,
    /// N.
    pub near: Enclosed,
    /// The number of rings that are looked at one by one for N.
    pub depth: u32,
}

/// A supremum between two numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosed {
    /// Lower bound: the value at the place is at least this.
    pub lo: Rational,
    /// Upper bound.
    pub hi: Rational,
    /// Where; `None` for the centre.
    pub place: Option<SplinePoint>,
}

/// A point of the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct SplinePoint {
    /// The ring.
    pub ring: u32,
    /// The sector.
    pub sector: usize,
    /// The triangle of the lattice; its level is that of the patches.
    pub triangle: Triangle,
    /// The parameters in it.
    pub at: [Rational; 2],
}

/// The distances μ_0 .. μ_levels of all modes of valence n but the constant and the characteristic map
/// (whose are 0), in the order of [`crate::spectrum::loop_modes::loop_modes`]; at n = 3 the mode `ray` of
/// frequency 0 comes first, which the chain of the mode `ring` of frequency 0 leads to.
///
/// Guarantee: the enclosures hold; every number was enclosed by intervals and rounded outward. They are
/// the same for any number of threads. `None` if a part of the surface could not be brought over certain
/// facets, which did not happen for n = 3..30.
///
/// # Panics
/// If n < 3.
pub fn distances(
    weights: LoopWeights,
    n: u32,
    against: Against,
    levels: usize,
) -> Option<Vec<ModeDistances>> {
    let (chi, modes) = nets::<Interval>(weights, n)?;
    distances_of(n, &chi, &modes, against, levels)
}

/// [`distances`] of some modes; those that chains lead to must be among them, earlier.
pub fn distances_of(
    n: u32,
    chi: &Net<Interval>,
    modes: &[Net<Interval>],
    against: Against,
    last: usize,
) -> Option<Vec<ModeDistances>> {
    let finest = patch_level(last);
    let plane = Plane::new(
        n,
        &Levels::new(chi, None, finest),
        chi.eigenvalue,
        against,
        last,
    );
    let solved = modes.par_iter().map(|net| {
        let chain = match &net.kappa {
            Some(kappa) => Some((Levels::new(chained(modes)?, None, finest), *kappa)),
            None => None,
        };
        let chain = chain.as_ref().map(|(levels, kappa)| (levels, kappa));
        let nets = Levels::new(net, chain, finest);
        let rings = (0..=last).map(|s| ring_bound(&plane, net.label, &nets, s, against));
        let rings = rings.collect::<Option<Vec<_>>>()?;
        let (near, depth) = near::enclose_near(&plane, net, &nets, chain, against)?;
        Some((rings, near, depth))
    });
    let solved = solved.collect::<Option<Vec<_>>>()?;
    let chained_bounds = (modes.iter().zip(&solved))
        .find(|(net, _)| net.label == mode::CHAINED)
        .map(|(_, (rings, near, _))| (rings.as_slice(), near));
    let of = |(net, (rings, near, depth)): (&Net<Interval>, &(Vec<Enclosed>, Enclosed, u32))| {
        let chain = net.kappa.zip(chained_bounds);
        ModeDistances {
            label: net.label,
            distances: scaling::distances(net.eigenvalue, rings, near, chain),
            rings: rings.clone(),
            near: near.clone(),
            depth: *depth,
        }
    };
    Some(modes.iter().zip(&solved).map(of).collect())
}

/// The mode that a chain leads to.
fn chained(modes: &[Net<Interval>]) -> Option<&Net<Interval>> {
    modes.iter().find(|net| net.label == mode::CHAINED)
}

/// Relative gaps that are aimed at for D_0, D_1, .., neither more nor less: on fine levels hundreds of
/// facets are nearly equal, and each of them would have to be looked at closely, here and by who checks.
const GAPS: [f64; 6] = [1e-4, 1e-4, 2e-4, 3e-4, 5e-4, 7e-4];

/// D_s.
fn ring_bound(
    plane: &Plane,
    label: Label,
    nets: &Levels<Interval>,
    s: usize,
    against: Against,
) -> Option<Enclosed> {
    let patches = (plane.rings[s].iter())
        .filter(|patch| !label.is_mirror_symmetric() || patch.triangle.p >= patch.triangle.q);
    let patches: Vec<_> = patches.collect();
    let start = |sector: usize| {
        patches.iter().map(move |&patch| Start {
            patch,
            sector,
            ring: 0,
            spline: spline(nets, patch_level(s), sector, patch.triangle),
            facets: (patch.candidates.iter())
                .map(|facet| vertices(nets, s, sector, facet.triangle, against))
                .collect(),
        })
    };
    let starts: Vec<Start> = (0..label.sectors()).flat_map(start).collect();
    let gap = GAPS[s.min(GAPS.len() - 1)];
    let found = enclose(&starts, 0.0, gap)?;
    let value = found.reached.map_or(0.0, |reached| reached.value);
    Some(Enclosed {
        lo: below(value),
        hi: above(found.hi.max(value * (1.0 + gap))),
        place: found.reached.map(|reached| reached.place(&starts)),
    })
}
