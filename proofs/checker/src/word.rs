//! Words: their mirror images, the triangles that they name, and the nodes of a quartic.

use num_rational::BigRational;
use num_traits::{One, Signed, Zero, pow};

use crate::rational::ratio;

/// A point (v, w) of the parameter triangle.
pub type Point = [BigRational; 2];

/// The mirrored word.
pub fn mirrored(word: &[u8]) -> Vec<u8> {
    word.iter().map(|&letter| if letter % 2 == 1 { 4 - letter } else { letter }).collect()
}

/// True for a word with a letter other than 0.
pub fn is_regular(word: &[u8]) -> bool {
    word.iter().any(|&letter| letter != 0)
}

/// True for `0^r m`, r >= 0, m = 1, 2, 3.
pub fn is_tile(word: &[u8]) -> bool {
    word.split_last().is_some_and(|(&last, zeros)| last != 0 && !is_regular(zeros))
}

/// The part of a triangle that a word names.
pub struct Triangle(pub [Point; 3]);

impl Triangle {
    /// The part that a word names, in the parameters of the empty word.
    pub fn of(word: &[u8]) -> Self {
        let (zero, one) = (BigRational::zero, BigRational::one);
        let whole = [[zero(), zero()], [one(), zero()], [zero(), one()]];
        Self(word.iter().fold(whole, |[a, b, c], &letter| {
            let (ab, ac, bc) = (middle(&a, &b), middle(&a, &c), middle(&b, &c));
            match letter {
                0 => [a, ab, ac],
                1 => [ab, b, bc],
                2 => [bc, ac, ab],
                _ => [ac, bc, c],
            }
        }))
    }

    /// The point with the parameters (v, w) of this part.
    pub fn point(&self, v: &BigRational, w: &BigRational) -> Point {
        let [a, b, c] = &self.0;
        let [u, v, w] = barycentric(v, w);
        [0, 1].map(|i| &u * &a[i] + &v * &b[i] + &w * &c[i])
    }
}

/// The barycentric coordinates of (v, w).
pub fn barycentric(v: &BigRational, w: &BigRational) -> [BigRational; 3] {
    [BigRational::one() - v - w, v.clone(), w.clone()]
}

fn middle(a: &Point, b: &Point) -> Point {
    [0, 1].map(|i| (&a[i] + &b[i]) * ratio(1, 2))
}

/// The exponents (i, j, k) of the Bernstein polynomials of a degree, by index.
pub fn exponents(degree: usize) -> Vec<[usize; 3]> {
    let rows = (0..=degree).flat_map(|row| (0..=row).map(move |k| (row, k)));
    rows.map(|(row, k)| [degree - row, row - k, k]).collect()
}

/// True if (v, w) is in the parameter triangle.
pub fn is_in_triangle(v: &BigRational, w: &BigRational) -> bool {
    !v.is_negative() && !w.is_negative() && v + w <= BigRational::one()
}

/// The index of (i, j, k).
pub fn index(j: usize, k: usize) -> usize {
    (j + k) * (j + k + 1) / 2 + k
}

/// The values of the Bernstein polynomials of a degree at (v, w), by index.
pub fn bernstein(degree: usize, v: &BigRational, w: &BigRational) -> Vec<BigRational> {
    let u = BigRational::one() - v - w;
    let factorial = |m: usize| (1..=m as i64).product::<i64>();
    let term = |[i, j, k]: [usize; 3]| {
        let count = ratio(factorial(degree) / (factorial(i) * factorial(j) * factorial(k)), 1);
        count * pow(u.clone(), i) * pow(v.clone(), j) * pow(w.clone(), k)
    };
    exponents(degree).into_iter().map(term).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_follow_the_rows() {
        assert_eq!(exponents(4)[0], [4, 0, 0]);
        assert_eq!(exponents(4)[10], [0, 4, 0]);
        assert_eq!(exponents(4)[14], [0, 0, 4]);
        assert!(exponents(4).iter().enumerate().all(|(at, &[_, j, k])| index(j, k) == at));
        assert_eq!(
            bernstein(4, &ratio(1, 5), &ratio(2, 7)).iter().sum::<BigRational>(),
            ratio(1, 1)
        );
    }

    #[test]
    fn parts_tile_the_triangle_and_are_mirrored() {
        for word in [&[1, 3, 2, 0][..], &[2, 2, 1], &[0, 3, 3, 2, 1]] {
            let (part, image) = (Triangle::of(word), Triangle::of(&mirrored(word)));
            let [v, w] = part.point(&ratio(1, 3), &ratio(1, 7));
            assert_eq!(image.point(&ratio(1, 7), &ratio(1, 3)), [w, v]);
        }
        assert_eq!(
            Triangle::of(&[0, 1]).0,
            [[ratio(1, 4), ratio(0, 1)], [ratio(1, 2), ratio(0, 1)], [ratio(1, 4), ratio(1, 4)]]
        );
    }
}
