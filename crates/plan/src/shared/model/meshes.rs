//! Meshes of the bodies, generated or read from files.

use super::cuts::{self, Cuts};
use crate::reading::columns::Wrong;
use crate::reading::diagnostic::Diagnostic;
use crate::reading::missing_file::{FileKind, unread};
use crate::reading::scene::control_characters::is_unprintable;
use crate::reading::scene::model as scene;
use crate::reading::scene::suggestions::suggest;
use crate::reading::scene::units::{self, Dimension, Length};
use crate::reading::sniff::{self, Reader};
use asperity_fem::element::ElementKind;
use asperity_fem::mesh::coarsening::{Coarsening, CoarseningError};
use asperity_fem::mesh::curve::{Curve, Profile, bend};
use asperity_fem::mesh::extrude::{ExtrudeError, extrude};
use asperity_fem::mesh::fault::{Departure, FaultMesh, FaultMeshError, Interpolation, Spacing};
use asperity_fem::mesh::generate::{Block, Grading, Grid, SIDES, divisions_for};
use asperity_fem::mesh::{GroupTag, Mesh, MeshError, OmittedElements, Options, RawMesh, abaqus, gmsh};
use asperity_mechanics::Model;
use scene::Spanned;
use std::collections::BTreeSet;
use std::ops::Range;

/// Mesh of a body; its sets keep their own names.
///
/// # Errors
/// [`Diagnostic`] at the position in the scene. For a file that cannot be read it gives the name and the error.
pub fn body_mesh<const D: usize>(
    scene: &scene::Scene,
    name: &str,
    body: &scene::Body,
) -> Result<Mesh<D>, Diagnostic> {
    let Some(layers) = &body.extrude else { return source::<D>(scene, name, body) };
    let plane = source::<2>(scene, name, body)?;
    let z: Vec<f64> = layers.get_ref().iter().map(|z| z.0).collect();
    let drawn = extrude(&plane, &z).map_err(|e| undrawn(name, body, layers.span(), &e))?;
    in_dimension(drawn.mesh, || {
        Diagnostic::at(
            layers.span(),
            format!("`extrude` makes the mesh of body `{name}` three-dimensional"),
            "remove it, or use `kinematics = \"3d\"`",
        )
    })
}

/// Error of layers that do not fit.
fn undrawn(name: &str, body: &scene::Body, place: Range<usize>, error: &ExtrudeError) -> Diagnostic {
    match (error, &body.mesh) {
        (ExtrudeError::Mixed { .. }, scene::MeshSource::Fault(spec)) => Diagnostic::at(
            spec.element.span(),
            format!(
                "body `{name}`: the wedge between a flat fault and the boundary that it reaches begins with triangles, which cannot be \
                 extruded beside `{}`",
                spec.element.get_ref()
            ),
            "element = \"quad4\"",
        ),
        _ => Diagnostic::body(name, place, error.to_string()),
    }
}

fn source<const D: usize>(
    scene: &scene::Scene,
    name: &str,
    body: &scene::Body,
) -> Result<Mesh<D>, Diagnostic> {
    let plane = |place: Range<usize>| {
        move || {
            Diagnostic::at(
                place,
                format!("the mesh of body `{name}` is plane"),
                "in three dimensions add `extrude = [..]` to the body, the heights of its layers",
            )
        }
    };
    match &body.mesh {
        scene::MeshSource::Block(spec) => block::<D>(name, spec),
        scene::MeshSource::Quadrilateral(spec) => {
            in_dimension(quadrilateral(name, spec)?, plane(spec.element.span()))
        }
        scene::MeshSource::Fault(spec) => in_dimension(fault(name, spec)?, plane(spec.element.span())),
        scene::MeshSource::Gmsh(spec) => {
            let tag = |spec: &scene::TagSpec| GroupTag { tag: spec.tag, dimension: spec.dimension };
            let tags = spec.tags.iter().map(|(name, spec)| (name.clone(), tag(spec.get_ref()))).collect();
            let options = Options { length_unit: unit(spec.unit.as_ref())?, tags, ..Options::default() };
            let groups = (spec.groups.as_ref(), "groups of cells");
            read(scene, &spec.file, (gmsh::parse, Reader::Gmsh), &options, groups, (&spec.split, &spec.plus))
        }
        scene::MeshSource::Abaqus(spec) => {
            let options = Options { length_unit: unit(spec.unit.as_ref())?, ..Options::default() };
            let groups = (spec.elsets.as_ref(), "element sets");
            read(
                scene,
                &spec.file,
                (abaqus::parse, Reader::Abaqus),
                &options,
                groups,
                (&spec.split, &spec.plus),
            )
        }
    }
}

