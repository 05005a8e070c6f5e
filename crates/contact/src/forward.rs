//! Forward (rate-form) steps: the rate tangent at the committed state and the limits r4 to r8.
//!
//! At the committed state t^e = t. With η = t/|t| the linearised response of the law is
//! `dt = E_t (I - η⊗η) du + η (along E_t η·du + coupling df_n + constant)`, `df_n = -E_n dg_n`.

use crate::interface::Interface;
use crate::measure::{NormalPoint, ShearPoint, Slides};
use crate::shear::{Shear, Slices};
use crate::vector::{add, axpy, dot, norm, scaled};
use asperity_fem::term::{ForwardTerm, Fraction, Instant, Refusal};
use asperity_friction::Failure;
use asperity_friction::law::{Increments, Limit, LimitKind, PresentStates, RateBounds, Rates, Regime};

/// Points within this distance of an event, relative to the increment that leads to it, switch with the step instead of
/// limiting it. Otherwise simultaneous events of a symmetric scene would cost one step each, at fractions that are pure
/// rounding.
const BAND: f64 = 1e-9;

/// Most refinements of r6 along a turning traction. Each restart removes a fixed share of the distance to the root: the ratio
/// of the slopes of magnitude and chord, seldom below 1/3. A tolerance of 1e-9 thus takes about 50 at worst.
const REFINEMENTS: usize = 60;

/// Most changes of a point between stick and slip before a step. Each change can switch its neighbours. A point that changes
/// more often is on the edge of slip, where both responses agree to rounding.
const MOST_SWITCHES: u8 = 6;

/// Increments over a forward step, in the carried frame.
struct Step<'a> {
    normal: &'a [NormalPoint],
    gap: &'a [f64],
    increment: &'a [[f64; 2]],
    present: PresentOptions,
}

/// Settings passed to a law along with the points.
#[derive(Clone, Copy)]
struct PresentOptions {
    dt: f64,
    rate_floor: f64,
}

impl Shear {
    /// Gathers the committed state of the closed points.
    fn gather_present(&mut self, normal: &[NormalPoint]) {
        let k = self.states();
        let (s, c) = (&mut self.slices, &self.committed);
        s.clear();
        s.rate.clear();
        s.regime.clear();
        for (p, contact) in normal.iter().enumerate() {
            if contact.closed {
                let t = &c.traction[p];
                let size = norm(t);
                s.index.push(p);
                s.normal.push(contact.traction);
                s.trial.push(size);
                s.direction.push(if size > 0.0 { scaled(t, size.recip()) } else { [0.0; 2] });
                s.old.extend_from_slice(&c.states[p * k..(p + 1) * k]);
                s.rate.push(c.rate[p]);
                s.regime.push(c.regime[p]);
            }
        }
    }

    /// Linearises the law at the committed state: `d_trial`, `d_normal` and, in `traction` of the slices, the constant term.
    fn linearise(&mut self, normal: &[NormalPoint], options: PresentOptions) -> Result<(), Failure> {
        self.gather_present(normal);
        let s = &mut self.slices;
        let n = s.index.len();
        for v in [&mut s.d_trial, &mut s.d_normal, &mut s.traction] {
            v.resize(n, 0.0);
        }
        if n > 0 {
            let present = PresentStates {
                points: &s.index,
                normal: &s.normal,
                traction: &s.trial,
                rate: &s.rate,
                regime: &s.regime,
                states: &s.old,
                stiffness: self.stiffness,
                dt: options.dt,
                rate_floor: options.rate_floor,
            };
            let rates = Rates { along: &mut s.d_trial, coupling: &mut s.d_normal, constant: &mut s.traction };
            self.law.rates(present, rates)?;
        }
        self.points.fill(ShearPoint::default());
        for (i, &p) in s.index.iter().enumerate() {
            let resting = s.direction[i] == [0.0; 2];
            self.points[p] = ShearPoint {
                traction: self.committed.traction[p],
                direction: s.direction[i],
                // Without a direction the response is the same in every direction.
                ratio: if resting { s.d_trial[i] } else { 1.0 },
                d_trial: s.d_trial[i],
                d_normal: s.d_normal[i],
            };
        }
        Ok(())
    }

