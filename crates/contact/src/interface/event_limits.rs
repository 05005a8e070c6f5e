//! Limits on the events that a step of an interface can resolve.

use super::Interface;
use crate::shear::Shear;
use crate::status::{Status, label};
use crate::vector::norm;
use crate::watch::{Course, RateLimit, Watch, spanned};
use asperity_fem::term::Objection;
use asperity_friction::Failure;
use asperity_friction::law::Regime;

/// A point that leaves rest counts as dropping if its traction lies below its strength at rest by more than this share. The fall
/// that follows the normal traction over a short step is smaller.
const DROP: f64 = 1e-3;
/// Share of the area in contact that may let go within a step of a law whose strength drops at once. A partial failure is held
/// by the rest of the area; a failure of more than half of it at once is not.
const AT_ONCE: f64 = 0.5;
/// Relative distance to the strength within which the traction of a sticking point counts as being at it. Normal tractions
/// change by less along the shortest steps.
const NEAR: f64 = 1e-3;
/// Pa in a MPa.
const MEGA: f64 = 1e6;
/// Rounding of the slope of a law's response, and of a share of the area, relative to 1.
const ROUNDING: f64 = 1e-9;

impl<const D: usize> Interface<D> {
    /// Sets the limits on steps. By default there are none.
    pub fn set_watch(&mut self, watch: Watch) {
        self.watch = watch;
    }

    /// Slip of the last step over the largest that the law's loss of strength allows; 0 if it sets no limit \[-\].
    #[must_use]
    pub fn fill(&self) -> f64 {
        let Some(shear) = &self.shear else { return 0.0 };
        let slips = self.motion.committed.step.iter().map(norm).enumerate();
        match self.watch.course {
            Course::Steady | Course::Drop => 0.0,
            Course::State { most, damped } => {
                let (rate, contact) = (&shear.committed.rate, &self.contact.committed);
                let spans = |p: usize| spanned(most, damped, [rate[p]; 2], contact[p].traction);
                slips.map(|(p, slip)| slip / spans(p)).fold(0.0, f64::max)
            }
            Course::Branch { most, length } => slips
                .filter(|(p, _)| shear.committed.states[*p] < length)
                .map(|(_, slip)| slip / most)
                .fold(0.0, f64::max),
        }
    }

    /// Fastest point in the committed state, with its slip rate \[m/s\].
    #[must_use]
    pub fn fastest(&self) -> Option<(usize, f64)> {
        let rates = self.fields.slip_rate.iter().map(|v| v.abs()).enumerate();
        rates.reduce(|a, b| if b.1 > a.1 { b } else { a })
    }

    /// Reference position of slave point `p`, padded to three components \[m\].
    #[must_use]
    pub fn place(&self, p: usize) -> [f64; 3] {
        let x = &self.nodes[self.slave[p].node].position;
        std::array::from_fn(|c| if c < D { x[c] } else { 0.0 })
    }

    /// Point that lost strength with slip fastest in the last rejected trial, or else one that is about to reach the strength
    /// it would lose.
    #[must_use]
    pub fn weakens(&self) -> Option<usize> {
        self.soft.or_else(|| self.stands_at_strength())
    }

    /// Point that has all but reached its strength under a law that loses strength by slipping. Newton's method alternates
    /// between sticking and slipping at such a point if neither is in equilibrium.
    fn stands_at_strength(&self) -> Option<usize> {
        let falls = matches!(self.watch.course, Course::Branch { .. } | Course::Drop);
        let shear = self.shear.as_ref().filter(|_| falls)?;
        let normal: Vec<f64> = self.contact.committed.iter().map(|c| c.traction).collect();
        let state = &shear.committed;
        let mut mu = vec![0.0; normal.len()];
        shear.law.coefficient(&normal, &state.rate, &state.states, &mut mu).ok()?;
        let strength = |p: usize| shear.law.cohesion(p) + mu[p] * normal[p];
        // Under a law that drops at once, a point that slips has no strength left to lose.
        let dropped = |p: usize| self.watch.course == Course::Drop && state.regime[p] == Regime::Slip;
        let stands = |p: usize| norm(&state.traction[p]) >= (1.0 - NEAR) * strength(p);
        (0..normal.len()).find(|&p| strength(p) > 0.0 && !dropped(p) && stands(p))
    }

