//! The problem to integrate, and its description for the output.

use super::bodies::BodiesView;
use super::cadence::Cadence;
use super::coulomb::Coulomb;
use super::free_surface::FreeSurface;
use super::normal::NormalChoice;
use super::platform::Platform;
use super::receivers::Receivers;
use super::sampling::Sampling;
use super::stresses::BodyStresses;
use crate::shared::checks::Checks;
use crate::shared::place::Frame;
use crate::shared::resolution::Resolution;
use crate::shared::ruptures::Ruptures;
use asperity_cycles::diffusion::Diffusion;
use asperity_cycles::heat::Layer;
use asperity_cycles::{Components, FaultRun, Layout, Opening, Pressure, Problem, Pulse, Thresholds};
use asperity_laws::Theta;
use asperity_run::{Site, SlipPoints, Warning};
use std::fmt::Write as _;

/// A point of a fault, as needed by the output.
#[derive(Clone, Debug, PartialEq)]
pub struct PointView {
    /// Position in space \[m\].
    pub at: [f64; 3],
    /// Distance along a plane fault from its upper end \[m\].
    pub along: f64,
    /// Unit normal from minus to plus.
    pub normal: [f64; 3],
    /// Direction of motion of the plus side if slip, or its first component, is positive.
    pub slides: [f64; 3],
    /// Direction of the second component of vector slip, normal x `slides`.
    pub across: Option<[f64; 3]>,
    /// Tributary area \[m²; m per metre of thickness\].
    pub area: f64,
    /// Shear modulus G for moments: harmonic mean of the two sides \[Pa\].
    pub shear_modulus: f64,
    /// The state θ of its law, if it has one.
    pub theta: Option<Theta>,
    /// Rate at which plates move past each other there, component by component, if the fault has a creep \[m/s\].
    pub plate: Option<[f64; 2]>,
}

/// Position of a station.
#[derive(Clone, Debug, PartialEq)]
pub enum Station {
    /// Distance along a plane fault from its upper end \[m\].
    Along(f64),
    /// Coordinates \[m\].
    At(Vec<f64>),
}

/// Heat of friction on a fault, as needed by the output.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeatView {
    /// The zone that is heated.
    pub layer: Layer,
    /// Temperature of melting \[K\], if given.
    pub melting: Option<f64>,
    /// Temperature at which contacts weaken \[K\], if they do.
    pub weakening: Option<f64>,
}

impl HeatView {
    /// Summary for the plan.
    #[must_use]
    pub fn words(&self, fault: &str) -> String {
        let layer = &self.layer;
        let mut text = format!(
            "fault `{fault}`: friction heats a zone of {:e} m from {:?} K",
            layer.thickness, layer.ambient
        );
        if let Some(fluid) = layer.pressurisation {
            text += &format!("; its fluid gains {:e} Pa/K", fluid.coefficient);
        }
        if let Some(weakening) = self.weakening {
            text += &format!("; its contacts weaken at {weakening:?} K");
        }
        text
    }
}

/// A fault, as needed by the output.
#[derive(Clone, Debug, PartialEq)]
pub struct FaultView {
    /// Name in the scene.
    pub name: String,
    /// Range of its points among those of all faults.
    pub points: std::ops::Range<usize>,
    /// Behaviour of normal tractions on it.
    pub normal: NormalChoice,
    /// Heat of friction on it.
    pub heat: Option<HeatView>,
    /// Stations: requested position and nearest point.
    pub stations: Vec<(Station, usize)>,
    /// Faces whose nodes all slide freely, by their points within the fault.
    pub faces: Vec<Vec<usize>>,
    /// Outlines of the cells of the points, if fields are drawn in them.
    pub outline: Option<Outline>,
    /// Grid of its cells, if they are equal rectangles.
    pub grid: Option<CellGrid>,
}

/// Equal rectangles of which each has a point of a fault at its centre, row by row from the upper edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellGrid {
    /// Number along strike.
    pub columns: usize,
    /// Number down dip.
    pub rows: usize,
    /// Size of a cell along strike and down dip \[m\].
    pub cell: [f64; 2],
    /// First end of the upper edge \[m\].
    pub from: [f64; 3],
    /// Unit vector along strike, to whose right the fault dips.
    pub along: [f64; 3],
    /// Unit vector down dip.
    pub down: [f64; 3],
}

impl CellGrid {
    /// Middle of the upper edge of the cell with this centre \[m\].
    pub fn top_of(&self, centre: &[f64; 3]) -> [f64; 3] {
        std::array::from_fn(|c| centre[c] - 0.5 * self.cell[1] * self.down[c])
    }
}

