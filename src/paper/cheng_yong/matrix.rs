//! (8)..(15): the subdivision matrix, its Markov chain, the limit point.

use nalgebra::DMatrix;
use num_traits::{One, Signed, Zero};

use super::printed;
use crate::paper::words::{by_verdict, claim, exceptions, gravest, if_true};
use crate::paper::{Claim, Verdict};
use crate::scalar::{Field, Rational};
use crate::scheme::catmull_clark;

fn letter(name: &str) -> Rational {
    let found = printed::LETTERS.iter().find(|(letter, _)| *letter == name);
    let (_, (p, q)) = found.expect("a printed letter");
    Rational::ratio(*p, *q)
}

/// What the print says of row `row` (from 0, 1..=2N) and column `column` of (10): the first and the last
/// rows as they stand; `None` where only dots are printed.
fn printed_ring_entry(n: usize, row: usize, column: usize) -> Option<Rational> {
    let size = 2 * n + 1;
    let line = match row {
        1..=4 => printed::EQ_10_FIRST[row - 1],
        _ if row + 2 >= size => printed::EQ_10_LAST[row + 2 - size],
        _ => return None,
    };
    let entries: Vec<&str> = line.split_whitespace().collect();
    if column < 6 {
        Some(letter(entries[column]))
    } else if column + 2 >= size {
        Some(letter(entries[column + 9 - size]))
    } else {
        None
    }
}

/// The whole ring block: rows V2 and V3, as printed, shifted cyclically by two columns per sector.
fn shifted_ring_entry(n: usize, row: usize, column: usize) -> Rational {
    if column == 0 {
        return letter(if row % 2 == 1 { "d" } else { "f" });
    }
    let ring = 2 * n;
    let sector = (row - 1) / 2;
    let at = (column - 1 + ring - 2 * sector) % ring;
    let line = if row % 2 == 1 {
        // d e e at V2 V3 V4, e e at V(2N) V(2N+1).
        let first = ["d", "e", "e"].get(at).copied();
        first.unwrap_or(if at + 2 >= ring { "e" } else { "0" })
    } else {
        ["f", "f", "f"].get(at).copied().unwrap_or("0")
    };
    letter(line)
}

/// The entries (row, column), from 1, at which the layout of (10), taken at its word, is not what its rows
/// V2 and V3 become round the ring; for N >= 4 (at N = 3 the columns overlap).
pub fn ring_disagreements(n: usize) -> Vec<(usize, usize)> {
    let rows = 1..=2 * n;
    let entries = rows.flat_map(|row| (0..=2 * n).map(move |column| (row, column)));
    let differ = entries.filter(|&(row, column)| {
        let printed = printed_ring_entry(n, row, column);
        printed.is_some_and(|entry| entry != shifted_ring_entry(n, row, column))
    });
    differ.map(|(row, column)| (row + 1, column + 1)).collect()
}

/// The matrix T of (9) with its blocks as printed; at N = 3 column V8 is added to V2.
pub fn printed_matrix(n: usize) -> Vec<Vec<Rational>> {
    let (ring_size, size) = (2 * n + 1, 2 * n + 8);
    let mut matrix = vec![vec![Rational::zero(); size]; size];
    for (column, entry) in matrix[0][..ring_size].iter_mut().enumerate() {
        let which = match column {
            0 => 0,
            _ if column % 2 == 1 => 1,
            _ => 2,
        };
        *entry = printed::at(printed::FIRST_ROW[which], n as u32);
    }
    for (row, entries) in matrix.iter_mut().enumerate().take(ring_size).skip(1) {
        for (column, entry) in entries.iter_mut().enumerate().take(ring_size) {
            *entry = shifted_ring_entry(n, row, column);
        }
    }
    for (i, line) in printed::EQ_11.iter().enumerate() {
        for (column, name) in line.split_whitespace().enumerate() {
            let wrapped = match column < ring_size {
                true => column,
                false => column - 2 * n,
            };
            matrix[ring_size + i][wrapped] += letter(name);
        }
    }
    for (i, line) in printed::EQ_12.iter().enumerate() {
        for (column, name) in line.split_whitespace().enumerate() {
            matrix[ring_size + i][ring_size + column] = letter(name);
        }
    }
    matrix
}

