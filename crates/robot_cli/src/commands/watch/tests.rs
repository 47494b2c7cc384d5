use std::path::PathBuf;
use std::time::Duration;

use robot_build::{Options, RobotFile, Source, Writer, pin_path, pin_text};
use robot_dynamics::economical::Plan;
use robot_dynamics::economical::plan::LinkPlan;
use robot_dynamics::economical::search::{Measure, search};
use robot_dynamics::mechanism::MechanismOptions;
use tempfile::TempDir;

use super::*;
use crate::reading::ReadingArguments;

const ARM: &str = robot_testing::PLANAR_2R;

fn changed(from: &str, to: &str) -> String {
    assert!(ARM.contains(from), "{from}");
    ARM.replace(from, to)
}

fn heavier() -> String {
    changed("m2 = { value = 3.0", "m2 = { value = 3.5")
}

fn broken() -> String {
    changed("mass = \"m2\"", "mass = \"m3\"")
}

fn reading(text: &str) -> Reading {
    let source = Source { name: "arm.toml".to_owned(), text: text.to_owned() };
    Reading { source: Ok(source), plan: Ok(None) }
}

const SETTINGS: Settings<'_> = Settings {
    snap: None,
    reading: ReadingArguments { allow_massless: false, allow_unphysical: false },
    terms: 20,
    style: Style::Plain,
    clock: None,
};

/// Follows readings; returns whether the watch ended well, and its outputs on both streams.
fn followed(readings: impl IntoIterator<Item = Reading>) -> (bool, String, String) {
    followed_with(readings, None)
}

/// Does the same, with a page.
fn followed_with(
    readings: impl IntoIterator<Item = Reading>,
    page: Option<Page>,
) -> (bool, String, String) {
    let (mut output, mut errors) = (vec![], vec![]);
    let mut terminal = Terminal {
        input: &mut std::io::empty(),
        output: &mut output,
        errors: &mut errors,
        colors: false,
        progress: false,
        screen: None,
    };
    let ended = follow(readings.into_iter(), &SETTINGS, page, &mut terminal);
    let [output, errors] = [output, errors].map(|bytes| String::from_utf8(bytes).unwrap());
    (ended.is_ok(), output, errors)
}

#[test]
fn values_terms_and_operations_are_shown() {
    let still = changed("gravity = [0, \"-g\", 0]", "gravity = [0, 0, 0]");
    let (is_good, output, errors) = followed([ARM, &heavier(), &still].map(reading));
    assert!(is_good);
    let mut parts = output.split("\nsave ");
    assert_eq!(parts.next(), Some("planar_2r: 2 coordinates, 9 parameters; watching\n"));
    let value = "1, from the start:\nrobot files\n~ parameter m2: value 3 -> 3.5\n";
    assert_eq!(parts.next(), Some(value));
    let gravity = parts.next().unwrap();
    for part in [
        "2, from save 1:\nrobot files\n~ robot: gravity (0, -g, 0) -> (0, 0, 0)\n",
        "~ parameter m2: value 3.5 -> 3\n",
        "terms of the joint torques\n  Q1\n  - g*l1*m2*cos(q1)\n",
        "operations per call\n",
        "  inverse_dynamics: ",
    ] {
        assert!(gravity.contains(part), "{part} is not in\n{gravity}");
    }
    assert!(!gravity.contains("differences of the joint torques"), "{gravity}");
    // The parameter g is no longer used.
    assert!(errors.contains("R0601") && !errors.contains("error"), "{errors}");
}

#[test]
fn a_broken_file_keeps_the_last_robot() {
    let moved = format!("# a remark\n\n{}", broken());
    let (is_good, output, errors) = followed([ARM, &broken(), &moved].map(reading));
    assert!(!is_good);
    assert_eq!(
        output
            .matches("the file has errors; the last valid robot, from the start, is kept\n")
            .count(),
        2
    );
    // While the file is invalid, all errors are shown; an error on a line that moved is the same error.
    assert_eq!(errors.matches("error[R0303]").count(), 2, "{errors}");
    assert!(errors.contains("arm.toml:") && !output.contains("gone"), "{output}");

    let (is_good, output, _) = followed([ARM, &broken(), &heavier()].map(reading));
    assert!(is_good);
    let mended = output.split("\nsave 2, from the start:\n").nth(1).unwrap();
    assert!(mended.starts_with("gone: error[R0303]: "), "{mended}");
    assert!(mended.ends_with("~ parameter m2: value 3 -> 3.5\n"), "{mended}");
}

