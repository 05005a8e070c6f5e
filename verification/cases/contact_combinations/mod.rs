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
    claims(ledger, Table::of(&cells)?);
    Ok(())
}

/// All of them.
pub fn everything(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut cells = Vec::new();
    for kinematics in
        [Kinematics::PlaneStrain, Kinematics::PlaneStress, Kinematics::Axisymmetric, Kinematics::Space]
    {
        for face in [Face::Flat, Face::Round] {
            // A side of a ring is round already.
            if (kinematics, face) == (Kinematics::Axisymmetric, Face::Round) {
                continue;
            }
            for bodies in Bodies::ALL {
                for pairing in Pairing::ALL {
                    for start in [Start::Smooth, Start::Rough] {
                        for enforcement in ENFORCEMENTS {
                            for law in LAWS {
                                let forward = false;
                                cells.push(Cell {
                                    kinematics,
                                    face,
                                    bodies,
                                    pairing,
                                    enforcement,
                                    law,
                                    start,
                                    forward,
                                });
                            }
                        }
                    }
                }
            }
        }
    }
    claims(ledger, Table::of(&cells)?);
    Ok(())
}
