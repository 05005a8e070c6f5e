//! An observer that forwards to several others.

use super::view::{BodyFields, Setup, StepView, Writer};
use crate::OutputError;
use std::cell::OnceCell;

/// Forwards to its observers in the order given. The fields of the bodies are recovered at most once per step, regardless of the
/// number of observers that request them.
#[derive(Default)]
pub struct Multi<'a> {
    observers: Vec<&'a mut dyn Writer>,
}

impl<'a> Multi<'a> {
    /// Forwards to observers owned by the caller.
    #[must_use]
    pub fn new(observers: Vec<&'a mut dyn Writer>) -> Self {
        Self { observers }
    }

    /// Adds an observer.
    pub fn push(&mut self, observer: &'a mut dyn Writer) {
        self.observers.push(observer);
    }
}

impl Writer for Multi<'_> {
    fn begin(&mut self, setup: &Setup) -> Result<(), OutputError> {
        self.observers.iter_mut().try_for_each(|observer| observer.begin(setup))
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        let recovered = OnceCell::new();
        let once = || recovered.get_or_init(|| (view.fields)()).clone();
        let shared = sharing(view, &once);
        self.observers.iter_mut().try_for_each(|observer| observer.step(&shared))
    }

    fn end(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        let recovered = OnceCell::new();
        let once = || recovered.get_or_init(|| (view.fields)()).clone();
        let shared = sharing(view, &once);
        self.observers.iter_mut().try_for_each(|observer| observer.end(&shared))
    }
}

/// The same view with fields that are recovered only once.
fn sharing<'a>(view: &StepView<'a>, fields: &'a dyn Fn() -> BodyFields) -> StepView<'a> {
    StepView {
        record: view.record,
        stage: view.stage,
        ends_stage: view.ends_stage,
        end_time: view.end_time,
        interfaces: view.interfaces,
        samples: view.samples,
        energy: view.energy.clone(),
        fields,
    }
}
