//! Catalogue of events of faults and interfaces: its entries, and the table of them.

use asperity_cycles::Rupture;
use asperity_cycles::heat::TEMPERATURE;
use asperity_output::decimals::shortest;
use asperity_output::formats::catalogues::SourceParameters;
use asperity_output::tables::column::{self, Column, Sign};
use asperity_output::tables::describe::FileParts;
use asperity_output::{OutputError, OutputFile, atomic, stems};
use asperity_plan::shared::words::time;
use asperity_run::{Event, EventHead, SlipPoints};
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

/// An event in the catalogue.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Entry {
    /// Onset \[s\].
    pub onset: f64,
    /// Time since the onset of the previous event \[s\].
    pub interval: Option<f64>,
    /// Duration: time until all points are slower than the rate that ends events \[s\].
    pub duration: f64,
    /// End: onset plus duration \[s\].
    pub end: f64,
    /// Part of the duration in which the fastest point was faster than the rate that begins events \[s\], as defined by the SEAS community.
    pub duration_above: f64,
    /// Largest slip rate \[m/s\].
    pub peak_rate: f64,
    /// Fault or interface that contains the hypocentre.
    pub surface: String,
    /// Distance of the hypocentre along the fault \[m\]; not defined in 3D and on interfaces.
    pub hypocentre_along: Option<f64>,
    /// Coordinates of the hypocentre \[m\].
    pub hypocentre: [f64; 3],
    /// Largest slip \[m\].
    pub largest_slip: f64,
    /// Mean slip over the points that slipped more than a hundredth of the largest slip \[m\].
    pub mean_slip: f64,
    /// Area of these points \[m²; m per metre of thickness\].
    pub area: f64,
    /// Moment ∫ G slip dA \[N m; N per metre of thickness\]; for vector slip, that of the sum of its moment tensors.
    pub moment: f64,
    /// Moment magnitude; absent in the plane if the length out of it is unknown.
    pub magnitude: Option<f64>,
    /// Distance between the outermost of these points along strike, in the plane along the fault \[m\]; absent where it is not
    /// defined.
    pub rupture_length: Option<f64>,
    /// Mean drop of shear traction over these points, weighted by slip \[Pa\].
    pub stress_drop: f64,
    /// Largest temperature, if friction heats the fault \[K\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_temperature: Option<f64>,
    /// Unit vector of ∫ G slip dA, for vector slip.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub direction: Option<[f64; 3]>,
    /// Angle from `rake` to mean slip, for vector slip, positive towards normal x `rake` \[degrees\].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub turned: Option<f64>,
    /// Seismological parameters, if the scene has a geographic frame.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub located: Option<SourceParameters>,
}

/// Share of the largest slip above which a point counts as slipped.
const SLIPPED: f64 = 0.01;

impl Entry {
    /// Entry of an event on some ground, restricted to these points.
    #[must_use]
    pub fn from_event(ground: &dyn SlipPoints, event: &Event<Rupture>, points: &Range<usize>) -> Self {
        let slip = |p: usize| event.details.slip.size(p);
        let slipped = slipped(event, points);
        let over = |value: &dyn Fn(usize) -> f64| {
            slipped.iter().map(|&p| value(p) * ground.site(p).area).sum::<f64>()
        };
        let (area, potency) = (over(&|_| 1.0), over(&slip));
        // A drop is positive if a traction that drives slip decreases.
        let work =
            |p: usize| event.details.slip.at(p).zip(event.details.drop.at(p)).map(|(s, t)| s * t).sum();
        let place = ground.site(event.details.hypocentre);
        Self {
            onset: event.onset.seconds(),
            interval: event.interval,
            duration: event.duration().unwrap_or(f64::NAN),
            end: event.end_time().unwrap_or(f64::NAN),
            duration_above: event.details.above,
            peak_rate: event.peak,
            surface: ground.source(event.details.hypocentre),
            hypocentre_along: place.along,
            hypocentre: place.at,
            largest_slip: points.clone().map(slip).fold(0.0, f64::max),
            mean_slip: potency / area,
            area,
            moment: over(&|p| ground.site(p).shear_modulus * slip(p)),
            magnitude: None,
            rupture_length: None,
            stress_drop: over(&work) / potency,
            largest_temperature: event.details.largest(&TEMPERATURE),
            direction: None,
            turned: None,
            located: None,
        }
    }

