//! Ruptures of faults through cycles, computed by bodies with mass. The computation is in [`asperity_mechanics::dynamics`],
//! and the hand-overs are in [`asperity_cycles`].

use asperity_cycles::{Dynamics, Handover, Shaken, Start, Waves, WavesError};
use asperity_mechanics::dynamics::{Explicit, Onset, Problem, StableStep};
use asperity_ode::Control;

/// Bodies with mass for ruptures, and when they are used.
#[derive(Debug)]
pub struct Ruptures {
    /// Slip rates of the hand-overs.
    pub handover: Handover,
    /// The bodies.
    pub bodies: AnyBodies,
}

/// Bodies in two or three dimensions.
#[derive(Debug)]
pub enum AnyBodies {
    /// Two-dimensional.
    Two(Box<Bodies<2>>),
    /// Three-dimensional.
    Three(Box<Bodies<3>>),
}

/// Bodies with mass around faults.
#[derive(Debug)]
pub struct Bodies<const D: usize> {
    /// Problem without the state at which a rupture begins.
    pub problem: Problem<D>,
    /// Largest stable step, and the cell that sets it.
    pub stable: StableStep,
}

impl Ruptures {
    /// Bodies and hand-overs for a run; `areas` are those of its points \[m²; m per metre of thickness\].
    pub fn dynamics<'a>(&'a mut self, areas: &'a [f64]) -> Dynamics<'a> {
        let waves: &mut dyn Waves = match &mut self.bodies {
            AnyBodies::Two(bodies) => bodies.as_mut(),
            AnyBodies::Three(bodies) => bodies.as_mut(),
        };
        Dynamics { handover: self.handover, areas, waves }
    }

    /// Description for the plan, line by line.
    #[must_use]
    pub fn words(&self) -> [String; 3] {
        let Handover { above, below, quiet, kinetic } = self.handover;
        let still = if kinetic < 1.0 {
            format!(", and the kinetic energy has fallen to {kinetic:e} of its largest")
        } else {
            String::new()
        };
        let [steps, sides] = match &self.bodies {
            AnyBodies::Two(bodies) => bodies.words(),
            AnyBodies::Three(bodies) => bodies.words(),
        };
        let when = format!(
            "auto: bodies have mass from a slip rate of {above:e} m/s on, until all rates have stayed below {below:e} m/s for {quiet:.3} s, \
             while a shear wave crosses the faults and returns{still}"
        );
        [when, steps, sides]
    }
}

impl<const D: usize> Bodies<D> {
    fn words(&self) -> [String; 2] {
        let viscosity = match self.problem.viscosity {
            0.0 => "no viscosity".into(),
            beta => format!("viscosity of {beta} steps"),
        };
        let dt = self.problem.step_of(0, &self.stable);
        let steps = format!(
            "ruptures: explicit steps of {dt:.6e} s, {:.3} of the largest stable step, {viscosity}",
            dt / self.stable.step
        );
        let held = self.problem.stages.iter().map(|s| s.fixed.len()).sum::<usize>();
        let tied = self.problem.fault.as_ref().map_or(0, |f| f.ties.len());
        let sides = format!(
            "ruptures: {} nodes of sides absorb waves, {held} degrees of freedom are held, {tied} creeping points are tied",
            self.problem.absorbing.len()
        );
        [steps, sides]
    }

    /// Sets the state at which a rupture begins.
    fn begin(&mut self, start: &Start) {
        let Some(fault) = &mut self.problem.fault else { return };
        fault.shear.clone_from(&start.loading);
        fault.normal.clone_from(&start.normal);
        fault.rate.clone_from(&start.rate);
        fault.onset = Some(Onset {
            friction: start.friction.clone(),
            states: start.states.clone(),
            loading_rate: start.loading_rate.clone(),
        });
    }
}

impl<const D: usize> Waves for Bodies<D> {
    fn rupture(
        &mut self,
        start: &Start,
        see: &mut dyn FnMut(Shaken<'_>) -> Control,
    ) -> Result<(), WavesError> {
        self.begin(start);
        let mut explicit = Explicit::new(&self.problem)?;
        explicit.begin_stage(0)?;
        let mut before = start.states.clone();
        loop {
            let time = explicit.time();
            explicit.step()?;
            let fault = explicit.fault().clone();
            // States live at half steps; the first step begins at the start itself.
            let states: Vec<f64> = if time > 0.0 {
                before.all().iter().zip(fault.states.all()).map(|(a, b)| 0.5 * (a + b)).collect()
            } else {
                before.all().to_vec()
            };
            let kinetic = explicit.kinetic();
            let mut energy = || {
                let b = explicit.budget();
                b.kinetic + b.elastic + b.plastic + b.viscous + b.absorbed - b.loads - b.initial
            };
            let shaken = Shaken {
                time,
                slip: fault.slip.view(),
                rate: fault.rate.view(),
                shear: fault.shear.view(),
                normal: &fault.normal,
                states: fault.states.with(&states),
                kinetic,
                energy: &mut energy,
            };
            if see(shaken) == Control::Stop {
                return Ok(());
            }
            before = fault.states;
        }
    }
}
