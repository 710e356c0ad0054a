//! (13), (16)..(23): the first-order norm, Lemma 5 and Theorem 6.

use std::cmp::Ordering;

use num_traits::{One, Signed};

use super::appendix_a::on_bound;
use super::functional::Functional;
use super::norm::{Norm, Sup, number};
use super::printed;
use super::setting::{LEVELS, Setting, phi};
use super::theorem_6::{printed_depth, rate_depth};
use super::wording::{valences, within};
use crate::bernstein::from_net;
use crate::paper::words::{all, by_verdict, claim, gravest, if_true, list, ranges};
use crate::paper::{Claim, Table, Verdict};
use crate::scalar::{Decide, Field, Rational};
use crate::scheme::{Tile, catmull_clark};

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

    /// The printed rate to a power.
    pub fn power(&self, k: usize) -> Option<Rational> {
        let rate = printed::rate(self.n)?;
        Some((0..k).fold(Rational::one(), |power, _| power * &rate))
    }

    /// Whether Theorem 6 was proved: (19) from level to level, (17) and (13).
    pub fn theorem_6_holds(&self) -> bool {
        let bound = matches!(self.lemma_5(1), Some(Verdict::Sharp | Verdict::Loose));
        bound && self.overlap && self.covering
    }

    /// (19) for a level: the verdict over i = 0 .. 3.
    pub fn lemma_5(&self, k: usize) -> Option<Verdict> {
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

/// Whether Lemma 5 holds, in words: for the claims on its proof.
pub fn survival(found: &[&Facts]) -> String {
    let holds = |f: &&&Facts| matches!(f.lemma_5(1), Some(Verdict::Sharp | Verdict::Loose));
    let fails = found.iter().filter(|f| f.lemma_5(1).is_some() && !holds(f));
    let held = ranges(found.iter().filter(holds).map(|f| f.n));
    match ranges(fails.map(|f| f.n)).as_str() {
        "none" => format!("Lemma 5 survives: max G_i^1 <= r G^0 at N = {held}"),
        fails => format!("Lemma 5 itself fails at N = {fails}"),
    }
}

/// The first-order norm of each set, level by level.
pub fn table_by_set(found: &[&Facts]) -> Table {
    let mut rows = Vec::new();
    for f in found {
        for k in 1..=LEVELS {
            let bound = f.power(k).map_or("-".into(), |x| number(&x));
            let mut row = vec![f.n.to_string(), k.to_string(), bound];
            row.extend(f.rates[k - 1].iter().map(ToString::to_string));
            row.push(f.lemma_5(k).map_or("-".into(), |v| v.to_string()));
            rows.push(row);
        }
    }
    Table {
        id: "lemma-5",
        title: "Lemma 5, (19): G_i^k over G^0, i = 0 .. 3".into(),
        heads: vec![
            "N", "k", "printed", "G_0^k", "G_1^k", "G_2^k", "G_3^k", "verdict",
        ],
        rows,
        notes: Vec::new(),
    }
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

/// The claims.
pub fn claims(found: &[&Facts], scope: &str) -> Vec<Claim> {
    vec![
        sets(found, scope),
        in_the_ball(found, scope),
        lemma_5(found),
        displayed(found, scope),
        similar(found, scope),
        eq_20(found),
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

fn lemma_5(found: &[&Facts]) -> Claim {
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
            "{}, whatever the steps of its proof (eq-49, eq-52). k = 1: {}; k = 2 .. {LEVELS}: {}. \
             max G_i^1 / G^0: {}. From k = 1 all k follow by induction.{}",
            survival(found),
            by_verdict(&verdicts),
            by_verdict(&later),
            list(values),
            four.unwrap_or_default()
        ),
        within(valences(&verdicts), &format!("k <= {LEVELS} computed")),
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

fn eq_20(found: &[&Facts]) -> Claim {
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
        within(valences(&verdicts), &format!("n < {LEVELS} computed")),
    )
}
