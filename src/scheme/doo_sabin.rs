//! Doo-Sabin: masks and local nets.

mod local_net;

pub use local_net::*;

use crate::scalar::{Field, Module};

/// The corner mask of an n-gon: the new corner 0 is `Σ a_j P_j`, `a_0 = (n+5)/(4n)`,
/// `a_j = (3 + 2 cos(2πj/n)) / (4n)`.
///
/// `None` if and only if the type cannot represent 2 cos 2π/n (rationals: n other than 3, 4, 6).
pub fn corner_mask<S: Field>(n: u32) -> Option<Vec<S>> {
    let four_n = i64::from(n) * 4;
    let mut mask = Vec::with_capacity(n as usize);
    mask.push(S::ratio(i64::from(n) + 5, four_n));
    for j in 1..n {
        let three = S::from_integer(3);
        mask.push((three + &S::two_cos(j, n)?) * &S::ratio(1, four_n));
    }
    Some(mask)
}

/// The new corner `corner` of a face with the given points, by its [`corner_mask`].
#[inline]
pub fn corner_point<S: Field, V: Module<S>>(mask: &[S], points: &[V], corner: usize) -> V {
    let n = points.len();
    let mut sum = V::zero();
    for (j, weight) in mask.iter().enumerate() {
        sum = sum + &(points[(corner + j) % n].clone() * weight);
    }
    sum
}

/// The limit position of a face's centre from the sum of its n corners: the centroid.
///
/// Subdivision keeps it, for the corner mask's weights sum to one over each row and each column.
#[inline]
pub fn limit_point<S: Field, V: Module<S>>(sum: &V, n: u32) -> V {
    sum.clone() * &S::ratio(1, i64::from(n))
}
