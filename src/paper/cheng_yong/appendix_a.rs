//! (4)..(7) and Appendix A: Lemma 3 and Theorem 4.

use num_traits::One;

use super::depth;
use super::functional::Functional;
use super::norm::Sup;
use super::printed;
use super::regular::{REGULAR, SCOPE, bowl, grid_label, printed_label, surface_minus_face, window};
use super::setting::{LEVELS, Setting, second_differences_of};
use super::violation::texts;
use crate::paper::words::claim;
use crate::paper::{Claim, Counterexample, Verdict};
use crate::scalar::{Field, Rational, Ring};
use crate::scheme::IntegerRow;

fn quarter() -> Rational {
    Rational::ratio(printed::QUARTER.0, printed::QUARTER.1)
}

/// The claims.
pub fn claims(setting: &Setting) -> Vec<Claim> {
    let mut claims = vec![subpatches(), categories()];
    claims.extend(
        printed::APPENDIX_A
            .iter()
            .map(|line| equation(setting, line)),
    );
    claims.extend([
        lemma_3(setting),
        eq_6(setting),
        theorem_4(setting),
        theorem_4_strict(setting),
    ]);
    claims
}

fn subpatches() -> Claim {
    // Level-k control points: 4, 5, 7, 11, ..: one less than twice as many, less two.
    let mut count = 4usize;
    let mut points_agree = true;
    for k in 1..=6 {
        count = 2 * count - 3;
        points_agree &= count == 3 + (1 << k);
    }
    let short = (2..=6u32).all(|k| (1 << (k - 1)) < (1 << k) - 1);
    claim(
        "subpatches",
        "(4), (6)",
        "There are (3 + 2^k)² level-k control points and 4^k subpatches, 0 <= m, n <= 2^k - 1 in (4); (6) and the \
         line after it say 0 <= m, n <= 2^(k-1) (as scanned).",
        match points_agree && short {
            true => Verdict::Misprint,
            false => Verdict::Undecided,
        },
        "the counts and (4) are right; 2^(k-1) falls short of 2^k - 1 from k = 2 on (it is meant for 2^k - 1)",
        SCOPE,
    )
}

fn categories() -> Claim {
    // On level 1, even indices are of faces: a point is of type F, E or V by its two parities.
    let kind = |i: usize, j: usize| match (i % 2, j % 2) {
        (0, 0) => 'F',
        (1, 1) => 'V',
        _ => 'E',
    };
    let mut counts = std::collections::BTreeMap::new();
    for i in 0..4 {
        for at in 0..2 {
            let along: String = (at..at + 3).map(|j| kind(i, j)).collect();
            let across: String = (at..at + 3).map(|j| kind(j, i)).collect();
            *counts.entry(along).or_insert(0usize) += 1;
            *counts.entry(across).or_insert(0) += 1;
        }
    }
    let expected = printed::APPENDIX_A.iter().all(|line| {
        let name: String = line.category.split('-').collect();
        counts.get(&name) == Some(&printed::PER_CATEGORY)
    });
    claim(
        "categories",
        "Appendix A",
        "The sixteen second differences fall into four categories of four: F-E-F, E-F-E, E-V-E, V-E-V.",
        Verdict::of(Some(expected && counts.len() == printed::APPENDIX_A.len())),
        "counted",
        SCOPE,
    )
}

fn equation(setting: &Setting, line: &printed::Regular) -> Claim {
    let size = setting.size();
    let parse = |text: &str| Functional::parse(text, size, &printed_label);
    let left = parse(line.left).of(&setting.levels[1]);
    let identity = left.same(&parse(line.right));
    let sup = setting.z.sup(&left);
    let sharp = sup.value() == Some(&quarter());
    claim(
        line.id,
        line.place,
        format!(
            "{}, level i + 1: {} = {} (level i), of norm at most M/4.",
            line.category, line.left, line.right
        ),
        match (identity, sharp) {
            (true, true) => Verdict::Sharp,
            (false, _) => Verdict::Misprint,
            (true, false) => Verdict::of(sup.at_most(&quarter())),
        },
        format!(
            "{}; the supremum over M is {sup}",
            match identity {
                true => "an identity of the sixteen points",
                false => "no identity",
            }
        ),
        SCOPE,
    )
}

/// All second differences of the level-1 net: those of its four 4 x 4 windows.
fn next_differences(setting: &Setting) -> Vec<Functional> {
    let corners = [(0, 0), (1, 0), (0, 1), (1, 1)];
    let windows = corners.map(|(i, j)| window(&setting.levels[1], i, j));
    windows.iter().flat_map(second_differences_of).collect()
}

