//! Faults as declared in a scene, for simulations of earthquake cycles.

use super::{
    Diffusion, FaultLine, FaultRectangle, FaultTriangles, Fields, Flux, ForcedRupture, Heat, LawSpec, Patch,
    Pulse,
};
use crate::code_value::here;
use crate::key_default::usual;
use crate::kind::{self, Kind};
use crate::kinematics;
use crate::shape::{Either, shaped};
use crate::spanned::Spanned;
use crate::units::{Angle, Damping, Length, Pressure, Time, Velocity};
use schemars::JsonSchema;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserializer, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Serialize};
use std::fmt;
use std::ops::Range;

/// A fault: two coincident sides that slide past each other. Their displacement jump is the unknown.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Fault {
    /// Minus side, such as `BODY.fault.minus`.
    #[schemars(extend("x-kinds" = kind::BETWEEN_BODIES, "x-instead" = "a fault in a medium is a `line` in the plane, a `rectangle` or `triangles` in space"))]
    #[serde(default = "absent")]
    pub minus: Spanned<String>,
    /// Plus side, such as `BODY.fault.plus`; slip is that of plus relative to minus.
    #[schemars(extend("x-kinds" = kind::BETWEEN_BODIES, "x-instead" = "a fault in a medium is a `line` in the plane, a `rectangle` or `triangles` in space"))]
    #[serde(default = "absent")]
    pub plus: Spanned<String>,
    /// The line of the fault.
    #[schemars(extend("x-kinematics" = kinematics::PLANE, "x-otherwise" = "in space a fault is a `rectangle` or `triangles`", "x-kinds" = [Kind::Medium], "x-instead" = "add `[medium]` and remove the bodies, or name the sides `minus` and `plus`"))]
    pub line: Option<FaultLine>,
    /// The rectangle of the fault.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane a fault is a `line`", "x-kinds" = [Kind::Medium], "x-instead" = "add `[medium]` and remove the bodies, or name the sides `minus` and `plus`"))]
    pub rectangle: Option<FaultRectangle>,
    /// A file with the triangles of the fault.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane a fault is a `line`", "x-kinds" = [Kind::Medium], "x-instead" = "add `[medium]` and remove the bodies, or name the sides `minus` and `plus`"))]
    pub triangles: Option<FaultTriangles>,
    /// A [friction law](laws.md) of kind `"rate-and-state"` or `"rate"`; with `"explicit"` also one of slip.
    pub law: Spanned<LawSpec>,
    /// Values of `a`, `b`, `l`, `normal`, `shear` or `cohesion` along the fault.
    #[schemars(extend("x-at-interfaces" = "`fields` take parameters of the law from files; parts with laws of their own are two sets, with an interface of each"))]
    #[serde(default)]
    pub profiles: Profiles,
    /// Values of parameters, tractions, slip rates or states at positions in files.
    #[serde(default)]
    pub fields: Fields,
    /// Parts of the fault with parameters of their own, in the order in which they apply, after `profiles`.
    #[serde(default)]
    pub patches: Vec<Patch>,
    /// Shear tractions that grow on parts of the fault, to start an event.
    #[schemars(extend("x-kinds" = kind::WITHOUT_RUPTURES))]
    #[serde(default)]
    pub pulses: Vec<Pulse>,
    /// Slip weakening: friction falls at a time that a front reaches each point, to start a rupture.
    #[schemars(extend("x-kinds" = [Kind::Explicit], "x-instead" = "start events by `pulses` or a patch of `shear`"))]
    pub forced_rupture: Option<ForcedRupture>,
    /// Initial normal traction, compression positive; absent: given by the initial stress of the bodies \[Pa\].
    #[schemars(extend("x-at-interfaces" = "loads press an interface, or the `initial_stress` of its bodies with `initial_stress = true` in the interface, which brings normal and shear tractions"))]
    pub normal: Option<Spanned<Pressure>>,
    /// Initial slip rate of all points; its sign is the direction of slip. Absent with laws of slip, whose faults start at rest \[m/s\].
    #[schemars(extend("x-at-interfaces" = "the state at the start is steady at `v_initial` of the law"))]
    #[serde(default = "at_rest")]
    pub rate: Spanned<Velocity>,
    /// Initial shear traction, of the sign of `rate`; absent: that of the law's initial steady state \[Pa\].
    #[schemars(extend("x-at-interfaces" = "loads press an interface, or the `initial_stress` of its bodies with `initial_stress = true` in the interface, which brings normal and shear tractions"))]
    pub shear: Option<Spanned<Pressure>>,
    /// Radiation damping η, or `"radiation"`; absent: none \[Pa s/m\].
    #[schemars(extend("x-kinds" = kind::FAULT_CYCLES, "x-instead" = "bodies with mass radiate the waves themselves"))]
    pub damping: Option<Spanned<DampingSpec>>,
    /// Part of the fault that slips at an imposed rate.
    pub creep: Option<Creep>,
    /// Direction of slip `[x, y, z]`, of any length; only its component along the fault counts.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane there is one direction of slip"))]
    #[serde(default, deserialize_with = "crate::exact_list::optional")]
    pub rake: Option<Spanned<[f64; 3]>>,
    /// With `[place]`, instead of `rake`: azimuth of the motion of the plus side past the minus side \[rad\].
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane there is one direction of slip"))]
    pub azimuth: Option<Spanned<Angle>>,
    /// `"along-rake"`, or `"free"` for slip whose direction may turn.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane there is one direction of slip", "x-default" = usual(SlipSpec::default()).only("in space")))]
    pub slip: Option<Spanned<SlipSpec>>,
    /// Fluid injected at one position that diffuses along the fault, or a list of such wells.
    #[schemars(extend("x-kinematics" = kinematics::PLANE, "x-otherwise" = "its pressure is that of diffusion along one line", "x-kinds" = kind::CYCLES, "x-instead" = "between bodies with mass, pressure acts through `normal`"))]
    pub injection: Option<Injections>,
    /// Fluid from wells that diffuses along the fault, whose permeability and storage may vary.
    #[schemars(extend("x-kinematics" = kinematics::PLANE, "x-otherwise" = "its pressure is that of flow along one line", "x-kinds" = kind::CYCLES, "x-instead" = "between bodies with mass, pressure acts through `normal`"))]
    pub diffusion: Option<Diffusion>,
    /// Heat of friction, which may change friction and the pressure of pore fluid.
    #[schemars(extend("x-kinds" = kind::CYCLES, "x-instead" = "frictional heat is followed through cycles without mass only"))]
    pub heat: Option<Heat>,
    /// Treatment of less than one point per cohesive zone: `"refuse"` or `"allow"`.
    #[schemars(extend("x-default" = usual(UnderResolution::default())))]
    pub under_resolved: Option<Spanned<UnderResolution>>,
    /// `false`: slip and loads do not change normal tractions.
    #[schemars(extend("x-kinds" = kind::CYCLES, "x-default" = usual(true), "x-instead" = "normal tractions follow from the momentum of both sides"))]
    pub normal_changes: Option<Spanned<bool>>,
    /// Smallest normal traction used by friction \[Pa\].
    #[schemars(extend("x-kinds" = kind::CYCLES, "x-instead" = "between bodies with mass there is no friction where nothing presses"))]
    pub normal_floor: Option<Spanned<Pressure>>,
    /// `true`: the sides separate where there is no compression; needs `normal_floor`, but with mass none.
    #[schemars(extend("x-kinematics" = kinematics::ALONG_XY, "x-otherwise" = "in antiplane motion bodies move out of the plane only", "x-kinds" = [Kind::Cycles, Kind::Explicit], "x-default" = usual(false)))]
    pub opening: Option<Spanned<bool>>,
    /// Friction follows changes of the normal traction with a delay, `{ length = "1 mm", rate = "1 m/s" }`.
    #[schemars(extend("x-kinds" = [Kind::Explicit]))]
    pub normal_delay: Option<Spanned<NormalDelay>>,
}

