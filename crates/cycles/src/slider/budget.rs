//! Energy budget of spring-sliders per unit area, summed over sliders of equal area.
//!
//! Let u_i be the slip of a slider, u_L the displacement of the load point, T_i0 the initial tractions, k_i the
//! stiffnesses of the springs to the load point and k_ij of those between sliders. Springs add the traction
//! `S_i = k_i (u_L - u_i) + Σ_j k_ij (u_j - u_i)` to T_i0. The work of S_i, and the equation of motion of each slider
//! times its slip rate, give
//!
//! ```text
//! Σ T_i0 u_i + ∫ Σ k_i (u_L - u_i) V_L dt - ∫ Σ' S_i V_i dt
//!     = ½ Σ k_i (u_L - u_i)² + ½ Σ k_ij (u_j - u_i)²  +  ∫ Σ f_i V_i dt  +  ∫ Σ η_i V_i² dt  +  ½ Σ M_i (V_i² - V_i0²)
//! ```
//!
//! The left-hand side is the work of the loads. Its last sum is over sliders of imposed slip rate. The sums with the
//! stiffnesses of springs are over all sliders, all others over free sliders. The integrals are evaluated within each
//! step by Gauss quadrature from the dense output of the method; slip follows from the tractions of the springs. The
//! integrator uses none of these integrals, so the imbalance of the budget is an independent measure of the error.

use super::equations::Piece;
use super::springs::Slips;
use crate::accounts::Energy;
use asperity_friction::slider::Condition;
use asperity_ode::{Clock, Step};
use serde::{Deserialize, Serialize};

/// Points and weights of Gauss quadrature on (0, 1), exact to degree 7, which is that of the dense output of highest
/// order.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_1, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_3, 0.173_927_422_568_726_93),
];

/// Energy budget of a run so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Work of the load point and of imposed slip rates \[J/m²\].
    driven: f64,
    energy: Energy,
}

/// State of the sliders at an instant.
struct State {
    load: f64,
    slip: Vec<f64>,
    conditions: Vec<Condition>,
}

impl State {
    fn new(piece: &Piece<'_>, slips: &Slips, at: Clock, unknowns: &[f64]) -> Self {
        let sliders = 0..piece.problem.names.len();
        let condition = |i| piece.segment.condition(i, at.seconds(), unknowns);
        let (conditions, load): (Vec<Condition>, _) =
            (sliders.map(condition).collect(), slips.load_at(piece, at));
        let slip = slips.slip(piece, at, load, &conditions);
        Self { load, slip, conditions }
    }
}

impl Budget {
    /// Energy budget \[J/m²\].
    #[must_use]
    pub fn energy(&self) -> Energy {
        self.energy
    }

    /// Adds a step of a piece.
    pub(super) fn advance(&mut self, piece: &Piece<'_>, slips: &Slips, step: &Step<'_>) {
        let mut unknowns = step.state.to_vec();
        for (share, weight) in GAUSS {
            let time = share * step.length();
            step.at(share, &mut unknowns);
            let at = step.start.later(time);
            self.integrate(piece, at, &State::new(piece, slips, at, &unknowns), weight * step.length());
        }
        self.store(piece, slips, &State::new(piece, slips, step.end, step.state));
    }

    /// Adds the powers at an instant times a duration \[s\].
    fn integrate(&mut self, piece: &Piece<'_>, at: Clock, state: &State, duration: f64) {
        let system = &piece.problem.system;
        let load_rate = piece.segment.load().at(at.seconds()).0;
        for (i, (slider, c)) in system.sliders().iter().zip(&state.conditions).enumerate() {
            self.driven += duration * slider.stiffness * (state.load - state.slip[i]) * load_rate;
            if system.imposed(i).is_some() {
                self.driven -= duration * slider.stiffness * (state.load - state.slip[i]) * c.rate;
            } else {
                self.energy.friction += duration * c.friction * c.normal * c.rate;
                self.energy.radiated += duration * slider.damping * c.rate * c.rate;
            }
        }
        for spring in system.springs() {
            let [a, b] = spring.between;
            let pull = spring.stiffness * (state.slip[b] - state.slip[a]);
            for (i, pull) in [(a, pull), (b, -pull)] {
                if system.imposed(i).is_some() {
                    self.driven -= duration * pull * state.conditions[i].rate;
                }
            }
        }
    }

    /// Sets the parts that depend on the current state alone.
    fn store(&mut self, piece: &Piece<'_>, slips: &Slips, state: &State) {
        let problem = piece.problem;
        let system = &problem.system;
        let start = system.sliders().iter().any(|s| s.mass.is_some()).then(|| system.segment(0.0));
        let (mut initial, mut elastic, mut kinetic) = (0.0, 0.0, 0.0);
        for (i, (slider, c)) in system.sliders().iter().zip(&state.conditions).enumerate() {
            let slip = state.slip[i];
            elastic += 0.5 * slider.stiffness * (state.load - slip).powi(2);
            if let Some(first) = slips.first(i) {
                initial += first * slip;
            }
            let mass = slider.mass.filter(|_| system.imposed(i).is_none());
            if let (Some(mass), Some(start)) = (mass, &start) {
                let before = start.condition(i, 0.0, &problem.start).rate;
                kinetic += 0.5 * mass * (c.rate - before) * (c.rate + before);
            }
        }
        for spring in system.springs() {
            let [a, b] = spring.between;
            elastic += 0.5 * spring.stiffness * (state.slip[b] - state.slip[a]).powi(2);
        }
        self.energy = Energy { loads: self.driven + initial, elastic, kinetic, ..self.energy };
    }
}
