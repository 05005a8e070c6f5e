//! Plans a scene with faults: the problem to integrate and the method.

mod asked;
mod bends;
mod cover;
mod floor;
mod frame;
mod held;
mod medium;
mod meet;
mod meshed;
mod patches;
mod place;
mod placed;
mod plates;
mod prestress;
mod resolution;
mod rock;
mod sense;
mod start_doubts;
mod weight;

pub use place::places;
pub use resolution::{Ground, modulus, spacings};

use super::bodies::BodiesView;
use super::cadence::{self, Cadence};
use super::plan::{FaultView, Plan, PointView, Station};
use super::resolution::Resolution;
use crate::amounts;
use crate::diagnostic::Diagnostic;
use crate::forecast;
use crate::held::Held;
use crate::laws;
use crate::loading::{self, Stage};
use crate::model::{self, Model, meshes};
use crate::scene::law::LawChoice;
use crate::scene::model::{
    Creep, DampingSpec, Fault as Spec, Kinematics, Scene, SlipSpec, Station as Asking,
};
use crate::warning::Warning;
use asperity_cycles::medium::{
    Conditions, Loads, Place, Point, Refusal, Spring, Surroundings, Tractions, across, condense, least_bytes,
};
use asperity_cycles::operator::{Form, Geometry, Operator, in_form};
use asperity_cycles::{
    Crack, Fault, Floor, Injection, Layout, Loading, Opening, Pressure, Problem, Settings, Thresholds,
};
use asperity_friction::Failure;
use asperity_friction::evolution;
use asperity_friction::fault::FaultLaw;
use asperity_friction::turning::Turning;
use asperity_ode::{Clock, Method};
use held::Asked;
use medium::{Media, Medium};
use meshed::Meshed;
use placed::{Placed, components, in_space, slides};
use prestress::{Prestress, Resolved};
use std::ops::Range;

/// Default method. Among the explicit ones it needs the fewest evaluations for an error of 1e-5 of the recurrence time in the first events of BP1.
const DEFAULT_METHOD: Method = Method::Tsit5;
/// Default error of ln V in a step. It gives errors of about 1e-5 of the recurrence time in the onsets of BP1's first events. A tolerance ten times
/// larger saves a tenth to a sixth of the work, but steps then lie at the edge of the stability region, where errors of the fastest modes do not
/// average out: on cells of 25 m the slip of a cycle differed by 0.24 % from the imposed slip, and its duration by 0.1 %.
const DEFAULT_TOLERANCE: f64 = 1e-5;
/// Number of steps after which a run is stopped: a hundred times those of BP1 at full length.
const MOST_STEPS: usize = 20_000_000;
/// Default slip rate at which an event begins \[m/s\]. For rock under crustal stress, radiation damping begins to matter there.
const EVENT: f64 = 1e-3;
/// Default slip rate at which an event ends, over the rate at which it begins.
const EVENT_ENDS: f64 = 0.1;

/// Plans a scene whose stepper is "fault-ode".
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan(scene: &Scene) -> Result<Plan, Diagnostic> {
    plan_with(scene, Form::Fitting)
}

/// Plans such a scene with the operator in the given form.
///
/// # Errors
/// [`Diagnostic`] with the place in the scene.
pub fn plan_with(scene: &Scene, form: Form) -> Result<Plan, Diagnostic> {
    match scene.kinematics.get_ref() {
        Kinematics::Antiplane | Kinematics::PlaneStrain => plan_in::<2>(scene, form),
        Kinematics::ThreeD => plan_in::<3>(scene, form),
        other => Err(Diagnostic::at(
            scene.kinematics.span(),
            format!("faults in {} are not integrated yet", other.words()),
            "\"antiplane\", \"plane-strain\" and \"3d\" are",
        )),
    }
}

