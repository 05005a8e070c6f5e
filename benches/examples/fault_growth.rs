//! Growth of cost with the number of points of a fault in a half-space, from 1e3 to 1e5: set-up, memory, products and ten steps, with
//! the powers that fit them and what a million points would take. `fault_growth [LARGEST [THREADS [SMALLEST]]]` prints Markdown.
//! Times are CPU times of all threads, so that other load on the machine changes them little.
// A program for the terminal.
#![allow(clippy::print_stdout, clippy::print_stderr)]

use asperity_benches::growth::{FILE, bent, power, squares, triangles};
use asperity_cycles::{Components, Settings};
use asperity_plan::faults::{Plan, plan};
use asperity_plan::reading::scene;
use std::fs;
use std::ops::RangeInclusive;
use std::path::Path;
use std::process::ExitCode;
use std::time::Instant;

/// Squares along strike: cells of 2, 1.25, 0.625, 0.4 and 0.2 km.
const SQUARES: [usize; 5] = [50, 80, 160, 250, 500];
/// Rectangles along strike and down dip, each of two triangles.
const TRIANGLES: [[usize; 2]; 5] = [[35, 14], [60, 24], [110, 44], [195, 78], [350, 140]];
/// Number of points that is extrapolated to.
const MILLION: f64 = 1e6;
/// CPU time over which work is repeated \[s\]: a hundred times the resolution of the clock.
const REPEATED: f64 = 1.0;
/// Ticks of the CPU clock of Linux in a second.
const TICKS: f64 = 100.0;
/// Steps of a run.
const STEPS: usize = 10;

/// Costs of one number of points.
struct Row {
    points: f64,
    /// Set-up \[s\].
    set_up: f64,
    bytes: f64,
    /// Product \[s\].
    product: f64,
    /// Ten steps \[s\].
    steps: f64,
}

fn main() -> ExitCode {
    let arguments: Vec<f64> = std::env::args().skip(1).filter_map(|a| a.parse().ok()).collect();
    let largest = arguments.first().copied().unwrap_or(1e5);
    let threads = arguments.get(1).map_or(1, |t| *t as usize);
    let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(threads).build() else {
        eprintln!("no pool of {threads} threads");
        return ExitCode::FAILURE;
    };
    let smallest = arguments.get(2).copied().unwrap_or(0.0);
    match pool.install(|| tables(smallest..=largest)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(reason) => {
            eprintln!("{reason}");
            ExitCode::FAILURE
        }
    }
}

fn tables(asked: RangeInclusive<f64>) -> Result<(), String> {
    let nowhere = Path::new("");
    println!("squares of one grid (convolution along strike)\n");
    table(SQUARES.iter().filter(|&&c| asked.contains(&((c * c * 2 / 5) as f64))), |&columns| {
        planned(&squares(columns)?, nowhere)
    })?;
    println!("triangles of a bent surface (compressed)\n");
    let folder = std::env::temp_dir().join(format!("fault_growth.{}", std::process::id()));
    fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
    let done = table(TRIANGLES.iter().filter(|[c, r]| asked.contains(&((2 * c * r) as f64))), |&cells| {
        fs::write(folder.join(FILE), bent(cells)).map_err(|e| e.to_string())?;
        planned(&triangles()?, &folder)
    });
    fs::remove_dir_all(&folder).map_err(|e| e.to_string())?;
    done
}

fn planned(text: &str, folder: &Path) -> Result<Plan, String> {
    let scene = scene::read_in(text, folder).map_err(|e| e.to_string())?;
    plan(&scene).map_err(|e| e.to_string())
}

