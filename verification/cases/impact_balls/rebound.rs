//! A run of the impact, compared with the laws of force.

use super::law::{Course, Impact, Law, POISSON, RADIUS, YOUNG};
use crate::CaseError;
use crate::cases::hertz::{Hertz, HertzRun, Tractions, compliance};
use crate::cases::texts::simulate_in;
use asperity_vary::SceneText;

/// Distance of the balls at the start \[m\].
const GAP: f64 = 1e-6;
/// Share of Hertz's duration that the second stage takes: contact until a half, then two periods of the balls' slowest vibration.
const AFTER: f64 = 0.76;
/// Last steps, over which the velocities of the balls are averaged: a fifth of the duration.
const LAST: usize = 25;

/// Mesh with its cells at the contact, over the radius of the balls.
#[derive(Clone, Copy, Debug)]
pub struct Mesh {
    pub file: &'static str,
    pub size: f64,
}

/// Course, and what is left of it by a law.
pub struct Against {
    pub exact: Course,
    /// Largest force over the exact, less one.
    pub peak: f64,
    /// Time above half the exact peak over the exact, less one.
    pub duration: f64,
    /// Distance of the courses in L2.
    pub distance: f64,
}

/// A run.
pub struct Rebound {
    pub mesh: Mesh,
    pub impact: Impact,
    pub course: Course,
    pub hertz: Against,
    pub balls: Against,
    /// Impulses on the upper and the lower ball along their axis \[N s\].
    pub impulses: [f64; 2],
    pub done: HertzRun,
}

impl Rebound {
    pub fn new(mesh: Mesh, speed: f64) -> Result<Self, CaseError> {
        let impact = Impact { speed };
        let done = simulate_in(&scene(mesh, impact).text()?, "impact_balls")?;
        let on = |set: &str| -> Result<Course, CaseError> {
            let times = done.record.times().iter().map(|t| t - GAP / speed);
            Ok(Course(times.zip(done.force(set)?.iter().map(|f| f[1])).collect()))
        };
        let (course, lower) = (on("upper")?, on("lower")?);
        let [hertz, balls] =
            [Law::HERTZ, Law::balls(impact.contact())].map(|law| Against::new(&course, impact.course(&law)));
        let impulses = [course.impulse(), lower.impulse()];
        let done = HertzRun { report: done.report, record: done.record, cost: done.cost };
        Ok(Self { mesh, impact, course, hertz, balls, impulses, done })
    }

    /// Mean velocities of upper and lower ball at their far poles in the last steps, along the motion \[m/s\].
    pub fn velocities(&self) -> [f64; 2] {
        let (times, samples) = (self.done.record.times(), self.done.record.samples());
        let [from, to] = [times.len() - 1 - LAST, times.len() - 1];
        let at = |step: usize, mark: usize| -samples[step].points[mark].displacement[1];
        let mean = |mark| (at(to, mark) - at(from, mark)) / (times[to] - times[from]);
        let mark = |name| self.done.record.setup().points.iter().position(|mark| mark.name == name);
        ["upper", "lower"].map(|name| mark(name).map_or(f64::NAN, mean))
    }

    /// An energy at the end, over the kinetic energy before the impact.
    pub fn energy(&self, name: &str) -> f64 {
        let last = self.done.record.energy(name).and_then(|all| all.last().copied());
        last.unwrap_or(f64::NAN) / self.impact.energy()
    }

    /// Pressure at the end of the first stage, with that of Hertz at the force of the run.
    pub fn pressure(&self) -> Result<(Tractions, Hertz), CaseError> {
        let pressed = self.done.tractions_by("press", |x| x[0])?;
        let bodies = [(YOUNG, POISSON); 2];
        let exact = Hertz::ball(pressed.load[1], 0.5 * RADIUS, compliance(bodies));
        Ok((pressed, exact))
    }

    /// Error of the pressure in L2.
    pub fn pressure_error(&self) -> Result<f64, CaseError> {
        let (pressed, exact) = self.pressure()?;
        Ok(pressed.l2(&pressed.p, exact.a, |r| exact.pressure(r)))
    }

    pub fn row(&self) -> Result<[String; 11], CaseError> {
        let percent = |share: f64| format!("{:+.2}", 100.0 * share);
        let distance = |share: f64| format!("{:.2}", 100.0 * share);
        Ok([
            format!("{}", self.impact.speed),
            format!("{:.3}", self.impact.contact()),
            format!("{}", self.mesh.size),
            percent(self.hertz.peak),
            percent(self.hertz.duration),
            distance(self.hertz.distance),
            percent(self.balls.peak),
            percent(self.balls.duration),
            distance(self.balls.distance),
            distance(self.pressure_error()?),
            format!("{:.2}", self.done.cost.wall.unwrap_or(f64::NAN)),
        ])
    }
}

impl Against {
    fn new(course: &Course, exact: Course) -> Self {
        let half = 0.5 * exact.peak();
        Self {
            peak: course.peak() / exact.peak() - 1.0,
            duration: course.duration_above(half) / exact.duration_above(half) - 1.0,
            distance: course.distance(&exact),
            exact,
        }
    }
}

/// The scene with another mesh and speed. The first stage ends where Hertz has the largest force.
fn scene(mesh: Mesh, impact: Impact) -> SceneText {
    let duration = impact.duration();
    SceneText::new(include_str!("scene.toml"))
        .with_or_same("bodies.upper.mesh.gmsh.file", mesh.file)
        .with_or_same("bodies.lower.mesh.gmsh.file", mesh.file)
        .with_or_same("bodies.upper.velocity[1]", -impact.speed)
        .with("stages[0].duration", GAP / impact.speed + 0.5 * duration)
        .with("stages[1].duration", AFTER * duration)
}