/// Refuses faults with so many points that the condensed operator alone exceeds the memory, before the cell matrices are computed.
fn admit<const D: usize>(asked: Asked<'_, D>, conditions: Conditions) -> Result<(), Diagnostic> {
    let points = asked.points;
    let free = points.iter().filter(|p| p.creep.is_none()).count();
    let opening = points.iter().filter(|p| p.creep.is_none() && p.opens).count();
    let needed = least_bytes(conditions.components, conditions.tangents, free, opening);
    forecast::fits(asked.scene, needed)?;
    if needed > conditions.memory {
        return Err(asked.error(&Refusal::Memory { needed, allowed: conditions.memory, points: free }));
    }
    Ok(())
}

/// Loads on the bodies during a stage.
fn loads<const D: usize>(model: &Model<D>, stage: &Stage) -> Loads {
    let spring = |s: &loading::Spring| Spring { dofs: s.dofs.clone(), stiffness: s.stiffness, rate: s.rate };
    Loads {
        constraints: stage.constraints(&vec![0.0; model.dofs()]),
        springs: stage.springs.iter().map(spring).collect(),
        weight: stage.weight.clone(),
        end: stage.end,
    }
}

/// Settings for the condensation of the bodies of a scene.
fn conditions(scene: &Scene, components: usize) -> Conditions {
    let keep = scene.output.bodies.as_ref().is_some_and(|b| *b.get_ref());
    let tangents = if turns(scene) { 2 } else { 1 };
    Conditions { components, tangents, memory: amounts::memory(scene), keep }
}

/// True if slip may turn. The scene check ensures that all faults have the same.
fn turns(scene: &Scene) -> bool {
    let free = |s: &Spec| s.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
    scene.faults.values().any(free)
}

fn plan_in<const D: usize>(scene: &Scene, form: Form) -> Result<Plan, Diagnostic> {
    match &scene.medium {
        Some(medium) => rock::plan::<D>(scene, medium, form),
        None => between_bodies::<D>(scene, form),
    }
}

/// Plans faults between bodies.
fn between_bodies<const D: usize>(scene: &Scene, form: Form) -> Result<Plan, Diagnostic> {
    let mut model = model::build::<D>(scene)?;
    if let Some(body) = model.bodies.iter().find(|b| b.nonlinear.is_some()) {
        return Err(asked::not_linear(scene, &body.name));
    }
    let stages = loading::stages(scene, &model)?;
    let [stage] = stages.as_slice() else {
        return Err(asked::stages(scene));
    };
    let mut warnings = scene.warnings.clone();
    let (placed, mut notes) = all_points(scene, &model, &mut warnings)?;
    let points: Vec<Point<D>> = placed.iter().map(|p| p.point.clone()).collect();
    let named: Vec<(&String, &Spec)> = scene.faults.iter().collect();
    if points.iter().all(|p| p.creep.is_some()) {
        return Err(asked::nothing_slides(&named, &placed));
    }
    // If weight acts, normal tractions are known only once the bodies are condensed.
    let early = if stage.weight.is_empty() { Some(resolved(scene, &placed, &mut warnings)?) } else { None };
    let held = Held::by(&model);
    let conditions = conditions(scene, model.idealisation.components());
    let loads = loads(&model, stage);
    admit(Asked { scene, model: &model, loads: &loads, points: &points }, conditions)?;
    let bodies = model.take_stiffness();
    let asked = Asked { scene, model: &model, loads: &loads, points: &points };
    let surroundings = condense(bodies, &loads, &points, conditions).map_err(|e| asked.error(&e))?;
    let (creeping, mut placed): (Vec<_>, Vec<_>) = placed.into_iter().partition(|p| p.point.creep.is_some());
    warnings.extend(doubts(scene, (&model, stage), (&placed, &creeping), &surroundings));
    notes.extend(weight::press(scene, (&model, stage), surroundings.weight.as_ref(), &mut placed)?);
    let resolution = early.map_or_else(|| resolved(scene, &placed, &mut warnings), Ok)?;
    if placed.is_empty() {
        return Err(asked::nothing_slides(&named, &creeping));
    }
    asked::opens(&named, &placed, surroundings.opening.as_ref().map_or(&[], |o| o.points()))?;
    let sides = placed.iter().map(|p| [p.point.place.minus, p.point.place.plus]).collect();
    let around = Around {
        medium: "condensed onto the faults",
        dofs: model.dofs(),
        creeping: creeping.len(),
        memory_bytes: held.with_faults(surroundings.bytes),
        bodies: surroundings.bodies.map(|bodies| BodiesView::new(bodies, &model, sides)),
        resolution,
        warnings,
        notes,
    };
    let surrounded = Surrounded {
        operator: operator(surroundings.operator, &placed, form),
        placed,
        opening: surroundings.opening,
        loading: surroundings.loading,
        end: stage.end,
    };
    plan_of(scene, surrounded, around, &Meshed { model: &model })
}

