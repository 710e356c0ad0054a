//! Intervals with ends that are multiples of 2^-64, rounded outward: section 9 of FORMAT.md.
//!
//! An end that would be beyond ±2^62 makes the interval unbounded, which proves nothing.

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::ToPrimitive;

/// The number of binary places.
const PLACES: u32 = 64;
/// The largest end, in units.
const LIMIT: i128 = 1 << 126;
const LOW: i128 = (1 << PLACES) - 1;

/// A closed interval, `lo <= hi`, in units of 2^-64.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fixed {
    lo: i128,
    hi: i128,
}

/// `floor(a b / 2^64)`, and whether anything was cut off; `None` beyond the limit.
fn product(a: i128, b: i128) -> Option<(i128, bool)> {
    // a = 2^64 a1 + a0, b = 2^64 b1 + b0, |a1|, |b1| <= 2^62:
    // a b / 2^64 = 2^64 a1 b1 + a1 b0 + a0 b1 + a0 b0 / 2^64.
    let [(a1, a0), (b1, b0)] = [a, b].map(|x| (x >> PLACES, x & LOW));
    let (whole, least) = (a1 * b1, a0 as u128 * b0 as u128);
    if whole.unsigned_abs() > LIMIT.unsigned_abs() >> PLACES {
        return None;
    }
    let sum = (whole << PLACES).checked_add(a1 * b0)?.checked_add(a0 * b1)?;
    Some((sum.checked_add((least >> PLACES) as i128)?, least as u64 != 0))
}

/// The same of factors below 2^94 in magnitude, where nothing can overflow.
#[inline]
fn product_of_small(a: i128, b: i128) -> (i128, bool) {
    let [(a1, a0), (b1, b0)] = [a, b].map(|x| ((x >> PLACES) as i64, x as u64));
    let least = u128::from(a0) * u128::from(b0);
    let cross = i128::from(a1) * i128::from(b0) + i128::from(b1) * i128::from(a0);
    let whole = (i128::from(a1) * i128::from(b1)) << PLACES;
    (whole + cross + (least >> PLACES) as i128, least as u64 != 0)
}

/// The same, rounded up.
fn product_above(a: i128, b: i128) -> Option<i128> {
    product(a, b).map(|(floor, cut)| floor + i128::from(cut))
}

/// The same, rounded down.
fn product_below(a: i128, b: i128) -> Option<i128> {
    product(a, b).map(|(floor, _)| floor)
}

impl Fixed {
    /// All numbers.
    pub const WHOLE: Self = Self { lo: i128::MIN, hi: i128::MAX };
    pub const ZERO: Self = Self { lo: 0, hi: 0 };
    pub const ONE: Self = Self { lo: 1 << PLACES, hi: 1 << PLACES };

    #[inline]
    fn new(lo: Option<i128>, hi: Option<i128>) -> Self {
        match (lo, hi) {
            (Some(lo), Some(hi)) if lo >= -LIMIT && hi <= LIMIT => Self { lo, hi },
            _ => Self::WHOLE,
        }
    }

    /// The product of small intervals that do not have 0 inside: the usual case, in a shorter way.
    #[inline]
    fn times_small(self, other: Self) -> Option<Self> {
        let small = |x: Self| (x.lo ^ (x.lo >> 127)) | (x.hi ^ (x.hi >> 127)) < 1 << 94;
        let one_sign = |x: Self| (x.lo < 0) == (x.hi < 0);
        if !(small(self) && small(other) && one_sign(self) && one_sign(other)) {
            return None;
        }
        // Of either sign: the ends of least and of largest magnitude.
        let order = |x: Self| if x.lo < 0 { (x.hi, x.lo) } else { (x.lo, x.hi) };
        let ((a, b), (c, d)) = (order(self), order(other));
        let (least, most) = if (a < 0) == (c < 0) { ((a, c), (b, d)) } else { ((b, d), (a, c)) };
        let (lo, _) = product_of_small(least.0, least.1);
        let (hi, cut) = product_of_small(most.0, most.1);
        Some(Self { lo, hi: hi + i128::from(cut) })
    }

    /// False if nothing is known.
    pub fn is_bounded(self) -> bool {
        self.lo != i128::MIN
    }

    /// The numbers from the first to the second.
    pub fn between(lo: &BigRational, hi: &BigRational) -> Self {
        let (lo, hi) = (Self::of(lo), Self::of(hi));
        if lo.is_bounded() && hi.is_bounded() { Self { lo: lo.lo, hi: hi.hi } } else { Self::WHOLE }
    }

    /// The enclosure of a rational.
    pub fn of(x: &BigRational) -> Self {
        let (floor, rest) = (x.numer() << PLACES).div_mod_floor(x.denom());
        let floor = floor.to_i128();
        let cut = i128::from(rest != BigInt::ZERO);
        Self::new(floor, floor.and_then(|floor| floor.checked_add(cut)))
    }

    /// The enclosure of `p / q`, `q > 0`.
    pub fn ratio(p: i64, q: i64) -> Self {
        Self::of(&crate::rational::ratio(p, q))
    }

