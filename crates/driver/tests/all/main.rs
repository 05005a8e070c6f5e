//! Tests of the driver, in one binary: each binary would link all crates, which takes longer than to run most tests.
#![allow(clippy::unwrap_used)]

mod antiplane;

mod bodies;
mod cite;
mod column_tables;
mod command;
mod common;
mod compare;
mod directories;
mod documents;
mod doubtful_scenes;
mod dynamic;
mod enforcement;
mod fault;
mod fault_geometry;
mod fault_heat;
mod fault_normal;
mod fault_opening;
mod fault_outputs;
mod instability;
mod interface_signs;
mod key_tables;
mod law_tables;
mod laws;
mod loads;
mod located;
mod medium;
mod memory;
mod mesh_files;
mod meshes;
mod messages;
mod names;
mod report_schema;
mod resume;
mod resume_bodies;
mod resume_sliders;
mod samples;
mod scene_schema;
mod scenes;
mod signs;
mod slider;
mod slider_outputs;
mod snapshot;
mod solvers;
mod springs;
