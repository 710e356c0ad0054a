//! Targets: the difference of the surface and a mesh, as forms times q.

use num_rational::BigRational;
use num_traits::One;

use crate::form::Form;
use crate::net::{Net, Path, REGULAR};
use crate::polynomial::Polynomial;
use crate::rational::ratio;
use crate::reject::Outcome;
use crate::space::Space;
use crate::word::{self, Triangle};

/// 24 times the matrix from twelve points to fifteen Bernstein coefficients (HW, Appendix 1).
const T: [[i64; 12]; 15] = [
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

/// The vertices of a mesh: control points or points of the surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mesh {
    /// Control points.
    Control,
    /// Points of the surface.
    Limit,
}

/// `S - F_k`.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The vertices of F_k.
    pub mesh: Mesh,
    /// k.
    pub level: usize,
}

/// The label of a corner of the face.
fn label(net: &Net, corner: usize) -> usize {
    [1, 2, net.valence + 1][corner]
}

/// q times S at a corner of the face of a net.
pub fn surface_corner(space: &Space, net: &Net, corner: usize) -> Form {
    if corner == 0 && !net.regular {
        let share = space.beta.value.scale(&ratio(8, space.n as i64));
        return net.star(1, &Polynomial::integer(3), &share);
    }
    let [centre, share] = [ratio(1, 2), ratio(1, 12)].map(|x| space.q.scale(&x));
    net.star(label(net, corner), &centre, &share)
}

/// q times S's Bernstein coefficient `index` over a net of valence 6, less `Σ weight corner` of a mesh.
fn coefficient(
    space: &Space,
    net: &Net,
    index: usize,
    mesh: &[Form; 3],
    [v, w]: &word::Point,
) -> Form {
    let factors: Vec<_> = T[index].iter().map(|&c| space.q.scale(&ratio(c, 24))).collect();
    let points = factors.iter().enumerate().map(|(j, factor)| (factor, net.point(REGULAR[j])));
    let weights = barycentric(v, w).map(|x| Polynomial::constant(&-x));
    let terms: Vec<_> = points.chain(weights.iter().zip(mesh)).collect();
    Form::sum(space.size, &terms)
}

fn barycentric(v: &BigRational, w: &BigRational) -> [BigRational; 3] {
    [BigRational::one() - v - w, v.clone(), w.clone()]
}

impl Target {
    /// q times F_k at the corners of the word of a net, the word being of length k.
    fn corners(&self, space: &Space, net: &Net) -> [Form; 3] {
        [0, 1, 2].map(|corner| match self.mesh {
            Mesh::Control => net.sum(&[(&space.q, label(net, corner))]),
            Mesh::Limit => surface_corner(space, net, corner),
        })
    }

    /// q times F_k at the point (v, w) of a word of at least k letters, from the nets along it.
    pub fn mesh_at(
        &self,
        space: &Space,
        nets: &[Net],
        word: &[u8],
        v: &BigRational,
        w: &BigRational,
    ) -> Form {
        let [v, w] = Triangle::of(&word[self.level..]).point(v, w);
        let corners = self.corners(space, &nets[self.level]);
        let terms: Vec<_> = barycentric(&v, &w).into_iter().zip(&corners).collect();
        Form::mix(space.size, &terms)
    }

    /// q times the fifteen Bernstein coefficients over a word of at least k letters whose net has valence 6.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up.
    pub fn coefficients(&self, space: &Space, path: &mut Path, word: &[u8]) -> Outcome<Vec<Form>> {
        let nets = path.along(word)?;
        let net = &nets[word.len()];
        space.charge(15 * 20 * net.point(1).cost())?;
        let mesh = self.corners(space, &nets[self.level]);
        let part = Triangle::of(&word[self.level..]);
        let quarter = |j: usize| ratio(j as i64, 4);
        let node = |[_, j, k]: [usize; 3]| part.point(&quarter(j), &quarter(k));
        let nodes = word::exponents(4).into_iter().map(node).enumerate();
        Ok(nodes.map(|(index, node)| coefficient(space, net, index, &mesh, &node)).collect())
    }

    /// q times the target at the point (v, w) of a word: any point of a regular one, the corner 0 of another.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up.
    pub fn at_point(
        &self,
        space: &Space,
        path: &mut Path,
        word: &[u8],
        v: &BigRational,
        w: &BigRational,
    ) -> Outcome<Form> {
        if word::is_regular(word) {
            let coefficients = self.coefficients(space, path, word)?;
            let values = word::bernstein(4, v, w).into_iter();
            return Ok(Form::mix(space.size, &values.zip(&coefficients).collect::<Vec<_>>()));
        }
        let nets = path.along(word)?;
        let surface = surface_corner(space, &nets[word.len()], 0);
        let mesh = self.mesh_at(space, nets, word, v, w);
        Ok(Form::mix(space.size, &[(ratio(1, 1), &surface), (ratio(-1, 1), &mesh)]))
    }
}
