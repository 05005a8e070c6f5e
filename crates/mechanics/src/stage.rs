//! A stage of loading: conditions on degrees of freedom of the common mesh.

use super::pace::{Pace, Travel};
use super::rotation::RotatedSet;
use asperity_fem::corners::{corners, range};
use asperity_fem::dof::{Channel, Constraints};
use asperity_fem::table::Table;
use std::ops::Range;

/// Slip rates up to this multiple of the largest prescribed rate are attributed to the loading, whatever its unit of time. The
/// factor is two e-folds beyond the span of velocity steps in experiments.
pub const LOADING: f64 = 100.0;

/// Prescribed motion of a component during a stage.
#[derive(Clone, Debug, PartialEq)]
pub enum Motion {
    /// Displacement present from the start \[m\].
    Fixed(f64),
    /// Displacement proportional to time, up to this value at the end \[m\].
    To(f64),
    /// Motion at a rate.
    Rate(Pace),
    /// Times since the start of the stage \[s\] and displacements at these times \[m\].
    Table(Vec<(f64, f64)>),
    /// Displacement held at its value at the start, apart from rotation.
    Hold,
}

/// Course that a table prescribes: its entries, and the displacement or load that follows from them.
#[derive(Clone, Debug)]
pub struct Course {
    /// Times of the entries \[s\]; two at one time are a jump.
    pub times: Vec<f64>,
    /// Displacements \[m\], loads or, of a rate by a table, rates \[m/s\].
    pub values: Vec<f64>,
    /// Displacement \[m\] or load.
    pub moves: Table,
}

impl Course {
    /// Course of a displacement or load.
    #[must_use]
    pub fn from_table(moves: Table) -> Self {
        Self { times: moves.times().to_vec(), values: moves.values().to_vec(), moves }
    }

    /// Course of a rate with these values at times.
    #[must_use]
    pub fn from_rates(times: Vec<f64>, values: Vec<f64>) -> Self {
        let moves = Table::from_rates(&times, &values);
        Self { times, values, moves }
    }

    /// Indices of its corners, from whose chords entries depart by at most `tolerance` of the range.
    #[must_use]
    pub fn corners(&self, tolerance: f64) -> Vec<usize> {
        corners(&self.times, &self.values, tolerance * range(&self.values))
    }

    /// Largest slope.
    fn steepest(&self) -> f64 {
        let middles = self.moves.times().windows(2).map(|w| 0.5 * (w[0] + w[1]));
        middles.map(|t| self.moves.slope(t).abs()).fold(0.0, f64::max)
    }
}

/// The conditions in force during a stage, on degrees of freedom of the common mesh.
#[derive(Clone, Debug)]
pub struct Stage {
    /// Name.
    pub name: String,
    /// Start \[s\].
    pub start: f64,
    /// End \[s\].
    pub end: f64,
    /// Number of equal steps, if the scene gives it.
    pub steps: Option<usize>,
    /// Names of interfaces without friction.
    pub frictionless: Vec<String>,
    /// Motions, with the degrees of freedom they prescribe.
    pub motions: Vec<(Vec<usize>, Motion)>,
    /// Components that rotate with their sets.
    pub turning: Vec<RotatedSet>,
    /// Loads, each with the set it acts on, if it acts on a set.
    pub loads: Vec<(Option<String>, Channel)>,
    /// Fixed degrees of freedom, sorted.
    pub fixed: Vec<usize>,
    /// Sets that a spring moves as one.
    pub springs: Vec<Spring>,
    /// Nodal forces of the weight of the bodies, in scenes with faults. It acts before the start.
    pub weight: Vec<(usize, f64)>,
}

/// Degrees of freedom that move as one and are pulled by a spring.
#[derive(Clone, Debug, PartialEq)]
pub struct Spring {
    /// The set, `body.set`.
    pub set: String,
    /// Axis along which it pulls.
    pub axis: usize,
    /// Degrees of freedom that move as one.
    pub dofs: Vec<usize>,
    /// Stiffness \[N/m; N/m per metre of thickness in the plane\].
    pub stiffness: f64,
    /// Rate of the spring's other end.
    pub rate: Pace,
}