/// Triangles of which each has a point of a fault at its centre.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// Positions of corners \[m\].
    pub nodes: Vec<[f64; 3]>,
    /// Corners of the triangles, in the order of the points of the fault.
    pub corners: Vec<[usize; 3]>,
}

/// The problem to integrate, and its description for the output.
#[derive(Debug)]
pub struct Plan {
    /// Title.
    pub title: String,
    /// Faults.
    pub faults: Vec<FaultView>,
    /// Points of the faults, fault by fault; on a plane fault, in order from its upper end.
    pub points: Vec<PointView>,
    /// The problem to integrate.
    pub problem: Problem,
    /// Bodies with mass that compute the ruptures, if the scene has them.
    pub ruptures: Option<Ruptures>,
    /// Slip rates at which slow events begin and end, if they are asked for.
    pub slow: Option<Thresholds>,
    /// Direction up, where it is known.
    pub up: Option<[f64; 3]>,
    /// Cadence of the output.
    pub cadence: Cadence,
    /// Largest number of events with files of their own.
    pub event_files: usize,
    /// Description of the rock around the faults.
    pub medium: &'static str,
    /// Degrees of freedom of the bodies; 0 without bodies.
    pub dofs: usize,
    /// Points whose slip rate is prescribed.
    pub creeping: usize,
    /// Estimated memory of the whole run \[bytes\].
    pub memory_bytes: usize,
    /// The bodies, if their displacements are requested or values of them sampled.
    pub bodies: Option<BodiesView>,
    /// Values of the bodies that are sampled.
    pub sampling: Option<Sampling>,
    /// Positions in the rock or the bodies whose motion is written.
    pub receivers: Receivers,
    /// Positions on the free surface whose displacement over each event is written.
    pub free_surface: Option<FreeSurface>,
    /// Positions in the rock at which the change of Coulomb stress over each event is written.
    pub coulomb: Option<Coulomb>,
    /// Planes on which stresses of bodies over each event are resolved.
    pub stresses: Option<BodyStresses>,
    /// Files for the platform of a community benchmark.
    pub platform: Option<Platform>,
    /// Geographic position and epoch of the origin.
    pub frame: Option<Frame>,
    /// True if faults are surfaces in 3D, which have no distance along them.
    pub in_space: bool,
    /// Description of the idealisation.
    pub kinematics: &'static str,
    /// Resolution of faults on which friction weakens.
    pub resolution: Vec<Resolution>,
    /// Warnings about settings that are probably not intended.
    pub warnings: Vec<Warning>,
    /// Notes for the user that are not warnings.
    pub notes: Vec<String>,
    /// Extents, counts of points and lengths of friction.
    pub checks: Checks,
}

/// Description of the files of events.
fn describe_events(most: usize) -> String {
    match most {
        0 => "no files of single events".into(),
        1 => "files of the first event in `events`".into(),
        most => format!("files of the first {most} events in `events`"),
    }
}

/// Description of a pulse.
fn describe_pulse(pulse: &Pulse) -> String {
    let points = pulse.amplitude.iter().filter(|a| **a != 0.0).count();
    let most = pulse.amplitude.iter().fold(0.0_f64, |most, a| most.max(a.abs()));
    let (mega, rise) = (most / 1e6, pulse.rise);
    format!("a pulse of up to {mega:.4} MPa in shear grows on {points} points until {rise} s")
}

impl Plan {
    /// A run at its start, with the sources of its events.
    #[must_use]
    pub fn begin(&self) -> FaultRun {
        let faults: Vec<_> = self.faults.iter().map(|f| f.points.clone()).collect();
        let run = FaultRun::new(self.problem.start.clone(), &faults, self.problem.settings.thresholds);
        match self.slow {
            Some(slow) => run.and_slow(slow),
            None => run,
        }
    }

    /// Vector in space \[m; m/s; Pa\] from its components at a point.
    #[must_use]
    pub fn vector<V: AsRef<[f64]>>(&self, values: &Components<V>, point: usize) -> [f64; 3] {
        let view = &self.points[point];
        let first = view.slides.map(|e| values.component(0)[point] * e);
        let Some(across) = &view.across else { return first };
        let second = values.component(1)[point];
        std::array::from_fn(|c| first[c] + second * across[c])
    }

    /// Heat of friction on the fault of a point.
    #[must_use]
    pub fn heat_at(&self, point: usize) -> Option<&HeatView> {
        self.faults.iter().find(|f| f.points.contains(&point))?.heat.as_ref()
    }

