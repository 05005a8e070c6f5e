//! Points in tables: positions, faults and stress drops of an event, and the fastest point through it.

use super::history::Histories;
use super::{APART, POINTS, SLIPPED};
use crate::cases::run_files::WrittenRun;
use crate::{CaseError, Evidence, Ledger};

/// Table of the points of the first event.
const TABLE: &str = "events/rupture_times_000.csv";

/// Claims positions and stress drops of the points of an event, and the fastest of them through it.
pub(super) fn claims(ledger: &mut Ledger, done: &WrittenRun, event: [f64; 2]) -> Result<(), CaseError> {
    places(ledger, done)?;
    drops(ledger, done, event)?;
    fastest(ledger, done, event)
}

/// Positions of the points.
fn places(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table(TABLE)?;
    let found = ["x", "y", "z"].map(|axis| table.column(axis)).into_iter().collect::<Result<Vec<_>, _>>()?;
    let depths: Vec<f64> = (0..POINTS).map(|k| -APART * k as f64).collect();
    ledger
        .claim("event on a fault between rocks of 10 and 40 GPa: x, y and z of its points")
        .unit("m")
        .values(&found.concat())
        .equals_each(&[vec![0.0; POINTS], depths, vec![0.0; POINTS]].concat())
        .absolute(1e-9)
        .evidence(Evidence::Exact, "cells of 250 m along y from the upper end of the fault, at x = 0")
        .because("rounding of positions of kilometres")
        .why_not_tighter("a neighbouring point is hundreds of metres away")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Falls of the shear tractions of the points that slipped; others have few rows in the event.
fn drops(ledger: &mut Ledger, done: &WrittenRun, [from, to]: [f64; 2]) -> Result<(), CaseError> {
    let table = done.files.table(TABLE)?;
    let (drops, slips) = (table.column("stress_drop")?, table.column("slip")?);
    let histories = Histories::read(&done.files, &done.files.names("stations")?)?;
    let largest = slips.iter().copied().fold(0.0, f64::max);
    let slipped: Vec<usize> = (0..POINTS).filter(|&k| slips[k] > SLIPPED * largest).collect();
    let falls: Vec<f64> = slipped.iter().map(|&k| histories.fell(k, from, to)).collect();
    let most = falls.iter().fold(0.0_f64, |m, fall| m.max(fall.abs()));
    let off = slipped.iter().zip(&falls).map(|(&k, fall)| (drops[k] - fall).abs() / most);
    ledger
        .claim("event on a fault between rocks of 10 and 40 GPa: stress drops of its points that slipped, largest error over the largest")
        .value(off.fold(0.0, f64::max))
        .at_most(1e-6)
        .evidence(Evidence::Exact, "files of stations at all points, with polynomials between rows")
        .because("polynomials through four and through six rows differ by 3e-7 at the onset, where tractions fall fast")
        .why_not_tighter("steps are up to the integrator")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Fewest points that are the fastest at some time of the event.
const FEWEST: usize = 4;

/// The point that the table of the largest slip rate names, in rows within the event.
fn fastest(ledger: &mut Ledger, done: &WrittenRun, [from, to]: [f64; 2]) -> Result<(), CaseError> {
    let table = done.files.table("largest_rate.csv")?;
    let histories = Histories::read(&done.files, &done.files.names("stations")?)?;
    let (mut named, mut worst) = (Vec::new(), 0.0_f64);
    for (time, point) in table.column("time")?.into_iter().zip(table.column("point")?) {
        if (from..=to).contains(&time) {
            let rates: Vec<f64> = (0..POINTS).map(|k| histories.rate(k, time)).collect();
            let largest = rates.iter().copied().fold(0.0, f64::max);
            worst = worst.max(1.0 - rates.get(point as usize).ok_or("no such point")? / largest);
            named.push(point as usize);
        }
    }
    named.sort_unstable();
    named.dedup();
    if named.len() < FEWEST {
        return Err(format!("only the points {named:?} are the fastest").into());
    }
    ledger
        .claim("event on a fault between rocks of 10 and 40 GPa: slip rate of the point in largest_rate.csv behind that of the fastest station, over it, largest of all rows of the event")
        .value(worst)
        .at_most(2e-4)
        .evidence(Evidence::Exact, "derivatives of cubics through rows of stations at all points, which are numbered from the upper end")
        .because("derivatives of cubics through rows at which the slip rate changes by a fifth at most, as for the slip rates at onset and end")
        .why_not_tighter("two points are as fast as each other when one overtakes the other")
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Faults of the points of an event beside a fault that creeps.
pub(super) fn faults(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table(TABLE)?;
    let names = table.words("fault")?;
    let heights = table.column("y")?;
    let of = |y: f64| if y < -9e3 { "quiet" } else { "rupture" };
    let wrong = names.iter().zip(&heights).filter(|(name, y)| **name != of(**y)).count();
    let quiet = names.iter().filter(|name| **name == "quiet").count();
    ledger
        .claim("points of the same event beside a fault that creeps: those with the name of the other fault, and missing ones")
        .count((wrong + quiet.abs_diff(2) + names.len().abs_diff(4)) as u64, 0)
        .evidence(Evidence::Exact, "the two ends of each fault, of which `quiet` lies ten kilometres and more below y = 0")
        .because("a count")
        .cost(&done.cost)
        .record();
    Ok(())
}
