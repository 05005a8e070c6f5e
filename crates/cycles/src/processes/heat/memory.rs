//! Heat that points have received up to the start of a step, and what it means within the step.
//!
//! The decay rates of the modes cover twenty decades. As unknowns of an explicit method they would limit its steps to less
//! than a second. Instead, modes are committed at the end of each accepted step, exactly for the course of heating in that
//! step, and are constants within the next. The only further unknown of a point is its heat H per area, `dH/dt = q = τ V`.
//!
//! At a time Δ after the start of the step, `q(s) = q_0 + A u + B u²` with u = s/Δ is determined by q_0, by the heat received
//! since and by the present q. With `x = (H - H_0)/Δ - q_0` and `e = q - q_0`, A = 6 x - 2 e and B = 3 e - 6 x. T and p follow in
//! closed form, as do their rates. The present q depends on T and p: it is computed with those for B = 0, that is A = 2 x. This
//! needs no solution of equations, for steps of any length.
//!
//! The zeroth moment of q is exact to the order of the method. T and p therefore have an error of fourth order in the length
//! of steps that are shorter than the time w²/α of diffusion over the zone, and of order 3 1/2 beyond.

use super::modes::{Course, Window};
use super::zones::{Heat, Zone};
use crate::problem::ProcessRecord;
use asperity_ode::Clock;

/// Heat received up to the start of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Memory {
    /// Start of the step.
    at: Clock,
    /// True if q at the start is not known yet.
    fresh: bool,
    /// H of all heated points at the start \[J/m²\].
    received: Vec<f64>,
    /// q of all heated points at the start \[W/m²\].
    flux: Vec<f64>,
    /// Modes of all heated points \[J/m²\]: those of heat, then those of fluid.
    modes: Vec<f64>,
}

/// Temperature and pore pressure at the centre of the heated points, and their rates. Other points have no temperature (NaN), and
/// their pressure is 0.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Temperature \[K\].
    pub temperature: Vec<f64>,
    /// Its rate \[K/s\].
    pub temperature_rate: Vec<f64>,
    /// Pore pressure in excess of that at the start \[Pa\].
    pub pressure: Vec<f64>,
    /// Its rate \[Pa/s\].
    pub pressure_rate: Vec<f64>,
}

impl Surface {
    /// A surface of this many points.
    #[must_use]
    pub fn new(points: usize) -> Self {
        let zeros = || vec![0.0; points];
        Self {
            temperature: vec![f64::NAN; points],
            temperature_rate: zeros(),
            pressure: zeros(),
            pressure_rate: zeros(),
        }
    }
}

/// Working memory: sums over modes of each zone, of heat and of fluid.
#[derive(Clone, Debug, Default)]
pub struct Windows {
    length: f64,
    sums: Vec<[Window; 2]>,
}

impl Memory {
    /// A fault at its ambient temperature, whose heated points have this H \[J/m²\].
    #[must_use]
    pub fn new(heat: &Heat, at: Clock, received: &[f64]) -> Self {
        let (flux, modes) = (vec![0.0; heat.points()], vec![0.0; heat.modes()]);
        Self { at, fresh: true, received: received.to_vec(), flux, modes }
    }

    /// The memory of a saved state.
    pub(super) fn read(saved: &ProcessRecord) -> Self {
        let [received, flux, modes] = [0, 1, 2].map(|k| saved.list(k).to_vec());
        let at = saved.at.unwrap_or(Clock::new(0.0, 0.0));
        Self { at, fresh: saved.at.is_none(), received, flux, modes }
    }

    /// Saves it; its time only where the heating at that time is known.
    pub(super) fn save(&self) -> ProcessRecord {
        let at = (!self.fresh).then_some(self.at);
        ProcessRecord { at, ..ProcessRecord::new("heat", [&self.received, &self.flux, &self.modes]) }
    }

    /// Course of the heating of a heated point that now has the heat `received` \[J/m²\] and, if this is known, is heated by
    /// `flux` \[W/m²\].
    fn course(&self, k: usize, length: f64, received: f64, flux: Option<f64>) -> Course {
        if length == 0.0 {
            return Course { flux: flux.unwrap_or(0.0), ..Course::default() };
        }
        let start = self.flux[k];
        let x = (received - self.received[k]) / length - start;
        let (linear, square) = match flux {
            Some(flux) => (6.0 * x - 2.0 * (flux - start), 3.0 * (flux - start) - 6.0 * x),
            None => (2.0 * x, 0.0),
        };
        Course { flux: start, linear, square }
    }

