//! The referee refereed, second part: identities that any evaluation obeys, over the catalogue.
//! `cargo test --release --test oracle_identities -- --ignored --nocapture` prints the distances
//! over the catalogue (nothing is written to disk).

mod oracle;

use Scheme::*;
use num_rational::BigRational;
use oracle::*;
use std::collections::{BTreeSet, HashMap};

type Q = BigRational;

const SEED: u64 = 20_240_917;

fn q(p: i64, d: i64) -> Q {
    Q::ratio(p, d)
}

fn ask(scheme: Scheme, level: usize, against: Against, depth: usize) -> Question {
    Question {
        scheme,
        corner: Corner::Smooth,
        level,
        against,
        depth,
    }
}

/// All (net, scheme) pairs with rational masks; nets kept small enough for exact work.
fn exact_pairs() -> Vec<(nets::Net, Scheme)> {
    let small = nets::catalogue(SEED)
        .into_iter()
        .filter(|n| n.faces.len() <= 24);
    small
        .flat_map(|n| Scheme::ALL.map(|s| (n.clone(), s)))
        .filter(|(n, s)| nets::applicable(&n.faces, *s) && nets::is_exact(&n.faces, *s))
        .collect()
}

/// S does not depend on the level it is read from: the limit masks and the nesting of parameters
/// agree with one more step, exactly.
#[test]
fn one_more_step_changes_nothing() {
    let pairs = exact_pairs();
    assert!(
        Scheme::ALL
            .iter()
            .all(|s| pairs.iter().filter(|p| p.1 == *s).count() > 5)
    );
    for (net, scheme) in pairs {
        let mesh = Mesh::<Q>::from_integers(&net.points, &net.faces);
        let (coarse, fine) = (
            ask(scheme, 0, Against::Control, 1),
            ask(scheme, 0, Against::Control, 2),
        );
        let fine = samples(&mesh, fine);
        let at: HashMap<_, _> = fine.iter().map(|s| ((s.face, s.corner, s.at), s)).collect();
        for s in samples(&mesh, coarse) {
            let t = at[&(s.face, s.corner, s.at.map(|x| 2 * x))];
            assert!(t.s == s.s && t.f == s.f, "{} {scheme:?}", net.name);
        }
        // Read from level 1 instead: the same points.
        let set = |all: &[Sample<Q>]| all.iter().map(|s| s.s.clone()).collect::<BTreeSet<_>>();
        let shifted = samples(&mesh, ask(scheme, 1, Against::Limit, 1));
        assert_eq!(set(&fine), set(&shifted), "{} {scheme:?}", net.name);
        // Against the limit mesh S = F at its vertices.
        let at_vertex = |s: &&Sample<Q>| {
            if scheme == LoopWarren || scheme == LoopOriginal {
                s.at.contains(&2)
            } else {
                s.at == [0, 0, 0]
            }
        };
        assert!(
            shifted.iter().filter(at_vertex).all(|s| s.s == s.f),
            "{} {scheme:?}",
            net.name
        );
    }
}

/// S and F agree where faces and quarters meet: a point of F (positions are generic) has one S.
#[test]
fn pieces_fit_together() {
    for (net, scheme) in exact_pairs() {
        let mesh = Mesh::<Q>::from_integers(&net.points, &net.faces);
        // A pillow's halves, and the children of its centroids, have the same points: not generic.
        if net.name.starts_with("pillow") {
            continue;
        }
        let mut over = HashMap::new();
        for s in samples(&mesh, ask(scheme, 0, Against::Control, 2)) {
            let before = over.insert(s.f, s.s.clone());
            assert!(before.is_none_or(|b| b == s.s), "{} {scheme:?}", net.name);
        }
    }
}