    /// Increment of the shear traction at entry `i` of the slices, in the carried frame. Must follow `linearise`.
    fn traction_increment(&self, i: usize, step: &Step<'_>) -> [f64; 2] {
        let p = self.slices.index[i];
        let (point, du) = (&self.points[p], &step.increment[p]);
        let along = dot(&point.direction, du);
        let df = -step.normal[p].stiffness * step.gap[p];
        let mut dt = scaled(du, self.stiffness * point.ratio);
        let extra = self.stiffness * (point.d_trial - point.ratio) * along
            + point.d_normal * df
            + self.slices.traction[i];
        axpy(&mut dt, extra, &point.direction);
        dt
    }

    /// Queries the law for the smallest limit of `entries` over the part `from..to` of the step, with tractions at `from`. The
    /// point of the result indexes the slices; its fraction refers to the part.
    fn limit_within(
        &self,
        step: &Step<'_>,
        entries: &[usize],
        (from, to): (f64, f64),
        bounds: RateBounds,
    ) -> Option<Limit> {
        let k = self.states();
        let s = &self.slices;
        let mut part = Slices::default();
        let (mut normal, mut traction, mut slip) = (Vec::new(), Vec::new(), Vec::new());
        for &i in entries {
            let p = s.index[i];
            let dt = self.traction_increment(i, step);
            let df = -step.normal[p].stiffness * step.gap[p];
            let t = along_path(&self.committed.traction[p], &dt, from);
            part.index.push(p);
            part.normal.push(step.normal[p].traction + from * df);
            part.trial.push(norm(&t));
            part.rate.push(s.rate[i]);
            part.regime.push(s.regime[i]);
            part.old.extend_from_slice(&s.old[i * k..(i + 1) * k]);
            normal.push((to - from) * df);
            traction.push(magnitude_increment(&t, &scaled(&dt, to - from)));
            let slid = slip_increment(s.regime[i], &self.points[p], &step.increment[p], &dt, self.stiffness);
            slip.push((to - from) * slid);
        }
        if entries.is_empty() {
            return None;
        }
        let increments = Increments { normal: &normal, traction: &traction, slip: &slip };
        let limit = self.law.limit(part.present(self.stiffness, step.present), increments, bounds)?;
        Some(Limit { point: entries[limit.point], ..limit })
    }

    /// Smallest limit of the law: r8 for moving points, r6 for resting ones.
    fn limit(&self, step: &Step<'_>, bounds: RateBounds) -> Option<Limit> {
        let floor = step.present.rate_floor;
        let elastic = self.law.has_elastic_domain();
        let rests =
            |i: usize| self.slices.rate[i] < floor || elastic && self.slices.regime[i] == Regime::Stick;
        let (resting, moving): (Vec<usize>, Vec<usize>) =
            (0..self.slices.index.len()).partition(|&i| rests(i));
        let (turning, straight): (Vec<usize>, Vec<usize>) =
            resting.into_iter().partition(|&i| self.nearest(i, step) > 0.0);
        let found = [
            self.limit_within(step, &moving, (0.0, 1.0), bounds),
            self.leave_cone(step, &straight, (0.0, 1.0), bounds),
        ];
        let turned = turning.into_iter().map(|i| {
            let nearest = self.nearest(i, step);
            let before = self.leave_cone(step, &[i], (0.0, nearest), bounds);
            before.or_else(|| self.leave_cone(step, &[i], (nearest, 1.0), bounds))
        });
        found.into_iter().chain(turned).flatten().reduce(|a, b| if b.fraction < a.fraction { b } else { a })
    }

    /// Fraction of the step at which the traction of entry `i` is smallest. The magnitude falls until then and grows
    /// afterwards. A law sees the magnitudes at both ends only: it would take a traction that starts at its strength and turns
    /// for one that leaves at once.
    fn nearest(&self, i: usize, step: &Step<'_>) -> f64 {
        let (t, dt) = (&self.committed.traction[self.slices.index[i]], self.traction_increment(i, step));
        let square = dot(&dt, &dt);
        if square > 0.0 { (-dot(t, &dt) / square).clamp(0.0, 1.0) } else { 0.0 }
    }

