//! cos(2π/n), the proof of its enclosure, and beta, the sum of Loop's weights round a vertex.

use num_bigint::{BigInt, Sign};
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::claim::Weights;
use crate::rational::ratio;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::ring::Interval;

/// cos(2π/n), if it is rational.
fn rational_cosine(n: usize) -> Option<BigRational> {
    [None, None, None, Some(-1), Some(0), None, Some(1)].get(n)?.map(|c| ratio(c, 2))
}

/// The cos(2πk/n), k = 0..n-1, if they are rational: `c_(k+1) = 2 c_1 c_k - c_(k-1)`.
pub fn rational_cosines(n: usize) -> Option<Vec<BigRational>> {
    let first = rational_cosine(n)?;
    let next = |k: &[BigRational; 2]| [k[1].clone(), &first * &k[1] * ratio(2, 1) - &k[0]];
    let start = [BigRational::one(), first.clone()];
    Some(std::iter::successors(Some(start), |k| Some(next(k))).take(n).map(|[c, _]| c).collect())
}

/// Beta, if it is rational: always for `warren`, and where cos 2π/n is.
pub fn rational_beta(weights: Weights, n: usize) -> Option<BigRational> {
    match (weights, n) {
        (Weights::Warren, 3) => Some(ratio(9, 16)),
        (Weights::Warren, _) => Some(ratio(3, 8)),
        (Weights::Original, _) => rational_cosine(n).map(|c| beta_of(&c)),
    }
}

/// 5/8 - (3/8 + c/4)^2, c = cos 2π/n.
fn beta_of(c: &BigRational) -> BigRational {
    let inner = ratio(3, 8) + c / BigInt::from(4);
    ratio(5, 8) - &inner * &inner
}

type Ends<'a> = Option<(&'a BigRational, &'a BigRational)>;

/// The enclosure of cos 2π/n from `lo <= cos(π/n) < hi`.
///
/// # Errors
///
/// If and only if there is none, or the rules of the format do not prove it: rule `cosine`.
pub fn enclose(n: usize, ends: Ends) -> Outcome<Interval> {
    double(n, ends).map(|[low, high]| Interval::outward(&low, &high))
}

/// The enclosure of beta of the original weights, which falls with cos 2π/n.
///
/// # Errors
///
/// As in [`enclose`].
pub fn enclose_beta(n: usize, ends: Ends) -> Outcome<Interval> {
    double(n, ends).map(|[low, high]| Interval::outward(&beta_of(&high), &beta_of(&low)))
}

/// The ends of cos 2π/n = 2 cos^2(π/n) - 1, which grows with cos(π/n) >= 0.
pub fn double(n: usize, ends: Ends) -> Outcome<[BigRational; 2]> {
    let rule = Rule::Cosine;
    let missing = || Rejection::new(rule, "an enclosure of cos(π/n) is missing");
    let (lo, hi) = ends.ok_or_else(missing)?;
    let ordered = !lo.is_negative() && lo < hi && hi <= &BigRational::one();
    ensure!(ordered, rule, "the enclosure of cos(π/n) is not 0 <= lo < hi <= 1");
    let below = chebyshev_signs(n, lo).contains(&Sign::Minus);
    ensure!(below, rule, "lo <= cos(π/{n}) is not shown: no U_k(lo) with k < n is negative");
    let above = chebyshev_signs(n, hi).iter().all(|sign| *sign == Sign::Plus);
    ensure!(above, rule, "cos(π/{n}) < hi is not shown: not all U_k(hi) with k < n are positive");
    Ok([lo, hi].map(|x| x * x * ratio(2, 1) - BigRational::one()))
}

/// The signs of U_0(x), .., U_(n-1)(x), the Chebyshev polynomials of the second kind.
fn chebyshev_signs(n: usize, x: &BigRational) -> Vec<Sign> {
    // With x = a/b and V_k = b^k U_k: V_(k+1) = 2a V_k - b^2 V_(k-1).
    let (twice, square) = (x.numer() * 2, x.denom() * x.denom());
    let (mut before, mut now) = (BigInt::zero(), BigInt::one());
    let mut signs = Vec::new();
    for _ in 0..n {
        signs.push(now.sign());
        let next = &twice * &now - &square * &before;
        before = std::mem::replace(&mut now, next);
    }
    signs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::parse;
    use crate::ring::Ring;
    use crate::scalar::Scalar;

    fn enclose(n: usize, lo: &str, hi: &str) -> Outcome<Interval> {
        enclose_beta(n, Some((&parse(lo).unwrap(), &parse(hi).unwrap())))
    }

    #[test]
    fn cosines_are_enclosed() {
        // cos(π/5) = 0.80901699437494742410.., cos(π/7) = 0.90096886790241912623..
        assert!(
            enclose(5, "8090169943749/10000000000000", "16180339887499/20000000000000").is_ok()
        );
        assert!(enclose(7, "9009688679/10000000000", "90096886791/100000000000").is_ok());
        // Ends that leave the cosine out, on either side, by one unit of the eleventh decimal.
        assert!(enclose(7, "90096886791/100000000000", "91/100").is_err());
        assert!(enclose(7, "9/10", "9009688679/10000000000").is_err());
        // Half the angle, twice the angle, and ends in the wrong order.
        assert!(enclose(7, "97/100", "49/50").is_err());
        assert!(enclose(7, "31/50", "63/100").is_err());
        assert!(enclose(7, "91/100", "9/10").is_err());
        assert!(enclose(7, "-1/2", "91/100").is_err());
        assert!(enclose(7, "9/10", "11/10").is_err());
        assert!(enclose_beta(7, None).is_err());
    }

    #[test]
    fn the_rational_cosine_agrees_with_its_enclosure() {
        // n = 6: cos(π/6) = sqrt(3)/2 = 0.8660254.., beta = 3/8. n = 4: 0.70710678.., beta = 31/64.
        for (n, lo, hi) in
            [(6, "4330127/5000000", "1732051/2000000"), (4, "7071067/10000000", "1767767/2500000")]
        {
            let ring = Ring::Powers(enclose(n, lo, hi).unwrap());
            let exact = rational_beta(Weights::Original, n).unwrap();
            assert!((ring.near(&Scalar::generator(1)) - exact).abs() < ratio(1, 1_000_000));
        }
        assert_eq!(rational_beta(Weights::Original, 3), Some(ratio(9, 16)));
        assert_eq!(rational_beta(Weights::Original, 4), Some(ratio(31, 64)));
        assert_eq!(rational_beta(Weights::Original, 6), Some(ratio(3, 8)));
        assert_eq!(rational_beta(Weights::Original, 5), None);
        let list = |list: &[i64]| Some(list.iter().map(|&c| ratio(c, 2)).collect::<Vec<_>>());
        assert_eq!(rational_cosines(3), list(&[2, -1, -1]));
        assert_eq!(rational_cosines(4), list(&[2, 0, -2, 0]));
        assert_eq!(rational_cosines(6), list(&[2, 1, -1, -2, -1, 1]));
        assert!([0, 1, 2, 5, 7, 12].iter().all(|&n| rational_cosines(n).is_none()));
    }
}
