//! Fields on faults in space: states during a run and at its end, and slip and traction drop of each event.

use super::states::has_theta;
use super::{locking, pore};
use asperity_cycles::heat::TEMPERATURE;
use asperity_cycles::{Components, Layout, OPENING, PointTractions, Rupture};
use asperity_output::fields::vtu::{Cell, Grid, face_type};
use asperity_output::fields::{Data, FILES, Field, FieldTimes, Series};
use asperity_output::tables::Sign;
use asperity_plan::faults::cadence::log_rate;
use asperity_plan::faults::{FaultView, Outline, Plan};
use asperity_run::Event;

/// State of all faults at a moment.
pub(super) struct Present {
    pub unknowns: Vec<f64>,
    /// Slip rates \[m/s\].
    pub rate: Vec<f64>,
    pub pressed: PointTractions,
}

/// Surface of a fault: its triangles, or else faces between its points.
fn surface(plan: &Plan, fault: &FaultView) -> Grid {
    let points = &plan.points[fault.points.clone()];
    if let Some(Outline { nodes, corners }) = &fault.outline {
        let cells: Vec<Cell> = corners.iter().map(|c| Cell::new(face_type(3), c.to_vec())).collect();
        return Grid::new(nodes, &cells);
    }
    let places: Vec<[f64; 3]> = points.iter().map(|p| p.at).collect();
    let cells: Vec<Cell> = fault.faces.iter().map(|f| Cell::new(face_type(f.len()), f.clone())).collect();
    Grid::new(&places, &cells)
}

/// Series of fields on a fault, read from states `S`.
struct OnFault<'a, S> {
    plan: &'a Plan,
    fault: &'a FaultView,
    series: Series<'a, S>,
}

impl<'a, S> OnFault<'a, S> {
    fn new((plan, fault): (&'a Plan, &'a FaultView), path: String, times: FieldTimes) -> Self {
        Self { plan, fault, series: Series::new(path, times, move || surface(plan, fault)) }
    }

    /// The field where the fault has values.
    fn placed(&self, field: Field) -> Field {
        // A fault of triangles has a value for each of them.
        if self.fault.outline.is_some() { field.in_cells() } else { field }
    }

    /// Adds the number at each point.
    fn with(mut self, field: Field, value: impl Fn(&S, usize) -> f64 + Send + Sync + 'a) -> Self {
        let (field, points) = (self.placed(field), self.fault.points.clone());
        self.series = self
            .series
            .with(field, move |now| points.clone().map(|p| value(now, p)).collect::<Vec<f64>>().into());
        self
    }

    /// Adds the vector in space at each point of values by components.
    fn with_vectors(mut self, field: Field, values: impl Fn(&S) -> Vec<f64> + Send + Sync + 'a) -> Self {
        let (field, plan, points) = (self.placed(field), self.plan, self.fault.points.clone());
        self.series = self.series.with(field, move |now| {
            let values = Components::new(values(now), plan.points.len());
            points.clone().map(|p| plan.vector(&values, p)).collect::<Vec<_>>().into()
        });
        self
    }

    /// Adds values along `rake`, or magnitudes for vector slip; and the vectors in space as `NAME_vector`.
    fn along(mut self, field: Field, values: impl Fn(&S) -> Vec<f64> + Clone + Send + Sync + 'a) -> Self {
        let vector = Field::vector(format!("{}_vector", field.name), field.unit, Sign::Vector, field.meaning);
        let (field, plan, fault, own) = (self.placed(field), self.plan, self.fault, values.clone());
        self.series = self
            .series
            .with(field, move |now| scalars(fault, &Components::new(own(now), plan.points.len())).into());
        self.with_vectors(vector, values)
    }
}

/// Values along `rake` at the points of a fault, or magnitudes for vector slip.
pub(super) fn scalars(fault: &FaultView, values: &Components<impl AsRef<[f64]>>) -> Vec<f64> {
    if values.components() == 1 {
        return values.all()[fault.points.clone()].to_vec();
    }
    fault.points.clone().map(|p| values.size(p)).collect()
}

/// Shear tractions \[Pa\], by components.
fn shear(plan: &Plan, now: &Present) -> Vec<f64> {
    let (law, n) = (&plan.problem.fault.law, plan.points.len());
    let traction = |i: usize| now.pressed.normal[i % n] * law.scale(i % n) * now.unknowns[i];
    Layout::from_fault(&plan.problem.fault).m().map(traction).collect()
}

/// States during the run: the temperature and the pore pressure where friction heats the fault, coupling where plates load it,
/// and the state variables of the law, with log10 of θ where it has one.
pub(super) fn states<'a>(plan: &'a Plan, fault: &'a FaultView) -> Series<'a, Present> {
    state((plan, fault), FILES.named(&format!("{}_*", fault.name)), FieldTimes::Intervals)
}

/// The state at the end of the run.
pub(super) fn last<'a>(plan: &'a Plan, fault: &'a FaultView) -> Series<'a, Present> {
    state((plan, fault), FILES.named(&format!("{}_end", fault.name)), FieldTimes::End)
}

