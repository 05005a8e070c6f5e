//! Steps and the tables that a stage prescribes: at how many entries steps end, and what equal steps pass over.

use crate::reading::scene::model::{Condition, Loading, Motion, Pace, Scene, Spanned, Stage};
use asperity_fem::corners::{departure, range};
use asperity_fem::table::Table;
use asperity_mechanics::Course;
use asperity_run::Warning;
use asperity_scene::{defaults, lengths};
use std::ops::Range;

/// Departure of a table from its chord within a step that follows waves, which are many for each bend of a table: a tenth of the range within a step is a pulse of a few
/// steps.
pub const WAVES: f64 = 0.1;
/// Number of corners from which a warning says what they cost.
const MANY: usize = 10_000;
/// Factor by which that warning proposes to raise the tolerance.
const COARSER: f64 = 10.0;

/// A table of a stage.
struct PrescribedTable {
    /// Component and set that it prescribes, such as "x of `block.top`".
    what: String,
    /// True for displacements and their rates.
    moves: bool,
    course: Course,
    place: Range<usize>,
}

/// Tolerance of courses of a scene.
pub fn tolerance(scene: &Scene) -> f64 {
    scene.time.course_tolerance.as_ref().map_or(defaults::COURSE_TOLERANCE, |t| *t.get_ref())
}

/// Remarks on the tables of the stages of a scene, and warnings.
pub fn remarks_and_warnings(scene: &Scene) -> (Vec<String>, Vec<Warning>) {
    let (mut remarks, mut warnings) = (Vec::new(), Vec::new());
    let tolerance = tolerance(scene);
    for stage in &scene.stages {
        let tables = prescribed(stage);
        match &stage.steps {
            Some(steps) => {
                let dt = stage.duration.get_ref().0 / *steps.get_ref() as f64;
                warnings.extend(passed_over(stage, dt, tolerance));
            }
            None => {
                remarks.extend(corners(stage, &tables, tolerance));
                warnings.extend(many(stage, &tables, tolerance));
            }
        }
    }
    (remarks, warnings)
}

/// Warnings about tables from whose entries equal steps of length `dt` depart by more than a share `tolerance` of their range.
pub fn passed_over(stage: &Stage, dt: f64, tolerance: f64) -> Vec<Warning> {
    let duration = stage.duration.get_ref().0;
    let steps = (duration / dt).round();
    let doubt = |PrescribedTable { what, moves, course, place }: PrescribedTable| {
        let (off, time) = departure(&course.moves, dt)?;
        let whole = range(course.moves.values());
        (off > tolerance * whole).then(|| {
            let amount = if moves { lengths::brief(off) } else { format!("{off:.3e} Pa") };
            let message = format!(
                "the {steps} equal steps of stage `{}` pass over entries of the table of {what}: at {time:?} s it departs by {amount}, {:.2} % of its range, from what they follow",
                stage.name,
                100.0 * off / whole
            );
            let help = "more steps; those of the implicit and the static-explicit stepper end at such entries if `steps` is left out";
            Warning::at(stage.steps.as_ref().map_or(place, |steps| steps.span()), message, help)
        })
    };
    prescribed(stage).into_iter().filter_map(doubt).collect()
}

/// Numbers of the corners within a stage and of all entries of its tables.
fn counted(stage: &Stage, tables: &[PrescribedTable], tolerance: f64) -> (usize, usize) {
    let duration = stage.duration.get_ref().0;
    let within = |course: &Course| {
        let times = course.corners(tolerance).into_iter().map(|k| course.times[k]);
        times.filter(|&t| t > 0.0 && t < duration).count()
    };
    let corners = tables.iter().map(|table| within(&table.course)).sum();
    (corners, tables.iter().map(|table| table.course.times.len()).sum())
}

/// Remark on the entries at which adaptive steps end.
fn corners(stage: &Stage, tables: &[PrescribedTable], tolerance: f64) -> Option<String> {
    let (corners, entries) = counted(stage, tables, tolerance);
    let (name, entries) = (&stage.name, format!("the {entries} entries of its tables"));
    (corners > 0).then(|| {
        format!(
            "steps of stage `{name}` end at {corners} of {entries}: no entry departs from the chords between these by more than {tolerance:e} of the range"
        )
    })
}

/// Warning about very many steps.
fn many(stage: &Stage, tables: &[PrescribedTable], tolerance: f64) -> Option<Warning> {
    let (corners, _) = counted(stage, tables, tolerance);
    let longest = tables.iter().max_by_key(|table| table.course.times.len())?;
    (corners > MANY).then(|| {
        let coarse = (COARSER * tolerance, counted(stage, tables, COARSER * tolerance).0);
        let message = format!(
            "the tables of stage `{}` bend at {corners} entries, and a step ends at each",
            stage.name
        );
        let help =
            format!("with `course_tolerance = {:e}` in `[time]` steps end at {} of them", coarse.0, coarse.1);
        Warning::at(longest.place.clone(), message, help)
    })
}

/// Tables of the conditions of a stage, with times since its start.
fn prescribed(stage: &Stage) -> Vec<PrescribedTable> {
    stage.conditions.iter().map(Spanned::get_ref).flat_map(condition_tables).collect()
}

fn condition_tables(c: &Condition) -> Vec<PrescribedTable> {
    let Some(set) = c.set.as_ref().map(Spanned::get_ref) else { return Vec::new() };
    let value = |points: &[(f64, f64)]| {
        let (times, values) = points.iter().copied().unzip();
        Course::from_table(Table::new(times, values))
    };
    let axes = ["x", "y", "z"].into_iter().zip([&c.x, &c.y, &c.z]);
    let motions = axes.filter_map(|(axis, motion)| {
        let (motion, place) = motion.as_ref().map(|m| (m.get_ref(), m.span()))?;
        let course = match motion {
            Motion::Table(points) => value(points),
            Motion::Rate(Pace::Table(rates)) | Motion::Spring { rate: Pace::Table(rates), .. } => {
                let (times, rates) = rates.iter().copied().unzip();
                Course::from_rates(times, rates)
            }
            _ => return None,
        };
        Some(PrescribedTable { what: format!("{axis} of `{set}`"), moves: true, course, place })
    });
    let tractions =
        c.traction.iter().flat_map(|t| t.get_ref().iter().map(|load| ("traction", load, t.span())));
    let pressures = c.pressure.iter().map(|p| ("pressure", p.get_ref(), p.span()));
    let loads = tractions.chain(pressures).filter_map(|(what, load, place)| {
        let Loading::Table(points) = load else { return None };
        Some(PrescribedTable {
            what: format!("{what} of `{set}`"),
            moves: false,
            course: value(points),
            place,
        })
    });
    motions.chain(loads).collect()
}
