//! Files written during the run, so that no results are lost if it stops: fields for ParaView, profiles and probes.
//!
//! ```text
//! fields.pvd  fields/bodies_00001.vtu  fields/fault_00001.vtu  profiles/fault_001.csv  probes/fault.csv  points/tip.csv
//! forces/left.csv  springs/block.top.y.csv
//! ```

use super::fields::SlaveSide;
use super::record::{check_interfaces, check_probes, check_samples};
use super::sample_sites::SampleSites;
use super::schedule::{FieldSchedule, OutputIntervals};
use super::view::{BodyFields, InterfaceFields, Setup, SpringValues, StepRecord, StepView, Writer};
use super::{fields, tables};
use crate::atomic;
use crate::error::OutputError;
use crate::fields::vtu::{PvdEntry, pvd};
use crate::fields::{COLLECTION, Field, Series};
use crate::names::stems;
use crate::tables::GrowingTable;
use crate::tables::column::{self, Column};
use crate::tables::describe::FileParts;
use crate::tables::energy;
use crate::tables::history::history_row;
use serde::{Deserialize, Serialize};
use std::fs;
use std::path::{Path, PathBuf};

/// Writes fields, profiles and probes into a directory during the run. Each file appears complete; tables of probes grow by whole
/// rows.
#[derive(Debug)]
pub struct Files {
    out: PathBuf,
    schedule: FieldSchedule,
    fields_due: OutputIntervals,
    profiles_due: OutputIntervals,
    /// Fields of the bodies, from the first ones on, which tell whether a material is plastic.
    bodies: Option<Series<'static, BodyFields>>,
    interfaces: Vec<Part>,
    points: Vec<GrowingTable>,
    forces: Vec<GrowingTable>,
    energy: Option<GrowingTable>,
    springs: Vec<GrowingTable>,
    /// Largest slip rates of the interfaces that are searched for events.
    rates: Option<GrowingTable>,
    collection: Vec<PvdEntry>,
    field_number: usize,
    /// Times of the last profiles and the last fields written \[s\].
    written: [Option<f64>; 2],
    profile_number: usize,
    setup: Setup,
    /// Position to resume from, until the run begins.
    resumed: Option<FilesState>,
}

/// Constant data of an interface.
#[derive(Debug)]
struct Part {
    /// Stem of its file names.
    stem: String,
    fields: Series<'static, SlaveSide>,
    /// Displacement of its master side.
    master: Series<'static, Vec<[f64; 3]>>,
    probes: Option<GrowingTable>,
}

/// Positions in the files of a run, from which it can be resumed.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct FilesState {
    /// Number of intervals of each stage for which fields and profiles have been written.
    passed: [Vec<usize>; 2],
    /// Numbers of the last fields and the last profiles written.
    numbers: [usize; 2],
    /// Times of the last profiles and the last fields written \[s\].
    written: [Option<f64>; 2],
    collection: Vec<PvdEntry>,
    /// Bytes of the tables: first those of probes, then of points, of forces, of springs, of the energy budget and of the largest
    /// slip rates.
    bytes: Vec<u64>,
}

impl Files {
    /// Creates the directory and checks that it can be written to.
    ///
    /// # Errors
    /// If the directory cannot be created or written to.
    pub fn create(out: &Path, schedule: FieldSchedule) -> Result<Self, OutputError> {
        atomic::writable_dir(out)?;
        Ok(Self {
            out: out.to_path_buf(),
            schedule,
            fields_due: OutputIntervals::default(),
            profiles_due: OutputIntervals::default(),
            bodies: None,
            interfaces: Vec::new(),
            points: Vec::new(),
            forces: Vec::new(),
            energy: None,
            springs: Vec::new(),
            rates: None,
            collection: Vec::new(),
            field_number: 0,
            written: [None; 2],
            profile_number: 0,
            setup: Setup::default(),
            resumed: None,
        })
    }

    /// Resumes a run from these positions in its files. Output written after them is removed.
    #[must_use]
    pub fn resumed(self, from: FilesState) -> Self {
        Self { resumed: Some(from), ..self }
    }

    /// Positions in the files.
    #[must_use]
    pub fn state(&self) -> FilesState {
        FilesState {
            passed: [self.fields_due.passed().to_vec(), self.profiles_due.passed().to_vec()],
            numbers: [self.field_number, self.profile_number],
            written: self.written,
            collection: self.collection.clone(),
            bytes: self.tables().map(GrowingTable::bytes).collect(),
        }
    }

    /// Flushes all rows to disk.
    ///
    /// # Errors
    /// If something cannot be written.
    pub fn settle(&self) -> Result<(), OutputError> {
        self.tables().try_for_each(GrowingTable::settle)
    }

