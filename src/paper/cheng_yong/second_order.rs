//! (24)..(33): the second-order norm, W, Lemmas 7 and 8, Theorem 9.

use std::cmp::Ordering;

use num_traits::One;

use super::appendix_a::on_bound;
use super::norm::{Sup, number};
use super::regular::surface_minus_face;
use super::setting::{LEVELS, Setting, second_differences_of};
use super::theorem_9::{depth_by_rates, printed_depth};
use super::wording::{grouped, scope, valences, within};
use super::{Valence, depth, printed};
use crate::paper::words::{all, by_verdict, claim, exceptions, gravest, if_true, list, ranges};
use crate::paper::{Claim, Table, Verdict};
use crate::scalar::{Decide, Field, Rational, Ring};
use crate::scheme::{Tile, catmull_clark};

/// What is computed for a valence.
#[derive(Clone, Debug)]
pub struct Facts {
    /// The valence.
    pub n: u32,
    /// `sup Z_3^k / Z_0^0`, k = 1, 2, ..
    pub third: Vec<Sup>,
    /// `sup Z_0^k / Z_0^0`, k = 1, 2, ..
    pub zero: Vec<Sup>,
    /// Of Z_0^1, without the differences across V_1.
    zero_others: Sup,
    /// `sup Z_1^1 / Z_0^0` and `sup Z_2^1 / Z_0^0`.
    others: [Sup; 2],
    /// Bounds of `sup |L_3^1 - S_3^1| / Z_0^0`: at a corner, by the Bernstein coefficients.
    distance: [Sup; 2],
    /// Whether L_3 is on the face of the tile.
    face: bool,
    /// Whether the labels printed after Lemma 7 name a V_0, and whether the corrected ones are right.
    index: (bool, bool),
}

impl Facts {
    /// Of a valence.
    pub fn of(setting: &Setting) -> Self {
        let n = setting.n;
        let z = &setting.z;
        let zero = |k: usize| setting.rows_of(z.rows(), k);
        // `2 V_1 - V_2j - V_2j+4` come first.
        let across = n as usize;
        let distances = surface_minus_face(&setting.third(1));
        let corners = [0, 3, 12, 15].map(|i| distances[i].clone());
        let third = |k: usize| z.largest(&second_differences_of(&setting.third(k))).1;
        let labels = catmull_clark::tile_labels(n, Tile::Third);
        let face = [5, 6, 10, 9].map(|at| labels[at]);
        let printed_face = printed::EQ_24.map(|text| super::functional::label(n, text));
        let rows = catmull_clark::second_differences(n);
        let two_apart = (1..=across).all(|j| {
            let other = 2 * ((j + 1) % across + 1);
            let row = crate::scheme::IntegerRow::new([(0, 2), (2 * j - 1, -1), (other - 1, -1)]);
            rows[..across].contains(&row)
        });
        let tile = |tile| {
            let net = catmull_clark::tile_net(n, tile, &setting.levels[1]);
            z.largest(&second_differences_of(&net)).1
        };
        Facts {
            n,
            others: [Tile::First, Tile::Second].map(tile),
            third: (1..=LEVELS).map(third).collect(),
            zero: (1..=LEVELS).map(|k| z.largest(&zero(k)).1).collect(),
            zero_others: z.largest(&zero(1)[across..]).1,
            distance: [z.largest(&corners).1, z.largest(&distances).1],
            face: face.map(Some) == printed_face,
            index: ((1..=across).any(|j| (j + 2) % across == 0), two_apart),
        }
    }

    fn power(&self, k: usize) -> Option<Rational> {
        let w = depth::w(self.n)?;
        Some((0..k).fold(Rational::one(), |power, _| power * &w))
    }

    /// Z_3^k over Z_0^0, for every k: computed, or by the rates of Z_0.
    pub fn third_bound(&self, k: usize) -> Option<Rational> {
        let (whole, rest) = ((k - 1) / LEVELS, (k - 1) % LEVELS);
        let rate = self.zero[LEVELS - 1].value()?;
        let third = self.third[rest].value()?.clone();
        Some((0..whole).fold(third, |bound, _| bound * rate))
    }
}

