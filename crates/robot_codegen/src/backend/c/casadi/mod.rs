//! External functions of CasADi: a source file next to the header that provides each function with CasADi's C
//! interface, and its Jacobian if the module has functions that compute it.

use super::{Dialect, Header, comment, tree};
use crate::backend::SourceFile;
use crate::backend::common::{Namer, Scalar};
use crate::backend::flat::{FlatOptions, Function};
use crate::module::Module;

mod blocks;
mod external;

use self::external::{External, Port};

/// Names that CasADi does not accept for functions.
const RESERVED: &[&str] = &["hess", "jac", "null"];

/// The name endings of the additional functions that CasADi looks up for each function.
const ENDINGS: &[&str] = &[
    "n_in",
    "n_out",
    "name_in",
    "name_out",
    "sparsity_in",
    "sparsity_out",
    "default_in",
    "diff_in",
    "diff_out",
    "work",
    "work_bytes",
    "mem",
    "alloc_mem",
    "init_mem",
    "free_mem",
    "checkout",
    "release",
    "incref",
    "decref",
    "config",
];

/// The external functions of a module.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Casadi {
    /// The source file.
    pub file: SourceFile,
    /// For each function of the module, its name for `casadi.external`, and whether CasADi finds its Jacobian.
    pub functions: Vec<(String, bool)>,
    /// The name of the function without inputs that returns the nominal parameters, if all have nominal values.
    pub nominal: Option<String>,
}

/// Prints the external functions of a module in double precision, which CasADi uses; returns `None` in single
/// precision.
///
/// All arrays are dense columns, and matrices are stored column by column. The parameters of the module are an
/// additional input, `parameters`, in their order. CasADi treats the functions as constant with respect to it.
#[must_use]
pub fn casadi(module: &Module, options: &FlatOptions) -> Option<Casadi> {
    if options.scalar != Scalar::F64 {
        return None;
    }
    let tree = tree(module, options);
    let header = Header::new(&tree, options, Dialect::C);
    let mut namer = Namer::new(&[RESERVED], &[]);
    let mut symbol = |name: &str| {
        // For a function `gravity`, CasADi also looks up `gravity_work`.
        let is_ending = |ending: &&str| name.ends_with(&format!("_{ending}"));
        let ending = if ENDINGS.iter().any(is_ending) { "_f" } else { "" };
        namer.name(&format!("casadi_{}_{name}{ending}", tree.name))
    };
    let mut lines = beginning(&header);
    let mut functions = vec![];
    for function in &tree.functions {
        let name = symbol(&function.source.name);
        let external = External::of(&header, function, &name);
        let jacobian = blocks::jacobian(&header, function, &external);
        lines.extend(external.lines());
        lines.extend(jacobian.iter().flat_map(External::lines));
        functions.push((name, jacobian.is_some()));
    }
    let has_nominal =
        tree.has_parameters() && module.parameters.iter().all(|one| one.nominal.is_some());
    let nominal = has_nominal.then(|| {
        let name = symbol("nominal");
        lines.extend(external::nominal(&header, &name).lines());
        name
    });
    let name = format!("{}_casadi.c", tree.name);
    let file = SourceFile::text(name, lines.join("\n"));
    Some(Casadi { file, functions, nominal })
}

fn beginning(header: &Header<'_>) -> Vec<String> {
    let mut lines: Vec<String> =
        header.options.header.iter().map(|line| comment::of_line(line)).collect();
    lines.push(String::new());
    lines.extend(comment::of_paragraphs(&[
        format!("The functions of `{}.h` for CasADi's `external`, with exact Jacobians where the header computes them.", header.tree.name),
        String::new(),
        "Arrays are dense columns, and matrices are stored column by column. If CasADi passes a null pointer for an input, its entries are 0.".to_owned(),
    ]));
    lines.extend([format!("#include \"{}.h\"", header.tree.name)]);
    lines.extend(
        "
#ifndef casadi_real
#define casadi_real double
#endif
#ifndef casadi_int
#define casadi_int long long int
#endif
#if defined(_WIN32)
#define CASADI_EXPORT_ __declspec(dllexport)
#elif defined(__GNUC__)
#define CASADI_EXPORT_ __attribute__((visibility(\"default\")))
#else
#define CASADI_EXPORT_
#endif

#ifdef __cplusplus
extern \"C\" {
#endif

static void take_(double *to, const casadi_real *from, int length)
{
    int i;
    for (i = 0; i < length; i++) {
        to[i] = from ? from[i] : 0.0;
    }
}

/* Copies a matrix that is stored row by row to an array that is stored column by column. */
static void give_(casadi_real *to, const double *from, int rows, int columns)
{
    int i, j;
    if (!to) {
        return;
    }
    for (i = 0; i < rows; i++) {
        for (j = 0; j < columns; j++) {
            to[j * rows + i] = from[i * columns + j];
        }
    }
}
"
        .lines()
        .map(str::to_owned),
    );
    lines
}

/// Makes the ports of a function's inputs and outputs. Their names are unique, because CasADi uses them as keywords.
fn ports(function: &Function<'_>, parameters: usize) -> (Vec<Port>, Vec<Port>) {
    let source = function.source;
    let mut namer = Namer::new(&[RESERVED], &[]);
    let mut inputs: Vec<Port> = vec![];
    for (input, array) in source.inputs.iter().zip(&function.inputs) {
        inputs.push(Port::dense(namer.name(&input.name), array.length, 1));
    }
    if parameters > 0 {
        inputs.push(Port::dense(namer.name("parameters"), parameters, 1));
    }
    let outputs = source.outputs.iter().map(|output| {
        let (rows, columns) = match output.shape.as_slice() {
            [rows, columns] => (*rows, *columns),
            _ => (output.len(), 1),
        };
        Port::dense(namer.name(&output.name), rows, columns)
    });
    (inputs, outputs.collect())
}
