//! An interface: measure, enforcement and friction law combined into a term of the system.

mod augmented;
mod event_limits;
mod iterate;
mod mixed;
mod response;
mod start;

use crate::average::averages;
use crate::build::{build_measure, check};
use crate::enforce::{Multipliers, Penalty, Unknowns};
use crate::error::ContactError;
use crate::measure::{Attachment, Geometry, Measure, NormalPoint, ShearPoint, Slides, Tractions};
use crate::observe::{Balance, PointFields, Work};
use crate::shear::Shear;
use crate::shift::GapShift;
use crate::spec::{Enforcement, InterfaceSpec, SlavePoint, SurfaceNode, TimeRule};
use crate::status::{Status, label};
use crate::vector::{add, axpy, dot, moment, norm, scaled, sub};
use crate::watch::Watch;
use asperity_fem::relative::RelativeDisplacements;
use asperity_fem::term::{Augmented, Instant, Linearized, Objection, Pattern, Refusal, Term};
use asperity_friction::Failure;
use asperity_friction::law::{Law, RateBounds};
use iterate::TractionIterates;
use std::sync::Arc;

/// Rounding of relative positions as a share of the scene's size. A gap or slip is a difference of averages over some tens of
/// positions. Gaps up to it count as closed with f_n = 0. The tangent of such a point is that of a pressed one, so that
/// Newton's method would cross a wider range of gaps only by many small steps.
pub const TOUCH: f64 = 1e-14;

/// Tangential motion of all points, as components in the carried frame.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Motion {
    /// Relative tangential displacement since the law became active \[m\].
    pub relative: Vec<[f64; 2]>,
    /// Slip since the law became active \[m\].
    pub slip: Vec<[f64; 2]>,
    /// Slip increment of the last step \[m\].
    pub step: Vec<[f64; 2]>,
}

impl Motion {
    fn new(n: usize) -> Self {
        Self { relative: vec![[0.0; 2]; n], slip: vec![[0.0; 2]; n], step: vec![[0.0; 2]; n] }
    }

    fn copy_from(&mut self, other: &Self) {
        self.relative.copy_from_slice(&other.relative);
        self.slip.copy_from_slice(&other.slip);
        self.step.copy_from_slice(&other.step);
    }
}

/// A committed and a trial copy.
#[derive(Clone, Debug)]
pub(crate) struct StatePair<T> {
    pub committed: T,
    pub trial: T,
}

impl<T: Clone> StatePair<T> {
    fn new(value: T) -> Self {
        Self { trial: value.clone(), committed: value }
    }
}

/// A contact interface in `D` dimensions.
#[derive(Debug)]
pub struct Interface<const D: usize> {
    pub(crate) name: String,
    pub(crate) nodes: Vec<SurfaceNode<D>>,
    pub(crate) slave: Vec<SlavePoint>,
    pub(crate) penalty: Penalty,
    pub(crate) tangential_penalty: f64,
    pub(crate) multipliers: Option<Multipliers>,
    pub(crate) unknowns: Option<Box<Unknowns>>,
    /// Tractions of iterates; `None` if the multipliers are unknowns of the system.
    iterates: Option<TractionIterates>,
    /// Partings ([`Measure::partings`]) at which bonded points were tied \[m\]; `None` if points may separate.
    pub(crate) tied: Option<Vec<f64>>,
    /// Partings at the geometry last measured; kept for bonded points alone.
    parted: Vec<f64>,
    /// Normal tractions that the penalty acts about \[Pa\], if the interface was pressed before the first step.
    pub(crate) pressed: Option<Vec<f64>>,
    /// Start gaps other than those of the meshes, if there are any.
    pub(crate) shift: Option<GapShift>,
    /// See [`Shear::touch`].
    touch: [f64; 2],
    pub(crate) rate_floor: f64,
    pub(crate) rate_bounds: RateBounds,
    pub(crate) label_rate: Option<f64>,
    rule: TimeRule,
    /// Radiation damping η \[Pa s/m\]; 0 without.
    damping: f64,
    /// Length of the last step committed under the present law \[s\], for two-step differences.
    pub(crate) previous_dt: Option<f64>,
    pub(crate) trial_dt: f64,
    pub(crate) measure: Box<dyn Measure<D>>,
    /// Displacements of the interface's nodes \[m\].
    pub(crate) u: StatePair<Vec<[f64; D]>>,
    pub(crate) geometry: Geometry<D>,
    pub(crate) contact: StatePair<Vec<NormalPoint>>,
    pub(crate) motion: StatePair<Motion>,
    pub(crate) shear: Option<Shear>,
    pub(crate) force: Vec<[f64; D]>,
    pub(crate) du: Vec<[f64; D]>,
    pub(crate) slides: Slides,
    pub(crate) fields: PointFields<D>,
    /// Buffer for shares of tractions in averages.
    shares: Vec<(usize, f64)>,
    pub(crate) work: Work,
    /// Limits on the steps.
    pub(crate) watch: Watch,
    /// Point that lost strength with slip in the last rejected trial, if any.
    pub(crate) soft: Option<usize>,
    unpaired: usize,
}

