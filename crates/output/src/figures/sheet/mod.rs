//! The figures of a run: what they need beside the tables of the run, kept in its output directory, and the drawing of them. A
//! run draws its figures from what it has written, so that they can be drawn again without it.

mod curves;
mod event;
mod request;
mod stills;
mod tables;

pub use curves::{Curves, Points};
pub use event::EventOnset;
pub use request::{FigureRequest, Format};
pub use stills::{Still, Stills};

use super::contact_map::ContactMap;
use super::curves::Histories;
use super::cycles::{Cycles, Line, Portrait};
use super::field::{self, MapTitle, VisibleMesh};
use super::figure::Figure;
use super::ground::{Coordinates, GroundMap, MapQuantity};
use super::panel::EventPanel;
use super::paper::Paper;
use super::profile::Tractions;
use super::rupture::{self, EventOnFault, RupturedFault, Ruptures, Shape, VelocityFrame};
use crate::{OutputError, PaintError, atomic, json, numbers};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::ops::Range;
use std::path::{Path, PathBuf};
use tables::Tables;

/// Version of what is kept.
const VERSION: u32 = 1;

/// Reason why a text is no sheet that this version reads.
#[derive(Debug, thiserror::Error)]
pub enum SheetError {
    /// Text that is none.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// Another version.
    #[error("it has version {0}, and this program reads version {VERSION}")]
    Version(u32),
    /// Plots of parts that it lacks.
    #[error("it refers to parts that it does not have")]
    Incomplete,
}

/// Data that the figures of a run need beside its tables.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Sheet {
    version: u32,
    /// Title of the scene.
    pub title: String,
    /// Times of the start and the end of the run \[s\].
    pub span: [f64; 2],
    /// True if faults are surfaces.
    pub in_space: bool,
    /// Faults as figures show them, to which plots refer by number.
    pub shapes: Vec<Shape>,
    /// Visible parts of meshes, to which plots refer by number.
    pub meshes: Vec<VisibleMesh>,
    /// Plots.
    pub plots: Vec<Plot>,
}

/// A plot, of one figure or several.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub enum Plot {
    /// Curves.
    Curves(Curves),
    /// Faults through earthquake cycles.
    Cycles(FaultCycles),
    /// A fault in an event.
    Event(EventFault),
    /// A fault in space at chosen times.
    Stills(Stills),
    /// Displacement of the ground over an event.
    Ground(Ground),
    /// Magnitudes of events.
    Panel(EventPanel),
    /// Dynamic rupture of faults.
    Ruptures(Vec<Fault>),
    /// Velocity of bodies.
    Velocities(Velocities),
    /// Stress of bodies at the end of a stage.
    Mises(Mises),
    /// Histories at the probes of an interface.
    Histories(Histories),
    /// Tractions along an interface.
    Tractions(Tractions),
    /// Maps over an interface in space.
    Contact(ContactMap),
}

/// Faults through earthquake cycles, from the tables of the run.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FaultCycles {
    /// Faults along lines.
    pub lines: Vec<Line>,
    /// Times of onset and end of the events \[s\].
    pub events: Vec<[f64; 2]>,
    /// Time between slip contours, between events and during events, as text.
    pub intervals: [String; 2],
    /// The same in seconds.
    #[serde(default)]
    pub spacing: Option<[f64; 2]>,
    /// Names and times of the profiles of coupling that are shown \[s\].
    #[serde(default)]
    pub chosen: Vec<(String, f64)>,
    /// Stations of the phase portrait: those that slip in events.
    #[serde(default)]
    pub stations: Vec<Portrait>,
}

/// A fault with its rupture times.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Fault {
    /// Name.
    pub name: String,
    /// Range of its points in profiles.
    pub points: Range<usize>,
    /// Number of its shape.
    pub shape: usize,
    /// Rupture times of its points \[s\]; NaN where it did not rupture.
    #[serde(deserialize_with = "numbers::or_nan")]
    pub arrivals: Vec<f64>,
}

/// A fault in an event.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct EventFault {
    /// Stem of the file names.
    pub stem: String,
    /// The event.
    pub event: EventOnset,
    /// The fault with its rupture times since the onset.
    pub fault: Fault,
    /// Slip of its points, or of the faces of its surface \[m\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub slip: Vec<f64>,
    /// Hypocentre in the coordinates of the surface, if it is on this fault.
    #[serde(default)]
    pub hypocentre: Option<(f64, f64)>,
}

