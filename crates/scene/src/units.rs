//! Physical values of a scene: a number in SI, or a string with a unit.
//!
//! Decimal prefixes shift the exponent of the number before it is read, so `"25 mm"` is the same value as `0.025`.

use crate::shape::shaped;
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::borrow::Cow;
use std::f64::consts::TAU;
use std::fmt;

/// Physical dimension of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dimension {
    /// \[m\].
    Length,
    /// \[s\].
    Time,
    /// \[Pa\].
    Pressure,
    /// \[m/s\].
    Velocity,
    /// \[kg/m³\].
    Density,
    /// \[Pa/m\], penalty of a contact.
    Stiffness,
    /// \[Pa/m\], stiffness of a spring per area.
    Spring,
    /// \[Pa/m\], gradient of a stress along an axis.
    Gradient,
    /// \[Pa s/m\].
    Damping,
    /// \[kg/m2\].
    Mass,
    /// \[Pa s\].
    Viscosity,
    /// \[bytes\].
    Memory,
    /// \[rad\].
    Angle,
    /// Absolute temperature \[K\].
    Temperature,
    /// \[m²/s\].
    Diffusivity,
    /// Heat capacity per volume \[J/(m³ K)\].
    HeatCapacity,
    /// Pressure per temperature \[Pa/K\].
    PerKelvin,
    /// \[m²\].
    Permeability,
}

impl Dimension {
    /// All dimensions.
    #[cfg(test)]
    pub(crate) const ALL: [Self; 18] = [
        Self::Length,
        Self::Time,
        Self::Pressure,
        Self::Velocity,
        Self::Density,
        Self::Stiffness,
        Self::Spring,
        Self::Gradient,
        Self::Damping,
        Self::Mass,
        Self::Viscosity,
        Self::Memory,
        Self::Angle,
        Self::Temperature,
        Self::Diffusivity,
        Self::HeatCapacity,
        Self::PerKelvin,
        Self::Permeability,
    ];

