//! Inequalities about closed meshes that are false for Loop's scheme: section 7 of FORMAT.md.

use std::collections::HashMap;

use num_bigint::BigInt;
use num_integer::Integer;
use num_rational::BigRational;
use num_traits::{One, Zero, pow};

use crate::claim::{MeshViolation, OfMesh, Weights};
use crate::cosine::rational_beta;
use crate::file::{File, Number, Step};
use crate::rational::{contrast, ratio};
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::violation::only_step;

/// The most vertices of a mesh.
const VERTICES: usize = 200_000;
/// The most bits of the common denominator of its points.
const BITS: u64 = 2048;
/// The most steps of refinement before those that an inequality asks for.
const LEVEL: usize = 6;

type Vector = [BigInt; 3];

/// A closed triangle mesh.
struct Mesh {
    weights: Weights,
    points: Vec<Vector>,
    /// The common denominator of the points.
    den: BigInt,
    faces: Vec<[usize; 3]>,
    /// The neighbours of each vertex, in order.
    rings: Vec<Vec<usize>>,
}

/// Shows that the inequality is false for the mesh.
///
/// # Errors
///
/// If and only if it is not: rule `mesh` for a mesh that is not closed or too large, or a valence with an irrational beta;
/// `cosine`, `bases`, `format`, `claim` if the file is not one for this claim; else the rule of the inequality's name.
pub fn check(file: &File, claim: &MeshViolation) -> Outcome<()> {
    ensure!(file.cosine.is_none(), Rule::Cosine, "\"cosine\" is null for a mesh");
    let (step, k) = (only_step(file)?, claim.level);
    let mesh = Mesh::first(claim)?;
    let (rule, levels) = match claim.inequality {
        OfMesh::Recurrence => (Rule::Recurrence, 0..=LEVEL),
        OfMesh::Rate => (Rule::Rate, 1..=LEVEL),
        OfMesh::Distance => (Rule::Distance, 0..=0),
    };
    ensure!(levels.contains(&k), rule, "the level is not within {levels:?}");
    // The left and the right side of the inequality, squared.
    let (left, right) = match (claim.inequality, step) {
        (OfMesh::Recurrence, Step::Recurrence(_)) => {
            let mesh = mesh.after(k)?;
            let right = pow(mesh.rho(), 2) * mesh.largest();
            (mesh.after(1)?.largest(), right)
        }
        (OfMesh::Rate, Step::Rate(_)) => {
            let first = mesh.largest();
            let mesh = mesh.after(k)?;
            (mesh.largest(), pow(mesh.rho(), 2 * k) * first)
        }
        (OfMesh::Distance, Step::Distance(step)) => (mesh.middle(step.edge)?, mesh.largest()),
        _ => return Err(Rejection::new(Rule::Claim, "the step is not that of the inequality")),
    };
    let (x, y) = contrast(&left, &right);
    ensure!(left > right, rule, "the square {x} is not above {y}");
    Ok(())
}

impl Mesh {
    /// The mesh of a claim.
    fn first(claim: &MeshViolation) -> Outcome<Self> {
        let rule = Rule::Mesh;
        let count = claim.vertices.len();
        ensure!(count <= VERTICES, rule, "more than {VERTICES} vertices");
        let known = claim.faces.iter().flatten().all(|vertex| (1..=count).contains(vertex));
        ensure!(known, rule, "a face with a vertex that there is not");
        let mut den = BigInt::one();
        for Number(x) in claim.vertices.iter().flatten() {
            den = den.lcm(x.denom());
            ensure!(den.bits() <= BITS, Rule::Format, "the denominators are too large");
        }
        let point = |vertex: &[Number; 3]| {
            vertex.each_ref().map(|Number(x)| x.numer() * (&den / x.denom()))
        };
        let points = claim.vertices.iter().map(point).collect();
        let faces = claim.faces.iter().map(|face| face.map(|vertex| vertex - 1)).collect();
        Self::new(claim.weights, points, den, faces)
    }