impl<const D: usize> Interface<D> {
    /// Builds the interface and pairs it in the reference configuration.
    ///
    /// # Errors
    /// [`ContactError`] when the declaration does not fit together or nothing pairs.
    pub fn new(spec: InterfaceSpec<D>) -> Result<Self, ContactError> {
        check(&spec)?;
        let n = spec.slave.len();
        let (measure, projections) = build_measure(&spec)?;
        let (enforcement, each) = (spec.enforcement, if spec.law.is_some() { D } else { 1 });
        let touch = [spec.normal_penalty, spec.tangential_penalty].map(|e| TOUCH * spec.scale * e);
        let exact = matches!(enforcement, Enforcement::AugmentedLagrangian { .. });
        let iterates = (!exact).then(|| TractionIterates::new(&spec, measure.follows()));
        let mut interface = Self {
            iterates,
            penalty: Penalty { stiffness: spec.normal_penalty, closure: TOUCH * spec.scale },
            tangential_penalty: spec.tangential_penalty,
            multipliers: Multipliers::from_enforcement(&spec.enforcement, n),
            unknowns: None,
            tied: None,
            parted: Vec::new(),
            pressed: None,
            shift: None,
            rate_floor: spec.rate_floor,
            rate_bounds: spec.rate_bounds,
            label_rate: spec.label_rate,
            rule: TimeRule::default(),
            damping: 0.0,
            previous_dt: None,
            trial_dt: 0.0,
            measure,
            u: StatePair::new(vec![[0.0; D]; spec.nodes.len()]),
            geometry: Geometry::new(n),
            contact: StatePair::new(vec![NormalPoint::default(); n]),
            motion: StatePair::new(Motion::new(n)),
            touch,
            shear: spec.law.map(|law| Shear::new(law, spec.tangential_penalty, touch, n)),
            force: vec![[0.0; D]; n],
            du: vec![[0.0; D]; spec.nodes.len()],
            slides: Slides { gap: vec![0.0; n], increment: vec![[0.0; 2]; n] },
            fields: PointFields::new(n),
            shares: Vec::new(),
            work: Work { searches: 1, projections, ..Work::default() },
            watch: Watch::default(),
            soft: None,
            unpaired: 0,
            name: spec.name,
            nodes: spec.nodes,
            slave: spec.slave,
        };
        interface.begin()?;
        if let Enforcement::AugmentedLagrangian { first, unit } = enforcement {
            let mut unknowns = Unknowns::new(first, each, unit, &interface.fields.area);
            unknowns.renew(interface.measure.as_ref(), true);
            interface.unknowns = Some(Box::new(unknowns));
        }
        Ok(interface)
    }

    /// Evaluates the reference configuration.
    fn begin(&mut self) -> Result<(), ContactError> {
        self.measure.measure(&self.u.committed, &mut self.geometry);
        let paired = self.geometry.paired.iter().filter(|p| **p).count();
        if paired == 0 {
            return Err(ContactError::NothingPairs { name: self.name.clone(), slaves: self.slave.len() });
        }
        self.unpaired = self.slave.len() - paired;
        self.tie();
        self.enforce();
        self.contact.committed.copy_from_slice(&self.contact.trial);
        self.renew_multipliers();
        self.refresh();
        Ok(())
    }

