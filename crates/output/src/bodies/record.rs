//! A run kept in memory: records of all steps, histories at points of the interfaces, and states at the ends of stages.

use super::view::{BodyFields, InterfaceFields, Samples, Setup, StepRecord, StepView, Writer};
use crate::error::{OutputError, expect_length};
use crate::numbers;
use crate::tables::energy::ENERGIES;
use serde::{Deserialize, Serialize};

/// Histories at one slave node, one value per step (see [`InterfaceFields`] for signs).
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct PointHistory {
    /// Index of the slave node in the interface.
    pub node: usize,
    /// Reference position of the node \[m\].
    pub position: [f64; 3],
    /// Relative tangential displacement \[m\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub relative_displacement: Vec<f64>,
    /// Slip \[m\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip: Vec<f64>,
    /// Slip rate \[m/s\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip_rate: Vec<f64>,
    /// Friction coefficient \[-\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub friction: Vec<f64>,
    /// Normal traction \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub normal_traction: Vec<f64>,
    /// Shear traction \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub shear_traction: Vec<f64>,
    /// Tributary area of the node \[m², m\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub area: Vec<f64>,
    /// First state variable; empty without one.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub state: Vec<f64>,
}

/// Histories at the recorded points of one interface.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct InterfaceHistory {
    /// Name of the interface.
    pub name: String,
    /// Points in the order of the probes, or of the slave nodes if all are kept.
    pub points: Vec<PointHistory>,
}

/// State at the end of a stage.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct StageEnd {
    /// Stage number, from 0.
    pub stage: usize,
    /// Stage name.
    pub name: String,
    /// Time \[s\].
    pub time: f64,
    /// Fields of the interfaces, in the order of [`Setup::interfaces`].
    pub interfaces: Vec<InterfaceFields>,
    /// Fields of the bodies, if requested.
    pub bodies: Option<BodyFields>,
}

/// Keeps a run in memory.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Recorder {
    all_nodes: bool,
    with_bodies: bool,
    /// Announcement of the run, given whenever it begins or is resumed.
    #[serde(skip)]
    setup: Setup,
    records: Vec<StepRecord>,
    times: Vec<f64>,
    samples: Vec<Samples>,
    #[serde(default)]
    energies: Vec<[f64; ENERGIES.len()]>,
    histories: Vec<InterfaceHistory>,
    stage_ends: Vec<StageEnd>,
}

impl Recorder {
    /// Keeps step records, histories at the probes, and interface fields at the ends of stages.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Also keeps the fields of the bodies at the ends of stages, at the cost of one recovery each.
    #[must_use]
    pub fn with_bodies(mut self) -> Self {
        self.with_bodies = true;
        self
    }

    /// Keeps histories at every slave node instead of at the probes.
    #[must_use]
    pub fn at_all_nodes(mut self) -> Self {
        self.all_nodes = true;
        self
    }

    /// Continues the record of a resumed run, which is announced again.
    ///
    /// # Errors
    /// If the announcement does not fit the record.
    pub fn resume(&mut self, setup: &Setup) -> Result<(), OutputError> {
        check_probes(setup)?;
        expect_length("interfaces kept", setup.interfaces.len(), self.histories.len())?;
        self.setup = setup.clone();
        Ok(())
    }

    /// Keeps the last state of a stage.
    fn end_stage(&mut self, view: &StepView<'_>) {
        self.stage_ends.push(StageEnd {
            stage: view.record.stage,
            name: view.stage.to_string(),
            time: view.record.time,
            interfaces: view.interfaces.to_vec(),
            bodies: self.with_bodies.then(|| (view.fields)()),
        });
    }

    /// Announcement of the run before its first step.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }

    /// Records of all accepted steps.
    #[must_use]
    pub fn records(&self) -> &[StepRecord] {
        &self.records
    }

    /// Times of all accepted steps \[s\], the abscissa of the histories.
    #[must_use]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values at the points and sets of the scene after each accepted step.
    #[must_use]
    pub fn samples(&self) -> &[Samples] {
        &self.samples
    }

    /// An energy by its name after each accepted step; `None` if there is none of this name.
    #[must_use]
    pub fn energy(&self, name: &str) -> Option<Vec<f64>> {
        let own = ENERGIES.iter().position(|energy| *energy == name)?;
        (!self.energies.is_empty()).then(|| self.energies.iter().map(|all| all[own]).collect())
    }

    /// Histories, one entry per interface in the order of [`Setup::interfaces`].
    #[must_use]
    pub fn histories(&self) -> &[InterfaceHistory] {
        &self.histories
    }

    /// History of the interface of this name.
    #[must_use]
    pub fn history(&self, interface: &str) -> Option<&InterfaceHistory> {
        self.histories.iter().find(|history| history.name == interface)
    }

