//! Text in bitmaps: moves letters down, because plotters draws them too high, and replaces accents.

use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind,
    FontTransform,
};

/// The distance by which plotters places the letters of its own fonts too high, as a fraction of the font size.
const RISE: f64 = 0.2;

/// A bitmap that draws letters lower than plotters does.
pub(super) struct Lowered<B>(pub(super) B);

type Done<B> = Result<(), DrawingErrorKind<<B as DrawingBackend>::ErrorType>>;

impl<B: DrawingBackend> DrawingBackend for Lowered<B> {
    type ErrorType = B::ErrorType;

    fn get_size(&self) -> (u32, u32) {
        self.0.get_size()
    }

    fn ensure_prepared(&mut self) -> Done<B> {
        self.0.ensure_prepared()
    }

    fn present(&mut self) -> Done<B> {
        self.0.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Done<B> {
        self.0.draw_pixel(point, color)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Done<B> {
        self.0.draw_line(from, to, style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Done<B> {
        self.0.draw_rect(upper_left, bottom_right, style, fill)
    }

    fn draw_text<S: BackendTextStyle>(
        &mut self,
        text: &str,
        style: &S,
        (x, y): BackendCoord,
    ) -> Done<B> {
        let down = (RISE * style.size()).round() as i32;
        let place = match style.transform() {
            FontTransform::None => (x, y + down),
            FontTransform::Rotate90 => (x - down, y),
            FontTransform::Rotate180 => (x, y - down),
            FontTransform::Rotate270 => (x + down, y),
        };
        self.0.draw_text(&without_accents(text), style, place)
    }
}

/// Writes dots over letters as fractions, `dq₁/dt`, because plotters draws an accent beside its letter.
fn without_accents(text: &str) -> String {
    let mut parts = text.split("q\u{307}");
    let mut shown = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let rest = part.trim_start_matches(|c| ('₀'..='₉').contains(&c));
        let (number, rest) = part.split_at(part.len() - rest.len());
        shown.push_str(&format!("dq{number}/dt{rest}"));
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dots_are_fractions() {
        assert_eq!(without_accents("velocity q\u{307} (rad/s)"), "velocity dq/dt (rad/s)");
        assert_eq!(without_accents("q\u{307}₁₂"), "dq₁₂/dt");
        assert_eq!(without_accents("q₁"), "q₁");
    }
}
