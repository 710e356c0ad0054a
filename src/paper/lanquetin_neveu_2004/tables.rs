//! Tables 1 to 3, the box and the spinning top: is there an M_0 that gives all the printed depths?
//!
//! The models are not public. What can be decided is whether the entries agree with each other by
//! Corollary 3: the depth k for ε with the rate r means `ε r^(1-k) <= M_0 < ε r^-k`.

use super::loop_masks::rate_enclosure;
use super::printed::{self, Depths};
use crate::paper::words::claim;
use crate::paper::{Claim, Enclosure, Printed, Table, Verdict};
use crate::scalar::Rational;

/// `lo <= M_0 < hi`, both enclosed.
#[derive(Clone, Debug)]
pub struct Window {
    /// The largest lower end.
    pub lo: Enclosure,
    /// The smallest upper end.
    pub hi: Enclosure,
}

/// `x / r^k`.
fn over_power(x: &Rational, rate: &Enclosure, k: i32) -> Enclosure {
    Enclosure::new(x / rate.hi.pow(k), x / rate.lo.pow(k))
}

impl Window {
    /// The M_0 for which Corollary 3 gives the depth k >= 1 for ε.
    pub fn of(epsilon: &Rational, depth: u32, rate: &Enclosure) -> Self {
        let k = depth as i32;
        Window {
            lo: over_power(epsilon, rate, k - 1),
            hi: over_power(epsilon, rate, k),
        }
    }

    /// The M_0 in both.
    fn and(self, other: Window) -> Self {
        let smaller = |a: Enclosure, b: Enclosure| {
            let least = |x: &Rational, y: &Rational| if x <= y { x } else { y }.clone();
            Enclosure::new(least(&a.lo, &b.lo), least(&a.hi, &b.hi))
        };
        Window {
            lo: self.lo.max(&other.lo),
            hi: smaller(self.hi, other.hi),
        }
    }

    /// Whether there is an M_0 in it.
    pub fn is_possible(&self) -> Option<bool> {
        Some(!self.hi.at_most(&self.lo)?)
    }

    fn text(&self) -> String {
        format!("{} <= M_0 < {}", self.lo.decimal(3), self.hi.decimal(3))
    }
}

/// The M_0 for all of some entries.
pub fn window(entries: &[(Printed, u32)], n: u32) -> Option<Window> {
    let rate = rate_enclosure(n)?;
    let windows = entries
        .iter()
        .map(|(e, k)| Window::of(&e.exact(), *k, &rate));
    windows.reduce(Window::and)
}

/// The depths that Corollary 3 gives for ε over a window of M_0, if they are all the same.
fn depth_in(window: &Window, epsilon: &Rational, n: u32) -> Option<u32> {
    let rate = rate_enclosure(n)?;
    let whole = Enclosure::new(window.lo.lo.clone(), window.hi.hi.clone());
    super::depth::corollary_3(&whole, &Enclosure::exactly(epsilon.clone()), &rate)
}

/// Whether a table is possible for some valence from 3 on: for the rates of n = 3.. up to the limit 25/64.
fn possible_at(entries: &[(Printed, u32)], valences: impl Iterator<Item = u32>) -> Vec<u32> {
    let possible = |n: &u32| window(entries, *n).and_then(|w| w.is_possible()) == Some(true);
    valences.filter(possible).collect()
}

/// The table with its third and fourth accuracies exchanged.
fn exchanged(table: &Depths) -> Depths {
    let mut other = *table;
    (other[2].0, other[3].0) = (table[3].0, table[2].0);
    other
}

/// All windows in a table.
pub fn table() -> Table {
    let names = ["1: torus", "2: dolphin", "3: bunny"];
    let tables = [printed::TABLE_1, printed::TABLE_2, printed::TABLE_3];
    let mut rows = Vec::new();
    for ((name, entries), n) in names.iter().zip(&tables).zip(printed::LARGEST_VALENCES) {
        for entry in entries {
            let own = window(&[*entry], n);
            rows.push(vec![
                (*name).to_string(),
                n.to_string(),
                entry.0.to_string(),
                entry.1.to_string(),
                own.map_or("?".into(), |w| w.text()),
            ]);
        }
    }
    Table {
        id: "printed-depths",
        title: "Tables 1 to 3: the M_0 for which Corollary 3 gives the printed depth".into(),
        heads: vec!["table", "n", "ε", "depth", "M_0"],
        rows,
        notes: vec![
            "The models are not public; n is the largest valence that the paper names.".into(),
        ],
    }
}

fn judged(window: Option<&Window>) -> Option<bool> {
    window.and_then(Window::is_possible)
}

