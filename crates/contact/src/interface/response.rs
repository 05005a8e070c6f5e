//! Response of an interface at the geometry last measured: tractions, slip, and forces on the slave side.

use super::Interface;
use crate::enforce::tangential;
use crate::measure::Tractions;
use crate::shear::{PreviousStep, TrialSpring, TwoStep};
use crate::spec::TimeRule;
use crate::vector::{add, axpy, scaled};
use asperity_fem::term::Refusal;

impl<const D: usize> Interface<D> {
    /// Tractions and their derivatives at the state of the last residual.
    pub(crate) fn tractions(&self) -> Tractions<'_> {
        Tractions {
            normal: match &self.iterates {
                Some(iterates) if iterates.runs() => &iterates.normal,
                _ => &self.contact.trial,
            },
            shear: self.shear.as_ref().map(|s| s.points.as_slice()),
            stiffness: self.tangential_penalty,
        }
    }

    /// Computes the trial response at the geometry last measured.
    pub(super) fn respond(&mut self, dt: f64) -> Result<(), Refusal> {
        self.check_bonds()?;
        self.enforce();
        self.close();
        let past = match (self.rule, self.previous_dt) {
            (TimeRule::Bdf2, Some(previous)) => Some(PreviousStep {
                two_step: TwoStep::new(dt, previous),
                slip: &self.motion.committed.step,
                contact: &self.contact.committed,
            }),
            _ => None,
        };
        if let Some(shear) = &mut self.shear {
            let step = &mut self.motion.trial.step;
            self.work.law_calls += 1;
            let increment = &self.geometry.increment;
            let multiplier = tangential(self.multipliers.as_ref());
            let start = multiplier.unwrap_or(&shear.committed.traction);
            let softer = self.iterates.as_mut().and_then(|iterates| iterates.trial_spring(start));
            let spring = TrialSpring { from: multiplier, stiffness: self.tangential_penalty };
            let answer =
                shear.respond(softer.unwrap_or(spring), &self.contact.trial, increment, dt, past, step);
            if let Err(failure) = answer {
                self.note_softness(&failure);
                return Err(self.law_refusal(failure));
            }
        } else {
            // Without friction all tangential motion of a closed point is slip.
            for ((step, c), du) in
                self.motion.trial.step.iter_mut().zip(&self.contact.trial).zip(&self.geometry.increment)
            {
                *step = if c.closed { *du } else { [0.0; 2] };
            }
        }
        if let Some(iterates) = &mut self.iterates {
            let shear = self.shear.as_mut().map(|s| s.points.as_mut_slice());
            iterates.reduce(&self.contact.trial, shear);
        }
        self.accumulate();
        Ok(())
    }

    /// Decides which points are closed by the tractions of the iterate.
    fn close(&mut self) {
        let Some(iterates) = self.iterates.as_mut().filter(|iterates| iterates.runs()) else { return };
        let multiplier = self.multipliers.as_ref().map(|m| m.normal.as_slice()).or(self.pressed.as_deref());
        let (gap, shift) = (&self.geometry.gap, &self.shift);
        let stiffness = self.penalty.stiffness;
        let push = |p: usize| {
            let gap = shift.as_ref().map_or(gap[p], |shift| shift.gap(p));
            multiplier.map_or(0.0, |m| m[p]) - stiffness * gap
        };
        iterates.close(push, stiffness * self.penalty.closure, &mut self.contact.trial);
    }

    /// Accumulates the increments into the trial totals of relative displacement and slip.
    pub(crate) fn accumulate(&mut self) {
        let (old, new) = (&self.motion.committed, &mut self.motion.trial);
        for p in 0..self.slave.len() {
            new.slip[p] = add(&old.slip[p], &new.step[p]);
            new.relative[p] = add(&old.relative[p], &self.geometry.increment[p]);
        }
    }

    /// Computes the force per area on the slave at each point, from the trial tractions or, if the multipliers are unknowns,
    /// from the multipliers.
    pub(crate) fn forces(&mut self) {
        let unknown = self.multipliers.as_ref().filter(|_| self.unknowns.is_some());
        for p in 0..self.slave.len() {
            let (normal, shear) = if let Some(multipliers) = unknown {
                (multipliers.normal[p], multipliers.shear.get(p).copied().unwrap_or_default())
            } else if let Some(iterates) = self.iterates.as_ref().filter(|iterates| iterates.runs()) {
                (iterates.force[p].normal, iterates.force[p].shear)
            } else {
                let t = self.shear.as_ref().map(|s| s.trial.traction[p]);
                (self.contact.trial[p].traction, t.unwrap_or_default())
            };
            let mut f = scaled(&self.geometry.normal[p], normal);
            axpy(&mut f, -1.0, &self.geometry.tangential(p, &shear));
            self.force[p] = f;
        }
    }

    /// Takes a direction of Newton's method from the configuration last measured.
    pub(super) fn direct_iterates(&mut self, along: &[f64]) {
        let Some(iterates) = self.iterates.as_mut().filter(|iterates| iterates.differ()) else { return };
        Self::gather(&self.nodes, along, &mut self.du);
        self.measure.slides(&self.geometry, &self.du, &mut self.slides);
        let shear = self.shear.as_ref().map(|s| s.points.as_slice());
        iterates.direct(&self.slides, &self.contact.trial, shear);
    }
}
