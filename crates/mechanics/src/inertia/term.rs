//! Inertia as a term of the system.
//!
//! With r the sum of the forces of all other terms, a step of the generalised-alpha method solves
//!
//! ```text
//! M a_(n+1-α_m) + (1 - α_f) r_(n+1) + α_f r_n = 0,    x_(n+1-α) = (1 - α) x_(n+1) + α x_n.
//! ```
//!
//! Divided by 1 - α_f this is the balance r_(n+1) + g = 0 with the residual of inertia
//!
//! ```text
//! g = (M a_(n+1-α_m) + α_f r_n)/(1 - α_f).
//! ```
//!
//! The other terms are thus evaluated at the end of the step alone. Histories of plasticity, contact and friction exist only
//! there; a force evaluated at an intermediate configuration would need histories of its own. r_n is a vector of this term.

use super::prescribed_motion;
use super::scheme::Scheme;
use asperity_fem::FemError;
use asperity_fem::assembly::{Storage, Symmetry, System};
use asperity_fem::dof::Constraints;
use asperity_fem::mass::Mass;
use asperity_fem::term::{ForwardTerm, Instant, Linearized, Objection, Pattern, Refusal, Term};
use serde::{Deserialize, Serialize};

/// Displacement \[m\], velocity \[m/s\] and acceleration \[m/s²\] of all degrees of freedom.
#[derive(Clone, Debug, Default)]
pub struct Motion {
    pub u: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
}

/// State of inertia between two steps.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TermState {
    /// Velocities, accelerations and forces of the other terms, one after another.
    motion: Vec<f64>,
    fastest: f64,
    pace: Option<(Vec<f64>, f64)>,
}

/// Works of a step that the term knows \[J\].
#[derive(Clone, Copy, Debug, Default)]
pub struct Works {
    /// Energy that the method dissipates.
    pub numerical: f64,
    /// Work of prescribed motions.
    pub motions: f64,
    /// Work that forces out of balance do in a step between states of equilibrium, at its start.
    pub unbalanced: f64,
}

/// Inertia of all bodies.
#[derive(Debug)]
pub struct Inertia {
    mass: Mass,
    scheme: Scheme,
    /// Conditions of the present stage.
    constraints: Constraints,
    /// Sets of degrees of freedom that move as one in the present stage.
    groups: Vec<Vec<usize>>,
    /// Mean velocities \[m/s\] and length \[s\] of the last step between states of equilibrium.
    pace: Option<(Vec<f64>, f64)>,
    now: Motion,
    next: Motion,
    /// r_n: forces of all other terms at the last accepted state \[N\].
    held: Vec<f64>,
    /// M a_(n+1-α_m) \[N\].
    inertial: Vec<f64>,
    /// Residual evaluated last \[N\].
    own: Vec<f64>,
    /// Acceleration of the prescribed degrees of freedom at the intermediate time \[m/s²\].
    given: Vec<f64>,
    dt: f64,
    /// Displacement of the last accepted step \[m\].
    moved: Vec<f64>,
    /// Works of the last accepted step, as far as they do not depend on the forces of other terms.
    works: Works,
    /// Largest kinetic energy so far \[J\].
    fastest: f64,
    /// Largest error of a step that is accepted \[-\].
    bound: f64,
}

impl Inertia {
    /// Inertia of bodies at rest at their reference positions, but for the velocities `v` \[m/s\].
    #[must_use]
    pub fn new(mass: Mass, radius: f64, v: Vec<f64>) -> Self {
        let n = v.len();
        let zero = vec![0.0; n];
        let now = Motion { u: zero.clone(), v, a: zero.clone() };
        Self {
            mass,
            scheme: Scheme::from_radius(radius),
            constraints: Constraints::default(),
            groups: Vec::new(),
            pace: None,
            next: now.clone(),
            now,
            held: zero.clone(),
            inertial: zero.clone(),
            own: zero.clone(),
            given: zero.clone(),
            dt: 0.0,
            moved: zero,
            works: Works::default(),
            fastest: 0.0,
            bound: f64::INFINITY,
        }
    }

    /// Sets the conditions of a stage, with the sets of degrees of freedom that move as one.
    pub fn set_constraints(&mut self, constraints: Constraints, groups: Vec<Vec<usize>>) {
        (self.constraints, self.groups) = (constraints, groups);
    }

    /// Forgets how bodies passed through states of equilibrium before.
    pub fn rest(&mut self) {
        self.pace = None;
    }

    /// Begins a stage in equilibrium, with the forces `r` of all other terms at the displacements `u`.
    pub fn hold(&mut self, r: Vec<f64>, u: &[f64]) {
        self.now.u.copy_from_slice(u);
        (self.held, self.pace) = (r, None);
    }