    /// Summary to be read before the run.
    #[must_use]
    pub fn summary(&self) -> String {
        let mut text = String::from("plan\n");
        let mut line = |name: &str, value: String| {
            let _ = writeln!(text, "  {name:<9} {value}");
        };
        line("physics", format!("linear elasticity, small strain, {}, {}", self.kinematics, self.medium));
        for fault in &self.faults {
            let law = &self.problem.fault.law;
            line(
                "physics",
                format!(
                    "fault `{}`: {} points that slide {}{}, {} state variables a point",
                    fault.name,
                    fault.points.len(),
                    if law.components() > 1 { "in any direction " } else { "" },
                    if fault.normal.opens { "and open" } else { "without opening" },
                    law.states()
                ),
            );
        }
        if self.creeping > 0 {
            line("physics", format!("{} points creep at a prescribed rate", self.creeping));
        }
        let uncoupled = Layout::from_fault(&self.problem.fault).normal().is_empty();
        let chosen = |f: &FaultView| !f.normal.changes || f.normal.floor.is_some();
        if uncoupled && !self.faults.iter().any(chosen) {
            line("physics", "slip leaves normal tractions as they are".into());
        } else {
            self.faults.iter().for_each(|f| line("physics", f.normal.words(&f.name)));
        }
        let processes = &self.problem.fault.processes;
        if processes.find::<Pressure>().is_some() {
            line(
                "physics",
                "fluid is injected and diffuses along the fault; its pressure is known at all times".into(),
            );
        }
        processes.each::<Diffusion>().for_each(|fluid| line("physics", fluid.words()));
        processes.each::<Pulse>().for_each(|pulse| line("physics", describe_pulse(pulse)));
        for fault in &self.faults {
            if let Some(heat) = &fault.heat {
                line("physics", heat.words(&fault.name));
            }
            if let Some(damping) = range(&self.problem.fault.damping[fault.points.clone()]) {
                line("physics", format!("fault `{}`: radiation damping {damping} Pa s/m", fault.name));
            }
        }
        let s = &self.problem.settings;
        line("stepper", format!("fault-ode: {} with tolerance {:e} in ln V", s.method.name(), s.tolerance));
        for words in self.ruptures.iter().flat_map(Ruptures::words) {
            line("stepper", words);
        }
        let bodies =
            if self.dofs > 0 { format!("{} degrees of freedom, ", self.dofs) } else { String::new() };
        line(
            "size",
            format!(
                "{bodies}{} unknowns, about {:.0} MB",
                self.problem.start.len(),
                self.memory_bytes as f64 / 1e6
            ),
        );
        line("operator", self.problem.fault.operator.words());
        if let Some(opening) = processes.find::<Opening>() {
            line("operator", opening.words());
        }
        self.outputs().into_iter().for_each(|words| line("output", words));
        for note in &self.notes {
            line("note", note.clone());
        }
        for warning in &self.warnings {
            line("warning", warning.to_string());
        }
        text
    }

    /// Outputs of the run, as text.
    fn outputs(&self) -> Vec<String> {
        let mut all = vec![self.cadence.words(), describe_events(self.event_files)];
        if !self.receivers.all.is_empty() {
            let place = if self.dofs > 0 { "bodies" } else { "rock, which move with the plates" };
            all.push(format!("{} receivers in the {place}", self.receivers.all.len()));
        }
        if let Some(surface) = &self.free_surface {
            let count = surface.positions.len();
            all.push(format!("displacement of {count} positions of the free surface over each event"));
        }
        all.extend(self.coulomb.as_ref().map(Coulomb::words));
        if self.stresses.is_some() {
            all.push("stresses of the bodies and their Coulomb change over each event".into());
        }
        all
    }
}

/// Smallest and largest value as text; `None` if all are 0.
fn range(values: &[f64]) -> Option<String> {
    let (least, most) =
        values.iter().fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(*v), high.max(*v)));
    let (least, most, any) = (format!("{least:.6e}"), format!("{most:.6e}"), most > 0.0);
    any.then(|| if least == most { most } else { format!("{least} to {most}") })
}

impl SlipPoints for Plan {
    fn site(&self, point: usize) -> Site {
        let PointView { at, along, area, shear_modulus, .. } = self.points[point];
        Site { at, along: (!self.in_space).then_some(along), area, shear_modulus }
    }

    fn source(&self, point: usize) -> String {
        let fault = self.faults.iter().find(|f| f.points.contains(&point));
        fault.map(|f| f.name.clone()).unwrap_or_default()
    }
}
