//! The plan of faults from their points and what surrounds them.

use super::super::bodies::BodiesView;
use super::super::cadence::{self, Cadence};
use super::super::plan::{FaultView, Plan, PointView, Station};
use super::super::receivers::Receivers;
use super::super::sampling::Sampling;
use super::super::stresses::BodyStresses;
use super::cells::Cells;
use super::history::LoadHistory;
use super::placed_point::{PlacedPoint, components, in_space, slides};
use super::pulses::{self, pulses};
use super::remarks::Remarks;
use super::{
    checks, diffusion, floor, heat, injection, pressing, radiation, requests, sense, start_doubts, steady,
    up_direction,
};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::law::LawChoice;
use crate::reading::scene::model::{Creep, Fault as Spec, Scene, SlipSpec, Station as Asking};
use crate::shared::checks::{Checks, Cost, FaultCheck, rates};
use crate::shared::entry::Entry;
use crate::shared::law_errors::refused;
use crate::shared::resolution::Resolution;
use crate::shared::{place, rate_bound, thresholds};
use asperity_cycles::diffusion::Diffusion;
use asperity_cycles::heat::Heat;
use asperity_cycles::medium::across;
use asperity_cycles::operator::Operator;
use asperity_cycles::{Fault, Floor, Layout, Loading, Opening, Problem, Processes, Pulse, Settings};
use asperity_friction::Failure;
use asperity_friction::fault::FaultLaw;
use asperity_friction::rake::VariableRake;
use asperity_laws::{self as laws, Theta};
use asperity_mechanics::coordinates;
use asperity_ode::{Clock, Method};
use asperity_run::Warning;
use asperity_scene::defaults;
use std::ops::Range;

/// Default method and error of ln V in a step, in the plane. Among the explicit methods it needs the fewest evaluations for an error of 1e-5 of the
/// recurrence time in the onsets of BP1's first events. A tolerance ten times larger saves a tenth to a sixth of the work, but steps then lie at
/// the edge of the stability region, where errors of the fastest modes do not average out: on cells of 25 m the slip of a cycle differed by
/// 0.24 % from the imposed slip, and its duration by 0.1 %.
const IN_THE_PLANE: (Method, f64) = (Method::Tsit5, defaults::LOG_RATE);

/// Default method and error of ln V in space, where stability limits most steps between events. Intervals of BP5 have errors of 7e-6 from it,
/// hundreds of times below those of the cells, and a run with cells of 0.5 km takes half of the evaluations.
const IN_SPACE: (Method, f64) = (Method::Stabilised, defaults::LOG_RATE_IN_SPACE);

/// Number of steps after which a run is stopped: a hundred times those of BP1 at full length.
const MOST_STEPS: usize = 20_000_000;

/// Points of faults that slide freely, and what acts on them.
pub(super) struct SlidingFaults<const D: usize> {
    pub placed: Vec<PlacedPoint<D>>,
    pub operator: Box<dyn Operator>,
    pub opening: Option<Opening>,
    pub loading: Loading,
    pub end: f64,
}

/// Description of the surroundings of faults for the output.
pub(super) struct SurroundingsView {
    pub medium: &'static str,
    pub dofs: usize,
    pub creeping: usize,
    pub memory_bytes: usize,
    pub bodies: Option<BodiesView>,
    pub sampling: Option<Sampling>,
    pub stresses: Option<BodyStresses>,
    pub resolution: Vec<Resolution>,
    pub remarks: Remarks,
    /// Checks of the bodies.
    pub checks: Checks,
    /// Number of points of each fault that do not slide by their law.
    pub prescribed: Vec<usize>,
    /// Stiffness of the springs that drive each fault, if there are any \[Pa/m\].
    pub machines: Vec<Option<f64>>,
    /// Largest rate at which stages and plates move anything \[m/s\].
    pub loading: f64,
}

/// True if slip may turn. The scene check ensures that all faults have the same.
pub(super) fn turns(scene: &Scene) -> bool {
    let free = |s: &Spec| s.slip.as_ref().is_some_and(|s| *s.get_ref() == SlipSpec::Free);
    scene.faults.values().any(free)
}

/// Number of components of slip.
pub(super) fn tangents(scene: &Scene) -> usize {
    if turns(scene) { 2 } else { 1 }
}