    /// All tables.
    fn tables(&self) -> impl Iterator<Item = &GrowingTable> {
        let probes = self.interfaces.iter().filter_map(|part| part.probes.as_ref());
        probes
            .chain(&self.points)
            .chain(&self.forces)
            .chain(&self.springs)
            .chain(&self.energy)
            .chain(&self.rates)
    }

    /// Output directory.
    #[must_use]
    pub fn directory(&self) -> &Path {
        &self.out
    }

    /// Data sets written so far.
    #[must_use]
    pub fn collection(&self) -> &[PvdEntry] {
        &self.collection
    }

    fn write_fields(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        if self.setup.mesh.cells.is_empty() {
            return Ok(());
        }
        self.field_number += 1;
        self.written[1] = Some(view.record.time);
        let (number, time, mesh) = (self.field_number, view.record.time, &self.setup.mesh);
        let mut entries = Vec::with_capacity(1 + 2 * self.interfaces.len());
        let shown_bodies = (view.fields)();
        fields::check(mesh, &shown_bodies)?;
        let plastic = !shown_bodies.cell_plastic_strain.is_empty();
        let bodies = self.bodies.get_or_insert_with(|| fields::body_series(mesh, plastic));
        bodies.write(&self.out, number, time, &shown_bodies)?;
        entries.push(PvdEntry { time, part: 0, name: "bodies".to_string(), file: bodies.file(number) });
        for (i, (part, shown)) in self.interfaces.iter().zip(view.interfaces).enumerate() {
            let name = self.setup.interfaces[i].name.clone();
            let moved =
                |nodes: &[usize]| nodes.iter().map(|&n| shown_bodies.displacement[n]).collect::<Vec<_>>();
            let mesh = &self.setup.interfaces[i];
            let side = SlaveSide { fields: shown.clone(), displacement: moved(&mesh.nodes) };
            part.fields.write(&self.out, number, time, &side)?;
            let file = part.fields.file(number);
            entries.push(PvdEntry { time, part: 2 * i + 1, name: name.clone(), file });
            part.master.write(&self.out, number, time, &moved(&mesh.master_nodes))?;
            let (name, file) = (format!("{name}, master"), part.master.file(number));
            entries.push(PvdEntry { time, part: 2 * i + 2, name, file });
        }
        self.collection.extend(entries);
        atomic::write(&self.out.join(COLLECTION.path), &pvd(&self.collection))
    }

    fn write_profiles(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.profile_number += 1;
        self.written[0] = Some(view.record.time);
        for ((part, mesh), fields) in self.interfaces.iter().zip(&self.setup.interfaces).zip(view.interfaces)
        {
            let path =
                self.out.join(tables::PROFILES.named(&format!("{}_{:03}", part.stem, self.profile_number)));
            atomic::write(&path, tables::profile(view.record.time, mesh, fields).as_bytes())?;
        }
        Ok(())
    }

    fn write_probes(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        for ((part, mesh), fields) in
            self.interfaces.iter_mut().zip(&self.setup.interfaces).zip(view.interfaces)
        {
            let Some(file) = &mut part.probes else { continue };
            file.push(tables::probe_row(
                view.record.time,
                view.record.stage,
                view.record.step,
                mesh,
                fields,
            ))?;
        }
        Ok(())
    }

    fn write_samples(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        let row = |values: &[f64]| history_row(view.record.time, view.record.stage, view.record.step, values);
        for (file, point) in self.points.iter_mut().zip(&view.samples.points) {
            file.push(row(&tables::point_values(point)))?;
        }
        for (file, force) in self.forces.iter_mut().zip(&view.samples.forces) {
            file.push(row(force))?;
        }
        if let (Some(file), Some(energy)) = (&mut self.energy, &view.energy) {
            let StepRecord { time, stage, step, .. } = *view.record;
            let friction: Vec<f64> = view.interfaces.iter().map(|fields| fields.dissipated).collect();
            file.push(energy::row(time, stage, step, energy, &friction))?;
        }
        if let Some(file) = &mut self.rates {
            let largest = |fields: &InterfaceFields| {
                let sizes = fields.slip_rate.iter().map(|v| v.abs()).filter(|v| v.is_finite());
                sizes.fold(0.0, f64::max)
            };
            let own = self.setup.eventful.iter().filter_map(|&i| view.interfaces.get(i));
            file.push(row(&own.map(largest).collect::<Vec<_>>()))?;
        }
        for (file, spring) in self.springs.iter_mut().zip(&view.samples.springs) {
            if let Some(spring) = spring {
                let SpringValues { load_point, displacement, force, friction } = *spring;
                file.push(row(&[load_point, displacement, force, friction]))?;
            }
        }
        Ok(())
    }

