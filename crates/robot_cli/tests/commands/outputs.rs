//! Output files of every command never replace an input, and files that this program did not write only with `--force`.

use std::fs;
use std::path::{Path, PathBuf};

use robot_build::languages::Language;

use crate::{URDF, complaint, folder, output, robot, run, run_between, run_with};

const TRAJECTORY: &str =
    "t,q1,q2,qd1,qd2,qdd1,qdd2,tau1,tau2\n0,0,0,0,0,0,0,0,0\n1,0,0,0,0,0,0,0,0\n";

/// A folder with the inputs of all commands.
pub(crate) struct Inputs(PathBuf);

impl Inputs {
    pub(crate) fn new(test: &str) -> Inputs {
        let inputs = Inputs(folder(test));
        fs::copy(robot("planar_2r"), inputs.path("arm.toml")).unwrap();
        fs::copy(robot("planar_2r").replace(".toml", ".plan"), inputs.path("arm.plan")).unwrap();
        fs::write(inputs.path("arm.urdf"), URDF).unwrap();
        fs::write(inputs.path("motion.csv"), TRAJECTORY).unwrap();
        fs::write(inputs.path("motion.png"), TRAJECTORY).unwrap();
        fs::write(inputs.path("arm.printed"), "Q2 = I2*qdd2 + Mz\n").unwrap();
        inputs
    }

    pub(crate) fn path(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_owned()
    }

    /// The words of a command line, in which `@NAME` is a file of the folder.
    fn words(&self, line: &str) -> Vec<String> {
        let place = |word: &str| word.strip_prefix('@').map(|name| self.path(name));
        line.split_whitespace().map(|word| place(word).unwrap_or_else(|| word.to_owned())).collect()
    }

    /// Runs a command line with further words.
    pub(crate) fn run(&self, line: &str, last: &[&str]) -> crate::Outcome {
        let words = self.words(line);
        run(&words.iter().map(String::as_str).chain(last.iter().copied()).collect::<Vec<_>>())
    }
}

/// Command lines up to the name of the output, with their inputs.
const READERS: &[(&str, &[&str])] = &[
    ("generate @arm.toml -o", &["arm.toml", "arm.plan"]),
    ("document @arm.toml -o", &["arm.toml", "arm.plan"]),
    ("document @arm.toml --format typst -o", &["arm.toml", "arm.plan"]),
    ("document @arm.toml --like @arm.printed -o", &["arm.toml", "arm.printed"]),
    ("report @arm.toml --without-compiler -o", &["arm.toml", "arm.plan"]),
    ("import @arm.urdf -o", &["arm.urdf"]),
    ("crate @arm.toml -o", &["arm.toml", "arm.plan"]),
    (
        "simulate @arm.toml --torques @motion.csv --time 0.1 -o",
        &["arm.toml", "arm.plan", "motion.csv"],
    ),
    ("simulate @arm.toml --torques @motion.png --time 0.1 --plot", &["motion.png"]),
    ("torques @arm.toml --trajectory @motion.csv -o", &["arm.toml", "arm.plan", "motion.csv"]),
    ("torques @arm.toml --trajectory @motion.png --plot", &["motion.png"]),
    ("watch @arm.toml --saves 0 --report", &["arm.toml", "arm.plan"]),
];