    /// r6 in vector form over the part `from..to` of the step. A law sees magnitudes only, that is, the chord between the ends.
    /// Since |t + r Δt| is convex in r, the root of the chord is never late. Restarting from there, while the true magnitude
    /// lies below the chord, converges from below to the first root at which the traction leaves the cone outwards. If the
    /// traction does not turn, the first result is the root.
    fn leave_cone(
        &self,
        step: &Step<'_>,
        resting: &[usize],
        (mut from, to): (f64, f64),
        bounds: RateBounds,
    ) -> Option<Limit> {
        for _ in 0..REFINEMENTS {
            let found = self.limit_within(step, resting, (from, to), bounds)?;
            let root = from + found.fraction * (to - from);
            let dt = self.traction_increment(found.point, step);
            let size =
                |r: f64| norm(&along_path(&self.committed.traction[self.slices.index[found.point]], &dt, r));
            let chord = size(from) + found.fraction * (size(to) - size(from));
            // A law treats a traction this close to its strength as being at it and reports no further limit.
            if chord - size(root) <= BAND * (1.0 + BAND) * chord {
                return Some(Limit { fraction: root, ..found });
            }
            from = root;
        }
        // Not converged. The iteration approaches from below, so its last position is admissible.
        Some(Limit { fraction: from, point: *resting.first()?, kind: LimitKind::StickToSlip })
    }

    /// Switches points whose increment contradicts their regime: points that slip backwards stick, and points that stick at
    /// their strength and are loaded further slip. Returns true if any point switched.
    fn switch(&mut self, step: &Step<'_>) -> bool {
        let mut any = false;
        let present = self.slices.present(self.stiffness, step.present);
        let stands: Vec<bool> = (0..self.slices.index.len()).map(|i| self.law.stands(present, i)).collect();
        for (i, stands) in stands.into_iter().enumerate() {
            let p = self.slices.index[i];
            let (du, dt) = (&step.increment[p], self.traction_increment(i, step));
            let forth = match self.slices.regime[i] {
                Regime::Slip => {
                    slip_increment(Regime::Slip, &self.points[p], du, &dt, self.stiffness) >= -BAND * norm(du)
                }
                Regime::Stick => stands && dot(&self.slices.direction[i], &dt) > 0.0,
            };
            let regime = if forth { Regime::Slip } else { Regime::Stick };
            // The last switch allowed is to slip, since a point that sticks at its strength would exceed it.
            let most = if forth { MOST_SWITCHES + 1 } else { MOST_SWITCHES };
            if regime != self.slices.regime[i] && self.switches[p] < most {
                self.switches[p] += 1;
                self.committed.regime[p] = regime;
                any = true;
            }
        }
        any
    }
}

impl Slices {
    /// The gathered points in the form that a law takes.
    fn present(&self, stiffness: f64, options: PresentOptions) -> PresentStates<'_> {
        PresentStates {
            points: &self.index,
            normal: &self.normal,
            traction: &self.trial,
            rate: &self.rate,
            regime: &self.regime,
            states: &self.old,
            stiffness,
            dt: options.dt,
            rate_floor: options.rate_floor,
        }
    }
}

/// t + r dt.
fn along_path(t: &[f64; 2], dt: &[f64; 2], r: f64) -> [f64; 2] {
    [t[0] + r * dt[0], t[1] + r * dt[1]]
}

/// |t + dt| - |t| without cancellation.
fn magnitude_increment(t: &[f64; 2], dt: &[f64; 2]) -> f64 {
    let sum = norm(&add(t, dt)) + norm(t);
    if sum == 0.0 { 0.0 } else { (2.0 * dot(t, dt) + dot(dt, dt)) / sum }
}

/// Slip increment: the part of the tangential motion that is not elastic, signed along η.
fn slip_increment(regime: Regime, point: &ShearPoint, du: &[f64; 2], dt: &[f64; 2], stiffness: f64) -> f64 {
    if regime == Regime::Stick {
        return 0.0;
    }
    let mut plastic = *du;
    axpy(&mut plastic, -stiffness.recip(), dt);
    if point.direction == [0.0; 2] { norm(&plastic) } else { dot(&plastic, &point.direction) }
}

impl<const D: usize> Interface<D> {
    fn options(&self, dt: f64) -> PresentOptions {
        PresentOptions { dt, rate_floor: self.rate_floor }
    }

    /// Linearised increments of gap and tangential displacement from the committed state for the system increment `du`.
    pub fn slides(&mut self, du: &[f64]) -> &Slides {
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.count_gaps();
        Self::gather(&self.nodes, du, &mut self.du);
        self.measure.slides(&self.geometry, &self.du, &mut self.slides);
        &self.slides
    }

