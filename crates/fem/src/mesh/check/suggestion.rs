//! Suggestion of the group that was probably meant.

/// The nearest of `known` to `name`, if it is close enough to have been meant: at most one edit, and one more for every four
/// letters of the shorter name.
pub(crate) fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    known
        .into_iter()
        .map(|k| (strsim::damerau_levenshtein(&lower, &k.to_lowercase()), k))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, k)| {
            let shorter = k.chars().count().min(name.chars().count());
            *d < shorter && *d <= 1 + shorter / 4
        })
        .map(|(_, k)| k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_far_from_all_is_not_corrected() {
        assert_eq!(nearest("fault", ["lower", "Fault "]), Some("Fault "));
        assert_eq!(nearest("fault", ["lower", "upper"]), None);
        assert_eq!(nearest("botom", ["top", "bottom"]), Some("bottom"));
    }
}
