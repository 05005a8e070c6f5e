//! Mesh readers on damaged bytes: an error or a mesh, never a panic.
#![allow(clippy::disallowed_methods)]

use asperity_fem::mesh::{Options, RawMesh, abaqus, gmsh};
use proptest::prelude::*;

/// Files of all formats and codings.
const SAMPLES: [&str; 10] = [
    "good_2d_quad4_shared_v22.msh",
    "good_2d_quad4_split_nonmatching_ascii.msh",
    "good_3d_hex8_shared_ascii.msh",
    "good_3d_tet10_shared_binary.msh",
    "unit_quad9_v22_binary.msh",
    "unit_wedge15_v22_binary.msh",
    "unit_partitioned_binary.msh",
    "unit_parametric_v22.msh",
    "unit_hex20.inp",
    "unit_tet10.inp",
];

fn sample(name: &str) -> Vec<u8> {
    std::fs::read(format!("{}/tests/meshes/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

/// Bytes kept for each byte of a file, at most: an entry of a list takes at least two bytes of text, and at most 32 in memory.
const KEPT: usize = 16;

fn kept(raw: &RawMesh) -> usize {
    let blocks: usize = raw.blocks.iter().map(|b| 8 * (b.tags.capacity() + b.nodes.capacity())).sum();
    32 * raw.nodes.capacity() + blocks
}

/// Reads bytes as each format, and makes meshes from the results.
fn read(bytes: &[u8]) {
    for raw in [gmsh::parse(bytes), abaqus::parse(bytes)].into_iter().flatten() {
        // Vectors that grow by doubling hold up to twice the memory they need.
        assert!(kept(&raw) <= 2 * KEPT * bytes.len() + 4096, "{} of {}", kept(&raw), bytes.len());
        let _ = raw.clone().into_mesh::<2>(&Options::default());
        let _ = raw.into_mesh::<3>(&Options::default());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_are_no_panic(bytes in prop::collection::vec(any::<u8>(), 0..400), binary: bool, v41: bool) {
        read(&bytes);
        let version = if v41 { "4.1" } else { "2.2" };
        let mut file = format!("$MeshFormat\n{version} {} 8\n", u8::from(binary)).into_bytes();
        if binary {
            file.extend([1, 0, 0, 0]);
        }
        file.extend(b"\n$EndMeshFormat\n$Nodes\n");
        file.extend(&bytes);
        read(&file);
    }

    #[test]
    fn truncated_samples_are_no_panic(which in 0..SAMPLES.len(), part in 0.0..1.0) {
        let bytes = sample(SAMPLES[which]);
        read(&bytes[..(part * bytes.len() as f64) as usize]);
    }

    #[test]
    fn mutated_samples_are_no_panic(
        which in 0..SAMPLES.len(),
        changes in prop::collection::vec((0.0..1.0, any::<u8>(), 0..3), 1..12),
    ) {
        let mut bytes = sample(SAMPLES[which]);
        for (part, value, kind) in changes {
            let at = (part * bytes.len() as f64) as usize;
            match kind {
                0 => bytes[at] = value,
                1 => bytes.insert(at, value),
                // Digits keep a text readable for longer than other bytes.
                _ => bytes[at] = b'0' + value % 10,
            }
        }
        read(&bytes);
    }
}
