//! Fuzz target: blocks of every element, split along arbitrary faces, give an error or a consistent mesh, never a panic.
#![no_main]

use asperity_fem::element::ElementKind;
use asperity_fem::mesh::generate::{Block, Grading};
use asperity_fem::mesh::split::Surface;
use asperity_fem::mesh::{Side, face_nodes};

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
    let Some((&[kind, nx, ny, nz], picks)) = bytes.split_first_chunk::<4>() else {
        return;
    };
    let kind = ElementKind::ALL[usize::from(kind) % ElementKind::ALL.len()];
    let divisions = [nx, ny, nz].map(|n| 1 + usize::from(n) % 4);
    if kind.dimension() == 2 {
        run::<2>(kind, [divisions[0], divisions[1]], picks);
    } else {
        run::<3>(kind, divisions, picks);
    }
});

/// Splits a block along faces of three bytes each: cell, face of the cell, and flags. The flags hold the surface (two
/// bits), reversed node order (one bit) and the presence of a direction towards plus (the rest).
fn run<const D: usize>(kind: ElementKind, divisions: [usize; D], picks: &[u8]) {
    let block = Block { min: [0.0; D], max: [1.0; D], divisions, grading: [Grading::Uniform; D], kind };
    let Ok(mesh) = block.mesh() else {
        return;
    };
    let mut surfaces: Vec<Surface<D>> = (0..4)
        .map(|s| Surface { name: s.to_string(), faces: Vec::new(), towards_plus: None })
        .collect();
    for pick in picks.chunks_exact(3) {
        let cell = usize::from(pick[0]) % mesh.blocks[0].len();
        let face = usize::from(pick[1]) % kind.faces().len();
        let mut nodes = face_nodes(&mesh, &Side { block: 0, cell, face });
        if pick[2] & 4 != 0 {
            nodes.truncate(kind.linear().faces()[face].len());
            nodes.reverse();
        }
        let surface = &mut surfaces[usize::from(pick[2] & 3)];
        surface.faces.push(nodes);
        let toward = usize::from(pick[2] >> 3);
        if toward > 0 {
            surface.towards_plus =
                Some(std::array::from_fn(|c| if toward % D == c { 1.0 } else { toward as f64 / 31.0 - 0.5 }));
        }
    }
    surfaces.retain(|s| !s.faces.is_empty());
    asperity_fuzz::check_split(&mesh, &surfaces);
}