#[test]
fn no_output_replaces_an_input() {
    let inputs = Inputs::new("outputs-inputs");
    let name = inputs.0.file_name().unwrap().to_str().unwrap();
    for (line, read) in READERS {
        for input in *read {
            let before = fs::read(inputs.path(input)).unwrap();
            let (soft, hard) = (format!("soft.{input}"), format!("hard.{input}"));
            let mut names = vec![(*input).to_owned(), format!("../{name}/./{input}")];
            #[cfg(unix)]
            {
                let _ = fs::remove_file(inputs.path(&soft));
                std::os::unix::fs::symlink(input, inputs.path(&soft)).unwrap();
                names.push(soft);
            }
            let _ = fs::remove_file(inputs.path(&hard));
            fs::hard_link(inputs.path(input), inputs.path(&hard)).unwrap();
            names.push(hard);
            for name in names {
                let path = inputs.path(&name);
                for more in [&[path.as_str()][..], &[&path, "--force"]] {
                    let outcome = inputs.run(line, more);
                    let shown = format!("{line} {more:?}: {}", outcome.errors);
                    assert_eq!((outcome.code, outcome.output.as_str()), (1, ""), "{shown}");
                    let reasons = ["an output never replaces an input", "a folder is needed"];
                    assert!(reasons.iter().any(|reason| shown.contains(reason)), "{shown}");
                    assert_eq!(fs::read(inputs.path(input)).unwrap(), before, "{shown}");
                }
            }
        }
    }
}

/// Command lines up to the name of an output that they can write again.
const WRITERS: &[(&str, &str)] = &[
    ("generate @arm.toml -o", "out.rs"),
    ("document @arm.toml -o", "out.tex"),
    ("document @arm.toml -o", "out.typ"),
    ("report @arm.toml --without-compiler -o", "out.html"),
    ("simulate @arm.toml --time 0.1 -o", "out.csv"),
    ("simulate @arm.toml --time 0.1 --plot", "out.svg"),
    ("simulate @arm.toml --time 0.1 --plot", "out.png"),
    ("torques @arm.toml --trajectory @motion.csv -o", "shares.csv"),
    ("torques @arm.toml --trajectory @motion.csv --plot", "shares.svg"),
    ("schema -o", "out.json"),
    ("completions bash -o", "out.bash"),
    ("completions zsh -o", "_out"),
    ("completions fish -o", "out.fish"),
    ("completions elvish -o", "out.elv"),
    ("completions powershell -o", "out.ps1"),
];

#[test]
fn files_of_others_are_replaced_with_force_alone_and_own_ones_without() {
    let inputs = Inputs::new("outputs-own");
    for (line, name) in WRITERS {
        let path = inputs.path(name);
        let write = |more: &[&str]| inputs.run(line, &[&[path.as_str()], more].concat());
        // Tables with measurements of the robot's motion were not written by this program.
        let mine = if name.ends_with("csv") { TRAJECTORY } else { "my notes\n" };
        fs::write(&path, mine).unwrap();
        let outcome = write(&[]);
        assert_eq!((outcome.code, outcome.output.as_str()), (1, ""), "{line} {name}");
        assert!(outcome.errors.contains("is not replaced: it does not "), "{}", outcome.errors);
        assert!(outcome.errors.contains("--force"), "{}", outcome.errors);
        assert_eq!(fs::read_to_string(&path).unwrap(), mine, "{line} {name}");
        assert_eq!(write(&["--force"]).code, 0, "{line} {name}");
        let first = fs::read(&path).unwrap();
        assert_ne!(first, mine.as_bytes(), "{line} {name}");
        // Files that this program wrote, also older versions, are replaced, and so are empty files.
        let older = unsealed(&first);
        for older in [&older[..older.len() - 2], b""] {
            fs::write(&path, older).unwrap();
            let outcome = write(&[]);
            assert_eq!(outcome.code, 0, "{line} {name}: {}", outcome.errors);
            assert_eq!(fs::read(&path).unwrap(), first, "{line} {name}");
        }
    }
    let hidden = fs::read_dir(&inputs.0).unwrap().map(|entry| entry.unwrap().file_name());
    let hidden: Vec<_> = hidden.filter(|name| name.to_str().unwrap().starts_with('.')).collect();
    assert!(hidden.is_empty(), "{hidden:?}");
}

/// Removes the seal of a document, as in versions that had none.
fn unsealed(bytes: &[u8]) -> Vec<u8> {
    let Ok(text) = str::from_utf8(bytes) else { return bytes.to_owned() };
    let Some((before, rest)) =
        text.split_once("; the next run replaces this file unless it was edited (sha256 ")
    else {
        return bytes.to_owned();
    };
    let (digits, after) = rest.split_once(')').unwrap();
    assert!(
        digits.len() == 16 && digits.chars().all(|digit| digit.is_ascii_hexdigit()),
        "{digits}"
    );
    [before, after].concat().into_bytes()
}

