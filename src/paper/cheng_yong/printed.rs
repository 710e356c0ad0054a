//! Every number and formula that the paper prints, as printed, with its place; nothing else is typed
//! here.
//!
//! Formulas in control points are written in the paper's letters: `V4` is V_4, `V2N+8` is V_(2N+8), and in
//! section 2.1 and Appendix A `V01` is V_(0,1). [`Functional::parse`](super::functional::Functional::parse)
//! reads them.

use crate::scalar::{Field, Rational};

/// `c_0 + c_1 / N + c_2 / N^2` as three pairs (p, q).
pub type InInverse = [(i64, i64); 3];

/// The value at a valence.
pub fn at(formula: InInverse, n: u32) -> Rational {
    let n = i64::from(n);
    let [(p0, q0), (p1, q1), (p2, q2)] = formula;
    Rational::ratio(p0, q0) + Rational::ratio(p1, q1 * n) + Rational::ratio(p2, q2 * n * n)
}

/// (10): its rows after the first, at the top. `.` marks an entry that the print leaves to its dots; the
/// last two columns are the last two of the matrix, whatever N.
pub const EQ_10_FIRST: [&str; 4] = [
    "d d e e 0 0 . e e",
    "f f f f 0 0 . 0 0",
    "d e e d e e . 0 0",
    "f 0 0 f f f . 0 0",
];

/// (10): its last two rows.
pub const EQ_10_LAST: [&str; 2] = ["d e 0 0 0 0 . d e", "f f 0 0 0 0 . f f"];

/// (11): columns V1..V9 of the rows V(2N+2)..V(2N+8).
pub const EQ_11: [&str; 7] = [
    "c 0 0 b a b 0 0 0",
    "e 0 0 e d d 0 0 0",
    "b 0 0 c b a b c 0",
    "e 0 0 0 0 d d e 0",
    "e 0 0 d d e 0 0 0",
    "b c b a b c 0 0 0",
    "e e d d 0 0 0 0 0",
];

/// (12): columns V(2N+2)..V(2N+8) of the same rows.
pub const EQ_12: [&str; 7] = [
    "c b c 0 b c 0",
    "0 e e 0 0 0 0",
    "0 c b c 0 0 0",
    "0 0 e e 0 0 0",
    "0 0 0 0 e e 0",
    "0 0 0 0 c b c",
    "0 0 0 0 0 e e",
];

/// After (12): the letters.
pub const LETTERS: [(&str, (i64, i64)); 7] = [
    ("0", (0, 1)),
    ("a", (9, 16)),
    ("b", (3, 32)),
    ("c", (1, 64)),
    ("d", (3, 8)),
    ("e", (1, 16)),
    ("f", (1, 4)),
];

/// After (12): a_N, b_N, c_N.
pub const FIRST_ROW: [InInverse; 3] = [
    [(1, 1), (-7, 4), (0, 1)],
    [(0, 1), (0, 1), (3, 2)],
    [(0, 1), (0, 1), (1, 4)],
];

/// Before (8): H_n runs from V_0 to V_(2N+8); so the number of its entries less 2N.
pub const ENTRIES_OF_H_LESS_2N: usize = 9;

/// After (15): Δ_1, Δ_2 = Δ_4 = .., Δ_3 = Δ_5 = ..
pub fn deltas(n: u32) -> [Rational; 3] {
    let n = i64::from(n);
    [
        Rational::ratio(n, n + 5),
        Rational::ratio(4, n * (n + 5)),
        Rational::ratio(1, n * (n + 5)),
    ]
}

/// (17): the centre of (18), and the labels of Φ_1, Φ_2, Φ_3; Φ_0 is V1 .. V2N+1 about V1.
pub const PHI: [(&str, &str); 3] = [
    ("V6", "V1 V4 V5 V6 V7 V8 V2N+3 V2N+4 V2N+5"),
    ("V5", "V1 V4 V5 V6 V2N+2 V2N+3 V2N+4 V2N+6 V2N+7"),
    ("V4", "V1 V2 V3 V4 V5 V6 V2N+6 V2N+7 V2N+8"),
];

/// (19), (45): the rate for N >= 5 (in (45) for N = 3, too).
pub const RATE: InInverse = [(3, 4), (7, 4), (-13, 2)];

/// (19): the rate for N = 3.
pub const RATE_OF_3: (i64, i64) = (3, 4);

/// (19): the rate; `None` at N = 4, for which nothing is printed.
pub fn rate(n: u32) -> Option<Rational> {
    match n {
        3 => Some(Rational::ratio(RATE_OF_3.0, RATE_OF_3.1)),
        4 => None,
        _ => Some(at(RATE, n)),
    }
}

/// (20): the factor; also before it.
pub const BALL: (i64, i64) = (7, 4);

/// Before (21): the N of the largest rate.
pub const LARGEST_AT: i64 = 7;

/// (22), (23): δ for N = 3 and for N >= 5.
pub const DELTA: [(i64, i64); 2] = [(4, 3), (98, 85)];

