//! Displacement of the free surface along a line through a run, as tables of profiles.

use super::profiles::SELDOM;
use super::rows::{self, Table};
use asperity_cycles::Moment;
use asperity_output::decimals::scientific;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_plan::faults::{Plan, Receivers};

/// Names of the tables, by the axis of the displacement.
pub(super) const NAMES: [&str; 3] =
    ["surface_profiles_x.csv", "surface_profiles_y.csv", "surface_profiles_z.csv"];

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
            Table::new(NAMES[axis], vec![column::time(), moved], SELDOM, row)
        })
    })
}