    /// Name with its article.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Time => "a time",
            Self::Pressure => "a pressure",
            Self::Velocity => "a velocity",
            Self::Density => "a density",
            Self::Stiffness => "a contact stiffness",
            Self::Spring => "a stiffness",
            Self::Gradient => "a gradient of stress",
            Self::Damping => "a damping",
            Self::Mass => "a mass per area",
            Self::Viscosity => "a viscosity",
            Self::Memory => "an amount of memory",
            Self::Angle => "an angle",
            Self::Temperature => "a temperature",
            Self::Diffusivity => "a diffusivity",
            Self::HeatCapacity => "a heat capacity per volume",
            Self::PerKelvin => "a pressure per temperature",
            Self::Permeability => "a permeability",
        }
    }

    fn expected(self) -> &'static str {
        match self {
            Self::Length => "a length such as \"25 mm\" or a number in m",
            Self::Time => "a time such as \"9.66 s\" or \"20 yr\" or a number in s",
            Self::Pressure => "a pressure such as \"25 MPa\" or a number in Pa",
            Self::Velocity => "a velocity such as \"1e-3 mm/s\" or a number in m/s",
            Self::Density => "a density such as \"2700 kg/m^3\" or a number in kg/m^3",
            Self::Stiffness => "a penalty such as \"100 E/h\" or \"1e12 Pa/m\" or a number in Pa/m",
            Self::Spring => "a stiffness such as \"1.25 GPa/m\" or a number in Pa/m",
            Self::Gradient => "a gradient of stress such as \"26 MPa/km\" or a number in Pa/m",
            Self::Damping => "a damping such as \"5 MPa s/m\" or a number in Pa s/m",
            Self::Mass => "a mass per area such as \"3000 kg/m^2\" or a number in kg/m^2",
            Self::Viscosity => "a viscosity such as \"1e19 Pa s\" or a number in Pa s",
            Self::Angle => "an angle such as \"30 deg\" or a number in rad",
            Self::Temperature => "an absolute temperature such as \"500 K\" or a number in K",
            Self::Diffusivity => "a diffusivity such as \"1 mm^2/s\" or a number in m^2/s",
            Self::HeatCapacity => {
                "a heat capacity per volume such as \"2.7 MJ/(m^3 K)\" or a number in J/(m^3 K)"
            }
            Self::PerKelvin => "a pressure per temperature such as \"0.5 MPa/K\" or a number in Pa/K",
            Self::Permeability => "a permeability such as \"1e-15 m^2\" or a number in m^2",
            Self::Memory => "an amount of memory such as \"8 GiB\" or a number of bytes",
        }
    }

    /// SI unit.
    #[must_use]
    pub fn si(self) -> &'static str {
        match self {
            Self::Length => "m",
            Self::Time => "s",
            Self::Pressure => "Pa",
            Self::Velocity => "m/s",
            Self::Density => "kg/m3",
            Self::Stiffness | Self::Spring | Self::Gradient => "Pa/m",
            Self::Damping => "Pa s/m",
            Self::Mass => "kg/m2",
            Self::Viscosity => "Pa s",
            Self::Angle => "rad",
            Self::Temperature => "K",
            Self::Diffusivity => "m2/s",
            Self::HeatCapacity => "J/(m3 K)",
            Self::PerKelvin => "Pa/K",
            Self::Permeability => "m2",
            Self::Memory => "bytes",
        }
    }

    fn units(self) -> &'static str {
        match self {
            Self::Length => "nm, um, mm, cm, m, km",
            Self::Time => "us, ms, s, min, h, d, yr",
            Self::Pressure => "Pa, kPa, MPa, GPa",
            Self::Velocity => "m/s, mm/s, um/s, mm/yr and other lengths per time",
            Self::Density => "kg/m^3, g/cm^3",
            Self::Stiffness => "E/h, Pa/m, MPa/mm and other pressures per length",
            Self::Spring | Self::Gradient => "Pa/m, MPa/mm and other pressures per length",
            Self::Damping => "Pa s/m, MPa s/m and other pressures times s/m",
            Self::Mass => "kg/m^2",
            Self::Viscosity => "Pa s, GPa yr and other pressures times times",
            Self::Angle => "rad, deg",
            Self::Temperature => "K",
            Self::Diffusivity => "m^2/s, mm^2/s, cm^2/s",
            Self::HeatCapacity => "J/(m^3 K), kJ/(m^3 K), MJ/(m^3 K)",
            Self::PerKelvin => "Pa/K, kPa/K, MPa/K",
            Self::Permeability => "m^2, D, mD, uD",
            Self::Memory => "B, kB, MB, GB, KiB, MiB, GiB",
        }
    }
}

/// A unit whose SI value is `factor * 10^power`.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Unit {
    dimension: Dimension,
    power: i32,
    factor: f64,
}

/// One degree \[rad\].
const DEGREE: f64 = std::f64::consts::PI / 180.0;
const KIBIBYTE: f64 = 1024.0;
const MINUTE: f64 = 60.0;
const HOUR: f64 = 3600.0;
const DAY: f64 = 86400.0;
/// One darcy: 1 cm/s of a fluid of 1 cP under 1 atm/cm \[m²\].
const DARCY: f64 = 1e-7 / 101_325.0;
/// The Julian year of 365.25 days \[s\].
const YEAR: f64 = 365.25 * DAY;

fn simple(name: &str) -> Option<Unit> {
    use Dimension::{Angle, Length, Memory, Pressure, Temperature, Time};
    let (dimension, power, factor) = match name {
        "nm" => (Length, -9, 1.0),
        "um" | "µm" | "μm" => (Length, -6, 1.0),
        "mm" => (Length, -3, 1.0),
        "cm" => (Length, -2, 1.0),
        "m" => (Length, 0, 1.0),
        "km" => (Length, 3, 1.0),
        "us" | "µs" | "μs" => (Time, -6, 1.0),
        "ms" => (Time, -3, 1.0),
        "s" => (Time, 0, 1.0),
        "min" => (Time, 0, MINUTE),
        "h" => (Time, 0, HOUR),
        "d" => (Time, 0, DAY),
        "yr" => (Time, 0, YEAR),
        "Pa" => (Pressure, 0, 1.0),
        "kPa" => (Pressure, 3, 1.0),
        "MPa" => (Pressure, 6, 1.0),
        "GPa" => (Pressure, 9, 1.0),
        "rad" => (Angle, 0, 1.0),
        "deg" => (Angle, 0, DEGREE),
        "K" => (Temperature, 0, 1.0),
        "B" => (Memory, 0, 1.0),
        "kB" => (Memory, 3, 1.0),
        "MB" => (Memory, 6, 1.0),
        "GB" => (Memory, 9, 1.0),
        "KiB" => (Memory, 0, KIBIBYTE),
        "MiB" => (Memory, 0, KIBIBYTE * KIBIBYTE),
        "GiB" => (Memory, 0, KIBIBYTE * KIBIBYTE * KIBIBYTE),
        _ => return None,
    };
    Some(Unit { dimension, power, factor })
}

