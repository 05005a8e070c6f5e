//! Heads of the files in which the SEAS community collects results of its benchmarks in space.

/// Contents of the heads of all files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Submission {
    /// The benchmark.
    pub problem: String,
    /// Version of the program.
    pub version: String,
    /// Name of the person who submits it.
    pub modeler: String,
    /// Date, as year/month/day.
    pub date: Option<String>,
    /// Size of the cells, with its unit.
    pub element_size: String,
}

/// Columns with units, and names of the fields, of a kind of file.
struct Fields {
    columns: &'static [&'static str],
    names: &'static str,
}

const ON_FAULT: Fields = Fields {
    columns: &[
        "Time (s)",
        "Slip_2 (m)",
        "Slip_3 (m)",
        "Slip_rate_2 (log10 m/s)",
        "Slip_rate_3 (log10 m/s)",
        "Shear_stress_2 (MPa)",
        "Shear_stress_3 (MPa)",
        "State (log10 s)",
    ],
    names: "t slip_2 slip_3 slip_rate_2 slip_rate_3 shear_stress_2 shear_stress_3 state",
};

const OFF_FAULT: Fields = Fields {
    columns: &[
        "Time (s)",
        "Displacement_1 (m)",
        "Displacement_2 (m)",
        "Displacement_3 (m)",
        "Velocity_1 (m/s)",
        "Velocity_2 (m/s)",
        "Velocity_3 (m/s)",
    ],
    names: "t disp_1 disp_2 disp_3 vel_1 vel_2 vel_3",
};

const GLOBAL: Fields = Fields {
    columns: &["Time (s)", "Max_slip_rate (log10 m/s)", "Moment_rate (N-m/s)"],
    names: "t max_slip_rate moment_rate",
};

const RUPTURE: Fields =
    Fields { columns: &["Strike-distance x2 (m)", "Depth x3 (m)", "Rupture time (s)"], names: "x2 x3 t" };

impl Submission {
    /// Head of the file of a position on the fault.
    #[must_use]
    pub fn on_fault(&self, location: &str) -> String {
        self.head(Some(location), &ON_FAULT)
    }

    /// Head of the file of a position beside the fault.
    #[must_use]
    pub fn off_fault(&self, location: &str) -> String {
        self.head(Some(location), &OFF_FAULT)
    }

    /// Head of the file of the whole fault through time.
    #[must_use]
    pub fn global(&self) -> String {
        self.head(None, &GLOBAL)
    }

    /// Head of the file of rupture times.
    #[must_use]
    pub fn rupture(&self) -> String {
        self.head(None, &RUPTURE)
    }

    fn head(&self, location: Option<&str>, fields: &Fields) -> String {
        let Self { problem, version, modeler, date, element_size } = self;
        let mut head =
            format!("# problem={problem}\n# code=asperity\n# code_version={version}\n# modeler={modeler}\n");
        date.iter().for_each(|date| head.push_str(&format!("# date={date}\n")));
        head.push_str(&format!("# element_size={element_size}\n"));
        location.iter().for_each(|location| head.push_str(&format!("# location={location}\n")));
        for (k, column) in fields.columns.iter().enumerate() {
            head.push_str(&format!("# Column #{} = {column}\n", k + 1));
        }
        head.push_str(fields.names);
        head.push('\n');
        head
    }
}

/// Cells of the rows of a table, without its comments and the names of its columns.
pub fn table(text: &str, by: char) -> impl Iterator<Item = Vec<&str>> {
    let rows = text.lines().filter(|line| !line.starts_with('#')).skip(1);
    rows.map(move |row| row.split(by).collect())
}

/// Rows of time, largest slip rate and moment rate at the times that both tables have.
#[must_use]
pub fn global(largest: &str, rates: &str) -> String {
    let (mut first, mut second) = (table(largest, ',').peekable(), table(rates, ',').peekable());
    let time = |row: &[&str]| row.first().and_then(|t| t.parse::<f64>().ok());
    let mut rows = String::new();
    while let (Some(a), Some(b)) = (first.peek(), second.peek()) {
        let (Some(ta), Some(tb)) = (time(a), time(b)) else { break };
        if ta < tb {
            first.next();
        } else if tb < ta {
            second.next();
        } else {
            if let ([time, rate, ..], [_, moment, ..]) = (&a[..], &b[..]) {
                rows.push_str(&format!("{time} {rate} {moment}\n"));
            }
            first.next();
            second.next();
        }
    }
    rows
}

/// A number as text, with the other sign if `sign` is negative; zero and NaN have none.
#[must_use]
pub fn signed(number: &str, sign: f64) -> String {
    let signless = number.parse::<f64>().is_ok_and(|value| value == 0.0 || value.is_nan());
    match number.strip_prefix('-') {
        _ if sign > 0.0 || signless => number.to_string(),
        Some(size) => size.to_string(),
        None => format!("-{number}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heads_name_as_many_fields_as_they_have_columns() {
        for Fields { columns, names } in [ON_FAULT, OFF_FAULT, GLOBAL, RUPTURE] {
            assert_eq!(columns.len(), names.split(' ').count());
        }
        let submission = Submission {
            problem: "p".into(),
            version: "1".into(),
            modeler: "m".into(),
            date: None,
            element_size: "1000 m".into(),
        };
        let head = submission.on_fault("on fault, 0 km along strike, 10 km depth");
        assert!(head.ends_with("state\n") && !head.contains("date") && head.contains("# location=on fault"));
        assert!(!submission.global().contains("location"));
    }

    #[test]
    fn rows_of_both_tables_meet_at_equal_times() {
        let largest = "time [s],rate,point\n0e0,-9,1\n1e0,-8,1\n2e0,-7,1\n";
        let rates = "time [s],moment_rate of main,moment of main\n0e0,5,0\n2e0,6,0\n3e0,7,0\n";
        assert_eq!(global(largest, rates), "0e0 -9 5\n2e0 -7 6\n");
    }

    #[test]
    fn a_sign_turns_numbers_but_not_zero() {
        assert_eq!(
            ["1.5e0", "-1.5e0", "0.0e0", "NaN"].map(|n| signed(n, -1.0)),
            ["-1.5e0", "1.5e0", "0.0e0", "NaN"]
        );
        assert_eq!(signed("-2", 1.0), "-2");
    }
}
