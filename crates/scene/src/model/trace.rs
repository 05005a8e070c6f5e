//! Traces of faults in the plane, in a scene or in a file.

use crate::exact_list::ExactList;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::Length;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::fmt;
use std::ops::Deref;

/// Vertices of a fault from tip to tip, `[x, y]` with y up \[m\].
#[derive(Clone, Debug, PartialEq)]
pub struct Trace {
    /// The vertices; those of a file once it has been read.
    vertices: Vec<[Length; 2]>,
    /// The file that has them.
    file: Option<TraceFile>,
}

impl Trace {
    /// The file that has the vertices.
    #[must_use]
    pub fn file(&self) -> Option<&TraceFile> {
        self.file.as_ref()
    }

    /// Sets the vertices that have been read from the file.
    pub fn fill(&mut self, vertices: Vec<[Length; 2]>) {
        self.vertices = vertices;
    }
}

impl Deref for Trace {
    type Target = [[Length; 2]];

    fn deref(&self) -> &Self::Target {
        &self.vertices
    }
}

/// Columns `x` and `y` in a CSV file.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TraceFile {
    /// Path of a CSV file with the columns `x` and `y`, relative to the folder of the scene.
    pub file: Spanned<String>,
}

shaped!(Trace as Either<Vec<[Length; 2]>, TraceFile>);

impl<'de> Deserialize<'de> for Trace {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct TraceVisitor;
        impl<'de> Visitor<'de> for TraceVisitor {
            type Value = Trace;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("vertices [[x, y], ..], or { file = \"FILE.csv\" }")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Trace, A::Error> {
                let vertices: Vec<ExactList<Length, 2>> =
                    Deserialize::deserialize(SeqAccessDeserializer::new(list))?;
                Ok(Trace { vertices: vertices.into_iter().map(|v| v.0).collect(), file: None })
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Trace, A::Error> {
                let file = TraceFile::deserialize(MapAccessDeserializer::new(map))?;
                Ok(Trace { vertices: Vec::new(), file: Some(file) })
            }
        }
        deserializer.deserialize_any(TraceVisitor)
    }
}
