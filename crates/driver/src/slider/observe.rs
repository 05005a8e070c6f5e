//! Shows a run of sliders to the observers of runs with bodies: plots and progress. The sliders are the points of one
//! interface without a mesh.

use asperity_cycles::slider::{Now, Problem, WatchError, Watcher};
use asperity_output::Observer;
use asperity_output::view::{
    BodyFields, InterfaceFields, InterfaceMesh, Samples, Setup, StepRecord, StepView,
};

/// The stage there is.
const STAGE: &str = "run";

/// Passes a run on to an observer.
pub struct Show<O> {
    observer: O,
    begun: bool,
}

impl<O: Observer> Show<O> {
    /// To this observer.
    #[must_use]
    pub fn to(observer: O) -> Self {
        Self { observer, begun: false }
    }

    /// The observer.
    #[must_use]
    pub fn observer(self) -> O {
        self.observer
    }

    fn setup(problem: &Problem) -> Setup {
        let n = problem.names.len();
        let sliders = InterfaceMesh {
            in_space: false,
            states: 0,
            name: "sliders".into(),
            positions: vec![[0.0; 3]; n],
            labels: problem.names.clone(),
            areas: vec![1.0; n],
            faces: Vec::new(),
            probes: (0..n).collect(),
        };
        Setup {
            title: problem.title.clone(),
            interfaces: vec![sliders],
            stages: vec![(STAGE.into(), problem.end)],
            ..Setup::default()
        }
    }
}

impl<O: Observer> Watcher for Show<O> {
    fn now(&mut self, problem: &Problem, now: &Now<'_>) -> Result<(), WatchError> {
        if !self.begun {
            self.begun = true;
            self.observer.begin(&Self::setup(problem))?;
        }
        let time = now.at.seconds();
        let record = StepRecord { step: now.step, time, dt: now.dt, ..StepRecord::default() };
        let each = |read: fn(&asperity_friction::slider::Condition) -> f64| -> Vec<f64> {
            now.conditions.iter().map(read).collect()
        };
        let n = now.conditions.len();
        let fields = InterfaceFields {
            slip_vector: Vec::new(),
            shear_vector: Vec::new(),
            gap: vec![0.0; n],
            normal_traction: each(|c| c.normal),
            shear_traction: each(|c| c.traction),
            mean_normal_traction: each(|c| c.normal),
            mean_shear_traction: each(|c| c.traction),
            relative_displacement: now.slip.to_vec(),
            slip: now.slip.to_vec(),
            slip_rate: each(|c| c.rate),
            friction: each(|c| c.friction),
            status: vec![2; n],
            area: vec![1.0; n],
            states: Vec::new(),
        };
        let view = StepView {
            record: &record,
            stage: STAGE,
            ends_stage: false,
            end_time: problem.end,
            interfaces: &[fields],
            samples: &Samples::default(),
            fields: &BodyFields::default,
        };
        Ok(self.observer.step(&view)?)
    }
}
