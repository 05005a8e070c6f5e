//! Spring-sliders: one block or several, each on a spring to a load point and possibly on springs to others, quasi-static,
//! radiation-damped or inertial. This module contains the equations; `asperity-cycles` integrates them in time.

mod block;
mod history;
mod line;
mod number;

pub use block::{Direction, Forcing, Relaxation, Response, SliderLaw};
pub use history::{History, Piece};
pub use line::Line;

use crate::Failure;
use crate::evolution::Speed;
use block::MOST_UNKNOWNS;
use std::sync::Arc;

/// One slider.
#[derive(Clone, Debug)]
pub struct Slider {
    /// Friction.
    pub law: Arc<dyn SliderLaw>,
    /// Stiffness k ≥ 0 to the load point \[Pa/m\].
    pub stiffness: f64,
    /// Radiation damping η ≥ 0 \[Pa s/m\].
    pub damping: f64,
    /// Mass per area M > 0 \[kg/m²\]; `None` without inertia.
    pub mass: Option<f64>,
    /// Normal traction f_n > 0 \[Pa\].
    pub normal: History,
}

/// A spring between two sliders.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring {
    /// The sliders, by their position in the list.
    pub between: [usize; 2],
    /// Stiffness k > 0 \[Pa/m\].
    pub stiffness: f64,
}

/// Sliders with their springs and the rate of the load point. Unknowns are ordered slider by slider: m = μ/a, the state
/// variables, and with inertia the net traction over f_n a.
#[derive(Clone, Debug)]
pub struct System {
    sliders: Vec<Slider>,
    springs: Vec<Spring>,
    load: History,
    /// First unknown of each slider, and the number of unknowns.
    starts: Vec<usize>,
    /// For each slider: the sliders it is connected to by springs, with their stiffness \[Pa/m\].
    links: Vec<Vec<(usize, f64)>>,
    /// For each slider: its slip rate, if imposed \[m/s\].
    imposed: Vec<Option<History>>,
}

impl System {
    /// Builds the system and checks the ranges.
    ///
    /// # Errors
    /// [`Failure::Parameter`].
    pub fn new(sliders: Vec<Slider>, springs: Vec<Spring>, load: History) -> Result<Self, Failure> {
        let mut starts = vec![0];
        for s in &sliders {
            not_negative("stiffness", s.stiffness)?;
            not_negative("damping", s.damping)?;
            crate::positive("normal", s.normal.least())?;
            if s.law.states() + 2 > MOST_UNKNOWNS {
                let admissible = "at most 14 state variables";
                return Err(Failure::Parameter { name: "states", value: s.law.states() as f64, admissible });
            }
            if let Some(mass) = s.mass {
                crate::positive("mass", mass)?;
            }
            starts.push(starts[starts.len() - 1] + 1 + s.law.states() + usize::from(s.mass.is_some()));
        }
        let mut links = vec![Vec::new(); sliders.len()];
        for spring in &springs {
            crate::positive("stiffness", spring.stiffness)?;
            if let Some(&slider) = spring.between.iter().find(|&&i| i >= sliders.len()) {
                let admissible = "a slider of the list";
                return Err(Failure::Parameter { name: "between", value: slider as f64, admissible });
            }
            let [a, b] = spring.between;
            if a != b {
                links[a].push((b, spring.stiffness));
                links[b].push((a, spring.stiffness));
            }
        }
        let imposed = vec![None; sliders.len()];
        Ok(Self { sliders, springs, load, starts, links, imposed })
    }

    /// Imposes the slip rate of a slider \[m/s\], as a rigid machine does: its friction follows from the law, and no spring to
    /// the load point, damping or mass acts on it.
    ///
    /// # Errors
    /// [`Failure::Parameter`] if the slider has a spring to the load point, damping or mass.
    pub fn impose(mut self, slider: usize, rate: History) -> Result<Self, Failure> {
        let s = &self.sliders[slider];
        let given = [("stiffness", s.stiffness), ("damping", s.damping), ("mass", s.mass.unwrap_or(0.0))];
        if let Some(&(name, value)) = given.iter().find(|g| g.1 != 0.0) {
            return Err(Failure::Parameter {
                name,
                value,
                admissible: "none where the slip rate is imposed",
            });
        }
        self.imposed[slider] = Some(rate);
        Ok(self)
    }

