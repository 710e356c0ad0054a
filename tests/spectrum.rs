//! The spectrum of the two-ring: eigenvectors, duals, Jordan blocks.

use nalgebra::{DMatrix, Schur};
use num_traits::{One, Zero};
use subcert::scalar::{Cyclotomic, Field, Interval, Rational, Ring};
use subcert::scheme::{LoopWeights, catmull_clark, loop_scheme};
use subcert::spectrum::characteristic::{Sign, check};
use subcert::spectrum::loop_modes::{Family, loop_modes};
use subcert::spectrum::table::tabulate;
use subcert::spectrum::{Eigenvalue, Member, Represent, Rules, Spectrum, TwoRing};

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
            if let Some(chain) = &mode.generalised {
                let rest = spectrum.chain(members[0]);
                let rays = &rest[1 + 2 * n as usize..];
                assert!(chain.between.is_zero() && rays.iter().all(|ray| *ray == chain.ray));
            }
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

/// The matrix written out by hand from the masks of MATH.md section 1, in floats.
fn matrix_by_hand(rules: Rules, n: usize) -> DMatrix<f64> {
    let kinds = rules.kinds();
    let size = 1 + kinds * n;
    let mut matrix = DMatrix::zeros(size, size);
    let at = |kind: usize, j: usize| 1 + kind * n + j % n;
    let count = n as f64;
    let mut row = |row: usize, terms: &[(usize, f64)]| {
        for &(column, weight) in terms {
            matrix[(row, column)] += weight;
        }
    };
    for j in 0..n {
        let (before, after) = (j + n - 1, j + 1);
        match rules {
            Rules::Loop(weights) => {
                let (ring, between, ray) = (0, 1, 2);
                let cosine = (2.0 * std::f64::consts::PI / count).cos();
                let sum = match weights {
                    LoopWeights::Original => 0.625 - (0.375 + cosine / 4.0).powi(2),
                    LoopWeights::Warren if n == 3 => 9.0 / 16.0,
                    LoopWeights::Warren => 3.0 / 8.0,
                };
                row(0, &[(0, (1.0 - sum) / count), (at(ring, j), sum / count)]);
                let ends = [(0, 0.375), (at(ring, j), 0.375)];
                row(at(ring, j), &ends);
                row(
                    at(ring, j),
                    &[(at(ring, before), 0.125), (at(ring, after), 0.125)],
                );
                row(
                    at(between, j),
                    &[(at(ring, j), 0.375), (at(ring, after), 0.375)],
                );
                row(at(between, j), &[(0, 0.125), (at(between, j), 0.125)]);
                let around = [0, at(ring, before), at(ring, after)];
                let around =
                    around
                        .into_iter()
                        .chain([at(between, before), at(between, j), at(ray, j)]);
                row(at(ray, j), &[(at(ring, j), 0.625)]);
                row(at(ray, j), &around.map(|i| (i, 0.0625)).collect::<Vec<_>>());
            }
            Rules::CatmullClark => {
                let [edge, face, ray, near, far, corner] = [0, 1, 2, 3, 4, 5];
                let (edge_weight, face_weight) = (1.5 / count / count, 0.25 / count / count);
                row(0, &[(0, (1.0 - 7.0 / 4.0 / count) / count)]);
                row(0, &[(at(edge, j), edge_weight), (at(face, j), face_weight)]);
                // Edge points: 3/8 for the ends, 1/16 for the other corners of both faces.
                let mut edge_point = |to: usize, ends: [usize; 2], others: [usize; 4]| {
                    row(to, &ends.map(|i| (i, 0.375)));
                    row(to, &others.map(|i| (i, 0.0625)));
                };
                let sides = [at(edge, before), at(edge, after)];
                let diagonal = [at(face, before), at(face, j)];
                edge_point(
                    at(edge, j),
                    [0, at(edge, j)],
                    [sides[0], sides[1], diagonal[0], diagonal[1]],
                );
                edge_point(
                    at(near, j),
                    [at(edge, j), at(face, j)],
                    [0, at(edge, after), at(ray, j), at(near, j)],
                );
                edge_point(
                    at(far, j),
                    [at(edge, after), at(face, j)],
                    [0, at(edge, j), at(ray, after), at(far, j)],
                );
                row(
                    at(face, j),
                    &[0, at(edge, j), at(face, j), at(edge, after)].map(|i| (i, 0.25)),
                );
                // Vertex points of valence 4: 9/16, 3/32, 1/64.
                let mut vertex_point =
                    |to: usize, center: usize, edges: [usize; 4], faces: [usize; 4]| {
                        row(to, &[(center, 0.5625)]);
                        row(to, &edges.map(|i| (i, 0.09375)));
                        row(to, &faces.map(|i| (i, 0.015625)));
                    };
                vertex_point(
                    at(ray, j),
                    at(edge, j),
                    [0, at(ray, j), at(face, j), at(face, before)],
                    [
                        at(edge, before),
                        at(edge, after),
                        at(near, j),
                        at(far, before),
                    ],
                );
                vertex_point(
                    at(corner, j),
                    at(face, j),
                    [at(edge, j), at(edge, after), at(near, j), at(far, j)],
                    [0, at(ray, j), at(ray, after), at(corner, j)],
                );
            }
        }
    }
    matrix
}

