//! File names.

/// File names for interfaces. Letters, digits, `-` and `_` are kept, other characters become `_`; names that would collide get a
/// number.
#[must_use]
pub fn stems<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken: Vec<String> = vec!["bodies".to_string()];
    for (i, name) in names.enumerate() {
        let safe = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
        let mut stem: String = name.chars().map(safe).collect();
        while stem.is_empty() || taken.contains(&stem) {
            stem = format!("{stem}-{i}");
        }
        taken.push(stem);
    }
    taken.split_off(1)
}
