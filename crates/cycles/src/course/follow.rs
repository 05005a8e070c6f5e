//! Follows a run step by step: detects events by the largest slip rate, and reports each step to the observer.

use super::fault_run::{Faults, Outrun};
use crate::accounts::{Detector, Ends, Moment, Rupture, Stride, Values};
use crate::equations::Equations;
use crate::problem::{Components, Field, PointTractions};
use asperity_ode::{Clock, Control, Step};
use asperity_run::{ALL, Catalogue, ObserveError, Observer};
use std::ops::Range;

/// The course of the unknowns over a step.
pub(crate) trait Course {
    /// Time at its start.
    fn start(&self) -> Clock;

    /// Its length \[s\].
    fn length(&self) -> f64;

    /// Unknowns at its start.
    fn first(&self) -> &[f64];

    /// Writes unknowns and slip rates \[m/s\] at `fraction` of the step, from 0 to 1.
    fn at(&self, fraction: f64, equations: &Equations<'_>, unknowns: &mut [f64], rate: &mut [f64]);
}

impl Course for Step<'_> {
    fn start(&self) -> Clock {
        self.start
    }

    fn length(&self) -> f64 {
        Step::length(self)
    }

    fn first(&self) -> &[f64] {
        self.start_state()
    }

    fn at(&self, fraction: f64, equations: &Equations<'_>, unknowns: &mut [f64], rate: &mut [f64]) {
        Step::at(self, fraction, unknowns);
        let at = self.start.later(fraction * Step::length(self));
        equations.slip_rates(at, unknowns, rate);
    }
}

/// The end of a step.
#[derive(Clone, Copy)]
pub(crate) struct End<'a> {
    /// Time.
    pub at: Clock,
    /// Unknowns.
    pub unknowns: &'a [f64],
    /// Slip rates \[m/s\].
    pub rate: &'a [f64],
    /// Rates of the unknowns at the start and at the end of the step, where they are known.
    pub rates: Option<[&'a [f64]; 2]>,
}

/// State of a run.
#[derive(Clone, Copy)]
pub(crate) struct State<'a> {
    /// Time.
    pub at: Clock,
    /// Unknowns.
    pub unknowns: &'a [f64],
}

/// Events of a run, and what finds them.
pub(crate) struct Events<'a> {
    /// The events.
    pub catalogue: &'a mut Catalogue<Rupture>,
    /// Detectors of the sources.
    pub detectors: &'a mut [Detector],
    /// Slip rate at which a point has ruptured \[m/s\].
    pub rupture_rate: f64,
}

/// See the module.
pub(crate) struct Follow<'a, 'f> {
    equations: &'a Equations<'f>,
    observer: &'a mut dyn Observer<Faults>,
    /// Failure of the observer.
    pub failure: Option<ObserveError>,
    events: Events<'a>,
    rate: Vec<f64>,
    /// Slip rates at the end of the last step \[m/s\].
    before: Vec<f64>,
    shear: Vec<f64>,
    /// Unknowns within a step.
    between: Vec<f64>,
    /// Largest slip rate at the end of the last step \[m/s\].
    pub largest: f64,
    /// Normal tractions and values of processes at the end of the last step.
    pressed: PointTractions,
}

/// The fastest point, if its slip rate is beyond `most` \[m/s\] or no number.
pub(crate) fn outrun<V: AsRef<[f64]>>(rate: Components<V>, most: f64) -> Option<Outrun> {
    let speeds = (0..rate.points()).map(|point| Outrun { point, rate: rate.size(point) });
    let beyond = speeds.filter(|o| o.rate > most || o.rate.is_nan());
    beyond.reduce(|a, b| if b.rate > a.rate { b } else { a })
}

/// Number of halvings of a step in the search for the time at which a slip rate is passed; they reach the rounding of times.
const MOST_HALVINGS: usize = 60;

impl<'a, 'f> Follow<'a, 'f> {
    /// Follows a run from the state that it has reached.
    pub fn new(
        equations: &'a Equations<'f>,
        observer: &'a mut dyn Observer<Faults>,
        State { at, unknowns }: State<'_>,
        events: Events<'a>,
    ) -> Self {
        let vectors = equations.layout().m().end;
        let pressed = equations.pressed(at, unknowns);
        let mut rate = vec![0.0; vectors];
        equations.slip_rates(at, unknowns, &mut rate);
        let mut follow = Self {
            equations,
            observer,
            failure: None,
            events,
            before: rate.clone(),
            rate,
            shear: vec![0.0; vectors],
            between: unknowns.to_vec(),
            largest: 0.0,
            pressed,
        };
        follow.largest = follow.fastest(&follow.rate, follow.all()).1;
        follow
    }

    /// The equations.
    pub fn equations(&self) -> &'a Equations<'f> {
        self.equations
    }

    /// Reports the start of a run.
    pub fn begin(&mut self, at: Clock, y: &[f64]) -> Control {
        self.report(at, 0.0, y, None)
    }

    /// Number of finished events of all faults together.
    pub fn events(&self) -> usize {
        self.events.catalogue.ended(ALL).len()
    }

    fn all(&self) -> Range<usize> {
        0..self.equations.layout().points()
    }

    /// The fastest of these points and its \|V\| \[m/s\].
    fn fastest(&self, rate: &[f64], among: Range<usize>) -> (usize, f64) {
        let rate = Components::new(rate, self.equations.layout().points());
        let mut best = (among.start, 0.0);
        for p in among {
            let speed = rate.size(p);
            if speed > best.1 {
                best = (p, speed);
            }
        }
        best
    }

