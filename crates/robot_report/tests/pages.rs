//! Pages about the project's robots and about hostile files.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::collections::{BTreeMap, BTreeSet};
use std::sync::{Mutex, OnceLock};

use robot_build::{Options, Programs, Source};
use robot_report::{Accuracy, Compiled, Input, reloading, report};
use roxmltree::{Document, Node, ParsingOptions};

fn page(name: &str, text: &str) -> String {
    page_with(name, text, true)
}

fn page_with(name: &str, text: &str, live: bool) -> String {
    let source = Source { name: name.to_owned(), text: text.to_owned() };
    let compiled = Compiled::Unread { reason: "a test.".to_owned() };
    let input = Input {
        source: &source,
        options: &Options::default(),
        snap: 1e-5,
        compiled: &compiled,
        compare,
        live,
    };
    report(&input).unwrap()
}

fn text_of(robot: &str) -> String {
    let path = format!("{}/../../robots/{robot}.toml", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(path).unwrap()
}

/// The page of a robot of the project, which all tests share: that of an arm with seven joints takes seconds.
fn page_of(robot: &str) -> &'static str {
    static PAGES: Mutex<BTreeMap<String, &OnceLock<String>>> = Mutex::new(BTreeMap::new());
    let new = || Box::leak(Box::default());
    let own = *PAGES.lock().unwrap().entry(robot.to_owned()).or_insert_with(|| new());
    own.get_or_init(|| page(&format!("{robot}.toml"), &text_of(robot)))
}

fn parsed(page: &str) -> Document<'_> {
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    Document::parse_with_options(page, options).unwrap()
}

fn words<'a>(document: &'a Document<'a>, attribute: &'a str) -> impl Iterator<Item = &'a str> {
    let nodes = document.descendants().filter_map(move |node| node.attribute(attribute));
    nodes.flat_map(str::split_whitespace)
}

/// A planar chain with this many joints.
fn chain(joints: usize) -> String {
    let link = |number: usize| {
        format!(
            "[[link]]\nname = \"{number}\"\njoint = {{ type = \"revolute\", axis = \"z\" }}\n\
             origin = {{ xyz = [0.1, 0, 0] }}\nmass = 1\ncenter_of_mass = [0.1, 0, 0]\n\
             inertia = {{ xx = 1, yy = 1, zz = 1 }}\n"
        )
    };
    let links: String = (1..=joints).map(link).collect();
    format!("format = 1\n[robot]\nname = \"chain\"\n{links}")
}

fn compare(programs: &Programs) -> Result<Accuracy, String> {
    let worst = robot_check::accuracy::worst(programs)?;
    let worst = worst.into_iter().map(|(function, error)| (function.to_owned(), error)).collect();
    Ok(Accuracy { states: robot_check::accuracy::states(), worst })
}

/// The elements that a browser creates when it loads a page; the content of `noscript` is text for it.
fn loaded<'a>(document: &'a Document<'a>) -> impl Iterator<Item = Node<'a, 'a>> {
    let is_folded = |node: &Node<'_, '_>| {
        node.ancestors().skip(1).any(|ancestor| ancestor.has_tag_name("noscript"))
    };
    document.descendants().filter(Node::is_element).filter(move |node| !is_folded(node))
}

#[test]
fn robots_of_any_size_have_a_page_without_the_long_forms() {
    let page = page("chain.toml", &chain(26));
    let document = parsed(&page);
    let notes = document.descendants().filter(|node| node.attribute("class") == Some("note"));
    let refused =
        notes.filter_map(|node| node.text()).filter(|note| note.contains("26 coordinates"));
    assert_eq!(refused.count(), 4);
    let ids: BTreeSet<&str> = words(&document, "id").collect();
    for part in ["scheme-link-26", "structure", "motion", "costs", "compact-Q26"] {
        assert!(ids.contains(part), "{part}");
    }
}