    /// States at the ends of the stages reached so far.
    #[must_use]
    pub fn stage_ends(&self) -> &[StageEnd] {
        &self.stage_ends
    }

    /// State at the end of the stage of this name.
    #[must_use]
    pub fn stage_end(&self, name: &str) -> Option<&StageEnd> {
        self.stage_ends.iter().find(|end| end.name == name)
    }

    /// Tributary areas of the slave nodes of an interface, for weighted means.
    #[must_use]
    pub fn areas(&self, interface: usize) -> &[f64] {
        self.setup.interfaces.get(interface).map_or(&[], |mesh| &mesh.areas)
    }
}

impl Writer for Recorder {
    fn begin(&mut self, setup: &Setup) -> Result<(), OutputError> {
        check_probes(setup)?;
        let (all_nodes, with_bodies) = (self.all_nodes, self.with_bodies);
        let histories = setup.interfaces.iter().map(|mesh| {
            let nodes = if all_nodes { (0..mesh.positions.len()).collect() } else { mesh.probes.clone() };
            let points = nodes.into_iter().map(|node| PointHistory {
                node,
                position: mesh.positions[node],
                ..PointHistory::default()
            });
            InterfaceHistory { name: mesh.name.clone(), points: points.collect() }
        });
        *self = Self {
            all_nodes,
            with_bodies,
            histories: histories.collect(),
            setup: setup.clone(),
            ..Self::default()
        };
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        check_interfaces(&self.setup, view.interfaces)?;
        check_samples(&self.setup, view.samples)?;
        self.times.push(view.record.time);
        self.records.push(view.record.clone());
        self.samples.push(view.samples.clone());
        self.energies.extend(view.energy.as_ref().map(|energies| ENERGIES.map(|name| energies.part(name))));
        for (history, fields) in self.histories.iter_mut().zip(view.interfaces) {
            for point in &mut history.points {
                point.push(fields);
            }
        }
        if view.ends_stage {
            self.end_stage(view);
        }
        Ok(())
    }

    /// Keeps the last state of a stage in which the run stops.
    fn end(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        if self.stage_ends.last().is_none_or(|end| end.stage != view.record.stage) {
            self.end_stage(view);
        }
        Ok(())
    }
}

impl PointHistory {
    fn push(&mut self, fields: &InterfaceFields) {
        let node = self.node;
        self.relative_displacement.push(fields.relative_displacement[node]);
        self.slip.push(fields.slip[node]);
        self.slip_rate.push(fields.slip_rate[node]);
        self.friction.push(fields.friction[node]);
        self.normal_traction.push(fields.normal_traction[node]);
        self.shear_traction.push(fields.shear_traction[node]);
        self.area.push(fields.area[node]);
        self.state.extend(fields.states.first().map(|state| state[node]));
    }
}

/// Refuses probes that are not slave nodes.
pub(super) fn check_probes(setup: &Setup) -> Result<(), OutputError> {
    for mesh in &setup.interfaces {
        let n = mesh.positions.len();
        expect_length(&format!("areas of interface {}", mesh.name), n, mesh.areas.len())?;
        if let Some(&found) = mesh.probes.iter().find(|&&node| node >= n) {
            let what = format!("a probe of interface {} is node number {found}", mesh.name);
            return Err(OutputError::Shape { what, expected: n, found });
        }
    }
    Ok(())
}

/// Refuses samples that do not fit the announced points and sets.
pub(super) fn check_samples(setup: &Setup, samples: &Samples) -> Result<(), OutputError> {
    expect_length("points of the step", setup.points.len(), samples.points.len())?;
    expect_length("forces of the step", setup.forces.len(), samples.forces.len())?;
    expect_length("springs of the step", setup.springs.len(), samples.springs.len())
}

/// Refuses interface fields that do not fit the announced slave nodes, so that no observer indexes out of range.
pub(super) fn check_interfaces(setup: &Setup, interfaces: &[InterfaceFields]) -> Result<(), OutputError> {
    expect_length("interfaces of the step", setup.interfaces.len(), interfaces.len())?;
    for (mesh, fields) in setup.interfaces.iter().zip(interfaces) {
        let n = mesh.positions.len();
        let check =
            |field: &str, found| expect_length(&format!("{field} of interface {}", mesh.name), n, found);
        check("gap", fields.gap.len())?;
        check("normal traction", fields.normal_traction.len())?;
        check("shear traction", fields.shear_traction.len())?;
        check("mean normal traction", fields.mean_normal_traction.len())?;
        check("mean shear traction", fields.mean_shear_traction.len())?;
        check("relative displacement", fields.relative_displacement.len())?;
        check("slip", fields.slip.len())?;
        check("slip rate", fields.slip_rate.len())?;
        check("friction", fields.friction.len())?;
        check("status", fields.status.len())?;
        check("area", fields.area.len())?;
        fields.states.iter().try_for_each(|state| check("a state", state.len()))?;
    }
    Ok(())
}
