//! The places of tables, equations and titles on the pages of documents.
#![allow(clippy::unwrap_used, clippy::panic, reason = "a test that fails panics")]

use std::path::Path;

use robot_document::document::{Block, Document, Inline, NumberedEquation, Table};
use robot_document::figure::Figure;
use robot_document::forms::Equation;
use robot_document::latex::{Layout, Page, read};
use robot_document::{EquationOptions, Form, latex, robot, typst};
use robot_model::description::read_toml;

fn described(name: &str) -> Document {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(root.join(format!("../../robots/{name}.toml"))).unwrap();
    let model = read_toml(name, &text).unwrap().robot;
    robot::document(&model, &EquationOptions::default(), &[Form::Grouped], Default::default())
        .unwrap()
}

/// The place of a text that occurs once.
fn place(source: &str, text: &str) -> usize {
    assert_eq!(source.matches(text).count(), 1, "{text}");
    source.find(text).unwrap()
}

#[test]
fn wide_tables_stand_at_the_top_of_the_first_page() {
    let document = described("trttr1");
    let [latex, typst] = [
        latex::document(&document, Page::with_columns(2)).unwrap(),
        typst::document(&document, Page::with_columns(2)).unwrap(),
    ];
    let top = place(&latex, "\\twocolumn[{");
    assert!(!latex.contains("table*"));
    assert!((top..place(&latex, "\\section{The robot}")).contains(&place(&latex, "Table 1.")));
    assert!(place(&latex, "\\section{The robot}") < place(&latex, "Table 2."));
    assert!(!typst.contains("place(bottom"));
    assert!(place(&typst, "*Table 1.*") < place(&typst, "[The robot]"));
    let one = latex::document(&document, Page::with_columns(1)).unwrap();
    assert!(place(&one, "\\section{The robot}") < place(&one, "Table 1."));
}

/// The heading, the paragraphs and the table of a check value.
#[test]
fn text_between_a_heading_and_a_table_stays_on_the_page_of_the_table() {
    let text = |text: &str| Block::Paragraph(vec![Inline::text(text)]);
    let cells = || vec![vec![Inline::text("cell")]];
    let table =
        Table { caption: "Values.".to_owned(), head: cells(), rows: vec![cells()], keys: 1 };
    let heading = |title: &str| Block::Heading(1, title.to_owned());
    let blocks = vec![
        heading("Check"),
        text("first"),
        text("second"),
        Block::Table(table),
        text("third"),
        heading("Other"),
        text("fourth"),
    ];
    let document = Document { title: String::new(), blocks };
    let page = Page::with_columns(1);
    let latex = latex::document(&document, page).unwrap();
    let typst = typst::document(&document, page).unwrap();
    for (word, is_kept) in [("first", true), ("second", true), ("third", false), ("fourth", false)]
    {
        assert_eq!(latex.contains(&format!("{word}\\par}}\\nobreak")), is_kept, "{latex}");
        let block = format!("#block(sticky: true, breakable: false)[{word}]");
        assert_eq!(typst.contains(&block), is_kept, "{typst}");
    }
}

#[test]
fn a_figure_that_is_too_high_below_wide_tables_floats() {
    let cells = || vec![vec![Inline::text("onelongword")]; 8];
    let rows = |count| (0..count).map(|_| cells()).collect();
    let floats = |count: usize| {
        let table =
            Table { caption: "Wide.".to_owned(), head: cells(), rows: rows(count), keys: 1 };
        let figure =
            Figure { caption: String::new(), bounds: [[0.0; 2], [200.0, 700.0]], shapes: vec![] };
        let blocks =
            vec![Block::Heading(1, "Robot".to_owned()), Block::Figure(figure), Block::Table(table)];
        let document = Document { title: String::new(), blocks };
        let page = Page::with_columns(2);
        let latex = latex::document(&document, page).unwrap();
        assert!(latex.contains("\\twocolumn[{") && latex.contains("Wide."), "{latex}");
        assert_eq!(
            latex.matches("\\begin{figure}[!t]").count(),
            latex.matches("\\end{figure}").count()
        );
        latex.contains("\\end{figure}")
    };
    assert_eq!([2, 25].map(floats), [false, true]);
}

#[test]
fn files_have_the_title_of_the_document() {
    let titled = |title: &str| Document { title: title.to_owned(), blocks: vec![] };
    let page = Page::with_columns(1);
    let latex = |title| latex::document(&titled(title), page).unwrap();
    assert!(latex("Equations of a robot").contains("\\pdfinfo{/Title (Equations of a robot)}"));
    assert!(latex("a)\\b é").contains("\\pdfinfo{/Title <FEFF00610029005C0062002000E9>}"));
    let typst = typst::document(&titled("a \"b\" #c"), page).unwrap();
    assert!(typst.contains("#set document(title: \"a \\\"b\\\" #c\")\n"), "{typst}");
}

#[test]
fn long_tables_go_on_without_a_caption_unless_a_page_starts() {
    let row = || vec![vec![Inline::text("abcdefgh")]; 7];
    let rows = (0..40).map(|_| row()).collect();
    let table = Table { caption: "Long.".to_owned(), head: row(), rows, keys: 1 };
    let document = Document { title: String::new(), blocks: vec![Block::Table(table)] };
    let latex = latex::document(&document, Page::with_columns(1)).unwrap();
    let [begun, more] = ["(continued)", "\\morerows{"].map(|text| latex.matches(text).count());
    // A further part of the table has its caption as an argument.
    assert!(begun > 3 && begun == more, "{begun} {more}");
    assert_eq!(latex.matches("abcdefgh & ").count(), 6 * (40 + 1 + begun));
    let typst = typst::document(&document, Page::with_columns(1)).unwrap();
    assert!(!typst.contains("continued") && typst.contains("#block(breakable: true)"));
}

#[test]
fn only_the_last_lines_of_a_long_equation_stay_together() {
    let sum: Vec<String> = (1..60).map(|index| format!("a_{{{index}}}")).collect();
    let [left, right] = ["Q_1", &sum.join(" + ")].map(|text| read(text).unwrap());
    let equation = Equation { name: "Q1".to_owned(), text: String::new(), left, right };
    let list = [NumberedEquation { label: Some("Q1".to_owned()), number: None, equation }];
    let typst = typst::equations(&list, Layout::of_centimeters(8.0)).unwrap();
    let (first, last) = typst.split_once("$]").unwrap();
    assert!(first.contains("breakable: true") && first.matches("quad").count() > 5, "{typst}");
    assert!(last.contains("<eq:Q1>") && last.matches("quad").count() == 2, "{typst}");
}

#[test]
fn symbols_that_only_the_table_of_masses_has_are_left_out() {
    let document = described("trttr1");
    let blocks = document.blocks.iter();
    let mut tables = blocks.filter_map(|block| match block {
        Block::Table(table) => Some(table),
        _ => None,
    });
    let table = tables.rfind(|table| table.caption.starts_with("Symbols")).unwrap();
    let names: Vec<&str> = table
        .rows
        .iter()
        .flat_map(|row| match row[0].as_slice() {
            [Inline::Math(math)] => math.symbols(),
            other => panic!("{other:?}"),
        })
        .collect();
    // The poses of links have l1, and the equations Jz2.
    for (name, is_listed) in [("Jx1", false), ("Jx4", false), ("Jz2", true), ("l1", true)] {
        assert_eq!(names.contains(&name), is_listed, "{name}: {names:?}");
    }
}
