//! Provenance of a report: the machine-dependent facts, kept under one key.

use schemars::JsonSchema;
use serde::Serialize;
use std::process::Command;
use std::time::{SystemTime, UNIX_EPOCH};

/// Facts of a run that may differ from machine to machine.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Provenance {
    /// Version of the suite.
    pub version: String,
    /// Commit of the sources, followed by `+` if they were modified; empty outside a repository.
    pub commit: String,
    /// Command that was run.
    pub command: String,
    /// Compiler and build profile.
    pub compiler: String,
    /// Time of completion, UTC.
    pub date: String,
    /// Operating system and processor.
    pub machine: String,
    /// Threads available.
    pub threads: usize,
    /// True if the long cases were included.
    pub full: bool,
    /// True if the workspace tests passed immediately before.
    pub tested: bool,
    /// Total wall time \[s\].
    pub wall: f64,
}

impl Provenance {
    /// Collects the provenance of the current run.
    pub fn gather(full: bool, tested: bool, wall: f64) -> Provenance {
        let seconds = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
        Provenance {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            commit: commit().unwrap_or_default(),
            command: command(),
            compiler: format!("{}, {}", env!("ASPERITY_COMPILER"), env!("ASPERITY_PROFILE")),
            date: utc(seconds),
            machine: machine(),
            threads: std::thread::available_parallelism().map_or(1, std::num::NonZero::get),
            full,
            tested,
            wall,
        }
    }
}

/// The command line, without the folder of the program.
fn command() -> String {
    let mut arguments = std::env::args();
    let program = arguments.next().unwrap_or_default();
    let name = std::path::Path::new(&program).file_name().map(|name| name.to_string_lossy().into_owned());
    name.into_iter().chain(arguments).collect::<Vec<_>>().join(" ")
}

fn commit() -> Option<String> {
    let git = |arguments: &[&str]| {
        let output = Command::new("git").args(arguments).output().ok().filter(|o| o.status.success())?;
        String::from_utf8(output.stdout).ok()
    };
    let hash = git(&["rev-parse", "--short=12", "HEAD"])?;
    let changed =
        git(&["status", "--porcelain", "--untracked-files=no"]).is_none_or(|s| !s.trim().is_empty());
    Some(format!("{}{}", hash.trim(), if changed { "+" } else { "" }))
}

fn machine() -> String {
    let system = format!("{} {}", std::env::consts::OS, std::env::consts::ARCH);
    let info = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model =
        info.lines().find(|line| line.starts_with("model name")).and_then(|line| line.split(": ").nth(1));
    model.map_or(system.clone(), |model| format!("{system}, {}", model.trim()))
}

/// Seconds since 1970 as `YYYY-MM-DD HH:MM UTC`, by Howard Hinnant's `civil_from_days`, which counts years from March so that
/// the leap day is the last of its year.
pub fn utc(seconds: u64) -> String {
    let (days, rest) = (seconds / 86_400, seconds % 86_400);
    let shifted = days + 719_468;
    let (era, day_of_era) = (shifted / 146_097, shifted % 146_097);
    let year_of_era = (day_of_era - day_of_era / 1_460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * from_march + 2) / 5 + 1;
    let month = if from_march < 10 { from_march + 3 } else { from_march - 9 };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    format!("{year:04}-{month:02}-{day:02} {:02}:{:02} UTC", rest / 3600, rest / 60 % 60)
}