    /// The middle, as a number by itself: for choices that need no proof.
    pub fn middle(self) -> Self {
        if !self.is_bounded() {
            return self;
        }
        let middle = (self.lo >> 1) + (self.hi >> 1);
        Self { lo: middle, hi: middle }
    }

    /// The square.
    pub fn square(self) -> Self {
        let [small, large] = self.magnitude();
        match (product(small, small), product(large, large)) {
            (Some((lo, _)), Some((hi, cut))) => Self::new(Some(lo), Some(hi + i128::from(cut))),
            _ => Self::WHOLE,
        }
    }

    /// The least and the largest magnitude.
    fn magnitude(self) -> [i128; 2] {
        if !self.is_bounded() {
            return [0, i128::MAX];
        }
        let large = self.lo.abs().max(self.hi.abs());
        if self.lo <= 0 && self.hi >= 0 {
            [0, large]
        } else {
            [self.lo.abs().min(self.hi.abs()), large]
        }
    }

    /// The quotient; nothing is known if the divisor may be 0.
    pub fn over(self, divisor: Self) -> Self {
        if !self.is_bounded() || !divisor.is_bounded() || (divisor.lo <= 0 && divisor.hi >= 0) {
            return Self::WHOLE;
        }
        let all = [self.lo, self.hi].map(|a| {
            [divisor.lo, divisor.hi].map(|b| {
                let (floor, rest) = (BigInt::from(a) << PLACES).div_mod_floor(&BigInt::from(b));
                (floor.to_i128(), i128::from(rest != BigInt::ZERO))
            })
        });
        let all = all.as_flattened();
        let lo = all.iter().map(|(floor, _)| *floor).min().flatten();
        let up =
            |(floor, cut): &(Option<i128>, i128)| floor.and_then(|floor| floor.checked_add(*cut));
        if all.iter().any(|(floor, _)| floor.is_none()) {
            return Self::WHOLE;
        }
        Self::new(lo, all.iter().filter_map(up).max())
    }

    /// The enclosure of the root of a number that is not negative; nothing is known if it may be.
    pub fn root(self) -> Self {
        if !self.is_bounded() || self.lo < 0 {
            return Self::WHOLE;
        }
        let floor = |x: i128| (BigInt::from(x) << PLACES).sqrt().to_i128();
        Self::new(floor(self.lo), floor(self.hi).map(|x| x + 1))
    }

    /// The larger of the two.
    pub fn max(self, other: Self) -> Self {
        if self.is_bounded() && other.is_bounded() {
            Self { lo: self.lo.max(other.lo), hi: self.hi.max(other.hi) }
        } else {
            Self::WHOLE
        }
    }

    /// `2^bits` times the number.
    pub fn doubled(self, bits: u32) -> Self {
        let small = bits < 64 && self.is_bounded() && self.magnitude()[1] <= LIMIT >> bits;
        if small { Self { lo: self.lo << bits, hi: self.hi << bits } } else { Self::WHOLE }
    }

    /// `(Σ c x) / d` for integers c, `Σ |c| <= 64`, and `d > 0`: rounded once.
    pub fn mean(terms: impl Iterator<Item = (i64, Self)>, d: i64) -> Self {
        let (mut lo, mut hi) = (0, 0);
        for (c, x) in terms {
            if !x.is_bounded() || x.magnitude()[1] > LIMIT >> 6 {
                return Self::WHOLE;
            }
            let (c, [low, high]) = (i128::from(c), if c < 0 { [x.hi, x.lo] } else { [x.lo, x.hi] });
            lo += c * low;
            hi += c * high;
        }
        if d & (d - 1) == 0 {
            let bits = d.trailing_zeros();
            return Self::new(Some(lo >> bits), Some(-(-hi >> bits)));
        }
        let d = i128::from(d);
        Self::new(Some(lo.div_euclid(d)), Some(-(-hi).div_euclid(d)))
    }

    /// The number 0 alone.
    pub fn is_zero(self) -> bool {
        self == Self::ZERO
    }

    /// Certainly not below 0.
    pub fn is_at_least_zero(self) -> bool {
        Self::ZERO.at_most(self)
    }

    /// The ends, if there are any.
    pub fn ends(self) -> Option<[BigRational; 2]> {
        let end = |x: i128| BigRational::new(x.into(), BigInt::from(1) << PLACES);
        self.is_bounded().then(|| [end(self.lo), end(self.hi)])
    }

    /// Certainly below, or equal.
    pub fn at_most(self, other: Self) -> bool {
        self.is_bounded() && other.is_bounded() && self.hi <= other.lo
    }

    /// Certainly below.
    pub fn below(self, other: Self) -> bool {
        self.is_bounded() && other.is_bounded() && self.hi < other.lo
    }

    /// Certainly above 0.
    pub fn is_positive(self) -> bool {
        Self::ZERO.below(self)
    }

    /// Certainly not above 0.
    pub fn is_at_most_zero(self) -> bool {
        self.at_most(Self::ZERO)
    }

