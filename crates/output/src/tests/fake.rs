//! A synthetic run in the shape of a sandwich: smooth fields without mechanics.

use crate::OutputError;
use crate::bodies::view::*;
use crate::fields::vtu::Cell;

pub(crate) const H: f64 = 2.5e-3;
const STAGES: [(&str, f64); 2] = [("press", 9.66), ("shear", 59.66)];

/// A structured block of quad4 in the plane or, with `layers`, of hex8.
fn block(mesh: &mut MeshView, body: usize, min: [f64; 2], max: [f64; 2], layers: usize) {
    let n: Vec<usize> = (0..2).map(|c| ((max[c] - min[c]) / H).round() as usize).collect();
    let (nx, ny) = (n[0] + 1, n[1] + 1);
    let base = mesh.nodes.len();
    for k in 0..=layers {
        for j in 0..ny {
            for i in 0..nx {
                mesh.nodes.push([min[0] + i as f64 * H, min[1] + j as f64 * H, k as f64 * H]);
            }
        }
    }
    let at = |i: usize, j: usize, k: usize| base + (k * ny + j) * nx + i;
    for j in 0..n[1] {
        for i in 0..n[0] {
            let ring = |k| [at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k)];
            if layers == 0 {
                mesh.cells.push(Cell::new(9, ring(0).to_vec()));
                mesh.cell_body.push(body);
            }
            for k in 0..layers {
                mesh.cells.push(Cell::new(12, [ring(k), ring(k + 1)].concat()));
                mesh.cell_body.push(body);
            }
        }
    }
}

pub(crate) fn setup(layers: usize) -> Setup {
    let mut mesh = MeshView {
        bodies: vec!["A".into(), "B".into()],
        dimension: if layers == 0 { 2 } else { 3 },
        ..MeshView::default()
    };
    block(&mut mesh, 0, [0.0, 0.0], [0.025, 0.05], layers);
    block(&mut mesh, 1, [0.025, -0.01], [0.05, 0.06], layers);
    let rows = 21;
    let positions: Vec<[f64; 3]> =
        (0..=layers).flat_map(|k| (0..rows).map(move |j| [0.025, j as f64 * H, k as f64 * H])).collect();
    let faces = if layers == 0 {
        (0..rows - 1).map(|j| vec![j, j + 1]).collect()
    } else {
        let quad = |j: usize, k: usize| {
            vec![k * rows + j, k * rows + j + 1, (k + 1) * rows + j + 1, (k + 1) * rows + j]
        };
        (0..layers).flat_map(|k| (0..rows - 1).map(move |j| quad(j, k))).collect()
    };
    let fault = InterfaceMesh {
        in_space: false,
        nodes: (0..positions.len()).collect(),
        master_nodes: vec![0, 1],
        master_faces: vec![vec![0, 1]],
        name: "fault".into(),
        labels: Vec::new(),
        areas: vec![H; positions.len()],
        positions,
        faces,
        probes: (0..8).map(|i| (i as f64 * 20.0 / 7.0).round() as usize).collect(),
        states: 1,
        theta: Vec::new(),
    };
    let stages = STAGES.iter().map(|(name, end)| ((*name).to_string(), *end)).collect();
    Setup {
        title: "sandwich/v1".into(),
        mesh,
        interfaces: vec![fault],
        stages,
        force_unit: "N/m",
        ..Setup::default()
    }
}

