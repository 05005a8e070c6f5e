//! Heated faults during an integration: what friction feels of the heat, and what it adds to it.

use super::around::Around;
use super::memory::{Memory, Surface, Windows};
use super::zones::Heat;
use asperity_friction::fault::FaultLaw;
use asperity_ode::Clock;

/// The memory of heat with its working memory, and the law at the present temperatures.
#[derive(Debug)]
pub(crate) struct Heated {
    memory: Memory,
    windows: Windows,
    surface: Surface,
    /// Present q of the heated points \[W/m²\].
    flux: Vec<f64>,
    /// Slip rates, component by component \[m/s\].
    rate: Vec<f64>,
    /// A copy of the law, if temperature affects it.
    law: Option<Box<dyn FaultLaw>>,
}

impl Heated {
    /// Heat of a fault with this memory.
    pub fn new(fault: Around<'_>, memory: Memory, heated: usize) -> Self {
        Self {
            memory,
            windows: Windows::default(),
            surface: Surface::new(fault.law.points()),
            flux: vec![0.0; heated],
            rate: vec![0.0; fault.law.points() * fault.law.components()],
            law: fault.law.warms().then(|| fault.law.copy()),
        }
    }

    /// The memory.
    pub fn memory(&self) -> &Memory {
        &self.memory
    }

    /// Temperatures and pressures as last computed.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The law at the present temperatures, if these affect it.
    pub fn law(&self) -> Option<&dyn FaultLaw> {
        self.law.as_deref()
    }

    /// Computes temperatures and pressures and their rates at a time, and sets the law to these temperatures. `normal` is f_n
    /// without the pressure of heated fluid \[Pa\].
    pub fn feel(&mut self, fault: Around<'_>, at: Clock, now: &Now<'_>) {
        let Some(heat) = fault.heat else { return };
        self.memory.open(heat, at, &mut self.windows);
        self.memory.values(heat, (now.received, None), &self.windows, &mut self.surface);
        self.warm(heat);
        self.slip(fault, heat, now);
        self.memory.values(heat, (now.received, Some(&self.flux)), &self.windows, &mut self.surface);
        self.memory.rates(heat, (now.received, &self.flux), &self.windows, &mut self.surface);
        self.warm(heat);
    }

    /// Sets the law to the temperatures.
    fn warm(&mut self, heat: &Heat) {
        if let Some(law) = &mut self.law {
            heat.heated().for_each(|p| law.warm(p, self.surface.temperature[p]));
        }
    }

    /// Computes the heating `q = f_n a m·V`.
    fn slip(&mut self, fault: Around<'_>, heat: &Heat, now: &Now<'_>) {
        let law = self.law.as_deref().unwrap_or(fault.law);
        law.slip_rates(0, now.m, now.states, &mut self.rate);
        let n = law.points();
        for (q, p) in self.flux.iter_mut().zip(heat.heated()) {
            let work: f64 = (p..now.m.len()).step_by(n).map(|i| now.m[i] * self.rate[i]).sum();
            let least = fault.floor.map_or(f64::NEG_INFINITY, |floor| floor.at(p));
            *q = (now.normal[p] - self.surface.pressure[p]).max(least) * law.scale(p) * work;
        }
    }

    /// Writes the heating of the heated points, at the temperatures and pressures of [`Heated::feel`].
    pub fn receive(&mut self, fault: Around<'_>, at: Clock, now: &Now<'_>, rates: &mut [f64]) {
        let Some(heat) = fault.heat else { return };
        self.slip(fault, heat, now);
        self.memory.begin(at, &self.flux);
        rates.copy_from_slice(&self.flux);
    }

    /// Subtracts what damping takes of the driving traction as points become faster by heat, `η V (∂ln V/∂T) dT/dt`.
    pub fn soften(&self, fault: Around<'_>, rate: &[f64], shear_rate: &mut [f64]) {
        let (Some(heat), Some(law)) = (fault.heat, &self.law) else { return };
        let n = fault.law.points();
        for p in heat.heated() {
            let faster = law.log_rate_by_temperature(p) * self.surface.temperature_rate[p];
            for i in (p..rate.len()).step_by(n) {
                shear_rate[i] -= fault.damping[p] * rate[i] * faster;
            }
        }
    }

    /// Commits a step that ends at `at`.
    pub fn commit(&mut self, fault: Around<'_>, at: Clock, now: &Now<'_>) {
        self.feel(fault, at, now);
        if let Some(heat) = fault.heat {
            self.memory.commit(heat, at, now.received, &self.flux);
        }
    }
}

/// State of a fault at a moment.
pub(crate) struct Now<'a> {
    /// m, component by component.
    pub m: &'a [f64],
    /// States.
    pub states: &'a [f64],
    /// f_n without the pressure of heated fluid \[Pa\].
    pub normal: &'a [f64],
    /// H of the heated points \[J/m²\].
    pub received: &'a [f64],
}
