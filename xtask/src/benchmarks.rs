//! Files of the community benchmarks, and one archive of all of them.

use crate::stage::{Failure, Stage};
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tar::{Builder, EntryType, Header};
use walkdir::WalkDir;

/// Folder of the benchmarks; the pages on speed lie beside them.
const FOLDER: &str = "docs/src/benchmarks";
/// Name of the licence of the values.
const LICENCE: &str = "LICENSE-CC0";
/// Permissions of files in the archive.
const MODE: u32 = 0o644;

/// Choice of benchmarks and of the work on them.
pub struct Choice {
    /// Benchmarks with this in their names; all if absent.
    pub only: Option<String>,
    /// True to run nothing and write only the files derived from others.
    pub pages: bool,
    /// Archive to write instead of the files.
    pub archive: Option<PathBuf>,
}

/// Writes the files of the benchmarks, or their archive.
pub fn run(root: &Path, choice: &Choice) -> Result<(), Failure> {
    if let Some(path) = &choice.archive {
        let failed = |source| Failure::Write { path: path.clone(), source };
        let bytes = archive(&root.join(FOLDER)).map_err(failed)?;
        return fs::write(path, bytes).map_err(failed);
    }
    let binary = ["run", "--release", "-p", "asperity-verification", "--bin", "asperity-benchmarks", "--"];
    let mut stage = Stage::new("benchmarks", "cargo").args(binary);
    if choice.pages {
        stage = stage.args(["--pages"]);
    }
    if let Some(part) = &choice.only {
        stage = stage.args([part.as_str()]);
    }
    stage.run(root)
}

/// Archive of the licence and all files of the benchmarks. It is reproducible: files are sorted by name, without times
/// and owners.
fn archive(folder: &Path) -> io::Result<Vec<u8>> {
    let mut builder = Builder::new(Vec::new());
    let walk = WalkDir::new(folder).min_depth(1).sort_by_file_name();
    for entry in walk {
        let entry = entry?;
        let Ok(name) = entry.path().strip_prefix(folder) else { continue };
        // Pages in the folder itself are about speed.
        let kept = entry.depth() > 1 || name == Path::new(LICENCE);
        if entry.file_type().is_file() && kept {
            let place: Vec<&str> = name.iter().filter_map(|part| part.to_str()).collect();
            add(&mut builder, &format!("asperity-benchmarks/{}", place.join("/")), &fs::read(entry.path())?)?;
        }
    }
    let mut bytes = builder.into_inner()?;
    bytes.flush()?;
    Ok(bytes)
}

fn add(builder: &mut Builder<Vec<u8>>, name: &str, bytes: &[u8]) -> io::Result<()> {
    let mut header = Header::new_ustar();
    header.set_entry_type(EntryType::Regular);
    header.set_size(bytes.len() as u64);
    header.set_mode(MODE);
    header.set_mtime(0);
    header.set_uid(0);
    header.set_gid(0);
    builder.append_data(&mut header, name, bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;
    use std::io::Read;

    fn folder() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(FOLDER)
    }

    #[test]
    fn an_archive_is_the_same_twice_and_knows_no_time_or_owner() {
        let bytes = archive(&folder()).unwrap();
        // A copy has other modification times and another order on disk.
        let copy = std::env::temp_dir().join(format!("asperity-benchmarks-{}", std::process::id()));
        for entry in WalkDir::new(folder()).into_iter().map(Result::unwrap) {
            let to = copy.join(entry.path().strip_prefix(folder()).unwrap());
            if entry.file_type().is_dir() {
                fs::create_dir_all(to).unwrap();
            } else {
                fs::write(to, fs::read(entry.path()).unwrap()).unwrap();
            }
        }
        let again = archive(&copy).unwrap();
        fs::remove_dir_all(&copy).unwrap();
        assert!(bytes == again);
        for entry in tar::Archive::new(&bytes[..]).entries().unwrap() {
            let entry = entry.unwrap();
            let header = entry.header();
            let told = (header.mtime().unwrap(), header.uid().unwrap(), header.gid().unwrap());
            assert_eq!((told, header.mode().unwrap()), ((0, 0, 0), MODE));
        }
    }

    #[test]
    fn an_archive_has_every_benchmark_whole_and_no_page_of_speed() {
        let bytes = archive(&folder()).unwrap();
        let mut found = BTreeMap::new();
        for entry in tar::Archive::new(&bytes[..]).entries().unwrap() {
            let mut entry = entry.unwrap();
            let mut content = Vec::new();
            entry.read_to_end(&mut content).unwrap();
            found.insert(entry.path().unwrap().to_str().unwrap().to_owned(), content);
        }
        assert!(found.contains_key("asperity-benchmarks/LICENSE-CC0"));
        assert!(!found.keys().any(|name| name.ends_with("benchmarks/assembly.md")));
        for name in ["sandwich/v1", "hertz/v1", "seas-bp1-quick/v1"] {
            for file in [
                "README.md",
                "sketch.svg",
                "reference.json",
                "reference.csv",
                "template.csv",
                "results/asperity.csv",
            ] {
                let content = &found[&format!("asperity-benchmarks/{name}/{file}")];
                assert!(*content == fs::read(folder().join(name).join(file)).unwrap(), "{name}/{file}");
            }
        }
    }
}
