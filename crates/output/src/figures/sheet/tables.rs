//! Tables of a run, read row by row as often as a figure needs them; none is held in memory as a whole.

use super::request::FigureRequest;
use crate::OutputError;
use crate::figures::cycles::{Rows, Table};
use crate::figures::rupture::Profiles;
use crate::tables::rows;
use std::path::Path;

/// Tables in the output directory of a run, within the window asked for.
pub(super) struct Tables<'a> {
    pub folder: &'a Path,
    pub request: &'a FigureRequest,
    /// True if faults are surfaces, which have no profiles.
    pub in_space: bool,
}

impl Tables<'_> {
    /// Passes the rows of a table within the window to `look`; its first column is time.
    pub(super) fn shown(&self, table: &str, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
        self.each(table, &mut |row| {
            if self.request.shows(row[0]) {
                look(row);
            }
        })
    }

    /// Passes the rows of the file of a station within the window to `look`.
    pub(super) fn station_shown(&self, path: &str, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
        rows::spaced(&self.folder.join(path), &mut |row| {
            if self.request.shows(row[0]) {
                look(row);
            }
        })
    }

    /// Passes all rows of a table to `look`.
    pub(super) fn each(&self, table: &str, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
        rows::each(&self.folder.join(table), look)
    }
}

impl Rows for Tables<'_> {
    fn each(&self, table: Table, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
        let name = match table {
            Table::Largest => "largest_rate.csv",
            Table::Slip => "slip_profiles.csv",
            Table::Rate => "rate_profiles.csv",
            Table::State => "state_profiles.csv",
            Table::Coupling => "coupling_profiles.csv",
        };
        if self.in_space && table != Table::Largest {
            return Ok(());
        }
        self.shown(name, look)
    }

    fn station(&self, path: &str, look: &mut dyn FnMut(&[f64])) -> Result<(), OutputError> {
        rows::spaced(&self.folder.join(path), look)
    }
}

impl Profiles for Tables<'_> {
    fn each(&self, look: &mut dyn FnMut(f64, &[f64])) -> Result<(), OutputError> {
        // The table has logarithms.
        self.shown("rate_profiles.csv", &mut |row| {
            let rates: Vec<f64> = row[1..].iter().map(|log| 10_f64.powf(*log)).collect();
            look(row[0], &rates);
        })
    }
}