fn unit(name: &str) -> Option<Unit> {
    match name {
        "kg/m^3" | "kg/m³" | "kg/m3" => {
            return Some(Unit { dimension: Dimension::Density, power: 0, factor: 1.0 });
        }
        "g/cm^3" | "g/cm³" | "g/cm3" => {
            return Some(Unit { dimension: Dimension::Density, power: 3, factor: 1.0 });
        }
        "kg/m^2" | "kg/m²" | "kg/m2" => {
            return Some(Unit { dimension: Dimension::Mass, power: 0, factor: 1.0 });
        }
        _ => {}
    }
    if let Some(power) = permeability(name) {
        let factor = if name.ends_with('D') { DARCY } else { 1.0 };
        return Some(Unit { dimension: Dimension::Permeability, power, factor });
    }
    if let Some((dimension, power)) = thermal(name) {
        return Some(Unit { dimension, power, factor: 1.0 });
    }
    if let Some(pressure) = name.strip_suffix("s/m").and_then(|p| simple(p.trim()))
        && pressure.dimension == Dimension::Pressure
    {
        return Some(Unit { dimension: Dimension::Damping, ..pressure });
    }
    if let Some((pressure, time)) = name.split_once(' ')
        && let (Some(pressure), Some(time)) = (simple(pressure), simple(time.trim()))
        && (pressure.dimension, time.dimension) == (Dimension::Pressure, Dimension::Time)
    {
        return Some(Unit {
            dimension: Dimension::Viscosity,
            power: pressure.power + time.power,
            factor: pressure.factor * time.factor,
        });
    }
    let Some((over, under)) = name.split_once('/') else { return simple(name) };
    let (over, under) = (simple(over.trim())?, simple(under.trim())?);
    let dimension = match (over.dimension, under.dimension) {
        (Dimension::Length, Dimension::Time) => Dimension::Velocity,
        (Dimension::Pressure, Dimension::Length) => Dimension::Stiffness,
        _ => return None,
    };
    Some(Unit { dimension, power: over.power - under.power, factor: over.factor / under.factor })
}

/// Decimal power of the units of permeability.
fn permeability(name: &str) -> Option<i32> {
    match name {
        "m^2" | "m²" | "m2" | "D" => Some(0),
        "mD" => Some(-3),
        "uD" | "µD" | "μD" => Some(-6),
        _ => None,
    }
}

/// Dimension and decimal power of the units of heat and diffusion.
fn thermal(name: &str) -> Option<(Dimension, i32)> {
    Some(match name {
        "m^2/s" | "m²/s" | "m2/s" => (Dimension::Diffusivity, 0),
        "cm^2/s" | "cm²/s" | "cm2/s" => (Dimension::Diffusivity, -4),
        "mm^2/s" | "mm²/s" | "mm2/s" => (Dimension::Diffusivity, -6),
        "J/(m^3 K)" | "J/(m³ K)" | "J/(m3 K)" => (Dimension::HeatCapacity, 0),
        "kJ/(m^3 K)" | "kJ/(m³ K)" | "kJ/(m3 K)" => (Dimension::HeatCapacity, 3),
        "MJ/(m^3 K)" | "MJ/(m³ K)" | "MJ/(m3 K)" => (Dimension::HeatCapacity, 6),
        "Pa/K" => (Dimension::PerKelvin, 0),
        "kPa/K" => (Dimension::PerKelvin, 3),
        "MPa/K" => (Dimension::PerKelvin, 6),
        _ => return None,
    })
}

