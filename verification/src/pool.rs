//! Execution of cases on threads, each with a limit: a case that hangs disagrees, and the others go to their ends.

use crate::case::{Case, Outcome};
use crate::report::history::Release;
use std::collections::BTreeMap;
use std::io;
use std::num::NonZeroUsize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// Stack of a thread that runs cases, as large as that of the main thread usually is \[bytes\].
const STACK: usize = 8 << 20;
/// Interval at which the limits are compared with the clock.
const LOOK: Duration = Duration::from_millis(200);
/// Work of a case over its recorded work at which it is given up.
const FACTOR: f64 = 10.0;
/// Recorded time that shorter cases count as \[s\]: the first cases of a run have no pace to go by, and on a machine that does
/// something else a case of 3 s took 60.
const SHORTEST: f64 = 20.0;

/// Limits of the work of cases: ten times the time they took at their last release, at the pace of this run.
#[derive(Clone, Debug, Default)]
pub struct Limits {
    /// Wall times at the last release \[s\], by the names of cases.
    pub recorded: BTreeMap<String, f64>,
    /// Recorded time that shorter cases count as \[s\].
    pub shortest: f64,
}

impl Limits {
    /// The limits that these releases imply, which are sorted from the oldest. Without a release there is no limit.
    pub fn from_releases(releases: &[Release]) -> Limits {
        let cases = releases.iter().flat_map(|release| &release.cases);
        Limits { recorded: cases.map(|(name, case)| (name.clone(), case.wall)).collect(), shortest: SHORTEST }
    }

    /// Limit of the wall time of a case \[s\]. A case without a record is held to the longest of all. `pace` is that of
    /// [`Limits::pace`].
    pub fn limit(&self, case: &str, pace: f64) -> Option<f64> {
        let longest = || self.recorded.values().copied().reduce(f64::max);
        let recorded = self.recorded.get(case).copied().or_else(longest)?;
        Some(FACTOR * pace * recorded.max(self.shortest))
    }

    /// Time of the cases that have ended over their recorded time, at least one: a slow machine, or cases that run side by
    /// side, move all limits alike.
    pub fn pace<'a>(&self, ended: impl IntoIterator<Item = &'a Outcome>) -> f64 {
        let known = ended.into_iter().filter_map(|o| Some((o.wall, *self.recorded.get(o.case.name)?)));
        let (wall, recorded) = known.fold((0.0, 0.0), |(wall, sum), (w, r)| (wall + w, sum + r));
        if recorded > 0.0 { (wall / recorded).max(1.0) } else { 1.0 }
    }
}

/// A message of a thread about the case with this number.
enum Message {
    Begun(usize),
    Ended(usize, Box<Outcome>),
}

/// State shared by the threads.
struct PoolState {
    cases: Vec<Case>,
    next: AtomicUsize,
    given_up: Vec<AtomicBool>,
}

/// Runs cases, `jobs` at a time, and returns their outcomes in the order of the list. `done` gets each outcome in this order too,
/// as soon as all before it have ended; `running` gets the names of the running cases at each look at the clock. A case beyond its
/// limit disagrees; its thread is left behind and ends with the program.
///
/// # Errors
/// If a thread cannot be started, or `running` fails.
pub fn execute(
    cases: &[&Case],
    jobs: NonZeroUsize,
    limits: &Limits,
    mut running: impl FnMut(&[&str]) -> io::Result<()>,
    mut done: impl FnMut(&Outcome),
) -> io::Result<Vec<Outcome>> {
    let shared = Arc::new(PoolState {
        cases: cases.iter().map(|case| **case).collect(),
        next: AtomicUsize::new(0),
        given_up: cases.iter().map(|_| AtomicBool::new(false)).collect(),
    });
    let (sender, receiver) = mpsc::channel();
    for _ in 0..jobs.get().min(cases.len()) {
        start(&shared, &sender)?;
    }
    let mut begun: BTreeMap<usize, Instant> = BTreeMap::new();
    let mut waiting: BTreeMap<usize, Outcome> = BTreeMap::new();
    let mut outcomes = Vec::with_capacity(cases.len());
    while outcomes.len() < cases.len() {
        take(&receiver, &shared, &mut begun, &mut waiting);
        running(&begun.keys().map(|&k| cases[k].name).collect::<Vec<_>>())?;
        let pace = limits.pace(outcomes.iter().chain(waiting.values()));
        for k in beyond(cases, limits, pace, &begun) {
            let spent = begun.remove(&k).map_or(0.0, |start| start.elapsed().as_secs_f64());
            shared.given_up[k].store(true, Ordering::SeqCst);
            waiting.insert(k, cases[k].lost(&overrun(spent), spent));
            start(&shared, &sender)?;
        }
        while let Some(outcome) = waiting.remove(&outcomes.len()) {
            done(&outcome);
            outcomes.push(outcome);
        }
    }
    Ok(outcomes)
}

/// Takes a message, if one comes in time.
fn take(
    receiver: &Receiver<Message>,
    shared: &PoolState,
    begun: &mut BTreeMap<usize, Instant>,
    waiting: &mut BTreeMap<usize, Outcome>,
) {
    match receiver.recv_timeout(LOOK) {
        Ok(Message::Begun(k)) => {
            begun.insert(k, Instant::now());
        }
        Ok(Message::Ended(k, outcome)) if !shared.given_up[k].load(Ordering::SeqCst) => {
            waiting.insert(k, *outcome);
            begun.remove(&k);
        }
        Ok(Message::Ended(..)) | Err(RecvTimeoutError::Timeout | RecvTimeoutError::Disconnected) => {}
    }
}

/// Running cases that are beyond their limits.
fn beyond(cases: &[&Case], limits: &Limits, pace: f64, begun: &BTreeMap<usize, Instant>) -> Vec<usize> {
    let late = |k: usize, start: &Instant| {
        limits.limit(cases[k].name, pace).is_some_and(|limit| start.elapsed().as_secs_f64() > limit)
    };
    begun.iter().filter(|&(&k, start)| late(k, start)).map(|(&k, _)| k).collect()
}

fn overrun(spent: f64) -> String {
    format!(
        "given up after {spent:.0} s, {FACTOR} times its recorded time at the pace of this run: it may hang"
    )
}

/// Starts a thread that runs cases until there are no more, or until its case was given up.
fn start(shared: &Arc<PoolState>, sender: &Sender<Message>) -> io::Result<()> {
    let (shared, sender) = (Arc::clone(shared), sender.clone());
    let work = move || {
        loop {
            let k = shared.next.fetch_add(1, Ordering::SeqCst);
            let Some(case) = shared.cases.get(k) else { return };
            if sender.send(Message::Begun(k)).is_err() {
                return;
            }
            let outcome = Box::new(case.execute());
            if sender.send(Message::Ended(k, outcome)).is_err() || shared.given_up[k].load(Ordering::SeqCst) {
                return;
            }
        }
    };
    thread::Builder::new().stack_size(STACK).spawn(work).map(drop)
}