/// Points of faults that slide freely, and what acts on them.
struct Surrounded<const D: usize> {
    placed: Vec<Placed<D>>,
    operator: Box<dyn Operator>,
    opening: Option<Opening>,
    loading: Loading,
    end: f64,
}

/// Description of the surroundings of faults for the output.
struct Around {
    medium: &'static str,
    dofs: usize,
    creeping: usize,
    memory_bytes: usize,
    bodies: Option<BodiesView>,
    resolution: Vec<Resolution>,
    warnings: Vec<Warning>,
    notes: Vec<String>,
}

/// Cells of faults, whose corners or centres are their points.
trait Cells<const D: usize> {
    /// Largest extent of the cells at a point \[m\].
    fn size(&self, spec: &Spec, point: &Placed<D>) -> Result<f64, Diagnostic>;

    /// Faces between points that slide freely, by their numbers within the fault.
    fn faces(&self, fault: (usize, &Spec), placed: &[Placed<D>]) -> Result<Vec<Vec<usize>>, Diagnostic>;
}

/// Plan of faults from their points and surroundings.
fn plan_of<const D: usize>(
    scene: &Scene,
    surrounded: Surrounded<D>,
    around: Around,
    cells: &dyn Cells<D>,
) -> Result<Plan, Diagnostic> {
    let Surrounded { placed, operator, opening, loading, end } = surrounded;
    let named: Vec<(&String, &Spec)> = scene.faults.iter().collect();
    let at_law = |e: Failure| crate::refused::refused(&named[placed[0].fault].1.law, &e);
    let turns = turns(scene);
    let law = friction(&named, &placed, at_law)?;
    let law = if turns { Box::new(Turning::new(law)) } else { law };
    let fault = Fault {
        operator,
        law,
        damping: placed.iter().map(|p| p.damping).collect(),
        normal: placed.iter().map(|p| p.normal).collect(),
        pressure: pressure(scene, &placed)?,
        floor: Floor::new(placed.iter().map(|p| p.floor)),
        opening,
    };
    let start = start(&placed, &fault).map_err(at_law)?;
    let mut warnings = around.warnings;
    warnings.extend(start_doubts::check(scene, &placed, &fault));
    let (faults, points) = views(scene, cells, &placed, turns)?;
    let areas = placed.iter().map(|p| p.point.place.area).collect();
    Ok(Plan {
        title: scene.title.clone(),
        faults,
        points,
        cadence: cadence(scene, &fault, end),
        problem: Problem { fault, areas, loading, start, settings: settings(scene, end)? },
        medium: around.medium,
        dofs: around.dofs,
        creeping: around.creeping,
        memory_bytes: around.memory_bytes,
        bodies: around.bodies,
        frame: frame::of(scene, D == 3)?,
        in_space: D == 3,
        kinematics: scene.kinematics.get_ref().words(),
        resolution: around.resolution,
        warnings,
        notes: around.notes,
    })
}

/// Laws of all points, which are of one kind.
fn friction<const D: usize>(
    faults: &[(&String, &Spec)],
    placed: &[Placed<D>],
    at_law: impl Fn(Failure) -> Diagnostic,
) -> Result<Box<dyn FaultLaw>, Diagnostic> {
    let (first, rest) = (&placed[0], &placed[1..]);
    let spec = |p: &Placed<D>| &faults[p.fault].1.law;
    if let Some(other) = rest.iter().find(|p| !first.law.same_kind(&p.law)) {
        return Err(Diagnostic::at(
            spec(other).span(),
            "the faults have laws of different kinds",
            "one form, one evolution and as many states for all faults of a scene; parameters may differ",
        ));
    }
    let choices: Vec<LawChoice> = rest.iter().map(|p| p.law.clone()).collect();
    laws::build_fault(&first.law, &choices).map_err(at_law)?.ok_or_else(|| asked::another_law(spec(first)))
}