    /// Number of slave nodes without a partner in the reference configuration. They stay open; in finite sliding they may pair
    /// later.
    #[must_use]
    pub fn unpaired(&self) -> usize {
        self.unpaired
    }

    /// Mesh node of slave point `p`.
    #[must_use]
    pub fn label(&self, p: usize) -> usize {
        self.nodes[self.slave[p].node].label
    }

    /// Chooses the rule for the slip rate of implicit steps.
    pub fn set_time_rule(&mut self, rule: TimeRule) {
        self.rule = rule;
    }

    /// Sets the radiation damping η, with which a law that depends on slip rate carries `f_n μ + η V` in implicit steps \[Pa s/m\].
    /// Must be called before the first step.
    pub fn set_damping(&mut self, damping: f64) {
        self.damping = damping;
        if let Some(shear) = &mut self.shear {
            shear.damping = damping;
        }
    }

    /// Changes or removes the law. Tangential traction, slip and states restart, and slip is counted from this moment. Must be
    /// called between steps.
    pub fn set_law(&mut self, law: Option<Arc<dyn Law>>) {
        let n = self.slave.len();
        if let Some(iterates) = &mut self.iterates {
            iterates.set_law(law.as_deref());
        }
        self.shear = law.map(|law| Shear::new(law, self.tangential_penalty, self.touch, n));
        self.set_damping(self.damping);
        self.motion = StatePair::new(Motion::new(n));
        self.previous_dt = None;
        self.tie();
        if self.tied.is_some() {
            // Points are bonded without traction at their present gaps.
            self.pressed = None;
        }
        self.renew_multipliers();
        self.refresh();
    }

    /// Bonds the points at their present gaps if the law requires it, and releases them otherwise.
    fn tie(&mut self) {
        let bonded = self.shear.as_ref().is_some_and(|s| s.law.bonded());
        self.measure.partings(&self.geometry, &mut self.parted);
        self.tied = bonded.then(|| self.parted.clone());
    }

    /// Computes trial normal tractions at the geometry last measured.
    fn enforce(&mut self) {
        if self.tied.is_some() {
            self.measure.partings(&self.geometry, &mut self.parted);
        }
        let (gap, out) = (&self.geometry.gap, &mut self.contact.trial);
        let gap = self
            .shift
            .as_mut()
            .map_or(gap.as_slice(), |shift| shift.count(self.measure.as_ref(), &self.geometry));
        let multiplier = self.multipliers.as_ref().map(|m| m.normal.as_slice()).or(self.pressed.as_deref());
        match (&self.tied, multiplier) {
            (Some(tied), _) => self.penalty.bonded(&self.parted, tied, multiplier, out),
            (None, Some(multiplier)) => self.penalty.augmented(gap, multiplier, out),
            (None, None) => self.penalty.enforce(gap, out),
        }
    }

    /// Updates the blocks of the unknowns to those of the measure.
    fn follow_pattern(&mut self) {
        if let Some(unknowns) = &mut self.unknowns {
            unknowns.renew(self.measure.as_ref(), false);
        }
    }

    /// Refuses the trial if a bonded point has lost its partner.
    fn check_bonds(&self) -> Result<(), Refusal> {
        let Some(tied) = &self.tied else { return Ok(()) };
        match tied.iter().zip(&self.geometry.gap).position(|(g0, g)| g0.is_finite() && *g == f64::INFINITY) {
            None => Ok(()),
            Some(p) => Err(self.refuse(format!("node {} is tied and left the master side", self.label(p)))),
        }
    }

    /// True if a friction law is active.
    #[must_use]
    pub fn has_law(&self) -> bool {
        self.shear.is_some()
    }

    /// Overwrites the committed state variables (point-major) and shear tractions with declared initial values. Shear tractions
    /// are components along the frame of [`PointFields::tangent`]; the second is used in three dimensions only. Returns false
    /// and changes nothing if there is no law or a length does not fit.
    pub fn set_initial(&mut self, traction: &[[f64; 2]], states: &[f64]) -> bool {
        let Some(shear) = &mut self.shear else { return false };
        if traction.len() != shear.committed.traction.len() || states.len() != shear.committed.states.len() {
            return false;
        }
        shear.committed.traction.copy_from_slice(traction);
        shear.committed.states.copy_from_slice(states);
        self.renew_multipliers();
        self.refresh();
        true
    }

