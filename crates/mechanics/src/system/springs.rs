//! Springs between sets that move as one and load points that move at prescribed rates: one term of the system.
//!
//! The degrees of freedom of a set share one equation, so a spring acts on the first of them with the force `F = F_0 + k (d -
//! (q - q_0))`. F_0 is the force that held the set at the start of the stage, d the displacement of the load point since then, and q
//! that of the set.

use super::numbering::Numbering;
use crate::step::State;
use crate::{Spring, SpringStart, SpringState, Stage, Travel};
use asperity_fem::term::{ForwardTerm, Instant, Linearized, Pattern, Refusal, Term};

/// A spring with the degree of freedom of the system on which it acts.
#[derive(Clone, Debug)]
struct AttachedSpring {
    dof: usize,
    stiffness: f64,
    drawn: Travel,
    start: SpringStart,
}

/// The springs of a stage.
#[derive(Debug)]
pub(super) struct Springs {
    list: Vec<AttachedSpring>,
    pattern: Pattern,
    stiffness: Vec<f64>,
}

impl Springs {
    /// Attaches the springs of a stage; `None` without springs.
    pub fn new(stage: &Stage, numbering: &Numbering, starts: &[SpringStart]) -> Option<Self> {
        let attached = |(spring, start): (&Spring, &SpringStart)| AttachedSpring {
            dof: numbering.number[spring.dofs[0]],
            stiffness: spring.stiffness,
            drawn: spring.rate.drawn(stage.start, stage.end),
            start: *start,
        };
        let list: Vec<AttachedSpring> = stage.springs.iter().zip(starts).map(attached).collect();
        let dofs: Vec<usize> = list.iter().map(|s| s.dof).collect();
        let stiffness = list.iter().map(|s| s.stiffness).collect();
        let pattern = Pattern::from_blocks(dofs.chunks(1));
        (!list.is_empty()).then_some(Self { list, pattern, stiffness })
    }

    /// States of the springs at displacements `u` of the system and time \[s\].
    pub fn now(&self, u: &[f64], time: f64) -> impl Iterator<Item = SpringState> {
        self.list.iter().map(move |s| SpringState::new(&s.start, s.stiffness, s.drawn.at(time), u[s.dof]))
    }

    /// States at the start of the stage.
    pub fn starts(&self) -> Vec<SpringStart> {
        self.list.iter().map(|s| s.start).collect()
    }
}

/// Present states of the springs of a stage, if it has any, in its order.
pub(super) fn now(springs: Option<&Springs>, state: &State) -> Vec<SpringState> {
    springs.map_or_else(Vec::new, |springs| springs.now(&state.u, state.time).collect())
}

/// States of the springs of a stage at its start: those that were attached before, to these sets, carry on. A new spring carries
/// the force that held its set, the sum of the `reactions` there.
pub(super) fn starts(
    stage: &Stage,
    sets: &[Vec<usize>],
    before: &[SpringState],
    reaction: impl Fn(usize) -> f64,
    u0: &[f64],
) -> Vec<SpringStart> {
    let start = |spring: &Spring| {
        let old = sets.iter().zip(before).find(|(dofs, _)| **dofs == spring.dofs).map(|(_, now)| now);
        let new = || SpringState {
            force: spring.dofs.iter().map(|&d| reaction(d)).sum(),
            ..SpringState::default()
        };
        let SpringState { force, load_point, .. } = old.copied().unwrap_or_else(new);
        SpringStart { force, load_point, displacement: u0[spring.dofs[0]] }
    };
    stage.springs.iter().map(start).collect()
}

impl Term for Springs {
    fn name(&self) -> &'static str {
        "springs of load points"
    }

    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        for (spring, now) in self.list.iter().zip(self.now(u, at.time)) {
            r[spring.dof] -= now.force;
        }
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Springs {
    fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(&self.stiffness);
    }

    fn constant_tangent(&self) -> Option<&[f64]> {
        Some(&self.stiffness)
    }
}

impl ForwardTerm for Springs {
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        self.tangent(values);
        for spring in &self.list {
            constant[spring.dof] -= spring.drawn.pull(spring.stiffness, at.time, at.dt);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Pace;

    /// Two springs that have been drawn for a stage before.
    fn springs() -> Springs {
        let spring = |dofs: Vec<usize>, stiffness, rate| Spring {
            set: "B.top".into(),
            axis: 0,
            dofs,
            stiffness,
            rate: Pace::Steady(rate),
        };
        let stage = Stage {
            start: 2.0,
            springs: vec![spring(vec![3, 4], 7.0, 0.5), spring(vec![1], 11.0, -0.25)],
            ..Stage::free("draw", 3.0)
        };
        let numbering = Numbering { number: (0..6).collect(), nodes: (0..6).collect(), dofs: 6 };
        let starts = starts(&stage, &[], &[], |dof| dof as f64, &[0.0, 0.3, 0.0, 0.1, 0.1, 0.0]);
        Springs::new(&stage, &numbering, &starts).unwrap()
    }

    fn residual(springs: &mut Springs, u: &[f64], time: f64) -> Vec<f64> {
        let mut r = vec![0.0; u.len()];
        springs.residual(u, Instant { time, dt: 0.5 }, &mut r).unwrap();
        r
    }

    #[test]
    fn a_new_spring_carries_what_held_its_set() {
        let mut springs = springs();
        let r = residual(&mut springs, &[0.0, 0.3, 0.0, 0.1, 0.1, 0.0], 2.0);
        assert_eq!(r, [0.0, -1.0, 0.0, -7.0, 0.0, 0.0]);
    }

    #[test]
    fn tangent_and_rate_are_the_derivatives_of_the_residual() {
        let mut springs = springs();
        let u = [0.2, 0.35, -0.1, 0.15, 0.15, 0.0];
        let mut k = [0.0; 2];
        springs.tangent(&mut k);
        assert_eq!(springs.constant_tangent(), Some(&k[..]));
        let moved = [0.2, 0.355, -0.1, 0.152, 0.152, 0.0];
        let (r, then) = (residual(&mut springs, &u, 2.5), residual(&mut springs, &moved, 2.5));
        assert!(
            (then[1] - r[1] - k[1] * 0.005).abs() < 1e-14 && (then[3] - r[3] - k[0] * 0.002).abs() < 1e-14
        );
        let mut constant = vec![0.0; 6];
        springs.rate(Instant { time: 2.5, dt: 0.5 }, &mut k, &mut constant).unwrap();
        let before = residual(&mut springs, &u, 2.0);
        for ((now, before), constant) in r.iter().zip(&before).zip(&constant) {
            assert!((now - before - constant).abs() < 1e-14);
        }
    }
}
