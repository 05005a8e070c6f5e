//! JSON Schema of scenes, as values of TOML are values of JSON.

use super::model::Scene;
use super::slider::SliderScene;
use schemars::{Schema, generate::SchemaSettings};

/// The schema of scenes: of bodies with interfaces or faults, or of spring-sliders.
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