/// Prints the rows of a medium, the powers that fit them, and the costs of a million points.
fn table<T: Copy>(
    sizes: impl Iterator<Item = T>,
    plan: impl Fn(T) -> Result<Plan, String>,
) -> Result<(), String> {
    println!(
        "| points | set-up \\[s\\] | a point \\[us\\] | operator \\[MB\\] | a point \\[kB\\] | product \\[ms\\] | a point \\[ns\\] | ten steps \\[s\\] |"
    );
    println!("|---|---|---|---|---|---|---|---|");
    let mut rows = Vec::new();
    for size in sizes {
        let row = measured(|| plan(size))?;
        print(&format!("{}", row.points), &row);
        rows.push(row);
    }
    if rows.len() < 2 {
        return Ok(());
    }
    let fit = |of: fn(&Row) -> f64| power(&rows.iter().map(|r| [r.points, of(r)]).collect::<Vec<_>>());
    let fits = [fit(|r| r.set_up), fit(|r| r.bytes), fit(|r| r.product), fit(|r| r.steps)];
    let [a, b, c, d] = fits.map(|[power, _]| power);
    println!("| power | {a:.2} | | {b:.2} | | {c:.2} | | {d:.2} |");
    let [set_up, bytes, product, steps] = fits.map(|[power, factor]| factor * MILLION.powf(power));
    print("1e6, by the powers", &Row { points: MILLION, set_up, bytes, product, steps });
    println!();
    Ok(())
}

fn print(name: &str, row: &Row) {
    let Row { points, set_up, bytes, product, steps } = row;
    println!(
        "| {name} | {set_up:.3} | {:.0} | {:.1} | {:.2} | {:.3} | {:.0} | {steps:.3} |",
        1e6 * set_up / points,
        bytes / 1e6,
        bytes / 1e3 / points,
        1e3 * product,
        1e9 * product / points,
    );
}

fn measured(plan: impl Fn() -> Result<Plan, String>) -> Result<Row, String> {
    let mut planned = None;
    let set_up = mean(|| {
        planned = Some(plan()?);
        Ok(())
    })?;
    let plan = planned.ok_or("nothing was planned")?;
    let problem = &plan.problem;
    let operator = problem.fault.operator.as_ref();
    let count = operator.points() * operator.components();
    let slip: Vec<f64> = (0..count).map(|k| (k as f64).sin()).collect();
    let n = operator.points();
    let (slip, mut shear, mut normal) = (Components::new(slip.as_slice(), n), vec![0.0; count], vec![0.0; n]);
    let product = mean(|| {
        operator.shear(slip, Components::new(&mut shear, n));
        if operator.couples_normal() {
            operator.normal(slip, &mut normal);
        }
        Ok(())
    })?;
    let settings = Settings { most_steps: STEPS, ..problem.settings };
    let steps = mean(|| problem.run(&settings, &mut ()).map(|_| ()).map_err(|e| e.to_string()))?;
    let (points, bytes) = (operator.points() as f64, operator.bytes() as f64);
    Ok(Row { points, set_up, bytes, product, steps })
}

/// Mean CPU time of work that is repeated until the clock resolves it \[s\].
fn mean(mut work: impl FnMut() -> Result<(), String>) -> Result<f64, String> {
    let (begun, mut repeats) = (cpu(), 0.0);
    while repeats == 0.0 || cpu() - begun < REPEATED {
        work()?;
        repeats += 1.0;
    }
    Ok((cpu() - begun) / repeats)
}

/// CPU time of all threads of this process so far \[s\]; wall time where the system does not say.
fn cpu() -> f64 {
    static BEGUN: std::sync::OnceLock<Instant> = std::sync::OnceLock::new();
    let wall = || BEGUN.get_or_init(Instant::now).elapsed().as_secs_f64();
    let Ok(text) = fs::read_to_string("/proc/self/stat") else { return wall() };
    // Fields follow the name of the program, which ends with the last parenthesis; user and system time are the 14th and 15th.
    let fields = text.rsplit(')').next().unwrap_or_default().split_whitespace().skip(11).take(2);
    let ticks: Vec<f64> = fields.filter_map(|f| f.parse().ok()).collect();
    if ticks.len() == 2 { ticks.iter().sum::<f64>() / TICKS } else { wall() }
}