/// Translations and linear maps go through (partition of unity); floats follow the rationals.
#[test]
fn equivariant_and_floats_agree() {
    let map = |p: &[i64; 3]| [p[0] + 2 * p[1] + 7, p[1] - p[2] - 1, 3 * p[0] + p[2] + 5];
    for (net, scheme) in exact_pairs() {
        let question = ask(scheme, 0, Against::Limit, 2);
        let mesh = Mesh::<Q>::from_integers(&net.points, &net.faces);
        let moved: Vec<_> = net.points.iter().map(map).collect();
        let moved = samples(&Mesh::<Q>::from_integers(&moved, &net.faces), question);
        let floats = samples(
            &Mesh::<f64>::from_integers(&net.points, &net.faces),
            question,
        );
        let plain = samples(&mesh, question);
        assert!(plain.len() == moved.len() && plain.len() == floats.len());
        for ((a, b), x) in plain.iter().zip(&moved).zip(&floats) {
            for (p, r, y) in [(&a.s, &b.s, &x.s), (&a.f, &b.f, &x.f)] {
                assert_eq!(r[0], &p[0] + q(2, 1) * &p[1] + q(7, 1));
                assert_eq!(r[1], &p[1] - &p[2] - q(1, 1));
                assert_eq!(r[2], q(3, 1) * &p[0] + &p[2] + q(5, 1));
                let to_f64 = |z: &Q| num_traits::ToPrimitive::to_f64(z).unwrap();
                assert!((0..3).all(|d| (to_f64(&p[d]) - y[d]).abs() < 1e-9));
            }
        }
    }
}

/// Irrational masks, in floats: one more step changes nothing there either.
#[test]
fn one_more_step_in_floats() {
    for net in nets::catalogue(SEED) {
        for scheme in Scheme::ALL
            .into_iter()
            .filter(|&s| nets::applicable(&net.faces, s))
        {
            let mesh = Mesh::<f64>::from_integers(&net.points, &net.faces);
            let fine = samples(&mesh, ask(scheme, 0, Against::Control, 3));
            let at: HashMap<_, _> = fine.iter().map(|s| ((s.face, s.corner, s.at), s)).collect();
            for s in samples(&mesh, ask(scheme, 0, Against::Control, 1)) {
                let t = at[&(s.face, s.corner, s.at.map(|x| 4 * x))];
                assert!(
                    squared_distance(&t.s, &s.s) + squared_distance(&t.f, &s.f) < 1e-16,
                    "{} {scheme:?}",
                    net.name
                );
            }
        }
    }
}

/// The catalogue holds what it promises.
#[test]
fn catalogue_is_varied() {
    let (mut interior, mut boundary, mut crowded) = (BTreeSet::new(), BTreeSet::new(), 0);
    for net in nets::catalogue(SEED) {
        let t = Topology::new(net.points.len(), &net.faces).unwrap();
        interior.extend(nets::valences(&t));
        let rim = (0..net.points.len()).filter(|&v| t.boundary[v].is_some());
        boundary.extend(rim.map(|v| t.neighbours[v].len()));
        let odd = |v: &&usize| t.is_interior(**v) && ![4, 6].contains(&t.neighbours[**v].len());
        crowded += net
            .faces
            .iter()
            .filter(|f| f.iter().filter(odd).count() > 2)
            .count();
    }
    assert!(
        (2..=20).all(|n| interior.contains(&n))
            && (2..=6).all(|n| boundary.contains(&n))
            && crowded > 20
    );
    for bad in [
        vec![vec![0, 1, 2], vec![0, 1, 3]],
        vec![vec![0, 1, 2], vec![0, 3, 4]],
        vec![vec![0, 1, 0]],
    ] {
        assert!(Topology::new(5, &bad).is_err());
    }
}

/// A table of distances for reading, to the terminal only.
#[test]
#[ignore = "prints a table"]
fn dump() {
    for net in nets::catalogue(SEED) {
        for scheme in Scheme::ALL
            .into_iter()
            .filter(|&s| nets::applicable(&net.faces, s))
        {
            let mesh = Mesh::<f64>::from_integers(&net.points, &net.faces);
            let values = [
                (0, Against::Control),
                (1, Against::Control),
                (0, Against::Limit),
            ]
            .map(|(k, a)| max_distance(&mesh, ask(scheme, k, a, 4)).0.sqrt());
            println!("{:24} {scheme:14?} {values:10.4?}", net.name);
        }
    }
}
