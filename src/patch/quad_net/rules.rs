//! Catmull-Clark's rules on fans, and the patch of a quad with regular corners.

use num_traits::Zero;

use crate::bernstein::from_net;
use crate::bernstein::tensor::Bicubic;
use crate::mesh::Topology;
use crate::scalar::{Field, Module};
use crate::scheme::{CornerRule, StarMask, boundary, catmull_clark};

/// The neighbours of a vertex; an open fan runs from boundary to boundary and has one `across`
/// less than `edges`.
#[derive(Clone, Debug)]
pub struct Fan<V> {
    /// Edge neighbours.
    pub edges: Vec<V>,
    /// Diagonal vertices, or new face points.
    pub across: Vec<V>,
    /// Place of the next corner of the face among `edges`.
    pub at: usize,
    /// Whether the vertex is interior.
    pub closed: bool,
}

impl<V> Default for Fan<V> {
    fn default() -> Self {
        Fan {
            edges: Vec::new(),
            across: Vec::new(),
            at: 0,
            closed: true,
        }
    }
}

pub(super) struct FanView<'a, V> {
    pub(super) edges: &'a [V],
    pub(super) across: &'a [V],
    pub(super) at: usize,
    pub(super) closed: bool,
}

impl<V> Clone for FanView<'_, V> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<V> Copy for FanView<'_, V> {}

impl<V> Fan<V> {
    pub(super) fn view(&self) -> FanView<'_, V> {
        FanView {
            edges: &self.edges,
            across: &self.across,
            at: self.at,
            closed: self.closed,
        }
    }

    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.across.clear();
    }
}

/// Vertex mask, limit mask over diagonals, and limit mask over face points, of one valence.
type Masks<S> = (StarMask<S>, StarMask<S>, StarMask<S>);

/// Catmull-Clark's rules on one mesh: its masks, by valence.
#[derive(Clone, Debug)]
pub struct CatmullClarkRules<S> {
    corner_rule: CornerRule,
    masks: Vec<Option<Masks<S>>>,
}

impl<S: Field> CatmullClarkRules<S> {
    /// The masks of all interior valences and face sizes (a face point has the face's size as its
    /// valence), and of 4.
    pub fn new(corner_rule: CornerRule, topology: &Topology) -> Self {
        let mut masks: Vec<Option<Masks<S>>> = Vec::new();
        let mut want = |n: u32| {
            if masks.len() <= n as usize {
                masks.resize(n as usize + 1, None);
            }
            if masks[n as usize].is_none() {
                masks[n as usize] = Some((
                    catmull_clark::vertex_mask(n),
                    catmull_clark::limit_mask(n),
                    catmull_clark::limit_mask_polygons(n),
                ));
            }
        };
        want(4);
        for vertex in 0..topology.vertex_count() {
            if !topology.is_boundary_vertex(vertex) && topology.valence(vertex) >= 2 {
                want(topology.valence(vertex));
            }
        }
        if topology.arity() != Some(4) {
            for face in 0..topology.face_count() {
                want(topology.face_size(face));
            }
        }
        CatmullClarkRules { corner_rule, masks }
    }

    fn interior(&self, n: usize) -> &Masks<S> {
        self.masks[n]
            .as_ref()
            .expect("a mask for each interior valence of the mesh")
    }

    fn is_pinned<V>(&self, fan: FanView<'_, V>) -> bool {
        !fan.closed && fan.edges.len() == 2 && self.corner_rule == CornerRule::Sharp
    }

    pub(super) fn is_regular<V>(&self, fan: FanView<'_, V>) -> bool {
        match (fan.closed, fan.edges.len()) {
            (true, n) => n == 4,
            (false, 3) => true,
            _ => self.is_pinned(fan),
        }
    }

    /// The point of a boundary vertex under `rule` (refinement or limit), `None` if interior.
    fn on_boundary<V: Module<S>>(
        &self,
        p: &V,
        fan: FanView<'_, V>,
        rule: fn(&V, &V, &V) -> V,
    ) -> Option<V> {
        if fan.closed {
            None
        } else if self.is_pinned(fan) {
            Some(p.clone())
        } else {
            Some(rule(p, &fan.edges[0], &fan.edges[fan.edges.len() - 1]))
        }
    }

    /// `faces` are new face points.
    pub(super) fn new_vertex<V: Module<S>>(&self, p: &V, fan: FanView<'_, V>, faces: &[V]) -> V {
        self.on_boundary(p, fan, boundary::vertex_point::<S, V>)
            .unwrap_or_else(|| {
                self.interior(fan.edges.len())
                    .0
                    .apply(p, &sum(fan.edges), &sum(faces))
            })
    }

