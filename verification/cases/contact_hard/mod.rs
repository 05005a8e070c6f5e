//! Scenes on which Newton's method with contact is known to fail.

pub mod scenes;

use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_vary::SceneText;
use scenes::{HardContactRun, Pair, block};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_hard",
    readme: include_str!("README.md"),
    covers: &[Capability::HardContact, Capability::Coulomb],
    quick: true,
    run,
};

const SCENE: &str = include_str!("scene.toml");

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    edge_of_slip(ledger)?;
    limit_load(ledger)?;
    slope(ledger)?;
    gap_and_overlap(ledger)?;
    crossing(ledger)?;
    corners(ledger)
}

/// The scene with another shear load, Poisson's ratio, measure and sliding.
fn sheared(share: f64, poisson: f64, measure: &str, sliding: &str) -> Result<String, CaseError> {
    let shear = 0.5e6 * share;
    let scene = SceneText::new(SCENE)
        .with("stages[1].conditions[0].traction[0].to", shear)
        .with("stages[1].conditions[1].traction[1].to", shear)
        .with("stages[1].conditions[2].traction[1].to", -shear)
        .with("stages[1].conditions[3].traction[1].to", shear)
        .with("stages[1].conditions[4].traction[1].to", -shear)
        .with_or_same("materials.m.poisson", poisson)
        .with_or_same("interfaces.contact.measure", measure)
        .with_or_same("interfaces.contact.sliding", sliding);
    Ok(scene.text()?)
}

/// Claims the iterations of a single step.
fn iterations(ledger: &mut Ledger, what: &str, done: &HardContactRun, bound: f64) {
    ledger
        .claim(format!("most Newton iterations of a step, {what}"))
        .value(done.most_iterations())
        .at_most(bound)
        .evidence(Evidence::ConvergedSelf, "count of the run itself")
        .because("a set of contacts is found in a few full steps, one more squares the residual; twice that is a cycle")
        .why_not_tighter("which points change in which iteration depends on rounding where many are on the edge at once")
        .covers(&[Capability::HardContact])
        .cost(&done.cost)
        .record();
}

/// Exactly at the limit of slip and just below it: every point sticks, or slips while the whole load is borne.
fn edge_of_slip(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (share, named) in [(1.0 - 1e-9, "a billionth below"), (1.0, "exactly at")] {
        for (measure, sliding) in [("node-to-point", "small"), ("mortar", "small")] {
            let done = HardContactRun::from_text(&sheared(share, 0.0, measure, sliding)?)?;
            let what = format!("{named} the limit of friction everywhere, {measure}");
            let end = done.end()?;
            ledger
                .claim(format!("elastic displacement of every point, {what}"))
                .unit("m")
                .values(&end.relative_displacement)
                // The upper block is pulled along x, opposite to the tangent of the master below.
                .equals_each(&vec![-0.5e6 * share * 0.25 / 100e9; end.gap.len()])
                .relative(1e-8)
                .evidence(Evidence::Exact, "uniform stress: traction over tangential penalty, h/(100 E) times the shear")
                .because("the residual is at most 1e-11 of the forces, and a point that slips for rounding has only its neighbours to hold it")
                .why_not_tighter("at the limit the tangent has no smallest stiffness but that of points that still stick")
                .covers(&[Capability::HardContact, Capability::Coulomb])
                .cost(&done.cost)
                .record();
            iterations(ledger, &what, &done, 10.0);
        }
        for sliding in ["small", "finite"] {
            let done = HardContactRun::from_text(&sheared(share, 0.3, "mortar", sliding)?)?;
            iterations(
                ledger,
                &format!("{named} the limit after uneven pressing, mortar, {sliding} sliding"),
                &done,
                15.0,
            );
        }
    }
    Ok(())
}

