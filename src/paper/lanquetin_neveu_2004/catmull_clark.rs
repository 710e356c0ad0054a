//! Catmull-Clark: Theorem 2 and Corollary 2.

use num_traits::Zero;

use super::catmull_clark_masks::{self, printed_limit};
use super::nets::{
    combine, distance_form, integer, integers, norm, ratio, row_form, texts, violation,
};
use super::printed;
use crate::bernstein::from_net::bicubic;
use crate::bernstein::tensor::Tensor;
use crate::certificate::Certificate;
use crate::lp::Rows;
use crate::paper::words::{DIGITS, claim, ranges};
use crate::paper::{Claim, Counterexample, Enclosure, Verdict};
use crate::scalar::Rational;
use crate::scheme::{IntegerRow, Tile, catmull_clark};

const NAME: &str = "catmull-clark";

/// The second differences along the rows and columns of a 4 x 4 grid.
fn grid_differences() -> Vec<IntegerRow> {
    let line = |start: usize, step: usize| {
        (0..2).map(move |i| {
            let at = |k: usize| start + (i + k) * step;
            IntegerRow::new([(at(0), -1), (at(1), 2), (at(2), -1)])
        })
    };
    (0..4)
        .flat_map(|k| line(4 * k, 1).chain(line(k, 4)))
        .collect()
}

/// sup |S - L| / M over a regular patch by the hull of the coefficients, at the corner, and sup M_1 / M.
fn regular() -> Option<[Rational; 3]> {
    let rows = Rows::new(grid_differences(), 16);
    let unit = |i: usize| -> [Rational; 16] { std::array::from_fn(|j| integer(i64::from(i == j))) };
    let difference = |p: &[Rational; 16]| {
        let mut surface = bicubic::<Rational, Rational>(p);
        let corners = [5, 6, 10, 9].map(|i: usize| p[i].clone());
        surface.subtract::<Rational>(&Tensor::from_bilinear::<Rational>(&corners));
        surface.0
    };
    let columns: Vec<[Rational; 16]> = (0..16).map(|i| difference(&unit(i))).collect();
    let mut values = Vec::new();
    for k in 0..16 {
        let t: Vec<Rational> = columns.iter().map(|c| c[k].clone()).collect();
        values.push(norm(&rows, &t)?.0);
    }
    let corner = values[0].clone();
    let hull = values.into_iter().fold(Rational::zero(), Rational::max);
    let rows = Rows::new(catmull_clark::second_differences(4), 16);
    let mut rate = Rational::zero();
    for t in fine_differences(4) {
        rate = rate.max(norm(&rows, &t)?.0);
    }
    Some([hull, corner, rate])
}

/// The second differences of the four parts' nets after one step.
fn fine_differences(n: u32) -> Vec<Vec<Rational>> {
    let matrix = catmull_clark::subdivision_matrix::<Rational>(n);
    let mut all: Vec<Vec<Rational>> =
        differences_of(&catmull_clark::second_differences(n), &matrix);
    for tile in Tile::ALL {
        let matrix = catmull_clark::tile_matrix::<Rational>(n, tile);
        all.extend(differences_of(&grid_differences(), &matrix));
    }
    all
}

fn differences_of(rows: &[IntegerRow], matrix: &nalgebra::DMatrix<Rational>) -> Vec<Vec<Rational>> {
    let terms = |r: &IntegerRow| -> Vec<(usize, Rational)> {
        r.terms().iter().map(|&(i, c)| (i, integer(c))).collect()
    };
    rows.iter().map(|r| combine(matrix, terms(r))).collect()
}

/// The deepest level at which Theorem 2 is tried.
const DEEPEST: u32 = 8;

/// `4^-i / 3`.
fn printed_at(level: u32) -> Rational {
    let quarter = ratio(printed::QUARTER.0, printed::QUARTER.1);
    ratio(printed::THEOREM_2.0, printed::THEOREM_2.1) * quarter.pow(level as i32)
}

/// The functional t of the refined net, as one of the net.
fn apply(t: &[Rational], matrix: &nalgebra::DMatrix<Rational>) -> Vec<Rational> {
    combine(matrix, t.iter().cloned().enumerate())
}

/// What Theorem 2 says near a vertex of valence N, M over all 2N + 10 differences of the local net.
struct Extraordinary {
    n: u32,
    /// The first level i at which sup |S - L^i| / M at the vertex exceeds `4^-i / 3`: i, the value, the net.
    vertex: Option<(u32, Rational, Vec<Rational>)>,
    /// sup M_1 / M over the net round the vertex: the difference, from 0, the value, the net.
    rate: (usize, Rational, Vec<Rational>),
}