    /// Sets the largest prescribed rate \[m/s\], for laws without an elastic domain (see [`InterfaceSpec::label_rate`]).
    pub fn set_label_rate(&mut self, rate: Option<f64>) {
        self.label_rate = rate;
    }

    /// Sets the floor of slip rates \[m/s\] and the bounds of limit r8 for forward steps.
    pub fn set_forward(&mut self, rate_floor: f64, bounds: RateBounds) {
        self.rate_floor = rate_floor;
        self.rate_bounds = bounds;
    }

    /// Committed fields.
    #[must_use]
    pub fn points(&self) -> &PointFields<D> {
        &self.fields
    }

    /// Counts of work since construction.
    #[must_use]
    pub fn work(&self) -> Work {
        self.work
    }

    /// Gathers the displacements of the interface's nodes from the system vector.
    pub(crate) fn gather(nodes: &[SurfaceNode<D>], u: &[f64], out: &mut [[f64; D]]) {
        for (node, o) in nodes.iter().zip(out) {
            o.copy_from_slice(&u[node.dof..node.dof + D]);
        }
    }

    pub(crate) fn refuse(&self, reason: String) -> Refusal {
        Refusal { term: self.name.clone(), reason }
    }

    /// Turns a failure of a law into a refusal that names the mesh node instead of the index in the slice.
    pub(crate) fn law_refusal(&self, failure: Failure) -> Refusal {
        let entry = match failure {
            Failure::BareLogAtRest { point, .. }
            | Failure::Negative { point, .. }
            | Failure::Unstable { point, .. }
            | Failure::NonFinite { point, .. }
            | Failure::NotConverged { point, .. } => Some(point),
            _ => None,
        };
        let point = entry.zip(self.shear.as_ref()).and_then(|(k, shear)| shear.slices.index.get(k).copied());
        match point {
            Some(p) => self.refuse(format!("node {}: slave {}", self.label(p), failure.at(p))),
            None => self.refuse(failure.to_string()),
        }
    }

    /// Commits the trial history. Tangential components are transformed with frames that change.
    fn commit(&mut self) {
        self.u.committed.copy_from_slice(&self.u.trial);
        self.contact.committed.copy_from_slice(&self.contact.trial);
        self.motion.committed.copy_from(&self.motion.trial);
        if let Some(shear) = &mut self.shear {
            shear.committed.copy_from(&shear.trial);
            shear.switches.fill(0);
        }
        let (motion, shear) = (&mut self.motion.committed, &mut self.shear);
        let geometry = &self.geometry;
        self.measure.commit(geometry, &mut |p, frame| {
            let turn = |c: &mut [f64; 2]| {
                let v = geometry.tangential(p, c);
                *c = [dot(&v, &frame[0]), dot(&v, &frame[1])];
            };
            turn(&mut motion.relative[p]);
            turn(&mut motion.slip[p]);
            turn(&mut motion.step[p]);
            if let Some(shear) = shear {
                turn(&mut shear.committed.traction[p]);
            }
        });
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.renew_multipliers();
        self.previous_dt = (self.trial_dt > 0.0).then_some(self.trial_dt);
    }

    /// Recomputes the committed fields. The geometry must be that of the committed displacements.
    pub(crate) fn refresh(&mut self) {
        let (g, f) = (&self.geometry, &mut self.fields);
        f.gap.copy_from_slice(
            self.shift.as_mut().map_or(&g.gap, |shift| shift.count(self.measure.as_ref(), g)),
        );
        if let Some(tied) = &self.tied {
            self.measure.partings(g, &mut self.parted);
            let moved = self.parted.iter().zip(tied).map(|(parted, start)| parted - start);
            f.gap
                .iter_mut()
                .zip(moved)
                .filter(|(_, moved)| moved.is_finite())
                .for_each(|(g, moved)| *g = moved);
        }
        f.normal.copy_from_slice(&g.normal);
        self.measure.areas(&mut f.area);
        let motion = &self.motion.committed;
        for p in 0..self.slave.len() {
            let node = &self.nodes[self.slave[p].node];
            let u = &self.u.committed[self.slave[p].node];
            f.position[p] = if self.measure.follows() { add(&node.position, u) } else { node.position };
            f.tangent[p] = g.frame[p][0];
            let contact = &self.contact.committed[p];
            f.normal_traction[p] = contact.traction;
            f.slip[p] = g.tangential(p, &motion.slip[p]);
            f.slip_measure[p] = motion.slip[p][0];
            f.relative[p] = g.tangential(p, &motion.relative[p]);
            f.relative_measure[p] = motion.relative[p][0];
            f.slip_increment[p] = g.tangential(p, &motion.step[p]);
            f.status[p] = if contact.closed { Status::Slip } else { Status::Open };
        }
        self.refresh_shear();
        let f = &mut self.fields;
        averages(
            self.measure.as_ref(),
            (&f.normal_traction, &f.shear),
            (&mut f.mean_normal, &mut f.mean_shear),
            &mut self.shares,
        );
    }

