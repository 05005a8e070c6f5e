//! JSON Schema of scenes. Values of TOML are treated as values of JSON.

use super::model::Scene;
use super::slider::SliderScene;
use schemars::{Schema, generate::SchemaSettings};

/// Schema of scenes of both kinds: bodies with interfaces or faults, and spring-sliders.
#[must_use]
pub fn schema() -> Schema {
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    let kinds = [generator.subschema_for::<Scene>(), generator.subschema_for::<SliderScene>()];
    let definitions = generator.take_definitions(true);
    schemars::json_schema!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Scene of asperity",
        "anyOf": kinds,
        "$defs": definitions,
    })
}
