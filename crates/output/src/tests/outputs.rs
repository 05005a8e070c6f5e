//! Files written by the observers.

use super::fake::{body_fields, fields_at, play, samples_at, setup};
use crate::bodies::schedule::OutputIntervals;
use crate::bodies::view::{BodyFields, InterfaceMesh, Samples, Setup, StepRecord, StepView};
use crate::bodies::{FieldSchedule, Files, Multi, Recorder, Writer};
use crate::error::expect_length;
use crate::{OutputError, atomic, figures, labels, stems};
use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};

fn schedule() -> FieldSchedule {
    FieldSchedule { fields: 2, profiles: 10 }
}

/// Directory for the output of a test. It is kept under `ASPERITY_KEEP`, if set, for inspection by other readers.
fn directory(name: &str) -> (tempfile::TempDir, PathBuf) {
    let dir = tempfile::tempdir().unwrap();
    let out = std::env::var_os("ASPERITY_KEEP").map_or(dir.path().to_path_buf(), PathBuf::from).join(name);
    (dir, out)
}

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn rows(path: &Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_path(path).unwrap();
    let head = reader.headers().unwrap().iter().map(String::from).collect();
    let rows = reader.records().map(|row| row.unwrap().iter().map(|text| text.parse().unwrap()).collect());
    (head, rows.collect())
}

#[test]
fn a_run_leaves_fields_tables_and_plots_and_no_temporary_file() {
    for (name, layers) in [("plane", 0), ("layers", 4)] {
        let (_keep, out) = directory(name);
        let mut recorder = Recorder::new().with_bodies();
        let mut files = Files::create(&out, schedule()).unwrap();
        play(&setup(layers), 200, None, &mut Multi::new(vec![&mut recorder, &mut files])).unwrap();
        assert_eq!(figures::draw_all(&out.join("plots"), &recorder).unwrap().len(), 14);
        assert_eq!(names(&out), ["fields", "fields.pvd", "plots", "probes", "profiles"]);
        // Bodies, and slave and master of the interface, at two times of each stage.
        assert_eq!(names(&out.join("fields")).len(), 3 * 2 * 2);
        assert_eq!(names(&out.join("profiles")).len(), 20);
        assert_eq!(
            names(&out.join("plots"))
                .iter()
                .step_by(2)
                .map(|name| name.trim_end_matches(".png"))
                .collect::<Vec<_>>(),
            [
                "fault_friction",
                "fault_relative_displacement",
                "fault_relative_velocity",
                "fault_state",
                "fault_tractions",
                "mises_1_press",
                "mises_2_shear"
            ]
        );
        let every =
            ["", "fields", "plots", "probes", "profiles"].map(|folder| names(&out.join(folder))).concat();
        assert!(every.iter().all(|name| !name.starts_with('.')));
    }
}

#[test]
fn values_that_are_not_finite_or_all_the_same_do_not_stop_the_outputs() {
    for spoil in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.6, 1e-320, 1e300] {
        for steps in [1, 3] {
            let dir = tempfile::tempdir().unwrap();
            let mut recorder = Recorder::new().with_bodies();
            let mut files = Files::create(dir.path(), schedule()).unwrap();
            play(&setup(0), steps, Some(spoil), &mut Multi::new(vec![&mut recorder, &mut files])).unwrap();
            assert_eq!(figures::draw_all(dir.path(), &recorder).unwrap().len(), 14, "{spoil}");
        }
    }
}

#[test]
fn a_run_without_interfaces_probes_or_steps_draws_what_there_is() {
    let dir = tempfile::tempdir().unwrap();
    let mut bare = setup(0);
    bare.interfaces[0].probes.clear();
    let mut recorder = Recorder::new();
    play(&bare, 2, None, &mut recorder).unwrap();
    assert_eq!(figures::draw_all(dir.path(), &recorder).unwrap().len(), 2);
    let mut recorder = Recorder::new().with_bodies();
    recorder.begin(&Setup::default()).unwrap();
    assert!(figures::draw_all(dir.path(), &recorder).unwrap().is_empty());
}

