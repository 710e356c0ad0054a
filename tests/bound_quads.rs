//! Bound constants of Catmull-Clark and Doo-Sabin against a second derivation, closed forms and plain
//! refinement.
//!
//! The decimals are from a separate program in another language, written from the definitions alone:
//! float linear programs of another library, the best net at a point and the best point of a net in turn,
//! then a dense grid with a pool of bases. The fractions of rates were verified there with exact
//! fractions, both sides.

use num_traits::{One, Signed, Zero};
use subcert::bound::arithmetic::Exact;
use subcert::bound::rules::{CatmullClark, DooSabin, Rules};
use subcert::bound::{Against, Constant, Family, Norm, Proof, Prover};
use subcert::scalar::{Cyclotomic, Field, Rational};
use subcert::scheme::{catmull_clark, doo_sabin};

const GAP: f64 = 1e-6;
const SECOND: Family = Family::CatmullClark(Norm::Second);
const FIRST: Family = Family::CatmullClark(Norm::First);

fn control(k: usize) -> Constant {
    Constant::Distance(Against::Control, k)
}

fn limit(k: usize) -> Constant {
    Constant::Distance(Against::Limit, k)
}

fn prove(prover: &mut Prover, constant: Constant) -> Proof {
    let proof = prover.prove(constant, GAP);
    let proof = proof.unwrap_or_else(|| panic!("{constant:?} of {}", prover.valence()));
    assert!(proof.lo <= proof.hi && proof.gap() <= GAP, "{proof:?}");
    proof
}

fn exact(family: Family, n: u32, constant: Constant) -> Cyclotomic {
    let mut prover = Prover::new(family, n);
    let proof = prove(&mut prover, constant);
    let closed = prover.closed_form(&proof);
    closed.unwrap_or_else(|| panic!("{constant:?} of {n}: {proof:?}"))
}

fn ratio(p: i64, q: i64) -> Cyclotomic {
    Cyclotomic::ratio(p, q)
}

/// Whether the constants of levels 0, 1, .. hold the values of the other program.
fn hold(family: Family, n: u32, constant: fn(usize) -> Constant, values: &[f64]) {
    let mut prover = Prover::new(family, n);
    for (k, value) in values.iter().enumerate() {
        let proof = prove(&mut prover, constant(k));
        let within = proof.lo <= value + 2e-9 && value - 2e-9 <= proof.hi;
        assert!(within, "n = {n}, k = {k}: {value} and {proof:?}");
    }
}

/// Regular nets: Catmull-Clark C_k = 4^-k/3 (CY Lemma 2 is sharp), B_k = 4^-k/4; Doo-Sabin C_k = 4^-k/4
/// (LN Theorem 5 is sharp); rates 4^-k.
#[test]
fn regular_valence_is_known_in_closed_form() {
    let mut power = 1;
    for k in 0..=4 {
        assert_eq!(exact(SECOND, 4, control(k)), ratio(1, 3 * power));
        assert_eq!(exact(SECOND, 4, limit(k)), ratio(1, 4 * power));
        assert_eq!(exact(Family::DooSabin, 4, control(k)), ratio(1, 4 * power));
        if k > 0 {
            assert_eq!(exact(SECOND, 4, Constant::Rate(k)), ratio(1, power));
            assert_eq!(
                exact(Family::DooSabin, 4, Constant::Rate(k)),
                ratio(1, power)
            );
        }
        if (1..4).contains(&k) {
            assert_eq!(exact(SECOND, 4, Constant::MeshRate(k)), ratio(1, power));
        }
        power *= 4;
    }
}

/// C_0(N) = 1/3 in the second-order norm but 3/8 at N = 3, the displacement of the vertex there; 5/9 in
/// the first-order norm but 5/8 at N = 3.
#[test]
fn c_0_of_catmull_clark() {
    for n in 3..=50 {
        let (second, first) = if n == 3 {
            ((3, 8), (5, 8))
        } else {
            ((1, 3), (5, 9))
        };
        assert_eq!(exact(SECOND, n, control(0)), ratio(second.0, second.1));
        if n != 4 {
            assert_eq!(exact(FIRST, n, control(0)), ratio(first.0, first.1));
        }
    }
    hold(FIRST, 4, control, &[5.0 / 9.0]);
}

