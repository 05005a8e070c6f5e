//! Grids in the classic netCDF format, and the finite-fault model, of an event of several cells: values by their coordinates.

use super::receivers::{DIP, STRIKE, rectangle, scene};
use crate::cases::run_files::{Table, WrittenRun};
use crate::{Capability, CaseError, Evidence, Ledger};

/// Length and width of the fault, and the size of its cells \[m\].
const SIZES: [f64; 3] = [6e3, 4e3, 2e3];

/// Tags of the format for lists, and its types for characters and numbers.
const DIMENSIONS: usize = 10;
const VARIABLES: usize = 11;
const ATTRIBUTES: usize = 12;

/// A variable: its name, dimensions and values.
struct Variable {
    name: String,
    dimensions: Vec<usize>,
    values: Vec<f64>,
}

/// A file in the classic format: dimensions with their lengths, and variables of 8-byte numbers.
struct Grid {
    dimensions: Vec<(String, usize)>,
    variables: Vec<Variable>,
}

/// The bytes of a file that are left to read.
struct Rest<'a>(&'a [u8], &'a [u8]);

impl Rest<'_> {
    fn take(&mut self, count: usize) -> Result<Vec<u8>, CaseError> {
        let (own, rest) = self.1.split_at_checked(count).ok_or("the file ends early")?;
        self.1 = rest;
        Ok(own.to_vec())
    }

    fn number(&mut self) -> Result<usize, CaseError> {
        let bytes: [u8; 4] = self.take(4)?.as_slice().try_into()?;
        Ok(u32::from_be_bytes(bytes) as usize)
    }

    /// Bytes of this count, which are filled up to a multiple of four.
    fn filled(&mut self, count: usize) -> Result<Vec<u8>, CaseError> {
        let mut bytes = self.take(count.next_multiple_of(4))?;
        bytes.truncate(count);
        Ok(bytes)
    }

    fn text(&mut self) -> Result<String, CaseError> {
        let length = self.number()?;
        Ok(String::from_utf8(self.filled(length)?)?)
    }

    /// Number of entries of a list, whose tag is that or zero.
    fn list(&mut self, tag: usize) -> Result<usize, CaseError> {
        match (self.number()?, self.number()?) {
            (found, count) if found == tag || count == 0 => Ok(count),
            _ => Err("another list".into()),
        }
    }

    /// Passes over attributes.
    fn attributes(&mut self) -> Result<(), CaseError> {
        for _ in 0..self.list(ATTRIBUTES)? {
            self.text()?;
            let size =
                [1, 1, 2, 4, 4, 8][self.number()?.checked_sub(1).filter(|k| *k < 6).ok_or("no type")?];
            let count = self.number()?;
            self.filled(size * count)?;
        }
        Ok(())
    }

    fn variable(&mut self, dimensions: &[(String, usize)]) -> Result<Variable, CaseError> {
        let name = self.text()?;
        let own = (0..self.number()?).map(|_| self.number()).collect::<Result<Vec<usize>, CaseError>>()?;
        self.attributes()?;
        let [_, _, begin] = [self.number()?, self.number()?, self.number()?];
        let count: usize = own.iter().map(|d| dimensions[*d].1).product();
        let bytes = self.0.get(begin..begin + 8 * count).ok_or("the file ends early")?;
        let value = |b: &[u8]| Ok(f64::from_be_bytes(b.try_into()?));
        let values = bytes.chunks_exact(8).map(value).collect::<Result<Vec<f64>, CaseError>>()?;
        Ok(Variable { name, dimensions: own, values })
    }
}

impl Grid {
    fn read(done: &WrittenRun, name: &str) -> Result<Self, CaseError> {
        let bytes = std::fs::read(done.files.path().join("events").join(name))?;
        let mut rest = Rest(&bytes, &bytes);
        if rest.take(4)? != b"CDF\x01" {
            return Err(format!("{name} is not in the classic format").into());
        }
        rest.number()?;
        let mut dimensions = Vec::new();
        for _ in 0..rest.list(DIMENSIONS)? {
            dimensions.push((rest.text()?, rest.number()?));
        }
        rest.attributes()?;
        let mut variables = Vec::new();
        for _ in 0..rest.list(VARIABLES)? {
            variables.push(rest.variable(&dimensions)?);
        }
        Ok(Self { dimensions, variables })
    }

