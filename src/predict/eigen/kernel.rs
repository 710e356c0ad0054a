//! The coefficients of a two-ring net and the sums over its modes, in `f64` with a rounding bound.
//!
//! A kernel belongs to a valence; it has flat arrays only, and nothing is allocated per vertex.
//!
//! **A generalised mode** (n = 3) is determined up to a multiple of f = Σ of the modes Ray. Distances belong to the one
//! whose b_j are 0 ([`crate::spectrum::eigenspline::mode`]), `v - b f` for the spectrum's v with b_j = b; as
//! `p v = p (v - b f) + Σ p b ray_j`, the coefficients of the modes Ray are those of the spectrum and p b.
//!
//! # The rounding bound
//!
//! In the standard model of [`crate::scalar::float`], u = 2^-53. Left eigenvectors L of the modes that
//! count vanish on constants, so `p = Σ L_q d_q`, `d_q = Q_q - Q_0`. Let `|d_q| <= D` per coordinate, let
//! the points be off by r per coordinate, and L^ the midpoint of an enclosure of L of width w. A row has N
//! terms, computed as products and sums from 0: at most N roundings each. With A = Σ max |L_q| per
//! coordinate
//!
//! ```text
//! |p^ - p| <= γ_N Σ|L^| D + Σ w D + Σ|L| (2r + u D) <= (γ_(N+1) A + Σ w) D + 2 A r,
//! ```
//!
//! and √3 times that as a vector. A largest singular value changes by at most the Frobenius norm, hence by
//! at most the sum of the changes of the two columns. `|p^|`, the singular value
//! `sqrt((a + c)/2 + sqrt(((a - c)/2)^2 + b^2))`, a = |p_c|^2, c = |p_s|^2, b = p_c · p_s, |b| <= (a + c)/2, and
//! the sums of nonnegative terms have relative errors: no more than 64 roundings before, and one for
//! each term of the sums. [`Kernel::outward`] is that factor. Underflow adds less than 2^-1000; the caller
//! scales meshes to a size of about 1, and `TINY` is added.

use crate::scalar::float::{UNIT_ROUNDOFF, gamma};
use crate::scalar::{Interval, Ring};
use crate::scheme::LoopWeights;
use crate::spectrum::loop_modes::{Family, loop_modes};

/// More than underflow can take from a sum.
const TINY: f64 = 1e-150;

/// How local modes are summed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Sum {
    /// The largest sum of a sector, pairs by their singular value.
    #[default]
    BySector,
    /// The paper's (15): all modes, pairs by the sum of both lengths.
    Plain,
}

/// A weight for each mode of a valence: distances μ, or what stands for them.
#[derive(Clone, Debug, PartialEq)]
pub struct ModeWeights {
    /// Ring modes of frequency 0, 2, 3, .., n/2.
    pub ring: Vec<f64>,
    /// The local mode Between.
    pub between: f64,
    /// The local mode Ray.
    pub ray: f64,
}

/// The modes of a valence that count: all but the constant and the frequency 1.
#[derive(Clone, Debug)]
pub struct Kernel {
    n: usize,
    /// Number of rows of each ring mode, 1 or 2.
    parts: Vec<u8>,
    /// Upper bounds of the eigenvalues' magnitudes: ring modes, Between, Ray.
    eigenvalues: ModeWeights,
    /// Rows: ring modes, then Between by sectors, then Ray.
    starts: Vec<u32>,
    columns: Vec<u32>,
    weights: Vec<f64>,
    /// √3 (γ A + Σ w), √3 2 A.
    slack: Vec<f64>,
    mass: Vec<f64>,
}

/// Upper bounds of the lengths of the coefficients of a net.
#[derive(Clone, Debug, Default)]
pub struct Norms {
    /// Ring modes, then Between by sectors, then Ray.
    lengths: Vec<f64>,
    /// Ring modes: the sums of the lengths of both parts.
    plain: Vec<f64>,
}

