//! Units that make values easy to read.

/// A unit: its name and its value in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Unit {
    pub name: &'static str,
    pub factor: f64,
}

/// Units of one quantity, ascending, each with the SI value above which it is used.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Units(&'static [(Unit, f64)]);

impl Units {
    /// Unit for values up to `largest` (SI). For zero and non-finite values it is the unit for 1.
    pub(crate) fn choose(self, largest: f64) -> Unit {
        let largest = if largest.is_finite() && largest > 0.0 { largest } else { 1.0 };
        let fitting = self.0.iter().rev().find(|(_, from)| *from <= largest);
        fitting.unwrap_or(&self.0[0]).0
    }
}

/// A unit used from half of itself, so that values just below 1 do not read as 999 of the next smaller unit.
const fn unit(name: &'static str, factor: f64) -> (Unit, f64) {
    (Unit { name, factor }, 0.5 * factor)
}

/// A unit used only from `from`.
const fn later(name: &'static str, factor: f64, from: f64) -> (Unit, f64) {
    (Unit { name, factor }, from)
}

/// SI prefix nano.
const NANO: f64 = 1e-9;
/// SI prefix micro.
const MICRO: f64 = 1e-6;
/// SI prefix milli.
const MILLI: f64 = 1e-3;

/// Lengths.
pub(crate) const LENGTH: Units =
    Units(&[unit("nm", NANO), unit("µm", MICRO), unit("mm", MILLI), unit("m", 1.0), later("km", 1e3, 1e4)]);

/// Velocities.
pub(crate) const VELOCITY: Units =
    Units(&[unit("nm/s", NANO), unit("µm/s", MICRO), unit("mm/s", MILLI), unit("m/s", 1.0)]);

/// Stresses and tractions.
pub(crate) const STRESS: Units =
    Units(&[unit("Pa", 1.0), unit("kPa", 1e3), unit("MPa", 1e6), later("GPa", 1e9, 1e10)]);

/// Times: up to seconds, then hours, days, and years of 365.25 days.
pub(crate) const TIME: Units = Units(&[
    unit("µs", MICRO),
    unit("ms", MILLI),
    unit("s", 1.0),
    later("h", 3600.0, 36_000.0),
    later("d", 86_400.0, 864_000.0),
    later("yr", 31_557_600.0, 63_115_200.0),
]);

/// Energies.
pub(crate) const ENERGY: Units = Units(&[
    unit("nJ", NANO),
    unit("µJ", MICRO),
    unit("mJ", MILLI),
    unit("J", 1.0),
    unit("kJ", 1e3),
    unit("MJ", 1e6),
    unit("GJ", 1e9),
    unit("TJ", 1e12),
    unit("PJ", 1e15),
    unit("EJ", 1e18),
]);

/// Energies per area.
pub(crate) const ENERGY_PER_AREA: Units = Units(&[
    unit("nJ/m²", NANO),
    unit("µJ/m²", MICRO),
    unit("mJ/m²", MILLI),
    unit("J/m²", 1.0),
    unit("kJ/m²", 1e3),
    unit("MJ/m²", 1e6),
    unit("GJ/m²", 1e9),
]);

/// Energies per length out of the plane.
pub(crate) const ENERGY_PER_LENGTH: Units = Units(&[
    unit("nJ/m", NANO),
    unit("µJ/m", MICRO),
    unit("mJ/m", MILLI),
    unit("J/m", 1.0),
    unit("kJ/m", 1e3),
    unit("MJ/m", 1e6),
    unit("GJ/m", 1e9),
    unit("TJ/m", 1e12),
]);

/// Moment rates.
pub(crate) const MOMENT_RATE: Units = Units(&[
    unit("N m/s", 1.0),
    unit("10³ N m/s", 1e3),
    unit("10⁶ N m/s", 1e6),
    unit("10⁹ N m/s", 1e9),
    unit("10¹² N m/s", 1e12),
    unit("10¹⁵ N m/s", 1e15),
    unit("10¹⁸ N m/s", 1e18),
    unit("10²¹ N m/s", 1e21),
]);

/// Moment rates per length out of the plane.
pub(crate) const MOMENT_RATE_PER_LENGTH: Units = Units(&[
    unit("N/s", 1.0),
    unit("10³ N/s", 1e3),
    unit("10⁶ N/s", 1e6),
    unit("10⁹ N/s", 1e9),
    unit("10¹² N/s", 1e12),
    unit("10¹⁵ N/s", 1e15),
]);

/// Seconds alone, of which logarithms are taken.
pub(crate) const SECONDS: Units = Units(&[(Unit { name: "s", factor: 1.0 }, 0.0)]);

/// Dimensionless numbers.
pub(crate) const NUMBER: Units = Units(&[(Unit { name: "–", factor: 1.0 }, 0.0)]);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_keep_numbers_readable() {
        assert_eq!(LENGTH.choose(5e-5).name, "µm");
        assert_eq!(LENGTH.choose(0.07).name, "mm");
        assert_eq!(VELOCITY.choose(0.999e-6).name, "µm/s");
        assert_eq!(STRESS.choose(2.3e7).name, "MPa");
        assert_eq!(TIME.choose(59.66).name, "s");
        assert_eq!(TIME.choose(6.4e7).name, "yr");
    }

    #[test]
    fn what_has_no_size_still_has_a_unit() {
        for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(LENGTH.choose(value).name, "m");
            assert_eq!(NUMBER.choose(value).factor, 1.0);
        }
        assert_eq!(LENGTH.choose(1e-30).name, "nm");
    }
}