#[test]
fn rates_of_catmull_clark() {
    let second: [(u32, [(i64, i64); 3]); 6] = [
        (3, [(2, 3), (7, 24), (47, 384)]),
        (5, [(18, 25), (3213, 8000), (71213, 320_000)]),
        (6, [(3, 4), (15, 32), (143, 512)]),
        (8, [(3, 4), (31, 64), (155, 512)]),
        (12, [(29, 36), (949, 1728), (119_491, 331_776)]),
        (20, [(81, 100), (17_979, 32_000), (964_367, 2_560_000)]),
    ];
    let first: [(u32, [(i64, i64); 3]); 5] = [
        (3, [(9, 16), (1555, 6144), (126_899, 1_179_648)]),
        (4, [(43, 64), (351, 1024), (2783, 16_384)]),
        (5, [(39, 50), (3513, 8000), (157_801, 640_000)]),
        (7, [(85, 98), (61, 112), (28_655, 87_808)]),
        (20, [(657, 800), (36_519, 64_000), (1_982_087, 5_120_000)]),
    ];
    let families = [(SECOND, &second[..]), (FIRST, &first[..])];
    for (family, rows) in families {
        for (n, rates) in rows {
            for (k, (p, q)) in (1..).zip(rates) {
                let rate = exact(family, *n, Constant::Rate(k));
                assert_eq!(rate, ratio(*p, *q), "{family:?}, n = {n}, k = {k}");
            }
        }
    }
}

#[test]
fn distances_of_catmull_clark_in_the_second_order_norm() {
    hold(
        SECOND,
        3,
        control,
        &[
            0.375,
            0.092592592593,
            0.025754320801,
            0.011528587501,
            0.004875546581,
        ],
    );
    hold(
        SECOND,
        5,
        control,
        &[
            1.0 / 3.0,
            0.1,
            0.039889858545,
            0.021832779170,
            0.012018321261,
        ],
    );
    hold(
        SECOND,
        8,
        control,
        &[
            1.0 / 3.0,
            0.105769230769,
            0.048027443630,
            0.029691785970,
            0.018319084419,
        ],
    );
    hold(
        SECOND,
        16,
        control,
        &[
            1.0 / 3.0,
            0.085273220472,
            0.052975662395,
            0.035327056884,
            0.023320819774,
        ],
    );
    hold(
        SECOND,
        3,
        limit,
        &[
            0.258145748398,
            0.065778586372,
            0.026049766938,
            0.010989575165,
            0.004572180837,
        ],
    );
    hold(
        SECOND,
        6,
        limit,
        &[
            0.237453600421,
            0.084690240917,
            0.042421063233,
            0.025084480149,
            0.014701336719,
        ],
    );
    hold(
        SECOND,
        11,
        limit,
        &[
            0.220317290822,
            0.104513673882,
            0.063555663150,
            0.038956036497,
            0.023968287956,
        ],
    );
    hold(
        SECOND,
        20,
        limit,
        &[
            0.207937680589,
            0.102679147035,
            0.065234970707,
            0.041976508405,
            0.026984017914,
        ],
    );
}

#[test]
fn distances_of_catmull_clark_in_the_first_order_norm() {
    hold(
        FIRST,
        3,
        control,
        &[
            0.625,
            0.119212962963,
            0.028392650463,
            0.007010000723,
            0.001970944099,
        ],
    );
    hold(
        FIRST,
        4,
        control,
        &[
            5.0 / 9.0,
            0.118055555556,
            0.028211805556,
            0.006971571181,
            0.001737806532,
        ],
    );
    hold(
        FIRST,
        7,
        control,
        &[
            5.0 / 9.0,
            1.0 / 6.0,
            0.068452380952,
            0.034627487737,
            0.019404032074,
        ],
    );
    hold(
        FIRST,
        16,
        control,
        &[
            5.0 / 9.0,
            0.134774443289,
            0.083330348730,
            0.055337834937,
            0.036285039567,
        ],
    );
    hold(
        FIRST,
        4,
        limit,
        &[
            0.223958333333,
            0.062365222366,
            0.018369039425,
            0.004925730715,
        ],
    );
    hold(
        FIRST,
        9,
        limit,
        &[
            0.287130568568,
            0.128588535752,
            0.070616156239,
            0.041382426139,
        ],
    );
}

