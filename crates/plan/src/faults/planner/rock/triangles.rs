//! Faults in space that are surfaces of triangles.

use super::super::super::plan::Outline;
use super::super::place::directions;
use super::super::placed_point::in_space;
use super::depths;
use super::tiling::{Cut, Tiling, buried, in_dimension};
use crate::reading::diagnostic::Diagnostic;
use crate::reading::scene::model::{Fault as Spec, FaultTriangles, Scene};
use crate::shared::entry::Entry;
use crate::shared::model::surfaces;
use crate::shared::resolution::Resolution;
use asperity_cycles::kernel::{KernelError, Space, Triangle};
use asperity_cycles::medium::patches::{Shape, Tile, from_kernel, to_kernel};
use asperity_cycles::medium::{Place, across, unit};
use asperity_fem::mesh::triangles::Triangles;
use asperity_mechanics::coordinates;
use asperity_run::Warning;

/// A surface of triangles.
pub(super) struct MeshedSurface<const D: usize> {
    pub tiles: Vec<Tile>,
    pub cut: Cut<D>,
    pub notes: Vec<String>,
}

/// Cells of a fault. `first` is the number of the first one.
///
/// # Errors
/// [`Diagnostic`] at a file that cannot be read, or whose triangles form no fault in the rock.
pub(super) fn cells<const D: usize>(
    scene: &Scene,
    fault: Entry<'_, Spec>,
    surface: &FaultTriangles,
    space: Space,
    first: usize,
) -> Result<MeshedSurface<D>, Diagnostic> {
    let name = fault.name;
    let mut notes = Vec::new();
    let mut mesh = surfaces::triangles(scene, surface, |spec, bytes| {
        let (mesh, note) = depths::triangles(scene, Entry::new(name, spec), bytes)?;
        notes.push(note);
        Ok(mesh)
    })?;
    let sides = face_up(&mut mesh);
    let count = mesh.corners.len();
    let mut tiles = Vec::with_capacity(count);
    let mut cut = Cut {
        places: Vec::with_capacity(count),
        sizes: Vec::with_capacity(count),
        widths: Vec::with_capacity(count),
        faces: Vec::new(),
        outline: None,
        grid: None,
        ends: Vec::new(),
    };
    for k in 0..count {
        let corners = mesh.positions(k);
        let triangle = Triangle::new(space, corners.map(|x| to_kernel(&x).into()))
            .map_err(|error| refused(surface, mesh.elements[k], &corners, error))?;
        let (size, width) = extents(&corners, triangle.area());
        buried(space, name, [from_kernel(&triangle.centre())[1], size], surface.file().span())?;
        let place = place(fault, first + k, &triangle)?;
        tiles.push(tile(&place, triangle));
        cut.places.push(place);
        cut.sizes.push(size);
        cut.widths.push(width);
    }
    notes.push(words(name, &mesh, &cut.sizes));
    notes.extend(sides.words(name, mesh.turned));
    if matches!(surface, FaultTriangles::Depths(_)) {
        notes.push(sense(name, &cut.places));
    }
    cut.outline = Some(Outline { nodes: mesh.nodes, corners: mesh.corners });
    Ok(MeshedSurface { tiles, cut, notes })
}

/// Point at the centre of a triangle.
fn place<const D: usize>(
    fault: Entry<'_, Spec>,
    number: usize,
    triangle: &Triangle,
) -> Result<Place<D>, Diagnostic> {
    let (at, area) = (in_dimension(&from_kernel(&triangle.centre())), triangle.area());
    let normal = unit(in_dimension(&from_kernel(&triangle.frame().column(2).into())));
    let [rake, creeps] = directions(fault, &at, &normal)?;
    Ok(Place { minus: number, plus: number, at, area, normal, rake, creeps, along: 0.0 })
}

/// Note on the direction of slip of a fault that is given by depths, whose plus side is the upper one.
fn sense<const D: usize>(name: &str, places: &[Place<D>]) -> String {
    // y points up.
    let up: f64 = places.iter().map(|place| place.rake[1] * place.area).sum();
    let way = if up > 0.0 {
        "up dip, as above a plate that is subducted"
    } else {
        "down dip, as in normal faulting"
    };
    format!("along its `rake` the upper side of fault `{name}` moves {way}")
}

/// Longest side of a triangle, and twice the least distance of its centre from a side: a third of its least height \[m\].
fn extents(corners: &[[f64; 3]; 3], area: f64) -> (f64, f64) {
    let side = |k: usize| {
        let (a, b) = (&corners[k], &corners[(k + 1) % 3]);
        a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt()
    };
    let longest = side(0).max(side(1)).max(side(2));
    (longest, 2.0 / 3.0 * (2.0 * area / longest))
}

