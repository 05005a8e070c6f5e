//! Faults that are surfaces of triangles: tractions of rectangles in triangles, and a circular crack.

use super::{A, POISSON, SHEAR_MODULUS, slip, still};
use crate::cases::run_files::Folder;
use crate::cases::seas;
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_cycles::operator::Form;
use asperity_plan::faults::{Plan, plan_with};
use asperity_plan::reading::scene;
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;

/// Runs all claims on triangles.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    halves(ledger)?;
    disc(ledger)?;
    event(ledger)
}

type Triangle = [[f64; 3]; 3];

/// Geometry of a fault in the file that [`planned`] writes.
pub const FROM_FILE: &str = "triangles.stl = { file = \"fault.stl\" }";

/// Plan of a scene whose file `fault.stl` holds these triangles.
pub fn planned(text: &str, triangles: &[Triangle], form: Form) -> Result<Plan, CaseError> {
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
    Ok(plan_with(&scene, form).map_err(|e| e.to_string())?)
}

/// Cells of the rectangle along strike and down dip, and their size \[m\].
const CELLS: [usize; 2] = [5, 3];
const SIZE: f64 = 1e3;
/// Depth of its upper edge along dip \[m\].
const TOP: f64 = 200.0;

/// A rectangle below the surface with this dip \[degrees\], and another fault that feels its slip. Slip may turn.
fn two(dip: f64, main: &str) -> String {
    let fault = format!("slip = \"free\"\nrake = [0.2, 0.1, 1.0]\n{main}");
    let text = still("3d", "half-space", &fault);
    let law = text.lines().find(|line| line.starts_with("law")).unwrap_or_default();
    let other = format!(
        "[faults.other]\n{law}\nnormal = \"50 MPa\"\nrate = \"1e-9 m/s\"\nslip = \"free\"\nrake = [1.0, 0.0, 0.3]\nrectangle = {{ from = [-4000.0, -500.0, -1000.0], to = [-1500.0, -500.0, 3000.0], dip = \"{:?} deg\", width = 2000.0, size = 1000.0 }}\n",
        90.0 - 0.5 * dip
    );
    let receivers =
        RECEIVERS.iter().enumerate().fold(String::new(), |all, (k, at)| all + &format!("r{k} = {at:?}\n"));
    format!("{text}{other}[output.receivers]\n{receivers}")
}

/// Positions at the surface and in the rock around both faults \[m\].
const RECEIVERS: [[f64; 3]; 5] = [
    [3000.0, 0.0, 1000.0],
    [-700.0, 0.0, -3500.0],
    [12e3, 0.0, -9e3],
    [700.0, -4000.0, 500.0],
    [-2500.0, -900.0, 4200.0],
];

/// The two triangles of each cell of a rectangle with its upper edge at this depth, row by row. It dips towards x.
pub fn halved(dip: f64, [columns, rows]: [usize; 2], (size, top): (f64, f64)) -> Vec<Triangle> {
    let (s, c) = dip.to_radians().sin_cos();
    let c = if dip == 90.0 { 0.0 } else { c };
    // Strike is against z.
    let at = |column: usize, row: usize| {
        let (along, down) = (column as f64 * size, top + row as f64 * size);
        [down * c, -down * s, 0.5 * size * columns as f64 - along]
    };
    let cells = (0..rows).flat_map(|row| (0..columns).map(move |column| (column, row)));
    let halves = cells.flat_map(|(i, j)| {
        let (a, b, c, d) = (at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j));
        [[a, b, c], [a, c, d]]
    });
    halves.collect()
}

/// Slip in both directions that is uniform over the cells of the first fault, which have so many parts each.
fn uniform_in_cells(n: usize, parts: usize) -> Vec<f64> {
    let mut slip = vec![0.0; 2 * n];
    for (p, slip) in slip.iter_mut().enumerate().filter(|(p, _)| p % n < parts * CELLS[0] * CELLS[1]) {
        *slip = ((p % n / parts) as f64 + 2.0 * (p / n) as f64).sin();
    }
    slip
}

/// Displacements of the receivers caused by this slip.
fn displaced(plan: &Plan, parts: usize) -> Vec<f64> {
    let slip = uniform_in_cells(plan.points.len(), parts);
    plan.receivers.all.iter().flat_map(|receiver| receiver.caused(slip.iter().copied())).collect()
}

/// Tractions on the other fault, shear and normal, of this slip.
fn felt(plan: &Plan, parts: usize) -> Vec<f64> {
    let operator = &plan.problem.fault.operator;
    let n = operator.points();
    let slip = uniform_in_cells(n, parts);
    let shear = operator.shear_of(&slip);
    let normal = operator.normal_of(&slip);
    let other = parts * CELLS[0] * CELLS[1]..n;
    [&shear[..n], &shear[n..], &normal[..]].iter().flat_map(|all| all[other.clone()].to_vec()).collect()
}

