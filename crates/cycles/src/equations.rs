//! The equations of a fault between two changes of its loading.
//!
//! Shear tractions change at the rate `τ̇ = A V + τ̇_load` and, where slip changes normal tractions, these change at
//! `ḟ_n = B V + ḟ_load`. Each point is then a slider without springs, driven at the rate τ̇: see
//! [`asperity_friction::fault`], and [`asperity_friction::turning`] where slip has two directions. The unknowns are m =
//! μ/a of all points, their states (point-major), their slip, and f_n where slip changes it. Shear tractions follow from
//! m, so that no traction is a small difference of large numbers. Pore pressure is a given function of time: it is
//! subtracted from f_n, and its rate from df_n/dt, at the time of each stage. Openings are functions of f_n and add to
//! both rates, see [`super::opening`]. Frictional heat adds one unknown per heated point, see [`super::heat`]: temperature
//! affects the law, and the pressure of the heated fluid is subtracted as that of an injection.

use super::components::{Components, PerPoint};
use super::floor::Floor;
use super::heat::{Around, Heat, Heated, Memory, Now, Surface};
use super::opening::{Crack, Opening};
use super::operator::Operator;
use super::pressure::Pressure;
use super::pulse::Pulse;
use asperity_friction::fault::{Drive, FaultLaw};
use asperity_ode::{Clock, Problem};
use std::cell::{Cell, RefCell};
use std::ops::Range;

/// A fault and the medium around it.
#[derive(Debug)]
pub struct Fault {
    /// Tractions that slip causes.
    pub operator: Box<dyn Operator>,
    /// Friction.
    pub law: Box<dyn FaultLaw>,
    /// Radiation damping η ≥ 0 of each point \[Pa s/m\].
    pub damping: Vec<f64>,
    /// f_n of each point at the start \[Pa\].
    pub normal: Vec<f64>,
    /// Shear tractions that are imposed.
    pub pulses: Vec<Pulse>,
    /// Pressure of injected fluid, where there is any.
    pub pressure: Option<Pressure>,
    /// Frictional heat, where it matters; not together with openings.
    pub heat: Option<Heat>,
    /// Smallest normal traction that friction uses, where any point has such a floor.
    pub floor: Option<Floor>,
    /// Tractions that openings cause, where points may open.
    pub opening: Option<Opening>,
}

/// Normal tractions and openings of the points of a fault at a moment.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pressed {
    /// Normal traction of the bodies, less the pressure of fluid; 0 where a point is open \[Pa\].
    pub bodies: Vec<f64>,
    /// f_n as friction uses it: the same, but at least the floor \[Pa\].
    pub normal: Vec<f64>,
    /// Opening \[m\]; no values where no point may open.
    pub opening: Vec<f64>,
    /// Temperature and pressure of heated points; no values where there are none.
    pub surface: Surface,
}

