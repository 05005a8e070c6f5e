//! Events of the sliders: when each began and ended, which way and how far it slipped, how fast, and what it released.

use asperity_ode::Clock;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A slider at the onset or at the end of an event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Edge {
    /// Slip since time 0 \[m\].
    pub slip: f64,
    /// Traction of the springs \[Pa\].
    pub traction: f64,
    /// Friction coefficient \[-\].
    pub friction: f64,
    /// State variables, as the law evolves them.
    pub states: Vec<f64>,
}

/// An event: |V| above the upper threshold in one direction, until it falls through the lower one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Event {
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

/// Events in the order of their onsets.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Catalogue {
    /// Events so far.
    pub events: Vec<Event>,
    /// Of each slider: what goes on.
    tracks: Vec<Track>,
}

/// State of a slider in the catalogue.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Track {
    /// Clock of its last onset.
    onset: Option<Clock>,
    /// Its event in progress.
    open: Option<usize>,
    /// Its smallest |V| since its last event; none where none was seen.
    least: Option<f64>,
    /// Its slip rate seen last \[m/s\].
    last: f64,
    /// Its events that are over.
    over: usize,
}

impl Catalogue {
    /// For this many sliders.
    #[must_use]
    pub fn new(sliders: usize) -> Self {
        Self { events: Vec::new(), tracks: vec![Track::default(); sliders] }
    }

    /// |V| of a slider rose through the upper threshold. A slider that is in an event in this direction already goes on with it.
    pub(super) fn begins(&mut self, slider: usize, at: Clock, rate: f64, edge: Edge) {
        let direction = if rate < 0.0 { -1 } else { 1 };
        if let Some(open) = self.tracks[slider].open {
            if self.events[open].direction == direction {
                return;
            }
            self.ends(slider, at, edge.clone());
        }
        self.sees(slider, rate);
        let track = &mut self.tracks[slider];
        let interval = track.onset.map(|last| at.since(&last));
        (track.onset, track.open) = (Some(at), Some(self.events.len()));
        self.events.push(Event {
            slider,
            direction,
            onset: at.seconds(),
            interval,
            duration: None,
            slip: None,
            peak_rate: rate.abs(),
            least_rate: track.least.take().unwrap_or(rate.abs()),
            stress_drop: None,
            at_onset: edge,
            at_end: None,
        });
    }

    /// |V| of a slider fell through the lower threshold.
    pub(super) fn ends(&mut self, slider: usize, at: Clock, edge: Edge) {
        let track = &mut self.tracks[slider];
        let (Some(open), Some(onset)) = (track.open.take(), track.onset) else { return };
        track.over += 1;
        let event = &mut self.events[open];
        event.duration = Some(at.since(&onset));
        event.slip = Some(edge.slip - event.at_onset.slip);
        event.stress_drop = Some(f64::from(event.direction) * (event.at_onset.traction - edge.traction));
        event.at_end = Some(edge);
    }

    /// A slip rate was seen.
    pub(super) fn sees(&mut self, slider: usize, rate: f64) {
        let track = &mut self.tracks[slider];
        let turned = track.last != 0.0 && rate != 0.0 && (track.last < 0.0) != (rate < 0.0);
        track.last = rate;
        match track.open {
            Some(event) => {
                let event = &mut self.events[event];
                if rate * f64::from(event.direction) > event.peak_rate {
                    event.peak_rate = rate.abs();
                }
            }
            None => {
                let least = if turned { 0.0 } else { rate.abs() };
                track.least = Some(track.least.map_or(least, |l| l.min(least)));
            }
        }
    }

    /// Events of one slider.
    pub fn of(&self, slider: usize) -> impl Iterator<Item = &Event> {
        self.events.iter().filter(move |e| e.slider == slider)
    }

    /// Number of events of one slider that are over.
    pub(super) fn over(&self, slider: usize) -> usize {
        self.tracks.get(slider).map_or(0, |t| t.over)
    }
}