#[test]
fn a_file_that_is_broken_from_the_start_is_waited_for() {
    let (is_good, output, errors) = followed([&broken(), ARM].map(reading));
    assert!(is_good && errors.contains("error[R0303]"));
    assert!(output.starts_with(
        "the file has errors; waiting for a save without errors\n\nsave 1:\ngone: error"
    ));
    assert!(output.ends_with("planar_2r: 2 coordinates, 9 parameters; watching\n"), "{output}");
    assert!(!followed([reading(&broken())]).0);
}

#[test]
fn warnings_come_and_go() {
    let unused = changed("[parameters]", "[parameters]\nspare = { value = 1.0, unit = \"m\" }");
    let readings = [ARM, &unused, &unused.replace("1.0", "2.0"), ARM].map(reading);
    let (_, output, errors) = followed(readings);
    assert_eq!(errors.matches("warning[R0601]").count(), 1, "{errors}");
    assert_eq!(output.matches("gone: warning[R0601]").count(), 1, "{output}");
    assert!(output.contains("\nsave 3, from save 2:\ngone: warning"), "{output}");
}

#[test]
fn remarks_change_nothing() {
    let (_, output, errors) = followed([ARM, &format!("{ARM}# a remark\n")].map(reading));
    assert!(output.ends_with("\nsave 1, from the start:\nno changes in the robot\n"));
    assert_eq!(errors, "");
}

#[test]
fn a_stale_plan_is_not_a_change_of_the_robot() {
    let robot = robot_build::read(reading(ARM).source.as_ref().unwrap()).unwrap().robot;
    let found = search(&robot, &MechanismOptions::ROUNDED, Measure::Operations).unwrap();
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, ARM).unwrap();
    std::fs::write(pin_path(&path), pin_text(&robot, &found)).unwrap();
    let reading = || Files::new(&path, Options::default(), &AtomicBool::new(false)).next().unwrap();
    let pinned = reading();
    assert_eq!(pinned.plan.as_ref().unwrap().as_ref(), Some(&found.plan));
    // A changed value of a parameter does not change the mechanics.
    std::fs::write(&path, heavier()).unwrap();
    assert_eq!(reading().plan, pinned.plan);
    std::fs::write(&path, changed("zz = \"I2\"", "xx = 0.01, zz = \"I2\"")).unwrap();
    let stale = reading();
    assert!(stale.plan.is_err());
    let (is_good, output, errors) = followed([pinned.clone(), stale, pinned]);
    assert!(is_good && !output.contains("operations per call"), "{output}");
    assert!(errors.starts_with("warning: ") && errors.contains("plan is stale"), "{errors}");
    assert!(output.contains("\ngone: warning: "), "{output}");
}

/// Counts are those of the plans if both robots have one or the file is the same, otherwise those of the default plan.
#[test]
fn operations_are_counted_under_the_plans_of_both_or_of_none() {
    const TRTTR1: &str = include_str!("../../../demo/trttr1.toml");
    let links = TRTTR1.matches("[[link]]").count();
    let plan = |links_plan| Some(Plan::uniform(links, links_plan));
    let [basic, usual] = [&LinkPlan::BASIC, &LinkPlan::DEFAULT].map(plan);
    let remarked = format!("{TRTTR1}# a remark\n");
    let reading =
        |text: &str, plan: &Option<Plan>| Reading { plan: Ok(plan.clone()), ..reading(text) };
    for (before, now, differs) in [
        (reading(TRTTR1, &basic), reading(&remarked, &usual), true),
        (reading(TRTTR1, &basic), reading(&remarked, &basic), false),
        (reading(TRTTR1, &basic), reading(&remarked, &None), false),
        (reading(TRTTR1, &None), reading(&remarked, &basic), false),
        (reading(TRTTR1, &None), reading(&remarked, &None), false),
        (reading(TRTTR1, &basic), reading(TRTTR1, &usual), true),
        (reading(TRTTR1, &basic), reading(TRTTR1, &None), true),
    ] {
        let case = [&before, &now]
            .map(|reading| format!("{:?}", reading.plan.as_ref().map(Option::is_some)));
        let (_, output, errors) = followed([before, now]);
        assert_eq!(errors, "");
        assert_eq!(output.contains("operations per call\n"), differs, "{case:?}: {output}");
        assert_eq!(output.ends_with("no changes in the robot\n"), !differs, "{output}");
    }
}

/// A watched file; the test fails if an expected change does not occur within a minute.
struct Watched {
    folder: TempDir,
    path: PathBuf,
}

impl Watched {
    fn new() -> Watched {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join("arm.toml");
        std::fs::write(&path, ARM).unwrap();
        Watched { folder, path }
    }

