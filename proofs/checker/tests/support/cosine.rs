// cos(π/(4n)), enclosed by a Taylor sum in rationals.

use num_bigint::BigInt;
use num_rational::BigRational;

/// lo and hi of `"cosine"`: 40 decimals, one unit apart or more.
pub fn cosine(n: usize) -> [String; 2] {
    let digits = "314159265358979323846264338327950288419716939937510";
    let ten = |k: u32| BigInt::from(10).pow(k);
    let pi = BigRational::new(digits.parse().unwrap(), ten(50));
    let x = pi / BigInt::from(4 * n);
    let (mut term, mut sum) = (BigRational::from_integer(1.into()), BigRational::default());
    for k in 0..20 {
        sum += &term;
        term = -term * &x * &x / BigInt::from((2 * k + 1) * (2 * k + 2));
    }
    let floor = (sum * ten(40)).floor().to_integer();
    [-1, 2].map(|step: i64| BigRational::new(&floor + step, ten(40)).to_string())
}
