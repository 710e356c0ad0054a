//! The rings that coefficients are from, and what their enclosures decide.
//!
//! Loop: polynomials in beta. Doo-Sabin: sums of the cosines `c_k = cos(2πk/n)`. Rationals are the sums of
//! `c_0 = 1` alone.

use num_bigint::{BigInt, Sign};
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::form::Form;
use crate::scalar::Scalar;

/// The ends of an enclosure are multiples of `2^-BITS`.
pub const BITS: usize = 192;

/// An enclosure, both ends times `2^BITS`.
#[derive(Clone, Debug)]
pub struct Interval {
    low: BigInt,
    high: BigInt,
}

impl Interval {
    /// Of the numbers from low to high, rounded outward.
    pub fn outward(low: &BigRational, high: &BigRational) -> Self {
        let (low, high) = (low * unit(), high * unit());
        Self { low: low.floor().to_integer(), high: high.ceil().to_integer() }
    }

    /// Both ends.
    pub fn ends(&self) -> [BigRational; 2] {
        [&self.low, &self.high].map(|end| BigRational::new(end.clone(), unit()))
    }
}

fn unit() -> BigInt {
    BigInt::one() << BITS
}

/// A commutative ring of scalars, each generator enclosed.
#[derive(Clone, Debug)]
pub enum Ring {
    /// `g_k = beta^k`, beta > 0.
    Powers(Interval),
    /// `g_k = c_k`, k = 0..n/2: this n, and the enclosures.
    Cosines(usize, Vec<Interval>),
}

impl Ring {
    /// No generator but 1.
    pub const RATIONALS: Self = Self::Cosines(1, Vec::new());

    /// The ring of the `cos(2πk/n)`, the first enclosed: `c_(k+1) = 2 c_1 c_k - c_(k-1)`.
    pub fn cosines(n: usize, first: Interval) -> Self {
        let mut list = vec![Interval { low: unit(), high: unit() }, first.clone()];
        for k in 1..n / 2 {
            let (now, before) = (&list[k], &list[k - 1]);
            let products = [
                &first.low * &now.low,
                &first.low * &now.high,
                &first.high * &now.low,
                &first.high * &now.high,
            ];
            let twice: [BigInt; 4] = products.map(|product| product * 2);
            let low = twice.iter().min().map(|x| x.div_floor(&unit()) - &before.high);
            let high = twice.iter().max().map(|x| x.div_ceil(&unit()) - &before.low);
            list.extend(low.zip(high).map(|(low, high)| Interval { low, high }));
        }
        Self::Cosines(n, list)
    }

    /// How many coefficients the product of scalars with a and b of them has, a, b >= 1.
    pub fn width(&self, a: usize, b: usize) -> usize {
        match self {
            Self::Powers(_) => a + b - 1,
            Self::Cosines(..) if a == 1 || b == 1 => a.max(b),
            Self::Cosines(n, _) => n / 2 + 1,
        }
    }

    /// `c_j c_k` is the mean of `c_(j+k)` and `c_(j-k)`, indices modulo n, and `c_(n-m) = c_m`: the two indices.
    pub fn fold(n: usize, j: usize, k: usize) -> [usize; 2] {
        [j + k, j.abs_diff(k)].map(|m| (m % n).min(n - m % n))
    }

    /// The product of two scalars.
    pub fn product(&self, a: &Scalar, b: &Scalar) -> Scalar {
        if b.is_zero() {
            return b.clone();
        }
        let b = Form { width: b.num.len(), num: b.num.clone(), den: b.den.clone() };
        let Form { num, den, .. } = Form::sum(self, 1, &[(a, &b)]);
        Scalar::new(num, den)
    }

    /// The lower and the upper end of the enclosure of `Σ num_k g_k`, times `2^shift`; and shift.
    fn ends(&self, x: &Scalar) -> (BigInt, BigInt, usize) {
        let degree = x.num.len().saturating_sub(1);
        match self {
            _ if degree == 0 => {
                let constant = x.num.first().cloned().unwrap_or_default();
                (constant.clone(), constant, 0)
            }
            Self::Powers(beta) => {
                // Horner's rule: [low, high] beta + c, everything scaled by 2^(BITS (k + 1)).
                let (mut low, mut high) = (x.num[degree].clone(), x.num[degree].clone());
                for (k, c) in x.num[..degree].iter().rev().enumerate() {
                    let c = c << (BITS * (k + 1));
                    low = &low * if low.is_negative() { &beta.high } else { &beta.low } + &c;
                    high = &high * if high.is_negative() { &beta.low } else { &beta.high } + &c;
                }
                (low, high, BITS * degree)
            }
            Self::Cosines(_, list) => {
                let (mut low, mut high) = (BigInt::zero(), BigInt::zero());
                for (c, g) in x.num.iter().zip(list) {
                    let (a, b) =
                        if c.is_negative() { (&g.high, &g.low) } else { (&g.low, &g.high) };
                    low += c * a;
                    high += c * b;
                }
                (low, high, BITS)
            }
        }
    }

    /// The sign on the whole enclosure (a zero at an end allowed), if it is certain.
    pub fn sign(&self, x: &Scalar) -> Option<Sign> {
        let (low, high, _) = self.ends(x);
        match (low.sign(), high.sign()) {
            (Sign::NoSign, Sign::NoSign) => Some(Sign::NoSign),
            (Sign::Plus | Sign::NoSign, _) => Some(Sign::Plus),
            (_, Sign::Minus | Sign::NoSign) => Some(Sign::Minus),
            _ => None,
        }
    }

