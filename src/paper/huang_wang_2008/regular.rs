//! Section 3: regular patches. The matrix T, δ_i, the bound function, Theorems 1 and 2.

use num_traits::Zero;

use super::nets::{radial, regular_coefficients};
use super::printed;
use super::valence::Valence;
use crate::bernstein::Patch;
use crate::bernstein::conversion::{BOX_SPLINE_DENOMINATOR, BOX_SPLINE_ROWS};
use crate::bernstein::triangle::{QuarticTriangle, index};
use crate::paper::words::claim;
use crate::paper::{Claim, Counterexample, Verdict};
use crate::scalar::{Field, Rational, Ring};

const SCOPE: &str = "regular patches (n = 6)";

fn integer(k: i64) -> Rational {
    <Rational as Ring>::from_integer(k)
}

/// δ_1 .. δ_15 as exact rationals, where both sides met.
fn deltas(regular: &Valence) -> Option<[Rational; 15]> {
    let exact = regular
        .deltas
        .as_ref()?
        .iter()
        .map(|delta| delta.exact.as_ref()?.to_rational());
    exact.collect::<Option<Vec<_>>>()?.try_into().ok()
}

/// The printed polynomial of Theorem 1 in Bernstein form of degree 4: `v^j w^k` has the coefficient
/// `binom(J, j) binom(K, k) / (4! / (j! k! (4-j-k)!))` at (J, K).
fn printed_bound_function() -> [Rational; 15] {
    let factorial = |k: usize| (1..=k as i64).product::<i64>();
    let binomial = |a: usize, b: usize| match b > a {
        true => 0,
        false => factorial(a) / factorial(b) / factorial(a - b),
    };
    let mut form = [const { None }; 15];
    for row in 0..=4 {
        for k in 0..=row {
            let j = row - k;
            let terms = printed::BOUND_FUNCTION.iter().map(|&(c, a, b)| {
                let all = factorial(4) / factorial(a) / factorial(b) / factorial(4 - a - b);
                Rational::ratio(c * binomial(j, a) * binomial(k, b), all)
            });
            form[index(j, k)] = Some(terms.fold(Rational::zero(), |sum, term| sum + term));
        }
    }
    form.map(|c| c.expect("every index is met"))
}

/// Whether the radial net attains all the numbers at once, with one sign.
fn radial_attains(deltas: &[Rational; 15]) -> bool {
    let net: Vec<Rational> = radial(6).into_iter().map(integer).collect();
    let values = regular_coefficients(&net);
    let with = |sign: i64| {
        values
            .iter()
            .zip(deltas)
            .all(|(v, d)| *v == d * integer(sign))
    };
    with(1) || with(-1)
}