/// The same mesh typed with dimension `B`; an error if `A` differs from `B`.
fn in_dimension<const A: usize, const B: usize>(
    mesh: Mesh<A>,
    error: impl FnOnce() -> Diagnostic,
) -> Result<Mesh<B>, Diagnostic> {
    if A != B {
        return Err(error());
    }
    let Mesh { nodes, blocks, side_sets, cell_sets, node_sets, left_out } = mesh;
    let nodes = nodes.iter().map(|x| std::array::from_fn(|c| x[c])).collect();
    Ok(Mesh { nodes, blocks, side_sets, cell_sets, node_sets, left_out })
}

fn element(name: &Spanned<String>) -> Result<ElementKind, Diagnostic> {
    name.get_ref()
        .parse()
        .map_err(|e| Diagnostic::at(name.span(), format!("{e}"), "see the list of elements"))
}

fn grading(ratio: f64) -> Grading {
    if ratio == 1.0 { Grading::Uniform } else { Grading::Geometric { ratio } }
}

fn block<const D: usize>(name: &str, spec: &scene::BlockMesh) -> Result<Mesh<D>, Diagnostic> {
    let kind = element(&spec.element)?;
    let corner = |v: &Spanned<Vec<Length>>| -> Result<[f64; D], Diagnostic> {
        let values: Vec<f64> = v.get_ref().iter().map(|l| l.0).collect();
        <[f64; D]>::try_from(values)
            .map_err(|c| Diagnostic::at(v.span(), format!("{} coordinates", c.len()), format!("give {D}")))
    };
    let (min, max) = (corner(&spec.min)?, corner(&spec.max)?);
    let (grid, place) = match &spec.spacing {
        Some(spacing) => (spaced(name, kind, (&min, &max), spacing)?, spacing.span()),
        None => (divided(name, kind, (&min, &max), spec)?, spec.element.span()),
    };
    let mut mesh = match &spec.coarser {
        Some(coarser) => self::coarser(name, &grid, spec, coarser.get_ref())?,
        None => grid.mesh().map_err(|e| Diagnostic::body(name, place, e.to_string()))?,
    };
    let mut curves = Vec::new();
    for (side, curve) in &spec.curves {
        curves.push(self::curve(side, curve)?);
        bend(&mut mesh.nodes.clone(), &min, &max, &curves)
            .map_err(|e| Diagnostic::body(name, curve.span(), e.to_string()))?;
    }
    let place = spec.element.span();
    bend(&mut mesh.nodes, &min, &max, &curves).map_err(|e| Diagnostic::body(name, place, e.to_string()))?;
    Ok(mesh)
}

/// A block with given cell sizes along its axes.
fn spaced<const D: usize>(
    name: &str,
    kind: ElementKind,
    (min, max): (&[f64; D], &[f64; D]),
    spacing: &Spanned<Vec<Spanned<scene::SpacingSpec>>>,
) -> Result<Grid<D>, Diagnostic> {
    let mut lines = [const { Vec::new() }; D];
    for (axis, line) in lines.iter_mut().enumerate() {
        let given = spacing.get_ref().get(axis).ok_or_else(|| {
            Diagnostic::at(
                spacing.span(),
                format!("`spacing` has {} entries", spacing.get_ref().len()),
                format!("give {D}, one an axis"),
            )
        })?;
        *line = self::spacing(given.get_ref())
            .line(min[axis], max[axis])
            .map_err(|e| Diagnostic::body(name, given.span(), e.to_string()))?;
    }
    Ok(Grid { lines, kind })
}

