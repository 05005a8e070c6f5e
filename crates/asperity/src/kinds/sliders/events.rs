//! Events of sliders, in the report and as CSV.

use crate::catalogue::{head_cells, head_columns};
use asperity_cycles::slider::{Edge, Slide, SliderRun};
use asperity_output::decimals::shortest_scientific;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_run::{Event, EventHead};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// An event. It begins when |V| exceeds the upper threshold in one direction, and ends when |V| falls below the lower
/// one.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Entry {
    /// Number of the slider.
    #[serde(skip)]
    pub slider: usize,
    /// Direction of slip: 1 for positive slip rates, -1 for negative ones.
    pub direction: i8,
    /// Time at which |V| rose through the upper threshold \[s\].
    pub onset: f64,
    /// Time since the previous onset in either direction, with digits that large times lose \[s\].
    pub interval: Option<f64>,
    /// Time from onset to end; unknown if the run ended first \[s\].
    pub duration: Option<f64>,
    /// End: onset plus duration; unknown if the run ended first \[s\].
    pub end: Option<f64>,
    /// Slip from onset to end; negative for negative slip rates \[m\].
    pub slip: Option<f64>,
    /// Largest |V| at the steps, or exact if extremes are located \[m/s\].
    pub peak_rate: f64,
    /// Smallest |V| since the previous event; zero if the slider reversed \[m/s\].
    pub least_rate: f64,
    /// Traction at the onset minus that at the end, in the direction of slip \[Pa\].
    pub stress_drop: Option<f64>,
    /// State of the slider at the onset.
    pub at_onset: Edge,
    /// State of the slider at the end.
    pub at_end: Option<Edge>,
}

/// An event with the name of its slider.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "Named")]
pub struct NamedEvent {
    /// Slider.
    pub surface: String,
    /// Event.
    #[serde(flatten)]
    pub entry: Entry,
}

impl NamedEvent {
    /// Events of all sliders in order of onset.
    #[must_use]
    pub fn all(run: &SliderRun, names: &[String]) -> Vec<Self> {
        let named = |entry: Entry| Self { surface: names[entry.slider].clone(), entry };
        Entry::all(run).into_iter().map(named).collect()
    }
}

impl Entry {
    /// Events of all sliders in order of onset.
    #[must_use]
    pub fn all(run: &SliderRun) -> Vec<Self> {
        run.catalogue.in_order().into_iter().map(|(slider, event)| Self::new(slider, event)).collect()
    }

    /// Events of one slider.
    #[must_use]
    pub fn from_slider(run: &SliderRun, slider: usize) -> Vec<Self> {
        run.catalogue.events(slider).iter().map(|event| Self::new(slider, event)).collect()
    }

    /// Head of the event, which catalogues of other kinds have, too.
    fn head<'a>(&self, surface: &'a str) -> EventHead<'a> {
        let Self { onset, duration, end, interval, peak_rate, stress_drop, .. } = *self;
        EventHead { onset, duration, end, interval, peak_rate, stress_drop, surface }
    }

    fn new(slider: usize, event: &Event<Slide>) -> Self {
        let details = &event.details;
        Self {
            slider,
            direction: details.direction,
            onset: event.onset.seconds(),
            interval: event.interval,
            duration: event.duration(),
            end: event.end_time(),
            slip: details.slip(),
            peak_rate: event.peak,
            least_rate: details.least_rate,
            stress_drop: details.stress_drop(),
            at_onset: details.at_onset.clone(),
            at_end: details.at_end.clone(),
        }
    }
}

/// Columns of the events of sliders.
#[must_use]
pub fn columns(events: &[NamedEvent]) -> Vec<Column> {
    let states = events.iter().map(|e| e.entry.at_onset.states.len()).max().unwrap_or(0);
    let mut all: Vec<Column> = head_columns().collect();
    all.extend([
        Column::new("direction", "", Sign::Slip, "sign of the slip"),
        Column::new("slip", "m", Sign::Slip, "slip in the event"),
        Column::new("least_rate", "m/s", Sign::Size, "least slip rate in the event"),
    ]);
    for edge in ["onset", "end"] {
        all.push(Column::new(format!("traction_{edge}"), "Pa", Sign::Slip, "shear traction then"));
        all.push(Column::new(format!("friction_{edge}"), "-", Sign::Slip, "shear over normal traction then"));
        let state = |i| Column::new(format!("state_{i}_{edge}"), "", Sign::None, "state variable then");
        all.extend((1..=states).map(state));
    }
    all
}

/// Events as CSV; unknown values are empty.
#[must_use]
pub fn csv(events: &[NamedEvent]) -> String {
    let states = events.iter().map(|e| e.entry.at_onset.states.len()).max().unwrap_or(0);
    let mut text = column::header(&columns(events));
    let known = |value: Option<f64>| value.map(shortest_scientific).unwrap_or_default();
    for NamedEvent { surface, entry: e } in events {
        let _ = write!(
            text,
            "{},{},{},{:e}",
            head_cells(&e.head(surface), shortest_scientific),
            e.direction,
            known(e.slip),
            e.least_rate
        );
        for edge in [Some(&e.at_onset), e.at_end.as_ref()] {
            let _ = write!(text, ",{},{}", known(edge.map(|e| e.traction)), known(edge.map(|e| e.friction)));
            for i in 0..states {
                let _ = write!(text, ",{}", known(edge.and_then(|e| e.states.get(i).copied())));
            }
        }
        text.push('\n');
    }
    text
}
