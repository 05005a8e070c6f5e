//! The table of plausible values: what a quantity of rock, metal or a laboratory may be. A value outside has most likely lost its
//! unit, or has that of another quantity.

use crate::units::Dimension;

/// Friction coefficients above this are percentages or tractions \[-\]: rocks have 0.1 to 1, rubber up to 4.
const MOST_FRICTION: f64 = 4.0;

/// Slip rates of loads, of creep and at the start beyond this are those of a rupture \[m/s\]: a centimetre per second.
const SLOW: f64 = 1e-2;
/// Largest angle \[rad\]: a turn, with room for rounding.
const TURN: f64 = 6.284;
/// Length of a quarter of a meridian, beyond which there is no position on Earth \[m\], with a margin for false eastings.
const EARTH: f64 = 2e7;

/// A value from which a quantity is refused.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum RefusalBound {
    /// Never: it is only doubtful.
    Never,
    /// The speed of shear waves in the fastest rock of the scene.
    Waves,
    /// This value in SI.
    From(f64),
}

/// A quantity.
#[derive(Debug)]
pub(super) struct Quantity {
    /// Its name in the plural.
    pub name: &'static str,
    /// SI unit, as in the schema; empty for a plain number.
    pub unit: &'static str,
    /// Ends of the paths of its keys, in which names and some keys are left out; none for all other keys of the unit.
    pub keys: &'static [&'static str],
    /// Magnitudes that are plausible, beside zero.
    pub usual: [f64; 2],
    /// Magnitudes that are refused.
    pub refused: RefusalBound,
    /// A usual value as it is written.
    pub example: &'static str,
}

const fn row(
    (name, unit): (&'static str, &'static str),
    keys: &'static [&'static str],
    usual: [f64; 2],
    example: &'static str,
) -> Quantity {
    Quantity { name, unit, keys, usual, refused: RefusalBound::Never, example }
}

const fn refused(row: Quantity, refused: RefusalBound) -> Quantity {
    Quantity { refused, ..row }
}

