use super::*;
use crate::embedding::quarters;
use crate::patch::Patch;

fn number(p: i64, q: i64) -> Fixed {
    Fixed::ratio(p, q)
}

fn point([x, y]: [i64; 2], q: i64) -> Complex {
    Complex { re: number(x, q), im: number(y, q) }
}

/// The patch that is affine with these corners.
fn affine([a, b, c]: [Complex; 3]) -> Quartic {
    let nodes = Patch::Triangle.nodes();
    std::array::from_fn(|i| {
        let [v, w] = nodes[i].each_ref().map(Fixed::of);
        a + (b - a) * v + (c - a) * w
    })
}

/// The patch over a triangle, corners over 12.
fn part(corners: [[i64; 2]; 3]) -> Quartic {
    affine(corners.map(|corner| point(corner, 12)))
}

/// The facet (0,0), (1,0), (0,1), and that beyond x + y = 1 with the corner given.
fn facets(far: [i64; 2], across: Across) -> Vec<Facet> {
    let [o, a, b, far] = [[0, 0], [1, 0], [0, 1], far].map(|corner| point(corner, 1));
    let second = Facet::new([far, b, a], [Across::Facet(0), Across::Other, Across::Other]);
    vec![Facet::new([o, a, b], [across, Across::Ray, Across::Ray]), second]
}

/// Is a spline shown to stay below the bound over the part, with E = 0 on the first facet and x + y - 1 on the second?
fn shown(facets: Vec<Facet>, alone: bool, chi: &Quartic, e: &Quartic, bound: Fixed) -> bool {
    let (zero, quarters) = ([Complex::ZERO; 3], quarters(Patch::Triangle));
    let other = heights([Complex::real(Fixed::ONE), Complex::ZERO, Complex::ZERO]);
    let heights = vec![[zero, other].into_iter().take(facets.len()).collect()];
    let (failed, work) = (Vec::new(), 0);
    let bounds = vec![bound];
    let mut scene = Scene { facets, alone, heights, bounds, quarters: &quarters, failed, work };
    scene.show(chi, &[(0, *e)], 0);
    // Where it is shown, it is so without cutting the part small.
    assert!(!scene.failed.is_empty() || scene.work < 100, "{}", scene.work);
    scene.failed.is_empty()
}

const INSIDE: [[i64; 2]; 3] = [[1, 1], [5, 1], [1, 5]];
const ASTRIDE: [[i64; 2]; 3] = [[4, 4], [9, 4], [5, 9]];
const BEYOND: [[i64; 2]; 3] = [[7, 7], [8, 7], [7, 8]];

fn both() -> Vec<Facet> {
    facets([1, 1], Across::Facet(1))
}

#[test]
fn parts_are_to_lie_in_the_facets() {
    let zero = [Complex::ZERO; 15];
    let half = number(1, 2);
    for corners in [INSIDE, ASTRIDE, BEYOND] {
        assert!(shown(both(), false, &part(corners), &zero, half));
    }
    // The second facet is not in the list; it is folded back; the part touches neither.
    let first = || facets([1, 1], Across::Other).into_iter().take(1).collect::<Vec<_>>();
    assert!(shown(first(), false, &part(INSIDE), &zero, half));
    for alone in [false, true] {
        assert!(!shown(first(), alone, &part(ASTRIDE), &zero, half));
        assert!(!shown(first(), alone, &part(BEYOND), &zero, half));
    }
    let folded = facets([0, 0], Across::Facet(1));
    assert!(!shown(folded, false, &part(ASTRIDE), &zero, half));
    assert!(!shown(both(), false, &part([[20, 20], [21, 20], [20, 21]]), &zero, half));
}

#[test]
fn heights_are_tilted_to_the_worse_inside() {
    let (face, [one, none]) = (&both()[0], [Fixed::ONE, Fixed::ZERO]);
    let (chi, gaps) = (part(INSIDE), [Complex::real(one); 15]);
    let unit = Complex::real(one);
    assert!(outweighs(&gaps, unit, [one, none, one]));
    assert!(!outweighs(&gaps, -unit, [one, none, one]));
    assert!(!outweighs(&gaps, unit, [one, -one, one]));
    // e = 1, E = 0, T = 1: e - E + (T_0 + T_2) = 2 - T_1 = 2 - x.
    let heights = tilted(&[Complex::ZERO; 3], unit, [one, none, one]);
    for z in chi {
        let gap = face.gap(&heights, &face.areas(z), unit) - (unit + unit) + Complex::real(z.re);
        assert!(gap.norm().below(number(1, 1 << 60)));
    }
}

#[test]
fn a_kink_at_an_edge() {
    // e = 3/4 - x/2 - y/2 is 1/4 on the edge x + y = 1; over ASTRIDE it is 5/12 at most, at (1/3, 1/3), and beyond the
    // edge e - E = 7/4 - 3/2 (x + y) falls to 0 at x + y = 7/6, its least value.
    let chi = part(ASTRIDE);
    let value = |z: Complex| Complex::real(number(3, 4) - (z.re + z.im) * number(1, 2));
    let e = chi.map(value);
    assert!(shown(both(), false, &chi, &e, number(5001, 12000)));
    assert!(!shown(both(), false, &chi, &e, number(4999, 12000)));
    // e = x/2 + y/2: on the edge 1/2 is the largest value of e - E, which is a peak there.
    let e = chi.map(|z| Complex::real((z.re + z.im) * number(1, 2)));
    assert!(shown(both(), false, &chi, &e, number(5001, 10000)));
    assert!(!shown(both(), false, &chi, &e, number(4999, 10000)));
    // Turned by a right angle and negated.
    let e = e.map(|z| Complex { re: Fixed::ZERO, im: -z.re });
    assert!(!shown(both(), false, &chi, &e, number(4999, 10000)));
}

#[test]
fn values_at_points_of_a_patch() {
    // x^2 has the coefficients x_a x_b over pairs: that of index (i, j, k) is j (j - 1)/12.
    let squares: [i64; 15] = [0, 0, 0, 2, 0, 0, 6, 2, 0, 0, 12, 6, 2, 0, 0];
    let patch = squares.map(|c| Complex::real(number(c, 12)));
    let [lo, hi] = value(&patch, [number(1, 3), number(1, 5)]).re.ends().unwrap();
    let ninth = crate::rational::ratio(1, 9);
    assert!(lo <= ninth && ninth <= hi);
    // At a point of both facets, and beside it on one of them.
    let quarters = quarters(Patch::Triangle);
    let scene = |bound: Fixed| Scene {
        facets: both(),
        alone: false,
        heights: vec![vec![
            [Complex::ZERO; 3],
            heights([[1, 0], [0, 0], [0, 0]].map(|z| point(z, 1))),
        ]],
        bounds: vec![bound],
        quarters: &quarters,
        failed: Vec::new(),
        work: 0,
    };
    let (edge, e) = (point([1, 1], 2), Complex::real(number(1, 2)));
    assert!(scene(number(1, 2)).reaches(0, edge, e) && !scene(number(51, 100)).reaches(0, edge, e));
    // On the second facet E = 1/2 at (3/4, 3/4).
    let beyond = point([3, 3], 4);
    assert!(scene(number(1, 4)).reaches(0, beyond, Complex::real(number(3, 4))));
    assert!(!scene(number(1, 2)).reaches(0, beyond, Complex::real(number(3, 4))));
    // On neither.
    assert!(!scene(Fixed::ZERO).reaches(0, point([2, 2], 1), e));
}
