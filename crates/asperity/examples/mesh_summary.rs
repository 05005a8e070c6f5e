//! Prints the content of mesh files as their readers understand it, as JSON for other programs to compare (`interop/check_meshes.py`).
//!
//! `mesh_summary OUT FILE...` writes to OUT an object with an entry for each file name: `nodes`, their number; `cells`, by element the
//! positions of the nodes of each cell in the order of VTK; `cell_sets`, `side_sets`, `node_sets`, by name the number of cells,
//! of faces (one between two cells counts once) and of nodes.
// A program for the terminal.
#![allow(clippy::print_stderr, clippy::disallowed_methods)]

use asperity_fem::mesh::{Cells, Mesh, MeshError, Options, RawMesh, abaqus, face_nodes, gmsh};
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;
use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((out, files)) = arguments.split_first() else {
        eprintln!("mesh_summary OUT FILE...");
        return ExitCode::FAILURE;
    };
    let mut all = Map::new();
    for file in files {
        let name = Path::new(file).file_name().map_or_else(String::new, |n| n.to_string_lossy().into_owned());
        match read(file) {
            Ok(summary) => drop(all.insert(name, summary)),
            Err(message) => {
                eprintln!("{file}: {message}");
                return ExitCode::FAILURE;
            }
        }
    }
    if let Err(error) = std::fs::write(out, Value::Object(all).to_string()) {
        eprintln!("{out}: {error}");
        return ExitCode::FAILURE;
    }
    ExitCode::SUCCESS
}

fn read(file: &str) -> Result<Value, String> {
    let bytes = std::fs::read(file).map_err(|e| e.to_string())?;
    let parse = if file.ends_with(".inp") { abaqus::parse } else { gmsh::parse };
    let raw = parse(&bytes).map_err(|e| e.to_string())?;
    let summary = |raw: RawMesh| -> Result<Value, MeshError> {
        let options = Options { allow_free_parts: true, ..Options::default() };
        Ok(match raw.dimension() {
            2 => summary(&raw.into_mesh::<2>(&options)?),
            _ => summary(&raw.into_mesh::<3>(&options)?),
        })
    };
    summary(raw).map_err(|e| e.to_string())
}

fn summary<const D: usize>(mesh: &Mesh<D>) -> Value {
    let mut cells = Map::new();
    for block in &mesh.blocks {
        let list = cells.entry(block.kind.name()).or_insert_with(|| json!([]));
        for cell in 0..block.len() {
            let nodes: Vec<&[f64]> = block.cell(cell).iter().map(|&n| mesh.nodes[n].as_slice()).collect();
            list.as_array_mut().into_iter().for_each(|list| list.push(json!(nodes)));
        }
    }
    let count = |blocks: &Vec<usize>| blocks.iter().map(|&b| Cells::len(&mesh.blocks[b])).sum::<usize>();
    let faces = |sides: &Vec<asperity_fem::mesh::Side>| {
        let sorted = sides.iter().map(|side| {
            let mut nodes = face_nodes(mesh, side);
            nodes.sort_unstable();
            nodes
        });
        sorted.collect::<BTreeSet<_>>().len()
    };
    json!({
        "nodes": mesh.nodes.len(),
        "cells": cells,
        "cell_sets": mesh.cell_sets.iter().map(|(k, v)| (k.clone(), json!(count(v)))).collect::<Map<_, _>>(),
        "side_sets": mesh.side_sets.iter().map(|(k, v)| (k.clone(), json!(faces(v)))).collect::<Map<_, _>>(),
        "node_sets": mesh.node_sets.iter().map(|(k, v)| (k.clone(), json!(v.len()))).collect::<Map<_, _>>(),
    })
}
