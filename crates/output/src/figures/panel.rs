//! Magnitudes of events over time, with the focal spheres of those that have one.

use super::axes::Axis;
use super::ball::ball;
use super::figure::Figure;
use super::framed_figure::FramedFigure;
use super::legend::Entry;
use super::paper::Paper;
use super::style::Style;
use super::title::title;
use crate::formats::catalogues::Tensor;
use crate::units::TIME;
use serde::{Deserialize, Serialize};

/// An event.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PanelEvent {
    /// Onset \[s\].
    pub onset: f64,
    /// Moment magnitude.
    pub magnitude: f64,
    /// Moment tensor, where it is known.
    pub tensor: Option<Tensor>,
}

/// Events of a run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EventPanel {
    /// Title of the scene.
    pub title: String,
    /// First time shown \[s\].
    pub start: f64,
    /// Last time shown \[s\].
    pub end: f64,
    /// Names of groups of events, such as fast and slow ones, and their events.
    pub groups: Vec<(String, Vec<PanelEvent>)>,
}

/// Radii of the focal spheres at the lower and at the upper end of the magnitudes.
const RADII: (f64, f64) = (8.0, 16.0);
/// Largest number of focal spheres; more would cover each other.
const BALLS: usize = 40;
/// Radius of markers.
const MARKER: f64 = 4.0;
/// Room above and below the magnitudes, as a share of their range.
const MARGIN: f64 = 0.2;
/// Room after the last event, as a share of the time shown.
const BEYOND: f64 = 0.04;
/// Least range of magnitudes, so that equal events do not fill the frame.
const LEAST: f64 = 1.0;

impl EventPanel {
    /// The figure; `None` without events.
    pub(super) fn figure(&self, paper: Paper) -> Option<Figure> {
        let all = || self.groups.iter().flat_map(|group| &group.1);
        let (lo, range) = self.magnitudes().filter(|_| self.end > self.start)?;
        let time = TIME.choose(self.end.abs());
        // A run often stops at an event, which needs room for its sign.
        let last = all().map(|event| event.onset).fold(self.start, f64::max);
        let end = self.end.max(last + BEYOND * (self.end - self.start));
        let x = Axis::exact([self.start / time.factor, end / time.factor], format!("Time [{}]", time.name));
        let y = Axis::exact([lo - MARGIN * range, lo + (1.0 + MARGIN) * range], "Moment magnitude".into());
        let mut page = FramedFigure::new(paper, x, y, &self.entries());
        let FramedFigure { figure, frame, .. } = &mut page;
        title(figure, frame, &self.title, "events");
        frame.grid(figure);
        let bottom = frame.at.1 + frame.size.1;
        let balls = all().count() <= BALLS;
        for (k, (_, events)) in self.groups.iter().enumerate() {
            let style = Style::from_curve(k);
            for event in events.iter().filter(|event| event.magnitude.is_finite()) {
                let at = frame.point(event.onset / time.factor, event.magnitude);
                figure.line(vec![(at.0, bottom), at], 1.2, style.colour);
                let share = (event.magnitude - lo) / range;
                match &event.tensor {
                    Some(tensor) if balls => {
                        let radius = RADII.0 + share * (RADII.1 - RADII.0);
                        ball(figure, tensor, at, radius, style.colour);
                    }
                    _ => style.mark(figure, at, MARKER),
                }
            }
        }
        Some(page.finish())
    }

    /// Least magnitude of the frame, and the range of magnitudes from there; `None` without magnitudes.
    fn magnitudes(&self) -> Option<(f64, f64)> {
        let (lo, hi) = self
            .groups
            .iter()
            .flat_map(|group| &group.1)
            .map(|event| event.magnitude)
            .filter(|m| m.is_finite())
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lo, hi), m| (lo.min(m), hi.max(m)));
        let range = (hi - lo).max(LEAST);
        (lo <= hi).then_some((0.5 * (lo + hi - range), range))
    }

    /// Legend of the groups. One group needs no name: the title says what it is.
    fn entries(&self) -> Vec<Entry> {
        let several = self.groups.iter().filter(|group| !group.1.is_empty()).count() > 1;
        let named = self.groups.iter().enumerate().filter(|(_, group)| several && !group.1.is_empty());
        let entry = |(k, group): (usize, &(String, _))| Entry {
            name: group.0.clone(),
            colour: Style::from_curve(k).colour,
            dash: &[],
        };
        named.map(entry).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::figure::Shape;
    use super::*;

    fn panel(events: usize, tensor: Option<Tensor>) -> EventPanel {
        let one = |k: usize| PanelEvent { onset: k as f64 * 1e9, magnitude: 6.0 + 0.01 * k as f64, tensor };
        let fast: Vec<PanelEvent> = (0..events).map(one).collect();
        EventPanel {
            title: "t".into(),
            start: 0.0,
            end: 1e11,
            groups: vec![("fast".into(), fast), ("slow".into(), vec![])],
        }
    }

    #[test]
    fn each_event_has_a_line_and_a_focal_sphere_or_a_mark() {
        let tensor = Tensor([0.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
        let areas = |panel: &EventPanel| {
            let figure = panel.figure(Paper::default()).unwrap();
            figure.shapes.iter().filter(|shape| matches!(shape, Shape::Area { .. })).count()
        };
        assert_eq!(areas(&panel(3, None)), 3);
        assert!(areas(&panel(3, Some(tensor))) > 100);
        assert_eq!(areas(&panel(BALLS + 1, Some(tensor))), BALLS + 1);
        assert!(panel(0, None).figure(Paper::default()).is_none());
    }
}
