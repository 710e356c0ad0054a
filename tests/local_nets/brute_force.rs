//! Subdivision of small polygon meshes the slow way: a list of faces, no local nets, no numbering.
//! Scalar nets only.
//! Points that a mesh doesn't determine (its rim) are `None`. Masks are written out afresh.

use std::collections::BTreeMap;

use subcert::scalar::Field;

/// A polygon mesh: faces as vertex indices, points where they are known.
#[derive(Clone, Debug)]
pub struct Mesh<V> {
    pub faces: Vec<Vec<usize>>,
    pub points: Vec<Option<V>>,
}

/// An edge as a sorted pair.
pub fn edge(a: usize, b: usize) -> (usize, usize) {
    (a.min(b), a.max(b))
}

/// A refined mesh and where its vertices come from.
pub struct Step<V> {
    pub mesh: Mesh<V>,
    /// Old vertex -> vertex point (Loop, Catmull-Clark).
    pub vertex: Vec<usize>,
    /// Old edge -> edge point (Loop, Catmull-Clark).
    pub edge: BTreeMap<(usize, usize), usize>,
    /// Old face -> face point (Catmull-Clark).
    pub face: Vec<usize>,
    /// (Old face, old vertex) -> corner (Doo-Sabin).
    pub corner: BTreeMap<(usize, usize), usize>,
}

impl<V: Clone> Mesh<V> {
    pub fn new(faces: Vec<Vec<usize>>, points: &[V]) -> Self {
        let points = points.iter().cloned().map(Some).collect();
        Mesh { faces, points }
    }

    /// Edge -> the faces at it.
    pub fn edges(&self) -> BTreeMap<(usize, usize), Vec<usize>> {
        let mut edges: BTreeMap<_, Vec<usize>> = BTreeMap::new();
        for (f, face) in self.faces.iter().enumerate() {
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                edges.entry(edge(a, b)).or_default().push(f);
            }
        }
        assert!(
            edges.values().all(|faces| faces.len() <= 2),
            "not a manifold"
        );
        edges
    }

    /// For each vertex: its neighbours, or `None` unless all its edges have two faces.
    pub fn stars(&self) -> Vec<Option<Vec<usize>>> {
        let mut stars = vec![Some(Vec::new()); self.points.len()];
        for (&(a, b), faces) in &self.edges() {
            for (v, w) in [(a, b), (b, a)] {
                match &mut stars[v] {
                    Some(star) if faces.len() == 2 => star.push(w),
                    slot => *slot = None,
                }
            }
        }
        stars
    }

    /// The faces at a vertex.
    pub fn faces_at(&self, vertex: usize) -> Vec<usize> {
        let at = |f: &usize| self.faces[*f].contains(&vertex);
        (0..self.faces.len()).filter(at).collect()
    }
}

/// `Σ weight · point`, or `None` if a point is missing.
fn combine<S: Field>(
    points: &[Option<S>],
    terms: impl IntoIterator<Item = (usize, S)>,
) -> Option<S> {
    let mut sum = S::zero();
    for (index, weight) in terms {
        sum += points[index].clone()? * &weight;
    }
    Some(sum)
}

/// One step of Loop; `ring_weight(n)` is b(n).
pub fn loop_step<S: Field>(mesh: &Mesh<S>, ring_weight: &dyn Fn(usize) -> S) -> Step<S> {
    let mut points = Vec::new();
    for (v, star) in mesh.stars().into_iter().enumerate() {
        points.push(star.and_then(|star| {
            let b = ring_weight(star.len());
            let own = S::one() - &(b.clone() * &S::from_integer(star.len() as i64));
            let ring = star.into_iter().map(|w| (w, b.clone()));
            combine(&mesh.points, ring.chain([(v, own)]))
        }));
    }
    let vertex: Vec<usize> = (0..points.len()).collect();
    let mut edges = BTreeMap::new();
    for ((a, b), faces) in mesh.edges() {
        let mut terms = vec![(a, S::ratio(3, 8)), (b, S::ratio(3, 8))];
        for &f in &faces {
            let other = mesh.faces[f].iter().find(|&&c| c != a && c != b);
            terms.push((*other.unwrap(), S::ratio(1, 8)));
        }
        edges.insert((a, b), points.len());
        let complete = faces.len() == 2;
        points.push(if complete {
            combine(&mesh.points, terms)
        } else {
            None
        });
    }
    let mut faces = Vec::new();
    for face in &mesh.faces {
        let [a, b, c] = face[..] else {
            panic!("not a triangle")
        };
        let [ab, bc, ca] = [edge(a, b), edge(b, c), edge(c, a)].map(|e| edges[&e]);
        faces.extend([
            vec![a, ab, ca],
            vec![b, bc, ab],
            vec![c, ca, bc],
            vec![ab, bc, ca],
        ]);
    }
    Step {
        mesh: Mesh { faces, points },
        vertex,
        edge: edges,
        face: vec![],
        corner: BTreeMap::new(),
    }
}

