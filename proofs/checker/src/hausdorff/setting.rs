//! What the rules are about: the mesh of the claim, scaled, checked and refined; the surface's faces; F.

use std::collections::{BTreeMap, BTreeSet};

use num_rational::BigRational;
use num_traits::{One, Zero};

use super::claim::{Boundary, Cut, Hausdorff};
use super::distance::Bound;
use super::eigen;
use super::facets::{Facet, facets};
use super::part::Part;
use super::polygon_mesh::{Mesh, Vector};
use super::refine::Rules;
use crate::claim::SchemeName;
use crate::cosine::{enclose_beta, rational_beta};
use crate::file::{Cosine, Number};
use crate::fixed::Fixed;
use crate::rational::ratio;
use crate::reject::{Outcome, Rejection, Rule, ensure};
use crate::scheme::Mesh as Kind;

/// The most vertices of a mesh, at the last level too.
const VERTICES: usize = 200_000;
/// The most corners of a face, and the most faces at a vertex.
const CORNERS: usize = 9;
const VALENCE: usize = 400;

/// A claim, made ready.
pub struct Setting {
    pub rules: Rules,
    /// The mesh of the last level.
    pub mesh: Mesh,
    /// True if boundary vertices have no limits.
    pub interior_only: bool,
    /// True for the faces that have a surface over them.
    pub is_inner: Vec<bool>,
    /// The vertices of F if it is a mesh of the surface's own.
    pub own: Option<Vec<Vector>>,
    pub cut: Cut,
    pub facets: Vec<Facet>,
    pub lo: Fixed,
    pub hi: Bound,
    pub vertex: Option<Bound>,
}

impl Setting {
    /// # Errors
    ///
    /// If and only if the mesh is not one: rule `mesh`; or the cosines are not what it needs: rule `cosine`.
    pub fn new(claim: &Hausdorff, cosine: Option<&Cosine>) -> Outcome<Self> {
        let count = claim.vertices.len();
        check_faces(count, &claim.faces, claim.scheme == SchemeName::Loop)?;
        let origin = &claim.vertices[0];
        let scale = scale(claim, origin);
        let scaled = |Number(x): &Number| Fixed::of(&(x * &scale));
        let at = |vertex: &[Number; 3]| -> Vector {
            std::array::from_fn(|i| Fixed::of(&((&vertex[i].0 - &origin[i].0) * &scale)))
        };
        let place = |list: &[[Number; 3]]| -> Vec<Vector> { list.iter().map(at).collect() };
        let faces = from_zero(&claim.faces);
        check_edges(&faces)?;
        let all: Vec<usize> = (0..count).collect();
        let no_fan = |vertex: usize| {
            Rejection::new(Rule::Mesh, format!("the faces at {} form no fan", vertex + 1))
        };
        let mut mesh = Mesh::new(place(&claim.vertices), faces, &all).map_err(no_fan)?;
        let valences = valences(&mesh)?;
        let rules = rules(claim, &valences, cosine)?;
        if let Some(eigen) = &claim.eigen {
            eigen::check(claim, eigen, cosine)?;
        }
        for _ in 0..claim.level {
            let finer = rules.step(&mesh);
            let count = finer.points.len();
            ensure!(count <= VERTICES, Rule::Mesh, "more than {VERTICES} vertices");
            let all: Vec<usize> = (0..count).collect();
            mesh = Mesh::new(finer.points, finer.faces, &all).map_err(no_fan)?;
        }
        let interior_only = claim.boundary == Boundary::None;
        let is_inner: Vec<bool> = mesh
            .faces
            .iter()
            .map(|face| !interior_only || face.iter().all(|&i| mesh.is_interior(i)))
            .collect();
        ensure!(is_inner.contains(&true), Rule::Mesh, "there is no face with a surface over it");
        let own = claim.against.own().map(|kind| match kind {
            Kind::Control => mesh.points.clone(),
            Kind::Limit => (0..mesh.points.len())
                .map(|vertex| rules.limit(&mesh, vertex).unwrap_or(mesh.points[vertex]))
                .collect(),
        });
        let facets = match (&own, &claim.other) {
            (None, Some(other)) => {
                check_faces(other.vertices.len(), &other.faces, false)?;
                facets(&place(&other.vertices), &from_zero(&other.faces), claim.facets)
            }
            (own, _) => facets(own.as_ref().unwrap_or(&mesh.points), &mesh.faces, claim.facets),
        };
        let bound = |x: &Number| Bound::new(scaled(x));
        let (lo, hi) = (scaled(&claim.lo), bound(&claim.hi));
        let vertex = claim.vertex.as_ref().map(bound);
        let cut = claim.facets;
        Ok(Self { rules, mesh, interior_only, is_inner, own, cut, facets, lo, hi, vertex })
    }

    /// The part that a face of the surface is.
    pub fn part(&self, face: usize) -> Option<Part> {
        self.is_inner.get(face)?.then(|| Part::of_face(&self.mesh, face))?
    }

    /// True for a facet that counts for the distance from the mesh: without boundary rule those with a surface over
    /// them.
    pub fn counts(&self, facet: &Facet) -> bool {
        self.own.is_none() || self.is_inner[facet.face]
    }
}