pub(crate) fn fields_at(setup: &Setup, time: f64, spoil: Option<f64>) -> InterfaceFields {
    let mesh = &setup.interfaces[0];
    let v_load = 1e-6;
    let since = (time - 9.66).max(0.0);
    let per = |f: &dyn Fn(f64) -> f64| -> Vec<f64> {
        mesh.positions.iter().map(|p| spoil.unwrap_or_else(|| f(p[1] / 0.05))).collect()
    };
    let press = (time / 9.66).min(1.0);
    let sigma = |s: f64| press * 9.3e6 * (0.92 + 1.5 * (2.0 * s - 1.0).powi(8));
    let lag = |s: f64| 8.0 + 7.0 * (s - 0.3);
    let v = |s: f64| v_load * (1.0 - (-(since / lag(s)).powi(3)).exp());
    let slip = |s: f64| v_load * (since - lag(s) * (1.0 - (-since / lag(s)).exp()) * 0.9).max(0.0);
    let mu = |s: f64| 0.6 * (1.0 - (-(since / lag(s) * 1.5).powi(2)).exp());
    let mut gap = per(&|s| -sigma(s) / 3.6e15);
    if let Some(last) = gap.last_mut() {
        *last = f64::INFINITY;
    }
    InterfaceFields {
        slip_vector: Vec::new(),
        shear_vector: Vec::new(),
        gap,
        normal_traction: per(&sigma),
        shear_traction: per(&|s| sigma(s) * mu(s)),
        mean_normal_traction: per(&sigma),
        mean_shear_traction: per(&|s| sigma(s) * mu(s)),
        relative_displacement: per(&|s| slip(s) + 1e-9 * mu(s)),
        slip: per(&slip),
        slip_rate: per(&v),
        friction: per(&mu),
        status: vec![if since > 0.0 { 2 } else { 1 }; mesh.positions.len()],
        area: mesh.areas.clone(),
        friction_work: per(&|s| sigma(s) * mu(s) * slip(s)),
        dissipated: since.max(0.0),
        states: vec![per(&mu); mesh.states],
    }
}

/// Values at points and forces on sets that grow with time.
pub(crate) fn samples_at(setup: &Setup, time: f64) -> Samples {
    let point = |k: usize| PointValues {
        displacement: [1e-3 * time, -1e-4 * k as f64, 0.0],
        stress: [time * 1e6, 0.0, 0.0, -0.5e6, 0.0, 0.0],
        mises: 2.5e6,
    };
    Samples {
        points: (0..setup.points.len()).map(point).collect(),
        forces: (0..setup.forces.len()).map(|k| [1e3 * time, k as f64, 0.0]).collect(),
        springs: (0..setup.springs.len()).map(|_| None).collect(),
    }
}

pub(crate) fn body_fields(mesh: &MeshView, time: f64, spoil: Option<f64>) -> BodyFields {
    let mises = |p: &[f64; 3]| {
        let near = |y: f64| ((p[0] - 0.025).hypot(p[1] - y) + 1e-4).powf(-0.4);
        let value = 5e6 + 5e5 * (near(0.0) + near(0.05)) * (time / 9.66).min(1.0) - 4e7 * (p[0] - 0.03).abs();
        spoil.unwrap_or(value)
    };
    let centre = |nodes: &Vec<usize>| -> [f64; 3] {
        std::array::from_fn(|c| nodes.iter().map(|&n| mesh.nodes[n][c]).sum::<f64>() / nodes.len() as f64)
    };
    let cell_mises: Vec<f64> = mesh.cells.iter().map(|cell| mises(&centre(&cell.points))).collect();
    BodyFields {
        displacement: mesh.nodes.iter().map(|p| [1e-3 * p[0], -1e-4 * p[1], 0.0]).collect(),
        cell_stress: cell_mises.iter().map(|&m| [-m, 0.0, 0.0, 0.0, 0.0, 0.0]).collect(),
        cell_mises,
        cell_plastic_strain: Vec::new(),
        node_mises: mesh.nodes.iter().map(mises).collect(),
    }
}

/// Plays the run to an observer with `per_stage` steps per stage; `spoil` replaces every value.
pub(crate) fn play(
    setup: &Setup,
    per_stage: usize,
    spoil: Option<f64>,
    observer: &mut dyn Writer,
) -> Result<(), OutputError> {
    observer.begin(setup)?;
    let (mut start, mut step) = (0.0, 0);
    for (stage, (name, end)) in setup.stages.iter().enumerate() {
        for k in 1..=per_stage {
            step += 1;
            let dt = (end - start) / per_stage as f64;
            let time = if k == per_stage { *end } else { start + dt * k as f64 };
            let record = StepRecord { stage, step, time, dt, iterations: 3, ..StepRecord::default() };
            let interfaces = [fields_at(setup, time, spoil)];
            observer.step(&StepView {
                record: &record,
                stage: name,
                ends_stage: k == per_stage,
                end_time: 59.66,
                interfaces: &interfaces,
                samples: &samples_at(setup, time),
                energy: None,
                fields: &|| body_fields(&setup.mesh, time, spoil),
            })?;
        }
        start = *end;
    }
    Ok(())
}
