//! Imbalance of initial stress, weight, loads and interfaces at the start.

use super::PlannedInterface;
use super::assembly::Assembly;
use crate::reading::diagnostic::Diagnostic;
use crate::shared::unbalance::{BALANCES, StressedStart, UnbalancedForce};
use asperity_contact::{Enforcement, Interface, PointFields};
use asperity_friction::law::{Law, Regime, Responses, Trials};
use asperity_mechanics::{Stage, contact_spec};
use asperity_run::Warning;

/// Hint at what may be missing.
const BEARS: &str = "interfaces bear the stress from the start with `initial_stress = true`";
/// Fraction of a shear traction that friction may remove before a point counts as slipping: rounding.
const HELD: f64 = 1e-9;

/// Initial state of an interface.
struct Start {
    /// Description for the plan.
    remark: String,
    /// True if friction does not hold all points.
    slips: bool,
}

/// Remarks on the start of bodies with an initial stress, and a warning if it is not in balance.
///
/// # Errors
/// [`Diagnostic`] for an interface that cannot be built.
pub fn remarks_and_warning<const D: usize>(
    assembly: &Assembly<'_, D>,
) -> Result<(Vec<String>, Option<Warning>), Diagnostic> {
    let Assembly { scene, model, stages, .. } = assembly;
    let Some(stage) = stages.first() else { return Ok((Vec::new(), None)) };
    let Some(StressedStart { given, stress, mut forces }) = StressedStart::find(scene, model, stage) else {
        return Ok((Vec::new(), None));
    };
    let mut remarks = Vec::new();
    let mut slips = false;
    for planned in &assembly.interfaces {
        if let Some(start) = pressed(assembly, planned, stage, &mut forces)? {
            slips |= start.slips;
            remarks.push(start.remark);
        }
    }
    let left = UnbalancedForce::largest(model, stage, &forces, stress);
    if left.is_rounding() {
        let until = if slips { " until friction gives way" } else { "" };
        remarks.push(format!(
            "initial stress, weight, loads at the start and interfaces are in balance to rounding{until}"
        ));
        return Ok((remarks, None));
    }
    let told = left.in_words(model);
    if !left.settles() {
        remarks.push(told);
        return Ok((remarks, None));
    }
    let message = format!("{told}, by {}: bodies move in the first step until they are", left.size(model));
    let bare = scene.interfaces.values().any(|i| i.initial_stress.is_none());
    let help = if bare { format!("{BEARS}; {BALANCES}") } else { BALANCES.into() };
    Ok((remarks, Some(Warning::at(given, message, help))))
}

/// Adds the forces of an interface that the initial stress presses, and describes its tractions.
fn pressed<const D: usize>(
    assembly: &Assembly<'_, D>,
    planned: &PlannedInterface,
    stage: &Stage,
    r: &mut [f64],
) -> Result<Option<Start>, Diagnostic> {
    let Assembly { scene, model, stepping, .. } = assembly;
    let Some(pressed) = &planned.pressed else { return Ok(None) };
    let number: Vec<usize> = (0..model.dofs()).collect();
    let mut declared = contact_spec::spec(model, stepping, planned, &number, 0.0, 0);
    declared.enforcement = Enforcement::Penalty;
    if stage.frictionless.contains(&planned.name) {
        declared.law = None;
    }
    let law = declared.law.clone();
    let mut built = Interface::new(declared).map_err(|e| {
        let slave = &scene.interfaces[&planned.name].slave;
        Diagnostic::at(slave.span(), e.to_string(), "see `slave` and `master`")
    })?;
    if let Some(by) = &planned.shift {
        built.shift(by);
    }
    built.press(&pressed.starts(), pressed.reach);
    built.exert(r);
    Ok(Some(Start::from_points(planned, law.as_deref(), built.points())))
}

impl Start {
    /// State of an interface from the tractions at its points, under a law if there is friction.
    fn from_points<const D: usize>(
        planned: &PlannedInterface,
        law: Option<&dyn Law>,
        points: &PointFields<D>,
    ) -> Self {
        let name = &planned.name;
        let bears: Vec<usize> = (0..points.gap.len()).filter(|&p| points.normal_traction[p] > 0.0).collect();
        let shear = |p: usize| points.shear[p].iter().map(|t| t * t).sum::<f64>().sqrt();
        let borne: Vec<(f64, f64)> = bears.iter().map(|&p| (points.normal_traction[p], shear(p))).collect();
        if borne.is_empty() {
            let remark = format!("interface `{name}`: the initial stress does not press it");
            return Self { remark, slips: false };
        }
        let (least, most) =
            borne.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), (f, _)| (a.min(*f), b.max(*f)));
        let ratio = borne.iter().map(|(f, t)| t / f).fold(0.0, f64::max);
        let mut remark = format!(
            "interface `{name}`: the initial stress presses {} of {} points with {least:.4e} to {most:.4e} Pa, and shears them by up to {ratio:.4} of that",
            borne.len(),
            points.gap.len()
        );
        let slips = law.map_or(0, |law| {
            let states = initial(law, &bears, points.gap.len());
            slipping(law, (&bears, &borne, &states), planned.tangential_penalty)
        });
        if slips > 0 {
            remark += &format!("; friction does not hold {slips} of them, which slip at once");
        }
        Self { remark, slips: slips > 0 }
    }
}

/// Initial states of some of the points of an interface.
fn initial(law: &dyn Law, points: &[usize], count: usize) -> Vec<f64> {
    let k = law.states();
    let mut all = vec![0.0; count * k];
    law.initial(&mut all);
    points.iter().flat_map(|p| all[p * k..(p + 1) * k].iter().copied()).collect()
}

/// Number of points whose shear traction exceeds the yield surface of the law.
fn slipping(law: &dyn Law, (points, borne, old): (&[usize], &[(f64, f64)], &[f64]), stiffness: f64) -> usize {
    if !law.has_elastic_domain() || law.bonded() {
        return 0;
    }
    let n = borne.len();
    let (normal, trial): (Vec<f64>, Vec<f64>) = borne.iter().copied().unzip();
    let mut states = old.to_vec();
    let mut out = vec![vec![0.0; n]; 5];
    let [traction, slip, rate, d_trial, d_normal] = out.as_mut_slice() else { return 0 };
    let mut regime = vec![Regime::Stick; n];
    let answers =
        Responses { traction, slip, rate, regime: &mut regime, d_trial, d_normal, states: &mut states };
    let (normal, trial) = (&normal[..], &trial[..]);
    let trials = Trials { points, normal, trial, stiffness, dt: 1.0, damping: 0.0, lag: None, near: None };
    if law.respond(trials, old, answers).is_err() {
        return 0;
    }
    out[0].iter().zip(trial).filter(|(t, e)| **t < **e * (1.0 - HELD)).count()
}
