//! Frictional heat and the pressure of the fluid that it expands, by diffusion across a fault.
//!
//! Slip heats a zone in which it is distributed as a Gaussian of standard deviation w. Along the normal z of the fault
//!
//! ```text
//! ∂T/∂t = α_th ∂²T/∂z² + τ V/(ρ c) exp(-z²/(2 w²))/(√(2π) w),   ∂p/∂t = α_hy ∂²p/∂z² + Λ ∂T/∂t,
//! ```
//!
//! J. R. Rice, J. Geophys. Res. 111 (2006) B05311; H. Noda, N. Lapusta, J. Geophys. Res. 115 (2010) B12314. Friction feels
//! T and p at the centre z = 0. Let D_α be the density there of heat that diffuses with α. Then `T = T_0 + D_th/(ρ c)`, and
//!
//! ```text
//! p = Λ/(ρ c) (α_hy D_hy - α_th D_th)/(α_hy - α_th).
//! ```
//!
//! The thickness h of a zone is that of a layer of uniform slip with the same rate of heating at its centre, `h = √(2π) w`.
//! Each D is a sum of decaying modes, see [`modes`]; how they advance is described in [`memory`].

mod heat_record;
mod heated_friction;
mod memory;
mod modes;
mod quantities;
mod zones;

pub use heat_record::{HeatRecord, Warmest};
pub use memory::{Memory, Surface, Windows};
pub use modes::Modes;
pub use quantities::{PRESSURE, TEMPERATURE};
pub use zones::{Heat, Layer, Pressurisation, Zone};

use crate::problem::{Account, Acting, Host, Phase, PointTractions, Process, ProcessRecord, Time};
use heated_friction::HeatedFriction;
use quantities::PRESSURE_RATE;

impl Process for Heat {
    fn name(&self) -> &'static str {
        "heat"
    }

    fn phase(&self) -> Phase {
        Phase::Heat
    }

    fn begin<'a>(&'a self, host: Host<'a>, saved: Option<&ProcessRecord>) -> Box<dyn Acting + 'a> {
        Box::new(HeatedFriction::new(self, host, saved))
    }

    fn unknowns(&self) -> usize {
        self.points()
    }

    fn scales(&self, host: Host<'_>) -> Vec<f64> {
        Heat::scales(self, host.law, host.normal)
    }

    fn presses(&self) -> bool {
        self.pressurises()
    }

    fn fluid(&self, _: Time, pressed: &PointTractions, sum: &mut [[f64; 2]]) {
        let (pressures, rates) = (pressed.values(&PRESSURE), pressed.values(&PRESSURE_RATE));
        for ([pressure, rise], (own, rate)) in sum.iter_mut().zip(pressures.iter().zip(rates)) {
            (*pressure, *rise) = (*pressure + own, *rise + rate);
        }
    }

    fn account(&self, saved: Option<&ProcessRecord>) -> Option<Box<dyn Account>> {
        Some(Box::new(HeatRecord::new(saved)))
    }
}