    /// Remembers the point at which the law weakens faster than the spring behind it unloads.
    pub(crate) fn note_softness(&mut self, failure: &Failure) {
        if let (Failure::Unstable { point, .. }, Some(shear)) = (failure, &self.shear) {
            self.soft = shear.slices.index.get(*point).copied();
        }
    }

    /// Point that loses strength with slip fastest in the present trial state.
    pub(crate) fn softest(&self) -> Option<usize> {
        let shear = self.shear.as_ref()?;
        let points = shear.points.iter().zip(&shear.trial.regime).enumerate();
        let softest =
            points.filter(|(_, (_, regime))| **regime == Regime::Slip).map(|(p, (s, _))| (p, s.d_trial));
        match self.watch.course {
            Course::Steady => None,
            Course::Drop => self.dropped(shear).first().copied(),
            Course::State { .. } | Course::Branch { .. } => softest
                .filter(|(_, d)| softens(*d))
                .reduce(|a, b| if b.1 < a.1 { b } else { a })
                .map(|(p, _)| p),
        }
    }

    /// Reason for which the trial state should not be accepted, if any.
    pub(crate) fn objects(&self) -> Option<Objection> {
        let shear = self.shear.as_ref()?;
        self.outruns(shear)
            .or_else(|| self.leaps(shear))
            .or_else(|| self.runs_away(shear))
            .or_else(|| self.stands_too_coarsely(shear))
    }

    /// Objects if a point slides under more normal traction than the spacing of the points resolves.
    fn stands_too_coarsely(&self, shear: &Shear) -> Option<Objection> {
        let most = self.watch.coarse_beyond?;
        let slides = |p: &usize| {
            let (contact, rate) = (&self.contact.trial[*p], shear.trial.rate[*p].abs());
            let status = label(shear.trial.regime[*p], rate, self.label_rate);
            contact.closed && contact.traction > most && status == Status::Slip
        };
        let normal = |p: usize| self.contact.trial[p].traction;
        let p = (0..self.slave.len()).filter(slides).max_by(|&a, &b| normal(a).total_cmp(&normal(b)))?;
        let reason = format!("slides under {:.4} MPa", normal(p) / MEGA);
        Some(Objection { coarse: true, ..self.objection_at(shear, p, &reason, false) })
    }

    /// Objects if the trial state is beyond the reach of one step.
    fn leaps(&self, shear: &Shear) -> Option<Objection> {
        let slip = |p: usize| norm(&self.motion.trial.step[p]);
        let farthest = |counts: &dyn Fn(usize) -> bool| {
            (0..self.slave.len()).filter(|&p| counts(p)).max_by(|&a, &b| slip(a).total_cmp(&slip(b)))
        };
        match self.watch.course {
            Course::Steady => None,
            Course::State { most, damped } => {
                let soft =
                    |p: usize| shear.trial.regime[p] == Regime::Slip && softens(shear.points[p].d_trial);
                let rates = |p: usize| [shear.committed.rate[p], shear.trial.rate[p]];
                let normal = |p: usize| self.contact.trial[p].traction;
                let most = |p: usize| spanned(most, damped, rates(p), normal(p));
                let p = farthest(&|p| slip(p) > most(p) || soft(p))?;
                let reason =
                    format!("slips by {:.3e} m within a step, and the law weakens over less", slip(p));
                Some(self.objection_at(shear, p, &reason, true))
            }
            Course::Branch { most, length } => {
                // Only the part of the slip along which the law weakens counts.
                let along = |p: usize| slip(p).min(length - shear.committed.states[p]);
                let p = farthest(&|p| along(p) > most)?;
                let reason =
                    format!("slips by {:.3e} m at once while it weakens over {length:.3e} m", slip(p));
                Some(self.objection_at(shear, p, &reason, true))
            }
            Course::Drop => self.lets_go_at_once(shear),
        }
    }