impl Fault {
    /// Parts that the heat of its points depends on.
    fn around(&self) -> Around<'_> {
        Around {
            heat: self.heat.as_ref(),
            law: self.law.as_ref(),
            floor: self.floor.as_ref(),
            damping: &self.damping,
        }
    }

    /// Computes the normal tractions of the points at a moment of a fault that is not heated, or at its start. The result does not depend on the previous `crack`.
    /// Where the set of open points does not converge, which makes the integration fail, the result is that of the last
    /// iterate.
    #[must_use]
    pub fn pressed(&self, at: Clock, unknowns: &[f64], crack: &mut Crack) -> Pressed {
        self.pressed_by(at, unknowns, crack, Surface::default())
    }

    fn pressed_by(&self, at: Clock, unknowns: &[f64], crack: &mut Crack, surface: Surface) -> Pressed {
        let layout = Layout::of(self);
        let total = if layout.couples_normal { &unknowns[layout.normal()] } else { &self.normal };
        let mut bodies = total.to_vec();
        if let Some(pressure) = &self.pressure {
            bodies.iter_mut().enumerate().for_each(|(p, f)| *f -= pressure.at(p, at.seconds()));
        }
        bodies.iter_mut().zip(&surface.pressure).for_each(|(f, p)| *f -= p);
        let mut opening = Vec::new();
        if let Some(of) = &self.opening {
            let _ = of.solve(crack, &mut bodies);
            opening = vec![0.0; bodies.len()];
            of.of(crack, &mut opening, &mut []);
        }
        let least = |p: usize| self.floor.as_ref().map_or(f64::NEG_INFINITY, |floor| floor.at(p));
        let normal = bodies.iter().enumerate().map(|(p, f)| f.max(least(p))).collect();
        Pressed { bodies, normal, opening, surface }
    }

    /// Rates of f_n as friction uses it \[Pa/s\] and of the openings \[m/s\], given those of the unknowns, in an
    /// integration that ends at `until` \[s\].
    #[must_use]
    pub fn pressing(
        &self,
        at: f64,
        until: f64,
        unknowns: &[f64],
        rates: &[f64],
        crack: &mut Crack,
    ) -> [Vec<f64>; 2] {
        let layout = Layout::of(self);
        let n = layout.points;
        let mut normal = vec![0.0; n];
        let mut rate = vec![0.0; n];
        if layout.couples_normal {
            normal.copy_from_slice(&unknowns[layout.normal()]);
            rate.copy_from_slice(&rates[layout.normal()]);
        } else {
            normal.copy_from_slice(&self.normal);
        }
        if let Some(pressure) = &self.pressure {
            pressure.take_off(at, until, &mut normal, &mut rate);
        }
        let mut openings = vec![0.0; n];
        if let Some(opening) = &self.opening {
            let _ = opening.solve(crack, &mut normal);
            opening.rates(crack, &mut rate, &mut vec![0.0; layout.m().end]);
            opening.of(crack, &mut vec![0.0; n], &mut openings);
        }
        if let Some(floor) = &self.floor {
            floor.hold(&mut normal, &mut rate);
        }
        [rate, openings]
    }
}

/// Layout of the unknowns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    points: usize,
    /// Number of components of slip.
    components: usize,
    states: usize,
    couples_normal: bool,
    /// Number of heated points.
    heated: usize,
}

impl Layout {
    /// The unknowns of `fault`.
    #[must_use]
    pub fn of(fault: &Fault) -> Self {
        Self {
            points: fault.law.points(),
            components: fault.law.components(),
            states: fault.law.states(),
            couples_normal: fault.operator.couples_normal(),
            heated: fault.heat.as_ref().map_or(0, Heat::points),
        }
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.heat().end
    }

    /// Number of points.
    #[must_use]
    pub fn points(&self) -> usize {
        self.points
    }

    /// Number of components of slip.
    #[must_use]
    pub fn components(&self) -> usize {
        self.components
    }

    /// m of all points, component by component.
    #[must_use]
    pub fn m(&self) -> Range<usize> {
        0..self.points * self.components
    }

    /// States, point-major.
    #[must_use]
    pub fn states(&self) -> Range<usize> {
        let first = self.m().end;
        first..first + self.points * self.states
    }

    /// Slip \[m\], component by component.
    #[must_use]
    pub fn slip(&self) -> Range<usize> {
        let first = self.states().end;
        first..first + self.points * self.components
    }

    /// f_n \[Pa\]; empty where slip does not change it.
    #[must_use]
    pub fn normal(&self) -> Range<usize> {
        let first = self.slip().end;
        first..first + if self.couples_normal { self.points } else { 0 }
    }

    /// Heat H per area of all heated points \[J/m²\]; empty without heat.
    #[must_use]
    pub fn heat(&self) -> Range<usize> {
        let first = self.normal().end;
        first..first + self.heated
    }

    /// m of these unknowns.
    #[must_use]
    pub fn m_of<'a>(&self, unknowns: &'a [f64]) -> Components<&'a [f64]> {
        Components::new(&unknowns[self.m()], self.points)
    }

    /// Slip of these unknowns \[m\].
    #[must_use]
    pub fn slip_of<'a>(&self, unknowns: &'a [f64]) -> Components<&'a [f64]> {
        Components::new(&unknowns[self.slip()], self.points)
    }

    /// States of these unknowns.
    #[must_use]
    pub fn states_of<'a>(&self, unknowns: &'a [f64]) -> PerPoint<'a> {
        PerPoint::new(&unknowns[self.states()], self.states)
    }
}

