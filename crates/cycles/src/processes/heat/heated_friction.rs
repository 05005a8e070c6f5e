//! Heated faults during an integration: what friction feels of the heat, and what it adds to it.

use super::memory::{Memory, Surface, Windows};
use super::quantities::{PRESSURE, PRESSURE_RATE, TEMPERATURE};
use super::zones::Heat;
use crate::problem::{Acting, Components, FaultState, Field, Host, ProcessRecord, Rates, Time, Tractions};
use asperity_friction::fault::FaultLaw;
use asperity_ode::Clock;

/// The memory of heat with its working memory, and the law at the present temperatures.
#[derive(Debug)]
pub(super) struct HeatedFriction<'a> {
    heat: &'a Heat,
    host: Host<'a>,
    memory: Memory,
    windows: Windows,
    surface: Surface,
    /// Present q of the heated points \[W/m²\].
    flux: Vec<f64>,
    /// Working memory of slip rates, component by component \[m/s\].
    rate: Vec<f64>,
    /// A copy of the law, if temperature affects it.
    law: Option<Box<dyn FaultLaw>>,
}

impl<'a> HeatedFriction<'a> {
    /// Heat of a fault with a saved memory, or at its ambient temperature.
    pub fn new(heat: &'a Heat, host: Host<'a>, saved: Option<&ProcessRecord>) -> Self {
        let zeros = vec![0.0; heat.points()];
        let fresh = || Memory::new(heat, Clock::new(0.0, 0.0), &zeros);
        Self {
            heat,
            host,
            memory: saved.map_or_else(fresh, Memory::read),
            windows: Windows::default(),
            surface: Surface::new(host.law.points()),
            rate: vec![0.0; host.law.points() * host.law.components()],
            law: host.law.warms().then(|| host.law.copy()),
            flux: zeros,
        }
    }

    /// Sets the law to the temperatures.
    fn warm(&mut self) {
        if let Some(law) = &mut self.law {
            self.heat.heated().for_each(|p| law.warm(p, self.surface.temperature[p]));
        }
    }

    /// Computes the heating `q = f_n a m·V` at these slip rates \[m/s\].
    fn heating(&mut self, now: &FaultState<'_>, rate: Components<&[f64]>) {
        let law = self.law.as_deref().unwrap_or(self.host.law);
        for (q, p) in self.flux.iter_mut().zip(self.heat.heated()) {
            let work: f64 = now.friction.m.at(p).zip(rate.at(p)).map(|(m, v)| m * v).sum();
            let least = self.host.processes.least(p);
            *q = (now.normal[p] - self.surface.pressure[p]).max(least) * law.scale(p) * work;
        }
    }

    /// Subtracts what damping takes of the driving traction as points become faster by heat, `η V (∂ln V/∂T) dT/dt`.
    fn soften(&self, rates: &mut Rates<'_>) {
        let Some(law) = &self.law else { return };
        for p in self.heat.heated() {
            let faster = law.log_rate_by_temperature(p) * self.surface.temperature_rate[p];
            for component in 0..rates.slip.components() {
                let slip_rate = rates.slip.component(component)[p];
                rates.shear.component_mut(component)[p] -= self.host.damping[p] * slip_rate * faster;
            }
        }
    }
}

impl Acting for HeatedFriction<'_> {
    /// Computes temperatures and pressures and their rates, and sets the law to these temperatures.
    fn see(&mut self, now: &FaultState<'_>) {
        self.memory.enter(now.own);
        self.memory.open(self.heat, now.at, &mut self.windows);
        self.memory.values(self.heat, now.own, None, &self.windows, &mut self.surface);
        self.warm();
        let mut rate = std::mem::take(&mut self.rate);
        let points = self.host.law.points();
        let law = self.law.as_deref().unwrap_or(self.host.law);
        law.slip_rates(now.friction, Components::new(&mut rate, points));
        self.heating(now, Components::new(&rate, points));
        self.rate = rate;
        self.memory.values(self.heat, now.own, Some(&self.flux), &self.windows, &mut self.surface);
        self.memory.rates(self.heat, now.own, &self.flux, &self.windows, &mut self.surface);
        self.warm();
    }

    fn law(&self) -> Option<&dyn FaultLaw> {
        self.law.as_deref()
    }

    /// Writes the heating of the heated points.
    fn rates(&mut self, now: &FaultState<'_>, slip_rate: Components<&[f64]>, rates: &mut [f64]) {
        self.heating(now, slip_rate);
        self.memory.begin(now.at, &self.flux);
        rates.copy_from_slice(&self.flux);
    }

    fn act(&mut self, _: Time, on: &mut Tractions<'_>) -> Result<(), usize> {
        let Surface { pressure, pressure_rate, .. } = &self.surface;
        on.normal.iter_mut().zip(pressure).for_each(|(f, p)| *f -= p);
        if let Some(rates) = &mut on.rates {
            self.soften(rates);
            rates.normal.iter_mut().zip(pressure_rate).for_each(|(rate, rise)| *rate -= rise);
        }
        Ok(())
    }

    fn fields(&self) -> Vec<Field> {
        let Surface { temperature, pressure, pressure_rate, .. } = &self.surface;
        let all = [(&TEMPERATURE, temperature), (&PRESSURE, pressure), (&PRESSURE_RATE, pressure_rate)];
        all.map(|(quantity, values)| Field { quantity, values: values.clone() }).into()
    }

    fn remembers(&self) -> bool {
        true
    }

    fn commit(&mut self, now: &FaultState<'_>) {
        self.see(now);
        self.memory.commit(self.heat, now.at, now.own, &self.flux);
    }

    fn save(&self) -> Option<ProcessRecord> {
        Some(self.memory.save())
    }
}
