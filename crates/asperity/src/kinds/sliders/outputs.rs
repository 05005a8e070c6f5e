//! Outputs of a run of spring-sliders: the histories, as they are kept in a directory.

use super::files::{Histories, Positions};
use crate::checkpoint::{self, ResumeError};
use crate::keep::{self, Place};
use asperity_cycles::slider::{Problem, SliderRun, SliderState as Step, Sliders};
use asperity_ode::Control;
use asperity_output::OutputError;
use asperity_output::terminal::progress::RunState;
use asperity_run::{ObserveError, Observer as _};
use serde::{Deserialize, Serialize};

/// Everything needed to resume a run of spring-sliders.
#[derive(Serialize, Deserialize)]
pub struct Checkpoint {
    run: SliderRun,
    histories: Positions,
}

impl checkpoint::SavedState for Checkpoint {
    const OF: &'static str = "spring-sliders";
    const VERSION: &'static str = "4";
}

/// See the module.
pub struct Outputs<'a> {
    problem: &'a Problem,
    histories: Histories,
}

impl Outputs<'_> {
    /// Completes the histories: they end with the last state.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn complete(mut self) -> Result<Histories, OutputError> {
        // Rows after the checkpoint are cut off if the run is resumed.
        self.histories.finish()?;
        Ok(self.histories)
    }
}

impl<'a> keep::Outputs for Outputs<'a> {
    type Kind = Sliders;
    type Plan = &'a Problem;
    type Checkpoint = Checkpoint;

    fn create(problem: &'a Problem, place: &Place<'_>) -> Result<Self, OutputError> {
        let histories = Histories::create(place.out, problem)?;
        Ok(Self { problem, histories: if place.drawn { histories.traced() } else { histories } })
    }

    fn reopen(
        problem: &'a Problem,
        place: &Place<'_>,
        Checkpoint { run, histories }: Checkpoint,
    ) -> Result<Option<(Self, SliderRun)>, ResumeError> {
        if run.unknowns.len() != problem.start.len() {
            return Err(checkpoint::foreign(place.out, "its unknowns differ from those of this scene"));
        }
        let histories = Histories::resume(place.out, problem, histories)?;
        Ok(Some((Self { problem, histories }, run)))
    }

    fn step(&mut self, now: &Step<'_>) -> Result<Control, ObserveError> {
        self.histories.step(now)
    }

    fn event(&mut self, slider: usize) -> Result<(), ObserveError> {
        self.histories.event(slider)
    }

    fn settle(&self) -> Result<(), OutputError> {
        self.histories.settle()
    }

    fn saved(&mut self, stand: &mut dyn FnMut() -> SliderRun, due: bool) -> Option<Checkpoint> {
        due.then(|| Checkpoint { run: stand(), histories: self.histories.positions() })
    }

    fn times(&self, now: &Step<'_>) -> [f64; 2] {
        [now.at.seconds(), self.problem.end]
    }

    fn now(&self, now: &Step<'_>) -> RunState {
        let [time, end] = self.times(now);
        RunState {
            time,
            end,
            step: now.step as u64,
            step_length: now.dt,
            largest_rate: now.conditions.iter().map(|c| c.rate.abs()).reduce(f64::max),
            ..RunState::default()
        }
    }

    fn draws(&self) -> bool {
        self.histories.are_traced()
    }
}