/// Refusal of the law or the start of a point, with its place.
fn at_point<const D: usize>(
    named: &[Entry<'_, Spec>],
    point: &PlacedPoint<D>,
    failure: &Failure,
) -> Diagnostic {
    let Entry { name, spec } = named[point.fault];
    let error = refused(&spec.law, failure);
    let at = coordinates::in_words(&point.point.place.at);
    let place = failure.point().map_or_else(String::new, |_| format!("; it is on fault `{name}` at {at}"));
    Diagnostic { message: format!("{}{place}", error.message), ..error }
}

/// Faults with all that acts on them, at their start.
struct FaultSystem<const D: usize> {
    placed: Vec<PlacedPoint<D>>,
    problem: Problem,
    /// Memory of the modes of heat \[bytes\].
    heat_bytes: usize,
    /// Memory of the responses to wells \[bytes\].
    diffusion_bytes: usize,
}

impl<const D: usize> FaultSystem<D> {
    /// Adds remarks on its processes.
    fn new(scene: &Scene, surrounded: SlidingFaults<D>, remarks: &mut Remarks) -> Result<Self, Diagnostic> {
        let SlidingFaults { placed, operator, opening, loading, end } = surrounded;
        let named = Entry::all(&scene.faults);
        let mut law = friction(&named, &placed)?;
        if turns(scene) {
            law = Box::new(VariableRake::new(law));
        }
        let heat = heat::heat(scene, &placed, law.as_mut(), end);
        let heat_bytes = heat.as_ref().map_or(0, Heat::bytes);
        let pulses = pulses(&named, &placed, tangents(scene))?;
        let injection = injection::injection(scene, &placed, end, &mut remarks.warnings)?;
        let diffusion = diffusion::diffusion(scene, &placed, end, remarks)?;
        let diffusion_bytes = diffusion.as_ref().map_or(0, Diffusion::bytes);
        let fault = Fault {
            operator,
            law,
            damping: placed.iter().map(|p| p.damping).collect(),
            normal: placed.iter().map(|p| p.normal).collect(),
            processes: Processes::default()
                .and(pulses.into_iter().map(|(amplitude, rise)| Pulse { amplitude, rise }))
                .and(injection)
                .and(diffusion)
                .and(heat)
                .and(opening)
                .and(Floor::new(placed.iter().map(|p| p.floor))),
        };
        let start = start(&placed, &fault).map_err(|(p, failure)| at_point(&named, &placed[p], &failure))?;
        let settings = settings(scene, &placed, end)?;
        let problem = Problem {
            fault,
            areas: placed.iter().map(|p| p.point.place.area).collect(),
            loading,
            start,
            settings,
        };
        Ok(Self { placed, problem, heat_bytes, diffusion_bytes })
    }
}

/// Plan of faults from their points and surroundings.
pub(super) fn plan_of<const D: usize>(
    scene: &Scene,
    surrounded: SlidingFaults<D>,
    around: SurroundingsView,
    cells: &dyn Cells<D>,
) -> Result<Plan, Diagnostic> {
    let mut remarks = around.remarks;
    let system = FaultSystem::new(scene, surrounded, &mut remarks)?;
    let FaultSystem { placed, problem, .. } = &system;
    pressing::rests(scene, placed, problem)?;
    doubt(scene, &system, around.loading, &mut remarks.warnings)?;
    remarks.warnings.extend(steady::starts(scene, placed, problem));
    let (faults, points) = views(scene, cells, placed, turns(scene))?;
    let cadence = cadence(scene, &problem.fault, problem.settings.end);
    let mut checks = around.checks;
    checks.faults = checks::faults(scene, placed, &faults, &around.resolution);
    checks::prescribe(&mut checks.faults, &around.prescribed);
    crate::doubts::add(&mut remarks.warnings, checks::small_patches(scene, &checks.faults));
    add_loads(&mut checks.faults, scene, &system, &around.machines);
    let memory_bytes = around.memory_bytes + system.heat_bytes + system.diffusion_bytes;
    let moved = problem.fault.operator.moved() + system.heat_bytes;
    checks.cost = Cost {
        memory_bytes: Some(memory_bytes),
        step_seconds: Some(rates::fault_step(problem.settings.method, placed.len(), moved)),
        largest_file: Some(cadence.largest_file),
        ..Cost::default()
    };
    Ok(Plan {
        title: scene.title.clone(),
        faults,
        points,
        cadence,
        event_files: scene.output.event_files.as_ref().map_or(defaults::EVENT_FILES, |n| *n.get_ref()),
        problem: system.problem,
        ruptures: None,
        receivers: Receivers::default(),
        free_surface: None,
        coulomb: None,
        platform: None,
        slow: thresholds::slow(scene.events.as_ref()),
        up: place::up(scene),
        medium: around.medium,
        dofs: around.dofs,
        creeping: around.creeping,
        memory_bytes,
        bodies: around.bodies,
        sampling: around.sampling,
        stresses: around.stresses,
        frame: place::frame(scene, D == 3)?,
        in_space: D == 3,
        kinematics: scene.kinematics.get_ref().words(),
        resolution: around.resolution,
        warnings: remarks.warnings,
        notes: remarks.notes,
        checks,
    })
}

/// Adds doubts of the start of faults, of their pulses and their damping under loads of this rate \[m/s\].
fn doubt<const D: usize>(
    scene: &Scene,
    FaultSystem { placed, problem: Problem { fault, settings, .. }, .. }: &FaultSystem<D>,
    rate: f64,
    warnings: &mut Vec<Warning>,
) -> Result<(), Diagnostic> {
    let named = Entry::all(&scene.faults);
    warnings.extend(pressing::unused_rates(scene, placed));
    crate::doubts::add(warnings, start_doubts::check(scene, placed, fault));
    warnings.extend(up_direction::above_ground(scene, placed)?);
    let amplitudes = fault.processes.each::<Pulse>().map(|p| p.amplitude.as_slice());
    crate::doubts::add(warnings, pulses::doubts(&named, amplitudes, &pulses::at_rest(fault), settings.end));
    crate::doubts::add(warnings, endless(scene, rate));
    crate::doubts::add(warnings, radiation::doubts(scene, placed));
    Ok(())
}

/// Adds the rate of loading and the machine of each fault to its checks; `machines` has the stiffness of springs at each fault.
fn add_loads<const D: usize>(
    checks: &mut [FaultCheck],
    scene: &Scene,
    FaultSystem { placed, problem, .. }: &FaultSystem<D>,
    machines: &[Option<f64>],
) {
    let history = LoadHistory { loading: &problem.loading, end: problem.settings.end };
    for (k, (check, spec)) in checks.iter_mut().zip(scene.faults.values()).enumerate() {
        let sense = spec.rate.get_ref().0.signum();
        check.loading = sense::first_rate(placed, k, history).map(|rate| rate * sense);
        let springs = machines.get(k).copied().flatten();
        check.machine = springs.map(|stiffness| checks::machine(stiffness, k, placed));
    }
}

/// Laws of all points, which are of one kind.
fn friction<const D: usize>(
    faults: &[Entry<'_, Spec>],
    placed: &[PlacedPoint<D>],
) -> Result<Box<dyn FaultLaw>, Diagnostic> {
    let (first, rest) = (&placed[0], &placed[1..]);
    let spec = |p: &PlacedPoint<D>| &faults[p.fault].spec.law;
    if let Some(other) = rest.iter().find(|p| !first.law.same_kind(&p.law)) {
        return Err(Diagnostic::at(
            spec(other).span(),
            "the faults have laws of different kinds",
            "one form, one evolution and as many states for all faults of a scene; parameters may differ",
        ));
    }
    let choices: Vec<LawChoice> = rest.iter().map(|p| p.law.clone()).collect();
    let law = laws::build_fault(&first.law, &choices).map_err(|e| refused(spec(first), &e))?;
    law.ok_or_else(|| requests::another_law(spec(first)))
}

/// Positions and areas of points, and the points of each fault that has some.
pub(super) fn geometry<const D: usize>(
    placed: &[PlacedPoint<D>],
) -> (Vec<[f64; 3]>, Vec<f64>, Vec<Range<usize>>) {
    let places = placed.iter().map(|p| in_space(&p.point.place.at)).collect();
    let areas = placed.iter().map(|p| p.point.place.area).collect();
    let last = placed.last().map_or(0, |p| p.fault);
    let first = |fault: usize| placed.partition_point(|p| p.fault < fault);
    let faults = (0..=last).map(|f| first(f)..first(f + 1)).filter(|r| !r.is_empty()).collect();
    (places, areas, faults)
}

/// Initial unknowns: every point slides at its initial rate.
fn start<const D: usize>(placed: &[PlacedPoint<D>], fault: &Fault) -> Result<Vec<f64>, (usize, Failure)> {
    let layout = Layout::from_fault(fault);
    let n = fault.law.states();
    let mut y = vec![0.0; layout.size()];
    if !layout.normal().is_empty() {
        let normal = layout.normal();
        y[normal].iter_mut().zip(placed).for_each(|(f, point)| *f = point.normal);
    }
    let pressed = fault.pressed(Clock::new(0.0, 0.0), &y);
    for (p, point) in placed.iter().enumerate() {
        let rate = point.rate;
        let states = layout.states().start + p * n..layout.states().start + (p + 1) * n;
        let initial = match &point.law {
            LawChoice::RateAndState { v_initial, .. } => *v_initial,
            _ => rate.abs(),
        };
        let law: &dyn FaultLaw = fault.law.as_ref();
        law.steady(p, initial.ln(), &mut y[states.clone()]);
        if let Some(state) = point.state {
            y[states.start] = state;
        }
        if let Some(shear) = point.pressed_shear {
            // The traction of damping at the slip rate that follows is left out: it is small, or the start is refused.
            let scale = law.scale(p) * pressed.normal[p];
            for (component, shear) in shear.into_iter().take(layout.components()).enumerate() {
                y[component * layout.points() + p] = shear / scale;
            }
        } else if let Some(shear) = point.shear {
            // Friction is odd in the slip rate, so its magnitude is found for a positive rate.
            let mu = (shear - fault.damping[p] * rate) * rate.signum() / pressed.normal[p];
            law.states_for(p, rate.abs(), mu, &mut y[states.clone()]).map_err(|e| (p, e))?;
            y[p] = mu * rate.signum() / law.scale(p);
        } else {
            y[p] = law.at_rate(p, rate, &y[states]).map_err(|e| (p, e))?;
        }
    }
    Ok(y)
}

/// Method and tolerance of ln V of a scene in D dimensions. A method other than the default one has the tolerance of the plane, unless the scene
/// gives one.
fn integrator<const D: usize>(scene: &Scene) -> Result<(Method, f64), Diagnostic> {
    let time = &scene.time;
    let tolerance = time.log_rate_tolerance.as_ref().map(|t| *t.get_ref());
    let usual = if D == 3 && !heat::any(scene) { IN_SPACE } else { IN_THE_PLANE };
    let (method, default) = match &time.method {
        None => usual,
        Some(name) => match name.get_ref().parse::<Method>() {
            Ok(method) if Method::EXPLICIT.contains(&method) => {
                (method, if method == usual.0 { usual.1 } else { IN_THE_PLANE.1 })
            }
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
    Ok((heat::method(scene, method)?, tolerance.unwrap_or(default)))
}

fn settings<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    end: f64,
) -> Result<Settings, Diagnostic> {
    let (method, tolerance) = integrator::<D>(scene)?;
    let events = scene.events.as_ref();
    let thresholds = thresholds::from_spec(events);
    Ok(Settings {
        method,
        tolerance,
        end,
        thresholds,
        rupture_rate: rupture_rate(scene, thresholds.on)?,
        most_events: events.and_then(|e| e.stop_after.as_ref()).map(|n| *n.get_ref()),
        most_steps: MOST_STEPS,
        fastest: rate_bound::bound(placed.iter().map(|p| p.medium.waves)),
    })
}

/// Warnings about events that do not end, as `loading` or creep keep up the slip rate that ends them \[m/s\].
fn endless(scene: &Scene, loading: f64) -> Vec<Warning> {
    let Some(events) = scene.events.as_ref() else { return Vec::new() };
    let creeps = scene.faults.values().filter_map(|f| f.creep.as_ref());
    let fastest = creeps.map(|c| c.rate.get_ref().0.abs()).fold(loading, f64::max);
    let usual = crate::doubts::thresholds(events, thresholds::from_spec(Some(events)), fastest, false);
    let slow =
        thresholds::slow(Some(events)).and_then(|t| crate::doubts::thresholds(events, t, fastest, true));
    // One warning per cause: the rate of the loads.
    usual.or(slow).into_iter().collect()
}

/// Slip rate at which a point has ruptured \[m/s\]; events begin at the slip rate `on`.
fn rupture_rate(scene: &Scene, on: f64) -> Result<f64, Diagnostic> {
    let Some(given) = &scene.output.rupture_rate else { return Ok(defaults::RUPTURED.max(on)) };
    let rate = given.get_ref().0;
    if rate < on {
        return Err(Diagnostic::at(
            given.span(),
            format!("points would rupture at {rate:e} m/s, before their event begins at {on:e} m/s"),
            "`rupture_rate` at least as large as `above` of `[events]`",
        ));
    }
    Ok(rate)
}

/// Cadence of the output.
fn cadence(scene: &Scene, fault: &Fault, end: f64) -> Cadence {
    let lengths = (0..fault.law.points()).filter_map(|p| fault.law.length(p));
    let on = thresholds::from_spec(scene.events.as_ref()).on;
    let output = &scene.output;
    let asked = output.cadence.as_ref().map(|c| c.get_ref());
    let asked = cadence::CadenceLimits {
        decades: asked.and_then(|c| c.decades.as_ref()).map(|d| *d.get_ref()),
        slip: asked.and_then(|c| c.slip.as_ref()).map(|s| s.get_ref().0),
        longest: asked.and_then(|c| c.longest.as_ref()).map(|t| t.get_ref().0),
        shortest: asked.and_then(|c| c.shortest.as_ref()).map(|t| t.get_ref().0),
        contours: output.contours.as_ref().map(|c| [c.get_ref()[0].0, c.get_ref()[1].0]),
        largest_file: output.largest_file.as_ref().map(|m| m.get_ref().0),
    };
    Cadence::new(asked, end, on, lengths.reduce(f64::min))
}

/// Faults and points, as needed by the output.
pub(crate) fn views<const D: usize>(
    scene: &Scene,
    cells: &dyn Cells<D>,
    placed: &[PlacedPoint<D>],
    turns: bool,
) -> Result<(Vec<FaultView>, Vec<PointView>), Diagnostic> {
    let creeps: Vec<Option<&Creep>> = scene.faults.values().map(|spec| spec.creep.as_ref()).collect();
    let points: Vec<PointView> = placed.iter().map(|p| point_view(p, creeps[p.fault], turns)).collect();
    let mut faults = Vec::new();
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        let first = placed.partition_point(|p| p.fault < k);
        let last = placed.partition_point(|p| p.fault <= k);
        let asked = scene.output.stations.get(name);
        let off = |p: &PointView, s: &Asking| match s {
            Asking::Along(s) => (p.along - s).abs(),
            Asking::At(at) => at.iter().zip(&p.at).map(|(a, b)| (a - b).powi(2)).sum(),
        };
        let nearest =
            |s: &Asking| (first..last).min_by(|&a, &b| off(&points[a], s).total_cmp(&off(&points[b], s)));
        let mut stations = Vec::new();
        for asked in asked.iter().flat_map(|a| a.get_ref()) {
            let Some(point) = nearest(asked.get_ref()) else { continue };
            let size = cells.size(spec, &placed[point])?;
            if requests::distance(asked.get_ref(), &placed[point].point.place) > size {
                return Err(requests::station(name, asked, &placed[first..last], point - first));
            }
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
            heat: heat::view(spec, &placed[first..last]),
            stations,
            faces: cells.faces(k, spec, &placed[first..last])?,
            outline: cells.outline(k),
            grid: cells.grid(k),
        });
    }
    Ok((faults, points))
}

/// A point, as needed by the output, of a fault that creeps beyond it where `creep` is given.
fn point_view<const D: usize>(p: &PlacedPoint<D>, creep: Option<&Creep>, turns: bool) -> PointView {
    let place = &p.point.place;
    let (normal, slides) = (in_space(&place.normal), slides(p));
    let plate = creep.map(|creep| components(place, creep.rate.get_ref().0));
    PointView {
        at: in_space(&place.at),
        along: place.along,
        normal,
        slides,
        across: turns.then(|| across(&normal, &slides)),
        area: place.area,
        shear_modulus: p.medium.shear_modulus,
        theta: Theta::from_law(&p.law),
        plate: plate.filter(|rate| rate[0] != 0.0 || turns && rate[1] != 0.0),
    }
}