/// Delay with which friction follows the normal traction: over slip, and over time where slip is slow.
#[derive(Clone, Copy, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NormalDelay {
    /// Slip over which it follows \[m\].
    pub length: Length,
    /// Slip rate at which a point at rest would follow over this length \[m/s\].
    pub rate: Velocity,
}

/// The name of a side that is not given.
fn absent() -> Spanned<String> {
    here(String::new())
}

/// The slip rate of a fault at rest.
fn at_rest() -> Spanned<Velocity> {
    here(Velocity(0.0))
}

impl Fault {
    /// True if an initial slip rate is given, whose sign the shear tractions then have.
    #[must_use]
    pub fn slides(&self) -> bool {
        self.rate.get_ref().0 != 0.0
    }

    /// Position of its geometry in the file: its sides, its line, its rectangle or its triangles.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        let line = self.line.as_ref().map(|line| line.trace.span());
        let rectangle = self.rectangle.as_ref().map(|rectangle| rectangle.from.span());
        let triangles = self.triangles.as_ref().map(|triangles| triangles.file().span());
        match line.or(rectangle).or(triangles) {
            Some(span) if !self.has_sides() => span,
            _ if self.minus.get_ref().is_empty() => self.law.span(),
            _ => self.minus.span(),
        }
    }

    /// Fluxes of its wells.
    pub fn fluxes(&self) -> impl Iterator<Item = &Flux> {
        let injected = self.injection.iter().flat_map(|wells| &wells.0).map(|well| &well.flux);
        let diffusing = self.diffusion.iter().flat_map(|d| d.wells.get_ref()).map(|well| &well.flux);
        injected.chain(diffusing).map(Spanned::get_ref)
    }

    /// Fluxes of its wells, which files may fill.
    pub(crate) fn fluxes_mut(&mut self) -> impl Iterator<Item = &mut Flux> {
        let injected = self.injection.iter_mut().flat_map(|wells| &mut wells.0).map(|well| &mut well.flux);
        let diffusing = self.diffusion.iter_mut().flat_map(|d| d.wells.get_mut());
        injected.chain(diffusing.map(|well| &mut well.flux)).map(Spanned::get_mut)
    }

    /// True if a profile or a file gives its initial normal traction along it.
    #[must_use]
    pub fn has_normal_along(&self) -> bool {
        self.profiles.normal.is_some() || self.fields.normal.is_some()
    }

    /// True if a profile or a file gives its initial shear traction along it.
    #[must_use]
    pub fn has_shear_along(&self) -> bool {
        self.profiles.shear.is_some() || self.fields.shear.is_some()
    }

    /// True if sides of bodies are named.
    #[must_use]
    pub fn has_sides(&self) -> bool {
        !(self.minus.get_ref().is_empty() && self.plus.get_ref().is_empty())
    }
}