/// A block whose cells become larger with the distance from a side.
fn coarser<const D: usize>(
    name: &str,
    grid: &Grid<D>,
    block: &scene::BlockMesh,
    spec: &scene::CoarserSpec,
) -> Result<Mesh<D>, Diagnostic> {
    let side = side::<D>(spec.from.get_ref(), spec.from.span())?;
    let beyond = spec.beyond.get_ref().iter().map(|x| x.0).collect();
    Coarsening { side, beyond }.mesh(grid).map_err(|e| {
        let place = match e {
            CoarseningError::Element(_) => block.element.span(),
            _ => spec.beyond.span(),
        };
        Diagnostic::body(name, place, e.to_string())
    })
}

/// Axis and end of a side of a block.
fn side<const D: usize>(name: &str, place: Range<usize>) -> Result<[usize; 2], Diagnostic> {
    let axis = SIDES.iter().take(D).position(|ends| ends.contains(&name)).ok_or_else(|| {
        let known = SIDES.iter().take(D).flatten().copied();
        Diagnostic::at(place, format!("a block has no side `{name}`"), suggest(name, "sides", known))
    })?;
    Ok([axis, usize::from(SIDES[axis][1] == name)])
}

fn curve<const D: usize>(name: &str, spec: &Spanned<scene::CurveSpec>) -> Result<Curve<D>, Diagnostic> {
    let side = side::<D>(name, spec.span())?;
    let curve = spec.get_ref();
    let apex = *curve.apex.get_ref();
    if (D..3).any(|c| apex.along(c).is_some()) {
        return Err(Diagnostic::at(
            curve.apex.span(),
            "the apex has a coordinate `z` in a plane scene",
            "give those along the side that it bends over, such as `apex = { x = 0 }`",
        ));
    }
    Ok(Curve {
        side,
        profile: match curve.kind.get_ref() {
            scene::CurveKind::Parabola => Profile::Parabola,
            scene::CurveKind::Circle => Profile::Circle,
        },
        radius: curve.radius.get_ref().0,
        apex: std::array::from_fn(|c| apex.along(c).map(|x| x.0)),
    })
}

/// A block of equal or geometrically graded cells.
fn divided<const D: usize>(
    name: &str,
    kind: ElementKind,
    (min, max): (&[f64; D], &[f64; D]),
    spec: &scene::BlockMesh,
) -> Result<Grid<D>, Diagnostic> {
    let mut divisions = [1; D];
    let mut gradings = [Grading::Uniform; D];
    for axis in 0..D {
        divisions[axis] = divisions_along(spec, axis, max[axis] - min[axis])?;
        if let Some(g) = &spec.grading {
            gradings[axis] = g.get_ref().get(axis).map_or(Grading::Uniform, |&ratio| grading(ratio));
        }
    }
    Block { min: *min, max: *max, divisions, grading: gradings, kind }
        .grid()
        .map_err(|e| Diagnostic::body(name, spec.element.span(), e.to_string()))
}

/// Number of cells along each axis of a block.
///
/// # Errors
/// [`Diagnostic`] if the entry is incomplete or does not divide the block.
pub fn cells_along(name: &str, spec: &scene::BlockMesh) -> Result<Vec<usize>, Diagnostic> {
    let ends = spec.min.get_ref().iter().zip(spec.max.get_ref());
    let along = |(axis, (min, max)): (usize, (&Length, &Length))| match &spec.spacing {
        None => divisions_along(spec, axis, max.0 - min.0),
        Some(spacing) => {
            let given = spacing.get_ref().get(axis);
            let given = given.ok_or_else(|| {
                let help = "one entry for each axis";
                Diagnostic::at(spacing.span(), "`spacing` is incomplete", help)
            })?;
            let line = self::spacing(given.get_ref()).line(min.0, max.0);
            Ok(line.map_err(|e| Diagnostic::body(name, given.span(), e.to_string()))?.len() - 1)
        }
    };
    ends.enumerate().map(along).collect()
}