impl Stage {
    /// A stage from 0 to `end` \[s\] without any condition.
    #[must_use]
    pub fn free(name: &str, end: f64) -> Self {
        Self {
            name: name.into(),
            start: 0.0,
            end,
            steps: None,
            frictionless: Vec::new(),
            motions: Vec::new(),
            turning: Vec::new(),
            loads: Vec::new(),
            fixed: Vec::new(),
            springs: Vec::new(),
            weight: Vec::new(),
        }
    }

    /// Constraints of the stage, from the displacement `u0` at its start \[m\].
    #[must_use]
    pub fn constraints(&self, u0: &[f64]) -> Constraints {
        let mut channels: Vec<Channel> = self.loads.iter().map(|(_, channel)| channel.clone()).collect();
        for (dofs, motion) in &self.motions {
            self.motion_channels(dofs, motion, u0, &mut channels);
        }
        channels.extend(self.turning.iter().flat_map(|t| t.channels(self.start, self.end, u0)));
        channels.retain(|c| !c.prescribed.is_empty() || !c.forces.is_empty());
        Constraints { fixed: self.fixed.clone(), channels }
    }

    /// Loads other than those on this set.
    pub fn loads_beside(&self, set: &str) -> impl Iterator<Item = &Channel> {
        self.loads.iter().filter(move |(on, _)| on.as_deref() != Some(set)).map(|(_, channel)| channel)
    }

    /// Courses that tables prescribe, over the time of the run.
    #[must_use]
    pub fn courses(&self) -> Vec<Course> {
        let loads = self.loads.iter().map(|(_, channel)| Course::from_table(channel.amplitude.clone()));
        self.moved().chain(loads).collect()
    }

    /// Courses of the tables of motions and load points.
    fn moved(&self) -> impl Iterator<Item = Course> {
        let (start, end) = (self.start, self.end);
        let paced =
            move |pace: &Pace| pace.points(start, end).map(|(times, rates)| Course::from_rates(times, rates));
        let motion = move |(_, motion): &(Vec<usize>, Motion)| match motion {
            Motion::Table(points) => Some(Course::from_table(self.table(points))),
            Motion::Rate(pace) => paced(pace),
            Motion::Fixed(_) | Motion::To(_) | Motion::Hold => None,
        };
        self.motions.iter().filter_map(motion).chain(self.springs.iter().filter_map(move |s| paced(&s.rate)))
    }

    /// Table of times since the start of the stage.
    fn table(&self, points: &[(f64, f64)]) -> Table {
        Table::new(points.iter().map(|p| self.start + p.0).collect(), points.iter().map(|p| p.1).collect())
    }

    /// Largest prescribed rate of displacement in the stage, also of load points \[m/s\].
    #[must_use]
    pub fn largest_rate(&self) -> f64 {
        self.moved().map(|course| course.steepest()).fold(self.steady_rate(), f64::max)
    }

    /// Largest displacement that the stage prescribes in addition to those before it, apart from those held from its start \[m\].
    #[must_use]
    pub fn driven(&self) -> f64 {
        let way = |course: Course| range(course.moves.values());
        self.moved().map(way).fold(self.steady_rate() * (self.end - self.start), f64::max)
    }

    /// Largest rate that conditions other than tables prescribe \[m/s\].
    fn steady_rate(&self) -> f64 {
        let duration = self.end - self.start;
        let steady = |pace: &Pace| if let Pace::Steady(rate) = pace { rate.abs() } else { 0.0 };
        let turning = self.turning.iter().map(|t| t.radius() * t.rotation.angle.abs() / duration);
        let turning = turning.fold(0.0, f64::max);
        let drawn = self.springs.iter().fold(turning, |largest, spring| largest.max(steady(&spring.rate)));
        self.motions.iter().fold(drawn, |largest, (_, motion)| {
            largest.max(match motion {
                Motion::Rate(pace) => steady(pace),
                Motion::To(value) => value.abs() / duration,
                Motion::Table(_) | Motion::Fixed(_) | Motion::Hold => 0.0,
            })
        })
    }

