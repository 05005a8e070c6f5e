//! Interfaces that are under pressure before the first step.
//!
//! Bodies with an initial stress exert tractions on each other at zero displacement. The penalty acts about these tractions,
//! `f_n = <f_0 - E_n (g_n - g_0)>`, and friction continues from `t_0`. Without further loads nothing moves.

use crate::interface::Interface;
use crate::measure::{Attachment, NormalPoint};
use crate::shear::Shear;
use crate::vector::{dot, norm};
use asperity_friction::law::{Regime, Responses, Trials};
use std::slice::from_mut;

/// Share of a force on another slave node that counts as rounding. Dual functions are orthogonal to the other shape functions
/// up to the rounding of integrals over facets.
const ALONE: f64 = 1e-9;

/// Duration of a step so short that no spring unloads over it \[s\].
const INSTANT: f64 = 1e-60;

/// Traction that presses the slave at a point, the stress times its outward normal \[Pa\].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StartTraction<const D: usize> {
    /// At the slave node.
    pub at: [f64; D],
    /// Mean over the tributary area of the node, weighted with its shape function.
    pub mean: [f64; D],
}

impl<const D: usize> Interface<D> {
    /// Presses the points that are no farther from the master than `reach` \[m\]. Must be called before the first step. If the
    /// force of a point acts on its own slave node alone, its traction is the mean, which gives the node the force that the
    /// stress exerts. If it is the coefficient of a field, its traction is the value at the node. Points that would be pulled
    /// stay free unless they are bonded.
    pub fn press(&mut self, starts: &[StartTraction<D>], reach: f64) {
        let mut pressed = vec![0.0; self.slave.len()];
        let mut attachments: Vec<Attachment> = Vec::new();
        for (p, start) in starts.iter().enumerate() {
            let gap = self.gap(p);
            if !self.geometry.paired[p] || gap.is_nan() || gap.abs() > reach {
                continue;
            }
            self.measure.attachments(p, &mut attachments);
            let own = self.slave[p].node;
            let alone = attachments.iter().all(|a| !a.slave || a.node == own || a.weight.abs() <= ALONE);
            let traction = if alone { &start.mean } else { &start.at };
            let normal = dot(traction, &self.geometry.normal[p]);
            if normal <= 0.0 && self.tied.is_none() {
                continue;
            }
            let stiffness = self.penalty.stiffness;
            // Gaps of bonded points are counted from where they were tied.
            pressed[p] = normal + if self.tied.is_some() { 0.0 } else { stiffness * gap };
            self.contact.committed[p] = NormalPoint { closed: true, traction: normal, stiffness };
            if let Some(shear) = &mut self.shear {
                shear.committed.traction[p] = self.geometry.frame[p].map(|e| -dot(traction, &e));
            }
        }
        if let Some(shear) = &mut self.shear {
            shear.begin(&self.contact.committed);
        }
        self.contact.trial.copy_from_slice(&self.contact.committed);
        if self.multipliers.is_none() {
            self.pressed = Some(pressed);
        }
        self.renew_multipliers();
        self.refresh();
    }

    /// Adds the forces of the committed tractions to the residual `r`.
    pub fn exert(&mut self, r: &mut [f64]) {
        let points = &self.fields;
        for (p, f) in self.force.iter_mut().enumerate() {
            let (n, t) = (&points.normal[p], &points.shear[p]);
            *f = std::array::from_fn(|i| points.normal_traction[p] * n[i] - t[i]);
        }
        self.measure.spread(&self.force, r);
    }

    /// Gap at which an open point closes \[m\].
    pub(crate) fn offset(&self, p: usize) -> f64 {
        self.pressed.as_ref().map_or(0.0, |pressed| pressed[p] / self.penalty.stiffness)
    }
}

impl Shear {
    /// Finds the slip rates at which a law that depends on rates carries the committed tractions. If it has no solution (a bare
    /// logarithm without traction), the first step finds one or is refused.
    fn begin(&mut self, normal: &[NormalPoint]) {
        if self.law.has_elastic_domain() {
            return;
        }
        let k = self.law.states();
        for (p, contact) in normal.iter().enumerate().filter(|(_, c)| c.traction > 0.0) {
            let mut answer = [0.0; 5];
            let [traction, slip, rate, d_trial, d_normal] = &mut answer;
            let old = &self.committed.states[p * k..(p + 1) * k];
            let mut states = old.to_vec();
            let trials = Trials {
                points: &[p],
                normal: &[contact.traction],
                trial: &[norm(&self.committed.traction[p])],
                stiffness: self.stiffness,
                dt: INSTANT,
                damping: self.damping,
                lag: None,
                near: None,
            };
            let out = Responses {
                traction: from_mut(traction),
                slip: from_mut(slip),
                rate: from_mut(rate),
                regime: &mut [Regime::Slip],
                d_trial: from_mut(d_trial),
                d_normal: from_mut(d_normal),
                states: &mut states,
            };
            if self.law.respond(trials, old, out).is_ok() {
                self.committed.rate[p] = *rate;
            }
        }
    }
}