impl Kernel {
    /// The kernel of a valence n >= 3.
    pub fn new(weights: LoopWeights, n: u32) -> Option<Self> {
        let (spectrum, modes) = loop_modes::<Interval>(weights, n)?;
        let mut kernel = Kernel {
            n: n as usize,
            parts: Vec::new(),
            eigenvalues: ModeWeights {
                ring: Vec::new(),
                between: 0.0,
                ray: 0.0,
            },
            starts: vec![0],
            columns: Vec::new(),
            weights: Vec::new(),
            slack: Vec::new(),
            mass: Vec::new(),
        };
        for (mode, members) in &modes {
            let size = mode.eigenvalue.mag();
            match mode.family {
                Family::Constant => continue,
                Family::Ring if mode.frequency == 1 => continue,
                Family::Ring => {
                    kernel.parts.push(members.len() as u8);
                    kernel.eigenvalues.ring.push(size);
                }
                Family::Between => kernel.eigenvalues.between = size,
                Family::Ray => kernel.eigenvalues.ray = size,
            }
            for (part, &member) in members.iter().enumerate() {
                let mut row = spectrum.left(member);
                if mode.family == Family::Ray {
                    for (v, of) in modes.iter().filter(|(v, _)| v.generalised.is_some()) {
                        let left = spectrum.left(of[0]);
                        row.iter_mut()
                            .zip(&left)
                            .for_each(|(x, p)| *x += *p * v.ray);
                    }
                }
                if mode.family == Family::Ring && part == 1 {
                    // The odd net is Im v / sin: the coefficient of Im v itself is divided by the sine.
                    let sine = spectrum.sine_squared(mode.frequency).sqrt()?;
                    row.iter_mut().for_each(|x| *x /= sine);
                }
                kernel.push(&row);
            }
        }
        Some(kernel)
    }

    fn push(&mut self, row: &[Interval]) {
        let zero = Interval::from_integer(0);
        let (mut size, mut width, mut terms) = (0.0_f64, 0.0_f64, 0);
        for (column, &x) in row.iter().enumerate() {
            // An exact 0 has no term. The centre's d is 0.
            if x == zero || column == 0 {
                continue;
            }
            self.columns.push(column as u32);
            self.weights.push(x.mid());
            size = (size + x.mag()).next_up();
            width = (width + x.wid()).next_up();
            terms += 1;
        }
        self.starts.push(self.columns.len() as u32);
        const ROOT_3: f64 = 1.732_050_808;
        self.slack
            .push(ROOT_3 * (gamma(terms + 2) * size + width) * 1.000_001);
        self.mass.push(ROOT_3 * 2.0 * size * 1.000_001);
    }

    /// The valence.
    pub fn valence(&self) -> usize {
        self.n
    }

    /// Upper bounds of |λ|.
    pub fn eigenvalues(&self) -> &ModeWeights {
        &self.eigenvalues
    }

    /// The number of ring modes that count: frequencies 0, 2, .., n/2.
    pub fn ring_modes(&self) -> usize {
        self.parts.len()
    }

    /// Multiplications of a decomposition, per coordinate.
    pub fn multiplications(&self) -> usize {
        self.weights.len()
    }

    /// `1 + γ`: what sums are multiplied by.
    pub fn outward(&self) -> f64 {
        1.0 + gamma(2 * self.slack.len() as u32 + 64)
    }

    /// The coefficient p^ of a row.
    #[inline]
    fn coefficient(&self, row: usize, net: &[[f64; 3]]) -> [f64; 3] {
        let range = self.starts[row] as usize..self.starts[row + 1] as usize;
        let mut sum = [0.0; 3];
        for (&column, &weight) in self.columns[range.clone()].iter().zip(&self.weights[range]) {
            let point = &net[column as usize];
            for i in 0..3 {
                sum[i] += weight * point[i];
            }
        }
        sum
    }

