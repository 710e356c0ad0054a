//! The real cyclotomic fields themselves: basis, reduction, enclosures of the basis.

use std::collections::{BTreeMap, HashMap};
use std::fmt;
use std::sync::{Arc, LazyLock, Mutex, PoisonError, RwLock};

use num_bigint::BigInt;
use num_integer::Integer;
use num_traits::{One, ToPrimitive, Zero};

use crate::scalar::cosine::{FixedPoint, visit_multiples};

/// Q(2 cos 2π/n), of degree d = φ(n)/2 >= 2 and n odd or divisible by 4.
///
/// Basis: 1, C_1, .., C_(d-1) with C_k = 2 cos(2π k/n). Products are `C_i C_j = C_(i+j) +
/// C_|i-j|`, indices fold by `C_k = C_(n-k)`, conjugation is `C_k -> C_(gk)`: integer coefficients
/// stay as small as they can, where powers of C_1 need binomials.
pub(super) struct RealField {
    pub n: u32,
    pub degree: usize,
    /// `rows[k - degree]` is C_k in the basis, for degree <= k <= n/2; sparse.
    rows: Vec<Vec<(usize, i64)>>,
    enclosures: RwLock<HashMap<u32, Arc<BasisEnclosure>>>,
}

/// Fixed-point values of C_0, .., C_(d-1).
pub(super) struct BasisEnclosure {
    pub values: Vec<BigInt>,
    pub scale: FixedPoint,
}

impl fmt::Debug for RealField {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Q(2 cos 2π/{})", self.n)
    }
}

impl RealField {
    /// The one field for n, made on first use and kept for ever. `n` as for the type.
    pub fn get(n: u32) -> &'static RealField {
        static FIELDS: LazyLock<Mutex<BTreeMap<u32, &'static RealField>>> =
            LazyLock::new(Mutex::default);
        let mut fields = FIELDS.lock().unwrap_or_else(PoisonError::into_inner);
        fields
            .entry(n)
            .or_insert_with(|| Box::leak(Box::new(RealField::new(n))))
    }

    fn new(n: u32) -> Self {
        let relation = symmetric_cyclotomic(n);
        let degree = relation.len() - 1;
        // C_d = -(a_0 + a_1 C_1 + .. + a_(d-1) C_(d-1)).
        let mut dense = vec![unit(degree, degree - 1)];
        dense.push(
            relation[..degree]
                .iter()
                .map(|a| -small(a))
                .collect::<Vec<i64>>(),
        );
        for k in degree + 1..=n as usize / 2 {
            // C_k = C_1 C_(k-1) - C_(k-2).
            let next = shifted(&dense[k - degree], &dense[1])
                .iter()
                .zip(&dense[k - degree - 1])
                .map(|(a, b)| a.checked_sub(*b).expect(TOO_HIGH))
                .collect();
            dense.push(next);
        }
        let sparse = |row: &Vec<i64>| {
            let entries = row.iter().copied().enumerate();
            entries.filter(|(_, a)| *a != 0).collect()
        };
        RealField {
            n,
            degree,
            rows: dense[1..].iter().map(sparse).collect(),
            enclosures: RwLock::default(),
        }
    }

    /// The k with 0 <= k <= n/2 and `C_k = C_index`.
    pub fn fold(&self, index: u64) -> usize {
        let n = u64::from(self.n);
        let k = index % n;
        k.min(n - k) as usize
    }

    /// Basis coefficients of `constant + Σ sums[k] C_k`, sums of length n/2 + 1.
    pub fn reduce(&self, constant: BigInt, mut sums: Vec<BigInt>) -> Vec<BigInt> {
        let high = sums.split_off(self.degree.min(sums.len()));
        let zeroth = std::mem::take(&mut sums[0]);
        sums[0] = constant + zeroth * 2;
        for (row, sum) in self.rows.iter().zip(high) {
            if !sum.is_zero() {
                for (k, a) in row {
                    match a {
                        1 => sums[*k] += &sum,
                        -1 => sums[*k] -= &sum,
                        _ => sums[*k] += &sum * a,
                    }
                }
            }
        }
        sums
    }

    /// Room for [`RealField::reduce`].
    pub fn empty_sums(&self) -> Vec<BigInt> {
        vec![BigInt::ZERO; self.n as usize / 2 + 1]
    }

    /// The basis to within `2^-(bits+1)` each. Kept for every number of bits asked for.
    pub fn enclose_basis(&self, bits: u32) -> Arc<BasisEnclosure> {
        let known = self
            .enclosures
            .read()
            .unwrap_or_else(PoisonError::into_inner)
            .get(&bits)
            .cloned();
        known.unwrap_or_else(|| {
            let mut values = Vec::with_capacity(self.degree);
            let scale = visit_multiples(self.n, self.degree as u32 - 1, bits, |value| {
                values.push(value)
            });
            let made = Arc::new(BasisEnclosure { values, scale });
            let mut enclosures = self
                .enclosures
                .write()
                .unwrap_or_else(PoisonError::into_inner);
            enclosures.insert(bits, Arc::clone(&made));
            made
        })
    }
}

const TOO_HIGH: &str = "a cyclotomic polynomial with coefficients beyond 2^63";

fn small(a: &BigInt) -> i64 {
    a.to_i64().expect(TOO_HIGH)
}

/// The basis vector `index` of length `degree`.
fn unit(degree: usize, index: usize) -> Vec<i64> {
    let mut row = vec![0; degree];
    row[index] = 1;
    row
}

