//! The eigenvectors of the two-ring, in closed form: section 9 of FORMAT.md.

use num_bigint::BigInt;
use num_rational::BigRational;

use crate::claim::{Family, Weights};
use crate::complex::Complex;
use crate::cosine::{double, rational_beta};
use crate::file::File;
use crate::fixed::Fixed;
use crate::reject::Outcome;

/// The cosines of a valence.
pub struct Angles {
    n: usize,
    /// `cos(2πm/(4n))`, m = 0..n.
    cosines: Vec<Fixed>,
}

/// An eigenvector of the two-ring, `A y = lambda y`; or a generalised one.
pub struct Mode {
    pub lambda: Fixed,
    /// kappa and the eigenvector f with `A y = lambda y + kappa f`, for a generalised one.
    pub chain: Option<(Fixed, Box<Mode>)>,
    /// O.
    pub centre: Complex,
    /// The a_j, the b_j, the d_j.
    pub a: Vec<Complex>,
    pub b: Vec<Complex>,
    pub d: Vec<Complex>,
}

fn small(p: i64, q: i64) -> Fixed {
    Fixed::ratio(p, q)
}

impl Angles {
    /// The cosines from the enclosure of cos(π/(4n)) that a file gives.
    ///
    /// # Errors
    ///
    /// If and only if there is none, or it is not proved: rule `cosine`.
    pub fn new(file: &File, n: usize) -> Outcome<Self> {
        let ends = file.cosine.as_ref().map(|(lo, hi)| (&lo.0, &hi.0));
        double(4 * n, ends).map(|first| Self::from_first(n, &first))
    }

    /// From the ends of an enclosure of `c_1 = cos(2π/(4n))`.
    fn from_first(n: usize, first: &[BigRational; 2]) -> Self {
        // 2 c_a c_b = c_(a+b) + c_(a-b): an error grows with m^2 only if m is halved each time.
        let mut list = vec![Wide::one(), Wide::outward(first)];
        for m in 2..=n {
            let (low, high) = (&list[m / 2], &list[m - m / 2]);
            let next = low.twice_times(high).minus(&list[m % 2]);
            list.push(next);
        }
        let mut cosines: Vec<_> = list.iter().map(Wide::fixed).collect();
        cosines[n] = Fixed::ZERO;
        Self { n, cosines }
    }

    /// `cos(2πm/(4n))`.
    pub fn cosine(&self, m: i64) -> Fixed {
        let n = self.n as i64;
        let m = m.rem_euclid(4 * n);
        let m = m.min(4 * n - m);
        if m > n { -self.cosines[(2 * n - m) as usize] } else { self.cosines[m as usize] }
    }

    /// `exp(2πi m/(4n))`.
    pub fn unit(&self, m: i64) -> Complex {
        Complex { re: self.cosine(m), im: self.cosine(m - self.n as i64) }
    }

    /// The ring weight sum of Loop's vertex mask.
    pub fn beta(&self, weights: Weights) -> Fixed {
        let inner = small(3, 8) + self.cosine(4) * small(1, 4);
        let beta = rational_beta(weights, self.n).map(|beta| Fixed::of(&beta));
        beta.unwrap_or_else(|| small(5, 8) - inner.square())
    }

    /// The mode `ring` of a frequency that is not 0.
    pub fn ring(&self, frequency: usize) -> Mode {
        let (n, k) = (self.n as i64, frequency as i64);
        let (c, one) = (self.cosine(4 * k), Fixed::ONE);
        let lambda = small(3, 8) + c * small(1, 4);
        let delta =
            if 2 * k == n { Fixed::ZERO } else { small(3, 1).over(lambda.doubled(3) - one) };
        let twice = c.doubled(1);
        let rho =
            (small(10, 1) + twice + delta * (small(2, 1) + twice)).over(lambda.doubled(4) - one);
        let power = |j: i64| self.unit(4 * k * (j % n));
        Mode {
            lambda,
            chain: None,
            centre: Complex::ZERO,
            a: (0..n).map(power).collect(),
            b: (0..n).map(|j| power(j) * rho).collect(),
            d: (0..n).map(|j| (power(j) + power(j + 1)) * delta).collect(),
        }
    }