#[test]
fn probes_hold_one_row_a_step_and_name_place_and_unit() {
    let (_keep, out) = directory("probes");
    let mut recorder = Recorder::new();
    let mut files = Files::create(&out, schedule()).unwrap();
    play(&setup(0), 25, None, &mut Multi::new(vec![&mut files, &mut recorder])).unwrap();
    let (head, rows) = rows(&out.join("probes/fault.csv"));
    assert_eq!(head.len(), 3 + 7 * 8);
    assert_eq!(head[3 + 7 + 1], "slip [m] at y = 7.5 mm");
    assert_eq!(head[3 + 7 + 6], "state_1 at y = 7.5 mm");
    assert_eq!(rows.len(), 50);
    let points = &recorder.histories()[0].points;
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row[0], recorder.times()[i]);
        assert_eq!(row[3 + 7 * 7 + 2], points[7].slip_rate[i]);
    }
}

#[test]
fn a_profile_reads_back_as_the_fields_it_was_written_from() {
    let (_keep, out) = directory("profile");
    let mut recorder = Recorder::new().at_all_nodes();
    let mut files = Files::create(&out, schedule()).unwrap();
    play(&setup(0), 20, None, &mut Multi::new(vec![&mut files, &mut recorder])).unwrap();
    let (head, rows) = rows(&out.join("profiles/fault_010.csv"));
    let press = recorder.stage_end("press").unwrap();
    let column = |name: &str| head.iter().position(|found| found == name).unwrap();
    assert_eq!(rows.len(), 21);
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row[0], 9.66);
        assert_eq!(row[column("y [m]")], recorder.setup().interfaces[0].positions[i][1]);
        assert_eq!(row[column("normal_traction [Pa]")], press.interfaces[0].normal_traction[i]);
        assert_eq!(row[column("state_1")], press.interfaces[0].states[0][i]);
        let (gap, paired) = (row[column("gap [m]")], row[column("paired [0 no 1 yes]")]);
        // The last node has no partner.
        if i < 20 {
            assert_eq!((gap, paired), (press.interfaces[0].gap[i], 1.0));
        } else {
            assert!(gap.is_nan() && paired == 0.0);
        }
    }
    assert_eq!(recorder.history("fault").unwrap().points.len(), 21);
}

#[test]
fn a_stopped_run_keeps_what_it_had() {
    let (_keep, out) = directory("stopped");
    let mut files = Files::create(&out, schedule()).unwrap();
    let full = setup(0);
    let mut stopping = FailingWriter { files: &mut files, left: 30 };
    assert!(play(&full, 25, None, &mut stopping).is_err());
    assert_eq!(rows(&out.join("probes/fault.csv")).1.len(), 30);
    // One stage of two intervals and a fifth of the next.
    assert_eq!(names(&out.join("fields")).len(), 3 * 2);
    assert_eq!(names(&out.join("profiles")).len(), 12);
    assert_eq!(fs::read_to_string(out.join("fields.pvd")).unwrap().matches("<DataSet").count(), 6);
}

/// Fails after a number of steps.
struct FailingWriter<'a> {
    files: &'a mut Files,
    left: usize,
}

impl Writer for FailingWriter<'_> {
    fn begin(&mut self, setup: &Setup) -> Result<(), OutputError> {
        self.files.begin(setup)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        if self.left == 0 {
            return expect_length("steps", 0, 1);
        }
        self.left -= 1;
        self.files.step(view)
    }
}

#[test]
fn files_of_an_earlier_run_are_replaced_and_those_of_others_stay() {
    let (_keep, out) = directory("again");
    for (steps, count) in [(20, 20), (2, 4)] {
        let mut files = Files::create(&out, schedule()).unwrap();
        fs::create_dir_all(out.join("profiles")).unwrap();
        for other in ["fault_mine.csv", "other_001.csv", "fault_001.txt"] {
            fs::write(out.join("profiles").join(other), "mine").unwrap();
        }
        play(&setup(0), steps, None, &mut files).unwrap();
        assert_eq!(names(&out.join("profiles")).len(), count + 3);
    }
}

