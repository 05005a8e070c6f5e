//! Events: from the time the fastest point passes a slip rate until all have fallen below a lower one. Beside that duration stands the
//! time above the upper rate alone, which is what the community counts.

use asperity_ode::Clock;
use serde::{Deserialize, Serialize};
use std::ops::Range;

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
    /// Time of onset.
    pub onset: Clock,
    /// Time of its end.
    pub end: Clock,
    /// Time between the two in which the fastest point was faster than the rate that begins events \[s\].
    pub above: f64,
    /// Largest slip rate \[m/s\].
    pub peak: f64,
    /// The fastest point at the onset: the hypocentre.
    pub hypocentre: usize,
    /// Slip of all points over the event, component by component \[m\].
    pub slip: Vec<f64>,
    /// Fall of the shear traction of all points over the event, component by component \[Pa\].
    pub drop: Vec<f64>,
    /// Growth of the opening of all points over the event, where points may open \[m\].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub opening: Vec<f64>,
}

/// An event that goes on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Open {
    onset: Clock,
    /// Since when the fastest point has been faster than `on`; none while it is slower.
    since: Option<Clock>,
    /// Time above `on` before that \[s\].
    above: f64,
    peak: f64,
    hypocentre: usize,
    slip: Vec<f64>,
    shear: Vec<f64>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    opening: Vec<f64>,
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

    /// Crossing within a step, told by the largest slip rate after it \[m/s\], the first one first.
    #[must_use]
    pub(crate) fn crossing(&self, largest: f64) -> Option<Crossing> {
        let Thresholds { on, off } = self.thresholds;
        match self.open.as_ref().map(|o| o.since) {
            None => (largest >= on).then_some(Crossing::Begins),
            Some(Some(_)) => (largest < on).then_some(Crossing::Falls),
            Some(None) if largest >= on => Some(Crossing::Rises),
            Some(None) => (largest < off).then_some(Crossing::Ends),
        }
    }

    /// The slip rate that is passed \[m/s\], and whether it is passed upwards.
    pub(crate) fn passed(&self, crossing: Crossing) -> (f64, bool) {
        let Thresholds { on, off } = self.thresholds;
        match crossing {
            Crossing::Begins | Crossing::Rises => (on, true),
            Crossing::Falls => (on, false),
            Crossing::Ends => (off, false),
        }
    }

    /// Takes note of the largest slip rate after a step \[m/s\].
    pub fn rate(&mut self, largest: f64) {
        if let Some(open) = &mut self.open {
            open.peak = open.peak.max(largest);
        }
    }

    /// The crossing happens at `at`, the point `fastest` being the fastest; with slip, shear tractions and openings then.
    pub fn pass(
        &mut self,
        crossing: Crossing,
        at: Clock,
        fastest: usize,
        [slip, shear, opening]: [&[f64]; 3],
    ) {
        match (crossing, self.open.take()) {
            (Crossing::Begins, _) => {
                self.open = Some(Open {
                    onset: at,
                    since: Some(at),
                    above: 0.0,
                    peak: self.thresholds.on,
                    hypocentre: fastest,
                    slip: slip.to_vec(),
                    shear: shear.to_vec(),
                    opening: opening.to_vec(),
                });
            }
            (Crossing::Falls, Some(open)) => {
                let above = open.above + open.since.map_or(0.0, |since| at.since(&since));
                self.open = Some(Open { since: None, above, ..open });
            }
            (Crossing::Rises, Some(open)) => self.open = Some(Open { since: Some(at), ..open }),
            (Crossing::Ends, Some(open)) => self.events.push(Event {
                onset: open.onset,
                end: at,
                above: open.above,
                peak: open.peak,
                hypocentre: open.hypocentre,
                slip: slip.iter().zip(&open.slip).map(|(b, a)| b - a).collect(),
                drop: open.shear.iter().zip(shear).map(|(a, b)| a - b).collect(),
                opening: opening.iter().zip(&open.opening).map(|(b, a)| b - a).collect(),
            }),
            (_, None) => {}
        }
    }
}

/// Passing of one of the slip rates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// `on` upwards, with no event.
    Begins,
    /// `on` downwards.
    Falls,
    /// `on` upwards, within an event.
    Rises,
    /// `off` downwards.
    Ends,
}

/// The events of one fault of several, by its own fastest point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Part {
    /// Its points among those of all faults.
    pub points: Range<usize>,
    /// Its events.
    pub catalogue: Catalogue,
}

#[cfg(test)]
mod tests {
    use super::*;

    fn clock(time: f64) -> Clock {
        Clock::new(0.0, time)
    }

    #[test]
    fn time_above_leaves_out_what_lies_between_the_two_rates() {
        let mut catalogue = Catalogue::new(Thresholds { on: 1.0, off: 0.1 });
        // Above from 1 to 3 and from 6 to 7; below the lower rate at 11.
        let history = [(1.0, 2.0), (3.0, 0.5), (6.0, 4.0), (7.0, 0.9), (11.0, 0.05)];
        for (time, largest) in history {
            let crossing = catalogue.crossing(largest).unwrap();
            catalogue.pass(crossing, clock(time), 0, [&[time], &[0.0], &[]]);
            catalogue.rate(largest);
            assert!(catalogue.crossing(largest).is_none());
        }
        let [event] = catalogue.events() else { panic!("one event") };
        assert_eq!((event.above, event.end.since(&event.onset), event.peak), (3.0, 10.0, 4.0));
        assert_eq!(event.slip, [10.0]);
    }

    #[test]
    fn a_step_that_falls_below_both_rates_passes_both() {
        let mut catalogue = Catalogue::new(Thresholds { on: 1.0, off: 0.1 });
        let mut found = Vec::new();
        for (time, largest) in [(1.0, 2.0), (2.0, 0.01)] {
            while let Some(crossing) = catalogue.crossing(largest) {
                found.push(crossing);
                catalogue.pass(crossing, clock(time), 0, [&[0.0], &[0.0], &[]]);
            }
        }
        assert_eq!(found, [Crossing::Begins, Crossing::Falls, Crossing::Ends]);
        assert_eq!(catalogue.events()[0].above, 1.0);
    }
}
