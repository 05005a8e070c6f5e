//! Station files in the format of the SEAS community.

use crate::decimals::{fixed, scientific};
use crate::tables::{Column, Sign};

/// Least slip rate in files of stations \[m/s\], which means rest: the benchmarks in 3D treat it as zero.
pub const LEAST_RATE: f64 = 1e-20;

/// Contents of the header of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Head<'a> {
    /// Title of the scene.
    pub title: &'a str,
    /// Version of the program.
    pub version: &'a str,
    /// Tributary area of the point \[m^2, or m per metre out of the plane\].
    pub area: f64,
    /// True if `area` is an area, not a length.
    pub in_space: bool,
    /// Position of the station.
    pub location: &'a str,
    /// Directions 2 and 3 of slip, if its direction may turn.
    pub directions: Option<[[f64; 3]; 2]>,
    /// True if the fault opens.
    pub opens: bool,
    /// True if friction heats the fault.
    pub heats: bool,
    /// True if heat changes the pressure of its fluid.
    pub pressurises: bool,
}

/// A column of a station: as the community names it with its unit, and as files name it.
type Field = (&'static str, &'static str, &'static str, Sign, &'static str);

/// Columns for slip in a fixed direction.
const ALONG_A_LINE: [Field; 3] = [
    ("Slip (m)", "slip", "m", Sign::Slip, SLIP),
    ("Slip rate (log10 m/s)", "slip_rate", "log10 m/s", Sign::Log, RATE),
    ("Shear stress (MPa)", "shear_stress", "MPa", Sign::Slip, SHEAR),
];
/// Columns for slip whose direction may turn.
const IN_A_PLANE: [Field; 6] = [
    ("Slip_2 (m)", "slip_2", "m", Sign::Component, SLIP),
    ("Slip_3 (m)", "slip_3", "m", Sign::Component, SLIP),
    ("Slip_rate_2 (log10 m/s)", "slip_rate_2", "log10 m/s", Sign::Log, RATE),
    ("Slip_rate_3 (log10 m/s)", "slip_rate_3", "log10 m/s", Sign::Log, RATE),
    ("Shear_stress_2 (MPa)", "shear_stress_2", "MPa", Sign::Component, SHEAR),
    ("Shear_stress_3 (MPa)", "shear_stress_3", "MPa", Sign::Component, SHEAR),
];
const SLIP: &str = "slip since the start";
const RATE: &str = "decadic logarithm of the slip rate";
const SHEAR: &str = "shear traction that friction resists";

/// Columns of every station, before and after those of slip.
const TIME: Field = ("Time (s)", "t", "s", Sign::None, "time of the row");
const LAST: [Field; 2] = [
    ("State (log10 s)", "state", "log10 s", Sign::None, "decadic logarithm of the state of friction"),
    ("Normal stress (MPa)", "normal_stress", "MPa", Sign::Compression, "normal traction"),
];
const OPENING: Field = ("Opening (m)", "opening", "m", Sign::Apart, "separation of the sides");
const TEMPERATURE: Field = ("Temperature (K)", "temperature", "K", Sign::None, "temperature");
const PRESSURE: Field = (
    "Pore pressure (MPa)",
    "pore_pressure",
    "MPa",
    Sign::None,
    "pore pressure in excess of that at the start",
);

