//! A fault: its law, its operator and its processes.

use super::process::{Host, Processes};
use crate::operator::Operator;
use asperity_friction::fault::FaultLaw;

/// A fault and the medium around it.
#[derive(Debug)]
pub struct Fault {
    /// Tractions that slip causes.
    pub operator: Box<dyn Operator>,
    /// Friction.
    pub law: Box<dyn FaultLaw>,
    /// Radiation damping η ≥ 0 of each point \[Pa s/m\].
    pub damping: Vec<f64>,
    /// f_n of each point at the start \[Pa\].
    pub normal: Vec<f64>,
    /// Everything else that changes tractions or friction.
    pub processes: Processes,
}

impl Fault {
    /// Parts that its processes depend on.
    pub(super) fn host(&self) -> Host<'_> {
        let Self { law, damping, normal, processes, .. } = self;
        Host { law: law.as_ref(), damping, normal, processes }
    }

    /// Changes of the unknowns of processes that change ln V by about one.
    #[must_use]
    pub fn scales(&self) -> Vec<f64> {
        self.processes.iter().flat_map(|process| process.scales(self.host())).collect()
    }
}
