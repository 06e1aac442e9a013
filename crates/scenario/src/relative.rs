//! A scenario whose files are named from another folder, so that it can be given to others together with them.

use std::path::Path;

use congruent_input::relative_path;

use super::{Scenario, motions::MotionSettings};

impl Scenario {
    /// The files that the scenario names beside its robot and its meshes, as they are written.
    pub fn named_files_mut(&mut self) -> impl Iterator<Item = &mut String> {
        let played = self.motion.iter_mut().filter_map(|motion| match motion {
            MotionSettings::Playback(playback) => Some(&mut playback.play_csv),
            _ => None,
        });
        let log = self.source.iter_mut().map(|source| &mut source.log);
        self.controller.torque_file.iter_mut().chain(played).chain(log)
    }

    /// The scenario as it reads in `folder`, an absolute path: with relative paths in the place of absolute ones, as far as there are
    /// any between two drives.
    #[must_use]
    pub fn relative_to(&self, folder: &Path) -> Self {
        let mut scenario = self.clone();
        // Paths are relative to `folder` of the scenario, if it has one, and only that to the place of the file.
        let base = scenario.folder.clone();
        let relative = |file: &mut String, folder: &Path| {
            let path = Path::new(&*file);
            if let Some(path) = relative_path(folder, path).filter(|_| path.is_absolute()) {
                *file = path.display().to_string();
            }
        };
        if let Some(stated) = &mut scenario.folder {
            relative(stated, folder);
        }
        let base = base.as_ref().map_or(folder, Path::new);
        relative(&mut scenario.robot, base);
        for file in scenario.named_files_mut() {
            relative(file, base);
        }
        scenario
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_are_named_from_the_folder_of_the_results() {
        let absolute = Scenario { robot: "/a/robots/ur5e".to_owned(), ..Scenario::default() };
        let results = Path::new("/a/out/pick");
        assert_eq!(absolute.relative_to(results).robot, "../../robots/ur5e");
        let folder = Some("/a/scenarios".to_owned());
        let placed = Scenario { folder, ..absolute }.relative_to(results);
        assert_eq!((placed.folder.as_deref(), &*placed.robot), (Some("../../scenarios"), "../robots/ur5e"));
        assert_eq!(placed.relative_to(results), placed);
    }
}
