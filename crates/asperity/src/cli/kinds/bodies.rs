//! Runs of bodies with interfaces.

use super::run::{Run, Where};
use crate::cli::lines;
use crate::keep::Keeper;
use crate::kinds::bodies::{Outputs, ResumeState, RunError, RunReport};
use crate::{catalogue, checkpoint, kinds};
use asperity_output::bodies::FieldSchedule;
use asperity_output::fields::Field;
use asperity_output::figures::{self, Sheet};
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_plan::bodies::AnyPlan;
use miette::IntoDiagnostic;
use std::path::Path;

/// See the module.
pub(super) struct Bodies<'a>(pub &'a AnyPlan);

impl Run for Bodies<'_> {
    type Outputs = Outputs;
    type FinalState = RunReport;
    type Report = RunReport;

    fn plan(&self) -> FieldSchedule {
        self.0.outputs()
    }

    fn reached(stand: &ResumeState) -> (f64, u64) {
        (stand.time(), stand.steps() as u64)
    }

    fn run(
        &mut self,
        out: &Path,
        keeper: &mut Keeper<Outputs>,
        from: Option<ResumeState>,
    ) -> miette::Result<RunReport> {
        match kinds::bodies::run_kept(self.0, keeper, from) {
            Err(RunError::Foreign(why)) => Err(checkpoint::foreign(out, &why.to_string())).into_diagnostic(),
            other => other.into_diagnostic(),
        }
    }

    fn report(&self, ended: &mut RunReport, _: &mut Keeper<Outputs>) -> RunReport {
        let mut report = std::mem::take(ended);
        report.warnings.splice(0..0, self.0.summary().warnings.iter().cloned());
        report
    }

    fn tables(&self, outputs: &Outputs, report: &RunReport) -> Vec<FileParts<Column>> {
        let events = report.events.as_ref().map(|events| catalogue::tables(&events.all));
        outputs.tables().into_iter().chain(events.into_iter().flatten()).collect()
    }

    fn fields(&self, outputs: &Outputs) -> Vec<FileParts<Field>> {
        outputs.fields()
    }

    fn complete(
        &self,
        (out, _): Where<'_>,
        outputs: Outputs,
        _: &RunReport,
        report: &RunReport,
    ) -> miette::Result<Option<Sheet>> {
        if let Some(events) = &report.events {
            lines::events(&events.all);
            catalogue::write(out, &events.all, &events.interfaces).into_diagnostic()?;
        }
        Ok(outputs.recorder().as_ref().map(figures::sheet))
    }
}
