//! Conditions that reach the sides of a fault: which node of a point gives way to its jump, and what cannot be held.

use super::place::Place;
use super::point::Point;
use crate::diagnostic::Diagnostic;
use crate::model::{self, Model};
use crate::scene::model::{Motion, Scene, Spanned};
use asperity_fem::dof::Channel;
use asperity_fem::jump::Jump;
use asperity_fem::mesh::nodes_of_sides;
use asperity_mechanics::coordinates;
use std::ops::Range;

/// Why bodies cannot be condensed onto faults.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Refusal {
    /// What is wrong.
    pub message: String,
    /// What would be right; none where the message says it.
    pub help: Option<String>,
    /// The two nodes of the point and the component of displacement whose conditions are at fault.
    pub at: Option<([usize; 2], usize)>,
    /// What it is about, where no condition is known to be at fault.
    pub about: About,
}

/// What a refusal is about.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum About {
    /// The sides of the faults.
    #[default]
    Sides,
    /// The memory that is allowed.
    Memory,
    /// A body.
    Body(String),
    /// A condition that draws a set by a spring.
    Spring,
}

impl About {
    fn place(&self, scene: &Scene) -> Range<usize> {
        let springs = || {
            let motions = scene.stages.iter().flat_map(|s| &s.conditions).map(|c| c.get_ref());
            let mut motions = motions.flat_map(|c| [&c.x, &c.y, &c.z].into_iter().flatten());
            motions.find(|m| matches!(m.get_ref(), Motion::Spring { .. })).map(|m| m.span())
        };
        let found = match self {
            Self::Sides => None,
            Self::Memory => scene.solver.memory.as_ref().map(Spanned::span),
            Self::Body(body) => scene.bodies.get(body).map(|b| b.material.span()),
            Self::Spring => springs(),
        };
        found.or_else(|| scene.faults.values().next().map(|f| f.minus.span())).unwrap_or(0..0)
    }
}

impl From<String> for Refusal {
    fn from(message: String) -> Self {
        Self { message, ..Self::default() }
    }
}

impl Refusal {
    /// As an error of a plan, at the condition that is at fault.
    pub(super) fn place<const D: usize>(self, scene: &Scene, model: &Model<D>) -> Diagnostic {
        let Self { message, help, at, about } = self;
        let conditions = scene.stages.iter().flat_map(|s| &s.conditions).map(|c| c.get_ref());
        let place = at.and_then(|(nodes, component)| {
            let axis = model.idealisation.axis(component);
            let mut found = conditions.filter_map(|c| {
                let motion = [&c.x, &c.y, &c.z][axis].as_ref();
                let motion = motion.filter(|m| !matches!(m.get_ref(), Motion::Free | Motion::Spring { .. }));
                let place = motion
                    .map(|m| m.span())
                    .or(c.symmetry.as_ref().map(|s| s.span()))
                    .or(c.rotate.as_ref().map(|r| r.span()))?;
                let set = c.set.as_ref()?;
                let of = nodes_of_sides(&model.mesh, model::sides(model, set).ok()?);
                nodes.iter().any(|n| of.binary_search(n).is_ok()).then(|| (set.get_ref().clone(), place))
            });
            found.next()
        });
        let (message, span) = match place {
            Some((set, span)) => (format!("`{set}`: {message}"), span),
            None => (message, about.place(scene)),
        };
        Diagnostic { message, help, span, also: Vec::new() }
    }
}

/// Components of a node that are prescribed; `fixed` is sorted.
fn held<const C: usize>(node: usize, fixed: &[usize]) -> [bool; C] {
    std::array::from_fn(|c| fixed.binary_search(&(C * node + c)).is_ok())
}

/// The jump of a point, of which that node gives way that has fewer conditions: what holds one side alone leaves the jump free. A node
/// that a spring draws, of which `drawn` tells, does not give way.
pub(super) fn jump<const D: usize, const C: usize>(
    point: &Point<D>,
    frame: [[f64; C]; C],
    fixed: &[usize],
    drawn: impl Fn(usize) -> bool,
) -> Jump<C> {
    let [minus, plus] = [point.place.minus, point.place.plus];
    let (on_minus, on_plus): ([bool; C], [bool; C]) = (held(minus, fixed), held(plus, fixed));
    let within = |a: &[bool; C], b: &[bool; C]| a.iter().zip(b).all(|(a, b)| !a || *b);
    let swap = drawn(plus) || (!drawn(minus) && !within(&on_plus, &on_minus) && within(&on_minus, &on_plus));
    if swap {
        // What plus does relative to minus is the opposite of what minus does relative to plus.
        return Jump { minus: C * plus, plus: C * minus, frame: frame.map(|axis| axis.map(|c| -c)) };
    }
    Jump { minus: C * minus, plus: C * plus, frame }
}