    /// A number in it, for reading only.
    pub fn near(self) -> BigRational {
        BigRational::new(self.middle().lo.into(), BigInt::from(1) << PLACES)
    }
}

impl std::ops::Add for Fixed {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        if self.is_bounded() && other.is_bounded() {
            Self::new(self.lo.checked_add(other.lo), self.hi.checked_add(other.hi))
        } else {
            Self::WHOLE
        }
    }
}

impl std::ops::Neg for Fixed {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        if self.is_bounded() { Self { lo: -self.hi, hi: -self.lo } } else { Self::WHOLE }
    }
}

impl std::ops::Sub for Fixed {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl std::ops::Mul for Fixed {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        if !self.is_bounded() || !other.is_bounded() {
            return Self::WHOLE;
        }
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        if let Some(product) = self.times_small(other) {
            return product;
        }
        // Which ends meet is settled by the signs, with neither factor below 0.
        match (self.hi <= 0, other.hi <= 0) {
            (true, true) => return (-self) * (-other),
            (true, false) => return -((-self) * other),
            (false, true) => return -(self * (-other)),
            (false, false) => (),
        }
        let hi = product_above(self.hi, other.hi);
        let (below, above) = (product_below, product_above);
        match (self.lo >= 0, other.lo >= 0) {
            (true, true) => Self::new(below(self.lo, other.lo), hi),
            (true, false) => Self::new(below(self.hi, other.lo), hi),
            (false, true) => Self::new(below(self.lo, other.hi), hi),
            (false, false) => {
                let lo = below(self.lo, other.hi).zip(below(self.hi, other.lo));
                let least = above(self.lo, other.lo);
                Self::new(lo.map(|(x, y)| x.min(y)), hi.zip(least).map(|(x, y)| x.max(y)))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::ratio;

    fn contains(x: Fixed, y: &BigRational) -> bool {
        let end = |e: i128| BigRational::new(e.into(), BigInt::from(1) << PLACES);
        x.is_bounded() && &end(x.lo) <= y && y <= &end(x.hi)
    }

    #[test]
    fn operations_contain_the_exact_results() {
        let numbers: Vec<_> = [
            (1, 3),
            (-1, 3),
            (7, 5),
            (-22, 7),
            (0, 1),
            (1_000_003, 17),
            (-1, 1_000_000_007),
            (-123_456_789, 2),
        ]
        .map(|(p, q)| ratio(p, q))
        .to_vec();
        for a in &numbers {
            for b in &numbers {
                let (x, y) = (Fixed::of(a), Fixed::of(b));
                assert!(contains(x + y, &(a + b)) && contains(x - y, &(a - b)));
                assert!(contains(x * y, &(a * b)) && contains(x.square(), &(a * a)));
                let hull = Fixed::between(a.min(b), a.max(b));
                assert!(contains(hull * hull, &(a * b)) && contains(hull.square(), &(a * a)));
                if b != &ratio(0, 1) {
                    assert!(contains(x.over(y), &(a / b)));
                    if b.denom().bits() < 20 {
                        assert!(!contains(x.over(y), &(a / b + ratio(1, 1 << 30))));
                    }
                }
                let mean = Fixed::mean([(3, x), (-5, y)].into_iter(), 24);
                assert!(contains(mean, &((a * ratio(3, 1) - b * ratio(5, 1)) / ratio(24, 1))));
                let mean = Fixed::mean([(-3, x), (5, y)].into_iter(), 16);
                assert!(contains(mean, &((b * ratio(5, 1) - a * ratio(3, 1)) / ratio(16, 1))));
                assert!(contains(x.doubled(7), &(a * ratio(128, 1))));
                // Boxes round both, of every combination of signs.
                let wide = |x: &BigRational| Fixed::between(&(x - ratio(1, 2)), &(x + ratio(1, 3)));
                for c in [a - ratio(1, 2), a.clone(), a + ratio(1, 3)] {
                    for d in [b - ratio(1, 2), b.clone(), b + ratio(1, 3)] {
                        assert!(contains(wide(a) * wide(b), &(&c * &d)));
                    }
                }
                if a < b {
                    assert!(x.below(y) && x.at_most(y) && !y.at_most(x));
                }
            }
            let root = Fixed::of(&(a * a)).root();
            assert!(contains(root, &if a < &ratio(0, 1) { -a } else { a.clone() }));
        }
    }

    #[test]
    fn what_is_too_large_proves_nothing() {
        let large = Fixed::of(&ratio(1 << 61, 1));
        assert!(large.is_bounded() && !(large * large).is_bounded());
        assert!(
            !(large + large + large).is_bounded()
                && !Fixed::of(&(ratio(i64::MAX, 1) * ratio(3, 1))).is_bounded()
        );
        let whole = large * large;
        assert!(
            !whole.below(Fixed::ONE) && !Fixed::ONE.at_most(whole) && !(whole - whole).is_bounded()
        );
        assert!(!Fixed::ONE.over(Fixed::ZERO).is_bounded() && !(-Fixed::ONE).root().is_bounded());
        assert!(!whole.square().is_bounded());
    }
}
