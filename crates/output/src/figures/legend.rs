//! Legends below frames.

use super::colour::{INK, MARK, Rgb};
use super::figure::{Anchor, Dash, Figure};
use super::width::{CHARACTER, fitting};

/// A curve in a legend.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    pub name: String,
    pub colour: Rgb,
    pub dash: Dash,
}

/// Em size of names.
const TEXT: f64 = 12.5;
/// Height of a line.
const LINE: f64 = 19.0;
/// Length of the sample of a curve, and the room from its start to the name.
const SAMPLE: (f64, f64) = (28.0, 35.0);
/// Room between a name and the next sample.
const APART: f64 = 18.0;
/// Room at either end of a line.
const ENDS: f64 = 14.0;
/// Largest number of lines; what does not fit is counted in the last.
const MOST_LINES: usize = 6;

/// An entry in a line.
#[derive(Clone, Debug)]
struct PlacedEntry {
    left: f64,
    size: f64,
    entry: Entry,
}

/// Names of curves with samples of them, in lines.
#[derive(Clone, Debug)]
pub(super) struct Legend {
    lines: Vec<Vec<PlacedEntry>>,
}

impl Legend {
    /// Legend of entries for a figure of this width.
    pub(super) fn from_entries(entries: &[Entry], width: f64) -> Self {
        let flowing = (0..=entries.len())
            .rev()
            .map(|kept| (kept, Self::with(entries, kept, width)))
            .find(|(_, legend)| legend.lines.len() <= MOST_LINES);
        let (kept, flowing) = flowing.unwrap_or((0, Self { lines: Vec::new() }));
        if kept < entries.len() {
            return flowing;
        }
        // Columns are easier to read, unless they take many more lines.
        let most = MOST_LINES.min(flowing.lines.len() + 1);
        let columns = (1..=entries.len()).rev().find_map(|columns| Self::aligned(entries, columns, width));
        columns.filter(|legend| legend.lines.len() <= most).unwrap_or(flowing)
    }

    /// Legend in this number of columns; `None` if they do not fit the width.
    fn aligned(entries: &[Entry], columns: usize, width: f64) -> Option<Self> {
        let long = |entry: &Entry| SAMPLE.1 + CHARACTER * TEXT * entry.name.chars().count() as f64;
        let widest =
            |column: usize| entries.iter().skip(column).step_by(columns).map(long).fold(0.0, f64::max);
        let mut lefts = vec![ENDS];
        for column in 0..columns {
            lefts.push(lefts[column] + widest(column) + APART);
        }
        if lefts[columns] - APART > width - ENDS {
            return None;
        }
        let placed = |line: &[Entry]| -> Vec<PlacedEntry> {
            let entry =
                |(entry, &left): (&Entry, &f64)| PlacedEntry { left, size: TEXT, entry: entry.clone() };
            line.iter().zip(&lefts).map(entry).collect()
        };
        Some(Self { lines: entries.chunks(columns).map(placed).collect() })
    }

    /// Legend of the first entries, and of how many there are more.
    fn with(entries: &[Entry], kept: usize, width: f64) -> Self {
        let more = entries.len() - kept;
        let rest = Entry { name: format!("and {more} more"), colour: MARK, dash: &[1.0, 4.0] };
        let (mut lines, mut left): (Vec<Vec<PlacedEntry>>, f64) = (Vec::new(), f64::INFINITY);
        for entry in entries[..kept].iter().chain((more > 0).then_some(&rest)) {
            let (name, size) = fitting(&entry.name, width - 2.0 * ENDS - SAMPLE.1, TEXT);
            let long = SAMPLE.1 + CHARACTER * size * name.chars().count() as f64;
            if left + long > width - ENDS {
                lines.push(Vec::new());
                left = ENDS;
            }
            let placed = PlacedEntry { left, size, entry: Entry { name, ..entry.clone() } };
            if let Some(line) = lines.last_mut() {
                line.push(placed);
            }
            left += long + APART;
        }
        Self { lines }
    }

    /// Its height.
    pub(super) fn height(&self) -> f64 {
        if self.lines.is_empty() { 0.0 } else { LINE * self.lines.len() as f64 + 4.0 }
    }

    /// Draws it below `top`.
    pub(super) fn draw(self, figure: &mut Figure, top: f64) {
        for (k, line) in self.lines.into_iter().enumerate() {
            let y = top + LINE * (k as f64 + 0.4);
            for PlacedEntry { left, size, entry } in line {
                figure.dashed(vec![(left, y), (left + SAMPLE.0, y)], entry.dash, 2.2, entry.colour);
                figure.text((left + SAMPLE.1, y), entry.name, size, Anchor::Start, INK);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_several_lines_stand_in_columns() {
        let names =
            ["a", "a in steady state", "bbbbbb", "bbbbbb in steady state", "cc", "cc in steady state"];
        let entry = |name: &&str| Entry { name: (*name).into(), colour: INK, dash: &[] };
        let legend = Legend::from_entries(&names.iter().map(entry).collect::<Vec<_>>(), 540.0);
        assert_eq!(legend.lines.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2, 2]);
        let lefts: Vec<Vec<f64>> =
            legend.lines.iter().map(|line| line.iter().map(|p| p.left).collect()).collect();
        assert!(lefts.windows(2).all(|two| two[0] == two[1]), "{lefts:?}");
    }

    #[test]
    fn names_stay_within_the_width_and_apart_and_those_left_out_are_counted() {
        for count in [0, 1, 3, 12, 60] {
            let name = |k: usize| format!("{k} {}", "long ".repeat(k % 7));
            let entries: Vec<Entry> =
                (0..count).map(|k| Entry { name: name(k), colour: INK, dash: &[] }).collect();
            let legend = Legend::from_entries(&entries, 540.0);
            assert!(legend.lines.len() <= MOST_LINES);
            let shown: usize = legend.lines.iter().map(Vec::len).sum();
            assert!(shown == count || count == 60, "{shown} of {count}");
            for line in &legend.lines {
                let end = |p: &PlacedEntry| {
                    p.left + SAMPLE.1 + CHARACTER * p.size * p.entry.name.chars().count() as f64
                };
                assert!(line.iter().all(|p| end(p) <= 540.0));
                assert!(line.windows(2).all(|pair| end(&pair[0]) < pair[1].left));
            }
            if count == 60 {
                let last = &legend.lines[MOST_LINES - 1];
                assert_eq!(last[last.len() - 1].entry.name, format!("and {} more", 60 - (shown - 1)));
            }
        }
    }
}