/// r_1 in closed form, by the residues of N modulo 4; in the first-order norm it is CY's bound (19) at
/// one step from N = 6 on.
#[test]
fn r_1_in_closed_form() {
    for n in (3..=50).filter(|n| *n != 4) {
        let i = i64::from(n);
        let form = |a, b, c| ratio(a, 4) + ratio(b, 4 * i) - ratio(c, 2 * i * i);
        let second = match n {
            3 => ratio(2, 3),
            5 => ratio(18, 25),
            _ if n % 4 == 0 => form(3, 8, 32),
            _ if n % 2 == 0 => form(3, 8, 24),
            _ => form(3, 8, 23),
        };
        let first = match n {
            3 => ratio(9, 16),
            5 => ratio(39, 50),
            _ => form(3, 7, 13),
        };
        assert_eq!(exact(SECOND, n, Constant::Rate(1)), second, "N = {n}");
        assert_eq!(exact(FIRST, n, Constant::Rate(1)), first, "N = {n}");
    }
}

/// `C_0 = 27/64 - (11 + 4 cos 2π/n)/(16 n)`, n = 5..19.
#[test]
fn c_0_of_doo_sabin_in_closed_form() {
    for n in 5..=19u32 {
        let mut prover = Prover::new(Family::DooSabin, n);
        let proof = prove(&mut prover, control(0));
        let two_cos = Cyclotomic::two_cos(1, n).unwrap();
        let value =
            ratio(27, 64) - ratio(11, 16 * i64::from(n)) - two_cos * ratio(1, 8 * i64::from(n));
        match prover.closed_form(&proof) {
            Some(closed) => assert_eq!(closed, value, "n = {n}"),
            None => {
                let value = value.enclose();
                assert!(
                    proof.lo <= value.sup() && value.inf() <= proof.hi,
                    "n = {n}"
                );
            }
        }
    }
}

/// The largest distance is at the extraordinary corner itself, `(2N - 5)/(N (N + 5))`, for N = 5..11.
#[test]
fn c_1_at_the_extraordinary_corner() {
    for n in 5..=11i64 {
        let mut prover = Prover::new(SECOND, n as u32);
        let proof = prove(&mut prover, control(1));
        let value = (2 * n - 5) as f64 / (n * (n + 5)) as f64;
        assert!((proof.lo - value).abs() < 1e-15 && proof.hi < value * (1.0 + 1e-6));
    }
}

#[test]
fn constants_of_doo_sabin_faces() {
    let family = Family::DooSabin;
    hold(
        family,
        3,
        control,
        &[0.276041666667, 0.097330729167, 0.040913899740],
    );
    hold(
        family,
        5,
        control,
        &[
            0.268924150281,
            0.081607971822,
            0.028448353642,
            0.010715945728,
        ],
    );
    hold(
        family,
        6,
        control,
        &[0.286458333333, 0.100585937500, 0.0369669596354],
    );
    hold(
        family,
        8,
        control,
        &[
            0.313840413088,
            0.114887364200,
            0.052857960199,
            0.024167700216,
        ],
    );
    hold(
        family,
        12,
        control,
        &[
            0.346541137421,
            0.143554687500,
            0.069218773686,
            0.030101607114,
        ],
    );
    let rates = [
        (3, [0.5, 0.25, 0.125]),
        (7, [0.588100433288, 0.291327050365, 0.149107446046]),
        (10, [0.725, 0.336588137289, 0.157202974016]),
        (12, [0.776415608176, 0.359375, 0.153613907483]),
    ];
    for (n, values) in rates {
        let mut prover = Prover::new(family, n);
        for (k, value) in (1..).zip(values) {
            let proof = prove(&mut prover, Constant::Rate(k));
            assert!((proof.lo - value).abs() < 1e-11 && (proof.hi - value).abs() < 1e-11);
        }
    }
}

