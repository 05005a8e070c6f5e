//! Stations on bodies and time zero.

use super::super::plan::Receiver;
use crate::faults::planner::PlacedPoint;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{PointSpec, Scene, Spanned};
use crate::shared::model::{self, Model};
use asperity_fem::mesh::locate;
use asperity_mechanics::coordinates::in_words;
use asperity_output::formats::seismogram::SHORTEST;
use jiff::Timestamp;
use std::collections::BTreeSet;

/// Share of a node of a cell that is rounding of the position in it.
const NO_SHARE: f64 = 1e-9;

/// Time zero of a scene that does not give it.
const EPOCH: &str = "2000-01-01T00:00:00Z";

/// Stations on bodies.
///
/// # Errors
/// [`Diagnostic`] for a station outside its body.
pub(super) fn receivers<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    sliding: &[PlacedPoint<D>],
) -> Result<Vec<Receiver>, Diagnostic> {
    let sides: Vec<[usize; 2]> =
        sliding.iter().map(|p| &p.point.place).map(|place| [place.minus, place.plus]).collect();
    scene.output.seismograms.iter().map(|(name, spec)| receiver(model, &sides, name, spec)).collect()
}

fn receiver<const D: usize>(
    model: &Model<D>,
    sides: &[[usize; 2]],
    name: &str,
    spec: &Spanned<PointSpec>,
) -> Result<Receiver, Diagnostic> {
    let (given, at) = (&spec.get_ref().body, &spec.get_ref().at);
    let unknown =
        || Diagnostic::at(given.span(), format!("there is no body `{}`", given.get_ref()), "name a body");
    let body = model.bodies.iter().find(|b| b.name == *given.get_ref()).ok_or_else(unknown)?;
    let position: Vec<f64> = at.get_ref().iter().map(|x| x.0).collect();
    let x: [f64; D] = std::array::from_fn(|c| position.get(c).copied().unwrap_or_default());
    let found = locate(&model.mesh, body.blocks.clone(), &x).ok_or_else(|| {
        let (min, max) = model::bounds(&model.mesh.nodes[body.nodes.clone()]);
        Diagnostic::at(
            at.span(),
            format!("the seismogram `{name}` at {} lies outside body `{}`", in_words(&x), body.name),
            format!("the body lies between {} and {}", in_words(&min), in_words(&max)),
        )
    })?;
    let cells = &model.mesh.blocks[found.block];
    let shares: Vec<(usize, f64)> =
        cells.cell(found.cell).iter().copied().zip(cells.kind.shape(found.xi).n).collect();
    // Of a cut through one body the name of the body does not tell the sides apart.
    let cut = sides.iter().filter(|side| side.iter().all(|node| body.nodes.contains(node)));
    let on_cut: BTreeSet<usize> = cut.flatten().copied().collect();
    if shares.iter().all(|(node, share)| share.abs() <= NO_SHARE || on_cut.contains(node)) {
        return Err(Diagnostic::at(
            at.span(),
            format!("the seismogram `{name}` at {} lies on a fault, whose sides move apart", in_words(&x)),
            "a position on one of its sides",
        ));
    }
    Ok(Receiver { name: name.to_string(), at: position, shares })
}

/// Time zero.
///
/// # Errors
/// [`Diagnostic`] at an epoch that is no time.
pub(super) fn epoch(scene: &Scene) -> Result<Timestamp, Diagnostic> {
    let given = scene.place.as_ref().map(|p| &p.epoch);
    let text = given.map_or(EPOCH, |e| e.get_ref());
    text.parse().map_err(|e: jiff::Error| {
        Diagnostic::at(
            given.map(Spanned::span).unwrap_or_default(),
            e.to_string(),
            format!("such as \"{EPOCH}\""),
        )
    })
}

/// Note on a format that cannot hold samples at this interval \[s\].
pub(super) fn notes(scene: &Scene, interval: f64) -> Option<String> {
    let short = interval < SHORTEST && !scene.output.seismograms.is_empty();
    short.then(|| {
        format!(
            "no miniSEED, which states times to the microsecond: samples are {interval:.3e} s apart, and several would have one time; \
             `sampling` of 1 us or more, or the files in CSV and SAC"
        )
    })
}