    /// Tables that grow during the run, by their paths, with their columns: those of probes, then of points, of forces, of springs,
    /// of the energy budget and of the largest slip rates.
    fn growing(&self) -> Vec<FileParts<Column>> {
        let setup = &self.setup;
        let probed =
            self.interfaces.iter().zip(&setup.interfaces).filter(|(_, mesh)| !mesh.probes.is_empty());
        let mut all: Vec<FileParts<Column>> = probed
            .map(|(part, mesh)| FileParts::new(tables::PROBES.named(&part.stem), tables::probe_columns(mesh)))
            .collect();
        let (points, forces, springs) = (setup.points.clone(), setup.forces.clone(), setup.springs.clone());
        all.extend(SampleSites { points, forces, springs, unit: setup.force_unit }.tables());
        if let Some(unit) = setup.energy_unit {
            let names = setup.interfaces.iter().map(|mesh| mesh.name.as_str());
            let columns = energy::columns(unit).into_iter().chain(energy::friction_columns(unit, names));
            all.push(FileParts::new(energy::FILE.path, columns.collect()));
        }
        if !setup.eventful.is_empty() {
            let eventful = setup.eventful.iter().filter_map(|&i| setup.interfaces.get(i));
            let columns = tables::rate_columns(eventful.map(|mesh| mesh.name.as_str()));
            all.push(FileParts::new(tables::RATES.path, columns));
        }
        all
    }

    /// Fields of this run, by the paths of their files.
    #[must_use]
    pub fn fields(&self) -> Vec<FileParts<Field>> {
        // There are none of interfaces without those of bodies.
        let Some(bodies) = &self.bodies else { return Vec::new() };
        let interfaces = self.interfaces.iter().flat_map(|part| [part.fields.fields(), part.master.fields()]);
        std::iter::once(bodies.fields()).chain(interfaces).collect()
    }

    /// All tables with their columns, of this run.
    #[must_use]
    pub fn described(&self) -> Vec<FileParts<Column>> {
        let profiles = self.interfaces.iter().zip(&self.setup.interfaces);
        let profiles = profiles.filter(|_| self.profile_number > 0).map(|(part, mesh)| {
            let path = tables::PROFILES.named(&format!("{}_*", part.stem));
            FileParts::new(path, tables::profile_columns(mesh))
        });
        self.growing().into_iter().chain(profiles).collect()
    }

    /// Creates the tables, or reopens them at these sizes in bytes.
    fn begin_tables(&mut self, bytes: Option<Vec<u64>>) -> Result<(), OutputError> {
        let all = self.growing();
        if let Some(bytes) = bytes.as_ref().filter(|bytes| bytes.len() != all.len()) {
            let what = "tables of the checkpoint".into();
            return Err(OutputError::Shape { what, expected: all.len(), found: bytes.len() });
        }
        let mut tables = Vec::with_capacity(all.len());
        for (k, table) in all.into_iter().enumerate() {
            let path = self.out.join(table.path);
            path.parent().map_or(Ok(()), atomic::create_dir)?;
            tables.push(match bytes.as_ref().and_then(|bytes| bytes.get(k)) {
                Some(bytes) => GrowingTable::reopen(path, *bytes)?,
                None => GrowingTable::create(path, column::header(&table.parts))?,
            });
        }
        let mut tables = tables.into_iter();
        for (part, mesh) in self.interfaces.iter_mut().zip(&self.setup.interfaces) {
            part.probes = if mesh.probes.is_empty() { None } else { tables.next() };
        }
        self.points = tables.by_ref().take(self.setup.points.len()).collect();
        self.forces = tables.by_ref().take(self.setup.forces.len()).collect();
        self.springs = tables.by_ref().take(self.setup.springs.len()).collect();
        self.energy = self.setup.energy_unit.and_then(|_| tables.next());
        self.rates = tables.next();
        Ok(())
    }

    /// Removes the files of an earlier run of these interfaces, so that they are not taken for output of this run.
    fn remove_earlier(&self) -> Result<(), OutputError> {
        self.remove_beyond([0; 2])?;
        let mut once: Vec<PathBuf> =
            self.interfaces.iter().map(|part| self.out.join(tables::PROBES.named(&part.stem))).collect();
        once.push(self.out.join(COLLECTION.path));
        once.iter().filter(|path| path.exists()).try_for_each(|path| remove(path))
    }

    /// Removes fields and profiles with numbers larger than these.
    fn remove_beyond(&self, [fields, profiles]: [usize; 2]) -> Result<(), OutputError> {
        let stems: Vec<&str> = self.interfaces.iter().map(|part| part.stem.as_str()).collect();
        remove_numbered(&self.out.join("profiles"), &stems, ("csv", profiles))?;
        let with_bodies: Vec<&str> = stems.iter().copied().chain(["bodies"]).collect();
        remove_numbered(&self.out.join("fields"), &with_bodies, ("vtu", fields))
    }

