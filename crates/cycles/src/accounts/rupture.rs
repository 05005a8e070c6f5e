//! Events of faults. An event begins when the fastest point exceeds a slip rate, and ends when all points are below a
//! lower one. The time above the upper rate alone, which the community reports, is recorded as well.

use super::front::Front;
use crate::problem::{Components, Field, OverEvents, Quantity, Thresholds};
use asperity_ode::Clock;
use asperity_run::{Catalogue, Event};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::ops::Range;

/// Details of an event of faults.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Rupture {
    /// Time during which the fastest point exceeded the rate that begins events \[s\].
    pub above: f64,
    /// Hypocentre: the fastest point at the onset.
    pub hypocentre: usize,
    /// Slip of all points over the event \[m\]; empty while it lasts.
    pub slip: Components<Vec<f64>>,
    /// Drop of the shear traction of all points over the event \[Pa\]; empty while it lasts.
    pub drop: Components<Vec<f64>>,
    /// Changes of quantities of processes at all points over the event, by their names; empty while it lasts.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub changes: BTreeMap<String, Vec<f64>>,
    /// Largest values of quantities of processes at the ends of the steps during the event, by their names.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub largest: BTreeMap<String, f64>,
    /// Rupture times and largest slip rates of its points, for events of all faults together.
    #[serde(default, skip_serializing_if = "Front::is_empty")]
    pub front: Front,
}

impl Rupture {
    /// Change of a quantity of a process at all points over the event; no values while it lasts or without the process.
    #[must_use]
    pub fn change(&self, quantity: &Quantity) -> &[f64] {
        self.changes.get(quantity.name).map_or(&[], Vec::as_slice)
    }

    /// Largest value of a quantity of a process at the ends of the steps during the event, where one shows it.
    #[must_use]
    pub fn largest(&self, quantity: &Quantity) -> Option<f64> {
        self.largest.get(quantity.name).copied()
    }

    /// Records the largest values of quantities at these points at the end of a step.
    pub(crate) fn note(&mut self, fields: &[Field], points: &Range<usize>) {
        for field in fields.iter().filter(|f| f.quantity.over_events == Some(OverEvents::Largest)) {
            // A point without the quantity has a value that is not a number.
            let values = field.values.get(points.clone()).into_iter().flatten().copied();
            let Some(most) = values.filter(|v| v.is_finite()).reduce(f64::max) else { continue };
            let before = self.largest.entry(field.quantity.name.into()).or_insert(most);
            *before = before.max(most);
        }
    }
}

/// Values of all points at an instant.
#[derive(Clone, Copy, Debug)]
pub struct Values<'a> {
    /// Time.
    pub at: Clock,
    /// The fastest point.
    pub fastest: usize,
    /// Slip \[m\].
    pub slip: Components<&'a [f64]>,
    /// Shear traction \[Pa\].
    pub shear: Components<&'a [f64]>,
    /// Values of processes.
    pub fields: &'a [Field],
}

/// Values at the onset of the unfinished event.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Onset {
    /// Time since which the fastest point has been faster than `on`; none while it is slower.
    since: Option<Clock>,
    slip: Vec<f64>,
    shear: Vec<f64>,
    /// Quantities of processes whose changes are recorded.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    quantities: BTreeMap<String, Vec<f64>>,
}

/// Finds the events of one source by the slip rate of its fastest point.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detector {
    thresholds: Thresholds,
    /// Points of the source.
    points: Range<usize>,
    under_way: Option<Onset>,
}

impl Detector {
    /// A detector for these points.
    #[must_use]
    pub fn new(points: Range<usize>, thresholds: Thresholds) -> Self {
        Self { thresholds, points, under_way: None }
    }

    /// Slip rates that begin and end its events.
    #[must_use]
    pub fn thresholds(&self) -> Thresholds {
        self.thresholds
    }

    /// Points of the source.
    #[must_use]
    pub fn points(&self) -> Range<usize> {
        self.points.clone()
    }

    /// Next threshold passed within a step, given the largest slip rate at its end \[m/s\].
    #[must_use]
    pub fn crossing(&self, largest: f64) -> Option<Crossing> {
        let Thresholds { on, off } = self.thresholds;
        match self.under_way.as_ref().map(|o| o.since) {
            None => (largest >= on).then_some(Crossing::Begins),
            Some(Some(_)) => (largest < on).then_some(Crossing::Falls),
            Some(None) if largest >= on => Some(Crossing::Rises),
            Some(None) => (largest < off).then_some(Crossing::Ends),
        }
    }

    /// The slip rate that is passed \[m/s\], and true if it is passed upwards.
    #[must_use]
    pub fn passed(&self, crossing: Crossing) -> (f64, bool) {
        let Thresholds { on, off } = self.thresholds;
        match crossing {
            Crossing::Begins | Crossing::Rises => (on, true),
            Crossing::Falls => (on, false),
            Crossing::Ends => (off, false),
        }
    }

