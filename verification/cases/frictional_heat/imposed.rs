//! A point that is heated at a given rate.

use crate::CaseError;
use asperity_cycles::heat::{Heat, Layer, Memory, Surface, Windows};
use asperity_ode::{Clock, Control, Method, Occurrence, Options, Outcome, Problem, Sink, Step, integrate};
use std::cell::RefCell;

/// Heating \[W/m²\] as a function of time \[s\] and pore pressure \[Pa\].
pub type Heating<'a> = &'a dyn Fn(f64, f64) -> f64;

/// See the module. The unknown is the heat per area.
struct Point<'a> {
    heat: &'a Heat,
    heating: Heating<'a>,
    memory: RefCell<Memory>,
    windows: RefCell<Windows>,
}

impl Point<'_> {
    /// Temperature and pressure with the heat `y`, and the heating there.
    fn surface(&self, at: Clock, y: &[f64]) -> (Surface, f64) {
        let (mut surface, memory) = (Surface::new(1), self.memory.borrow());
        let windows = &mut *self.windows.borrow_mut();
        memory.open(self.heat, at, windows);
        memory.values(self.heat, y, None, windows, &mut surface);
        let first = (self.heating)(at.seconds(), surface.pressure[0]);
        memory.values(self.heat, y, Some(&[first]), windows, &mut surface);
        let heating = (self.heating)(at.seconds(), surface.pressure[0]);
        (surface, heating)
    }
}

impl Problem for Point<'_> {
    fn size(&self) -> usize {
        1
    }

    fn rates(&self, at: Clock, y: &[f64], dy: &mut [f64]) {
        dy[0] = self.surface(at, y).1;
        self.memory.borrow_mut().begin(at, dy);
    }

    fn jacobian(&self, _: Clock, _: &[f64], jac: &mut [f64]) {
        jac.fill(f64::NAN);
    }

    fn remembers(&self) -> bool {
        true
    }
}

/// Commits each step, and looks at its end.
struct Committing<'a, 'b>(&'a Point<'b>, &'a mut dyn FnMut(f64, &Surface));

impl Sink for Committing<'_, '_> {
    fn accepted(&mut self, step: &Step<'_>) -> Control {
        let (surface, heating) = self.0.surface(step.end, step.state);
        (self.1)(step.end.seconds(), &surface);
        self.0.memory.borrow_mut().commit(self.0.heat, step.end, step.state, &[heating]);
        Control::Go
    }

    fn occurred(&mut self, _: &Occurrence) -> Control {
        Control::Go
    }
}

/// Steps of an integration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steps {
    /// This many equal ones.
    Equal(usize),
    /// With this error of the heat \[J/m²\] each.
    Error(f64),
}

/// Largest number of steps.
const MOST: usize = 1_000_000;
/// Relative tolerance, of rounding.
const ROUNDING: f64 = 1e-15;
/// A tolerance that accepts every step.
const ANY: f64 = 1e30;

/// Integrates to `end` \[s\]; `look` sees time, temperature and pressure at the end of each step. Returns the number of
/// steps.
pub fn heated(
    layer: Layer,
    heating: Heating<'_>,
    (end, steps): (f64, Steps),
    look: &mut dyn FnMut(f64, &Surface),
) -> Result<u64, CaseError> {
    let mut heat = Heat::default();
    heat.add(0..1, layer, end);
    let start = Clock::new(0.0, 0.0);
    let memory = RefCell::new(Memory::new(&heat, start, &[0.0]));
    let point = Point { heat: &heat, heating, memory, windows: RefCell::default() };
    let (length, error) = match steps {
        Steps::Equal(count) => (Some(end / count as f64), ANY),
        Steps::Error(error) => (None, error),
    };
    let options = Options {
        method: Method::Tsit5,
        rtol: ROUNDING,
        atol: vec![error],
        first_step: length,
        begin_stiff: false,
        largest_step: length,
        most_steps: MOST,
    };
    let finished = integrate(&point, start, &[0.0], end, &options, &mut Committing(&point, look));
    match finished.outcome {
        Outcome::Completed => Ok(finished.counts.steps),
        outcome => Err(format!("{outcome:?}").into()),
    }
}