    /// Gives bodies inertia at `time`. They begin with the velocities at which they passed through states of equilibrium,
    /// extrapolated from the last two steps, and without acceleration, since the forces are in balance. Returns the largest
    /// force of inertia that these states leave out \[N\].
    pub fn wake(&mut self, time: f64) -> f64 {
        let left_out = self.mass.times(&self.now.a).into_iter().fold(0.0, |most: f64, f| most.max(f.abs()));
        self.now.a.fill(0.0);
        prescribed_motion::rates(&self.constraints, time, time, &mut self.now.v, &mut self.now.a);
        self.fastest = self.kinetic();
        self.reject();
        left_out
    }

    /// Largest of the forces of all other terms at the accepted state \[N\].
    #[must_use]
    pub fn largest_held(&self) -> f64 {
        self.held.iter().fold(0.0, |most, f| most.max(f.abs()))
    }

    /// Forces of all other terms at the accepted state \[N\].
    #[must_use]
    pub fn held(&self) -> &[f64] {
        &self.held
    }

    /// Largest kinetic energy since bodies have inertia \[J\].
    #[must_use]
    pub fn fastest(&self) -> f64 {
        self.fastest
    }

    /// Sets the largest error with which a step is accepted \[-\].
    pub fn set_bound(&mut self, bound: f64) {
        self.bound = bound;
    }

    /// Begins a stage at `time` with the forces `r` of all other terms. Prescribed degrees of freedom take the velocities of
    /// their motions at once, and accelerations follow from the balance of forces, `M a = -r`. Returns the change of kinetic
    /// energy \[J\].
    ///
    /// # Errors
    /// If the mass matrix cannot be factored.
    pub fn start(&mut self, r: Vec<f64>, u: &[f64], time: f64) -> Result<f64, FemError> {
        let before = self.kinetic();
        self.now.u.copy_from_slice(u);
        prescribed_motion::rates(&self.constraints, time, time, &mut self.now.v, &mut self.now.a);
        self.join();
        self.balance(&r)?;
        self.held = r;
        self.fastest = self.fastest.max(self.kinetic());
        self.reject();
        Ok(self.kinetic() - before)
    }

    /// Gives each set that moves as one the velocity of its momentum.
    fn join(&mut self) {
        let momentum = self.mass.times(&self.now.v);
        for group in &self.groups {
            let mut together = vec![0.0; self.now.v.len()];
            group.iter().for_each(|&dof| together[dof] = 1.0);
            let mass = self.mass.product(&together, &together);
            let others: Vec<f64> = self.now.v.iter().zip(&together).map(|(v, one)| v * (1.0 - one)).collect();
            let own =
                group.iter().map(|&dof| momentum[dof]).sum::<f64>() - self.mass.product(&together, &others);
            group.iter().for_each(|&dof| self.now.v[dof] = own / mass);
        }
    }

    /// Solves `M a = -r` for the accelerations of the free degrees of freedom.
    fn balance(&mut self, r: &[f64]) -> Result<(), FemError> {
        let equations =
            self.constraints.equations(r.len()).with_groups(self.groups.iter().map(Vec::as_slice));
        let mut system = System::new(equations, Storage::Sparse).with_symmetry(Symmetry::Positive);
        let mut matrix = Matrix(&self.mass);
        system.factor_tangent(&mut [&mut matrix])?;
        let zero = vec![0.0; system.equations().free.len()];
        system.equations().spread(&zero, &mut self.now.a);
        let coupled = self.mass.times(&self.now.a);
        let forces: Vec<f64> = r.iter().zip(coupled).map(|(r, m)| -r - m).collect();
        let mut rhs = system.equations().gather(&forces);
        system.solve(&mut rhs)?;
        system.equations().spread(&rhs, &mut self.now.a);
        Ok(())
    }

    /// Kinetic energy of the accepted state \[J, or J/m of thickness\].
    #[must_use]
    pub fn kinetic(&self) -> f64 {
        0.5 * self.mass.product(&self.now.v, &self.now.v)
    }

    /// Displacement of the last accepted step \[m\].
    #[must_use]
    pub fn moved(&self) -> &[f64] {
        &self.moved
    }

    /// Accepted velocities \[m/s\].
    #[must_use]
    pub fn velocity(&self) -> &[f64] {
        &self.now.v
    }

    /// M a at the accepted state \[N\].
    #[must_use]
    pub fn forces(&self) -> Vec<f64> {
        self.mass.times(&self.now.a)
    }

    /// Estimated error of displacement in the step evaluated last, over the displacement of a step at the largest kinetic energy
    /// so far, both in the norm of the mass \[-\].
    #[must_use]
    pub fn share(&self) -> f64 {
        self.error_between(&self.now, &self.next)
    }