fn state<'a>(on: (&'a Plan, &'a FaultView), path: String, times: FieldTimes) -> Series<'a, Present> {
    let (plan, fault) = on;
    let (layout, n) = (Layout::from_fault(&plan.problem.fault), plan.points.len());
    let rate = Field::scalar("log10_slip_rate", "m/s", Sign::Log, "slip rate");
    let rates = Field::vector("slip_rate_vector", "m/s", Sign::Vector, "slip rate");
    let mut all = OnFault::new(on, path, times)
        .along(Field::scalar("slip", "m", Sign::Slip, "slip"), move |now: &Present| {
            layout.slip_of(&now.unknowns).all().to_vec()
        })
        .with(rate, move |now, p| log_rate(Components::new(&now.rate, n).size(p)))
        .with_vectors(rates, |now| now.rate.clone())
        .along(Field::scalar("shear_traction", "Pa", Sign::Slip, "shear traction"), |now| shear(plan, now))
        .with(Field::scalar("normal_traction", "Pa", Sign::Compression, "normal traction"), |now, p| {
            now.pressed.normal[p]
        });
    if fault.normal.opens {
        all = all.with(opening(), |now, p| now.pressed.values(&OPENING)[p]);
    }
    if fault.heat.is_some() {
        let field = Field::scalar("temperature", "K", Sign::None, "temperature");
        all = all.with(field, |now, p| now.pressed.values(&TEMPERATURE)[p]);
    }
    if pore::changes(plan, fault.points.start) {
        let field = Field::scalar("pore_pressure", "Pa", Sign::None, "pore pressure, in excess of the start");
        all = all.with(field, |now, p| pore::at(&now.pressed, p));
    }
    if locking::loaded(plan, fault) {
        let field = Field::scalar("coupling", "-", Sign::None, "coupling to the plates that load the fault");
        all = all.with(field, move |now, p| locking::coupling(plan, &Components::new(&now.rate, n), p));
    }
    if has_theta(plan, fault) {
        let field = Field::scalar("log10_theta", "s", Sign::Log, "state θ of the law");
        all = all.with(field, move |now, p| {
            plan.points[p]
                .theta
                .map_or(f64::NAN, |theta| theta.log10(layout.states_of(&now.unknowns).at(p)[0]))
        });
    }
    for k in 0..plan.problem.fault.law.states() {
        let field = Field::scalar(format!("state_{}", k + 1), "", Sign::None, "state variable of the law");
        all = all.with(field, move |now, p| layout.states_of(&now.unknowns).at(p)[k]);
    }
    all.series
}

fn opening() -> Field {
    Field::scalar("opening", "m", Sign::Apart, "opening")
}

/// Fields that events leave: slip and drop, rupture times, largest slip rates and, if slip may turn, its angles from the rake.
pub(super) fn events<'a>(plan: &'a Plan, fault: &'a FaultView) -> Series<'a, Event<Rupture>> {
    let (path, points) = (FILES.named(&format!("{}_event_*", fault.name)), fault.points.clone());
    let drop = Field::scalar("stress_drop", "Pa", Sign::Slip, "fall of the shear traction in the event");
    let time =
        Field::scalar("rupture_time", "s", Sign::None, "time since the onset at which the point ruptured");
    let mut all = OnFault::new((plan, fault), path, FieldTimes::Events)
        .along(Field::scalar("slip", "m", Sign::Slip, "slip"), |event: &Event<Rupture>| {
            event.details.slip.all().to_vec()
        })
        .along(drop, |event| event.details.drop.all().to_vec())
        .with(time, reached);
    let peak = Field::scalar("largest_slip_rate", "m/s", Sign::Size, "largest slip rate in the event");
    let peak = all.placed(peak);
    all.series = all.series.with_some(peak, move |event| {
        Some(Data::from(event.details.front.peaks.get(points.clone())?.to_vec()))
    });
    if plan.problem.fault.law.components() > 1 {
        let field = Field::scalar("turned", "deg", Sign::None, "angle from the rake to the slip");
        all = all.with(field, |event, p| turned(event, p).unwrap_or(f64::NAN));
    }
    if fault.normal.opens {
        all = all.with(opening(), |event, p| event.details.change(&OPENING)[p]);
    }
    all.series
}

/// Time since the onset at which a point ruptured \[s\]; NaN where it did not.
pub(super) fn reached(event: &Event<Rupture>, point: usize) -> f64 {
    event.details.front.reached.get(point).copied().flatten().unwrap_or(f64::NAN)
}

/// Angle from the rake to the slip of a point, if slip may turn \[degrees\].
pub(super) fn turned(event: &Event<Rupture>, point: usize) -> Option<f64> {
    let slip = &event.details.slip;
    (slip.components() > 1).then(|| slip.component(1)[point].atan2(slip.component(0)[point]).to_degrees())
}
