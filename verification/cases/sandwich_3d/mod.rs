//! A layer of the sandwich held in z reproduces plane strain, and results do not depend on the number of threads.

use super::sandwich::{self, Run, Scene};
use crate::{Capability, Case, CaseError, Cost, Evidence, Ledger};

/// See the README.
pub const CASE: Case = Case {
    name: "sandwich_3d",
    readme: include_str!("README.md"),
    covers: &[
        Capability::Solid3d,
        Capability::Solids,
        Capability::PenaltyContact3d,
        Capability::VelocityFriction,
        Capability::Condensation,
    ],
    quick: true,
    run,
};

/// Element size \[mm\]; the layer is four of them thick.
const SIZE: f64 = 5.0;

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let plane = sandwich::size(sandwich::base()?, SIZE);
    let two = sandwich::simulate(&plane)?;
    let solid = sandwich::layer(plane, 4.0 * SIZE, "hex8");
    let scene = sandwich::imposed(solid, two.record.times());
    let (three, cost) = Cost::measure(|| sandwich::simulate(&scene));
    let three = three?;
    layer(ledger, &two, &three, &cost.counts(&three.report.counts))?;
    threads(ledger)
}

/// Largest difference of a field between the layer and the plane model at nodes of equal y, over the largest value.
fn difference(
    two: &Run,
    three: &Run,
    stage: &str,
    field: fn(&asperity_output::bodies::view::InterfaceFields) -> &Vec<f64>,
) -> Result<f64, CaseError> {
    let (plane, solid) = (field(two.end(stage)?), field(three.end(stage)?));
    let largest = plane.iter().map(|v| v.abs()).fold(0.0, f64::max);
    let mut difference = 0.0_f64;
    for (value, y) in solid.iter().zip(three.heights()) {
        difference = difference.max((value.abs() - plane[two.node_at(y)?].abs()).abs());
    }
    Ok(difference / largest)
}

fn layer(ledger: &mut Ledger, two: &Run, three: &Run, cost: &Cost) -> Result<(), CaseError> {
    let values = [
        difference(two, three, "press", |f| &f.normal_traction)?,
        difference(two, three, "shear", |f| &f.normal_traction)?,
        difference(two, three, "shear", |f| &f.shear_traction)?,
        difference(two, three, "shear", |f| &f.slip)?,
    ];
    ledger
        .claim("largest difference between the layer and plane strain: normal traction after press and shear, shear traction, slip")
        .values(&values)
        .equals_each(&[0.0; 4])
        .absolute(1e-8)
        .evidence(Evidence::Exact, "with u_z = 0 on both faces the plane-strain field lies in the space of the layer, on the same steps")
        .because("both runs converge to 1e-11 of the largest force; the interface is some hundred times softer")
        .why_not_tighter("Newton usually ends far below its tolerance")
        .cost(cost)
        .record();
    Ok(())
}

/// Runs the same scene on one thread and on two.
fn threads(ledger: &mut Ledger) -> Result<(), CaseError> {
    let scene: Scene = sandwich::equal_steps(sandwich::size(sandwich::base()?, 1.25), 60);
    let with = |n: usize| -> Result<(Run, usize), CaseError> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(n).build()?;
        Ok((pool.install(|| sandwich::simulate(&scene))?, pool.current_num_threads()))
    };
    let ((one, alone), (two, together)) = (with(1)?, with(2)?);
    let mut different = 0_u64;
    for (a, b) in one.record.stage_ends().iter().zip(two.record.stage_ends()) {
        let (a, b) = (&a.interfaces[0], &b.interfaces[0]);
        for (x, y) in
            [(&a.slip, &b.slip), (&a.normal_traction, &b.normal_traction), (&a.slip_rate, &b.slip_rate)]
        {
            different += x.iter().zip(y).filter(|(x, y)| x.to_bits() != y.to_bits()).count() as u64;
        }
    }
    ledger
        .claim("values of slip, normal traction and slip rate that differ in any bit between one and two threads")
        .count(different, 0)
        .between(&alone, &together)
        .evidence(Evidence::Exact, "tasks of a fixed size, sums in a fixed order")
        .because("nothing may depend on the number of threads")
        .covers(&[Capability::Determinism])
        .record();
    Ok(())
}
