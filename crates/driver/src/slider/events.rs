//! Events of sliders as a table.

use asperity_cycles::slider::Event;
use asperity_output::decimals::shortest_scientific;
use std::fmt::Write as _;

/// Events as CSV, with the names of the sliders; what is not known is empty.
#[must_use]
pub fn csv(events: &[Event], names: &[String]) -> String {
    let states = events.iter().map(|e| e.at_onset.states.len()).max().unwrap_or(0);
    let mut text = String::from(
        "slider,direction,onset [s],interval [s],duration [s],slip [m],peak_rate [m/s],least_rate [m/s],stress_drop [Pa]",
    );
    for edge in ["onset", "end"] {
        let _ = write!(text, ",traction_{edge} [Pa],friction_{edge} [-]");
        (1..=states).for_each(|i| text.push_str(&format!(",state_{i}_{edge}")));
    }
    text.push('\n');
    let known = |value: Option<f64>| value.map(shortest_scientific).unwrap_or_default();
    for e in events {
        let _ = write!(
            text,
            "{},{},{:.14e},{},{},{},{:e},{:e},{}",
            quoted(&names[e.slider]),
            e.direction,
            e.onset,
            known(e.interval),
            known(e.duration),
            known(e.slip),
            e.peak_rate,
            e.least_rate,
            known(e.stress_drop)
        );
        for edge in [Some(&e.at_onset), e.at_end.as_ref()] {
            let _ = write!(text, ",{},{}", known(edge.map(|e| e.traction)), known(edge.map(|e| e.friction)));
            for i in 0..states {
                let _ = write!(text, ",{}", known(edge.and_then(|e| e.states.get(i).copied())));
            }
        }
        text.push('\n');
    }
    text
}

/// A name as a field of CSV.
fn quoted(name: &str) -> String {
    if name.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", name.replace('"', "\"\""))
    } else {
        name.to_string()
    }
}
