//! The command `plot`: figures of a run, drawn again from its output directory.

use super::end::End;
use super::status::{self, State};
use asperity_output::figures::{FigureRequest, Format, Sheet};
use asperity_output::terminal::printing::{self, out};
use asperity_output::words::time as words;
use asperity_plan::reading::scene::suggestions::suggest;
use asperity_plan::reading::scene::units::Time;
use clap::{Args, ValueEnum};
use miette::{IntoDiagnostic, miette};
use serde::Deserialize;
use serde::de::value::StrDeserializer;
use std::path::{Path, PathBuf};

/// Figures that are wanted, and their form.
#[derive(Clone, Debug, Args)]
pub struct Redrawing {
    /// Output directory of a run that has ended.
    directory: PathBuf,
    /// Names of figures, such as `largest_rate`, or their files; all by default.
    #[arg(value_name = "FIGURE")]
    figures: Vec<String>,
    /// Folder to write the figures to; the folder `plots` of the directory by default.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print the names of the figures and draw none.
    #[arg(long)]
    list: bool,
    /// Width and height in mm, cm or in, such as `170x110mm`; texts keep their size.
    #[arg(long, value_name = "WIDTHxHEIGHT", value_parser = size)]
    size: Option<Size>,
    /// Pixels per inch of PNG files; those of a run have 192.
    #[arg(long, value_name = "N", value_parser = dpi)]
    dpi: Option<f64>,
    /// Formats, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "svg,png")]
    format: Vec<Ending>,
    /// First time shown, such as "150 yr".
    #[arg(long, value_name = "TIME", value_parser = time)]
    from: Option<f64>,
    /// Last time shown.
    #[arg(long, value_name = "TIME", value_parser = time)]
    to: Option<f64>,
    /// Numbers of events, from 1, separated by commas: of the figures of single events, draw those of these events only.
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', value_parser = clap::value_parser!(u32).range(1..))]
    events: Vec<u32>,
}

/// Formats of figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Ending {
    /// Scalable Vector Graphics.
    Svg,
    /// Portable Network Graphics.
    Png,
    /// Portable Document Format.
    Pdf,
}

/// Width and height \[mm\].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Size([f64; 2]);

/// Names and lengths of units of paper \[mm\].
const UNITS: [(&str, f64); 3] = [("mm", 1.0), ("cm", 10.0), ("in", 25.4)];
/// Largest width and height \[mm\]: a poster.
const LARGEST: f64 = 1200.0;
/// Least and largest number of pixels per inch.
const DPI: (f64, f64) = (36.0, 1200.0);
/// Most pixels of a figure: drawing one takes about ten bytes for each.
const PIXELS: f64 = 1e8;
/// Size of the largest figures of a run \[mm\].
const USUAL: [f64; 2] = [240.0, 150.0];

/// Parses a size of paper.
fn size(text: &str) -> Result<Size, String> {
    let wrong = || "a size is a width and a height in mm, cm or in, such as `170x110mm`".to_string();
    let lower = text.to_lowercase();
    let (width, height) = lower.split_once(['x', '×']).ok_or_else(wrong)?;
    let read = |part: &str| {
        let part = part.trim();
        let unit = UNITS.iter().find(|(name, _)| part.ends_with(name));
        let number = unit.map_or(part, |(name, _)| part.trim_end_matches(name)).trim().parse::<f64>();
        number.ok().map(|number| (number, unit.map(|unit| unit.1)))
    };
    let ((width, own), (height, unit)) = read(width).zip(read(height)).ok_or_else(wrong)?;
    let unit = unit.ok_or_else(wrong)?;
    let size = [width * own.unwrap_or(unit), height * unit];
    let [least, low] = FigureRequest::SMALLEST;
    if !(size[0] >= least && size[1] >= low) {
        return Err(format!(
            "figures are at least {least} mm wide and {low} mm high: their texts are then as small as can be read"
        ));
    }
    if !size.iter().all(|length| *length <= LARGEST) {
        return Err(format!("figures are at most {LARGEST} mm wide and high"));
    }
    Ok(Size(size))
}

/// Parses a number of pixels per inch.
fn dpi(text: &str) -> Result<f64, String> {
    let (least, most) = DPI;
    let value = text.trim().parse::<f64>().ok().filter(|value| (least..=most).contains(value));
    value.ok_or_else(|| format!("it is a number from {least} to {most}"))
}

/// Parses a time in the notation of scenes.
fn time(text: &str) -> Result<f64, String> {
    let time = Time::deserialize(StrDeserializer::<serde::de::value::Error>::new(text));
    Ok(time.map_err(|e| e.to_string())?.0)
}

/// Draws the figures.
pub(super) fn execute(asked: &Redrawing) -> miette::Result<End> {
    let folder = &asked.directory;
    let sheet = sheet(folder)?;
    if asked.list {
        sheet.names(folder).iter().for_each(|name| out(format_args!("{name}\n")));
        return Ok(End::Done);
    }
    let wanted = wanted(asked, &sheet)?;
    let to = asked.out.clone().unwrap_or_else(|| folder.join("plots"));
    let (written, failed) = sheet.draw_what_can_be(folder, &to, &wanted).into_diagnostic()?;
    // One table may be missing for several figures.
    let mut reasons: Vec<String> = failed.iter().map(ToString::to_string).collect();
    reasons.dedup();
    for why in &reasons {
        printing::warning(&format!("some figures cannot be drawn: {why}"));
    }
    if written.is_empty() {
        return Err(miette!("nothing to draw: no figure has anything to show of what was asked for"));
    }
    out(format_args!("{} files in {}\n", written.len(), to.display()));
    Ok(End::Done)
}

