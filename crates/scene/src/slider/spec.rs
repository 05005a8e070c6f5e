//! A scene of spring-sliders as a value: the contents of its file in SI units, before any decision is made.

use super::course::Course;
use crate::defaults;
use crate::key_default::usual;
use crate::model::{EventSpec, LawSpec, Spanned, TableOver};
use crate::shape::{Either, shaped};
use crate::units::{Damping, Dimension, Mass, Pressure, Spring, Time, Velocity};
use asperity_run::Warning;
use schemars::JsonSchema;
use serde::Deserialize;
use serde::de::{self, Deserializer, SeqAccess, Visitor};
use std::collections::BTreeMap;
use std::fmt;

/// A scene of spring-sliders.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SliderScene {
    /// Version of the scene format; 1.
    pub schema: Spanned<u32>,
    /// Title shown in reports: one line of printable characters.
    #[serde(deserialize_with = "crate::title::read")]
    pub title: String,
    /// "spring-slider".
    pub kinematics: Spanned<String>,
    /// Load point.
    pub load: Option<Load>,
    /// Sliders by name, in alphabetical order.
    #[serde(default)]
    pub sliders: BTreeMap<String, Spanned<SliderSpec>>,
    /// Springs between sliders.
    #[serde(default)]
    pub springs: Vec<Spanned<SpringSpec>>,
    /// Time integration.
    pub time: SliderTime,
    /// Events.
    pub events: Option<EventSpec>,
    /// Rows of the histories.
    pub output: Option<OutputSpec>,
    /// Doubts about it.
    #[serde(skip)]
    pub warnings: Vec<Warning>,
}

impl SliderScene {
    /// Tables of its courses that files have, with the dimension of their values.
    pub(crate) fn tables_mut(&mut self) -> impl Iterator<Item = TableOver<'_>> {
        let over = |keys: &'static [&'static str], dimension| {
            move |table| TableOver { table, dimension, keys, duration: None, holds: false }
        };
        let load = self.load.iter_mut().filter_map(|load| load.rate.get_mut().in_file_mut());
        let load = load.map(over(&["load", "rate"], Dimension::Velocity));
        let sliders = self.sliders.values_mut().flat_map(move |slider| {
            let SliderSpec { normal, rate, .. } = slider.get_mut();
            let normal = normal.get_mut().in_file_mut();
            let rate = rate.as_mut().and_then(|rate| rate.get_mut().in_file_mut());
            let normal = normal.map(over(&["sliders", "normal"], Dimension::Pressure));
            normal.into_iter().chain(rate.map(over(&["sliders", "rate"], Dimension::Velocity)))
        });
        load.chain(sliders)
    }

    /// Names of the files of the scene.
    pub fn files(&self) -> impl Iterator<Item = &Spanned<String>> {
        let load = self.load.iter().filter_map(|load| load.rate.get_ref().in_file());
        let sliders = self.sliders.values().flat_map(|slider| {
            let SliderSpec { normal, rate, .. } = slider.get_ref();
            let rate = rate.as_ref().and_then(|rate| rate.get_ref().in_file());
            normal.get_ref().in_file().into_iter().chain(rate)
        });
        load.chain(sliders).filter_map(|table| Some(&table.file()?.file))
    }
}

/// The load point.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Rate of the load point \[m/s\].
    pub rate: Spanned<Course<Velocity>>,
}

/// A slider.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SliderSpec {
    /// Friction law.
    pub law: Spanned<LawSpec>,
    /// Normal traction f_n \[Pa\].
    pub normal: Spanned<Course<Pressure>>,
    /// Stiffness k of the spring to the load point \[Pa/m\].
    pub stiffness: Option<Spanned<Spring>>,
    /// Radiation damping η \[Pa s/m\].
    pub damping: Option<Spanned<Damping>>,
    /// Mass per area M \[kg/m2\].
    pub mass: Option<Spanned<Mass>>,
    /// Slip rate at time 0; absent: that of the law's initial steady state \[m/s\].
    pub start: Option<Spanned<Velocity>>,
    /// Imposed slip rate at all times \[m/s\].
    pub rate: Option<Spanned<Course<Velocity>>>,
}

/// A spring between two sliders.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringSpec {
    /// Names of the two sliders.
    pub between: Spanned<Vec<Spanned<String>>>,
    /// Stiffness \[Pa/m\].
    pub stiffness: Spanned<Spring>,
}

/// Time integration.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SliderTime {
    /// End of the run \[s\].
    pub end: Spanned<Time>,
    /// Method: `"switching"`, `"dop853"`, `"radau5"`, `"tsit5"`, `"bdf"`, `"tr-bdf2"`, `"esdirk34"` or `"tsit45"`.
    #[schemars(extend("x-default" = usual(defaults::SLIDER_METHOD)))]
    pub method: Option<Spanned<String>>,
    /// Admissible error of ln V per step, and of the states to the same effect, 1e-14 to 0.1 \[-\].
    #[schemars(extend("x-default" = usual(defaults::SLIDER_TOLERANCE)))]
    pub tolerance: Option<Spanned<f64>>,
    /// First step; absent: chosen from the rates \[s\].
    pub first_step: Option<Spanned<Time>>,
    /// Largest step; absent: unlimited \[s\].
    pub max_step: Option<Spanned<Time>>,
    /// Largest number of steps, after which the run is given up.
    #[schemars(extend("x-default" = usual(defaults::SLIDER_STEPS)))]
    pub most_steps: Option<Spanned<usize>>,
}

/// Rows of the histories.
#[derive(Clone, Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OutputSpec {
    /// Change of ln V after which a row is written, or of friction by a twentieth of it \[-\].
    #[schemars(extend("x-default" = usual(defaults::SLIDER_CHANGE).only("without `times` and `interval`")))]
    pub change: Option<Spanned<f64>>,
    /// Times of rows, ascending; where something jumps, one before and one after \[s\].
    pub times: Option<Spanned<Vec<Spanned<Time>>>>,
    /// Interval between rows, from time 0 \[s\].
    pub interval: Option<Spanned<Time>>,
    /// Histories: `false` for none, or a list of sliders.
    #[schemars(extend("x-default" = usual(true)))]
    pub histories: Option<SliderSelection>,
    /// `true`: the extremes of the slip rate are located and written even without `[events]`.
    #[schemars(extend("x-default" = usual(false)))]
    pub extremes: Option<Spanned<bool>>,
}

/// All sliders, none, or those named.
#[derive(Clone, Debug)]
pub enum SliderSelection {
    /// All or none.
    All(bool),
    /// Those named.
    Named(Vec<Spanned<String>>),
}

shaped!(SliderSelection as Either<bool, Vec<String>>);

impl<'de> Deserialize<'de> for SliderSelection {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct WhichVisitor;
        impl<'de> Visitor<'de> for WhichVisitor {
            type Value = SliderSelection;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("true, false, or a list of names such as [\"left\", \"right\"]")
            }

            fn visit_bool<E: de::Error>(self, all: bool) -> Result<SliderSelection, E> {
                Ok(SliderSelection::All(all))
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<SliderSelection, A::Error> {
                let mut names = Vec::new();
                while let Some(name) = seq.next_element()? {
                    names.push(name);
                }
                Ok(SliderSelection::Named(names))
            }
        }
        deserializer.deserialize_any(WhichVisitor)
    }
}
