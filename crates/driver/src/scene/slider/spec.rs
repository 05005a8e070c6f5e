//! A scene of spring-sliders as a value: what its file says, in SI units, before any decision is taken.

use super::course::Course;
use crate::scene::model::{LawSpec, Spanned};
use crate::scene::units::{Damping, Mass, Pressure, Spring, Time, Velocity};
use serde::Deserialize;
use std::collections::BTreeMap;

/// A scene of spring-sliders.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliderScene {
    /// Version of the scene format; 1.
    pub schema: Spanned<u32>,
    /// Title, shown in reports: one line of characters that can be seen.
    #[serde(deserialize_with = "crate::scene::title::read")]
    pub title: String,
    /// "spring-slider".
    pub kinematics: Spanned<String>,
    /// Load point.
    pub load: Option<Load>,
    /// Sliders by name, in the order of the names.
    #[serde(default)]
    pub sliders: BTreeMap<String, Spanned<SliderSpec>>,
    /// Springs between sliders.
    #[serde(default)]
    pub springs: Vec<Spanned<SpringSpec>>,
    /// Time integration.
    pub time: SliderTime,
    /// Events.
    pub events: Option<EventSpec>,
}

/// The load point.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Load {
    /// Its rate \[m/s\].
    pub rate: Spanned<Course<Velocity>>,
}

/// A slider.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliderSpec {
    /// Friction.
    pub law: Spanned<LawSpec>,
    /// Normal traction f_n \[Pa\].
    pub normal: Spanned<Course<Pressure>>,
    /// Stiffness k to the load point \[Pa/m\].
    pub stiffness: Option<Spanned<Spring>>,
    /// Radiation damping η \[Pa s/m\].
    pub damping: Option<Spanned<Damping>>,
    /// Mass per area M \[kg/m²\].
    pub mass: Option<Spanned<Mass>>,
    /// Slip rate at time 0 \[m/s\]; without it that of the law's initial steady state.
    pub start: Option<Spanned<Velocity>>,
}

/// A spring between two sliders.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpringSpec {
    /// Names of the two sliders.
    pub between: Spanned<Vec<Spanned<String>>>,
    /// Stiffness \[Pa/m\].
    pub stiffness: Spanned<Spring>,
}

/// Time integration.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SliderTime {
    /// End \[s\].
    pub end: Spanned<Time>,
    /// Method.
    pub method: Option<Spanned<String>>,
    /// Error allowed in ln V and in what is worth as much of each state, per step \[-\].
    pub tolerance: Option<Spanned<f64>>,
    /// First step \[s\].
    pub first_step: Option<Spanned<Time>>,
    /// Largest step \[s\].
    pub max_step: Option<Spanned<Time>>,
    /// Steps after which to give up.
    pub most_steps: Option<Spanned<usize>>,
}

/// Events.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct EventSpec {
    /// Slip rate above which an event begins \[m/s\].
    pub above: Spanned<Velocity>,
    /// Slip rate below which it ends \[m/s\]; a tenth of `above` where absent.
    pub below: Option<Spanned<Velocity>>,
    /// Events of the first slider after which the run ends.
    pub stop_after: Option<Spanned<usize>>,
    /// Whether the extremes of the slip rate are found, not only seen at steps (default true).
    pub peaks: Option<bool>,
}
