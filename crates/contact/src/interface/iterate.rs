//! Tractions as unknowns of Newton's method beside displacements, for penalties and for multipliers between solutions.
//!
//! The equations of a point are those of its penalties, written for tractions λ that are unknowns: with the traction
//! `φ = p - E_n g_n` of a gap, p the multiplier, and the share α = c/E of a softer stiffness c in each penalty,
//!
//! `λ_n = φ` where `π = (1 - α_n) λ_n + α_n φ > 0` and 0 elsewhere, `λ_t = t`,
//! t the response of the law to the trial `(1 - α_t) λ_t + α_t t_0 + c_t Δu` under π, behind a spring c_t.
//!
//! Both have the solutions of `λ_n = <φ>` and of the trial `t_0 + E_t Δu`, which α = 1 restores. What differs is the way there.
//! Displacements of an iterate are off by far more than a penalty closes or a point that sticks moves, so that multiplied by
//! penalties they open what is pressed and turn what slips. Tractions of an iterate are those of its linear equations, and off
//! by little. A stiffness of the bodies over a cell weighs displacements against tractions, whatever the penalties.
//!
//! Points do not share these unknowns, which are eliminated. With `∂t = Y ∂trial + η t_n ∂π` and M = I - (1 - α_t) Y the
//! forces and the tangent of the reduced system are those of the tractions
//!
//! `f_n = φ`, `f_t = λ_t + M⁻¹ (t - λ_t + t_n η (φ - π))` and `∂f_t = M⁻¹ (c_t Y ∂Δu + t_n η ∂φ)`,
//!
//! and λ of the next iterate is f at the displacements of this one, with the linear change along the step. Forces that follow the
//! motion have λ in their geometric stiffness. Iterations start from tractions of the penalties themselves.
//!
//! Stresses at integration points as unknowns of this kind: Magisano, D., Leonetti, L. and Garcea, G. (2017), How to improve
//! efficiency and robustness of the Newton method in geometrically non-linear structural problem discretized via
//! displacement-based finite elements, Computer Methods in Applied Mechanics and Engineering 313, 986-1005.

use crate::measure::{NormalPoint, ShearPoint, Slides};
use crate::shear::TrialSpring;
use crate::spec::InterfaceSpec;
use crate::vector::{add, axpy, dot, norm, scaled, sub};
use asperity_friction::law::Law;

/// Tractions of a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct PointTraction {
    /// Normal traction, of either sign within iterations \[Pa\].
    pub normal: f64,
    /// Shear traction, components in the carried frame \[Pa\].
    pub shear: [f64; 2],
}

impl PointTraction {
    /// The sum with a multiple of a change.
    fn moved(&self, length: f64, change: &Self) -> Self {
        let mut shear = self.shear;
        axpy(&mut shear, length, &change.shear);
        Self { normal: self.normal + length * change.normal, shear }
    }

    fn minus(&self, other: &Self) -> Self {
        Self { normal: self.normal - other.normal, shear: sub(&self.shear, &other.shear) }
    }
}

/// Penalties of an interface, and the softer stiffnesses by which iterates are told to close and to slip \[Pa/m\].
#[derive(Clone, Copy, Debug)]
struct Stiffnesses {
    normal: f64,
    tangential: f64,
    /// E/h of the softer side.
    young_per_size: f64,
}

/// Tractions of the iterates of a step. The symbols are those of the module.
#[derive(Clone, Debug)]
pub(crate) struct TractionIterates {
    stiffness: Stiffnesses,
    /// True if gaps are not linear in displacements, so that normal tractions are unknowns whatever the law.
    follows: bool,
    /// α_n and α_t of the present law.
    share: [f64; 2],
    /// Length of the step along the last direction; `None` before the first.
    length: Option<f64>,
    /// λ where the last direction was found, and its change along the whole of it.
    base: Vec<PointTraction>,
    change: Vec<PointTraction>,
    /// λ.
    present: Vec<PointTraction>,
    /// f.
    pub force: Vec<PointTraction>,
    /// λ_n and the normal stiffness of each point, for the tangent.
    pub normal: Vec<NormalPoint>,
    /// First part of trials, `(1 - α_t) λ_t + α_t t_0`.
    from: Vec<[f64; 2]>,
}

