//! What bodies, measures, enforcements, laws and steppers make together.

pub mod cell;
mod table;

use crate::{Capability, Case, CaseError, Ledger};
use cell::{Bodies, ENFORCEMENTS, Kinematics, LAWS, Law, Pairing, Start};
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
    let laws = [Law::Coulomb, Law::Capped, Law::Rate, Law::Ageing];
    let mut table = Table::default();
    for pairing in Pairing::ALL {
        for bodies in [Bodies::ELASTIC, Bodies::PLASTIC_FINITE] {
            table.compare(
                (Kinematics::PlaneStrain, bodies, pairing),
                &laws,
                &ENFORCEMENTS[..1],
                Start::Rough,
            )?;
        }
        table.compare(
            (Kinematics::Space, Bodies::ELASTIC, pairing),
            &[Law::Coulomb],
            &ENFORCEMENTS[..1],
            Start::Rough,
        )?;
    }
    claims(ledger, table);
    Ok(())
}

/// All of them.
pub fn everything(ledger: &mut Ledger) -> Result<(), CaseError> {
    let mut table = Table::default();
    for kinematics in [Kinematics::PlaneStrain, Kinematics::PlaneStress, Kinematics::Space] {
        for bodies in Bodies::ALL {
            for pairing in Pairing::ALL {
                for start in [Start::Smooth, Start::Rough] {
                    table.compare((kinematics, bodies, pairing), &LAWS, &ENFORCEMENTS, start)?;
                }
            }
        }
    }
    claims(ledger, table);
    Ok(())
}