fn lemma_3(setting: &Setting) -> Claim {
    let (_, largest) = setting.z.largest(&next_differences(setting));
    let net = bowl();
    let row = IntegerRow::new([
        (0, 2),
        (grid_label(0, 1) - 1, -1),
        (grid_label(2, 1) - 1, -1),
    ]);
    let mut power = Rational::one();
    let mut kept = true;
    for k in 1..=LEVELS {
        power *= quarter();
        let value = row
            .apply::<Rational, Functional>(&setting.levels[k])
            .at(&net);
        kept &= value == -power.clone();
    }
    claim(
        "lemma-3",
        "Lemma 3, (5), (36)",
        "M_(m,n)^k <= 4^-k M^0.",
        match largest.value() == Some(&quarter()) && kept {
            true => Verdict::Sharp,
            false => Verdict::of(largest.at_most(&quarter())),
        },
        format!(
            "over the second differences of all four level-1 nets the supremum is {largest}; induction gives all \
             k, and the net (i² + j²)/2 has 4^-k exactly"
        ),
        SCOPE,
    )
}

/// S - L of the level-k subpatch at V1, k >= 1, at the corner of V1.
fn at_corner(setting: &Setting, k: usize) -> Functional {
    surface_minus_face(&window(&setting.levels[k], 0, 0))[0].clone()
}

fn attained_at(setting: &Setting, k: usize) -> bool {
    let bound = Rational::ratio(1, 3 << (2 * k));
    at_corner(setting, k).at(&bowl()) == bound
}

fn eq_6(setting: &Setting) -> Claim {
    let sharp = (0..=LEVELS).all(|k| attained_at(setting, k));
    claim(
        "eq-6",
        "(6)",
        "The distance of each level-k subpatch from its face is at most 4^-k M^0 / 3.",
        match sharp {
            true => Verdict::Sharp,
            false => Verdict::Undecided,
        },
        format!(
            "by Lemmas 2 and 3; the net (i² + j²)/2 attains it at the corners, k = 0 .. {LEVELS}"
        ),
        SCOPE,
    )
}

fn theorem_4(setting: &Setting) -> Claim {
    // (7) is the least k with 4^-k M^0 / 3 <= ε, and that bound is attained: one step less is too few.
    let epsilon = Rational::one();
    let least = (1..=40i64).all(|m| {
        let m0 = <Rational as Ring>::from_integer(m);
        let k = depth::theorem_4(&m0, &epsilon).map_or(0, |k| k.max(0)) as u32;
        let bound = |k: u32| &m0 * Rational::ratio(1, 3 << (2 * k));
        bound(k) <= epsilon && (k == 0 || bound(k - 1) > epsilon)
    });
    let sharp = least && (0..=LEVELS).all(|k| attained_at(setting, k));
    Claim {
        method: Some("max(k, 0): for M^0 < 3ε/4 the printed ceiling is negative".into()),
        ..claim(
            "theorem-4",
            "Theorem 4, (7)",
            "k = ⌈log_4 (M^0 / (3ε))⌉ steps bring the mesh to a distance of at most ε.",
            match sharp {
                true => Verdict::Sharp,
                false => Verdict::Undecided,
            },
            "it is the least k with 4^-k M^0 / 3 <= ε, and by (6) no smaller one serves all nets",
            SCOPE,
        )
    }
}

fn theorem_4_strict(setting: &Setting) -> Claim {
    let epsilon = Rational::one();
    let m0 = <Rational as Ring>::from_integer(12);
    let net: Vec<Rational> = bowl().iter().map(|y| y * &m0).collect();
    let k = depth::theorem_4(&m0, &epsilon);
    let norm: Option<Rational> = (setting.z.rows().iter())
        .map(|row| num_traits::Signed::abs(&row.apply::<Rational, Rational>(&net)))
        .max();
    let distance = at_corner(setting, 1).at(&net);
    let equal = k == Some(1) && norm.as_ref() == Some(&m0) && distance == epsilon;
    Claim {
        counterexample: equal.then(|| Counterexample {
            valence: REGULAR,
            net: texts(&net),
            what: format!(
                "M^0 = {m0}, ε = {epsilon}: (7) gives k = 1, and S is at the distance {distance} = ε from the \
                 level-1 face at its corner V1"
            ),
        }),
        method: Some(format!(
            "at most ε; for \"smaller\" one more step where the ceiling is taken of an integer: {} here",
            depth::theorem_4_strict(&m0, &epsilon)
        )),
        ..claim(
            "theorem-4-strict",
            "Theorem 4",
            "After these k steps the distance is smaller than ε.",
            match equal {
                true => Verdict::Refuted,
                false => Verdict::Undecided,
            },
            "false where M^0 = 3 ε 4^k; Theorem 4 survives with \"at most ε\" (a certificate of a violated \
             inequality needs a strict excess, so the net stands here)",
            SCOPE,
        )
    }
}

/// A supremum as a verdict on a bound: sharp, loose, refuted, undecided.
pub fn on_bound(sup: &Sup, bound: &Rational) -> Verdict {
    match sup.order(bound) {
        Some(std::cmp::Ordering::Equal) => Verdict::Sharp,
        Some(std::cmp::Ordering::Less) => Verdict::Loose,
        Some(std::cmp::Ordering::Greater) => Verdict::Refuted,
        None => Verdict::Undecided,
    }
}