#[test]
fn a_plan_of_somebody_else_stays() {
    let inputs = Inputs::new("outputs-plan");
    let (file, plan) = (inputs.path("arm.toml"), inputs.path("arm.plan"));
    let kept = fs::read_to_string(&plan).unwrap();
    fs::write(&plan, "the plan of my garden\n").unwrap();
    let shown = complaint(1, &["search", &file], "");
    assert!(shown.contains("arm.plan is not replaced"), "{shown}");
    assert_eq!(run(&["search", &file, "--dry-run"]).code, 0);
    assert_eq!(fs::read_to_string(&plan).unwrap(), "the plan of my garden\n");
    assert_eq!(run(&["search", &file, "--force"]).code, 0);
    assert_eq!(fs::read_to_string(&plan).unwrap(), kept);
    fs::write(&plan, &kept[..200]).unwrap();
    assert_eq!(run(&["search", &file]).code, 0);
    assert_eq!(fs::read_to_string(&plan).unwrap(), kept);
}

#[test]
fn a_robot_file_with_notes_is_replaced_with_force_alone() {
    let inputs = Inputs::new("outputs-import");
    let (urdf, toml) = (inputs.path("arm.urdf"), inputs.path("out.toml"));
    let import = ["import", urdf.as_str(), "-o", toml.as_str()];
    assert_eq!(run(&import).code, 0);
    let imported = fs::read_to_string(&toml).unwrap();
    assert_eq!(run(&import).code, 0);
    let noted = format!("{imported}# weighed on Tuesday\n");
    fs::write(&toml, &noted).unwrap();
    let shown = run(&import);
    assert_eq!(shown.code, 1);
    assert!(shown.errors.contains("out.toml is not replaced"), "{}", shown.errors);
    let checked = complaint(1, &[&import[..], &["--check"]].concat(), "");
    assert!(checked.contains("with --force instead of --check to replace"), "{checked}");
    // Other commands do not replace it either.
    let other = inputs.path("arm.toml");
    assert_eq!(run(&["generate", &other, "-o", &toml]).code, 1);
    assert_eq!(fs::read_to_string(&toml).unwrap(), noted);
    assert_eq!(run(&[&import[..], &["--force"]].concat()).code, 0);
    assert_eq!(fs::read_to_string(&toml).unwrap(), imported);
}

/// The names below a folder.
fn names(folder: &Path) -> Vec<String> {
    let mut names = vec![];
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            names.extend(self::names(&path));
        }
        names.push(path.to_str().unwrap().to_owned());
    }
    names.sort();
    names
}

#[test]
fn a_crate_of_somebody_else_stays() {
    let inputs = Inputs::new("outputs-crate");
    let file = inputs.path("arm.toml");
    let mine = inputs.path("mine");
    fs::create_dir_all(format!("{mine}/src")).unwrap();
    let texts = [("Cargo.toml", "[package]\nname = \"mine\"\n"), ("src/lib.rs", "// precious\n")];
    for (name, text) in texts {
        fs::write(format!("{mine}/{name}"), text).unwrap();
    }
    let before = names(mine.as_ref());
    let shown = complaint(1, &["crate", &file, "-o", &mine], "");
    assert!(shown.contains("Cargo.toml is not") && shown.contains("lib.rs is not"), "{shown}");
    assert_eq!(shown.lines().count(), 2);
    assert_eq!(names(mine.as_ref()), before);
    for (name, text) in texts {
        assert_eq!(fs::read_to_string(format!("{mine}/{name}")).unwrap(), text);
    }
    let outcome = run(&["crate", &file, "-o", &mine, "--force"]);
    assert_eq!((outcome.code, outcome.errors), (0, format!("wrote {mine}: 30 files\n")));
    // All files of a crate are recognized as files of this program.
    for name in names(mine.as_ref()).iter().filter(|name| Path::new(name).is_file()) {
        let text = fs::read_to_string(name).unwrap();
        fs::write(name, text.lines().next().unwrap()).unwrap();
    }
    let outcome = run(&["crate", &file, "-o", &mine]);
    assert_eq!((outcome.code, outcome.errors), (0, format!("wrote {mine}: 30 files\n")));
    fs::remove_file(format!("{mine}/README.md")).unwrap();
    let outcome = run(&["crate", &file, "-o", &mine]);
    assert_eq!((outcome.code, outcome.errors), (0, format!("wrote {mine}: 1 of 30 files\n")));
    assert_eq!(output(&["crate", &file, "-o", &mine], ""), "");
}

