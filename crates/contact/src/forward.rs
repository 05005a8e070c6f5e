//! Forward (rate-form) steps: the rate tangent at the committed state, the limits r4 to r8, and the advance by the tangent.
//!
//! At the committed state t^e = t, so with η = t/|t| and the law's answer
//! `dt = E_t (I - η⊗η) du + η (along E_t η·du + coupling df_n + constant)`, `df_n = -E_n dg_n`.

use crate::interface::Interface;
use crate::measure::{NormalPoint, ShearPoint};
use crate::shear::Shear;
use crate::vector::{add, axpy, dot, norm, scaled, sub};
use asperity_fem::term::{Fraction, Instant, Limited, Refusal};
use asperity_friction::law::{Increments, Limit, LimitKind, Present, RateBounds, Rates, Regime};

/// Points this near to an event, relative to the increment that leads to it, do not limit a step but switch with it:
/// otherwise simultaneous events of a symmetric scene would cost one step each, at fractions that are rounding.
const BAND: f64 = 1e-9;

/// Refinements of r6 along a turning traction; each one at least halves the number of wrong digits.
const REFINEMENTS: usize = 40;

/// Increments of tractions over a forward step, in the frame.
struct Step<'a> {
    normal: &'a [NormalPoint],
    gap: &'a [f64],
    increment: &'a [[f64; 2]],
    present: PresentOptions,
}

/// What a law is told beside the points.
#[derive(Clone, Copy)]
struct PresentOptions {
    dt: f64,
    rate_floor: f64,
    carry: bool,
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

    /// Linearises the law at the committed state: `d_trial`, `d_normal` and, in `traction` of the slices, the constant.
    fn linearise(&mut self, normal: &[NormalPoint], options: PresentOptions) -> Result<(), String> {
        self.gather_present(normal);
        let s = &mut self.slices;
        let n = s.index.len();
        for v in [&mut s.d_trial, &mut s.d_normal, &mut s.traction] {
            v.resize(n, 0.0);
        }
        if n > 0 {
            let present = Present {
                normal: &s.normal,
                traction: &s.trial,
                rate: &s.rate,
                regime: &s.regime,
                states: &s.old,
                stiffness: self.stiffness,
                dt: options.dt,
                rate_floor: options.rate_floor,
                carry: options.carry,
            };
            let rates = Rates { along: &mut s.d_trial, coupling: &mut s.d_normal, constant: &mut s.traction };
            self.law.rates(present, rates).map_err(|failure| failure.to_string())?;
        }
        self.points.fill(ShearPoint::default());
        for (i, &p) in s.index.iter().enumerate() {
            let resting = s.direction[i] == [0.0; 2];
            self.points[p] = ShearPoint {
                traction: self.committed.traction[p],
                direction: s.direction[i],
                // Without a direction the response along it is the response in every direction.
                ratio: if resting { s.d_trial[i] } else { 1.0 },
                d_trial: s.d_trial[i],
                d_normal: s.d_normal[i],
            };
        }
        Ok(())
    }

    /// Increment of the shear traction at entry `i` of the slices (in the frame), after `linearise`.
    fn traction_increment(&self, i: usize, step: &Step<'_>) -> [f64; 2] {
        let p = self.slices.index[i];
        let (point, du) = (&self.points[p], &step.increment[p]);
        let along = dot(&point.direction, du);
        let df = -step.normal[p].stiffness * step.gap[p];
        let mut dt = scaled(du, self.stiffness * point.ratio);
        let extra = self.stiffness * (point.d_trial - point.ratio) * along + point.d_normal * df + self.slices.traction[i];
        axpy(&mut dt, extra, &point.direction);
        dt
    }