    /// Upper bounds of the lengths `|p_i|` of a net ([`super::isolation::gather`]) whose points are off by at
    /// most `radius` per coordinate. The net is moved to its centre.
    pub fn norms(&self, net: &mut [[f64; 3]], radius: f64, out: &mut Norms) {
        let center = net[0];
        let mut size = 0.0_f64;
        for point in net.iter_mut() {
            for i in 0..3 {
                point[i] -= center[i];
                size = size.max(point[i].abs());
            }
        }
        let error = |row: usize| self.slack[row] * size + self.mass[row] * radius;
        out.lengths.clear();
        out.plain.clear();
        let mut row = 0;
        for &parts in &self.parts {
            let p = self.coefficient(row, net);
            let (mut length, mut plain) = (dot(&p, &p).sqrt(), dot(&p, &p).sqrt());
            let mut off = error(row);
            if parts == 2 {
                let q = self.coefficient(row + 1, net);
                length = singular_value(dot(&p, &p), dot(&p, &q), dot(&q, &q));
                plain += dot(&q, &q).sqrt();
                off += error(row + 1);
            }
            out.lengths.push(length + off);
            out.plain.push(plain + off);
            row += usize::from(parts);
        }
        for row in row..self.slack.len() {
            let p = self.coefficient(row, net);
            out.lengths.push(dot(&p, &p).sqrt() + error(row));
        }
    }

    /// For each sector j an upper bound of `Σ |p_i| weight_i` over the modes with values there; the same for
    /// all with [`Sum::Plain`].
    ///
    /// Between of sector j reaches the sectors j - 1, j, j + 1 and Ray of j the sectors j - 1, j: the local net of
    /// a sector j holds d_(j-1), d_j, d_(j+1), b_j and b_(j+1).
    ///
    /// # Panics
    /// If there is not a weight for each ring mode.
    pub fn sums(&self, norms: &Norms, weights: &ModeWeights, sum: Sum, out: &mut Vec<f64>) {
        let (modes, n) = (self.parts.len(), self.n);
        assert_eq!(weights.ring.len(), modes, "a weight for each ring mode");
        let rings = match sum {
            Sum::BySector => &norms.lengths[..modes],
            Sum::Plain => &norms.plain[..],
        };
        let ring: f64 = rings.iter().zip(&weights.ring).map(|(p, w)| p * w).sum();
        let between = &norms.lengths[modes..modes + n];
        let ray = &norms.lengths[modes + n..];
        let finish = |total: f64| ((total + TINY) * self.outward()).next_up();
        out.clear();
        match sum {
            Sum::BySector => out.extend((0..n).map(|j| {
                let (before, after) = ((j + n - 1) % n, (j + 1) % n);
                let d = between[before] + between[j] + between[after];
                let b = ray[j] + ray[after];
                finish(ring + d * weights.between + b * weights.ray)
            })),
            Sum::Plain => {
                let d: f64 = between.iter().sum();
                let b: f64 = ray.iter().sum();
                let total = finish(ring + d * weights.between + b * weights.ray);
                out.extend(std::iter::repeat_n(total, n));
            }
        }
    }
}

#[inline]
fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The largest singular value of the matrix with the columns p, q, from a = p·p, b = p·q, c = q·q.
#[inline]
fn singular_value(a: f64, b: f64, c: f64) -> f64 {
    let half = 0.5 * (a - c);
    (0.5 * (a + c) + (half * half + b * b).sqrt()).sqrt()
}

/// `max(λ_i, 1/4)^m μ_i(0)` in place of `μ_i(m)`: the weights of `tab-eigen`, rounded upwards.
pub fn decayed(eigenvalues: &ModeWeights, start: &ModeWeights, m: u32) -> ModeWeights {
    let decay = |&lambda: &f64, &mu: &f64| {
        let rate = lambda.max(0.25);
        // m roundings upwards at most.
        rate.powi(m as i32) * mu * (1.0 + 4.0 * UNIT_ROUNDOFF * f64::from(m + 2))
    };
    let ring = eigenvalues.ring.iter().zip(&start.ring);
    ModeWeights {
        ring: ring.map(|(l, mu)| decay(l, mu)).collect(),
        between: decay(&eigenvalues.between, &start.between),
        ray: decay(&eigenvalues.ray, &start.ray),
    }
}
