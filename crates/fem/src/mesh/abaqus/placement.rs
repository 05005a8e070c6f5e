//! Position of an instance of a part: a translation, then a rotation about an axis (Abaqus keyword reference, *INSTANCE).

use super::lines::Keyword;
use crate::mesh::error::MeshError;

/// Placing of an instance.
#[derive(Clone, Debug, Default)]
pub(super) struct Placement {
    translation: [f64; 3],
    /// Two points of the axis, and the angle \[rad\].
    rotation: Option<([[f64; 3]; 2], f64)>,
    lines: usize,
}

impl Placement {
    /// Takes a data line: the first is the translation, the second the rotation.
    pub(super) fn line(&mut self, values: &[&str], line: usize, keyword: &Keyword) -> Result<(), MeshError> {
        let wrong = |expected| keyword.syntax(line, expected, &values.join(", "));
        let number = |text: &&str| if text.is_empty() { Ok(0.0) } else { keyword.real(text, line) };
        let numbers: Vec<f64> = values.iter().map(number).collect::<Result<_, _>>()?;
        self.lines += 1;
        match (self.lines, &numbers[..]) {
            (1, given) if given.len() <= 3 => {
                self.translation.iter_mut().zip(given).for_each(|(t, x)| *t = *x);
            }
            (2, &[a, b, c, d, e, f, angle]) if [a, b, c] != [d, e, f] => {
                self.rotation = Some(([[a, b, c], [d, e, f]], angle.to_radians()));
            }
            (1, _) => return Err(wrong("a translation of up to three numbers")),
            (2, _) => return Err(wrong("two different points of an axis, and an angle")),
            _ => return Err(wrong("a translation and a rotation, no more")),
        }
        Ok(())
    }

    /// Position of a point of the part; unchanged bits where the instance is not moved.
    pub(super) fn apply(&self, x: [f64; 3]) -> [f64; 3] {
        let moved: [f64; 3] = std::array::from_fn(|c| x[c] + self.translation[c]);
        let Some(([a, b], angle)) = &self.rotation else { return moved };
        let along: [f64; 3] = std::array::from_fn(|c| b[c] - a[c]);
        let length = along.iter().map(|c| c * c).sum::<f64>().sqrt();
        let n = along.map(|c| c / length);
        let r: [f64; 3] = std::array::from_fn(|c| moved[c] - a[c]);
        let (sine, cosine) = sine_and_cosine(*angle);
        let dot: f64 = (0..3).map(|c| n[c] * r[c]).sum();
        // Rodrigues' formula.
        std::array::from_fn(|c| {
            let (d, e) = ((c + 1) % 3, (c + 2) % 3);
            let cross = n[d] * r[e] - n[e] * r[d];
            a[c] + r[c] * cosine + cross * sine + n[c] * dot * (1.0 - cosine)
        })
    }
}

/// Sine and cosine; exact for quarter turns, by which parts are mostly turned, so that sides stay parallel to the axes.
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    let quarters = angle / std::f64::consts::FRAC_PI_2;
    if quarters.fract() != 0.0 {
        return angle.sin_cos();
    }
    match quarters.rem_euclid(4.0) {
        1.0 => (1.0, 0.0),
        2.0 => (0.0, -1.0),
        3.0 => (-1.0, 0.0),
        _ => (0.0, 1.0),
    }
}
