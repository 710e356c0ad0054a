//! Containment: whatever an interval operation is given, the exact result lies in what it returns.
//!
//! Every expectation is computed in exact rationals. Operations on single intervals must also be
//! the tightest there are, so that returning the whole line doesn't pass.

use std::cmp::Ordering;

use num_traits::{One, Signed, Zero};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use subcert::scalar::{Decide, Field, Interval, Rational, Ring, environment, float};

const SEED: u64 = 0x5eed_0001;

fn config(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(SEED),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

fn exact(x: f64) -> Rational {
    Rational::from_float(x).expect("finite")
}

/// Floats of every kind: moderate, huge, tiny, subnormal, dyadic, zero; of both signs.
fn any_float() -> impl Strategy<Value = f64> {
    let magnitude = prop_oneof![
        4 => 0.0..4.0f64,
        2 => (-64i32..64, 1u32..64).prop_map(|(e, k)| f64::from(k) * 2f64.powi(e)),
        1 => (0.0..1.7f64).prop_map(|x| x * 1e300),
        1 => (0.0..1.7f64).prop_map(|x| x * 1e308),
        1 => (0.0..1.7f64).prop_map(|x| x * 1e-300),
        1 => (0u64..1 << 52).prop_map(f64::from_bits),
        1 => (0u64..9).prop_map(f64::from_bits),
        1 => Just(0.0f64),
        1 => Just(1.0f64),
    ];
    (magnitude, any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}

/// An interval with a rational number in it: an end, the middle, or anything between.
fn interval_and_member() -> impl Strategy<Value = (Interval, Rational)> {
    let ends = prop_oneof![
        3 => (any_float(), any_float()),
        1 => any_float().prop_map(|x| (x, x)),
        1 => (any_float(), 0u64..5).prop_map(|(x, k)| {
            let mut y = x;
            (0..k).for_each(|_| y = y.next_up());
            (x, y)
        }),
    ];
    (ends, 0i64..=12).prop_map(|((a, b), twelfths)| {
        let (inf, sup) = (exact(a.min(b)), exact(a.max(b)));
        let member = &inf + (&sup - &inf) * Rational::ratio(twelfths, 12);
        (Interval::new(a.min(b), a.max(b)), member)
    })
}

/// The tightest interval around a set of rationals.
fn tightest(values: &[Rational]) -> Interval {
    let least = values.iter().min().expect("not empty");
    let greatest = values.iter().max().expect("not empty");
    Interval::new(float::round_down(least), float::round_up(greatest))
}

/// The tightest result of a function that takes its extremes at the corners.
fn at_corners(x: Interval, y: Interval, f: impl Fn(&Rational, &Rational) -> Rational) -> Interval {
    let corners = [
        (x.inf(), y.inf()),
        (x.inf(), y.sup()),
        (x.sup(), y.inf()),
        (x.sup(), y.sup()),
    ];
    tightest(&corners.map(|(a, b)| f(&exact(a), &exact(b))))
}

macro_rules! prop_contains {
    ($interval:expr, $value:expr) => {{
        let (interval, value): (Interval, Rational) = ($interval, $value);
        prop_assert!(
            interval.contains_rational(&value),
            "{} = {} does not contain {} = {:e}",
            stringify!($interval),
            interval,
            stringify!($value),
            float::round_to_nearest(&value)
        );
    }};
}

proptest! {
    #![proptest_config(config(4000))]

    #[test]
    fn sums_products_and_quotients((x, a) in interval_and_member(), (y, b) in interval_and_member()) {
        prop_contains!(x + y, &a + &b);
        prop_contains!(x - y, &a - &b);
        prop_contains!(x * y, &a * &b);
        prop_contains!(-x, -&a);
        prop_contains!(x.max(y), a.clone().max(b.clone()));
        prop_contains!(x.min(y), a.clone().min(b.clone()));
        prop_contains!(x.hull(y), a.clone());
        prop_contains!(x.hull(y), b.clone());
        prop_assert_eq!(x + y, at_corners(x, y, |a, b| a + b));
        prop_assert_eq!(x - y, at_corners(x, y, |a, b| a - b));
        prop_assert_eq!(x * y, at_corners(x, y, |a, b| a * b));
        if y.contains(0.0) {
            prop_assert_eq!(x / y, Interval::ENTIRE);
        } else {
            prop_contains!(x / y, &a / &b);
            prop_assert_eq!(x / y, at_corners(x, y, |a, b| a / b));
        }
        let mut z = x;
        z += y;
        z *= &y;
        z -= x;
        prop_contains!(z, (&a + &b) * &b - &a);
    }

    #[test]
    fn functions_of_one_interval((x, a) in interval_and_member()) {
        prop_contains!(x.sqr(), &a * &a);
        prop_assert!(x.sqr().inf() >= 0.0);
        prop_contains!(x.abs(), a.abs());
        let wid = exact(x.sup()) - exact(x.inf());
        prop_assert_eq!(x.wid(), float::round_up(&wid));
        prop_assert!(x.contains(x.mid()) && x.contains(x.inf()) && x.contains(x.sup()));
        prop_assert_eq!(x.mag(), x.inf().abs().max(x.sup().abs()));
        prop_assert!(x.inf() != 0.0 || x.inf().is_sign_positive());
        prop_assert!(x.sup() != 0.0 || x.sup().is_sign_positive());
        match x.sqrt() {
            None => prop_assert!(x.inf() < 0.0),
            Some(root) => {
                prop_assert!(exact(root.inf()).pow(2) <= exact(x.inf()));
                prop_assert!(exact(root.sup()).pow(2) >= exact(x.sup()));
                prop_assert!(exact(root.inf().next_up()).pow(2) > exact(x.inf()));
                prop_assert!(root.sup() == 0.0 || exact(root.sup().next_down()).pow(2) < exact(x.sup()));
            }
        }
    }

    #[test]
    fn orders_are_decided_only_when_certain((x, a) in interval_and_member(), (y, b) in interval_and_member()) {
        match x.decide(&y) {
            Some(order) => prop_assert_eq!(order, a.cmp(&b)),
            None => prop_assert!(x.intersection(y).is_some()),
        }
        match x.intersection(y) {
            Some(common) => prop_assert!(!(x.contains_rational(&b) && y.contains_rational(&b)) || common.contains_rational(&b)),
            None => prop_assert_ne!(&a, &b),
        }
    }

    #[test]
    fn rationals_are_enclosed_by_neighbours(
        p in any::<i128>(), q in 1i128.., (shift_up, shift_down) in (0u32..1200, 0u32..1200), bits in (0u32..127, 0u32..126),
    ) {
        let x = Rational::new((p >> bits.0).into(), (q >> bits.1).max(1).into());
        let x = x * Rational::new(float_power(shift_up), float_power(shift_down));
        let (down, up, near) = (float::round_down(&x), float::round_up(&x), float::round_to_nearest(&x));
        prop_contains!(Interval::from_rational(&x), x.clone());
        if down.is_finite() && up.is_finite() {
            prop_assert!(exact(down) <= x && x <= exact(up));
            prop_assert!(down == up || down.next_up() == up);
            prop_assert!((exact(near) - &x).abs() <= (exact(down) - &x).abs().min((exact(up) - &x).abs()));
        } else {
            prop_assert!(x.abs() > exact(f64::MAX));
            prop_assert!(down == f64::MAX || up == f64::MIN);
        }
    }

    #[test]
    fn an_f64_is_its_own_enclosure(x in any_float()) {
        prop_assert_eq!(Interval::from_rational(&exact(x)), Interval::point(x));
        prop_assert_eq!(float::round_to_nearest(&exact(x)), x);
    }

    #[test]
    fn integers_and_ratios(p in any::<i64>(), q in any::<i64>(), drop in (0u32..63, 0u32..63)) {
        let (p, q) = (p >> drop.0, (q >> drop.1).max(1));
        let k = <Rational as Ring>::from_integer(p);
        prop_assert_eq!(<Interval as Ring>::from_integer(p), Interval::from_rational(&k));
        prop_contains!(Interval::ratio(p, q), Rational::ratio(p, q));
        prop_assert!(Interval::ratio(p, q).wid() <= 4.0 * f64::EPSILON * Interval::ratio(p, q).mag());
        if p.abs() < 1 << 53 && q < 1 << 53 {
            prop_assert_eq!(Interval::ratio(p, q), Interval::from_rational(&Rational::ratio(p, q)));
        }
        prop_assert_eq!(f64::ratio(p, q), float::round_to_nearest(&Rational::ratio(p, q)));
    }

    #[test]
    fn square_root_bounds(x in any_float()) {
        let x = x.abs();
        let (lower, upper) = (float::lower_sqrt(x), float::upper_sqrt(x));
        prop_assert!(exact(lower).pow(2) <= exact(x) && exact(x) <= exact(upper).pow(2));
        prop_assert!(upper <= lower.next_up().next_up().next_up());
        prop_assert!(x < 1e-280 || upper <= lower.next_up());
    }
}

fn float_power(bits: u32) -> num_bigint::BigInt {
    num_bigint::BigInt::one() << bits
}

/// One step of a chain: which operation, and a small rational.
fn step() -> impl Strategy<Value = (u8, i64, i64)> {
    (0u8..6, -40i64..40, 1i64..30)
}

proptest! {
    #![proptest_config(config(300))]

    #[test]
    fn long_expressions(start in any_float(), steps in prop::collection::vec(step(), 1..80)) {
        let mut value = exact(start);
        let mut enclosure = Interval::point(start);
        let mut squares = 0;
        for (operation, p, q) in steps {
            let (number, interval) = (Rational::ratio(p, q), Interval::ratio(p, q));
            match operation {
                0 => (value += &number, enclosure += interval),
                1 => (value -= &number, enclosure -= interval),
                2 => (value = number - value, enclosure = interval - enclosure),
                3 => (value *= &number, enclosure *= interval),
                4 if !number.is_zero() => (value /= &number, enclosure /= interval),
                5 if squares < 4 => {
                    squares += 1;
                    (value = &value * &value, enclosure = enclosure.sqr())
                }
                _ => ((), ()),
            };
            prop_contains!(enclosure, value.clone());
        }
    }
}

#[test]
fn nothing_is_decided_about_what_is_unknown() {
    let one = Interval::one();
    let unknown = [
        Interval::point(f64::NAN),
        Interval::new(f64::NAN, 1.0),
        Interval::new(1.0, f64::NAN),
        Interval::new(2.0, 1.0),
        Interval::point(f64::INFINITY),
        Interval::point(f64::NEG_INFINITY),
        one / Interval::zero(),
        one / Interval::new(-1.0, 1.0),
        one / Interval::new(0.0, 1.0),
    ];
    for x in unknown {
        assert_eq!(x, Interval::ENTIRE);
        assert_eq!(x.decide(&x), None);
        assert_eq!(x.decide(&one), None);
        assert_eq!(one.decide(&x), None);
        assert_eq!(x.hull(one), Interval::ENTIRE);
    }
    let half_line = Interval::new(2.0, f64::INFINITY);
    assert_eq!(half_line.decide(&one), None);
    assert_eq!(one.decide(&half_line), None);
    let overflow = Interval::point(1e300) * Interval::point(1e300);
    assert_eq!((overflow.inf(), overflow.sup()), (f64::MAX, f64::INFINITY));
    assert_eq!(overflow.decide(&one), None);
    assert_eq!(Interval::new(-1.0, 2.0).sqrt(), None);
    assert_eq!(
        Interval::point(1.0).intersection(Interval::point(2.0)),
        None
    );
    assert_eq!(one.decide(&Interval::one()), Some(Ordering::Equal));
}

#[test]
fn zero_has_one_sign() {
    for zero in [Interval::point(-0.0), Interval::zero(), -Interval::zero()] {
        assert!(zero.is_zero());
        for end in [
            zero.inf(),
            zero.sup(),
            zero.mig(),
            zero.mag(),
            zero.mid(),
            zero.wid(),
        ] {
            assert!(end == 0.0 && end.is_sign_positive());
        }
    }
}

#[test]
fn ties_and_limits_of_the_rounding_to_f64() {
    let largest = exact(f64::MAX);
    let half_step = exact(2f64.powi(970));
    assert_eq!(
        float::round_to_nearest(&(&largest + &half_step)),
        f64::INFINITY
    );
    let below = &largest + &half_step - Rational::one();
    assert_eq!(float::round_to_nearest(&below), f64::MAX);
    assert_eq!(
        (float::round_down(&below), float::round_up(&below)),
        (f64::MAX, f64::INFINITY)
    );
    assert_eq!(
        (float::round_down(&-&below), float::round_up(&-&below)),
        (f64::NEG_INFINITY, f64::MIN)
    );
    let least = exact(f64::from_bits(1));
    let half = &least / <Rational as Ring>::from_integer(2);
    assert_eq!(float::round_to_nearest(&half), 0.0);
    assert_eq!(
        float::round_to_nearest(&(&half * Rational::ratio(3, 1))),
        f64::from_bits(2)
    );
    assert_eq!(
        (float::round_down(&half), float::round_up(&half)),
        (0.0, f64::from_bits(1))
    );
    assert!(float::round_up(&-half).is_sign_positive());
}

#[test]
fn gamma_is_an_upper_bound() {
    for k in (0..40).chain([1000, 1 << 20, u32::MAX]) {
        let ku = Rational::new(k.into(), float_power(53));
        let bound = &ku / (Rational::one() - &ku);
        assert!(exact(float::gamma(k)) >= bound);
        assert!(exact(float::gamma(k).next_down().next_down()) <= bound);
    }
}

#[test]
fn the_floating_point_unit_is_as_assumed() {
    assert_eq!(environment::verify_floating_point(), Ok(()));
}
