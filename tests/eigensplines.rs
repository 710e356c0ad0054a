//! Distances of Loop's eigensplines: known values, lemmas, the committed table.

use std::fs;
use std::path::Path;

use Against::{Control, Limit};
use ModeFamily::{Between, Ray, Ring as OfRing};
use num_traits::ToPrimitive;
use serde_json::Value;
use subcert::scalar::{Field, Interval, Rational, Ring};
use subcert::scheme::LoopWeights::{self, Original, Warren};
use subcert::spectrum::eigenspline::complex::Complex;
use subcert::spectrum::eigenspline::lattice::Levels;
use subcert::spectrum::eigenspline::mode::{Label, Link, ModeFamily, Net, Sector, nets};
use subcert::spectrum::eigenspline::{Against, Enclosed, distances, distances_of, scaling, table};
use subcert::spectrum::eigenspline::{ModeDistances, certificates::eigensplines};

fn float(x: &Rational) -> f64 {
    x.to_f64().expect("a finite number")
}

fn find(all: &[ModeDistances], family: ModeFamily, frequency: Option<u32>) -> &ModeDistances {
    let label = Label { family, frequency };
    let found = all.iter().find(|mode| mode.label == label);
    found.expect("a mode of this valence")
}

/// Valence, family, frequency, polyhedron, and μ_0, μ_1, ..
type Sampled = (u32, ModeFamily, Option<u32>, Against, &'static [f64]);

/// An independent float computation: dense sampling of S_n and search for the nearest maximum, by
/// another program in another language that knew neither this code nor its format. Seven digits.
const SAMPLED: [Sampled; 22] = [
    (
        3,
        OfRing,
        Some(0),
        Control,
        &[1.958333, 0.4895833, 0.1223958],
    ),
    (
        3,
        OfRing,
        Some(0),
        Limit,
        &[0.984375, 0.2176423, 0.06544909],
    ),
    (3, Ray, Some(0), Control, &[0.08333333, 0.03125, 0.0078125]),
    (3, Ray, Some(0), Limit, &[0.09375, 0.01835626, 0.005087554]),
    (
        3,
        Between,
        None,
        Limit,
        &[0.1166667, 0.02604643, 0.007244696],
    ),
    (
        4,
        OfRing,
        Some(2),
        Control,
        &[0.253423, 0.09602533, 0.02792955],
    ),
    (
        4,
        OfRing,
        Some(2),
        Limit,
        &[0.2702433, 0.1111629, 0.03259797],
    ),
    (
        4,
        OfRing,
        Some(0),
        Control,
        &[11.64931, 3.025716, 0.7675971],
    ),
    (4, OfRing, Some(0), Limit, &[7.728849, 1.79069, 0.4841196]),
    (
        4,
        Ray,
        None,
        Control,
        &[0.08333333, 0.02170139, 0.005562298],
    ),
    (
        5,
        OfRing,
        Some(2),
        Control,
        &[0.4925514, 0.1300602, 0.03336809],
    ),
    (
        5,
        OfRing,
        Some(0),
        Limit,
        &[1.076476, 0.2971261, 0.07724225],
    ),
    (
        5,
        Between,
        None,
        Control,
        &[0.1666667, 0.04299222, 0.0109112],
    ),
    (
        7,
        OfRing,
        Some(2),
        Control,
        &[0.2288161, 0.07307696, 0.02333857],
    ),
    (7, OfRing, Some(3), Limit, &[0.757133, 0.19711, 0.05069784]),
    (7, Ray, None, Limit, &[0.04152731, 0.01863663, 0.006174764]),
    (
        8,
        OfRing,
        Some(2),
        Control,
        &[0.2023137, 0.07586764, 0.02845036],
    ),
    (
        8,
        OfRing,
        Some(4),
        Limit,
        &[0.4325276, 0.1507157, 0.04365047],
    ),
    (
        8,
        Between,
        None,
        Control,
        &[0.1666667, 0.04276503, 0.01081571],
    ),
    (
        12,
        OfRing,
        Some(5),
        Control,
        &[0.6896734, 0.1872682, 0.04917924],
    ),
    (
        12,
        OfRing,
        Some(0),
        Control,
        &[0.733654, 0.2566907, 0.08981087],
    ),
    (
        12,
        Ray,
        None,
        Control,
        &[0.07644697, 0.01752113, 0.004530887],
    ),
];

#[test]
fn distances_agree_with_dense_sampling() {
    for against in [Control, Limit] {
        for n in [3, 4, 5, 7, 8, 12] {
            let all = distances(Original, n, against, 2).expect("distances");
            let rows = SAMPLED.iter().filter(|row| row.0 == n && row.3 == against);
            for (_, family, frequency, _, values) in rows {
                let mode = find(&all, *family, *frequency);
                for ([lo, hi], value) in mode.distances.iter().zip(*values) {
                    let (lo, hi) = (float(lo), float(hi));
                    let near = 3e-6 * value;
                    assert!(
                        lo <= value + near && *value <= hi + near && hi - lo < 1e-3 * hi,
                        "n = {n}, {family} {frequency:?}, {against}: {value} in [{lo}, {hi}]"
                    );
                }
            }
        }
    }
}

/// With Warren's weights only the mode of frequency 0 changes (the same source).
#[test]
fn warren_changes_one_mode() {
    let known = [
        (Control, 1.066667, 0.2745562),
        (Limit, 0.7916667, 0.1994765),
    ];
    for (against, first, second) in known {
        let all = distances(Warren, 4, against, 1).expect("distances");
        let original = distances(Original, 4, against, 1).expect("distances");
        assert_eq!(all[1..], original[1..]);
        for ([lo, hi], value) in all[0].distances.iter().zip([first, second]) {
            assert!(float(lo) <= value + 1e-6 && value <= float(hi) + 1e-6);
        }
    }
}

/// n = 6: lattice values of the modes are polynomials in z = x + iy up to degree 2, which the box spline
/// takes to themselves plus a constant.
///
/// Frequency 2: z^2, harmonic, so S = z^2. On an edge of length 1 the linear interpolant is off by 1/4 at
/// the middle, and less elsewhere. Frequency 0: 2|z|^2 - 1, S = 2|z|^2: the distance from the control
/// polyhedron is 1 at the vertices; from the limit one it is 2 (circumradius)^2 = 2/3 in the middle of a
/// facet. One level more is a quarter of it.
#[test]
fn regular_valence_by_hand() {
    for (against, of_zero) in [(Control, (1, 1)), (Limit, (2, 3))] {
        let all = distances(Original, 6, against, 3).expect("distances");
        for (frequency, (p, q)) in [(0, of_zero), (2, (1, 4))] {
            let mode = find(&all, OfRing, Some(frequency));
            for (m, [lo, hi]) in mode.distances.iter().enumerate() {
                let exact = <Rational as Field>::ratio(p, q << (2 * m));
                assert!(
                    *lo <= exact && exact <= *hi,
                    "{frequency}, {m}: {lo} .. {hi}"
                );
            }
        }
    }
}

/// Peters & Wu, Lemma 3, exactly: at n = 4 all numbers are rational. The net of level s + 1 of a mode is
/// λ times that of level s, as far as both are known.
#[test]
fn nets_scale_from_level_to_level() {
    for weights in [Original, Warren] {
        let (chi, modes) = nets::<Rational>(weights, 4).expect("rational numbers");
        for net in modes.iter().chain([&chi]) {
            let levels = Levels::new(net, None, 4);
            for s in 0..4 {
                for sector in 0..levels.sectors() {
                    let radius = if s == 0 { 3 } else { (1 << s) + 2 };
                    for p in 0..=radius {
                        for q in 0..=radius - p {
                            let old = levels.level(s, sector).at([p, q]).clone();
                            let new = levels.level(s + 1, sector).at([p, q]);
                            assert_eq!(*new, old * &net.eigenvalue, "{:?} {s} {p} {q}", net.label);
                        }
                    }
                }
            }
        }
    }
}

/// Over ring r a generalised mode is `λ^r e + r λ^(r-1) κ f`. With λ = 1/2, κ = -1, D = 1, 1/16, 1/64 and D = 3/8,
/// 1/16, 1/64 for f, by hand: at m = 1 ring 1 has `1/2 ± 3/8`, at m = 2 ring 2 has `1/4 ± 2/2 3/8` and ring 1 less;
/// from below ring 0 is the best at m = 2. N is too small to count.
#[test]
fn chains_of_generalised_modes_add_to_both_bounds() {
    let number = |(p, q)| <Rational as Field>::ratio(p, q);
    let known = |x| Enclosed {
        lo: number(x),
        hi: number(x),
        place: None,
    };
    let rings = [(1, 1), (1, 16), (1, 64)].map(known);
    let of_chain = [(3, 8), (1, 16), (1, 64)].map(known);
    let near = known((1, 1024));
    let chain = Some((Interval::point(-1.0), (&of_chain[..], &near)));
    let found = scaling::distances(Interval::point(0.5), &rings, &near, chain);
    for ([lo, hi], [below, above]) in
        (found.iter()).zip([[1.0, 1.0], [0.125, 0.875], [0.015625, 0.625]])
    {
        let (lo, hi) = (float(lo), float(hi));
        assert!(lo <= below && lo > below * 0.999_999, "{lo}, {below}");
        assert!(hi >= above && hi < above * 1.000_001, "{hi}, {above}");
    }
}

/// The net that is 1 everywhere.
fn constant() -> Net<Interval> {
    let one = || Complex::real(Interval::from_integer(1));
    let places = [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0], [0, 2]];
    Net {
        label: Label {
            family: OfRing,
            frequency: Some(0),
        },
        eigenvalue: Interval::from_integer(1),
        sectors: vec![Sector {
            points: places.map(|place| (place, one())).to_vec(),
            before: Link::Turned(one()),
            behind: Link::Turned(one()),
        }],
        kappa: None,
    }
}

