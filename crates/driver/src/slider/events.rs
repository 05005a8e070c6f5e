//! Events of sliders in the report and as a table.

use asperity_cycles::Event;
use asperity_cycles::slider::{Edge, Slide, SliderRun};
use asperity_output::decimals::shortest_scientific;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// An event: |V| above the upper threshold in one direction, until it falls through the lower one.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Entry {
    /// Number of the slider.
    pub slider: usize,
    /// 1 along positive slip rates, -1 against them.
    pub direction: i8,
    /// Time at which |V| rose through the upper threshold \[s\].
    pub onset: f64,
    /// Time since the onset before, in either direction, which keeps digits that times far from zero have lost \[s\].
    pub interval: Option<f64>,
    /// From onset to end; none where the run ended first \[s\].
    pub duration: Option<f64>,
    /// Slip from onset to end, negative against the positive direction \[m\].
    pub slip: Option<f64>,
    /// Largest |V| at the steps (and exactly, where extremes are found) \[m/s\].
    pub peak_rate: f64,
    /// Smallest |V| since the event before, zero where the slider turned round \[m/s\].
    pub least_rate: f64,
    /// Traction at the onset less that at the end, in the direction of slip \[Pa\].
    pub stress_drop: Option<f64>,
    /// The slider at the onset.
    pub at_onset: Edge,
    /// The slider at the end.
    pub at_end: Option<Edge>,
}

impl Entry {
    /// Events of all sliders in the order of their onsets.
    #[must_use]
    pub fn all(run: &SliderRun) -> Vec<Self> {
        run.catalogue.in_order().into_iter().map(|(slider, event)| Self::new(slider, event)).collect()
    }

    /// Events of one slider.
    #[must_use]
    pub fn of(run: &SliderRun, slider: usize) -> Vec<Self> {
        run.catalogue.of(slider).iter().map(|event| Self::new(slider, event)).collect()
    }

    fn new(slider: usize, event: &Event<Slide>) -> Self {
        let details = &event.details;
        Self {
            slider,
            direction: details.direction,
            onset: event.onset.seconds(),
            interval: event.interval,
            duration: event.duration(),
            slip: details.slip(),
            peak_rate: event.peak,
            least_rate: details.least_rate,
            stress_drop: details.stress_drop(),
            at_onset: details.at_onset.clone(),
            at_end: details.at_end.clone(),
        }
    }
}

/// Events as CSV, with the names of the sliders; what is not known is empty.
#[must_use]
pub fn csv(events: &[Entry], names: &[String]) -> String {
    let states = events.iter().map(|e| e.at_onset.states.len()).max().unwrap_or(0);
    let mut text = String::from(
        "slider,direction,onset [s],interval [s],duration [s],slip [m],peak_rate [m/s],least_rate [m/s],stress_drop [Pa]",
    );
    for edge in ["onset", "end"] {
        let _ = write!(text, ",traction_{edge} [Pa],friction_{edge} [-]");
        (1..=states).for_each(|i| text.push_str(&format!(",state_{i}_{edge}")));
    }
    text.push('\n');
    let known = |value: Option<f64>| value.map(shortest_scientific).unwrap_or_default();
    for e in events {
        let _ = write!(
            text,
            "{},{},{:.14e},{},{},{},{:e},{:e},{}",
            quoted(&names[e.slider]),
            e.direction,
            e.onset,
            known(e.interval),
            known(e.duration),
            known(e.slip),
            e.peak_rate,
            e.least_rate,
            known(e.stress_drop)
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

/// A name as a field of CSV.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_string()
    }
}