    /// The slip rate of a slider, if imposed \[m/s\].
    #[must_use]
    pub fn imposed(&self, slider: usize) -> Option<&History> {
        self.imposed[slider].as_ref()
    }

    /// Number of unknowns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.starts[self.sliders.len()]
    }

    /// The sliders.
    #[must_use]
    pub fn sliders(&self) -> &[Slider] {
        &self.sliders
    }

    /// The springs between them.
    #[must_use]
    pub fn springs(&self) -> &[Spring] {
        &self.springs
    }

    /// The rate of the load point \[m/s\].
    #[must_use]
    pub fn load(&self) -> &History {
        &self.load
    }

    /// Unknowns of one slider.
    #[must_use]
    pub fn slider_unknowns<'a>(&self, slider: usize, unknowns: &'a [f64]) -> &'a [f64] {
        &unknowns[self.starts[slider]..self.starts[slider + 1]]
    }

    /// Unknowns of one slider, mutable.
    pub fn slider_unknowns_mut<'a>(&self, slider: usize, unknowns: &'a mut [f64]) -> &'a mut [f64] {
        &mut unknowns[self.starts[slider]..self.starts[slider + 1]]
    }

    /// Times in (after, until) at which a prescribed history has a kink or a jump, in order \[s\].
    #[must_use]
    pub fn breaks(&self, after: f64, until: f64) -> Vec<f64> {
        let mut times = self.load.breaks();
        times.extend(self.sliders.iter().flat_map(|s| s.normal.breaks()));
        times.extend(self.imposed.iter().flatten().flat_map(History::breaks));
        times.retain(|&t| t > after && t < until);
        times.sort_by(f64::total_cmp);
        times.dedup();
        times
    }

    /// The smooth problem that is valid around a time between two breaks.
    #[must_use]
    pub fn segment(&self, within: f64) -> Segment<'_> {
        Segment {
            system: self,
            load: self.load.piece(within),
            normals: self.sliders.iter().map(|s| s.normal.piece(within)).collect(),
            imposed: self.imposed.iter().map(|h| h.as_ref().map(|h| h.piece(within))).collect(),
            stiffness: (0..self.sliders.len()).map(|i| self.stiffness(i)).collect(),
        }
    }

    /// K = k + Σ k_j of one slider \[Pa/m\].
    #[must_use]
    pub fn stiffness(&self, slider: usize) -> f64 {
        let springs: f64 = self.links[slider].iter().map(|link| link.1).sum();
        self.sliders[slider].stiffness + springs
    }

    /// Places of the Jacobian that may differ from zero, as row and column, in the order of [`Segment::entries`]: blocks of each slider
    /// and of the sliders connected to it by springs.
    #[must_use]
    pub fn places(&self) -> Vec<(usize, usize)> {
        let mut places = Vec::new();
        let block = |slider: usize| self.starts[slider]..self.starts[slider + 1];
        for i in 0..self.sliders.len() {
            for other in std::iter::once(i).chain(self.links[i].iter().map(|link| link.0)) {
                places.extend(block(other).flat_map(|column| block(i).map(move |row| (row, column))));
            }
        }
        places
    }

    /// Scales of the unknowns for error norms, each equivalent to a change of ln V by about one.
    #[must_use]
    pub fn scales(&self) -> Vec<f64> {
        let mut scales = vec![1.0; self.size()];
        for (i, s) in self.sliders.iter().enumerate() {
            self.slider_unknowns_mut(i, &mut scales)[1..=s.law.states()].fill(s.law.state_scale());
        }
        scales
    }

    /// Unknowns in equilibrium for given slip rates \[m/s\] and state variables (point-major). A slider with an imposed slip rate
    /// starts at that rate.
    ///
    /// # Errors
    /// [`Failure`] of the laws, naming the slider as the point.
    pub fn start(&self, rates: &[f64], states: &[Vec<f64>]) -> Result<Vec<f64>, Failure> {
        let mut unknowns = vec![0.0; self.size()];
        for (i, slider) in self.sliders.iter().enumerate() {
            let y = self.slider_unknowns_mut(i, &mut unknowns);
            y[1..=states[i].len()].copy_from_slice(&states[i]);
            let rate = self.imposed[i].as_ref().map_or(rates[i], |h| h.piece(0.0).at(0.0).0);
            y[0] = slider.law.at_rate(rate, &states[i]).map_err(|f| f.at(i))?;
        }
        Ok(unknowns)
    }

    /// Carries the unknowns over a time at which normal tractions may jump, from one segment to the next.
    ///
    /// # Errors
    /// [`Failure`] of the point solver, naming the slider as the point.
    pub fn jump(
        &self,
        time: f64,
        from: &Segment<'_>,
        to: &Segment<'_>,
        unknowns: &mut [f64],
    ) -> Result<(), Failure> {
        for (i, s) in self.sliders.iter().enumerate() {
            let (old, new) = (from.normals[i].at(time).0, to.normals[i].at(time).0);
            let y = self.slider_unknowns_mut(i, unknowns);
            if let Some(rates) = from.imposed[i].as_ref().zip(to.imposed[i].as_ref()) {
                let [before, after] = [rates.0, rates.1].map(|r| r.at(time).0);
                if (old, before) != (new, after) {
                    s.law.step_rate(y, [old, new], [before, after]).map_err(|f| f.at(i))?;
                }
            } else if old != new {
                s.law.jump(y, old, new, s.damping, s.mass.is_some()).map_err(|f| f.at(i))?;
            }
        }
        Ok(())
    }
}

