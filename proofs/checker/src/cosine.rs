//! Beta, the sum of Loop's weights round a vertex, and the proof of an enclosure of cos(π/n).

use num_bigint::BigInt;
use num_rational::BigRational;
use num_traits::{One, Signed, Zero};

use crate::file::Weights;
use crate::polynomial::Beta;
use crate::rational::ratio;

/// Beta, if it is rational: always for `warren`, and where cos 2π/n is.
pub fn rational_beta(weights: Weights, n: usize) -> Option<BigRational> {
    match (weights, n) {
        (Weights::Warren, 3) => Some(ratio(9, 16)),
        (Weights::Warren, _) => Some(ratio(3, 8)),
        (Weights::Original, 3) => Some(beta_of(&ratio(-1, 2))),
        (Weights::Original, 4) => Some(beta_of(&ratio(0, 1))),
        (Weights::Original, 6) => Some(beta_of(&ratio(1, 2))),
        _ => None,
    }
}

/// The enclosure of beta of the original weights from `lo <= cos(π/n) < hi`.
///
/// # Errors
///
/// If and only if the rules of the format do not prove `lo <= cos(π/n) < hi`.
pub fn enclose_beta(n: usize, lo: &BigRational, hi: &BigRational) -> Result<Beta, String> {
    if lo.is_negative() || lo >= hi || hi > &BigRational::one() {
        return Err("the enclosure of cos(π/n) is not 0 <= lo < hi <= 1".into());
    }
    if !chebyshev_signs(n, lo).contains(&num_bigint::Sign::Minus) {
        return Err(format!("lo <= cos(π/{n}) is not shown: no U_k(lo) with k < n is negative"));
    }
    if chebyshev_signs(n, hi).iter().any(|sign| *sign != num_bigint::Sign::Plus) {
        return Err(format!(
            "cos(π/{n}) < hi is not shown: not all U_k(hi) with k < n are positive"
        ));
    }
    // cos 2π/n = 2 cos^2(π/n) - 1 grows with cos(π/n) >= 0, and beta falls with it.
    let double = |x: &BigRational| x * x * ratio(2, 1) - BigRational::one();
    Ok(Beta::between(&beta_of(&double(hi)), &beta_of(&double(lo))))
}

/// 5/8 - (3/8 + c/4)^2, c = cos 2π/n.
fn beta_of(c: &BigRational) -> BigRational {
    let inner = ratio(3, 8) + c / BigInt::from(4);
    ratio(5, 8) - &inner * &inner
}

/// The signs of U_0(x), .., U_(n-1)(x), the Chebyshev polynomials of the second kind.
fn chebyshev_signs(n: usize, x: &BigRational) -> Vec<num_bigint::Sign> {
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

    fn enclose(n: usize, lo: &str, hi: &str) -> Result<Beta, String> {
        enclose_beta(n, &parse(lo).unwrap(), &parse(hi).unwrap())
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
    }

    #[test]
    fn the_rational_cosine_agrees_with_its_enclosure() {
        // n = 6: cos(π/6) = sqrt(3)/2 = 0.8660254.., beta = 3/8. n = 4: 0.70710678.., beta = 31/64.
        for (n, lo, hi) in
            [(6, "4330127/5000000", "1732051/2000000"), (4, "7071067/10000000", "1767767/2500000")]
        {
            let beta = enclose(n, lo, hi).unwrap();
            let exact = rational_beta(Weights::Original, n).unwrap();
            assert!((beta.middle() - exact).abs() < ratio(1, 1_000_000));
        }
        assert_eq!(rational_beta(Weights::Original, 3), Some(ratio(9, 16)));
        assert_eq!(rational_beta(Weights::Original, 4), Some(ratio(31, 64)));
        assert_eq!(rational_beta(Weights::Original, 6), Some(ratio(3, 8)));
        assert_eq!(rational_beta(Weights::Original, 5), None);
    }
}
