//! Titles that fit on the canvas.

use super::axes::{Frame, LABEL_TEXT};
use super::colour::INK;
use super::figure::{Anchor, Figure};
use super::width::CHARACTER;

/// Margin at the right end.
const MARGIN: f64 = 12.0;
/// Smallest em size that is still easy to read.
const SMALLEST: f64 = 10.5;
/// Distance from the last line of a title to the frame.
const ABOVE: f64 = 14.0;

/// Draws a title of scene and part above the frame. A long title is smaller or has two lines; if these do not suffice, the name
/// of the scene is shortened.
pub(super) fn title(figure: &mut Figure, frame: &Frame, scene: &str, part: &str) {
    let room = figure.width - frame.at.0 - MARGIN;
    let (lines, size) = shortened(scene, part, room);
    let bottom = frame.at.1 - if lines.len() > 1 { ABOVE - 2.0 } else { ABOVE + 4.0 };
    for (k, line) in lines.iter().rev().enumerate() {
        let y = bottom - k as f64 * 1.25 * size;
        figure.text((frame.at.0, y), line.as_str(), size, Anchor::Start, INK);
    }
}

/// Lines and em size of a title, with as much of the scene as fits in addition to the part.
fn shortened(scene: &str, part: &str, room: f64) -> (Vec<String>, f64) {
    let tail = if part.is_empty() { String::new() } else { format!(": {part}") };
    let whole = fit(&format!("{scene}{tail}"), room);
    if whole.2 {
        return (whole.0, whole.1);
    }
    let characters: Vec<char> = scene.chars().collect();
    let cut =
        |kept: usize| fit(&format!("{}\u{2026}{tail}", characters[..kept].iter().collect::<String>()), room);
    let fitting = (0..characters.len()).rev().map(cut).find(|found| found.2);
    let (lines, size, _) = fitting.unwrap_or(whole);
    (lines, size)
}

/// Lines and em size of a text for a width of `room`; true if the text is complete.
fn fit(text: &str, room: f64) -> (Vec<String>, f64, bool) {
    let characters = |text: &str| text.chars().count() as f64;
    let one = room / (CHARACTER * characters(text).max(1.0));
    if one >= SMALLEST {
        return (vec![text.to_string()], one.min(LABEL_TEXT), true);
    }
    let most = (room / (CHARACTER * SMALLEST)) as usize;
    let (first, rest) = part(text, most);
    let (second, left) = part(&rest, most);
    let whole = left.is_empty();
    let cut = || second.chars().take(most.saturating_sub(1)).chain(['\u{2026}']).collect();
    let second = if whole { second.clone() } else { cut() };
    (vec![first, second], SMALLEST, whole)
}

/// Splits off the words that fit `most` characters, at least one word or a part of it, from the remainder.
fn part(text: &str, most: usize) -> (String, String) {
    if text.chars().count() <= most {
        return (text.to_string(), String::new());
    }
    let end = text.char_indices().nth(most).map_or(text.len(), |(byte, _)| byte);
    // An equation is not broken beside its sign.
    let breaks = |at: &usize| *at > 0 && !text[..*at].ends_with('=') && !text[at + 1..].starts_with('=');
    let cut = text[..end].rmatch_indices(' ').map(|(at, _)| at).find(breaks).unwrap_or(end);
    (text[..cut].to_string(), text[cut..].trim_start().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_equation_stays_in_one_line() {
        assert_eq!(part("slip ahead of event 1, t = 36 yr", 25).0, "slip ahead of event 1,");
        assert_eq!(part("slip ahead of event 1, t = 36 yr", 27).0, "slip ahead of event 1,");
    }

    #[test]
    fn titles_of_any_length_stay_on_the_canvas() {
        let words = "a title whose author had much to say about cycles of faults ".repeat(8);
        let one = "x".repeat(500);
        for text in ["short", &words[..80], &words[..130], &words, &one, "äöü ".repeat(90).as_str(), ""] {
            for room in [250.0, 600.0] {
                let (lines, size, _) = fit(text, room);
                assert!(
                    (1..=2).contains(&lines.len()) && (SMALLEST..=LABEL_TEXT).contains(&size),
                    "{lines:?}"
                );
                for line in &lines {
                    assert!(
                        CHARACTER * size * line.chars().count() as f64 <= room + 1e-9,
                        "{line} at {size}"
                    );
                }
            }
        }
        assert_eq!(fit("short", 600.0), (vec!["short".to_string()], LABEL_TEXT, true));
        let (lines, _) = shortened(&words, "end of stage", 600.0);
        assert!(lines[1].ends_with("\u{2026}: end of stage"), "{lines:?}");
    }
}
