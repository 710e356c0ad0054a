//! What the schemes' masks must do, for every scheme: all through nets and targets.

use super::*;
use crate::catmull_clark::CatmullClark;
use crate::claim::Norm;
use crate::doo_sabin::DooSabin;
use crate::loop_scheme::Loop;
use crate::ring::{Interval, Ring};
use crate::scalar::Scalar;
use crate::word::mirrored;
use num_traits::Zero;

const VALENCES: [usize; 7] = [3, 4, 5, 6, 7, 8, 12];

/// The schemes with beta and the cosines as variables: what holds for them holds for their values.
fn spaces(n: usize) -> Vec<Space> {
    let any = Interval::outward(&ratio(1, 4), &ratio(3, 4));
    // At their regular valences beta is 3/8, and the cosines are rational.
    let (ring, beta) = match n {
        6 => (Ring::RATIONALS, Scalar::constant(&ratio(3, 8))),
        _ => (Ring::Powers(any.clone()), Scalar::generator(1)),
    };
    let (cosines, list) = match n {
        4 => (Ring::RATIONALS, [1, 0, -1, 0].map(Scalar::integer).to_vec()),
        _ => (Ring::cosines(n, any), (0..n).map(|k| Scalar::generator(k.min(n - k))).collect()),
    };
    let [zero, one] = [0, 1].map(Scalar::integer);
    let catmull_clark = |norm| {
        let scheme = Box::new(CatmullClark(norm));
        Space::of(scheme, n, Ring::RATIONALS, zero.clone(), one.clone())
    };
    vec![
        Loop::space(n, ring, beta),
        catmull_clark(Norm::Second),
        catmull_clark(Norm::First),
        Space::of(Box::new(DooSabin(list)), n, cosines, zero.clone(), one.clone()),
    ]
}

fn all() -> impl Iterator<Item = Space> {
    VALENCES.into_iter().flat_map(spaces)
}

fn is_zero(form: &Form) -> bool {
    form.num.iter().all(Zero::is_zero)
}

fn assert_same(a: &Form, b: &Form, what: &str) {
    let rest = Form::mix(a.size(), &[(ratio(1, 1), a), (ratio(-1, 1), b)]);
    assert!(is_zero(&rest), "{what}");
}

fn net(space: &Space, word: &[u8]) -> Net {
    Path::new(space).along(word).unwrap()[word.len()].clone()
}

/// q times S at a point of a regular word, and that point in the face.
fn surface(space: &Space, word: &[u8], point: &Point) -> (Point, Form) {
    let net = net(space, word);
    let forms: Vec<_> = space.surface.iter().map(|mask| net.apply(space, mask)).collect();
    let values = space.patch().value(point).into_iter();
    let value = Form::mix(space.size, &values.zip(&forms).collect::<Vec<_>>());
    (space.patch().part(word).point(point), value)
}

#[test]
fn regular_refinement_splits_the_patch() {
    // The surface masks, the refinement and the order of the parts, all at once.
    for space in spaces(5) {
        for letter in 0..4 {
            for node in space.patch().nodes() {
                let (_, part) = surface(&space, &[2, letter], &node);
                let place = space.patch().quarters()[usize::from(letter)].point(&node);
                let (_, whole) = surface(&space, &[2], &place);
                assert_same(&part, &whole, &format!("letter {letter}, node {node:?}"));
            }
        }
    }
}

#[test]
fn the_surface_is_continuous_between_words() {
    for space in all() {
        // Points that two regular words share have one value, their common edges three nodes at least.
        let words = [&[1][..], &[2], &[3], &[0, 1], &[0, 2], &[0, 3]];
        let mut known: Vec<(Point, Form)> = Vec::new();
        let mut shared = 0;
        for (word, node) in
            words.iter().flat_map(|w| space.patch().nodes().into_iter().map(move |p| (w, p)))
        {
            let (place, value) = surface(&space, word, &node);
            for (_, other) in known.iter().filter(|(other, _)| *other == place) {
                assert_same(&value, other, &format!("n = {}, {place:?}", space.n));
                shared += 1;
            }
            known.push((place, value));
        }
        assert!(shared > 15);
    }
}

