//! A ball on a flat in three dimensions, pressed and sheared to partial slip, to and fro.

mod cycle;
mod penalties;

use super::hertz::{self, Hertz, HertzRun, Tractions, compliance};
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_plan::reading::scene::model::{Measure, Path, Sliding};

/// See the README.
pub const CASE: Case = Case {
    name: "hertz_ball",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Hertz,
        Capability::Solid3d,
        Capability::Mortar,
        Capability::PenaltyContact3d,
        Capability::Coulomb,
    ],
    quick: true,
    run,
};

/// Cell size of the scene \[mm\].
const SIZE: f64 = 0.12;
/// Size of the largest cells \[mm\].
const COARSE: f64 = 0.24;
/// Cell size at which claims are made on both measures \[mm\].
const CLAIMED: f64 = 0.08;
const MU: f64 = 0.3;
const SCENE: &str = include_str!("scene.toml");

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (mut rows, mut shown) = (Vec::new(), Vec::new());
    let (mut pressures, mut shears) = (Vec::new(), Vec::new());
    let (condensed, points) = (Solution::Condensed, Measure::NodeToPoint);
    for (name, measure, solution, capability, sizes) in [
        ("mortar", Measure::Mortar, condensed, Capability::Mortar, [COARSE, SIZE, CLAIMED].as_slice()),
        ("node-to-point", points, condensed, Capability::PenaltyContact3d, [CLAIMED].as_slice()),
        (
            "node-to-point, all unknowns",
            points,
            Solution::Factors,
            Capability::PenaltyContact3d,
            [CLAIMED].as_slice(),
        ),
        (
            "mortar, all unknowns, no factors",
            Measure::Mortar,
            Solution::Levels,
            Capability::Mortar,
            [CLAIMED].as_slice(),
        ),
    ] {
        for &size in sizes {
            let ball = Ball::new(size, measure, solution)?;
            rows.push(ball.row(name, size));
            if solution.is_full() && ball.done.report.counts.operations.linear_iterations == 0 {
                return Err("the unsymmetric system of all unknowns was not iterated".into());
            }
            if measure == Measure::Mortar && !solution.is_full() {
                pressures.push((size, ball.pressure_error()));
                shears.push((size, ball.shear_error()));
            }
            if size == CLAIMED {
                claims(ledger, name, capability, &ball);
                shown.push((name, ball));
            }
        }
    }
    let shown: Vec<_> = shown.iter().map(|(name, ball)| (*name, &ball.pressed, &ball.hertz)).collect();
    hertz::ellipse(ledger, &shown);
    for (what, levels, finest) in [("pressure", &pressures, 0.083), ("shear traction", &shears, 0.166)] {
        ledger
            .order(format!("{what} in L2 over the cell size, mortar"))
            .levels(levels)
            .expected(1.0)
            .within(0.5)
            .or_better()
            .because(
                "end cells are wrong by the root of h/a of the peak, and their area is h/a of the whole; three meshes decide, whose nodes lie \
                 differently about the edges",
            )
            .finest(finest, "0.4 h/a for each edge, as about an axis, with h = a/4.8: one edge for pressure, two for shear traction")
            .why_not_tighter("the estimate is one of size")
            .evidence(Evidence::Exact, "Hertz, Cattaneo and Mindlin at the loads of the run")
            .covers(&[Capability::Hertz, Capability::Solid3d])
            .record();
    }
    let head = [
        "measure",
        "cells [mm]",
        "P [N]",
        "Q [N]",
        "c/a",
        "largest p %",
        "L2(p) %",
        "L2(q) %",
        "sticks to [mm]",
        "slips from [mm]",
        "iterations",
        "wall [s]",
    ];
    ledger.table("errors against Hertz, Cattaneo and Mindlin at the run's own loads, and cost", &head, rows);
    cycle::run(ledger)?;
    penalties::run(ledger)
}

/// Solution of the systems of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Solution {
    /// Of the contact alone.
    Condensed,
    /// Of all unknowns, by iterations with a Cholesky factor.
    Factors,
    /// Of all unknowns, by iterations with smoothed aggregation.
    Levels,
}

impl Solution {
    fn is_full(self) -> bool {
        self != Self::Condensed
    }
}

struct Ball {
    done: HertzRun,
    pressed: Tractions,
    sheared: Tractions,
    /// Exact contact at the end of pressing.
    hertz: Hertz,
    /// Exact contact at the end of shearing, and the radius of the stick zone \[m\].
    mindlin: (Hertz, f64),
}

