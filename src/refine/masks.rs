//! The weights that one call needs, computed once per valence and face size.

use super::corners::BOUNDARY;
use super::error::RefineError;
use crate::mesh::Topology;
use crate::scalar::{Field, Ring};
use crate::scheme::{
    LoopWeights, Scheme, StarMask, boundary, catmull_clark, doo_sabin, loop_scheme,
};

/// Which point of a vertex is wanted: the next level's, or the limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// One step of refinement.
    Refined,
    /// The limit position.
    Limit,
}

/// The valences of interior vertices and the sizes of faces that occur.
#[derive(Clone, Debug, Default)]
pub(crate) struct Present {
    /// Valences of interior vertices, ascending.
    pub valences: Vec<u32>,
    /// Numbers of faces at a vertex, ascending; filled for Doo-Sabin limits only.
    pub fans: Vec<u32>,
    /// Face sizes, ascending.
    pub sizes: Vec<u32>,
}

/// The distinct values of `values` below 2^31, ascending; values from 2^31 on and 0 are left out.
fn distinct(values: impl Iterator<Item = u32> + Clone) -> Vec<u32> {
    // Small values by one branch-free pass over a bit set; bit 63 stands for all larger ones.
    let bits = values.clone().fold(0u64, |bits, value| {
        bits | 1
            << if value & BOUNDARY != 0 {
                0
            } else {
                value.min(63)
            }
    });
    let mut found: Vec<u32> = (1..63).filter(|&value| bits >> value & 1 != 0).collect();
    if bits >> 63 != 0 {
        let mut large: Vec<u32> = values
            .filter(|value| (63..BOUNDARY).contains(value))
            .collect();
        large.sort_unstable();
        large.dedup();
        found.append(&mut large);
    }
    found
}

impl Present {
    pub(crate) fn new(scheme: Scheme, target: Target, topology: &Topology) -> Self {
        let mut present = Present::default();
        if scheme == Scheme::DooSabin {
            if target == Target::Limit {
                let fan = |word: u32| (word & !BOUNDARY) - u32::from(word & BOUNDARY != 0);
                present.fans = distinct(topology.valence.iter().map(|&word| fan(word)));
            }
        } else {
            present.valences = distinct(topology.valence.iter().copied());
        }
        if !matches!(scheme, Scheme::Loop(_)) {
            present.sizes = match topology.arity() {
                Some(m) => vec![m],
                None => distinct((0..topology.face_count()).map(|f| topology.face_size(f))),
            };
        }
        present
    }

    /// The largest number of sides of a face, 0 if not needed.
    pub(crate) fn largest_size(&self) -> u32 {
        self.sizes.last().copied().unwrap_or(0)
    }
}

/// All weights of one application of a scheme, of type W.
#[derive(Clone, Debug)]
pub(crate) enum Masks<W> {
    /// Loop and Catmull-Clark.
    Star(StarMasks<W>),
    /// Doo-Sabin.
    Corner(CornerMasks<W>),
}

/// `center P + ring Σ t`.
#[derive(Clone, Debug)]
pub(crate) struct RingMask<W> {
    /// The vertex.
    pub center: W,
    /// The sum over its faces.
    pub ring: W,
}

/// Weights of Loop and Catmull-Clark.
///
/// Each point of a vertex or edge is a sum over its faces, so that one pass over faces serves all:
///
/// - vertex: `center P + ring Σ t`, t the neighbour along the face's half-edge, for Catmull-Clark
///   `around[0] neighbour + around[1] lifted face sum`;
/// - interior edge: `Σ (edge[0] (ends) + edge[1] inner)` over its two faces, inner being the
///   opposite vertex or the lifted face sum.
///
/// Catmull-Clark's formulas use face points inside other points. So that every output is one
/// multiplication deep in the weights (`around` are small integers), they are applied to *lifted*
/// face sums `(Σ corners) lift[m] = M f`, f the face point and M `face_unit`: 1 in a field (the lifted
/// sum is the face point), a multiple of all m on a grid of integers (`lift[m] = M / m`).
#[derive(Clone, Debug)]
pub(crate) struct StarMasks<W> {
    /// By interior valence; entries of absent valences mean nothing.
    pub vertex: Vec<RingMask<W>>,
    /// See above; unscaled on a grid.
    pub around: [W; 2],
    /// A boundary vertex, and each of its neighbours along the boundary.
    pub boundary: [W; 2],
    /// Each end of a boundary edge.
    pub boundary_edge: W,
    /// One: a vertex that stays.
    pub keep: W,
    /// From each face of an interior edge: each end, and the opposite vertex or lifted face sum.
    pub edge: [W; 2],
    /// By face size, see above; unscaled on a grid. Empty for Loop.
    pub lift: Vec<W>,
    /// The lifted face sum, for the face point.
    pub face: W,
}

