//! Robot files with identified values.

use std::fs;

use robot_query::Robots;
use robot_query::identify::Estimate;

use super::support::{difference, files, generation, identified, log, robot};

/// A robot file whose values differ from those that the log was made with.
fn changed(name: &str, from: &str, to: &str, folder: &std::path::Path) -> String {
    let text = fs::read_to_string(robot(name)).unwrap();
    assert!(text.contains(from));
    let path = folder.join(format!("{name}.toml"));
    fs::write(&path, text.replace(from, to)).unwrap();
    path.to_string_lossy().into_owned()
}

#[test]
fn the_written_file_predicts_another_log() {
    let truth = robot("panda");
    let folder = log(&truth, &generation(&truth, 10_000));
    // The forearm has twice the mass, and the hand has none.
    let path = changed("panda", "mass = 3.587895", "mass = 7.2", folder.path());
    let estimate = identified(2, &files(folder.path()), &path, "").unwrap();
    let model = Robots::new().model(&path).unwrap();
    let consistent = estimate.consistent(&model).unwrap();
    let (text, _) = estimate.robot_file(&model, &consistent, "identified.toml").unwrap();
    assert!(text.contains("+-"), "{text}");
    let written = folder.path().join("identified.toml").to_string_lossy().into_owned();
    fs::write(&written, text).unwrap();
    let mut how = generation(&truth, 2000);
    how.seed = 99;
    how.noise = vec![0.0; 7];
    let other = log(&truth, &how);
    let rms = |robot: &str| -> f64 {
        let query = format!("SELECT residual('{robot}', q, qd, qdd, tau) AS r FROM log");
        let table = super::support::rows(1, &files(other.path()), &query).unwrap();
        let lists = datafusion::arrow::array::AsArray::as_fixed_size_list(table.column(0));
        let values = datafusion::arrow::array::AsArray::as_primitive::<
            datafusion::arrow::datatypes::Float64Type,
        >(lists.values());
        let squares: f64 = values.values().iter().map(|value| value * value).sum();
        (squares / values.values().len() as f64).sqrt()
    };
    let (before, after) = (rms(&path), rms(&written));
    // The noise of 0.5 N m in 70000 torques leaves an error of some hundredths of a N m.
    assert!(before > 2.0 && after < 0.05, "{before} {after}");
}

#[test]
fn an_estimate_that_no_bodies_have_is_mended() {
    let path = robot("ur5");
    // There are so few rows that the noise makes inertias of the wrist negative.
    let mut how = generation(&path, 300);
    how.noise = vec![3.0; 6];
    let folder = log(&path, &how);
    let estimate = identified(1, &files(folder.path()), &path, ", 1.0").unwrap();
    let model = Robots::new().model(&path).unwrap();
    let consistent = estimate.consistent(&model).unwrap();
    assert!(!consistent.is_estimate);
    assert!(consistent.growth > 1.0 && consistent.growth < 1.2, "{}", consistent.growth);
    let (text, _) = estimate.robot_file(&model, &consistent, "mended.toml").unwrap();
    // The reader refuses physically impossible inertias.
    Robots::new().model(&text).unwrap();
    // The result is the best physically possible one: the true parameters, which are possible, explain the log less
    // well.
    let growth_of_truth = grown(&estimate, &estimate.nominal);
    assert!(consistent.growth <= growth_of_truth, "{} {growth_of_truth}", consistent.growth);
    let found = grown(&estimate, &consistent.base);
    assert!((found - consistent.growth).abs() < 1e-9);
}

/// The factor by which residuals for other parameters exceed those of the estimate, from the estimate's triangle.
fn grown(estimate: &Estimate, base: &[f64]) -> f64 {
    let size = base.len() + 1;
    let mut rows = vec![];
    let mut packed = estimate.triangle.iter();
    for row in 0..size {
        rows.push(packed.by_ref().take(size - row).copied().collect::<Vec<f64>>());
    }
    let square = |values: &[f64]| -> f64 {
        let left = rows.iter().enumerate().map(|(row, entries)| {
            let explained: f64 = entries.iter().zip(&values[row..]).map(|(r, v)| r * v).sum();
            entries.last().unwrap() - explained
        });
        left.map(|one| one * one).sum()
    };
    (square(base) / square(&estimate.values)).sqrt()
}

