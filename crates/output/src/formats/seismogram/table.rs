//! Seismograms as CSV.

use super::trace::AXES;
use crate::OutputError;
use crate::decimals::shortest_scientific;
use crate::tables::column::{self, Column, Sign};
use std::path::Path;

/// Columns of a table: time, velocities and displacements of the axes along which points move.
#[must_use]
pub fn columns(axes: &[usize]) -> Vec<Column> {
    let of = |name: &'static str, unit| {
        let own = move |axis: &usize| {
            Column::new(format!("{name}_{}", AXES[*axis].to_ascii_lowercase()), unit, Sign::Axis, name)
        };
        axes.iter().map(own)
    };
    [column::time()].into_iter().chain(of("velocity", "m/s")).chain(of("displacement", "m")).collect()
}

/// Row of a table. Numbers read back as the same numbers.
#[must_use]
pub fn row(time: f64, velocity: &[f64], displacement: &[f64]) -> String {
    let values = [time].into_iter().chain(velocity.iter().copied()).chain(displacement.iter().copied());
    let mut text = values.map(shortest_scientific).collect::<Vec<_>>().join(",");
    text.push('\n');
    text
}

/// Velocities of a table by component.
///
/// # Errors
/// If the table cannot be read.
pub fn read(path: &Path, components: usize) -> Result<Vec<Vec<f64>>, OutputError> {
    let failed = |source: std::io::Error| OutputError::Read { path: path.to_path_buf(), source };
    let damaged = |e: csv::Error| failed(std::io::Error::other(e));
    let mut columns = vec![Vec::new(); components];
    let mut reader = csv::Reader::from_path(path).map_err(damaged)?;
    for row in reader.deserialize::<Vec<f64>>() {
        let row = row.map_err(damaged)?;
        columns.iter_mut().zip(row.get(1..).unwrap_or_default()).for_each(|(column, v)| column.push(*v));
    }
    Ok(columns)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_are_read_back_to_the_last_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.csv");
        let mut text = column::header(&columns(&[0, 1]));
        assert_eq!(
            text,
            "time [s],velocity_x [m/s],velocity_y [m/s],displacement_x [m],displacement_y [m]\n"
        );
        text.push_str(&row(0.1, &[1.0 / 3.0, -1e-300], &[0.0, 1.0]));
        text.push_str(&row(0.2, &[2.0 / 3.0, 5e-324], &[0.0, 1.0]));
        std::fs::write(&path, text).unwrap();
        assert_eq!(read(&path, 2).unwrap(), [[1.0 / 3.0, 2.0 / 3.0], [-1e-300, 5e-324]]);
    }
}
