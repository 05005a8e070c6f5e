//! Nagata, Nakatani & Yoshida (2012): the ageing law with a memory of shear traction,
//! dφ/dt = b (1/θ - V/L) - c dμ/dt, φ = b ln(Vref θ/L).
//!
//! The law is published for a constant normal traction, as -c dτ/dt divided by it. Where V jumps, φ + c μ is continuous. At
//! constant V dμ = dφ, so that (1 + c) dφ/dt = b (1/θ - V/L): the ageing law on a clock slowed by 1 + c. The jump is made by
//! the law that holds φ and μ together; this file has the second part. With the regularised strength, where dμ/dφ < 1 for μ of
//! a few a, the slowed clock is the definition.

use super::ageing::Ageing;
use super::definition::{
    Bound, Common, Definition, Front, Parameter, TableEvolution, Unit, Variable, needed,
};
use super::state::{Evolution, Rate, Speed, StateUpdate};

/// See the module.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nagata {
    ageing: Ageing,
    c: f64,
}

impl Nagata {
    /// b \[-\], L \[m\] > 0, Vref \[m/s\] > 0, c ≥ 0 \[-\].
    ///
    /// # Errors
    /// [`crate::Failure::Parameter`].
    pub fn new(b: f64, length: f64, v_ref: f64, c: f64) -> Result<Self, crate::Failure> {
        if !(c >= 0.0 && c.is_finite()) {
            return Err(crate::Failure::Parameter { name: "c", value: c, admissible: "0 <= c, finite" });
        }
        // The jump turns φ into ψ.
        let b = crate::positive("b", b)?;
        Ok(Self { ageing: Ageing::new(b, length, v_ref)?, c })
    }
}

impl TableEvolution for Nagata {
    const DEFINITION: Definition = Definition {
        name: "nagata",
        equation: "ageing with a memory of shear traction; `b` > 0",
        parameters: &[Parameter {
            key: "c",
            unit: Unit::None,
            bound: Bound::NotNegative,
            optional: false,
            example: "2.0",
            meaning: "",
        }],
        one_state: Some("it remembers the shear traction all of them share"),
        memory: Some(0),
        variable: Variable::Logarithm { lengths: 1.0 },
        front: Front::Ageing,
    };

    fn build(p: &Common, own: &[Option<f64>]) -> Result<Self, crate::Failure> {
        Self::new(p.b, p.length, p.v_ref, needed(own, 0, "c")?)
    }
}

impl Evolution for Nagata {
    const STATES: usize = 1;
    const NAME: &'static str = "rate-and-state, Nagata law";
    type Start = (f64, f64, f64);

    fn phi(&self, state: f64) -> f64 {
        self.ageing.phi(state)
    }

    fn phi_slopes(&self, state: f64) -> (f64, f64) {
        self.ageing.phi_slopes(state)
    }

    fn per_phi(&self) -> f64 {
        self.ageing.per_phi()
    }

    fn steady(&self, log_rate: f64) -> f64 {
        self.ageing.steady(log_rate)
    }

    fn rate(&self, state: f64, speed: Speed) -> Rate {
        let (rate, slower) = (self.ageing.rate(state, speed), 1.0 / (1.0 + self.c));
        Rate {
            rate: slower * rate.rate,
            d_log_rate: slower * rate.d_log_rate,
            d_state: slower * rate.d_state,
        }
    }

    fn start(&self, state: f64, dt: f64) -> Self::Start {
        self.ageing.slowed(state, dt, self.c)
    }

    fn evolve(&self, start: &Self::Start, speed: Speed) -> StateUpdate {
        self.ageing.evolve(start, speed)
    }

    fn linear(&self, state: f64, log_rate: f64, dt: f64) -> (f64, f64) {
        let (constant, slope) = self.ageing.linear(state, log_rate, dt);
        (constant / (1.0 + self.c), slope / (1.0 + self.c))
    }

    fn weakening(&self, state: f64, log_rate: f64) -> f64 {
        self.ageing.weakening(state, log_rate) / (1.0 + self.c)
    }

    fn length(&self) -> Option<f64> {
        self.ageing.length()
    }

    fn shear_memory(&self) -> f64 {
        self.c
    }
}
