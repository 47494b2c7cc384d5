//! The simplification of curves.

/// The points of a curve that are needed for a line within `tolerance` of it, found by the method of Douglas and
/// Peucker without recursion.
pub(super) fn simplified(points: &[(f64, f64)], tolerance: f64) -> Vec<(f64, f64)> {
    let Some(last) = points.len().checked_sub(1) else {
        return vec![];
    };
    let mut kept = vec![false; points.len()];
    kept[0] = true;
    kept[last] = true;
    let mut pieces = vec![(0, last)];
    while let Some((from, to)) = pieces.pop() {
        let far = (from + 1..to)
            .map(|index| (distance(points[index], points[from], points[to]), index))
            .max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((distance, index)) = far
            && distance > tolerance
        {
            kept[index] = true;
            pieces.extend([(from, index), (index, to)]);
        }
    }
    points.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// The distance of a point from the line through two other points.
fn distance((x, y): (f64, f64), (x0, y0): (f64, f64), (x1, y1): (f64, f64)) -> f64 {
    let (dx, dy) = (x1 - x0, y1 - y0);
    let length = dx.hypot(dy);
    if length > 0.0 {
        ((x - x0) * dy - (y - y0) * dx).abs() / length
    } else {
        (x - x0).hypot(y - y0)
    }
}

#[cfg(test)]
mod tests {
    use super::simplified;

    #[test]
    fn lines_need_two_points_and_peaks_stay() {
        let line: Vec<(f64, f64)> =
            (0..=1000).map(|x| (f64::from(x), f64::from(x) / 7.0)).collect();
        assert_eq!(simplified(&line, 0.1), [line[0], line[1000]]);
        let mut peak = line.clone();
        peak[400].1 += 5.0;
        assert_eq!(simplified(&peak, 0.1), [0, 399, 400, 401, 1000].map(|index| peak[index]));
        assert_eq!(simplified(&line[..1], 0.1), line[..1]);
        assert_eq!(simplified(&[], 0.1), []);
    }

    #[test]
    fn the_line_stays_within_the_tolerance() {
        let wave: Vec<(f64, f64)> =
            (0..=2000).map(|x| (f64::from(x), 100.0 * (f64::from(x) / 100.0).sin())).collect();
        let few = simplified(&wave, 0.2);
        assert!((30..400).contains(&few.len()), "{}", few.len());
        for (x, y) in wave {
            let after = few.partition_point(|point| point.0 < x).max(1);
            let ((x0, y0), (x1, y1)) = (few[after - 1], few[after]);
            let line = y0 + (y1 - y0) * (x - x0) / (x1 - x0);
            assert!((line - y).abs() < 0.4, "at {x}: {line} is not {y}");
        }
    }
}
