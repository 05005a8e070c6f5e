//! Passages of bodies from equilibrium to inertia and back, in the report.

use asperity_mechanics::Episode;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One passage with inertia, and the errors of the hand-overs at both ends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Passage {
    /// Time at which inertia began to act \[s\].
    pub begin: f64,
    /// Time at which it ceased \[s\]; absent if it acts at the end of the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end: Option<f64>,
    /// Steps with inertia.
    pub steps: usize,
    /// Forces of inertia in the last state of equilibrium, which leaves them out, over its largest force \[-\].
    pub left_out: f64,
    /// Largest kinetic energy \[J; J per metre of thickness in plane strain and antiplane motion\].
    pub largest_kinetic: f64,
    /// Energy lost in the return to equilibrium, over the largest kinetic energy \[-\].
    pub lost: f64,
}

/// Passages of a run.
pub(crate) fn of(episodes: &[Episode]) -> Vec<Passage> {
    let of = |e: &Episode| Passage {
        begin: e.begin,
        end: e.end,
        steps: e.steps,
        left_out: e.left_out,
        largest_kinetic: e.largest,
        lost: if e.lost == 0.0 { 0.0 } else { e.lost / e.largest },
    };
    episodes.iter().map(of).collect()
}
