//! Processes on faults, each behind the seam of [`crate::problem::Process`].

mod deficit;
pub mod diffusion;
mod floor;
mod fluid;
pub mod heat;
mod injection;
mod opening;
mod pulse;

pub use deficit::deficit;
pub use floor::{BODIES, Floor, FloorRecord, FloorSummary};
pub use fluid::{FLUID_PRESSURE, PorePressure};
pub use injection::{Injection, Pressure};
pub use opening::{Crack, OPENING, Opening, OpeningRecord, Widest};
pub use pulse::Pulse;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Processes;

    #[test]
    fn processes_act_in_the_order_of_their_phases_and_those_of_a_phase_as_they_were_added() {
        let pulse = |rise| Pulse { amplitude: vec![1.0], rise };
        let floor = Floor::new([Some(1e6)].into_iter());
        let all = Processes::default().and(floor).with(pulse(1.0)).with(Pressure::default()).with(pulse(2.0));
        let names: Vec<_> = all.iter().map(|process| process.name()).collect();
        assert_eq!(names, ["pulse", "pulse", "injection", "floor"]);
        assert_eq!(all.each::<Pulse>().map(|pulse| pulse.rise).collect::<Vec<_>>(), [1.0, 2.0]);
        assert!(all.find::<Floor>().is_some() && all.find::<Opening>().is_none());
        assert_eq!((all.least(0), all.imposed(0, 3.0)), (1e6, [2.0, 0.0]));
    }
}
