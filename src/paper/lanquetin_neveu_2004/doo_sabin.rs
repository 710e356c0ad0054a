//! Doo-Sabin: Theorem 5, its printed proof, Corollary 5, and the remark on valence 4.

use num_traits::{Signed, Zero};

use super::nets::{
    at, combine, distance_form, integer, integers, largest, norm, ratio, row_form, texts, violation,
};
use super::printed;
use crate::bernstein::from_net::biquadratic;
use crate::bernstein::tensor::Tensor;
use crate::certificate::Certificate;
use crate::lp::Rows;
use crate::paper::words::{all, claim, ranges};
use crate::paper::{Claim, Counterexample, Verdict};
use crate::scalar::{Cyclotomic, Field, Rational};
use crate::scheme::{IntegerRow, Tile, doo_sabin};

const NAME: &str = "doo-sabin";

/// The second differences of (11) along the straight lines of three vertices of a local net.
fn differences(n: u32) -> Vec<IntegerRow> {
    let n = n as usize;
    let lines = [
        [2, 1, n + 4],
        [n, 1, n + 2],
        [3, 2, n + 1],
        [n - 1, n, n + 5],
        [n + 1, n + 2, n + 3],
        [n + 5, n + 4, n + 3],
    ];
    let row = |[a, b, c]: [usize; 3]| IntegerRow::new([(a - 1, 1), (b - 1, -2), (c - 1, 1)]);
    lines.map(row).to_vec()
}

/// The values of i and j on the lattice of a regular local net as a function of both.
fn lattice(value: impl Fn(i64, i64) -> i64) -> Vec<Rational> {
    let mut net = vec![0; 9];
    for (at, label) in doo_sabin::REGULAR_LABELS.iter().enumerate() {
        net[label - 1] = value((at % 3) as i64 - 1, (at / 3) as i64 - 1);
    }
    integers(&net)
}

/// S - L over the quarter at h of a regular net, as Bernstein coefficients.
fn quarter(net: &[Rational]) -> Option<[Rational; 9]> {
    let extended = doo_sabin::extended_net::<Rational, Rational>(4, net)?;
    let points = doo_sabin::tile_net(4, Tile::Second, &extended);
    let mut surface = biquadratic::<Rational, Rational>(&points);
    let half = |a: usize| (&net[0] + &net[a - 1]) * ratio(1, 2);
    let [_, h, _] = doo_sabin::quads(4);
    let centroid = h.iter().fold(Rational::zero(), |sum, &i| sum + &net[i - 1]) * ratio(1, 4);
    let corners = [net[0].clone(), half(6), centroid, half(8)];
    surface.subtract::<Rational>(&Tensor::from_bilinear::<Rational>(&corners));
    Some(surface.0)
}

/// sup |S - L| / M by the hull, at the vertex, and sup M_1 / M_0, on regular nets.
fn regular() -> Option<[Rational; 3]> {
    let rows = Rows::new(differences(4), 9);
    let unit = |i: usize| {
        (0..9)
            .map(|j| integer(i64::from(i == j)))
            .collect::<Vec<_>>()
    };
    let columns: Vec<[Rational; 9]> = (0..9).map(|i| quarter(&unit(i))).collect::<Option<_>>()?;
    let mut values = Vec::new();
    for k in 0..9 {
        let t: Vec<Rational> = columns.iter().map(|c| c[k].clone()).collect();
        values.push(norm(&rows, &t)?.0);
    }
    let vertex = values[0].clone();
    let hull = values.into_iter().fold(Rational::zero(), Rational::max);
    let mut rate = Rational::zero();
    let mut tiles: Vec<_> = Vec::new();
    for tile in Tile::ALL {
        tiles.push(doo_sabin::tile_matrix::<Rational>(4, tile)?);
    }
    for matrix in &tiles {
        for line in grid() {
            let terms = line.terms().iter().map(|&(i, c)| (i, integer(c)));
            rate = rate.max(norm(&rows, &combine(matrix, terms))?.0);
        }
    }
    Some([hull, vertex, rate])
}

/// The second differences of a 3 x 3 grid.
fn grid() -> Vec<IntegerRow> {
    let line = |start: usize, step: usize| {
        IntegerRow::new([(start, 1), (start + step, -2), (start + 2 * step, 1)])
    };
    (0..3).flat_map(|k| [line(3 * k, 1), line(k, 3)]).collect()
}