/// A package is written again after each change of its robot, with a warning if files of earlier functions remain.
#[test]
fn packages_of_all_languages_are_written_again() {
    let inputs = Inputs::new("outputs-languages");
    let file = inputs.path("arm.toml");
    let text = fs::read_to_string(robot("planar_2r")).unwrap();
    let changed = text.replace("value = 9.81", "value = 1.62");
    for language in Language::ALL.iter().map(|language| language.name()) {
        let scalar = if ["arduino", "wgsl"].contains(&language) { "f32" } else { "f64" };
        let folder = inputs.path(language);
        let arguments = [
            "crate",
            &file,
            "--language",
            language,
            "--scalar",
            scalar,
            "-o",
            &folder,
            "--function",
        ];
        let write = |text: &str, functions: &str| {
            fs::write(&file, text).unwrap();
            run(&[&arguments[..], &[functions]].concat())
        };
        let first = write(&text, "inverse_dynamics,gravity");
        assert_eq!(first.code, 0, "{language}: {}", first.errors);
        let second = write(&changed, "inverse_dynamics");
        assert_eq!(second.code, 0, "{language}: {}", second.errors);
        let warning = second.errors.contains("a generated file of an earlier run");
        assert_eq!(warning, language == "matlab", "{language}: {}", second.errors);
        if warning {
            assert!(second.errors.contains("gravity.m; remove"), "{}", second.errors);
        }
        // A folder that is up to date contains no earlier files.
        assert_eq!(output(&[&arguments[..], &["inverse_dynamics", "--check"]].concat(), ""), "");
    }
}

/// Of many files of an earlier run, the first are named and the others counted; `--check` names what is missing.
#[test]
fn many_files_of_an_earlier_run_are_counted() {
    let inputs = Inputs::new("outputs-remaining");
    let package = inputs.path("matlab");
    let write = |functions: &str, more: &[&str]| {
        let line = format!("crate @arm.toml --language matlab --function {functions} -o @matlab");
        inputs.run(&line, more)
    };
    let many =
        "bias,gravity,mass_matrix,forward_kinematics,energies,coriolis_matrix,inverse_dynamics";
    assert_eq!(write(many, &[]).code, 0);
    let present = |function: &str| {
        names(package.as_ref()).iter().any(|name| name.ends_with(&format!("/{function}.m")))
    };
    assert!(present("bias") && present("inverse_dynamics"));
    let few = write("inverse_dynamics", &[]);
    assert_eq!(few.code, 0, "{}", few.errors);
    let warning = few.errors.lines().find(|line| line.starts_with("warning: ")).unwrap();
    assert!(
        warning.contains("6 generated files of an earlier run that are not part of this package: "),
        "{warning}"
    );
    assert!(warning.ends_with(" and 1 more; remove those that you do not need"), "{warning}");
    assert_eq!(warning.matches(".m").count(), 5, "{warning}");
    fs::remove_file(names(package.as_ref()).iter().find(|name| name.ends_with("/bias.m")).unwrap())
        .unwrap();
    let five = write("inverse_dynamics", &[]).errors;
    assert!(five.contains("5 generated files") && !five.contains("more;"), "{five}");
    let stale = write("bias,gravity", &["--check"]);
    assert_eq!(stale.code, 1);
    assert!(stale.errors.contains("bias.m is missing"), "{}", stale.errors);
    assert!(!stale.errors.contains("gravity.m is"), "{}", stale.errors);
}

