//! Output files in formats of other communities: SEAS stations and VTK fields.

mod axes;
mod contact;
mod faults;
mod fields;
mod mixed;
mod states;
pub(super) mod vtu;

use crate::cases::run_files::{Folder, WrittenRun};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};
use vtu::Fields;

/// See the README.
pub const CASE: Case = Case {
    name: "output_files",
    readme: include_str!("README.md"),
    covers: &[Capability::FaultCycles, Capability::Antiplane, Capability::Outputs],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    stations(ledger)?;
    fields::claims(ledger)?;
    contact::claims(ledger)?;
    axes::claims(ledger)?;
    faults::claims(ledger)?;
    states::claims(ledger)?;
    mixed::claims(ledger)
}

/// Station files, and distance along the fault of the points nearest to the requested stations \[km\].
const STATIONS: [(&str, f64); 4] =
    [("main_dp002", 0.0), ("main_dp021", 2.0), ("main_dp047", 4.5), ("main_dp066", 6.5)];
/// a, b, reference friction, reference slip rate \[m/s\], characteristic slip distance \[m\].
const LAW: [f64; 5] = [0.015, 0.02, 0.6, 1e-6, 0.04];
/// Slip rate at the start \[m/s\].
const RATE: f64 = 1e-9;

/// Traction along z on the fault \[Pa\]: its normal from left to right is (4/5, 3/5), and the stress yz = 10 MPa, zx =
/// 25 MPa.
const RESOLVED: f64 = 25e6 * 0.8 + 10e6 * 0.6;

/// log10 of the state \[s\] at which friction balances the resolved traction, under this normal traction \[Pa\] and at
/// slip rate [`RATE`].
fn state(normal: f64) -> f64 {
    let [a, b, mu0, v_ref, l] = LAW;
    // f = a asinh(V/(2 V0) exp((mu0 + b ln(V0 theta/L))/a)).
    let potential = a * (2.0 * v_ref / RATE * (RESOLVED / (normal * a)).sinh()).ln();
    ((potential - mu0) / b).exp().log10() + (l / v_ref).log10()
}

/// Claims about the first rows of stations.
fn stations(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = WrittenRun::from_text(include_str!("station.toml"))?;
    let normal = |along: f64| 40e6 + 2e6 * along;
    for (name, unit, expected, source, because) in [
        (
            "normal_stress",
            "MPa",
            STATIONS.map(|(_, along)| normal(along) / 1e6),
            "linear along the fault; points are 0.5 km apart, and the nearest counts",
            "the file has ten digits",
        ),
        (
            "shear_stress",
            "MPa",
            [RESOLVED / 1e6; 4],
            "zx n_x + yz n_y of the uniform stress, n = (4/5, 3/5)",
            "the file has ten digits",
        ),
        ("slip_rate", "log10 m/s", [RATE.log10(); 4], "the rate of the scene", "the file has nine decimals"),
        (
            "state",
            "log10 s",
            STATIONS.map(|(_, along)| state(normal(along))),
            "theta of the regularised law under the resolved traction, by the inverse of asinh",
            "the file has nine decimals",
        ),
        ("slip", "m", [0.0; 4], "nothing has slipped", "exact"),
    ] {
        let mut found = Vec::new();
        for (file, _) in STATIONS {
            let column = done.files.table(&format!("stations/{file}"))?.column(name)?;
            found.push(*column.first().ok_or("no row")?);
        }
        ledger
            .claim(format!("four stations on an inclined fault under initial stress, first rows: {name}"))
            .unit(unit)
            .values(&found)
            .equals_each(&expected)
            .absolute(1e-8)
            .evidence(Evidence::Exact, source)
            .because(because)
            .why_not_tighter("the last digit may be off by a half; a neighbouring point differs by percents")
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// A number in a file, and its value in closed form.
type ExpectedNumber<'a> = (&'a str, &'a str, f64);

/// Claims about the last numbers in the files of a run.
struct FileClaims<'a> {
    /// The problem.
    title: &'a str,
    /// Largest relative error.
    bound: f64,
    /// Reference, reason for the bound, and why it is not tighter.
    source: &'a str,
    because: &'a str,
    slack: &'a str,
    covers: &'a [Capability],
}

impl FileClaims<'_> {
    fn claim(
        &self,
        ledger: &mut Ledger,
        (files, cost): (&Folder, &Cost),
        wanted: &[ExpectedNumber<'_>],
    ) -> Result<(), CaseError> {
        for &(file, column, value) in wanted {
            ledger
                .claim(format!("{}, at the end: {column} in {file}", self.title))
                .value(last(files, file, column)?)
                .equals(value)
                .relative(self.bound)
                .evidence(Evidence::Exact, self.source)
                .because(self.because)
                .why_not_tighter(self.slack)
                .covers(self.covers)
                .cost(cost)
                .record();
        }
        Ok(())
    }
}

/// The last number of a column of a table, or of an array, in the last of the files of a name.
fn last(files: &Folder, file: &str, column: &str) -> Result<f64, CaseError> {
    let (folder, pattern) = file.split_once('/').unwrap_or((".", file));
    let start = pattern.split(['*', '.']).next().unwrap_or_default();
    let names = files.names(folder)?;
    let name = names.iter().rfind(|name| name.starts_with(start)).ok_or_else(|| format!("no {file}"))?;
    let path = format!("{folder}/{name}");
    let values = if name.ends_with("vtu") {
        Fields::read(&files.text(&path)?)?.array(column)?.values.clone()
    } else if column == "each point" {
        files.table(&path)?.numbers().pop().ok_or("no row")?
    } else {
        files.table(&path)?.column(column)?
    };
    values.last().copied().ok_or_else(|| format!("{file} has no {column}").into())
}
