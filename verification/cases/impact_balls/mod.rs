//! Impact of two equal elastic balls about their common axis: Hertz's impact.

mod ball;
mod claims;
mod law;
mod rebound;

use super::body_plots;
use super::hertz;
use crate::{Capability, Case, CaseError, Ledger, Plot, Series};
use rebound::{Mesh, Rebound};

/// See the README.
pub const CASE: Case = Case {
    name: "impact_balls",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Inertia,
        Capability::Axisymmetric,
        Capability::Mortar,
        Capability::Hertz,
        Capability::Triangles,
        Capability::Implicit,
    ],
    quick: true,
    run,
};

const MESHES: [Mesh; 3] = [
    Mesh { file: "balls_1.msh", size: 0.012 },
    Mesh { file: "balls_2.msh", size: 0.006 },
    Mesh { file: "balls_3.msh", size: 0.003 },
];
/// Speed with all meshes \[m/s\].
const SLOW: f64 = 1.0;
/// Speeds with the coarsest mesh \[m/s\], at which the contact is wider by 4^0.4 and 16^0.4.
const FASTER: [f64; 2] = [4.0, 16.0];

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let meshes = MESHES.iter().map(|mesh| Rebound::new(*mesh, SLOW));
    let mut meshes = meshes.collect::<Result<Vec<_>, _>>()?;
    let faster = FASTER.iter().map(|speed| Rebound::new(MESHES[0], *speed));
    let faster = faster.collect::<Result<Vec<_>, _>>()?;
    draw(ledger, &meshes)?;
    table(ledger, meshes.iter().chain(&faster))?;
    claims::by_mesh(ledger, &meshes)?;
    let slowest = meshes.pop().ok_or("no mesh")?;
    claims::conservation(ledger, &slowest);
    claims::by_speed(ledger, &[&slowest, &faster[0], &faster[1]]);
    Ok(())
}

fn draw(ledger: &mut Ledger, meshes: &[Rebound]) -> Result<(), CaseError> {
    let [coarsest, _, finest] = meshes else { return Ok(()) };
    let picture = body_plots::recorded(&coarsest.done.record, "press")?;
    ledger.picture("Balls at the largest force", picture, "Mises stress at 1 m/s, coarsest mesh.");
    let shown = |rows: &[(f64, f64)], every: usize| -> Vec<(f64, f64)> {
        rows.iter().step_by(every).map(|(t, f)| (t * 1e6, *f)).collect()
    };
    let plot = Plot::xy("Force of the contact", "time from the first touch [us]", "force [N]")
        .series(Series::line("Hertz", &shown(&finest.hertz.exact.0, 100)))
        .series(Series::line("elastic balls", &shown(&finest.balls.exact.0, 100)))
        .series(Series::points("1 m/s, finest mesh", &shown(&finest.course.0, 4)));
    ledger.plot(plot);
    let (pressed, exact) = finest.pressure()?;
    hertz::ellipse(ledger, &[("1 m/s, finest mesh", &pressed, &exact)]);
    Ok(())
}

fn table<'a>(ledger: &mut Ledger, runs: impl Iterator<Item = &'a Rebound>) -> Result<(), CaseError> {
    let head = [
        "V [m/s]",
        "a/R",
        "h/R",
        "peak, Hertz %",
        "duration, Hertz %",
        "L2, Hertz %",
        "peak, balls %",
        "duration, balls %",
        "L2, balls %",
        "L2, pressure %",
        "wall [s]",
    ];
    let rows = runs.map(Rebound::row).collect::<Result<Vec<_>, _>>()?;
    ledger.table(
        "errors of force and pressure against Hertz and against elastic balls, and cost",
        &head,
        rows,
    );
    Ok(())
}