/// The table. The row with the longest matching path counts. Keys of `faulted` are those of scenes with faults, whose loads
/// are slow.
pub(super) const QUANTITIES: &[Quantity] = &[
    row(("Young's moduli", "Pa"), &["young"], [1e4, 1e16], "\"44.8 GPa\""),
    row(("yield stresses", "Pa"), &["yield", "plasticity.table"], [1e3, 1e11], "\"300 MPa\""),
    row(("moduli of hardening", "Pa"), &["modulus"], [1e3, 1e12], "\"1 GPa\""),
    row(("limits of friction", "Pa"), &["f_limit"], [1e3, 2e10], "\"100 MPa\""),
    row(("cohesions", "Pa"), &["cohesion"], [1e3, 1e9], "\"1 MPa\""),
    row(
        ("tractions", "Pa"),
        &["normal", "shear", "normal_floor", "normal_initial", "traction", "pressure", "initial_stress"],
        [1e3, 2e10],
        "\"50 MPa\"",
    ),
    row(("stresses and pressures", "Pa"), &[], [1e3, 2e11], "\"50 MPa\""),
    refused(
        row(
            ("slip rates of loads, of creep and at the start", "m/s"),
            &[
                "faults.rate",
                "creep.rate",
                "patches.rate",
                "profiles.rate",
                "load.rate",
                "sliders.rate",
                "sliders.start",
                "faulted.conditions.rate",
                "v_initial",
                "v_ref",
            ],
            [0.0, SLOW],
            "\"1e-9 m/s\"",
        ),
        RefusalBound::Waves,
    ),
    refused(
        row(("rates of sides", "m/s"), &["conditions.rate"], [0.0, 10.0], "\"1 mm/s\""),
        RefusalBound::Waves,
    ),
    refused(
        row(
            ("thresholds of slip rates", "m/s"),
            &["events.above", "events.below", "slow_above", "slow_below", "rupture_rate", "handover"],
            [0.0, 1.0],
            "\"1 mm/s\"",
        ),
        RefusalBound::Waves,
    ),
    refused(
        row(("fluxes of fluid", "m/s"), &["injection.flux", "wells.flux"], [1e-12, 1e-2], "\"1e-7 m/s\""),
        RefusalBound::Waves,
    ),
    refused(
        row(("velocities of bodies", "m/s"), &["velocity"], [0.0, 500.0], "\"1 m/s\""),
        RefusalBound::From(1e5),
    ),
    row(("speeds of forced ruptures", "m/s"), &["forced_rupture.speed"], [100.0, 1e4], "\"2 km/s\""),
    row(("velocities", "m/s"), &[], [0.0, 100.0], "\"1 um/s\""),
    row(("densities of rock or metal", "kg/m3"), &[], [100.0, 30_000.0], "\"2700 kg/m^3\""),
    row(("dampings", "Pa s/m"), &[], [1e4, 1e8], "\"4.6 MPa s/m\""),
    row(("masses per area", "kg/m2"), &[], [1.0, 1e13], "\"5000 kg/m^2\""),
    row(("viscosities of fluids", "Pa s"), &["diffusion.viscosity"], [1e-6, 1.0], "\"1e-3 Pa s\""),
    row(("viscosities", "Pa s"), &[], [1e3, 1e27], "\"1e19 Pa s\""),
    row(("gradients of stress", "Pa/m"), &["gradient"], [1e2, 1e8], "\"16 MPa/km\""),
    row(("stiffnesses per area", "Pa/m"), &[], [1e2, 1e20], "\"10 GPa/m\""),
    row(("lengths of slip over which friction changes", "m"), &["l", "d_c"], [1e-8, 10.0], "\"10 um\""),
    row(("sizes of cells", "m"), &["size", "spacing"], [1e-7, 1e7], "\"1 mm\""),
    row(("thicknesses of zones that slip", "m"), &["heat.thickness"], [1e-6, 1.0], "\"10 mm\""),
    row(("lengths of faults along strike", "m"), &["place.length"], [100.0, 3e6], "\"50 km\""),
    row(("lengths and positions", "m"), &["points"], [0.0, EARTH], "\"10 km\""),
    row(("lengths and positions", "m"), &[], [0.0, EARTH], "\"10 km\""),
    row(("times", "s"), &[], [0.0, 1e17], "\"100 yr\""),
    row(("angles", "rad"), &[], [0.0, TURN], "\"30 deg\""),
    row(("temperatures of rock at the start", "K"), &["temperature"], [200.0, 1500.0], "\"500 K\""),
    row(("temperatures", "K"), &[], [200.0, 4000.0], "\"1000 K\""),
    row(("hydraulic diffusivities", "m2/s"), &["pressurisation.diffusivity"], [1e-10, 1e-1], "\"1 mm^2/s\""),
    row(("thermal diffusivities", "m2/s"), &[], [1e-8, 1e-4], "\"1 mm^2/s\""),
    row(("heat capacities", "J/(m3 K)"), &[], [1e5, 1e8], "\"2.7 MJ/(m^3 K)\""),
    row(("permeabilities", "m2"), &["permeability"], [1e-25, 1e-7], "\"1e-15 m^2\""),
    row(("permeabilities", "m2"), &[], [1e-25, 1e-7], "\"1e-15 m^2\""),
    row(("pressures per temperature", "Pa/K"), &[], [1e3, 1e7], "\"0.5 MPa/K\""),
    row(("amounts of memory", "bytes"), &[], [1e3, 1e15], "\"4 GB\""),
    row(("friction coefficients", ""), &["mu", "mu0", "mu_s", "mu_k", "mu_w"], [0.0, MOST_FRICTION], "0.6"),
    row(("effective friction coefficients", ""), &["coulomb.friction"], [0.0, 1.0], "0.4"),
    row(("direct and evolution effects", ""), &["a", "b"], [0.0, 0.5], "0.01"),
    row(("activation energies in J/mol", ""), &["activation"], [1e3, 1e6], "90e3"),
    row(("temperatures in K", ""), &["t_ref", "law.temperature"], [200.0, 4000.0], "500"),
    row(("accelerations of gravity in m/s2", ""), &["gravity"], [1e-3, 100.0], "9.81"),
    row(("ratios of stresses", ""), &["k0"], [0.0, 5.0], "0.7"),
    row(("diffusivities of fluid in m2/s", ""), &["injection.diffusivity"], [1e-9, 100.0], "0.1"),
    row(("storages in 1/Pa", ""), &["storage"], [1e-14, 1e-6], "1e-9"),
    row(("compressibilities in 1/Pa", ""), &["compressibility"], [1e-12, 1e-6], "1e-8"),
    row(("growths of cells from row to row", ""), &["growth", "ratio"], [0.0, 3.0], "1.25"),
    row(("viscosities in steps", ""), &["time.viscosity"], [0.0, 1.0], "0.1"),
    row(("errors of ln V in a step", ""), &["log_rate_tolerance", "time.tolerance"], [0.0, 1e-3], "1e-5"),
    row(("errors of friction in a step", ""), &["friction_tolerance"], [0.0, 1e-3], "2e-6"),
    row(("shares of a weakening length", ""), &["zeta"], [0.0, 0.5], "0.1"),
];

/// Length of the path that `pattern` leaves at its end, in keys; `None` if it does not match. Its last key must be there.
fn left(pattern: &str, path: &[&str]) -> Option<usize> {
    let mut keys = pattern.split('.').rev();
    let last = keys.next()?;
    let end = path.iter().rposition(|key| *key == last)?;
    let mut before = path[..end].iter().rev();
    keys.all(|key| before.any(|step| *step == key)).then_some(path.len() - 1 - end)
}

/// The quantity of a value: by its path without names, and by its unit where the schema gives one.
pub(super) fn quantity(path: &[&str], unit: Option<&str>) -> Option<&'static Quantity> {
    let of_unit = |q: &&Quantity| unit.is_none_or(|unit| q.unit == unit);
    let best = |q: &'static Quantity| {
        let fits = q.keys.iter().filter_map(|key| Some((left(key, path)?, key)));
        // Numbers without a unit of their own have the quantity of their key, and of no key above.
        let fits = fits.filter(|(left, _)| unit.is_some_and(|u| !u.is_empty()) || *left == 0);
        fits.map(|(left, key)| (left, usize::MAX - key.len())).min()
    };
    let rows = QUANTITIES.iter().filter(of_unit);
    let found = rows.filter_map(|q| Some((best(q)?, q))).min_by_key(|(rank, _)| *rank).map(|(_, q)| q);
    let rest = || {
        let unit = unit.filter(|u| !u.is_empty())?;
        QUANTITIES.iter().find(|q| q.unit == unit && q.keys.is_empty())
    };
    found.or_else(rest)
}

/// True if the table has a row for all other keys of a unit.
#[must_use]
pub fn covers(dimension: Dimension) -> bool {
    QUANTITIES.iter().any(|q| q.unit == dimension.si() && q.keys.is_empty())
}
