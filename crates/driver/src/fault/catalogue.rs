//! Events: from the time the fastest point passes a slip rate until all have fallen below a lower one.

use crate::ode::Clock;
use serde::{Deserialize, Serialize};

/// Slip rates that begin and end an event. The fastest place hops from point to point, so that one rate for both would cut an
/// event into several.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Thresholds {
    /// Begin \[m/s\].
    pub on: f64,
    /// End, below `on` \[m/s\].
    pub off: f64,
}

/// An event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Event {
    /// When it began.
    pub onset: Clock,
    /// When it ended.
    pub end: Clock,
    /// Largest slip rate \[m/s\].
    pub peak: f64,
    /// The fastest point at the onset: the hypocentre.
    pub hypocentre: usize,
    /// Slip of all points over the event, component by component \[m\].
    pub slip: Vec<f64>,
    /// Fall of the shear traction of all points over the event, component by component \[Pa\].
    pub drop: Vec<f64>,
}

/// An event that goes on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Open {
    onset: Clock,
    peak: f64,
    hypocentre: usize,
    slip: Vec<f64>,
    shear: Vec<f64>,
}

/// The events of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Catalogue {
    thresholds: Thresholds,
    events: Vec<Event>,
    open: Option<Open>,
}

impl Catalogue {
    /// No events yet.
    #[must_use]
    pub fn new(thresholds: Thresholds) -> Self {
        Self { thresholds, events: Vec::new(), open: None }
    }

    /// The events that have ended, in order.
    #[must_use]
    pub fn events(&self) -> &[Event] {
        &self.events
    }

    /// Onset of the event that goes on.
    #[must_use]
    pub fn under_way(&self) -> Option<Clock> {
        self.open.as_ref().map(|o| o.onset)
    }

    /// The slip rate whose passing comes next \[m/s\], and whether it is passed upwards.
    #[must_use]
    pub(super) fn next(&self) -> (f64, bool) {
        if self.open.is_some() { (self.thresholds.off, false) } else { (self.thresholds.on, true) }
    }

    /// Takes note of the largest slip rate after a step \[m/s\].
    pub(super) fn rate(&mut self, largest: f64) {
        if let Some(open) = &mut self.open {
            open.peak = open.peak.max(largest);
        }
    }

    /// The slip rate of [`Catalogue::next`] is passed at `at`, the point `fastest` being the fastest.
    pub(super) fn pass(&mut self, at: Clock, fastest: usize, slip: &[f64], shear: &[f64]) {
        match self.open.take() {
            None => {
                let (slip, shear) = (slip.to_vec(), shear.to_vec());
                self.open =
                    Some(Open { onset: at, peak: self.thresholds.on, hypocentre: fastest, slip, shear });
            }
            Some(open) => self.events.push(Event {
                onset: open.onset,
                end: at,
                peak: open.peak,
                hypocentre: open.hypocentre,
                slip: slip.iter().zip(&open.slip).map(|(b, a)| b - a).collect(),
                drop: open.shear.iter().zip(shear).map(|(a, b)| a - b).collect(),
            }),
        }
    }
}