/// W printed and true, and Theorem 9's depth.
pub fn table(found: &[Valence]) -> Table {
    let text = |x: Option<Rational>| x.map_or("-".into(), |x| number(&x));
    let row = |v: &Valence| {
        let f = &v.second;
        let mut row = vec![
            f.n.to_string(),
            text(depth::w(f.n)),
            text(printed::by_case(printed::APPENDIX_D, f.n)),
            f.third[0].to_string(),
            f.zero[0].to_string(),
        ];
        for k in 2..=LEVELS {
            row.push(text(f.power(k)));
            row.push(f.third[k - 1].to_string());
        }
        row.push(match f.power(1) {
            Some(w) => on_bound(&f.third[0], &w).to_string(),
            None => "-".into(),
        });
        let depths = [printed_depth(f.n), depth_by_rates(v)];
        row.extend(depths.map(|d| d.map_or("-".into(), |d| d.to_string())));
        let file = v.d.certificate.as_ref().map(|(file, _)| file.clone());
        row.push(file.unwrap_or_else(|| "-".into()));
        row
    };
    Table {
        id: "second-order",
        title: "(27), Appendix D and (33): Z_3^k and Z_0^k over Z_0^0, printed and true".into(),
        heads: vec![
            "N",
            "W (27)",
            "Appendix D",
            "Z_3^1",
            "Z_0^1",
            "W²",
            "Z_3^2",
            "W³",
            "Z_3^3",
            "verdict on W",
            "D (33), G/ε = Z/ε = 100",
            "D by true rates",
            "Appendix D refuted by",
        ],
        rows: found.iter().map(row).collect(),
        notes: vec!["Z_3^k, Z_0^k: suprema over all nets, exact linear programs.".into()],
    }
}

/// The claims.
pub fn claims(found: &[Valence], scope: &str) -> Vec<Claim> {
    vec![
        eq_24(found, scope),
        eq_26(found),
        eq_26_second(found),
        eq_26_chain(found),
        dominant(found),
        other_tiles(found),
        lemma_7(found),
        index(found, scope),
    ]
}

fn eq_24(found: &[Valence], scope: &str) -> Claim {
    let truths: Vec<_> = found.iter().map(|v| (v.n, Some(v.second.face))).collect();
    claim(
        "eq-24",
        "(24)",
        "L_3 is the bilinear face with V_4, V_5, V_2N+7, V_2N+6 at (0,0), (1,0), (0,1), (1,1).",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        if_true(
            &truths,
            "these are the corners of S_3's face, in its parameters",
        ),
        scope,
    )
}

/// Verdicts on bounds that the paper has for all valences but 4.
fn on_w(found: &[Valence], of: impl Fn(&Facts) -> Option<Verdict>) -> Vec<(u32, Verdict)> {
    found
        .iter()
        .filter_map(|v| Some((v.n, of(&v.second)?)))
        .collect()
}

fn suprema(found: &[Valence], of: impl Fn(&Facts) -> &Sup) -> String {
    list(found.iter().map(|v| {
        let w = depth::w(v.n).map_or("-".into(), |w| number(&w));
        (v.n, format!("{} of {w}", of(&v.second)))
    }))
}

fn eq_26(found: &[Valence]) -> Claim {
    let verdicts = on_w(found, |f| Some(on_bound(&f.third[0], &f.power(1)?)));
    claim(
        "eq-26",
        "(26), (27)",
        "Z_3^k <= W Z_0^(k-1), W = 2/3 at N = 3, 1/2 + 1/(4N) + 21/(4N²) at N = 5, 3/4 + 2/N - 21/(2N²) for N > 5.",
        gravest(&verdicts),
        format!(
            "{}; suprema: {}",
            by_verdict(&verdicts),
            suprema(found, |f| &f.third[0])
        ),
        scope(valences(&verdicts)),
    )
}

fn eq_26_second(found: &[Valence]) -> Claim {
    let verdicts = on_w(found, |f| Some(on_bound(&f.zero[0], &f.power(1)?)));
    claim(
        "eq-26-second",
        "(26), second part",
        "W Z_0^(k-1) <= W^k Z_0^0, that is Z_0^1 <= W Z_0^0.",
        gravest(&verdicts),
        format!(
            "{}; suprema: {}",
            by_verdict(&verdicts),
            suprema(found, |f| &f.zero[0])
        ),
        scope(valences(&verdicts)),
    )
}