    /// Replaces the file with another one, as editors do.
    fn replace(&self, text: &str) {
        let other = self.folder.path().join("arm.toml~");
        std::fs::write(&other, text).unwrap();
        std::fs::rename(other, &self.path).unwrap();
    }
}

fn text(reading: Option<Reading>) -> Option<String> {
    reading.unwrap().source.ok().map(|source| source.text)
}

#[test]
fn saves_are_seen_however_editors_save() {
    let watched = Watched::new();
    let over = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let (done, ended) = std::sync::mpsc::channel::<()>();
        let over = &over;
        scope.spawn(move || {
            if ended.recv_timeout(Duration::from_secs(60)).is_err() {
                over.store(true, Ordering::Relaxed);
            }
        });
        let mut files = Files::new(&watched.path, Options::default(), over);
        assert_eq!(text(files.next()).as_deref(), Some(ARM));
        // The file is written in place with the same number of bytes, then replaced with another file, several times.
        for _ in 0..3 {
            std::fs::write(&watched.path, heavier()).unwrap();
            assert_eq!(text(files.next()), Some(heavier()));
            watched.replace(ARM);
            assert_eq!(text(files.next()).as_deref(), Some(ARM));
        }
        watched.replace(&broken());
        assert_eq!(text(files.next()), Some(broken()));
        std::fs::remove_file(&watched.path).unwrap();
        let away = files.next().unwrap().source.unwrap_err().to_string();
        assert!(away.contains("there is no such file"), "{away}");
        // Bytes that are not text do not end the watch either.
        std::fs::write(&watched.path, b"\xff\xfe").unwrap();
        assert!(files.next().unwrap().source.is_err());
        std::fs::write(&watched.path, ARM).unwrap();
        assert_eq!(text(files.next()).as_deref(), Some(ARM));
        over.store(true, Ordering::Relaxed);
        assert_eq!(files.next(), None);
        done.send(()).unwrap();
    });
}

#[test]
fn a_save_in_pieces_is_seen_whole() {
    let away = RobotFile::read(std::path::Path::new("none.toml")).unwrap_err();
    let away = || Reading { source: Err(away.clone()), plan: Ok(None) };
    let mut settling = files::Settling::default();
    let mut shown =
        |reading: Reading| text(Some(settling.after(reading)?)).or(Some("away".to_owned()));
    assert_eq!((shown(reading(ARM)), shown(reading(ARM)).as_deref()), (None, Some(ARM)));
    // The file is unchanged, then empty, missing, incomplete and complete.
    let half = ARM.get(..ARM.len() / 2).unwrap();
    for piece in
        [reading(ARM), reading(""), reading(""), away(), away(), reading(half), reading(&heavier())]
    {
        assert_eq!(shown(piece), None);
    }
    assert_eq!(shown(reading(&heavier())), Some(heavier()));
    // A file that stays missing is reported once.
    let messages: Vec<String> = (0..100).filter_map(|_| shown(away())).collect();
    assert_eq!(messages, ["away"]);
    // A return to the content that was shown last is not new.
    assert_eq!((shown(reading(ARM)), shown(away()), shown(reading(ARM))), (None, None, None));
    assert_eq!(shown(reading(ARM)).as_deref(), Some(ARM));
}

/// A folder, the path of a page in it, and that of its picture.
fn page_in_folder() -> (TempDir, PathBuf, PathBuf) {
    let folder = TempDir::new().unwrap();
    let [page, picture] = ["arm.html", "arm.html.svg"].map(|name| folder.path().join(name));
    (folder, page, picture)
}

#[test]
fn the_end_removes_the_own_picture_alone() {
    let (_folder, path, picture) = page_in_folder();
    let end = |before: &dyn Fn()| {
        let page = Page::open(path.clone(), Writer::new().force(true)).unwrap();
        let readings = std::iter::once(reading(ARM)).chain(std::iter::from_fn(|| {
            before();
            None
        }));
        followed_with(readings, Some(page))
    };
    assert!(end(&|| assert!(picture.exists())).0 && !picture.exists());
    // It is not an error if the picture was removed, for example by another watch of the same page.
    let (is_good, _, errors) = end(&|| std::fs::remove_file(&picture).unwrap());
    assert!(is_good && errors.is_empty(), "{errors}");
    // A file that has replaced the picture stays.
    assert!(end(&|| std::fs::write(&picture, "a drawing").unwrap()).0);
    assert_eq!(std::fs::read_to_string(&picture).unwrap(), "a drawing");
    // The picture is removed even if the page cannot be written.
    let (is_good, ..) = end(&|| {
        std::fs::remove_file(&path).unwrap();
        std::fs::create_dir(&path).unwrap();
    });
    assert!(!is_good && !picture.exists());
}

