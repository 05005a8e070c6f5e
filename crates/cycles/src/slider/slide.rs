//! Events of sliders: onset and end, direction and amount of slip, slip rates, and stress drop.

use asperity_ode::Clock;
use asperity_run::{Catalogue, Event};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// State of a slider at the onset or end of an event.
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

/// Details of an event of a slider. It begins when \|V\| in one direction exceeds the upper threshold, and ends when
/// \|V\| falls below the lower one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Slide {
    /// 1 for positive slip rates, -1 for negative ones.
    pub direction: i8,
    /// Smallest \|V\| since the previous event \[m/s\]; zero if the slider reversed.
    pub least_rate: f64,
    /// State at the onset.
    pub at_onset: Edge,
    /// State at the end.
    pub at_end: Option<Edge>,
}

impl Slide {
    /// Slip from onset to end, negative against the positive direction \[m\]; none for an unfinished event.
    #[must_use]
    pub fn slip(&self) -> Option<f64> {
        self.at_end.as_ref().map(|end| end.slip - self.at_onset.slip)
    }

    /// Traction at the onset minus that at the end, in the direction of slip \[Pa\]; none for an unfinished event.
    #[must_use]
    pub fn stress_drop(&self) -> Option<f64> {
        let fall = |end: &Edge| f64::from(self.direction) * (self.at_onset.traction - end.traction);
        self.at_end.as_ref().map(fall)
    }
}

/// Detection of the events of sliders.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Detectors(Vec<Detector>);

/// Slip rates of a slider between its events.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Detector {
    /// Smallest \|V\| since the last event; none if no rate was recorded.
    least: Option<f64>,
    /// Last recorded slip rate \[m/s\].
    last: f64,
}

impl Detectors {
    /// Detectors of this many sliders.
    pub(super) fn new(sliders: usize) -> Self {
        Self(vec![Detector::default(); sliders])
    }

    /// Records that \|V\| of a slider rose through the upper threshold. An unfinished event in this direction continues;
    /// one in the other direction ends.
    pub(super) fn begin(
        &mut self,
        events: &mut Catalogue<Slide>,
        slider: usize,
        at: Clock,
        rate: f64,
        edge: Edge,
    ) {
        let direction = if rate < 0.0 { -1 } else { 1 };
        if let Some(event) = events.open(slider) {
            if event.details.direction == direction {
                return;
            }
            end(event, at, edge.clone());
        }
        self.see(events, slider, rate);
        let least_rate = self.0[slider].least.take().unwrap_or(rate.abs());
        events.begin(slider, at, rate.abs(), Slide { direction, least_rate, at_onset: edge, at_end: None });
    }

    /// Records a slip rate.
    pub(super) fn see(&mut self, events: &mut Catalogue<Slide>, slider: usize, rate: f64) {
        let detector = &mut self.0[slider];
        let turned = detector.last != 0.0 && rate != 0.0 && (detector.last < 0.0) != (rate < 0.0);
        detector.last = rate;
        match events.open(slider) {
            Some(event) => {
                if rate * f64::from(event.details.direction) > event.peak {
                    event.peak = rate.abs();
                }
            }
            None => {
                let least = if turned { 0.0 } else { rate.abs() };
                detector.least = Some(detector.least.map_or(least, |l| l.min(least)));
            }
        }
    }
}

/// Records that \|V\| of a slider fell through the lower threshold.
pub(super) fn end(event: &mut Event<Slide>, at: Clock, edge: Edge) {
    event.end = Some(at);
    event.details.at_end = Some(edge);
}
