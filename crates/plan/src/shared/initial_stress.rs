//! Initial stress of the bodies of a scene.

use crate::reading::scene::model::{Axis, Body, InitialStress, Kinematics, Scene, StressKind, VaryingStress};
use crate::shared::idealisation;
use asperity_mechanics::StressField;

/// Initial stress of a body, if it has one that is complete.
#[must_use]
pub fn body_field(scene: &Scene, name: &str) -> Option<StressField> {
    let body = scene.bodies.get(name)?;
    match body.initial_stress.as_ref()?.get_ref() {
        InitialStress::Uniform(_) => uniform(body).map(StressField::uniform),
        InitialStress::Varying(stress) => match stress.kind.get_ref() {
            StressKind::Linear => linear(stress),
            StressKind::Lithostatic => lithostatic(scene, body, stress),
        },
    }
}

/// Initial stress of a body, if it is uniform \[Pa\].
#[must_use]
pub fn uniform(body: &Body) -> Option<[f64; 6]> {
    match body.initial_stress.as_ref()?.get_ref() {
        InitialStress::Uniform(values) => in_full(&values.iter().map(|p| p.0).collect::<Vec<f64>>()),
        InitialStress::Varying(_) => None,
    }
}

/// Stress components xx, yy, zz, xy, yz, zx from a list of all six, of xx, yy, xy, or of yz, zx.
fn in_full(values: &[f64]) -> Option<[f64; 6]> {
    match *values {
        [yz, zx] => Some([0.0, 0.0, 0.0, 0.0, yz, zx]),
        [xx, yy, xy] => Some([xx, yy, 0.0, xy, 0.0, 0.0]),
        [xx, yy, zz, xy, yz, zx] => Some([xx, yy, zz, xy, yz, zx]),
        _ => None,
    }
}

fn linear(spec: &VaryingStress) -> Option<StressField> {
    let stress: Vec<f64> = spec.stress.as_ref()?.get_ref().iter().map(|p| p.0).collect();
    let gradient: Vec<f64> = spec.gradient.as_ref()?.get_ref().iter().map(|p| p.0).collect();
    let axis = match spec.along.as_ref()?.get_ref() {
        Axis::X => 0,
        Axis::Y => 1,
        Axis::Z => 2,
    };
    let level = spec.level.as_ref()?.get_ref().0;
    Some(StressField::new(in_full(&stress)?, in_full(&gradient)?, axis, level))
}

/// Vertical axis of a body, and its gravity \[m/s²\].
pub(crate) fn vertical(scene: &Scene, body: &Body) -> Option<(usize, f64)> {
    let space = idealisation::from_kinematics(*scene.kinematics.get_ref());
    let gravity = body.gravity.as_ref()?.get_ref();
    let (component, acceleration) = gravity.iter().enumerate().find(|(_, g)| **g != 0.0)?;
    Some((space.axis(component), *acceleration))
}

/// Vertical stress from the weight above, and K0 times as much horizontally; in a sheet, none through its thickness.
fn lithostatic(scene: &Scene, body: &Body, spec: &VaryingStress) -> Option<StressField> {
    let (axis, acceleration) = vertical(scene, body)?;
    let material = body.materials().next()?.1;
    let density = scene.materials.get(material)?.density.as_ref()?.get_ref().0;
    let k0 = *spec.k0.as_ref()?.get_ref();
    let overburden = spec.overburden.as_ref().map_or(0.0, |p| p.get_ref().0);
    let sheet = *scene.kinematics.get_ref() == Kinematics::PlaneStress;
    let of = |vertical: f64| -> [f64; 6] {
        std::array::from_fn(|i| match i {
            i if i == axis => vertical,
            2 if sheet => 0.0,
            0..=2 => k0 * vertical,
            _ => 0.0,
        })
    };
    let level = spec.level.as_ref()?.get_ref().0;
    Some(StressField::new(of(-overburden), of(-density * acceleration), axis, level))
}
