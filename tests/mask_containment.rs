//! Every mask, in three arithmetics: the exact value lies in the interval (decided exactly), the
//! interval is a few units wide, the `f64` is near it; and exact masks are convex combinations.

use num_traits::{One, Zero};
use subcert::scalar::{Cyclotomic, Decide, Field, Interval, Ring};
use subcert::scheme::{LoopWeights, boundary, catmull_clark, doo_sabin, loop_scheme};

/// Widest interval allowed, in units in the last place of its larger end: the longest mask, Loop's
/// `original` limit mask, takes a cosine and eleven operations, one unit each.
const WIDEST: f64 = 24.0;
/// Farthest `f64` allowed from the interval, in the same units.
const FARTHEST: f64 = 4.0;

fn unit_in_last_place(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

fn check(name: &str, exact: &Cyclotomic, interval: Interval, float: f64) {
    assert!(
        exact.lies_in(interval),
        "{name}: {exact} = {} not in {interval}",
        exact.enclose()
    );
    let unit = unit_in_last_place(interval.mag());
    assert!(
        interval.wid() <= WIDEST * unit,
        "{name}: {interval} is too wide"
    );
    let outside = (interval.inf() - float).max(float - interval.sup());
    assert!(
        outside <= FARTHEST * unit,
        "{name}: {float:?} is far from {interval}"
    );
}

/// Checks each entry, that none is negative, and that the entries times their multiplicities sum
/// to one.
fn check_mask(name: &str, exact: &[(u32, Cyclotomic)], interval: &[Interval], float: &[f64]) {
    assert!(exact.len() == interval.len() && exact.len() == float.len());
    let mut sum = Cyclotomic::zero();
    for (k, (multiplicity, value)) in exact.iter().enumerate() {
        check(&format!("{name}, entry {k}"), value, interval[k], float[k]);
        assert!(
            value
                .decide(&Cyclotomic::zero())
                .is_some_and(|order| order.is_ge()),
            "{name}"
        );
        sum += value.clone() * &Cyclotomic::from_integer(i64::from(*multiplicity));
    }
    assert_eq!(sum, Cyclotomic::one(), "{name}");
}

macro_rules! check_star {
    ($name:expr, $n:expr, $mask:expr) => {{
        fn entries<S>(mask: subcert::scheme::StarMask<S>) -> [S; 3] {
            [mask.center, mask.edge, mask.face]
        }
        let exact = entries::<Cyclotomic>($mask);
        let exact: Vec<_> = [1, $n, $n].into_iter().zip(exact).collect();
        check_mask(
            &$name,
            &exact,
            &entries::<Interval>($mask),
            &entries::<f64>($mask),
        );
    }};
}

#[test]
fn loop_masks() {
    for n in 3..=64 {
        for weights in [LoopWeights::Original, LoopWeights::Warren] {
            let vertex = format!("Loop {weights} vertex mask, n = {n}");
            check_star!(vertex, n, loop_scheme::vertex_mask(weights, n).unwrap());
            let limit = format!("Loop {weights} limit mask, n = {n}");
            check_star!(limit, n, loop_scheme::limit_mask(weights, n).unwrap());
        }
    }
}

#[test]
fn catmull_clark_masks() {
    for n in 2..=64 {
        check_star!(
            format!("Catmull-Clark vertex, {n}"),
            n,
            catmull_clark::vertex_mask(n)
        );
        check_star!(
            format!("Catmull-Clark limit, {n}"),
            n,
            catmull_clark::limit_mask(n)
        );
        let polygons = format!("Catmull-Clark limit on polygons, {n}");
        check_star!(polygons, n, catmull_clark::limit_mask_polygons(n));
    }
}

#[test]
fn doo_sabin_masks() {
    for n in 3..=40 {
        let exact = doo_sabin::corner_mask::<Cyclotomic>(n).unwrap();
        let exact: Vec<_> = exact.into_iter().map(|x| (1, x)).collect();
        let interval = doo_sabin::corner_mask::<Interval>(n).unwrap();
        let float = doo_sabin::corner_mask::<f64>(n).unwrap();
        check_mask(&format!("Doo-Sabin, {n}"), &exact, &interval, &float);
    }
}

/// The weights of a rule, by applying it to the unit nets.
macro_rules! check_rule {
    ($name:expr, $rule:path, [$($parameter:ident),+]) => {{
        const COUNT: usize = [$(stringify!($parameter)),+].len();
        fn weights<S: Field>() -> Vec<S> {
            let weight = |k: usize| {
                let mut net = (0..COUNT).map(|i| S::from_integer(i64::from(i == k)));
                $(let $parameter = net.next().unwrap();)+
                $rule($(&$parameter),+)
            };
            (0..COUNT).map(weight).collect()
        }
        let exact: Vec<_> = weights::<Cyclotomic>().into_iter().map(|x| (1, x)).collect();
        check_mask($name, &exact, &weights::<Interval>(), &weights::<f64>());
    }};
}

#[test]
fn edge_face_and_boundary_rules() {
    check_rule!("Loop edge", loop_scheme::edge_point::<S, S>, [a, b, c, d]);
    check_rule!(
        "Catmull-Clark edge",
        catmull_clark::edge_point::<S, S>,
        [a, b, f, g]
    );
    check_rule!(
        "Catmull-Clark quad",
        catmull_clark::quad_point::<S, S>,
        [a, b, c, d]
    );
    check_rule!("boundary vertex", boundary::vertex_point::<S, S>, [p, a, b]);
    check_rule!("boundary edge", boundary::edge_point::<S, S>, [a, b]);
    check_rule!("boundary limit", boundary::limit_point::<S, S>, [p, a, b]);
    for m in 3..=40 {
        check(
            "Catmull-Clark face",
            &catmull_clark::face_point::<Cyclotomic, _>(&Cyclotomic::one(), m),
            catmull_clark::face_point::<Interval, _>(&Interval::one(), m),
            catmull_clark::face_point::<f64, _>(&1.0, m),
        );
    }
}

/// MATH.md, section 1: b = 3/16 at n = 3 with both weights, agreement at n = 6.
#[test]
fn known_values() {
    for weights in [LoopWeights::Original, LoopWeights::Warren] {
        let b = |n| {
            loop_scheme::vertex_mask::<Cyclotomic>(weights, n)
                .unwrap()
                .edge
        };
        assert_eq!(b(3), Cyclotomic::ratio(3, 16));
        assert_eq!(b(6), Cyclotomic::ratio(1, 16));
    }
    // n = 4: 5/8 - (3/8)^2 = 31/64.
    let b = loop_scheme::vertex_mask::<Cyclotomic>(LoopWeights::Original, 4)
        .unwrap()
        .edge;
    assert_eq!(b, Cyclotomic::ratio(31, 256));
}
