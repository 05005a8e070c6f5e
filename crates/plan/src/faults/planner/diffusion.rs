//! Fluid that diffuses along faults: hydraulic properties at their points, and wells.

use super::placed_point::{PlacedPoint, at};
use super::remarks::Remarks;
use super::wells::{FluidReach, WellSpec};
use crate::doubts::{self, Spread};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{
    Diffusion as Given, DiffusionEnds, Hydraulic, ParameterProfiles, Scene, Well, field_dimension,
};
use crate::shared::entry::Entry;
use crate::shared::field::{Bound, Field, Files, Parameter, Region, Spot};
use asperity_cycles::diffusion::{Diffusion, Line, Source};
use asperity_run::Warning;

/// Fluid along all faults in a run that ends at `end` \[s\].
///
/// # Errors
/// [`Diagnostic`] at a well beyond its fault, or at a file that cannot be used.
pub(super) fn diffusion<const D: usize>(
    scene: &Scene,
    placed: &[PlacedPoint<D>],
    end: f64,
    remarks: &mut Remarks,
) -> Result<Option<Diffusion>, Diagnostic> {
    let mut all: Option<Diffusion> = None;
    for (k, (name, spec)) in scene.faults.iter().enumerate() {
        let Some(given) = &spec.diffusion else { continue };
        let first = placed.partition_point(|p| p.fault < k);
        let points = &placed[first..placed.partition_point(|p| p.fault <= k)];
        if points.is_empty() {
            continue;
        }
        let line = line(scene, Entry::new(name, given), points, remarks)?;
        let wells = given.wells.get_ref().iter().map(|well| source(Entry::new(name, well), &line));
        let wells = wells.collect::<Result<Vec<_>, _>>()?;
        let own = all.get_or_insert_default();
        own.add(first, &line, &wells, end);
        let idle = given.wells.get_ref().iter().filter_map(|well| WellSpec::from(well).idle(name, end));
        remarks.warnings.extend(idle);
        remarks.warnings.extend(narrow(Entry::new(name, given), &line, &wells, end));
        let steps = wells.iter().flat_map(|well| well.flux.iter().copied()).collect();
        let help =
            "check the units of `flux`, `permeability` and `storage`; or give the fault a `normal_floor`";
        let reach = FluidReach { fault: name, place: given.wells.span(), help, pressure: &*own, steps, end };
        remarks.warnings.extend(reach.lifted(placed, first));
    }
    Ok(all)
}

/// Hydraulic properties of the points of a fault.
fn line<const D: usize>(
    scene: &Scene,
    Entry { name, spec: given }: Entry<'_, Given>,
    points: &[PlacedPoint<D>],
    remarks: &mut Remarks,
) -> Result<Line, Diagnostic> {
    let region = format!("fault `{name}`");
    let spots: Vec<Spot<D>> = points.iter().map(spot).collect();
    let mut files = Files::default();
    let mut values = |(key, value, profile, field): Hydraulic<'_>| {
        if let Some(field) = field {
            let parameter = Parameter { key, dimension: field_dimension(key), bound: Bound::Positive };
            let all = Region { scene, spots: &spots, name: &region };
            let field = Field::read(&mut files, &all, field, &parameter)?;
            remarks.warnings.extend(field.doubts(&region, &spots));
            remarks.notes.push(field.note(&region, spots.iter()));
            return spots.iter().map(|spot| field.at(&region, spot)).collect();
        }
        // The scene check ensures that one of them is given.
        let constant = value.map_or(f64::NAN, |v| v.0);
        let of = |p: &PlacedPoint<D>| {
            profile.map_or(constant, |ParameterProfiles(list)| {
                list.iter().map(|profile| at(profile, &p.point.place)).fold(f64::NEG_INFINITY, f64::max)
            })
        };
        Ok(points.iter().map(of).collect::<Vec<f64>>())
    };
    let [permeability, storage] = given.parameters();
    let (permeability, storage) = (values(permeability)?, values(storage)?);
    let viscosity = given.viscosity.get_ref().0;
    Ok(Line {
        positions: points.iter().map(|p| p.point.place.along).collect(),
        lengths: points.iter().map(|p| p.point.place.area).collect(),
        mobility: permeability.into_iter().map(|k| k / viscosity).collect(),
        storage,
        drained: given.ends.as_ref().is_some_and(|ends| *ends.get_ref() == DiffusionEnds::Drained),
    })
}

fn spot<const D: usize>(placed: &PlacedPoint<D>) -> Spot<D> {
    let place = &placed.point.place;
    Spot { at: place.at, along: Some(place.along) }
}

/// A well with the steps of its flux, on the cells of its fault.
fn source(Entry { name, spec: well }: Entry<'_, Well>, line: &Line) -> Result<Source, Diagnostic> {
    let spec = WellSpec::from(well);
    Ok(Source { at: spec.within(name, ends(line))?, flux: spec.steps() })
}

/// Ends of the cells of a line \[m\]. Distances along a fault count from its upper end.
fn ends(line: &Line) -> [f64; 2] {
    let last = line.positions.len() - 1;
    let low = line.positions[0] - 0.5 * line.lengths[0];
    [low.max(0.0), line.positions[last] + 0.5 * line.lengths[last]]
}

/// Warning about a well whose fluid stays within its cell: pressure is that of the mean over the cell.
fn narrow(
    Entry { name, spec: given }: Entry<'_, Given>,
    line: &Line,
    wells: &[Source],
    end: f64,
) -> Option<Warning> {
    let mut all = wells.iter().zip(given.wells.get_ref());
    all.find_map(|(well, spec)| {
        let begin = well.flux.iter().find(|step| step.1 != 0.0).filter(|step| step.0 < end)?.0;
        let near = |k: &usize| (line.positions[*k] - well.at).abs();
        let k = (0..line.positions.len()).min_by(|a, b| near(a).total_cmp(&near(b)))?;
        let length = 2.0 * (line.mobility[k] / line.storage[k] * (end - begin)).sqrt();
        let spread = Spread { at: well.at, length, size: line.lengths[k] };
        let help = "smaller cells; or check the units of `permeability`, `viscosity` and `storage`";
        doubts::narrow(name, spec.at.span(), spread, "its pressure is the mean over them", help)
    })
}
