//! Springs so stiff that their force would be rounding.

use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Condition, Motion, Spanned};
use crate::shared::model::{Model, bounds};

/// Largest stiffness over that of the bodies. The force of a spring is its stiffness times the difference of two displacements, of
/// which rounding leaves a part of 2e-16: then it is exact to a part in a million of what deforms the bodies.
const STIFFEST: f64 = 4e9;

/// Refuses springs of a condition whose force could not be told from rounding.
///
/// # Errors
/// [`Diagnostic`] at the spring.
pub(super) fn refuse<const D: usize>(
    model: &Model<D>,
    condition: &Spanned<Condition>,
) -> Result<(), Diagnostic> {
    let c = condition.get_ref();
    let most = STIFFEST * body_stiffness(model);
    for (axis, motion) in ["x", "y", "z"].into_iter().zip([&c.x, &c.y, &c.z]) {
        let Some(motion) = motion else { continue };
        if let Motion::Spring { stiffness, .. } = motion.get_ref()
            && *stiffness > most
        {
            let unit = if D == 3 { "N/m" } else { "N/m per metre of thickness" };
            let message = format!(
                "a spring of {stiffness:e} {unit} is so much stiffer than the bodies that its force is rounding"
            );
            let help = format!(
                "at most {most:.0e}; without a spring `{axis} = {{ rate = .. }}` moves the set, and `forces` in `[output]` has its force"
            );
            return Err(Diagnostic::at(motion.span(), message, help));
        }
    }
    Ok(())
}

/// Stiffness of the bodies in order of magnitude: the largest Young's modulus, in space times the largest extent \[N/m; N/m per metre of
/// thickness in the plane\].
fn body_stiffness<const D: usize>(model: &Model<D>) -> f64 {
    let young = model.bodies.iter().flat_map(|body| &body.elastic).map(|e| e.young()).fold(0.0, f64::max);
    let (least, most) = bounds(&model.mesh.nodes);
    let extents = most.iter().zip(&least).map(|(most, least)| most - least);
    if D == 3 { young * extents.fold(0.0, f64::max) } else { young }
}