/// Warnings about the loading of faults by loads and creep; points either slide or creep.
fn doubts<const D: usize>(
    scene: &Scene,
    (model, stage): (&Model<D>, &Stage),
    (placed, creeping): (&[Placed<D>], &[Placed<D>]),
    surroundings: &Surroundings,
) -> Vec<Warning> {
    let mut all = sense::check(scene, (placed, creeping), &surroundings.loading, stage.end);
    if all.is_empty() {
        // One warning per cause.
        all.extend(plates::check(scene, (model, stage), (placed, creeping), surroundings));
    }
    all.extend(weight::hangs(scene, model, stage));
    all
}

/// Points of all faults, and notes on them.
fn all_points<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    warnings: &mut Vec<Warning>,
) -> Result<(Vec<Placed<D>>, Vec<String>), Diagnostic> {
    let mut placed: Vec<Placed<D>> = Vec::new();
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        placed.extend(points_of(scene, model, (name, spec), k, warnings)?);
    }
    let mut notes = meshes::notes(scene)?;
    for fault in &scene.faults {
        notes.extend(bends::note(model, (fault.0, fault.1))?);
    }
    notes.extend(meet::join(scene, model, &mut placed)?);
    Ok((placed, notes))
}

/// Resolution of each fault on which friction weakens.
fn resolved<const D: usize>(
    scene: &Scene,
    placed: &[Placed<D>],
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Resolution>, Diagnostic> {
    let mut all = Vec::new();
    for (fault, (name, spec)) in scene.faults.iter().enumerate() {
        let points = || placed.iter().filter(|p| p.fault == fault && p.point.creep.is_none());
        let weighs = scene.bodies.values().any(|b| b.gravity.is_some());
        warnings.extend(floor::above_start(name, spec, weighs, points().map(|p| p.normal)));
        let with_ground = points().map(|p| {
            let (law, modulus) = (&p.law, p.medium.stiffness);
            (&p.point.place, Ground { law, normal: p.pressed(), modulus, in_space: D == 3 }, p.spacing)
        });
        if let Some(found) = resolution::of_points(name, with_ground) {
            warnings.extend(resolution::check(&found, spec, D == 3)?);
            all.push(found);
        }
    }
    Ok(all)
}

/// Operator in the given form.
fn operator<const D: usize>(tractions: Tractions, placed: &[Placed<D>], form: Form) -> Box<dyn Operator> {
    let (places, areas, faults) = geometry(placed);
    in_form(tractions, &Geometry { places: &places, faults: &faults, areas: &areas }, form)
}

/// Positions and areas of points, and the points of each fault that has some.
fn geometry<const D: usize>(placed: &[Placed<D>]) -> (Vec<[f64; 3]>, Vec<f64>, Vec<Range<usize>>) {
    let places = placed.iter().map(|p| in_space(&p.point.place.at)).collect();
    let areas = placed.iter().map(|p| p.point.place.area).collect();
    let last = placed.last().map_or(0, |p| p.fault);
    let first = |fault: usize| placed.partition_point(|p| p.fault < fault);
    let faults = (0..=last).map(|f| first(f)..first(f + 1)).filter(|r| !r.is_empty()).collect();
    (places, areas, faults)
}

fn points_of<const D: usize>(
    scene: &Scene,
    model: &Model<D>,
    (name, spec): (&str, &Spec),
    fault: usize,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<Placed<D>>, Diagnostic> {
    let base = base_law(spec)?;
    let mut placed = Vec::new();
    let media = Media::new(scene, model, spec)?;
    let spacings = resolution::spacings(model, model::sides(model, &spec.minus)?);
    let stress = Prestress::new(scene, (name, spec));
    let weighs = scene.bodies.values().any(|b| b.gravity.is_some());
    let (places, doubtful) = place::places(model, name, spec)?;
    warnings.extend(doubtful);
    for place in places {
        let creep = spec.creep.as_ref().filter(|c| creeps(c, &place, CLOSE * model.scale));
        let given = stress.as_ref().filter(|_| creep.is_none());
        let given = Given {
            medium: media.at(&place),
            spacing: spacings.get(&place.minus).copied().unwrap_or_default(),
            stress: given.map(|s| s.start(model, &place, weighs)).transpose()?,
            creep: creep.map(|c| c.rate.get_ref().0),
            components: model.idealisation.components(),
        };
        placed.push(placed_at(spec, (fault, &base), place, given)?);
    }
    asked::creep((name, spec), &placed)?;
    asked::profiles((name, spec), &placed, warnings);
    warnings.extend(patches::covered((name, spec), &placed)?);
    Ok(placed)
}

/// Law of a fault, whose parameters may vary along it.
fn base_law(spec: &Spec) -> Result<LawChoice, Diagnostic> {
    let law = laws::choose(&spec.law).map_err(|errors| {
        let first = errors.into_iter().next();
        first.unwrap_or_else(|| asked::incomplete(&spec.law))
    })?;
    patches::fit(spec, &law)?;
    Ok(law)
}

/// Surroundings of a point.
struct Given {
    medium: Medium,
    /// Distance to the farthest neighbour \[m\].
    spacing: f64,
    /// Tractions of the initial stress of bodies.
    stress: Option<Resolved>,
    /// Creep rate \[m/s\].
    creep: Option<f64>,
    /// Number of components of displacement.
    components: usize,
}

/// A point of a fault with its law and initial tractions.
fn placed_at<const D: usize>(
    spec: &Spec,
    (fault, base): (usize, &LawChoice),
    place: Place<D>,
    given: Given,
) -> Result<Placed<D>, Diagnostic> {
    let choice = floor::choice(spec);
    let values = patches::values(spec, &place, base);
    Ok(Placed {
        fault,
        medium: given.medium,
        damping: damping(spec, &given.medium)?,
        // The scene check ensures that one of them is given; where the fault creeps, neither is needed.
        normal: given.stress.and_then(|g| g.normal).or(values.normal).unwrap_or_default(),
        shear: given.stress.map(|g| g.shear).or(values.shear),
        rate: values.rate,
        prestress: given.stress.unwrap_or_default(),
        spacing: given.spacing,
        floor: choice.floor,
        law: values.law(base),
        creep: given.creep,
        components: given.components,
        point: Point {
            creep: given.creep.map(|rate| components(&place, rate)),
            normal_changes: choice.changes,
            opens: choice.opens,
            place,
        },
    })
}

/// Distance from the boundary of the creeping part within which a point counts as on it, relative to the size of the
/// model: rounding.
const CLOSE: f64 = 1e-12;

/// True if slip is prescribed at a point; includes points within `close` \[m\] of the boundary.
fn creeps<const D: usize>(creep: &Creep, place: &Place<D>, close: f64) -> bool {
    if let Some(beyond) = &creep.beyond {
        return place.along >= beyond.get_ref().0 - close;
    }
    let ranges = creep.outside.as_ref().map(|o| o.get_ref().ranges()).unwrap_or_default();
    place.at.iter().zip(ranges).any(|(x, range)| {
        let (from, to) = range.map_or((None, None), |r| (r.from, r.to));
        from.is_some_and(|l| *x <= l.0 + close) || to.is_some_and(|l| *x >= l.0 - close)
    })
}

/// Radiation damping η at a point \[Pa s/m\].
fn damping(spec: &Spec, medium: &Medium) -> Result<f64, Diagnostic> {
    let Some(given) = &spec.damping else { return Ok(0.0) };
    match given.get_ref() {
        DampingSpec::Value(value) => Ok(*value),
        DampingSpec::Radiation => medium.radiation.ok_or_else(|| {
            Diagnostic::at(
                given.span(),
                "radiation damping needs the density of the materials at the fault",
                "add `density = \"2670 kg/m^3\"` to them, or give the damping in Pa s/m",
            )
        }),
    }
}

/// Pressure of the injected fluid.
fn pressure<const D: usize>(scene: &Scene, placed: &[Placed<D>]) -> Result<Option<Pressure>, Diagnostic> {
    let mut pressure: Option<Pressure> = None;
    for (fault, (name, spec)) in scene.faults.iter().enumerate() {
        let Some(injection) = &spec.injection else { continue };
        let points = placed.iter().filter(|p| p.fault == fault);
        let at = injection.at.get_ref().0;
        let along: Vec<f64> = points.map(|p| p.point.place.along).collect();
        let (least, most) = along.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), s| (l.min(*s), m.max(*s)));
        if !(least <= at && at <= most) {
            return Err(Diagnostic::at(
                injection.at.span(),
                format!("fault `{name}` does not slide at {at} m along it, where fluid is injected"),
                format!("it slides from {least} to {most} m"),
            ));
        }
        let until = injection.until.as_ref().map_or(f64::INFINITY, |t| t.get_ref().0);
        let injected = Injection {
            flux: injection.flux.get_ref().0,
            diffusivity: *injection.diffusivity.get_ref(),
            porosity: *injection.porosity.get_ref(),
            compressibility: *injection.compressibility.get_ref(),
            during: [0.0, until],
        };
        let first = placed.partition_point(|p| p.fault < fault);
        let distances = along.iter().map(|s| s - at).collect();
        pressure.get_or_insert_default().add(injected, first, distances);
    }
    Ok(pressure)
}