    fn error_between(&self, now: &Motion, next: &Motion) -> f64 {
        let change: Vec<f64> = next.a.iter().zip(&now.a).map(|(b, a)| b - a).collect();
        let kinetic = 0.5 * self.mass.product(&next.v, &next.v);
        let speed = (2.0 * self.fastest.max(kinetic)).sqrt();
        let error = self.scheme.error() * self.dt * self.mass.product(&change, &change).max(0.0).sqrt();
        if error == 0.0 { 0.0 } else { error / speed }
    }

    /// Takes the residual of the whole system at the accepted state, from which the forces of the other terms follow. Returns
    /// the works of the step.
    ///
    /// The work of the balance of forces over the step is
    ///
    /// ```text
    /// du·M a_(n+1-α_m) + du·(r_n + r_(n+1))/2 + (1/2 - α_f) du·(r_(n+1) - r_n) = work of prescribed motions.
    /// ```
    ///
    /// The second part is the work of the other terms by the trapezoidal rule. What the first and the last exceed the change of
    /// kinetic energy by is the dissipation of the method.
    pub fn settle(&mut self, total: &[f64]) -> Works {
        let force = self.scheme.force;
        let (mut numerical, mut motions) = (self.works.numerical, self.works.motions);
        for (k, du) in self.moved.iter().enumerate() {
            numerical += (0.5 - force) * du * (total[k] - self.own[k] - self.held[k]);
        }
        for &dof in &self.constraints.fixed {
            motions += (1.0 - force) * self.moved[dof] * total[dof];
        }
        for ((held, total), own) in self.held.iter_mut().zip(total).zip(&self.own) {
            *held = total - own;
        }
        Works { numerical, motions, unbalanced: 0.0 }
    }

    /// Takes a new state of equilibrium with displacements `u`, reached in a step of length `dt`, and the residual of the whole
    /// system there. Returns the works of the step.
    pub fn settle_at_rest(&mut self, total: &[f64], u: &[f64], dt: f64) -> Works {
        for ((moved, u), now) in self.moved.iter_mut().zip(u).zip(&self.now.u) {
            *moved = u - now;
        }
        self.now.u.copy_from_slice(u);
        self.take_pace(dt);
        let mean = |k: usize| 0.5 * self.moved[k] * (self.held[k] + total[k]);
        let motions: f64 = self.constraints.fixed.iter().map(|&dof| mean(dof)).sum();
        let all: f64 = (0..total.len()).map(mean).sum();
        self.held.copy_from_slice(total);
        Works { motions, unbalanced: all - motions, ..Works::default() }
    }

    /// Takes the mean velocity of a step between states of equilibrium, and estimates velocities and accelerations at its end.
    fn take_pace(&mut self, dt: f64) {
        let mean: Vec<f64> = self.moved.iter().map(|du| du / dt).collect();
        for (k, now) in mean.iter().enumerate() {
            self.now.a[k] =
                self.pace.as_ref().map_or(0.0, |(before, last)| 2.0 * (now - before[k]) / (dt + last));
            self.now.v[k] = now + 0.5 * dt * self.now.a[k];
        }
        self.pace = Some((mean, dt));
    }

    /// Motion at the end of a step to `u`: Newmark's formulas at free, the prescribed motion at other degrees of freedom.
    fn advance(&mut self, u: &[f64], at: Instant) {
        let (dt, Scheme { beta, gamma, force, .. }) = (at.dt, self.scheme);
        let (now, next) = (&self.now, &mut self.next);
        next.u.copy_from_slice(u);
        for (k, u) in u.iter().enumerate() {
            let (v, a) = (now.v[k], now.a[k]);
            let beyond = u - now.u[k] - dt * (v + dt * (0.5 - beta) * a);
            next.a[k] = beyond / (beta * dt * dt);
            next.v[k] = v + dt * ((1.0 - gamma) * a + gamma * next.a[k]);
        }
        let (between, during) = (at.time - force * dt, at.time - 0.5 * dt);
        prescribed_motion::rates(&self.constraints, between, during, &mut next.v, &mut self.given);
        prescribed_motion::rates(&self.constraints, at.time, during, &mut next.v, &mut next.a);
    }

    /// Acceleration at the intermediate time.
    fn between(&self) -> Vec<f64> {
        let mass = self.scheme.mass;
        let mix = |(next, now): (&f64, &f64)| (1.0 - mass) * next + mass * now;
        let mut a: Vec<f64> = self.next.a.iter().zip(&self.now.a).map(mix).collect();
        for &dof in &self.constraints.fixed {
            a[dof] = self.given[dof];
        }
        a
    }

