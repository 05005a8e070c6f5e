//! Explanations why bodies cannot be condensed onto faults, with the position in the scene.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault, Motion, Scene, Spanned};
use crate::shared::amounts;
use crate::shared::model::{self, Model};
use asperity_cycles::medium::{Loads, Place, Point, Refusal};
use asperity_mechanics::coordinates;
use std::ops::Range;

/// Points that the bodies are condensed onto, and the loads on the bodies.
#[derive(Clone, Copy)]
pub(super) struct CondensationInput<'a, const D: usize> {
    pub scene: &'a Scene,
    pub model: &'a Model<D>,
    pub loads: &'a Loads,
    pub points: &'a [Point<D>],
}

/// A refusal as text.
struct RefusalText {
    /// Description of the error.
    message: String,
    /// Remedy; `None` if the message contains it.
    help: Option<String>,
    place: Where,
}

/// Subject of a refusal.
enum Where {
    /// Conditions on a component of displacement of the two nodes of a point.
    Conditions([usize; 2], usize),
    /// Sides of the faults.
    Sides,
    /// The memory limit.
    Memory,
    /// A body.
    Body(String),
    /// A condition that loads a set by a spring.
    Spring,
}

impl<const D: usize> CondensationInput<'_, D> {
    /// A refusal as an error of the plan, at the condition that causes it.
    pub fn error(&self, refusal: &Refusal) -> Diagnostic {
        let RefusalText { message, help, place } = self.told(refusal);
        let found = match place {
            Where::Conditions(nodes, component) => self.condition(nodes, component),
            _ => None,
        };
        let (message, span) = match found {
            Some((set, span)) => (format!("`{set}`: {message}"), span),
            None => (message, self.span(&place)),
        };
        Diagnostic { message, help, span, also: Vec::new() }
    }

    fn told(&self, refusal: &Refusal) -> RefusalText {
        match refusal {
            Refusal::Drawn { point } => drawn(&self.points[*point].place),
            Refusal::Oblique { dof } => self.oblique(*dof),
            Refusal::AlongSlip { point, component } => along_slip(&self.points[*point].place, *component),
            Refusal::Moved { point, component, rate, way, time } => {
                moved(&self.points[*point].place, *component, *rate, [*way, *time])
            }
            Refusal::Memory { needed, allowed, points } => self.too_much(*points, [*needed, *allowed]),
            Refusal::Loose { dof, jumps } => self.loose(*dof, *jumps),
            Refusal::Other(message) => {
                RefusalText { message: message.clone(), help: None, place: Where::Sides }
            }
        }
    }

    /// Set and position of the condition that prescribes a component at one of these nodes.
    fn condition(&self, nodes: [usize; 2], component: usize) -> Option<(String, Range<usize>)> {
        let axis = self.model.idealisation.axis(component);
        let conditions = self.scene.stages.iter().flat_map(|s| &s.conditions).map(|c| c.get_ref());
        let mut found = conditions.filter_map(|c| {
            let motion = [&c.x, &c.y, &c.z][axis].as_ref();
            let motion = motion.filter(|m| !matches!(m.get_ref(), Motion::Free | Motion::Spring { .. }));
            let place = motion
                .map(|m| m.span())
                .or(c.symmetry.as_ref().map(|s| s.span()))
                .or(c.rotate.as_ref().map(|r| r.span()))?;
            let set = c.set.as_ref()?;
            let of = model::nodes(self.model, set).ok()?;
            nodes.iter().any(|n| of.binary_search(n).is_ok()).then(|| (set.get_ref().clone(), place))
        });
        found.next()
    }

    fn span(&self, place: &Where) -> Range<usize> {
        let scene = self.scene;
        let springs = || {
            let motions = scene.stages.iter().flat_map(|s| &s.conditions).map(|c| c.get_ref());
            let mut motions = motions.flat_map(|c| [&c.x, &c.y, &c.z].into_iter().flatten());
            motions.find(|m| matches!(m.get_ref(), Motion::Spring { .. })).map(|m| m.span())
        };
        let found = match place {
            Where::Conditions(..) | Where::Sides => None,
            Where::Memory => scene.solver.memory.as_ref().map(Spanned::span),
            Where::Body(body) => scene.bodies.get(body).map(|b| b.material.span()),
            Where::Spring => springs(),
        };
        found.or_else(|| scene.faults.values().next().map(Fault::span)).unwrap_or(0..0)
    }

    /// Error for a condensation that needs more memory than is allowed.
    fn too_much(&self, points: usize, [needed, allowed]: [usize; 2]) -> RefusalText {
        let dofs = self.model.dofs();
        let message = format!(
            "condensing {dofs} degrees of freedom onto {points} points of the faults needs about {}, and {} are allowed",
            amounts::size(needed),
            amounts::size(allowed)
        );
        let help = "raise `memory` in `[solver]` where the machine has it, or take coarser cells on the faults or away from them";
        RefusalText { message, help: Some(help.into()), place: Where::Memory }
    }

    /// Error for a body that can move without resistance.
    fn loose(&self, dof: usize, jumps: bool) -> RefusalText {
        let node = dof / self.model.idealisation.components();
        let component = if jumps { "slips or opens there" } else { "can move there" };
        let body = self.model.bodies.iter().find(|b| b.dofs.contains(&dof)).map_or("", |b| b.name.as_str());
        let message = format!(
            "the bodies around the faults are not held: body `{body}` {component} without resistance, found at {}",
            coordinates::in_words(&self.model.mesh.nodes[node])
        );
        let help = Some("prescribe motions of sides that hold each side of a fault".into());
        RefusalText { message, help, place: Where::Body(body.into()) }
    }

    /// Error for a condition that cannot be expressed in the local axes of a displacement jump; `dof` is the degree of freedom concerned.
    fn oblique(&self, dof: usize) -> RefusalText {
        let count = self.model.idealisation.components();
        let (node, component) = (dof / count, dof % count);
        let of_node = |p: &&Point<D>| p.place.minus == node || p.place.plus == node;
        let Some(point) = self.points.iter().find(of_node) else {
            let message = format!("a condition on degree of freedom {dof} does not agree with a fault");
            return RefusalText { message, help: None, place: Where::Sides };
        };
        let nodes = [point.place.minus, point.place.plus];
        let axis = ["x", "y", "z"][self.model.idealisation.axis(component)];
        let at = coordinates::in_words(&point.place.at);
        let fixed = &self.loads.constraints.fixed;
        let both = nodes.iter().all(|n| fixed.binary_search(&(count * n + component)).is_ok());
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
        RefusalText { message, help: Some(help), place: Where::Conditions(nodes, component) }
    }
}