/// Displacement of the ground over an event, from a table.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Ground {
    /// Stem of the file names.
    pub file: String,
    /// The event.
    pub event: EventOnset,
    /// Unit of the coordinates.
    pub coordinates: Coordinates,
    /// Names and values of the coordinates, to the right and up.
    pub axes: [(String, Vec<f64>); 2],
    /// Path of the table.
    pub table: String,
    /// Quantity in colours.
    pub shown: MapQuantity,
    /// Column of the quantity in colours; of displacements, that out of the page.
    pub colours: usize,
    /// Columns of the displacements to the right and up the page, which are arrows.
    pub arrows: Option<[usize; 2]>,
    /// Edges of the faults.
    pub edges: Vec<[(f64, f64); 2]>,
}

/// Magnitudes of the velocity at the nodes of a mesh at some times.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Velocities {
    /// Number of the mesh.
    pub mesh: usize,
    /// Times \[s\] and velocities \[m/s\].
    pub frames: Vec<(f64, Vec<f64>)>,
}

/// Mises stress at the end of a stage.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Mises {
    /// Stem of the file names.
    pub file: String,
    /// Name of the stage.
    pub stage: String,
    /// Its end, or the time at which the run stopped in it \[s\].
    pub time: f64,
    /// True if the run stopped in it.
    #[serde(default)]
    pub stopped: bool,
    /// Number of the mesh.
    pub mesh: usize,
    /// Stress at its nodes \[Pa\].
    #[serde(deserialize_with = "numbers::or_nan")]
    pub values: Vec<f64>,
}

type NamedFigures = Vec<(String, Figure)>;

impl Sheet {
    /// Name of the file in the output directory.
    pub const FILE: &'static str = "plots.json";

    /// A sheet without plots of a run over a span of time \[s\].
    #[must_use]
    pub fn new(title: &str, span: [f64; 2], in_space: bool) -> Self {
        let (shapes, meshes, plots) = (Vec::new(), Vec::new(), Vec::new());
        Self { version: VERSION, title: title.into(), span, in_space, shapes, meshes, plots }
    }

