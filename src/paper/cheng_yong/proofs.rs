//! Certificates of what holds: constants that [`crate::bound`] proves, and inequalities with their
//! multipliers and a net that reaches them. What is violated has its own ([`super::violation`]).

use super::functional::Functional;
use super::norm::{Norm, Sup};
use super::printed;
use super::setting::{Setting, difference, grid_differences, phi, second_differences_of};
use super::violation::{Named, first_net_form, points_form, texts};
use crate::bound::{Against, Constant, Family};
use crate::certificate::{Certificate, Claim, Form, NetInequality, Step};
use crate::paper::proof::{Proof, constants};
use crate::scalar::{Decide, Rational};
use crate::scheme::IntegerRow;

const FIRST: Family = Family::CatmullClark(crate::bound::Norm::First);
const SECOND: Family = Family::CatmullClark(crate::bound::Norm::Second);

/// Those about regular patches.
pub fn of_regular() -> Vec<Proof> {
    let control = |k| Constant::Distance(Against::Control, k);
    constants(
        SECOND,
        super::regular::REGULAR,
        &[
            (control(0), &["lemma-2"]),
            (control(1), &["eq-6", "theorem-4", "theorem-4-strict"]),
            (
                Constant::MeshRate(1),
                &[
                    "lemma-3",
                    "eq-37",
                    "eq-38",
                    "eq-39",
                    "eq-40",
                    "eq-6",
                    "theorem-4",
                ],
            ),
        ],
    )
}

/// Those of a valence.
pub fn of(setting: &Setting) -> Vec<Proof> {
    let n = setting.n;
    let mut proofs = constants(
        FIRST,
        n,
        &[
            (
                Constant::Rate(1),
                &["lemma-5", "theorem-6", "fastest", "avoid-five"],
            ),
            (Constant::Rate(2), &["lemma-5", "fastest"]),
            (Constant::Rate(3), &["lemma-5", "fastest"]),
        ],
    );
    proofs.extend(constants(
        SECOND,
        n,
        &[
            (Constant::Rate(1), &["eq-26-second", "avoid-five"]),
            (Constant::Rate(2), &["eq-26-levels"]),
            (Constant::Rate(3), &["eq-26-levels"]),
            (
                Constant::Distance(Against::Control, 1),
                &["lemma-7", "theorem-9"],
            ),
        ],
    ));
    let of_set = |i: usize| -> Vec<Left> {
        let (centre, members) = phi(n, i);
        let others = members.into_iter().filter(|&j| j != centre);
        others
            .map(|j| left(setting, &difference(centre, j)))
            .collect()
    };
    let mut add = |claims, name: &str, lefts: &[Left], norm: &Norm| {
        let named = certificate(name, n, lefts, norm);
        proofs.extend(named.map(|named| Proof { named, claims }));
    };
    add(&["eq-45"], "eq-45", &of_set(0), &setting.norm(&[0]));
    add(&["eq-49"], "eq-49-true", &of_set(3), &setting.norm(&[0, 3]));
    add(&["eq-52-second"], "eq-52-true", &of_set(2), &setting.g);
    for estimate in &printed::APPENDIX_C {
        let form = setting.parse(estimate.left);
        let of = (points_form("0", &form), form.of(&setting.levels[1]));
        let claims: &'static [&'static str] = std::slice::from_ref(&estimate.id);
        add(claims, estimate.id, &[of], &setting.norm(estimate.norms));
    }
    for (i, claims) in BALLS.iter().enumerate() {
        let name = format!("ball-{i}");
        let members = phi(n, i).1;
        add(claims, &name, &ball(setting, &members), &setting.norm(&[i]));
    }
    let every: Vec<usize> = (1..=setting.size()).collect();
    add(&["eq-20"], "eq-20", &ball(setting, &every), &setting.g);
    add(
        &["eq-26", "lemma-7", "lemma-8", "theorem-9"],
        "eq-26",
        &third(setting),
        &setting.z,
    );
    for (text, (name, claims)) in printed::APPENDIX_D_EXCEPT.iter().zip(EXCEPTIONS) {
        let form = setting.parse(text);
        let of = (points_form("0", &form), form.of(&setting.levels[1]));
        add(claims, name, &[of], &setting.z);
    }
    proofs
}