/// Working memory of an evaluation.
#[derive(Debug)]
struct Scratch {
    rate: Vec<f64>,
    shear_rate: Vec<f64>,
    /// df_n/dt, where f_n changes.
    normal_rate: Vec<f64>,
    /// f_n as friction uses it, where it differs from that of the bodies.
    normal: Vec<f64>,
    /// Points that are open.
    crack: Crack,
}

/// The equations between two changes of the loading.
#[derive(Debug)]
pub struct Equations<'a> {
    fault: &'a Fault,
    layout: Layout,
    /// Rates of the tractions of the loads \[Pa/s\].
    shear_load: Vec<f64>,
    normal_load: Vec<f64>,
    /// Time of the next change of loading or pressure \[s\].
    until: f64,
    /// a of all points, and 1/L \[1/m\]; zero without a characteristic slip.
    laws: Vec<[f64; 2]>,
    scratch: RefCell<Scratch>,
    /// Heat, where the fault is heated.
    heated: Option<RefCell<Heated>>,
    /// A point whose normal traction was not positive in a stage since the last call of [`Equations::opened`].
    opened: Cell<Option<usize>>,
    /// A point whose opening did not converge. A shorter step would not help: all further rates are NaN, and the
    /// integration fails.
    unsettled: Cell<Option<usize>>,
}

impl<'a> Equations<'a> {
    /// The equations of `fault` under loads of these rates \[Pa/s\].
    #[must_use]
    pub fn new(fault: &'a Fault, shear_load: Vec<f64>, normal_load: Vec<f64>) -> Self {
        let layout = Layout::of(fault);
        let (n, vectors) = (layout.points, layout.m().end);
        let pressurised = fault.heat.as_ref().is_some_and(Heat::pressurises);
        let own = pressurised || fault.pressure.is_some() || fault.floor.is_some() || fault.opening.is_some();
        let changes = own || layout.couples_normal;
        let zeros = |needed: bool| vec![0.0; if needed { n } else { 0 }];
        let scratch = Scratch {
            rate: vec![0.0; vectors],
            shear_rate: vec![0.0; vectors],
            normal_rate: zeros(changes),
            normal: zeros(own),
            crack: Crack::default(),
        };
        let law = |p: usize| [fault.law.scale(p), fault.law.length(p).map_or(0.0, f64::recip)];
        Self {
            fault,
            layout,
            shear_load,
            normal_load,
            until: f64::INFINITY,
            laws: (0..n).map(law).collect(),
            scratch: RefCell::new(scratch),
            heated: None,
            opened: Cell::new(None),
            unsettled: Cell::new(None),
        }
    }

    /// These equations up to the next change of loading or pressure \[s\]. Stages at that time do not yet see the change.
    #[must_use]
    pub fn until(self, end: f64) -> Self {
        Self { until: end, ..self }
    }

    /// Rates of the shear tractions of the loads \[Pa/s\].
    pub(crate) fn loading(&self) -> &[f64] {
        &self.shear_load
    }

    /// Begins from a memory of heat; without one, from the unknowns of a fault at its ambient temperature.
    pub(crate) fn remember(&mut self, memory: Option<Memory>, at: Clock, y: &[f64]) {
        if let Some(heat) = &self.fault.heat {
            let memory = memory.unwrap_or_else(|| Memory::new(heat, at, &y[self.layout.heat()]));
            self.heated = Some(RefCell::new(Heated::new(self.fault.around(), memory, heat.points())));
        }
    }

    /// The memory of heat, if the fault is heated.
    pub(crate) fn memory(&self) -> Option<Memory> {
        self.heated.as_ref().map(|heated| heated.borrow().memory().clone())
    }

    /// Commits the heat of a step that ends at `at` in the state `y`.
    pub(crate) fn commit(&self, at: Clock, y: &[f64]) {
        if let Some(heated) = &self.heated {
            heated.borrow_mut().commit(self.fault.around(), at, &self.now(y));
        }
    }

