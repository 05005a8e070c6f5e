//! Sources of the benchmarks that others can enter.

/// Benchmarks, and the keys of their own entry and of what they rest on.
const BENCHMARKS: [(&str, &[&str]); 6] = [
    ("sandwich/v1", &["asperity-sandwich-v1", "xing2002b", "rice1996"]),
    ("sandwich-state/v1", &["asperity-sandwich-state-v1", "dieterich1979", "rice1993"]),
    ("fault-bend/v1", &["asperity-fault-bend-v1", "hirth1982"]),
    ("hertz/v1", &["asperity-hertz-v1", "hertz1882", "johnson1985"]),
    ("partial-slip/v1", &["asperity-partial-slip-v1", "cattaneo1938", "mindlin1949", "mindlin1953"]),
    ("seas-bp1-quick/v1", &["asperity-seas-bp1-quick-v1", "erickson2020", "dieterich1979"]),
];

/// Names of the benchmarks.
#[cfg(test)]
pub(super) fn names() -> impl Iterator<Item = &'static str> {
    BENCHMARKS.iter().map(|row| row.0)
}

/// Keys of a benchmark; `None` if there is no such benchmark.
#[must_use]
pub(super) fn keys(name: &str) -> Option<&'static [&'static str]> {
    BENCHMARKS.iter().find(|row| row.0 == name).map(|row| row.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::benchmark;

    #[test]
    fn every_benchmark_has_its_own_entry() {
        let known: Vec<&str> = names().collect();
        let all: Vec<&str> = benchmark::all().iter().map(|r| r.benchmark.as_str()).collect();
        assert_eq!(known, all);
        for name in known {
            let own = format!("asperity-{}", name.split('/').collect::<Vec<_>>().join("-"));
            assert_eq!(keys(name).unwrap()[0], own);
        }
    }
}