/// The page that remains after a watch is sealed like that of `report`, so a page that was edited is not replaced.
#[test]
fn an_edited_page_stays() {
    let (_folder, path, _) = page_in_folder();
    let open = || Page::open(path.clone(), Writer::new());
    for _ in 0..2 {
        assert!(followed_with([reading(ARM)], Some(open().unwrap())).0);
    }
    let edited = std::fs::read_to_string(&path).unwrap().replacen("<body", "<body ", 1);
    std::fs::write(&path, &edited).unwrap();
    assert!(open().is_err());
    assert_eq!(std::fs::read_to_string(&path).unwrap(), edited);
}

/// A generated module is not an earlier page.
#[test]
fn a_file_of_another_kind_is_not_a_page() {
    let (_folder, path, _) = page_in_folder();
    let code = path.with_extension("rs");
    std::fs::write(&code, format!("// {}\n", robot_build::MARKER)).unwrap();
    assert!(Page::open(path, Writer::new()).is_ok());
    assert!(Page::open(code, Writer::new()).is_err());
}

/// A page that is edited during the watch is not replaced at its end, either.
#[test]
fn a_page_that_is_edited_meanwhile_stays() {
    let (_folder, path, picture) = page_in_folder();
    let edited = || std::fs::read_to_string(&path).unwrap().replacen("<body", "<body ", 1);
    let readings = std::iter::once(reading(ARM)).chain(std::iter::from_fn(|| {
        std::fs::write(&path, edited()).unwrap();
        None
    }));
    let (is_good, _, errors) =
        followed_with(readings, Some(Page::open(path.clone(), Writer::new()).unwrap()));
    assert!(!is_good, "{errors}");
    assert!(std::fs::read_to_string(&path).unwrap().contains("<body ") && !picture.exists());
}

#[test]
fn a_long_robot_has_a_page_too() {
    let (_folder, path, picture) = page_in_folder();
    let link = |number| {
        format!(
            "[[link]]\nname = \"more{number}\"\njoint = {{ type = \"prismatic\", axis = \"x\" }}\n\
             mass = {number}\ncenter_of_mass = [0, 0, 0]\ninertia = {{ xx = 0, yy = 0, zz = 0 }}\n"
        )
    };
    let long = ARM.to_owned() + &(1..=24).map(link).collect::<String>();
    let page = Page::open(path.clone(), Writer::new()).unwrap();
    let (is_good, _, errors) = followed_with([reading(ARM), reading(&long)], Some(page));
    assert!(is_good, "{errors}");
    let last = std::fs::read_to_string(&path).unwrap();
    assert!(last.contains("the robot has 26 coordinates") && !picture.exists());
}

#[test]
fn a_pin_is_read_with_what_is_taken_of_the_file() {
    let light = changed(
        "mass = \"m2\"\ncenter_of_mass = [\"r2\", 0, 0]\ninertia = { zz = \"I2\", unchecked = true }",
        "mass = \"m2\"\ncenter_of_mass = [\"r2\", 0, 0]\ninertia = { xx = 1, yy = 1, zz = 9 }",
    );
    let options = Options { allow_unphysical: true, ..Options::default() };
    let source = reading(&light).source.unwrap();
    let robot = robot_build::read_with(&source, &options).unwrap().robot;
    let found = search(&robot, &MechanismOptions::ROUNDED, Measure::Operations).unwrap();
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, &light).unwrap();
    std::fs::write(pin_path(&path), pin_text(&robot, &found)).unwrap();
    let over = AtomicBool::new(false);
    let plan = |options| Files::new(&path, options, &over).next().unwrap().plan;
    assert_eq!(plan(options).unwrap(), Some(found.plan));
    assert!(plan(Options::default()).is_err());
}

#[test]
fn a_problem_that_is_gone_is_a_line() {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("arm.toml");
    std::fs::write(&path, ARM).unwrap();
    std::fs::write(pin_path(&path), "no plan").unwrap();
    let over = AtomicBool::new(false);
    let reading = || Files::new(&path, Options::default(), &over).next().unwrap();
    let bad = reading();
    std::fs::remove_file(pin_path(&path)).unwrap();
    let (_, output, errors) = followed([bad, reading()]);
    assert!(errors.contains("line 1 is not that of a plan"), "{errors}");
    let end = output.split("gone: ").nth(1).unwrap();
    assert_eq!(end.lines().nth(1), Some("no changes in the robot"), "{end}");
}
