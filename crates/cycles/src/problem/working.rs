//! The processes of a fault in an integration.

use super::fault::Fault;
use super::layout::Layout;
use super::point_tractions::{Field, PointTractions};
use super::process::{Acting, Process};
use super::stage::{FaultState, ProcessRecord, Rates, Time, Tractions};
use asperity_friction::fault::FaultLaw;
use asperity_friction::points::Components;
use asperity_ode::Clock;
use std::ops::Range;

/// A process at work, and its unknowns.
#[derive(Debug)]
struct Member<'a> {
    process: &'a dyn Process,
    acting: Box<dyn Acting + 'a>,
    own: Range<usize>,
}

/// All processes of a fault at work.
#[derive(Debug)]
pub struct Working<'a> {
    fault: &'a Fault,
    layout: Layout,
    all: Vec<Member<'a>>,
}

impl<'a> Working<'a> {
    /// The processes of `fault`, from saved states where they remember.
    #[must_use]
    pub fn new(fault: &'a Fault, saved: &[ProcessRecord]) -> Self {
        let layout = Layout::from_fault(fault);
        let mut first = layout.processes().start;
        let begin = |process: &'a dyn Process| {
            let own = first..first + process.unknowns();
            first = own.end;
            let acting = process.begin(fault.host(), ProcessRecord::find(saved, process.name()));
            Member { process, acting, own }
        };
        Self { fault, layout, all: fault.processes.iter().map(begin).collect() }
    }

    /// The fault.
    #[must_use]
    pub fn fault(&self) -> &'a Fault {
        self.fault
    }

    /// Shows a state to all processes.
    pub fn see(&mut self, at: Clock, unknowns: &[f64]) {
        let now = self.now(at, unknowns);
        self.all.iter_mut().for_each(|m| m.acting.see(&FaultState { own: &unknowns[m.own.clone()], ..now }));
    }

    /// The law in the state last seen.
    #[must_use]
    pub fn law(&self) -> &dyn FaultLaw {
        self.all.iter().find_map(|m| m.acting.law()).unwrap_or(self.fault.law.as_ref())
    }

    /// Slip rates in the state last seen \[m/s\].
    pub fn slip_rates(&self, unknowns: &[f64], rate: &mut [f64]) {
        let l = self.layout;
        self.law().slip_rates(l.unknowns_of(unknowns), Components::new(rate, l.points()));
    }

    /// Writes the rates of the unknowns of processes in the state last seen, given slip rates \[m/s\].
    pub fn rates(&mut self, at: Clock, unknowns: &[f64], slip_rate: &[f64], rates: &mut [f64]) {
        let now = self.now(at, unknowns);
        let slip_rate = Components::new(slip_rate, self.layout.points());
        for m in &mut self.all {
            let now = FaultState { own: &unknowns[m.own.clone()], ..now };
            m.acting.rates(&now, slip_rate, &mut rates[m.own.clone()]);
        }
    }

    /// Changes tractions and their rates, without the processes that are sudden at `without` \[s\].
    ///
    /// # Errors
    /// A point whose state does not converge.
    pub fn act(&mut self, time: Time, without: Option<f64>, on: &mut Tractions<'_>) -> Result<(), usize> {
        let acts = |process: &dyn Process| !without.is_some_and(|time| process.is_sudden(time));
        self.all.iter_mut().filter(|m| acts(m.process)).try_for_each(|m| m.acting.act(time, on))
    }

    /// Normal tractions and values of processes in the state last seen, at a time.
    pub fn pressed(&mut self, at: Clock, unknowns: &[f64]) -> PointTractions {
        let mut normal = self.fault.total(unknowns).to_vec();
        let time = Time { at: at.seconds(), until: f64::INFINITY };
        for m in &mut self.all {
            let _ = m.acting.act(time, &mut Tractions { normal: &mut normal, rates: None });
        }
        PointTractions { normal, fields: self.fields(|acting| acting.fields()) }
    }

    /// Rates of f_n as friction uses it \[Pa/s\] and of values of processes, given those of the unknowns.
    pub fn pressing(&mut self, time: Time, unknowns: &[f64], rates: &[f64]) -> PointTractions {
        let l = self.layout;
        let mut normal = self.fault.total(unknowns).to_vec();
        let mut rate = vec![0.0; normal.len()];
        if !l.normal().is_empty() {
            rate.copy_from_slice(&rates[l.normal()]);
        }
        let mut shear = vec![0.0; l.m().end];
        let shear = Components::new(shear.as_mut_slice(), l.points());
        let by = Rates { slip: l.slip_of(rates), normal: &mut rate, shear };
        let _ = self.act(time, None, &mut Tractions { normal: &mut normal, rates: Some(by) });
        PointTractions { normal: rate, fields: self.fields(|acting| acting.field_rates()) }
    }

    /// Largest bound of the rates of relaxation of processes \[1/s\].
    #[must_use]
    pub fn relaxation(&self) -> f64 {
        self.all.iter().map(|m| m.acting.relaxation()).fold(0.0, f64::max)
    }

    /// True if a process remembers more than the unknowns hold.
    #[must_use]
    pub fn remembers(&self) -> bool {
        self.all.iter().any(|m| m.acting.remembers())
    }

    /// Commits a step that ends in this state.
    pub fn commit(&mut self, at: Clock, unknowns: &[f64]) {
        let now = self.now(at, unknowns);
        self.all
            .iter_mut()
            .for_each(|m| m.acting.commit(&FaultState { own: &unknowns[m.own.clone()], ..now }));
    }

    /// Saves what processes remember.
    #[must_use]
    pub fn save(&self) -> Vec<ProcessRecord> {
        self.all.iter().filter_map(|m| m.acting.save()).collect()
    }

    /// Values or rates of all processes.
    fn fields(&self, of: impl Fn(&dyn Acting) -> Vec<Field>) -> Vec<Field> {
        self.all.iter().flat_map(|m| of(m.acting.as_ref())).collect()
    }

    fn now<'b>(&self, at: Clock, unknowns: &'b [f64]) -> FaultState<'b>
    where
        'a: 'b,
    {
        let friction = self.layout.unknowns_of(unknowns);
        FaultState { at, friction, normal: self.fault.total(unknowns), own: &[] }
    }
}

impl Fault {
    /// Computes the normal tractions of the points at a moment of a fault without memory, or at its start. If the state of a
    /// process does not converge, which makes the integration fail, the result is that of its last iterate.
    #[must_use]
    pub fn pressed(&self, at: Clock, unknowns: &[f64]) -> PointTractions {
        let mut working = Working::new(self, &[]);
        working.see(at, unknowns);
        working.pressed(at, unknowns)
    }

    /// Slip rates of these unknowns \[m/s\], with the law before any process.
    #[must_use]
    pub fn slip_rates(&self, unknowns: &[f64]) -> Components<Vec<f64>> {
        let layout = Layout::from_fault(self);
        let mut rate = Components::new(vec![0.0; layout.m().len()], layout.points());
        self.law.slip_rates(layout.unknowns_of(unknowns), rate.view_mut());
        rate
    }

    /// Normal tractions of the bodies \[Pa\], before any process.
    #[must_use]
    pub fn total<'a>(&'a self, unknowns: &'a [f64]) -> &'a [f64] {
        let own = Layout::from_fault(self).normal();
        if own.is_empty() { &self.normal } else { &unknowns[own] }
    }
}