/// Peters & Wu, Lemma 2: constants and the characteristic map itself are reproduced by their polyhedra.
#[test]
fn constants_and_the_characteristic_map_are_reproduced() {
    for n in [3, 5, 7] {
        for against in [Control, Limit] {
            let (chi, _) = nets::<Interval>(Original, n).expect("intervals have all numbers");
            for net in [constant(), chi.clone()] {
                if against == Limit && net.eigenvalue == Interval::from_integer(1) {
                    // The format's limit at the centre is 0: for modes with λ < 1.
                    continue;
                }
                let found = distances_of(n, &chi, &[net], against, 2).expect("distances");
                for ring in &found[0].rings {
                    assert!(float(&ring.hi) < 1e-12, "n = {n}, {against}: {}", ring.hi);
                }
            }
        }
    }
}

#[test]
fn any_number_of_threads_finds_the_same() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("threads");
        pool.install(|| distances(Original, 5, Limit, 3))
    };
    assert_eq!(run(1), run(3));
}

/// What is written is verified by the checker; with a bound moved to the other, it is not.
#[test]
fn fresh_certificates_are_verified() {
    for (weights, n, against) in [
        (Original, 3, Limit),
        (Original, 7, Control),
        (Original, 8, Control),
        (Warren, 5, Limit),
    ] {
        let certificate = eigensplines(weights, n, against, 2).expect("distances");
        let mut text = Vec::new();
        certificate.write(&mut text).expect("memory");
        let outcome = subcert_check::check(&text).outcome;
        assert!(outcome.is_ok(), "{weights} {n} {against}: {outcome:?}");
        let mut faulty: Value = serde_json::from_slice(&text).expect("JSON");
        let ring = &mut faulty["steps"][0]["rings"][1];
        ring["hi"] = ring["lo"].clone();
        assert!(
            subcert_check::check(faulty.to_string().as_bytes())
                .outcome
                .is_err()
        );
    }
}

