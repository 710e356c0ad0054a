//! The spectrum of the two-ring: eigenvectors, duals, Jordan blocks.

use nalgebra::DMatrix;
use num_traits::{One, Zero};
use subcert::scalar::{Cyclotomic, Field, Rational};
use subcert::scheme::LoopWeights;
use subcert::spectrum::loop_modes::{Family, loop_modes};
use subcert::spectrum::{Represent, Rules, Spectrum, TwoRing};

const LOOP: [Rules; 2] = [
    Rules::Loop(LoopWeights::Original),
    Rules::Loop(LoopWeights::Warren),
];

/// A v = λ v + chain, at every point.
fn check_eigenvectors<S: Represent>(spectrum: &Spectrum<S>) {
    for member in spectrum.members() {
        let net = spectrum.net(member);
        let (lambda, chain) = (spectrum.eigenvalue(member), spectrum.chain(member));
        let image = spectrum.ring().refine(&net);
        for ((a, v), c) in image.iter().zip(&net).zip(&chain) {
            assert_eq!(*a, v.clone() * &lambda + c, "{member:?}");
        }
    }
}

/// The left vectors are 1 on their own member and 0 on the others: both sets are bases.
fn check_duality<S: Represent>(spectrum: &Spectrum<S>) {
    let members = spectrum.members();
    assert_eq!(members.len(), spectrum.ring().len());
    let nets: Vec<Vec<S>> = members.iter().map(|&m| spectrum.net(m)).collect();
    for &member in &members {
        let left = spectrum.left(member);
        for (other, net) in members.iter().zip(&nets) {
            let value = (left.iter().zip(net)).fold(S::zero(), |s, (a, b)| s + a.clone() * b);
            let expected = if member == *other {
                S::one()
            } else {
                S::zero()
            };
            assert_eq!(value, expected, "{member:?} of {other:?}");
        }
    }
}

#[test]
fn right_and_left_eigenvectors_of_loop_are_exact() {
    for n in [3, 4, 5, 6, 7, 8, 12] {
        for rules in LOOP {
            let spectrum = Spectrum::<Cyclotomic>::new(rules, n).unwrap();
            check_eigenvectors(&spectrum);
            check_duality(&spectrum);
        }
    }
    for n in [15, 24, 50] {
        check_eigenvectors(&Spectrum::<Cyclotomic>::new(LOOP[0], n).unwrap());
    }
}

#[test]
fn a_net_is_the_sum_of_its_parts() {
    for n in [3, 4, 6] {
        for rules in LOOP {
            let spectrum = Spectrum::<Rational>::new(rules, n).unwrap();
            let count = spectrum.ring().len() as i64;
            let net: Vec<Rational> = (0..count)
                .map(|i| Rational::ratio(i * i % 11 - 4, 3))
                .collect();
            let coefficients = spectrum.coefficients(&net);
            assert_eq!(spectrum.compose(&coefficients), net);
            for (member, coefficient) in spectrum.members().into_iter().zip(coefficients) {
                let left = spectrum.left(member);
                let value = (left.iter().zip(&net)).fold(Rational::zero(), |s, (a, b)| s + a * b);
                assert_eq!(value, coefficient);
            }
        }
    }
}

/// MATH.md section 5: the Jordan block at n = 3 and nowhere else, found by computing.
#[test]
fn loop_is_defective_at_valence_three_only() {
    for weights in [LoopWeights::Original, LoopWeights::Warren] {
        for n in 3..=50 {
            let (_, modes) = loop_modes::<Cyclotomic>(weights, n).unwrap();
            let generalised: Vec<_> = (modes.iter())
                .filter(|(mode, _)| mode.generalised.is_some())
                .map(|(mode, _)| (mode.family, mode.frequency))
                .collect();
            let expected: &[_] = if n == 3 { &[(Family::Ring, 0)] } else { &[] };
            assert_eq!(generalised, expected, "n = {n}");
        }
    }
}

/// Dimensions of the kernels of powers of A - λ by an independent exact elimination.
#[test]
fn the_jordan_block_has_size_two() {
    let lambda = Rational::ratio(1, 16);
    for (n, nullities) in [(3, [3, 4, 4]), (4, [4, 4, 4]), (6, [6, 6, 6])] {
        for rules in LOOP {
            let matrix = TwoRing::<Rational>::new(rules, n).unwrap().matrix();
            let size = matrix.nrows();
            let shifted = &matrix - DMatrix::from_diagonal_element(size, size, lambda.clone());
            let mut power = shifted.clone();
            for nullity in nullities {
                assert_eq!(
                    size - subcert::linalg::rank(&power),
                    nullity,
                    "{rules:?} n = {n}"
                );
                power = &power * &shifted;
            }
        }
    }
}

/// The normal form: what a mode says is what its nets have.
#[test]
fn amplitudes_are_those_of_the_nets() {
    for n in [3, 4, 5, 8, 9] {
        let (spectrum, modes) = loop_modes::<Cyclotomic>(LoopWeights::Original, n).unwrap();
        assert_eq!(
            modes.iter().map(|(_, m)| m.len()).sum::<usize>(),
            spectrum.ring().len()
        );
        for (mode, members) in modes.iter().filter(|(m, _)| m.family == Family::Ring) {
            let net = spectrum.net(members[0]);
            let k = mode.frequency;
            let half = Cyclotomic::ratio(1, 2);
            let cosine = |j: u32| Cyclotomic::two_cos(k * j % n, n).unwrap() * &half;
            assert_eq!(net[0], mode.center);
            assert!(mode.ring.is_one());
            for j in 0..n {
                let at = |kind: u32| &net[(1 + kind * n + j) as usize];
                assert_eq!(*at(0), mode.ring.clone() * &cosine(j));
                assert_eq!(*at(1), mode.between.clone() * &(cosine(j) + &cosine(j + 1)));
                assert_eq!(*at(2), mode.ray.clone() * &cosine(j));
            }
        }
    }
}

/// The printed formulas of MATH.md section 5 and [`Represent`] in floats: a second way to each.
#[test]
fn eigenvalues_of_loop_have_the_known_form() {
    for n in 3..=50 {
        let (_, modes) = loop_modes::<f64>(LoopWeights::Warren, n).unwrap();
        for (mode, _) in modes {
            let angle = 2.0 * std::f64::consts::PI * f64::from(mode.frequency) / f64::from(n);
            let expected = match (mode.family, mode.frequency) {
                (Family::Constant, _) => 1.0,
                (Family::Ring, 0) if n == 3 => 1.0 / 16.0,
                (Family::Ring, 0) => 1.0 / 4.0,
                (Family::Ring, _) => 0.375 + angle.cos() / 4.0,
                (Family::Between, _) => 0.125,
                (Family::Ray, _) => 0.0625,
            };
            assert!((mode.eigenvalue - expected).abs() < 1e-15);
        }
    }
}