/// The most joints that a robot file may have.
#[test]
fn sixty_four_joints_have_a_page_that_says_what_it_leaves_out() {
    let page = page("chain.toml", &chain(64));
    let document = parsed(&page);
    let ids: BTreeSet<&str> = words(&document, "id").collect();
    for part in ["scheme-link-64", "structure", "motion", "costs"] {
        assert!(ids.contains(part), "{part}");
    }
    let count = loaded(&document).count();
    assert!(count < 25_000, "{count}");
    let notes = document.descendants().filter(|node| node.attribute("class") == Some("note"));
    let notes: Vec<&str> = notes.filter_map(|node| node.text()).collect();
    let refused = notes.iter().filter(|note| note.contains("64 coordinates"));
    assert_eq!(refused.count(), 4, "{notes:?}");
    assert!(notes.iter().any(|note| note.contains("cannot be moved")), "{notes:?}");
}

#[test]
fn pages_of_long_arms_load_few_elements_and_one_open_form() {
    for (robot, form, most, math) in [
        ("planar_2r", "grouped", 2_000, 60),
        ("trttr1", "collected", 4_000, 120),
        ("panda", "compact", 12_000, 1_500),
        ("iiwa", "compact", 12_000, 1_500),
    ] {
        let page = page_of(robot);
        let document = parsed(page);
        let count = loaded(&document).count();
        assert!(count < most, "{robot}: {count}");
        let formulas = loaded(&document).filter(|node| node.has_tag_name("math")).count();
        assert!(formulas < math, "{robot}: {formulas} formulas");
        // A browser takes the content of `noscript` up to its end tag, so these elements must not be nested.
        for folded in document.descendants().filter(|node| node.has_tag_name("noscript")) {
            let mut inside = folded.descendants().skip(1);
            assert!(!inside.any(|one| one.has_tag_name("noscript") || one.has_tag_name("script")));
            assert!(folded.parent().is_some_and(|parent| parent.has_tag_name("details")));
        }
        let open = document.descendants().filter(|node| node.attribute("open").is_some());
        let [open] = open.collect::<Vec<_>>()[..] else { panic!("{robot}: not one open form") };
        let first = format!("{form}-Q{}", if form == "grouped" { "" } else { "1" });
        let mut shown = loaded(&document).filter(|node| node.attribute("id") == Some(&first));
        assert!(shown.any(|node| node.ancestors().any(|node| node == open)), "{robot}");
        let forms = open.parent().unwrap().children().filter(|node| node.has_tag_name("details"));
        assert_eq!(forms.map(|form| form.id()).next(), Some(open.id()), "{robot}");
    }
}

#[test]
fn equations_have_their_source_in_other_notations() {
    let page = page_of("trttr1");
    let document = parsed(page);
    let equations: Vec<_> =
        document.descendants().filter(|node| node.attribute("data-terms").is_some()).collect();
    assert!(equations.len() > 100, "{}", equations.len());
    let ids: BTreeSet<&str> = words(&document, "id").collect();
    for equation in equations {
        assert!(equation.attribute("id").is_some_and(|id| ids.contains(id)));
        let latex = equation.attribute("data-latex").unwrap();
        assert!(robot_document::latex::read(latex).is_ok(), "{latex}");
        assert!(equation.attribute("data-typst").unwrap().contains(" = "));
        let stops = equation.descendants().filter(|node| node.attribute("tabindex") == Some("0"));
        assert_eq!(stops.count(), 1, "one stop of the tabulator: {latex}");
    }
    let source = |id: &str| {
        let found = document.descendants().find(|node| node.attribute("id") == Some(id));
        found.unwrap().attribute("data-latex").unwrap()
    };
    assert_eq!(source("grouped-g"), {
        r"g\left(q\right) = \begin{bmatrix} 0 \\ 0 \\ g \left(M_3 + M_4 + M_5\right) \\ 0 \\ 0 \end{bmatrix}"
    });
    let torques =
        r"Q = H\left(q\right) \ddot{q} + n\left(q, \dot{q}\right) + g\left(q\right) + w + Q_f";
    assert_eq!(source("grouped-Q").replace(' ', ""), torques.replace(' ', ""));
}

