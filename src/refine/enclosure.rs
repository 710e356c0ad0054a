//! Certified enclosures of refined positions: `f64` arithmetic and an a-priori rounding bound.
//!
//! # The bound
//!
//! In the standard model of [`crate::scalar::float`], with u = 2^-53, each operation multiplies its
//! exact result by 1 + d, |d| <= u; a product also adds an e with |e| <= 2^-1075. Let M be the largest
//! |coordinate| that goes into a step. An output is `Σ w_i P_i` with `w_i >= 0`, `Σ w_i = 1`, computed
//! with weights that are off by at most `κ u` relatively; if no P_i passes through more than r
//! roundings on its way to the output, the computed value is `Σ w_i P_i (1 + t_i)`,
//! `|t_i| <= γ_(r + κ)`, so
//!
//! ```text
//! |computed - Σ w_i P_i|  <=  γ_(r + κ) Σ w_i |P_i| + underflow  <=  γ_(r + κ) M + q 2^-1074,
//! ```
//!
//! q the number of products in the expression: an e is later scaled by convex weights and by
//! (1 + u)^r < 2. The weights are midpoints of interval enclosures, so κ is computed, not assumed.
//!
//! | output | sums, in the order computed | r | q |
//! |---|---|---|---|
//! | Loop vertex, refined or limit | n - 1 additions, product, addition | n + 1 | 2 |
//! | boundary | addition, product, addition | 3 | 2 |
//! | edge of triangles | per face: addition, product, addition; addition | 4 | 4 |
//! | lifted face sum (m-gon) | m - 1 additions, product | m | 1 |
//! | face point | lifted sum, product | m + 1 | 2 |
//! | edge between polygons | per face: lifted sum, product, addition; addition | m + 3 | 6 |
//! | Catmull-Clark vertex, refined or limit | lifted sum, n additions, product, addition | m + n + 2 | n + 4 |
//! | Doo-Sabin corner | product, m - 1 additions | m | m |
//! | Doo-Sabin limit, k faces | corner, k - 1 additions, product | m + k | k m + 1 |
//!
//! Sums start from 0, an exact first addition. Round a Catmull-Clark vertex each face adds
//! `neighbour + j face`, j = 1 or 2: one addition, the products being exact. Two weights occur on a
//! path where there is a lifted sum or a limit mean: then 2 κ counts.
//!
//! If the positions of level k are within E_k of the exact ones, applying the exact mask keeps that
//! distance (it is a convex combination), so `E_(k+1) = E_k + γ_(r + κ) M_k + q 2^-1074`. M_k is read off
//! the computed positions ([`Refiner::enclose_into`]) or bounded in advance by L + E_k, L the
//! largest |coordinate| of level 0 ([`position_error_bound`]).

use super::corners::parallel;
use super::error::RefineError;
use super::masks::{Masks, Present, Target};
use super::topology::{check, refine_topology};
use super::{Refiner, positions};
use crate::mesh::{Mesh, Point, Topology};
use crate::scalar::Interval;
use crate::scalar::float::{UNIT_ROUNDOFF, gamma};
use crate::scheme::{CornerRule, Scheme};
use rayon::prelude::*;

/// A certified enclosure of all positions: the exact ones differ by at most `radius` in each
/// coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct Enclosed {
    /// One point per vertex.
    pub positions: Vec<Point<f64>>,
    /// The largest possible difference, per coordinate, in the unit of the positions.
    pub radius: f64,
}

/// How much one step can add to the error: `γ_(roundings) M + products 2^-1074`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RefinementError {
    /// r + κ, or r + 2 κ: the number of factors 1 + d on the longest path.
    pub roundings: u32,
    /// q: the number of products in the longest expression.
    pub products: u32,
    /// The largest sum of weights inside a sum, with 2 to spare: M times this must not overflow.
    pub terms: u32,
}

impl RefinementError {
    fn new(scheme: Scheme, present: &Present, weight_error: u32) -> Self {
        let n = present.valences.last().copied().unwrap_or(0).max(3); // r >= 4, for edges
        let m = present.largest_size();
        let k = present.fans.last().copied().unwrap_or(0);
        let (roundings, products) = match scheme {
            Scheme::Loop(_) => (weight_error.saturating_add(n + 1), 4),
            Scheme::CatmullClark => (
                weight_error.saturating_mul(2).saturating_add(m + n + 2),
                n + 4,
            ),
            Scheme::DooSabin => (
                weight_error.saturating_mul(2).saturating_add(m + k),
                k.max(1).saturating_mul(m).saturating_add(1),
            ),
        };
        RefinementError {
            roundings,
            products,
            terms: n.saturating_mul(3).max(m).max(k) + 2,
        }
    }

