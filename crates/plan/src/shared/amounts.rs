//! Amounts of memory.

use crate::reading::scene::model::Scene;
use asperity_scene::defaults;

/// Amount of memory as text with a unit.
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

/// Memory that the factorisations of a scene may use \[bytes\].
#[must_use]
pub fn memory(scene: &Scene) -> usize {
    scene.solver.memory.as_ref().map_or(defaults::MEMORY, |m| m.get_ref().0) as usize
}
