use std::ops::ControlFlow;
use std::path::Path;

use super::*;

fn layout() -> &'static Layout {
    let text = robot_testing::PLANAR_2R;
    let described = robot_model::description::read_toml("planar_2r.toml", text).unwrap();
    Box::leak(Box::new(Layout::of(&described.robot)))
}

#[derive(Default)]
struct Collected {
    states: Vec<State<'static>>,
    errors: Vec<String>,
}

impl Sink<'static> for Collected {
    fn state(&mut self, state: &mut State<'static>) -> ControlFlow<()> {
        self.states.push(state.clone());
        ControlFlow::Continue(())
    }

    fn error(&mut self, message: String) {
        self.errors.push(message);
    }

    fn no_states(&mut self, message: String) {
        *self = Collected { states: vec![], errors: vec![message] };
    }
}

/// Reads states from standard input; also returns whether a wrench was found in it before, if it was searched.
fn read(mut text: &[u8], searched: bool) -> (Collected, bool) {
    let (layout, mut collected) = (layout(), Collected::default());
    let mut input = Input::open(Path::new("-"), &mut text).unwrap();
    let has_wrench = searched && input.has_wrench(layout).unwrap();
    input.read(layout, &mut collected).unwrap();
    (collected, has_wrench)
}

fn states(text: &str) -> Vec<State<'static>> {
    let (Collected { states, errors }, has_wrench) = read(text.as_bytes(), true);
    assert_eq!(errors, [""; 0]);
    assert_eq!(has_wrench, states.iter().any(State::has_wrench));
    assert_eq!(read(text.as_bytes(), false).0.states, states);
    states
}

fn errors(text: &str) -> Vec<String> {
    read(text.as_bytes(), false).0.errors
}

#[test]
fn json_and_csv_give_the_same_states() {
    let json = r#"[{"q": [0.1, -2], "qd": [1e-3, 4], "wrench": [1, 2, 3, 4, 5, 6]},
                   {"qd": [0, 0], "q": [3, 4], "wrench": [0, 0, 0, 0, 0, 0]}]"#;
    let csv = "\u{feff}fx,fy,fz,mx,my,mz,q2, q1,qd1,qd2\r\n1,2,3,4,5,6,-2,0.1,1e-3,4\r\n\r\n\
               0,0,0,0,0,0,4,3,0,0\n";
    let [json, csv] = [json, csv].map(states);
    assert_eq!(json.len(), 2);
    for (json, csv) in json.iter().zip(&csv) {
        for name in ["q", "qd", "wrench"] {
            assert_eq!(json.array(name), csv.array(name));
            assert!(json.array(name).is_some());
        }
        assert_eq!((json.array("qdd"), csv.array("qdd")), (None, None));
    }
    assert_eq!(json[0].array("q"), Some(&[0.1, -2.0][..]));
    assert_eq!(json.iter().map(State::has_wrench).collect::<Vec<_>>(), [true, false]);
    assert_eq!([json[1].place.to_string(), csv[1].place.to_string()], ["state 2", "line 4"]);
}

#[test]
fn everything_that_is_wrong_with_json_is_named() {
    let text = r#"[{"q": [1, "x"], "qd": [1], "qdt": []}, 5, {"q": 3, "qd": [null, 1]}]"#;
    let expected = [
        "state 1: `q` has a string at entry 2, not a number",
        "state 1: `qd` has 1 entry, not 2",
        "state 1: unknown key `qdt`. Did you mean `qd`? Available: q, qd, qdd, tau, wrench.",
        "state 2: expected an object, not a number",
        "state 3: `q` is a number, not an array of 2 numbers",
        "state 3: `qd` has null at entry 1, not a number",
    ];
    assert_eq!(errors(text), expected);
    let twice = r#"[{"q": [1, 2], "q": [3, 4], "qd": [1, {"a": 1, "a": 2}]}]"#;
    let expected = [
        "state 1: `q` is given twice; leave one out",
        "state 1: `qd` has an object at entry 2, not a number",
    ];
    assert_eq!(errors(twice), expected);
    assert!(errors("{}")[0].contains("expected an array of states"));
    assert!(errors("[{")[0].contains("the text ends too early, at line 1, column 2"));
    assert_eq!(errors(" \n"), ["there are no states"]);
    assert_eq!(states("[]"), []);
}

