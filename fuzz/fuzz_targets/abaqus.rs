//! Any bytes, read as a mesh and made into meshes of both dimensions: an error or a mesh, never a panic.
#![no_main]

use asperity_fem::mesh::{Options, abaqus};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    if let Ok(raw) = abaqus::parse(bytes) {
        let _ = raw.clone().into_mesh::<2>(&Options::default());
        let _ = raw.into_mesh::<3>(&Options::default());
    }
});
