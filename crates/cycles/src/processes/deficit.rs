//! Loads of slip that lags behind plates (backslip).

use crate::operator::Operator;
use crate::problem::Loading;
use asperity_fem::table::Table;

/// Loads of slip deficit (J. C. Savage, J. Geophys. Res. 88 (1983) 4984): all points slip backwards at the rates of the plates,
/// which are given component by component \[m/s\].
///
/// Tractions are then those of the deficit, slip less what the plates have moved. Slip at the rates of the plates changes none
/// of them, neither shear nor normal tractions. On a plane fault this is the load of its continuation, which creeps at these
/// rates. Returns the loads until `end` \[s\].
#[must_use]
pub fn deficit(operator: &dyn Operator, rates: &[f64], end: f64) -> Loading {
    let backwards: Vec<f64> = rates.iter().map(|rate| -rate).collect();
    let shear = operator.shear_of(&backwards);
    let normal = if operator.couples_normal() { operator.normal_of(&backwards) } else { Vec::new() };
    let mut loading = Loading::new(operator.components());
    loading.add(Table::new(vec![0.0, end], vec![0.0, end]), shear, normal);
    loading
}