fn norm(rows: &[subcert::scheme::IntegerRow], net: &[Rational]) -> Rational {
    let values = rows
        .iter()
        .map(|row| row.apply::<Rational, Rational>(net).abs());
    values.fold(Rational::zero(), |a, b| if a < b { b } else { a })
}

/// The net of a lower bound has M <= 1 and attains it under the plain refinement of the library, which
/// knows no functionals.
#[test]
fn witnesses_attain_rates_under_plain_refinement() {
    for (family, rows_of) in [
        (SECOND, catmull_clark::second_differences as fn(u32) -> _),
        (FIRST, catmull_clark::first_differences as fn(u32) -> _),
    ] {
        for n in [3, 4, 5, 6, 8, 12] {
            for k in 1..=3 {
                let mut prover = Prover::new(family, n);
                let proof = prove(&mut prover, Constant::Rate(k));
                let mut net = prover.candidate(proof.net).net_rationals();
                let rows: Vec<_> = rows_of(n);
                assert!(norm(&rows, &net) <= Rational::one());
                for _ in 0..k {
                    net = catmull_clark::refine_local_net::<Rational, _>(n, &net);
                }
                let expected = prover.closed_form(&proof).unwrap().to_rational();
                assert_eq!(Some(norm(&rows, &net)), expected, "n = {n}, k = {k}");
            }
        }
    }
    for n in [3, 4, 6] {
        let mut prover = Prover::new(Family::DooSabin, n);
        let proof = prove(&mut prover, Constant::Rate(2));
        let mut net = prover.candidate(proof.net).net_rationals();
        let rows = doo_sabin::face_differences(n);
        for _ in 0..2 {
            net = doo_sabin::refine_local_net::<Rational, _>(n, &net).unwrap();
        }
        let expected = prover.closed_form(&proof).unwrap().to_rational();
        assert_eq!(Some(norm(&rows, &net)), expected, "n = {n}");
    }
}

/// CY (17), (18) as sets, literally.
#[test]
fn first_differences_are_those_of_cheng_and_yong() {
    for n in 3..=12usize {
        let eight = if n == 3 { 2 } else { 8 };
        let far = 2 * n;
        let mut sets = vec![(1, (1..=far + 1).collect::<Vec<_>>())];
        sets.push((6, vec![1, 4, 5, 6, 7, eight, far + 3, far + 4, far + 5]));
        sets.push((
            5,
            vec![1, 4, 5, 6, far + 2, far + 3, far + 4, far + 6, far + 7],
        ));
        sets.push((4, vec![1, 2, 3, 4, 5, 6, far + 6, far + 7, far + 8]));
        let mut pairs = std::collections::BTreeSet::new();
        for (center, points) in sets {
            for point in points.into_iter().filter(|&p| p != center) {
                pairs.insert((center.min(point), center.max(point)));
            }
        }
        let rows = catmull_clark::first_differences(n as u32);
        let found: std::collections::BTreeSet<_> = (rows.iter())
            .map(|row| (row.terms()[0].0 + 1, row.terms()[1].0 + 1))
            .collect();
        assert_eq!(found, pairs, "N = {n}");
        assert_eq!(rows.len(), pairs.len(), "N = {n}");
    }
}

/// What a family has no such constant of is refused, not guessed.
#[test]
fn constants_that_are_not_defined_have_no_proof() {
    let coefficient = Constant::Coefficient(subcert::bound::word::Word::EMPTY, 0);
    for (family, constant) in [
        (Family::DooSabin, limit(0)),
        (Family::DooSabin, Constant::MeshRate(1)),
        (Family::DooSabin, coefficient),
        (SECOND, coefficient),
        (FIRST, Constant::Beta),
    ] {
        assert!(!family.knows(constant));
        assert!(Prover::new(family, 5).prove(constant, GAP).is_none());
    }
}

/// A square's word 0 of a Doo-Sabin net keeps the face's centroid at its corner, and a regular net read
/// as an extraordinary one with four sides has the same constants.
#[test]
fn the_root_of_a_face_is_its_quarter() {
    let rules: Box<dyn Rules<Exact<num_bigint::BigInt>>> = Box::new(DooSabin { n: 5 });
    assert_eq!(rules.layout().root.to_string(), "0");
    assert_eq!(rules.layout().size, 10);
    let rules: Box<dyn Rules<Exact<num_bigint::BigInt>>> = Box::new(CatmullClark {
        n: 5,
        norm: Norm::Second,
    });
    assert_eq!(rules.layout().root.to_string(), "");
    assert_eq!(rules.differences(5).len(), 20);
}