const ALL: [Rules; 3] = [LOOP[0], LOOP[1], Rules::CatmullClark];

#[test]
fn the_stencils_are_the_masks() {
    for rules in ALL {
        for n in [3, 4, 5, 6, 7, 12] {
            let matrix = TwoRing::<f64>::new(rules, n).unwrap().matrix();
            let expected = matrix_by_hand(rules, n as usize);
            assert!((matrix - expected).amax() < 1e-15, "{rules:?} n = {n}");
        }
    }
}

/// Against the QR algorithm on the whole matrix. A Jordan block of size 2 turns rounding errors into
/// their square root; elsewhere the eigenvalues are semisimple and errors stay small.
#[test]
fn eigenvalues_are_those_of_a_dense_float_decomposition() {
    for rules in ALL {
        let valences: &[u32] = match rules {
            Rules::Loop(_) => &[3, 4, 5, 6, 7, 8, 9, 12, 16, 25],
            Rules::CatmullClark => &[3, 4, 5, 6, 7, 8, 9, 12],
        };
        for row in tabulate(rules, valences) {
            // Shifted by 1: the iteration ends badly near an eigenvalue 0 (Catmull-Clark, n = 3).
            let matrix = matrix_by_hand(rules, row.n as usize);
            let shifted = &matrix + DMatrix::identity(matrix.nrows(), matrix.ncols());
            let schur = Schur::try_new(shifted, 1e-14, 100_000);
            let dense = schur
                .expect("the QR algorithm converges")
                .complex_eigenvalues();
            let mut found: Vec<f64> = dense.iter().map(|z| z.re - 1.0).collect();
            found.sort_by(|a, b| b.total_cmp(a));
            let entries = row.entries.iter();
            let certified =
                entries.flat_map(|e| std::iter::repeat_n(e.enclosure, e.multiplicity as usize));
            let certified: Vec<Interval> = certified.collect();
            assert_eq!(certified.len(), found.len());
            let tolerance = if row.is_defective() { 1e-6 } else { 1e-9 };
            for (interval, value) in certified.iter().zip(found) {
                let near = Interval::new(value - tolerance, value + tolerance);
                assert!(
                    interval.subset(near),
                    "{rules:?} n = {}: {interval} and {value}",
                    row.n
                );
            }
            assert!(dense.iter().all(|z| z.im.abs() < tolerance));
        }
    }
}

