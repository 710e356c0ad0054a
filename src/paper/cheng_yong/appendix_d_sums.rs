//! Appendix D: the two printed combinations of second differences, with the sums of their factors' magnitudes.

use num_traits::Zero;

use super::functional::{Functional, ring};
use super::printed;
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::{IntegerRow, catmull_clark};

/// `2 V_b - V_a - V_c` of labels (b, a, c).
fn second_difference([b, a, c]: [usize; 3]) -> IntegerRow {
    IntegerRow::new([(b - 1, 2), (a - 1, -1), (c - 1, -1)])
}

/// A sum of second differences with factors.
struct Sum {
    n: u32,
    total: Functional,
    factors: i64,
}

impl Sum {
    fn new(n: u32) -> Self {
        Sum {
            n,
            total: Functional::zero(),
            factors: 0,
        }
    }

    /// Adds `factor (2 V_b - V_a - V_c)`; labels (b, a, c).
    fn add(&mut self, factor: i64, bac: [usize; 3]) {
        let size = catmull_clark::local_net_size(self.n);
        let row = Functional::of_row(&second_difference(bac), size);
        let row = row * &<Rational as Ring>::from_integer(factor);
        self.total = self.total.clone() + &row;
        self.factors += factor.abs();
    }

    fn over(self, denominator: i64) -> (Functional, Rational) {
        let part = Rational::ratio(1, denominator);
        (
            self.total * &part,
            part * <Rational as Ring>::from_integer(self.factors),
        )
    }
}

/// The second case as printed: the combination for `2 V_6 - V_1 - V_(2N+4)` of level i + 1.
pub fn second_case(n: u32) -> (Functional, Rational) {
    let (m, far) = (i64::from(n), 2 * n as usize);
    let square = m * m;
    let next = |j: usize| 2 * (j % n as usize + 1);
    let mut sum = Sum::new(n);
    sum.add(square, [7, ring(n, 8), far + 5]);
    sum.add(square, [5, far + 3, 4]);
    sum.add(6 * square, [6, 1, far + 4]);
    for j in 1..=n as usize {
        sum.add(8, [next(j), 2 * j + 1, next(j) + 1]);
    }
    // (8N² - 56)(-2 V_1 + V_4 + V_8).
    sum.add(-(8 * square - 56), [1, 4, ring(n, 8)]);
    for j in 3..=n as usize + 1 {
        sum.add(56, [1, next(j - 1), next(j + 1)]);
    }
    sum.over(64 * square)
}

/// The first case as printed: the combination for `2 V_1 - V_2 - V_6` of level i + 1.
pub fn first_case(n: u32) -> Option<(Functional, Rational)> {
    let mut sum = Sum::new(n);
    if n == 3 {
        for (factor, bac) in printed::APPENDIX_D_OF_3 {
            sum.add(factor, bac);
        }
        return Some(sum.over(144));
    }
    if n == 4 {
        return None;
    }
    let (square, last) = (i64::from(n * n), 2 * n as usize);
    for j in 1..=n as usize {
        // V_(2N+1) for V_(2j-1) when j = 1.
        let before = if j == 1 { last + 1 } else { 2 * j - 1 };
        sum.add(-4, [2 * j, before, 2 * j + 1]);
    }
    sum.add(square, [2, last + 1, 3]);
    sum.add(square, [6, 7, 5]);
    sum.add(square - 28, [1, 4, last]);
    sum.add(square - 28, [1, 4, 8]);
    for j in 5..n as usize {
        sum.add(-28, [1, 2 * j, 2 * (j - 2)]);
    }
    sum.add(-28, [1, last - 4, last]);
    sum.add(-28, [1, last - 2, 2]);
    sum.add(8 * square - 28, [1, 2, 6]);
    Some(sum.over(16 * square))
}