#[test]
fn pages_are_whole() {
    for robot in ["trttr1", "puma560", "panda", "planar_2r"] {
        let page = page_of(robot);
        let document = parsed(page);
        let listed: Vec<&str> = words(&document, "id").collect();
        let ids: BTreeSet<&str> = listed.iter().copied().collect();
        assert_eq!(listed.len(), ids.len(), "{robot}: an id occurs twice");
        let parts = "kinematics masses parameters equations structure motion costs evidence";
        for part in parts.split_whitespace() {
            assert!(ids.contains(part), "{robot}: {part}");
        }
        let anchors = words(&document, "href").map(|anchor| anchor.strip_prefix('#').unwrap());
        for id in anchors.chain(words(&document, "aria-labelledby")) {
            assert!(ids.contains(id), "{robot}: there is no {id}");
        }
        // Everything that terms depend on is shown somewhere.
        let shown: BTreeSet<&str> = words(&document, "data-is").collect();
        for token in words(&document, "data-of") {
            assert!(shown.contains(token), "{robot}: {token} is nowhere");
        }
    }
}

#[test]
fn tables_have_headings_and_drawings_have_names() {
    let page = page_of("trttr1");
    let document = parsed(page);
    let named = |name: &'static str| {
        document.descendants().filter(move |node| node.tag_name().name() == name)
    };
    let has = |node: Node<'_, '_>, name: &str| {
        node.children().any(|child| child.tag_name().name() == name)
    };
    assert!(named("table").count() >= 7);
    assert!(named("table").all(|table| has(table, "caption")));
    assert!(named("th").all(|heading| heading.attribute("scope").is_some()));
    assert!(named("svg").count() >= 1);
    assert!(named("svg").all(|drawing| has(drawing, "title") && has(drawing, "desc")));
    // Each link is an element to which terms can refer.
    for number in 1..=5 {
        let id = format!("scheme-link-{number}");
        assert!(document.descendants().any(|node| node.attribute("id") == Some(&id)));
    }
}

/// Without scripts there is no search; with them, its field has a name and its count is read out.
#[test]
fn the_search_field_is_hidden_until_the_script_shows_it() {
    let page = page_of("planar_2r");
    let document = parsed(page);
    let with_role = |role: &'static str| {
        document.descendants().filter(move |node| node.attribute("role") == Some(role))
    };
    let [search] = with_role("search").collect::<Vec<_>>()[..] else { panic!("not one search") };
    assert_eq!(search.attribute("hidden"), Some("hidden"));
    let named =
        |name: &'static str| search.descendants().filter(move |node| node.has_tag_name(name));
    assert_eq!((named("input").count(), named("button").count()), (1, 2));
    assert!(named("input").chain(named("button")).all(|one| one.attribute("aria-label").is_some()));
    assert!(with_role("status").any(|count| count.parent() == Some(search)));
    assert!(search.ancestors().any(|node| node.has_tag_name("nav")), "nav is not printed");
}

/// One sentence says what a call costs; the tables about it are folded.
#[test]
fn the_tables_of_operations_are_folded() {
    let page = page_of("trttr1");
    let document = parsed(page);
    let costs = document.descendants().find(|node| node.attribute("id") == Some("costs")).unwrap();
    let tables: Vec<_> = costs.descendants().filter(|node| node.has_tag_name("table")).collect();
    assert_eq!(tables.len(), 3);
    let is_shown = |table: &Node<'_, '_>| loaded(&document).any(|node| node == *table);
    assert!(!tables.iter().any(is_shown));
    let summary = costs.children().find(|node| node.has_tag_name("p")).unwrap();
    let texts = summary.descendants().filter(Node::is_text).filter_map(|node| node.text());
    let words: String = texts.collect();
    // The same numbers are in the row of the function.
    let rows = tables.iter().flat_map(Node::descendants).filter(|node| node.has_tag_name("tr"));
    let mut rows = rows.map(|row| {
        let texts = row.descendants().filter(Node::is_text);
        texts.filter_map(|node| node.text()).collect::<Vec<_>>()
    });
    let row = rows.find(|row| row.first() == Some(&"inverse_dynamics")).unwrap();
    let numbers: Vec<&str> = row.into_iter().filter(|text| text.parse::<usize>().is_ok()).collect();
    let takes = format!("takes {} multiplications, {} additions", numbers[0], numbers[1]);
    assert!(words.starts_with(&format!("A call of inverse_dynamics {takes}")), "{words}");
}