/// C_1 times a row, C_d being `top`: C_1 1 = C_1, C_1 C_1 = C_2 + 2, C_1 C_i = C_(i+1) + C_(i-1).
fn shifted(row: &[i64], top: &[i64]) -> Vec<i64> {
    let degree = row.len();
    let mut result = vec![0i64; degree];
    let mut add = |k: usize, a: i64| result[k] = result[k].checked_add(a).expect(TOO_HIGH);
    for (i, &a) in row.iter().enumerate().filter(|(_, a)| **a != 0) {
        let twice = a.checked_mul(2).expect(TOO_HIGH);
        if i >= 1 {
            add(i - 1, if i == 1 { twice } else { a });
        }
        if i + 1 < degree {
            add(i + 1, a);
        } else {
            for (k, t) in top.iter().enumerate() {
                add(k, a.checked_mul(*t).expect(TOO_HIGH));
            }
        }
    }
    result
}

/// The a_k of `Φ_n(z) z^-d = a_0 + Σ_(k=1..d) a_k (z^k + z^-k)`, d = φ(n)/2, n >= 3: with z =
/// e^(2πi/n) this is the relation `a_0 + Σ a_k C_k = 0`, a_d = 1.
///
/// Φ_n is the product of (1 - x^m)^μ(n/m) over m | n; by symmetry half of it will do, so it is
/// computed as a power series to degree d.
fn symmetric_cyclotomic(n: u32) -> Vec<BigInt> {
    let degree = field_degree(n);
    let mut series = vec![BigInt::ZERO; degree + 1];
    series[0] = BigInt::one();
    let divisors: Vec<usize> = (1..=n)
        .filter(|m| n.is_multiple_of(*m))
        .map(|m| m as usize)
        .collect();
    for &m in divisors.iter().filter(|m| moebius(n as usize / **m) == 1) {
        for i in (m..=degree).rev() {
            let lower = series[i - m].clone();
            series[i] -= lower;
        }
    }
    for &m in divisors.iter().filter(|m| moebius(n as usize / **m) == -1) {
        for i in m..=degree {
            let lower = series[i - m].clone();
            series[i] += lower;
        }
    }
    series.reverse();
    series
}

/// The prime factors of n with their multiplicities.
fn factorize(mut n: usize) -> Vec<(usize, u32)> {
    let mut factors = Vec::new();
    let mut p = 2;
    while n > 1 {
        if p * p > n {
            p = n;
        }
        let mut multiplicity = 0;
        while n.is_multiple_of(p) {
            n /= p;
            multiplicity += 1;
        }
        if multiplicity > 0 {
            factors.push((p, multiplicity));
        }
        p += 1;
    }
    factors
}

fn moebius(n: usize) -> i32 {
    let factors = factorize(n);
    if factors.iter().any(|(_, multiplicity)| *multiplicity > 1) {
        0
    } else if factors.len() % 2 == 0 {
        1
    } else {
        -1
    }
}

/// The degree of Q(2 cos 2π/n) over Q: φ(n)/2 for n >= 3, else 1.
pub fn field_degree(n: u32) -> usize {
    let totient: usize = factorize(n as usize)
        .iter()
        .map(|(p, k)| (p - 1) * p.pow(k - 1))
        .product();
    (totient / 2).max(1)
}

/// The minimal polynomial of 2 cos(2π/n) over Q, n >= 1: monic, integer coefficients, constant
/// term first, of degree [`field_degree`]`(n)`.
///
/// Source: D. H. Lehmer 1933 (irreducibility); computed from the symmetric half of the cyclotomic
/// polynomial, `ψ_n(x) = a_0 + Σ a_k D_k(x)`, D_k Dickson's polynomials.
///
/// ```
/// use subcert::scalar::cyclotomic::minimal_polynomial;
/// // x^3 + x^2 - 2x - 1
/// assert_eq!(minimal_polynomial(7), [-1, -2, 1, 1].map(Into::into));
/// ```
///
/// # Panics
/// If n = 0.
pub fn minimal_polynomial(n: u32) -> Vec<BigInt> {
    assert!(n > 0, "2 cos(2 pi/0)");
    match n {
        1 => vec![BigInt::from(-2), BigInt::one()],
        2 => vec![BigInt::from(2), BigInt::one()],
        _ => dickson_to_powers(&symmetric_cyclotomic(n)),
    }
}

/// The coefficients of `a_0 + Σ_(k>=1) a_k D_k(x)` in powers of x.
pub(super) fn dickson_to_powers(a: &[BigInt]) -> Vec<BigInt> {
    let mut result = vec![BigInt::ZERO; a.len()];
    result[0] += &a[0];
    let mut previous = vec![BigInt::from(2)];
    let mut current = vec![BigInt::ZERO, BigInt::one()];
    for weight in &a[1..] {
        for (sum, coefficient) in result.iter_mut().zip(&current) {
            *sum += weight * coefficient;
        }
        // D_(k+1) = x D_k - D_(k-1).
        let mut next = vec![BigInt::ZERO];
        next.extend(current.iter().cloned());
        for (coefficient, lower) in next.iter_mut().zip(&previous) {
            *coefficient -= lower;
        }
        previous = std::mem::replace(&mut current, next);
    }
    result
}

/// The least n' with the same field: Q(2 cos 2π/2m) = Q(2 cos 2π/m) for odd m.
pub(super) fn conductor(n: u32) -> u32 {
    if n % 4 == 2 { n / 2 } else { n }
}

/// lcm(m, n) if it fits.
pub(super) fn common_conductor(m: u32, n: u32) -> Option<u32> {
    u32::try_from(u64::from(m).lcm(&u64::from(n))).ok()
}
