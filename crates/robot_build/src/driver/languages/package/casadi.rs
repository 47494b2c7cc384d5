//! The parts of a C package that concern its external functions for CasADi.

use robot_codegen::backend::c::Casadi;
use robot_codegen::backend::flat::Tree;

/// Prints the CMake target of the shared library.
pub(super) fn cmake(name: &str) -> String {
    format!(
        "
# For CasADi's `external`: a shared library.
add_library({name}_casadi SHARED {name}_casadi.c)
target_link_libraries({name}_casadi PRIVATE {name})
set_target_properties({name}_casadi PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
"
    )
}

/// Prints a section of the README.
pub(super) fn usage(tree: &Tree<'_>, casadi: &Casadi) -> String {
    let name = &tree.name;
    let with = casadi.functions.iter().find(|(_, has_jacobian)| *has_jacobian);
    let Some((function, _)) = with.or(casadi.functions.first()) else { return String::new() };
    let mut text = format!(
        "\nFor CasADi and the programs that accept its functions (acados, do-mpc), compile `{name}_casadi.c` to a \
         shared library, with CMake or like this:\n\n```sh\ncc -std=c99 -O2 -ffp-contract=off -shared -fPIC {name}_casadi.c -o \
         lib{name}_casadi.so -lm\n```\n\n```python\nimport casadi\n\nf = casadi.external(\"{function}\", \
         \"./lib{name}_casadi.so\")\n```\n\nEach function has the name `casadi_{name}_…`. Matrices are stored by columns, as \
         in CasADi."
    );
    let exact = casadi.functions.iter().filter(|(_, has_jacobian)| *has_jacobian);
    let exact: Vec<String> = exact.map(|(name, _)| format!("`{name}`")).collect();
    if exact.is_empty() {
        text.push_str(
            " No function has a Jacobian: also generate the derivatives \
             (`inverse_dynamics_derivatives` with `mass_matrix`, `forward_dynamics_derivatives`).",
        );
    } else {
        text.push_str(&format!(
            " CasADi gets exact Jacobians of {}, but not of other functions; none has second derivatives.",
            exact.join(", ")
        ));
    }
    if tree.has_parameters() {
        text.push_str(&format!(
            " The last input is the column of parameters, [{}], which CasADi treats as constant when it differentiates.",
            tree.parameters.join(", ")
        ));
    }
    if let Some(nominal) = &casadi.nominal {
        text.push_str(&format!(" `{nominal}` returns their nominal values."));
    }
    text.push('\n');
    text
}
