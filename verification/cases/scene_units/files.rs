//! Numbers of a scene that are in files of columns.

use super::{HEAD, square};
use crate::cases::run_files::{self, Folder};
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_plan::faults::{Plan, plan};
use asperity_plan::reading::scene;

/// Runs the claims on files.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    tables(ledger)?;
    traces(ledger)
}

/// A square that is drawn and pressed, by these tables.
fn drawn(motion: &str, pressure: &str) -> String {
    HEAD.to_owned()
        + &square(0)
        + &format!(
            "[[stages]]\nname = \"draw\"\nduration = \"3 d\"\nsteps = 6\n\
             conditions = [{{ set = \"b0.left\", x = {{ table = {motion} }} }}, {{ set = \"b0.bottom\", y = 0 }}, {{ set = \"b0.right\", pressure = {{ table = {pressure} }} }}]\n\
             [output]\npoints.p = {{ body = \"b0\", at = [1, 1] }}\nforces.f = {{ set = \"b0.left\" }}\n"
        )
}

/// Compares tables in a file with the same in the scene.
fn tables(ledger: &mut Ledger) -> Result<(), CaseError> {
    let inline = drawn(
        "[[\"0 d\", \"0 mm\"], [\"0.7 d\", \"0.57 mm\"], [\"3 d\", \"-0.1 mm\"]]",
        "[[\"0 d\", \"0 MPa\"], [\"0.7 d\", \"1.1 MPa\"], [\"3 d\", \"2.3 MPa\"]]",
    );
    let from_file = drawn(
        "{ file = \"test.csv\", column = \"stroke\" }",
        "{ file = \"test.csv\", column = \"confining\", time = \"time\" }",
    );
    let beside = Folder::new()?;
    std::fs::write(
        beside.path().join("test.csv"),
        "# a test\ntime [d],stroke [mm],confining [MPa]\n0,0,0\n0.7,0.57,1.1\n3,-0.1,2.3\n",
    )?;
    let lines = |text: &str| -> Result<(Vec<String>, Cost), CaseError> {
        let (files, cost) = run_files::bodies_beside(text, beside.path())?;
        let both = files.text("points/p.csv")? + &files.text("forces/f.csv")?;
        Ok((both.lines().map(str::to_owned).collect(), cost))
    };
    let ((one, _), (other, cost)) = (lines(&inline)?, lines(&from_file)?);
    let differ = one.iter().zip(&other).filter(|(a, b)| a != b).count() + one.len().abs_diff(other.len());
    ledger
        .claim(
            "lines of files of a square that differ with the tables of its motion and its pressure in a file",
        )
        .count(differ as u64, 0)
        .between(&inline, &from_file)
        .evidence(Evidence::Exact, "the same quantities")
        .because("a cell with the unit of its column is read like a value with its unit in a scene")
        .covers(&[Capability::Scenes])
        .cost(&cost)
        .record();
    Ok(())
}

/// A fault along vertices of a trace.
fn along(trace: &str) -> String {
    format!(
        "schema = 1\ntitle = \"a trace\"\nkinematics = \"plane-strain\"\n[time]\nstepper = \"fault-ode\"\n[materials.rock]\nyoung = 50e9\npoisson = 0.25\n\
         [medium]\nkind = \"whole-space\"\nmaterial = \"rock\"\n[faults.main]\nline = {{ trace = {trace}, spacing = \"100 m\" }}\nnormal = \"50 MPa\"\nrate = \"1e-9 m/s\"\n\
         law = {{ kind = \"rate-and-state\", evolution = \"ageing\", mu0 = 0.6, a = 0.02, b = 0.015, l = \"8 mm\", v_ref = \"1 um/s\", v_initial = \"1e-9 m/s\" }}\n\
         [[stages]]\nname = \"still\"\nduration = \"1 yr\"\n"
    )
}

/// Positions of the points of a plan, as bits.
fn places(plan: &Plan) -> Vec<u64> {
    plan.points.iter().flat_map(|point| point.at).map(f64::to_bits).collect()
}

/// Compares a trace in a file with the same in the scene.
fn traces(ledger: &mut Ledger) -> Result<(), CaseError> {
    let inline = along("[[\"0 km\", \"0 km\"], [\"1.3 km\", \"-7.1 km\"], [\"4 km\", \"-12 km\"]]");
    let from_file = along("{ file = \"trace.csv\" }");
    let beside = Folder::new()?;
    std::fs::write(beside.path().join("trace.csv"), "x [km],y [km]\n0,0\n1.3,-7.1\n4,-12\n")?;
    let one = places(&seas::plan(&inline)?);
    let (other, cost) = Cost::measure(|| -> Result<_, CaseError> {
        let scene = scene::read_in(&from_file, beside.path()).map_err(|e| e.to_string())?;
        Ok(places(&plan(&scene).map_err(|e| e.to_string())?))
    });
    let other = other?;
    let differ = one.iter().zip(&other).filter(|(a, b)| a != b).count() + one.len().abs_diff(other.len());
    ledger
        .claim("coordinates of points of a curved fault that differ with its trace in a file")
        .count(differ as u64, 0)
        .between(&inline, &from_file)
        .evidence(Evidence::Exact, "the same quantities")
        .because("as tables")
        .covers(&[Capability::Scenes])
        .cost(&cost)
        .record();
    Ok(())
}