/// (22): δ; `None` at N = 4.
pub fn delta(n: u32) -> Option<Rational> {
    let (p, q) = match n {
        3 => DELTA[0],
        4 => return None,
        _ => DELTA[1],
    };
    Some(Rational::ratio(p, q))
}

/// (23): `n_ε = ⌈log_δ (x G^0 / ε)⌉` has this x.
pub const EQ_23_FACTOR: (i64, i64) = (7, 2);

/// (3), (6), (7), (25), (28)..(32): the third.
pub const THIRD: (i64, i64) = (1, 3);

/// (5), (29)..(32): the quarter.
pub const QUARTER: (i64, i64) = (1, 4);

/// (24): the corners of L_3 at (0,0), (1,0), (1,1), (0,1), level-k labels.
pub const EQ_24: [&str; 4] = ["V4", "V5", "V2N+6", "V2N+7"];

/// (27): W for N = 3, N = 5 and N > 5.
pub const EQ_27: [InInverse; 3] = [
    [(2, 3), (0, 1), (0, 1)],
    [(1, 2), (1, 4), (21, 4)],
    [(3, 4), (2, 1), (-21, 2)],
];

/// Appendix D: the bound of its first case for N = 3, N = 5 and N > 5.
pub const APPENDIX_D: [InInverse; 3] = [
    [(2, 3), (0, 1), (0, 1)],
    [(1, 2), (1, 4), (21, 4)],
    [(3, 4), (2, 4), (-21, 2)],
];

/// Appendix D: the bound of its second case.
pub const APPENDIX_D_SECOND: InInverse = [(1, 4), (1, 1), (-7, 4)];

/// The value of [`EQ_27`] or [`APPENDIX_D`]; `None` at N = 4.
pub fn by_case(cases: [InInverse; 3], n: u32) -> Option<Rational> {
    match n {
        3 => Some(at(cases[0], n)),
        4 => None,
        5 => Some(at(cases[1], n)),
        _ => Some(at(cases[2], n)),
    }
}

/// A displayed equation of Appendix A: second difference of level i + 1, what it is said to be in level i.
/// All are followed by `<= M / 4`.
pub struct Regular {
    /// The name of the claim.
    pub id: &'static str,
    /// The number.
    pub place: &'static str,
    /// The category.
    pub category: &'static str,
    /// Points of level i + 1.
    pub left: &'static str,
    /// Points of level i.
    pub right: &'static str,
}

/// (37)..(40).
pub const APPENDIX_A: [Regular; 4] = [
    Regular {
        id: "eq-37",
        place: "(37)",
        category: "F-E-F",
        left: "2 V01 - V02 - V00",
        right: "1/8 ( 2 V01 - V02 - V00 ) + 1/8 ( 2 V11 - V12 - V10 )",
    },
    Regular {
        id: "eq-38",
        place: "(38)",
        category: "E-F-E",
        left: "2 V02 - V03 - V01",
        right: "1/16 ( 2 V02 - V03 - V01 + 2 V01 - V02 - V00 + 2 V12 - V13 - V11 + 2 V11 - V12 - V10 )",
    },
    Regular {
        id: "eq-39",
        place: "(39)",
        category: "E-V-E",
        left: "2 V11 - V12 - V10",
        right: "1/32 ( 2 V01 - V02 - V00 ) + 3/16 ( 2 V11 - V12 - V10 ) + 1/32 ( 2 V21 - V22 - V20 )",
    },
    Regular {
        id: "eq-40",
        place: "(40)",
        category: "V-E-V",
        left: "2 V12 - V13 - V11",
        right: "1/64 ( 2 V02 - V03 - V01 + 2 V01 - V02 - V00 ) \
                + 3/32 ( 2 V12 - V13 - V11 + 2 V11 - V12 - V10 ) \
                + 1/64 ( 2 V22 - V23 - V21 + 2 V21 - V22 - V20 )",
    },
];

/// Appendix A: every category has so many second differences.
pub const PER_CATEGORY: usize = 4;

/// A displayed estimate of Appendix C.
pub struct Estimate {
    /// The name of the claim.
    pub id: &'static str,
    /// The number.
    pub place: &'static str,
    /// The difference of points of level i + 1 whose norm is estimated.
    pub left: &'static str,
    /// Its first rewriting, level i, up to the sign.
    pub first: Option<&'static str>,
    /// The regrouping into differences.
    pub second: &'static str,
    /// The bound is this ..
    pub factor: (i64, i64),
    /// .. times the largest of these G_j.
    pub norms: &'static [usize],
}