    /// The mode of a family and a frequency, if there is one.
    pub fn mode(&self, weights: Weights, family: Family, frequency: Option<usize>) -> Option<Mode> {
        let n = self.n;
        let all = |x: Fixed| vec![Complex::real(x); n];
        let only = |list: &[usize]| {
            let one = |j| if list.contains(&j) { Fixed::ONE } else { Fixed::ZERO };
            (0..n).map(|j| Complex::real(one(j))).collect::<Vec<_>>()
        };
        let plain = |lambda, b, d| {
            let (centre, a) = (Complex::ZERO, all(Fixed::ZERO));
            Mode { lambda, chain: None, centre, a, b, d }
        };
        let sixteenth = small(1, 16);
        match (family, frequency) {
            (Family::Ring, Some(0)) => {
                let beta = self.beta(weights);
                let lambda = small(5, 8) - beta;
                let centre = -(beta.doubled(3) * small(1, 3));
                let d = (small(3, 4) + centre * small(1, 8)).over(lambda - small(1, 8));
                // What b gets from the others, times 16.
                let rest = small(12, 1) + centre + d.doubled(1);
                let (b, chain) = if n == 3 {
                    let ray = plain(sixteenth, all(Fixed::ONE), all(Fixed::ZERO));
                    (Fixed::ZERO, Some((rest * sixteenth, Box::new(ray))))
                } else {
                    (rest.over(lambda.doubled(4) - Fixed::ONE), None)
                };
                let centre = Complex::real(centre);
                Some(Mode { lambda, chain, centre, a: all(Fixed::ONE), b: all(b), d: all(d) })
            }
            (Family::Ring, Some(k)) => (k <= n / 2).then(|| self.ring(k)),
            (Family::Ray, Some(0)) => Some(plain(sixteenth, all(Fixed::ONE), all(Fixed::ZERO))),
            (Family::Ray, None) => Some(plain(sixteenth, only(&[0]), all(Fixed::ZERO))),
            (Family::Between, None) => Some(plain(small(1, 8), only(&[0, 1]), only(&[0]))),
            _ => None,
        }
    }
}

/// An interval with ends that are multiples of 2^-192.
#[derive(Clone, Debug)]
struct Wide([BigInt; 2]);

const PLACES: u32 = 192;

impl Wide {
    fn one() -> Self {
        Self([0, 1].map(|_| BigInt::from(1) << PLACES))
    }

    fn outward([lo, hi]: &[BigRational; 2]) -> Self {
        let unit = || BigInt::from(1) << PLACES;
        Self([(lo * unit()).floor().to_integer(), (hi * unit()).ceil().to_integer()])
    }

    fn twice_times(&self, other: &Self) -> Self {
        let [a, b]: &[BigInt; 2] = &self.0;
        let all = [a, b].map(|x: &BigInt| other.0.each_ref().map(|y| (x * y) << 1u32));
        let all = all.as_flattened();
        let least = all.iter().min().cloned().unwrap_or_default();
        let most = all.iter().max().cloned().unwrap_or_default();
        // The shift of a negative number rounds down.
        Self([least >> PLACES, -(-most >> PLACES)])
    }

    fn minus(&self, other: &Self) -> Self {
        Self([&self.0[0] - &other.0[1], &self.0[1] - &other.0[0]])
    }

    fn fixed(&self) -> Fixed {
        let end = |x: &BigInt| BigRational::new(x.clone(), BigInt::from(1) << PLACES);
        Fixed::between(&end(&self.0[0]), &end(&self.0[1]))
    }
}

#[cfg(test)]
pub mod tests;
