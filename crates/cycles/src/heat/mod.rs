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

mod around;
mod heated;
mod memory;
mod modes;
mod zones;

pub(crate) use around::Around;
pub(crate) use heated::{Heated, Now};
pub use memory::{Memory, Surface, Windows};
pub use modes::Modes;
pub use zones::{Heat, Layer, Pressurisation, Zone};
