//! Runs of bodies with mass.

use super::run::{Run, Where};
use crate::keep::Keeper;
use crate::kinds::dynamics::{FinalState, Outputs, Report, ResumeState, RunError};
use crate::{checkpoint, kinds};
use asperity_output::fields::Field;
use asperity_output::figures::Sheet;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use asperity_plan::dynamics::Plan;
use miette::IntoDiagnostic;
use std::path::Path;

/// See the module.
pub(super) struct Dynamics<'a, const D: usize>(pub &'a Plan<D>);

impl<'a, const D: usize> Run for Dynamics<'a, D> {
    type Outputs = Outputs<'a, D>;
    type FinalState = FinalState;
    type Report = Report;

    fn plan(&self) -> &'a Plan<D> {
        self.0
    }

    fn reached(stand: &ResumeState) -> (f64, u64) {
        (stand.state.time(), stand.state.steps() as u64)
    }

    fn run(
        &mut self,
        out: &Path,
        keeper: &mut Keeper<Self::Outputs>,
        from: Option<ResumeState>,
    ) -> miette::Result<FinalState> {
        match kinds::dynamics::run(self.0, keeper, from) {
            Err(RunError::Foreign) => {
                Err(checkpoint::foreign(out, "its unknowns differ from those of this scene"))
                    .into_diagnostic()
            }
            other => other.into_diagnostic(),
        }
    }

    fn report(&self, ended: &mut FinalState, _: &mut Keeper<Self::Outputs>) -> Report {
        Report::new(self.0, ended)
    }

    fn tables(&self, _: &Self::Outputs, _: &Report) -> Vec<FileParts<Column>> {
        kinds::dynamics::tables(self.0)
    }

    fn fields(&self, outputs: &Self::Outputs) -> Vec<FileParts<Field>> {
        outputs.fields()
    }

    fn complete(
        &self,
        (out, _): Where<'_>,
        outputs: Self::Outputs,
        ended: &FinalState,
        _: &Report,
    ) -> miette::Result<Option<Sheet>> {
        outputs.complete(out, ended).map(Some).into_diagnostic()
    }
}
