//! How many steps of subdivision bring surface and mesh within a tolerance: a depth by every method, and what
//! that depth is worth.
//!
//! | file | idea |
//! |---|---|
//! | [`method`] | the methods: names, what each is about |
//! | [`printed`] | the formulas of the papers, on a mesh, with this program's verdict on them |
//! | [`tabulated`] | Peters & Wu's estimators |
//! | [`differences`] | our bounds from second differences and certified constants |
//! | [`study`] | how tight they are: the least depth by certified measurement beside them |
//! | [`heuristic`] | vertices and their limits, followed through the levels; bounds nothing |
//!
//! An [`Answer`] is *safe* if after its depth the distance is certainly at most the tolerance, in the metric
//! asked: a theorem about the `f64` coordinates. [`best`] is the least depth among the safe ones.
//!
//! **Metrics.** A bound of the distance at the same parameter, `sup |S(u) - F(u)|`, bounds both one-sided
//! Hausdorff distances, and so serves every [`Metric`]. Peters & Wu bound the distance from points of the
//! surface to the mesh, and nothing else.

pub mod differences;
pub mod heuristic;
pub mod method;
pub mod printed;
pub mod study;
pub mod tabulated;

use std::cell::{OnceCell, RefCell};
use std::fmt;

use crate::bound::Against;
use crate::mesh::Mesh;
use crate::mesh::frame::printed_above;
use crate::predict::differences::LocalSteps;
use crate::refine::RefineError;
use crate::scheme::{CornerRule, Scheme};

pub use method::Method;
use printed::norms::Norms;

/// A distance between surface and mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Metric {
    /// `sup |S(u) - F(u)|` over common parameters.
    Parametric,
    /// The largest distance of a point of the surface to the mesh.
    SurfaceToMesh,
    /// The larger of both one-sided Hausdorff distances.
    Hausdorff,
}

impl Metric {
    /// The name used on the command line and in every file.
    pub fn name(self) -> &'static str {
        match self {
            Metric::Parametric => "parametric",
            Metric::SurfaceToMesh => "surface-to-mesh",
            Metric::Hausdorff => "hausdorff",
        }
    }
}

impl fmt::Display for Metric {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

/// What is asked.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Request {
    /// The scheme that defines the surface.
    pub scheme: Scheme,
    /// What one-face boundary vertices do.
    pub corner: CornerRule,
    /// Control or limit meshes.
    pub against: Against,
    /// The distance.
    pub metric: Metric,
    /// What the distance may be at most, in the mesh's own unit: positive and finite.
    pub tolerance: f64,
}

impl Request {
    /// "control" or "limit".
    pub fn against_name(&self) -> &'static str {
        match self.against {
            Against::Control => "control",
            Against::Limit => "limit",
        }
    }
}

/// What a method says.
#[derive(Clone, Debug, PartialEq)]
pub struct Answer {
    /// The method.
    pub method: Method,
    /// The number of steps; `None` if the method does not apply or proves no depth.
    pub depth: Option<u32>,
    /// Whether the distance after `depth` steps is proved to be at most the tolerance, in the metric asked.
    pub safe: bool,
    /// What the method says of the distance after `depth` steps, rounded upwards, as is its shortest decimal.
    pub bound_at_depth: Option<f64>,
    /// On what it rests; why it is not safe; why there is no depth.
    pub why: String,
}

/// What a method finds before the metric is looked at.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Found {
    depth: u32,
    bound: f64,
    safe: bool,
    why: String,
}

/// Why a method gives no depth, in one sentence.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NoDepth(String);

impl From<RefineError> for NoDepth {
    fn from(error: RefineError) -> Self {
        NoDepth(error.to_string())
    }
}

/// A mesh, what is asked of it, and what several methods need.
pub(crate) struct Context<'a> {
    mesh: &'a Mesh,
    request: &'a Request,
    norms: OnceCell<Result<Norms, NoDepth>>,
    /// Bounds by certified constants, as far as they were asked for.
    steps: RefCell<LocalSteps<'a>>,
}

impl Context<'_> {
    /// The norms of the faces, computed when first asked for.
    fn norms(&self) -> Result<&Norms, NoDepth> {
        let found = self
            .norms
            .get_or_init(|| Norms::of(self.mesh, self.request.scheme));
        found.as_ref().map_err(NoDepth::clone)
    }
}

