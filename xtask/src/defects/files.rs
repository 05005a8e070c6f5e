//! Files of the copy.

use crate::stage::Failure;
use std::path::{Path, PathBuf};
use walkdir::WalkDir;

/// Copies the sources. Unchanged files keep their times, so that little is rebuilt.
pub(super) fn copy(from: &Path, to: &Path) -> Result<(), Failure> {
    let skipped = |name: &str, depth| name == ".git" || depth == 1 && (name == "target" || name == "out");
    let walk = WalkDir::new(from).sort_by_file_name().into_iter();
    for entry in walk.filter_entry(|e| !skipped(&e.file_name().to_string_lossy(), e.depth())) {
        let entry = entry?;
        let path = entry.path();
        let target = to.join(path.strip_prefix(from).unwrap_or(path));
        if entry.file_type().is_dir() {
            create(&target)?;
        } else if entry.file_type().is_file() {
            let bytes = std::fs::read(path).map_err(failed(path))?;
            if std::fs::read(&target).ok().as_ref() != Some(&bytes) {
                std::fs::write(&target, &bytes).map_err(failed(&target))?;
            }
        }
    }
    Ok(())
}

pub(super) fn failed(path: &Path) -> impl Fn(std::io::Error) -> Failure {
    let path = PathBuf::from(path);
    move |source| Failure::Read { path: path.clone(), source }
}

fn create(folder: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(folder).map_err(failed(folder))
}

pub(super) fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(failed(path))
}

pub(super) fn write(path: &Path, text: &str) -> Result<(), Failure> {
    std::fs::write(path, text).map_err(failed(path))
}