/// Initial unknowns: every point slides at its initial rate.
fn start<const D: usize>(placed: &[Placed<D>], fault: &Fault) -> Result<Vec<f64>, Failure> {
    let layout = Layout::of(fault);
    let n = fault.law.states();
    let mut y = vec![0.0; layout.size()];
    if !layout.normal().is_empty() {
        let normal = layout.normal();
        y[normal].iter_mut().zip(placed).for_each(|(f, point)| *f = point.normal);
    }
    let pressed = fault.pressed(Clock::new(0.0, 0.0), &y, &mut Crack::default());
    for (p, point) in placed.iter().enumerate() {
        let rate = point.rate;
        let states = layout.states().start + p * n..layout.states().start + (p + 1) * n;
        let initial = match &point.law {
            LawChoice::RateAndState { v_initial, .. } => *v_initial,
            _ => rate.abs(),
        };
        let law: &dyn FaultLaw = fault.law.as_ref();
        law.steady(p, initial.ln(), &mut y[states.clone()]);
        if let Some(shear) = point.shear {
            // Friction is odd in the slip rate, so its magnitude is found for a positive rate.
            let mu = (shear - fault.damping[p] * rate) * rate.signum() / pressed.normal[p];
            law.states_for(p, rate.abs(), mu, &mut y[states.clone()])?;
            y[p] = mu * rate.signum() / law.scale(p);
        } else {
            y[p] = law.at_rate(p, rate, &y[states])?;
        }
    }
    Ok(y)
}

