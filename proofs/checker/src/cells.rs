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

    /// At the distance r from the edge c is at most a mean of f on the edge, with the weight `(1 - r)^degree`, and the other
    /// coefficients; a concave f lies below its tangents.
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
        let [value, slope] = [0, 1].map(|order| combine(&on_line(patch.degree(), s, order), &f));
        for end in [0, 1] {
            let tangent = &value + &slope.scale(&(ratio(end, 1) - s));
            space.at_most(&tangent, self.bound, rule, format_args!("the tangent at {end}"))?;
        }
        Ok(())
    }

    /// Second derivatives that are means of negative semidefinite matrices: c lies below its tangent plane, which is highest
    /// at a corner.
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
    use crate::catmull_clark::CatmullClark;
    use crate::claim::Norm;
    use crate::doo_sabin::DooSabin;
    use crate::loop_scheme::Loop;

    /// The triangle, and the squares of degree 3 and 2.
    fn spaces() -> [Space; 3] {
        let clark = Box::new(CatmullClark(Norm::Second));
        let sabin = Box::new(DooSabin([1, 0, -1, 0].map(Scalar::integer).to_vec()));
        let [zero, one] = [0, 1].map(Scalar::integer);
        [
            Loop::space(6, Ring::RATIONALS, Scalar::constant(&ratio(3, 8))),
            Space::of(clark, 4, Ring::RATIONALS, zero.clone(), one.clone()),
            Space::of(sabin, 4, Ring::RATIONALS, zero, one),
        ]
    }

    fn shows(space: &Space, c: &[Scalar], bound: BigRational, by: &By) -> bool {
        let c: Vec<_> = c.iter().map(|x| space.ring.product(&space.q, x)).collect();
        Goal { space, c: &c, bound: &space.q.scale(&bound) }.check(by, 0).is_ok()
    }

    /// The coefficients of `x0 + a v + b w + p v^2 + 2 h v w + r w^2`, raised to the degree of the patch.
    fn quadratic(space: &Space, [x0, a, b, p, h, r]: [i64; 6]) -> Vec<Scalar> {
        let (patch, square) = (space.patch(), space.patch() != Patch::Triangle);
        let d = patch.degree() as i64;
        let node = |[v, w]: &[BigRational; 2]| {
            let [j, k] = [v, w].map(|x| x * ratio(d, 1));
            let power = |j: &BigRational| j * (j - ratio(1, 1)) / ratio(d * (d - 1), 1);
            let mixed = &j * &k / ratio(if square { d * d } else { d * (d - 1) }, 1);
            let second =
                ratio(p, 1) * power(&j) + ratio(2 * h, 1) * mixed + ratio(r, 1) * power(&k);
            Scalar::constant(&(ratio(x0, 1) + v * ratio(a, 1) + w * ratio(b, 1) + second))
        };
        patch.nodes().iter().map(node).collect()
    }

    #[test]
    fn a_concave_quadratic_with_its_maximum_inside() {
        for space in &spaces() {
            // 2v + 2w - 3v^2 - 3w^2 - 2vw has the maximum 1/2 at (1/4, 1/4).
            let c = quadratic(space, [0, 2, 2, -3, -1, -3]);
            let by = |v, w| By::Concave(Name::Concave, Number(v), Number(w));
            let shows = |c: &[Scalar], bound: BigRational, by: &By| shows(space, c, bound, by);
            assert!(shows(&c, ratio(1, 2), &by(ratio(1, 4), ratio(1, 4))));
            let below = ratio(1, 2) - ratio(1, 1_000_000);
            assert!(!shows(&c, below, &by(ratio(1, 4), ratio(1, 4))));
            assert!(!shows(&c, ratio(1, 2), &by(ratio(1, 5), ratio(1, 4))));
            assert!(!shows(&c, ratio(1, 2), &by(ratio(-1, 4), ratio(1, 4))));
            assert!(!shows(&c, ratio(9, 1), &by(ratio(1, 4), ratio(5, 4))));
            assert!(!shows(&c, ratio(1, 2), &By::Alone(Name::Hull)));
            // Barely concave, barely not, and a valley, all below their bound.
            let centre = by(ratio(1, 4), ratio(1, 4));
            assert!(shows(&quadratic(space, [0, 2, 2, -4, -4, -4]), ratio(9, 1), &centre));
            assert!(!shows(&quadratic(space, [0, 2, 2, -4, -5, -4]), ratio(9, 1), &centre));
            assert!(!shows(&quadratic(space, [0, 0, 0, 1, 0, -1]), ratio(9, 1), &centre));
        }
    }

    #[test]
    fn quarters_have_the_values_of_the_whole() {
        for space in &spaces() {
            // No symmetry, full degree, and a scalar with two terms as one coefficient.
            let patch = space.patch();
            let nodes = patch.nodes();
            let rough = (1..=nodes.len() as i64).map(|i| ratio(i * i * i % 17 - 8, i));
            let mut c: Vec<_> = rough.map(|x| Scalar::constant(&x)).collect();
            c[7] = Scalar::new(vec![3.into(), (-2).into()], 5.into());
            for letter in 0..4 {
                let rows = patch.restricted(letter);
                let quarter: Vec<_> = rows.iter().map(|weights| combine(weights, &c)).collect();
                for node in &nodes {
                    let place = patch.quarters()[letter].point(node);
                    let value = combine(&patch.value(node), &quarter);
                    let rest = &value - &combine(&patch.value(&place), &c);
                    assert!(rest.is_zero(), "letter {letter}, node {node:?}");
                }
            }
        }
    }

    #[test]
    fn a_maximum_that_only_quarters_show() {
        // The maximum is 1/2 at (1/4, 1/4); the largest coefficient 5/6, over quarter 0 it is 7/12.
        let space = &spaces()[0];
        let c = quadratic(space, [0, 2, 2, -3, -1, -3]);
        let split = |by: fn() -> By| By::Split(Name::Split, Box::new([by(), by(), by(), by()]));
        let hull = || By::Alone(Name::Hull);
        assert!(!shows(space, &c, ratio(3, 5), &hull()));
        assert!(shows(space, &c, ratio(3, 5), &split(hull)));
        assert!(!shows(space, &c, ratio(1, 2) - ratio(1, 1_000_000), &split(hull)));
        assert!(!shows(space, &c, ratio(9, 1), &split(|| By::Alone(Name::Regular))));
        assert!(!shows(space, &c, ratio(9, 1), &split(|| By::Alone(Name::Split))));
    }

    #[test]
    fn an_edge_with_its_maximum_inside() {
        // On each edge in turn f = 3s - 2s^2, less 9 r away from it: the maximum is 9/8 at s = 3/4.
        let triangle = [
            [-9 + 1, 9 + 1, 9, -2, 0, 0], // v + w = 1, v = 1 - s: 1 + v - 2v^2
            [0, -9, 3, 0, 0, -2],         // v = 0
            [0, 3, -9, -2, 0, 0],         // w = 0
        ];
        let square = [
            [0, 3, -9, -2, 0, 0],    // v = 0
            [-9, 9, 3, 0, 0, -2],    // u = 1
            [1 - 9, 1, 9, -2, 0, 0], // v = 1, u = 1 - s
            [1, -9, 1, 0, 0, -2],    // u = 0, v = 1 - s
        ];
        let by = |e, p, q| By::Edge(Name::Edge, e, Number(ratio(p, q)));
        for (space, edges) in spaces().iter().zip([&triangle[..], &square, &square]) {
            let shows = |c: &[Scalar], bound: BigRational, by: &By| shows(space, c, bound, by);
            for (e, &polynomial) in edges.iter().enumerate() {
                let c = quadratic(space, polynomial);
                assert!(shows(&c, ratio(9, 8), &by(e, 3, 4)), "{:?} edge {e}", space.patch());
                assert!(!shows(&c, ratio(9, 8), &by(e, 1, 4)));
                assert!(!shows(&c, ratio(9, 8), &by(e, 5, 4)));
                assert!(!shows(&c, ratio(9, 8), &by((e + 1) % edges.len(), 3, 4)));
                assert!(!shows(&c, ratio(9, 8), &by(edges.len(), 3, 4)));
                assert!(!shows(&c, ratio(1124, 1000), &by(e, 3, 4)));
                assert!(!shows(&c, ratio(9, 8), &By::Alone(Name::Hull)));
            }
        }
    }
}
