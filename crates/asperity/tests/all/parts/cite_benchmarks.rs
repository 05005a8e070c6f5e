use asperity_reference::benchmark;
use asperity_reference::cite::benchmarks::*;

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