    /// Limits r4 and r5 over all points; `None` if they are bonded.
    fn normal_limit(&self) -> Option<(f64, &'static str, usize)> {
        if self.tied.is_some() {
            return None;
        }
        let mut best: Option<(f64, &'static str, usize)> = None;
        let rest = self.penalty.stiffness * self.penalty.closure;
        for (p, c) in self.contact.committed.iter().enumerate() {
            let (gap, dg) = (self.gap(p), self.slides.gap[p]);
            let found = if c.closed {
                let df = -c.stiffness * dg;
                (df < 0.0 && c.traction > rest).then(|| (c.traction / -df, "r5"))
            } else {
                let gap = gap - self.offset(p);
                (self.geometry.paired[p] && dg < 0.0 && gap > self.penalty.closure).then(|| (gap / -dg, "r4"))
            };
            if let Some((r, name)) = found
                && r < 1.0 - BAND
                && best.is_none_or(|(b, ..)| r < b)
            {
                best = Some((r, name, p));
            }
        }
        best
    }

    fn law_limit(&mut self, dt: f64) -> Option<(f64, &'static str, usize)> {
        let (bounds, present) = (self.rate_bounds, self.options(dt));
        let shear = self.shear.as_mut()?;
        self.work.law_calls += 2;
        let normal = &self.contact.committed;
        shear.linearise(normal, present).ok()?;
        let step = Step { normal, gap: &self.slides.gap, increment: &self.slides.increment, present };
        let limit = shear.limit(&step, bounds)?;
        let name = if limit.kind == LimitKind::StickToSlip { "r6" } else { "r8" };
        (limit.fraction < 1.0 - BAND).then(|| (limit.fraction, name, shear.slices.index[limit.point]))
    }
}

impl<const D: usize> ForwardTerm for Interface<D> {
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        if self.unknowns.is_some() {
            return Err(self.refuse("multipliers that are unknowns have no rate form".to_owned()));
        }
        self.work.tangents += 1;
        let options = self.options(at.dt);
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.contact.trial.copy_from_slice(&self.contact.committed);
        self.force.fill([0.0; D]);
        if let Some(shear) = &mut self.shear {
            self.work.law_calls += 1;
            if let Err(failure) = shear.linearise(&self.contact.committed, options) {
                self.note_softness(&failure);
                return Err(self.law_refusal(failure));
            }
            for (i, &p) in shear.slices.index.iter().enumerate() {
                // A traction that grows by c η pulls the slave along -η.
                let c = scaled(&shear.slices.direction[i], -shear.slices.traction[i]);
                self.force[p] = self.geometry.tangential(p, &c);
            }
            self.measure.spread(&self.force, constant);
        }
        self.measure.tangent(&self.geometry, self.tractions(), values);
        Ok(())
    }

    fn switch(&mut self, du: &[f64], at: Instant) -> bool {
        let present = self.options(at.dt);
        self.slides(du);
        let Some(shear) = self.shear.as_mut().filter(|s| s.law.has_elastic_domain()) else { return false };
        self.work.law_calls += 2;
        let normal = &self.contact.committed;
        let step = Step { normal, gap: &self.slides.gap, increment: &self.slides.increment, present };
        // If the law fails here, the failure is reported when the step is taken.
        shear.linearise(normal, present).is_ok_and(|()| shear.switch(&step))
    }

    fn limit(&mut self, du: &[f64], at: Instant) -> Option<Fraction> {
        self.slides(du);
        let mut best = self.normal_limit();
        if let Some(found) = self.law_limit(at.dt)
            && best.is_none_or(|b| found.0 < b.0)
        {
            best = Some(found);
        }
        if let Some(exit) = self.measure.exit(&self.du).filter(|e| e.fraction < 1.0 - BAND)
            && best.is_none_or(|b| exit.fraction < b.0)
        {
            best = Some((exit.fraction, "r7", exit.point));
        }
        best.map(|(value, limit, point)| {
            let event = match limit {
                "r4" => "open -> closed",
                "r5" => "closed -> open",
                "r6" => "stick -> slip",
                "r7" => "segment exit",
                _ => "friction law",
            };
            Fraction {
                value,
                cause: format!("{limit} {event}, {}, node {}", self.name, self.label(point)),
                limit,
            }
        })
    }
}
