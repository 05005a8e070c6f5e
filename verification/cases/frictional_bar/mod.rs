//! A bar pushed over a frictional foundation: slip front, displacement, hysteresis loop.

use super::texts::{BodyRun, simulate, work};
use crate::{Capability, Case, CaseError, Evidence, Floor, Ledger, Plot, Series};
use asperity_vary::SceneText;

/// See the README.
pub const CASE: Case = Case {
    name: "frictional_bar",
    readme: include_str!("README.md"),
    covers: &[Capability::Coulomb, Capability::PlaneStress, Capability::Condensation],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");
const YOUNG: f64 = 1e6;
/// Displacement of the end \[m\].
const REACH: f64 = 0.25;
/// mu p \[Pa\]; the bar is 1 m high.
const FRICTION: f64 = 50.0;
/// Length of the bar \[m\].
const LENGTH: f64 = 150.0;
/// Numbers of elements along the bar, with a node at the exact slip front.
const LEVELS: [usize; 3] = [6, 15, 30];
/// (4/3) (h/l)^2: fraction of the end displacement due to shear of a bar of height h, which bar theory neglects.
const SHEARED: f64 = 1.4e-4;

/// Length of the slipping part, sqrt(2 E h u/tau) \[m\].
fn front() -> f64 {
    (2.0 * YOUNG * REACH / FRICTION).sqrt()
}

/// Displacement at x after pushing.
fn displacement(x: f64) -> f64 {
    REACH * (1.0 - x / front()).max(0.0).powi(2)
}

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, capability) in
        [("node-to-point", Capability::PenaltyContact2d), ("mortar", Capability::Mortar)]
    {
        let mut levels = Vec::new();
        let mut rows = Vec::new();
        let mut finest = None;
        for n in LEVELS {
            let scene = pushed()
                .with_or_same("bodies.bar.mesh.block.divisions", format!("[{n}, 1]"))
                .with_or_same("bodies.base.mesh.block.divisions", format!("[{n}, 1]"))
                .with_or_same("interfaces.contact.measure", name);
            let done = simulate(&scene.text()?)?;
            let profile = Profile::from_run(&done)?;
            levels.push((LENGTH / n as f64, profile.error()));
            rows.push([
                format!("{}", LENGTH / n as f64),
                format!("{:.1e}", profile.nodal_error()),
                format!("{:.1e}", profile.error()),
                format!("{}", profile.front()),
                done.report.counts.operations.iterations.to_string(),
                done.cost.wall.map_or_else(String::new, |w| format!("{w:.3}")),
            ]);
            finest = Some((done, profile));
        }
        let (done, profile) = finest.ok_or("no level was run")?;
        profile.claims(ledger, name, &levels, capability, &done);
        ledger.table(
            format!("pushed by 0.25 m, {name}"),
            &[
                "element [m]",
                "error at nodes",
                "error between nodes",
                "last slipping node [m]",
                "iterations",
                "seconds",
            ],
            rows,
        );
    }
    cycles(ledger)
}

/// The scene until the end of pushing.
fn pushed() -> SceneText {
    SceneText::new(SCENE).without("stages[4]").without("stages[3]").without("stages[2]")
}

/// Displacements of the bar's underside after pushing.
struct Profile {
    places: Vec<f64>,
    moved: Vec<f64>,
    slip: Vec<f64>,
}

impl Profile {
    fn from_run(done: &BodyRun) -> Result<Profile, CaseError> {
        let fields = done.contact("push")?;
        let places: Vec<f64> = done.record.setup().interfaces[0].positions.iter().map(|p| p[0]).collect();
        let end = done.record.stage_end("push").ok_or("the stage was not reached")?;
        let u = &end.bodies.as_ref().ok_or("the bodies were not kept")?.displacement;
        // The nodes of the foundation coincide with those of the bar and do not move.
        let nodes = done.record.setup().mesh.nodes.iter().zip(u).filter(|(x, _)| x[1] == 0.0);
        let below: Vec<(f64, f64)> = nodes.map(|(x, u)| (x[0], u[0].abs())).collect();
        let at = |x: &f64| below.iter().filter(|n| n.0 == *x).fold(0.0, |m: f64, n| m.max(n.1));
        let moved = places.iter().map(at).collect();
        let slip = fields.slip.iter().map(|s| s.abs()).collect();
        Ok(Profile { places, moved, slip })
    }

    fn nodal_error(&self) -> f64 {
        let each = self.places.iter().zip(&self.moved).map(|(x, u)| (u - displacement(*x)).abs());
        each.fold(0.0, f64::max) / REACH
    }

    /// Largest error midway between nodes, over the end displacement.
    fn error(&self) -> f64 {
        let pairs = self.places.windows(2).zip(self.moved.windows(2));
        let each = pairs.map(|(x, u)| (0.5 * (u[0] + u[1]) - displacement(0.5 * (x[0] + x[1]))).abs());
        each.fold(0.0, f64::max) / REACH
    }

    /// Position of the last slipping node \[m\].
    fn front(&self) -> f64 {
        self.places.iter().zip(&self.slip).filter(|(_, s)| **s > 0.0).fold(0.0, |m: f64, (x, _)| m.max(*x))
    }

