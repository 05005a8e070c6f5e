//! Catalogue of events: of a fault, of all faults together, or of a spring-slider.

use asperity_ode::Clock;
use serde::{Deserialize, Serialize};

/// Source of the events of all faults together, defined by the fastest point of all.
pub const ALL: usize = 0;

/// An event, with details `D` of its kind of source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event<D> {
    /// Time of onset.
    pub onset: Clock,
    /// Time since the onset of the previous event of the same source \[s\]. It keeps digits that large absolute times lose.
    pub interval: Option<f64>,
    /// Time of its end; none while it lasts.
    pub end: Option<Clock>,
    /// Largest slip rate \[m/s\].
    pub peak: f64,
    /// Details specific to the kind of source.
    pub details: D,
}

/// Head of an event in a catalogue: numbers of every kind of source, before those of its kind alone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventHead<'a> {
    /// Onset \[s\].
    pub onset: f64,
    /// Time from onset to end \[s\]; none while it lasts.
    pub duration: Option<f64>,
    /// Time of the end \[s\]; none while it lasts.
    pub end: Option<f64>,
    /// Time since the onset of the previous event \[s\].
    pub interval: Option<f64>,
    /// Largest slip rate \[m/s\].
    pub peak_rate: f64,
    /// Drop of shear traction \[Pa\]; none while it lasts.
    pub stress_drop: Option<f64>,
    /// Fault, interface or slider.
    pub surface: &'a str,
}

impl<D> Event<D> {
    /// Time from onset to end \[s\]; none while it lasts.
    #[must_use]
    pub fn duration(&self) -> Option<f64> {
        self.end.map(|end| end.since(&self.onset))
    }

    /// Time of its end \[s\], the sum of onset and duration as files show them; none while it lasts.
    #[must_use]
    pub fn end_time(&self) -> Option<f64> {
        self.duration().map(|duration| self.onset.seconds() + duration)
    }
}

/// Events of several sources, each in the order of onset. Only the last event of a source may be unfinished.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Catalogue<D> {
    sources: Vec<Vec<Event<D>>>,
}

impl<D> Catalogue<D> {
    /// Empty catalogue of this many sources.
    #[must_use]
    pub fn new(sources: usize) -> Self {
        Self { sources: (0..sources).map(|_| Vec::new()).collect() }
    }

    /// Adds sources without events.
    pub fn add(&mut self, sources: usize) {
        self.sources.extend((0..sources).map(|_| Vec::new()));
    }

    /// Number of sources.
    #[must_use]
    pub fn sources(&self) -> usize {
        self.sources.len()
    }

    /// Events of a source, including an unfinished one.
    #[must_use]
    pub fn events(&self, source: usize) -> &[Event<D>] {
        &self.sources[source]
    }

    /// Finished events of a source.
    #[must_use]
    pub fn ended(&self, source: usize) -> &[Event<D>] {
        let events = self.events(source);
        &events[..events.len() - usize::from(self.under_way(source).is_some())]
    }

    /// The unfinished event of a source.
    #[must_use]
    pub fn under_way(&self, source: usize) -> Option<&Event<D>> {
        self.events(source).last().filter(|event| event.end.is_none())
    }

    /// Events of all sources in the order of onset, each with its source.
    #[must_use]
    pub fn in_order(&self) -> Vec<(usize, &Event<D>)> {
        let of = |(source, events)| std::iter::repeat(source).zip(events);
        let mut all: Vec<_> = self.sources.iter().enumerate().flat_map(of).collect();
        // A stable sort: simultaneous events stay in the order of their sources.
        all.sort_by(|a, b| a.1.onset.since(&b.1.onset).total_cmp(&0.0));
        all
    }

    /// The unfinished event of a source, mutable.
    pub fn open(&mut self, source: usize) -> Option<&mut Event<D>> {
        self.sources[source].last_mut().filter(|event| event.end.is_none())
    }

    /// Begins an event of a source that has no unfinished one.
    pub fn begin(&mut self, source: usize, onset: Clock, peak: f64, details: D) {
        let interval = self.events(source).last().map(|before| onset.since(&before.onset));
        self.sources[source].push(Event { onset, interval, end: None, peak, details });
    }
}