/// Error for a spring that loads both sides of a fault.
fn drawn<const D: usize>(place: &Place<D>) -> RefusalText {
    let message = format!(
        "a spring moves both sides of a fault as one at {}, which could not slip there",
        coordinates::in_words(&place.at)
    );
    RefusalText {
        message,
        help: Some("let it load a side that ends at the fault".into()),
        place: Where::Spring,
    }
}

/// Error for conditions that prescribe the motion of both sides of a point in the direction of slip.
fn along_slip<const D: usize>(place: &Place<D>, component: usize) -> RefusalText {
    RefusalText {
        message: format!(
            "conditions prescribe the motion of both sides of a fault along its slip at {}, where it is to slide",
            coordinates::in_words(&place.at)
        ),
        help: Some("let it creep there, or leave that component of the conditions out".into()),
        place: Where::Conditions([place.minus, place.plus], component),
    }
}

/// Error for conditions that move the sides of a point apart by `way` \[m\] in `time` \[s\] along an axis. The fault creeps there at `rate`; if that
/// is `None`, it does not open.
fn moved<const D: usize>(
    place: &Place<D>,
    component: usize,
    rate: Option<f64>,
    [way, time]: [f64; 2],
) -> RefusalText {
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
    RefusalText {
        message,
        help: Some(help.into()),
        place: Where::Conditions([place.minus, place.plus], component),
    }
}