#[test]
fn limits_are_kept_by_refinement_and_are_the_corners_of_patches() {
    for space in all() {
        let (first, zero, two) = (net(&space, &[]), net(&space, &[0]), net(&space, &[0, 2]));
        let limit = |net: &Net| net.apply(&space, &space.scheme.limit(net.valence));
        assert_same(&limit(&first), &limit(&zero), "the extraordinary point");
        let corner = [0, 0].map(|_| ratio(0, 1));
        assert_same(&limit(&two), &surface(&space, &[0, 2], &corner).1, "a regular corner");
        // The limit mesh at the other corners of an extraordinary word (Doo-Sabin has none).
        let masks = space.scheme.mesh(Mesh::Limit, space.n, &[]).unwrap_or_default();
        for (mask, corner) in masks.iter().zip(space.patch().corners()).skip(1) {
            let words = [&[1][..], &[2], &[3]];
            let all = words
                .iter()
                .flat_map(|w| space.patch().corners().into_iter().map(|p| surface(&space, w, &p)));
            let found: Vec<_> = all.filter(|(place, _)| *place == corner).collect();
            assert!(!found.is_empty());
            found
                .iter()
                .for_each(|(_, value)| assert_same(&first.apply(&space, mask), value, "a corner"));
        }
    }
}

#[test]
fn constants_are_kept() {
    for space in all() {
        let ones = vec![1.into(); space.size];
        let mut path = Path::new(&space);
        for word in [&[0, 0][..], &[0, 1], &[1, 3], &[2, 2]] {
            let net = path.along(word).unwrap()[2].clone();
            let identity = net.apply(&space, &vec![(Scalar::integer(1), 1)]).at(&ones, &1.into());
            assert!((&identity - &Scalar::integer(1)).is_zero());
            let regular = is_regular(word);
            assert!(
                space
                    .differences(regular)
                    .iter()
                    .all(|row| net.difference(row).at(&ones, &1.into()).is_zero())
            );
        }
        let root = vec![0; space.scheme.root() + 1];
        let target = Target::FIRST.at_point(&space, &mut path, &root, &[ratio(0, 1), ratio(0, 1)]);
        assert!(target.unwrap().at(&ones, &1.into()).is_zero());
    }
}

#[test]
fn masks_that_are_known() {
    let weight = |mask: &crate::scheme::Mask, label: usize| {
        let terms = mask.iter().filter(|(_, other)| *other == label).map(|(c, _)| c.clone());
        terms.fold(Scalar::integer(0), |sum, c| &sum + &c)
    };
    let is = |mask, label, p, q| (&weight(mask, label) - &Scalar::constant(&ratio(p, q))).is_zero();
    let clark = &spaces(5)[1];
    let points = clark.scheme.child(5, 0);
    assert!(is(&points[0], 1, 13, 20) && is(&points[0], 2, 3, 50) && is(&points[0], 3, 1, 100));
    assert!(is(&points[3], 1, 3, 8) && is(&points[3], 4, 3, 8) && is(&points[3], 2, 1, 16));
    assert!(is(&points[2], 1, 1, 4) && is(&points[2], 3, 1, 4) && is(&points[2], 5, 0, 1));
    // The vertex point of y_5, at (2, 2), round the four faces of the lattice.
    assert!(is(&points[11], 5, 9, 16) && is(&points[11], 12, 1, 64) && is(&points[11], 1, 1, 64));
    assert!(is(&points[11], 4, 3, 32) && is(&points[11], 13, 3, 32));
    let sabin = &spaces(4)[3];
    let points = sabin.scheme.child(4, 0);
    assert!(is(&points[5], 1, 9, 16) && is(&points[5], 2, 3, 16) && is(&points[5], 5, 1, 16));
    assert!(is(&points[0], 1, 9, 16) && is(&points[0], 2, 3, 16) && is(&points[0], 3, 1, 16));
    // At n = 5: 1/4 + 5/(4n) = 1/2 at the corner itself, as c_1 + .. + c_4 = -1, but not identically.
    let own = weight(&spaces(5)[3].scheme.child(5, 0)[1], 2);
    let cosines = &Scalar::generator(1) + &Scalar::generator(2);
    assert!((&(&own + &cosines.scale(&ratio(1, 5))) - &Scalar::constant(&ratio(2, 5))).is_zero());
}

/// The label that the mirror exchanges with this one.
fn mirror(space: &Space, label: usize) -> usize {
    let n = space.n;
    let ring = |i: usize| 2 + (i + 2 * n - 2) % (2 * n);
    match (space.size - n, label) {
        (_, 1) => 1,
        (6, _) if label <= n + 1 => n + 3 - label,
        (6, _) => n + [2, 5, 6, 3, 4][label - n - 2],
        (5, _) if label <= n => n + 2 - label,
        (5, _) => n + [5, 4, 3, 2, 1][label - n - 1],
        _ if label <= 2 * n + 1 => ring(2 * n + 10 - label),
        _ => 2 * n + [2, 6, 7, 8, 3, 4, 5][label - 2 * n - 2],
    }
}

