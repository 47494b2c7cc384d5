use super::*;

fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn expanded(input: TokenStream) -> String {
    let arguments: syn::Result<Arguments> = syn::parse2(input);
    let tokens = arguments.and_then(|arguments| expand(&arguments, &package()));
    tokens.unwrap_or_else(|error| error.to_compile_error()).to_string()
}

/// Creates an empty folder for a test.
fn folder_of(test: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("robot_macros-{}-{test}", std::process::id()));
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

#[test]
fn the_module_is_the_builders() {
    let out = std::env::temp_dir().join(format!("robot_macros-{}", std::process::id()));
    robot_build::Builder::new()
        .package_dir(package())
        .out_dir(&out)
        .emit_directives(false)
        .snap(1e-7)
        .generic(true)
        .batch(4)
        .fused(true)
        .functions(["inverse_dynamics_wrench"])
        .bundle("dynamics", ["mass_matrix", "bias"])
        .bundle("rest", ["gravity"])
        .compile(&["robots/trttr1.toml"])
        .unwrap();
    let built = std::fs::read_to_string(out.join("trttr1.rs")).unwrap();
    std::fs::remove_dir_all(out).unwrap();
    let built: TokenStream = built.parse().unwrap();
    let expanded = expanded(quote! {
        "robots/trttr1.toml", functions = ["inverse_dynamics_wrench"], snap = 1e-7,
        bundles = { dynamics = ["mass_matrix", "bias"], rest = ["gravity"] },
        generic = true, batch = 4, fused = true,
    });
    let rest = expanded.strip_prefix(&built.to_string()).unwrap();
    assert!(
        rest.trim_start().starts_with("const _ : & [u8] = :: core :: include_bytes !"),
        "{rest}"
    );
    assert!(rest.contains("trttr1.toml"), "{rest}");
}