#[test]
fn a_directory_that_cannot_be_written_is_named_before_anything_is_computed() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("taken");
    fs::write(&file, "a file").unwrap();
    let error = Files::create(&file.join("out"), schedule()).unwrap_err();
    assert!(matches!(&error, OutputError::Directory { path, .. } if path.ends_with("taken/out")));
    assert!(error.to_string().contains("taken/out"), "{error}");
}

#[test]
fn a_failed_write_leaves_the_old_file_and_nothing_beside_it() {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("report.json");
    atomic::write(&path, b"old").unwrap();
    atomic::write(&path, b"new").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"new");
    let blocked = dir.path().join("blocked");
    fs::create_dir_all(blocked.join("inside")).unwrap();
    assert!(matches!(atomic::write(&blocked, b"x"), Err(OutputError::Write { .. })));
    assert_eq!(names(dir.path()), ["blocked", "report.json"]);
}

#[test]
fn fields_that_do_not_fit_the_set_up_are_refused() {
    let full = setup(0);
    let mut short = setup(0);
    short.interfaces[0].positions.pop();
    short.interfaces[0].areas.pop();
    short.interfaces[0].probes.pop();
    let mut recorder = Recorder::new();
    let mut swapped = SwappedSetup { inner: &mut recorder, announced: &short };
    let error = play(&full, 1, None, &mut swapped).unwrap_err();
    assert_eq!(error.to_string(), "gap of interface fault: 21 values where the set-up announced 20");
}

/// Announces a set-up that differs from the one played.
struct SwappedSetup<'a> {
    inner: &'a mut Recorder,
    announced: &'a Setup,
}

impl Writer for SwappedSetup<'_> {
    fn begin(&mut self, _: &Setup) -> Result<(), OutputError> {
        self.inner.begin(self.announced)
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        self.inner.step(view)
    }
}

#[test]
fn a_probe_outside_the_interface_is_refused() {
    let mut wrong = setup(0);
    wrong.interfaces[0].probes.push(99);
    assert!(matches!(Recorder::new().begin(&wrong), Err(OutputError::Shape { found: 99, .. })));
    let dir = tempfile::tempdir().unwrap();
    assert!(Files::create(dir.path(), schedule()).unwrap().begin(&wrong).is_err());
}

#[test]
fn several_observers_share_one_recovery_of_the_bodies() {
    let full = setup(0);
    let recovered = Cell::new(0);
    let fields = || -> BodyFields {
        recovered.set(recovered.get() + 1);
        body_fields(&full.mesh, 1.0, None)
    };
    let (mut a, mut b) = (PromptWriter, PromptWriter);
    let record = StepRecord::default();
    let view = StepView {
        record: &record,
        stage: "press",
        ends_stage: true,
        end_time: 1.0,
        interfaces: &[],
        samples: &Samples::default(),
        energy: None,
        fields: &fields,
    };
    Multi::new(vec![&mut a, &mut b]).step(&view).unwrap();
    assert_eq!(recovered.get(), 1);
}

struct PromptWriter;

impl Writer for PromptWriter {
    fn begin(&mut self, _: &Setup) -> Result<(), OutputError> {
        Ok(())
    }

    fn step(&mut self, view: &StepView<'_>) -> Result<(), OutputError> {
        assert!(!(view.fields)().displacement.is_empty());
        Ok(())
    }
}

