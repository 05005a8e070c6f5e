//! Positions in bodies whose motion is written: their weights in the displacements of the condensed bodies.

use super::super::receivers::{Receiver, Receivers};
use super::backslip::PlateRates;
use super::condensation_refusals::CondensationInput;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::Spanned;
use crate::reading::scene::units::Length;
use crate::shared::model::{Model, bounds};
use asperity_cycles::medium::{Bodies, DisplacementSum, Point};
use asperity_fem::mesh::{Location, locate};
use asperity_mechanics::coordinates::in_words;

/// Share of a node in the displacement of a position below which it has none: rounding of natural coordinates.
const NO_SHARE: f64 = 1e-9;

/// A position of a scene.
type NamedPosition<'a> = (&'a String, &'a Spanned<Vec<Length>>);

/// Nodes of the cell around a position, with their shares in its displacement.
type Shares = Vec<(usize, f64)>;

/// Receivers of a scene between bodies, whose points lag behind plates with these rates.
///
/// # Errors
/// [`Diagnostic`] at a receiver outside the bodies or on a fault, or one beside faults that may open.
pub(super) fn plan<const D: usize>(
    CondensationInput { scene, model, points, .. }: CondensationInput<'_, D>,
    bodies: &Bodies,
    plates: &PlateRates,
) -> Result<Receivers, Diagnostic> {
    let given: Vec<NamedPosition<'_>> = scene.output.receivers.iter().collect();
    let shares = given.iter().map(|given| shares(*given, model, points)).collect::<Result<Vec<_>, _>>()?;
    let components = model.idealisation.components();
    let row = |shares: &Shares, c: usize| {
        shares.iter().map(|(node, share)| (node * components + c, *share)).collect()
    };
    let sums: Vec<Shares> = shares.iter().flat_map(|s| (0..components).map(move |c| row(s, c))).collect();
    let axes: Vec<usize> = (0..components).map(|c| model.idealisation.axis(c)).collect();
    let followed = bodies.followed(&sums, plates.tangents);
    let receiver =
        |(given, followed): (&NamedPosition<'_>, &[DisplacementSum])| receiver(*given, followed, &axes);
    let all = given.iter().zip(followed.chunks_exact(components)).map(receiver).collect();
    Ok(Receivers { all, rates: plates.rates.clone(), axes })
}

/// A receiver from what each component of its displacement follows.
fn receiver((name, given): NamedPosition<'_>, followed: &[DisplacementSum], axes: &[usize]) -> Receiver {
    let vector = |of: &dyn Fn(&DisplacementSum) -> f64| {
        let mut vector = [0.0; 3];
        axes.iter().zip(followed).for_each(|(&axis, f)| vector[axis] = of(f));
        vector
    };
    let slips = followed.first().map_or(0, |f| f.per_slip.len());
    let loads = followed.first().map_or(&[][..], |f| &f.loads[..]).iter().enumerate();
    Receiver {
        name: name.clone(),
        at: std::array::from_fn(|c| given.get_ref().get(c).map_or(0.0, |x: &Length| x.0)),
        per_slip: (0..slips).map(|k| vector(&|f| f.per_slip[k])).collect(),
        plates: [0.0; 3],
        loads: loads.map(|(k, (amplitude, _))| (amplitude.clone(), vector(&|f| f.loads[k].1))).collect(),
    }
}

/// Shares of nodes in the displacement of a position.
fn shares<const D: usize>(
    (name, given): NamedPosition<'_>,
    model: &Model<D>,
    points: &[Point<D>],
) -> Result<Shares, Diagnostic> {
    let at: [f64; D] = std::array::from_fn(|c| given.get_ref().get(c).map_or(0.0, |x: &Length| x.0));
    let found = model.bodies.iter().find_map(|body| locate(&model.mesh, body.blocks.clone(), &at));
    let Some(Location { block, cell, xi }) = found else {
        let (min, max) = bounds(&model.mesh.nodes);
        return Err(Diagnostic::at(
            given.span(),
            format!("receiver `{name}` at {} lies outside the bodies", in_words(&at)),
            format!("the bodies lie between {} and {}", in_words(&min), in_words(&max)),
        ));
    };
    let cells = &model.mesh.blocks[block];
    let shape = cells.kind.shape(xi);
    let all = cells.cell(cell).iter().copied().zip(shape.n);
    let shares: Shares = all.filter(|(_, share)| share.abs() > NO_SHARE).collect();
    let on_side = |node: usize| {
        points.iter().any(|p| p.place.minus != p.place.plus && [p.place.minus, p.place.plus].contains(&node))
    };
    if shares.iter().all(|(node, _)| on_side(*node)) {
        return Err(Diagnostic::at(
            given.span(),
            format!("receiver `{name}` at {} lies on a fault, whose sides move apart", in_words(&at)),
            "a position on one of its sides",
        ));
    }
    if let Some(open) = points.iter().find(|p| p.opens) {
        return Err(Diagnostic::at(
            given.span(),
            format!(
                "receivers do not follow faults that may open, such as that at {}",
                in_words(&open.place.at)
            ),
            "`points.NAME = { body = \"..\", at = [..] }`, which has displacements; or `opening = false` on the fault",
        ));
    }
    Ok(shares)
}