impl Extraordinary {
    fn of(n: u32) -> Option<Self> {
        let rows = Rows::new(
            catmull_clark::second_differences(n),
            catmull_clark::local_net_size(n),
        );
        let mut limit = vec![Rational::zero(); rows.size()];
        for (i, weight) in printed_limit(n) {
            limit[i] += weight;
        }
        let matrix = catmull_clark::subdivision_matrix::<Rational>(n);
        let mut vertex = None;
        // The point of level i at the vertex, as a functional of the first net.
        let mut point = vec![Rational::zero(); rows.size()];
        point[0] = integer(1);
        for level in 0..=DEEPEST {
            let t: Vec<Rational> = limit.iter().zip(&point).map(|(l, p)| l - p).collect();
            let (value, net) = norm(&rows, &t)?;
            if value > printed_at(level) {
                vertex = Some((level, value, net));
                break;
            }
            point = apply(&point, &matrix);
        }
        let mut rate: Option<(usize, Rational, Vec<Rational>)> = None;
        for (l, t) in differences_of(rows.rows(), &matrix).iter().enumerate() {
            let (value, net) = norm(&rows, t)?;
            if rate.as_ref().is_none_or(|known| value > known.1) {
                rate = Some((l, value, net));
            }
        }
        Some(Extraordinary {
            n,
            vertex,
            rate: rate?,
        })
    }

    fn certificates(&self) -> Vec<(String, Certificate)> {
        let rows = catmull_clark::second_differences(self.n);
        let right = || rows.iter().map(|r| row_form("", r)).collect::<Vec<_>>();
        let place = (NAME, None, self.n);
        let mut files = Vec::new();
        if let Some((level, _, net)) = &self.vertex {
            let word = "0".repeat(*level as usize);
            let left = distance_form(&word, *level as usize, [0, 0]);
            files.push((
                format!("lanquetin-neveu-theorem-2-distance-n{:02}.json", self.n),
                violation(place, left, &printed_at(*level), right(), net, None),
            ));
        }
        let quarter = ratio(printed::QUARTER.0, printed::QUARTER.1);
        if self.rate.1 > quarter {
            let left = row_form("0", &rows[self.rate.0]);
            files.push((
                format!("lanquetin-neveu-theorem-2-rate-n{:02}.json", self.n),
                violation(place, left, &quarter, right(), &self.rate.2, None),
            ));
        }
        files
    }
}

