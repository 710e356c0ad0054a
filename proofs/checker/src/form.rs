//! Linear forms in the points of the first net, with scalars as coefficients.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::ring::Ring;
use crate::scalar::{Scalar, add_product};

/// `Σ_i y_i Σ_k num[i width + k] g_k / den`, i from 0.
#[derive(Clone, Debug)]
pub struct Form {
    /// How many coefficients each scalar has.
    pub width: usize,
    /// The numerators, point by point.
    pub num: Vec<BigInt>,
    /// The common denominator, > 0.
    pub den: BigInt,
}

impl Form {
    /// The value of point i (from 0) of `size` points.
    pub fn point(i: usize, size: usize) -> Self {
        let num = (0..size).map(|j| BigInt::from(u8::from(i == j))).collect();
        Self { width: 1, num, den: BigInt::one() }
    }

    /// The number of points.
    pub fn size(&self) -> usize {
        self.num.len() / self.width
    }

    /// `Σ p f` over the terms (p, f), all of `size` points.
    pub fn sum(ring: &Ring, size: usize, terms: &[(&Scalar, &Form)]) -> Self {
        let terms = || terms.iter().filter(|(p, _)| !p.is_zero());
        let width = terms().map(|(p, f)| ring.width(p.num.len(), f.width)).max().unwrap_or(1);
        let mut den = terms().fold(BigInt::one(), |den, (p, f)| den.lcm(&(&p.den * &f.den)));
        if matches!(ring, Ring::Cosines(..)) && terms().any(|(p, _)| p.num.len() > 1) {
            den *= 2; // for the halves in a product
        }
        let mut num = vec![BigInt::zero(); size * width];
        for (p, f) in terms() {
            let scale = &den / (&p.den * &f.den);
            for (j, c) in p.num.iter().enumerate().filter(|(_, c)| !c.is_zero()) {
                let factor = c * &scale;
                for (sums, numbers) in num.chunks_mut(width).zip(f.num.chunks(f.width)) {
                    match ring {
                        Ring::Cosines(n, _) if j > 0 => {
                            let half = &factor / 2;
                            for (k, x) in numbers.iter().enumerate() {
                                for at in Ring::fold(*n, j, k) {
                                    add_product(&mut sums[at], &half, x);
                                }
                            }
                        }
                        _ => {
                            let both = sums[j..].iter_mut().zip(numbers);
                            both.for_each(|(sum, x)| add_product(sum, &factor, x));
                        }
                    }
                }
            }
        }
        Self { width, num, den }
    }

    /// `Σ c f` over the terms (c, f), all of `size` points.
    pub fn mix(size: usize, terms: &[(BigRational, &Form)]) -> Self {
        let constants: Vec<_> = terms.iter().map(|(c, _)| Scalar::constant(c)).collect();
        let terms: Vec<_> = constants.iter().zip(terms.iter().map(|(_, f)| *f)).collect();
        Self::sum(&Ring::RATIONALS, size, &terms)
    }

    /// The value at the net `net / den`.
    pub fn at(&self, net: &[BigInt], den: &BigInt) -> Scalar {
        let mut num = vec![BigInt::zero(); self.width];
        for (c, y) in self.num.chunks(self.width).zip(net) {
            num.iter_mut().zip(c).for_each(|(sum, c)| *sum += c * y);
        }
        Scalar::new(num, den * &self.den)
    }

    /// The words of the longest number.
    pub fn limbs(&self) -> u64 {
        1 + self.num.iter().map(BigInt::bits).fold(self.den.bits(), u64::max) / 64
    }

    /// The elementary operations of one pass over the form, roughly.
    pub fn cost(&self) -> u64 {
        self.num.len() as u64 * self.limbs()
    }
}
