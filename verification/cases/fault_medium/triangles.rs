//! Faults that are surfaces of triangles: tractions of rectangles in triangles, and a circular crack.

use super::{A, POISSON, SHEAR_MODULUS, slip, still};
use crate::cases::written::Folder;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_driver::fault::{Plan, plan_with};
use asperity_driver::scene;
use asperity_cycles::operator::Form;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Runs all claims on triangles.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    halves(ledger)?;
    disc(ledger)
}

type Triangle = [[f64; 3]; 3];

/// Plan of a scene whose file `fault.stl` holds these triangles, with full matrices.
fn planned(text: &str, triangles: &[Triangle]) -> Result<Plan, CaseError> {
    let mut file = "solid fault\n".to_string();
    for triangle in triangles {
        file += "facet normal 0 0 0\nouter loop\n";
        for [x, y, z] in triangle {
            writeln!(file, "vertex {x:?} {y:?} {z:?}")?;
        }
        file += "endloop\nendfacet\n";
    }
    let folder = Folder::new()?;
    std::fs::write(folder.path().join("fault.stl"), file + "endsolid fault\n")?;
    let scene = scene::read_in(text, folder.path()).map_err(|e| e.to_string())?;
    Ok(plan_with(&scene, Form::Dense).map_err(|e| e.to_string())?)
}

/// Cells of the rectangle along strike and down dip, and their size \[m\].
const CELLS: [usize; 2] = [5, 3];
const SIZE: f64 = 1e3;

/// A rectangle below the surface with this dip \[degrees\], and another fault that feels its slip. Slip may turn.
fn two(dip: f64, main: &str) -> String {
    let fault = format!("slip = \"free\"\nrake = [0.2, 0.1, 1.0]\n{main}");
    let text = still("3d", "half-space", &fault);
    let law = text.lines().find(|line| line.starts_with("law")).unwrap_or_default();
    let other = format!(
        "[faults.other]\n{law}\nnormal = \"50 MPa\"\nrate = \"1e-9 m/s\"\nslip = \"free\"\nrake = [1.0, 0.0, 0.3]\nrectangle = {{ from = [-4000.0, -500.0, -1000.0], to = [-1500.0, -500.0, 3000.0], dip = \"{:?} deg\", width = 2000.0, size = 1000.0 }}\n",
        90.0 - 0.5 * dip
    );
    text.replacen("[[stages]]", &format!("{other}[[stages]]"), 1)
}

/// The two triangles of each cell of the rectangle, row by row.
fn halved(dip: f64) -> Vec<Triangle> {
    let (s, c) = dip.to_radians().sin_cos();
    let c = if dip == 90.0 { 0.0 } else { c };
    let [columns, rows] = CELLS;
    // Strike is against z, so that the fault dips towards x.
    let at = |column: usize, row: usize| {
        let (along, down) = (column as f64 * SIZE, 200.0 + row as f64 * SIZE);
        [down * c, -down * s, 0.5 * SIZE * columns as f64 - along]
    };
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let halves = cells.flat_map(|(i, j)| {
        let (a, b, c, d) = (at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        [[a, b, c], [a, c, d]]
    });
    halves.collect()
}

/// Tractions on the other fault, shear and normal, of slip that is uniform over the cells of the first.
fn felt(plan: &Plan, parts: usize) -> Vec<f64> {
    let operator = &plan.problem.fault.operator;
    let n = operator.points();
    let mut slip = vec![0.0; 2 * n];
    for (p, slip) in slip.iter_mut().enumerate().filter(|(p, _)| p % n < parts * CELLS[0] * CELLS[1]) {
        *slip = ((p % n / parts) as f64 + 2.0 * (p / n) as f64).sin();
    }
    let (mut shear, mut normal) = (vec![0.0; 2 * n], vec![0.0; n]);
    operator.shear(&slip, &mut shear);
    operator.normal(&slip, &mut normal);
    let other = parts * CELLS[0] * CELLS[1]..n;
    [&shear[..n], &shear[n..], &normal[..]].iter().flat_map(|all| all[other.clone()].to_vec()).collect()
}

/// Compares rectangles with the two triangles of each, on another fault.
fn halves(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut worst = 0.0_f64;
    let mut spent = None;
    for dip in [90.0, 50.0] {
        let (s, c) = f64::to_radians(dip).sin_cos();
        let c = if dip == 90.0 { 0.0 } else { c };
        let half = 0.5 * SIZE * CELLS[0] as f64;
        let rectangle = format!(
            "rectangle = {{ from = [{x:?}, {y:?}, {half:?}], to = [{x:?}, {y:?}, {:?}], dip = \"{dip} deg\", width = {:?}, size = {SIZE:?} }}",
            -half,
            SIZE * CELLS[1] as f64,
            x = 200.0 * c,
            y = -200.0 * s,
        );
        let whole = planned(&two(dip, &rectangle), &[])?;
        let (halves, cost) =
            Cost::of(|| planned(&two(dip, "triangles.stl = { file = \"fault.stl\" }"), &halved(dip)));
        let (wanted, found) = (felt(&whole, 1), felt(&halves?, 2));
        if wanted.len() != found.len() {
            return Err("the faults have other points".into());
        }
        let scale = wanted.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let off = wanted.iter().zip(&found).map(|(a, b)| (a - b).abs());
        worst = worst.max(off.fold(0.0, f64::max) / scale);
        spent = Some(cost);
    }
    ledger
        .claim("shear and normal tractions on another fault, of rectangles given as two triangles each, dips of 90 and 50 degrees: largest difference over the largest traction")
        .value(worst)
        .at_most(1e-10)
        .evidence(Evidence::Exact, "two triangles are their rectangle; the two kernels share no formula")
        .because("rounding of both kernels at distances of some cells")
        .why_not_tighter("the rounding of coordinates in the file and of the kernels is not known to a factor")
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&spent.ok_or("no dip")?)
        .record();
    Ok(())
}