impl Ball {
    fn new(size: f64, measure: Measure, solution: Solution) -> Result<Self, CaseError> {
        let solver = if solution == Solution::Levels { "\n[solver]\nmethod = \"iterative\"\n" } else { "" };
        let mut scene = hertz::refined(hertz::read(&format!("{SCENE}{solver}"))?, SIZE / size);
        scene.time.path = if solution.is_full() { Path::Full } else { Path::Auto };
        let done = hertz::simulate(&hertz::measured(scene, measure, Sliding::Small))?;
        let radius = |x: [f64; 3]| x[0].hypot(x[2]);
        let [pressed, sheared] = [done.tractions_by("press", radius)?, done.tractions_by("shear", radius)?];
        // The scene models one half.
        let exact = |at: &Tractions| Hertz::ball(2.0 * at.load[1], 8e-3, compliance([(1e9, 0.0); 2]));
        let (hertz, outer) = (exact(&pressed), exact(&sheared));
        let c = outer.a * (1.0 - sheared.load[0] / (MU * sheared.load[1])).max(0.0).cbrt();
        Ok(Self { done, pressed, sheared, hertz, mindlin: (outer, c) })
    }

    fn pressure_error(&self) -> f64 {
        self.pressed.l2(&self.pressed.p, self.hertz.a, |r| self.hertz.pressure(r))
    }

    fn shear_error(&self) -> f64 {
        let (outer, c) = self.mindlin;
        self.sheared.l2(&self.sheared.q, outer.a, |r| outer.shear(r, MU, c))
    }

    fn peak_error(&self) -> f64 {
        self.pressed.peak() / self.hertz.p0 - 1.0
    }

    /// Radii of the outermost sticking node and the innermost slipping node \[m\].
    fn edge(&self) -> [f64; 2] {
        let (mut stick, mut slip) = (0.0_f64, f64::INFINITY);
        for (r, status) in self.sheared.x.iter().zip(&self.sheared.status) {
            match status {
                1 => stick = stick.max(*r),
                2 => slip = slip.min(*r),
                _ => {}
            }
        }
        [stick, slip]
    }

    fn row(&self, name: &str, size: f64) -> [String; 12] {
        let percent = |e: f64| format!("{:.2}", 100.0 * e);
        [
            name.to_owned(),
            format!("{size}"),
            format!("{:.4}", 2.0 * self.pressed.load[1]),
            format!("{:.4}", 2.0 * self.sheared.load[0]),
            format!("{:.4}", self.mindlin.1 / self.mindlin.0.a),
            percent(self.peak_error()),
            percent(self.pressure_error()),
            percent(self.shear_error()),
            format!("{:.3}", self.edge()[0] * 1e3),
            format!("{:.3}", self.edge()[1] * 1e3),
            format!("{}", self.done.report.counts.operations.iterations),
            format!("{:.2}", self.done.cost.wall.unwrap_or(f64::NAN)),
        ]
    }
}

/// Bounds of a run with cells of a/4.8.
fn claims(ledger: &mut Ledger, name: &str, capability: Capability, ball: &Ball) {
    let covers = [Capability::Hertz, Capability::Solid3d, Capability::Coulomb, capability];
    ledger
        .claim(format!("largest pressure over that of Hertz, {name}, cells of a/4.8"))
        .value(1.0 + ball.peak_error())
        .equals(1.0)
        .absolute(0.01)
        .evidence(Evidence::Exact, "p0 = 3 P/(2 pi a^2) at the load of the run")
        .because("a node's value is an average over its cells: the top of the sphere loses h^2/(12 a^2) = 0.36 %; the end cells' error spreads as much again")
        .why_not_tighter("where nodes lie about the edge changes it")
        .covers(&covers)
        .cost(&ball.done.cost)
        .record();
    ledger
        .claim(format!("pressure in L2 over the area, r <= 1.2 a, {name}, cells of a/4.8"))
        .value(ball.pressure_error())
        .at_most(0.083)
        .evidence(Evidence::Exact, "Hertz at the load of the run")
        .because("end cells, as about an axis: 0.4 h/a")
        .why_not_tighter("where nodes lie about the edge changes it")
        .covers(&covers)
        .record();
    ledger
        .claim(format!("shear traction in L2 over the area, r <= 1.2 a, {name}, cells of a/4.8"))
        .value(ball.shear_error())
        .at_most(0.166)
        .evidence(Evidence::Exact, "Cattaneo and Mindlin at the loads of the run")
        .because("two edges, of slip and of stick: twice 0.4 h/a")
        .why_not_tighter("where nodes lie about both edges changes it")
        .covers(&covers)
        .record();
    let [stick, slip] = ball.edge();
    ledger
        .claim(format!("edge of the zone of stick, between the outermost node that sticks and the innermost that slips, {name}"))
        .unit("mm")
        .value(0.5e3 * (stick + slip))
        .equals(ball.mindlin.1 * 1e3)
        .absolute(CLAIMED)
        .evidence(Evidence::Exact, "c = a (1 - Q/(mu P))^(1/3) at the loads of the run")
        .because("a status is known at nodes only: within a cell")
        .covers(&covers)
        .record();
}
