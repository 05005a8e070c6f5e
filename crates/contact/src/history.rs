//! Committed history of an interface as serialisable values.

use crate::interface::Interface;
use crate::measure::measure_state::MeasureState;
use crate::observe::Work;
use crate::shear::Shear;
use asperity_fem::term::{Restorable, Term as _};
use asperity_friction::law::Regime;
use serde::{Deserialize, Serialize};

/// Committed history of an interface. Fields that follow from others are left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct InterfaceState {
    /// Length of the last step under the present law \[s\], for two-step differences.
    previous_dt: Option<f64>,
    /// Displacements of the nodes \[m\], one after another.
    displacements: Vec<f64>,
    /// True for each closed point.
    closed: Vec<bool>,
    /// Normal tractions \[Pa\], which are also the multipliers of the next step if there are multipliers.
    normal_traction: Vec<f64>,
    /// Relative tangential displacement \[m\].
    relative: Vec<[f64; 2]>,
    /// Slip \[m\].
    slip: Vec<[f64; 2]>,
    /// Slip increment of the last step \[m\].
    step: Vec<[f64; 2]>,
    /// Frictional history, if a law is active.
    shear: Option<ShearState>,
    /// Multipliers that are unknowns of the system, at the last commit.
    unknowns: Vec<f64>,
    /// Partings at which points were bonded \[m\]; `None` for points without a partner.
    tied: Option<Vec<Option<f64>>>,
    /// True if tractions of an initial stress still act.
    pressed: bool,
    /// Pairing.
    measure: MeasureState,
    /// Normal and frame of points without a partner, as they were when the partner was lost.
    lost: Vec<(usize, Vec<f64>)>,
    /// Point that lost strength in the last rejected trial.
    soft: Option<usize>,
    /// Counts of work.
    work: Work,
}

/// Frictional history of all points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct ShearState {
    /// Shear tractions \[Pa\].
    traction: Vec<[f64; 2]>,
    /// Slip rates \[m/s\].
    rate: Vec<f64>,
    /// True for each slipping point.
    slips: Vec<bool>,
    /// State variables, point-major.
    states: Vec<f64>,
    /// Slopes of the law in the last trial. They identify the weakening point if the next trial is refused at once.
    slopes: Vec<f64>,
}

impl ShearState {
    fn from_shear(shear: &Shear) -> Self {
        let c = &shear.committed;
        Self {
            traction: c.traction.clone(),
            rate: c.rate.clone(),
            slips: c.regime.iter().map(|r| *r == Regime::Slip).collect(),
            states: c.states.clone(),
            slopes: shear.points.iter().map(|p| p.d_trial).collect(),
        }
    }

    fn fits(&self, shear: &Shear) -> bool {
        let (c, n) = (&shear.committed, shear.points.len());
        let lengths = [self.traction.len(), self.rate.len(), self.slips.len(), self.slopes.len()];
        lengths.iter().all(|l| *l == n) && self.states.len() == c.states.len()
    }

    fn put(&self, shear: &mut Shear) {
        let c = &mut shear.committed;
        c.traction.copy_from_slice(&self.traction);
        c.rate.copy_from_slice(&self.rate);
        c.states.copy_from_slice(&self.states);
        for (regime, slips) in c.regime.iter_mut().zip(&self.slips) {
            *regime = if *slips { Regime::Slip } else { Regime::Stick };
        }
        for (point, slope) in shear.points.iter_mut().zip(&self.slopes) {
            point.d_trial = *slope;
        }
    }
}

impl<const D: usize> Interface<D> {
    /// Normals and frames of points without a partner.
    fn lost(&self) -> Vec<(usize, Vec<f64>)> {
        let g = &self.geometry;
        let alone = (0..self.slave.len()).filter(|&p| !g.paired[p]);
        alone.map(|p| (p, [g.normal[p], g.frame[p][0], g.frame[p][1]].concat())).collect()
    }