/// What is true of the matrix of a valence, by exact arithmetic on all its entries.
#[derive(Clone, Debug)]
pub struct Facts {
    n: u32,
    printed: bool,
    layout: Vec<(usize, usize)>,
    stochastic: bool,
    borders: bool,
    square: bool,
    diagonal: bool,
    stationary: bool,
    idempotent: bool,
    trace: Rational,
    limit_mask: bool,
    /// The largest row sum of the block T_(1,2).
    outer: Rational,
}

impl Facts {
    /// Of a valence.
    pub fn of(n: u32) -> Self {
        let whole = catmull_clark::subdivision_matrix::<Rational>(n);
        let size = 2 * n as usize + 1;
        let ring = whole.view((0, 0), (size, size)).into_owned();
        let rows = printed_matrix(n as usize);
        let agree =
            |(i, row): (usize, &Vec<Rational>)| (0..row.len()).all(|j| whole[(i, j)] == row[j]);
        let positive = |m: &DMatrix<Rational>| m.iter().all(Rational::is_positive);
        let [centre, edge, face] = printed::deltas(n);
        let delta = DMatrix::from_fn(1, size, |_, j| match j {
            0 => centre.clone(),
            _ if j % 2 == 1 => edge.clone(),
            _ => face.clone(),
        });
        let limit = DMatrix::from_fn(size, size, |_, j| delta[(0, j)].clone());
        let mask = catmull_clark::limit_mask::<Rational>(n);
        let outer = whole.view((size, size), (7, 7)).into_owned();
        let outer_sums = (0..7).map(|i| outer.row(i).iter().sum::<Rational>());
        Facts {
            n,
            printed: rows.iter().enumerate().all(agree),
            layout: match n {
                3 => Vec::new(),
                _ => ring_disagreements(n as usize),
            },
            stochastic: whole.iter().all(|x| !x.is_negative())
                && (0..whole.nrows()).all(|i| whole.row(i).iter().sum::<Rational>().is_one()),
            borders: (0..size).all(|i| !ring[(i, 0)].is_zero() && !ring[(0, i)].is_zero()),
            square: positive(&(&ring * &ring)),
            diagonal: (0..size).all(|i| !ring[(i, i)].is_zero()),
            stationary: &delta * &ring == delta && delta.iter().sum::<Rational>().is_one(),
            idempotent: &limit * &limit == limit,
            trace: (0..size).map(|i| &limit[(i, i)]).sum(),
            limit_mask: [centre, edge, face] == [mask.center, mask.edge, mask.face],
            outer: outer_sums.max().unwrap_or_else(Rational::zero),
        }
    }
}

