//! Scenes of published problems, by their titles.
//!
//! A scene says what it models, not which benchmark it is. A copy of a benchmark's scene with another mesh keeps its title.

use super::Citations;

/// Titles of scenes, and the sources of their problems.
pub const TITLES: [(&str, &[&str]); 14] = [
    ("sandwich/v1", &["asperity-sandwich-v1", "xing2002b"]),
    ("sandwich-state/v1", &["asperity-sandwich-state-v1"]),
    ("Hertz line contact with partial slip", &["asperity-hertz-v1", "asperity-partial-slip-v1"]),
    ("fault with a bend", &["asperity-fault-bend-v1"]),
    ("bp1-qd", &["asperity-seas-bp1-quick-v1", "erickson2020"]),
    ("bp1-qd slip law", &["erickson2020"]),
    ("bp2-qd", &["erickson2020"]),
    ("bp3-qd dip 60 thrust", &["erickson2023"]),
    ("bp1-qd in a half-space", &["erickson2020"]),
    ("bp5-qd", &["jiang2022"]),
    ("bp6-qd-A", &["lambert2025"]),
    ("bp6-qd-S", &["lambert2025"]),
    ("cook/v1", &["cook1974"]),
    ("cylinder/v1", &["timoshenko1970"]),
];

/// Adds the sources of the problem that a scene of this title poses.
pub(super) fn add(citations: &mut Citations, title: &str) {
    for key in TITLES.iter().filter(|row| row.0 == title).flat_map(|row| row.1) {
        citations.add(key, format!("the problem \"{title}\", by its title"));
    }
}

/// Keys of the table.
pub fn keys() -> impl Iterator<Item = &'static str> {
    TITLES.iter().flat_map(|row| row.1).copied()
}
