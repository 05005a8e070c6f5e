//! Maps over an interface in space at the end of a stage: tractions, gap, slip, work of friction and status, side by side. They show
//! the slave side where it was at the start, along two of the axes.

use super::colour::{INK, PAPER, viridis};
use super::faces::Corner;
use super::field::{self, Colours, FINE, Panel, Vertex, VisibleMesh};
use super::figure::{Anchor, Figure, Image, Point};
use super::six_digits::short;
use crate::bodies::StageEnd;
use crate::bodies::view::{InterfaceMesh, MeshView};
use crate::fields::vtu::Cell;
use crate::numbers;
use crate::units::{ENERGY_PER_AREA, LENGTH, NUMBER, STRESS, Units};
use serde::{Deserialize, Serialize};

/// Largest width and height of a map.
const ROOM: Point = (270.0, 200.0);
/// Position of the first map.
const AT: Point = (96.0, 48.0);
/// Room right of a map and below it.
const BESIDE: Point = (240.0, 70.0);
/// Smallest height of a map with its colour bar and ticks.
const LEAST: f64 = 190.0;
/// Maps beside each other.
const COLUMNS: usize = 2;
/// Names of the states of contact, by their numbers.
const STATES: [&str; 3] = ["open", "stick", "slip"];

/// Maps over an interface at the end of a stage.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct ContactMap {
    /// Name of the file.
    pub(super) file: String,
    /// Name of the interface, and of the stage.
    names: [String; 2],
    /// Its end, or the time at which the run stopped in it \[s\].
    pub(super) time: f64,
    /// True if the run stopped in it.
    stopped: bool,
    /// Number of the surface among the meshes.
    pub(super) mesh: usize,
    /// Axes to the right and up the page.
    axes: [String; 2],
    quantities: Vec<MappedValues>,
    /// Status of the nodes.
    status: Vec<u8>,
}

/// A quantity at the nodes of an interface.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct MappedValues {
    label: String,
    kind: Kind,
    #[serde(deserialize_with = "numbers::or_nan")]
    values: Vec<f64>,
}

/// Kind of a quantity, which has units.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
enum Kind {
    Stress,
    Length,
    EnergyPerArea,
}

impl Kind {
    fn units(self) -> Units {
        match self {
            Self::Stress => STRESS,
            Self::Length => LENGTH,
            Self::EnergyPerArea => ENERGY_PER_AREA,
        }
    }
}

/// The slave side of an interface on the page, with the nodes it shows.
pub(super) struct FlatSurface {
    pub mesh: VisibleMesh,
    pub nodes: Vec<usize>,
    axes: [usize; 2],
}

impl FlatSurface {
    /// The slave side as seen along the axis that its faces face most, the nearest faces on top; `None` in the plane and without
    /// faces.
    pub(super) fn from_interface(interface: &InterfaceMesh) -> Option<Self> {
        if !interface.in_space || interface.faces.is_empty() {
            return None;
        }
        let place = &interface.positions;
        let areas: Vec<[f64; 3]> = interface.faces.iter().map(|face| area(place, face)).collect();
        let facing = |axis: usize| areas.iter().map(|a| a[axis].abs()).sum::<f64>();
        let axis = (0..3).max_by(|&a, &b| facing(a).total_cmp(&facing(b)))?;
        let toward = if areas.iter().map(|a| a[axis]).sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
        let axes = [[1, 2], [0, 2], [0, 1]][axis];
        let depth = |face: &Vec<usize>| {
            toward * face.iter().map(|&n| place[n][axis]).sum::<f64>() / face.len() as f64
        };
        let mut faces: Vec<&Vec<usize>> = interface.faces.iter().collect();
        faces.sort_by(|a, b| depth(a).total_cmp(&depth(b)));
        let flat = MeshView {
            nodes: place.iter().map(|x| [x[axes[0]], x[axes[1]], 0.0]).collect(),
            cells: faces
                .iter()
                .filter_map(|face| Some(Cell::new(flat_kind(face.len())?, face.to_vec())))
                .collect(),
            cell_body: vec![0; faces.len()],
            bodies: vec![interface.name.clone()],
            dimension: 2,
            ..MeshView::default()
        };
        let (mesh, nodes) = VisibleMesh::from_mesh(&flat, &[])?;
        Some(Self { mesh, nodes, axes })
    }
}

/// VTK type of a face with this number of nodes.
fn flat_kind(nodes: usize) -> Option<u8> {
    Some(match nodes {
        3 => 5,
        4 => 9,
        6 => 22,
        8 => 23,
        9 => 28,
        _ => return None,
    })
}