fn theorem() -> Vec<Claim> {
    let constant = ratio(printed::THEOREM_5.0, printed::THEOREM_5.1);
    let rate_printed = ratio(printed::QUARTER.0, printed::QUARTER.1);
    let found = regular();
    let sharp = found.as_ref().map(|[hull, vertex, rate]| {
        *hull == constant && *vertex == constant && *rate == rate_printed
    });
    let verdict = match sharp {
        Some(true) => Verdict::Sharp,
        other => Verdict::of(other),
    };
    let values = found.map_or("a program has no solution".into(), |[hull, vertex, rate]| {
        format!(
            "sup |L - S| / M = {hull}, taken at a control vertex ({vertex}); sup M_1 / M_0 = {rate}: exact \
             linear programs. The net i^2 + j^2 attains all at every level"
        )
    });
    let scope = "regular nets: faces of four sides, vertices of valence 4; L and S matched at vertices, \
                 edge midpoints and centroids";
    vec![
        claim(
            "theorem-5",
            "Theorem 5, (11)",
            "|L_p(u, v) - S_p(u, v)| <= M_i / 4 <= 4^-i M_0 / 4.",
            verdict,
            values,
            scope,
        ),
        claim(
            "corollary-5",
            "Corollary 5",
            "Within ε after i steps if i >= log_4(M_0 / 4ε).",
            verdict,
            "follows from the theorem, with >=; no smaller depth serves all regular nets",
            scope,
        ),
    ]
}

/// The displayed steps of the printed proof.
fn proof() -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let saddle = lattice(|i, j| i * i - j * j);
    let plane = lattice(|i, _| i);
    // The corner (1, 0) of the quarter at h is the middle of the edge from the vertex to (1, 0).
    let (vertex, middle) = match quarter(&saddle) {
        Some(c) => (c[0].clone(), c[2].clone()),
        None => (Rational::zero(), Rational::zero()),
    };
    let first = vertex.is_zero() && !middle.is_zero();
    let name = "lanquetin-neveu-theorem-5-proof.json".to_string();
    // A certificate's words lie in the quarter 0: there the vertex is the corner (1, 1), and (1, 0) the
    // middle of the edge to (0, -1).
    let certificate = violation(
        (NAME, None, 4),
        distance_form("01", 0, [1, 0]),
        &integer(1_000_000),
        vec![distance_form("02", 0, [1, 1])],
        &saddle,
        None,
    );
    // S at that point is L plus the difference; the net of the plane has M = 0.
    let at_middle = quarter(&plane).map(|c| {
        let [_, middle] = [0, 5].map(|i: usize| plane[i].clone());
        (&plane[0] + middle) * ratio(1, 2) + &c[2] - &plane[0]
    });
    let m = largest(&differences(4), &plane);
    let second = m.is_zero() && at_middle.as_ref().is_some_and(|d| !d.is_zero());
    // One row of second difference 1, the lowest of second difference 0.
    let one_row = lattice(|i, j| if j == 0 && i == 1 { 1 } else { 0 });
    let fine = doo_sabin::extended_net::<Rational, Rational>(4, &one_row).unwrap_or_default();
    let level_1 = |i: i32, j: i32| {
        let label = match (i, j) {
            (-1, -1) => Some(3),
            _ => doo_sabin::lattice_label(4, i, j),
        };
        label
            .and_then(|l| fine.get(l - 1))
            .cloned()
            .unwrap_or_else(Rational::zero)
    };
    // Rows of the 4 x 4 level-1 net: j = -1 is its lowest, from the rows -1 (3/4) and 0 (1/4) of level 0.
    let left = level_1(-1, -1) - level_1(0, -1) * integer(2) + level_1(1, -1);
    let row_minus_1 = at(
        &lattice(|i, j| {
            if j == -1 {
                [1, -2, 1][(i + 1) as usize]
            } else {
                0
            }
        }),
        &one_row,
    );
    let third = left.clone() * integer(4) != row_minus_1;
    let places = [
        (
            "theorem-5-proof-vertex",
            "|L(u, v) - S(u, v)| <= d(P_11, M^∞) = |P_11 - S(u, v)|, \"because the scheme is approximating\".",
            first,
            saddle,
            format!(
                "the net i^2 - j^2: the vertex P_11 lies on S (displacement {vertex}), and |L - S| = {} at \
                 the middle of an edge",
                middle.abs()
            ),
        ),
        (
            "theorem-5-proof-rows",
            "|P_11 - S(u, v)| <= |P_01 - 2 P_11 + P_21| / 8 + M_0 / 8 <= M_0 / 4 for all (u, v).",
            second,
            plane,
            format!(
                "the plane i: M_0 = {m} and |P_11 - S| = {} at the middle of an edge. The step holds at \
                 u = v = 1/2 only",
                at_middle.map_or("?".into(), |d| d.abs().to_string())
            ),
        ),
        (
            "theorem-5-proof-equality",
            "|P^1_(0,l) - 2 P^1_(1,l) + P^1_(2,l)| = |P^0_(0,l) - 2 P^0_(1,l) + P^0_(2,l)| / 4, l = 0, and so on.",
            third,
            one_row,
            format!(
                "the left side mixes two rows, 3/4 and 1/4: here it is {left}, the right side {}. As an \
                 inequality with the larger of the two rows it holds; P^0_(k,3) is not in the net at all",
                row_minus_1 * ratio(1, 4)
            ),
        ),
    ];
    let claims = places
        .into_iter()
        .map(|(id, statement, refuted, net, what)| Claim {
            counterexample: Some(Counterexample {
                valence: 4,
                net: texts(&net),
                what: what.clone(),
            }),
            certificates: match id {
                "theorem-5-proof-vertex" => vec![name.clone()],
                _ => Vec::new(),
            },
            ..claim(
                id,
                "proof of Theorem 5",
                statement,
                Verdict::of(Some(!refuted)),
                what,
                "regular nets; the theorem itself is true",
            )
        });
    (claims.collect(), vec![(name.clone(), certificate)])
}

