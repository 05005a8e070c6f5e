//! `report.json`: everything reproducible at the top, everything that depends on the machine under `run`.

use super::provenance::Provenance;
use crate::case::Outcome;
use crate::suite::Summary;
use serde_json::{Map, Value, json};

/// Version of the format of `report.json`.
pub const SCHEMA: u32 = 1;

/// The report as a value.
pub fn report(outcomes: &[Outcome], run: &Provenance) -> Value {
    let cases: Vec<Value> = outcomes.iter().map(case).collect();
    let walls: Map<String, Value> = outcomes.iter().map(|o| (o.case.name.to_owned(), walls(o))).collect();
    let mut run = json!(run);
    run["walls"] = Value::Object(walls);
    json!({ "schema": SCHEMA, "summary": Summary::of_all(outcomes), "cases": cases, "run": run })
}

fn case(outcome: &Outcome) -> Value {
    let record = &outcome.record;
    json!({
        "name": outcome.case.name,
        "quick": outcome.case.quick,
        "summary": Summary::of(&record.claims),
        "claims": record.claims,
    })
}

/// Wall times, and what may contain them: plots, tables and notes.
fn walls(outcome: &Outcome) -> Value {
    let record = &outcome.record;
    let claims: Vec<Option<f64>> = record.claims.iter().map(|judged| judged.claim.cost.wall).collect();
    json!({
        "case": outcome.wall,
        "claims": claims,
        "plots": record.plots,
        "tables": record.tables,
        "notes": record.notes,
    })
}