    /// Time since the start of the step \[s\].
    fn since(&self, at: Clock) -> f64 {
        // The start of the step may come out negative by rounding.
        if self.fresh { 0.0 } else { at.since(&self.at).max(0.0) }
    }

    /// Prepares evaluations at a time.
    pub fn open(&self, heat: &Heat, at: Clock, windows: &mut Windows) {
        windows.length = self.since(at);
        windows.sums.resize_with(heat.zones.len(), Default::default);
        for (zone, [thermal, hydraulic]) in heat.zones.iter().zip(&mut windows.sums) {
            zone.thermal.open(windows.length, thermal);
            if let Some(fluid) = &zone.hydraulic {
                fluid.modes.open(windows.length, hydraulic);
            }
        }
    }

    /// Computes temperatures and pressures from H of the heated points, and from their present heating \[W/m²\] if it is
    /// known.
    pub fn values(
        &self,
        heat: &Heat,
        received: &[f64],
        flux: Option<&[f64]>,
        windows: &Windows,
        out: &mut Surface,
    ) {
        for (zone, sums) in heat.zones.iter().zip(&windows.sums) {
            for (i, p) in zone.points().enumerate() {
                let k = zone.first + i;
                let course = self.course(k, windows.length, received[k], flux.map(|flux| flux[k]));
                let value = |window: &Window, modes: &[f64]| window.value(modes, &course);
                let [warmer, pressure] = zone.centre(sums, self.modes(zone, i), value);
                out.temperature[p] = zone.layer.ambient + warmer;
                out.pressure[p] = pressure;
            }
        }
    }

    /// Computes their rates.
    pub fn rates(&self, heat: &Heat, received: &[f64], flux: &[f64], windows: &Windows, out: &mut Surface) {
        for (zone, sums) in heat.zones.iter().zip(&windows.sums) {
            for (i, p) in zone.points().enumerate() {
                let k = zone.first + i;
                let course = self.course(k, windows.length, received[k], Some(flux[k]));
                let rate = |window: &Window, modes: &[f64]| window.rate(modes, &course);
                [out.temperature_rate[p], out.pressure_rate[p]] =
                    zone.centre(sums, self.modes(zone, i), rate);
            }
        }
    }

    /// Modes of a point of a zone.
    fn modes(&self, zone: &Zone, i: usize) -> &[f64] {
        &self.modes[zone.modes + i * zone.stride()..][..zone.stride()]
    }

    /// Records the heating where a step starts \[W/m²\].
    pub fn begin(&mut self, at: Clock, flux: &[f64]) {
        if self.fresh {
            (self.at, self.fresh) = (at, false);
            self.flux.copy_from_slice(flux);
        }
    }

    /// Takes H of the heated points where a step starts \[J/m²\], which the end of the step before leaves as it is.
    pub(super) fn enter(&mut self, received: &[f64]) {
        if self.fresh {
            self.received.copy_from_slice(received);
        }
    }

    /// Commits a step that ends at `at`, with H of the heated points and their heating at its end.
    pub fn commit(&mut self, heat: &Heat, at: Clock, received: &[f64], flux: &[f64]) {
        let length = self.since(at);
        for zone in &heat.zones {
            let (stride, split) = (zone.stride(), zone.thermal.len());
            for i in 0..zone.points.len() {
                let k = zone.first + i;
                let course = self.course(k, length, received[k], Some(flux[k]));
                let modes = &mut self.modes[zone.modes + i * stride..][..stride];
                let (thermal, fluid) = modes.split_at_mut(split);
                zone.thermal.advance(length, &course, thermal);
                if let Some(hydraulic) = &zone.hydraulic {
                    hydraulic.modes.advance(length, &course, fluid);
                }
            }
        }
        self.received.copy_from_slice(received);
        (self.at, self.fresh) = (at, true);
    }
}

impl Zone {
    /// Temperature above the ambient one \[K\] and pressure \[Pa\] at the centre, or their rates, by a sum over the modes of
    /// a point.
    fn centre(
        &self,
        [thermal, hydraulic]: &[Window; 2],
        modes: &[f64],
        sum: impl Fn(&Window, &[f64]) -> f64,
    ) -> [f64; 2] {
        let (heat, fluid) = modes.split_at(self.thermal.len());
        let density = sum(thermal, heat);
        let pressure =
            self.hydraulic.as_ref().map_or(0.0, |h| h.own * sum(hydraulic, fluid) - h.thermal * density);
        [density / self.layer.capacity, pressure]
    }
}
