//! Packages in other languages than Rust.

use std::path::{Path, PathBuf};

use super::Builder;
use super::output::check_names;
use crate::driver::budget;
use crate::driver::file::File;
use crate::driver::generate::module_name;
use crate::driver::languages::package_of;
use crate::entry::cargo::Directives;
use crate::entry::files::Writer;
use crate::entry::pin::robot_inputs;
use crate::error::Errors;

/// The package of a robot file.
struct Package {
    /// The name of the folder.
    name: String,
    /// The path of the robot file as given.
    path: String,
    files: Vec<File>,
}

impl Builder {
    /// Writes a folder for each robot, named as its module would be in Rust. Returns the paths of all files.
    pub(super) fn packages(
        &self,
        paths: &[&Path],
        package: &Path,
        folder: &Path,
        directives: &mut Directives,
    ) -> Result<Vec<PathBuf>, Errors> {
        let (mut packages, mut errors) = (vec![], vec![]);
        for path in paths {
            match self.one_package(path, package, directives) {
                Ok(found) => packages.push(found),
                Err(found) => Errors::extend(&mut errors, found),
            }
        }
        let names = packages.iter().map(|one| (one.name.as_str(), one.path.as_str()));
        check_names(names, None, &mut errors);
        Errors::check(errors, ())?;
        let inputs = paths.iter().flat_map(|path| robot_inputs(&package.join(path)));
        let inputs: Vec<PathBuf> = inputs.collect();
        for Package { name, files, .. } in &packages {
            Writer::new().inputs(inputs.iter().cloned()).write_folder(&folder.join(name), files)?;
        }
        let paths = packages.iter().flat_map(|one| {
            let folder = folder.join(&one.name);
            one.files.iter().map(move |file| file.path_in(&folder))
        });
        Ok(paths.collect())
    }

    fn one_package(
        &self,
        path: &Path,
        package: &Path,
        directives: &mut Directives,
    ) -> Result<Package, Errors> {
        let (file, options) = self.read(path, package, directives)?;
        let programs = budget::programs(&file.source, &options)?;
        directives.warnings(&programs.warnings);
        Ok(Package {
            name: module_name(&programs.module),
            path: path.display().to_string(),
            files: package_of(&programs, &file.source, &options, self.language)?,
        })
    }
}