    /// Writes the sheet into an output directory.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<(), OutputError> {
        let path = folder.join(Self::FILE);
        let text = json::compact(self).map_err(|e| OutputError::write(&path, e.into()))?;
        atomic::write(&path, text.as_bytes())
    }

    /// Reads a sheet.
    ///
    /// # Errors
    /// [`SheetError`].
    pub fn parse(text: &str) -> Result<Self, SheetError> {
        #[derive(Deserialize)]
        struct Head {
            version: u32,
        }
        let head: Head = serde_json::from_str(text)?;
        if head.version != VERSION {
            return Err(SheetError::Version(head.version));
        }
        let sheet: Self = serde_json::from_str(text)?;
        if sheet.is_whole() { Ok(sheet) } else { Err(SheetError::Incomplete) }
    }

    /// True if all parts that plots refer to are there.
    fn is_whole(&self) -> bool {
        let fault = |f: &Fault| match self.shapes.get(f.shape) {
            Some(Shape::Line(line)) => f.arrivals.len() == line.along.len(),
            Some(Shape::Surface(surface)) => f.arrivals.len() == surface.places.len(),
            None => false,
        };
        self.plots.iter().all(|plot| match plot {
            Plot::Event(event) => {
                let by_face = match self.shapes.get(event.fault.shape) {
                    Some(Shape::Surface(surface)) => surface.faces.len() == event.slip.len(),
                    _ => false,
                };
                fault(&event.fault) && (by_face || event.slip.len() == event.fault.arrivals.len())
            }
            Plot::Stills(stills) => matches!(self.shapes.get(stills.shape), Some(Shape::Surface(_))),
            Plot::Ruptures(faults) => faults.iter().all(fault),
            Plot::Velocities(shown) => self
                .meshes
                .get(shown.mesh)
                .is_some_and(|mesh| shown.frames.iter().all(|frame| frame.1.len() == mesh.nodes())),
            Plot::Mises(shown) => {
                self.meshes.get(shown.mesh).is_some_and(|m| m.nodes() == shown.values.len())
            }
            Plot::Contact(map) => self.meshes.get(map.mesh).is_some_and(|m| map.fits(m.nodes())),
            _ => true,
        })
    }

    /// Number of a shape, which is added unless it is there.
    pub fn shape(&mut self, shape: Shape) -> usize {
        let found = self.shapes.iter().position(|other| *other == shape);
        found.unwrap_or_else(|| {
            self.shapes.push(shape);
            self.shapes.len() - 1
        })
    }

    /// Number of a visible part of a mesh, which is added unless it is there.
    pub fn mesh(&mut self, mesh: VisibleMesh) -> usize {
        let found = self.meshes.iter().position(|other| *other == mesh);
        found.unwrap_or_else(|| {
            self.meshes.push(mesh);
            self.meshes.len() - 1
        })
    }

    /// Numbers of the events with figures of their own, from 1.
    #[must_use]
    pub fn events(&self) -> Vec<usize> {
        let mut numbers: Vec<usize> = self.plots.iter().filter_map(|p| Some(p.event()?.number + 1)).collect();
        numbers.sort_unstable();
        numbers.dedup();
        numbers
    }

    /// Names of all figures whose tables can be read.
    #[must_use]
    pub fn names(&self, tables: &Path) -> Vec<String> {
        let request = FigureRequest::default();
        self.plots
            .iter()
            .flat_map(|plot| self.figures(plot, tables, &request).0)
            .map(|figure| figure.0)
            .collect()
    }

    /// Draws the figures that are asked for from the tables in one folder into another; returns the files in the order written.
    ///
    /// # Errors
    /// If a table cannot be read or a figure cannot be drawn or written.
    pub fn draw(
        &self,
        tables: &Path,
        folder: &Path,
        request: &FigureRequest,
    ) -> Result<Vec<PathBuf>, OutputError> {
        let (written, failed) = self.draw_what_can_be(tables, folder, request)?;
        failed.into_iter().next().map_or(Ok(written), Err)
    }

    /// Draws the figures that are asked for, except those whose tables cannot be read; returns the files in the order written, and
    /// why the others are missing.
    ///
    /// # Errors
    /// If a figure cannot be drawn or written.
    pub fn draw_what_can_be(
        &self,
        tables: &Path,
        folder: &Path,
        request: &FigureRequest,
    ) -> Result<(Vec<PathBuf>, Vec<OutputError>), OutputError> {
        atomic::create_dir(folder)?;
        // Each plot has files of its own.
        let drawn: Vec<_> =
            self.plots.par_iter().map(|plot| self.write_plot(plot, tables, folder, request)).collect();
        let (mut written, mut failed) = (Vec::new(), Vec::new());
        for drawn in drawn {
            let (files, missing) = drawn?;
            written.extend(files);
            failed.extend(missing);
        }
        Ok((written, failed))
    }

    /// Draws the figures of a plot that are asked for; see [`Self::draw_what_can_be`].
    fn write_plot(
        &self,
        plot: &Plot,
        tables: &Path,
        folder: &Path,
        request: &FigureRequest,
    ) -> Result<(Vec<PathBuf>, Vec<OutputError>), OutputError> {
        let (figures, failed) = self.figures(plot, tables, request);
        let (mut written, paper) = (Vec::new(), request.paper());
        for (name, figure) in figures.into_iter().filter(|(name, _)| request.wants(name)) {
            let figure = paper.filled(figure).scaled(request.shrinks());
            for format in &request.formats {
                let path = folder.join(format!("{name}.{}", format.ending()));
                let bytes = format.paint(&figure, request.dpi);
                let bytes = bytes.map_err(|reason| OutputError::Draw { path: path.clone(), reason })?;
                atomic::write(&path, &bytes)?;
                written.push(path);
            }
        }
        Ok((written, failed))
    }

    /// Figures of a plot, and why others are missing.
    fn figures(
        &self,
        plot: &Plot,
        folder: &Path,
        request: &FigureRequest,
    ) -> (NamedFigures, Vec<OutputError>) {
        if plot.event().is_some_and(|event| !request.takes(event)) {
            return (Vec::new(), Vec::new());
        }
        let tables = Tables { folder, request, in_space: self.in_space };
        if let Plot::Cycles(through) = plot {
            return self.cycles(through, &tables, request.paper());
        }
        match self.draw_one_table(plot, &tables) {
            Ok(figures) => (figures, Vec::new()),
            Err(why) => (Vec::new(), vec![why]),
        }
    }

    /// Figures of a plot that stands or falls with its tables.
    fn draw_one_table(&self, plot: &Plot, tables: &Tables<'_>) -> Result<NamedFigures, OutputError> {
        let request = tables.request;
        let paper = request.paper();
        let one =
            |name: &str, figure: Option<Figure>| figure.map(|f| (name.to_string(), f)).into_iter().collect();
        Ok(match plot {
            Plot::Curves(curves) => {
                let chart = curves.chart(tables)?;
                one(&curves.file, chart.figure(paper, curves.start(request)))
            }
            Plot::Cycles(_) => Vec::new(),
            Plot::Event(event) => self.in_event(event).figures(paper),
            Plot::Stills(stills) => self.stills(stills, tables, paper)?,
            Plot::Ground(ground) => one(&ground.file, self.ground(ground, tables)?.figure(paper)),
            Plot::Panel(panel) => one("events", windowed(panel, request).figure(paper)),
            Plot::Ruptures(faults) => {
                let faults = faults.iter().map(|f| self.fault(f)).collect();
                Ruptures { title: self.title.clone(), faults, rates: tables, paper }.figures()?
            }
            Plot::Velocities(shown) => self.velocities(shown, request, paper),
            Plot::Mises(shown) => one(&shown.file, self.mises(shown, request, paper)),
            Plot::Histories(histories) => histories.figures(paper, request.window),
            Plot::Tractions(tractions) => one(&tractions.file, tractions.figure(paper, request.window)),
            Plot::Contact(map) => {
                let mesh = self.meshes.get(map.mesh).filter(|_| request.shows(map.time));
                one(&map.file, mesh.and_then(|mesh| map.figure(&self.title, mesh)))
            }
        })
    }

    fn cycles(
        &self,
        through: &FaultCycles,
        tables: &Tables<'_>,
        paper: Paper,
    ) -> (NamedFigures, Vec<OutputError>) {
        let FaultCycles { lines, events, intervals, spacing, chosen, stations } = through.clone();
        let request = tables.request;
        let events = match request.window {
            Some([from, to]) => events.into_iter().filter(|e| e[1] >= from && e[0] <= to).collect(),
            None => events,
        };
        Cycles {
            title: self.title.clone(),
            lines,
            rows: tables,
            events,
            intervals,
            spacing,
            chosen: chosen.into_iter().filter(|(_, time)| request.shows(*time)).collect(),
            stations,
            window: request.window,
            paper,
        }
        .figures()
    }

    fn fault(&self, fault: &Fault) -> RupturedFault {
        let Fault { name, points, shape, arrivals } = fault.clone();
        RupturedFault { name, points, shape: self.shapes[shape].clone(), arrivals }
    }

    fn in_event(&self, event: &EventFault) -> EventOnFault {
        let (stem, title) = (event.stem.clone(), self.event_title(&event.event));
        let (slip, hypocentre) = (event.slip.clone(), event.hypocentre);
        EventOnFault { stem, title, fault: self.fault(&event.fault), slip, hypocentre }
    }

    fn event_title(&self, event: &EventOnset) -> String {
        format!("{}, event {}", self.title, event.number + 1)
    }

    fn ground(&self, ground: &Ground, tables: &Tables<'_>) -> Result<GroundMap, OutputError> {
        let (mut horizontal, mut vertical) = (Vec::new(), Vec::new());
        tables.each(&ground.table, &mut |row| {
            let at = |column: usize| row.get(column).copied().unwrap_or(f64::NAN);
            horizontal.push(ground.arrows.map_or([0.0; 2], |columns| columns.map(at)));
            vertical.push(at(ground.colours));
        })?;
        let Ground { coordinates, axes, shown, edges, .. } = ground.clone();
        let expected = axes[0].1.len() * axes[1].1.len();
        if vertical.len() != expected {
            let reason = PaintError::Rows { found: vertical.len(), expected };
            return Err(OutputError::Draw { path: tables.folder.join(&ground.table), reason });
        }
        let title = self.event_title(&ground.event);
        Ok(GroundMap { title, coordinates, axes, shown, horizontal, vertical, edges })
    }

    fn velocities(&self, shown: &Velocities, request: &FigureRequest, paper: Paper) -> NamedFigures {
        let Some(mesh) = self.meshes.get(shown.mesh) else { return Vec::new() };
        let last = shown.frames.last().map_or(1.0, |frame| frame.0);
        let room = paper.frame(field::LARGE, field::MARGINS);
        let within = || shown.frames.iter().enumerate().filter(|(_, frame)| request.shows(frame.0));
        let one = |(k, (time, values)): (usize, &(f64, Vec<f64>))| {
            let when = format!("t = {}", rupture::moment(*time, last));
            let title = MapTitle { scene: &self.title, when: &when };
            Some((format!("velocity_{k}"), field::velocity(title, mesh, values, room)?))
        };
        let mut figures: NamedFigures = within().filter_map(one).collect();
        let frames: Vec<VelocityFrame<'_>> =
            within().map(|(_, (time, values))| VelocityFrame { time: *time, values }).collect();
        let strip = rupture::velocities(&self.title, mesh, &frames, paper);
        figures.extend(strip.map(|figure| ("velocity_film".to_string(), figure)));
        figures
    }

    fn mises(&self, shown: &Mises, request: &FigureRequest, paper: Paper) -> Option<Figure> {
        let mesh = self.meshes.get(shown.mesh).filter(|_| request.shows(shown.time))?;
        let place = if shown.stopped { "last step in" } else { "end of" };
        let when = format!("{place} stage “{}”", shown.stage);
        let room = paper.frame(field::LARGE, field::MARGINS);
        field::mises(Some(MapTitle { scene: &self.title, when: &when }), mesh, &shown.values, room)
    }
}