    /// Records a crossing in the events of this source, with the values there.
    pub fn pass(
        &mut self,
        catalogue: &mut Catalogue<Rupture>,
        source: usize,
        crossing: Crossing,
        values: Values<'_>,
    ) {
        let Values { at, fastest, .. } = values;
        match (crossing, catalogue.open(source), &mut self.under_way) {
            (Crossing::Begins, _, under_way) => {
                let details = Rupture { hypocentre: fastest, ..Rupture::default() };
                catalogue.begin(source, at, self.thresholds.on, details);
                *under_way = Some(Onset {
                    since: Some(at),
                    slip: values.slip.all().to_vec(),
                    shear: values.shear.all().to_vec(),
                    quantities: changing(values.fields)
                        .map(|f| (f.quantity.name.into(), f.values.clone()))
                        .collect(),
                });
            }
            (Crossing::Falls, Some(event), Some(onset)) => {
                event.details.above += onset.since.take().map_or(0.0, |since| at.since(&since));
            }
            (Crossing::Rises, Some(_), Some(onset)) => onset.since = Some(at),
            (Crossing::Ends, Some(event), under_way @ Some(_)) => {
                if let Some(onset) = under_way.take() {
                    end(event, &onset, values);
                }
            }
            (_, None, _) | (_, _, None) => {}
        }
    }
}

fn end(event: &mut Event<Rupture>, onset: &Onset, values: Values<'_>) {
    let change = |new: &[f64], old: &[f64]| new.iter().zip(old).map(|(b, a)| b - a).collect();
    event.end = Some(values.at);
    event.details.slip = Components::new(change(values.slip.all(), &onset.slip), values.slip.points());
    event.details.drop = Components::new(change(&onset.shear, values.shear.all()), values.shear.points());
    event.details.changes = changing(values.fields)
        .filter_map(|f| {
            let name = f.quantity.name;
            Some((name.into(), change(&f.values, onset.quantities.get(name)?)))
        })
        .collect();
}

/// Values whose changes are recorded.
fn changing(fields: &[Field]) -> impl Iterator<Item = &Field> {
    fields.iter().filter(|f| f.quantity.over_events == Some(OverEvents::Change))
}

/// Crossing of one of the thresholds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Crossing {
    /// `on` upwards, with no event under way.
    Begins,
    /// `on` downwards.
    Falls,
    /// `on` upwards, within an event.
    Rises,
    /// `off` downwards.
    Ends,
}

#[cfg(test)]
mod tests {
    use super::*;

    const ON_AND_OFF: Thresholds = Thresholds { on: 1.0, off: 0.1 };

    /// Crossings of a history of times and largest rates, and the catalogue.
    fn follow(history: &[(f64, f64)]) -> (Vec<Crossing>, Catalogue<Rupture>) {
        let (mut catalogue, mut found) = (Catalogue::new(1), Vec::new());
        let mut detector = Detector::new(0..1, ON_AND_OFF);
        for (time, largest) in history {
            while let Some(crossing) = detector.crossing(*largest) {
                found.push(crossing);
                let values = Values {
                    at: Clock::new(0.0, *time),
                    fastest: 0,
                    slip: Components::new(std::slice::from_ref(time), 1),
                    shear: Components::new(&[0.0], 1),
                    fields: &[],
                };
                detector.pass(&mut catalogue, 0, crossing, values);
            }
            if let Some(event) = catalogue.open(0) {
                event.peak = event.peak.max(*largest);
            }
        }
        (found, catalogue)
    }

    #[test]
    fn time_above_leaves_out_what_lies_between_the_two_rates() {
        // Above from 1 to 3 and from 6 to 7; below the lower rate at 11.
        let history = [(1.0, 2.0), (3.0, 0.5), (6.0, 4.0), (7.0, 0.9), (11.0, 0.05)];
        let (_, catalogue) = follow(&history);
        let [event] = catalogue.ended(0) else { panic!("one event") };
        assert_eq!((event.details.above, event.duration(), event.peak), (3.0, Some(10.0), 4.0));
        assert_eq!(event.details.slip.all(), [10.0]);
    }

    #[test]
    fn a_step_that_falls_below_both_rates_passes_both() {
        let (found, catalogue) = follow(&[(1.0, 2.0), (2.0, 0.01)]);
        assert_eq!(found, [Crossing::Begins, Crossing::Falls, Crossing::Ends]);
        assert_eq!(catalogue.ended(0)[0].details.above, 1.0);
    }

    #[test]
    fn an_event_under_way_is_none_that_has_ended() {
        let (_, catalogue) = follow(&[(1.0, 2.0), (2.0, 0.01), (5.0, 3.0), (6.0, 0.5)]);
        assert_eq!((catalogue.events(0).len(), catalogue.ended(0).len()), (2, 1));
        let event = catalogue.under_way(0).unwrap();
        assert_eq!((event.interval, event.end), (Some(4.0), None));
    }
}
