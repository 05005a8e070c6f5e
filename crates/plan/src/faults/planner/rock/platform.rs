//! Files of a vertical fault in space for the platform of a community benchmark.

use super::super::super::platform::Platform;
use super::super::assemble::turns;
use super::super::placed_point::{PlacedPoint, in_space, slides};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Scene, Spanned, Station};
use asperity_cycles::medium::across;
use asperity_output::formats::platform::Submission;
use nalgebra::Vector3;

/// Difference of directions that count as the same: rounding.
const SAME: f64 = 1e-9;

/// Metres per kilometre.
const KM: f64 = 1e3;

/// Files of a scene, if it asks for them.
///
/// # Errors
/// [`Diagnostic`] at a fault that is no vertical plane, at slip that is not along strike, or at positions that have the same name.
pub(super) fn plan<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
) -> Result<Option<Platform>, Diagnostic> {
    let Some(asked) = &scene.output.platform else { return Ok(None) };
    let spec = asked.get_ref();
    let (1, Some(first)) = (scene.faults.len(), placed.first()) else {
        return Err(Diagnostic::at(
            asked.span(),
            format!(
                "the files of the platform are those of one fault, and the scene has {}",
                scene.faults.len()
            ),
            "one scene for each benchmark",
        ));
    };
    let axes = FaultAxes::find(asked, placed, first)?;
    let signs = axes.signs(asked, first)?;
    let at = scene.output.stations.values().flat_map(|all| all.get_ref());
    let at = at.filter_map(|station| if let Station::At(at) = station.get_ref() { Some(at) } else { None });
    let stations: Vec<NamedFile> = at.map(|at| on_fault(axes.coordinates(at))).collect();
    let receivers = scene.output.receivers.values().map(|at| {
        let at: Vec<f64> = at.get_ref().iter().map(|x| x.0).collect();
        off_fault(axes.coordinates(&at))
    });
    let receivers: Vec<NamedFile> = receivers.collect();
    distinct(asked, stations.iter().chain(&receivers).map(|named| named.0.as_str()))?;
    let spacing = placed.iter().map(|p| p.spacing).fold(0.0, f64::max);
    let submission = Submission {
        problem: spec.problem.get_ref().clone(),
        version: env!("CARGO_PKG_VERSION").into(),
        modeler: spec.modeler.get_ref().clone(),
        date: spec.date.as_ref().map(|date| date.get_ref().clone()),
        element_size: format!("{spacing} m"),
    };
    let axes = axes.0.map(Into::into);
    let signs = signs.map(f64::signum);
    Ok(Some(Platform { submission, axes, turns: turns(scene), signs, stations, receivers }))
}

/// Name of a file, and the position in words.
type NamedFile = (String, String);

/// Axes of a vertical plane: its normal, along strike, and down.
struct FaultAxes([Vector3<f64>; 3]);

impl FaultAxes {
    /// Axes of a fault with this first point.
    ///
    /// # Errors
    /// [`Diagnostic`] at a fault that is no vertical plane.
    fn find<const D: usize, T>(
        asked: &Spanned<T>,
        placed: &[PlacedPoint<D>],
        first: &PlacedPoint<D>,
    ) -> Result<Self, Diagnostic> {
        let normal = Vector3::from(in_space(&first.point.place.normal));
        let plane =
            placed.iter().all(|p| (Vector3::from(in_space(&p.point.place.normal)) - normal).norm() < SAME);
        if D != 3 || !plane || normal.y.abs() > SAME {
            return Err(Diagnostic::at(
                asked.span(),
                "the files of the platform are those of a vertical plane in space",
                "remove `platform`; `stations` have the format of benchmarks in the plane",
            ));
        }
        let down = -Vector3::y();
        Ok(Self([normal, down.cross(&normal), down]))
    }

    /// Components of both directions of slip along strike and down.
    ///
    /// # Errors
    /// [`Diagnostic`] at slip that is not along strike.
    fn signs<const D: usize, T>(
        &self,
        asked: &Spanned<T>,
        first: &PlacedPoint<D>,
    ) -> Result<[f64; 2], Diagnostic> {
        let Self([normal, along, down]) = self;
        let rake = Vector3::from(slides(first));
        let aside = Vector3::from(across(&(*normal).into(), &rake.into()));
        let signs = [rake.dot(along), aside.dot(down)];
        if signs.iter().any(|sign| (sign.abs() - 1.0).abs() > SAME) {
            return Err(Diagnostic::at(
                asked.span(),
                "the files of the platform have slip along strike and down, and `rake` is neither",
                "a `rake` along strike, with `slip = \"free\"` where slip may turn",
            ));
        }
        Ok(signs)
    }

    /// Distance off the fault, along strike, and depth \[m\].
    fn coordinates(&self, at: &[f64]) -> [f64; 3] {
        let at = Vector3::from_fn(|c, _| at.get(c).copied().unwrap_or(0.0));
        // Adding zero turns -0 into 0.
        self.0.map(|axis| axis.dot(&at) + 0.0)
    }
}

fn on_fault([_, strike, depth]: [f64; 3]) -> NamedFile {
    let name = format!("fltst_strk{}dp{}", km(strike), km(depth));
    let location = format!("on fault, {} km along strike, {} km depth", strike / KM, depth / KM);
    (name, location)
}

fn off_fault([off, strike, depth]: [f64; 3]) -> NamedFile {
    let name = format!("blkst_strk{}fn{}dp{}", km(strike), km(off), km(depth));
    let [off, strike, depth] = [off, strike, depth].map(|x| x / KM);
    (name, format!("off fault, {strike} km along strike, {off} km away from the fault, {depth} km depth"))
}

/// Whole kilometres with a sign and two digits, as in the names of the benchmarks.
fn km(metres: f64) -> String {
    // Adding zero turns -0 into 0.
    format!("{:+03}", (metres / KM).round() + 0.0)
}

fn distinct<'a, T>(asked: &Spanned<T>, names: impl Iterator<Item = &'a str>) -> Result<(), Diagnostic> {
    let mut sorted: Vec<&str> = names.collect();
    sorted.sort_unstable();
    let Some(twice) = sorted.windows(2).find(|pair| pair[0] == pair[1]) else { return Ok(()) };
    Err(Diagnostic::at(
        asked.span(),
        format!("two positions have the file `{}`: names of the platform have whole kilometres", twice[0]),
        "positions at least a kilometre apart, or no `platform`",
    ))
}
