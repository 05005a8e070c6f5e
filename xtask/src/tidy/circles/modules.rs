//! The modules of a crate and the references between them.

use super::paths::{Binding, Names};
use std::collections::{BTreeMap, BTreeSet};

/// A module: its path from the root of its crate, and the names in its source.
pub struct Module {
    /// Path; empty for the root.
    pub path: Vec<String>,
    /// Names in its source.
    pub names: Names,
}

/// The modules of a crate.
pub struct Crate {
    modules: Vec<Module>,
    at: BTreeMap<Vec<String>, usize>,
}

/// Number of re-exports after which names are taken to re-export each other in a loop.
const MOST_PASSES: usize = 16;

impl Crate {
    /// A crate of these modules.
    pub fn new(modules: Vec<Module>) -> Crate {
        let at = modules.iter().enumerate().map(|(i, module)| (module.path.clone(), i)).collect();
        Crate { modules, at }
    }

    /// For each module, the modules whose items it names. A re-exported name counts for the module that defines it, and
    /// a re-export itself is not counted.
    pub fn edges(&self) -> Vec<BTreeSet<usize>> {
        (0..self.modules.len()).map(|from| self.named_by(from)).collect()
    }

    fn named_by(&self, from: usize) -> BTreeSet<usize> {
        let names = &self.modules[from].names;
        let mut found = BTreeSet::new();
        for binding in names.bindings.iter().filter(|binding| !binding.public) {
            match self.resolve(from, &binding.path, MOST_PASSES) {
                // A glob import counts as a use of the module; items of modules imported by name count where the code
                // names them.
                Some(Target::Module(to)) if binding.name.is_none() => _ = found.insert(to),
                Some(Target::Item(to)) => _ = found.insert(to),
                _ => {}
            }
        }
        for path in &names.paths {
            if let Some(Target::Item(to)) = self.resolve(from, path, MOST_PASSES) {
                found.insert(to);
            }
        }
        found.remove(&from);
        found
    }

    /// Target of a path in a module, or `None` if it leads out of the crate.
    fn resolve(&self, from: usize, path: &[String], passes: usize) -> Option<Target> {
        let (first, rest) = path.split_first()?;
        let start = match first.as_str() {
            "crate" => Target::Module(*self.at.get(&Vec::new())?),
            "self" => Target::Module(from),
            "super" => Target::Module(self.parent(from)?),
            name => self.member(from, name, passes).filter(|target| !matches!(target, Target::Own))?,
        };
        self.follow(start, rest, passes)
    }

    fn follow(&self, start: Target, rest: &[String], passes: usize) -> Option<Target> {
        let mut here = start;
        for segment in rest {
            let Target::Module(module) = here else { break };
            here = match segment.as_str() {
                "super" => Target::Module(self.parent(module)?),
                name => match self.member(module, name, passes) {
                    // A name that is not found comes from a macro.
                    Some(Target::Own) | None => Target::Item(module),
                    Some(target) => target,
                },
            };
        }
        Some(here)
    }

    /// Meaning of a name inside a module.
    fn member(&self, module: usize, name: &str, passes: usize) -> Option<Target> {
        let passes = passes.checked_sub(1)?;
        let Module { path, names } = &self.modules[module];
        let child: Vec<String> = path.iter().cloned().chain([name.to_owned()]).collect();
        if let Some(&child) = self.at.get(&child) {
            return Some(Target::Module(child));
        }
        if names.items.iter().any(|item| item == name) {
            return Some(Target::Own);
        }
        let named = |binding: &&Binding| binding.name.as_deref() == Some(name) && binding.path != [name];
        if let Some(binding) = names.bindings.iter().find(named) {
            return self.resolve(module, &binding.path, passes).or(Some(Target::Outside));
        }
        let all = names.bindings.iter().filter(|binding| binding.name.is_none());
        let mut through = all.filter_map(|binding| match self.resolve(module, &binding.path, passes)? {
            Target::Module(other) if other != module => match self.member(other, name, passes)? {
                Target::Own => Some(Target::Item(other)),
                target => Some(target),
            },
            _ => None,
        });
        through.next()
    }

    fn parent(&self, module: usize) -> Option<usize> {
        let (_, parent) = self.modules[module].path.split_last()?;
        self.at.get(parent).copied()
    }
}

/// Target of a path.
#[derive(Clone, Copy, Debug)]
enum Target {
    /// A module.
    Module(usize),
    /// An item that a module defines.
    Item(usize),
    /// An item of the module in which it was looked up.
    Own,
    /// An item of another crate, re-exported here.
    Outside,
}
