use super::*;

fn package() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn expanded(input: TokenStream) -> String {
    let arguments: syn::Result<Arguments> = syn::parse2(input);
    let tokens = arguments.and_then(|arguments| expand(&arguments, &package()));
    tokens.unwrap_or_else(|error| error.to_compile_error()).to_string()
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
        "robots/trttr1.toml", max_operations = "x", snapp = 1, snap = "x", functions = ["inverse"], scalar = "f16",
        allow_outside = 1, runtime = 3, trigonometry = "none", scalar = "f32", batch = 2.5
    });
    for part in [
        "there is no option `snapp`",
        "expected a number",
        "expected one of \\\"inverse_dynamics\\\"",
        "expected one of \\\"f64\\\", \\\"f32\\\"",
        "expected true or false",
        "expected a whole number",
        "expected a string literal",
        "expected one of \\\"standard\\\", \\\"polynomial\\\"",
        "`scalar` is given twice",
    ] {
        assert!(shown.contains(part), "{part} is not in {shown}");
    }
    assert_eq!(shown.matches("compile_error").count(), 10);
    assert!(expanded(quote!(5)).contains("expected the path of a robot file"));
    assert!(expanded(quote!()).contains("expected the path of a robot file"));
}

#[test]
fn what_is_wrong_with_a_file_is_shown_and_the_file_watched() {
    let shown = expanded(quote!("Cargo.toml"));
    assert!(shown.contains("compile_error"), "{shown}");
    assert!(shown.contains("Cargo.toml:1:"), "{shown}");
    assert!(shown.contains("include_bytes"), "{shown}");
    assert!(expanded(quote!("robots/none.toml")).contains("there is no such file"));
    assert!(expanded(quote!("../none.toml")).contains("there is no such file"));
    assert!(expanded(quote!("robots/trttr1.toml", snap = -1)).contains("is no angle"));
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
    assert!(of(quote!({ load = [] })).contains("no functions are chosen"));
    assert!(of(quote!({ load = ["biass"] })).contains("expected one of \\\"inverse_dynamics\\\""));
    assert!(of(quote!({ bias = ["bias"] })).contains("it cannot have this name"));
    assert!(of(quote!(["bias"])).contains("expected curly braces"));
}

#[test]
fn a_budget_breaks_the_build() {
    let shown = expanded(quote!("robots/trttr1.toml", max_operations = 10, max_stack = 20));
    for part in ["operations; its budget is 10", "bytes of stack; its budget is 20"] {
        assert!(shown.contains(part), "{shown}");
    }
}