/// Splits a text such as `"1e-3 mm/s"` into number and unit.
fn split(text: &str) -> (&str, &str) {
    let text = text.trim();
    let bytes = text.as_bytes();
    let mut end = 0;
    while end < bytes.len() {
        let c = bytes[end];
        let exponent = (c == b'e' || c == b'E')
            && bytes.get(end + 1).is_some_and(|&n| n.is_ascii_digit() || n == b'-' || n == b'+');
        let sign = (c == b'-' || c == b'+') && (end == 0 || matches!(bytes[end - 1], b'e' | b'E'));
        if !(c.is_ascii_digit() || matches!(c, b'.' | b'_') || exponent || sign) {
            break;
        }
        end += 1;
    }
    (&text[..end], text[end..].trim())
}

/// The number with its decimal exponent moved by `power`, correctly rounded.
fn shifted(number: &str, power: i32) -> Option<f64> {
    let digits = number.replace('_', "");
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((&digits, "0"));
    let exponent: i32 = exponent.parse().ok()?;
    format!("{mantissa}e{}", exponent.checked_add(power)?).parse().ok()
}

/// SI value of a number with any unit; `None` for any other text.
pub(crate) fn si_value(text: &str) -> Option<f64> {
    let (number, name) = split(text);
    let unit = unit(name)?;
    shifted(number, unit.power).map(|v| v * unit.factor).filter(|v| v.is_finite())
}

/// Text that is no value of the expected dimension.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("expected {expected}, found \"{found}\" ({reason})")]
pub struct UnitError {
    /// Expected value, with an example.
    pub expected: String,
    /// The text.
    pub found: String,
    /// Reason why it is none.
    pub reason: String,
}

/// Parses a text with a unit into its SI value.
///
/// # Errors
/// Text without a value of the expected dimension.
pub fn parse(text: &str, wanted: Dimension) -> Result<f64, UnitError> {
    let (number, name) = split(text);
    let refuse = |why: &str| {
        let expected = wanted.expected().to_string();
        Err(UnitError { expected, found: text.to_owned(), reason: why.to_owned() })
    };
    if number.is_empty() {
        return refuse("no number");
    }
    if name.is_empty() {
        return refuse("no unit; a number without a unit is written without quotes");
    }
    if name.starts_with(',') {
        return refuse("the decimal sign is a point");
    }
    let Some(unit) = unit(name) else {
        return refuse(&format!("there is no unit `{name}`; units here are {}", wanted.units()));
    };
    // A pressure per length may be a contact penalty, a stiffness of springs or a gradient along an axis.
    let per_length = matches!(wanted, Dimension::Spring | Dimension::Gradient);
    let same = unit.dimension == wanted || (unit.dimension == Dimension::Stiffness && per_length);
    if !same {
        return match (wanted, unit.dimension) {
            (Dimension::Spring | Dimension::Stiffness, Dimension::Pressure) => refuse(
                "a pressure. A stiffness is a modulus over the length that it strains, such as \"30 GPa/km\"",
            ),
            (_, found) => refuse(found.name()),
        };
    }
    match shifted(number, unit.power).map(|v| v * unit.factor) {
        Some(value) if value.is_finite() => Ok(value),
        Some(_) => refuse("not finite"),
        None => refuse(&format!("`{number}` is not a number")),
    }
}

/// Reads a finite number in SI units or a text with a unit.
struct ValueVisitor(Dimension);

impl Visitor<'_> for ValueVisitor {
    type Value = f64;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.expected())
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<f64, E> {
        within_a_turn(finite(value, self.0)?, self.0)
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<f64, E> {
        within_a_turn(value as f64, self.0)
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<f64, E> {
        within_a_turn(value as f64, self.0)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<f64, E> {
        parse(text, self.0).map_err(E::custom)
    }
}

/// Checks that a number without a unit is no angle beyond a full turn, which is one in degrees.
fn within_a_turn<E: de::Error>(value: f64, dimension: Dimension) -> Result<f64, E> {
    if dimension == Dimension::Angle && value.abs() > TAU {
        return Err(E::custom(format!(
            "expected {}, found {value} (more than a full turn in rad; in degrees it is \"{value} deg\")",
            dimension.expected()
        )));
    }
    Ok(value)
}

/// Checks that a number is finite.
pub(super) fn finite<E: de::Error>(value: f64, dimension: Dimension) -> Result<f64, E> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(E::custom(format!("expected {}, found {value} (not finite)", dimension.expected())))
    }
}

