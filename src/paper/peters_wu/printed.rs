//! Every number that the paper prints, as printed, with its place; nothing else is typed here.

use crate::paper::Printed;

/// A fraction as printed: numerator, denominator.
pub type Fraction = (i64, i64);

/// Rows of Table 1 of a model: `tab-eigen` 0, 1, 2, `tab-approx` 0, 1, 2, `tab-interp` 0, 1, 2,
/// `heuristic`, `measured`.
pub const ROWS: usize = 11;

/// Columns of Table 1: m = 0..5.
pub const LEVELS: usize = 6;

/// A model of Table 1.
#[derive(Clone, Copy, Debug)]
pub struct Model {
    /// Its name.
    pub name: &'static str,
    /// Figure 7: its number of input triangles.
    pub triangles: u32,
    /// The rows, each with its last entry at m = 5. The last digit of a few entries of the last column
    /// can't be read: they stand here with a digit less.
    pub rows: [&'static [Printed]; ROWS],
}

const fn p(text: &'static str) -> Printed {
    Printed::new(text)
}

/// Table 1, Loop subdivision.
#[rustfmt::skip]
pub const TABLE_1: [Model; 5] = [
    Model {
        name: "star",
        triangles: 96,
        rows: [
            // tab-eigen 0
            &[p("9.602865"), p("6.412230"), p("1.603057"), p("0.400764"), p("0.100191"), p("0.025044")],
            // tab-eigen 1
            &[p("1.189783"), p("0.792618"), p("0.198155"), p("0.049539"), p("0.012385")],
            // tab-eigen 2
            &[p("0.148528"), p("0.098793"), p("0.024698"), p("0.006175")],
            // tab-approx 0
            &[p("9.602865"), p("2.520464"), p("0.624280"), p("0.156891"), p("0.038926"), p("0.009284")],
            // tab-approx 1
            &[p("1.189783"), p("0.312280"), p("0.077330"), p("0.019439"), p("0.004823")],
            // tab-approx 2
            &[p("0.148528"), p("0.038983"), p("0.009652"), p("0.002427")],
            // tab-interp 0
            &[p("5.587574"), p("1.735903"), p("0.456955"), p("0.127762"), p("0.035283"), p("0.008853")],
            // tab-interp 1
            &[p("0.693271"), p("0.215440"), p("0.056655"), p("0.015838"), p("0.004374")],
            // tab-interp 2
            &[p("0.086626"), p("0.026923"), p("0.007077"), p("0.001978")],
            // heuristic
            &[p("0.493182"), p("0.082623"), p("0.020656"), p("0.005164"), p("0.001291"), p("0.000323")],
            // measured
            &[p("0.492493"), p("0.089411"), p("0.022129"), p("0.005563"), p("0.001380"), p("0.000329")],
        ],
    },
    Model {
        name: "demon",
        triangles: 1096,
        rows: [
            // tab-eigen 0
            &[p("24.765944"), p("16.506170"), p("4.126542"), p("1.031636"), p("0.257909"), p("0.064477")],
            // tab-eigen 1
            &[p("3.095206"), p("2.060041"), p("0.515010"), p("0.128753"), p("0.032188")],
            // tab-eigen 2
            &[p("0.741884"), p("0.342345"), p("0.085586"), p("0.021397")],
            // tab-approx 0
            &[p("24.765944"), p("6.500835"), p("1.609795"), p("0.404699"), p("0.100407"), p("0.023954")],
            // tab-approx 1
            &[p("3.095206"), p("0.812431"), p("0.201164"), p("0.050577"), p("0.012698")],
            // tab-approx 2
            &[p("0.741884"), p("0.191016"), p("0.048463"), p("0.012573")],
            // tab-interp 0
            &[p("14.433803"), p("4.485724"), p("1.179442"), p("0.329698"), p("0.091071"), p("0.02284")],
            // tab-interp 1
            &[p("1.805383"), p("0.561142"), p("0.147485"), p("0.041224"), p("0.011652")],
            // tab-interp 2
            &[p("0.535782"), p("0.151316"), p("0.041203"), p("0.011504")],
            // heuristic
            &[p("1.416932"), p("0.394898"), p("0.120230"), p("0.047276"), p("0.022095"), p("0.011099")],
            // measured
            &[p("1.517119"), p("0.404152"), p("0.124367"), p("0.044160"), p("0.018061"), p("0.007068")],
        ],
    },
    Model {
        name: "venus",
        triangles: 5672,
        rows: [
            // tab-eigen 0
            &[p("0.593524"), p("0.370544"), p("0.092636"), p("0.023159"), p("0.005790"), p("0.001447")],
            // tab-eigen 1
            &[p("0.126580"), p("0.061122"), p("0.015281"), p("0.004121"), p("0.001435")],
            // tab-eigen 2
            &[p("0.061062"), p("0.029721"), p("0.007430"), p("0.001858")],
            // tab-approx 0
            &[p("0.593524"), p("0.149792"), p("0.037612"), p("0.010438"), p("0.003224"), p("0.001014")],
            // tab-approx 1
            &[p("0.126580"), p("0.032788"), p("0.008344"), p("0.002606"), p("0.000880")],
            // tab-approx 2
            &[p("0.061062"), p("0.015708"), p("0.003983"), p("0.001001")],
            // tab-interp 0
            &[p("0.390317"), p("0.112818"), p("0.031481"), p("0.009628"), p("0.003051"), p("0.000964")],
            // tab-interp 1
            &[p("0.086038"), p("0.024413"), p("0.007181"), p("0.002444"), p("0.000835")],
            // tab-interp 2
            &[p("0.043881"), p("0.012317"), p("0.003329"), p("0.000897")],
            // heuristic
            &[p("0.155856"), p("0.038964"), p("0.009741"), p("0.002727"), p("0.001561"), p("0.000868")],
            // measured
            &[p("0.159851"), p("0.039848"), p("0.009971"), p("0.002858"), p("0.001006"), p("0.000361")],
        ],
    },
    Model {
        name: "liver",
        triangles: 1096,
        rows: [
            // tab-eigen 0
            &[p("1.842082"), p("1.244349"), p("0.311087"), p("0.077772"), p("0.019443"), p("0.004861")],
            // tab-eigen 1
            &[p("0.227004"), p("0.152919"), p("0.038230"), p("0.009557"), p("0.002389")],
            // tab-eigen 2
            &[p("0.101263"), p("0.043338"), p("0.010835"), p("0.002709")],
            // tab-approx 0
            &[p("1.842082"), p("0.483952"), p("0.119934"), p("0.030142"), p("0.007480"), p("0.00178")],
            // tab-approx 1
            &[p("0.227004"), p("0.059640"), p("0.014776"), p("0.003715"), p("0.001322")],
            // tab-approx 2
            &[p("0.101263"), p("0.026036"), p("0.006609"), p("0.001661")],
            // tab-interp 0
            &[p("1.074348"), p("0.334355"), p("0.088078"), p("0.024616"), p("0.006786"), p("0.001702")],
            // tab-interp 1
            &[p("0.132638"), p("0.041295"), p("0.010863"), p("0.003035"), p("0.001228")],
            // tab-interp 2
            &[p("0.071502"), p("0.020206"), p("0.005492"), p("0.001488")],
            // heuristic
            &[p("0.132813"), p("0.030822"), p("0.011009"), p("0.005372"), p("0.002973"), p("0.001761")],
            // measured
            &[p("0.132811"), p("0.029934"), p("0.008812"), p("0.003498"), p("0.001538"), p("0.000667")],
        ],
    },
    Model {
        name: "stomach",
        triangles: 2136,
        rows: [
            // tab-eigen 0
            &[p("1.522140"), p("1.030209"), p("0.257552"), p("0.064388"), p("0.016097"), p("0.004024")],
            // tab-eigen 1
            &[p("0.189760"), p("0.128229"), p("0.032057"), p("0.008014"), p("0.002249")],
            // tab-eigen 2
            &[p("0.061201"), p("0.025930"), p("0.006483"), p("0.002249")],
            // tab-approx 0
            &[p("1.522140"), p("0.399672"), p("0.098984"), p("0.024884"), p("0.006174"), p("0.001784")],
            // tab-approx 1
            &[p("0.189760"), p("0.049824"), p("0.012338"), p("0.004588"), p("0.001755")],
            // tab-approx 2
            &[p("0.061201"), p("0.015690"), p("0.004398"), p("0.001736")],
            // tab-interp 0
            &[p("0.888613"), p("0.276234"), p("0.072625"), p("0.020311"), p("0.005604"), p("0.001624")],
            // tab-interp 1
            &[p("0.110888"), p("0.034476"), p("0.010681"), p("0.004081"), p("0.00159")],
            // tab-interp 2
            &[p("0.043091"), p("0.012198"), p("0.003892"), p("0.001569")],
            // heuristic
            &[p("0.132700"), p("0.033175"), p("0.010174"), p("0.003857"), p("0.001909"), p("0.001003")],
            // measured
            &[p("0.133740"), p("0.033384"), p("0.012012"), p("0.005087"), p("0.002157"), p("0.000887")],
        ],
    },];

/// Introduction: the number of steps estimated loosely, and the sharp one.
pub const LOOSE_AND_SHARP: (u32, u32) = (10, 5);

/// Introduction: "the subsubdominant eigenvalue λ_3 := (3 + 2 cos 4π/n) / 8": the numbers 3, 2, 4, 8.
pub const SUBSUBDOMINANT: [i64; 4] = [3, 2, 4, 8];

/// Introduction: what λ_3 is close to for large n, and the rate of box splines.
pub const HIGH_VALENCE_RATE: Fraction = (5, 8);
/// The rate of box splines.
pub const REGULAR_RATE: Fraction = (1, 4);
/// Introduction: "four steps suffice for the regular polyhedron, close to twelve near high valences".
pub const STEPS: (u32, u32) = (4, 12);

/// Section 1.2, of Zeng & Chen 2006: the valence, the decrease per step ("ca."), the steps to a tenth.
pub const ZENG_CHEN: (u32, Printed, u32) = (8, p("0.8125"), 12);
/// Section 1.2: "the estimate based on n = 8 and hence λ_3 = .5 predicts only four steps".
pub const FOUR_STEPS: (Printed, u32) = (p("0.5"), 4);
/// "To cut the distance to 10 %".
pub const TENTH: Fraction = (1, 10);

/// Section 6: λ_3 = 1/2 for Catmull-Clark with n = 8, and for Loop with n = 12.
pub const HALF: (Fraction, u32, u32) = ((1, 2), 8, 12);

/// Example 1: the valence, λ_3, the values of the third coordinate at the centre and its neighbours.
pub const EXAMPLE_1: (u32, Fraction, [i64; 2]) = (4, (1, 4), [1, -1]);
/// Example 1, one step: the weights of q_0 and of the mean of its neighbours in the new centre, and the
/// factors of the first two coordinates and of the third of a new neighbour.
pub const EXAMPLE_1_STEP: [Fraction; 4] = [(5, 8), (3, 8), (3, 8), (-1, 4)];

/// Figure 5: the valence, the distance between the patches and the facets, the largest at a vertex.
pub const FIGURE_5: (u32, Printed, Printed) = (8, p("0.14"), p("0.08"));

/// Section 5: refinements and relative width of the enclosures behind `measured`.
pub const SANDWICH: (u32, Fraction) = (10, (1, 1_000_000));

/// Section 5: the valences of the tabulated bounds.
pub const TABULATED: (u32, u32) = (3, 30);

/// Section 5: n, m, and the adds and multiplications per coordinate.
pub const COST: (u32, u32, u32) = (7, 3, 180);

/// Section 5: seconds for the model venus: local subdivision and `tab-approx`; two steps and measuring.
pub const SECONDS: [[Printed; 2]; 2] = [[p("0.08"), p("0.27")], [p("0.43"), p("0.63")]];
/// Section 5: how many times as much measuring costs, at least.
pub const COST_FACTOR: i64 = 3;
/// Section 5: the model of those times, and its triangles.
pub const TIMED: (&str, u32) = ("venus", 5672);

/// Observation (4): unnecessary steps of `tab-approx 2`, and those of the model Star.
pub const UNNECESSARY: (u32, (&str, u32)) = (1, ("star", 2));
