//! Openings of faults as a process: a function of normal tractions, without unknowns of its own.

mod complementarity;
mod opening_record;

pub use complementarity::{Crack, Opening};
pub use opening_record::{OPENING, OpeningRecord, Widest};

use crate::problem::{
    Account, Acting, Energetic, Field, Host, Phase, PointTractions, Process, ProcessRecord, Stretch, Time,
    Tractions, Way,
};

impl Process for Opening {
    fn name(&self) -> &'static str {
        "opening"
    }

    fn phase(&self) -> Phase {
        Phase::Opening
    }

    fn begin<'a>(&'a self, host: Host<'a>, _: Option<&ProcessRecord>) -> Box<dyn Acting + 'a> {
        Box::new(Parting { opening: self, points: host.law.points(), crack: Crack::default() })
    }

    fn presses(&self) -> bool {
        true
    }

    fn energetic(&self) -> Option<&dyn Energetic> {
        Some(self)
    }

    fn account(&self, saved: Option<&ProcessRecord>) -> Option<Box<dyn Account>> {
        Some(Box::new(OpeningRecord::new(self.points(), saved)))
    }
}

impl Energetic for Opening {
    fn first(&self, pressed: &PointTractions, normal: &mut [f64]) {
        self.pressing(pressed.values(&OPENING), normal);
    }

    fn sheared(&self, between: [&PointTractions; 2], shear: &mut [f64]) {
        Opening::sheared(self, &parted(between), shear);
    }

    fn work(&self, over: &Stretch<'_>) -> f64 {
        let h = over.length;
        let [before, after] = over.pressed.map(|pressed| pressed.values(&OPENING));
        let [first, last] = over.rates.map(|rates| rates.values(&OPENING));
        let work = |&p: &usize| {
            let way = Way { by: after[p] - before[p], rates: [h * first[p], h * last[p]] };
            let [start, end] = over.parting.map(|end| [end[p][0], h * end[p][1]]);
            over.areas[p] * way.work(start, end)
        };
        self.points().iter().map(work).sum()
    }

    fn stored(&self, between: [&PointTractions; 2], slip: &[f64], areas: &[f64]) -> f64 {
        let apart = parted(between);
        let (mut normal, mut shear) = (vec![0.0; areas.len()], vec![0.0; slip.len()]);
        self.pressing(&apart, &mut normal);
        Opening::sheared(self, &apart, &mut shear);
        let areas = || areas.iter().cycle();
        let own: f64 = apart.iter().zip(&normal).zip(areas()).map(|((o, t), area)| 0.5 * area * o * t).sum();
        let on_slip: f64 = slip.iter().zip(&shear).zip(areas()).map(|((s, t), area)| area * s * t).sum();
        own - on_slip
    }
}

/// Change of the openings between two states \[m\].
fn parted(between: [&PointTractions; 2]) -> Vec<f64> {
    let [first, last] = between.map(|pressed| pressed.values(&OPENING));
    last.iter().zip(first).map(|(b, a)| b - a).collect()
}

/// Openings in an integration.
#[derive(Debug)]
struct Parting<'a> {
    opening: &'a Opening,
    /// Number of points of the fault.
    points: usize,
    crack: Crack,
}

impl Acting for Parting<'_> {
    fn act(&mut self, _: Time, on: &mut Tractions<'_>) -> Result<(), usize> {
        self.opening.solve(&mut self.crack, on.normal)?;
        if let Some(rates) = &mut on.rates {
            self.opening.rates(&mut self.crack, rates.normal, rates.shear.all_mut());
        }
        Ok(())
    }

    fn fields(&self) -> Vec<Field> {
        let mut values = vec![0.0; self.points];
        self.opening.evaluate(&self.crack, &mut values, &mut []);
        vec![Field { quantity: &OPENING, values }]
    }

    fn field_rates(&self) -> Vec<Field> {
        let mut values = vec![0.0; self.points];
        self.opening.evaluate(&self.crack, &mut vec![0.0; self.points], &mut values);
        vec![Field { quantity: &OPENING, values }]
    }
}
