//! Rotations of viscous bodies: the stress of each branch turns with the body while it relaxes.

use crate::cases::body::{self, Body};
use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity_fem::element::ElementKind;
use asperity_fem::kinematics::Idealisation;
use asperity_fem::material::elastic::Elastic;
use asperity_fem::material::maxwell::{Branch, Maxwell};
use asperity_fem::nonlinear::{Kinematics, Material};

use super::{POISSON, YOUNG};

const SHEAR: f64 = YOUNG / (2.0 * (1.0 + POISSON));
/// Branches beside a spring of 0.2 G: shares of G and times of relaxation \[s\].
const BRANCHES: [(f64, f64); 2] = [(0.5, 1.0), (0.3, 0.2)];
/// Time of the turn \[s\].
const TURN: f64 = 1.5;
/// Angle of the turn \[degrees\].
const ANGLE: f64 = 360.0;
/// Reason of bounds near rounding.
const ROUNDING: &str = "rounding";

pub(super) fn claims(ledger: &mut Ledger) -> Result<(), CaseError> {
    for degrees in [7.5, 45.0, 120.0] {
        solid(ledger, degrees)?;
    }
    sheet(ledger)
}

/// A spring and two branches.
fn material() -> Result<Material, CaseError> {
    let branches = BRANCHES.map(|(share, time)| Branch { share, viscosity: share * SHEAR * time });
    Ok(Material::Maxwell(Maxwell::generalised(&Elastic::new(YOUNG, POISSON)?, &branches)?))
}

/// The part of a deviator at held strain that is left after a time.
fn left(time: f64) -> f64 {
    let (shares, parts): (Vec<f64>, Vec<f64>) =
        BRANCHES.iter().map(|(share, relaxation)| (share, share * (-time / relaxation).exp())).unzip();
    1.0 - shares.iter().sum::<f64>() + parts.iter().sum::<f64>()
}

type Matrix = [[f64; 3]; 3];

/// Rotation by an angle about the axis (1, 2, 2)/3, after Rodrigues.
fn rotation(angle: f64) -> Matrix {
    let axis = [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0];
    let (sin, cos) = angle.sin_cos();
    let cross = [[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]];
    let unit = |i, j| if i == j { cos } else { 0.0 };
    let entry = |i: usize, j: usize| unit(i, j) + sin * cross[i][j] + (1.0 - cos) * axis[i] * axis[j];
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

/// R σ Rᵀ for xx, yy, zz, xy, yz, zx.
fn turned(r: &Matrix, s: &[f64; 6]) -> [f64; 6] {
    let whole = [[s[0], s[3], s[5]], [s[3], s[1], s[4]], [s[5], s[4], s[2]]];
    let entry = |i: usize, j: usize| -> f64 {
        (0..3).map(|k| (0..3).map(|l| r[i][k] * whole[k][l] * r[j][l]).sum::<f64>()).sum()
    };
    [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)].map(|(i, j)| entry(i, j))
}

