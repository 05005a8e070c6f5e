//! `report.json`: reproducible results at the top, machine-dependent ones under `run`. Its schema is
//! `docs/src/verification.schema.json`.

use super::ids;
use super::provenance::Provenance;
use crate::case::Outcome;
use crate::claim::JudgedClaim;
use crate::ledger::Table;
use crate::suite::Summary;
use asperity_output::figures::Diagram;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Version of the format of `report.json`.
pub const SCHEMA: u32 = 2;

/// Report of a run of the suite.
#[derive(Debug, Serialize, JsonSchema)]
#[schemars(title = "Report of the verification suite")]
pub struct Report<'a> {
    /// Version of the format.
    pub schema: u32,
    /// Counts of all claims.
    pub summary: Summary,
    /// Cases in the order in which they ran.
    pub cases: Vec<CaseReport<'a>>,
    /// Values that depend on the machine.
    pub run: Run<'a>,
}

/// A case.
#[derive(Debug, Serialize, JsonSchema)]
pub struct CaseReport<'a> {
    /// Name.
    pub name: &'a str,
    /// True if it belongs to the quick suite.
    pub quick: bool,
    /// Counts of its claims.
    pub summary: Summary,
    /// Claims.
    pub claims: Vec<ClaimReport<'a>>,
}

/// A claim with its name.
#[derive(Debug, Serialize, JsonSchema)]
pub struct ClaimReport<'a> {
    /// Name, which is its permalink on the page of the case and its key in the history.
    pub id: String,
    /// The judged claim.
    #[serde(flatten)]
    pub judged: &'a JudgedClaim,
}

/// Values that depend on the machine.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Run<'a> {
    /// Provenance.
    #[serde(flatten)]
    pub provenance: &'a Provenance,
    /// Wall times, and diagrams, tables and notes that may contain them, by case.
    pub walls: BTreeMap<&'a str, Walls<'a>>,
}

/// Wall times of a case, and diagrams, tables and notes that may contain them.
#[derive(Debug, Serialize, JsonSchema)]
pub struct Walls<'a> {
    /// Wall time of the case \[s\].
    pub case: f64,
    /// Wall times of the runs behind its claims, in the order of the claims \[s\].
    pub claims: Vec<Option<f64>>,
    /// Diagrams.
    pub plots: &'a [Diagram],
    /// Tables.
    pub tables: &'a [Table],
    /// Notes.
    pub notes: &'a [String],
}

/// The report of a run.
pub fn report<'a>(outcomes: &'a [Outcome], run: &'a Provenance) -> Report<'a> {
    let walls = outcomes.iter().map(|outcome| (outcome.case.name, walls(outcome))).collect();
    Report {
        schema: SCHEMA,
        summary: Summary::from_outcomes(outcomes),
        cases: outcomes.iter().map(case).collect(),
        run: Run { provenance: run, walls },
    }
}

/// A case of the report.
pub fn case(outcome: &Outcome) -> CaseReport<'_> {
    let claims = &outcome.record.claims;
    let named = ids::unique(claims).into_iter().zip(claims);
    CaseReport {
        name: outcome.case.name,
        quick: outcome.case.quick,
        summary: Summary::from_claims(claims),
        claims: named.map(|(id, judged)| ClaimReport { id, judged }).collect(),
    }
}

fn walls(outcome: &Outcome) -> Walls<'_> {
    let record = &outcome.record;
    Walls {
        case: outcome.wall,
        claims: record.claims.iter().map(|judged| judged.claim.cost.wall).collect(),
        plots: &record.plots,
        tables: &record.tables,
        notes: &record.notes,
    }
}

/// The published schema of the report.
pub fn schema() -> Value {
    json!(schemars::schema_for!(Report<'static>))
}
