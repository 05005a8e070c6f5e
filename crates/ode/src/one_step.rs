//! The loop of trial and rejection common to the one-step methods of this crate.

use super::problem::System;
use super::report::{Counts, Failure};
use super::stepper::{MOST_REJECTIONS, SHORTEST, Stepper};

/// A step: its beginning, its length, and the states and rates at both ends.
#[derive(Debug, Default)]
pub(super) struct Span {
    /// Local time at the beginning \[s\].
    pub t: f64,
    /// Length \[s\].
    pub h: f64,
    pub y0: Vec<f64>,
    pub f0: Vec<f64>,
    pub y1: Vec<f64>,
    pub f1: Vec<f64>,
}

/// Outcome of a step that was tried.
#[derive(Clone, Copy, Debug)]
pub(super) enum Trial {
    /// Error over the tolerance; NaN where a value is not finite. If it is at most 1, both ends are complete.
    Error(f64),
    /// The equations were not solved: the step is retried with this fraction of the length and with whatever the method renewed
    /// meanwhile.
    Unsolved(f64),
}

/// One step of a method.
pub(super) trait Formula {
    /// Order of the error estimate, for the first step.
    fn order(&self) -> i32;

    /// Tries the step `span`: writes the state at its end, and the rates there where the error is at most 1.
    fn attempt(&mut self, system: &System<'_>, span: &mut Span) -> Trial;

    /// Completes the rates at the end of a step accepted at any error; methods whose last stage is at the end have them
    /// already.
    fn complete(&mut self, _system: &System<'_>, _span: &mut Span) {}

    /// Ratio of the next step length to `h`, after a step of length `h` with `error`.
    fn share(&mut self, h: f64, error: f64, accepted: bool, rejected_before: bool) -> f64;

    /// Called when the step last tried is accepted with `error`.
    fn accept(&mut self, _system: &System<'_>, _span: &Span, _error: f64) {}

    /// Called when the step just accepted is about to be retried with a shorter length.
    fn again(&mut self) {}

    /// Forgets everything learnt from earlier steps.
    fn forget(&mut self);

    /// True where a pair of methods takes the next step with the one for stiff equations.
    fn next_stiff(&self) -> bool {
        false
    }

    /// The state at `fraction` of the step last tried.
    fn interpolate(&self, system: &System<'_>, span: &Span, fraction: f64, y: &mut [f64]);

    /// Adds the method's counts other than steps and rates.
    fn tally(&self, _counts: &mut Counts) {}
}

/// A stepper for a formula.
pub(super) struct OneStep<F> {
    formula: F,
    span: Span,
    /// Local time at the end \[s\]: exactly the limit, where the step reaches it.
    end: f64,
    /// Length to try next \[s\].
    next: f64,
    largest: f64,
    /// True if the span is an accepted step, from whose end to continue.
    taken: bool,
    rejected: u64,
}

/// Ratio up to which the last step may exceed the intended length, to be taken whole.
const STRETCH: f64 = 1.01;
/// Factor on the step length after values that are not finite.
const HALF: f64 = 0.5;
/// Ratio of local time to step length at which the zero of local time is moved: the move costs only a few sums.
const PATIENCE: f64 = 64.0;

impl<F: Formula> OneStep<F> {
    pub fn new(formula: F, size: usize, largest: f64) -> Self {
        let zeros = || vec![0.0; size];
        let span = Span { y0: zeros(), f0: zeros(), y1: zeros(), f1: zeros(), ..Span::default() };
        Self { formula, span, end: 0.0, next: 0.0, largest, taken: false, rejected: 0 }
    }

    /// Continues from the end of the last step.
    fn proceed(&mut self, system: &System<'_>) {
        if self.taken {
            std::mem::swap(&mut self.span.y0, &mut self.span.y1);
            std::mem::swap(&mut self.span.f0, &mut self.span.f1);
            self.span.t = self.end;
            self.taken = false;
            if system.problem.remembers() {
                system.rates(self.span.t, &self.span.y0, &mut self.span.f0);
            }
        }
    }
}

fn finite(values: &[f64]) -> bool {
    values.iter().all(|v| v.is_finite())
}

impl<F: Formula> Stepper for OneStep<F> {
    fn restart(
        &mut self,
        system: &System<'_>,
        t: f64,
        y: &[f64],
        length: Option<f64>,
    ) -> Result<(), Failure> {
        self.span.y0.copy_from_slice(y);
        self.span.y1.copy_from_slice(y);
        self.span.t = t;
        self.end = t;
        self.taken = false;
        self.formula.forget();
        system.rates(t, y, &mut self.span.f0);
        if !finite(y) || !finite(&self.span.f0) {
            return Err(Failure::NotFinite);
        }
        self.span.f1.copy_from_slice(&self.span.f0);
        self.next = match length {
            Some(length) => length.min(self.largest),
            None => system.first_step(t, y, &self.span.f0, self.formula.order(), self.largest),
        };
        Ok(())
    }

    fn advance(&mut self, system: &System<'_>, limit: f64) -> Result<(), Failure> {
        self.proceed(system);
        let mut before = false;
        for _ in 0..MOST_REJECTIONS {
            let room = limit - self.span.t;
            let wanted = self.next.min(self.largest);
            let last = room <= STRETCH * wanted;
            self.span.h = if last { room } else { wanted };
            if self.span.h < SHORTEST {
                break;
            }
            let trial = self.formula.attempt(system, &mut self.span);
            let h = self.span.h;
            match trial {
                Trial::Error(error) if error <= 1.0 && finite(&self.span.y1) && finite(&self.span.f1) => {
                    self.next = h * self.formula.share(h, error, true, before);
                    self.formula.accept(system, &self.span, error);
                    self.end = if last { limit } else { self.span.t + h };
                    self.taken = true;
                    return Ok(());
                }
                Trial::Error(error) if error > 1.0 && error.is_finite() => {
                    self.next = h * self.formula.share(h, error, false, before);
                }
                Trial::Error(_) => self.next = h * HALF,
                Trial::Unsolved(share) => self.next = h * share,
            }
            before = true;
            self.rejected += 1;
        }
        Err(Failure::StepTooSmall { length: self.next.min(self.span.h) })
    }

    fn span(&self) -> (f64, f64) {
        (self.span.t, self.end)
    }

    fn start(&self) -> &[f64] {
        &self.span.y0
    }

    fn end(&self) -> &[f64] {
        if self.taken { &self.span.y1 } else { &self.span.y0 }
    }

    fn rates(&self) -> Option<(&[f64], &[f64])> {
        Some((&self.span.f0, &self.span.f1))
    }

    fn interpolate(&self, system: &System<'_>, fraction: f64, y: &mut [f64]) {
        self.formula.interpolate(system, &self.span, fraction, y);
    }

    fn retake(&mut self, system: &System<'_>, length: f64) -> bool {
        self.span.h = length;
        self.formula.again();
        let Trial::Error(error) = self.formula.attempt(system, &mut self.span) else {
            return false;
        };
        // Part of an accepted step is accepted at any error that is a number.
        if !error.is_finite() {
            return false;
        }
        if error > 1.0 {
            self.formula.complete(system, &mut self.span);
        }
        self.formula.accept(system, &self.span, error);
        self.end = self.span.t + length;
        finite(&self.span.y1) && finite(&self.span.f1)
    }

    fn next_length(&self) -> Option<f64> {
        Some(self.next)
    }

    fn next_stiff(&self) -> bool {
        self.formula.next_stiff()
    }

    fn shift(&mut self, by: f64) {
        self.span.t -= by;
        self.end -= by;
    }

    fn patience(&self) -> f64 {
        PATIENCE
    }

    fn tally(&self, counts: &mut Counts) {
        counts.rejected += self.rejected;
        self.formula.tally(counts);
    }
}