/// `r_1(N) = 3/4 + 7/(4N) - 13/(2N^2)` in the first-order norm for **every** N >= 6 (proofs/README.md); what
/// that proof leaves to the computer.
///
/// *Lower side*: the net 0 at V1, -1 at V10, V11, V12, +1 elsewhere. *Upper side*: `V1' - V_odd'` and
/// `V1' - V_even'` by their coefficients over the differences at V1. The other differences do not involve
/// V1' and are the same combinations of V1 .. V10, V(2N), V(2N+1) and the outer points for every N >= 6: their least weights
/// over the differences of these points are at most 3/4, a bound for every such N.
#[test]
fn r_1_in_the_first_order_norm_for_every_valence() {
    let bound = |n: i64| ratio(3, 4) + ratio(7, 4 * n) - ratio(13, 2 * n * n);
    for n in [6u32, 7, 12, 31] {
        let size = catmull_clark::local_net_size(n);
        let one = |i: usize| match i {
            0 => 0,
            9..=11 => -1,
            _ => 1,
        };
        let net: Vec<Rational> = (0..size)
            .map(|i| <Rational as Field>::ratio(one(i), 1))
            .collect();
        let rows = catmull_clark::first_differences(n);
        assert_eq!(norm(&rows, &net), Rational::one());
        let refined = catmull_clark::refine_local_net::<Rational, _>(n, &net);
        let attained = Cyclotomic::from_rational(&norm(&rows, &refined));
        assert_eq!(attained, bound(i64::from(n)), "N = {n}");
    }
    // The far points of the ring, V11 .. V(2N-1), take no part.
    let n = 6;
    let size = catmull_clark::local_net_size(n);
    let far = 10..2 * n as usize - 1;
    let near =
        |row: &subcert::scheme::IntegerRow| row.terms().iter().all(|(i, _)| !far.contains(i));
    let rows: Vec<_> = catmull_clark::first_differences(n);
    let near_rows: Vec<_> = rows.iter().filter(|row| near(row)).cloned().collect();
    let unit = |at: usize| -> Vec<Rational> {
        (0..size)
            .map(|i| <Rational as Field>::ratio(i64::from(i == at), 1))
            .collect()
    };
    let columns: Vec<Vec<Rational>> = (0..size)
        .map(|at| catmull_clark::refine_local_net::<Rational, _>(n, &unit(at)))
        .collect();
    let program = subcert::lp::Rows::new(near_rows, size);
    let mut largest = Rational::zero();
    for row in rows.iter().filter(|row| row.terms()[0].0 != 0) {
        let t: Vec<Rational> = (columns.iter())
            .map(|column| row.apply::<Rational, Rational>(column))
            .collect();
        let best = program
            .minimise(&t, program.start())
            .expect("in their span");
        largest = largest.max(best.value);
    }
    assert!(largest <= <Rational as Field>::ratio(3, 4), "{largest}");
    // The sums of magnitudes for V1' - V_even', V1' - V_odd' as functions of N, by hand: see the README.
    for n in 5..=400i64 {
        let (b, c) = (
            Rational::new(3.into(), (2 * n * n).into()),
            Rational::new(1.into(), (4 * n * n).into()),
        );
        let r = |p: i64, q: i64| <Rational as Field>::ratio(p, q);
        let odd = &b * r(n - 2, 1)
            + (&b - r(1, 4)).abs() * r(2, 1)
            + &c * r(n - 1, 1)
            + (&c - r(1, 4)).abs();
        let even = &b * r(n - 3, 1)
            + (&b - r(3, 8)).abs()
            + (&b - r(1, 16)).abs() * r(2, 1)
            + &c * r(n - 2, 1)
            + (&c - r(1, 16)).abs() * r(2, 1);
        assert_eq!(Cyclotomic::from_rational(&odd), bound(n));
        assert!(even <= odd);
    }
}
