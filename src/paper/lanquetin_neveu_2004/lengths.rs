//! What Theorem 3 says of a mesh in space, in exact squares.

use num_traits::Zero;

use super::extremal::LOOP;
use crate::mesh::{Mesh, Point};
use crate::paper::Enclosure;
use crate::paper::Verdict;
use crate::refine::{RefineError, limit_positions, refine};
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::{CornerRule, LoopWeights, loop_scheme};

/// Squares of the lengths of a mesh, valences 3, 4 and 6 only.
#[derive(Clone, Debug)]
pub struct Lengths {
    /// M_0^2, M_1^2, ..
    pub displacements: Vec<Rational>,
    /// The largest of `5/8 - nβ` over the valences, 6 among them.
    pub rate: Rational,
    /// The largest |S - F|^2 at the middle of an edge, and the edge, vertices from 0.
    pub middle: (Rational, [u32; 2]),
}

fn largest_square(points: impl Iterator<Item = Point<Rational>>) -> Rational {
    let squares = points.map(|p| p.norm_squared());
    squares.fold(Rational::zero(), |m, x| if x > m { x } else { m })
}

/// M^2 of a mesh, the square of its largest vertex displacement.
pub fn displacement_square(mesh: &Mesh<Rational>) -> Result<Rational, RefineError> {
    let smooth = CornerRule::Smooth;
    let limits = limit_positions::<Rational, _>(LOOP, smooth, &mesh.topology, &mesh.positions)?;
    let pairs = mesh.positions.iter().zip(&limits);
    Ok(largest_square(pairs.map(|(p, limit)| p.clone() - limit)))
}

/// `5/8 - nβ`, weights of Loop 1987; `None` if the arithmetic has no cosine for it.
pub fn rate<S: Field>(n: u32) -> Option<S> {
    let sum = loop_scheme::ring_weight_sum::<S>(LoopWeights::Original, n)?;
    Some(S::ratio(5, 8) - &sum)
}

impl Lengths {
    /// Of a mesh and its refinements up to a level, at least 1.
    ///
    /// # Errors
    /// If and only if a valence is none of 3, 4, 6.
    pub fn of(mesh: &Mesh<Rational>, levels: u32) -> Result<Self, RefineError> {
        let mut displacements = vec![displacement_square(mesh)?];
        let smooth = CornerRule::Smooth;
        let first = refine(LOOP, smooth, mesh, 1)?;
        let limits =
            limit_positions::<Rational, _>(LOOP, smooth, &first.topology, &first.positions)?;
        let half = Rational::ratio(1, 2);
        let mut middle = (Rational::zero(), [0, 0]);
        for edge in 0..mesh.topology.edge_count() {
            let [h, _] = mesh.topology.edge_halfedges(edge);
            let ends = [mesh.topology.origin(h), mesh.topology.target(h)];
            let [a, b] = ends.map(|v| &mesh.positions[v as usize]);
            let chord = (a.clone() + b) * &half;
            let at = (mesh.topology.vertex_count() + edge) as usize;
            let square = (limits[at].clone() - &chord).norm_squared();
            if square > middle.0 {
                middle = (square, ends);
            }
        }
        let mut level = first;
        displacements.push(displacement_square(&level)?);
        for _ in 1..levels {
            level = refine(LOOP, smooth, &level, 1)?;
            displacements.push(displacement_square(&level)?);
        }
        let valences = mesh.topology.valence_histograms()[0].clone();
        let mut largest = Rational::zero();
        for n in valences.into_keys().chain([6]) {
            let of_n = rate::<Rational>(n).ok_or(RefineError::Unrepresentable {
                what: "valence",
                size: n,
            })?;
            if of_n > largest {
                largest = of_n;
            }
        }
        Ok(Lengths {
            displacements,
            rate: largest,
            middle,
        })
    }

    /// Whether `M_(k+1) <= rate M_k`.
    pub fn recurrence(&self, k: usize) -> bool {
        let rate = &self.rate * &self.rate;
        self.displacements[k + 1] <= rate * &self.displacements[k]
    }

    /// Whether `M_k <= rate^k M_0`.
    pub fn power(&self, k: usize) -> bool {
        let rate = (&self.rate * &self.rate).pow(k as i32);
        self.displacements[k] <= rate * &self.displacements[0]
    }

    /// Whether `|S - F| <= M_0` at the middles of all edges.
    pub fn middles(&self) -> bool {
        self.middle.0 <= self.displacements[0]
    }

    /// `M_k / M_0`, to some 15 digits.
    pub fn ratio(&self, k: usize) -> Enclosure {
        root(&(&self.displacements[k] / &self.displacements[0]))
    }

    /// The largest distance at the middle of an edge over M_0.
    pub fn middle_ratio(&self) -> Enclosure {
        root(&(&self.middle.0 / &self.displacements[0]))
    }
}

/// The square root of a rational, between two fractions over 10^15.
pub fn root(square: &Rational) -> Enclosure {
    let scale = <Rational as Ring>::from_integer(10).pow(15);
    let floor = (square * &scale * &scale).floor().to_integer().sqrt();
    let low = Rational::from_integer(floor) / &scale;
    match &low * &low == *square {
        true => Enclosure::exactly(low),
        false => Enclosure::new(
            low.clone(),
            low + Rational::new(1.into(), scale.to_integer()),
        ),
    }
}

/// True if every part is, else refuted.
pub fn every(parts: impl IntoIterator<Item = bool>) -> Verdict {
    Verdict::of(Some(parts.into_iter().all(|part| part)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots() {
        assert_eq!(
            root(&Rational::ratio(9, 4)),
            Enclosure::exactly(Rational::ratio(3, 2))
        );
        let two = root(&Rational::ratio(2, 1));
        assert_eq!(two.decimal(12), "1.414213562373");
    }
}
