//! Slip of an event in the FSP format of the database of finite-source rupture models (SRCMOD).
//!
//! Lines that begin with `%` hold the event and each segment of the fault; the others are its subfaults. Lengths are in km, slip in
//! m, angles in degrees and times in s.

use super::event::Spot;
use crate::decimals::{fixed, scientific};
use jiff::Timestamp;
use jiff::tz::TimeZone;
use std::fmt::Write as _;

/// An event and its slip.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceModel<'a> {
    /// Title of the scene.
    pub title: &'a str,
    /// Number of the event, from 1.
    pub number: usize,
    /// Time of the onset.
    pub onset: Timestamp,
    /// Position of the onset.
    pub hypocentre: Spot,
    /// Scalar moment \[N m\].
    pub moment: f64,
    /// Moment magnitude.
    pub magnitude: f64,
    /// Strike, dip and rake of all slip \[degrees\].
    pub mechanism: [f64; 3],
    /// Parts of the fault.
    pub segments: Vec<Segment<'a>>,
}

/// A part of the fault.
#[derive(Clone, Debug, PartialEq)]
pub struct Segment<'a> {
    /// Name of the fault.
    pub name: &'a str,
    /// Strike and dip \[degrees\].
    pub plane: [f64; 2],
    /// Extent along strike and down dip \[m\].
    pub size: [f64; 2],
    /// Numbers of subfaults along strike and down dip and their size \[m\], if they are equal rectangles.
    pub cells: Option<([usize; 2], [f64; 2])>,
    /// Middle of the upper edge.
    pub top: Spot,
    /// Distance of the hypocentre along strike from the first end of the segment, and down dip from its upper edge \[m\].
    pub hypocentre: Option<[f64; 2]>,
    /// Subfaults.
    pub rows: Vec<Row>,
}

/// A subfault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Position: the middle of the upper edge of a rectangle, or the centre of a triangle.
    pub at: Spot,
    /// Distance from the epicentre towards the east and the north \[m\].
    pub from_epicentre: [f64; 2],
    /// Slip \[m\].
    pub slip: f64,
    /// Rake \[degrees\].
    pub rake: f64,
    /// Time since the onset at which it ruptured; NaN if it did not \[s\].
    pub ruptured: f64,
    /// Scalar moment \[N m\].
    pub moment: f64,
}

/// Metres per kilometre.
const KM: f64 = 1e3;
/// A line across the page.
const RULE: &str = "% --------------------------------------------------------------------------------";

impl SourceModel<'_> {
    /// The file.
    #[must_use]
    pub fn text(&self) -> String {
        let mut text =
            format!("% FINITE-SOURCE RUPTURE MODEL of a simulated event, in FSP format\n{RULE}\n%\n");
        self.event(&mut text);
        let rectangles = self.segments.iter().all(|s| s.cells.is_some());
        let at = if rectangles { "the middle of its upper edge" } else { "its centre" };
        let _ = writeln!(
            text,
            "% SOURCE MODEL PARAMETERS\n% X, Y, Z in km; SLIP in m; RAKE in deg; TRUP in s, NaN where nothing ruptured; SF_MOMENT in Nm\n% The position of a subfault is {at}.\n% X==EW and Y==NS count from the epicentre, Z is the depth."
        );
        for (k, segment) in self.segments.iter().enumerate() {
            segment.write(&mut text, k + 1);
        }
        text
    }

    /// Lines about the event.
    fn event(&self, text: &mut String) {
        let time = self.onset.to_zoned(TimeZone::UTC);
        let (spot, [strike, dip, rake]) = (&self.hypocentre, self.mechanism);
        let (month, day, year) = (time.month(), time.day(), time.year());
        let most = |k: usize| self.segments.iter().map(|s| s.size[k]).fold(0.0, f64::max) / KM;
        let length = self.segments.iter().map(|s| s.size[0]).sum::<f64>() / KM;
        let top = self.segments.iter().map(|s| s.top.depth).fold(f64::INFINITY, f64::min) / KM;
        let first = self.segments.iter().find_map(|s| s.hypocentre).unwrap_or([f64::NAN; 2]);
        let lines = [
            format!(
                "Event : {} {}, simulated\t{month:02}/{day:02}/{year:04}\t[asperity]",
                self.title, self.number
            ),
            format!("EventTAG: s{year:04}SIMULA{:02}ASPE", self.number),
            String::new(),
            format!(
                "Loc  : LAT = {}\tLON = {}\tDEP = {} km",
                fixed(spot.latitude, 5),
                fixed(spot.longitude, 5),
                fixed(spot.depth / KM, 3)
            ),
            format!(
                "Size : LEN = {} km\tWID = {} km\tMw = {}\tMo = {} Nm",
                fixed(length, 3),
                fixed(most(1), 3),
                fixed(self.magnitude, 3),
                scientific(self.moment, 9)
            ),
            format!(
                "Mech : STRK = {}\tDIP = {}\tRAKE = {}\tHtop = {} km",
                fixed(strike, 3),
                fixed(dip, 3),
                fixed(rake, 3),
                fixed(top, 3)
            ),
            format!("Rupt : HypX = {} km\tHypZ = {} km", fixed(first[0] / KM, 3), fixed(first[1] / KM, 3)),
            String::new(),
        ];
        lines.iter().for_each(|line| {
            let _ = writeln!(text, "{}", format!("% {line}").trim_end());
        });
        if let [Segment { cells: Some(([nx, nz], [dx, dz])), .. }] = self.segments.as_slice() {
            let (dx, dz) = (fixed(dx / KM, 6), fixed(dz / KM, 6));
            let _ = writeln!(text, "% Invs : Nx = {nx}\tNz = {nz}\n% Invs : Dx = {dx} km\tDz = {dz} km");
        }
        let _ = writeln!(text, "% Invs : Nsg = {}\t(number of segments)\n%\n{RULE}", self.segments.len());
    }
}

