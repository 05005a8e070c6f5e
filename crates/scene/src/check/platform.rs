//! Files of the platform of a community benchmark.

use super::Checker;

impl Checker<'_> {
    /// Checks what the heads of the files say.
    pub(super) fn platform(&mut self) {
        let Some(asked) = &self.scene.output.platform else { return };
        let spec = asked.get_ref();
        if let Some(date) = spec.date.as_ref().filter(|d| !is_date(d.get_ref())) {
            self.error(
                date.span(),
                format!("`{}` is no date", date.get_ref().escape_debug()),
                format!("year, month and day, such as `date = \"{}\"`", example("date")),
            );
            return;
        }
        let texts = [
            ("problem", Some(&spec.problem)),
            ("modeler", Some(&spec.modeler)),
            ("date", spec.date.as_ref()),
        ];
        for (key, text) in texts.into_iter().filter_map(|(key, text)| Some((key, text?))) {
            let value = text.get_ref();
            if value.trim().is_empty() || value.chars().any(char::is_control) {
                self.error(
                    text.span(),
                    format!("`{key}` must be one line of printable characters"),
                    format!("such as `{key} = \"{}\"`", example(key)),
                );
            }
        }
    }
}

/// True for a year, a month and a day with `/` or `-` between them, in numbers that a calendar may have.
fn is_date(text: &str) -> bool {
    let parts: Vec<&str> = text.split(['/', '-']).collect();
    let [year, month, day] = parts[..] else { return false };
    let within = |text: &str, digits: usize, range: std::ops::RangeInclusive<u32>| {
        let plain = text.len() == digits && text.bytes().all(|b| b.is_ascii_digit());
        plain && text.parse().is_ok_and(|number| range.contains(&number))
    };
    within(year, 4, 1900..=2999) && within(month, 2, 1..=12) && within(day, 2, 1..=31)
}

fn example(key: &str) -> &'static str {
    match key {
        "problem" => "SEAS Benchmark BP5-QD",
        "modeler" => "A. Author",
        _ => "2026/11/26",
    }
}