/// Treatment of a fault whose points are farther apart than the length of the cohesive zone.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "UnderResolved")]
pub enum UnderResolution {
    /// The scene is refused.
    #[default]
    Refuse,
    /// The scene runs with a warning.
    Allow,
}

/// Directions in which a fault in space slips.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SlipSpec {
    /// Along `rake`; slip across it is held at zero.
    #[default]
    AlongRake,
    /// Along the shear traction, whatever its direction in the fault; along `rake` at the start.
    Free,
}

/// Parameters that vary along a fault. Their values in the law or in the fault are then not used.
#[derive(Clone, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profiles {
    /// Direct effect a \[-\].
    pub a: Option<ParameterProfiles>,
    /// Evolution effect b \[-\]; laws with one state variable.
    pub b: Option<ParameterProfiles>,
    /// Characteristic slip L \[m\]; laws with one state variable.
    pub l: Option<ParameterProfiles>,
    /// Initial normal traction \[Pa\].
    pub normal: Option<ParameterProfiles>,
    /// Initial shear traction \[Pa\].
    pub shear: Option<ParameterProfiles>,
    /// Laws of slip: shear traction that a closed point carries at no normal traction \[Pa\].
    #[schemars(extend("x-kinds" = [Kind::Explicit]))]
    pub cohesion: Option<ParameterProfiles>,
}

