//! What is printed for people: angles, letters, numbers.

use crate::{complaint, folder, output, robot, run};

/// An arm whose angles are rounded as exported files round them.
const ROUNDED: &str = r#"<robot name="rounded">
  <link name="base"/>
  <link name="upper">
    <inertial>
      <origin xyz="0 0 0.2" rpy="0 0 0"/>
      <mass value="2"/>
      <inertia ixx="0.02" iyy="0.03" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="fore">
    <inertial>
      <origin xyz="0.1 0 0" rpy="0 0 0"/>
      <mass value="1"/>
      <inertia ixx="0.002" iyy="0.003" izz="0.004" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="shoulder" type="revolute">
    <parent link="base"/><child link="upper"/>
    <origin xyz="0 0 0.3" rpy="1.5708 0 3.1416"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper"/><child link="fore"/>
    <origin xyz="0 0 0.4" rpy="-4.9305e-37 0 -1.570796"/>
    <axis xyz="0 0 1"/>
    <limit lower="-1" upper="1" effort="10" velocity="2"/>
  </joint>
</robot>
"#;

fn rounded(test: &str) -> String {
    let path = folder(test).join("rounded.urdf");
    std::fs::write(&path, ROUNDED).unwrap();
    path.to_str().unwrap().to_owned()
}

#[test]
fn rounded_right_angles_are_right_in_print_and_said() {
    let file = rounded("rounded_angles");
    for command in
        [&["equations", &file][..], &["document", &file], &["document", &file, "--format", "typst"]]
    {
        let shown = run(command);
        assert_eq!(shown.code, 0, "{}", shown.errors);
        assert!(
            !shown.output.contains("1.57") && !shown.output.contains("3.14"),
            "{}",
            shown.output
        );
        let expected = "note: rounded: 3 constant angles within 1e-5 rad of a multiple of π/2 are printed as multiples \
                        (shoulder, elbow); --snap 0 prints them as they are\n";
        assert_eq!(shown.errors, expected);
    }
    let shown = run(&["report", &file, "--without-compiler", "-o", "-"]);
    assert!(shown.errors.contains("3 constant angles within 1e-5 rad"), "{}", shown.errors);
    assert!(shown.output.contains("In tables and equations, 3 constant angles within 1e-5 rad"));
    assert!(shown.output.contains("rotate x by π/2") && !shown.output.contains("0.00000000"));
}

#[test]
fn a_tolerance_that_is_given_is_taken_and_code_keeps_its_own() {
    let file = rounded("given_tolerance");
    for snap in ["0", "1e-9"] {
        let shown = output(&["equations", &file, "--snap", snap], "");
        assert!(shown.contains("sin(1.5708)"), "{shown}");
    }
    assert!(!output(&["equations", &file, "--snap", "1e-4"], "").contains("1.57"));
    let code = |snap: &str| output(&["generate", &file, "--snap", snap, "-o", "-"], "");
    assert_eq!(output(&["generate", &file, "-o", "-"], ""), code("1e-9"));
    assert_ne!(code("1e-5"), code("1e-9"));
}