/// Compares rectangles with the two triangles of each, on another fault.
fn halves(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut worst = [0.0_f64; 2];
    let mut spent = None;
    for dip in [90.0, 50.0] {
        let (s, c) = f64::to_radians(dip).sin_cos();
        let c = if dip == 90.0 { 0.0 } else { c };
        let half = 0.5 * SIZE * CELLS[0] as f64;
        let rectangle = format!(
            "rectangle = {{ from = [{x:?}, {y:?}, {half:?}], to = [{x:?}, {y:?}, {:?}], dip = \"{dip} deg\", width = {:?}, size = {SIZE:?} }}",
            -half,
            SIZE * CELLS[1] as f64,
            x = TOP * c,
            y = -TOP * s,
        );
        let whole = planned(&two(dip, &rectangle), &[], Form::Dense)?;
        let (halves, cost) =
            Cost::measure(|| planned(&two(dip, FROM_FILE), &halved(dip, CELLS, (SIZE, TOP)), Form::Dense));
        let halves = halves?;
        let pairs = [(felt(&whole, 1), felt(&halves, 2)), (displaced(&whole, 1), displaced(&halves, 2))];
        for (worst, (wanted, found)) in worst.iter_mut().zip(pairs) {
            if wanted.is_empty() || wanted.len() != found.len() {
                return Err("the faults have other points".into());
            }
            let scale = wanted.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
            let off = wanted.iter().zip(&found).map(|(a, b)| (a - b).abs());
            *worst = worst.max(off.fold(0.0, f64::max) / scale);
        }
        spent = Some(cost);
    }
    let of = ["shear and normal tractions on another fault", "displacements at the surface and in the rock"];
    let cost = spent.ok_or("no dip")?;
    for (what, worst) in of.into_iter().zip(worst) {
        ledger
            .claim(format!("{what}, of rectangles given as two triangles each, dips of 90 and 50 degrees: largest difference over the largest value"))
            .value(worst)
            .at_most(1e-12)
            .evidence(Evidence::Exact, "two triangles are their rectangle; the two kernels share no formula")
            .because("rounding of both kernels at distances of some cells")
            .why_not_tighter("how digits are lost in both kernels is not known to a factor")
            .covers(&[Capability::Medium, Capability::Solid3d])
            .cost(&cost)
            .record();
    }
    Ok(())
}

/// Length and width of the fault of the event \[m\].
const EVENT: [f64; 2] = [18e3, 15e3];
/// Part of it on which friction weakens.
pub const DISC: &str = "{ centre = [0, \"-7 km\", 0], radius = \"6 km\" }";

/// A fault with a round patch that weakens, a disc.
pub fn weakening(geometry: &str, disc: &str) -> String {
    format!(
        r#"
schema = 1
title = "an event"
kinematics = "3d"
[materials.rock]
young = "80 GPa"
poisson = {POISSON}
density = 2670
[medium]
kind = "half-space"
material = "rock"
[faults.main]
law = {{ kind = "rate-and-state", evolution = "ageing", mu0 = 0.6, a = 0.03, b = 0.03, l = "70 mm", v_ref = "1 um/s", v_initial = "1e-9 m/s" }}
patches = [{{ disc = {disc}, edge = "3 km", a = 0.004 }}]
normal = "25 MPa"
rate = "1e-9 m/s"
damping = "radiation"
creep = {{ rate = "1e-9 m/s" }}
rake = [0, 0, 1]
{geometry}
[[stages]]
name = "cycle"
duration = "400 yr"
[time]
stepper = "fault-ode"
[events]
above = "1e-3 m/s"
"#
    )
}

/// Moment of the first event \[N m\].
fn moment(plan: &Plan) -> Result<(f64, Cost), CaseError> {
    let mut settings = plan.problem.settings;
    settings.most_events = Some(1);
    let found = seas::found(plan, &settings, |_| {})?;
    let event = found.events.first().ok_or("no event")?;
    let slip = event.details.slip.component(0);
    let moment = slip.iter().zip(&plan.points).map(|(s, p)| s * p.area * p.shear_modulus).sum();
    Ok((moment, found.cost))
}

/// Compares an event on triangles with that on ever smaller rectangles.
fn event(ledger: &mut Ledger) -> Result<(), CaseError> {
    let [length, width] = EVENT;
    let of_rectangles = |columns: f64| -> Result<f64, CaseError> {
        let half = 0.5 * length;
        let geometry = format!(
            "rectangle = {{ from = [0.0, 0.0, {half:?}], to = [0.0, 0.0, {:?}], width = {width:?}, size = {:?} }}",
            -half,
            length / columns
        );
        Ok(moment(&seas::plan(&weakening(&geometry, DISC))?)?.0)
    };
    let (coarse, fine) = (of_rectangles(36.0)?, of_rectangles(48.0)?);
    // Errors of rectangles are of first order.
    let limit = fine - (coarse - fine) / (48.0 / 36.0 - 1.0);
    let mut levels = Vec::new();
    let mut spent = None;
    for columns in [12, 18, 24] {
        let size = length / columns as f64;
        let cells = [columns, (width / size).round() as usize];
        let triangles = halved(90.0, cells, (size, 0.0));
        let (found, cost) = moment(&planned(&weakening(FROM_FILE, DISC), &triangles, Form::Dense)?)?;
        levels.push((size, (found / limit - 1.0).abs()));
        spent = Some(cost);
    }
    ledger
        .order("moment of an event on a fault of triangles, two to a square, against the limit of rectangles")
        .levels(&levels)
        .expected(1.0)
        .within(0.15)
        .evidence(
            Evidence::ConvergedSelf,
            "the same fault as a rectangle of cells of 500 and 375 m, extrapolated with order one; kernels of another formula",
        )
        .because("slip is uniform over cells, so that patches with a border of slip are longer by O(h)")
        .finest(0.025, "the error of rectangles of 750 m is 2.5 %, and triangles are half as large")
        .covers(&[Capability::Medium, Capability::Solid3d, Capability::FaultCycles])
        .cost(&spent.ok_or("no level")?)
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
        let (plan, cost) = Cost::measure(|| planned(&text, &rings(count), Form::Dense));
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
