//! Profiles along faults: a row for each time, and a column for each point.

use asperity_output::OutputFile;
use asperity_output::tables::column::{self, Column, Sign};

/// A profile: its file, and the unit, sign and meaning of its values.
pub(crate) struct Profile(pub OutputFile, pub &'static str, pub Sign, pub &'static str);

impl Profile {
    /// Columns of the profile, headed by the places of its points.
    pub(crate) fn columns(&self, places: impl IntoIterator<Item = String>) -> Vec<Column> {
        let Self(_, unit, sign, meaning) = *self;
        vec![column::time(), Column::each("each point", unit, sign, meaning, places)]
    }
}

/// Profile of slip.
pub(crate) const SLIP: Profile =
    Profile(OutputFile::new("slip_profiles.csv", "slip along a fault at intervals"), "m", Sign::Slip, "slip");
/// Profile of slip rates.
pub(crate) const RATE: Profile = Profile(
    OutputFile::new("rate_profiles.csv", "slip rate along a fault at intervals; logarithms are -20 at rest"),
    "log10 m/s",
    Sign::Log,
    "decadic logarithm of the slip rate",
);
