//! Names of energies.

/// Energies in the order of the columns of files, in every kind of run.
pub const ENERGIES: [&str; 14] = [
    "kinetic",
    "elastic",
    "contact",
    "springs",
    "plastic",
    "viscous",
    "friction",
    "numerical",
    "absorbed",
    "handover",
    "start",
    "loads",
    "motions",
    "released",
];