/// The claims.
pub fn claims(found: &[&Facts], scope: &str) -> Vec<Claim> {
    let truths = |of: fn(&Facts) -> bool| -> Vec<(u32, Option<bool>)> {
        found.iter().map(|f| (f.n, Some(of(f)))).collect()
    };
    let plain = |id, place, statement: &str, of: fn(&Facts) -> bool, sentence: &str| {
        let truths = truths(of);
        let verdict = Verdict::of(crate::paper::words::all(truths.iter().map(|t| t.1)));
        claim(
            id,
            place,
            statement,
            verdict,
            if_true(&truths, sentence),
            scope,
        )
    };
    vec![
        vectors(scope),
        matrix(found, scope),
        plain(
            "stochastic",
            "section 2.2.1",
            "All entries of T are nonnegative and each row sums to one.",
            |f| f.stochastic,
            "added up exactly",
        ),
        plain(
            "irreducible",
            "section 2.2.1",
            "The first row and the first column of T̄ have no zero, so T̄² has none and T̄ is irreducible.",
            |f| f.borders && f.square,
            "all entries of T̄² are positive",
        ),
        plain(
            "aperiodic",
            "section 2.2.1",
            "The diagonal of T̄ has no zero, and T̄^n none for n >= 2: the chain is ergodic.",
            |f| f.diagonal && f.square && f.stochastic,
            "T̄² is positive, and a positive matrix times a stochastic one without zero columns is positive",
        ),
        plain(
            "deltas",
            "(14), (15)",
            "Δ_1 = N/(N+5), Δ_2j = 4/(N(N+5)), Δ_(2j+1) = 1/(N(N+5)) solve (15).",
            |f| f.stationary && f.square,
            "Δ T̄ = Δ exactly and the sum is 1; unique, as T̄² is positive",
        ),
        plain(
            "idempotent",
            "section 2.2.1",
            "T̄* is idempotent, with the eigenvalues 1 and 0 (of multiplicity 2N).",
            |f| f.idempotent && f.trace.is_one(),
            "T̄* T̄* = T̄* exactly, and the trace, which is the multiplicity of 1, is 1",
        ),
        plain(
            "eigenvalues",
            "section 2.2.1",
            "1 is an eigenvalue of T̄, the 2N others have a magnitude smaller than one.",
            |f| f.stochastic && f.square,
            "T̄ is stochastic and T̄² positive: 1 is simple and the only eigenvalue on the circle (Perron)",
        ),
        limit_point(found, scope),
    ]
}

fn vectors(scope: &str) -> Claim {
    let size = catmull_clark::local_net_size(3) - 2 * 3;
    let printed = printed::ENTRIES_OF_H_LESS_2N;
    let verdict = match printed == size {
        true => Verdict::True,
        false => Verdict::Misprint,
    };
    Claim {
        method: Some("H_n starts at V_1".into()),
        ..claim(
            "vectors",
            "before (8)",
            "H_n = (V_0, V_1, .., V_2N+8) (as scanned), so that H_n = T^n H_0 (8).",
            verdict,
            format!(
                "these are 2N + {printed} entries; T has 2N + {size} columns and there is no V_0"
            ),
            scope,
        )
    }
}

fn matrix(found: &[&Facts], scope: &str) -> Claim {
    let verdicts: Vec<(u32, Verdict)> = found
        .iter()
        .map(|f| (f.n, Verdict::of(Some(f.printed))))
        .collect();
    let odd = found.iter().filter(|f| !f.layout.is_empty());
    let odd: Vec<String> = odd
        .map(|f| format!("; at N = {} the layout of (10), six columns, dots, two columns, has a zero at (row, column) {:?} that must be e", f.n, f.layout))
        .collect();
    claim(
        "matrix",
        "(9)-(12)",
        "T is the subdivision matrix of the 2N + 8 points, with a_N = 1 - 7/(4N), b_N = 3/(2N²), c_N = 1/(4N²).",
        gravest(&verdicts),
        format!(
            "every entry against the matrix derived from the masks: {}. At N = 3 the blocks (11) have two \
             columns too many: V8 is V2, the ninth is zero{}",
            by_verdict(&verdicts),
            odd.concat()
        ),
        scope,
    )
}

fn limit_point(found: &[&Facts], scope: &str) -> Claim {
    let truths: Vec<(u32, Option<bool>)> = found
        .iter()
        .map(|f| {
            (
                f.n,
                Some(f.limit_mask && f.stationary && f.square && f.outer < Rational::one()),
            )
        })
        .collect();
    let outer = found.iter().map(|f| &f.outer).max();
    claim(
        "limit-point",
        "section 2.2.1, Appendix B",
        "Σ Δ_i V_i is the limit point S(0,0) of all V_j^n, j <= 2N + 8.",
        Verdict::of(crate::paper::words::all(truths.iter().map(|t| t.1))),
        format!(
            "{}: Δ is the limit mask; the rows of T_(1,2) sum to at most {}, so the outer points follow (the \
             text at hand has no Appendix B)",
            exceptions(&truths),
            outer.map_or("-".into(), |x| x.to_string())
        ),
        scope,
    )
}