/// The table has an entry for each bound of each certificate, above it by less than a millionth.
#[test]
fn the_table_is_what_the_certificates_prove() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("proofs/certificates");
    let mut compared = 0;
    for n in 3..=30 {
        for against in [Control, Limit] {
            for weights in [Original, Warren] {
                let name = format!("loop-{weights}-eigensplines-{against}-n{n:02}.json");
                let path = folder.join(name);
                if weights == Warren && matches!(n, 3 | 6) {
                    // Both weights agree.
                    assert!(!path.exists());
                    assert_eq!(bounds(Original, n, against), bounds(Warren, n, against));
                    continue;
                }
                let file: Value =
                    serde_json::from_slice(&fs::read(path).expect("a file")).expect("JSON");
                let modes = file["claim"]["modes"].as_array().expect("modes").clone();
                for mode in modes {
                    compared += compare(&mode, weights, n, against);
                }
            }
        }
    }
    assert!(compared > 3000, "{compared} bounds");
    assert!(table::upper(Original, 31, Control, 0).is_none());
    assert!(table::upper(Original, 30, Control, 7).is_none());
}

fn bounds(weights: LoopWeights, n: u32, against: Against) -> Vec<&'static [table::ModeBound]> {
    let level = |m| table::upper(weights, n, against, m).expect("a row");
    (0..=6).map(level).collect()
}

fn compare(mode: &Value, weights: LoopWeights, n: u32, against: Against) -> usize {
    let frequency = mode["frequency"].as_u64();
    let family = mode["family"].as_str().expect("text");
    if (family, frequency) == ("ray", Some(0)) {
        return 0;
    }
    let distances = mode["distances"].as_array().expect("distances");
    for (bounds, pair) in bounds(weights, n, against).iter().zip(distances) {
        let hi: Rational = pair[1].as_str().expect("text").parse().expect("a rational");
        let same = |b: &&table::ModeBound| {
            b.label.family.to_string() == family && b.label.frequency.map(u64::from) == frequency
        };
        let entry = bounds.iter().find(same).expect("an entry").bound;
        let exact = Rational::from_float(entry).expect("a finite number");
        assert!(
            exact >= hi && entry <= float(&hi) * 1.000_001,
            "{family} {n}: {entry}, {hi}"
        );
    }
    distances.len()
}