/// One step of Catmull-Clark.
pub fn catmull_clark_step<S: Field>(mesh: &Mesh<S>) -> Step<S> {
    let centroid = |face: &Vec<usize>| {
        let weight = S::ratio(1, face.len() as i64);
        combine(&mesh.points, face.iter().map(|&v| (v, weight.clone())))
    };
    let centroids: Vec<Option<S>> = mesh.faces.iter().map(centroid).collect();
    let mut points = Vec::new();
    for (v, star) in mesh.stars().into_iter().enumerate() {
        points.push(star.and_then(|star| {
            let n = star.len() as i64;
            let square = S::ratio(1, n * n);
            let ring = star.into_iter().map(|w| (w, square.clone()));
            let old = combine(&mesh.points, ring.chain([(v, S::ratio(n - 2, n))]))?;
            let at = mesh.faces_at(v).into_iter().map(|f| (f, square.clone()));
            Some(old + &combine(&centroids, at)?)
        }));
    }
    let vertex: Vec<usize> = (0..points.len()).collect();
    let mut edges = BTreeMap::new();
    for ((a, b), faces) in mesh.edges() {
        edges.insert((a, b), points.len());
        let quarter = S::ratio(1, 4);
        points.push((faces.len() == 2).then_some(()).and_then(|()| {
            let ends = combine(&mesh.points, [(a, quarter.clone()), (b, quarter.clone())])?;
            let sides = faces.iter().map(|&f| (f, quarter.clone()));
            Some(ends + &combine(&centroids, sides)?)
        }));
    }
    let face: Vec<usize> = (0..mesh.faces.len()).map(|f| points.len() + f).collect();
    points.extend(centroids);
    let mut faces = Vec::new();
    for (f, corners) in mesh.faces.iter().enumerate() {
        for (i, &v) in corners.iter().enumerate() {
            let next = corners[(i + 1) % corners.len()];
            let before = corners[(i + corners.len() - 1) % corners.len()];
            faces.push(vec![
                v,
                edges[&edge(v, next)],
                face[f],
                edges[&edge(before, v)],
            ]);
        }
    }
    Step {
        mesh: Mesh { faces, points },
        vertex,
        edge: edges,
        face,
        corner: BTreeMap::new(),
    }
}

/// One step of Doo-Sabin. The first faces of the result are the old ones; `origin` says of each
/// face which old faces meet in it (one, two or all around a vertex).
pub fn doo_sabin_step<S: Field>(mesh: &Mesh<S>) -> (Step<S>, Vec<Vec<usize>>) {
    let mut points = Vec::new();
    let mut corner = BTreeMap::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        let n = face.len();
        for (i, &v) in face.iter().enumerate() {
            let weight = |k: usize| {
                let own = if k == i { 1 } else { 0 };
                let turn = S::two_cos(k.abs_diff(i) as u32, n as u32).unwrap();
                S::ratio(own, 4) + &((S::from_integer(3) + &turn) * &S::ratio(1, 4 * n as i64))
            };
            corner.insert((f, v), points.len());
            let terms = face.iter().enumerate().map(|(k, &w)| (w, weight(k)));
            points.push(combine(&mesh.points, terms));
        }
    }
    let mut faces = Vec::new();
    let mut origin = Vec::new();
    for (f, face) in mesh.faces.iter().enumerate() {
        faces.push(face.iter().map(|&v| corner[&(f, v)]).collect());
        origin.push(vec![f]);
    }
    for ((a, b), sides) in mesh.edges() {
        if let [f, g] = sides[..] {
            faces.push(vec![
                corner[&(f, a)],
                corner[&(f, b)],
                corner[&(g, b)],
                corner[&(g, a)],
            ]);
            origin.push(sides);
        }
    }
    for (v, star) in mesh.stars().into_iter().enumerate() {
        let Some(star) = star else { continue };
        // Walk round the vertex from face to face across shared edges.
        let around = mesh.faces_at(v);
        if around.len() != star.len() || around.is_empty() {
            continue;
        }
        let mut walk = vec![around[0]];
        while walk.len() < around.len() {
            let last = &mesh.faces[*walk.last().unwrap()];
            let next = around.iter().find(|f| {
                !walk.contains(f)
                    && mesh.faces[**f]
                        .iter()
                        .any(|w| star.contains(w) && last.contains(w) && *w != v)
            });
            walk.push(*next.expect("one fan"));
        }
        faces.push(walk.iter().map(|&f| corner[&(f, v)]).collect());
        origin.push(walk);
    }
    let mesh = Mesh { faces, points };
    (
        Step {
            mesh,
            vertex: vec![],
            edge: BTreeMap::new(),
            face: vec![],
            corner,
        },
        origin,
    )
}

/// Parameters of vertices under refinement: an edge point or face point has parameters if all its
/// ancestors have, and then their mean. `known` are those of the old vertices.
pub fn refine_parameters<S: Field, V>(
    old_faces: &[Vec<usize>],
    known: &[Option<[S; 2]>],
    step: &Step<V>,
) -> Vec<Option<[S; 2]>> {
    let mut parameters = vec![None; step.mesh.points.len()];
    for (v, &child) in step.vertex.iter().enumerate() {
        parameters[child] = known[v].clone();
    }
    for (&(a, b), &child) in &step.edge {
        parameters[child] = mean(&[&known[a], &known[b]]);
    }
    for (f, &child) in step.face.iter().enumerate() {
        let corners: Vec<_> = old_faces[f].iter().map(|&v| &known[v]).collect();
        parameters[child] = mean(&corners);
    }
    parameters
}

/// The mean of parameters, if all are known.
pub fn mean<S: Field>(parameters: &[&Option<[S; 2]>]) -> Option<[S; 2]> {
    let weight = S::ratio(1, parameters.len() as i64);
    let mut sum = [S::zero(), S::zero()];
    for &parameter in parameters {
        let [v, w] = parameter.clone()?;
        sum[0] += v;
        sum[1] += w;
    }
    Some(sum.map(|x| x * &weight))
}
