//! Combinations of bodies, measures, enforcements, laws and steppers.

pub mod cell;
mod table;

use super::texts::simulate;
use crate::cases::body_plots;
use crate::{Capability, Case, CaseError, Evidence, Ledger};
use asperity_plan::reading::scene;
use asperity_vary::SceneText;
use cell::{Bodies, Cell, ENFORCEMENTS, Face, Kinematics, LAWS, Law, Pairing, Start};
use table::{Table, claims, distance};

/// See the README.
pub const CASE: Case = Case {
    name: "contact_combinations",
    readme: include_str!("README.md"),
    covers: &[Capability::StaticExplicit, Capability::Implicit],
    quick: true,
    run,
};

fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut cells = Vec::new();
    let mut add = |kinematics, face, bodies, pairing, laws: &[Law]| {
        for &law in laws {
            let (enforcement, start) = (ENFORCEMENTS[0], Start::Rough);
            cells.push(Cell { kinematics, face, bodies, pairing, enforcement, law, start, forward: false });
        }
    };
    for pairing in Pairing::ALL {
        let laws = [Law::Coulomb, Law::Capped, Law::Kinetic, Law::Rate, Law::Ageing];
        add(Kinematics::PlaneStrain, Face::Flat, Bodies::ELASTIC, pairing, &laws);
        let laws = [Law::Coulomb, Law::Kinetic, Law::Ageing];
        add(Kinematics::PlaneStrain, Face::Flat, Bodies::PLASTIC_FINITE, pairing, &laws);
        add(Kinematics::Axisymmetric, Face::Flat, Bodies::ELASTIC, pairing, &[Law::Coulomb, Law::Ageing]);
        add(Kinematics::PlaneStrain, Face::Round, Bodies::ELASTIC, pairing, &[Law::Coulomb, Law::Ageing]);
        add(Kinematics::Space, Face::Flat, Bodies::ELASTIC, pairing, &[Law::Coulomb]);
    }
    for pairing in Pairing::ALL {
        for enforcement in [ENFORCEMENTS[1], ENFORCEMENTS[2]] {
            cells.extend([Law::Coulomb, Law::Ageing].map(|law| Cell {
                kinematics: Kinematics::PlaneStrain,
                face: Face::Flat,
                bodies: Bodies::ELASTIC,
                pairing,
                enforcement,
                law,
                start: Start::Rough,
                forward: false,
            }));
        }
    }
    claims(ledger, Table::from_cells(&cells)?);
    closing(ledger)
}

/// A round die is pressed with friction from first contact on. Points close one after another; an implicit step that contains
/// several closings applies their friction at once.
fn closing(ledger: &mut Ledger) -> Result<(), CaseError> {
    let cell = Cell {
        kinematics: Kinematics::PlaneStress,
        face: Face::Round,
        bodies: Bodies::ELASTIC,
        pairing: Pairing::ALL[0],
        enforcement: ENFORCEMENTS[0],
        law: Law::Coulomb,
        start: Start::Rough,
        forward: false,
    };
    let pressed = |text: &str| -> Result<[f64; 3], CaseError> {
        Ok(simulate(text)?.report.forces.first().ok_or("no force is reported")?.value)
    };
    let exact = pressed(&Cell { forward: true, ..cell }.text()?)?;
    let mut levels = Vec::new();
    for steps in [125, 250, 500, 1000] {
        let text =
            SceneText::new(&cell.text()?).add("stages[0].steps", steps).without("time.max_step").text()?;
        levels.push((1.0 / f64::from(steps), distance(&exact, &pressed(&text)?)));
    }
    ledger
        .order("force of implicit against static-explicit steps, a round die pressed with friction from the first touch")
        .levels(&levels)
        .expected(1.0)
        .within(0.3)
        .finest(2e-4, "mu times the share of the force that grows within a step")
        .because(
            "a point that closes within an implicit step meets friction with the motion of the rest of the step, of first order in it; \
             static-explicit steps end at each closing, and between closings sticking is linear",
        )
        .why_not_tighter("where in a step a point closes differs from level to level")
        .evidence(Evidence::SemiAnalytic, "piecewise linear between closings, at which static-explicit steps end: exact but for rounding")
        .covers(&[Capability::StaticExplicit, Capability::Implicit])
        .record();
    Ok(())
}

/// All combinations in these kinematics.
///
/// # Errors
/// If a run cannot be set up after its plan was accepted.
pub fn everything(ledger: &mut Ledger, kinematics: &[Kinematics]) -> Result<(), CaseError> {
    let mut cells = Vec::new();
    for &kinematics in kinematics {
        for bodies in Bodies::ALL {
            for pairing in Pairing::ALL {
                add(&mut cells, kinematics, bodies, pairing);
            }
        }
    }
    if let Some(cell) = cells.iter().find(|cell| cell.face == Face::Round) {
        let scene = scene::read(&cell.text()?).map_err(|error| error.to_string())?;
        body_plots::stage(ledger, "One of the runs", &scene, "draw")?;
    }
    claims(ledger, Table::from_cells(&cells)?);
    Ok(())
}

/// Adds all faces, starts, enforcements and laws for these bodies and this contact.
fn add(cells: &mut Vec<Cell>, kinematics: Kinematics, bodies: Bodies, pairing: Pairing) {
    for face in [Face::Flat, Face::Round] {
        // The side of a ring is already round.
        if (kinematics, face) == (Kinematics::Axisymmetric, Face::Round) {
            continue;
        }
        for start in [Start::Smooth, Start::Rough] {
            for enforcement in ENFORCEMENTS {
                let forward = false;
                cells.extend(LAWS.map(|law| Cell {
                    kinematics,
                    face,
                    bodies,
                    pairing,
                    enforcement,
                    law,
                    start,
                    forward,
                }));
            }
        }
    }
}
