//! The state of a rate- and state-dependent fault between columns in antiplane motion, in the file of a station.
//!
//! Ageing, dθ/dt = 1 - V θ/L, with the slip between the rows, which another column has.

use super::last;
use crate::cases::run_files::Waves;
use crate::{Capability, CaseError, Evidence, Ledger};

/// Steps, each a row, and cells along a column, which a wave passes in two steps.
const STEPS: usize = 72;
const CELLS: usize = 40;
const END: f64 = 0.9;
/// L, and the slip rate at the start.
const LENGTH: f64 = 0.3;
const RATE: f64 = 0.1;

fn scene() -> String {
    let body = |name: &str, from: i32| {
        format!(
            "[bodies.{name}]\nmaterial = \"rock\"\n\
             mesh.block = {{ min = [{from}, 0], max = [{}, 1], divisions = [{CELLS}, 1], element = \"quad4\" }}\n",
            from + 1
        )
    };
    format!(
        "schema = 1\ntitle = \"remembering\"\nkinematics = \"antiplane\"\n[materials.rock]\nyoung = 2.5\npoisson = 0.25\ndensity = 1\n{}{}\
         [faults.f]\nminus = \"a.right\"\nplus = \"b.left\"\nnormal = 1\nshear = 0.5\nrate = {RATE:?}\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.5, a = 0.02, b = 0.03, l = {LENGTH:?}, v_ref = {RATE:?}, v_initial = {RATE:?} }}\n\
         pulses = [{{ traction = 0.3, centre = [0, 0.5], radius = 1e4, duration = 0.6 }}]\n\
         [[stages]]\nname = \"slip\"\nduration = {END:?}\nsteps = {STEPS}\n\
         conditions = [{{ set = \"a.left\", absorbing = true }}, {{ set = \"b.right\", absorbing = true }}]\n\
         [time]\nstepper = \"explicit\"\nviscosity = 0\n[output]\nsampling = {:?}\nstations.f = [[0, 0]]\n",
        body("a", -1),
        body("b", 0),
        END / STEPS as f64
    )
}

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    let run = Waves::from_text(&scene())?;
    let table = run.files.table("stations/f_000")?;
    let (times, slips, states) = (table.column("t")?, table.column("slip")?, table.column("state")?);
    let mut theta = LENGTH / RATE;
    let mut exact = vec![theta.log10()];
    for (t, s) in times.windows(2).zip(slips.windows(2)) {
        let (step, way) = (t[1] - t[0], s[1] - s[0]);
        // At a constant slip rate; without slip the state grows with time.
        theta = if way > 0.0 {
            let steady = LENGTH * step / way;
            steady + (theta - steady) * (-way / LENGTH).exp()
        } else {
            theta + step
        };
        exact.push(theta.log10());
    }
    let pace = exact.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f64::max);
    let fell = exact[0] - last(&exact)?;
    if fell < 20.0 * pace {
        return Err("the state hardly changes".into());
    }
    ledger
        .claim("state of a fault in the file of a station, which slip through its length makes forget, in all rows")
        .unit("log10 s")
        .norm("largest difference through time")
        .values(&states)
        .equals_each(&exact)
        .absolute(0.75 * pace)
        .evidence(Evidence::Exact, "dθ/dt = 1 - V θ/L, by its exact solution between rows with the slip in them")
        .because("states belong to the half steps between rows, where friction acts on slip rates: half of what a step changes, and half as much for the step that follows")
        .covers(&[Capability::DynamicRupture, Capability::Antiplane, Capability::Outputs])
        .cost(&run.cost)
        .record();
    Ok(())
}
