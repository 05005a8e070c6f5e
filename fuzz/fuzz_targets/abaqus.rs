//! Fuzz target: arbitrary bytes, read as an Abaqus file, made into meshes of both dimensions and split, give an error
//! or a mesh, never a panic.
#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| asperity_fuzz::read(bytes, asperity_fem::mesh::abaqus::parse));
