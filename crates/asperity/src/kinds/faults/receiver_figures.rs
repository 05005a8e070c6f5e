//! Figures of the displacement of receivers through cycles.

use super::receiver_rows;
use asperity_output::figures::{Curves, Measure, Points};
use asperity_plan::faults::{Plan, Receiver};

/// Names of the axes.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Displacements of all receivers through time, axis by axis.
pub(super) fn displacements(plan: &Plan) -> Vec<Curves> {
    let receivers = &plan.receivers;
    if receivers.all.is_empty() {
        return Vec::new();
    }
    let one = |(k, &axis): (usize, &usize)| {
        // Time and the velocities along all axes stand before.
        let column = 1 + receivers.axes.len() + k;
        let curve = |receiver: &Receiver| {
            let table = receiver_rows::FILE.named(&receiver.name);
            (receiver.name.clone(), Points::Table { table, x: 0, y: column, size: false })
        };
        Curves {
            file: format!("receivers_displacement_{}", AXES[axis]),
            title: plan.title.clone(),
            x: ("Time".into(), Measure::Time),
            y: (format!("Displacement along {}", AXES[axis]), Measure::Length),
            curves: receivers.all.iter().map(curve).collect(),
            event: None,
            without_zero: true,
            until: None,
            pairs: false,
        }
    };
    receivers.axes.iter().enumerate().map(one).collect()
}