    /// Recomputes the fields that depend on friction.
    fn refresh_shear(&mut self) {
        let (g, f) = (&self.geometry, &mut self.fields);
        let step = &self.motion.committed.step;
        let Some(shear) = &self.shear else {
            f.states.clear();
            f.states_per_point = 0;
            for (p, s) in step.iter().enumerate() {
                f.shear[p] = [0.0; D];
                f.shear_measure[p] = 0.0;
                f.friction[p] = 0.0;
                let along = if D == 2 { s[0] } else { norm(s) };
                f.slip_rate[p] = self.previous_dt.map_or(0.0, |dt| along / dt);
            }
            return;
        };
        f.states_per_point = shear.states();
        f.states.clear();
        f.states.extend_from_slice(&shear.committed.states);
        for (p, t) in shear.committed.traction.iter().enumerate() {
            let contact = &self.contact.committed[p];
            let size = norm(t);
            f.shear[p] = g.tangential(p, t);
            f.shear_measure[p] = if D == 2 { t[0] } else { size };
            let rate = shear.committed.rate[p];
            // Radiation damping takes its part of the traction.
            let strength = size - shear.damping * rate.abs();
            f.friction[p] =
                if contact.traction > 0.0 && self.tied.is_none() { strength / contact.traction } else { 0.0 };
            // Slip is along the traction. A point without traction takes the direction of its slip instead.
            let along = if t[0] == 0.0 { step[p][0] } else { t[0] };
            f.slip_rate[p] = if D == 2 { rate.copysign(rate * along) } else { rate };
            if contact.closed {
                f.status[p] = label(shear.committed.regime[p], rate, self.label_rate);
            }
        }
    }

    /// Forces and moments of the committed state.
    #[must_use]
    pub fn balance(&self) -> Balance<D> {
        let mut slave_force = [0.0; D];
        let mut master_force = [0.0; D];
        let mut total = [0.0; 3];
        let mut couple = [0.0; 3];
        let mut attachments: Vec<Attachment> = Vec::new();
        let place = |n: usize| {
            let x = &self.nodes[n].position;
            if self.measure.follows() { add(x, &self.u.committed[n]) } else { *x }
        };
        for p in 0..self.slave.len() {
            let n = &self.fields.normal[p];
            let f: [f64; D] = std::array::from_fn(|i| {
                self.fields.area[p] * (self.fields.normal_traction[p] * n[i] - self.fields.shear[p][i])
            });
            self.measure.attachments(p, &mut attachments);
            let mut apart = [0.0; D];
            for a in &attachments {
                let part = scaled(&f, a.weight);
                let side = if a.slave { &mut slave_force } else { &mut master_force };
                axpy(side, 1.0, &part);
                total = add(&total, &moment(&place(a.node), &part));
                axpy(&mut apart, a.weight, &place(a.node));
            }
            if !attachments.is_empty() {
                let arm = if self.measure.collocated() { scaled(n, dot(n, &apart)) } else { apart };
                couple = add(&couple, &moment(&arm, &f));
            }
        }
        Balance {
            slave_force,
            master_force,
            residual: add(&slave_force, &master_force),
            moment: total,
            couple,
            moment_residual: sub(&total, &couple),
        }
    }
}

