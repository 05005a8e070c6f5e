//! Behaviour of normal tractions on a fault.

/// Behaviour of normal tractions on a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalChoice {
    /// True if slip and loads change the normal tractions.
    pub changes: bool,
    /// Floor of the normal traction used by friction \[Pa\].
    pub floor: Option<f64>,
    /// True if the fault may open where nothing presses it.
    pub opens: bool,
}

impl NormalChoice {
    /// Description, if they may change.
    pub(super) fn words(self, fault: &str) -> String {
        let changes = if self.changes {
            "slip and loads change normal tractions"
        } else {
            "slip and loads leave normal tractions as they are, since `normal_changes = false`"
        };
        let below = match self.floor {
            Some(floor) if self.opens => format!(
                "; the fault opens where they would pull, and friction uses {:?} MPa where they are less",
                floor / 1e6
            ),
            Some(floor) => {
                format!(
                    "; friction uses {:?} MPa where they are lower, and they continue below it",
                    floor / 1e6
                )
            }
            None if self.changes => "; the run ends where one falls to zero".into(),
            None => String::new(),
        };
        format!("fault `{fault}`: {changes}{below}")
    }
}
