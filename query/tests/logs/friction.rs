//! Tests friction that is added to robot files.

use std::fs;

use robot_query::Robots;
use tempfile::TempDir;

use super::support::{files, generation, identified, log, robot};

#[test]
fn friction_that_the_file_lacks_is_identified_and_written() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("truth.toml").to_string_lossy().into_owned();
    let text = fs::read_to_string(robot("ur5")).unwrap();
    let friction = "friction = { viscous = 0.8, coulomb_torque = 1.5 }\n";
    let end = text.find("[[frame]]").unwrap();
    fs::write(&path, format!("{}{friction}\n{}", &text[..end], &text[end..])).unwrap();
    let logged = log(&path, &generation(&path, 20_000));
    let mut robots = Robots::new();
    robots.with_friction();
    let model = robots.model(&robot("ur5")).unwrap();
    let start = folder.path().join("start.toml").to_string_lossy().into_owned();
    fs::write(&start, &model.source.text).unwrap();
    let estimate = identified(2, &files(logged.path()), &start, "").unwrap();
    let place = |name: &str| estimate.names.iter().position(|other| other == name).unwrap();
    // In the true robot, only the last joint has friction.
    for (name, wanted) in
        [("FV_6", 0.8), ("FP_6", 1.5), ("FN_6", 1.5), ("FV_1", 0.0), ("FP_3", 0.0)]
    {
        let place = place(name);
        assert_eq!(estimate.nominal[place], 0.0, "{name}");
        let error = (estimate.values[place] - wanted).abs();
        assert!(error < 4.5 * estimate.deviations[place].unwrap(), "{name}: {error}");
    }
    let consistent = estimate.consistent(&model).unwrap();
    let (text, _) = estimate.robot_file(&model, &consistent, "identified.toml").unwrap();
    // The parameters that were 0 are removed, since nothing uses them any more.
    assert!(!text.contains("viscous_friction") && !text.contains("[parameters]"), "{text}");
    let written = Robots::new().model(&text).unwrap();
    let viscous = &written.robot.links[5].friction.viscous;
    let nominal = |symbol: &str| written.robot.nominal_value(symbol);
    assert!((viscous.evaluate(nominal) - 0.8).abs() < 0.1, "{text}");
}

#[test]
fn friction_of_a_file_stays_as_it_is() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("arm.urdf");
    let urdf = r#"<robot name="arm"><link name="base"/><link name="a"><inertial><mass value="2"/>
        <origin xyz="0.3 0 0"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
        <joint name="j" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/>
        <dynamics damping="0.7" friction="0"/></joint></robot>"#;
    fs::write(&path, urdf).unwrap();
    let path = path.to_string_lossy().into_owned();
    assert!(!Robots::new().model(&path).unwrap().robot.has_friction());
    let mut robots = Robots::new();
    robots.with_friction();
    let text = robots.model(&path).unwrap().source.text.clone();
    assert!(text.contains("viscous = 0.7") && text.contains("dry_friction_1 = 0"), "{text}");
    // Friction that a file has is not added again.
    let again = robots.model(&text).unwrap().source.text.clone();
    assert_eq!(again, text);
}