/// Beyond the limit load there is no solution: the run stops there, reports what slides, and keeps the last good state.
fn limit_load(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (share, poisson) in [(1.0 + 1e-9, 0.0), (1.1, 0.0), (1.1, 0.3)] {
        let done = HardContactRun::from_text(&sheared(share, poisson, "node-to-point", "small")?)?;
        let (time, reason) = done.stopped()?;
        ledger
            .claim(format!("shear over friction in the last good state, load to {share}, Poisson's ratio {poisson}"))
            .value((time - 1.0) * share)
            .equals(1.0)
            .absolute(1e-9)
            .evidence(Evidence::Exact, "a block slides when the shear is mu times the pressure, however that is spread")
            .because("the load is approached by halving the steps to 1e-13 of the stage; the residual may be 1e-11 of the largest force")
            .why_not_tighter("rounding of a body that begins to slide away is larger than that of one at rest")
            .covers(&[Capability::HardContact])
            .cost(&done.cost)
            .record();
        let named = reason.contains("body `upper`") && reason.contains("motion in x");
        ledger
            .claim(format!(
                "the reason names the body and its motion, load to {share}, Poisson's ratio {poisson}"
            ))
            .count(u64::from(named), 1)
            .evidence(Evidence::Exact, "the upper block is held in x by friction alone")
            .because("a yes or no")
            .covers(&[Capability::HardContact])
            .record();
        ledger
            .claim(format!(
                "last recorded time is that of the outcome, load to {share}, Poisson's ratio {poisson}"
            ))
            .unit("s")
            .value(done.record.times().last().copied().unwrap_or(f64::NAN))
            .equals(time)
            .absolute(f64::EPSILON)
            .evidence(Evidence::Exact, "the last good state is kept")
            .because("the same number; the bound is the rounding of one second")
            .why_not_tighter("no smaller bound than that of one rounding is above zero")
            .covers(&[Capability::HardContact])
            .record();
    }
    Ok(())
}

/// A block on a slope under its own weight, applied in a single step: partial slip up to the limit.
fn slope(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (measure, share, bound) in
        [("node-to-point", 0.9, 10.0), ("node-to-point", 0.99, 15.0), ("mortar", 0.9, 10.0)]
    {
        let slope = 0.5 * share;
        let angle = f64::atan(slope);
        let mut pair = Pair::new(
            block(&[-1.0, -1.0], &[2.0, 0.0], &[24, 8]),
            block(&[0.0, 0.0], &[1.0, 0.5], &[8, 4]),
            &["{ set = \"lower.bottom\", x = 0, y = 0 }"],
        );
        pair.gravity = format!("[{:?}, {:?}]", 9.81 * angle.sin(), -9.81 * angle.cos());
        (pair.measure, pair.mu) = (measure, Some(0.5));
        let done = pair.run()?;
        let end = done.end()?;
        let (normal, shear) = (done.total(&end.normal_traction), done.total(&end.shear_traction));
        let what = format!("{measure}, slope {share} of the friction coefficient");
        ledger
            .claim(format!("shear over normal force of a block on a slope, {what}"))
            .value((shear / normal).abs())
            .equals(slope)
            .relative(1e-4)
            .evidence(Evidence::Exact, "weight on a slope: tan of its angle")
            .because("the interface turns by up to 1e-5, the strain, and with it the two components")
            .why_not_tighter("finite sliding: the components are those of the deformed interface")
            .covers(&[Capability::HardContact, Capability::Coulomb])
            .cost(&done.cost)
            .record();
        iterations(ledger, &format!("block on a slope, {what}"), &done, bound);
    }
    Ok(())
}

const HELD: &str = "{ set = \"lower.bottom\", x = 0, y = 0 }, ";

/// Columns in series with a gap that closes, and with an initial overlap that is removed, in one step.
fn gap_and_overlap(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (measure, sliding) in [("node-to-point", "small"), ("node-to-point", "finite"), ("mortar", "finite")]
    {
        for (gap, down) in [(1e-3, 3e-3), (-2e-3, 0.0)] {
            let mut pair = Pair::new(
                block(&[0.0, -1.0], &[1.0, 0.0], &[4, 4]),
                block(&[0.0, gap], &[1.0, 1.0 + gap], &[4, 4]),
                &[&format!("{HELD}{{ set = \"upper.top\", x = 0, y = {{ to = {:?} }} }}", -down)],
            );
            (pair.measure, pair.sliding, pair.elastic) = (measure, sliding, (1e9, 0.0));
            let done = pair.run()?;
            let end = done.end()?;
            let exact = (down - gap) / (2.0 / 1e9 + 0.25 / 100e9);
            let what = if gap > 0.0 { "gap that closes" } else { "overlap from the start" };
            let what = format!("{what}, {measure}, {sliding} sliding");
            ledger
                .claim(format!("pressure at every slave node, {what}"))
                .unit("Pa")
                .values(&end.normal_traction)
                .equals_each(&vec![exact; end.gap.len()])
                .relative(1e-9)
                .evidence(Evidence::Exact, "columns and penalty spring in series, without Poisson's effect")
                .because("the uniform state is a solution of the discrete problem; the residual may be 1e-11 of the forces")
                .why_not_tighter("the penalty, 400 times the stiffness of a column, multiplies rounding of positions")
                .covers(&[Capability::HardContact])
                .cost(&done.cost)
                .record();
            iterations(ledger, &what, &done, 6.0);
        }
    }
    Ok(())
}