    /// State of the fault, for its heat.
    fn now<'b>(&'b self, y: &'b [f64]) -> Now<'b> {
        let l = self.layout;
        let normal = if l.couples_normal { &y[l.normal()] } else { &self.fault.normal };
        Now { m: &y[l.m()], states: &y[l.states()], normal, received: &y[l.heat()] }
    }

    /// Layout of the unknowns.
    #[must_use]
    pub fn layout(&self) -> Layout {
        self.layout
    }

    /// A point that caused a step to be rejected since the last call: its normal traction was not positive, or its
    /// opening did not converge.
    pub fn opened(&self) -> Option<usize> {
        let opened = self.opened.take();
        self.unsettled.get().or(opened)
    }

    /// Slip rates of all points at a moment \[m/s\].
    pub fn slip_rates(&self, at: Clock, y: &[f64], rate: &mut [f64]) {
        let mut heated = self.heated.as_ref().map(RefCell::borrow_mut);
        if let Some(heated) = &mut heated {
            heated.feel(self.fault.around(), at, &self.now(y));
        }
        law_of(self.fault, heated.as_deref()).slip_rates(
            0,
            &y[self.layout.m()],
            &y[self.layout.states()],
            rate,
        );
    }

    /// Computes the normal tractions of the points at a moment, as [`Fault::pressed`] does, with temperatures and pressures
    /// of heated points and their rates.
    pub fn pressed(&self, at: Clock, y: &[f64], crack: &mut Crack) -> Pressed {
        let Some(heated) = &self.heated else { return self.fault.pressed(at, y, crack) };
        let mut heated = heated.borrow_mut();
        heated.feel(self.fault.around(), at, &self.now(y));
        self.fault.pressed_by(at, y, crack, heated.surface().clone())
    }

    /// Tolerances of the unknowns for an error `tolerance` of ln V: the changes of m and of the states that move ln V
    /// by it, that share of L for slip, that share of a f_n for normal traction, and the heat that has the effect of
    /// either.
    #[must_use]
    pub fn tolerances(&self, tolerance: f64) -> Vec<f64> {
        let (l, law) = (self.layout, &self.fault.law);
        let mut all = vec![tolerance; l.size()];
        for p in 0..l.points {
            let states = l.states().start + p * l.states;
            all[states..states + l.states].fill(tolerance * law.state_scale(p));
            for slip in l.slip().skip(p).step_by(l.points) {
                all[slip] = tolerance * law.length(p).unwrap_or(1.0);
            }
            if l.couples_normal {
                all[l.normal().start + p] = tolerance * law.scale(p) * self.fault.normal[p];
            }
        }
        for (k, heat) in self
            .fault
            .heat
            .iter()
            .flat_map(|heat| heat.scales(self.fault.law.as_ref(), &self.fault.normal))
            .enumerate()
        {
            all[l.heat().start + k] = tolerance * heat;
        }
        all
    }
}

/// Share of its tolerance by which an unknown may drift in the first instants of an injection.
const DRIFT: f64 = 0.01;
/// Largest relative change of f_n in these instants. Its square is neglected; it changes m ~ 100 by less than a
/// hundredth of any practical tolerance.
const GENTLE: f64 = 1e-5;
/// Largest share of a leg that the first instants may take.
const FIRST: f64 = 1e-3;
/// Number of quarterings in the search for a time in which f_n changes little; f_n varies with the square root of time.
const QUARTERINGS: usize = 60;