/// The events of a panel within the window.
fn windowed(panel: &EventPanel, request: &FigureRequest) -> EventPanel {
    let Some([start, end]) = request.window else { return panel.clone() };
    let within = |(name, events): &(String, Vec<super::PanelEvent>)| {
        (name.clone(), events.iter().filter(|e| request.shows(e.onset)).copied().collect())
    };
    EventPanel { start, end, title: panel.title.clone(), groups: panel.groups.iter().map(within).collect() }
}

impl Plot {
    /// The event of a plot of a single event.
    fn event(&self) -> Option<&EventOnset> {
        match self {
            Self::Curves(curves) => curves.event.as_ref(),
            Self::Event(event) => Some(&event.event),
            Self::Ground(ground) => Some(&ground.event),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::rupture::{Line as Along, Shape};
    use super::*;

    fn sheet() -> Sheet {
        let mut sheet = Sheet::new("t", [0.0, 9.0], false);
        let along = Along { label: "x".into(), along: vec![0.0, 1.0], down: false };
        let shape = sheet.shape(Shape::Line(along.clone()));
        assert_eq!(shape, sheet.shape(Shape::Line(along)));
        let fault = Fault { name: "f".into(), points: 0..2, shape, arrivals: vec![f64::NAN, 0.1 + 0.2] };
        let event = |number, onset| {
            Plot::Event(EventFault {
                stem: format!("f_event_{number:03}"),
                event: EventOnset { number, onset },
                fault: fault.clone(),
                slip: vec![1.0, f64::NAN],
                hypocentre: None,
            })
        };
        sheet.plots = vec![event(0, 2.0), event(2, 8.0)];
        sheet
    }

    fn read(folder: &Path) -> Result<Sheet, SheetError> {
        Sheet::parse(&std::fs::read_to_string(folder.join(Sheet::FILE)).unwrap())
    }

    #[test]
    fn a_sheet_is_read_back_to_the_last_digit() {
        let folder = tempfile::tempdir().unwrap();
        sheet().write(folder.path()).unwrap();
        let back = read(folder.path()).unwrap();
        assert_eq!(format!("{back:?}"), format!("{:?}", sheet()));
        assert_eq!(back.events(), [1, 3]);
    }

    #[test]
    fn a_sheet_that_refers_to_what_it_has_not_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let mut broken = sheet();
        broken.shapes.clear();
        broken.write(folder.path()).unwrap();
        assert!(matches!(read(folder.path()), Err(SheetError::Incomplete)));
        let mut broken = sheet();
        if let Plot::Event(event) = &mut broken.plots[0] {
            event.slip.pop();
        }
        broken.write(folder.path()).unwrap();
        assert!(read(folder.path()).is_err());
    }

    #[test]
    fn figures_of_events_are_chosen_by_number_and_by_onset() {
        let folder = tempfile::tempdir().unwrap();
        let drawn = |request: FigureRequest| {
            let files = sheet().draw(folder.path(), folder.path(), &request).unwrap();
            files.iter().map(|f| f.file_name().unwrap().to_str().unwrap().to_string()).collect::<Vec<_>>()
        };
        let svg = FigureRequest { formats: vec![Format::Svg], ..FigureRequest::default() };
        assert_eq!(drawn(svg.clone()), ["f_event_000_rupture_times.svg", "f_event_002_rupture_times.svg"]);
        let third = ["f_event_002_rupture_times.svg"];
        assert_eq!(drawn(FigureRequest { events: vec![3], ..svg.clone() }), third);
        assert_eq!(drawn(FigureRequest { window: Some([3.0, 9.0]), ..svg.clone() }), third);
        assert_eq!(drawn(FigureRequest { window: Some([3.0, 7.0]), ..svg }), Vec::<String>::new());
    }
}
