//! Doubt about nodes that two interfaces count.
//!
//! In node-to-point contact a slave node with a partner acts with its whole tributary area. Where one slave side has an interface with
//! each of two masters that adjoin, the nodes at their common edge face both, and act twice.

use super::assembly::Assembly;
use super::start_gaps::MeasuredGaps;
use super::surfaces::FacingSurfaces;
use super::{PlannedInterface, SHARE};
use crate::reading::diagnostic::Diagnostic;
use asperity_mechanics::{Measure, coordinates};
use asperity_run::Warning;
use std::collections::BTreeMap;

/// Warnings about nodes of one slave side that face the masters of two interfaces at the same distance, to within a share of the
/// element size.
///
/// # Errors
/// [`Diagnostic`] at a side that does not exist.
pub fn doubts<const D: usize>(
    assembly: &Assembly<'_, D>,
    measured: &[MeasuredGaps],
) -> Result<Vec<Warning>, Diagnostic> {
    let model = &assembly.model;
    let all: Vec<(&PlannedInterface, &MeasuredGaps)> = assembly.interfaces.iter().zip(measured).collect();
    let mut doubts = Vec::new();
    for (k, (planned, gaps)) in all.iter().enumerate() {
        let own = assembly.entry(planned);
        let size = FacingSurfaces::find(model, own)?.slave.cell_size(model);
        for (other, others) in &all[..k] {
            let twin = assembly.entry(other);
            let nodal = [planned, other].iter().all(|i| i.measure == Measure::NodeToPoint);
            if !nodal || twin.spec.slave.get_ref() != own.spec.slave.get_ref() {
                continue;
            }
            let before = facing(other, others);
            let near =
                |node: &usize, gap: f64| before.get(node).is_some_and(|g| (g - gap).abs() < SHARE * size);
            let both: Vec<usize> = facing(planned, gaps)
                .into_iter()
                .filter(|(node, gap)| near(node, *gap))
                .map(|n| n.0)
                .collect();
            let Some(first) = both.first() else { continue };
            let message = format!(
                "nodes of `{}` face the masters of both interfaces `{}` and `{}`, {} of them, such as at {}, and node-to-point contact counts \
                 their whole area in each",
                own.spec.slave,
                other.name,
                planned.name,
                both.len(),
                coordinates::in_words(&model.mesh.nodes[*first])
            );
            let help = "write one interface whose `master` is a list of the sides, or `measure = \"mortar\"`, which integrates over what faces";
            doubts.push(Warning::at(own.spec.slave.span(), message, help));
        }
    }
    Ok(doubts)
}

/// Gaps of the nodes that face the master \[m\].
fn facing(planned: &PlannedInterface, measured: &MeasuredGaps) -> BTreeMap<usize, f64> {
    measured.facing.iter().map(|point| (planned.slave[point.point].0, point.gap)).collect()
}
