//! (13), (16)..(23): the first-order norm, Lemma 5 and Theorem 6.

use std::cmp::Ordering;

use num_traits::{One, Signed};

use super::appendix_a::on_bound;
use super::depth;
use super::functional::Functional;
use super::norm::{Norm, Sup, number};
use super::printed;
use super::setting::{LEVELS, Setting, phi};
use crate::bernstein::from_net;
use crate::paper::words::{all, by_verdict, claim, exceptions, gravest, if_true, list};
use crate::paper::{Claim, Table, Verdict};
use crate::scalar::{Decide, Field, Rational, Ring};
use crate::scheme::{Tile, catmull_clark};

/// G^0 / ε of the table of depths.
const RATIO: i64 = 100;

/// What is computed for a valence.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The valence.
    pub n: u32,
    /// `sup G_i^k / G^0` for k = 1, 2, .. and i = 0 .. 3.
    pub rates: Vec<[Sup; 4]>,
    /// For k = 0, 1, ..: the largest `|V_5^(k+1) - V| / G^0`, V in Π_0^k.
    ball: Vec<Sup>,
    /// The largest `|V_5^1 - V| / G_i^0`, V in Φ_i.
    near: [Sup; 4],
    /// Whether the Φ_i make up Π_0, about centres that are in them.
    covering: bool,
    /// Whether V1, V4, V5, V6 have positive weight in every point of S.
    overlap: bool,
}

impl Facts {
    /// Of a valence.
    pub fn of(setting: &Setting) -> Self {
        let n = setting.n;
        let rate = |k: usize| {
            [0, 1, 2, 3].map(|i| {
                let differences = setting.rows_of(&setting.first[i], k);
                setting.g.largest(&differences).1
            })
        };
        let to_ball = |k: usize, labels: &[usize], norm: &Norm| {
            let centre = &setting.levels[k + 1][4];
            let point = |&j: &usize| centre.clone() - &setting.levels[k][j - 1];
            norm.largest(&labels.iter().map(point).collect::<Vec<_>>())
                .1
        };
        let every: Vec<usize> = (1..=setting.size()).collect();
        let members = [0, 1, 2, 3].map(|i| phi(n, i));
        let mut covered: Vec<usize> = members.iter().flat_map(|(_, m)| m.clone()).collect();
        covered.sort_unstable();
        covered.dedup();
        Facts {
            n,
            rates: (1..=LEVELS).map(rate).collect(),
            ball: (0..LEVELS)
                .map(|k| to_ball(k, &every, &setting.g))
                .collect(),
            near: [0, 1, 2, 3].map(|i| to_ball(0, &members[i].1, &setting.norm(&[i]))),
            covering: covered == every && members.iter().all(|(c, m)| m.contains(c)),
            overlap: overlap(setting),
        }
    }

    /// `sup G^k / G^0`.
    pub fn rate(&self, k: usize) -> Option<Rational> {
        let values = self.rates[k - 1].iter().map(|sup| sup.value().cloned());
        values.collect::<Option<Vec<_>>>()?.into_iter().max()
    }

    fn power(&self, k: usize) -> Option<Rational> {
        let rate = printed::rate(self.n)?;
        Some((0..k).fold(Rational::one(), |power, _| power * &rate))
    }

    /// Whether Theorem 6 was proved: (19) from level to level, (17) and (13).
    pub fn theorem_6_holds(&self) -> bool {
        let bound = matches!(self.lemma_5(1), Some(Verdict::Sharp | Verdict::Loose));
        bound && self.overlap && self.covering
    }

    /// (19) for a level: the verdict over i = 0 .. 3.
    fn lemma_5(&self, k: usize) -> Option<Verdict> {
        let power = self.power(k)?;
        let rate = self.rate(k);
        Some(
            rate.map_or(Verdict::Undecided, |rate| match rate.decide(&power) {
                Some(Ordering::Less) => Verdict::Loose,
                Some(Ordering::Equal) => Verdict::Sharp,
                Some(Ordering::Greater) => Verdict::Refuted,
                None => Verdict::Undecided,
            }),
        )
    }
}

