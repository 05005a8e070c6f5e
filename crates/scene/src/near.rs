//! What was probably meant: the nearest of the names that exist.

/// Edit distance of two names: insertions, deletions, substitutions and transpositions of neighbours.
#[must_use]
pub fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i.max(j)
            } else {
                let change = usize::from(a[i - 1] != b[j - 1]);
                let mut best = (rows[i - 1][j] + 1).min(rows[i][j - 1] + 1).min(rows[i - 1][j - 1] + change);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(rows[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    rows[a.len()][b.len()]
}

/// The nearest of `known` to `name`, where it is near enough to have been meant.
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let lower = name.to_lowercase();
    known
        .into_iter()
        .map(|k| (distance(&lower, &k.to_lowercase()), k))
        .min_by_key(|(d, _)| *d)
        .filter(|(d, k)| {
            let shorter = k.chars().count().min(name.chars().count());
            *d < shorter && *d <= 1 + shorter / 4
        })
        .map(|(_, k)| k)
}

/// "did you mean `x`? the sets are x, y, z".
#[must_use]
pub fn suggest<'a>(name: &str, what: &str, known: impl IntoIterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.into_iter().collect();
    let list = match known[..] {
        [] => format!("there are no {what}"),
        [only] => format!("of the {what} there is only {only}"),
        _ => format!("the {what} are {}", known.join(", ")),
    };
    match nearest(name, known.iter().copied()) {
        Some(meant) => format!("did you mean `{meant}`? {list}"),
        None => list,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_counts_edits() {
        assert_eq!(distance("poison", "poisson"), 1);
        assert_eq!(distance("slaev", "slave"), 1);
        assert_eq!(distance("", "abc"), 3);
        assert_eq!(distance("kitten", "sitting"), 3);
    }

    #[test]
    fn a_name_far_from_all_is_not_corrected() {
        assert_eq!(nearest("granit", ["granite", "gouge"]), Some("granite"));
        assert_eq!(nearest("steel", ["granite", "gouge"]), None);
        assert_eq!(nearest("A", ["B", "C"]), None);
    }
}
