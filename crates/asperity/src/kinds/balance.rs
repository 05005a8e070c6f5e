//! Forces and moments that an interface exerts on both of its sides.

use asperity_contact::Interface;
use schemars::JsonSchema;
use serde::Serialize;

/// Force balance of an interface at the end of the run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct InterfaceBalance {
    /// Interface.
    pub interface: String,
    /// Total contact force on the slave side \[N, or N/m of thickness\].
    pub slave_force: Vec<f64>,
    /// Sum of the forces on both sides over the largest of them \[-\].
    pub force_residual: f64,
    /// Sum of the moments on both sides, corrected for the couple of friction at a finite gap, over force times size
    /// \[-\].
    pub moment_residual: f64,
    /// Couple g_n n x f of penetration and friction \[N m\].
    pub couple: Vec<f64>,
}

/// Balance of contact forces.
#[must_use]
pub fn balance<const D: usize>(name: &str, interface: &Interface<D>, scale: f64) -> InterfaceBalance {
    let b = interface.balance();
    let size = |v: &[f64]| v.iter().fold(0.0_f64, |m, c| m.max(c.abs()));
    let force = size(&b.slave_force);
    let relative = |v: &[f64], scale: f64| if scale > 0.0 { size(v) / scale } else { 0.0 };
    InterfaceBalance {
        interface: name.to_string(),
        slave_force: b.slave_force.to_vec(),
        force_residual: relative(&b.residual, force),
        moment_residual: relative(&b.moment_residual, force * scale),
        couple: b.couple.to_vec(),
    }
}