    /// Increments over the part `from..1` of the step, with the state at `from`; fills the slices and asks the law.
    fn limit_from(&mut self, step: &Step<'_>, from: f64, bounds: RateBounds) -> Option<Limit> {
        let n = self.slices.index.len();
        let (mut normal, mut traction, mut slip) = (Vec::with_capacity(n), Vec::with_capacity(n), Vec::with_capacity(n));
        let (mut start_normal, mut start) = (Vec::with_capacity(n), Vec::with_capacity(n));
        for i in 0..n {
            let p = self.slices.index[i];
            let dt = self.traction_increment(i, step);
            let df = -step.normal[p].stiffness * step.gap[p];
            let t0: [f64; 2] = std::array::from_fn(|c| self.committed.traction[p][c] + from * dt[c]);
            start_normal.push(step.normal[p].traction + from * df);
            start.push(norm(&t0));
            normal.push((1.0 - from) * df);
            traction.push(signed_increment(&t0, &scaled(&dt, 1.0 - from)));
            slip.push((1.0 - from) * slip_increment(self.slices.regime[i], &self.points[p], &step.increment[p], &dt, self.stiffness));
        }
        let s = &self.slices;
        let present = Present {
            normal: &start_normal,
            traction: &start,
            rate: &s.rate,
            regime: &s.regime,
            states: &s.old,
            stiffness: self.stiffness,
            dt: step.present.dt,
            rate_floor: step.present.rate_floor,
            carry: step.present.carry,
        };
        self.law.limit(present, Increments { normal: &normal, traction: &traction, slip: &slip }, bounds)
    }

    /// The smallest limit of the law. Where the traction turns, the law sees the chord `|t + Δt| - |t|`, which lies above
    /// `|t + r Δt|`; its root is therefore never late, and starting again from it converges to the root of the vector form.
    fn limit(&mut self, step: &Step<'_>, bounds: RateBounds) -> Option<Limit> {
        let mut found = self.limit_from(step, 0.0, bounds)?;
        let turns = (0..self.slices.index.len()).any(|i| {
            let dt = self.traction_increment(i, step);
            across(&self.committed.traction[self.slices.index[i]], &dt) > BAND * norm(&dt)
        });
        if !turns || found.kind != LimitKind::StickToSlip {
            return Some(found);
        }
        for _ in 0..REFINEMENTS {
            let next = self.limit_from(step, found.fraction, bounds)?;
            let moved = next.fraction * (1.0 - found.fraction);
            found = Limit { fraction: found.fraction + moved, ..next };
            if moved <= BAND * found.fraction || found.kind != LimitKind::StickToSlip {
                break;
            }
        }
        Some(found)
    }
}

/// Part of `dt` perpendicular to `t`; 0 where `t` is.
fn across(t: &[f64; 2], dt: &[f64; 2]) -> f64 {
    let size = norm(t);
    if size > 0.0 { ((t[0] * dt[1] - t[1] * dt[0]) / size).abs() } else { 0.0 }
}

/// Increment of the traction as a law sees it: signed along `t` where `dt` is parallel to it, otherwise `|t + dt| - |t|`
/// (written without cancellation).
fn signed_increment(t: &[f64; 2], dt: &[f64; 2]) -> f64 {
    let size = norm(t);
    if size == 0.0 {
        return norm(dt);
    }
    let along = dot(t, dt) / size;
    if across(t, dt) <= BAND * norm(dt) {
        return along;
    }
    let end = add(t, dt);
    (2.0 * size * along + dot(dt, dt)) / (norm(&end) + size)
}

