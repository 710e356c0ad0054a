//! Maxima of quartics in Bernstein form over a triangle, in `f64`: proposals.

use std::sync::LazyLock;

use crate::bernstein::Patch;
use crate::bernstein::triangle::QuarticTriangle;

/// Number of grid steps along an edge.
const GRID: usize = 8;

/// The values of the 15 Bernstein polynomials at the points of a grid.
static SAMPLES: LazyLock<Vec<([f64; 2], [f64; 15])>> = LazyLock::new(|| {
    let step = 1.0 / GRID as f64;
    let points =
        (0..=GRID).flat_map(|i| (0..=GRID - i).map(move |j| [i, j].map(|k| k as f64 * step)));
    points.map(|point| (point, basis(point))).collect()
});

/// The values of the 15 Bernstein polynomials.
pub fn basis([v, w]: [f64; 2]) -> [f64; 15] {
    const FACTORIAL: [f64; 5] = [1.0, 1.0, 2.0, 6.0, 24.0];
    let u = 1.0 - v - w;
    let mut values = [0.0; 15];
    for r in 0..=4usize {
        for k in 0..=r {
            let (i, j) = (4 - r, r - k);
            let multiplicity = 24.0 / (FACTORIAL[i] * FACTORIAL[j] * FACTORIAL[k]);
            let power = |x: f64, e: usize| x.powi(e as i32);
            values[r * (r + 1) / 2 + k] = multiplicity * power(u, i) * power(v, j) * power(w, k);
        }
    }
    values
}

fn dot(a: &[f64; 15], b: &[f64; 15]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The largest value on the grid and where.
pub fn sample(c: &[f64; 15]) -> (f64, [f64; 2]) {
    let mut best = (f64::NEG_INFINITY, [0.0, 0.0]);
    for (point, values) in SAMPLES.iter() {
        let value = dot(c, values);
        if value > best.0 {
            best = (value, *point);
        }
    }
    best
}

/// The largest value over the triangle and where, starting from the best grid point: coordinate
/// steps that halve, along the three edge directions, with a Newton step where it helps.
pub fn maximise(c: &[f64; 15]) -> (f64, [f64; 2]) {
    let (mut value, mut at) = sample(c);
    let mut step = 1.0 / GRID as f64;
    let inside = |[v, w]: [f64; 2]| v >= 0.0 && w >= 0.0 && v + w <= 1.0;
    while step > 1e-10 {
        let mut moved = false;
        for [dv, dw] in [[1.0, 0.0], [0.0, 1.0], [1.0, -1.0]] {
            for sign in [step, -step] {
                let mut next = [at[0] + sign * dv, at[1] + sign * dw];
                if !inside(next) {
                    continue;
                }
                next = next.map(|x| if x < 1e-13 { 0.0 } else { x });
                let here = dot(c, &basis(next));
                if here > value {
                    (value, at, moved) = (here, next, true);
                }
            }
        }
        if !moved {
            step *= 0.5;
        }
    }
    // Newton: the search above stalls at half the digits.
    let patch = QuarticTriangle(*c);
    let on_border = at[0] == 0.0 || at[1] == 0.0 || at[0] + at[1] == 1.0;
    if !on_border {
        for _ in 0..4 {
            let (_, [gv, gw]) = patch.evaluate([&at[0], &at[1]]);
            let h = 1e-4;
            let slope = |v: f64, w: f64| patch.evaluate([&v, &w]).1;
            let [[a0, b0], [a1, b1]] = [slope(at[0] - h, at[1]), slope(at[0] + h, at[1])];
            let [[_, d0], [_, d1]] = [slope(at[0], at[1] - h), slope(at[0], at[1] + h)];
            let (a, b, d) = (
                (a1 - a0) / (2.0 * h),
                (b1 - b0) / (2.0 * h),
                (d1 - d0) / (2.0 * h),
            );
            let determinant = a * d - b * b;
            if determinant <= 0.0 || a >= 0.0 {
                break;
            }
            let next = [
                at[0] - (d * gv - b * gw) / determinant,
                at[1] - (a * gw - b * gv) / determinant,
            ];
            if !inside(next) || (next[0] - at[0]).abs() + (next[1] - at[1]).abs() > 1e-3 {
                break;
            }
            at = next;
        }
        value = value.max(dot(c, &basis(at)));
    }
    (value, at)
}

/// The maximum of a quartic on [0, 1] given by its five coefficients, and where.
pub fn maximise_edge(f: &[f64; 5]) -> (f64, f64) {
    let at = |s: f64| {
        let r = 1.0 - s;
        f[0] * r.powi(4)
            + 4.0 * f[1] * r.powi(3) * s
            + 6.0 * f[2] * r * r * s * s
            + 4.0 * f[3] * r * s.powi(3)
            + f[4] * s.powi(4)
    };
    let slope = |s: f64| {
        let r = 1.0 - s;
        4.0 * ((f[1] - f[0]) * r.powi(3)
            + 3.0 * (f[2] - f[1]) * r * r * s
            + 3.0 * (f[3] - f[2]) * r * s * s
            + (f[4] - f[3]) * s.powi(3))
    };
    // Where f is concave, its slope falls: bisection.
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let s = 0.5 * (low + high);
    let s = if s < 1e-12 {
        0.0
    } else if s > 1.0 - 1e-12 {
        1.0
    } else {
        s
    };
    (at(s), s)
}

/// Whether a quartic on [0, 1] has second differences that are at most 0, up to rounding.
pub fn is_concave_edge(f: &[f64; 5]) -> bool {
    f.windows(3).all(|w| w[0] - 2.0 * w[1] + w[2] <= 1e-14)
}

/// Whether the coefficients of the second derivatives form negative semidefinite matrices, up to
/// rounding.
pub fn is_concave(c: &[f64; 15]) -> bool {
    let [vv, vw, ww] = Patch::<f64, f64>::second_derivatives(&QuarticTriangle(*c));
    (0..6).all(|i| {
        vv[i] <= 1e-13 && ww[i] <= 1e-13 && vw[i] * vw[i] <= vv[i] * ww[i] * (1.0 + 1e-9) + 1e-26
    })
}