    pub(super) fn limit_quads<V: Module<S>>(&self, p: &V, fan: FanView<'_, V>) -> V {
        self.on_boundary(p, fan, boundary::limit_point::<S, V>)
            .unwrap_or_else(|| {
                self.interior(fan.edges.len())
                    .1
                    .apply(p, &sum(fan.edges), &sum(fan.across))
            })
    }

    pub(super) fn limit_polygons<V: Module<S>>(&self, p: &V, fan: FanView<'_, V>) -> V {
        self.on_boundary(p, fan, boundary::limit_point::<S, V>)
            .unwrap_or_else(|| {
                self.interior(fan.edges.len())
                    .2
                    .apply(p, &sum(fan.edges), &sum(fan.across))
            })
    }
}

#[inline]
pub(super) fn sum<V: Zero + for<'a> std::ops::Add<&'a V, Output = V>>(points: &[V]) -> V {
    points.iter().fold(V::zero(), |total, p| total + p)
}

/// New edge points of all edges at a corner; `faces` are new face points.
pub(super) fn edge_points<S: Field, V: Module<S>>(
    p: &V,
    fan: FanView<'_, V>,
    faces: &[V],
    out: &mut Vec<V>,
) {
    let n = fan.edges.len();
    out.clear();
    out.extend((0..n).map(|k| {
        if !fan.closed && (k == 0 || k == n - 1) {
            boundary::edge_point(p, &fan.edges[k])
        } else {
            let before = &faces[if k == 0 { n - 1 } else { k - 1 }];
            catmull_clark::edge_point(p, &fan.edges[k], before, &faces[k])
        }
    }));
}

/// The four edge neighbours from the next corner on and the four diagonals, with ghosts beyond a
/// boundary: `ghost(i, -1) = 2 (i, 0) - (i, 1)`, along both directions at a pinned corner.
fn full_fan<S: Field, V: Module<S>>(p: &V, fan: FanView<'_, V>) -> ([V; 4], [V; 4]) {
    let (e, d) = (fan.edges, fan.across);
    let mirror = |center: &V, inner: &V| center.clone() + center - inner;
    let (edges, across): ([V; 4], [V; 4]) = match e.len() {
        4 => (
            std::array::from_fn(|k| e[k].clone()),
            std::array::from_fn(|k| d[k].clone()),
        ),
        3 => (
            [e[0].clone(), e[1].clone(), e[2].clone(), mirror(p, &e[1])],
            [
                d[0].clone(),
                d[1].clone(),
                mirror(&e[2], &d[1]),
                mirror(&e[0], &d[0]),
            ],
        ),
        _ => {
            // One quad (p, e0, d0, e1): (1,0) = e0, (0,1) = e1, (1,1) = d0.
            let (west, south) = (mirror(p, &e[0]), mirror(p, &e[1]));
            let (north_west, south_east) = (mirror(&e[1], &d[0]), mirror(&e[0], &d[0]));
            let south_west = mirror(&west, &north_west);
            (
                [e[0].clone(), e[1].clone(), west, south],
                [d[0].clone(), north_west, south_west, south_east],
            )
        }
    };
    let at = fan.at;
    (
        std::array::from_fn(|k| edges[(at + k) % 4].clone()),
        std::array::from_fn(|k| across[(at + k) % 4].clone()),
    )
}

/// Places of each corner and of its edge neighbours 2, 3 and diagonal 2 in the 4 x 4 grid `4 j + i`.
pub(super) const PLACE: [[usize; 4]; 4] =
    [[5, 4, 1, 0], [6, 2, 7, 3], [10, 11, 14, 15], [9, 13, 8, 12]];

/// S over a quad whose four corners are regular; u towards corner 1, v towards corner 3.
pub(super) fn regular_patch<S: Field, V: Module<S>>(
    corner: [&V; 4],
    fan: [FanView<'_, V>; 4],
) -> Bicubic<V> {
    let mut grid: [V; 16] = std::array::from_fn(|_| V::zero());
    for i in 0..4 {
        let ([_, _, e2, e3], [_, _, d2, _]) = full_fan::<S, V>(corner[i], fan[i]);
        let [at, at_e2, at_e3, at_d2] = PLACE[i];
        grid[at] = corner[i].clone();
        grid[at_e2] = e2;
        grid[at_e3] = e3;
        grid[at_d2] = d2;
    }
    from_net::bicubic::<S, V>(&grid)
}