#[test]
fn manual_pages_of_somebody_else_stay() {
    let folder = folder("outputs-man");
    let (pages, page) = (folder.to_str().unwrap(), folder.join("robot-symbolic.1"));
    fs::write(&page, ".TH mine 1\n").unwrap();
    assert!(complaint(1, &["man", pages], "").contains("robot-symbolic.1 is not replaced"));
    assert_eq!(names(&folder).len(), 1);
    assert_eq!(run(&["man", pages, "--force"]).code, 0);
    let first = fs::read_to_string(&page).unwrap();
    fs::write(&page, first.replace("help", "")).unwrap();
    assert_eq!(run(&["man", pages]).code, 0);
    assert_eq!(fs::read_to_string(&page).unwrap(), first);
}

#[test]
fn table_and_plot_are_two_files() {
    let inputs = Inputs::new("outputs-two");
    let path = inputs.path("both.svg");
    let outcome = inputs.run("simulate @arm.toml --time 0.1 -o", &[&path, "--plot", &path]);
    assert!(outcome.errors.contains("two outputs have this name"), "{}", outcome.errors);
    // If one of the two outputs cannot be written, neither is.
    let (plot, table) = (inputs.path("plot.svg"), inputs.path("mine.csv"));
    fs::write(&table, TRAJECTORY).unwrap();
    let outcome = inputs.run("simulate @arm.toml --time 0.1 -o", &[&table, "--plot", &plot]);
    assert_eq!((outcome.code, Path::new(&plot).exists()), (1, false));
}

#[test]
fn messages_that_nobody_hears_do_not_end_the_work() {
    struct Deaf;
    impl std::io::Write for Deaf {
        fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
            Err(std::io::ErrorKind::BrokenPipe.into())
        }
        fn flush(&mut self) -> std::io::Result<()> {
            Err(std::io::ErrorKind::BrokenPipe.into())
        }
    }
    let inputs = Inputs::new("outputs-deaf");
    let toml = inputs.path("out.toml");
    let words = inputs.words("import @arm.urdf -o @out.toml");
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    assert_eq!(run_between(&words, b"", &mut vec![], &mut Deaf), 0);
    assert!(Path::new(&toml).exists());
    // Output that cannot be written is an error, except if the reader has closed the stream.
    let plan = inputs.path("arm.plan");
    fs::remove_file(&plan).unwrap();
    let words = inputs.words("search @arm.toml");
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    assert_eq!(run_between(&words, b"", &mut Deaf, &mut vec![]), 0);
    assert!(Path::new(&plan).exists());
    assert_eq!(run_with(&["--version"], b"").code, 0);
}

/// A stream that fails as on a full disk, or as if its reader has closed it.
struct Broken(std::io::ErrorKind);

impl std::io::Write for Broken {
    fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
        Err(self.0.into())
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Err(self.0.into())
    }
}

/// The exit code of a command whose output cannot be written.
fn broken(arguments: &[&str], kind: std::io::ErrorKind) -> u8 {
    run_between(arguments, b"", &mut Broken(kind), &mut vec![])
}

/// The exit code for output that cannot be written differs from those of answers; a reader that closes the stream does
/// not change the answer.
#[test]
fn output_that_cannot_be_written_is_no_answer() {
    use std::io::ErrorKind::{BrokenPipe, StorageFull};
    let printed = folder("outputs-answers").join("printed");
    fs::write(&printed, "Q2 = 0\n").unwrap();
    let (arm, scara) = (robot("planar_2r"), robot("scara"));
    let differ = ["compare", &arm, printed.to_str().unwrap()];
    let others = ["diff", &arm, &scara, "--states", "1"];
    let same = ["diff", &arm, &arm, "--states", "1"];
    for (arguments, answer) in [(&differ[..], 1), (&others, 1), (&same, 0)] {
        assert_eq!(run(arguments).code, answer, "{arguments:?}");
        assert_eq!(broken(arguments, BrokenPipe), answer, "{arguments:?}");
        assert_eq!(broken(arguments, StorageFull), 2, "{arguments:?}");
    }
    for arguments in [&["show", &arm][..], &["stats", &arm], &["--help"], &["--version"]] {
        assert_eq!(broken(arguments, StorageFull), 2, "{arguments:?}");
        assert_eq!(broken(arguments, BrokenPipe), 0, "{arguments:?}");
    }
}