/// A body held by contact alone, touching from the start or separated by a gap from its support.
fn crossing(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (measure, bound) in [("node-to-point", 10.0), ("mortar", 15.0)] {
        for gap in [0.0, 1e-3] {
            let mut pair = Pair::new(
                block(&[-0.5, -1.0], &[1.5, 0.0], &[13, 6]),
                block(&[0.0, gap], &[1.0, 1.0 + gap], &[8, 8]),
                &[&format!("{HELD}{{ set = \"upper.top\", pressure = {{ to = 1e6 }} }}")],
            );
            (pair.measure, pair.mu) = (measure, Some(0.3));
            let done = pair.run()?;
            let what = format!("body held by contact alone, gap {gap} m, {measure}");
            ledger
                .claim(format!("contact force over the load, {what}"))
                .value(done.report.balance[0].slave_force[1] / 1e6)
                .equals(1.0)
                .absolute(1e-9)
                .evidence(Evidence::Exact, "equilibrium of the upper body")
                .because("the residual is rounding of the forces, or 1e-11 of the largest; some tens of nodes add up")
                .why_not_tighter("rounding of positions times the penalty is 1e-10 of the load on a node")
                .covers(&[Capability::HardContact])
                .cost(&done.cost)
                .record();
            iterations(ledger, &what, &done, bound);
        }
    }
    Ok(())
}

/// A corner pressed on a flat surface, and a flat surface on a corner, by 50 mm in one step of the scene.
fn corners(ledger: &mut Ledger) -> Result<(), CaseError> {
    let diamond = "mesh.quadrilateral = { corners = [[0.5, 0], [1, 0.5], [0.5, 1], [0, 0.5]], divisions = [8, 8], element = \"quad4\" }";
    let down = format!(
        "{HELD}{{ set = \"upper.top\", x = 0, y = {{ to = -0.05 }} }}, {{ set = \"upper.right\", x = 0, y = {{ to = -0.05 }} }}"
    );
    for (sets, named) in [
        (["upper.bottom", "lower.top"], "corner on a flat"),
        (["lower.top", "upper.bottom"], "flat on a corner"),
    ] {
        for (measure, mu) in [("node-to-point", Some(0.3)), ("mortar", None), ("mortar", Some(0.3))] {
            let mut pair = Pair::new(block(&[-0.5, -1.0], &[1.5, 0.0], &[16, 6]), diamond.into(), &[&down]);
            (pair.sets, pair.measure, pair.mu) = (sets, measure, mu);
            let done = pair.run()?;
            let end = done.end()?;
            let friction = if mu.is_some() { "with" } else { "without" };
            let what = format!("{named}, tip on a node, {measure}, {friction} friction");
            ledger
                .claim(format!("points in contact, {what}"))
                .value(end.normal_traction.iter().filter(|t| **t > 0.0).count() as f64)
                .at_least(1.0)
                .evidence(Evidence::Exact, "the corner is pressed in by 50 mm")
                .because("a contact that is passed through would leave none")
                .why_not_tighter("one point is what a corner on a coarse flat has")
                .covers(&[Capability::HardContact])
                .record();
            ledger
                .claim(format!("sum of contact forces, relative, {what}"))
                .value(done.report.balance[0].force_residual)
                .at_most(1e-13)
                .evidence(Evidence::Exact, "action and reaction")
                .because("rounding of sums over a few nodes")
                .why_not_tighter("rounding depends on the order of the sum; a force that is left out is of the order of one")
                .covers(&[Capability::HardContact])
                .record();
            iterations(ledger, &what, &done, 30.0);
        }
    }
    Ok(())
}