/// MATH.md section 5 for Catmull-Clark, by enclosures of the printed formulas.
#[test]
fn eigenvalues_of_catmull_clark_have_the_known_form() {
    for row in tabulate(Rules::CatmullClark, &(3..=50).collect::<Vec<_>>()) {
        let n = row.n;
        let mut expected = vec![Interval::from_integer(1)];
        for sign in [1, -1] {
            let m = i64::from(n);
            let root = Interval::from_integer(5 * m * m - 30 * m + 49)
                .sqrt()
                .unwrap();
            let sum = Interval::from_integer(3 * m - 7) + root * Interval::from_integer(sign);
            expected.push(sum / Interval::from_integer(8 * m));
            for k in 1..=n / 2 {
                let c = Interval::two_cos(k, n).unwrap() * Interval::ratio(1, 2);
                let one = (c + Interval::from_integer(1)).max(Interval::from_integer(0));
                let root = ((c + Interval::from_integer(9)) * one).sqrt().unwrap();
                let sum = Interval::from_integer(5) + c + root * Interval::from_integer(sign);
                expected.push(sum * Interval::ratio(1, 16));
            }
        }
        expected.extend([8, 16, 32, 64].map(|q| Interval::ratio(1, q)));
        for interval in expected {
            let met = row
                .entries
                .iter()
                .any(|e| e.enclosure.intersection(interval).is_some());
            assert!(met, "n = {n}: {interval}");
        }
        assert!(!row.is_defective());
        for pair in row.entries.windows(2) {
            assert!(pair[0].enclosure.inf() > pair[1].enclosure.sup(), "n = {n}");
        }
        // A root that is not given exactly does not lie in Q(2 cos 2π/n).
        for entry in &row.entries {
            if let Eigenvalue::Root(root) = &entry.value {
                assert!(root.irrational_by(n).is_some(), "n = {n}: {}", entry.value);
            }
        }
    }
}

/// Enclosures of eigenvectors: A v - λ v contains 0 and is narrow, and so is the pairing with the left
/// vectors about 0 and 1.
#[test]
fn eigenvectors_of_catmull_clark_are_enclosed() {
    for n in [3, 4, 5, 6, 7, 8, 12, 50] {
        let spectrum = Spectrum::<Interval>::new(Rules::CatmullClark, n).unwrap();
        let members = spectrum.members();
        assert_eq!(members.len(), 1 + 6 * n as usize);
        let nets: Vec<Vec<Interval>> = members.iter().map(|&m| spectrum.net(m)).collect();
        let close = |x: Interval, expected: f64| x.contains(expected) && x.wid() < 1e-5;
        for (&member, net) in members.iter().zip(&nets) {
            let lambda = spectrum.eigenvalue(member);
            for (a, v) in spectrum.ring().refine(net).iter().zip(net) {
                assert!(close(*a - *v * lambda, 0.0), "n = {n}: {member:?}");
            }
        }
        // All pairs at small valences, a sample at large ones.
        for (i, &member) in members
            .iter()
            .enumerate()
            .step_by(if n > 8 { 17 } else { 1 })
        {
            let left = spectrum.left(member);
            for (j, net) in nets.iter().enumerate() {
                let pairing = left.iter().zip(net).map(|(a, b)| *a * *b);
                let pairing = pairing.fold(Interval::from_integer(0), |sum, x| sum + x);
                assert!(
                    close(pairing, if i == j { 1.0 } else { 0.0 }),
                    "n = {n}: {i}, {j}: {pairing}"
                );
            }
        }
    }
}

/// The left eigenvector of 1 is the limit mask of the scheme, which `scheme` states on its own.
#[test]
fn the_left_eigenvector_of_one_is_the_limit_mask() {
    for n in [3, 5, 6, 9] {
        for weights in [LoopWeights::Original, LoopWeights::Warren] {
            let spectrum = Spectrum::<Cyclotomic>::new(Rules::Loop(weights), n).unwrap();
            let mask = loop_scheme::limit_mask::<Cyclotomic>(weights, n).unwrap();
            let mut expected = vec![Cyclotomic::zero(); 1 + 3 * n as usize];
            expected[0] = mask.center;
            expected[1..=n as usize].fill(mask.edge);
            assert_eq!(spectrum.left(Member::Constant), expected);
        }
        let spectrum = Spectrum::<Interval>::new(Rules::CatmullClark, n).unwrap();
        let mask = catmull_clark::limit_mask::<Rational>(n);
        let left = spectrum.left(Member::Constant);
        let weight = |i: usize| match i {
            0 => mask.center.clone(),
            i if i <= n as usize => mask.edge.clone(),
            i if i <= 2 * n as usize => mask.face.clone(),
            _ => Rational::zero(),
        };
        for (i, a) in left.iter().enumerate() {
            assert!(
                a.contains_rational(&weight(i)) && a.wid() < 1e-12,
                "n = {n}: {i}: {a}"
            );
        }
    }
}