/// The claims of section 3.
pub fn claims(regular: &Valence) -> Vec<Claim> {
    let deltas = deltas(regular);
    let printed_deltas = printed::DELTAS_IN_TWELFTHS.map(|p| Rational::ratio(p, 12));
    let agree = deltas.as_ref().map(|deltas| *deltas == printed_deltas);
    let attained = deltas.as_ref().map(radial_attains);
    let sharp = |truth: Option<bool>| match truth {
        Some(true) => Verdict::Sharp,
        other => Verdict::of(other),
    };
    let both = |a: Option<bool>, b: Option<bool>| Some(a? && b?);
    let matrix = BOX_SPLINE_DENOMINATOR == 24 && BOX_SPLINE_ROWS == printed::T_TIMES_24;
    let text = |d: &[Rational; 15]| {
        d.iter()
            .map(Rational::to_string)
            .collect::<Vec<_>>()
            .join(", ")
    };
    let form = printed_bound_function();
    let function = deltas.as_ref().map(|deltas| *deltas == form);
    let net = Counterexample {
        valence: 6,
        net: radial(6).iter().map(i64::to_string).collect(),
        what: "all second differences are -1 and S - F̄ = -B(v, w) identically".into(),
    };
    vec![
        claim(
            "matrix-t",
            "Appendix 1",
            "The matrix T takes the 12 control points of a regular patch to its 15 Bézier points.",
            Verdict::of(Some(matrix)),
            match matrix {
                true => "all 180 entries agree with those derived from the subdivision rules",
                false => "entries differ from those derived from the subdivision rules",
            },
            SCOPE,
        ),
        Claim {
            counterexample: attained.filter(|&a| a).map(|_| net.clone()),
            certificates: regular
                .deltas
                .iter()
                .flatten()
                .map(|d| d.file.clone())
                .collect(),
            ..claim(
                "deltas",
                "(6)",
                format!(
                    "The smallest δ_i with |b_i - b̄_i| <= δ_i M are {}.",
                    text(&printed_deltas)
                ),
                sharp(agree),
                match &deltas {
                    Some(deltas) => format!(
                        "fifteen linear programs, each with its dual net: {}{}",
                        text(deltas),
                        match attained {
                            Some(true) => "; one net attains all of them, with one sign",
                            _ => "",
                        }
                    ),
                    None => "not all were proved exactly".into(),
                },
                SCOPE,
            )
        },
        claim(
            "three-programs",
            "section 3.2",
            "By symmetry three of the fifteen programs suffice.",
            Verdict::of(deltas.as_ref().map(symmetric)),
            "δ_i is the same along each orbit of the triangle's symmetries, and 0 at the corners",
            SCOPE,
        ),
        claim(
            "bound-function",
            "section 3.2",
            "Σ δ_i B_i(v, w) = v + w - v^2 - v w - w^2.",
            Verdict::of(function),
            "compared coefficient by coefficient in Bernstein form of degree 4",
            SCOPE,
        ),
        Claim {
            counterexample: attained.filter(|&a| a).map(|_| net),
            ..claim(
                "theorem-1",
                "Theorem 1",
                "|S(v, w) - F̄(v, w)| <= (v + w - v^2 - v w - w^2) M.",
                sharp(both(both(agree, function), attained)),
                match attained {
                    Some(true) => "best possible at every (v, w) at once, by one net",
                    _ => "no net was found that attains it",
                },
                SCOPE,
            )
        },
        theorem_2(regular, &form),
    ]
}

/// Whether δ depends only on the orbit of (i, j, k) under permutations.
fn symmetric(deltas: &[Rational; 15]) -> bool {
    let at = |j: usize, k: usize| &deltas[index(j, k)];
    (0..=4).all(|row| {
        (0..=row).all(|k| {
            let (i, j) = (4 - row, row - k);
            let orbit = [at(j, k), at(k, j), at(i, k), at(k, i), at(i, j), at(j, i)];
            orbit.iter().all(|delta| *delta == orbit[0])
        })
    }) && at(0, 0).is_zero()
}

fn theorem_2(regular: &Valence, form: &[Rational; 15]) -> Claim {
    let (value, [v, w]) = printed::THEOREM_2_IN_THIRDS;
    let third = |p: i64| Rational::ratio(p, 3);
    let (at_point, _) = QuarticTriangle(form.clone()).evaluate([&third(v), &third(w)]);
    let limit = regular.limit[0].as_ref();
    let exact = limit.and_then(|limit| limit.exact.as_ref()?.to_rational());
    let truth = exact
        .as_ref()
        .map(|b| *b == third(value) && at_point == third(value));
    Claim {
        certificates: limit.map(|limit| limit.file.clone()).into_iter().collect(),
        ..claim(
            "theorem-2",
            "Theorem 2",
            "|S - F̄| <= M / 3, the maximum of B being 1/3 at (1/3, 1/3).",
            match truth {
                Some(true) => Verdict::Sharp,
                other => Verdict::of(other),
            },
            match exact {
                Some(exact) => format!("B_0(6) = {exact}; B(1/3, 1/3) = {at_point}"),
                None => "B_0(6) was not proved exactly".into(),
            },
            SCOPE,
        )
    }
}
