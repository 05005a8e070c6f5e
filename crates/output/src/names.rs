//! File names.

/// Most characters of a name in the name of a file, so that its end has room within the 255 of file systems.
const MOST: usize = 100;

/// File names for interfaces. Letters, digits, `-` and `_` are kept, other characters become `_`; long names are cut, and names that
/// would collide get a number.
#[must_use]
pub fn stems<'a>(names: impl Iterator<Item = &'a str>) -> Vec<String> {
    let mut taken: Vec<String> = vec!["bodies".to_string()];
    for (i, name) in names.enumerate() {
        let safe = |c: char| if c.is_ascii_alphanumeric() || c == '-' || c == '_' { c } else { '_' };
        let mut stem: String = name.chars().map(safe).take(MOST).collect();
        while stem.is_empty() || taken.contains(&stem) {
            stem = format!("{stem}-{i}");
        }
        taken.push(stem);
    }
    taken.split_off(1)
}
