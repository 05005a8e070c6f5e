//! Observers of a run.

use crate::Interrupt;
use asperity_ode::Control;

/// Failure of an observer, such as a file that cannot be written.
pub type ObserveError = Box<dyn std::error::Error + Send + Sync>;

/// A kind of run, by what its observers see of it.
pub trait Kind {
    /// Facts known before the first step.
    type Setup;
    /// The run at the end of a step.
    type Moment<'a>;
    /// All there is to know to resume the run.
    type ResumeState;
}

/// Observes a run, and may end it.
pub trait Observer<K: Kind> {
    /// Sees the run before its first step, or before the first one after it was resumed.
    ///
    /// # Errors
    /// If something cannot be written.
    fn begin(&mut self, _setup: &K::Setup) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Sees the start of a run and the end of each accepted step.
    ///
    /// # Errors
    /// If something cannot be written.
    fn step(&mut self, moment: &K::Moment<'_>) -> Result<Control, ObserveError>;

    /// Learns that the moment seen last is the onset, the end or an extreme of an event at this point.
    ///
    /// # Errors
    /// If something cannot be written.
    fn event(&mut self, _point: usize) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Called where the run may be interrupted. Returns the reason to interrupt it; `stand` copies the state from which it can resume.
    ///
    /// # Errors
    /// If something cannot be written.
    fn pause(
        &mut self,
        _stand: &mut dyn FnMut() -> K::ResumeState,
    ) -> Result<Option<&'static str>, ObserveError> {
        Ok(None)
    }

    /// Returns what the next step asks between its iterations, if it takes long.
    fn interrupt(&self) -> Interrupt {
        Interrupt::default()
    }

    /// Receives the last good state of a run that cannot continue; [`Observer::step`] has already received it.
    ///
    /// # Errors
    /// If something cannot be written.
    fn end(&mut self, _moment: &K::Moment<'_>) -> Result<(), ObserveError> {
        Ok(())
    }

    /// Returns false if it observes nothing, so that its input need not be computed.
    fn watches(&self) -> bool {
        true
    }
}

/// Looks at nothing.
impl<K: Kind> Observer<K> for () {
    fn step(&mut self, _: &K::Moment<'_>) -> Result<Control, ObserveError> {
        Ok(Control::Go)
    }

    fn watches(&self) -> bool {
        false
    }
}

/// A closure sees each step, and may end the run.
impl<K: Kind, R: Into<Control>, F: FnMut(&K::Moment<'_>) -> R> Observer<K> for F {
    fn step(&mut self, moment: &K::Moment<'_>) -> Result<Control, ObserveError> {
        Ok(self(moment).into())
    }
}

/// Several observers, in order.
pub struct Observers<'a, K: Kind>(pub Vec<&'a mut dyn Observer<K>>);

impl<K: Kind> Observer<K> for Observers<'_, K> {
    fn begin(&mut self, setup: &K::Setup) -> Result<(), ObserveError> {
        self.0.iter_mut().try_for_each(|o| o.begin(setup))
    }

    fn step(&mut self, moment: &K::Moment<'_>) -> Result<Control, ObserveError> {
        let mut control = Control::Go;
        for observer in &mut self.0 {
            if observer.step(moment)? == Control::Stop {
                control = Control::Stop;
            }
        }
        Ok(control)
    }

    fn event(&mut self, point: usize) -> Result<(), ObserveError> {
        self.0.iter_mut().try_for_each(|o| o.event(point))
    }

    fn pause(
        &mut self,
        stand: &mut dyn FnMut() -> K::ResumeState,
    ) -> Result<Option<&'static str>, ObserveError> {
        let mut reason = None;
        for observer in &mut self.0 {
            let own = observer.pause(stand)?;
            reason = reason.or(own);
        }
        Ok(reason)
    }

    fn interrupt(&self) -> Interrupt {
        let all: Vec<Interrupt> = self.0.iter().map(|o| o.interrupt()).collect();
        Interrupt::new(move || all.iter().any(Interrupt::acts))
    }

    fn end(&mut self, moment: &K::Moment<'_>) -> Result<(), ObserveError> {
        self.0.iter_mut().try_for_each(|o| o.end(moment))
    }
}
