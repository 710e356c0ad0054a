//! Linear forms in the points of the net, with polynomials in beta as coefficients.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero};

use crate::polynomial::Polynomial;

/// `Σ_i y_i Σ_k num[i width + k] beta^k / den`, i from 0.
#[derive(Clone, Debug)]
pub struct Form {
    /// How many coefficients each polynomial has.
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
        Self {
            width: 1,
            num,
            den: BigInt::one(),
        }
    }

    /// `Σ p f` over the terms (p, f), all of `size` points.
    pub fn sum(size: usize, terms: &[(&Polynomial, &Form)]) -> Self {
        let terms = || terms.iter().filter(|(p, _)| !p.is_zero());
        let width = terms()
            .map(|(p, f)| p.num.len() - 1 + f.width)
            .max()
            .unwrap_or(1);
        let den = terms().fold(BigInt::one(), |den, (p, f)| den.lcm(&(&p.den * &f.den)));
        let mut num = vec![BigInt::zero(); size * width];
        for (p, f) in terms() {
            let scale = &den / (&p.den * &f.den);
            for (j, c) in p.num.iter().enumerate().filter(|(_, c)| !c.is_zero()) {
                let factor = c * &scale;
                for (sums, numbers) in num.chunks_exact_mut(width).zip(f.num.chunks_exact(f.width))
                {
                    for (sum, x) in sums
                        .iter_mut()
                        .skip(j)
                        .zip(numbers)
                        .filter(|(_, x)| !x.is_zero())
                    {
                        *sum += &factor * x;
                    }
                }
            }
        }
        Self { width, num, den }
    }

    /// The value at a net: a polynomial in beta.
    pub fn at(&self, net: &[BigRational]) -> Polynomial {
        self.num
            .chunks_exact(self.width)
            .zip(net)
            .fold(Polynomial::integer(0), |sum, (c, y)| {
                &sum + &Polynomial::new(c.to_vec(), self.den.clone()).scale(y)
            })
    }

    /// Elementary operations that a sum with this form costs, roughly.
    pub fn cost(&self) -> u64 {
        self.num.len() as u64 * (1 + self.den.bits() / 64)
    }
}