/// Weights of Doo-Sabin.
#[derive(Clone, Debug)]
pub(crate) struct CornerMasks<W> {
    /// By face size: the corner mask; empty for absent sizes.
    pub corner: Vec<Vec<W>>,
    /// By number of faces at a vertex: 1 / k, for the limit. Empty for refinement.
    pub mean: Vec<W>,
    /// One: a vertex without faces stays.
    pub keep: W,
}

fn table<T: Clone>(
    indices: &[u32],
    filler: T,
    mut entry: impl FnMut(u32) -> Result<T, RefineError>,
) -> Result<Vec<T>, RefineError> {
    let len = indices.last().map_or(0, |&last| last as usize + 1);
    let mut table = vec![filler; len];
    for &index in indices {
        table[index as usize] = entry(index)?;
    }
    Ok(table)
}

impl<S: Field> Masks<S> {
    /// The weights, all taken from [`crate::scheme`]: its point rules applied to unit nets.
    ///
    /// Errors if and only if a weight is not representable in S.
    pub(crate) fn new(
        scheme: Scheme,
        target: Target,
        present: &Present,
        face_unit: i64,
    ) -> Result<Self, RefineError> {
        match scheme {
            Scheme::Loop(weights) => Ok(Masks::Star(loop_masks(weights, target, present)?)),
            Scheme::CatmullClark => Ok(Masks::Star(catmull_clark_masks(
                target, present, face_unit,
            )?)),
            Scheme::DooSabin => Ok(Masks::Corner(CornerMasks {
                corner: table(&present.sizes, Vec::new(), |size| {
                    let what = "face size";
                    doo_sabin::corner_mask(size).ok_or(RefineError::Unrepresentable { what, size })
                })?,
                mean: table(&present.fans, S::one(), |k| Ok(S::ratio(1, i64::from(k))))?,
                keep: S::one(),
            })),
        }
    }
}

/// The entry of tables at absent indices: the vertex stays.
fn filler<S: Field>() -> RingMask<S> {
    RingMask {
        center: S::one(),
        ring: S::zero(),
    }
}

fn boundary_mask<S: Field>(target: Target) -> [S; 2] {
    let rule = match target {
        Target::Refined => boundary::vertex_point::<S, S>,
        Target::Limit => boundary::limit_point::<S, S>,
    };
    let (one, zero) = (S::one(), S::zero());
    [rule(&one, &zero, &zero), rule(&zero, &one, &zero)]
}

fn loop_masks<S: Field>(
    weights: LoopWeights,
    target: Target,
    present: &Present,
) -> Result<StarMasks<S>, RefineError> {
    let mask = match target {
        Target::Refined => loop_scheme::vertex_mask::<S>,
        Target::Limit => loop_scheme::limit_mask::<S>,
    };
    let (one, zero) = (S::one(), S::zero());
    let edge = loop_scheme::edge_point::<S, S>;
    Ok(StarMasks {
        vertex: table(&present.valences, filler(), |size| {
            let what = "valence";
            let mask = mask(weights, size);
            let StarMask { center, edge, .. } =
                mask.ok_or(RefineError::Unrepresentable { what, size })?;
            Ok(RingMask { center, ring: edge })
        })?,
        around: [one.clone(), zero.clone()],
        boundary: boundary_mask(target),
        boundary_edge: boundary::edge_point::<S, S>(&one, &zero),
        edge: [
            edge(&one, &zero, &zero, &zero) * &S::ratio(1, 2),
            edge(&zero, &zero, &one, &zero),
        ],
        lift: Vec::new(),
        face: S::zero(),
        keep: one,
    })
}