/// On phones, each value of a wide table follows the name of its column.
#[test]
fn values_of_wide_tables_have_the_names_of_their_columns() {
    let page = page_of("trttr1");
    let document = parsed(page);
    let stacked = document.descendants().filter(|node| node.attribute("class") == Some("stacked"));
    let stacked: Vec<_> = stacked.collect();
    assert_eq!(stacked.len(), 5);
    for table in stacked {
        let named =
            |name: &'static str| table.descendants().filter(move |node| node.has_tag_name(name));
        let columns: Vec<_> = named("thead")
            .flat_map(|head| head.descendants())
            .filter(|node| node.has_tag_name("th"))
            .map(|column| column.text())
            .skip(1)
            .collect();
        let rows = named("tbody").flat_map(|body| body.children());
        for row in rows.filter(|node| node.has_tag_name("tr")) {
            let cells = row.children().filter(|node| node.has_tag_name("td"));
            let names: Vec<_> = cells.map(|cell| cell.attribute("data-name")).collect();
            assert_eq!(names, columns);
        }
    }
}

/// The terms of an equation of a page, given by the tokens that they refer to.
fn terms(page: &str, equation: &str) -> Vec<String> {
    let document = parsed(page);
    let defines = |node: &Node<'_, '_>| {
        node.attribute("data-terms").is_some() && node.attribute("data-is") == Some(equation)
    };
    let found = document.descendants().find(defines).unwrap();
    let terms = found.descendants().filter_map(|node| node.attribute("data-of"));
    terms.map(str::to_owned).collect()
}

#[test]
fn terms_point_at_what_they_come_from() {
    let page = page_of("trttr1");
    // Each entry of a matrix is a term. H33 = M3 + M4 + M5 depends on three masses, each with its own link.
    let masses = [3, 4, 5].map(|number| format!("parameter-M{number} link-{number}")).join(" ");
    assert!(terms(page, "grouped-H").contains(&masses));
    // The joint torques refer to the matrix and the columns whose sum they are.
    let parts = ["H", "n", "g", "w", "Q-f"].map(|name| format!("grouped-{name}"));
    assert_eq!(terms(page, "grouped-Q"), parts);
    // A component of a vector refers to its column, and a coordinate to its link.
    let forces = terms(page, "recursive-Q3");
    assert!(forces.contains(&"recursive-F-l3".to_owned()), "{forces:?}");
    // In M3 (g + q̈3) + MR4 (g + q̈3), a base parameter refers to its definition.
    let regrouped = terms(page, "regrouped-Q3");
    assert!(regrouped.iter().any(|term| term.starts_with("regrouped-MR-4")), "{regrouped:?}");
    // The weight in the expanded form is M3 g: gravity does not belong to a link.
    assert!(terms(page, "expanded-Q3").contains(&"parameter-M3 link-3 parameter-g".to_owned()));
}

#[test]
fn forms_that_are_too_long_say_so() {
    let page = page_of("panda");
    let document = parsed(page);
    let notes = document.descendants().filter(|node| node.attribute("class") == Some("note"));
    let notes: Vec<&str> = notes.filter_map(|node| node.text()).collect();
    assert!(notes.iter().any(|note| note.starts_with("This form is not shown")), "{notes:?}");
    assert!(page.len() < 3_000_000 && page.contains("<math>"));
}

#[test]
fn the_same_file_gives_the_same_page() {
    assert_eq!(page("scara.toml", &text_of("scara")), page_of("scara"));
}