#[test]
fn a_dash_is_standard_output() {
    let inputs = Inputs::new("outputs-dash");
    let [mut printed, mut refused] = [0, 0];
    for (line, _) in READERS {
        let outcome = inputs.run(line, &["-"]);
        let to_stdout = line.ends_with(" -o") && !line.starts_with("crate");
        if to_stdout {
            let without = line.strip_suffix(" -o").unwrap();
            assert_eq!(outcome.code, 0, "{line}: {}", outcome.errors);
            assert_eq!(outcome.output, inputs.run(without, &[]).output, "{line}");
            printed += 1;
        } else {
            assert_eq!(
                (outcome.code, outcome.output.as_str()),
                (2, ""),
                "{line}: {}",
                outcome.errors
            );
            refused += 1;
        }
        assert!(!Path::new("-").exists(), "{line}");
    }
    assert!(printed >= 7 && refused >= 3, "{printed} {refused}");
    let shown = complaint(2, &["generate", &robot("planar_2r"), "-o", "-", "--check"], "");
    assert!(shown.contains("name a file"), "{shown}");
}

#[test]
fn advice_is_what_the_command_takes() {
    let inputs = Inputs::new("outputs-advice");
    fs::write(inputs.path("arm.plan"), "my own notes\n").unwrap();
    let shown = inputs.run("search @arm.toml", &[]);
    assert_eq!(shown.code, 1);
    assert!(shown.errors.contains("move it away, or replace it with --force"), "{}", shown.errors);
    assert!(!shown.errors.contains("another name"), "{}", shown.errors);
    if cfg!(target_os = "linux") {
        for force in [&[][..], &["--force"]] {
            let status = ["generate", &robot("planar_2r"), "-o", "/proc/self/status"];
            let shown = complaint(1, &[&status[..], force].concat(), "");
            assert!(shown.contains("a system file") && !shown.contains("--force"), "{shown}");
        }
    }
}

/// Control characters could control a terminal, so names and texts from files are printed without them.
#[test]
fn messages_have_no_control_characters() {
    let folder = folder("outputs-control");
    let name = format!("{}/a\u{1b}[31m\nb\r\u{202e}.toml", folder.to_str().unwrap());
    let is_clean = |shown: &str| {
        let controls = shown.chars().filter(|one| one.is_control() && *one != '\n').count();
        assert_eq!((controls, shown.contains("\nb")), (0, false), "{shown:?}");
    };
    let (arm, out) = (robot("planar_2r"), format!("{name}/out"));
    let module = name.replace(".toml", ".rs");
    for (code, arguments) in [
        (1, &["show", &name][..]),
        (1, &["check", &name]),
        (2, &["diff", &arm, &name]),
        (2, &["compare", &arm, &name]),
        (1, &["eval", &arm, "--function", "bias", "--states", &name]),
        (1, &["generate", &arm, "-o", &module, "--check"]),
        (1, &["crate", &arm, "-o", &name, "--check"]),
        (1, &["prove", &arm, "--rustc", &name]),
        (2, &["stats", &arm, "--function", "a\u{1b}b"]),
    ] {
        let shown = complaint(code, arguments, "");
        assert!(shown.contains("\\u{1b}"), "{arguments:?}: {shown}");
        is_clean(&shown);
    }
    let wrote = run(&["generate", &arm, "-o", &out]);
    assert_eq!(wrote.code, 0, "{}", wrote.errors);
    is_clean(&wrote.errors);
}
