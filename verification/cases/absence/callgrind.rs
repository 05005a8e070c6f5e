//! Instructions of a run by source file, counted by callgrind.

use crate::CaseError;
use crate::cases::programs;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Instructions executed in the source files of the workspace: paths from its root, such as `crates/contact/src/shear.rs`.
pub type Instructions = BTreeMap<String, u64>;

/// Folder of the results under callgrind.
pub const COUNTED: &str = "out";
/// Folder of the results on this processor.
pub const NATIVE: &str = "native";

/// True if callgrind can be started.
pub fn is_installed() -> bool {
    let version =
        Command::new("valgrind").arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    version.is_ok_and(|status| status.success())
}

/// Runs the scenes of these folders one after the other in one process under callgrind, which translates the program once.
/// Returns their counts.
///
/// # Errors
/// If a run fails.
pub fn run(folder: &Path, scenes: &[PathBuf]) -> Result<Vec<Instructions>, CaseError> {
    let counts = folder.join("callgrind.out");
    let out = format!("--callgrind-out-file={}", counts.display());
    let names = ["--compress-strings=no", "--compress-pos=no", "--dump-after=*run_in_folder*"];
    let tool = [["valgrind", "--tool=callgrind"].as_slice(), &names, &[&out]].concat();
    let mut command = programs::in_folders(&tool, COUNTED, scenes)?;
    programs::finished(command.env("RAYON_NUM_THREADS", "1"), &[0])?;
    let part = |k: usize| PathBuf::from(format!("{}.{k}", counts.display()));
    (1..=scenes.len()).map(|k| Ok(read(&std::fs::read_to_string(part(k))?))).collect()
}

/// Runs the scenes of these folders on this processor with three threads.
///
/// # Errors
/// If a run fails.
pub fn run_native(scenes: &[PathBuf]) -> Result<(), CaseError> {
    let mut command = programs::in_folders(&[], NATIVE, scenes)?;
    programs::finished(command.env("RAYON_NUM_THREADS", "3"), &[0]).map(drop)
}

/// True if this processor has vectors of 512 bits, of which callgrind knows nothing: programs under it use 256.
pub fn narrows_vectors() -> bool {
    #[cfg(target_arch = "x86_64")]
    return std::arch::is_x86_feature_detected!("avx512f");
    #[cfg(not(target_arch = "x86_64"))]
    return false;
}

/// Begin of the names of closures that `map` of arrays calls.
const CALLED_CLOSURE: &str = "<core::ops::try_trait::Wrapped<";

/// Costs of a function by source file of the workspace, all of its costs, and the number of its calls.
#[derive(Default)]
struct Function<'a> {
    of_files: BTreeMap<&'a str, u64>,
    all: u64,
    calls: u64,
}

/// Sums the costs in callgrind output by source file. Inlined code counts for the file in which it is written.
///
/// Cost lines are `line cost`, after a line `fl=`, `fi=` or `fe=` that names their file, and a line `fn=` that names their
/// function. A line after `calls=` holds the cost of a call, which is counted in the function of the line `cfn=`. Instructions of
/// line 0 belong to no line of the source.
///
/// A function of one instruction is empty. Empty functions of several files may be one in the program, which has the name of any
/// of them, so that they count for no file. Neither do closures that `map` of arrays calls without inlining
/// them: equal ones are one as well, and the function that maps has instructions of its own.
fn read(text: &str) -> Instructions {
    let mut functions: BTreeMap<&str, Function<'_>> = BTreeMap::new();
    let (mut file, mut function, mut called, mut is_call) = (None, "", "", false);
    for line in text.lines() {
        if let Some(path) = ["fl=", "fi=", "fe="].iter().find_map(|key| line.strip_prefix(key)) {
            file = workspace_path(path);
        } else if let Some(name) = line.strip_prefix("fn=") {
            function = name;
        } else if let Some(name) = line.strip_prefix("cfn=") {
            called = name;
        } else if let Some(count) = line.strip_prefix("calls=") {
            is_call = true;
            let count = count.split(' ').next().and_then(|count| count.parse().ok());
            functions.entry(called).or_default().calls += count.unwrap_or(0);
        } else if line.starts_with(|c: char| c.is_ascii_digit()) {
            let mut numbers = line.split(' ').map(|word| word.parse::<u64>().unwrap_or(0));
            let (place, cost) = (numbers.next().unwrap_or(0), numbers.next().unwrap_or(0));
            if !is_call {
                let of = functions.entry(function).or_default();
                of.all += cost;
                if let Some(name) = file.filter(|_| place > 0) {
                    *of.of_files.entry(name).or_default() += cost;
                }
            }
            is_call = false;
        }
    }
    let mut sums = Instructions::new();
    functions.retain(|name, function| function.all != function.calls && !name.starts_with(CALLED_CLOSURE));
    for (name, cost) in functions.values().flat_map(|function| &function.of_files) {
        *sums.entry((*name).to_owned()).or_default() += cost;
    }
    sums
}

/// Path of a file of the workspace's crates, relative to its root.
fn workspace_path(path: &str) -> Option<&str> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?.to_str()?;
    path.strip_prefix(root)?.strip_prefix('/').or(Some(path)).filter(|p| p.starts_with("crates/"))
}