/// The claims on the tables.
pub fn claims() -> Vec<Claim> {
    let [torus, dolphin, bunny] = printed::LARGEST_VALENCES;
    let as_misprint = |truth: Option<bool>| match truth {
        Some(false) => Verdict::Misprint,
        other => Verdict::of(other),
    };
    let describe = |w: &Option<Window>| w.as_ref().map_or("?".into(), Window::text);
    let first = window(&printed::TABLE_1, torus);
    let swapped = window(&exchanged(&printed::TABLE_1), torus);
    let second = window(&printed::TABLE_2, dolphin);
    let four = window(&printed::TABLE_2[..4], dolphin);
    let last = &printed::TABLE_2[4];
    let others = possible_at(&printed::TABLE_2, 3..=200);
    let third = window(&printed::TABLE_3, bunny);
    let method = four
        .as_ref()
        .and_then(|w| depth_in(w, &last.0.exact(), dolphin));
    let pair = |(epsilon, readings): (Printed, [(u32, u32); 2])| {
        let windows = readings.map(|(n, k)| window(&[(epsilon, k)], n));
        let [Some(a), Some(b)] = windows else {
            return None;
        };
        Some(a.and(b))
    };
    let (cube, top) = (pair(printed::BOX), pair(printed::TOP));
    let scope = "the print alone: the models are not public";
    vec![
        Claim {
            method: Some(match judged(swapped.as_ref()) {
                Some(true) => format!("with 0.01 and 0.05 exchanged all entries agree: {}", describe(&swapped)),
                _ => "exchanging 0.01 and 0.05 does not help".into(),
            }),
            ..claim(
                "table-1",
                "Table 1",
                "Depths 2, 3, 4, 5, 6 of the torus for ε = 0.5, 0.1, 0.01, 0.05, 0.001.",
                as_misprint(judged(first.as_ref())),
                "no M_0 gives these depths: a larger ε can't need more steps",
                scope,
            )
        },
        Claim {
            method: method.map(|k| format!(
                "the first four entries want {}, for which Corollary 3 gives {k} at ε = {}, not {}",
                describe(&four), last.0, last.1
            )),
            ..claim(
                "table-2",
                "Table 2",
                "Depths 2, 3, 4, 5, 8 of the dolphin for ε = 0.5, 0.2, 0.055, 0.05, 0.01.",
                as_misprint(judged(second.as_ref())),
                format!(
                    "no M_0 gives all five with n = {dolphin}; with another valence: {}",
                    match others.is_empty() {
                        true => "none up to 200 either".to_string(),
                        false => format!("n = {}", super::super::words::ranges(others)),
                    }
                ),
                scope,
            )
        },
        claim(
            "table-3",
            "Table 3",
            "Depths 1, 2, 3, 4, 5 of the bunny for ε = 0.5, 0.1, 0.05, 0.012, 0.01.",
            Verdict::of(judged(third.as_ref())),
            format!("the entries agree with each other for n = {bunny} and {}; whether these depths suffice is another question", describe(&third)),
            scope,
        ),
        claim(
            "figure-15",
            "Figure 15",
            format!(
                "The bunny with an accuracy of {} (text) or {} (caption).",
                printed::FIGURE_15[0],
                printed::FIGURE_15[1]
            ),
            match printed::FIGURE_15[0].exact() == printed::FIGURE_15[1].exact() {
                true => Verdict::True,
                false => Verdict::Misprint,
            },
            match &third {
                Some(w) => {
                    let depths = printed::FIGURE_15.map(|e| depth_in(w, &e.exact(), bunny));
                    let text = depths.map(|k| k.map_or("?".into(), |k| k.to_string()));
                    format!("by Corollary 3 and the M_0 of Table 3 the depths are {}", text.join(" and "))
                }
                None => "no M_0".into(),
            },
            scope,
        ),
        claim(
            "box",
            "section 3.1, Figure 12",
            "The box for ε = 0.05: depth 3 with n = 5, 4 with n = 6.",
            Verdict::of(judged(cube.as_ref())),
            format!("agree with each other for {}", describe(&cube)),
            scope,
        ),
        claim(
            "spinning-top",
            "section 3.1, Figure 13",
            "The spinning top for ε = 0.15: depth 2 with n = 6, 3 with n = 18.",
            Verdict::of(judged(top.as_ref())),
            format!("agree with each other for {}", describe(&top)),
            scope,
        ),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: [0.05 · 4^3, 0.5 · 4^2) = [3.2, 8) cut by 0.001 · 4^6 = 4.096.
    #[test]
    fn the_window_of_table_1_exchanged() {
        let w = window(&exchanged(&printed::TABLE_1), 6).expect("a rate");
        assert_eq!(w.text(), "3.200 <= M_0 < 4.096");
    }
}
