//! Exponential relaxation towards a state that depends on the slip rate only: dφ/dt = -(V/L)(φ - φ_ss(V)).

use super::state::{Rate, Speed, StateUpdate};

/// Below this x = V Δt/L, 1 - e^(-x) is computed by `expm1`; above it there is no cancellation.
const SMALL: f64 = 0.5;

/// A steady state with its first two derivatives with respect to ln V.
#[derive(Clone, Copy, Debug)]
pub(super) struct SteadyState {
    pub value: f64,
    pub slope: f64,
    pub curvature: f64,
}

/// (e^(-x), 1 - e^(-x)), both accurate to relative rounding, from one exponential.
pub(super) fn decay(x: f64) -> (f64, f64) {
    if x < SMALL {
        let share = -(-x).exp_m1();
        (1.0 - share, share)
    } else {
        let decay = (-x).exp();
        (decay, 1.0 - decay)
    }
}

/// φ = φ_0 e^(-x) + φ_ss (1 - e^(-x)), x = V Δt/L: a weighted mean without cancellation. A point at rest keeps its state,
/// however far its steady state is.
pub(super) fn step(old: f64, x: f64, steady: SteadyState) -> StateUpdate {
    let (decay, share) = decay(x);
    if share == 0.0 {
        return StateUpdate { state: old, d_log_rate: 0.0, curvature: 0.0, d_state: 1.0 };
    }
    // dx/dln V = x; x e^(-x) vanishes where e^(-x) does.
    let (fading, distance) = if decay == 0.0 { (0.0, 0.0) } else { (x * decay, steady.value - old) };
    let slower = if decay == 0.0 { 0.0 } else { (1.0 - x) * fading };
    StateUpdate {
        state: old * decay + steady.value * share,
        d_log_rate: fading * distance + steady.slope * share,
        curvature: slower * distance + 2.0 * fading * steady.slope + steady.curvature * share,
        d_state: decay,
    }
}

/// dφ/dt and its derivatives.
#[inline]
pub(super) fn rate(state: f64, speed: Speed, length: f64, steady: SteadyState) -> Rate {
    let frequency = speed.rate / length;
    if frequency == 0.0 {
        return Rate { rate: 0.0, d_log_rate: 0.0, d_state: 0.0 };
    }
    let distance = steady.value - state;
    Rate {
        rate: frequency * distance,
        d_log_rate: frequency * (distance + steady.slope),
        d_state: -frequency,
    }
}