fn catmull_clark_vertex<S: Field>(target: Target, n: u32) -> StarMask<S> {
    match target {
        Target::Refined => catmull_clark::vertex_mask::<S>(n),
        Target::Limit => catmull_clark::limit_mask_polygons::<S>(n),
    }
}

/// `face / edge` of [`catmull_clark_vertex`], an integer that is the same for all valences.
fn faces_per_neighbour(target: Target) -> i64 {
    match target {
        Target::Refined => 1,
        Target::Limit => 2,
    }
}

fn catmull_clark_masks<S: Field>(
    target: Target,
    present: &Present,
    face_unit: i64,
) -> Result<StarMasks<S>, RefineError> {
    let (one, zero) = (S::one(), S::zero());
    let per_unit = S::ratio(1, face_unit);
    let edge = catmull_clark::edge_point::<S, S>;
    Ok(StarMasks {
        vertex: table(&present.valences, filler(), |n| {
            let StarMask { center, edge, .. } = catmull_clark_vertex::<S>(target, n);
            Ok(RingMask {
                center,
                ring: edge * &per_unit,
            })
        })?,
        around: [
            <S as Ring>::from_integer(face_unit),
            <S as Ring>::from_integer(faces_per_neighbour(target)),
        ],
        boundary: boundary_mask(target),
        boundary_edge: boundary::edge_point::<S, S>(&one, &zero),
        edge: [
            edge(&one, &zero, &zero, &zero) * &S::ratio(1, 2),
            edge(&zero, &zero, &one, &zero) * &per_unit,
        ],
        lift: table(&present.sizes, one.clone(), |m| {
            let unit = <S as Ring>::from_integer(face_unit);
            Ok(if face_unit == 1 {
                catmull_clark::face_point::<S, S>(&one, m)
            } else {
                catmull_clark::face_point::<S, S>(&unit, m)
            })
        })?,
        face: per_unit,
        keep: one,
    })
}

impl<A> Masks<A> {
    /// The same weights in another type. `scaled` maps weights of outputs, `plain` the lifts.
    pub(crate) fn try_map<B, E>(
        &self,
        mut scaled: impl FnMut(&A) -> Result<B, E>,
        mut plain: impl FnMut(&A) -> Result<B, E>,
    ) -> Result<Masks<B>, E> {
        Ok(match self {
            Masks::Star(masks) => {
                let mut vertex = Vec::with_capacity(masks.vertex.len());
                for mask in &masks.vertex {
                    vertex.push(RingMask {
                        center: scaled(&mask.center)?,
                        ring: scaled(&mask.ring)?,
                    });
                }
                let lift: Result<Vec<B>, E> = masks.lift.iter().map(&mut plain).collect();
                Masks::Star(StarMasks {
                    vertex,
                    around: [plain(&masks.around[0])?, plain(&masks.around[1])?],
                    boundary: [scaled(&masks.boundary[0])?, scaled(&masks.boundary[1])?],
                    boundary_edge: scaled(&masks.boundary_edge)?,
                    keep: scaled(&masks.keep)?,
                    edge: [scaled(&masks.edge[0])?, scaled(&masks.edge[1])?],
                    lift: lift?,
                    face: scaled(&masks.face)?,
                })
            }
            Masks::Corner(masks) => {
                let mut corner = Vec::with_capacity(masks.corner.len());
                for mask in &masks.corner {
                    let mask: Result<Vec<B>, E> = mask.iter().map(&mut scaled).collect();
                    corner.push(mask?);
                }
                let mean: Result<Vec<B>, E> = masks.mean.iter().map(&mut plain).collect();
                Masks::Corner(CornerMasks {
                    corner,
                    mean: mean?,
                    keep: scaled(&masks.keep)?,
                })
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scalar::Rational;

    #[test]
    fn a_face_counts_as_so_many_neighbours_at_any_valence() {
        for target in [Target::Refined, Target::Limit] {
            let ratio = <Rational as Ring>::from_integer(faces_per_neighbour(target));
            for n in 1..40 {
                let mask = catmull_clark_vertex::<Rational>(target, n);
                assert_eq!(mask.face, mask.edge * &ratio, "{target:?}, valence {n}");
            }
        }
    }
}