    /// An upper bound of what one step adds when no coordinate exceeds `largest`; infinite if a sum
    /// could overflow.
    pub fn step(&self, largest: f64) -> f64 {
        let room = f64::MAX / 4.0 / f64::from(self.terms);
        if largest.is_nan() || largest > room || self.roundings > 1 << 30 {
            return f64::INFINITY;
        }
        let underflow = f64::from(self.products) * f64::from_bits(1);
        ((gamma(self.roundings) * largest).next_up() + underflow).next_up()
    }
}

/// The largest |coordinate|.
///
/// # Errors
/// If and only if a coordinate is infinite or not a number.
pub fn largest_coordinate(positions: &[Point<f64>]) -> Result<f64, RefineError> {
    // Without the sign, bit patterns are ordered like the numbers, and NaN is above infinity.
    let top = |points: &[Point<f64>]| {
        let (fours, rest) = points.as_chunks::<4>();
        let mut tops = [[0_i64; 3]; 4];
        for four in fours {
            for (top, p) in tops.iter_mut().zip(four) {
                for (top, x) in top.iter_mut().zip(&p.0) {
                    *top = (*top).max((x.to_bits() << 1 >> 1) as i64);
                }
            }
        }
        let rest = rest.iter().flat_map(|p| p.0);
        let rest = rest.map(|x| (x.to_bits() << 1 >> 1) as i64);
        rest.chain(tops.into_iter().flatten()).fold(0, i64::max)
    };
    let top = if parallel(positions.len()) {
        let chunks = positions.par_chunks(1 << 14);
        chunks.map(top).reduce(|| 0, i64::max)
    } else {
        top(positions)
    };
    let largest = f64::from_bits(top as u64);
    if largest.is_finite() {
        return Ok(largest);
    }
    let bad = |p: &Point<f64>| p.0.iter().any(|x| !x.is_finite());
    let vertex = positions.iter().position(bad).unwrap_or(0) as u32;
    Err(RefineError::NotFinite { vertex })
}

/// The weights as `f64`, and κ: each is within `κ u` of the exact weight, relatively.
fn rounded_masks(
    scheme: Scheme,
    target: Target,
    present: &Present,
) -> Result<(Masks<f64>, u32), RefineError> {
    let worst = std::cell::Cell::new(0f64);
    let round = |weight: &Interval| {
        let (inf, sup, mid) = (weight.inf(), weight.sup(), weight.mid());
        if inf < sup {
            // weights are positive unless they are exactly 0
            let off = (sup - mid).max(mid - inf).next_up();
            let relative = if inf > 0.0 {
                (off / inf).next_up()
            } else {
                f64::INFINITY
            };
            worst.set(worst.get().max(relative));
        }
        Ok::<_, RefineError>(mid)
    };
    let exact = Masks::<Interval>::new(scheme, target, present, 1)?;
    let masks = exact.try_map(round, round)?;
    // dividing by a power of two is exact, and a huge κ saturates
    Ok((masks, (worst.get() / UNIT_ROUNDOFF).ceil() as u32))
}

impl Refiner<Point<f64>> {
    /// One step of refinement of positions known up to `radius`, into the memory of `out`; returns
    /// the radius of the result.
    ///
    /// # Errors
    /// As [`super::refine`]; also if a coordinate is not finite, or a sum could overflow.
    pub fn enclose_into(
        &mut self,
        topology: &Topology,
        positions: &[Point<f64>],
        radius: f64,
        out: &mut Vec<Point<f64>>,
    ) -> Result<f64, RefineError> {
        self.enclose(Target::Refined, topology, positions, radius, out)
    }

    /// The limit positions of a mesh known up to `radius`, into the memory of `out`; returns the
    /// radius of the result.
    ///
    /// # Errors
    /// As [`Refiner::enclose_into`].
    pub fn enclose_limits_into(
        &mut self,
        topology: &Topology,
        positions: &[Point<f64>],
        radius: f64,
        out: &mut Vec<Point<f64>>,
    ) -> Result<f64, RefineError> {
        self.enclose(Target::Limit, topology, positions, radius, out)
    }