fn image(space: &Space, form: &Form) -> Form {
    let place = |label| &form.num[(mirror(space, label) - 1) * form.width..][..form.width];
    Form { num: (1..=space.size).flat_map(place).cloned().collect(), ..form.clone() }
}

#[test]
fn the_mirror_keeps_differences_up_to_their_sign() {
    for space in all() {
        for words in
            [(&[][..], &[][..]), (&[0, 0], &[0, 0]), (&[0, 1], &[0, 3]), (&[2, 2], &[2, 2])]
        {
            let forms = |word: &[u8]| -> Vec<Form> {
                let net = net(&space, word);
                space.differences(is_regular(word)).iter().map(|row| net.difference(row)).collect()
            };
            let others = forms(words.1);
            for form in forms(words.0) {
                let form = image(&space, &form);
                let same = |other: &&Form| {
                    [1, -1].iter().any(|&s| {
                        is_zero(&Form::mix(
                            space.size,
                            &[(ratio(1, 1), &form), (ratio(s, 1), other)],
                        ))
                    })
                };
                assert!(others.iter().any(|other| same(&other)), "n = {}, {words:?}", space.n);
            }
        }
    }
}

#[test]
fn the_mirror_exchanges_words_and_parameters() {
    for space in all() {
        for (mesh, level) in
            [(Mesh::Control, 0), (Mesh::Limit, 0), (Mesh::Control, 1), (Mesh::Limit, 1)]
        {
            let target = Target { mesh, level };
            for word in [&[0, 0, 1][..], &[0, 2, 1], &[0, 2, 3], &[0, 1, 0]] {
                let forms = |word: &[u8]| target.coefficients(&space, &mut Path::new(&space), word);
                let (Ok(forms), Ok(images)) = (forms(word), forms(&mirrored(word))) else {
                    assert!(mesh == Mesh::Limit && space.scheme.root() == 1);
                    continue;
                };
                let nodes = space.patch().nodes();
                for (form, [v, w]) in forms.iter().zip(&nodes) {
                    let at = nodes.iter().position(|[x, y]| (x, y) == (w, v)).unwrap();
                    assert_same(
                        form,
                        &image(&space, &images[at]),
                        &format!("n = {}, word {word:?}", space.n),
                    );
                }
            }
        }
    }
}

#[test]
fn affine_nets_are_reproduced_where_they_are_regular() {
    // Positions of the labels of Loop's net, about the face's corner 0; the others have theirs in `lattice`.
    let triangles = [
        (0, 0),
        (1, 0),
        (1, -1),
        (0, -1),
        (-1, 0),
        (-1, 1),
        (0, 1),
        (1, 1),
        (2, 0),
        (2, -1),
        (0, 2),
        (-1, 2),
    ];
    let inner = [(0, 0), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1), (-1, -1)];
    let outer = [(2, 2), (2, 1), (2, 0), (2, -1), (1, 2), (0, 2), (-1, 2)];
    let squares = [&inner[..], &outer].concat();
    let quads = [(0, 0), (0, -1), (-1, -1), (-1, 0), (1, -1), (1, 0), (1, 1), (0, 1), (-1, 1)];
    let cases = [
        (spaces(6).swap_remove(0), &triangles[..]),
        (spaces(4).swap_remove(1), &squares),
        (spaces(4).swap_remove(3), &quads),
    ];
    for (space, places) in cases {
        let net: Vec<_> = places.iter().map(|&(v, w)| (2 * v + 5 * w + 7).into()).collect();
        let vanishes = |form: &Form| form.at(&net, &1.into()).is_zero();
        let first = Net::first(&space);
        assert!(space.rows.iter().all(|row| vanishes(&first.difference(row))));
        for word in [&[0, 0, 1][..], &[0, 2, 3], &[0, 3, 0]] {
            for mesh in [Mesh::Control, Mesh::Limit] {
                let target = Target { mesh, level: 0 };
                let forms = target.coefficients(&space, &mut Path::new(&space), word);
                assert!(forms.into_iter().flatten().all(|form| vanishes(&form)));
            }
        }
    }
}

#[test]
fn the_ranks_are_those_of_the_format() {
    for n in 3..=26 {
        let second = match n % 4 {
            0 => 2 * n + 4,
            2 => 2 * n + 6,
            _ => 2 * n + 7,
        };
        let loops = if n % 6 == 0 { n + 3 } else { n + 5 };
        let ranks: Vec<_> = spaces(n).iter().map(|space| space.rank).collect();
        assert_eq!(ranks, [loops, second, 2 * n + 7, if n == 4 { 5 } else { n + 4 }]);
    }
}
