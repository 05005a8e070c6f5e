//! Units in which a quantity reads well.

/// A unit: its name and its size in SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    pub name: &'static str,
    pub factor: f64,
}

/// Units of one quantity, ascending, each with the SI value from which it is used.
#[derive(Clone, Copy, Debug)]
pub(super) struct Units(&'static [(Unit, f64)]);

impl Units {
    /// The unit for values up to `largest` (SI). Zero and what is not finite take the unit of value 1, if there is one.
    pub(super) fn of(self, largest: f64) -> Unit {
        let largest = if largest.is_finite() && largest > 0.0 { largest } else { 1.0 };
        let fitting = self.0.iter().rev().find(|(_, from)| *from <= largest);
        fitting.unwrap_or(&self.0[0]).0
    }
}

const fn unit(name: &'static str, factor: f64) -> (Unit, f64) {
    (Unit { name, factor }, factor)
}

/// A unit used only from `from` on.
const fn later(name: &'static str, factor: f64, from: f64) -> (Unit, f64) {
    (Unit { name, factor }, from)
}

/// SI prefixes.
const NANO: f64 = 1e-9;
/// SI prefixes.
const MICRO: f64 = 1e-6;
/// SI prefixes.
const MILLI: f64 = 1e-3;

/// Lengths.
pub(super) const LENGTH: Units =
    Units(&[unit("nm", NANO), unit("µm", MICRO), unit("mm", MILLI), unit("m", 1.0), later("km", 1e3, 1e4)]);

/// Velocities.
pub(super) const VELOCITY: Units =
    Units(&[unit("nm/s", NANO), unit("µm/s", MICRO), unit("mm/s", MILLI), unit("m/s", 1.0)]);

/// Stresses and tractions.
pub(super) const STRESS: Units = Units(&[unit("Pa", 1.0), unit("kPa", 1e3), unit("MPa", 1e6), later("GPa", 1e9, 1e10)]);

/// Times: seconds up to some hours, then days, then years of 365.25 days.
pub(super) const TIME: Units = Units(&[
    unit("µs", MICRO),
    unit("ms", MILLI),
    unit("s", 1.0),
    later("h", 3600.0, 36_000.0),
    later("d", 86_400.0, 864_000.0),
    later("a", 31_557_600.0, 63_115_200.0),
]);

/// Numbers without a unit.
pub(super) const NUMBER: Units = Units(&[(Unit { name: "–", factor: 1.0 }, 0.0)]);