    fn named(&self, name: &str) -> Result<&Variable, CaseError> {
        self.variables.iter().find(|v| v.name == name).ok_or_else(|| format!("no variable {name}").into())
    }

    /// The value of `z` where the coordinates `x` and `y` are nearest to these.
    fn at(&self, place: [f64; 2]) -> Result<f64, CaseError> {
        let z = self.named("z")?;
        let (mut index, mut off) = (0, 0.0_f64);
        for &d in &z.dimensions {
            let (name, length) = &self.dimensions[d];
            let wanted = place[usize::from(name == "y")];
            let away =
                |k: &usize| -> f64 { (self.named(name).map_or(f64::NAN, |v| v.values[*k]) - wanted).abs() };
            let k = (0..*length).min_by(|a, b| away(a).total_cmp(&away(b))).ok_or("no coordinate")?;
            (index, off) = (index * length + k, off.max(away(&k)));
        }
        if off > 1e-6 {
            return Err(format!("no node of the grid within {off} m").into());
        }
        Ok(z.values[index])
    }
}

/// See the module.
pub(super) fn run(ledger: &mut Ledger) -> Result<(), CaseError> {
    let surface =
        "surface = { spacing = 2e3, x = { from = -5e3, to = 9e3 }, z = { from = -3e3, to = 3e3 } }\n";
    let more = format!(
        "{surface}[events]\nabove = \"1e-3 m/s\"\nstop_after = 1\n[place]\nepoch = \"2000-01-01T00:00:00Z\"\nlatitude = \"10 deg\"\n\
         longitude = \"20 deg\"\nstrike = \"{STRIKE} deg\"\nup = [0, 1, 0]\nalong = [0, 0, -1]\n"
    );
    let weakening = "a = 0.010, b = 0.015, l = \"4 mm\"";
    let done =
        WrittenRun::from_text(&scene("3d", weakening, "1000 yr", &(rectangle(1.1e-9, SIZES) + &more)))?;
    maps(ledger, &done)?;
    let table = done.files.table("events/rupture_times_000.csv")?;
    slips(ledger, &done, &table)?;
    hypocentre(ledger, &done)?;
    subfaults(ledger, &done, &table)
}

/// Maps of the surface, whose first coordinate is z.
fn maps(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let table = done.files.table("events/surface_000.csv")?;
    let (xs, zs) = (table.column("x")?, table.column("z")?);
    for component in ["east", "north", "up"] {
        let grid = Grid::read(done, &format!("surface_000_{component}.grd"))?;
        let found =
            zs.iter().zip(&xs).map(|(z, x)| grid.at([*z, *x])).collect::<Result<Vec<f64>, CaseError>>()?;
        ledger
            .claim(format!("map of the surface over an event of six cells as a grid: displacement {component}, by coordinates"))
            .unit("m")
            .values(&found)
            .equals_each(&table.column(component)?)
            .relative(1e-9)
            .evidence(Evidence::Exact, "the table of the same positions")
            .because("the table has ten digits")
            .why_not_tighter("the last digit may be off by any part of a half")
            .covers(&[Capability::Outputs, Capability::Medium, Capability::Interop])
            .cost(&done.cost)
            .record();
    }
    Ok(())
}