    /// Head of the event, which catalogues of other kinds have, too.
    fn head(&self) -> EventHead<'_> {
        EventHead {
            onset: self.onset,
            duration: Some(self.duration),
            end: Some(self.end),
            interval: self.interval,
            peak_rate: self.peak_rate,
            stress_drop: Some(self.stress_drop),
            surface: &self.surface,
        }
    }
}

/// Points that slipped in an event, among these.
#[must_use]
pub fn slipped(event: &Event<Rupture>, points: &Range<usize>) -> Vec<usize> {
    let slip = |p: usize| event.details.slip.size(p);
    let largest = points.clone().map(slip).fold(0.0, f64::max);
    points.clone().filter(|&p| slip(p) > SLIPPED * largest).collect()
}

/// Catalogue of one of several faults or interfaces, with events detected by its own fastest point and with its own slip.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FaultEvents {
    /// Fault or interface.
    pub surface: String,
    /// Its events.
    pub events: Vec<Entry>,
    /// Onset of an event in progress at the end \[s\].
    pub under_way: Option<f64>,
}

/// An event that began at this time \[s\] and had not ended at the end of a run, in a line.
#[must_use]
pub fn unended(onset: f64) -> String {
    format!("an event that began at {} had not ended: it is in no catalogue", time(onset))
}

/// The catalogue of all faults, interfaces or sliders.
pub const FILE: OutputFile = OutputFile::new("events.csv", "catalogue of events").with_each_end();
/// Catalogues of single faults or interfaces.
pub const OF_ONE: OutputFile =
    OutputFile::new("events_*.csv", "catalogue of the events of one fault or interface").with_each_end();
/// The catalogue of slow events.
pub const SLOW: OutputFile = OutputFile::new("slow_events.csv", "catalogue of slow events").with_each_end();
/// All tables of a catalogue.
pub const FILES: [OutputFile; 3] = [FILE, OF_ONE, SLOW];

/// Value as text; empty where there is none.
fn optional(value: Option<f64>) -> String {
    value.map(shortest).unwrap_or_default()
}

/// Writer of a number.
type NumberText = fn(f64) -> String;

/// A first column of every catalogue, and its cell.
struct HeadColumn {
    name: &'static str,
    unit: &'static str,
    sign: Sign,
    meaning: &'static str,
    /// Cell of an event, whose numbers other than times of the run are written like this.
    cell: fn(&EventHead<'_>, NumberText) -> String,
}

/// First columns of the catalogues of all kinds of run.
const HEAD: [HeadColumn; 7] = [
    HeadColumn {
        name: "onset",
        unit: "s",
        sign: Sign::None,
        meaning: "time of onset",
        cell: |e, _| moment(e.onset),
    },
    HeadColumn {
        name: "duration",
        unit: "s",
        sign: Sign::None,
        meaning: "time until all points are slower than the rate that ends events",
        cell: |e, number| e.duration.map(number).unwrap_or_default(),
    },
    HeadColumn {
        name: "interval",
        unit: "s",
        sign: Sign::None,
        meaning: "time since the onset of the event before",
        cell: |e, number| e.interval.map(number).unwrap_or_default(),
    },
    HeadColumn {
        name: "peak_rate",
        unit: "m/s",
        sign: Sign::Size,
        meaning: "largest slip rate",
        cell: |e, number| number(e.peak_rate),
    },
    HeadColumn {
        name: "stress_drop",
        unit: "Pa",
        sign: Sign::Fall,
        meaning: "drop of shear traction, weighted by slip",
        cell: |e, number| e.stress_drop.map(number).unwrap_or_default(),
    },
    HeadColumn {
        name: "surface",
        unit: "",
        sign: Sign::None,
        meaning: "fault, interface or slider of the hypocentre",
        cell: |e, _| quoted(e.surface),
    },
    HeadColumn {
        name: "end",
        unit: "s",
        sign: Sign::None,
        meaning: "time at which the duration ends",
        cell: |e, _| e.end.map(moment).unwrap_or_default(),
    },
];

/// A time of the run as text.
fn moment(time: f64) -> String {
    format!("{time:.14e}")
}

/// A name as a CSV field.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_string()
    }
}

