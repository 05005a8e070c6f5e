//! Points of a fault by tasks, which threads take.

use super::fault_state::FaultState;
use super::surroundings::PointForces;
use asperity_friction::points::Components;

/// Points of one task: fixed, so that sums do not depend on the number of threads.
const POINTS: usize = 256;

/// Points of one task, whose tractions are balanced.
pub(super) struct Part<'a> {
    /// First point.
    pub first: usize,
    pub normal: &'a mut [f64],
    pub gap: &'a mut [f64],
    /// Empty where normal tractions are not delayed.
    pub felt: &'a mut [f64],
    /// One component is empty in the plane.
    pub shear: [&'a mut [f64]; 2],
    pub forces: &'a mut [PointForces],
    /// Slip rates of all points at the last step.
    pub rate: Components<&'a [f64]>,
    states: &'a mut [f64],
}

impl Part<'_> {
    /// States of a point of the task.
    pub fn states_of(&mut self, own: usize) -> &mut [f64] {
        let variables = self.states.len() / self.normal.len();
        &mut self.states[own * variables..(own + 1) * variables]
    }
}

/// Points of one task, whose slip is recorded.
pub(super) struct RecordPart<'a> {
    /// First point.
    pub first: usize,
    /// One component is empty in the plane.
    pub slip: [&'a mut [f64]; 2],
    pub rate: [&'a mut [f64]; 2],
    /// Tractions of all points.
    pub normal: &'a [f64],
    pub shear: Components<&'a [f64]>,
}

/// All points to be balanced.
pub(super) fn parts<'a>(state: &'a mut FaultState, forces: &'a mut [PointForces]) -> Vec<Part<'a>> {
    let points = state.normal.len();
    let variables = state.states.all().len() / points.max(1);
    let mut states = state.states.all_mut().chunks_mut((variables * POINTS).max(1));
    let (mut felt, mut shear) = (state.felt.chunks_mut(POINTS), divided(&mut state.shear).into_iter());
    let rate = state.rate.view();
    let tractions = state.normal.chunks_mut(POINTS).zip(state.gap.chunks_mut(POINTS));
    let all = tractions.zip(forces.chunks_mut(POINTS)).enumerate();
    let part = |(task, ((normal, gap), forces))| Part {
        first: task * POINTS,
        normal,
        gap,
        felt: felt.next().unwrap_or_default(),
        shear: shear.next().unwrap_or_default(),
        forces,
        rate,
        states: states.next().unwrap_or_default(),
    };
    all.map(part).collect()
}

/// All points to be recorded.
pub(super) fn record_parts(state: &mut FaultState) -> Vec<RecordPart<'_>> {
    let (normal, shear) = (&state.normal[..], state.shear.view());
    let moved = divided(&mut state.slip).into_iter().zip(divided(&mut state.rate));
    let part = |(task, (slip, rate))| RecordPart { first: task * POINTS, slip, rate, normal, shear };
    moved.enumerate().map(part).collect()
}

/// One or two components of the points of each task.
fn divided(values: &mut Components<Vec<f64>>) -> Vec<[&mut [f64]; 2]> {
    let [first, second] = values.pair_mut();
    let mut second = second.chunks_mut(POINTS);
    first.chunks_mut(POINTS).map(|first| [first, second.next().unwrap_or_default()]).collect()
}