impl<const D: usize> Term for Interface<D> {
    fn name(&self) -> &str {
        &self.name
    }

    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        self.work.residuals += 1;
        self.trial_dt = at.dt;
        Self::gather(&self.nodes, u, &mut self.u.trial);
        self.measure.measure(&self.u.trial, &mut self.geometry);
        self.read_multipliers(u);
        self.respond(at.dt)?;
        self.forces();
        self.returns(r);
        if let Some(p) = self.geometry.gap.iter().position(|g| g.is_nan()) {
            return Err(self.refuse(format!("gap at node {} is not a number", self.label(p))));
        }
        if let Some(p) = self.force.iter().position(|f| !dot(f, f).is_finite()) {
            return Err(self.refuse(format!(
                "force at node {} is not finite: {:?} Pa",
                self.label(p),
                self.force[p]
            )));
        }
        self.measure.spread(&self.force, r);
        Ok(())
    }

    fn prepare(&mut self, u: &[f64]) -> Result<(), Refusal> {
        Self::gather(&self.nodes, u, &mut self.u.trial);
        if self.measure.search(&self.u.trial, &mut self.work.projections) {
            self.work.searches += 1;
        } else if self.measure.follows() {
            self.work.searches_skipped += 1;
        }
        self.follow_pattern();
        Ok(())
    }

    fn objection(&self) -> Option<Objection> {
        self.objects()
    }

    fn unsettled(&self) -> f64 {
        self.iterates.as_ref().map_or(0.0, |iterates| iterates.unsettled(&self.fields.area))
    }

    fn direct(&mut self, along: &[f64]) {
        self.direct_iterates(along);
    }

    fn advance(&mut self, length: f64) {
        if let Some(iterates) = &mut self.iterates {
            iterates.advance(length);
        }
    }

    fn restart(&mut self) {
        if let Some(iterates) = &mut self.iterates {
            iterates.restart();
        }
    }

    fn error(&mut self) -> f64 {
        self.shear.as_mut().map_or(0.0, |shear| shear.error(&self.contact.committed, self.trial_dt))
    }

    fn accept(&mut self) {
        self.soft = None;
        self.restart();
        self.adopt_multipliers();
        self.commit();
        self.refresh();
    }

    fn reject(&mut self) {
        self.soft = self.softest().or(self.soft);
        self.restart();
        self.u.trial.copy_from_slice(&self.u.committed);
        self.contact.trial.copy_from_slice(&self.contact.committed);
        self.motion.trial.copy_from(&self.motion.committed);
        if let Some(shear) = &mut self.shear {
            shear.trial.copy_from(&shear.committed);
            shear.switches.fill(0);
        }
        self.measure.revert();
        self.measure.measure(&self.u.committed, &mut self.geometry);
        self.renew_multipliers();
        self.follow_pattern();
    }
}

impl<const D: usize> Linearized for Interface<D> {
    fn pattern(&self) -> &Pattern {
        match &self.unknowns {
            Some(unknowns) => &unknowns.pattern,
            None => self.measure.pattern(),
        }
    }

    fn tangent(&mut self, values: &mut [f64]) {
        self.work.tangents += 1;
        if self.unknowns.is_some() {
            self.mixed_tangent(values);
        } else {
            self.measure.tangent(&self.geometry, self.tractions(), values);
        }
    }

    /// Without the changes of shear tractions with normal tractions, which make the tangent unsymmetric. Nothing symmetric and positive
    /// is near that of multipliers that are unknowns.
    fn symmetric_tangent(&mut self, values: &mut [f64]) {
        if self.unknowns.is_some() {
            return self.mixed_tangent(values);
        }
        let uncoupled = |s: &Shear| -> Vec<ShearPoint> {
            s.points.iter().map(|point| ShearPoint { d_normal: 0.0, ..*point }).collect()
        };
        let shear = self.shear.as_ref().map(uncoupled);
        let tractions = Tractions { shear: shear.as_deref(), ..self.tractions() };
        self.measure.tangent(&self.geometry, tractions, values);
    }

    fn relative(&self) -> Option<&RelativeDisplacements> {
        if self.unknowns.is_some() { None } else { self.measure.relative() }
    }

    fn augmented(&mut self) -> Option<&mut dyn Augmented> {
        if self.multipliers.as_ref().is_some_and(|m| m.moved.is_some()) { Some(self) } else { None }
    }
}
