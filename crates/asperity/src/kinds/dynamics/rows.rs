//! Tables of a run of bodies with mass, and when their rows are due.

use super::run::Dynamics;
use crate::keep;

/// Steps after which rows are due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Course {
    /// Those between rows; the energies are known then.
    Rows,
    /// Those between profiles.
    Profiles,
}

/// A table of a run of bodies with mass.
pub(super) type Table<'a> = keep::Table<'a, Dynamics, Course>;
