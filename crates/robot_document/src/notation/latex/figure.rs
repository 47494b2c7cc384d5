//! Figures in TikZ.

use super::document::line;
use super::text;
use crate::figure::{Color, Figure, Label, Path, Point, Segment, Shape, coordinate, hundredths};

/// A figure with its caption; `scale` is the length of its unit in points. A figure that floats stands at the top of
/// the next column that has room for it.
pub(super) fn figure(figure: &Figure, scale: f64, floats: bool) -> String {
    let colors = figure.colors();
    let [begin, end] = match floats {
        true => ["\\begin{figure}[!t]", "\\end{figure}"],
        false => ["\\medskip", "\\medskip"],
    };
    let mut latex = format!(
        "\n\\ifdefined\\tikzpicture\n{begin}\n\\begin{{minipage}}{{\\linewidth}}\\raggedright\n"
    );
    for (Color([red, green, blue]), number) in colors.iter().zip(1..) {
        latex
            .push_str(&format!("\\definecolor{{figure{number}}}{{RGB}}{{{red},{green},{blue}}}\n"));
    }
    let unit = format!("{scale:.3}pt");
    latex.push_str(&format!(
        "\\begin{{tikzpicture}}[x={unit},y=-{unit},line cap=round,line join=round,inner sep=0.5pt]\n"
    ));
    let [low, high] = figure.bounds;
    latex.push_str(&format!("  \\useasboundingbox {} rectangle {};\n", point(low), point(high)));
    let pen = Pen { scale, colors };
    for shape in &figure.shapes {
        latex.push_str(&match shape {
            Shape::Path(path) => pen.path(path),
            Shape::Label(label) => pen.label(label),
        });
    }
    latex.push_str("\\end{tikzpicture}\\par\\smallskip\n");
    latex.push_str(&format!("\\textbf{{Figure 1.}} {}\n", text(&figure.caption)));
    latex.push_str(&format!("\\end{{minipage}}\\par{end}\n\\fi\n"));
    latex
}

struct Pen {
    scale: f64,
    colors: Vec<Color>,
}

impl Pen {
    fn color(&self, color: Color) -> String {
        let place = self.colors.iter().position(|known| *known == color).unwrap_or_default();
        format!("figure{}", place + 1)
    }

    fn path(&self, path: &Path) -> String {
        let mut options = format!(
            "{},line width={}pt",
            self.color(path.color),
            hundredths(path.width * self.scale)
        );
        if let Some(fill) = path.fill {
            options.push_str(&format!(",fill={}", self.color(fill)));
        }
        if !path.dashes.is_empty() {
            let words = ["on", "off"].into_iter().cycle();
            let dashes = path.dashes.iter().zip(words);
            let dashes: Vec<String> = dashes
                .map(|(length, word)| format!("{word} {}pt", hundredths(length * self.scale)))
                .collect();
            options.push_str(&format!(",dash pattern={}", dashes.join(" ")));
        }
        let mut track = point(path.start);
        for segment in &path.segments {
            track.push_str(&match segment {
                Segment::Line(end) => format!(" -- {}", point(*end)),
                Segment::Curve([first, second, end]) => format!(
                    " .. controls {} and {} .. {}",
                    point(*first),
                    point(*second),
                    point(*end)
                ),
            });
        }
        let end = if path.is_closed { " -- cycle" } else { "" };
        format!("  \\draw[{options}] {track}{end};\n")
    }

    fn label(&self, label: &Label) -> String {
        let points = (label.size * self.scale).max(5.0);
        let font = format!("\\fontsize{{{points:.1}}}{{{points:.1}}}\\selectfont");
        let words = line(std::slice::from_ref(&label.words));
        let words = if label.is_bold { format!("\\textbf{{{words}}}") } else { words };
        format!(
            "  \\node[{},fill=white,font={font}] at {} {{{words}}};\n",
            self.color(label.color),
            point(label.center)
        )
    }
}

fn point([x, y]: Point) -> String {
    format!("({},{})", coordinate(x), coordinate(y))
}