#[test]
fn times_of_outputs_are_those_at_which_they_appear() {
    let ends = [1.0, 5.0];
    let schedule = FieldSchedule { fields: 2, profiles: 4 };
    assert_eq!(schedule.times(&ends), [0.25, 0.5, 0.75, 1.0, 2.0, 3.0, 4.0, 5.0]);
    let mut due = OutputIntervals::new(4, &ends);
    let ends = [(0.1, false), (0.25, false), (0.3, false), (0.8, false), (0.99, false), (1.0, true)];
    let taken = ends.map(|(time, ends_stage)| due.take(0, time, ends_stage));
    assert_eq!(taken, [false, true, false, true, false, true]);
    // Ten steps of 0.1 reach the first due time despite rounding. A stage that ends early has ended.
    let mut time = 1.0;
    let late: Vec<bool> = (0..10)
        .map(|_| {
            time += 0.1;
            due.take(1, time, false)
        })
        .collect();
    assert_eq!(late.iter().position(|taken| *taken), Some(9));
    assert!(due.take(1, 2.5, true));
}

#[test]
fn names_of_interfaces_become_safe_and_different_file_names() {
    let names = ["fault", "../up", "bodies", "", "fault/", "fault_"];
    let stems = stems(names.into_iter());
    assert_eq!(stems, ["fault", "___up", "bodies-2", "-3", "fault_", "fault_-5"]);
}

#[test]
fn labels_name_the_coordinates_that_differ() {
    let plane = [[0.025, 0.0, 0.0], [0.025, 0.0125, 0.0]];
    assert_eq!(labels::position_labels(plane.into_iter()), ["y = 0 mm", "y = 12.5 mm"]);
    let layers = [[0.025, 0.0, 0.001], [0.025, 0.05, 0.002]];
    assert_eq!(labels::position_labels(layers.into_iter()), ["y = 0; z = 1 mm", "y = 50; z = 2 mm"]);
    let sevenths = [[0.0, 0.05 / 7.0, 0.0], [0.0, 0.05, 0.0]];
    assert_eq!(labels::position_labels(sevenths.into_iter()), ["y = 7.14 mm", "y = 50 mm"]);
    let close = [[0.0, 0.05, 0.0], [0.0, 0.050001, 0.0]];
    assert_eq!(labels::position_labels(close.into_iter()), ["y = 50 mm", "y = 50.001 mm"]);
    assert_eq!(labels::position_labels([[0.0; 3]].into_iter()), ["x = 0; y = 0 m"]);
}

#[test]
fn an_interface_without_faces_is_written_as_points() {
    let (_keep, out) = directory("points");
    let mut points = setup(0);
    points.interfaces[0] = InterfaceMesh { faces: Vec::new(), ..points.interfaces[0].clone() };
    let mut files = Files::create(&out, schedule()).unwrap();
    play(&points, 2, None, &mut files).unwrap();
    assert!(fs::read_to_string(out.join("fields/fault_00001.vtu")).unwrap().contains("NumberOfCells=\"21\""));
}

#[test]
fn the_last_state_of_a_stage_in_which_a_run_stops_is_kept_and_drawn() {
    let setup = setup(0);
    let mut recorder = Recorder::new().with_bodies();
    recorder.begin(&setup).unwrap();
    let record =
        StepRecord { stage: 1, step: 1, time: 20.0, dt: 1.0, iterations: 3, ..StepRecord::default() };
    let samples = samples_at(&setup, 20.0);
    let interfaces = [fields_at(&setup, 20.0, None)];
    let view = StepView {
        record: &record,
        stage: "shear",
        ends_stage: false,
        end_time: 59.66,
        interfaces: &interfaces,
        samples: &samples,
        energy: None,
        fields: &|| body_fields(&setup.mesh, 20.0, None),
    };
    recorder.step(&view).unwrap();
    assert!(recorder.stage_ends().is_empty());
    recorder.end(&view).unwrap();
    recorder.end(&view).unwrap();
    assert_eq!(recorder.stage_ends().iter().map(|end| end.time).collect::<Vec<_>>(), [20.0]);
    let text = serde_json::to_string(&crate::figures::sheet(&recorder)).unwrap();
    assert!(text.contains("\"stopped\":true"), "{text}");
}