    /// Largest displacement that the stage prescribes in addition to those before it \[m\].
    #[must_use]
    pub fn travel(&self) -> f64 {
        let held =
            self.motions.iter().map(|(_, motion)| if let Motion::Fixed(u) = motion { u.abs() } else { 0.0 });
        held.fold(self.driven(), f64::max)
    }

    /// True if anything other than prescribed motions acts: loads, weight, initial stress or springs.
    #[must_use]
    pub fn is_loaded(&self) -> bool {
        !self.springs.is_empty() || self.loads.iter().any(|(_, channel)| !channel.forces.is_empty())
    }

    /// True if conditions hold any of these degrees of freedom along the given components.
    #[must_use]
    pub fn holds(&self, dofs: &Range<usize>, components: &[bool]) -> bool {
        let fixed = self.fixed.iter().chain(self.springs.iter().flat_map(|s| &s.dofs));
        fixed.into_iter().any(|d| dofs.contains(d) && components[d % components.len()])
    }

    /// Largest force along a direction that loads exert on these degrees of freedom at any time of the stage \[N; N/m\].
    #[must_use]
    pub fn largest_force(&self, dofs: &Range<usize>, along: &[f64]) -> f64 {
        let channels = || self.loads.iter().map(|(_, channel)| channel);
        let of = |channel: &Channel| -> f64 {
            let own = channel.forces.iter().filter(|(d, _)| dofs.contains(d));
            own.map(|(d, force)| force * along[d % along.len()]).sum()
        };
        let parts: Vec<(&Table, f64)> = channels().map(|c| (&c.amplitude, of(c))).collect();
        let turns = parts.iter().flat_map(|(a, _)| a.times().iter().copied());
        let within = turns.filter(|t| *t > self.start && *t < self.end);
        let times = within.chain([self.start, self.end]);
        times.map(|t| parts.iter().map(|(a, f)| f * a.value(t)).sum()).fold(f64::NEG_INFINITY, f64::max)
    }

    /// True if tractions or pressures act on sets.
    #[must_use]
    pub fn has_loads(&self) -> bool {
        self.loads.iter().any(|(set, _)| set.is_some())
    }

    fn motion_channels(&self, dofs: &[usize], motion: &Motion, u0: &[f64], channels: &mut Vec<Channel>) {
        let present = |table: Table| Channel {
            prescribed: dofs.iter().filter(|&&d| u0[d] != 0.0).map(|&d| (d, u0[d])).collect(),
            forces: Vec::new(),
            amplitude: table,
        };
        let unit = |table: Table| Channel {
            prescribed: dofs.iter().map(|&d| (d, 1.0)).collect(),
            forces: Vec::new(),
            amplitude: table,
        };
        let ramp = |from: f64, to: f64| Table::new(vec![self.start, self.end], vec![from, to]);
        let constant = |value: f64| Table::constant(value);
        match motion {
            Motion::Fixed(value) if *value != 0.0 => channels.push(unit(constant(*value))),
            Motion::To(value) => channels.extend([present(ramp(1.0, 0.0)), unit(ramp(0.0, *value))]),
            Motion::Rate(pace) => {
                let moved = match pace.drawn(self.start, self.end) {
                    Travel::Steady { rate, .. } => ramp(0.0, rate * (self.end - self.start)),
                    Travel::Table(table) => table,
                };
                channels.extend([present(constant(1.0)), unit(moved)]);
            }
            Motion::Table(points) => channels.push(unit(self.table(points))),
            // `turning` gives the displacement that a rotation adds to the positions at the start of the stage.
            Motion::Hold => channels.push(present(constant(1.0))),
            Motion::Fixed(_) => {}
        }
    }
}
