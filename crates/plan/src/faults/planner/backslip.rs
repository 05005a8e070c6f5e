//! Loading by backslip: the points of a fault lag behind plates that move steadily.

use super::history::LoadHistory;
use super::placed_point::{PlacedPoint, components};
use crate::reading::scene::model::{Creep, Fault as Spec, Scene};
use asperity_cycles::operator::Operator;
use asperity_run::Warning;

/// Share of the force of backslip from which the motion of the sides along slip counts as that of the plates: a hundred times
/// the usual precision of given rates.
const DRIVES: f64 = 0.01;
/// Largest traction that backslip of a whole fault causes, over those of one point of it, which is rounding: a fault that cuts
/// its bodies apart, and sides that nothing holds.
const NOTHING: f64 = 1e-6;

/// Creep that loads a fault by backslip.
pub(crate) fn creep<'a>(scene: &Scene, spec: &'a Spec) -> Option<&'a Creep> {
    spec.creep.as_ref().filter(|creep| scene.medium.is_some() || creep.is_backslip())
}

/// Largest rate of plates behind which faults lag \[m/s\].
pub(crate) fn fastest(scene: &Scene) -> f64 {
    let rates = scene.faults.values().filter_map(|spec| creep(scene, spec)).map(|c| c.rate.get_ref().0.abs());
    rates.fold(0.0, f64::max)
}

/// Rates of the plates behind which points lag.
pub(super) struct PlateRates {
    /// Rates at all points, component by component \[m/s\]: zero on faults without backslip.
    pub rates: Vec<f64>,
    /// Number of components of slip.
    pub tangents: usize,
}

/// Rates of the plates at all points.
pub(super) fn plates<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    tangents: usize,
) -> PlateRates {
    let creeps: Vec<Option<&Creep>> = scene.faults.values().map(|spec| creep(scene, spec)).collect();
    let rates = placed
        .iter()
        .map(|p| creeps[p.fault].map_or([0.0; 2], |c| components(&p.point.place, c.rate.get_ref().0)));
    let rates: Vec<[f64; 2]> = rates.collect();
    let rates = (0..tangents).flat_map(|c| rates.iter().map(move |r| r[c])).collect();
    PlateRates { rates, tangents }
}

/// Notes on the load of faults by backslip.
pub(super) fn notes(scene: &Scene) -> Vec<String> {
    let loaded = scene.faults.iter().filter_map(|(name, spec)| Some((name, creep(scene, spec)?)));
    let note = |(name, creep): (&String, &Creep)| {
        format!(
            "fault `{name}` is loaded by backslip at {:e} m/s: tractions follow slip less the motion of the plates, so that normal tractions return where slip has caught up",
            creep.rate.get_ref().0
        )
    };
    loaded.map(note).collect()
}

/// Warning about sides of bodies that drive a fault along with its backslip, and about backslip that loads nothing. `sides` are
/// the loads without backslip, `deficit` those of backslip.
pub(super) fn doubts<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    operator: &dyn Operator,
    [sides, deficit]: [LoadHistory<'_>; 2],
) -> Option<Warning> {
    let means = [sides, deficit].map(|load| load.loading.mean(load.end, placed.len()));
    let mut faults = scene.faults.iter().enumerate();
    faults.find_map(|(k, (name, spec))| {
        let creep = creep(scene, spec)?;
        let own = || (0..placed.len()).filter(|&p| placed[p].fault == k);
        let force = |rates: &[f64]| own().map(|p| placed[p].point.place.area * rates[p]).sum::<f64>();
        let [by_sides, by_deficit] = [force(&means[0]), force(&means[1])];
        let largest = own().map(|p| means[1][p].abs()).fold(0.0, f64::max);
        let rate = creep.rate.get_ref().0;
        if largest <= NOTHING * rate.abs() * operator.stiffness().component(0)[own().next()?] {
            return Some(Warning::at(
                creep.rate.span(),
                format!("backslip loads fault `{name}` with nothing: it cuts its bodies apart, and their sides are free to follow"),
                "hold the sides that move with the plates along the slip, such as `z = 0`",
            ));
        }
        (by_sides * by_deficit > DRIVES * by_deficit * by_deficit).then(|| {
            Warning::at(
                creep.rate.span(),
                format!(
                    "the sides of the bodies drive fault `{name}` along with its backslip, by {:.3} of it: plates load the fault twice",
                    by_sides / by_deficit
                ),
                "hold the sides at rest along the slip, or leave `loading = \"backslip\"` out",
            )
        })
    })
}