/// A net round an n-gon whose six second differences vanish: y_3 = y_(n-1) = 1, and beyond.
fn round_a_polygon(n: u32) -> Vec<Rational> {
    let size = n as usize;
    if n == 3 {
        return integers(&[0, 1, 1, 1, -1, -3, -1, 1]);
    }
    let mut net = vec![0; doo_sabin::local_net_size(n)];
    net[2] = 1;
    net[size - 2] = 1;
    for (label, value) in [(1, -1), (3, 1), (5, -1)] {
        net[size + label - 1] = value;
    }
    integers(&net)
}

/// S less the vertex at the middle of its part of the surface: the mean of the four new corners at y_1.
fn at_vertex(n: u32, net: &[Rational]) -> Option<Cyclotomic> {
    let net: Vec<Cyclotomic> = net.iter().map(Cyclotomic::from_rational).collect();
    let fine = doo_sabin::extended_net::<Cyclotomic, Cyclotomic>(n, &net)?;
    let size = n as usize;
    let sum = [1, size + 2, size + 3, size + 4]
        .iter()
        .fold(Cyclotomic::from_rational(&Rational::zero()), |sum, &l| {
            sum + &fine[l - 1]
        });
    Some(sum * &Cyclotomic::ratio(1, 4) - &net[0])
}

/// "This is not a restriction".
fn restriction(sides: &[u32]) -> (Claim, Vec<(String, Certificate)>) {
    let mut files = Vec::new();
    let mut witness = None;
    let truths: Vec<(u32, Option<bool>)> = sides
        .iter()
        .map(|&n| {
            let net = round_a_polygon(n);
            let m = largest(&differences(n), &net);
            let moved = at_vertex(n, &net);
            let refuted = moved.as_ref().map(|d| m.is_zero() && d.signum() != 0);
            // Certificates where all cosines of the mask are rational.
            let exact = moved
                .filter(|_| matches!(n, 3 | 6))
                .and_then(|d| d.to_rational());
            if let (Some(true), Some(exact)) = (refuted, exact) {
                let right = differences(n).iter().map(|r| row_form("", r)).collect();
                let name = format!("lanquetin-neveu-theorem-5-polygon-n{n:02}.json");
                let left = distance_form("02", 0, [1, 1]);
                let place = (NAME, None, n);
                files.push((
                    name,
                    violation(place, left, &integer(1_000_000), right, &net, None),
                ));
                witness.get_or_insert_with(|| Counterexample {
                    valence: n,
                    net: texts(&net),
                    what: format!(
                        "all six second differences are {m}, and |L - S| = {} at the vertex",
                        exact.abs()
                    ),
                });
            }
            (n, refuted.map(|r| !r))
        })
        .collect();
    let claim = Claim {
        counterexample: witness,
        certificates: files.iter().map(|(name, _)| name.clone()).collect(),
        ..claim(
            "not-a-restriction",
            "sections 3.2.2, 4",
            "Regular valence is not a restriction of Theorem 5, because after one step the valence of any \
             vertex is four.",
            Verdict::of(all(truths.iter().map(|t| t.1))),
            "Theorem 5 needs faces of four sides as well. Faces keep their numbers of sides, and vertices of \
             valence n become faces of n sides: beside such a face a net can have M = 0 and |L - S| > 0, so \
             that no constant replaces the 1/4",
            format!(
                "faces of n sides, n = {}",
                ranges(truths.iter().map(|t| t.0))
            ),
        )
    };
    (claim, files)
}

/// The claims on Doo-Sabin surfaces, and certificates.
pub fn claims(sides: &[u32]) -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let mut claims = theorem();
    let (steps, mut certificates) = proof();
    claims.extend(steps);
    let irregular: Vec<u32> = sides.iter().copied().filter(|&n| n != 4).collect();
    let (remark, files) = restriction(&irregular);
    claims.push(remark);
    certificates.extend(files);
    (claims, certificates)
}

/// The net i^2 - j^2, S - L at its vertex and at the middle of an edge.
pub fn saddle() -> Option<[Rational; 2]> {
    let net = lattice(|i, j| i * i - j * j);
    let c = quarter(&net)?;
    Some([c[0].clone(), c[2].clone()])
}
