//! Meshes of polygons, whole ones and the small ones round a face: faces, and the stars of vertices.

use crate::fixed::Fixed;

/// A point or a direction.
pub type Vector = [Fixed; 3];

/// A mesh of which some vertices are *complete*: all faces at them are there, so that masks can be put on them.
pub struct Mesh {
    pub points: Vec<Vector>,
    /// The corners of each face, in order.
    pub faces: Vec<Vec<usize>>,
    /// Of the complete vertices.
    stars: Vec<Option<Star>>,
}

/// The faces round a vertex, one after the other across the edges at it.
#[derive(Clone, Debug)]
pub struct Star {
    /// The faces with the place of the vertex among their corners: the next face has that neighbour after the vertex
    /// which the former has before it.
    pub faces: Vec<[usize; 2]>,
    /// False for a boundary vertex.
    pub closed: bool,
    /// The neighbours: one for each face, the corner after the vertex; and one more if the star is open.
    pub spokes: Vec<usize>,
}

impl Mesh {
    /// The mesh in which the vertices of a list are complete, and the others are not.
    ///
    /// # Errors
    ///
    /// If and only if the faces at one of them form no fan: that vertex.
    pub fn new(
        points: Vec<Vector>,
        faces: Vec<Vec<usize>>,
        complete: &[usize],
    ) -> Result<Self, usize> {
        let mut at: Vec<Option<Vec<[usize; 2]>>> = vec![None; points.len()];
        for &vertex in complete {
            at[vertex] = Some(Vec::new());
        }
        for (face, corners) in faces.iter().enumerate() {
            for (place, &vertex) in corners.iter().enumerate() {
                if let Some(list) = &mut at[vertex] {
                    list.push([face, place]);
                }
            }
        }
        let star = |(vertex, list): (usize, Option<Vec<_>>)| {
            list.map(|list| Star::of(&faces, &list).ok_or(vertex)).transpose()
        };
        let stars = at.into_iter().enumerate().map(star).collect::<Result<_, _>>()?;
        Ok(Self { points, faces, stars })
    }

    /// The star of a complete vertex.
    pub fn star(&self, vertex: usize) -> Option<&Star> {
        self.stars.get(vertex)?.as_ref()
    }

    /// True for a complete vertex that is not on the boundary.
    pub fn is_interior(&self, vertex: usize) -> bool {
        self.star(vertex).is_some_and(|star| star.closed)
    }
}

impl Star {
    /// The fan that all of the faces (with the vertex's places) form, if they do.
    fn of(faces: &[Vec<usize>], at: &[[usize; 2]]) -> Option<Self> {
        let neighbour = |[face, place]: [usize; 2], step: usize| {
            let corners = &faces[face];
            corners[(place + step) % corners.len()]
        };
        let after = |entry: [usize; 2]| neighbour(entry, 1);
        let before = |entry: [usize; 2]| neighbour(entry, faces[entry[0]].len() - 1);
        // An open fan starts at the face with nothing before its first edge.
        let starts = |entry: &&[usize; 2]| at.iter().all(|other| before(*other) != after(**entry));
        let first = *at.iter().find(starts).or(at.first())?;
        let (mut fan, mut spokes, mut closed) = (vec![first], vec![after(first)], false);
        let mut last = first;
        loop {
            let spoke = before(last);
            if spoke == after(first) {
                closed = true;
                break;
            }
            spokes.push(spoke);
            let Some(&next) = at.iter().find(|entry| after(**entry) == spoke) else { break };
            if fan.len() == at.len() {
                return None;
            }
            fan.push(next);
            last = next;
        }
        (fan.len() == at.len()).then_some(Self { faces: fan, closed, spokes })
    }

    /// The number of neighbours.
    pub fn valence(&self) -> usize {
        self.spokes.len()
    }

    /// The index of a face in the star.
    pub fn position(&self, face: usize) -> Option<usize> {
        self.faces.iter().position(|[other, _]| *other == face)
    }
}
