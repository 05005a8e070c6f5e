//! Regression, not evidence: the plan and the counts of a run whose control flow cannot depend on the last bits.

use crate::common::{SANDWICH, varied};
use asperity::kinds;
use asperity_output::bodies::Recorder;
use asperity_plan::bodies;
use asperity_plan::reading::scene;
use asperity_vary::Change::Add;

#[test]
fn the_plan_of_the_sandwich_reads_as_before() {
    let scene = scene::read(SANDWICH).unwrap();
    let plan = bodies::plan(&scene).unwrap();
    insta::assert_snapshot!(plan.summary().to_string(), @r"
    plan
      physics   linear elasticity, small strain, plane strain (2 bodies, 1920 cells)
      physics   interface `fault`: node-to-point penalty contact, 41 slave nodes against 56 master faces, rate friction with 0 state variables a point
      path      condensed: bodies are linear and sliding is small, so each is factored once and only the interface is solved
      solver    direct: bodies by Cholesky factors, the interface by dense LU where friction acts; about 3.9 MiB of the 8.0 GiB allowed
      stepper   implicit: Newton with line search, backward Euler in slip, steps adapted to the error of slip
      start     interface `fault`: gaps from 0 m to 0 m at the 41 of 41 slave nodes that face the master, 0 without partner; 5.0000e-2 of 5.0000e-2 m face it
      size      4116 degrees of freedom, 196 in each step's system, 0 bytes of friction state, about 62 MB
    ");
}

#[test]
fn a_linear_stage_of_fixed_steps_costs_what_it_did() {
    let text = varied(SANDWICH, &[Add("stages[0].steps", "4")]);
    let mut scene = scene::read(&text).unwrap();
    scene.stages.truncate(1);
    let plan = bodies::plan(&scene).unwrap();
    let counts = kinds::bodies::run(&plan, &mut Recorder::new()).unwrap().counts;
    // Four steps; two bodies whose condensed stiffness comes with the factor, and a load channel that one of them sees.
    assert_eq!((counts.steps, counts.rejected, counts.operations.body_factorisations), (4, 0, 2));
    insta::assert_snapshot!(counts.operations.body_solves.to_string(), @"1");
}
