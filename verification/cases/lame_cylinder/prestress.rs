//! A ring that starts with the stress of its loads.

use crate::cases::texts::simulate;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_vary::SceneText;
use std::f64::consts::{PI, TAU};

use super::{A, B};

/// Stress along the radius at the axis \[Pa\] and its gradient \[Pa/m\].
const RADIAL: [f64; 2] = [-5e6, -2e6];
/// Stress along the axis at the axis \[Pa\] and its gradient \[Pa/m\].
const AXIAL: [f64; 2] = [-3e6, 1e6];
const HEIGHT: f64 = 0.5;
const YOUNG: f64 = 2.5e9;

/// A ring under pressures on its inner and outer face.
fn ring() -> SceneText {
    let [at_axis, slope] = RADIAL;
    let [along, growth] = AXIAL;
    let [inner, outer] = [A, B].map(|r| -at_axis - slope * r);
    SceneText::new(&format!(
        r#"
schema = 1
title = "a ring that starts with a stress"
kinematics = "axisymmetric"
[materials.rock]
young = {YOUNG:?}
poisson = 0.3
[bodies.ring]
mesh.block = {{ min = [{A:?}, 0], max = [{B:?}, {HEIGHT:?}], divisions = [6, 3], element = "quad4" }}
material = "rock"
initial_stress = {{ kind = "linear", along = "x", level = 0, stress = [{at_axis:?}, {along:?}, {at_axis:?}, 0, 0, 0], gradient = [{slope:?}, {growth:?}, {:?}, 0, 0, 0] }}
[[stages]]
name = "rest"
duration = 1
steps = 1
conditions = [
  {{ set = "ring.bottom", symmetry = true }}, {{ set = "ring.top", symmetry = true }},
  {{ set = "ring.left", pressure = {inner:?} }}, {{ set = "ring.right", pressure = {outer:?} }},
]
[time]
stepper = "implicit"
[output]
forces.top = {{ set = "ring.top" }}
"#,
        2.0 * slope,
    ))
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut moved, mut forces, mut last) = (0.0_f64, Vec::new(), Cost::default());
    for element in ["tri3", "quad4", "tri6", "quad8", "quad9"] {
        for strain in ["small", "finite"] {
            let scene = ring()
                .with_or_same("bodies.ring.mesh.block.element", element)
                .add("bodies.ring.strain", strain)
                .text()?;
            let done = simulate(&scene).map_err(|e| format!("{element}, {strain}: {e}"))?;
            let end = done.record.stage_end("rest").ok_or("the stage was not reached")?;
            let fields = end.bodies.as_ref().ok_or("no fields")?;
            let largest = fields.displacement.as_flattened().iter().fold(0.0_f64, |m, u| m.max(u.abs()));
            moved = if largest.is_nan() { f64::NAN } else { moved.max(largest) };
            let sample = done.record.samples().last().ok_or("no step was taken")?;
            forces.push(sample.forces[0][1]);
            last = done.cost;
        }
    }
    let unloaded = -RADIAL[0] * B / YOUNG;
    ledger
        .claim("largest displacement of a ring that starts with the stress of its pressures, over p r/E, tri3 to quad9, small and finite strain")
        .value(moved / unloaded)
        .at_most(1e-13)
        .evidence(Evidence::Exact, "sigma_rr = p + q r with sigma_tt = p + 2 q r is in balance: d(r sigma_rr)/dr = sigma_tt")
        .because("the integrands are polynomials that the quadrature of all these cells integrates: rounding of nodal forces")
        .why_not_tighter("rounding of forces over the stiffness of a cell adds up over the cells")
        .covers(&[Capability::Axisymmetric, Capability::Loads])
        .cost(&last)
        .record();
    let [along, growth] = AXIAL;
    let exact = PI * along * (B * B - A * A) + TAU / 3.0 * growth * (B.powi(3) - A.powi(3));
    ledger
        .claim("force that holds the top of the same rings, over its exact value")
        .values(&forces.iter().map(|f| f / exact).collect::<Vec<f64>>())
        .equals_each(&vec![1.0; forces.len()])
        .relative(1e-13)
        .evidence(Evidence::Exact, "integral of 2 pi r sigma_yy from 1 to 2")
        .because("the integrand is a polynomial of second degree: rounding of sums")
        .why_not_tighter("rounding of displacements, of 1e-15 of the size, enters the stress")
        .covers(&[Capability::Axisymmetric, Capability::Loads])
        .cost(&last)
        .record();
    Ok(())
}