impl Segment<'_> {
    fn write(&self, text: &mut String, number: usize) {
        let ([strike, dip], [length, width]) = (self.plane, self.size);
        let _ = writeln!(
            text,
            "{RULE}\n% SEGMENT # {number}: STRIKE = {} deg\tDIP = {} deg\t(fault {})\n% LEN = {} km\tWID = {} km\n% depth to top: Z2top = {} km\n% coordinates of top-center:\n% LAT = {},\tLON = {}",
            fixed(strike, 3),
            fixed(dip, 3),
            self.name,
            fixed(length / KM, 3),
            fixed(width / KM, 3),
            fixed(self.top.depth / KM, 3),
            fixed(self.top.latitude, 6),
            fixed(self.top.longitude, 6)
        );
        if let Some([along, down]) = self.hypocentre {
            let _ = writeln!(
                text,
                "% hypocenter on SEGMENT # {number}: along-strike (X) = {}, down-dip (Z) = {}",
                fixed(along / KM, 3),
                fixed(down / KM, 3)
            );
        }
        let _ = writeln!(
            text,
            "% Nsbfs = {} subfaults\n{RULE}\n% LAT LON X==EW Y==NS Z SLIP RAKE TRUP SF_MOMENT\n{RULE}",
            self.rows.len()
        );
        for row in &self.rows {
            let [east, north] = row.from_epicentre;
            let _ = writeln!(
                text,
                "{} {} {} {} {} {} {} {} {}",
                fixed(row.at.latitude, 6),
                fixed(row.at.longitude, 6),
                fixed(east / KM, 5),
                fixed(north / KM, 5),
                fixed(row.at.depth / KM, 5),
                scientific(row.slip, 9),
                fixed(row.rake, 4),
                fixed(row.ruptured, 4),
                scientific(row.moment, 9)
            );
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_has_the_columns_of_its_head() {
        let spot = Spot { latitude: 1.0, longitude: 2.0, depth: 3e3 };
        let row = Row {
            at: spot,
            from_epicentre: [-1e3, 2e3],
            slip: 0.5,
            rake: 90.0,
            ruptured: f64::NAN,
            moment: 1e18,
        };
        let segment = Segment {
            name: "main",
            plane: [25.0, 40.0],
            size: [2e4, 1e4],
            cells: Some(([1, 1], [2e4, 1e4])),
            top: spot,
            hypocentre: Some([0.0, 5e3]),
            rows: vec![row],
        };
        let model = SourceModel {
            title: "t",
            number: 1,
            onset: Timestamp::UNIX_EPOCH,
            hypocentre: spot,
            moment: 1e18,
            magnitude: 5.93,
            mechanism: [25.0, 40.0, 90.0],
            segments: vec![segment],
        };
        let text = model.text();
        let rows: Vec<&str> = text.lines().filter(|line| !line.starts_with('%')).collect();
        let head = text.lines().find(|line| line.contains("LAT LON")).unwrap();
        assert_eq!(rows.len(), 1);
        assert_eq!(rows[0].split_whitespace().count(), head.split_whitespace().count() - 1);
        assert_eq!(
            rows[0],
            "1.000000 2.000000 -1.00000 2.00000 3.00000 5.000000000e-1 90.0000 NaN 1.000000000e18"
        );
        assert!(text.contains("% Invs : Nx = 1\tNz = 1"), "{text}");
    }
}