    /// Works of the trial step that follow from the motion alone. Where a prescribed velocity jumps, the impulse belongs to the
    /// work of the motion.
    fn works(&self) -> Works {
        let (now, next) = (&self.now, &self.next);
        let mean: Vec<f64> = next.v.iter().zip(&now.v).map(|(b, a)| 0.5 * (a + b)).collect();
        let momentum = self.mass.times(&mean);
        let (mut kinetic, mut work) = (0.0, 0.0);
        for (k, momentum) in momentum.iter().enumerate() {
            kinetic += (next.v[k] - now.v[k]) * momentum;
            work += (next.u[k] - now.u[k]) * self.inertial[k];
        }
        let jump = |&dof: &usize| (next.v[dof] - now.v[dof] - self.dt * self.given[dof]) * momentum[dof];
        let impulse: f64 = self.constraints.fixed.iter().map(jump).sum();
        Works { numerical: work - kinetic + impulse, motions: impulse, unbalanced: 0.0 }
    }

    /// State between two steps.
    pub(super) fn save(&self) -> TermState {
        let motion = [self.now.v.as_slice(), &self.now.a, &self.held].concat();
        TermState { motion, fastest: self.fastest, pace: self.pace.clone() }
    }

    /// Restores a saved state with the displacements `u`. Returns false if it does not fit.
    pub(super) fn restore(&mut self, saved: &TermState, u: &[f64]) -> bool {
        let (n, motion) = (self.now.u.len(), &saved.motion);
        if motion.len() != 3 * n || u.len() != n || saved.pace.as_ref().is_some_and(|(v, _)| v.len() != n) {
            return false;
        }
        self.now = Motion { u: u.to_vec(), v: motion[..n].to_vec(), a: motion[n..2 * n].to_vec() };
        self.held = motion[2 * n..].to_vec();
        (self.fastest, self.pace) = (saved.fastest, saved.pace.clone());
        self.reject();
        true
    }
}

impl Term for Inertia {
    fn name(&self) -> &str {
        "inertia"
    }

    fn residual(&mut self, u: &[f64], at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        self.dt = at.dt;
        self.advance(u, at);
        self.inertial = self.mass.times(&self.between());
        let force = self.scheme.force;
        for (k, own) in self.own.iter_mut().enumerate() {
            *own = (self.inertial[k] + force * self.held[k]) / (1.0 - force);
            r[k] += *own;
        }
        match self.own.iter().position(|f| !f.is_finite()) {
            None => Ok(()),
            Some(dof) => Err(Refusal {
                term: self.name().into(),
                reason: format!("the force of inertia at degree of freedom {dof} is not finite"),
            }),
        }
    }

    fn objection(&self) -> Option<Objection> {
        let share = self.share();
        (share > self.bound || share.is_nan()).then(|| Objection {
            term: self.name().into(),
            reason: format!("the estimated error of displacement is {share:.1e} of that of a step"),
            position: [0.0; 3],
            rate: 0.0,
            shorter: true,
            coarse: false,
        })
    }

    fn accept(&mut self) {
        self.works = self.works();
        for ((moved, next), now) in self.moved.iter_mut().zip(&self.next.u).zip(&self.now.u) {
            *moved = next - now;
        }
        std::mem::swap(&mut self.now, &mut self.next);
        self.fastest = self.fastest.max(self.kinetic());
    }

    fn reject(&mut self) {
        self.next.clone_from(&self.now);
    }
}

impl Linearized for Inertia {
    fn pattern(&self) -> &Pattern {
        self.mass.pattern()
    }

    fn tangent(&mut self, values: &mut [f64]) {
        let Scheme { mass, force, beta, .. } = self.scheme;
        let factor = (1.0 - mass) / ((1.0 - force) * beta * self.dt * self.dt);
        values.iter_mut().zip(self.mass.values()).for_each(|(k, m)| *k = factor * m);
    }
}

impl ForwardTerm for Inertia {
    fn rate(&mut self, _at: Instant, _values: &mut [f64], _constant: &mut [f64]) -> Result<(), Refusal> {
        Err(Refusal { term: self.name().into(), reason: "forward steps have no inertia".into() })
    }
}

/// The mass matrix as a system of its own.
struct Matrix<'a>(&'a Mass);

impl Term for Matrix<'_> {
    fn name(&self) -> &'static str {
        "mass"
    }

    fn residual(&mut self, u: &[f64], _at: Instant, r: &mut [f64]) -> Result<(), Refusal> {
        r.iter_mut().zip(self.0.times(u)).for_each(|(r, m)| *r += m);
        Ok(())
    }

    fn accept(&mut self) {}

    fn reject(&mut self) {}
}

impl Linearized for Matrix<'_> {
    fn pattern(&self) -> &Pattern {
        self.0.pattern()
    }

    fn tangent(&mut self, values: &mut [f64]) {
        values.copy_from_slice(self.0.values());
    }
}
