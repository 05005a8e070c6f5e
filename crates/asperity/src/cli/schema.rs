//! JSON Schema of `report.json`.

use crate::kinds;
use crate::kinds::bodies::RunReport;
use crate::report::Results;
use asperity_run::report::{Kind, Report, SCHEMA, Sketch};
use schemars::generate::{SchemaGenerator, SchemaSettings};
use schemars::{JsonSchema, Schema};
use serde_json::{Value, json};

/// JSON Schema, draft 2020-12. A report is that of one kind of run, or of a run without results.
#[must_use]
pub fn schema() -> Value {
    let mut generator = SchemaSettings::draft2020_12().for_serialize().into_generator();
    let kinds = [
        report_schema::<RunReport>(&mut generator, Some(RunReport::KIND)),
        report_schema::<kinds::faults::Report>(&mut generator, Some(kinds::faults::Report::KIND)),
        report_schema::<kinds::sliders::Report>(&mut generator, Some(kinds::sliders::Report::KIND)),
        report_schema::<kinds::dynamics::Report>(&mut generator, Some(kinds::dynamics::Report::KIND)),
        report_schema::<Sketch>(&mut generator, None),
    ];
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "report.json of asperity",
        "description": "Numbers are in SI units; a number that is infinite or is none is null.",
        "oneOf": kinds,
        "$defs": generator.take_definitions(true),
    })
}

/// Schema of the report of one kind of run; it allows no other keys than those it names.
fn report_schema<R: JsonSchema>(generator: &mut SchemaGenerator, kind: Option<Kind>) -> Schema {
    let mut schema = Report::<R>::json_schema(generator);
    if let Some(Value::Object(properties)) = schema.get_mut("properties") {
        properties.insert("schema".into(), json!({ "const": SCHEMA }));
        if let Some(kind) = kind {
            properties.insert("kind".into(), json!({ "const": kind }));
        }
    }
    schema.insert("unevaluatedProperties".into(), Value::Bool(false));
    schema
}