/// The page with the moving robot is the page without it and a hidden section, which adds at most 80 kB.
#[test]
fn robots_move_in_pages_that_stay_short() {
    for robot in ["trttr1", "puma560", "panda", "planar_2r"] {
        let still = page_with(&format!("{robot}.toml"), &text_of(robot), false);
        let moving = page_of(robot);
        assert!(moving.len() - still.len() <= 80_000, "{robot}: {}", moving.len() - still.len());
        assert!(!still.contains("wasm") && !still.contains("data-live"), "{robot}");
        let document = parsed(moving);
        let parts: Vec<_> =
            document.descendants().filter(|node| node.attribute("data-live").is_some()).collect();
        assert!(parts.len() == 2 && parts.iter().all(|part| part.attribute("hidden").is_some()));
        let live = parts.iter().find(|part| part.attribute("id") == Some("live")).unwrap();
        assert!(live.attribute("data-module").unwrap().starts_with("AGFzbQ"), "{robot}");
        let described: serde_json::Value =
            serde_json::from_str(live.attribute("data-robot").unwrap()).unwrap();
        let sliders = live.descendants().filter(|node| node.attribute("data-state").is_some());
        let coordinates = described["coordinates"].as_array().unwrap().len();
        assert_eq!(sliders.count(), 3 * coordinates, "{robot}");
        // Bars of one unit have one scale; the script takes the unit of a row from the data.
        let described: Vec<_> = described["coordinates"].as_array().unwrap().iter().collect();
        let rows = live.descendants().filter(|node| node.attribute("class") == Some("torques"));
        let rows = rows.flat_map(|table| table.descendants());
        let rows: Vec<_> = rows.filter(|node| node.attribute("scope") == Some("row")).collect();
        assert_eq!(rows.len(), described.len(), "{robot}");
        for (row, coordinate) in rows.iter().zip(described) {
            let unit = coordinate["unit"].as_str().unwrap();
            assert!(row.text().unwrap().ends_with(&format!(", {unit}")), "{robot}: {unit}");
        }
        let scales = live.descendants().filter(|node| node.attribute("class") == Some("scale"));
        assert_eq!(scales.count(), 1, "{robot}");
    }
}

#[test]
fn the_payload_has_sliders_for_its_mass_and_center() {
    let text = chain(2) + "[payload]\nparent = \"2\"\n";
    let page = page("chain.toml", &text);
    let document = parsed(&page);
    let sliders = document.descendants().filter(|node| node.attribute("data-parameter").is_some());
    let sliders: Vec<_> = sliders.map(|slider| slider.attribute("aria-label").unwrap()).collect();
    assert_eq!(
        sliders,
        ["mass, kg", "center of mass x, m", "center of mass y, m", "center of mass z, m"]
    );
}

#[test]
fn pages_say_why_a_robot_cannot_be_moved() {
    let nameless = chain(2).replace("mass = 1\n", "mass = \"m\"\n");
    let nameless = nameless.replace("[robot]", "[parameters]\nm = { unit = \"kg\" }\n[robot]");
    for (text, reason) in [
        (nameless, "the file has no value for m; give it a `value`."),
        (chain(26), "the limit is 80 kB."),
    ] {
        let page = page("chain.toml", &text);
        assert!(page.contains("This robot cannot be moved on the page: ") && page.contains(reason));
        assert!(!page.contains("wasm-unsafe-eval") && !page.contains("data-live"));
    }
}

/// Text that would be markup or a script without escaping.
const HOSTILE: &str =
    r#"</script><script>document.title=1</script>"><img src=x onerror=alert(1)>&lt;'"#;

fn hostile(place: &str) -> String {
    let text = |here: &str| match here == place {
        true => HOSTILE.replace('"', "\\\""),
        false => "plain".to_owned(),
    };
    format!(
        "format = 1\n[robot]\nname = \"swing\"\ndescription = \"{}\"\ngravity = [0, 0, \"-g\"]\n\
         [parameters]\ng = {{ value = 9.81, unit = \"m/s^2\", doc = \"{}\" }}\n\
         [[link]]\nname = \"{}\"\njoint = {{ type = \"revolute\", axis = \"y\" }}\nmass = 1\n\
         center_of_mass = [0, 0, -1]\ninertia = {{ xx = 1, yy = 1, zz = 1 }}\n",
        text("description"),
        text("doc"),
        text("link")
    )
}