/// Whether V1, V4, V5, V6 of a level have positive weight in S over the three tiles of the next, and in these
/// four points of the next: then in S everywhere, and in all later points of the mesh V1 has.
fn overlap(setting: &Setting) -> bool {
    let face = [1, 4, 5, 6];
    let positive = |t: &Functional, labels: &[usize]| {
        labels
            .iter()
            .all(|&j| t.coefficients()[j - 1].is_positive())
    };
    let level = &setting.levels[1];
    let tiles = Tile::ALL.iter().all(|&tile| {
        let net = catmull_clark::tile_net(setting.n, tile, level);
        let surface = from_net::bicubic::<Rational, _>(&net);
        surface.0.iter().all(|t| positive(t, &face))
    });
    tiles
        && face.iter().all(|&j| positive(&level[j - 1], &face))
        && level[..setting.size()].iter().all(|t| positive(t, &[1]))
}

/// Rates printed and true, and depths.
pub fn table(found: &[&Facts]) -> Table {
    let text = |x: Option<Rational>| x.map_or("-".into(), |x| number(&x));
    let row = |f: &&Facts| {
        let mut row = vec![f.n.to_string()];
        for k in 1..=LEVELS {
            row.push(text(f.power(k)));
            row.push(text(f.rate(k)));
        }
        row.push(f.lemma_5(1).map_or("-".into(), |v| v.to_string()));
        row.extend(
            [printed_depth(f), rate_depth(f)].map(|d| d.map_or("-".into(), |d| d.to_string())),
        );
        row
    };
    Table {
        id: "first-order",
        title: "(19) and (23): G^k over G^0, printed and true".into(),
        heads: vec![
            "N", "(19), k = 1", "true", "(19), k = 2", "true", "(19), k = 3", "true", "verdict, k = 1",
            "n_ε (23), G/ε = 100", "n by true rates",
        ],
        rows: found.iter().map(row).collect(),
        notes: vec![
            "True: the supremum over all nets, an exact linear program (the larger of G_0 .. G_3). The last column \
             is what the paper's argument gives with these rates in place of 1/δ. For N = 4 the paper prints nothing."
                .into(),
        ],
    }
}

fn printed_depth(f: &Facts) -> Option<i64> {
    let ratio = <Rational as Ring>::from_integer(RATIO);
    depth::n_epsilon(f.n, &ratio, &Rational::one())
}

fn rate_depth(f: &Facts) -> Option<i64> {
    let rates: Vec<Rational> = (1..=LEVELS).map(|k| f.rate(k)).collect::<Option<_>>()?;
    let factor = Rational::ratio(printed::EQ_23_FACTOR.0, printed::EQ_23_FACTOR.1);
    let ratio = <Rational as Ring>::from_integer(RATIO);
    Some(depth::with_rates(&factor, &rates, &ratio))
}

/// The claims.
pub fn claims(found: &[&Facts], scope: &str) -> Vec<Claim> {
    vec![
        sets(found, scope),
        in_the_ball(found, scope),
        lemma_5(found, scope),
        displayed(found, scope),
        similar(found, scope),
        eq_20(found, scope),
        largest_rate(),
        delta(),
        theorem_6(found, scope),
        fastest(found, scope),
    ]
}

fn sets(found: &[&Facts], scope: &str) -> Claim {
    let truths: Vec<_> = found.iter().map(|f| (f.n, Some(f.covering))).collect();
    claim(
        "phi",
        "(17), (18)",
        "Φ_0 .. Φ_3 about V_1, V_6, V_5, V_4, V_8 read as V_2 at N = 3, make up Π_0.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        if_true(
            &truths,
            "every point is in one of them and every centre in its own",
        ),
        scope,
    )
}

fn in_the_ball(found: &[&Facts], scope: &str) -> Claim {
    let truths: Vec<_> = found
        .iter()
        .map(|f| (f.n, f.overlap.then_some(true)))
        .collect();
    claim(
        "eq-13",
        "(13)",
        "If Π_0^n is contained in the ball of radius ε/2 about V_5^(n+1) then |S_0^n - L_0^n| < ε.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        if_true(
            &truths,
            "S and L are averages of points of the ball that share V_1, V_4, V_5, V_6 with positive weight (checked on \
             the matrix), so they can't be opposite: smaller, even if the ball is closed",
        ),
        scope,
    )
}

