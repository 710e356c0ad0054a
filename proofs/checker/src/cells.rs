//! Cells: a patch of weights is at most the bound on its domain, shown in one of four ways.

use num_rational::BigRational;
use num_traits::{One, Signed};

use crate::file::{By, Name, Number};
use crate::patch::{Patch, combine, on_line};
use crate::rational::{decimal, ratio};
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::ring::Ring;
use crate::scalar::Scalar;
use crate::space::Space;

/// The most splits inside each other.
const SPLITS: usize = 12;

/// What is shown: the polynomial with the coefficients `c / q` is at most `bound / q` on the domain of the patch.
#[derive(Clone, Copy)]
pub struct Goal<'a> {
    pub space: &'a Space,
    pub c: &'a [Scalar],
    pub bound: &'a Scalar,
}

impl Goal<'_> {
    /// Shows it in a way, inside of so many splits.
    ///
    /// # Errors
    ///
    /// If and only if it is not shown: rule `cell-hull`, `cell-edge`, `cell-concave`, `cell-split` (if that is what is
    /// wrong), for "regular" `cell-regular`, for a way that there is not `format`; or the work allowed is used up.
    pub fn check(self, by: &By, splits: usize) -> Outcome<()> {
        let effort = if matches!(by, By::Split(..)) { 4000 } else { 64 };
        self.space.charge(effort * self.c.iter().map(Ring::cost).sum::<u64>())?;
        match by {
            By::Alone(Name::Hull) => self.hull(Rule::CellHull, &[]),
            By::Edge(Name::Edge, edge, Number(s)) => self.edge(*edge, s),
            By::Concave(Name::Concave, Number(v), Number(w)) => {
                self.concave(&[v.clone(), w.clone()])
            }
            By::Split(Name::Split, quarters) => self.split(quarters, splits),
            By::Alone(Name::Regular) => Err(Rejection::new(Rule::CellRegular, "inside a split")),
            _ => Err(Rejection::new(Rule::Format, "there is no such way to show a cell")),
        }
    }

    fn patch(self) -> Patch {
        self.space.patch()
    }

    /// The coefficients other than these are at most the bound.
    fn hull(self, rule: Rule, but: &[usize]) -> Outcome<()> {
        for (i, c) in self.c.iter().enumerate().filter(|(i, _)| !but.contains(i)) {
            self.space.at_most(c, self.bound, rule, format_args!("coefficient {i}"))?;
        }
        Ok(())
    }

    fn edge(self, edge: usize, s: &BigRational) -> Outcome<()> {
        let (space, rule, patch) = (self.space, Rule::CellEdge, self.patch());
        let within = !s.is_negative() && s <= &BigRational::one();
        let missing = || Rejection::new(rule, "there is no such edge, or no such point on it");
        let edge = patch.edge(edge).filter(|_| within).ok_or_else(missing)?;
        self.hull(rule, &edge)?;
        let f: Vec<_> = edge.iter().map(|&i| self.c[i].clone()).collect();
        for three in f.windows(3) {
            let bend = &(&three[0] - &three[1]) - &(&three[1] - &three[2]);
            space.at_most(&bend, &Scalar::integer(0), rule, "a second difference on the edge")?;
        }
        let [value, slope] =
            [0, 1].map(|order| combine(&on_line(patch.degree(), s, order), &f));
        for end in [0, 1] {
            let tangent = &value + &slope.scale(&(ratio(end, 1) - s));
            space.at_most(&tangent, self.bound, rule, format_args!("the tangent at {end}"))?;
        }
        Ok(())
    }

    fn concave(self, point: &[BigRational; 2]) -> Outcome<()> {
        let (space, rule, patch) = (self.space, Rule::CellConcave, self.patch());
        ensure!(patch.contains(point), rule, "the point is not in the domain");
        let zero = Scalar::integer(0);
        for bend in patch.bends() {
            let [aa, ab, bb] = bend.map(|weights| combine(&weights, self.c));
            space.at_most(&aa, &zero, rule, "a second derivative in v")?;
            space.at_most(&bb, &zero, rule, "a second derivative in w")?;
            let [square, product] = [space.ring.product(&ab, &ab), space.ring.product(&aa, &bb)];
            let definite = space.ring.is_at_most_zero(&(&square - &product));
            let shown = || [&aa, &ab, &bb].map(|x| decimal(&space.near(x), 12)).join(", ");
            ensure!(definite, rule, "second derivatives {}: not shown to be concave", shown());
        }
        let value = combine(&patch.value(point), self.c);
        let slopes = patch.slopes(point).map(|weights| combine(&weights, self.c));
        for corner in patch.corners() {
            let rises = [0, 1].map(|i| slopes[i].scale(&(&corner[i] - &point[i])));
            let plane = &(&value + &rises[0]) + &rises[1];
            let name = format_args!("the plane at ({}, {})", corner[0], corner[1]);
            space.at_most(&plane, self.bound, rule, name)?;
        }
        Ok(())
    }

    /// Each quarter in its way.
    fn split(self, quarters: &[By; 4], splits: usize) -> Outcome<()> {
        let rule = Rule::CellSplit;
        ensure!(splits < SPLITS, rule, "more than {SPLITS} splits inside each other");
        for (letter, by) in quarters.iter().enumerate() {
            let weights = self.patch().restricted(letter);
            let c: Vec<_> = weights.iter().map(|weights| combine(weights, self.c)).collect();
            let inner = |fault: Rejection| {
                Rejection::new(fault.rule, format!("quarter {letter}: {}", fault.why))
            };
            Goal { c: &c, ..self }.check(by, splits + 1).map_err(inner)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cosine::rational_beta;
    use crate::file::{Number, Weights};
    use crate::polynomial::Beta;

    /// The coefficients of `x0 + a v + b w + p v^2 + 2 h v w + r w^2`, raised to degree 4.
    fn quartic([x0, a, b, p, h, r]: [i64; 6]) -> Vec<Polynomial> {
        let blossom = |j: usize, k: usize| {
            let (j, k) = (j as i64, k as i64);
            let second = p * j * (j - 1) + 2 * h * j * k + r * k * (k - 1);
            ratio(x0, 1) + ratio(a * j + b * k, 4) + ratio(second, 12)
        };
        exponents(4).into_iter().map(|[_, j, k]| Polynomial::constant(&blossom(j, k))).collect()
    }

    fn shows(c: &[Polynomial], bound: BigRational, by: &By) -> bool {
        let space = Space::of(6, Beta::exact(&rational_beta(Weights::Warren, 6).unwrap()));
        let over_q = |x: &Polynomial| &space.q * x;
        let c: Vec<_> = c.iter().map(over_q).collect();
        check(&space, &c, &space.q.scale(&bound), by, 0).is_ok()
    }

    #[test]
    fn a_concave_quadratic_with_its_maximum_inside() {
        // 2v + 2w - 3v^2 - 3w^2 - 2vw has the maximum 1/2 at (1/4, 1/4).
        let c = quartic([0, 2, 2, -3, -1, -3]);
        let by = |v, w| By::Concave(Name::Concave, Number(v), Number(w));
        assert!(shows(&c, ratio(1, 2), &by(ratio(1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2) - ratio(1, 1_000_000), &by(ratio(1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &by(ratio(1, 5), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &by(ratio(-1, 4), ratio(1, 4))));
        assert!(!shows(&c, ratio(1, 2), &By::Alone(Name::Hull)));
        // A saddle, and a valley, stay below their bound but are not concave.
        assert!(!shows(
            &quartic([0, 2, 2, -3, -4, -3]),
            ratio(9, 1),
            &by(ratio(1, 4), ratio(1, 4))
        ));
        assert!(!shows(&quartic([0, 0, 0, 1, 0, -1]), ratio(9, 1), &by(ratio(1, 4), ratio(1, 4))));
    }

    #[test]
    fn quarters_have_the_values_of_the_whole() {
        // No symmetry, degree 4, and a polynomial in beta as one coefficient.
        let mut c: Vec<_> =
            (1..16).map(|i| Polynomial::constant(&ratio(i * i * i % 17 - 8, i))).collect();
        c[7] = Polynomial::new(vec![3.into(), (-2).into()], 5.into());
        let value =
            |c: &[Polynomial], v: &BigRational, w: &BigRational| combine(&bernstein(4, v, w), c);
        for letter in 0..4 {
            let quarter = restricted(&c, letter);
            for [_, j, k] in exponents(4) {
                let (v, w) = (ratio(j as i64, 4), ratio(k as i64, 4));
                let [x, y] = Triangle::of(&[letter]).point(&v, &w);
                let rest = &value(&quarter, &v, &w) - &value(&c, &x, &y);
                assert!(rest.is_zero(), "letter {letter}, node {j} {k}");
            }
        }
    }

    #[test]
    fn a_maximum_that_only_quarters_show() {
        // The maximum is 1/2 at (1/4, 1/4); the largest coefficient 5/6, over quarter 0 it is 7/12.
        let c = quartic([0, 2, 2, -3, -1, -3]);
        let split = |by: fn() -> By| By::Split(Name::Split, Box::new([by(), by(), by(), by()]));
        let hull = || By::Alone(Name::Hull);
        assert!(!shows(&c, ratio(3, 5), &hull()));
        assert!(shows(&c, ratio(3, 5), &split(hull)));
        assert!(!shows(&c, ratio(1, 2) - ratio(1, 1_000_000), &split(hull)));
        assert!(!shows(&c, ratio(9, 1), &split(|| By::Alone(Name::Regular))));
        assert!(!shows(&c, ratio(9, 1), &split(|| By::Alone(Name::Split))));
    }

    #[test]
    fn an_edge_with_its_maximum_inside() {
        // On each edge in turn 4 s (1 - s), less 9 r away from it: the maximum is 1 at s = 1/2.
        let edges = [
            quartic([-9, 9 + 4, 9, -4, 0, 0]), // v + w = 1: 4v - 4v^2 on it, v = 1 - s
            quartic([0, -9, 4, 0, 0, -4]),     // v = 0
            quartic([0, 4, -9, -4, 0, 0]),     // w = 0
        ];
        for (e, c) in edges.iter().enumerate() {
            let by = |e, s| By::Edge(Name::Edge, e, Number(s));
            assert!(shows(c, ratio(1, 1), &by(e, ratio(1, 2))), "edge {e}");
            assert!(!shows(c, ratio(1, 1), &by(e, ratio(1, 3))));
            assert!(!shows(c, ratio(1, 1), &by(e, ratio(3, 2))));
            assert!(!shows(c, ratio(1, 1), &by((e + 1) % 3, ratio(1, 2))));
            assert!(!shows(c, ratio(1, 1), &by(3, ratio(1, 2))));
            assert!(!shows(c, ratio(999, 1000), &by(e, ratio(1, 2))));
            assert!(!shows(c, ratio(1, 1), &By::Alone(Name::Hull)));
        }
        // An asymmetric one tells the direction: s (1 - s) (2 + ..): f = 3s - 2s^2 - .., its maximum at s = 3/4.
        let c = quartic([0, 3, -9, -2, 0, 0]);
        assert!(shows(&c, ratio(9, 8), &By::Edge(Name::Edge, 2, Number(ratio(3, 4)))));
        assert!(!shows(&c, ratio(9, 8), &By::Edge(Name::Edge, 2, Number(ratio(1, 4)))));
    }
}