    fn fits(&self, saved: &InterfaceState) -> bool {
        let n = self.slave.len();
        let of_points = [saved.relative.len(), saved.slip.len(), saved.step.len(), saved.closed.len()];
        let shear = match (&saved.shear, &self.shear) {
            (Some(saved), Some(own)) => saved.fits(own),
            (saved, own) => saved.is_none() && own.is_none(),
        };
        of_points.iter().all(|l| *l == n)
            && saved.normal_traction.len() == n
            && saved.displacements.len() == self.nodes.len() * D
            && saved.unknowns.len() == self.unknowns.as_ref().map_or(0, |u| u.committed.len())
            && saved.tied.as_ref().is_none_or(|t| t.len() == n)
            && saved.lost.iter().all(|(p, v)| *p < n && v.len() == 3 * D)
            && shear
    }
}

impl<const D: usize> Restorable for Interface<D> {
    type State = InterfaceState;

    fn save(&self) -> InterfaceState {
        let (contact, motion) = (&self.contact.committed, &self.motion.committed);
        let bond = |gap: &f64| gap.is_finite().then_some(*gap);
        InterfaceState {
            previous_dt: self.previous_dt,
            displacements: self.u.committed.iter().flatten().copied().collect(),
            closed: contact.iter().map(|c| c.closed).collect(),
            normal_traction: contact.iter().map(|c| c.traction).collect(),
            relative: motion.relative.clone(),
            slip: motion.slip.clone(),
            step: motion.step.clone(),
            shear: self.shear.as_ref().map(ShearState::from_shear),
            unknowns: self.unknowns.as_ref().map_or_else(Vec::new, |u| u.committed.clone()),
            tied: self.tied.as_ref().map(|t| t.iter().map(bond).collect()),
            pressed: self.pressed.is_some(),
            measure: self.measure.save(),
            lost: self.lost(),
            soft: self.soft,
            work: self.work,
        }
    }

    fn restore(&mut self, saved: &InterfaceState) -> bool {
        if !self.fits(saved) || !self.measure.restore(&saved.measure) {
            return false;
        }
        self.previous_dt = saved.previous_dt;
        for (u, saved) in self.u.committed.iter_mut().zip(saved.displacements.chunks_exact(D)) {
            u.copy_from_slice(saved);
        }
        let contact = saved.closed.iter().zip(&saved.normal_traction);
        for (c, (&closed, &traction)) in self.contact.committed.iter_mut().zip(contact) {
            (c.closed, c.traction) = (closed, traction);
            c.stiffness = if closed { self.penalty.stiffness } else { 0.0 };
        }
        let motion = &mut self.motion.committed;
        motion.relative.copy_from_slice(&saved.relative);
        motion.slip.copy_from_slice(&saved.slip);
        motion.step.copy_from_slice(&saved.step);
        self.tied = saved.tied.as_ref().map(|t| t.iter().map(|g| g.unwrap_or(f64::INFINITY)).collect());
        self.pressed = self.pressed.take().filter(|_| saved.pressed);
        if let Some((shear, saved)) = self.shear.as_mut().zip(saved.shear.as_ref()) {
            saved.put(shear);
        }
        if let Some(unknowns) = &mut self.unknowns {
            unknowns.committed.copy_from_slice(&saved.unknowns);
            unknowns.present.copy_from_slice(&saved.unknowns);
            unknowns.renew(self.measure.as_ref(), true);
        }
        self.reject();
        for (p, values) in &saved.lost {
            let (normal, frame) = values.split_at(D);
            self.geometry.normal[*p].copy_from_slice(normal);
            self.geometry.frame[*p][0].copy_from_slice(&frame[..D]);
            self.geometry.frame[*p][1].copy_from_slice(&frame[D..]);
        }
        (self.soft, self.work) = (saved.soft, saved.work);
        self.refresh();
        true
    }
}
