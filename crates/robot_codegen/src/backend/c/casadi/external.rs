//! An external function: the functions of C that CasADi requires for it, and its body.

use super::super::Header;
use super::ports;
use crate::backend::flat::Function;

/// An input or an output.
#[derive(Clone)]
pub(super) struct Port {
    pub(super) name: String,
    pub(super) rows: usize,
    pub(super) columns: usize,
    /// Whether all entries are stored; otherwise none is, and the matrix is 0.
    is_dense: bool,
}

impl Port {
    pub(super) fn dense(name: String, rows: usize, columns: usize) -> Port {
        Port { name, rows, columns, is_dense: true }
    }

    pub(super) fn zero(name: String, rows: usize, columns: usize) -> Port {
        Port { name, rows, columns, is_dense: false }
    }

    pub(super) fn size(&self) -> usize {
        self.rows * self.columns
    }

    /// CasADi's compressed column format: the numbers of rows and columns, the start of each column, and the rows of
    /// the entries. A 1 in the third place stands for a dense matrix.
    fn sparsity(&self) -> String {
        let mut numbers = vec![self.rows, self.columns];
        match self.is_dense {
            true => numbers.push(1),
            false => numbers.extend(vec![0; self.columns + 1]),
        }
        numbers.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
    }
}

/// A function with CasADi's interface.
pub(super) struct External {
    pub(super) name: String,
    pub(super) inputs: Vec<Port>,
    pub(super) outputs: Vec<Port>,
    /// The number of the first inputs with respect to which the function can be differentiated.
    pub(super) variables: usize,
    /// The statements of the body, which read from `arg` and write to `res`.
    pub(super) body: Vec<String>,
}

impl External {
    /// Makes the external function for a function of the module.
    pub(super) fn of(header: &Header<'_>, function: &Function<'_>, name: &str) -> External {
        let (inputs, outputs) = ports(function, header.tree.parameters.len());
        let variables = function.inputs.len();
        let mut body = taken(&inputs);
        body.extend(model(header, variables));
        let arguments = (0..variables).map(|index| format!("x{index}"));
        body.extend(call(header, function, arguments, "y"));
        for (index, port) in outputs.iter().enumerate() {
            body.push(given(index, &format!("y{index}"), port));
        }
        External { name: name.to_owned(), inputs, outputs, variables, body }
    }

    /// Prints all functions of C that CasADi looks up.
    pub(super) fn lines(&self) -> Vec<String> {
        let name = &self.name;
        let mut lines: Vec<String> = vec![
            format!(
                "CASADI_EXPORT_ int {name}(const casadi_real **arg, casadi_real **res, casadi_int *iw, casadi_real *w, int mem)"
            ),
            "{".to_owned(),
        ];
        lines.extend(self.body.iter().map(|line| format!("    {line}")));
        if self.inputs.is_empty() {
            lines.push("    (void)arg;".to_owned());
        }
        lines.extend(
            ["    (void)iw;", "    (void)w;", "    (void)mem;", "    return 0;", "}", ""]
                .map(str::to_owned),
        );
        let (inputs, outputs) = (self.inputs.len(), self.outputs.len());
        let returns = |result: &str, ending: &str, parameters: &str, value: &str| {
            format!("CASADI_EXPORT_ {result}{name}_{ending}({parameters}) {{ {value} }}")
        };
        lines.extend([
            returns("casadi_int ", "n_in", "void", &format!("return {inputs};")),
            returns("casadi_int ", "n_out", "void", &format!("return {outputs};")),
            returns("int ", "diff_in", "casadi_int i", &format!("return i < {};", self.variables)),
        ]);
        for (ports, ending) in [(&self.inputs, "in"), (&self.outputs, "out")] {
            lines.extend(self.described(ports, ending));
        }
        lines.push(returns(
            "int ",
            "work",
            "casadi_int *sz_arg, casadi_int *sz_res, casadi_int *sz_iw, casadi_int *sz_w",
            &format!(
                "if (sz_arg) {{ *sz_arg = {inputs}; }} if (sz_res) {{ *sz_res = {outputs}; }} if (sz_iw) {{ *sz_iw = 0; }} if (sz_w) {{ *sz_w = 0; }} return 0;"
            ),
        ));
        lines.extend([
            returns("int ", "alloc_mem", "void", "return 0;"),
            returns("int ", "init_mem", "int mem", "(void)mem; return 0;"),
            returns("void ", "free_mem", "int mem", "(void)mem;"),
            returns("int ", "checkout", "void", "return 0;"),
            returns("void ", "release", "int mem", "(void)mem;"),
            returns("void ", "incref", "void", ""),
            returns("void ", "decref", "void", ""),
            String::new(),
        ]);
        lines
    }

