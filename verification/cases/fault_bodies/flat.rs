//! Flat faults that reach the surface, between bodies: tractions of slip against dislocations below a free surface.

use super::{FAR, LAW, POISSON, ROCK, bent, drawn, material};
use crate::cases::dislocation::{self, Stress};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_plan::faults::Plan;
use nalgebra::Complex;

/// Length of the fault down its dip \[m\].
const LENGTH: f64 = 20e3;
/// Distance along it over which it slips \[m\].
const REACH: f64 = 18e3;

/// Numbers of cells.
const LEVELS: [usize; 3] = [20, 40, 80];

/// Slip \[m\] at a distance along the fault \[m\]: largest at the surface. Tractions below a thin wedge follow its second derivative, as forces of a
/// plate do, and must be smooth at its end.
fn slip(along: f64) -> f64 {
    (1.0 - (along / REACH).powi(2)).max(0.0).powi(6)
}

/// Body and fault of this dip \[degrees\], in this number of cells, with more keys of each.
fn parts(dip: f64, cells: usize, element: &str, [body, fault]: [&str; 2]) -> String {
    let (s, c) = dip.to_radians().sin_cos();
    format!(
        "{}[bodies.crust]\nmaterial = \"rock\"\nmesh.fault = {{ trace = [[0.0, 0.0], [{:?}, {:?}]], spacing = {:?}, min = [{:?}, {:?}], max = [{FAR:?}, 0.0], growth = 1.25, element = \"{element}\" }}\n{body}\n\
         [faults.main]\nminus = \"crust.fault.minus\"\nplus = \"crust.fault.plus\"\n{LAW}\n{fault}\n",
        material("rock", ROCK),
        LENGTH * c,
        -LENGTH * s,
        LENGTH / cells as f64,
        -FAR,
        -FAR
    )
}

/// Shear and normal tractions at a distance along the fault, from pieces 5 m long, one of them centred there.
fn tractions(dip: f64, along: f64) -> [f64; 2] {
    let (s, c) = dip.to_radians().sin_cos();
    let place = |a: f64| Complex::new(a * c, -a * s);
    let piece = 5.0;
    let shift = along - piece * ((along / piece).floor() + 0.5);
    let mut stress = Stress::default();
    // The first piece may be cut by the surface, the last one ends beyond the slip.
    for k in -1..=(REACH / piece).ceil() as i64 {
        let [top, bottom] = [k, k + 1].map(|k| (k as f64 * piece + shift).max(0.0));
        let b = Complex::new(c, -s) * slip(0.5 * (top + bottom));
        if top > 0.0 {
            dislocation::add(&mut stress, place(along), place(top), b, ROCK, POISSON);
        }
        if bottom > 0.0 {
            dislocation::add(&mut stress, place(along), place(bottom), -b, ROCK, POISSON);
        }
    }
    let (shear, normal) = stress.on([-c, s], [s, c]);
    [shear, normal]
}

/// True at distances along the fault that are nodes whatever the number of cells, away from its ends: there tractions are averages over
/// half a length.
fn common(along: f64) -> bool {
    let number = along / LENGTH * LEVELS[0] as f64;
    (number - number.round()).abs() < 1e-3 && (2.0..19.0).contains(&number.round())
}

/// Largest errors of shear and normal tractions over the largest shear traction.
fn errors(plan: &Plan, dip: f64) -> [f64; 2] {
    let along: Vec<f64> = plan.points.iter().map(|p| p.at[0].hypot(p.at[1])).collect();
    let slip: Vec<f64> = along.iter().map(|&a| slip(a)).collect();
    let operator = &plan.problem.fault.operator;
    let found = [operator.shear_of(&slip), operator.normal_of(&slip)];
    let (mut worst, mut scale) = ([0.0_f64; 2], 0.0_f64);
    for p in (0..along.len()).filter(|&p| common(along[p])) {
        let wanted = tractions(dip, along[p]);
        scale = scale.max(wanted[0].abs());
        worst = std::array::from_fn(|c| worst[c].max((found[c][p] - wanted[c]).abs()));
    }
    worst.map(|w| w / scale)
}

/// Claims tractions on faults of dips at which rows of cells follow them.
pub fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for dip in [5.0, 2.0, 1.0] {
        let mut levels = [Vec::new(), Vec::new()];
        let mut spent = None;
        for cells in LEVELS {
            let sides = r#"{ set = "crust.left", x = 0, y = 0 }, { set = "crust.right", x = 0, y = 0 }"#;
            let (plan, cost) =
                Cost::measure(|| bent("plane-strain", &parts(dip, cells, "quad9", ["", ""]), sides));
            for (list, error) in levels.iter_mut().zip(errors(&plan?, dip)) {
                list.push((LENGTH / cells as f64, error));
            }
            spent = Some(cost);
        }
        let cost = spent.ok_or("no level")?;
        let of_normal = "they follow the bending of a wedge that is thinner than a cell is long; of second order where it is thicker";
        let kinds = [("shear", 2.0, "lumped interface mass"), ("normal", 1.0, of_normal)];
        for ((kind, order, because), levels) in kinds.into_iter().zip(&levels) {
            ledger
                .order(format!("{kind} tractions of slip on a fault of dip {dip} between bodies, largest error over the largest shear traction"))
                .levels(levels)
                .expected(order)
                .within(0.3)
                .or_better()
                .evidence(Evidence::SemiAnalytic, "edge dislocations below a free surface by complex potentials, in pieces of 5 m")
                .because(because)
                .why_not_tighter("a bound for all dips, of which the flattest errs most")
                .finest(4e-3, "(250 m/4 km)^2 = 0.4 % for slip that falls over some 4 km")
                .covers(&[Capability::FaultCycles, Capability::PlaneStrain])
                .cost(&cost)
                .record();
        }
    }
    in_space(ledger)
}

/// Claims the same for a slab, whose wedge ends in prisms, against the plane.
fn in_space(ledger: &mut Ledger) -> Result<(), CaseError> {
    let (dip, cells) = (5.0, 8);
    let on = |sides: &[&str], what: &str| {
        sides.iter().map(|s| format!("{{ set = \"crust.{s}\", {what} }}, ")).collect::<String>()
    };
    let far = ["left", "right"];
    let plane = bent("plane-strain", &parts(dip, cells, "quad4", ["", ""]), &on(&far, "x = 0, y = 0"))?;
    let parts = parts(dip, cells, "quad4", ["extrude = [0, 1e3]", "rake = [-1, 0, 0]"]);
    let conditions = on(&far, "x = 0, y = 0, z = 0") + &on(&["back", "front"], "z = 0");
    let (solid, cost) = Cost::measure(|| bent("3d", &parts, &conditions));
    drawn(ledger, "on a fault of dip 5 drawn", "plane-strain", (&plane, &solid?), &cost)
}