#[test]
fn everything_that_is_wrong_with_csv_is_named() {
    let header = errors("q1,q3,q1\n");
    assert!(header[0].contains("unknown column `q3`. Did you mean `q1`?"), "{header:?}");
    let other = errors("q1,q2,dq1,ddq2\n0,0,0,0\n");
    assert!(other[0].contains("`dq1`. Did you mean `qd1`?"), "{other:?}");
    assert!(other[1].contains("`ddq2`. Did you mean `qdd2`?"), "{other:?}");
    assert_eq!(header[1..], ["`q1` appears twice in the header", "the header lacks q2 of `q`"]);
    // Files that other programs write have a remedy.
    let deg = errors("q1 [deg],q2\n");
    assert!(deg[0].ends_with("fx, fy, fz, mx, my, mz; write the name without a unit, and values in s, rad, m, N m and N: degrees are not converted"), "{deg:?}");
    let time = errors("time,q1,q2\n");
    assert!(
        time[0].ends_with("mz; call the column of times `t`, which is not used, or remove it"),
        "{time:?}"
    );
    let semicolons = "the header has semicolons instead of commas; separate columns with commas, and write decimals with points";
    assert_eq!(errors("q1;q2\n0;1\n"), [semicolons]);
    let found = errors("q1,q2\n1,nan\n1\n2,\n");
    let expected = [
        "line 2: `q2` is `nan`, not a number",
        "line 3: 1 entry, but the header has 2",
        "line 4: `q2` is ``, not a number",
    ];
    assert_eq!(found, expected);
}

/// A source that gives few bytes at a time, as pipes do.
struct Slow<'b> {
    bytes: &'b [u8],
    most: usize,
}

impl std::io::Read for Slow<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let most = self.most.min(buffer.len());
        self.bytes.read(&mut buffer[..most])
    }
}

/// Reads states that come in pieces; returns them with the messages, or the error that ended the reading.
fn read_slowly(bytes: &[u8], most: usize) -> Result<Collected, String> {
    let (layout, mut collected) = (layout(), Collected::default());
    let mut source = Slow { bytes, most };
    let mut input =
        Input::open(Path::new("-"), &mut source).map_err(|error| format!("{error:?}"))?;
    input.read(layout, &mut collected).map_err(|error| format!("{error:?}"))?;
    Ok(collected)
}

/// Characters of two, three and four bytes come in parts.
#[test]
fn a_character_may_come_in_parts() {
    let text = "[\n{\"q\": [1, 2], \"ä€🦾\": 0},\n{\"q\": [3, 4]}]";
    for most in [1, 2, 3, 5, text.len()] {
        let Collected { states, errors } = read_slowly(text.as_bytes(), most).unwrap();
        assert_eq!(errors.len(), 1, "{most}: {errors:?}");
        assert!(errors[0].starts_with("state 1: unknown key `ä€🦾`."), "{most}: {errors:?}");
        assert_eq!(states.last().unwrap().array("q"), Some(&[3.0, 4.0][..]));
    }
}

/// The end of a character that is missing is an error, and so is a byte that starts none.
#[test]
fn what_is_not_text_is_refused_however_it_comes() {
    let start = b"[\n{\"q\": [1, 2]},\n{\"";
    for wrong in [&b"\xc3"[..], b"\xe2\x82", b"\xf0\x9f\xa6", b"\xff", b"\xc3\": [1, 2]}]"] {
        let bytes = [&start[..], wrong].concat();
        for most in [1, 2, 3, bytes.len()] {
            let found = match read_slowly(&bytes, most) {
                Ok(Collected { errors, .. }) => errors.join(" "),
                Err(error) => error,
            };
            let place = format!("from byte {} on", start.len() + 1);
            assert!(found.contains("is not UTF-8"), "{wrong:?}, {most}: {found}");
            assert!(found.contains(&place), "{wrong:?}, {most}: {found}");
        }
    }
}
