//! Selection of the rows of a slider that are kept.

use asperity_friction::slider::Condition;
use serde::{Deserialize, Deserializer, Serialize};

/// Longest time between rows that are kept, as a fraction of the run.
const SHARE: f64 = 1e-3;

/// Change of the friction coefficient that counts as much as a change of ln V by one; a tenth of it can span a whole
/// plot.
const FRICTION: f64 = 0.05;

/// State of a slider at an instant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Row {
    /// Time \[s\].
    pub time: f64,
    /// Length of the step, or time since the previous row if both lie in one step; 0 at the start and after a jump \[s\].
    pub dt: f64,
    /// Condition of the slider.
    #[serde(with = "StoredCondition")]
    pub condition: Condition,
    /// Slip since time 0 \[m\].
    pub slip: f64,
    /// Displacement of the load point \[m\].
    pub load: f64,
    /// State variables.
    pub states: Vec<f64>,
}

/// A [`Condition`] as stored in checkpoints.
#[derive(Serialize, Deserialize)]
#[serde(remote = "Condition")]
struct StoredCondition {
    rate: f64,
    #[serde(deserialize_with = "or_none")]
    log_rate: f64,
    friction: f64,
    normal: f64,
    traction: f64,
}

/// ln |V|. JSON cannot represent it for a slider at rest; a value that is not finite differs from every other, see [`differs`].
fn or_none<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}

/// Values of the last kept row, for comparison.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Last {
    time: f64,
    #[serde(deserialize_with = "or_none")]
    log_rate: f64,
    friction: f64,
}

/// Filter for the rows of a slider.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Thin {
    last: Option<Last>,
    /// The most recent row, if it was not kept.
    pending: Option<Row>,
    /// Course of |V| up to the most recent row.
    course: Course,
}

/// Course of \|V\|.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Course {
    /// \|V\| of the most recent row \[m/s\].
    rate: f64,
    /// True if it grew to it.
    grew: bool,
    /// Largest \|V\| of a kept row since it was last too low for an event \[m/s\].
    highest: f64,
}

impl Course {
    /// Notes a new \|V\|, of which an event begins at `fast`; true if the one before was the largest of the event so far, and a
    /// maximum.
    fn peaked(&mut self, rate: f64, fast: f64) -> bool {
        let peaked = self.grew && rate < self.rate && self.rate >= fast && self.rate > self.highest;
        if peaked {
            self.highest = self.rate;
        }
        if rate < fast {
            self.highest = 0.0;
        }
        self.grew = rate > self.rate || self.grew && rate == self.rate;
        self.rate = rate;
        peaked
    }
}

impl Thin {
    /// Rows to keep after a new one: the new row, and the previous one if it shows the start of a jump or the peak of an event. `change` is
    /// the change of ln V from row to row, `end` the end of the run \[s\], and `fast` the slip rate at which events begin \[m/s\].
    pub fn next(
        &mut self,
        row: Row,
        asked: bool,
        change: Option<f64>,
        end: f64,
        fast: Option<f64>,
    ) -> [Option<Row>; 2] {
        let Some(change) = change else { return [None, asked.then_some(row)] };
        let peaked = fast.is_some_and(|fast| self.course.peaked(row.condition.rate.abs(), fast));
        let by = |share: f64| self.last.is_some_and(|last| differs(&row, last, share * change));
        let late = self.last.is_none_or(|last| row.time - last.time >= SHARE * end);
        // A jump is drawn from its start.
        let jumped = row.dt == 0.0 || by(2.0);
        let keep = asked || late || jumped || by(1.0);
        let before = if jumped || peaked { self.pending.take() } else { None };
        if let Some(row) = before.as_ref().filter(|_| peaked) {
            self.keep(row);
        }
        if keep {
            self.keep(&row);
            [before, Some(row)]
        } else {
            self.pending = Some(row);
            [before, None]
        }
    }

    /// The most recent row, if it was not kept before; it is kept now.
    pub fn mark(&mut self) -> Option<Row> {
        let row = self.pending.take()?;
        self.keep(&row);
        Some(row)
    }

    fn keep(&mut self, row: &Row) {
        self.pending = None;
        let Condition { log_rate, friction, rate, .. } = row.condition;
        self.course.highest = self.course.highest.max(rate.abs());
        self.last = Some(Last { time: row.time, log_rate, friction });
    }
}

/// True if ln V or friction differ enough. A slider at rest has no ln V, and counts as different.
fn differs(row: &Row, Last { log_rate, friction, .. }: Last, by: f64) -> bool {
    let moved = (row.condition.log_rate - log_rate).abs();
    moved >= by || moved.is_nan() || (row.condition.friction - friction).abs() >= FRICTION * by
}
