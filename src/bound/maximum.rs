//! Maxima of polynomials in Bernstein form over their domain, in `f64`: proposals.

use std::sync::LazyLock;

use super::shape::{MOST_COEFFICIENTS, Shape};

/// Number of grid steps along an edge.
const GRID: usize = 8;

type Samples = Vec<([f64; 2], [f64; MOST_COEFFICIENTS])>;

/// The values of the Bernstein polynomials at the points of a grid.
fn samples(shape: Shape) -> &'static Samples {
    const SHAPES: [Shape; 3] = [Shape::Triangle, Shape::Bicubic, Shape::Biquadratic];
    static ALL: LazyLock<[Samples; 3]> = LazyLock::new(|| {
        SHAPES.map(|shape| {
            let step = 1.0 / GRID as f64;
            let points = (0..=GRID).flat_map(|i| (0..=GRID).map(move |j| [i, j]));
            let points = points.map(|point| point.map(|k| k as f64 * step));
            (points.filter(|[v, w]| shape.contains([v, w])))
                .map(|point| (point, shape.basis(point)))
                .collect()
        })
    });
    &ALL[shape as usize]
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// The largest value on the grid and where.
pub fn sample(shape: Shape, c: &[f64]) -> (f64, [f64; 2]) {
    let mut best = (f64::NEG_INFINITY, [0.0, 0.0]);
    for (point, values) in samples(shape) {
        let value = dot(c, values);
        if value > best.0 {
            best = (value, *point);
        }
    }
    best
}

/// The largest value over the domain and where, starting from the best grid point: coordinate
/// steps that halve, along the directions of the shape, with a Newton step where it helps.
pub fn maximise(shape: Shape, c: &[f64]) -> (f64, [f64; 2]) {
    let (mut value, mut at) = sample(shape, c);
    let mut step = 1.0 / GRID as f64;
    let inside = |[v, w]: [f64; 2]| shape.contains([&v, &w]);
    while step > 1e-10 {
        let mut moved = false;
        for [dv, dw] in shape.directions() {
            for sign in [step, -step] {
                let mut next = [at[0] + sign * dv, at[1] + sign * dw];
                if !inside(next) {
                    continue;
                }
                next = next.map(snapped);
                let here = dot(c, &shape.basis(next));
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
    let near = 1e-3;
    let margin = [
        [near, 0.0],
        [0.0, near],
        [-near, 0.0],
        [0.0, -near],
        [near, near],
    ];
    let well_inside = margin
        .iter()
        .all(|[dv, dw]| inside([at[0] + dv, at[1] + dw]));
    if well_inside {
        for _ in 0..4 {
            let slope = |v: f64, w: f64| shape.evaluate::<f64, f64>(c, [&v, &w]).1;
            let [gv, gw] = slope(at[0], at[1]);
            let h = 1e-4;
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
        value = value.max(dot(c, &shape.basis(at)));
    }
    (value, at)
}

/// Zero and one, where rounding missed them.
fn snapped(x: f64) -> f64 {
    match x {
        _ if x < 1e-12 => 0.0,
        _ if x > 1.0 - 1e-12 => 1.0,
        _ => x,
    }
}

/// The maximum of a polynomial on [0, 1] given by its Bernstein coefficients, and where, if its slope
/// falls.
pub fn maximise_edge(f: &[f64]) -> (f64, f64) {
    let casteljau = |s: f64| -> (f64, f64) {
        let mut level = f.to_vec();
        while level.len() > 2 {
            level = (level.windows(2))
                .map(|pair| pair[0] * (1.0 - s) + pair[1] * s)
                .collect();
        }
        (level[0] * (1.0 - s) + level[1] * s, level[1] - level[0])
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if casteljau(middle).1 > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let s = snapped(0.5 * (low + high));
    (casteljau(s).0, s)
}

/// Whether a polynomial on [0, 1] has second differences that are at most 0, up to rounding.
pub fn is_concave_edge(f: &[f64]) -> bool {
    f.windows(3).all(|w| w[0] - 2.0 * w[1] + w[2] <= 1e-14)
}

/// Whether the coefficients of the second derivatives form negative semidefinite matrices, up to
/// rounding.
pub fn is_concave(shape: Shape, c: &[f64]) -> bool {
    let [vv, vw, ww] = shape.second_derivatives::<f64, f64>(c);
    (0..vv.len()).all(|i| {
        vv[i] <= 1e-13 && ww[i] <= 1e-13 && vw[i] * vw[i] <= vv[i] * ww[i] * (1.0 + 1e-9) + 1e-26
    })
}
