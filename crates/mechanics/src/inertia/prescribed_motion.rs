//! Motion of prescribed degrees of freedom: velocities and accelerations of their channels.

use asperity_fem::dof::Constraints;

/// Writes the velocity \[m/s\] and the acceleration \[m/s²\] of the prescribed degrees of freedom at `time`, on the pieces of the
/// tables that contain `during`.
pub fn rates(constraints: &Constraints, time: f64, during: f64, v: &mut [f64], a: &mut [f64]) {
    for &dof in &constraints.fixed {
        (v[dof], a[dof]) = (0.0, 0.0);
    }
    for channel in constraints.channels.iter().filter(|c| !c.prescribed.is_empty()) {
        let [rate, curvature] = channel.amplitude.derivatives(time, during);
        for &(dof, value) in &channel.prescribed {
            v[dof] += rate * value;
            a[dof] += curvature * value;
        }
    }
}
