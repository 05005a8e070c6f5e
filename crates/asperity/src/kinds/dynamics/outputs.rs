//! Outputs of a run of bodies with mass: tables, and fields with the data for figures.

use super::fields::{Fields, WrittenFields};
use super::moment::Moment;
use super::run::{Dynamics, ResumeState};
use super::tables::Tables;
use super::{FinalState, arrivals, figures, seismograms};
use crate::checkpoint::{self, ResumeError};
use crate::keep::{self, Place};
use asperity_ode::Control;
use asperity_output::decimals::shortest;
use asperity_output::fields::Field;
use asperity_output::figures::Sheet;
use asperity_output::tables::column;
use asperity_output::tables::describe::FileParts;
use asperity_output::terminal::progress::RunState;
use asperity_output::{OutputError, atomic};
use asperity_plan::dynamics::Plan;
use asperity_run::ObserveError;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// Everything needed to resume a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    stand: ResumeState,
    /// Sizes of the tables \[bytes\], by their paths.
    sizes: BTreeMap<String, u64>,
    taken: WrittenFields,
    drawn: bool,
}

impl checkpoint::SavedState for Checkpoint {
    const OF: &'static str = "bodies with mass";
    const VERSION: &'static str = "7";
}

/// See the module.
pub struct Outputs<'a, const D: usize> {
    plan: &'a Plan<D>,
    tables: Tables<'a>,
    fields: Fields<'a>,
    drawn: bool,
}

impl<const D: usize> Outputs<'_, D> {
    /// Fields of the run, by the paths of their files.
    #[must_use]
    pub fn fields(&self) -> Vec<FileParts<Field>> {
        self.fields.all()
    }

    /// Writes the files of the end of a run into `out`, and returns its figures.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn complete(self, out: &Path, ended: &FinalState) -> Result<Sheet, OutputError> {
        let plan = self.plan;
        self.fields.collect(plan)?;
        seismograms::write(out, plan)?;
        if !plan.points.is_empty() {
            atomic::write(&out.join(arrivals::FILE.path), ruptures(plan, ended).as_bytes())?;
        }
        Ok(figures::sheet(plan, ended.time, &ended.arrivals, &self.fields.taken))
    }
}

impl<'a, const D: usize> keep::Outputs for Outputs<'a, D> {
    type Kind = Dynamics;
    type Plan = &'a Plan<D>;
    type Checkpoint = Checkpoint;

    fn create(plan: &'a Plan<D>, place: &Place<'_>) -> Result<Self, OutputError> {
        let (out, drawn) = (place.out, place.drawn);
        atomic::writable_dir(out)?;
        let tables = Tables::create(out, plan)?;
        Ok(Self { plan, tables, fields: Fields::new(out, plan, WrittenFields::default(), drawn)?, drawn })
    }

    fn reopen(
        plan: &'a Plan<D>,
        place: &Place<'_>,
        Checkpoint { stand, sizes, taken, drawn }: Checkpoint,
    ) -> Result<Option<(Self, ResumeState)>, ResumeError> {
        let out = place.out;
        let tables = Tables::reopen(out, plan, &sizes)?.filter(|_| stand.fits(plan));
        let Some(tables) = tables else { return Err(checkpoint::other_files(out)) };
        let drawn = drawn && place.drawn;
        let fields = Fields::new(out, plan, taken, drawn)?;
        Ok(Some((Self { plan, tables, fields, drawn }, stand)))
    }

    fn step(&mut self, now: &Moment<'_>) -> Result<Control, ObserveError> {
        self.tables.step(self.plan, now)?;
        self.fields.step(self.plan, now)?;
        Ok(Control::Go)
    }

    fn settle(&self) -> Result<(), OutputError> {
        self.tables.settle()
    }

    fn saved(&mut self, stand: &mut dyn FnMut() -> ResumeState, due: bool) -> Option<Checkpoint> {
        due.then(|| Checkpoint {
            stand: stand(),
            sizes: self.tables.sizes(),
            taken: self.fields.taken.clone(),
            drawn: self.drawn,
        })
    }

    fn times(&self, now: &Moment<'_>) -> [f64; 2] {
        [now.time, self.plan.end()]
    }

    fn now(&self, now: &Moment<'_>) -> RunState {
        let [time, end] = self.times(now);
        RunState {
            time,
            end,
            step: now.step as u64,
            step_length: end / self.plan.steps as f64,
            largest_rate: now.fault.rate.all().iter().map(|rate| rate.abs()).reduce(f64::max),
            ..RunState::default()
        }
    }

    fn draws(&self) -> bool {
        self.drawn
    }
}

/// Table of rupture times; NaN for points that did not rupture.
fn ruptures<const D: usize>(plan: &Plan<D>, ended: &FinalState) -> String {
    let mut text = column::header(&arrivals::columns());
    for fault in &plan.faults {
        for p in fault.points.clone() {
            let place = plan.points[p].at.map(shortest).join(",");
            let (time, fastest) = (ended.arrivals.times[p], ended.arrivals.fastest[p]);
            let time = time.map_or("NaN".into(), shortest);
            text.push_str(&format!("{},{place},{time},{}\n", fault.name, shortest(fastest)));
        }
    }
    text
}