/// (46), (47), (48), (50), (51).
pub const APPENDIX_C: [Estimate; 5] = [
    Estimate {
        id: "eq-46",
        place: "(46)",
        left: "V4 - V2N+8",
        first: Some("1/16 ( V2N+8 + V2N+7 - V6 - V5 ) + 5/16 ( V3 - V1 )"),
        second: "1/16 ( V2N+8 - V4 ) + 1/16 ( V2N+7 - V4 ) + 1/16 ( V4 - V6 ) + 1/16 ( V4 - V5 ) \
                 + 5/16 ( V3 - V1 )",
        factor: (9, 16),
        norms: &[0, 3],
    },
    Estimate {
        id: "eq-47",
        place: "(47)",
        left: "V4 - V3",
        first: Some("3/16 ( V2 + V3 ) - 1/16 ( V6 + V5 ) - 1/8 ( V1 + V4 )"),
        second: "3/16 ( V2 - V1 ) + 1/16 ( V3 - V4 ) + 1/16 ( V1 - V6 ) + 1/16 ( V4 - V5 )",
        factor: (1, 2),
        norms: &[0, 3],
    },
    Estimate {
        id: "eq-48",
        place: "(48)",
        left: "V4 - V2N+7",
        first: Some(
            "3/16 V4 - 9/32 V1 + 1/32 ( V3 + V5 ) + 3/32 V2N+7 - 3/64 ( V6 + V2 ) \
             + 1/64 ( V2N+8 + V2N+6 )",
        ),
        second: "1/64 ( V2N+8 - V4 ) + 3/32 ( V2N+7 - V4 ) + 1/64 ( V2N+6 - V4 ) + 9/32 ( V4 - V1 ) \
                 + 3/64 ( V1 - V6 ) + 3/64 ( V1 - V2 ) + 1/32 ( V3 - V1 ) + 1/32 ( V5 - V1 )",
        factor: (9, 16),
        norms: &[0, 3],
    },
    Estimate {
        id: "eq-50",
        place: "(50)",
        left: "V2N+6 - V5",
        first: Some("- 3/16 ( V1 + V6 ) + 1/8 ( V4 + V5 ) + 1/16 ( V2N+7 + V2N+6 )"),
        second: "3/16 ( V4 - V1 ) + 3/16 ( V5 - V6 ) + 1/16 ( V2N+7 - V4 ) + 1/16 ( V2N+6 - V5 )",
        factor: (1, 2),
        norms: &[1, 2, 3],
    },
    Estimate {
        id: "eq-51",
        place: "(51)",
        left: "V2N+2 - V5",
        first: None,
        second: "3/32 ( V2N+6 - V5 ) - 1/64 ( V2N+2 - V5 ) - 3/32 ( V2N+3 + V5 ) + 1/64 ( V2N+4 - V6 ) \
                 + 1/64 ( V2N+7 - V4 ) + 9/64 ( V5 - V6 ) + 9/64 ( V5 - V4 ) + 15/64 ( V5 - V1 )",
        factor: (3, 4),
        norms: &[1, 2, 3],
    },
];

/// (49): the factor, about V4.
pub const EQ_49: (i64, i64) = (9, 16);

/// (52): the factor, about V5.
pub const EQ_52: (i64, i64) = (3, 4);

/// Appendix D, N = 3: 144 times the second difference, as (factor, (b, a, c)) for `2 V_b - V_a - V_c`.
pub const APPENDIX_D_OF_3: [(i64, [usize; 3]); 6] = [
    (5, [2, 3, 7]),
    (5, [6, 7, 5]),
    (-4, [4, 3, 5]),
    (-19, [1, 4, 2]),
    (-19, [1, 4, 6]),
    (44, [1, 2, 6]),
];

/// Appendix D: the second differences `2 V_b - V_a - V_c` of level k that may exceed Z / 4.
pub const APPENDIX_D_EXCEPT: [&str; 3] =
    ["2 V1 - V2 - V6", "2 V6 - V1 - V2N+4", "2 V4 - V1 - V2N+7"];

/// Section 4, Figure 6(c): (1 / ε in hundredths, depth), an extraordinary vertex of valence 5.
pub const FIGURE_6C: [(i64, i64); 6] = [
    (400, 1),
    (500, 3),
    (1_000, 9),
    (10_000, 24),
    (100_000, 40),
    (1_000_000, 56),
];

/// Section 4: figure, valence if extraordinary, distance in thousandths, depth for ε = 0.01.
pub const FIGURE_6: [(&str, Option<u32>, i64, i64); 3] = [
    ("6(a)", None, 34, 1),
    ("6(b)", Some(8), 150, 22),
    ("6(c)", Some(5), 250, 24),
];

/// Counts of vertices, edges and faces.
pub type Counts = [i64; 3];

/// Section 4: what is refined, uniform depth, counts after uniform and after adaptive refinement.
pub const COUNTS: [(&str, u32, Counts, Counts); 3] = [
    (
        "rocker arm, ε = 0.25",
        2,
        [22_656, 45_312, 22_656],
        [2_706, 5_412, 2_706],
    ),
    (
        "rocker arm, ε = 0.2",
        4,
        [362_496, 724_992, 362_496],
        [9_022, 18_044, 9_022],
    ),
    (
        "ventilation controller, ε = 0.15",
        3,
        [388_068, 776_192, 388_096],
        [9_814, 19_684, 9_842],
    ),
];

/// Section 4: what is said of the three: adaptive over uniform.
pub const SAID: [(i64, i64); 3] = [(3, 25), (1, 40), (1, 40)];

/// Abstract: "usually less than one-tenth".
pub const USUALLY: (i64, i64) = (1, 10);