/// Area of a face along each axis, by the ring of its corners.
fn area(place: &[[f64; 3]], face: &[usize]) -> [f64; 3] {
    let corners = &face[..if face.len().is_multiple_of(3) && face.len() < 9 { 3 } else { 4 }];
    let mut sum = [0.0; 3];
    for (k, &node) in corners.iter().enumerate() {
        let (a, b) = (place[node], place[corners[(k + 1) % corners.len()]]);
        for (c, part) in sum.iter_mut().enumerate() {
            let (i, j) = ((c + 1) % 3, (c + 2) % 3);
            *part += 0.5 * (a[i] * b[j] - a[j] * b[i]);
        }
    }
    sum
}

impl ContactMap {
    /// Maps over an interface of this number at the end of a stage, on a surface that has a number among the meshes.
    pub(super) fn new(
        file: String,
        interface: &str,
        end: &StageEnd,
        number: usize,
        (surface, mesh): (&FlatSurface, usize),
        stopped: bool,
    ) -> Option<Self> {
        let fields = end.interfaces.get(number)?;
        let shown = |label: &str, kind: Kind, values: &[f64]| {
            // Infinite gaps, those of nodes without partner, are no numbers.
            let finite = |&node: &usize| Some(values[node]).filter(|v| v.is_finite()).map_or(f64::NAN, short);
            MappedValues { label: label.into(), kind, values: surface.nodes.iter().map(finite).collect() }
        };
        Some(Self {
            file,
            names: [interface.into(), end.name.clone()],
            time: end.time,
            stopped,
            mesh,
            axes: surface.axes.map(|axis| ["x", "y", "z"][axis].into()),
            quantities: vec![
                shown("Normal traction", Kind::Stress, &fields.mean_normal_traction),
                shown("Shear traction", Kind::Stress, &fields.mean_shear_traction),
                shown("Gap", Kind::Length, &fields.gap),
                shown("Slip", Kind::Length, &fields.slip),
                shown("Work of friction", Kind::EnergyPerArea, &fields.friction_work),
            ],
            status: surface.nodes.iter().map(|&node| fields.status[node]).collect(),
        })
    }

    /// True if it has values at as many nodes.
    pub(super) fn fits(&self, nodes: usize) -> bool {
        self.status.len() == nodes && self.quantities.iter().all(|q| q.values.len() == nodes)
    }

    /// The maps; `None` if the surface has no extent.
    pub(super) fn figure(&self, scene: &str, surface: &VisibleMesh) -> Option<Figure> {
        let axes = self.axes.each_ref().map(String::as_str);
        let panel = |at: Point| Panel::new(surface, at, ROOM, axes);
        let size = panel(AT)?.frame.size;
        let pitch = (size.0.max(60.0) + BESIDE.0, size.1.max(LEAST) + BESIDE.1);
        let maps = self.quantities.len() + 1;
        let at = |k: usize| (AT.0 + (k % COLUMNS) as f64 * pitch.0, AT.1 + (k / COLUMNS) as f64 * pitch.1);
        let rows = maps.div_ceil(COLUMNS);
        let mut figure =
            Figure::new(AT.0 + COLUMNS as f64 * pitch.0 - 80.0, AT.1 + rows as f64 * pitch.1 - 8.0);
        let place = if self.stopped { "last step in" } else { "end of" };
        let [interface, stage] = &self.names;
        let part = format!("{interface}, {place} stage “{stage}”");
        super::title::title(&mut figure, &panel(AT)?.frame, scene, &part);
        for (k, quantity) in self.quantities.iter().enumerate() {
            panel(at(k))?.draw(&mut figure, &quantity.values, &quantity.label, quantity.kind.units());
        }
        self.draw_status(&mut figure, &panel(at(maps - 1))?);
        Some(figure)
    }