    /// Points that leave rest in the trial state and whose strength drops, however long the step. Where a largest traction caps both
    /// strengths, none drops.
    fn dropped(&self, shear: &Shear) -> Vec<usize> {
        let normal: Vec<f64> = self.contact.trial.iter().map(|c| c.traction).collect();
        let coefficients = |states: &[f64]| {
            let mut mu = vec![0.0; normal.len()];
            shear.law.coefficient(&normal, &shear.trial.rate, states, &mut mu).map(|()| mu)
        };
        let at_rest = coefficients(&shear.committed.states);
        let (Ok(before), Ok(after)) = (at_rest, coefficients(&shear.trial.states)) else {
            return Vec::new();
        };
        let drops = |p: &usize| {
            let (p, traction) = (*p, norm(&shear.trial.traction[*p]));
            shear.committed.regime[p] == Regime::Stick
                && shear.trial.regime[p] == Regime::Slip
                && traction < before[p] * normal[p] * (1.0 - DROP)
                && traction > after[p] * normal[p] * (1.0 - DROP)
        };
        (0..normal.len()).filter(drops).collect()
    }

    /// Objects if more of the surface leaves rest within the step, with a drop of its traction, than the rest of it can hold.
    fn lets_go_at_once(&self, shear: &Shear) -> Option<Objection> {
        let area = |p: usize| self.fields.area[p];
        let held = |p: &usize| self.contact.committed[*p].closed && self.contact.trial[*p].closed;
        let closed: f64 = (0..self.slave.len()).filter(held).map(area).sum();
        let gone: Vec<usize> = self.dropped(shear).into_iter().filter(held).collect();
        let share = gone.iter().map(|&p| area(p)).sum::<f64>() / closed;
        if share.is_nan() || share <= AT_ONCE + ROUNDING {
            return None;
        }
        let slip = |p: usize| norm(&self.motion.trial.step[p]);
        let p = gone.into_iter().max_by(|&a, &b| slip(a).total_cmp(&slip(b)))?;
        let reason = format!(
            "slips by {:.3e} m as {:.0} % of the surface in contact lets go at once",
            slip(p),
            1e2 * share
        );
        Some(self.objection_at(shear, p, &reason, true))
    }

    /// Objects if a slip rate exceeds the limit.
    fn runs_away(&self, shear: &Shear) -> Option<Objection> {
        let limit = self.watch.rate?;
        let closed = |p: &usize| self.contact.trial[*p].closed;
        let normal = self.contact.trial.iter().filter(|c| c.closed).map(|c| c.traction).fold(0.0, f64::max);
        let rate = |p: usize| shear.trial.rate[p].abs();
        let p = (0..self.slave.len()).filter(closed).max_by(|&a, &b| rate(a).total_cmp(&rate(b)))?;
        let most = limit.under(normal);
        // Without normal traction there is no friction, and the motion of the bodies alone sets the slip rate.
        if normal <= 0.0 || rate(p) <= most {
            return None;
        }
        let why = match limit {
            RateLimit::Stated(_) => "`slip_rate_limit` of the scene",
            RateLimit::Damped { .. } => "at which radiated waves carry as much as the direct effect",
        };
        Some(self.objection_at(
            shear,
            p,
            &format!("reaches {:.3e} m/s, beyond {most:.3e} m/s, {why}", rate(p)),
            false,
        ))
    }

    /// Objects if a slip rate in contact exceeds the speed of shear waves or is no number. Shorter steps may end before it does.
    fn outruns(&self, shear: &Shear) -> Option<Objection> {
        let most = self.watch.waves?;
        let rate = |p: usize| shear.trial.rate[p].abs();
        let beyond = |p: &usize| self.contact.trial[*p].closed && (rate(*p) > most || rate(*p).is_nan());
        let p = (0..self.slave.len()).filter(beyond).reduce(|a, b| if rate(b) > rate(a) { b } else { a })?;
        let reason = format!("outruns shear waves: {:.3e} m/s, beyond {most:.4e} m/s", rate(p));
        Some(self.objection_at(shear, p, &reason, true))
    }

    fn objection_at(&self, shear: &Shear, p: usize, reason: &str, shorter: bool) -> Objection {
        Objection {
            term: self.name.clone(),
            reason: format!("node {} {reason}", self.label(p)),
            position: self.place(p),
            rate: shear.trial.rate[p].abs(),
            shorter,
            coarse: false,
        }
    }
}

/// True if the traction falls with slip. The slope is H/(E_t + H) with H < 0; it exceeds 1 if the spring is softer still.
fn softens(slope: f64) -> bool {
    !(-ROUNDING..=1.0 + ROUNDING).contains(&slope)
}