#[test]
fn hostile_text_is_text() {
    for place in ["description", "doc"] {
        let page = page("swing.toml", &hostile(place));
        let document = parsed(&page);
        let found = document.descendants().filter(|node| node.text() == Some(HOSTILE));
        assert!(found.count() > 0, "{place}");
        let elements = |name: &str| {
            document.descendants().filter(|node| node.tag_name().name() == name).count()
        };
        assert_eq!((elements("script"), elements("img")), (2, 0), "{place}");
    }
}

#[test]
fn hostile_names_are_errors() {
    let turned = hostile("").replace("plain", "\u{202e}plain");
    for (text, reason) in [(hostile("link"), "cannot be the name of"), (turned, "U+202E")] {
        let source = Source { name: "swing.toml".to_owned(), text };
        let compiled = Compiled::Unread { reason: String::new() };
        let input = Input {
            source: &source,
            options: &Options::default(),
            snap: 1e-5,
            compiled: &compiled,
            compare,
            live: true,
        };
        let message = report(&input).unwrap_err().to_string();
        assert!(message.contains(reason), "{message}");
    }
}

/// The policy names the page's own script, styles and font, and a browser uses nothing else.
#[test]
fn the_policy_allows_nothing_from_elsewhere() {
    let page = page_of("planar_2r");
    let document = parsed(page);
    let policy = document
        .descendants()
        .find(|node| node.attribute("http-equiv") == Some("Content-Security-Policy"))
        .and_then(|node| node.attribute("content"))
        .unwrap();
    assert!(policy.starts_with("default-src 'none'; style-src 'sha256-"), "{policy}");
    assert!(policy.contains("; font-src data:; script-src "), "{policy}");
    assert!(page.contains("url(data:font/woff2;base64,"));
    let policy = policy.replace(" 'wasm-unsafe-eval'", "");
    assert!(!policy.contains("unsafe") && !policy.contains("http"), "{policy}");
    // Nothing is in a place where the policy would refuse it.
    for attribute in ["style", "src", "onclick", "onload"] {
        assert_eq!(words(&document, attribute).count(), 0);
    }
}

/// A page that reloads itself only has one more script, and its policy also names that script and pictures.
#[test]
fn a_page_that_reloads_itself_is_the_same_page() {
    let text = include_str!("../../../robots/planar_2r.toml");
    let of = |text: &str| {
        let source = Source { name: "planar_2r.toml".to_owned(), text: text.to_owned() };
        let compiled = Compiled::Unread { reason: "a test.".to_owned() };
        let options = Options::default();
        reloading(&Input {
            source: &source,
            options: &options,
            snap: 1e-5,
            compiled: &compiled,
            compare,
            live: false,
        })
        .unwrap()
    };
    let found = of(text);
    assert_eq!(found.still, page_with("planar_2r.toml", text, false));
    assert!(!found.still.contains("img-src") && !found.still.contains("data-page"));
    let document = parsed(&found.page);
    let scripts = document.descendants().filter(|node| node.tag_name().name() == "script");
    assert_eq!(scripts.count(), 2);
    let policy = words(&document, "content").filter(|word| word.starts_with("'sha256-"));
    assert_eq!(policy.count(), 4);
    assert!(found.page.contains("; img-src 'self' file:;"));
    // The page's own stamp is the size of the picture beside it.
    let own = document.root_element().attribute("data-page").unwrap();
    let picture = parsed(&found.stamp);
    let side = |name| picture.root_element().attribute(name).unwrap();
    assert_eq!(own, format!("{} {}", side("width"), side("height")));
    assert_ne!(of(&text.replace("value = 3.0", "value = 3.5")).stamp, found.stamp);
}
