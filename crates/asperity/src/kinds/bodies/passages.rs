//! Passages of bodies from equilibrium to inertia and back, in the report.

use asperity_mechanics::Episode;
use asperity_run::Warning;
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
pub(crate) fn from_episodes(episodes: &[Episode]) -> Vec<Passage> {
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

/// Forces that equilibrium may leave out before inertia acts, over its largest force: tractions then err by some per cent.
const LEFT_OUT: f64 = 0.05;
/// Kinetic energy that may be lost in the return: slip then errs by some per cent.
const LOST: f64 = 0.1;

/// Warnings about hand-overs whose errors show in the results.
pub(crate) fn doubts(passages: &[Passage]) -> Vec<Warning> {
    let most = |of: fn(&Passage) -> f64| passages.iter().map(of).fold(0.0, f64::max);
    let (left_out, lost) = (most(|p| p.left_out), most(|p| p.lost.abs()));
    let late = (left_out > LEFT_OUT).then(|| {
        let message = format!(
            "bodies gained inertia too late: the last state of equilibrium left out {left_out:.2} of its largest force"
        );
        Warning::at(0..0, message, "take a smaller `above` in `handover` of `[time]`")
    });
    let early = (lost > LOST).then(|| {
        let message =
            format!("bodies lost {lost:.2} of their largest kinetic energy as they returned to equilibrium");
        Warning::at(
            0..0,
            message,
            "add `kinetic = 0.01` to `handover` of `[time]`, which waits for vibrations to decay",
        )
    });
    late.into_iter().chain(early).collect()
}
