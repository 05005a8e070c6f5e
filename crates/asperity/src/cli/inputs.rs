//! Files that a scene names, copied into the output directory beside the scene, which can so be run again from there.

use asperity_output::atomic;
use asperity_plan::shared::amounts::size;
use asperity_plan::shared::sha256::sha256;
use miette::{IntoDiagnostic, WrapErr, miette};
use serde::Deserialize;
use std::collections::{BTreeMap, BTreeSet};
use std::ffi::OsStr;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Folder of the copies in the output directory.
pub const FOLDER: &str = "inputs";

/// A scene that names the copies of its files.
#[derive(Clone, Debug, Default)]
pub struct Inputs {
    /// Text of the scene.
    pub text: String,
    /// Files by the names of their copies.
    files: BTreeMap<String, PathBuf>,
}

impl Inputs {
    /// The scene of a text in a folder that names files at these positions. A scene that names copies already stays as it is.
    ///
    /// # Errors
    /// If a position does not hold the name.
    pub fn from_scene(text: &str, folder: &Path, named: &[(Range<usize>, &str)]) -> miette::Result<Self> {
        let (mut names, mut taken) = (BTreeMap::new(), BTreeSet::new());
        for (_, file) in named {
            names.entry(*file).or_insert_with(|| copy_name(file, &mut taken));
        }
        let mut ordered: Vec<&(Range<usize>, &str)> = named.iter().collect();
        ordered.sort_by_key(|(at, _)| at.start);
        ordered.dedup();
        let mut changed = text.to_string();
        // From the end, so that positions before stay what they are.
        for (at, file) in ordered.iter().rev() {
            if text.get(at.clone()).and_then(string).as_deref() != Some(*file) {
                return Err(miette!("the name of the file {file} is not where the scene has it"));
            }
            changed.replace_range(at.clone(), &toml::Value::from(names[file].as_str()).to_string());
        }
        let files = names.into_iter().map(|(file, name)| (name, folder.join(file))).collect();
        Ok(Self { text: changed, files })
    }

    /// SHA-256 of the files, by the names of their copies.
    ///
    /// # Errors
    /// If a file cannot be read.
    pub fn hashes(&self) -> miette::Result<BTreeMap<String, String>> {
        let hash = |(name, path): (&String, &PathBuf)| Ok((name.clone(), sha256([&read(path)?])));
        self.files.iter().map(hash).collect()
    }

    /// Copies the files into an output directory, unless they are there already. They must have these hashes.
    ///
    /// # Errors
    /// If a file has changed since, or cannot be read or written.
    pub fn copy(&self, out: &Path, hashes: &BTreeMap<String, String>) -> miette::Result<()> {
        for (name, path) in &self.files {
            let (to, hash) = (out.join(name), hashes.get(name));
            if fs::read(&to).is_ok_and(|bytes| Some(&sha256([&bytes])) == hash) {
                continue;
            }
            let bytes = read(path)?;
            if Some(&sha256([&bytes])) != hash {
                return Err(miette!("the file {} has changed since it was read: run again", path.display()));
            }
            atomic::create_dir(&out.join(FOLDER)).into_diagnostic()?;
            atomic::write(&to, &bytes).into_diagnostic()?;
        }
        Ok(())
    }

    /// Number and size of the files for the lines below the plan; `None` without files.
    #[must_use]
    pub fn words(&self) -> Option<String> {
        let bytes = |path| fs::metadata(path).map_or(0, |data| data.len());
        let bytes: u64 = self.files.values().map(bytes).sum();
        let files = match self.files.len() {
            0 => return None,
            1 => "1 file".into(),
            n => format!("{n} files"),
        };
        Some(format!("{files}, {}, copied to {FOLDER}/", size(usize::try_from(bytes).ok()?)))
    }
}

/// True if the text of a scene names a copy.
pub(super) fn names(scene: &str, copy: &OsStr) -> bool {
    copy.to_str().is_some_and(|copy| scene.contains(&format!("{FOLDER}/{copy}")))
}

/// Name of the copy of a file: its own below the folder, with a number if another file has it.
fn copy_name(file: &str, taken: &mut BTreeSet<String>) -> String {
    let path = Path::new(file);
    let part = |part: Option<&OsStr>| part.unwrap_or_default().to_string_lossy().into_owned();
    let (stem, ending) = (part(path.file_stem()), path.extension().map(|e| format!(".{}", part(Some(e)))));
    let numbered = |n: usize| {
        let number = if n > 1 { format!("-{n}") } else { String::new() };
        format!("{FOLDER}/{stem}{number}{}", ending.clone().unwrap_or_default())
    };
    let free = (1..).map(numbered).find(|name| !taken.contains(name)).unwrap_or_default();
    taken.insert(free.clone());
    free
}

/// Value of a string of TOML.
fn string(text: &str) -> Option<String> {
    #[derive(Deserialize)]
    struct Only {
        value: String,
    }
    toml::from_str::<Only>(&format!("value = {text}")).ok().map(|only| only.value)
}

fn read(path: &Path) -> miette::Result<Vec<u8>> {
    fs::read(path).into_diagnostic().wrap_err_with(|| format!("cannot read the file {}", path.display()))
}