/// Schema of a value with a unit: a number in SI units, or a text such as "25 mm".
fn value(dimension: Dimension) -> Schema {
    schemars::json_schema!({
        "description": format!("Expected: {}.", dimension.expected()),
        "type": ["number", "string"],
        "x-unit": dimension.si(),
    })
}

macro_rules! quantity {
    ($($(#[$doc:meta])* $name:ident: $dimension:ident,)*) => {$(
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub struct $name(pub f64);

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(ValueVisitor(Dimension::$dimension)).map(Self)
            }
        }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }

            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                value(Dimension::$dimension)
            }
        }
    )*};
}

quantity! {
    /// A length \[m\].
    Length: Length,
    /// A time \[s\].
    Time: Time,
    /// A pressure, stress or modulus \[Pa\].
    Pressure: Pressure,
    /// A velocity \[m/s\].
    Velocity: Velocity,
    /// A mass density \[kg/m³\].
    Density: Density,
    /// A stiffness per area \[Pa/m\].
    Spring: Spring,
    /// Gradient of a stress \[Pa/m\].
    Gradient: Gradient,
    /// Radiation damping \[Pa s/m\].
    Damping: Damping,
    /// A mass per area \[kg/m2\].
    Mass: Mass,
    /// A viscosity \[Pa s\].
    Viscosity: Viscosity,
    /// An amount of memory \[bytes\].
    Memory: Memory,
    /// An angle \[rad\].
    Angle: Angle,
    /// An absolute temperature \[K\].
    Temperature: Temperature,
    /// A diffusivity \[m²/s\].
    Diffusivity: Diffusivity,
    /// A heat capacity per volume \[J/(m³ K)\].
    HeatCapacity: HeatCapacity,
    /// A pressure per temperature \[Pa/K\].
    PerKelvin: PerKelvin,
    /// A permeability \[m²\].
    Permeability: Permeability,
}

/// A contact penalty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Penalty {
    /// Absolute value \[Pa/m\].
    Value(f64),
    /// This factor times Young's modulus of the slave body over its element size.
    YoungPerSize(f64),
}

impl JsonSchema for Penalty {
    fn schema_name() -> Cow<'static, str> {
        "Penalty".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        value(Dimension::Stiffness)
    }
}

impl<'de> Deserialize<'de> for Penalty {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PenaltyVisitor;
        impl Visitor<'_> for PenaltyVisitor {
            type Value = Penalty;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(Dimension::Stiffness.expected())
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Penalty, E> {
                finite(value, Dimension::Stiffness).map(Penalty::Value)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Penalty, E> {
                Ok(Penalty::Value(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Penalty, E> {
                let (number, name) = split(text);
                let young = name.split_once('/').is_some_and(|(e, h)| e.trim() == "E" && h.trim() == "h");
                match shifted(number, 0) {
                    Some(factor) if young && factor.is_finite() => Ok(Penalty::YoungPerSize(factor)),
                    _ => parse(text, Dimension::Stiffness).map(Penalty::Value).map_err(E::custom),
                }
            }
        }
        deserializer.deserialize_any(PenaltyVisitor)
    }
}

/// An admissible penetration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Penetration {
    /// Absolute value \[m\].
    Value(f64),
    /// This factor times the element size of the slave body.
    Sizes(f64),
}

shaped!(Penetration as Length);

impl<'de> Deserialize<'de> for Penetration {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct PenetrationVisitor;
        impl Visitor<'_> for PenetrationVisitor {
            type Value = Penetration;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a length such as \"1 nm\" or \"1e-6 h\" (element sizes) or a number in m")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Penetration, E> {
                finite(value, Dimension::Length).map(Penetration::Value)
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Penetration, E> {
                Ok(Penetration::Value(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Penetration, E> {
                let (number, name) = split(text);
                match shifted(number, 0) {
                    Some(factor) if name.trim() == "h" && factor.is_finite() => {
                        Ok(Penetration::Sizes(factor))
                    }
                    _ => parse(text, Dimension::Length).map(Penetration::Value).map_err(E::custom),
                }
            }
        }
        deserializer.deserialize_any(PenetrationVisitor)
    }
}