fn lemma_5(found: &[&Facts], scope: &str) -> Claim {
    let verdicts: Vec<(u32, Verdict)> = found
        .iter()
        .filter_map(|f| Some((f.n, f.lemma_5(1)?)))
        .collect();
    let later = |f: &&Facts| {
        let levels = (2..=LEVELS).map(|k| f.lemma_5(k));
        Some((f.n, Verdict::gravest(levels.collect::<Option<Vec<_>>>()?)))
    };
    let later: Vec<(u32, Verdict)> = found.iter().filter_map(later).collect();
    let values = found
        .iter()
        .filter_map(|f| Some((f.n, number(&f.rate(1)?))));
    let four = found.iter().find(|f| f.n == 4).and_then(|f| f.rate(1));
    let four = four.map(|rate| {
        let formula = printed::at(printed::RATE, 4);
        format!(
            " At N = 4 nothing is printed; the formula would give {formula}, the supremum is {}.",
            number(&rate)
        )
    });
    claim(
        "lemma-5",
        "Lemma 5, (19)",
        "G_i^k <= (3/4)^k G^0 at N = 3, (3/4 + 7/(4N) - 13/(2N²))^k G^0 for N >= 5, i = 0 .. 3.",
        gravest(&verdicts).max(gravest(&later)),
        format!(
            "Lemma 5 holds, though steps of its proof do not (eq-49, eq-52). k = 1: {}; k = 2 .. {LEVELS}: {}. \
             max G_i^1 / G^0: {}. From k = 1 all k follow by induction.{}",
            by_verdict(&verdicts),
            by_verdict(&later),
            list(values),
            four.unwrap_or_default()
        ),
        format!("{scope}, k <= {LEVELS} computed"),
    )
}

fn displayed(found: &[&Facts], scope: &str) -> Claim {
    let bound = Rational::ratio(printed::BALL.0, printed::BALL.1);
    let verdicts: Vec<_> = found
        .iter()
        .map(|f| (f.n, on_bound(&f.near[0], &bound)))
        .collect();
    claim(
        "phi-0-ball",
        "before (20)",
        "|V_5^(n+1) - V| <= 7/4 G_0^n for V in Φ_0^n.",
        gravest(&verdicts),
        format!("{}, against G_0 alone", by_verdict(&verdicts)),
        scope,
    )
}

fn similar(found: &[&Facts], scope: &str) -> Claim {
    let bound = Rational::ratio(printed::BALL.0, printed::BALL.1);
    let verdicts: Vec<_> = found
        .iter()
        .map(|f| {
            (
                f.n,
                Verdict::gravest(f.near[1..].iter().map(|sup| on_bound(sup, &bound))),
            )
        })
        .collect();
    claim(
        "phi-others-ball",
        "before (20)",
        "Similar inequalities hold for Φ_1, Φ_2 and Φ_3.",
        gravest(&verdicts),
        format!("7/4 G_i for each: {}", by_verdict(&verdicts)),
        scope,
    )
}

fn eq_20(found: &[&Facts], scope: &str) -> Claim {
    let factor = Rational::ratio(printed::BALL.0, printed::BALL.1);
    let verdict = |f: &&&Facts| {
        let bounds = (0..LEVELS).map(|k| Some(on_bound(&f.ball[k], &(f.power(k)? * &factor))));
        Some((f.n, Verdict::gravest(bounds.collect::<Option<Vec<_>>>()?)))
    };
    let verdicts: Vec<_> = found.iter().filter_map(|f| verdict(&f)).collect();
    let values = found.iter().map(|f| {
        let values: Vec<String> = f.ball.iter().map(ToString::to_string).collect();
        (f.n, values.join(" "))
    });
    claim(
        "eq-20",
        "(20)",
        "|V_5^(n+1) - V| <= 7/4 r^n G^0 for V in Π_0^n, r as in (19).",
        gravest(&verdicts),
        format!(
            "{}; the suprema for n = 0, 1, ..: {}",
            by_verdict(&verdicts),
            list(values)
        ),
        format!("{scope}, n < {LEVELS} computed"),
    )
}