#[test]
fn all_wrong_options_are_named() {
    let shown = expanded(quote! {
        "robots/trttr1.toml", max_operations = "x", snapp = 1, snap = "x", functions = ["inverse_dynamic"], scalar = "f16",
        allow_outside = 1, runtime = 3, trigonometry = "none", scalar = "f32", batch = 2.5
    });
    for part in [
        "there is no option `snapp` (did you mean `snap`?); the options are functions, bundles",
        "expected a number",
        "use one of \\\"inverse_dynamics\\\"",
        "is not allowed here (did you mean `inverse_dynamics`?); use one of",
        "use one of \\\"f64\\\", \\\"f32\\\"",
        "expected true or false",
        "expected a whole number",
        "expected a string literal",
        "use one of \\\"polynomial\\\", \\\"standard\\\"",
        "`scalar` is given twice",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    assert_eq!(shown.matches("compile_error").count(), 10);
    let typed = expanded(quote! { "robots/trttr1.toml", batch = 4u8, snap = 1e-7f32 });
    assert!(typed.contains("write the number without the suffix `u8`"), "{typed}");
    assert!(typed.contains("write the number without the suffix `f32`"), "{typed}");
    assert!(expanded(quote!(5)).contains("expected the path of a robot file"));
    assert!(expanded(quote!()).contains("expected the path of a robot file"));
}

#[test]
fn what_is_wrong_with_a_file_is_shown_and_the_file_watched() {
    let shown = expanded(quote!("Cargo.toml"));
    assert!(shown.contains("compile_error"), "{shown}");
    // Many tools show only the first line.
    let message = shown.split("compile_error ! { \"").nth(1).unwrap();
    assert!(message.starts_with("Cargo.toml:1:1: error R"), "{shown}");
    assert!(shown.contains("include_bytes"), "{shown}");
    assert!(expanded(quote!("robots/none.toml")).contains("there is no such file"));
    assert!(expanded(quote!("../none.toml")).contains("there is no such file"));
    assert!(expanded(quote!("robots/trttr1.toml", snap = -1)).contains("is not an angle"));
}

#[test]
fn each_error_of_a_file_is_one_of_the_compiler() {
    let folder = folder_of("errors");
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../robots/planar_2r.toml");
    let file = std::fs::read_to_string(file).unwrap();
    let wrong = file.replace("mass = \"m2\"", "mass = \"m5\"").replace("[tip]", "[tipp]");
    std::fs::write(folder.join("arm.toml"), wrong).unwrap();
    let arguments: Arguments = syn::parse2(quote!("arm.toml")).unwrap();
    let errors = expand(&arguments, &folder).unwrap().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    let messages: Vec<&str> = errors.split("compile_error ! { \"").skip(1).collect();
    assert_eq!(messages.len(), 2, "{errors}");
    for (message, start) in
        messages.iter().zip(["arm.toml:32:9: error R0303: `m5`", "arm.toml:36:2: error R0101: "])
    {
        assert!(message.starts_with(start), "{message}");
        assert!(message.contains("--> arm.toml:"), "{message}");
    }
}

#[test]
fn a_plan_is_watched_if_there_is_one() {
    let shown = expanded(quote!("robots/ur5.toml"));
    assert!(shown.contains("/robots/ur5.toml\"") && shown.contains("/robots/ur5.plan\""));
    let folder = folder_of("plan");
    std::fs::copy(package().join("robots/planar_2r.toml"), folder.join("arm.toml")).unwrap();
    let arguments: Arguments = syn::parse2(quote!("arm.toml")).unwrap();
    let expanded = || expand(&arguments, &folder).unwrap().to_string();
    assert!(!expanded().contains("arm.plan"));
    // A plan with an error is tracked too, so that a corrected one is noticed.
    std::fs::write(folder.join("arm.plan"), "garbage").unwrap();
    let shown = expanded();
    assert!(
        shown.contains("compile_error ! { \"arm.plan: line 1 is not that of a plan"),
        "{shown}"
    );
    assert!(shown.contains("/arm.plan\""), "{shown}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn paths_are_shown_from_where_the_compiler_runs() {
    let here = package().canonicalize().unwrap();
    let file = here.join("robots/ur5.toml");
    assert_eq!(shown(&file, &package()).as_deref(), Some("robots/ur5.toml"));
    assert_eq!(shown(&file, &here.join("robots")).as_deref(), Some("ur5.toml"));
    assert_eq!(shown(&file, &here.join("crates")), None);
}

#[test]
fn functions_of_a_link_are_asked_for_by_name() {
    let shown =
        expanded(quote!("robots/trttr1.toml", functions = ["jacobian_3"], allow_unphysical = true));
    assert!(shown.contains("fn jacobian_3"), "{shown}");
    assert!(!shown.contains("fn jacobian ("), "{shown}");
    let shown = expanded(quote!("robots/trttr1.toml", functions = ["jacobian_hand", "bias"]));
    assert!(shown.contains("there is no function `jacobian_hand`"), "{shown}");
}

#[test]
fn wrong_bundles_are_named() {
    let of = |bundles| expanded(quote!("robots/trttr1.toml", bundles = #bundles));
    assert!(of(quote!({ load = [] })).contains("the list of functions is empty"));
    assert!(of(quote!({})).contains("the list of bundles is empty"));
    assert!(of(quote!({ load = ["biass"] })).contains("use one of \\\"inverse_dynamics\\\""));
    assert!(of(quote!({ bias = ["bias"] })).contains("the name is not allowed"));
    assert!(of(quote!(["bias"])).contains("expected curly braces"));
}

#[test]
fn a_budget_breaks_the_build() {
    let shown = expanded(quote!("robots/trttr1.toml", max_operations = 10, max_stack = 20));
    for part in ["operations; its budget is 10", "bytes of stack; its budget is 20"] {
        assert!(shown.contains(part), "{shown}");
    }
}

#[test]
fn each_option_has_its_key() {
    for option in robot_build::OPTIONS {
        let text = format!("\"robots/trttr1.toml\", {} = {}", option.name, option.example);
        let arguments: Arguments = syn::parse_str(&text).unwrap();
        let mut expected = robot_build::Options::default();
        if let Some(value) = option.value(option.example) {
            option.set(&mut expected, value);
        }
        assert_eq!(arguments.options, expected, "{text}");
        let options = arguments.options_for(&planar()).unwrap();
        match option.name {
            "functions" => assert_ne!(options.functions, expected.functions),
            "bundles" => assert_eq!(options.bundles.len(), 1),
            "allow_outside" => assert!(arguments.allow_outside),
            _ => assert_eq!(options, expected),
        }
    }
}

fn planar() -> robot_build::Robot {
    let text = std::fs::read_to_string(package().join("robots/planar_2r.toml")).unwrap();
    let source = robot_build::Source { name: "planar_2r.toml".to_owned(), text };
    robot_build::read(&source).unwrap().robot
}