fn eq_26_chain(found: &[Valence]) -> Claim {
    let verdicts = on_w(found, |f| {
        let bounds = (2..=LEVELS).map(|k| {
            let power = f.power(k)?;
            let both = [&f.third[k - 1], &f.zero[k - 1]].map(|sup| on_bound(sup, &power));
            Some(Verdict::gravest(both))
        });
        Some(Verdict::gravest(bounds.collect::<Option<Vec<_>>>()?))
    });
    let last = found.iter().filter_map(|v| {
        let power = number(&v.second.power(LEVELS)?);
        Some((v.n, format!("{} of {power}", v.second.third[LEVELS - 1])))
    });
    claim(
        "eq-26-levels",
        "(26)",
        "Z_3^k <= W^k Z_0^0 and Z_0^k <= W^k Z_0^0 over several levels.",
        gravest(&verdicts),
        format!("{}; Z_3^{LEVELS}: {}", by_verdict(&verdicts), list(last)),
        within(valences(&verdicts), &format!("2 <= k <= {LEVELS}")),
    )
}

fn dominant(found: &[Valence]) -> Claim {
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .filter(|v| v.n != 4)
        .map(|v| {
            let less = v.second.zero_others.value().zip(v.second.zero[0].value());
            let same = v.second.zero[0].value() == v.d.first_sup.value();
            (
                v.n,
                less.and_then(|(a, b)| Some(a.decide(b)? == Ordering::Less && same)),
            )
        })
        .collect();
    claim(
        "appendix-d-dominate",
        "Appendix D",
        "Second differences similar to 2V_1 - V_2 - V_6 dominate the others, so the second part of (26) follows.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        if_true(
            &truths,
            "the largest supremum is theirs, the same as in the first case, and all others are smaller",
        ),
        scope(valences(&truths)),
    )
}

fn other_tiles(found: &[Valence]) -> Claim {
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .filter_map(|v| {
            let w = depth::w(v.n)?;
            Some((v.n, all(v.second.others.iter().map(|sup| sup.at_most(&w)))))
        })
        .collect();
    let values = found.iter().map(|v| {
        let [first, second] = &v.second.others;
        (v.n, format!("{first} and {second}"))
    });
    claim(
        "other-tiles",
        "section 2.2.2",
        "This D_k (for S_3^k) works for S_1^k and S_2^k as well.",
        Verdict::of(all(truths.iter().map(|t| t.1))),
        format!(
            "Z_1^1 and Z_2^1 over Z_0^0 are at most W, {}: {}",
            exceptions(&truths),
            grouped(values)
        ),
        scope(valences(&truths)),
    )
}

/// How the distance of S_3^1 from its face compares with W / 3.
pub fn on_lemma_7(f: &Facts) -> Option<Verdict> {
    let bound = f.power(1)? * Rational::ratio(printed::THIRD.0, printed::THIRD.1);
    let [corner, hull] = f.distance.each_ref().map(|sup| on_bound(sup, &bound));
    Some(match (corner, hull) {
        (Verdict::Refuted, _) => Verdict::Refuted,
        (Verdict::Sharp, Verdict::Sharp | Verdict::Loose) => Verdict::Sharp,
        (_, Verdict::Loose) => Verdict::Loose,
        (_, Verdict::Sharp) => Verdict::True,
        _ => Verdict::Undecided,
    })
}

fn lemma_7(found: &[Valence]) -> Claim {
    let verdicts = on_w(found, on_lemma_7);
    let values = found.iter().filter_map(|v| {
        let bound = v.second.power(1)? / <Rational as Ring>::from_integer(3);
        let [corner, hull] = &v.second.distance;
        Some((v.n, format!("{corner} to {hull} of {}", number(&bound))))
    });
    claim(
        "lemma-7",
        "Lemma 7, (25), (28)",
        "max |L_3^k - S_3^k| <= W^k Z_0^0 / 3.",
        gravest(&verdicts),
        format!(
            "k = 1: {}; the supremum over Z_0^0 lies in {}. With (26), all k",
            by_verdict(&verdicts),
            list(values)
        ),
        scope(valences(&verdicts)),
    )
}

fn index(found: &[Valence], scope: &str) -> Claim {
    let bad = ranges(found.iter().filter(|v| v.second.index.0).map(|v| v.n));
    let right = found.iter().all(|v| v.second.index.1);
    Claim {
        method: Some(format!(
            "2[(j+1)%N + 1]: edge neighbours two apart, {}",
            match right {
                true => "the second differences of Appendix D",
                false => "but not all of them",
            }
        )),
        ..claim(
            "lemma-7-index",
            "after Lemma 7",
            "The second differences across V_1 are 2V_1 - V_2j - V_2[(j+2)%N], j = 1 .. N.",
            match &*bad {
                "none" => Verdict::True,
                _ => Verdict::Misprint,
            },
            format!("at j = N - 2 this names a V_0, which there is not (N = {bad})"),
            scope,
        )
    }
}