/// First columns of every catalogue.
pub fn head_columns() -> impl Iterator<Item = Column> {
    HEAD.iter().map(|column| Column::new(column.name, column.unit, column.sign, column.meaning))
}

/// First cells of an event in every catalogue, with its numbers written like this.
#[must_use]
pub fn head_cells(event: &EventHead<'_>, number: NumberText) -> String {
    HEAD.iter().map(|column| (column.cell)(event, number)).collect::<Vec<_>>().join(",")
}

/// Columns of a catalogue of events; further ones where friction heats faults, scenes have a place on Earth or slip may turn.
#[must_use]
pub fn columns(events: &[Entry]) -> Vec<Column> {
    let mut all: Vec<Column> = head_columns().collect();
    all.push(Column::new("hypocentre_along", "m", Sign::None, "distance of the hypocentre along the fault"));
    all.extend(column::position());
    all.extend([
        Column::new("largest_slip", "m", Sign::Size, "largest slip"),
        Column::new("mean_slip", "m", Sign::Size, "mean slip over the points that slipped"),
        Column::new("area", "m2 or m", Sign::Size, "area of the points that slipped"),
        Column::new("moment", "N m or N", Sign::Size, "moment"),
        Column::new("duration_above", "s", Sign::None, "time above the rate that begins events"),
        Column::new("magnitude", "", Sign::None, "moment magnitude"),
        Column::new("rupture_length", "m", Sign::None, "distance between the outermost points that slipped"),
    ]);
    if events.iter().any(|e| e.largest_temperature.is_some()) {
        all.push(Column::new("largest_temperature", "K", Sign::None, "largest temperature"));
    }
    if events.iter().any(|e| e.located.is_some()) {
        all.extend([
            Column::new("latitude", "deg", Sign::None, "latitude of the hypocentre"),
            Column::new("longitude", "deg", Sign::None, "longitude of the hypocentre"),
            Column::new("depth", "m", Sign::None, "depth of the hypocentre"),
        ]);
    }
    if events.iter().any(|e| e.turned.is_some()) {
        all.extend(column::axes("direction", "", Sign::Vector, "direction of the mean slip"));
        all.push(Column::new("turned", "deg", Sign::None, "angle from the rake to the mean slip"));
    }
    all
}

/// The tables of a catalogue with their columns.
#[must_use]
pub fn tables(events: &[Entry]) -> Vec<FileParts<Column>> {
    FILES.map(|file| FileParts::new(file.path, columns(events))).into()
}

/// Catalogue as CSV.
#[must_use]
pub fn csv(events: &[Entry]) -> String {
    let mut text = column::header(&columns(events));
    let placed = events.iter().any(|e| e.located.is_some());
    for e in events {
        let _ = write!(
            text,
            "{},{},{},{},{},{},{},{},{:e},{},{},{}",
            head_cells(&e.head(), shortest),
            e.hypocentre_along.map(shortest).unwrap_or_default(),
            shortest(e.hypocentre[0]),
            shortest(e.hypocentre[1]),
            shortest(e.hypocentre[2]),
            e.largest_slip,
            e.mean_slip,
            e.area,
            e.moment,
            e.duration_above,
            optional(e.magnitude),
            optional(e.rupture_length)
        );
        let mut further: Vec<Option<f64>> = e.largest_temperature.iter().copied().map(Some).collect();
        if placed {
            let spot = e.located.as_ref().map(|l| &l.hypocentre);
            further.extend([spot.map(|s| s.latitude), spot.map(|s| s.longitude), spot.map(|s| s.depth)]);
        }
        further.extend(e.direction.iter().flatten().chain(&e.turned).copied().map(Some));
        for value in further {
            text.push(',');
            text.push_str(&optional(value));
        }
        text.push('\n');
    }
    text
}

/// Writes the catalogue of all faults or interfaces as a table, and one table of each if there are several.
///
/// # Errors
/// If a file cannot be written.
pub fn write(path: &Path, all: &[Entry], apart: &[FaultEvents]) -> Result<(), OutputError> {
    let table = |name: &str, events: &[Entry]| atomic::write(&path.join(name), csv(events).as_bytes());
    table(FILE.path, all)?;
    let names = stems(apart.iter().map(|f| f.surface.as_str()));
    let mut each = names.iter().zip(apart);
    each.try_for_each(|(name, fault)| table(&OF_ONE.named(name), &fault.events))
}
