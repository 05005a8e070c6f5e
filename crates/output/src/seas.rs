//! Station files in the format of the SEAS community.

use crate::decimals::{fixed, scientific};

/// Least slip rate in files of stations \[m/s\], which stands for rest: the benchmarks in 3D treat it as zero.
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

/// Names of the columns with units and names of the fields, for slip in a fixed direction.
const ALONG_A_LINE: (&[&str], &str) = (
    &["Slip (m)", "Slip rate (log10 m/s)", "Shear stress (MPa)", "State (log10 s)", "Normal stress (MPa)"],
    "t slip slip_rate shear_stress state normal_stress",
);
/// Names of the columns with units and names of the fields, for slip whose direction may turn.
const IN_A_PLANE: (&[&str], &str) = (
    &[
        "Slip_2 (m)",
        "Slip_3 (m)",
        "Slip_rate_2 (log10 m/s)",
        "Slip_rate_3 (log10 m/s)",
        "Shear_stress_2 (MPa)",
        "Shear_stress_3 (MPa)",
        "State (log10 s)",
        "Normal stress (MPa)",
    ],
    "t slip_2 slip_3 slip_rate_2 slip_rate_3 shear_stress_2 shear_stress_3 state normal_stress",
);

impl Head<'_> {
    /// The lines above the rows.
    #[must_use]
    pub fn text(&self) -> String {
        let Head { title, version, area, location, .. } = self;
        let unit = if self.in_space { "m2" } else { "m per m" };
        let mut head = format!(
            "# problem={title}\n# code=asperity\n# code_version={version}\n# tributary_area={area:.6e} {unit}\n# location= {location}\n",
        );
        head.push_str(&format!("# least_slip_rate={LEAST_RATE:e} m/s, which stands for rest\n"));
        if let Some([two, three]) = &self.directions {
            head.push_str(&format!("# directions: 2 is along {two:?}, 3 along {three:?}\n"));
        }
        let (columns, names) = if self.directions.is_some() { IN_A_PLANE } else { ALONG_A_LINE };
        let further = [
            (self.opens, "Opening (m)", "opening"),
            (self.heats, "Temperature (K)", "temperature"),
            (self.pressurises, "Pore pressure (MPa)", "pore_pressure"),
        ];
        let further: Vec<(&str, &str)> = further.iter().filter(|c| c.0).map(|c| (c.1, c.2)).collect();
        let last = further.iter().map(|(column, _)| column);
        for (k, column) in std::iter::once(&"Time (s)").chain(columns).chain(last).enumerate() {
            head.push_str(&format!("# Column #{} = {column}\n", k + 1));
        }
        head.push_str(names);
        for (_, name) in further {
            head.push(' ');
            head.push_str(name);
        }
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