impl Head<'_> {
    fn fields(&self) -> Vec<Field> {
        let slips = if self.directions.is_some() { &IN_A_PLANE[..] } else { &ALONG_A_LINE };
        let further = [(self.opens, OPENING), (self.heats, TEMPERATURE), (self.pressurises, PRESSURE)];
        let further = further.into_iter().filter(|field| field.0).map(|field| field.1);
        [TIME].into_iter().chain(slips.iter().copied()).chain(LAST).chain(further).collect()
    }

    /// Columns of the rows.
    #[must_use]
    pub fn columns(&self) -> Vec<Column> {
        let of = |(_, name, unit, sign, meaning): Field| Column::new(name, unit, sign, meaning);
        self.fields().into_iter().map(of).collect()
    }

    /// The lines above the rows.
    #[must_use]
    pub fn text(&self) -> String {
        let Head { title, version, area, location, .. } = self;
        let unit = if self.in_space { "m2" } else { "m per m" };
        let mut head = format!(
            "# problem={title}\n# code=asperity\n# code_version={version}\n# tributary_area={area:.6e} {unit}\n# location= {location}\n",
        );
        head.push_str(&format!("# least_slip_rate={LEAST_RATE:e} m/s, which means rest\n"));
        if let Some([two, three]) = &self.directions {
            head.push_str(&format!("# directions: 2 is along {two:?}, 3 along {three:?}\n"));
        }
        let fields = self.fields();
        for (k, field) in fields.iter().enumerate() {
            head.push_str(&format!("# Column #{} = {}\n", k + 1, field.0));
        }
        head.push_str(&fields.iter().map(|field| field.1).collect::<Vec<_>>().join(" "));
        head.push('\n');
        head
    }
}

/// Values of the station at a time. Slip, rate and traction have one component, or two if the direction of slip may turn.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Time \[s\].
    pub time: f64,
    /// Slip \[m\].
    pub slip: Vec<f64>,
    /// Slip rate \[m/s\], positive.
    pub rate: Vec<f64>,
    /// Shear traction \[Pa\].
    pub shear: Vec<f64>,
    /// Decadic logarithm of the state over 1 s; NaN without a state.
    pub log_state: f64,
    /// Normal traction \[Pa\].
    pub normal: f64,
    /// Opening \[m\], if the fault opens.
    pub opening: Option<f64>,
    /// Temperature \[K\], if friction heats the fault.
    pub temperature: Option<f64>,
    /// Pore pressure in excess of that at the start \[Pa\], if heat changes it.
    pub pressure: Option<f64>,
}

/// Pascals per megapascal.
const MPA: f64 = 1e6;

impl Row {
    /// Formats the line.
    #[must_use]
    pub fn text(&self) -> String {
        let mut row = format!("{:.14e}", self.time);
        let mut push = |value: String| {
            row.push(' ');
            row.push_str(&value);
        };
        self.slip.iter().for_each(|slip| push(scientific(*slip, 9)));
        self.rate.iter().for_each(|rate| push(fixed(rate.log10(), 9)));
        self.shear.iter().for_each(|shear| push(scientific(shear / MPA, 9)));
        push(fixed(self.log_state, 9));
        push(scientific(self.normal / MPA, 9));
        if let Some(opening) = self.opening {
            push(scientific(opening, 9));
        }
        self.temperature.iter().for_each(|kelvin| push(scientific(*kelvin, 9)));
        self.pressure.iter().for_each(|pressure| push(scientific(pressure / MPA, 9)));
        row.push('\n');
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_the_columns_of_its_head() {
        let mut head = Head {
            title: "t",
            version: "1",
            area: 2.0,
            in_space: true,
            location: "here",
            directions: None,
            opens: true,
            heats: false,
            pressurises: false,
        };
        let mut row = Row {
            time: 1.0,
            slip: vec![0.5],
            rate: vec![1e-9],
            shear: vec![3e7],
            log_state: f64::NAN,
            normal: 5e7,
            opening: Some(-0.0),
            temperature: None,
            pressure: None,
        };
        assert_eq!(
            row.text(),
            "1.00000000000000e0 5.000000000e-1 -9.000000000 3.000000000e1 NaN 5.000000000e1 0.000000000e0\n"
        );
        let columns = |text: &str| text.split_whitespace().count();
        let names = |head: &Head<'_>| columns(head.text().lines().last().unwrap());
        assert_eq!(names(&head), columns(&row.text()));
        (head.heats, head.pressurises) = (true, true);
        (row.temperature, row.pressure) = (Some(500.0), Some(1e6));
        assert_eq!(names(&head), columns(&row.text()));
        head.directions = Some([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
        for two in [&mut row.slip, &mut row.rate, &mut row.shear] {
            two.push(1.0);
        }
        assert_eq!(names(&head), columns(&row.text()));
    }
}
