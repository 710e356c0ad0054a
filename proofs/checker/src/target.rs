//! Targets: the difference of the surface and a mesh, as forms times q.


use crate::form::Form;
use crate::net::{Net, Path};
use crate::patch::Point;
use crate::rational::ratio;
use crate::reject::{Outcome, Rejection, Rule};
use crate::scheme::Mesh;
use crate::space::Space;
use crate::word::is_regular;

/// `S - F_k`.
#[derive(Clone, Copy, Debug)]
pub struct Target {
    /// The vertices of F_k.
    pub mesh: Mesh,
    /// k.
    pub level: usize,
}

impl Target {
    /// `S - F_0`, F_0 the control mesh: what lemmas are about.
    pub const FIRST: Self = Self { mesh: Mesh::Control, level: 0 };

    /// q times F_0 at the corners of the word of a net (and the letters of the root, rest).
    fn corners(self, space: &Space, net: &Net, rest: &[u8]) -> Outcome<Vec<Form>> {
        let missing = || Rejection::new(Rule::Format, "the scheme has no such mesh");
        let masks = space.scheme.mesh(self.mesh, net.valence, rest).ok_or_else(missing)?;
        Ok(masks.iter().map(|mask| net.apply(space, mask)).collect())
    }

    /// q times F_k at points of a word of at least k letters and the root's, from the nets along it.
    ///
    /// # Errors
    ///
    /// If and only if there is no such mesh: rule `format`.
    pub fn mesh_at(
        self,
        space: &Space,
        nets: &[Net],
        word: &[u8],
        points: &[Point],
    ) -> Outcome<Vec<Form>> {
        let (k, whole) = (self.level, self.level + space.scheme.root());
        let corners = self.corners(space, &nets[k], &word[k..whole])?;
        let part = space.patch().part(&word[whole..]);
        let at = |point| {
            let weights = space.patch().blend(&part.point(point));
            Form::mix(space.size, &weights.into_iter().zip(&corners).collect::<Vec<_>>())
        };
        Ok(points.iter().map(at).collect())
    }

    /// q times the Bernstein coefficients over a regular word of at least k letters and the root's.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up, or there is no such mesh: rule `format`.
    pub fn coefficients(self, space: &Space, path: &mut Path, word: &[u8]) -> Outcome<Vec<Form>> {
        let nets = path.along(word)?;
        let net = &nets[word.len()];
        let nodes = space.patch().nodes();
        space.charge(20 * nodes.len() as u64 * net.cost())?;
        let mesh = self.mesh_at(space, nets, word, &nodes)?;
        let rest = |(mask, mesh)| subtract(space, &net.apply(space, mask), mesh);
        Ok(space.scheme.surface().iter().zip(&mesh).map(rest).collect())
    }

    /// q times the target at a point of a word: any point of a regular one, the corner 0 of another.
    ///
    /// # Errors
    ///
    /// If and only if the work allowed is used up, or there is no such mesh: rule `format`.
    pub fn at_point(
        self,
        space: &Space,
        path: &mut Path,
        word: &[u8],
        point: &Point,
    ) -> Outcome<Form> {
        if is_regular(word) {
            let coefficients = self.coefficients(space, path, word)?;
            let values = space.patch().value(point).into_iter();
            return Ok(Form::mix(space.size, &values.zip(&coefficients).collect::<Vec<_>>()));
        }
        let nets = path.along(word)?;
        let net = &nets[word.len()];
        let surface = net.apply(space, &space.scheme.limit(net.valence));
        let mesh = self.mesh_at(space, nets, word, std::slice::from_ref(point))?;
        Ok(mesh.iter().fold(surface, |surface, mesh| subtract(space, &surface, mesh)))
    }
}

/// `a - b`.
pub fn subtract(space: &Space, a: &Form, b: &Form) -> Form {
    Form::mix(space.size, &[(ratio(1, 1), a), (ratio(-1, 1), b)])
}