/// A cube strained at once, then turned about an inclined axis while it relaxes.
fn solid(ledger: &mut Ledger, degrees: f64) -> Result<(), CaseError> {
    let mesh = body::grid::<3>(ElementKind::Hex8, [0.0; 3], [1.0; 3], [2; 3])?;
    let mesh = body::distorted(mesh, [1.0; 3], 0.5, 0.1);
    let options = body::model(material()?, Idealisation::ThreeD, Kinematics::UpdatedLagrangian);
    let mut body = Body::new(mesh, options, &[])?;
    let strained =
        |x: [f64; 3]| [1.1 * x[0] + 0.2 * x[1], 0.95 * x[1] - 0.1 * x[2], 1.05 * x[2] + 0.1 * x[0]];
    let to = |r: Matrix| {
        move |x: [f64; 3]| -> [f64; 3] {
            let place = strained(x);
            std::array::from_fn(|i| (0..3).map(|j| r[i][j] * place[j]).sum::<f64>() - x[i])
        }
    };
    let u = body::field(&body.mesh, to(rotation(0.0)));
    body.follow(u, 0.0)?;
    let start = body.block.stress_at_points()[0];
    let mean = (start[0] + start[1] + start[2]) / 3.0;
    let steps = (ANGLE / degrees) as usize;
    let (outcome, cost) = Cost::measure(|| -> Result<f64, CaseError> {
        let mut worst = 0.0_f64;
        for k in 1..=steps {
            let r = rotation((degrees * k as f64).to_radians());
            let u = body::field(&body.mesh, to(r));
            body.follow(u, TURN / steps as f64)?;
            let left = left(TURN * k as f64 / steps as f64);
            let relaxed: [f64; 6] = std::array::from_fn(|i| {
                let mean = if i < 3 { mean } else { 0.0 };
                mean + left * (start[i] - mean)
            });
            worst =
                worst.max(body::largest_difference(&body.block.stress_at_points(), &turned(&r, &relaxed)));
        }
        Ok(worst)
    });
    let scale = start.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    let shrunk = (0.5 * degrees).to_radians().cos();
    ledger
        .claim(format!("stress of a spring with two Maxwell branches over its largest component, all steps of a full turn about an inclined axis, {degrees} degrees each"))
        .value(outcome? / scale)
        .at_most(1e-12 / (shrunk * shrunk))
        .evidence(Evidence::Exact, "R (p 1 + sum of share exp(-t/T) s) R^T of the stress p 1 + s before the turn")
        .because("a turn strains nothing, so that each branch relaxes as at held strain; rounding as for the elastic body")
        .why_not_tighter(ROUNDING)
        .covers(&[Capability::FiniteStrain, Capability::Viscoelasticity])
        .cost(&cost.counts(&body.work))
        .record();
    Ok(())
}

/// A sheet in plane stress strained at once, turned in its plane while it relaxes, against the same without the turn.
fn sheet(ledger: &mut Ledger) -> Result<(), CaseError> {
    let ends = [0.0, ANGLE].map(relaxed_sheet);
    let [still, turned] = ends;
    let (still, turned) = (still?, turned?);
    let scale = still.0.iter().fold(0.0, |m: f64, s| m.max(s.abs()));
    ledger
        .claim("stress of a viscous sheet in plane stress, turned by 360 degrees in 12 steps, less that of the sheet that is not turned, over its largest component")
        .value(body::largest_difference(&[turned.0], &still.0) / scale)
        .at_most(1e-12)
        .evidence(Evidence::Exact, "the sheet is where it was, and a turn strains nothing")
        .between("without turn", "360 degrees")
        .because("rounding of 12 steps in strains of 1e-16 times E over the stress of 0.1 E")
        .why_not_tighter(ROUNDING)
        .covers(&[Capability::FiniteStrain, Capability::Viscoelasticity])
        .record();
    ledger
        .claim("thickness strain of the same sheet less that of the sheet that is not turned")
        .value((turned.1 - still.1).abs())
        .at_most(1e-14)
        .evidence(Evidence::Exact, "the sheet is where it was, and a turn strains nothing")
        .between("without turn", "360 degrees")
        .because("rounding of 12 steps in strains, some units of 1e-16 each")
        .why_not_tighter(ROUNDING)
        .covers(&[Capability::FiniteStrain, Capability::Viscoelasticity])
        .record();
    Ok(())
}

/// Stress and thickness strain of a sheet after a turn by some degrees.
fn relaxed_sheet(degrees: f64) -> Result<([f64; 6], f64), CaseError> {
    let mesh = body::grid::<2>(ElementKind::Quad4, [0.0; 2], [1.0; 2], [2; 2])?;
    let mesh = body::distorted(mesh, [1.0; 2], 0.5, 0.2);
    let options = body::model(material()?, Idealisation::PlaneStress, Kinematics::UpdatedLagrangian);
    let mut body = Body::new(mesh, options, &[])?;
    let steps = 12;
    for k in 0..=steps {
        let angle = (degrees * f64::from(k) / f64::from(steps)).to_radians();
        let u = body::field(&body.mesh, |[x, y]| {
            let place = [1.1 * x + 0.1 * y, 0.98 * y];
            let [a, b] = body::turned(angle, place);
            [place[0] + a - x, place[1] + b - y]
        });
        body.follow(u, if k == 0 { 0.0 } else { TURN / f64::from(steps) })?;
    }
    let thickness = body.block.thickness_strain_at_points().ok_or("no thickness is kept")?[0];
    Ok((body.block.stress_at_points()[0], thickness))
}