/// The layout: the local net of each sector refines like the two-ring.
#[test]
fn sectors_have_the_local_nets_of_the_scheme() {
    for n in [3, 4, 7] {
        for rules in ALL {
            let ring = TwoRing::<Interval>::new(rules, n).unwrap();
            let net: Vec<Interval> = (0..ring.len())
                .map(|i| Interval::ratio((i * i % 17) as i64, 3))
                .collect();
            let next = ring.refine(&net);
            for sector in 0..n {
                let local = ring.local_net(sector, &net);
                let refined = match rules {
                    Rules::Loop(w) => {
                        loop_scheme::refine_local_net::<Interval, _>(w, n, &local).unwrap()
                    }
                    Rules::CatmullClark => {
                        catmull_clark::refine_local_net::<Interval, _>(n, &local)
                    }
                };
                for (a, b) in refined.iter().zip(ring.local_net(sector, &next)) {
                    assert!(
                        a.intersection(b).is_some() && b.wid() < 1e-13,
                        "{rules:?} n = {n}"
                    );
                }
            }
        }
    }
}

#[test]
fn characteristic_maps_are_regular_and_injective() {
    for rules in ALL {
        for row in tabulate(rules, &(3..=50).collect::<Vec<_>>()) {
            assert_eq!(row.map.regular, Sign::Positive, "{rules:?} n = {}", row.n);
            assert_eq!(row.map.injective, Sign::Positive, "{rules:?} n = {}", row.n);
            assert!(row.subdominant().is_some() && row.subsubdominant().is_some());
        }
    }
    // Exactly, for a few.
    for n in [3, 5, 6, 8] {
        let spectrum = Spectrum::<Cyclotomic>::new(LOOP[0], n).unwrap();
        let mode = spectrum
            .inner()
            .iter()
            .find(|mode| mode.frequency == 1)
            .unwrap();
        assert_eq!(check(&spectrum, mode).injective, Sign::Positive);
    }
}

/// What is no characteristic map is not certified as one.
#[test]
fn wrong_eigenvectors_are_not_certified() {
    for n in [5, 7, 12] {
        let spectrum = Spectrum::<Cyclotomic>::new(LOOP[0], n).unwrap();
        let mode = |k| {
            spectrum
                .inner()
                .iter()
                .find(|mode| mode.frequency == k)
                .unwrap()
        };
        // Frequency 2 goes round twice.
        assert_ne!(check(&spectrum, mode(2)).injective, Sign::Positive);
        // Second ring turned inside: the map folds.
        let mut folded = mode(1).clone();
        folded.right.kinds[2] = folded.right.kinds[2].clone() * &Cyclotomic::from_integer(-4);
        assert_eq!(check(&spectrum, &folded).regular, Sign::Refuted);
        // A little wrong: still regular, but no eigenvector, so nothing follows from one ring.
        let mut bent = mode(1).clone();
        bent.right.kinds[2] = bent.right.kinds[2].clone() * &Cyclotomic::ratio(99, 100);
        let found = check(&spectrum, &bent);
        assert_eq!(
            (found.regular, found.injective),
            (Sign::Positive, Sign::Refuted)
        );
        // Mirrored: w^j backwards is orientation reversed.
        let mut mirrored = mode(1).clone();
        for z in &mut mirrored.right.kinds {
            std::mem::swap(&mut z.x, &mut z.y);
        }
        assert_ne!(check(&spectrum, &mirrored).injective, Sign::Positive);
    }
    for n in [3, 5, 8] {
        let spectrum = Spectrum::<Interval>::new(Rules::CatmullClark, n).unwrap();
        let mut pair = spectrum.inner().iter().filter(|mode| mode.frequency == 1);
        let (larger, smaller) = (pair.next().unwrap(), pair.next().unwrap());
        assert_eq!(check(&spectrum, larger).injective, Sign::Positive);
        assert_eq!(check(&spectrum, smaller).regular, Sign::Refuted, "n = {n}");
    }
}

/// The vertex weights act on the frequency 0 only.
#[test]
fn the_characteristic_map_of_loop_does_not_depend_on_the_weights() {
    for n in [4, 5, 9] {
        let [a, b] = LOOP.map(|rules| {
            let spectrum = Spectrum::<Cyclotomic>::new(rules, n).unwrap();
            let mode = spectrum
                .inner()
                .iter()
                .find(|mode| mode.frequency == 1)
                .unwrap();
            mode.right.kinds.clone()
        });
        assert_eq!(a, b);
    }
}
