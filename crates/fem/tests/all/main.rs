//! Tests of finite elements, in one binary; `memory` counts allocations in a separate one.
#![allow(clippy::unwrap_used)]

mod abaqus;
mod assembly;
mod byte_order;
mod condense;
mod direct;
mod extrude;
mod fault_mesh;
mod finite;
mod flat_fault;
mod gmsh;
mod iterative;
mod jump;
mod lab;
mod maxwell;
mod mesh_bytes;
mod plasticity;
mod reading;
mod sheet;
mod split;
mod symmetry;
mod tangents;