impl Profiles {
    /// Profiles with the names of their parameters.
    #[must_use]
    pub fn all(&self) -> [(&'static str, Option<&ParameterProfiles>); 6] {
        [
            ("a", &self.a),
            ("b", &self.b),
            ("l", &self.l),
            ("normal", &self.normal),
            ("shear", &self.shear),
            ("cohesion", &self.cohesion),
        ]
        .map(|(key, profile)| (key, profile.as_ref()))
    }
}

/// A parameter as one profile, or as the maximum of several.
#[derive(Clone, Debug)]
pub struct ParameterProfiles(pub Vec<Profile>);

shaped!(ParameterProfiles as Either<Profile, Vec<Profile>>);

impl<'de> Deserialize<'de> for ParameterProfiles {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct ProfiledVisitor;
        impl<'de> Visitor<'de> for ProfiledVisitor {
            type Value = ParameterProfiles;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("{ along = .., points = .. }, or a list of such profiles of which the largest value holds")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ParameterProfiles, A::Error> {
                Profile::deserialize(MapAccessDeserializer::new(map)).map(|p| ParameterProfiles(vec![p]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<ParameterProfiles, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(ParameterProfiles)
            }
        }
        deserializer.deserialize_any(ProfiledVisitor)
    }
}

/// A profile of a parameter along a fault.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Coordinate on which the parameter depends.
    pub along: Spanned<Along>,
    /// Pairs of position \[m\] and value in SI units, with ascending positions; linear in between, constant beyond.
    #[serde(deserialize_with = "crate::exact_list::pairs")]
    pub points: Spanned<Vec<(Length, f64)>>,
}

/// A coordinate of the points of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Along {
    /// The coordinate x.
    X,
    /// The coordinate y.
    Y,
    /// The coordinate z.
    Z,
    /// Distance along a plane fault from its upper end.
    Distance,
}

/// The part of a fault that slips at an imposed rate.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Creep {
    /// Distance along a plane fault from its upper end beyond which the slip rate is imposed \[m\].
    #[schemars(extend("x-kinematics" = kinematics::PLANE, "x-otherwise" = "there is no distance along a fault in space; `outside = { y = { from = \"-40 km\" } }` has coordinates", "x-kinds" = kind::BETWEEN_BODIES, "x-instead" = "let the fault end where the creep begins"))]
    pub beyond: Option<Spanned<Length>>,
    /// Ranges of coordinates outside which the slip rate is imposed.
    #[schemars(extend("x-kinds" = kind::BETWEEN_BODIES, "x-instead" = "let the fault end where the creep begins"))]
    pub outside: Option<Spanned<Outside>>,
    /// Slip rate \[m/s\].
    pub rate: Spanned<Velocity>,
    /// Load of the creep: `"slip"` of its part of the fault, or `"backslip"` of all the rest.
    #[schemars(extend("x-default" = usual("slip").only("between bodies").but("backslip", "in a medium")))]
    pub loading: Option<Spanned<CreepLoading>>,
    /// Direction of the slip rate if the direction of slip may turn, of any length; absent: that of the fault.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "in the plane there is one direction of slip"))]
    #[serde(default, deserialize_with = "crate::exact_list::optional")]
    pub rake: Option<Spanned<[f64; 3]>>,
}

impl Creep {
    /// True if a border separates what creeps from what slides.
    #[must_use]
    pub fn has_border(&self) -> bool {
        self.beyond.is_some() || self.outside.is_some()
    }

    /// True if backslip is asked for.
    #[must_use]
    pub fn is_backslip(&self) -> bool {
        self.loading.as_ref().is_some_and(|l| *l.get_ref() == CreepLoading::Backslip)
    }
}

/// Load of creep on the part of a fault that slides by its law.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CreepLoading {
    /// The part that creeps slips, and drags the rest along.
    Slip,
    /// The rest is loaded by its lag behind the rate of creep, as if it slipped backwards.
    Backslip,
}

/// Ranges of coordinates; a position is within if it is within all of them.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Outside {
    /// Range of x.
    pub x: Option<Extent>,
    /// Range of y.
    pub y: Option<Extent>,
    /// Range of z.
    #[schemars(extend("x-kinematics" = kinematics::SPACE, "x-otherwise" = "there is no coordinate z in the plane"))]
    pub z: Option<Extent>,
}

impl Outside {
    /// Ranges by axis.
    #[must_use]
    pub fn ranges(&self) -> [Option<Extent>; 3] {
        [self.x, self.y, self.z]
    }
}

