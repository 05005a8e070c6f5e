//! Amounts of memory.

use crate::scene::model::Scene;

/// Default of `memory`: a constant, because a choice that depends on the machine would give other digits elsewhere.
const MEMORY: f64 = 8.0 * 1024.0 * 1024.0 * 1024.0;

/// An amount of memory in words.
#[must_use]
pub fn size(bytes: usize) -> String {
    let bytes = bytes as f64;
    let unit = |power: i32| bytes / 1024.0_f64.powi(power);
    if unit(3) >= 1.0 {
        format!("{:.1} GiB", unit(3))
    } else if unit(2) >= 1.0 {
        format!("{:.1} MiB", unit(2))
    } else {
        format!("{:.1} KiB", unit(1))
    }
}

/// Memory that factorisations of a scene may take \[bytes\].
#[must_use]
pub fn memory(scene: &Scene) -> usize {
    scene.solver.memory.as_ref().map_or(MEMORY, |m| m.get_ref().0) as usize
}