fn divisions_along(spec: &scene::BlockMesh, axis: usize, length: f64) -> Result<usize, Diagnostic> {
    if let Some(divisions) = &spec.divisions {
        return divisions.get_ref().get(axis).copied().filter(|&n| n > 0).ok_or_else(|| {
            Diagnostic::at(divisions.span(), "divisions are incomplete", "one positive number an axis")
        });
    }
    let size = spec
        .size
        .as_ref()
        .ok_or_else(|| Diagnostic::at(spec.element.span(), "the block has no element size", "give `size`"))?;
    divisions_for(length, size.get_ref().0)
        .map_err(|e| Diagnostic::at(size.span(), e.to_string(), "a size that divides each edge of the block"))
}

/// The unit square, mapped bilinearly onto four corners.
fn quadrilateral(name: &str, spec: &scene::QuadrilateralMesh) -> Result<Mesh<2>, Diagnostic> {
    let ratios = spec.grading.as_ref().map_or([1.0; 2], |g| *g.get_ref());
    let unit = Block {
        min: [0.0; 2],
        max: [1.0; 2],
        divisions: *spec.divisions.get_ref(),
        grading: ratios.map(grading),
        kind: element(&spec.element)?,
    };
    let mut mesh = unit.mesh().map_err(|e| Diagnostic::body(name, spec.element.span(), e.to_string()))?;
    let corners = spec.corners.get_ref().map(|x| x.map(|c| c.0));
    for x in &mut mesh.nodes {
        let [s, t] = *x;
        let shares = [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
        *x = std::array::from_fn(|c| shares.iter().zip(&corners).map(|(n, p)| n * p[c]).sum());
    }
    Ok(mesh)
}

/// A box around a fault.
fn fault(name: &str, spec: &scene::FaultMesh) -> Result<Mesh<2>, Diagnostic> {
    let generated = faulted(spec)?.mesh();
    Ok(generated.map_err(|e| unmeshed(name, spec, &e))?.mesh)
}

/// Error of a trace that cannot be meshed.
fn unmeshed(name: &str, spec: &scene::FaultMesh, error: &FaultMeshError) -> Diagnostic {
    let place = spec.trace.span();
    match error {
        FaultMeshError::Flat { .. } | FaultMeshError::Bent { .. } => Diagnostic::at(
            place,
            format!("body `{name}`: {error}"),
            "such a fault lies in a `[medium]`, which takes any line, or in a mesh by Gmsh or Abaqus with `split`",
        ),
        _ => Diagnostic::body(name, place, error.to_string()),
    }
}

/// Facts about generated meshes that no file contains: the course of smooth curves between the vertices of traces.
///
/// # Errors
/// [`Diagnostic`] for traces that cannot be meshed.
pub fn notes(scene: &scene::Scene) -> Result<Vec<String>, Diagnostic> {
    let mut notes = Vec::new();
    for (name, body) in &scene.bodies {
        let scene::MeshSource::Fault(spec) = &body.mesh else { continue };
        let departure = faulted(spec)?.departure();
        let departure = departure.map_err(|e| unmeshed(name, spec, &e))?;
        let vertices = spec.trace.get_ref().len();
        notes.extend(departure.map(|d| smooth(&format!("the fault of body `{name}`"), vertices, d)));
    }
    Ok(notes)
}

/// Note on a smooth curve through vertices.
pub fn smooth(what: &str, vertices: usize, departure: Departure) -> String {
    format!(
        "{what} is a smooth curve through the {vertices} vertices of its trace, at most {:.4} m from straight lines between them, at \
         ({:.4}, {:.4}) m; `interpolation = \"polyline\"` keeps corners",
        departure.distance, departure.at[0], departure.at[1]
    )
}

/// A box around a fault, as generated. Lengths along the fault are measured from the first vertex of its trace.
fn faulted(spec: &scene::FaultMesh) -> Result<FaultMesh, Diagnostic> {
    let point = |x: &[Length; 2]| x.map(|c| c.0);
    Ok(FaultMesh {
        trace: spec.trace.get_ref().iter().map(point).collect(),
        interpolation: interpolation(spec.interpolation),
        spacing: spacing(spec.spacing.get_ref()),
        thickness: spec.thickness.as_ref().map(|t| t.get_ref().0),
        min: point(spec.min.get_ref()),
        max: point(spec.max.get_ref()),
        growth: *spec.growth.get_ref(),
        kind: element(&spec.element)?,
    })
}

/// Curve through the vertices of a line.
pub fn interpolation(spec: scene::InterpolationSpec) -> Interpolation {
    match spec {
        scene::InterpolationSpec::Spline => Interpolation::Spline,
        scene::InterpolationSpec::Polyline => Interpolation::Polyline,
    }
}

/// Cell sizes along a line.
pub fn spacing(spec: &scene::SpacingSpec) -> Spacing {
    match spec {
        scene::SpacingSpec::Constant(size) => Spacing::Constant(size.0),
        scene::SpacingSpec::Graded(table) => Spacing::Graded(table.iter().map(|e| e.map(|x| x.0)).collect()),
        scene::SpacingSpec::Zone(zone) => {
            Spacing::Zone { from: zone.from.0, to: zone.to.0, size: zone.size.0, ratio: zone.ratio }
        }
    }
}

/// Length unit of a file in metres.
pub(crate) fn unit(name: Option<&Spanned<String>>) -> Result<f64, Diagnostic> {
    let Some(name) = name else { return Ok(1.0) };
    units::parse(&format!("1 {}", name.get_ref()), Dimension::Length).map_err(|_| {
        Diagnostic::at(
            name.span(),
            format!("there is no unit of length `{}`", name.get_ref()),
            "such as `unit = \"km\"`",
        )
    })
}

/// Parser of the bytes of a file.
type Parse = fn(&[u8]) -> Result<RawMesh, MeshError>;

/// Reads a file, selects the cells of the groups, and splits them along the surfaces.
fn read<const D: usize>(
    scene: &scene::Scene,
    file: &Spanned<String>,
    (parse, reader): (Parse, Reader),
    options: &Options,
    (groups, what): (Option<&Spanned<Vec<Spanned<String>>>>, &str),
    (surfaces, plus): Cuts<'_>,
) -> Result<Mesh<D>, Diagnostic> {
    let name = file.get_ref();
    let at = |message: String, help: &str| Diagnostic::at(file.span(), message, help.to_string());
    let options = Options { only: asked_of(scene, name), leave_out: true, ..options.clone() };
    let mesh = parse(&bytes(scene, file, reader)?)
        .and_then(|raw| raw.into_mesh::<D>(&options))
        .map_err(|e| at(format!("mesh file `{name}`: {e}"), "the error is in the file, not in the scene"))?;
    if let Some(set) = unprintable(&mesh) {
        let message =
            format!("mesh file `{name}`: the name of the set `{}` is not printable", set.escape_debug());
        return Err(at(message, "names of sets have no control characters: rename it in the mesh file"));
    }
    let mut mesh = match groups {
        None => mesh,
        Some(groups) => {
            let mut blocks = Vec::new();
            for group in groups.get_ref() {
                let found = mesh.cell_sets.get(group.get_ref()).ok_or_else(|| {
                    let known = mesh.cell_sets.keys().map(String::as_str);
                    let left = mesh.left_out.get(group.get_ref());
                    let instead = left.map_or_else(String::new, |left| format!(", but {}", in_words(left)));
                    Diagnostic::at(
                        group.span(),
                        format!(
                            "the mesh file `{name}` has no cells in a group `{}`{instead}",
                            group.get_ref()
                        ),
                        suggest(group.get_ref(), what, known),
                    )
                })?;
                blocks.extend_from_slice(found);
            }
            blocks.sort_unstable();
            blocks.dedup();
            mesh.part(&blocks)
        }
    };
    for surface in surfaces {
        cuts::cut(&mut mesh, name, surface, plus.get(surface.get_ref()))?;
    }
    Ok(mesh)
}

/// The first set of a mesh whose name would not be printed as it is.
fn unprintable<const D: usize>(mesh: &Mesh<D>) -> Option<&String> {
    let sets = mesh.cell_sets.keys().chain(mesh.side_sets.keys()).chain(mesh.node_sets.keys());
    sets.into_iter().find(|name| name.chars().any(is_unprintable))
}

/// Groups of cells that the bodies of a scene take from a file; `None` if one takes all cells.
fn asked_of(scene: &scene::Scene, file: &str) -> Option<Vec<String>> {
    let mut all = Vec::new();
    for body in scene.bodies.values() {
        let (own, groups) = match &body.mesh {
            scene::MeshSource::Gmsh(spec) => (&spec.file, &spec.groups),
            scene::MeshSource::Abaqus(spec) => (&spec.file, &spec.elsets),
            _ => continue,
        };
        if own.get_ref() == file {
            all.extend(groups.as_ref()?.get_ref().iter().map(|group| group.get_ref().clone()));
        }
    }
    Some(all)
}

/// Elements of a file that no mesh has, as text.
pub(crate) fn in_words(left: &OmittedElements) -> String {
    let OmittedElements { kind, count, element, read } = left;
    let (elements, are, faces) =
        if *count == 1 { ("element", "is", "face") } else { ("elements", "are", "faces") };
    let first = if *count == 1 { "element" } else { "the first is element" };
    let reason = if *read { format!("{are} no {faces} of its cells") } else { format!("{are} not read") };
    format!("{count} {elements} of type {kind} ({first} {element}), which {reason}")
}

/// Notes on elements of files that belong to no body.
pub fn left_out<const D: usize>(model: &Model<D>) -> Vec<String> {
    let mut notes = Vec::new();
    let mut told = BTreeSet::new();
    for body in &model.bodies {
        let own = |set: &String| Some(set.strip_prefix(&body.name)?.strip_prefix('.')?.to_string());
        for (set, left) in &model.mesh.left_out {
            let Some(set) = own(set).filter(|set| told.insert((set.clone(), left.element))) else { continue };
            let name = &body.name;
            notes.push(format!(
                "the file of body `{name}` has in `{set}` {}: they are left out",
                in_words(left)
            ));
        }
    }
    notes
}

/// Content of a mesh file.
pub(super) fn bytes(
    scene: &scene::Scene,
    file: &Spanned<String>,
    reader: Reader,
) -> Result<Vec<u8>, Diagnostic> {
    let (name, path) = (file.get_ref(), scene.folder.join(file.get_ref()));
    let bytes = std::fs::read(&path).map_err(|e| {
        let (message, help) = unread(&path, &e, MESHES);
        Diagnostic::at(file.span(), format!("the mesh file `{name}` cannot be read: {message}"), help)
    })?;
    match sniff::other(&bytes, reader) {
        None => Ok(sniff::unmarked(bytes)),
        Some(Wrong { message, help }) => {
            Err(Diagnostic::at(file.span(), format!("mesh file `{name}`: {message}"), help))
        }
    }
}

/// Mesh files.
const MESHES: FileKind = FileKind { what: "mesh files", extensions: &["msh", "inp", "stl"] };