/// The claims on the distance of the points of Φ_i from V_5^1.
const BALLS: [&[&str]; 4] = [
    &["phi-0-ball"],
    &["phi-others-ball"],
    &["phi-others-ball"],
    &["phi-others-ball"],
];

/// Names of the certificates on the printed exceptions of Appendix D, and the claims.
const EXCEPTIONS: [(&str, &[&str]); 3] = [
    (
        "across-v1",
        &["appendix-d", "appendix-d-first", "appendix-d-except"],
    ),
    (
        "across-v6",
        &[
            "appendix-d-second",
            "appendix-d-except",
            "appendix-d-similar",
        ],
    ),
    ("across-v4", &["appendix-d-except", "appendix-d-similar"]),
];

/// A left side: as a form of the net of a word, and as a functional of the first net.
type Left = (Form, Functional);

/// A row of the points of level 1.
fn left(setting: &Setting, row: &IntegerRow) -> Left {
    let form = Functional::of_row(row, setting.size());
    let of = form.of(&setting.levels[1]);
    (points_form("0", &form), of)
}

/// V_5^1, the mean of the face, less points of level 0.
fn ball(setting: &Setting, labels: &[usize]) -> Vec<Left> {
    let centre = &setting.levels[1][4];
    let form = |&j: &usize| {
        let of = centre.clone() - &setting.levels[0][j - 1];
        (points_form("", &of), of)
    };
    labels.iter().map(form).collect()
}

/// The second differences of Π_3^1.
fn third(setting: &Setting) -> Vec<Left> {
    let functionals = second_differences_of(&setting.third(1));
    let form = |[a, b, c]: [usize; 3]| {
        let row = IntegerRow::new([(b, 2), (a, -1), (c, -1)]);
        points_form("3", &Functional::of_row(&row, 16))
    };
    grid_differences()
        .into_iter()
        .map(form)
        .zip(functionals)
        .collect()
}

/// That the largest of the left sides is at most its supremum times the norm, and reaches it.
fn certificate(name: &str, n: u32, lefts: &[Left], norm: &Norm) -> Option<Named> {
    let mut right: Vec<Form> = Vec::new();
    // For each row its form and the sign before it.
    let mut places = Vec::new();
    for row in norm.rows() {
        let form = first_net_form(row);
        let sign = row.terms().first().map_or(1, |(_, a)| a.signum());
        let at = right.iter().position(|known| *known == form);
        places.push((at.unwrap_or(right.len()), sign));
        if at.is_none() {
            right.push(form);
        }
    }
    let mut multipliers = Vec::new();
    let mut best: Option<(Rational, usize, Vec<Rational>)> = None;
    for (j, (_, functional)) in lefts.iter().enumerate() {
        let Sup::Finite {
            value,
            net,
            multipliers: x,
        } = norm.sup(functional)
        else {
            return None;
        };
        let mut sums = vec![Rational::from_integer(0.into()); right.len()];
        for (x, &(at, sign)) in x.iter().zip(&places) {
            sums[at] += x * Rational::from_integer(sign.into());
        }
        let nonzero = sums
            .iter()
            .enumerate()
            .filter(|(_, x)| !num_traits::Zero::is_zero(*x));
        multipliers.push(nonzero.map(|(i, x)| (i, x.to_string())).collect());
        let larger = |(known, ..): &(Rational, usize, Vec<Rational>)| {
            value.decide(known) == Some(std::cmp::Ordering::Greater)
        };
        if best.as_ref().is_none_or(larger) {
            best = Some((value, j, net));
        }
    }
    let (factor, left, net) = best?;
    let claim = Claim::Inequality(NetInequality {
        scheme: "catmull-clark".into(),
        weights: None,
        valence: n,
        kind: "inequality".into(),
        left: lefts.iter().map(|(form, _)| form.clone()).collect(),
        factor: factor.to_string(),
        right,
    });
    let steps = vec![
        Step::Combined { multipliers },
        Step::Reached {
            left,
            net: texts(&net),
        },
    ];
    let file = format!("cheng-yong-{name}-n{n:02}.json");
    Some((file, Certificate::of_inequality(claim, None, steps)))
}