/// A disc with these rings of triangles, inclined, with a corner at each vertex of the rings. Every third triangle runs the
/// other way round.
fn rings(rings: usize) -> Vec<Triangle> {
    let (s, c) = 40f64.to_radians().sin_cos();
    let at = |ring: usize, step: usize| {
        let r = A * ring as f64 / rings as f64;
        let angle = if ring == 0 { 0.0 } else { TAU * (step % (6 * ring)) as f64 / (6 * ring) as f64 };
        let (up, along) = (r * angle.cos(), r * angle.sin());
        [-up * c, up * s, along]
    };
    let mut all = Vec::new();
    for ring in 1..=rings {
        for sector in 0..6 {
            for k in 0..ring {
                let (outer, inner) = (sector * ring + k, sector * (ring - 1) + k);
                all.push([at(ring - 1, inner), at(ring, outer), at(ring, outer + 1)]);
                if k + 1 < ring {
                    all.push([at(ring - 1, inner), at(ring, outer + 1), at(ring - 1, inner + 1)]);
                }
            }
        }
    }
    all.iter_mut().step_by(3).for_each(|triangle| triangle.swap(0, 1));
    all
}

/// Claims the potency of a circular crack.
fn disc(ledger: &mut Ledger) -> Result<(), CaseError> {
    let exact = 8.0 * (1.0 - POISSON) / (PI * (2.0 - POISSON)) / SHEAR_MODULUS * (2.0 / 3.0 * PI * A.powi(3));
    let text = still("3d", "whole-space", "rake = [0, 0, 1]\ntriangles.stl = { file = \"fault.stl\" }");
    let mut levels = Vec::new();
    let mut spent = None;
    for count in [4, 6, 9, 13] {
        let (plan, cost) = Cost::of(|| planned(&text, &rings(count)));
        let plan = plan?;
        let slip = slip(&plan)?;
        let found: f64 = plan.points.iter().zip(slip.iter()).map(|(p, s)| p.area * s).sum();
        levels.push((A / count as f64, (found / exact - 1.0).abs()));
        spent = Some(cost);
    }
    ledger
        .order("potency of a circular crack of triangles, inclined in a whole-space")
        .levels(&levels)
        .expected(1.0)
        .within(0.15)
        .evidence(Evidence::Exact, "8 (1 - nu)/(pi (2 - nu)) dtau/G sqrt(a^2 - r^2) (Eshelby)")
        .because("the square root at the rim, which cells of constant slip miss by O(h)")
        .finest(
            1.5 / 13.0,
            "the crack is longer by half a ring at most, and its potency grows with the third power of the radius",
        )
        .covers(&[Capability::Medium, Capability::Solid3d])
        .cost(&spent.ok_or("no level")?)
        .record();
    Ok(())
}