fn settings(scene: &Scene, end: f64) -> Result<Settings, Diagnostic> {
    let time = &scene.time;
    let method = match &time.method {
        None => DEFAULT_METHOD,
        Some(name) => match name.get_ref().parse::<Method>() {
            Ok(method) if Method::EXPLICIT.contains(&method) => method,
            _ => {
                let those = Method::EXPLICIT.map(|m| format!("\"{}\"", m.name())).join(", ");
                return Err(Diagnostic::at(
                    name.span(),
                    format!("the method \"{}\" does not integrate faults", name.get_ref()),
                    format!("those without a Jacobian do: {those}"),
                ));
            }
        },
    };
    let events = scene.events.as_ref();
    let on = events.map_or(EVENT, |e| e.above.get_ref().0);
    let off = events.and_then(|e| e.below.as_ref()).map_or(EVENT_ENDS * on, |b| b.get_ref().0);
    Ok(Settings {
        method,
        tolerance: time.log_rate_tolerance.as_ref().map_or(DEFAULT_TOLERANCE, |t| *t.get_ref()),
        end,
        thresholds: Thresholds { on, off },
        most_events: events.and_then(|e| e.stop_after.as_ref()).map(|n| *n.get_ref()),
        most_steps: MOST_STEPS,
    })
}