/// An open range of a coordinate; an absent end leaves it unbounded.
#[derive(Clone, Copy, Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Extent {
    /// Lower end \[m\].
    pub from: Option<Length>,
    /// Upper end \[m\].
    pub to: Option<Length>,
}

/// Position of a station.
#[derive(Clone, Debug, PartialEq)]
pub enum Station {
    /// Distance along a plane fault from its upper end \[m\].
    Along(f64),
    /// Coordinates \[m\].
    At(Vec<f64>),
}

shaped!(Station as Either<Length, Vec<Length>>);

impl<'de> Deserialize<'de> for Station {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct StationVisitor;
        impl<'de> Visitor<'de> for StationVisitor {
            type Value = Station;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "a distance such as \"5 km\", or coordinates such as [\"0 km\", \"-10 km\", \"24 km\"]",
                )
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<Station, E> {
                Ok(Station::Along(value))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<Station, E> {
                Ok(Station::Along(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<Station, E> {
                Length::deserialize(de::value::StrDeserializer::new(text)).map(|l| Station::Along(l.0))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Station, A::Error> {
                let at: Vec<Length> = Deserialize::deserialize(SeqAccessDeserializer::new(list))?;
                Ok(Station::At(at.iter().map(|x| x.0).collect()))
            }
        }
        deserializer.deserialize_any(StationVisitor)
    }
}

/// Wells of a fault: one, or a list.
#[derive(Clone, Debug)]
pub struct Injections(pub Vec<Injection>);

shaped!(Injections as Either<Injection, Vec<Injection>>);

impl Injections {
    /// Position of the first well in the file.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        self.0.first().map(|well| well.at.span()).unwrap_or_default()
    }
}

impl<'de> Deserialize<'de> for Injections {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WellsVisitor;
        impl<'de> Visitor<'de> for WellsVisitor {
            type Value = Injections;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("{ at = .., flux = .., .. }, or a list of such wells")
            }

            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Injections, A::Error> {
                Injection::deserialize(MapAccessDeserializer::new(map)).map(|well| Injections(vec![well]))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Injections, A::Error> {
                Deserialize::deserialize(SeqAccessDeserializer::new(list)).map(Injections)
            }
        }
        deserializer.deserialize_any(WellsVisitor)
    }
}

/// Fluid injected at one position of a fault.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Injection {
    /// Distance along the fault \[m\].
    pub at: Spanned<Length>,
    /// Volume per cross-sectional area and time, in both directions together; negative: extraction; or `{ steps = .. }` \[m/s\].
    pub flux: Spanned<Flux>,
    /// Hydraulic diffusivity \[m²/s\].
    pub diffusivity: Spanned<f64>,
    /// Porosity \[-\].
    pub porosity: Spanned<f64>,
    /// Compressibility of fluid and pores \[1/Pa\].
    pub compressibility: Spanned<f64>,
    /// End of an injection at a constant flux; absent: no end \[s\].
    pub until: Option<Spanned<Time>>,
}

/// Radiation damping: a number, or derived from the material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DampingSpec {
    /// η \[Pa s/m\].
    Value(f64),
    /// η = √(G ρ)/2, half the impedance of shear waves.
    Radiation,
}

shaped!(DampingSpec as Damping);

impl<'de> Deserialize<'de> for DampingSpec {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct DampingVisitor;
        impl Visitor<'_> for DampingVisitor {
            type Value = DampingSpec;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"radiation\", or a damping such as \"5 MPa s/m\" or a number in Pa s/m")
            }

            fn visit_f64<E: de::Error>(self, value: f64) -> Result<DampingSpec, E> {
                Ok(DampingSpec::Value(value))
            }

            fn visit_i64<E: de::Error>(self, value: i64) -> Result<DampingSpec, E> {
                Ok(DampingSpec::Value(value as f64))
            }

            fn visit_str<E: de::Error>(self, text: &str) -> Result<DampingSpec, E> {
                if text == "radiation" {
                    return Ok(DampingSpec::Radiation);
                }
                Damping::deserialize(de::value::StrDeserializer::new(text)).map(|d| DampingSpec::Value(d.0))
            }
        }
        deserializer.deserialize_any(DampingVisitor)
    }
}
