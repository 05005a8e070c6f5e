//! Runs of spring-sliders.

use super::run::{Run, Where};
use crate::catalogue;
use crate::cli::lines;
use crate::keep::Keeper;
use crate::kinds::sliders::{Histories, Outputs, Report, columns, csv};
use asperity_cycles::slider::{Problem, SliderRun, resume};
use asperity_output::atomic;
use asperity_output::figures::Sheet;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_plan::sliders::Plan;
use asperity_run::report::Outcome;
use miette::IntoDiagnostic;
use std::path::Path;

/// See the module.
pub(super) struct Sliders<'a>(pub &'a Plan);

impl<'a> Run for Sliders<'a> {
    type Outputs = Outputs<'a>;
    type FinalState = SliderRun;
    type Report = Report;

    fn plan(&self) -> &'a Problem {
        &self.0.problem
    }

    fn reached(run: &SliderRun) -> (f64, u64) {
        (run.at.seconds(), run.counts.steps)
    }

    fn run(
        &mut self,
        _: &Path,
        keeper: &mut Keeper<Self::Outputs>,
        from: Option<SliderRun>,
    ) -> miette::Result<SliderRun> {
        let problem = &self.0.problem;
        resume(problem, from.unwrap_or_else(|| SliderRun::new(problem)), keeper).into_diagnostic()
    }

    fn report(&self, run: &mut SliderRun, keeper: &mut Keeper<Self::Outputs>) -> Report {
        let Plan { problem, warnings, checks, .. } = self.0;
        let mut report = Report::new(problem, run);
        report.warnings.splice(0..0, warnings.iter().cloned());
        report.checks.clone_from(checks);
        if let Some(why) = keeper.interrupted() {
            report.outcome = Outcome::Interrupted { stage: None, time: report.end, reason: why.into() };
        }
        report
    }

    fn tables(&self, _: &Self::Outputs, report: &Report) -> Vec<FileParts<Column>> {
        let events = FileParts::new(catalogue::FILE.path, columns(&report.events));
        Histories::tables(&self.0.problem).into_iter().chain([events]).collect()
    }

    fn complete(
        &self,
        (out, _): Where<'_>,
        outputs: Self::Outputs,
        _: &SliderRun,
        report: &Report,
    ) -> miette::Result<Option<Sheet>> {
        let histories = outputs.complete().into_diagnostic()?;
        if self.0.problem.events.is_some() {
            lines::events(&report.events);
            atomic::write(&out.join(catalogue::FILE.path), csv(&report.events).as_bytes())
                .into_diagnostic()?;
        }
        Ok(Some(histories.sheet(&self.0.problem, &self.0.thetas, report.end)))
    }
}