impl Equations<'_> {
    /// Advances over the first instants after an injection begins or ends at `at`, when the rate of pressure is
    /// infinite. Writes the response of friction to the pressure into `y`, and returns the time over which everything
    /// else can be held constant \[s\]. `most` is the length of the leg \[s\]. None if no injection begins or ends at
    /// `at`.
    ///
    /// Over so short a time m and the states follow f_n alone, `dm = (∂ṁ/∂ḟ_n) Δf_n`, since the rates are linear in
    /// ḟ_n. Everything else drifts by at most a hundredth of its tolerance.
    pub fn first_instants(&self, at: Clock, y: &mut [f64], tolerances: &[f64], most: f64) -> Option<f64> {
        let pressure = self.fault.pressure.as_ref()?;
        if !pressure.breaks().any(|t| t == at.seconds()) {
            return None;
        }
        let (l, mut dy) = (self.layout, vec![0.0; y.len()]);
        self.evaluate(at, y, &mut dy, false);
        let mut time = FIRST * most;
        for (rate, tolerance) in dy.iter().zip(tolerances) {
            time = time.min(DRIFT * tolerance / rate.abs());
        }
        let mut crack = Crack::default();
        let before = self.fault.pressed(at, y, &mut crack);
        let normal = &before.normal;
        let mut change = |time: f64| self.fault.pressed(at.later(time), y, &mut crack);
        let less = |after: &[f64], before: &[f64]| -> Vec<f64> {
            after.iter().zip(before).map(|(b, a)| b - a).collect()
        };
        let mut after = change(time);
        for _ in 0..QUARTERINGS {
            if after.normal.iter().zip(normal).all(|(b, a)| (b - a).abs() <= GENTLE * a) {
                break;
            }
            time *= 0.25;
            after = change(time);
        }
        let changes = less(&after.normal, normal);
        let (m, states) = (l.m(), l.states());
        let (zeros, still_shear, mut shear) = (vec![0.0; l.points], vec![0.0; m.end], vec![0.0; m.end]);
        if let Some(opening) = &self.fault.opening {
            opening.sheared(&less(&after.opening, &before.opening), &mut shear);
        }
        let mut moved = vec![0.0; states.end];
        let mut still = vec![0.0; states.end];
        for (rate, shear, out) in [(&changes, &shear, &mut moved), (&zeros, &still_shear, &mut still)] {
            let drive =
                Drive { normal, normal_rate: Some(rate), shear_rate: shear, damping: &self.fault.damping };
            let (dm, ds) = out.split_at_mut(m.end);
            self.fault.law.rates(0, drive, &y[m.clone()], &y[states.clone()], dm, ds);
        }
        for ((y, moved), still) in y.iter_mut().zip(&moved).zip(&still) {
            *y += moved - still;
        }
        Some(time)
    }

    /// Evaluates the rates of the unknowns, with or without pore pressure.
    fn evaluate(&self, at: Clock, y: &[f64], dy: &mut [f64], pressurised: bool) {
        if self.unsettled.get().is_some() {
            dy.fill(f64::NAN);
            return;
        }
        let (l, fault) = (self.layout, self.fault);
        let scratch = &mut *self.scratch.borrow_mut();
        let mut heated = self.heated.as_ref().map(RefCell::borrow_mut);
        let (m, states) = (&y[l.m()], &y[l.states()]);
        if let Some(heated) = &mut heated {
            heated.feel(fault.around(), at, &self.now(y));
            heated.receive(fault.around(), at, &self.now(y), &mut dy[l.heat()]);
        }
        law_of(fault, heated.as_deref()).slip_rates(0, m, states, &mut scratch.rate);
        fault.operator.shear(&scratch.rate, &mut scratch.shear_rate);
        add(&mut scratch.shear_rate, &self.shear_load);
        fault.pulses.iter().for_each(|pulse| pulse.load(at.seconds(), &mut scratch.shear_rate));
        dy[l.slip()].copy_from_slice(&scratch.rate);
        if l.couples_normal {
            fault.operator.normal(&scratch.rate, &mut scratch.normal_rate);
            add(&mut scratch.normal_rate, &self.normal_load);
            dy[l.normal()].copy_from_slice(&scratch.normal_rate);
        }
        let mut normal = if l.couples_normal { &y[l.normal()] } else { &fault.normal };
        if !scratch.normal.is_empty() {
            scratch.normal.copy_from_slice(normal);
            let surface = heated.as_deref().map(Heated::surface);
            if let Err(point) = self.press(at, surface, scratch, pressurised) {
                self.unsettled.set(Some(point));
                dy.fill(f64::NAN);
                return;
            }
        }
        if let Some(heated) = &mut heated {
            heated.soften(fault.around(), &scratch.rate, &mut scratch.shear_rate);
            let rises = &heated.surface().pressure_rate;
            scratch.normal_rate.iter_mut().zip(rises).for_each(|(rate, rise)| *rate -= rise);
        }
        if let Some(floor) = &fault.floor {
            floor.hold(&mut scratch.normal, &mut scratch.normal_rate);
        }
        if !scratch.normal.is_empty() {
            normal = &scratch.normal;
        }
        if let Some(point) = normal.iter().position(|&f| f <= 0.0) {
            self.opened.set(Some(point));
            // A point under no pressure has no friction: the step was too long, or the fault opens.
            dy.fill(f64::NAN);
            return;
        }
        let drive = Drive {
            normal,
            normal_rate: (!scratch.normal_rate.is_empty()).then_some(&scratch.normal_rate),
            shear_rate: &scratch.shear_rate,
            damping: &fault.damping,
        };
        let (dm, rest) = dy.split_at_mut(l.m().end);
        let law = law_of(fault, heated.as_deref());
        law.rates(0, drive, m, states, dm, &mut rest[..l.points * l.states]);
    }

    /// Subtracts the pressures of fluids from normal tractions, and opens points that are then not pressed. Rates are those
    /// without heat.
    ///
    /// # Errors
    /// A point whose opening did not converge.
    fn press(
        &self,
        at: Clock,
        surface: Option<&Surface>,
        scratch: &mut Scratch,
        pressurised: bool,
    ) -> Result<(), usize> {
        let fault = self.fault;
        if !self.layout.couples_normal {
            scratch.normal_rate.fill(0.0);
        }
        if let Some(pressure) = fault.pressure.as_ref().filter(|_| pressurised) {
            pressure.take_off(at.seconds(), self.until, &mut scratch.normal, &mut scratch.normal_rate);
        }
        if let Some(surface) = surface {
            scratch.normal.iter_mut().zip(&surface.pressure).for_each(|(f, p)| *f -= p);
        }
        if let Some(opening) = &fault.opening {
            opening.solve(&mut scratch.crack, &mut scratch.normal)?;
            opening.rates(&mut scratch.crack, &mut scratch.normal_rate, &mut scratch.shear_rate);
        }
        Ok(())
    }
}

