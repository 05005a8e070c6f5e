//! Direction of the planes on which changes of Coulomb stress are resolved.

use super::super::coulomb::ReceiverPlane;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{CoulombSpec, Scene};
use crate::shared::place;
use nalgebra::{Matrix3, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};

/// Planes of a scene, in its axes. With strike φ, dip δ and rake λ, in the horizontal directions s along strike and r to its
/// right, and u upwards, the normal is sin δ r + cos δ u, and the hanging wall slips along
/// cos λ s + sin λ (sin δ u - cos δ r) (K. Aki, P. G. Richards, "Quantitative Seismology", 2002, section 4.5).
///
/// # Errors
/// [`Diagnostic`] at a strike whose directions differ from those of the medium.
pub(super) fn plane<const D: usize>(scene: &Scene, spec: &CoulombSpec) -> Result<ReceiverPlane, Diagnostic> {
    let (along, right, up) = match &spec.strike {
        Some(strike) if D == 3 => {
            let axes = directions(scene)?;
            let (sine, cosine) = strike.get_ref().0.sin_cos();
            let [east, north, up]: [Vector3<f64>; 3] = [0, 1, 2].map(|c| axes.column(c).into());
            (east * sine + north * cosine, east * cosine - north * sine, up)
        }
        // Seen along the strike, the plane dips to the right.
        _ if falls_left(spec) => (Vector3::z(), -Vector3::x(), Vector3::y()),
        _ => (-Vector3::z(), Vector3::x(), Vector3::y()),
    };
    let dip = spec.dip.get_ref().0;
    let dip = if D == 2 && falls_left(spec) { PI - dip } else { dip };
    let [(rise, fall), (dips, lead)] = [dip, spec.rake.get_ref().0].map(exact);
    let normal = right * rise + up * fall;
    let slip = along * lead + (up * rise - right * fall) * dips;
    Ok(ReceiverPlane { normal: normal.into(), slip: slip.into(), friction: *spec.friction.get_ref() })
}

/// True if a plane in two dimensions falls towards smaller x.
fn falls_left(spec: &CoulombSpec) -> bool {
    spec.dip.get_ref().0 > FRAC_PI_2
}

/// Sine and cosine of an angle. Right angles are read in radians, and their cosine would be rounding.
fn exact(angle: f64) -> (f64, f64) {
    if angle.abs() == FRAC_PI_2 { (angle.signum(), 0.0) } else { angle.sin_cos() }
}

/// Directions east, north and up in the axes of the scene, as columns. Without a place on Earth x points to the north and z to
/// the east, as maps show them.
fn directions(scene: &Scene) -> Result<Matrix3<f64>, Diagnostic> {
    let Some(frame) = place::frame(scene, true)? else {
        return Ok(Matrix3::from_columns(&[Vector3::z(), Vector3::x(), Vector3::y()]));
    };
    Ok(frame.axes.transpose())
}
