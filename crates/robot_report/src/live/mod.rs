//! The part of the page with the moving robot: its code in WebAssembly, sliders, and the results that they change.
//!
//! The part is hidden until the page's script has started. It is omitted if it would be too large.

mod controls;
mod data;
mod results;

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use robot_build::{Effects, FunctionKind, Functions, Options, Programs, programs};
use robot_codegen::backend::flat::FlatOptions;
use robot_codegen::backend::wasm::Wasm;
use robot_codegen::{Scalar, Trigonometry};
use robot_document::markup::{Element, element, holding};
use robot_model::robot::Robot;

use crate::Input;

/// The script of this part.
pub(crate) const SCRIPT: &str = include_str!("live.js");
/// The style sheet of this part.
pub(crate) const STYLE: &str = include_str!("live.css");

/// The largest number of bytes that this part can add to a page.
pub(crate) const LIMIT: usize = 80_000;

/// The part of a page with the moving robot.
#[derive(Clone)]
pub(crate) struct Live {
    /// The section, which is hidden at first.
    pub(crate) section: Element,
}

/// The functions that the part calls.
fn functions(robot: &Robot) -> Vec<FunctionKind> {
    let mut kinds = vec![
        FunctionKind::ForwardKinematics,
        FunctionKind::MassMatrix,
        FunctionKind::Gravity,
        FunctionKind::Bias,
        FunctionKind::InverseDynamics(Effects::NONE),
    ];
    if robot.has_friction() {
        kinds.push(FunctionKind::InverseDynamics(Effects::FRICTION));
    }
    kinds
}

/// Makes this part for a robot, or returns the reason why the page does not have it.
pub(crate) fn live(input: &Input<'_>, robot: &Robot) -> Result<Live, String> {
    let lacking: Vec<&str> = robot
        .parameters
        .iter()
        .filter(|parameter| parameter.value.is_none())
        .map(|parameter| parameter.name.as_str())
        .collect();
    if !lacking.is_empty() {
        let (names, them) = (lacking.join(", "), if lacking.len() == 1 { "it" } else { "them" });
        return Err(format!("the file has no value for {names}; give {them} a `value`."));
    }
    // These options make the page's results the same, to the last bit, as those of Rust code without options.
    let options = Options {
        functions: Functions::Chosen(functions(robot)),
        trigonometry: Trigonometry::Polynomial,
        scalar: Scalar::F64,
        fused: false,
        ..input.options.clone()
    };
    let programs = programs(input.source, &options).map_err(|errors| format!("{errors}"))?;
    let wasm = Wasm { options: FlatOptions::default(), batch: false };
    let module = wasm.bytes(&programs.module).map_err(|errors| format!("{errors}"))?;
    let section = section(&programs, &module);
    let size = section.to_string().len() + SCRIPT.len() + STYLE.len();
    if size > LIMIT {
        let [size, limit] = [size, LIMIT].map(|bytes| bytes.div_ceil(1000));
        return Err(format!("it would add {size} kB to the page, and the limit is {limit} kB."));
    }
    Ok(Live { section })
}

/// The text above the sliders.
const WORDS: &str = "This page computes these numbers with the robot's own code, compiled to WebAssembly: they are the same, to \
    the last bit, as those of Rust code generated with the same functions.";

/// The caption of the scheme.
const CAPTION: &str = "The robot, drawn to scale. Drag the picture to turn it, or focus it and use the arrow keys, + and −.";

fn section(programs: &Programs, module: &[u8]) -> Element {
    let robot = &programs.robot;
    let button = |name: &str| holding("button", name).attribute("type", "button");
    let scheme = element("svg")
        .attribute("xmlns", "http://www.w3.org/2000/svg")
        .class("scheme")
        .attribute("viewBox", "0 0 640 440")
        .attribute("tabindex", "0")
        .attribute("role", "img")
        .attribute("aria-labelledby", "live-scheme-title live-scheme-description")
        .with(
            holding("title", format!("Moving scheme of {}", robot.name))
                .attribute("id", "live-scheme-title"),
        )
        .with(holding("desc", CAPTION).attribute("id", "live-scheme-description"));
    let figure = element("figure").with(scheme).with(holding("figcaption", CAPTION));
    // On wide screens, the picture stands beside the sliders and the results.
    let seen = element("div")
        .class("seen")
        .with(figure)
        .with(button("Swing").attribute("aria-pressed", "false"))
        .with(button("Reset"));
    let moved = element("div")
        .class("moved")
        .with(controls::states(robot))
        .with_all(controls::payload(robot))
        .with(results::torques(robot))
        .with(results::mass_matrix(robot));
    element("section")
        .attribute("id", "live")
        .attribute("aria-labelledby", "live-heading")
        .attribute("data-live", "")
        .attribute("hidden", "hidden")
        .attribute("data-robot", data::of(programs))
        .attribute("data-module", BASE64_STANDARD.encode(module))
        .with(holding("h2", "Live").attribute("id", "live-heading"))
        .with(holding("p", WORDS).class("note"))
        .with(element("div").class("board").with(seen).with(moved))
}
