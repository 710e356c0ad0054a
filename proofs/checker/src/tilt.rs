//! Where a part of the surface goes beyond a facet's edges: the heights of the facet are changed, to the worse inside
//! and to the better outside. Section 9 of FORMAT.md.

use crate::complex::Complex;
use crate::fixed::Fixed;

/// How often a line is exchanged for another, and how often the corners are gone through.
const STEPS: usize = 8;
const ROUNDS: usize = 2;

/// A complex u and numbers t_v >= 0, one for each corner, that make the largest of `|g + u Σ t_v T_v|` small; g the
/// differences and T_v the signed areas at the coefficients of a part. A choice: it proves nothing.
pub fn tilt(gaps: &[Complex; 15], areas: &[[Fixed; 3]; 15]) -> (Complex, [Fixed; 3]) {
    let share = Fixed::ratio(1, 16);
    let mean = gaps.iter().fold(Complex::ZERO, |sum, g| sum + *g).map(|x| (x * share).middle());
    let norm = mean.norm().middle();
    let dot = |g: &Complex| (g.re * mean.re + g.im * mean.im).middle();
    let mut values = gaps.each_ref().map(dot);
    let mut factors = [Fixed::ZERO; 3];
    for corner in (0..3).cycle().take(3 * ROUNDS) {
        let slopes = areas.each_ref().map(|areas| (areas[corner] * norm).middle());
        let before = factors[corner];
        let start: [Fixed; 15] = std::array::from_fn(|i| (values[i] - slopes[i] * before).middle());
        let factor = lowest(&start, &slopes);
        factors[corner] = factor;
        values = std::array::from_fn(|i| (start[i] + slopes[i] * factor).middle());
    }
    (mean, factors)
}

/// A `t >= 0` where the largest of the `c_i + b_i t` is smallest, or nearly so.
fn lowest(c: &[Fixed; 15], b: &[Fixed; 15]) -> Fixed {
    let top = |t: Fixed| {
        let mut best = (0, c[0] + b[0] * t);
        for i in 1..15 {
            let value = c[i] + b[i] * t;
            if best.1.below(value) {
                best = (i, value);
            }
        }
        best.0
    };
    let mut falling = top(Fixed::ZERO);
    if !b[falling].below(Fixed::ZERO) {
        return Fixed::ZERO;
    }
    let mut rising = 0;
    for i in 1..15 {
        if b[rising].below(b[i]) {
            rising = i;
        }
    }
    let mut t = Fixed::ZERO;
    for _ in 0..STEPS {
        let next = (c[falling] - c[rising]).over(b[rising] - b[falling]).middle();
        if !next.is_bounded() || next.is_at_most_zero() {
            break;
        }
        t = next;
        match top(t) {
            i if i == falling || i == rising => break,
            i if b[i].below(Fixed::ZERO) => falling = i,
            i => rising = i,
        }
    }
    t
}