    fn claims(
        &self,
        ledger: &mut Ledger,
        name: &str,
        levels: &[(f64, f64)],
        capability: Capability,
        done: &BodyRun,
    ) {
        let covers = [capability, Capability::Coulomb, Capability::PlaneStress];
        ledger
            .claim(format!("displacement of all nodes after pushing, over that of the end, {name}"))
            .value(self.nodal_error())
            .at_most(if name == "mortar" { 1e-3 } else { 2.0 * SHEARED })
            .evidence(Evidence::Exact, "u (1 - x/l)^2, l = sqrt(2 E h u/tau)")
            .because(
                "linear elements have exact nodes in one dimension; a bar of height h shears, by (4/3) (h/l)^2, and its pressure is not \
                 uniform within h of its end, as much again; mortar spreads the friction of a node over the elements beside it, at the front \
                 a part of (dx/l)^2 = 2.5e-3 of the displacement",
            )
            .why_not_tighter("the height of the bar is the floor")
            .covers(&covers)
            .cost(&done.cost)
            .record();
        ledger
            .order(format!("displacement between the nodes after pushing, {name}"))
            .unit("m")
            .levels(levels)
            .expected(2.0)
            .within(0.3)
            .floor(Floor::Space, SHEARED)
            .finest(
                0.25 * (levels[levels.len() - 1].0 / front()).powi(2) + 2.0 * SHEARED,
                "a chord of a parabola, and the floor",
            )
            .evidence(Evidence::Exact, "u (1 - x/l)^2, l = sqrt(2 E h u/tau)")
            .because("linear interpolation of a parabola, above the floor of the bar's height")
            .why_not_tighter("the floor is a quarter of the error on the finest level")
            .covers(&covers)
            .cost(&done.cost)
            .record();
        ledger
            .claim(format!("end of the part that slips, {name}"))
            .unit("m")
            .value(self.front())
            .equals(front())
            .absolute(levels[levels.len() - 1].0 * 1.01)
            .evidence(Evidence::Exact, "sqrt(2 E h u/tau)")
            .because("one element: nodes slip or do not")
            .covers(&covers)
            .cost(&done.cost)
            .record();
        let exact: Vec<(f64, f64)> =
            (0..=75).map(|k| 2.0 * f64::from(k)).map(|x| (x, displacement(x))).collect();
        let found: Vec<(f64, f64)> = self.places.iter().copied().zip(self.moved.iter().copied()).collect();
        let plot = Plot::xy(format!("bar pushed by 0.25 m, {name}"), "x [m]", "displacement [m]");
        ledger.plot(plot.series(Series::line("exact", &exact)).series(Series::points("nodes", &found)));
    }
}

/// Cyclic motion: energy and hysteresis loop.
fn cycles(ledger: &mut Ledger) -> Result<(), CaseError> {
    let done = simulate(SCENE)?;
    let from = done.steps_until("draw")? - 1;
    let times = &done.record.times()[from..];
    // Friction is balanced by the external force that moves the end along x, opposite to the tangent of the master below.
    let hand: Vec<f64> = done.friction().iter().map(|f| -f).collect();
    let way: Vec<f64> =
        times.iter().map(|t| REACH * (2.0 * ((t - 2.0).rem_euclid(2.0) - 1.0).abs() - 1.0)).collect();
    let put: f64 = work(&hand[from..], &way).iter().sum();
    let lost: f64 = done.dissipated()[from + 1..].iter().sum();
    let covers = [Capability::PenaltyContact2d, Capability::Coulomb];
    ledger
        .claim("work put into a cycle less the work dissipated, over the latter, node-to-point")
        .value(((put - lost) / lost).abs())
        .at_most(1e-9)
        .evidence(Evidence::Exact, "after a cycle of two reversals the bar is where it was")
        .because(
            "displacements and tractions at the middle of a step do the work of the discrete system: the balance holds step by step; \
             rounding and what Newton leaves",
        )
        .why_not_tighter("Newton stops at 1e-11 of the largest force")
        .covers(&covers)
        .cost(&done.cost)
        .record();
    let largest = (2.0 * YOUNG * FRICTION * REACH).sqrt();
    let exact = 4.0 / 3.0 * largest * REACH;
    ledger
        .claim("work dissipated in a cycle between -0.25 m and 0.25 m, node-to-point")
        .unit("J")
        .value(lost)
        .equals(exact)
        .relative(0.01)
        .evidence(Evidence::Exact, "(4/3) F u with F = sqrt(2 E h tau u): the loop by Masing's rule")
        .because(
            "nodes that turn within a step count with the mean of their tractions before and after: of 40 steps, half the last part \
             of a step for each, (1/40)^1.5 of a half-cycle; and the front jumps from node to node",
        )
        .why_not_tighter("an estimate of one step in forty; the errors of both turns have opposite signs")
        .covers(&covers)
        .cost(&done.cost)
        .record();
    let points: Vec<(f64, f64)> = way.iter().copied().zip(hand[from..].iter().map(|f| f * 1e-3)).collect();
    let plot = Plot::xy("force over displacement of the end", "displacement [m]", "force [kN]");
    ledger.plot(plot.series(Series::marked("second cycle", &points)));
    Ok(())
}