fn refused(
    surface: &FaultTriangles,
    element: u64,
    corners: &[[f64; 3]; 3],
    error: KernelError,
) -> Diagnostic {
    let file = surface.file();
    let highest = corners.iter().map(|x| x[1]).fold(f64::NEG_INFINITY, f64::max);
    let reason = match error {
        KernelError::AboveSurface { .. } => {
            format!("reaches y = {highest} m, above the surface y = 0 of the half-space")
        }
        other => format!("cannot be a dislocation: {other}"),
    };
    Diagnostic::at(
        file.span(),
        format!("mesh file `{}`: element {element} {reason}", file.get_ref()),
        "y points up, and depths are negative; the file has the axes of the scene, and `unit` is its unit of length",
    )
}

fn tile<const D: usize>(place: &Place<D>, triangle: Triangle) -> Tile {
    let (normal, rake, at) = (in_space(&place.normal), in_space(&place.rake), in_space(&place.at));
    Tile { shape: Shape::Triangle(triangle), rake, across: across(&normal, &rake), normal, at, cell: None }
}

/// Share of the area of a piece that its mean normal has along an axis, below which the piece does not face that way: the
/// sine of six hundredths of a degree, more than files of six digits err by, and less than any dip that is meant.
const FACES: f64 = 1e-3;

/// Sides that the normals of pieces point to, as they were chosen.
#[derive(Default)]
struct Sides {
    /// Pieces whose normals point up, and those whose normals point along x or z as they are vertical.
    up: usize,
    level: usize,
    /// Pieces whose mean normal vanishes: the sides are those of the file.
    closed: usize,
}

impl Sides {
    fn words(&self, name: &str, turned: usize) -> Vec<String> {
        let mut all = Vec::new();
        if self.level > 0 {
            let rest = if self.up > 0 { "; where it dips, it is the hanging wall" } else { "" };
            all.push(format!(
                "fault `{name}` is vertical: its plus side is that of larger x, or of larger z if its strike is x{rest}"
            ));
        }
        if self.closed > 0 {
            all.push(format!("fault `{name}` surrounds rock: its plus side is the one given by its file"));
        }
        if turned > 0 {
            all.push(format!(
                "fault `{name}`: triangles that were turned, because the file orients them against the others: {turned}"
            ));
        }
        all
    }
}

/// Turns each piece so that its normals point up on the whole, as on rectangles; on vertical pieces along x, or along z.
fn face_up(mesh: &mut Triangles) -> Sides {
    let mut sides = Sides::default();
    for piece in 0..mesh.pieces.len() {
        let (mean, area) = mesh.area(piece);
        let faces = |axis: usize| mean[axis].abs() > FACES * area;
        let Some(axis) = [1, 0, 2].into_iter().find(|&axis| faces(axis)) else {
            sides.closed += 1;
            continue;
        };
        if axis == 1 {
            sides.up += 1;
        } else {
            sides.level += 1;
        }
        if mean[axis] < 0.0 {
            mesh.turn(piece);
        }
    }
    sides
}

/// Least and largest coordinates of triangles \[m\].
fn bounds(nodes: &[[f64; 3]], corners: &[[usize; 3]]) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for x in corners.iter().flatten().map(|&n| &nodes[n]) {
        for c in 0..3 {
            (low[c], high[c]) = (low[c].min(x[c]), high[c].max(x[c]));
        }
    }
    [low, high]
}

/// Note on the size of a fault and of its triangles, which shows a wrong unit.
fn words(name: &str, mesh: &Triangles, sizes: &[f64]) -> String {
    let [low, high] = bounds(&mesh.nodes, &mesh.corners);
    let (least, most) = sizes.iter().fold((f64::INFINITY, 0.0_f64), |(l, m), s| (l.min(*s), m.max(*s)));
    format!(
        "fault `{name}` has {} triangles with longest sides of {least:.4} to {most:.4} m, between {} and {}",
        mesh.corners.len(),
        coordinates::in_words(&low),
        coordinates::in_words(&high)
    )
}

/// Warnings about faults from files without a unit that are smaller than the cohesive zone of their friction: slip of such
/// a fault hardly varies over it, and the file may use another unit.
pub(super) fn tiny<const D: usize>(
    scene: &Scene,
    tiling: &Tiling<D>,
    resolution: &[Resolution],
) -> Vec<Warning> {
    let mut all = Vec::new();
    for ((name, spec), cut) in scene.faults.iter().zip(&tiling.faults) {
        let (Some(surface), Some(outline)) = (&spec.triangles, &cut.outline) else { continue };
        let found = resolution.iter().find(|r| r.fault == *name).filter(|_| surface.unit().is_none());
        let [low, high] = bounds(&outline.nodes, &outline.corners);
        let extent = low.iter().zip(high).map(|(a, b)| (b - a).powi(2)).sum::<f64>().sqrt();
        if let Some(zone) = found.map(|r| r.cohesive_zone.length).filter(|zone| extent < *zone) {
            all.push(Warning::at(
                surface.file().span(),
                format!(
                    "fault `{name}` extends over {extent:.4} m, less than its cohesive zone of {zone:.4} m; its file is read in m, since no `unit` is given"
                ),
                "such as `unit = \"km\"`; or `unit = \"m\"`, if it is as small",
            ));
        }
    }
    all
}