/// A power of two that brings all coordinates, taken from the origin's, below 1.
fn scale(claim: &Hausdorff, origin: &[Number; 3]) -> BigRational {
    let other = claim.other.iter().flat_map(|other| &other.vertices);
    let vertices = claim.vertices.iter().chain(other);
    let coordinates =
        vertices.flat_map(|vertex| vertex.iter().zip(origin).map(|(x, o)| &x.0 - &o.0));
    // |p/q| < 2^(bits of p - bits of q + 1).
    let above = |x: &BigRational| x.numer().bits() as i64 - x.denom().bits() as i64 + 1;
    let least = coordinates.filter(|x| !x.is_zero()).map(|x| above(&x)).max();
    let least = least.unwrap_or(0);
    let power = num_traits::pow(ratio(2, 1), least.unsigned_abs() as usize);
    if least > 0 { BigRational::one() / power } else { power }
}

fn from_zero(faces: &[Vec<usize>]) -> Vec<Vec<usize>> {
    faces.iter().map(|face| face.iter().map(|vertex| vertex - 1).collect()).collect()
}

/// Checks the sizes, and that faces have different vertices that there are.
fn check_faces(count: usize, faces: &[Vec<usize>], triangles: bool) -> Outcome<()> {
    let rule = Rule::Mesh;
    ensure!(count <= VERTICES, rule, "more than {VERTICES} vertices");
    ensure!(!faces.is_empty(), rule, "there is no face");
    let sizes = if triangles { 3..=3 } else { 3..=CORNERS };
    for (i, face) in faces.iter().enumerate() {
        let size = face.len();
        ensure!(sizes.contains(&size), rule, "face {i} has {size} corners, not within {sizes:?}");
        let known = face.iter().all(|vertex| (1..=count).contains(vertex));
        ensure!(known, rule, "face {i} has a vertex that there is not");
        let different = face.iter().collect::<BTreeSet<_>>().len() == size;
        ensure!(different, rule, "face {i} has a vertex twice");
    }
    Ok(())
}

/// Checks that no directed edge is there twice.
fn check_edges(faces: &[Vec<usize>]) -> Outcome<()> {
    let next = |face: &[usize], i: usize| face[(i + 1) % face.len()];
    let edges = |face: &Vec<usize>| -> Vec<[usize; 2]> {
        (0..face.len()).map(|i| [face[i], next(face, i)]).collect()
    };
    let mut all: Vec<[usize; 2]> = faces.iter().flat_map(edges).collect();
    all.sort_unstable();
    let most = all.chunk_by(|a, b| a[0] == b[0]).map(<[_]>::len).max().unwrap_or(0);
    ensure!(most <= VALENCE, Rule::Mesh, "a vertex has more than {VALENCE} faces");
    let twice = all.windows(2).find(|pair| pair[0] == pair[1]);
    let [a, b] = twice.map_or([0, 0], |pair| pair[0].map(|vertex| vertex + 1));
    ensure!(twice.is_none(), Rule::Mesh, "the edge {a}, {b} is twice in one direction");
    Ok(())
}

/// The interior valences.
fn valences(mesh: &Mesh) -> Outcome<BTreeSet<usize>> {
    let rule = Rule::Mesh;
    let mut valences = BTreeSet::new();
    for vertex in 0..mesh.points.len() {
        let Some(star) = mesh.star(vertex) else { continue };
        let (number, n) = (vertex + 1, star.valence());
        ensure!(n <= VALENCE && (n >= 3 || !star.closed), rule, "vertex {number}: valence {n}");
        if star.closed {
            valences.insert(n);
        }
    }
    Ok(valences)
}

/// The scheme's rules, with the enclosures of beta from the cosines, which are just those that are needed.
fn rules(claim: &Hausdorff, valences: &BTreeSet<usize>, cosine: Option<&Cosine>) -> Outcome<Rules> {
    let rule = Rule::Cosine;
    let list = match cosine {
        None => &[][..],
        Some(Cosine::List(list)) if !list.is_empty() => list,
        Some(_) => {
            return Err(Rejection::new(rule, "\"cosine\" is a list, or null if it has none"));
        }
    };
    let irrational =
        |n: &&usize| claim.weights.is_some_and(|weights| rational_beta(weights, **n).is_none());
    let mut needed: BTreeSet<usize> = valences.iter().filter(irrational).copied().collect();
    needed.extend(claim.eigen.iter().map(|eigen| 4 * eigen.valence));
    let given = list.iter().map(|(n, ..)| *n);
    ensure!(given.eq(needed.iter().copied()), rule, "cosines are needed for N = {needed:?}");
    let Some(weights) = claim.weights else {
        return Ok(Rules { betas: None, boundary: claim.boundary });
    };
    let mut betas = BTreeMap::new();
    // New vertices have valence 6.
    for &n in valences.iter().chain([&6]) {
        let beta = match (rational_beta(weights, n), list.iter().find(|(other, ..)| *other == n)) {
            (Some(beta), _) => Fixed::of(&beta),
            (None, Some((_, Number(lo), Number(hi)))) => {
                let [low, high] = enclose_beta(n, Some((lo, hi)))?.ends();
                Fixed::between(&low, &high)
            }
            (None, None) => return Err(Rejection::new(rule, format!("none for N = {n}"))),
        };
        betas.insert(n, beta);
    }
    Ok(Rules { betas: Some(betas), boundary: claim.boundary })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_twice_in_a_direction() {
        assert!(check_edges(&[vec![0, 1, 2], vec![2, 1, 3]]).is_ok());
        assert!(check_edges(&[vec![0, 1, 2], vec![1, 2, 3]]).is_err());
        assert!(check_faces(3, &[vec![1, 2, 2]], true).is_err());
    }
}