impl TractionIterates {
    pub fn new<const D: usize>(spec: &InterfaceSpec<D>, follows: bool) -> Self {
        let mut iterates = Self {
            stiffness: Stiffnesses {
                normal: spec.normal_penalty,
                tangential: spec.tangential_penalty,
                young_per_size: spec.young_per_size,
            },
            follows,
            share: [1.0; 2],
            length: None,
            base: Vec::new(),
            change: Vec::new(),
            present: Vec::new(),
            force: Vec::new(),
            normal: Vec::new(),
            from: Vec::new(),
        };
        iterates.set_law(spec.law.as_deref());
        iterates
    }

    /// Chooses α for a law. A law whose strength follows slip may have no answer behind a soft spring, and one that follows rates
    /// has no kink.
    pub fn set_law(&mut self, law: Option<&dyn Law>) {
        let Stiffnesses { normal, tangential, young_per_size } = self.stiffness;
        let plastic = |law: &dyn Law| law.has_elastic_domain() && law.states() == 0;
        let softer = |penalty: f64| if penalty > young_per_size { young_per_size / penalty } else { 1.0 };
        let bonded = law.is_some_and(|law| law.bonded());
        let yields = law.is_some_and(plastic);
        self.share = [
            if (self.follows || yields) && !bonded { softer(normal) } else { 1.0 },
            if yields && !bonded { softer(tangential) } else { 1.0 },
        ];
        self.restart();
    }

    /// True if iterates differ from those of the penalties under the present law.
    pub fn differ(&self) -> bool {
        self.share != [1.0; 2]
    }

    /// True once tractions are unknowns.
    pub fn runs(&self) -> bool {
        self.length.is_some()
    }

    /// Returns to tractions of the penalties themselves.
    pub fn restart(&mut self) {
        self.length = None;
    }

    /// Moves the unknowns to a length along the last direction.
    pub fn advance(&mut self, length: f64) {
        if self.length.is_some() {
            self.length = Some(length);
        }
    }

    /// Takes a direction, along which gaps and tangential increments change by `slides`, with the points of the tangent from which
    /// it was found.
    pub fn direct(&mut self, slides: &Slides, contact: &[NormalPoint], shear: Option<&[ShearPoint]>) {
        if !self.runs() {
            self.start(contact, shear);
        }
        for (p, c) in contact.iter().enumerate() {
            self.base[p] = self.present[p];
            let mut change = self.force[p].minus(&self.base[p]);
            if c.closed {
                let df = -c.stiffness * slides.gap[p];
                change.normal += df;
                if let Some(shear) = shear {
                    add_change(
                        &mut change.shear,
                        self.stiffness.tangential,
                        &shear[p],
                        &slides.increment[p],
                        df,
                    );
                }
            }
            self.change[p] = change;
        }
        self.length = Some(0.0);
    }

    /// Starts from the tractions of the penalties.
    fn start(&mut self, contact: &[NormalPoint], shear: Option<&[ShearPoint]>) {
        let n = contact.len();
        for v in [&mut self.base, &mut self.change, &mut self.present, &mut self.force] {
            v.resize(n, PointTraction::default());
        }
        self.normal.resize(n, NormalPoint::default());
        self.from.resize(n, [0.0; 2]);
        for (p, c) in contact.iter().enumerate() {
            let shear = shear.map_or([0.0; 2], |shear| shear[p].traction);
            self.force[p] = PointTraction { normal: c.traction, shear };
        }
        self.present.copy_from_slice(&self.force);
    }