    /// The mesh with the rings that the faces form; it must be closed, and beta rational for each valence.
    fn new(
        weights: Weights,
        points: Vec<Vector>,
        den: BigInt,
        faces: Vec<[usize; 3]>,
    ) -> Outcome<Self> {
        let rule = Rule::Mesh;
        // After b, in the ring of a, comes c.
        let mut after = HashMap::new();
        let mut start = vec![(0, 0); points.len()];
        for &[a, b, c] in &faces {
            for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
                let once = a != b && after.insert((a, b), c).is_none();
                ensure!(once, rule, "the edge {}, {} is twice in one direction", a + 1, b + 1);
                start[a] = (start[a].0 + 1, b);
            }
        }
        let mut rings = Vec::new();
        for (a, &(count, first)) in start.iter().enumerate() {
            let next = |b: &usize| after.get(&(a, *b)).copied();
            let ring: Vec<_> = std::iter::successors(Some(first), next).take(count).collect();
            let closed = ring.len() == count && ring.last().and_then(next) == Some(first);
            let new = ring.iter().skip(1).all(|&b| b != first);
            ensure!(closed && new, rule, "the faces at {} form no fan", a + 1);
            let known = count >= 3 && rational_beta(weights, count).is_some();
            ensure!(known, rule, "vertex {} has the valence {count}", a + 1);
            rings.push(ring);
        }
        Ok(Self { weights, points, den, faces, rings })
    }

    fn beta(&self, n: usize) -> BigRational {
        rational_beta(self.weights, n).unwrap_or_default()
    }

    /// `Σ ring`.
    fn around(&self, vertex: usize) -> Vector {
        let ring = &self.rings[vertex];
        [0, 1, 2].map(|i| ring.iter().map(|&b| &self.points[b][i]).sum())
    }

    /// The mesh after k steps.
    fn after(self, k: usize) -> Outcome<Self> {
        (0..k).try_fold(self, |mesh, _| Ok(mesh.refined()?.0))
    }

    /// The mesh after one step, old vertices first, and the new vertices of the edges.
    fn refined(&self) -> Outcome<(Self, HashMap<[usize; 2], usize>)> {
        let count = self.points.len() + self.faces.len() * 3 / 2;
        ensure!(count <= VERTICES, Rule::Mesh, "more than {VERTICES} vertices");
        let masks: Vec<_> = (0..self.rings.iter().map(|ring| ring.len() + 1).max().unwrap_or(0))
            .map(|n| (BigRational::one() - self.beta(n), self.beta(n) / ratio(n.max(1) as i64, 1)))
            .collect();
        let used = self.rings.iter().map(|ring| &masks[ring.len()]);
        let grow = used.fold(BigInt::from(8), |m, (a, b)| m.lcm(a.denom()).lcm(b.denom()));
        let den = &self.den * &grow;
        ensure!(den.bits() <= BITS, Rule::Format, "the denominators are too large");
        let whole = |x: &BigRational| (x * &grow).to_integer();
        let masks: Vec<_> = masks.iter().map(|(a, b)| (whole(a), whole(b))).collect();
        let vertex = |a: usize| {
            let (around, (centre, share)) = (self.around(a), &masks[self.rings[a].len()]);
            [0, 1, 2].map(|i| centre * &self.points[a][i] + share * &around[i])
        };
        let mut points: Vec<_> = (0..self.points.len()).map(vertex).collect();
        let (mut edges, eighth) = (HashMap::new(), &grow / 8);
        for (a, ring) in self.rings.iter().enumerate() {
            for (i, &b) in ring.iter().enumerate().filter(|(_, b)| a < **b) {
                let sides = [i + ring.len() - 1, i + 1].map(|i| ring[i % ring.len()]);
                let [a_, b_, c, d] = [a, b, sides[0], sides[1]].map(|i| &self.points[i]);
                edges.insert([a, b], points.len());
                points.push(
                    [0, 1, 2]
                        .map(|i| &eighth * (BigInt::from(3) * (&a_[i] + &b_[i]) + &c[i] + &d[i])),
                );
            }
        }
        let middle = |a: usize, b: usize| edges[&[a.min(b), a.max(b)]];
        let four = |&[a, b, c]: &[usize; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        let faces = self.faces.iter().flat_map(four).collect();
        Ok((Self::new(self.weights, points, den, faces)?, edges))
    }

    /// The largest `5/8 - beta(n)` of a valence n in the mesh.
    fn rho(&self) -> BigRational {
        let rho = self.rings.iter().map(|ring| ratio(5, 8) - self.beta(ring.len()));
        rho.max().unwrap_or_default()
    }

    /// The largest `|P - P'|^2`: `P - P' = w/n (n P - Σ ring)`, `w = 8 beta/(3 + 8 beta)`.
    fn largest(&self) -> BigRational {
        // The largest of each valence, without the factors that they share.
        let mut squares = HashMap::new();
        for (a, ring) in self.rings.iter().enumerate() {
            let around = self.around(a);
            let square = norm(&[0, 1, 2].map(|i| &self.points[a][i] * ring.len() - &around[i]));
            let most = squares.entry(ring.len()).or_insert_with(BigInt::zero);
            *most = square.max(std::mem::take(most));
        }
        let whole = |(n, square): (usize, BigInt)| {
            let w = self.beta(n) * ratio(8, 1);
            let w = &w / (ratio(3, 1) + &w);
            pow(w / ratio(n as i64, 1) / &self.den, 2) * square
        };
        squares.into_iter().map(whole).max().unwrap_or_default()
    }

    /// `|S - (a + b)/2|^2`, S the limit point of the new vertex P of an edge (from 1): P/2 and a twelfth of its ring.
    fn middle(&self, edge: [usize; 2]) -> Outcome<BigRational> {
        let missing = || Rejection::new(Rule::Distance, "no such edge");
        let (mesh, edges) = self.refined()?;
        let ends = [edge[0].min(edge[1]), edge[0].max(edge[1])].map(|i| i.wrapping_sub(1));
        let at = *edges.get(&ends).ok_or_else(missing)?;
        let (around, grow) = (mesh.around(at), &mesh.den / &self.den);
        let rest = [0, 1, 2].map(|i| {
            let ends: BigInt = ends.iter().map(|&end| &self.points[end][i]).sum();
            (&mesh.points[at][i] - ends * &grow) * 6 + &around[i]
        });
        Ok(BigRational::new(norm(&rest), pow(mesh.den * 12, 2)))
    }
}

/// `|x|^2`.
fn norm(x: &Vector) -> BigInt {
    x.iter().map(|x| x * x).sum()
}
