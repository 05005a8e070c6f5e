//! Values of a scene that are set beside its file, such as by `--set faults.main.normal=25MPa`: written into its text before it
//! is read, with the way back from the new text to the file.

mod origin;
mod place;
mod setting;

pub use origin::{Origin, ResolvedText};
pub use place::EditProblem;
pub use setting::{Setting, SettingError};

use origin::Splice;

/// Setting that cannot be written into a scene.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("--set {setting}: {reason}")]
pub struct EditError {
    /// The setting, as it was given.
    pub setting: String,
    /// Reason.
    pub reason: EditProblem,
}

/// Writes settings into the text of a scene, in their order.
///
/// # Errors
/// The first setting that cannot be written, with the reason.
pub fn apply(text: &str, settings: &[Setting]) -> Result<ResolvedText, EditError> {
    let mut resolved = ResolvedText::unchanged(text);
    for (number, setting) in settings.iter().enumerate() {
        let edit = place::edit(resolved.text(), setting)
            .map_err(|reason| EditError { setting: setting.to_string(), reason })?;
        resolved.splice(
            Splice { number, at: edit.at.start, removed: edit.at.len(), added: edit.text.len() },
            &edit.text,
        );
    }
    Ok(resolved)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "# a scene\nschema = 1\ntitle = \"t\" # here\nkinematics = \"plane-strain\"\n[bodies.A]\nmaterial = \"m\"\nmesh.block = { size = \"1 m\" }\n[faults.main]\nlaw = { kind = \"rate\" }\nnormal = \"50 MPa\" # much\n[output.probes]\nfault = 3\n[[stages]]\nduration = 1\n";

    fn set(changes: &[&str]) -> Result<ResolvedText, EditError> {
        let settings: Vec<Setting> = changes.iter().map(|change| Setting::read(change).unwrap()).collect();
        apply(SCENE, &settings)
    }

    /// The lines that a scene has after a change and not before it.
    fn lines(change: &str) -> Vec<String> {
        let text = set(&[change]).unwrap().text().to_string();
        text.lines()
            .filter(|line| !line.is_empty() && !SCENE.lines().any(|old| old == *line))
            .map(str::to_string)
            .collect()
    }

    fn why(change: &str) -> String {
        set(&[change]).unwrap_err().to_string()
    }

    #[test]
    fn a_value_is_replaced_where_it_stands() {
        assert_eq!(lines("faults.main.normal=25MPa"), ["normal = \"25MPa\" # much"]);
        assert_eq!(lines("faults.main.law.kind=tied"), ["law = { kind = \"tied\" }"]);
        assert_eq!(lines("stages[0].duration = 2 yr"), ["duration = \"2 yr\""]);
        assert_eq!(lines("bodies.A.mesh.block.size=[1, 2]"), ["mesh.block = { size = [1, 2] }"]);
        assert_eq!(lines("title='3'"), ["title = '3' # here"]);
    }

    #[test]
    fn a_key_that_is_absent_is_added_to_its_table() {
        assert_eq!(lines("faults.main.damping=radiation"), ["damping = \"radiation\""]);
        assert_eq!(lines("faults.main.law.mu0=0.6"), ["law = { kind = \"rate\", mu0 = 0.6 }"]);
        assert_eq!(lines("faults.main.creep.rate=1e-9"), ["creep.rate = 1e-9"]);
        assert_eq!(lines("output.probes.other=4"), ["other = 4"]);
        assert_eq!(lines("output.fields=4"), ["[output]", "fields = 4"]);
        assert_eq!(lines("time.stepper=implicit"), ["[time]", "stepper = \"implicit\""]);
        assert_eq!(lines("time.handover.above=1 mm/s"), ["[time.handover]", "above = \"1 mm/s\""]);
        let mesh = "mesh.block = { size = \"1 m\", element = \"quad4\" }";
        assert_eq!(lines("bodies.A.mesh.block.element=quad4"), [mesh]);
    }

    #[test]
    fn what_does_not_exist_is_refused_with_what_is_near() {
        for (change, part) in [
            ("faults.main.nromal=1", "did you mean `normal`?"),
            ("faults.mian.normal=1", "did you mean `main`?"),
            ("stages[3].duration=1", "has 1 entry"),
            ("stages.duration=1", "such as `stages[0]`"),
            ("faults.main=1", "set its keys"),
            ("title.x=1", "has no keys"),
        ] {
            assert!(why(change).contains(part), "{change}: {}", why(change));
        }
        assert!(Setting::read("faults.main.normal").is_err() && Setting::read("a b=1").is_err());
        assert!(Setting::read("a=").is_err() && Setting::read("faults.main.law={ kind").is_err());
    }

    #[test]
    fn positions_lead_back_to_the_file_and_to_settings() {
        let resolved =
            set(&["faults.main.damping=radiation", "title=a longer title", "faults.main.normal=1 Pa"])
                .unwrap();
        let text = resolved.text();
        for (part, origin) in [
            ("radiation", Origin::Setting(0)),
            ("a longer", Origin::Setting(1)),
            ("1 Pa", Origin::Setting(2)),
            ("# much", Origin::File(SCENE.find("# much").unwrap())),
            ("duration = 1", Origin::File(SCENE.find("duration").unwrap())),
            ("# a scene", Origin::File(0)),
        ] {
            assert_eq!(resolved.origin(text.find(part).unwrap()), origin, "{part}");
        }
    }
}