/// `196 N² (85/98 - r(N)) = (N - 7)(23 N - 182)`, so the only integer with a value at most 0 is 7.
fn largest_rate() -> Claim {
    let largest = printed::at(printed::RATE, printed::LARGEST_AT as u32);
    // A quadratic in N that agrees at three places agrees everywhere.
    let identity = [5u32, 6, 9].iter().all(|&n| {
        let m = i64::from(n);
        let left = (&largest - printed::at(printed::RATE, n)) * Rational::ratio(196 * m * m, 1);
        left == Rational::ratio((m - 7) * (23 * m - 182), 1)
    });
    // 182/23 lies between 7 and 8.
    let between = 7 * 23 < 182 && 182 < 8 * 23;
    claim(
        "largest-rate",
        "before (21)",
        "The maximum of 3/4 + 7/(4N) - 13/(2N²) occurs at N = 7.",
        Verdict::of(Some(identity && between)),
        format!(
            "over the integers: {largest} - r(N) = (N - 7)(23N - 182) / (196 N²), zero at N = 7 and positive at every \
             other integer (over the reals the maximum is at 52/7)"
        ),
        "all N",
    )
}

fn delta() -> Claim {
    let largest = printed::at(printed::RATE, printed::LARGEST_AT as u32);
    let [three, more] = printed::DELTA.map(|(p, q)| Rational::ratio(q, p));
    let right = more == largest && Some(three) == printed::rate(3);
    claim(
        "delta",
        "(21), (22)",
        "1/δ bounds the rate of (19): δ = 4/3 for N = 3, 98/85 for N >= 5.",
        Verdict::of(Some(right)),
        "98/85 is the reciprocal of the rate at N = 7, the largest (largest-rate)",
        "all N",
    )
}

fn theorem_6(found: &[&Facts], scope: &str) -> Claim {
    let truths = found.iter().filter_map(|f| {
        let shorter = rate_depth(f)? < printed_depth(f)?;
        Some((
            f.n,
            match (f.theorem_6_holds(), shorter) {
                (true, true) => Verdict::Loose,
                (true, false) => Verdict::True,
                _ => Verdict::Undecided,
            },
        ))
    });
    let verdicts: Vec<_> = truths.collect();
    let depths = found
        .iter()
        .filter_map(|f| Some((f.n, format!("{} of {}", rate_depth(f)?, printed_depth(f)?))));
    Claim {
        method: Some(
            "as printed for N = 3 and N >= 5; at N = 4 use Theorem 4; a negative n_ε means 0 steps"
                .into(),
        ),
        ..claim(
            "theorem-6",
            "Theorem 6, (23)",
            "The distance of S_0^n from L_0^n is at most ε for n >= n_ε = ⌈log_δ (7G^0/(2ε))⌉.",
            gravest(&verdicts),
            format!(
                "the theorem survives: it needs (19) with k = n, which holds. It asks for too many steps: with the true \
                 rates of k <= {LEVELS} the same argument gives, for G^0/ε = {RATIO}, {}",
                list(depths)
            ),
            scope,
        )
    }
}

fn fastest(found: &[&Facts], scope: &str) -> Claim {
    let Some(three) = found.iter().find(|f| f.n == 3) else {
        return claim(
            "fastest",
            "after Theorem 6",
            "",
            Verdict::Undecided,
            "",
            crate::paper::words::NOWHERE,
        );
    };
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .filter(|f| f.n != 3)
        .map(|f| {
            let less =
                (1..=LEVELS).map(|k| Some(three.rate(k)?.decide(&f.rate(k)?)? == Ordering::Less));
            (f.n, all(less))
        })
        .collect();
    let values = found
        .iter()
        .filter_map(|f| Some((f.n, number(&f.rate(LEVELS)?))));
    claim(
        "fastest",
        "after Theorem 6",
        "Convergence near the extraordinary vertex is fastest when its valence is three.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "in the first-order norm: {}, the regular N = 4 included; G^{LEVELS}/G^0: {}. (In the second-order norm \
             the regular valence is faster: see w.)",
            exceptions(&truths),
            list(values)
        ),
        scope,
    )
}
