//! A ring pushed up a cone: axisymmetric sliding.

use super::{COEFFICIENTS, MEASURES, ratio, with_friction};
use crate::cases::texts::simulate;
use crate::{Capability, CaseError, Evidence, Ledger};
use asperity_vary::Change::{self, With};

const SCENE: &str = include_str!("cone.toml");

/// Slave and master exchanged: mortar contact uses the normals of the slave, so the rigid cone must be the slave.
const SWAPPED: [Change<'_>; 2] =
    [With("interfaces.contact.slave", "cone.right"), With("interfaces.contact.master", "ring.left")];

pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    for (name, capability) in MEASURES {
        for mu in COEFFICIENTS {
            let entering = name == "mortar" && mu > 0.0;
            let sides: &[Change<'_>] = if name == "mortar" { &SWAPPED } else { &[] };
            let scene = with_friction(SCENE, "contact", mu).with_or_same("interfaces.contact.measure", name);
            let done = simulate(&scene.changed(sides).text()?)?;
            let radial: Vec<f64> = done.force("contact")?.iter().map(|f| f[0]).collect();
            let pushed: Vec<f64> = done.force("pushed")?.iter().map(|f| f[1]).collect();
            // The first steps close the contact node by node.
            let ratios: Vec<f64> = pushed.iter().zip(&radial).skip(3).map(|(p, r)| p / r).collect();
            ledger
                .claim(format!("axial over radial force of a ring on a cone, mu = {mu}, {name}"))
                .values(&ratios)
                .equals_each(&vec![ratio(mu); ratios.len()])
                .absolute(if entering { 1e-3 } else { 1e-10 })
                .evidence(Evidence::Exact, "(tan a + mu)/(1 - mu tan a), tan a = 0.1: all points slide up one slope")
                .because(if entering {
                    "normals follow the cone exactly; but nodes of the cone that meet the ring have not slipped before and stick in the step in \
                     which they do: 25 mm of a segment of 447 mm, of which the weight is half the square, 1.6e-3 of a node's load, and the \
                     ring lies on two nodes and a half"
                } else {
                    "normals and friction follow the cone exactly, and the areas cancel: what Newton leaves"
                })
                .why_not_tighter("Newton stops at 1e-11 of the largest force")
                .covers(&[capability, Capability::FiniteSliding, Capability::Axisymmetric])
                .cost(&done.cost)
                .record();
            if mu == 0.3 {
                hoop(ledger, name, &done, radial.last().copied().unwrap_or(f64::NAN), capability)?;
            }
        }
    }
    Ok(())
}

/// Radial contact force balanced by the hoop stress: R = 2 pi times the integral of s_zz over the section.
fn hoop(
    ledger: &mut Ledger,
    name: &str,
    done: &crate::cases::texts::BodyRun,
    radial: f64,
    capability: Capability,
) -> Result<(), CaseError> {
    let end = done.record.stage_end("push").ok_or("the stage was not reached")?;
    let stress = &end.bodies.as_ref().ok_or("the bodies were not kept")?.cell_stress;
    let mesh = &done.record.setup().mesh;
    let ring = mesh.bodies.iter().position(|b| b == "ring").ok_or("the scene has no ring")?;
    let mut sum = 0.0;
    for ((cell, body), s) in mesh.cells.iter().zip(&mesh.cell_body).zip(stress) {
        if *body == ring {
            let x: Vec<[f64; 3]> = cell.points.iter().map(|&n| mesh.nodes[n]).collect();
            let (d, e) = ([x[2][0] - x[0][0], x[2][1] - x[0][1]], [x[3][0] - x[1][0], x[3][1] - x[1][1]]);
            sum += s[2] * 0.5 * (d[0] * e[1] - d[1] * e[0]).abs();
        }
    }
    ledger
        .claim(format!("radial force of the contact against the hoop stress of the ring, {name}"))
        .unit("N")
        .value(radial)
        .equals(2.0 * std::f64::consts::PI * sum)
        .relative(2e-3)
        .evidence(Evidence::Exact, "equilibrium of half a ring")
        .because(
            "u_r = 1 is a displacement of the mesh whose only strain is 1/r, so the balance holds in the discrete equations; but stresses of cells \
             are means over their volume and not over their section, which weighs a stress that falls with r by (0.1 m/r)^2/12 = 8e-4 less",
        )
        .why_not_tighter("an estimate of the difference of the two means")
        .covers(&[capability, Capability::Axisymmetric, Capability::Balance])
        .cost(&done.cost)
        .record();
    Ok(())
}