    /// Decides by the traction π of each paired point whether it is closed, and leaves π in its place. `push` is φ \[Pa\]; a
    /// point closes from -`rest` \[Pa\].
    pub fn close(&mut self, push: impl Fn(usize) -> f64, rest: f64, contact: &mut [NormalPoint]) {
        let Some(length) = self.length else { return };
        for (p, c) in contact.iter_mut().enumerate() {
            self.present[p] = self.base[p].moved(length, &self.change[p]);
            let push = push(p);
            if self.share[0] == 1.0 {
                self.force[p].normal = c.traction;
                continue;
            }
            if push == f64::NEG_INFINITY {
                self.force[p].normal = 0.0;
                *c = NormalPoint::default();
                continue;
            }
            let (share, stiffness) = (self.share[0], self.stiffness.normal);
            let told = (1.0 - share) * self.present[p].normal + share * push;
            let closed = told >= -rest;
            self.force[p].normal = if closed { push } else { 0.0 };
            *c = NormalPoint {
                closed,
                traction: if closed { told.max(0.0) } else { 0.0 },
                stiffness: if closed { stiffness } else { 0.0 },
            };
        }
    }

    /// Trials of the law from the tractions `t_0`, if they are softer than those of the penalty.
    pub fn trial_spring(&mut self, start: &[[f64; 2]]) -> Option<TrialSpring<'_>> {
        let share = self.share[1];
        if !self.runs() || share == 1.0 {
            return None;
        }
        for ((from, l), t) in self.from.iter_mut().zip(&self.present).zip(start) {
            *from = scaled(&l.shear, 1.0 - share);
            axpy(from, share, t);
        }
        Some(TrialSpring { from: Some(&self.from), stiffness: share * self.stiffness.tangential })
    }

    /// Finds the forces and the points of the tangent from the response of the law under π.
    pub fn reduce(&mut self, contact: &[NormalPoint], shear: Option<&mut [ShearPoint]>) {
        if !self.runs() {
            return;
        }
        for ((n, c), l) in self.normal.iter_mut().zip(contact).zip(&self.present) {
            *n = NormalPoint { traction: l.normal, ..*c };
        }
        let Some(shear) = shear else { return };
        for (p, s) in shear.iter_mut().enumerate() {
            let (l, f) = (&self.present[p].shear, &mut self.force[p]);
            f.shear = [0.0; 2];
            if contact[p].closed {
                let mut error = sub(&s.traction, l);
                axpy(&mut error, s.d_normal * (f.normal - contact[p].traction), &s.direction);
                f.shear = add(l, &solve(s, self.share[1], &error));
                s.traction = *l;
            }
        }
    }

    /// Largest difference between λ and f, times the areas of the points \[N\].
    pub fn unsettled(&self, areas: &[f64]) -> f64 {
        if !self.runs() {
            return 0.0;
        }
        let [normal, tangential] = self.share.map(|share| share < 1.0);
        let each = self.force.iter().zip(&self.present).zip(areas).map(|((f, l), area)| {
            let error = f.minus(l);
            let (n, t) = (f64::from(normal) * error.normal.abs(), f64::from(tangential) * norm(&error.shear));
            area * (n + t)
        });
        each.fold(0.0, |a, b| if b > a || b.is_nan() { b } else { a })
    }
}

/// Adds the change of a shear traction with a tangential increment and the change `df` of the normal traction.
fn add_change(t: &mut [f64; 2], stiffness: f64, s: &ShearPoint, du: &[f64; 2], df: f64) {
    axpy(t, stiffness * s.ratio, du);
    let along = stiffness * (s.d_trial - s.ratio) * dot(&s.direction, du) + s.d_normal * df;
    axpy(t, along, &s.direction);
}

/// Applies M⁻¹ to `error`, and changes the point of the law to that of the reduced system.
fn solve(s: &mut ShearPoint, share: f64, error: &[f64; 2]) -> [f64; 2] {
    let across = (1.0 - (1.0 - share) * s.ratio).recip();
    let along = (1.0 - (1.0 - share) * s.d_trial).recip();
    let mut solved = scaled(error, across);
    axpy(&mut solved, (along - across) * dot(error, &s.direction), &s.direction);
    s.ratio *= share * across;
    s.d_trial *= share * along;
    s.d_normal *= along;
    solved
}
