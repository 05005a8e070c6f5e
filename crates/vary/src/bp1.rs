//! The benchmark BP1-QD with other cell sizes.

use crate::SceneText;

/// Scene of the benchmark.
pub const BP1: &str = include_str!("../../../scenes/bp1.toml");
/// Size of the smallest cells of the scene \[m\].
pub const SIZE: f64 = 156.25;
/// Size of its cells at the depth at which the fault begins to creep \[m\].
pub const AT_CREEP: f64 = 600.0;

/// The scene with smallest cells of `size` \[m\]. All cells down to the creeping part are scaled in proportion.
#[must_use]
pub fn bp1(size: f64) -> SceneText {
    sized(SceneText::new(BP1), size, AT_CREEP / SIZE * size)
}

/// A scene of the family with smallest cells of `size` \[m\], and cells of `at_creep` \[m\] at the depth at which the fault
/// begins to creep.
#[must_use]
pub fn sized(scene: SceneText, size: f64, at_creep: f64) -> SceneText {
    scene
        .with_or_same("bodies.crust.mesh.fault.spacing[0][1]", format!("{size} m"))
        .with_or_same("bodies.crust.mesh.fault.spacing[1][1]", format!("{size} m"))
        .with_or_same("bodies.crust.mesh.fault.spacing[2][1]", format!("{at_creep} m"))
        .with_or_same("bodies.crust.mesh.fault.thickness", format!("{size} m"))
}
