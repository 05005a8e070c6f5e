//! Bodies of a scene joined by their interfaces.

use super::friction::Friction;
use super::{PlannedInterface, Stepping, interfaces, stepping, stress_level};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Interface as Spec, Scene};
use crate::shared::entry::Entry;
use crate::shared::loading::{self, Stage};
use crate::shared::model::{self, Model};

/// Bodies joined by interfaces, with the stages of the run that loads them.
pub struct Assembly<'s, const D: usize> {
    pub scene: &'s Scene,
    pub model: Model<D>,
    pub stages: Vec<Stage>,
    pub stepping: Stepping,
    pub interfaces: Vec<PlannedInterface>,
    /// Friction of each interface that has some.
    pub frictions: Vec<Option<Friction>>,
}

impl<'s, const D: usize> Assembly<'s, D> {
    /// The bodies, stages and interfaces of a scene.
    ///
    /// # Errors
    /// [`Diagnostic`] with the position in the scene.
    pub fn read(scene: &'s Scene) -> Result<Self, Diagnostic> {
        let model = model::build::<D>(scene)?;
        stress_level::check(scene, &model)?;
        let stages = loading::stages(scene, &model)?;
        let stepping = stepping::choose(scene)?;
        let (mut interfaces, mut frictions) = (Vec::new(), Vec::new());
        for own in Entry::all(&scene.interfaces) {
            let (planned, friction) = interfaces::plan(scene, &model, own, largest_rate(&stages))?;
            interfaces.push(planned);
            frictions.push(friction);
        }
        Ok(Self { scene, model, stages, stepping, interfaces, frictions })
    }

    /// Largest rate that the stages prescribe \[m/s\].
    pub fn largest_rate(&self) -> f64 {
        largest_rate(&self.stages)
    }

    /// Friction of the interfaces that have some.
    pub fn laws(&self) -> impl Iterator<Item = &Friction> {
        self.frictions.iter().flatten()
    }

    /// An interface in the scene.
    pub fn entry<'a>(&'a self, planned: &'a PlannedInterface) -> Entry<'a, Spec> {
        Entry::new(&planned.name, &self.scene.interfaces[&planned.name])
    }
}

fn largest_rate(stages: &[Stage]) -> f64 {
    stages.iter().map(Stage::largest_rate).fold(0.0, f64::max)
}
