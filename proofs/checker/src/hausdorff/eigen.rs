//! The net of an eigenspline of Loop's scheme: section 9's mode `ring`, amplified, over its characteristic map.

use super::claim::{Eigen, Hausdorff};
use crate::cosine::enclose;
use crate::file::{Cosine, Number};
use crate::fixed::Fixed;
use crate::reject::{Outcome, Rule, ensure};

/// Shows that the mesh is within the bound of the net (Re chi, Im chi, amplitude Re y), coordinate by coordinate.
///
/// # Errors
///
/// If and only if it is not: rule `mesh`; or without the cosine of valence 4 n: rule `cosine`.
pub fn check(claim: &Hausdorff, eigen: &Eigen, cosine: Option<&Cosine>) -> Outcome<()> {
    let (rule, n) = (Rule::Mesh, eigen.valence);
    ensure!(claim.vertices.len() == 1 + 3 * n, rule, "the two-ring has {} vertices", 1 + 3 * n);
    ensure!(claim.faces == faces(n), rule, "the faces are not those of the two-ring");
    let cosines = cosines(4 * n, cosine)?;
    let [chi, mode] = [1, eigen.frequency].map(|k| Mode::new(n, k, &cosines));
    let (amplitude, within) = (Fixed::of(&eigen.amplitude.0), Fixed::of(&eigen.within.0));
    for (index, vertex) in claim.vertices.iter().enumerate() {
        let [x, y] = chi.at(n, index, &cosines);
        let exact = [x, y, amplitude * mode.at(n, index, &cosines)[0]];
        for (Number(given), exact) in vertex.iter().zip(exact) {
            let gap = Fixed::of(given) - exact;
            let near = gap.at_most(within) && (-gap).at_most(within);
            ensure!(near, rule, "vertex {} is not within the bound of the mode's", index + 1);
        }
    }
    Ok(())
}

/// The facets of the two-ring, vertices from 1 in the order O, the a_j, the b_j, the d_j.
fn faces(n: usize) -> Vec<Vec<usize>> {
    let [a, b, d] = [2, 2 + n, 2 + 2 * n].map(|first| move |j: usize| first + j % n);
    let sector = |j: usize| {
        [
            vec![1, a(j), a(j + 1)],
            vec![a(j), b(j), d(j)],
            vec![a(j), d(j), a(j + 1)],
            vec![a(j + 1), d(j), b(j + 1)],
        ]
    };
    (0..n).flat_map(sector).collect()
}

/// `cos(2πm/N)`, m = 0..N, from the enclosure of cos(π/N): `c_(a+b) = 2 c_a c_b - c_(a-b)` with a = b or a = b + 1, so
/// that the errors grow with the square of m only.
fn cosines(of: usize, cosine: Option<&Cosine>) -> Outcome<Vec<Fixed>> {
    let list = match cosine {
        Some(Cosine::List(list)) => &list[..],
        _ => &[],
    };
    let ends = list.iter().find(|(n, ..)| *n == of).map(|(_, lo, hi)| (&lo.0, &hi.0));
    let [low, high] = enclose(of, ends)?.ends();
    let mut all = vec![Fixed::ONE, Fixed::between(&low, &high)];
    for m in 2..=of {
        let (a, b) = (m.div_ceil(2), m / 2);
        all.push((all[a] * all[b]).times(2, 1) - all[a - b]);
    }
    Ok(all)
}

/// The mode `ring` of a frequency k, `1 <= k <= n/2`: `a_j = w^j`, `d_j = delta (w^j + w^(j+1))`, `b_j = rho w^j`.
struct Mode {
    frequency: usize,
    delta: Fixed,
    rho: Fixed,
}

impl Mode {
    fn new(n: usize, frequency: usize, cosines: &[Fixed]) -> Self {
        // 8 lambda = 3 + 2 cos, 16 lambda = 6 + 4 cos, cos = cos(2πk/n).
        let twice = cosines[4 * frequency].times(2, 1);
        let whole = |x: i64| Fixed::ratio(x, 1);
        let delta = if 2 * frequency == n { Fixed::ZERO } else { whole(3).over(whole(2) + twice) };
        let top = whole(10) + twice + delta * (whole(2) + twice);
        Self { frequency, delta, rho: top.over(whole(5) + twice.times(2, 1)) }
    }

    /// The real and the imaginary part at a vertex.
    fn at(&self, n: usize, index: usize, cosines: &[Fixed]) -> [Fixed; 2] {
        // cos(2πkj/n) = c_(4kj), sin(2πkj/n) = c_(4kj - n), indices modulo 4n.
        let power =
            |j: usize| [0, 3 * n].map(|back| cosines[(4 * self.frequency * j + back) % (4 * n)]);
        let Some(index) = index.checked_sub(1) else { return [Fixed::ZERO; 2] };
        let j = index % n;
        match index / n {
            0 => power(j),
            1 => power(j).map(|x| self.rho * x),
            _ => {
                let (now, next) = (power(j), power(j + 1));
                [0, 1].map(|i| self.delta * (now[i] + next[i]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rational::{parse, ratio};

    #[test]
    fn modes_are_eigenvectors() {
        // n = 5, by the rules of subdivision written out; cos(π/20) = 0.98768834059513772619..
        let n = 5;
        let [lo, hi] = ["4938441702975688630/5000000000000000000", "0"]
            .map(|text| text.split('/').map(|x| parse(x).unwrap()).collect::<Vec<_>>());
        let lo = &lo[0] / &lo[1];
        let top = &lo + ratio(1, 1_000_000_000_000_000_000);
        assert_eq!(hi.len(), 1);
        let list = Cosine::List(vec![(4 * n, Number(lo), Number(top))]);
        let cosines = cosines(4 * n, Some(&list)).unwrap();
        let close = |a: Fixed, b: Fixed| {
            let gap = (a - b).square();
            assert!(gap.at_most(Fixed::ratio(1, 1 << 60)), "{a:?} {b:?}");
        };
        for k in 1..=2 {
            let mode = Mode::new(n, k, &cosines);
            let lambda = Fixed::ratio(3, 8) + cosines[4 * k].times(1, 4);
            for part in [0, 1] {
                let at = |kind: usize, j: usize| mode.at(n, 1 + kind * n + j % n, &cosines)[part];
                let [a, b, d] = [0, 1, 2].map(|kind| move |j| at(kind, j));
                let (before, here, next) = (n - 1, 0, 1);
                let new_a = a(here).times(3, 8) + (a(next) + a(before)).times(1, 8);
                close(new_a, lambda * a(here));
                let new_d = (a(here) + a(next)).times(3, 8) + d(here).times(1, 8);
                close(new_d, lambda * d(here));
                let round = a(next) + a(before) + b(here) + d(here) + d(before);
                close(a(here).times(10, 16) + round.times(1, 16), lambda * b(here));
            }
        }
    }
}
