//! Runs of faults, with bodies that have mass in ruptures if there are any.

use super::run::{Run, Where};
use crate::catalogue::{self, Entry};
use crate::cli::{json, lines};
use crate::keep::Keeper;
use crate::kinds;
use crate::kinds::faults::{Outputs, Report};
use asperity_cycles::FaultRun;
use asperity_output::atomic;
use asperity_output::fields::Field;
use asperity_output::figures::{EventPanel, PanelEvent, Sheet};
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_output::terminal::printing::out;
use asperity_plan::faults::Plan;
use asperity_plan::shared::ruptures::Ruptures;
use asperity_run::report::Outcome;
use miette::IntoDiagnostic;
use std::path::Path;

/// See the module.
pub(super) struct Faults<'a> {
    pub plan: &'a Plan,
    pub ruptures: Option<Ruptures>,
}

impl<'a> Run for Faults<'a> {
    type Outputs = Outputs<'a>;
    type FinalState = FaultRun;
    type Report = Report;

    fn plan(&self) -> &'a Plan {
        self.plan
    }

    fn reached(run: &FaultRun) -> (f64, u64) {
        (run.at.seconds(), run.counts.steps)
    }

    fn run(
        &mut self,
        _: &Path,
        keeper: &mut Keeper<Self::Outputs>,
        from: Option<FaultRun>,
    ) -> miette::Result<FaultRun> {
        let problem = &self.plan.problem;
        let mut dynamics = self.ruptures.as_mut().map(|r| r.dynamics(&problem.areas));
        let from = from.unwrap_or_else(|| self.plan.begin());
        let run = problem.resume(from, &problem.settings, dynamics.as_mut(), keeper).into_diagnostic()?;
        let failed = matches!(run.outcome, asperity_ode::Outcome::Failed { .. });
        if !failed && keeper.interrupted().is_none() {
            let ended = keeper.outputs().ended(&run);
            keeper.save(&ended).into_diagnostic()?;
        }
        Ok(run)
    }

    fn report(&self, run: &mut FaultRun, keeper: &mut Keeper<Self::Outputs>) -> Report {
        let mut report = Report::new(self.plan, run, keeper.outputs_mut().balance());
        report.warnings.extend(keeper.outputs().warning());
        if let Some(why) = keeper.interrupted() {
            report.outcome = Outcome::Interrupted { stage: None, time: report.end, reason: why.into() };
        }
        report
    }

    fn tables(&self, _: &Self::Outputs, report: &Report) -> Vec<FileParts<Column>> {
        kinds::faults::tables(self.plan).into_iter().chain(catalogue::tables(&report.events)).collect()
    }

    fn fields(&self, _: &Self::Outputs) -> Vec<FileParts<Field>> {
        kinds::faults::arrays(self.plan)
    }

    fn complete(
        &self,
        (path, hash): Where<'_>,
        _: Self::Outputs,
        run: &FaultRun,
        report: &Report,
    ) -> miette::Result<Option<Sheet>> {
        let plan = self.plan;
        lines::events(&report.events);
        catalogue::write(path, &report.events, &report.faults).into_diagnostic()?;
        if let Some(slow) = &report.slow_events {
            let text = catalogue::csv(slow);
            atomic::write(&path.join(catalogue::SLOW.path), text.as_bytes()).into_diagnostic()?;
        }
        let events = json::pretty(&report.events).into_diagnostic()?;
        atomic::write(&path.join("events.json"), events.as_bytes()).into_diagnostic()?;
        write_located(path, plan, report, hash)?;
        kinds::faults::write_fields(path, plan, run).into_diagnostic()?;
        kinds::faults::write_finite_faults(path, plan, run, &report.events).into_diagnostic()?;
        kinds::faults::write_stresses(path, plan, run).into_diagnostic()?;
        kinds::faults::write_bodies(path, plan, run).into_diagnostic()?;
        Ok(Some(kinds::faults::sheet(plan, run, panel(plan, report))))
    }
}

/// Fast and slow events that have a magnitude.
fn panel(plan: &Plan, report: &Report) -> EventPanel {
    let event = |entry: &Entry| {
        let tensor = entry.located.as_ref().map(|located| located.tensor);
        Some(PanelEvent { onset: entry.onset, magnitude: entry.magnitude?, tensor })
    };
    let group =
        |name: &str, entries: &[Entry]| (name.to_string(), entries.iter().filter_map(event).collect());
    let slow = report.slow_events.as_deref().unwrap_or_default();
    let groups = vec![group("events", &report.events), group("slow events", slow)];
    EventPanel { title: plan.title.clone(), start: 0.0, end: report.end, groups }
}

/// Writes the catalogue in the exchange formats of seismology, if the scene has a geographic frame.
fn write_located(path: &Path, plan: &Plan, report: &Report, hash: &str) -> miette::Result<()> {
    if plan.frame.is_none() {
        return Ok(());
    }
    let events = report.located();
    let document =
        asperity_output::formats::catalogues::quakeml(&plan.title, hash, &events).into_diagnostic()?;
    atomic::write(&path.join("events.quakeml"), &document).into_diagnostic()?;
    match asperity_output::formats::catalogues::cmtsolution(&plan.title, &events) {
        Some(text) => atomic::write(&path.join("CMTSOLUTION"), text.as_bytes()).into_diagnostic(),
        None => {
            let why = "moments need `length` in `[place]`, the length out of the plane";
            out(format_args!("  no CMTSOLUTION: {why}\n"));
            Ok(())
        }
    }
}