    /// The fastest point, if its slip rate is beyond `most` \[m/s\] or no number.
    pub fn outrun(&self, rate: &[f64], most: f64) -> Option<Outrun> {
        outrun(Components::new(rate, self.equations.layout().points()), most)
    }

    fn report(&mut self, at: Clock, dt: f64, unknowns: &[f64], step: Option<Ends<'_>>) -> Control {
        let layout = self.equations.layout();
        let rate = Components::new(self.rate.as_slice(), layout.points());
        let (largest, catalogue, pressed) = (self.largest, &*self.events.catalogue, &self.pressed);
        let moment = Moment { at, dt, unknowns, layout, rate, largest, pressed, catalogue, step };
        self.observer.step(&moment).unwrap_or_else(|failure| {
            self.failure = Some(failure);
            Control::Stop
        })
    }

    /// Finds the time within the step at which the fastest of these points passes a threshold, and that point. Uses
    /// bisection, since the fastest point may change. Leaves the unknowns and tractions at that time in `self`, and
    /// returns the values of processes as well.
    fn locate(
        &mut self,
        course: &dyn Course,
        (threshold, upwards): (f64, bool),
        among: Range<usize>,
    ) -> (Clock, usize, Vec<Field>) {
        let (mut before, mut after) = (0.0, 1.0);
        for _ in 0..MOST_HALVINGS {
            let middle = 0.5 * (before + after);
            if middle <= before || middle >= after {
                break;
            }
            course.at(middle, self.equations, &mut self.between, &mut self.rate);
            if (self.fastest(&self.rate, among.clone()).1 >= threshold) == upwards {
                after = middle;
            } else {
                before = middle;
            }
        }
        course.at(after, self.equations, &mut self.between, &mut self.rate);
        let at = course.start().later(after * course.length());
        let layout = self.equations.layout();
        let pressed = self.equations.pressed(at, &self.between);
        for (i, shear) in self.shear.iter_mut().enumerate() {
            let p = i % layout.points();
            *shear = pressed.normal[p] * self.equations.fault().law.scale(p) * self.between[i];
        }
        (at, self.fastest(&self.rate, among).0, pressed.fields)
    }

    /// Detects onsets and ends of events within a step; `largest` holds the largest slip rate of each source at its end
    /// \[m/s\].
    fn detect(&mut self, course: &dyn Course, largest: &[f64]) {
        for (source, &largest) in largest.iter().enumerate() {
            self.note_peak(source, largest);
            while let Some(crossing) = self.events.detectors[source].crossing(largest) {
                let detector = &self.events.detectors[source];
                let (passed, points) = (detector.passed(crossing), detector.points());
                let (at, fastest, fields) = self.locate(course, passed, points);
                let layout = self.equations.layout();
                let slip = layout.slip_of(&self.between);
                let shear = Components::new(self.shear.as_slice(), layout.points());
                let values = Values { at, fastest, slip, shear, fields: &fields };
                let Events { catalogue, detectors, .. } = &mut self.events;
                detectors[source].pass(catalogue, source, crossing, values);
                self.note_peak(source, largest);
            }
        }
    }

    /// Records the largest values of processes in the unfinished events.
    fn note_processes(&mut self) {
        let Events { catalogue, detectors, .. } = &mut self.events;
        for (source, detector) in detectors.iter().enumerate() {
            if let Some(event) = catalogue.open(source) {
                event.details.note(&self.pressed.fields, &detector.points());
            }
        }
    }

    /// Records rupture times and largest slip rates of the points in the unfinished event of all faults, if there is one.
    fn note_front(&mut self, course: &dyn Course, end: &[f64]) {
        let points = self.equations.layout().points();
        let Some(event) = self.events.catalogue.open(ALL) else { return };
        let rates = [self.before.as_slice(), end].map(|rate| Components::new(rate, points));
        let (start, length) = (course.start().since(&event.onset), course.length());
        event.details.front.see(Stride { start, length, rates }, self.events.rupture_rate);
    }

    fn note_peak(&mut self, source: usize, largest: f64) {
        if let Some(event) = self.events.catalogue.open(source) {
            event.peak = event.peak.max(largest);
        }
    }

    /// Passes a step: its events, its processes, and its end for the observer. `waves` gives the energy that waves took over
    /// the step \[J\], if the step is one of bodies with mass; it is asked whether an event has ended.
    pub fn pass(
        &mut self,
        course: &dyn Course,
        end: End<'_>,
        waves: Option<&mut dyn FnMut(bool) -> f64>,
    ) -> Control {
        let detectors = self.events.detectors.iter();
        let largest: Vec<f64> = detectors.map(|d| self.fastest(end.rate, d.points()).1).collect();
        let events = self.events();
        self.detect(course, &largest);
        self.note_front(course, end.rate);
        self.rate.copy_from_slice(end.rate);
        self.before.copy_from_slice(end.rate);
        self.largest = largest[ALL];
        let pressed = self.equations.pressed(end.at, end.unknowns);
        self.equations.commit(end.at, end.unknowns);
        let start_pressed = std::mem::replace(&mut self.pressed, pressed);
        self.note_processes();
        let ended = self.events() > events;
        let waves = waves.map(|taken| taken(ended));
        let ends = end.rates.map(|[start_rates, end_rates]| Ends {
            start: course.first(),
            start_pressed: &start_pressed,
            start_rates,
            end_rates,
            waves,
        });
        self.report(end.at, course.length(), end.unknowns, ends)
    }
}