/// Data that the figures of the run in a directory need beside its tables.
fn sheet(folder: &Path) -> miette::Result<Sheet> {
    let known = status::known(folder)?;
    let path = folder.join(Sheet::FILE);
    let text = match std::fs::read_to_string(&path) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => {
            let why = match known.state {
                State::Running => "the run has not ended, and writes what figures need at its end",
                State::Killed => {
                    "the run was killed before it wrote what figures need: `asperity run` with --resume continues it"
                }
                _ => {
                    "the run was begun with --no-plots, ended with an error, or was of an earlier version: run the scene again"
                }
            };
            return Err(miette!("{} has no {}: {why}", folder.display(), Sheet::FILE));
        }
        Err(error) => return Err(miette!("cannot read {}: {error}", path.display())),
    };
    Sheet::parse(&text).map_err(|why| miette!("{} cannot be read: {why}", path.display()))
}

/// Checks what is asked for against what there is.
fn wanted(asked: &Redrawing, sheet: &Sheet) -> miette::Result<FigureRequest> {
    let dpi = asked.dpi.unwrap_or(FigureRequest::DPI);
    let [width, height] = asked.size.map_or(USUAL, |size| size.0);
    let pixels = (width / 25.4 * dpi) * (height / 25.4 * dpi);
    if pixels > PIXELS {
        return Err(miette!(
            "{:.0} mm by {:.0} mm at {dpi} dpi are {:.0} million pixels, and figures have at most {:.0}: lower --dpi or --size, or use SVG or PDF",
            width,
            height,
            pixels / 1e6,
            PIXELS / 1e6
        ));
    }
    let mut formats = Vec::new();
    for format in &asked.format {
        let format = match format {
            Ending::Svg => Format::Svg,
            Ending::Png => Format::Png,
            Ending::Pdf => Format::Pdf,
        };
        if !formats.contains(&format) {
            formats.push(format);
        }
    }
    Ok(FigureRequest {
        names: names(asked, sheet)?,
        size: asked.size.map(|size| size.0),
        dpi,
        formats,
        window: window(asked, sheet)?,
        events: events(asked, sheet)?,
    })
}

/// Names of the figures, which may be given as files.
fn names(asked: &Redrawing, sheet: &Sheet) -> miette::Result<Vec<String>> {
    if asked.figures.is_empty() {
        return Ok(Vec::new());
    }
    let known = sheet.names(&asked.directory);
    let name = |given: &String| {
        let file = Path::new(given).file_name().map_or(given.clone(), |f| f.to_string_lossy().into_owned());
        let ends = [".svg", ".png", ".pdf"].into_iter().find_map(|end| file.strip_suffix(end));
        let name = ends.unwrap_or(&file).to_string();
        if known.contains(&name) {
            return Ok(name);
        }
        let help = suggest(&name, "figures", known.iter().map(String::as_str));
        Err(miette!("there is no figure `{name}`; {help}"))
    };
    asked.figures.iter().map(name).collect()
}

/// Times shown.
fn window(asked: &Redrawing, sheet: &Sheet) -> miette::Result<Option<[f64; 2]>> {
    if asked.from.is_none() && asked.to.is_none() {
        return Ok(None);
    }
    let [start, end] = sheet.span;
    let (from, to) = (asked.from.unwrap_or(start), asked.to.unwrap_or(end));
    // A time written with few digits may lie behind the end.
    let beyond = |time: f64| !(start..=end * (1.0 + ROUNDED)).contains(&time);
    for (option, time) in [("--from", from), ("--to", to)] {
        if beyond(time) {
            return Err(miette!(
                "{option}: the run lasts from {} to {}, and has no time {}",
                words(start),
                words(end),
                words(time)
            ));
        }
    }
    if from >= to {
        return Err(miette!(
            "--from is {} and --to {}: the first time must lie before the last",
            words(from),
            words(to)
        ));
    }
    Ok(Some([from, to]))
}

/// Relative difference of a time from the end of a run that counts as rounding of what a person wrote.
const ROUNDED: f64 = 0.005;

/// Events whose figures are wanted.
fn events(asked: &Redrawing, sheet: &Sheet) -> miette::Result<Vec<usize>> {
    let known = sheet.events();
    let wanted: Vec<usize> = asked.events.iter().map(|number| *number as usize).collect();
    if let Some(missing) = wanted.iter().find(|number| !known.contains(number)) {
        let there = match (known.first(), known.last()) {
            (Some(first), Some(last)) => format!("those of events {first} to {last} have"),
            _ => "none has".into(),
        };
        return Err(miette!("--events: event {missing} has no figures of its own; {there}"));
    }
    Ok(wanted)
}