    /// True if the value is certainly at most 0.
    pub fn is_at_most_zero(&self, x: &Scalar) -> bool {
        matches!(self.sign(x), Some(Sign::NoSign | Sign::Minus))
    }

    /// The least and the largest magnitude in the enclosure.
    pub fn magnitudes(&self, x: &Scalar) -> [BigRational; 2] {
        let (low, high, shift) = self.ends(x);
        let most = low.abs().max(high.abs());
        let least = low.max(-high).max(BigInt::zero());
        [least, most].map(|end| BigRational::new(end, &x.den << shift))
    }

    /// The middle of the enclosure: for decimals only.
    pub fn near(&self, x: &Scalar) -> BigRational {
        let (low, high, shift) = self.ends(x);
        BigRational::new(low + high, &x.den << (shift + 1))
    }

    /// The elementary operations of finding the sign of a scalar, roughly.
    pub fn cost(x: &Scalar) -> u64 {
        let limbs = x.num.iter().map(BigInt::bits).fold(x.den.bits(), u64::max) / 64;
        x.num.len() as u64 * (limbs + 1 + (BITS / 64 * x.num.len()) as u64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn scalar(list: &[i64]) -> Scalar {
        Scalar::new(list.iter().map(|&c| c.into()).collect(), BigInt::one())
    }

    #[test]
    fn enclosures_of_polynomials_decide_or_abstain() {
        let ring = Ring::Powers(Interval::outward(&ratio(1, 3), &ratio(1, 2)));
        let most = |list: &[i64]| ring.magnitudes(&scalar(list))[1].clone();
        assert_eq!(ring.sign(&scalar(&[-1, 3])), None); // 1/3 is rounded outward
        assert_eq!(ring.sign(&scalar(&[-1, 2])), Some(Sign::Minus)); // 1/2 is not
        assert_eq!(ring.sign(&scalar(&[-1, 4])), Some(Sign::Plus));
        assert_eq!(ring.sign(&scalar(&[-2, 5])), None);
        assert_eq!(ring.sign(&scalar(&[0, 0])), Some(Sign::NoSign));
        // -1 + beta (2 + beta): Horner's upper end 1/4, lower end about -2/9.
        assert_eq!(ring.sign(&scalar(&[-1, 2, 1])), None);
        assert_eq!(ring.magnitudes(&scalar(&[-1, 2, 1])), [ratio(0, 1), ratio(1, 4)]);
        // A negative inner value meets the other end: beta (beta - 1) >= 1/2 (1/3 - 1) = -1/3 for Horner.
        assert!(most(&[0, -1, 1]) > ratio(1, 3));
        assert!(most(&[0, -1, 1]) < ratio(1, 3) + ratio(1, i64::MAX));
        // Above 0 and below it: the magnitudes from 1/3 to 1.
        for list in [[-1, 4], [1, -4]] {
            let [least, most] = ring.magnitudes(&scalar(&list));
            assert!(least <= ratio(1, 3) && least > ratio(1, 4) && most == ratio(1, 1));
        }
        assert_eq!(
            ring.product(&scalar(&[1, 2]), &scalar(&[-1, 0, 3])).num,
            scalar(&[-1, -2, 3, 6]).num
        );
    }

    #[test]
    fn cosine_sums() {
        // n = 5: c_1 = (sqrt(5) - 1)/4 = 0.3090.., c_2 = -(sqrt(5) + 1)/4 = -0.8090..
        let (low, high) = (ratio(309_016, 1_000_000), ratio(309_017, 1_000_000));
        let ring = Ring::cosines(5, Interval::outward(&low, &high));
        let (c_1, c_2) = (Scalar::generator(1), Scalar::generator(2));
        let is = |a: &Scalar, b: &Scalar| (a - b).is_zero();
        let (one, half) = (Scalar::integer(1), ratio(1, 2));
        assert!(is(&ring.product(&c_1, &c_1), &(&one + &c_2).scale(&half)));
        assert!(is(&ring.product(&c_1, &c_2), &(&c_1 + &c_2).scale(&half))); // c_3 = c_2
        assert!(is(&ring.product(&c_2, &c_2), &(&one + &c_1).scale(&half))); // c_4 = c_1
        assert!(is(&ring.product(&c_2, &Scalar::integer(7)), &c_2.scale(&ratio(7, 1))));
        // 1 + 2 c_1 + 2 c_2 is 0, but not identically: no sign is certain.
        assert_eq!(ring.sign(&scalar(&[1, 2, 2])), None);
        assert_eq!(ring.sign(&scalar(&[1, 2, 1])), Some(Sign::Plus));
        assert!((ring.near(&c_2) + ratio(809_017, 1_000_000)).abs() < ratio(1, 100_000));
        // An even n has its c_(n/2), and associativity holds across the folds.
        let ring = Ring::cosines(8, Interval::outward(&ratio(7071, 10_000), &ratio(7072, 10_000)));
        let [a, b, c] = [[1, 2, 3, 4, 5], [2, -1, 0, 3, 1], [0, 1, 0, 0, 7]].map(|x| scalar(&x));
        assert!(is(
            &ring.product(&ring.product(&a, &b), &c),
            &ring.product(&a, &ring.product(&b, &c))
        ));
        assert!(is(
            &ring.product(&Scalar::generator(4), &Scalar::generator(3)),
            &Scalar::generator(1)
        ));
        // Rationals: no generator but 1.
        let product = Ring::RATIONALS.product(&scalar(&[3]), &scalar(&[-5]));
        assert_eq!(Ring::RATIONALS.near(&product), ratio(-15, 1));
    }
}
