//! Robots as they are named in queries: by a registered name, a path, or the text of a robot file.

mod friction;
mod model;

use std::collections::{BTreeMap, HashMap};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use robot_build::{Options, RobotFile, Source};

use crate::error::Error;
pub use model::{Compiled, Model};

/// The robots of a process. Each is read and compiled once, for all queries and under all its names.
#[derive(Debug, Default)]
pub struct Robots {
    names: BTreeMap<String, PathBuf>,
    /// Whether joints without friction in their files get friction.
    friction: bool,
    models: Mutex<Models>,
}

/// The robots that have been read.
#[derive(Debug, Default)]
struct Models {
    by_literal: HashMap<String, Arc<Model>>,
    /// By the text of the robot file and its pinned plan.
    by_text: HashMap<(String, String), Arc<Model>>,
}

impl Robots {
    /// No registered names: robots are named by paths or texts.
    #[must_use]
    pub fn new() -> Robots {
        Robots::default()
    }

    /// Registers a robot file under a name.
    pub fn register(&mut self, name: &str, path: &Path) {
        self.names.insert(name.to_owned(), path.to_owned());
    }

    /// Gives all joints viscous and constant dry friction: that of the robot file, for URDF that of `<dynamics>`,
    /// otherwise with coefficients that are 0 until they are identified.
    pub fn with_friction(&mut self) {
        self.friction = true;
    }

    /// Registers the robot files of a folder, `.toml` and `.urdf`, under their names without the extension.
    ///
    /// # Errors
    ///
    /// A folder that cannot be read.
    pub fn register_folder(&mut self, folder: &Path) -> Result<(), Error> {
        let failed = |error: std::io::Error| Error::file(folder, error);
        for entry in std::fs::read_dir(folder).map_err(failed)? {
            let path = entry.map_err(failed)?.path();
            let name = path.file_stem().and_then(|stem| stem.to_str());
            let ending = path.extension().and_then(|ending| ending.to_str());
            if let (Some(name), Some("toml" | "urdf")) = (name, ending) {
                self.register(name, &path);
            }
        }
        Ok(())
    }

    /// The robot of a literal: a registered name, a path that ends with `.toml` or `.urdf`, or the text of a robot
    /// file. A file is read once per process.
    ///
    /// # Errors
    ///
    /// A name that is not registered; all errors of the file.
    pub fn model(&self, literal: &str) -> Result<Arc<Model>, Error> {
        let mut models = self.models.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(model) = models.by_literal.get(literal) {
            return Ok(model.clone());
        }
        let (source, options) = self.source(literal)?;
        let key = (source.text.clone(), format!("{:?}", options.plan));
        let model = match models.by_text.get(&key) {
            Some(model) => model.clone(),
            None => Arc::new(Model::new(source, options)?),
        };
        models.by_text.insert(key, model.clone());
        models.by_literal.insert(literal.to_owned(), model.clone());
        Ok(model)
    }

    /// The text of a robot and the options with its pinned plan. The plan belongs to the file without added
    /// friction.
    fn source(&self, literal: &str) -> Result<(Source, Options), Error> {
        let (source, options) = self.read(literal)?;
        if !self.friction {
            return Ok((source, options));
        }
        let failed = |reason: String| Error::Robot { robot: source.name.clone(), reason };
        let changed = friction::with_friction(source.clone()).map_err(failed)?;
        Ok((changed, Options { plan: None, ..options }))
    }

    /// The text of a robot file and the options with its pinned plan.
    fn read(&self, literal: &str) -> Result<(Source, Options), Error> {
        let options = Options { search: false, ..Options::default() };
        if literal.contains('\n') {
            return Ok((Source { name: "robot".to_owned(), text: literal.to_owned() }, options));
        }
        let failed = |reason: String| Error::Robot { robot: literal.to_owned(), reason };
        let path = match self.names.get(literal) {
            Some(path) => path.clone(),
            None if literal.ends_with(".toml") || literal.ends_with(".urdf") => literal.into(),
            None => return Err(failed(self.unknown())),
        };
        let file = RobotFile::read(&path).map_err(|errors| failed(errors.to_string()))?;
        let options = file.with_pin(&options).map_err(|errors| failed(errors.to_string()))?;
        Ok((file.source, options))
    }

    /// The error about a name that is not the name of a robot.
    fn unknown(&self) -> String {
        let names: Vec<&str> = self.names.keys().map(String::as_str).collect();
        let known = match names.as_slice() {
            [] => "no robot is registered; --robots FOLDER registers those of a folder".to_owned(),
            names => format!("registered are {}", names.join(", ")),
        };
        format!("this is neither a registered name nor a path to a .toml or .urdf file ({known})")
    }
}