/// The claims on Catmull-Clark surfaces, and certificates.
pub fn claims(valences: &[u32]) -> (Vec<Claim>, Vec<(String, Certificate)>) {
    let mut claims = catmull_clark_masks::claims(valences);
    let third = ratio(printed::THEOREM_2.0, printed::THEOREM_2.1);
    let quarter = ratio(printed::QUARTER.0, printed::QUARTER.1);
    let regular = regular();
    let sharp = regular
        .as_ref()
        .map(|[hull, corner, rate]| *hull == third && *corner == third && *rate == quarter);
    let on_regular = match sharp {
        Some(true) => Verdict::Sharp,
        other => Verdict::of(other),
    };
    let values = regular.map_or("a program has no solution".into(), |[hull, corner, rate]| {
        format!(
            "sup |L - S| / M = {hull}, taken at a control vertex ({corner}); sup M_1 / M_0 = {rate}: exact \
             linear programs. The net i^2 + j^2 attains all at every level"
        )
    });
    let statement = "|L_p(u, v) - S_p(u, v)| <= M_i / 3 <= 4^-i M_0 / 3";
    claims.push(claim(
        "theorem-2-regular",
        "Theorem 2, (7)",
        format!("{statement}, on regular patches."),
        on_regular,
        values.clone(),
        "N = 4",
    ));
    claims.push(claim(
        "corollary-2-regular",
        "Corollary 2",
        "Within ε after i steps if i >= log_4(M_0 / 3ε), on regular patches.",
        on_regular,
        "follows from the theorem; no smaller depth serves all regular nets",
        "N = 4",
    ));
    let irregular: Vec<Extraordinary> = valences
        .iter()
        .filter(|&&n| n != 4)
        .filter_map(|&n| Extraordinary::of(n))
        .collect();
    let certificates: Vec<_> = irregular.iter().flat_map(|e| e.certificates()).collect();
    let far: Vec<&Extraordinary> = irregular.iter().filter(|e| e.vertex.is_some()).collect();
    let slow: Vec<&Extraordinary> = irregular.iter().filter(|e| e.rate.1 > quarter).collect();
    let list = |of: &[&Extraordinary], value: &dyn Fn(&Extraordinary) -> String| {
        let texts: Vec<String> = of
            .iter()
            .map(|e| format!("N = {}: {}", e.n, value(e)))
            .collect();
        texts.join(", ")
    };
    let scope = format!(
        "N = {}; M over all 2N + 10 second differences of the local net, which is more than (7) names: \
         differences across the vertex, edge neighbours two apart, count too",
        ranges(irregular.iter().map(|e| e.n))
    );
    let names = |part: &str| -> Vec<String> {
        let names = certificates.iter().map(|(name, _)| name);
        names.filter(|name| name.contains(part)).cloned().collect()
    };
    let witness = slow.first().map(|e| Counterexample {
        valence: e.n,
        net: texts(&e.rate.2),
        what: format!(
            "M = 1 and a second difference of the refined net is {}",
            e.rate.1
        ),
    });
    let either = !far.is_empty() || !slow.is_empty();
    claims.push(Claim {
        counterexample: witness.clone(),
        certificates: names("theorem-2"),
        ..claim(
            "theorem-2",
            "Theorem 2, (7)",
            format!("{statement}, for Catmull-Clark surfaces."),
            Verdict::of(Some(!either)),
            format!(
                "M_1 <= M_0 / 4 fails: sup M_1 / M_0 round the vertex is {}. |L - S| <= 4^-i M_0 / 3 fails at \
                 the vertex itself: {}",
                list(&slow, &|e| e.rate.1.to_string()),
                list(&far, &|e| e.vertex.as_ref().map_or("?".into(), |(level, value, _)| {
                    format!("{} at i = {level}", Enclosure::exactly(value.clone()).decimal(DIGITS))
                }))
            ),
            scope.clone(),
        )
    });
    claims.push(Claim {
        counterexample: witness,
        certificates: names("theorem-2-distance"),
        ..claim(
            "corollary-2",
            "Corollary 2",
            "Within ε after i steps if i >= log_4(M_0 / 3ε), for Catmull-Clark surfaces.",
            Verdict::of(Some(far.is_empty())),
            format!(
                "with M_0 / 3ε = 4^i the corollary asks for i steps, and at the vertex |L - S| > ε after them, \
                 at the levels i named under theorem-2: N = {}",
                ranges(far.iter().map(|e| e.n))
            ),
            scope,
        )
    });
    (claims, certificates)
}

/// Whether control vertices are farthest on a regular patch: the net i^2 - j^2.
pub fn saddle() -> (Vec<Rational>, [Rational; 5], Certificate) {
    let lattice = |i: i64, j: i64| i * i - j * j;
    let mut net = vec![0; 16];
    for i in -1..=2 {
        for j in -1..=2 {
            let label = match (i, j) {
                (-1, -1) => Some(9),
                _ => catmull_clark::lattice_label(4, i, j),
            };
            if let Some(label) = label {
                net[label - 1] = lattice(i64::from(i), i64::from(j));
            }
        }
    }
    let net = integers(&net);
    let grid: [Rational; 16] =
        std::array::from_fn(|at| integer(lattice((at % 4) as i64 - 1, (at / 4) as i64 - 1)));
    let mut surface = bicubic::<Rational, Rational>(&grid);
    let corners = [5, 6, 10, 9].map(|i: usize| grid[i].clone());
    surface.subtract::<Rational>(&Tensor::from_bilinear::<Rational>(&corners));
    let c = &surface.0;
    // At the middle of the edge v = 0: (c_0 + 3 c_1 + 3 c_2 + c_3) / 8.
    let middle = (&c[0] + (&c[1] + &c[2]) * integer(3) + &c[3]) * ratio(1, 8);
    let values = [
        middle,
        c[0].clone(),
        c[3].clone(),
        c[15].clone(),
        c[12].clone(),
    ];
    let right = [("", [0, 0]), ("1", [1, 0]), ("2", [1, 1]), ("3", [0, 1])];
    let right = right.map(|(word, at)| distance_form(word, 0, at)).to_vec();
    let left = distance_form("1", 0, [0, 0]);
    let certificate = violation(
        (NAME, None, 4),
        left,
        &integer(1_000_000),
        right,
        &net,
        None,
    );
    (net, values, certificate)
}
