//! Parts shared by the targets: limits on memory, and checks of meshes that could be read.

#[path = "../../crates/fem/tests/counting/mod.rs"]
mod counting;

use asperity_fem::mesh::split::{Surface, split};
use asperity_fem::mesh::{Mesh, MeshError, Options, RawMesh};

#[global_allocator]
static ALLOCATOR: counting::CountingAllocator = counting::CountingAllocator;

/// Limit on memory in bytes per byte of a file, and for an empty file. `crates/fem/tests/memory.rs` gives the reasons;
/// here the meshes come on top.
const PER_BYTE: usize = 512;
const BASE: usize = 64 << 10;

/// Largest number of nodes and of sides of meshes that are split.
const MOST: usize = 2000;

/// Reads bytes, makes meshes of both dimensions and splits them along each side set. The result is an error or a mesh,
/// within bounded memory.
pub fn read(bytes: &[u8], parse: fn(&[u8]) -> Result<RawMesh, MeshError>) {
    let (meshes, peak) = counting::peak_of(|| {
        let raw = parse(bytes).ok()?;
        let free = Options { allow_free_parts: true, ..Options::default() };
        let plane = raw.clone().into_mesh::<2>(&free).ok();
        let space = raw.clone().into_mesh::<3>(&free).ok();
        let _ = raw.clone().into_mesh::<2>(&Options::default());
        let _ = raw.into_mesh::<3>(&Options::default());
        Some((plane, space))
    });
    assert!(peak <= BASE + PER_BYTE * bytes.len(), "{peak} bytes in use for {} of the file", bytes.len());
    if let Some((plane, space)) = meshes {
        plane.iter().for_each(split_everywhere);
        space.iter().for_each(split_everywhere);
    }
}

/// Splits along every side set alone, and along all at once.
fn split_everywhere<const D: usize>(mesh: &Mesh<D>) {
    if mesh.nodes.len() > MOST || mesh.side_sets.values().map(Vec::len).sum::<usize>() > MOST {
        return;
    }
    let surfaces: Vec<Surface<D>> =
        mesh.side_sets.keys().filter_map(|name| Surface::from_side_set(mesh, name).ok()).collect();
    surfaces.iter().for_each(|s| check_split(mesh, std::slice::from_ref(s)));
    check_split(mesh, &surfaces);
}

/// Splits a mesh and checks invariants: cells keep their positions, every node is used, tips are not split, and an
/// error leaves the mesh unchanged.
pub fn check_split<const D: usize>(mesh: &Mesh<D>, surfaces: &[Surface<D>]) {
    let mut after = mesh.clone();
    let Ok(faults) = split(&mut after, surfaces) else {
        assert!(after == *mesh, "an error changes nothing");
        return;
    };
    let mut used = vec![false; after.nodes.len()];
    for (old, new) in mesh.blocks.iter().zip(&after.blocks) {
        for (&a, &b) in old.connectivity.iter().zip(&new.connectivity) {
            used[b] = true;
            assert!(mesh.nodes[a] == after.nodes[b], "a node that moved");
        }
    }
    assert!(used[mesh.nodes.len()..].iter().all(|u| *u), "a copy that no cell uses");
    for pair in faults.iter().flat_map(|f| &f.pairs) {
        assert!(after.nodes[pair.minus] == after.nodes[pair.plus], "a pair apart");
    }
    // A second split along the same faces must not panic.
    let _ = split(&mut after, surfaces);
}
