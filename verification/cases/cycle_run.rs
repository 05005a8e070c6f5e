//! Common parts of the energy-budget cases: a fault run with its report and one of its restart points.

use crate::{Capability, CaseError, Cost, Evidence, Ledger};
use asperity::kinds::faults::Report;
use asperity_cycles::{Balance, FaultRun, Faults, Moment, Rupture, Settings};
use asperity_ode::{Control, Outcome};
use asperity_plan::faults::Plan;
use asperity_run::{Event, ObserveError, Observer};

/// Sums the energy balance and keeps one of the restart points.
struct Look<'a> {
    balance: Balance<'a>,
    /// Restart points before the one to keep.
    wait: usize,
    kept: Option<FaultRun>,
}

impl Observer<Faults> for Look<'_> {
    fn step(&mut self, moment: &Moment<'_>) -> Result<Control, ObserveError> {
        self.balance.step(moment);
        Ok(Control::Go)
    }

    fn pause(&mut self, run: &mut dyn FnMut() -> FaultRun) -> Result<Option<&'static str>, ObserveError> {
        if self.wait == 0 && self.kept.is_none() {
            self.kept = Some(run());
        }
        self.wait = self.wait.saturating_sub(1);
        Ok(None)
    }
}

/// A run with its report.
pub struct CycleRun {
    /// The run.
    pub run: FaultRun,
    /// Balances and events of the run.
    pub report: Report,
    /// Wall time and steps.
    pub cost: Cost,
    kept: Option<FaultRun>,
}

impl CycleRun {
    /// Runs a plan from its start until the required events have ended.
    ///
    /// # Errors
    /// If the events do not occur.
    pub fn new(plan: &Plan) -> Result<Self, CaseError> {
        Self::with(plan, plan.problem.settings.tolerance)
    }

    /// The same run with another tolerance of ln V.
    ///
    /// # Errors
    /// As [`CycleRun::new`].
    pub fn with(plan: &Plan, tolerance: f64) -> Result<Self, CaseError> {
        let settings = Settings { tolerance, ..plan.problem.settings };
        Self::from(plan, settings, plan.problem.begin())
    }

    fn from(plan: &Plan, settings: Settings, start: FaultRun) -> Result<Self, CaseError> {
        let mut look = Look { balance: Balance::new(&plan.problem), wait: 3, kept: None };
        let (run, cost) = Cost::measure(|| plan.problem.resume(start, &settings, None, &mut look));
        let run = run?;
        if run.outcome != Outcome::Stopped {
            return Err(format!("the run did not end with its events: {:?}", run.outcome).into());
        }
        let report = Report::new(plan, &run, &mut look.balance);
        let cost = cost.count("steps", run.counts.steps as f64);
        Ok(Self { report, kept: look.kept, cost, run })
    }

    /// The events.
    #[must_use]
    pub fn events(&self) -> &[Event<Rupture>] {
        self.run.events()
    }

    /// Onsets of the events \[s\].
    #[must_use]
    pub fn onsets(&self) -> Vec<f64> {
        self.events().iter().map(|e| e.onset.seconds()).collect()
    }

    /// Claims that a run resumed from the kept restart point ends with the same bits.
    ///
    /// # Errors
    /// If the run had no restart point.
    pub fn restarted(&self, ledger: &mut Ledger, plan: &Plan, tolerance: f64) -> Result<(), CaseError> {
        let kept = self.kept.clone().ok_or("the run never restarted")?;
        let again = Self::from(plan, Settings { tolerance, ..plan.problem.settings }, kept)?;
        let (a, b) = (self.bits(), again.bits());
        let differ = a.iter().zip(&b).filter(|(a, b)| a != b).count() + a.len().abs_diff(b.len());
        ledger
            .claim("numbers that differ in a run resumed from its fourth restart")
            .count(differ as u64, 0)
            .evidence(Evidence::Exact, "the run that was not broken off")
            .because("an unbroken run restarts there as well")
            .covers(&[Capability::FaultCycles, Capability::Determinism])
            .cost(&again.cost)
            .record();
        Ok(())
    }

    /// Bits of unknowns and events.
    fn bits(&self) -> Vec<u64> {
        let events = self
            .events()
            .iter()
            .flat_map(|e| e.details.slip.all().iter().chain(e.details.drop.all()).chain([&e.peak]));
        self.run.unknowns.iter().chain(events).map(|v| v.to_bits()).collect()
    }
}
