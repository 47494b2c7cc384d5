//! The module's files work unchanged within another crate.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;

use robot_runtime::SOURCES;

#[path = "../src/runtime/mod.rs"]
#[expect(unused, unreachable_pub, reason = "this test uses a part of the module")]
mod runtime;

#[test]
fn works_as_a_module() {
    use runtime::{F64x4, Scalar, sin_cos_array};
    let angles = [0.25, 0.5, -1.5, 3.0];
    let (sines, cosines) = sin_cos_array(&angles);
    assert_eq!(F64x4::from(angles).sin_cos(), (sines.into(), cosines.into()));
    assert_eq!((sines, cosines), robot_runtime::sin_cos_array(&angles));
}

#[test]
fn every_file_of_the_module_is_listed() -> Result<(), Box<dyn Error>> {
    fn files(
        folder: &Path,
        prefix: &str,
        found: &mut Vec<(String, String)>,
    ) -> std::io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if path.is_dir() {
                files(&path, &format!("{prefix}{name}/"), found)?;
            } else {
                found.push((format!("{prefix}{name}"), fs::read_to_string(path)?));
            }
        }
        Ok(())
    }
    let mut found = Vec::new();
    files(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src/runtime"), "", &mut found)?;
    found.sort();
    let mut listed: Vec<_> =
        SOURCES.iter().map(|(path, text)| (path.to_string(), text.to_string())).collect();
    listed.sort();
    assert_eq!(found, listed);
    Ok(())
}

/// A crate without dependencies that contains the files; warnings are errors.
#[test]
fn compiles_in_a_crate_of_its_own() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("embedded");
    for (path, text) in SOURCES {
        let path = folder.join("runtime").join(path);
        fs::create_dir_all(path.parent().unwrap_or(&folder))?;
        fs::write(path, text)?;
    }
    fs::write(
        folder.join("lib.rs"),
        "#![no_std]\n#![deny(unsafe_code)]\n#![deny(warnings, missing_docs)]\n//! A crate.\n\
         pub mod runtime;\n",
    )?;
    for feature in [None, Some("feature=\"std\"")] {
        let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
        let output = Command::new(rustc)
            .current_dir(&folder)
            .args(["lib.rs", "--crate-type=lib", "--edition=2024", "--emit=metadata"])
            .args(["--check-cfg", "cfg(feature, values(\"std\"))"])
            .args(feature.iter().flat_map(|feature| ["--cfg", feature]))
            .output()?;
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    Ok(())
}
