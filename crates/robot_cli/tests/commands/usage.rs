//! Wrong usage, and the demonstration.

use crate::{URDF, complaint, output, robot, run};

#[test]
fn wrong_usage_has_its_own_code() {
    for arguments in [&["equation"][..], &["stats"], &["stats", "a", "b"], &["--snap"]] {
        assert!(complaint(2, arguments, "").contains("error:"), "{arguments:?}");
    }
    assert!(complaint(1, &["stats", "none.toml"], "").contains("there is no such file"));
}

/// If a command accepted a larger angle, it would print the equations of another robot.
#[test]
fn a_tolerance_that_is_no_small_angle_is_refused() {
    let file = robot("ur5");
    for command in ["equations", "document", "base", "show", "search", "stats", "generate", "watch"]
    {
        for snap in ["1", "-1e-3", "nan", "inf", "0.1000001", "right"] {
            let found = complaint(2, &[command, &file, "--snap", snap], "");
            assert!(found.contains("between 0 and 0.1"), "{command} {snap}: {found}");
        }
    }
    output(&["equations", &file, "--snap", "0.1", "--form", "compact"], "");
}

#[test]
fn a_document_is_no_pdf() {
    let found = complaint(2, &["document", &robot("planar_2r"), "-o", "arm.pdf"], "");
    assert!(found.contains("NAME.tex"), "{found}");
}

#[test]
fn code_is_not_written_to_a_file_of_another_language() {
    let file = robot("planar_2r");
    for (language, name) in [("rust", "arm.py"), ("python", "arm.rs"), ("c", "arm.m")] {
        let words = ["generate", &file, "--language", language, "-o", name];
        let found = complaint(2, &words, "");
        assert!(found.contains(&format!("a file in `{language}` does not end in")), "{found}");
    }
}

#[test]
fn without_a_command_the_demonstration_runs() {
    let shown = output(&[], "");
    assert_eq!(shown, output(&["demo"], ""));
    for part in ["Q1 = ", "Q5 = ", "sin(q2)", "tau = ", "generated code"] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
}

#[test]
fn the_version_is_that_of_the_package() {
    assert_eq!(
        run(&["--version"]).output,
        format!("robot-symbolic {}\n", env!("CARGO_PKG_VERSION"))
    );
}

/// The same angle, as a sum with pi and as a decimal.
#[test]
fn an_angle_is_snapped_however_it_is_written() {
    let folder = crate::folder("snapped");
    let file = |name: &str, angle: &str| {
        let path = folder.join(name);
        let text = format!(
            "format = 1\n[robot]\nname = \"arm\"\n[[link]]\nname = \"a\"\n\
             joint = {{ type = \"revolute\", axis = \"z\" }}\norigin = {{ rpy = [0, {angle}, 0] }}\n\
             mass = 1\ncenter_of_mass = [0.1, 0.2, 0]\ninertia = {{ xx = 0.1, yy = 0.1, zz = 0.1 }}\n"
        );
        std::fs::write(&path, text).unwrap();
        path.to_str().unwrap().to_owned()
    };
    let sum = file("sum.toml", "\"pi/2 - 1e-5\"");
    let decimal = file("decimal.toml", "1.5707863267948966");
    for snap in ["1e-4", "0"] {
        let of = |file: &str| {
            let eval = ["eval", file, "--snap", snap, "--function", "gravity", "--q", "0.3"];
            (output(&eval, ""), output(&["equations", file, "--snap", snap], ""))
        };
        let [(a, equations), (b, others)] = [&*sum, &*decimal].map(of);
        assert_eq!(a, b, "{snap}");
        assert_eq!(equations.contains("1e-5"), snap == "0", "{equations}");
        assert_eq!(equations == others, snap != "0", "{equations}{others}");
    }
}

#[test]
fn an_imported_urdf_gives_the_same_torques() {
    let folder = crate::folder("import");
    let (urdf, toml) = (folder.join("pendulum.urdf"), folder.join("pendulum.toml"));
    std::fs::write(&urdf, URDF).unwrap();
    let (urdf, toml) = (urdf.to_str().unwrap(), toml.to_str().unwrap());
    assert_eq!(run(&["import", urdf, "-o", toml]).code, 0);
    let states = r#"[{"q": [0.3], "qd": [0.1], "qdd": [-0.2]}]"#;
    let eval =
        |file| output(&["eval", file, "--function", "inverse_dynamics", "--states", "-"], states);
    assert_eq!(eval(urdf), eval(toml));
    // Moments of inertia without mass are an error, unless an option allows them.
    let massless = URDF.replace("<mass value=\"2\"/>", "<mass value=\"0\"/>");
    std::fs::write(urdf, massless).unwrap();
    assert!(complaint(1, &["import", urdf], "").contains("--allow-massless"));
    assert_eq!(run(&["import", "--allow-massless", urdf]).code, 0);
}