    /// The status, with sharp bounds: each point of the surface has that of the nearest node.
    fn draw_status(&self, figure: &mut Figure, panel: &Panel<'_>) {
        let colours = Colours { unit: NUMBER.choose(1.0), lo: 0.0, hi: 2.0, above: None };
        let frame = &panel.frame;
        let columns = (frame.size.0 * FINE).round().max(1.0) as usize;
        let rows = (frame.size.1 * FINE).round().max(1.0) as usize;
        let mut rgb = vec![PAPER; columns * rows];
        for triangle in panel.triangles() {
            let places = triangle.each_ref().map(|corner| panel.pixel(corner, (columns, rows)));
            for (corners, status) in self.parts(triangle, places) {
                let value = f64::from(status);
                field::fill(&mut rgb, columns, corners.map(|(x, y)| Vertex { x, y, value }), &colours);
            }
        }
        figure.image(Image { at: frame.at, size: frame.size, columns, rgb });
        panel.outline(figure);
        let left = frame.at.0 + frame.size.0 + 20.0;
        for (k, name) in STATES.iter().enumerate() {
            let y = frame.at.1 + 12.0 + 24.0 * k as f64;
            let square = [(0.0, -8.0), (18.0, -8.0), (18.0, 8.0), (0.0, 8.0)];
            figure.area(square.map(|(dx, dy)| (left + dx, y + dy)).to_vec(), viridis(0.5 * k as f64));
            figure.text((left + 27.0, y), *name, 13.0, Anchor::Start, INK);
        }
    }

    /// Parts of a triangle that belong to its nodes, with their status. The centre of a face belongs to none.
    fn parts(&self, triangle: &[Corner; 3], places: [Point; 3]) -> Vec<([Point; 3], u8)> {
        let middle = |a: Point, b: Point| (0.5 * (a.0 + b.0), 0.5 * (a.1 + b.1));
        let status = |corner: &Corner| match corner.as_slice() {
            [node] => Some(self.status[*node]),
            _ => None,
        };
        let centre = triangle.iter().position(|corner| corner.len() > 1).map_or_else(
            || (places.iter().map(|p| p.0).sum::<f64>() / 3.0, places.iter().map(|p| p.1).sum::<f64>() / 3.0),
            |k| places[k],
        );
        let mut parts = Vec::with_capacity(6);
        for k in 0..3 {
            let next = (k + 1) % 3;
            let (Some(a), Some(b)) = (status(&triangle[k]), status(&triangle[next])) else { continue };
            let half = middle(places[k], places[next]);
            parts.push(([places[k], half, centre], a));
            parts.push(([half, places[next], centre], b));
        }
        parts
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bodies::view::InterfaceFields;

    /// Two faces that face -y, one of them behind the other as seen from there.
    fn surface() -> InterfaceMesh {
        let at = |y: f64| [[0.0, y, 0.0], [1.0, y, 0.0], [1.0, y, 1.0], [0.0, y, 1.0]];
        InterfaceMesh {
            in_space: true,
            positions: at(0.0).into_iter().chain(at(2.0)).collect(),
            faces: vec![vec![0, 1, 2, 3], vec![4, 5, 6, 7]],
            ..InterfaceMesh::default()
        }
    }

    #[test]
    fn a_surface_is_seen_along_the_axis_that_it_faces_with_the_nearest_faces_on_top() {
        let flat = FlatSurface::from_interface(&surface()).unwrap();
        assert_eq!(flat.axes, [0, 2]);
        // The face at y = 0 is nearer to y = -1 than that at y = 2, and is drawn last.
        let panel = Panel::new(&flat.mesh, AT, ROOM, ["x", "z"]).unwrap();
        assert_eq!(panel.triangles().last().unwrap()[2], [0, 1, 2, 3]);
        let behind = InterfaceMesh { in_space: false, ..surface() };
        assert!(FlatSurface::from_interface(&behind).is_none());
    }

    #[test]
    fn each_part_of_a_face_has_the_status_of_its_nearest_node() {
        let flat = FlatSurface::from_interface(&surface()).unwrap();
        let values = vec![0.0; 8];
        let fields = InterfaceFields {
            gap: vec![f64::INFINITY; 8],
            mean_normal_traction: values.clone(),
            mean_shear_traction: values.clone(),
            slip: values.clone(),
            friction_work: values,
            status: vec![0, 1, 2, 1, 0, 0, 0, 0],
            ..InterfaceFields::default()
        };
        let end = StageEnd { name: "s".into(), interfaces: vec![fields], ..StageEnd::default() };
        let map = ContactMap::new("f".into(), "i", &end, 0, (&flat, 0), false).unwrap();
        assert!(map.fits(8) && map.quantities[2].values.iter().all(|gap| gap.is_nan()));
        let triangle = [vec![0], vec![1], vec![0, 1, 2, 3]];
        let parts = map.parts(&triangle, [(0.0, 0.0), (2.0, 0.0), (1.0, 1.0)]);
        let expected = [([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)], 0), ([(1.0, 0.0), (2.0, 0.0), (1.0, 1.0)], 1)];
        assert_eq!(parts, expected);
        assert!(map.figure("t", &flat.mesh).is_some());
    }
}
