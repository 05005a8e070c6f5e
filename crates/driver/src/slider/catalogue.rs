//! Events of the sliders: when each began and ended, how far it slipped and how fast.

use crate::ode::Clock;
use serde::Serialize;

/// An event: V above the upper threshold, until it falls below the lower one.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Event {
    /// Number of the slider.
    pub slider: usize,
    /// When V rose through the upper threshold \[s\].
    pub onset: f64,
    /// Time since the onset before, which keeps digits that times far from zero have lost \[s\].
    pub interval: Option<f64>,
    /// From onset to end; none where the run ended first \[s\].
    pub duration: Option<f64>,
    /// Slip from onset to end \[m\].
    pub slip: Option<f64>,
    /// Largest slip rate at the steps (and exactly, where extremes are found) \[m/s\].
    pub peak_rate: f64,
    /// Smallest slip rate since the event before \[m/s\].
    pub least_rate: f64,
}

/// Events in the order of their onsets.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Catalogue {
    /// Events so far.
    pub events: Vec<Event>,
    /// Of each slider: the clock of its last onset.
    onsets: Vec<Option<Clock>>,
    /// Of each slider: its event in progress with the slip at its onset.
    open: Vec<Option<(usize, f64)>>,
    /// Of each slider: its smallest slip rate since its last event.
    least: Vec<f64>,
}

impl Catalogue {
    /// For this many sliders.
    #[must_use]
    pub fn new(sliders: usize) -> Self {
        Self {
            events: Vec::new(),
            onsets: vec![None; sliders],
            open: vec![None; sliders],
            least: vec![f64::INFINITY; sliders],
        }
    }

    /// V of a slider rose through the upper threshold. A slider that is in an event already goes on with it.
    pub(super) fn begins(&mut self, slider: usize, at: Clock, slip: f64, rate: f64) {
        if self.open[slider].is_some() {
            return;
        }
        let interval = self.onsets[slider].map(|last| at.since(&last));
        self.onsets[slider] = Some(at);
        self.open[slider] = Some((self.events.len(), slip));
        self.events.push(Event {
            slider,
            onset: at.seconds(),
            interval,
            duration: None,
            slip: None,
            peak_rate: rate,
            least_rate: self.least[slider],
        });
        self.least[slider] = f64::INFINITY;
    }

    /// V of a slider fell through the lower threshold.
    pub(super) fn ends(&mut self, slider: usize, at: Clock, slip: f64) {
        let (Some((event, from)), Some(onset)) = (self.open[slider].take(), self.onsets[slider]) else {
            return;
        };
        let event = &mut self.events[event];
        event.duration = Some(at.since(&onset));
        event.slip = Some(slip - from);
    }

    /// A slip rate was seen.
    pub(super) fn sees(&mut self, slider: usize, rate: f64) {
        match self.open[slider] {
            Some((event, _)) => {
                let peak = &mut self.events[event].peak_rate;
                *peak = peak.max(rate);
            }
            None => self.least[slider] = self.least[slider].min(rate),
        }
    }

    /// Events of one slider.
    pub fn of(&self, slider: usize) -> impl Iterator<Item = &Event> {
        self.events.iter().filter(move |e| e.slider == slider)
    }
}