/// Slip over distances along strike, which is -z, and down dip.
fn slips(ledger: &mut Ledger, done: &WrittenRun, table: &Table) -> Result<(), CaseError> {
    let grid = Grid::read(done, "slip_000_main.grd")?;
    let cosine = DIP.to_radians().cos();
    let places = table.column("x")?.into_iter().zip(table.column("z")?);
    let places: Vec<[f64; 2]> = places.map(|(x, z)| [0.5 * SIZES[0] - z, x / cosine]).collect();
    let found = places.iter().map(|at| grid.at(*at)).collect::<Result<Vec<f64>, CaseError>>()?;
    let slip = table.column("slip")?;
    let range = slip.iter().fold(0.0_f64, |m, s| m.max(s.abs()))
        - slip.iter().fold(f64::INFINITY, |m, s| m.min(s.abs()));
    if found.len() != 6 || range < 1e-6 {
        return Err("cells are missing, or slip alike".into());
    }
    ledger
        .claim("slip of an event of six cells as a grid, by distances along strike and down dip")
        .unit("m")
        .values(&found)
        .equals_each(&slip)
        .relative(1e-9)
        .evidence(
            Evidence::Exact,
            "the table of the points of the event, by their positions and the dip of the fault",
        )
        .because("the table has ten digits")
        .why_not_tighter("the last digit may be off by any part of a half")
        .covers(&[Capability::Outputs, Capability::Medium, Capability::Events, Capability::Interop])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Depths, slip and moments of the subfaults, whose positions are the middles of their upper edges.
fn subfaults(ledger: &mut Ledger, done: &WrittenRun, table: &Table) -> Result<(), CaseError> {
    let text = done.files.text("events/finite_fault_000.fsp")?;
    let lines = text.lines().filter(|line| !line.starts_with('%') && !line.trim().is_empty());
    let rows = lines.map(|line| line.split_whitespace().map(str::parse).collect::<Result<Vec<f64>, _>>());
    let rows = rows.collect::<Result<Vec<_>, _>>()?;
    let (depth, slip) = (table.column("y")?, table.column("slip")?);
    let half = 0.5 * SIZES[2] * DIP.to_radians().sin();
    let found: Vec<f64> = rows.iter().flat_map(|row| [row[4], row[5]]).collect();
    let exact: Vec<f64> =
        depth.iter().zip(&slip).flat_map(|(y, slip)| [-1e-3 * (y + half), slip.abs()]).collect();
    if found.len() != exact.len() {
        return Err(format!("{} subfaults", rows.len()).into());
    }
    ledger
        .claim("depth of the upper edge in km, and slip in m, of the subfaults of a finite-fault model of six cells")
        .values(&found)
        .equals_each(&exact)
        .absolute(5.1e-4)
        .evidence(Evidence::Exact, "half a cell up dip from the positions in the table of points, and their slip")
        .because("depths have three decimals")
        .why_not_tighter("depths of these cells may be whole in the last digit")
        .covers(&[Capability::Outputs, Capability::Medium, Capability::Events, Capability::Interop])
        .cost(&done.cost)
        .record();
    Ok(())
}

/// Hypocentre on the fault, from its first end and its upper edge.
fn hypocentre(ledger: &mut Ledger, done: &WrittenRun) -> Result<(), CaseError> {
    let text = done.files.text("events/finite_fault_000.fsp")?;
    let entry = |name: &str| -> Result<f64, CaseError> {
        let after = text.split(&format!("{name} = ")).nth(1).ok_or_else(|| format!("no {name}"))?;
        Ok(after.split_whitespace().next().ok_or("the model is short")?.parse()?)
    };
    let events = done.files.table("events.csv")?;
    let (x, z) = (events.only("x")?, events.only("z")?);
    ledger
        .claim("hypocentre of a finite-fault model along strike and down dip, and its size")
        .unit("km")
        .values(&[entry("HypX")?, entry("HypZ")?, entry("LEN")?, entry("WID")?])
        .equals_each(&[
            1e-3 * (0.5 * SIZES[0] - z),
            1e-3 * x / DIP.to_radians().cos(),
            1e-3 * SIZES[0],
            1e-3 * SIZES[1],
        ])
        .absolute(5.1e-4)
        .evidence(Evidence::Exact, "the hypocentre of the catalogue, by the dip of the fault")
        .because("lengths have three decimals")
        .why_not_tighter("the last digit may be off by any part of a half, and is none here")
        .covers(&[Capability::Outputs, Capability::Medium, Capability::Events, Capability::Interop])
        .cost(&done.cost)
        .record();
    Ok(())
}