/// Slip increment: what of the tangential motion is not elastic, signed along η.
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
        PresentOptions { dt, rate_floor: self.rate_floor, carry: self.carry }
    }

    /// Linearised increments of gap and tangential displacement for the system increment `du`.
    fn slide(&mut self, du: &[f64]) {
        Self::gather(&self.nodes, du, &mut self.du);
        self.measure.slides(&self.geometry, &self.du, &mut self.slides);
    }

    /// r4 and r5 over all points.
    fn normal_limit(&self) -> Option<(f64, &'static str, usize)> {
        let mut best: Option<(f64, &'static str, usize)> = None;
        let rest = self.penalty.stiffness * self.penalty.closure;
        for (p, c) in self.contact.committed.iter().enumerate() {
            let (gap, dg) = (self.geometry.gap[p], self.slides.gap[p]);
            let found = if c.closed {
                let df = -c.stiffness * dg;
                (df < 0.0 && c.traction > rest).then(|| (c.traction / -df, "r5"))
            } else {
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

    /// Drift of forward steps: `max |t - μ(V, φ) f_n| / max |t|` over closed slipping points; 0 without any.
    ///
    /// # Errors
    /// [`Refusal`] when the law has no coefficient at the committed state.
    pub fn drift(&mut self) -> Result<f64, Refusal> {
        let Some(shear) = &mut self.shear else { return Ok(0.0) };
        shear.gather_present(&self.contact.committed);
        let s = &mut shear.slices;
        s.traction.resize(s.index.len(), 0.0);
        if let Err(failure) = shear.law.coefficient(&s.rate, &s.old, &mut s.traction) {
            return Err(Refusal { term: self.name.clone(), reason: failure.to_string() });
        }
        let (mut worst, mut largest) = (0.0f64, 0.0f64);
        for i in (0..s.index.len()).filter(|&i| s.regime[i] == Regime::Slip) {
            worst = worst.max((s.trial[i] - s.traction[i] * s.normal[i]).abs());
            largest = largest.max(s.trial[i]);
        }
        Ok(if largest > 0.0 { worst / largest } else { 0.0 })
    }

    /// Normal tractions and status after the increment.
    fn advance_normal(&mut self) {
        let rest = self.penalty.stiffness * self.penalty.closure;
        for p in 0..self.slave.len() {
            let old = self.contact.committed[p];
            let (gap, dg) = (self.geometry.gap[p], self.slides.gap[p]);
            let df = -old.stiffness * dg;
            let traction = old.traction + df;
            let closed = if old.closed {
                df >= 0.0 || traction > rest.max(BAND * old.traction)
            } else {
                // `gap` is that at the end of the step, `gap - dg` that at its start.
                self.geometry.paired[p] && dg < 0.0 && gap <= self.penalty.closure.max(BAND * (gap - dg))
            };
            let stiffness = if closed { self.penalty.stiffness } else { 0.0 };
            let traction = match (closed, old.closed) {
                (true, true) => traction,
                (true, false) => self.penalty.stiffness * (-gap).max(0.0),
                (false, _) => 0.0,
            };
            self.contact.trial[p] = NormalPoint { closed, traction, stiffness };
        }
    }

    /// Shear tractions, slip, rates and states after the increment.
    fn advance_shear(&mut self, options: PresentOptions) -> Result<(), String> {
        let Some(shear) = &mut self.shear else {
            for (p, step) in self.motion.trial.step.iter_mut().enumerate() {
                *step = if self.contact.committed[p].closed { self.slides.increment[p] } else { [0.0; 2] };
            }
            return Ok(());
        };
        let normal = &self.contact.committed;
        shear.linearise(normal, options)?;
        let step = Step { normal, gap: &self.slides.gap, increment: &self.slides.increment, present: options };
        let n = shear.slices.index.len();
        let (mut df, mut dtau, mut slip) = (Vec::with_capacity(n), Vec::with_capacity(n), Vec::with_capacity(n));
        shear.trial.copy_from(&shear.committed);
        self.motion.trial.step.fill([0.0; 2]);
        for i in 0..n {
            let p = shear.slices.index[i];
            let dt = shear.traction_increment(i, &step);
            let t = &shear.committed.traction[p];
            let regime = shear.slices.regime[i];
            df.push(-normal[p].stiffness * step.gap[p]);
            dtau.push(signed_increment(t, &dt));
            slip.push(slip_increment(regime, &shear.points[p], &step.increment[p], &dt, shear.stiffness));
            if regime == Regime::Slip {
                self.motion.trial.step[p] = sub(&step.increment[p], &scaled(&dt, shear.stiffness.recip()));
            }
            shear.trial.traction[p] = add(t, &dt);
        }
        let increments = Increments { normal: &df, traction: &dtau, slip: &slip };
        advance_law(shear, increments, options)?;
        for (p, c) in self.contact.trial.iter().enumerate().filter(|(_, c)| !c.closed) {
            debug_assert!(c.traction == 0.0);
            shear.trial.traction[p] = [0.0; 2];
            shear.trial.rate[p] = 0.0;
            shear.trial.regime[p] = Regime::Stick;
        }
        Ok(())
    }
}

/// Lets the law advance regime, rate and states of the gathered points and scatters them.
fn advance_law(shear: &mut Shear, step: Increments<'_>, options: PresentOptions) -> Result<(), String> {
    let k = shear.states();
    let s = &shear.slices;
    let present = Present {
        normal: &s.normal,
        traction: &s.trial,
        rate: &s.rate,
        regime: &s.regime,
        states: &s.old,
        stiffness: shear.stiffness,
        dt: options.dt,
        rate_floor: options.rate_floor,
        carry: options.carry,
    };
    let (mut regime, mut rate, mut states) = (s.regime.clone(), s.rate.clone(), s.old.clone());
    if !regime.is_empty() {
        shear.law.advance(present, step, &mut regime, &mut rate, &mut states).map_err(|failure| failure.to_string())?;
    }
    for (i, &p) in s.index.iter().enumerate() {
        shear.trial.regime[p] = regime[i];
        shear.trial.rate[p] = rate[i];
        shear.trial.states[p * k..(p + 1) * k].copy_from_slice(&states[i * k..(i + 1) * k]);
    }
    Ok(())
}

impl<const D: usize> Limited for Interface<D> {
    fn rate(&mut self, at: Instant, values: &mut [f64], constant: &mut [f64]) -> Result<(), Refusal> {
        self.work.tangents += 1;
        let options = self.options(at.dt);
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.contact.trial.copy_from_slice(&self.contact.committed);
        self.force.fill([0.0; D]);
        if let Some(shear) = &mut self.shear {
            self.work.law_calls += 1;
            shear
                .linearise(&self.contact.committed, options)
                .map_err(|reason| Refusal { term: self.name.clone(), reason })?;
            for (i, &p) in shear.slices.index.iter().enumerate() {
                // A traction growing by c η pulls the slave along -η.
                let c = scaled(&shear.slices.direction[i], -shear.slices.traction[i]);
                self.force[p] = self.geometry.tangential(p, &c);
            }
            self.measure.spread(&self.force, constant);
        }
        self.measure.tangent(&self.geometry, self.tractions(), values);
        Ok(())
    }

    fn limit(&mut self, du: &[f64], at: Instant) -> Option<Fraction> {
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.slide(du);
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
            Fraction { value, cause: format!("{limit} {event}, {}, node {}", self.name, self.label(point)), limit }
        })
    }

    fn advance(&mut self, du: &[f64], at: Instant) -> Result<(), Refusal> {
        self.trial_dt = at.dt;
        let options = self.options(at.dt);
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.slide(du);
        for ((new, old), d) in self.u.trial.iter_mut().zip(&self.u.committed).zip(&self.du) {
            *new = add(old, d);
        }
        if self.u.trial.iter().any(|u| !dot(u, u).is_finite()) {
            return Err(self.refuse("displacement after the step is not finite".to_owned()));
        }
        self.measure.measure(&self.u.trial, &mut self.geometry);
        self.advance_normal();
        if let Err(reason) = self.advance_shear(options) {
            return Err(self.refuse(reason));
        }
        self.accumulate();
        Ok(())
    }
}
