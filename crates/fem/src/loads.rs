//! External forces as a term: patterns times amplitudes.

use crate::dof::Channel;
use crate::table::Table;
use crate::term::{ForwardTerm, Instant, Linearized, Pattern, Refusal, Term};

/// Nodal forces that vary in time.
#[derive(Clone, Debug, Default)]
pub struct ExternalForces {
    channels: Vec<Channel>,
    pattern: Pattern,
}

impl ExternalForces {
    /// The channels.
    #[must_use]
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// The forces of these channels.
    #[must_use]
    pub fn new(channels: Vec<Channel>) -> Self {
        Self { channels, pattern: Pattern::default() }
    }

    fn subtract(&self, amplitude: impl Fn(&Table) -> f64, r: &mut [f64]) {
        for channel in &self.channels {
            let alpha = amplitude(&channel.amplitude);
            for &(dof, force) in &channel.forces {
                r[dof] -= alpha * force;
            }
        }
    }
}

impl Term for ExternalForces {
    fn name(&self) -> &str {
        "external forces"
    }

    fn residual(&mut self, _u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        self.subtract(|table| table.value(at.time), r);
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for ExternalForces {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, _values: &mut [f64]) {}

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(&[])
    }
}

impl ForwardTerm for ExternalForces {
    fn rate(&mut self, at: Instant, _values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        self.subtract(|table| table.value(at.time) - table.value(at.time - at.dt), constant);
        Ok(())
    }
}