/// The law at the present temperatures.
fn law_of<'a>(fault: &'a Fault, heated: Option<&'a Heated>) -> &'a dyn FaultLaw {
    heated.and_then(Heated::law).unwrap_or(fault.law.as_ref())
}

impl Problem for Equations<'_> {
    fn size(&self) -> usize {
        self.layout.size()
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        self.evaluate(at, y, dy, true);
    }

    /// Bound of the rates of relaxation. Slip of a point loads those around it by no more than [`Operator::stiffness`],
    /// and friction resists with the slope f_n a/V + η along slip, and with a larger one across it. The norm of the
    /// columns weighted with that slope bounds the elastic relaxation; states relax with V/L.
    fn spectral_radius(&self, at: Clock, y: &[f64]) -> Option<f64> {
        let (l, fault) = (self.layout, self.fault);
        let Scratch { rate, crack, .. } = &mut *self.scratch.borrow_mut();
        self.slip_rates(at, y, rate);
        let pressed = self.pressed(at, y, crack);
        // Norm of the compliance of friction: one matrix per point, with eigenvalues along and across slip.
        let norm = (l.components as f64).sqrt();
        let rate = Components::new(rate, l.points);
        let of = |(i, k): (usize, &f64)| {
            let p = i % l.points;
            let v = rate.size(p);
            let [scale, states] = self.laws[p];
            let strength = pressed.normal[p] * scale;
            v * (norm * k / (strength + fault.damping[p] * v) + states)
        };
        Some(fault.operator.stiffness().iter().enumerate().map(of).fold(0.0, f64::max))
    }

    fn remembers(&self) -> bool {
        self.heated.is_some()
    }

    /// Not used: faults are integrated with explicit methods.
    fn jacobian(&self, _at: Clock, _y: &[f64], jac: &mut [f64]) {
        jac.fill(f64::NAN);
    }
}

fn add(sum: &mut [f64], part: &[f64]) {
    sum.iter_mut().zip(part).for_each(|(s, p)| *s += p);
}