/// The refusal of a condition that the frame of a jump cannot express; `dof` is the degree of freedom that it is about.
pub(super) fn oblique<const D: usize, const C: usize>(
    model: &Model<D>,
    points: &[Point<D>],
    fixed: &[usize],
    dof: usize,
) -> Refusal {
    let (node, component) = (dof / C, dof % C);
    let Some(point) = points.iter().find(|p| p.place.minus == node || p.place.plus == node) else {
        return Refusal::from(format!("a condition on degree of freedom {dof} does not agree with a fault"));
    };
    let nodes = [point.place.minus, point.place.plus];
    let axis = ["x", "y", "z"][model.idealisation.axis(component)];
    let at = coordinates::in_words(&point.place.at);
    let both = nodes.iter().all(|&n| held::<C>(n, fixed)[component]);
    let (message, help) = if both {
        (
            format!(
                "conditions hold {axis} on both sides of a fault that is oblique to it at {at}: the fault could not slide there without opening"
            ),
            format!(
                "let the fault end inside the bodies, hold {axis} on one side of the fault only, or prescribe all components on both sides and let the \
                 fault creep there"
            ),
        )
    } else {
        (
            format!(
                "conditions hold {axis} on one side of a fault at {at} and other components on the other side"
            ),
            format!(
                "leave {axis} out on one of the sets that meet there, or hold the same components on both"
            ),
        )
    };
    Refusal { message, help: Some(help), at: Some((nodes, component)), ..Refusal::default() }
}

/// The refusal of conditions that prescribe the motion of both sides of a point along its slip, whose direction is `slides`.
pub(super) fn along_slip<const D: usize, const C: usize>(place: &Place<D>, slides: &[f64; C]) -> Refusal {
    let most = |&a: &usize, &b: &usize| slides[a].abs().total_cmp(&slides[b].abs());
    let component = (0..C).max_by(most).unwrap_or(0);
    Refusal {
        message: format!(
            "conditions prescribe the motion of both sides of a fault along its slip at {}, where it is to slide",
            coordinates::in_words(&place.at)
        ),
        help: Some("let it creep there, or leave that component of the conditions out".into()),
        at: Some(([place.minus, place.plus], component)),
        ..Refusal::default()
    }
}

/// Share of the motions up to which two of them are the same: rounding of rates and durations.
const AGREES: f64 = 1e-9;

/// Rates of creep \[m/s\] by degree of freedom until `end`, of jumps along so many tangents, where conditions, which fix the jumps of `fixed`, do not prescribe them already.
///
/// # Errors
/// A [`Refusal`] where conditions prescribe another motion of both sides of a point that creeps, or move its sides apart.
pub(super) fn creep<const D: usize, const C: usize>(
    (points, first): (&[Point<D>], &[usize]),
    fixed: &[usize],
    channels: &[Channel],
    (tangents, end): (usize, f64),
    frame: &impl Fn(&Place<D>) -> [[f64; C]; C],
) -> Result<Vec<(usize, f64)>, Refusal> {
    let value = |channel: &Channel, dof: usize| {
        channel.prescribed.iter().find(|(d, _)| *d == dof).map_or(0.0, |(_, value)| *value)
    };
    let moved = |dof: usize, time: f64| -> f64 {
        channels.iter().map(|c| value(c, dof) * c.amplitude.value(time)).sum()
    };
    let mut times: Vec<f64> = channels.iter().flat_map(|c| c.amplitude.times().iter().copied()).collect();
    times.retain(|t| *t < end);
    times.push(end);
    let most = |c: &Channel| {
        c.prescribed.iter().fold(0.0_f64, |m, (_, v)| m.max((v * c.amplitude.value(end)).abs()))
    };
    let travel = channels.iter().map(most).fold(0.0, f64::max);
    let mut rates = Vec::new();
    for (point, &dof) in points.iter().zip(first) {
        let Some(creep) = point.creep else { continue };
        // What does not slide does not creep, and nothing opens.
        let along = creep.into_iter().take(tangents).chain(std::iter::repeat(0.0));
        for (c, rate) in along.take(C).enumerate() {
            if fixed.binary_search(&(dof + c)).is_err() {
                rates.extend((rate != 0.0).then_some((dof + c, rate)));
                continue;
            }
            let scale = travel.max((rate * end).abs());
            let differs = |t: &&f64| (moved(dof + c, **t) - rate * **t).abs() > AGREES * scale;
            if let Some(&t) = times.iter().find(differs) {
                let way = moved(dof + c, t);
                return Err(otherwise(
                    &point.place,
                    &frame(&point.place)[c],
                    (c < tangents).then_some(rate),
                    way,
                    t,
                ));
            }
        }
    }
    Ok(rates)
}

/// The refusal of conditions that move both sides of a place by `way` \[m\] in `time` \[s\] along an axis where it creeps at `rate`, or, where
/// that is none, does not open.
fn otherwise<const D: usize, const C: usize>(
    place: &Place<D>,
    axis: &[f64; C],
    rate: Option<f64>,
    way: f64,
    time: f64,
) -> Refusal {
    let most = |&a: &usize, &b: &usize| axis[a].abs().total_cmp(&axis[b].abs());
    let component = (0..C).max_by(most).unwrap_or(0);
    let at = coordinates::in_words(&place.at);
    let (message, help) = match rate {
        Some(rate) => (
            format!(
                "conditions move the sides of a fault past each other by {way:.4e} m in {time:.4e} s at {at}, and its creep of {rate:e} m/s there by {:.4e} m",
                rate * time
            ),
            "let the motions of both sides differ by the creep, or leave that component out on one of them",
        ),
        None => (
            format!(
                "conditions move the sides of a fault apart or into each other at {at}, by {way:.4e} m in {time:.4e} s"
            ),
            "a fault does not open: prescribe the same motion along its normal on both sides, or leave that component out on one of them",
        ),
    };
    let at = Some(([place.minus, place.plus], component));
    Refusal { message, help: Some(help.into()), at, ..Refusal::default() }
}