    /// Restores the positions in the files, and removes output written after them. Returns the sizes of the tables.
    fn reopen(&mut self, from: FilesState) -> Result<Vec<u64>, OutputError> {
        let FilesState { passed: [fields, profiles], numbers, written, collection, bytes } = from;
        self.fields_due = std::mem::take(&mut self.fields_due).from(fields);
        self.profiles_due = std::mem::take(&mut self.profiles_due).from(profiles);
        [self.field_number, self.profile_number] = numbers;
        (self.written, self.collection) = (written, collection);
        for PvdEntry { file, .. } in &self.collection {
            let path = self.out.join(file);
            fs::metadata(&path).map_err(|source| OutputError::Read { path, source })?;
        }
        self.remove_beyond(numbers)?;
        let path = self.out.join(COLLECTION.path);
        if !self.collection.is_empty() {
            atomic::write(&path, &pvd(&self.collection))?;
        } else if path.exists() {
            remove(&path)?;
        }
        Ok(bytes)
    }
}

impl Writer for Files {
    fn begin(&mut self, setup: &Setup) -> Result<(), OutputError> {
        check_probes(setup)?;
        self.setup = setup.clone();
        let ends: Vec<f64> = setup.stages.iter().map(|(_, end)| *end).collect();
        self.fields_due = OutputIntervals::new(self.schedule.fields, &ends);
        self.profiles_due = OutputIntervals::new(self.schedule.profiles, &ends);
        self.bodies = None;
        self.collection.clear();
        (self.field_number, self.profile_number) = (0, 0);
        self.written = [None; 2];
        let masters: Vec<String> =
            setup.interfaces.iter().map(|mesh| format!("master_{}", mesh.name)).collect();
        let names = setup.interfaces.iter().map(|mesh| mesh.name.as_str());
        let mut slaves = stems(names.chain(masters.iter().map(String::as_str)));
        let masters = slaves.split_off(setup.interfaces.len());
        let dimension = setup.mesh.dimension;
        let place = (dimension, setup.mesh.nodes.as_slice());
        self.interfaces = slaves
            .into_iter()
            .zip(masters)
            .zip(&setup.interfaces)
            .map(|((stem, master), mesh)| {
                let fields = fields::interface_series(&stem, mesh, dimension);
                let master = fields::master_series(&master, mesh, place);
                Part { stem, fields, master, probes: None }
            })
            .collect();
        let bytes = match self.resumed.take() {
            Some(from) => Some(self.reopen(from)?),
            None => self.remove_earlier().map(|()| None)?,
        };
        let wanted = [
            ("fields", self.schedule.fields > 0 && !setup.mesh.cells.is_empty()),
            ("profiles", self.schedule.profiles > 0 && !setup.interfaces.is_empty()),
        ];
        for (folder, _) in wanted.iter().filter(|(_, wanted)| *wanted) {
            atomic::create_dir(&self.out.join(folder))?;
        }
        self.begin_tables(bytes)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        check_interfaces(&self.setup, view.interfaces)?;
        check_samples(&self.setup, view.samples)?;
        self.write_probes(view)?;
        self.write_samples(view)?;
        let (stage, time) = (view.record.stage, view.record.time);
        if self.profiles_due.take(stage, time, view.ends_stage) {
            self.write_profiles(view)?;
        }
        if self.fields_due.take(stage, time, view.ends_stage) {
            self.write_fields(view)?;
        }
        Ok(())
    }

    /// Writes the last good state unless it has been written.
    fn end(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        let now = Some(view.record.time);
        if self.schedule.profiles > 0 && self.written[0] != now {
            self.write_profiles(view)?;
        }
        if self.schedule.fields > 0 && self.written[1] != now {
            self.write_fields(view)?;
        }
        Ok(())
    }
}

/// Removes only files `<stem>_<digits>.<extension>` of the given stems with a number larger than this.
fn remove_numbered(dir: &Path, stems: &[&str], (extension, most): (&str, usize)) -> Result<(), OutputError> {
    let Ok(entries) = fs::read_dir(dir) else { return Ok(()) };
    for entry in entries {
        let path = entry.map_err(|source| OutputError::write(dir, source))?.path();
        let ours = path.extension().is_some_and(|found| found == extension)
            && path
                .file_stem()
                .and_then(|stem| stem.to_str())
                .and_then(|stem| stem.rsplit_once('_'))
                .is_some_and(|(stem, digits)| {
                    stems.contains(&stem)
                        && digits.bytes().all(|byte| byte.is_ascii_digit())
                        && digits.parse::<usize>().map_or(true, |number| number > most)
                });
        if ours {
            remove(&path)?;
        }
    }
    Ok(())
}

fn remove(path: &Path) -> Result<(), OutputError> {
    fs::remove_file(path).map_err(|source| OutputError::write(path, source))
}
