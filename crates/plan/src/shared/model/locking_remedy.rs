//! Elements and formulations that do not lock, in the place of those that do.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Body, Formulation, Interface, Measure, Scene, Sliding, Spanned, Stepper};
use crate::shared::entry::Entry;
use asperity_fem::element::ElementKind;

/// Refuses B-bar for elements on which it has no effect.
///
/// # Errors
/// [`Diagnostic`] with what does not lock in their place.
pub fn admit(
    scene: &Scene,
    Entry { name, spec: body }: Entry<'_, Body>,
    kind: ElementKind,
) -> Result<(), Diagnostic> {
    let why = match kind {
        ElementKind::Tri3 | ElementKind::Tet4 => {
            "its dilatation is constant in a cell already, so that projecting it changes nothing"
        }
        ElementKind::Wedge6 => {
            "two wedges in the place of one hexahedron have too many dilatations for their nodes, so that it locks all the same"
        }
        _ => return Ok(()),
    };
    let asked = body.formulation.as_ref().filter(|f| *f.get_ref() == Formulation::BBar);
    asked.map_or(Ok(()), |f| {
        let message = format!("B-bar for {} of body `{name}`: {why}", kind.name());
        Err(Diagnostic::at(f.span(), message, remedy(scene, name, kind)))
    })
}

/// Elements that do not lock, in the place of one that does.
pub(super) fn remedy(scene: &Scene, body: &str, kind: ElementKind) -> String {
    let b_bar = "`formulation = \"b-bar\"`";
    let (first, second) = match kind {
        ElementKind::Quad4 => (b_bar.to_string(), "quad8"),
        ElementKind::Hex8 => (b_bar.to_string(), "hex20"),
        ElementKind::Tri3 => (format!("quad4 with {b_bar}"), "tri6"),
        ElementKind::Tet4 => (format!("hex8 with {b_bar}"), "tet10"),
        _ => (format!("hex8 with {b_bar}"), "wedge15"),
    };
    if second_order(scene, body) { format!("use {first}, or {second}") } else { format!("use {first}") }
}

/// True if cells of second order can take the place of those of a body.
fn second_order(scene: &Scene, body: &str) -> bool {
    let own = |set: &Spanned<String>| set.get_ref().split('.').next() == Some(body);
    // Contact has faces of second order with mortar and small sliding alone, but in the plane.
    let flat = |i: &Interface| {
        let [nodes, finite] =
            [*i.measure.get_ref() == Measure::NodeToPoint, *i.sliding.get_ref() == Sliding::Finite];
        nodes || finite || i.smoothing.is_some()
    };
    let slides = scene.interfaces.values().any(|i| (own(&i.slave) || i.master.iter().any(own)) && flat(i));
    // Masses at the nodes of explicit steps, and the areas at the nodes of faults, are those of first order.
    let explicit = *scene.time.stepper.get_ref() == Stepper::Explicit;
    !slides && !explicit && scene.faults.is_empty()
}
