//! Every number that the paper prints, as printed, with its place; nothing else is typed here.

use crate::paper::Printed;

/// The valences of Tables 1, 2 and 3.
pub const VALENCES: [u32; 8] = [3, 4, 5, 6, 7, 8, 9, 10];

/// Section 4.2: facts 1 and 2 and β(n) were investigated for these valences, both ends included.
pub const INVESTIGATED: (u32, u32) = (3, 50);

/// A row of decimals for [`VALENCES`].
pub type Row = [Printed; 8];

const fn row(texts: [&'static str; 8]) -> Row {
    let mut row = [Printed::new(texts[0]); 8];
    let mut i = 1;
    while i < 8 {
        row[i] = Printed::new(texts[i]);
        i += 1;
    }
    row
}

/// The entry of a row for a valence, if the table has it.
pub fn at(row: &Row, n: u32) -> Option<Printed> {
    let place = VALENCES.iter().position(|&valence| valence == n)?;
    Some(row[place])
}

/// Section 3.2, after (6): δ_1 .. δ_15 over 12.
pub const DELTAS_IN_TWELFTHS: [i64; 15] = [0, 3, 3, 4, 5, 4, 3, 5, 5, 3, 0, 3, 4, 3, 0];

/// Section 3.2 and Theorem 1: `B(v, w) = Σ c v^j w^k` as (c, j, k).
pub const BOUND_FUNCTION: [(i64, usize, usize); 5] =
    [(1, 1, 0), (1, 0, 1), (-1, 2, 0), (-1, 1, 1), (-1, 0, 2)];

/// Theorem 2: the largest distance, and the (v, w) where B takes it; thirds.
pub const THEOREM_2_IN_THIRDS: (i64, [i64; 2]) = (1, [1, 1]);

/// Table 1: r_1, r_2, r_3.
pub const TABLE_1: [Row; 3] = [
    row([
        "0.437500", "0.382813", "0.540907", "0.250000", "0.674025", "0.705136", "0.726355",
        "0.741711",
    ]),
    row([
        "0.082031", "0.142700", "0.258367", "0.062500", "0.372582", "0.402608", "0.424000",
        "0.439960",
    ]),
    row([
        "0.020752", "0.053148", "0.118899", "0.015625", "0.197695", "0.219995", "0.236377",
        "0.248872",
    ]),
];

/// Section 5.1: c_4(3) and c_1(3).
pub const C_4_OF_3: Printed = Printed::new("0.4375");
/// Section 5.1: c_1(3).
pub const C_1_OF_3: Printed = Printed::new("0.3125");

/// Table 2, first row: C_3(n).
pub const TABLE_2_CONTROL: Row = row([
    "0.872850", "0.780397", "0.858623", "0.500000", "0.875407", "0.866176", "0.856245", "0.847476",
]);

/// Table 2, second row: β(n).
pub const TABLE_2_LIMIT: Row = row([
    "0.358813", "0.350722", "0.342499", "0.333333", "0.329252", "0.332001", "0.333880", "0.335299",
]);

/// Table 2 has C_λ for this λ.
pub const TABLE_2_LAMBDA: usize = 3;

/// Table 3, first row: control mesh.
pub const TABLE_3_CONTROL: [i64; 8] = [8, 10, 14, 7, 19, 21, 22, 23];

/// Table 3, second row: limit mesh.
pub const TABLE_3_LIMIT: [i64; 8] = [7, 9, 12, 6, 16, 17, 18, 18];

/// Section 6: Table 3 is for M / ε = 1 / 0.0001.
pub const TABLE_3_RATIO: i64 = 10_000;

/// Section 6: "a 20 % improvement .. in most of the cases".
pub const IMPROVEMENT_PERCENT: i64 = 20;

/// Appendix 1: 24 T.
pub const T_TIMES_24: [[i64; 12]; 15] = [
    [2, 2, 2, 12, 2, 0, 2, 2, 0, 0, 0, 0],
    [1, 0, 3, 12, 1, 0, 4, 3, 0, 0, 0, 0],
    [0, 1, 1, 12, 3, 0, 3, 4, 0, 0, 0, 0],
    [0, 0, 4, 8, 0, 0, 8, 4, 0, 0, 0, 0],
    [0, 0, 1, 10, 1, 0, 6, 6, 0, 0, 0, 0],
    [0, 0, 0, 8, 4, 0, 4, 8, 0, 0, 0, 0],
    [0, 0, 3, 4, 0, 1, 12, 3, 0, 0, 1, 0],
    [0, 0, 1, 6, 0, 0, 10, 6, 0, 0, 1, 0],
    [0, 0, 0, 6, 1, 0, 6, 10, 0, 0, 1, 0],
    [0, 0, 0, 4, 3, 0, 3, 12, 1, 0, 1, 0],
    [0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2, 0],
    [0, 0, 1, 3, 0, 0, 12, 4, 0, 1, 3, 0],
    [0, 0, 0, 4, 0, 0, 8, 8, 0, 0, 4, 0],
    [0, 0, 0, 3, 1, 0, 4, 12, 0, 0, 3, 1],
    [0, 0, 0, 2, 2, 0, 2, 12, 2, 0, 2, 2],
];