fn not_negative(name: &'static str, value: f64) -> Result<f64, Failure> {
    if value >= 0.0 && value.is_finite() {
        Ok(value)
    } else {
        Err(Failure::Parameter { name, value, admissible: "0 or more, finite" })
    }
}

/// The equations between two breaks of the prescribed histories.
#[derive(Clone, Debug)]
pub struct Segment<'a> {
    system: &'a System,
    load: Piece,
    normals: Vec<Piece>,
    imposed: Vec<Option<Piece>>,
    stiffness: Vec<f64>,
}

/// Traction, friction and slip rate of a slider at an instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Condition {
    /// Slip rate V \[m/s\].
    pub rate: f64,
    /// ln |V|.
    pub log_rate: f64,
    /// Friction coefficient μ \[-\].
    pub friction: f64,
    /// Normal traction f_n \[Pa\].
    pub normal: f64,
    /// Traction T of the springs \[Pa\].
    pub traction: f64,
}

impl Segment<'_> {
    /// The smooth piece of the load point's rate.
    #[must_use]
    pub fn load(&self) -> &Piece {
        &self.load
    }

    /// The piece of the slip rate of a slider, if imposed \[m/s\].
    #[must_use]
    pub fn imposed(&self, i: usize) -> Option<&Piece> {
        self.imposed[i].as_ref()
    }

    /// Slip rate of a slider \[m/s\].
    fn rate(&self, i: usize, time: f64, unknowns: &[f64]) -> f64 {
        match &self.imposed[i] {
            Some(rate) => rate.at(time).0,
            None => self.system.sliders[i].law.slip(self.system.slider_unknowns(i, unknowns)).0.rate,
        }
    }

    /// Forcing of a slider, from the slip rates of the others \[m/s\].
    fn forcing(&self, i: usize, time: f64, load: f64, rate: impl Fn(usize) -> f64) -> Forcing {
        let slider = &self.system.sliders[i];
        let (normal, normal_rate) = self.normals[i].at(time);
        let mut pull = slider.stiffness * load;
        for &(other, stiffness) in &self.system.links[i] {
            pull += stiffness * rate(other);
        }
        Forcing {
            imposed: self.imposed[i].as_ref().map(|rate| rate.at(time)),
            normal,
            normal_rate,
            pull,
            stiffness: self.stiffness[i],
            damping: slider.damping,
            mass: slider.mass,
        }
    }

    /// Rates of change of the unknowns at a time \[s\].
    pub fn rates(&self, time: f64, unknowns: &[f64], rates: &mut [f64]) {
        let (load, slips) = (self.load.at(time).0, self.linked(time, unknowns));
        for (i, slider) in self.system.sliders.iter().enumerate() {
            let forcing = self.forcing(i, time, load, |other| slips[other]);
            slider.law.equations(
                &forcing,
                self.system.slider_unknowns(i, unknowns),
                self.system.slider_unknowns_mut(i, rates),
            );
        }
    }

    /// Slip rates of all sliders, each computed once regardless of its number of springs; empty without springs.
    fn linked(&self, time: f64, unknowns: &[f64]) -> Vec<f64> {
        let count = if self.system.springs.is_empty() { 0 } else { self.system.sliders.len() };
        (0..count).map(|i| self.rate(i, time, unknowns)).collect()
    }

    /// Writes the rates of one slider at their positions; only its springs are visited.
    pub fn rates_of(&self, i: usize, time: f64, unknowns: &[f64], rates: &mut [f64]) {
        let forcing = self.forcing(i, time, self.load.at(time).0, |other| self.rate(other, time, unknowns));
        let law = &self.system.sliders[i].law;
        law.equations(
            &forcing,
            self.system.slider_unknowns(i, unknowns),
            self.system.slider_unknowns_mut(i, rates),
        );
    }

    /// Their Jacobian, column-major.
    pub fn jacobian(&self, time: f64, unknowns: &[f64], jacobian: &mut [f64]) {
        let n = unknowns.len();
        jacobian.fill(0.0);
        self.entries(time, unknowns, |(row, column), value| jacobian[column * n + row] += value);
    }

    /// Calls `put` with the entries of the Jacobian that may differ from zero, as row, column and value. Entries at the same place
    /// add up. Their places and their order are those of [`System::places`] at all times.
    pub fn entries(&self, time: f64, unknowns: &[f64], mut put: impl FnMut((usize, usize), f64)) {
        let (load, slips) = (self.load.at(time).0, self.linked(time, unknowns));
        let (mut slopes, mut by_pull) = ([0.0; MOST_UNKNOWNS], [0.0; MOST_UNKNOWNS]);
        for (i, slider) in self.system.sliders.iter().enumerate() {
            let forcing = self.forcing(i, time, load, |other| slips[other]);
            let (y, first) = (self.system.slider_unknowns(i, unknowns), self.system.starts[i]);
            let n = y.len();
            for column in 0..n {
                slider.law.gradient(&forcing, y, Direction::Unknown(column), &mut slopes[..n]);
                for (row, &slope) in slopes[..n].iter().enumerate() {
                    put((first + row, first + column), slope);
                }
            }
            if self.system.links[i].is_empty() {
                continue;
            }
            slider.law.gradient(&forcing, y, Direction::Pull, &mut by_pull[..n]);
            for &(other, stiffness) in &self.system.links[i] {
                let theirs = self.system.slider_unknowns(other, unknowns);
                let slopes = &mut slopes[..theirs.len()];
                if self.imposed[other].is_some() {
                    slopes.fill(0.0);
                } else {
                    self.system.sliders[other].law.slip_slopes(theirs, slopes);
                }
                for (column, slope) in slopes.iter().enumerate() {
                    for (row, by_pull) in by_pull[..n].iter().enumerate() {
                        let place = (first + row, self.system.starts[other] + column);
                        put(place, stiffness * by_pull * slope);
                    }
                }
            }
        }
    }

    /// Slip rate and friction coefficient of a slider.
    #[must_use]
    pub fn slip(&self, i: usize, time: f64, unknowns: &[f64]) -> (Speed, f64) {
        let (law, y) = (&self.system.sliders[i].law, self.system.slider_unknowns(i, unknowns));
        let Some(piece) = &self.imposed[i] else { return law.slip(y) };
        let rate = piece.at(time).0;
        let m = law.at_rate(rate, &y[1..=law.states()]).unwrap_or(y[0]);
        (Speed { rate, log: rate.abs().ln() }, m * law.scale())
    }

    /// Condition of a slider.
    #[must_use]
    pub fn condition(&self, i: usize, time: f64, unknowns: &[f64]) -> Condition {
        let (slider, y) = (&self.system.sliders[i], self.system.slider_unknowns(i, unknowns));
        let (speed, friction) = self.slip(i, time, unknowns);
        let normal = self.normals[i].at(time).0;
        let net = if slider.mass.is_some() { y[y.len() - 1] * normal * slider.law.scale() } else { 0.0 };
        Condition {
            rate: speed.rate,
            log_rate: speed.log,
            friction,
            normal,
            traction: normal * friction + slider.damping * speed.rate + net,
        }
    }

    /// dV/dt of a slider over |V| \[1/s\]: positive where V increases.
    #[must_use]
    pub fn acceleration(&self, i: usize, unknowns: &[f64], rates: &[f64]) -> f64 {
        let y = self.system.slider_unknowns(i, unknowns);
        let mut slopes = [0.0; MOST_UNKNOWNS];
        let rate = self.system.sliders[i].law.slip_slopes(y, &mut slopes[..y.len()]);
        let gained: f64 = slopes.iter().zip(self.system.slider_unknowns(i, rates)).map(|(a, b)| a * b).sum();
        gained / rate.abs()
    }
}
