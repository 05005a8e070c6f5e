//! Kinds of run as the path from a plan to a report sees them.

use crate::keep::{Keeper, Outputs, ResumeState};
use crate::report::Results;
use asperity_output::fields::Field;
use asperity_output::figures::Sheet;
use asperity_output::tables::Column;
use asperity_output::tables::describe::FileParts;
use std::path::Path;

/// A planned run of one kind: its steps, its report and its files.
pub(super) trait Run {
    type Outputs: Outputs;
    /// State at the end.
    type FinalState;
    type Report: Results;

    /// The plan, as the outputs refer to it.
    fn plan(&self) -> <Self::Outputs as Outputs>::Plan;

    /// Time \[s\] and number of steps of a state.
    fn reached(stand: &ResumeState<Self::Outputs>) -> (f64, u64);

    /// Takes the steps, from the start or from a saved state.
    fn run(
        &mut self,
        out: &Path,
        keeper: &mut Keeper<Self::Outputs>,
        from: Option<ResumeState<Self::Outputs>>,
    ) -> miette::Result<Self::FinalState>;

    /// Report of the run.
    fn report(&self, ended: &mut Self::FinalState, keeper: &mut Keeper<Self::Outputs>) -> Self::Report;

    /// Tables that the run may have written, by their paths below its directory, with their columns. `*` in a path represents any text.
    fn tables(&self, outputs: &Self::Outputs, report: &Self::Report) -> Vec<FileParts<Column>>;

    /// Fields that the run may have written, by the paths of their files. There are none by default.
    fn fields(&self, _: &Self::Outputs) -> Vec<FileParts<Field>> {
        Vec::new()
    }

    /// Writes the files of the end, and returns the figures.
    fn complete(
        &self,
        place: Where<'_>,
        outputs: Self::Outputs,
        ended: &Self::FinalState,
        report: &Self::Report,
    ) -> miette::Result<Option<Sheet>>;
}

/// Directory of a run, and SHA-256 of its scene.
pub(super) type Where<'a> = (&'a Path, &'a str);
