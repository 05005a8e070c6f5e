//! Columns of files, and types of values in reports, of which kinds of run have the same name.

use super::KindRun;
use crate::{Capability, CaseError, Evidence, Ledger};
use serde_json::Value;

/// Tables that at least two of the runs in the plane write.
const TABLES: [&str; 6] = [
    "rate_profiles.csv",
    "slip_profiles.csv",
    "moment_rate.csv",
    "stations/main_dp000",
    "points/tip.csv",
    "energy.csv",
];

/// Tables that at least two of the runs in space write.
const IN_SPACE: [&str; 3] = ["moment_rate.csv", "stations/main_000", "points/tip.csv"];

/// First columns of every catalogue.
const CATALOGUE: [&str; 7] = [
    "onset [s]",
    "duration [s]",
    "interval [s]",
    "peak_rate [m/s]",
    "stress_drop [Pa]",
    "surface",
    "end [s]",
];

pub(super) fn claims(ledger: &mut Ledger, all: &[KindRun]) -> Result<(), CaseError> {
    tables(ledger, all, "", &TABLES)?;
    catalogues(ledger, all)?;
    reports(ledger, all, "")
}

/// Claims of the runs in space, of which one has a catalogue.
pub(super) fn in_space(ledger: &mut Ledger, all: &[KindRun]) -> Result<(), CaseError> {
    tables(ledger, all, " in space", &IN_SPACE)?;
    reports(ledger, all, " in space")
}

fn tables(ledger: &mut Ledger, all: &[KindRun], place: &str, names: &[&str]) -> Result<(), CaseError> {
    for table in names {
        let heads: Vec<Vec<String>> =
            all.iter().filter_map(|ran| Some(ran.files.table(table).ok()?.head().to_vec())).collect();
        if heads.len() < 2 {
            return Err(format!("{} kinds of run{place} write {table}", heads.len()).into());
        }
        let differ = heads.windows(2).filter(|pair| pair[0] != pair[1]).count();
        counted(ledger, &format!("kinds of run{place} whose {table} has other columns or units"), differ);
    }
    Ok(())
}

fn catalogues(ledger: &mut Ledger, all: &[KindRun]) -> Result<(), CaseError> {
    let heads: Vec<Vec<String>> =
        all.iter().filter_map(|ran| Some(ran.files.table("events.csv").ok()?.head().to_vec())).collect();
    if heads.len() < 2 {
        return Err("fewer than two kinds of run write events.csv".into());
    }
    let differ = heads
        .iter()
        .filter(|head| !head.iter().map(String::as_str).take(CATALOGUE.len()).eq(CATALOGUE))
        .count();
    counted(ledger, "catalogues whose first columns are others", differ);
    Ok(())
}

fn reports(ledger: &mut Ledger, all: &[KindRun], place: &str) -> Result<(), CaseError> {
    let mut differ = Vec::new();
    for (k, one) in all.iter().enumerate() {
        for other in &all[..k] {
            compare("", &one.report, &other.report, &mut differ);
        }
    }
    differ.sort();
    differ.dedup();
    let names = if differ.is_empty() { String::new() } else { format!(": {}", differ.join(", ")) };
    counted(ledger, &format!("keys of reports{place} whose values have several types{names}"), differ.len());
    for key in ["counts", "warnings", "checks", "outcome"] {
        let without = all.iter().filter(|ran| ran.report[key].is_null()).count();
        counted(ledger, &format!("kinds of run{place} whose report has no `{key}`"), without);
    }
    Ok(())
}

/// Adds the keys at which values that both have are of different types.
fn compare(place: &str, one: &Value, other: &Value, differ: &mut Vec<String>) {
    match (one, other) {
        (Value::Null, _) | (_, Value::Null) => {}
        (Value::Object(one), Value::Object(other)) => {
            for (key, value) in one {
                let at = format!("{place}/{key}");
                other.get(key).into_iter().for_each(|other| compare(&at, value, other, differ));
            }
        }
        (Value::Array(one), Value::Array(other)) => {
            if let Some((one, other)) = one.first().zip(other.first()) {
                compare(place, one, other, differ);
            }
        }
        _ if std::mem::discriminant(one) == std::mem::discriminant(other) => {}
        // Outcomes with details are objects, others words.
        _ if place == "/outcome" => {}
        _ => differ.push(place.to_owned()),
    }
}

fn counted(ledger: &mut Ledger, name: &str, found: usize) {
    ledger
        .claim(name)
        .count(found as u64, 0)
        .evidence(Evidence::Exact, "one name has one meaning")
        .because("who has read the files of one kind of run reads those of another")
        .covers(&[Capability::Outputs])
        .record();
}