    /// Prints the functions that return the names and the sparsity of inputs or of outputs.
    fn described(&self, ports: &[Port], ending: &str) -> Vec<String> {
        let name = &self.name;
        let mut lines = vec![
            format!("CASADI_EXPORT_ const char *{name}_name_{ending}(casadi_int i)"),
            "{".to_owned(),
            "    switch (i) {".to_owned(),
        ];
        for (index, port) in ports.iter().enumerate() {
            lines.push(format!("    case {index}: return \"{}\";", port.name));
        }
        lines.extend(["    default: return 0;", "    }", "}", ""].map(str::to_owned));
        lines.push(format!(
            "CASADI_EXPORT_ const casadi_int *{name}_sparsity_{ending}(casadi_int i)"
        ));
        lines.push("{".to_owned());
        for (index, port) in ports.iter().enumerate() {
            lines
                .push(format!("    static const casadi_int s{index}[] = {{{}}};", port.sparsity()));
        }
        lines.push("    switch (i) {".to_owned());
        for index in 0..ports.len() {
            lines.push(format!("    case {index}: return s{index};"));
        }
        lines.extend(["    default: return 0;", "    }", "}", ""].map(str::to_owned));
        lines
    }
}

/// Prints the statements that copy the inputs to `x0`, `x1` and so on.
pub(super) fn taken(inputs: &[Port]) -> Vec<String> {
    let inputs = inputs.iter().enumerate();
    let lines = inputs.flat_map(|(index, port)| {
        let size = port.size();
        [format!("double x{index}[{size}];"), format!("take_(x{index}, arg[{index}], {size});")]
    });
    // Declarations come first.
    let (mut lines, calls): (Vec<_>, Vec<_>) = lines.partition(|line| line.starts_with("double"));
    lines.extend(calls);
    lines
}

/// Prints the statements that compute `model` from the input `input`, the parameters, if the module has any.
pub(super) fn model(header: &Header<'_>, input: usize) -> Vec<String> {
    if !header.tree.has_parameters() {
        return vec![];
    }
    let names = &header.names;
    let mut lines = vec![
        format!("{} parameters;", names.item("parameters")),
        format!("{} model;", names.item("model")),
    ];
    for (index, field) in header.tree.parameters.iter().enumerate() {
        lines.push(format!("parameters.{field} = x{input}[{index}];"));
    }
    lines.push(format!("{}(&model, &parameters);", names.item("model_init")));
    lines
}

/// Prints the call of a function. Its results are in arrays with the name `results` followed by a number.
pub(super) fn call(
    header: &Header<'_>,
    function: &Function<'_>,
    arguments: impl Iterator<Item = String>,
    results: &str,
) -> Vec<String> {
    let outputs = function.outputs.iter().enumerate();
    let mut lines: Vec<String> = outputs
        .map(|(index, array)| format!("double {results}{index}[{}];", array.length))
        .collect();
    let model = header.tree.has_parameters().then(|| "&model".to_owned());
    let results = (0..function.outputs.len()).map(|index| format!("{results}{index}"));
    let arguments: Vec<String> = model.into_iter().chain(arguments).chain(results).collect();
    lines.push(format!("{}({});", header.names.item(&function.name), arguments.join(", ")));
    lines
}

/// Prints the statement that copies an output from an array in row-major order.
pub(super) fn given(index: usize, from: &str, port: &Port) -> String {
    format!("give_(res[{index}], {from}, {}, {});", port.rows, port.columns)
}

/// Makes the external function without inputs that returns the nominal parameters.
pub(super) fn nominal(header: &Header<'_>, name: &str) -> External {
    let fields = &header.tree.parameters;
    let port = Port::dense("parameters".to_owned(), fields.len(), 1);
    let ty = header.names.item("parameters");
    let mut body = vec![
        format!("const {ty} parameters = {}();", header.names.item("nominal")),
        format!("double y0[{}];", fields.len()),
    ];
    for (index, field) in fields.iter().enumerate() {
        body.push(format!("y0[{index}] = parameters.{field};"));
    }
    body.push(given(0, "y0", &port));
    External { name: name.to_owned(), inputs: vec![], outputs: vec![port], variables: 0, body }
}