#[test]
fn friction_and_armature_are_identified_and_written() {
    let folder = tempfile::TempDir::new().unwrap();
    let drive =
        "friction = { viscous = 0.8, coulomb_torque = 1.5 }\ndrive = { armature = 0.3 }\n[tip]";
    let truth = changed("ur5", "[tip]", "[tip]", folder.path());
    let text = fs::read_to_string(&truth).unwrap();
    let end = text.find("[[frame]]").unwrap();
    let with = |values: &str| format!("{}{values}\n{}", &text[..end], &text[end..]);
    let values = drive.strip_suffix("\n[tip]").unwrap();
    fs::write(&truth, with(values)).unwrap();
    let logged = log(&truth, &generation(&truth, 20_000));
    let start = folder.path().join("start.toml").to_string_lossy().into_owned();
    let guess = "friction = { viscous = 0.1, coulomb_torque = 0.1 }\ndrive = { armature = 0.1 }";
    fs::write(&start, with(guess)).unwrap();
    let estimate = identified(2, &files(logged.path()), &start, "").unwrap();
    let wanted = identified(1, &files(logged.path()), &truth, "").unwrap().nominal;
    assert!(estimate.names.iter().any(|name| name == "FV_6"), "{:?}", estimate.names);
    for (place, name) in estimate.names.iter().enumerate() {
        let error = (estimate.values[place] - wanted[place]).abs();
        let deviation = estimate.deviations[place].unwrap();
        assert!(error < 4.5 * deviation, "{name}: {error} {deviation}");
    }
    let model = Robots::new().model(&start).unwrap();
    let consistent = estimate.consistent(&model).unwrap();
    let (text, _) = estimate.robot_file(&model, &consistent, "identified.toml").unwrap();
    let written = Robots::new().model(&text).unwrap();
    assert!(written.robot.has_friction());
    let path = folder.path().join("identified.toml").to_string_lossy().into_owned();
    fs::write(&path, text).unwrap();
    let again = identified(1, &files(logged.path()), &path, "").unwrap();
    assert!(difference(&again.nominal, &consistent.base) < 1e-9);
}

/// The planar arm as URDF, with a tool that is fixed to its second link, and between them a link without inertial.
const URDF: &str = r#"<?xml version="1.0"?>
<!-- Kept as it is. -->
<robot name="arm">
  <link name="base"/>
  <link name="upper">
    <visual><geometry><box size="1 1 1"/></geometry></visual>
    <inertial>
      <origin xyz="0.3 0.02 0" rpy="0 0 0.4"/><mass value="3"/>
      <inertia ixx="0.02" ixy="0.001" ixz="0" iyy="0.09" iyz="0" izz="0.1"/>
    </inertial>
  </link>
  <link name="lower" />
  <link name="tool">
    <inertial>
      <origin xyz="0.1 0 0.2"/><mass value="1.5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/><axis xyz="0 1 0"/>
    <limit lower="-2" upper="2" effort="100" velocity="2"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="lower"/><origin xyz="0.6 0 0" rpy="0.3 0 0"/><axis xyz="0 0.6 0.8"/>
    <limit lower="-2" upper="2" effort="100" velocity="2"/>
  </joint>
  <joint name="flange" type="fixed">
    <parent link="lower"/><child link="tool"/><origin xyz="0.4 0 0" rpy="0 0 0.5"/>
  </joint>
</robot>
"#;

#[test]
fn a_urdf_file_gets_other_inertials_and_nothing_else() {
    let folder = tempfile::TempDir::new().unwrap();
    let truth = folder.path().join("truth.urdf").to_string_lossy().into_owned();
    fs::write(&truth, URDF).unwrap();
    let logged = log(&truth, &generation(&truth, 10_000));
    let start = folder.path().join("start.urdf").to_string_lossy().into_owned();
    fs::write(&start, URDF.replace("mass value=\"1.5\"", "mass value=\"2.5\"")).unwrap();
    let estimate = identified(2, &files(logged.path()), &start, "").unwrap();
    let model = Robots::new().model(&start).unwrap();
    let consistent = estimate.consistent(&model).unwrap();
    let (text, complaints) = estimate.robot_file(&model, &consistent, "identified.urdf").unwrap();
    assert!(!complaints.contains("error"), "{complaints}");
    assert!(text.contains("+-") && text.contains("<!-- Kept as it is. -->"), "{text}");
    assert!(text.contains("<visual><geometry><box size=\"1 1 1\"/></geometry></visual>"), "{text}");
    // The tool is merged into the link that carries it.
    assert_eq!((text.matches("<inertial>").count(), text.matches("<joint ").count()), (2, 3));
    let written = folder.path().join("identified.urdf").to_string_lossy().into_owned();
    fs::write(&written, &text).unwrap();
    let again = identified(1, &files(logged.path()), &written, "").unwrap();
    assert!(difference(&again.nominal, &consistent.base) < 1e-9);
    let wanted = identified(1, &files(logged.path()), &truth, "").unwrap().nominal;
    let (before, after) =
        (difference(&estimate.nominal, &wanted), difference(&again.nominal, &wanted));
    assert!(before > 0.2 && after < 0.02, "{before} {after}");
    // A URDF file can also be written as TOML, but a TOML file not as URDF.
    let (toml, _) = estimate.robot_file(&model, &consistent, "identified.toml").unwrap();
    assert!(toml.contains("[[link]]"));
    let other = Robots::new().model(&toml).unwrap();
    let error =
        estimate.robot_file(&other, &consistent, "identified.urdf").unwrap_err().to_string();
    assert!(error.contains("only from a URDF file"), "{error}");
}
