//! Tables of the results that the sliders change; the script fills them.

use robot_document::markup::{Element, element, holding};
use robot_model::robot::Robot;
use robot_model::variable::JointVariable;

use crate::text;

/// A cell for a number that the script writes.
fn number(name: &'static str) -> Element {
    holding("td", "0").attribute(name, "")
}

/// The joint torques and their contributions, as numbers and as bars.
pub(super) fn torques(robot: &Robot) -> Element {
    let mut causes = vec!["inertia", "Coriolis", "gravity"];
    if robot.has_friction() {
        causes.push("friction");
    }
    let column = |words: &str| holding("th", words).attribute("scope", "col");
    let colored = causes.iter().enumerate().map(|(index, cause)| {
        element("th")
            .attribute("scope", "col")
            .with(element("i").class(format!("cause-{index}")))
            .with(*cause)
    });
    let headings = element("tr")
        .with(column("Coordinate"))
        .with(column("parts").with(element("small").class("scale")))
        .with(column("τ"))
        .with_all(colored);
    let rows = robot.coordinates.iter().enumerate().map(|(index, coordinate)| {
        let symbol = text::symbol(&JointVariable::Position.symbol(index));
        let unit = text::unit(JointVariable::Torque.unit(coordinate.kind));
        let heading = holding("th", format!("{symbol}, {unit}")).attribute("scope", "row");
        let cells = causes.iter().map(|_| number("data-cause"));
        element("tr")
            .with(heading)
            .with(holding("td", bars(&symbol, causes.len())))
            .with(number("data-cause").class("total"))
            .with_all(cells)
    });
    let caption = "Joint torques τ and their contributions: inertia M q̈, Coriolis and centrifugal terms C q̇, gravity g, and \
        friction if there is any. All bars of the same unit have one scale, which ends at the largest value so far; the \
        vertical line is τ.";
    let table = element("table")
        .class("torques")
        .with(holding("caption", holding("span", caption)))
        .with(holding("thead", headings))
        .with(element("tbody").with_all(rows));
    wide(table)
}

/// A line at 0, a line for the sum, and a bar for each contribution.
fn bars(symbol: &str, causes: usize) -> Element {
    let height = 6 * causes;
    let path = |class: String| element("path").class(class);
    let parts = (0..causes).map(|index| path(format!("cause-{index}")));
    element("svg")
        .attribute("xmlns", "http://www.w3.org/2000/svg")
        .class("bars")
        .attribute("viewBox", format!("-104 0 208 {height}"))
        .attribute("aria-hidden", "true")
        .with(holding("title", format!("Contributions to the torque of {symbol}")))
        .with(holding("desc", "Bars of the numbers in this row."))
        .with(path("sum".to_owned()))
        .with_all(parts)
        .with(path("zero".to_owned()).attribute("d", format!("M0 0V{height}")))
}

/// The mass matrix.
pub(super) fn mass_matrix(robot: &Robot) -> Element {
    let n = robot.coordinates.len();
    let symbols: Vec<String> =
        (0..n).map(|index| text::symbol(&JointVariable::Position.symbol(index))).collect();
    let columns = symbols.iter().map(|name| holding("th", name.as_str()).attribute("scope", "col"));
    let rows = symbols.iter().map(|name| {
        let cells = (0..n).map(|_| holding("td", "0"));
        element("tr").with(holding("th", name.as_str()).attribute("scope", "row")).with_all(cells)
    });
    let caption = "The mass matrix M(q), in kg·m², kg·m or kg; the stronger the color of an entry, the larger it is.";
    let table = element("table")
        .class("grid mass")
        .with(holding("caption", holding("span", caption)))
        .with(holding(
            "thead",
            element("tr").with(holding("th", "M").attribute("scope", "col")).with_all(columns),
        ))
        .with(element("tbody").with_all(rows));
    wide(table)
}

fn wide(table: Element) -> Element {
    element("div").class("wide").with(table)
}
