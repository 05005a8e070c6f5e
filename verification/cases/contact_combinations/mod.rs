//! What bodies, measures, enforcements, laws and steppers make together.

pub mod cell;
mod table;

use crate::{Capability, Case, CaseError, Ledger};
use cell::{Bodies, Cell, ENFORCEMENTS, Face, Kinematics, LAWS, Law, Pairing, Start};
use table::{Table, claims};

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
        for bodies in [Bodies::ELASTIC, Bodies::PLASTIC_FINITE] {
            let laws = [Law::Coulomb, Law::Capped, Law::Kinetic, Law::Rate, Law::Ageing];
            add(Kinematics::PlaneStrain, Face::Flat, bodies, pairing, &laws);
        }
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
    claims(ledger, Table::of(&cells)?);
    Ok(())
}

/// All of them in these kinematics.
///
/// # Errors
/// When a run cannot be set up after its plan was accepted.
pub fn everything(ledger: &mut Ledger, kinematics: &[Kinematics]) -> Result<(), CaseError> {
    let mut cells = Vec::new();
    for &kinematics in kinematics {
        for bodies in Bodies::ALL {
            for pairing in Pairing::ALL {
                add(&mut cells, kinematics, bodies, pairing);
            }
        }
    }
    claims(ledger, Table::of(&cells)?);
    Ok(())
}

/// Faces, starts, enforcements and laws of these bodies and this contact.
fn add(cells: &mut Vec<Cell>, kinematics: Kinematics, bodies: Bodies, pairing: Pairing) {
    for face in [Face::Flat, Face::Round] {
        // A side of a ring is round already.
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