/// The depth by each of some methods, in their order.
///
/// ```
/// use subcert::bound::Against;
/// use subcert::depth::{Method, Metric, Request, predict};
/// use subcert::mesh::io::{Format, parse};
/// use subcert::scheme::{CornerRule, LoopWeights, Scheme};
///
/// // The rings of an octahedron have the mean 0, so the vertex moves by 8 n b / (3 + 8 n b) = 31/55 (n b = 31/64
/// // at n = 4), and at the next level by 9/64 of that: the heuristic asks for one step.
/// let text = b"v 1 0 0\nv -1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nv 0 0 -1\n\
///     f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n";
/// let mesh = parse(text, Format::Obj, "octahedron")?.mesh;
/// let request = Request {
///     scheme: Scheme::Loop(LoopWeights::Original),
///     corner: CornerRule::Smooth,
///     against: Against::Control,
///     metric: Metric::Parametric,
///     tolerance: 0.2,
/// };
/// let answers = predict(&mesh, &request, &[Method::Heuristic, Method::ChengYong])?;
/// assert_eq!((answers[0].depth, answers[0].safe), (Some(1), false));
/// assert_eq!(answers[1].depth, None); // Catmull-Clark only
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If and only if the scheme refuses the mesh or the corner rule, or a coordinate is not finite. What a method
/// alone can't do (coordinates near the largest `f64`) is said in its answer.
///
/// # Panics
/// Unless the tolerance is positive and finite.
pub fn predict(
    mesh: &Mesh,
    request: &Request,
    methods: &[Method],
) -> Result<Vec<Answer>, RefineError> {
    assert!(
        request.tolerance > 0.0 && request.tolerance.is_finite(),
        "a positive, finite tolerance"
    );
    if request.scheme == Scheme::DooSabin && request.corner == CornerRule::Sharp {
        return Err(RefineError::CornerRule);
    }
    let context = Context {
        mesh,
        request,
        norms: OnceCell::new(),
        steps: RefCell::new(differences::steps(mesh, request)?),
    };
    Ok(methods.iter().map(|&m| answer(&context, m)).collect())
}

fn answer(context: &Context<'_>, method: Method) -> Answer {
    let request = context.request;
    let found = match method.applies(request) {
        Err(why) => Err(NoDepth(why)),
        Ok(()) => match method {
            Method::Heuristic => heuristic::depth(context),
            Method::LanquetinNeveu => printed::lanquetin_neveu::depth(context),
            Method::ChengYong => printed::cheng_yong::depth(context),
            Method::Huang | Method::HuangWang => printed::huang_wang::depth(context),
            Method::Differences(steps) => differences::depth(context, steps),
            Method::Tabulated(estimator, steps) => tabulated::depth(context, estimator, steps),
        },
    };
    match found {
        Err(NoDepth(why)) => Answer {
            method,
            depth: None,
            safe: false,
            bound_at_depth: None,
            why,
        },
        Ok(found) => {
            let bounded = method.bounds(request.metric);
            Answer {
                method,
                depth: Some(found.depth),
                safe: found.safe && bounded,
                bound_at_depth: Some(printed_above(found.bound)),
                why: match bounded {
                    true => found.why,
                    false => format!(
                        "it bounds the distance of points of the surface to the mesh, not the {} distance",
                        request.metric
                    ),
                },
            }
        }
    }
}

/// The least depth among the safe ones; of equal depths that of the smallest bound, then the first.
pub fn best(answers: &[Answer]) -> Option<&Answer> {
    let key = |a: &Answer| (a.depth, a.bound_at_depth.unwrap_or(f64::INFINITY));
    let proved = answers.iter().filter(|a| a.safe && a.depth.is_some());
    proved.min_by(|a, b| {
        let ((d, x), (e, y)) = (key(a), key(b));
        d.cmp(&e).then(x.total_cmp(&y))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(method: Method, depth: Option<u32>, safe: bool, bound: f64) -> Answer {
        Answer {
            method,
            depth,
            safe,
            bound_at_depth: depth.map(|_| bound),
            why: String::new(),
        }
    }

    #[test]
    fn the_best_is_the_least_safe_depth() {
        let answers = [
            answer(Method::Heuristic, Some(1), false, 0.0),
            answer(Method::ChengYong, None, false, 0.0),
            answer(Method::Differences(0), Some(4), true, 0.3),
            answer(Method::Differences(1), Some(3), true, 0.2),
            answer(Method::Differences(2), Some(3), true, 0.1),
        ];
        assert_eq!(best(&answers).unwrap().method, Method::Differences(2));
        assert_eq!(best(&answers[..2]), None);
        assert_eq!(best(&[]), None);
    }
}