    fn enclose(
        &mut self,
        target: Target,
        topology: &Topology,
        points: &[Point<f64>],
        radius: f64,
        out: &mut Vec<Point<f64>>,
    ) -> Result<f64, RefineError> {
        positions::check_arguments(self.scheme, self.corner, topology, points)?;
        check(self.scheme, topology)?;
        let present = Present::new(self.scheme, target, topology);
        let (masks, weight_error) = rounded_masks(self.scheme, target, &present)?;
        let added = RefinementError::new(self.scheme, &present, weight_error)
            .step(largest_coordinate(points)?);
        if added == f64::INFINITY {
            return Err(too_large(points));
        }
        let apply = match target {
            Target::Refined => positions::refined::<f64, Point<f64>>,
            Target::Limit => positions::limits::<f64, Point<f64>>,
        };
        apply(&masks, self.corner, topology, points, out);
        Ok((radius + added).next_up())
    }
}

/// The refusal of finite coordinates that leave no room for sums.
fn too_large(points: &[Point<f64>]) -> RefineError {
    let size = |p: &Point<f64>| p.0.iter().fold(0f64, |top, x| top.max(x.abs()));
    let largest = (0..points.len()).max_by(|&a, &b| size(&points[a]).total_cmp(&size(&points[b])));
    RefineError::NotFinite {
        vertex: largest.unwrap_or(0) as u32,
    }
}

/// The mesh after `levels` steps, its positions enclosed; the input is taken as exact.
///
/// # Errors
/// As [`Refiner::enclose_into`].
pub fn enclose_refined(
    scheme: Scheme,
    corner: CornerRule,
    mesh: &Mesh<f64>,
    levels: u32,
) -> Result<(Topology, Enclosed), RefineError> {
    let mut refiner = Refiner::new(scheme, corner);
    let mut topology = mesh.topology.clone();
    let mut level = Enclosed {
        positions: mesh.positions.clone(),
        radius: 0.0,
    };
    let mut next = Vec::new();
    for _ in 0..levels {
        level.radius =
            refiner.enclose_into(&topology, &level.positions, level.radius, &mut next)?;
        std::mem::swap(&mut level.positions, &mut next);
        topology = refine_topology(scheme, &topology)?;
    }
    Ok((topology, level))
}

/// The limit positions of a mesh with enclosed positions.
///
/// # Errors
/// As [`Refiner::enclose_into`].
pub fn enclose_limits(
    scheme: Scheme,
    corner: CornerRule,
    topology: &Topology,
    level: &Enclosed,
) -> Result<Enclosed, RefineError> {
    let mut positions = Vec::new();
    let radius = Refiner::new(scheme, corner).enclose_limits_into(
        topology,
        &level.positions,
        level.radius,
        &mut positions,
    )?;
    Ok(Enclosed { positions, radius })
}

/// An upper bound, known before refining, of the error of `f64` positions after `levels` steps from
/// exact positions with no |coordinate| above `largest`: E_levels of the [module's](self) recursion.
///
/// It holds for the enclosing functions here, whose weights are midpoints of enclosures; infinite
/// if a sum could overflow.
///
/// # Errors
/// If and only if the scheme refuses the mesh.
pub fn position_error_bound(
    scheme: Scheme,
    topology: &Topology,
    largest: f64,
    levels: u32,
) -> Result<f64, RefineError> {
    check(scheme, topology)?;
    let mut present = Present::new(scheme, Target::Refined, topology);
    let mut error = 0f64;
    for level in 0..levels {
        if level > 0 {
            present = finer(scheme, topology, present);
        }
        let (_, weight_error) = rounded_masks(scheme, Target::Refined, &present)?;
        let step = RefinementError::new(scheme, &present, weight_error);
        error = (error + step.step((largest + error).next_up())).next_up();
    }
    Ok(error)
}

/// The valences and face sizes one level on; `present` are those of `topology` or of a refinement.
fn finer(scheme: Scheme, topology: &Topology, present: Present) -> Present {
    let join = |mut a: Vec<u32>, b: &[u32]| {
        a.extend_from_slice(b);
        a.sort_unstable();
        a.dedup();
        a
    };
    let Present {
        valences,
        fans,
        sizes,
    } = present;
    match scheme {
        Scheme::Loop(_) => Present {
            valences: join(valences, &[6]),
            fans,
            sizes,
        },
        Scheme::CatmullClark => Present {
            valences: join(join(valences, &sizes), &[4]),
            fans,
            sizes: vec![4],
        },
        Scheme::DooSabin => {
            let coarse = Present::new(Scheme::CatmullClark, Target::Refined, topology);
            Present {
                valences,
                fans,
                sizes: join(join(sizes, &coarse.valences), &[4]),
            }
        }
    }
}