/// Cadence of the output.
fn cadence(scene: &Scene, fault: &Fault, end: f64) -> Cadence {
    let lengths = (0..fault.law.points()).filter_map(|p| fault.law.length(p));
    let on = scene.events.as_ref().map_or(EVENT, |e| e.above.get_ref().0);
    let output = &scene.output;
    let asked = output.cadence.as_ref().map(|c| c.get_ref());
    let asked = cadence::Asked {
        decades: asked.and_then(|c| c.decades.as_ref()).map(|d| *d.get_ref()),
        slip: asked.and_then(|c| c.slip.as_ref()).map(|s| s.get_ref().0),
        longest: asked.and_then(|c| c.longest.as_ref()).map(|t| t.get_ref().0),
        shortest: asked.and_then(|c| c.shortest.as_ref()).map(|t| t.get_ref().0),
        contours: output.contours.as_ref().map(|c| [c.get_ref()[0].0, c.get_ref()[1].0]),
        largest_file: output.largest_file.as_ref().map(|m| m.get_ref().0),
    };
    Cadence::new(asked, end, on, lengths.reduce(f64::min))
}

/// Relation of θ to the state variable of a law with one state.
fn theta(law: &LawChoice) -> Option<(f64, f64)> {
    let LawChoice::RateAndState { strength, evolution, states, .. } = law else { return None };
    let [state] = states.as_slice() else { return None };
    evolution::definition(evolution.name)?.variable.theta(state.b, state.l, strength.v_ref)
}

/// Faults and points, as needed by the output.
fn views<const D: usize>(
    scene: &Scene,
    cells: &dyn Cells<D>,
    placed: &[Placed<D>],
    turns: bool,
) -> Result<(Vec<FaultView>, Vec<PointView>), Diagnostic> {
    let points: Vec<PointView> = placed
        .iter()
        .map(|p| {
            let place = &p.point.place;
            let (at, normal): ([f64; 3], [f64; 3]) = (in_space(&place.at), in_space(&place.normal));
            let slides = slides(p);
            let (along, area, theta) = (place.along, place.area, theta(&p.law));
            let shear_modulus = p.medium.shear_modulus;
            PointView {
                at,
                along,
                normal,
                slides,
                across: turns.then(|| across(&normal, &slides)),
                area,
                shear_modulus,
                theta,
            }
        })
        .collect();
    let mut faults = Vec::new();
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        let first = placed.partition_point(|p| p.fault < k);
        let last = placed.partition_point(|p| p.fault <= k);
        let asked = scene.output.stations.get(name);
        let off = |p: usize, s: &Asking| match s {
            Asking::Along(s) => (points[p].along - s).abs(),
            Asking::At(at) => at.iter().zip(&points[p].at).map(|(a, b)| (a - b).powi(2)).sum(),
        };
        let nearest = |s: &Asking| (first..last).min_by(|&a, &b| off(a, s).total_cmp(&off(b, s)));
        let mut stations = Vec::new();
        for asked in asked.iter().flat_map(|a| a.get_ref()) {
            let Some(point) = nearest(asked.get_ref()) else { continue };
            let size = cells.size(spec, &placed[point])?;
            asked::station(name, asked, (&placed[first..last], point - first), size)?;
            let station = match asked.get_ref() {
                Asking::Along(s) => Station::Along(*s),
                Asking::At(at) => Station::At(at.clone()),
            };
            stations.push((station, point));
        }
        faults.push(FaultView {
            name: name.clone(),
            points: first..last,
            normal: floor::choice(spec),
            stations,
            faces: cells.faces((k, spec), &placed[first..last])?,
        });
    }
    Ok((faults, points))
}
