//! Displacement of the free surface along a line through a run, as tables of profiles.

use super::profiles::SELDOM;
use super::rows::{self, Table};
use asperity_cycles::Moment;
use asperity_output::OutputFile;
use asperity_output::decimals::scientific;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_plan::faults::{Plan, Receivers};

/// The tables, with the axis of the displacement in their names.
pub(super) const FILE: OutputFile =
    OutputFile::new("surface_profiles_*.csv", "displacement of the free surface along a line at intervals");

/// Positions that are followed through time.
pub(super) fn followed(plan: &Plan) -> Option<&Receivers> {
    plan.free_surface.as_ref()?.through.as_ref()
}

/// The tables, if there is such a line: a column for each position along x.
pub(super) fn tables(plan: &Plan) -> impl Iterator<Item = Table<'_>> {
    followed(plan).into_iter().flat_map(|line| {
        line.axes.iter().map(move |&axis| {
            let row = move |now: &Moment<'_>| {
                let moved = line.all.iter().map(|position| position.moves(&line.rates, now)[0][axis]);
                rows::line(now.at.seconds(), moved.map(|u| scientific(u, 9)))
            };
            let places = line.all.iter().map(|position| position.at[0].to_string());
            let moved =
                Column::each("each position", "m", Sign::Axis, "displacement of the free surface", places);
            Table::new(FILE.named(["x", "y", "z"][axis]), vec![column::time(), moved], SELDOM, row)
        })
    })
}
